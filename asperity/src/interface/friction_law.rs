//! Laws of the tangential traction on the contact: all that is particular to one of them.
//!
//! To add a law: its variant of [`FrictionLaw`], its entry in [`LAWS`], and what the compiler then
//! asks for below. Scene files, their checks and the slide read it here.

/// Law of the tangential traction on the contact.
#[derive(Clone, Debug, PartialEq)]
pub enum FrictionLaw {
    /// Slip at τ_c = f_τ σ/√3, with the strength σ that [`crate::scene::InterfaceStrength`] says.
    ShearStrength,
    /// Slip at τ_c = friction·p, with `cap` no more than f_τ σ/√3.
    Coulomb {
        friction: f64,
        cap: bool,
    },
    /// Slip at τ_c = τ_0 + αp, a film that shears more easily than the metal, with `cap` no more than
    /// f_τ σ/√3; τ_0 in Pa (Briscoe & Tabor 1975, Wear 34, 29, doi:10.1016/0043-1648(75)90306-3).
    BriscoeTabor {
        film_strength: f64,
        pressure_coefficient: f64,
        cap: bool,
    },
    FullStick,
    Frictionless,
}

/// Value of a law's parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// Zero or a positive number.
    Number(f64),
    Flag(bool),
}

/// A parameter of a law, a key of the section `[interface]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    pub key: &'static str,
    pub unit: &'static str,
    /// NaN: must be given.
    pub default: Value,
}

/// How a law is called in scene files, and its parameters.
pub struct Entry {
    pub name: &'static str,
    pub parameters: &'static [Parameter],
    build: fn(&[Value]) -> FrictionLaw,
}

const CAP: Parameter = Parameter { key: "cap", unit: "1", default: Value::Flag(true) };
const FRICTION: Parameter = Parameter { key: "friction", unit: "1", default: Value::Number(0.3) };
const FILM_STRENGTH: Parameter =
    Parameter { key: "film_strength", unit: "Pa", default: Value::Number(f64::NAN) };
const PRESSURE_COEFFICIENT: Parameter =
    Parameter { key: "pressure_coefficient", unit: "1", default: Value::Number(0.0) };

/// Every law that a scene file can ask for; the first is the default.
///
/// ```
/// use asperity::interface::friction_law::LAWS;
///
/// let coulomb = LAWS.iter().find(|entry| entry.name == "coulomb").unwrap();
/// let keys: Vec<&str> = coulomb.parameters.iter().map(|parameter| parameter.key).collect();
/// assert_eq!(keys, ["friction", "cap"]);
/// ```
pub const LAWS: &[Entry] = &[
    Entry { name: "shear-strength", parameters: &[], build: |_| FrictionLaw::ShearStrength },
    Entry {
        name: "coulomb",
        parameters: &[FRICTION, CAP],
        build: |values| FrictionLaw::Coulomb { friction: number(values[0]), cap: flag(values[1]) },
    },
    Entry {
        name: "briscoe-tabor",
        parameters: &[FILM_STRENGTH, PRESSURE_COEFFICIENT, CAP],
        build: |values| FrictionLaw::BriscoeTabor {
            film_strength: number(values[0]),
            pressure_coefficient: number(values[1]),
            cap: flag(values[2]),
        },
    },
    Entry { name: "full-stick", parameters: &[], build: |_| FrictionLaw::FullStick },
    Entry { name: "frictionless", parameters: &[], build: |_| FrictionLaw::Frictionless },
];

/// What a law may depend on at a contact point; tractions in units of `unit`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactPoint {
    pub pressure: f64,
    /// Share of the point's area that is covered by the contact.
    pub cover: f64,
    /// f_τ σ/√3.
    pub strength: f64,
    /// Pa.
    pub unit: f64,
}

impl FrictionLaw {
    /// Limit of the shear traction, per area of the point.
    pub(crate) fn limit(&self, at: &ContactPoint) -> f64 {
        let strength = at.cover * at.strength;
        let capped = |limit: f64, cap: bool| if cap { limit.min(strength) } else { limit };
        match *self {
            Self::ShearStrength => strength,
            Self::Coulomb { friction, cap } => capped(friction * at.pressure, cap),
            Self::BriscoeTabor { film_strength, pressure_coefficient, cap } => {
                capped(at.cover * film_strength / at.unit + pressure_coefficient * at.pressure, cap)
            }
            Self::FullStick => f64::INFINITY,
            Self::Frictionless => 0.0,
        }
    }

