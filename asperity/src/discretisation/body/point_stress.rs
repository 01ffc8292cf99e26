//! Stress at Gauss points at the end of a step.

use super::part::Part;
use super::state::value_index;
use super::temperature::{ElementHeat, PointTemperature};
use super::{COEFFICIENTS, TENSOR};
use crate::material::lanes::{Lanes, Pack, lanes_of};
use crate::material::{StrainPath, Trial};

/// Gauss points of an element from `chunk` on and a group of angles, side by side in history and tangent.
#[derive(Clone, Copy)]
pub(super) struct Points {
    pub(super) e: usize,
    pub(super) chunk: usize,
    pub(super) first: usize,
    /// Angles of the mesh.
    pub(super) lanes: usize,
}

impl Points {
    #[inline(always)]
    fn scalar(self) -> usize {
        self.of_values(1, 0)
    }

    #[inline(always)]
    fn tensor(self, i: usize) -> usize {
        self.of_values(TENSOR, i)
    }

    #[inline(always)]
    pub(super) fn coefficient(self, i: usize) -> usize {
        self.of_values(COEFFICIENTS, i)
    }

    /// Index of value i of `count`.
    #[inline(always)]
    pub(super) fn of_values(self, count: usize, i: usize) -> usize {
        value_index(count, [self.e, i, self.chunk], self.lanes) + self.first
    }
}

/// Lanes whose elastic stress is above the yield strength.
struct Yielding<const N: usize> {
    flowing: [bool; N],
    any: bool,
    /// f(T)/f(T₀) over E(T)/E(T₀); evaluated where any lane is near yield.
    softening: Lanes<N>,
}

