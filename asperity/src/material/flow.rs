//! Plastic flow along a straight path of strain, in closed form.
//!
//! Where the strain deviator goes straight on in a step, the stress deviator of a von Mises solid turns
//! towards its rate: dψ/dx = −sin ψ, with ψ the angle between them and dx = 2G|de|/R, R the radius of the yield
//! surface. So tan(ψ/2) falls as e^−x, and the stress stays in the plane of the two (Krieg & Krieg 1977, J. Pressure
//! Vessel Technol. 99, 510, for constant R). That is exact for any R(x) once x is known; here R counts as the mean of
//! those at both ends, which is second order in what the step hardens or softens. The radial return takes the
//! direction at the end for all of the step instead, which is first order in how far the stress turns: in increments
//! of 0.3 of the slip that is up to 0.4 per cent of the static friction and five of the energy release, here a tenth.

use super::{Solid, Trial};
use crate::material::lanes::{Lanes, exponentials, logarithms};
use crate::scene::Hardening;

/// Components of a symmetric tensor: rr, θθ, zz, rθ, θz, zr.
const TENSOR: usize = 6;
/// √⅔: |s| of a von Mises stress, and von Mises' increment of strain of |Δε_p|.
const TO_RADIUS: f64 = 0.816_496_580_927_726;

/// Strain path of W points from one state to the next. Stresses relative to E(T)/E(T₀), as in [`Trial`].
#[derive(Clone, Copy, Debug)]
pub struct StrainPath<'a, const W: usize> {
    /// Lanes that flow: the stress at the end would be above the strength there. What is found of the others
    /// means nothing.
    pub flowing: [bool; W],
    /// Stress deviator at the start, on or below the strength there.
    pub start: &'a [Lanes<W>; TENSOR],
    /// Stress deviator at the end, if all of the strain were elastic.
    pub elastic: &'a [Lanes<W>; TENSOR],
    /// ε_p at the start.
    pub strain: Lanes<W>,
    /// σ_y(ε_p, T₀) at the start.
    pub strength: Lanes<W>,
    /// f(T)/f(T₀) at the end.
    pub softening: Lanes<W>,
    /// First guess of the increment of ε_p, 0 if there is none.
    pub guess: Lanes<W>,
}

/// The end of a strain path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flow<const W: usize> {
    /// Increment of the equivalent plastic strain: the length of the path of plastic strain.
    pub increment: Lanes<W>,
    /// σ_y(ε_p, T₀).
    pub strength: Lanes<W>,
    /// dσ_y/dε_p at the temperature of the end.
    pub slope: Lanes<W>,
    /// |s|.
    pub radius: Lanes<W>,
    /// s/|s|.
    pub direction: [Lanes<W>; TENSOR],
    /// ∂s/∂e over 2G, across the plane in which the stress turns. In that plane the derivative is not symmetric; that
    /// across it stands for it there, and is exact where loading is proportional.
    pub across: Lanes<W>,
}

/// From where on the path the stress is on the yield surface, and how it goes on from there.
struct Onset<const W: usize> {
    /// Share of the path that is elastic.
    elastic: Lanes<W>,
    /// Radius of the yield surface there.
    radius: Lanes<W>,
    /// cos ψ there.
    cosine: Lanes<W>,
    /// 2G|Δe| of the whole path, and of what is left of it.
    length: Lanes<W>,
    left: Lanes<W>,
    /// |s| at the end of the path, if all of it were elastic.
    trial: Lanes<W>,
}

/// Where the stress has turned to: s/R = of_start·s_c/R_c + of_path·Δe/|Δe|.
struct DeviatorRotation<const W: usize> {
    of_start: Lanes<W>,
    of_path: Lanes<W>,
    /// of_path/x.
    of_path_over_x: Lanes<W>,
    /// ∫cos ψ dx.
    advance: Lanes<W>,
}

