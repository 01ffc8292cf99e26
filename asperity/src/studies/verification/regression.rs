//! Values of this program itself in the limit of fine resolution: what changes them is found out.
//!
//! From runs of the scenes of `asperity honesty` with 16, 24, 32 and 48 elements per radius, 8 angles and increments of
//! 0.075 of the slip (0.15 with 48), extrapolated with order 1.5; at 16 and 24 elements also with 16 angles, and at 16 with
//! increments of 0.02, the effects of which are added. The doubt is by how much the limits from different meshes,
//! angles and increments disagree.

use super::{Extent, Row, Rows};
use crate::simulate::{Watch, simulate};
use crate::studies::effectivity::scenes;
use tables::quantity::Quantity;

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

const FIXED: [Fixed; 3] = [
    Fixed {
        scene: ("steel-4340", 20.0, 1.0),
        mu: (0.2349, 0.0015),
        mu_static: (0.2554, 0.0015),
        energy: (152.8, 0.004),
        rise: (148.58, 0.0003),
    },
    Fixed {
        scene: ("titanium-6al4v", 3.0, 0.0),
        mu: (0.3861, 0.0012),
        mu_static: (0.3844, 0.0015),
        energy: (100.7, 0.005),
        rise: (0.0, 0.0),
    },
    Fixed {
        scene: ("aluminium-6061", 20.0, 10.0),
        mu: (0.2632, 0.0025),
        mu_static: (0.3087, 0.002),
        // Single runs are up to 1.5 % apart, as the last points let go here or there: with 8 angles 259.4, 262.7, 264.5,
        // 262.3, 260.6, 259.3, 258.4, 258.6, 260.8, 262.2 and 262.5 on 16 to 48 elements (mean 261.0, its standard error
        // 0.6), with 12 or 16 angles 258.3, 258.9, 259.4, 259.6 and 263.2 on 16 to 22 (259.9 and 0.9). The doubt is twice
        // the standard error of both.
        energy: (260.5, 0.004),
        rise: (153.49, 0.0005),
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
        let scalars = simulate(&scene, watch)?.scalars;
        let start = scene.loading.temperature;
        let name = scenes::name(preset, interference, slip_rate);
        let mut row = |quantity: &str, unit, value: f64, error: f64, (reference, doubt): (f64, f64)| {
            let row = Row::new(format!("{quantity}, {name}"), value, error, reference, SOURCE);
            rows.push(row.unit(unit).allow(doubt, WHY));
        };
        let (mu, still, energy) =
            (scalars[Quantity::Mu], scalars[Quantity::MuStatic], scalars[Quantity::EnergyRelease]);
        row("mu", "1", mu.value, mu.error, fixed.mu);
        row("mu_static", "1", still.value, still.error, fixed.mu_static);
        row("G", "J m-2", energy.value, energy.error, fixed.energy);
        if fixed.rise.0 == 0.0 {
            continue;
        }
        let hottest = scalars[Quantity::TemperatureMax];
        row("T_max - T_0", "K", hottest.value - start, hottest.error, fixed.rise);
    }
    Ok(rows)
}
