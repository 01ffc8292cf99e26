//! The table between temperatures, its errors against true errors, and refused requests.

use super::*;
use crate::law::AsperityLaw;
use crate::quantity::Quantity;
use crate::table::{Axes, Constants, Status};

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
        let start = quantity.origin(temperature);
        let end = cell[quantity].value;
        cell = cell.with_history(quantity, vec![start, 0.5 * (start + end), end]);
    }
    cell.steady = true;
    cell.wall_time = 3.0;
    cell
}

fn table(temperature: f64) -> Slice {
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
        film_strength: Some(0.1 * yield_strength),
        pressure_coefficient: Some(1e-10 * yield_strength),
        fracture_energy: Some(FractureEnergy { coefficient: 100.0 + temperature, radius_exponent: 1 }),
        ..Metadata::default()
    };
    Slice::filled(axes, metadata, |omega, rate| cell(omega, rate, temperature)).unwrap()
}

fn several() -> Table {
    Table::new(TEMPERATURES.map(table).to_vec()).unwrap()
}

#[test]
fn at_its_temperatures_it_is_its_tables() {
    let several = several();
    for (temperature, slice) in TEMPERATURES.into_iter().zip(several.slices()) {
        let at = several.at(temperature).unwrap();
        // Over the bits of every number.
        assert_eq!(at.checksum(), slice.checksum());
        assert_eq!(at.metadata().title, format!("Friction of one asperity, at {temperature} K"));
    }
}

