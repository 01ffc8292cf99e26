//! The friction–slip curve: states, static friction.

use crate::integral::contact_state::{ContactState, Integral};
use crate::integral::mean_plane::MeanPlane;
use crate::integral::predictor::Sensitivity;
use crate::integral::separation::EquilibriumState;
use tables::law::Estimate;

/// Share of the initial slope below which a curve is taken to slide. All of an asperity slips before that, at the slip of inception
/// of a table: friction still rises as its contact grows.
pub const INCEPTION_SLOPE: f64 = 0.01;

/// The surface after one slip.
#[derive(Clone, Copy, Debug, Default)]
pub struct SlipState {
    /// Friction over load, 1.
    pub mu: Estimate,
    /// Friction stress on the nominal area, Pa.
    pub shear: Estimate,
    /// Nominal pressure, Pa.
    pub pressure: Estimate,
    /// Distance of the flat from the undisplaced plane of the heights, m.
    pub separation: Estimate,
    /// Displacement of that plane by the nominal pressure, m.
    pub displacement: Estimate,
    /// Real over nominal contact area, 1.
    pub area_fraction: Estimate,
    /// Contacts per nominal area, 1/m².
    pub contact_density: Estimate,
    /// Share of the load beyond the range of the law, 1.
    pub outside: f64,
    /// Share of the load beyond the largest contact of the model, 1.
    pub beyond: f64,
    /// Share of the load on contacts whose friction the law does not know: steadily sliding ones older than its histories, of
    /// unknown steady friction, or ones whose slides end before sliding begins; 1.
    pub unknown_load: f64,
}

impl SlipState {
    /// State of a surface under the prescribed pressure `asked` (Pa): the error of the law's load becomes one of the
    /// separation, and through the sensitivities of all other quantities.
    pub fn at_pressure(equilibrium: &EquilibriumState, asked: Estimate, plane: MeanPlane) -> Self {
        let state = &equilibrium.state;
        let (shift, sensitivity) = (equilibrium.separation_error(asked.value), &equilibrium.sensitivity);
        let off = (state.pressure.value - asked.value).abs();
        let pressure = Estimate { error: off + asked.error, ..asked };
        let displacement = plane.displacement(pressure);
        let separation = Estimate { value: equilibrium.separation - displacement.value, error: shift };
        let mut found = Self { pressure, separation, displacement, ..Self::at_separation(0.0, state, plane) };
        found.move_by(shift, sensitivity);
        found.shear = found.mu.times(asked);
        found
    }

    /// State of a surface at a `held` separation, which a displacement of the mean plane uncertain as the law's load
    /// adds to.
    ///
    /// A load of the law too high by δp/p moves the separation that was found from the load before the slide by δd, away;
    /// there the load of the slide, of the same asperities, is wrong by |δp/p − |d ln p/dd| δd|.
    pub fn held(equilibrium: &EquilibriumState, held: HeldSeparation, plane: MeanPlane) -> Self {
        let EquilibriumState { separation, state, sensitivity, .. } = equilibrium;
        let mut found = Self::at_separation(*separation, state, plane);
        let (Integral { value, law_error, quadrature_error }, slope) =
            (state.pressure, sensitivity.pressure.abs());
        let relief = plane.relief(value, slope);
        let of_law = (law_error - value * slope * held.law_error).abs();
        let others = quadrature_error + value * slope * (held.error - held.law_error);
        let shift = held.error / relief + plane.displacement_error(found.pressure, slope);
        found.pressure.error = (of_law + others) / relief;
        found.displacement = plane.displacement(found.pressure);
        found.separation.error = held.error;
        found.move_by(shift, sensitivity);
        // Of Q itself, or of μ and p.
        found.shear.error = found.shear.error.min(found.mu.times(found.pressure).error);
        found
    }

    /// Adds the errors of a `shift` (m) of the effective separation.
    fn move_by(&mut self, shift: f64, sensitivity: &Sensitivity) {
        for (quantity, slope) in [
            (&mut self.mu, sensitivity.friction_coefficient),
            (&mut self.shear, sensitivity.pressure + sensitivity.friction_coefficient),
            (&mut self.area_fraction, sensitivity.area_fraction),
            (&mut self.contact_density, sensitivity.contact_density),
        ] {
            quantity.error += shift * (slope * quantity.value).abs();
        }
    }

    /// Separation of the flat from the displaced plane, which the summits feel, m.
    pub fn effective_separation(&self) -> Estimate {
        let (separation, displacement) = (self.separation, self.displacement);
        Estimate {
            value: separation.value + displacement.value,
            error: separation.error + displacement.error,
        }
    }

