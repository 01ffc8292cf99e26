//! Interpolation in a table: its response between the points, below the first interference and above the last, at
//! other radii and initial temperatures.
//!
//! - **Interference**: monotone cubic in ln ω, of the logarithm of positive quantities, hence
//!   exact for power laws. Below the first point extrapolation towards the Hertz limit, see `hertz_limit`;
//!   above the last towards the fully plastic limit, see `plastic_limit`, up to the [largest
//!   contact](crate::law::LARGEST_CONTACT).
//! - **Slip rate**: with heat in the temperature rise, see `temperature_rise`. The rise itself, and all without heat or with
//!   a rate law, as along interference in ξ(V) = 1 + ln(V/V₁) from the first positive slip rate V₁ on and
//!   ξ = V/V₁ below it, down to the isothermal limit V = 0 at ξ = 0 where the table has one. ξ
//!   and its derivative are continuous at V₁. Temperature rises below V₁: see `low_rates`.
//! - **Slip**: monotone cubic in s/a₀ between the points of the histories, constant after the last.
//! - **Radius**: read at VR/R_t, ω/ω_c and s/a₀; forces and areas scale with (R/R_t)². Where the strength grows with
//!   the strain rate: see `strain_rate`.
//! - **Initial temperature**: see `temperature`.
//! - **Errors**: those of the points, interpolated linearly, plus an estimate of the
//!   interpolation error from the prediction of each point by the others (see `nodes`). Along
//!   interference and slip rate it is added only if the errors of the points do not include it already (see
//!   [`Slice::with_interpolation_errors`]).
//!
//! [`Table::at`](crate::table::Table::at) gives the [`InterpolatedTable`] at an initial temperature, an
//! [`AsperityLaw`]. Depends on `table`, `closed_forms` (the elastic limit) and `law`. Chapter "Tables" of the book.

mod failed_cells;
pub(crate) mod first_yield;
mod hertz_limit;
mod histories;
mod interpolant;
mod low_rates;
mod nodes;
mod plastic_limit;
mod scalar;
pub mod steffen;
mod strain_rate;
mod temperature;
mod temperature_rise;

use std::ops::Deref;

pub use hertz_limit::{UNCERTAINTY_OF_KEPT_RATIO, UPLIFT};
use interpolant::Interpolant;
pub(crate) use interpolant::coordinates;
pub(crate) use nodes::{blend_one, cubic, neighbours};

use crate::law::{AsperityLaw, Estimate, LookupError, OptionalEstimate, Response, SlidingResponse};
use crate::quantity::{ElasticLimit, Quantity};
use crate::table::{Slice, Status};
use nodes::{Absent, COEFFICIENT, Errors, StateQuantity, Values};
use steffen::Location;

/// A slip rate or interference closer than this to the end of an axis, relatively, is on it.
const ROUNDING: f64 = 1e-9;
/// Relative difference of radii, and so of the conductance of a gap over that of the asperity, far below the errors of a table.
const SAME_RADIUS: f64 = 1e-3;

/// A table at one initial temperature as a law of one asperity; its numbers are those of the [`Slice`].
#[derive(Clone, Debug)]
pub struct InterpolatedTable {
    slice: Slice,
    interpolant: Interpolant,
}

impl Slice {
    /// The slice as a law.
    pub fn interpolated(self) -> InterpolatedTable {
        InterpolatedTable { interpolant: Interpolant::new(&self), slice: self }
    }
}

impl Deref for InterpolatedTable {
    type Target = Slice;

    fn deref(&self) -> &Slice {
        &self.slice
    }
}

impl InterpolatedTable {
    /// The numbers, to be changed.
    pub fn into_slice(self) -> Slice {
        self.slice
    }

    /// R/R_t, or why the table cannot be read at that radius.
    fn radius_ratio(&self, radius: f64) -> Result<f64, LookupError> {
        let metadata = self.metadata();
        let ratio = radius / metadata.asperity_radius;
        if metadata.gap_conductance != 0.0 && (ratio - 1.0).abs() > SAME_RADIUS {
            return Err(LookupError::RadiusFixed { table: metadata.asperity_radius, asked: radius });
        }
        Ok(ratio)
    }

    fn check_interference(&self, interference: f64) -> Result<(), LookupError> {
        let limit = self.contact_limit();
        if interference > limit * (1.0 + ROUNDING) {
            return Err(LookupError::ContactTooLarge { interference, limit });
        }
        Ok(())
    }

