//! One comparison with a reference, and its two verdicts.

use tables::law::Estimate;

/// A published or derived value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    /// Value in the unit of the row.
    pub value: f64,
    /// Absolute: uncertainty of the value, and what model and reference differ by by construction.
    pub uncertainty: f64,
    /// Author, year and DOI or section.
    pub source: &'static str,
}

impl Reference {
    /// A closed form of the problem that is computed.
    pub fn exact(value: f64, source: &'static str) -> Self {
        Self { value, uncertainty: 0.0, source }
    }

    /// Known to `share` of its value.
    pub fn known_to(self, share: f64) -> Self {
        Self { uncertainty: share * self.value.abs(), ..self }
    }
}

/// Largest difference from the reference with which a row passes: a number fixed before the run, from the uncertainty
/// of the reference and the discretisation error to expect at the mesh of the row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    bound: f64,
    relative: bool,
    /// What the number is made of.
    pub reason: &'static str,
}

impl Tolerance {
    /// Relative to the reference.
    pub const fn relative(bound: f64, reason: &'static str) -> Self {
        Self { bound, relative: true, reason }
    }

    /// Absolute tolerance in the unit of the row.
    pub const fn absolute(bound: f64, reason: &'static str) -> Self {
        Self { bound, relative: false, reason }
    }
}

/// A computed value, with the error that the program states for it where it states one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Computed {
    value: f64,
    stated_error: Option<f64>,
}

impl From<Estimate> for Computed {
    fn from(estimate: Estimate) -> Self {
        Self { value: estimate.value, stated_error: Some(estimate.error) }
    }
}

impl From<f64> for Computed {
    fn from(value: f64) -> Self {
        Self { value, stated_error: None }
    }
}

/// One comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// What is compared, with its parameters.
    pub quantity: String,
    pub unit: &'static str,
    pub computed: f64,
    pub reference: Reference,
    pub tolerance: Tolerance,
    /// Absolute error that the program states for `computed`; it has no influence on [`Row::passes`].
    pub stated_error: Option<f64>,
}

impl Row {
    pub fn new(
        quantity: impl Into<String>,
        computed: impl Into<Computed>,
        reference: Reference,
        tolerance: Tolerance,
    ) -> Self {
        let Computed { value, stated_error } = computed.into();
        Self { quantity: quantity.into(), unit: "1", computed: value, reference, tolerance, stated_error }
    }

    pub fn unit(self, unit: &'static str) -> Self {
        Self { unit, ..self }
    }

    /// Computed − reference.
    pub fn deviation(&self) -> f64 {
        self.computed - self.reference.value
    }

    /// The tolerance in the unit of the row.
    pub fn allowed(&self) -> f64 {
        let Tolerance { bound, relative, .. } = self.tolerance;
        if relative { bound * self.reference.value.abs() } else { bound }
    }

    /// Whether the deviation is within the tolerance; not a number is not.
    pub fn passes(&self) -> bool {
        self.deviation().abs() <= self.allowed()
    }

    /// Whether the stated error, a finite one, covers the deviation up to the uncertainty of the reference; nothing
    /// where the program states no error.
    pub fn covered(&self) -> Option<bool> {
        let stated = self.stated_error?;
        Some(stated.is_finite() && self.deviation().abs() <= stated + self.reference.uncertainty)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(value: f64, error: f64) -> Row {
        let reference = Reference::exact(2.0, "source");
        Row::new("x", Estimate { value, error }, reference, Tolerance::relative(0.01, "mesh"))
    }

    #[test]
    fn a_row_passes_by_its_tolerance_alone() {
        for error in [0.0, 0.01, 1e6, f64::INFINITY, f64::NAN] {
            assert!(row(2.019, error).passes() && row(1.981, error).passes());
            assert!(!row(2.021, error).passes() && !row(1.979, error).passes());
            assert!(!row(f64::NAN, error).passes() && !row(f64::INFINITY, error).passes());
        }
        let absolute = Row { tolerance: Tolerance::absolute(0.03, "mesh"), ..row(2.021, 0.0) };
        assert!(absolute.passes());
    }

    #[test]
    fn a_stated_error_is_judged_for_itself() {
        assert_eq!(row(2.03, 0.04).covered(), Some(true));
        assert_eq!(row(2.03, 0.02).covered(), Some(false));
        let uncertain = Row { reference: Reference::exact(2.0, "fit").known_to(0.01), ..row(2.03, 0.02) };
        assert_eq!(uncertain.covered(), Some(true));
        // A missing estimate does not cover any deviation, even of the exact value.
        for error in [f64::INFINITY, f64::NAN] {
            assert_eq!(row(2.0, error).covered(), Some(false));
        }
        let none = Row::new("x", 2.0, Reference::exact(2.0, "source"), Tolerance::absolute(0.0, "exact"));
        assert_eq!((none.covered(), none.passes()), (None, true));
    }
}
