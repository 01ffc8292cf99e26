//! `roughsurface characterize`.

use super::common::*;
use anyhow::anyhow;
use clap::Args;
use roughsurface::topography::characterize::{Detrend, Options, characterize};
use roughsurface::topography::readers::length;
use roughsurface::topography::readers::{Reading, read};
use roughsurface::topography::report::{self, WhichSummits};
use roughsurface::topography::spectrum::Window;
use std::path::PathBuf;
use tables::figures::Figure;

pub const HELP: &str = "\
Formats, told apart by content: GSF (Gwyddion), NetCDF as SurfaceTopography writes it, X3P
(ISO 25178-72), and text: a matrix of heights (with --pixel, or the header that Gwyddion
writes), columns x y z of a regular grid, a profile x z, or a column of heights with --pixel.

Summit radius and density follow from the shortest wavelengths that are let in. Give what your
instrument resolves (the width of the tip, the spot, the optical limit) as --cutoff; without it
four points a wave, or where the spectrum turns into noise, with a warning.

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
    /// Short-wavelength cut-off (Gaussian, ISO 16610): metres or with a unit, 2e-6 or 2um
    #[arg(long, value_name = "LENGTH", value_parser = length::parse)]
    cutoff: Option<f64>,
    /// Trend to take off
    #[arg(long, value_enum, default_value = "plane")]
    detrend: Detrend,
    /// Window over a topography that does not continue at its edges
    #[arg(long, value_enum, default_value = "hann")]
    window: Window,
    /// Unit of the lengths in a text file: m, mm, um, nm
    #[arg(long, value_name = "UNIT", value_parser = unit)]
    unit: Option<f64>,
    /// Distance between the points of a text file that does not state it
    #[arg(long, value_name = "LENGTH", value_parser = length::parse)]
    pixel: Option<f64>,
    /// Summits for the surface file
    #[arg(long, value_enum, default_value = "moments")]
    summits: WhichSummits,
    /// Surface file (TOML) to write
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Plot of spectrum and summit heights (.svg or .png)
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
    /// Print errors only (and the JSON with --json)
    #[arg(short, long)]
    quiet: bool,
}

fn unit(text: &str) -> Result<f64, String> {
    length::unit(text).ok_or_else(|| "must be a unit of length: m, mm, um, nm".into())
}

/// Reads, characterises, writes.
pub fn run(options: &Characterize) -> Result<(), Failure> {
    for path in options.output.iter().chain(&options.plot) {
        check_folder(path)?;
    }
    if let Some(plot) = &options.plot {
        Figure::check_extension(plot).map_err(input)?;
    }
    let reading = Reading { unit: options.unit, pixel: options.pixel };
    let topography = read(&options.topography, &reading).map_err(input)?;
    let shown = options.topography.display();
    if options.summits == WhichSummits::Found && topography.is_profile() {
        return Err(input(anyhow!(
            "{shown}: peaks of a profile are no summits; --summits found needs a map"
        )));
    }
    let how = Options { cutoff: options.cutoff, detrend: options.detrend, window: options.window };
    let found = characterize(topography, &how).map_err(|what| input(anyhow!("{shown}: {what}")))?;
    if let Some(output) = &options.output {
        let source = options.topography.file_name().unwrap_or_default().to_string_lossy();
        let heights = match options.summits {
            WhichSummits::Moments => None,
            WhichSummits::Found if found.found.count < 2 => {
                return Err(input(anyhow!(
                    "{shown}: {} summits found; a surface needs two",
                    found.found.count
                )));
            }
            WhichSummits::Found => Some(output.with_extension("heights.txt")),
        };
        if let Some(heights) = &heights {
            write_whole(heights, report::heights_file(&found).as_bytes())?;
        }
        let name = heights.map(|path| path.file_name().unwrap_or_default().to_string_lossy().into_owned());
        write_whole(output, report::surface_file(&found, &source, name.as_deref()).as_bytes())?;
    }
    if let Some(plot) = &options.plot {
        report::figure(&found).save(plot).map_err(|error| Failure::Run(error.into()))?;
    }
    summarise(options.quiet, options.json, &found.warnings, || report::text(&found), || report::json(&found));
    Ok(())
}
