//! History of the body at the Gauss points.

use super::TENSOR;
use crate::discretisation::element::POINTS;

/// Place of value i of `count` at Gauss point q of element e and the first angle: element by element, value by value,
/// points and angles within, so that several points fill a vector register where the angles alone do not.
#[inline(always)]
pub(super) fn place_of(count: usize, [e, i, q]: [usize; 3], lanes: usize) -> usize {
    ((e * count + i) * POINTS + q) * lanes
}

/// History of all Gauss points: element by element, component by component, points and angles as lanes.
#[derive(Clone, Debug)]
pub struct BodyState {
    /// Plastic strain (deviatoric), 6 components.
    pub(super) plastic_strain: Vec<f64>,
    /// Deviatoric stress, 6 components.
    pub(super) deviator: Vec<f64>,
    /// Equivalent plastic strain.
    pub(super) accumulated: Vec<f64>,
    /// Strength without softening at that strain, stored to save its power law.
    pub(super) strength: Vec<f64>,
    /// Mean stress, one per element.
    pub(super) mean_stress: Vec<f64>,
    /// Mean temperature rise, one per element.
    pub(super) rise: Vec<f64>,
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

    /// The same axisymmetric state in each of `lanes` sectors.
    pub(super) fn spread(&self, lanes: usize) -> Self {
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

    pub(super) fn copy_from(&mut self, other: &Self) {
        self.plastic_strain.copy_from_slice(&other.plastic_strain);
        self.deviator.copy_from_slice(&other.deviator);
        self.accumulated.copy_from_slice(&other.accumulated);
        self.strength.copy_from_slice(&other.strength);
        self.mean_stress.copy_from_slice(&other.mean_stress);
        self.rise.copy_from_slice(&other.rise);
    }
}
