//! One asperity at a fixed slip rate, after a slip or averaged over the ages of its contact, for any interference.

use crate::integral::mean_over_ages::MeanOverAges;
use crate::integral::rate_step::RateStep;
use crate::surface::query::ContactLife;
use std::f64::consts::PI;
use std::sync::Arc;
use tables::law::{
    AsperityLaw, Estimate, LookupError, OptionalEstimate, Response, SlidingResponse, UNKNOWN_STEADY_FRICTION,
};

/// A quantity that is integrated beside load, friction and area if it is asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Additional {
    #[default]
    None,
    /// Energy released from full stick to full slip, J.
    EnergyRelease,
    /// Rise of the mean temperature of the contact times its area, K m².
    TemperatureRise,
    /// Load of contacts older than the histories of the law, of unknown steady friction, N.
    UnsteadyLoad,
    /// Load of contacts whose slides end before sliding begins, N.
    StuckLoad,
    /// Load times the relative error of the slip at which the contact begins to slide, N.
    InceptionError,
}

/// How far the contacts have slid.
#[derive(Clone)]
enum Age<'a> {
    /// All contacts have slid by the same slip, m.
    Slip(f64),
    /// Each contact has slid by any slip of its life, equally likely.
    Life(ContactLife),
    /// Each contact has slid by any slip of its life in `diameters`, of which `slip` (m) since a step of the slip rate.
    SinceStep { step: Arc<RateStep<'a>>, diameters: f64, slip: f64 },
}

/// Relative uncertainty of the ratio of mean to highest temperature rise before the end of the slide of the law, times
/// the share of the highest rise that is still to come. In a slide of steel 4340 at 20 ω_c and 10 m/s the ratio falls from
/// 0.92 at s = 0.06 a to 0.84 at 0.4 a and 0.80 at 2 a.
const RATIO_UNCERTAINTY: f64 = 0.2;

/// An asperity law with everything but the interference fixed.
#[derive(Clone)]
pub struct AsperityAtSlip<'a> {
    law: &'a dyn AsperityLaw,
    sliding: Arc<SlidingResponse<'a>>,
    radius: f64,
    slip_rate: f64,
    age: Age<'a>,
    limit: f64,
    contact_limit: f64,
    additional: Additional,
}

impl<'a> AsperityAtSlip<'a> {
    /// Spheres of `radius` (m) that slide at `slip_rate` (m/s), before the slide.
    pub fn new(law: &'a dyn AsperityLaw, radius: f64, slip_rate: f64) -> Result<Self, LookupError> {
        Ok(Self {
            law,
            sliding: Arc::new(law.at_slip_rate(radius, slip_rate)?),
            radius,
            slip_rate,
            age: Age::Slip(0.0),
            limit: law.interference_limit(),
            contact_limit: law.contact_limit(),
            additional: Additional::None,
        })
    }

    /// The same asperities after another slip (m).
    pub fn after(&self, slip: f64) -> Self {
        Self { age: Age::Slip(slip), ..self.clone() }
    }

    /// The same asperities in steady sliding, with contacts of all ages of their `life`.
    pub fn of_all_ages(&self, life: ContactLife) -> Self {
        Self { age: Age::Life(life), ..self.clone() }
    }

    /// The same asperities with contacts of all ages of a life in `diameters`, which have slid at `before` (m/s) until now.
    pub fn stepping_from(&self, before: f64, diameters: f64) -> Result<Self, LookupError> {
        let step = Arc::new(RateStep::new(self.law, self.radius, [before, self.slip_rate])?);
        Ok(Self { age: Age::SinceStep { step, diameters, slip: 0.0 }, ..self.clone() })
    }

    /// The same asperities after another slip (m) since the step of the slip rate.
    pub fn since_step(&self, since: f64) -> Self {
        let mut later = self.clone();
        if let Age::SinceStep { slip, .. } = &mut later.age {
            *slip = since;
        }
        later
    }

    /// The same asperities with an additional quantity, if the law states it.
    pub fn with(&self, additional: Additional) -> Self {
        let probe = self.limit.min(1.0);
        let answer = match additional {
            Additional::None => Ok(None),
            Additional::StuckLoad | Additional::InceptionError => Ok(Some(Estimate::default())),
            Additional::UnsteadyLoad => Ok((self.beyond_histories() > 0.0).then(Estimate::default)),
            Additional::EnergyRelease => self.law.energy_release(self.radius, probe, self.slip_rate),
            Additional::TemperatureRise => self.law.temperature_mean(self.radius, probe, self.slip_rate),
        };
        // A place without a result does not tell about others.
        let is_stated = !matches!(answer, Ok(None));
        Self { additional: if is_stated { additional } else { Additional::None }, ..self.clone() }
    }

    /// Whether there is an additional quantity.
    pub fn has_additional(&self) -> bool {
        self.additional != Additional::None
    }

