//! Tabulations with a simulation that takes no time.

use std::path::PathBuf;
use std::sync::atomic::AtomicUsize;

use tables::quantity::Quantity;

use super::*;
use crate::fake::Fake;
use crate::scene_file::parse_request;
use crate::simulate::Unwatched;

fn request() -> Request {
    let text = "[material]\npreset = \"copper\"\n[asperity]\nradius = 1e-3\n\
                [table]\ninterference = [1, 10, 100]\nslip_rate = [0.1, 1, 10]\n";
    parse_request(text, "request.toml", &[]).unwrap()
}

struct Bench {
    _directory: tempfile::TempDir,
    journal: PathBuf,
}

impl Bench {
    fn new() -> Self {
        let directory = tempfile::tempdir().unwrap();
        Self { journal: directory.path().join("table.nc.part"), _directory: directory }
    }

    fn run(
        &self,
        fake: &Fake,
        jobs: usize,
        resume: bool,
        watch: &dyn TableWatch,
    ) -> Result<(Tabulation, Journal), TabulateError> {
        let options = Options { jobs, journal: &self.journal, resume };
        tabulate_with(fake, &request(), &options, watch)
    }
}

/// Stops after a number of cells.
struct StopAfter(usize, AtomicUsize);

impl TableWatch for StopAfter {
    fn finished(&self, _: Index, _: &CellResult, _: usize, _: usize) {
        self.1.fetch_add(1, Ordering::Relaxed);
    }
    fn cancelled(&self) -> bool {
        self.1.load(Ordering::Relaxed) >= self.0
    }
}

#[test]
fn one_press_serves_all_slip_rates_largest_first() {
    let fake = Fake::default();
    let (tabulation, _) = Bench::new().run(&fake, 1, false, &Unwatched).unwrap();
    assert_eq!(*fake.presses.lock().unwrap(), [100.0, 10.0, 1.0]);
    assert_eq!(fake.slides.load(Ordering::Relaxed), 9);
    assert!(tabulation.finished());
    let cell = tabulation.cells[2][1].as_ref().unwrap().as_ref().unwrap();
    let expected = Fake::outcome(&request().scene(2, 1));
    assert_eq!(cell.cell[Quantity::Mu], expected.summary.mu);
}

#[test]
fn result_does_not_depend_on_the_number_of_threads() {
    let run = |jobs| Bench::new().run(&Fake::default(), jobs, false, &Unwatched).unwrap().0;
    let one = run(1);
    assert_eq!(one, run(2));
    assert_eq!(one, run(5));
}

#[test]
fn interrupted_tabulation_continues_to_the_same_end() {
    let whole = Bench::new().run(&Fake::default(), 1, false, &Unwatched).unwrap().0;
    let bench = Bench::new();
    let stop = StopAfter(4, AtomicUsize::new(0));
    let (partial, journal) = bench.run(&Fake::default(), 1, false, &stop).unwrap();
    drop(journal);
    assert!(!partial.finished());
    assert_eq!(partial.done().count(), 4);
    let fake = Fake::default();
    let (continued, journal) = bench.run(&fake, 2, true, &Unwatched).unwrap();
    assert_eq!(continued.resumed, 4);
    assert_eq!(fake.slides.load(Ordering::Relaxed), 5);
    // The row that was complete is not pressed again.
    assert!(!fake.presses.lock().unwrap().contains(&100.0));
    assert_eq!(continued.cells, whole.cells);
    journal.remove().unwrap();
    assert!(!bench.journal.exists());
}

#[test]
fn failures_are_kept_with_their_reason_and_stop_nothing() {
    let fake =
        Fake { press_fails: Some(1.0), slide_fails: Some(10.0), slide_panics: Some(0.1), ..Fake::default() };
    let (tabulation, _) = Bench::new().run(&fake, 2, false, &Unwatched).unwrap();
    assert!(tabulation.finished());
    let done: Vec<Index> = tabulation.done().map(|(index, _)| index).collect();
    assert_eq!(done, [(1, 1), (2, 1)]);
    let reason = |index| tabulation.failures().find(|(at, _)| *at == index).unwrap().1;
    assert_eq!(reason((0, 1)), "not supported: this press");
    assert!(reason((1, 2)).contains("did not converge"));
    assert_eq!(reason((2, 0)), "internal error: this slide panics");
}

#[test]
fn unfinished_work_is_not_overwritten_unasked() {
    let bench = Bench::new();
    bench.run(&Fake::default(), 1, false, &Unwatched).unwrap();
    let error = bench.run(&Fake::default(), 1, false, &Unwatched).err().unwrap();
    assert!(error.to_string().contains("--resume"));
}

#[test]
fn table_has_every_cell_and_says_which_failed() {
    let fake = Fake { slide_fails: Some(10.0), ..Fake::default() };
    let (mut tabulation, _) = Bench::new().run(&fake, 1, false, &Unwatched).unwrap();
    if let Some(Ok(finished)) = &mut tabulation.cells[0][0] {
        finished.warnings = vec!["of one cell".into()];
    }
    let table = tabulation.table("2000-01-01T00:00:00Z: test".into()).unwrap();
    assert_eq!(table.shape(), (3, 3));
    assert_eq!(table.axes().slip, tabulation.slips);
    let expected = Fake::outcome(&request().scene(1, 1));
    assert_eq!(table.cell(1, 1).unwrap()[Quantity::Load], expected.summary.load);
    assert!(matches!(table.status(1, 2), tables::table::Status::Failed(reason)
        if reason.contains("did not converge")));
    let metadata = table.metadata();
    assert_eq!(metadata.asperity_radius, 1e-3);
    assert_eq!(metadata.strength_factor, Some(1.0));
    assert!(metadata.comment.contains("of one cell [1 omega_c at 0.1 m/s]"));
    assert_eq!(parse_request(&metadata.scene, "attribute", &[]).unwrap(), request());
}

#[test]
fn files_differ_between_runs_in_nothing_but_wall_time() {
    let [one, other] = [1, 3].map(|jobs| {
        let bench = Bench::new();
        let (tabulation, _) = bench.run(&Fake::default(), jobs, false, &Unwatched).unwrap();
        let path = bench.journal.with_extension("nc");
        tabulation.table("same".into()).unwrap().write(&path).unwrap();
        std::fs::read(path).unwrap()
    });
    assert_eq!(one, other);
}
