//! Progress on stderr, and requests to stop.

use std::io::IsTerminal;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, Once, OnceLock};
use std::time::{Duration, Instant};

use asperity::simulate::Watch;
use asperity::simulate::expected_time::{EXPECTED_TIME_FACTOR, SHORT};
use asperity::tabulate::{CellProgress, CellResult, Index, TableWatch};
use indicatif::{ProgressBar, ProgressStyle};
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
use signal_hook::iterator::Signals;
use tables::netcdf::streams::say;

use super::Display;

/// Time of the first request to stop.
static INTERRUPTED: OnceLock<Instant> = OnceLock::new();

/// Signals within this time are one request: `timeout` and batch systems send one to the program and one to its
/// process group at once.
const SAME_REQUEST: Duration = Duration::from_millis(500);

/// From now on the first interrupt, or the signal that ends a terminal or a batch job, requests a stop, so that results
/// can be saved; the second ends the program at once. Signals that are ignored, as under `nohup`, stay ignored. A file that
/// becomes larger than the system allows is an error.
fn watch_for_interrupt() {
    // Without a handler the signal ends the program.
    let _ = signal_hook::flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false)));
    let ignored = ignored_signals();
    let heard = [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0);
    // Without a handler an interrupt ends the program, which is acceptable.
    let Ok(mut signals) = Signals::new(heard) else { return };
    std::thread::spawn(move || {
        for _ in signals.forever() {
            match INTERRUPTED.get() {
                None => {
                    let _ = INTERRUPTED.set(Instant::now());
                    say("stopping; interrupt again to stop without saving");
                }
                Some(first) if first.elapsed() > SAME_REQUEST => std::process::exit(130),
                Some(_) => {}
            }
        }
    });
}

/// Whether a stop was requested.
pub fn interrupted() -> bool {
    INTERRUPTED.get().is_some()
}

/// The signals that the program was started to ignore, a bit each from signal 1 on; none where the system has no
/// `/proc`.
fn ignored_signals() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|digits| u64::from_str_radix(digits.trim(), 16).ok()).unwrap_or(0)
}

/// The result of `work`, which shows its progress and can be asked to stop.
pub fn watched<R>(display: &Display, work: impl FnOnce(&Progress) -> R) -> R {
    static HEARD: Once = Once::new();
    HEARD.call_once(watch_for_interrupt);
    let progress = Progress::new(display);
    let result = work(&progress);
    progress.clear();
    result
}

/// Shows the progress of a run or a tabulation.
pub struct Progress {
    shown: Shown,
    /// The present stage and when it began.
    stage: Mutex<(&'static str, Instant)>,
    quiet: bool,
}

enum Shown {
    Hidden,
    Bar(ProgressBar),
    /// A line per tenth, for logs; holds the last one shown.
    Lines(Mutex<(String, u64)>),
}

/// Steps of the bar.
const LENGTH: u64 = 1000;

/// Share of a stage from which on the time left is estimated.
const FIRST_ESTIMATE: f64 = 0.05;

impl Progress {
    /// According to the options; by default on a terminal only.
    fn new(display: &Display) -> Self {
        Self { shown: Shown::new(display), stage: Mutex::new(("", Instant::now())), quiet: display.quiet }
    }

    /// Seconds left in a stage of which a share is done, from the time since it began.
    fn left(&self, stage: &'static str, done: f64) -> Option<f64> {
        let mut present = self.stage.lock().ok()?;
        if present.0 != stage {
            *present = (stage, Instant::now());
        }
        let elapsed = present.1.elapsed().as_secs_f64();
        (FIRST_ESTIMATE..1.0).contains(&done).then(|| elapsed * (1.0 - done) / done)
    }

    /// Removes the bar before results are printed.
    fn clear(&self) {
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
                    say(format!("{stage} {:3.0} % {detail}", done * 100.0));
                    *last = (stage.to_owned(), tenth);
                }
            }
        }
    }
}

/// Tells the processor time to expect, s, before the work begins.
pub fn tell_expected_time(seconds: f64) {
    let finer = match EXPECTED_TIME_FACTOR * seconds < SHORT {
        true => format!(", up to some {SHORT} s if its error asks for a finer mesh"),
        false => String::new(),
    };
    let about = duration(seconds.max(1.0));
    say(format!(
        "note: about {about} of processor time expected (within a factor of {EXPECTED_TIME_FACTOR}{finer})"
    ));
}

/// An estimate, in two units at most.
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
        let shown = &self.shown;
        match self.left(stage, done) {
            Some(left) if detail.is_empty() => shown.show(stage, done, &format!("{} left", duration(left))),
            Some(left) => shown.show(stage, done, &format!("{} left, {detail}", duration(left))),
            None => shown.show(stage, done, detail),
        }
    }

    fn cancelled(&self) -> bool {
        interrupted()
    }
}

impl TableWatch for Progress {
    fn expects(&self, seconds: f64) {
        if seconds > 0.0 && !self.quiet {
            tell_expected_time(seconds);
        }
    }

    fn finished(&self, _: Index, _: &CellResult, progress: &CellProgress) {
        let CellProgress { done, total, remaining } = *progress;
        let detail = format!("{done} of {total} cells, {} left", duration(remaining));
        self.shown.show("cells", done as f64 / total as f64, &detail);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_left_is_that_of_the_stage() {
        let begun = Instant::now() - Duration::from_secs(10);
        let progress = Progress { shown: Shown::Hidden, stage: Mutex::new(("slide", begun)), quiet: true };
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
