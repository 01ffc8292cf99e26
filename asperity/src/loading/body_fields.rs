//! Fields of the body: displacement, stress, plastic strain and temperature on the meridian, at the
//! angles of the simulation.

use crate::discretisation::body::NODAL;
use crate::discretisation::element::RevolvedMesh;
use crate::heat::conduction::Conduction;
use crate::loading::problem::Units;
use crate::loading::state::SlideState;
use crate::solver::newton::Mechanics;

/// Fields of the body in chosen states.
///
/// Layout: `[(node*components + component)*angles.len() + j]`. Between the angles fields
/// are trigonometric polynomials, even in θ but for u_θ, σ_rθ and σ_θz, which are odd.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyFields {
    /// (r, z) of the nodes of the meridian before deformation, m; the apex is the origin.
    pub nodes: Vec<[f64; 2]>,
    /// Corners of the quadrilaterals, counter-clockwise in (r, z).
    pub quads: Vec<[u32; 4]>,
    /// θ_j = (j + ½)π/N_θ from the direction in which the flat moves.
    pub angles: Vec<f64>,
    pub snapshots: Vec<BodySnapshot>,
}

/// The fields in one state.
#[derive(Clone, Debug, PartialEq)]
pub struct BodySnapshot {
    /// m.
    pub slip: f64,
    /// s.
    pub time: f64,
    /// (u_r, u_θ, u_z), m.
    pub displacement: Vec<f64>,
    /// (rr, θθ, zz, rθ, θz, zr), Pa: means over the elements around a node. At finite strain the stress
    /// that works on the logarithmic strain per undeformed volume: Kirchhoff's where the principal axes
    /// do not turn.
    pub stress: Vec<f64>,
    /// Equivalent plastic strain, likewise.
    pub plastic_strain: Vec<f64>,
    /// K. At the surface that of friction, which may differ from the mean over the elements below.
    pub temperature: Vec<f64>,
}

impl BodySnapshot {
    pub(crate) fn of(
        now: &SlideState,
        mechanics: &Mechanics,
        conduction: Option<&Conduction>,
        units: &Units,
    ) -> Self {
        let means = mechanics.body.nodal_means(&mechanics.body.committed);
        let columns = mechanics.contact.angles.len();
        let scaled = |values: &[f64], unit: f64| values.iter().map(|value| unit * value).collect();
        let part = |from: usize, to: usize, unit: f64| {
            let per_node = means.chunks_exact(NODAL * columns);
            per_node.flat_map(|node| scaled(&node[from * columns..to * columns], unit)).collect()
        };
        let temperature = |rise: &f64| units.temperature + rise;
        Self {
            slip: now.slip * units.length,
            time: now.time * units.time,
            displacement: scaled(&mechanics.displacement, units.length),
            stress: part(0, NODAL - 1, units.stress),
            plastic_strain: part(NODAL - 1, NODAL, 1.0),
            temperature: match conduction {
                Some(c) => c.committed.rise[..c.body_length()].iter().map(temperature).collect(),
                None => vec![units.temperature; means.len() / NODAL],
            },
        }
    }
}

impl BodyFields {
    /// Fields of the recorded states; none if no states were recorded.
    pub(crate) fn new(mesh: &RevolvedMesh, snapshots: Vec<BodySnapshot>, units: &Units) -> Option<Self> {
        let scale = |&[r, z]: &[f64; 2]| [r * units.length, z * units.length];
        (!snapshots.is_empty()).then(|| Self {
            nodes: mesh.meridian.nodes.iter().map(scale).collect(),
            quads: mesh.meridian.quads.clone(),
            angles: mesh.sectors.angles(),
            snapshots,
        })
    }
}
