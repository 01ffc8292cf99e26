//! Nodal forces of the contact and products with its stiffness.

use super::{Contact, Status};

impl Contact {
    /// Subtracts the forces of the flat on the asperity from a residual.
    pub fn subtract_force(&self, residual: &mut [f64]) {
        for i in 0..self.len() {
            if self.trial[i].status == Status::Open {
                continue;
            }
            let [radial, hoop] = self.trial[i].traction;
            residual[self.vector_index(i, 0)] -= self.areas[i] * radial;
            residual[self.vector_index(i, 1)] -= self.areas[i] * hoop;
            residual[self.vector_index(i, 2)] += self.areas[i] * self.trial[i].pressure;
        }
    }

    /// Work of the forces of the flat on a displacement of the asperity.
    pub fn work_on(&self, u: &[f64]) -> f64 {
        (0..self.len())
            .filter(|&i| self.trial[i].status != Status::Open)
            .map(|i| {
                let [radial, hoop] = self.trial[i].traction;
                let at = |c: usize| u[self.vector_index(i, c)];
                self.areas[i] * (radial * at(0) + hoop * at(1) - self.trial[i].pressure * at(2))
            })
            .sum()
    }

    /// Derivative of [`Contact::load`] of the half body with the interference: Σ area·spring.
    pub fn height_stiffness(&self) -> f64 {
        self.stiffness.iter().map(|stiffness| stiffness[2][2]).sum()
    }

    /// Adds to a force what a flat that is higher by `height` at each point changes in it; returns the change of the load of the
    /// half body.
    pub fn add_height_product(&self, height: impl Fn(usize) -> f64, force: &mut [f64]) -> f64 {
        let mut load = 0.0;
        for (i, stiffness) in self.stiffness.iter().enumerate() {
            let change = stiffness[2][2] * height(i);
            force[self.vector_index(i, 2)] += change;
            load += change;
        }
        load
    }

    /// Change of the load of the half body with a displacement.
    pub fn load_product(&self, u: &[f64]) -> f64 {
        (0..self.len()).map(|i| self.stiffness[i][2][2] * u[self.vector_index(i, 2)]).sum()
    }

    /// Adds the product of the contact stiffness with a displacement to a force.
    #[cfg(test)]
    pub fn add_tangent_product(&self, u: &[f64], force: &mut [f64]) {
        for i in 0..self.len() {
            if self.trial[i].status == Status::Open {
                continue;
            }
            let local: [f64; 3] = std::array::from_fn(|c| u[self.vector_index(i, c)]);
            for c in 0..3 {
                let sum: f64 = (0..3).map(|d| self.stiffness[i][c][d] * local[d]).sum();
                force[self.vector_index(i, c)] += sum;
            }
        }
    }
}
