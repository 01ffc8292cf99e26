//! When the work of one simulation is divided among threads.
//!
//! Loops over the body are divided, and a main run begins beside its auxiliary runs, only while a single simulation is
//! in progress. Of several, as the cells of a table, each has a thread of its own; there a thread that waited for a part
//! of a loop would begin another simulation meanwhile. Results do not depend on whether loops are divided.

use std::sync::atomic::{AtomicUsize, Ordering};

static IN_PROGRESS: AtomicUsize = AtomicUsize::new(0);

/// A simulation in progress, until it is dropped.
pub struct InProgress(());

impl InProgress {
    pub fn begin() -> Self {
        IN_PROGRESS.fetch_add(1, Ordering::Relaxed);
        Self(())
    }
}

impl Drop for InProgress {
    fn drop(&mut self) {
        IN_PROGRESS.fetch_sub(1, Ordering::Relaxed);
    }
}

/// Whether no other simulation is in progress in this process.
pub fn is_alone() -> bool {
    IN_PROGRESS.load(Ordering::Relaxed) <= 1
}

/// Least number of items of a loop that a thread takes.
pub fn least_share() -> usize {
    if is_alone() { 1 } else { usize::MAX }
}
