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
//! Force and tangent of elastic points are its derivatives. The tangent of points that flow is built from that of
//! [`Solid::flow`](crate::material::Solid::flow) and is symmetric as well. Stress deviator and mean stress in
//! [`BodyState`] are conjugate to E per undeformed volume: they equal Kirchhoff's stress where the principal axes do
//! not rotate.
//!
//! Depends on `element` and `crate::material`. Chapter "Mesh and elements" of the book.

use super::Body;
use super::finite_tangent::{FiniteTangentPart, POINT_VALUES};
use super::packing::{joined, pack, packed_values, spread, summed, unpack};
use super::part::Part;
use super::point_stress::Points;
use super::temperature::ElementHeat;
use crate::discretisation::elastic;
use crate::discretisation::element::{CORNERS, Element, POINTS, VALUES};
use crate::material::lanes::{Lanes, Pack, lanes_of};
use crate::material::log_moduli::{self, ENTRIES, LogModuli, add_volume_curvature, symmetric_product};
use crate::material::log_strain::first_piola;
use crate::material::tensor::{
    Symmetric, TwoPoint, cauchy_green_excess, cofactors, deformation_gradient, volume_excess,
};
use gradient::{PackedShape, add_stress_force, displacement_gradient, packed_shape};

mod gradient;

/// Largest component of the displacement gradient up to which the moduli of small strain are used.
const SMALL: f64 = 1e-2;

/// Displacement gradients of an element.
struct Kinematics<const W: usize, V> {
    gradients: [TwoPoint<V>; POINTS],
    /// J̄ − 1; NaN where a point is inverted.
    excess: Lanes<W>,
    /// Largest component of h.
    largest: f64,
}

