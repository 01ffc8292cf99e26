//! The elastic–plastic body: history at the Gauss points, internal forces, consistent tangent
//! and mechanical energies. Small strain.
//!
//! Stress at a Gauss point: deviator s = 2G(e − ε_p), mean stress p = K(ε̄_v − 3αθ̄), where the
//! dilatation ε̄_v and the temperature rise θ̄ are means over the element (B̄). Consistent tangent
//! of the radial return: de Souza Neto, Perić & Owen, Computational Methods for Plasticity
//! (2008), eq. (7.120).

use crate::element::{
    Element, POINTS, RevolvedMesh, deviators_and_dilatation, shape_at_points, stress_force,
};
use crate::lanes::Lanes;
use crate::material::{Return, Solid};

mod surface;

/// History of all Gauss points: element by element, point by point, component by component,
/// sectors as lanes.
#[derive(Clone, Debug)]
pub struct BodyState {
    /// Plastic strain (deviatoric), 6 components.
    plastic_strain: Vec<f64>,
    /// Deviatoric stress, 6 components.
    deviator: Vec<f64>,
    /// Equivalent plastic strain.
    accumulated: Vec<f64>,
    /// Strength without softening at that strain, kept to spare its power law.
    strength: Vec<f64>,
    /// Mean stress, one per element.
    mean_stress: Vec<f64>,
    /// Mean temperature rise, one per element.
    rise: Vec<f64>,
}

/// Consistent tangent at points that flow: 2G(1 − softening)·dev − radial·(n:e)n.
#[derive(Clone, Debug)]
struct Tangent {
    /// Per element and group of lanes: whether any point flows.
    flows: Vec<bool>,
    /// (2G-factor, radial factor, n) per point, 8 values.
    coefficients: Vec<f64>,
}

/// Energies of a step or since a state, J in the problem's units, half body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MechanicalEnergies {
    pub plastic: f64,
    pub thermal_expansion: f64,
}

#[derive(Clone, Debug)]
pub struct Body {
    pub mesh: RevolvedMesh,
    pub solid: Solid,
    /// 1/K.
    pub expansion: f64,
    pub committed: BodyState,
    pub trial: BodyState,
    tangent: Tangent,
    shapes: [[f64; 8]; POINTS],
}

const TENSOR: usize = 6;
const COEFFICIENTS: usize = 8;

/// Runs the body with W lanes at a time.
macro_rules! by_lanes {
    ($self:ident . $method:ident ( $($argument:expr),* )) => {
        match $self.mesh.sectors.lanes() {
            1 => $self.$method::<1>($($argument),*),
            n if n % 8 == 0 => $self.$method::<8>($($argument),*),
            _ => $self.$method::<4>($($argument),*),
        }
    };
}

impl BodyState {
    fn new(elements: usize, lanes: usize) -> Self {
        let points = elements * POINTS * lanes;
        Self {
            plastic_strain: vec![0.0; points * TENSOR],
            deviator: vec![0.0; points * TENSOR],
            accumulated: vec![0.0; points],
            strength: vec![1.0; points],
            mean_stress: vec![0.0; elements * lanes],
            rise: vec![0.0; elements * lanes],
        }
    }

    /// Largest equivalent plastic strain.
    pub fn largest_plastic_strain(&self) -> f64 {
        self.accumulated.iter().fold(0.0, |m, &x| m.max(x))
    }

    /// The same axisymmetric state in each of `lanes` sectors.
    fn spread(&self, lanes: usize) -> Self {
        let spread = |v: &[f64]| v.iter().flat_map(|&x| std::iter::repeat_n(x, lanes)).collect();
        Self {
            plastic_strain: spread(&self.plastic_strain),
            deviator: spread(&self.deviator),
            accumulated: spread(&self.accumulated),
            strength: spread(&self.strength),
            mean_stress: spread(&self.mean_stress),
            rise: spread(&self.rise),
        }
    }

