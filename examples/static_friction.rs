//! Static friction of an elastic–plastic sphere at held load, in full stick and with a limited shear strength, beside
//! Brizmer, Kligerman & Etsion 2007 and Kogut & Etsion 2003.
//!
//! Sliding begins where the tangential stiffness is lost. Prints Q/P where the stiffness has fallen to 10, 5, 2 and 1 % of its
//! first value, on two meshes; a dash where the slide ends before, without convergence or before sliding. `light`
//! has the interferences around first yield at shear strength, `coarse` one interference on one mesh.
//!
//!     cargo run --release -p examples --example static_friction [light | coarse]

use asperity::scene::file::parse_scene;
use asperity::simulate::outcome::Outcome;
use asperity::simulate::{SimulationError, Unwatched, simulate};
use tables::closed_forms::{brizmer, kogut_etsion};
use tables::quantity::Quantity;

/// E, Pa, ν and σ_Y, Pa.
const BODY: (f64, f64, f64) = (200e9, 0.3, 200e6);
const INTERFERENCES: [f64; 4] = [3.0, 10.0, 30.0, 100.0];
/// Around those of Kogut & Etsion.
const LIGHT: [f64; 6] = [0.3, 0.6, 1.0, 2.0, 4.0, 6.0];
const SHARES: [f64; 4] = [0.1, 0.05, 0.02, 0.01];

/// Law of the interface, H/E, elements per contact radius.
type Case = (&'static str, f64, usize);

const CASES: [Case; 5] = [
    ("full-stick", 0.02, 6),
    ("full-stick", 0.0005, 8),
    ("full-stick", 0.0005, 6),
    ("shear-strength", 0.0005, 6),
    ("shear-strength", 0.0005, 8),
];

fn main() -> anyhow::Result<()> {
    let (interferences, cases) = match std::env::args().nth(1).as_deref() {
        Some("light") => (&LIGHT[..], &CASES[4..]),
        Some("coarse") => (&INTERFERENCES[1..2], &CASES[2..4]),
        _ => (&INTERFERENCES[..], &CASES[..]),
    };
    for &case in cases {
        let (law, hardening, elements) = case;
        println!("{law}, H = {hardening} E, {elements} elements");
        println!(
            "  omega/omega_c     10 %      5 %      2 %      1 %   at the end   Brizmer et al.   Kogut & Etsion"
        );
        for &omega in interferences {
            let outcome = slide(case, omega)?;
            let at =
                |share| outcome.friction_at_stiffness(share).map_or("-".to_owned(), |mu| format!("{mu:.3}"));
            let [ten, five, two, one] = SHARES.map(at);
            let end = outcome.slide.state(outcome.slide.len() - 1);
            println!(
                "  {omega:>13} {ten:>8} {five:>8} {two:>8} {one:>8} {:>12.3} {:>16.3} {:>16.3}",
                end[Quantity::Friction] / end[Quantity::Load],
                brizmer_at(omega),
                kogut_etsion::static_friction(omega),
            );
        }
    }
    Ok(())
}

/// μ_s of Brizmer et al. at ω₀/ω_c, with ω_c of the frictionless sphere.
fn brizmer_at(omega: f64) -> f64 {
    let over_stick = omega / brizmer::critical_interference_ratio(BODY.1);
    brizmer::static_friction(brizmer::load(over_stick, BODY.1))
}

/// Over 0.02 contact radii, or up to where it does not converge.
fn slide((law, hardening, elements): Case, omega: f64) -> anyhow::Result<Outcome> {
    let (youngs, poisson, strength) = BODY;
    // At slip rate 0 thermal constants have no effect.
    let text = format!(
        "[material]\nyoungs_modulus = {youngs:?}\npoisson_ratio = {poisson}\nyield_strength = {strength:?}\n\
         hardening = {{ law = \"linear\", modulus = {:?} }}\ndensity = 7850.0\nspecific_heat = 475.0\n\
         thermal_conductivity = 45.0\nthermal_expansion = 0.0\n[asperity]\nradius = 1e-3\n\
         [interface]\nlaw = \"{law}\"\n[loading]\ninterference = {omega:?}\nslip_rate = 0\nslip_distance = 0.02\n\
         control = \"load\"\n[model]\nkinematics = \"small\"\n\
         [numerics]\nelements_per_radius = {elements}\nsectors = 4\n",
        hardening * youngs
    );
    match simulate(&parse_scene(&text, "this example", &[])?, &Unwatched) {
        Err(SimulationError::NotConverged { partial: Some(outcome), .. }) => Ok(*outcome),
        outcome => Ok(outcome?),
    }
}
