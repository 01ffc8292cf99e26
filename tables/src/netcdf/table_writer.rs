//! Writes a slice.

use std::path::Path;

use super::table_format::{
    DIMENSIONS, FILM_OVER_TEMPERATURE, FRACTURE_ENERGY, FRACTURE_EXPONENT, OPTIONAL_ATTRIBUTES,
    OVER_TEMPERATURE, REAL_ATTRIBUTES, STATUS_MEANINGS, TEXT_ATTRIBUTES, history_name,
};
use super::{AttributeValue, DatasetError, DatasetWriter, described, schema};
use crate::quantity::{Descriptor, Estimate, Quantity, Stored};
use crate::table::fracture::FractureEnergy;
use crate::table::{Cell, Metadata, Slice, Status, Table};

impl Table {
    /// Writes the table; the file appears whole or not at all. The dimension `temperature` is there if there are
    /// several initial temperatures.
    pub fn write(&self, path: &Path) -> Result<(), DatasetError> {
        write(path, self.slices())
    }
}

impl Slice {
    /// Writes a table of this initial temperature only.
    pub fn write(&self, path: &Path) -> Result<(), DatasetError> {
        write(path, std::slice::from_ref(self))
    }
}

fn write(path: &Path, slices: &[Slice]) -> Result<(), DatasetError> {
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
    for (name, value) in REAL_ATTRIBUTES {
        file.attribute(name, *value(&mut metadata))?;
    }
    for (name, value) in OPTIONAL_ATTRIBUTES {
        if let Some(value) = *value(&mut metadata) {
            file.attribute(name, value)?;
        }
    }
    schema::stamp(&mut file, slices)?;
    let content = Content { slices, several };
    if several {
        content.write_temperatures(&mut file)?;
    }
    content.write_coordinates(&mut file)?;
    for quantity in Quantity::SCALARS {
        if slices.iter().any(|slice| slice.holds(quantity)) {
            content.write_quantity(&mut file, quantity.descriptor())?;
        }
    }
    if let Some(fracture_energy) = metadata.fracture_energy {
        content.write_energy_ratio(&mut file, fracture_energy)?;
    }
    content.write_state(&mut file)?;
    file.finish()
}

/// The slices to write; those at several temperatures have a leading dimension.
struct Content<'a> {
    slices: &'a [Slice],
    several: bool,
}

