//! Λ, factor of the strength by the strain rate, over a step of time.

use super::Solid;
use crate::material::lanes::{Lanes, lanes, logarithms};
use crate::scene::Rate;

/// Johnson & Cook's factor 1 + C ln(max(ε̇_p/ε̇₀, 1)) over a step of length Δt: ε̇_p = Δε_p/Δt.
#[derive(Clone, Copy, Debug)]
pub(super) struct StepRate {
    /// C.
    coefficient: f64,
    /// ε̇₀Δt.
    reference: f64,
}

impl Solid {
    /// The rate law over a step of `time_step` seconds; none where the strength is that of the reference rate.
    pub(super) fn rate_over(&self, time_step: f64) -> Option<StepRate> {
        match self.rate {
            Rate::JohnsonCook { coefficient, reference } if time_step.is_finite() => {
                Some(StepRate { coefficient, reference: reference * time_step })
            }
            _ => None,
        }
    }
}

impl StepRate {
    /// The factor at increments of ε_p, and its derivative.
    #[inline(always)]
    pub(super) fn factors<const W: usize>(self, increment: &Lanes<W>) -> (Lanes<W>, Lanes<W>) {
        let logs: Lanes<W> = logarithms(&lanes(|l| (increment[l] / self.reference).max(1.0)));
        let slope = lanes(|l| {
            let slope = self.coefficient / increment[l];
            if increment[l] > self.reference { slope } else { 0.0 }
        });
        (lanes(|l| 1.0 + self.coefficient * logs[l]), slope)
    }
}
