//! Place of the contact edge between two rings of nodes.
//!
//! Rings touch one after the other, so the discrete contact grows in jumps, while the edge of the continuous contact
//! moves on between them. Two ratios locate it: ρ = p_k/p_{k−1}, the pressure of the last ring in contact over that of
//! the ring inside it, and γ, the gap of the next ring over the rise of the gap from there to the one beyond. While
//! the edge passes from where the last ring touches (t = 0) to where the next one will (t = 1), ρ rises from 0 and γ
//! falls to 0:
//!
//! ```text
//! ρ/ρ₁ = (1 + p) t − p t²,   1 − γ/γ₀ = (1 − q) t + q t²
//! ```
//!
//! ρ₁ and γ₀ depend on the bluntness of the edge: 0 for the square root of elastic contact (p ∝ √x inside, gap ∝ x^{3/2}
//! outside), 1 for the almost constant pressure of a plastic one. The bluntness is that at which both ratios give the same
//! t.
//!
//! A shear traction that ends at the edge inclines the surface: at the distance x beyond the edge the slope of the gap is
//! K√x + s. Where the traction points into the contact, at the front of the sliding asperity, s is negative, and the
//! contact continues in a foot with vanishing pressure, in which the shear traction falls from its limit to zero. The edge is
//! further out by c |s|/(K√h), h the ring spacing.

use tables::functions::bisect;

use crate::scene::fitted_constants::contact_edge::{Blunt, EdgeConstants};

/// Tolerance of the difference of the two values of t.
const ROUNDING: f64 = 1e-9;

/// What locates the edge.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EdgeRatios {
    /// ρ.
    pub load: f64,
    /// γ.
    pub gap: f64,
    /// s over the slope of the gap between the next two rings.
    pub shear: f64,
}

impl EdgeConstants {
    /// Place of the edge in ring spacings from the last ring in contact; without shear −0.27 to 0.73.
    pub fn place(&self, ratios: &EdgeRatios) -> f64 {
        let place = self.place_without_shear(ratios);
        place + self.shear_shift * shear_number(ratios, place)
    }

    /// From ρ and γ alone.
    pub fn place_without_shear(&self, &EdgeRatios { load, gap, .. }: &EdgeRatios) -> f64 {
        // t from ρ falls and t from γ rises with the bluntness. By bisection: hot slides amplify the rounding of
        // faster methods.
        let [low, high] = bisect([0.0, 1.0], 40, |bluntness| {
            let (from_load, from_gap) = self.passed(load, gap, bluntness);
            // Where a ring has just touched, both are 0 or both 1 over an interval: its upper end is taken.
            from_load >= from_gap - ROUNDING
        });
        let (from_load, from_gap) = self.passed(load, gap, 0.5 * (low + high));
        // Where no bluntness gives equal values: 1 where the next ring touches and 0 where the last one does, so that the
        // edge does not jump.
        let sum = from_load + (1.0 - from_gap);
        self.first_place + if sum > ROUNDING { from_load / sum } else { 1.0 }
    }

    /// t from ρ and from γ.
    fn passed(&self, load: f64, gap: f64, bluntness: f64) -> (f64, f64) {
        let at = |constant: Blunt| constant[0] + constant[1] * bluntness;
        let (p, q) = (self.load_curvature, self.gap_curvature);
        let load = (load / at(self.full_load)).clamp(0.0, 1.0);
        let gap = (gap / at(self.open_gap)).clamp(0.0, 1.0);
        let from_load = 2.0 * load / ((1.0 + p) + ((1.0 + p).powi(2) - 4.0 * p * load).max(0.0).sqrt());
        let closed = 1.0 - gap;
        let from_gap = 2.0 * closed / ((1.0 - q) + ((1.0 - q).powi(2) + 4.0 * q * closed).max(0.0).sqrt());
        (from_load, from_gap)
    }
}

/// |s|/(K√h) where s is negative, with K from the slope of the gap midway between the next two rings.
pub fn shear_number(ratios: &EdgeRatios, place: f64) -> f64 {
    let shear = ratios.shear.min(0.0);
    -shear * (1.5 - place).sqrt() / (1.0 - shear)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::fitted_constants::contact_edge::FITTED;

    /// ρ before a ring touches and γ afterwards, measured in presses and slides.
    const TOUCHING: [(f64, f64); 4] = [(0.62, 0.69), (0.71, 0.75), (0.82, 0.82), (0.90, 0.86)];

    #[test]
    fn edge_is_continuous_as_a_ring_touches() {
        for (load, gap) in TOUCHING {
            let at = |load, gap| FITTED.place(&EdgeRatios { load, gap, shear: 0.0 });
            let (before, after) = (at(load, 0.0), 1.0 + at(0.0, gap));
            assert!((before - after).abs() < 1e-6, "{before} {after}");
        }
    }

    /// The slope of a gap (2/3) K x^{3/2} + s x and the place of its edge give s/(K√h) back.
    #[test]
    fn shear_number_is_that_of_the_gap() {
        let (stiffness, inclination) = (0.8, -0.3);
        for place in [-0.2, 0.1, 0.6] {
            let opening = stiffness * f64::sqrt(1.5 - place) + inclination;
            let ratios = EdgeRatios { shear: inclination / opening, ..EdgeRatios::default() };
            assert!((shear_number(&ratios, place) + inclination / stiffness).abs() < 1e-12);
            assert_eq!(shear_number(&EdgeRatios { shear: 0.3, ..ratios }, place), 0.0);
        }
    }

    /// Hertz's contact: place measured against a, ρ and γ at n_c = 8.
    #[test]
    fn elastic_edges_are_found() {
        for (exact, load, gap) in
            [(0.700, 0.619, 0.031), (0.433, 0.495, 0.263), (0.167, 0.342, 0.453), (-0.10, 0.151, 0.611)]
        {
            let place = FITTED.place(&EdgeRatios { load, gap, shear: 0.0 });
            assert!((place - exact).abs() < 0.04, "{exact}: {place}");
        }
    }
}
