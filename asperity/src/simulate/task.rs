//! One slide on one mesh, and with its companions.

use std::sync::Arc;
use std::time::Instant;

use rayon::prelude::*;

use super::pressed::{PressedMesh, press_error};
use super::{Pressed, Probe, SimulationError, Watch};
use crate::discretisation::body::Body;
use crate::discretisation::collocation::Collocation;
use crate::heat::conduction::Conduction;
use crate::heat::expected::{Heat, HeatEffect, choose_heat};
use crate::interface::contact::Contact;
use crate::loading::body_fields::BodyFields;
use crate::loading::problem::Discretisation;
use crate::loading::recording::{Fields, Recorder};
use crate::loading::slide::{Slide, SlideFailure, SlideHeat};
use crate::scene::{ELEMENTS_PER_RADIUS, Kinematics};
use crate::simulate::accuracy::modelling_error::ModellingError;
use crate::simulate::accuracy::resolution::{Resolution, thermal_layer_refinements};
use crate::simulate::scalars::Scalars;
use crate::solver::newton::{Effort, Mechanics};
use crate::solver::timings::{Kernel, Timings};

/// A slide and the pressed mesh that it started on.
pub(super) type Run = (Arc<PressedMesh>, Slid);

impl Slid {
    /// Growth of the contact, relative to its radius after the press, at which it left the mesh.
    pub(super) fn outgrown(&self) -> Option<f64> {
        match self.failure {
            Some(SlideFailure::OutgrewMesh { growth }) => Some(growth),
            _ => None,
        }
    }
}

/// Where the contact points are.
pub struct ContactPoints {
    /// Over R.
    pub radii: Vec<f64>,
    pub angles: Vec<f64>,
}

/// One slide on one mesh, as far as it came.
pub struct Slid {
    pub history: Vec<crate::loading::slide::SlideState>,
    pub fields: Vec<Fields>,
    pub body: Option<BodyFields>,
    pub grid: ContactPoints,
    pub(super) unknowns: usize,
    pub(super) effort: Effort,
    pub(super) timings: Timings,
    pub(super) cutbacks: usize,
    pub(super) failure: Option<SlideFailure>,
}

/// What all slides at one slip rate share.
pub(super) struct Task<'a> {
    pub(super) pressed: &'a Pressed,
    /// VR/κ, 0 without heat.
    pub(super) speed: f64,
    pub(super) heat: Heat,
    /// Of heat, whatever is done about it.
    pub(super) effect: HeatEffect,
    /// Of the meshes, see [`thermal_layer_refinements`].
    thermal_layer_refinements: u32,
    pub(super) watch: &'a dyn Watch,
}

impl<'a> Task<'a> {
    pub(super) fn new(
        pressed: &'a Pressed,
        slip_rate: f64,
        watch: &'a dyn Watch,
        notes: &mut Vec<String>,
    ) -> Self {
        let units = pressed.problem.units;
        let effect = HeatEffect::expected(&pressed.scene, slip_rate, pressed.contact_radius * units.length);
        let heat = choose_heat(&pressed.scene, slip_rate, &effect, notes);
        let speed = if heat == Heat::ModellingError { 0.0 } else { slip_rate / units.speed() };
        let mut task = Self { pressed, speed, heat, effect, thermal_layer_refinements: 0, watch };
        // The coarsest mesh of the run decides what all of them have.
        let coarse = pressed.resolution.coarse();
        let fit = |halvings: &u32| {
            let resolution = Resolution { thermal_layer_refinements: *halvings, ..coarse };
            resolution.mesh_size(pressed.contact_radius).fits()
        };
        task.thermal_layer_refinements =
            (1..=thermal_layer_refinements(task.peclet())).rev().find(fit).unwrap_or(0);
        task
    }

