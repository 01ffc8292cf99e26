//! The scene in dimensionless form: lengths by R, stresses by σ_Y(T₀), time by R²/κ.
//!
//! Quasi-static rate-independent plasticity with conduction depends on the radius only through
//! VR/κ (and h_g R/k), so a 10 nm and a 10 mm asperity are the same problem here.

use std::sync::Arc;

use tables::closed_forms::jackson_green;

use crate::discretisation::body::Body;
use crate::discretisation::collocation::Collocation;
use crate::discretisation::element::RevolvedMesh;
use crate::discretisation::mesh::{MeridianMesh, MeshSize};
use crate::heat::counterface::HalfSpace;
use crate::heat::properties::ThermalProperties;
use crate::interface::contact::Contact;
use crate::material::Solid;
use crate::scene::{Control, Interface, Kinematics, Material, Property, Scene};
use crate::solver::StopRequest;
use crate::solver::harmonic::{FactorError, HarmonicFactors};
use crate::solver::newton::Mechanics;

#[derive(Clone, Debug)]
pub struct Problem {
    pub solid: Solid,
    /// Finite strain, not small.
    pub finite_strain: bool,
    /// E*/σ_Y.
    pub contact_modulus: f64,
    /// ν.
    pub poisson_ratio: f64,
    /// Share of the elastic compliance that is the counterface's.
    pub counterface_share: f64,
    /// ω_c/R.
    pub critical_interference: f64,
    /// ω₀/R.
    pub interference: f64,
    /// That of the scene; beside a conducting counterface, which takes up heat from there, all frictional heat is released into
    /// the asperity.
    pub interface: Interface,
    pub press_friction: PressFriction,
    /// Time of the press, s; infinite where it is quasi-static.
    pub press_time: f64,
    /// β² on a rigid flat, on which the asperity slides, less that of the two bodies.
    pub coupling_of_flat: f64,
    /// Loading control of the slide.
    pub control: Control,
    /// Speed of shear waves in the asperity itself, over κ/R.
    pub wave_speed: f64,
    /// ρc·(1 K)/σ_Y at T₀; also k·(1 K), as κ = 1.
    pub heat_capacity: f64,
    /// Properties that depend on temperature; none where specific heat and conductivity are constant.
    pub thermal_properties: Option<ThermalProperties>,
    /// Share that enters the asperity when sliding begins.
    pub initial_heat_partition: f64,
    /// The counterface that conducts; none where the flat is isothermal.
    pub counterface: Option<HalfSpace>,
    /// Rise at which neither body nor interface has any strength.
    pub melting_rise: Option<f64>,
    /// h_g R/k, Biot number of the gap between asperity and flat.
    pub gap_biot_number: f64,
    pub units: Units,
}

/// Shear tractions of the press.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PressFriction {
    /// Full stick on the flat, or no friction.
    pub sticks: bool,
    /// Change of β² by which either differs from full stick between the two bodies.
    pub neglected: f64,
}

impl PressFriction {
    /// In full stick the load exceeds that without friction in proportion to β² (0.2 β², up to β = 0.5; the area falls by
    /// 0.3 β²; ratios in `studies::verification::full_stick`). The asperity on a rigid flat has its own β whatever the
    /// counterface is: of full stick and no friction, the one that is closer to the two bodies.
    fn of(scene: &Scene) -> Self {
        if !scene.interface.law.has_friction() {
            return Self { sticks: false, neglected: 0.0 };
        }
        let [both, rigid] = scene.dundurs_beta().map(|beta| beta * beta);
        match both > 0.5 * rigid {
            true => Self { sticks: true, neglected: (both - rigid).abs() },
            false => Self { sticks: false, neglected: both },
        }
    }
}

/// Factors from dimensionless to SI.
#[derive(Clone, Copy, Debug)]
pub struct Units {
    /// R, m.
    pub length: f64,
    /// σ_Y, Pa.
    pub stress: f64,
    /// R²/κ, s.
    pub time: f64,
    /// T₀, K.
    pub temperature: f64,
}

impl Units {
    pub fn force(&self) -> f64 {
        self.stress * self.length * self.length
    }
    pub fn energy(&self) -> f64 {
        self.force() * self.length
    }
    pub fn area(&self) -> f64 {
        self.length * self.length
    }
    /// κ/R, m/s.
    pub fn speed(&self) -> f64 {
        self.length / self.time
    }
}

impl Problem {
    pub fn new(scene: &Scene) -> Self {
        let wave_speed = wave_speed(&scene.material);
        let press_friction = PressFriction::of(scene);
        let [both, rigid] = scene.dundurs_beta().map(|beta| beta * beta);
        let own_modulus = scene.material.youngs_modulus.value;
        let expansion = scene.expansion_of_counterface();
        let scene = &scene.with_combined_modulus();
        let material = &scene.material;
        let body = material.elastic_plastic();
        let critical = body.critical_interference(1.0);
        let diffusivity = material.diffusivity();
        let heat_capacity = material.density * material.specific_heat.value / material.yield_strength;
        let counterface = half_space(scene, heat_capacity, expansion);
        let mut interface = scene.interface.clone();
        if counterface.is_some() {
            interface.heat_partition = 1.0;
        }
        let mut problem = Self {
            solid: Solid::new(material, scene.loading.temperature),
            finite_strain: scene.model.kinematics == Kinematics::Finite,
            contact_modulus: body.contact_modulus() / material.yield_strength,
            poisson_ratio: material.poisson_ratio,
            counterface_share: 1.0 - material.youngs_modulus.value / own_modulus,
            critical_interference: critical,
            interference: scene.loading.interference * critical,
            interface,
            press_friction,
            press_time: f64::INFINITY,
            coupling_of_flat: rigid - both,
            control: scene.loading.control,
            wave_speed: wave_speed * scene.radius / diffusivity,
            heat_capacity,
            thermal_properties: ThermalProperties::of(
                &material.specific_heat,
                &material.thermal_conductivity,
                scene.loading.temperature,
            ),
            initial_heat_partition: scene.initial_heat_partition(),
            counterface,
            melting_rise: scene.highest_temperature().map(|highest| highest - scene.loading.temperature),
            gap_biot_number: scene.interface.gap_conductance * scene.radius
                / material.thermal_conductivity.value,
            units: Units {
                length: scene.radius,
                stress: material.yield_strength,
                time: scene.radius * scene.radius / diffusivity,
                temperature: scene.loading.temperature,
            },
        };
        problem.press_time = scene.loading.press_time(problem.expected_contact_radius() * scene.radius);
        problem
    }

