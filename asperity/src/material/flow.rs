//! Plastic flow along a straight path of strain, in closed form.
//!
//! Where the strain deviator moves straight on in a step, the stress deviator of a von Mises solid turns towards its
//! rate: dψ/dx = −sin ψ, with ψ the angle between them and dx = 2G|de|/R, R the radius of the yield surface. Hence
//! tan(ψ/2) falls as e^−x, and the stress stays in the plane of the two (Krieg & Krieg 1977, J. Pressure Vessel
//! Technol. 99, 510, doi:10.1115/1.3454568, for constant R). That is exact for any R(x) once x is known; here R is the
//! mean of its values at both ends, which is second order in the hardening or softening of a step. The radial return
//! takes the direction at the end for the whole step, which is first order in the rotation of the stress: in increments
//! of 0.3 of the slip up to 0.4 per cent of the static friction and five of the energy release, here a tenth of that.

use super::{Solid, Trial};
use crate::material::instruction_set::dispatch;
use crate::material::lanes::{Lanes, exponentials, lanes, logarithms};
use crate::scene::Hardening;

/// Components of a symmetric tensor: rr, θθ, zz, rθ, θz, zr.
const TENSOR: usize = 6;
/// √⅔: |s| over the von Mises stress, and the von Mises strain increment over |Δε_p|.
const TO_RADIUS: f64 = 0.816_496_580_927_726;

/// Strain path of W points from one state to the next. Results of lanes that do not flow are meaningless.
#[derive(Clone, Copy, Debug)]
pub struct StrainPath<'a, const W: usize> {
    pub trial: Trial<W>,
    /// Stress deviator at the start, on or below the strength there.
    pub start: &'a [Lanes<W>; TENSOR],
    /// Stress deviator at the end, if all of the strain were elastic.
    pub elastic: &'a [Lanes<W>; TENSOR],
}

/// The end of a strain path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flow<const W: usize> {
    /// Increment of the equivalent plastic strain: the length of the path of plastic strain.
    pub increment: Lanes<W>,
    /// σ_y(ε_p, T₀) at the reference strain rate.
    pub strength: Lanes<W>,
    /// dσ_y/dε_p at the temperature of the end, with the change of the strain rate.
    pub slope: Lanes<W>,
    /// |s|.
    pub radius: Lanes<W>,
    /// s/|s|.
    pub direction: [Lanes<W>; TENSOR],
    /// ∂s/∂e over 2G, across the plane in which the stress turns. In that plane the derivative is not symmetric and
    /// this value is used instead, which is exact for proportional loading.
    pub across: Lanes<W>,
}

/// The point of the path where the stress reaches the yield surface, and the rest of the path.
struct Onset<const W: usize> {
    /// Share of the path that is elastic.
    elastic: Lanes<W>,
    /// Radius of the yield surface there.
    radius: Lanes<W>,
    /// cos ψ there.
    cosine: Lanes<W>,
    /// 2G|Δe| of the whole path, and of the rest.
    length: Lanes<W>,
    left: Lanes<W>,
    /// |s| at the end of the path, if all of it were elastic.
    trial: Lanes<W>,
}

/// Rotation of the deviatoric stress: s/R = of_start·s_c/R_c + of_path·Δe/|Δe|.
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
    ///
    /// A strength that depends on the strain rate is the same during all of the flow of a step. The stress turns on the
    /// yield surface of the strain rate of the radial return; the increment ends on that of its own strain rate.
    pub fn flow<const W: usize>(&self, path: &StrainPath<W>) -> Flow<W> {
        dispatch! { <E, const W> fn(solid: &Solid = self, path: &StrainPath<W> = path) -> Flow<W> {
            solid.flow_at_rate(path)
        }}
    }

    #[inline(always)]
    fn flow_at_rate<const W: usize>(&self, path: &StrainPath<W>) -> Flow<W> {
        let trial = &path.trial;
        let Some(rate) = self.rate_over(trial.time_step) else { return self.flow_on(path, path) };
        let returned = self.return_map(trial, &path.elastic_stress());
        let (factor, _) = rate.factors(&returned.increment);
        let softening = lanes(|l| factor[l] * trial.softening[l]);
        let mut flow = self.flow_on(path, &StrainPath { trial: Trial { softening, ..*trial }, ..*path });
        let (factor, _) = rate.factors(&flow.increment);
        (0..W).for_each(|l| flow.strength[l] /= factor[l]);
        flow
    }

    /// The state at the end of a path, with the strength at the strain rate there; `turning` is the path with the yield
    /// surface on which the stress turns.
    #[inline(always)]
    fn flow_on<const W: usize>(&self, path: &StrainPath<W>, turning: &StrainPath<W>) -> Flow<W> {
        let onset = turning.onset();
        let mean = self.mean_radius(&turning.trial, &onset);
        let rotation = DeviatorRotation::new(&lanes(|l| onset.left[l] / mean[l]), &onset.cosine);
        let stress = lanes(|l| (onset.radius[l] + mean[l] * rotation.advance[l]) / TO_RADIUS);
        let end = self.return_map(&path.trial, &stress);
        let radius = lanes(|l| TO_RADIUS * path.trial.softening[l] * end.strength[l]);
        Flow {
            increment: end.increment,
            strength: end.strength,
            slope: end.slope,
            radius,
            direction: path.direction(&onset, &rotation),
            across: lanes(|l| {
                let of_onset = rotation.of_start[l] * onset.elastic[l] / onset.radius[l];
                let of_path = rotation.of_path_over_x[l] * (1.0 - onset.elastic[l]) / mean[l];
                (radius[l] * (of_onset + of_path)).min(1.0)
            }),
        }
    }

    /// Mean radius of the yield surface during flow: of its values at the onset and at the end, the latter that of the
    /// radial return after one Newton iteration.
    #[inline(always)]
    fn mean_radius<const W: usize>(&self, trial: &Trial<W>, onset: &Onset<W>) -> Lanes<W> {
        let mut end: Lanes<W> = lanes(|l| TO_RADIUS * trial.softening[l] * trial.strength[l]);
        if !matches!(self.hardening, Hardening::None) {
            let stiffness = 2.0 * self.moduli.shear / TO_RADIUS;
            // Upper bound: hardening takes up none of the stress.
            let most: Lanes<W> = lanes(|l| (onset.trial[l] - end[l]).max(0.0) / stiffness);
            let strain: Lanes<W> = lanes(|l| trial.strain[l] + most[l]);
            let (strength, slope) = self.hardened_lanes(&strain);
            for l in 0..W {
                let factor = TO_RADIUS * trial.softening[l];
                let (radius, slope) = (factor * strength[l], factor * slope[l]);
                let back = (radius - end[l]) / (stiffness + slope);
                let hardened = (radius - slope * back).min(onset.trial[l]);
                end[l] = if most[l] > 0.0 { hardened } else { end[l] };
            }
        }
        // A molten point has no strength.
        lanes(|l| (0.5 * (onset.radius[l] + end[l])).max(1e-12 * onset.length[l]))
    }
}