impl Part<'_> {
    /// Forces on the corners; W angles at a time, which fill A, and P points of them, which fill the N lanes of V.
    #[inline(always)]
    pub(super) fn finite_strain_force<const W: usize, const P: usize, const N: usize, A: Pack, V: Pack>(
        &mut self,
        e: usize,
        first: usize,
        displacement: &[[A; VALUES]; CORNERS],
        rise: Option<&[f64]>,
        tangent: &mut FiniteTangentPart<'_>,
    ) -> [[A; VALUES]; CORNERS] {
        let lanes = self.mesh.sectors.columns();
        let at = e * lanes + first;
        let heat = self.element_heat::<W>(e, first, rise, self.solid.stiffness_varies());
        let kinematics = self.kinematics::<W, P, V>(e, &packed_values::<W, P, A, V>(displacement));
        tangent.small[at] = kinematics.largest <= SMALL;
        let pressure = self.volumetric_stress(e, first, &kinematics.excess, &heat, tangent);
        let pressure = pack::<W, P, V>(|_| &pressure);
        let mut any_flows = false;
        let mut force = [[V::splat(0.0); VALUES]; CORNERS];
        for (chunk, gradient) in kinematics.gradients[..POINTS / P].iter().enumerate() {
            let points = Points { e, chunk: chunk * P, first, lanes };
            let (stress, flows) =
                self.weighted_stress::<W, P, N, V>(points, gradient, pressure, &heat, tangent);
            any_flows |= flows;
            add_stress_force(&shapes_at::<W, P, V>(&self.elements[e], points.chunk), &stress, &mut force);
        }
        self.tangent.flows[at] = any_flows;
        summed::<W, P, A, V>(&force)
    }

    /// h at all points, and J̄ − 1.
    #[inline(always)]
    fn kinematics<const W: usize, const P: usize, V: Pack>(
        &self,
        e: usize,
        values: &[[V; VALUES]; CORNERS],
    ) -> Kinematics<W, V> {
        let (volume, weight) = (self.elements[e].volume, self.elements[e].weight);
        let zero = V::splat(0.0);
        let mut gradients = [[[zero; 3]; 3]; POINTS];
        let mut excess = [0.0; W];
        let mut largest = zero;
        for (chunk, gradient) in gradients[..POINTS / P].iter_mut().enumerate() {
            let chunk = chunk * P;
            *gradient = displacement_gradient(&shapes_at::<W, P, V>(&self.elements[e], chunk), values);
            for &h in gradient.as_flattened() {
                largest = h.larger(largest);
            }
            let of_points = volume_excess(gradient);
            for p in 0..P {
                let (point, share) = (unpack::<W, V>(of_points, p), weight[chunk + p] / volume);
                for l in 0..W {
                    let inverted = point[l] <= -1.0;
                    excess[l] += if inverted { f64::NAN } else { share * point[l] };
                }
            }
        }
        Kinematics { gradients, excess, largest: largest.largest() }
    }

    /// Sets the mean stress p = K(ln J̄ − 3∫α dθ̄) and its derivative; returns p/J̄, by which ∂J/∂F gives the stress.
    #[inline(always)]
    fn volumetric_stress<const W: usize>(
        &mut self,
        e: usize,
        first: usize,
        excess: &Lanes<W>,
        heat: &ElementHeat<W>,
        tangent: &mut FiniteTangentPart<'_>,
    ) -> Lanes<W> {
        let (at, volume) = (e * self.mesh.sectors.columns() + first, self.elements[e].volume);
        let mut pressure = [0.0; W];
        // Without cancellation for small J̄ − 1.
        let ln_ratio = excess.map(f64::ln_1p);
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
        pressure
    }

    /// First Piola-Kirchhoff stress times the weights at P points, and whether any flows; sets the tangent where the
    /// displacement gradient is not small.
    #[inline(always)]
    fn weighted_stress<const W: usize, const P: usize, const N: usize, V: Pack>(
        &mut self,
        points: Points,
        gradient: &TwoPoint<V>,
        pressure: V,
        heat: &ElementHeat<W>,
        tangent: &mut FiniteTangentPart<'_>,
    ) -> (TwoPoint<V>, bool) {
        let Points { e, chunk, first, lanes } = points;
        let weight = self.elements[e].weight;
        let weight = spread::<W, P, V>(std::array::from_fn(|p| weight[chunk + p]));
        let f = deformation_gradient(gradient);
        let cofactors = cofactors(&f);
        let log = tangent.rules.log(&cauchy_green_excess(gradient));
        let (log_stress, flows) = self.log_stress::<W, N, V>(points, &log.strain(), heat);
        let second = log.second_piola(&log_stress);
        if !tangent.small[e * lanes + first] {
            let moduli = self.log_moduli::<W, P, V>(points, flows, heat.stiffness.as_ref());
            let mut moduli = log_moduli::tangent(&log, &f, &log_stress, &second, &moduli);
            add_volume_curvature(pressure, &f, &mut moduli);
            for (i, &value) in moduli.iter().chain(cofactors.as_flattened()).enumerate() {
                let value: Lanes<N> = lanes_of(weight * value);
                let target = &mut tangent.point[points.of_values(POINT_VALUES, i)..][..N];
                (0..N).for_each(|l| target[l] = value[l] as f32);
            }
        }
        let mut stress = first_piola(&f, &second);
        for (stress, cofactor) in stress.as_flattened_mut().iter_mut().zip(cofactors.as_flattened()) {
            *stress = weight * pressure.mul_add(*cofactor, *stress);
        }
        (stress, flows)
    }

    /// Deviator of the stress that works on the logarithmic strain, and whether any point flows.
    #[inline(always)]
    fn log_stress<const W: usize, const N: usize, V: Pack>(
        &mut self,
        points: Points,
        log_strain: &Symmetric<V>,
        heat: &ElementHeat<W>,
    ) -> (Symmetric<V>, bool) {
        let third = V::splat(1.0 / 3.0) * (log_strain[0] + log_strain[1] + log_strain[2]);
        let mut deviator = *log_strain;
        for normal in &mut deviator[..3] {
            *normal = *normal - third;
        }
        self.point_stress::<W, N, V>(points, &deviator, heat)
    }

    /// Moduli in logarithmic strain after [`Part::log_stress`].
    #[inline(always)]
    fn log_moduli<const W: usize, const P: usize, V: Pack>(
        &self,
        points: Points,
        flows: bool,
        stiffness: Option<&Lanes<W>>,
    ) -> LogModuli<V> {
        let coefficient = |i: usize| V::load(&self.tangent.coefficients[points.coefficient(i)..]);
        let stiffness = stiffness.map_or(V::splat(1.0), |factor| pack::<W, P, V>(|_| factor));
        let mut direction = [V::splat(0.0); 6];
        for (i, component) in direction.iter_mut().enumerate() {
            *component = coefficient(2 + i);
        }
        LogModuli {
            shear: stiffness * coefficient(0),
            radial: stiffness * coefficient(1),
            // Not updated at elastic points, where its factor is zero.
            direction: if flows { Some(direction) } else { None },
        }
    }
}

