//! Stress at a Gauss point at the end of a step.

use super::temperature::PointTemperature;
use super::{Body, COEFFICIENTS, TENSOR};
use crate::discretisation::element::POINTS;
use crate::material::StrainPath;
use crate::material::lanes::{Lanes, Pack, lanes_of};

/// A Gauss point and the first of a group of angles, as places in the history and the tangent.
#[derive(Clone, Copy)]
struct PointPlace {
    point: usize,
    lanes: usize,
    first: usize,
}

impl PointPlace {
    #[inline(always)]
    fn scalar(self) -> usize {
        self.point * self.lanes + self.first
    }

    #[inline(always)]
    fn tensor(self, i: usize) -> usize {
        (self.point * TENSOR + i) * self.lanes + self.first
    }

    #[inline(always)]
    fn coefficient(self, i: usize) -> usize {
        (self.point * COEFFICIENTS + i) * self.lanes + self.first
    }
}

/// Lanes whose elastic stress is above the yield strength.
struct Yielding<const W: usize> {
    flowing: [bool; W],
    any: bool,
    /// f(T)/f(T₀) over E(T)/E(T₀); evaluated where any lane is near yield.
    softening: Lanes<W>,
}

impl Body {
    /// Stress deviator at one point, and whether any lane flows; `stale`: whether any point of the element did at the
    /// internal force before.
    #[inline(always)]
    pub(super) fn point_stress<const W: usize, V: Pack>(
        &mut self,
        e: usize,
        q: usize,
        first: usize,
        deviator: &[V; TENSOR],
        heat: PointTemperature<'_, W>,
        stale: bool,
    ) -> ([V; TENSOR], bool) {
        let at = PointPlace { point: e * POINTS + q, lanes: self.mesh.sectors.columns(), first };
        let two_shear = 2.0 * self.solid.moduli.shear;
        let mut squared = V::splat(0.0);
        let mut stress: [V; TENSOR] = std::array::from_fn(|i| {
            let plastic = V::load(&self.committed.plastic_strain[at.tensor(i)..]);
            let component = V::splat(two_shear) * (deviator[i] - plastic);
            squared = (V::splat(if i < 3 { 1.5 } else { 3.0 }) * component).mul_add(component, squared);
            component
        });
        let yielding = self.yielding(at, &lanes_of(squared), &heat);
        let any = yielding.any;
        // First guess: the increment of the previous iteration.
        let guess = if any || stale { self.reset_history(at) } else { [0.0; W] };
        if stale && !any {
            self.tangent.coefficients[at.coefficient(0)..][..W].fill(two_shear);
            self.tangent.coefficients[at.coefficient(1)..][..W].fill(0.0);
        }
        if any {
            self.flow_point(at, &mut stress, &yielding, &heat, guess);
        }
        for (i, component) in stress.iter_mut().enumerate() {
            if let Some([now, _]) = heat.stiffness {
                *component = *component * V::load(now);
            }
            component.store(&mut self.trial.deviator[at.tensor(i)..]);
        }
        (stress, any)
    }

    /// Compares q² with the square of the strength.
    #[inline(always)]
    fn yielding<const W: usize>(
        &self,
        at: PointPlace,
        squared: &Lanes<W>,
        heat: &PointTemperature<'_, W>,
    ) -> Yielding<W> {
        let over_stiffness =
            |factor: f64, l: usize| heat.stiffness.map_or(factor, |[now, _]| factor / now[l]);
        // Where the lowest softening factor of the element keeps the point elastic, none is evaluated.
        let strength = &self.committed.strength[at.scalar()..][..W];
        let mut near = false;
        for l in 0..W {
            let least = over_stiffness(heat.weakest, l) * strength[l];
            near |= squared[l] > least * least;
        }
        let mut yielding = Yielding { flowing: [false; W], any: false, softening: [1.0; W] };
        if near {
            yielding.softening = self.solid.softening_factors(heat.rise);
            for l in 0..W {
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
    fn reset_history<const W: usize>(&mut self, at: PointPlace) -> Lanes<W> {
        for i in 0..TENSOR {
            let range = at.tensor(i)..at.tensor(i) + W;
            self.trial.plastic_strain[range.clone()].copy_from_slice(&self.committed.plastic_strain[range]);
        }
        let mut increments = [0.0; W];
        for (l, increment) in increments.iter_mut().enumerate() {
            let place = at.scalar() + l;
            *increment = self.trial.accumulated[place] - self.committed.accumulated[place];
            self.trial.accumulated[place] = self.committed.accumulated[place];
            self.trial.strength[place] = self.committed.strength[place];
        }
        increments
    }

    /// Plastic flow of the flowing lanes of a point: sets their history, tangent and stress deviator.
    #[inline(always)]
    fn flow_point<const W: usize, V: Pack>(
        &mut self,
        at: PointPlace,
        stress: &mut [V; TENSOR],
        yielding: &Yielding<W>,
        heat: &PointTemperature<'_, W>,
        guess: Lanes<W>,
    ) {
        let flowing = yielding.flowing;
        let at_start = |values: &[f64]| -> Lanes<W> { std::array::from_fn(|l| values[at.scalar() + l]) };
        let mut start = [[0.0; W]; TENSOR];
        for (i, start) in start.iter_mut().enumerate() {
            start.copy_from_slice(&self.committed.deviator[at.tensor(i)..][..W]);
            if let Some([_, before]) = heat.stiffness {
                (0..W).for_each(|l| start[l] /= before[l]);
            }
        }
        let elastic: [Lanes<W>; TENSOR] = stress.map(lanes_of);
        let path = StrainPath {
            flowing,
            start: &start,
            elastic: &elastic,
            strain: at_start(&self.committed.accumulated),
            strength: at_start(&self.committed.strength),
            softening: yielding.softening,
            guess,
        };
        let end = self.solid.flow(&path);
        let two_shear = 2.0 * self.solid.moduli.shear;
        let stiffness = 3.0 * self.solid.moduli.shear;
        // Elastic values in the lanes that do not flow; the loops below act on all lanes.
        let (mut across, mut radial) = ([two_shear; W], [0.0; W]);
        for l in (0..W).filter(|&l| flowing[l]) {
            self.trial.accumulated[at.scalar() + l] = path.strain[l] + end.increment[l];
            self.trial.strength[at.scalar() + l] = end.strength[l];
            // Along the stress the tangent is 2GH/(3G + H). A falling strength counts as constant, so that the tangent
            // stays definite, and it is nowhere stiffer along the stress than across.
            let slope = end.slope[l].max(0.0);
            across[l] = two_shear * end.across[l];
            radial[l] = (two_shear * (1.0 - stiffness / (stiffness + slope)) - across[l]).min(0.0);
        }
        self.tangent.coefficients[at.coefficient(0)..][..W].copy_from_slice(&across);
        self.tangent.coefficients[at.coefficient(1)..][..W].copy_from_slice(&radial);
        for (i, stress) in stress.iter_mut().enumerate() {
            let direction = &mut self.tangent.coefficients[at.coefficient(2 + i)..][..W];
            let plastic = &mut self.trial.plastic_strain[at.tensor(i)..][..W];
            let mut at_end = elastic[i];
            for l in 0..W {
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
