//! Tangential loading of an elastic sphere: stick, partial slip, gross slip.
//!
//! Constant shear strength: A. R. Savkoor, thesis, Delft (1987); A. Chateauminois & C. Fretigny, Eur. Phys. J. E 27, 221
//! (2008), doi 10.1140/epje/i2008-10376-5. Coulomb friction: R. D. Mindlin, J. Appl. Mech. 16, 259 (1949), doi
//! 10.1115/1.4009973. ν = 0.499, where normal and tangential tractions of a rigid flat and a half space do not couple;
//! ω₀ = 0.05 ω_c, a = 0.0001 R. The flat moves 1.3 times as far as gross slip takes.
//!
//! The references take the traction to be along the displacement of the flat. The slip is off that direction by an angle
//! of order ν/(4 − 2ν) = 1/6 times the slipping share, of which the friction force loses the cosine: 0.2 %.

use tables::closed_forms::partial_slip::{constant_shear, mindlin, stick_stiffness};
use tables::quantity::{Quantity, State};

use super::setup::{Hertz, at_slip, last, mesh, over, plain_material, pressed, scene, shear_strength};
use super::{Case, Computed, Cost, Reference, Row, Rows, Tolerance};
use crate::discretisation::mesh::EDGE_SIZE;
use crate::scene::{FrictionLaw, Scene};
use crate::simulate::outcome::Outcome;
use crate::simulate::{SimulationError, Watch, simulate};

const POISSON: f64 = 0.499;
/// τ₀ = f_τ σ_Y/√3 low enough that the body stays elastic.
const STRENGTH_FACTOR: f64 = 0.1;
pub(super) const FRICTION: f64 = 0.05;
/// Mesh and angles are given: only the increments, a seventh of the slip, follow the accuracy. The curves are read between
/// them along straight lines.
const ACCURACY: f64 = 0.009;
/// Relative, of forces: the direction of slip.
const DIRECTION: f64 = 0.002;

const SAVKOOR: &str = "Savkoor 1987; Chateauminois & Fretigny 2008, doi 10.1140/epje/i2008-10376-5";
const MINDLIN: &str = "Mindlin 1949, doi 10.1115/1.4009973";

pub const CASES: [Case; 4] = [
    Case::new("constant shear strength, 8 elements", Cost::Quick, |watch| shear(&ON_8, watch)),
    Case::new("Coulomb friction, 8 elements", Cost::Quick, |watch| coulomb(&ON_8, watch)),
    Case::new("constant shear strength, 16 elements", Cost::Long, |watch| shear(&ON_16, watch)),
    Case::new("Coulomb friction, 16 elements", Cost::Long, |watch| coulomb(&ON_16, watch)),
];

/// Tolerances on a mesh.
pub(super) struct On {
    elements: usize,
    /// Relative tolerance of Q and the stiffness.
    pub(super) force: f64,
    /// Tolerance of energies over τ₀πa²δ_s.
    energy: f64,
    /// Relative tolerance of the displacement at gross slip: the stiffness, and the extrapolation of the mobilised strength.
    inception: f64,
}

pub(super) const ON_8: On = On { elements: 8, force: 0.024, energy: 0.015, inception: 0.027 };
const ON_16: On = On { elements: 16, force: 0.01, energy: 0.006, inception: 0.013 };

impl On {
    fn row(
        &self,
        name: String,
        computed: impl Into<Computed>,
        reference: Reference,
        tolerance: Tolerance,
    ) -> Row {
        Row::new(format!("{name}, {} elements", self.elements), computed, reference, tolerance)
    }

    fn force(&self) -> Tolerance {
        Tolerance::relative(self.force, "mesh, 0.5 n_c^-1.5; direction of slip, 0.2 %")
    }

    fn inception(&self) -> Tolerance {
        Tolerance::relative(self.inception, "mesh, 0.5 n_c^-1.5; extrapolation, 0.5 %")
    }

