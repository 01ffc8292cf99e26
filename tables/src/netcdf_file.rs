//! Tables as CF netCDF files.

use std::path::Path;

use crate::dataset::{AttributeValue, DatasetError, DatasetReader, DatasetWriter};
use crate::quantity::{Descriptor, QUANTITIES, Quantity};
use crate::schema;
use crate::table::{Axes, Cell, Metadata, Status, Table};

const GRID: [&str; 2] = ["interference", "slip_rate"];
const GRID_AND_SLIP: [&str; 3] = ["interference", "slip_rate", "slip"];
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
mod tests {
    use super::*;

    fn table() -> Table {
        let axes =
            Axes { interference: vec![0.5, 5.0], slip_rate: vec![0.0, 0.1, 1.0], slip: vec![0.0, 0.5, 2.0] };
        let metadata = Metadata {
            title: "Friction of one asperity".to_string(),
            history: "2026-01-01 asperity tabulate".to_string(),
            source: "asperity 0.1.0".to_string(),
            fingerprint: "0123456789abcdef".to_string(),
            shard: "2/3".to_string(),
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
            if i == 0 {
                cell.warnings = vec!["coarse".to_string(), "far".to_string()];
            }
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
        assert!(foreign.contains("is not a table: global attribute \"schema\" is missing"));
        assert!(!foreign.contains('\n'));
        std::fs::remove_file(&path).unwrap();
    }

    /// The table as written, then changed through the library as any other program could.
    fn tampered(name: &str, change: impl FnOnce(&mut netcdf::FileMut) -> netcdf::Result<()>) -> String {
        let path = place(name);
        table().write(&path).unwrap();
        change(&mut netcdf::append(&path).unwrap()).unwrap();
        let message = match Table::read(&path) {
            Ok(_) => String::new(),
            Err(error) => error.to_string(),
        };
        std::fs::remove_file(&path).unwrap();
        assert!(!message.contains('\n'));
        message
    }

    #[test]
    fn other_schemas_and_versions_are_refused_by_name() {
        let attribute = |name: &'static str, value: &'static str| {
            tampered(name, |file| file.add_attribute(name, value).map(|_| ()))
        };
        assert!(attribute("schema", "friction").contains("of the kind \"friction\", not a table"));
        let version = tampered("version", |file| file.add_attribute("schema_version", 7).map(|_| ()));
        assert!(version.contains("schema version 7, this program reads version 1"), "{version}");
        assert_eq!(attribute("history", "more of it"), "");
    }

    #[test]
    fn changed_content_is_noticed() {
        let changed = |name: &str, value: f64| {
            tampered(name, |file| file.variable_mut(name).unwrap().put_value(value, [0, 1]))
        };
        for name in ["mu", "G_error", "wall_time"] {
            let message = changed(name, 0.123);
            assert!(message.contains("does not agree with its checksum"), "{name}: {message}");
        }
        let history = tampered("history-of-Q", |file| {
            file.variable_mut("Q_history").unwrap().put_value(9.0, [0, 0, 2])
        });
        assert!(history.contains("checksum"));
        let reason = tampered("reason", |file| {
            file.variable_mut("failure_reason").unwrap().put_string("none", [1, 0])
        });
        assert!(reason.contains("checksum"));
        let scene = tampered("scene", |file| file.add_attribute("scene", "radius = 2").map(|_| ()));
        assert!(scene.contains("checksum"));
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