    /// d ln P/d ln E* at a held interference by Jackson & Green 2005: 1 in elastic contact, 0 in fully plastic.
    pub fn elastic_share(&self) -> f64 {
        const STEP: f64 = 1.1;
        let ratio = self.interference / self.critical_interference;
        let load = |ratio| jackson_green::load(ratio, 1.0 / self.contact_modulus, self.poisson_ratio);
        // ω_c and P_c are in proportion to 1/E*².
        let exponent = (load(STEP * ratio) / load(ratio)).ln() / STEP.ln();
        (2.0 * (exponent - 1.0)).clamp(0.0, 1.0)
    }

    /// Contact radius over R to expect at ω₀ (Jackson & Green 2005).
    pub fn expected_contact_radius(&self) -> f64 {
        let ratio = self.interference / self.critical_interference;
        let area = jackson_green::area(ratio, 1.0 / self.contact_modulus);
        // A_c = πRω_c.
        (area * self.critical_interference).sqrt()
    }
}

/// Speed of shear waves √(G/ρ), m/s.
pub(crate) fn wave_speed(material: &Material) -> f64 {
    (0.5 * material.youngs_modulus.value / ((1.0 + material.poisson_ratio) * material.density)).sqrt()
}

/// The counterface of a scene, if it conducts and expands by `expansion` = (1 + ν₂)α₂, beside an asperity of heat capacity
/// `capacity`, which is k also.
fn half_space(scene: &Scene, capacity: f64, expansion: f64) -> Option<HalfSpace> {
    let flat = &scene.counterface;
    let [conductivity, heat] = flat.conduction()?;
    let Material { thermal_conductivity: Property { value: own, .. }, density, specific_heat, .. } =
        &scene.material;
    let (conductivity, heat) = (conductivity / own, heat / (density * specific_heat.value));
    let conductance = flat.contact_conductance * scene.radius / own;
    let mut half_space = HalfSpace::new(conductivity / heat, capacity * (conductivity * heat).sqrt())
        .with_properties(ThermalProperties::of(
            flat.specific_heat.as_ref()?,
            flat.thermal_conductivity.as_ref()?,
            scene.loading.temperature,
        ))
        .with_expansion(expansion);
    half_space.resistance = 1.0 / (conductance * capacity);
    half_space.share = scene.interface.heat_partition;
    Some(half_space)
}

/// Mesh and elastic factors for one number of sectors.
#[derive(Clone)]
pub struct Discretisation {
    pub mesh: RevolvedMesh,
    pub factors: Arc<HarmonicFactors>,
}

impl Discretisation {
    pub fn new(
        problem: &Problem,
        size: MeshSize,
        sectors: Collocation,
        stop: &StopRequest,
    ) -> Result<Self, FactorError> {
        let mesh = RevolvedMesh::new(MeridianMesh::new(size), sectors);
        let factors = HarmonicFactors::elastic(&mesh, problem.solid.moduli, stop)?;
        Ok(Self { mesh, factors: Arc::new(factors) })
    }

    /// The axisymmetric state of a press (body, contact, displacement) at all angles.
    pub fn revolve(
        &self,
        problem: &Problem,
        (body, contact, displacement): (&Body, &Contact, &[f64]),
        tolerance: f64,
    ) -> Mechanics {
        let body = Body::revolve(body, self.mesh.clone());
        let elastic = (problem.contact_modulus, problem.poisson_ratio);
        let mut contact = Contact::revolve(contact, &self.mesh, elastic);
        if problem.interface.law.has_friction() {
            contact.stick();
        }
        let displacement = self.mesh.sectors.spread(displacement);
        Mechanics::new(body, contact, self.factors.clone(), displacement, tolerance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::tests::of_preset;

    #[test]
    fn the_press_sticks_where_pressure_displaces_the_surfaces_unlike() {
        let press = |set: &[&str]| PressFriction::of(&of_preset("steel-4340", set));
        let (free, stuck) = (
            |neglected| PressFriction { sticks: false, neglected },
            |neglected| PressFriction { sticks: true, neglected },
        );
        assert_eq!(press(&[]), stuck(0.0));
        assert_eq!(press(&["interface.law=frictionless"]), free(0.0));
        let like = "counterface.preset=\"steel-4340\"";
        assert_eq!(press(&[like]), free(0.0));
        assert_eq!(press(&[like, "counterface.elastic=false"]), stuck(0.0));
        // A counterface that is hardly displaced, and one that is displaced along itself and not the asperity.
        let stiff = press(&["counterface.youngs_modulus=4e12", "counterface.poisson_ratio=0.3"]);
        assert!(stiff.sticks && (0.005..0.02).contains(&stiff.neglected), "{stiff:?}");
        let soft = press(&["counterface.youngs_modulus=2e9", "counterface.poisson_ratio=0.0"]);
        assert!(soft.sticks && (0.1..0.2).contains(&soft.neglected), "{soft:?}");
    }
}
