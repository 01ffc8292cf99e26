//! Expected effect of heat on friction; it decides whether a slide is simulated with heat.
//!
//! Rise of temperature in the middle of a disc source, f_h τ₀ V a/k (Carslaw & Jaeger, Conduction of
//! Heat in Solids, 1959, §10.5), and its effects: softening changes the strength; thermal expansion and
//! softer moduli change the load at constant interference.

use tables::closed_forms::hertz;

use crate::material::{SHEAR_RATIO, Solid};
use crate::scene::fitted_constants::heat_effect::LOAD_OF_EXPANSION;
use crate::scene::{Scene, Switch};

/// Heat is left out where its expected effect on friction is below this share of the required accuracy.
const NEGLIGIBLE_SHARE: f64 = 1e-3;

/// Treatment of heat.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeatChoice {
    /// Temperatures soften and expand the contact.
    Coupled,
    Off(NoHeat),
}

/// Reason for leaving heat out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoHeat {
    SwitchedOff,
    /// V = 0, the isothermal limit.
    AtRest,
    NoFriction,
    /// The expected effect is far below the accuracy.
    Negligible,
}

impl HeatChoice {
    pub fn is_coupled(self) -> bool {
        self == Self::Coupled
    }
}

/// Expected effect of heat on a contact that slides steadily.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeatEffect {
    /// f_h τ₀ V a/k, K. Without frictional heat that of plastic work at most: β in place of f_h.
    pub rise: f64,
    /// Share of the strength, and with it of friction, that is lost at this rise.
    pub softening: f64,
    /// Share by which expansion and softening moduli change the load at constant interference.
    pub load: f64,
    /// Share of the strength that is lost when sliding begins.
    pub inception: f64,
    /// Depth that frictional heat has reached then, √(κt), over the contact radius.
    pub inception_depth: f64,
}

impl HeatEffect {
    /// At a slip rate (m/s) and the radius of the contact (m).
    pub fn expected(scene: &Scene, slip_rate: f64, contact_radius: f64) -> Self {
        let scene = &scene.with_combined_modulus();
        let (material, interface) = (&scene.material, &scene.interface);
        let solid = Solid::new(material, scene.loading.temperature);
        let strength = interface.strength_factor
            * SHEAR_RATIO
            * material.yield_strength
            * solid.interface_rate_factor(slip_rate, contact_radius);
        let share = match scene.largest_heat_partition() {
            0.0 => interface.taylor_quinney,
            partition => partition,
        };
        let rise = share * strength * slip_rate * contact_radius / material.thermal_conductivity;
        let modulus = hertz::contact_modulus(material.youngs_modulus, material.poisson_ratio);
        let critical =
            hertz::critical_interference(modulus, material.poisson_ratio, material.yield_strength, 1.0);
        let interference = scene.loading.interference * critical * scene.radius;
        let bulge = (1.0 + material.poisson_ratio) * solid.mean_expansion(0.0, rise) * rise * contact_radius;
        let initial = scene.loading.temperature;
        let softening = |rise: f64| {
            let film =
                interface.law.softening_factor(initial + rise) / interface.law.softening_factor(initial);
            (1.0 - solid.softening_factor(rise)).abs().max((1.0 - film).abs())
        };
        // Under the flux q of a plane the surface warms by 2q√(κt/π)/k in the time t of the elastic displacement
        // τ₀a(2 − ν)/(2G) at gross slip, with 2 − ν taken as 2.
        let shear_modulus = 0.5 * material.youngs_modulus / (1.0 + material.poisson_ratio);
        let diffusivity =
            material.thermal_conductivity / (material.density * material.specific_heat * contact_radius);
        let inception_depth =
            (diffusivity * strength.min(shear_modulus) / (shear_modulus * slip_rate)).sqrt();
        let at_inception = rise * (2.0 * inception_depth / std::f64::consts::PI.sqrt()).min(1.0);
        Self {
            rise,
            softening: softening(rise),
            inception: softening(at_inception),
            inception_depth,
            load: LOAD_OF_EXPANSION * bulge.abs() / interference + (1.0 - solid.stiffness_factor(rise)).abs(),
        }
    }

