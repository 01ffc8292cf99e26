//! Reference cases: what the model computes beside closed forms, published fits and independent
//! numbers, and beside what follows from its equations alone.
//!
//! One file per group; each case yields [`Row`]s. A row passes if computed and reference differ by
//! no more than the estimated error of the computed number and an allowance for what reference and
//! model do differently by construction, which the row states and bounds.

mod elastic_plastic;
mod full_stick;
mod heat;
mod hertz;
mod invariance;
mod partial_slip;
mod regression;
pub mod setup;

use crate::simulate::{SimulationError, Watch};

/// How much is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// Every group, under a minute in all.
    Quick,
    /// Every case, finely.
    Full,
}

impl Extent {
    /// n_c: 8 or 16.
    fn elements(self) -> usize {
        match self {
            Extent::Quick => 8,
            Extent::Full => 16,
        }
    }
}

/// What reference and model differ by without either being wrong.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Allowance {
    /// Absolute, in the unit of the row.
    pub bound: f64,
    pub why: &'static str,
}

/// One comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// What is compared, with its parameters.
    pub quantity: String,
    pub unit: &'static str,
    pub computed: f64,
    pub reference: f64,
    pub source: &'static str,
    /// Estimated absolute error of `computed`.
    pub error: f64,
    pub allowance: Allowance,
}

impl Row {
    fn new(
        quantity: impl Into<String>,
        computed: f64,
        error: f64,
        reference: f64,
        source: &'static str,
    ) -> Self {
        let quantity = quantity.into();
        Self { quantity, unit: "1", computed, reference, source, error, allowance: Allowance::default() }
    }

    fn unit(self, unit: &'static str) -> Self {
        Self { unit, ..self }
    }

    /// Allows a difference relative to the reference.
    fn allow(self, share: f64, why: &'static str) -> Self {
        let bound = share * self.reference.abs();
        self.allow_absolute(bound, why)
    }

    fn allow_absolute(self, bound: f64, why: &'static str) -> Self {
        Self { allowance: Allowance { bound, why }, ..self }
    }

    pub fn difference(&self) -> f64 {
        self.computed - self.reference
    }

    pub fn passes(&self) -> bool {
        // Not a number passes nothing.
        self.difference().abs() <= self.error + self.allowance.bound
    }
}

type Rows = Result<Vec<Row>, SimulationError>;

/// A group of cases.
pub struct Group {
    pub name: &'static str,
    run: fn(Extent, &dyn Watch) -> Rows,
}

/// Every group, elementary ones first.
pub const GROUPS: [Group; 7] = [
    Group { name: "Hertz", run: hertz::rows },
    Group { name: "full stick", run: full_stick::rows },
    Group { name: "elastic-plastic sphere", run: elastic_plastic::rows },
    Group { name: "partial slip", run: partial_slip::rows },
    Group { name: "heat", run: heat::rows },
    Group { name: "invariance and ledgers", run: invariance::rows },
    Group { name: "regression", run: regression::rows },
];

impl Group {
    /// Its rows; the error is of a run that did not converge or was cancelled.
    ///
    /// ```no_run
    /// use asperity::studies::verification::{Extent, GROUPS};
    ///
    /// for row in GROUPS[0].rows(Extent::Quick, &asperity::Unwatched)? {
    ///     println!("{}: {} beside {} of {}", row.quantity, row.computed, row.reference, row.source);
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn rows(&self, extent: Extent, watch: &dyn Watch) -> Rows {
        (self.run)(extent, watch)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_passes_within_error_and_allowance_only() {
        let row = |computed: f64| Row::new("x", computed, 0.01, 1.0, "source");
        assert!(row(1.009).passes() && row(0.991).passes());
        assert!(!row(1.011).passes() && !row(f64::NAN).passes());
        let wide = row(1.05).allow(0.05, "reason");
        assert!(wide.passes() && !Row { computed: 1.07, ..wide }.passes());
        assert!(!Row { error: f64::NAN, ..row(1.0) }.passes());
    }
}
