//! The question that every table and every closed form answers.

/// A number with an estimate of its absolute error, both in the same unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Estimate {
    pub value: f64,
    pub error: f64,
}

/// State of one asperity at one instant of its slide: SI units, the whole asperity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Response {
    /// Normal force P, N.
    pub load: Estimate,
    /// Friction force Q, N.
    pub friction: Estimate,
    /// Real contact area A, m².
    pub area: Estimate,
    /// Hottest point of the contact, K.
    pub temperature_max: Estimate,
}

/// Why a law has no answer for a state.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LookupError {
    #[error("interference {interference:.6} omega_c is above the table, which ends at {limit:.6} omega_c")]
    InterferenceAbove { interference: f64, limit: f64 },
    #[error(
        "slip rate {slip_rate:e} m/s is outside the table, which covers {from:e} to {to:e} m/s at this radius"
    )]
    SlipRateOutside { slip_rate: f64, from: f64, to: f64 },
    #[error(
        "the table depends on its radius of {table:e} m (gap conductance); it cannot be read at {asked:e} m"
    )]
    RadiusFixed { table: f64, asked: f64 },
    #[error("no result at interference {interference:.6} omega_c, slip rate {slip_rate:e} m/s: {reason}")]
    Missing { interference: f64, slip_rate: f64, reason: String },
}

/// Response at a fixed radius and slip rate against interference (ω/ω_c) and slip (m).
pub type SlidingResponse<'a> = Box<dyn Fn(f64, f64) -> Result<Response, LookupError> + Send + Sync + 'a>;

/// Load, friction and area of one asperity of given radius.
///
/// Interference is counted from first touch and given in units of the critical
/// interference ω_c of first yield under frictionless contact.
pub trait AsperityLaw: Send + Sync {
    /// Name to print.
    fn name(&self) -> String;
    /// ω_c in metres for a sphere of `radius` metres.
    fn critical_interference(&self, radius: f64) -> f64;
    /// Largest ω/ω_c for which there is an answer; infinite for closed forms.
    fn interference_limit(&self) -> f64;
    /// Values of ω/ω_c where the law or its derivatives have kinks: integrate between them.
    fn breaks(&self) -> Vec<f64>;
    /// Further such values for a sphere of `radius` (m) that has slid by `slip` (m): where its
    /// slide has come to an end, say.
    fn breaks_after(&self, _radius: f64, _slip: f64) -> Vec<f64> {
        Vec::new()
    }
    /// Range of slip rates (m/s) for a sphere of `radius` metres; 0 and infinity for rate-independent laws.
    fn slip_rate_range(&self, radius: f64) -> (f64, f64);
    /// Response of a sphere of `radius` (m) pressed by `interference` (ω/ω_c), after sliding
    /// by `slip` (m) at `slip_rate` (m/s).
    fn response(
        &self,
        radius: f64,
        interference: f64,
        slip_rate: f64,
        slip: f64,
    ) -> Result<Response, LookupError>;
    /// [`response`](AsperityLaw::response) for many questions at one radius and slip rate, where
    /// a law can prepare for them.
    fn at_slip_rate(&self, radius: f64, slip_rate: f64) -> Result<SlidingResponse<'_>, LookupError> {
        Ok(Box::new(move |interference, slip| self.response(radius, interference, slip_rate, slip)))
    }

    /// Energy that one asperity releases from full stick to full slip, J: work of the flat less
    /// the change of elastic energy, up to sliding inception; none where the law does not know it.
    fn energy_release(
        &self,
        _radius: f64,
        _interference: f64,
        _slip_rate: f64,
    ) -> Result<Option<Estimate>, LookupError> {
        Ok(None)
    }
}
