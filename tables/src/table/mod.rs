//! A table in memory: results of one asperity over interference and slip rate.

pub mod comparison;
pub mod fracture;
mod merge;

pub(crate) use merge::first_difference;

use std::ops::{Index, IndexMut};

use crate::quantity::{Estimate, History, Quantity, Scalars};
pub use fracture::FractureEnergy;

/// Coordinates of a table, each strictly increasing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axes {
    /// ω₀/ω_c, positive.
    pub interference: Vec<f64>,
    /// V, m/s, at the radius of the table; a leading 0 is the isothermal limit.
    pub slip_rate: Vec<f64>,
    /// s/a₀ of the histories, a₀ being the contact radius at the end of the press; not negative.
    pub slip: Vec<f64>,
}

/// What holds for the whole table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Metadata {
    pub title: String,
    /// One line per command that made or changed the table.
    pub history: String,
    /// Program and version.
    pub source: String,
    /// Of the physics of the program: equal ones give equal numbers. May be empty.
    pub fingerprint: String,
    /// `K/N` where the table is one of N parts of the request; empty for a whole one.
    pub shard: String,
    /// What a reader must know before trusting the numbers; may be empty.
    pub comment: String,
    /// The request as TOML.
    pub scene: String,
    /// R_t, m: the radius that the values are for.
    pub asperity_radius: f64,
    /// ω_c at that radius, m.
    pub critical_interference: f64,
    /// E* = E/(1−ν²) at the initial temperature, Pa.
    pub contact_modulus: f64,
    /// ν.
    pub poisson_ratio: f64,
    /// σ_Y at the initial temperature, Pa.
    pub yield_strength: f64,
    /// f_τ; none where the interface has no strength of its own (Coulomb, full stick, frictionless).
    pub strength_factor: Option<f64>,
    /// Initial temperature of body and flat, K.
    pub temperature: f64,
    /// f_h, share of the frictional heat that enters the asperity.
    pub heat_partition: f64,
    /// h_g, W/(m² K); unless 0 the table holds for its own radius only.
    pub gap_conductance: f64,
    /// Of the material in shear, where it is known.
    pub fracture_energy: Option<FractureEnergy>,
    /// Relative error of interpolation that points were added for. Where there is one, the errors
    /// of the cells include that of interpolating around them.
    pub interpolation_tolerance: Option<f64>,
}

/// Results at one interference and slip rate. Values not known are NaN.
///
/// Unknown values of two cells are equal to each other.
#[derive(Clone, Debug)]
pub struct Cell {
    /// Values with their errors.
    pub scalars: Scalars,
    /// Values over the slip axis; a column that is not known is empty.
    pub histories: History,
    /// Whether μ has levelled off at the end of the slide.
    pub levelled: bool,
    /// What the run took, s.
    pub wall_time: f64,
    /// What a reader must know before trusting the numbers of this cell.
    pub warnings: Vec<String>,
}

impl Default for Cell {
    fn default() -> Self {
        Self {
            scalars: Scalars::default(),
            histories: History::new(&Quantity::TABLE_HISTORIES),
            levelled: false,
            wall_time: f64::NAN,
            warnings: Vec::new(),
        }
    }
}

impl Cell {
    /// A cell in which nothing is known yet: set values by `cell[Quantity::Mu] = …` and
    /// histories by [`Cell::with_history`].
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets one scalar.
    pub fn with(mut self, quantity: Quantity, value: f64, error: f64) -> Self {
        self[quantity] = Estimate { value, error };
        self
    }

    /// Sets the history of a quantity of [`Quantity::TABLE_HISTORIES`], one value per point of the
    /// slip axis (see [`Steffen`](crate::interpolation::steffen::Steffen) to resample). Panics for the others.
    pub fn with_history(mut self, quantity: Quantity, values: Vec<f64>) -> Self {
        *self.histories.column_mut(quantity) = values;
        self
    }

    /// History of a quantity over the slip axis; empty where none was set.
    pub fn history(&self, quantity: Quantity) -> &[f64] {
        self.histories.column(quantity)
    }

    /// Whether all is equal but the wall time.
    pub fn agrees_with(&self, other: &Cell) -> bool {
        self.levelled == other.levelled
            && self.warnings == other.warnings
            && self.scalars == other.scalars
            && self.histories == other.histories
    }
}

impl Index<Quantity> for Cell {
    type Output = Estimate;

    fn index(&self, quantity: Quantity) -> &Estimate {
        &self.scalars[quantity]
    }
}

impl IndexMut<Quantity> for Cell {
    fn index_mut(&mut self, quantity: Quantity) -> &mut Estimate {
        &mut self.scalars[quantity]
    }
}

impl PartialEq for Cell {
    fn eq(&self, other: &Self) -> bool {
        let same_time =
            self.wall_time == other.wall_time || (self.wall_time.is_nan() && other.wall_time.is_nan());
        self.agrees_with(other) && same_time
    }
}

/// What became of one point of the grid.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Status {
    Done(Box<Cell>),
    #[default]
    NotRun,
    /// The run failed, for this reason.
    Failed(String),
}

