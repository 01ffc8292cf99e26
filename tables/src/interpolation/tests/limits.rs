//! Below the first row, above the last, outside the table, and the errors of its points.

use super::*;
use crate::table::Cell;

#[test]
fn continuous_and_elastic_below_the_first_row() {
    let table = table();
    for (rate, slip) in [(0.0, 1e-9), (0.3, 1e-6), (10.0, 1e-4)] {
        let above = table.response(RADIUS, 0.5 * (1.0 + 1e-9), rate, slip).unwrap();
        let below = table.response(RADIUS, 0.5 * (1.0 - 1e-9), rate, slip).unwrap();
        assert!(relative(below.friction.value, above.friction.value) < 1e-6);
        assert!(relative(below.load.value, above.load.value) < 1e-6);
        assert!(relative(below.area.value, above.area.value) < 1e-6);
        let (t_below, t_above) = (below.temperature_max.value, above.temperature_max.value);
        assert!((t_below - t_above).abs() < 1e-4);
    }
    // Deep below, τ = τ_c(T₀) whatever the slip rate, and P is Hertz's times the change with slip in the row.
    let omega = 1e-9;
    let small = table.response(RADIUS, omega, 10.0, 1e-3).unwrap();
    let strength = small.friction.value / small.area.value;
    assert!(relative(strength, STEEL.shear_strength()) < 1e-4);
    let contact_radius = hertz::contact_radius(RADIUS, omega * STEEL.critical_interference(RADIUS));
    let at_the_end = truth(omega, 0.0, 2.0 * contact_radius);
    assert!(relative(small.load.value, at_the_end.load.value) < 1e-4);
    // There the uncertainty by friction-induced uplift is as large as the load.
    assert!(small.load.error >= 0.99 * small.load.value);
    assert!((small.temperature_max.value - BASE).abs() < 0.1);
    let none = table.response(RADIUS, 0.0, 1.0, 0.0).unwrap();
    assert_eq!((none.load.value, none.friction.value), (0.0, 0.0));
}

#[test]
fn last_slip_is_held() {
    let table = table();
    let end = table.response(RADIUS, 7.0, 1.0, 1e-2).unwrap();
    let later = table.response(RADIUS, 7.0, 1.0, f64::INFINITY).unwrap();
    assert_eq!((end.friction.value, end.load.value), (later.friction.value, later.load.value));
    // To a given slip the law goes on: 2.5 times as far here.
    let contact_radius = (later.area.value / std::f64::consts::PI).sqrt();
    let farther = table.response(RADIUS, 7.0, 1.0, 5.0 * contact_radius).unwrap();
    let truth = truth(7.0, 1.0, 5.0 * contact_radius);
    for (found, last, truth) in [
        (farther.temperature_max, later.temperature_max, truth.temperature_max),
        (farther.friction, later.friction, truth.friction),
        (farther.load, later.load, truth.load),
    ] {
        let missing = (found.value - truth.value).abs();
        assert_eq!(found.value, last.value);
        assert!(
            missing > 0.0 && found.error > missing && found.error < last.error + 4.0 * missing,
            "{found:?} {truth:?}"
        );
    }
}

#[test]
fn outside_and_missing_are_refused_with_their_reason() {
    let table = table();
    let lookup = |table: &InterpolatedTable, omega, rate| table.response(RADIUS, omega, rate, 1e-6);
    let end = table.contact_limit();
    assert!(end > 100.0 && lookup(&table, 0.999 * end, 10.0).is_ok());
    assert!(matches!(lookup(&table, 1.001 * end, 1.0), Err(LookupError::ContactTooLarge { .. })));
    assert!(matches!(lookup(&table, 1.0, 11.0), Err(LookupError::SlipRateOutside { .. })));
    let said = |slip_rate: f64| lookup(&table, 1.0, slip_rate).unwrap_err().to_string();
    assert!(said(11.0).ends_with("whose highest slip rate is 1.11 times as high"), "{}", said(11.0));
    // The limits change with the radius, which is rounded.
    assert!(lookup(&table, 1.0, 10.005).is_ok() && lookup(&table, 1.0, 10.02).is_err());
    let table = changed(|slice| slice.mark_failed(3, 2, "no convergence"));
    let omega = table.axes().interference[3];
    let message = lookup(&table, 1.01 * omega, 0.2).unwrap_err().to_string();
    assert!(message.ends_with("the run failed: no convergence"), "{message}");
    // A neighbour that is missing only makes the slopes one-sided.
    assert!(lookup(&table, 1.01 * omega, 5.0).is_ok());
    assert!(lookup(&table, 0.2, 0.2).is_ok());
}

