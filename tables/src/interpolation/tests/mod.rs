//! Between the points of a table, against a smooth law.

mod limits;

use super::*;
use crate::closed_forms::{ClosedForm, STEEL, hertz};
use crate::numbers::Spacing::Log;
use crate::quantity::Quantity;
use crate::table::{Axes, Metadata};

const RADIUS: f64 = 1e-3;
const BASE: f64 = 298.0;
/// V* of 1/(1 + V/V*) for the contact of first yield, m/s.
const WEAKENING_RATE: f64 = 4.0;

/// A smooth asperity to interpolate: Jackson & Green with strength that falls with slip rate,
/// contact radius and slip.
fn truth(interference: f64, slip_rate: f64, slip: f64) -> Response {
    let law = ClosedForm::new("jackson-green", &STEEL).unwrap();
    let cold = law.response(RADIUS, interference, 0.0, slip).unwrap();
    let contact_radius = (cold.area.value / std::f64::consts::PI).sqrt();
    let critical = hertz::contact_radius(RADIUS, STEEL.critical_interference(RADIUS));
    let ratio = slip / contact_radius;
    let heating = slip_rate / WEAKENING_RATE * contact_radius / critical * (ratio / (1.0 + ratio));
    let drop = 1.0 - 0.1 * ratio / (1.0 + ratio);
    let exact = Estimate::exact;
    let (load, friction) = (exact(cold.load.value * drop), exact(cold.friction.value / (1.0 + heating)));
    Response::new(load, friction, cold.area, exact(BASE + 900.0 * heating / (1.0 + heating)))
}

fn slice_of(interference: Vec<f64>, slip_rate: Vec<f64>) -> Slice {
    let slip = vec![
        0.0, 1e-4, 2e-4, 4e-4, 7e-4, 1e-3, 1.3e-3, 1.6e-3, 2e-3, 3e-3, 0.01, 0.03, 0.1, 0.2, 0.35, 0.5, 0.75,
        1.0, 1.35, 1.7, 2.0,
    ];
    let axes = Axes { interference, slip_rate, slip };
    let metadata = Metadata { heat_partition: 0.5, ..Metadata::of_sphere(&STEEL, RADIUS, BASE) };
    let mut slice = Slice::of_response(axes, metadata, truth).unwrap();
    for (i, j) in slice.grid() {
        let cell = slice.cell(i, j).unwrap().clone();
        let (friction, radius) = (cell[Quantity::Friction].value, cell[Quantity::ContactRadius].value);
        let cell = cell.with(Quantity::Friction, friction, 0.02 * friction);
        slice.set_cell(i, j, cell.with(Quantity::EnergyRelease, 1e-3 * radius, 0.0)).unwrap();
    }
    slice
}

fn table_of(interference: Vec<f64>, slip_rate: Vec<f64>) -> InterpolatedTable {
    slice_of(interference, slip_rate).interpolated()
}

/// The smooth table with something changed.
fn changed(change: impl FnOnce(&mut Slice)) -> InterpolatedTable {
    let mut slice = table().into_slice();
    change(&mut slice);
    slice.interpolated()
}

fn table() -> InterpolatedTable {
    let mut rates = Log.range(0.1, 10.0, 5);
    rates.insert(0, 0.0);
    table_of(Log.range(0.5, 100.0, 8), rates)
}

fn relative(value: f64, reference: f64) -> f64 {
    (value / reference - 1.0).abs()
}

#[test]
fn points_of_the_table_come_back() {
    let table = table();
    let axes = table.axes().clone();
    for omega in &axes.interference {
        for rate in &axes.slip_rate {
            let area = truth(*omega, 0.0, 0.0).area.value;
            let slip = 0.35 * (area / std::f64::consts::PI).sqrt();
            let here = table.response(RADIUS, *omega, *rate, slip).unwrap();
            let there = truth(*omega, *rate, slip);
            for (a, b) in [
                (here.load, there.load),
                (here.friction, there.friction),
                (here.area, there.area),
                (here.temperature_max, there.temperature_max),
            ] {
                assert!(relative(a.value, b.value) < 1e-9, "{omega} {rate}: {a:?} {b:?}");
            }
            assert!(relative(here.friction.error, 0.02 * here.friction.value) < 1e-6);
        }
    }
}

