//! Scalars of a table between its points.

use super::elastic::{Elastic, fade};
use super::nodes::FIELDS;
use super::{Absent, Interpolant};
use crate::law::{Estimate, LookupError};
use crate::quantity::Quantity;
use crate::steffen::{Location, locate};
use crate::table::Table;

impl Table {
    /// One of the scalars, for a sphere of `radius` (m) pressed by `interference` (ω/ω_c) and
    /// sliding at `slip_rate` (m/s); interpolated as the response is, with the error of the
    /// points (interpolated linearly) and, unless that includes it, half the difference to linear
    /// interpolation.
    pub fn estimate(
        &self,
        quantity: Quantity,
        radius: f64,
        interference: f64,
        slip_rate: f64,
    ) -> Result<Estimate, LookupError> {
        let ratio = self.radius_ratio(radius)?;
        let rate = self.located_rate(interference, slip_rate, ratio)?;
        let interpolant = self.interpolant();
        let absent = |absent| self.absent(absent, ratio);
        let (first, _) = interpolant.rows.ok_or((0, 0)).map_err(absent)?;
        let depth = interference.ln() - interpolant.log_interference[first];
        let place = if depth < 0.0 {
            Location { index: first, t: 0.0 }
        } else {
            locate(&interpolant.log_interference, interference.ln())
        };
        let base = match quantity.is_temperature() {
            true => self.metadata().temperature,
            false => 0.0,
        };
        let (mut value, mut error) =
            self.between(interpolant, quantity, base, place, rate).map_err(absent)?;
        if depth < 0.0 {
            let knot = self.axes().interference[first];
            let continued = below(&interpolant.elastic, quantity, knot, depth, value);
            error *= if value == 0.0 { 1.0 } else { (continued / value).abs() };
            value = continued;
        }
        let scale = ratio.powi(quantity.descriptor().radius_exponent);
        Ok(Estimate { value: scale * (base + value), error: scale * error })
    }

    /// (value above `base`, error) at the radius of the table and inside its rows.
    fn between(
        &self,
        interpolant: &Interpolant,
        quantity: Quantity,
        base: f64,
        place: Location,
        rate: Location,
    ) -> Result<(f64, f64), Absent> {
        let at = |i: usize, j: usize| {
            let cell = self.cell(i, j).ok_or((i, j))?;
            let Estimate { value, error } = cell[quantity];
            if value.is_nan() {
                return Err((i, j));
            }
            Ok([value - base, error, 0.0, 0.0])
        };
        let row = |i: usize| {
            Interpolant::blend(&interpolant.rate_coordinate, rate, |j| at(i, j).map(|v| [v[0]; FIELDS]))
        };
        let value = Interpolant::blend(&interpolant.log_interference, place, row)?[0];
        let (mut linear, mut error) = (0.0, 0.0);
        for (i, share_i) in [(0, 1.0 - place.t), (1, place.t)] {
            for (j, share_j) in [(0, 1.0 - rate.t), (1, rate.t)] {
                let share = share_i * share_j;
                if share > 0.0 {
                    let corner = at(place.index + i, rate.index + j)?;
                    linear += share * corner[0];
                    error += share * corner[1];
                }
            }
        }
        let included = self.metadata().interpolation_tolerance.is_some();
        let interpolation = if included { 0.0 } else { 0.5 * (value - linear).abs() };
        Ok((value, error + interpolation))
    }
}

/// Elastic asymptote of each scalar, matched to the first row as the response is.
fn below(elastic: &Elastic, quantity: Quantity, knot: f64, depth: f64, row: f64) -> f64 {
    let here = knot * depth.exp();
    let asymptote = |at: f64| -> Option<f64> {
        use Quantity::*;
        match quantity {
            Load | LoadPress => Some(elastic.load(at)),
            Area | AreaPress => Some(elastic.area(at)),
            ContactRadius => Some(elastic.contact_radius(at)),
            Friction | FrictionStatic => elastic.sliding_friction(at),
            Mu | MuStatic | MuPeak => Some(elastic.sliding_friction(at)? / elastic.load(at)),
            InceptionSlip => elastic.inception_slip(at),
            EnergyRelease => elastic.energy_release(at),
            // Weakening by a slight heating: drop of strength and slip both go with a.
            EnergyWeakening => Some(elastic.area(at)),
            TemperatureMax | TemperatureMean => None,
        }
    };
    match (asymptote(here), asymptote(knot)) {
        (Some(asymptote), Some(at_knot)) => {
            if quantity == Quantity::EnergyWeakening {
                return row * asymptote / at_knot;
            }
            elastic.continued(asymptote, at_knot, row, depth)
        }
        _ if quantity.is_temperature() => row * fade(depth),
        // No strength of its own: friction coefficients stay, forces go with the load.
        _ => match quantity.descriptor().units {
            "1" => row,
            "N" => row * elastic.load(here) / elastic.load(knot),
            _ => row * elastic.contact_radius(here) / elastic.contact_radius(knot),
        },
    }
}
