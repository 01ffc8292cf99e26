//! Refinement of tables of closed-form laws in place of simulations.

use super::*;
use crate::numbers::Spacing::Log;
use crate::table::{Cell, Metadata, Status};

const RADIUS: f64 = 1e-3;
const TEMPERATURE: f64 = 298.0;

/// μ, μ_s, Q and G of a law with what real ones have: power laws at both ends, a change of regime
/// about first yield, where G has a kink, weakening above a slip rate that falls with the contact radius.
fn law(omega: f64, rate: f64) -> [f64; 4] {
    let plastic = omega.powi(2) / (1.0 + omega.powi(2));
    let load = omega.powf(1.5) / (1.0 + 0.4 * plastic * omega.powf(0.3));
    let still = 0.54 / omega.sqrt() * (1.0 - plastic) + (0.2 + 0.1 / omega.sqrt()) * plastic;
    let weakening = 1.0 / (1.0 + (rate * omega.sqrt() / 30.0).powi(2)).powf(0.3);
    let mu = 0.98 * still * weakening;
    let exponent = if omega < 0.9 { 1.1 } else { 0.7 };
    [mu, still, mu * load, 4.0 * (omega / 0.9).powf(exponent)]
}

/// Fills every point that is not run, without error of its own.
fn evaluate(mut table: Slice) -> Slice {
    for (i, j) in table.missing() {
        let (omega, rate) = table.coordinates(i, j);
        let values = law(omega, rate);
        let mut cell = Cell::new().with(Quantity::ContactRadius, 1e-5 * omega.sqrt(), 0.0);
        for (quantity, value) in JUDGED.into_iter().zip(values) {
            cell = cell.with(quantity, value, 0.0);
        }
        let held = |value: f64| vec![value; table.axes().slip.len()];
        for (quantity, value) in [
            (Quantity::Load, values[2] / values[0]),
            (Quantity::Friction, values[2]),
            (Quantity::Area, omega),
        ] {
            cell = cell.with(quantity, value, 0.0).with_history(quantity, held(value));
        }
        table.set_cell(i, j, cell).unwrap();
    }
    table
}

fn start(interference: Vec<f64>, slip_rate: Vec<f64>) -> Slice {
    let metadata = Metadata {
        asperity_radius: RADIUS,
        critical_interference: 1e-7,
        contact_modulus: 2e11,
        poisson_ratio: 0.3,
        yield_strength: 4e8,
        strength_factor: Some(1.0),
        temperature: TEMPERATURE,
        ..Metadata::default()
    };
    Slice::new(Axes { interference, slip_rate, slip: vec![0.0, 1.0] }, metadata).unwrap()
}

/// Computes missing points by `evaluate` and adds points, in turn.
fn refine(mut table: Slice, goal: &Goal, mut evaluate: impl FnMut(Slice) -> Slice) -> Slice {
    loop {
        table = evaluate(table);
        let Some(axes) = goal.next_axes(&table) else { return table };
        table = table.regridded(axes).unwrap();
    }
}

fn refined(tolerance: f64, most_cells: usize) -> (Slice, usize) {
    let mut runs = 0;
    let table = start(vec![0.1, 3.0, 100.0], vec![0.01, 0.3, 10.0]);
    let table = refine(table, &Goal { tolerance, most_cells }, |table| {
        runs += table.missing().len();
        evaluate(table)
    });
    (table, runs)
}

/// Largest relative error between the points, over what is allowed for the quantity, on a fine grid that is independent of the points of the table, and
/// the coverage: the share of values whose error estimate covers the true error.
fn actual(slice: &Slice) -> (f64, f64) {
    let table = slice.clone().interpolated();
    let (mut worst, mut covered, mut asked) = (0.0_f64, 0, 0);
    for omega in Log.range(0.1, 100.0, 97) {
        for rate in Log.range(0.01, 10.0, 61) {
            for (quantity, truth) in JUDGED.into_iter().zip(law(omega, rate)) {
                let estimate = table.estimate(quantity, RADIUS, omega, rate).unwrap();
                let error = (estimate.value / truth - 1.0).abs();
                worst = worst.max(error / quantity.allowance());
                asked += 1;
                covered += usize::from(error * truth <= estimate.error + 1e-9 * truth);
            }
        }
    }
    (worst, covered as f64 / asked as f64)
}

#[test]
fn interpolates_within_the_tolerance_for_less_runs_than_a_regular_grid() {
    for tolerance in [0.05, 0.02, 0.01] {
        let (table, runs) = refined(tolerance, 100_000);
        let (rows, columns) = table.shape();
        // Every point was computed once.
        assert_eq!(runs, rows * columns);
        let (worst, _) = actual(&table);
        // The smallest regular grid, of any shape, that does as well.
        let mut shapes: Vec<(usize, usize)> =
            (5..20).flat_map(|rows| (5..20).map(move |columns| (rows, columns))).collect();
        shapes.sort_by_key(|(rows, columns)| rows * columns);
        let regular = shapes.into_iter().find(|(rows, columns)| {
            let table = start(Log.range(0.1, 100.0, *rows), Log.range(0.01, 10.0, *columns));
            actual(&evaluate(table)).0 <= worst
        });
        println!(
            "tolerance {tolerance}: {runs} runs ({rows} x {columns}), error {worst:.4}; regular {regular:?}"
        );
        assert!(worst <= tolerance, "{tolerance}: {worst}");
        let regular = regular.expect("shapes up to 20 x 20 suffice");
        assert!(runs < regular.0 * regular.1, "{tolerance}: {runs}, {regular:?}");
    }
}

