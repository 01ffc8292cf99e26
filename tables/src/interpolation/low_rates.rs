//! Temperature rise between rest and the first positive slip rate V₁ of a table.
//!
//! The rise of a disc of radius a in motion under the frictional heat QV is (Tian & Kennedy 1994, J. Tribol. 116, 167)
//!
//! ϑ = n QV/a,   n = n₀/√(1 + bV)
//!
//! in proportion to V at rest and to its root at large Péclet numbers. n₀ depends on conductivities and shape and is that of
//! all contacts of a table; it is taken from its first row, whose contacts are the smallest and the nearest to rest. b grows
//! with a and follows from n at V₁. Two slip rates of a deep contact do not determine b: both may be far above rest, and the
//! heat of the faster one is less as the metal is softer.

use super::interpolant::Interpolant;
use super::steffen::Location;

impl Interpolant {
    /// The rise in row `i` at a slip rate below V₁, over what it would be in proportion to QV; none on and above V₁, and where
    /// there is no friction or no rise. `of` gives rise and friction force in a row at a slip rate, by their numbers.
    pub(super) fn growth_of_rise(
        &self,
        i: usize,
        rate: Location,
        of: impl Fn(usize, usize) -> Option<[f64; 2]>,
    ) -> Option<f64> {
        let is_below = rate.index == 0 && rate.t > 0.0 && rate.t < 1.0 && self.slip_rate[0] == 0.0;
        let (first, _) = self.rows.filter(|_| is_below)?;
        let specific = |i: usize, j: usize| {
            let [rise, friction] = of(i, j)?;
            let n = rise * self.log_contact_radius[i].exp() / (friction * self.slip_rate[j]);
            (n > 0.0 && n.is_finite()).then_some(n)
        };
        let second = self.slip_rate.get(2).and_then(|rate| Some((*rate, specific(first, 2)?)));
        let at_rest = at_rest((self.slip_rate[1], specific(first, 1)?), second)?;
        Some(growth(rate.t, specific(i, 1)? / at_rest))
    }
}

/// n₀ from n at one slip rate, or at two: n⁻² is linear in V. None where that has no root.
fn at_rest((first_rate, first): (f64, f64), second: Option<(f64, f64)>) -> Option<f64> {
    let Some((second_rate, second)) = second else { return Some(first) };
    let inverse_square =
        (second_rate / first.powi(2) - first_rate / second.powi(2)) / (second_rate - first_rate);
    (inverse_square > 0.0).then(|| inverse_square.sqrt().recip().max(first))
}

/// √((1 + bV₁)/(1 + bV)) at V = tV₁, with n at V₁ over n₀.
fn growth(t: f64, specific: f64) -> f64 {
    let b = (specific.powi(-2) - 1.0).max(0.0);
    ((1.0 + b) / (1.0 + b * t)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_law_of_a_moving_disc_comes_back() {
        let (at_rest_exactly, b) = (0.02, 7.0);
        let n = |rate: f64| at_rest_exactly / (1.0 + b * rate).sqrt();
        let found = at_rest((0.03, n(0.03)), Some((0.12, n(0.12)))).unwrap();
        assert!((found / at_rest_exactly - 1.0).abs() < 1e-12);
        for (first_rate, t) in [(0.03, 0.5), (0.03, 1e-4), (1.0, 0.2)] {
            let exact = n(first_rate * t) / n(first_rate);
            assert!((growth(t, n(first_rate) / found) / exact - 1.0).abs() < 1e-12);
        }
        // One slip rate, a rise faster than in proportion, and one as of the root of V.
        assert_eq!(at_rest((0.03, 0.02), None), Some(0.02));
        assert_eq!((at_rest((0.03, 0.02), Some((0.12, 0.03))), growth(0.5, 1.2)), (Some(0.02), 1.0));
        assert_eq!(at_rest((0.03, 0.02), Some((0.12, 0.0099))), None);
    }
}
