//! `asperity table info`.

use serde_json::{Value, json};
use tables::interpolation::InterpolatedTable;
use tables::numbers::plain;
use tables::quantity::Quantity;
use tables::refinement::statistics::{Counts, ErrorStatistics};
use tables::shipped;
use tables::table::{Metadata, Slice, Table};

use crate::{Display, Failure};

/// Print the contents of a table.
pub fn info(table: &Table, table_name: &str, display: &Display) -> Result<(), Failure> {
    let json = || match table.only() {
        Ok(slice) => as_json(table, slice, table_name),
        Err(_) => by_temperature(table, table_name),
    };
    display.printer().print(json, || text(table, table_name, display.verbose))
}

/// Print the shipped tables, a line each.
pub fn list(display: &Display) -> Result<(), Failure> {
    let tables: Vec<(&str, InterpolatedTable)> = shipped::names()
        .map(|name| Ok((name, shipped::table(name).map_err(Failure::run)?)))
        .collect::<Result<_, Failure>>()?;
    let largest_errors = |table: &InterpolatedTable| {
        let statistics = table.error_statistics();
        [Quantity::MuStatic, Quantity::Mu].map(|quantity| {
            statistics.iter().find(|of| of.quantity == quantity).map_or(f64::NAN, |of| of.largest)
        })
    };
    let counterface =
        |metadata: &Metadata| if metadata.counterface.is_empty() { "isothermal" } else { "conducts heat" };
    let as_json = |(name, table): &(&str, InterpolatedTable)| {
        let (metadata, axes, [mu_static, mu]) = (table.metadata(), table.axes(), largest_errors(table));
        json!({
            "name": name,
            "counterface": counterface(metadata),
            "asperity_radius": metadata.asperity_radius,
            "rate_law": metadata.rate_coefficient.is_some(),
            "interference": axes.interference,
            "slip_rate": axes.slip_rate,
            "mu_static_relative_error_largest": mu_static,
            "mu_relative_error_largest": mu,
        })
    };
    let line = |(name, table): &(&str, InterpolatedTable)| {
        let (metadata, axes, [mu_static, mu]) = (table.metadata(), table.axes(), largest_errors(table));
        let rate_law = if metadata.rate_coefficient.is_some() { ", rate law" } else { "" };
        format!(
            "{name:21} {}{rate_law}, R = {} mm, {}, {}; largest error of mu_static {}, of mu {}\n",
            counterface(metadata),
            plain(1e3 * metadata.asperity_radius),
            range(&axes.interference, "omega_c"),
            range(&axes.slip_rate, "m/s"),
            percent(mu_static),
            percent(mu),
        )
    };
    display
        .printer()
        .print(|| tables.iter().map(as_json).collect::<Value>(), || tables.iter().map(line).collect())
}

fn text(table: &Table, table_name: &str, verbose: bool) -> String {
    let (slices, axes, metadata) = (table.slices(), table.axes(), table.metadata());
    let sum = |of: fn(&Counts) -> usize| slices.iter().map(|slice| of(&slice.counts())).sum::<usize>();
    let mut text = String::new();
    let mut line = |name: &str, value: String| text += &format!("{name:13} {value}\n");
    line("table", table_name.to_owned());
    line("title", metadata.title.clone());
    if slices.len() > 1 {
        line("temperature", range(&table.temperatures(), "K"));
    }
    line("interference", range(&axes.interference, "omega_c"));
    line("slip rate", range(&axes.slip_rate, "m/s"));
    line("slip", range(&axes.slip, "contact radii"));
    line("radius", format!("{} m", plain(metadata.asperity_radius)));
    line("counterface", metadata.counterface_in_words());
    if let Some((from, to)) = energy_ratios(slices) {
        let meaning = "G over the shear fracture energy of the material";
        line("G_ratio", format!("{} to {}, {meaning}", plain(from), plain(to)));
    }
    let done = sum(|counts| counts.done);
    let (not_run, failed) = (sum(|counts| counts.not_run), sum(|counts| counts.failed));
    line("cells", format!("{done} done, {not_run} not run, {failed} failed"));
    if !metadata.shard.is_empty() {
        line("shard", metadata.shard.clone());
    }
    // Cells between the temperatures of a file are neither computed nor stored.
    let cost = slices.iter().map(Slice::cost).sum::<f64>();
    if cost > 0.0 || done == 0 {
        let of_cell = cost / done.max(1) as f64;
        line("cost", format!("{} s in all, {} s a cell", plain(cost.round()), plain(of_cell)));
        let (version, checksum) = (table.schema_version(), table.checksum());
        line("schema", format!("version {version}, content agrees with its {checksum}"));
    }
    let fingerprint = if metadata.fingerprint.is_empty() { "none" } else { &metadata.fingerprint };
    line("made by", format!("{}, fingerprint {fingerprint}", metadata.source));
    for entry in metadata.history.lines() {
        line("history", entry.to_string());
    }
    for warning in metadata.comment.lines() {
        line("warning", warning.to_string());
    }
    for (label, reason) in table.failures() {
        line("failed", format!("{label}: {reason}"));
    }
    for slice in slices {
        if slices.len() > 1 {
            let Metadata { temperature, yield_strength, critical_interference, .. } = slice.metadata();
            text += &format!(
                "\nfrom {} K: yield strength {} Pa, omega_c {} m",
                plain(*temperature),
                plain(*yield_strength),
                plain(*critical_interference)
            );
        }
        text += &format!("\n{}", errors(slice));
    }
    if verbose {
        text += &format!("\nrequest:\n{}", metadata.scene);
    }
    text
}

