//! `asperity table check`: cells of a table computed again.

use asperity::scene::file::{Request, parse_request};
use asperity::tabulate::{Options, tabulate};
use rand::SeedableRng;
use rand::rngs::StdRng;
use rand::seq::index;
use serde_json::json;
use tables::table::Slice;

use super::{CheckArguments, read};
use crate::progress::{Progress, watch_for_interrupt};
use crate::{Display, Failure, print};

/// Compute some cells again, print how they compare, fail where a difference is beyond the errors.
pub fn check(arguments: &CheckArguments, display: &Display) -> Result<(), Failure> {
    let table = read(&arguments.table, &arguments.at)?;
    let request = parse_request(&table.metadata().scene, &arguments.table, &[]).map_err(Failure::input)?;
    let (rows, columns) = table.shape();
    let cells = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j)));
    let done: Vec<_> = cells.filter(|&(i, j)| table.cell(i, j).is_some()).collect();
    let mut random = StdRng::seed_from_u64(arguments.seed);
    let chosen = index::sample(&mut random, done.len(), usize::from(arguments.cells).min(done.len()));
    watch_for_interrupt();
    let (mut wrong, mut compared) = (Vec::new(), Vec::new());
    for (i, j) in chosen.into_iter().map(|k| done[k]) {
        let again = computed_again(&table, &request, (i, j), display)?;
        let comparison = table.compare(&again);
        let beyond = comparison.quantities.iter().filter(|difference| difference.beyond_errors > 0);
        let beyond: Vec<_> = beyond.map(|difference| difference.quantity.descriptor().name).collect();
        let largest = comparison.quantities.iter().max_by(|a, b| a.largest.total_cmp(&b.largest));
        let difference = largest.map_or("the same to the last digit".into(), |difference| {
            let name = difference.quantity.descriptor().name;
            format!("largest difference {:.2e} of {name}", difference.largest)
        });
        if !display.quiet && !display.json {
            print(&format!("{}: {}: {difference}\n", arguments.table, table.label(i, j)))?;
        }
        let (interference, slip_rate) = table.coordinates(i, j);
        compared.push(json!({
            "interference": interference,
            "slip_rate": slip_rate,
            "quantity": largest.map(|difference| difference.quantity.descriptor().name),
            "largest": largest.map_or(0.0, |difference| difference.largest),
            "beyond_errors": beyond,
        }));
        let states = comparison.states.iter().map(|(_, here, there)| format!("{here} and {there}"));
        let what: Vec<String> = states.chain(beyond.into_iter().map(str::to_owned)).collect();
        if !what.is_empty() {
            wrong.push(format!("{}: {}", table.label(i, j), what.join(", ")));
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

/// A table of one cell.
fn computed_again(
    table: &Slice,
    request: &Request,
    (i, j): (usize, usize),
    display: &Display,
) -> Result<Slice, Failure> {
    let axes = table.axes();
    let request = Request {
        interferences: vec![axes.interference[i]],
        slip_rates: vec![axes.slip_rate[j]],
        goal: None,
        ..match request.temperatures.is_empty() {
            true => request.clone(),
            false => request.at_temperature(table.metadata().temperature),
        }
    };
    let folder = tempfile::tempdir().map_err(Failure::run)?;
    let journal = folder.path().join("check.part");
    let options = Options { jobs: crate::processors(), journal: &journal, resume: false, shard: None };
    let progress = Progress::new(display);
    let result = tabulate(&request, &options, &progress);
    progress.clear();
    let (tabulation, _) = result.map_err(Failure::run)?;
    let again = tabulation.table(String::new()).map_err(Failure::run)?;
    if !tabulation.finished() {
        return Err(Failure::Run("stopped on request".into()));
    }
    again.only().cloned().map_err(Failure::run)
}
