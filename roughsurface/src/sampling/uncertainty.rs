//! What uncertain parameters mean for the results.
//!
//! Each parameter is moved by its standard deviation up and down, the prediction repeated, and
//! half the difference taken; parameters are independent, so the squares add up. That is exact for
//! results linear in the parameters over ± one standard deviation. Constants of the material that a
//! table was computed for are moved by giving another table, for which one was: half as exact, but
//! half the price.

use crate::friction::{Friction, Prediction, PredictionError, Settings, predict};
use crate::integral::law_source::{LawSourceError, asperity_law};
use crate::surface::file::{SurfaceFile, SurfaceFileError};
use tables::law::Estimate;

/// What a surface file can call uncertain.
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

/// A result that uncertainties are propagated to.
pub struct Output {
    pub name: &'static str,
    pub units: &'static str,
    value: fn(&Friction) -> Estimate,
}

const UNKNOWN: Estimate = Estimate { value: f64::NAN, error: f64::NAN };

/// Every such result. To add one: a line here.
pub const OUTPUTS: [Output; 7] = [
    Output { name: "mu", units: "1", value: |f| f.sliding.mu },
    Output { name: "mu_static", units: "1", value: |f| f.mu_static },
    Output { name: "Q", units: "Pa", value: |f| f.sliding.shear },
    Output { name: "G", units: "J m-2", value: |f| f.energy_release.unwrap_or(UNKNOWN) },
    Output { name: "G_weakening", units: "J m-2", value: |f| f.weakening_energy },
    Output { name: "real_area_fraction", units: "1", value: |f| f.sliding.area_fraction },
    Output { name: "separation", units: "m", value: |f| f.pressed.separation },
];

/// What was moved, by its key, and its standard deviation where the surface file says it.
#[derive(Clone, Debug, PartialEq)]
pub struct Moved {
    pub key: String,
    pub std: Option<f64>,
}

/// Uncertainties of the results over the cells of a prediction, row by row.
#[derive(Clone, Debug, Default)]
pub struct Propagated {
    pub parameters: Vec<Moved>,
    /// Per cell, output and parameter: the change of the output when the parameter grows by its
    /// standard deviation.
    pub contributions: Vec<[Vec<f64>; OUTPUTS.len()]>,
}

impl Propagated {
    /// Standard deviation of an output in a cell.
    pub fn std(&self, cell: usize, output: usize) -> f64 {
        self.contributions[cell][output].iter().map(|change| change * change).sum::<f64>().sqrt()
    }
}

