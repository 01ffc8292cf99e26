//! Arguments and options of every subcommand.

use std::path::PathBuf;

use asperity::output::figures;
use asperity::studies::convergence;
use asperity::tabulate::Shard;
use clap::builder::{PathBufValueParser, PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand};
use tables::netcdf::input::number;
use tables::netcdf::program::{Printer, netcdf_name};

use super::outputs::TablePlot;
use super::{Failure, help, table};

/// Friction of one spherical elastic-plastic asperity on a rigid flat.
///
/// Presses the asperity, slides it with frictional and plastic heating, and reports static and
/// sliding friction with error estimates.
#[derive(Parser)]
#[command(name = "asperity", version, after_help = help::PROGRAM)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub(super) command: Command,
    #[command(flatten)]
    pub(super) display: Display,
}

/// What is printed.
#[derive(Args)]
pub(super) struct Display {
    /// Print the summary as JSON
    #[arg(long, global = true)]
    pub(super) json: bool,
    /// Print errors only (and the JSON with --json)
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    pub(super) quiet: bool,
    /// Print also the choices of the program, their reasons and their cost
    #[arg(short, long, global = true)]
    pub(super) verbose: bool,
    /// Show progress on stderr even if that is not a terminal
    #[arg(long, global = true, conflicts_with = "quiet")]
    pub(super) progress: bool,
}

impl Display {
    pub(super) fn printer(&self) -> Printer {
        Printer { json: self.json, quiet: self.quiet }
    }

    /// The result of a command; a failed one has the implausible values of its input with it, also where warnings are not
    /// printed: one of them may be the cause.
    pub(super) fn with_implausible(
        &self,
        implausible: impl FnOnce() -> Vec<String>,
        result: Result<(), Failure>,
    ) -> Result<(), Failure> {
        if result.is_err() && self.quiet {
            Printer { json: self.json, quiet: false }.warn(implausible());
        }
        result
    }
}

#[derive(Subcommand)]
pub(super) enum Command {
    /// Press and slide one asperity
    #[command(after_help = help::RUN)]
    Run(RunArguments),
    /// Run a grid of interferences and slip rates, at one or at several initial temperatures
    #[command(after_help = help::TABULATE)]
    Tabulate(TabulateArguments),
    /// Merge the shards of a table
    #[command(after_help = help::MERGE)]
    Merge(MergeArguments),
    /// Describe, compare, plot or export tables
    #[command(subcommand, after_help = help::TABLE)]
    Table(table::TableCommand),
    /// Run one scene on a sequence of meshes: computing time against error
    #[command(after_help = help::CONVERGENCE)]
    Convergence(ConvergenceArguments),
    /// Compare the model with closed forms, published fits and conservation laws
    ///
    /// Exit status 1 if a row fails.
    #[command(after_help = help::VERIFY)]
    Verify(VerifyArguments),
    /// Compare the error estimates with true errors in a study of many scenes
    #[command(alias = "honesty", after_help = help::EFFECTIVITY)]
    Effectivity(EffectivityArguments),
    /// Repeat the fits of constants and compare them with those in the program
    #[command(hide = true)]
    Calibrate,
    /// List the material presets, or print the constants of one with their sources
    Materials {
        /// Name of a preset
        name: Option<String>,
    },
    /// Print the completion script of a shell
    Completions {
        /// Shell to complete in
        shell: clap_complete::Shell,
    },
    /// Write the man pages
    Man {
        /// Folder to write them to, such as ~/.local/share/man/man1
        directory: PathBuf,
    },
}

