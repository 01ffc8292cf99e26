//! Frictionless elastic sphere, and where it first yields.
//!
//! H. Hertz, J. reine angew. Math. 92, 156 (1882); K. L. Johnson, *Contact Mechanics* (1985), §3.4
//! and §4.2. ν = 0.3 and σ_Y/E = 1/5000, so that a ≤ 0.0005 R.

use super::setup::{Hertz, mesh, plain_material, scene};
use super::{Extent, Row, Rows};
use crate::scene::FrictionLaw;
use crate::simulate::{SimulationError, Watch, press};

const HERTZ: &str = "Hertz 1882; Johnson 1985, sec. 4.2";
const HALF_SPACE: &str = "half space against a sphere: of order a/R";
const YIELD: &str = "maximum of the von Mises stress on the axis, Johnson 1985, eq. 3.45";

pub fn rows(extent: Extent, watch: &dyn Watch) -> Rows {
    let scene = scene(plain_material(0.3), FrictionLaw::Frictionless, 0.3, mesh(extent.elements(), 4));
    let hertz = Hertz::of(&scene);
    let half_space = hertz.contact_radius / scene.radius;
    let contact = press(&scene, watch)?.contact();
    let radius = (contact.area.value / std::f64::consts::PI).sqrt();
    let radius_error = 0.5 * radius * contact.area.error / contact.area.value;
    let (load, peak) = (contact.load, contact.peak_pressure);
    let mut rows = vec![
        Row::new("P at 0.3 omega_c", load.value, load.error, hertz.load, HERTZ).unit("N"),
        Row::new("a at 0.3 omega_c", radius, radius_error, hertz.contact_radius, HERTZ).unit("m"),
        Row::new("p0 at 0.3 omega_c", peak.value, peak.error, hertz.peak_pressure, HERTZ).unit("Pa"),
    ];
    rows = rows.into_iter().map(|row| row.allow(half_space, HALF_SPACE)).collect();
    let ratios: &[f64] = match extent {
        Extent::Quick => &[0.3],
        Extent::Full => &[0.2, 0.3, 0.4],
    };
    for &poisson in ratios {
        let elements = extent.elements();
        let (coarse, fine) = (onset(poisson, elements / 2, watch)?, onset(poisson, elements, watch)?);
        // Of first order in the element size, as measured from 4 to 24 elements per radius: quadrature
        // points lie off the maximum. So the difference is the error, with the factor of safety of
        // Roache (1994), doi 10.1115/1.2910291.
        let error = 1.25 * (fine - coarse).abs() + BISECTED;
        let row = Row::new(format!("first yield over omega_c, nu = {poisson}"), fine, error, 1.0, YIELD);
        rows.push(row.allow(half_space, HALF_SPACE));
    }
    Ok(rows)
}

/// Width of the last interval of the bisection.
const BISECTED: f64 = 0.6 / 128.0;

/// ω/ω_c at which plastic strain begins.
fn onset(poisson: f64, elements: usize, watch: &dyn Watch) -> Result<f64, SimulationError> {
    let (mut elastic, mut plastic) = (0.8, 1.4);
    while plastic - elastic > 1.01 * BISECTED {
        let middle = 0.5 * (elastic + plastic);
        let scene = scene(plain_material(poisson), FrictionLaw::Frictionless, middle, mesh(elements, 4));
        match press(&scene, watch)?.contact().plastic_strain_max > 0.0 {
            true => plastic = middle,
            false => elastic = middle,
        }
    }
    Ok(0.5 * (elastic + plastic))
}
