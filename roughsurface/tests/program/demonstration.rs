//! An asperity law that weakens with slip rate, and a table of it, in place of simulations.

use tables::closed_forms::{STEEL, closed_form};
use tables::law::{AsperityLaw, Estimate, LookupError, Response};
use tables::numbers::Spacing::Log;
use tables::table::{Axes, Metadata, Slice};

/// K; the law has no heat.
const TEMPERATURE: f64 = 298.0;

/// Jackson–Green asperities that weaken with slip rate once they have slid by a
/// tenth of their contact radius.
pub struct Weakening {
    pub law: Box<dyn AsperityLaw>,
    /// Factor of friction, 1.
    pub strength: f64,
}

impl Weakening {
    pub fn new() -> Self {
        Self { law: closed_form("jackson-green", &STEEL).unwrap(), strength: 1.0 }
    }
}

impl AsperityLaw for Weakening {
    fn name(&self) -> String {
        "weakening".into()
    }
    fn critical_interference(&self, radius: f64) -> f64 {
        self.law.critical_interference(radius)
    }
    fn interference_limit(&self) -> f64 {
        f64::INFINITY
    }
    fn breaks(&self) -> Vec<f64> {
        self.law.breaks()
    }
    fn slip_rate_range(&self, _radius: f64) -> (f64, f64) {
        (0.0, f64::INFINITY)
    }
    fn response(
        &self,
        radius: f64,
        interference: f64,
        slip_rate: f64,
        slip: f64,
    ) -> Result<Response, LookupError> {
        let mut response = self.law.response(radius, interference, slip_rate, slip)?;
        let contact_radius = (response.area.value / std::f64::consts::PI).sqrt();
        let slid = 1.0 - (-slip / (0.1 * contact_radius).max(f64::MIN_POSITIVE)).exp();
        // A table scales with V R.
        let hot = slip_rate * radius / 1e-4;
        response.friction.value *= self.strength * (1.0 - 0.7 * slid * hot / (1.0 + hot));
        response.temperature_max = Estimate::exact(TEMPERATURE);
        Ok(response)
    }
}

/// The law as a table for spheres ten times as large as those of the surface.
pub fn table(law: &dyn AsperityLaw) -> Slice {
    let radius = 1e-3;
    let mut slip = vec![0.0];
    slip.extend(Log.range(1e-4, 2.0, 40));
    let axes = Axes { interference: Log.range(0.02, 200.0, 26), slip_rate: Log.range(1e-3, 2.0, 12), slip };
    let metadata = Metadata { title: "test".into(), ..Metadata::of_sphere(&STEEL, radius, TEMPERATURE) };
    let response = |interference, rate, slip| law.response(radius, interference, rate, slip).unwrap();
    Slice::of_response(axes, metadata, response).unwrap()
}
