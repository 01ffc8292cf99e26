//! Progress on stderr, and the wish to stop.

use std::io::IsTerminal;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

use asperity::simulate::Watch;
use asperity::tabulate::{CellResult, Index, Standing, TableWatch};
use indicatif::{ProgressBar, ProgressStyle};

use super::Display;

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// From now on the first interrupt asks to stop, so that results can be saved; the second
/// stops at once.
pub fn watch_for_interrupt() {
    let handler = || {
        if INTERRUPTED.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
        eprintln!("stopping; once more to stop without saving");
    };
    // Without a handler an interrupt ends the program, which is acceptable.
    let _ = ctrlc::set_handler(handler);
}

/// Shows how far a run or a tabulation is.
pub enum Progress {
    Hidden,
    Bar(ProgressBar),
    /// A line per tenth, for logs: the last one shown.
    Lines(Mutex<(String, u64)>),
}

/// Steps of the bar.
const LENGTH: u64 = 1000;

impl Progress {
    /// As the options say: by default only on a terminal.
    pub fn new(display: &Display) -> Self {
        let terminal = std::io::stderr().is_terminal();
        if display.quiet || !(terminal || display.progress) {
            return Self::Hidden;
        }
        if !terminal {
            return Self::Lines(Mutex::new((String::new(), 0)));
        }
        let bar = ProgressBar::new(LENGTH);
        let template = "{prefix:8} {bar:40} {percent:>3} % {elapsed} {wide_msg}";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        Self::Bar(bar)
    }

    /// `done` is a share, 0 to 1.
    fn show(&self, stage: &str, done: f64, detail: &str) {
        match self {
            Self::Hidden => {}
            Self::Bar(bar) => {
                bar.set_prefix(stage.to_owned());
                bar.set_message(detail.to_owned());
                bar.set_position((done * LENGTH as f64) as u64);
            }
            Self::Lines(last) => {
                let tenth = (done * 10.0) as u64;
                let Ok(mut last) = last.lock() else { return };
                if last.0 != stage || last.1 != tenth {
                    eprintln!("{stage} {:3.0} % {detail}", done * 100.0);
                    *last = (stage.to_owned(), tenth);
                }
            }
        }
    }

    /// Print something while the bar is shown.
    pub fn aside(&self, print: impl FnOnce()) {
        match self {
            Self::Bar(bar) => bar.suspend(print),
            _ => print(),
        }
    }

    /// Take the bar away, before results are printed.
    pub fn clear(&self) {
        if let Self::Bar(bar) = self {
            bar.finish_and_clear();
        }
    }
}

/// Two units at most: what is estimated is not known to the second.
fn duration(seconds: f64) -> String {
    let minutes = (seconds / 60.0).round() as u64;
    match (seconds, minutes) {
        (..100.0, _) => format!("{seconds:.0} s"),
        (_, ..100) => format!("{minutes} min"),
        (_, minutes) => format!("{} h {} min", minutes / 60, minutes % 60),
    }
}

impl Watch for Progress {
    fn progress(&self, stage: &'static str, done: f64, detail: &str) {
        self.show(stage, done, detail);
    }

    fn cancelled(&self) -> bool {
        INTERRUPTED.load(Ordering::Relaxed)
    }
}

impl TableWatch for Progress {
    fn finished(&self, _: Index, _: &CellResult, standing: &Standing) {
        let Standing { done, total, remaining } = *standing;
        let detail = format!("{done} of {total} cells, {} left", duration(remaining));
        self.show("cells", done as f64 / total as f64, &detail);
    }

    fn cancelled(&self) -> bool {
        INTERRUPTED.load(Ordering::Relaxed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations_are_short() {
        let shown = [0.4, 99.0, 130.0, 5900.0, 6100.0, 90_000.0].map(duration);
        assert_eq!(shown, ["0 s", "99 s", "2 min", "98 min", "1 h 42 min", "25 h 0 min"]);
    }
}
