//! Time of a prediction and of finite surfaces, from a table of 26 interferences and 12 slip rates:
//!
//!     cargo bench -p roughsurface
//!
//! Aims on two cores: 50 pressures × 20 slip rates × 200 slips in 1 s, ten million asperities in 5 s.

#[path = "../tests/program/demonstration.rs"]
mod demonstration;

use demonstration::{Weakening, table};
use divan::Bencher;
use divan::counter::ItemsCount;
use roughsurface::friction::{Settings, predict};
use roughsurface::sampling::finite_surface::{Sampling, sample};
use roughsurface::surface::heights::Gaussian;
use roughsurface::surface::query::{NormalLoading, Query, Surface};
use tables::interpolation::InterpolatedTable;
use tables::numbers::Spacing::Log;

fn main() {
    divan::main();
}

fn law() -> InterpolatedTable {
    table(&Weakening::new()).interpolated()
}

fn surface() -> Surface {
    Surface {
        asperity_density: 1e10,
        asperity_radius: 1e-4.into(),
        heights: Box::new(Gaussian::new(0.05e-6)),
    }
}

/// 50 pressures × 20 slip rates × 200 slips.
#[divan::bench(sample_count = 10)]
fn prediction(bencher: Bencher) {
    let (law, surface, settings) = (law(), surface(), Settings::default());
    let query = Query::new(NormalLoading::Pressure(Log.range(1e4, 1e7, 50)), Log.range(0.1, 10.0, 20));
    let states = 50 * 20 * settings.slip_points;
    bencher
        .counter(ItemsCount::new(states))
        .bench(|| predict(&law, &surface, &query, &settings, &|_, _| ()).expect("the table covers it"));
}

/// Ten surfaces of a million asperities, of which a few per cent or about half touch.
#[divan::bench(args = [1e6, 3e7], sample_count = 3)]
fn ten_million_asperities(bencher: Bencher, pressure: f64) {
    let (law, surface, settings) = (law(), surface(), Settings::default());
    let query = Query::new(NormalLoading::Pressure(vec![pressure]), vec![1.0]);
    let sampling = Sampling { asperities: 1_000_000, realizations: 10, seed: 1, slip: Some(1e-6) };
    bencher.counter(ItemsCount::new(10_000_000_usize)).bench(|| {
        sample(&law, &surface, &query, &sampling, &settings, &|_, _| ()).expect("the table covers it")
    });
}
