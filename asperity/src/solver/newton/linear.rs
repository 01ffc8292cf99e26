//! The linear systems of Newton's method: conjugate gradients, preconditioned by the exact elastic solver with
//! the contact stiffness inside.

use std::time::Instant;

use super::{LoadingControl, Mechanics, StepFailure, dot};
use crate::discretisation::body::InelasticZone;
use crate::discretisation::runs::Runs;
use crate::solver::preconditioner::Search;
use crate::solver::timings::Kernel;

const KRYLOV_LIMIT: usize = 400;

/// The interference as an unknown beside the displacements, in the preconditioner.
///
/// Block elimination would take the load per interference as the small difference of two stiff
/// springs. With the displacement that follows the flat as one more direction of search instead,
/// nothing cancels, and the preconditioner stays symmetric and positive whatever the precision of
/// its sweeps.
pub(super) struct BorderedSystem {
    /// Displacement as the flat moves, then the interference itself.
    direction: Vec<f64>,
    /// Curvature of the energy along it.
    curvature: f64,
}

impl Mechanics {
    /// Solves tangent·direction = −residual; `direction` holds M⁻¹·residual on entry.
    ///
    /// The tangent is M less what the body has lost of its elastic stiffness, so that the elastic answer leaves a
    /// residual in the inelastic zone alone, and all further residuals stay there. As each z is M⁻¹r, the product
    /// of M with the direction of search p = z + βp' is r + β times the one before: no product with the stiffness
    /// of the whole body is ever made.
    pub(super) fn conjugate_gradients(&mut self, residual: &[f64], direction: &mut [f64], tolerance: f64) {
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
            self.precondition_within(&mut search, &entries, &r, &mut z);
            let next = entries.dot(&r, &z);
            if next <= target {
                break;
            }
            // What the last iteration, or the elastic answer, left of ρ; also β of the next direction.
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
            // To know for certain would take one more application of the preconditioner.
            if rate * rho <= target {
                break;
            }
        }
        search.finish(&self.preconditioner, &mut z[..size], &mut self.timings);
        direction.iter_mut().zip(&z).take(size).for_each(|(x, z)| *x += z);
        if let Some(BorderedSystem { direction: along, .. }) = &self.border {
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
        let clock = Instant::now();
        self.body.stiffness_loss(zone, field, of_field);
        self.timings.since(Kernel::TangentProduct, clock);
        zone.entries.update(of_field, elastic_tangent, |force, elastic| *force = elastic - *force);
        if let Some(&height) = u.get(size) {
            force[size] = self.contact.height_stiffness() * height + self.contact.load_product(field);
        }
    }

    /// [`Self::precondition`] in the zone of a search.
    fn precondition_within(
        &mut self,
        search: &mut Search,
        entries: &Runs,
        residual: &[f64],
        solution: &mut [f64],
    ) {
        let size = self.internal.len();
        search.apply(&mut self.preconditioner, &residual[..size], &mut solution[..size], &mut self.timings);
        if let Some(BorderedSystem { direction, curvature }) = &self.border {
            let share = entries.dot(direction, residual) / curvature;
            solution[size] = 0.0;
            entries.update(solution, direction, |x, d| *x += share * d);
        }
    }

    /// Elastic stiffness with the contact stiffness, inverted.
    pub(super) fn precondition(&mut self, residual: &[f64], solution: &mut [f64]) {
        let size = self.internal.len();
        self.preconditioner.apply(&residual[..size], &mut solution[..size], &mut self.timings);
        if let Some(BorderedSystem { direction, curvature }) = &self.border {
            let share = dot(direction, residual) / curvature;
            solution[size] = 0.0;
            solution.iter_mut().zip(direction).for_each(|(x, d)| *x += share * d);
        }
    }

