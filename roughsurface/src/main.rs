//! Command line of the friction of rough surfaces.

use anyhow::{Context, anyhow};
use clap::{Args, Parser, Subcommand};
use roughsurface::friction::{PredictionError, Settings, end_of_slide, predict};
use roughsurface::friction_figure::figure;
use roughsurface::friction_file::{self, Origin};
use roughsurface::law_source::{asperity_law, asperity_law_without_gaps};
use roughsurface::monte_carlo::{Sampling, sample};
use roughsurface::monte_carlo_file;
use roughsurface::separation::SeparationError;
use roughsurface::summary;
use roughsurface::surface_file::SurfaceFile;
use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use tables::figure::Figure;
use tables::law::{AsperityLaw, LookupError};

const AFTER_HELP: &str = "\
A surface file, surface.toml:

    [surface]
    asperity_density = 1e10     # summits per nominal area, 1/m2
    asperity_radius = 100e-6    # m
    heights = { distribution = \"gaussian\", std = 0.5e-6 }
    [query]
    pressure = [1e5, 1e6]       # nominal, Pa; or separation = [..] in m
    slip_rate = [0.1, 1, 10]    # m/s
    hold = \"load\"               # or \"separation\"

Heights: gaussian, exponential, uniform (std); truncated-gaussian (std, lower, upper);
weibull, lognormal (std, shape); sample (file of heights in metres).

Exit status: 0 done, 1 failed, 2 bad input or usage.";

const PREDICT_HELP: &str = "\
Examples:
  Friction from a table computed by `asperity tabulate`, with a plot:
    roughsurface predict surface.toml --table table.nc -o friction.nc --plot friction.png
  From a closed form of the literature; surface.toml then needs
  [material] with youngs_modulus, poisson_ratio and yield_strength:
    roughsurface predict surface.toml --table model:kogut-etsion -o friction.nc
  Summary for a script:
    roughsurface predict surface.toml --table table.nc -o friction.nc --json | jq .friction

A pressure so high that the table's range carries less than 99.9 % of the load is refused
unless --extrapolate holds friction and mean pressure at the table's last interference.";

const SAMPLE_HELP: &str = "\
Example:
  Sliding friction of 500 specimens with 1000 asperities each:
    roughsurface sample surface.toml --table table.nc --asperities 1000 --realizations 500 --seed 7 -o mc.nc";

/// Friction of a rough surface from the friction of one asperity
#[derive(Parser)]
#[command(version, after_long_help = AFTER_HELP, arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Predict static and sliding friction against pressure and slip rate
    #[command(after_help = PREDICT_HELP, after_long_help = format!("{PREDICT_HELP}\n\n{AFTER_HELP}"))]
    Predict(Predict),
    /// Slide finite surfaces with heights drawn at random: how much specimens scatter
    #[command(after_help = SAMPLE_HELP, after_long_help = format!("{SAMPLE_HELP}\n\n{AFTER_HELP}"))]
    Sample(SampleOptions),
}

#[derive(Args)]
struct Predict {
    /// Surface file (TOML): summits, heights, pressures, slip rates
    surface: PathBuf,
    /// Table of one asperity: a file, or model:NAME for a closed form
    #[arg(long, value_name = "TABLE")]
    table: String,
    /// Result (netCDF)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Plot of the result (.svg or .png)
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Continue the table beyond its last interference, and say so
    #[arg(long)]
    extrapolate: bool,
    /// Interpolate around cells of the table that failed or were not run, and say so
    #[arg(long)]
    allow_missing: bool,
    #[command(flatten)]
    run: RunOptions,
}

#[derive(Args)]
struct SampleOptions {
    /// Surface file (TOML): summits, heights, pressures, slip rates
    surface: PathBuf,
    /// Table of one asperity: a file, or model:NAME for a closed form
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

#[derive(Args)]
struct RunOptions {
    /// Threads; all cores by default. Results do not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// Print the summary as JSON
    #[arg(long)]
    json: bool,
    /// Print no summary and no warnings
    #[arg(short, long, conflicts_with = "json")]
    quiet: bool,
    /// Show progress even if stderr is not a terminal
    #[arg(long)]
    progress: bool,
    /// Say what is being done
    #[arg(short, long)]
    verbose: bool,
}

/// What went wrong, and whose fault it is.
enum Failure {
    /// Bad input: exit status 2.
    Input(anyhow::Error),
    /// The run failed: exit status 1.
    Run(anyhow::Error),
}

fn input(error: impl Into<anyhow::Error>) -> Failure {
    Failure::Input(error.into())
}

fn main() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Predict(options) => run_predict(&options),
        Command::Sample(options) => run_sample(&options),
    };
    let (error, status) = match result {
        Ok(()) => return ExitCode::SUCCESS,
        Err(Failure::Input(error)) => (error, 2),
        Err(Failure::Run(error)) => (error, 1),
    };
    eprintln!("error: {error:#}");
    ExitCode::from(status)
}

