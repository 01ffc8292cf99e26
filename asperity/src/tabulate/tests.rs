//! Tabulations with a simulation that takes no time.

mod temperatures;

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use tables::quantity::Quantity;
use tables::table::{Slice, Status, Table};

use super::*;
use crate::discretisation::mesh::MeshSize;
use crate::loading::problem::Problem;
use crate::scene;
use crate::scene::file::parse_request;
use crate::scene::tests::sphere;
use crate::simulate::{Unwatched, fake};
use crate::tabulate::fake::Fake;

const GRID: &str = "[table]\ninterference = [1, 10, 100]\nslip_rate = [0.1, 1, 10]\n";
const FIVE_ROWS: &str = "[table]\ninterference = [1, 3, 10, 30, 100]\nslip_rate = [0, 1, 10]\n";
const TEMPERATURES: &str = "[table]\ninterference = [1, 3, 10, 30]\nslip_rate = [0, 10]\n\
                            temperature = [298, 500, 700]\n";
const REFINED: &str = "[table]\ninterference = [1, 100]\nslip_rate = [0.1, 100]\ntolerance = 0.02\n";

/// The outcome of a cell.
fn outcome(request: &Request, interference: f64, slip_rate: f64) -> Outcome {
    let mut scene = request.template.clone();
    (scene.loading.interference, scene.loading.slip_rate) = (interference, slip_rate);
    fake::outcome(&scene)
}

fn request(table: &str) -> Request {
    scene::tests::request(&(sphere("copper") + table), &[]).unwrap()
}

/// A tabulation in a folder of its own, which later ones may continue.
struct Bench {
    folder: tempfile::TempDir,
    request: Request,
}

impl Bench {
    fn new(request: Request) -> Self {
        Self { folder: tempfile::tempdir().unwrap(), request }
    }

    fn journal(&self) -> std::path::PathBuf {
        self.folder.path().join("table.nc.part")
    }

    fn run(
        &self,
        simulator: &Fake,
        (jobs, resume, shard): (usize, bool, Option<&str>),
        watch: &dyn TableWatch,
    ) -> Result<Tabulation, TabulateError> {
        let shard = shard.map(|shard| shard.parse().unwrap());
        let options = Options { jobs, journal: &self.journal(), resume, shard };
        tabulate_with(simulator, &self.request, &options, watch).map(|(tabulation, _)| tabulation)
    }
}

/// Undisturbed, in one part.
fn whole(table: &str, fake: &Fake, jobs: usize) -> Tabulation {
    Bench::new(request(table)).run(fake, (jobs, false, None), &Unwatched).unwrap()
}

fn table(tabulation: &Tabulation) -> Table {
    tabulation.table("history".into()).unwrap()
}

fn cells_run(tabulation: &Tabulation) -> usize {
    tabulation.cells.len()
}

/// Stops after a number of cells.
struct StopAfter(usize, AtomicUsize);

impl StopAfter {
    fn new(cells: usize) -> Self {
        Self(cells, AtomicUsize::new(0))
    }
}

impl TableWatch for StopAfter {
    fn finished(&self, _: Index, _: &CellResult, _: &CellProgress) {
        self.1.fetch_add(1, Ordering::Relaxed);
    }
}

impl Watch for StopAfter {
    fn cancelled(&self) -> bool {
        self.1.load(Ordering::Relaxed) >= self.0
    }
}

#[test]
fn one_press_serves_all_slip_rates_largest_first() {
    let hot = TEMPERATURES.replace("[1, 3, 10, 30]", "[1, 3, 10]");
    // A press within a time depends on the slip rate.
    let timed =
        format!("[loading]\npress_slip_distance = 1\n[material.rate]\nlaw = \"johnson-cook\"\n{GRID}");
    let by_three = |rows: [f64; 3]| rows.map(|row| [row; 3]).concat();
    for (text, presses, slides) in [
        (GRID, vec![100.0, 10.0, 1.0], 9),
        (&hot, by_three([10.0, 3.0, 1.0]), 18),
        (&timed, by_three([100.0, 10.0, 1.0]), 9),
    ] {
        let fake = Fake::default();
        let tabulation = whole(text, &fake, 1);
        assert_eq!(*fake.presses.lock().unwrap(), presses);
        assert_eq!(fake.slides.load(Ordering::Relaxed), slides);
        assert!(tabulation.finished());
    }
}