/// What is wrong with a table that is being put together.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TableError {
    #[error("axis \"{axis}\" must {rule}, but has {value} at position {position}")]
    Axis { axis: &'static str, rule: &'static str, value: f64, position: usize },
    #[error("axis \"{0}\" is empty")]
    AxisEmpty(&'static str),
    #[error("history of {quantity} has {found} values, the slip axis {expected}")]
    HistoryLength { quantity: &'static str, expected: usize, found: usize },
    #[error("the tables differ in {what}: {here} and {there}")]
    Different { what: &'static str, here: String, there: String },
    #[error("the tables have different results at interference {interference} and slip rate {slip_rate} m/s")]
    Disagree { interference: f64, slip_rate: f64 },
    #[error(transparent)]
    Temperature(#[from] crate::interpolation::temperature::TemperatureError),
}

/// Results of one asperity over interference and slip rate.
#[derive(Clone, Debug, PartialEq)]
/// ```
/// use tables::law::AsperityLaw;
/// use tables::quantity::Quantity;
/// use tables::table::{Axes, Cell, Metadata, Table};
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
/// let mut table = Table::new(axes, metadata)?;
/// for (i, load) in [0.1, 5.0].into_iter().enumerate() {
///     let mut cell = Cell::new();
///     for quantity in Quantity::SCALARS {
///         cell = cell.with(quantity, load, 0.01 * load);
///     }
///     for quantity in Quantity::TABLE_HISTORIES {
///         cell = cell.with_history(quantity, vec![load; 3]);
///     }
///     table.set_cell(i, 0, cell)?;
/// }
/// assert!(table.missing().is_empty());
/// let path = std::env::temp_dir().join(format!("tables-example-{}.nc", std::process::id()));
/// table.write(&path)?;
/// let read = Table::read(&path)?;
/// assert_eq!(read.cell(1, 0).unwrap()[Quantity::Load].value, 5.0);
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Table {
    axes: Axes,
    metadata: Metadata,
    /// Row-major: slip rates of the first interference first.
    cells: Vec<Status>,
    prepared: crate::interpolation::Prepared,
}

impl Table {
    /// A table in which nothing has been run.
    pub fn new(axes: Axes, metadata: Metadata) -> Result<Self, TableError> {
        check_axis("interference", &axes.interference, true)?;
        check_axis("slip_rate", &axes.slip_rate, false)?;
        check_axis("slip", &axes.slip, false)?;
        let cells = vec![Status::NotRun; axes.interference.len() * axes.slip_rate.len()];
        Ok(Self { axes, metadata, cells, prepared: Default::default() })
    }

    pub fn axes(&self) -> &Axes {
        &self.axes
    }

    pub fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    /// Changes the metadata; results are kept.
    pub fn set_metadata(&mut self, metadata: Metadata) {
        self.prepared = Default::default();
        self.metadata = metadata;
    }

    pub(crate) fn prepared(&self) -> &crate::interpolation::Prepared {
        &self.prepared
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

    /// Enters what became of a point.
    pub(crate) fn set_status(&mut self, i: usize, j: usize, status: Status) {
        let position = self.position(i, j);
        self.cells[position] = status;
        self.prepared = Default::default();
    }

    fn position(&self, i: usize, j: usize) -> usize {
        let (interferences, rates) = self.shape();
        assert!(i < interferences && j < rates, "({i}, {j}) is outside the table");
        i * rates + j
    }
}

pub(crate) fn check_axis(axis: &'static str, values: &[f64], positive: bool) -> Result<(), TableError> {
    if values.is_empty() {
        return Err(TableError::AxisEmpty(axis));
    }
    for (position, &value) in values.iter().enumerate() {
        let rule = if !value.is_finite() {
            "be finite"
        } else if positive && value <= 0.0 {
            "be positive"
        } else if value < 0.0 {
            "not be negative"
        } else if position > 0 && value <= values[position - 1] {
            "increase"
        } else {
            continue;
        };
        return Err(TableError::Axis { axis, rule, value, position });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axes() -> Axes {
        Axes { interference: vec![1.0, 2.0], slip_rate: vec![0.0, 0.5, 1.0], slip: vec![0.0, 2.0] }
    }

    fn cell(mu: f64) -> Cell {
        Cell::new().with(Quantity::Mu, mu, 0.01).with_history(Quantity::Mu, vec![0.0, mu])
    }

    #[test]
    fn cells_come_back() {
        let mut table = Table::new(axes(), Metadata::default()).unwrap();
        table.set_cell(1, 2, cell(0.3)).unwrap();
        table.mark_failed(0, 0, "no convergence");
        assert_eq!(table.cell(1, 2).unwrap()[Quantity::Mu].value, 0.3);
        assert_eq!(table.cell(1, 2).unwrap().history(Quantity::Mu), [0.0, 0.3]);
        assert!(table.cell(1, 2).unwrap()[Quantity::Load].value.is_nan());
        assert_eq!(*table.status(0, 0), Status::Failed("no convergence".to_string()));
        assert_eq!(table.missing(), [(0, 1), (0, 2), (1, 0), (1, 1)]);
        assert_eq!(table, table.clone());
    }

    #[test]
    fn bad_axes_and_histories_are_named() {
        let mut bad = axes();
        bad.slip_rate[1] = 2.0;
        let error = Table::new(bad, Metadata::default()).unwrap_err();
        assert_eq!(error.to_string(), "axis \"slip_rate\" must increase, but has 1 at position 2");
        let mut table = Table::new(axes(), Metadata::default()).unwrap();
        let short = cell(0.3).with_history(Quantity::Load, vec![1.0]);
        let error = table.set_cell(0, 0, short).unwrap_err();
        assert_eq!(error.to_string(), "history of P has 1 values, the slip axis 2");
    }
}
