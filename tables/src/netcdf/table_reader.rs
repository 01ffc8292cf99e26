//! Reads a table.

use std::path::Path;

use super::input::read_text;
use super::table_format::{
    FRACTURE_ENERGY, FRACTURE_EXPONENT, MATERIAL_TEMPERATURE, TEXT_ATTRIBUTES, history_name, material_name,
};
use super::{DatasetError, DatasetReader, schema};
use crate::quantity::Quantity;
use crate::table::fracture::FractureEnergy;
use crate::table::{ATTRIBUTES, Attribute, Axes, Cell, Constants, Metadata, Slice, Table, TableError};

impl Table {
    /// Reads a table.
    pub fn read(path: &Path) -> Result<Table, DatasetError> {
        let file =
            DatasetReader::open(path).map_err(|error| toml_in_place_of_table(path).unwrap_or(error))?;
        let several = schema::has_temperatures(&file)?;
        let axes = Axes {
            interference: file.coordinate("interference")?,
            slip_rate: file.coordinate("slip_rate")?,
            slip: file.coordinate("slip")?,
        };
        let mut metadata = Metadata::default();
        for attribute in &ATTRIBUTES {
            let value = match attribute.required {
                true => Some(file.attribute_real(attribute.name)?),
                false => file.optional_real(attribute.name)?,
            };
            value.into_iter().for_each(|value| (attribute.set)(&mut metadata, value));
        }
        for (name, place) in TEXT_ATTRIBUTES {
            *place(&mut metadata) = file.optional_text(name)?.unwrap_or_default();
        }
        metadata.fracture_energy = match file.optional_real(FRACTURE_ENERGY)? {
            None => None,
            Some(coefficient) => {
                let radius_exponent = file.attribute_real(FRACTURE_EXPONENT)? as i32;
                Some(FractureEnergy { coefficient, radius_exponent })
            }
        };
        let metadata = if several { read_temperatures(&file, &metadata)? } else { vec![metadata] };
        let wrong = |error: TableError| file.content(error.to_string());
        let mut shape = vec![metadata.len(), axes.interference.len(), axes.slip_rate.len()];
        if !several {
            shape.remove(0);
        }
        // Checks also that the file can hold this number.
        let status = file.flags("status", &shape)?;
        let slices = metadata.into_iter().map(|metadata| Slice::new(axes.clone(), metadata));
        let mut slices = slices.collect::<Result<Vec<Slice>, TableError>>().map_err(wrong)?;
        if slices.is_empty() {
            return Err(wrong(TableError::AxisEmpty("temperature")));
        }
        read_cells(&file, &mut slices, &shape, &status)?;
        let constants = read_constants(&file, slices[0].metadata())?;
        let table = Table::new(slices).map_err(wrong)?;
        let table = constants.into_iter().try_fold(table, Table::with_constants).map_err(wrong)?;
        schema::check_content(&file, &table)?;
        Ok(table)
    }
}

/// The error for a file that is the request of a table, or another input, in place of a table; none for other files.
fn toml_in_place_of_table(path: &Path) -> Option<DatasetError> {
    let sections: toml::Table = read_text(path).ok()?.parse().ok()?;
    if sections.is_empty() {
        return None;
    }
    let reason = match sections.contains_key("table") {
        true => "is a request; the table of it is made by `asperity tabulate`",
        false => {
            "is TOML, not a table; a table is made by `asperity tabulate` of a request with a section [table]"
        }
    };
    Some(DatasetError::Open { path: path.display().to_string(), reason: reason.into() })
}

/// The metadata of each slice.
fn read_temperatures(file: &DatasetReader, common: &Metadata) -> Result<Vec<Metadata>, DatasetError> {
    let temperatures = file.coordinate("temperature")?;
    let mut members = vec![common.clone(); temperatures.len()];
    let shape = [temperatures.len()];
    // A file may lack the optional ones as variables.
    let stated = |attribute: &&Attribute| attribute.required || file.has(attribute.name);
    for attribute in Attribute::changing(common).filter(stated) {
        let values = file.reals(attribute.name, &shape)?;
        members.iter_mut().zip(values).for_each(|(member, value)| (attribute.set)(member, value));
    }
    members.iter_mut().zip(temperatures).for_each(|(member, kelvin)| member.temperature = kelvin);
    if common.fracture_energy.is_some() {
        let coefficients = file.reals(FRACTURE_ENERGY, &shape)?;
        for (member, coefficient) in members.iter_mut().zip(coefficients) {
            member.fracture_energy = member.fracture_energy.map(|law| FractureEnergy { coefficient, ..law });
        }
    }
    Ok(members)
}

/// Constants of the material between the temperatures of a table, if the file has them.
fn read_constants(file: &DatasetReader, common: &Metadata) -> Result<Option<Constants>, DatasetError> {
    if !file.has(MATERIAL_TEMPERATURE) {
        return Ok(None);
    }
    let temperature = file.coordinate(MATERIAL_TEMPERATURE)?;
    let shape = [temperature.len()];
    let values = Attribute::changing(common)
        .map(|attribute| Ok((attribute.name, file.reals(&material_name(attribute.name), &shape)?)))
        .collect::<Result<_, DatasetError>>()?;
    Ok(Some(Constants { temperature, values }))
}

/// Fills slices from variables of a shape, of which the last two are those of a table.
fn read_cells(
    file: &DatasetReader,
    slices: &mut [Slice],
    grid: &[usize],
    status: &[i8],
) -> Result<(), DatasetError> {
    let (rows, rates) = slices[0].shape();
    let slips = slices[0].axes().slip.len();
    let mut cells = vec![Cell::new(); status.len()];
    for quantity in Quantity::SCALARS {
        let name = quantity.descriptor().name;
        if quantity.descriptor().optional && !file.has(name) {
            continue;
        }
        for (cell, estimate) in cells.iter_mut().zip(file.estimates(name, grid)?) {
            cell[quantity] = estimate;
        }
    }
    for quantity in Quantity::TABLE_HISTORIES {
        let name = history_name(quantity.descriptor().name);
        let values = file.reals(&name, &[grid, &[slips]].concat())?;
        for (cell, history) in cells.iter_mut().zip(values.chunks(slips)) {
            *cell = std::mem::take(cell).with_history(quantity, history.to_vec());
        }
    }
    let steady = file.flags("levelled", grid)?;
    let wall_time = file.reals("wall_time", grid)?;
    for (position, mut cell) in cells.into_iter().enumerate() {
        let (member, i, j) = (position / (rows * rates), position / rates % rows, position % rates);
        let all = [member, i, j];
        let index = &all[all.len() - grid.len()..];
        let slice = &mut slices[member];
        match status[position] {
            0 => {
                cell.steady = steady[position] != 0;
                cell.wall_time = wall_time[position];
                cell.warnings = file.text("warnings", index)?.lines().map(str::to_string).collect();
                slice.set_cell(i, j, cell).map_err(|error| file.content(error.to_string()))?;
            }
            1 => {}
            2 => slice.mark_failed(i, j, file.text("failure_reason", index)?),
            other => {
                let what = format!("variable \"status\" has the unknown value {other}");
                return Err(file.content(what));
            }
        }
    }
    Ok(())
}
