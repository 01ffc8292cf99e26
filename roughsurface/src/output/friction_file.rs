//! Predictions as CF netCDF files, `friction.nc`.

use crate::friction::Friction;
use crate::friction::comparison::Comparison;
use crate::friction::quantities::{QUANTITIES, Source, SurfaceQuantity};
use crate::friction::regime::regime;
use crate::output::cutoffs;
use crate::output::origin::{Origin, grid_coordinates, with_error};
use crate::output::rate_laws;
use crate::output::rate_step;
use crate::sampling::case::Results;
use crate::sampling::uncertainty::{Propagated, outputs};
use std::path::Path;
use tables::law::Estimate;
use tables::netcdf::{DatasetError, DatasetWriter, described};

const COMMENT: &str = "Greenwood-Williamson integration of one-asperity friction over summit heights. \
NAME_error is an estimate of the absolute error of NAME: error of the table with one sign in all \
asperities, quadrature, slip grid and pressure. Radii of the summits do not depend on their heights; smooth flat. \
Under held load the flat sinks as asperities lose load; each asperity then follows the slide tabulated \
at its present interference.";

/// Attribute with the initial temperature, K, where there is one.
pub(super) const INITIAL_TEMPERATURE: &str = "initial_temperature";

/// Results that a comparison with a model of the literature has.
pub(super) const COMPARED: [&str; 4] = ["mu", "mu_static", "real_area_fraction", "outside_table_fraction"];

/// Title of `friction.nc`.
pub const TITLE: &str = "Friction of a rough surface";

/// Writes `friction.nc`: under a temporary name first, so the file appears whole or not at all.
pub fn write(path: &Path, results: &Results, origin: &Origin) -> Result<(), DatasetError> {
    let prediction = &results.prediction;
    let mut file = DatasetWriter::create(path, TITLE)?;
    origin.write(&mut file, &prediction.law, &prediction.query, &prediction.warnings)?;
    file.attribute("comment", COMMENT)?;
    file.attribute("plasticity_index", prediction.plasticity_index)?;
    file.attribute("regime", regime(prediction.plasticity_index))?;
    if let Some(kelvin) = results.temperature {
        file.attribute(INITIAL_TEMPERATURE, kelvin)?;
    }

    let row = grid_coordinates(&mut file, &prediction.query)?;
    file.coordinate("slip", &prediction.slip, &described("m", "slip of the flat along the surface"))?;
    let grid = [row, "slip_rate"];
    let cells: Vec<&Friction> = prediction.friction.iter().flatten().collect();
    // The coordinate takes the place of the variable of that name.
    for quantity in QUANTITIES.iter().filter(|quantity| quantity.name != row) {
        let SurfaceQuantity { name, unit, long_name, .. } = *quantity;
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

    rate_laws::write(&mut file, &prediction.rate_laws, row)?;
    rate_step::write(&mut file, prediction.rate_step.as_ref(), row)?;
    compared(&mut file, &results.comparisons, row)?;
    cutoffs::write(&mut file, &results.cutoffs, &grid, prediction.query.slip_rates.len())?;
    if let Some(propagated) = &results.propagated {
        parameters(&mut file, propagated, &grid)?;
    }
    file.finish()
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
    for quantity in COMPARED.map(SurfaceQuantity::named) {
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
    for (output, SurfaceQuantity { name, unit, .. }) in outputs().enumerate() {
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
