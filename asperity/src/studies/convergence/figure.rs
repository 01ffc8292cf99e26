//! The picture of a sweep: true and estimated errors against wall and processor time.

use tables::figures::{Axis, Curve, Figure, Panel};

use super::{Convergence, Run, SHOWN};

/// Errors of all quantities against the cost; the chosen resolution as a point of its own.
pub fn figure(convergence: &Convergence) -> Figure {
    let panel = |title: &str, cost: fn(&Run) -> f64, label: &str, estimated: bool| {
        let (sweep, chosen) = convergence.runs.split_at(convergence.runs.len() - 1);
        let error = |run: &Run, quantity| {
            let (error, estimate) = convergence.errors(run, quantity);
            100.0 * if estimated { estimate } else { error }
        };
        let mut curves: Vec<Curve> = SHOWN
            .iter()
            .map(|&quantity| {
                let y = sweep.iter().map(|run| error(run, quantity)).collect();
                Curve::new(quantity.descriptor().name, sweep.iter().map(cost).collect(), y)
            })
            .collect();
        let worst = |run: &Run| 100.0 * convergence.worst_error(run);
        if !estimated {
            let y = chosen.iter().map(worst).collect();
            curves.push(Curve::new("as chosen, worst", chosen.iter().map(cost).collect(), y));
        }
        Panel {
            title: title.to_owned(),
            x: Axis::logarithmic(label),
            y: Axis::logarithmic(if estimated { "estimated error (%)" } else { "error (%)" }),
            curves,
        }
    };
    let wall: fn(&Run) -> f64 = |run| run.wall_time;
    let cpu: fn(&Run) -> f64 = |run| run.cpu_time;
    Figure {
        title: "Speed against error".to_owned(),
        panels: vec![
            panel("Against wall time", wall, "wall time (s)", false),
            panel("Against processor time", cpu, "processor time (s)", false),
            panel("As estimated", cpu, "processor time (s)", true),
        ],
    }
}
