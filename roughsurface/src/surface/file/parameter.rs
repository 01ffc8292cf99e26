//! Parameters of a surface file that may be given with a standard deviation.

use super::keys::{FileKeys, UncertaintyKeys};
use crate::surface::messages::allowed;

/// A parameter that may be uncertain.
#[derive(Debug)]
pub struct Parameter {
    /// Key of the parameter in the section `uncertainty`.
    pub key: &'static str,
    /// Whether it belongs to the material, which a table brings with it.
    pub is_of_material: bool,
    std: fn(&UncertaintyKeys) -> Option<f64>,
    /// Value of the parameter, if the file has it: of a distribution of radii, the mean.
    pub(super) value: fn(&mut FileKeys) -> Option<&mut f64>,
}

/// A parameter by its key, which that of its standard deviation has too.
macro_rules! parameter {
    ($key:ident, $is_of_material:literal, $value:expr) => {
        Parameter {
            key: stringify!($key),
            is_of_material: $is_of_material,
            std: |keys| keys.$key,
            value: $value,
        }
    };
}

static PARAMETERS: [Parameter; 6] = [
    parameter!(asperity_density, false, |file| Some(&mut file.surface.asperity_density)),
    parameter!(asperity_radius, false, |file| file.surface.asperity_radius.as_mut()),
    parameter!(heights_std, false, |file| file.surface.heights.std.as_mut()),
    parameter!(youngs_modulus, true, |file| Some(&mut file.material.as_mut()?.youngs_modulus)),
    parameter!(poisson_ratio, true, |file| Some(&mut file.material.as_mut()?.poisson_ratio)),
    parameter!(yield_strength, true, |file| Some(&mut file.material.as_mut()?.yield_strength)),
];

/// A parameter with its standard deviation, in the unit of the parameter.
#[derive(Clone, Copy, Debug)]
pub struct Uncertain {
    pub parameter: &'static Parameter,
    pub std: f64,
}

impl FileKeys {
    /// The standard deviations of the section `uncertainty`.
    pub(super) fn uncertain(&mut self) -> Result<Vec<Uncertain>, String> {
        let Some(keys) = self.uncertainty.take() else {
            return Ok(Vec::new());
        };
        let mut uncertain = Vec::new();
        for parameter in &PARAMETERS {
            let Some(std) = (parameter.std)(&keys) else {
                continue;
            };
            let key = format!("uncertainty.{}", parameter.key);
            let Some(&mut value) = (parameter.value)(self) else {
                let missing = if parameter.is_of_material {
                    "needs a section [material]; beside a table of runs the key uncertainty.tables states uncertain constants"
                } else {
                    "needs the value itself as a key of [surface]"
                };
                return Err(format!("{key}: {missing}"));
            };
            // With a larger change a parameter comes near zero, where results are not linear.
            if !(std > 0.0 && std <= value / 3.0) {
                let rule = format!("must be positive and at most a third of {value:e}, the value itself");
                return Err(allowed(&key, format!("{std:e}"), &rule));
            }
            uncertain.push(Uncertain { parameter, std });
        }
        Ok(uncertain)
    }
}
