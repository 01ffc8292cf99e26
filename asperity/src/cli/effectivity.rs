//! `asperity effectivity`: true errors against their estimates.

use asperity::studies::effectivity::{Record, Report, markdown, run, scenes};

use tables::netcdf::streams::say;
use tables::netcdf::write_atomically;

use super::progress::{interrupted, watched};
use super::{Display, EffectivityArguments, Failure, outputs, print};

/// Run the scenes that the journal lacks, evaluate all of it.
pub fn effectivity(arguments: &EffectivityArguments, display: &Display) -> Result<(), Failure> {
    outputs::check(&[("--journal", &arguments.journal)], &[(outputs::OUTPUT, &arguments.output)])?;
    let all = scenes::COUNT;
    let which: Vec<usize> = match arguments.scenes.as_slice() {
        [] => (0..all).collect(),
        chosen => chosen.iter().map(|number| number - 1).collect(),
    };
    if let Some(beyond) = which.iter().find(|&&scene| scene >= all) {
        return Err(Failure::input(format!("--scenes: {} is not one of 1 to {all}", beyond + 1)));
    }
    let done = |record: &Record| {
        if display.verbose {
            let name = scenes::study_scene(record.scene).name();
            let outcome = record.failure.as_deref().unwrap_or("done");
            say(format!("{name}, {:?}: {outcome}, {:.1} s", record.role, record.wall_time));
        }
    };
    let which = if arguments.judge_only { &[] } else { which.as_slice() };
    // Several runs are in progress at a time.
    let silent = Display { quiet: true, ..*display };
    let records = watched(&silent, |progress| run(&arguments.journal, which, progress, &done))
        .map_err(|error| Failure::run(format!("{}: {error}", arguments.journal.display())))?;
    let report = Report::new(&records);
    let text = markdown(&report);
    write_atomically(&arguments.output, text.as_bytes())
        .map_err(|error| Failure::run(format!("{}: {error}", arguments.output.display())))?;
    if !display.quiet {
        print(&text)?;
    }
    if interrupted() {
        let journal = arguments.journal.display();
        return Err(Failure::Run(format!("stopped on request; the same command continues from {journal}")));
    }
    Ok(())
}
