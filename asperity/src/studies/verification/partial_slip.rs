//! Tangential loading of an elastic sphere: stick, partial slip, gross slip.
//!
//! Constant shear strength: A. R. Savkoor, thesis, Delft (1987); A. Chateauminois & C. Fretigny,
//! Eur. Phys. J. E 27, 221 (2008), doi 10.1140/epje/i2008-10376-5. Coulomb friction:
//! R. D. Mindlin, J. Appl. Mech. 16, 259 (1949), doi 10.1115/1.4009973. ν = 0.499, where normal
//! and tangential tractions of a rigid flat and a half space do not act on each other.

use std::f64::consts::PI;
use tables::quantity::Quantity;

use tables::closed_forms::partial_slip::{constant_shear, mindlin, stick_stiffness};

use super::setup::{Hertz, at_slip, last, mesh, plain_material, pressed, scene};
use super::{Extent, Row, Rows};
use crate::loading::slide::NO_STICK;
use crate::scene::{FrictionLaw, Scene};
use crate::simulate::accuracy::error_budget::edge_share;
use crate::simulate::outcome::Outcome;
use crate::simulate::{SimulationError, Watch, simulate};

const POISSON: f64 = 0.499;
/// τ₀ = f_τ σ_Y/√3 low enough that the body stays elastic.
const STRENGTH_FACTOR: f64 = 0.1;
const FRICTION: f64 = 0.05;
/// Mesh and sectors are given: only the increments follow the accuracy. They are a fifth of the slip, as the curves are
/// read between them along straight lines.
const ACCURACY: f64 = 0.009;

const SAVKOOR: &str = "Savkoor 1987; Chateauminois & Fretigny 2008, doi 10.1140/epje/i2008-10376-5";
const MINDLIN: &str = "Mindlin 1949, doi 10.1115/1.4009973";
/// The references take the traction to be along the displacement of the flat; the slip is off by
/// an angle of order ν/(4 − 2ν) = 1/6 times what is slipping, of which friction loses the cosine.
const DIRECTION: f64 = 0.002;
const WHY: &str = "traction along the slip, not along the flat's displacement";
/// Of the stick area over the contact area: sticking is known ring by ring.
const RING: &str = "sticking is a property of nodes: half a ring, and the direction of slip";

pub fn rows(extent: Extent, watch: &dyn Watch) -> Rows {
    let elements = extent.elements();
    let mut rows = shear(elements, watch)?;
    rows.extend(coulomb(elements, watch)?);
    Ok(rows)
}

fn scene_of(law: FrictionLaw, elements: usize) -> (Scene, Hertz) {
    let mut scene = scene(plain_material(POISSON), law, 0.05, mesh(elements, 4));
    scene.interface.strength_factor = STRENGTH_FACTOR;
    scene.numerics.accuracy = ACCURACY;
    let hertz = Hertz::of(&scene);
    (scene, hertz)
}

/// The flat moves 1.3 times as far as gross slip takes.
fn slide(mut scene: Scene, hertz: &Hertz, gross: f64, watch: &dyn Watch) -> Result<Outcome, SimulationError> {
    scene.loading.slip_distance = 1.3 * gross / hertz.contact_radius;
    simulate(&scene, watch)
}

