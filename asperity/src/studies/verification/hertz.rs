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
const YIELDS_EARLY: &str = "half space against a sphere, and points of an element that lie nearer to the \
                            surface than its middle, but have its axial strain, yield before the middle";
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
        let onset = onset(poisson, extent.elements(), watch)?;
        // Mean stresses of elements are of second order, and their errors smaller than what a mesh
        // half as fine changes in them.
        let error = (onset.of_elements - onset.of_coarse_elements).abs() + 0.5 * BISECTED;
        let early = (onset.of_elements - onset.at_points).max(0.0);
        let name = format!("first yield over omega_c, nu = {poisson}");
        let row = Row::new(name, onset.plastic, error, 1.0, YIELD);
        rows.push(row.allow_absolute(half_space + early, YIELDS_EARLY));
    }
    Ok(rows)
}

/// Width of the last interval of the bisection.
const BISECTED: f64 = 0.6 / 128.0;

/// ω/ω_c at which the sphere yields first.
///
/// The von Mises stress is largest on the axis, 0.48 a deep at ν = 0.3, and that is where plastic strain
/// begins; but with 16 elements per radius at 0.98 ω_c, in the upper points of the elements there, while by
/// the means of elements it would at 1.000 ω_c. With 4, 8, 24, 32: at 0.90, 0.97, 0.988, 0.993,
/// and by the means at 1.019, 1.006, 0.999, 1.001.
struct Onset {
    /// Where plastic strain begins.
    plastic: f64,
    /// By the stress of an elastic press, which goes with √ω.
    at_points: f64,
    of_elements: f64,
    of_coarse_elements: f64,
}

fn onset(poisson: f64, elements: usize, watch: &dyn Watch) -> Result<Onset, SimulationError> {
    const ELASTIC: f64 = 0.5;
    let pressed = |interference: f64| {
        let mesh = mesh(elements, 4);
        press(&scene(plain_material(poisson), FrictionLaw::Frictionless, interference, mesh), watch)
    };
    let [coarse, fine] = pressed(ELASTIC)?.largest_mises();
    let by = |mises: f64| ELASTIC / (mises * mises);
    let (mut elastic, mut plastic) = (0.8, 1.4);
    while plastic - elastic > 1.01 * BISECTED {
        let middle = 0.5 * (elastic + plastic);
        match pressed(middle)?.contact().plastic_strain_max > 0.0 {
            true => plastic = middle,
            false => elastic = middle,
        }
    }
    Ok(Onset {
        plastic: 0.5 * (elastic + plastic),
        at_points: by(fine.at_points),
        of_elements: by(fine.of_elements),
        of_coarse_elements: by(coarse.of_elements),
    })
}
