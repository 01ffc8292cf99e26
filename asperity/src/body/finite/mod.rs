//! Finite strain: internal force and tangent of the body in logarithmic strain.
//!
//! Total Lagrangian. The strain is Hencky's E = ½ ln C, in which elasticity, plasticity and their
//! history are those of small strain (additive: Miehe, Apel & Lambrecht 2002, Comput. Methods Appl.
//! Mech. Engrg 191, 5383): the deviator of E at each point, and ln J̄ in place of the dilatation, J̄
//! the mean of J = det F over the element and angle (mean dilatation: Simo, Taylor & Pister 1985,
//! Comput. Methods Appl. Mech. Engrg 51, 177). For small strain this is B̄. The elastic energy is
//!
//! ```text
//! ψ = ∫ G |dev(E − E_p)|² dV + V ½K (ln J̄ − 3∫α dθ̄)²,
//! ```
//!
//! so that force and tangent derive from a potential, and the tangent is symmetric. Stress
//! deviator and mean stress in [`BodyState`] are those that work on E per undeformed volume:
//! where the principal axes do not turn, Kirchhoff's.

use super::{Body, TENSOR};
use crate::element::{CORNERS, POINTS, VALUES};
use crate::lanes::{Lanes, fma};
use crate::sectors::VECTOR_PARITY;
use gradient::{
    TwoPoint, add_stress_force, cauchy_green_excess, cofactors, deformation_gradient, displacement_gradient,
    volume_excess,
};
use moduli::{ENTRIES, LogModuli, PointFrame, add_volume_curvature, symmetric_product};
use spectral::Spectral;

mod gradient;
mod moduli;
mod spectral;

/// Values per point: ∂P/∂F and ∂J/∂F, times the point's weight.
const POINT_VALUES: usize = ENTRIES + 9;

/// Tangent at the last internal force.
#[derive(Clone, Debug)]
pub struct FiniteTangent {
    /// Point by point, value by value, angles as lanes.
    point: Vec<f64>,
    /// ψ'' over ∫J dV of each element: (K − p)/(V J̄²), p the mean stress.
    volumetric: Vec<f64>,
}

impl FiniteTangent {
    pub fn new(elements: usize, lanes: usize) -> Self {
        Self {
            point: vec![0.0; elements * POINTS * POINT_VALUES * lanes],
            volumetric: vec![0.0; elements * lanes],
        }
    }
}

impl Body {
    /// As [`Body::internal_force`]. Where a point is turned inside out, the force is not a number.
    pub(super) fn finite_force<const W: usize>(
        &mut self,
        u: &[f64],
        rise: Option<&[f64]>,
        force: &mut [f64],
    ) {
        force.fill(0.0);
        self.on_slope.fill(0.0);
        self.mesh.sectors.differentiate(&VECTOR_PARITY, u, &mut self.slope);
        let lanes = self.mesh.sectors.columns();
        let mut tangent = self.finite.take().expect("of a body at finite strain");
        for e in 0..self.mesh.elements.len() {
            for first in (0..lanes).step_by(W) {
                let displacement =
                    self.mesh.gather_vector::<W>(u, &self.slope, &self.mesh.elements[e], first);
                let nodal_force = self.finite_element_force(e, first, &displacement, rise, &mut tangent);
                let element = &self.mesh.elements[e];
                self.mesh.scatter_vector(&nodal_force, element, first, force, &mut self.on_slope);
            }
        }
        self.finite = Some(tangent);
        self.mesh.sectors.add_transposed(&VECTOR_PARITY, &self.on_slope, force);
    }

