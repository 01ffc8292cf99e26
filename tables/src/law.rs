//! The single-asperity response: the interface of tables and closed forms. Depends on `quantity`.

use crate::quantity::numbers::{digits, plain};

pub use crate::quantity::Estimate;

/// Largest contact radius over the radius of the asperity. Beyond it the meridian mesh does not fit into the
/// hemisphere, and the base of the hemisphere is felt.
pub const LARGEST_CONTACT: f64 = 0.4;

/// Relative error from which on steady friction counts as unknown.
pub const UNKNOWN_STEADY_FRICTION: f64 = 0.2;

/// State of one asperity after a slip: SI units, the whole asperity.
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
    /// Relative error of Q/P. Errors of Q and P of the same sign cancel in it.
    pub coefficient_error: f64,
}

impl Response {
    /// A response with errors of `load` and `friction` that are independent, so that the relative error of Q/P is their sum.
    pub fn new(load: Estimate, friction: Estimate, area: Estimate, temperature_max: Estimate) -> Self {
        let relative = |estimate: Estimate| match estimate.error {
            0.0 => 0.0,
            error => (error / estimate.value).abs(),
        };
        Self { load, friction, area, temperature_max, coefficient_error: relative(load) + relative(friction) }
    }
}

/// Whether a slip rate lies in a range, but for the rounding of a radius, by which the limits change in proportion.
pub fn covers((from, to): (f64, f64), slip_rate: f64) -> bool {
    /// In its logarithm the slip rate changes by as much, and friction by less than a thousandth of that of a decade.
    const ROUNDING: f64 = 1e-3;
    (from * (1.0 - ROUNDING)..=to * (1.0 + ROUNDING)).contains(&slip_rate)
}

/// What a table needs to cover a slip rate outside the range of another one; nothing where no factor says that.
fn wider(slip_rate: f64, from: f64, to: f64) -> String {
    let factor = |factor: f64| digits(factor * 1.005, 3);
    match slip_rate {
        rate if rate > to && to > 0.0 => {
            format!(": it needs a table whose highest slip rate is {} times as high", factor(rate / to))
        }
        rate if rate > 0.0 && rate < from => {
            format!(": it needs a table whose lowest slip rate is this one over {}", factor(from / rate))
        }
        _ => String::new(),
    }
}

/// Reason why a law has no response for a state.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LookupError {
    #[error(
        "interference {interference:.6} omega_c is above {limit:.6} omega_c, where the contact radius is {LARGEST_CONTACT} of that of the asperity and the model of a hemisphere ends"
    )]
    ContactTooLarge { interference: f64, limit: f64 },
    #[error(
        "slip rate {} m/s is outside the table, which covers {} to {} m/s at the radii asked; the limits are in proportion to 1/R{}",
        plain(*.slip_rate),
        plain(*.from),
        plain(*.to),
        wider(*.slip_rate, *.from, *.to)
    )]
    SlipRateOutside { slip_rate: f64, from: f64, to: f64 },
    #[error(
        "the table covers no slip rate at all radii from {} to {} m: its limits are in proportion to 1/R",
        plain(*.smallest),
        plain(*.largest)
    )]
    NoSlipRateInCommon { smallest: f64, largest: f64 },
    #[error(
        "the table depends on its radius of {} m, by the conductance of gap or contact; it cannot be read at {} m",
        plain(*.table),
        plain(*.asked)
    )]
    RadiusFixed { table: f64, asked: f64 },
    #[error("no result at interference {interference:.6} omega_c, slip rate {} m/s: {reason}", plain(*.slip_rate))]
    Missing { interference: f64, slip_rate: f64, reason: String },
}

/// What is taken above the range of a law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AboveRange {
    /// An extrapolation, with an error that grows.
    Extrapolated,
    /// Formulae beyond the range that they were made for, without an error.
    Formulae,
    /// Formulae of load and area; there is none of friction.
    NoFriction,
}

/// Response at a fixed radius and slip rate against interference (ω/ω_c) and slip (m).
pub type SlidingResponse<'a> = Box<dyn Fn(f64, f64) -> Result<Response, LookupError> + Send + Sync + 'a>;

/// An estimate, or none if the law does not state it.
pub type OptionalEstimate = Result<Option<Estimate>, LookupError>;

