//! Temperature rise between rest and the first positive slip rate V₁ of a table.
//!
//! The rise of a disc of radius a in motion under the frictional heat QV is (Tian & Kennedy 1994, J. Tribol. 116, 167)
//!
//! ϑ = n QV/a,   n = n₀/√(1 + bV)
//!
//! in proportion to V at rest and to its root at large Péclet numbers. n₀ depends on the conductivities; of the shipped tables on
//! isothermal flats it grows with a by 11 to 18 % up to a = 0.13 to 0.3 R, as the sphere is narrower than a half-space. b grows with a
//! and follows from n₀ and n at V₁.
//!
//! n⁻² is linear in V. Of the first row, whose contacts are the smallest and the nearest to rest, two slip rates determine n₀. Of
//! a deep contact both may be far above rest, and the heat of the faster one is less as the metal is softer: n₀ is too large.
//! The geometric mean of both is taken. Their distance and the change of n count as the distance to a straight line does in
//! interpolation, half of which is a bound of the error: where the slide ends before the contact is steady, n falls with √V.

/// Largest n₀ of a deep contact over that of the first row: that of the shipped tables, with room for other materials.
const OF_DEEP_CONTACT: f64 = 1.3;

/// A rise over what it would be in proportion to QV.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RiseFactor {
    pub(super) factor: f64,
    /// Distance to a straight line, over the rise.
    pub(super) bend: f64,
}

/// Factor of the rise in row `i` at V = tV₁; none where there is no friction or no rise, and where neither this nor a row
/// before, from `first` on, has n₀. `specific` gives n in a row at one of the `slip_rates`, of which the first is 0.
pub(super) fn rise_factor(
    t: f64,
    slip_rates: &[f64],
    [first, i]: [usize; 2],
    specific: impl Fn(usize, usize) -> Option<f64>,
) -> Option<RiseFactor> {
    let of_row = |i: usize| {
        let at_first = (slip_rates[1], specific(i, 1)?);
        let second = slip_rates.get(2).and_then(|rate| Some((*rate, specific(i, 2)?)));
        second.map_or(Some(at_first.1), |second| at_rest(at_first, second))
    };
    let of_first_row = (first..=i).find_map(of_row)?;
    let largest = OF_DEEP_CONTACT * of_first_row;
    let own = of_row(i).unwrap_or(largest).clamp(of_first_row, largest);
    Some(factor_between(t, specific(i, 1)?, [of_first_row, own]))
}

/// n₀ from slip rates and n at two of them. None where n⁻² has no root.
fn at_rest((first_rate, first): (f64, f64), (second_rate, second): (f64, f64)) -> Option<f64> {
    let inverse_square =
        (second_rate / first.powi(2) - first_rate / second.powi(2)) / (second_rate - first_rate);
    (inverse_square > 0.0).then(|| inverse_square.sqrt().recip().max(first))
}

/// √((1 + bV₁)/(1 + bV)) at V = tV₁, from n at V₁ and n₀ between two values.
fn factor_between(t: f64, at_first: f64, at_rest: [f64; 2]) -> RiseFactor {
    let of = |at_rest: f64| {
        let b = ((at_rest / at_first).powi(2) - 1.0).max(0.0);
        ((1.0 + b) / (1.0 + b * t)).sqrt()
    };
    let factor = of((at_rest[0] * at_rest[1]).sqrt());
    let apart = of(at_rest[1]) / of(at_rest[0]) - 1.0;
    RiseFactor { factor, bend: apart.abs() + (factor - 1.0).abs() }
}

/// Ratio of the values at V = tV₁ and at V₁ by the law of this module, of a quantity that is 0 at V = 0: V₂ = `rates` V₁ with the value `values` times
/// that at V₁. A ratio that no b has is taken as the nearest that one has.
pub(super) fn from_zero(t: f64, rates: f64, values: f64) -> f64 {
    let n = values / rates;
    at_rest((1.0, 1.0), (rates, n))
        .map_or(t.sqrt(), |at_rest| t * factor_between(t, 1.0, [at_rest; 2]).factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_law_of_a_moving_disc_comes_back() {
        let (exact, b) = (0.02, 7.0);
        let n = |rate: f64| exact / (1.0 + b * rate).sqrt();
        let found = at_rest((0.03, n(0.03)), (0.12, n(0.12))).unwrap();
        assert!((found / exact - 1.0).abs() < 1e-12);
        for (first_rate, t) in [(0.03, 0.5), (0.03, 1e-4), (1.0, 0.2)] {
            let factor = factor_between(t, n(first_rate), [found; 2]).factor;
            assert!((factor * n(first_rate) / n(first_rate * t) - 1.0).abs() < 1e-12);
        }
        // A rise faster than in proportion, and one slower than as the root of V.
        assert_eq!(at_rest((0.03, 0.02), (0.12, 0.03)), Some(0.02));
        assert_eq!(factor_between(0.5, 0.024, [0.02; 2]), RiseFactor { factor: 1.0, bend: 0.0 });
        assert_eq!(at_rest((0.03, 0.02), (0.12, 0.0099)), None);
    }
}
