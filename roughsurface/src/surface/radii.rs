//! Distribution of the summit radii.
//!
//! Radii and heights are independent: a summit of every radius is as likely at one height as at
//! another. The laws of single asperities scale to any radius, so a surface is the sum of
//! surfaces of one radius each.

use gauss_quad::GaussLegendre;
use rand::RngExt;
use std::convert::Infallible;
use tables::law::AsperityLaw;

use crate::surface::heights::Random;

/// Something for each radius, by ascending radius, with the share of the summits that have it.
#[derive(Clone, Debug, PartialEq)]
pub struct ByRadius<T> {
    pub classes: Vec<(f64, T)>,
    /// For fewer radii of the same distribution, where it is a continuous one.
    pub coarse: Option<Vec<(f64, T)>>,
}

impl<T> ByRadius<T> {
    /// Classes without fewer ones for the same distribution.
    pub fn of_classes(classes: Vec<(f64, T)>) -> Self {
        Self { classes, coarse: None }
    }

    /// The values of a function of each radius class.
    pub fn map<U>(&self, of: impl Fn(&T) -> U) -> ByRadius<U> {
        let Ok(mapped) = self.try_map(|one| Ok::<U, Infallible>(of(one)));
        mapped
    }

    /// The values of a function of each radius class; an error if it fails for one.
    pub fn try_map<U, E>(&self, of: impl Fn(&T) -> Result<U, E>) -> Result<ByRadius<U>, E> {
        let all = |classes: &Vec<(f64, T)>| -> Result<Vec<(f64, U)>, E> {
            classes.iter().map(|(share, one)| Ok((*share, of(one)?))).collect()
        };
        Ok(ByRadius { classes: all(&self.classes)?, coarse: self.coarse.as_ref().map(all).transpose()? })
    }
}

/// Radii of the summits, m: one for all, or classes that represent a distribution.
pub type Radii = ByRadius<f64>;

/// Classes of a continuous distribution, and those that they are compared with: sums of powers
/// of R up to R³ agree to 1e-9 at a spread of one half.
const CLASSES: usize = 16;
const COARSE_CLASSES: usize = 10;

/// Standard deviations of ln R at which the log-normal distribution is cut: beyond lie 0.27 % of
/// the summits, at radii outside the range of a table with a finite range of slip rates.
const CUT: f64 = 3.0;

/// Largest ratio of standard deviation to mean.
pub const LARGEST_VARIATION: f64 = 1.0;

impl From<f64> for Radii {
    /// One radius (m) for all.
    fn from(radius: f64) -> Self {
        Self::of_classes(vec![(1.0, radius)])
    }
}

impl Radii {
    /// Log-normal radii of that mean and standard deviation (m), cut at three standard deviations
    /// of ln R; the mean is that of the cut distribution.
    pub fn log_normal(mean: f64, std: f64) -> Self {
        let spread = (1.0 + (std / mean).powi(2)).ln().sqrt();
        let classes = |count: usize| {
            let rule = GaussLegendre::new(count).expect("there are rules of more than one point");
            let class = |(node, weight): (f64, f64)| {
                let t = CUT * node;
                (weight * (-0.5 * t * t).exp(), (spread * t).exp())
            };
            normalised(rule.into_node_weight_pairs().into_iter().map(class).collect(), mean)
        };
        Self { classes: classes(CLASSES), coarse: Some(classes(COARSE_CLASSES)) }
    }

    /// Classes counted on a surface: radii (m), and shares of the summits in any unit. None unless
    /// there is a positive share for every radius.
    pub fn counted(radius: &[f64], share: &[f64]) -> Option<Self> {
        let positive = |values: &[f64]| values.iter().all(|value| *value > 0.0 && value.is_finite());
        if radius.is_empty() || radius.len() != share.len() || !positive(radius) || !positive(share) {
            return None;
        }
        let total: f64 = share.iter().sum();
        let classes = share.iter().zip(radius).map(|(share, &radius)| (share / total, radius));
        Some(Self::of_classes(ascending(classes.collect())))
    }

