//! Friction for other programs, read from `friction.nc`.

mod formats;

use crate::friction::rate_law::{FLASH_HEATING, FORMS, RateLaw};
use crate::output::friction_file::INITIAL_TEMPERATURE;
use std::path::Path;
use tables::law::Estimate;
use tables::netcdf::{DatasetError, DatasetReader};
use tables::numbers::Spacing;
use tables::quantity::COVERAGE_FACTOR;
use tables::table::sentences::by_temperature;

/// A format, with the extension that decides on it.
pub struct Format {
    pub extension: &'static str,
    /// Programs that read it.
    pub readers: &'static str,
    write: fn(&FrictionTable) -> String,
}

/// Every format.
pub static FORMATS: [Format; 4] = [
    Format { extension: "inp", readers: "Abaqus (*FRICTION)", write: formats::abaqus },
    Format {
        extension: "txt",
        readers: "COMSOL (interpolation function, data format Grid)",
        write: formats::comsol,
    },
    Format { extension: "csv", readers: "MATLAB (readtable), pandas, spreadsheets", write: formats::csv },
    Format { extension: "json", readers: "codes that evaluate the rate law", write: formats::json },
];

impl Format {
    /// The format of a file of that name; the error lists all.
    pub fn of(path: &Path) -> Result<&'static Self, ExportError> {
        let is_of =
            |format: &&Self| path.extension().is_some_and(|own| own.eq_ignore_ascii_case(format.extension));
        FORMATS.iter().find(is_of).ok_or_else(|| {
            let known = FORMATS.iter().map(|format| format!(".{} for {}", format.extension, format.readers));
            let known: Vec<String> = known.collect();
            ExportError::Format { path: path.display().to_string(), known: known.join(", ") }
        })
    }

    /// The content of the file.
    pub fn text(&self, table: &FrictionTable) -> String {
        (self.write)(table)
    }
}

/// Reason why friction cannot be exported.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    #[error(transparent)]
    Dataset(#[from] DatasetError),
    #[error("{path}: the extension decides on the format; choose a name that ends in {known}")]
    Format { path: String, known: String },
    #[error("{path}: {what}")]
    Content { path: String, what: String },
    #[error("no result to export: at least one friction.nc is needed")]
    NoFile,
}

/// Friction over initial temperature, pressure and slip rate.
pub struct FrictionTable {
    /// Pa.
    pub pressures: Vec<f64>,
    /// m/s.
    pub slip_rates: Vec<f64>,
    /// Friction at each initial temperature, by ascending temperature.
    pub layers: Vec<Layer>,
}

/// Friction at one initial temperature.
pub struct Layer {
    /// File that it is read from.
    pub source: String,
    /// K, where the query or the table states it.
    pub temperature: Option<f64>,
    /// Sliding friction, slip rates of a pressure beside each other, 1.
    pub mu: Vec<Estimate>,
    /// Fitted to it at each pressure.
    pub laws: Vec<FittedLaw>,
    /// The form of rupture codes likewise.
    pub flash_heating: Vec<FittedLaw>,
    /// Limits of validity that the prediction reached.
    pub warnings: Vec<String>,
}

/// A law, and why it is not reliable; or why there is none. Empty where it is reliable, or where the file does not say.
type FittedLaw = Result<(RateLaw, String), String>;

impl FrictionTable {
    /// Files that it is read from.
    fn sources(&self) -> Vec<&str> {
        self.layers.iter().map(|layer| layer.source.as_str()).collect()
    }

    fn warnings(&self) -> Vec<String> {
        let of_layers = self.layers.iter().map(|layer| (layer.temperature, &layer.warnings[..]));
        by_temperature(&of_layers.collect::<Vec<_>>())
    }

    /// Pressures (Pa) whose fitted law is not reliable, with the reason.
    pub fn limitations(&self) -> impl Iterator<Item = (f64, &str)> {
        let laws = self.layers.iter().flat_map(|layer| self.pressures.iter().zip(&layer.laws));
        let limitations = laws.filter_map(|(pressure, law)| Some((*pressure, law.as_ref().ok()?.1.as_str())));
        limitations.filter(|(_, limitation)| !limitation.is_empty())
    }

