//! Laws of one asperity with exact integrals, for tests.

use crate::integral::asperity_at_slip::AsperityAtSlip;
use crate::surface::heights::Heights;
use crate::surface::query::{LoadingControl, NormalLoading, Query, Surface};
use tables::law::{AsperityLaw, Estimate, LookupError, OptionalEstimate, Response};

pub use tables::closed_forms::STEEL;

/// Spheres of 0.1 mm at 1 m/s, before the slide.
pub fn asperity(law: &dyn AsperityLaw) -> AsperityAtSlip<'_> {
    AsperityAtSlip::new(law, 1e-4, 1.0).unwrap()
}

/// Summits of 0.1 mm, 1e10 a square metre.
pub fn surface(heights: impl Heights + 'static) -> Surface {
    Surface { asperity_density: 1e10, asperity_radius: 1e-4.into(), heights: Box::new(heights) }
}

/// At 1 m/s, with what is given held.
pub fn query(loading: NormalLoading) -> Query {
    let control = match loading {
        NormalLoading::Pressure(_) => LoadingControl::Load,
        NormalLoading::Separation(_) => LoadingControl::Separation,
    };
    Query { control, ..Query::new(loading, vec![1.0]) }
}

/// P, Q and A as powers of ω/ω_c, rate dependence and slip hardening by choice.
#[derive(Clone, Debug)]
pub struct PowerLaw {
    /// (factor, exponent) of load (N), friction (N) and area (m²).
    pub load: (f64, f64),
    pub friction: (f64, f64),
    pub area: (f64, f64),
    /// ω_c, m.
    pub critical: f64,
    /// Radius (m) at which that is ω_c, which is in proportion to the radius; none if it is at every radius.
    pub reference: Option<f64>,
    /// Slip of inception, m, and its relative error.
    pub inception: f64,
    pub inception_error: f64,
    /// ω/ω_c above which slides end before it.
    pub stuck_above: f64,
    pub limit: f64,
    pub relative_error: f64,
    /// Highest temperature of the contact (K) at ω/ω_c.
    pub temperature: fn(f64) -> f64,
    /// Rise of the mean temperature above that without contact over that of the highest, if there is a temperature.
    pub mean_rise: Option<f64>,
    /// Friction as a factor of slip rate (m/s), slip (m) and contact radius (m).
    pub history: fn(f64, f64, f64) -> f64,
    /// Share by which load and friction grow within a slip of some 0.1 µm.
    pub load_growth: f64,
    /// Strength at a slip rate (m/s) over that at rest, and the smallest slip rate.
    pub rate_factor: fn(f64) -> f64,
    pub slowest: f64,
    /// Slip over contact radius at which the history ends, and the friction coefficient that it tends to.
    pub last_slip: f64,
    pub steady: Option<Estimate>,
    /// ω/ω_c between which steady friction and mean temperature have no result.
    pub missing: (f64, f64),
}

impl PowerLaw {
    fn found<T>(&self, interference: f64, slip_rate: f64, value: T) -> Result<T, LookupError> {
        let (from, to) = self.missing;
        match (from..to).contains(&interference) {
            true => Err(LookupError::Missing { interference, slip_rate, reason: "none".into() }),
            false => Ok(value),
        }
    }

    /// Unit load and area with Hertz exponents, ω_c = 0.1 µm, Q = 1e8 Pa times A.
    pub fn hertz() -> Self {
        Self {
            load: (1e-3, 1.5),
            friction: (1e-4, 1.0),
            area: (1e-12, 1.0),
            critical: 1e-7,
            reference: None,
            inception: 0.0,
            inception_error: 0.0,
            stuck_above: f64::INFINITY,
            limit: f64::INFINITY,
            relative_error: 0.0,
            temperature: |_| 0.0,
            mean_rise: None,
            history: |_, _, _| 1.0,
            load_growth: 0.0,
            rate_factor: |_| 1.0,
            slowest: 0.0,
            last_slip: f64::INFINITY,
            steady: None,
            missing: (0.0, 0.0),
        }
    }
}

impl AsperityLaw for PowerLaw {
    fn name(&self) -> String {
        "power law".into()
    }
    fn critical_interference(&self, radius: f64) -> f64 {
        self.critical * self.reference.map_or(1.0, |reference| radius / reference)
    }
    fn begins_to_slide(&self, _radius: f64, interference: f64, _slip_rate: f64) -> Result<bool, LookupError> {
        Ok(interference <= self.stuck_above)
    }
    fn inception_slip(&self, _radius: f64, _interference: f64) -> Result<Estimate, LookupError> {
        Ok(Estimate { value: self.inception, error: self.inception_error * self.inception })
    }
    fn interference_limit(&self) -> f64 {
        self.limit
    }
    fn contact_limit(&self) -> f64 {
        self.limit
    }
    fn breaks(&self) -> Vec<f64> {
        Vec::new()
    }
    fn slip_rate_range(&self, _radius: f64) -> (f64, f64) {
        (self.slowest, 100.0)
    }
    fn rate_factor(&self, _radius: f64, _interference: f64, slip_rate: f64) -> Result<f64, LookupError> {
        Ok((self.rate_factor)(slip_rate))
    }
    fn response(
        &self,
        _radius: f64,
        interference: f64,
        slip_rate: f64,
        slip: f64,
    ) -> Result<Response, LookupError> {
        if interference > self.limit {
            return Err(LookupError::ContactTooLarge { interference, limit: self.limit });
        }
        let estimate = |(factor, exponent): (f64, f64)| {
            let value = factor * interference.powf(exponent);
            Estimate { value, error: self.relative_error * value }
        };
        let area = estimate(self.area);
        let contact_radius = (area.value / std::f64::consts::PI).sqrt();
        let history = (self.history)(slip_rate, slip.min(self.last_slip * contact_radius), contact_radius);
        let growth = 1.0 - self.load_growth * (-slip / 1e-7).exp_m1();
        let friction =
            estimate((growth * self.friction.0 * history * (self.rate_factor)(slip_rate), self.friction.1));
        let temperature_max = Estimate::exact((self.temperature)(interference));
        let load = estimate((growth * self.load.0, self.load.1));
        Ok(Response::new(load, friction, area, temperature_max))
    }
    fn last_slip(&self) -> f64 {
        self.last_slip
    }
    fn steady_friction(&self, _radius: f64, interference: f64, slip_rate: f64) -> OptionalEstimate {
        self.found(interference, slip_rate, self.steady)
    }
    fn temperature_mean(&self, _radius: f64, interference: f64, slip_rate: f64) -> OptionalEstimate {
        self.found(interference, slip_rate, ())?;
        let initial = (self.temperature)(0.0);
        let rise = self.mean_rise.map(|share| share * ((self.temperature)(interference) - initial));
        Ok(rise.map(|rise| Estimate { value: initial + rise, error: self.relative_error * rise }))
    }
}