    /// The same asperities with another [`limit`](Self::limit): the load above it is counted, the response is the same.
    pub fn counted_above(&self, interference: f64) -> Self {
        Self { limit: interference, ..self.clone() }
    }

    /// Critical interference ω_c of the spheres, m.
    pub fn critical_interference(&self) -> f64 {
        self.law.critical_interference(self.radius)
    }

    /// Largest ω/ω_c of the range of the law, above which it is extrapolated.
    pub fn limit(&self) -> f64 {
        self.limit
    }

    /// ω/ω_c at which the model ends.
    pub fn contact_limit(&self) -> f64 {
        self.contact_limit
    }

    /// Places ω/ω_c where the law has kinks, ascending, its limits among them.
    pub fn breaks(&self) -> Vec<f64> {
        let mut breaks = self.law.breaks();
        if let Age::Slip(slip) = self.age {
            breaks.extend(self.law.breaks_after(self.radius, slip));
        }
        breaks.extend([self.limit, self.contact_limit]);
        breaks.retain(|place| *place > 0.0 && place.is_finite() && *place <= self.contact_limit);
        breaks.sort_by(f64::total_cmp);
        breaks.dedup_by(|next, kept| *next - *kept <= 1e-12 * *kept);
        breaks
    }

    /// Response at `interference` (ω/ω_c).
    ///
    /// Beyond the contact limit forces and areas grow in proportion to ω, so that every pressure has a separation;
    /// the share of the load there is that of [`ContactState::beyond`](crate::integral::contact_state::ContactState).
    pub fn response(&self, interference: f64) -> Result<Response, LookupError> {
        let inside = interference.min(self.contact_limit);
        let last = match &self.age {
            Age::Slip(slip) => (self.sliding)(inside, *slip)?,
            Age::Life(ContactLife::Steady) => self.steady(inside)?,
            Age::Life(ContactLife::Diameters(diameters)) => self.mean_over_life(inside, *diameters)?,
            Age::SinceStep { step, diameters, slip } => {
                self.mean_since_step(step, inside, *diameters, *slip)?
            }
        };
        Ok(Response {
            load: self.in_proportion(last.load, interference),
            friction: self.in_proportion(last.friction, interference),
            area: self.in_proportion(last.area, interference),
            ..last
        })
    }

    /// The additional quantity at `interference` (ω/ω_c), where the asperity has the `response`.
    pub fn additional(&self, interference: f64, response: &Response) -> Result<Estimate, LookupError> {
        let inside = interference.min(self.contact_limit);
        match self.additional {
            Additional::None => Ok(Estimate::default()),
            Additional::EnergyRelease => {
                let energy = self.law.energy_release(self.radius, inside, self.slip_rate);
                Ok(self.in_proportion(where_stated(energy), interference))
            }
            Additional::TemperatureRise => Ok(self.temperature_rise(inside)?.scaled(response.area.value)),
            Additional::StuckLoad => {
                let begins = self.law.begins_to_slide(self.radius, inside, self.slip_rate)?;
                Ok(Estimate::exact(if begins { 0.0 } else { response.load.value }))
            }
            Additional::InceptionError => {
                // A table may not hold it.
                let slip = self.law.inception_slip(self.radius, inside).unwrap_or_default();
                let share = if slip.value > 0.0 { slip.error / slip.value } else { 0.0 };
                Ok(Estimate::exact(share * response.load.value))
            }
            Additional::UnsteadyLoad => {
                let steady = self.law.steady_friction(self.radius, inside, self.slip_rate)?;
                let known = steady.is_some_and(|mu| mu.error <= UNKNOWN_STEADY_FRICTION * mu.value);
                let share = if known { 0.0 } else { self.beyond_histories() };
                Ok(Estimate::exact(share * response.load.value))
            }
        }
    }

    /// Share of the contacts that are older than the histories of the law and need its steady friction.
    fn beyond_histories(&self) -> f64 {
        let last = self.law.last_slip();
        match self.age {
            Age::Life(ContactLife::Steady) if last.is_finite() => 1.0,
            Age::Life(ContactLife::Diameters(diameters)) => (1.0 - last / (2.0 * diameters)).max(0.0),
            _ => 0.0,
        }
    }

    /// Whether the law states the friction of contacts of every age.
    pub fn has_friction_of_all_ages(&self) -> bool {
        let probe = self.limit.min(1.0);
        let stated = || self.law.steady_friction(self.radius, probe, self.slip_rate);
        self.beyond_histories() == 0.0 || !matches!(stated(), Ok(None))
    }

    /// A contact that lasts: steady friction under the load at the end of the slide of the law.
    fn steady(&self, interference: f64) -> Result<Response, LookupError> {
        let end = (self.sliding)(interference, f64::INFINITY)?;
        let steady = self.law.steady_friction(self.radius, interference, self.slip_rate)?;
        // Without it: the last value, which is not used (`has_friction_of_all_ages`).
        Ok(steady.map_or(end, |mu| {
            let friction = mu.times(end.load);
            let coefficient_error = if mu.value == 0.0 { 0.0 } else { (mu.error / mu.value).abs() };
            Response { friction, coefficient_error, ..end }
        }))
    }

