//! Time by part of the computation, as text and as JSON.

use asperity::solver::timings::{Kernel, Timings};
use serde_json::{Value, json};

/// One line for each part, in seconds and in shares of the total.
pub fn as_text(timings: &Timings) -> String {
    let total = timings.total();
    let mut text = String::new();
    let mut line = |name: &str, seconds: f64| {
        let share = if total > 0.0 { 100.0 * seconds / total } else { 0.0 };
        text += &format!("{name:24}{seconds:>10.3} s{share:>7.1} %\n");
    };
    for kernel in Kernel::ALL {
        line(kernel.name(), timings.of(kernel));
    }
    line("total", total);
    line("main run alone", timings.main_run());
    text
}

/// Seconds by part.
pub fn as_json(timings: &Timings) -> Value {
    let parts: Value = Kernel::ALL.into_iter().map(|kernel| (kernel.name(), timings.of(kernel))).collect();
    json!({ "parts": parts, "total": timings.total(), "main_run": timings.main_run() })
}
