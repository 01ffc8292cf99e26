//! Errors of the libraries as exceptions of the package: what was refused, where, and why.

use asperity::scene::file::SceneFileError;
use pyo3::prelude::*;
use roughsurface::friction::PredictionError;
use roughsurface::integral::law_source::LawSourceError;
use roughsurface::integral::separation::SeparationError;
use roughsurface::sampling::case::CaseError;
use roughsurface::surface::file::SurfaceFileError;
use tables::law::LookupError;

/// `InputError`: bad input, with the file and the key that it is about, if there are.
pub fn input(message: impl ToString, file: Option<&str>, key: Option<&str>, reason: impl ToString) -> PyErr {
    Python::attach(|py| {
        let made = (py.import("asperity._errors"))
            .and_then(|errors| errors.getattr("InputError"))
            .and_then(|class| class.call1((message.to_string(), file, key, reason.to_string())));
        made.map_or_else(|error| error, PyErr::from_value)
    })
}

/// `InputError` about a key, or an argument of that name.
pub fn refused(key: &str, reason: impl ToString) -> PyErr {
    let reason = reason.to_string();
    input(format!("{key}: {reason}"), None, Some(key), reason)
}

/// `RunError`: a computation failed; `run` is the `Run` with the steps before the failure.
pub fn failed(reason: impl ToString, run: Option<Py<PyAny>>) -> PyErr {
    Python::attach(|py| {
        let made = (py.import("asperity._errors"))
            .and_then(|errors| errors.getattr("RunError"))
            .and_then(|class| class.call1((reason.to_string(), run)));
        made.map_or_else(|error| error, PyErr::from_value)
    })
}

pub fn of_scene(error: SceneFileError) -> PyErr {
    let message = error.to_string();
    // The file without the line, which is in the message.
    let of = |location: &str| location.rsplit_once(": line ").map_or(location, |(file, _)| file).to_owned();
    match &error {
        SceneFileError::Unreadable { file, reason } => input(&message, Some(file), None, reason),
        SceneFileError::Syntax { file, line, reason } => {
            input(&message, Some(file), None, format!("line {line}: {reason}"))
        }
        SceneFileError::Override { text, reason } => input(&message, None, Some(text), reason),
        SceneFileError::UnknownKey { location, key, hint } => {
            input(&message, Some(&of(location)), Some(key), format!("unknown key; {hint}"))
        }
        SceneFileError::Missing { location, key, allowed } => {
            input(&message, Some(&of(location)), Some(key), format!("is missing; it must be {allowed}"))
        }
        SceneFileError::Invalid { location, key, value, allowed } => {
            input(&message, Some(&of(location)), Some(key), format!("{value} must be {allowed}"))
        }
    }
}

pub fn of_surface(error: SurfaceFileError) -> PyErr {
    let message = error.to_string();
    match &error {
        SurfaceFileError::Unreadable { file, reason } => {
            input(&message, Some(&file.display().to_string()), None, reason)
        }
        SurfaceFileError::Content { file, what, .. } => {
            input(&message, Some(&file.display().to_string()), error.key(), what)
        }
    }
}

pub fn of_law(error: LawSourceError) -> PyErr {
    let key = match error {
        LawSourceError::NoMaterial { .. } => "material",
        LawSourceError::NoTemperature { .. } => "query.temperature",
        _ => "table",
    };
    input(&error, None, Some(key), &error)
}

pub fn of_lookup(error: &LookupError) -> PyErr {
    let key = match error {
        LookupError::ContactTooLarge { .. } => Some("interference"),
        LookupError::SlipRateOutside { .. } | LookupError::NoSlipRateInCommon { .. } => Some("slip_rate"),
        LookupError::RadiusFixed { .. } => Some("radius"),
        LookupError::Missing { .. } => None,
    };
    input(error, None, key, error)
}

/// As the programs: a query that the table does not cover is bad input, a separation that is not found a failure.
pub fn of_prediction(error: PredictionError) -> PyErr {
    match &error {
        PredictionError::Lookup(lookup) | PredictionError::Separation(SeparationError::Lookup(lookup)) => {
            of_lookup(lookup)
        }
        PredictionError::Separation(
            SeparationError::NotFound { .. } | SeparationError::NoMeanPlane { .. },
        )
        | PredictionError::NotFinite { .. } => failed(&error, None),
        PredictionError::ContactsTooLarge { .. } => input(&error, None, Some("query.pressure"), &error),
        _ => input(&error, None, None, &error),
    }
}

pub fn of_case(error: CaseError) -> PyErr {
    match error {
        CaseError::Prediction(error) => of_prediction(error),
        CaseError::Uncertainty(error) => input(&error, None, Some("uncertainty"), &error),
    }
}
