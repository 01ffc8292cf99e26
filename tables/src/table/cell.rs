//! Results at one point of the grid.

use std::ops::{Index, IndexMut};

use crate::law::Response;
use crate::quantity::{Estimate, History, Quantity, Scalars, same};

/// Results at one interference and slip rate. Values not known are NaN.
///
/// Unknown values of two cells are equal to each other.
#[derive(Clone, Debug)]
pub struct Cell {
    /// Values with their errors.
    pub scalars: Scalars,
    /// Values over the slip axis; a column that is not known is empty.
    pub histories: History,
    /// Whether μ is steady at the end of the slide.
    pub steady: bool,
    /// What the run took, s.
    pub wall_time: f64,
    /// Limitations of the results of this cell.
    pub warnings: Vec<String>,
}

impl Default for Cell {
    fn default() -> Self {
        Self {
            scalars: Scalars::default(),
            histories: History::new(&Quantity::TABLE_HISTORIES),
            steady: false,
            wall_time: f64::NAN,
            warnings: Vec::new(),
        }
    }
}

impl Cell {
    /// A cell without values: set values by `cell[Quantity::Mu] = …` and
    /// histories by [`Cell::with_history`].
    pub fn new() -> Self {
        Self::default()
    }

    /// Histories of a slide without errors, and the scalars at its end and at the end of the press.
    pub(super) fn of_slide(contact_radius: f64, states: &[Response]) -> Self {
        let history =
            |of: fn(&Response) -> Estimate| states.iter().map(|state| of(state).value).collect::<Vec<f64>>();
        let (load, friction) = (history(|state| state.load), history(|state| state.friction));
        let (area, temperature) = (history(|state| state.area), history(|state| state.temperature_max));
        let mu: Vec<f64> = friction.iter().zip(&load).map(|(friction, load)| friction / load).collect();
        let end = states.len() - 1;
        Self::new()
            .with(Quantity::ContactRadius, contact_radius, 0.0)
            .with(Quantity::Mu, mu[end], 0.0)
            .with(Quantity::Load, load[end], 0.0)
            .with(Quantity::LoadPress, load[0], 0.0)
            .with(Quantity::Friction, friction[end], 0.0)
            .with(Quantity::Area, area[end], 0.0)
            .with(Quantity::AreaPress, area[0], 0.0)
            .with(Quantity::TemperatureMax, temperature[end], 0.0)
            .with_history(Quantity::Mu, mu)
            .with_history(Quantity::Load, load)
            .with_history(Quantity::Friction, friction)
            .with_history(Quantity::Area, area)
            .with_history(Quantity::TemperatureMax, temperature)
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

    /// Whether sliding begins in a slide over `last_slip` contact radii: otherwise a run states the end of the slide as the
    /// slip at inception. Without friction there is no inception.
    pub fn begins_to_slide(&self, last_slip: f64) -> bool {
        let end = last_slip * self[Quantity::ContactRadius].value;
        let stuck = end > 0.0 && self[Quantity::InceptionSlip].value >= (1.0 - 1e-9) * end;
        !stuck || self[Quantity::Friction].value == 0.0
    }

    /// Whether all is equal but the wall time.
    pub fn agrees_with(&self, other: &Cell) -> bool {
        self.steady == other.steady
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
        self.agrees_with(other) && same(self.wall_time, other.wall_time)
    }
}

/// State of one point of the grid.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Status {
    Done(Box<Cell>),
    #[default]
    NotRun,
    /// The run failed, for this reason.
    Failed(String),
}

impl Status {
    pub fn name(&self) -> &'static str {
        match self {
            Self::Done(_) => "done",
            Self::NotRun => "not run",
            Self::Failed(_) => "failed",
        }
    }

    /// Its number in files.
    pub fn code(&self) -> i8 {
        match self {
            Self::Done(_) => 0,
            Self::NotRun => 1,
            Self::Failed(_) => 2,
        }
    }

    /// Why the run failed, if it did.
    pub fn reason(&self) -> Option<&str> {
        match self {
            Self::Failed(reason) => Some(reason),
            _ => None,
        }
    }
}
