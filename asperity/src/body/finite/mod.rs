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

use super::heat::ElementHeat;
use super::{Body, TENSOR};
use crate::elastic;
use crate::element::{CORNERS, POINTS, VALUES};
use crate::lanes::{Lanes, fma};
use crate::sectors::VECTOR_PARITY;
use gradient::{
    TwoPoint, add_stress_force, cauchy_green_excess, cofactors, deformation_gradient, displacement_gradient,
    volume_excess,
};
use moduli::{ENTRIES, LogModuli, PointFrame, add_volume_curvature, symmetric_product};
use resolvents::{SMALL, SmallLog};
use spectral::{Spectral, log_1p};

mod gradient;
mod moduli;
mod resolvents;
mod spectral;

/// Values per point: ∂P/∂F and ∂J/∂F, times the point's weight.
const POINT_VALUES: usize = ENTRIES + 9;

/// Tangent at the last internal force.
#[derive(Clone, Debug)]
pub struct FiniteTangent {
    /// Point by point, value by value, angles as lanes. In single precision: the products are bound by
    /// the memory they read, and Newton's method does not notice.
    point: Vec<f32>,
    /// Per element and group of lanes: whether the displacement gradient is so small that the moduli of
    /// small strain will do. They are as wrong as that is large, which Newton's method does not notice.
    small: Vec<bool>,
    /// ψ'' over ∫J dV of each element: (K − p)/(V J̄²), p the mean stress.
    volumetric: Vec<f64>,
}

impl FiniteTangent {
    /// Whether the moduli of small strain will do for the element and group of angles at `at`.
    pub(super) fn is_small(&self, at: usize) -> bool {
        self.small[at]
    }

    pub fn new(elements: usize, lanes: usize) -> Self {
        Self {
            point: vec![0.0; elements * POINTS * POINT_VALUES * lanes],
            small: vec![false; elements * lanes],
            volumetric: vec![0.0; elements * lanes],
        }
    }
}

impl Body {
    /// As [`Body::internal_force`]. Where a point is turned inside out, the force is not a number.
    pub(super) fn finite_force(&mut self, u: &[f64], rise: Option<&[f64]>, force: &mut [f64]) {
        // Points beside angles: the spectral decomposition is a long chain of roots and quotients, of
        // which the machine works on several at once.
        match self.mesh.sectors.columns() {
            1 => self.finite_force_lanes::<1, 4, 4>(u, rise, force),
            n if n % 8 == 0 => self.finite_force_lanes::<8, 2, 16>(u, rise, force),
            _ => self.finite_force_lanes::<4, 2, 8>(u, rise, force),
        }
    }