#[derive(Args, Clone)]
pub(super) struct RunArguments {
    /// Scene to run
    #[arg(value_name = "SCENE.toml")]
    pub(super) scene: PathBuf,
    /// File to write the histories, scalars and contact fields to
    #[arg(short, long, value_name = "run.nc", value_parser = PathBufValueParser::new().try_map(netcdf_name))]
    pub(super) output: PathBuf,
    /// Replace a value of the scene; may be repeated
    #[arg(long, value_name = "section.key=value")]
    pub(super) set: Vec<String>,
    /// Number of threads [default: number of processors]; results do not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(super) threads: Option<u16>,
    /// Print the time by part of the computation on stderr, or in the JSON
    #[arg(long)]
    pub(super) timings: bool,
    /// Plot friction, forces, area, temperature and energies against slip, and status, pressure, shear,
    /// slip and temperature over the contact
    #[arg(long, value_name = "FILE.svg|png|pdf")]
    pub(super) plot: Option<PathBuf>,
    /// Only this panel of the plot, 85 mm wide; may be repeated
    #[arg(long, value_name = "NAME", requires = "plot", value_parser = PossibleValuesParser::new(figures::PANELS))]
    pub(super) panel: Vec<String>,
    /// Write displacement, stress, plastic strain and temperature of the body for ParaView; open
    /// DIR/body.pvd
    #[arg(long, value_name = "DIR")]
    pub(super) vtu: Option<PathBuf>,
    /// Write the whole body, not only the half that is simulated
    #[arg(long, requires = "vtu")]
    pub(super) vtu_whole: bool,
    /// Slips, in contact radii a0 and summed over the steps of a programme, at which fields are recorded in
    /// addition to the start of the slide, half slip, full slip and the end of each step
    #[arg(long, value_name = "SLIP,SLIP", value_delimiter = ',', allow_negative_numbers = true, value_parser = parse_slip)]
    pub(super) fields_at: Vec<f64>,
}

impl RunArguments {
    /// These arguments with outputs beside those given: `run.incomplete.nc` and so on.
    pub(super) fn of_incomplete(&self) -> Self {
        let beside = |path: &PathBuf| {
            let mut name = path.file_stem().unwrap_or_default().to_owned();
            name.push(".incomplete");
            if let Some(extension) = path.extension() {
                name.push(".");
                name.push(extension);
            }
            path.with_file_name(name)
        };
        let [plot, vtu] = [&self.plot, &self.vtu].map(|path| path.as_ref().map(beside));
        Self { output: beside(&self.output), plot, vtu, ..self.clone() }
    }
}

#[derive(Args)]
pub(super) struct TabulateArguments {
    /// Request to run
    #[arg(value_name = "REQUEST.toml")]
    pub(super) request: PathBuf,
    /// File to write the table to
    #[arg(short, long, value_name = "table.nc", value_parser = PathBufValueParser::new().try_map(netcdf_name))]
    pub(super) output: PathBuf,
    /// Replace a value of the request; may be repeated
    #[arg(long, value_name = "section.key=value")]
    pub(super) set: Vec<String>,
    /// Threads [default: number of processors]
    #[arg(long, visible_alias = "threads", value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(super) jobs: Option<u16>,
    /// Continue an interrupted tabulation; a complete table is left as it is
    #[arg(long)]
    pub(super) resume: bool,
    /// Run only the part K of N, for `asperity merge`
    #[arg(long, value_name = "K/N")]
    pub(super) shard: Option<Shard>,
    /// Print the time of all runs by part of the computation on stderr, or in the JSON
    #[arg(long)]
    pub(super) timings: bool,
    #[command(flatten)]
    pub(super) figure: TablePlot,
}

#[derive(Args)]
pub(super) struct ConvergenceArguments {
    /// Scene to run
    #[arg(value_name = "SCENE.toml")]
    pub(super) scene: PathBuf,
    /// File to write values, errors, estimates and times to
    #[arg(short, long, value_name = "report.nc", value_parser = PathBufValueParser::new().try_map(netcdf_name))]
    pub(super) output: PathBuf,
    /// Replace a value of the scene; may be repeated
    #[arg(long, value_name = "section.key=value")]
    pub(super) set: Vec<String>,
    /// Number of threads [default: number of processors]; results do not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(super) threads: Option<u16>,
    /// Elements per contact radius of the finest mesh, a multiple of 12
    #[arg(long, value_name = "N", default_value_t = FINEST, value_parser = clap::value_parser!(u16).range(12..=96))]
    pub(super) finest: u16,
    /// Plot errors against wall and processor time
    #[arg(long, value_name = "FILE.svg|png|pdf")]
    pub(super) plot: Option<PathBuf>,
    /// Only this panel of the plot, 85 mm wide; may be repeated
    #[arg(long, value_name = "NAME", requires = "plot", value_parser = PossibleValuesParser::new(convergence::PANELS))]
    pub(super) panel: Vec<String>,
}

