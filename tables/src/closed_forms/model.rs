//! The closed forms as laws that a rough surface can be built from.

use super::crossings::where_equal;
use super::partial_slip::constant_shear;
use super::{ElasticPlastic, brizmer, chang_etsion_bogy, hertz, jackson_green, kogut_etsion};
use crate::functions::bisect;
use crate::law::{
    AboveRange, AsperityLaw, Estimate, LARGEST_CONTACT, LookupError, OptionalEstimate, Response,
};

/// A model of the literature: functions of interference, load and area in the units of the authors.
#[derive(Debug)]
struct Model {
    name: &'static str,
    description: &'static str,
    /// p₀/σ_Y of first yield without friction, of ν: a fit of the authors.
    yield_coefficient: fn(f64) -> f64,
    /// Interference and load of first yield of the authors over those without friction, of ν.
    units: fn(f64) -> (f64, f64),
    /// Of interference, ν and e_y.
    load_and_area: fn(f64, f64, f64) -> (f64, f64),
    /// Interferences at which pieces meet.
    breaks: &'static [f64],
    /// Largest Q/P, of interference and load; none where Q = τ₀A.
    static_friction: Option<fn(f64, f64) -> f64>,
    /// Interference at which the formulae end.
    limit: f64,
    above_range: AboveRange,
}

const HERTZ: Model = Model {
    name: "hertz",
    description: "elastic (Greenwood & Williamson), constant shear strength",
    yield_coefficient: hertz::yield_coefficient,
    units: |_| (1.0, 1.0),
    load_and_area: |w, _, _| (w.powf(1.5), w),
    breaks: &[],
    static_friction: None,
    limit: 1.0,
    above_range: AboveRange::Formulae,
};
const CONSTANT_SHEAR: Model = Model {
    name: "constant-shear",
    description: "elastic-plastic, constant shear strength",
    yield_coefficient: chang_etsion_bogy::yield_coefficient,
    load_and_area: |w, nu, _| (kogut_etsion::load(w, nu), kogut_etsion::area(w)),
    breaks: &kogut_etsion::BREAKS,
    limit: f64::INFINITY,
    ..HERTZ
};
const CHANG_ETSION_BOGY: Model = Model {
    name: "chang-etsion-bogy",
    description: "elastic-plastic, no friction after yield",
    yield_coefficient: chang_etsion_bogy::yield_coefficient,
    load_and_area: |w, _, _| (chang_etsion_bogy::load(w), chang_etsion_bogy::area(w)),
    breaks: &chang_etsion_bogy::BREAKS,
    static_friction: Some(|w, _| chang_etsion_bogy::static_friction(w)),
    ..HERTZ
};
const KOGUT_ETSION: Model = Model {
    name: "kogut-etsion",
    description: "elastic-plastic, no formula of friction above 6 omega_c",
    static_friction: Some(|w, _| kogut_etsion::static_friction(w)),
    limit: kogut_etsion::FRICTION_LIMIT,
    above_range: AboveRange::NoFriction,
    ..CONSTANT_SHEAR
};
const JACKSON_GREEN: Model = Model {
    name: "jackson-green",
    description: "elastic-plastic with falling hardness, constant shear strength",
    yield_coefficient: jackson_green::yield_coefficient,
    load_and_area: |w, nu, strain| (jackson_green::load(w, strain, nu), jackson_green::area(w, strain)),
    breaks: &[jackson_green::ELASTIC_LIMIT],
    limit: f64::INFINITY,
    ..HERTZ
};
const BRIZMER: Model = Model {
    name: "brizmer",
    description: "full stick, friction by load",
    yield_coefficient: brizmer::slip_yield_coefficient,
    units: |nu| (brizmer::critical_interference_ratio(nu), brizmer::critical_load_ratio(nu)),
    load_and_area: |w, nu, _| (brizmer::load(w, nu), brizmer::area(w, nu)),
    breaks: &[1.0],
    static_friction: Some(|_, load| brizmer::static_friction(load)),
    limit: brizmer::LARGEST_INTERFERENCE,
    ..HERTZ
};
const COHEN: Model = Model {
    name: "cohen",
    description: "full stick, friction by interference",
    static_friction: Some(|w, _| brizmer::static_friction_of_interference(w)),
    ..BRIZMER
};

static MODELS: [Model; 7] =
    [HERTZ, CONSTANT_SHEAR, CHANG_ETSION_BOGY, KOGUT_ETSION, JACKSON_GREEN, BRIZMER, COHEN];

/// Names of the closed forms.
pub const NAMES: [&str; 7] = [
    HERTZ.name,
    CONSTANT_SHEAR.name,
    CHANG_ETSION_BOGY.name,
    KOGUT_ETSION.name,
    JACKSON_GREEN.name,
    BRIZMER.name,
    COHEN.name,
];

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
#[derive(Clone, Debug)]
pub struct ClosedForm {
    model: &'static Model,
    material: ElasticPlastic,
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
        let model = MODELS.iter().find(|model| model.name == name).ok_or_else(unknown)?;
        let nu = material.poisson_ratio;
        let ratio = (model.yield_coefficient)(nu) / hertz::yield_coefficient(nu);
        let (interference, load) = (model.units)(nu);
        let mut law = Self {
            model,
            material: *material,
            critical_over_radius: material.critical_interference(1.0),
            units: (interference * ratio.powi(2), load * ratio.powi(3)),
            contact_limit: f64::INFINITY,
        };
        law.contact_limit = law.largest_interference();
        Ok(law)
    }

    /// The model in words.
    pub fn description(&self) -> &'static str {
        self.model.description
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
        let (load, area) = (self.model.load_and_area)(interference / unit, nu, strain);
        (load * load_unit, area * unit)
    }

    fn sliding(&self, radius: f64, interference: f64) -> Sliding {
        let e_star = self.material.contact_modulus();
        let omega = self.critical_interference(radius);
        let (load_ratio, area_ratio) = self.load_and_area(interference);
        let load = load_ratio * hertz::hertz_load(e_star, radius, omega);
        let area = area_ratio * hertz::contact_area(radius, omega);
        let (unit, load_unit) = self.units;
        let strength = match self.model.static_friction {
            Some(coefficient) => load * coefficient(interference / unit, load_ratio / load_unit) / area,
            None => self.material.shear_strength(),
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
        self.model.name.to_string()
    }

    fn critical_interference(&self, radius: f64) -> f64 {
        self.critical_over_radius * radius
    }

    fn contact_modulus(&self) -> Option<f64> {
        Some(self.material.contact_modulus())
    }

    fn interference_limit(&self) -> f64 {
        (self.model.limit * self.units.0).min(self.contact_limit)
    }

    fn contact_limit(&self) -> f64 {
        self.contact_limit
    }

    fn above_range(&self) -> AboveRange {
        self.model.above_range
    }

    fn breaks(&self) -> Vec<f64> {
        self.model.breaks.iter().map(|interference| interference * self.units.0).collect()
    }

    /// Where the slip is that of gross slip: on one side the contact still sticks in part.
    fn breaks_after(&self, radius: f64, slip: f64) -> Vec<f64> {
        // Under a constant strength gross slip grows with the contact; where friction falls with
        // interference it need not.
        let steps = if self.model.static_friction.is_none() { 1 } else { SCANNED };
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
