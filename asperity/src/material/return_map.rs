//! Radial return to the yield surface.

use super::Solid;
use super::strain_rate::StepRate;
use crate::material::lanes::{Lanes, lanes, powers};
use crate::scene::Hardening;

/// Points whose elastic stress is above the yield strength, from one state to the next. G is that of T₀: where the moduli
/// have changed, stresses and softening factor are relative to E(T)/E(T₀).
#[derive(Clone, Copy, Debug)]
pub struct Trial<const W: usize> {
    /// Lanes that flow: those with an elastic stress at the end above the strength there.
    pub flowing: [bool; W],
    /// ε_p at the start.
    pub strain: Lanes<W>,
    /// σ_y(ε_p, T₀) at the start and at the reference strain rate.
    pub strength: Lanes<W>,
    /// f(T)/f(T₀) at the end.
    pub softening: Lanes<W>,
    /// First guess of the increment of ε_p, 0 if there is none.
    pub guess: Lanes<W>,
    /// Length of the step, s; infinite at the reference strain rate.
    pub time_step: f64,
}

/// Result of a return mapping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Return<const W: usize> {
    /// Increment of the equivalent plastic strain.
    pub increment: Lanes<W>,
    /// Strength at the end and at its strain rate, at the initial temperature.
    pub strength: Lanes<W>,
    /// dσ_y/dε_p at the end, with the change of the strain rate.
    pub slope: Lanes<W>,
}

impl Solid {
    /// Radial return from the von Mises stress q = `stress` without further flow: the increment x with
    /// q − 3Gx = f·σ_y(ε_p + x, x/Δt, T₀). Lanes that do not flow stay as they are.
    ///
    /// The residual falls and is convex where hardening is concave, so Newton's method started left of the root never
    /// passes it. For a power law, with its infinite initial slope, it starts where the elastic and the hardening part
    /// each take up half of the excess. A bracket secures laws that are not concave, and the reference strain rate, where
    /// the slope jumps.
    #[inline(always)]
    pub fn return_map<const W: usize>(&self, trial: &Trial<W>, stress: &Lanes<W>) -> Return<W> {
        let rate = self.rate_over(trial.time_step);
        let stiffness = 3.0 * self.moduli.shear;
        let Trial { strain, softening, .. } = trial;
        let mut end = Return { increment: [0.0; W], strength: trial.strength, slope: [0.0; W] };
        let mut pending = [false; W];
        let (mut low, mut high) = ([0.0; W], [0.0; W]);
        for l in 0..W {
            let excess = stress[l] - softening[l] * trial.strength[l];
            pending[l] = trial.flowing[l] && excess > 0.0;
            // Where the hardening falls, the increment may exceed that at the present strength.
            let most = if self.hardening.may_fall() { stress[l] } else { excess };
            high[l] = if pending[l] { most / stiffness } else { 0.0 };
        }
        let mut x = self.first_guess(trial, stress, &pending, &high);
        // A power law is smooth: one iteration takes an error e below e²/2(ε_p + x), which bounds the error of the last
        // iterate without another evaluation of the power.
        let smooth = rate.is_none() && matches!(self.hardening, Hardening::JohnsonCook { .. });
        let mut inexact = [false; W];
        for _ in 0..100 {
            if !pending.contains(&true) {
                break;
            }
            let (strength, slope) = self.strength_after(strain, &x, rate);
            // Without branches, for the vector units; converged lanes keep their values.
            for l in 0..W {
                let residual = stress[l] - stiffness * x[l] - softening[l] * strength[l];
                let falls_short = residual >= 0.0;
                low[l] = if falls_short { x[l] } else { low[l] };
                high[l] = if falls_short { high[l] } else { x[l] };
                let step = residual / (stiffness + softening[l] * slope[l]);
                let next = x[l] + step;
                let inside = (next >= low[l]) & (next <= high[l]);
                let least = if next < x[l] { next } else { x[l] };
                let short = smooth & inside & (step * step <= 1e-13 * least * (strain[l] + least));
                let converged = short
                    | (step.abs() <= 1e-13 * (x[l].abs() + step.abs()))
                    | (residual.abs() <= 1e-15 * stress[l]);
                let next = if inside { next } else { 0.5 * (low[l] + high[l]) };
                x[l] = if pending[l] { next } else { x[l] };
                let done = pending[l] & converged;
                // To first order; the curvature is neglected in the slope alone.
                end.strength[l] = if done { strength[l] + slope[l] * step } else { end.strength[l] };
                end.slope[l] = if done { slope[l] } else { end.slope[l] };
                inexact[l] |= done & !(smooth & inside & slope[l].is_finite());
                pending[l] &= !converged;
            }
        }
        for l in 0..W {
            end.increment[l] = x[l];
            if inexact[l] || pending[l] {
                let ([strength], [slope]) = self.strength_after(&[strain[l]], &[x[l]], rate);
                (end.strength[l], end.slope[l]) = (strength, slope);
            } else if x[l] == 0.0 && trial.flowing[l] {
                end.slope[l] = self.hardened(strain[l]).1;
            }
            end.slope[l] *= softening[l];
        }
        end
    }

    /// Strength and its derivative by the increment, without softening.
    #[inline(always)]
    fn strength_after<const W: usize>(
        &self,
        strain: &Lanes<W>,
        increment: &Lanes<W>,
        rate: Option<StepRate>,
    ) -> (Lanes<W>, Lanes<W>) {
        let (strength, slope) = self.hardened_lanes(&lanes(|l| strain[l] + increment[l]));
        let Some(rate) = rate else { return (strength, slope) };
        let (factor, factor_slope) = rate.factors(increment);
        let rated = lanes(|l| factor[l] * strength[l]);
        (rated, lanes(|l| factor[l] * slope[l] + factor_slope[l] * strength[l]))
    }

    #[inline(always)]
    fn first_guess<const W: usize>(
        &self,
        trial: &Trial<W>,
        stress: &Lanes<W>,
        pending: &[bool; W],
        high: &Lanes<W>,
    ) -> Lanes<W> {
        let guessed = |l: usize| trial.guess[l] > 0.0 && trial.guess[l] < high[l];
        let mut x = lanes(|l| if pending[l] && guessed(l) { trial.guess[l] } else { 0.0 });
        let Hardening::JohnsonCook { modulus, exponent } = &self.hardening else { return x };
        let fresh: [bool; W] = std::array::from_fn(|l| {
            pending[l] && !guessed(l) && trial.strain[l] <= 0.0 && trial.softening[l] > 0.0
        });
        if fresh.contains(&true) {
            let share: Lanes<W> = lanes(|l| {
                let b = trial.softening[l] * modulus / self.yield_strength;
                let excess = stress[l] - trial.softening[l] * trial.strength[l];
                if fresh[l] { 0.5 * excess / b } else { 1.0 }
            });
            let start = powers(&share, 1.0 / exponent);
            (0..W).filter(|&l| fresh[l]).for_each(|l| x[l] = start[l].min(0.5 * high[l]));
        }
        x
    }
}