/// Beside the third row no point of the first interval can be left out.
#[test]
fn beside_a_missing_point_the_error_of_interpolation_stays() {
    let table = changed(|slice| slice.mark_failed(2, 3, "no convergence"));
    let [interference, slip_rate] = [&table.axes().interference, &table.axes().slip_rate];
    let omega = (interference[0] * interference[1]).sqrt();
    let slip = 1.5 * (truth(omega, 0.0, 0.0).area.value / std::f64::consts::PI).sqrt();
    let here = table.response(RADIUS, omega, slip_rate[3], slip).unwrap();
    let there = truth(omega, slip_rate[3], slip);
    for (found, truth) in [(here.load, there.load), (here.area, there.area), (here.friction, there.friction)]
    {
        let missing = (found.value - truth.value).abs();
        assert!(missing > 0.0 && missing < found.error, "{found:?} {truth:?}");
    }
}

#[test]
fn scalars_below_the_first_row_are_elastic() {
    let table = table();
    let omega = 1e-7;
    let load = table.estimate(Quantity::Load, RADIUS, omega, 1.0).unwrap();
    let hertz =
        hertz::hertz_load(STEEL.contact_modulus(), RADIUS, omega * STEEL.critical_interference(RADIUS));
    // Of the load 1/15 is gone at the end of the slide, see `truth`.
    assert!(relative(load.value, hertz * 14.0 / 15.0) < 1e-3);
    let mu = table.estimate(Quantity::Mu, RADIUS, omega, 1.0).unwrap();
    assert!(relative(mu.value, 0.5370 / omega.sqrt() * 15.0 / 14.0) < 2e-3);
    let hot = table.estimate(Quantity::TemperatureMax, RADIUS, omega, 1.0);
    assert!((hot.unwrap().value - BASE).abs() < 0.1);
}

/// A film shears at its own strength under any load: Q/A stays, Q/P rises as P/A falls. The first row has 0.9 of the
/// pressure of Hertz, so that friction that depends on it is not exactly that of the sphere.
#[test]
fn a_film_shears_at_its_own_strength_below_the_first_row() {
    let film = 25e6;
    for (coefficient, tolerance) in [(0.0, 1e-12), (0.06, 0.01)] {
        let table = changed(|slice| {
            for (row, rate) in slice.grid().collect::<Vec<_>>() {
                let cell = slice.cell(row, rate).unwrap().clone();
                let [load, area] = [Quantity::Load, Quantity::Area].map(|quantity| cell[quantity].value);
                let friction = film * area + coefficient * load;
                let history = vec![friction; slice.axes().slip.len()];
                let cell = (cell.with(Quantity::Friction, friction, 0.0))
                    .with(Quantity::Mu, friction / load, 0.0)
                    .with_history(Quantity::Friction, history);
                slice.set_cell(row, rate, cell).unwrap();
            }
            let metadata = slice.metadata_mut();
            (metadata.film_strength, metadata.pressure_coefficient) = (Some(film), Some(coefficient));
            metadata.strength_factor = None;
        });
        for omega in [0.4, 0.1, 0.01] {
            let state = table.response(RADIUS, omega, 0.0, 1e-3).unwrap();
            let expected = film * state.area.value + coefficient * state.load.value;
            let off = relative(state.friction.value, expected);
            assert!(off < tolerance, "{coefficient}, {omega}: {off}");
            let mu = table.estimate(Quantity::Mu, RADIUS, omega, 0.0).unwrap();
            assert!(relative(mu.value, expected / state.load.value) < tolerance, "{omega}: {mu:?}");
        }
    }
}

