//! Tables as CF netCDF files.

use std::path::Path;

use crate::dataset::{AttributeValue, DatasetError, DatasetReader, DatasetWriter};
use crate::fracture::FractureEnergy;
use crate::quantity::{Descriptor, QUANTITIES, Quantity};
use crate::schema;
use crate::table::{Axes, Cell, Metadata, Status, Table};

const GRID: [&str; 2] = ["interference", "slip_rate"];
const GRID_AND_SLIP: [&str; 3] = ["interference", "slip_rate", "slip"];
/// G_IIc = coefficient·aⁿ in J m-2, contact radius a in m.
const FRACTURE_ENERGY: &str = "fracture_energy_coefficient";
const FRACTURE_EXPONENT: &str = "fracture_energy_radius_exponent";
const STATUS_MEANINGS: [&str; 3] = ["done", "not_run", "failed"];

/// A number of the metadata as a global attribute, in SI units.
type RealAttribute = (&'static str, fn(&Metadata) -> f64, fn(&mut Metadata) -> &mut f64);

macro_rules! real_attributes {
    ($($name:ident),*) => {
        [$((stringify!($name), |m| m.$name, |m| &mut m.$name)),*]
    };
}

const REAL_ATTRIBUTES: [RealAttribute; 8] = real_attributes![
    asperity_radius,
    critical_interference,
    contact_modulus,
    poisson_ratio,
    yield_strength,
    temperature,
    heat_partition,
    gap_conductance
];

/// A text of the metadata as a global attribute; the title is written by the dataset itself.
type TextAttribute = (&'static str, fn(&mut Metadata) -> &mut String);

const TEXT_ATTRIBUTES: [TextAttribute; 7] = [
    ("title", |m| &mut m.title),
    ("history", |m| &mut m.history),
    ("source", |m| &mut m.source),
    ("fingerprint", |m| &mut m.fingerprint),
    ("shard", |m| &mut m.shard),
    ("comment", |m| &mut m.comment),
    ("scene", |m| &mut m.scene),
];

/// A number of the metadata that need not be there.
type OptionalAttribute = (&'static str, fn(&mut Metadata) -> &mut Option<f64>);

const OPTIONAL_ATTRIBUTES: [OptionalAttribute; 2] = [
    ("strength_factor", |m| &mut m.strength_factor),
    ("interpolation_tolerance", |m| &mut m.interpolation_tolerance),
];

impl Table {
    /// Writes the table; the file appears whole or not at all.
    pub fn write(&self, path: &Path) -> Result<(), DatasetError> {
        let mut metadata = self.metadata().clone();
        let mut file = DatasetWriter::create(path, &metadata.title)?;
        for (name, text) in TEXT_ATTRIBUTES.iter().skip(1) {
            let text = text(&mut metadata);
            // CF wants no empty attributes.
            if !text.is_empty() {
                file.attribute(name, text.as_str())?;
            }
        }
        for (name, value, _) in REAL_ATTRIBUTES {
            file.attribute(name, value(&metadata))?;
        }
        for (name, value) in OPTIONAL_ATTRIBUTES {
            if let Some(value) = *value(&mut metadata) {
                file.attribute(name, value)?;
            }
        }
        schema::stamp(&mut file, self)?;
        self.write_coordinates(&mut file)?;
        for descriptor in &QUANTITIES {
            self.write_quantity(&mut file, descriptor)?;
        }
        if let Some(fracture_energy) = metadata.fracture_energy {
            self.write_energy_ratio(&mut file, fracture_energy)?;
        }
        self.write_state(&mut file)?;
        file.finish()
    }

    /// Reads a table.
    pub fn read(path: &Path) -> Result<Table, DatasetError> {
        let file = DatasetReader::open(path)?;
        schema::check_version(&file)?;
        let axes = Axes {
            interference: file.coordinate("interference")?,
            slip_rate: file.coordinate("slip_rate")?,
            slip: file.coordinate("slip")?,
        };
        let mut metadata = Metadata::default();
        for (name, _, place) in REAL_ATTRIBUTES {
            *place(&mut metadata) = file.attribute_real(name)?;
        }
        for (name, place) in TEXT_ATTRIBUTES {
            *place(&mut metadata) = file.optional_text(name)?.unwrap_or_default();
        }
        for (name, place) in OPTIONAL_ATTRIBUTES {
            *place(&mut metadata) = file.optional_real(name)?;
        }
        metadata.fracture_energy = match file.optional_real(FRACTURE_ENERGY)? {
            None => None,
            Some(coefficient) => {
                let radius_exponent = file.attribute_real(FRACTURE_EXPONENT)? as i32;
                Some(FractureEnergy { coefficient, radius_exponent })
            }
        };
        let mut table = Table::new(axes, metadata).map_err(|error| file.content(error.to_string()))?;
        table.read_cells(&file)?;
        schema::check_content(&file, &table)?;
        Ok(table)
    }

    fn write_coordinates(&self, file: &mut DatasetWriter) -> Result<(), DatasetError> {
        let axes = self.axes();
        file.coordinate(
            "interference",
            &axes.interference,
            &[
                ("units", "1".into()),
                ("long_name", "interference over critical interference of first yield".into()),
            ],
        )?;
        file.coordinate(
            "slip_rate",
            &axes.slip_rate,
            &[
                ("units", "m s-1".into()),
                ("long_name", "slip rate; 0 is the isothermal limit".into()),
                ("radius_exponent", (-1).into()),
            ],
        )?;
        file.coordinate(
            "slip",
            &axes.slip,
            &[
                ("units", "1".into()),
                ("long_name", "slip over contact radius at the end of the press".into()),
            ],
        )
    }

    fn write_quantity(&self, file: &mut DatasetWriter, descriptor: &Descriptor) -> Result<(), DatasetError> {
        let quantity = descriptor.quantity;
        let name = descriptor.name;
        let error_name = format!("{name}_error");
        let values = self.collect(|cell| cell[quantity].value);
        let errors = self.collect(|cell| cell[quantity].error);

        let long_name = descriptor.long_name.to_string();
        let mut attributes = describe(descriptor, long_name.clone(), "temperature: on_scale");
        let ancillary = format!("{error_name} status");
        attributes.push(("ancillary_variables", ancillary.into()));
        if let Some(standard_name) = descriptor.standard_name {
            attributes.push(("standard_name", standard_name.into()));
        }
        file.reals(name, &GRID, &values, &attributes)?;

        let error_long_name = format!("absolute error of {long_name}");
        let attributes = describe(descriptor, error_long_name, "temperature: difference");
        file.reals(&error_name, &GRID, &errors, &attributes)?;

        if descriptor.has_history {
            let slips = self.axes().slip.len();
            let history = |cell: Option<&Cell>| match cell {
                Some(cell) => cell.history(quantity).to_vec(),
                None => vec![f64::NAN; slips],
            };
            let values: Vec<f64> = self.each_cell().flat_map(history).collect();
            let along = format!("{long_name}, along the slide");
            let attributes = describe(descriptor, along, "temperature: on_scale");
            file.reals(&history_name(name), &GRID_AND_SLIP, &values, &attributes)?;
        }
        Ok(())
    }

    /// G/G_IIc, which follows from G and the contact radius and is not read back.
    fn write_energy_ratio(&self, file: &mut DatasetWriter, law: FractureEnergy) -> Result<(), DatasetError> {
        file.attribute(FRACTURE_ENERGY, law.coefficient)?;
        file.attribute(FRACTURE_EXPONENT, law.radius_exponent)?;
        let ratio = |cell: &Cell| law.ratio(cell[Quantity::EnergyRelease], cell[Quantity::ContactRadius]);
        let exponent = Quantity::EnergyRelease.descriptor().radius_exponent - law.radius_exponent;
        let attributes = |long_name: &str| {
            vec![
                ("units", AttributeValue::from("1")),
                ("long_name", long_name.into()),
                ("radius_exponent", exponent.into()),
            ]
        };
        let long_name = "energy released over the shear fracture energy of the material, G/G_IIc";
        let mut described = attributes(long_name);
        described.push(("ancillary_variables", "G_ratio_error status".into()));
        file.reals("G_ratio", &GRID, &self.collect(|cell| ratio(cell).value), &described)?;
        let described = attributes(&format!("absolute error of {long_name}"));
        file.reals("G_ratio_error", &GRID, &self.collect(|cell| ratio(cell).error), &described)
    }

    fn write_state(&self, file: &mut DatasetWriter) -> Result<(), DatasetError> {
        let levelled = |cell: Option<&Cell>| i8::from(cell.is_some_and(|cell| cell.levelled));
        let levelled: Vec<i8> = self.each_cell().map(levelled).collect();
        let long_name = |text: &str| ("long_name", AttributeValue::from(text));
        file.flags(
            "levelled",
            &GRID,
            &levelled,
            &["no", "yes"],
            &[long_name("whether friction has levelled off at the end of the slide")],
        )?;
        file.reals(
            "wall_time",
            &GRID,
            &self.collect(|cell| cell.wall_time),
            &[long_name("time the run took"), ("units", "s".into())],
        )?;

        let (mut codes, mut reasons) = (Vec::new(), Vec::new());
        for status in self.each_status() {
            let (code, reason) = match status {
                Status::Done(_) => (0, ""),
                Status::NotRun => (1, ""),
                Status::Failed(reason) => (2, reason.as_str()),
            };
            codes.push(code);
            reasons.push(reason);
        }
        file.flags(
            "status",
            &GRID,
            &codes,
            &STATUS_MEANINGS,
            &[long_name("state of the run"), ("standard_name", "status_flag".into())],
        )?;
        file.texts("failure_reason", &GRID, &reasons, &[long_name("why the run failed")])?;
        let warnings: Vec<String> = self
            .each_cell()
            .map(|cell| cell.map_or(String::new(), |cell| cell.warnings.join("\n")))
            .collect();
        let warnings: Vec<&str> = warnings.iter().map(String::as_str).collect();
        file.texts("warnings", &GRID, &warnings, &[long_name("what to know before trusting the numbers")])
    }

    fn read_cells(&mut self, file: &DatasetReader) -> Result<(), DatasetError> {
        let (interferences, rates) = self.shape();
        let slips = self.axes().slip.len();
        let grid = [interferences, rates];
        let mut cells = vec![Cell::new(); interferences * rates];
        for descriptor in &QUANTITIES {
            let name = descriptor.name;
            let values = file.reals(name, &grid)?;
            let errors = file.reals(&format!("{name}_error"), &grid)?;
            for (cell, (value, error)) in cells.iter_mut().zip(values.into_iter().zip(errors)) {
                cell[descriptor.quantity] = crate::law::Estimate { value, error };
            }
        }
        for quantity in Quantity::HISTORIES {
            let name = history_name(quantity.descriptor().name);
            let values = file.reals(&name, &[interferences, rates, slips])?;
            for (cell, history) in cells.iter_mut().zip(values.chunks(slips)) {
                *cell = std::mem::take(cell).with_history(quantity, history.to_vec());
            }
        }
        let levelled = file.flags("levelled", &grid)?;
        let wall_time = file.reals("wall_time", &grid)?;
        let status = file.flags("status", &grid)?;
        for (position, mut cell) in cells.into_iter().enumerate() {
            let (i, j) = (position / rates, position % rates);
            match status[position] {
                0 => {
                    cell.levelled = levelled[position] != 0;
                    cell.wall_time = wall_time[position];
                    cell.warnings = file.text("warnings", &[i, j])?.lines().map(str::to_string).collect();
                    self.set_cell(i, j, cell).map_err(|error| file.content(error.to_string()))?;
                }
                1 => {}
                2 => self.mark_failed(i, j, file.text("failure_reason", &[i, j])?),
                other => {
                    let what = format!("variable \"status\" has the unknown value {other}");
                    return Err(file.content(what));
                }
            }
        }
        Ok(())
    }

    fn each_status(&self) -> impl Iterator<Item = &Status> {
        self.grid().map(|(i, j)| self.status(i, j))
    }

    fn each_cell(&self) -> impl Iterator<Item = Option<&Cell>> {
        self.each_status().map(|status| match status {
            Status::Done(cell) => Some(&**cell),
            _ => None,
        })
    }

    fn collect(&self, value: impl Fn(&Cell) -> f64) -> Vec<f64> {
        self.each_cell().map(|cell| cell.map_or(f64::NAN, &value)).collect()
    }
}

fn history_name(name: &str) -> String {
    format!("{name}_history")
}

fn describe(
    descriptor: &Descriptor,
    long_name: String,
    temperature_kind: &str,
) -> Vec<(&'static str, AttributeValue)> {
    let mut attributes = vec![
        ("units", descriptor.units.into()),
        ("long_name", long_name.into()),
        ("radius_exponent", descriptor.radius_exponent.into()),
    ];
    if descriptor.quantity.is_temperature() {
        attributes.push(("units_metadata", temperature_kind.into()));
    }
    attributes
}

#[cfg(test)]
mod tests;
