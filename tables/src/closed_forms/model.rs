//! The closed forms as laws that a rough surface can be built from.

use super::crossings::where_equal;
use super::partial_slip::constant_shear;
use super::{ElasticPlastic, brizmer, chang_etsion_bogy, hertz, jackson_green, kogut_etsion};
use crate::functions::bisect;
use crate::law::{
    AboveRange, AsperityLaw, Estimate, LARGEST_CONTACT, LookupError, OptionalEstimate, Response,
};

/// Load and area against interference.
#[derive(Clone, Copy, Debug, PartialEq)]
enum NormalContact {
    Hertz,
    JacksonGreen,
    ChangEtsionBogy,
    KogutEtsion,
    Brizmer,
}

impl NormalContact {
    /// Interference, in ω_c, and load, in P_c, by which the authors divide theirs: their first
    /// yield is a fit, and that of Brizmer et al. is in full stick.
    fn units(self, poisson_ratio: f64) -> (f64, f64) {
        let (fit, interference, load) = match self {
            Self::Hertz => return (1.0, 1.0),
            Self::JacksonGreen => (jackson_green::yield_coefficient(poisson_ratio), 1.0, 1.0),
            Self::ChangEtsionBogy | Self::KogutEtsion => {
                (chang_etsion_bogy::yield_coefficient(poisson_ratio), 1.0, 1.0)
            }
            Self::Brizmer => (
                brizmer::slip_yield_coefficient(poisson_ratio),
                brizmer::critical_interference_ratio(poisson_ratio),
                brizmer::critical_load_ratio(poisson_ratio),
            ),
        };
        let ratio = fit / hertz::yield_coefficient(poisson_ratio);
        (interference * ratio.powi(2), load * ratio.powi(3))
    }
}

/// Largest friction force of a pressed asperity.
#[derive(Clone, Copy, Debug, PartialEq)]
enum SlidingInception {
    /// Q = τ₀A.
    ConstantShear,
    /// Chang, Etsion & Bogy 1988.
    ChangEtsionBogy,
    /// Kogut & Etsion 2003.
    KogutEtsion,
    /// Brizmer, Kligerman & Etsion 2007.
    Brizmer,
    /// Cohen, Kligerman & Etsion 2008.
    Cohen,
}

/// Names of the closed forms.
pub const NAMES: [&str; 7] =
    ["hertz", "constant-shear", "chang-etsion-bogy", "kogut-etsion", "jackson-green", "brizmer", "cohen"];

/// A name that is not in [`NAMES`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no closed form is called \"{name}\"; there are {}", NAMES.join(", "))]
pub struct UnknownClosedForm {
    pub name: String,
}

/// Steps of the search for gross slip from break to break.
const SCANNED: usize = 8;

/// A sphere in gross slip.
struct Sliding {
    /// P, N.
    load: f64,
    /// A, m².
    area: f64,
    /// Q/A, Pa.
    strength: f64,
    /// Slip at which the last point slips, m.
    gross_slip: f64,
}

/// A closed form of the literature as a law of one asperity; see [`closed_form`].
#[derive(Clone, Debug, PartialEq)]
pub struct ClosedForm {
    name: &'static str,
    material: ElasticPlastic,
    normal: NormalContact,
    inception: SlidingInception,
    /// ω_c/R.
    critical_over_radius: f64,
    /// Interference, in ω_c, and load, in P_c, by which the authors divide theirs.
    units: (f64, f64),
    /// ω/ω_c at which the contact is [`LARGEST_CONTACT`].
    contact_limit: f64,
}

/// Temperature of the isothermal contact, K.
const TEMPERATURE: f64 = 298.0;

