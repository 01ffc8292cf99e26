//! Equilibrium of body and contact: Newton's method with line search, and conjugate gradients
//! preconditioned by the exact elastic solver with the contact stiffness inside.

use std::sync::Arc;
use std::time::Instant;

use crate::discretisation::body::Body;
use crate::interface::contact::{Contact, FlatPosition};
use crate::solver::harmonic::HarmonicFactors;
use crate::solver::preconditioner::Preconditioner;
use crate::solver::timings::{Kernel, Timings};
use chattering::Chattering;
use line_search::Line;
use linear::BorderedSystem;

mod chattering;
mod line_search;
mod linear;

/// Residual below which a state is good enough to ask for its temperature and contact edge.
const REFRESH: f64 = 3e-2;
/// Where the shear strength is many times the pressure, the points that stick, slip and touch are found
/// a few at a time: at 0.001 omega_c that took up to 50 iterations, elsewhere fewer than 30.
const NEWTON_LIMIT: usize = 60;
/// Share of a Newton step that is none, and how many of them in a row show that no step leads on: a point that
/// touches takes hold at once, and where the body pushes it off again by that, there is no equilibrium with this
/// increment.
const STAGNATION_TOLERANCE: f64 = 1e-6;
const STALLED_LIMIT: usize = 3;
/// Share of the friction that may be gone without so: more than the outermost ring of the coarsest mesh has
/// is another problem than the one posed. Ordinary slides stay below 0.02; at 0.001 omega_c, with a
/// shear strength of some twenty times the pressure, all of the friction went.
const MOST_WITHOUT: f64 = 0.2;

/// Why a step was not solved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StepFailure {
    #[error("Newton's method did not converge in {iterations} iterations (residual {residual:.1e})")]
    Newton { iterations: usize, residual: f64 },
    #[error("a number is not finite")]
    NotFinite,
    #[error("the contact stiffness is not positive definite")]
    ContactStiffness,
    #[error("nothing is in contact to hold the load")]
    NoContact,
    #[error(
        "points of the contact with {:.0} % of its friction neither touch nor lift off: the shear strength \
         of the interface, which does not fall with the pressure, lifts the surface off the flat where it \
         touches. A contact pressed so lightly has no equilibrium without adhesion; the law \"coulomb\" or a \
         smaller strength_factor has one",
        100.0 * .share
    )]
    Chattering { share: f64 },
}

/// Counts of work done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    pub newton: usize,
    pub krylov: usize,
}

