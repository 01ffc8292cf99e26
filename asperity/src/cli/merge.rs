//! `asperity merge`: the shards of a table in one.

use std::path::{Path, PathBuf};

use asperity::output::provenance;
use serde_json::json;
use tables::netcdf::streams::say;
use tables::shipped;
use tables::table::Table;

use super::{Display, Failure, MergeArguments, command_line, outputs, program};

/// Read the shards, check that they belong together, write the table.
pub fn merge(arguments: &MergeArguments, display: &Display) -> Result<(), Failure> {
    let shards: Vec<_> = arguments.shards.iter().map(|shard| ("a shard", shard.as_path())).collect();
    outputs::check_with_table(&shards, &outputs::with_plots(&arguments.output, &arguments.figure.plot))?;
    let table = merged(&arguments.shards)?;
    let plots = outputs::plots(&arguments.figure.plot, &table.temperatures());
    outputs::check_with_table(&shards, &outputs::with_plots(&arguments.output, &plots))?;
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
    check_replaced(&table, &arguments.output, display)?;
    if let [only] = &arguments.shards[..]
        && missing == 0
    {
        let nothing = format!("{} is complete: there is nothing to merge it with", only.display());
        display.printer().warn([nothing]);
    }
    program::save(&arguments.output, |path| table.write(path))?;
    outputs::plot(&table, &arguments.figure)?;
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

/// Refuses to replace a table of the same request by one without some of its cells, and warns of another file.
fn check_replaced(table: &Table, output: &Path, display: &Display) -> Result<(), Failure> {
    if std::fs::metadata(output).map_or(true, |file| file.len() == 0) {
        return Ok(());
    }
    let not_done = |table: &Table| table.missing().len() + table.failures().len();
    let mut both = table.clone();
    let replaced = Table::read(output).map_err(|error| error.to_string());
    let output = output.display();
    let of_other = |difference| format!("{output}: is a table of another request: {difference}");
    match replaced.and_then(|replaced| both.merge(&replaced).map_err(of_other)) {
        Ok(()) if not_done(&both) < not_done(table) => Err(Failure::Input(format!(
            "{output}: has cells of this request that are in none of the shards; give it as a shard too, with another \
             name for --output, or delete it"
        ))),
        Ok(()) => Ok(()),
        Err(difference) => {
            display.printer().warn([format!("{difference}; this table replaces the file")]);
            Ok(())
        }
    }
}

/// All shards in one table, which is not a shard if no cell is missing or it is of several.
fn merged(shards: &[PathBuf]) -> Result<Table, Failure> {
    let mut whole: Option<(Table, &Path)> = None;
    let (mut histories, mut names) = (Vec::new(), Vec::new());
    for path in shards {
        let shard = match path.to_str() {
            Some(name) => shipped::load(name).map_err(Failure::input)?,
            None => Table::read(path).map_err(Failure::input)?,
        };
        histories.push(shard.metadata().history.clone());
        names.push(shard.metadata().shard.clone());
        match &mut whole {
            None => whole = Some((shard, path)),
            Some((table, first)) => table.merge(&shard).map_err(|error| {
                Failure::Input(format!("{} and {}: {error}", first.display(), path.display()))
            })?,
        }
    }
    let (mut table, _) = whole.ok_or_else(|| Failure::input("no shards"))?;
    histories.push(provenance::history(&command_line()));
    names.dedup();
    let shard = match &names[..] {
        [one] if !table.missing().is_empty() => one,
        _ => "",
    };
    table.set_provenance(&histories.join("\n"), shard);
    Ok(table)
}
