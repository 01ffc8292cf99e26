//! History of the body at the Gauss points.

use std::ops::Range;

use super::TENSOR;
use crate::discretisation::collocation::Collocation;
use crate::discretisation::element::POINTS;

/// Index of value i of `count` at Gauss point q of element e and the first angle: element by element, value by value,
/// points and angles within, so that several points fill a vector register where the angles alone do not.
#[inline(always)]
pub(super) fn value_index(count: usize, [e, i, q]: [usize; 3], lanes: usize) -> usize {
    ((e * count + i) * POINTS + q) * lanes
}

/// History of all Gauss points: element by element, component by component, points and angles as lanes.
/// V: the values of all points, or of a part of them.
#[derive(Clone, Debug)]
pub struct BodyState<V = Vec<f64>> {
    /// Plastic strain (deviatoric), 6 components.
    pub(super) plastic_strain: V,
    /// Deviatoric stress, 6 components.
    pub(super) deviator: V,
    /// Equivalent plastic strain.
    pub(super) accumulated: V,
    /// Strength without softening at that strain, stored to save its power law.
    pub(super) strength: V,
    /// Mean stress, one per element.
    pub(super) mean_stress: V,
    /// Mean temperature rise, one per element.
    pub(super) rise: V,
}

impl BodyState {
    pub(super) fn new(elements: usize, lanes: usize) -> Self {
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

    /// An axisymmetric state at all angles.
    pub(super) fn spread(&self, sectors: &Collocation) -> Self {
        Self {
            plastic_strain: sectors.spread(&self.plastic_strain),
            deviator: sectors.spread(&self.deviator),
            accumulated: sectors.spread(&self.accumulated),
            strength: sectors.spread(&self.strength),
            mean_stress: sectors.spread(&self.mean_stress),
            rise: sectors.spread(&self.rise),
        }
    }

    pub(super) fn copy_from(&mut self, other: &Self) {
        self.plastic_strain.copy_from_slice(&other.plastic_strain);
        self.deviator.copy_from_slice(&other.deviator);
        self.accumulated.copy_from_slice(&other.accumulated);
        self.strength.copy_from_slice(&other.strength);
        self.mean_stress.copy_from_slice(&other.mean_stress);
        self.rise.copy_from_slice(&other.rise);
    }

    /// The state of consecutive elements.
    pub(super) fn of_elements(&self, elements: Range<usize>, lanes: usize) -> BodyState<&[f64]> {
        let groups = elements.start * lanes..elements.end * lanes;
        let points = groups.start * POINTS..groups.end * POINTS;
        let tensors = points.start * TENSOR..points.end * TENSOR;
        BodyState {
            plastic_strain: &self.plastic_strain[tensors.clone()],
            deviator: &self.deviator[tensors],
            accumulated: &self.accumulated[points.clone()],
            strength: &self.strength[points],
            mean_stress: &self.mean_stress[groups.clone()],
            rise: &self.rise[groups],
        }
    }

    pub(super) fn slices_mut(&mut self) -> BodyState<&mut [f64]> {
        BodyState {
            plastic_strain: &mut self.plastic_strain,
            deviator: &mut self.deviator,
            accumulated: &mut self.accumulated,
            strength: &mut self.strength,
            mean_stress: &mut self.mean_stress,
            rise: &mut self.rise,
        }
    }
}

impl BodyState<&mut [f64]> {
    /// Splits off the first `groups` elements times angles.
    pub(super) fn take(&mut self, groups: usize) -> Self {
        let points = groups * POINTS;
        BodyState {
            plastic_strain: take(&mut self.plastic_strain, points * TENSOR),
            deviator: take(&mut self.deviator, points * TENSOR),
            accumulated: take(&mut self.accumulated, points),
            strength: take(&mut self.strength, points),
            mean_stress: take(&mut self.mean_stress, groups),
            rise: take(&mut self.rise, groups),
        }
    }
}

/// Splits off the first `count` values, or all if there are fewer: the stiffness may be empty.
pub(super) fn take<'a, T>(rest: &mut &'a mut [T], count: usize) -> &'a mut [T] {
    let count = count.min(rest.len());
    rest.split_off_mut(..count).expect("no more than there are")
}