    /// The state with unknown friction.
    pub fn without_friction(self) -> Self {
        Self { mu: Estimate::UNKNOWN, shear: Estimate::UNKNOWN, ..self }
    }

    /// State of a surface held at the `effective` separation (m), with the errors of an exact one.
    pub fn at_separation(effective: f64, state: &ContactState, plane: MeanPlane) -> Self {
        let exact = Estimate::exact;
        let displacement = plane.displacement(exact(state.pressure.value));
        Self {
            mu: state.friction_coefficient(),
            shear: state.shear.estimate(),
            pressure: state.pressure.estimate(),
            separation: exact(effective - displacement.value),
            displacement,
            area_fraction: state.area_fraction.estimate(),
            contact_density: exact(state.contact_density),
            outside: state.outside,
            beyond: state.beyond,
            // Sliding surfaces ask for no other quantity than the unsteady or the stuck load.
            unknown_load: state.additional_share(),
        }
    }
}

/// Error of a separation that is held during the slide, m.
#[derive(Clone, Copy, Debug, Default)]
pub struct HeldSeparation {
    /// The whole error.
    error: f64,
    /// The part that comes from the error of the law, which the loads of the slide have as well.
    law_error: f64,
}

impl HeldSeparation {
    /// Error of the separation at which the law has the `pressure` (Pa) before the slide.
    pub fn found(before: &EquilibriumState, pressure: f64) -> Self {
        let load = before.state.pressure;
        let slope = (before.sensitivity.pressure * load.value).abs();
        let law_error = if slope > 0.0 { load.law_error / slope } else { 0.0 };
        Self { error: before.separation_error(pressure), law_error }
    }
}

/// Sliding inception of the whole surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceInception {
    /// Slip at which it is reached, m.
    pub slip: Estimate,
    /// Friction coefficient there, 1.
    pub mu: Estimate,
    /// False if the curve still rises at its end: `mu` is then the end value.
    pub reached: bool,
}

/// First slip at which the slope of the friction coefficient has fallen to
/// [`INCEPTION_SLOPE`] of its initial value: the first maximum, or the knee of a
/// curve that rises slowly to its end.
///
/// Errors include the difference from every second point of the curve. Up to there friction rises with the
/// slip, so that the slip is uncertain in proportion, too, and at least as the slips at which the contacts begin to slide,
/// `of_contacts` relatively.
pub fn inception(slip: &[f64], mu: &[Estimate], of_contacts: f64) -> SurfaceInception {
    let mut found = inception_on(slip, mu);
    let coarse_slip: Vec<f64> = slip.iter().copied().step_by(2).collect();
    let coarse_mu: Vec<Estimate> = mu.iter().copied().step_by(2).collect();
    if coarse_slip.len() > 2 {
        let coarse = inception_on(&coarse_slip, &coarse_mu);
        found.mu.error += (found.mu.value - coarse.mu.value).abs();
        found.slip.error += (found.slip.value - coarse.slip.value).abs();
    }
    found.slip.error = found.slip.error.max(of_contacts * found.slip.value);
    found
}

fn inception_on(slip: &[f64], mu: &[Estimate]) -> SurfaceInception {
    let slope = |i: usize| (mu[i + 1].value - mu[i].value) / (slip[i + 1] - slip[i]);
    let found = |slip: f64, mu: Estimate, reached: bool| {
        let share = if mu.value > 0.0 { mu.error / mu.value } else { 0.0 };
        SurfaceInception { slip: Estimate { value: slip, error: slip * share }, mu, reached }
    };
    let at_node = |i: usize, reached: bool| found(slip[i], mu[i], reached);
    let last = slip.len() - 1;
    if last == 0 {
        return at_node(0, false);
    }
    let initial = slope(0);
    if initial <= 0.0 {
        return at_node(0, true);
    }
    let threshold = INCEPTION_SLOPE * initial;
    let Some(knee) = (1..last).find(|&i| slope(i) <= threshold) else {
        return at_node(last, false);
    };
    // Slopes belong to the middles of their intervals and vary linearly between;
    // they pass the threshold on one side of the knot or the other.
    let middle = |i: usize| 0.5 * (slip[i] + slip[i + 1]);
    let (before, after) = (slope(knee - 1), slope(knee));
    let (start, end) = (middle(knee - 1), middle(knee));
    let share = ((before - threshold) / (before - after)).clamp(0.0, 1.0);
    let place = start + share * (end - start);
    let at_knot = before + (after - before) * (slip[knee] - start) / (end - start);
    let rise = (place - slip[knee]) * 0.5 * (at_knot + threshold);
    found(place, Estimate { value: mu[knee].value + rise, error: mu[knee].error }, true)
}