fn run_predict(options: &Predict) -> Result<(), Failure> {
    let file = SurfaceFile::read(&options.surface).map_err(input)?;
    let (law, gaps) = law(&options.table, &file, options.allow_missing)?;
    // Known before the work, not after it.
    for path in std::iter::once(&options.output).chain(&options.plot) {
        check_folder(path)?;
    }
    if let Some(plot) = &options.plot {
        Figure::check_extension(plot).map_err(input)?;
    }
    let radius = file.surface.asperity_radius;
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
    let settings = Settings { extrapolate: options.extrapolate, ..Settings::default() };
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
    progress.clear();
    prediction.warnings.extend(gaps);
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
    report(&options.run, &prediction.warnings, || summary::text(&prediction), || summary::json(&prediction));
    Ok(())
}

fn run_sample(options: &SampleOptions) -> Result<(), Failure> {
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
    monte_carlo_file::write(&options.output, &samples, &origin)
        .map_err(|error| Failure::Run(error.into()))?;
    report(
        &options.run,
        &samples.warnings,
        || monte_carlo_file::text(&samples),
        || monte_carlo_file::json(&samples),
    );
    Ok(())
}

/// The law that `--table` names, and a warning if points without results were filled in.
fn law(
    table: &str,
    file: &SurfaceFile,
    allow_missing: bool,
) -> Result<(Box<dyn AsperityLaw>, Option<String>), Failure> {
    let material = file.material.as_ref();
    match allow_missing {
        true => asperity_law_without_gaps(table, material).map_err(input),
        false => Ok((asperity_law(table, material).map_err(input)?, None)),
    }
}

/// Warnings to stderr, the summary to stdout.
fn report(
    options: &RunOptions,
    warnings: &[String],
    text: impl Fn() -> String,
    json: impl Fn() -> serde_json::Value,
) {
    if options.quiet {
        return;
    }
    for warning in warnings {
        eprintln!("warning: {warning}");
    }
    if options.json {
        print(&format!("{:#}\n", json()));
    } else {
        print(&text());
    }
}

/// What the table cannot answer is bad input; the rest is a failure of the run.
fn failure(error: PredictionError) -> Failure {
    let hint = match &error {
        PredictionError::OutsideTable { .. } => Some("--extrapolate continues the table"),
        PredictionError::Lookup(LookupError::Missing { .. })
        | PredictionError::Separation(SeparationError::Lookup(LookupError::Missing { .. })) => {
            Some("--allow-missing interpolates where results lie on both sides")
        }
        PredictionError::Separation(SeparationError::NotFound { .. }) => {
            return Failure::Run(error.into());
        }
        _ => None,
    };
    match hint {
        Some(hint) => Failure::Input(anyhow!("{error} ({hint})")),
        None => input(error),
    }
}

fn check_folder(path: &Path) -> Result<(), Failure> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    if folder.is_dir() && !path.is_dir() {
        return Ok(());
    }
    let reason = if path.is_dir() { "it is a folder" } else { "its folder does not exist" };
    Err(input(anyhow!("cannot write {}: {reason}", path.display())))
}

fn thread_pool(options: &RunOptions) -> Result<rayon::ThreadPool, Failure> {
    let threads = options.threads.map_or(0, usize::from);
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .context("cannot start threads")
        .map_err(Failure::Run)
}

fn command_line() -> String {
    let mut words: Vec<String> = std::env::args().collect();
    // Where the binary lies says nothing about the result.
    words[0] = "roughsurface".into();
    words.join(" ")
}

/// Writes to stdout; a reader that has seen enough (`| head`) is no error.
fn print(text: &str) {
    let _ = std::io::stdout().write_all(text.as_bytes());
}

/// One line on stderr that counts.
struct Progress {
    shown: bool,
    terminal: bool,
    what: &'static str,
}

impl Progress {
    fn new(options: &RunOptions, what: &'static str) -> Self {
        let terminal = std::io::stderr().is_terminal();
        Self { shown: options.progress || (terminal && !options.quiet), terminal, what }
    }

    fn show(&self, done: usize, total: usize) {
        if !self.shown {
            return;
        }
        if self.terminal {
            eprint!("\r{done} of {total} {}", self.what);
        } else if done * 10 / total != (done - 1) * 10 / total {
            eprintln!("{done} of {total} {}", self.what);
        }
    }

    fn clear(&self) {
        if self.shown && self.terminal {
            eprint!("\r\x1b[K");
        }
    }
}
