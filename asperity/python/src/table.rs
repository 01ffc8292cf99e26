//! `asperity.table`: interpolation in a table.

use std::collections::BTreeMap;
use std::path::PathBuf;

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use tables::interpolation::InterpolatedTable;
use tables::law::{AsperityLaw, LookupError};
use tables::quantity::{Estimate, Quantity};
use tables::shipped;

use crate::errors;
use crate::output::Figure;

/// A table with all its initial temperatures.
#[pyclass(frozen, module = "asperity._core")]
pub struct Table {
    table: tables::table::Table,
    warnings: Vec<String>,
}

type Column<'py> = Bound<'py, PyArray1<f64>>;
type Given<'py> = PyReadonlyArray1<'py, f64>;

impl Table {
    pub fn new(table: tables::table::Table, warnings: Vec<String>) -> Self {
        Self { table, warnings }
    }

    /// The table at an initial temperature, K.
    fn at(&self, temperature: Option<f64>) -> PyResult<InterpolatedTable> {
        self.table.at(temperature).map_err(|error| errors::refused("temperature", error))
    }
}

/// The table in a file, or the shipped one of that name.
#[pyfunction]
pub fn load(py: Python<'_>, name: &str) -> PyResult<Table> {
    let table = py.detach(|| shipped::load(name));
    let table = table.map_err(|error| errors::input(&error, Some(name), None, &error))?;
    let warnings = table.warnings();
    Ok(Table { table, warnings })
}

fn quantity(name: &str, allowed: &[Quantity]) -> PyResult<Quantity> {
    let found = Quantity::named(name).filter(|quantity| allowed.contains(quantity));
    found.ok_or_else(|| {
        let names: Vec<&str> = allowed.iter().map(|quantity| quantity.descriptor().name).collect();
        errors::refused("quantity", format!("\"{name}\" must be one of {}", names.join(", ")))
    })
}

/// Quantities after a slip.
const AFTER_SLIP: [Quantity; 5] =
    [Quantity::Mu, Quantity::Friction, Quantity::Load, Quantity::Area, Quantity::TemperatureMax];

/// States to be looked up, columns of one length; temperatures are NaN for the only one of the table, radii for that of
/// the table.
#[derive(FromPyObject)]
struct Columns<'py> {
    interference: Given<'py>,
    slip_rate: Given<'py>,
    slip: Option<Given<'py>>,
    temperature: Given<'py>,
    radius: Given<'py>,
}

/// The same, without the lock of Python.
struct States<'a> {
    interference: &'a [f64],
    slip_rate: &'a [f64],
    slip: Option<&'a [f64]>,
    radius: &'a [f64],
}

impl States<'_> {
    fn look_up(
        &self,
        law: &InterpolatedTable,
        quantity: Quantity,
        k: usize,
    ) -> Result<Estimate, LookupError> {
        let (interference, slip_rate, radius) = (self.interference[k], self.slip_rate[k], self.radius[k]);
        let Some(slip) = self.slip else {
            return law.estimate(quantity, radius, interference, slip_rate);
        };
        let state = law.response(radius, interference, slip_rate, slip[k])?;
        Ok(match quantity {
            Quantity::Friction => state.friction,
            Quantity::Load => state.load,
            Quantity::Area => state.area,
            Quantity::TemperatureMax => state.temperature_max,
            _ => state.friction.over(state.load),
        })
    }
}

