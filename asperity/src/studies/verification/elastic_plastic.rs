//! Frictionless press of an elastic–plastic sphere without hardening.
//!
//! R. L. Jackson & I. Green, J. Tribol. 127, 343 (2005), doi 10.1115/1.1866166; L. Kogut &
//! I. Etsion, J. Appl. Mech. 69, 657 (2002), doi 10.1115/1.1490373.

use tables::closed_forms::{hertz, jackson_green, kogut_etsion};

use super::setup::{Hertz, mesh, plain_material, scene};
use super::{Extent, Row, Rows};
use crate::scene::FrictionLaw;
use crate::simulate::{Watch, press};

const JACKSON_GREEN: &str = "Jackson & Green 2005, doi 10.1115/1.1866166";
const KOGUT_ETSION: &str = "Kogut & Etsion 2002, doi 10.1115/1.1490373";
/// The two differ from each other by up to 4.2 % in the load below 20 ω_c and 5 % at 100.
const SPREAD: f64 = 0.05;
const WHY: &str = "fits to finite elements: spread between the two";
const WHY_FLAT: &str = "spread between the fits, and what Jackson & Green give for a/R";
/// σ_Y/E*, at which a/R does not matter.
const SMALLEST_STRAIN: f64 = 0.001;

pub fn rows(extent: Extent, watch: &dyn Watch) -> Rows {
    let (strains, interferences): (&[f64], &[f64]) = match extent {
        Extent::Quick => (&[0.002], &[10.0]),
        Extent::Full => (&[0.001, 0.002, 0.005], &[1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0]),
    };
    let elements = extent.elements().min(12);
    let mut rows = Vec::new();
    for &strain in strains {
        for &omega in interferences {
            let mut scene = scene(plain_material(0.3), FrictionLaw::Frictionless, omega, mesh(elements, 4));
            let modulus = Hertz::of(&scene).modulus;
            let strength = strain * modulus;
            scene.material.yield_strength = strength;
            let critical_load = hertz::critical_load(modulus, 0.3, strength, scene.radius);
            let critical_area = hertz::critical_area(modulus, 0.3, strength, scene.radius);
            let contact = press(&scene, watch)?.contact();
            let mut row = |name: &str, value: (f64, f64), reference: f64, source, allowed, why| {
                let quantity = format!("{name} at {omega} omega_c, sigma_Y/E* = {strain}");
                rows.push(Row::new(quantity, value.0, value.1, reference, source).allow(allowed, why));
            };
            let load = (contact.load.value / critical_load, contact.load.error / critical_load);
            let area = (contact.area.value / critical_area, contact.area.error / critical_area);
            let of_load = |strain: f64| jackson_green::load(omega, strain, 0.3);
            let of_area = |strain: f64| jackson_green::area(omega, strain);
            // Kogut & Etsion have no a/R; what it does is known from the others.
            let slope = |of: &dyn Fn(f64) -> f64| SPREAD + (of(strain) / of(SMALLEST_STRAIN) - 1.0).abs();
            row("P/P_c", load, of_load(strain), JACKSON_GREEN, SPREAD, WHY);
            row("P/P_c", load, kogut_etsion::load(omega, 0.3), KOGUT_ETSION, slope(&of_load), WHY_FLAT);
            row("A/A_c", area, of_area(strain), JACKSON_GREEN, SPREAD, WHY);
            row("A/A_c", area, kogut_etsion::area(omega), KOGUT_ETSION, slope(&of_area), WHY_FLAT);
        }
    }
    Ok(rows)
}
