//! From elastic to plastic contact: results of the shipped tables on static friction, of the load that an
//! asperity loses as it slides at constant interference, and of its growing contact.
//!
//! No simulation. Prints the isothermal column of the 4340 table and two limits of a contact of
//! shear strength τ_c = σ_Y/√3 that neither grows nor loses load:
//!
//! - elastic, pressure of Hertz: μ = τ_c A/P = (√3/2)/(C √ω*), with C(ν) = p₀/σ_Y at first yield;
//! - plastic, hardness H = 2.8 σ_Y: μ = τ_c/H = 0.206.
//!
//! and draws these and the other metals.
//!
//!     cargo run --release -p examples --example elastic_to_plastic [FIGURE.svg]

use std::path::Path;

use tables::closed_forms::{hertz, kogut_etsion};
use tables::figures::{Axis, Curve, Figure, Panel};
use tables::quantity::{Estimate, Quantity};
use tables::shipped;
use tables::table::{Cell, Slice};

/// Slip rates that are drawn: the isothermal limit, one in the middle, and the fastest.
const RATES: [f64; 3] = [0.0, 0.7, 10.0];

fn main() -> anyhow::Result<()> {
    let steel = shipped::table("steel-4340")?;
    let elastic = |omega: f64| {
        0.5 * 3f64.sqrt() / (hertz::yield_coefficient(steel.metadata().poisson_ratio) * omega.sqrt())
    };
    let plastic = 1.0 / (3f64.sqrt() * kogut_etsion::HARDNESS);

    println!("omega/omega_c   mu_static           elastic limit   P/P_press   A/A_press");
    for (i, &omega) in steel.axes().interference.iter().enumerate() {
        let cell = steel.cell(i, 0).expect("shipped tables are complete");
        let friction = cell[Quantity::MuStatic];
        println!(
            "{omega:>13.3}   {:.4} ± {:.4}   {:>15.4}   {:>9.3}   {:>9.3}",
            friction.value,
            friction.error,
            elastic(omega),
            cell[Quantity::Load].value / cell[Quantity::LoadPress].value,
            cell[Quantity::Area].value / cell[Quantity::AreaPress].value,
        );
    }
    println!("plastic limit   {plastic:.4}");

    let Some(path) = std::env::args().nth(1) else { return Ok(()) };
    figure(&steel, elastic, plastic)?.save(Path::new(&path))?;
    println!("written to {path}");
    Ok(())
}

/// Friction, load and area over the interference, of 4340 steel at three slip rates and of all metals without heat.
fn figure(steel: &Slice, elastic: impl Fn(f64) -> f64, plastic: f64) -> anyhow::Result<Figure> {
    let dense: Vec<f64> = (0..=60).map(|n| 10f64.powf(f64::from(n) / 20.0 - 1.0)).collect();
    let limits = [
        Curve::new("elastic limit", dense.clone(), dense.iter().map(|omega| elastic(*omega)).collect()),
        Curve::new("plastic limit", dense.clone(), vec![plastic; dense.len()]),
    ];
    let at_rates = |of: &dyn Fn(&Cell) -> Estimate| -> Vec<Curve> {
        RATES.iter().map(|&rate| curve(steel, rate, &format!("{rate} m/s"), of)).collect()
    };
    let metals = shipped::metals()
        .map(|name| Ok((name, shipped::table(name)?)))
        .collect::<Result<Vec<_>, tables::shipped::TableSourceError>>()?;
    let of_metals = |of: &dyn Fn(&Cell) -> Estimate| -> Vec<Curve> {
        metals.iter().map(|(name, table)| curve(table, 0.0, name, of)).collect()
    };

    let panel = |title: &str, y: Axis, curves: Vec<Curve>| {
        Panel::new("", title, Axis::logarithmic("Interference ω_{0}/ω_{c}"), y, curves)
    };
    // With the sum of both relative errors: an upper bound, as they are correlated.
    let load = &|cell: &Cell| cell[Quantity::Load].over(cell[Quantity::LoadPress]);
    let area = &|cell: &Cell| cell[Quantity::Area].over(cell[Quantity::AreaPress]);
    let fixed = &|cell: &Cell| cell[Quantity::MuStatic];
    let panels = vec![
        panel(
            "4340: static friction",
            Axis::logarithmic("μ_{static}"),
            [at_rates(fixed), limits.to_vec()].concat(),
        ),
        panel(
            "4340: sliding friction",
            Axis::logarithmic("μ at the end of the slide"),
            at_rates(&|cell| cell[Quantity::Mu]),
        ),
        panel("4340: load after the slide", Axis::linear("P/P_{press}"), at_rates(load)),
        panel("4340: contact area after the slide", Axis::linear("A/A_{press}"), at_rates(area)),
        panel("Six metals, isothermal: static friction", Axis::logarithmic("μ_{static}"), of_metals(fixed)),
        panel("Six metals, isothermal: load after the slide", Axis::linear("P/P_{press}"), of_metals(load)),
    ];
    Ok(Figure::new("From elastic to plastic contact, at held interference", panels))
}

/// A quantity over the interferences of a table, with its errors.
fn curve(table: &Slice, rate: f64, label: &str, of: &dyn Fn(&Cell) -> Estimate) -> Curve {
    let axes = table.axes();
    let column = axes.slip_rate.iter().position(|known| *known == rate).expect("a slip rate of the table");
    let rows = 0..axes.interference.len();
    let points = rows.map(|row| table.cell(row, column).map_or(Estimate::UNKNOWN, of));
    Curve::with_errors(label, axes.interference.clone(), points)
}
