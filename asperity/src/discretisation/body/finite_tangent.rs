//! Tangent of the body at finite strain, as the internal force sets it.

use super::state::take;
use crate::discretisation::element::POINTS;
use crate::material::log_moduli::ENTRIES;
use crate::material::log_strain::Rules;

/// Values per point: ∂P/∂F and ∂J/∂F, times the point's weight.
pub const POINT_VALUES: usize = ENTRIES + 9;

/// Tangent at the last internal force.
#[derive(Clone, Debug)]
pub struct FiniteTangent {
    /// Values of each point, see [`value_index`](super::state::value_index). In single precision: the products are bound by
    /// memory, and the convergence of Newton's method is the same.
    pub point: Vec<f32>,
    /// Per element and group of lanes: whether the displacement gradient is so small that the moduli of small strain
    /// are used. Their relative error is the size of the gradient, which leaves the convergence of Newton's method as
    /// it is.
    pub small: Vec<bool>,
    /// ψ'' over ∫J dV of each element: (K − p)/(V J̄²), p the mean stress.
    pub volumetric: Vec<f64>,
    /// Quadrature rules of the logarithm.
    rules: Rules,
}

/// Tangent of consecutive elements.
pub struct FiniteTangentPart<'a> {
    pub point: &'a mut [f32],
    pub small: &'a mut [bool],
    pub volumetric: &'a mut [f64],
    pub rules: &'a Rules,
}

impl<'a> FiniteTangentPart<'a> {
    pub fn whole(tangent: &'a mut FiniteTangent) -> Self {
        let FiniteTangent { point, small, volumetric, rules } = tangent;
        Self { point, small, volumetric, rules }
    }

    /// Splits off the first `groups` elements times angles.
    pub fn take(&mut self, groups: usize) -> Self {
        Self {
            point: take(&mut self.point, groups * POINTS * POINT_VALUES),
            small: take(&mut self.small, groups),
            volumetric: take(&mut self.volumetric, groups),
            rules: self.rules,
        }
    }
}

impl FiniteTangent {
    pub fn new(elements: usize, lanes: usize) -> Self {
        Self {
            point: vec![0.0; elements * POINTS * POINT_VALUES * lanes],
            small: vec![false; elements * lanes],
            volumetric: vec![0.0; elements * lanes],
            rules: Rules::new(),
        }
    }
}