    /// Response at R = `ratio`·R_t from a state of the table, which takes interference and slip in the table.
    fn scaled(
        &self,
        interference: f64,
        slip_rate: f64,
        ratio: f64,
        slip: f64,
        state: impl Fn(f64, f64) -> Result<(Values, Errors), Absent>,
    ) -> Result<Response, Absent> {
        let base = self.metadata().temperature;
        let similar = self.similarity(slip_rate, ratio);
        let (interference, slip) = (similar.interference(interference), similar.slip(slip));
        let (values, errors) =
            if interference > 0.0 { state(interference, slip)? } else { Default::default() };
        let strength = self.strength_change(interference, slip_rate * ratio, ratio).after(slip);
        let estimate = |field: StateQuantity, scale: f64, limit: ElasticLimit| {
            let effect = strength.of(limit);
            let (value, error) = (values[field as usize], errors[field as usize].abs());
            Estimate {
                value: scale * effect.factor * value,
                error: scale * effect.factor * (value * (error + effect.error + similar.error(limit))).abs(),
            }
        };
        let rise = estimate(StateQuantity::TemperatureRise, 1.0, ElasticLimit::TemperatureRise);
        Ok(Response {
            load: estimate(StateQuantity::Load, similar.scale(Quantity::Load), ElasticLimit::Load),
            friction: estimate(
                StateQuantity::Friction,
                similar.scale(Quantity::Friction),
                ElasticLimit::SlidingFriction,
            ),
            area: estimate(StateQuantity::Area, similar.scale(Quantity::Area), ElasticLimit::Area),
            temperature_max: Estimate { value: base + rise.value, error: rise.error },
            coefficient_error: errors[COEFFICIENT]
                + strength.of(ElasticLimit::SlidingCoefficient).error
                + similar.error(ElasticLimit::SlidingCoefficient),
        })
    }

    /// A scalar, if the table has it; `unpressed` is that of a sphere that is not pressed.
    fn stated(
        &self,
        quantity: Quantity,
        radius: f64,
        interference: f64,
        slip_rate: f64,
        unpressed: f64,
    ) -> OptionalEstimate {
        match (self.holds(quantity), interference > 0.0) {
            (false, _) => Ok(None),
            (true, false) => Ok(Some(Estimate::exact(unpressed))),
            (true, true) => self.estimate(quantity, radius, interference, slip_rate).map(Some),
        }
    }

    fn located_rate(&self, interference: f64, slip_rate: f64, ratio: f64) -> Result<Location, LookupError> {
        self.check_interference(interference)?;
        let rates = &self.axes().slip_rate;
        let (first, last) = (rates[0], rates[rates.len() - 1]);
        let outside = LookupError::SlipRateOutside { slip_rate, from: first / ratio, to: last / ratio };
        self.interpolant.locate_rate(slip_rate * ratio).ok_or(outside)?;
        let similar = self.similarity(slip_rate, ratio).slip_rate(slip_rate);
        Ok(self.interpolant.locate_rate(similar.clamp(first, last)).expect("within the slip rates"))
    }

    fn absent(&self, (i, j): Absent, ratio: f64) -> LookupError {
        LookupError::Missing {
            interference: self.axes().interference[i],
            slip_rate: self.axes().slip_rate[j] / ratio,
            reason: match (self.status(i, j), &self.metadata().shard[..]) {
                (Status::NotRun, shard) if !shard.is_empty() => {
                    format!(
                        "the table is shard {shard} of its request; `asperity merge` puts the shards together"
                    )
                }
                (status, _) => nodes::reason(status),
            },
        }
    }
}

impl AsperityLaw for InterpolatedTable {
    fn name(&self) -> String {
        let title = match self.metadata().title.as_str() {
            "" => "table",
            title => title,
        };
        format!("{title}; counterface: {}", self.metadata().counterface_in_words())
    }

    fn request(&self) -> &str {
        &self.metadata().scene
    }

    fn critical_interference(&self, radius: f64) -> f64 {
        self.metadata().critical_interference * radius / self.metadata().asperity_radius
    }

    fn contact_modulus(&self) -> Option<f64> {
        Some(self.metadata().contact_modulus)
    }

    fn interference_limit(&self) -> f64 {
        let axis = &self.axes().interference;
        let last = (self.interpolant.rows).map_or(axis.len() - 1, |(_, last)| last);
        axis[last]
    }

    fn interference_start(&self) -> f64 {
        self.axes().interference[self.interpolant.rows.map_or(0, |(first, _)| first)]
    }

    fn contact_limit(&self) -> f64 {
        self.interpolant.log_end.exp()
    }

    fn radius_uncertainty(&self, radius: f64) -> f64 {
        let ratio = radius / self.metadata().asperity_radius;
        const LIMIT: ElasticLimit = ElasticLimit::SlidingCoefficient;
        let at = |rate: &f64| {
            let change = self.strength_change(self.interference_limit(), *rate, ratio);
            change.of(LIMIT).error + self.similarity(*rate / ratio, ratio).error(LIMIT)
        };
        let errors = self.axes().slip_rate.iter().map(at);
        errors.fold(0.0, f64::max)
    }

