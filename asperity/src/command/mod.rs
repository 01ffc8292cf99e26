//! The command line: arguments, exit status, and one module per subcommand.

mod convergence;
mod hard;
mod honesty;
mod materials;
mod merge;
mod outputs;
mod progress;
mod run;
mod table;
mod tabulate;
mod timings;
mod verify;

use std::path::PathBuf;
use std::process::ExitCode;

use asperity::tabulate::Shard;
use clap::{Args, Parser, Subcommand};

const EXAMPLES: &str = "\
Examples:
  asperity run scene.toml -o run.nc
  asperity run scene.toml -o run.nc --set loading.slip_rate=10 --plot run.svg
  asperity tabulate request.toml -o table.nc --jobs 4
  asperity tabulate request.toml -o table.nc --resume
  asperity tabulate request.toml -o shard-2.nc --shard 2/3
  asperity merge shard-*.nc -o table.nc
  asperity table info table.nc
  asperity materials steel-4340

Exit status: 0 done, 1 a run failed (what could be saved is saved), 2 bad input or usage.";

const SCENE_EXAMPLE: &str = "\
Example of a scene (SI units, kelvin):
  [material]
  preset = \"steel-4340\"    # or every constant; `asperity materials` lists the presets
  [asperity]
  radius = 1e-3            # m
  [loading]
  interference = 20.0      # in units of the interference of first yield
  slip_rate = 1.0          # m/s; 0 is the isothermal limit
  [interface]              # optional
  strength = \"initial\"     # slip at strength_factor * sigma_Y(T)/sqrt(3) of the virgin material, or
                           # \"current\": at that of the hardened material under the contact
  strength_factor = 1.0
  [model]                  # optional
  kinematics = \"auto\"      # \"small\" strain, \"finite\" strain, or finite where the plastic strain of
                           # a coarse slide exceeds the accuracy asked for

youngs_modulus, specific_heat, thermal_conductivity and thermal_expansion (dL/L per kelvin at the
temperature) may be tables, linear in between and constant outside:
  thermal_conductivity = { temperature = [293.15, 1073.15], value = [53.3, 27.3] }    # K, W/(m K)

With one of these in [material] the energy G is also given as a share of the shear fracture energy:
  shear_fracture_energy (J/m2), fracture_toughness_mode_ii (Pa sqrt(m)), or tensile_strength (Pa)
  and uniform_elongation, from which it is estimated for a crack as large as the contact.

Examples:
  asperity run scene.toml -o run.nc
  asperity run scene.toml -o run.nc --set interface.law=coulomb --set interface.friction=0.3
  asperity run scene.toml -o run.nc --json --quiet > summary.json";

