//! Uncertain parameters propagated to the results.
//!
//! Each parameter is varied by its standard deviation up and down, the prediction repeated, and half the
//! difference taken; parameters are independent, so the squares add up. Results linear in the parameters
//! over ± one standard deviation are exact. Constants of the material that a table was computed for are
//! varied by another table, on one side only: first order instead of second; so are radii of which one side leaves
//! the slip rates of the table.

use crate::friction::quantities::{QUANTITIES, SurfaceQuantity};
use crate::friction::warning::Warning;
use crate::friction::{Prediction, PredictionError, Settings, predict};
use crate::integral::law_source::{LawSource, LawSourceError};
use crate::surface::file::{SurfaceFile, SurfaceFileError};
use tables::law::LookupError;
use tables::table::comparison::request_differences;

/// A parameter that was varied, and its standard deviation where the surface file states it.
#[derive(Clone, Debug, PartialEq)]
pub struct VariedParameter {
    pub key: String,
    pub std: Option<f64>,
}

/// Results that uncertainties are propagated to, in the order of [`Propagated::contributions`].
pub fn outputs() -> impl Iterator<Item = &'static SurfaceQuantity> {
    QUANTITIES.iter().filter(|quantity| quantity.propagated)
}

/// Uncertainties of the results over the cells of a prediction, row by row.
#[derive(Clone, Debug, Default)]
pub struct Propagated {
    pub parameters: Vec<VariedParameter>,
    /// Per cell, output and parameter: the change of the output when the parameter grows by its
    /// standard deviation.
    pub contributions: Vec<Vec<Vec<f64>>>,
    /// Tables that differ in more than one constant.
    pub warnings: Vec<Warning>,
}

impl Propagated {
    /// Standard deviation of an output in a cell.
    pub fn std(&self, cell: usize, output: usize) -> f64 {
        self.contributions[cell][output].iter().map(|change| change * change).sum::<f64>().sqrt()
    }

    /// Adds a parameter: `share` of the difference between two predictions is its contribution.
    fn add(&mut self, varied: VariedParameter, up: &Prediction, down: &Prediction, share: f64) {
        self.parameters.push(varied);
        let cells = up.friction.iter().flatten().zip(down.friction.iter().flatten());
        for (cell, (up, down)) in cells.enumerate() {
            if self.contributions.len() <= cell {
                self.contributions.push(vec![Vec::new(); outputs().count()]);
            }
            for (output, changes) in outputs().zip(&mut self.contributions[cell]) {
                changes.push(share * (output.estimate(up).value - output.estimate(down).value));
            }
        }
    }
}