    /// Reads one file, or one for each initial temperature.
    pub fn read(paths: &[&Path]) -> Result<Self, ExportError> {
        let mut whole: Option<Self> = None;
        for path in paths {
            let mut one = Self::read_one(path)?;
            let Some(table) = &mut whole else {
                whole = Some(one);
                continue;
            };
            let (path, first) = (path.display().to_string(), table.layers[0].source.clone());
            let same = [
                ("the pressures", one.pressures == table.pressures),
                ("the slip rates", one.slip_rates == table.slip_rates),
            ];
            if let Some((what, _)) = same.into_iter().find(|(_, same)| !same) {
                let what = format!("{what} differ from those of {first}; predict both with the same query");
                return Err(ExportError::Content { path, what });
            }
            table.layers.append(&mut one.layers);
        }
        let Some(mut table) = whole else { return Err(ExportError::NoFile) };
        let kelvin = |layer: &Layer| layer.temperature.unwrap_or(f64::NEG_INFINITY);
        let refused = (0..paths.len()).find(|&i| {
            let before =
                table.layers[..i].iter().any(|layer| layer.temperature == table.layers[i].temperature);
            paths.len() > 1 && (before || table.layers[i].temperature.is_none())
        });
        if let Some(i) = refused {
            let Layer { source, temperature, .. } = table.layers.swap_remove(i);
            let own = temperature.map_or("none".into(), |kelvin| format!("{kelvin} K, as another one"));
            let what = format!(
                "several files must have an initial temperature each, query.temperature, and this one has {own}"
            );
            return Err(ExportError::Content { path: source, what });
        }
        table.layers.sort_by(|one, other| kelvin(one).total_cmp(&kelvin(other)));
        Ok(table)
    }

    fn read_one(path: &Path) -> Result<Self, ExportError> {
        let shown = path.display().to_string();
        let refused = |what: &str| Err(ExportError::Content { path: shown.clone(), what: what.into() });
        let file = DatasetReader::open(path)?;
        if file.has("realization") {
            return refused("a result of `sample`, of single surfaces; a result of `predict` is exported");
        }
        if file.has("separation") && file.shape("separation")?.len() == 1 {
            return refused(
                "friction is given over the separation, other programs need it over the pressure; predict with query.pressure",
            );
        }
        if !file.has("rate_law") || !file.has("pressure") || file.shape("pressure")?.len() != 1 {
            return refused("not a result of `roughsurface predict`, which is exported");
        }
        let (pressures, slip_rates) = (file.coordinate("pressure")?, file.coordinate("slip_rate")?);
        let mu = file.estimates("mu", &[pressures.len(), slip_rates.len()])?;
        if let Some(cell) = mu.iter().position(|mu| mu.value.is_nan()) {
            let (pressure, slip_rate) =
                (pressures[cell / slip_rates.len()], slip_rates[cell % slip_rates.len()]);
            return refused(&format!("mu is not known at {pressure:e} Pa and {slip_rate} m/s"));
        }
        let rows = [pressures.len()];
        let exponents = file.estimates("rate_exponent", &rows)?;
        let chosen = fitted(&file, ["rate_mu_0", "rate_mu_inf", "rate_V_star"], &exponents, "rate")?;
        let eight = vec![Estimate::exact(8.0); pressures.len()];
        let flash_heating = fitted(&file, ["mu_0", "mu_w", "V_w"], &eight, "flash_heating")?;
        let temperature = file.optional_real(INITIAL_TEMPERATURE)?;
        let warnings = file.optional_text("warnings")?.unwrap_or_default();
        let warnings = warnings.lines().map(str::to_owned).collect();
        let layer = Layer { source: shown, temperature, mu, laws: chosen, flash_heating, warnings };
        Ok(Self { pressures, slip_rates, layers: vec![layer] })
    }

