//! `asperity merge`: the shards of a table in one.

use std::path::Path;

use asperity::output::provenance;
use serde_json::json;
use tables::netcdf::streams::say;
use tables::shipped;
use tables::table::Table;

use super::{Display, Failure, MergeArguments, command_line, outputs, program};

/// Read the shards, check that they belong together, write the table.
pub fn merge(arguments: &MergeArguments, display: &Display) -> Result<(), Failure> {
    let shards: Vec<_> = arguments.shards.iter().map(|shard| ("a shard", shard.as_path())).collect();
    outputs::check(&shards, &outputs::with_plots(&arguments.output, &arguments.plot))?;
    let table = merged(&arguments.shards)?;
    let plots = outputs::plots(&arguments.plot, &table.temperatures());
    outputs::check(&shards, &outputs::with_plots(&arguments.output, &plots))?;
    let missing = table.missing();
    let cells: usize = table.slices().iter().map(|slice| slice.shape().0 * slice.shape().1).sum();
    if let Some(first) = missing.first()
        && !arguments.partial
    {
        return Err(Failure::Input(format!(
            "{} of {cells} cells are in none of the shards, the first at {first}; --partial merges the others",
            missing.len()
        )));
    }
    let missing = missing.len();
    if let [only] = &arguments.shards[..]
        && missing == 0
    {
        let nothing = format!("{} is complete: there is nothing to merge it with", only.display());
        display.printer().warn([nothing]);
    }
    program::save(&arguments.output, |path| table.write(path))?;
    outputs::plot(&table, &arguments.plot, &arguments.panel)?;
    let failed = table.failures();
    if !display.quiet {
        for (label, reason) in &failed {
            say(format!("failed: {label}: {reason}"));
        }
    }
    let done = cells - missing - failed.len();
    let (output, failed) = (arguments.output.display().to_string(), failed.len());
    display.printer().print(
        || json!({ "output": output, "done": done, "not_run": missing, "failed": failed }),
        || format!("{done} of {cells} cells done, {missing} not run, {failed} failed\n"),
    )
}

/// All shards in one table, which is not a shard if no cell is missing.
fn merged(shards: &[impl AsRef<Path>]) -> Result<Table, Failure> {
    let mut whole: Option<(Table, &Path)> = None;
    let mut histories = Vec::new();
    for path in shards.iter().map(AsRef::as_ref) {
        let shard = match path.to_str() {
            Some(name) => shipped::load(name).map_err(Failure::input)?,
            None => Table::read(path).map_err(Failure::input)?,
        };
        histories.push(shard.metadata().history.clone());
        match &mut whole {
            None => whole = Some((shard, path)),
            Some((table, first)) => table.merge(&shard).map_err(|error| {
                Failure::Input(format!("{} and {}: {error}", first.display(), path.display()))
            })?,
        }
    }
    let (mut table, _) = whole.ok_or_else(|| Failure::input("no shards"))?;
    histories.push(provenance::history(&command_line()));
    let shard = match table.missing().is_empty() {
        true => String::new(),
        false => table.metadata().shard.clone(),
    };
    table.set_provenance(&histories.join("\n"), &shard);
    Ok(table)
}
