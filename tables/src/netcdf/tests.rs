//! Writing, reading back, and refused files.

use std::path::Path;

use super::*;
use crate::quantity::Quantity;
use crate::table::Axes;
use crate::table::{Cell, Constants, FractureEnergy, Metadata, Slice, Table};

fn table() -> Slice {
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
        film_strength: Some(25e6),
        pressure_coefficient: Some(0.06),
        rate_coefficient: Some(0.014),
        rate_reference: Some(2.0),
        ..Metadata::default()
    };
    let mut table = Slice::new(axes, metadata).unwrap();
    for (i, j) in [(0, 0), (0, 1), (1, 2)] {
        let mut cell = Cell::new();
        for (n, quantity) in Quantity::SCALARS.into_iter().enumerate() {
            cell = cell.with(quantity, (1 + n + i + 2 * j) as f64 / 3.0, 0.01);
        }
        for quantity in [Quantity::Mu, Quantity::Friction] {
            cell = cell.with_history(quantity, vec![0.0, 1.0 / 3.0, 0.1]);
        }
        cell.steady = i == 1;
        cell.wall_time = 12.5;
        if i == 0 {
            cell.warnings = vec!["coarse".to_string(), "far".to_string()];
        }
        table.set_cell(i, j, cell).unwrap();
    }
    table.mark_failed(1, 0, "Newton did not converge at s = 1e-7 m");
    table
}

#[test]
fn equal_content_gives_equal_bytes() {
    let directory = tempfile::tempdir().unwrap();
    let [first, second] = ["first.nc", "second.nc"].map(|name| directory.path().join(name));
    table().write(&first).unwrap();
    table().write(&second).unwrap();
    let bytes = std::fs::read(&first).unwrap();
    assert_eq!(bytes, std::fs::read(&second).unwrap());
    // Overwriting leaves neither an old nor a temporary file.
    table().write(&first).unwrap();
    assert_eq!(bytes, std::fs::read(&first).unwrap());
    assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 2);
}

#[test]
fn foreign_files_are_named() {
    let message = |path: &Path| Table::read(path).unwrap_err().to_string();
    let missing = message(Path::new("nowhere/table.nc"));
    assert!(missing.starts_with("cannot read nowhere/table.nc: No such file"));

    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("table.nc");
    std::fs::write(&path, "not netCDF").unwrap();
    assert!(message(&path).starts_with(&format!("cannot read {}", path.display())));

    let mut other = DatasetWriter::create(&path, "a run").unwrap();
    other.coordinate("step", &[0.0, 1.0], &[]).unwrap();
    other.finish().unwrap();
    let foreign = message(&path);
    assert!(
        foreign.contains("is not a table but \"a run\": global attribute \"schema\" is missing"),
        "{foreign}"
    );
    assert!(!foreign.contains('\n'));
}

/// Numbers of other programs: of other types, packed, and with fill values of their own.
#[test]
fn packed_numbers_and_fill_values_of_any_type_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("packed.nc");
    let mut file = ::netcdf::create(&path).unwrap();
    file.add_dimension("x", 3).unwrap();
    let mut packed = file.add_variable::<i16>("packed", &["x"]).unwrap();
    packed.put_attribute("scale_factor", 1e-3).unwrap();
    packed.put_attribute("add_offset", 2.0).unwrap();
    packed.put_values(&[0i16, 5, -32767], ..).unwrap();
    let mut single = file.add_variable::<f32>("single", &["x"]).unwrap();
    single.set_fill_value(-9999f32).unwrap();
    single.put_values(&[0.5f32, -9999.0, 1.5], ..).unwrap();
    let mut missing = file.add_variable::<f64>("missing", &["x"]).unwrap();
    missing.put_attribute("missing_value", -1.0).unwrap();
    missing.put_values(&[-1.0, 2.0, 3.0], ..).unwrap();
    file.add_variable::<f32>("unset", &["x"]).unwrap();
    drop(file);
    let reader = DatasetReader::open(&path).unwrap();
    let nan = f64::NAN;
    for (name, expected) in [
        ("packed", [2.0, 2.005, nan]),
        ("single", [0.5, nan, 1.5]),
        ("missing", [nan, 2.0, 3.0]),
        ("unset", [nan; 3]),
    ] {
        let found = reader.reals(name, &[3]).unwrap();
        let same = |(one, other): (&f64, &f64)| one == other || one.is_nan() && other.is_nan();
        assert!(found.iter().zip(&expected).all(same), "{name}: {found:?}");
    }
}

/// What is said of a table as written, then changed through the library as any other program could.
fn tampered(table: &Table, change: impl FnOnce(&mut netcdf::FileMut) -> netcdf::Result<()>) -> String {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("table.nc");
    table.write(&path).unwrap();
    change(&mut netcdf::append(&path).unwrap()).unwrap();
    let message = Table::read(&path).map_or_else(|error| error.to_string(), |_| String::new());
    assert!(!message.contains('\n'));
    message
}

