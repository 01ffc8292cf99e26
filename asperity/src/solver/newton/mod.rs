//! Equilibrium of body and contact: Newton's method with line search, and conjugate gradients
//! preconditioned by the exact elastic solver with the contact stiffness inside.
//!
//! Depends on `preconditioner`, `crate::interface` and `crate::discretisation`. Chapter "Equilibrium" of the book.

use std::sync::Arc;
use std::time::Instant;

use crate::discretisation::body::Body;
use crate::interface::contact::{Contact, FlatPosition};
use crate::material::lanes::dot;
use crate::scene::REMEDY_OF_LIGHT_CONTACT;
use crate::solver::StopRequest;
use crate::solver::harmonic::HarmonicFactors;
use crate::solver::preconditioner::Preconditioner;
use crate::solver::timings::{Kernel, Timings};
use chattering::Chattering;
use line_search::Line;
use linear::BorderedSystem;

mod chattering;
mod line_search;
mod linear;

/// Relative residual below which temperature and contact edge are evaluated anew.
const REFRESH: f64 = 3e-2;
/// Where the shear strength is many times the pressure, the points that stick, slip and touch are found a few at a
/// time: at 0.001 ω_c in up to 50 iterations, elsewhere in fewer than 30.
const NEWTON_LIMIT: usize = 80;
/// Stagnation tolerance: share of a Newton step below which there is no progress, and the number of such steps in a row
/// at which the solution has stagnated. A point that touches sticks at once; if stick lifts it off again there is no
/// equilibrium with this increment.
const STAGNATION_TOLERANCE: f64 = 1e-6;
const STAGNATION_LIMIT: usize = 3;
/// Residual over the tolerance up to which a stagnant step counts as solved; the residual is a part of the error.
const ACCEPTED_STAGNATION: f64 = 10.0;
/// Forcing terms of the linear systems: no more accuracy than the next Newton step can use. While temperature and
/// contact edge still change, their update limits the accuracy.
const FORCING: f64 = 3e-3;
const COUPLED_FORCING: f64 = 0.05;
const LARGEST_FORCING: f64 = 0.1;

/// Why a step was not solved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StepFailure {
    #[error("Newton's method did not converge in {iterations} iterations (residual {residual:.1e})")]
    Newton { iterations: usize, residual: f64 },
    #[error("a number is not finite")]
    NotFinite,
    #[error(
        "it took more than {most} iterations of Newton's method and of its linear systems, twice as many as are expected"
    )]
    TooMuchWork { most: usize },
    #[error("stopped on request")]
    Stopped,
    #[error("the contact stiffness is not positive definite")]
    ContactStiffness,
    #[error("no point is in contact, so the load has no reaction")]
    NoContact,
    #[error(
        "points of the contact with {:.0} % of its friction neither touch nor lift off: the shear strength \
         of the interface, which does not fall with the pressure, lifts the surface off the flat where it \
         touches. A contact under so small a load has no equilibrium without adhesion; {REMEDY_OF_LIGHT_CONTACT} \
         has one",
        100.0 * .share
    )]
    Chattering { share: f64 },
}

/// Counts of work done, and what it left.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Effort {
    pub newton: usize,
    pub krylov: usize,
    /// Newton iterations whose full step was too long or too short.
    pub line_searches: usize,
    /// Sum of the relative residuals of stagnant steps, which are above the tolerance.
    pub residual: f64,
}

impl Effort {
    /// Iterations of Newton's method and of the linear systems: the work, in units that depend on the mesh.
    pub fn iterations(&self) -> usize {
        self.newton + self.krylov
    }

    /// Counts a step solved with this relative residual.
    fn accept(&mut self, residual: f64, tolerance: f64) {
        if residual > tolerance {
            self.residual += residual;
        }
    }
}

/// Whether a step with this relative residual is solved, `is_last` if no further iteration reduces it.
fn is_solved(residual: f64, tolerance: f64, is_last: bool) -> bool {
    residual <= if is_last { ACCEPTED_STAGNATION * tolerance } else { tolerance }
}

/// Loading control of a step: the interference (displacement control) or the load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LoadingControl {
    Interference,
    /// Normal force of the whole asperity; the interference follows.
    Load(f64),
}

pub struct Mechanics {
    pub body: Body,
    pub contact: Contact,
    preconditioner: Preconditioner,
    bordered_system: Option<BorderedSystem>,
    pub displacement: Vec<f64>,
    /// Residual, in the energy norm, at which a step counts as solved, relative to √(Pω).
    pub tolerance: f64,
    internal: Vec<f64>,
    pub effort: Effort,
    /// Iterations of all steps beyond which they end.
    pub most_iterations: usize,
    pub timings: Timings,
}

impl Mechanics {
    pub fn new(
        body: Body,
        contact: Contact,
        factors: Arc<HarmonicFactors>,
        displacement: Vec<f64>,
        tolerance: f64,
    ) -> Self {
        Self {
            internal: vec![0.0; displacement.len()],
            bordered_system: None,
            body,
            contact,
            preconditioner: Preconditioner::new(factors),
            displacement,
            tolerance,
            effort: Effort::default(),
            most_iterations: usize::MAX,
            timings: Timings::default(),
        }
    }

