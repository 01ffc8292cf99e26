//! Results of a tabulation, and the [`Table`] of them with its metadata.

use std::collections::BTreeMap;

use tables::numbers::plain;
use tables::quantity::Quantity;
use tables::refinement::{Goal, JUDGED};
use tables::table::{Axes, Constants, Metadata, Slice, Table, TableError};

use super::cell::Finished;
use super::journal::{CellResult, Index};
use super::shard::Shard;
use crate::output::provenance::{FINGERPRINT, SOURCE};
use crate::scene::file::{Request, write_request};
use crate::scene::{Rate, Scene};
use crate::simulate::fracture::fracture_energy;
use crate::solver::timings::Timings;

/// Results of a grid of runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Tabulation {
    /// The request.
    pub request: Request,
    /// The part of it that was to be run.
    pub shard: Option<Shard>,
    /// Interferences and slip rates are those requested and those added.
    pub axes: Axes,
    /// Results of the cells that were run.
    pub cells: BTreeMap<Index, CellResult>,
    /// Cells that were to be run.
    pub wanted: Vec<Index>,
    /// Cells taken from the journal.
    pub resumed: usize,
}

impl Tabulation {
    /// Whether every cell that was to be run was, with or without success.
    pub fn finished(&self) -> bool {
        self.wanted.iter().all(|index| self.cells.contains_key(index))
    }

    /// Cells that failed, with the reason.
    pub fn failures(&self) -> impl Iterator<Item = (Index, &str)> {
        self.cells.iter().filter_map(|(index, cell)| Some((*index, cell.as_ref().err()?.as_str())))
    }

    /// Cells with a result.
    pub fn done(&self) -> impl Iterator<Item = (Index, &Finished)> {
        self.cells.iter().filter_map(|(index, cell)| Some((*index, cell.as_ref().ok()?)))
    }

    /// Time of the cells that were run by part of the computation, summed. A press that served several slip
    /// rates counts in each.
    pub fn timings(&self) -> Timings {
        let mut sum = Timings::default();
        self.done().for_each(|(_, finished)| sum.include(&finished.timings));
        sum
    }

    /// Initial temperature of a row, K, if they are several; and its interference.
    pub fn row(&self, i: usize) -> (Option<f64>, f64) {
        let count = self.axes.interference.len();
        (self.request.temperatures.get(i / count).copied(), self.axes.interference[i % count])
    }

    /// The cells of the grid, row by row.
    pub fn grid(&self) -> impl Iterator<Item = Index> {
        let rows = self.request.temperatures.len().max(1) * self.axes.interference.len();
        let columns = self.axes.slip_rate.len();
        (0..rows).flat_map(move |i| (0..columns).map(move |j| (i, j)))
    }

    /// The table of all cells; `history` as in [`crate::output::provenance::history`]. Where points were
    /// added for a tolerance, errors include that of interpolation.
    pub fn table(&self, history: String) -> Result<Table, TableError> {
        let mut table = match self.goal_reached() {
            Some(goal) => {
                let slice = self.slice(0, &self.request.template)?;
                Table::from(slice.with_interpolation_errors(goal.tolerance))
            }
            None => self.filled()?,
        };
        table.set_provenance(&history, &self.shard());
        table.set_comment(&self.warnings().join("\n"));
        Ok(table)
    }

    /// The results without interpolation errors.
    fn filled(&self) -> Result<Table, TableError> {
        let templates = self.request.templates();
        let slices = templates.iter().enumerate().map(|(n, scene)| self.slice(n, scene));
        let table = Table::new(slices.collect::<Result<Vec<Slice>, TableError>>()?)?;
        let constants = self.request.material_temperatures().map(|kelvin| self.constants(&kelvin));
        constants.into_iter().try_fold(table, Table::with_constants)
    }

    /// Constants of the material at these temperatures.
    fn constants(&self, kelvin: &[f64]) -> Constants {
        let at = |kelvin: &f64| self.metadata(&self.request.template.at_temperature(*kelvin));
        Constants::of(&kelvin.iter().map(at).collect::<Vec<Metadata>>())
    }

    /// The tolerance that points were added for, once all are run. Such a table has one initial temperature.
    fn goal_reached(&self) -> Option<Goal> {
        self.request.goal.filter(|_| self.finished())
    }

