//! A tabulation as a [`Table`]: axes, results, and what a reader of the file must know.

use tables::closed_forms::hertz;
use tables::quantity::Quantity;
use tables::refinement::{Goal, JUDGED};
use tables::table::{Axes, Metadata, Table, TableError};

use super::{Index, Tabulation};
use crate::fracture::fracture_energy;
use crate::numbers::plain;
use crate::provenance::{FINGERPRINT, SOURCE};
use crate::scene_file::write_request;

impl Tabulation {
    /// The table of all cells; `history` as in [`crate::provenance::history`]. Where points were
    /// added for a tolerance, errors include that of interpolation.
    pub fn table(&self, history: String) -> Result<Table, TableError> {
        let mut table = self.filled()?;
        if let Some(goal) = self.request.goal
            && self.finished()
        {
            table = table.with_interpolation_errors(goal.tolerance);
        }
        let mut metadata = Metadata { history, ..table.metadata().clone() };
        metadata.comment = self.warnings().join("\n");
        table.set_metadata(metadata);
        Ok(table)
    }

    /// The results as they are.
    pub(super) fn filled(&self) -> Result<Table, TableError> {
        let axes = Axes {
            interference: self.interferences.clone(),
            slip_rate: self.slip_rates.clone(),
            slip: self.slips.clone(),
        };
        let mut table = Table::new(axes, self.metadata(String::new()))?;
        for ((i, j), finished) in self.done() {
            let mut cell = finished.cell.clone();
            cell.warnings.clone_from(&finished.warnings);
            table.set_cell(i, j, cell)?;
        }
        for ((i, j), reason) in self.failures() {
            table.mark_failed(i, j, reason);
        }
        Ok(table)
    }

    pub(super) fn metadata(&self, history: String) -> Metadata {
        let scene = &self.request.template;
        let (material, interface) = (&scene.material, &scene.interface);
        let contact_modulus = hertz::contact_modulus(material.youngs_modulus, material.poisson_ratio);
        let (interferences, slip_rates) = (&self.interferences, &self.slip_rates);
        Metadata {
            title: format!(
                "Friction of one asperity, {} interferences from {} to {} omega_c, \
                 {} slip rates from {} to {} m/s",
                interferences.len(),
                interferences[0],
                interferences[interferences.len() - 1],
                slip_rates.len(),
                slip_rates[0],
                slip_rates[slip_rates.len() - 1],
            ),
            history,
            source: SOURCE.into(),
            fingerprint: FINGERPRINT.into(),
            shard: self.shard.map_or(String::new(), |shard| shard.to_string()),
            comment: String::new(),
            scene: write_request(&self.request),
            asperity_radius: scene.radius,
            critical_interference: hertz::critical_interference(
                contact_modulus,
                material.poisson_ratio,
                material.yield_strength,
                scene.radius,
            ),
            contact_modulus,
            poisson_ratio: material.poisson_ratio,
            yield_strength: material.yield_strength,
            strength_factor: interface.law.is_material_strength().then_some(interface.strength_factor),
            temperature: scene.loading.temperature,
            heat_partition: interface.heat_partition,
            gap_conductance: interface.gap_conductance,
            fracture_energy: fracture_energy(material),
            interpolation_tolerance: None,
        }
    }

    /// Every warning once, with the cells that it concerns unless these are all; and whether
    /// interpolation falls short of the tolerance.
    pub fn warnings(&self) -> Vec<String> {
        let Ok(table) = self.filled() else { return Vec::new() };
        let mut warnings = table.warnings();
        if let Some(goal) = self.request.goal
            && self.finished()
        {
            warnings.extend(shortfall(&table, &goal));
        }
        warnings
    }

    /// A cell by its coordinates.
    pub fn label(&self, (i, j): Index) -> String {
        format!("{} omega_c at {} m/s", plain(self.interferences[i]), plain(self.slip_rates[j]))
    }
}

/// What interpolates worse than it should, where no more points were added.
fn shortfall(table: &Table, goal: &Goal) -> Vec<String> {
    let validation = table.cross_validation();
    let text = |quantity: Quantity| {
        let worst = validation.worst(quantity);
        (worst.error > goal.tolerance).then(|| {
            format!(
                "interpolation of {} is good to {} near {} only, not to the tolerance of {}; finer points \
                 need a larger table.max_cells or runs of smaller error",
                quantity.descriptor().name,
                plain(worst.error),
                table.label(worst.at.0, worst.at.1),
                plain(goal.tolerance),
            )
        })
    };
    JUDGED.into_iter().filter_map(text).collect()
}
