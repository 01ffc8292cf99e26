//! A main run that begins beside its auxiliary runs, where a thread is idle.
//!
//! The resolution of the main run follows from the auxiliary runs; mostly it is the one that they start from. If a thread is
//! idle, the main run begins at that resolution at once. If the auxiliary runs require another one, it is stopped and
//! repeated. Results do not depend on the number of threads.

use std::sync::atomic::{AtomicBool, Ordering};

use super::Watch;

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

    /// Whether the main run can still begin early.
    pub fn begins(&self) -> bool {
        !self.late.load(Ordering::Relaxed)
    }

    /// For the duration of the auxiliary runs.
    pub fn while_auxiliary(&self) -> AuxiliaryEnd<'_> {
        AuxiliaryEnd { early: self, useful: false }
    }
}

/// Ends the time in which the main run can begin early, also where an auxiliary run panics, and revokes it unless it is
/// useful.
pub(super) struct AuxiliaryEnd<'a> {
    early: &'a EarlyMain<'a>,
    /// Whether the main run is what the auxiliary runs require.
    pub useful: bool,
}

impl Drop for AuxiliaryEnd<'_> {
    fn drop(&mut self) {
        self.early.late.store(true, Ordering::Relaxed);
        self.early.revoked.store(!self.useful, Ordering::Relaxed);
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
            assert!(early.begins() && !early.cancelled());
            early.while_auxiliary().useful = useful;
            assert_eq!(early.cancelled(), !useful);
            assert!(!early.begins() && !early.of_auxiliary().cancelled());
        }
    }
}
