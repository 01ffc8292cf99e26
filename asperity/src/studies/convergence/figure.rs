//! The picture of a sweep: true and estimated errors against wall and processor time.

use tables::figures::{Axis, Curve, Figure, Panel};

use super::{Convergence, Run, SHOWN};

/// Names of the panels.
pub const PANELS: [&str; 3] = ["wall-time", "processor-time", "estimates"];

/// Errors of all quantities against the cost; the chosen resolution as a point of its own.
pub fn figure(convergence: &Convergence) -> Figure {
    let panel = |name: &str, title: &str, cost: fn(&Run) -> f64, label: &str, estimated: bool| {
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
        let y = Axis::logarithmic(if estimated { "Estimated error (%)" } else { "Error (%)" });
        Panel::new(name, title, Axis::logarithmic(label), y, curves)
    };
    let wall: fn(&Run) -> f64 = |run| run.wall_time;
    let cpu: fn(&Run) -> f64 = |run| run.cpu_time;
    let panels = vec![
        panel(PANELS[0], "Against wall time", wall, "Wall time (s)", false),
        panel(PANELS[1], "Against processor time", cpu, "Processor time (s)", false),
        panel(PANELS[2], "As estimated", cpu, "Processor time (s)", true),
    ];
    Figure::new("Speed against error", panels)
}
