//! An elastic sphere pressed in full stick.
//!
//! V. I. Mossakovskii, J. Appl. Math. Mech. 27, 630 (1963); D. A. Spence, Proc. R. Soc. A 305, 55 (1968), doi
//! 10.1098/rspa.1968.0105: punch stiffness larger by (1 − ν) ln(3 − 4ν)/(1 − 2ν). The ratios of a sphere to Hertz at equal
//! interference are of an independent boundary-element solution (220 rings) that has that factor to 1e-6. Of a hemisphere
//! on a rigid base, P is larger by 0.41 a/R: 0.01 % here.

use tables::quantity::Quantity;

use super::setup::{Hertz, mesh, plain_material, pressed, run_press, scene};
use super::{Case, Cost, Reference, Row, Rows, Tolerance};
use crate::scene::FrictionLaw;
use crate::simulate::{SimulationError, Watch};

const SPENCE: &str = "Mossakovskii 1963, Spence 1968, doi 10.1098/rspa.1968.0105; boundary elements";

/// ν, load and area over those of Hertz.
const RATIOS: [(f64, f64, f64); 4] =
    [(0.0, 1.05289, 0.91850), (0.2, 1.02819, 0.95700), (0.3, 1.01621, 0.97601), (0.45, 1.00160, 0.99767)];

pub const CASES: [Case; 2] = [
    Case::new("full stick, 8 elements", Cost::Quick, |watch| rows(8, 0.004, watch)),
    Case::new("full stick, 16 elements", Cost::Medium, |watch| rows(16, 0.002, watch)),
];

/// `forces`: tolerance of P.
fn rows(elements: usize, forces: f64, watch: &dyn Watch) -> Rows {
    let mut rows = Vec::new();
    for (poisson, load, area) in RATIOS {
        let computed = computed(poisson, elements, watch)?;
        let row = |name: &str, computed: f64, reference: f64, bound, why| {
            let name = format!("{name} in full stick over Hertz, nu = {poisson}, {elements} elements");
            let reference = Reference::exact(reference, SPENCE).known_to(1e-4);
            Row::new(name, computed, reference, Tolerance::relative(bound, why))
        };
        // At ν = 0 pressure and shear oscillate at the edge.
        let (areas, why) = match poisson {
            0.0 => (0.136 / elements as f64, "oscillating pressure at the edge, 0.136/n_c"),
            _ => (0.004, "edge of the contact"),
        };
        rows.extend([
            row("P", computed[0], load, forces, "mesh and increments"),
            row("A", computed[1], area, areas, why),
        ]);
    }
    Ok(rows)
}

/// Load and area over those of Hertz.
fn computed(poisson: f64, elements: usize, watch: &dyn Watch) -> Result<[f64; 2], SimulationError> {
    let mut scene = scene(plain_material(poisson), FrictionLaw::FullStick, 0.3, mesh(elements, 4));
    // Mesh and angles are given: this is for the increments, on which the stick tractions depend.
    scene.numerics.accuracy = 0.002;
    let outcome = run_press(&scene, watch)?;
    let (state, hertz) = (pressed(&outcome), Hertz::of(&scene));
    Ok([state[Quantity::Load] / hertz.load, state[Quantity::Area] / hertz.area()])
}
