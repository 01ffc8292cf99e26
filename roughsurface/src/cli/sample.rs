//! `roughsurface sample`.

use super::common::*;
use super::input::InputOptions;
use super::progress::computed;
use clap::Args;
use clap::builder::{PathBufValueParser, TypedValueParser};
use roughsurface::friction::Settings;
use roughsurface::friction::warning::Warning;
use roughsurface::output::{Origin, sample_file};
use roughsurface::sampling::finite_surface::Sampling;
use roughsurface::surface::units;
use std::path::PathBuf;

pub const HELP: &str = "\
Example:
  Sliding friction of 500 specimens with 1000 asperities each:
    roughsurface sample surface.toml --table table.nc --asperities 1000 --realizations 500 --seed 7 -o mc.nc";

/// Most asperities of a surface and most surfaces, so that they fit into memory.
const MOST_ASPERITIES: i64 = 100_000_000;
const MOST_SURFACES: i64 = 1_000_000;

#[derive(Args)]
pub struct Sample {
    #[command(flatten)]
    input: InputOptions,
    /// Asperities of one surface, in contact or not
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=MOST_ASPERITIES))]
    asperities: u32,
    /// Surfaces to draw
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u32).range(2..=MOST_SURFACES))]
    realizations: u32,
    /// Seed of the heights: the same seed, the same surfaces
    #[arg(long, value_name = "S", allow_negative_numbers = true, default_value_t = 1)]
    seed: u64,
    /// Slip after which friction is read, in m or with a unit; by default friction is the mean over the life of the contacts
    #[arg(long, value_name = "LENGTH", allow_negative_numbers = true, value_parser = units::length_or_zero)]
    slip: Option<f64>,
    /// Result (netCDF)
    #[arg(short, long, value_name = "mc.nc", value_parser = PathBufValueParser::new().try_map(netcdf_name))]
    output: PathBuf,
    #[command(flatten)]
    run: RunOptions,
}

/// Draws, slides, writes.
pub fn run(options: &Sample, display: &Display) -> Result<(), Failure> {
    let case = options.input.read(&[("--output", Some(&options.output))], Vec::new())?;
    check_kind(&options.output, sample_file::TITLE).map_err(Failure::input)?;
    let of_input = case.warnings();
    display.printer().warn(Warning::condensed(&of_input));
    display.printer().warn(case.unused_by_samples());
    let settings = Settings { extrapolate: options.input.extrapolate, ..Settings::default() };
    let &Sample { asperities, realizations, seed, slip, .. } = options;
    let (asperities, realizations) = (asperities as usize, realizations as usize);
    let sampling = Sampling { asperities, realizations, seed, slip };
    let samples =
        computed(&options.run, display, "surfaces", |show| case.sample(&sampling, &settings, show))?;
    let samples = samples.map_err(failure)?;
    let origin = Origin { surface: &case.file.text, table: &case.table, history: &history() };
    let saved = save(&options.output, |path| sample_file::write(path, &samples, &origin));
    display.printer().warn(Warning::condensed(&samples.warnings[of_input.len()..]));
    let printed = display.printer().print(|| sample_file::json(&samples), || sample_file::text(&samples));
    Failure::all([saved, printed])
}
