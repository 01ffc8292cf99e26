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

/// The fields in one state of a slide, dimensionless.
#[derive(Clone, Debug)]
pub struct RecordedBody {
    slip: f64,
    time: f64,
    displacement: Vec<f64>,
    /// See [`crate::discretisation::body::Body::nodal_means`].
    means: Vec<f64>,
    rise: Option<Vec<f64>>,
}

impl RecordedBody {
    pub(crate) fn of(now: &SlideState, mechanics: &Mechanics, conduction: Option<&Conduction>) -> Self {
        Self {
            slip: now.slip,
            time: now.time,
            displacement: mechanics.displacement.clone(),
            means: mechanics.body.nodal_means(&mechanics.body.committed),
            rise: conduction.map(|conduction| conduction.committed[..conduction.body_length()].to_vec()),
        }
    }

    fn snapshot(&self, units: &Units, nodes: usize) -> BodySnapshot {
        let scaled = |values: &[f64], unit: f64| values.iter().map(|value| unit * value).collect();
        let of_node = self.means.len() / nodes;
        let columns = of_node / NODAL;
        let part = |from: usize, to: usize, unit: f64| {
            let per_node = self.means.chunks_exact(of_node);
            per_node.flat_map(|node| scaled(&node[from * columns..to * columns], unit)).collect()
        };
        BodySnapshot {
            slip: self.slip * units.length,
            time: self.time * units.time,
            displacement: scaled(&self.displacement, units.length),
            stress: part(0, NODAL - 1, units.stress),
            plastic_strain: part(NODAL - 1, NODAL, 1.0),
            temperature: match &self.rise {
                Some(rise) => rise.iter().map(|rise| units.temperature + rise).collect(),
                None => vec![units.temperature; nodes * columns],
            },
        }
    }
}

impl BodyFields {
    /// In SI units; none if no states were recorded.
    pub(crate) fn new(mesh: &RevolvedMesh, states: &[RecordedBody], units: &Units) -> Option<Self> {
        let scale = |&[r, z]: &[f64; 2]| [r * units.length, z * units.length];
        (!states.is_empty()).then(|| Self {
            nodes: mesh.meridian.nodes.iter().map(scale).collect(),
            quads: mesh.meridian.quads.clone(),
            angles: mesh.sectors.angles(),
            snapshots: states.iter().map(|state| state.snapshot(units, mesh.node_count())).collect(),
        })
    }
}
