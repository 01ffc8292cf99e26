//! `asperity run`: one scene, one file, a summary.

use std::collections::BTreeSet;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use std::time::Instant;

use asperity::loading::recording::Recording;
use asperity::output::revolved::Extent;
use asperity::output::run_file::{self, About};
use asperity::output::{figures, provenance, vtu};
use asperity::scene::Scene;
use asperity::scene::file::read_scene;
use asperity::simulate::derived;
use asperity::simulate::expected_time::expected_time;
use asperity::simulate::outcome::{Account, ErrorSource, Kernel, Outcome, Warning};
use asperity::simulate::{SimulationError, simulate_recorded};
use serde_json::{Value, json};
use tables::netcdf::streams::say;
use tables::netcdf::{DatasetReader, check_distinct, destination};
use tables::numbers;
use tables::quantity::Quantity;

use super::progress::{tell_expected_time, watched};
use super::{Display, Failure, RunArguments, command_line, outputs, program, timings};

/// Run the scene, write the results, also those before a failure, and print a summary.
pub fn run(arguments: &RunArguments, display: &Display) -> Result<(), Failure> {
    let scene = read_scene(&arguments.scene, &arguments.set).map_err(Failure::input)?;
    display.with_implausible(|| scene.implausible(), run_scene(&scene, arguments, display))
}

fn run_scene(scene: &Scene, arguments: &RunArguments, display: &Display) -> Result<(), Failure> {
    let end = scene.loading.slip_distance;
    if let Some(beyond) = arguments.fields_at.iter().find(|slip| **slip > end) {
        return Err(Failure::Input(format!(
            "--fields-at {}: the slide ends after a slip of {} contact radii (loading.slip_distance or steps)",
            numbers::plain(*beyond),
            numbers::plain(end)
        )));
    }
    check_outputs(arguments)?;
    outputs::check_panels(&arguments.panel, &figures::panels(scene))?;
    display.printer().warn(scene.remarks());
    if !display.quiet {
        tell_expected_time(expected_time(scene));
    }
    let recording = Recording { slips: arguments.fields_at.clone(), body: arguments.vtu.is_some() };
    let result = watched(display, |progress| simulate_recorded(scene, &recording, progress));
    let (mut outcome, failure) = match result {
        Ok(outcome) => (outcome, None),
        Err(error) => {
            let reason = error.to_string();
            match error {
                SimulationError::Unsupported(_) => return Err(Failure::Input(reason)),
                SimulationError::NotConverged { partial: Some(outcome), .. }
                | SimulationError::Cancelled { partial: Some(outcome) } => (*outcome, Some(reason)),
                _ => {
                    let no_file = "there are no results yet, and no file is written";
                    return Err(Failure::Run(format!("{reason}; {no_file}")));
                }
            }
        }
    };
    outcome.account.add_scene(scene);
    let target = match failure.is_some() && holds_complete_run(&arguments.output) {
        true => &arguments.of_incomplete(),
        false => arguments,
    };
    let reported = report(scene, &outcome, failure.as_deref(), target, display);
    match failure {
        None => reported,
        Some(reason) if reported.is_ok() => Err(Failure::Run(format!(
            "{reason}; the results so far are in {}; a run cannot be continued, only repeated",
            target.output.display()
        ))),
        Some(reason) => Failure::all([Err(Failure::Run(reason)), reported]),
    }
}

/// Whether there is the file of a complete run, which an incomplete one shall not replace.
fn holds_complete_run(output: &Path) -> bool {
    let completion = DatasetReader::open(output).and_then(|file| file.attribute_text("completion"));
    completion.is_ok_and(|completion| completion == run_file::COMPLETE)
}

fn check_outputs(arguments: &RunArguments) -> Result<(), Failure> {
    let inputs = [("the scene", arguments.scene.as_path())];
    let written = outputs::with_plots(&arguments.output, &arguments.plot);
    let check = || outputs::check_of_kind(run_file::TITLE, &inputs, &written);
    let Some(directory) = &arguments.vtu else { return check() };
    let files = files_of_vtu(directory, inputs.iter().chain(&written).map(|(_, path)| *path));
    let mut all = [&written[..], &[("--vtu", directory.as_path())]].concat();
    all.extend(files.iter().map(|file| ("a file of --vtu", file.as_path())));
    check_distinct(&inputs, &all).map_err(Failure::input)?;
    check()?;
    outputs::check_directory(directory)
}

/// The files of `--vtu` that are known before the run: the collection, numbered files of the directory, and those that
/// would have the name of one of the `others`.
fn files_of_vtu<'a>(directory: &Path, others: impl Iterator<Item = &'a Path>) -> Vec<PathBuf> {
    let names = others.filter_map(|path| destination(path).file_name().map(OsStr::to_owned));
    let entries = std::fs::read_dir(directory).into_iter().flatten().flatten().map(|entry| entry.file_name());
    let numbered: BTreeSet<OsString> = names.chain(entries).filter(|name| vtu::is_numbered(name)).collect();
    std::iter::once(vtu::COLLECTION.into()).chain(numbered).map(|name| directory.join(name)).collect()
}

