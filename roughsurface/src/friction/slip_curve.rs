//! The friction–slip curve: static friction, sliding friction, weakening energy.

use crate::integral::contact_state::ContactState;
use crate::integral::mean_plane::MeanPlane;
use crate::integral::predictor::Sensitivity;
use crate::integral::separation::EquilibriumState;
use tables::law::Estimate;

/// Share of the initial slope below which a curve is taken to slide, as for a
/// single asperity.
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
    /// Share of the load on contacts older than the histories of the law, of unknown steady friction, 1.
    pub unsteady: f64,
}

impl SlipState {
    /// State of a surface under the prescribed pressure `asked` (Pa): the error of the law's load becomes one of the
    /// separation, and through the sensitivities of all other quantities.
    pub fn at_pressure(equilibrium: &EquilibriumState, asked: f64, plane: MeanPlane) -> Self {
        let state = &equilibrium.state;
        let (shift, sensitivity) = (equilibrium.separation_error(asked), &equilibrium.sensitivity);
        let mut mu = state.friction_coefficient();
        mu.error += shift * (sensitivity.friction_coefficient * mu.value).abs();
        let mut area_fraction = state.area_fraction.estimate();
        area_fraction.error += shift * (sensitivity.area_fraction * area_fraction.value).abs();
        let pressure = Estimate { value: asked, error: (state.pressure.value - asked).abs() };
        let displacement = plane.displacement(pressure);
        Self {
            mu,
            shear: Estimate { value: mu.value * asked, error: mu.error * asked },
            pressure,
            separation: Estimate { value: equilibrium.separation - displacement.value, error: shift },
            displacement,
            area_fraction,
            contact_density: Estimate {
                value: state.contact_density,
                error: shift * (sensitivity.contact_density * state.contact_density).abs(),
            },
            outside: state.outside,
            beyond: state.beyond,
            unsteady: unsteady(state),
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

    /// The state of a plane whose displacement is uncertain by `shift` (m), as the law's load is.
    pub fn with_displacement_error(mut self, shift: f64, sensitivity: &Sensitivity) -> Self {
        self.displacement.error += shift;
        for (quantity, slope) in [
            (&mut self.mu, sensitivity.friction_coefficient),
            (&mut self.shear, sensitivity.pressure + sensitivity.friction_coefficient),
            (&mut self.area_fraction, sensitivity.area_fraction),
            (&mut self.contact_density, sensitivity.contact_density),
        ] {
            quantity.error += shift * (slope * quantity.value).abs();
        }
        self
    }

    /// The same with unknown friction.
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
            unsteady: unsteady(state),
        }
    }
}

/// Share of [`Additional::UnsteadyLoad`](crate::integral::asperity_at_slip::Additional): sliding surfaces ask for no other
/// additional quantity.
fn unsteady(state: &ContactState) -> f64 {
    state.additional.map_or(0.0, |load| load.value / state.pressure.value)
}

/// Start of sliding of a whole surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inception {
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
/// slip, so that the slip is uncertain in proportion, too.
pub fn inception(slip: &[f64], mu: &[Estimate]) -> Inception {
    let mut found = inception_on(slip, mu);
    let coarse_slip: Vec<f64> = slip.iter().copied().step_by(2).collect();
    let coarse_mu: Vec<Estimate> = mu.iter().copied().step_by(2).collect();
    if coarse_slip.len() > 2 {
        let coarse = inception_on(&coarse_slip, &coarse_mu);
        found.mu.error += (found.mu.value - coarse.mu.value).abs();
        found.slip.error += (found.slip.value - coarse.slip.value).abs();
    }
    found
}

