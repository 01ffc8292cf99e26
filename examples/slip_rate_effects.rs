//! What the slip rate changes on a rigid flat at the initial temperature, from the shipped tables: static friction, sliding
//! friction and its parts, and the energy released at sliding inception beside the shear fracture energy. Beside them the
//! fall of sliding friction on a body of the same metal that conducts heat.
//!
//! No simulation. Sliding friction is μ = τ̄ A/P with the mean friction stress τ̄ = Q/A, so that its fall from the isothermal
//! limit to the highest slip rate has three parts, ln μ = ln τ̄ + ln A − ln P: strength, area and load. Prints them for each
//! interference of the 4340 table and draws them.
//!
//!     cargo run --release -p examples --example slip_rate_effects [FIGURE.svg]

use std::path::Path;

use asperity::scene::file::parse_scene;
use asperity::simulate::fracture::fracture_energy;
use tables::figures::{Axis, Curve, Figure, Panel};
use tables::quantity::{Estimate, Quantity};
use tables::shipped;
use tables::table::Slice;

/// Interferences whose friction is drawn over the slip rate.
const ROWS: [f64; 4] = [1.2, 8.0, 32.0, 250.0];

fn main() -> anyhow::Result<()> {
    let steel = shipped::table(&shipped::on_rigid_flat("steel-4340"))?;
    let on_like_body = shipped::table("steel-4340")?;
    println!(
        "omega/omega_c   change of mu_static   fall of mu (of this by strength, area, load)   on a like body   G/G_IIc"
    );
    for (row, omega) in steel.axes().interference.iter().enumerate() {
        let fixed = change(&steel, row, Quantity::MuStatic);
        let fall = Fall::of(&steel, row);
        let [strength, area, load] = fall.shares();
        let like = Fall::of(&on_like_body, row).total;
        let ratio = energy_ratio("steel-4340", &steel, row)?;
        println!(
            "{omega:>13.3}   {:+.4} ± {:.4}   {:.4} ± {:.4}   {strength:6.1} % {area:6.1} % {load:6.1} %   {:.4} ± {:.4}   {:.3} ± {:.3}",
            fixed.value,
            fixed.error,
            fall.total.value,
            fall.total.error,
            like.value,
            like.error,
            ratio.value,
            ratio.error
        );
    }
    let Some(path) = std::env::args().nth(1) else { return Ok(()) };
    figure(&steel)?.save(Path::new(&path))?;
    println!("written to {path}");
    Ok(())
}

fn cell(table: &Slice, row: usize, column: usize, quantity: Quantity) -> Estimate {
    table.cell(row, column).expect("shipped tables are complete")[quantity]
}

/// Relative change of a quantity, ln x(V_max) − ln x(0). The error is the sum of both, an upper bound, as the errors of the
/// mesh have the same sign.
fn change(table: &Slice, row: usize, quantity: Quantity) -> Estimate {
    let [cold, hot] = [0, table.axes().slip_rate.len() - 1].map(|column| cell(table, row, column, quantity));
    let error = cold.error / cold.value + hot.error / hot.value;
    Estimate { value: (hot.value / cold.value).ln(), error }
}

/// Fall of ln μ, and its parts by strength, area and load.
struct Fall {
    total: Estimate,
    parts: [f64; 3],
}

impl Fall {
    fn of(table: &Slice, row: usize) -> Self {
        let [total, friction, area, load] =
            [Quantity::Mu, Quantity::Friction, Quantity::Area, Quantity::Load].map(|q| change(table, row, q));
        let parts = [area.value - friction.value, -area.value, load.value];
        Self { total: Estimate { value: -total.value, ..total }, parts }
    }

    /// In percent of the fall.
    fn shares(&self) -> [f64; 3] {
        self.parts.map(|part| 100.0 * part / self.total.value)
    }
}

/// G/G_IIc without heat. G_IIc is that of the preset.
fn energy_ratio(material: &str, table: &Slice, row: usize) -> anyhow::Result<Estimate> {
    let scene = format!(
        "[material]\npreset = \"{material}\"\n[asperity]\nradius = 1e-3\n[loading]\ninterference = 1\nslip_rate = 0\n"
    );
    let law = fracture_energy(&parse_scene(&scene, "preset of the table", &[])?.material);
    Ok(law.ratio(cell(table, row, 0, Quantity::EnergyRelease), cell(table, row, 0, Quantity::ContactRadius)))
}

fn figure(steel: &Slice) -> anyhow::Result<Figure> {
    let (interference, rates) = (&steel.axes().interference, &steel.axes().slip_rate);
    let rows: Vec<usize> = ROWS
        .iter()
        .map(|omega| interference.iter().position(|known| known == omega).expect("a row of the table"))
        .collect();
    // Without the isothermal limit, as the axis is logarithmic.
    let over_rate = |of: &dyn Fn(usize, usize) -> Estimate| -> Vec<Curve> {
        let curve = |&row: &usize| {
            let values = (1..rates.len()).map(|column| of(row, column));
            Curve::with_errors(format!("{} ω_{{c}}", interference[row]), rates[1..].to_vec(), values)
        };
        rows.iter().map(curve).collect()
    };
    let of = |quantity: Quantity| move |row: usize, column: usize| cell(steel, row, column, quantity);
    let stress = |row: usize, column: usize| {
        let [friction, area] = [Quantity::Friction, Quantity::Area].map(|q| cell(steel, row, column, q));
        let value = friction.value / area.value / 1e6;
        Estimate { value, error: value * (friction.error / friction.value + area.error / area.value) }
    };
    let falls: Vec<Fall> = (0..interference.len()).map(|row| Fall::of(steel, row)).collect();
    let parts = ["strength", "area", "load"].into_iter().enumerate().map(|(part, name)| {
        Curve::new(name, interference.clone(), falls.iter().map(|fall| 100.0 * fall.parts[part]).collect())
    });
    let mut ratios = Vec::new();
    for name in shipped::metals() {
        let table = shipped::table(name)?;
        let axis = table.axes().interference.clone();
        let ratio = (0..axis.len()).map(|row| energy_ratio(name, &table, row));
        let ratio: Vec<Estimate> = ratio.collect::<anyhow::Result<_>>()?;
        ratios.push(Curve::with_errors(name, axis, ratio));
    }
    let rate = || Axis::logarithmic("Slip rate V (m/s)");
    let depth = || Axis::logarithmic("Interference ω_{0}/ω_{c}");
    let panels = vec![
        Panel::new(
            "",
            "4340: static friction",
            rate(),
            Axis::linear("μ_{static}"),
            over_rate(&of(Quantity::MuStatic)),
        ),
        Panel::new(
            "",
            "4340: sliding friction",
            rate(),
            Axis::linear("μ at the end of the slide"),
            over_rate(&of(Quantity::Mu)),
        ),
        Panel::new("", "4340: friction stress", rate(), Axis::linear("Q/A (MPa)"), over_rate(&stress)),
        Panel::new("", "4340: parts of the fall of ln μ", depth(), Axis::linear("Part (%)"), parts.collect()),
        Panel::new("", "Energy released at inception", depth(), Axis::logarithmic("G/G_{IIc}"), ratios),
    ];
    Ok(Figure::new("Friction of one asperity and the slip rate", panels))
}
