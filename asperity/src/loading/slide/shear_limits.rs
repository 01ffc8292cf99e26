//! Limit of the shear traction at each contact point.

use crate::discretisation::body::{Body, BodyState};
use crate::interface::contact::Contact;
use crate::interface::friction_law::{ContactPoint, shear_limit};
use crate::loading::problem::Problem;
use crate::material::SHEAR_RATIO;
use crate::scene::InterfaceStrength;

/// f_τ σ_Y(T)/√3 times the hardening factor.
pub fn shear_strength(problem: &Problem, hardened: f64, rise: f64) -> f64 {
    problem.interface.strength_factor * SHEAR_RATIO * (hardened * problem.solid.softening_factor(rise))
}

/// Factor by which the interface has hardened with plastic strain and with the strain rate, at each contact point.
pub fn interface_hardening(
    problem: &Problem,
    slip_rate: f64,
    body: &Body,
    contact: &Contact,
    state: &BodyState,
) -> Vec<f64> {
    let radius = problem.units.length * contact.radius(&contact.trial);
    let rated = problem.solid.interface_rate_factor(slip_rate, radius);
    match problem.interface.strength {
        InterfaceStrength::Initial => vec![rated; contact.len()],
        InterfaceStrength::Current => {
            let strain = body.surface_strain(state);
            strain.into_iter().map(|strain| rated * problem.solid.hardening_factor(strain)).collect()
        }
    }
}

/// Limit of the shear traction at a contact point whose interface has hardened by the factor `hardened`, at a temperature
/// rise.
pub fn shear_limit_at(problem: &Problem, contact: &Contact, point: usize, hardened: f64, rise: f64) -> f64 {
    let at = ContactPoint {
        pressure: contact.trial[point].pressure,
        contact_fraction: contact.contact_fraction[point],
        strength: shear_strength(problem, hardened, rise),
        temperature: problem.units.temperature + rise,
        unit: problem.units.stress,
    };
    shear_limit(&problem.interface.law, &at)
}

/// Limit of the shear traction at each contact point.
pub fn shear_limits(
    problem: &Problem,
    contact: &Contact,
    hardened: &[f64],
    rise: Option<&[f64]>,
) -> Vec<f64> {
    let rise_at = |i: usize| rise.map_or(0.0, |field| field[contact.scalar_index(i)]);
    (0..contact.len()).map(|i| shear_limit_at(problem, contact, i, hardened[i], rise_at(i))).collect()
}
