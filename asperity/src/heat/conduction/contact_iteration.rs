//! A stage at constant properties: the system is linear but for the heat flow at the contact.
//!
//! With the interior eliminated, S θ = f + γΔt q(θ) remains for the contact, S its Schur complement. Newton's method
//! with slopes q′ of an earlier iterate solves (S − γΔt q′)θ = f + γΔt (q − q′θ). The dense factor takes most of the
//! time, so it is reused in later iterations and stages while the iteration contracts.

use faer::linalg::solvers::Llt;

use super::HeatError;
use super::step::{HeatState, StageSolver, Step, solve_contact};
use crate::discretisation::collocation::Parity;

const ITERATIONS: usize = 40;
/// Contraction of one iteration above which the slopes are evaluated anew.
const SLOW: f64 = 0.1;
/// Relative change that ends the iteration, and that which is accepted where rounding stops it.
const TOLERANCE: f64 = 1e-11;
const ROUNDING: f64 = 1e-9;

/// The contact's Schur complement with slopes of the heat flows, factorised.
struct Chord {
    slopes: Vec<f64>,
    factor: Llt<f64>,
}

/// Chord of the iterations so far in a step.
#[derive(Default)]
pub(super) struct ContactIteration(Option<Chord>);

impl StageSolver for ContactIteration {
    fn solve(
        &mut self,
        step: &Step<'_>,
        rhs: &[f64],
        guess: &HeatState,
        _reduction: f64,
    ) -> Result<HeatState, HeatError> {
        let factors = &step.matrix.factors;
        let mut modal = vec![0.0; factors.modal_length()];
        factors.to_modal(rhs, &mut modal);
        factors.forward(&mut modal);
        let contact = &mut modal[factors.contact_offset()..];
        let free = contact.to_vec();
        let mut rise: Vec<f64> = step.conduction.contact_indices.iter().map(|&p| guess.rise[p]).collect();
        let mut residual = f64::INFINITY;
        for _ in 0..ITERATIONS {
            contact.copy_from_slice(&free);
            let change = self.iterate(step, contact, &mut rise)?;
            let before = std::mem::replace(&mut residual, change);
            if residual <= TOLERANCE {
                break;
            }
            if residual > SLOW * before {
                self.0 = None;
            }
        }
        if residual > ROUNDING {
            return Err(HeatError::NotConverged { residual });
        }
        factors.backward(&mut modal);
        let mut solution = vec![0.0; rhs.len()];
        factors.to_nodal(&modal, &mut solution);
        Ok(HeatState::linear(solution))
    }
}

impl ContactIteration {
    /// One iteration from `rise`, with the harmonics of f in `contact`; returns the relative change.
    fn iterate(&mut self, step: &Step<'_>, contact: &mut [f64], rise: &mut [f64]) -> Result<f64, HeatError> {
        let columns = step.matrix.factors.harmonics();
        let table = step.matrix.factors.transform.of(Parity::Even);
        let rings = contact.len() / columns;
        let flows: Vec<(f64, f64)> = (0..rise.len()).map(|i| step.heat.flow(i, rise[i])).collect();
        let Chord { slopes, factor } = match &mut self.0 {
            Some(chord) => chord,
            none => {
                let slopes: Vec<f64> = flows.iter().map(|flow| flow.1).collect();
                let factor = step.contact_factor(|point| slopes[point])?;
                none.insert(Chord { slopes, factor })
            }
        };
        for ring in 0..rings {
            let load: Vec<f64> = (ring * columns..(ring + 1) * columns)
                .map(|point| step.scale() * (flows[point].0 - slopes[point] * rise[point]))
                .collect();
            for m in 0..step.harmonics_of(ring) {
                for j in 0..columns {
                    contact[ring * columns + m] += table[m * columns + j] * load[j];
                }
            }
        }
        solve_contact(factor, contact);
        let (mut change, mut largest) = (0.0f64, 1e-300f64);
        for ring in 0..rings {
            for j in 0..columns {
                let value: f64 = (0..step.harmonics_of(ring))
                    .map(|m| table[m * columns + j] * contact[ring * columns + m])
                    .sum();
                if !value.is_finite() {
                    return Err(HeatError::NotConverged { residual: value });
                }
                let rise = &mut rise[ring * columns + j];
                change = change.max((value - *rise).abs());
                largest = largest.max(value.abs());
                *rise = value;
            }
        }
        Ok(change / largest)
    }
}
