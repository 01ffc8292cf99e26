//! `asperity.characterize`, `asperity.predict`, `asperity.sample` and their results.

use std::path::{Path, PathBuf};

use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use roughsurface::friction::Settings;
use roughsurface::friction::warning::Warning;
use roughsurface::output::figure::figure;
use roughsurface::output::{Origin, Results, friction_file, report, sample_file, summary, summary_json};
use roughsurface::sampling::case::{Case, surface_of};
use roughsurface::sampling::finite_surface;
use roughsurface::surface::file::{SurfaceFile, query_values};
use roughsurface::surface::units;
use roughsurface::topography::characterize::{self, Detrend, Options};
use roughsurface::topography::readers::{self, Reading};
use roughsurface::topography::report as characterization;
use roughsurface::topography::spectrum::Window;
use roughsurface::topography::two_faces::on_each_other;
use roughsurface::topography::{Topography, TopographyError};
use tables::netcdf::history;
use tables::netcdf::input::Override;

use crate::errors;
use crate::input::{Given, Numbers};
use crate::output::Figure;
use crate::watch::followed;

/// Summits of a measured topography.
#[pyclass(frozen, module = "asperity._core")]
pub struct Characterization {
    found: characterize::Characterization,
    /// File or name.
    place: String,
    /// What the surface file is said to be of.
    name: String,
}

/// Whether it is periodic, cut-off (m), trend and window.
type Treatment = (bool, Option<f64>, Option<String>, Option<String>);

fn options((_, cutoff, detrend, window): &Treatment) -> PyResult<Options> {
    let detrend = match detrend.as_deref() {
        None => None,
        Some("mean") => Some(Detrend::Mean),
        Some("plane") => Some(Detrend::Plane),
        Some("quadratic") => Some(Detrend::Quadratic),
        Some(_) => return Err(errors::refused("detrend", "must be mean, plane or quadratic")),
    };
    let window = match window.as_deref() {
        None | Some("hann") => Window::Hann,
        Some("none") => Window::None,
        Some(_) => return Err(errors::refused("window", "must be hann or none")),
    };
    Ok(Options { cutoff: *cutoff, detrend, window })
}

fn characterized(
    py: Python<'_>,
    place: String,
    topography: impl FnOnce() -> Result<Topography, String> + Send,
    options: &Options,
) -> PyResult<Characterization> {
    let found =
        py.detach(|| topography().and_then(|topography| characterize::characterize(topography, options)));
    match found {
        Ok(found) => {
            let name = Path::new(&place).file_name().unwrap_or_default().to_string_lossy().into_owned();
            Ok(Characterization { found, place, name })
        }
        Err(reason) => Err(errors::input(format!("{place}: {reason}"), Some(&place), None, reason)),
    }
}

/// As `roughsurface characterize`.
#[pyfunction]
pub fn characterize_file(
    py: Python<'_>,
    path: PathBuf,
    pixel: Option<f64>,
    unit: Option<f64>,
    treatment: Treatment,
) -> PyResult<Characterization> {
    let options = options(&treatment)?;
    let read = || {
        let topography = readers::read(&path, &Reading { unit, pixel });
        let mut topography = topography.map_err(|TopographyError { what, .. }| what)?;
        topography.periodic |= treatment.0;
        Ok(topography)
    };
    characterized(py, path.display().to_string(), read, &options)
}

/// The same of heights in memory, m, with the distances between rows and between points of a row, m.
#[pyfunction]
pub fn characterize_heights(
    py: Python<'_>,
    name: String,
    heights: PyReadonlyArray2<'_, f64>,
    pixel: (f64, f64),
    treatment: Treatment,
) -> PyResult<Characterization> {
    let options = options(&treatment)?;
    let heights = heights.as_array();
    let (rows, columns) = heights.dim();
    let topography = Topography {
        periodic: treatment.0,
        ..Topography::map((rows, pixel.0), (columns, pixel.1), heights.iter().copied().collect())
    };
    characterized(py, name, || readers::checked(topography), &options)
}

#[pymethods]
impl Characterization {
    fn json(&self) -> String {
        characterization::json(&self.found).to_string()
    }

    /// As `--other-face`.
    fn on(&self, other: &Self) -> PyResult<Self> {
        let Self { found, place, name } = self;
        let found = on_each_other(found.clone(), other.found.clone())
            .map_err(|reason| errors::input(format!("{place}: {reason}"), Some(place), None, reason))?;
        Ok(Self { found, place: place.clone(), name: format!("{name} on {}", other.name) })
    }

    fn text(&self) -> String {
        characterization::text(&self.found)
    }

    fn warnings(&self) -> Vec<String> {
        self.found.warnings.iter().map(ToString::to_string).collect()
    }

    /// The surface file; `heights` is the name of the file of heights of the summits found, where these are chosen.
    fn surface_file(&self, heights: Option<&str>) -> String {
        characterization::surface_file(&self.found, &self.name, heights)
    }

    fn heights_file(&self) -> String {
        characterization::heights_file(&self.found)
    }

    fn figure(&self, panels: Vec<String>) -> PyResult<Figure> {
        Figure::new(characterization::figure(&self.found), &panels)
    }
}

/// What is slid: a surface or a characterised topography, a table, and the query.
#[derive(FromPyObject)]
pub struct Question<'py> {
    surface: Option<Given>,
    measured: Option<Bound<'py, Characterization>>,
    table: String,
    pressure: Option<Numbers>,
    separation: Option<Numbers>,
    slip_rate: Option<Numbers>,
    overrides: Vec<String>,
    allow_missing: bool,
    extrapolate: bool,
    tolerance: Option<f64>,
}

