//! The press: a θ-independent problem without heat, quasi-static or within a time, in full stick, or without friction if the
//! interface has none or the counterface is displaced as the asperity is.

use crate::discretisation::body::Body;
use crate::discretisation::collocation::Collocation;
use crate::discretisation::mesh::MeshSize;
use crate::interface::contact::{Contact, FlatPosition};
use crate::loading::NEWTON_TOLERANCE;
use crate::loading::problem::{Discretisation, Problem};
use crate::solver::StopRequest;
use crate::solver::harmonic::FactorError;
use crate::solver::newton::{CouplingData, LoadingControl, Mechanics, StepFailure};

#[derive(Debug, thiserror::Error)]
pub enum PressFailure {
    #[error(transparent)]
    Factor(FactorError),
    #[error("stopped on request")]
    Stopped,
    #[error("interference {interference:.4} omega_c: {failure}")]
    Step { interference: f64, failure: StepFailure },
}

impl From<FactorError> for PressFailure {
    fn from(error: FactorError) -> Self {
        match error {
            FactorError::Stopped => Self::Stopped,
            error => Self::Factor(error),
        }
    }
}

/// One increment of the press, dimensionless.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Increment {
    pub interference: f64,
    pub load: f64,
    pub area: f64,
}

/// Presses to ω₀ on a given mesh in `count` increments (more where Newton's method fails), of equal
/// length in √ω, which is proportional to the contact radius.
pub fn press_on(
    problem: &Problem,
    size: MeshSize,
    count: usize,
    stop: &StopRequest,
) -> Result<(Mechanics, Vec<Increment>), PressFailure> {
    /// Shortest increment, over the usual one.
    const SHORTEST: f64 = 1e-4;
    let mut mechanics = unloaded(problem, size, stop)?;
    let usual = 1.0 / count as f64;
    let mut increments = Vec::new();
    let mut before = (0.0, mechanics.displacement.clone());
    let mut done = 0.0;
    let mut advance = usual;
    let mut radius: f64 = 0.0;
    while radius < 1.0 {
        let next = (radius + advance).min(1.0);
        let interference = problem.interference * next * next;
        let start = extrapolate(&before.1, &mechanics.displacement, before.0, done, interference);
        let committed = mechanics.displacement.clone();
        let contact_fraction = mechanics.contact.contact_fraction.clone();
        // The contact radius, in proportion to √ω, grows uniformly in time.
        mechanics.body.time_step = problem.press_time * (next - radius);
        match press_to(problem, &mut mechanics, interference, start, stop) {
            Ok(increment) => {
                increments.push(increment);
                before = (done, committed);
                done = interference;
                radius = next;
                advance = (1.5 * advance).min(usual);
            }
            Err(StepFailure::Stopped) => return Err(PressFailure::Stopped),
            Err(failure) => {
                mechanics.restore(committed, contact_fraction);
                advance *= 0.5;
                if advance < SHORTEST * usual {
                    let interference = interference / problem.critical_interference;
                    return Err(PressFailure::Step { interference, failure });
                }
            }
        }
    }
    Ok((mechanics, increments))
}

/// The unloaded asperity on a mesh.
fn unloaded(problem: &Problem, size: MeshSize, stop: &StopRequest) -> Result<Mechanics, FactorError> {
    let Discretisation { mesh, factors } =
        Discretisation::new(problem, size, Collocation::axisymmetric(), stop)?;
    let contact = Contact::new(&mesh, problem.contact_modulus);
    let displacement = vec![0.0; mesh.field_length(3)];
    let mut body = Body::new(mesh, problem.solid.clone());
    if problem.finite_strain {
        body = body.at_finite_strain();
    }
    Ok(Mechanics::new(body, contact, factors, displacement, NEWTON_TOLERANCE))
}

/// Solves and commits one increment, from the first guess `start`.
fn press_to(
    problem: &Problem,
    mechanics: &mut Mechanics,
    interference: f64,
    start: Vec<f64>,
    stop: &StopRequest,
) -> Result<Increment, StepFailure> {
    let limit = if problem.press_friction.sticks { f64::INFINITY } else { 0.0 };
    let flat = FlatPosition { interference, displacement: 0.0 };
    mechanics.solve(flat, LoadingControl::Interference, start, stop, |_, contact, iteration| {
        if problem.finite_strain {
            contact.update_areas(iteration == 0);
        }
        Some(CouplingData { limit: vec![limit; contact.len()], rise: None, elevation: None, converged: true })
    })?;
    let edges = mechanics.contact.trial_edges();
    mechanics.contact.set_edges(&edges);
    mechanics.body.commit();
    mechanics.contact.commit();
    let contact = &mechanics.contact;
    Ok(Increment {
        interference,
        load: contact.load(&contact.committed),
        area: contact.area(&contact.committed),
    })
}

/// Linear extrapolation of the last two solutions, by at most three increments.
pub fn extrapolate(before: &[f64], now: &[f64], t_before: f64, t_now: f64, t_next: f64) -> Vec<f64> {
    let factor = if t_now > t_before { ((t_next - t_now) / (t_now - t_before)).min(3.0) } else { 0.0 };
    now.iter().zip(before).map(|(x, y)| x + factor * (x - y)).collect()
}
