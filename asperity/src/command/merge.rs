//! `asperity merge`: shards of a table put together.

use std::path::Path;

use asperity::provenance;
use serde_json::json;
use tables::table::{Metadata, Table};

use super::{Display, Failure, MergeArguments, command_line, outputs, print};

/// Read the shards, check that they belong together, write the table.
pub fn merge(arguments: &MergeArguments, display: &Display) -> Result<(), Failure> {
    for shard in &arguments.shards {
        outputs::check_output(&arguments.output, shard)?;
        outputs::check_plot(arguments.plot.as_deref(), shard)?;
    }
    let table = merged(&arguments.shards)?;
    let missing = table.missing().len();
    let (rows, columns) = table.shape();
    let cells = rows * columns;
    if missing > 0 && !arguments.partial {
        return Err(Failure::Input(format!(
            "{missing} of {cells} cells are in none of the shards, the first at {}; --partial merges all the same",
            table.missing().first().map_or(String::new(), |(i, j)| table.label(*i, *j))
        )));
    }
    table.write(&arguments.output).map_err(Failure::run)?;
    if let Some(plot) = &arguments.plot {
        table.figure().save(plot).map_err(Failure::run)?;
    }
    let failed: Vec<(String, &str)> = table.failures().collect();
    if !display.quiet {
        for (label, reason) in &failed {
            eprintln!("failed: {label}: {reason}");
        }
    }
    let done = cells - missing - failed.len();
    if display.json {
        let output = arguments.output.display().to_string();
        let summary = json!({ "output": output, "done": done, "not_run": missing, "failed": failed.len() });
        print(&format!("{summary:#}\n"));
    } else if !display.quiet {
        print(&format!("{done} of {cells} cells done, {missing} not run, {} failed\n", failed.len()));
    }
    Ok(())
}

/// All shards in one table, which is no shard any more if nothing is missing.
fn merged(shards: &[impl AsRef<Path>]) -> Result<Table, Failure> {
    let mut whole: Option<(Table, &Path)> = None;
    let mut histories = Vec::new();
    for path in shards.iter().map(AsRef::as_ref) {
        let shard = Table::read(path).map_err(Failure::input)?;
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
    let mut metadata = Metadata { history: histories.join("\n"), ..table.metadata().clone() };
    if table.missing().is_empty() {
        metadata.shard.clear();
    }
    table.set_metadata(metadata);
    Ok(table)
}
