//! A main run that begins beside its auxiliary runs, where a thread is idle.
//!
//! Its resolution depends on theirs, but mostly it is the one that they start from. At that one it begins at once; where
//! they require another one it is revoked and repeated. So the results do not depend on the threads.

use std::sync::atomic::{AtomicBool, Ordering};

use super::Watch;
use crate::discretisation::threads::is_alone;

/// Follows a main run that begins early, and revokes it.
pub(super) struct EarlyMain<'a> {
    watch: &'a dyn Watch,
    /// Whether it has reported progress.
    slides: AtomicBool,
    /// Whether the auxiliary runs have ended: then it is too late to begin.
    late: AtomicBool,
    revoked: AtomicBool,
}

impl<'a> EarlyMain<'a> {
    pub fn new(watch: &'a dyn Watch) -> Self {
        let [slides, late, revoked] = [(); 3].map(|()| AtomicBool::new(false));
        Self { watch, slides, late, revoked }
    }

    /// Follows the auxiliary runs, which are silent once the main run slides.
    pub fn of_auxiliary(&self) -> impl Watch {
        Auxiliary(self)
    }

    /// Whether the main run shall begin.
    pub fn begins(&self) -> bool {
        is_alone() && !self.late.load(Ordering::Relaxed)
    }

    /// The auxiliary runs have ended; `useful`: whether the main run is what they require.
    pub fn auxiliary_ended(&self, useful: bool) {
        self.late.store(true, Ordering::Relaxed);
        self.revoked.store(!useful, Ordering::Relaxed);
    }
}

impl Watch for EarlyMain<'_> {
    fn progress(&self, stage: &'static str, done: f64, detail: &str) {
        self.slides.store(true, Ordering::Relaxed);
        self.watch.progress(stage, done, detail);
    }

    fn cancelled(&self) -> bool {
        self.revoked.load(Ordering::Relaxed) || self.watch.cancelled()
    }
}

struct Auxiliary<'a>(&'a EarlyMain<'a>);

impl Watch for Auxiliary<'_> {
    fn progress(&self, stage: &'static str, done: f64, detail: &str) {
        if !self.0.slides.load(Ordering::Relaxed) {
            self.0.watch.progress(stage, done, detail);
        }
    }

    fn cancelled(&self) -> bool {
        self.0.watch.cancelled()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::*;

    #[derive(Default)]
    struct Heard(Mutex<Vec<String>>);

    impl Watch for Heard {
        fn progress(&self, _: &'static str, _: f64, detail: &str) {
            self.0.lock().unwrap().push(detail.to_owned());
        }
    }

    #[test]
    fn progress_is_that_of_the_main_run_once_it_slides() {
        let heard = Heard::default();
        let early = EarlyMain::new(&heard);
        let auxiliary = early.of_auxiliary();
        auxiliary.progress("slide", 0.0, "auxiliary, alone");
        early.progress("slide", 0.5, "main");
        auxiliary.progress("slide", 0.1, "auxiliary, beside");
        assert_eq!(*heard.0.lock().unwrap(), ["auxiliary, alone", "main"]);
    }

    #[test]
    fn a_main_run_that_is_not_required_is_revoked() {
        for useful in [true, false] {
            let early = EarlyMain::new(&super::super::Unwatched);
            assert!(!early.cancelled());
            early.auxiliary_ended(useful);
            assert_eq!(early.cancelled(), !useful);
            assert!(!early.begins() && !early.of_auxiliary().cancelled());
        }
    }
}
