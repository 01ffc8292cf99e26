//! Mean of the responses of a contact over ages that are equally likely.

use crate::integral::kronrod::MANY;
use tables::law::{LookupError, Response};

/// The mean, while it is added up.
#[derive(Default)]
pub(super) struct MeanOverAges {
    /// Sum of the responses; in place of the relative error of Q/P that error times Q.
    sum: Response,
    /// Errors of the quadrature of load, friction and area, sums over the ranges of ages.
    quadrature_errors: [f64; 3],
}

impl MeanOverAges {
    /// Adds contacts that are the share `weight` of all, by `response` at any share of their range of ages.
    pub(super) fn add_ages(
        &mut self,
        weight: f64,
        response: impl Fn(f64) -> Result<Response, LookupError>,
    ) -> Result<(), LookupError> {
        if weight <= 0.0 {
            return Ok(());
        }
        let mut differences = [0.0; 3];
        // The age is u³ of the range: friction rises steeply at first, and changes with √s.
        for ((abscissa, of_point), excess) in MANY.points().zip(MANY.excess) {
            let u = 0.5 * (1.0 + abscissa);
            let of_point = 1.5 * of_point * u * u * weight;
            let here = response(u.powi(3))?;
            for (difference, part) in differences.iter_mut().zip([here.load, here.friction, here.area]) {
                *difference += of_point * excess * part.value;
            }
            self.add(of_point, &here);
        }
        for (error, difference) in self.quadrature_errors.iter_mut().zip(differences) {
            *error += difference.abs();
        }
        Ok(())
    }

    /// Adds contacts that are the share `weight` of all, with one response.
    pub(super) fn add(&mut self, weight: f64, response: &Response) {
        let sum = &mut self.sum;
        for (sum, part) in [
            (&mut sum.load, response.load),
            (&mut sum.friction, response.friction),
            (&mut sum.area, response.area),
            (&mut sum.temperature_max, response.temperature_max),
        ] {
            sum.value += weight * part.value;
            sum.error += weight * part.error;
        }
        sum.coefficient_error += weight * response.coefficient_error * response.friction.value.abs();
    }

    /// The mean, with the error of the quadrature.
    pub(super) fn response(self) -> Response {
        let Self { mut sum, quadrature_errors: [load, friction, area] } = self;
        sum.load.error += load;
        sum.friction.error += friction;
        sum.area.error += area;
        let relative = |error: f64, value: f64| if value == 0.0 { 0.0 } else { error / value.abs() };
        sum.coefficient_error =
            relative(sum.coefficient_error + friction, sum.friction.value) + relative(load, sum.load.value);
        sum
    }
}
