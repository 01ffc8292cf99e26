//! The computation of a command, with its progress on stderr.

use super::common::{Display, Failure, RunOptions};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::sync::atomic::{AtomicUsize, Ordering};
use tables::netcdf::streams::say;

/// Computes in the threads of the options; what is given to `compute` shows how many of `what` are done and in all.
pub fn computed<T: Send>(
    options: &RunOptions,
    display: &Display,
    what: &'static str,
    compute: impl FnOnce(&(dyn Fn(usize, usize) + Sync)) -> T + Send,
) -> Result<T, Failure> {
    let threads = options.threads.map_or(0, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.map_err(|error| Failure::run(format!("cannot start threads: {error}")))?;
    let progress = Progress::new(display, what);
    let result = pool.install(|| compute(&|done, total| progress.show(done, total)));
    if let Progress::Bar(bar) = progress {
        bar.finish_and_clear();
    }
    Ok(result)
}

/// A bar on a terminal, a line per tenth in a log, or no output.
enum Progress {
    Hidden,
    Bar(ProgressBar),
    /// Name of the counted things, and the tenths shown.
    Lines(&'static str, AtomicUsize),
}

impl Progress {
    /// A count of `what`; by default only on a terminal.
    fn new(display: &Display, what: &'static str) -> Self {
        let terminal = std::io::stderr().is_terminal();
        if terminal && !display.quiet {
            let style = ProgressStyle::with_template("{bar:30} {pos} of {len} {msg}, {eta} left");
            let style = style.expect("a valid template");
            return Self::Bar(ProgressBar::new(0).with_style(style).with_message(what));
        }
        if display.progress { Self::Lines(what, AtomicUsize::new(0)) } else { Self::Hidden }
    }

    fn show(&self, done: usize, total: usize) {
        match self {
            Self::Hidden => {}
            Self::Bar(bar) => {
                bar.set_length(total as u64);
                bar.set_position(done as u64);
            }
            Self::Lines(what, shown) => {
                let tenths = 10 * done / total;
                if shown.swap(tenths, Ordering::Relaxed) != tenths {
                    say(format!("{done} of {total} {what}"));
                }
            }
        }
    }
}