    fn copy_from(&mut self, other: &Self) {
        self.plastic_strain.copy_from_slice(&other.plastic_strain);
        self.deviator.copy_from_slice(&other.deviator);
        self.accumulated.copy_from_slice(&other.accumulated);
        self.strength.copy_from_slice(&other.strength);
        self.mean_stress.copy_from_slice(&other.mean_stress);
        self.rise.copy_from_slice(&other.rise);
    }
}

impl Body {
    /// Virgin body.
    pub fn new(mesh: RevolvedMesh, solid: Solid, expansion: f64) -> Self {
        let (elements, lanes) = (mesh.elements.len(), mesh.sectors.lanes());
        let state = BodyState::new(elements, lanes);
        let tangent = Tangent {
            flows: vec![false; elements * lanes],
            coefficients: vec![0.0; elements * POINTS * COEFFICIENTS * lanes],
        };
        Self {
            solid,
            expansion,
            committed: state.clone(),
            trial: state,
            tangent,
            shapes: shape_at_points(),
            mesh,
        }
    }

    /// Body of revolution with the history of an axisymmetric one on the same meridian.
    pub fn revolve(axisymmetric: &Body, mesh: RevolvedMesh) -> Self {
        let lanes = mesh.sectors.lanes();
        let mut body = Self::new(mesh, axisymmetric.solid.clone(), axisymmetric.expansion);
        body.committed = axisymmetric.committed.spread(lanes);
        body.trial = body.committed.clone();
        body
    }

    /// Takes the trial state as the new history.
    pub fn commit(&mut self) {
        self.committed.copy_from(&self.trial);
    }

    /// Internal nodal forces at displacement `u` and temperature rise `rise` (zero if absent);
    /// sets the trial state and the tangent.
    pub fn internal_force(&mut self, u: &[f64], rise: Option<&[f64]>, force: &mut [f64]) {
        by_lanes!(self.internal_force_lanes(u, rise, force));
    }

    fn internal_force_lanes<const W: usize>(&mut self, u: &[f64], rise: Option<&[f64]>, force: &mut [f64]) {
        force.fill(0.0);
        let lanes = self.mesh.sectors.lanes();
        for e in 0..self.mesh.elements.len() {
            for first in (0..lanes).step_by(W) {
                let element = &self.mesh.elements[e];
                let displacement = self.mesh.gather_vector::<W>(u, element, first);
                let nodal_rise = rise.map(|field| self.mesh.gather_scalar::<W>(field, element, first));
                let (point_rise, mean_rise) = self.temperatures(element, nodal_rise);
                let weakest = nodal_rise.map_or(1.0, |nodal| {
                    let hottest = nodal.iter().flatten().fold(0.0f64, |m, &t| m.max(t));
                    self.solid.softening_factor(hottest).min(1.0)
                });
                let (deviators, dilatation) = deviators_and_dilatation(element, &displacement);
                let mut mean_stress = [0.0; W];
                for l in 0..W {
                    mean_stress[l] =
                        self.solid.moduli.bulk * (dilatation[l] - 3.0 * self.expansion * mean_rise[l]);
                }
                let at = e * lanes + first;
                self.trial.mean_stress[at..at + W].copy_from_slice(&mean_stress);
                self.trial.rise[at..at + W].copy_from_slice(&mean_rise);

                let mut stresses = [[[0.0; W]; TENSOR]; POINTS];
                let mut flows = false;
                for q in 0..POINTS {
                    let (mut stress, flowing) =
                        self.point_stress::<W>(e, q, first, &deviators[q], &point_rise[q], weakest);
                    flows |= flowing;
                    let weight = self.mesh.elements[e].weight[q];
                    for (i, component) in stress.iter_mut().enumerate() {
                        for l in 0..W {
                            let mean = if i < 3 { mean_stress[l] } else { 0.0 };
                            component[l] = weight * (component[l] + mean);
                        }
                    }
                    stresses[q] = stress;
                }
                self.tangent.flows[e * lanes + first] = flows;
                let nodal_force = stress_force(&self.mesh.elements[e], &stresses);
                self.mesh.scatter_vector(&nodal_force, &self.mesh.elements[e], first, force);
            }
        }
    }