    /// Mean over the ages of a contact, slips from 0 to its life.
    fn mean_over_life(&self, interference: f64, diameters: f64) -> Result<Response, LookupError> {
        let life = self.life(interference, diameters)?;
        let beyond = self.beyond_histories();
        let mut mean = MeanOverAges::default();
        mean.add_ages(1.0 - beyond, |share| (self.sliding)(interference, (1.0 - beyond) * share * life))?;
        if beyond > 0.0 {
            mean.add(beyond, &self.older_than_histories(interference, 1.0 - beyond)?);
        }
        Ok(mean.response())
    }

    /// Mean over the contacts that are older than the histories of the law, which end at the share `end` of the life.
    ///
    /// Friction approaches its steady value as 1/√s, as the temperature does: μ = μ_∞ + (μ_e − μ_∞)√(s_e/s) from the end
    /// s_e of the history on. The mean has the weight w = 2/(1 + √(L/s_e)) of μ_e, L the life. The power is not exact:
    /// w (1 − w)|μ_e − μ_∞| is an error.
    fn older_than_histories(&self, interference: f64, end: f64) -> Result<Response, LookupError> {
        let (last, steady) = ((self.sliding)(interference, f64::INFINITY)?, self.steady(interference)?);
        let weight = 2.0 / (1.0 + end.recip().sqrt());
        let mut mean = MeanOverAges::default();
        mean.add(weight, &last);
        mean.add(1.0 - weight, &steady);
        let power = weight * (1.0 - weight) * (last.friction.value - steady.friction.value).abs();
        let Response { friction, coefficient_error, .. } = mean.response();
        let relative = if friction.value == 0.0 { 0.0 } else { power / friction.value.abs() };
        let friction = Estimate { error: friction.error + power, ..friction };
        Ok(Response { friction, coefficient_error: coefficient_error + relative, ..last })
    }

    /// Mean response over the ages of the contacts at the slip `since` (m) after a step of the slip rate: contacts born after the step, and before it.
    fn mean_since_step(
        &self,
        step: &RateStep,
        interference: f64,
        diameters: f64,
        since: f64,
    ) -> Result<Response, LookupError> {
        let life = self.life(interference, diameters)?;
        let since = since.min(life);
        let renewed = if life > 0.0 { since / life } else { 1.0 };
        let contact = step.contact(interference)?;
        let mut mean = MeanOverAges::default();
        mean.add_ages(renewed, |share| (self.sliding)(interference, share * since))?;
        mean.add_ages(1.0 - renewed, |share| contact.response(share * (life - since), since))?;
        Ok(mean.response())
    }

    /// Slip over which a contact lasts, m.
    fn life(&self, interference: f64, diameters: f64) -> Result<f64, LookupError> {
        let radius = ((self.sliding)(interference, 0.0)?.area.value.max(0.0) / PI).sqrt();
        Ok(2.0 * diameters * radius)
    }

    /// Initial temperature of the asperities, K: that of a contact of no size.
    pub fn initial_temperature(&self) -> Result<f64, LookupError> {
        Ok((self.sliding)(0.0, 0.0)?.temperature_max.value)
    }

    /// Rise of the mean temperature of the contact above the initial one, K. The law states it for the end of its slide;
    /// before, its ratio to the highest rise is that of the end.
    fn temperature_rise(&self, interference: f64) -> Result<Estimate, LookupError> {
        let initial = self.initial_temperature()?;
        let highest = |slip: f64| -> Result<Estimate, LookupError> {
            let Estimate { value, error } = (self.sliding)(interference, slip)?.temperature_max;
            Ok(Estimate { value: value - initial, error })
        };
        let slip = if let Age::Slip(slip) = self.age { slip } else { f64::INFINITY };
        let (now, end) = (highest(slip)?, highest(f64::INFINITY)?);
        let share = if end.value > 0.0 { now.value / end.value } else { 0.0 };
        // After the slide of the law its end holds, with an error that the mean has as well.
        let held = if share == 1.0 { (now.error - end.error) / end.value } else { 0.0 };
        let mean = where_stated(self.law.temperature_mean(self.radius, interference, self.slip_rate));
        let rise = share * (mean.value - initial);
        let errors = [share * mean.error, RATIO_UNCERTAINTY * (1.0 - share) * rise, held * rise];
        Ok(Estimate::with_errors(rise, errors))
    }

    fn in_proportion(&self, last: Estimate, interference: f64) -> Estimate {
        last.scaled((interference / self.contact_limit).max(1.0))
    }
}

/// Stated at one interference and not at another: unknown.
fn where_stated(answer: OptionalEstimate) -> Estimate {
    answer.ok().flatten().unwrap_or(Estimate::UNKNOWN)
}

#[cfg(test)]
mod tests;
