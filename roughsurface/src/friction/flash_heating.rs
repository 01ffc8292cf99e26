//! Flash-heating parameters of a friction–velocity curve.
//!
//! Smooth form used by rupture codes,
//! μ = μ_w + (μ_0 − μ_w)/[1 + (V/V_w)^8]^{1/8}:
//! μ_0 below the weakening velocity V_w, (μ_0 − μ_w) V_w/V + μ_w above it
//! (Rice 2006, doi 10.1029/2005JB004006; Beeler et al. 2008, doi 10.1029/2007JB004988).

use nalgebra::DMatrix;
use tables::law::Estimate;

/// Fitted parameters.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct FlashHeating {
    /// Friction coefficient at low slip rate, 1.
    pub mu_0: Estimate,
    /// Friction coefficient of fully weakened contacts, 1.
    pub mu_w: Estimate,
    /// Slip rate at which weakening starts, m/s.
    pub v_w: Estimate,
    /// Root mean square misfit, 1.
    pub misfit: f64,
    /// R², share of the variance of μ over the slip rates that the fit explains, 1.
    pub r_squared: f64,
}

impl FlashHeating {
    /// Fitted friction coefficient at `slip_rate` (m/s).
    pub fn friction_coefficient(&self, slip_rate: f64) -> f64 {
        self.mu_w.value + (self.mu_0.value - self.mu_w.value) * remaining(slip_rate, self.v_w.value)
    }
}

/// Reason of a failed fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoFit {
    #[error("at least three slip rates above zero are needed")]
    TooFewSlipRates,
    #[error("the friction coefficient is not known")]
    NoFriction,
    #[error("friction does not depend on the slip rate")]
    NoRateDependence,
    #[error("the slip rates do not bracket the onset of weakening")]
    OnsetOutside,
}

/// Sharpness of the corner at V_w.
const SHARPNESS: f64 = 8.0;

/// Share of μ_0 − μ_w that remains at `slip_rate`.
fn remaining(slip_rate: f64, v_w: f64) -> f64 {
    (1.0 + (slip_rate / v_w).powf(SHARPNESS)).powf(-1.0 / SHARPNESS)
}

/// d(remaining)/d(V_w), s/m.
fn remaining_slope(slip_rate: f64, v_w: f64) -> f64 {
    let power = (slip_rate / v_w).powf(SHARPNESS);
    (1.0 + power).powf(-1.0 / SHARPNESS - 1.0) * power / v_w
}

/// Least-squares μ_0, μ_w at fixed V_w, with the sum of squared misfits.
fn linear_fit(slip_rates: &[f64], mu: &[Estimate], v_w: f64) -> (f64, f64, f64) {
    let count = mu.len() as f64;
    let shares: Vec<f64> = slip_rates.iter().map(|&v| remaining(v, v_w)).collect();
    let mean_share = shares.iter().sum::<f64>() / count;
    let mean_mu = mu.iter().map(|m| m.value).sum::<f64>() / count;
    let (mut cross, mut square) = (0.0, 0.0);
    for (share, m) in shares.iter().zip(mu) {
        cross += (share - mean_share) * (m.value - mean_mu);
        square += (share - mean_share).powi(2);
    }
    let drop = if square > 0.0 { cross / square } else { 0.0 };
    let mu_w = mean_mu - drop * mean_share;
    let misfit = shares.iter().zip(mu).map(|(share, m)| (mu_w + drop * share - m.value).powi(2)).sum();
    (mu_w + drop, mu_w, misfit)
}