    /// Tolerance of c²/a²: half a ring of nodes at c. Ring spacings h fall from 1.6 a/n_c at the apex to a/(3 n_c) at the edge in
    /// arithmetic progression, so that h² is linear in r.
    fn stick(&self, stick_radius: f64) -> Tolerance {
        const APEX: f64 = 1.6;
        let spacing = (APEX * APEX - (APEX * APEX - EDGE_SIZE * EDGE_SIZE) * stick_radius).sqrt();
        let half_ring = stick_radius * spacing / self.elements as f64;
        Tolerance::absolute(half_ring, "sticking is a property of nodes: half a ring at c")
    }

    /// Q(u) and stick area over the forces and displacements of gross slip.
    fn curves(&self, outcome: &Outcome, gross: &GrossSlip) -> Vec<Row> {
        let rows = [0.25, 0.5, 0.75].map(|x| {
            let at = |value: fn(State<'_>) -> f64| at_slip(outcome, x * gross.displacement, value);
            let reference = |value: f64| Reference::exact(value, gross.source);
            let q = at(|step| step[Quantity::Friction]) / gross.force;
            let stick = at(|step| step[Quantity::StickFraction]);
            let (law, stick_radius) = (gross.law, (gross.stick_radius)(x));
            [
                self.row(
                    format!("{law}: Q over that of gross slip at u/u_s = {x}"),
                    q,
                    reference((gross.force_fraction)(x)).known_to(DIRECTION),
                    self.force(),
                ),
                self.row(
                    format!("{law}: c2/a2 at u/u_s = {x}"),
                    stick,
                    reference(stick_radius * stick_radius),
                    self.stick(stick_radius),
                ),
            ]
        });
        rows.into_iter().flatten().collect()
    }
}

/// Gross slip of a reference.
struct GrossSlip {
    law: &'static str,
    force: f64,
    displacement: f64,
    force_fraction: fn(f64) -> f64,
    stick_radius: fn(f64) -> f64,
    source: &'static str,
}

pub(super) fn scene_of(law: FrictionLaw, elements: usize) -> (Scene, Hertz) {
    let mut scene = scene(plain_material(POISSON), law, 0.05, mesh(elements, 4));
    scene.interface.strength_factor = STRENGTH_FACTOR;
    scene.numerics.accuracy = ACCURACY;
    let hertz = Hertz::of(&scene);
    (scene, hertz)
}

fn slide(mut scene: Scene, hertz: &Hertz, gross: f64, watch: &dyn Watch) -> Result<Outcome, SimulationError> {
    scene.loading.slip_distance = 1.3 * gross / hertz.contact_radius;
    simulate(&scene, watch)
}

/// The load of an uncoupled contact does not change while it slides.
fn uncoupled(on: &On, law: &str, outcome: &Outcome) -> Row {
    let reference = Reference::exact(1.0, "no coupling at nu = 0.5, Johnson 1985, sec. 5.4");
    let change = last(outcome)[Quantity::Load] / pressed(outcome)[Quantity::Load];
    let tolerance = Tolerance::relative(0.001, "coupling of order 1 - 2 nu = 0.2 % times Q/P < 0.3");
    on.row(format!("{law}: P at the end over P of the press"), change, reference, tolerance)
}

fn shear(on: &On, watch: &dyn Watch) -> Rows {
    let (scene, hertz) = scene_of(FrictionLaw::ShearStrength, on.elements);
    let strength = shear_strength(&scene);
    let (g, a) = (hertz.tangential_modulus, hertz.contact_radius);
    let gross = GrossSlip {
        law: "constant shear",
        force: hertz.area() * strength,
        displacement: constant_shear::gross_slip_displacement(strength, g, a),
        force_fraction: constant_shear::force_fraction,
        stick_radius: constant_shear::stick_radius_fraction,
        source: SAVKOOR,
    };
    let outcome = slide(scene, &hertz, gross.displacement, watch)?;
    let mut rows = on.curves(&outcome, &gross);
    let mut add = |name: &str, computed: Computed, reference: f64, unit, tolerance| {
        let reference = Reference::exact(reference, SAVKOOR).known_to(DIRECTION);
        rows.push(on.row(format!("constant shear: {name}"), computed, reference, tolerance).unit(unit));
    };
    let first = outcome.slide.state(1);
    add(
        "stiffness 8G*a",
        (first[Quantity::Friction] / first[Quantity::Slip]).into(),
        stick_stiffness(g, a),
        "N m-1",
        on.force(),
    );
    // Beyond gross slip the stored energy stays, and work and dissipation grow alike.
    let end = last(&outcome);
    let sliding = end[Quantity::Friction] * (end[Quantity::Slip] - gross.displacement);
    let unit = gross.force * gross.displacement;
    let (work, stored, dissipated) = constant_shear::energies_at_gross_slip();
    for (name, computed, reference) in [
        ("work to gross slip over its unit", end[Quantity::Work] - sliding, work),
        ("stored energy over its unit", end[Quantity::EnergyElastic], stored),
        ("dissipation over its unit", end[Quantity::DissipationFriction] - sliding, dissipated),
    ] {
        let tolerance = Tolerance::absolute(on.energy, "that of Q times Q u_s");
        add(name, (computed / unit).into(), reference, "1", tolerance);
    }
    let slip = outcome.scalars[Quantity::InceptionSlip];
    add("displacement at gross slip", slip.into(), gross.displacement, "m", on.inception());
    let energy = outcome.scalars[Quantity::EnergyRelease].scaled(1.0 / (strength * gross.displacement));
    let tolerance = Tolerance::absolute(on.energy, "that of Q times Q u_s");
    add("G over tau_0 u_s", energy.into(), dissipated, "1", tolerance);
    let stress = end[Quantity::Friction] / end[Quantity::Area] / strength;
    let tolerance = Tolerance::relative(0.001, "mean square of the angles of slip");
    add("Q/A over tau_0 in gross slip", stress.into(), 1.0, "1", tolerance);
    rows.push(uncoupled(on, "constant shear", &outcome));
    Ok(rows)
}

fn coulomb(on: &On, watch: &dyn Watch) -> Rows {
    let law = FrictionLaw::Coulomb { friction: FRICTION, cap: false };
    let (scene, hertz) = scene_of(law, on.elements);
    let (g, a) = (hertz.tangential_modulus, hertz.contact_radius);
    let displacement = |load: f64| mindlin::gross_slip_displacement(FRICTION, load, g, a);
    let outcome = slide(scene, &hertz, displacement(hertz.load), watch)?;
    // The computed P sets the scale of Coulomb friction.
    let load = pressed(&outcome)[Quantity::Load];
    let gross = GrossSlip {
        law: "Coulomb",
        force: FRICTION * load,
        displacement: displacement(load),
        force_fraction: mindlin::force_fraction,
        stick_radius: mindlin::stick_radius_fraction,
        source: MINDLIN,
    };
    let mut rows = on.curves(&outcome, &gross);
    let exact = |value: f64| Reference::exact(value, MINDLIN).known_to(DIRECTION);
    let slip = outcome.scalars[Quantity::InceptionSlip];
    let name = "Coulomb: displacement at gross slip over u_s".to_owned();
    rows.push(on.row(name, over(slip, gross.displacement), exact(1.0), on.inception()));
    // Of the work 3/5 μP u_s two thirds are stored.
    let unit = gross.force * gross.displacement / last(&outcome)[Quantity::Area];
    let energy = outcome.scalars[Quantity::EnergyRelease].scaled(1.0 / unit);
    let tolerance = Tolerance::absolute(on.energy, "that of Q times Q u_s");
    rows.push(on.row("Coulomb: G A over mu P u_s".to_owned(), energy, exact(0.2), tolerance));
    let mu = last(&outcome)[Quantity::Friction] / last(&outcome)[Quantity::Load] / FRICTION;
    let tolerance = Tolerance::relative(0.001, "mean square of the angles of slip");
    rows.push(on.row("Coulomb: Q/P over mu in gross slip".to_owned(), mu, exact(1.0), tolerance));
    rows.push(uncoupled(on, "Coulomb", &outcome));
    Ok(rows)
}
