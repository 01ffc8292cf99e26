//! `roughsurface predict`.

use super::common::*;
use anyhow::anyhow;
use clap::Args;
use roughsurface::friction::comparison::compare;
use roughsurface::friction::{Settings, predict};
use roughsurface::integral::law_source::{background, caveat};
use roughsurface::output::figure::figure;
use roughsurface::output::friction_file::{self, Origin};
use roughsurface::output::report;
use roughsurface::output::summary;
use roughsurface::sampling::uncertainty::propagate;
use roughsurface::surface::file::SurfaceFile;
use std::path::PathBuf;
use tables::closed_forms::NAMES;
use tables::figures::Figure;

pub const HELP: &str = "\
Examples:
  Friction from a table computed by `asperity tabulate`, with a plot:
    roughsurface predict surface.toml --table table.nc -o friction.nc --plot friction.png
  From a closed form of the literature; surface.toml then needs
  [material] with youngs_modulus, poisson_ratio and yield_strength:
    roughsurface predict surface.toml --table model:kogut-etsion -o friction.nc
  The same beside the models of the literature, with a report for the browser:
    roughsurface predict surface.toml --table table.nc -o friction.nc --compare all \\
        --report friction.html
  Summary for a script:
    roughsurface predict surface.toml --table table.nc -o friction.nc --json | jq .friction

Worked through, with what each leaves out, in examples/scenes and in the book: a brake disc,
a bearing steel contact, a granite fault with flash heating:
    roughsurface predict examples/scenes/brake-disc.toml --table model:jackson-green \\
        -o brake.nc --compare all
    roughsurface predict examples/scenes/bearing-steel.toml --table model:jackson-green \\
        -o bearing.nc --compare all
    roughsurface predict examples/scenes/granite-fault.toml --table granite-table.nc \\
        -o granite.nc --report granite.html

What is left out: asperities do not feel each other, no adhesion, no wear, no third body
(debris, gouge, oxide, lubricant); the counter-face is smooth and rigid.

A pressure so high that the table's range carries less than 99.9 % of the load is refused
unless --extrapolate holds friction and mean pressure at the table's last interference.";

#[derive(Args)]
pub struct Predict {
    /// Surface file (TOML): summits, heights, pressures, slip rates
    surface: PathBuf,
    /// Table of one asperity: a file, the name of a shipped table (steel-4340, steel-1045, steel-304,
    /// aluminium-6061, copper, titanium-6al4v), or model:NAME for a closed form
    #[arg(long, value_name = "TABLE")]
    table: String,
    /// Result (netCDF)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Plot of the result (.svg or .png)
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Models to compare with, separated by commas, or all
    #[arg(long, value_name = "MODELS", value_delimiter = ',')]
    compare: Vec<String>,
    /// Report with figures, parameters, errors and warnings, one file for any browser
    #[arg(long, value_name = "FILE.html")]
    report: Option<PathBuf>,
    /// Continue the table beyond its last interference, and say so
    #[arg(long)]
    extrapolate: bool,
    /// Interpolate around cells of the table that failed or were not run, and say so
    #[arg(long)]
    allow_missing: bool,
    /// Relative error of integrals and pressures, 1e-6 unless given
    #[arg(long, value_name = "X", value_parser = tolerance)]
    tolerance: Option<f64>,
    #[command(flatten)]
    run: RunOptions,
}

/// Names of closed forms.
fn models(asked: &[String]) -> Result<Vec<String>, Failure> {
    if asked.iter().any(|name| name == "all") {
        return Ok(NAMES.map(String::from).to_vec());
    }
    match asked.iter().find(|name| !NAMES.contains(&name.as_str())) {
        Some(name) => Err(input(anyhow!("--compare {name}: must be among {}, or all", NAMES.join(", ")))),
        None => Ok(asked.to_vec()),
    }
}

fn tolerance(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(tolerance) if (1e-12..=1e-3).contains(&tolerance) => Ok(tolerance),
        _ => Err("must lie between 1e-12 and 1e-3".into()),
    }
}

/// Reads, predicts, writes.
pub fn run(options: &Predict) -> Result<(), Failure> {
    let file = SurfaceFile::read(&options.surface).map_err(input)?;
    let (law, gaps) = law(&options.table, &file, options.allow_missing)?;
    let background = background(&options.table, file.material.as_ref(), file.temperature);
    let models = models(&options.compare)?;
    // Known before the work, not after it.
    for path in std::iter::once(&options.output).chain(&options.plot).chain(&options.report) {
        check_folder(path)?;
    }
    if let Some(plot) = &options.plot {
        Figure::check_extension(plot).map_err(input)?;
    }
    let radius = file.surface.asperity_radius.mean();
    if options.run.verbose {
        let critical = law.critical_interference(radius);
        let std = file.surface.heights.standard_deviation();
        eprintln!(
            "law {}: omega_c = {critical:.4e} m at R = {radius:e} m, plasticity index {:.3}, up to {} omega_c",
            law.name(),
            (std / critical).sqrt(),
            law.interference_limit()
        );
    }
    let settings = Settings {
        extrapolate: options.extrapolate,
        melting_temperature: background.melting_temperature,
        ..Settings::default()
    };
    let settings = Settings { tolerance: options.tolerance.unwrap_or(settings.tolerance), ..settings };
    let pool = thread_pool(&options.run)?;
    let progress = Progress::new(&options.run, "slips");
    let started = std::time::Instant::now();
    let mut prediction = pool
        .install(|| {
            predict(law.as_ref(), &file.surface, &file.query, &settings, &|done, total| {
                progress.show(done, total)
            })
        })
        .map_err(failure)?;
    prediction.warnings.extend(gaps);
    if !(file.uncertain.is_empty() && file.uncertain_tables.is_empty()) {
        let shown = |done, total| progress.show(done, total);
        let propagated = pool.install(|| propagate(&file, &options.table, &prediction, &settings, &shown));
        prediction.propagated = Some(propagated.map_err(input)?);
    }
    if let Some(material) = &background.material {
        let compared = pool.install(|| compare(&models, material, &file.surface, &file.query, &settings));
        prediction.comparisons = compared.map_err(failure)?;
        let caveats = models.iter().map(String::as_str).chain(options.table.strip_prefix("model:"));
        prediction.warnings.extend(caveats.filter_map(|model| caveat(model, material)));
    }
    progress.clear();
    if options.run.verbose {
        eprintln!(
            "{} slips from {:.3e} to {:.3e} m in {:.2} s",
            prediction.slip.len(),
            prediction.slip[1],
            prediction.slip[prediction.slip.len() - 1],
            started.elapsed().as_secs_f64()
        );
    }
    let origin = Origin { surface: &file.text, table: &options.table, command: &command_line() };
    friction_file::write(&options.output, &prediction, &origin)
        .map_err(|error| Failure::Run(error.into()))?;
    if let Some(plot) = &options.plot {
        figure(&prediction).save(plot).map_err(|error| Failure::Run(error.into()))?;
    }
    if let Some(report) = &options.report {
        write_whole(report, report::html(&prediction, &origin).as_bytes())?;
    }
    summarise(
        options.run.quiet,
        options.run.json,
        &prediction.warnings,
        || summary::text(&prediction),
        || summary::json(&prediction),
    );
    Ok(())
}
