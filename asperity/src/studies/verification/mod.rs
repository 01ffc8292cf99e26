//! The reference suite: results of the model against closed forms, published fits, independent solutions, and
//! consequences of its equations (book, chapter "Verification").
//!
//! One file per group. A [`Case`] runs a few simulations and yields [`Row`]s, each with its source and with a tolerance
//! fixed before the run. `asperity verify` and `cargo test` run the same cases. The error that the program states for a
//! value is evaluated in a separate column, see [`Row::covered`].
//!
//! Discretisation errors that the tolerances are made of, relative, with n_c elements per contact radius: forces
//! 0.5 n_c^-1.5 (square-root edge of the pressure), 2.2 % at 8, 1.2 % at 12 and 0.8 % at 16; areas 0.09/n_c (edge of
//! the contact placed to 0.07 ring spacings of a/(3 n_c) rms, twice that as the largest), 1.2, 0.8 and 0.6 %.

mod counterface;
mod elastic_plastic;
mod full_stick;
mod half_space;
mod heat_source;
mod hertz;
mod interface_law;
mod invariance;
pub(in crate::studies) mod ledgers;
mod partial_slip;
mod programmes;
mod regression;
mod row;
pub mod setup;
mod softening;
mod static_friction;
mod strain_rate;

pub use row::{Computed, Reference, Row, Tolerance};

use crate::simulate::{SimulationError, Watch};

/// What a case costs on one processor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cost {
    /// Under a few seconds: `asperity verify --quick`.
    Quick,
    /// Some ten seconds: `cargo test` runs these, too.
    Medium,
    /// Longer.
    Long,
}

type Rows = Result<Vec<Row>, SimulationError>;

/// The rows of several runs.
fn joined(parts: impl IntoIterator<Item = Rows>) -> Rows {
    Ok(parts.into_iter().collect::<Result<Vec<_>, _>>()?.concat())
}

/// Simulations and the rows read from them.
#[derive(Clone, Copy)]
pub struct Case {
    pub name: &'static str,
    pub cost: Cost,
    /// Computes the rows; the error is of a run that did not converge or was cancelled.
    run: fn(&dyn Watch) -> Rows,
}

impl Case {
    const fn new(name: &'static str, cost: Cost, run: fn(&dyn Watch) -> Rows) -> Self {
        Self { name, cost, run }
    }
}

/// Cases of one kind.
pub struct Group {
    pub name: &'static str,
    pub cases: &'static [Case],
}

/// Every group, elementary ones first.
pub const GROUPS: [Group; 14] = [
    Group { name: "Hertz", cases: &hertz::CASES },
    Group { name: "full stick", cases: &full_stick::CASES },
    Group { name: "elastic-plastic sphere", cases: &elastic_plastic::CASES },
    Group { name: "partial slip", cases: &partial_slip::CASES },
    Group { name: "interface laws and load control", cases: &interface_law::CASES },
    Group { name: "static friction", cases: &static_friction::CASES },
    Group { name: "heat source", cases: &heat_source::CASES },
    Group { name: "counterface", cases: &counterface::CASES },
    Group { name: "thermal softening", cases: &softening::CASES },
    Group { name: "strain rate", cases: &strain_rate::CASES },
    Group { name: "programmes", cases: &programmes::CASES },
    Group { name: "invariance", cases: &invariance::CASES },
    Group { name: "ledgers", cases: &ledgers::CASES },
    Group { name: "regression", cases: &regression::CASES },
];

impl Group {
    /// The rows of the cases that cost at most `most`.
    ///
    /// ```no_run
    /// use asperity::studies::verification::{Cost, GROUPS};
    ///
    /// for row in GROUPS[0].rows(Cost::Quick, &asperity::Unwatched)? {
    ///     println!("{}: {}, reference {}", row.quantity, row.computed, row.reference.value);
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn rows(&self, most: Cost, watch: &dyn Watch) -> Rows {
        joined(self.cases.iter().filter(|case| case.cost <= most).map(|case| (case.run)(watch)))
    }
}

/// How many rows pass, and how many of the stated errors cover the deviation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tally {
    pub rows: usize,
    pub passed: usize,
    /// Rows with a stated error.
    pub stated: usize,
    pub covered: usize,
}

impl Tally {
    pub fn of(rows: &[Row]) -> Self {
        let count = |is: fn(&Row) -> bool| rows.iter().filter(|row| is(row)).count();
        Self {
            rows: rows.len(),
            passed: count(Row::passes),
            stated: count(|row| row.stated_error.is_some()),
            covered: count(|row| row.covered() == Some(true)),
        }
    }
}