    /// Relative change of the friction coefficient.
    pub fn friction(&self) -> f64 {
        self.softening + self.load
    }
}

/// Heating by adiabatic plastic flow, βσ_Y/(ρc), K per unit of plastic strain, where it is so strong that a quasi-static
/// slide has no solution: where flow by some strain makes the metal expand by as much, αβσ_Y/(ρc) ≥ 1, or flow by the
/// yield strain melts it, βσ_Y²/(Eρc) ≥ T_m − T₀. Of metals the first is about 1e-3, the second about 1e-4 (T_m − T₀).
pub fn runaway(scene: &Scene) -> Option<f64> {
    let material = &scene.material;
    let capacity = material.density * material.specific_heat;
    let heating = scene.interface.taylor_quinney * material.yield_strength / capacity;
    let yield_strain = material.yield_strength / material.youngs_modulus;
    let initial = scene.loading.temperature;
    let melts =
        material.softening.melting().is_some_and(|melting| heating * yield_strain >= melting - initial);
    (melts || material.thermal_expansion.abs() * heating >= 1.0).then_some(heating)
}

/// Heat is coupled unless there is none or its effect is negligible.
pub fn choose_heat(scene: &Scene, slip_rate: f64, effect: &HeatEffect) -> HeatChoice {
    match scene.model.heat {
        Switch::Off => HeatChoice::Off(NoHeat::SwitchedOff),
        _ if slip_rate == 0.0 => HeatChoice::Off(NoHeat::AtRest),
        Switch::Auto if !scene.interface.law.has_friction() => HeatChoice::Off(NoHeat::NoFriction),
        Switch::Auto if effect.friction() < NEGLIGIBLE_SHARE * scene.numerics.accuracy => {
            HeatChoice::Off(NoHeat::Negligible)
        }
        Switch::On | Switch::Auto => HeatChoice::Coupled,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::file::parse_scene;

    fn scene(preset: &str, interference: f64, slip_rate: f64) -> Scene {
        let text = format!(
            "[material]\npreset = \"{preset}\"\n[asperity]\nradius = 1e-3\n\
             [loading]\ninterference = {interference:?}\nslip_rate = {slip_rate:?}\n"
        );
        parse_scene(&text, "this test", &[]).unwrap()
    }

    /// The loss of strength is that of the softening law, also where its initial slope is infinite.
    #[test]
    fn softening_is_that_of_the_law() {
        let mut scene = scene("steel-4340", 20.0, 1.0);
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

    /// Heat is left out for a reason, and far below the accuracy only.
    #[test]
    fn heat_is_coupled_unless_negligible() {
        let choice = |slip_rate: f64, change: &dyn Fn(&mut Scene)| {
            let mut scene = scene("steel-4340", 2.0, slip_rate);
            change(&mut scene);
            choose_heat(&scene, slip_rate, &HeatEffect::expected(&scene, slip_rate, 2e-5))
        };
        let off = |reason| HeatChoice::Off(reason);
        assert_eq!(choice(1.0, &|_| ()), HeatChoice::Coupled);
        assert_eq!(choice(0.0, &|_| ()), off(NoHeat::AtRest));
        assert_eq!(choice(1.0, &|s| s.model.heat = Switch::Off), off(NoHeat::SwitchedOff));
        let frictionless = |s: &mut Scene| s.interface.law = crate::scene::FrictionLaw::Frictionless;
        assert_eq!(choice(1.0, &frictionless), off(NoHeat::NoFriction));
        assert_eq!(choice(1e-6, &|_| ()), off(NoHeat::Negligible));
        assert_eq!(choice(1e-6, &|s| s.model.heat = Switch::On), HeatChoice::Coupled);
        // Plastic work heats where friction does not.
        assert_eq!(choice(1.0, &|s| s.interface.heat_partition = 0.0), HeatChoice::Coupled);
    }
}
