//! The closed forms as laws that a rough surface can be built from.

use super::crossings::where_equal;
use super::partial_slip::{constant_shear, tangential_modulus};
use super::{brizmer, chang_etsion_bogy, hertz, jackson_green, kogut_etsion};
use crate::law::{AsperityLaw, Estimate, LookupError, Response};

/// Elastic–perfectly plastic body.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ElasticPlastic {
    /// E, Pa.
    pub youngs_modulus: f64,
    /// ν.
    pub poisson_ratio: f64,
    /// σ_Y, Pa.
    pub yield_strength: f64,
}

impl ElasticPlastic {
    /// E* = E/(1−ν²), Pa.
    pub fn contact_modulus(&self) -> f64 {
        hertz::contact_modulus(self.youngs_modulus, self.poisson_ratio)
    }

    /// G* = G/(2−ν), Pa.
    pub fn tangential_modulus(&self) -> f64 {
        tangential_modulus(self.youngs_modulus, self.poisson_ratio)
    }

    /// τ₀ = σ_Y/√3, Pa.
    pub fn shear_strength(&self) -> f64 {
        self.yield_strength / 3f64.sqrt()
    }

    /// e_y = σ_Y/E*.
    pub fn yield_strain(&self) -> f64 {
        self.yield_strength / self.contact_modulus()
    }

