//! Gauss–Kronrod rules on (−1, 1): few points first, many where these are not accurate enough.

/// A Kronrod rule with a Gauss rule inside, which gives its error.
#[derive(Debug)]
pub struct Rule {
    /// Abscissae from −1 to 0, of the other half the negative ones, and their weights.
    half: &'static [(f64, f64)],
    /// Share of the weight of every point, ascending, by which Gauss's differs.
    pub excess: &'static [f64],
}

impl Rule {
    /// Number of points.
    pub const fn count(&self) -> usize {
        self.excess.len()
    }

    /// (abscissa, weight) of every point, ascending.
    pub fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        let other = self.half.iter().rev().skip(1).map(|(abscissa, weight)| (-abscissa, *weight));
        self.half.iter().copied().chain(other)
    }
}

/// Three points of Gauss in seven: exact for polynomials up to degree 11.
pub static FEW: Rule = Rule { half: &FEW_HALF, excess: &FEW_EXCESS };

/// Ten points of Gauss in 21: exact for polynomials up to degree 31.
pub static MANY: Rule = Rule { half: &MANY_HALF, excess: &MANY_EXCESS };

/// 1 − w_G/w_K at each of N points, from those of one half; every second point is one of Gauss.
const fn excess<const HALF: usize, const N: usize>(half: &[(f64, f64); HALF], gauss: &[f64]) -> [f64; N] {
    let mut shares = [1.0; N];
    let mut point = 0;
    while point < N {
        let mirrored = if point < HALF { point } else { N - 1 - point };
        if mirrored % 2 == 1 {
            shares[point] = 1.0 - gauss[mirrored / 2] / half[mirrored].1;
        }
        point += 1;
    }
    shares
}

const FEW_EXCESS: [f64; 7] = excess(&FEW_HALF, &FEW_GAUSS);
const MANY_EXCESS: [f64; 21] = excess(&MANY_HALF, &MANY_GAUSS);

const FEW_GAUSS: [f64; 2] = [5.0 / 9.0, 8.0 / 9.0];

/// A. S. Kronrod, *Nodes and weights of quadrature formulas* (Consultants Bureau 1965).
#[rustfmt::skip]
const FEW_HALF: [(f64, f64); 4] = [
    (-0.9604912687080203, 0.10465622602646726),
    (-0.7745966692414834, 0.26848808986833345),
    (-0.4342437493468026, 0.4013974147759622),
    (0.0, 0.45091653865847414),
];

const MANY_GAUSS: [f64; 5] =
    [0.0666713443086881, 0.1494513491505806, 0.219086362515982, 0.2692667193099964, 0.2955242247147529];

/// Piessens et al., QUADPACK (Springer 1983), routine QK21.
#[rustfmt::skip]
const MANY_HALF: [(f64, f64); 11] = [
    (-0.9956571630258081, 0.011694638867371874),
    (-0.9739065285171717, 0.032558162307964725),
    (-0.9301574913557082, 0.054755896574351995),
    (-0.8650633666889845, 0.07503967481091996),
    (-0.7808177265864169, 0.0931254545836976),
    (-0.6794095682990244, 0.10938715880229764),
    (-0.5627571346686047, 0.12349197626206584),
    (-0.4333953941292472, 0.13470921731147334),
    (-0.2943928627014602, 0.14277593857706009),
    (-0.14887433898163122, 0.14773910490133849),
    (0.0, 0.1494455540029169),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_exact_up_to_the_degree() {
        for (rule, kronrod, gauss) in [(&FEW, 11, 5), (&MANY, 31, 19)] {
            let integral = |power: i32, share: &dyn Fn(usize) -> f64| -> f64 {
                let terms = rule.points().enumerate();
                // (1 + x)^n: no power is exact by symmetry alone.
                terms.map(|(i, (x, weight))| share(i) * weight * (1.0 + x).powi(power)).sum()
            };
            assert_eq!(rule.points().count(), rule.count());
            for power in 0..=kronrod {
                let exact = 2f64.powi(power + 1) / f64::from(power + 1);
                let value = integral(power, &|_| 1.0);
                assert!((value / exact - 1.0).abs() < 2e-15, "{power}: {value}");
                if power <= gauss {
                    let of_gauss = integral(power, &|i| 1.0 - rule.excess[i]);
                    assert!((of_gauss / exact - 1.0).abs() < 2e-15, "{power}: {of_gauss}");
                }
            }
            let beyond = 2f64.powi(gauss + 2) / f64::from(gauss + 2);
            assert!((integral(gauss + 1, &|i| 1.0 - rule.excess[i]) / beyond - 1.0).abs() > 1e-12);
        }
    }
}
