//! Section `[counterface]`: the body on the other side of the contact. Without it the flat is rigid and isothermal.

use std::f64::consts::PI;
use std::fmt::{self, Display, Formatter};

use serde::{Deserialize, Serialize};
use tables::closed_forms::hertz::{contact_modulus, dundurs_beta};

use crate::scene::{Property, Scene};

/// A counterface that is elastic, or conducts heat, or both.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Counterface {
    /// E₂, Pa; with ν₂ the counterface is elastic.
    pub youngs_modulus: Option<f64>,
    /// ν₂.
    pub poisson_ratio: Option<f64>,
    /// ρ₂, kg/m³; with c₂ and k₂ the counterface conducts heat.
    pub density: Option<f64>,
    /// c₂, J/(kg K).
    pub specific_heat: Option<Property>,
    /// k₂, W/(m K).
    pub thermal_conductivity: Option<Property>,
    /// α₂, 1/K, of a counterface that conducts; none leaves its expansion out.
    pub thermal_expansion: Option<f64>,
    /// h_c, W/(m² K): between both surfaces; infinite where their temperatures agree in mean, slope and curvature.
    pub contact_conductance: f64,
}

impl Default for Counterface {
    fn default() -> Self {
        Self {
            youngs_modulus: None,
            poisson_ratio: None,
            density: None,
            specific_heat: None,
            thermal_conductivity: None,
            thermal_expansion: None,
            contact_conductance: f64::INFINITY,
        }
    }
}

/// The constants at the initial temperature as `key = value` in SI units, and which of them vary with temperature.
impl Display for Counterface {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if self.is_absent() {
            return Ok(());
        }
        let mut constant = self.clone();
        let of_table = |(key, property): (_, &mut Property)| property.table.take().map(|_| key);
        let varying: Vec<&str> = constant.properties_mut().filter_map(of_table).collect();
        let text = toml::to_string(&constant).map_err(|_| fmt::Error)?;
        f.write_str(&text.lines().collect::<Vec<_>>().join(", "))?;
        if varying.is_empty() { Ok(()) } else { write!(f, ", with temperature: {}", varying.join(" and ")) }
    }
}

impl Counterface {
    /// Whether it is rigid and isothermal.
    pub(crate) fn is_absent(&self) -> bool {
        *self == Self::default()
    }

    /// The properties that may depend on temperature and are given, with their keys.
    pub(crate) fn properties_mut(&mut self) -> impl Iterator<Item = (&'static str, &mut Property)> {
        [("specific_heat", &mut self.specific_heat), ("thermal_conductivity", &mut self.thermal_conductivity)]
            .into_iter()
            .filter_map(|(key, property)| Some((key, property.as_mut()?)))
    }

    /// k₂ and ρ₂c₂ at the initial temperature, where it conducts heat.
    pub fn conduction(&self) -> Option<[f64; 2]> {
        let (conductivity, heat) = (self.thermal_conductivity.as_ref()?, self.specific_heat.as_ref()?);
        Some([conductivity.value, self.density? * heat.value])
    }

    /// Péclet number Va/(2κ₂) at a slip rate (m/s) and the radius of a contact (m), where it conducts heat.
    pub fn peclet(&self, slip_rate: f64, contact_radius: f64) -> Option<f64> {
        let [conductivity, capacity] = self.conduction()?;
        Some(slip_rate * contact_radius * capacity / (2.0 * conductivity))
    }
}

