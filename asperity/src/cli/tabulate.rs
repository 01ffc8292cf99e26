//! `asperity tabulate`: a grid of runs, one table.

use std::path::Path;
use std::time::Instant;

use asperity::output::provenance;
use asperity::scene::file::{Request, read_request};
use asperity::simulate::outcome::Note;
use asperity::solver::timings::{Kernel, Timings};
use asperity::tabulate::{self, Journal, Options, TabulateError, Tabulation};
use serde_json::{Value, json};
use tables::figures::{TABLE_PANELS, table_panels};
use tables::netcdf::JOURNAL_ROLE;
use tables::netcdf::streams::say;
use tables::numbers;
use tables::quantity::Quantity;
use tables::table::{LABEL_DIGITS, Slice, Table};

use super::progress::watched;
use super::{Display, Failure, TabulateArguments, command_line, outputs, timings};

/// Run the missing cells of the request, write the table, print a summary.
pub fn tabulate(arguments: &TabulateArguments, display: &Display) -> Result<(), Failure> {
    let request = read_request(&arguments.request, &arguments.set).map_err(Failure::input)?;
    display.with_implausible(|| request.implausible(), tabulate_request(&request, arguments, display))
}

fn tabulate_request(
    request: &Request,
    arguments: &TabulateArguments,
    display: &Display,
) -> Result<(), Failure> {
    let journal = Journal::beside(&arguments.output);
    check_outputs(arguments, &request.temperatures, &journal)?;
    // Refinement adds points, and with them maps.
    let panels = match request.goal {
        Some(_) => TABLE_PANELS.to_vec(),
        None => table_panels(request.interferences.len(), &request.slip_rates),
    };
    outputs::check_panels(&arguments.figure.panel, &panels)?;
    display.printer().warn(request.remarks());
    if display.verbose {
        say(format!("note: {}", Note::of_scene(&request.template)));
    }
    warn_of_replaced(request, arguments, &journal, display);
    if arguments.resume
        && let Some(table) =
            tabulate::completed(request, arguments.shard, &arguments.output).map_err(Failure::input)?
    {
        return report_complete(&table, arguments, display);
    }
    let options = Options {
        jobs: arguments.jobs.map_or_else(super::processors, usize::from),
        journal: &journal,
        resume: arguments.resume,
        shard: arguments.shard,
    };
    let result = watched(display, |progress| tabulate::tabulate(request, &options, progress));
    let (tabulation, journal) = result.map_err(|error| match error {
        TabulateError::Journal(ref fault) if fault.is_of_the_system() => match journal.exists() {
            true => {
                Failure::Run(format!("{error}; to continue with the finished cells: {}", resuming(arguments)))
            }
            false => Failure::run(error),
        },
        error => Failure::input(error),
    })?;
    if !tabulation.finished() {
        return Err(Failure::Run(format!(
            "stopped on request with {} of {} cells done; to continue: {}",
            tabulation.cells.len(),
            tabulation.wanted.len(),
            resuming(arguments),
        )));
    }
    let table = tabulation.table(provenance::history(&command_line())).map_err(Failure::run)?;
    let started = Instant::now();
    table.write(&arguments.output).map_err(|error| {
        let continued = resuming(arguments);
        Failure::Run(format!("{error}; the finished cells are kept in the journal; to continue: {continued}"))
    })?;
    let mut spent = tabulation.timings();
    spent.since(Kernel::Output, started);
    let removed = journal.remove().map_err(Failure::run);
    let drawn = outputs::plot(&table, &arguments.figure);
    Failure::all([removed, drawn, report(&tabulation, &table, &spent, arguments, display)])?;
    match tabulation.failures().count() {
        0 => Ok(()),
        failed => Err(Failure::Run(failure(failed, tabulation.wanted.len(), &arguments.output))),
    }
}

/// A warning where there is another file than the table of this request, and --resume does not refuse it.
fn warn_of_replaced(request: &Request, arguments: &TabulateArguments, journal: &Path, display: &Display) {
    if arguments.resume && !journal.exists() {
        return;
    }
    let Err(error) = tabulate::existing(request, arguments.shard, &arguments.output) else { return };
    display.printer().warn([match error {
        TabulateError::NoTable(error) => format!("{error}; the table replaces the file when it is done"),
        _ => format!(
            "{}: holds a table of another request, or another part of it, which this one replaces when it is done",
            arguments.output.display()
        ),
    }]);
}

/// Message: cells failed; the table is written nevertheless, with what it has.
fn failure(failed: usize, of: usize, output: &Path) -> String {
    let output = output.display();
    let reasons = format!("the reasons are in {output} (`asperity table info {output}`)");
    match (failed, of) {
        (1, 1) => format!("the only cell failed; {reasons}"),
        _ if failed == of => format!("all {of} cells failed; {reasons}"),
        _ => format!("{failed} of {of} cells failed; the others are in {output}"),
    }
}

fn check_outputs(arguments: &TabulateArguments, temperatures: &[f64], journal: &Path) -> Result<(), Failure> {
    let plots = outputs::plots(&arguments.figure.plot, temperatures);
    let mut written = outputs::with_plots(&arguments.output, &plots);
    written.push((JOURNAL_ROLE, journal));
    outputs::check_with_table(&[("the request", &arguments.request)], &written)
}

