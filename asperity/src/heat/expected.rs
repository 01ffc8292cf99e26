//! Whether heat need be simulated, and act back on the contact.

use crate::loading::problem::{Problem, SHEAR_RATIO};
use crate::material::Solid;
use crate::scene::{Scene, Switch};

/// Heat acts back unless what that changes is below this share of the asked accuracy.
const ONE_WAY_SHARE: f64 = 0.05;
/// Change of the load over (1 + ν)α Δθ a/ω: measured 2.1, 2.9 and 3.3 at 0.5, 5 and 40 omega_c (4340 and 1045 steel,
/// copper).
const LOAD_OF_EXPANSION: f64 = 3.0;

/// What the simulation does about heat.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Heat {
    ModellingError,
    /// Temperatures follow from a contact that does not know them.
    OneWay,
    /// Temperatures soften and expand the contact.
    Coupled,
}

/// What frictional heat is expected to do to a contact that slides steadily.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeatEffect {
    /// f_h τ₀ V a/k, K: the rise in the middle of a disc source, Carslaw & Jaeger §10.5.
    pub rise: f64,
    /// Share of the strength, and with it of friction, that goes at this rise.
    pub softening: f64,
    /// Share by which expansion and softening moduli change the load at a held interference.
    pub load: f64,
}

impl HeatEffect {
    /// At a slip rate (m/s) and the radius of the contact (m).
    pub fn expected(scene: &Scene, slip_rate: f64, contact_radius: f64) -> Self {
        let (material, interface) = (&scene.material, &scene.interface);
        let strength = interface.strength_factor * SHEAR_RATIO * material.yield_strength;
        let rise =
            interface.heat_partition * strength * slip_rate * contact_radius / material.thermal_conductivity;
        let solid = Solid::new(material, scene.loading.temperature);
        let problem = Problem::new(scene);
        let bulge = (1.0 + material.poisson_ratio) * solid.mean_expansion(0.0, rise) * rise * contact_radius;
        let interference = problem.interference * problem.units.length;
        Self {
            rise,
            softening: (1.0 - solid.softening_factor(rise)).abs(),
            load: LOAD_OF_EXPANSION * bulge.abs() / interference + (1.0 - solid.stiffness_factor(rise)).abs(),
        }
    }

    /// Change of the friction coefficient.
    pub fn friction(&self) -> f64 {
        self.softening + self.load
    }

    fn in_words(&self) -> String {
        if self.softening >= 1.0 {
            return "at its full strength the contact would melt".into();
        }
        let load =
            if self.load < 1.0 { format!("by {:.2} %", 100.0 * self.load) } else { "altogether".into() };
        format!(
            "a rise of about {:.2} K takes {:.2} % of the strength and changes the load {load}",
            self.rise,
            100.0 * self.softening,
        )
    }
}

/// What is done about heat; says why.
pub fn choose_heat(scene: &Scene, slip_rate: f64, effect: &HeatEffect, notes: &mut Vec<String>) -> Heat {
    let modelling_error = |why: &str| (Heat::ModellingError, format!("heat is left out: {why}"));
    let (heat, note) = match scene.model.heat {
        Switch::Off => modelling_error("it is switched off"),
        _ if slip_rate == 0.0 => modelling_error("the slip rate is 0, the isothermal limit"),
        Switch::Auto if !scene.interface.law.has_friction() => modelling_error("there is no friction"),
        Switch::Auto if scene.interface.heat_partition == 0.0 => (
            Heat::OneWay,
            "heat does not act back: that of friction does not enter, that of plastic work is small".into(),
        ),
        Switch::Auto if effect.friction() < ONE_WAY_SHARE * scene.numerics.accuracy => {
            (Heat::OneWay, format!("heat does not act back: {}, which the errors include", effect.in_words()))
        }
        Switch::On | Switch::Auto => (Heat::Coupled, format!("heat is included: {}", effect.in_words())),
    };
    notes.push(note);
    heat
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::file::parse_scene;
    use crate::simulate::{Unwatched, simulate};

    fn scene(preset: &str, interference: f64, slip_rate: f64, heat: &str) -> Scene {
        let text = format!(
            "[material]\npreset = \"{preset}\"\n[asperity]\nradius = 1e-3\n\
             [loading]\ninterference = {interference:?}\nslip_rate = {slip_rate:?}\n\
             [model]\nheat = \"{heat}\"\nkinematics = \"small\"\n\
             [numerics]\naccuracy = 0.5\nelements_per_radius = 6\nsectors = 4\n"
        );
        parse_scene(&text, "this test", &[]).unwrap()
    }

    /// On one mesh heat that acts back changes load and friction by what was expected, and the same numbers without
    /// it state that error; the temperatures are the same but for the feedback.
    #[test]
    fn what_is_left_out_is_estimated() {
        for (preset, interference, slip_rate) in
            [("steel-4340", 0.5, 0.08), ("steel-1045", 5.0, 0.1), ("copper", 40.0, 2.0)]
        {
            let run =
                |heat: &str| simulate(&scene(preset, interference, slip_rate, heat), &Unwatched).unwrap();
            let [one_way, coupled, none] = ["auto", "on", "off"].map(run);
            assert!(one_way.account.notes.iter().any(|note| note.contains("does not act back")));
            assert!(coupled.account.notes.iter().any(|note| note.contains("heat is included")));
            let [one_way, coupled, none] = [one_way, coupled, none].map(|outcome| outcome.summary);
            for of in
                [|s: &crate::simulate::outcome::Summary| s.load, |s: &crate::simulate::outcome::Summary| s.mu]
            {
                let [one_way, coupled, none] = [&one_way, &coupled, &none].map(of);
                assert_eq!(one_way.value, none.value, "{preset}");
                let stated = one_way.error - none.error;
                let ratio = (one_way.value - coupled.value).abs() / stated;
                assert!((0.2..1.5).contains(&ratio), "{preset}: {ratio}");
            }
            let [alone, fed_back] = [&one_way, &coupled].map(|s| s.temperature_max);
            assert!(alone.value > none.temperature_max.value + 0.1);
            let apart = (alone.value - fed_back.value).abs();
            assert!(apart <= alone.error, "{preset}: {apart} K, {} stated", alone.error);
        }
    }

    /// The strength that goes is that of the law of softening, however steeply it begins.
    #[test]
    fn softening_is_that_of_the_law() {
        let mut scene = scene("steel-4340", 20.0, 1.0, "auto");
        let crate::scene::Softening::JohnsonCook { melting, exponent, .. } = &mut scene.material.softening
        else {
            panic!("a preset of Johnson and Cook")
        };
        *exponent = 0.5;
        let range = *melting - scene.loading.temperature;
        let effect = HeatEffect::expected(&scene, 0.01, 40e-6);
        assert!((effect.softening - (effect.rise / range).sqrt()).abs() < 1e-3, "{effect:?}");
        let number = 0.5 * SHEAR_RATIO * scene.material.yield_strength * 0.01 * 40e-6
            / (scene.material.thermal_conductivity * range);
        assert!((effect.rise / range / number - 1.0).abs() < 1e-12);
    }
}