    pub(super) fn slide(
        &self,
        resolution: &Resolution,
        mut progress: impl FnMut(f64, &str),
    ) -> Result<Run, SimulationError> {
        let problem = &self.pressed.problem;
        let resolution = &self.at_surface(resolution);
        let pressed = self.pressed.mesh(resolution, self.watch)?;
        let clock = Instant::now();
        let discretisation =
            Discretisation::new(problem, pressed.size, Collocation::full(resolution.sectors))
                .map_err(|e| press_error(e.into()))?;
        let mesh = &discretisation.mesh;
        let body = Body::revolve(&pressed.body, mesh.clone());
        let contact = Contact::revolve(&pressed.contact, mesh, problem.contact_modulus);
        let displacement = mesh.sectors.spread(&pressed.displacement);
        let factors = discretisation.factors.clone();
        let mechanics = Mechanics::new(body, contact, factors, displacement, resolution.tolerance);
        let heat = match self.heat {
            Heat::ModellingError => None,
            Heat::OneWay | Heat::Coupled => {
                let conduction =
                    Conduction::new(mesh, problem.heat_capacity).map_err(|e| press_error(e.into()))?;
                let conduction = conduction.with_properties(problem.thermal_properties.clone());
                Some(SlideHeat { conduction, acts_back: self.heat == Heat::Coupled })
            }
        };
        let mut slide = Slide::new(problem, mechanics, heat, self.speed, resolution.increments);
        slide.mechanics.timings.since(Kernel::Setup, clock);
        // Each mesh slides as far in units of its own contact radius.
        let radius = pressed.contact.radius(&pressed.contact.committed);
        let distance = self.pressed.scene.loading.slip_distance * radius;
        slide.recorder = Recorder::new(&self.pressed.recording, radius, &slide.history[0]);
        slide.record_fields();
        let failure = slide
            .run(distance, |done, history| {
                progress(done, &crate::loading::progress::in_words(&problem.units, history));
                !self.watch.cancelled()
            })
            .err();
        slide.record_fields();
        let mut timings = slide.mechanics.timings;
        timings.add(Kernel::Rest, clock.elapsed().as_secs_f64() - timings.total());
        timings.add(Kernel::Press, pressed.seconds);
        let slid = Slid {
            effort: slide.mechanics.effort,
            timings,
            history: slide.history,
            fields: slide.recorder.contact,
            body: BodyFields::new(mesh, &slide.recorder.bodies, &problem.units),
            grid: ContactPoints {
                radii: slide.mechanics.contact.radii.clone(),
                angles: mesh.sectors.angles(),
            },
            unknowns: mesh.field_length(3),
            cutbacks: slide.cutbacks,
            failure,
        };
        Ok((pressed, slid))
    }

    /// The companions of a run at `resolution`; `probe` is the first of them, if that was made. Where
    /// it failed errors are unknown, and the others are not needed.
    pub(super) fn companions(
        &self,
        resolution: &Resolution,
        probe: Option<Probe>,
        progress: impl Fn(f64, &str) + Sync,
    ) -> Result<Vec<Run>, SimulationError> {
        let coarse = resolution.coarse();
        let others = [coarse.other_sectors(), coarse.longer_steps(), coarse.looser_solver()];
        let hopeless = probe.as_ref().is_some_and(|probe| !probe.complete());
        let first = probe.map(|Probe { mesh, slid, .. }| (mesh, slid));
        let missing = if first.is_none() { Some(coarse) } else { None };
        let plan: Vec<Resolution> =
            missing.into_iter().chain(others).take(if hopeless { 0 } else { 4 }).collect();
        let runs: Vec<_> = plan
            .par_iter()
            .enumerate()
            .map(|(i, resolution)| {
                self.slide(resolution, |done, standing| {
                    if i == 0 {
                        progress(done, standing);
                    }
                })
            })
            .collect();
        let runs = runs.into_iter().collect::<Result<Vec<_>, _>>()?;
        Ok(first.into_iter().chain(runs).collect())
    }

    /// The resolution with the mesh as thin at the surface as heat needs it.
    fn at_surface(&self, resolution: &Resolution) -> Resolution {
        Resolution { thermal_layer_refinements: self.thermal_layer_refinements, ..*resolution }
    }

    /// aV/κ, 0 without heat.
    fn peclet(&self) -> f64 {
        self.speed * self.pressed.contact_radius
    }

    /// A warning where the layer that frictional heat reaches is thinner than that of the elements at the surface,
    /// however thin these are made.
    pub(super) fn unresolved_layer(&self, resolution: &Resolution) -> Option<String> {
        let surface = 0.5f64.powi(self.thermal_layer_refinements as i32 + 1);
        let share = resolution.elements_per_radius as f64 / (surface * self.peclet().sqrt());
        let frictional = self.pressed.scene.interface.heat_partition > 0.0;
        (share < 1.0 && frictional).then(|| {
            let enough = (resolution.elements_per_radius as f64 / share).ceil();
            let way_out = match enough <= *ELEMENTS_PER_RADIUS.end() as f64 {
                true => format!("elements_per_radius = {enough} would resolve it"),
                false => "no mesh would resolve it".into(),
            };
            format!(
                "frictional heat stays in a layer of {share:.2} of the elements at the surface: mu may be off by \
                 more than its error; {way_out}"
            )
        })
    }

    /// Whether the hemisphere has room for the mesh.
    pub(super) fn fits(&self, resolution: &Resolution) -> bool {
        self.at_surface(resolution).mesh_size(self.pressed.contact_radius).fits()
    }

    /// What the scene did not ask to leave out.
    pub(super) fn modelling_error(&self, slid: &Slid) -> ModellingError {
        let small = self.pressed.scene.model.kinematics == Kinematics::Auto;
        let strain = slid.history.last().map_or(0.0, |instant| instant.plastic_strain_max);
        ModellingError {
            heat: (self.heat == Heat::OneWay).then_some(self.effect),
            strain: if small { strain } else { 0.0 },
        }
    }

    pub(super) fn scalars(&self, mesh: &PressedMesh, slid: &Slid) -> Scalars {
        Scalars::new(&self.pressed.problem, &self.pressed.scene, &mesh.increments, &slid.history)
    }
}
