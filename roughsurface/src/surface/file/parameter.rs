//! Parameters of a surface file that may be given with a standard deviation.

/// A parameter that may be uncertain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    AsperityDensity,
    AsperityRadius,
    HeightsStd,
    YoungsModulus,
    PoissonRatio,
    YieldStrength,
}

impl Parameter {
    /// All, with their keys in the section `uncertainty`.
    pub const ALL: [(Self, &'static str); 6] = [
        (Self::AsperityDensity, "asperity_density"),
        (Self::AsperityRadius, "asperity_radius"),
        (Self::HeightsStd, "heights_std"),
        (Self::YoungsModulus, "youngs_modulus"),
        (Self::PoissonRatio, "poisson_ratio"),
        (Self::YieldStrength, "yield_strength"),
    ];

    /// Its key in the section `uncertainty`.
    pub fn key(self) -> &'static str {
        Self::ALL[self as usize].1
    }

    /// Whether it belongs to the material, which a table brings with it.
    pub fn is_of_material(self) -> bool {
        matches!(self, Self::YoungsModulus | Self::PoissonRatio | Self::YieldStrength)
    }
}

/// A parameter with its standard deviation, in the unit of the parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertain {
    pub parameter: Parameter,
    pub std: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_stand_at_their_parameter() {
        for (index, (parameter, key)) in Parameter::ALL.into_iter().enumerate() {
            assert_eq!((parameter as usize, parameter.key()), (index, key));
        }
    }
}