#[test]
fn errors_cover_what_interpolation_does() {
    let (table, _) = refined(0.02, 100_000);
    let table = table.with_interpolation_errors(0.02);
    let (_, covered) = actual(&table);
    assert!(covered > 0.97, "{covered}");
    // They are part of the errors of the cells, and within the tolerance.
    let mut largest: f64 = 0.0;
    for (i, j) in table.grid() {
        for quantity in JUDGED {
            let estimate = table.cell(i, j).unwrap()[quantity];
            largest = largest.max(estimate.error / estimate.value);
        }
    }
    // That of G is 2.5 times that of the others.
    assert!(largest > 0.002 && largest <= 2.5 * 0.02, "{largest}");
    assert_eq!(table.metadata().interpolation_tolerance, Some(0.02));
}

#[test]
fn power_laws_need_no_more_points() {
    let mut table = start(vec![0.1, 1.0, 10.0], vec![0.1, 1.0, 10.0]);
    for (i, j) in table.missing() {
        let (omega, rate) = table.coordinates(i, j);
        let mut cell = Cell::new().with(Quantity::ContactRadius, 1e-5, 0.0);
        // G is expected to have a kink.
        for quantity in JUDGED.into_iter().filter(|quantity| *quantity != Quantity::EnergyRelease) {
            let value = 3.0 * omega.powf(0.7) * rate.powf(-0.2);
            cell = cell.with(quantity, value, 0.03 * value);
        }
        for quantity in [Quantity::Load, Quantity::Friction, Quantity::Area] {
            cell = cell.with_history(quantity, vec![1.0, 1.0]);
        }
        table.set_cell(i, j, cell).unwrap();
    }
    let goal = Goal { tolerance: 1e-6, most_cells: 1000 };
    assert_eq!(goal.next_axes(&table), None);
    assert!(table.cross_validation().worst(Quantity::Mu).error < 1e-9);
    // Half-way the errors of four points are their mean, and the value is their geometric mean.
    let half = 0.5 * 10f64.ln();
    let exact = 0.03 * (0.7 * half).cosh() * (0.2 * half).cosh();
    let mu = table.error_statistics().into_iter().find(|found| found.quantity == Quantity::Mu).unwrap();
    assert!(mu.between.unwrap().iter().all(|error| (error / exact - 1.0).abs() < 1e-9), "{mu:?} {exact}");
}

#[test]
fn stops_where_the_grid_is_full() {
    let (table, runs) = refined(1e-4, 60);
    assert!(runs <= 60 && runs > 40, "{runs}");
    let worst = JUDGED.map(|quantity| table.cross_validation().worst(quantity).error);
    assert!(worst.into_iter().fold(0.0, f64::max) > 1e-4);
}

#[test]
fn two_points_say_nothing_and_one_point_needs_no_neighbour() {
    let table = evaluate(start(vec![1.0, 10.0], vec![1.0]));
    assert_eq!(table.cross_validation().worst(Quantity::Mu).error, f64::INFINITY);
    let goal = Goal { tolerance: 0.02, most_cells: 1000 };
    let axes = goal.next_axes(&table).unwrap();
    assert_eq!(axes.interference, [1.0, 3.16, 10.0]);
    assert_eq!(axes.slip_rate, [1.0]);
    let table = evaluate(start(vec![1.0], vec![1.0]));
    assert_eq!(goal.next_axes(&table), None);
}

#[test]
fn scatter_that_the_points_own_up_to_is_not_chased() {
    let noisy = |table: Slice| {
        let mut table = evaluate(table);
        for (i, j) in table.grid() {
            let mut cell = table.cell(i, j).unwrap().clone();
            let (omega, rate) = table.coordinates(i, j);
            let scatter = 0.02 * (1e4 * (omega.ln() + 1.7 * rate.ln()).sin()).sin();
            for (quantity, value) in JUDGED.into_iter().zip(law(omega, rate)) {
                cell = cell.with(quantity, value * (1.0 + scatter), 0.03 * value);
            }
            table.set_cell(i, j, cell).unwrap();
        }
        table
    };
    let goal = Goal { tolerance: 0.005, most_cells: 100_000 };
    let table = refine(start(vec![0.1, 3.0, 100.0], vec![1.0]), &goal, noisy);
    // Down to a factor of 1.5 a point: 17 and the halving of that.
    assert!(table.shape().0 < 50, "{:?}", table.shape());
}

#[test]
fn failed_points_are_passed_over() {
    let goal = Goal { tolerance: 0.02, most_cells: 10_000 };
    let failing = |table: Slice| {
        let mut table = evaluate(table);
        table.mark_failed(1, 1, "no convergence");
        table
    };
    let table = refine(start(vec![0.1, 3.0, 100.0], vec![0.01, 0.3, 10.0]), &goal, failing);
    assert!(matches!(table.status(1, 1), Status::Failed(_)));
    assert!(table.shape().0 > 3 && table.shape().1 > 3);
}

#[test]
fn new_points_are_short_numbers_between_the_old() {
    assert_eq!(middle(0.1, 100.0), 3.16);
    assert_eq!(middle(0.0, 0.5), 0.25);
    let close = middle(1.0, 1.02);
    assert!(1.0 < close && close < 1.02);
}
