//! `asperity convergence`: speed against error of one scene.

use asperity::output::provenance;
use asperity::scene::file::read_scene;
use asperity::simulate::SimulationError;
use asperity::studies::convergence::{self, Convergence, DIVISOR, SHOWN};
use serde_json::json;

use super::progress::watched;
use super::{ConvergenceArguments, Display, Failure, command_line, outputs, program};

/// Runs the sequence of meshes, writes the file and prints the least expensive mesh that meets the accuracy.
pub fn convergence(arguments: &ConvergenceArguments, display: &Display) -> Result<(), Failure> {
    let scene = read_scene(&arguments.scene, &arguments.set).map_err(Failure::input)?;
    let written = outputs::with_plots(&arguments.output, &arguments.plot);
    outputs::check(&[("the scene", &arguments.scene)], &written)?;
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

fn as_json(sweep: &Convergence) -> serde_json::Value {
    let limits: serde_json::Map<_, _> = SHOWN
        .iter()
        .map(|&quantity| {
            let limit = sweep.limit(quantity);
            let value = json!({ "limit": limit.value, "doubt": limit.uncertainty, "order": limit.order });
            (quantity.descriptor().name.to_owned(), value)
        })
        .collect();
    let runs: Vec<_> = sweep
        .runs
        .iter()
        .map(|run| {
            let errors: serde_json::Map<_, _> = SHOWN
                .iter()
                .map(|&quantity| {
                    let (error, estimate) = sweep.errors(run, quantity);
                    let value = json!({ "relative_error": error, "estimated": estimate });
                    (quantity.descriptor().name.to_owned(), value)
                })
                .collect();
            json!({
                "chosen": run.chosen,
                "elements_per_radius": run.elements_per_radius,
                "sectors": run.sectors,
                "steps": run.steps,
                "wall_time": run.wall_time,
                "cpu_time": run.cpu_time,
                "errors": errors,
            })
        })
        .collect();
    json!({ "accuracy": sweep.accuracy, "limits": limits, "runs": runs })
}
