//! Weakening of friction along the slide: its energy, and the slip that it takes.

use tables::law::Estimate;

/// Drop relative to the peak that is within the tolerance of the integrals.
const NO_DROP: f64 = 1e-5;

/// Weakening of friction after its peak.
struct Weakening {
    /// Peak and end of the friction coefficient.
    peak: Estimate,
    end: Estimate,
    /// ∫ (μ − μ_end) ds from the peak to the end, m.
    released: Estimate,
}

/// Weakening of a curve; none without a peak above the end, and where friction between them is lower than at the end in the mean.
///
/// Errors of μ at different slips come from the same asperities: only their change along the curve counts
/// fully, besides the same relative error of the whole. The error of the slip grid is the difference from
/// every second point.
fn weakening(slip: &[f64], mu: &[Estimate]) -> Option<Weakening> {
    let end = *mu.last()?;
    let peak = *mu.iter().rev().max_by(|one, other| one.value.total_cmp(&other.value))?;
    let value = released(slip, mu, |point| point.value - end.value);
    // Unknown friction does not compare.
    let weakens = peak.value - end.value > NO_DROP * peak.value && value > 0.0;
    if !weakens {
        return None;
    }
    let changed = released(slip, mu, |point| (point.error - end.error).abs());
    let relative = mu
        .iter()
        .map(|point| point.error / point.value.abs().max(f64::MIN_POSITIVE))
        .filter(|relative| relative.is_finite())
        .fold(0.0, |largest: f64, relative| largest.max(relative.min(1.0)));
    // The last point is included: the energy is relative to the end value.
    let kept = |i: &usize| i % 2 == (slip.len() - 1) % 2;
    let coarse_slip: Vec<f64> = (0..slip.len()).filter(kept).map(|i| slip[i]).collect();
    let coarse_mu: Vec<Estimate> = (0..slip.len()).filter(kept).map(|i| mu[i]).collect();
    let coarse = released(&coarse_slip, &coarse_mu, |point| point.value - end.value);
    let released = Estimate::with_errors(value, [changed, relative * value, value - coarse]);
    Some(Weakening { peak, end, released })
}

/// Energy of weakening, p ∫ (μ − μ_end) ds from the peak of the friction coefficient μ to the end of the slip (m), J per m² of
/// nominal area under the `pressure` p (Pa) before the slide. At held load p μ is the friction stress; at held separation
/// that grows with the load, as heat expands the asperities, without strengthening. Unknown where friction does not weaken.
pub fn weakening_energy(slip: &[f64], mu: &[Estimate], pressure: Estimate) -> Estimate {
    weakening(slip, mu).map_or(Estimate::UNKNOWN, |Weakening { released, .. }| pressure.times(released))
}

/// Slip-weakening distance D_w = 2 ∫ (μ − μ_end) ds/(μ_peak − μ_end), m: over it a friction coefficient μ
/// that weakens linearly from the same peak to the same end releases the same energy (Ida 1972,
/// doi 10.1029/JB077i020p03796). Unknown where friction does not weaken.
pub fn weakening_distance(slip: &[f64], mu: &[Estimate]) -> Estimate {
    weakening(slip, mu).map_or(Estimate::UNKNOWN, |Weakening { peak, end, released }| {
        let drop = peak.value - end.value;
        let value = 2.0 * released.value / drop;
        // The relative error that peak and end have in common is in the energy as well and cancels.
        let of_drop = (peak.error - end.error).abs() / drop;
        let common = peak.error / peak.value;
        let of_energy = (released.error / released.value - common).max(0.0);
        Estimate::with_errors(value, [value * of_energy, value * of_drop])
    })
}

/// Trapezoidal integral from the peak of μ to the end.
fn released(slip: &[f64], mu: &[Estimate], height: impl Fn(&Estimate) -> f64) -> f64 {
    let mut peak = 0;
    for (index, point) in mu.iter().enumerate() {
        if point.value > mu[peak].value {
            peak = index;
        }
    }
    (peak + 1..slip.len())
        .map(|i| (slip[i] - slip[i - 1]) * 0.5 * (height(&mu[i]) + height(&mu[i - 1])))
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::friction::slip_curve::tests::curve;

    const PRESSURE: Estimate = Estimate { value: 1e7, error: 0.0 };

    /// The first is lower on its way to the end than there, after a peak above it.
    #[test]
    fn friction_that_does_not_fall_to_its_end_releases_no_energy() {
        let lower: fn(f64) -> f64 = |s| if s < 0.01 { s / 0.02 } else { 0.3 + 0.04 * s };
        for friction in [lower, |_| 0.5] {
            let (slip, mu) = curve(friction);
            assert!(weakening_energy(&slip, &mu, PRESSURE).value.is_nan());
            assert!(weakening_distance(&slip, &mu).value.is_nan());
        }
    }

    #[test]
    fn exponential_weakening_releases_stress_drop_times_length() {
        let (slip, mu) = curve(|s| 0.1 + 0.2 * (-s / 0.1).exp());
        let energy = weakening_energy(&slip, &mu, PRESSURE);
        // p ∫_0^4 (μ − μ_end) ds with e^{−40} left; trapezoids on 12 % steps have an error of 1e-3.
        assert!((energy.value / 2e5 - 1.0).abs() < 5e-3, "{}", energy.value);
        assert!((energy.value - 2e5).abs() <= energy.error);
        // D_w = 2 L for a drop that is exponential over L.
        let distance = weakening_distance(&slip, &mu);
        assert!((distance.value / 0.2 - 1.0).abs() < 5e-3, "{}", distance.value);
        assert!((distance.value - 0.2).abs() <= distance.error);
        // A pressure known to 3 % adds as much to the energy.
        let uncertain = weakening_energy(&slip, &mu, Estimate { error: 0.03 * PRESSURE.value, ..PRESSURE });
        assert!(((uncertain.error - energy.error) / energy.value - 0.03).abs() < 1e-12);
    }
}