#[test]
fn the_isothermal_limit_is_that_of_the_table() {
    let table = table();
    for omega in [0.01, 0.5, 7.0, 99.0] {
        let limit = table.response(RADIUS, omega, 0.0, 1e-4).unwrap().friction.value;
        let near = table.response(RADIUS, omega, 1e-9, 1e-4).unwrap().friction.value;
        assert!(relative(near, limit) < 1e-8, "{omega}");
    }
}

/// Errors before the contact slides are those of static friction.
#[test]
fn errors_go_from_those_of_static_friction_to_those_of_the_end() {
    let table = table();
    let (row, rate) = (3, 2);
    let cell = table.cell(row, rate).unwrap().clone();
    let a0 = cell[Quantity::ContactRadius].value;
    let friction = cell[Quantity::Friction].value;
    let cell =
        cell.with(Quantity::FrictionStatic, friction, 0.1 * friction).with(Quantity::InceptionSlip, a0, 0.0);
    let table = changed(|slice| slice.set_cell(row, rate, cell).unwrap());
    let (omega, rate) = (table.axes().interference[row], table.axes().slip_rate[rate]);
    for (slip, expected) in [(0.35, 0.1), (1.0, 0.1), (1.35, 0.072), (2.0, 0.02)] {
        let state = table.response(RADIUS, omega, rate, slip * a0).unwrap().friction;
        assert!((state.error / state.value - expected).abs() < 1e-6, "{slip}: {state:?}");
    }
}

/// Friction-induced uplift, with 1/ω from the first row on, and a share of the ratio of the row to Hertz.
#[test]
fn uncertainties_below_the_first_row_are_in_the_error() {
    let table = table();
    let at = |omega: f64| table.response(RADIUS, omega, 0.0, 1e-6).unwrap().load;
    let uncertainty = |omega: f64| at(omega).error / at(omega).value;
    for omega in [0.3, 0.1, 0.03] {
        let uplift = 0.003 * (1.0 / omega - 1.0 / 0.5);
        let hertz =
            hertz::hertz_load(STEEL.contact_modulus(), RADIUS, omega * STEEL.critical_interference(RADIUS));
        let of_ratio = 0.6 * (at(omega).value / hertz - 1.0).abs() * (1.0 - (omega / 0.5f64).sqrt());
        let (more, expected) = (uncertainty(omega) - uncertainty(0.5), uplift + of_ratio);
        assert!(of_ratio > 0.0 && (more - expected).abs() < 0.01 * expected, "{omega}: {more} {expected}");
    }
}

#[test]
fn errors_of_the_points_are_carried_along() {
    // 2 % in Q at the points, none in P: between and below the points it is no less, within the slides of the table.
    let table = table();
    for omega in [0.05, 0.3, 3.3, 42.0] {
        for rate in [0.0, 0.05, 0.4, 10.0] {
            let state = table.response(RADIUS, omega, rate, 1e-6).unwrap();
            let share = state.friction.error / state.friction.value;
            assert!((0.0199..0.3).contains(&share), "{omega} {rate}: {share}");
        }
    }
}

