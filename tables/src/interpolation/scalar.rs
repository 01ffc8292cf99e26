//! Scalars of a table between its points, below its first row and above its last.

use super::first_yield;
use super::hertz_limit::{BelowFirstRow, ElasticSphere, HeatRatio, extrapolated};
use super::interpolant::RowPosition;
use super::nodes::{self, Absent, OF_PARABOLA, OF_STRAIGHT, REFINEMENT, blend_with_bend, ends};
use super::steffen::Location;
use super::temperature_rise::RiseAxis;
use super::{Interpolant, InterpolatedTable};
use crate::law::{Estimate, LookupError};
use crate::quantity::{COVERAGE_FACTOR, ElasticLimit, OF_BOUND, Quantity};

impl InterpolatedTable {
    /// One of the scalars, for a sphere of `radius` (m) pressed by `interference` (ω/ω_c) and
    /// sliding at `slip_rate` (m/s); interpolated as the response is, with the error of the
    /// points (interpolated linearly) and, added as a square unless that includes it, half the
    /// difference to linear interpolation along each axis as its bound, of the logarithm where the corners are positive.
    pub fn estimate(
        &self,
        quantity: Quantity,
        radius: f64,
        interference: f64,
        slip_rate: f64,
    ) -> Result<Estimate, LookupError> {
        let ratio = self.radius_ratio(radius)?;
        let rate = self.located_rate(interference, slip_rate, ratio)?;
        let similar = self.similarity(slip_rate, ratio);
        let interference = similar.interference(interference);
        let absent = |absent| self.absent(absent, ratio);
        let rows @ (first, last) = self.interpolant.rows.ok_or((0, 0)).map_err(absent)?;
        let origin = quantity.origin(self.metadata().temperature);
        let between = |quantity, origin, place| self.between(quantity, origin, place, rate);
        let of_row = |quantity, origin, row: usize| {
            between(quantity, origin, Location::on(row)).map_or(f64::NAN, |(value, _)| value)
        };
        let position = self.interpolant.row_position_with_results(rows, interference.ln(), rate);
        let (value, error) = match position.map_err(absent)? {
            RowPosition::Inside(place) => between(quantity, origin, place).map_err(absent)?,
            RowPosition::Below(below) => {
                let (value, error) = between(quantity, origin, Location::on(first)).map_err(absent)?;
                let [load, area] =
                    [Quantity::Load, Quantity::Area].map(|quantity| of_row(quantity, 0.0, first));
                let heat = [Quantity::Load, Quantity::Area].map(|quantity| {
                    let of = |row, rate| {
                        self.between(quantity, 0.0, Location::on(row), rate).ok().map(|(value, _)| value)
                    };
                    self.interpolant.heat_ratio(rows, quantity == Quantity::Load, of, rate)
                });
                let slip_rate = self.interpolant.slip_rate_at(rate);
                let row = FirstRow { sphere: &self.interpolant.sphere, below, slip_rate, load, area, heat };
                let continued = row.extrapolate(quantity, value);
                let factor = if value == 0.0 { 1.0 } else { (continued / value).abs() };
                (continued, factor * error + row.uncertainty(quantity, value) * continued.abs())
            }
            RowPosition::Above(above) => {
                let (value, error) = between(quantity, origin, Location::on(last)).map_err(absent)?;
                let rows = |quantity, origin| {
                    let before = last.checked_sub(1).map(|before| of_row(quantity, origin, before));
                    (before, of_row(quantity, origin, last))
                };
                let [load, area] = [Quantity::Load, Quantity::Area].map(|quantity| rows(quantity, 0.0));
                let limit = quantity.descriptor().elastic_limit;
                let growth = above.of_scalar(limit, rows(quantity, origin), load, area);
                let factor = growth.factor();
                let relative = growth.relative() * value.abs();
                (factor * value, factor * (above.error_factor() * error + relative))
            }
        };
        let descriptor = quantity.descriptor();
        let of_rate =
            self.strength_change(interference, slip_rate * ratio, ratio).of(descriptor.elastic_limit);
        let relative = of_rate.error + similar.error(descriptor.elastic_limit);
        let (value, error) = (of_rate.factor * value, of_rate.factor * (error + relative * value.abs()));
        let scale = similar.scale(quantity);
        Ok(Estimate { value: scale * (origin + value), error: scale * error })
    }

