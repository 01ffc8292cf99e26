//! What the asked accuracy means for mesh, sectors, increments and heat.

use crate::problem::SHEAR_RATIO;
use crate::scene::{FrictionLaw, Numerics, Scene, Softening, Switch};

/// Heat changes friction by about the softening number L (steady state: L/(1 + 8L/3π)); it is left
/// out when the scene leaves the choice and that is below this share of the asked accuracy.
const NO_HEAT_SHARE: f64 = 0.25;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// n_c.
    pub elements_per_radius: usize,
    /// N_θ.
    pub sectors: usize,
    /// Largest increment of slip relative to the slip so far.
    pub growth: f64,
}

impl Resolution {
    /// What the scene gives, and for the rest a choice by the accuracy as if errors fell with the
    /// square of the element size; the stated errors say what was reached.
    pub fn choose(numerics: &Numerics) -> Self {
        let from_accuracy = (8.0 * (0.05 / numerics.accuracy).sqrt()).ceil() as usize;
        let elements = numerics.elements_per_radius.unwrap_or(from_accuracy.clamp(6, 48).next_multiple_of(2));
        let sectors = numerics.sectors.unwrap_or(if numerics.accuracy >= 0.02 { 8 } else { 16 });
        Self {
            elements_per_radius: elements,
            sectors,
            growth: 0.2 * (numerics.accuracy / 0.02).sqrt().clamp(0.5, 1.5),
        }
    }

    /// Half as fine in every direction (sectors come in fours).
    pub fn half(&self) -> Self {
        Self {
            elements_per_radius: (self.elements_per_radius / 2).max(3),
            sectors: (self.sectors / 2).next_multiple_of(4),
            growth: 2.0 * self.growth,
        }
    }

    pub fn describe(&self, coarse: &Resolution) -> String {
        format!(
            "{} elements per contact radius, {} sectors, slip increments of {:.0} % of the slip; \
             errors are differences from a run with {}, {} and {:.0} %",
            self.elements_per_radius,
            self.sectors,
            100.0 * self.growth,
            coarse.elements_per_radius,
            coarse.sectors,
            100.0 * coarse.growth,
        )
    }
}

/// L = f_h τ₀ V a/(k ΔT_m): how much frictional heat can soften the contact; ΔT_m is the rise at
/// which the strength vanishes (or is lowest).
pub fn softening_number(scene: &Scene, slip_rate: f64, contact_radius: f64) -> f64 {
    let range = match &scene.material.softening {
        Softening::None => return 0.0,
        Softening::JohnsonCook { melting, .. } => melting - scene.loading.temperature,
        Softening::Table { temperature, .. } => {
            temperature.last().copied().unwrap_or(f64::INFINITY) - scene.loading.temperature
        }
    };
    let strength = scene.interface.strength_factor * SHEAR_RATIO * scene.material.yield_strength;
    scene.interface.heat_partition * strength * slip_rate * contact_radius
        / (scene.material.thermal_conductivity * range.max(1.0))
}

/// Whether heat is computed; says why not.
pub fn choose_heat(scene: &Scene, slip_rate: f64, number: f64, notes: &mut Vec<String>) -> bool {
    let left_out = match scene.model.heat {
        Switch::Off => Some("heat is switched off".to_string()),
        _ if slip_rate == 0.0 => Some("the slip rate is 0, the isothermal limit".to_string()),
        Switch::On => None,
        Switch::Auto if matches!(scene.interface.law, FrictionLaw::Frictionless) => {
            Some("there is no friction".to_string())
        }
        Switch::Auto if number < NO_HEAT_SHARE * scene.numerics.accuracy => Some(format!(
            "the softening number f_h tau_0 V a/(k dT_m) = {number:.2e} changes friction by at most about {:.2} %",
            100.0 * number
        )),
        Switch::Auto => None,
    };
    match left_out {
        Some(reason) => {
            notes.push(format!("heat is left out: {reason}"));
            false
        }
        None => {
            notes.push(format!("heat is included: softening number f_h tau_0 V a/(k dT_m) = {number:.2e}"));
            true
        }
    }
}
