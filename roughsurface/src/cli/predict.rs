//! `roughsurface predict`.

use super::common::*;
use super::input::InputOptions;
use super::progress::computed;
use clap::Args;
use clap::builder::{PathBufValueParser, PossibleValuesParser, TypedValueParser};
use roughsurface::friction::Settings;
use roughsurface::friction::regime::plasticity_index;
use roughsurface::friction::warning::Warning;
use roughsurface::output::figure::{PANELS, figure, panels};
use roughsurface::output::{Origin, Results, friction_file, report, summary, summary_json};
use roughsurface::sampling::case::Case;
use roughsurface::surface::file::query_key;
use roughsurface::surface::query::Surface;
use roughsurface::surface::units::SLIP_RATE;
use std::collections::BTreeMap;
use std::path::PathBuf;
use tables::closed_forms::NAMES;
use tables::figures::Figure;
use tables::law::AsperityLaw;
use tables::netcdf::input::number;
use tables::netcdf::streams::say;
use tables::numbers::plain;

pub const HELP: &str = "\
Examples:
  From a measured map to friction, with a table that comes with the program:
    roughsurface predict map.x3p --material steel-4340 --pressure 1e6 --slip-rate 0.1..10 -o friction.nc
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

Of a topography, friction is also predicted at half and at twice the cut-off, as far as its
points and its extent allow.

Not modelled: merging of contacts, interaction of asperities beyond their mean pressure, adhesion,
wear, fluid lubrication, third bodies (debris, gouge); a solid film is in the table, by the law of
its interface. The counterface is smooth; a table states what else it is (`asperity table info`).
That of shipped tables is rigid and conducts heat like the metal; of those called NAME-rigid it
stays at the initial temperature. In those called NAME-rate the strength grows with the strain
rate; they are exact for summits of a radius of 0.1 mm.

Above its last interference a table is extrapolated towards the fully plastic limit, with an error
that grows; the share of the load there is in the result. A pressure at which more than 0.1 % of
the load is on contacts larger than 0.4 radii of their asperities is refused unless --extrapolate
keeps their mean pressure and friction.";

#[derive(Args)]
pub struct Predict {
    #[command(flatten)]
    input: InputOptions,
    /// Response of steady sliding to a step of the slip rate, m/s or with units, such as 0.1..1; the contacts have the life --contact-life
    #[arg(long, value_name = "BEFORE..AFTER", value_parser = step)]
    rate_step: Option<[f64; 2]>,
    /// Result (netCDF)
    #[arg(short, long, value_name = "friction.nc", value_parser = PathBufValueParser::new().try_map(netcdf_name))]
    output: PathBuf,
    /// Plot of the result
    #[arg(long, value_name = "FILE.svg|png|pdf")]
    plot: Option<PathBuf>,
    /// Only this panel of the plot, 85 mm wide; may be repeated
    #[arg(long, value_name = "NAME", requires = "plot", value_parser = PossibleValuesParser::new(PANELS))]
    panel: Vec<String>,
    /// Models to compare with, separated by commas, or all
    #[arg(long, value_name = "MODELS", value_delimiter = ',', value_parser = models())]
    compare: Vec<String>,
    /// Report with figures, parameters, errors and warnings, one file for any browser
    #[arg(long, value_name = "FILE.html")]
    report: Option<PathBuf>,
    /// Relative error of integrals and pressures, 1e-6 unless given
    #[arg(long, value_name = "X", allow_negative_numbers = true, value_parser = tolerance)]
    tolerance: Option<f64>,
    #[command(flatten)]
    run: RunOptions,
}

const ALL: &str = "all";

fn models() -> PossibleValuesParser {
    PossibleValuesParser::new(NAMES.into_iter().chain([ALL]))
}

fn step(text: &str) -> Result<[f64; 2], String> {
    const FORM: &str = "must be two slip rates such as 0.1..1";
    let (before, after) = text.split_once("..").ok_or(FORM)?;
    let rates = SLIP_RATE.numbers(&[before, after], FORM)?;
    Ok([rates[0], rates[1]])
}

fn tolerance(text: &str) -> Result<f64, String> {
    number(text, |tolerance| (1e-12..=1e-3).contains(tolerance), "must lie between 1e-12 and 1e-3")
}

/// Reads, predicts, writes.
pub fn run(options: &Predict, display: &Display) -> Result<(), Failure> {
    let models = match options.compare.iter().any(|name| name == ALL) {
        true => NAMES.map(String::from).to_vec(),
        false => options.compare.clone(),
    };
    if let Some(plot) = &options.plot {
        Figure::check_extension(plot).map_err(Failure::input)?;
    }
    let outputs = [
        ("--output", Some(&*options.output)),
        ("--plot", options.plot.as_deref()),
        ("--report", options.report.as_deref()),
    ];
    let rate_step = options.rate_step.map(|[before, after]| {
        query_key("rate_step", BTreeMap::from([("before", before), ("after", after)]))
    });
    let case = options.input.read(&outputs, rate_step.into_iter().collect())?;
    check_kind(&options.output, friction_file::TITLE).map_err(Failure::input)?;
    Figure::check_panels(&options.panel, &panels(&case, &models)).map_err(Failure::input)?;
    // At once: the prediction may be refused for what they are about.
    let of_input = case.warnings();
    display.printer().warn(Warning::condensed(&of_input));
    let mut settings = Settings { extrapolate: options.input.extrapolate, ..Settings::default() };
    settings.tolerance = options.tolerance.unwrap_or(settings.tolerance);
    if display.verbose {
        describe(case.source.law.as_ref(), &case.file.surface);
        say(format!("note: at their defaults: {}", case.defaults_in_effect(&settings).join(", ")));
    }
    let started = std::time::Instant::now();
    let results = computed(&options.run, display, "slips", |show| case.predict(&models, &settings, show))?;
    let results = results.map_err(case_failure)?;
    if display.verbose {
        let slip = &results.prediction.slip;
        let (count, first, last) = (slip.len(), slip[1], slip[slip.len() - 1]);
        let seconds = started.elapsed().as_secs_f64();
        say(format!("{count} slips from {first:.3e} to {last:.3e} m in {seconds:.2} s"));
    }
    write(options, display, &results, &case, of_input.len())
}

fn describe(law: &dyn AsperityLaw, surface: &Surface) {
    let radius = surface.asperity_radius.mean();
    say(format!(
        "law {}: omega_c = {:.4e} m at R = {} m, plasticity index {:.3}, up to {} omega_c",
        law.name(),
        law.critical_interference(radius),
        plain(radius),
        plasticity_index(law, surface),
        law.interference_limit()
    ));
}

/// Writes the results and prints the summary with the warnings after those `said` before.
fn write(
    options: &Predict,
    display: &Display,
    results: &Results,
    case: &Case,
    said: usize,
) -> Result<(), Failure> {
    let origin = Origin { surface: &case.file.text, table: &case.table, history: &history() };
    let saved = save(&options.output, |path| friction_file::write(path, results, &origin));
    let drawn = options.plot.as_ref().map_or(Ok(()), |plot| {
        let figure = figure(results).only(&options.panel).map_err(Failure::run)?;
        save(plot, |path| figure.save(path))
    });
    let reported = options.report.as_ref().map_or(Ok(()), |report| {
        let page = report::html(results, &origin);
        save(report, |path| write_whole(path, page.as_bytes()))
    });
    display.printer().warn(Warning::condensed(&results.prediction.warnings[said..]));
    let printed = display.printer().print(|| summary_json::json(results), || summary::text(results));
    Failure::all([saved, drawn, reported, printed])
}