    /// Whether sliding begins in all cells around a place.
    pub(super) fn begins_around(&self, interference: f64, rate: Location) -> bool {
        let Some(rows @ (first, last)) = self.interpolant.rows else { return true };
        let place = match self.interpolant.row_position(rows, interference.ln()) {
            RowPosition::Inside(place) => place,
            RowPosition::Below(_) => Location::on(first),
            RowPosition::Above(_) => Location::on(last),
        };
        let last_slip = self.interpolant.nodes.last_slip();
        let begins = |i: usize, j: usize| self.cell(i, j).is_none_or(|cell| cell.begins_to_slide(last_slip));
        ends(place).all(|(i, _)| ends(rate).all(|(j, _)| begins(i, j)))
    }

    /// A temperature rise below the first positive slip rate, and its [`bend`](super::low_rates::RiseFactor).
    fn rise_at_low_rate(
        &self,
        quantity: Quantity,
        origin: f64,
        i: usize,
        rate: Location,
    ) -> Option<(f64, f64)> {
        let value = |i: usize, j: usize, quantity: Quantity| Some(self.cell(i, j)?[quantity].value);
        let of = |i: usize, j: usize| {
            let rise = quantity.above_origin(value(i, j, quantity)?, origin);
            Some([rise, value(i, j, Quantity::Friction)?])
        };
        let low_rate = self.interpolant.rise_factor(i, rate, of).filter(|_| quantity.is_temperature())?;
        let friction = |j: usize| value(i, j, Quantity::Friction).ok_or((i, j));
        let (now, _) = blend_with_bend(&self.interpolant.rate_coordinate, rate, friction).ok()?;
        let [rise, first] = of(i, 1)?;
        let straight = rise * rate.t * now / first;
        let rise = low_rate.factor * straight;
        Some((rise, low_rate.bend * rise.abs()))
    }

    /// The place of a slip rate on the axis of the mean temperature rises of row `i`, for what is not a temperature itself, with the
    /// relative uncertainty of the rise at a low slip rate.
    fn rise_axis_of_row(&self, quantity: Quantity, i: usize, rate: Location) -> Option<(RiseAxis, f64)> {
        const MEAN: Quantity = Quantity::TemperatureMean;
        if quantity.is_temperature() {
            return None;
        }
        let origin = MEAN.origin(self.metadata().temperature);
        let of_rate = |j: usize| Some(MEAN.above_origin(self.cell(i, j)?[MEAN].value, origin));
        let (rise, bend) = match self.rise_at_low_rate(MEAN, origin, i, rate) {
            Some(value_and_bend) => value_and_bend,
            None => {
                let known = |j| of_rate(j).ok_or((i, j));
                (blend_with_bend(&self.interpolant.rate_coordinate, rate, known).ok()?.0, 0.0)
            }
        };
        Some((self.interpolant.rise_axis(rate, rise, of_rate)?, bend / rise))
    }

    /// (value above `origin`, error) at the radius of the table and inside its rows.
    fn between(
        &self,
        quantity: Quantity,
        origin: f64,
        place: Location,
        rate: Location,
    ) -> Result<(f64, f64), Absent> {
        let Interpolant { rate_coordinate, log_interference, .. } = &self.interpolant;
        let at = |i: usize, j: usize| {
            let cell = self.cell(i, j).ok_or((i, j))?;
            let Estimate { value, error } = cell[quantity];
            if value.is_nan() { Err((i, j)) } else { Ok((quantity.above_origin(value, origin), error)) }
        };
        // The difference of two slip rates says nothing of the curve between them.
        let only_two = if rate_coordinate.len() == 2 {
            4.0 * rate.t * (1.0 - rate.t) * OF_PARABOLA / OF_STRAIGHT
        } else {
            0.0
        };
        let row = |i: usize| -> Result<(f64, f64), Absent> {
            if let Some(value_and_bend) = self.rise_at_low_rate(quantity, origin, i, rate) {
                return Ok(value_and_bend);
            }
            let of_rate = |j| Ok(at(i, j)?.0);
            let unknown = if only_two > 0.0 { only_two * (of_rate(1)? - of_rate(0)?).abs() } else { 0.0 };
            let (mut value, mut bend) = blend_with_bend(rate_coordinate, rate, of_rate)?;
            if let Some((axis, uncertainty)) = self.rise_axis_of_row(quantity, i, rate) {
                (value, bend) = match quantity.descriptor().elastic_limit {
                    ElasticLimit::SlidingCoefficient => axis.blend_reciprocals((value, bend), of_rate)?,
                    _ => axis.blend((value, bend), of_rate)?,
                };
                if uncertainty > 0.0 {
                    bend += uncertainty * (value - of_rate(0)?).abs();
                }
            }
            Ok((value, bend.max(unknown)))
        };
        // The rows around the place, each of which several predictions ask for.
        let first = place.index.saturating_sub(2);
        let last =
            if place.t > 0.0 { (place.index + 3).min(log_interference.len() - 1) } else { place.index };
        let rows: Vec<_> = (first..=last).map(row).collect();
        let row = |i: usize| if (first..=last).contains(&i) { rows[i - first] } else { Err((i, 0)) };
        let of_row = |i: usize| Ok(row(i)?.0);
        let (value, bend) = blend_with_bend(log_interference, place, of_row)?;
        let included = self.metadata().interpolation_tolerance.is_some();
        let misfit = if included { 0.0 } else { left_out(log_interference, place, of_row) };
        let of_kink = match quantity.descriptor().elastic_limit {
            ElasticLimit::EnergyRelease => first_yield::kink(log_interference, place),
            _ => 0.0,
        };
        let mut bends = bend.max(value.abs() * misfit.max(of_kink) / OF_STRAIGHT);
        let mut error = 0.0;
        for (i, share_i) in ends(place) {
            for (j, share_j) in ends(rate) {
                error += share_i * share_j * at(i, j)?.1;
            }
            bends += share_i * row(i)?.1;
        }
        let interpolation = if included { 0.0 } else { COVERAGE_FACTOR * OF_BOUND * OF_STRAIGHT * bends };
        Ok((value, error.hypot(interpolation)))
    }
}

