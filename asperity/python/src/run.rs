//! `asperity.simulate` and its result.

use std::path::PathBuf;

use asperity::Scene;
use asperity::loading::recording::Recording;
use asperity::output::revolved::Extent;
use asperity::output::{figures, provenance, run_file, vtu};
use asperity::scene::file::{parse_scene, read_scene, write_scene};
use asperity::simulate::outcome::Outcome;
use asperity::simulate::{SimulationError, derived, simulate_recorded};
use pyo3::prelude::*;

use crate::errors;
use crate::input::Given;
use crate::output::Figure;
use crate::watch::followed;

/// Name, value, error, unit and meaning of a scalar.
type Scalar = (&'static str, f64, f64, &'static str, &'static str);

/// A scene and its outcome.
#[pyclass(frozen, module = "asperity._core")]
pub struct Run {
    scene: Scene,
    outcome: Outcome,
    incomplete: Option<String>,
}

/// Presses and slides a scene, as `asperity run`.
#[pyfunction]
pub fn simulate(
    py: Python<'_>,
    scene: Given,
    overrides: Vec<String>,
    fields_at: Vec<f64>,
    body: bool,
    threads: Option<usize>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Run> {
    let scene = match scene.is_path() {
        true => read_scene(scene.content.as_ref(), &overrides),
        false => parse_scene(&scene.content, &scene.kind, &overrides),
    };
    let scene = scene.map_err(errors::of_scene)?;
    let end = scene.loading.slip_distance;
    if fields_at.iter().any(|slip| !(0.0..=end).contains(slip)) {
        let allowed = format!(
            "must be slips from 0 to that of the whole slide, {end} contact radii (loading.slip_distance)"
        );
        return Err(errors::refused("fields_at", allowed));
    }
    let recording = Recording { slips: fields_at, body };
    let result =
        followed(py, threads, progress.as_ref(), |follower| simulate_recorded(&scene, &recording, follower))?;
    let reason = result.as_ref().err().map(ToString::to_string);
    let of = |mut outcome: Outcome| {
        outcome.account.add_scene(&scene);
        Run { scene: scene.clone(), outcome, incomplete: reason.clone() }
    };
    match result {
        Ok(outcome) => Ok(of(outcome)),
        Err(SimulationError::Unsupported(reason)) => Err(errors::input(&reason, None, None, &reason)),
        Err(error) => {
            let message = error.to_string();
            let run = error.into_partial().map(|outcome| Py::new(py, of(*outcome))).transpose()?;
            Err(errors::failed(message, run.map(Py::into_any)))
        }
    }
}

#[pymethods]
impl Run {
    /// Scalars in the order of the list, then those that follow from others.
    fn scalars(&self) -> Vec<Scalar> {
        let scalars = derived::all_scalars(&self.scene, &self.outcome);
        scalars.map(|(name, unit, meaning, x)| (name, x.value, x.error, unit, meaning)).collect()
    }

    /// The scene with every default, as TOML.
    fn scene(&self) -> String {
        write_scene(&self.scene)
    }

    fn incomplete(&self) -> Option<&str> {
        self.incomplete.as_deref()
    }

    fn inception(&self) -> String {
        self.outcome.inception.to_string()
    }

    fn steady(&self) -> bool {
        self.outcome.steady
    }

    fn warnings(&self) -> Vec<String> {
        self.outcome.account.warnings.iter().map(ToString::to_string).collect()
    }

    fn notes(&self) -> Vec<String> {
        self.outcome.account.notes.iter().map(ToString::to_string).collect()
    }

    fn write(&self, py: Python<'_>, path: PathBuf, history: &str) -> PyResult<()> {
        let history = provenance::history(history);
        let about = run_file::About { history, incomplete: self.incomplete.as_deref() };
        py.detach(|| run_file::write(&path, &self.scene, &self.outcome, &about))
            .map_err(|error| errors::failed(error, None))
    }

    fn figure(&self, panels: Vec<String>) -> PyResult<Figure> {
        Figure::new(figures::run_figure(&self.scene, &self.outcome), &panels)
    }

    /// Fields of the body for ParaView; the collection that was written.
    fn write_body(&self, directory: PathBuf, whole: bool) -> PyResult<PathBuf> {
        if self.outcome.body.is_none() {
            return Err(errors::refused("body", "was not recorded; simulate with body=True"));
        }
        let extent = if whole { Extent::Whole } else { Extent::Half };
        std::fs::create_dir_all(&directory)?;
        vtu::write(&directory, &self.outcome, extent).map_err(|error| errors::failed(error, None))
    }
}
