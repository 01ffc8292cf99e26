use super::distribution::{Heights, Random};
use rand_distr::Distribution;
use statrs::function::gamma::gamma_lr;

/// Heights that an inverted χ² distribution describes: z = σ(ν − x)/√(2ν), x of the χ² distribution
/// of ν degrees of freedom.
///
/// Its highest summits lie √(ν/2) σ above the mean, and it is skewed downwards, −√(8/ν): surfaces that
/// have lost their peaks, as worn metal and sheared joints (Brown & Scholz 1985, J. Geophys. Res. 90,
/// 5531, doi:10.1029/JB090iB07p05531). Gaussian as ν → ∞.
#[derive(Clone, Debug)]
pub struct InvertedChiSquared {
    std: f64,
    degrees: f64,
}

impl InvertedChiSquared {
    /// Heights of standard deviation `std` (m) with `degrees` of freedom, ν ≥ 4.
    pub fn new(std: f64, degrees: f64) -> Self {
        Self { std, degrees }
    }

    /// χ² over height.
    fn scale(&self) -> f64 {
        (2.0 * self.degrees).sqrt() / self.std
    }
}

impl Heights for InvertedChiSquared {
    fn ln_density(&self, height: f64) -> f64 {
        let x = self.degrees - height * self.scale();
        if x <= 0.0 {
            return f64::NEG_INFINITY;
        }
        let half = 0.5 * self.degrees;
        self.scale().ln() + (half - 1.0) * x.ln()
            - 0.5 * x
            - half * std::f64::consts::LN_2
            - libm::lgamma(half)
    }
    fn tail(&self, height: f64) -> f64 {
        let x = self.degrees - height * self.scale();
        // An infinite argument is not taken.
        if x <= 0.0 { 0.0 } else { gamma_lr(0.5 * self.degrees, (0.5 * x).min(f64::MAX)) }
    }
    fn mode(&self) -> f64 {
        2.0 / self.scale()
    }
    fn support(&self) -> (f64, f64) {
        (f64::NEG_INFINITY, self.degrees / self.scale())
    }
    fn standard_deviation(&self) -> f64 {
        self.std
    }
    fn draw(&self, random: &mut Random) -> f64 {
        let squares = rand_distr::ChiSquared::new(self.degrees).expect("degrees are positive");
        (self.degrees - squares.sample(random)) / self.scale()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// P(χ²₄ < x) = 1 − (1 + x/2) exp(−x/2).
    #[test]
    fn with_four_degrees_the_tail_is_elementary() {
        let heights = InvertedChiSquared::new(1e-6, 4.0);
        for x in [0.01, 0.3, 2.0, 7.0, 20.0] {
            let height = (4.0 - x) * 1e-6 / 8f64.sqrt();
            let exact = 1.0 - (1.0 + 0.5 * x) * (-0.5 * x).exp();
            assert!((heights.tail(height) / exact - 1.0).abs() < 1e-9, "{x}");
        }
        assert_eq!(heights.tail(f64::NEG_INFINITY), 1.0);
        let highest = 2f64.sqrt() * 1e-6;
        assert_eq!(heights.tail(1.001 * highest), 0.0);
        assert!((heights.support().1 / highest - 1.0).abs() < 1e-12);
    }

    /// Of heights in standard deviations, scipy 1.17 `gammainc(degrees/2, (degrees - z*sqrt(2*degrees))/2)`.
    #[test]
    fn tails_are_those_of_scipy_with_few_and_many_degrees() {
        for (degrees, height, tail) in [
            (4.0, -3.0, 0.9859151399165658),
            (4.0, 1.0, 0.11724358593221781),
            (199.0, -1.0, 0.8417231596226951),
            (199.0, 3.0, 0.0004287566396937864),
            (200.0, -3.0, 0.9972495916326934),
            (200.0, 0.0, 0.5132987982791487),
            (200.0, 4.0, 1.4815276326460494e-06),
            (900.0, -3.0, 0.9980413508939703),
            (900.0, 0.5, 0.3126906797562105),
            (900.0, 4.0, 9.891280331675319e-06),
        ] {
            let found = InvertedChiSquared::new(1e-6, degrees).tail(1e-6 * height);
            assert!((found / tail - 1.0).abs() < 1e-11, "{degrees} {height}: {found:e}");
        }
    }
}