fn inception_on(slip: &[f64], mu: &[Estimate]) -> Inception {
    let slope = |i: usize| (mu[i + 1].value - mu[i].value) / (slip[i + 1] - slip[i]);
    let found = |slip: f64, mu: Estimate, reached: bool| {
        let share = if mu.value > 0.0 { mu.error / mu.value } else { 0.0 };
        Inception { slip: Estimate { value: slip, error: slip * share }, mu, reached }
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

/// Drop relative to the peak that is within the tolerance of the integrals.
const NO_DROP: f64 = 1e-5;

/// Energy released by weakening, ∫ (τ − τ_end) ds from the peak of the friction
/// stress τ (Pa) to the end of the slip (m), J per m² of nominal area.
///
/// Errors of τ at different slips come from the same asperities: only their change along the curve counts
/// fully, besides the same relative error of the whole. The error of the slip grid is the difference from
/// every second point.
pub fn weakening_energy(slip: &[f64], shear: &[Estimate]) -> Estimate {
    let Some(end) = shear.last() else {
        return Estimate::default();
    };
    let peak = shear.iter().map(|point| point.value).fold(end.value, f64::max);
    if peak - end.value <= NO_DROP * peak.abs() {
        return Estimate { value: 0.0, error: (peak - end.value) * (slip[slip.len() - 1] - slip[0]) };
    }
    let value = released(slip, shear, |point| point.value - end.value);
    let changed = released(slip, shear, |point| (point.error - end.error).abs());
    let relative = shear
        .iter()
        .map(|point| point.error / point.value.abs().max(f64::MIN_POSITIVE))
        .filter(|relative| relative.is_finite())
        .fold(0.0, |largest: f64, relative| largest.max(relative.min(1.0)));
    // The last point is included: the energy is relative to the end value.
    let kept = |i: &usize| i % 2 == (slip.len() - 1) % 2;
    let coarse_slip: Vec<f64> = (0..slip.len()).filter(kept).map(|i| slip[i]).collect();
    let coarse_shear: Vec<Estimate> = (0..slip.len()).filter(kept).map(|i| shear[i]).collect();
    let coarse = released(&coarse_slip, &coarse_shear, |point| point.value - end.value);
    Estimate::with_errors(value, [changed, relative * value, value - coarse])
}

/// Slip-weakening distance D_w = 2 ∫ (τ − τ_end) ds/(τ_peak − τ_end), m: over it a stress τ (Pa)
/// that weakens linearly from the same peak to the same end releases the same energy (Ida 1972,
/// doi 10.1029/JB077i020p03796). NaN where friction does not weaken.
pub fn weakening_distance(slip: &[f64], shear: &[Estimate]) -> Estimate {
    let unknown = Estimate::UNKNOWN;
    let Some(end) = shear.last() else {
        return unknown;
    };
    let highest = |one: &Estimate, other: &Estimate| one.value.total_cmp(&other.value);
    let Some(peak) = shear.iter().copied().max_by(highest) else {
        return unknown;
    };
    let drop = peak.value - end.value;
    if drop <= NO_DROP * peak.value.abs() {
        return unknown;
    }
    let energy = weakening_energy(slip, shear);
    let value = 2.0 * energy.value / drop;
    // The relative error that peak and end have in common is in the energy as well and cancels.
    let of_drop = (peak.error - end.error).abs() / drop;
    let common = peak.error / peak.value;
    let of_energy = (energy.error / energy.value.abs() - common).max(0.0);
    Estimate::with_errors(value, [value * of_energy, value * of_drop])
}

/// Trapezoidal integral from the peak of τ to the end.
fn released(slip: &[f64], shear: &[Estimate], height: impl Fn(&Estimate) -> f64) -> f64 {
    let mut peak = 0;
    for (index, point) in shear.iter().enumerate() {
        if point.value > shear[peak].value {
            peak = index;
        }
    }
    (peak + 1..slip.len())
        .map(|i| (slip[i] - slip[i - 1]) * 0.5 * (height(&shear[i]) + height(&shear[i - 1])))
        .sum()
}

/// Slips for the curve, m: zero, then geometric from 1e-4 of the smallest contact radius to four times the
/// largest. Asperities stop sticking after some thousandths of their contact radius; tables end after two.
pub fn slip_grid([smallest_radius, largest_radius]: [f64; 2], points: usize) -> Vec<f64> {
    let (from, to) = (1e-4 * smallest_radius, 4.0 * largest_radius);
    let steps = points.max(4) - 2;
    let mut grid = vec![0.0];
    grid.extend((0..=steps).map(|step| from * (to / from).powf(step as f64 / steps as f64)));
    grid
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(mu: impl Fn(f64) -> f64) -> (Vec<f64>, Vec<Estimate>) {
        let slip = slip_grid([1.0; 2], 97);
        let values = slip.iter().map(|&s| Estimate::exact(mu(s)));
        let values = values.collect();
        (slip, values)
    }

    #[test]
    fn a_saturating_curve_slides_where_its_slope_is_one_per_cent() {
        // μ = 0.4 (1 − e^{−s/l}): the slope is 1 % at s = l ln 100.
        let (slip, mu) = curve(|s| 0.4 * (1.0 - (-s / 0.01).exp()));
        let found = inception(&slip, &mu);
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
        let found = inception(&slip, &mu);
        assert!((found.mu.value / highest - 1.0).abs() < 2e-3);
    }

    #[test]
    fn a_rigid_curve_slides_at_once_and_a_rising_one_never() {
        let (slip, mu) = curve(|_| 0.5);
        assert_eq!(inception(&slip, &mu).slip.value, 0.0);
        assert_eq!(weakening_energy(&slip, &mu).value, 0.0);
        assert!(weakening_distance(&slip, &mu).value.is_nan());
        let (slip, mu) = curve(|s| s);
        let found = inception(&slip, &mu);
        assert!(!found.reached && found.mu.value == 4.0);
    }

    #[test]
    fn errors_of_a_negative_energy_are_positive() {
        // After the peak the stress falls below its end value for most of the slide: held separation.
        let (slip, _) = curve(|s| s);
        let stress = |s: f64| 1e6 * (if s < 0.01 { s / 0.01 } else { 0.5 + 0.1 * s });
        let shear: Vec<Estimate> =
            slip.iter().map(|&s| Estimate { value: stress(s), error: 0.1 * stress(s) }).collect();
        let (energy, distance) = (weakening_energy(&slip, &shear), weakening_distance(&slip, &shear));
        assert!(energy.value < 0.0 && energy.error > 0.1 * energy.value.abs(), "{energy:?}");
        assert!(distance.value < 0.0 && distance.error > 0.0, "{distance:?}");
    }

    #[test]
    fn exponential_weakening_releases_stress_drop_times_length() {
        let (slip, shear) = curve(|s| 1e6 + 2e6 * (-s / 0.1).exp());
        let energy = weakening_energy(&slip, &shear);
        // ∫_0^4 (τ − τ_end) ds with e^{−40} left; trapezoids on 12 % steps have an error of 1e-3.
        assert!((energy.value / 2e5 - 1.0).abs() < 5e-3, "{}", energy.value);
        assert!((energy.value - 2e5).abs() <= energy.error);
        // D_w = 2 L for a drop that is exponential over L.
        let distance = weakening_distance(&slip, &shear);
        assert!((distance.value / 0.2 - 1.0).abs() < 5e-3, "{}", distance.value);
        assert!((distance.value - 0.2).abs() <= distance.error);
    }
}