    /// Temperature rise at the Gauss points and its mean over the element.
    #[inline(always)]
    fn temperatures<const W: usize>(
        &self,
        element: &Element,
        nodal: Option<[Lanes<W>; 8]>,
    ) -> ([Lanes<W>; POINTS], Lanes<W>) {
        let mut points = [[0.0; W]; POINTS];
        let mut mean = [0.0; W];
        if let Some(nodal) = nodal {
            for q in 0..POINTS {
                for (n, value) in nodal.iter().enumerate() {
                    for l in 0..W {
                        points[q][l] += self.shapes[q][n] * value[l];
                    }
                }
                for l in 0..W {
                    mean[l] += element.weight[q] / element.volume * points[q][l];
                }
            }
        }
        (points, mean)
    }

    /// Radial return at one point: deviatoric stress and whether any lane flows.
    #[inline(always)]
    fn point_stress<const W: usize>(
        &mut self,
        e: usize,
        q: usize,
        first: usize,
        deviator: &[Lanes<W>; TENSOR],
        rise: &Lanes<W>,
        weakest: f64,
    ) -> ([Lanes<W>; TENSOR], bool) {
        let lanes = self.mesh.sectors.lanes();
        let point = e * POINTS + q;
        let tensor = |i: usize| (point * TENSOR + i) * lanes + first;
        let scalar = point * lanes + first;
        let two_shear = 2.0 * self.solid.moduli.shear;

        let mut stress = [[0.0; W]; TENSOR];
        let mut squared = [0.0; W];
        for i in 0..TENSOR {
            let plastic = &self.committed.plastic_strain[tensor(i)..tensor(i) + W];
            let factor = if i < 3 { 1.5 } else { 3.0 };
            for l in 0..W {
                stress[i][l] = two_shear * (deviator[i][l] - plastic[l]);
                squared[l] += factor * stress[i][l] * stress[i][l];
            }
        }
        let mut flowing = [false; W];
        let mut any = false;
        for l in 0..W {
            let strength = self.committed.strength[scalar + l];
            // No softening factor need be evaluated where the lowest one in the element keeps the
            // point elastic.
            let least = weakest * strength;
            flowing[l] = squared[l] > least * least && {
                let limit = strength * self.solid.softening_factor(rise[l]);
                squared[l] > limit * limit
            };
            any |= flowing[l];
        }
        // The return mapping of the iteration before is a good first guess.
        let mut guess = [0.0; W];
        for i in 0..TENSOR {
            let at = tensor(i);
            self.trial.plastic_strain[at..at + W].copy_from_slice(&self.committed.plastic_strain[at..at + W]);
        }
        for l in 0..W {
            guess[l] = self.trial.accumulated[scalar + l] - self.committed.accumulated[scalar + l];
            self.trial.accumulated[scalar + l] = self.committed.accumulated[scalar + l];
            self.trial.strength[scalar + l] = self.committed.strength[scalar + l];
        }
        let coefficient = |i: usize| (point * COEFFICIENTS + i) * lanes + first;
        if any {
            for l in 0..W {
                self.tangent.coefficients[coefficient(0) + l] = two_shear;
                self.tangent.coefficients[coefficient(1) + l] = 0.0;
                if !flowing[l] {
                    continue;
                }
                let trial = squared[l].sqrt();
                let strain = self.committed.accumulated[scalar + l];
                let Return { increment, slope } = self.solid.return_map(trial, strain, rise[l], guess[l]);
                let shear = self.solid.moduli.shear;
                let ratio = 3.0 * shear * increment / trial;
                self.trial.accumulated[scalar + l] = strain + increment;
                self.trial.strength[scalar + l] = self.solid.yield_strength(strain + increment, 0.0);
                self.tangent.coefficients[coefficient(0) + l] = two_shear * (1.0 - ratio);
                // 6G²(Δγ/q − 1/(3G + H)) n⊗n with unit n: never positive.
                self.tangent.coefficients[coefficient(1) + l] =
                    6.0 * shear * shear * (increment / trial - 1.0 / (3.0 * shear + slope));
                let norm = trial * (2.0f64 / 3.0).sqrt();
                for i in 0..TENSOR {
                    let direction = stress[i][l] / norm;
                    self.tangent.coefficients[coefficient(2 + i) + l] = direction;
                    self.trial.plastic_strain[tensor(i) + l] += increment * 1.5f64.sqrt() * direction;
                    stress[i][l] *= 1.0 - ratio;
                }
            }
        } else {
            // Read by the tangent if another point of the element flows.
            self.tangent.coefficients[coefficient(0)..coefficient(0) + W].fill(two_shear);
            self.tangent.coefficients[coefficient(1)..coefficient(1) + W].fill(0.0);
        }
        for i in 0..TENSOR {
            self.trial.deviator[tensor(i)..tensor(i) + W].copy_from_slice(&stress[i]);
        }
        (stress, any)
    }