    /// Takes the present contact stiffness into the preconditioner.
    pub(super) fn update_preconditioner(&mut self, hold: LoadingControl) -> Result<(), StepFailure> {
        self.preconditioner
            .update(&self.contact, &mut self.timings)
            .map_err(|_| StepFailure::ContactStiffness)?;
        self.border = None;
        if let LoadingControl::Load(_) = hold {
            let size = self.internal.len();
            let (mut unit, mut direction) = (vec![0.0; size], vec![0.0; size]);
            self.contact.add_height_product(-1.0, &mut unit);
            self.preconditioner.apply(&unit, &mut direction, &mut self.timings);
            direction.push(1.0);
            // Of its own making: no force is left on the displacements of the elastic body.
            let mut force = vec![0.0; size + 1];
            let zone = self.body.inelastic_zone();
            self.tangent_product(&zone, &direction, &vec![0.0; size], &mut force);
            let curvature = dot(&direction, &force);
            // Without any contact the load cannot be held.
            if curvature <= 0.0 {
                return Err(StepFailure::NoContact);
            }
            self.border = Some(BorderedSystem { direction, curvature });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discretisation::body::Body;
    use crate::discretisation::collocation::Collocation;
    use crate::discretisation::mesh::MeshSize;
    use crate::interface::contact::{Contact, FlatPosition};
    use crate::loading::press;
    use crate::loading::problem::{Discretisation, Problem};
    use crate::studies::robustness;

    /// Energy of what a direction leaves of the residual.
    fn left(mechanics: &mut Mechanics, residual: &[f64], direction: &[f64]) -> f64 {
        let size = mechanics.internal.len();
        let field = &direction[..size];
        let mut rest = vec![0.0; direction.len()];
        mechanics.body.tangent_product(field, &mut rest[..size]);
        mechanics.contact.add_tangent_product(field, &mut rest[..size]);
        if let Some(&height) = direction.get(size) {
            let contact = &mechanics.contact;
            contact.add_height_product(height, &mut rest[..size]);
            rest[size] = contact.height_stiffness() * height + contact.load_product(field);
        }
        rest.iter_mut().zip(residual).for_each(|(rest, residual)| *rest += residual);
        let mut answer = vec![0.0; direction.len()];
        mechanics.precondition(&rest, &mut answer);
        dot(&rest, &answer)
    }

    /// What is left of the residual is found with products of the whole tangent, which the solver never makes.
    #[test]
    fn the_answer_in_the_inelastic_zone_solves_the_whole_system() {
        for (case, finite_strain) in [("interference-5", false), ("interference-100", true)] {
            let case = robustness::all().into_iter().find(|known| known.name == case).unwrap();
            let problem = Problem { finite_strain, ..Problem::new(&case.scene().unwrap()) };
            let size = MeshSize::new(problem.expected_contact_radius(), 6);
            let (pressed, _) = press::press_on(&problem, size, 8).unwrap();
            let (body, contact, displacement) = pressed.into_parts();
            let Discretisation { mesh, factors } =
                Discretisation::new(&problem, size, Collocation::full(4)).unwrap();
            let u = mesh.sectors.spread(&displacement);
            let body = Body::revolve(&body, mesh.clone());
            let contact = Contact::revolve(&contact, &mesh, problem.contact_modulus);
            let mut mechanics = Mechanics::new(body, contact, factors, u.clone(), 1e-7);
            // Pushed on and along, so that the body flows and no angle is like another.
            let interference = 1.03 * problem.interference;
            let flat = FlatPosition { interference, displacement: 0.05 * interference };
            let further: Vec<f64> = u.iter().map(|u| 1.01 * u).collect();
            let Mechanics { body, contact, internal, .. } = &mut mechanics;
            body.internal_force(&further, None, internal);
            contact.evaluate(|place| further[place], flat, &vec![f64::INFINITY; contact.len()]);
            let share = body.inelastic_zone().nodes.len() as f64 / mesh.node_count() as f64;
            assert!(share > 0.2 && share < 0.9, "{share}");
            for hold in [LoadingControl::Interference, LoadingControl::Load(0.0)] {
                // Forces on all nodes; or a load that is missing, and nothing else, which moves the flat.
                let residual: Vec<f64> = match hold {
                    LoadingControl::Interference => (0..u.len()).map(|i| (0.61 * i as f64).sin()).collect(),
                    LoadingControl::Load(_) => (0..=u.len()).map(|i| f64::from(i == u.len())).collect(),
                };
                mechanics.update_preconditioner(hold).unwrap();
                let mut direction = vec![0.0; residual.len()];
                mechanics.precondition(&residual, &mut direction);
                let elastic: Vec<f64> = direction.iter().map(|x| -x).collect();
                let before = dot(&residual, &direction);
                let unanswered = (left(&mut mechanics, &residual, &elastic) / before).sqrt();
                assert!(unanswered > 0.1, "{unanswered}");
                mechanics.conjugate_gradients(&residual, &mut direction, 1e-3);
                let unanswered = (left(&mut mechanics, &residual, &direction) / before).sqrt();
                assert!(unanswered < 1.5e-3, "{hold:?}: {unanswered}");
            }
        }
    }
}
