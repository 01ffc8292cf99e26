//! How sliding friction changes with the slip rate.

use tables::law::Estimate;

/// Share of the change of slope between neighbouring intervals that covers the error of the parabolas for the forms
/// μ₀/(1 + √(V/V*)) and μ₀/(1 + V/V*), V* from 0.3 to 100 m/s, on the slip rates of the shipped tables.
const SHARE_OF_BEND: f64 = 0.2;
/// Mean width of two intervals of ln V up to which that holds.
const WIDTH: f64 = 1.2;
/// On wider intervals the curve may bend both ways between three rates: the share of the change grows with the square of the
/// width, and the excess of the width times this share of the slope is added. Covers the same forms on rates a factor of 10
/// to 40 apart.
const SHARE_OF_SLOPE: f64 = 0.25;

/// dμ/d ln V at a slip rate `at`, from the sliding friction `all` at ascending `slip_rates` around it (m/s); between
/// two of them the blend of the slopes of the parabolas through these and the one before or after. Unknown at V = 0, and
/// with a single positive rate.
///
/// Below the first positive rate V₁ friction changes in proportion to V, as the heat of slow contacts does, from μ(0) where
/// that is known: dμ/d ln V is μ(V₁) − μ(0) at V₁, and the parabola with this slope there takes the place of the one before.
/// The error is the difference of both parabolas and
/// a fifth of the largest change of slope from this interval to the next ones (more where they are wide), twice that at the
/// ends; and the difference of the errors of μ over the interval: errors of neighbouring rates come from the same asperities
/// and have the same sign, except for a part that is 0.03 to 0.5 of them in shipped tables (the residuals of a polynomial of the
/// fourth degree in ln V) and not in the error. With two positive rates it is twice the difference of the slope from rest and that
/// between them, more where they are far apart.
pub fn rate_sensitivity(slip_rates: &[f64], all: &[Estimate], at: f64) -> Estimate {
    let first = slip_rates.iter().take_while(|rate| **rate <= 0.0).count();
    let (rates, mu) = (&slip_rates[first..], &all[first..]);
    let from_rest = first.checked_sub(1).filter(|rest| all[*rest].value.is_finite() && !mu.is_empty());
    let from_rest = from_rest.map(|rest| mu[0].value - all[rest].value);
    if at <= 0.0 || rates.len() < 2 {
        return Estimate::UNKNOWN;
    }
    if at < rates[0] {
        let Estimate { value, error } = rate_sensitivity(slip_rates, all, rates[0]);
        let share = at / rates[0];
        // Up to that of heat in proportion to √V.
        return Estimate {
            value: share * value,
            error: share * error + (share.sqrt() - share) * value.abs(),
        };
    }
    let x: Vec<f64> = rates.iter().map(|rate| rate.ln()).collect();
    let inner = rates.partition_point(|rate| *rate <= at).clamp(1, rates.len() - 1) - 1;
    let secant = |i: usize| (mu[i + 1].value - mu[i].value) / (x[i + 1] - x[i]);
    let x_at = at.ln();
    // Through i, i + 1 and i + 2, in Newton's form.
    let parabola = |i: usize| {
        let curvature = (secant(i + 1) - secant(i)) / (x[i + 2] - x[i]);
        secant(i) + curvature * (2.0 * x_at - x[i] - x[i + 1])
    };
    // Through the first two rates, with the slope from rest at the first.
    let beside_rest = |slope: f64| slope + 2.0 * (secant(0) - slope) * (x_at - x[0]) / (x[1] - x[0]);
    let before = inner.checked_sub(1).map(parabola).or(from_rest.map(beside_rest));
    let after = (inner + 2 < rates.len()).then(|| parabola(inner));
    let width = |from: usize, to: usize| ((x[to] - x[from]) / ((to - from) as f64 * WIDTH)).max(1.0);
    let uncertain = |i: usize| {
        let wide = width(i, i + 2);
        let [one, other] = [secant(i), secant(i + 1)];
        SHARE_OF_BEND * wide * wide * (other - one).abs()
            + SHARE_OF_SLOPE * (wide - 1.0) * one.abs().max(other.abs())
    };
    let bends = [inner.checked_sub(1).map(uncertain), after.map(|_| uncertain(inner))];
    let bend = bends.into_iter().flatten().fold(0.0, f64::max);
    let t = ((x_at - x[inner]) / (x[inner + 1] - x[inner])).clamp(0.0, 1.0);
    let (value, of_interval) = match (before, after) {
        (Some(before), Some(after)) => (before + t * (after - before), (after - before).abs() + bend),
        (Some(before), None) if inner == 0 => (
            before,
            from_rest.map_or(f64::NAN, |slope| 2.0 * width(0, 1).powi(2) * (slope - secant(0)).abs()),
        ),
        (Some(only), None) | (None, Some(only)) => {
            // Beside a knee the parabola rises at one end by more than friction falls in the interval: its error reaches that slope.
            let secant = secant(inner);
            let rises = only * secant < 0.0 && only.abs() > secant.abs();
            let beyond = if rises { (only - secant).abs() } else { 0.0 };
            (only, (2.0 * bend).max(beyond))
        }
        (None, None) => (secant(inner), f64::NAN),
    };
    let of_mu = (mu[inner + 1].error - mu[inner].error).abs() / (x[inner + 1] - x[inner]);
    Estimate { value, error: of_interval + of_mu }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RATES: [f64; 5] = [0.0, 0.1, 0.3, 1.0, 5.0];

    fn of(mu: impl Fn(f64) -> f64) -> Vec<Estimate> {
        RATES.iter().map(|v| Estimate { value: mu(*v), error: 0.01 }).collect()
    }

    #[test]
    fn a_parabola_in_the_logarithm_is_exact() {
        let mu = of(|v| 0.5 - 0.02 * v.max(0.1).ln() + 0.01 * v.max(0.1).ln().powi(2));
        assert!(rate_sensitivity(&RATES, &mu, 0.0).value.is_nan());
        for rate in [0.1, 0.2, 0.3, 0.7, 1.0, 4.0, 5.0] {
            let found = rate_sensitivity(&RATES[1..], &mu[1..], rate);
            let exact = -0.02 + 0.02 * f64::ln(rate);
            assert!((found.value - exact).abs() < 1e-13, "{rate}: {found:?}");
        }
    }

    /// Friction of transient heating, μ₀/(1 + √(V/V*)), and of heating in proportion to the slip rate: at places between the
    /// first and the last of `rates` what is found, with the exact value.
    fn heated<const N: usize>(rates: [f64; N], scales: [f64; 3]) -> Vec<(Estimate, f64)> {
        let mut compared = Vec::new();
        for (exponent, scale) in
            [0.5, 1.0].into_iter().flat_map(|exponent| scales.map(|scale| (exponent, scale)))
        {
            let heat = |v: f64| (v / scale).powf(exponent);
            let mu = rates.map(|v| Estimate::exact(0.5 / (1.0 + heat(v))));
            for n in 0..=40 {
                let rate = rates[0] * (rates[N - 1] / rates[0]).powf(f64::from(n) / 40.0);
                let exact = -0.5 * exponent * heat(rate) / (1.0 + heat(rate)).powi(2);
                let found = rate_sensitivity(&rates, &mu, rate);
                assert!(
                    (found.value - exact).abs() <= found.error,
                    "{exponent} {scale} {rate}: {found:?} {exact}"
                );
                compared.push((found, exact));
            }
        }
        compared
    }

    /// On the rates of a table, and on rates a factor of 10 to 40 apart, where a parabola hardly describes them.
    #[test]
    fn the_error_covers_smooth_curves_and_sparse_rates() {
        for (found, exact) in heated([0.03, 0.12, 0.3, 0.7, 1.6, 3.0, 5.5, 10.0], [0.3, 3.0, 30.0]) {
            assert!(found.error < 0.5 * exact.abs() + 0.005, "{found:?} {exact}");
        }
        for factor in [10.0, 30.0, 40.0] {
            heated([0, 1, 2].map(|n| 0.1 * f64::powi(factor, n)), [3.0, 30.0, 300.0]);
        }
    }

    /// Friction that falls beyond a knee only: a parabola rises at the first rate.
    #[test]
    fn the_error_has_the_sign_of_the_interval_beside_a_knee() {
        let mu = |v: f64| 0.84 - 1e-3 * v.ln() - 0.12 * (v / 30.0).ln().max(0.0).powi(2);
        let rates = [10.0, 30.0, 100.0];
        let found = rate_sensitivity(&rates, &rates.map(|v| Estimate::exact(mu(v))), 10.0);
        let covered = (found.value + 1e-3).abs() <= found.error * (1.0 + 1e-12);
        assert!(found.value > 0.02 && covered, "{found:?}");
    }

    /// Below the first rate of a table friction changes in proportion to the slip rate, from that at rest where the table has it.
    #[test]
    fn below_the_first_rate_the_slope_falls_with_the_rate() {
        let mu = of(|v| 0.5 - 0.01 * v);
        let slope = |rate: f64, from: usize| rate_sensitivity(&RATES[from..], &mu[from..], rate);
        for from in [0, 1] {
            let (first, half) = (slope(0.1, from), slope(0.05, from));
            assert_eq!(half.value, 0.5 * first.value);
            assert!((half.value + 0.01 * 0.05).abs() <= half.error, "{half:?}");
        }
        let at_first = slope(0.1, 0);
        assert!((at_first.value + 0.01 * 0.1).abs() < 1e-15 && at_first.error < 0.3 * 0.01, "{at_first:?}");
        // Up to the second rate it passes over into the parabola.
        assert!((slope(0.3 - 1e-9, 0).value / slope(0.3, 1).value - 1.0).abs() < 1e-6);
    }

    /// Heat that grows with the root of the slip rate: half of what a straight line from rest says.
    #[test]
    fn the_slope_from_rest_is_as_uncertain_as_it_differs_from_the_parabola() {
        let mu = of(|v| 0.5 - 0.01 * v.sqrt());
        for count in [3, 5] {
            for rate in [1e-3, 0.03, 0.1, 0.2] {
                let found = rate_sensitivity(&RATES[..count], &mu[..count], rate);
                let exact = -0.005 * rate.sqrt();
                assert!((found.value - exact).abs() <= found.error, "{count} {rate}: {found:?} {exact}");
            }
        }
        // Two rates far apart; friction at rest may be unknown.
        for last in [1.0, 10.0] {
            let rates = [0.0, 0.1, last];
            let mu = rates.map(|v: f64| Estimate::exact(0.5 / (1.0 + (v / 30.0).sqrt())));
            for rate in [0.1, 0.3, last] {
                let found = rate_sensitivity(&rates, &mu, rate);
                let root = (rate / 30.0).sqrt();
                let exact = -0.25 * root / (1.0 + root).powi(2);
                assert!((found.value - exact).abs() <= found.error, "{last} {rate}: {found:?} {exact}");
            }
        }
        let unknown: Vec<Estimate> = [&[Estimate::UNKNOWN], &mu[1..]].concat();
        let [found, without] = [(&RATES[..], &unknown[..]), (&RATES[1..], &mu[1..])]
            .map(|(rates, mu)| rate_sensitivity(rates, mu, 0.2));
        assert_eq!(found, without);
    }

    #[test]
    fn one_positive_rate_has_no_slope() {
        let mu = [Estimate::exact(0.5); 2];
        assert!(rate_sensitivity(&[0.0, 1.0], &mu, 1.0).value.is_nan());
        let two = rate_sensitivity(&[1.0, 2.0], &mu, 1.0);
        assert!(two.value == 0.0 && two.error.is_nan());
    }
}
