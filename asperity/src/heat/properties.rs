//! Specific heat and conductivity over the temperature rise, in the terms in which conduction is linear: enthalpy and Kirchhoff's
//! potential. Chapter "Conduction" of the book.

use crate::scene::curve::Curve;
use crate::scene::{TemperatureDependence, TemperatureTable};

/// Properties over the temperature rise, relative to those at the initial temperature; positive.
#[derive(Clone, Debug)]
pub struct ThermalProperties {
    /// c/c₀.
    pub specific_heat: Curve,
    /// k/k₀.
    pub conductivity: Curve,
}

impl ThermalProperties {
    /// Those at the initial temperature throughout.
    pub fn constant() -> Self {
        Self { specific_heat: Curve::constant(1.0), conductivity: Curve::constant(1.0) }
    }

    /// Of a body at an initial temperature, K; none where both are constant.
    pub fn of(dependence: &TemperatureDependence, initial_temperature: f64) -> Option<Self> {
        let TemperatureDependence { specific_heat, thermal_conductivity, .. } = dependence;
        let relative = |table: &Option<TemperatureTable>| match table {
            Some(table) => table.relative(initial_temperature),
            None => Curve::constant(1.0),
        };
        (specific_heat.is_some() || thermal_conductivity.is_some()).then(|| Self {
            specific_heat: relative(specific_heat),
            conductivity: relative(thermal_conductivity),
        })
    }

    /// Diffusivity κ/κ₀ at a potential Θ = ∫k/k₀ dθ.
    pub fn diffusivity(&self, potential: f64) -> f64 {
        let rise = self.conductivity.inverse_integral(potential);
        self.conductivity.value(rise) / self.specific_heat.value(rise)
    }
}
