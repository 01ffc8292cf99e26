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
//! from which force and tangent derive where nothing flows; where a point does, the tangent is made of that of
//! [`Solid::flow`](crate::material::Solid::flow), and symmetric as that is. Stress
//! deviator and mean stress in [`BodyState`] are those that work on E per undeformed volume:
//! where the principal axes do not turn, Kirchhoff's.

use super::heat::ElementHeat;
use super::{Body, TENSOR};
use crate::discretisation::collocation::VECTOR_PARITY;
use crate::discretisation::elastic;
use crate::discretisation::element::{CORNERS, POINTS, VALUES};
use crate::material::lanes::{Lanes, Pack, lanes_of};
use gradient::{
    Symmetric, add_stress_force, cauchy_green_excess, cofactors, deformation_gradient, displacement_gradient,
    packed_shape, volume_excess,
};
use log_strain::{Rules, first_piola};
use moduli::{ENTRIES, LogModuli, add_volume_curvature, symmetric_product};
use wide::{f64x4, f64x8};

mod gradient;
mod log_strain;
mod moduli;

/// Largest component of the displacement gradient up to which the moduli of small strain will do.
const SMALL: f64 = 1e-2;

/// Lanes of a pack at most.
const MOST_LANES: usize = 8;

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
    /// For the logarithm.
    rules: Rules,
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
            rules: Rules::new(),
        }
    }
}

impl Body {
    /// As [`Body::internal_force`]. Where a point is turned inside out, the force is not a number.
    pub(super) fn finite_force(&mut self, u: &[f64], rise: Option<&[f64]>, force: &mut [f64]) {
        // Points beside angles where these alone do not fill a vector register.
        match self.mesh.sectors.columns() {
            1 => self.finite_force_lanes::<1, 4, f64, f64x4>(u, rise, force),
            n if n % 8 == 0 => self.finite_force_lanes::<8, 1, f64x8, f64x8>(u, rise, force),
            _ => self.finite_force_lanes::<4, 2, f64x4, f64x8>(u, rise, force),
        }
    }

