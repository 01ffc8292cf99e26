//! Contact of the asperity's surface with the rigid flat, node by node.
//!
//! Normal: unilateral, p ≥ 0. Tangential: stick below a given limit of the shear traction, slip along the traction at
//! the limit. Both are penalty springs, which are not stiff to the solver because the preconditioner contains them
//! exactly. Their compliance is that of a layer of 1/50 (tangentially in the slide 1/10) of a ring spacing and vanishes
//! with the mesh. The law is associative (the limit is given), so the tangent is symmetric.
//!
//! Fields over the contact are ring by ring, columns of θ within: `[ring*columns + j]`; vectors have (r, θ)
//! components. Areas and forces are those of the half body.

use crate::discretisation::collocation::Collocation;
use crate::discretisation::element::RevolvedMesh;
use crate::discretisation::mesh::sphere_height;
pub use state::{PointState, Status};

mod areas;
mod edge;
mod forces;
mod resultants;
mod state;

/// Stiffness of the penalty springs in units of E*/(ring spacing): normal, c_n, and tangential in the press, c_t.
const NORMAL_SPRING: f64 = 50.0;
const PRESS_SPRING: f64 = 50.0;
/// c_t of the slide. Near slipping points a stiffer one costs iterations; a softer one saves none.
const SLIDE_SPRING: f64 = 10.0;
/// c_t in the step in which a point touches: it touches somewhere in the step, moves freely until then
/// and is held from then on. With a spring about as stiff as the body the point moves half-way, so that the load of a
/// full-stick press hardly depends on the increments: at ν = 0 and n_c = 16 it is 1.0542 times that without friction
/// with 32 increments and 1.0535 with 300, where the limit is 1.0529.
const TOUCH_SPRING: f64 = 0.5;

/// Position of the flat: interference and displacement along +x, in units of R.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FlatPosition {
    pub interference: f64,
    pub displacement: f64,
}

/// Symmetric 3 × 3 stiffness of a contact node over (r, θ, z), as force per displacement.
pub type NodeStiffness = [[f64; 3]; 3];

#[derive(Clone, Debug)]
pub struct Contact {
    pub radii: Vec<f64>,
    pub columns: usize,
    pub angles: Vec<f64>,
    /// Nodes of the meridian, ring by ring.
    nodes: Vec<u32>,
    /// A_i = ∫N dA of each node on the flat, in the trial state.
    pub areas: Vec<f64>,
    /// ∫N dA of each node on the flat, in the committed state.
    committed_areas: Vec<f64>,
    sectors: Collocation,
    height: Vec<f64>,
    normal_spring: Vec<f64>,
    tangential_spring: Vec<f64>,
    /// Share of the tangential spring in the step in which a point touches.
    touching_share: f64,
    pub committed: Vec<PointState>,
    pub trial: Vec<PointState>,
    /// χ: part of each node's area inside the contact edge.
    pub contact_fraction: Vec<f64>,
    /// Outermost ring that touched at each angle in the last iterate of Newton's method.
    rings_before: Vec<Option<usize>>,
    /// Points that are in contact since the start of the present motion.
    since_start: Vec<bool>,
    pub stiffness: Vec<NodeStiffness>,
    /// c_ν, see [`shear_slope`]; 0 in the press.
    shear_slope: f64,
}

/// c_ν = (1 − 2ν)/((1 − ν)E*): slope of the surface of a half-space over the shear traction along it (K. L. Johnson, *Contact
/// Mechanics*, 1985, eq. 2.25b): it closes the gap where the traction points into the contact.
fn shear_slope(modulus: f64, poisson_ratio: f64) -> f64 {
    (1.0 - 2.0 * poisson_ratio) / ((1.0 - poisson_ratio) * modulus)
}

impl Contact {
    /// Contact not yet touched; `modulus` is E* in the problem's units.
    pub fn new(mesh: &RevolvedMesh, modulus: f64) -> Self {
        Self::with_springs(mesh, modulus, PRESS_SPRING)
    }