/// Rows of Q(u) and the stick radius; each outcome with its force and displacement of gross slip.
fn curves(
    law: &str,
    runs: [(&Outcome, f64, f64); 2],
    force: fn(f64) -> f64,
    stick_radius: fn(f64) -> f64,
    (elements, source): (usize, &'static str),
) -> Vec<Row> {
    let mut rows = Vec::new();
    for x in [0.25, 0.5, 0.75] {
        let [fine, coarse] = runs.map(|(outcome, full, gross)| {
            at_slip(outcome, x * gross, |step| step[Quantity::Friction]) / full
        });
        let name = format!("{law}: Q over that of gross slip at u/u_s = {x}");
        // As that of the friction of a run: two meshes may place the edge wrongly by the same amount.
        let error = (fine - coarse).abs() + 2.0 * edge_share(elements as f64) * fine;
        rows.push(Row::new(name, fine, error, force(x), source).allow(DIRECTION, WHY));
        let [fine, coarse] = runs.map(|(outcome, _, gross)| {
            at_slip(outcome, x * gross, |step| step[Quantity::StickFraction]).sqrt()
        });
        let name = format!("{law}: c/a at u/u_s = {x}");
        let row = Row::new(name, fine, (fine - coarse).abs(), stick_radius(x), source);
        rows.push(row.allow_absolute(0.5 / elements as f64, RING));
    }
    rows
}

fn shear(elements: usize, watch: &dyn Watch) -> Rows {
    let run = |elements: usize, accuracy: f64| -> Result<_, SimulationError> {
        let (mut scene, hertz) = scene_of(FrictionLaw::ShearStrength, elements);
        scene.numerics.accuracy = accuracy;
        let strength = STRENGTH_FACTOR * scene.material.yield_strength / 3f64.sqrt();
        let (g, a) = (hertz.tangential_modulus, hertz.contact_radius);
        let gross = constant_shear::gross_slip_displacement(strength, g, a);
        let outcome = slide(scene, &hertz, gross, watch)?;
        Ok((outcome, PI * a * a * strength, gross, stick_stiffness(g, a)))
    };
    let (coarse, fine) = (run(elements / 2, ACCURACY)?, run(elements, ACCURACY)?);
    let shorter = run(elements / 2, 0.0018)?;
    let (_, full, gross, stiffness) = fine;
    let (force, stick) = (constant_shear::force_fraction, constant_shear::stick_radius_fraction);
    let runs = [(&fine.0, full, gross), (&coarse.0, full, gross)];
    let mut rows = curves("constant shear", runs, force, stick, (elements, SAVKOOR));
    let mut add = |name: &str, of: &dyn Fn(&Outcome) -> f64, reference: f64, unit| {
        let (fine, coarse, shorter) = (of(&fine.0), of(&coarse.0), of(&shorter.0));
        // Of the mesh, and of the increments.
        let error = (fine - coarse).abs() + (coarse - shorter).abs();
        let row = Row::new(format!("constant shear: {name}"), fine, error, reference, SAVKOOR);
        rows.push(row.unit(unit).allow(DIRECTION, WHY));
    };
    add(
        "stiffness 8G*a",
        &|run| run.slide.state(1)[Quantity::Friction] / run.slide.state(1)[Quantity::Slip],
        stiffness,
        "N m-1",
    );
    let sliding = |run: &Outcome| last(run)[Quantity::Friction] * (last(run)[Quantity::Slip] - gross);
    let unit = full * gross;
    let (work, stored, dissipated) = constant_shear::energies_at_gross_slip();
    add(
        "work to gross slip over its unit",
        &|run| (last(run)[Quantity::Work] - sliding(run)) / unit,
        work,
        "1",
    );
    add(
        "dissipation over its unit",
        &|run| (last(run)[Quantity::DissipationFriction] - sliding(run)) / unit,
        dissipated,
        "1",
    );
    // What is stored is the small difference of the two: no better known than the work, whose error
    // falls with order 1.5.
    let works = [&fine, &coarse].map(|run| (last(&run.0)[Quantity::Work] - sliding(&run.0)) / unit);
    let energies = [&fine, &coarse].map(|run| last(&run.0)[Quantity::EnergyElastic] / unit);
    let error = (energies[0] - energies[1]).abs().max(0.547 * (works[0] - works[1]).abs());
    let name = "constant shear: stored energy over its unit";
    rows.push(Row::new(name, energies[0], error, stored, SAVKOOR).allow(DIRECTION, WHY));
    // Inception counts from where NO_STICK of the area still sticks: c²/a² = 1 − u²/u_s².
    let slip = fine.0.scalars[Quantity::InceptionSlip];
    let name = "constant shear: displacement where a hundredth sticks";
    let row = Row::new(name, slip.value, slip.error, gross * (1.0 - NO_STICK).sqrt(), SAVKOOR);
    rows.push(row.unit("m").allow(DIRECTION + 0.5 * ring(elements), RING));
    Ok(rows)
}

fn coulomb(elements: usize, watch: &dyn Watch) -> Rows {
    let law = FrictionLaw::Coulomb { friction: FRICTION, cap: false };
    let run = |elements: usize| -> Result<_, SimulationError> {
        let (scene, hertz) = scene_of(law.clone(), elements);
        let (g, a) = (hertz.tangential_modulus, hertz.contact_radius);
        let gross = mindlin::gross_slip_displacement(FRICTION, hertz.load, g, a);
        let outcome = slide(scene, &hertz, gross, watch)?;
        // The computed P sets the scale of Coulomb friction.
        let load = pressed(&outcome)[Quantity::Load];
        let gross = mindlin::gross_slip_displacement(FRICTION, load, g, a);
        Ok((outcome, FRICTION * load, gross))
    };
    let (coarse, fine) = (run(elements / 2)?, run(elements)?);
    let runs = [(&fine.0, fine.1, fine.2), (&coarse.0, coarse.1, coarse.2)];
    let (force, stick) = (mindlin::force_fraction, mindlin::stick_radius_fraction);
    let mut rows = curves("Coulomb", runs, force, stick, (elements, MINDLIN));
    let slips = [&fine, &coarse].map(|run| run.0.scalars[Quantity::InceptionSlip].value / run.2);
    let error = (slips[0] - slips[1]).abs();
    // c²/a² = 1 − u/u_s.
    let name = "Coulomb: displacement where a hundredth sticks over u_s";
    let row = Row::new(name, slips[0], error, 1.0 - NO_STICK, MINDLIN);
    rows.push(row.allow(DIRECTION + ring(elements), RING));
    Ok(rows)
}

/// What half a ring makes of c²/a² where [`NO_STICK`] of the area sticks.
fn ring(elements: usize) -> f64 {
    let half = 0.5 / elements as f64;
    half * (2.0 * NO_STICK.sqrt() + half)
}
