//! Specific heat and conductivity over the temperature rise, in the terms in which conduction is linear: enthalpy and Kirchhoff's
//! potential. Chapter "Conduction" of the book.

use crate::scene::Property;
use crate::scene::curve::Curve;

/// Properties over the temperature rise, relative to those at the initial temperature; positive.
#[derive(Clone, Debug)]
pub struct ThermalProperties {
    /// c/c₀, on the knots of k/k₀.
    specific_heat: Curve,
    /// k/k₀, on the knots of c/c₀.
    conductivity: Curve,
}

/// State at a Kirchhoff potential Θ = ∫k/k₀ dθ.
pub struct ThermalState {
    /// θ, K.
    pub rise: f64,
    /// H, in kelvin at c₀.
    pub enthalpy: f64,
    /// dH/dΘ = (c/c₀)/(k/k₀), the reciprocal of the diffusivity κ/κ₀.
    pub capacity: f64,
}

impl ThermalProperties {
    /// Properties from the curves of c/c₀ and k/k₀ over the rise.
    pub fn new(specific_heat: &Curve, conductivity: &Curve) -> Self {
        Self {
            specific_heat: specific_heat.with_knots_of(conductivity),
            conductivity: conductivity.with_knots_of(specific_heat),
        }
    }

    /// Constant properties, those at the initial temperature.
    pub fn constant() -> Self {
        Self { specific_heat: Curve::constant(1.0), conductivity: Curve::constant(1.0) }
    }

    /// Properties of a body at an initial temperature, K; none where both are constant.
    pub fn of(specific_heat: &Property, conductivity: &Property, initial_temperature: f64) -> Option<Self> {
        let tables = [specific_heat, conductivity].map(|property| property.table.as_ref());
        let [specific_heat, conductivity] = tables
            .map(|table| table.map_or(Curve::constant(1.0), |table| table.relative(initial_temperature)));
        tables.iter().any(Option::is_some).then(|| Self::new(&specific_heat, &conductivity))
    }

    /// c/c₀.
    pub fn specific_heat(&self) -> &Curve {
        &self.specific_heat
    }

    /// k/k₀.
    pub fn conductivity(&self) -> &Curve {
        &self.conductivity
    }

    /// Diffusivity κ/κ₀ at a potential.
    pub fn diffusivity(&self, potential: f64) -> f64 {
        1.0 / self.state(potential).capacity
    }

    /// Rise, enthalpy and capacity at a potential, from one search on the common knots.
    pub fn state(&self, potential: f64) -> ThermalState {
        let point = self.conductivity.point_of_integral(potential);
        let (conductivity, _) = self.conductivity.at(&point);
        let (specific_heat, enthalpy) = self.specific_heat.at(&point);
        let rise = self.conductivity.abscissa(&point);
        ThermalState { rise, enthalpy, capacity: specific_heat / conductivity }
    }
}