/// Largest true error of a quantity over its estimate, and over its value, between the temperatures.
fn judged(several: &Table, quantity: Quantity) -> (f64, f64) {
    let temperatures = several.temperatures();
    let (mut beside_estimate, mut relative) = (0.0_f64, 0.0_f64);
    for pair in temperatures.windows(2) {
        for share in [0.1, 0.35, 0.5, 0.8] {
            let temperature = pair[0] + share * (pair[1] - pair[0]);
            let table = several.at(temperature).unwrap();
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
        let several = Table::new(temperatures.iter().map(|t| table(*t)).collect()).unwrap();
        for quantity in [Quantity::Mu, Quantity::Load, Quantity::Friction, Quantity::TemperatureMax] {
            let (beside_estimate, relative) = judged(&several, quantity);
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
    let several = several();
    let at = |temperature: f64| {
        let table = several.at(temperature).unwrap();
        let cell = table.cell(1, 1).unwrap();
        let numbers = [Quantity::Mu, Quantity::Load, Quantity::TemperatureMax].map(|q| cell[q].value);
        let history = cell.history(Quantity::TemperatureMax);
        let Metadata { film_strength, pressure_coefficient, yield_strength, .. } = *table.metadata();
        let film = [film_strength.unwrap() / 0.1, pressure_coefficient.unwrap() / 1e-10];
        assert!(film.iter().all(|of| (of / yield_strength - 1.0).abs() < 1e-3), "{film:?}");
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
    // The table is a law like any other.
    let table = several.at(700.0).unwrap();
    assert!(table.response(1e-3, 3.0, 0.5, 1e-6).unwrap().load.value > 0.0);
    // A power of ω_c at every temperature is one in between.
    let expected = 0.7 * (10.0 * table.metadata().critical_interference / 1e-7).powf(1.5);
    assert!((numbers[1] / expected - 1.0).abs() < 1e-12);
}

/// The response in units of strength and modulus does not change; the strength has a kink at 700 K.
#[test]
fn a_kink_of_the_strength_between_the_temperatures_adds_no_error() {
    let strength = |kelvin: f64| 1e7 * (if kelvin < 700.0 { 1.0 } else { 1.0 - (kelvin - 700.0) / 320.0 });
    let of = |kelvin: f64| {
        let mut slice = table(kelvin);
        let yield_strength = strength(kelvin);
        let metadata = slice.metadata_mut();
        metadata.yield_strength = yield_strength;
        metadata.critical_interference = 1e-3 * (yield_strength / metadata.contact_modulus).powi(2);
        for (i, j) in slice.grid() {
            let load = yield_strength.powi(3) * (1.0 + i as f64);
            let cell = slice.cell(i, j).unwrap().clone().with(Quantity::Load, load, 0.01 * load);
            slice.set_cell(i, j, cell).unwrap();
        }
        slice
    };
    let rough = Table::new([300.0, 600.0, 1000.0].map(of).to_vec()).unwrap();
    let rows: Vec<Metadata> = (0..=70).map(|n| of(300.0 + 10.0 * f64::from(n)).metadata().clone()).collect();
    let exact = rough.clone().with_constants(Constants::of(&rows)).unwrap();
    for kelvin in [650.0, 700.0, 805.0, 950.0] {
        let read = |table: &Table| table.at(kelvin).unwrap().cell(1, 1).unwrap()[Quantity::Load];
        let truth = 2.0 * strength(kelvin).powi(3);
        let (rough, exact) = (read(&rough), read(&exact));
        assert!((exact.value / truth - 1.0).abs() < 1e-3, "{kelvin}: {exact:?} {truth:e}");
        // The relative error of the cells is the same at all temperatures.
        assert!(
            (0.009..0.012).contains(&(exact.error / truth)) && rough.error > 0.5 * truth,
            "{kelvin}: {exact:?} {rough:?}"
        );
    }
}

#[test]
fn gaps_stay_gaps_with_their_reason() {
    let mut members = TEMPERATURES.map(table).to_vec();
    members[1].mark_failed(0, 1, "no convergence");
    members[2].set_status(1, 1, Status::NotRun);
    let several = Table::new(members).unwrap();
    for temperature in [400.0, 500.0] {
        let table = several.at(temperature).unwrap();
        assert_eq!(*table.status(0, 1), Status::Failed("at 450 K: no convergence".into()));
    }
    assert_eq!(several.at(500.0).unwrap().missing(), [(1, 1)]);
    // Further off a gap only widens the error.
    let (whole, gappy) = (self::several().at(700.0).unwrap(), several.at(700.0).unwrap());
    assert!(gappy.cell(0, 1).unwrap()[Quantity::Mu].error > 0.0);
    assert_eq!(gappy.cell(0, 0), whole.cell(0, 0));
}

#[test]
fn refusals_name_the_range() {
    let several = several();
    let message = several.at(1001.0).unwrap_err().to_string();
    assert_eq!(message, "initial temperature 1001 K is outside the table, which goes from 300 to 1000 K");
    let celsius = several.at(150.0).unwrap_err().to_string();
    assert!(celsius.ends_with("from 300 to 1000 K; if it is in degrees Celsius, write 423.15"), "{celsius}");
    assert!(several.at(f64::NAN).is_err());
    let open = several.at(None).unwrap_err().to_string();
    assert!(
        open.contains("from 300 to 1000 K; choose one: asperity by --temperature, roughsurface by "),
        "{open}"
    );
    let one = Table::from(table(300.0));
    let other = one.at(450.0).unwrap_err().to_string();
    assert!(other.starts_with("is for an initial temperature of 300 K only, not 450 K; leave"), "{other}");
    assert_eq!(one.at(300.0).unwrap().into_slice(), table(300.0));
    assert_eq!(one.at(None).unwrap().into_slice(), table(300.0));

    let mut other = table(450.0);
    other.metadata_mut().heat_partition = 0.7;
    let message = Table::new(vec![table(300.0), other]).unwrap_err().to_string();
    assert!(message.contains("heat_partition: 0.0") && message.contains("heat_partition: 0.7"), "{message}");
    let falling = Table::new(vec![table(450.0), table(300.0)]).unwrap_err().to_string();
    assert!(falling.contains("axis \"temperature\" must increase"), "{falling}");
}