    /// W angles and P points at a time, L = WP lanes.
    fn finite_force_lanes<const W: usize, const P: usize, const L: usize>(
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
                let nodal_force =
                    self.finite_element_force::<W, P, L>(e, first, &displacement, rise, &mut tangent);
                let element = &self.mesh.elements[e];
                self.mesh.scatter_vector(&nodal_force, element, first, force, &mut self.on_slope);
            }
        }
        self.finite = Some(tangent);
        self.mesh.sectors.add_transposed(&VECTOR_PARITY, &self.on_slope, force);
    }

    #[inline(always)]
    fn finite_element_force<const W: usize, const P: usize, const L: usize>(
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
        let mut largest = [0.0f64; W];
        for q in 0..POINTS {
            gradients[q] = displacement_gradient(&self.mesh.elements[e].shape[q], displacement);
            let point = volume_excess(&gradients[q]);
            for l in 0..W {
                let inverted = point[l] <= -1.0;
                excess[l] += if inverted { f64::NAN } else { weight[q] / volume * point[l] };
            }
            for component in gradients[q].as_flattened() {
                for l in 0..W {
                    largest[l] = largest[l].max(component[l].abs());
                }
            }
        }
        let largest = largest.into_iter().fold(0.0, f64::max);
        // p/J̄, by which ∂J/∂F gives the stress.
        let mut pressure = [0.0; W];
        let ln_ratio = log_1p(&excess);
        for l in 0..W {
            let stiffness = heat.stiffness.map_or(1.0, |factor| factor[l]);
            let bulk = stiffness * self.solid.moduli.bulk;
            let mean = bulk * (ln_ratio[l] - heat.thermal[l]);
            let ratio = 1.0 + excess[l];
            self.trial.mean_stress[at + l] = mean;
            self.trial.rise[at + l] = heat.mean_rise[l];
            pressure[l] = mean / ratio;
            tangent.volumetric[at + l] = (bulk - mean) / (volume * ratio * ratio);
        }
        if let Some(stiffness) = &heat.stiffness {
            self.tangent.stiffness[at..at + W].copy_from_slice(stiffness);
        }
        let small = largest <= SMALL;
        tangent.small[at] = small;
        let mut any_flows = false;
        let mut force = [[[0.0; W]; VALUES]; CORNERS];
        for chunk in (0..POINTS).step_by(P) {
            let gradient: TwoPoint<L> = std::array::from_fn(|i| {
                std::array::from_fn(|j| join::<W, L>(|p, l| gradients[chunk + p][i][j][l]))
            });
            let f = deformation_gradient(&gradient);
            let excess = cauchy_green_excess(&gradient);
            let cofactors = cofactors(&f);
            let (stress, flows) = if small {
                let small = SmallLog::new(&excess);
                let log_strain = small.log_strain();
                let (log_stress, flows) = self.log_stress::<W, P, L>(e, chunk, first, log_strain, &heat);
                (small.first_piola(&f, &log_stress), flows)
            } else {
                let spectral = Spectral::new(&excess);
                let log_strain = spectral.log_strain();
                let (log_stress, flows) = self.log_stress::<W, P, L>(e, chunk, first, log_strain, &heat);
                let frame = PointFrame::new(spectral, &f, &log_stress);
                let moduli = self.log_moduli::<W, L>(e, chunk, first, flows, heat.stiffness.as_ref());
                let mut moduli = frame.tangent(&moduli);
                add_volume_curvature(&join::<W, L>(|_, l| pressure[l]), &f, &mut moduli);
                for p in 0..P {
                    let q = chunk + p;
                    let mut keep = |i: usize, value: &Lanes<L>| {
                        let place = ((e * POINTS + q) * POINT_VALUES + i) * lanes + first;
                        let target = &mut tangent.point[place..place + W];
                        (0..W).for_each(|l| target[l] = (weight[q] * value[p * W + l]) as f32);
                    };
                    for i in 0..ENTRIES {
                        keep(i, &moduli[i]);
                    }
                    for i in 0..9 {
                        keep(ENTRIES + i, &cofactors[i / 3][i % 3]);
                    }
                }
                (frame.first_piola(), flows)
            };
            any_flows |= flows;
            for p in 0..P {
                let q = chunk + p;
                let mut of_point = [[[0.0; W]; 3]; 3];
                for i in 0..3 {
                    for j in 0..3 {
                        let (deviatoric, cofactor) = (&stress[i][j][p * W..], &cofactors[i][j][p * W..]);
                        for l in 0..W {
                            let sum = fma(pressure[l], cofactor[l], deviatoric[l]);
                            of_point[i][j][l] = weight[q] * sum;
                        }
                    }
                }
                add_stress_force(&self.mesh.elements[e].shape[q], &of_point, &mut force);
            }
        }
        self.tangent.flows[at] = any_flows;
        force
    }

    /// Deviator of the stress that works on the logarithmic strain, and whether any point flows.
    #[inline(always)]
    fn log_stress<const W: usize, const P: usize, const L: usize>(
        &mut self,
        e: usize,
        chunk: usize,
        first: usize,
        log_strain: [Lanes<L>; TENSOR],
        heat: &ElementHeat<W>,
    ) -> ([Lanes<L>; TENSOR], bool) {
        let mut deviator = log_strain;
        for l in 0..L {
            let third = (log_strain[0][l] + log_strain[1][l] + log_strain[2][l]) / 3.0;
            for component in &mut deviator[..3] {
                component[l] -= third;
            }
        }
        let mut log_stress = [[0.0; L]; TENSOR];
        let stale = self.tangent.flows[e * self.mesh.sectors.columns() + first];
        let mut flows = false;
        for p in 0..P {
            let of_point = deviator.map(|component| part::<W, L>(&component, p));
            let (stress, flowing) =
                self.point_stress::<W>(e, chunk + p, first, &of_point, heat.at_point(chunk + p), stale);
            flows |= flowing;
            for (joined, component) in log_stress.iter_mut().zip(&stress) {
                joined[p * W..][..W].copy_from_slice(component);
            }
        }
        (log_stress, flows)
    }

    /// Moduli in logarithmic strain after [`Body::log_stress`].
    #[inline(always)]
    fn log_moduli<const W: usize, const L: usize>(
        &self,
        e: usize,
        chunk: usize,
        first: usize,
        flows: bool,
        stiffness: Option<&Lanes<W>>,
    ) -> LogModuli<L> {
        let coefficient = |i: usize| join::<W, L>(|p, l| self.coefficient::<W>(e, chunk + p, i, first)[l]);
        let scaled = |i: usize| {
            join::<W, L>(|p, l| {
                stiffness.map_or(1.0, |factor| factor[l]) * self.coefficient::<W>(e, chunk + p, i, first)[l]
            })
        };
        LogModuli {
            shear: scaled(0),
            radial: scaled(1),
            // Stale where nothing flows, and its factor zero.
            direction: flows.then(|| std::array::from_fn(|i| coefficient(2 + i))),
        }
    }

    /// Share in [`Body::stiffness_loss`] of an element with large displacement gradients.
    #[inline(always)]
    pub(super) fn finite_loss<const W: usize>(
        &self,
        e: usize,
        first: usize,
        displacement: &[[Lanes<W>; VALUES]; CORNERS],
    ) -> [[Lanes<W>; VALUES]; CORNERS] {
        let element = &self.mesh.elements[e];
        let lanes = self.mesh.sectors.columns();
        let tangent = self.finite.as_ref().expect("of a body at finite strain");
        let value = |q: usize, i: usize| {
            let place = ((e * POINTS + q) * POINT_VALUES + i) * lanes + first;
            &tangent.point[place..place + W]
        };
        let mut stresses = [[[[0.0; W]; 3]; 3]; POINTS];
        // Change of ∫J dV.
        let mut growth = [0.0; W];
        for q in 0..POINTS {
            let gradient: TwoPoint<W> = displacement_gradient(&element.shape[q], displacement);
            stresses[q] = symmetric_product(|i| value(q, i), &gradient);
            for i in 0..9 {
                let (cofactor, component) = (value(q, ENTRIES + i), &gradient[i / 3][i % 3]);
                for l in 0..W {
                    growth[l] = fma(f64::from(cofactor[l]), component[l], growth[l]);
                }
            }
        }
        for l in 0..W {
            growth[l] *= tangent.volumetric[e * lanes + first + l];
        }
        let mut nodal_force = [[[0.0; W]; VALUES]; CORNERS];
        for q in 0..POINTS {
            for i in 0..9 {
                let (cofactor, component) = (value(q, ENTRIES + i), &mut stresses[q][i / 3][i % 3]);
                for l in 0..W {
                    component[l] = fma(f64::from(cofactor[l]), growth[l], component[l]);
                }
            }
            add_stress_force(&element.shape[q], &stresses[q], &mut nodal_force);
        }
        let mut loss = elastic::element_force(element, self.solid.moduli, displacement);
        for (loss, force) in loss.as_flattened_mut().iter_mut().zip(nodal_force.as_flattened()) {
            (0..W).for_each(|l| loss[l] -= force[l]);
        }
        loss
    }
}

/// Lanes of several points, W angles each, side by side.
#[inline(always)]
fn join<const W: usize, const L: usize>(value: impl Fn(usize, usize) -> f64) -> Lanes<L> {
    std::array::from_fn(|lane| value(lane / W, lane % W))
}

/// The lanes of point p of those side by side.
#[inline(always)]
fn part<const W: usize, const L: usize>(joined: &Lanes<L>, p: usize) -> Lanes<W> {
    std::array::from_fn(|l| joined[p * W + l])
}

#[cfg(test)]
mod tests;
