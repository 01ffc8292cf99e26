//! Displacement of the mean plane by the nominal pressure: interaction of the summits to first order (Ciavarella,
//! Greenwood & Paggi 2008, Wear 265, 729).
//!
//! The contacts load the half-space as their mean pressure p does. A square nominal area of side L then moves by
//! w = c p L/E* in the mean, and all summits with it: they are pressed as by a flat at the effective separation d + w.

use crate::integral::separation::SeparationError;
use crate::integral::surface_integral::SurfaceIntegral;
use crate::surface::query::{Interaction, Query};
use tables::functions::{Accuracy, root_between};
use tables::law::{AsperityLaw, Estimate};

/// The mean plane of the summits, which yields to the nominal pressure or not.
#[derive(Clone, Copy, Debug, Default)]
pub struct MeanPlane {
    /// Displacement per nominal pressure, m/Pa; 0 where summits do not interact.
    compliance: f64,
}

/// c: mean of the displacement of a square under uniform pressure p, over p L/E*; that is
/// (4/π) [ln(1 + √2) − (√2 − 1)/3] = 0.9464, from the potential of a uniform square (Love 1929).
fn square() -> f64 {
    let root = std::f64::consts::SQRT_2;
    4.0 / std::f64::consts::PI * ((1.0 + root).ln() - (root - 1.0) / 3.0)
}

impl MeanPlane {
    pub fn new(query: &Query, law: &dyn AsperityLaw) -> Result<Self, SeparationError> {
        if query.interaction == Interaction::None {
            return Ok(Self::default());
        }
        let nominal_size = query.nominal_size.ok_or(SeparationError::NoNominalSize)?;
        let modulus = law.contact_modulus().ok_or_else(|| SeparationError::NoModulus { law: law.name() })?;
        Ok(Self { compliance: square() * nominal_size / modulus })
    }

    /// Displacement (m) under the nominal `pressure` (Pa).
    pub fn displacement(self, pressure: Estimate) -> Estimate {
        pressure.scaled(self.compliance)
    }

    /// Error (m) of the displacement at a given separation, from that of a `pressure` (Pa) that changes by `slope`
    /// (1/m) relatively.
    pub fn displacement_error(self, pressure: Estimate, slope: f64) -> f64 {
        self.displacement(pressure).error / self.relief(pressure.value, slope)
    }

    /// What errors are divided by at a given separation, as a higher pressure moves the plane away, which takes part of it
    /// back: 1 + |dw/dd|.
    pub fn relief(self, pressure: f64, slope: f64) -> f64 {
        1.0 + self.compliance * (slope * pressure).abs()
    }

    /// The effective separation (m) of a flat at `separation` (m) from the undisplaced plane, to the tolerance of the
    /// integral in standard deviations of the heights. It is unique, as the pressure falls with it.
    pub fn effective_separation(
        self,
        integral: &mut SurfaceIntegral,
        separation: f64,
    ) -> Result<f64, SeparationError> {
        if self.compliance == 0.0 {
            return Ok(separation);
        }
        let farthest = separation + self.compliance * integral.at(separation)?.pressure.value;
        if farthest == separation {
            return Ok(separation);
        }
        let width = 4.0 * f64::EPSILON * separation.abs().max(farthest.abs());
        let accuracy = Accuracy { value: integral.tolerance() * integral.standard_deviation(), width };
        let found = root_between(separation, farthest, accuracy, |effective| {
            let pressure = integral.at(effective)?.pressure.value;
            Ok::<_, SeparationError>(effective - separation - self.compliance * pressure)
        })?;
        found.ok_or(SeparationError::NoMeanPlane { separation, farthest })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integral::test_laws::{STEEL, asperity, query};
    use crate::surface::heights::Exponential;
    use crate::surface::query::NormalLoading;
    use crate::surface::radii::ByRadius;
    use tables::closed_forms::closed_form;

    /// Mean of Boussinesq's displacement p/(π E* r) over a unit square of `n` by `n` cells of uniform pressure, each
    /// with the closed displacement of its own centre and those of the others as point loads, over p L/E*.
    fn boussinesq(n: usize) -> f64 {
        let side = 1.0 / n as f64;
        // Displacement at the centre of a uniform square, (4/π) ln(1 + √2) times its side.
        let mut sum = 4.0 * (1.0 + 2f64.sqrt()).ln() * side * (n * n) as f64;
        for i in 0..n {
            for j in 0..n {
                if i + j > 0 {
                    // Pairs of cells at this offset, of either sign.
                    let signs = if i > 0 && j > 0 { 4 } else { 2 };
                    let pairs = (signs * (n - i) * (n - j)) as f64;
                    sum += pairs * side / ((i * i + j * j) as f64).sqrt();
                }
            }
        }
        sum / (n * n) as f64 / std::f64::consts::PI
    }

    #[test]
    fn the_mean_displacement_of_a_square_is_that_of_boussinesqs_point_loads() {
        // The error is of first order in the size of the cells.
        let extrapolated = 2.0 * boussinesq(400) - boussinesq(200);
        assert!((extrapolated / square() - 1.0).abs() < 5e-5, "{extrapolated}");
        // A circle of the same area, 16/(3 π^(3/2)) (Johnson 1985, §3.4), is 1.2 % softer.
        let circle = 16.0 / (3.0 * std::f64::consts::PI.powf(1.5));
        assert!((circle / square() - 1.012).abs() < 1e-3);
    }

    #[test]
    fn elastic_spheres_of_exponential_heights_have_the_effective_separation_of_lamberts_function() {
        // p = p₀ exp(−d_eff/σ), p₀ = η √π E* √R σ^(3/2) after Greenwood & Williamson:
        // d_eff = d + σ W(c p₀ L exp(−d/σ)/(E* σ)).
        let law = closed_form("hertz", &STEEL).unwrap();
        let (density, radius, sigma) = (1e9, 1e-4, 1e-9);
        let heights = Exponential::new(sigma);
        let asperities = ByRadius::of_classes(vec![(1.0, asperity(law.as_ref()))]);
        let mut integral = SurfaceIntegral::new(&asperities, &heights, density, 1e-12);
        let zero =
            density * std::f64::consts::PI.sqrt() * STEEL.contact_modulus() * (radius * sigma).sqrt() * sigma;
        let plane_of = |size: f64| {
            let asked = query(NormalLoading::Separation(vec![0.0]));
            let (interaction, nominal_size) = (Interaction::MeanPressure, Some(size));
            MeanPlane::new(&Query { interaction, nominal_size, ..asked }, law.as_ref()).unwrap()
        };
        for size in [1e-7, 1e-5, 1e-3, 1e-2] {
            let plane = plane_of(size);
            for place in [0.0, 1.0, 4.0] {
                let separation = place * sigma;
                let at = zero * (-place).exp() * square() * size / (STEEL.contact_modulus() * sigma);
                let exact = separation + sigma * puruspe::lambert_w0(at);
                let found = plane.effective_separation(&mut integral, separation).unwrap();
                assert!((found - exact).abs() < 1e-9 * sigma, "{size} {place}: {found:e} {exact:e}");
            }
        }
        // Displacements below the rounding error of the separation.
        let plane = plane_of(1e-2);
        for place in 20..50 {
            let separation = 1.1 * f64::from(place) * sigma;
            let found = plane.effective_separation(&mut integral, separation).unwrap();
            assert!((found - separation).abs() < 1e-6 * sigma, "{place}: {found:e}");
        }
    }
}
