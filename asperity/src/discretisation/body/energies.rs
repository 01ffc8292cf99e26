//! Mechanical energies of the body and of a step.

use super::state::value_index;
use super::{Body, BodyState, TENSOR};
use crate::discretisation::element::{CORNERS, POINTS};

/// Mechanical energies of a step, dimensionless, half body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MechanicalEnergies {
    pub plastic: f64,
    pub thermal_expansion: f64,
    /// Elastic energy released as the moduli fall with temperature.
    pub moduli_softening: f64,
}

/// a:b of symmetric tensors from component i of both, of which the last three stand for two each.
fn contraction(components: impl Fn(usize) -> [f64; 2]) -> f64 {
    let term = |i: usize| {
        let [a, b] = components(i);
        if i < 3 { a * b } else { 2.0 * a * b }
    };
    (0..TENSOR).map(term).sum()
}

impl Body {
    /// Elastic energy ∫½ s:s/2G + p²/2K of a state, half body.
    pub fn elastic_energy(&self, state: &BodyState) -> f64 {
        let lanes = self.mesh.sectors.columns();
        let moduli = self.solid.moduli;
        let mut energy = 0.0;
        for (e, element) in self.mesh.elements.iter().enumerate() {
            for l in 0..lanes {
                let p = state.mean_stress[e * lanes + l];
                let stiffness = self.solid.stiffness_factor(state.rise[e * lanes + l]);
                energy += element.volume * p * p / (2.0 * moduli.bulk) / stiffness;
                for q in 0..POINTS {
                    let s = |i: usize| state.deviator[value_index(TENSOR, [e, i, q], lanes) + l];
                    let squared = contraction(|i| [s(i), s(i)]);
                    energy += element.weight[q] * squared / (4.0 * moduli.shear) / stiffness;
                }
            }
        }
        energy
    }

    /// Plastic work of the step at each Gauss point, by the trapezoidal rule, which closes the
    /// energy balance of the step exactly: ½(s₀ + s₁):Δε_p per volume.
    fn point_plastic_work(&self, e: usize, q: usize, l: usize) -> f64 {
        let lanes = self.mesh.sectors.columns();
        contraction(|i| {
            let at = value_index(TENSOR, [e, i, q], lanes) + l;
            let mean = 0.5 * (self.committed.deviator[at] + self.trial.deviator[at]);
            [mean, self.trial.plastic_strain[at] - self.committed.plastic_strain[at]]
        })
    }

    /// Plastic work, work through thermal expansion and elastic energy given up by softening moduli
    /// in the step from committed to trial.
    pub fn step_energies(&self) -> MechanicalEnergies {
        let lanes = self.mesh.sectors.columns();
        let mut energies = MechanicalEnergies::default();
        for (e, element) in self.mesh.elements.iter().enumerate() {
            for l in 0..lanes {
                let at = e * lanes + l;
                let mean = 0.5 * (self.committed.mean_stress[at] + self.trial.mean_stress[at]);
                let rise = self.trial.rise[at] - self.committed.rise[at];
                let expansion = self.solid.mean_expansion(self.committed.rise[at], self.trial.rise[at]);
                energies.thermal_expansion += element.volume * mean * 3.0 * expansion * rise;
                if self.solid.stiffness_varies() {
                    energies.moduli_softening += self.element_moduli_softening(e, l);
                }
                for q in (0..POINTS).filter(|_| self.group_flows(e, l)) {
                    energies.plastic += element.weight[q] * self.point_plastic_work(e, q, l);
                }
            }
        }
        energies
    }

    /// Elastic energy that element e releases at angle l as its moduli change from f₀ to f₁ times those
    /// at T₀: −(f₁ − f₀)(G a₀:a₁ + ½K v₀v₁) per volume with the elastic strains a, v. Half the change
    /// of f·a² is at constant moduli ½(f₀a₀ + f₁a₁)(a₁ − a₀), which is work, and this is the rest:
    /// with it the balance of the step closes exactly.
    fn element_moduli_softening(&self, e: usize, l: usize) -> f64 {
        let lanes = self.mesh.sectors.columns();
        let (element, moduli, at) = (&self.mesh.elements[e], self.solid.moduli, e * lanes + l);
        let [before, after] =
            [&self.committed, &self.trial].map(|state| self.solid.stiffness_factor(state.rise[at]));
        let product = self.committed.mean_stress[at] * self.trial.mean_stress[at];
        let mut energy = element.volume * product / (2.0 * moduli.bulk);
        for q in 0..POINTS {
            let product = contraction(|i| {
                let at = value_index(TENSOR, [e, i, q], lanes) + l;
                [self.committed.deviator[at], self.trial.deviator[at]]
            });
            energy += element.weight[q] * product / (4.0 * moduli.shear);
        }
        (before - after) / (before * after) * energy
    }

    /// Adds `factor` times the plastic work of the step to the nodes.
    pub fn add_plastic_work(&self, factor: f64, nodal: &mut [f64]) {
        let lanes = self.mesh.sectors.columns();
        for (e, element) in self.mesh.elements.iter().enumerate() {
            for l in 0..lanes {
                if !self.group_flows(e, l) {
                    continue;
                }
                let mut share = [[0.0; 1]; CORNERS];
                for q in 0..POINTS {
                    let work = factor * element.weight[q] * self.point_plastic_work(e, q, l);
                    for (n, value) in share.iter_mut().enumerate() {
                        value[0] += self.shapes[q][n] * work;
                    }
                }
                self.mesh.scatter_scalar::<1>(&share, element, l, nodal);
            }
        }
    }
}
