//! Values of this program itself in the limit of fine resolution.
//!
//! From runs at small strain with 16, 24, 32 and 48 elements per radius, 8 angles and increments of
//! 0.075 of the slip (0.15 with 48), extrapolated with order 1.5; at 16 and 24 elements also with 16 angles, and at 16
//! with increments of 0.02, the effects of which are added; G, whose differences between meshes are not monotonic, by
//! least squares over 16, 24 and 32 elements. The uncertainty
//! of a limit is by how much limits from different meshes, angles and increments differ.

use tables::law::Estimate;
use tables::quantity::Quantity;

use super::setup::slide_at_small_strain;
use super::{Case, Cost, Reference, Row, Rows, Tolerance, joined};
use crate::simulate::{Watch, simulate};

const SOURCE: &str = "this program, limit of fine meshes, angles and increments";

/// Preset, ω₀/ω_c, V (m/s); μ, μ_static, G (J/m²), T_max − T₀ (K), each with its relative uncertainty.
struct Limits {
    scene: (&'static str, f64, f64),
    mu: (f64, f64),
    mu_static: (f64, f64),
    energy: (f64, f64),
    rise: (f64, f64),
}

const LIMITS: [Limits; 3] = [
    Limits {
        scene: ("steel-4340", 20.0, 1.0),
        mu: (0.2349, 0.0015),
        mu_static: (0.2554, 0.0015),
        energy: (154.1, 0.005),
        rise: (148.58, 0.0003),
    },
    Limits {
        scene: ("titanium-6al4v", 3.0, 0.0),
        mu: (0.3861, 0.0012),
        mu_static: (0.3844, 0.0015),
        energy: (101.7, 0.003),
        rise: (0.0, 0.0),
    },
    Limits {
        scene: ("aluminium-6061", 20.0, 10.0),
        mu: (0.2632, 0.0025),
        mu_static: (0.3087, 0.002),
        energy: (266.0, 0.01),
        rise: (153.49, 0.0005),
    },
];

pub const CASES: [Case; 2] = [
    Case::new("4340 steel, 8 elements", Cost::Quick, |watch| rows(&LIMITS[0], &ON_8, watch)),
    Case::new("three metals, 16 elements", Cost::Long, |watch| {
        joined(LIMITS.iter().map(|limits| rows(limits, &ON_16, watch)))
    }),
];

/// Tolerances on a mesh, relative; that of a limit is added.
struct On {
    elements: usize,
    sectors: usize,
    friction: Tolerance,
    energy: Tolerance,
    rise: Tolerance,
}

const FRICTION: &str = "mesh, 0.5 n_c^-1.5; limit";
const ENERGY: &str = "three times the mesh error of Q: a difference of two works; limit";
const RISE: &str = "edge of the contact, 0.047/n_c; limit";

const ON_8: On = On {
    elements: 8,
    sectors: 4,
    friction: Tolerance::relative(0.0235, FRICTION),
    energy: Tolerance::relative(0.07, ENERGY),
    rise: Tolerance::relative(0.0065, RISE),
};
const ON_16: On = On {
    elements: 16,
    sectors: 8,
    friction: Tolerance::relative(0.01, FRICTION),
    energy: Tolerance::relative(0.03, ENERGY),
    rise: Tolerance::relative(0.0035, RISE),
};

fn rows(limits: &Limits, on: &On, watch: &dyn Watch) -> Rows {
    let (preset, interference, slip_rate) = limits.scene;
    let mut scene = slide_at_small_strain(preset, interference, slip_rate, on.elements);
    scene.numerics.sectors = Some(on.sectors);
    let outcome = simulate(&scene, watch)?;
    let name = format!("{preset} {interference} ω_c {slip_rate} m/s");
    let row = |quantity: &str, computed: Estimate, (limit, uncertainty): (f64, f64), tolerance| {
        let name = format!("{quantity}, {name}, {} elements", on.elements);
        Row::new(name, computed, Reference::exact(limit, SOURCE).known_to(uncertainty), tolerance)
    };
    let of = |quantity| outcome.scalars[quantity];
    let mut rows = vec![
        row("mu", of(Quantity::Mu), limits.mu, on.friction),
        row("mu_static", of(Quantity::MuStatic), limits.mu_static, on.friction),
        row("G", of(Quantity::EnergyRelease), limits.energy, on.energy).unit("J m-2"),
    ];
    if limits.rise.0 > 0.0 {
        let hottest = of(Quantity::TemperatureMax);
        let rise = Estimate { value: hottest.value - scene.loading.temperature, error: hottest.error };
        rows.push(row("T_max - T_0", rise, limits.rise, on.rise).unit("K"));
    }
    Ok(rows)
}
