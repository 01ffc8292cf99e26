//! Mean and scatter over surfaces drawn at random.

use crate::friction::confidence::{PROBABILITY_OUTSIDE, student_t};

/// Mean and scatter of a quantity over the surfaces drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Scatter {
    pub mean: f64,
    /// Half width of the 95 % confidence interval of the mean, by Student's t.
    pub mean_error: f64,
    pub standard_deviation: f64,
    /// Ends of the 95 % prediction interval: where one more surface lies with that probability.
    pub lower: f64,
    pub upper: f64,
}

impl Scatter {
    /// Mean and scatter of the values that are numbers; NaN throughout if there are none.
    ///
    /// The prediction interval ends at the order statistics of ranks 0.025 (n + 1) and 0.975 (n + 1), interpolated
    /// linearly, which hold 95 % for any continuous distribution. Fewer than 39 values have no such ranks: the interval
    /// is then x̄ ± t s √(1 + 1/n), for normally distributed values.
    pub fn of(values: impl Iterator<Item = f64>) -> Self {
        let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
        values.sort_by(f64::total_cmp);
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        let standard_deviation = (squares / (count - 1.0)).sqrt();
        let half_width = student_t(count - 1.0) * standard_deviation;
        let rank = 0.5 * PROBABILITY_OUTSIDE * (count + 1.0);
        let (lower, upper) = if rank < 1.0 {
            let half_width = half_width * (1.0 + 1.0 / count).sqrt();
            (mean - half_width, mean + half_width)
        } else {
            (order_statistic(&values, rank), order_statistic(&values, count + 1.0 - rank))
        };
        Self { mean, mean_error: half_width / count.sqrt(), standard_deviation, lower, upper }
    }

    /// The scatter of a quantity that is never negative: the prediction interval starts at 0 at the lowest.
    pub fn not_negative(self) -> Self {
        // An unknown bound stays unknown.
        let lower = if self.lower < 0.0 { 0.0 } else { self.lower };
        Self { lower, ..self }
    }
}

/// The value of a `rank` between 1 and their number, linear between neighbours.
fn order_statistic(ascending: &[f64], rank: f64) -> f64 {
    let below = rank.floor() as usize;
    let (value, next) = (ascending[below - 1], ascending[below.min(ascending.len() - 1)]);
    value + (rank - rank.floor()) * (next - value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::heights::{Exponential, Gaussian, Heights, Random};
    use rand::SeedableRng;

    #[test]
    fn scatter_of_known_values() {
        let scatter = Scatter::of((0..=100).map(f64::from).chain([f64::NAN]));
        // Ranks 2.55 and 99.45 of 101.
        assert_eq!(scatter.mean, 50.0);
        assert!((scatter.lower - 1.55).abs() < 1e-12 && (scatter.upper - 98.45).abs() < 1e-12);
        // n = 101 consecutive numbers: variance n(n+1)/12.
        assert!((scatter.standard_deviation - (101.0f64 * 102.0 / 12.0).sqrt()).abs() < 1e-12);
        // Counts of contacts are not negative.
        let few = Scatter::of([1.0, 2.0].into_iter());
        assert!(few.lower < -5.0 && few.not_negative() == Scatter { lower: 0.0, ..few }, "{few:?}");
        let none = Scatter::of(std::iter::empty());
        assert!(none.mean.is_nan() && none.not_negative().lower.is_nan());
        assert!(Scatter::of([1.0].into_iter()).mean_error.is_nan());
    }

    /// Share of repeated draws whose confidence interval holds the mean, and whose prediction interval holds one more value.
    fn coverage(heights: &dyn Heights, mean: f64, count: usize) -> [f64; 2] {
        const REPEATED: usize = 20_000;
        let mut random = Random::seed_from_u64(count as u64);
        let mut held = [0.0; 2];
        for _ in 0..REPEATED {
            let scatter = Scatter::of((0..count).map(|_| heights.draw(&mut random)));
            let next = heights.draw(&mut random);
            held[0] += f64::from(u8::from((scatter.mean - mean).abs() <= scatter.mean_error));
            held[1] += f64::from(u8::from((scatter.lower..=scatter.upper).contains(&next)));
        }
        held.map(|count| count / REPEATED as f64)
    }

    #[test]
    fn intervals_hold_95_per_cent_with_3_5_and_200_surfaces() {
        // The standard deviation of a coverage of 20000 draws is 0.0015.
        for count in [3, 5, 38, 39, 200] {
            let [of_mean, of_next] = coverage(&Gaussian::new(1.0), 0.0, count);
            assert!(
                (of_mean - 0.95).abs() < 0.006 && (of_next - 0.95).abs() < 0.006,
                "{count}: {of_mean} {of_next}"
            );
        }
        // Order statistics hold for any distribution; the mean of 200 skewed values is nearly normal.
        let [of_mean, of_next] = coverage(&Exponential::new(1.0), 1.0, 200);
        assert!((of_mean - 0.95).abs() < 0.012 && (of_next - 0.95).abs() < 0.006, "{of_mean} {of_next}");
    }
}
