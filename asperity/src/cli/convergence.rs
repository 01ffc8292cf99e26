//! `asperity convergence`: speed against error of one scene.

use asperity::output::provenance;
use asperity::scene::file::read_scene;
use asperity::simulate::SimulationError;
use asperity::studies::convergence::{self, Convergence, DIVISOR, Limit, Run, SHOWN};
use serde_json::{Value, json};
use tables::quantity::Quantity;

use super::progress::watched;
use super::{ConvergenceArguments, Display, Failure, command_line, outputs, program};

/// Runs the sequence of meshes, writes the file and prints the least expensive mesh that meets the accuracy.
pub fn convergence(arguments: &ConvergenceArguments, display: &Display) -> Result<(), Failure> {
    let scene = read_scene(&arguments.scene, &arguments.set).map_err(Failure::input)?;
    let written = outputs::with_plots(&arguments.output, &arguments.plot);
    outputs::check_of_kind(convergence::TITLE, &[("the scene", &arguments.scene)], &written)?;
    let finest = usize::from(arguments.finest);
    if !finest.is_multiple_of(DIVISOR) {
        return Err(Failure::input(format!("--finest: {finest} is not a multiple of {DIVISOR}")));
    }
    display.printer().warn(scene.remarks());
    let result = watched(display, |progress| Convergence::sweep(&scene, finest, progress));
    let sweep = result.map_err(|error| match error {
        SimulationError::Unsupported(_) => Failure::input(error),
        error => Failure::run(error),
    })?;
    let history = provenance::history(&command_line());
    let saved = program::save(&arguments.output, |path| convergence::write(path, &scene, &sweep, &history));
    let drawn = outputs::draw(|| convergence::figure(&sweep), &arguments.panel, &arguments.plot);
    let printed = display
        .printer()
        .print(|| as_json(&sweep), || convergence::table(&sweep) + &convergence::in_words(&sweep));
    Failure::all([saved, drawn, printed])
}

fn as_json(sweep: &Convergence) -> Value {
    let limit = |quantity| {
        let Limit { value, uncertainty, order } = sweep.limit(quantity);
        json!({ "limit": value, "uncertainty": uncertainty, "order": order })
    };
    let run = |run: &Run| {
        let errors = |quantity| {
            let (error, estimate) = sweep.errors(run, quantity);
            json!({ "relative_error": error, "estimated": estimate })
        };
        json!({
            "chosen": run.chosen,
            "elements_per_radius": run.elements_per_radius,
            "sectors": run.sectors,
            "steps": run.steps,
            "wall_time": run.wall_time,
            "cpu_time": run.cpu_time,
            "errors": by_name(errors),
        })
    };
    let runs: Vec<Value> = sweep.runs.iter().map(run).collect();
    json!({ "accuracy": sweep.accuracy, "limits": by_name(limit), "runs": runs })
}

/// An entry for each quantity that is shown.
fn by_name(entry: impl Fn(Quantity) -> Value) -> Value {
    SHOWN.into_iter().map(|quantity| (quantity.descriptor().name, entry(quantity))).collect()
}