impl Scene {
    /// The scene of a rigid counterface with the contact modulus of the two elastic bodies,
    /// 1/E* = (1 − ν²)/E + (1 − ν₂²)/E₂ (K. L. Johnson, *Contact Mechanics*, 1985, §4.2): the asperity has the modulus
    /// E*(1 − ν²), and its own Poisson ratio. A scene whose counterface is rigid stays as it is.
    ///
    /// ```
    /// use asperity::scene::file::parse_scene;
    ///
    /// let text = "[material]\npreset = \"copper\"\n[asperity]\nradius = 1e-3\n[counterface]\npreset = \"copper\"\n\
    ///             [loading]\ninterference = 5\nslip_rate = 1\n";
    /// let scene = parse_scene(text, "this example", &[])?;
    /// let combined = scene.with_combined_modulus();
    /// // Of like bodies each takes half of the displacement.
    /// assert!((combined.material.youngs_modulus.value / scene.material.youngs_modulus.value - 0.5).abs() < 1e-12);
    /// assert_eq!(combined.with_combined_modulus(), combined);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_combined_modulus(&self) -> Self {
        let mut scene = self.clone();
        let Counterface { youngs_modulus, poisson_ratio, .. } = &mut scene.counterface;
        // Its expansion still needs ν₂.
        if let Some((modulus, ratio)) = youngs_modulus.take().zip(*poisson_ratio) {
            let material = &mut scene.material;
            let own = contact_modulus(material.youngs_modulus.value, material.poisson_ratio);
            let combined = 1.0 / (1.0 / own + 1.0 / contact_modulus(modulus, ratio));
            material.youngs_modulus.value *= combined / own;
        }
        scene
    }

    /// Dundurs' β of the asperity on its counterface, and on a rigid flat.
    pub(crate) fn dundurs_beta(&self) -> [f64; 2] {
        const RIGID: (f64, f64) = (f64::INFINITY, 0.0);
        let asperity = (self.material.youngs_modulus.value, self.material.poisson_ratio);
        let Counterface { youngs_modulus, poisson_ratio, .. } = self.counterface;
        [youngs_modulus.zip(poisson_ratio).unwrap_or(RIGID), RIGID].map(|flat| dundurs_beta(asperity, flat))
    }

    /// (1 + ν₂)α₂ of a counterface that conducts, 1/K, with ν of the asperity where it has no elastic constants; 0 where its
    /// expansion is left out.
    pub(crate) fn expansion_of_counterface(&self) -> f64 {
        let Counterface { poisson_ratio, thermal_expansion, .. } = self.counterface;
        let conducts = self.counterface.conduction().is_some();
        let ratio = poisson_ratio.unwrap_or(self.material.poisson_ratio);
        thermal_expansion.filter(|_| conducts).map_or(0.0, |expansion| (1.0 + ratio) * expansion)
    }

    /// Share of the frictional heat that enters the asperity: that of the scene, or the one with which sliding against
    /// a conducting counterface begins. Through a contact of infinite conductance that is e/(e + e₂), with the
    /// effusivities e = √(kρc).
    pub fn initial_heat_partition(&self) -> f64 {
        match self.counterface.conduction() {
            Some([conductivity, capacity]) if self.counterface.contact_conductance.is_infinite() => {
                let material = &self.material;
                let own =
                    material.thermal_conductivity.value * material.density * material.specific_heat.value;
                1.0 / (1.0 + (conductivity * capacity / own).sqrt())
            }
            _ => self.interface.heat_partition,
        }
    }

    /// Share of the frictional heat that enters the asperity steadily against a counterface that conducts and moves at
    /// `slip_rate` (m/s) over a contact of `contact_radius` (m): k/(k + k₂ρ√(1 + Pe/0.6575)), Pe = Va/(2κ₂), with the
    /// mean rise over a moving disc (Tian & Kennedy 1994, J. Tribol. 116, 167, doi:10.1115/1.2927035) and the
    /// [constriction](Self::constriction) ρ of the asperity.
    pub fn steady_heat_partition(&self, slip_rate: f64, contact_radius: f64) -> Option<f64> {
        let own = self.material.thermal_conductivity.value;
        let [other, _] = self.counterface.conduction()?;
        let peclet = self.counterface.peclet(slip_rate, contact_radius)?;
        Some(own / (own + other * self.constriction(contact_radius) * (1.0 + peclet / 0.6575).sqrt()))
    }

    /// Steady mean rise of the hemisphere under a uniform flux over a contact of `contact_radius` (m), over that of a
    /// half-space: ρ = 1 + 3π/32 (a/R)(ln(4R/a) − 3/4), by the Neumann function of the sphere (Dassios & Sten 2012, Math.
    /// Methods Appl. Sci. 35, 482), with its negative image opposite for the base at the initial temperature, in the mean
    /// over the disc, where ln(1/r) is ln(1/a) + 1/4. Runs up to a = 0.3 R differ by a fifth of the second term.
    pub fn constriction(&self, contact_radius: f64) -> f64 {
        let ratio = contact_radius / self.radius;
        1.0 + 3.0 * PI / 32.0 * ratio * ((4.0 / ratio).ln() - 0.75)
    }

    /// The largest share of the frictional heat to expect in the asperity.
    pub fn largest_heat_partition(&self) -> f64 {
        let own = self.material.thermal_conductivity.value;
        let resting = self.counterface.conduction().map_or(0.0, |[other, _]| own / (own + other));
        self.initial_heat_partition().max(resting)
    }
}