impl Part<'_> {
    /// Stress deviator at points of W angles each, which fill N lanes, and whether any flows.
    #[inline(always)]
    pub(super) fn point_stress<const W: usize, const N: usize, V: Pack>(
        &mut self,
        at: Points,
        deviator: &[V; TENSOR],
        heat: &ElementHeat<W>,
    ) -> ([V; TENSOR], bool) {
        let heat = heat.at_points::<N>(at.chunk);
        // Whether any point of the element flowed at the internal force before.
        let stale = self.tangent.flows[at.e * at.lanes + at.first];
        let two_shear = 2.0 * self.solid.moduli.shear;
        let mut squared = V::splat(0.0);
        let mut stress = [V::splat(0.0); TENSOR];
        for i in 0..TENSOR {
            let plastic = V::load(&self.committed.plastic_strain[at.tensor(i)..]);
            stress[i] = V::splat(two_shear) * (deviator[i] - plastic);
            squared = (V::splat(if i < 3 { 1.5 } else { 3.0 }) * stress[i]).mul_add(stress[i], squared);
        }
        let yielding = self.yielding(at, &lanes_of(squared), &heat);
        let any = yielding.any;
        // First guess: the increment of the previous iteration.
        let guess = if any || stale { self.reset_history(at) } else { [0.0; N] };
        if stale && !any {
            self.tangent.coefficients[at.coefficient(0)..][..N].fill(two_shear);
            self.tangent.coefficients[at.coefficient(1)..][..N].fill(0.0);
        }
        if any {
            self.flow_point(at, &mut stress, &yielding, &heat, guess);
        }
        for (i, component) in stress.iter_mut().enumerate() {
            if let Some([now, _]) = &heat.stiffness {
                *component = *component * V::load(now);
            }
            component.store(&mut self.trial.deviator[at.tensor(i)..]);
        }
        (stress, any)
    }

    /// Compares q² with the square of the strength.
    #[inline(always)]
    fn yielding<const N: usize>(
        &self,
        at: Points,
        squared: &Lanes<N>,
        heat: &PointTemperature<N>,
    ) -> Yielding<N> {
        let over_stiffness =
            |factor: f64, l: usize| heat.stiffness.as_ref().map_or(factor, |[now, _]| factor / now[l]);
        // Where the lowest softening factor of the element keeps the point elastic, none is evaluated.
        let strength = &self.committed.strength[at.scalar()..][..N];
        let mut near = false;
        for l in 0..N {
            let least = over_stiffness(heat.weakest, l) * strength[l];
            near |= squared[l] > least * least;
        }
        let mut yielding = Yielding { flowing: [false; N], any: false, softening: [1.0; N] };
        if near {
            yielding.softening = self.solid.softening_factors(&heat.rise);
            for l in 0..N {
                yielding.softening[l] = over_stiffness(yielding.softening[l], l);
                let limit = strength[l] * yielding.softening[l];
                yielding.flowing[l] = squared[l] > limit * limit;
                yielding.any |= yielding.flowing[l];
            }
        }
        yielding
    }

    /// Sets the trial history of a point to the committed one; returns the increments of ε_p that it had.
    #[inline(always)]
    fn reset_history<const N: usize>(&mut self, at: Points) -> Lanes<N> {
        for i in 0..TENSOR {
            let range = at.tensor(i)..at.tensor(i) + N;
            self.trial.plastic_strain[range.clone()].copy_from_slice(&self.committed.plastic_strain[range]);
        }
        let mut increments = [0.0; N];
        for (l, increment) in increments.iter_mut().enumerate() {
            let index = at.scalar() + l;
            *increment = self.trial.accumulated[index] - self.committed.accumulated[index];
            self.trial.accumulated[index] = self.committed.accumulated[index];
            self.trial.strength[index] = self.committed.strength[index];
        }
        increments
    }

    /// Plastic flow of the flowing lanes of a point: sets their history, tangent and stress deviator.
    #[inline(always)]
    fn flow_point<const N: usize, V: Pack>(
        &mut self,
        at: Points,
        stress: &mut [V; TENSOR],
        yielding: &Yielding<N>,
        heat: &PointTemperature<N>,
        guess: Lanes<N>,
    ) {
        let flowing = yielding.flowing;
        let at_start = |values: &[f64]| -> Lanes<N> { std::array::from_fn(|l| values[at.scalar() + l]) };
        let mut start = [[0.0; N]; TENSOR];
        for (i, start) in start.iter_mut().enumerate() {
            start.copy_from_slice(&self.committed.deviator[at.tensor(i)..][..N]);
            if let Some([_, before]) = &heat.stiffness {
                (0..N).for_each(|l| start[l] /= before[l]);
            }
        }
        let mut elastic = [[0.0; N]; TENSOR];
        for (elastic, stress) in elastic.iter_mut().zip(&*stress) {
            stress.store(elastic);
        }
        let path = StrainPath {
            trial: Trial {
                flowing,
                strain: at_start(self.committed.accumulated),
                strength: at_start(self.committed.strength),
                softening: yielding.softening,
                guess,
                time_step: self.time_step,
            },
            start: &start,
            elastic: &elastic,
        };
        let end = self.solid.flow(&path);
        let two_shear = 2.0 * self.solid.moduli.shear;
        let stiffness = 3.0 * self.solid.moduli.shear;
        // Elastic values in the lanes that do not flow; the loops below act on all lanes.
        let (mut across, mut radial) = ([two_shear; N], [0.0; N]);
        for l in (0..N).filter(|&l| flowing[l]) {
            self.trial.accumulated[at.scalar() + l] = path.trial.strain[l] + end.increment[l];
            self.trial.strength[at.scalar() + l] = end.strength[l];
            // Along the stress the tangent is 2GH/(3G + H). A falling strength counts as constant, so that the tangent
            // stays definite, and it is nowhere stiffer along the stress than across.
            let slope = end.slope[l].max(0.0);
            across[l] = two_shear * end.across[l];
            radial[l] = (two_shear * (1.0 - stiffness / (stiffness + slope)) - across[l]).min(0.0);
        }
        self.tangent.coefficients[at.coefficient(0)..][..N].copy_from_slice(&across);
        self.tangent.coefficients[at.coefficient(1)..][..N].copy_from_slice(&radial);
        for (i, stress) in stress.iter_mut().enumerate() {
            let direction = &mut self.tangent.coefficients[at.coefficient(2 + i)..][..N];
            let plastic = &mut self.trial.plastic_strain[at.tensor(i)..][..N];
            let mut at_end = elastic[i];
            for l in 0..N {
                let flows = flowing[l];
                let flown = end.radius[l] * end.direction[i][l];
                direction[l] = if flows { end.direction[i][l] } else { 0.0 };
                at_end[l] = if flows { flown } else { at_end[l] };
                // Δε_p = Δs/2G at constant strain.
                plastic[l] += (elastic[i][l] - at_end[l]) / two_shear;
            }
            *stress = V::load(&at_end);
        }
    }
}
