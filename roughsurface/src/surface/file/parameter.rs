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

static PARAMETERS: [Parameter; 6] = [
    Parameter {
        key: "asperity_density",
        is_of_material: false,
        std: |keys| keys.asperity_density,
        value: |file| Some(&mut file.surface.asperity_density),
    },
    Parameter {
        key: "asperity_radius",
        is_of_material: false,
        std: |keys| keys.asperity_radius,
        value: |file| file.surface.asperity_radius.as_mut(),
    },
    Parameter {
        key: "heights_std",
        is_of_material: false,
        std: |keys| keys.heights_std,
        value: |file| file.surface.heights.std.as_mut(),
    },
    Parameter {
        key: "youngs_modulus",
        is_of_material: true,
        std: |keys| keys.youngs_modulus,
        value: |file| Some(&mut file.material.as_mut()?.youngs_modulus),
    },
    Parameter {
        key: "poisson_ratio",
        is_of_material: true,
        std: |keys| keys.poisson_ratio,
        value: |file| Some(&mut file.material.as_mut()?.poisson_ratio),
    },
    Parameter {
        key: "yield_strength",
        is_of_material: true,
        std: |keys| keys.yield_strength,
        value: |file| Some(&mut file.material.as_mut()?.yield_strength),
    },
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
