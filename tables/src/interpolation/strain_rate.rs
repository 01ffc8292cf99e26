//! Tables with a rate law at other radii than their own.
//!
//! A table is read at the same VR, so that the heat is that of the table but the strain rate V/a is (R_t/R)² times that of
//! the table. The strength of interface and body in the slide follows it as Λ = 1 + C ln(V/(aε̇₀)); the press is quasi-static.
//! A quantity is taken to follow a power of the strength, x(R) = x_t (Λ(R)/Λ(R_t))ⁿ.
//!
//! - Fitted: mean of n and twice its standard deviation, at 0.7 and at 125 ω_c; linear in ln ω between them, constant beyond.
//! - Data: cells at 0.7, 16 and 125 ω_c, radii of 0.01 and 1 mm, VR of 10⁻⁵, 1.6·10⁻⁴ and 10⁻³ m²/s, of five metals (C of
//!   0.012 to 0.07), against the shipped tables of 0.1 mm: 30 values of n at each interference.
//! - Residual: of 108 cells, those of a sixth metal (C = 0.002) included, 94 to 100 % of each quantity lie within the errors.
//! - Repeated by: `asperity tabulate`, with the requests of `tables/data/*-rate.toml` at another radius.
//!
//! Where the contact forms within the time of a slip (`press_slip_distance`), the strength of the press changes as that of the
//! slide does, and the contact is [similar](Similarity) to one of the table.
//!
//! - Data: tables of 4340, copper and 304 (C of 0.014 to 0.07) at 0.1 mm with `press_slip_distance = 1`, against cells at 2, 20 and
//!   100 ω_c, 0.01 and 1 mm, VR of 10⁻⁵, 10⁻⁴ and 5·10⁻⁴ m²/s.
//! - Residual: of the 54 cells all values of P, A, Q_static, mu_static, slip at inception, G and temperature lie within the errors.

use super::InterpolatedTable;
use super::interpolant::Interpolant;
use crate::law::AsperityLaw;
use crate::quantity::{ElasticLimit, Quantity};

/// Change of the strength from that of the table, at an interference and a slip rate.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct StrengthChange {
    /// ln(Λ(R)/Λ(R_t)).
    known: f64,
    /// Relative uncertainty of the strength above the last row, where a is extrapolated in proportion to √ω.
    extrapolated: f64,
    log_interference: f64,
    /// a₀ at the radius of the table, m.
    contact_radius: f64,
    /// Whether the limit of the shear traction is the strength of the metal, as in the data.
    is_of_metal: bool,
}

/// Factor of a value, and what it adds to the relative error of the product.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RateEffect {
    pub(super) factor: f64,
    pub(super) error: f64,
}

/// A contact at R = `ratio`·R_t with Λ(R)/Λ(R_t) times the strength of the table, in press and slide. In units of strength and
/// modulus it is that of the table at the interference over ω_c of the higher strength.
#[derive(Clone, Copy, Debug)]
pub(super) struct Similarity {
    ratio: f64,
    /// Λ(R)/Λ(R_t); 1 where the press is quasi-static.
    strength: f64,
    /// Relative error where parts of the body flow at less than the reference rate, and where the limit of the shear traction is not
    /// the strength of the metal.
    dissimilar: f64,
}

impl Similarity {
    /// p of the factor (Λ(R)/Λ(R_t))ᵖ of the slip rate at which the contact of the table is as hot: at low Péclet numbers the
    /// rise follows τVa, with a contact radius in proportion to Λ.
    const HEAT: f64 = 2.0;
    /// Relative error over ln(Λ(R)/Λ(R_t)) of sliding friction, and of the others. Interface and body flow at different rates,
    /// and their factors do not change in the same ratio.
    const ERRORS: [f64; 2] = [0.6, 0.3];
    /// V/(aε̇₀) below which parts of the body flow at less than the reference rate, where Λ ends.
    const SLOW: f64 = 3e3;

    /// ω/ω_c in the table.
    pub(super) fn interference(self, interference: f64) -> f64 {
        interference / self.strength.powi(2)
    }

    /// V in the table, m/s.
    pub(super) fn slip_rate(self, slip_rate: f64) -> f64 {
        slip_rate * self.ratio * self.strength.powf(Self::HEAT)
    }

    /// Slip in the table, m.
    pub(super) fn slip(self, slip: f64) -> f64 {
        slip.max(0.0) / (self.ratio * self.strength)
    }

    /// Relative error that the change of the strength adds.
    pub(super) fn error(self, limit: ElasticLimit) -> f64 {
        let [of_sliding, of_others] = Self::ERRORS;
        let share = match limit {
            ElasticLimit::SlidingFriction | ElasticLimit::SlidingCoefficient => of_sliding,
            _ => of_others,
        };
        share * self.strength.ln().abs() + self.dissimilar
    }

    /// Factor of a quantity by its exponents of radius and strength.
    pub(super) fn scale(self, quantity: Quantity) -> f64 {
        let descriptor = quantity.descriptor();
        self.ratio.powi(descriptor.radius_exponent) * self.strength.powi(descriptor.material_exponents.0)
    }
}

/// s/a₀ at which contacts slide, within the range of the slips at inception.
const SLIDING: f64 = 0.05;

/// ω/ω_c of the exponents of a light and a deep contact.
const INTERFERENCES: [f64; 2] = [0.7, 125.0];