    #[inline(always)]
    fn finite_element_force<const W: usize>(
        &mut self,
        e: usize,
        first: usize,
        displacement: &[[Lanes<W>; VALUES]; CORNERS],
        rise: Option<&[f64]>,
        tangent: &mut FiniteTangent,
    ) -> [[Lanes<W>; VALUES]; CORNERS] {
        let lanes = self.mesh.sectors.columns();
        let at = e * lanes + first;
        let heat = self.element_heat::<W>(e, first, rise, self.solid.stiffness_varies());
        let (volume, weight) = (self.mesh.elements[e].volume, self.mesh.elements[e].weight);
        let mut gradients = [[[[0.0; W]; 3]; 3]; POINTS];
        let mut excess = [0.0; W];
        for q in 0..POINTS {
            gradients[q] = displacement_gradient(&self.mesh.elements[e].shape[q], displacement);
            let point = volume_excess(&gradients[q]);
            for l in 0..W {
                let inverted = point[l] <= -1.0;
                excess[l] += if inverted { f64::NAN } else { weight[q] / volume * point[l] };
            }
        }
        // p/J̄, by which ∂J/∂F gives the stress.
        let mut pressure = [0.0; W];
        for l in 0..W {
            let stiffness = heat.stiffness.map_or(1.0, |factor| factor[l]);
            let bulk = stiffness * self.solid.moduli.bulk;
            let mean = bulk * (excess[l].ln_1p() - heat.thermal[l]);
            let ratio = 1.0 + excess[l];
            self.trial.mean_stress[at + l] = mean;
            self.trial.rise[at + l] = heat.mean_rise[l];
            pressure[l] = mean / ratio;
            tangent.volumetric[at + l] = (bulk - mean) / (volume * ratio * ratio);
        }
        let mut force = [[[0.0; W]; VALUES]; CORNERS];
        for q in 0..POINTS {
            let f = deformation_gradient(&gradients[q]);
            let spectral = Spectral::new(&cauchy_green_excess(&gradients[q]));
            let mut deviator = spectral.log_strain();
            for l in 0..W {
                let third = (spectral.strain[0][l] + spectral.strain[1][l] + spectral.strain[2][l]) / 3.0;
                for component in &mut deviator[..3] {
                    component[l] -= third;
                }
            }
            let (log_stress, flows) = self.point_stress::<W>(e, q, first, &deviator, heat.at_point(q));
            let frame = PointFrame::new(spectral, &f, &log_stress);
            let cofactors = cofactors(&f);
            let mut stress = frame.first_piola();
            let mut moduli = frame.tangent(&self.log_moduli(e, q, first, flows, heat.stiffness.as_ref()));
            add_volume_curvature(&pressure, &f, &mut moduli);
            for i in 0..3 {
                for j in 0..3 {
                    for l in 0..W {
                        let sum = fma(pressure[l], cofactors[i][j][l], stress[i][j][l]);
                        stress[i][j][l] = weight[q] * sum;
                    }
                }
            }
            let values = moduli.iter().chain(cofactors.iter().flatten());
            for (i, value) in values.enumerate() {
                let place = ((e * POINTS + q) * POINT_VALUES + i) * lanes + first;
                for (target, value) in tangent.point[place..place + W].iter_mut().zip(value) {
                    *target = weight[q] * value;
                }
            }
            add_stress_force(&self.mesh.elements[e].shape[q], &stress, &mut force);
        }
        force
    }

    /// Consistent moduli that [`Body::point_stress`] has left.
    #[inline(always)]
    fn log_moduli<const W: usize>(
        &self,
        e: usize,
        q: usize,
        first: usize,
        flows: bool,
        stiffness: Option<&Lanes<W>>,
    ) -> LogModuli<'_, W> {
        let [shear, radial, direction @ ..]: [&[f64]; 2 + TENSOR] =
            std::array::from_fn(|i| self.coefficient::<W>(e, q, i, first));
        let scaled = |values: &[f64]| -> Lanes<W> {
            std::array::from_fn(|l| stiffness.map_or(1.0, |factor| factor[l]) * values[l])
        };
        LogModuli { shear: scaled(shear), radial: scaled(radial), direction: flows.then_some(direction) }
    }

    /// As [`Body::tangent_product`].
    pub(super) fn finite_tangent_product<const W: usize>(&mut self, u: &[f64], force: &mut [f64]) {
        force.fill(0.0);
        self.on_slope.fill(0.0);
        self.mesh.sectors.differentiate(&VECTOR_PARITY, u, &mut self.slope);
        let lanes = self.mesh.sectors.columns();
        let tangent = self.finite.as_ref().expect("of a body at finite strain");
        for (e, element) in self.mesh.elements.iter().enumerate() {
            for first in (0..lanes).step_by(W) {
                let displacement = self.mesh.gather_vector::<W>(u, &self.slope, element, first);
                let value = |q: usize, i: usize| {
                    let place = ((e * POINTS + q) * POINT_VALUES + i) * lanes + first;
                    &tangent.point[place..place + W]
                };
                let mut stresses = [[[[0.0; W]; 3]; 3]; POINTS];
                // Change of ∫J dV.
                let mut growth = [0.0; W];
                for q in 0..POINTS {
                    let gradient: TwoPoint<W> = displacement_gradient(&element.shape[q], &displacement);
                    stresses[q] = symmetric_product(|i| value(q, i), &gradient);
                    for (i, component) in gradient.iter().flatten().enumerate() {
                        let cofactor = value(q, ENTRIES + i);
                        for l in 0..W {
                            growth[l] = fma(cofactor[l], component[l], growth[l]);
                        }
                    }
                }
                for l in 0..W {
                    growth[l] *= tangent.volumetric[e * lanes + first + l];
                }
                let mut nodal_force = [[[0.0; W]; VALUES]; CORNERS];
                for q in 0..POINTS {
                    for (i, component) in stresses[q].iter_mut().flatten().enumerate() {
                        let cofactor = value(q, ENTRIES + i);
                        for l in 0..W {
                            component[l] = fma(cofactor[l], growth[l], component[l]);
                        }
                    }
                    add_stress_force(&element.shape[q], &stresses[q], &mut nodal_force);
                }
                self.mesh.scatter_vector(&nodal_force, element, first, force, &mut self.on_slope);
            }
        }
        self.mesh.sectors.add_transposed(&VECTOR_PARITY, &self.on_slope, force);
    }
}

#[cfg(test)]
mod tests;
