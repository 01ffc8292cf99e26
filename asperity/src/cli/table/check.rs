//! `asperity table check`: cells of a table computed again.

use asperity::scene::file::{Request, parse_request};
use asperity::tabulate::{Options, tabulate};
use rand::SeedableRng;
use rand::rngs::StdRng;
use rand::seq::index;
use serde_json::{Value, json};
use tables::interpolation::InterpolatedTable;
use tables::numbers::with_error;
use tables::quantity::{Descriptor, Estimate, Quantity};
use tables::table::comparison::{Comparison, Difference, OfKey};
use tables::table::{Axes, Cell, Slice};

use super::{CheckArguments, read};
use crate::progress::watched;
use crate::{Display, Failure, print};

/// Compute some cells again, or cells between the points; print how they compare, fail where a difference is beyond the
/// errors.
pub fn check(arguments: &CheckArguments, display: &Display) -> Result<(), Failure> {
    let table = read(&arguments.table, &arguments.at)?;
    let request = parse_request(&table.metadata().scene, &arguments.table, &[]).map_err(Failure::input)?;
    let positions = match arguments.between {
        true => table.between_points(),
        false => {
            let done = table.grid().filter(|&(i, j)| table.cell(i, j).is_some());
            done.map(|(i, j)| table.coordinates(i, j)).collect()
        }
    };
    if positions.is_empty() {
        let what = match arguments.between {
            true => "has a single interference or slip rate: there is nothing between its points",
            false => "has no cell that is done",
        };
        return Err(Failure::input(format!("{}: the table {what}", arguments.table)));
    }
    let mut random = StdRng::seed_from_u64(arguments.seed);
    let chosen =
        index::sample(&mut random, positions.len(), usize::from(arguments.cells).min(positions.len()));
    let (mut wrong, mut compared) = (Vec::new(), Vec::new());
    for position in chosen.into_iter().map(|k| positions[k]) {
        let expected = expected(&table, position, arguments.between)?;
        let again = computed_again(&expected, &request, display)?;
        let comparison = expected.compare(&again);
        let label = expected.label(0, 0);
        if !display.quiet && !display.json {
            let values = differing(&expected, &again, &comparison);
            print(&format!("{}: {label}: {}\n{values}", arguments.table, in_words(&comparison)))?;
        }
        compared.push(as_json(&expected, &again, &comparison));
        let states =
            comparison.states.iter().map(|OfKey { key, here, there }| format!("{key}: {here} and {there}"));
        let what: Vec<String> = states.chain(beyond(&comparison).map(str::to_owned)).collect();
        if !what.is_empty() {
            wrong.push(format!("{label}: {}", what.join(", ")));
        }
    }
    if display.json {
        print(&format!("{:#}\n", json!({ "table": arguments.table, "cells": compared })))?;
    }
    match wrong.is_empty() {
        true => Ok(()),
        false => Err(Failure::Run(format!(
            "{}: cells differ by more than their errors: {}",
            arguments.table,
            wrong.join("; ")
        ))),
    }
}

/// A table of one cell: what the table has at an interference and slip rate, or is read there.
fn expected(
    table: &InterpolatedTable,
    (interference, slip_rate): (f64, f64),
    read: bool,
) -> Result<Slice, Failure> {
    let axes = Axes {
        interference: vec![interference],
        slip_rate: vec![slip_rate],
        slip: table.axes().slip.clone(),
    };
    let mut only = table.regridded(axes).map_err(Failure::run)?;
    if read {
        let radius = table.metadata().asperity_radius;
        let mut cell = Cell::new();
        for quantity in Quantity::SCALARS.into_iter().filter(|quantity| table.holds(*quantity)) {
            let estimate = table.estimate(quantity, radius, interference, slip_rate);
            cell[quantity] = estimate.map_err(Failure::run)?;
        }
        only.set_cell(0, 0, cell).map_err(Failure::run)?;
    }
    Ok(only)
}

/// Names of the quantities that differ by more than both errors together.
fn beyond(comparison: &Comparison) -> impl Iterator<Item = &'static str> {
    let beyond = comparison.quantities.iter().filter(|difference| difference.beyond_errors > 0);
    beyond.map(|difference| difference.quantity.descriptor().name)
}

fn in_words(comparison: &Comparison) -> String {
    comparison.largest().map_or("the same to the last digit".into(), |difference| {
        let name = difference.quantity.descriptor().name;
        format!("largest difference {:.2e} of {name}", difference.largest)
    })
}

/// A line for each quantity that differs: value and error of the table, and those of the run.
fn differing(expected: &Slice, again: &Slice, comparison: &Comparison) -> String {
    let line = |difference: &Difference| {
        let quantity = difference.quantity;
        let Descriptor { name, units, .. } = *quantity.descriptor();
        let [table, run] = [expected, again]
            .map(|slice| slice.cell(0, 0).map_or("none".into(), |cell| with_error(cell[quantity], units)));
        format!("  {name:<18} {table}, computed again {run}\n")
    };
    comparison.quantities.iter().map(line).collect()
}

fn as_json(expected: &Slice, again: &Slice, comparison: &Comparison) -> Value {
    let (interference, slip_rate) = expected.coordinates(0, 0);
    let values = |slice: &Slice, quantity: Quantity| {
        let Estimate { value, error } = slice.cell(0, 0)?[quantity];
        value.is_finite().then_some([value, error])
    };
    let both = |quantity: Quantity| {
        let (here, there) = (values(expected, quantity)?, values(again, quantity)?);
        Some((quantity.descriptor().name, json!({ "table": here, "again": there })))
    };
    let largest = comparison.largest();
    json!({
        "interference": interference,
        "slip_rate": slip_rate,
        "quantity": largest.map(|difference| difference.quantity.descriptor().name),
        "largest": largest.map_or(0.0, |difference| difference.largest),
        "beyond_errors": beyond(comparison).collect::<Vec<_>>(),
        "values": Quantity::SCALARS.into_iter().filter_map(both).collect::<Value>(),
    })
}

/// The table of one cell, from a run.
fn computed_again(only: &Slice, request: &Request, display: &Display) -> Result<Slice, Failure> {
    let request = Request {
        interferences: only.axes().interference.clone(),
        slip_rates: only.axes().slip_rate.clone(),
        goal: None,
        ..match request.temperatures.is_empty() {
            true => request.clone(),
            false => request.at_temperature(only.metadata().temperature),
        }
    };
    let folder = tempfile::tempdir().map_err(Failure::run)?;
    let journal = folder.path().join("check.part");
    let options = Options { jobs: crate::processors(), journal: &journal, resume: false, shard: None };
    let result = watched(display, |progress| tabulate(&request, &options, progress));
    let (tabulation, _) = result.map_err(Failure::run)?;
    let again = tabulation.table(String::new()).map_err(Failure::run)?;
    if !tabulation.finished() {
        return Err(Failure::Run("stopped on request".into()));
    }
    again.only().cloned().map_err(Failure::run)
}