    /// The table with the values of the fitted laws at slip rates in equal ratios, ten a decade. Their errors are those of the
    /// values that the laws were fitted to, interpolated in the logarithm of the slip rate, and twice the misfit, as squares.
    pub fn of_laws(mut self) -> Result<Self, ExportError> {
        const A_DECADE: f64 = 10.0;
        let first = self.slip_rates.iter().copied().find(|rate| *rate > 0.0).unwrap_or(1.0);
        let last = *self.slip_rates.last().expect("there is a slip rate");
        let count = ((last / first).log10() * A_DECADE).ceil().max(1.0) as usize;
        let rates = Spacing::Log.range(first, last, count + 1);
        let logarithms: Vec<f64> = self.slip_rates.iter().map(|rate| rate.ln()).collect();
        for layer in &mut self.layers {
            let computed = std::mem::take(&mut layer.mu);
            let rows = computed.chunks(self.slip_rates.len());
            for ((law, &pressure), row) in layer.laws.iter().zip(&self.pressures).zip(rows) {
                let no_law = |reason: &String| {
                    let reason = if reason.is_empty() { String::new() } else { format!(": {reason}") };
                    let what = format!(
                        "no rate law is fitted at {pressure:e} Pa{reason}; without --law the values computed are exported"
                    );
                    ExportError::Content { path: layer.source.clone(), what }
                };
                let (law, _) = law.as_ref().map_err(no_law)?;
                let value = |rate: &f64| Estimate {
                    value: law.friction_coefficient(*rate),
                    error: error_at(&logarithms, row, rate.ln()).hypot(COVERAGE_FACTOR * law.misfit),
                };
                layer.mu.extend(rates.iter().map(value));
            }
        }
        self.slip_rates = rates;
        Ok(self)
    }
}

/// The laws of each pressure, from the variables of μ_0, the plateau and the slip rate, and those called after `prefix`.
fn fitted(
    file: &DatasetReader,
    names: [&str; 3],
    exponents: &[Estimate],
    prefix: &str,
) -> Result<Vec<FittedLaw>, DatasetError> {
    let rows = [exponents.len()];
    let [mu_0, plateau, velocity] = names.map(|name| file.estimates(name, &rows));
    let (mu_0, plateau, velocity) = (mu_0?, plateau?, velocity?);
    let misfits = file.reals(&format!("{prefix}_rms"), &rows)?;
    let law = |row: usize| -> Result<FittedLaw, DatasetError> {
        let limitation = format!("{prefix}_limitation");
        let limitation = if file.has(&limitation) { file.text(&limitation, &[row])? } else { String::new() };
        let form = match prefix {
            "rate" => {
                let name = file.text("rate_law", &[row])?;
                FORMS.iter().find(|form| form.name == name)
            }
            _ => Some(&FLASH_HEATING).filter(|_| mu_0[row].value.is_finite()),
        };
        let Some(form) = form else { return Ok(Err(limitation)) };
        let law = RateLaw {
            form,
            mu_0: mu_0[row],
            plateau: plateau[row],
            velocity: velocity[row],
            exponent: exponents[row],
            misfit: misfits[row],
            r_squared: f64::NAN,
            criterion: f64::NAN,
            condition: f64::NAN,
            second: f64::NAN,
            fastest: f64::NAN,
        };
        Ok(Ok((law, limitation)))
    };
    (0..exponents.len()).map(law).collect()
}

/// Error of the values of a row at the logarithm of a slip rate, linear between those computed.
fn error_at(logarithms: &[f64], row: &[Estimate], logarithm: f64) -> f64 {
    let after = logarithms.partition_point(|known| *known < logarithm).clamp(1, row.len().max(2) - 1);
    let (from, to) = (after - 1, after.min(row.len() - 1));
    let width = logarithms[to] - logarithms[from];
    // A slip rate of 0 is infinitely far.
    let share = if width.is_finite() && width > 0.0 { (logarithm - logarithms[from]) / width } else { 1.0 };
    let share = share.clamp(0.0, 1.0);
    (1.0 - share) * row[from].error + share * row[to].error
}
