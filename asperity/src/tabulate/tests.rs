//! Tabulations with a simulation that takes no time.

use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use tables::quantity::Quantity;

use super::*;
use crate::scene::file::parse_request;
use crate::simulate::Unwatched;
use crate::simulate::fake::Fake;

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
        let options = Options { jobs, journal: &self.journal, resume, shard: None };
        tabulate_with(fake, &request(), &options, watch)
    }
}

/// Stops after a number of cells.
struct StopAfter(usize, AtomicUsize);

impl TableWatch for StopAfter {
    fn finished(&self, _: Index, _: &CellResult, _: &CellProgress) {
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
    assert_eq!(cell.cell[Quantity::Mu], expected.scalars[Quantity::Mu]);
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
    let table = tabulation.table("2000-01-01T00:00:00Z: test".into()).unwrap().at(None).unwrap();
    assert_eq!(table.shape(), (3, 3));
    assert_eq!(table.axes().slip, tabulation.slips);
    let expected = Fake::outcome(&request().scene(1, 1));
    assert_eq!(table.cell(1, 1).unwrap()[Quantity::Load], expected.scalars[Quantity::Load]);
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

/// A table of one shard of five interferences, or of all of them.
fn shard_of(text: &str, shard: Option<&str>) -> (Tabulation, tables::table::Table) {
    let request = parse_request(text, "request.toml", &[]).unwrap();
    let bench = Bench::new();
    let shard = shard.map(|shard| shard.parse().unwrap());
    let options = Options { jobs: 2, journal: &bench.journal, resume: false, shard };
    let fake = Fake { slide_fails: Some(10.0), ..Fake::default() };
    let (tabulation, _) = tabulate_with(&fake, &request, &options, &Unwatched).unwrap();
    assert!(tabulation.finished());
    let table = tabulation.table("history".into()).unwrap();
    (tabulation, table)
}

const FIVE_ROWS: &str = "[material]\npreset = \"copper\"\n[asperity]\nradius = 1e-3\n\
                         [table]\ninterference = [1, 3, 10, 30, 100]\nslip_rate = [0, 1, 10]\n";

#[test]
fn shards_merge_to_the_undivided_table_bit_for_bit() {
    let (_, whole) = shard_of(FIVE_ROWS, None);
    for count in [2, 3, 15, 20] {
        let mut merged: Option<tables::table::Table> = None;
        let mut cells = 0;
        for k in 1..=count {
            let (tabulation, table) = shard_of(FIVE_ROWS, Some(&format!("{k}/{count}")));
            assert_eq!(table.metadata().shard, format!("{k}/{count}"));
            cells += tabulation.cells.iter().flatten().flatten().count();
            match &mut merged {
                None => merged = Some(table),
                Some(merged) => merged.merge(&table).unwrap(),
            }
        }
        // No cell is run twice.
        assert_eq!(cells, 15, "{count}");
        let mut merged = merged.unwrap();
        merged.set_provenance("history", "");
        assert_eq!(merged, whole, "{count}");
        assert_eq!(merged.checksum(), whole.checksum(), "{count}");
    }
}

#[test]
fn an_interrupted_shard_continues() {
    let request = parse_request(FIVE_ROWS, "request.toml", &[]).unwrap();
    let bench = Bench::new();
    let run = |shard: &str, resume: bool, watch: &dyn TableWatch| {
        let options = Options { jobs: 1, journal: &bench.journal, resume, shard: shard.parse().ok() };
        tabulate_with(&Fake::default(), &request, &options, watch).map(|(tabulation, _)| tabulation)
    };
    let stopped = run("2/2", false, &StopAfter(3, AtomicUsize::new(0))).unwrap();
    assert!(!stopped.finished());
    let error = run("1/2", true, &Unwatched).unwrap_err().to_string();
    assert!(error.contains("it is of shard 2/2, not of shard 1/2"), "{error}");
    let continued = run("2/2", true, &Unwatched).unwrap();
    assert!(continued.finished());
    assert_eq!(continued.resumed, 3);
    let done = continued.done().count();
    assert!((7..=8).contains(&done), "{done}");
}

const REFINED: &str = "[material]\npreset = \"copper\"\n[asperity]\nradius = 1e-3\n\
                       [table]\ninterference = [1, 100]\nslip_rate = [0.1, 100]\ntolerance = 0.02\n";

fn refined(jobs: usize, watch: &dyn TableWatch, bench: &Bench, resume: bool) -> (Tabulation, Fake) {
    let request = parse_request(REFINED, "request.toml", &[]).unwrap();
    let options = Options { jobs, journal: &bench.journal, resume, shard: None };
    let fake = Fake::default();
    let (tabulation, _) = tabulate_with(&fake, &request, &options, watch).unwrap();
    (tabulation, fake)
}

#[test]
fn points_are_added_for_a_tolerance_whatever_the_number_of_threads() {
    let (one, fake) = refined(1, &Unwatched, &Bench::new(), false);
    // Power laws of the interference need no more points, the slip rate does.
    assert!(one.slip_rates.len() > 5, "{:?}", one.slip_rates);
    assert!(one.interferences.len() <= 3, "{:?}", one.interferences);
    assert_eq!(fake.slides.load(Ordering::Relaxed), one.interferences.len() * one.slip_rates.len());
    assert_eq!(one.cells, refined(5, &Unwatched, &Bench::new(), false).0.cells);
    let table = one.table(String::new()).unwrap().at(None).unwrap();
    assert_eq!(table.metadata().interpolation_tolerance, Some(0.02));
    for rate in [0.13, 0.7, 2.5, 9.0, 40.0, 88.0] {
        let estimate = table.estimate(Quantity::Mu, 1e-3, 33.0, rate).unwrap();
        let mut scene = one.request.template.clone();
        scene.loading.interference = 33.0;
        scene.loading.slip_rate = rate;
        let truth = Fake::outcome(&scene).scalars[Quantity::Mu].value;
        assert!((estimate.value / truth - 1.0).abs() < 0.02, "{rate}");
        // 1 % of its own, and what interpolation adds.
        assert!(estimate.error > 0.01 * truth && estimate.error < 0.031 * truth, "{rate}: {estimate:?}");
    }
    // The request is kept as it was asked.
    let kept = parse_request(&table.metadata().scene, "attribute", &[]).unwrap();
    assert_eq!(kept, one.request);
    assert_eq!(kept.interferences, [1.0, 100.0]);
}

#[test]
fn refinement_that_was_interrupted_ends_the_same() {
    let whole = refined(1, &Unwatched, &Bench::new(), false).0;
    let bench = Bench::new();
    let stop = StopAfter(11, AtomicUsize::new(0));
    let stopped = refined(1, &stop, &bench, false).0;
    assert!(!stopped.finished());
    let continued = refined(2, &Unwatched, &bench, true).0;
    assert_eq!(continued.resumed, 11);
    assert_eq!(continued.cells, whole.cells);
    assert_eq!(continued.slip_rates, whole.slip_rates);
}

#[test]
fn refinement_says_if_it_falls_short_and_cannot_be_divided() {
    let text = format!("{REFINED}max_cells = 12\n");
    let (tabulation, table) = shard_of(&text, None);
    assert!(tabulation.cells.iter().flatten().count() <= 12);
    let warning = "interpolation of mu is good to";
    assert!(tabulation.warnings().iter().any(|text| text.starts_with(warning)));
    assert!(table.metadata().comment.contains(warning));

    let request = parse_request(REFINED, "request.toml", &[]).unwrap();
    let bench = Bench::new();
    let shard = "1/2".parse().ok();
    let options = Options { jobs: 1, journal: &bench.journal, resume: false, shard };
    let error = tabulate_with(&Fake::default(), &request, &options, &Unwatched).err().unwrap();
    assert!(error.to_string().starts_with("--shard 1/2: table.tolerance"), "{error}");
    assert!(!bench.journal.exists());
}

#[test]
fn time_remaining_is_told() {
    struct Told(std::sync::Mutex<Vec<CellProgress>>);
    impl TableWatch for Told {
        fn finished(&self, _: Index, _: &CellResult, progress: &CellProgress) {
            self.0.lock().unwrap().push(*progress);
        }
    }
    let told = Told(Vec::new().into());
    Bench::new().run(&Fake::default(), 1, false, &told).unwrap();
    let told = told.0.into_inner().unwrap();
    assert_eq!(told.iter().map(|progress| progress.done).collect::<Vec<_>>(), (1..=9).collect::<Vec<_>>());
    assert!(told.iter().all(|progress| progress.total == 9));
    assert!(told[..8].iter().all(|progress| progress.remaining > 0.0));
    assert_eq!(told[8].remaining, 0.0);
}
