//! An asperity law that weakens with slip rate, and a table of it, in place of simulations.

use tables::closed_forms::{ElasticPlastic, closed_form};
use tables::law::{AsperityLaw, Estimate, LookupError, Response};
use tables::numbers::Spacing::Log;
use tables::quantity::Quantity;
use tables::table::{Axes, Cell, Metadata, Slice};

pub const STEEL: ElasticPlastic =
    ElasticPlastic { youngs_modulus: 200e9, poisson_ratio: 0.3, yield_strength: 400e6 };

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
        Ok(response)
    }
}

/// The law as a table for spheres ten times as large as those of the surface.
pub fn table(law: &dyn AsperityLaw) -> Slice {
    let radius = 1e-3;
    let mut slip = vec![0.0];
    slip.extend(Log.range(1e-4, 2.0, 40));
    let axes = Axes { interference: Log.range(0.02, 200.0, 26), slip_rate: Log.range(1e-3, 2.0, 12), slip };
    let metadata = Metadata {
        title: "test".into(),
        asperity_radius: radius,
        critical_interference: law.critical_interference(radius),
        contact_modulus: STEEL.contact_modulus(),
        poisson_ratio: STEEL.poisson_ratio,
        yield_strength: STEEL.yield_strength,
        strength_factor: Some(1.0),
        temperature: 298.0,
        ..Metadata::default()
    };
    let cell = |interference: f64, rate: f64| {
        let at = |slip: f64| law.response(radius, interference, rate, slip).unwrap();
        let contact_radius = (at(0.0).area.value / std::f64::consts::PI).sqrt();
        let states: Vec<Response> = axes.slip.iter().map(|s| at(s * contact_radius)).collect();
        let history = |value: fn(&Response) -> Estimate| -> Vec<f64> {
            states.iter().map(|state| value(state).value).collect()
        };
        let (load, friction, area) = (history(|s| s.load), history(|s| s.friction), history(|s| s.area));
        let end = axes.slip.len() - 1;
        let mu: Vec<f64> = friction.iter().zip(&load).map(|(q, p)| q / p).collect();
        Cell::new()
            .with(Quantity::ContactRadius, contact_radius, 0.0)
            .with(Quantity::Mu, mu[end], 0.0)
            .with(Quantity::Load, load[end], 0.0)
            .with(Quantity::LoadPress, load[0], 0.0)
            .with(Quantity::Friction, friction[end], 0.0)
            .with(Quantity::Area, area[end], 0.0)
            .with(Quantity::AreaPress, area[0], 0.0)
            .with(Quantity::TemperatureMax, 298.0, 0.0)
            .with_history(Quantity::Mu, mu)
            .with_history(Quantity::Load, load)
            .with_history(Quantity::Friction, friction)
            .with_history(Quantity::Area, area)
            .with_history(Quantity::TemperatureMax, vec![298.0; axes.slip.len()])
    };
    Slice::filled(axes.clone(), metadata, cell).unwrap()
}