    /// Values of the parameters of the law's entry, in their order.
    fn values(&self) -> Vec<Value> {
        match *self {
            Self::Coulomb { friction, cap } => vec![Value::Number(friction), Value::Flag(cap)],
            Self::BriscoeTabor { film_strength, pressure_coefficient, cap } => {
                vec![Value::Number(film_strength), Value::Number(pressure_coefficient), Value::Flag(cap)]
            }
            Self::ShearStrength | Self::FullStick | Self::Frictionless => Vec::new(),
        }
    }

    /// Name in scene files.
    pub fn name(&self) -> &'static str {
        match self {
            Self::ShearStrength => "shear-strength",
            Self::Coulomb { .. } => "coulomb",
            Self::BriscoeTabor { .. } => "briscoe-tabor",
            Self::FullStick => "full-stick",
            Self::Frictionless => "frictionless",
        }
    }

    /// Parameters with their values.
    pub fn parameters(&self) -> impl Iterator<Item = (Parameter, Value)> {
        let entry = LAWS.iter().find(|entry| entry.name == self.name()).expect("every law has an entry");
        entry.parameters.iter().copied().zip(self.values())
    }

    /// Whether the shear strength of the material is the limit, and nothing else.
    pub(crate) fn is_material_strength(&self) -> bool {
        *self == Self::ShearStrength
    }

    /// Whether the interface may be as strong as the body below it, which then shears.
    pub(crate) fn as_strong_as_bulk(&self) -> bool {
        matches!(self, Self::ShearStrength | Self::FullStick)
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

impl Entry {
    /// The law with values for its parameters, in their order.
    pub(crate) fn build(&self, values: &[Value]) -> FrictionLaw {
        (self.build)(values)
    }
}

fn number(value: Value) -> f64 {
    match value {
        Value::Number(number) => number,
        Value::Flag(_) => unreachable!("the parameter is a number"),
    }
}

fn flag(value: Value) -> bool {
    match value {
        Value::Flag(flag) => flag,
        Value::Number(_) => unreachable!("the parameter is a flag"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Different values for all parameters of a law.
    fn example(entry: &Entry) -> FrictionLaw {
        let values = entry.parameters.iter().enumerate().map(|(n, parameter)| match parameter.default {
            Value::Number(_) => Value::Number(0.25 * (n + 1) as f64),
            Value::Flag(default) => Value::Flag(!default),
        });
        entry.build(&values.collect::<Vec<_>>())
    }

    #[test]
    fn every_law_gives_back_its_name_and_parameters() {
        for entry in LAWS {
            let law = example(entry);
            assert_eq!(law.name(), entry.name);
            let values: Vec<Value> = law.parameters().map(|(_, value)| value).collect();
            assert_eq!(values.len(), entry.parameters.len(), "{}", entry.name);
            assert_eq!(entry.build(&values), law);
        }
    }

    #[test]
    fn limits_of_shear() {
        let at = ContactPoint { pressure: 2.0, cover: 0.5, strength: 0.6, unit: 1e9 };
        let limit = |law: FrictionLaw| law.limit(&at);
        assert_eq!(limit(FrictionLaw::ShearStrength), 0.3);
        assert_eq!(limit(FrictionLaw::Coulomb { friction: 0.1, cap: true }), 0.2);
        assert_eq!(limit(FrictionLaw::Coulomb { friction: 0.4, cap: true }), 0.3);
        assert_eq!(limit(FrictionLaw::Coulomb { friction: 0.4, cap: false }), 0.8);
        let film = |film_strength, pressure_coefficient, cap| {
            limit(FrictionLaw::BriscoeTabor { film_strength, pressure_coefficient, cap })
        };
        // 0.5·0.1 + 0.05·2, below the strength of the metal; then above it.
        assert!((film(1e8, 0.05, true) - 0.15).abs() < 1e-15);
        assert_eq!(film(1e9, 0.05, true), 0.3);
        assert!((film(1e9, 0.05, false) - 0.6).abs() < 1e-15);
        assert_eq!(limit(FrictionLaw::FullStick), f64::INFINITY);
        assert_eq!(limit(FrictionLaw::Frictionless), 0.0);
    }

    #[test]
    fn no_friction_is_none_by_any_law() {
        let film = |film_strength, pressure_coefficient| FrictionLaw::BriscoeTabor {
            film_strength,
            pressure_coefficient,
            cap: true,
        };
        let coulomb = |friction| FrictionLaw::Coulomb { friction, cap: true };
        assert!(
            [FrictionLaw::Frictionless, coulomb(0.0), film(0.0, 0.0)].iter().all(|law| !law.has_friction())
        );
        assert!([coulomb(0.1), film(1e8, 0.0), film(0.0, 0.1)].iter().all(FrictionLaw::has_friction));
    }
}