#[test]
fn between_points_it_is_accurate_and_knows_how_accurate() {
    let table = table();
    let (mut worst, mut inside, mut asked) = (0.0_f64, 0, 0);
    for omega in Log.range(0.51, 99.0, 41) {
        for rate in Log.range(0.03, 9.9, 23) {
            for part in [0.0007, 0.15, 0.6, 1.9] {
                let area = truth(omega, 0.0, 0.0).area.value;
                let slip = part * (area / std::f64::consts::PI).sqrt();
                let here = table.response(RADIUS, omega, rate, slip).unwrap();
                let there = truth(omega, rate, slip);
                // Of interpolation alone.
                let Estimate { value, error } = here.friction;
                let errors = (error.powi(2) - (0.02 * value).powi(2)).max(0.0).sqrt();
                let actual = (here.friction.value - there.friction.value).abs();
                worst = worst.max(actual / there.friction.value);
                asked += 1;
                inside += usize::from(actual <= errors.max(1e-5 * here.friction.value));
            }
        }
    }
    let covered = inside as f64 / asked as f64;
    println!("worst {worst}, covered {covered}");
    assert!(worst < 0.02, "{worst}");
    assert!(covered > 0.9, "{covered}");
}

#[test]
fn power_laws_are_exact() {
    let table = table_of(vec![0.1, 0.3, 1.8], vec![0.0]);
    for omega in [0.13, 0.2, 0.9, 1.7] {
        let here = table.response(RADIUS, omega, 0.0, 0.0).unwrap();
        let there = truth(omega, 0.0, 0.0);
        assert!(relative(here.load.value, there.load.value) < 1e-9);
        assert!(relative(here.area.value, there.area.value) < 1e-9);
    }
}

#[test]
fn other_radii_see_the_same_dimensionless_asperity() {
    let table = table();
    let here = table.response(RADIUS, 7.0, 1.0, 1e-6).unwrap();
    let there = table.response(0.1 * RADIUS, 7.0, 10.0, 1e-7).unwrap();
    assert!(relative(there.friction.value, 0.01 * here.friction.value) < 1e-12);
    assert!(relative(there.load.value, 0.01 * here.load.value) < 1e-12);
    assert!(relative(there.temperature_max.value, here.temperature_max.value) < 1e-12);
    let (_, to) = table.slip_rate_range(0.1 * RADIUS);
    assert!(relative(to, 100.0) < 1e-9);
    let energy = |radius, rate| table.estimate(Quantity::EnergyRelease, radius, 7.0, rate);
    let (one, tenth) = (energy(RADIUS, 1.0).unwrap(), energy(0.1 * RADIUS, 10.0).unwrap());
    assert!(relative(tenth.value, 0.1 * one.value) < 1e-12);

    let fixed = changed(|slice| slice.metadata_mut().gap_conductance = 1e4);
    assert!(fixed.response(RADIUS, 7.0, 1.0, 0.0).is_ok());
    let refused = fixed.response(2.0 * RADIUS, 7.0, 1.0, 0.0).unwrap_err();
    assert!(matches!(refused, LookupError::RadiusFixed { .. }));
}