impl Content<'_> {
    fn write_temperatures(&self, file: &mut DatasetWriter) -> Result<(), DatasetError> {
        let of_members = |value: &dyn Fn(&Metadata) -> f64| -> Vec<f64> {
            self.slices.iter().map(|slice| value(slice.metadata())).collect()
        };
        file.coordinate(
            "temperature",
            &of_members(&|metadata| metadata.temperature),
            &[
                ("units", "K".into()),
                ("long_name", "initial temperature of body and flat".into()),
                ("units_metadata", "temperature: on_scale".into()),
            ],
        )?;
        for ((name, value), units, long_name) in OVER_TEMPERATURE {
            let values = of_members(&|metadata| *value(&mut metadata.clone()));
            file.reals(name, &["temperature"], &values, &described(units, long_name))?;
        }
        if self.slices[0].metadata().film_strength.is_some() {
            for ((name, value), units, long_name) in FILM_OVER_TEMPERATURE {
                let values = of_members(&|metadata| value(&mut metadata.clone()).unwrap_or(f64::NAN));
                file.reals(name, &["temperature"], &values, &described(units, long_name))?;
            }
        }
        if let Some(law) = self.slices[0].metadata().fracture_energy {
            let units = if law.radius_exponent == 0 { "J m-2" } else { "J m-3" };
            let long_name = "coefficient of the shear fracture energy";
            let coefficient =
                |metadata: &Metadata| metadata.fracture_energy.map_or(f64::NAN, |law| law.coefficient);
            let attributes = described(units, long_name);
            file.reals(FRACTURE_ENERGY, &["temperature"], &of_members(&coefficient), &attributes)?;
        }
        Ok(())
    }

    fn grid(&self) -> &'static [&'static str] {
        &DIMENSIONS[usize::from(!self.several)..3]
    }

    fn grid_and_slip(&self) -> &'static [&'static str] {
        &DIMENSIONS[usize::from(!self.several)..]
    }

    fn write_coordinates(&self, file: &mut DatasetWriter) -> Result<(), DatasetError> {
        let axes = self.slices[0].axes();
        let long_name = "interference over critical interference of first yield";
        file.coordinate("interference", &axes.interference, &described("1", long_name))?;
        file.coordinate(
            "slip_rate",
            &axes.slip_rate,
            &[
                ("units", "m s-1".into()),
                ("long_name", "slip rate; 0 is the isothermal limit".into()),
                ("radius_exponent", (-1).into()),
            ],
        )?;
        let long_name = "slip over contact radius at the end of the press";
        file.coordinate("slip", &axes.slip, &described("1", long_name))
    }

    fn write_quantity(&self, file: &mut DatasetWriter, descriptor: &Descriptor) -> Result<(), DatasetError> {
        let Descriptor { quantity, name, long_name, .. } = *descriptor;
        self.write_estimates(file, descriptor, |_, cell| cell[quantity])?;
        if descriptor.history == Stored::RunAndTable {
            let slips = self.slices[0].axes().slip.len();
            let history = |(_, cell): (&Slice, Option<&Cell>)| match cell {
                Some(cell) => cell.history(quantity).to_vec(),
                None => vec![f64::NAN; slips],
            };
            let values: Vec<f64> = self.each_cell().flat_map(history).collect();
            let along = format!("{long_name}, along the slide");
            let attributes = describe(descriptor, along, "temperature: on_scale");
            file.reals(&history_name(name), self.grid_and_slip(), &values, &attributes)?;
        }
        Ok(())
    }

    /// G/G_IIc, which follows from G and the contact radius and is not read back.
    fn write_energy_ratio(&self, file: &mut DatasetWriter, law: FractureEnergy) -> Result<(), DatasetError> {
        file.attribute(FRACTURE_ENERGY, law.coefficient)?;
        file.attribute(FRACTURE_EXPONENT, law.radius_exponent)?;
        let energy = *Quantity::EnergyRelease.descriptor();
        let ratio = Descriptor {
            name: "G_ratio",
            units: "1",
            long_name: "energy released over the shear fracture energy of the material, G/G_IIc",
            radius_exponent: energy.radius_exponent - law.radius_exponent,
            ..energy
        };
        let of = |slice: &Slice, cell: &Cell| slice.energy_ratio(cell).unwrap_or(Estimate::UNKNOWN);
        self.write_estimates(file, &ratio, of)
    }

    /// A variable and that of its errors.
    fn write_estimates(
        &self,
        file: &mut DatasetWriter,
        descriptor: &Descriptor,
        of: impl Fn(&Slice, &Cell) -> Estimate,
    ) -> Result<(), DatasetError> {
        let Descriptor { name, long_name, .. } = *descriptor;
        let error_name = format!("{name}_error");
        let mut attributes = describe(descriptor, long_name.into(), "temperature: on_scale");
        attributes.push(("ancillary_variables", format!("{error_name} status").into()));
        file.reals(name, self.grid(), &self.collect(|slice, cell| of(slice, cell).value), &attributes)?;
        let error_long_name = format!("half-width of the 95 % interval of the {long_name}");
        let attributes = describe(descriptor, error_long_name, "temperature: difference");
        file.reals(&error_name, self.grid(), &self.collect(|slice, cell| of(slice, cell).error), &attributes)
    }

    fn write_state(&self, file: &mut DatasetWriter) -> Result<(), DatasetError> {
        let steady = |cell: Option<&Cell>| i8::from(cell.is_some_and(|cell| cell.steady));
        let steady: Vec<i8> = self.each_cell().map(|(_, cell)| steady(cell)).collect();
        let long_name = |text: &str| ("long_name", AttributeValue::from(text));
        file.flags(
            "levelled",
            self.grid(),
            &steady,
            &["no", "yes"],
            &[long_name("whether friction has levelled off at the end of the slide")],
        )?;
        file.reals(
            "wall_time",
            self.grid(),
            &self.collect(|_, cell| cell.wall_time),
            &[long_name("time the run took"), ("units", "s".into())],
        )?;

        let (mut codes, mut reasons) = (Vec::new(), Vec::new());
        for (_, status) in self.each_status() {
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
            self.grid(),
            &codes,
            &STATUS_MEANINGS,
            &[long_name("state of the run"), ("standard_name", "status_flag".into())],
        )?;
        file.texts("failure_reason", self.grid(), &reasons, &[long_name("why the run failed")])?;
        let warnings: Vec<String> = self
            .each_cell()
            .map(|(_, cell)| cell.map_or(String::new(), |cell| cell.warnings.join("\n")))
            .collect();
        file.texts(
            "warnings",
            self.grid(),
            &warnings,
            &[long_name("what to know before trusting the numbers")],
        )
    }

    fn each_status(&self) -> impl Iterator<Item = (&Slice, &Status)> {
        self.slices.iter().flat_map(|slice| slice.grid().map(move |(i, j)| (slice, slice.status(i, j))))
    }

    fn each_cell(&self) -> impl Iterator<Item = (&Slice, Option<&Cell>)> {
        self.each_status().map(|(slice, status)| match status {
            Status::Done(cell) => (slice, Some(&**cell)),
            _ => (slice, None),
        })
    }

    fn collect(&self, value: impl Fn(&Slice, &Cell) -> f64) -> Vec<f64> {
        let of = |(slice, cell): (&Slice, Option<&Cell>)| cell.map_or(f64::NAN, |cell| value(slice, cell));
        self.each_cell().map(of).collect()
    }
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
