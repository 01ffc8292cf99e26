//! A table at one initial temperature.

use super::axes::check_axis;
use super::{Axes, Cell, Metadata, Status, TableError};
use crate::law::Response;
use crate::quantity::Quantity;

/// A table at one initial temperature: results over interference and slip rate.
/// ```
/// use tables::quantity::Quantity;
/// use tables::table::{Axes, Cell, Metadata, Slice, Table};
///
/// let axes = Axes { interference: vec![1.0, 10.0], slip_rate: vec![1.0], slip: vec![0.0, 1.0, 2.0] };
/// let metadata = Metadata {
///     asperity_radius: 1e-3,
///     critical_interference: 1e-7,
///     contact_modulus: 220e9,
///     poisson_ratio: 0.3,
///     yield_strength: 800e6,
///     strength_factor: Some(1.0),
///     temperature: 298.0,
///     heat_partition: 0.5,
///     ..Metadata::default()
/// };
/// let slice = Slice::filled(axes, metadata, |interference, _slip_rate| {
///     let load = 0.5 * interference;
///     let mut cell = Cell::new();
///     for quantity in Quantity::SCALARS {
///         cell = cell.with(quantity, load, 0.01 * load);
///     }
///     for quantity in Quantity::TABLE_HISTORIES {
///         cell = cell.with_history(quantity, vec![load; 3]);
///     }
///     cell
/// })?;
/// assert!(slice.missing().is_empty());
/// let path = std::env::temp_dir().join(format!("tables-example-{}.nc", std::process::id()));
/// Table::from(slice).write(&path)?;
/// let read = Table::read(&path)?.at(None)?;
/// assert_eq!(read.cell(1, 0).unwrap()[Quantity::Load].value, 5.0);
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Slice {
    axes: Axes,
    metadata: Metadata,
    /// Row-major: slip rates of the first interference first.
    cells: Vec<Status>,
}

impl Slice {
    /// A slice of cells that are not run.
    pub fn new(axes: Axes, metadata: Metadata) -> Result<Self, TableError> {
        check_axis("interference", &axes.interference, true)?;
        check_axis("slip_rate", &axes.slip_rate, false)?;
        check_axis("slip", &axes.slip, false)?;
        let cells = vec![Status::NotRun; axes.interference.len() * axes.slip_rate.len()];
        Ok(Self { axes, metadata, cells })
    }

    /// A slice with a result at every interference ω₀/ω_c and slip rate, m/s.
    pub fn filled(
        axes: Axes,
        metadata: Metadata,
        cell: impl Fn(f64, f64) -> Cell,
    ) -> Result<Self, TableError> {
        let mut slice = Self::new(axes, metadata)?;
        for (i, j) in slice.grid() {
            let (interference, slip_rate) = slice.coordinates(i, j);
            slice.set_cell(i, j, cell(interference, slip_rate))?;
        }
        Ok(slice)
    }

    /// A slice of spheres with this response to interference (ω₀/ω_c), slip rate (m/s) and slip (m): its histories, and the
    /// scalars that follow from them, without errors.
    pub fn of_response(
        axes: Axes,
        metadata: Metadata,
        response: impl Fn(f64, f64, f64) -> Response,
    ) -> Result<Self, TableError> {
        let slips = axes.slip.clone();
        Self::filled(axes, metadata, |interference, slip_rate| {
            let at = |slip: f64| response(interference, slip_rate, slip);
            let contact_radius = (at(0.0).area.value / std::f64::consts::PI).sqrt();
            Cell::of_slide(
                contact_radius,
                &slips.iter().map(|slip| at(slip * contact_radius)).collect::<Vec<_>>(),
            )
        })
    }

    /// Coordinates of the grid.
    pub fn axes(&self) -> &Axes {
        &self.axes
    }

    /// Origin and constants.
    pub fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    /// Origin and constants, to be changed; results are unchanged.
    pub fn metadata_mut(&mut self) -> &mut Metadata {
        &mut self.metadata
    }

    /// (numbers of interferences, of slip rates).
    pub fn shape(&self) -> (usize, usize) {
        (self.axes.interference.len(), self.axes.slip_rate.len())
    }

    /// State of the point (i-th interference, j-th slip rate).
    pub fn status(&self, i: usize, j: usize) -> &Status {
        &self.cells[self.position(i, j)]
    }

    /// Results at (i-th interference, j-th slip rate), if there are any.
    pub fn cell(&self, i: usize, j: usize) -> Option<&Cell> {
        match self.status(i, j) {
            Status::Done(cell) => Some(cell),
            _ => None,
        }
    }

    /// Enters results; each history must be as long as the slip axis, or empty.
    pub fn set_cell(&mut self, i: usize, j: usize, mut cell: Cell) -> Result<(), TableError> {
        let expected = self.axes.slip.len();
        for quantity in Quantity::TABLE_HISTORIES {
            let column = cell.histories.column_mut(quantity);
            if column.is_empty() {
                *column = vec![f64::NAN; expected];
            }
            if column.len() != expected {
                let quantity = quantity.descriptor().name;
                return Err(TableError::HistoryLength { quantity, expected, found: column.len() });
            }
        }
        self.set_status(i, j, Status::Done(Box::new(cell)));
        Ok(())
    }

    /// Enters that the run failed.
    pub fn mark_failed(&mut self, i: usize, j: usize, reason: impl Into<String>) {
        self.set_status(i, j, Status::Failed(reason.into()));
    }

    /// Sets the state of a point.
    pub(crate) fn set_status(&mut self, i: usize, j: usize, status: Status) {
        let position = self.position(i, j);
        self.cells[position] = status;
    }

    fn position(&self, i: usize, j: usize) -> usize {
        let (interferences, rates) = self.shape();
        assert!(i < interferences && j < rates, "({i}, {j}) is outside the table");
        i * rates + j
    }
}