const REQUEST_EXAMPLE: &str = "\
A request is a scene with a section [table] in place of loading.interference and
loading.slip_rate:
  [table]
  interference = { from = 0.1, to = 100, points = 8, spacing = \"log\" }
  slip_rate = [0.1, 1.0, 10.0]    # m/s

Finished cells are kept in OUTPUT.part until the table is written; an interrupted
tabulation continues from there:
  asperity tabulate request.toml -o table.nc --jobs 4
  asperity tabulate request.toml -o table.nc --jobs 4 --resume

With table.tolerance, interferences and slip rates are added to those given until mu, mu_static,
Q and G interpolate with that relative error; table.max_cells (default 400) ends it earlier:
  asperity tabulate request.toml -o table.nc --set table.tolerance=0.02

In parts, on machines that need not know of each other:
  asperity tabulate request.toml -o shard-1.nc --shard 1/2
  asperity tabulate request.toml -o shard-2.nc --shard 2/2
  asperity merge shard-1.nc shard-2.nc -o table.nc";

const MERGE_EXAMPLE: &str = "\
The shards must be of the same request and made by the same build of the program; cells that
several of them have must agree. Nothing is written otherwise.

Example:
  asperity merge shard-*.nc -o table.nc --plot table.png";

const CONVERGENCE_EXAMPLE: &str = "\
The scene is run with 1/4, 1/3, 1/2, 2/3 and all of the elements per contact radius of --finest and the
increments that its accuracy asks for, and once as it is. Errors are against the limit that the meshes
show (Richardson extrapolation with the observed order).

Example:
  asperity convergence scene.toml -o report.nc --plot report.png";

const VERIFY_EXAMPLE: &str = "\
A hard case counts as solved if it converged, all its numbers are finite, its ledgers of energy and
heat close, and no contact is above its melting point. At least 95 % of the cases have to be solved,
or refused for a reason that the suite expects; exit status 1 otherwise.

Examples:
  asperity verify --quick
  asperity verify --json > verification.json
  asperity verify --hard --only rate --save runs";

const HONESTY_EXAMPLE: &str = "\
Each scene takes some minutes of processor time; the study may be interrupted and continued.

Examples:
  asperity honesty -o honesty.md
  asperity honesty -o honesty.md --scenes 1,2,3 -v
  asperity honesty -o honesty.md --judge-only";

const TABLE_EXAMPLE: &str = "\
Examples:
  asperity table info table.nc
  asperity table diff table.nc other.nc --tolerance 0.01
  asperity table plot table.nc -o table.png
  asperity table export table.nc -o table.csv";

/// Friction of one spherical elastic-plastic asperity on a rigid flat.
///
/// Presses the asperity, slides it with frictional and plastic heating, and reports static and
/// sliding friction with error estimates.
#[derive(Parser)]
#[command(name = "asperity", version, after_help = EXAMPLES)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    display: Display,
}

/// What is printed.
#[derive(Args)]
struct Display {
    /// Print the summary as JSON
    #[arg(long, global = true)]
    json: bool,
    /// Print nothing but errors (and the JSON, if asked for)
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// Print also what was chosen, why, and what it cost
    #[arg(short, long, global = true)]
    verbose: bool,
    /// Show progress on stderr even if that is not a terminal
    #[arg(long, global = true, conflicts_with = "quiet")]
    progress: bool,
}

#[derive(Subcommand)]
enum Command {
    /// Press and slide one asperity
    #[command(after_help = SCENE_EXAMPLE)]
    Run(RunArguments),
    /// Run a grid of interferences and slip rates
    #[command(after_help = REQUEST_EXAMPLE)]
    Tabulate(TabulateArguments),
    /// Put the shards of a table together
    #[command(after_help = MERGE_EXAMPLE)]
    Merge(MergeArguments),
    /// Describe, compare, plot or export tables
    #[command(subcommand, after_help = TABLE_EXAMPLE)]
    Table(table::TableCommand),
    /// Run one scene on ever finer meshes: speed against error
    #[command(after_help = CONVERGENCE_EXAMPLE)]
    Convergence(ConvergenceArguments),
    /// Compare the model with closed forms, published fits and conservation laws
    ///
    /// Exit status 1 if a row fails: if computed and reference differ by more than the estimated
    /// error of the computed value and what the two differ by by construction.
    #[command(after_help = VERIFY_EXAMPLE)]
    Verify(VerifyArguments),
    /// Compare the error estimates with true errors in a study of many scenes
    #[command(after_help = HONESTY_EXAMPLE)]
    Honesty(HonestyArguments),
    /// List the material presets, or print the constants of one with their sources
    Materials {
        /// Name of a preset
        name: Option<String>,
    },
}