/// Slips for the curve, m: zero, then geometric from 1e-4 of the smallest contact radius to four times the
/// largest, `points` of them where both are one. Asperities stop sticking after some thousandths of their contact radius;
/// tables end after two. Between the ends slips are powers of one number, which other rows have too.
pub fn slip_grid([smallest_radius, largest_radius]: [f64; 2], points: usize) -> Vec<f64> {
    const SHARE_OF_END: f64 = 1e-3;
    let (from, to) = (1e-4 * smallest_radius, 4.0 * largest_radius);
    let step = 4e4f64.ln() / (points.max(5) - 3) as f64;
    let place = |slip: f64| slip.ln() / step;
    let (first, last) = (place(from) + SHARE_OF_END, place(to) - SHARE_OF_END);
    let inner = (first.ceil() as i64..=last.floor() as i64).map(|power| (power as f64 * step).exp());
    [0.0, from].into_iter().chain(inner).chain([to]).collect()
}

/// A curve over ascending `slip` (m), linear between them, at other slips; unknown after its end.
pub fn resampled(slip: &[f64], curve: &[Estimate], at: &[f64]) -> Vec<Estimate> {
    let last = slip.len() - 1;
    let value = |&at: &f64| match slip.partition_point(|known| *known <= at) {
        // Ends that are meant to agree differ by rounding.
        after if after > last => {
            if at <= slip[last] * (1.0 + 1e-12) {
                curve[last]
            } else {
                Estimate::UNKNOWN
            }
        }
        after => {
            let (from, to) = (curve[after - 1], curve[after]);
            let share = (at - slip[after - 1]) / (slip[after] - slip[after - 1]);
            let between = |from: f64, to: f64| from + share * (to - from);
            Estimate { value: between(from.value, to.value), error: between(from.error, to.error) }
        }
    };
    at.iter().map(value).collect()
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    pub(crate) fn curve(mu: impl Fn(f64) -> f64) -> (Vec<f64>, Vec<Estimate>) {
        let slip = slip_grid([1.0; 2], 97);
        let values = slip.iter().map(|&s| Estimate::exact(mu(s))).collect();
        (slip, values)
    }

    #[test]
    fn a_saturating_curve_slides_where_its_slope_is_one_per_cent() {
        // μ = 0.4 (1 − e^{−s/l}): the slope is 1 % at s = l ln 100.
        let (slip, mu) = curve(|s| 0.4 * (1.0 - (-s / 0.01).exp()));
        let found = inception(&slip, &mu, 0.0);
        assert!(found.reached);
        // Neighbouring slips differ by 12 %, which moves slopes by the square of that.
        assert!((found.slip.value / (0.01 * 100f64.ln()) - 1.0).abs() < 0.02);
        assert!((found.slip.value - 0.01 * 100f64.ln()).abs() <= found.slip.error);
        assert!(found.slip.error < 0.1 * found.slip.value);
        assert!((found.mu.value - 0.396).abs() < 2e-4, "{}", found.mu.value);
        assert!((found.mu.value - 0.396).abs() <= found.mu.error);
    }

    #[test]
    fn a_curve_with_a_peak_slides_at_the_peak() {
        let (slip, mu) = curve(|s| 0.3 * (s / 0.02) * (1.0 - s / 0.02).exp() + 0.2 * (s / (s + 0.01)));
        let highest = mu.iter().map(|m| m.value).fold(0.0, f64::max);
        let found = inception(&slip, &mu, 0.0);
        assert!((found.mu.value / highest - 1.0).abs() < 2e-3);
    }

    #[test]
    fn a_rigid_curve_slides_at_once_and_a_rising_one_never() {
        let (slip, mu) = curve(|_| 0.5);
        assert_eq!(inception(&slip, &mu, 0.0).slip.value, 0.0);
        let (slip, mu) = curve(|s| s);
        let found = inception(&slip, &mu, 0.0);
        assert!(!found.reached && found.mu.value == 4.0);
    }

    #[test]
    fn a_curve_is_linear_between_its_slips_and_unknown_after_its_end() {
        let slip = [0.0, 1.0, 3.0];
        let curve = [0.0, 2.0, 1.0].map(|value| Estimate { value, error: 0.1 * value });
        let found = resampled(&slip, &curve, &[0.0, 0.5, 1.0, 2.0, 3.0 * (1.0 + 1e-15), 3.1]);
        let values: Vec<f64> = found.iter().map(|mu| mu.value).collect();
        assert_eq!(values[..5], [0.0, 1.0, 2.0, 1.5, 1.0]);
        assert!(values[5].is_nan() && (found[3].error - 0.15).abs() < 1e-15);
    }
}
