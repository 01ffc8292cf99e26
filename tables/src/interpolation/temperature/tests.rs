//! The file, the table between temperatures and how true its errors are, what is refused.

use super::*;
use crate::law::AsperityLaw;
use crate::quantity::Quantity;
use crate::table::Axes;

const TEMPERATURES: [f64; 5] = [300.0, 450.0, 600.0, 800.0, 1000.0];
const INITIAL_STRENGTH: f64 = 800e6;

/// Softening after Johnson & Cook.
fn softening(temperature: f64) -> f64 {
    1.0 - ((temperature - 290.0) / 1500.0).powf(0.9)
}

/// A cell of a smooth law of interference, slip rate and initial temperature.
fn cell(interference: f64, slip_rate: f64, temperature: f64) -> Cell {
    let strength = softening(temperature);
    let load = 0.7 * (interference * strength.powi(2)).powf(1.5);
    let rise = 80.0 * slip_rate.sqrt() * strength;
    let mu = 0.4 / (1.0 + 0.002 * rise) + 1e-4 * (temperature - 300.0);
    let mut cell = Cell::new();
    for quantity in Quantity::SCALARS {
        let value = match quantity {
            Quantity::TemperatureMax => temperature + rise,
            Quantity::TemperatureMean => temperature + 0.5 * rise,
            Quantity::Mu | Quantity::MuStatic | Quantity::MuPeak => mu,
            Quantity::Friction | Quantity::FrictionStatic => mu * load,
            _ => load,
        };
        cell = cell.with(quantity, value, 0.0);
    }
    for quantity in Quantity::TABLE_HISTORIES {
        let start = if quantity.is_temperature() { temperature } else { 0.0 };
        let end = cell[quantity].value;
        cell = cell.with_history(quantity, vec![start, 0.5 * (start + end), end]);
    }
    cell.levelled = true;
    cell.wall_time = 3.0;
    cell
}

fn table(temperature: f64) -> Table {
    let axes = Axes { interference: vec![1.0, 10.0], slip_rate: vec![0.0, 1.0], slip: vec![0.0, 0.5, 2.0] };
    let yield_strength = INITIAL_STRENGTH * softening(temperature);
    let metadata = Metadata {
        title: "Friction of one asperity".into(),
        history: "made".into(),
        source: "asperity".into(),
        scene: "[material]\n".into(),
        asperity_radius: 1e-3,
        temperature,
        yield_strength,
        contact_modulus: 220e9,
        critical_interference: 1e-7 * softening(temperature).powi(2),
        poisson_ratio: 0.3,
        strength_factor: Some(1.0),
        fracture_energy: Some(FractureEnergy { coefficient: 100.0 + temperature, radius_exponent: 1 }),
        ..Metadata::default()
    };
    let mut table = Table::new(axes, metadata).unwrap();
    for (i, j) in table.grid() {
        let (interference, slip_rate) = table.coordinates(i, j);
        table.set_cell(i, j, cell(interference, slip_rate, temperature)).unwrap();
    }
    table
}

fn series() -> TemperatureSeries {
    TemperatureSeries::new(TEMPERATURES.map(table).to_vec()).unwrap()
}

struct Place(std::path::PathBuf);

