//! The linear systems of Newton's method: conjugate gradients, preconditioned by the exact elastic solver with
//! the contact stiffness inside.

use std::time::Instant;

use super::{LoadingControl, Mechanics, StepFailure};
use crate::discretisation::body::InelasticZone;
use crate::discretisation::runs::Runs;
use crate::material::lanes::dot;
use crate::solver::StopRequest;
use crate::solver::preconditioner::Search;
use crate::solver::timings::Kernel;

const KRYLOV_LIMIT: usize = 400;

/// The interference as an unknown in addition to the displacements, in the preconditioner.
///
/// Block elimination would compute the load per interference as the small difference of two stiff springs. With the
/// displacement that follows the flat as one more search direction there is no cancellation, and the preconditioner is
/// symmetric and positive at any precision of its sweeps.
pub(super) struct BorderedSystem {
    /// Displacement as the flat moves, then the interference itself.
    direction: Vec<f64>,
    /// Curvature of the energy along it.
    curvature: f64,
}

impl Mechanics {
    /// Solves tangent·direction = −residual; `direction` holds M⁻¹·residual on entry.
    ///
    /// The tangent is M minus the stiffness loss of the body, so the elastic solution leaves a residual in the
    /// inelastic zone alone, and all further residuals stay there. As each z is M⁻¹r, the product of M with the search
    /// direction p = z + βp' is r + β times the previous one: no product with the stiffness of the whole body is
    /// formed. Where a stop is requested the direction is the one so far.
    pub(super) fn conjugate_gradients(
        &mut self,
        residual: &[f64],
        direction: &mut [f64],
        tolerance: f64,
        stop: &StopRequest,
    ) {
        let n = residual.len();
        let size = self.internal.len();
        let mut rho = dot(residual, direction);
        let target = rho * tolerance * tolerance;
        direction.iter_mut().for_each(|x| *x = -*x);
        let zone = self.body.inelastic_zone();
        let mut entries = zone.entries.clone();
        if n > size {
            entries.push(size..n);
        }
        let mut search = Search::new(&self.preconditioner, zone.nodes.clone());
        let [mut r, mut z, mut p, mut product, mut elastic_tangent] = std::array::from_fn(|_| vec![0.0; n]);
        self.tangent_product(&zone, direction, &elastic_tangent, &mut r);
        r[..size].iter_mut().for_each(|r| *r = -*r);
        if n > size {
            r[size] = -residual[size] - r[size];
        }
        let mut so_far = 0.0;
        for iteration in 0..KRYLOV_LIMIT {
            search.apply(&self.preconditioner, &r[..size], &mut z[..size], &mut self.timings);
            self.solve_bordered_system(&entries, &r, &mut z);
            let next = entries.dot(&r, &z);
            if next <= target || stop() {
                break;
            }
            // Reduction of ρ by the last iteration, or by the elastic solution; also β of the next direction.
            let rate = next / rho;
            let beta = if iteration > 0 { rate } else { 0.0 };
            entries.update(&mut p, &z, |p, z| *p = z + beta * *p);
            entries.update(&mut elastic_tangent, &r, |m, r| *m = r + beta * *m);
            search.turn(beta);
            rho = next;
            self.effort.krylov += 1;
            self.tangent_product(&zone, &p, &elastic_tangent, &mut product);
            let curvature = entries.dot(&p, &product);
            if curvature <= 0.0 {
                break;
            }
            let step = rho / curvature;
            entries.update(&mut r, &product, |r, product| *r -= step * product);
            search.step(step);
            if n > size {
                so_far += step * p[size];
            }
            // Estimated convergence; its verification requires one more application of the preconditioner.
            if rate * rho <= target {
                break;
            }
        }
        search.finish(&self.preconditioner, &mut z[..size], &mut self.timings);
        direction.iter_mut().zip(&z).take(size).for_each(|(x, z)| *x += z);
        if let Some(BorderedSystem { direction: along, .. }) = &self.bordered_system {
            direction.iter_mut().zip(along).for_each(|(x, d)| *x += so_far * d);
        }
    }

    /// Product of the tangent of body and contact, and of the interference where that is unknown, in the inelastic
    /// zone. `elastic_tangent` is the force that it would give on the displacements if the body were elastic.
    fn tangent_product(
        &mut self,
        zone: &InelasticZone,
        u: &[f64],
        elastic_tangent: &[f64],
        force: &mut [f64],
    ) {
        let size = self.internal.len();
        let (field, of_field) = (&u[..size], &mut force[..size]);
        let start = Instant::now();
        self.body.stiffness_loss(zone, field, of_field);
        self.timings.since(Kernel::TangentProduct, start);
        zone.entries.update(of_field, elastic_tangent, |force, elastic| *force = elastic - *force);
        if let Some(&height) = u.get(size) {
            force[size] = self.contact.height_stiffness() * height + self.contact.load_product(field);
        }
    }

    /// Elastic stiffness with the contact stiffness, inverted.
    pub(super) fn precondition(&mut self, residual: &[f64], solution: &mut [f64]) {
        let size = self.internal.len();
        self.preconditioner.apply(&residual[..size], &mut solution[..size], &mut self.timings);
        self.solve_bordered_system(&Runs::all(residual), residual, solution);
    }

    /// Bordered system, where the interference is unknown: adds to the solution at constant interference the share of a residual
    /// along the direction of the border.
    fn solve_bordered_system(&self, entries: &Runs, residual: &[f64], solution: &mut [f64]) {
        if let Some(BorderedSystem { direction, curvature }) = &self.bordered_system {
            let share = entries.dot(direction, residual) / curvature;
            solution[self.internal.len()] = 0.0;
            entries.update(solution, direction, |x, d| *x += share * d);
        }
    }

    /// Updates the preconditioner with the present contact stiffness.
    pub(super) fn update_preconditioner(&mut self, control: LoadingControl) -> Result<(), StepFailure> {
        self.preconditioner
            .update(&self.contact, &mut self.timings)
            .map_err(|_| StepFailure::ContactStiffness)?;
        self.bordered_system = None;
        if let LoadingControl::Load(_) = control {
            let size = self.internal.len();
            let (mut unit, mut direction) = (vec![0.0; size], vec![0.0; size]);
            self.contact.add_height_product(|_| -1.0, &mut unit);
            self.preconditioner.apply(&unit, &mut direction, &mut self.timings);
            direction.push(1.0);
            // The elastic body is in equilibrium along this direction.
            let mut force = vec![0.0; size + 1];
            let zone = self.body.inelastic_zone();
            self.tangent_product(&zone, &direction, &vec![0.0; size], &mut force);
            let curvature = dot(&direction, &force);
            // Without any contact the load cannot be held.
            if curvature <= 0.0 {
                return Err(StepFailure::NoContact);
            }
            self.bordered_system = Some(BorderedSystem { direction, curvature });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