/// Power laws with the exponents of an ideal plastic body, and small contacts: they lie within the errors, which grow.
#[test]
fn power_laws_of_the_plastic_limit_lie_within_the_errors_above_the_last_row() {
    let state = |omega: f64| [3.0 * omega, 0.4 * omega, 1e-9 * omega];
    let axes =
        Axes { interference: vec![100.0, 200.0, 400.0], slip_rate: vec![1.0], slip: vec![0.0, 1.0, 2.0] };
    let metadata = Metadata { asperity_radius: 1.0, ..table().metadata().clone() };
    let cell = |omega: f64, _| {
        let mut cell = Cell::new().with(Quantity::ContactRadius, 1e-6 * omega.sqrt(), 0.0);
        for (quantity, value) in
            [Quantity::Load, Quantity::Friction, Quantity::Area].into_iter().zip(state(omega))
        {
            cell = cell.with(quantity, value, 0.01 * value).with_history(quantity, vec![value; 3]);
        }
        cell = cell.with(Quantity::Mu, 0.4 / 3.0, 0.004 / 3.0).with(Quantity::MuStatic, 0.3 / omega, 0.0);
        cell.with_history(Quantity::TemperatureMax, vec![BASE + omega.sqrt(); 3])
    };
    let plastic = Slice::filled(axes, metadata, cell).unwrap().interpolated();
    let mut last = 0.01;
    for omega in [400.0, 401.0, 1e3, 1e4] {
        let found = plastic.response(1.0, omega, 1.0, 1e-4).unwrap();
        for (found, expected) in [found.load, found.friction, found.area].into_iter().zip(state(omega)) {
            assert!((found.value - expected).abs() <= found.error, "{omega}: {found:?} {expected}");
        }
        let error = found.area.error / found.area.value;
        assert!(error >= last && error < 0.3, "{omega}: {error} after {last}");
        last = error;
        let estimate = |quantity| plastic.estimate(quantity, 1.0, omega, 1.0).unwrap();
        let mu = estimate(Quantity::Mu);
        assert!((mu.value - 0.4 / 3.0).abs() <= mu.error, "{omega}: {mu:?}");
        assert!(relative(mu.value, found.friction.value / found.load.value) < 1e-9);
        assert!(relative(estimate(Quantity::Friction).value, found.friction.value) < 1e-9);
        assert!(relative(estimate(Quantity::ContactRadius).value, 1e-6 * omega.sqrt()) < 1e-9);
        // Its exponent of −1 relaxes to a small one.
        let relaxing = estimate(Quantity::MuStatic).value * (1.0 + 1e-10);
        assert!((0.3 / omega..=0.3 / 400.0 * (1.0 + 1e-9)).contains(&relaxing), "{omega}: {relaxing}");
    }
    // a = 0.4 R.
    assert!(relative(plastic.contact_limit(), (0.4f64 / 1e-6).powi(2)) < 1e-6);
}

#[test]
fn the_end_of_the_histories_is_a_break() {
    let table = table_of(Log.range(0.1, 50.0, 8), vec![0.1, 1.0]);
    for radius in [RADIUS, 0.1 * RADIUS] {
        // In the table and below it: a₀ is half the slip there, the histories end at s = 2 a₀.
        for interference in [0.01f64, 0.3, 20.0] {
            let area = table.response(radius, interference, 1.0, 0.0).unwrap().area.value;
            let slip = 2.0 * (area / std::f64::consts::PI).sqrt();
            let [found] = table.breaks_after(radius, slip)[..] else { panic!("{interference}") };
            // The area and a₀ are interpolated apart.
            assert!((found / interference - 1.0).abs() < 0.02, "{interference}: {found}");
            let friction = |interference: f64, slip: f64| {
                table.response(radius, interference, 1.0, slip).unwrap().friction.value
            };
            // Smaller contacts have the last value, larger ones still change.
            assert_eq!(friction(0.999 * found, slip), friction(0.999 * found, 1.001 * slip));
            assert_ne!(friction(1.001 * found, slip), friction(1.001 * found, 0.999 * slip));
        }
        assert!(table.breaks_after(radius, 0.0).is_empty());
        assert!(table.breaks_after(radius, 1.0).is_empty());
    }
}