impl Solid {
    /// The state at the end of a strain path.
    pub fn flow<const W: usize>(&self, path: &StrainPath<W>) -> Flow<W> {
        let onset = path.onset();
        let mean = self.mean_radius(path, &onset);
        let turn = DeviatorRotation::new(&std::array::from_fn(|l| onset.left[l] / mean[l]), &onset.cosine);
        let end = self.return_map(&Trial {
            flowing: path.flowing,
            stress: std::array::from_fn(|l| (onset.radius[l] + mean[l] * turn.advance[l]) / TO_RADIUS),
            strain: path.strain,
            strength: path.strength,
            softening: path.softening,
            guess: path.guess,
        });
        let radius = std::array::from_fn(|l| TO_RADIUS * path.softening[l] * end.strength[l]);
        Flow {
            increment: end.increment,
            strength: end.strength,
            slope: end.slope,
            radius,
            direction: path.direction(&onset, &turn),
            across: std::array::from_fn(|l| {
                let of_onset = turn.of_start[l] * onset.elastic[l] / onset.radius[l];
                let of_path = turn.of_path_over_x[l] * (1.0 - onset.elastic[l]) / mean[l];
                (radius[l] * (of_onset + of_path)).min(1.0)
            }),
        }
    }

    /// Mean radius of the yield surface while the point flows: between that at first and that at the end, as the
    /// radial return would have it after one iteration of Newton's method.
    #[inline(always)]
    fn mean_radius<const W: usize>(&self, path: &StrainPath<W>, onset: &Onset<W>) -> Lanes<W> {
        let mut end: Lanes<W> = std::array::from_fn(|l| TO_RADIUS * path.softening[l] * path.strength[l]);
        if !matches!(self.hardening, Hardening::None) {
            let stiffness = 2.0 * self.moduli.shear / TO_RADIUS;
            // As if hardening took up none of the stress: somewhat too far.
            let most: Lanes<W> = std::array::from_fn(|l| (onset.trial[l] - end[l]).max(0.0) / stiffness);
            let strain: Lanes<W> = std::array::from_fn(|l| path.strain[l] + most[l]);
            let (strength, slope) = self.hardened_lanes(&strain);
            for l in 0..W {
                let factor = TO_RADIUS * path.softening[l];
                let (radius, slope) = (factor * strength[l], factor * slope[l]);
                let back = (radius - end[l]) / (stiffness + slope);
                let hardened = (radius - slope * back).min(onset.trial[l]);
                end[l] = if most[l] > 0.0 { hardened } else { end[l] };
            }
        }
        // No surface is left of a molten point.
        std::array::from_fn(|l| (0.5 * (onset.radius[l] + end[l])).max(1e-12 * onset.length[l]))
    }
}

impl<const W: usize> StrainPath<'_, W> {
    /// The yield surface has the radius that the strength has at the temperature of the end, or shrinks to it if the
    /// start is outside of that.
    #[inline(always)]
    fn onset(&self) -> Onset<W> {
        let (mut start, mut along, mut length) = ([0.0; W], [0.0; W], [0.0; W]);
        for i in 0..TENSOR {
            let factor = if i < 3 { 1.0 } else { 2.0 };
            for l in 0..W {
                let change = self.elastic[i][l] - self.start[i][l];
                start[l] += factor * self.start[i][l] * self.start[i][l];
                along[l] += factor * self.start[i][l] * change;
                length[l] += factor * change * change;
            }
        }
        let mut onset = Onset {
            elastic: [0.0; W],
            radius: [0.0; W],
            cosine: [0.0; W],
            length,
            left: [0.0; W],
            trial: std::array::from_fn(|l| (start[l] + 2.0 * along[l] + length[l]).max(0.0).sqrt()),
        };
        for l in 0..W {
            let last = TO_RADIUS * self.softening[l] * self.strength[l];
            let first = start[l].sqrt().max(last);
            let shrinks = last - first;
            // |s₀ + td|² = (R₀ + tΔR)²: at² + 2bt + c = 0, with c ≤ 0 and, the end being outside, one root t < 1.
            let a = length[l] - shrinks * shrinks;
            let b = along[l] - first * shrinks;
            let c = if shrinks < 0.0 { 0.0 } else { (start[l] - first * first).min(0.0) };
            let root = (b * b - a * c).max(0.0).sqrt();
            let elastic = if b > 0.0 { -c / (root + b) } else { (root - b) / a };
            // Also where there is no path, or no solution in the digits of the machine.
            let elastic = if elastic > 0.0 { elastic.min(1.0) } else { 0.0 };
            let change = length[l].sqrt();
            let radius = (first + elastic * shrinks).max(1e-12 * change).max(f64::MIN_POSITIVE);
            let cosine = (along[l] + elastic * length[l]) / (radius * change).max(f64::MIN_POSITIVE);
            onset.elastic[l] = elastic;
            onset.radius[l] = radius;
            onset.cosine[l] = cosine.clamp(-1.0, 1.0);
            onset.length[l] = change;
            onset.left[l] = (1.0 - elastic) * change;
        }
        onset
    }

    #[inline(always)]
    fn direction(&self, onset: &Onset<W>, turn: &DeviatorRotation<W>) -> [Lanes<W>; TENSOR] {
        let (mut of_start, mut of_change) = ([0.0; W], [0.0; W]);
        for l in 0..W {
            of_start[l] = turn.of_start[l] / onset.radius[l];
            let of_path = turn.of_path[l] / onset.length[l].max(f64::MIN_POSITIVE);
            of_change[l] = of_start[l] * onset.elastic[l] + of_path;
        }
        let mut direction = [[0.0; W]; TENSOR];
        for i in 0..TENSOR {
            for l in 0..W {
                let change = self.elastic[i][l] - self.start[i][l];
                direction[i][l] = of_start[l] * self.start[i][l] + of_change[l] * change;
            }
        }
        direction
    }
}

