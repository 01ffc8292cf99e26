//! Distribution of the summit radii.
//!
//! Radii and heights are independent: a summit of every radius is as likely at one height as at
//! another. The laws of single asperities scale to any radius, so a surface is the sum of
//! surfaces of one radius each.

use gauss_quad::GaussLegendre;
use rand::RngExt;
use tables::law::AsperityLaw;

use crate::surface::heights::Random;

/// A radius and the share of the summits that have it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadiusClass {
    /// R, m.
    pub radius: f64,
    /// Of all summits, 1.
    pub share: f64,
}

/// Radii of the summits: one for all, or classes that represent a distribution.
#[derive(Clone, Debug, PartialEq)]
pub struct Radii {
    classes: Vec<RadiusClass>,
    /// Fewer classes for the same distribution, for the error.
    coarse: Option<Vec<RadiusClass>>,
}

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
        Self { classes: vec![RadiusClass { radius, share: 1.0 }], coarse: None }
    }
}

impl Radii {
    /// Log-normal radii of that mean and standard deviation (m), cut at three standard deviations
    /// of ln R; the mean is that of the cut distribution.
    pub fn log_normal(mean: f64, std: f64) -> Self {
        let spread = (1.0 + (std / mean).powi(2)).ln().sqrt();
        let classes = |count: usize| {
            let rule = GaussLegendre::new(count).expect("there are rules of more than one point");
            let mut classes: Vec<RadiusClass> = (rule.into_node_weight_pairs().into_iter())
                .map(|(node, weight)| {
                    let t = CUT * node;
                    RadiusClass { radius: (spread * t).exp(), share: weight * (-0.5 * t * t).exp() }
                })
                .collect();
            classes.sort_by(|one, other| one.radius.total_cmp(&other.radius));
            normalised(classes, mean)
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
        let class = |(&radius, share): (&f64, &f64)| RadiusClass { radius, share: share / total };
        let mut classes: Vec<RadiusClass> = radius.iter().zip(share).map(class).collect();
        classes.sort_by(|one, other| one.radius.total_cmp(&other.radius));
        Some(Self { classes, coarse: None })
    }

    /// The classes, by ascending radius.
    pub fn classes(&self) -> &[RadiusClass] {
        &self.classes
    }

    /// Fewer classes for the same distribution, where it is a continuous one.
    pub fn coarse(&self) -> Option<&[RadiusClass]> {
        self.coarse.as_deref()
    }

    /// Mean radius, m.
    pub fn mean(&self) -> f64 {
        self.classes.iter().map(|class| class.share * class.radius).sum()
    }

    /// The range of slip rates (m/s) that a law has at all radii; its ends in the wrong order where there is none.
    pub fn slip_rate_range(&self, law: &dyn AsperityLaw) -> (f64, f64) {
        let ranges = self.classes.iter().map(|class| law.slip_rate_range(class.radius));
        ranges.fold((0.0, f64::INFINITY), |(low, high), (from, to)| (from.max(low), to.min(high)))
    }

    /// All radii times `factor`.
    pub fn scaled(&self, factor: f64) -> Self {
        let scaled = |classes: &[RadiusClass]| {
            classes.iter().map(|class| RadiusClass { radius: factor * class.radius, ..*class }).collect()
        };
        Self { classes: scaled(&self.classes), coarse: self.coarse.as_deref().map(scaled) }
    }

    /// The class of a summit drawn at random.
    pub fn draw(&self, random: &mut Random) -> usize {
        if self.classes.len() == 1 {
            return 0;
        }
        let mut left = random.random::<f64>();
        let drawn = self.classes.iter().position(|class| {
            left -= class.share;
            left < 0.0
        });
        drawn.unwrap_or(self.classes.len() - 1)
    }
}

/// Shares that sum to one and radii of the given mean (m).
fn normalised(classes: Vec<RadiusClass>, mean: f64) -> Vec<RadiusClass> {
    let total: f64 = classes.iter().map(|class| class.share).sum();
    let first: f64 = classes.iter().map(|class| class.share * class.radius).sum();
    let scaled = |class: RadiusClass| RadiusClass {
        radius: class.radius * mean * total / first,
        share: class.share / total,
    };
    classes.into_iter().map(scaled).collect()
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
            let sum = |classes: &[RadiusClass]| -> f64 {
                classes.iter().map(|class| class.share * (class.radius / 2e-4).powf(n)).sum()
            };
            let fine = sum(radii.classes());
            assert!((fine / exact - 1.0).abs() < 1e-9, "{n}: {fine} {exact}");
            assert!((sum(radii.coarse().unwrap()) / exact - 1.0).abs() < 1e-4, "{n}");
        }
        assert!((radii.mean() / 2e-4 - 1.0).abs() < 1e-14);
    }

    #[test]
    fn counted_classes_are_shares() {
        let radii = Radii::counted(&[3e-6, 1e-6], &[1.0, 3.0]).unwrap();
        assert_eq!(radii.classes()[0], RadiusClass { radius: 1e-6, share: 0.75 });
        assert!((radii.mean() - 1.5e-6).abs() < 1e-20);
        assert!(Radii::counted(&[1e-6], &[1.0, 1.0]).is_none());
        assert!(Radii::counted(&[-1e-6], &[1.0]).is_none());
        let mut random: Random = rand::SeedableRng::seed_from_u64(1);
        let count = (0..10_000).filter(|_| radii.draw(&mut random) == 0).count() as f64;
        // Four standard errors.
        assert!((count / 1e4 - 0.75).abs() < 4.0 * (0.75f64 * 0.25 / 1e4).sqrt());
    }
}