#[derive(Args)]
struct RunArguments {
    /// Scene to run
    #[arg(value_name = "SCENE.toml")]
    scene: PathBuf,
    /// File to write the histories, scalars and contact fields to
    #[arg(short, long, value_name = "run.nc")]
    output: PathBuf,
    /// Replace a value of the scene; may be repeated
    #[arg(long, value_name = "section.key=value")]
    set: Vec<String>,
    /// Print where the time went on stderr, or in the JSON
    #[arg(long)]
    timings: bool,
    /// Plot friction, forces, area, temperature and energies against slip, and what sticks, pressure,
    /// shear and temperature over the contact
    #[arg(long, value_name = "FILE.svg|png")]
    plot: Option<PathBuf>,
    /// Write displacement, stress, plastic strain and temperature of the body for ParaView; open
    /// DIR/body.pvd
    #[arg(long, value_name = "DIR")]
    vtu: Option<PathBuf>,
    /// Write the whole body, not only the half that is simulated
    #[arg(long, requires = "vtu")]
    vtu_whole: bool,
    /// Slips, in contact radii a0, at which fields are kept, beside those before the slide, when half
    /// of the contact slips, at full slip and at the end
    #[arg(long, value_name = "SLIP,SLIP", value_delimiter = ',', value_parser = parse_slip)]
    fields_at: Vec<f64>,
}

#[derive(Args)]
struct TabulateArguments {
    /// Request to run
    #[arg(value_name = "REQUEST.toml")]
    request: PathBuf,
    /// File to write the table to
    #[arg(short, long, value_name = "table.nc")]
    output: PathBuf,
    /// Replace a value of the request; may be repeated
    #[arg(long, value_name = "section.key=value")]
    set: Vec<String>,
    /// Threads [default: as many as there are processors]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// Continue an interrupted tabulation
    #[arg(long)]
    resume: bool,
    /// Run the part K of N only, for `asperity merge`
    #[arg(long, value_name = "K/N")]
    shard: Option<Shard>,
    /// Print where the time of all runs went on stderr, or in the JSON
    #[arg(long)]
    timings: bool,
    /// Plot the table
    #[arg(long, value_name = "FILE.svg|png")]
    plot: Option<PathBuf>,
}

#[derive(Args)]
struct ConvergenceArguments {
    /// Scene to run
    #[arg(value_name = "SCENE.toml")]
    scene: PathBuf,
    /// File to write values, errors, estimates and times to
    #[arg(short, long, value_name = "report.nc")]
    output: PathBuf,
    /// Replace a value of the scene; may be repeated
    #[arg(long, value_name = "section.key=value")]
    set: Vec<String>,
    /// Elements per contact radius of the finest mesh, a multiple of 12
    #[arg(long, value_name = "N", default_value_t = FINEST, value_parser = clap::value_parser!(u16).range(12..=96))]
    finest: u16,
    /// Plot errors against wall and processor time
    #[arg(long, value_name = "FILE.svg|png")]
    plot: Option<PathBuf>,
}

/// See [`asperity::convergence::FINEST`].
const FINEST: u16 = asperity::convergence::FINEST as u16;

#[derive(Args)]
struct VerifyArguments {
    /// A case of each group, coarsely: under a minute; with --hard, the few that the tests run
    #[arg(long)]
    quick: bool,
    /// Run the suite of hard cases instead, and say how each ended
    #[arg(long)]
    hard: bool,
    /// Only the hard cases whose name has TEXT in it
    #[arg(long, value_name = "TEXT", requires = "hard")]
    only: Option<String>,
    /// Write every hard case, the failed ones as far as they came, to DIRECTORY/NAME.nc
    #[arg(long, value_name = "DIRECTORY", requires = "hard")]
    save: Option<PathBuf>,
}

#[derive(Args)]
struct HonestyArguments {
    /// Markdown file to write the result to
    #[arg(short, long, value_name = "honesty.md")]
    output: PathBuf,
    /// File of finished runs: what it holds is not run again
    #[arg(long, value_name = "FILE.jsonl", default_value = "honesty.jsonl")]
    journal: PathBuf,
    /// Scenes to run, by number from 1, as in 1,4,7 [default: all]
    #[arg(long, value_name = "N,N...", value_delimiter = ',', value_parser = scene_number)]
    scenes: Vec<usize>,
    /// Run also what tells the orders of convergence and the true error of the sectors
    #[arg(long)]
    thorough: bool,
    /// Run nothing; judge what the journal holds
    #[arg(long)]
    judge_only: bool,
}