    fn with_springs(mesh: &RevolvedMesh, modulus: f64, tangential: f64) -> Self {
        let radii = mesh.meridian.contact_radii();
        let last = radii.len() - 1;
        let spacing = |k: usize| match k {
            0 => radii[1],
            k if k == last => radii[k] - radii[k - 1],
            k => 0.5 * (radii[k + 1] - radii[k - 1]),
        };
        let columns = mesh.sectors.columns();
        let points = radii.len() * columns;
        Self {
            columns,
            angles: mesh.sectors.angles(),
            nodes: mesh.meridian.contact.clone(),
            areas: mesh.contact_areas(),
            committed_areas: mesh.contact_areas(),
            sectors: mesh.sectors.clone(),
            height: radii.iter().map(|&r| sphere_height(r)).collect(),
            normal_spring: (0..=last).map(|k| NORMAL_SPRING * modulus / spacing(k)).collect(),
            touching_share: TOUCH_SPRING / tangential,
            tangential_spring: (0..=last).map(|k| tangential * modulus / spacing(k)).collect(),
            committed: vec![PointState::default(); points],
            trial: vec![PointState::default(); points],
            contact_fraction: vec![1.0; points],
            rings_before: vec![None; columns],
            since_start: vec![true; points],
            stiffness: vec![[[0.0; 3]; 3]; points],
            shear_slope: 0.0,
            radii,
        }
    }

    /// The contact of an axisymmetric press, at all angles, ready to slide: tractions and
    /// displacements are unchanged; the anchors are moved so that the springs of the slide have the same force.
    pub fn revolve(
        axisymmetric: &Contact,
        mesh: &RevolvedMesh,
        (modulus, poisson_ratio): (f64, f64),
    ) -> Self {
        let mut contact = Self::with_springs(mesh, modulus, SLIDE_SPRING);
        contact.shear_slope = shear_slope(modulus, poisson_ratio);
        contact.committed = mesh.sectors.spread(&axisymmetric.committed);
        for (i, state) in contact.committed.iter_mut().enumerate() {
            let spring = contact.tangential_spring[i / contact.columns];
            state.anchor = std::array::from_fn(|c| state.relative[c] - state.traction[c] / spring);
        }
        contact.trial = contact.committed.clone();
        // Areas of the press are those of the whole half circle.
        contact.areas = mesh.sectors.spread(&axisymmetric.areas);
        contact.areas.iter_mut().for_each(|area| *area /= contact.columns as f64);
        contact.committed_areas = contact.areas.clone();
        contact.contact_fraction = mesh.sectors.spread(&axisymmetric.contact_fraction);
        contact.start_motion();
        contact
    }

    /// Points that touch stick where they are: friction begins after a press without it.
    pub fn stick(&mut self) {
        for state in self.committed.iter_mut().filter(|state| state.status == Status::Slip) {
            (state.status, state.slip) = (Status::Stick, 0.0);
        }
        self.trial = self.committed.clone();
    }

    /// [`PointState::elevation`] of all points.
    pub fn elevation(&self) -> Vec<[f64; 2]> {
        self.trial.iter().map(|state| state.elevation).collect()
    }

    /// Sets the elevation of the flat.
    pub fn raise(&mut self, elevation: &[[f64; 2]]) {
        self.trial.iter_mut().zip(elevation).for_each(|(state, elevation)| state.elevation = *elevation);
    }

    pub fn len(&self) -> usize {
        self.areas.len()
    }

    /// Index of a component of a contact point in a vector field.
    pub fn vector_index(&self, point: usize, component: usize) -> usize {
        (self.nodes[point / self.columns] as usize * 3 + component) * self.columns + point % self.columns
    }

    /// Index of a contact point in a scalar field.
    pub fn scalar_index(&self, point: usize) -> usize {
        self.nodes[point / self.columns] as usize * self.columns + point % self.columns
    }

