//! Laws of the tangential traction on the contact, as data.
//!
//! To add a law: its variant here, with the properties below, and its limit of the shear traction
//! (`interface/friction_law.rs`), which the compiler requires; its keys, tests and pages are listed in CONTRIBUTING.md.

use serde::{Deserialize, Serialize};

use super::Softening;

/// Law of the tangential traction on the contact; the key `law` of the section `[interface]`, with
/// its parameters.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum FrictionLaw {
    /// Slip at τ_c = f_τ σ/√3, with the strength σ chosen by [`super::InterfaceStrength`].
    #[default]
    ShearStrength,
    /// Slip at τ_c = friction·p, with `cap` no more than f_τ σ/√3.
    Coulomb {
        #[serde(default = "default_friction")]
        friction: f64,
        #[serde(default = "capped")]
        cap: bool,
    },
    /// Slip at τ_c = (τ_0 + αp) factor(T), a film that shears more easily than the metal, with `cap` no more than
    /// f_τ σ/√3 (Briscoe & Tabor 1975, Wear 34, 29, doi:10.1016/0043-1648(75)90306-3).
    BriscoeTabor {
        /// τ_0, Pa.
        film_strength: f64,
        /// α.
        #[serde(default)]
        pressure_coefficient: f64,
        /// factor(T) of the film.
        #[serde(default)]
        film_softening: Softening,
        #[serde(default = "capped")]
        cap: bool,
    },
    FullStick,
    Frictionless,
}

fn default_friction() -> f64 {
    0.3
}

fn capped() -> bool {
    true
}

impl FrictionLaw {
    /// Whether friction heats the contact no further than to the temperature at which the material has no strength.
    pub(crate) fn heating_ends_at_melting(&self) -> bool {
        match *self {
            Self::Coulomb { .. } | Self::BriscoeTabor { .. } => self.has_cap(),
            Self::ShearStrength | Self::FullStick | Self::Frictionless => true,
        }
    }

    /// Whether the shear strength f_τ σ/√3 of the material limits the shear traction.
    pub(crate) fn has_strength_limit(&self) -> bool {
        match *self {
            Self::ShearStrength => true,
            Self::Coulomb { .. } | Self::BriscoeTabor { .. } => self.has_cap(),
            Self::FullStick | Self::Frictionless => false,
        }
    }

    /// Whether the limit of the shear traction is a law in the pressure, τ_0 + αp.
    pub(crate) fn depends_on_pressure(&self) -> bool {
        match self {
            Self::Coulomb { .. } | Self::BriscoeTabor { .. } => true,
            Self::ShearStrength | Self::FullStick | Self::Frictionless => false,
        }
    }

    /// Whether another law has the strength of the material as its upper limit.
    pub(crate) fn has_cap(&self) -> bool {
        match *self {
            Self::Coulomb { cap, .. } | Self::BriscoeTabor { cap, .. } => cap,
            Self::ShearStrength | Self::FullStick | Self::Frictionless => false,
        }
    }

    /// τ_0 (Pa) and α of a limit τ_0 + αp at `temperature`, K.
    pub(crate) fn film(&self, temperature: f64) -> Option<(f64, f64)> {
        match *self {
            _ if !self.has_friction() => None,
            Self::Coulomb { friction, .. } => Some((0.0, friction)),
            Self::BriscoeTabor { film_strength, pressure_coefficient, .. } => {
                let factor = self.film_softening().factor(temperature);
                Some((factor * film_strength, factor * pressure_coefficient))
            }
            Self::ShearStrength | Self::FullStick | Self::Frictionless => None,
        }
    }

    /// Softening of a film; none of other laws.
    pub(crate) fn film_softening(&self) -> &Softening {
        match self {
            Self::BriscoeTabor { film_softening, .. } => film_softening,
            Self::ShearStrength | Self::Coulomb { .. } | Self::FullStick | Self::Frictionless => {
                &Softening::None
            }
        }
    }

    /// Whether there is any friction.
    pub(crate) fn has_friction(&self) -> bool {
        match *self {
            Self::Frictionless => false,
            Self::Coulomb { friction, .. } => friction > 0.0,
            Self::BriscoeTabor { film_strength, pressure_coefficient, .. } => {
                film_strength > 0.0 || pressure_coefficient > 0.0
            }
            Self::ShearStrength | Self::FullStick => true,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zero_parameters_mean_no_friction() {
        let film = |film_strength, pressure_coefficient| FrictionLaw::BriscoeTabor {
            film_strength,
            pressure_coefficient,
            film_softening: Softening::None,
            cap: true,
        };
        let coulomb = |friction| FrictionLaw::Coulomb { friction, cap: true };
        for (law, friction) in [
            (FrictionLaw::Frictionless, false),
            (coulomb(0.0), false),
            (film(0.0, 0.0), false),
            (coulomb(0.1), true),
            (film(1e8, 0.0), true),
            (film(0.0, 0.1), true),
        ] {
            assert_eq!(law.has_friction(), friction, "{law:?}");
        }
    }

    #[test]
    fn a_film_has_its_strength_at_the_temperature() {
        let law = |film_strength, pressure_coefficient| FrictionLaw::BriscoeTabor {
            film_strength,
            pressure_coefficient,
            film_softening: Softening::Table { temperature: vec![300.0, 500.0], factor: vec![1.0, 0.5] },
            cap: true,
        };
        assert_eq!(law(1e8, 0.06).film(300.0), Some((1e8, 0.06)));
        assert_eq!(law(1e8, 0.06).film(500.0), Some((5e7, 0.03)));
        assert_eq!(law(0.0, 0.0).film(300.0), None);
        assert_eq!(FrictionLaw::Coulomb { friction: 0.2, cap: false }.film(500.0), Some((0.0, 0.2)));
        assert_eq!(FrictionLaw::ShearStrength.film(300.0), None);
    }
}