/// What of the flat's position is held in a step.
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
    border: Option<BorderedSystem>,
    pub displacement: Vec<f64>,
    /// Residual, in the energy norm, at which a step counts as solved, relative to √(Pω).
    pub tolerance: f64,
    internal: Vec<f64>,
    pub effort: Effort,
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
            border: None,
            body,
            contact,
            preconditioner: Preconditioner::new(factors),
            displacement,
            tolerance,
            effort: Effort::default(),
            timings: Timings::default(),
        }
    }

    /// Solves one step: on success body, contact and displacement hold the trial state, and the
    /// position of the flat is returned.
    ///
    /// Where the load is held, the interference is one more unknown: the last entry of all vectors,
    /// with the load that is missing as its residual. The system stays symmetric.
    ///
    /// `surroundings` gives temperature and shear limits; it is asked anew in each iteration, with
    /// the trial state of the one before but the contact where a full step takes it, if that is a short one, and
    /// answers nothing when they shall stay as they are.
    /// The step is solved when the residual is small and they have settled. `start` is the first
    /// guess.
    pub fn solve(
        &mut self,
        flat: FlatPosition,
        hold: LoadingControl,
        start: Vec<f64>,
        mut surroundings: impl FnMut(&mut Body, &mut Contact, usize) -> Option<CouplingData>,
    ) -> Result<FlatPosition, StepFailure> {
        let mut u = start;
        if let LoadingControl::Load(_) = hold {
            u.push(flat.interference);
        }
        let n = u.len();
        let size = self.internal.len();
        let mut residual = vec![0.0; n];
        let mut direction = vec![0.0; n];
        let mut trial = vec![0.0; n];
        let mut around =
            surroundings(&mut self.body, &mut self.contact, 0).expect("asked for the first time");
        self.internal_force(&u[..size], &around);
        let (mut last, mut stalled) = (f64::INFINITY, 0);
        let mut chattering = Chattering::new(self.contact.len());
        for iteration in 0..NEWTON_LIMIT {
            let flat =
                FlatPosition { interference: u.get(size).copied().unwrap_or(flat.interference), ..flat };
            self.contact.evaluate(|p| u[p], flat, &around.limit);
            if chattering.damp(&self.contact, &mut around.limit) {
                self.contact.evaluate(|p| u[p], flat, &around.limit);
            }
            residual[..size].copy_from_slice(&self.internal);
            self.contact.subtract_force(&mut residual[..size]);
            if let LoadingControl::Load(load) = hold {
                residual[size] = 0.5 * (self.contact.load(&self.contact.trial) - load);
            }
            self.update_preconditioner(hold)?;
            self.precondition(&residual, &mut direction);
            let norm = dot(&residual, &direction).max(0.0).sqrt();
            let reference = (0.5 * self.contact.load(&self.contact.trial) * flat.interference).sqrt();
            if !norm.is_finite() {
                return Err(StepFailure::NotFinite);
            }
            let scale = reference.max(f64::MIN_POSITIVE);
            if norm <= self.tolerance * scale && around.settled {
                let share = chattering.share(&self.contact, &around.limit);
                if share > MOST_WITHOUT {
                    return Err(StepFailure::Chattering { share });
                }
                u.truncate(size);
                self.displacement = u;
                return Ok(flat);
            }
            last = norm / scale;
            self.effort.newton += 1;
            // Forcing term: no more accuracy than the next Newton step can use. While temperature and
            // contact edge still change they undo most of it: a slide at 16 elements per radius took
            // 548, 545, 554 and 565 Newton and 4007, 3572, 3054 and 2889 Krylov iterations with 3e-3,
            // 0.01, 0.05 and 0.1 there. Once they are settled, 0.01 took 582 Newton iterations for 554.
            let least = if around.settled { 3e-3 } else { 0.05 };
            let forcing = (0.3 * self.tolerance * scale / norm).clamp(least, 0.1);
            self.conjugate_gradients(&residual, &mut direction, forcing);
            let line = Line { direction: &direction, residual: &residual, flat, hold };
            let near = norm <= REFRESH * scale;
            let ahead = near && line.is_short();
            let next = ahead.then(|| {
                self.contact.evaluate(|p| u[p] + direction[p], line.flat_at(size, 1.0), &around.limit);
                surroundings(&mut self.body, &mut self.contact, iteration + 1)
            });
            match next.flatten() {
                Some(next) if self.full_step(&mut u, &mut trial, &line, &next) => around = next,
                mut next => {
                    if next.is_some() {
                        self.internal_force(&u[..size], &around);
                    }
                    let step = self.line_search(&mut u, &mut trial, &line, &around);
                    stalled = if step < STAGNATION_TOLERANCE { stalled + 1 } else { 0 };
                    if stalled > STALLED_LIMIT {
                        let further = |p: usize| u[p] + direction[p];
                        if !chattering.waver(&mut self.contact, further, flat, &around.limit) {
                            return Err(StepFailure::Newton { iterations: iteration + 1, residual: last });
                        }
                        stalled = 0;
                    }
                    if near && !ahead {
                        next = surroundings(&mut self.body, &mut self.contact, iteration + 1);
                    }
                    if let Some(next) = next {
                        around = next;
                        if around.rise.is_some() {
                            self.internal_force(&u[..size], &around);
                        }
                    }
                }
            }
        }
        match chattering.share(&self.contact, &around.limit) {
            share if share > MOST_WITHOUT => Err(StepFailure::Chattering { share }),
            _ => Err(StepFailure::Newton { iterations: NEWTON_LIMIT, residual: last }),
        }
    }

    /// Of the body at displacement `u`, kept for the residual.
    fn internal_force(&mut self, u: &[f64], around: &CouplingData) {
        let clock = Instant::now();
        self.body.internal_force(u, around.rise.as_deref(), &mut self.internal);
        self.timings.since(Kernel::InternalForce, clock);
    }

    /// Back to the state before a step that failed, with the displacement and the cover of that
    /// state: nothing of the attempt may guide the next one.
    pub fn restore(&mut self, displacement: Vec<f64>, cover: Vec<f64>) {
        self.body.restore();
        self.contact.trial.clone_from(&self.contact.committed);
        self.contact.cover = cover;
        self.displacement = displacement;
    }

    /// Body, contact and displacement.
    pub fn into_parts(self) -> (Body, Contact, Vec<f64>) {
        (self.body, self.contact, self.displacement)
    }
}

/// What the mechanics of a step depends on from outside: temperature and the shear limits.
pub struct CouplingData {
    /// Limit of the shear traction at each contact point.
    pub limit: Vec<f64>,
    /// Temperature rise, if there is any.
    pub rise: Option<Vec<f64>>,
    /// Whether they agree with the state that they depend on.
    pub settled: bool,
}

pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    // Four sums, in a fixed order, for the machine's vector units.
    let mut sums = [0.0; 8];
    let (a8, a_rest) = a.as_chunks::<8>();
    let (b8, b_rest) = b.as_chunks::<8>();
    for (x, y) in a8.iter().zip(b8) {
        for l in 0..8 {
            sums[l] = crate::material::lanes::fma(x[l], y[l], sums[l]);
        }
    }
    sums.iter().sum::<f64>() + a_rest.iter().zip(b_rest).map(|(x, y)| x * y).sum::<f64>()
}
