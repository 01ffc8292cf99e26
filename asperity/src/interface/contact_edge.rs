//! Position of the contact edge between two rings of nodes (book, "Contact", whose symbols are used here).
//!
//! Rings touch one after the other, so the discrete contact grows in jumps, while the edge of the continuous contact
//! moves on between them. With k the last ring in contact, two ratios locate it: y_p = p_k/p_{k−1}, the pressure of ring k
//! over that of the ring inside it, and y_g = g_{k+1}/(g_{k+2} − g_{k+1}), the gap of ring k + 1 over the rise of the gap
//! from there to ring k + 2 (at equal ring spacings). While the edge passes from where ring k comes into contact (ζ = 0) to where
//! ring k + 1 does (ζ = 1), y_p rises from 0 and y_g falls to 0:
//!
//! ```text
//! y_p/y_1 = (1 + c_p) ζ − c_p ζ²,   y_g/y_2 = 1 − (1 − c_g) ζ − c_g ζ²
//! ```
//!
//! y_1 and y_2 are linear in the bluntness b of the edge: 0 for the square root of elastic contact (p ∝ √(a − r) inside,
//! g ∝ (r − a)^{3/2} outside), 1 for the almost uniform pressure of plastic contact. The bluntness is that at which both
//! ratios give the same ζ. The edge is at x₀ + ζ ring spacings from ring k.
//!
//! A radial shear traction τ_r that ends at the edge inclines the surface: at the distance x beyond the edge the slope of the
//! gap is K_g √x + c_ν τ_r. Where the traction points into the contact, at the leading edge of the asperity, τ_r is negative,
//! and the contact continues in a zone of vanishing pressure, in which the shear traction falls from its limit to zero. The
//! edge is further out by Δx = c_τ |c_ν τ_r|/(K_g √h) ring spacings, h the ring spacing.

use tables::functions::bisect;

use crate::scene::fitted_constants::contact_edge::{EdgeConstants, LinearInBluntness};

/// Tolerance of the difference of the two values of ζ.
const ROUNDING: f64 = 1e-9;

/// Ratios of pressures, gaps and slopes near the last ring in contact, which locate the edge.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EdgeRatios {
    /// y_p.
    pub pressure: f64,
    /// y_g.
    pub gap: f64,
    /// c_ν τ_r over the slope of the gap between rings k + 1 and k + 2.
    pub shear_slope: f64,
}

impl EdgeConstants {
    /// x₀ + ζ + Δx: position of the edge in ring spacings from the last ring in contact; without shear −0.27 to 0.73.
    pub fn position(&self, ratios: &EdgeRatios) -> f64 {
        let position = self.position_without_shear(ratios);
        position + self.shear_shift * shear_number(ratios, position)
    }

    /// x₀ + ζ, from y_p and y_g alone.
    pub fn position_without_shear(&self, &EdgeRatios { pressure, gap, .. }: &EdgeRatios) -> f64 {
        // ζ from y_p falls and ζ from y_g rises with the bluntness. By bisection: hot slides amplify the rounding of
        // faster methods.
        let [low, high] = bisect([0.0, 1.0], 40, |bluntness| {
            let (from_pressure, from_gap) = self.zeta(pressure, gap, bluntness);
            // Where a ring has just touched, both are 0 or both 1 over an interval: its upper end is taken.
            from_pressure >= from_gap - ROUNDING
        });
        let (from_pressure, from_gap) = self.zeta(pressure, gap, 0.5 * (low + high));
        // Where no bluntness gives equal values: 1 where the next ring touches and 0 where the last one does, so that the
        // edge does not jump.
        let sum = from_pressure + (1.0 - from_gap);
        self.first_position + if sum > ROUNDING { from_pressure / sum } else { 1.0 }
    }

    /// ζ from y_p and from y_g.
    fn zeta(&self, pressure: f64, gap: f64, bluntness: f64) -> (f64, f64) {
        let at = |constant: LinearInBluntness| constant[0] + constant[1] * bluntness;
        let (c_p, c_g) = (self.pressure_curvature, self.gap_curvature);
        let pressure = (pressure / at(self.largest_pressure_ratio)).clamp(0.0, 1.0);
        let gap = (gap / at(self.largest_gap_ratio)).clamp(0.0, 1.0);
        let from_pressure =
            2.0 * pressure / ((1.0 + c_p) + ((1.0 + c_p).powi(2) - 4.0 * c_p * pressure).max(0.0).sqrt());
        let closed = 1.0 - gap;
        let from_gap =
            2.0 * closed / ((1.0 - c_g) + ((1.0 - c_g).powi(2) + 4.0 * c_g * closed).max(0.0).sqrt());
        (from_pressure, from_gap)
    }
}

/// |c_ν τ_r|/(K_g √h) where τ_r is negative, with K_g from the slope of the gap midway between rings k + 1 and k + 2; `position`
/// is x₀ + ζ.
pub fn shear_number(ratios: &EdgeRatios, position: f64) -> f64 {
    let shear_slope = ratios.shear_slope.min(0.0);
    -shear_slope * (1.5 - position).sqrt() / (1.0 - shear_slope)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::fitted_constants::contact_edge::FITTED;

    /// y_p before a ring touches and y_g afterwards, measured in presses and slides.
    const TOUCHING: [(f64, f64); 4] = [(0.62, 0.69), (0.71, 0.75), (0.82, 0.82), (0.90, 0.86)];

    #[test]
    fn edge_is_continuous_as_a_ring_touches() {
        for (pressure, gap) in TOUCHING {
            let at = |pressure, gap| FITTED.position(&EdgeRatios { pressure, gap, shear_slope: 0.0 });
            let (before, after) = (at(pressure, 0.0), 1.0 + at(0.0, gap));
            assert!((before - after).abs() < 1e-6, "{before} {after}");
        }
    }

    /// The slope of a gap (2/3) K_g x^{3/2} + c_ν τ_r x and the position of its edge give c_ν τ_r/(K_g √h) back.
    #[test]
    fn shear_number_is_that_of_the_gap() {
        let (stiffness, inclination) = (0.8, -0.3);
        for position in [-0.2, 0.1, 0.6] {
            let opening = stiffness * f64::sqrt(1.5 - position) + inclination;
            let ratios = EdgeRatios { shear_slope: inclination / opening, ..EdgeRatios::default() };
            assert!((shear_number(&ratios, position) + inclination / stiffness).abs() < 1e-12);
            assert_eq!(shear_number(&EdgeRatios { shear_slope: 0.3, ..ratios }, position), 0.0);
        }
    }

    /// Hertz's contact: position of the edge measured against a, y_p and y_g at n_c = 8.
    #[test]
    fn elastic_edges_are_found() {
        for (exact, pressure, gap) in
            [(0.700, 0.619, 0.031), (0.433, 0.495, 0.263), (0.167, 0.342, 0.453), (-0.10, 0.151, 0.611)]
        {
            let position = FITTED.position(&EdgeRatios { pressure, gap, shear_slope: 0.0 });
            assert!((position - exact).abs() < 0.04, "{exact}: {position}");
        }
    }
}
