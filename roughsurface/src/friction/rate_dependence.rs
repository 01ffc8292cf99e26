//! How sliding friction changes with the slip rate.

use tables::law::Estimate;

/// dμ/d ln V at each of the ascending `slip_rates` (m/s): the slope of the parabola through a rate
/// and its neighbours, of the straight line at the ends. NaN at V = 0, and where there is no
/// second positive rate.
///
/// The error is half the difference between the slopes to both sides, at the ends the curvature
/// of the adjacent interval, and the difference of the errors of μ over the interval: errors of
/// neighbouring rates come from the same asperities and have the same sign.
pub fn rate_sensitivity(slip_rates: &[f64], mu: &[Estimate]) -> Vec<Estimate> {
    let unknown = Estimate::UNKNOWN;
    let first = slip_rates.iter().take_while(|rate| **rate <= 0.0).count();
    let slope = |i: usize| {
        let interval = (slip_rates[i + 1] / slip_rates[i]).ln();
        let value = (mu[i + 1].value - mu[i].value) / interval;
        let error = (mu[i + 1].error - mu[i].error).abs() / interval;
        (interval, Estimate { value, error })
    };
    let last = slip_rates.len().saturating_sub(1);
    (0..slip_rates.len())
        .map(|i| {
            if i < first || first >= last {
                return unknown;
            }
            if i == first || i == last {
                let inner = if i == first { i } else { i - 1 };
                let (interval, mut end) = slope(inner);
                // The curvature of the neighbouring intervals, over half of this one.
                let next = if i == first { inner + 1 } else { inner.wrapping_sub(1) };
                if (first..last).contains(&next) {
                    let (wide, beside) = slope(next);
                    let change = (end.value - beside.value).abs();
                    end.error += change * interval / (interval + wide);
                } else {
                    end.error = f64::NAN;
                }
                return end;
            }
            let ((before, left), (after, right)) = (slope(i - 1), slope(i));
            let share = before / (before + after);
            Estimate {
                value: left.value + share * (right.value - left.value),
                error: 0.5 * (right.value - left.value).abs() + left.error.max(right.error),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_in_the_logarithm_is_exact_inside_and_within_the_error_at_the_ends() {
        let rates = [0.0, 0.1, 0.3, 1.0, 5.0];
        let mu: Vec<Estimate> = (rates.iter())
            .map(|v: &f64| Estimate { value: 0.5 - 0.02 * v.ln() + 0.01 * v.ln().powi(2), error: 0.01 })
            .collect();
        let found = rate_sensitivity(&rates, &mu);
        assert!(found[0].value.is_nan());
        for (i, &rate) in rates.iter().enumerate().skip(1) {
            let exact = -0.02 + 0.02 * rate.ln();
            let off = (found[i].value - exact).abs();
            assert!(off <= found[i].error * (1.0 + 1e-9), "{rate}: {off} ±{}", found[i].error);
            if (2..4).contains(&i) {
                assert!(off < 1e-14, "{rate}: {off}");
            }
        }
    }

    #[test]
    fn one_positive_rate_has_no_slope() {
        let mu = [Estimate::exact(0.5); 2];
        assert!(rate_sensitivity(&[0.0, 1.0], &mu).iter().all(|slope| slope.value.is_nan()));
        let two = rate_sensitivity(&[1.0, 2.0], &mu);
        assert!(two[0].value == 0.0 && two[1].value == 0.0);
    }
}