    /// Solves one step: on success body, contact and displacement hold the trial state, and the position of the flat is
    /// returned.
    ///
    /// Under load control the interference is one more unknown, the last entry of all vectors, with the missing load as
    /// its residual. The system stays symmetric.
    ///
    /// `coupling` gives temperature, shear limits and elevation. It is called in each iteration with the trial state of the one
    /// before, but with the contact at the end of a full step if that is short, and returns nothing when its data do
    /// not change. The step is solved when the residual is small and the data are converged. `predictor` is the first
    /// iterate.
    pub fn solve(
        &mut self,
        flat: FlatPosition,
        control: LoadingControl,
        predictor: Vec<f64>,
        stop: &StopRequest,
        mut coupling: impl FnMut(&mut Body, &mut Contact, usize) -> Option<CouplingData>,
    ) -> Result<FlatPosition, StepFailure> {
        let size = self.internal.len();
        let data = coupling(&mut self.body, &mut self.contact, 0).expect("data of the first iteration");
        let mut now = Iterate::new(predictor, self.contact.len(), data);
        if let LoadingControl::Load(_) = control {
            now.u.push(flat.interference);
        }
        let [mut residual, mut direction] = [0, 1].map(|_| vec![0.0; now.u.len()]);
        now.trial.resize(now.u.len(), 0.0);
        self.internal_force(&now.u[..size], now.data.rise.as_deref());
        let (mut last, mut is_stagnant) = (f64::INFINITY, false);
        for iteration in 0..NEWTON_LIMIT {
            let interference = now.u.get(size).copied().unwrap_or(flat.interference);
            let flat = FlatPosition { interference, ..flat };
            self.residual(&mut now, flat, control, &mut residual);
            self.update_preconditioner(control)?;
            self.precondition(&residual, &mut direction);
            let squared = dot(&residual, &direction);
            // Before `max`, which takes a number for NaN.
            if !squared.is_finite() {
                return Err(StepFailure::NotFinite);
            }
            let norm = squared.max(0.0).sqrt();
            let reference = (0.5 * self.contact.load(&self.contact.trial) * flat.interference).sqrt();
            let scale = reference.max(f64::MIN_POSITIVE);
            last = norm / scale;
            let is_last = is_stagnant || iteration + 1 == NEWTON_LIMIT;
            if now.data.converged && is_solved(last, self.tolerance, is_last) {
                now.chattering.check(&self.contact, &now.data.limit)?;
                self.effort.accept(last, self.tolerance);
                now.u.truncate(size);
                self.displacement = now.u;
                return Ok(flat);
            }
            if is_stagnant {
                return Err(StepFailure::Newton { iterations: iteration, residual: last });
            }
            if self.effort.iterations() > self.most_iterations {
                return Err(StepFailure::TooMuchWork { most: self.most_iterations });
            }
            self.effort.newton += 1;
            let least = if now.data.converged { FORCING } else { COUPLED_FORCING };
            let forcing = (0.3 * self.tolerance * scale / norm).clamp(least, LARGEST_FORCING);
            self.conjugate_gradients(&residual, &mut direction, forcing, stop);
            if stop() {
                return Err(StepFailure::Stopped);
            }
            let line = Line { direction: &direction, residual: &residual, flat, control };
            let refresh = norm <= REFRESH * scale;
            let next = |body: &mut Body, contact: &mut Contact| coupling(body, contact, iteration + 1);
            is_stagnant = !self.advance(&mut now, &line, refresh, next);
        }
        now.chattering.check(&self.contact, &now.data.limit)?;
        Err(StepFailure::Newton { iterations: NEWTON_LIMIT, residual: last })
    }

    /// Forces of body and contact that are not in balance, and the missing load under load control.
    fn residual(
        &mut self,
        now: &mut Iterate,
        flat: FlatPosition,
        control: LoadingControl,
        residual: &mut [f64],
    ) {
        let size = self.internal.len();
        self.contact.evaluate(|p| now.u[p], flat, &now.data.limit);
        if now.chattering.damp(&self.contact, &mut now.data.limit) {
            self.contact.evaluate(|p| now.u[p], flat, &now.data.limit);
        }
        self.contact.begin_iteration();
        residual[..size].copy_from_slice(&self.internal);
        self.contact.subtract_force(&mut residual[..size]);
        if let LoadingControl::Load(load) = control {
            residual[size] = 0.5 * (self.contact.load(&self.contact.trial) - load);
        }
    }

