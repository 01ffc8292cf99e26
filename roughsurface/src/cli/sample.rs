//! `roughsurface sample`.

use super::common::*;
use clap::Args;
use roughsurface::friction::{Settings, end_of_slide};
use roughsurface::output::friction_file::Origin;
use roughsurface::output::sample_file;
use roughsurface::sampling::finite_surface::{Sampling, sample};
use roughsurface::surface::file::SurfaceFile;
use std::path::PathBuf;

pub const HELP: &str = "\
Example:
  Sliding friction of 500 specimens with 1000 asperities each:
    roughsurface sample surface.toml --table table.nc --asperities 1000 --realizations 500 --seed 7 -o mc.nc";

#[derive(Args)]
pub struct Sample {
    /// Surface file (TOML): summits, heights, pressures, slip rates
    surface: PathBuf,
    /// Table of one asperity: a file, the name of a shipped table (steel-4340, steel-1045, steel-304,
    /// aluminium-6061, copper, titanium-6al4v), or model:NAME for a closed form
    #[arg(long, value_name = "TABLE")]
    table: String,
    /// Asperities of one surface, in contact or not
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..))]
    asperities: u32,
    /// Surfaces to draw
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u32).range(2..))]
    realizations: u32,
    /// Seed of the heights: the same seed, the same surfaces
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Slip at which friction is read, m; by default where `predict` ends
    #[arg(long, value_name = "LENGTH", value_parser = slip_length)]
    slip: Option<f64>,
    /// Result (netCDF)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Continue the table beyond its last interference, and say so
    #[arg(long)]
    extrapolate: bool,
    /// Interpolate around cells of the table that failed or were not run, and say so
    #[arg(long)]
    allow_missing: bool,
    #[command(flatten)]
    run: RunOptions,
}

fn slip_length(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(slip) if slip >= 0.0 && slip.is_finite() => Ok(slip),
        _ => Err("must be a length in metres, not negative".into()),
    }
}

/// Draws, slides, writes.
pub fn run(options: &Sample) -> Result<(), Failure> {
    let file = SurfaceFile::read(&options.surface).map_err(input)?;
    let (law, gaps) = law(&options.table, &file, options.allow_missing)?;
    check_folder(&options.output)?;
    let settings = Settings { extrapolate: options.extrapolate, ..Settings::default() };
    let pool = thread_pool(&options.run)?;
    let progress = Progress::new(&options.run, "surfaces");
    let mut samples = pool
        .install(|| {
            let slip = match options.slip {
                Some(slip) => slip,
                None => end_of_slide(law.as_ref(), &file.surface, &file.query, &settings)?,
            };
            let sampling = Sampling {
                asperities: options.asperities as usize,
                realizations: options.realizations as usize,
                seed: options.seed,
                slip,
            };
            sample(law.as_ref(), &file.surface, &file.query, &sampling, &settings, &|done, total| {
                progress.show(done, total)
            })
        })
        .map_err(failure)?;
    progress.clear();
    samples.warnings.extend(gaps);
    let origin = Origin { surface: &file.text, table: &options.table, command: &command_line() };
    sample_file::write(&options.output, &samples, &origin).map_err(|error| Failure::Run(error.into()))?;
    summarise(
        options.run.quiet,
        options.run.json,
        &samples.warnings,
        || sample_file::text(&samples),
        || sample_file::json(&samples),
    );
    Ok(())
}
