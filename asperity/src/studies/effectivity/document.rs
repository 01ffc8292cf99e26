//! The study as a document in Markdown.

use tables::quantity::Quantity;

use super::report::{NEGLIGIBLE, QuantityReport, Report};
use super::{ELEMENTS, SECTORS, STEPS, scenes};

const SHORT: &str = "Slides by two contact radii against an isothermal flat.";
const AS_IN_TABLES: &str = "\
Slides by 20 contact radii (titanium 10) against a rigid body of the same metal that conducts heat, R = 1 mm. A third of the\n\
scenes of metals with published constants have their rate law, a fifth hold the load. Quantities that a run does not determine are left out (–). Of `mu_steady`, whose slide goes on, and\n\
`G_weakening`, which is close to 0 at low slip rates, nothing is said. The first half is used for constants of static friction,\n\
load and slip at inception above 1 ω_c and for the corrections of load and area, the 33 scenes above 10 ω_c for those of `G`,\n\
`inception_slip` and `mu_static`.";

/// The results of the study over quantities and over scenes, as Markdown.
pub fn markdown(report: &Report) -> String {
    let mut text = format!(
        "# Effectivity of the error estimates\n\n\
         Written by `asperity effectivity --output FILE`. The runs are kept in its journal, so that the study can be\n\
         interrupted, continued and judged anew (`--judge-only`). {} of {} scenes are judged: slides at\n\
         the default accuracy with interference (ω) or load (P) held. The strain measure is that which the program chooses,\n\
         or finite strain where the scene says so.\n\n\
         The reference value is that of a single run at the first resolution of the default accuracy, corrected by the\n\
         effects of {ELEMENTS} times the elements, {SECTORS} times the angles and 1/{STEPS} of the increments, each alone,\n\
         extrapolated with order 1.5 in the elements and 1 in the increments. The *true error* is the reported value less\n\
         the reference. It is *covered* if it is no larger than the reported error, or below {} % of the value (of the rise,\n\
         for temperatures).\n\n",
        report.scenes.len(),
        scenes::COUNT,
        100.0 * NEGLIGIBLE,
    );
    let parts = [
        (0..scenes::USED, "Scenes used for constants of the estimates", SHORT),
        (scenes::USED..scenes::SHORT, "Scenes used for no constant", SHORT),
        (scenes::SHORT..scenes::COUNT, "Scenes like those of the shipped tables", AS_IN_TABLES),
    ];
    for (positions, title, what) in parts {
        let judged = scenes::study_scene(positions.start).judged();
        let part = report.part(positions);
        if part.scenes.is_empty() {
            continue;
        }
        text += &format!("## {title}\n\n{what}\n\n");
        text += &summary(&part, judged);
        text += &scene_table(&part, judged);
    }
    if !report.missing.is_empty() {
        text.push_str("Not judged:\n\n");
    }
    for (scene, reason) in &report.missing {
        text += &format!("- {}: {reason}\n", scenes::study_scene(*scene).name());
    }
    text
}

fn summary(report: &Report, judged: &[Quantity]) -> String {
    let mut text = format!(
        "**{} scenes: the reported errors cover {:.1} % of the true errors.**\n\n\
         True errors in % of the value: mean, mean size, median size, size that nine of ten do not exceed; median of the\n\
         reported errors in %; share covered; median, 95th percentile and largest of true over reported error:\n\n\
         | quantity | mean | mean size | median | nine of ten | reported | covered | median ratio | 95 % | largest |\n\
         |---|---|---|---|---|---|---|---|---|---|\n",
        report.scenes.len(),
        100.0 * report.covered(),
    );
    for &quantity in judged {
        let QuantityReport { bias, size, sizes, stated, covered, ratios: [median, high, largest] } =
            report.of(quantity);
        let name = quantity.descriptor().name;
        let [bias, size, middle, most, stated, covered] =
            [bias, size, sizes[0], sizes[1], stated, covered].map(|share| 100.0 * share);
        text += &format!(
            "| {name} | {bias:+.2} | {size:.2} | {middle:.2} | {most:.2} | {stated:.2} | {covered:.0} % | \
             {median:.2} | {high:.2} | {largest:.2} |\n"
        );
    }
    text
}

fn scene_table(report: &Report, judged: &[Quantity]) -> String {
    let mut text = String::from(
        "\nTrue error in % (in brackets as reported; of the rise, for temperatures); ! marks one that is not covered:\n\n\
         | scene |",
    );
    for &quantity in judged {
        text += &format!(" {} |", quantity.descriptor().name);
    }
    text += &format!("\n|---|{}\n", "---|".repeat(judged.len()));
    for scene in &report.scenes {
        text += &format!("| {} |", scenes::study_scene(scene.scene).name());
        for &quantity in judged {
            let Some(judged) = scene.judged.iter().find(|judged| judged.quantity == quantity) else {
                text += " – |";
                continue;
            };
            let [error, stated] = [judged.error(), judged.stated].map(|x| 100.0 * x / judged.scale);
            let mark = if judged.is_covered() { "" } else { " !" };
            text += &format!(" {error:+.2} ({stated:.2}){mark} |");
        }
        text.push('\n');
    }
    text + "\n"
}
