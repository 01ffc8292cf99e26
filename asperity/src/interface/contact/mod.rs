//! Contact of the asperity's surface with the rigid flat, node by node.
//!
//! Normal: unilateral, p ≥ 0. Tangential: stick below a given limit of the shear traction, slip
//! along the traction at the limit. Both by springs, which cost nothing as the preconditioner
//! inverts them exactly: they yield as a layer of a fiftieth (tangentially in the slide a tenth) of
//! a ring spacing would, and that vanishes with the mesh. The law is associative (the limit is given), the
//! tangent symmetric.
//!
//! Fields over the contact are ring by ring, columns of θ within: `[ring*columns + j]`; vectors
//! have (r, θ) components. Areas and forces are those of the half body.

use crate::discretisation::collocation::Collocation;
use crate::discretisation::element::RevolvedMesh;
use crate::discretisation::mesh::sphere_height;
use crate::interface::contact_edge;

mod stretch;

/// Stiffness of the constraint springs in units of E*/(ring spacing).
const NORMAL_SPRING: f64 = 50.0;
const PRESS_SPRING: f64 = 50.0;
/// Beside points that slip a stiffer spring costs iterations: a slide at 16 elements per radius took
/// 141, 136, 142 and 151 Newton iterations with 1, 3, 10 and 30.
const SLIDE_SPRING: f64 = 10.0;
/// A point that touches does so somewhere in the step: until then it moves freely, from then on it
/// is held. About as stiff as the body itself, this spring lets it go about half-way, and the load
/// of a full-stick press hardly depends on the increments: at ν = 0 it is 1.0542 times that without
/// friction with 32 increments and 1.0535 with 300 (n_c = 16), where the limit is 1.0529. Held from
/// the beginning of the step on it was 1.0575 and 1.0540.
const TOUCH_SPRING: f64 = 0.5;

/// The edge is half a spacing and 0.62 further out than where the cell of a ring begins when the next one touches.
const MOST_OF_A_CELL: f64 = 1.13;

/// What a contact point does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Carries nothing.
    Open,
    Stick,
    Slip,
}

/// What the contact remembers.
#[derive(Clone, Debug)]
pub struct ContactState {
    pub status: Vec<Status>,
    /// p.
    pub pressure: Vec<f64>,
    /// Gap, positive when open.
    pub gap: Vec<f64>,
    /// Shear traction of the flat on the asperity.
    pub traction: Vec<[f64; 2]>,
    /// Displacement of the flat relative to the surface.
    pub relative: Vec<[f64; 2]>,
    /// Where a sticking point holds on to the flat.
    pub anchor: Vec<[f64; 2]>,
    /// Path length of slip.
    pub slip: Vec<f64>,
}

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
    /// ∫N dA of each node on the flat, in the trial state.
    pub areas: Vec<f64>,
    /// The same in the committed state.
    committed_areas: Vec<f64>,
    sectors: Collocation,
    height: Vec<f64>,
    normal_spring: Vec<f64>,
    tangential_spring: Vec<f64>,
    /// Of the tangential spring, in the step in which a point touches.
    touching_share: f64,
    pub committed: ContactState,
    pub trial: ContactState,
    /// Share of each node's area that is covered by the contact, 1 but at the edge.
    pub cover: Vec<f64>,
    pub stiffness: Vec<NodeStiffness>,
}

impl ContactState {
    fn new(points: usize) -> Self {
        Self {
            status: vec![Status::Open; points],
            pressure: vec![0.0; points],
            gap: vec![0.0; points],
            traction: vec![[0.0; 2]; points],
            relative: vec![[0.0; 2]; points],
            anchor: vec![[0.0; 2]; points],
            slip: vec![0.0; points],
        }
    }

