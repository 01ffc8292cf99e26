//! Interferences and slip rates of a request that leaves them out.

use tables::closed_forms::jackson_green;

use crate::scene::Scene;

/// Largest contact radius over that of the asperity, after Jackson & Green (2005): the mesh still fits into the
/// hemisphere, with room for the contact to grow while it slides.
const LARGEST_CONTACT: f64 = 0.33;

/// ω₀/ω_c below the largest. Closest where friction departs from that of an elastic contact: from 0.9 on a contact that
/// sticks flows plastically, and G has a kink.
const INTERFERENCES: [f64; 19] = [
    0.1, 0.2, 0.4, 0.7, 0.9, 1.2, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 125.0, 250.0, 500.0, 1000.0, 2000.0,
    4000.0, 8000.0,
];

/// The largest interference is at least this factor above the one before.
const LEAST_RATIO: f64 = 1.3;

/// V, m/s: the isothermal limit, and at ratios that fall from 8 to 2.5, as the temperature rises faster. Values are interpolated
/// in the rise.
pub const SLIP_RATES: [f64; 6] = [0.0, 0.03, 0.25, 1.2, 4.0, 10.0];

/// Smallest ω₀/ω_c of the grid.
pub const SMALLEST_INTERFERENCE: f64 = INTERFERENCES[0];

/// Interferences of a grid from 0.1 ω_c to the largest interference that the hemisphere has room for, in all of the `scenes`.
pub fn interferences(scenes: &[Scene]) -> Vec<f64> {
    let largest = scenes.iter().map(largest_interference).fold(f64::INFINITY, f64::min);
    let mut grid: Vec<f64> =
        INTERFERENCES.into_iter().filter(|interference| interference * LEAST_RATIO < largest).collect();
    grid.push(largest);
    grid
}

/// ω₀/ω_c of [`LARGEST_CONTACT`], to two digits; at least 1.
fn largest_interference(scene: &Scene) -> f64 {
    let material = scene.with_combined_modulus().material.elastic_plastic();
    // a² = (A/A_c)·Rω_c; A/A_c is a power of ω/ω_c, of which the exponent is known from two values.
    let wanted = LARGEST_CONTACT * LARGEST_CONTACT / material.critical_interference(1.0);
    let area = |interference: f64| jackson_green::area(interference, material.yield_strain());
    let decade = 10.0 * jackson_green::ELASTIC_LIMIT;
    let exponent = (area(decade) / jackson_green::ELASTIC_LIMIT).log10();
    let found = jackson_green::ELASTIC_LIMIT * (wanted / jackson_green::ELASTIC_LIMIT).powf(1.0 / exponent);
    // Above the rounding a contact is a little larger than asked for.
    format!("{:.1e}", found.max(1.0)).parse().unwrap_or(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::file::write_request;
    use crate::scene::tests::{request, sphere};

    #[test]
    fn an_empty_section_asks_for_the_default_grid() {
        let of = |changes: &[&str]| request(&(sphere("steel-4340") + "[table]\n"), changes).unwrap();
        let empty = of(&[]);
        let expected = [0.1, 0.2, 0.4, 0.7, 0.9, 1.2, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 125.0, 250.0, 580.0];
        assert_eq!(empty.interferences, expected);
        assert_eq!(empty.slip_rates, SLIP_RATES);
        assert_eq!(request(&write_request(&empty), &[]).unwrap(), empty);
        // Without softening a hotter sphere has the same limit, with it a higher one: the lowest temperature decides.
        assert_eq!(of(&["table.temperature=[298, 900]"]).interferences, expected);
        // An interference of its own leaves the slip rates.
        let own = of(&["table.interference=3"]);
        assert_eq!((own.interferences, own.slip_rates.len()), (vec![3.0], SLIP_RATES.len()));
    }
}