fn report(
    scene: &Scene,
    outcome: &Outcome,
    incomplete: Option<&str>,
    arguments: &RunArguments,
    display: &Display,
) -> Result<(), Failure> {
    let about = About { history: provenance::history(&command_line()), incomplete };
    let started = Instant::now();
    let saved = program::save(&arguments.output, |path| run_file::write(path, scene, outcome, &about));
    let drawn = outputs::draw(|| figures::run_figure(scene, outcome), &arguments.panel, &arguments.plot);
    let extent = if arguments.vtu_whole { Extent::Whole } else { Extent::Half };
    let body = arguments.vtu.as_ref().map_or(Ok(()), |directory| {
        program::save(directory, |path| vtu::write(path, outcome, extent).map(drop))
    });
    let mut spent = outcome.account.timings;
    spent.since(Kernel::Output, started);
    // Results are printed even if the disk is full.
    // Those about the scene were printed before the run.
    display
        .printer()
        .warn(outcome.account.warnings.iter().filter(|warning| !matches!(warning, Warning::Scene(_))));
    if display.verbose {
        say(account(outcome).trim_end());
    }
    if arguments.timings && !display.json {
        say(iterations(&outcome.account));
        say(timings::as_text(&spent).trim_end());
    }
    let json = || {
        let mut json = as_json(scene, outcome, incomplete, arguments);
        if arguments.timings {
            json["timings"] = timings::as_json(&spent);
        }
        json
    };
    let printed = display.printer().print(json, || summary(scene, outcome, incomplete));
    Failure::all([saved, drawn, body, printed])
}

fn summary(scene: &Scene, outcome: &Outcome, incomplete: Option<&str>) -> String {
    let mut text = String::new();
    let mut line = |name: &str, value: String| text += &format!("{name:17} {value}\n");
    if let Some(reason) = incomplete {
        let values = match outcome.account.warnings.contains(&Warning::StoppedBeforeFurtherRun) {
            true => "the slide is complete, a further run of it is missing",
            false => "the values are those of the last state",
        };
        line("completion", format!("incomplete: {reason}; {values}"));
    }
    let interference = outcome.interference;
    let length = numbers::digits(interference * outcome.critical_interference, 4);
    line("interference", format!("{} omega_c, {length} m", numbers::plain(interference)));
    match &scene.loading.steps[..] {
        [] => line("slip_rate", format!("{} m/s", numbers::plain(scene.loading.slip_rate))),
        steps => line("steps", steps.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")),
    }
    line("radius", format!("{} m", numbers::plain(scene.radius)));
    for (name, unit, _, estimate) in derived::all_scalars(scene, outcome) {
        line(name, numbers::with_error(estimate, unit));
    }
    line("inception", outcome.inception.to_string());
    line("levelled", if outcome.steady { "yes" } else { "no" }.into());
    line("wall_time", format!("{:.1} s", outcome.account.wall_time));
    text
}

/// Iterations of the main run and its press.
fn iterations(account: &Account) -> String {
    format!(
        "steps: {}, cut back {} times; {} Newton iterations, {} of them of the press and {} with a line search; {} Krylov \
         iterations",
        account.steps,
        account.cutbacks,
        account.newton_iterations,
        account.press_newton_iterations,
        account.line_searches,
        account.krylov_iterations,
    )
}

fn account(outcome: &Outcome) -> String {
    let account = &outcome.account;
    let mut text = format!(
        "mesh: {} elements per contact radius, {} sectors, {} unknowns\n\
         {}\n\
         heat: {}; strain: {}\n",
        account.elements_per_radius,
        account.sectors,
        account.unknowns,
        iterations(account),
        if account.heat { "simulated" } else { "left out" },
        if account.finite_strain { "finite" } else { "small" },
    );
    text += &format!(
        "errors in %:{:12}{:>8}{:>8}{:>8}{:>8}{:>8}\n",
        "", "mesh", "sectors", "steps", "solver", "model"
    );
    for quantity in Quantity::SCALARS {
        let value = outcome.scalars[quantity].value.abs();
        text += &format!("  {:20}", quantity.descriptor().name);
        for source in ErrorSource::ALL {
            let part = 100.0 * outcome.budget.part(source, quantity) / value;
            let part = match part {
                // The value is zero or a rounding error.
                1000.0.. => ">999".into(),
                part if part.is_nan() => "-".into(),
                part => format!("{part:.3}"),
            };
            text += &format!("{part:>8}");
        }
        text.push('\n');
    }
    for note in &account.notes {
        text += &format!("note: {note}\n");
    }
    text
}

fn as_json(scene: &Scene, outcome: &Outcome, incomplete: Option<&str>, arguments: &RunArguments) -> Value {
    let scalars = derived::all_scalars(scene, outcome);
    let summary: Value =
        scalars.map(|(name, unit, _, estimate)| (name, json!(estimate.in_unit(unit)))).collect();
    let account = &outcome.account;
    json!({
        "output": arguments.output.display().to_string(),
        "completion": incomplete.unwrap_or("complete"),
        "interference": outcome.interference,
        "slip_rate": scene.loading.slip_rate,
        "steps": scene.loading.steps,
        "radius": scene.radius,
        "heat_partition": outcome.scalars[Quantity::HeatPartition].value,
        "summary": summary,
        "inception": outcome.inception.to_string(),
        "levelled": outcome.steady,
        "notes": account.notes,
        "warnings": account.warnings,
        "account": account,
    })
}
