//! The state of a rough surface at one separation and slip.

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
    fn add(&mut self, share: f64, other: Integral) {
        self.value += share * other.value;
        self.law_error += share * other.law_error;
        self.quadrature_error += share * other.quadrature_error;
    }

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
    /// An [additional quantity](crate::integral::asperity_at_slip::Additional) per nominal area, where the law states
    /// it and it was requested.
    pub additional: Option<Integral>,
    /// Contacts per nominal area, 1/m².
    pub contact_density: f64,
    /// Contact radius averaged over the load, m.
    pub loaded_radius: f64,
    /// Share of the load on asperities beyond the range of the law, where it is extrapolated, 1.
    pub outside: f64,
    /// Share of the load on asperities beyond the largest contact of the model, 1.
    pub beyond: f64,
    /// Friction stress times the relative error of Q/P of each asperity, Pa.
    pub coefficient_error: f64,
    /// Friction stress times the relative error of the load of each asperity, Pa.
    pub shear_by_load_error: f64,
}

impl ContactState {
    /// Adds a `share` of another state to this one.
    pub(crate) fn add(&mut self, share: f64, other: &ContactState) {
        let load = self.pressure.value + share * other.pressure.value;
        let of_load = if load > 0.0 { share * other.pressure.value / load } else { 0.0 };
        let average = |mean: f64, value: f64| mean + of_load * (value - mean);
        self.loaded_radius = average(self.loaded_radius, other.loaded_radius);
        self.outside = average(self.outside, other.outside);
        self.beyond = average(self.beyond, other.beyond);
        self.contact_density += share * other.contact_density;
        self.pressure.add(share, other.pressure);
        self.shear.add(share, other.shear);
        self.area_fraction.add(share, other.area_fraction);
        self.coefficient_error += share * other.coefficient_error;
        self.shear_by_load_error += share * other.shear_by_load_error;
        if let Some(additional) = other.additional {
            self.additional.get_or_insert_default().add(share, additional);
        }
    }

    /// The additional quantity, a part of the load, over the load; 0 where there is none.
    pub fn additional_share(&self) -> f64 {
        self.additional.map_or(0.0, |part| part.value / self.pressure.value)
    }

    /// Friction over load.
    ///
    /// With μ = Q/P of the asperity and ⟨·⟩ a mean over asperities weighted by friction or by load, the error of the law
    /// is δ(q̄/p̄)/(q̄/p̄) = ⟨δμ/μ⟩_Q + |⟨δP/P⟩_Q − ⟨δP/P⟩_P|. It is at most that of independent errors of Q and P.
    pub fn friction_coefficient(&self) -> Estimate {
        let Self { shear, pressure, .. } = *self;
        let value = shear.value / pressure.value;
        let of_friction = |part: f64| if shear.value == 0.0 { 0.0 } else { part / shear.value.abs() };
        let load_error = pressure.law_error / pressure.value;
        let correlated =
            of_friction(self.coefficient_error) + (of_friction(self.shear_by_load_error) - load_error).abs();
        let law_error = correlated.min(of_friction(shear.law_error) + load_error);
        let quadrature = of_friction(shear.quadrature_error) + pressure.quadrature_error / pressure.value;
        Estimate { value, error: value.abs() * (law_error + quadrature) }
    }
}