    fn spread(&self, columns: usize) -> Self {
        fn spread<T: Copy>(v: &[T], columns: usize) -> Vec<T> {
            v.iter().flat_map(|&x| std::iter::repeat_n(x, columns)).collect()
        }
        Self {
            status: spread(&self.status, columns),
            pressure: spread(&self.pressure, columns),
            gap: spread(&self.gap, columns),
            traction: spread(&self.traction, columns),
            relative: spread(&self.relative, columns),
            anchor: spread(&self.anchor, columns),
            slip: spread(&self.slip, columns),
        }
    }
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
            committed: ContactState::new(points),
            trial: ContactState::new(points),
            cover: vec![1.0; points],
            stiffness: vec![[[0.0; 3]; 3]; points],
            radii,
        }
    }

    /// The contact of an axisymmetric press, at all angles, ready to slide: tractions and
    /// displacements are kept, the anchors moved to where the springs of the slide hold them.
    pub fn revolve(axisymmetric: &Contact, mesh: &RevolvedMesh, modulus: f64) -> Self {
        let mut contact = Self::with_springs(mesh, modulus, SLIDE_SPRING);
        contact.committed = axisymmetric.committed.spread(contact.columns);
        for i in 0..contact.len() {
            let spring = contact.tangential_spring[i / contact.columns];
            let state = &mut contact.committed;
            state.anchor[i] = std::array::from_fn(|c| state.relative[i][c] - state.traction[i][c] / spring);
        }
        contact.trial = contact.committed.clone();
        // Of the whole circle in the press.
        let share = |area: &f64| std::iter::repeat_n(area / contact.columns as f64, contact.columns);
        contact.areas = axisymmetric.areas.iter().flat_map(share).collect();
        contact.committed_areas = contact.areas.clone();
        contact.cover =
            axisymmetric.cover.iter().flat_map(|&c| std::iter::repeat_n(c, contact.columns)).collect();
        contact
    }

    pub fn len(&self) -> usize {
        self.areas.len()
    }

    /// Place of component c of contact point i in a vector field.
    pub fn place(&self, point: usize, component: usize) -> usize {
        (self.nodes[point / self.columns] as usize * 3 + component) * self.columns + point % self.columns
    }

    /// Place of contact point i in a scalar field.
    pub fn scalar_place(&self, point: usize) -> usize {
        self.nodes[point / self.columns] as usize * self.columns + point % self.columns
    }

    /// Tractions at the displacement `u(place)` of the body, given the limit of the shear traction
    /// at each point; sets the trial state and the contact stiffness.
    pub fn evaluate(&mut self, u: impl Fn(usize) -> f64, flat: FlatPosition, limit: &[f64]) {
        for i in 0..self.len() {
            let ring = i / self.columns;
            let (sin, cos) = self.angles[i % self.columns].sin_cos();
            let at = |c: usize| u(self.place(i, c));
            let relative = [flat.displacement * cos - at(0), -flat.displacement * sin - at(1)];
            let penetration = self.height[ring] + at(2) + flat.interference;
            let (normal, tangential) = (self.normal_spring[ring], self.tangential_spring[ring]);
            let pressure = normal * penetration;
            let state = &mut self.trial;
            state.gap[i] = -penetration;
            state.relative[i] = relative;
            self.stiffness[i] = [[0.0; 3]; 3];
            if pressure <= 0.0 {
                state.status[i] = Status::Open;
                state.pressure[i] = 0.0;
                state.traction[i] = [0.0; 2];
                state.slip[i] = self.committed.slip[i];
                continue;
            }
            state.pressure[i] = pressure;
            let area = self.areas[i];
            self.stiffness[i][2][2] = area * normal;
            let (start, share) = match self.committed.status[i] {
                Status::Open => (self.committed.relative[i], self.touching_share),
                _ => (self.committed.anchor[i], 1.0),
            };
            let attempt: [f64; 2] = std::array::from_fn(|c| share * tangential * (relative[c] - start[c]));
            let size = attempt[0].hypot(attempt[1]);
            if size <= limit[i] && limit[i] > 0.0 {
                state.status[i] = Status::Stick;
                state.traction[i] = attempt;
                state.anchor[i] = std::array::from_fn(|c| relative[c] - attempt[c] / tangential);
                state.slip[i] = self.committed.slip[i];
                for c in 0..2 {
                    self.stiffness[i][c][c] = area * share * tangential;
                }
            } else {
                state.status[i] = Status::Slip;
                let direction = if size > 0.0 { [attempt[0] / size, attempt[1] / size] } else { [1.0, 0.0] };
                let rotation = if size > 0.0 { limit[i] / size } else { 0.0 };
                state.traction[i] = direction.map(|d| limit[i] * d);
                state.anchor[i] = std::array::from_fn(|c| relative[c] - state.traction[i][c] / tangential);
                state.slip[i] = self.committed.slip[i] + (size - limit[i]) / tangential;
                for c in 0..2 {
                    for d in 0..2 {
                        let unit = if c == d { 1.0 } else { 0.0 };
                        self.stiffness[i][c][d] =
                            area * share * tangential * rotation * (unit - direction[c] * direction[d]);
                    }
                }
            }
        }
    }

    /// Subtracts the forces of the flat on the asperity from a residual.
    pub fn subtract_force(&self, residual: &mut [f64]) {
        for i in 0..self.len() {
            if self.trial.status[i] == Status::Open {
                continue;
            }
            let [radial, hoop] = self.trial.traction[i];
            residual[self.place(i, 0)] -= self.areas[i] * radial;
            residual[self.place(i, 1)] -= self.areas[i] * hoop;
            residual[self.place(i, 2)] += self.areas[i] * self.trial.pressure[i];
        }
    }

    /// Work of the forces of the flat on a displacement of the asperity.
    pub fn work_on(&self, u: &[f64]) -> f64 {
        (0..self.len())
            .filter(|&i| self.trial.status[i] != Status::Open)
            .map(|i| {
                let [radial, hoop] = self.trial.traction[i];
                let at = |c: usize| u[self.place(i, c)];
                self.areas[i] * (radial * at(0) + hoop * at(1) - self.trial.pressure[i] * at(2))
            })
            .sum()
    }

    /// Derivative of [`Contact::load`] of the half body with the interference: Σ area·spring.
    pub fn height_stiffness(&self) -> f64 {
        self.stiffness.iter().map(|stiffness| stiffness[2][2]).sum()
    }

    /// Adds to a force what `height` more of interference changes in it.
    pub fn add_height_product(&self, height: f64, force: &mut [f64]) {
        for (i, stiffness) in self.stiffness.iter().enumerate() {
            force[self.place(i, 2)] += stiffness[2][2] * height;
        }
    }

    /// Change of the load of the half body with a displacement.
    pub fn load_product(&self, u: &[f64]) -> f64 {
        (0..self.len()).map(|i| self.stiffness[i][2][2] * u[self.place(i, 2)]).sum()
    }

    /// Adds the product of the contact stiffness with a displacement to a force.
    #[cfg(test)]
    pub fn add_tangent_product(&self, u: &[f64], force: &mut [f64]) {
        for i in 0..self.len() {
            if self.trial.status[i] == Status::Open {
                continue;
            }
            let local: [f64; 3] = std::array::from_fn(|c| u[self.place(i, c)]);
            for c in 0..3 {
                let sum: f64 = (0..3).map(|d| self.stiffness[i][c][d] * local[d]).sum();
                force[self.place(i, c)] += sum;
            }
        }
    }

    /// Covers the contact of the trial state up to its edge.
    pub fn update_cover(&mut self) {
        let edges = self.trial_edges();
        self.cover_to(&edges);
    }

    /// Where the edge of the trial state lies along each angle (see [`contact_edge`]), in cells of the rings from
    /// the axis on; the cell of a ring reaches half a spacing to both sides.
    pub fn trial_edges(&self) -> Vec<f64> {
        (0..self.columns).map(|j| self.trial_edge(j)).collect()
    }

    fn trial_edge(&self, j: usize) -> f64 {
        let at = |ring: usize| ring * self.columns + j;
        let rings = self.radii.len();
        let Some(last) = self.last_ring(j) else { return rings as f64 };
        if last == 0 || last + 2 >= rings {
            return (last + 1) as f64;
        }
        let (gap, beyond) = (self.trial.gap[at(last + 1)], self.trial.gap[at(last + 2)]);
        let widths =
            (self.radii[last + 2] - self.radii[last + 1]) / (self.radii[last + 1] - self.radii[last]);
        let closing = if beyond > gap { (gap / (beyond - gap) * widths).clamp(0.0, 1.0) } else { 1.0 };
        let inner = self.trial.pressure[at(last - 1)];
        let load = if inner > 0.0 { (self.trial.pressure[at(last)] / inner).min(1.0) } else { 1.0 };
        last as f64 + (0.5 + contact_edge::place(load, closing)).max(0.0)
    }

    /// Outermost ring that touches at an angle in the trial state.
    fn last_ring(&self, j: usize) -> Option<usize> {
        (0..self.radii.len()).rev().find(|&k| self.trial.status[k * self.columns + j] != Status::Open)
    }

    /// Edge along each angle that the contact is covered to.
    pub fn edges(&self) -> Vec<f64> {
        (0..self.columns).map(|j| self.cover.iter().skip(j).step_by(self.columns).sum()).collect()
    }

    /// Covers the contact to the given edges: the last ring that touches has what is left for it of its cell, and
    /// a little more just before the next ring touches.
    pub fn cover_to(&mut self, edges: &[f64]) {
        for (j, &edge) in edges.iter().enumerate() {
            let last = self.last_ring(j);
            for ring in 0..self.radii.len() {
                self.cover[ring * self.columns + j] = match last {
                    Some(last) if ring == last => (edge - ring as f64).clamp(0.0, MOST_OF_A_CELL),
                    // A ring that touches before the edge is looked for again has no share yet.
                    Some(last) if ring > last => 0.0,
                    _ => 1.0,
                };
            }
        }
    }

    /// Whether the contact has come so near the rim of the mesh that its edge cannot be told.
    pub fn at_rim(&self, state: &ContactState) -> bool {
        let touching = |i: &usize| state.status[*i] != Status::Open;
        let outermost = (0..self.len()).rev().find(touching).map_or(0, |i| i / self.columns);
        outermost + 2 >= self.radii.len()
    }

    pub fn commit(&mut self) {
        self.committed.clone_from(&self.trial);
        self.committed_areas.copy_from_slice(&self.areas);
    }

    /// Normal force of the whole asperity.
    pub fn load(&self, state: &ContactState) -> f64 {
        2.0 * (0..self.len()).map(|i| self.areas[i] * state.pressure[i]).sum::<f64>()
    }

    /// Friction force along +x of the whole asperity.
    pub fn friction(&self, state: &ContactState) -> f64 {
        2.0 * (0..self.len()).map(|i| self.areas[i] * self.along_x(i, state.traction[i])).sum::<f64>()
    }

    pub fn along_x(&self, point: usize, v: [f64; 2]) -> f64 {
        let (sin, cos) = self.angles[point % self.columns].sin_cos();
        v[0] * cos - v[1] * sin
    }

    /// Contact area of the whole asperity.
    pub fn area(&self, state: &ContactState) -> f64 {
        2.0 * self.sum_where(state, |s| s != Status::Open)
    }

    /// Radius of the circle of the same area.
    pub fn radius(&self, state: &ContactState) -> f64 {
        (self.area(state) / std::f64::consts::PI).sqrt()
    }

    /// Share of the contact area that sticks.
    pub fn stick_fraction(&self, state: &ContactState) -> f64 {
        let area = self.sum_where(state, |s| s != Status::Open);
        if area > 0.0 { self.sum_where(state, |s| s == Status::Stick) / area } else { 0.0 }
    }

    fn sum_where(&self, state: &ContactState, pick: impl Fn(Status) -> bool) -> f64 {
        (0..self.len())
            .filter(|&i| pick(state.status[i]))
            .map(|i| self.areas[i] * self.cover[i])
            .fold(0.0, |a, b| a + b)
    }

    /// Work of the flat and dissipation at the interface over the step, by the trapezoidal rule.
    pub fn step_work(&self, from: FlatPosition, to: FlatPosition) -> InterfaceWork {
        let mut work = InterfaceWork::default();
        for i in 0..self.len() {
            // Forces: the area of a point may change.
            let (before, after) = (0.5 * self.committed_areas[i], 0.5 * self.areas[i]);
            let pressure = before * self.committed.pressure[i] + after * self.trial.pressure[i];
            let traction: [f64; 2] = std::array::from_fn(|c| {
                before * self.committed.traction[i][c] + after * self.trial.traction[i][c]
            });
            let displacement = to.displacement - from.displacement;
            work.of_flat +=
                pressure * (to.interference - from.interference) + self.along_x(i, traction) * displacement;
            work.friction += (0..2)
                .map(|c| traction[c] * (self.trial.relative[i][c] - self.committed.relative[i][c]))
                .sum::<f64>();
            work.springs += pressure * (self.committed.gap[i] - self.trial.gap[i]);
        }
        work
    }

    /// Speed-free slip of the step at a point: length of the relative displacement where it slips.
    pub fn point_slip(&self, point: usize) -> f64 {
        self.trial.slip[point] - self.committed.slip[point]
    }
}

/// Work at the interface, half body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct InterfaceWork {
    /// Of the flat on the asperity.
    pub of_flat: f64,
    /// Of the shear traction on the slip.
    pub friction: f64,
    /// Of the pressure on the normal springs; vanishes with them.
    pub springs: f64,
}

#[cfg(test)]
mod tests;
