//! Slip rate of a contact whose flat has slowed down or stopped.
//!
//! Where the strength of the interface grows with the logarithm of the slip rate, dτ = bτ d ln v, the force Q on a contact that
//! slips everywhere falls in proportion to what it slips beyond the flat. With the mean displacement u of a half-space under a
//! uniform traction,
//!
//! ```text
//! Q̇ = (V₂ − v) Q/u = bQ v̇/v,     u = 4(2 − ν)Q/(3π²Ga),
//! 1/v = 1/V₂ + (1/V₁ − 1/V₂) exp(−V₂t/(bu)),     in a hold v = V₁/(1 + V₁t/(bu)),
//! ```
//!
//! the relaxation of a slider with a velocity-strengthening interface (H. Perfettini & J.-P. Avouac, J. Geophys. Res. 109, B02304
//! (2004), doi 10.1029/2003JB002488); u by integration of Cerruti's solution over the disc. The strength is that at
//! v; the slip and its heat follow from equilibrium. Where the contact cools it sticks in part, and slips slower than v.

use std::f64::consts::PI;

use super::Slide;
use super::motion::Motion;

/// The fall of the slip rate after the start of a motion.
#[derive(Clone, Copy, Debug, Default)]
pub struct Relaxation {
    /// V₁, m/s; 0 at the start and after a reversal.
    from: f64,
    /// bu, m.
    length: f64,
}

impl Relaxation {
    /// v in m/s, `time` (s) after the flat has taken the rate `to` (m/s).
    fn slip_rate(&self, to: f64, time: f64) -> f64 {
        // At a higher rate the contact sticks until its force has risen by bQ ln(V₂/V₁), as the slider does but for a slip of some
        // bu.
        if self.from <= to || self.length == 0.0 {
            return to;
        }
        let decay = to * time / self.length;
        let gone = if to > 0.0 { -(-decay).exp_m1() / to } else { time / self.length };
        1.0 / ((-decay).exp() / self.from + gone)
    }
}

impl Slide<'_> {
    /// The fall of the slip rate as the present motion begins.
    pub(super) fn relaxation(&self) -> Relaxation {
        let (now, problem) = (self.last(), self.problem);
        // Friction resists the motion unless that is a reversal, after which the contact sticks first.
        if self.motion.direction() * now.friction < 0.0 || now.area == 0.0 {
            return Relaxation::default();
        }
        let radius = now.radius();
        let displacement = 4.0 * (2.0 - problem.poisson_ratio) * now.friction.abs()
            / (3.0 * PI * PI * problem.solid.moduli.shear * radius);
        let length = problem.units.length;
        let sensitivity = problem.solid.interface_rate_sensitivity(self.slip_rate, radius * length);
        Relaxation { from: self.slip_rate, length: sensitivity * displacement * length }
    }

    /// Part of the length of the present motion in which the slip rate begins to fall: that of the time bu/V₁; infinite where
    /// it does not fall.
    pub(super) fn length_of_fall(&self) -> f64 {
        let Relaxation { from, length } = self.relaxation;
        let (to, units) = (self.motion.slip_rate(), &self.problem.units);
        match self.motion {
            _ if from <= to || length == 0.0 => f64::INFINITY,
            Motion::Slip { .. } => length / units.length * (to / from),
            Motion::Hold { .. } => length / from / units.time,
        }
    }

    /// Λ, factor of the strength of the interface by the rate law at a slip rate (m/s) of a contact of area `area`.
    pub(super) fn rate_factor(&self, slip_rate: f64, area: f64) -> f64 {
        let radius = (area / PI).sqrt() * self.problem.units.length;
        self.problem.solid.interface_rate_factor(slip_rate, radius)
    }

    /// Rate at which the contact slips, m/s, after a part of the length of the present motion.
    pub(super) fn slip_rate_after(&self, length: f64) -> f64 {
        let to = self.motion.slip_rate();
        self.relaxation.slip_rate(to, self.motion.seconds(length, &self.problem.units))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against the rate equation b v̇/v = (V₂ − v)/u, integrated by the rule of Runge and Kutta.
    #[test]
    fn the_rate_falls_as_the_force_on_the_spring_does() {
        for to in [0.0, 1e-6, 1e-3, 0.3] {
            let relaxation = Relaxation { from: 2.0, length: 1e-3 };
            let slope = |logarithm: f64| (to - logarithm.exp()) / relaxation.length;
            let (mut logarithm, mut time, mut dt) = (2f64.ln(), 0.0, 1e-7);
            while time < 0.1 {
                let one = slope(logarithm);
                let two = slope(logarithm + 0.5 * dt * one);
                let three = slope(logarithm + 0.5 * dt * two);
                let four = slope(logarithm + dt * three);
                logarithm += dt / 6.0 * (one + 2.0 * two + 2.0 * three + four);
                time += dt;
                dt *= 1.001;
                let expected = relaxation.slip_rate(to, time);
                assert!((logarithm.exp() / expected - 1.0).abs() < 1e-6, "{to} {time}");
            }
        }
        assert_eq!(Relaxation { from: 0.1, length: 1e-3 }.slip_rate(0.2, 1e-9), 0.2);
        assert_eq!(Relaxation { from: 0.3, length: 0.0 }.slip_rate(0.2, 1e-9), 0.2);
    }
}