/// At a tenth of the radius and the same VR the strain rate is a hundredfold. With a film the limit of the shear traction does
/// not follow the strength of the metal.
#[test]
fn at_other_radii_values_follow_the_strength_at_the_strain_rate_there() {
    const C: f64 = 0.02;
    let of_film = |film: bool| {
        let mut slice = slice_of(Log.range(0.5, 100.0, 8), Log.range(0.1, 10.0, 5));
        let metadata = slice.metadata_mut();
        (metadata.rate_coefficient, metadata.rate_reference) = (Some(C), Some(1.0));
        if film {
            (metadata.film_strength, metadata.pressure_coefficient) = (Some(1e8), Some(0.1));
        }
        slice.interpolated()
    };
    let plain = slice_of(Log.range(0.5, 100.0, 8), Log.range(0.1, 10.0, 5)).interpolated();
    let [rated, of_film] = [false, true].map(of_film);
    let contact = plain.estimate(Quantity::ContactRadius, RADIUS, 7.0, 1.0).unwrap().value;
    let strength = |strain_rate: f64| 1.0 + C * strain_rate.ln();
    let change = strength(100.0 / contact) / strength(1.0 / contact);
    let after = |table: &InterpolatedTable, slip: f64| table.response(0.1 * RADIUS, 7.0, 10.0, slip).unwrap();
    let of = |table: &InterpolatedTable| after(table, 1e-6);
    // The press is quasi-static.
    assert_eq!(after(&rated, 0.0).load, after(&plain, 0.0).load);
    let exponent = |with: Estimate, without: Estimate| (with.value / without.value).ln() / change.ln();
    let wider = |with: Estimate, without: Estimate| {
        (with.error / with.value - without.error / without.value) / change.ln()
    };
    let (rated_there, plain_there, film_there) = (of(&rated), of(&plain), of(&of_film));
    // Between the exponents at 0.7 and at 125 omega_c.
    let between = |light: f64, deep: f64| light + (deep - light) * (7f64 / 0.7).ln() / (125f64 / 0.7).ln();
    assert!((exponent(rated_there.load, plain_there.load) - between(0.1, 0.55)).abs() < 1e-9);
    assert!((exponent(rated_there.friction, plain_there.friction) - between(0.9, 0.8)).abs() < 1e-9);
    assert!((wider(rated_there.load, plain_there.load) - between(0.35, 0.95)).abs() < 1e-9);
    assert_eq!(film_there.friction.value, plain_there.friction.value);
    assert!((wider(film_there.load, plain_there.load) - between(0.45, 1.5)).abs() < 1e-9);
    for (quantity, mean) in [
        (Quantity::Mu, between(0.8, 0.3)),
        (Quantity::EnergyRelease, between(1.65, -3.6)),
        (Quantity::ContactRadius, 0.0),
    ] {
        let of = |table: &InterpolatedTable| table.estimate(quantity, 0.1 * RADIUS, 7.0, 10.0).unwrap();
        assert!((exponent(of(&rated), of(&plain)) - mean).abs() < 1e-9, "{quantity:?}");
    }
    assert_eq!(rated.radius_uncertainty(RADIUS), 0.0);
    assert!(rated.radius_uncertainty(0.1 * RADIUS) > change.ln());
    // At its own radius the table is as it was; below its first row the strength is that at the strain rate there.
    let own = |table: &InterpolatedTable, interference| {
        table.response(RADIUS, interference, 1.0, 1e-7).unwrap().friction.value
    };
    assert_eq!(own(&rated, 7.0), own(&plain, 7.0));
    let (first, here) = (plain.axes().interference[0], 0.01);
    let growth = |interference| {
        let omega = interference * plain.metadata().critical_interference;
        1.0 + C * (1.0 / hertz::contact_radius(RADIUS, omega)).ln()
    };
    let expected = growth(here) / growth(first).powf((here / first).sqrt());
    let end =
        |table: &InterpolatedTable| table.estimate(Quantity::Friction, RADIUS, here, 1.0).unwrap().value;
    assert!((end(&rated) / end(&plain) / expected - 1.0).abs() < 1e-12);
}

/// Where the contact forms at the strain rate of the slide, another radius is another strength in press and slide: at a power
/// m of the interference a quantity of the unit σ_Yⁿ changes as the power n − 2m of the strength.
#[test]
fn at_other_radii_contacts_that_form_while_they_slide_are_similar() {
    const C: f64 = 0.02;
    let of_press = |distance: Option<f64>| {
        let mut slice = slice_of(Log.range(0.5, 100.0, 8), Log.range(0.1, 10.0, 5));
        let metadata = slice.metadata_mut();
        (metadata.rate_coefficient, metadata.rate_reference) = (Some(C), Some(1.0));
        metadata.press_slip_distance = distance;
        slice.interpolated()
    };
    let [still, similar] = [None, Some(1.0)].map(of_press);
    let middle = 50f64.sqrt() * still.metadata().critical_interference;
    let contact = hertz::contact_radius(RADIUS, middle);
    let strength = |strain_rate: f64| 1.0 + C * strain_rate.ln();
    let factor = strength(100.0 / contact) / strength(1.0 / contact);
    assert!(factor > 1.05, "{factor}");
    let omega = 7.0;
    for quantity in [Quantity::Load, Quantity::Area, Quantity::ContactRadius, Quantity::Friction] {
        let at = |omega: f64, rate: f64| still.estimate(quantity, RADIUS, omega, rate).unwrap();
        let found = similar.estimate(quantity, 0.1 * RADIUS, omega, 10.0).unwrap();
        let table = at(omega / factor.powi(2), factor.powi(2));
        let descriptor = quantity.descriptor();
        let unit = factor.powi(descriptor.material_exponents.0) * 0.1f64.powi(descriptor.radius_exponent);
        assert!(relative(found.value, unit * table.value) < 1e-12, "{quantity:?}");
        let wider = found.error / found.value - table.error / table.value;
        let share = if quantity == Quantity::Friction { 0.6 } else { 0.3 };
        assert!((wider - share * factor.ln()).abs() < 1e-9, "{quantity:?} {wider}");
        // At its own radius the table is as it was.
        assert_eq!(similar.estimate(quantity, RADIUS, omega, 1.0).unwrap(), at(omega, 1.0));
    }
    let slip = 1e-6;
    let here = similar.response(0.1 * RADIUS, omega, 10.0, 0.1 * factor * slip).unwrap();
    let there = still.response(RADIUS, omega / factor.powi(2), factor.powi(2), slip).unwrap();
    assert!(relative(here.friction.value, 0.01 * factor.powi(3) * there.friction.value) < 1e-12);
    assert!(relative(here.temperature_max.value, there.temperature_max.value) < 1e-12);
    let fixed = similar.at_slip_rate(0.1 * RADIUS, 10.0).unwrap()(omega, 0.1 * factor * slip).unwrap();
    assert!(relative(fixed.load.value, here.load.value) < 1e-3);
    // A film does not follow the strength of the metal.
    let mut film = similar.clone().into_slice();
    let metadata = film.metadata_mut();
    (metadata.film_strength, metadata.pressure_coefficient) = (Some(1e8), Some(0.1));
    let wider =
        film.interpolated().radius_uncertainty(0.1 * RADIUS) - similar.radius_uncertainty(0.1 * RADIUS);
    assert!(wider > 0.9 * factor.ln(), "{wider}");
    assert!(similar.radius_uncertainty(0.1 * RADIUS) >= 0.6 * factor.ln() - 1e-9);
    assert_eq!(similar.radius_uncertainty(RADIUS), 0.0);
}

