//! Expected effect of heat on friction; it decides whether a slide is simulated with heat.
//!
//! Rise of temperature in the middle of a disc source, f_h τ₀ V a/k (Carslaw & Jaeger, Conduction of
//! Heat in Solids, 1959, §8.2), and its effects: softening changes the strength; thermal expansion and
//! softer moduli change the load at constant interference.

use crate::material::Solid;
use crate::scene::fitted_constants::heat_effect::LOAD_OF_EXPANSION;
use crate::scene::{Scene, Switch};

/// Heat is left out where its expected effect on friction is below this share of the required accuracy.
const NEGLIGIBLE_SHARE: f64 = 1e-3;

/// Treatment of heat: coupled, or the reason for leaving it out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeatChoice {
    /// Temperatures soften and expand the contact.
    Coupled,
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
    /// Heat partition where heat is left out: that of the start, at V = 0 the steady one.
    pub partition: f64,
    /// Relative error of `partition`: the largest change to a steady state, at rest or at the slip rate; at V = 0 that of the
    /// constriction.
    pub partition_error: f64,
    /// Share of the strength of the interface that frictional heat takes before sliding begins.
    pub inception: f64,
    /// Depth that it has reached then, √(κt), over the contact radius; infinite at V = 0.
    pub inception_depth: f64,
}

impl HeatEffect {
    /// Expected effect of heat at a slip rate (m/s) and the radius of the contact (m).
    pub fn expected(scene: &Scene, slip_rate: f64, contact_radius: f64) -> Self {
        let counterface = scene.expansion_of_counterface();
        let scene = &scene.with_combined_modulus();
        let (material, interface) = (&scene.material, &scene.interface);
        let solid = Solid::new(material, scene.loading.temperature);
        let strength = scene.interface_strength(solid.interface_rate_factor(slip_rate, contact_radius));
        let share = match scene.largest_heat_partition() {
            0.0 => interface.taylor_quinney,
            partition => partition,
        };
        let rise = share * strength * slip_rate * contact_radius / material.thermal_conductivity.value;
        let critical = material.elastic_plastic().critical_interference(1.0);
        let interference = scene.loading.interference * critical * scene.radius;
        let asperity = (1.0 + material.poisson_ratio) * solid.mean_expansion(0.0, rise);
        let bulge = (asperity + counterface) * rise * contact_radius;
        let initial = scene.loading.temperature;
        let film = |rise: f64| {
            let factor = |temperature: f64| interface.law.film_softening().factor(temperature);
            (1.0 - factor(initial + rise) / factor(initial)).abs()
        };
        let metal = |rise: f64| (1.0 - solid.softening_factor(rise)).abs();
        // A plane under the flux q warms by 2q√(κt/π)/k, here in the time of the elastic displacement τ₀a(2 − ν)/(2G) at
        // gross slip, with 2 − ν taken as 2.
        let shear_modulus = 0.5 * material.youngs_modulus.value / (1.0 + material.poisson_ratio);
        let inception_depth =
            (material.diffusivity() * strength / (shear_modulus * slip_rate * contact_radius)).sqrt();
        let flux = scene.largest_heat_partition() * strength * slip_rate;
        let at_inception = flux * inception_depth * contact_radius * 2.0
            / (std::f64::consts::PI.sqrt() * material.thermal_conductivity.value);
        let (partition, partition_error) = expected_partition(scene, slip_rate, contact_radius);
        let limited = if interface.law.heating_ends_at_melting() { 1.0 } else { 0.0 };
        Self {
            rise,
            softening: metal(rise).max(film(rise)),
            partition,
            partition_error,
            inception: if flux > 0.0 { (limited * metal(at_inception)).max(film(at_inception)) } else { 0.0 },
            inception_depth,
            load: LOAD_OF_EXPANSION * bulge.abs() / interference + (1.0 - solid.stiffness_factor(rise)).abs(),
        }
    }

    /// Relative change of the friction coefficient.
    pub fn friction(&self) -> f64 {
        self.softening + self.load
    }
}

/// Error of the constriction ρ of the asperity over ρ − 1.
const CONSTRICTION_ERROR: f64 = 0.2;

