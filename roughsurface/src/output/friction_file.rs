//! Predictions as CF netCDF files, `friction.nc`.

use crate::friction::Friction;
use crate::friction::comparison::Comparison;
use crate::friction::flash_heating::{FlashHeating, NoFit};
use crate::friction::quantities::{QUANTITIES, Quantity, Source};
use crate::friction::regime::regime;
use crate::output::cutoffs;
use crate::output::origin::{Origin, coordinate, described, grid_coordinates, with_error};
use crate::sampling::case::Results;
use crate::sampling::uncertainty::{Propagated, outputs};
use std::path::Path;
use tables::law::Estimate;
use tables::netcdf::{DatasetError, DatasetWriter};

const COMMENT: &str = "Greenwood-Williamson integration of one-asperity friction over summit heights. \
NAME_error is an estimate of the absolute error of NAME: error of the table with one sign in all \
asperities, quadrature, slip grid and pressure. Independent asperities of one radius, rigid smooth flat. \
Under held load the flat sinks as asperities lose load; each asperity then follows the slide tabulated \
at its present interference.";

/// Results that a comparison with a model of the literature has.
pub(super) const COMPARED: [&str; 4] = ["mu", "mu_static", "real_area_fraction", "outside_table_fraction"];

/// Writes `friction.nc`: under a temporary name first, so the file appears whole or not at all.
pub fn write(path: &Path, results: &Results, origin: &Origin) -> Result<(), DatasetError> {
    let prediction = &results.prediction;
    let mut file = DatasetWriter::create(path, "Friction of a rough surface")?;
    origin.write(&mut file, &prediction.law, &prediction.query, &prediction.warnings)?;
    file.attribute("comment", COMMENT)?;
    file.attribute("plasticity_index", prediction.plasticity_index)?;
    file.attribute("regime", regime(prediction.plasticity_index))?;

    let row = grid_coordinates(&mut file, &prediction.query)?;
    coordinate(&mut file, "slip", &prediction.slip, ("m", "slip of the flat along the surface"), "X")?;
    let grid = [row, "slip_rate"];
    let cells: Vec<&Friction> = prediction.friction.iter().flatten().collect();
    // The coordinate takes the place of the variable of that name.
    for quantity in QUANTITIES.iter().filter(|quantity| quantity.name != row) {
        let Quantity { name, unit, long_name, .. } = *quantity;
        let estimates: Vec<Estimate> = cells.iter().map(|cell| quantity.estimate(cell)).collect();
        if let Source::Share(_) = quantity.source {
            let values: Vec<f64> = estimates.iter().map(|share| share.value).collect();
            file.reals(name, &grid, &values, &described(unit, long_name))?;
        } else {
            with_error(&mut file, name, &grid, (unit, long_name), &estimates)?;
        }
    }
    let history: Vec<Estimate> = cells.iter().flat_map(|cell| cell.mu_history.clone()).collect();
    let meaning = ("1", "friction coefficient along the slide");
    with_error(&mut file, "mu_history", &[row, "slip_rate", "slip"], meaning, &history)?;

    flash_heating(&mut file, &prediction.flash_heating, row)?;
    compared(&mut file, &results.comparisons, row)?;
    cutoffs::write(&mut file, &results.cutoffs, &grid, cells.len())?;
    if let Some(propagated) = &results.propagated {
        parameters(&mut file, propagated, &grid)?;
    }
    file.finish()
}