#[test]
fn fixed_slip_rate_gives_the_same_response() {
    let table = table();
    for (radius, rate) in [(RADIUS, 0.7), (RADIUS, 0.0), (RADIUS, 0.05), (2.0 * RADIUS, 5.0)] {
        let fixed = table.at_slip_rate(radius, rate).unwrap();
        for omega in Log.range(0.01, 100.0, 23) {
            for slip in [0.0, 1e-8, 3e-7, 4e-5, 1e-2] {
                let general = table.response(radius, omega, rate, slip).unwrap();
                let here = fixed(omega, slip).unwrap();
                // The order of interpolation along slip and slip rate differs.
                let distance = (here.friction.value - general.friction.value).abs();
                let allowed = 1e-9 * general.friction.value + 0.5 * general.friction.error;
                assert!(distance <= allowed, "{omega} {rate} {slip}: {distance} {allowed}");
                assert!((here.load.value - general.load.value).abs() <= 1e-3 * here.load.value);
                let errors = here.friction.error / general.friction.error;
                assert!(slip == 0.0 || (0.7..1.4).contains(&errors), "{omega} {slip} {errors}");
            }
        }
        assert!(fixed(1.01 * table.contact_limit(), 0.0).is_err());
    }
    assert!(table.at_slip_rate(RADIUS, 11.0).is_err());
}

/// d ln μ / d ln V at 7 ω_c by differences over a ten-thousandth.
fn friction_slope(table: &InterpolatedTable, rate: f64) -> f64 {
    let mu = |rate: f64| {
        let state = table.response(RADIUS, 7.0, rate, 1e-5).unwrap();
        (state.friction.value / state.load.value).ln()
    };
    let step: f64 = 5e-5;
    (mu(rate * step.exp()) - mu(rate * (-step).exp())) / (2.0 * step)
}

#[test]
fn slope_of_friction_against_slip_rate_is_continuous_across_the_points() {
    let table = table();
    let mut largest: f64 = 0.0;
    for rate in &table.axes().slip_rate[1..5] {
        let (before, after) = (friction_slope(&table, rate * 0.999), friction_slope(&table, rate * 1.001));
        largest = largest.max((before - after).abs());
    }
    // The curvature of ln μ over 0.2 % of V; a kink would show as a jump of the slope, which is
    // about −0.3 here.
    assert!(largest < 2e-3, "{largest}");
    let slopes = Log.range(0.1, 9.9, 200).into_iter().map(|rate| friction_slope(&table, rate));
    assert!(slopes.clone().fold(0.0, f64::min) < -0.3 && slopes.fold(-1.0, f64::max) < 0.0);
}

#[test]
fn monotone_points_give_a_monotone_friction() {
    let table = table();
    for omega in [0.2, 0.7, 7.0, 60.0] {
        let mut last = f64::INFINITY;
        for rate in std::iter::once(0.0).chain(Log.range(1e-3, 10.0, 300)) {
            let state = table.response(RADIUS, omega, rate, 1e-4).unwrap();
            let mu = state.friction.value / state.load.value;
            assert!(mu < last, "{omega} {rate}");
            last = mu;
        }
    }
}