    /// Mean radius, m.
    pub fn mean(&self) -> f64 {
        self.classes.iter().map(|(share, radius)| share * radius).sum()
    }

    /// The range of slip rates (m/s) that a law has at all radii; its ends in the wrong order where there is none.
    pub fn slip_rate_range(&self, law: &dyn AsperityLaw) -> (f64, f64) {
        let ranges = self.classes.iter().map(|(_, radius)| law.slip_rate_range(*radius));
        ranges.fold((0.0, f64::INFINITY), |(low, high), (from, to)| (from.max(low), to.min(high)))
    }

    /// The class of a summit drawn at random.
    pub fn draw(&self, random: &mut Random) -> usize {
        if self.classes.len() == 1 {
            return 0;
        }
        let mut left = random.random::<f64>();
        let drawn = self.classes.iter().position(|(share, _)| {
            left -= share;
            left < 0.0
        });
        drawn.unwrap_or(self.classes.len() - 1)
    }
}

/// Classes (share, radius in m) by ascending radius.
fn ascending(mut classes: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    classes.sort_by(|(_, one), (_, other)| one.total_cmp(other));
    classes
}

/// Classes (share, radius in m) by ascending radius, with shares that sum to one and radii of the given mean (m).
fn normalised(classes: Vec<(f64, f64)>, mean: f64) -> Vec<(f64, f64)> {
    let classes = ascending(classes);
    let total: f64 = classes.iter().map(|(share, _)| share).sum();
    let first: f64 = classes.iter().map(|(share, radius)| share * radius).sum();
    classes.into_iter().map(|(share, radius)| (share / total, radius * mean * total / first)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn log_normal_radii_have_the_moments_of_the_cut_distribution() {
        // E[Rⁿ] of e^{st} cut at ±c is e^{n²s²/2} [Φ(c − ns) − Φ(−c − ns)]/[Φ(c) − Φ(−c)].
        let s: f64 = 0.4;
        let normal = |x: f64| 0.5 * libm::erfc(-x / 2f64.sqrt());
        let moment = |n: f64| {
            (0.5 * n * n * s * s).exp() * (normal(CUT - n * s) - normal(-CUT - n * s))
                / (normal(CUT) - normal(-CUT))
        };
        let std = ((s * s).exp() - 1.0).sqrt();
        let radii = Radii::log_normal(2e-4, std * 2e-4);
        for n in [0.5, 1.0, 1.5, 2.0, 3.0] {
            let exact = moment(n) / moment(1.0).powf(n);
            let sum = |classes: &[(f64, f64)]| -> f64 {
                classes.iter().map(|(share, radius)| share * (radius / 2e-4).powf(n)).sum()
            };
            let fine = sum(&radii.classes);
            assert!((fine / exact - 1.0).abs() < 1e-9, "{n}: {fine} {exact}");
            assert!((sum(radii.coarse.as_ref().unwrap()) / exact - 1.0).abs() < 1e-4, "{n}");
        }
        assert!((radii.mean() / 2e-4 - 1.0).abs() < 1e-14);
    }

    #[test]
    fn counted_classes_are_shares() {
        let radii = Radii::counted(&[3e-6, 1e-6], &[1.0, 3.0]).unwrap();
        assert_eq!(radii.classes[0], (0.75, 1e-6));
        assert!((radii.mean() - 1.5e-6).abs() < 1e-20);
        assert!(Radii::counted(&[1e-6], &[1.0, 1.0]).is_none());
        assert!(Radii::counted(&[-1e-6], &[1.0]).is_none());
        let mut random: Random = rand::SeedableRng::seed_from_u64(1);
        let count = (0..10_000).filter(|_| radii.draw(&mut random) == 0).count() as f64;
        // Four standard errors.
        assert!((count / 1e4 - 0.75).abs() < 4.0 * (0.75f64 * 0.25 / 1e4).sqrt());
    }
}