    fn breaks(&self) -> Vec<f64> {
        self.axes().interference.clone()
    }

    /// Where the histories end: contacts smaller than that have slid farther, and are held.
    fn breaks_after(&self, radius: f64, slip: f64) -> Vec<f64> {
        let ratio = radius / self.metadata().asperity_radius;
        self.interpolant.end_of_histories(slip / ratio).into_iter().collect()
    }

    fn slip_rate_range(&self, radius: f64) -> (f64, f64) {
        let ratio = radius / self.metadata().asperity_radius;
        let rates = &self.axes().slip_rate;
        (rates[0] / ratio, rates[rates.len() - 1] / ratio)
    }

    fn slip_rates(&self, radius: f64) -> Vec<f64> {
        let ratio = radius / self.metadata().asperity_radius;
        self.axes().slip_rate.iter().map(|rate| rate / ratio).collect()
    }

    fn response(
        &self,
        radius: f64,
        interference: f64,
        slip_rate: f64,
        slip: f64,
    ) -> Result<Response, LookupError> {
        let ratio = self.radius_ratio(radius)?;
        let rate = self.located_rate(interference, slip_rate, ratio)?;
        let state = |interference, slip| self.interpolant.state(interference, rate, slip);
        self.scaled(interference, slip_rate, ratio, slip, state).map_err(|absent| self.absent(absent, ratio))
    }

    /// Interpolates along the slip rate once.
    fn at_slip_rate(&self, radius: f64, slip_rate: f64) -> Result<SlidingResponse<'_>, LookupError> {
        let ratio = self.radius_ratio(radius)?;
        let rate = self.located_rate(0.0, slip_rate, ratio)?;
        let column = self.interpolant.at_rate(rate);
        let first = self.interference_start();
        Ok(Box::new(move |interference, slip| {
            self.check_interference(interference)?;
            // The effect of heat there is taken from the slowest slip rate and the strain rate.
            if interference < first {
                return self.response(radius, interference, slip_rate, slip);
            }
            let state = |interference, slip| column.state(interference, Location::on(0), slip);
            self.scaled(interference, slip_rate, ratio, slip, state)
                // The general lookup gives the reason of an error.
                .or_else(|_| self.response(radius, interference, slip_rate, slip))
        }))
    }

    /// Slip at inception (m) at the lowest slip rate; heat hardly changes it.
    fn inception_slip(&self, radius: f64, interference: f64) -> Result<Estimate, LookupError> {
        if interference <= 0.0 {
            return Ok(Estimate::default());
        }
        let (slowest, _) = self.slip_rate_range(radius);
        let slip = self.estimate(Quantity::InceptionSlip, radius, interference, slowest)?;
        Ok(if slip.value.is_finite() { slip } else { Estimate::default() })
    }

    fn begins_to_slide(&self, radius: f64, interference: f64, slip_rate: f64) -> Result<bool, LookupError> {
        let rate = self.located_rate(interference, slip_rate, self.radius_ratio(radius)?)?;
        Ok(interference <= 0.0 || self.begins_around(interference, rate))
    }

    fn rate_factor(&self, radius: f64, interference: f64, slip_rate: f64) -> Result<f64, LookupError> {
        if interference <= 0.0 || self.metadata().rate_coefficient.is_none() {
            return Ok(1.0);
        }
        let (slowest, _) = self.slip_rate_range(radius);
        let contact = self.estimate(Quantity::ContactRadius, radius, interference, slowest)?.value;
        Ok(self.interpolant.sphere.rate_factor(slip_rate, contact))
    }

    fn last_slip(&self) -> f64 {
        self.interpolant.nodes.last_slip()
    }

    fn steady_friction(&self, radius: f64, interference: f64, slip_rate: f64) -> OptionalEstimate {
        self.stated(Quantity::MuSteady, radius, interference, slip_rate, 0.0)
    }

    fn temperature_mean(&self, radius: f64, interference: f64, slip_rate: f64) -> OptionalEstimate {
        let initial = self.metadata().temperature;
        self.stated(Quantity::TemperatureMean, radius, interference, slip_rate, initial)
    }

    /// G times the area at inception.
    fn energy_release(&self, radius: f64, interference: f64, slip_rate: f64) -> OptionalEstimate {
        let per_area = self.stated(Quantity::EnergyRelease, radius, interference, slip_rate, 0.0)?;
        let Some(per_area) = per_area.filter(|_| interference > 0.0) else { return Ok(per_area) };
        let inception = self.estimate(Quantity::InceptionSlip, radius, interference, slip_rate)?;
        let area = self.response(radius, interference, slip_rate, inception.value)?.area;
        Ok(Some(per_area.times(area)))
    }
}

#[cfg(test)]
mod tests;
