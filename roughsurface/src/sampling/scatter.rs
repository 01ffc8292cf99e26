//! Mean and scatter over surfaces drawn at random.

/// Mean and scatter of a quantity over the surfaces drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Scatter {
    pub mean: f64,
    /// Half width of the 95 % confidence interval of the mean.
    pub mean_error: f64,
    pub standard_deviation: f64,
    /// 2.5 and 97.5 % quantiles: where 95 % of the surfaces lie.
    pub lower: f64,
    pub upper: f64,
}

/// Half width of a 95 % interval in standard deviations, for many draws.
const NORMAL_95: f64 = 1.959_963_984_540_054;

impl Scatter {
    /// Of the values that are numbers; NaN throughout if there are none.
    pub fn of(values: impl Iterator<Item = f64>) -> Self {
        let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
        values.sort_by(f64::total_cmp);
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        let standard_deviation = (squares / (count - 1.0)).sqrt();
        let quantile = |share: f64| {
            let Some(last) = values.len().checked_sub(1) else {
                return f64::NAN;
            };
            let place = share * last as f64;
            let below = place.floor() as usize;
            let next = values[(below + 1).min(last)];
            values[below] + (place - below as f64) * (next - values[below])
        };
        Self {
            mean,
            mean_error: NORMAL_95 * standard_deviation / count.sqrt(),
            standard_deviation,
            lower: quantile(0.025),
            upper: quantile(0.975),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scatter_of_known_values() {
        let scatter = Scatter::of((0..=100).map(f64::from).chain([f64::NAN]));
        assert_eq!((scatter.mean, scatter.lower, scatter.upper), (50.0, 2.5, 97.5));
        // n = 101 consecutive numbers: variance n(n+1)/12.
        assert!((scatter.standard_deviation - (101.0f64 * 102.0 / 12.0).sqrt()).abs() < 1e-12);
        assert!(Scatter::of(std::iter::empty()).mean.is_nan());
    }
}
