//! A tabulation as a [`Table`]: axes, results, and what a reader of the file must know.

use tables::closed_forms::hertz;
use tables::table::{Axes, Metadata, Table, TableError};

use super::{Finished, Index, Tabulation};
use crate::fracture::fracture_energy;
use crate::numbers::plain;
use crate::provenance::SOURCE;
use crate::scene::FrictionLaw;
use crate::scene_file::write_request;

impl Tabulation {
    /// The table of all cells; `history` as in [`crate::provenance::history`].
    pub fn table(&self, history: String) -> Result<Table, TableError> {
        let axes = Axes {
            interference: self.request.interferences.clone(),
            slip_rate: self.request.slip_rates.clone(),
            slip: self.slips.clone(),
        };
        let mut table = Table::new(axes, self.metadata(history))?;
        for ((i, j), finished) in self.done() {
            table.set_cell(i, j, finished.cell.clone())?;
        }
        for ((i, j), reason) in self.failures() {
            table.mark_failed(i, j, reason);
        }
        Ok(table)
    }

    fn metadata(&self, history: String) -> Metadata {
        let scene = &self.request.template;
        let (material, interface) = (&scene.material, &scene.interface);
        let contact_modulus = hertz::contact_modulus(material.youngs_modulus, material.poisson_ratio);
        let (interferences, slip_rates) = (&self.request.interferences, &self.request.slip_rates);
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
            comment: self.warnings().join("\n"),
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
            strength_factor: match interface.law {
                FrictionLaw::ShearStrength => Some(interface.strength_factor),
                FrictionLaw::Coulomb { .. } | FrictionLaw::FullStick | FrictionLaw::Frictionless => None,
            },
            temperature: scene.loading.temperature,
            heat_partition: interface.heat_partition,
            gap_conductance: interface.gap_conductance,
            fracture_energy: fracture_energy(material),
        }
    }

    /// Every warning once, with the cells that it concerns unless these are all.
    pub fn warnings(&self) -> Vec<String> {
        let mut found: Vec<(&str, Vec<Index>)> = Vec::new();
        for (index, finished) in self.done() {
            let Finished { warnings, .. } = finished;
            for warning in warnings {
                match found.iter_mut().find(|(text, _)| text == warning) {
                    Some((_, cells)) => cells.push(index),
                    None => found.push((warning, vec![index])),
                }
            }
        }
        let all = self.done().count();
        found
            .into_iter()
            .map(|(text, cells)| match cells.len() == all {
                true => text.to_owned(),
                false => {
                    let cells: Vec<String> = cells.into_iter().map(|at| self.label(at)).collect();
                    format!("{text} [{}]", cells.join("; "))
                }
            })
            .collect()
    }

    /// A cell by its coordinates.
    pub fn label(&self, (i, j): Index) -> String {
        format!(
            "{} omega_c at {} m/s",
            plain(self.request.interferences[i]),
            plain(self.request.slip_rates[j])
        )
    }
}
