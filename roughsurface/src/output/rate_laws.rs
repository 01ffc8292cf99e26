//! Laws of rate dependence, in `friction.nc`, in JSON and as rows of a table.

use crate::friction::rate_law::{FORMS, Limitation, NoFit, RateLaw, RateLaws};
use crate::output::origin::with_error;
use crate::output::result_tables::{Rows, estimate, head};
use crate::sampling::case::Results;
use serde_json::{Value, json};
use tables::law::Estimate;
use tables::netcdf::{DatasetError, DatasetWriter, described};
use tables::numbers::digits;

type Fit = Result<RateLaw, NoFit>;

/// A parameter with an error: name, unit, meaning.
type FitParameter = (&'static str, &'static str, &'static str, fn(&RateLaw) -> Estimate);
const CHOSEN: [FitParameter; 4] = [
    ("rate_mu_0", "1", "friction coefficient at low slip rate, rate law", |law| law.mu_0),
    ("rate_mu_inf", "1", "friction coefficient at high slip rate, rate law", |law| law.plateau),
    ("rate_V_star", "m s-1", "slip rate at which half of the fall of friction is left, rate law", |law| {
        law.velocity
    }),
    ("rate_exponent", "1", "exponent of the slip rate, rate law", |law| law.exponent),
];
const FLASH_HEATING: [FitParameter; 3] = [
    ("mu_0", "1", "friction coefficient at low slip rate, flash-heating fit", |law| law.mu_0),
    ("mu_w", "1", "friction coefficient of fully weakened contacts, flash-heating fit", |law| law.plateau),
    ("V_w", "m s-1", "slip rate at which weakening starts, flash-heating fit", |law| law.velocity),
];

/// How well a law describes friction: ending of the name, meaning.
type Goodness = (&'static str, &'static str, fn(&RateLaw) -> f64);
const GOODNESS: [Goodness; 4] = [
    ("rms", "root mean square misfit", |law| law.misfit),
    ("r_squared", "share of the variance of mu over the slip rates that the law explains", |law| {
        law.r_squared
    }),
    ("condition", "condition number of the Jacobian with columns of equal length", |law| law.condition),
    ("reliable", "1 where the law explains the data and they determine its parameters, 0 elsewhere", |law| {
        f64::from(u8::from(law.limitation().is_none()))
    }),
];

/// Variables over the pressures or separations.
pub(super) fn write(file: &mut DatasetWriter, laws: &[RateLaws], row: &str) -> Result<(), DatasetError> {
    let chosen: Vec<&Fit> = laws.iter().map(|laws| &laws.chosen).collect();
    let names: Vec<&str> =
        chosen.iter().map(|fit| fit.as_ref().map_or("none", |law| law.form.name)).collect();
    let formulas: Vec<String> = FORMS.iter().map(|form| format!("{}: {}", form.name, form.formula)).collect();
    let meaning = "form of the rate law of mu, none where no form is determined";
    file.texts(
        "rate_law",
        &[row],
        &names,
        &[("long_name", meaning.into()), ("comment", formulas.join("\n").as_str().into())],
    )?;
    variables(file, row, &chosen, &CHOSEN, "rate")?;
    let flash_heating: Vec<&Fit> = laws.iter().map(|laws| &laws.flash_heating).collect();
    variables(file, row, &flash_heating, &FLASH_HEATING, "flash_heating")
}

fn variables(
    file: &mut DatasetWriter,
    row: &str,
    fits: &[&Fit],
    parameters: &[FitParameter],
    prefix: &str,
) -> Result<(), DatasetError> {
    let unknown = Estimate::UNKNOWN;
    for (name, unit, long_name, of) in parameters {
        let values: Vec<Estimate> = fits.iter().map(|fit| fit.as_ref().map_or(unknown, of)).collect();
        with_error(file, name, &[row], (unit, long_name), &values)?;
    }
    for (name, long_name, of) in GOODNESS {
        let values: Vec<f64> = fits.iter().map(|fit| fit.as_ref().map_or(f64::NAN, of)).collect();
        let (name, long_name) = (format!("{prefix}_{name}"), format!("{long_name}, {prefix} fit"));
        file.reals(&name, &[row], &values, &described("1", &long_name))?;
    }
    let reason = |fit: &&Fit| match fit {
        Ok(law) => law.limitation().map_or(String::new(), |limitation| limitation.to_string()),
        Err(reason) => reason.to_string(),
    };
    let reasons: Vec<String> = fits.iter().map(reason).collect();
    let meaning = format!("why there is no law or it is not reliable, empty elsewhere, {prefix} fit");
    file.texts(&format!("{prefix}_limitation"), &[row], &reasons, &[("long_name", meaning.as_str().into())])
}

/// The law that is chosen, and every form with its misfit or the reason why it is refused; one entry a row.
pub(super) fn json(row: &str, load: f64, laws: &RateLaws) -> Value {
    let mut entry = fit(row, load, &laws.chosen, &CHOSEN);
    let form = |(form, candidate): (&crate::friction::rate_law::Form, &Fit)| match candidate {
        Ok(law) => {
            json!({"form": form.name, "rms": law.misfit, "criterion": law.criterion, "condition": law.condition})
        }
        Err(reason) => json!({"form": form.name, "not_fitted": reason.to_string()}),
    };
    entry["candidates"] = FORMS.iter().zip(&laws.candidates).map(form).collect();
    entry
}

/// The flash-heating fit; one entry a row.
pub(super) fn flash_heating_json(row: &str, load: f64, laws: &RateLaws) -> Value {
    fit(row, load, &laws.flash_heating, &FLASH_HEATING)
}

fn fit(row: &str, load: f64, fit: &Fit, parameters: &[FitParameter]) -> Value {
    let law = match fit {
        Ok(law) => law,
        Err(reason) => return json!({row: load, "not_fitted": reason.to_string()}),
    };
    let mut entry = json!({row: load, "form": law.form.name, "formula": law.form.formula});
    for (name, unit, _, of) in parameters {
        entry[*name] = json!(of(law).in_unit(unit));
    }
    for (name, _, of) in GOODNESS {
        entry[name] = of(law).into();
    }
    entry["reliable"] = law.limitation().is_none().into();
    if let Some(limitation) = law.limitation() {
        entry["limitation"] = limitation.to_string().into();
    }
    entry
}

/// A parameter; one that is not fitted has no error. One far below its error keeps two digits.
fn shown(parameter: Estimate) -> String {
    const FAR: f64 = 0.01;
    let Estimate { value, error } = parameter;
    match error == 0.0 {
        true => value.to_string(),
        false if error.is_finite() && value.abs() < FAR * error => {
            format!("{} ± {}", digits(value, 2), digits(error, 2))
        }
        false => estimate(parameter),
    }
}

/// Why laws of the rows are not reliable, each reason once.
fn limitations(results: &Results) -> Vec<Limitation> {
    let mut limitations = Vec::new();
    let laws = results.prediction.rate_laws.iter().flat_map(|laws| [&laws.chosen, &laws.flash_heating]);
    for limitation in laws.flatten().filter_map(RateLaw::limitation) {
        if !limitations.contains(&limitation) {
            limitations.push(limitation);
        }
    }
    limitations
}

/// The reasons that the rows refer to by their number.
pub(super) fn footnotes(results: &Results) -> impl Iterator<Item = String> {
    let limitations = limitations(results).into_iter().enumerate();
    limitations.map(|(number, limitation)| format!("[{}] not reliable: {limitation}", number + 1))
}

/// The law that is chosen at each pressure or separation, and the flash-heating fit; empty with one slip rate.
pub(super) fn rows(results: &Results) -> Rows {
    let prediction = &results.prediction;
    if prediction.query.slip_rates.len() < 2 {
        return Rows::new();
    }
    let limitations = limitations(results);
    let mut rows = head(results, ["mu_0", "mu_inf", "V* [m/s]", "n", "misfit [%]", "R2", "law"]);
    for (load, laws) in prediction.query.loading.values().iter().zip(&prediction.rate_laws) {
        for (name, fit) in [("rate law", &laws.chosen), ("flash heating", &laws.flash_heating)] {
            let mut row = vec![format!("{load:.3e}")];
            match fit {
                Ok(law) => {
                    row.extend([law.mu_0, law.plateau, law.velocity, law.exponent].map(shown));
                    row.push(format!("{:.3}", 100.0 * law.misfit / law.mu_0.value));
                    row.push(format!("{:.4}", law.r_squared));
                    let number =
                        limitations.iter().position(|&limitation| law.limitation() == Some(limitation));
                    let footnote = number.map_or(String::new(), |number| format!(" [{}]", number + 1));
                    row.push(law.form.formula.to_string() + &footnote);
                }
                Err(reason) => row.push(format!("{name} not fitted: {reason}")),
            }
            rows.push(row);
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parameter_far_below_its_error_is_no_zero() {
        for (value, error, text) in [
            (6466.76, 1.5e11, "6500 ± 1.5e11"),
            (0.2614, 0.0036, "0.2614 ± 0.0036"),
            (1.7, 1.4, "1.7 ± 1.4"),
            (8.0, 0.0, "8"),
            (0.3, f64::NAN, "0.3 ± ? (error unknown)"),
        ] {
            assert_eq!(shown(Estimate { value, error }), text);
        }
    }
}