#[test]
fn threads_interruptions_and_shards_change_nothing() {
    let fake = || Fake { slide_fails: Some(10.0), ..Fake::default() };
    for (text, cells, failed) in [(FIVE_ROWS, 15, 5), (TEMPERATURES, 24, 12)] {
        let one = whole(text, &fake(), 1);
        assert_eq!((cells_run(&one), one.failures().count()), (cells, failed));
        // More threads than cells are divided among these, here equally: a pool may get no cell.
        for (jobs, threads) in [(2, 1), (5, 1), (2 * cells, 2), (3 * cells, 3)] {
            let fake = fake();
            assert_eq!(one, whole(text, &fake, jobs));
            assert_eq!(fake.threads.load(Ordering::Relaxed), threads);
        }
        let undivided = table(&one);

        let bench = Bench::new(request(text));
        let stopped = bench.run(&fake(), (1, false, None), &StopAfter::new(7)).unwrap();
        assert!(!stopped.finished());
        let again = fake();
        let continued = bench.run(&again, (2, true, None), &Unwatched).unwrap();
        assert_eq!(continued.resumed, 7);
        assert_eq!(again.slides.load(Ordering::Relaxed), cells - 7);
        assert_eq!(table(&continued), undivided);

        for count in [2, 3, 5, 20] {
            let (mut merged, mut shared): (Option<Table>, usize) = (None, 0);
            for k in 1..=count {
                let shard = format!("{k}/{count}");
                let bench = Bench::new(request(text));
                let tabulation = bench.run(&fake(), (2, false, Some(&shard)), &Unwatched).unwrap();
                assert!(tabulation.finished());
                shared += cells_run(&tabulation);
                let table = table(&tabulation);
                assert_eq!(table.metadata().shard, shard);
                match &mut merged {
                    None => merged = Some(table),
                    Some(merged) => merged.merge(&table).unwrap(),
                }
            }
            // No cell is run twice.
            assert_eq!(shared, cells, "{count}");
            let mut merged = merged.unwrap();
            merged.set_provenance("history", "");
            assert_eq!(merged, undivided, "{count}");
            assert_eq!(merged.checksum(), undivided.checksum(), "{count}");
        }
    }
}

/// Every thread is in one pool, and no pool has two threads more than another.
#[test]
fn threads_are_divided_among_cells() {
    for (jobs, cells, threads) in
        [(1, 0, &[1][..]), (2, 5, &[1, 1]), (5, 4, &[2, 1, 1, 1]), (8, 3, &[3, 3, 2])]
    {
        let pools = pools(jobs, cells).unwrap();
        assert!(
            pools.iter().map(rayon::ThreadPool::current_num_threads).eq(threads.iter().copied()),
            "{jobs} {cells}"
        );
    }
}

/// What shards of a request lack is computed, and nothing else.
#[test]
fn a_partly_merged_table_is_completed() {
    let fake = || Fake { slide_fails: Some(10.0), ..Fake::default() };
    let undivided = table(&whole(TEMPERATURES, &fake(), 1));
    let shard = |shard: &str| {
        let bench = Bench::new(request(TEMPERATURES));
        table(&bench.run(&fake(), (1, false, Some(shard)), &Unwatched).unwrap())
    };
    let mut partial = shard("1/3");
    partial.merge(&shard("3/3")).unwrap();
    let missing = partial.missing().len();
    assert!((1..24).contains(&missing), "{missing}");
    let bench = Bench::new(request(TEMPERATURES));
    let output = bench.folder.path().join("table.nc");
    partial.write(&output).unwrap();
    let error = completed(&bench.request, "2/3".parse().ok(), &output).unwrap_err().to_string();
    assert!(error.contains("another shard") && !bench.journal().exists(), "{error}");
    assert_eq!(completed(&bench.request, None, &output).unwrap(), None);
    let rest = fake();
    let continued = bench.run(&rest, (2, true, None), &Unwatched).unwrap();
    assert_eq!((continued.resumed, rest.slides.load(Ordering::Relaxed)), (24 - missing, missing));
    assert_eq!(table(&continued), undivided);
}