/// Why there is no propagation.
#[derive(Debug, thiserror::Error)]
pub enum UncertaintyError {
    #[error(
        "uncertainty.{key}: constants of the material of a table are fixed; give the table of a material with it raised in uncertainty.tables, or use --table model:NAME"
    )]
    Fixed { key: &'static str },
    #[error(
        "uncertainty.tables: has no meaning for a closed form; give standard deviations of the constants themselves"
    )]
    NoTable,
    #[error(transparent)]
    File(#[from] SurfaceFileError),
    #[error(transparent)]
    Law(#[from] LawSourceError),
    #[error("with {key} {direction} by its uncertainty: {error}")]
    Prediction { key: String, direction: &'static str, error: PredictionError },
}

/// Repeats the prediction `base` for the law called `table` with every uncertain parameter of
/// `file` moved up and down, and with its other tables.
///
/// ```
/// use roughsurface::friction::{Settings, predict};
/// use roughsurface::integral::law_source::asperity_law;
/// use roughsurface::surface::file::SurfaceFile;
/// use roughsurface::sampling::uncertainty::{OUTPUTS, propagate};
///
/// let text = r#"
/// [surface]
/// asperity_density = 1e10      # 1/m2
/// asperity_radius = 100e-6     # m
/// heights = { distribution = "exponential", std = 0.5e-6 }
/// [query]
/// pressure = [1e6]             # nominal, Pa
/// slip_rate = [1.0]            # m/s
/// [material]
/// youngs_modulus = 205e9
/// poisson_ratio = 0.29
/// yield_strength = 792e6
/// [uncertainty]
/// asperity_density = 1e9       # standard deviations
/// yield_strength = 40e6
/// "#;
/// let file = SurfaceFile::parse("this example".as_ref(), text.to_owned())?;
/// let (table, settings) = ("model:jackson-green", Settings::default());
/// let law = asperity_law(table, file.material.as_ref(), None)?;
/// let base = predict(law.as_ref(), &file.surface, &file.query, &settings, &|_, _| ())?;
/// let found = propagate(&file, table, &base, &settings, &|_, _| ())?;
/// let mu = OUTPUTS.iter().position(|output| output.name == "mu").unwrap();
/// // Of exponential heights friction does not depend on how many summits there are.
/// let [density, strength] = found.contributions[0][mu][..] else { unreachable!() };
/// assert!(density.abs() < 0.02 * strength.abs());
/// assert!((found.std(0, mu) / strength.abs() - 1.0).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn propagate(
    file: &SurfaceFile,
    table: &str,
    base: &Prediction,
    settings: &Settings,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Propagated, UncertaintyError> {
    let is_closed_form = table.starts_with("model:");
    let fixed = file.uncertain.iter().find(|uncertain| uncertain.parameter.is_of_material());
    if let Some(fixed) = fixed.filter(|_| !is_closed_form) {
        return Err(UncertaintyError::Fixed { key: fixed.parameter.key() });
    }
    if is_closed_form && !file.uncertain_tables.is_empty() {
        return Err(UncertaintyError::NoTable);
    }
    let again = |file: &SurfaceFile, table: &str, key: &str, direction| {
        let law = asperity_law(table, file.material.as_ref(), file.temperature)?;
        predict(law.as_ref(), &file.surface, &file.query, settings, progress)
            .map_err(|error| UncertaintyError::Prediction { key: key.into(), direction, error })
    };
    let mut propagated = Propagated::default();
    for uncertain in &file.uncertain {
        let key = uncertain.parameter.key();
        let up = again(&file.varied(uncertain.parameter, uncertain.std)?, table, key, "raised")?;
        let down = again(&file.varied(uncertain.parameter, -uncertain.std)?, table, key, "lowered")?;
        propagated.add(Moved { key: key.into(), std: Some(uncertain.std) }, &up, &down, 0.5);
    }
    for (key, other) in &file.uncertain_tables {
        let up = again(file, &other.to_string_lossy(), key, "raised")?;
        propagated.add(Moved { key: key.clone(), std: None }, &up, base, 1.0);
    }
    Ok(propagated)
}

impl Propagated {
    /// Adds a parameter: `share` of the difference between two predictions is its contribution.
    fn add(&mut self, moved: Moved, up: &Prediction, down: &Prediction, share: f64) {
        self.parameters.push(moved);
        let pairs = up.friction.iter().flatten().zip(down.friction.iter().flatten());
        for (cell, (up, down)) in pairs.enumerate() {
            if self.contributions.len() <= cell {
                self.contributions.push(Default::default());
            }
            for (output, changes) in OUTPUTS.iter().zip(&mut self.contributions[cell]) {
                changes.push(share * ((output.value)(up).value - (output.value)(down).value));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn keys_stand_at_their_parameter() {
        for (index, (parameter, key)) in Parameter::ALL.into_iter().enumerate() {
            assert_eq!((parameter as usize, parameter.key()), (index, key));
        }
    }

    #[test]
    fn elastic_asperities_with_exponential_heights_in_closed_form() {
        // μ = τ₀ √(πR/σ)/E*, so du/u = dY/Y − dE/E − dσ/(2σ) + dR/(2R), and no density in it;
        // p = √π η E* √R σ^{3/2} e^{−d/σ} gives dd/σ = dη/η.
        let text = "
[surface]
asperity_density = 1e10
asperity_radius = 100e-6
heights = { distribution = \"exponential\", std = 1e-9 }
[query]
pressure = [1e3]
slip_rate = [1.0]
[material]
youngs_modulus = 200e9
poisson_ratio = 0.3
yield_strength = 400e6
[uncertainty]
asperity_density = 1e8
asperity_radius = 1e-6
heights_std = 0.02e-9
youngs_modulus = 1e9
yield_strength = 4e6
";
        let file = SurfaceFile::parse(Path::new("surface.toml"), text.into()).unwrap();
        let settings = Settings { tolerance: 1e-9, ..Settings::default() };
        let law = asperity_law("model:hertz", file.material.as_ref(), None).unwrap();
        let base = predict(law.as_ref(), &file.surface, &file.query, &settings, &|_, _| ()).unwrap();
        let mu = base.friction[0][0].sliding.mu.value;
        let found = propagate(&file, "model:hertz", &base, &settings, &|_, _| ()).unwrap();
        let relative = [0.0, 0.005, -0.01, -0.005, 0.01];
        for (change, expected) in found.contributions[0][0].iter().zip(relative) {
            // Second order in one to two per cent.
            assert!((change / mu - expected).abs() < 5e-6, "{change} {expected}");
        }
        let std = relative.iter().map(|share| share * share).sum::<f64>().sqrt();
        assert!((found.std(0, 0) / mu - std).abs() < 1e-5);
        let separation = found.contributions[0][6][0];
        assert!((separation / 1e-9 - 0.01).abs() < 1e-5, "{separation:e}");
    }

    #[test]
    fn impossible_uncertainties_are_named() {
        let text = "
surface = { asperity_density = 1e10, asperity_radius = 1e-4, heights = { distribution = \"gaussian\", std = 1e-6 } }
query = { pressure = [1e5], slip_rate = [1.0] }
uncertainty = { KEY }
";
        let parse = |key: &str| SurfaceFile::parse(Path::new("s.toml"), text.replace("KEY", key));
        for (key, expected) in [
            (
                "heights_std = 0.4e-6",
                "uncertainty.heights_std = 4e-7: must be positive and at most a third of 1e-6",
            ),
            ("yield_strength = 1e6", "uncertainty.yield_strength: needs a section [material]"),
            ("heigths_std = 1e-7", "did you mean heights_std?"),
        ] {
            let message = parse(key).unwrap_err().to_string();
            assert!(message.contains(expected) && message.lines().count() == 1, "{message}");
        }
        let material = text.replace("KEY", "youngs_modulus = 1e9")
            + "material = { youngs_modulus = 200e9, poisson_ratio = 0.3, yield_strength = 1e9 }\n";
        let file = SurfaceFile::parse(Path::new("s.toml"), material).unwrap();
        let law = asperity_law("model:hertz", file.material.as_ref(), None).unwrap();
        let settings = Settings::default();
        let base = predict(law.as_ref(), &file.surface, &file.query, &settings, &|_, _| ()).unwrap();
        let error = propagate(&file, "table.nc", &base, &settings, &|_, _| ()).unwrap_err();
        assert!(error.to_string().starts_with("uncertainty.youngs_modulus: constants"));
        let file = parse("tables = { yield_strength = \"up.nc\" }").unwrap();
        assert_eq!(file.uncertain_tables, [("yield_strength".to_string(), "up.nc".into())]);
        let error = propagate(&file, "model:hertz", &base, &settings, &|_, _| ()).unwrap_err();
        assert!(error.to_string().starts_with("uncertainty.tables: has no meaning"));
    }
}
