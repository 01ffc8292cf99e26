//! Forces, areas and work of the contact.

use super::{Contact, FlatPosition, PointState, Status};

impl Contact {
    /// Normal force of the whole asperity.
    pub fn load(&self, state: &[PointState]) -> f64 {
        2.0 * (0..self.len()).map(|i| self.areas[i] * state[i].pressure).sum::<f64>()
    }

    /// Friction force along +x of the whole asperity: of the shear traction, and of the pressure on an inclined flat.
    pub fn friction(&self, state: &[PointState]) -> f64 {
        2.0 * (0..self.len()).map(|i| self.areas[i] * self.friction_stress(state, i)).sum::<f64>()
    }

    /// Force of the flat along +x per area of a point.
    fn friction_stress(&self, state: &[PointState], point: usize) -> f64 {
        self.along_x(point, state[point].traction) - state[point].pressure * state[point].elevation[1]
    }

    /// Component along +x of a vector (r, θ) at a contact point.
    pub fn along_x(&self, point: usize, v: [f64; 2]) -> f64 {
        let (sin, cos) = self.angles[point % self.columns].sin_cos();
        v[0] * cos - v[1] * sin
    }

    /// Contact area of the whole asperity.
    pub fn area(&self, state: &[PointState]) -> f64 {
        2.0 * self.sum_where(state, |_| true)
    }

    /// Radius of the circle of the same area.
    pub fn radius(&self, state: &[PointState]) -> f64 {
        (self.area(state) / std::f64::consts::PI).sqrt()
    }

    /// Stick area fraction of the contact that exists since the start of the motion. Points that touch later stick at
    /// first: along the edge of a contact that grows there are always some, of as much area as the mesh gives them.
    pub fn stick_fraction(&self, state: &[PointState]) -> f64 {
        let area = self.sum_where(state, |i| self.since_start[i]);
        let stick = self.sum_where(state, |i| self.since_start[i] && state[i].status == Status::Stick);
        if area > 0.0 { stick / area } else { 0.0 }
    }

    /// Share of the shear strength of the same contact that the shear traction mobilises: 1 where all of it slips; 0 if the
    /// strength is infinite or zero.
    pub fn mobilised_strength(&self, state: &[PointState]) -> f64 {
        let points = (0..self.len()).filter(|&i| self.since_start[i] && state[i].status != Status::Open);
        let (mobilised, strength) = points.fold((0.0, 0.0), |(mobilised, strength), i| {
            let (area, [r, t]) = (self.areas[i], state[i].traction);
            (mobilised + area * r.hypot(t), strength + area * state[i].limit)
        });
        if strength > 0.0 { mobilised / strength } else { 0.0 }
    }

    /// Mean over the contact of a limit of the shear traction, per area of each point.
    pub fn mean_limit(&self, limit: &[f64]) -> f64 {
        let covered: f64 = (0..self.len()).map(|i| self.areas[i] * self.contact_fraction[i]).sum();
        (0..self.len()).map(|i| self.areas[i] * limit[i]).sum::<f64>() / covered
    }

    /// Part of the shear traction that is not along the motion: 1 − |∫τ_x dA|/∫|τ| dA; 0 without shear traction.
    pub fn transverse_share(&self, state: &[PointState]) -> f64 {
        let all: f64 =
            (0..self.len()).map(|i| self.areas[i] * state[i].traction[0].hypot(state[i].traction[1])).sum();
        let along: f64 = (0..self.len()).map(|i| self.areas[i] * self.along_x(i, state[i].traction)).sum();
        if all > 0.0 { 1.0 - along.abs() / all } else { 0.0 }
    }

    fn sum_where(&self, state: &[PointState], pick: impl Fn(usize) -> bool) -> f64 {
        (0..self.len()).filter(|&i| pick(i)).fold(0.0, |sum, i| sum + self.covered_area(state, i))
    }

    /// Work of the flat and dissipation at the interface over the step, by the trapezoidal rule.
    pub fn step_work(&self, from: FlatPosition, to: FlatPosition) -> InterfaceWork {
        let mut work = InterfaceWork::default();
        for i in 0..self.len() {
            // Forces: the area of a point may change.
            let (before, after) = (0.5 * self.committed_areas[i], 0.5 * self.areas[i]);
            let pressure = before * self.committed[i].pressure + after * self.trial[i].pressure;
            let traction: [f64; 2] = std::array::from_fn(|c| {
                before * self.committed[i].traction[c] + after * self.trial[i].traction[c]
            });
            let friction = before * self.friction_stress(&self.committed, i)
                + after * self.friction_stress(&self.trial, i);
            let displacement = to.displacement - from.displacement;
            work.of_flat += pressure * (to.interference - from.interference) + friction * displacement;
            // The surface of the flat also rises as it moves to where it is higher.
            work.expansion += pressure * (self.trial[i].elevation[0] - self.committed[i].elevation[0])
                + (self.along_x(i, traction) - friction) * displacement;
            work.friction += (0..2)
                .map(|c| traction[c] * (self.trial[i].relative[c] - self.committed[i].relative[c]))
                .sum::<f64>();
            work.springs += pressure * (self.committed[i].gap - self.trial[i].gap);
        }
        work
    }

    /// Slip of the step at a point: length of the path.
    pub fn point_slip(&self, point: usize) -> f64 {
        self.trial[point].slip - self.committed[point].slip
    }
}

/// Work at the interface, half body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct InterfaceWork {
    /// Work of the flat on the asperity.
    pub of_flat: f64,
    /// Work of the shear traction on the slip: frictional dissipation.
    pub friction: f64,
    /// Work of the pressure on the normal springs of the contact; vanishes with the mesh.
    pub springs: f64,
    /// Work of the flat by its thermal expansion.
    pub expansion: f64,
}