/// The closed form called `name`, for a sphere of `material`:
///
/// | name | load and area | friction force |
/// |---|---|---|
/// | `hertz` | Hertz | τ₀A |
/// | `jackson-green` | Jackson & Green 2005 | τ₀A |
/// | `constant-shear` | Kogut & Etsion 2002 | τ₀A |
/// | `chang-etsion-bogy` | Chang, Etsion & Bogy 1987 | Chang, Etsion & Bogy 1988 (ν = 0.3) |
/// | `kogut-etsion` | Kogut & Etsion 2002 | Kogut & Etsion 2003 |
/// | `brizmer` | Brizmer et al. 2006, full stick | Brizmer et al. 2007 |
/// | `cohen` | Brizmer et al. 2006, full stick | Cohen et al. 2008 |
///
/// `hertz` and `chang-etsion-bogy` end at first yield, the friction of `kogut-etsion` at 6 ω_c, the fits of `brizmer` and
/// `cohen` at 150 ω_c, in the units of the authors; with τ₀ = σ_Y/√3. None depends on the slip rate or includes junction growth. The friction
/// force rises with slip as in elastic partial slip under a constant interfacial strength
/// ([`constant_shear`](super::partial_slip::constant_shear)), the strength being the final
/// force over the area. Errors are reported as zero: the errors of the fits are not published.
///
/// ```
/// use tables::closed_forms::{ElasticPlastic, closed_form};
///
/// let steel = ElasticPlastic { youngs_modulus: 205e9, poisson_ratio: 0.29, yield_strength: 792e6 };
/// let law = closed_form("jackson-green", &steel)?;
/// // 20 ω_c of a sphere of 1 mm, after 10 µm of slip at any slip rate.
/// let response = law.response(1e-3, 20.0, 0.0, 10e-6)?;
/// let mu = response.friction.value / response.load.value;
/// assert!(mu > 0.2 && mu < 0.3, "{mu}");
/// assert!(closed_form("herz", &steel).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn closed_form(name: &str, material: &ElasticPlastic) -> Result<Box<dyn AsperityLaw>, UnknownClosedForm> {
    ClosedForm::new(name, material).map(|law| Box::new(law) as Box<dyn AsperityLaw>)
}

impl ClosedForm {
    /// The closed form of that name with the constants of `material`.
    pub fn new(name: &str, material: &ElasticPlastic) -> Result<Self, UnknownClosedForm> {
        let unknown = || UnknownClosedForm { name: name.to_string() };
        let name = *NAMES.iter().find(|n| **n == name).ok_or_else(unknown)?;
        let (normal, inception) = match name {
            "hertz" => (NormalContact::Hertz, SlidingInception::ConstantShear),
            "constant-shear" => (NormalContact::KogutEtsion, SlidingInception::ConstantShear),
            "chang-etsion-bogy" => (NormalContact::ChangEtsionBogy, SlidingInception::ChangEtsionBogy),
            "cohen" => (NormalContact::Brizmer, SlidingInception::Cohen),
            "kogut-etsion" => (NormalContact::KogutEtsion, SlidingInception::KogutEtsion),
            "jackson-green" => (NormalContact::JacksonGreen, SlidingInception::ConstantShear),
            _ => (NormalContact::Brizmer, SlidingInception::Brizmer),
        };
        let mut law = Self {
            name,
            material: *material,
            normal,
            inception,
            critical_over_radius: material.critical_interference(1.0),
            units: normal.units(material.poisson_ratio),
            contact_limit: f64::INFINITY,
        };
        law.contact_limit = law.largest_interference();
        Ok(law)
    }

    /// ω/ω_c at which A = π (0.4 R)².
    fn largest_interference(&self) -> f64 {
        let [largest, _] = bisect([f64::MIN_POSITIVE, f64::MAX].map(f64::ln), 64, |logarithm| {
            let (_, area) = self.load_and_area(logarithm.exp());
            // A_c = π R ω_c.
            area * self.critical_over_radius < LARGEST_CONTACT.powi(2)
        });
        largest.exp()
    }

    /// (P/P_c, A/A_c) at ω/ω_c, with P_c and A_c of first yield without friction.
    fn load_and_area(&self, interference: f64) -> (f64, f64) {
        let (nu, strain) = (self.material.poisson_ratio, self.material.yield_strain());
        let (unit, load_unit) = self.units;
        let scaled = interference / unit;
        let (load, area) = match self.normal {
            NormalContact::Hertz => (scaled.powf(1.5), scaled),
            NormalContact::JacksonGreen => {
                (jackson_green::load(scaled, strain, nu), jackson_green::area(scaled, strain))
            }
            NormalContact::ChangEtsionBogy => {
                (chang_etsion_bogy::load(scaled), chang_etsion_bogy::area(scaled))
            }
            NormalContact::KogutEtsion => (kogut_etsion::load(scaled, nu), kogut_etsion::area(scaled)),
            NormalContact::Brizmer => (brizmer::load(scaled, nu), brizmer::area(scaled, nu)),
        };
        (load * load_unit, area * unit)
    }