impl<const W: usize> DeviatorRotation<W> {
    /// After x, from an angle of that cosine c: with cosh x + c sinh x and so on, without large numbers.
    #[inline(always)]
    fn new(x: &Lanes<W>, cosine: &Lanes<W>) -> Self {
        let decay = exponentials(&x.map(|x| -x));
        // (cosh x + c sinh x)e^−x.
        let sum: Lanes<W> =
            std::array::from_fn(|l| 0.5 * (1.0 + cosine[l] + (1.0 - cosine[l]) * decay[l] * decay[l]));
        let log = logarithms(&sum);
        let mut turn =
            Self { of_start: [0.0; W], of_path: [0.0; W], of_path_over_x: [0.0; W], advance: [0.0; W] };
        for l in 0..W {
            let (c, e) = (cosine[l], decay[l]);
            turn.of_start[l] = e / sum[l];
            turn.of_path[l] = 0.5 * (1.0 - e) * (1.0 + c + (1.0 - c) * e) / sum[l];
            turn.of_path_over_x[l] = if x[l] > 1e-8 { turn.of_path[l] / x[l] } else { 1.0 };
            turn.advance[l] = x[l] + log[l];
        }
        turn
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Material, Softening};

    const LAWS: [Hardening; 3] = [
        Hardening::None,
        Hardening::Linear { modulus: 5e9 },
        Hardening::JohnsonCook { modulus: 500e6, exponent: 0.3 },
    ];

    fn solid(hardening: Hardening) -> Solid {
        let material = Material {
            youngs_modulus: 200e9,
            poisson_ratio: 0.3,
            yield_strength: 500e6,
            hardening,
            density: 7850.0,
            specific_heat: 475.0,
            thermal_conductivity: 44.5,
            thermal_expansion: 1.2e-5,
            softening: Softening::None,
            fracture: None,
            dependence: Default::default(),
        };
        Solid::new(&material, 298.0)
    }

    type Tensor = [f64; TENSOR];

    /// Stress and equivalent plastic strain of one point, at f(T)/f(T₀).
    #[derive(Clone, Copy, Debug)]
    struct Point {
        stress: Tensor,
        strain: f64,
        softening: f64,
    }

    fn inner(a: &Tensor, b: &Tensor) -> f64 {
        (0..TENSOR).map(|i| if i < 3 { a[i] * b[i] } else { 2.0 * a[i] * b[i] }).sum()
    }

    fn plus(a: &Tensor, share: f64, b: &Tensor) -> Tensor {
        std::array::from_fn(|i| a[i] + share * b[i])
    }

    fn distance(a: &Tensor, b: &Tensor) -> f64 {
        let apart = plus(a, -1.0, b);
        inner(&apart, &apart).sqrt()
    }

    /// The path 2GΔe = `change` in so many steps; `step` finds the state at the end of each.
    fn walk(from: Point, change: &Tensor, steps: usize, step: impl Fn(Point, &Tensor) -> Point) -> Point {
        (0..steps).fold(from, |point, _| {
            let elastic = plus(&point.stress, 1.0 / steps as f64, change);
            step(point, &elastic)
        })
    }

