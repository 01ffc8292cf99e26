//! An elastic sphere pressed in full stick over the frictionless press on the same mesh.
//!
//! V. I. Mossakovskii, J. Appl. Math. Mech. 27, 630 (1963); D. A. Spence, Proc. R. Soc. A 305, 55 (1968), doi
//! 10.1098/rspa.1968.0105: punch stiffness larger by (1 − ν) ln(3 − 4ν)/(1 − 2ν). The ratios of a sphere at equal
//! interference are of an independent boundary-element solution (220 rings) that has that factor to 1e-6.

use tables::quantity::Quantity;

use super::setup::{mesh, plain_material, pressed, run_press, scene};
use super::{Case, Cost, Reference, Row, Rows, Tolerance};
use crate::scene::FrictionLaw;
use crate::simulate::{SimulationError, Watch};

const SPENCE: &str = "Mossakovskii 1963, Spence 1968, doi 10.1098/rspa.1968.0105; boundary elements";

/// ν, load and area over those without friction.
const RATIOS: [(f64, f64, f64); 3] =
    [(0.0, 1.05289, 0.91850), (0.3, 1.01621, 0.97601), (0.45, 1.00160, 0.99767)];

pub const CASES: [Case; 2] = [
    Case::new("full stick, 8 elements", Cost::Quick, |watch| rows(8, &RATIOS[1..2], 0.002, 0.017, watch)),
    Case::new("full stick, 16 elements", Cost::Medium, |watch| rows(16, &RATIOS, 0.001, 0.009, watch)),
];

fn rows(elements: usize, ratios: &[(f64, f64, f64)], forces: f64, areas: f64, watch: &dyn Watch) -> Rows {
    let mut rows = Vec::new();
    for &(poisson, load, area) in ratios {
        let computed = computed(poisson, elements, watch)?;
        let row = |name: &str, computed: f64, reference: f64, tolerance| {
            let name = format!("{name} in full stick over frictionless, nu = {poisson}, {elements} elements");
            Row::new(name, computed, Reference::exact(reference, SPENCE).known_to(1e-5), tolerance)
        };
        // The mesh error common to both presses cancels.
        let of_load = Tolerance::relative(forces, "an eighth of the mesh error of P");
        let of_area = Tolerance::relative(areas, "two edges, sqrt(2) 0.09/n_c");
        rows.extend([row("P", computed[0], load, of_load), row("A", computed[1], area, of_area)]);
    }
    Ok(rows)
}

/// Load and area in full stick over those without friction.
fn computed(poisson: f64, elements: usize, watch: &dyn Watch) -> Result<[f64; 2], SimulationError> {
    let pressed = |law| {
        let mut scene = scene(plain_material(poisson), law, 0.3, mesh(elements, 4));
        // Mesh and angles are given: this is for the increments, on which the stick tractions depend.
        scene.numerics.accuracy = 0.002;
        run_press(&scene, watch).map(|outcome| {
            let state = pressed(&outcome);
            [state[Quantity::Load], state[Quantity::Area]]
        })
    };
    let (slip, stick) = (pressed(FrictionLaw::Frictionless)?, pressed(FrictionLaw::FullStick)?);
    Ok([stick[0] / slip[0], stick[1] / slip[1]])
}