/// n of a light and a deep contact: mean and half-width of the 95 % interval. A result of the press has none.
fn exponents(limit: ElasticLimit) -> Option<[(f64, f64); 2]> {
    Some(match limit {
        ElasticLimit::None | ElasticLimit::FirstRow => return None,
        ElasticLimit::LoadPress | ElasticLimit::AreaPress | ElasticLimit::ContactRadius => return None,
        ElasticLimit::Load => [(0.1, 0.35), (0.55, 0.95)],
        ElasticLimit::Area => [(-0.1, 0.45), (-0.1, 0.45)],
        ElasticLimit::SlidingFriction => [(0.9, 0.45), (0.8, 0.45)],
        ElasticLimit::StaticFriction => [(1.0, 0.1), (0.95, 0.2)],
        ElasticLimit::SlidingCoefficient => [(0.8, 0.65), (0.3, 1.4)],
        ElasticLimit::StaticCoefficient => [(1.0, 0.4), (0.6, 0.9)],
        ElasticLimit::InceptionSlip => [(0.95, 0.1), (-0.35, 1.45)],
        ElasticLimit::EnergyRelease => [(1.65, 0.35), (-3.6, 4.7)],
        ElasticLimit::Weakening => [(4.0, 20.0), (4.0, 20.0)],
        ElasticLimit::TemperatureRise => [(0.9, 0.3), (0.85, 0.35)],
    })
}

impl StrengthChange {
    /// That which has taken effect after a slip (m, at the radius of the table): none in the press, which is quasi-static, and all once
    /// the contact slides.
    pub(super) fn after(self, slip: f64) -> Self {
        let share = slip / (SLIDING * self.contact_radius);
        Self { known: self.known * if share < 1.0 { share } else { 1.0 }, ..self }
    }

    /// Effect on a quantity of the slide.
    pub(super) fn of(&self, limit: ElasticLimit) -> RateEffect {
        let Some([light, deep]) = exponents(limit) else { return RateEffect { factor: 1.0, error: 0.0 } };
        let [from, to] = INTERFERENCES.map(f64::ln);
        let t = ((self.log_interference - from) / (to - from)).clamp(0.0, 1.0);
        let at = |(light, deep): (f64, f64)| light + t * (deep - light);
        let (mean, half_width) = (at((light.0, deep.0)), at((light.1, deep.1)));
        // Other interfaces do not follow the strength of the metal, or less: from no effect to the whole one.
        let (mean, half_width) =
            if self.is_of_metal { (mean, half_width) } else { (0.0, mean.abs() + half_width) };
        let error = half_width * self.known.abs() + (mean.abs() + half_width) * self.extrapolated;
        RateEffect { factor: (mean * self.known).exp(), error }
    }
}

impl InterpolatedTable {
    /// Whether the strength of the metal alone limits the shear traction.
    fn slides_at_strength_of_metal(&self) -> bool {
        let metadata = self.metadata();
        metadata.strength_factor.is_some() && metadata.film_strength.is_none()
    }

    /// The contact of the table to which one at R = `ratio`·R_t and a slip rate (m/s) is similar. The ratio of the strengths hardly
    /// depends on the interference.
    pub(super) fn similarity(&self, slip_rate: f64, ratio: f64) -> Similarity {
        let metadata = self.metadata();
        let law = metadata.press_slip_distance.and(metadata.rate_coefficient.zip(metadata.rate_reference));
        let Some((coefficient, reference)) = law.filter(|_| ratio != 1.0) else {
            return Similarity { ratio, strength: 1.0, dissimilar: 0.0 };
        };
        let sphere = &self.interpolant.sphere;
        let contact = sphere.contact_radius((self.interference_start() * self.interference_limit()).sqrt());
        let of_table = sphere.rate_factor(slip_rate * ratio, contact);
        let strength = sphere.rate_factor(slip_rate, contact * ratio) / of_table;
        let slower = slip_rate / contact * ratio.min(1.0 / ratio);
        let slow = coefficient * (Similarity::SLOW * reference / slower).max(1.0).ln();
        let of_interface = if self.slides_at_strength_of_metal() { 0.0 } else { strength.ln().abs() };
        Similarity { ratio, strength, dissimilar: slow + of_interface }
    }

    /// Change of the strength at R = `ratio`·R_t; `slip_rate` is that of the table at the same VR (m/s).
    pub(super) fn strength_change(&self, interference: f64, slip_rate: f64, ratio: f64) -> StrengthChange {
        let metadata = self.metadata();
        let (Some(coefficient), Some(rows)) = (metadata.rate_coefficient, self.interpolant.rows) else {
            return StrengthChange::default();
        };
        let is_similar = metadata.press_slip_distance.is_some();
        if interference <= 0.0 || (ratio == 1.0 && interference <= self.interference_limit()) {
            return StrengthChange::default();
        }
        let Interpolant { sphere, .. } = &self.interpolant;
        let place = self.interpolant.row_position(rows, interference.ln());
        let contact_radius = self.interpolant.contact_radius(rows, &place);
        let of_table = sphere.rate_factor(slip_rate, contact_radius);
        let here = sphere.rate_factor(slip_rate / ratio, contact_radius * ratio);
        let above = (interference / self.interference_limit()).max(1.0).ln();
        StrengthChange {
            known: if is_similar { 0.0 } else { (here / of_table).ln() },
            extrapolated: 0.5 * coefficient / here * above,
            log_interference: interference.ln(),
            contact_radius,
            is_of_metal: self.slides_at_strength_of_metal(),
        }
    }
}