    fn q(s: &Tensor) -> f64 {
        (1.5 * inner(s, s)).sqrt()
    }

    fn flow(solid: &Solid, point: Point, elastic: &Tensor) -> Flow<1> {
        solid.flow(&StrainPath {
            flowing: [true],
            start: &point.stress.map(|s| [s]),
            elastic: &elastic.map(|s| [s]),
            strain: [point.strain],
            strength: [solid.hardened(point.strain).0],
            softening: [point.softening],
            guess: [0.0],
        })
    }

    fn closed_form(solid: &Solid) -> impl Fn(Point, &Tensor) -> Point {
        |point, elastic| {
            if q(elastic) <= point.softening * solid.hardened(point.strain).0 {
                return Point { stress: *elastic, ..point };
            }
            let end = flow(solid, point, elastic);
            let stress = end.direction.map(|[n]| end.radius[0] * n);
            Point { stress, strain: point.strain + end.increment[0], ..point }
        }
    }

    /// Backward Euler, whose limit in small steps is the law.
    fn radial_return(solid: &Solid) -> impl Fn(Point, &Tensor) -> Point {
        |point, elastic| {
            let strength = solid.hardened(point.strain).0;
            if q(elastic) <= point.softening * strength {
                return Point { stress: *elastic, ..point };
            }
            let end = solid.return_map(&Trial {
                flowing: [true],
                stress: [q(elastic)],
                strain: [point.strain],
                strength: [strength],
                softening: [point.softening],
                guess: [0.0],
            });
            let kept = point.softening * end.strength[0] / q(elastic);
            Point { stress: elastic.map(|s| kept * s), strain: point.strain + end.increment[0], ..point }
        }
    }

    const VIRGIN: Point = Point { stress: [0.0; TENSOR], strain: 0.0, softening: 1.0 };
    /// To five times the strain of first yield, and on across it.
    const PRESS: Tensor = [1.1, 1.3, -2.4, 0.0, 0.2, 0.9];
    const SLIDE: Tensor = [-0.3, 0.1, 0.2, 0.4, 0.7, 1.2];

    #[test]
    fn a_proportional_path_ends_where_the_radial_return_does() {
        for law in LAWS {
            let solid = solid(law);
            let by_path = walk(VIRGIN, &PRESS, 1, closed_form(&solid));
            let by_return = walk(VIRGIN, &PRESS, 1, radial_return(&solid));
            assert!(by_path.strain > 1e-3);
            assert!((by_path.strain / by_return.strain - 1.0).abs() < 1e-12);
            assert!(distance(&by_path.stress, &by_return.stress) < 1e-12);
        }
    }

    /// Of a yield surface that keeps its size the solution is exact: a path may be cut anywhere. From the virgin
    /// state, from yield, and from yield back through the elastic inside.
    #[test]
    fn without_hardening_one_step_is_as_good_as_many() {
        let solid = solid(Hardening::None);
        let yielded = walk(VIRGIN, &PRESS, 1, closed_form(&solid));
        for (from, change) in [(VIRGIN, SLIDE), (yielded, SLIDE), (yielded, PRESS.map(|s| -0.6 * s))] {
            let change = plus(&change, 0.3, &SLIDE);
            let [one, many] = [1, 7].map(|steps| walk(from, &change, steps, closed_form(&solid)));
            assert!(one.strain > from.strain);
            assert!(distance(&one.stress, &many.stress) < 1e-12, "{one:?} {many:?}");
            assert!((one.strain - many.strain).abs() < 1e-12);
        }
    }

