//! One asperity at a fixed slip rate and slip, for any interference.

use std::sync::Arc;
use tables::law::{AsperityLaw, Estimate, LookupError, Response, SlidingResponse};

/// Relative uncertainty of extrapolated values per ln(ω/ω_limit).
///
/// Above its last knot a law is continued in proportion to ω, as for a fully plastic sphere; elastic–plastic
/// loads grow at most as ω^1.263 (Kogut & Etsion 2002, doi 10.1115/1.1490373), and this is the difference of
/// the exponents.
const EXPONENT_UNCERTAINTY: f64 = 0.263;

/// An asperity law with everything but the interference fixed.
#[derive(Clone)]
pub struct AsperityAtSlip<'a> {
    law: &'a dyn AsperityLaw,
    sliding: Arc<SlidingResponse<'a>>,
    radius: f64,
    slip_rate: f64,
    slip: f64,
    limit: f64,
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

    /// Largest ω/ω_c of the law.
    pub fn limit(&self) -> f64 {
        self.limit
    }

    /// Places ω/ω_c where the law has kinks, ascending, its limit among them.
    pub fn breaks(&self) -> Vec<f64> {
        let mut breaks = self.law.breaks();
        breaks.extend(self.law.breaks_after(self.radius, self.slip));
        breaks.push(self.limit);
        breaks.retain(|place| *place > 0.0 && place.is_finite() && *place <= self.limit);
        breaks.sort_by(f64::total_cmp);
        breaks.dedup_by(|next, kept| *next - *kept <= 1e-12 * *kept);
        breaks
    }

    /// Response at `interference` (ω/ω_c).
    ///
    /// Above the law's limit all forces and areas grow in proportion to ω, which
    /// holds friction and mean pressure at the last knot; their errors grow with
    /// the distance from it.
    pub fn response(&self, interference: f64) -> Result<Response, LookupError> {
        let last = (self.sliding)(interference.min(self.limit), self.slip)?;
        if interference <= self.limit {
            return Ok(last);
        }
        Ok(Response {
            load: self.continued(last.load, interference),
            friction: self.continued(last.friction, interference),
            area: self.continued(last.area, interference),
            temperature_max: last.temperature_max,
        })
    }

    /// Energy released from full stick to full slip at `interference` (ω/ω_c), J; zero
    /// [without energy](Self::with_energy).
    pub fn energy_release(&self, interference: f64) -> Result<Estimate, LookupError> {
        if !self.has_energy {
            return Ok(Estimate::default());
        }
        let inside = interference.min(self.limit);
        let answer = self.law.energy_release(self.radius, inside, self.slip_rate)?;
        // Stated at one interference and not at another: unknown.
        let last = answer.unwrap_or(Estimate { value: f64::NAN, error: f64::NAN });
        if interference <= self.limit {
            return Ok(last);
        }
        Ok(self.continued(last, interference))
    }

    fn continued(&self, last: Estimate, interference: f64) -> Estimate {
        let growth = interference / self.limit;
        let uncertainty = EXPONENT_UNCERTAINTY * growth.ln();
        Estimate { value: last.value * growth, error: (last.error + last.value.abs() * uncertainty) * growth }
    }
}
