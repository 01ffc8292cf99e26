//! Scalars of a table between its points.

use super::elastic::{Descent, Elastic};
use super::nodes::FIELDS;
use super::steffen::{Location, locate};
use super::{Absent, Interpolant, InterpolatedTable};
use crate::law::{Estimate, LookupError};
use crate::quantity::Quantity;

impl InterpolatedTable {
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
        let interpolant = &self.interpolant;
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
            let row =
                |quantity| self.between(interpolant, quantity, 0.0, place, rate).map(|(value, _)| value);
            let of_row = |quantity| row(quantity).unwrap_or(f64::NAN);
            let below = Below {
                elastic: &interpolant.elastic,
                descent: interpolant.descent(first, interference.ln()),
                load: of_row(Quantity::Load),
                area: of_row(Quantity::Area),
            };
            let (continued, spread) = below.continued(quantity, value);
            error *= if value == 0.0 { 1.0 } else { (continued / value).abs() };
            error += spread * continued.abs();
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

/// Below the first row, which bears `load` on `area` while it slides.
struct Below<'a> {
    elastic: &'a Elastic,
    descent: Descent,
    load: f64,
    area: f64,
}

impl Below<'_> {
    /// A scalar continued from its value in the row as the response is, and the relative error of that.
    fn continued(&self, quantity: Quantity, row: f64) -> (f64, f64) {
        use Quantity::*;
        let Self { elastic, descent, .. } = *self;
        let (here, knot) = (descent.here(), descent.knot);
        let from = |asymptote: &dyn Fn(f64) -> f64, row: f64, share: f64| {
            elastic.continued(asymptote(here), asymptote(knot), row, share)
        };
        let load = |at: f64| elastic.load(at);
        let area = |at: f64| elastic.area(at);
        let kept = |asymptote: &dyn Fn(f64) -> f64| from(asymptote, row, descent.kept());
        let shear = |at: f64| elastic.sliding_friction(at).unwrap_or(f64::NAN);
        // What sliding friction has beside the area fades, as heat does; static friction knows no heat.
        let strength = |at: f64| shear(at) / area(at);
        let friction = |row: f64| {
            from(&area, self.area, descent.kept()) * from(&strength, row / self.area, descent.fade())
        };
        let rubs = elastic.sliding_friction(here).is_some();
        let value = match quantity {
            TemperatureMax | TemperatureMean => row * descent.fade(),
            Load | LoadPress => kept(&load),
            Area | AreaPress => kept(&area),
            ContactRadius => kept(&|at| elastic.contact_radius(at)),
            // Weakening by a slight heating: drop of strength and slip both go with a.
            EnergyWeakening if rubs => row * area(here) / area(knot),
            Friction if rubs => friction(row),
            Mu | MuMean if rubs => friction(row * self.load) / from(&load, self.load, descent.kept()),
            FrictionStatic if rubs => kept(&shear),
            MuStatic | MuPeak if rubs => kept(&|at| shear(at) / load(at)),
            InceptionSlip if rubs => kept(&|at| elastic.inception_slip(at).unwrap_or(f64::NAN)),
            EnergyRelease if rubs => kept(&|at| elastic.energy_release(at).unwrap_or(f64::NAN)),
            // No strength of its own: friction coefficients stay, forces go with the load.
            _ => match quantity.descriptor().units {
                "1" => row,
                "N" => row * load(here) / load(knot),
                _ => row * elastic.contact_radius(here) / elastic.contact_radius(knot),
            },
        };
        let sliding = descent.doubt(self.load / load(knot)).max(descent.doubt(self.area / area(knot)));
        let fades = |row: f64| {
            let faded = from(&strength, row / self.area, descent.fade()) / strength(here);
            (faded - 1.0).abs() * (1.0 - descent.fade())
        };
        let spread = match quantity {
            TemperatureMax | TemperatureMean => 0.0,
            LoadPress | AreaPress | ContactRadius if descent.kept() == 1.0 => 0.0,
            LoadPress | AreaPress | ContactRadius => sliding,
            Friction if rubs => sliding + elastic.lifted(descent) + fades(row),
            Mu | MuMean if rubs => sliding + elastic.lifted(descent) + fades(row * self.load),
            _ => sliding + elastic.lifted(descent),
        };
        (value, spread)
    }
}
