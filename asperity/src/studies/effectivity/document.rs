//! The study as a document in Markdown.

use std::fmt::Write;

use super::report::{EFFECTIVE, JUDGED, NEGLIGIBLE, QuantityReport, Report};
use super::{WORKING_ELEMENTS, scenes};

/// What was found, over quantities and over scenes.
pub fn markdown(report: &Report) -> String {
    let mut text = format!(
        "# Effectivity of the error estimates\n\n\
         Written by `asperity effectivity --output FILE`. The runs are kept in its journal, so that the study can be\n\
         interrupted, continued and judged anew (`--judge-only`). {} of {} scenes are judged, at\n\
         {WORKING_ELEMENTS} elements per contact radius and otherwise as the default accuracy chooses.\n\n\
         True errors are against runs with four times the elements, a quarter of the increments and twice the\n\
         angles, each alone, extrapolated with order 1.5 in the elements and 1 in the increments. An estimate is\n\
         *effective* if the true error is between {} and {} times the estimate, or both are below {} % of the value. The\n\
         *coverage* is the share of true errors of at most {} times the estimate.\n\n",
        report.scenes.len(),
        scenes::SCENES.len(),
        EFFECTIVE.0,
        EFFECTIVE.1,
        100.0 * NEGLIGIBLE,
        EFFECTIVE.1,
    );
    let parts = [
        (
            0..scenes::SEEN,
            "Scenes used for two constants of the estimates",
            "the share of the contact edge, chosen among three, and the order in the elements of friction below first yield",
        ),
        (scenes::SEEN..scenes::SCENES.len(), "Scenes used for no constant", "five other materials"),
    ];
    for (positions, title, remark) in parts {
        let part = report.part(positions);
        if part.scenes.is_empty() {
            continue;
        }
        // Writing to a String cannot fail.
        let _ = writeln!(text, "## {title}\n\n({remark})\n");
        summary(&part, &mut text);
        scene_table(&part, &mut text);
    }
    if !report.missing.is_empty() {
        text.push_str("Not judged:\n\n");
    }
    for (scene, reason) in &report.missing {
        let (preset, interference, slip_rate) = scenes::SCENES[*scene];
        let _ = writeln!(text, "- {}: {reason}", scenes::name(preset, interference, slip_rate));
    }
    text
}

fn summary(report: &Report, text: &mut String) {
    let _ = writeln!(
        text,
        "**{:.0} % of the estimates are effective; the coverage is {:.0} %.**\n\n\
         The accuracy is asked of the worst of `mu`, `mu_static`, `Q`, `P` and `area` of a scene: in {} of {} scenes\n\
         the largest true error is between {} and {} times the largest estimate, which may be that of another quantity.\n",
        100.0 * report.share(),
        100.0 * report.covered(),
        report.effective_scenes(),
        report.scenes.len(),
        EFFECTIVE.0,
        EFFECTIVE.1,
    );
    text.push_str(
        "Mean and mean size of the true errors in % of the value; share of true errors no larger than the estimate; true \
         error over its estimate:\n\n\
         | quantity | mean | mean size | covered | effective | least | median | largest |\n|---|---|---|---|---|---|---|---|\n",
    );
    for quantity in JUDGED {
        let QuantityReport { bias, size, share, covered, ratios: [least, median, largest], .. } =
            report.of(quantity);
        let name = quantity.descriptor().name;
        let [bias, size, share, covered] = [bias, size, share, covered].map(|part| 100.0 * part);
        let _ = writeln!(
            text,
            "| {name} | {bias:+.2} | {size:.2} | {covered:.0} % | {share:.0} % | {least:.2} | {median:.2} | {largest:.2} |"
        );
    }
}

fn scene_table(report: &Report, text: &mut String) {
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
            let mark = if judged.is_effective() { "" } else { " !" };
            let _ = write!(text, " {error:+.2} ({estimate:.2}){mark} |");
        }
        text.push('\n');
    }
    text.push('\n');
}