/// Parameters of the flash-heating fit per pressure or separation.
fn flash_heating(
    file: &mut DatasetWriter,
    fits: &[Result<FlashHeating, NoFit>],
    row: &str,
) -> Result<(), DatasetError> {
    type Parameter = (&'static str, &'static str, &'static str, fn(&FlashHeating) -> Estimate);
    const PARAMETERS: [Parameter; 3] = [
        ("mu_0", "1", "friction coefficient at low slip rate, flash-heating fit", |fit| fit.mu_0),
        ("mu_w", "1", "friction coefficient of fully weakened contacts, flash-heating fit", |fit| fit.mu_w),
        ("V_w", "m s-1", "slip rate at which weakening starts, flash-heating fit", |fit| fit.v_w),
    ];
    type Goodness = (&'static str, &'static str, fn(&FlashHeating) -> f64);
    const GOODNESS: [Goodness; 2] = [
        ("flash_heating_rms", "root mean square misfit of the flash-heating fit", |fit| fit.misfit),
        (
            "flash_heating_r_squared",
            "share of the variance of mu over the slip rates that the flash-heating fit explains",
            |fit| fit.r_squared,
        ),
    ];
    let unknown = Estimate { value: f64::NAN, error: f64::NAN };
    for (name, unit, long_name, of) in PARAMETERS {
        let values: Vec<Estimate> = fits.iter().map(|fit| fit.as_ref().map_or(unknown, of)).collect();
        with_error(file, name, &[row], (unit, long_name), &values)?;
    }
    for (name, long_name, of) in GOODNESS {
        let values: Vec<f64> = fits.iter().map(|fit| fit.as_ref().map_or(f64::NAN, of)).collect();
        file.reals(name, &[row], &values, &described("1", long_name))?;
    }
    Ok(())
}

/// Results of the models of the literature, which do not depend on the slip rate.
fn compared(file: &mut DatasetWriter, comparisons: &[Comparison], row: &str) -> Result<(), DatasetError> {
    if comparisons.is_empty() {
        return Ok(());
    }
    let names: Vec<&str> = comparisons.iter().map(|comparison| comparison.model.as_str()).collect();
    file.dimension("model", names.len())?;
    let meaning = "closed form of the literature for one asperity, the same at any slip rate";
    file.texts("model", &["model"], &names, &[("long_name", meaning.into())])?;
    let limits: Vec<f64> = comparisons.iter().map(|comparison| comparison.limit).collect();
    let meaning = "interference over that of first yield at which the formulae of the model end";
    file.reals("interference_limit_model", &["model"], &limits, &described("1", meaning))?;
    for quantity in COMPARED.map(Quantity::named) {
        let cells = comparisons.iter().flat_map(|comparison| &comparison.friction);
        let values: Vec<f64> = cells.map(|cell| quantity.estimate(cell).value).collect();
        let long_name = format!("{}, with the asperities of the model", quantity.long_name);
        let name = format!("{}_model", quantity.name);
        file.reals(&name, &["model", row], &values, &described(quantity.unit, &long_name))?;
    }
    Ok(())
}

/// Standard deviations and changes of the results with the uncertain parameters.
fn parameters(
    file: &mut DatasetWriter,
    propagated: &Propagated,
    grid: &[&str; 2],
) -> Result<(), DatasetError> {
    let keys: Vec<&str> = propagated.parameters.iter().map(|varied| varied.key.as_str()).collect();
    file.dimension("parameter", keys.len())?;
    let meaning = "parameter of the surface file with a standard deviation";
    file.texts("parameter", &["parameter"], &keys, &[("long_name", meaning.into())])?;
    let cells = &propagated.contributions;
    for (output, Quantity { name, unit, .. }) in outputs().enumerate() {
        let stds: Vec<f64> = (0..cells.len()).map(|cell| propagated.std(cell, output)).collect();
        let long_name = format!("standard deviation of {name} from the uncertain parameters");
        file.reals(&format!("{name}_parameter_std"), grid, &stds, &described(unit, &long_name))?;
        let changes: Vec<f64> = cells.iter().flat_map(|cell| cell[output].iter().copied()).collect();
        let long_name = format!("change of {name} when the parameter grows by its standard deviation");
        let dimensions = [grid[0], grid[1], "parameter"];
        file.reals(&format!("{name}_parameter_change"), &dimensions, &changes, &described(unit, &long_name))?;
    }
    Ok(())
}
