//! The same table, bit for bit, on one thread and on two.
//!
//! Problem: 4340 steel, 2 interferences × 2 slip rates on a coarse mesh, tabulated twice from
//! the start. Source: a cell depends on its scene alone; every sum has a fixed order.

use asperity::scene::FrictionLaw;
use asperity::scene::file::Request;
use asperity::simulate::Unwatched;
use asperity::tabulate::{Options, Tabulation, tabulate};
use tables::quantity::Quantity;
use tests::{mesh, scene, steel_4340};

fn tabulated(jobs: usize) -> Tabulation {
    let mut template = scene(steel_4340(), FrictionLaw::ShearStrength, 1.0, mesh(4, 4));
    template.interface.taylor_quinney = 0.9;
    template.loading.slip_rate = 1.0;
    template.loading.slip_distance = 0.2;
    let request = Request {
        template,
        interferences: vec![1.0, 10.0],
        slip_rates: vec![1.0, 10.0],
        temperatures: Vec::new(),
        goal: None,
    };
    let folder = tempfile::tempdir().unwrap();
    let journal = folder.path().join("journal");
    let options = Options { jobs, journal: &journal, resume: false, shard: None };
    tabulate(&request, &options, &Unwatched).unwrap().0
}

#[test]
fn two_threads_give_the_numbers_of_one() {
    let (one, two) = (tabulated(1), tabulated(2));
    assert!(one.finished() && one.failures().count() == 0);
    assert_eq!(one.slips, two.slips);
    assert_eq!(one.done().count(), 4);
    for ((index, a), (other, b)) in one.done().zip(two.done()) {
        assert_eq!(index, other);
        for quantity in Quantity::SCALARS {
            let bits = |x: f64| x.to_bits();
            assert_eq!(bits(a.cell[quantity].value), bits(b.cell[quantity].value), "{quantity:?}");
            assert_eq!(bits(a.cell[quantity].error), bits(b.cell[quantity].error), "{quantity:?}");
        }
        for quantity in Quantity::TABLE_HISTORIES {
            let bits = |x: &[f64]| x.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(a.cell.history(quantity)), bits(b.cell.history(quantity)), "{quantity:?}");
        }
        assert_eq!((&a.notes, &a.cell.warnings), (&b.notes, &b.cell.warnings));
    }
}
