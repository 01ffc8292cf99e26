//! Frictionless elastic sphere: load, area, pressure, and first yield.
//!
//! H. Hertz, J. reine angew. Math. 92, 156 (1882); K. L. Johnson, *Contact Mechanics* (1985), §3.4 and §4.2, doi
//! 10.1017/CBO9781139171731. ν = 0.3, σ_Y/E = 1/5000 and ω₀ = 0.3 ω_c, so that a/R = 0.00025 and the half space leaves
//! 0.03 % open.

use std::f64::consts::PI;

use tables::closed_forms::hertz::{pressure, stresses};
use tables::functions::try_bisect;
use tables::law::Estimate;

use super::setup::{Hertz, mesh, plain_material, run_press, scene};
use super::{Case, Cost, Reference, Row, Rows, Tolerance, joined};
use crate::discretisation::body::mises;
use crate::scene::{FrictionLaw, Scene};
use crate::simulate::{PressedContact, SimulationError, Watch, press};

const HERTZ: &str = "Hertz 1882; Johnson 1985, sec. 4.2";
const YIELD: &str = "maximum of the von Mises stress on the axis, Johnson 1985, eq. 3.45";
const INTERIOR: &str = "Huber 1904, doi 10.1002/andp.19043190612, at the same points";
/// Difference between half-space and sphere: a/R.
const HALF_SPACE: f64 = 0.0003;

pub const CASES: [Case; 4] = [
    Case::new("elastic press, 8 elements", Cost::Quick, |watch| elastic(8, [0.004, 0.002, 0.006], watch)),
    Case::new("first yield, 8 elements", Cost::Quick, |watch| first_yield(8, 0.3, watch)),
    Case::new("elastic press, 16 elements", Cost::Medium, fine),
    Case::new("first yield, 16 elements", Cost::Long, |watch| {
        joined([0.2, 0.3, 0.4].map(|poisson| first_yield(16, poisson, watch)))
    }),
];

fn scene_on(elements: usize) -> Scene {
    scene(plain_material(0.3), FrictionLaw::Frictionless, 0.3, mesh(elements, 4))
}

fn contact(elements: usize, watch: &dyn Watch) -> Result<(Hertz, PressedContact), SimulationError> {
    let scene = scene_on(elements);
    Ok((Hertz::of(&scene), press(&scene, watch)?.contact()))
}

/// `bounds` of P, a and p₀, relative.
fn elastic(elements: usize, bounds: [f64; 3], watch: &dyn Watch) -> Rows {
    let (hertz, contact) = contact(elements, watch)?;
    let value = (contact.area.value / PI).sqrt();
    let radius = Estimate { value, error: 0.5 * value * contact.area.error / contact.area.value };
    let row = |name: &str, computed: Estimate, reference: f64, unit, tolerance| {
        let reference = Reference::exact(reference, HERTZ).known_to(HALF_SPACE);
        Row::new(format!("{name} at 0.3 omega_c, {elements} elements"), computed, reference, tolerance)
            .unit(unit)
    };
    let [of_load, of_radius, of_peak] = bounds;
    let tolerance = |bound| Tolerance::relative(bound, "mesh; half space, 0.03 %");
    Ok(vec![
        row("P", contact.load, hertz.load, "N", tolerance(of_load)),
        row("a", radius, hertz.contact_radius, "m", tolerance(of_radius)),
        row("p0", contact.peak_pressure, hertz.peak_pressure, "Pa", tolerance(of_peak)),
    ])
}

fn fine(watch: &dyn Watch) -> Rows {
    let mut rows = elastic(16, [0.002, 0.0015, 0.003], watch)?;
    let (hertz, coarse) = contact(8, watch)?;
    let (_, fine) = contact(16, watch)?;
    let off = [coarse, fine].map(|contact| contact.load.value / hertz.load - 1.0);
    let limit = off[1] + (off[1] - off[0]) / (2f64.powf(1.5) - 1.0);
    let reference = Reference::exact(1.0, HERTZ).known_to(HALF_SPACE);
    rows.push(Row::new(
        "P over Hertz, limit from 8 and 16 elements",
        1.0 + limit,
        reference,
        Tolerance::relative(0.003, "a third of the correction of 0.8 %"),
    ));
    rows.push(Row::new(
        "order of P in the elements, from 8 and 16",
        (off[0] / off[1]).log2(),
        Reference::exact(1.5, "square-root edge of the pressure"),
        Tolerance::absolute(0.5, "place of the edge between the rings"),
    ));
    rows.extend(profile(watch)?);
    Ok(rows)
}