/// Heat partition where heat is left out, and its relative error.
fn expected_partition(scene: &Scene, slip_rate: f64, contact_radius: f64) -> (f64, f64) {
    let initial = scene.initial_heat_partition();
    let steady = |slip_rate: f64| scene.steady_heat_partition(slip_rate, contact_radius);
    match (steady(0.0), steady(slip_rate)) {
        (Some(resting), _) if slip_rate == 0.0 => {
            let constriction = scene.constriction(contact_radius);
            (resting, CONSTRICTION_ERROR * (1.0 - resting) * (1.0 - 1.0 / constriction))
        }
        (Some(resting), Some(moving)) => {
            let change = |steady: f64| (steady / initial - 1.0).abs();
            (initial, change(resting).max(change(moving)))
        }
        _ => (initial, 0.0),
    }
}

/// Heating by adiabatic plastic flow, βσ_Y/(ρc), K per unit of plastic strain, where it is so strong that a quasi-static
/// slide has no solution: where flow by some strain makes the metal expand by as much, αβσ_Y/(ρc) ≥ 1, or flow by the
/// yield strain melts it, βσ_Y²/(Eρc) ≥ T_m − T₀. Of metals the first is about 1e-3, the second about 1e-4 (T_m − T₀).
pub fn runaway(scene: &Scene) -> Option<f64> {
    let material = &scene.material;
    let capacity = material.density * material.specific_heat.value;
    let heating = scene.interface.taylor_quinney * material.yield_strength / capacity;
    let yield_strain = material.yield_strength / material.youngs_modulus.value;
    let initial = scene.loading.temperature;
    let melts =
        material.softening.melting().is_some_and(|melting| heating * yield_strain >= melting - initial);
    (melts || material.thermal_expansion.value.abs() * heating >= 1.0).then_some(heating)
}

