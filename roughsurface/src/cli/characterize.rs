//! `roughsurface characterize`.

use super::common::*;
use super::topography::TopographyOptions;
use clap::Args;
use clap::builder::PossibleValuesParser;
use roughsurface::topography::report::{self, WhichSummits};
use std::path::PathBuf;
use tables::figures::Figure;

pub const HELP: &str = "\
Formats, told apart by content: GSF (Gwyddion), NetCDF as SurfaceTopography writes it, X3P
(ISO 25178-72), SDF (ISO 25178-71), NPY (NumPy, with --pixel), and text or CSV: a matrix of heights
(with --pixel, or the header that Gwyddion writes), columns x y z of a regular grid, a profile x z, or a
column of heights with --pixel.

Summit radius and density follow from the shortest wavelengths that are let in. Give what your
instrument resolves (the width of the tip, the spot, the optical limit) as --cutoff; without it
four points a wave, or the length at which noise contributes 5 % of m4, with a warning.

Examples:
  Surface file from a map:
    roughsurface characterize map.x3p --cutoff 2um -o surface.toml
    roughsurface predict surface.toml --table table.nc -o friction.nc
  From a matrix in micrometres, points 0.5 um apart, with the summits that were found:
    roughsurface characterize map.txt --unit um --pixel 0.5um --cutoff 4um --summits found -o surface.toml";

#[derive(Args)]
pub struct Characterize {
    /// Height map or profile
    topography: PathBuf,
    /// Summits for the surface file
    #[arg(long, value_enum, default_value = "moments")]
    summits: WhichSummits,
    /// Surface file (TOML) to write
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Plot of spectrum and summit heights
    #[arg(long, value_name = "FILE.svg|png|pdf")]
    plot: Option<PathBuf>,
    /// Only this panel of the plot, 85 mm wide; may be repeated
    #[arg(long, value_name = "NAME", requires = "plot", value_parser = PossibleValuesParser::new(report::PANELS))]
    panel: Vec<String>,
    #[command(flatten)]
    measured: TopographyOptions,
}

/// Reads, characterises, writes.
pub fn run(options: &Characterize, display: &Display) -> Result<(), Failure> {
    let shown = options.topography.display();
    let of_found = options.summits == WhichSummits::Found;
    let heights = options.output.as_ref().filter(|_| of_found).map(|path| path.with_extension("heights.txt"));
    let outputs = [
        ("--output", options.output.as_deref()),
        ("the file of heights", heights.as_deref()),
        ("--plot", options.plot.as_deref()),
    ];
    let mut inputs = vec![("the topography", &*options.topography)];
    inputs.extend(options.measured.input());
    check_files(check_outputs, &inputs, &outputs)?;
    if let Some(plot) = &options.plot {
        Figure::check_extension(plot).map_err(Failure::input)?;
    }
    let found = options.measured.characterize(&options.topography, of_found)?;
    if of_found && found.found.count < 2 {
        return Err(Failure::input(format!(
            "{shown}: {} summits found; a surface needs two",
            found.found.count
        )));
    }
    if let Some(output) = &options.output {
        if let Some(heights) = &heights {
            write_whole(heights, report::heights_file(&found).as_bytes())?;
        }
        let name = heights.map(|path| path.file_name().unwrap_or_default().to_string_lossy().into_owned());
        let source = options.measured.name(&options.topography);
        write_whole(output, report::surface_file(&found, &source, name.as_deref()).as_bytes())?;
    }
    if let Some(plot) = &options.plot {
        let drawn = report::figure(&found).only(&options.panel).and_then(|figure| figure.save(plot));
        drawn.map_err(Failure::run)?;
    }
    display.printer().warn(&found.warnings);
    display.printer().print(|| report::json(&found), || report::text(&found))
}
