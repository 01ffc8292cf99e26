//! An elastic sphere pressed in full stick over the frictionless press on the same mesh.
//!
//! V. I. Mossakovskii, J. Appl. Math. Mech. 27, 630 (1963); D. A. Spence, Proc. R. Soc. A 305, 55
//! (1968), doi 10.1098/rspa.1968.0105. The ratios at equal interference are of an independent
//! boundary-element solution (220 rings), which has the punch stiffness of Spence to 1e-6.

use super::setup::{mesh, plain_material, scene};
use super::{Extent, Row, Rows};
use crate::discretisation::mesh::EDGE_SIZE;
use crate::scene::FrictionLaw;
use crate::simulate::{PressedContact, SimulationError, Watch, press};

const SPENCE: &str = "Mossakovskii 1963, Spence 1968; boundary elements";

/// ν, load and area over those without friction.
const RATIOS: [(f64, f64, f64); 3] =
    [(0.0, 1.05289, 0.91850), (0.3, 1.01621, 0.97601), (0.45, 1.00160, 0.99767)];

pub fn rows(extent: Extent, watch: &dyn Watch) -> Rows {
    let chosen = match extent {
        Extent::Quick => &RATIOS[1..2],
        Extent::Full => &RATIOS,
    };
    let mut rows = Vec::new();
    for &(poisson, load, area) in chosen {
        let elements = extent.elements();
        let fine = ratios(poisson, elements, watch)?;
        let coarser = [ratios(poisson, elements / 2, watch)?, ratios(poisson, 3 * elements / 4, watch)?];
        // What the two presses have in common cancels: the errors are those of the ratios. They go up and
        // down with the place of the edge between the rings, so two coarser meshes tell more than one.
        // Friction alone makes a press depend on its increments.
        let mut row = |name: &str, of: fn(&Ratios) -> f64, floor: f64, reference: f64| {
            let apart = coarser.iter().map(|other| (of(&fine) - of(other)).abs()).fold(0.0, f64::max);
            let quantity = format!("{name} in full stick over frictionless, nu = {poisson}");
            rows.push(Row::new(quantity, of(&fine), apart + floor, reference, SPENCE));
        };
        // What friction adds comes with points that touch and hold on from then on: known to a ring.
        let ring = (fine.load - 1.0).abs() * EDGE_SIZE / elements as f64;
        row("P", |r| r.load, fine.steps + ring, load);
        row("A", |r| r.area, fine.edge, area);
    }
    Ok(rows)
}

struct Ratios {
    load: f64,
    area: f64,
    /// What the edges, found between rings of nodes, leave open of the area.
    edge: f64,
    /// What the increments of the press in stick leave open of the load.
    steps: f64,
}

fn ratios(poisson: f64, elements: usize, watch: &dyn Watch) -> Result<Ratios, SimulationError> {
    let pressed = |law| -> Result<PressedContact, SimulationError> {
        Ok(press(&scene(plain_material(poisson), law, 0.3, mesh(elements, 4)), watch)?.contact())
    };
    let (slip, stick) = (pressed(FrictionLaw::Frictionless)?, pressed(FrictionLaw::FullStick)?);
    Ok(Ratios {
        load: stick.load.value / slip.load.value,
        area: stick.area.value / slip.area.value,
        edge: std::f64::consts::SQRT_2
            * crate::simulate::accuracy::error_budget::edge_share(elements as f64)
            * 2.0,
        steps: stick.load_error_of_steps / slip.load.value,
    })
}
