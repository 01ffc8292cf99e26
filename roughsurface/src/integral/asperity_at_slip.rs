//! One asperity at a fixed slip rate and slip, for any interference.

use std::sync::Arc;
use tables::law::{AsperityLaw, Estimate, LookupError, Response, SlidingResponse};

/// A quantity that is integrated beside load, friction and area if it is asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Additional {
    #[default]
    None,
    /// Energy released from full stick to full slip, J.
    EnergyRelease,
    /// Rise of the mean temperature of the contact times its area, K m².
    TemperatureRise,
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
    slip: f64,
    limit: f64,
    contact_limit: f64,
    additional: Additional,
}

impl<'a> AsperityAtSlip<'a> {
    /// Spheres of `radius` (m) that have slid by `slip` (m) at `slip_rate` (m/s).
    pub fn new(
        law: &'a dyn AsperityLaw,
        radius: f64,
        slip_rate: f64,
        slip: f64,
    ) -> Result<Self, LookupError> {
        Ok(Self {
            law,
            sliding: Arc::new(law.at_slip_rate(radius, slip_rate)?),
            radius,
            slip_rate,
            slip,
            limit: law.interference_limit(),
            contact_limit: law.contact_limit(),
            additional: Additional::None,
        })
    }

    /// The same asperities after another slip (m).
    pub fn after(&self, slip: f64) -> Self {
        Self { slip, ..self.clone() }
    }

    /// The same asperities with an additional quantity, if the law states it.
    pub fn with(&self, additional: Additional) -> Self {
        let probe = self.limit.min(1.0);
        let answer = match additional {
            Additional::None => Ok(None),
            Additional::EnergyRelease => self.law.energy_release(self.radius, probe, self.slip_rate),
            Additional::TemperatureRise => self.law.temperature_mean(self.radius, probe, self.slip_rate),
        };
        let is_stated = matches!(answer, Ok(Some(_)));
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
        breaks.extend(self.law.breaks_after(self.radius, self.slip));
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
        let last = (self.sliding)(interference.min(self.contact_limit), self.slip)?;
        Ok(Response {
            load: self.in_proportion(last.load, interference),
            friction: self.in_proportion(last.friction, interference),
            area: self.in_proportion(last.area, interference),
            temperature_max: last.temperature_max,
            coefficient_error: last.coefficient_error,
        })
    }

    /// The additional quantity at `interference` (ω/ω_c), where the asperity has the `response`.
    pub fn additional(&self, interference: f64, response: &Response) -> Result<Estimate, LookupError> {
        let inside = interference.min(self.contact_limit);
        match self.additional {
            Additional::None => Ok(Estimate::default()),
            Additional::EnergyRelease => {
                let energy = self.law.energy_release(self.radius, inside, self.slip_rate)?;
                // Stated at one interference and not at another: unknown.
                Ok(self.in_proportion(energy.unwrap_or(Estimate::UNKNOWN), interference))
            }
            Additional::TemperatureRise => Ok(self.temperature_rise(inside)?.scaled(response.area.value)),
        }
    }

    /// Initial temperature of the asperities, K: that of a contact of no size.
    pub fn initial_temperature(&self) -> Result<f64, LookupError> {
        Ok((self.sliding)(0.0, 0.0)?.temperature_max.value)
    }

    /// Rise of the mean temperature of the contact above the initial one, K. The law states it for the end of its slide;
    /// before, its ratio to the highest rise is that of the end.
    fn temperature_rise(&self, interference: f64) -> Result<Estimate, LookupError> {
        let initial = self.initial_temperature()?;
        let highest = |slip: f64| -> Result<f64, LookupError> {
            Ok((self.sliding)(interference, slip)?.temperature_max.value - initial)
        };
        let (now, end) = (highest(self.slip)?, highest(f64::INFINITY)?);
        let share = if end > 0.0 { now / end } else { 0.0 };
        let mean = self.law.temperature_mean(self.radius, interference, self.slip_rate)?;
        let mean = mean.unwrap_or(Estimate::UNKNOWN);
        let rise = share * (mean.value - initial);
        Ok(Estimate::with_errors(rise, [share * mean.error, RATIO_UNCERTAINTY * (1.0 - share) * rise]))
    }

    fn in_proportion(&self, last: Estimate, interference: f64) -> Estimate {
        let growth = (interference / self.contact_limit).max(1.0);
        Estimate { value: growth * last.value, error: growth * last.error }
    }
}
