//! One asperity at a fixed slip rate and slip, for any interference.

use std::sync::Arc;
use tables::law::{AsperityLaw, Estimate, LookupError, Response, SlidingResponse};

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
    has_energy: bool,
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
            has_energy: false,
        })
    }

    /// The same asperities after another slip (m).
    pub fn after(&self, slip: f64) -> Self {
        Self { slip, ..self.clone() }
    }

    /// The same asperities with their energy release, if the law states it.
    pub fn with_energy(&self) -> Self {
        let probe = self.limit.min(1.0);
        let answer = self.law.energy_release(self.radius, probe, self.slip_rate);
        Self { has_energy: matches!(answer, Ok(Some(_))), ..self.clone() }
    }

    /// Whether [`energy_release`](Self::energy_release) is available.
    pub fn has_energy(&self) -> bool {
        self.has_energy
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
        })
    }

    /// Energy released from full stick to full slip at `interference` (ω/ω_c), J; zero
    /// [without energy](Self::with_energy).
    pub fn energy_release(&self, interference: f64) -> Result<Estimate, LookupError> {
        if !self.has_energy {
            return Ok(Estimate::default());
        }
        let inside = interference.min(self.contact_limit);
        let answer = self.law.energy_release(self.radius, inside, self.slip_rate)?;
        // Stated at one interference and not at another: unknown.
        let last = answer.unwrap_or(Estimate { value: f64::NAN, error: f64::NAN });
        Ok(self.in_proportion(last, interference))
    }

    fn in_proportion(&self, last: Estimate, interference: f64) -> Estimate {
        let growth = (interference / self.contact_limit).max(1.0);
        Estimate { value: growth * last.value, error: growth * last.error }
    }
}
