//! Extrapolation of scalars above the last interference and outside the slip rates, on request.

use super::InterpolatedTable;
use crate::law::{AsperityLaw, Estimate, LookupError};
use crate::quantity::Quantity;

/// A number from a table, and whether it is extrapolated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extrapolated {
    /// Value and error.
    pub estimate: Estimate,
    /// Whether it is from outside the range of the table.
    pub outside: bool,
}

impl InterpolatedTable {
    /// As [`InterpolatedTable::estimate`], but above the last interference and beyond the slip rates continued
    /// as the power law of the last interval; below the first slip rate, where heating vanishes,
    /// held. The distance between continuing and holding is added to the error.
    pub fn extrapolate(
        &self,
        quantity: Quantity,
        radius: f64,
        interference: f64,
        slip_rate: f64,
    ) -> Result<Extrapolated, LookupError> {
        let (slowest, fastest) = self.slip_rate_range(radius);
        let limit = self.interference_limit();
        let inside = (interference.min(limit), slip_rate.clamp(slowest, fastest));
        let edge = self.estimate(quantity, radius, inside.0, inside.1)?;
        if inside == (interference, slip_rate) {
            return Ok(Extrapolated { estimate: edge, outside: false });
        }
        let base = quantity.origin(self.metadata().temperature);
        let ratio = |at: Estimate, before: Estimate| (at.value - base) / (before.value - base);
        // ln of what the quantity is multiplied by along each axis; 0 where it is no power law.
        let growth = |ratio: f64, span: f64, distance: f64| match ratio > 0.0 && ratio.is_finite() {
            true => ratio.ln() / span * distance,
            false => 0.0,
        };
        let (mut exponent, mut uncertainty) = (0.0, 0.0);
        let rows = &self.axes().interference;
        let last = rows.iter().position(|row| *row == limit).unwrap_or(rows.len() - 1);
        if interference > limit && last > 0 {
            let before = self.estimate(quantity, radius, rows[last - 1], inside.1)?;
            exponent +=
                growth(ratio(edge, before), (limit / rows[last - 1]).ln(), (interference / limit).ln());
        }
        let columns = &self.axes().slip_rate;
        let neighbour = match slip_rate {
            rate if rate > fastest => columns.len().checked_sub(2).map(|j| columns[j] / columns[j + 1]),
            rate if rate < slowest => columns.get(1).map(|second| second / columns[0]),
            _ => None,
        };
        if let Some(step) = neighbour.filter(|step| *step > 0.0 && step.is_finite()) {
            let before = self.estimate(quantity, radius, inside.0, inside.1 * step)?;
            let along = growth(ratio(edge, before), -step.ln(), (slip_rate / inside.1).ln());
            match slip_rate > fastest {
                true => exponent += along,
                // A rate of 0 is infinitely far along a power law: the whole value is in uncertainty.
                false => uncertainty = if along.is_finite() { along } else { f64::NEG_INFINITY },
            }
        }
        let held = edge.value - base;
        let value = held * exponent.exp();
        let spread = (value - held).abs() + (held * (uncertainty.exp() - 1.0)).abs().min(held.abs());
        let error = edge.error * exponent.exp() + spread;
        Ok(Extrapolated { estimate: Estimate { value: base + value, error }, outside: true })
    }
}
