//! The linear systems of Newton's method: conjugate gradients, preconditioned by the exact elastic solver with
//! the contact stiffness inside.

use std::time::Instant;

use super::{Hold, Mechanics, StepFailure, dot};
use crate::timings::Kernel;

const KRYLOV_LIMIT: usize = 400;

/// The interference as an unknown beside the displacements, in the preconditioner.
///
/// Block elimination would take the load per interference as the small difference of two stiff
/// springs. With the displacement that follows the flat as one more direction of search instead,
/// nothing cancels, and the preconditioner stays symmetric and positive whatever the precision of
/// its sweeps.
pub(super) struct Border {
    /// Displacement as the flat moves, then the interference itself.
    direction: Vec<f64>,
    /// Curvature of the energy along it.
    curvature: f64,
}

impl Mechanics {
    /// Solves tangent·direction = −residual; `direction` holds M⁻¹·residual on entry.
    ///
    /// The tangent is M less what the body has lost of its elastic stiffness. As each z is M⁻¹r, the product of
    /// M with the direction of search p = z + βp' is r + β times the one before: no product with the stiffness
    /// of the whole body is ever made.
    pub(super) fn conjugate_gradients(&mut self, residual: &[f64], direction: &mut [f64], tolerance: f64) {
        let n = residual.len();
        let size = self.internal.len();
        let mut r: Vec<f64> = residual.iter().map(|x| -x).collect();
        let mut z: Vec<f64> = direction.iter().map(|x| -x).collect();
        let mut p = z.clone();
        let mut unyielding = r[..size].to_vec();
        let mut product = vec![0.0; n];
        direction.fill(0.0);
        let mut rho = dot(&r, &z);
        let target = rho * tolerance * tolerance;
        // What the last iteration left of ρ.
        let mut rate = 1.0;
        for _ in 0..KRYLOV_LIMIT {
            self.effort.krylov += 1;
            self.tangent_product(&p, &unyielding, &mut product);
            let curvature = dot(&p, &product);
            if curvature <= 0.0 {
                break;
            }
            let step = rho / curvature;
            for i in 0..n {
                direction[i] += step * p[i];
                r[i] -= step * product[i];
            }
            // To know for certain would take one more application of the preconditioner, of some six.
            if rate * rho <= target {
                break;
            }
            self.precondition(&r, &mut z);
            let next = dot(&r, &z);
            if next <= target {
                break;
            }
            // Also β of the next direction.
            rate = next / rho;
            for i in 0..n {
                p[i] = z[i] + rate * p[i];
            }
            for (m, r) in unyielding.iter_mut().zip(&r) {
                *m = r + rate * *m;
            }
            rho = next;
        }
    }

    /// Product of the tangent of body and contact, and of the interference where that is unknown.
    /// `unyielding` is the force that it would give on the displacements if the body were elastic.
    fn tangent_product(&mut self, u: &[f64], unyielding: &[f64], force: &mut [f64]) {
        let size = self.internal.len();
        let (field, of_field) = (&u[..size], &mut force[..size]);
        let clock = Instant::now();
        self.body.stiffness_loss(field, of_field);
        self.timings.since(Kernel::TangentProduct, clock);
        of_field.iter_mut().zip(unyielding).for_each(|(force, elastic)| *force = elastic - *force);
        if let Some(&height) = u.get(size) {
            force[size] = self.contact.height_stiffness() * height + self.contact.load_product(field);
        }
    }

    /// Elastic stiffness with the contact stiffness, inverted.
    pub(super) fn precondition(&mut self, residual: &[f64], solution: &mut [f64]) {
        let size = self.internal.len();
        self.preconditioner.apply(&residual[..size], &mut solution[..size], &mut self.timings);
        if let Some(Border { direction, curvature }) = &self.border {
            let share = dot(direction, residual) / curvature;
            solution[size] = 0.0;
            solution.iter_mut().zip(direction).for_each(|(x, d)| *x += share * d);
        }
    }

    /// Takes the present contact stiffness into the preconditioner.
    pub(super) fn update_preconditioner(&mut self, hold: Hold) -> Result<(), StepFailure> {
        self.preconditioner
            .update(&self.contact, &mut self.timings)
            .map_err(|_| StepFailure::ContactStiffness)?;
        self.border = None;
        if let Hold::Load(_) = hold {
            let size = self.internal.len();
            let (mut unit, mut direction) = (vec![0.0; size], vec![0.0; size]);
            self.contact.add_height_product(-1.0, &mut unit);
            self.preconditioner.apply(&unit, &mut direction, &mut self.timings);
            direction.push(1.0);
            // Of its own making: no force is left on the displacements of the elastic body.
            let mut force = vec![0.0; size + 1];
            self.tangent_product(&direction, &vec![0.0; size], &mut force);
            let curvature = dot(&direction, &force);
            // Without any contact the load cannot be held.
            if curvature <= 0.0 {
                return Err(StepFailure::NoContact);
            }
            self.border = Some(Border { direction, curvature });
        }
        Ok(())
    }
}