    /// Tractions at the displacement `u(index)` of the body, see [`Contact::vector_index`], given the limit of the shear traction
    /// at each point; sets the trial state and the contact stiffness.
    ///
    /// A point outside the last ring that touches transmits friction while its limit is positive: the edge lies in its cell,
    /// and friction does not jump as a ring touches or lifts off.
    pub fn evaluate(&mut self, u: impl Fn(usize) -> f64, flat: FlatPosition, limit: &[f64]) {
        // Whether a ring further out touches, at each angle.
        let mut inside = vec![false; self.columns];
        for i in (0..self.len()).rev() {
            let (ring, column) = (i / self.columns, i % self.columns);
            let (sin, cos) = self.angles[column].sin_cos();
            let at = |c: usize| u(self.vector_index(i, c));
            let relative = [flat.displacement * cos - at(0), -flat.displacement * sin - at(1)];
            let penetration = self.height[ring] + at(2) + flat.interference + self.trial[i].elevation[0];
            let pressure = self.normal_spring[ring] * penetration;
            let state = &mut self.trial[i];
            (state.gap, state.relative, state.pressure) = (-penetration, relative, pressure.max(0.0));
            self.stiffness[i] = [[0.0; 3]; 3];
            if pressure > 0.0 {
                inside[column] = true;
                self.stiffness[i][2][2] = self.areas[i] * self.normal_spring[ring];
                self.evaluate_shear(i, limit[i]);
            } else if !inside[column] && limit[i] > 0.0 && limit[i].is_finite() {
                self.evaluate_shear(i, limit[i]);
            } else {
                (state.status, state.traction, state.slip) = (Status::Open, [0.0; 2], self.committed[i].slip);
            }
        }
    }

    /// Shear traction of a point in contact: stick below the limit τ_c, else τ = τ_c τᵗ/|τᵗ| with the trial traction τᵗ of
    /// stick.
    #[inline(always)]
    fn evaluate_shear(&mut self, i: usize, limit: f64) {
        let tangential = self.tangential_spring[i / self.columns];
        let (area, relative) = (self.areas[i], self.trial[i].relative);
        let state = &mut self.trial[i];
        let before = &self.committed[i];
        // The spring over the usual one, the displacement at which it has no force, and the slip over its excess force. Where a
        // covered part of the cell does not reach the point itself, the spring stays soft, and begins as one of that part.
        let (touches, soft) = (state.pressure > 0.0, self.touching_share);
        let (start, share, yielding) = match before.status {
            Status::Open if touches => (before.relative, soft, 1.0),
            Status::Open => (before.relative, soft * self.contact_fraction[i], 1.0),
            _ if touches => (before.anchor, 1.0, 1.0),
            _ => {
                let without_force = |c: usize| before.relative[c] - before.traction[c] / (soft * tangential);
                (std::array::from_fn(without_force), soft, soft)
            }
        };
        let trial_traction: [f64; 2] = std::array::from_fn(|c| share * tangential * (relative[c] - start[c]));
        let size = trial_traction[0].hypot(trial_traction[1]);
        state.limit = limit;
        if size <= limit && limit > 0.0 {
            state.status = Status::Stick;
            state.traction = trial_traction;
            state.slip = before.slip;
            for c in 0..2 {
                self.stiffness[i][c][c] = area * share * tangential;
            }
        } else {
            state.status = Status::Slip;
            let direction = if size > 0.0 { trial_traction.map(|t| t / size) } else { [1.0, 0.0] };
            let reduction = if size > 0.0 { limit / size } else { 0.0 };
            state.traction = direction.map(|d| limit * d);
            state.slip = before.slip + (size - limit) / (yielding * tangential);
            for c in 0..2 {
                for d in 0..2 {
                    let unit = if c == d { 1.0 } else { 0.0 };
                    self.stiffness[i][c][d] =
                        area * share * tangential * reduction * (unit - direction[c] * direction[d]);
                }
            }
        }
        state.anchor = std::array::from_fn(|c| relative[c] - state.traction[c] / tangential);
    }

    /// Takes the trial state as the committed one.
    pub fn commit(&mut self) {
        self.committed.clone_from(&self.trial);
        self.committed_areas.copy_from_slice(&self.areas);
        for (since_start, state) in self.since_start.iter_mut().zip(&self.committed) {
            *since_start &= state.pressure > 0.0;
        }
    }

    /// A motion starts from the committed state.
    pub fn start_motion(&mut self) {
        self.since_start = self.committed.iter().map(|state| state.pressure > 0.0).collect();
    }
}

#[cfg(test)]
mod tests;
