//! The study as a document in Markdown.

use std::fmt::Write;

use super::report::{HONEST, JUDGED, NEGLIGIBLE, QuantityReport, Report};
use super::{WORKING_ELEMENTS, scenes};

/// What was found, over quantities and over scenes.
pub fn markdown(report: &Report) -> String {
    let mut text = format!(
        "# Are the error estimates honest?\n\n\
         Written by `asperity honesty --output FILE`; the runs are kept in its journal, so that the study can\n\
         be interrupted, continued and judged anew (`--judge-only`). {} of {} scenes are judged, at\n\
         {WORKING_ELEMENTS} elements per contact radius and otherwise as the default accuracy chooses.\n\n\
         True errors are against runs with two (some: three) times the elements, a quarter of the increments\n\
         and twice the angles, each alone, extrapolated with order 1.5 in the elements and 1 in the\n\
         increments. They are themselves known to about a quarter. Honest is a true error between {}\n\
         and {} times the estimate, or both below {} % of the value.\n\
         One constant of the estimates, that of the contact edge, was chosen among three by these same\n\
         scenes; the others were not.\n\n\
         **{:.0} % of the estimates are honest; {:.0} % of the true errors are at most {} times the estimate.**\n\n",
        report.scenes.len(),
        scenes::SCENES.len(),
        HONEST.0,
        HONEST.1,
        100.0 * NEGLIGIBLE,
        100.0 * report.share(),
        100.0 * report.covered(),
        HONEST.1,
    );
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "What `accuracy` is about is the worst of `mu`, `mu_static`, `Q`, `P` and `area` of a scene: in {} of {} scenes\n\
         the largest true error is between {} and {} times the largest estimate, which may be that of another quantity.\n",
        report.honest_scenes(),
        report.scenes.len(),
        HONEST.0,
        HONEST.1,
    );
    text.push_str("True error over its estimate:\n\n| quantity | honest | least | median | largest |\n|---|---|---|---|---|\n");
    for quantity in JUDGED {
        let QuantityReport { share, ratios: [least, median, largest], .. } = report.of(quantity);
        let name = quantity.descriptor().name;
        let percent = 100.0 * share;
        let _ = writeln!(text, "| {name} | {percent:.0} % | {least:.2} | {median:.2} | {largest:.2} |");
    }
    text.push_str(
        "\nTrue error in % (in brackets as estimated; of the rise, for temperatures):\n\n| scene |",
    );
    for quantity in JUDGED {
        let _ = write!(text, " {} |", quantity.descriptor().name);
    }
    text.push_str("\n|---|");
    text.push_str(&"---|".repeat(JUDGED.len()));
    text.push('\n');
    for scene in &report.scenes {
        let (preset, interference, slip_rate) = scenes::SCENES[scene.scene];
        let _ = write!(text, "| {} |", scenes::name(preset, interference, slip_rate));
        for judged in &scene.judged {
            let [error, estimate] = [judged.error(), judged.estimate()].map(|x| 100.0 * x / judged.scale);
            let mark = if judged.is_honest() { "" } else { " !" };
            let _ = write!(text, " {error:+.2} ({estimate:.2}){mark} |");
        }
        text.push('\n');
    }
    if !report.missing.is_empty() {
        text.push_str("\nNot judged:\n\n");
    }
    for (scene, reason) in &report.missing {
        let (preset, interference, slip_rate) = scenes::SCENES[*scene];
        let _ = writeln!(text, "- {}: {reason}", scenes::name(preset, interference, slip_rate));
    }
    text
}