#[pymethods]
impl Table {
    /// Values and errors of a quantity; NaN outside the table where `outside_is_nan`.
    fn look_up<'py>(
        &self,
        py: Python<'py>,
        quantity: &str,
        columns: Columns<'py>,
        outside_is_nan: bool,
    ) -> PyResult<(Column<'py>, Column<'py>)> {
        let quantity = match columns.slip {
            Some(_) => self::quantity(quantity, &AFTER_SLIP)?,
            None => self::quantity(quantity, &Quantity::SCALARS)?,
        };
        let own = self.table.metadata().asperity_radius;
        let radius = columns.radius.as_slice()?.iter().map(|r| if r.is_nan() { own } else { *r });
        let radius: Vec<f64> = radius.collect();
        let temperature = columns.temperature.as_slice()?;
        let states = States {
            interference: columns.interference.as_slice()?,
            slip_rate: columns.slip_rate.as_slice()?,
            slip: columns.slip.as_ref().map(|slip| slip.as_slice()).transpose()?,
            radius: &radius,
        };
        let mut laws = BTreeMap::new();
        for kelvin in temperature {
            if let std::collections::btree_map::Entry::Vacant(place) = laws.entry(kelvin.to_bits()) {
                place.insert(self.at((!kelvin.is_nan()).then_some(*kelvin))?);
            }
        }
        let found: Result<Vec<Estimate>, LookupError> = py.detach(|| {
            let each = temperature.iter().enumerate().map(|(k, kelvin)| {
                match states.look_up(&laws[&kelvin.to_bits()], quantity, k) {
                    Err(_) if outside_is_nan => Ok(Estimate::UNKNOWN),
                    found => found,
                }
            });
            each.collect()
        });
        let found = found.map_err(|error| errors::of_lookup(&error))?;
        let (values, errors): (Vec<f64>, Vec<f64>) = found.iter().map(|x| (x.value, x.error)).unzip();
        Ok((values.into_pyarray(py), errors.into_pyarray(py)))
    }

    /// Name, unit and meaning of the scalars.
    #[staticmethod]
    fn quantities() -> Vec<(&'static str, &'static str, &'static str)> {
        let entries = Quantity::SCALARS.iter().map(|quantity| quantity.descriptor());
        entries.map(|entry| (entry.name, entry.units, entry.long_name)).collect()
    }

    /// Interferences, slip rates, slips and initial temperatures.
    fn axes(&self) -> (Vec<f64>, Vec<f64>, Vec<f64>, Vec<f64>) {
        let axes = self.table.axes().clone();
        (axes.interference, axes.slip_rate, axes.slip, self.table.temperatures())
    }

    /// Interference at which contacts are too large for the model.
    fn contact_limit(&self, temperature: Option<f64>) -> PyResult<f64> {
        Ok(self.at(temperature)?.contact_limit())
    }

    /// Radius, ω_c (m), E* (Pa), ν and σ_Y (Pa) at the lowest temperature.
    fn constants(&self) -> BTreeMap<&'static str, f64> {
        let metadata = self.table.metadata();
        BTreeMap::from([
            ("asperity_radius", metadata.asperity_radius),
            ("critical_interference", metadata.critical_interference),
            ("contact_modulus", metadata.contact_modulus),
            ("poisson_ratio", metadata.poisson_ratio),
            ("yield_strength", metadata.yield_strength),
            ("heat_partition", metadata.heat_partition),
            ("gap_conductance", metadata.gap_conductance),
        ])
    }

    fn provenance(&self) -> BTreeMap<&'static str, &str> {
        let metadata = self.table.metadata();
        BTreeMap::from([
            ("title", metadata.title.as_str()),
            ("source", &metadata.source),
            ("history", &metadata.history),
            ("fingerprint", &metadata.fingerprint),
            ("scene", &metadata.scene),
            ("comment", &metadata.comment),
        ])
    }

    fn warnings(&self) -> Vec<String> {
        self.warnings.clone()
    }

    /// Cells that failed, and why.
    fn failures(&self) -> Vec<(String, String)> {
        self.table.failures().into_iter().map(|(at, why)| (at, why.to_owned())).collect()
    }

    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        py.detach(|| self.table.write(&path)).map_err(|error| errors::failed(error, None))
    }

    fn figure(&self, panels: Vec<String>, temperature: Option<f64>) -> PyResult<Figure> {
        Figure::new(self.at(temperature)?.figure(), &panels)
    }
}