/// The limit is that of the press, which would refuse each cell.
#[test]
fn a_request_deeper_than_the_model_is_refused_before_any_press() {
    let refused = |table: &str| {
        let (bench, fake) = (Bench::new(request(table)), Fake::default());
        let error = bench.run(&fake, (1, false, None), &Unwatched).map(drop).unwrap_err();
        assert!(fake.presses.lock().unwrap().is_empty() && !bench.journal().exists());
        error.to_string()
    };
    let single = refused("[table]\ninterference = [1, 1e6]\nslip_rate = [1]\n");
    let (_, most) = single.split_once("table.interference = 1e6: must be at most about ").unwrap();
    let most = most.split(' ').next().unwrap();
    let scene = |interference: &str| {
        let mut scene = request(GRID).template;
        scene.loading.interference = interference.parse().unwrap();
        scene
    };
    let pressed = crate::simulate::press(&scene("1e6"), &Unwatched).err().unwrap().to_string();
    assert!(pressed.ends_with(&format!("goes to about {most} omega_c")), "{pressed}");
    assert_eq!(crate::simulate::largest_interference(&scene(most)), None);
    // Softer when hot, the metal yields at a smaller interference: the lowest temperature has the least.
    let several = refused("[table]\ninterference = [1, 1e6]\nslip_rate = [1]\ntemperature = [298, 500]\n");
    assert!(several.contains(&format!("at most about {most} (omega_0/omega_c) at 298 K")), "{several}");
}

#[test]
fn an_interrupted_shard_continues() {
    let bench = Bench::new(request(FIVE_ROWS));
    let run = |shard: &str, resume: bool, watch: &dyn TableWatch| {
        bench.run(&Fake::default(), (1, resume, Some(shard)), watch)
    };
    assert!(!run("2/2", false, &StopAfter::new(3)).unwrap().finished());
    let error = run("1/2", true, &Unwatched).unwrap_err().to_string();
    assert!(error.contains("it is of shard 2/2, not of shard 1/2"), "{error}");
    let continued = run("2/2", true, &Unwatched).unwrap();
    assert!(continued.finished());
    assert_eq!(continued.resumed, 3);
    let done = continued.done().count();
    assert!((7..=8).contains(&done), "{done}");
}

#[test]
fn failures_are_kept_with_their_reason_and_stop_nothing() {
    let fake =
        Fake { press_fails: Some(1.0), slide_fails: Some(10.0), slide_panics: Some(0.1), ..Fake::default() };
    let tabulation = whole(GRID, &fake, 2);
    assert!(tabulation.finished());
    let done: Vec<Index> = tabulation.done().map(|(index, _)| index).collect();
    assert_eq!(done, [(1, 1), (2, 1)]);
    let reason = |index| tabulation.failures().find(|(at, _)| *at == index).unwrap().1;
    assert_eq!(reason((0, 1)), "not supported: this press");
    assert!(reason((1, 2)).contains("did not converge"));
    assert_eq!(reason((2, 0)), "internal error: this slide panics");
}

#[test]
fn table_has_every_cell_and_says_which_failed() {
    let mut tabulation = whole(GRID, &Fake { slide_fails: Some(10.0), ..Fake::default() }, 1);
    if let Some(Ok(finished)) = tabulation.cells.get_mut(&(0, 0)) {
        finished.cell.warnings = vec!["of one cell".into()];
    }
    let table = table(&tabulation).at(None).unwrap();
    assert_eq!(table.shape(), (3, 3));
    assert_eq!(*table.axes(), tabulation.axes);
    let expected = outcome(&request(GRID), 10.0, 1.0);
    assert_eq!(table.cell(1, 1).unwrap()[Quantity::Load], expected.scalars[Quantity::Load]);
    assert!(matches!(table.status(1, 2), Status::Failed(reason) if reason.contains("did not converge")));
    let metadata = table.metadata();
    assert_eq!(metadata.asperity_radius, 1e-3);
    assert_eq!((metadata.strength_factor, metadata.film_strength), (Some(1.0), None));
    assert!(metadata.comment.contains("of one cell [1 omega_c at 0.1 m/s]"));
    assert_eq!(parse_request(&metadata.scene, "attribute", &[]).unwrap(), request(GRID));
    let hot = whole(TEMPERATURES, &Fake::default(), 1);
    assert_eq!(hot.label((4, 1)), "1 omega_c at 10 m/s from 500 K");
}

/// Without friction the strength of the metal limits nothing.
#[test]
fn a_table_states_the_limit_of_its_interface() {
    for (friction, expected) in [("0.0", (None, None, None)), ("0.2", (Some(1.0), Some(0.0), Some(0.2)))] {
        let request = format!("{GRID}[interface]\nlaw = \"coulomb\"\nfriction = {friction}\n");
        let slice = table(&whole(&request, &Fake::default(), 1)).at(None).unwrap();
        let metadata = slice.metadata();
        let found = (metadata.strength_factor, metadata.film_strength, metadata.pressure_coefficient);
        assert_eq!(found, expected, "{friction}");
    }
}