    /// The results at the n-th initial temperature, of the scenes that share `template`.
    pub(super) fn slice(&self, n: usize, template: &Scene) -> Result<Slice, TableError> {
        let mut slice = Slice::new(self.axes.clone(), self.metadata(template))?;
        let count = self.axes.interference.len();
        for ((i, j), result) in self.cells.range((n * count, 0)..((n + 1) * count, 0)) {
            match result {
                Ok(finished) => slice.set_cell(i % count, *j, finished.cell.clone())?,
                Err(reason) => slice.mark_failed(i % count, *j, reason),
            }
        }
        Ok(slice)
    }

    fn shard(&self) -> String {
        self.shard.map_or(String::new(), |shard| shard.to_string())
    }

    fn title(&self) -> String {
        let (interferences, slip_rates) = (&self.axes.interference, &self.axes.slip_rate);
        let temperatures = match &self.request.temperatures[..] {
            [from, .., to] => {
                format!("{} initial temperatures from {from} to {to} K, ", self.request.temperatures.len())
            }
            _ => String::new(),
        };
        format!(
            "Friction of one asperity, {temperatures}{} interferences from {} to {} omega_c, \
                 {} slip rates from {} to {} m/s",
            interferences.len(),
            interferences[0],
            interferences[interferences.len() - 1],
            slip_rates.len(),
            slip_rates[0],
            slip_rates[slip_rates.len() - 1],
        )
    }

    fn metadata(&self, scene: &Scene) -> Metadata {
        let combined = scene.with_combined_modulus();
        let (material, interface) = (&combined.material, &scene.interface);
        let (rate_coefficient, rate_reference) = match material.rate {
            Rate::None => (None, None),
            Rate::JohnsonCook { coefficient, reference } => (Some(coefficient), Some(reference)),
        };
        let body = material.elastic_plastic();
        let law = &interface.law;
        let has_strength = law.limit().capped && law.has_friction();
        let film = law.film(scene.loading.temperature);
        Metadata {
            title: self.title(),
            history: String::new(),
            source: SOURCE.into(),
            fingerprint: FINGERPRINT.into(),
            shard: self.shard(),
            comment: String::new(),
            scene: write_request(&self.request),
            asperity_radius: scene.radius,
            critical_interference: body.critical_interference(scene.radius),
            contact_modulus: body.contact_modulus(),
            poisson_ratio: material.poisson_ratio,
            yield_strength: material.yield_strength,
            strength_factor: has_strength.then_some(interface.strength_factor),
            film_strength: film.map(|(strength, _)| strength),
            pressure_coefficient: film.map(|(_, coefficient)| coefficient),
            rate_coefficient,
            rate_reference,
            press_slip_distance: scene.loading.press_slip_distance,
            temperature: scene.loading.temperature,
            heat_partition: interface.heat_partition,
            gap_conductance: match scene.counterface.contact_conductance {
                conductance if conductance.is_finite() => conductance,
                _ => interface.gap_conductance,
            },
            // One body at all temperatures; its tables over temperature are read at the lowest one.
            counterface: self.request.templates()[0].counterface.to_string(),
            fracture_energy: Some(fracture_energy(&scene.material)),
            interpolation_tolerance: None,
        }
    }

    /// Every warning once, with the cells that it concerns unless these are all; and whether
    /// interpolation falls short of the tolerance.
    pub fn warnings(&self) -> Vec<String> {
        let Ok(table) = self.filled() else { return Vec::new() };
        let mut warnings = table.warnings();
        if let (Some(goal), Ok(slice)) = (self.goal_reached(), table.only()) {
            warnings.extend(shortfall(slice, &goal));
        }
        warnings
    }

    /// A cell by its coordinates.
    pub fn label(&self, (i, j): Index) -> String {
        let (temperature, interference) = self.row(i);
        let cell = tables::table::label(interference, self.axes.slip_rate[j]);
        match temperature {
            None => cell,
            Some(temperature) => format!("{cell} from {} K", plain(temperature)),
        }
    }
}

/// Quantities whose interpolation error exceeds the tolerance where no more points were added.
fn shortfall(table: &Slice, goal: &Goal) -> Vec<String> {
    let validation = table.cross_validation();
    let text = |quantity: Quantity| {
        let worst = validation.worst(quantity);
        let asked = quantity.allowance() * goal.tolerance;
        (worst.error > asked).then(|| {
            format!(
                "interpolation of {} is good to {} near {} only, not to the tolerance of {}; finer points \
                 need a larger table.max_cells or runs of smaller error",
                quantity.descriptor().name,
                plain(worst.error),
                table.label(worst.at.0, worst.at.1),
                plain(asked),
            )
        })
    };
    JUDGED.into_iter().filter_map(text).collect()
}