    /// Product of the consistent tangent at the last internal force with a displacement.
    pub fn tangent_product(&self, u: &[f64], force: &mut [f64]) {
        by_lanes!(self.tangent_product_lanes(u, force));
    }

    fn tangent_product_lanes<const W: usize>(&self, u: &[f64], force: &mut [f64]) {
        force.fill(0.0);
        let lanes = self.mesh.sectors.lanes();
        for (e, element) in self.mesh.elements.iter().enumerate() {
            for first in (0..lanes).step_by(W) {
                let displacement = self.mesh.gather_vector::<W>(u, element, first);
                let nodal_force = if self.tangent.flows[e * lanes + first] {
                    self.plastic_element_force(e, first, &displacement)
                } else {
                    crate::elastic::element_force(element, self.solid.moduli, &displacement)
                };
                self.mesh.scatter_vector(&nodal_force, element, first, force);
            }
        }
    }

    #[inline(always)]
    fn plastic_element_force<const W: usize>(
        &self,
        e: usize,
        first: usize,
        displacement: &[[Lanes<W>; 3]; 8],
    ) -> [[Lanes<W>; 3]; 8] {
        let lanes = self.mesh.sectors.lanes();
        let element = &self.mesh.elements[e];
        let (mut stresses, dilatation) = deviators_and_dilatation(element, displacement);
        for q in 0..POINTS {
            let point = e * POINTS + q;
            let coefficient = |i: usize| {
                let at = (point * COEFFICIENTS + i) * lanes + first;
                &self.tangent.coefficients[at..at + W]
            };
            let (shear, radial) = (coefficient(0), coefficient(1));
            let stress = &mut stresses[q];
            // n is stale where nothing flows, and its factor zero.
            let mut projection = [0.0; W];
            for i in 0..TENSOR {
                let direction = coefficient(2 + i);
                let factor = if i < 3 { 1.0 } else { 2.0 };
                for l in 0..W {
                    projection[l] += factor * direction[l] * stress[i][l];
                }
            }
            let weight = element.weight[q];
            for (i, component) in stress.iter_mut().enumerate() {
                let direction = coefficient(2 + i);
                for l in 0..W {
                    let mean = if i < 3 { self.solid.moduli.bulk * dilatation[l] } else { 0.0 };
                    component[l] =
                        weight * (shear[l] * component[l] + radial[l] * projection[l] * direction[l] + mean);
                }
            }
        }
        stress_force(element, &stresses)
    }

    /// Elastic energy ∫½ s:s/2G + p²/2K of a state, half body.
    pub fn elastic_energy(&self, state: &BodyState) -> f64 {
        let lanes = self.mesh.sectors.lanes();
        let moduli = self.solid.moduli;
        let mut energy = 0.0;
        for (e, element) in self.mesh.elements.iter().enumerate() {
            for l in 0..lanes {
                let p = state.mean_stress[e * lanes + l];
                energy += element.volume * p * p / (2.0 * moduli.bulk);
                for q in 0..POINTS {
                    let s = |i: usize| state.deviator[((e * POINTS + q) * TENSOR + i) * lanes + l];
                    let squared: f64 =
                        (0..TENSOR).map(|i| if i < 3 { s(i) * s(i) } else { 2.0 * s(i) * s(i) }).sum();
                    energy += element.weight[q] * squared / (4.0 * moduli.shear);
                }
            }
        }
        energy * self.mesh.sectors.multiplicity()
    }