    /// ω_c in metres for a sphere of `radius` metres.
    pub fn critical_interference(&self, radius: f64) -> f64 {
        let e_star = self.contact_modulus();
        hertz::critical_interference(e_star, self.poisson_ratio, self.yield_strength, radius)
    }
}

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
    /// yield is a fit, and that of Brizmer et al. happens in full stick.
    fn units(self, poisson_ratio: f64) -> (f64, f64) {
        let (fit, interference, load) = match self {
            Self::Hertz | Self::KogutEtsion => return (1.0, 1.0),
            Self::JacksonGreen => (jackson_green::yield_coefficient(poisson_ratio), 1.0, 1.0),
            Self::ChangEtsionBogy => (chang_etsion_bogy::yield_coefficient(poisson_ratio), 1.0, 1.0),
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

/// Names that [`closed_form`] knows.
pub const NAMES: [&str; 7] =
    ["hertz", "constant-shear", "chang-etsion-bogy", "kogut-etsion", "jackson-green", "brizmer", "cohen"];

/// A name that is not in [`NAMES`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no closed form is called \"{name}\"; there are {}", NAMES.join(", "))]
pub struct UnknownClosedForm {
    pub name: String,
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
    /// Temperature of the isothermal contact, K, reported as `temperature_max`; 298 by default.
    pub temperature: f64,
}

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
/// with τ₀ = σ_Y/√3. None depends on the slip rate, none knows junction growth. The friction
/// force rises with slip as in elastic partial slip under a constant interfacial strength
/// ([`constant_shear`](super::partial_slip::constant_shear)), the strength being the final
/// force over the area. Errors are reported as zero: how far the fits are from the truth is not
/// known to them.
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
    /// As [`closed_form`], unboxed.
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
        Ok(Self {
            name,
            material: *material,
            normal,
            inception,
            critical_over_radius: material.critical_interference(1.0),
            units: normal.units(material.poisson_ratio),
            temperature: 298.0,
        })
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

impl ClosedForm {
    fn sliding(&self, radius: f64, interference: f64) -> Sliding {
        let e_star = self.material.contact_modulus();
        let omega = self.critical_interference(radius);
        let (load_ratio, area_ratio) = self.load_and_area(interference);
        let load = load_ratio * hertz::hertz_load(e_star, radius, omega);
        let area = area_ratio * hertz::contact_area(radius, omega);
        let strength = match self.inception {
            SlidingInception::ConstantShear => self.material.shear_strength(),
            SlidingInception::KogutEtsion => load * kogut_etsion::static_friction(interference) / area,
            SlidingInception::ChangEtsionBogy => {
                load * chang_etsion_bogy::static_friction(interference / self.units.0) / area
            }
            SlidingInception::Cohen => {
                load * brizmer::static_friction_of_interference(interference / self.units.0) / area
            }
            SlidingInception::Brizmer => load * brizmer::static_friction(load_ratio / self.units.1) / area,
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

    fn interference_limit(&self) -> f64 {
        f64::INFINITY
    }

    fn breaks(&self) -> Vec<f64> {
        match self.normal {
            NormalContact::Hertz => Vec::new(),
            NormalContact::JacksonGreen => vec![jackson_green::ELASTIC_LIMIT * self.units.0],
            NormalContact::ChangEtsionBogy => chang_etsion_bogy::BREAKS.map(|w| w * self.units.0).to_vec(),
            NormalContact::KogutEtsion => kogut_etsion::BREAKS.to_vec(),
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
        let mut response = Response { temperature_max: exact(self.temperature), ..Response::default() };
        if interference <= 0.0 {
            return Ok(response);
        }
        let sliding = self.sliding(radius, interference);
        let mobilised = if slip >= sliding.gross_slip {
            1.0
        } else {
            constant_shear::force_fraction(slip / sliding.gross_slip)
        };
        response.load = exact(sliding.load);
        response.area = exact(sliding.area);
        response.friction = exact(sliding.strength * sliding.area * mobilised);
        Ok(response)
    }

    /// The dissipation of elastic partial slip up to gross slip.
    fn energy_release(
        &self,
        radius: f64,
        interference: f64,
        _slip_rate: f64,
    ) -> Result<Option<Estimate>, LookupError> {
        if interference <= 0.0 {
            return Ok(Some(exact(0.0)));
        }
        let sliding = self.sliding(radius, interference);
        let (_, _, dissipated) = constant_shear::energies_at_gross_slip();
        let unit = sliding.strength * sliding.area * sliding.gross_slip;
        Ok(Some(exact(dissipated * unit)))
    }
}

fn exact(value: f64) -> Estimate {
    Estimate { value, error: 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEEL: ElasticPlastic =
        ElasticPlastic { youngs_modulus: 200e9, poisson_ratio: 0.3, yield_strength: 400e6 };

    fn sliding(name: &str, interference: f64) -> Response {
        let law = closed_form(name, &STEEL).unwrap();
        law.response(1e-4, interference, 1.0, 1e-3).unwrap()
    }

    fn friction_coefficient(name: &str, interference: f64) -> f64 {
        let state = sliding(name, interference);
        state.friction.value / state.load.value
    }

    #[test]
    fn constant_shear_friction_of_the_elastic_sphere() {
        for omega in [0.01, 0.3, 1.0] {
            let mu = friction_coefficient("hertz", omega);
            assert!((mu * omega.sqrt() - 0.5370).abs() < 1e-4, "{omega}: {mu}");
        }
    }

    #[test]
    fn constant_shear_friction_of_the_plastic_sphere() {
        for (omega, mu) in [(2.0, 0.397), (10.0, 0.275), (50.0, 0.228), (109.9, 0.208)] {
            let here = friction_coefficient("constant-shear", omega);
            assert!((here / mu - 1.0).abs() < 0.015, "{omega}: {here}");
        }
    }

    #[test]
    fn heat_aside_the_models_disagree_as_published() {
        // Once it has yielded, a sphere of Chang et al. carries no friction and one of Kogut &
        // Etsion little; full stick carries more than the shear strength of the body allows.
        let at = |name| friction_coefficient(name, 5.0);
        assert_eq!(at("chang-etsion-bogy"), 0.0);
        assert!(at("kogut-etsion") < 0.2 && at("constant-shear") > 0.28);
        assert!((at("cohen") / at("brizmer") - 1.0).abs() < 0.045);
        assert!(at("cohen") > at("constant-shear"));
        // In their own units of first yield the form of Cohen et al.: 0.26 coth(0.27 ω*^0.46).
        let law = ClosedForm::new("cohen", &STEEL).unwrap();
        let own: f64 = 5.0 / law.units.0;
        assert!((at("cohen") * (0.27 * own.powf(0.46)).tanh() / 0.26 - 1.0).abs() < 1e-12);
    }

    #[test]
    fn every_law_is_linear_elastic_at_small_interference_and_scales_with_radius() {
        for name in NAMES {
            let law = closed_form(name, &STEEL).unwrap();
            let small = law.response(1e-4, 1e-3, 1.0, 1e-3).unwrap();
            let omega = 1e-3 * law.critical_interference(1e-4);
            let hertz = hertz::hertz_load(STEEL.contact_modulus(), 1e-4, omega);
            assert!((small.load.value / hertz - 1.0).abs() < 0.03, "{name}");

            let slip = 3e-10;
            let one = law.response(1e-4, 8.0, 1.0, slip).unwrap();
            let ten = law.response(1e-3, 8.0, 1.0, 10.0 * slip).unwrap();
            for (a, b) in [(one.load, ten.load), (one.friction, ten.friction), (one.area, ten.area)] {
                assert!((100.0 * a.value - b.value).abs() <= 1e-9 * b.value, "{name}");
            }
        }
    }

    #[test]
    fn friction_rises_with_slip_from_zero_with_the_stick_stiffness() {
        let law = closed_form("jackson-green", &STEEL).unwrap();
        let slip = 1e-13;
        let state = law.response(1e-4, 5.0, 0.0, slip).unwrap();
        let contact_radius = (state.area.value / std::f64::consts::PI).sqrt();
        let stiffness = 8.0 * STEEL.tangential_modulus() * contact_radius;
        assert!((state.friction.value / (slip * stiffness) - 1.0).abs() < 1e-4);
        let rest = law.response(1e-4, 5.0, 0.0, 0.0).unwrap();
        assert_eq!(rest.friction.value, 0.0);
    }

    #[test]
    fn gross_slip_is_a_break() {
        for name in NAMES {
            let law = ClosedForm::new(name, &STEEL).unwrap();
            for interference in [0.02, 0.7, 30.0] {
                let sliding = law.sliding(1e-4, interference);
                if sliding.strength == 0.0 {
                    continue;
                }
                let breaks = law.breaks_after(1e-4, sliding.gross_slip);
                assert!(
                    breaks.iter().any(|place| (place / interference - 1.0).abs() < 1e-6),
                    "{name} at {interference}: {breaks:?}"
                );
            }
        }
    }

    #[test]
    fn nothing_without_contact() {
        for name in NAMES {
            let law = closed_form(name, &STEEL).unwrap();
            let state = law.response(1e-4, 0.0, 1.0, 0.0).unwrap();
            assert_eq!((state.load.value, state.area.value), (0.0, 0.0));
        }
    }

    #[test]
    fn unknown_name_lists_the_known_ones() {
        let message = ClosedForm::new("herz", &STEEL).unwrap_err().to_string();
        assert!(message.contains("\"herz\"") && message.contains("kogut-etsion, jackson-green"));
    }
}