#[test]
fn other_schemas_and_versions_are_refused_by_name() {
    let table = Table::from(table());
    let attribute = |name: &'static str, value: &'static str| {
        tampered(&table, |file| file.add_attribute(name, value).map(|_| ()))
    };
    assert!(attribute("schema", "friction").contains("of the kind \"friction\", not a table"));
    let version = tampered(&table, |file| file.add_attribute("schema_version", 7).map(|_| ()));
    assert!(version.contains("schema version 7, this program reads versions 1 and 2"), "{version}");
    assert_eq!(attribute("history", "more of it"), "");
}

#[test]
fn changed_content_is_noticed() {
    let is_noticed = |message: String| message.contains("does not agree with its checksum");
    let one = Table::from(table());
    for (table, name, index) in [
        (&one, "mu", &[0, 1][..]),
        (&one, "G_error", &[0, 1]),
        (&one, "wall_time", &[0, 1]),
        (&one, "Q_history", &[0, 0, 2]),
        (&several(), "temperature", &[0]),
        (&several(), "critical_interference", &[0]),
        (&several(), "yield_strength", &[0]),
        (&several(), "film_strength", &[1]),
        (&several(), "pressure_coefficient", &[2]),
        (&several(), "mu", &[2, 1, 2]),
    ] {
        let change = |file: &mut netcdf::FileMut| file.variable_mut(name).unwrap().put_value(301.0, index);
        assert!(is_noticed(tampered(table, change)), "{name}");
    }
    let put =
        |file: &mut netcdf::FileMut| file.variable_mut("failure_reason").unwrap().put_string("none", [1, 0]);
    assert!(is_noticed(tampered(&one, put)));
    assert!(is_noticed(tampered(&one, |file| file.add_attribute("scene", "radius = 2").map(|_| ()))));
}

#[test]
fn short_records_are_refused() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("table.nc");
    let mut file = DatasetWriter::create(&path, "short").unwrap();
    file.dimension("step", 3).unwrap();
    let error = file.reals("slip", &["step"], &[0.0, 1.0], &[]).unwrap_err();
    assert!(error.to_string().contains("2 values instead of 3"));
    drop(file);
    assert!(!path.exists());
}

#[test]
fn energy_is_related_to_the_fracture_energy_where_that_is_known() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("table.nc");
    for radius_exponent in [0, 1] {
        let mut with = table();
        let law = FractureEnergy { coefficient: 0.25, radius_exponent };
        with.metadata_mut().fracture_energy = Some(law);
        with.write(&path).unwrap();
        assert_eq!(Table::read(&path).unwrap().only().unwrap().clone(), with);
        let file = DatasetReader::open(&path).unwrap();
        let values = file.reals("G_ratio", &[2, 3]).unwrap();
        let cell = with.cell(1, 2).unwrap();
        let (energy, radius) = (cell[Quantity::EnergyRelease].value, cell[Quantity::ContactRadius].value);
        let exact = energy / (0.25 * radius.powi(radius_exponent));
        assert!((values[5] / exact - 1.0).abs() < 1e-14 && values[3].is_nan());
        assert!(file.reals("G_ratio_error", &[2, 3]).unwrap()[5] > 0.0);
    }
}

/// Tables of several initial temperatures, with cells of every state.
fn several() -> Table {
    let at = |temperature: f64| {
        let mut slice = table();
        let metadata = slice.metadata_mut();
        metadata.temperature = temperature;
        metadata.yield_strength = 1e9 - temperature;
        metadata.film_strength = Some(25e6 - temperature);
        metadata.pressure_coefficient = Some(1.0 / temperature);
        slice
    };
    Table::new([300.0, 450.0, 600.0].map(at).to_vec()).unwrap()
}

#[test]
fn what_is_written_is_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name);
    several().write(&place("several.nc")).unwrap();
    let rows = several().slices().iter().map(|slice| slice.metadata().clone()).collect::<Vec<_>>();
    let dense = several().with_constants(Constants::of(&rows)).unwrap();
    dense.write(&place("dense.nc")).unwrap();
    assert_eq!(Table::read(&place("dense.nc")).unwrap(), dense);
    assert_ne!(dense.checksum(), several().checksum());
    table().write(&place("one.nc")).unwrap();
    assert_eq!(Table::read(&place("several.nc")).unwrap(), several());
    assert_eq!(*Table::read(&place("one.nc")).unwrap().only().unwrap(), table());
    let version = |name: &str| {
        let file = DatasetReader::open(&place(name)).unwrap();
        assert_eq!(file.has("temperature"), name == "several.nc");
        file.attribute_real("schema_version").unwrap()
    };
    // A program that reads version 1 only refuses any other.
    assert_eq!((version("one.nc"), version("several.nc")), (1.0, 2.0));
}