    /// Plastic work of the step at each Gauss point, by the trapezoidal rule, which closes the
    /// energy balance of the step exactly: ½(s₀ + s₁):Δε_p per volume.
    fn point_plastic_work(&self, point: usize, l: usize) -> f64 {
        let lanes = self.mesh.sectors.lanes();
        (0..TENSOR)
            .map(|i| {
                let at = (point * TENSOR + i) * lanes + l;
                let mean = 0.5 * (self.committed.deviator[at] + self.trial.deviator[at]);
                let change = self.trial.plastic_strain[at] - self.committed.plastic_strain[at];
                if i < 3 { mean * change } else { 2.0 * mean * change }
            })
            .sum()
    }

    /// Plastic work and work through thermal expansion of the step from committed to trial.
    pub fn step_energies(&self) -> MechanicalEnergies {
        let lanes = self.mesh.sectors.lanes();
        let mut energies = MechanicalEnergies::default();
        for (e, element) in self.mesh.elements.iter().enumerate() {
            for l in 0..lanes {
                let at = e * lanes + l;
                let mean = 0.5 * (self.committed.mean_stress[at] + self.trial.mean_stress[at]);
                let rise = self.trial.rise[at] - self.committed.rise[at];
                energies.thermal_expansion += element.volume * mean * 3.0 * self.expansion * rise;
                for q in 0..POINTS {
                    energies.plastic += element.weight[q] * self.point_plastic_work(e * POINTS + q, l);
                }
            }
        }
        let multiplicity = self.mesh.sectors.multiplicity();
        energies.plastic *= multiplicity;
        energies.thermal_expansion *= multiplicity;
        energies
    }

