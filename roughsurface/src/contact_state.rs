//! What a rough surface does at one separation and slip.

use tables::law::Estimate;

/// An integral and where its error comes from, all in the same unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Integral {
    pub value: f64,
    /// Error of the asperity law, taken to have the same sign in every asperity.
    pub law_error: f64,
    /// Error of the quadrature.
    pub quadrature_error: f64,
}

impl Integral {
    /// Value with the sum of the errors.
    pub fn estimate(&self) -> Estimate {
        Estimate { value: self.value, error: self.law_error + self.quadrature_error }
    }
}

/// A rough surface against a flat at one separation, per unit of nominal area.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactState {
    /// Nominal pressure, Pa.
    pub pressure: Integral,
    /// Friction stress on the nominal area, Pa.
    pub shear: Integral,
    /// Real over nominal contact area, 1.
    pub area_fraction: Integral,
    /// Energy released from full stick to full slip per nominal area, J/m², where the
    /// law knows it and was asked.
    pub energy: Option<Integral>,
    /// Contacts per nominal area, 1/m².
    pub contact_density: f64,
    /// Contact radius averaged over the load, m.
    pub loaded_radius: f64,
    /// Share of the load that asperities beyond the limit of the law carry, 1.
    pub outside: f64,
    /// ω/ω_c that the law would have to reach for that share to be negligible.
    pub reach: f64,
}

impl ContactState {
    /// Friction over load, with its error if `shear` and `pressure` err in
    /// opposite directions.
    pub fn friction_coefficient(&self) -> Estimate {
        let (shear, pressure) = (self.shear.estimate(), self.pressure.estimate());
        let value = shear.value / pressure.value;
        Estimate { value, error: (shear.error + value.abs() * pressure.error) / pressure.value }
    }
}
