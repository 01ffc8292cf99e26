//! White noise in a spectrum.

/// Waves of nearly the same wavenumber.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bin {
    /// Mean of ln q as a wavenumber q, rad/m.
    pub q: f64,
    /// Mean power of a wave, m².
    pub power: f64,
    /// Number of independent powers.
    pub count: f64,
}

/// Exponents p of the surface at most: no self-affine surface falls faster than with 4, but what blurs a measurement
/// makes it fall faster.
const STEEPEST: f64 = 12.0;

/// Increase of the logarithm of the likelihood by the noise, from which on it counts: by chance one spectrum without
/// noise in 400 reaches it (half of χ² of one degree of freedom).
const SIGNIFICANT: f64 = 4.0;

/// Power of a wave (m²) of the white noise N in a spectrum A q^{−p} + N with p from `flattest` on, by maximum
/// likelihood; none where the spectrum shows no noise.
///
/// The powers of the waves of a random surface have an exponential distribution about the spectrum S, and the
/// logarithm of the likelihood is −Σ (ln S + power/S) (Whittle 1953, doi 10.1007/BF02590998). With S = s f the
/// likeliest s is Σ (power/f)/n.
pub(super) fn white(bins: &[Bin], flattest: f64) -> Option<f64> {
    let last = bins.last()?.q;
    let count: f64 = bins.iter().map(|bin| bin.count).sum();
    // Of the exponent and the decimal logarithm of the noise over the rest at the last wavenumber; and s.
    let misfit = |[exponent, noise]: [f64; 2]| {
        let exponent = exponent.clamp(flattest, STEEPEST);
        let shape = |bin: &Bin| (bin.q / last).powf(-exponent) + 10f64.powf(noise);
        let scale = bins.iter().map(|bin| bin.count * bin.power / shape(bin)).sum::<f64>() / count;
        (bins.iter().map(|bin| bin.count * (scale * shape(bin)).ln()).sum::<f64>(), scale)
    };
    let least = |noises: &[f64]| {
        let exponents = (0..=20).map(|step| flattest + 0.05 * f64::from(step) * (STEEPEST - flattest));
        let grid = exponents.flat_map(|exponent| noises.iter().map(move |noise| [exponent, *noise]));
        let start = grid.min_by(|one, other| misfit(*one).0.total_cmp(&misfit(*other).0));
        lowest_nearby(|at| misfit(at).0, start.expect("a grid has points"))
    };
    let noises: Vec<f64> = (-4..=12).map(|step| 0.5 * f64::from(step)).collect();
    let (clean, best) = (least(&[f64::NEG_INFINITY]), least(&noises));
    let gain = misfit(clean).0 - misfit(best).0;
    (gain > SIGNIFICANT).then(|| misfit(best).1 * 10f64.powf(best[1]))
}

/// Goes to lower neighbours in steps that are halved where there are none.
fn lowest_nearby(value: impl Fn([f64; 2]) -> f64, mut place: [f64; 2]) -> [f64; 2] {
    let mut step = 0.25;
    while step > 1e-4 {
        let moves = (0..9).map(|i| [f64::from(i / 3 - 1), f64::from(i % 3 - 1)]);
        let around = moves.map(|[dx, dy]| [place[0] + step * dx, place[1] + step * dy]);
        let lower = around.min_by(|one, other| value(*one).total_cmp(&value(*other)));
        match lower.filter(|lower| value(*lower) < value(place)) {
            Some(lower) => place = lower,
            None => step *= 0.5,
        }
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spectrum(power: impl Fn(f64) -> f64) -> Vec<Bin> {
        let wavenumbers = (0..12).map(|step| 0.125 * 2f64.powf(0.25 * f64::from(step)));
        wavenumbers.map(|q| Bin { q, power: power(q), count: 1e5 * q * q }).collect()
    }

    #[test]
    fn noise_is_told_from_the_surface() {
        for exponent in [2.6, 3.6, 7.3] {
            for noise in [0.3, 1.0, 10.0, 1e3] {
                let found = white(&spectrum(|q| q.powf(-exponent) + noise), 2.0).unwrap();
                assert!((found / noise - 1.0).abs() < 0.1, "{exponent} {noise}: {found}");
            }
            assert_eq!(white(&spectrum(|q| q.powf(-exponent)), 2.0), None);
        }
        // A spectrum that falls less than that of any self-affine surface.
        assert!(white(&spectrum(|_| 1.0), 2.0).is_some());
        // A roll-off and a resolution that ends.
        assert_eq!(white(&spectrum(|q| q.max(0.25).powf(-3.6)), 2.0), None);
        assert_eq!(white(&spectrum(|q| q.powf(-3.6) * (-10.0 * q * q).exp()), 2.0), None);
        assert_eq!(white(&spectrum(|_| 0.0), 2.0), None);
        assert_eq!(white(&[], 2.0), None);
    }
}
