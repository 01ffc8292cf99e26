//! Progress on stderr.

use super::common::Display;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::sync::atomic::{AtomicUsize, Ordering};
use tables::netcdf::streams::say;

/// A bar on a terminal, a line per tenth in a log, or no output.
pub enum Progress {
    Hidden,
    Bar(ProgressBar),
    /// Name of the counted things, and the tenths shown.
    Lines(&'static str, AtomicUsize),
}

impl Progress {
    /// A count of `what`; by default only on a terminal.
    pub fn new(display: &Display, what: &'static str) -> Self {
        let terminal = std::io::stderr().is_terminal();
        if terminal && !display.quiet {
            let style = ProgressStyle::with_template("{bar:30} {pos} of {len} {msg}, {eta} left");
            let style = style.expect("a valid template");
            return Self::Bar(ProgressBar::new(0).with_style(style).with_message(what));
        }
        if display.progress { Self::Lines(what, AtomicUsize::new(0)) } else { Self::Hidden }
    }

    pub fn show(&self, done: usize, total: usize) {
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

    pub fn clear(&self) {
        if let Self::Bar(bar) = self {
            bar.finish_and_clear();
        }
    }
}
