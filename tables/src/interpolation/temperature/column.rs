//! Numbers between initial temperatures, and their errors.

use crate::interpolation::nodes::OF_PARABOLA;
use crate::interpolation::steffen::Location;
use crate::interpolation::{blend_one, neighbours};
use crate::law::Estimate;
use crate::numbers::plain;
use crate::quantity::{COVERAGE_FACTOR, OF_BOUND, Quantity};
use crate::table::Cell;

/// A monotone cubic through four points of which the outer two may be missing: length of the interval, fraction of it,
/// distances and values of the outer points, inner values.
type Cubic = fn(f64, f64, [Option<(f64, f64)>; 2], [f64; 2]) -> f64;

/// A number at all temperatures `x`, NaN where unknown, for interpolation between two of them.
pub(super) struct Line<'a, F> {
    x: &'a [f64],
    place: Location,
    value: F,
    cubic: Cubic,
}

impl<'a, F: Fn(usize) -> f64> Line<'a, F> {
    pub(super) fn new(x: &'a [f64], place: Location, value: F, cubic: Cubic) -> Self {
        Self { x, place, value, cubic }
    }

    pub(super) fn value(&self) -> f64 {
        self.predicted(self.x, self.place, &self.value)
    }

    fn predicted(&self, x: &[f64], place: Location, value: impl Fn(usize) -> f64) -> f64 {
        let Location { index, t } = place;
        let outer = neighbours(x, index, |member| Some(value(member)).filter(|value| value.is_finite()));
        (self.cubic)(x[index + 1] - x[index], t, outer, [value(index), value(index + 1)])
    }

    /// Bound of the error of the value.
    ///
    /// Each inner temperature next to the place is left out and predicted from the others; the larger
    /// relative misfit, that of a wider interval, is taken as the error in the middle. It falls to zero at both
    /// ends as a square root, since softening laws may begin with an infinite slope. The difference between
    /// the cubic and the straight line is added. Where no temperature can be left out, the error in the middle
    /// is a quarter of the difference of both sides: the distance of a parabola with zero slope at one end
    /// from the straight line.
    pub(super) fn error(&self) -> f64 {
        let (x, value, found) = (self.x, &self.value, self.value());
        let Location { index, t } = self.place;
        let misfit = |own: usize| -> Option<f64> {
            if own == 0 || own + 1 == x.len() {
                return None;
            }
            let rest: Vec<f64> = x.iter().copied().filter(|t| *t != x[own]).collect();
            let place = Location { index: own - 1, t: (x[own] - x[own - 1]) / (x[own + 1] - x[own - 1]) };
            let predicted = self.predicted(&rest, place, |member| value(member + usize::from(member >= own)));
            let actual = value(own);
            let misfit = (predicted - actual).abs();
            let relative = if misfit == 0.0 { 0.0 } else { misfit / predicted.abs().max(actual.abs()) };
            relative.is_finite().then_some(relative)
        };
        let middle = match [index, index + 1].into_iter().filter_map(misfit).reduce(f64::max) {
            Some(relative) => relative * found.abs(),
            None => OF_PARABOLA * (value(index) - value(index + 1)).abs(),
        };
        let straight =
            self.predicted(&x[index..=index + 1], Location { index: 0, t }, |side| value(index + side));
        2.0 * (t * (1.0 - t)).sqrt() * middle + (found - straight).abs()
    }
}

/// Units of the quantities: powers of yield strength and contact modulus, both in Pa.
pub(super) struct Units {
    /// Yield strength and contact modulus at the temperatures of the series.
    pub members: Vec<(f64, f64)>,
    /// Yield strength and contact modulus at the temperature between them.
    pub here: (f64, f64),
    /// Relative errors of these.
    pub errors: (f64, f64),
}

impl Units {
    fn of(quantity: Quantity, (strength, modulus): (f64, f64)) -> f64 {
        match strength > 0.0 && modulus > 0.0 {
            true => {
                let (of_strength, of_modulus) = quantity.descriptor().material_exponents;
                strength.powi(of_strength) * modulus.powi(of_modulus)
            }
            // A table without these constants is interpolated in SI units.
            false => 1.0,
        }
    }