    /// W angles at a time, which A has room for, and P points of them, for which V has it.
    fn finite_force_lanes<const W: usize, const P: usize, A: Pack, V: Pack>(
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
                    self.mesh.gather_vector::<A>(u, &self.slope, &self.mesh.elements[e], first);
                let nodal_force =
                    self.finite_element_force::<W, P, A, V>(e, first, &displacement, rise, &mut tangent);
                let element = &self.mesh.elements[e];
                self.mesh.scatter_vector(&nodal_force, element, first, force, &mut self.on_slope);
            }
        }
        self.finite = Some(tangent);
        self.mesh.sectors.add_transposed(&VECTOR_PARITY, &self.on_slope, force);
    }

    #[inline(always)]
    fn finite_element_force<const W: usize, const P: usize, A: Pack, V: Pack>(
        &mut self,
        e: usize,
        first: usize,
        displacement: &[[A; VALUES]; CORNERS],
        rise: Option<&[f64]>,
        tangent: &mut FiniteTangent,
    ) -> [[A; VALUES]; CORNERS] {
        let lanes = self.mesh.sectors.columns();
        let at = e * lanes + first;
        let heat = self.element_heat::<W>(e, first, rise, self.solid.stiffness_varies());
        let (volume, weight) = (self.mesh.elements[e].volume, self.mesh.elements[e].weight);
        let zero = V::splat(0.0);
        let values = packed_values::<W, P, A, V>(displacement);
        let shapes = |chunk: usize| {
            let of_points = std::array::from_fn(|p| &self.mesh.elements[e].shape[chunk * P + p]);
            packed_shape::<P, V>(of_points, spread::<W, P, V>)
        };
        let mut gradients = [[[zero; 3]; 3]; POINTS];
        let mut excess = [0.0; W];
        let mut largest = zero;
        for (chunk, gradient) in gradients[..POINTS / P].iter_mut().enumerate() {
            *gradient = displacement_gradient(&shapes(chunk), &values);
            largest = gradient.as_flattened().iter().fold(largest, |largest, &h| h.larger(largest));
            let point = volume_excess(gradient);
            for p in 0..P {
                let (point, share) = (unpack::<W, V>(point, p), weight[chunk * P + p] / volume);
                for l in 0..W {
                    let inverted = point[l] <= -1.0;
                    excess[l] += if inverted { f64::NAN } else { share * point[l] };
                }
            }
        }
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
        let small = largest.largest() <= SMALL;
        tangent.small[at] = small;
        let pressure_of_points = pack::<W, P, V>(|_| &pressure);
        let mut any_flows = false;
        let mut force = [[zero; VALUES]; CORNERS];
        for (chunk, gradient) in gradients[..POINTS / P].iter().enumerate() {
            let chunk = chunk * P;
            let f = deformation_gradient(gradient);
            let cofactors = cofactors(&f);
            let log = tangent.rules.log(&cauchy_green_excess(gradient));
            let (log_stress, flows) = self.log_stress::<W, P, A, V>(e, chunk, first, &log.strain(), &heat);
            let second = log.second_piola(&log_stress);
            any_flows |= flows;
            if !small {
                let moduli = self.log_moduli::<W, P, V>(e, chunk, first, flows, heat.stiffness.as_ref());
                let mut moduli = moduli::tangent(&log, &f, &log_stress, &second, &moduli);
                add_volume_curvature(pressure_of_points, &f, &mut moduli);
                let values = moduli.iter().chain(cofactors.as_flattened());
                for p in 0..P {
                    let q = chunk + p;
                    let place = (e * POINTS + q) * POINT_VALUES * lanes + first;
                    for (target, &value) in tangent.point[place..].chunks_mut(lanes).zip(values.clone()) {
                        let value = unpack::<W, V>(value, p);
                        (0..W).for_each(|l| target[l] = (weight[q] * value[l]) as f32);
                    }
                }
            }
            let mut stress = first_piola(&f, &second);
            let weight = spread::<W, P, V>(std::array::from_fn(|p| weight[chunk + p]));
            for (stress, cofactor) in stress.as_flattened_mut().iter_mut().zip(cofactors.as_flattened()) {
                *stress = weight * pressure_of_points.mul_add(*cofactor, *stress);
            }
            let of_points = std::array::from_fn(|p| &self.mesh.elements[e].shape[chunk + p]);
            add_stress_force(&packed_shape::<P, V>(of_points, spread::<W, P, V>), &stress, &mut force);
        }
        self.tangent.flows[at] = any_flows;
        summed::<W, P, A, V>(&force)
    }

    /// Deviator of the stress that works on the logarithmic strain, and whether any point flows.
    #[inline(always)]
    fn log_stress<const W: usize, const P: usize, A: Pack, V: Pack>(
        &mut self,
        e: usize,
        chunk: usize,
        first: usize,
        log_strain: &Symmetric<V>,
        heat: &ElementHeat<W>,
    ) -> (Symmetric<V>, bool) {
        let third = V::splat(1.0 / 3.0) * (log_strain[0] + log_strain[1] + log_strain[2]);
        let deviator: Symmetric<V> =
            std::array::from_fn(|v| if v < 3 { log_strain[v] - third } else { log_strain[v] });
        let stale = self.tangent.flows[e * self.mesh.sectors.columns() + first];
        let mut flows = false;
        let of_points: [[Lanes<W>; TENSOR]; P] = std::array::from_fn(|p| {
            let of_point = deviator.map(|component| A::load(&unpack::<W, V>(component, p)));
            let (stress, flowing) =
                self.point_stress::<W, A>(e, chunk + p, first, &of_point, heat.at_point(chunk + p), stale);
            flows |= flowing;
            stress.map(lanes_of)
        });
        (std::array::from_fn(|v| pack::<W, P, V>(|p| &of_points[p][v])), flows)
    }

    /// Moduli in logarithmic strain after [`Body::log_stress`].
    #[inline(always)]
    fn log_moduli<const W: usize, const P: usize, V: Pack>(
        &self,
        e: usize,
        chunk: usize,
        first: usize,
        flows: bool,
        stiffness: Option<&Lanes<W>>,
    ) -> LogModuli<V> {
        let coefficient = |i: usize| pack::<W, P, V>(|p| self.coefficient::<W>(e, chunk + p, i, first));
        let stiffness = stiffness.map_or(V::splat(1.0), |factor| pack::<W, P, V>(|_| factor));
        LogModuli {
            shear: stiffness * coefficient(0),
            radial: stiffness * coefficient(1),
            // Stale where nothing flows, and its factor zero.
            direction: flows.then(|| std::array::from_fn(|i| coefficient(2 + i))),
        }
    }

    /// Share in [`Body::stiffness_loss`] of an element with large displacement gradients.
    #[inline(always)]
    pub(super) fn finite_loss<V: Pack>(
        &self,
        e: usize,
        first: usize,
        displacement: &[[V; VALUES]; CORNERS],
    ) -> [[V; VALUES]; CORNERS] {
        let element = &self.mesh.elements[e];
        let lanes = self.mesh.sectors.columns();
        let tangent = self.finite.as_ref().expect("of a body at finite strain");
        let value = |q: usize, i: usize| {
            V::load_single(&tangent.point[((e * POINTS + q) * POINT_VALUES + i) * lanes + first..])
        };
        let zero = V::splat(0.0);
        let shape = |q: usize| packed_shape([&element.shape[q]], |[x]| V::splat(x));
        let mut stresses = [[[zero; 3]; 3]; POINTS];
        // Change of ∫J dV.
        let mut growth = zero;
        for q in 0..POINTS {
            let gradient = displacement_gradient(&shape(q), displacement);
            stresses[q] = symmetric_product(|i| value(q, i), &gradient);
            for (i, component) in gradient.as_flattened().iter().enumerate() {
                growth = value(q, ENTRIES + i).mul_add(*component, growth);
            }
        }
        growth = growth * V::load(&tangent.volumetric[e * lanes + first..]);
        let mut nodal_force = [[zero; VALUES]; CORNERS];
        for q in 0..POINTS {
            for (i, component) in stresses[q].as_flattened_mut().iter_mut().enumerate() {
                *component = value(q, ENTRIES + i).mul_add(growth, *component);
            }
            add_stress_force(&shape(q), &stresses[q], &mut nodal_force);
        }
        let mut loss = elastic::element_force(element, self.solid.moduli, displacement);
        for (loss, force) in loss.as_flattened_mut().iter_mut().zip(nodal_force.as_flattened()) {
            *loss = *loss - *force;
        }
        loss
    }
}

