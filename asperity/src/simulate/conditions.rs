//! Common conditions of all runs of one slip rate: heat and the meshes that it requires, chosen before the slide.

use tables::quantity::Quantity;

use crate::heat::expected::{HeatChoice, HeatEffect, choose_heat, runaway};
use crate::material::SHEAR_RATIO;
use crate::scene::fitted_constants::smooth_flux;
use crate::scene::loading::extent;
use crate::scene::{ELEMENTS_PER_RADIUS, Kinematics, LoadingStep};
use crate::simulate::SimulationError;
use crate::simulate::accuracy::modelling_error::{
    ElasticStrain, ModellingError, SharedHeat, energy_of_press,
};
use crate::simulate::accuracy::resolution::{Resolution, thermal_layer_refinements, thermal_sublayers};
use crate::simulate::messages::Warning;
use crate::simulate::pressed::Pressed;
use crate::simulate::run::Run;
use crate::simulate::strain::elastic_strain;

/// Expected softening before sliding, over the required accuracy, below which the mesh of conduction is not divided.
const NEGLIGIBLE_AT_INCEPTION: f64 = 0.01;

pub(super) struct Conditions<'a> {
    pub pressed: &'a Pressed,
    pub heat: HeatChoice,
    /// Expected effect of heat, whether it is simulated or not.
    pub effect: HeatEffect,
    /// Steps of the slide; a single one if the scene has no programme.
    pub programme: Vec<LoadingStep>,
    /// VR/κ of the fastest step, 0 without heat.
    speed: f64,
    /// Refinements of the thermal layer in all meshes, see [`thermal_layer_refinements`].
    thermal_layer_refinements: u32,
    /// Parts of the first layer of conduction in all meshes, see [`thermal_sublayers`].
    pub thermal_sublayers: u32,
}

impl<'a> Conditions<'a> {
    /// Conditions at a slip rate, m/s, unless the scene has a programme; an error where plastic flow heats the material too
    /// strongly.
    pub fn new(pressed: &'a Pressed, slip_rate: f64) -> Result<Self, SimulationError> {
        let Pressed { scene, problem, contact_radius, .. } = pressed;
        let contact_radius = *contact_radius;
        let programme = scene.loading.programme(slip_rate);
        let (slip_rate, _) = extent(&programme);
        let effect = HeatEffect::expected(scene, slip_rate, contact_radius * problem.units.length);
        let heat = choose_heat(scene, slip_rate, &effect);
        if let Some(heating) = runaway(scene).filter(|_| heat.is_coupled()) {
            return Err(SimulationError::Unsupported(format!(
                "plastic flow heats this material by {heating:.0e} K per unit of strain, so that it expands or melts faster \
                 than it flows: a slide with heat has no equilibrium. Check material.density, specific_heat, \
                 thermal_expansion and yield_strength; model.heat = \"off\" leaves heat out"
            )));
        }
        let speed = if heat.is_coupled() { slip_rate / problem.units.speed() } else { 0.0 };
        // The coarsest mesh of the run decides for all of them: that of the auxiliary runs, or the main one where it has no
        // coarser ones.
        let meshes = [pressed.resolution, pressed.resolution.coarse()];
        let fits = |refinements: &u32| {
            let at = |mesh| Resolution { thermal_layer_refinements: *refinements, ..mesh };
            meshes.iter().all(|mesh| at(*mesh).mesh_size(contact_radius).fits())
        };
        let wanted = thermal_layer_refinements(speed * contact_radius);
        let thermal_layer_refinements = (1..=wanted).rev().find(fits).unwrap_or(0);
        let warm = heat.is_coupled() && effect.inception > NEGLIGIBLE_AT_INCEPTION * scene.numerics.accuracy;
        let thermal_sublayers = match warm {
            true => thermal_sublayers(effect.inception_depth, thermal_layer_refinements),
            false => 1,
        };
        Ok(Self { pressed, heat, effect, programme, speed, thermal_layer_refinements, thermal_sublayers })
    }

    /// The resolution with elements at the surface as thin as heat needs them.
    pub fn at_surface(&self, resolution: &Resolution) -> Resolution {
        Resolution { thermal_layer_refinements: self.thermal_layer_refinements, ..*resolution }
    }

    /// Va/κ of the first step, in which sliding begins, with the contact radius after the press; 0 where heat does not soften the
    /// interface before.
    pub fn peclet_number_at_inception(&self) -> f64 {
        if self.softening_at_inception() == 0.0 {
            return 0.0;
        }
        let Pressed { problem, contact_radius, .. } = self.pressed;
        self.first_slip_rate() / problem.units.speed() * contact_radius
    }

    /// V of the first step, in which sliding begins, m/s.
    fn first_slip_rate(&self) -> f64 {
        self.programme.first().map_or(0.0, |step| step.slip_rate().abs())
    }

    /// Whether the hemisphere has room for the mesh.
    pub fn fits(&self, resolution: &Resolution) -> bool {
        self.at_surface(resolution).mesh_size(self.pressed.contact_radius).fits()
    }

    /// Expected share of the strength of the interface that is lost before sliding begins, in the first step.
    pub fn softening_at_inception(&self) -> f64 {
        let Pressed { scene, problem, contact_radius, .. } = self.pressed;
        let radius = contact_radius * problem.units.length;
        match self.heat.is_coupled() {
            true => HeatEffect::expected(scene, self.first_slip_rate(), radius).inception,
            false => 0.0,
        }
    }

