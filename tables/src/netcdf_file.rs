//! Tables as CF netCDF files.

use std::path::Path;

use crate::dataset::{AttributeValue, DatasetError, DatasetReader, DatasetWriter};
use crate::fracture::FractureEnergy;
use crate::quantity::{Descriptor, QUANTITIES, Quantity};
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

const TEXT_ATTRIBUTES: [TextAttribute; 5] = [
    ("title", |m| &mut m.title),
    ("history", |m| &mut m.history),
    ("source", |m| &mut m.source),
    ("comment", |m| &mut m.comment),
    ("scene", |m| &mut m.scene),
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
        if let Some(strength_factor) = metadata.strength_factor {
            file.attribute("strength_factor", strength_factor)?;
        }
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
        metadata.strength_factor = file.optional_real("strength_factor")?;
        metadata.fracture_energy = match file.optional_real(FRACTURE_ENERGY)? {
            None => None,
            Some(coefficient) => {
                let radius_exponent = file.attribute_real(FRACTURE_EXPONENT)? as i32;
                Some(FractureEnergy { coefficient, radius_exponent })
            }
        };
        let mut table = Table::new(axes, metadata).map_err(|error| file.content(error.to_string()))?;
        table.read_cells(&file)?;
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
        file.texts("failure_reason", &GRID, &reasons, &[long_name("why the run failed")])
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
mod tests {
    use super::*;

    fn table() -> Table {
        let axes =
            Axes { interference: vec![0.5, 5.0], slip_rate: vec![0.0, 0.1, 1.0], slip: vec![0.0, 0.5, 2.0] };
        let metadata = Metadata {
            title: "Friction of one asperity".to_string(),
            history: "2026-01-01 asperity tabulate".to_string(),
            source: "asperity 0.1.0".to_string(),
            scene: "[asperity]\nradius = 1e-3\n".to_string(),
            asperity_radius: 1e-3,
            strength_factor: Some(0.9),
            ..Metadata::default()
        };
        let mut table = Table::new(axes, metadata).unwrap();
        for (i, j) in [(0, 0), (0, 1), (1, 2)] {
            let mut cell = Cell::new();
            for (n, quantity) in Quantity::ALL.into_iter().enumerate() {
                cell = cell.with(quantity, (1 + n + i + 2 * j) as f64 / 3.0, 0.01);
            }
            for quantity in [Quantity::Mu, Quantity::Friction] {
                cell = cell.with_history(quantity, vec![0.0, 1.0 / 3.0, 0.1]);
            }
            cell.levelled = i == 1;
            cell.wall_time = 12.5;
            table.set_cell(i, j, cell).unwrap();
        }
        table.mark_failed(1, 0, "Newton did not converge at s = 1e-7 m");
        table
    }

    fn place(name: &str) -> std::path::PathBuf {
        std::env::temp_dir().join(format!("tables-{}-{name}.nc", std::process::id()))
    }

    #[test]
    fn what_is_written_is_read_back() {
        let path = place("round-trip");
        table().write(&path).unwrap();
        let read = Table::read(&path).unwrap();
        std::fs::remove_file(&path).unwrap();
        assert_eq!(read, table());
    }

    #[test]
    fn energy_is_related_to_the_fracture_energy_where_that_is_known() {
        let path = place("fracture");
        for radius_exponent in [0, 1] {
            let mut with = table();
            let law = FractureEnergy { coefficient: 0.25, radius_exponent };
            with.set_metadata(Metadata { fracture_energy: Some(law), ..with.metadata().clone() });
            with.write(&path).unwrap();
            assert_eq!(Table::read(&path).unwrap(), with);
            let file = DatasetReader::open(&path).unwrap();
            let values = file.reals("G_ratio", &[2, 3]).unwrap();
            let cell = with.cell(1, 2).unwrap();
            let (energy, radius) = (cell[Quantity::EnergyRelease].value, cell[Quantity::ContactRadius].value);
            let exact = energy / (0.25 * radius.powi(radius_exponent));
            assert!((values[5] / exact - 1.0).abs() < 1e-14 && values[3].is_nan());
            assert!(file.reals("G_ratio_error", &[2, 3]).unwrap()[5] > 0.0);
            std::fs::remove_file(&path).unwrap();
        }
    }

    #[test]
    fn equal_content_gives_equal_bytes() {
        let (first, second) = (place("bytes-1"), place("bytes-2"));
        table().write(&first).unwrap();
        table().write(&second).unwrap();
        let bytes = std::fs::read(&first).unwrap();
        assert_eq!(bytes, std::fs::read(&second).unwrap());
        // Overwriting leaves neither an old nor a temporary file.
        table().write(&first).unwrap();
        assert_eq!(bytes, std::fs::read(&first).unwrap());
        let leftover = format!(".{}", first.file_name().unwrap().to_string_lossy());
        for entry in std::fs::read_dir(std::env::temp_dir()).unwrap() {
            let name = entry.unwrap().file_name().to_string_lossy().to_string();
            assert!(!name.starts_with(&leftover), "{name}");
        }
        std::fs::remove_file(&first).unwrap();
        std::fs::remove_file(&second).unwrap();
    }

    #[test]
    fn foreign_files_are_named() {
        let message = |path: &Path| Table::read(path).unwrap_err().to_string();
        let missing = message(Path::new("nowhere/table.nc"));
        assert!(missing.starts_with("cannot read nowhere/table.nc: No such file"));

        let path = place("foreign");
        std::fs::write(&path, "not netCDF").unwrap();
        assert!(message(&path).starts_with(&format!("cannot read {}", path.display())));

        let mut other = DatasetWriter::create(&path, "a run").unwrap();
        other.coordinate("step", &[0.0, 1.0], &[]).unwrap();
        other.finish().unwrap();
        let foreign = message(&path);
        assert!(foreign.contains("variable \"interference\" is missing"));
        assert!(!foreign.contains('\n'));
        std::fs::remove_file(&path).unwrap();
    }

    #[test]
    fn short_records_are_refused() {
        let path = place("short");
        let mut file = DatasetWriter::create(&path, "short").unwrap();
        file.dimension("step", 3).unwrap();
        let error = file.reals("slip", &["step"], &[0.0, 1.0], &[]).unwrap_err();
        assert!(error.to_string().contains("2 values instead of 3"));
        drop(file);
        assert!(!path.exists());
    }
}
