//! Values with errors, keyed by quantity.

use std::ops::{Index, IndexMut};

use super::Quantity;

/// Errors over standard uncertainties: of 95 % intervals (JCGM 100:2008, 6.2.1).
pub const COVERAGE_FACTOR: f64 = 2.0;
/// Standard uncertainty over the bound of an error, 1/√3: rectangular distribution (JCGM 100:2008, 4.3.7).
pub const OF_BOUND: f64 = 0.577_350_269_189_625_8;

/// A number with its absolute error, the half-width of its 95 % interval, both in the same unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// Its absolute error.
    pub error: f64,
}

impl Estimate {
    /// Neither value nor error is known.
    pub const UNKNOWN: Self = Self { value: f64::NAN, error: f64::NAN };

    /// A value without error.
    pub const fn exact(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    /// A value whose error is the sum of the magnitudes of its contributions, and so never negative.
    pub fn with_errors(value: f64, contributions: impl IntoIterator<Item = f64>) -> Self {
        Self { value, error: contributions.into_iter().map(f64::abs).sum() }
    }

    /// Times a number.
    pub fn scaled(self, factor: f64) -> Self {
        Self { value: self.value * factor, error: self.error * factor.abs() }
    }

    /// The product of two numbers whose errors have the same sign.
    pub fn times(self, other: Self) -> Self {
        Self::with_errors(self.value * other.value, [self.error * other.value, self.value * other.error])
    }

    /// The quotient of two numbers whose errors have opposite signs.
    ///
    /// ```
    /// use tables::quantity::Estimate;
    ///
    /// let (energy, area) = (Estimate { value: -3.0, error: 0.3 }, Estimate { value: 2.0, error: 0.1 });
    /// let found = energy.over(area);
    /// assert_eq!(found.value, -1.5);
    /// assert!((found.error - 0.225).abs() < 1e-15);
    /// ```
    pub fn over(self, divisor: Self) -> Self {
        let value = self.value / divisor.value;
        Self::with_errors(value, [self.error / divisor.value, value * divisor.error / divisor.value])
    }

    /// The estimate with its unit, for JSON.
    pub fn in_unit(self, unit: &str) -> WithUnit<'_> {
        // Sums of nothing are -0, which JSON would show.
        WithUnit { value: self.value + 0.0, error: self.error, unit }
    }
}

/// A number with its error and unit, as JSON shows it: `{"value": …, "error": …, "unit": …}`, null for numbers that are
/// not finite.
///
/// ```
/// use tables::quantity::Estimate;
///
/// let load = Estimate { value: 2.0, error: f64::NAN }.in_unit("N");
/// assert_eq!((load.value, load.unit), (2.0, "N"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct WithUnit<'a> {
    /// The number.
    pub value: f64,
    /// Its absolute error.
    pub error: f64,
    /// UDUNITS notation.
    pub unit: &'a str,
}

/// Equal, or both unknown.
pub(crate) fn same(a: f64, b: f64) -> bool {
    a == b || (a.is_nan() && b.is_nan())
}

/// An estimate of every scalar quantity of [`Quantity::SCALARS`].
///
/// ```
/// use tables::quantity::{Estimate, Quantity, Scalars};
///
/// let mut scalars = Scalars::default();
/// scalars[Quantity::Mu] = Estimate { value: 0.3, error: 0.01 };
/// assert!(scalars[Quantity::Load].value.is_nan());
/// assert_eq!(scalars.iter().filter(|(_, estimate)| estimate.value.is_finite()).count(), 1);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Scalars([Estimate; Quantity::SCALARS.len()]);

impl Scalars {
    /// The estimate of each quantity by a formula.
    pub fn from_fn(of: impl FnMut(Quantity) -> Estimate) -> Self {
        Self(Quantity::SCALARS.map(of))
    }

    /// Each quantity with its estimate, in the order of the list.
    pub fn iter(&self) -> impl Iterator<Item = (Quantity, Estimate)> {
        Quantity::SCALARS.into_iter().zip(self.0)
    }

    fn position(quantity: Quantity) -> usize {
        assert!(quantity.descriptor().scalar, "{quantity:?} is not a scalar");
        quantity as usize
    }
}

/// All unknown.
impl Default for Scalars {
    fn default() -> Self {
        Self([Estimate::UNKNOWN; Quantity::SCALARS.len()])
    }
}

/// Unknown values (NaN) are equal to each other.
impl PartialEq for Scalars {
    fn eq(&self, other: &Self) -> bool {
        self.0.iter().zip(&other.0).all(|(a, b)| same(a.value, b.value) && same(a.error, b.error))
    }
}

impl Index<Quantity> for Scalars {
    type Output = Estimate;

    fn index(&self, quantity: Quantity) -> &Estimate {
        &self.0[Self::position(quantity)]
    }
}

impl IndexMut<Quantity> for Scalars {
    fn index_mut(&mut self, quantity: Quantity) -> &mut Estimate {
        &mut self.0[Self::position(quantity)]
    }
}
