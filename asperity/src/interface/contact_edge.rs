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
//! ρ₁, γ₀, p and q depend on the bluntness of the edge: 0 for the square root of elastic contact (p ∝ √x inside, gap
//! ∝ x^{3/2} outside), 1 for the almost constant pressure of a plastic one. The bluntness is that at which both ratios
//! give the same t. Constants: [`crate::scene::fitted_constants::contact_edge`].

use crate::scene::fitted_constants::contact_edge::{
    Blunt, FIRST_PLACE, FULL_LOAD, GAP_CURVATURE, LOAD_CURVATURE, OPEN_GAP,
};

/// Tolerance of the difference of the two values of t.
const ROUNDING: f64 = 1e-9;

fn at(constant: Blunt, bluntness: f64) -> f64 {
    constant[0] + constant[1] * bluntness
}

/// t from ρ and from γ.
fn passed(load: f64, gap: f64, bluntness: f64) -> (f64, f64) {
    let (p, q) = (at(LOAD_CURVATURE, bluntness), at(GAP_CURVATURE, bluntness));
    let load = (load / at(FULL_LOAD, bluntness)).clamp(0.0, 1.0);
    let gap = (gap / at(OPEN_GAP, bluntness)).clamp(0.0, 1.0);
    let from_load = 2.0 * load / ((1.0 + p) + ((1.0 + p).powi(2) - 4.0 * p * load).max(0.0).sqrt());
    let closed = 1.0 - gap;
    let from_gap = 2.0 * closed / ((1.0 - q) + ((1.0 - q).powi(2) + 4.0 * q * closed).max(0.0).sqrt());
    (from_load, from_gap)
}

/// Place of the edge in ring spacings from the last ring in contact, −0.38 to 0.70, from ρ and γ.
pub fn place(load: f64, gap: f64) -> f64 {
    // t from ρ falls and t from γ rises with the bluntness. By bisection: hot slides amplify the rounding of
    // faster methods.
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        let (from_load, from_gap) = passed(load, gap, middle);
        // Where a ring has just touched, both are 0 or both 1 over an interval: its upper end is taken.
        if from_load >= from_gap - ROUNDING {
            low = middle;
        } else {
            high = middle;
        }
    }
    let bluntness = 0.5 * (low + high);
    let (from_load, from_gap) = passed(load, gap, bluntness);
    at(FIRST_PLACE, bluntness) + 0.5 * (from_load + from_gap)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ρ before a ring touches and γ afterwards, measured in presses.
    const TOUCHING: [(f64, f64); 4] = [(0.575, 0.715), (0.65, 0.765), (0.70, 0.86), (0.775, 0.905)];

    #[test]
    fn edge_is_continuous_as_a_ring_touches() {
        for (load, gap) in TOUCHING {
            let (before, after) = (place(load, 0.0), 1.0 + place(0.0, gap));
            assert!((before - after).abs() < 0.03, "{before} {after}");
        }
    }

    /// Hertz's contact: place measured against a, ρ and γ at n_c = 8.
    #[test]
    fn elastic_edges_are_found() {
        for (exact, load, gap) in
            [(0.65, 0.580, 0.070), (0.50, 0.512, 0.202), (0.20, 0.351, 0.425), (-0.10, 0.150, 0.605)]
        {
            assert!((place(load, gap) - exact).abs() < 0.03, "{exact}: {}", place(load, gap));
        }
    }
}