    /// Temperature rise to report where heat is negligible, K.
    pub fn expected_rise(&self) -> f64 {
        if self.heat == HeatChoice::Negligible { self.effect.rise } else { 0.0 }
    }

    /// Heat partition to report where heat is left out.
    pub fn expected_partition(&self) -> Option<f64> {
        (!self.heat.is_coupled()).then_some(self.effect.partition)
    }

    /// Effects that a run neglects other than by choice of the scene, or does not resolve.
    pub fn modelling_error(&self, run: &Run) -> ModellingError {
        let Pressed { scene, problem, .. } = self.pressed;
        let small = scene.model.kinematics == Kinematics::Auto && !problem.finite_strain;
        ModellingError {
            heat: (self.heat == HeatChoice::Negligible).then_some(self.effect),
            shared_heat: self.shared_heat(run),
            heat_partition: if self.heat.is_coupled() { 0.0 } else { self.effect.partition_error },
            strain: if small { run.plastic_strain() } else { 0.0 },
            elastic_strain: small.then(|| ElasticStrain {
                strain: elastic_strain(scene, problem),
                traction: run.largest_traction() / SHEAR_RATIO,
                interference: scene.loading.interference,
            }),
            press_coupling: problem.press_friction.neglected,
            press_energy: energy_of_press(
                problem.press_friction.neglected,
                run.largest_traction() / SHEAR_RATIO,
            ),
            slide_coupling: self.slide_coupling(run),
            finite_counterface: problem.counterface_share
                * self.pressed.contact_radius
                * problem.elastic_share(),
            friction_exponent: run.friction_exponent(),
            localised_shear: scene.localised_shear(run.plastic_strain_in_stick()),
        }
    }

    /// See [`ModellingError::slide_coupling`].
    fn slide_coupling(&self, run: &Run) -> f64 {
        let Pressed { scene, problem, .. } = self.pressed;
        let coupling = problem.coupling_of_flat.max(0.0) * (run.largest_traction() / SHEAR_RATIO).powi(2)
            / scene.loading.interference;
        if coupling.is_finite() { coupling } else { 0.0 }
    }

    fn shared_heat(&self, run: &Run) -> Option<SharedHeat> {
        let Pressed { scene, problem, contact_radius, .. } = self.pressed;
        let [conductivity, _] = scene.counterface.conduction().filter(|_| self.heat.is_coupled())?;
        let bound = |slip_rate: f64| {
            let peclet = scene.counterface.peclet(slip_rate, contact_radius * problem.units.length)?;
            Some(SharedHeat::bound_of_mean_rise(
                conductivity / scene.material.thermal_conductivity.value,
                peclet,
            ))
        };
        let slip_rates = self.programme.iter().map(|step| step.slip_rate().abs()).filter(|&rate| rate > 0.0);
        let value = |quantity| run.values.value(quantity);
        let rise = run.values.magnitude(Quantity::TemperatureMean);
        let counterface = problem.counterface.as_ref()?;
        // The more of the heat it takes up, the more it determines the rise.
        let share = (1.0 - value(Quantity::HeatPartition)).abs().min(1.0);
        let varying = share * counterface.error_of_mean_rise(rise);
        let mean_rise = slip_rates.filter_map(bound).fold(0.0, f64::max) + varying;
        Some(SharedHeat {
            mean_rise,
            softening: scene.softening_between(rise, (1.0 + mean_rise) * rise),
            load: smooth_flux::PARTITION
                * (1.0 - value(Quantity::LoadPress) / value(Quantity::Load)).abs().min(1.0),
        })
    }

    /// A warning where the layer that frictional heat reaches is thinner than the elements at the surface.
    pub fn unresolved_layer(&self, resolution: &Resolution) -> Option<Warning> {
        let surface = 0.5f64.powi(self.thermal_layer_refinements as i32 + 1);
        let peclet = self.speed * self.pressed.contact_radius;
        let share = resolution.elements_per_radius as f64 / (surface * peclet.sqrt());
        let frictional = self.pressed.scene.largest_heat_partition() > 0.0;
        (share < 1.0 && frictional).then(|| {
            let enough = (resolution.elements_per_radius as f64 / share).ceil();
            let elements = (enough <= *ELEMENTS_PER_RADIUS.end() as f64).then_some(enough);
            Warning::ThinThermalLayer { share, elements }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::tests::of_preset;
    use crate::simulate::{Unwatched, press};

    /// Sliding begins in the first step, whatever the fastest one is. 4340 steel at 20 ω_c = 1.59e-3 R: a = √(Rω) = 39.9 µm
    /// (Hertz, near that of an elastic–plastic contact), κ = 1.017e-5 m²/s.
    #[test]
    fn the_peclet_number_at_inception_is_that_of_the_first_step() {
        let mesh = ["numerics.elements_per_radius=6", "numerics.sectors=4"];
        let mut scene = of_preset("steel-4340", &mesh);
        let at = |slip_rate| LoadingStep::Slip { slip_rate, slip_distance: 0.2 };
        let [slow, fast] = [[0.1, 10.0], [10.0, 0.1]].map(|rates| {
            scene.loading = scene.loading.clone().with_steps(rates.map(at).to_vec());
            let pressed = press(&scene, &Unwatched).unwrap();
            Conditions::new(&pressed, 0.0).unwrap().peclet_number_at_inception()
        });
        assert!((fast / 39.2 - 1.0).abs() < 0.03 && (fast / slow - 100.0).abs() < 1e-9, "{slow} {fast}");
    }
}