/// Shape functions at P points.
#[inline(always)]
fn shapes_at<const W: usize, const P: usize, V: Pack>(element: &Element, chunk: usize) -> PackedShape<V> {
    let of_points = std::array::from_fn(|p| &element.shape[chunk + p]);
    packed_shape::<P, V>(of_points, spread::<W, P, V>)
}

impl Body {
    /// Contribution to [`Body::stiffness_loss`] of an element with large displacement gradients.
    #[inline(always)]
    pub(super) fn finite_loss<const W: usize, const P: usize, A: Pack, V: Pack>(
        &self,
        e: usize,
        first: usize,
        displacement: &[[A; VALUES]; CORNERS],
    ) -> [[A; VALUES]; CORNERS] {
        let element = &self.mesh.elements[e];
        let lanes = self.mesh.sectors.columns();
        let tangent = self.finite_strain.as_ref().expect("of a body at finite strain");
        let value = |chunk: usize, i: usize| {
            let points = Points { e, chunk, first, lanes };
            V::load_single(&tangent.point[points.of_values(POINT_VALUES, i)..])
        };
        let displacements = packed_values::<W, P, A, V>(displacement);
        let zero = V::splat(0.0);
        let mut stresses = [[[zero; 3]; 3]; POINTS];
        // Change of ∫J dV.
        let mut volume_change = zero;
        for chunk in (0..POINTS).step_by(P) {
            let gradient = displacement_gradient(&shapes_at::<W, P, V>(element, chunk), &displacements);
            stresses[chunk] = symmetric_product(|i| value(chunk, i), &gradient);
            for (i, component) in gradient.as_flattened().iter().enumerate() {
                volume_change = value(chunk, ENTRIES + i).mul_add(*component, volume_change);
            }
        }
        let of_points = (0..P).map(|p| A::load(&unpack::<W, V>(volume_change, p)));
        let mean_stress_change = of_points.fold(A::splat(0.0), |sum, of_point| sum + of_point)
            * A::load(&tangent.volumetric[e * lanes + first..]);
        let mean_stress_change = joined::<W, A, V>(&[mean_stress_change; P]);
        let mut nodal_force = [[zero; VALUES]; CORNERS];
        for chunk in (0..POINTS).step_by(P) {
            for (i, component) in stresses[chunk].as_flattened_mut().iter_mut().enumerate() {
                *component = value(chunk, ENTRIES + i).mul_add(mean_stress_change, *component);
            }
            add_stress_force(&shapes_at::<W, P, V>(element, chunk), &stresses[chunk], &mut nodal_force);
        }
        let nodal_force = summed::<W, P, A, V>(&nodal_force);
        let mut loss = elastic::element_force(element, self.solid.moduli, displacement);
        for (loss, force) in loss.as_flattened_mut().iter_mut().zip(nodal_force.as_flattened()) {
            *loss = *loss - *force;
        }
        loss
    }
}

#[cfg(test)]
mod tests;