/// See [`asperity::studies::convergence::FINEST`].
const FINEST: u16 = convergence::FINEST as u16;

#[derive(Args)]
pub(super) struct VerifyArguments {
    /// One case of each group on coarse meshes; with --robustness, the cases that the tests run
    #[arg(long)]
    pub(super) quick: bool,
    /// Run the robustness suite instead: cases at the limits of what can be simulated
    #[arg(long, alias = "hard")]
    pub(super) robustness: bool,
    /// Only the groups, or the cases of the robustness suite, whose name contains TEXT
    #[arg(long, value_name = "TEXT")]
    pub(super) only: Option<String>,
    /// Write every case of the robustness suite to DIRECTORY/NAME.nc, of failed ones the steps before the failure
    #[arg(long, value_name = "DIRECTORY", requires = "robustness")]
    pub(super) save: Option<PathBuf>,
}

impl VerifyArguments {
    /// The elements of `all` whose `name` contains the text of `--only`, in capitals or not; at least one.
    pub(super) fn chosen<T>(&self, all: Vec<T>, name: fn(&T) -> &str) -> Result<Vec<T>, Failure> {
        let Some(text) = &self.only else { return Ok(all) };
        let names: Vec<String> = all.iter().map(|one| name(one).to_owned()).collect();
        let has = |one: &T| name(one).to_lowercase().contains(&text.to_lowercase());
        let chosen: Vec<T> = all.into_iter().filter(has).collect();
        match chosen.is_empty() {
            true => Err(Failure::input(format!("--only: \"{text}\" is in none of: {}", names.join(", ")))),
            false => Ok(chosen),
        }
    }
}

#[derive(Args)]
pub(super) struct EffectivityArguments {
    /// Markdown file to write the result to
    #[arg(short, long, value_name = "effectivity.md")]
    pub(super) output: PathBuf,
    /// File of finished runs, which are not run again
    #[arg(long, value_name = "FILE.jsonl", default_value = "effectivity.jsonl")]
    pub(super) journal: PathBuf,
    /// Scenes to run, by number from 1, as in 1,4,7 [default: all]
    #[arg(long, value_name = "N,N...", value_delimiter = ',', value_parser = scene_number)]
    pub(super) scenes: Vec<usize>,
    /// Evaluate the runs of the journal without further runs
    #[arg(long)]
    pub(super) judge_only: bool,
}

fn scene_number(text: &str) -> Result<usize, String> {
    number(text, |number| *number >= 1, "scenes are numbered from 1")
}

#[derive(Args)]
pub(super) struct MergeArguments {
    /// Tables to merge
    #[arg(value_name = "SHARD.nc", required = true)]
    pub(super) shards: Vec<PathBuf>,
    /// File to write the table to
    #[arg(short, long, value_name = "table.nc", value_parser = PathBufValueParser::new().try_map(netcdf_name))]
    pub(super) output: PathBuf,
    /// Merge even if cells are missing; they stay "not run"
    #[arg(long)]
    pub(super) partial: bool,
    #[command(flatten)]
    pub(super) figure: TablePlot,
}

fn parse_slip(text: &str) -> Result<f64, String> {
    let rule = "must be slips of at least 0, in contact radii, separated by commas";
    number(text.trim(), |slip| *slip >= 0.0 && f64::is_finite(*slip), rule)
}
