//! Writes a table.

use std::path::Path;

use super::table_format::{
    DIMENSIONS, FRACTURE_ENERGY, FRACTURE_EXPONENT, MATERIAL_TEMPERATURE, STATUS_MEANINGS, TEXT_ATTRIBUTES,
    history_name, material_name,
};
use super::{AttributeValue, DatasetError, DatasetWriter, described, schema};
use crate::quantity::{Descriptor, Estimate, Quantity, Stored};
use crate::table::fracture::FractureEnergy;
use crate::table::{ATTRIBUTES, Attribute, Cell, Constants, Metadata, Slice, Table};

impl Table {
    /// Writes the table; the file appears whole or not at all. The dimension `temperature` is there if there are
    /// several initial temperatures.
    pub fn write(&self, path: &Path) -> Result<(), DatasetError> {
        write(path, self)
    }
}

impl Slice {
    /// Writes a table of this initial temperature only.
    pub fn write(&self, path: &Path) -> Result<(), DatasetError> {
        write(path, &Table::from(self.clone()))
    }
}

fn write(path: &Path, table: &Table) -> Result<(), DatasetError> {
    let slices = table.slices();
    let several = slices.len() > 1;
    let mut metadata = slices[0].metadata().clone();
    let mut file = DatasetWriter::create(path, &metadata.title)?;
    for (name, text) in TEXT_ATTRIBUTES.iter().skip(1) {
        let text = text(&mut metadata);
        // CF does not allow empty attributes.
        if !text.is_empty() {
            file.attribute(name, text.as_str())?;
        }
    }
    for required in [true, false] {
        for attribute in ATTRIBUTES.iter().filter(|attribute| attribute.required == required) {
            if let Some(value) = (attribute.get)(&metadata) {
                file.attribute(attribute.name, value)?;
            }
        }
    }
    schema::stamp(&mut file, table)?;
    let mut writer = TableWriter { file, slices, dimensions: &DIMENSIONS[usize::from(!several)..] };
    if several {
        writer.temperatures()?;
        table.constants.iter().try_for_each(|constants| writer.constants(constants))?;
    }
    writer.coordinates()?;
    for quantity in Quantity::SCALARS {
        if slices.iter().any(|slice| slice.holds(quantity)) {
            writer.quantity(quantity.descriptor())?;
        }
    }
    if let Some(fracture_energy) = metadata.fracture_energy {
        writer.energy_ratio(fracture_energy)?;
    }
    writer.state()?;
    writer.file.finish()
}

/// A file with its attributes, to which the slices are written.
struct TableWriter<'a> {
    file: DatasetWriter,
    slices: &'a [Slice],
    /// Dimensions of the histories; scalars of cells lack the last. Several slices have a leading one, the temperature.
    dimensions: &'static [&'static str],
}