impl Place {
    fn new(name: &str) -> Self {
        Self(std::env::temp_dir().join(format!("series-{}-{name}.nc", std::process::id())))
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

#[test]
fn what_is_written_is_read_back() {
    let place = Place::new("round-trip");
    let mut series = series();
    series.members[1].mark_failed(0, 1, "no convergence");
    series.members[2].set_status(1, 1, Status::NotRun);
    let mut warned = series.members[3].cell(1, 0).unwrap().clone();
    warned.warnings = vec!["coarse".into(), "far".into()];
    series.members[3].set_cell(1, 0, warned).unwrap();
    series.summarise();
    assert!(series.members[0].metadata().comment.starts_with("at 800 K: coarse [10 omega_c at 0 m/s]"));
    series.write(&place.0).unwrap();
    assert_eq!(TemperatureSeries::read(&place.0).unwrap(), series);
    assert_eq!(Tables::read(&place.0).unwrap().members(), series.members());
}

#[test]
fn a_file_of_several_temperatures_is_not_taken_for_a_table() {
    let (many, one) = (Place::new("many"), Place::new("one"));
    series().write(&many.0).unwrap();
    table(300.0).write(&one.0).unwrap();
    let message = Table::read(&many.0).unwrap_err().to_string();
    assert!(message.contains("has initial temperatures from 300 to 1000 K; choose one"), "{message}");
    let message = TemperatureSeries::read(&one.0).unwrap_err().to_string();
    assert!(message.ends_with("is a table of one initial temperature, 300 K"), "{message}");
    let version = |place: &Place| {
        let file = crate::netcdf::DatasetReader::open(&place.0).unwrap();
        file.attribute_real("schema_version").unwrap()
    };
    // A program that knows version 1 refuses any other.
    assert_eq!((version(&one), version(&many)), (1.0, 2.0));
}

#[test]
fn changed_content_is_noticed() {
    let place = Place::new("changed");
    for name in ["temperature", "critical_interference", "yield_strength"] {
        series().write(&place.0).unwrap();
        let mut file = ::netcdf::append(&place.0).unwrap();
        file.variable_mut(name).unwrap().put_value(301.0, [0]).unwrap();
        drop(file);
        let message = TemperatureSeries::read(&place.0).unwrap_err().to_string();
        assert!(message.contains("checksum"), "{name}: {message}");
    }
    series().write(&place.0).unwrap();
    ::netcdf::append(&place.0).unwrap().variable_mut("mu").unwrap().put_value(0.1, [4, 1, 1]).unwrap();
    assert!(Tables::read(&place.0).unwrap_err().to_string().contains("checksum"));
}

#[test]
fn at_its_temperatures_it_is_its_tables() {
    let series = series();
    for (temperature, member) in TEMPERATURES.into_iter().zip(series.members()) {
        let at = series.at(temperature).unwrap();
        // Over the bits of every number.
        assert_eq!(at.checksum(), member.checksum());
        assert_eq!(at.metadata().title, format!("Friction of one asperity, at {temperature} K"));
    }
}

/// Largest true error of a quantity over its estimate, and over its value, between the temperatures.
fn judged(series: &TemperatureSeries, quantity: Quantity) -> (f64, f64) {
    let temperatures = series.temperatures();
    let (mut beside_estimate, mut relative) = (0.0_f64, 0.0_f64);
    for pair in temperatures.windows(2) {
        for share in [0.1, 0.35, 0.5, 0.8] {
            let temperature = pair[0] + share * (pair[1] - pair[0]);
            let table = series.at(temperature).unwrap();
            for (i, j) in table.grid() {
                let (interference, slip_rate) = table.coordinates(i, j);
                let truth = cell(interference, slip_rate, temperature)[quantity].value;
                let found = table.cell(i, j).unwrap()[quantity];
                let rounding = 1e-12 * truth.abs();
                beside_estimate = beside_estimate.max((found.value - truth).abs() / (found.error + rounding));
                relative = relative.max((found.value / truth - 1.0).abs());
            }
        }
    }
    (beside_estimate, relative)
}

#[test]
fn between_its_temperatures_errors_are_within_their_estimates() {
    for temperatures in [&TEMPERATURES[..], &[300.0, 600.0, 1000.0], &[300.0, 700.0]] {
        let series = TemperatureSeries::new(temperatures.iter().map(|t| table(*t)).collect()).unwrap();
        for quantity in [Quantity::Mu, Quantity::Load, Quantity::Friction, Quantity::TemperatureMax] {
            let (beside_estimate, relative) = judged(&series, quantity);
            assert!(beside_estimate <= 1.0, "{temperatures:?} {quantity:?}: {beside_estimate}");
            let expected = if temperatures.len() == 5 { 0.01 } else { 0.2 };
            assert!(relative < expected, "{temperatures:?} {quantity:?}: {relative}");
        }
    }
}

/// The stated limit: smooth from the reference temperature on, where the slope may be infinite.
#[test]
fn errors_of_johnson_cook_strengths_are_within_their_estimates() {
    for exponent in [0.8, 0.9, 1.0, 1.03, 1.1, 1.34] {
        let strength = |temperature: f64| 8e8 * (1.0 - ((temperature - 298.0) / 1502.0).powf(exponent));
        for temperatures in
            [&[298.0, 450.0, 600.0, 800.0, 1000.0][..], &[298.0, 500.0, 700.0, 900.0], &[298.0, 500.0, 900.0]]
        {
            for step in 1..1000 {
                let last = temperatures[temperatures.len() - 1];
                let temperature = 298.0 + (last - 298.0) * 1e-3 * f64::from(step);
                let place = locate(temperatures, temperature);
                let line = Line::new(temperatures, place, |member| strength(temperatures[member]), cubic);
                if place.t > 0.0 {
                    let off = (line.value() - strength(temperature)).abs();
                    let rounding = 1e-12 * strength(298.0);
                    assert!(
                        off <= line.error() + rounding,
                        "{exponent} {temperatures:?} {temperature}: {off:e} of {:e}",
                        line.error()
                    );
                }
            }
        }
    }
}

#[test]
fn between_its_temperatures_it_is_smooth_and_meets_its_tables() {
    let series = series();
    let at = |temperature: f64| {
        let table = series.at(temperature).unwrap();
        let cell = table.cell(1, 1).unwrap();
        let numbers = [Quantity::Mu, Quantity::Load, Quantity::TemperatureMax].map(|q| cell[q].value);
        let history = cell.history(Quantity::TemperatureMax);
        (numbers, [history[0], history[2]], table.metadata().yield_strength)
    };
    for temperature in &TEMPERATURES[1..4] {
        let [below, on, above] = [-1e-4, 0.0, 1e-4].map(|step| at(temperature + step));
        for k in 0..3 {
            let (left, right) = (on.0[k] - below.0[k], above.0[k] - on.0[k]);
            assert!((left / right - 1.0).abs() < 1e-3, "{temperature} {k}: {left} {right}");
        }
        assert!((on.2 / above.2 - 1.0).abs() < 1e-6);
    }
    // Histories begin at the initial temperature and end with the scalar.
    let (numbers, ends, strength) = at(700.0);
    assert_eq!(ends[0], 700.0);
    assert!((ends[1] / numbers[2] - 1.0).abs() < 1e-12);
    assert!((strength / (INITIAL_STRENGTH * softening(700.0)) - 1.0).abs() < 2e-3, "{strength}");
    // The table answers as any other does.
    let table = series.at(700.0).unwrap();
    assert!(table.response(1e-3, 3.0, 0.5, 1e-6).unwrap().load.value > 0.0);
    // What is a power of ω_c at every temperature stays one.
    let expected = 0.7 * (10.0 * table.metadata().critical_interference / 1e-7).powf(1.5);
    assert!((numbers[1] / expected - 1.0).abs() < 1e-12);
}

#[test]
fn gaps_stay_gaps_with_their_reason() {
    let mut members = TEMPERATURES.map(table).to_vec();
    members[1].mark_failed(0, 1, "no convergence");
    members[2].set_status(1, 1, Status::NotRun);
    let series = TemperatureSeries::new(members).unwrap();
    for temperature in [400.0, 500.0] {
        let table = series.at(temperature).unwrap();
        assert_eq!(*table.status(0, 1), Status::Failed("at 450 K: no convergence".into()));
    }
    assert_eq!(series.at(500.0).unwrap().missing(), [(1, 1)]);
    // Further off a gap only widens the error.
    let (whole, gappy) = (self::series().at(700.0).unwrap(), series.at(700.0).unwrap());
    assert!(gappy.cell(0, 1).unwrap()[Quantity::Mu].error > 0.0);
    assert_eq!(gappy.cell(0, 0), whole.cell(0, 0));
}

#[test]
fn refusals_name_the_range() {
    let series = series();
    let message = series.at(1001.0).unwrap_err().to_string();
    assert_eq!(message, "initial temperature 1001 K is outside the table, which goes from 300 to 1000 K");
    assert!(series.at(f64::NAN).is_err());
    let message = |tables: Tables, temperature| tables.at(temperature).unwrap_err().to_string();
    let open = message(Tables::Series(series), None);
    assert!(open.contains("from 300 to 1000 K; choose one by --temperature"), "{open}");
    let other = message(Tables::One(Box::new(table(300.0))), Some(450.0));
    assert_eq!(other, "is for an initial temperature of 300 K only, not 450 K");
    assert_eq!(Tables::One(Box::new(table(300.0))).at(Some(300.0)).unwrap(), table(300.0));

    let mut other = table(450.0);
    other.set_metadata(Metadata { heat_partition: 0.7, ..other.metadata().clone() });
    let message = TemperatureSeries::new(vec![table(300.0), other]).unwrap_err().to_string();
    assert!(message.contains("heat_partition: 0.0") && message.contains("heat_partition: 0.7"), "{message}");
    let falling = TemperatureSeries::new(vec![table(450.0), table(300.0)]).unwrap_err().to_string();
    assert!(falling.contains("axis \"temperature\" must increase"), "{falling}");
}

#[test]
fn shards_merge_to_the_whole() {
    let whole = series();
    let (mut first, mut second) = (whole.clone(), whole.clone());
    for (k, (one, other)) in first.members.iter_mut().zip(&mut second.members).enumerate() {
        let (i, j) = (k % 2, k / 2 % 2);
        one.set_status(i, j, Status::NotRun);
        other.set_status(1 - i, j, Status::NotRun);
    }
    first.merge(&second).unwrap();
    assert_eq!(first, whole);
    let fewer = TemperatureSeries::new(whole.members[..2].to_vec()).unwrap();
    assert!(first.merge(&fewer).unwrap_err().to_string().contains("their temperatures"));
}

#[test]
fn lines_have_the_temperature_first() {
    let mut bytes = Vec::new();
    Tables::Series(series()).write_csv(&mut bytes).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    assert!(text.starts_with("temperature [K],interference [1],slip_rate [m s-1],status,"));
    assert_eq!(text.lines().count(), 1 + 5 * 4);
    assert!(text.lines().last().unwrap().starts_with("1000,10,1,done,"));
    let mut bytes = Vec::new();
    Tables::Series(series()).write_histories_csv(&mut bytes).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    assert_eq!(text.lines().count(), 1 + 5 * 4 * 3);
}