    /// Takes a step along a line, with the `coupling` data of its end if they are evaluated anew; false where no step
    /// leads on.
    fn advance(
        &mut self,
        now: &mut Iterate,
        line: &Line<'_>,
        refresh: bool,
        mut coupling: impl FnMut(&mut Body, &mut Contact) -> Option<CouplingData>,
    ) -> bool {
        let ahead = refresh && line.is_short();
        let mut next = None;
        if ahead {
            let further = |p: usize| now.u[p] + line.direction[p];
            self.contact.evaluate(further, line.flat_at(self.internal.len(), 1.0), &now.data.limit);
            next = coupling(&mut self.body, &mut self.contact);
        }
        let step = self.line_search(&mut now.u, &mut now.trial, line, &now.data, next.as_ref());
        self.effort.line_searches += usize::from(step != 1.0);
        now.stagnant = if step < STAGNATION_TOLERANCE { now.stagnant + 1 } else { 0 };
        if now.stagnant > STAGNATION_LIMIT {
            return false;
        }
        if refresh && !ahead {
            next = coupling(&mut self.body, &mut self.contact);
        }
        if let Some(mut data) = next {
            let raised =
                data.elevation.take().map(|elevation| self.raise(&mut now.u, &elevation, line.control));
            if raised.is_some() || !ahead && data.rise.is_some() {
                self.internal_force(&now.u[..self.internal.len()], data.rise.as_deref());
            }
            now.data = data;
        }
        true
    }

    /// Raises the flat to another elevation, and the displacement with it as of an elastic body: the normal springs are so stiff
    /// that the contact would change at the least elevation alone.
    fn raise(&mut self, u: &mut [f64], elevation: &[[f64; 2]], control: LoadingControl) {
        let size = self.internal.len();
        let [mut force, mut direction] = [0, 1].map(|_| vec![0.0; u.len()]);
        let before = self.contact.elevation();
        self.contact.raise(elevation);
        // That of the contact in which the springs are raised.
        if self.update_preconditioner(control).is_err() {
            return;
        }
        let rise = |point: usize| elevation[point][0] - before[point][0];
        let load = self.contact.add_height_product(rise, &mut force[..size]);
        if let Some(of_load) = force.get_mut(size) {
            *of_load = load;
        }
        self.precondition(&force, &mut direction);
        u.iter_mut().zip(&direction).for_each(|(u, d)| *u -= d);
    }

    /// Displacement after the flat has moved, of an elastic body that sticks to it, from the present state.
    pub fn sticking(&mut self, from: FlatPosition, to: FlatPosition) -> Result<Vec<f64>, StepFailure> {
        let [mut residual, mut direction] = [0, 1].map(|_| vec![0.0; self.internal.len()]);
        let unlimited = vec![f64::INFINITY; self.contact.len()];
        let mut u = self.displacement.clone();
        for flat in [from, to] {
            residual.iter_mut().for_each(|force| *force = -*force);
            self.contact.evaluate(|p| u[p], flat, &unlimited);
            self.contact.subtract_force(&mut residual);
        }
        self.update_preconditioner(LoadingControl::Interference)?;
        self.precondition(&residual, &mut direction);
        u.iter_mut().zip(&direction).for_each(|(u, d)| *u -= d);
        Ok(u)
    }

    /// Internal force of the body at displacement `u`, stored for the residual.
    fn internal_force(&mut self, u: &[f64], rise: Option<&[f64]>) {
        let start = Instant::now();
        self.body.internal_force(u, rise, &mut self.internal);
        self.timings.since(Kernel::InternalForce, start);
    }

    /// Back to the state before a failed step, with its displacement and contact fractions: the failed
    /// attempt has no effect on the next one.
    pub fn restore(&mut self, displacement: Vec<f64>, contact_fraction: Vec<f64>) {
        self.body.restore();
        self.contact.trial.clone_from(&self.contact.committed);
        self.contact.contact_fraction = contact_fraction;
        self.displacement = displacement;
    }

    /// Body, contact and displacement.
    pub fn into_parts(self) -> (Body, Contact, Vec<f64>) {
        (self.body, self.contact, self.displacement)
    }
}

/// Coupling data of a step: temperature, shear limits and elevation of the flat.
pub struct CouplingData {
    /// Limit of the shear traction at each contact point.
    pub limit: Vec<f64>,
    /// Temperature rise, if there is any.
    pub rise: Option<Vec<f64>>,
    /// Elevation of the flat, if it changes.
    pub elevation: Option<Vec<[f64; 2]>>,
    /// Whether these data agree with the state that they depend on.
    pub converged: bool,
}

/// Iterate of Newton's method.
struct Iterate {
    u: Vec<f64>,
    /// Scratch of the line search.
    trial: Vec<f64>,
    data: CouplingData,
    chattering: Chattering,
    /// Steps without progress in a row.
    stagnant: usize,
}

impl Iterate {
    fn new(u: Vec<f64>, points: usize, data: CouplingData) -> Self {
        Self { u, trial: Vec::new(), data, chattering: Chattering::new(points), stagnant: 0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_stagnant_steps_are_accepted_above_the_tolerance() {
        assert!(is_solved(1e-7, 1e-7, false) && !is_solved(2e-7, 1e-7, false));
        assert!(is_solved(1e-6, 1e-7, true) && !is_solved(1.1e-6, 1e-7, true));
        let mut effort = Effort::default();
        for residual in [1e-7, 2e-7, 3e-7] {
            effort.accept(residual, 1e-7);
        }
        assert!((effort.residual - 5e-7).abs() < 1e-20);
    }
}