/// Where heat was left out a cell states the rise with an error, and its history none.
#[test]
fn a_rise_without_a_history_has_that_of_the_next_slip_rate() {
    let mut whole = slice_of(Log.range(0.5, 100.0, 8), Log.range(0.1, 10.0, 5));
    let heated = whole.clone().interpolated();
    for row in 0..whole.shape().0 {
        let cell = whole.cell(row, 0).unwrap().clone();
        let rise = 0.09 * (whole.cell(row, 1).unwrap()[Quantity::TemperatureMax].value - BASE);
        let slips = whole.axes().slip.len();
        let cell = cell.with_history(Quantity::TemperatureMax, vec![BASE; slips]).with(
            Quantity::TemperatureMax,
            BASE + rise,
            rise,
        );
        whole.set_cell(row, 0, cell).unwrap();
    }
    let left_out = whole.interpolated();
    for (rate, allowed) in [(0.1, 0.8), (0.17, 0.65)] {
        for slip in [1e-6, 1e-3] {
            let at = |table: &InterpolatedTable| {
                table.at_slip_rate(RADIUS, rate).unwrap()(7.0, slip).unwrap().temperature_max
            };
            let (found, truth) = (at(&left_out), at(&heated).value);
            // 0.09 of the rise at a rate √10 times as large, in place of 0.32.
            assert!(found.value > BASE && found.value < truth, "{rate} {slip}: {found:?}");
            let share = (truth - found.value) / (truth - BASE);
            assert!(share < allowed && found.error > 0.4 * (found.value - BASE), "{rate} {slip}: {found:?}");
        }
    }
}

/// Slides of this table end at two contact radii.
#[test]
fn cells_that_end_in_stick_are_told_from_those_that_slide() {
    let table = changed(|slice| {
        let cell = slice.cell(3, 2).unwrap().clone();
        let end = 2.0 * cell[Quantity::ContactRadius].value;
        slice.set_cell(3, 2, cell.with(Quantity::InceptionSlip, end, 0.0)).unwrap();
    });
    let (omega, rate) = (table.axes().interference[3], table.axes().slip_rate[2]);
    let begins = |omega, rate| table.begins_to_slide(RADIUS, omega, rate).unwrap();
    assert!(!begins(omega, rate) && !begins(1.1 * omega, 0.9 * rate));
    assert!(begins(omega, 10.0) && begins(0.1, rate) && begins(200.0, rate) && begins(0.0, rate));
}

/// Slow rates, at which the rise is in proportion to the rate.
#[test]
fn a_rise_in_proportion_to_the_slip_rate_is_known_from_rest_on() {
    let table = table_of(Log.range(0.5, 100.0, 8), vec![0.0, 1e-4, 4e-4, 1e-3, 2.5e-3]);
    let omega = table.axes().interference[4];
    let a0 = (truth(omega, 0.0, 0.0).area.value / std::f64::consts::PI).sqrt();
    for rate in [2e-5, 5e-5, 9e-5, 2e-4] {
        let found = table.response(RADIUS, omega, rate, 0.5 * a0).unwrap().temperature_max;
        let (rise, exact) = (found.value - BASE, truth(omega, rate, 0.5 * a0).temperature_max.value - BASE);
        assert!(
            (rise - exact).abs() <= found.error + 1e-4 * rise && found.error < 0.02 * rise,
            "{rate}: {found:?} {exact}"
        );
    }
}

/// With one positive slip rate n₀ is the largest n at this rate, of the first row and of the own one.
#[test]
fn a_rise_below_the_only_slip_rate_is_known() {
    let table = table_of(Log.range(0.5, 100.0, 8), vec![0.0, 1e-4]);
    let omega = table.axes().interference[4];
    let scalar = table.estimate(Quantity::TemperatureMax, RADIUS, omega, 5e-5).unwrap();
    let end =
        table.axes().slip.last().unwrap() * (truth(omega, 0.0, 0.0).area.value / std::f64::consts::PI).sqrt();
    let response = table.response(RADIUS, omega, 5e-5, end).unwrap().temperature_max;
    let exact = truth(omega, 5e-5, end).temperature_max.value - BASE;
    for found in [scalar, response] {
        assert!((found.value - BASE - exact).abs() <= found.error + 1e-4 * exact, "{found:?} {exact}");
    }
}
