//! Slides so fast that the contact heats up as far as its strength lets it.
//!
//! Problem: Ti-6Al-4V (Johnson–Cook exponent 0.8: infinite slope of the strength at the start) at
//! 10⁴ m/s, and a steel whose tabulated strength falls to nothing along kinks.
//! Source: frictional heat vanishes with the strength, at the latest at the melting point; so the
//! contact may approach that temperature and not pass it while plastic heat is left out.

use asperity::scene::file::parse_scene;
use asperity::scene::{FrictionLaw, Material, Softening};
use tables::quantity::Quantity;
use tests::{mesh, run, scene, steel_4340};

/// Hottest contact of a fast slide, of which every number must be finite.
fn hottest(material: Material, slip_rate: f64) -> f64 {
    let mut scene = scene(material, FrictionLaw::ShearStrength, 10.0, mesh(6, 8));
    scene.loading.slip_rate = slip_rate;
    scene.loading.slip_distance = 1.0;
    let outcome = run(&scene);
    for step in outcome.slide.states() {
        let numbers = [
            step[Quantity::Friction],
            step[Quantity::Load],
            step[Quantity::Area],
            step[Quantity::TemperatureMax],
            step[Quantity::PlasticStrainMax],
            step[Quantity::Work],
            step[Quantity::EnergyElastic],
            step[Quantity::HeatStored],
        ];
        assert!(numbers.iter().all(|x| x.is_finite()), "{step:?}");
        assert!(step[Quantity::Friction] >= 0.0 && step[Quantity::Load] > 0.0, "{step:?}");
    }
    outcome.slide.states().fold(0.0, |most, step| step[Quantity::TemperatureMax].max(most))
}

#[test]
fn titanium_nears_its_melting_point_and_stays_below() {
    let text = "[material]\npreset = \"titanium-6al4v\"\n[asperity]\nradius = 1e-3\n\
                [loading]\ninterference = 1\nslip_rate = 1\n";
    let titanium = parse_scene(text, "titanium", &[]).unwrap().material;
    let slow = hottest(titanium.clone(), 100.0);
    let fast = hottest(titanium, 1e4);
    println!("{slow:.0} K at 100 m/s, {fast:.0} K at 10 km/s");
    assert!(slow > 500.0 && fast > slow && fast <= 1878.0, "{slow} {fast}");
}

#[test]
fn kinks_of_tabulated_strength_are_no_obstacle() {
    let mut steel = steel_4340();
    steel.softening = Softening::Table {
        temperature: vec![298.0, 320.0, 321.0, 500.0, 501.0, 800.0],
        factor: vec![1.0, 1.0, 0.7, 0.65, 0.1, 0.0],
    };
    let hot = hottest(steel, 1000.0);
    println!("{hot:.0} K");
    assert!(hot > 500.0 && hot <= 800.0, "{hot}");
}
