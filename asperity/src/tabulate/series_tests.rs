//! Tabulations over initial temperature, with a simulation that takes no time and once with the real one.

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use tables::quantity::Quantity;
use tables::table::Table;

use super::*;
use crate::scene::file::parse_request;
use crate::simulate::Unwatched;
use crate::simulate::fake::Fake;

const REQUEST: &str = "[material]\npreset = \"titanium-6al4v\"\n[asperity]\nradius = 1e-3\n\
                       [table]\ninterference = [1, 3, 10, 30]\nslip_rate = [0, 10]\n\
                       temperature = [298, 500, 700]\n";

fn run<S: Simulator>(
    simulator: &S,
    text: &str,
    (journal, jobs, resume, shard): (&Path, usize, bool, Option<&str>),
    watch: &dyn TableWatch,
) -> Tabulation {
    let request = parse_request(text, "request.toml", &[]).unwrap();
    let shard = shard.map(|shard| shard.parse().unwrap());
    let options = Options { jobs, journal, resume, shard };
    tabulate_with(simulator, &request, &options, watch).unwrap().0
}

fn table_of(tabulation: &Tabulation) -> Table {
    tabulation.table("history".into()).unwrap()
}

/// Without what the clock says.
fn timeless(table: Table) -> Table {
    let members = table.slices().iter().map(|member| {
        let mut member = member.clone();
        let (rows, columns) = member.shape();
        for (i, j) in (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j))) {
            if let Some(cell) = member.cell(i, j) {
                let mut cell = cell.clone();
                cell.wall_time = 0.0;
                member.set_cell(i, j, cell).unwrap();
            }
        }
        member
    });
    Table::new(members.collect()).unwrap()
}

/// Stops after a number of cells.
struct StopAfter(usize, AtomicUsize);

impl TableWatch for StopAfter {
    fn finished(&self, _: Index, _: &CellResult, progress: &CellProgress) {
        assert_eq!(progress.total, 24);
        self.1.fetch_add(1, Ordering::Relaxed);
    }
    fn cancelled(&self) -> bool {
        self.1.load(Ordering::Relaxed) >= self.0
    }
}

#[test]
fn every_temperature_has_the_table_of_its_own_request() {
    let folder = tempfile::tempdir().unwrap();
    let whole =
        table_of(&run(&Fake::default(), REQUEST, (&folder.path().join("all"), 2, false, None), &Unwatched));
    let request = parse_request(REQUEST, "request.toml", &[]).unwrap();
    for (k, member) in whole.slices().iter().enumerate() {
        let temperature = request.temperatures[k];
        let alone = write_request(&request.at_temperature(temperature));
        let place = folder.path().join(format!("{k}"));
        let alone = run(&Fake::default(), &alone, (&place, 1, false, None), &Unwatched);
        let alone = alone.table("history".into()).unwrap().at(None).unwrap();
        assert_eq!(alone.compare(member).quantities, []);
        // But for the texts that name the other temperatures.
        let numbers = |table: &Slice| {
            let mut table = table.clone();
            let metadata = table.metadata().clone();
            let [title, scene] = [String::new(), String::new()];
            table.set_metadata(tables::table::Metadata { title, scene, ..metadata });
            table
        };
        assert_eq!(numbers(&alone), numbers(member), "{temperature}");
    }
    assert!(whole.slices()[2].metadata().yield_strength < 0.8 * whole.slices()[0].metadata().yield_strength);
    let kept = parse_request(&whole.slices()[1].metadata().scene, "attribute", &[]).unwrap();
    assert_eq!(kept, request);
}

#[test]
fn the_largest_interference_of_all_temperatures_comes_first() {
    let folder = tempfile::tempdir().unwrap();
    let text = REQUEST.replace("[1, 3, 10, 30]", "[1, 3, 10]");
    let fake = Fake::default();
    run(&fake, &text, (&folder.path().join("journal"), 1, false, None), &Unwatched);
    assert_eq!(*fake.presses.lock().unwrap(), [10.0, 10.0, 10.0, 3.0, 3.0, 3.0, 1.0, 1.0, 1.0]);
}