    /// Adds `factor` times the plastic work of the step to the nodes.
    pub fn add_plastic_work(&self, factor: f64, nodal: &mut [f64]) {
        let lanes = self.mesh.sectors.lanes();
        for (e, element) in self.mesh.elements.iter().enumerate() {
            for l in 0..lanes {
                let mut share = [[0.0; 1]; 8];
                for q in 0..POINTS {
                    let work = factor * element.weight[q] * self.point_plastic_work(e * POINTS + q, l);
                    for (n, value) in share.iter_mut().enumerate() {
                        value[0] += self.shapes[q][n] * work;
                    }
                }
                self.mesh.scatter_scalar::<1>(&share, element, l, nodal);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{MeridianMesh, MeshSize};
    use crate::scene::{Hardening, Material, Softening};
    use crate::sectors::Sectors;

    pub(super) fn body(hardening: Hardening, sectors: Sectors) -> Body {
        let material = Material {
            youngs_modulus: 200e9,
            poisson_ratio: 0.3,
            yield_strength: 400e6,
            hardening,
            density: 7850.0,
            specific_heat: 475.0,
            thermal_conductivity: 45.0,
            thermal_expansion: 1.2e-5,
            softening: Softening::JohnsonCook { reference: 298.0, melting: 1793.0, exponent: 1.0 },
        };
        let meridian = MeridianMesh::new(MeshSize { contact_radius: 0.1, elements_per_radius: 4 });
        let mesh = RevolvedMesh::new(meridian, sectors);
        Body::new(mesh, Solid::new(&material, 298.0), material.thermal_expansion)
    }

    pub(super) fn wave(n: usize, scale: f64, phase: f64) -> Vec<f64> {
        (0..n).map(|i| scale * (i as f64 * 0.37 + phase).sin()).collect()
    }

    #[test]
    fn tangent_agrees_with_finite_differences() {
        for hardening in [
            Hardening::None,
            Hardening::Linear { modulus: 2e9 },
            Hardening::JohnsonCook { modulus: 510e6, exponent: 0.26 },
        ] {
            let mut body = body(hardening, Sectors::full(4));
            let n = body.mesh.field_length(3);
            let rise: Vec<f64> =
                wave(body.mesh.field_length(1), 100.0, 0.3).iter().map(|t| t + 150.0).collect();
            // Strains of a few per cent in the fine elements; history from a first step.
            let first = wave(n, 2e-4, 0.1);
            let mut force = vec![0.0; n];
            body.internal_force(&first, None, &mut force);
            body.commit();
            let u: Vec<f64> = first.iter().zip(wave(n, 1e-4, 1.0)).map(|(a, b)| a + b).collect();
            let d = wave(n, 1e-4, 2.0);
            let at = |body: &mut Body, t: f64| {
                let x: Vec<f64> = u.iter().zip(&d).map(|(a, b)| a + t * b).collect();
                let mut f = vec![0.0; n];
                body.internal_force(&x, Some(&rise), &mut f);
                f
            };
            let h = 1e-6;
            let (plus, minus) = (at(&mut body, h), at(&mut body, -h));
            at(&mut body, 0.0);
            assert!(body.tangent.flows.contains(&true));
            let mut product = vec![0.0; n];
            body.tangent_product(&d, &mut product);
            let norm = product.iter().map(|x| x * x).sum::<f64>().sqrt();
            let error =
                (0..n).map(|i| ((plus[i] - minus[i]) / (2.0 * h) - product[i]).powi(2)).sum::<f64>().sqrt();
            assert!(error < 1e-6 * norm, "{error} {norm}");
        }
    }

    #[test]
    fn internal_work_is_stored_or_dissipated() {
        let mut body = body(Hardening::Linear { modulus: 2e9 }, Sectors::full(4));
        let n = body.mesh.field_length(3);
        let (u0, u1) = (wave(n, 1e-4, 0.1), wave(n, 1.5e-4, 0.4));
        let (mut f0, mut f1) = (vec![0.0; n], vec![0.0; n]);
        body.internal_force(&u0, None, &mut f0);
        body.commit();
        let rise = wave(body.mesh.field_length(1), 50.0, 0.0);
        body.internal_force(&u1, Some(&rise), &mut f1);
        let work: f64 = (0..n).map(|i| 0.5 * (f0[i] + f1[i]) * (u1[i] - u0[i])).sum();
        let MechanicalEnergies { plastic, thermal_expansion } = body.step_energies();
        let elastic = body.elastic_energy(&body.trial) - body.elastic_energy(&body.committed);
        assert!(plastic > 0.0);
        assert!((work - elastic - plastic - thermal_expansion).abs() < 1e-12 * work.abs().max(plastic));
        let mut nodal = vec![0.0; body.mesh.field_length(1)];
        body.add_plastic_work(1.0, &mut nodal);
        assert!((nodal.iter().sum::<f64>() - plastic).abs() < 1e-12 * plastic);
    }

    #[test]
    fn axisymmetric_and_revolved_bodies_agree() {
        let mut flat =
            body(Hardening::JohnsonCook { modulus: 510e6, exponent: 0.26 }, Sectors::axisymmetric(8));
        let n = flat.mesh.field_length(3);
        let mut u = wave(n, 2e-4, 0.1);
        for node in 0..flat.mesh.node_count() {
            u[3 * node + 1] = 0.0;
        }
        let mut force = vec![0.0; n];
        flat.internal_force(&u, None, &mut force);
        flat.commit();
        let sectors = Sectors::full(8);
        let mesh = RevolvedMesh::new(flat.mesh.meridian.clone(), sectors);
        let mut round = Body::revolve(&flat, mesh);
        let mut round_force = vec![0.0; round.mesh.field_length(3)];
        round.internal_force(&sectors.spread(&u), None, &mut round_force);
        let scale = force.iter().fold(0.0f64, |m, f| m.max(f.abs()));
        for node in 0..flat.mesh.node_count() {
            for c in [0, 2] {
                let sum: f64 = (0..9).map(|j| round_force[(3 * node + c) * 9 + j]).sum();
                assert!((sum - force[3 * node + c]).abs() < 1e-12 * scale);
            }
        }
        assert_eq!(round.trial.largest_plastic_strain(), flat.committed.largest_plastic_strain());
    }
}
