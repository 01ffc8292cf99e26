//! Student's t of 95 % confidence and prediction intervals.

/// Probability outside a confidence or prediction interval.
pub(crate) const PROBABILITY_OUTSIDE: f64 = 0.05;

/// Student's t that is exceeded in magnitude with a probability of 5 %: I_x(ν/2, 1/2) = 0.05 at x = ν/(ν + t²), I the
/// regularised incomplete beta function (Abramowitz & Stegun, Handbook of Mathematical Functions, 26.7.1). NaN below one
/// degree of freedom ν.
pub(crate) fn student_t(degrees_of_freedom: f64) -> f64 {
    if degrees_of_freedom < 1.0 {
        return f64::NAN;
    }
    let x = puruspe::invbetai(PROBABILITY_OUTSIDE, 0.5 * degrees_of_freedom, 0.5);
    (degrees_of_freedom * (1.0 - x) / x).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn students_t_as_tabulated() {
        // Abramowitz & Stegun, table 26.10.
        for (freedom, t) in
            [(1.0, 12.706), (2.0, 4.303), (4.0, 2.776), (9.0, 2.262), (30.0, 2.042), (120.0, 1.980)]
        {
            assert!((student_t(freedom) - t).abs() < 6e-4, "{freedom}: {}", student_t(freedom));
        }
        assert!((student_t(1e5) - 1.95999).abs() < 1e-4);
    }
}