/// ln(1 + x), small x to all digits.
fn log_1p<const W: usize>(x: &Lanes<W>) -> Lanes<W> {
    x.map(f64::ln_1p)
}

/// P points of W angles each, side by side.
#[inline(always)]
fn pack<'a, const W: usize, const P: usize, V: Pack>(of_point: impl Fn(usize) -> &'a [f64]) -> V {
    let mut lanes = [0.0; MOST_LANES];
    for p in 0..P {
        lanes[p * W..][..W].copy_from_slice(&of_point(p)[..W]);
    }
    V::load(&lanes)
}

/// The same number at all angles of a point.
#[inline(always)]
fn spread<const W: usize, const P: usize, V: Pack>(of_points: [f64; P]) -> V {
    // To write single numbers and read them as a vector right away makes the machine wait.
    if P == 1 {
        return V::splat(of_points[0]);
    }
    if W == 1 {
        return V::load(&of_points);
    }
    let mut lanes = [0.0; MOST_LANES];
    for p in 0..P {
        lanes[p * W..][..W].fill(of_points[p]);
    }
    V::load(&lanes)
}

/// Values at the corners, the same for all points.
#[inline(always)]
fn packed_values<const W: usize, const P: usize, A: Pack, V: Pack>(
    values: &[[A; VALUES]; CORNERS],
) -> [[V; VALUES]; CORNERS] {
    let mut packed = [[V::splat(0.0); VALUES]; CORNERS];
    for (packed, value) in packed.as_flattened_mut().iter_mut().zip(values.as_flattened()) {
        let mut lanes = [0.0; MOST_LANES];
        value.store(&mut lanes);
        if W == 1 {
            *packed = V::splat(lanes[0]);
            continue;
        }
        for p in 1..P {
            value.store(&mut lanes[p * W..]);
        }
        *packed = V::load(&lanes);
    }
    packed
}

/// Forces on the corners, of all points together.
#[inline(always)]
fn summed<const W: usize, const P: usize, A: Pack, V: Pack>(
    force: &[[V; VALUES]; CORNERS],
) -> [[A; VALUES]; CORNERS] {
    let mut sums = [[A::splat(0.0); VALUES]; CORNERS];
    for (sum, packed) in sums.as_flattened_mut().iter_mut().zip(force.as_flattened()) {
        let mut lanes = [0.0; MOST_LANES];
        packed.store(&mut lanes);
        for p in 0..P {
            *sum = *sum + A::load(&lanes[p * W..]);
        }
    }
    sums
}

/// The angles of point p of those side by side.
#[inline(always)]
fn unpack<const W: usize, V: Pack>(packed: V, p: usize) -> Lanes<W> {
    let mut lanes = [0.0; MOST_LANES];
    packed.store(&mut lanes);
    std::array::from_fn(|l| lanes[p * W + l])
}

#[cfg(test)]
mod tests;