/// Least and largest G/G_IIc.
fn energy_ratios(slices: &[Slice]) -> Option<(f64, f64)> {
    let of_slice = |slice: &Slice| -> Vec<f64> {
        let cells = slice.grid().filter_map(|(i, j)| slice.cell(i, j));
        cells.filter_map(|cell| Some(slice.energy_ratio(cell)?.value)).collect()
    };
    let known = slices.iter().flat_map(of_slice).filter(|ratio| ratio.is_finite());
    known.fold(None, |range, x| Some(range.map_or((x, x), |(from, to): (f64, f64)| (from.min(x), to.max(x)))))
}

fn range(axis: &[f64], unit: &str) -> String {
    let (first, last) = (axis[0], axis[axis.len() - 1]);
    format!("{} values from {} to {} {unit}", axis.len(), plain(first), plain(last))
}

/// One line per quantity: range, and errors in percent.
fn errors(table: &Slice) -> String {
    let interpolated = match table.metadata().interpolation_tolerance {
        Some(_) => "(part of the errors)",
        None => "(not part of the errors)",
    };
    let mut text = format!(
        "{:17} {:6} {:>12} {:>12}   {:>9} {:>9}   {:24} {:>9} {:>9}   interpolation {interpolated}\n",
        "quantity", "unit", "from", "to", "median", "largest", "error, largest at", "between:", "largest"
    );
    for statistics in table.error_statistics() {
        let ErrorStatistics { quantity, range, median, largest, largest_at, interpolation, between } =
            statistics;
        let [middle, most] = between.unwrap_or([f64::NAN; 2]);
        let descriptor = quantity.descriptor();
        let at = table.label(largest_at.0, largest_at.1);
        text += &format!(
            "{:17} {:6} {:>12} {:>12}   {:>9} {:>9}   {at:24} {:>9} {:>9}   {}\n",
            descriptor.name,
            descriptor.units,
            plain(range.0),
            plain(range.1),
            percent(median),
            percent(largest),
            percent(middle),
            percent(most),
            percent(interpolation),
        );
    }
    text + "Errors of temperatures are relative to their rise.\n"
}

fn percent(share: f64) -> String {
    if share.is_finite() { format!("{:.2} %", 100.0 * share) } else { "unknown".into() }
}

fn as_json(table: &Table, slice: &Slice, table_name: &str) -> Value {
    let (axes, metadata) = (slice.axes(), slice.metadata());
    let counts = slice.counts();
    let quantity = |statistics: ErrorStatistics| {
        let descriptor = statistics.quantity.descriptor();
        let entry = json!({
            "unit": descriptor.units,
            "from": statistics.range.0,
            "to": statistics.range.1,
            "relative_error_median": statistics.median,
            "relative_error_largest": statistics.largest,
            "interpolation_error_largest": statistics.interpolation,
            "between_error_median": statistics.between.map(|[median, _]| median),
            "between_error_largest": statistics.between.map(|[_, largest]| largest),
        });
        (descriptor.name, entry)
    };
    let quantities: Value = slice.error_statistics().into_iter().map(quantity).collect();
    let failures: Vec<Value> =
        slice.failures().map(|(at, reason)| json!({ "at": at, "reason": reason })).collect();
    json!({
        "table": table_name,
        "title": metadata.title,
        "schema_version": table.schema_version(),
        "checksum": slice.checksum(),
        "source": metadata.source,
        "fingerprint": metadata.fingerprint,
        "shard": metadata.shard,
        "history": metadata.history.lines().collect::<Vec<_>>(),
        "warnings": metadata.comment.lines().collect::<Vec<_>>(),
        "asperity_radius": metadata.asperity_radius,
        "interference": axes.interference,
        "slip_rate": axes.slip_rate,
        "slip_distance": axes.slip.last(),
        "interpolation_tolerance": metadata.interpolation_tolerance,
        "cells": { "done": counts.done, "not_run": counts.not_run, "failed": counts.failed },
        "failures": failures,
        "wall_time": slice.cost(),
        "G_ratio": energy_ratios(std::slice::from_ref(slice)).map(|(from, to)| json!({ "from": from, "to": to })),
        "quantities": quantities,
    })
}

/// Metadata common to all slices, then each slice by its initial temperature.
fn by_temperature(table: &Table, table_name: &str) -> Value {
    let slice = |slice: &Slice| {
        let metadata = slice.metadata();
        let mut json = as_json(table, slice, table_name);
        json["temperature"] = metadata.temperature.into();
        json["yield_strength"] = metadata.yield_strength.into();
        json["critical_interference"] = metadata.critical_interference.into();
        json
    };
    json!({
        "table": table_name,
        "title": table.metadata().title,
        "schema_version": table.schema_version(),
        "checksum": table.checksum(),
        "temperature": table.temperatures(),
        "tables": table.slices().iter().map(slice).collect::<Vec<_>>(),
    })
}