/// Heat is coupled unless there is none or its effect is negligible.
pub fn choose_heat(scene: &Scene, slip_rate: f64, effect: &HeatEffect) -> HeatChoice {
    match scene.model.heat {
        Switch::Off => HeatChoice::SwitchedOff,
        _ if slip_rate == 0.0 => HeatChoice::AtRest,
        Switch::Auto if !scene.interface.law.has_friction() => HeatChoice::NoFriction,
        Switch::Auto if effect.friction() < NEGLIGIBLE_SHARE * scene.numerics.accuracy => {
            HeatChoice::Negligible
        }
        Switch::On | Switch::Auto => HeatChoice::Coupled,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::SHEAR_RATIO;
    use crate::scene::tests::of_preset;

    /// The loss of strength is that of the softening law, also where its initial slope is infinite.
    #[test]
    fn softening_is_that_of_the_law() {
        let mut scene = of_preset("steel-4340", &[]);
        let crate::scene::Softening::JohnsonCook { melting, exponent, .. } = &mut scene.material.softening
        else {
            panic!("a preset of Johnson and Cook")
        };
        *exponent = 0.5;
        let range = *melting - scene.loading.temperature;
        let effect = HeatEffect::expected(&scene, 0.01, 40e-6);
        assert!((effect.softening - (effect.rise / range).sqrt()).abs() < 1e-3, "{effect:?}");
        let number = 0.5 * SHEAR_RATIO * scene.material.yield_strength * 0.01 * 40e-6
            / (scene.material.thermal_conductivity.value * range);
        assert!((effect.rise / range / number - 1.0).abs() < 1e-12);
    }

    /// Q/A = 30 MPa + 0.1·3σ_Y in deep contacts, and of the metal where that limits it, with its growth with the strain rate.
    #[test]
    fn a_film_heats_by_its_own_strength() {
        let rise = |sets: &[&str]| {
            let scene = of_preset("steel-4340", &[&["loading.interference=1000"], sets].concat());
            let heated = 0.5 * 0.01 * 40e-6 / scene.material.thermal_conductivity.value;
            HeatEffect::expected(&scene, 0.01, 40e-6).rise / heated
        };
        let film = rise(&[
            "interface.law=briscoe-tabor",
            "interface.film_strength=30e6",
            "interface.pressure_coefficient=0.1",
        ]);
        assert!((film / (30e6 + 0.3 * 792e6) - 1.0).abs() < 1e-12, "{film:e}");
        let strong = ["interface.law=coulomb", "interface.friction=0.5"];
        assert!((rise(&strong) / (792e6 * SHEAR_RATIO) - 1.0).abs() < 1e-12);
        // 1 + C ln(V/a), V/a = 250 1/s over 1 1/s.
        let rate =
            rise(&[strong[0], strong[1], "material.rate={law=\"johnson-cook\"}"]) / (792e6 * SHEAR_RATIO);
        assert!((rate / (1.0 + 0.014 * 250f64.ln()) - 1.0).abs() < 1e-6, "{rate}");
    }

    /// Heat is left out for a reason, and far below the accuracy only.
    #[test]
    fn heat_is_coupled_unless_negligible() {
        let choice = |slip_rate: f64, change: &dyn Fn(&mut Scene)| {
            let mut scene = of_preset("steel-4340", &["loading.interference=2"]);
            scene.loading.slip_rate = slip_rate;
            change(&mut scene);
            choose_heat(&scene, slip_rate, &HeatEffect::expected(&scene, slip_rate, 2e-5))
        };
        assert_eq!(choice(1.0, &|_| ()), HeatChoice::Coupled);
        assert_eq!(choice(0.0, &|_| ()), HeatChoice::AtRest);
        assert_eq!(choice(1.0, &|s| s.model.heat = Switch::Off), HeatChoice::SwitchedOff);
        let frictionless = |s: &mut Scene| s.interface.law = crate::scene::FrictionLaw::Frictionless;
        assert_eq!(choice(1.0, &frictionless), HeatChoice::NoFriction);
        assert_eq!(choice(1e-6, &|_| ()), HeatChoice::Negligible);
        assert_eq!(choice(1e-6, &|s| s.model.heat = Switch::On), HeatChoice::Coupled);
        // Plastic work heats where friction does not.
        assert_eq!(choice(1.0, &|s| s.interface.heat_partition = 0.0), HeatChoice::Coupled);
    }

    /// Worked by hand for E = 200 GPa, ν = 0.25, σ_Y = 400√3 MPa, k = 40, ρc = 4e6, f_h = 0.5, V = 10 m/s and a = 20 µm:
    /// τ₀/G = 0.005 gives t = 1e-8 s and √(κt) = √(1e-5·1e-8) = 0.31623 µm; 2e9·2·0.31623e-6/(40√π) = 17.841 K of the
    /// 1000 K to melting.
    #[test]
    fn softening_before_sliding_is_that_worked_by_hand() {
        let mut scene = of_preset("steel-4340", &["loading.slip_rate=10"]);
        let material = &mut scene.material;
        (material.youngs_modulus.value, material.poisson_ratio) = (200e9, 0.25);
        material.yield_strength = 400e6 * 3f64.sqrt();
        (material.thermal_conductivity, material.specific_heat) = (40.0.into(), 500.0.into());
        material.density = 8000.0;
        let initial = scene.loading.temperature;
        scene.material.softening = crate::scene::Softening::JohnsonCook {
            reference: initial,
            melting: initial + 1000.0,
            exponent: 1.0,
        };
        let effect = HeatEffect::expected(&scene, 10.0, 2e-5);
        assert!((effect.inception_depth / 0.0158114 - 1.0).abs() < 1e-5, "{effect:?}");
        assert!((effect.inception / 0.017841 - 1.0).abs() < 1e-4, "{effect:?}");
        assert_eq!(HeatEffect::expected(&scene, 0.0, 2e-5).inception, 0.0);
        let mut cold = scene.clone();
        cold.interface.heat_partition = 0.0;
        let mut coulomb = scene.clone();
        coulomb.interface.law = crate::scene::FrictionLaw::Coulomb { friction: 0.3, cap: false };
        for other in [cold, coulomb] {
            assert_eq!(HeatEffect::expected(&other, 10.0, 2e-5).inception, 0.0);
        }
    }
}