impl Question<'_> {
    fn overrides(&mut self) -> PyResult<Vec<Override>> {
        let parsed = self
            .overrides
            .iter()
            .map(|text| text.parse::<Override>().map_err(|reason| errors::refused(text, reason)));
        let mut overrides = parsed.collect::<PyResult<Vec<Override>>>()?;
        let values = |given: &mut Option<Numbers>, key, units| {
            given.take().map(|numbers| numbers.values(key, units)).transpose()
        };
        let pressure = values(&mut self.pressure, "query.pressure", &units::PRESSURE)?;
        let separation = values(&mut self.separation, "query.separation", &units::LENGTH)?;
        let slip_rate = values(&mut self.slip_rate, "query.slip_rate", &units::SLIP_RATE)?;
        overrides.extend(query_values(pressure.as_ref(), separation.as_ref(), slip_rate.as_ref()));
        Ok(overrides)
    }

    fn settings(&self) -> Settings {
        let usual = Settings::default();
        Settings {
            extrapolate: self.extrapolate,
            tolerance: self.tolerance.unwrap_or(usual.tolerance),
            ..usual
        }
    }

    fn case(mut self) -> PyResult<Case> {
        let overrides = self.overrides()?;
        let file = match (&self.measured, self.surface.take()) {
            (Some(measured), _) => {
                let Characterization { found, place, name } = measured.get();
                surface_of(found, (Path::new(place), name), &overrides)
            }
            (None, Some(given)) if given.is_path() => {
                SurfaceFile::read_with(given.content.as_ref(), &overrides)
            }
            (None, Some(Given { kind, content })) => {
                SurfaceFile::parse_with(kind.as_ref(), content, &overrides)
            }
            (None, None) => return Err(errors::refused("surface", "is missing")),
        };
        let measured = self.measured.as_ref().map(|measured| measured.get().found.clone());
        let file = file.map_err(errors::of_surface)?;
        Case::open(file, measured, &self.table, self.allow_missing).map_err(errors::of_law)
    }
}

/// What a result was made from.
struct Sources {
    surface: String,
    table: String,
    /// Files of heights and tables that the surface file names.
    inputs: Vec<PathBuf>,
}

impl Sources {
    fn of(Case { file, table, .. }: Case) -> Self {
        let tables = file.uncertain_tables.into_iter().map(|(_, table)| table);
        Self { inputs: tables.chain(file.heights_file).collect(), surface: file.text, table }
    }

    fn origin<'a>(&'a self, history: &'a str) -> Origin<'a> {
        Origin { surface: &self.surface, table: &self.table, history }
    }
}

/// Friction of a surface.
#[pyclass(frozen, module = "asperity._core")]
pub struct Friction {
    results: Results,
    sources: Sources,
}

/// As `roughsurface predict`.
#[pyfunction]
pub fn predict(
    py: Python<'_>,
    question: Question<'_>,
    compare: Vec<String>,
    threads: Option<usize>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Friction> {
    let settings = question.settings();
    let case = question.case()?;
    let results = followed(py, threads, progress.as_ref(), |follower| {
        case.predict(&compare, &settings, &|done, total| follower.counted("slips", done, total))
    })?;
    let results = results.map_err(errors::of_case)?;
    Ok(Friction { results, sources: Sources::of(case) })
}

#[pymethods]
impl Friction {
    fn inputs(&self) -> Vec<PathBuf> {
        self.sources.inputs.clone()
    }

    fn json(&self) -> String {
        summary_json::json(&self.results).to_string()
    }

    fn text(&self) -> String {
        summary::text(&self.results)
    }

    fn warnings(&self) -> Vec<String> {
        Warning::condensed(&self.results.prediction.warnings)
    }

    fn write(&self, py: Python<'_>, path: PathBuf, command: &str) -> PyResult<()> {
        let history = history(command);
        py.detach(|| friction_file::write(&path, &self.results, &self.sources.origin(&history)))
            .map_err(|error| errors::failed(error, None))
    }

    fn report(&self, command: &str) -> String {
        report::html(&self.results, &self.sources.origin(&history(command)))
    }

    fn figure(&self, panels: Vec<String>) -> PyResult<Figure> {
        Figure::new(figure(&self.results), &panels)
    }
}

/// Friction of finite surfaces.
#[pyclass(frozen, module = "asperity._core")]
pub struct Samples {
    samples: finite_surface::Samples,
    sources: Sources,
}

/// As `roughsurface sample`.
#[pyfunction]
pub fn sample(
    py: Python<'_>,
    question: Question<'_>,
    drawn: (usize, usize, u64),
    slip: Option<f64>,
    threads: Option<usize>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Samples> {
    let (asperities, realizations, seed) = drawn;
    let sampling = finite_surface::Sampling { asperities, realizations, seed, slip };
    let settings = question.settings();
    let case = question.case()?;
    let samples = followed(py, threads, progress.as_ref(), |follower| {
        let show = |done, total| follower.counted("surfaces", done, total);
        case.sample(&sampling, &settings, &show)
    })?;
    let samples = samples.map_err(errors::of_prediction)?;
    Ok(Samples { samples, sources: Sources::of(case) })
}

#[pymethods]
impl Samples {
    fn inputs(&self) -> Vec<PathBuf> {
        self.sources.inputs.clone()
    }

    fn json(&self) -> String {
        sample_file::json(&self.samples).to_string()
    }

    fn text(&self) -> String {
        sample_file::text(&self.samples)
    }

    fn warnings(&self) -> Vec<String> {
        Warning::condensed(&self.samples.warnings)
    }

    fn write(&self, py: Python<'_>, path: PathBuf, command: &str) -> PyResult<()> {
        let history = history(command);
        py.detach(|| sample_file::write(&path, &self.samples, &self.sources.origin(&history)))
            .map_err(|error| errors::failed(error, None))
    }
}