#[test]
fn points_are_added_for_a_tolerance() {
    let fake = Fake::default();
    let one = whole(REFINED, &fake, 1);
    // Power laws of the interference need no more points, the slip rate does.
    assert!(one.axes.slip_rate.len() > 5, "{:?}", one.axes.slip_rate);
    assert!(one.axes.interference.len() <= 3, "{:?}", one.axes.interference);
    assert_eq!(fake.slides.load(Ordering::Relaxed), one.axes.interference.len() * one.axes.slip_rate.len());
    assert_eq!(one, whole(REFINED, &Fake::default(), 5));
    let table = table(&one).at(None).unwrap();
    assert_eq!(table.metadata().interpolation_tolerance, Some(0.02));
    for rate in [0.13, 0.7, 2.5, 9.0, 40.0, 88.0] {
        let estimate = table.estimate(Quantity::Mu, 1e-3, 33.0, rate).unwrap();
        let truth = outcome(&one.request, 33.0, rate).scalars[Quantity::Mu].value;
        assert!((estimate.value / truth - 1.0).abs() < 0.02, "{rate}");
        // 1 % of the runs around it, and the error of interpolation.
        assert!(
            estimate.error > 0.99 * 0.01 * truth && estimate.error < 0.031 * truth,
            "{rate}: {estimate:?}"
        );
    }
    // The request is stored unchanged.
    assert_eq!(parse_request(&table.metadata().scene, "attribute", &[]).unwrap(), one.request);
    assert_eq!(one.request.interferences, [1.0, 100.0]);

    let bench = Bench::new(request(REFINED));
    let stopped = bench.run(&Fake::default(), (1, false, None), &StopAfter::new(11)).unwrap();
    assert!(!stopped.finished());
    let continued = bench.run(&Fake::default(), (2, true, None), &Unwatched).unwrap();
    assert_eq!(continued.resumed, 11);
    assert_eq!((continued.cells, continued.axes), (one.cells, one.axes));
}

#[test]
fn refinement_states_its_shortfall_and_cannot_be_divided() {
    let tabulation = whole(&format!("{REFINED}max_cells = 8\n"), &Fake::default(), 2);
    assert!(cells_run(&tabulation) <= 8);
    let warning = "interpolation of mu is good to";
    assert!(tabulation.warnings().iter().any(|text| text.starts_with(warning)));
    assert!(table(&tabulation).metadata().comment.contains(warning));

    let bench = Bench::new(request(REFINED));
    let error = bench.run(&Fake::default(), (1, false, Some("1/2")), &Unwatched).unwrap_err();
    assert!(error.to_string().starts_with("--shard 1/2: table.tolerance"), "{error}");
    assert!(!bench.journal().exists());
}

#[test]
fn time_remaining_is_reported() {
    struct Reported(Mutex<Vec<CellProgress>>);
    impl Watch for Reported {}
    impl TableWatch for Reported {
        fn finished(&self, _: Index, _: &CellResult, progress: &CellProgress) {
            self.0.lock().unwrap().push(*progress);
        }
    }
    let reported = Reported(Vec::new().into());
    Bench::new(request(GRID)).run(&Fake::default(), (1, false, None), &reported).unwrap();
    let reported = reported.0.into_inner().unwrap();
    assert_eq!(reported.iter().map(|progress| progress.done).collect::<Vec<_>>(), Vec::from_iter(1..=9));
    assert!(reported.iter().all(|progress| progress.total == 9));
    assert!(reported[..8].iter().all(|progress| progress.remaining > 0.0));
    assert_eq!(reported[8].remaining, 0.0);
}

/// Requests without interferences end where the mesh fills the hemisphere: twice the largest has no room.
#[test]
fn default_requests_reach_as_far_as_the_hemisphere() {
    for preset in crate::scene::presets::names() {
        let request = scene::tests::request(&(sphere(preset) + "[table]\n"), &[]).unwrap();
        let largest = *request.interferences.last().unwrap();
        let fits = |interference: f64| {
            let mut scene = request.template.clone();
            scene.loading.interference = interference;
            MeshSize::new(Problem::new(&scene).expected_contact_radius(), 12).fits()
        };
        assert!(fits(largest) && !fits(2.0 * largest), "{preset}: {largest}");
    }
}
