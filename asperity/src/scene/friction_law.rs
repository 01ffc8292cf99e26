//! Laws of the tangential traction on the contact, as data.
//!
//! To add a law: its variant and its limit here, which the compiler requires; all properties follow from the limit. Its keys,
//! tests and pages are listed in CONTRIBUTING.md.

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

/// Limit of the shear traction: that of a film, the strength of the material, the smaller of both, or none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ShearLimit<'a> {
    pub film: Option<Film<'a>>,
    /// Whether the shear strength f_τ σ/√3 of the material is an upper limit.
    pub capped: bool,
}

/// Limit (τ_0 + αp) factor(T).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Film<'a> {
    /// τ_0, Pa.
    pub strength: f64,
    /// α.
    pub coefficient: f64,
    /// factor(T).
    pub softening: &'a Softening,
}

impl<'a> Film<'a> {
    /// αp, at all temperatures.
    const fn of_pressure(coefficient: f64) -> Self {
        Film { strength: 0.0, coefficient, softening: &Softening::None }
    }
}

/// Change of the interface that lets a light contact slide.
pub(crate) const REMEDY_OF_LIGHT_CONTACT: &str = "the law \"coulomb\", a smaller strength_factor or, with the law \"briscoe-tabor\", a smaller film_strength";

impl FrictionLaw {
    /// The limit of the shear traction, from which the other properties follow.
    pub(crate) fn limit(&self) -> ShearLimit<'_> {
        let (film, capped) = match *self {
            Self::ShearStrength => (None, true),
            Self::Coulomb { friction, cap } => (Some(Film::of_pressure(friction)), cap),
            Self::BriscoeTabor { film_strength, pressure_coefficient, ref film_softening, cap } => {
                let (strength, coefficient) = (film_strength, pressure_coefficient);
                (Some(Film { strength, coefficient, softening: film_softening }), cap)
            }
            Self::FullStick => (None, false),
            Self::Frictionless => (Some(Film::of_pressure(0.0)), false),
        };
        ShearLimit { film, capped }
    }

    /// Whether there is any friction.
    pub(crate) fn has_friction(&self) -> bool {
        self.limit().film.is_none_or(|film| film.strength > 0.0 || film.coefficient > 0.0)
    }

    /// Whether the strength of the material is the only limit of the shear traction.
    pub(crate) fn is_strength(&self) -> bool {
        self.limit() == ShearLimit { film: None, capped: true }
    }

    /// Whether the limit of the shear traction is a law in the pressure, τ_0 + αp, whatever its parameters are.
    pub(crate) fn depends_on_pressure(&self) -> bool {
        self.limit().film.is_some() && *self != Self::Frictionless
    }

    /// Whether friction heats the contact no further than to the temperature at which the material has no strength.
    pub(crate) fn heating_ends_at_melting(&self) -> bool {
        self.limit().capped || !self.depends_on_pressure()
    }

    /// τ_0 (Pa) and α of a film at `temperature`, K; none without friction.
    pub(crate) fn film(&self, temperature: f64) -> Option<(f64, f64)> {
        let Film { strength, coefficient, softening } = self.limit().film.filter(|_| self.has_friction())?;
        let factor = softening.factor(temperature);
        Some((factor * strength, factor * coefficient))
    }

    /// Softening of a film; none of other laws.
    pub(crate) fn film_softening(&self) -> &Softening {
        self.limit().film.map_or(&Softening::None, |film| film.softening)
    }

    /// Change of the interface after which it is weaker than the body.
    pub(crate) fn remedy_of_strong_interface(&self) -> &'static str {
        match self.limit() {
            ShearLimit { capped: true, .. } => {
                "a smaller interface.strength_factor, 0.9 of the present one or less, or material.hardening"
            }
            ShearLimit { film: Some(_), .. } => {
                "interface.cap = true, which limits friction to the strength of the metal, or a smaller friction or film_strength"
            }
            ShearLimit { film: None, .. } => {
                "law = \"shear-strength\" with strength_factor = 0.9; with law = \"full-stick\" a shorter slip_distance"
            }
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

    /// Whether the strength of the material is the only limit, the limit is a law in the pressure, and heating ends at melting.
    #[test]
    fn properties_follow_from_the_limit() {
        let coulomb = |friction, cap| FrictionLaw::Coulomb { friction, cap };
        for (law, expected) in [
            (FrictionLaw::ShearStrength, [true, false, true]),
            (coulomb(0.3, true), [false, true, true]),
            (coulomb(0.3, false), [false, true, false]),
            (coulomb(0.0, false), [false, true, false]),
            (FrictionLaw::FullStick, [false, false, true]),
            (FrictionLaw::Frictionless, [false, false, true]),
        ] {
            let found = [law.is_strength(), law.depends_on_pressure(), law.heating_ends_at_melting()];
            assert_eq!(found, expected, "{law:?}");
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
