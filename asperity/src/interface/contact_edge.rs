//! Where the edge of the contact lies between two rings of nodes.
//!
//! Rings touch one after the other, so the discrete contact grows in jumps; the edge of the
//! continuous one moves on between. Two ratios tell where it is: that of the pressure of the last
//! ring to the one inside it, ρ, and that of the gap of the next ring to the rise from there to the
//! one beyond, γ. While the edge passes from where the last ring touches to where the next will, ρ
//! rises from 0 and γ falls to 0. How they do so depends on how blunt the edge is: between the
//! square root of elastic contact (p ∝ √x inside, gap ∝ x^{3/2} outside; bluntness 0) and the almost
//! constant pressure of a plastic one (bluntness 1). Both unknowns follow from both ratios.
//!
//! The constants are fitted to edges on meshes with rings up to eight times closer: presses from 0.2
//! to 100 ω_c with and without hardening, 6 to 12 elements per contact radius with the edge anywhere
//! between two rings, and slides from 5 to 60 ω_c, so that nothing jumps as a ring touches. They agree
//! with the presses to 0.07 ring spacings rms, and with single angles of slides to 0.04 to 0.08 (0.11
//! at 1 ω_c).

/// A constant for bluntness 0 and its change to bluntness 1.
type Blunt = [f64; 2];

/// ρ when the next ring touches.
const FULL_LOAD: Blunt = [0.5795, 0.1955];
/// γ when the last ring touches.
const OPEN_GAP: Blunt = [0.7082, 0.1904];
/// Place of the edge when the last ring touches, in ring spacings from that ring.
const FIRST_PLACE: Blunt = [-0.5048, 0.1264];
/// How far ρ and γ are from linear in the place of the edge.
const LOAD_CURVATURE: Blunt = [0.4002, 0.3001];
const GAP_CURVATURE: Blunt = [0.4492, 0.0004];

fn at(constant: Blunt, bluntness: f64) -> f64 {
    constant[0] + constant[1] * bluntness
}

/// Share of the way from one ring's touching to the next's that ρ and γ tell, each on its own.
fn passed(load: f64, gap: f64, bluntness: f64) -> (f64, f64) {
    let (p, q) = (at(LOAD_CURVATURE, bluntness), at(GAP_CURVATURE, bluntness));
    let load = (load / at(FULL_LOAD, bluntness)).clamp(0.0, 1.0);
    let gap = (gap / at(OPEN_GAP, bluntness)).clamp(0.0, 1.0);
    // Roots t of load = (1 + p)t − pt² and gap = 1 − (1 − q)t − qt².
    let from_load = 2.0 * load / ((1.0 + p) + ((1.0 + p).powi(2) - 4.0 * p * load).max(0.0).sqrt());
    let closed = 1.0 - gap;
    let from_gap = 2.0 * closed / ((1.0 - q) + ((1.0 - q).powi(2) + 4.0 * q * closed).max(0.0).sqrt());
    (from_load, from_gap)
}

const ROUNDING: f64 = 1e-9;

/// Place of the edge in ring spacings from the last ring in contact, −0.50 to 0.62, from ρ and γ.
pub fn place(load: f64, gap: f64) -> f64 {
    // The blunter the edge the less has it passed by its load, and the more by its gap.
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        let (from_load, from_gap) = passed(load, gap, middle);
        // Both 0 or both 1 where a ring has just touched: blunt enough to make one of them so.
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

    /// ρ before a ring touches and γ after that, measured as the rings of presses touch.
    const TOUCHING: [(f64, f64); 4] = [(0.575, 0.715), (0.65, 0.765), (0.70, 0.86), (0.775, 0.905)];

    #[test]
    fn little_jumps_as_a_ring_touches() {
        for (load, gap) in TOUCHING {
            let (before, after) = (place(load, 0.0), 1.0 + place(0.0, gap));
            assert!((before - after).abs() < 0.03, "{before} {after}");
        }
    }

    /// Hertz's contact, edge measured against a: place, ρ, γ at n_c = 8.
    #[test]
    fn elastic_edges_are_found() {
        for (exact, load, gap) in
            [(0.498, 0.569, 0.012), (0.342, 0.515, 0.157), (0.034, 0.357, 0.418), (-0.338, 0.132, 0.639)]
        {
            assert!((place(load, gap) - exact).abs() < 0.07, "{exact}: {}", place(load, gap));
        }
    }
}