/// Fits friction coefficients `mu` at `slip_rates` (m/s).
///
/// The problem is linear but for V_w, which is searched between the slowest rate
/// and the last but one: with fewer than two points beyond it, V_w and μ_w are
/// not independent. Errors add the scatter about the fit to the errors of `mu`, the
/// latter with the signs of the largest effect.
///
/// ```
/// use roughsurface::friction::flash_heating::fit;
/// use tables::law::Estimate;
///
/// let rates = [0.01, 0.1, 0.3, 1.0, 3.0, 10.0];
/// // μ = μ_w + (μ_0 − μ_w) V_w/V beyond V_w = 0.3 m/s.
/// let mu = rates.map(|rate| if rate > 0.3 { 0.2 + 0.4 * 0.3 / rate } else { 0.6 });
/// let found = fit(&rates, &mu.map(|value| Estimate { value, error: 0.0 }))?;
/// // Between the points that were given.
/// assert!((found.friction_coefficient(2.0) - 0.26).abs() < 0.02, "{}", found.friction_coefficient(2.0));
/// # Ok::<(), roughsurface::friction::flash_heating::NoFit>(())
/// ```
pub fn fit(slip_rates: &[f64], mu: &[Estimate]) -> Result<FlashHeating, NoFit> {
    // The isothermal limit V = 0 is outside the law of flash heating.
    let pairs = slip_rates.iter().copied().zip(mu.iter().copied());
    let mut points: Vec<(f64, Estimate)> = pairs.filter(|(rate, _)| *rate > 0.0).collect();
    points.sort_by(|one, other| one.0.total_cmp(&other.0));
    points.dedup_by(|next, kept| next.0 == kept.0);
    if points.len() < 3 {
        return Err(NoFit::TooFewSlipRates);
    }
    let (rates, mu): (Vec<f64>, Vec<Estimate>) = points.into_iter().unzip();
    let values = || mu.iter().map(|m| m.value);
    if values().any(f64::is_nan) {
        return Err(NoFit::NoFriction);
    }
    let (lowest, highest) =
        (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
    // Below the tolerance of the integrals.
    if highest - lowest <= 1e-6 * highest.abs() {
        return Err(NoFit::NoRateDependence);
    }

    let (slowest, fastest) = (rates[0].ln(), rates[rates.len() - 2].ln());
    let misfit_at = |ln_v: f64| linear_fit(&rates, &mu, ln_v.exp()).2;
    let scan = 400;
    let place = |i: usize| slowest + (fastest - slowest) * i as f64 / scan as f64;
    let best = (0..=scan)
        .min_by(|&i, &j| misfit_at(place(i)).total_cmp(&misfit_at(place(j))))
        .expect("the scan is not empty");
    if best == 0 || best == scan {
        return Err(NoFit::OnsetOutside);
    }
    let ln_v = golden_section(misfit_at, place(best - 1), place(best + 1));
    let v_w = ln_v.exp();
    let (mu_0, mu_w, squares) = linear_fit(&rates, &mu, v_w);
    let errors = parameter_errors(&rates, &mu, mu_0 - mu_w, v_w, squares).ok_or(NoFit::OnsetOutside)?;
    let estimate = |value: f64, error: f64| Estimate { value, error };
    let mean = values().sum::<f64>() / mu.len() as f64;
    let variance: f64 = values().map(|value| (value - mean).powi(2)).sum();
    Ok(FlashHeating {
        mu_0: estimate(mu_0, errors[0]),
        mu_w: estimate(mu_w, errors[1]),
        v_w: estimate(v_w, errors[2]),
        misfit: (squares / mu.len() as f64).sqrt(),
        r_squared: 1.0 - squares / variance,
    })
}

fn golden_section(function: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let ratio = 0.5 * (5f64.sqrt() - 1.0);
    for _ in 0..60 {
        let (first, second) = (high - ratio * (high - low), low + ratio * (high - low));
        if function(first) <= function(second) {
            high = second;
        } else {
            low = first;
        }
    }
    0.5 * (low + high)
}

/// Standard errors of (μ_0, μ_w, V_w) from the misfit, plus the errors of μ.
fn parameter_errors(rates: &[f64], mu: &[Estimate], drop: f64, v_w: f64, squares: f64) -> Option<[f64; 3]> {
    // V_w in units of itself keeps the normal equations well scaled.
    let rows: Vec<[f64; 3]> = rates
        .iter()
        .map(|&rate| {
            let share = remaining(rate, v_w);
            [share, 1.0 - share, drop * remaining_slope(rate, v_w) * v_w]
        })
        .collect();
    let jacobian = DMatrix::from_fn(rows.len(), 3, |row, column| rows[row][column]);
    let normal = jacobian.tr_mul(&jacobian);
    let scale: f64 = normal.diagonal().iter().product();
    if normal.determinant() <= 1e-13 * scale {
        return None;
    }
    let inverse = normal.try_inverse()?;
    let freedom = rates.len() as f64 - 3.0;
    let variance = if freedom > 0.0 { squares / freedom } else { 0.0 };
    let scales = [1.0, 1.0, v_w];
    Some(std::array::from_fn(|i| {
        let scatter = (variance * inverse[(i, i)].max(0.0)).sqrt();
        let inherited: f64 = rows
            .iter()
            .zip(mu)
            .map(|(row, m)| {
                let gain: f64 = (0..3).map(|j| inverse[(i, j)] * row[j]).sum();
                gain.abs() * m.error
            })
            .sum();
        scales[i] * (scatter + inherited)
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(rates: &[f64], error: f64) -> Vec<Estimate> {
        rates.iter().map(|&rate| Estimate { value: 0.15 + 0.45 * remaining(rate, 0.2), error }).collect()
    }

    #[test]
    fn parameters_come_back_from_their_curve() {
        let rates = [0.01, 0.03, 0.1, 0.3, 1.0, 3.0];
        let fitted = fit(&rates, &curve(&rates, 0.0)).unwrap();
        assert!((fitted.mu_0.value - 0.6).abs() < 1e-6);
        assert!((fitted.mu_w.value - 0.15).abs() < 1e-6);
        assert!((fitted.v_w.value - 0.2).abs() < 1e-6);
        // The search ends at the rounding of the squares, 1e-8 in the parameters.
        assert!(fitted.v_w.error < 1e-6 && fitted.misfit < 1e-7);
        assert!((fitted.r_squared - 1.0).abs() < 1e-12);
        assert!((fitted.friction_coefficient(0.2) - (0.15 + 0.45 * 2f64.powf(-0.125))).abs() < 1e-6);
        // Three rates determine three parameters.
        let rates = [0.01, 0.3, 3.0];
        let fitted = fit(&rates, &curve(&rates, 0.0)).unwrap();
        assert!((fitted.v_w.value - 0.2).abs() < 1e-6);
    }

    #[test]
    fn errors_of_the_curve_become_errors_of_the_parameters() {
        let rates = [0.01, 0.03, 0.1, 0.3, 1.0, 3.0];
        let fitted = fit(&rates, &curve(&rates, 0.01)).unwrap();
        let shifted: Vec<Estimate> = curve(&rates, 0.0)
            .iter()
            .enumerate()
            .map(|(i, m)| Estimate { value: m.value + if i % 2 == 0 { 0.01 } else { -0.01 }, error: 0.0 })
            .collect();
        let other = fit(&rates, &shifted).unwrap();
        // Errors of first order: allow half as much again.
        for (one, two) in [(fitted.mu_0, other.mu_0), (fitted.mu_w, other.mu_w), (fitted.v_w, other.v_w)] {
            assert!((one.value - two.value).abs() < 1.5 * one.error, "{one:?} {two:?}");
            assert!(two.error > 0.0);
        }
        // Misfit and variance by hand from the fitted curve.
        let mean = shifted.iter().map(|m| m.value).sum::<f64>() / 6.0;
        let of = |points: &dyn Fn(usize) -> f64| -> f64 { (0..6).map(|i| points(i).powi(2)).sum() };
        let left = of(&|i| shifted[i].value - other.friction_coefficient(rates[i]));
        let all = of(&|i| shifted[i].value - mean);
        assert!((other.r_squared - (1.0 - left / all)).abs() < 1e-12 && other.r_squared < 0.999);
        assert!((other.misfit - (left / 6.0).sqrt()).abs() < 1e-12);
    }

    #[test]
    fn curves_without_an_onset_are_not_fitted() {
        let rates = [0.01, 0.1, 1.0];
        let flat = [Estimate { value: 0.5, error: 0.0 }; 3];
        assert_eq!(fit(&rates, &flat), Err(NoFit::NoRateDependence));
        assert_eq!(fit(&rates[..2], &flat[..2]), Err(NoFit::TooFewSlipRates));
        let beyond = [1.0, 2.0, 4.0, 8.0];
        assert_eq!(fit(&beyond, &curve(&beyond, 0.0)), Err(NoFit::OnsetOutside));
    }

    #[test]
    fn the_slope_is_the_derivative() {
        for rate in [0.05, 0.2, 0.9] {
            let step = 1e-6;
            let difference = (remaining(rate, 0.2 + step) - remaining(rate, 0.2 - step)) / (2.0 * step);
            // Central differences of values with 16 digits: ten are left.
            assert!((difference - remaining_slope(rate, 0.2)).abs() < 1e-8);
        }
    }
}