fn scene_number(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(number) if number >= 1 => Ok(number),
        _ => Err("scenes are numbered from 1".into()),
    }
}

#[derive(Args)]
struct MergeArguments {
    /// Tables to put together
    #[arg(value_name = "SHARD.nc", required = true)]
    shards: Vec<PathBuf>,
    /// File to write the table to
    #[arg(short, long, value_name = "table.nc")]
    output: PathBuf,
    /// Merge also if cells are missing; they stay "not run"
    #[arg(long)]
    partial: bool,
    /// Plot the table
    #[arg(long, value_name = "FILE.svg|png")]
    plot: Option<PathBuf>,
}

/// Why a command did not do all that was asked.
enum Failure {
    /// Bad input or usage: nothing was done.
    Input(String),
    /// A run failed: what could be saved is saved.
    Run(String),
}

impl Failure {
    fn input(reason: impl ToString) -> Self {
        Self::Input(reason.to_string())
    }

    fn run(reason: impl ToString) -> Self {
        Self::Run(reason.to_string())
    }
}

fn parse_slip(text: &str) -> Result<f64, String> {
    match text.trim().parse() {
        Ok(slip) if slip >= 0.0 && f64::is_finite(slip) => Ok(slip),
        _ => Err("must be slips of at least 0, in contact radii, with commas between".into()),
    }
}

/// Read the arguments and do what they say.
pub fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let display = &arguments.display;
    let work = || match &arguments.command {
        Command::Run(arguments) => run::run(arguments, display),
        Command::Tabulate(arguments) => tabulate::tabulate(arguments, display),
        Command::Merge(arguments) => merge::merge(arguments, display),
        Command::Table(command) => table::table(command, display),
        Command::Convergence(arguments) => convergence::convergence(arguments, display),
        Command::Verify(arguments) => verify::verify(arguments, display),
        Command::Honesty(arguments) => honesty::honesty(arguments, display),
        Command::Materials { name } => materials::materials(name.as_deref(), display),
    };
    let (status, reason) = match std::panic::catch_unwind(work) {
        Ok(Ok(())) => return ExitCode::SUCCESS,
        Ok(Err(Failure::Run(reason))) => (1, reason),
        Ok(Err(Failure::Input(reason))) => (2, reason),
        Err(_) => (1, "internal error, described above; please report it".into()),
    };
    eprintln!("error: {reason}");
    ExitCode::from(status)
}

/// Write to stdout; a reader that has gone away is no error of ours.
fn print(text: &str) {
    use std::io::Write;
    let _ = std::io::stdout().write_all(text.as_bytes());
}

/// The command as given, for the history of the files that it writes.
fn command_line() -> String {
    let arguments = std::env::args_os().skip(1).map(|argument| {
        let argument = argument.to_string_lossy().into_owned();
        match argument.contains(char::is_whitespace) {
            true => format!("'{argument}'"),
            false => argument,
        }
    });
    std::iter::once("asperity".to_owned()).chain(arguments).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn arguments_are_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn options_may_stand_before_or_after_the_subcommand() {
        for line in [
            "asperity --json run scene.toml -o run.nc",
            "asperity run scene.toml -o run.nc --json --set a.b=1 --set a.c=2",
        ] {
            assert!(Arguments::try_parse_from(line.split(' ')).unwrap().display.json);
        }
        for line in [
            "asperity run scene.toml",
            "asperity tabulate r.toml -o t.nc --jobs 0",
            "asperity run scene.toml -o run.nc --quiet -v",
        ] {
            assert!(Arguments::try_parse_from(line.split(' ')).is_err(), "{line}");
        }
    }
}
