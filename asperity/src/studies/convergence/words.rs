//! The sweep as text: a table, and the recommended mesh.

use super::{Convergence, Run, SHOWN};
use crate::scene::ELEMENTS_PER_RADIUS;
use tables::quantity::Quantity;

/// A row per run: cost, and for each quantity the error and in brackets its estimate, in per cent.
pub fn table(convergence: &Convergence) -> String {
    let mut text = format!("{:>5}{:>8}{:>9}{:>9}", "n_c", "steps", "wall s", "CPU s");
    for quantity in SHOWN {
        text += &format!("{:>16}", quantity.descriptor().name);
    }
    text.push('\n');
    for run in &convergence.runs {
        let Run { elements_per_radius, steps, wall_time, cpu_time, .. } = run;
        text += &format!("{elements_per_radius:>5}{steps:>8}{wall_time:>9.1}{cpu_time:>9.1}");
        for quantity in SHOWN {
            let (error, estimate) = convergence.errors(run, quantity);
            text += &format!("{:>16}", format!("{:.2} ({:.2})", 100.0 * error, 100.0 * estimate));
        }
        text.push_str(if run.chosen { "  as chosen\n" } else { "\n" });
    }
    text += &format!("{:>31}", "order");
    for quantity in SHOWN {
        let order = convergence.limit(quantity).order;
        text += &format!("{:>16}", order.map_or("-".to_owned(), |order| format!("{order:.1}")));
    }
    text.push_str("\nErrors in % of the limit, of the rise for temperatures; in brackets as estimated.\n");
    text
}

/// Compares the chosen mesh with the least expensive one that meets the accuracy.
pub fn in_words(convergence: &Convergence) -> String {
    let chosen = convergence.chosen();
    let accuracy = convergence.accuracy;
    let of = |run: &Run| 100.0 * convergence.worst_error(run);
    let mut text = format!(
        "As chosen, {} elements per contact radius: errors of mu, mu_static, Q, P and area, and that of G over \
         {}, are at most {:.2} % for {:.1} s of processor time; the accuracy is {:.2} %.\n",
        chosen.elements_per_radius,
        Quantity::EnergyRelease.allowance(),
        of(chosen),
        chosen.cpu_time,
        100.0 * accuracy
    );
    let sweep = &convergence.runs[..convergence.runs.len() - 1];
    let least_expensive = sweep
        .iter()
        .filter(|run| ELEMENTS_PER_RADIUS.contains(&run.elements_per_radius))
        .filter(|run| convergence.worst_error(run) <= accuracy)
        .min_by(|a, b| a.cpu_time.total_cmp(&b.cpu_time));
    let advice = match least_expensive {
        Some(run) if run.cpu_time < 0.8 * chosen.cpu_time => format!(
            "{} elements suffice: {:.2} % for {:.2} times the processor time.\n",
            run.elements_per_radius,
            of(run),
            run.cpu_time / chosen.cpu_time
        ),
        Some(run) if convergence.worst_error(chosen) > accuracy => format!(
            "{} elements are needed: {:.2} % for {:.1} times the processor time.\n",
            run.elements_per_radius,
            of(run),
            run.cpu_time / chosen.cpu_time
        ),
        Some(_) => "No mesh of the sweep meets the accuracy for much less.\n".to_owned(),
        None => "No mesh of the sweep meets the accuracy.\n".to_owned(),
    };
    text += &advice;
    let finest = sweep.last().expect("a sweep has runs");
    text + &format!(
        "Finest: {} elements have {:.2} % for {:.1} times the processor time of the choice.\n",
        finest.elements_per_radius,
        of(finest),
        finest.cpu_time / chosen.cpu_time
    )
}
