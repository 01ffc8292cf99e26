//! Friction of a Gaussian rough surface, with the library `roughsurface`.
//!
//! The friction of one asperity comes from a closed form of the literature or, with an argument,
//! from a table that `asperity tabulate` made; the surface is independent of which. Closed forms do
//! not depend on the slip rate, tables do.
//!
//!     cargo run --release -p examples --example rough_surface
//!     cargo run --release -p examples --example rough_surface friction-of-steel/table.nc

use std::path::Path;

use roughsurface::friction::{Settings, predict};
use roughsurface::surface::heights::Gaussian;
use roughsurface::surface::query::{NormalLoading, Query, Surface};
use tables::closed_forms::{ElasticPlastic, closed_form};
use tables::law::AsperityLaw;
use tables::table::Table;

fn main() -> anyhow::Result<()> {
    // 1. What one asperity does: anything that implements `AsperityLaw`.
    let steel = ElasticPlastic { youngs_modulus: 205e9, poisson_ratio: 0.29, yield_strength: 792e6 };
    let law: Box<dyn AsperityLaw> = match std::env::args().nth(1) {
        Some(file) => Box::new(Table::read(Path::new(&file))?.at(None)?),
        None => closed_form("jackson-green", &steel)?,
    };

    // 2. The surface: one summit of 1 mm radius in 100 µm × 100 µm.
    let deviation = 0.4e-6;
    let surface = Surface {
        asperity_density: 1e8,
        asperity_radius: 1e-3.into(),
        heights: Box::new(Gaussian::new(deviation)),
    };
    let critical = law.critical_interference(surface.asperity_radius.mean());
    println!("asperity law {}, plasticity index {:.2}", law.name(), (deviation / critical).sqrt());

    // 3. The question: nominal pressures and slip rates, the load held while it slides.
    let query = Query::new(NormalLoading::Pressure(vec![1e6, 1e7, 1e8]), vec![0.1, 1.0, 10.0]);
    let prediction = predict(law.as_ref(), &surface, &query, &Settings::default(), &|_, _| ())?;

    // 4. The result: one row per pressure, one column per slip rate.
    println!("pressure [MPa]   slip rate [m/s]   mu_static   mu       real area   outside the table");
    for (pressure, row) in query.loading.values().iter().zip(&prediction.friction) {
        for (rate, friction) in query.slip_rates.iter().zip(row) {
            println!(
                "{:>14}   {rate:>15}   {:<9.4}   {:<6.4}   {:>7.3} %   {:.1e}",
                1e-6 * pressure,
                friction.mu_static.value,
                friction.sliding.mu.value,
                100.0 * friction.sliding.area_fraction.value,
                friction.outside_table
            );
        }
    }
    for warning in &prediction.warnings {
        println!("warning: {warning}");
    }
    Ok(())
}
