//! A computation in a thread of its own, without Python's lock. The calling thread meanwhile attends to interrupts and
//! calls a function of the user with the progress.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread::Builder;
use std::time::Duration;

use asperity::simulate::{STACK_SIZE, Watch};
use asperity::tabulate::{CellProgress, CellResult, Index, TableWatch};
use pyo3::prelude::*;

use crate::errors;

/// Interval at which interrupts are attended to.
const INTERVAL: Duration = Duration::from_millis(50);

/// What the computing threads tell, and the request to stop.
#[derive(Default)]
pub struct Follower {
    stop: AtomicBool,
    /// Stage, share of it that is done, remark.
    latest: Mutex<Option<(String, f64, String)>>,
}

/// Payload of the unwinding that ends a computation that cannot be asked to stop otherwise.
struct Stopped;

impl Follower {
    fn tell(&self, stage: &str, done: f64, remark: String) {
        if let Ok(mut latest) = self.latest.lock() {
            *latest = Some((stage.to_owned(), done, remark));
        }
    }

    /// Progress of a computation that counts; ends it by unwinding once it shall stop.
    pub fn counted(&self, what: &'static str, done: usize, total: usize) {
        if self.stop.load(Ordering::Relaxed) {
            std::panic::resume_unwind(Box::new(Stopped));
        }
        self.tell(what, done as f64 / total as f64, format!("{done} of {total} {what}"));
    }

    fn show(&self, progress: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        let latest = self.latest.lock().ok().and_then(|mut latest| latest.take());
        if let (Some(latest), Some(progress)) = (latest, progress) {
            progress.call1(latest)?;
        }
        Ok(())
    }
}

impl Watch for Follower {
    fn progress(&self, stage: &'static str, done: f64, remark: &str) {
        self.tell(stage, done, remark.to_owned());
    }

    fn cancelled(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

impl TableWatch for Follower {
    fn finished(&self, _: Index, _: &CellResult, progress: &CellProgress) {
        let CellProgress { done, total, remaining } = *progress;
        let remark = format!("{done} of {total} cells, {remaining:.0} s left");
        self.tell("cells", done as f64 / total as f64, remark);
    }
}

/// Does `work` on a number of threads, by default on all processors. An interrupt, or an exception in `progress`, stops
/// it and is raised once it has ended.
pub fn followed<T: Send>(
    py: Python<'_>,
    threads: Option<usize>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Follower) -> T + Send,
) -> PyResult<T> {
    let pool =
        rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0)).stack_size(STACK_SIZE).build();
    let pool = pool.map_err(|error| errors::failed(format!("cannot start threads: {error}"), None))?;
    let follower = Follower::default();
    std::thread::scope(|scope| {
        let (ended, end) = channel::<()>();
        let (follower, pool) = (&follower, &pool);
        let computing = Builder::new().stack_size(STACK_SIZE).spawn_scoped(scope, move || {
            // Closes the channel also where the work panics.
            let _ended = ended;
            pool.install(|| work(follower))
        })?;
        let mut stopped = Ok(());
        let end = Mutex::new(end);
        let running = || {
            let waited = end.lock().map(|end| end.recv_timeout(INTERVAL));
            matches!(waited, Ok(Err(RecvTimeoutError::Timeout)))
        };
        while py.detach(running) {
            if stopped.is_ok() {
                stopped = py.check_signals().and_then(|()| follower.show(progress));
                follower.stop.store(stopped.is_err(), Ordering::Relaxed);
            }
        }
        let result = computing.join();
        stopped?;
        let result = result.map_err(|_| errors::failed("internal error; please report it", None))?;
        follower.show(progress)?;
        Ok(result)
    })
}
