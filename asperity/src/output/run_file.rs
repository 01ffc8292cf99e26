//! `run.nc`: the histories, scalars and contact-plane fields of one run as CF netCDF-4.
//!
//! Apart from `wall_time`, `time_spent` and `history`, two runs of one scene give the same file.

use std::path::Path;

use tables::netcdf::{DatasetError, DatasetWriter, described};
use tables::numbers::plain;
use tables::quantity::{Estimate, History, Quantity, Stored};

use crate::output::provenance::SOURCE;
use crate::scene::Scene;
use crate::scene::file::write_scene;
use crate::simulate::accuracy::correction::is_corrected;
use crate::simulate::derived;
use crate::simulate::outcome::{Account, ContactStatus, ErrorSource, InceptionCriterion, Outcome, Snapshot};
use crate::solver::timings::Kernel;

/// Provenance and completion of a run.
pub struct About<'a> {
    /// For the attribute `history`, see [`crate::output::provenance::history`].
    pub history: String,
    /// Why the run ended before its end, if it did.
    pub incomplete: Option<&'a str>,
}

/// `completion` of a run to its end.
pub const COMPLETE: &str = "complete";

/// Dimension of the errors by source.
const ERROR_SOURCE: &str = "error_source";

type Field = (&'static str, &'static str, &'static str, fn(&Snapshot) -> &Vec<f64>);

const FIELDS: [Field; 4] = [
    ("pressure", "Pa", "contact pressure", |s| &s.pressure),
    ("shear", "Pa", "magnitude of the tangential traction", |s| &s.shear),
    ("temperature", "K", "temperature of the contact plane", |s| &s.temperature),
    (
        "slip_distance",
        "m",
        "accumulated slip of the contact point on the flat since the end of the press",
        |s| &s.slip_distance,
    ),
];

/// Beginning of the title of the file.
pub const TITLE: &str = "Sliding of one asperity";

/// Write the file; it appears whole or not at all.
pub fn write(path: &Path, scene: &Scene, outcome: &Outcome, about: &About<'_>) -> Result<(), DatasetError> {
    let loading = &scene.loading;
    let rates = match loading.steps.is_empty() {
        true => format!("and {} m/s", loading.slip_rate),
        false => format!("through {} steps of slip rate", loading.steps.len()),
    };
    let title = format!("{TITLE} at {} omega_c {rates}", plain(outcome.interference));
    let completion = match about.incomplete {
        None => COMPLETE.to_owned(),
        Some(reason) => format!("incomplete: {reason}"),
    };
    let mut file = DatasetWriter::create(path, &title)?;
    file.attribute("source", SOURCE)?;
    file.attribute("history", about.history.as_str())?;
    file.attribute("scene", write_scene(scene))?;
    file.attribute("completion", completion)?;
    file.attribute("notes", lines(&outcome.account.notes))?;
    file.attribute("warnings", lines(&outcome.account.warnings))?;
    columns(&mut file, "step_press", &outcome.press, &[Quantity::InterferencePress])?;
    columns(&mut file, "step", &outcome.slide, &[Quantity::Slip, Quantity::SlipAccumulated, Quantity::Time])?;
    estimates(&mut file, scene, outcome)?;
    account(&mut file, outcome)?;
    fields(&mut file, outcome)?;
    file.finish()
}

/// One sentence a line.
fn lines<T: ToString>(sentences: &[T]) -> String {
    sentences.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

/// One variable per column over `dimension`.
fn columns(
    file: &mut DatasetWriter,
    dimension: &str,
    history: &History,
    coordinates: &[Quantity],
) -> Result<(), DatasetError> {
    // netCDF takes a length of zero for an unlimited dimension.
    if history.is_empty() {
        return Ok(());
    }
    file.dimension(dimension, history.len())?;
    let names: Vec<&str> = coordinates.iter().map(|quantity| quantity.descriptor().name).collect();
    for (quantity, values) in history.iter() {
        let descriptor = quantity.descriptor();
        let mut attributes = described(descriptor.units, descriptor.long_name);
        if !coordinates.contains(&quantity) {
            attributes.push(("coordinates", names.join(" ").into()));
        }
        file.reals(descriptor.name, &[dimension], values, &attributes)?;
    }
    Ok(())
}

/// Scalars with their errors, also by source.
fn estimates(file: &mut DatasetWriter, scene: &Scene, outcome: &Outcome) -> Result<(), DatasetError> {
    let sources = ErrorSource::ALL.map(ErrorSource::name);
    file.dimension(ERROR_SOURCE, sources.len())?;
    let attributes = [("long_name", "source of the error".into())];
    file.texts(ERROR_SOURCE, &[ERROR_SOURCE], &sources, &attributes)?;
    for (quantity, estimate) in outcome.scalars.iter() {
        let descriptor = quantity.descriptor();
        // A history, where there is one, has the name of the quantity itself.
        let (name, long_name) = match descriptor.history {
            Stored::No => (descriptor.name.to_owned(), descriptor.long_name.to_owned()),
            _ => (
                format!("{}_end", descriptor.name),
                format!("{}, {}", descriptor.long_name, descriptor.moment),
            ),
        };
        let error_name = format!("{}_error", descriptor.name);
        let by_source = format!("{error_name}_by_source");
        let ancillary = format!("{error_name} {by_source}");
        let origin = match quantity {
            Quantity::MuSteady => {
                "of the slide, or of its continuation, see notes; extrapolated with 1/sqrt(slip) and corrected as mu is"
            }
            quantity if is_corrected(quantity, outcome.inception, &scene.interface.law) => {
                "of the finest mesh, corrected for its mean discretisation error"
            }
            _ => "of the finest mesh, not extrapolated",
        };
        scalar(file, (&name, &error_name, &ancillary), descriptor.units, &long_name, estimate, origin)?;
        let attributes =
            described(descriptor.units, &format!("parts of {error_name} by source, whose squares add up"));
        let parts = ErrorSource::ALL.map(|source| outcome.budget.part(source, quantity));
        file.reals(&by_source, &[ERROR_SOURCE], &parts, &attributes)?;
    }
    for (name, unit, long_name, estimate) in derived::of_run(scene, outcome) {
        let error_name = format!("{name}_error");
        let origin = "from other results of the run";
        scalar(file, (name, &error_name, &error_name), unit, long_name, estimate, origin)?;
    }
    Ok(())
}

/// A value and its error, the names of the variables with its errors, and how the value was obtained.
fn scalar(
    file: &mut DatasetWriter,
    (name, error_name, ancillary): (&str, &str, &str),
    unit: &str,
    long_name: &str,
    Estimate { value, error }: Estimate,
    origin: &str,
) -> Result<(), DatasetError> {
    let mut attributes = described(unit, long_name);
    attributes.push(("comment", origin.into()));
    attributes.push(("ancillary_variables", ancillary.into()));
    file.reals(name, &[], &[value], &attributes)?;
    let attributes = described(unit, &format!("half-width of the 95 % interval of {name}"));
    file.reals(error_name, &[], &[error], &attributes)
}

/// Choices of the run and its cost.
fn account(file: &mut DatasetWriter, outcome: &Outcome) -> Result<(), DatasetError> {
    let account = &outcome.account;
    #[rustfmt::skip]
    let numbers = [
        ("critical_interference", "m", "interference of first yield, omega_c", outcome.critical_interference),
        ("wall_time", "s", "wall-clock time of the run", account.wall_time),
        ("elements_per_radius", "1", "elements per contact radius", account.elements_per_radius as f64),
        ("sectors", "1", "sectors of the half circle", account.sectors as f64),
        ("unknowns", "1", "unknown displacements", account.unknowns as f64),
        ("steps", "1", "steps of the slide", account.steps as f64),
        ("cutbacks", "1", "steps repeated at a smaller size", account.cutbacks as f64),
        ("newton_iterations", "1", "Newton iterations", account.newton_iterations as f64),
        ("press_newton_iterations", "1", "Newton iterations of the press", account.press_newton_iterations as f64),
        ("krylov_iterations", "1", "Krylov iterations", account.krylov_iterations as f64),
        ("line_searches", "1", "Newton iterations with a line search", account.line_searches as f64),
    ];
    for (name, unit, long_name, value) in numbers {
        file.reals(name, &[], &[value], &described(unit, long_name))?;
    }
    time_spent(file, account)?;
    flags(file, outcome)
}

/// Time of each part of the run; that of writing the file is not known.
fn time_spent(file: &mut DatasetWriter, account: &Account) -> Result<(), DatasetError> {
    let kernels: Vec<Kernel> = Kernel::ALL.into_iter().filter(|&k| k != Kernel::Output).collect();
    let names: Vec<&str> = kernels.iter().map(|kernel| kernel.name()).collect();
    let seconds: Vec<f64> = kernels.iter().map(|&kernel| account.timings.of(kernel)).collect();
    file.dimension("kernel", kernels.len())?;
    file.texts("kernel_name", &["kernel"], &names, &[("long_name", "part of the run".into())])?;
    let mut attributes =
        described("s", "time of the main run by part; auxiliary_runs is that of all other runs and presses");
    attributes.push(("coordinates", "kernel_name".into()));
    file.reals("time_spent", &["kernel"], &seconds, &attributes)
}

fn flags(file: &mut DatasetWriter, outcome: &Outcome) -> Result<(), DatasetError> {
    let account = &outcome.account;
    let criterion = match outcome.inception {
        InceptionCriterion::FullSlip => 0,
        InceptionCriterion::Stiffness => 1,
        InceptionCriterion::None => 2,
        InceptionCriterion::AtOnce => 3,
    };
    let yes_no = ["no", "yes"];
    #[rustfmt::skip]
    let flags: [(&str, &str, i8, &[&str]); 4] = [
        ("inception_criterion", "criterion of sliding inception that was met first", criterion,
            &["full_slip", "stiffness", "none", "at_once"]),
        ("levelled", "whether the friction coefficient is steady at the end of the slide",
            outcome.steady.into(), &yes_no),
        ("heat", "whether heat was simulated", account.heat.into(), &yes_no),
        ("finite_strain", "whether finite strain was simulated", account.finite_strain.into(), &yes_no),
    ];
    for (name, long_name, value, meanings) in flags {
        file.flags(name, &[], &[value], meanings, &[("long_name", long_name.into())])?;
    }
    Ok(())
}

/// Fields over the contact plane, one snapshot after the other.
fn fields(file: &mut DatasetWriter, outcome: &Outcome) -> Result<(), DatasetError> {
    let (grid, snapshots) = (&outcome.grid, &outcome.snapshots);
    if snapshots.is_empty() || grid.theta.is_empty() || grid.r.is_empty() {
        return Ok(());
    }
    let slips: Vec<f64> = snapshots.iter().map(|snapshot| snapshot.slip).collect();
    file.dimension("snapshot", slips.len())?;
    let attributes = described("m", "displacement of the flat at the snapshot");
    file.reals("snapshot_slip", &["snapshot"], &slips, &attributes)?;
    let times: Vec<f64> = snapshots.iter().map(|snapshot| snapshot.time).collect();
    let attributes = described("s", "time of the snapshot since the start of the slide");
    file.reals("snapshot_time", &["snapshot"], &times, &attributes)?;
    let attributes = described("rad", "angle from the direction in which the flat moves");
    file.coordinate("theta", &grid.theta, &attributes)?;
    file.coordinate("r", &grid.r, &described("m", "distance from the axis"))?;
    for (name, unit, long_name, of) in FIELDS {
        let values: Vec<f64> = snapshots.iter().flat_map(|s| of(s).iter().copied()).collect();
        let mut attributes = described(unit, long_name);
        attributes.push(("coordinates", "snapshot_slip snapshot_time".into()));
        file.reals(name, &["snapshot", "theta", "r"], &values, &attributes)?;
    }
    let status = |status: &ContactStatus| match status {
        ContactStatus::Open => 0,
        ContactStatus::Stick => 1,
        ContactStatus::Slip => 2,
    };
    let values: Vec<i8> = snapshots.iter().flat_map(|s| s.status.iter().map(status)).collect();
    let attributes = [
        ("long_name", "what each contact point does".into()),
        ("coordinates", "snapshot_slip snapshot_time".into()),
    ];
    let meanings = ["open", "stick", "slip"];
    file.flags("contact_status", &["snapshot", "theta", "r"], &values, &meanings, &attributes)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::file::parse_scene;
    use crate::simulate::fake;

    /// The file of an outcome, by itself in a folder.
    fn written(scene: &Scene, outcome: &Outcome) -> (tempfile::TempDir, std::path::PathBuf) {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("run.nc");
        let about = About { history: "2000-01-01T00:00:00Z: test".into(), incomplete: None };
        write(&path, scene, outcome, &about).unwrap();
        (directory, path)
    }

    #[test]
    fn file_has_the_variables_and_attributes_of_the_contract() {
        let scene = fake::scene(20.0, 1.0);
        let outcome = fake::outcome(&scene);
        let (_directory, path) = written(&scene, &outcome);
        let file = netcdf::open(path).unwrap();
        let dimensions = |name: &str| -> Vec<String> {
            let variable = file.variable(name).unwrap_or_else(|| panic!("no {name}"));
            assert!(variable.attribute("long_name").is_some(), "{name}");
            variable.dimensions().iter().map(|d| d.name()).collect()
        };
        for name in
            "slip time Q P mu area stick_fraction strength_mobilised temperature_max temperature_mean \
                     plastic_strain_max work energy_elastic dissipation_plastic \
                     dissipation_friction heat_in"
                .split_whitespace()
        {
            assert_eq!(dimensions(name), ["step"], "{name}");
        }
        assert_eq!(dimensions("time_spent"), ["kernel"]);
        for name in ["interference_press", "P_press", "area_press"] {
            assert_eq!(dimensions(name), ["step_press"]);
        }
        for name in "mu_static mu_peak mu_mean mu_mean_error mu_steady Q_static G G_weakening contact_radius wall_time \
                     mu_static_error G_error mu_error Q_error P_error"
            .split_whitespace()
        {
            assert!(dimensions(name).is_empty(), "{name}");
        }
        for (quantity, _) in outcome.scalars.iter() {
            let name = format!("{}_error", quantity.descriptor().name);
            let by_source = format!("{name}_by_source");
            assert_eq!(dimensions(&by_source), ["error_source"]);
            let parts: Vec<f64> = file.variable(&by_source).unwrap().get_values(..).unwrap();
            assert_eq!(parts, ErrorSource::ALL.map(|source| outcome.budget.part(source, quantity)));
        }
        let sources = file.variable("error_source").unwrap();
        let sources: Vec<String> = (0..5).map(|k| sources.get_string([k]).unwrap()).collect();
        assert_eq!(sources, ["mesh", "sectors", "steps", "solver", "model"]);
        for name in ["pressure", "shear", "temperature", "slip_distance", "contact_status"] {
            assert_eq!(dimensions(name), ["snapshot", "theta", "r"]);
        }
        let text = |name: &str| match file.attribute(name).unwrap().value().unwrap() {
            tables::netcdf::AttributeValue::Str(text) => text,
            other => panic!("{name}: {other:?}"),
        };
        assert_eq!(text("Conventions"), "CF-1.11");
        assert_eq!(text("completion"), "complete");
        assert_eq!(text("warnings"), lines(&outcome.account.warnings));
        assert_eq!(parse_scene(&text("scene"), "attribute", &[]).unwrap(), scene);
        let slip: Vec<f64> = file.variable("slip").unwrap().get_values(..).unwrap();
        assert_eq!(slip, outcome.slide.column(Quantity::Slip));
    }

    #[test]
    fn energy_is_related_to_the_fracture_energy() {
        let mut scene = fake::scene(20.0, 1.0);
        let outcome = fake::outcome(&scene);
        scene.material.fracture = Some(crate::scene::FractureData::Energy { shear_fracture_energy: 500.0 });
        let (_directory, path) = written(&scene, &outcome);
        let file = netcdf::open(path).unwrap();
        let value = |name: &str| file.variable(name).unwrap().get_value::<f64, _>(..).unwrap();
        assert_eq!((value("G_IIc"), value("G_IIc_error")), (500.0, 0.0));
        assert_eq!(value("G_ratio"), value("G") / 500.0);
        assert_eq!(value("G_ratio_error"), value("G_error") / 500.0);
    }

    #[test]
    fn two_files_of_one_outcome_are_the_same_bytes_and_leave_nothing_else() {
        let scene = fake::scene(20.0, 1.0);
        let outcome = fake::outcome(&scene);
        let [first, second] = [(); 2].map(|()| {
            let (directory, path) = written(&scene, &outcome);
            assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 1);
            std::fs::read(path).unwrap()
        });
        assert_eq!(first, second);
    }

    #[test]
    fn a_run_that_failed_at_once_still_gives_a_file() {
        let scene = fake::scene(20.0, 1.0);
        let mut outcome = fake::outcome(&scene);
        outcome.slide.truncate(0);
        outcome.snapshots.clear();
        let (_directory, path) = written(&scene, &outcome);
        let file = netcdf::open(path).unwrap();
        assert!(file.variable("mu").is_none());
        assert!(file.variable("P_press").is_some());
    }
}