/// Load, friction and area of one asperity of given radius.
///
/// Interference is counted from first touch and given in units of the critical
/// interference ω_c of first yield under frictionless contact.
/// A law of one's own, an elastic sphere that slides at a constant shear stress:
///
/// ```
/// use tables::closed_forms::hertz::{contact_area, contact_modulus, critical_interference, hertz_load};
/// use tables::law::{AsperityLaw, Estimate, LookupError, Response};
///
/// struct Film;
///
/// impl AsperityLaw for Film {
///     fn name(&self) -> String {
///         "soft film on steel".into()
///     }
///     fn critical_interference(&self, radius: f64) -> f64 {
///         critical_interference(contact_modulus(205e9, 0.29), 0.29, 792e6, radius)
///     }
///     fn interference_limit(&self) -> f64 {
///         1.0
///     }
///     fn breaks(&self) -> Vec<f64> {
///         Vec::new()
///     }
///     fn slip_rate_range(&self, _radius: f64) -> (f64, f64) {
///         (0.0, f64::INFINITY)
///     }
///     fn response(&self, radius: f64, interference: f64, _rate: f64, _slip: f64) -> Result<Response, LookupError> {
///         let omega = interference * self.critical_interference(radius);
///         let exact = Estimate::exact;
///         let area = contact_area(radius, omega);
///         let load = exact(hertz_load(contact_modulus(205e9, 0.29), radius, omega));
///         Ok(Response::new(load, exact(50e6 * area), exact(area), exact(f64::NAN)))
///     }
/// }
///
/// let response = Film.response(1e-3, 0.5, 1.0, 1e-6)?;
/// assert!(response.friction.value < 0.1 * response.load.value);
/// # Ok::<(), LookupError>(())
/// ```
pub trait AsperityLaw: Send + Sync {
    /// Name to print.
    fn name(&self) -> String;
    /// The request that it was computed from, as TOML; empty for a formula.
    fn request(&self) -> &str {
        ""
    }
    /// ω_c in metres for a sphere of `radius` metres.
    fn critical_interference(&self, radius: f64) -> f64;
    /// E*, Pa, of asperity and flat at the initial temperature; none if the law does not state it.
    fn contact_modulus(&self) -> Option<f64> {
        None
    }
    /// Largest ω/ω_c of the range of the law: of the rows of a table, of the published formulae. Above it holds
    /// [`above_range`](AsperityLaw::above_range).
    fn interference_limit(&self) -> f64;
    /// Smallest ω/ω_c of the range of the law; less is taken as elastic.
    fn interference_start(&self) -> f64 {
        0.0
    }
    /// ω/ω_c at which the model ends, as the contact radius is [`LARGEST_CONTACT`] of that of the asperity.
    fn contact_limit(&self) -> f64 {
        f64::INFINITY
    }
    /// What is taken above [`interference_limit`](AsperityLaw::interference_limit).
    fn above_range(&self) -> AboveRange {
        AboveRange::Extrapolated
    }
    /// Values of ω/ω_c where the law or its derivatives have kinks: integrate between them.
    fn breaks(&self) -> Vec<f64>;
    /// Further such values for a sphere of `radius` (m) that has slid by `slip` (m): for example where
    /// its histories end.
    fn breaks_after(&self, _radius: f64, _slip: f64) -> Vec<f64> {
        Vec::new()
    }
    /// Largest relative uncertainty of the friction coefficient of a sphere of `radius` (m), as the law is for another one.
    fn radius_uncertainty(&self, _radius: f64) -> f64 {
        0.0
    }
    /// Range of slip rates (m/s) for a sphere of `radius` metres; 0 and infinity for rate-independent laws.
    fn slip_rate_range(&self, radius: f64) -> (f64, f64);
    /// Slip rates (m/s) that the law was computed at, for a sphere of `radius` metres; none of a formula.
    fn slip_rates(&self, _radius: f64) -> Vec<f64> {
        Vec::new()
    }
    /// Response of a sphere of `radius` (m) pressed by `interference` (ω/ω_c), after sliding
    /// by `slip` (m) at `slip_rate` (m/s).
    fn response(
        &self,
        radius: f64,
        interference: f64,
        slip_rate: f64,
        slip: f64,
    ) -> Result<Response, LookupError>;
    /// [`response`](AsperityLaw::response) for repeated evaluation at one radius and slip rate, for
    /// which a law can precompute data.
    fn at_slip_rate(&self, radius: f64, slip_rate: f64) -> Result<SlidingResponse<'_>, LookupError> {
        Ok(Box::new(move |interference, slip| self.response(radius, interference, slip_rate, slip)))
    }

    /// Slip at which a sphere of `radius` (m) pressed by `interference` (ω/ω_c) begins to slide, m; 0 if the law does not
    /// state it.
    fn inception_slip(&self, _radius: f64, _interference: f64) -> Result<Estimate, LookupError> {
        Ok(Estimate::default())
    }

    /// Whether a sphere begins to slide in the slide of the law. Otherwise the law ends in stick and does not know its static
    /// friction.
    fn begins_to_slide(
        &self,
        _radius: f64,
        _interference: f64,
        _slip_rate: f64,
    ) -> Result<bool, LookupError> {
        Ok(true)
    }

    /// Strength of a contact that slides at `slip_rate` (m/s) over that at rest, by the strain rate alone and not by heat.
    fn rate_factor(&self, _radius: f64, _interference: f64, _slip_rate: f64) -> Result<f64, LookupError> {
        Ok(1.0)
    }

    /// Largest slip of the histories of the law, over the contact radius after the press: later the last state holds.
    /// Infinite if the law holds at any slip.
    fn last_slip(&self) -> f64 {
        f64::INFINITY
    }

    /// Friction coefficient that the slide of one asperity tends to; none if the law does not state it.
    fn steady_friction(&self, _radius: f64, _interference: f64, _slip_rate: f64) -> OptionalEstimate {
        Ok(None)
    }

    /// Mean temperature of the contact at the end of the slide of the law, K; none if the law has no temperature.
    fn temperature_mean(&self, _radius: f64, _interference: f64, _slip_rate: f64) -> OptionalEstimate {
        Ok(None)
    }

    /// Energy that one asperity releases from full stick to full slip, J: work of the flat less
    /// the change of elastic energy, up to sliding inception; none if the law does not define it.
    fn energy_release(&self, _radius: f64, _interference: f64, _slip_rate: f64) -> OptionalEstimate {
        Ok(None)
    }
}