    fn sliding(&self, radius: f64, interference: f64) -> Sliding {
        let e_star = self.material.contact_modulus();
        let omega = self.critical_interference(radius);
        let (load_ratio, area_ratio) = self.load_and_area(interference);
        let load = load_ratio * hertz::hertz_load(e_star, radius, omega);
        let area = area_ratio * hertz::contact_area(radius, omega);
        let of_friction = |mu: f64| load * mu / area;
        let scaled = interference / self.units.0;
        let strength = match self.inception {
            SlidingInception::ConstantShear => self.material.shear_strength(),
            SlidingInception::KogutEtsion => of_friction(kogut_etsion::static_friction(scaled)),
            SlidingInception::ChangEtsionBogy => of_friction(chang_etsion_bogy::static_friction(scaled)),
            SlidingInception::Cohen => of_friction(brizmer::static_friction_of_interference(scaled)),
            SlidingInception::Brizmer => of_friction(brizmer::static_friction(load_ratio / self.units.1)),
        };
        let gross_slip = constant_shear::gross_slip_displacement(
            strength,
            self.material.tangential_modulus(),
            (area / std::f64::consts::PI).sqrt(),
        );
        Sliding { load, area, strength, gross_slip }
    }
}

impl AsperityLaw for ClosedForm {
    fn name(&self) -> String {
        self.name.to_string()
    }

    fn critical_interference(&self, radius: f64) -> f64 {
        self.critical_over_radius * radius
    }

    fn contact_modulus(&self) -> Option<f64> {
        Some(self.material.contact_modulus())
    }

    fn interference_limit(&self) -> f64 {
        let unit = self.units.0;
        let published: f64 = match (self.normal, self.inception) {
            (NormalContact::Hertz, _) | (_, SlidingInception::ChangEtsionBogy) => unit,
            (_, SlidingInception::KogutEtsion) => kogut_etsion::FRICTION_LIMIT * unit,
            (NormalContact::Brizmer, _) => brizmer::LARGEST_INTERFERENCE * unit,
            _ => f64::INFINITY,
        };
        published.min(self.contact_limit)
    }

    fn contact_limit(&self) -> f64 {
        self.contact_limit
    }

    fn above_range(&self) -> AboveRange {
        match self.inception {
            SlidingInception::KogutEtsion => AboveRange::NoFriction,
            _ => AboveRange::Formulae,
        }
    }

    fn breaks(&self) -> Vec<f64> {
        match self.normal {
            NormalContact::Hertz => Vec::new(),
            NormalContact::JacksonGreen => vec![jackson_green::ELASTIC_LIMIT * self.units.0],
            NormalContact::ChangEtsionBogy => chang_etsion_bogy::BREAKS.map(|w| w * self.units.0).to_vec(),
            NormalContact::KogutEtsion => kogut_etsion::BREAKS.map(|w| w * self.units.0).to_vec(),
            NormalContact::Brizmer => vec![self.units.0],
        }
    }

    /// Where the slip is that of gross slip: on one side the contact still sticks in part.
    fn breaks_after(&self, radius: f64, slip: f64) -> Vec<f64> {
        // Under a constant strength gross slip grows with the contact; where friction falls with
        // interference it need not.
        let steps = if self.inception == SlidingInception::ConstantShear { 1 } else { SCANNED };
        let gross_slip = |interference: f64| self.sliding(radius, interference).gross_slip;
        where_equal(gross_slip, slip, &self.breaks(), steps)
    }

    fn slip_rate_range(&self, _radius: f64) -> (f64, f64) {
        (0.0, f64::INFINITY)
    }

    fn response(
        &self,
        radius: f64,
        interference: f64,
        _slip_rate: f64,
        slip: f64,
    ) -> Result<Response, LookupError> {
        let mut response = Response { temperature_max: Estimate::exact(TEMPERATURE), ..Response::default() };
        if interference <= 0.0 {
            return Ok(response);
        }
        let sliding = self.sliding(radius, interference);
        let mobilised = if slip >= sliding.gross_slip {
            1.0
        } else {
            constant_shear::force_fraction(slip / sliding.gross_slip)
        };
        response.load = Estimate::exact(sliding.load);
        response.area = Estimate::exact(sliding.area);
        response.friction = Estimate::exact(sliding.strength * sliding.area * mobilised);
        Ok(response)
    }

    /// The dissipation of elastic partial slip up to gross slip.
    fn energy_release(&self, radius: f64, interference: f64, _slip_rate: f64) -> OptionalEstimate {
        if interference <= 0.0 {
            return Ok(Some(Estimate::exact(0.0)));
        }
        let sliding = self.sliding(radius, interference);
        let (_, _, dissipated) = constant_shear::energies_at_gross_slip();
        let unit = sliding.strength * sliding.area * sliding.gross_slip;
        Ok(Some(Estimate::exact(dissipated * unit)))
    }
}

#[cfg(test)]
mod tests;