#[test]
fn threads_interruptions_and_shards_change_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name);
    let fake = || Fake { slide_fails: Some(10.0), ..Fake::default() };
    let whole = table_of(&run(&fake(), REQUEST, (&place("whole"), 1, false, None), &Unwatched));
    assert_eq!(whole, table_of(&run(&fake(), REQUEST, (&place("threads"), 5, false, None), &Unwatched)));

    let stop = StopAfter(7, AtomicUsize::new(0));
    let stopped = run(&fake(), REQUEST, (&place("stopped"), 1, false, None), &stop);
    assert!(!stopped.finished());
    let continued = run(&fake(), REQUEST, (&place("stopped"), 2, true, None), &Unwatched);
    assert_eq!(continued.resumed, 7);
    assert_eq!(table_of(&continued), whole);
    assert_eq!(continued.failures().count(), 12);
    let (at, _) = continued.failures().next().unwrap();
    assert_eq!(continued.label(at), "1 omega_c at 10 m/s from 298 K");

    for count in [2, 5] {
        let mut cells = 0;
        let shards: Vec<Table> = (1..=count)
            .map(|k| {
                let shard = format!("{k}/{count}");
                let journal = place(&shard.replace('/', "-"));
                let tabulation = run(&fake(), REQUEST, (&journal, 2, false, Some(&shard)), &Unwatched);
                cells += tabulation.cells.iter().flatten().flatten().count();
                table_of(&tabulation)
            })
            .collect();
        assert_eq!(cells, 24);
        let mut merged = shards[count - 1].clone();
        for shard in &shards[..count - 1] {
            merged.merge(shard).unwrap();
        }
        merged.set_provenance("history", "");
        assert_eq!(merged.checksum(), whole.checksum());
        assert_eq!(merged, whole);
    }
}

/// Coarse and short, for a look at what comes out rather than at how true it is.
const COARSE: &str = "[material]\npreset = \"steel-4340\"\n[asperity]\nradius = 1e-3\n\
                      [loading]\nslip_distance = 0.05\n[model]\nheat = \"on\"\n\
                      [table]\ninterference = [2, 8]\nslip_rate = [1]\ntemperature = [298, 600, 900]\n\
                      [numerics]\nelements_per_radius = 4\nsectors = 4\n";

#[test]
fn computed_between_the_temperatures_a_table_agrees_with_the_interpolated_one() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name);
    let whole = run(&FiniteElements, COARSE, (&place("whole"), 2, false, None), &Unwatched);
    let whole = timeless(table_of(&whole));
    let request = parse_request(COARSE, "request.toml", &[]).unwrap();
    let computed = |temperature: f64| {
        let text = write_request(&request.at_temperature(temperature));
        let table =
            run(&FiniteElements, &text, (&place(&format!("{temperature}")), 2, false, None), &Unwatched);
        table.table("history".into()).unwrap().at(None).unwrap()
    };
    // At one of the temperatures bit for bit.
    let (alone, member) = (computed(600.0), whole.at(600.0).unwrap());
    for i in 0..2 {
        let mut cell = alone.cell(i, 0).unwrap().clone();
        cell.wall_time = 0.0;
        assert_eq!(&cell, member.cell(i, 0).unwrap());
    }
    for (number, other) in [
        (alone.metadata().critical_interference, member.metadata().critical_interference),
        (alone.metadata().contact_modulus, member.metadata().contact_modulus),
        (alone.metadata().yield_strength, member.metadata().yield_strength),
    ] {
        assert_eq!(number.to_bits(), other.to_bits());
    }
    // Between them within the errors.
    for temperature in [420.0, 780.0] {
        let (alone, between) = (computed(temperature), whole.at(temperature).unwrap());
        for i in 0..2 {
            for quantity in [Quantity::Mu, Quantity::Friction, Quantity::Load, Quantity::TemperatureMax] {
                let (truth, found) =
                    (alone.cell(i, 0).unwrap()[quantity], between.cell(i, 0).unwrap()[quantity]);
                let difference = (truth.value - found.value).abs();
                println!(
                    "{temperature} {i} {quantity:?}: {:e} {:e} off by {difference:e} of {:e}, run {:e}",
                    truth.value, found.value, found.error, truth.error
                );
                assert!(difference <= found.error, "{temperature} {i} {quantity:?}: {truth:?} {found:?}");
            }
        }
        let strength = alone.metadata().yield_strength;
        assert!((between.metadata().yield_strength / strength - 1.0).abs() < 2e-3, "{strength}");
    }
}
