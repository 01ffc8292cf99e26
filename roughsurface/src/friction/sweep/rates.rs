//! Steady sliding at the slip rates of the law, and through a step of the slip rate.

use super::{Asperities, PredictionError, PressedSurface, SlipState, Sweep, loaded_radii};
use crate::friction::in_order;
use crate::friction::rate_step::{self, RateStepResponse, Stepped};
use crate::surface::query::ContactLife;
use tables::law::Estimate;

/// The slip rates of ascending `rates` within a range, and its ends where they are not among them.
fn in_common(mut rates: Vec<f64>, (from, to): (f64, f64)) -> Vec<f64> {
    /// Distance in ln V of slip rates that are not taken for one.
    const APART: f64 = 0.1;
    rates.retain(|rate| (from..=to).contains(rate));
    if rates.is_empty() {
        return rates;
    }
    for end in [from, to].into_iter().filter(|end| *end > 0.0 && end.is_finite()) {
        if rates.iter().all(|rate| (end / rate).ln().abs() > APART) {
            rates.push(end);
        }
    }
    rates.sort_by(f64::total_cmp);
    rates
}

impl<'a> Sweep<'a> {
    /// The slip rates (m/s) of the law that it has at all radii, and the ends of the range of these; none of a formula.
    pub(crate) fn rates_around(&self) -> Vec<f64> {
        let radii = &self.surface.asperity_radius;
        in_common(self.law.slip_rates(radii.mean()), radii.slip_rate_range(self.law))
    }

    /// Sliding friction of every row at `slip_rates` (m/s); `pressed` is the surface before the slide. Unknown at rest where the
    /// law has no result.
    pub(crate) fn slide_steadily_around(
        &self,
        slip_rates: &[f64],
        pressed: &[&PressedSurface],
    ) -> Result<Vec<Vec<Estimate>>, PredictionError> {
        let of_rate = |&rate: &f64| -> Result<Vec<Estimate>, PredictionError> {
            let asperities = Asperities::new(self.law, self.surface, rate)?;
            let mu = |(row, pressed): (usize, &&PressedSurface)| {
                self.steady(&asperities, (row, rate), self.query.contact_life, pressed).map(|state| state.mu)
            };
            pressed.iter().enumerate().map(mu).collect()
        };
        let of_rate = |rate: &f64| match of_rate(rate) {
            Err(_) if *rate == 0.0 => Ok(vec![Estimate::UNKNOWN; pressed.len()]),
            found => found,
        };
        let by_rate = in_order(slip_rates, of_rate)?;
        Ok((0..pressed.len()).map(|row| by_rate.iter().map(|mu| mu[row]).collect()).collect())
    }

    /// Steady sliding of all rows before, through and after the step of the slip rate that the query asks for; `pressed` is the surface
    /// before the slide.
    pub(crate) fn rate_step(
        &self,
        pressed: &[&PressedSurface],
    ) -> Result<Option<RateStepResponse>, PredictionError> {
        let (Some(rates), ContactLife::Diameters(diameters)) =
            (self.query.rate_step, self.query.contact_life)
        else {
            return Ok(None);
        };
        let (life, end) = (2.0 * diameters, self.law.last_slip());
        if life > end {
            return Err(PredictionError::LifeBeyondHistories { life, end });
        }
        let [before, after] = rates;
        let asperities = |rate: f64| Asperities::new(self.law, self.surface, rate);
        let [slow, fast] = [asperities(before)?, asperities(after)?];
        let steady = |asperities: &Asperities<'a>, rate: f64| -> Result<Vec<SlipState>, _> {
            let rows = pressed.iter().enumerate();
            rows.map(|(row, pressed)| self.steady(asperities, (row, rate), self.query.contact_life, pressed))
                .collect()
        };
        let (start, target) = (steady(&slow, before)?, steady(&fast, after)?);
        let slip = rate_step::slip_grid(loaded_radii(pressed.iter().copied()), diameters);
        let stepping = fast.try_map(|asperity| asperity.stepping_from(before, diameters))?;
        let states: Vec<Vec<SlipState>> = in_order(&slip, |&since| {
            let mut integral = self.integral(&stepping.map(|asperity| asperity.since_step(since)));
            let rows = pressed.iter().enumerate();
            rows.map(|(row, before)| self.slid((row, after), &mut integral, before, &mut before.history()))
                .collect()
        })?;
        let stepped = |row: usize| Stepped {
            before: start[row].mu,
            after: target[row].mu,
            mu: states.iter().map(|rows| rows[row].mu).collect(),
        };
        let rows = (0..pressed.len()).map(stepped).collect();
        Ok(Some(RateStepResponse { rates, slip, rows }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A table at 0, 0.1, 1 and 10 m/s at the mean radius, of which other radii have 0.05 to 2.5 m/s.
    #[test]
    fn rates_reach_to_the_ends_of_the_range_that_all_radii_have() {
        let rates = || vec![0.0, 0.1, 1.0, 10.0];
        assert_eq!(in_common(rates(), (0.05, 2.5)), [0.05, 0.1, 1.0, 2.5]);
        assert_eq!(in_common(rates(), (0.0, 10.0)), [0.0, 0.1, 1.0, 10.0]);
        // An end by rounding beside a rate of the table is that rate.
        assert_eq!(in_common(rates(), (0.0999, 10.001)), [0.1, 1.0, 10.0]);
        assert!(in_common(Vec::new(), (0.05, 2.5)).is_empty());
        // The rates of a query do not take the place of a table of one positive rate, which tells no derivative.
        assert_eq!(in_common(vec![0.0, 3.0], (0.0, 3.0)), [0.0, 3.0]);
    }
}
