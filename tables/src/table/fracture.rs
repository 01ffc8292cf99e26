//! Energy released by the asperity over the shear fracture energy of its material.

use super::{Cell, Slice};
use crate::quantity::{Estimate, Quantity};

/// G_IIc = `coefficient`·aⁿ, J/m², at the contact radius a in m: a constant of the material (n = 0),
/// or an estimate that grows with the contact (n = 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FractureEnergy {
    /// J/m² over mⁿ.
    pub coefficient: f64,
    /// n, which is also the power of the asperity's radius.
    pub radius_exponent: i32,
}

impl FractureEnergy {
    /// G_IIc at a contact radius, with the error that the radius brings.
    pub fn at(&self, contact_radius: Estimate) -> Estimate {
        let value = self.coefficient * contact_radius.value.powi(self.radius_exponent);
        let relative = self.radius_exponent.abs() as f64 * contact_radius.error / contact_radius.value;
        Estimate { value, error: value * if self.radius_exponent == 0 { 0.0 } else { relative } }
    }

    /// G/G_IIc; errors are added with their magnitudes.
    pub fn ratio(&self, energy: Estimate, contact_radius: Estimate) -> Estimate {
        energy.over(self.at(contact_radius))
    }
}

impl Slice {
    /// G/G_IIc of a cell, if G_IIc is known.
    pub fn energy_ratio(&self, cell: &Cell) -> Option<Estimate> {
        let law = self.metadata().fracture_energy?;
        Some(law.ratio(cell[Quantity::EnergyRelease], cell[Quantity::ContactRadius]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratio_carries_the_errors_of_energy_and_radius() {
        let (energy, radius) =
            (Estimate { value: 600.0, error: 30.0 }, Estimate { value: 2e-5, error: 1e-6 });
        let constant = FractureEnergy { coefficient: 300.0, radius_exponent: 0 };
        assert_eq!(constant.at(radius), Estimate::exact(300.0));
        let ratio = constant.ratio(energy, radius);
        assert!((ratio.value - 2.0).abs() < 1e-14 && (ratio.error - 0.1).abs() < 1e-14);
        // 300 J/m² at 20 µm, 5 % of error of a.
        let growing = FractureEnergy { coefficient: 1.5e7, radius_exponent: 1 };
        let ratio = growing.ratio(energy, radius);
        assert!((ratio.value - 2.0).abs() < 1e-13 && (ratio.error - 0.2).abs() < 1e-13);
        // At ten times the radius of the asperity G and a are ten times as large.
        let scale = |e: Estimate| Estimate { value: 10.0 * e.value, error: 10.0 * e.error };
        let other = growing.ratio(scale(energy), scale(radius));
        assert!((other.value - ratio.value).abs() < 1e-13);
    }
}
