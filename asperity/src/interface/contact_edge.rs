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

use crate::scene::fitted_constants::contact_edge::{
    Blunt, FIRST_PLACE, FULL_LOAD, GAP_CURVATURE, LOAD_CURVATURE, OPEN_GAP,
};

/// Tolerance of the difference of the two values of t.
const ROUNDING: f64 = 1e-9;

/// The constants of ρ and γ over t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeConstants {
    /// Place at t = 0, in ring spacings from the last ring in contact.
    pub first_place: f64,
    /// ρ₁.
    pub full_load: Blunt,
    /// p.
    pub load_curvature: f64,
    /// γ₀.
    pub open_gap: Blunt,
    /// q.
    pub gap_curvature: f64,
}

/// As fitted, see [`crate::scene::fitted_constants::contact_edge`].
pub const FITTED: EdgeConstants = EdgeConstants {
    first_place: FIRST_PLACE,
    full_load: FULL_LOAD,
    load_curvature: LOAD_CURVATURE,
    open_gap: OPEN_GAP,
    gap_curvature: GAP_CURVATURE,
};

impl EdgeConstants {
    /// Place of the edge in ring spacings from the last ring in contact, −0.27 to 0.73, from ρ and γ.
    pub fn place(&self, load: f64, gap: f64) -> f64 {
        // t from ρ falls and t from γ rises with the bluntness. By bisection: hot slides amplify the rounding of
        // faster methods.
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            let (from_load, from_gap) = self.passed(load, gap, middle);
            // Where a ring has just touched, both are 0 or both 1 over an interval: its upper end is taken.
            if from_load >= from_gap - ROUNDING {
                low = middle;
            } else {
                high = middle;
            }
        }
        let (from_load, from_gap) = self.passed(load, gap, 0.5 * (low + high));
        self.first_place + 0.5 * (from_load + from_gap)
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

#[cfg(test)]
mod tests {
    use super::*;

    /// ρ before a ring touches and γ afterwards, measured in presses and slides.
    const TOUCHING: [(f64, f64); 4] = [(0.62, 0.69), (0.71, 0.75), (0.82, 0.82), (0.90, 0.86)];

    #[test]
    fn edge_is_continuous_as_a_ring_touches() {
        for (load, gap) in TOUCHING {
            let (before, after) = (FITTED.place(load, 0.0), 1.0 + FITTED.place(0.0, gap));
            assert!((before - after).abs() < 0.03, "{before} {after}");
        }
    }

    /// Hertz's contact: place measured against a, ρ and γ at n_c = 8.
    #[test]
    fn elastic_edges_are_found() {
        for (exact, load, gap) in
            [(0.700, 0.619, 0.031), (0.433, 0.495, 0.263), (0.167, 0.342, 0.453), (-0.10, 0.151, 0.611)]
        {
            let place = FITTED.place(load, gap);
            assert!((place - exact).abs() < 0.04, "{exact}: {place}");
        }
    }
}