/// The isothermal slide of a table is at the initial temperature but for the last digit.
#[test]
fn a_rounded_initial_temperature_is_no_rise() {
    let (clean, places) = (table(), 0..table().axes().slip.len());
    let rounded = changed(|slice| {
        for row in 0..slice.shape().0 {
            let cell = slice.cell(row, 0).unwrap().clone();
            let history = places.clone().map(|k| if k % 3 == 0 { BASE.next_up() } else { BASE }).collect();
            let cell = cell.with_history(Quantity::TemperatureMax, history);
            let cell = cell.with(Quantity::TemperatureMax, BASE.next_up(), 0.0);
            slice.set_cell(row, 0, cell).unwrap();
        }
    });
    for (omega, slip) in [(0.2, 1e-6), (7.0, 1e-5), (99.0, 1e-4), (300.0, 1e-4)] {
        let rise = |table: &InterpolatedTable| {
            let end = table.estimate(Quantity::TemperatureMax, RADIUS, omega, 0.03).unwrap();
            let now = table.at_slip_rate(RADIUS, 0.03).unwrap()(omega, slip).unwrap().temperature_max;
            [now, end].map(|found| (found.value - BASE, found.error))
        };
        assert_eq!(rise(&rounded), rise(&clean), "{omega}");
        assert!(rise(&clean)[0].0 > 1e-3, "{omega}");
    }
}

/// G of a cell is per area at inception.
#[test]
fn energy_is_that_of_the_area_at_inception() {
    let table = table();
    let (row, rate) = (3, 2);
    let cell = table.cell(row, rate).unwrap().clone();
    let a0 = cell[Quantity::ContactRadius].value;
    let slips = table.axes().slip.clone();
    let area = cell[Quantity::Area].value;
    let grown = slips.iter().map(|slip| area * (1.0 + 0.1 * slip)).collect();
    let cell = cell.with_history(Quantity::Area, grown).with(Quantity::InceptionSlip, 0.5 * a0, 0.0);
    let table = changed(|slice| slice.set_cell(row, rate, cell).unwrap());
    let (omega, rate) = (table.axes().interference[row], table.axes().slip_rate[rate]);
    let energy = table.energy_release(RADIUS, omega, rate).unwrap().unwrap();
    assert!(relative(energy.value, 1e-3 * a0 * 1.05 * area) < 1e-9, "{energy:?}");
}

/// Between V = 0 and the first slip rate, with one beyond; steeper and flatter rises are the limits of the law.
#[test]
fn a_rise_from_zero_is_that_of_a_moving_disc() {
    let read =
        |t: f64, values: f64| super::blend_one(1.0, t, [None, Some((4f64.ln(), 30.0 * values))], [0.0, 30.0]);
    for b in [0.0_f64, 0.3, 50.0] {
        let law = |v: f64| v * ((1.0 + b) / (1.0 + b * v)).sqrt();
        for t in [1e-6, 0.2, 0.7] {
            assert!((read(t, law(4.0)) / (30.0 * law(t)) - 1.0).abs() < 1e-12, "{b} {t}");
        }
    }
    assert!((read(0.25, 5.0) - 7.5).abs() < 1e-12 && (read(0.25, 1.2) - 15.0).abs() < 1e-12);
}

/// In the middle of an interval, of logarithms of the values.
#[test]
fn the_bend_does_not_vanish_at_an_inflection() {
    let middle = |logarithms: [f64; 4]| {
        let place = Location { index: 1, t: 0.5 };
        let (value, bend) =
            super::nodes::blend_with_bend(&[0.0, 1.0, 2.0, 3.0], place, |i| Ok(logarithms[i].exp())).unwrap();
        let straight = 0.5 * (logarithms[1] + logarithms[2]);
        (value.ln() - straight, bend / value)
    };
    // A power law, a curve of one sign, and one that turns over at the place.
    let (off, bend) = middle([0.0, 1.0, 2.0, 3.0]);
    assert!(off.abs() < 1e-14 && bend.abs() < 1e-14, "{off} {bend}");
    let (off, bend) = middle([0.0, 1.0, 1.8, 2.4]);
    assert!(off > 0.01 && (bend / off - 1.0).abs() < 1e-12, "{off} {bend}");
    let (off, bend) = middle([0.0, 0.2, 1.8, 2.0]);
    assert!(off.abs() < 1e-14 && bend > 0.2, "{off} {bend}");
}