/// Reason of a failed propagation.
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
    #[error(
        "uncertainty.tables.{key}: \"{table}\" has the constants of the table itself; give one with a constant raised by its standard deviation"
    )]
    SameTable { key: String, table: String },
    #[error("uncertainty.tables.{key} = \"{table}\": {reason}")]
    OtherTable { key: String, table: String, reason: String },
    #[error(transparent)]
    File(#[from] SurfaceFileError),
    #[error(transparent)]
    Law(#[from] LawSourceError),
    #[error("with {key} {direction} by its uncertainty: {error}")]
    Prediction { key: String, direction: &'static str, error: PredictionError },
}

impl UncertaintyError {
    /// Whether the varied parameter takes a slip rate out of the table, as another radius does.
    fn leaves_slip_rates(&self) -> bool {
        let Self::Prediction { error, .. } = self else { return false };
        use LookupError::{NoSlipRateInCommon, SlipRateOutside};
        matches!(error, PredictionError::Lookup(SlipRateOutside { .. } | NoSlipRateInCommon { .. }))
    }
}

/// Another table that cannot be used.
fn not_opened(key: &str, table: &str, error: &LawSourceError) -> UncertaintyError {
    let reason = match error {
        LawSourceError::Table(reason) => reason.to_string(),
        other => other.to_string(),
    };
    UncertaintyError::OtherTable { key: key.to_owned(), table: table.to_owned(), reason }
}

/// Repeats the prediction `base` for the law called `table` with every uncertain parameter of
/// `file` moved up and down, and with its other tables, around whose cells without results `interpolate_missing` says
/// to interpolate.
pub fn propagate(
    file: &SurfaceFile,
    (table, interpolate_missing): (&str, bool),
    base: &Prediction,
    settings: &Settings,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Propagated, UncertaintyError> {
    let is_closed_form = table.starts_with("model:");
    let fixed = file.uncertain.iter().find(|uncertain| uncertain.parameter.is_of_material);
    if let Some(fixed) = fixed.filter(|_| !is_closed_form) {
        return Err(UncertaintyError::Fixed { key: fixed.parameter.key });
    }
    if is_closed_form && !file.uncertain_tables.is_empty() {
        return Err(UncertaintyError::NoTable);
    }
    let mut propagated = Propagated::default();
    for (key, other) in &file.uncertain_tables {
        let other = other.to_string_lossy();
        let opened = LawSource::open(&other, file.material.as_ref(), file.temperature, interpolate_missing);
        let law = opened.map_err(|error| not_opened(key, &other, &error))?.law;
        match differing(&base.request, law.request()) {
            Some(constants) if constants.is_empty() => {
                return Err(UncertaintyError::SameTable { key: key.clone(), table: other.into() });
            }
            Some(constants) if constants.len() > 1 => {
                propagated.warnings.push(Warning::TablesDiffer { key: key.clone(), constants });
            }
            _ => {}
        }
    }
    let again = |file: &SurfaceFile, table: &str, key: &str, direction| {
        let law = LawSource::open(table, file.material.as_ref(), file.temperature, interpolate_missing)?.law;
        predict(law.as_ref(), &file.surface, &file.query, settings, progress)
            .map_err(|error| UncertaintyError::Prediction { key: key.into(), direction, error })
    };
    for uncertain in &file.uncertain {
        let key = uncertain.parameter.key;
        let [up, down] =
            [(uncertain.std, "raised"), (-uncertain.std, "lowered")].map(|(change, direction)| {
                again(&file.varied(uncertain.parameter, change)?, table, key, direction)
            });
        let varied = VariedParameter { key: key.into(), std: Some(uncertain.std) };
        match (up, down) {
            (Ok(up), Err(error)) if error.leaves_slip_rates() => {
                propagated.add(varied, &up, base, 1.0);
                propagated.warnings.push(Warning::OneSided { key });
            }
            (Err(error), Ok(down)) if error.leaves_slip_rates() => {
                propagated.add(varied, base, &down, 1.0);
                propagated.warnings.push(Warning::OneSided { key });
            }
            (up, down) => propagated.add(varied, &up?, &down?, 0.5),
        }
    }
    for (key, other) in &file.uncertain_tables {
        let up = again(file, &other.to_string_lossy(), key, "raised")?;
        propagated.add(VariedParameter { key: key.clone(), std: None }, &up, base, 1.0);
    }
    Ok(propagated)
}

/// Constants of body, interface and counterface in which the requests of two tables differ, as `material.youngs_modulus`;
/// none of a table without request.
fn differing(one: &str, other: &str) -> Option<Vec<String>> {
    let of_bodies = |key: &String| {
        ["material.", "interface.", "counterface."].iter().any(|section| key.starts_with(section))
    };
    let keys = request_differences(one, other).into_iter().map(|differs| differs.key).filter(of_bodies);
    (!one.is_empty() && !other.is_empty()).then(|| keys.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    /// Summits that the table of steel has results for.
    const STEEL: (f64, f64, &str) = (1e8, 1e-3, "distribution = \"gaussian\", std = 4e-7");

    /// A surface file by density (1/m²), radius (m) and heights of its summits, the keys of its query and other sections.
    fn parse(
        (density, radius, heights): (f64, f64, &str),
        query: &str,
        sections: &str,
    ) -> Result<SurfaceFile, SurfaceFileError> {
        let text = format!(
            "surface = {{ asperity_density = {density:e}, asperity_radius = {radius:e}, heights = {{ {heights} }} }}\n\
             query = {{ {query} }}\n{sections}\n"
        );
        SurfaceFile::parse(Path::new("surface.toml"), text)
    }

    /// With cells without results interpolated around.
    fn base(table: &str, file: &SurfaceFile, settings: &Settings) -> Prediction {
        let law = LawSource::open(table, file.material.as_ref(), None, true).unwrap().law;
        predict(law.as_ref(), &file.surface, &file.query, settings, &|_, _| ()).unwrap()
    }

    #[test]
    fn constants_in_which_tables_differ_are_found() {
        let [one, other] = [("400e6", "0.3", "5"), ("420e6", "0.4", "7")].map(|(strength, exponent, last)| {
            format!(
                "[material]\nyield_strength = {strength}\n[material.softening]\nexponent = {exponent}\n[table]\n\
                 interference = [1, {last}]\n"
            )
        });
        assert_eq!(differing(&one, &one).unwrap(), Vec::<String>::new());
        assert_eq!(
            differing(&one, &other).unwrap(),
            ["material.yield_strength", "material.softening.exponent"]
        );
        assert_eq!(differing(&one, ""), None);
    }

    #[test]
    fn elastic_asperities_with_exponential_heights_in_closed_form() {
        // μ = τ₀ √(πR/σ)/E*, so du/u = dY/Y − dE/E − dσ/(2σ) + dR/(2R), and no density in it;
        // p = √π η E* √R σ^{3/2} e^{−d/σ} gives dd/σ = dη/η.
        let sections = "material = { youngs_modulus = 200e9, poisson_ratio = 0.3, yield_strength = 400e6 }
[uncertainty]
asperity_density = 1e8
asperity_radius = 1e-6
heights_std = 0.02e-9
youngs_modulus = 1e9
yield_strength = 4e6";
        let summits = (1e10, 1e-4, "distribution = \"exponential\", std = 1e-9");
        let file = parse(summits, "pressure = [1e3], slip_rate = [1.0]", sections).unwrap();
        let settings = Settings { tolerance: 1e-9, ..Settings::default() };
        let base = base("model:hertz", &file, &settings);
        let mu = base.friction[0][0].sliding.mu.value;
        let found = propagate(&file, ("model:hertz", false), &base, &settings, &|_, _| ()).unwrap();
        let relative = [0.0, 0.005, -0.01, -0.005, 0.01];
        for (change, expected) in found.contributions[0][0].iter().zip(relative) {
            // Second order in one to two per cent.
            assert!((change / mu - expected).abs() < 5e-6, "{change} {expected}");
        }
        let std = relative.iter().map(|share| share * share).sum::<f64>().sqrt();
        assert!((found.std(0, 0) / mu - std).abs() < 1e-5);
        let place = outputs().position(|output| output.name == "separation").unwrap();
        let separation = found.contributions[0][place][0];
        assert!((separation / 1e-9 - 0.01).abs() < 1e-5, "{separation:e}");
    }

    #[test]
    fn tables_with_failed_cells_are_read_as_for_the_prediction() {
        let mut table = tables::shipped::load("steel-4340").unwrap().only().unwrap().clone();
        let (i, j) = (table.axes().interference.len() / 2, table.axes().slip_rate.len() / 2);
        table.mark_failed(i, j, "no convergence");
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("gap.nc");
        table.write(&path).unwrap();
        let path = path.to_str().unwrap();
        let query = format!("pressure = [1e6], slip_rate = [{:?}]", table.axes().slip_rate[j]);
        let file = parse(STEEL, &query, "uncertainty = { asperity_density = 1e7 }").unwrap();
        let settings = Settings { slip_points: 8, ..Settings::default() };
        let base = base(path, &file, &settings);
        let found = |missing| propagate(&file, (path, missing), &base, &settings, &|_, _| ());
        assert!(found(true).unwrap().std(0, 0) > 0.0);
        assert!(found(false).unwrap_err().to_string().contains("no convergence"));
    }

    /// A larger sphere takes 10 m/s out of the table, which has V·R up to 10 m/s times 1 mm.
    #[test]
    fn a_radius_at_the_end_of_the_slip_rates_is_varied_in_one_direction() {
        let change = |slip_rate: f64| {
            let query = format!("pressure = [1e6], slip_rate = [{slip_rate:?}]");
            let file = parse(STEEL, &query, "uncertainty = { asperity_radius = 2e-5 }").unwrap();
            let settings = Settings::default();
            let base = base("steel-4340", &file, &settings);
            let found = propagate(&file, ("steel-4340", false), &base, &settings, &|_, _| ()).unwrap();
            (found.contributions[0][0][0], found.warnings)
        };
        let ((both, none), (one, warnings)) = (change(9.7), change(10.0));
        assert!(none.is_empty());
        assert_eq!(warnings, [Warning::OneSided { key: "asperity_radius" }]);
        assert!(both != 0.0 && (one / both - 1.0).abs() < 0.2, "{one} {both}");
    }

    #[test]
    fn impossible_uncertainties_are_named() {
        let with = |key: &str, sections: &str| {
            let summits = (1e10, 1e-4, "distribution = \"gaussian\", std = 1e-6");
            let sections = format!("uncertainty = {{ {key} }}\n{sections}");
            self::parse(summits, "pressure = [1e5], slip_rate = [1.0]", &sections)
        };
        let parse = |key: &str| with(key, "");
        for (key, expected) in [
            (
                "heights_std = 0.4e-6",
                "uncertainty.heights_std = 4e-7: must be positive and at most a third of 1e-6",
            ),
            (
                "yield_strength = 1e6",
                "uncertainty.yield_strength: needs a section [material]; beside a table of runs the key uncertainty.tables",
            ),
            ("heigths_std = 1e-7", "did you mean heights_std?"),
        ] {
            let message = parse(key).unwrap_err().to_string();
            assert!(message.contains(expected) && message.lines().count() == 1, "{message}");
        }
        let hard = "material = { youngs_modulus = 200e9, poisson_ratio = 0.3, yield_strength = 1e9 }";
        let file = with("youngs_modulus = 1e9", hard).unwrap();
        let settings = Settings::default();
        let base = base("model:hertz", &file, &settings);
        let error = propagate(&file, ("table.nc", false), &base, &settings, &|_, _| ()).unwrap_err();
        assert!(error.to_string().starts_with("uncertainty.youngs_modulus: constants"));
        let file = parse("tables = { yield_strength = \"up.nc\" }").unwrap();
        assert_eq!(file.uncertain_tables, [("yield_strength".to_string(), "up.nc".into())]);
        let error = propagate(&file, ("model:hertz", false), &base, &settings, &|_, _| ()).unwrap_err();
        assert!(error.to_string().starts_with("uncertainty.tables: has no meaning"));
        // A standard deviation that is allowed for the value is not compared with the varied value.
        let file = parse("heights_std = 0.33e-6").unwrap();
        let heights_std = file.uncertain[0].parameter;
        for change in [-0.33e-6, 0.33e-6] {
            let varied = file.varied(heights_std, change).unwrap().surface.heights.standard_deviation();
            assert!((varied / (1e-6 + change) - 1.0).abs() < 1e-12, "{varied:e}");
        }
        let soft = "material = { youngs_modulus = 2e6, poisson_ratio = 0.45, yield_strength = 1e6 }";
        let file = with("poisson_ratio = 0.1", soft).unwrap();
        let error = file.varied(file.uncertain[0].parameter, 0.1).unwrap_err().to_string();
        let expected =
            "uncertainty.poisson_ratio: with one standard deviation of 1e-1, material.poisson_ratio = 0.55";
        assert!(error.contains(expected), "{error}");
    }
}