    /// Against the limit of the radial return, of which each step is wrong to first order; with hardening the
    /// closed form is wrong to second order, and much less from the first step on.
    #[test]
    fn steps_converge_to_the_limit_of_the_radial_return() {
        for law in LAWS {
            let solid = solid(law.clone());
            let from = walk(VIRGIN, &PRESS, 1, closed_form(&solid));
            let at = |steps| walk(from, &SLIDE, steps, radial_return(&solid));
            // Error a/n + b/n².
            let (n, half, fourth) = (at(16384), at(8192), at(4096));
            let limit: Tensor =
                std::array::from_fn(|i| (8.0 * n.stress[i] - 6.0 * half.stress[i] + fourth.stress[i]) / 3.0);
            let error = |point: Point| distance(&point.stress, &limit);
            let closed = |steps| error(walk(from, &SLIDE, steps, closed_form(&solid)));
            let of_return = error(at(1));
            assert!(of_return > 0.02, "{of_return}");
            match law {
                Hardening::None => assert!(closed(1) < 1e-9, "{}", closed(1)),
                _ => {
                    assert!(closed(1) < 0.05 * of_return, "{law:?}: {} {of_return}", closed(1));
                    let ratio = closed(8) / closed(16);
                    assert!((3.0..5.0).contains(&ratio), "{law:?}: {ratio}");
                }
            }
        }
    }

    /// A strength that falls in the step, as one that melts: on the yield surface of the end, continuous, and without
    /// anything that is not a number.
    #[test]
    fn softening_pulls_the_stress_along() {
        for law in LAWS {
            let solid = solid(law);
            let yielded = walk(VIRGIN, &PRESS, 1, closed_form(&solid));
            for softening in [0.999, 0.8, 1e-9, 0.0] {
                let hot = Point { softening, ..yielded };
                for change in [[0.0; TENSOR], SLIDE.map(|s| 1e-9 * s), SLIDE, PRESS.map(|s| -1e-4 * s)] {
                    let elastic = plus(&hot.stress, 1.0, &change);
                    let end = flow(&solid, hot, &elastic);
                    let strength = softening * solid.hardened(hot.strain + end.increment[0]).0;
                    let stress = end.direction.map(|[n]| end.radius[0] * n);
                    assert!((q(&stress) - strength).abs() < 1e-12, "{softening} {change:?}");
                    let direction = end.direction.map(|[n]| n);
                    assert!((inner(&direction, &direction) - 1.0).abs() < 1e-9, "{softening} {change:?}");
                    assert!((0.0..=1.0).contains(&end.across[0]) && end.increment[0] >= 0.0);
                }
                // As much turned as if the surface had shrunk little by little.
                let many = 1000;
                let slowly = (1..=many).fold(yielded, |point, n| {
                    let share = n as f64 / many as f64;
                    let point = Point { softening: 1.0 + share * (softening - 1.0), ..point };
                    walk(point, &SLIDE.map(|s| s / many as f64), 1, closed_form(&solid))
                });
                let at_once = walk(hot, &SLIDE, 1, closed_form(&solid));
                let of_return = walk(hot, &SLIDE, 1, radial_return(&solid));
                let error = |point: Point| distance(&point.stress, &slowly.stress);
                if softening >= 0.8 {
                    assert!(
                        error(at_once) < 0.2 * error(of_return),
                        "{} {}",
                        error(at_once),
                        error(of_return)
                    );
                }
            }
        }
    }

    /// From the virgin state the derivative across the stress is exact; otherwise it is so in short steps.
    #[test]
    fn derivative_across_the_stress() {
        for law in LAWS {
            let solid = solid(law);
            let yielded = walk(VIRGIN, &PRESS, 1, closed_form(&solid));
            for (from, change) in [(VIRGIN, PRESS), (yielded, SLIDE)] {
                let elastic = plus(&from.stress, 1.0, &change);
                // Across the plane of stress and path.
                let mut across = [0.3, -0.2, -0.1, 0.5, 0.4, -0.3];
                let s = from.stress;
                let bend = plus(&s, -inner(&s, &change) / inner(&change, &change), &change);
                for along in [change, bend] {
                    let square = inner(&along, &along);
                    if square > 1e-20 {
                        across = plus(&across, -inner(&across, &along) / square, &along);
                    }
                }
                let h = 1e-6;
                let [plus_h, minus_h] = [h, -h].map(|h| {
                    let point = closed_form(&solid)(from, &plus(&elastic, h, &across));
                    point.stress
                });
                let derivative = plus(&plus_h, -1.0, &minus_h).map(|s| s / (2.0 * h));
                let expected = flow(&solid, from, &elastic).across[0];
                assert!(expected < 0.9);
                let apart = distance(&derivative, &across.map(|a| expected * a));
                assert!(apart < 1e-7, "{apart} {expected}");
            }
        }
    }
}