impl TableWriter<'_> {
    fn temperatures(&mut self) -> Result<(), DatasetError> {
        let slices = self.slices;
        let of_members = |value: &dyn Fn(&Metadata) -> f64| -> Vec<f64> {
            slices.iter().map(|slice| value(slice.metadata())).collect()
        };
        let temperatures = of_members(&|metadata| metadata.temperature);
        self.temperature_axis("temperature", &temperatures, "initial temperature of body and flat")?;
        let mut variable = |name: &str, units: &str, long_name: &str, value: &dyn Fn(&Metadata) -> f64| {
            self.file.reals(name, &["temperature"], &of_members(value), &described(units, long_name))
        };
        for attribute in Attribute::changing(slices[0].metadata()) {
            let Some((units, long_name)) = attribute.over_temperature else { continue };
            let value = |metadata: &Metadata| (attribute.get)(metadata).unwrap_or(f64::NAN);
            variable(attribute.name, units, long_name, &value)?;
        }
        if let Some(law) = slices[0].metadata().fracture_energy {
            let units = if law.radius_exponent == 0 { "J m-2" } else { "J m-3" };
            let long_name = "coefficient of the shear fracture energy";
            let value =
                |metadata: &Metadata| metadata.fracture_energy.map_or(f64::NAN, |law| law.coefficient);
            variable(FRACTURE_ENERGY, units, long_name, &value)?;
        }
        Ok(())
    }

    /// Constants of the material between the temperatures of the table.
    fn constants(&mut self, constants: &Constants) -> Result<(), DatasetError> {
        let long_name = "initial temperature of the constants of the material";
        self.temperature_axis(MATERIAL_TEMPERATURE, &constants.temperature, long_name)?;
        for attribute in Attribute::changing(self.slices[0].metadata()) {
            let Some((units, long_name)) = attribute.over_temperature else { continue };
            let (name, values) = (material_name(attribute.name), &constants.values[attribute.name]);
            self.file.reals(&name, &[MATERIAL_TEMPERATURE], values, &described(units, long_name))?;
        }
        Ok(())
    }

    fn temperature_axis(&mut self, name: &str, kelvin: &[f64], long_name: &str) -> Result<(), DatasetError> {
        let mut attributes = described("K", long_name);
        attributes.push(("units_metadata", "temperature: on_scale".into()));
        self.file.coordinate(name, kelvin, &attributes)
    }

    fn grid(&self) -> &'static [&'static str] {
        &self.dimensions[..self.dimensions.len() - 1]
    }

    fn coordinates(&mut self) -> Result<(), DatasetError> {
        let axes = self.slices[0].axes();
        let long_name = "interference over critical interference of first yield";
        self.file.coordinate("interference", &axes.interference, &described("1", long_name))?;
        let mut attributes = described("m s-1", "slip rate; 0 is the isothermal limit");
        attributes.push(("radius_exponent", (-1).into()));
        self.file.coordinate("slip_rate", &axes.slip_rate, &attributes)?;
        let long_name = "slip over contact radius at the end of the press";
        self.file.coordinate("slip", &axes.slip, &described("1", long_name))
    }

    fn quantity(&mut self, descriptor: &Descriptor) -> Result<(), DatasetError> {
        let Descriptor { quantity, name, long_name, .. } = *descriptor;
        self.estimates(descriptor, |_, cell| cell[quantity])?;
        if descriptor.history == Stored::RunAndTable {
            let slips = self.slices[0].axes().slip.len();
            let values = self.over_cells(|_, cell| match cell {
                Some(cell) => cell.history(quantity).to_vec(),
                None => vec![f64::NAN; slips],
            });
            let along = format!("{long_name}, along the slide");
            let attributes = describe(descriptor, &along, "temperature: on_scale");
            self.file.reals(&history_name(name), self.dimensions, &values.concat(), &attributes)?;
        }
        Ok(())
    }

    /// G/G_IIc, which follows from G and the contact radius and is not read back.
    fn energy_ratio(&mut self, law: FractureEnergy) -> Result<(), DatasetError> {
        self.file.attribute(FRACTURE_ENERGY, law.coefficient)?;
        self.file.attribute(FRACTURE_EXPONENT, law.radius_exponent)?;
        let energy = *Quantity::EnergyRelease.descriptor();
        let ratio = Descriptor {
            name: "G_ratio",
            units: "1",
            long_name: "energy released over the shear fracture energy of the material, G/G_IIc",
            radius_exponent: energy.radius_exponent - law.radius_exponent,
            ..energy
        };
        self.estimates(&ratio, |slice, cell| slice.energy_ratio(cell).unwrap_or(Estimate::UNKNOWN))
    }

    /// A variable and that of its errors.
    fn estimates(
        &mut self,
        descriptor: &Descriptor,
        of: impl Fn(&Slice, &Cell) -> Estimate,
    ) -> Result<(), DatasetError> {
        let Descriptor { name, long_name, .. } = *descriptor;
        let error_name = format!("{name}_error");
        let known = self.over_cells(|slice, cell| cell.map_or(Estimate::UNKNOWN, |cell| of(slice, cell)));
        let (values, errors): (Vec<f64>, Vec<f64>) =
            known.into_iter().map(|Estimate { value, error }| (value, error)).unzip();
        let mut attributes = describe(descriptor, long_name, "temperature: on_scale");
        attributes.push(("ancillary_variables", format!("{error_name} status").into()));
        self.file.reals(name, self.grid(), &values, &attributes)?;
        let error_long_name = format!("half-width of the 95 % interval of the {long_name}");
        let attributes = describe(descriptor, &error_long_name, "temperature: difference");
        self.file.reals(&error_name, self.grid(), &errors, &attributes)
    }

    fn state(&mut self) -> Result<(), DatasetError> {
        let grid = self.grid();
        let long_name = |text: &str| ("long_name", AttributeValue::from(text));
        let steady = self.over_cells(|_, cell| i8::from(cell.is_some_and(|cell| cell.steady)));
        let levelled = long_name("whether friction has levelled off at the end of the slide");
        self.file.flags("levelled", grid, &steady, &["no", "yes"], &[levelled])?;
        let times = self.over_cells(|_, cell| cell.map_or(f64::NAN, |cell| cell.wall_time));
        let time_taken = [long_name("time the run took"), ("units", "s".into())];
        self.file.reals("wall_time", grid, &times, &time_taken)?;

        let (codes, reasons): (Vec<i8>, Vec<&str>) = (self.slices.iter())
            .flat_map(|slice| slice.grid().map(move |(i, j)| slice.status(i, j)))
            .map(|status| (status.code(), status.reason().unwrap_or_default()))
            .unzip();
        let of_run = [long_name("state of the run"), ("standard_name", "status_flag".into())];
        self.file.flags("status", grid, &codes, &STATUS_MEANINGS, &of_run)?;
        self.file.texts("failure_reason", grid, &reasons, &[long_name("why the run failed")])?;
        let warnings = self.over_cells(|_, cell| cell.map_or(String::new(), |cell| cell.warnings.join("\n")));
        let meaning = long_name("what to know before trusting the numbers");
        self.file.texts("warnings", grid, &warnings, &[meaning])
    }

    /// A value of every point of every slice, from the slice and the cell that is done there.
    fn over_cells<T>(&self, of: impl Fn(&Slice, Option<&Cell>) -> T) -> Vec<T> {
        let of_slice =
            |slice: &Slice| -> Vec<T> { slice.grid().map(|(i, j)| of(slice, slice.cell(i, j))).collect() };
        self.slices.iter().flat_map(of_slice).collect()
    }
}

fn describe(
    descriptor: &Descriptor,
    long_name: &str,
    temperature_kind: &str,
) -> Vec<(&'static str, AttributeValue)> {
    let mut attributes = described(descriptor.units, long_name);
    attributes.push(("radius_exponent", descriptor.radius_exponent.into()));
    if descriptor.quantity.is_temperature() {
        attributes.push(("units_metadata", temperature_kind.into()));
    }
    attributes
}
