//! Finite surfaces as CF netCDF files, as text and as JSON.

use crate::friction::quantities::{QUANTITIES, Source};
use crate::output::origin::{Origin, coordinate, grid_coordinates};
use crate::output::summary_json::row_key;
use crate::sampling::finite_surface::{SampledState, Samples};
use crate::sampling::scatter::Scatter;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::Path;
use tables::law::Estimate;
use tables::netcdf::{DatasetError, DatasetWriter, described};
use tables::numbers::{digits, with_error};

/// Name, long name and value of a measure of scatter.
type Statistic = (&'static str, &'static str, fn(&Scatter) -> f64);

const STATISTICS: [Statistic; 5] = [
    ("mean", "mean over the surfaces of the", |s| s.mean),
    ("mean_error", "half width of the 95 % confidence interval of the mean of the", |s| s.mean_error),
    ("std", "standard deviation over the surfaces of the", |s| s.standard_deviation),
    ("lower", "lower end of the 95 % prediction interval of the", |s| s.lower),
    ("upper", "upper end of the 95 % prediction interval of the", |s| s.upper),
];

/// Title of `mc.nc`.
pub const TITLE: &str = "Friction of finite rough surfaces";

/// Writes `mc.nc`; the file appears whole or not at all.
pub fn write(path: &Path, samples: &Samples, origin: &Origin) -> Result<(), DatasetError> {
    let mut file = DatasetWriter::create(path, TITLE)?;
    origin.write(&mut file, &samples.law, &samples.query, &samples.warnings)?;
    let sampling = &samples.sampling;
    file.attribute("asperities", sampling.asperities as f64)?;
    // A netCDF number would lose the last digits of a large seed.
    file.attribute("seed", sampling.seed.to_string().as_str())?;
    if let Some(slip) = sampling.slip {
        file.attribute("slip", slip)?;
    }
    let row = grid_coordinates(&mut file, &samples.query)?;
    let numbers: Vec<f64> = (1..=sampling.realizations).map(|number| number as f64).collect();
    coordinate(&mut file, "realization", &numbers, ("1", "number of the surface"), "X")?;

    let mut variable = |name: &str, unit: &str, long_name: &str, of: &dyn Fn(&SampledState) -> f64| {
        let states = samples.states.iter();
        let values: Vec<f64> = states.clone().flatten().map(of).collect();
        file.reals(name, &[row, "slip_rate", "realization"], &values, &described(unit, long_name))?;
        let scatter = |surfaces: &Vec<SampledState>| {
            let scatter = Scatter::of(surfaces.iter().map(of));
            // The separation alone may be negative.
            if unit == "m" { scatter } else { scatter.not_negative() }
        };
        let scatters: Vec<Scatter> = states.map(scatter).collect();
        for (statistic, words, of) in STATISTICS {
            let values: Vec<f64> = scatters.iter().map(of).collect();
            let attributes = described(unit, &format!("{words} {long_name}"));
            file.reals(&format!("{name}_{statistic}"), &[row, "slip_rate"], &values, &attributes)?;
        }
        let infinite = samples.infinite.iter();
        let infinite: Vec<f64> = infinite.map(|state| state.as_ref().map_or(f64::NAN, of)).collect();
        let bias: Vec<f64> =
            scatters.iter().zip(&infinite).map(|(one, infinite)| one.mean - infinite).collect();
        for (name, words, values) in [
            (format!("{name}_infinite"), "surface of infinite extent:", &infinite),
            (format!("{name}_bias"), "mean over the surfaces less the surface of infinite extent:", &bias),
        ] {
            let attributes = described(unit, &format!("{words} {long_name}"));
            file.reals(&name, &[row, "slip_rate"], values, &attributes)?;
        }
        Ok(())
    };
    for quantity in &QUANTITIES {
        if let Source::SteadySliding(of) = quantity.source {
            variable(quantity.name, quantity.unit, quantity.long_name, &|one| of(&one.state).value)?;
        }
    }
    variable("contacts", "1", "number of asperities in contact", &|one| one.contacts)?;
    let long_name = "share of the load carried beyond the range of the table";
    variable("outside_table_fraction", "1", long_name, &|one| one.state.outside)?;
    file.finish()
}

/// Friction and contacts at one load and slip rate.
struct SampledFriction {
    /// Pa or m.
    load: f64,
    /// m/s.
    slip_rate: f64,
    mu: Scatter,
    /// Mean μ over the surfaces less that of the surface of infinite extent.
    bias: f64,
    contacts: Scatter,
}

fn cells(samples: &Samples) -> impl Iterator<Item = SampledFriction> {
    let states = samples.states.iter().zip(&samples.infinite);
    samples.query.cells().zip(states).map(|((load, slip_rate), (surfaces, infinite))| {
        let mu = Scatter::of(surfaces.iter().map(|one| one.state.mu.value)).not_negative();
        let bias = mu.mean - infinite.map_or(f64::NAN, |infinite| infinite.state.mu.value);
        let contacts = Scatter::of(surfaces.iter().map(|one| one.contacts)).not_negative();
        SampledFriction { load, slip_rate, mu, bias, contacts }
    })
}

/// The samples as lines of text.
pub fn text(samples: &Samples) -> String {
    let head = samples.query.loading.heading();
    let width = head.len().max(13);
    let state = match samples.sampling.slip {
        Some(slip) => format!("after a slip of {slip:.3e} m"),
        None => format!("contact life {}", samples.query.contact_life),
    };
    let mut text = format!(
        "{} surfaces of {} asperities, {state}; 95 % intervals; bias: mean less mu of a surface of infinite extent\n\
         {head:>width$}   slip rate [m/s]                  mean mu        bias   mu of one surface   contacts\n",
        samples.sampling.realizations, samples.sampling.asperities
    );
    for SampledFriction { load, slip_rate, mu, bias, contacts } in cells(samples) {
        let _ = writeln!(
            text,
            "{load:>width$.3e}   {:>15}   {:>22}   {:>9}   {:>9} to {}   {:.0} to {:.0}",
            digits(slip_rate, 4),
            with_error(Estimate { value: mu.mean, error: mu.mean_error }, "1"),
            digits(bias, 2),
            digits(mu.lower, 4),
            digits(mu.upper, 4),
            contacts.lower,
            contacts.upper
        );
    }
    text
}

/// The mean with its error and unit, and the scatter.
fn scatter(scatter: Scatter) -> Value {
    let mut value = json!(Estimate { value: scatter.mean, error: scatter.mean_error }.in_unit("1"));
    value["standard_deviation"] = json!(scatter.standard_deviation);
    value["lower"] = json!(scatter.lower);
    value["upper"] = json!(scatter.upper);
    value
}

/// The samples as JSON.
pub fn json(samples: &Samples) -> Value {
    let row = row_key(&samples.query.loading);
    let cells = cells(samples).map(|SampledFriction { load, slip_rate, mu, bias, contacts }| {
        let mut friction = scatter(mu);
        friction["bias"] = json!(bias);
        json!({row: load, "slip_rate": slip_rate, "mu": friction, "contacts": scatter(contacts)})
    });
    let warnings: Vec<String> = samples.warnings.iter().map(ToString::to_string).collect();
    json!({
        "law": samples.law,
        "hold": samples.query.control,
        "asperities": samples.sampling.asperities,
        "realizations": samples.sampling.realizations,
        "seed": samples.sampling.seed,
        "slip": samples.sampling.slip,
        "friction": cells.collect::<Vec<Value>>(),
        "warnings": warnings,
    })
}