/// The pressure at every ring of nodes against that of Hertz.
fn profile(watch: &dyn Watch) -> Rows {
    let scene = scene_on(16);
    let hertz = Hertz::of(&scene);
    let outcome = run_press(&scene, watch)?;
    let rings = outcome.grid.r.iter().zip(&outcome.snapshots[0].pressure);
    let off: Vec<f64> = rings
        .map(|(&r, &p)| {
            (p - pressure(hertz.peak_pressure, hertz.contact_radius, r)).abs() / hertz.peak_pressure
        })
        .collect();
    let worst = largest(off[1..].iter().copied());
    let row = |name: &str, off: f64, tolerance| Row::new(name, off, Reference::exact(0.0, HERTZ), tolerance);
    let ring = "nodal pressure of second order but for the last ring, whose cell the edge cuts";
    Ok(vec![
        row("largest error of p(r) over p0, 16 elements", worst, Tolerance::absolute(0.02, ring)),
        row(
            "error of p(0) over p0, 16 elements",
            off[0],
            Tolerance::absolute(0.025, "the apex has half a cell"),
        ),
    ])
}

/// The von Mises stress is largest on the axis, 0.48 a deep at ν = 0.3. The integration points of an element all have its
/// axial strain, so that those nearer to the surface yield first: of first order in the element. The means of elements
/// are of second order; they are compared with the means of Hertz's stress at the same points.
fn first_yield(elements: usize, poisson: f64, watch: &dyn Watch) -> Rows {
    const ELASTIC: f64 = 0.5;
    const BRACKET: [f64; 2] = [0.8, 1.4];
    let scene_at = |interference: f64| {
        scene(plain_material(poisson), FrictionLaw::Frictionless, interference, mesh(elements, 4))
    };
    let pressed = |interference: f64| press(&scene_at(interference), watch);
    let means = pressed(ELASTIC)?.mean_stresses_on_axis();
    let exact = largest(means.iter().map(|mean| exact_mises(&scene_at(ELASTIC), &mean.points)));
    let by_means = (exact / largest(means.iter().map(|mean| mean.mises))).powi(2);
    let is_elastic = |interference: f64| Ok(pressed(interference)?.contact().plastic_strain_max == 0.0);
    let [elastic, plastic] = try_bisect(BRACKET, 7, is_elastic)?;
    let row = |name: &str, computed: f64, source, bound: f64, why| {
        let name = format!("{name} over omega_c, nu = {poisson}, {elements} elements");
        Row::new(name, computed, Reference::exact(1.0, source), Tolerance::relative(bound, why))
    };
    let n = elements as f64;
    let points = "first order, 0.4/n_c (10 % at 4 elements); half of the last bracket";
    Ok(vec![
        row(
            "first plastic strain",
            0.5 * (elastic + plastic),
            YIELD,
            0.4 / n + 0.5 * (plastic - elastic),
            points,
        ),
        row(
            "first yield by element means",
            by_means,
            INTERIOR,
            0.6 / (n * n) + 0.002,
            "second order, 0.6/n_c^2; half space",
        ),
    ])
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, f64::max)
}

/// Von Mises stress of the mean of Hertz's stresses at points (r, z) over R, over the yield strength.
fn exact_mises(scene: &Scene, points: &[[f64; 2]]) -> f64 {
    let hertz = Hertz::of(scene);
    let over_a = |length: f64| length * scene.radius / hertz.contact_radius;
    let mut mean = [0.0; 6];
    for [r, z] in points {
        let [radial, hoop, axial, shear] = stresses(scene.material.poisson_ratio, [over_a(*r), over_a(-z)]);
        let stress = [radial, hoop, axial, 0.0, 0.0, shear];
        mean.iter_mut().zip(stress).for_each(|(mean, stress)| *mean += stress / points.len() as f64);
    }
    mises(&mean) * hertz.peak_pressure / scene.material.yield_strength
}
