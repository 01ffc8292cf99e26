//! Increase of the strength with the strain rate: a material point against the closed form, and the interface.
//!
//! Without hardening a point strained at a constant rate obeys 3G(ε̇ − ε̇_p) = σ_Y C ε̈_p/ε̇_p once it flows, which makes
//! r = ε̇_p/ε̇₀ the logistic function of time; at held strain 1/r grows linearly until r = 1.

use std::f64::consts::PI;

use tables::quantity::{Quantity, State};

use super::setup::{last, mesh, plain_material, scene, shear_strength};
use super::{Case, Cost, Reference, Row, Rows, Tolerance};
use crate::material::{Solid, StrainPath, Trial};
use crate::scene::{FrictionLaw, Material, Rate, Scene, Switch};
use crate::simulate::{Watch, simulate};

const LAW: &str = "Johnson & Cook 1983, Proc. 7th Int. Symp. Ballistics, 541";
const LOGISTIC: &str = "logistic function of time, Johnson & Cook 1983 without hardening";
/// C, and ε̇₀ in 1/s.
const COEFFICIENT: f64 = 0.05;
pub(super) const REFERENCE: f64 = 2.0;
/// ε̇/ε̇₀.
const RATE: f64 = 1e4;
/// √⅔.
const TO_RADIUS: f64 = 0.816_496_580_927_726;

pub const CASES: [Case; 2] = [
    Case::new("material point at a constant strain rate", Cost::Quick, |_| Ok(material_point())),
    Case::new("interface at the strain rate V/a", Cost::Quick, interface),
];

fn rated_material() -> Material {
    let rate = Rate::JohnsonCook { coefficient: COEFFICIENT, reference: REFERENCE };
    Material { rate, ..plain_material(0.3) }
}

/// A point under uniaxial deviatoric strain; stresses over σ_Y.
struct Point {
    solid: Solid,
    stress: f64,
    strain: f64,
}

impl Point {
    /// A material point at first yield, at the reference strain rate.
    fn yielding() -> Self {
        Self { solid: Solid::new(&rated_material(), 298.0), stress: 1.0, strain: 0.0 }
    }

    /// The time, s, in which the stress approaches that of the strain rate ε̇.
    fn relaxation_time(&self) -> f64 {
        COEFFICIENT / (3.0 * self.solid.moduli.shear * RATE * REFERENCE)
    }

    /// Steps at a strain rate (1/s) over a time (s); returns q.
    fn advance(&mut self, strain_rate: f64, time: f64, steps: usize) -> f64 {
        let time_step = time / steps as f64;
        // Deviator of q: ⅔q and −⅓q.
        let deviator = |q: f64| [2.0, -1.0, -1.0, 0.0, 0.0, 0.0].map(|share| [share / 3.0 * q]);
        for _ in 0..steps {
            let elastic = self.stress + 3.0 * self.solid.moduli.shear * strain_rate * time_step;
            let trial = Trial {
                flowing: [true],
                strain: [self.strain],
                strength: [1.0],
                softening: [1.0],
                guess: [0.0],
                time_step,
            };
            let end = self.solid.flow(&StrainPath {
                trial,
                start: &deviator(self.stress),
                elastic: &deviator(elastic),
            });
            self.strain += end.increment[0];
            self.stress = end.radius[0] / TO_RADIUS;
        }
        self.stress
    }
}

/// q over σ_Y at ε̇_p/ε̇₀.
pub(super) fn strength(rate: f64) -> f64 {
    1.0 + COEFFICIENT * rate.ln()
}

/// Relative change of the strength with the logarithm of the rate.
pub(super) fn sensitivity(rate: f64) -> f64 {
    COEFFICIENT / strength(rate)
}

fn material_point() -> Vec<Row> {
    let rate = RATE * REFERENCE;
    let time = Point::yielding().relaxation_time();
    // Where the rate is half of that of the strain.
    let half = (RATE - 1.0).ln() * time;
    let exact = strength(0.5 * RATE);
    let [coarse, fine] = [200, 400].map(|steps| (Point::yielding().advance(rate, half, steps) - exact).abs());
    let mut point = Point::yielding();
    let steady = point.advance(rate, 40.0 * time, 400);
    // The strain is then held, until the rate is a thousandth.
    let held = 999.0 * time;
    let relaxed = point.advance(0.0, held, 20_000);
    vec![
        Row::new(
            "q/sigma_Y at a constant strain rate",
            steady,
            Reference::exact(strength(RATE), LAW),
            Tolerance::relative(1e-9, "steady"),
        ),
        Row::new(
            "q/sigma_Y where half of the strain rate is plastic, 400 steps",
            exact + fine,
            Reference::exact(exact, LOGISTIC),
            Tolerance::relative(1e-3, "steps, first order"),
        ),
        Row::new(
            "order of its error in the time step",
            (coarse / fine).log2(),
            Reference::exact(1.0, "backward Euler"),
            Tolerance::absolute(0.1, "next order"),
        ),
        Row::new(
            "q/sigma_Y at held strain, plastic strain rate down to 1/1000",
            relaxed,
            Reference::exact(strength(RATE / 1000.0), LOGISTIC),
            Tolerance::relative(1e-3, "steps, first order"),
        ),
    ]
}

/// Steel at 2 ω_c under an interface so weak that all of it slips, without heat.
pub(super) fn weak_interface(elements: usize) -> Scene {
    let mut scene = scene(rated_material(), FrictionLaw::ShearStrength, 2.0, mesh(elements, 4));
    scene.interface.strength_factor = 0.2;
    scene.model.heat = Switch::Off;
    scene
}

/// Q/A in a state of such a slide: the strength at the strain rate V/a.
pub(super) fn at_slip_rate(
    name: String,
    scene: &Scene,
    slip_rate: f64,
    state: State<'_>,
    source: &'static str,
) -> Row {
    let radius = (state[Quantity::Area] / PI).sqrt();
    let expected = slip_rate.signum() * strength((slip_rate.abs() / radius / REFERENCE).max(1.0));
    let shear = state[Quantity::Friction] / state[Quantity::Area] / shear_strength(scene);
    let tolerance = Tolerance::relative(1e-4, "coupling of the shear limits");
    Row::new(name, shear, Reference::exact(expected, source), tolerance)
}

fn interface(watch: &dyn Watch) -> Rows {
    let mut scene = weak_interface(6);
    scene.loading.slip_distance = 0.1;
    let mut rows = Vec::new();
    for slip_rate in [0.0, 1e-9, 0.01, 1.0] {
        scene.loading.slip_rate = slip_rate;
        let outcome = simulate(&scene, watch)?;
        let name = format!("Q/A over f tau_0 at {slip_rate} m/s");
        rows.push(at_slip_rate(name, &scene, slip_rate, last(&outcome), LAW));
    }
    Ok(rows)
}