/// Bound, relative to the value, of the error of interpolation between two points of an axis: that of the prediction of either by the
/// others, for half of its interval. An interval shorter than the transition from elastic to plastic contact is smooth: there the
/// error falls faster than the interval.
fn left_out(axis: &[f64], place: Location, value: impl Fn(usize) -> Result<f64, Absent>) -> f64 {
    if place.t <= 0.0 || place.t >= 1.0 {
        return 0.0;
    }
    let misfit = |own: usize| {
        let (rest, at) = nodes::without(axis, own);
        let place = super::steffen::locate(&rest, at);
        let (predicted, _) = blend_with_bend(&rest, place, |n| value(n + usize::from(n >= own))).ok()?;
        let misfit = (predicted / value(own).ok()? - 1.0).abs();
        misfit.is_finite().then_some(misfit)
    };
    let inner = |own: &usize| (1..axis.len() - 1).contains(own);
    const TRANSITION: f64 = 4.0;
    let Location { index, t } = place;
    let largest = ends(place).map(|(own, _)| own).filter(inner).filter_map(misfit).fold(0.0, f64::max);
    let width = (axis[(index + 1).min(axis.len() - 1)] - axis[index]) / TRANSITION.ln();
    REFINEMENT * largest * width.min(1.0) * 4.0 * t * (1.0 - t)
}

/// The first row, with `load` and `area` while it slides, and an interference below it.
struct FirstRow<'a> {
    sphere: &'a ElasticSphere,
    below: BelowFirstRow,
    /// m/s.
    slip_rate: f64,
    load: f64,
    area: f64,
    /// Effect of heat on load and area.
    heat: [HeatRatio; 2],
}