    /// Relative error of the unit here.
    fn error(&self, quantity: Quantity) -> f64 {
        let (of_strength, of_modulus) = quantity.descriptor().material_exponents;
        let share = |power: i32, error: f64| if power == 0 { 0.0 } else { f64::from(power.abs()) * error };
        match self.here.0 > 0.0 && self.here.1 > 0.0 {
            true => share(of_strength, self.errors.0) + share(of_modulus, self.errors.1),
            false => 0.0,
        }
    }
}

/// The cells of one point of the grid at all temperatures.
pub(super) struct Column<'a> {
    pub temperatures: &'a [f64],
    pub units: &'a Units,
    pub cells: Vec<Option<&'a Cell>>,
}

impl Column<'_> {
    /// The cell between two that are there.
    pub(super) fn at(&self, place: Location, temperature: f64) -> Cell {
        let mut cell = Cell::new();
        let base = |quantity: Quantity| quantity.origin(temperature);
        for quantity in Quantity::SCALARS {
            let value = |member: usize| self.scaled(member, quantity, |cell| cell[quantity].value);
            let line = Line::new(self.temperatures, place, value, blend_one);
            let unit = Units::of(quantity, self.units.here);
            let found = unit * line.value();
            let error = |member: usize| {
                let known = self.cells[member].map_or(f64::NAN, |cell| cell[quantity].error);
                known / Units::of(quantity, self.units.members[member])
            };
            let given = unit * ((1.0 - place.t) * error(place.index) + place.t * error(place.index + 1));
            let bound = unit * line.error() + self.units.error(quantity) * found.abs();
            let error = given.hypot(COVERAGE_FACTOR * OF_BOUND * bound);
            cell[quantity] = Estimate { value: base(quantity) + found, error };
        }
        for quantity in Quantity::TABLE_HISTORIES {
            let points = self.cells[place.index].map_or(0, |cell| cell.history(quantity).len());
            let unit = Units::of(quantity, self.units.here);
            let point = |k: usize| {
                let value = |member: usize| self.scaled(member, quantity, |cell| cell.history(quantity)[k]);
                base(quantity) + unit * Line::new(self.temperatures, place, value, blend_one).value()
            };
            cell = cell.with_history(quantity, (0..points).map(point).collect());
        }
        let members = [place.index, place.index + 1];
        let sides = members.map(|member| self.cells[member]);
        cell.steady = sides.iter().flatten().all(|side| side.steady);
        cell.wall_time = 0.0;
        // What one side alone says is about its temperature.
        let [one, other] = members.map(|member| self.cells[member].map_or(&[][..], |side| &side.warnings));
        let own =
            |member: usize, warning: &String| format!("at {} K: {warning}", plain(self.temperatures[member]));
        let both = one.iter().filter(|warning| other.contains(warning)).cloned();
        let of_one = one.iter().filter(|warning| !other.contains(warning)).map(|it| own(members[0], it));
        let of_other = other.iter().filter(|warning| !one.contains(warning)).map(|it| own(members[1], it));
        cell.warnings = both.chain(of_one).chain(of_other).collect();
        cell
    }

    /// A number of the cell of a member in its unit; of a temperature the rise above the initial one.
    fn scaled(&self, member: usize, quantity: Quantity, of: impl Fn(&Cell) -> f64) -> f64 {
        let base = quantity.origin(self.temperatures[member]);
        let value = self.cells[member].map_or(f64::NAN, of) - base;
        value / Units::of(quantity, self.units.members[member])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closed_forms::partial_slip::constant_shear;
    use crate::closed_forms::{ElasticPlastic, hertz};

    /// At first yield, for one Poisson's ratio: slip of gross slip and its dissipation per area, up to a factor.
    #[test]
    fn elastic_slip_and_its_energy_do_not_change_in_their_units() {
        let at = |yield_strength: f64, youngs_modulus: f64| {
            let metal = ElasticPlastic { youngs_modulus, poisson_ratio: 0.3, yield_strength };
            let a = hertz::contact_radius(1e-3, metal.critical_interference(1e-3));
            let slip = constant_shear::gross_slip_displacement(yield_strength, youngs_modulus, a);
            let unit = |quantity| Units::of(quantity, (yield_strength, youngs_modulus));
            [slip / unit(Quantity::InceptionSlip), yield_strength * slip / unit(Quantity::EnergyRelease)]
        };
        let (cold, hot) = (at(800e6, 200e9), at(300e6, 150e9));
        for (cold, hot) in cold.into_iter().zip(hot) {
            assert!((hot / cold - 1.0).abs() < 1e-12, "{cold} {hot}");
        }
    }
}
