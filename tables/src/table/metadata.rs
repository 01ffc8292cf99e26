//! Origin and constants of a table.

use std::collections::BTreeMap;

use super::FractureEnergy;
use crate::closed_forms::ElasticPlastic;
use crate::closed_forms::shear_limit::ShearLimit;

/// Origin and constants of a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Metadata {
    /// Title of the table.
    pub title: String,
    /// One line per command that made or changed the table.
    pub history: String,
    /// Program and version.
    pub source: String,
    /// Fingerprint of the program that made the table: programs with equal ones give equal numbers. May be empty.
    pub fingerprint: String,
    /// `K/N` where the table is one of N parts of the request; empty for a whole one.
    pub shard: String,
    /// Limitations of the results; may be empty.
    pub comment: String,
    /// The request as TOML.
    pub scene: String,
    /// R_t, m: the radius that the values are for.
    pub asperity_radius: f64,
    /// ω_c at that radius, m.
    pub critical_interference: f64,
    /// E* at the initial temperature, Pa: E/(1−ν²), or that of both bodies.
    pub contact_modulus: f64,
    /// ν.
    pub poisson_ratio: f64,
    /// σ_Y at the initial temperature, Pa.
    pub yield_strength: f64,
    /// f_τ; none where the strength of the material does not limit the shear traction.
    pub strength_factor: Option<f64>,
    /// τ₀ of a film at the initial temperature, Pa, 0 of Coulomb's law; none of other laws.
    pub film_strength: Option<f64>,
    /// α of a film, or the coefficient of Coulomb's law.
    pub pressure_coefficient: Option<f64>,
    /// C of the growth 1 + C ln(ε̇/ε̇₀) of the strength with the strain rate; none without. Results at another radius
    /// are then uncertain by it.
    pub rate_coefficient: Option<f64>,
    /// ε̇₀, 1/s.
    pub rate_reference: Option<f64>,
    /// Slip in contact radii in whose time the contact forms; none where the press is quasi-static.
    pub press_slip_distance: Option<f64>,
    /// Initial temperature of body and flat, K.
    pub temperature: f64,
    /// f_h, share of the frictional heat that enters the asperity; a result where the counterface conducts.
    pub heat_partition: f64,
    /// h_g, W/(m² K), or a finite contact conductance of the counterface; unless 0 the table holds for its own radius only.
    pub gap_conductance: f64,
    /// The body on the other side: its constants as `key = value` in SI units; empty if it is rigid and isothermal.
    pub counterface: String,
    /// Shear fracture energy of the material, where it is known.
    pub fracture_energy: Option<FractureEnergy>,
    /// Relative error of interpolation that points were added for. Where there is one, the errors
    /// of the cells include that of interpolating around them.
    pub interpolation_tolerance: Option<f64>,
}

impl Metadata {
    /// Of spheres of `radius` (m) without heat at an initial temperature (K), which slide at the shear strength of the
    /// material.
    pub fn of_sphere(material: &ElasticPlastic, radius: f64, temperature: f64) -> Self {
        Self {
            asperity_radius: radius,
            critical_interference: material.critical_interference(radius),
            contact_modulus: material.contact_modulus(),
            poisson_ratio: material.poisson_ratio,
            yield_strength: material.yield_strength,
            strength_factor: Some(1.0),
            temperature,
            ..Self::default()
        }
    }

    /// Limit of the shear traction at the initial temperature; none in full stick, without friction, and where the file does
    /// not state it.
    pub fn shear_limit(&self) -> Option<ShearLimit> {
        let cap = self.strength_factor.map(|factor| factor * self.yield_strength / 3f64.sqrt());
        match (self.film_strength, self.pressure_coefficient) {
            (Some(film), Some(coefficient)) => {
                Some(ShearLimit { film, coefficient, cap: cap.unwrap_or(f64::INFINITY) })
            }
            _ => cap.map(ShearLimit::constant),
        }
    }

    /// The body on the other side in words.
    pub fn counterface_in_words(&self) -> String {
        match self.counterface.as_str() {
            "" => "rigid and isothermal".to_string(),
            constants => constants.lines().collect::<Vec<_>>().join(", "),
        }
    }

    /// Constants of the body on the other side, SI; none if it is rigid and isothermal.
    pub fn counterface_constants(&self) -> BTreeMap<String, f64> {
        let constants = self.counterface.split([',', '\n']).filter_map(|constant| constant.split_once('='));
        let number = |(key, value): (&str, &str)| Some((key.trim().to_owned(), value.trim().parse().ok()?));
        // Where both temperatures agree the conductance is infinite.
        constants.filter_map(number).filter(|(_, value): &(_, f64)| value.is_finite()).collect()
    }
}