impl<const W: usize> StrainPath<'_, W> {
    /// Von Mises stress at the end, if all of the strain were elastic.
    #[inline(always)]
    fn elastic_stress(&self) -> Lanes<W> {
        let mut squared = [0.0; W];
        for (i, component) in self.elastic.iter().enumerate() {
            let factor = if i < 3 { 1.5 } else { 3.0 };
            (0..W).for_each(|l| squared[l] += factor * component[l] * component[l]);
        }
        lanes(|l| squared[l].sqrt())
    }

    /// The yield surface has the radius of the strength at the temperature of the end, or shrinks to it linearly along
    /// the path if the start is outside.
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
            trial: lanes(|l| (start[l] + 2.0 * along[l] + length[l]).max(0.0).sqrt()),
        };
        for l in 0..W {
            let last = TO_RADIUS * self.trial.softening[l] * self.trial.strength[l];
            let first = start[l].sqrt().max(last);
            let shrinks = last - first;
            // |s₀ + td|² = (R₀ + tΔR)²: at² + 2bt + c = 0, with c ≤ 0 and, the end being outside, one root t < 1.
            let a = length[l] - shrinks * shrinks;
            let b = along[l] - first * shrinks;
            let c = if shrinks < 0.0 { 0.0 } else { (start[l] - first * first).min(0.0) };
            let root = (b * b - a * c).max(0.0).sqrt();
            let elastic = if b > 0.0 { -c / (root + b) } else { (root - b) / a };
            // Also where the path has no length, or rounding leaves no root.
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
    fn direction(&self, onset: &Onset<W>, rotation: &DeviatorRotation<W>) -> [Lanes<W>; TENSOR] {
        let (mut of_start, mut of_change) = ([0.0; W], [0.0; W]);
        for l in 0..W {
            of_start[l] = rotation.of_start[l] / onset.radius[l];
            let of_path = rotation.of_path[l] / onset.length[l].max(f64::MIN_POSITIVE);
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
    /// After x, from an angle of cosine c: by (cosh x + c sinh x)e^−x and so on, which cannot overflow.
    #[inline(always)]
    fn new(x: &Lanes<W>, cosine: &Lanes<W>) -> Self {
        let decay: Lanes<W> = exponentials(&lanes(|l| -x[l]));
        // (cosh x + c sinh x)e^−x.
        let sum: Lanes<W> = lanes(|l| 0.5 * (1.0 + cosine[l] + (1.0 - cosine[l]) * decay[l] * decay[l]));
        let log = logarithms(&sum);
        let mut rotation =
            Self { of_start: [0.0; W], of_path: [0.0; W], of_path_over_x: [0.0; W], advance: [0.0; W] };
        for l in 0..W {
            let (c, e) = (cosine[l], decay[l]);
            rotation.of_start[l] = e / sum[l];
            rotation.of_path[l] = 0.5 * (1.0 - e) * (1.0 + c + (1.0 - c) * e) / sum[l];
            rotation.of_path_over_x[l] = if x[l] > 1e-8 { rotation.of_path[l] / x[l] } else { 1.0 };
            rotation.advance[l] = x[l] + log[l];
        }
        rotation
    }
}

#[cfg(test)]
mod tests;
