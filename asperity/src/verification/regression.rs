//! Values of this program itself in the limit of fine resolution: what changes them is found out.
//!
//! From the study of the estimates (`asperity honesty --thorough`): limits for ever more elements
//! (8, 16 and 24 per radius), angles (4 and 8) and increments (to a quarter of the usual), each
//! with what these leave open.

use super::{Extent, Row, Rows};
use crate::honesty::scenes;
use crate::simulate::{Watch, simulate};

const SOURCE: &str = "this program, limit of fine meshes, angles and increments";
const WHY: &str = "what the limit is uncertain by";

/// Preset, ω₀/ω_c, V (m/s); μ, μ_static, G (J/m²), T_max − T₀ (K), each with its relative doubt.
struct Fixed {
    scene: (&'static str, f64, f64),
    mu: (f64, f64),
    mu_static: (f64, f64),
    energy: (f64, f64),
    rise: (f64, f64),
}

const FIXED: [Fixed; 2] = [
    Fixed {
        scene: ("steel-4340", 20.0, 1.0),
        mu: (0.2334, 0.003),
        mu_static: (0.2558, 0.004),
        energy: (155.6, 0.03),
        rise: (148.64, 0.001),
    },
    Fixed {
        scene: ("aluminium-6061", 20.0, 10.0),
        mu: (0.2582, 0.007),
        mu_static: (0.3029, 0.005),
        energy: (251.5, 0.05),
        rise: (153.56, 0.002),
    },
];

pub fn rows(extent: Extent, watch: &dyn Watch) -> Rows {
    let chosen = match extent {
        Extent::Quick => &FIXED[..1],
        Extent::Full => &FIXED,
    };
    let mut rows = Vec::new();
    for fixed in chosen {
        let (preset, interference, slip_rate) = fixed.scene;
        let scene = scenes::scene(preset, interference, slip_rate, extent.elements());
        let summary = simulate(&scene, watch)?.summary;
        let start = scene.loading.temperature;
        let name = scenes::name(preset, interference, slip_rate);
        let mut row = |quantity: &str, unit, value: f64, error: f64, (reference, doubt): (f64, f64)| {
            let row = Row::new(format!("{quantity}, {name}"), value, error, reference, SOURCE);
            rows.push(row.unit(unit).allow(doubt, WHY));
        };
        let (mu, still, energy) = (summary.mu, summary.mu_static, summary.energy_release);
        row("mu", "1", mu.value, mu.error, fixed.mu);
        row("mu_static", "1", still.value, still.error, fixed.mu_static);
        row("G", "J m-2", energy.value, energy.error, fixed.energy);
        let hottest = summary.temperature_max;
        row("T_max - T_0", "K", hottest.value - start, hottest.error, fixed.rise);
    }
    Ok(rows)
}
