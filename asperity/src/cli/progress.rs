//! Progress on stderr, and the wish to stop.

use std::io::IsTerminal;
use std::sync::{Mutex, OnceLock};
use std::time::{Duration, Instant as Clock};

use asperity::simulate::Watch;
use asperity::tabulate::{CellResult, Index, Standing, TableWatch};
use indicatif::{ProgressBar, ProgressStyle};

use super::Display;

/// When it was first asked to stop.
static INTERRUPTED: OnceLock<Clock> = OnceLock::new();

/// Signals within that time are one request: `timeout` and batch systems send one to the program and, at once, one to
/// the group of processes that it is in.
const SAME_REQUEST: Duration = Duration::from_millis(500);

/// From now on the first interrupt, or the signal that ends a batch job, asks to stop, so that results
/// can be saved; the second stops at once.
pub fn watch_for_interrupt() {
    let handler = || match INTERRUPTED.get() {
        None => {
            let _ = INTERRUPTED.set(Clock::now());
            eprintln!("stopping; once more to stop without saving");
        }
        Some(first) if first.elapsed() > SAME_REQUEST => std::process::exit(130),
        Some(_) => {}
    };
    // Without a handler an interrupt ends the program, which is acceptable.
    let _ = ctrlc::set_handler(handler);
}

/// Shows how far a run or a tabulation is.
pub struct Progress {
    shown: Shown,
    /// The present stage and when it began.
    stage: Mutex<(&'static str, Clock)>,
}

enum Shown {
    Hidden,
    Bar(ProgressBar),
    /// A line per tenth, for logs: the last one shown.
    Lines(Mutex<(String, u64)>),
}

/// Steps of the bar.
const LENGTH: u64 = 1000;

/// Share of a stage before which nothing is said of the time that is left.
const FIRST_ESTIMATE: f64 = 0.05;

impl Progress {
    /// As the options say: by default only on a terminal.
    pub fn new(display: &Display) -> Self {
        Self { shown: Shown::new(display), stage: Mutex::new(("", Clock::now())) }
    }

    /// Seconds left in a stage of which a share is done, going by the time since it began.
    fn left(&self, stage: &'static str, done: f64) -> Option<f64> {
        let mut present = self.stage.lock().ok()?;
        if present.0 != stage {
            *present = (stage, Clock::now());
        }
        let elapsed = present.1.elapsed().as_secs_f64();
        (FIRST_ESTIMATE..1.0).contains(&done).then(|| elapsed * (1.0 - done) / done)
    }

    /// `done` is a share, 0 to 1.
    fn show(&self, stage: &str, done: f64, detail: &str) {
        self.shown.show(stage, done, detail);
    }

    /// Print something while the bar is shown.
    pub fn aside(&self, print: impl FnOnce()) {
        match &self.shown {
            Shown::Bar(bar) => bar.suspend(print),
            _ => print(),
        }
    }

    /// Take the bar away, before results are printed.
    pub fn clear(&self) {
        if let Shown::Bar(bar) = &self.shown {
            bar.finish_and_clear();
        }
    }
}

impl Shown {
    fn new(display: &Display) -> Self {
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
        match self.left(stage, done) {
            Some(left) if detail.is_empty() => self.show(stage, done, &format!("{} left", duration(left))),
            Some(left) => self.show(stage, done, &format!("{} left, {detail}", duration(left))),
            None => self.show(stage, done, detail),
        }
    }

    fn cancelled(&self) -> bool {
        INTERRUPTED.get().is_some()
    }
}

impl TableWatch for Progress {
    fn finished(&self, _: Index, _: &CellResult, standing: &Standing) {
        let Standing { done, total, remaining } = *standing;
        let detail = format!("{done} of {total} cells, {} left", duration(remaining));
        self.show("cells", done as f64 / total as f64, &detail);
    }

    fn cancelled(&self) -> bool {
        INTERRUPTED.get().is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_left_is_that_of_the_stage() {
        let hidden = Shown::Hidden;
        let begun = Clock::now() - std::time::Duration::from_secs(10);
        let progress = Progress { shown: hidden, stage: Mutex::new(("slide", begun)) };
        let left = progress.left("slide", 0.25).unwrap();
        assert!((30.0..31.0).contains(&left), "{left}");
        assert_eq!(progress.left("slide", 0.01), None);
        assert_eq!(progress.left("slide", 1.0), None);
        let left = progress.left("finer", 0.5).unwrap();
        assert!(left < 1.0, "{left}");
    }

    #[test]
    fn durations_are_short() {
        let shown = [0.4, 99.0, 130.0, 5900.0, 6100.0, 90_000.0].map(duration);
        assert_eq!(shown, ["0 s", "99 s", "2 min", "98 min", "1 h 42 min", "25 h 0 min"]);
    }
}
