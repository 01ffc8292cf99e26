//! Columns of numbers, keyed by quantity.

use std::ops::Index;

use super::{Quantity, same};

/// Values of several quantities along the press or the slide, one column each.
///
/// ```
/// use tables::quantity::{History, Quantity};
///
/// let mut history = History::new(&[Quantity::Slip, Quantity::Friction]);
/// for slip in [0.0, 1.0, 2.0] {
///     history.push(|quantity| if quantity == Quantity::Slip { slip } else { 0.5 * slip });
/// }
/// assert_eq!(history.column(Quantity::Slip), [0.0, 1.0, 2.0]);
/// assert_eq!(history.last(Quantity::Friction), Some(1.0));
/// // The column of another quantity is empty.
/// assert!(history.column(Quantity::Work).is_empty());
/// ```
#[derive(Clone, Debug)]
pub struct History {
    quantities: &'static [Quantity],
    columns: Vec<Vec<f64>>,
}

impl History {
    /// Empty columns of these quantities, such as [`Quantity::RUN_HISTORIES`].
    pub fn new(quantities: &'static [Quantity]) -> Self {
        Self { quantities, columns: vec![Vec::new(); quantities.len()] }
    }

    /// The quantities, in the order of the columns.
    pub fn quantities(&self) -> &'static [Quantity] {
        self.quantities
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.columns.iter().map(Vec::len).max().unwrap_or(0)
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Appends a row: a value of each quantity.
    pub fn push(&mut self, mut value: impl FnMut(Quantity) -> f64) {
        for (quantity, column) in self.quantities.iter().zip(&mut self.columns) {
            column.push(value(*quantity));
        }
    }

    /// Truncates to a number of rows.
    pub fn truncate(&mut self, rows: usize) {
        self.columns.iter_mut().for_each(|column| column.truncate(rows));
    }

    /// Values of a quantity; empty where it is not one of the columns, or not known.
    pub fn column(&self, quantity: Quantity) -> &[f64] {
        self.position(quantity).map_or(&[], |position| &self.columns[position])
    }

    /// Values of a quantity, to be changed. Panics for a quantity that is not one of the columns.
    pub fn column_mut(&mut self, quantity: Quantity) -> &mut Vec<f64> {
        let position = self.position(quantity).unwrap_or_else(|| panic!("{quantity:?} is not a column"));
        &mut self.columns[position]
    }

    /// Last value of a quantity.
    pub fn last(&self, quantity: Quantity) -> Option<f64> {
        self.column(quantity).last().copied()
    }

    /// Each quantity with its values.
    pub fn iter(&self) -> impl Iterator<Item = (Quantity, &[f64])> {
        self.quantities.iter().copied().zip(self.columns.iter().map(Vec::as_slice))
    }

    /// A row. Panics beyond the last one.
    pub fn state(&self, row: usize) -> State<'_> {
        assert!(row < self.len(), "row {row} of {}", self.len());
        State { history: self, row }
    }

    /// The rows in their order.
    pub fn states(&self) -> impl DoubleEndedIterator<Item = State<'_>> + ExactSizeIterator + Clone {
        (0..self.len()).map(|row| State { history: self, row })
    }

    fn position(&self, quantity: Quantity) -> Option<usize> {
        self.quantities.iter().position(|known| *known == quantity)
    }
}

/// One row of a history.
///
/// ```
/// use tables::quantity::{History, Quantity};
///
/// let mut history = History::new(&[Quantity::Slip, Quantity::Time]);
/// history.push(|quantity| if quantity == Quantity::Slip { 1e-6 } else { 2.0 });
/// assert_eq!(history.states().map(|state| state[Quantity::Time]).sum::<f64>(), 2.0);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct State<'a> {
    history: &'a History,
    row: usize,
}

/// Panics for a quantity that is not one of the columns.
impl Index<Quantity> for State<'_> {
    type Output = f64;

    fn index(&self, quantity: Quantity) -> &f64 {
        &self.history.column(quantity)[self.row]
    }
}

/// Unknown values (NaN) are equal to each other.
impl PartialEq for History {
    fn eq(&self, other: &Self) -> bool {
        let equal = |a: &[f64], b: &[f64]| a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(*a, *b));
        self.quantities == other.quantities
            && self.columns.iter().zip(&other.columns).all(|(a, b)| equal(a, b))
    }
}