/// With --resume there is nothing to do.
fn report_complete(table: &Table, arguments: &TabulateArguments, display: &Display) -> Result<(), Failure> {
    let output = arguments.output.display().to_string();
    let failed = table.failures().len();
    display.printer().warn((!tabulate::is_of_this_build(table)).then(|| {
        format!("{output}: made by another build of the program; to make the table anew leave out --resume")
    }));
    let json = || as_json(table, &output);
    let text = || format!("{output}: the table of this request is complete, nothing was computed\n");
    let printed = display.printer().print(json, text);
    outputs::plot(table, &arguments.figure)?;
    printed?;
    match failed {
        0 => Ok(()),
        failed => Err(Failure::Run(format!(
            "{failed} cells of {output} failed (`asperity table info {output}`); \
             to compute the table again leave out --resume"
        ))),
    }
}

/// The command that continues where the present one stopped.
fn resuming(arguments: &TabulateArguments) -> String {
    let again = if arguments.resume { "" } else { " --resume" };
    let input = if arguments.request == Path::new("-") { " < REQUEST" } else { "" };
    format!("{}{again}{input}", command_line())
}

fn report(
    tabulation: &Tabulation,
    table: &Table,
    spent: &Timings,
    arguments: &TabulateArguments,
    display: &Display,
) -> Result<(), Failure> {
    display.printer().warn(tabulation.warnings());
    if !display.quiet {
        for (index, reason) in tabulation.failures() {
            say(format!("failed: {}: {reason}", tabulation.label(index)));
        }
    }
    if display.verbose {
        if arguments.resume {
            say(format!("{} cells were taken from the journal", tabulation.resumed));
        }
        for (index, finished) in tabulation.done() {
            for note in &finished.notes {
                say(format!("note: {}: {note}", tabulation.label(index)));
            }
        }
    }
    if arguments.timings && !display.json {
        say(timings::as_text(spent).trim_end());
    }
    let json = || {
        let mut json = as_json(table, &arguments.output.display().to_string());
        if arguments.timings {
            json["timings"] = timings::as_json(spent);
        }
        json
    };
    display.printer().print(json, || summary(tabulation))
}

/// One line per cell.
fn summary(tabulation: &Tabulation) -> String {
    let header = ["temperature", "interference", "slip_rate", "mu_static", "mu", "P_press", "area"];
    let header = &header[usize::from(tabulation.request.temperatures.is_empty())..];
    let mut rows = vec![header.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>()];
    for (i, j) in tabulation.grid() {
        let (temperature, interference) = tabulation.row(i);
        let mut line: Vec<String> = Vec::new();
        line.extend(temperature.map(|temperature| format!("{} K", numbers::plain(temperature))));
        line.push(format!("{} omega_c", numbers::digits(interference, LABEL_DIGITS)));
        line.push(format!("{} m/s", numbers::digits(tabulation.axes.slip_rate[j], LABEL_DIGITS)));
        match tabulation.cells.get(&(i, j)) {
            Some(Ok(finished)) => line.extend(
                [Quantity::MuStatic, Quantity::Mu, Quantity::LoadPress, Quantity::Area].map(|quantity| {
                    let unit = quantity.descriptor().units;
                    numbers::with_error(finished.cell[quantity], unit)
                }),
            ),
            Some(Err(_)) => line.push("failed".into()),
            None => line.push("not run".into()),
        }
        rows.push(line);
    }
    numbers::aligned(&rows, "  ", |_| true)
}

fn as_json(table: &Table, output: &str) -> Value {
    let of_slice = |slice: &Slice| -> Vec<Value> {
        let cell = |(i, j)| {
            let status = slice.status(i, j);
            let summary = slice.cell(i, j).map(|cell| {
                let entry = |quantity: Quantity| {
                    let descriptor = quantity.descriptor();
                    (descriptor.name, json!(cell[quantity].in_unit(descriptor.units)))
                };
                Quantity::SCALARS.into_iter().map(entry).collect::<Value>()
            });
            let (interference, slip_rate) = slice.coordinates(i, j);
            let mut cell = json!({
                "interference": interference,
                "slip_rate": slip_rate,
                "status": status.name(),
                "reason": status.reason(),
                "summary": summary,
            });
            if table.slices().len() > 1 {
                cell["temperature"] = slice.metadata().temperature.into();
            }
            cell
        };
        slice.grid().map(cell).collect()
    };
    json!({
        "output": output,
        "complete": table.missing().is_empty(),
        "failed": table.failures().len(),
        "cells": table.slices().iter().flat_map(of_slice).collect::<Vec<_>>(),
        "warnings": table.metadata().comment.lines().collect::<Vec<_>>(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_without_results_holds_reasons_only() {
        let said = |failed, of| failure(failed, of, Path::new("x.nc"));
        assert!(said(1, 1).starts_with("the only cell failed; the reasons are in x.nc"));
        assert!(said(4, 4).starts_with("all 4 cells failed; the reasons are in x.nc"));
        assert_eq!(said(1, 4), "1 of 4 cells failed; the others are in x.nc");
    }
}
