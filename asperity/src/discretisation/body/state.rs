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

/// Values of each field per element and angle.
const COUNTS: BodyState<usize> = BodyState {
    plastic_strain: POINTS * TENSOR,
    deviator: POINTS * TENSOR,
    accumulated: POINTS,
    strength: POINTS,
    mean_stress: 1,
    rise: 1,
};

impl<V> BodyState<V> {
    fn each(&self) -> BodyState<&V> {
        let Self { plastic_strain, deviator, accumulated, strength, mean_stress, rise } = self;
        BodyState { plastic_strain, deviator, accumulated, strength, mean_stress, rise }
    }

    fn each_mut(&mut self) -> BodyState<&mut V> {
        let Self { plastic_strain, deviator, accumulated, strength, mean_stress, rise } = self;
        BodyState { plastic_strain, deviator, accumulated, strength, mean_stress, rise }
    }

    /// What `make` makes of each field with that of `other`.
    fn with<W, T>(self, other: BodyState<W>, mut make: impl FnMut(V, W) -> T) -> BodyState<T> {
        BodyState {
            plastic_strain: make(self.plastic_strain, other.plastic_strain),
            deviator: make(self.deviator, other.deviator),
            accumulated: make(self.accumulated, other.accumulated),
            strength: make(self.strength, other.strength),
            mean_stress: make(self.mean_stress, other.mean_stress),
            rise: make(self.rise, other.rise),
        }
    }
}

impl BodyState {
    pub(super) fn new(elements: usize, lanes: usize) -> Self {
        let mut state = COUNTS.with(COUNTS, |count, _| vec![0.0; count * elements * lanes]);
        state.strength.fill(1.0);
        state
    }

    /// Largest equivalent plastic strain.
    pub fn largest_plastic_strain(&self) -> f64 {
        self.accumulated.iter().fold(0.0, |m, &x| m.max(x))
    }

    /// An axisymmetric state at all angles.
    pub(super) fn spread(&self, sectors: &Collocation) -> Self {
        self.each().with(COUNTS, |values, _| sectors.spread(values))
    }

    pub(super) fn copy_from(&mut self, other: &Self) {
        self.each_mut().with(other.each(), |to, from| to.copy_from_slice(from));
    }

    /// The state of consecutive elements.
    pub(super) fn of_elements(&self, elements: Range<usize>, lanes: usize) -> BodyState<&[f64]> {
        let groups = elements.start * lanes..elements.end * lanes;
        self.each().with(COUNTS, |values, count| &values[groups.start * count..groups.end * count])
    }

    pub(super) fn slices_mut(&mut self) -> BodyState<&mut [f64]> {
        self.each_mut().with(COUNTS, |values, _| values.as_mut_slice())
    }
}

impl BodyState<&mut [f64]> {
    /// Splits off the first `groups` elements times angles.
    pub(super) fn take(&mut self, groups: usize) -> Self {
        self.each_mut().with(COUNTS, |rest, count| take(rest, groups * count))
    }
}

/// Splits off the first `count` values, or all if there are fewer: the stiffness may be empty.
pub(super) fn take<'a, T>(rest: &mut &'a mut [T], count: usize) -> &'a mut [T] {
    let count = count.min(rest.len());
    rest.split_off_mut(..count).expect("no more than there are")
}
