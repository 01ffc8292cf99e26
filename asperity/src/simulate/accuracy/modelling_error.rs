//! Modelling error: effects that the model of a run neglects or no mesh resolves, and bounds of their influence on its results.

use tables::quantity::Quantity;

use crate::heat::expected::HeatEffect;
use crate::scene::fitted_constants::localised_shear;

/// Effects neglected in a run.
#[derive(Clone, Copy, Default)]
pub struct ModellingError {
    /// Heat, where its effect is negligible.
    pub heat: Option<HeatEffect>,
    /// Relative change of the heat partition where heat is left out for any reason.
    pub heat_partition: f64,
    /// Largest plastic strain of a slide at small strain.
    pub strain: f64,
    /// Bounds where shear localises in one layer of elements: values follow the mesh.
    pub localised_shear: Option<&'static localised_shear::Bounds>,
}

impl ModellingError {
    /// Change of a quantity relative to its value (to its rise, for temperatures).
    ///
    /// Heat changes quantities of the slide only: at inception the temperature has hardly risen. Finite strain changes
    /// friction and area by about the largest plastic strain: mu by 0.3, 1.1, 0.3, 0.3 and 0.2 of it at strains of
    /// 0.004 to 0.014 (between 0.5 and 3 omega_c), by 0.79, 0.75 and 0.72 of it at 0.028, 0.051 and 0.083 (4340 steel
    /// at 20, 50 and 100 omega_c).
    pub fn share(&self, quantity: Quantity) -> f64 {
        use Quantity::*;
        let (softening, load) = self.heat.map_or((0.0, 0.0), |effect| (effect.softening, effect.load));
        let localised = self.localised_shear.map_or(0.0, |bounds| match quantity {
            Mu | MuStatic | MuPeak | MuMean | MuSteady | Friction | FrictionStatic => bounds.friction,
            Load | Area => bounds.load,
            InceptionSlip => bounds.inception_slip,
            EnergyRelease | EnergyWeakening => bounds.energy,
            _ => 0.0,
        });
        localised
            + match quantity {
                Mu | MuPeak | MuMean | MuSteady => softening + load + self.strain,
                MuStatic | FrictionStatic | EnergyRelease => self.strain,
                Friction | EnergyWeakening => softening + self.strain,
                Area => load + self.strain,
                Load => load,
                // The whole rise is an expected one.
                TemperatureMax | TemperatureMean if self.heat.is_some() => 1.0,
                TemperatureMax | TemperatureMean => self.strain,
                HeatPartition => self.heat_partition,
                _ => 0.0,
            }
    }
}