impl FirstRow<'_> {
    /// A scalar from its value in the first row; as the response is, by its [`ElasticLimit`].
    fn extrapolate(&self, quantity: Quantity, row: f64) -> f64 {
        let Self { sphere, below, .. } = *self;
        let (here, first) = (below.interference(), below.first_row);
        let pressed = |elastic: &dyn Fn(f64) -> f64| self.weighted(elastic, row, below.press_weight());
        let limit = quantity.descriptor().elastic_limit;
        match limit {
            ElasticLimit::TemperatureRise => row * below.thermal_weight(),
            ElasticLimit::FirstRow => row,
            ElasticLimit::LoadPress => pressed(&|at| sphere.load(at)),
            ElasticLimit::AreaPress => pressed(&|at| sphere.area(at)),
            ElasticLimit::Load => self.load_below().0,
            ElasticLimit::Area => self.area_below().0,
            ElasticLimit::ContactRadius => pressed(&|at| sphere.contact_radius(at)),
            // No shear strength of the interface: friction coefficients are constant, forces proportional to the load.
            _ if !self.has_friction() => match quantity.descriptor().units {
                "1" => row,
                "N" => row * sphere.load(here) / sphere.load(first),
                _ => row * sphere.contact_radius(here) / sphere.contact_radius(first),
            },
            ElasticLimit::SlidingFriction => self.friction(row),
            ElasticLimit::SlidingCoefficient => self.friction(row * self.load) / self.load_below().0,
            ElasticLimit::StaticFriction => pressed(&|at| self.shear(at)),
            ElasticLimit::StaticCoefficient => pressed(&|at| self.shear(at) / sphere.load(at)),
            ElasticLimit::InceptionSlip | ElasticLimit::EnergyRelease => {
                self.weighted(&|at| self.elastic_inception(limit, at), row, below.plastic_weight())
            }
            // Slight heating: the drop of strength and the slip are both in proportion to a.
            ElasticLimit::Weakening => row * sphere.area(here) / sphere.area(first),
            ElasticLimit::None => f64::NAN,
        }
    }

    /// Relative uncertainty of that.
    fn uncertainty(&self, quantity: Quantity, row: f64) -> f64 {
        let Self { sphere, below, .. } = *self;
        let first = below.first_row;
        let (of_load, of_area) = (self.load_below().1, self.area_below().1);
        let sliding = of_load.max(of_area);
        let thermal = |friction: f64| {
            let strength = self.strength(friction)
                / (self.shear(below.interference()) / sphere.area(below.interference()));
            (strength - 1.0).abs() * (1.0 - below.thermal_weight())
        };
        let limit = quantity.descriptor().elastic_limit;
        match limit {
            ElasticLimit::TemperatureRise => below.rise_uncertainty(),
            _ if limit.is_of_press() && below.press_weight() == 1.0 => 0.0,
            // Without heat.
            _ if limit.is_of_press() => below
                .ratio_uncertainty(self.load / self.heat[0].first_row / sphere.load(first))
                .max(below.ratio_uncertainty(self.area / self.heat[1].first_row / sphere.area(first))),
            ElasticLimit::SlidingFriction if self.has_friction() => {
                sliding + sphere.uplift_uncertainty(below) + thermal(row)
            }
            ElasticLimit::SlidingCoefficient if self.has_friction() => {
                of_load + of_area + sphere.uplift_uncertainty(below) + thermal(row * self.load)
            }
            ElasticLimit::StaticCoefficient if self.has_friction() => {
                of_load + of_area + sphere.uplift_uncertainty(below)
            }
            ElasticLimit::InceptionSlip | ElasticLimit::EnergyRelease if self.has_friction() => {
                below.plastic_uncertainty(row / self.elastic_inception(limit, first))
                    + sphere.uplift_uncertainty(below)
            }
            _ => sliding + sphere.uplift_uncertainty(below),
        }
    }

    /// Slip at inception or G of the elastic sphere, in proportion to a power of the strength.
    fn elastic_inception(&self, limit: ElasticLimit, interference: f64) -> f64 {
        let (value, exponent) = match limit {
            ElasticLimit::InceptionSlip => (self.sphere.inception_slip(interference), 1.0),
            _ => (self.sphere.energy_release(interference), 2.0),
        };
        let rate_factor = self.sphere.rate_factor_at(self.slip_rate, interference);
        value.map_or(f64::NAN, |value| value * rate_factor.powf(exponent))
    }

    fn weighted(&self, elastic: &dyn Fn(f64) -> f64, row: f64, weight: f64) -> f64 {
        extrapolated(elastic(self.below.interference()), elastic(self.below.first_row), row, weight)
    }

    fn has_friction(&self) -> bool {
        self.sphere.sliding_friction(self.below.interference()).is_some()
    }

    /// Q of gross slip of the elastic sphere.
    fn shear(&self, interference: f64) -> f64 {
        let rate_factor = self.sphere.rate_factor_at(self.slip_rate, interference);
        self.sphere.sliding_friction(interference).map_or(f64::NAN, |friction| friction * rate_factor)
    }

    /// Q/A, from Q in the first row: heat changes sliding friction per area.
    fn strength(&self, friction: f64) -> f64 {
        let elastic = |at: f64| self.shear(at) / self.sphere.area(at);
        self.weighted(&elastic, friction / self.area, self.below.thermal_weight())
    }

    /// Q, from that in the first row.
    fn friction(&self, friction: f64) -> f64 {
        self.area_below().0 * self.strength(friction)
    }

    /// P of the slide and its relative uncertainty but for uplift.
    fn load_below(&self) -> (f64, f64) {
        ElasticSphere::pressed_below(self.below, &|at| self.sphere.load(at), self.load, self.heat[0])
    }

    /// A of the slide and the same.
    fn area_below(&self) -> (f64, f64) {
        ElasticSphere::pressed_below(self.below, &|at| self.sphere.area(at), self.area, self.heat[1])
    }
}
