//! `report.nc`: the sweep as CF netCDF-4.

use std::path::Path;

use tables::netcdf::{DatasetError, DatasetWriter, described};

use super::{Convergence, Run, SHOWN};
use crate::output::provenance::SOURCE;
use crate::scene::Scene;
use crate::scene::file::write_scene;

/// Name, unit, long name, value.
type Column = (&'static str, &'static str, &'static str, fn(&Run) -> f64);

/// Title of the file.
pub const TITLE: &str = "Speed against error of one scene";

/// Write the file; it appears whole or not at all.
pub fn write(
    path: &Path,
    scene: &Scene,
    convergence: &Convergence,
    history: &str,
) -> Result<(), DatasetError> {
    let mut file = DatasetWriter::create(path, TITLE)?;
    file.attribute("source", SOURCE)?;
    file.attribute("history", history)?;
    file.attribute("scene", write_scene(scene))?;
    let runs = &convergence.runs;
    file.dimension("run", runs.len())?;
    #[rustfmt::skip]
    let columns: [Column; 5] = [
        ("elements_per_radius", "1", "elements per contact radius", |run| run.elements_per_radius as f64),
        ("sectors", "1", "angles over the half circle", |run| run.sectors as f64),
        ("steps", "1", "increments of the slide", |run| run.steps as f64),
        ("wall_time", "s", "wall-clock time with auxiliary runs", |run| run.wall_time),
        ("cpu_time", "s", "processor time of all threads with auxiliary runs", |run| run.cpu_time),
    ];
    for (name, unit, long_name, of) in columns {
        let values: Vec<f64> = runs.iter().map(of).collect();
        file.reals(name, &["run"], &values, &described(unit, long_name))?;
    }
    let chosen: Vec<i8> = runs.iter().map(|run| run.chosen.into()).collect();
    let meaning = [("long_name", "whether the scene chose the resolution".into())];
    file.flags("chosen", &["run"], &chosen, &["sweep", "chosen"], &meaning)?;
    for quantity in SHOWN {
        let descriptor = quantity.descriptor();
        let (name, unit) = (descriptor.name, descriptor.units);
        let limit = convergence.limit(quantity);
        let values: Vec<f64> = runs.iter().map(|run| run.scalars[quantity].value).collect();
        let estimates: Vec<f64> = runs.iter().map(|run| run.scalars[quantity].error).collect();
        let errors: Vec<f64> = values.iter().map(|value| value - limit.value).collect();
        file.reals(name, &["run"], &values, &described(unit, descriptor.long_name))?;
        let long_name = format!("difference of {name} from its limit");
        file.reals(&format!("{name}_difference"), &["run"], &errors, &described(unit, &long_name))?;
        let long_name = format!("estimated absolute error of {name}");
        file.reals(&format!("{name}_error"), &["run"], &estimates, &described(unit, &long_name))?;
        let scalars = [
            ("limit", unit, limit.value, "limit of fine meshes"),
            ("limit_uncertainty", unit, limit.uncertainty, "distance of the limit from the finest run"),
            ("order", "1", limit.order.unwrap_or(f64::NAN), "observed order in the element size"),
        ];
        for (suffix, unit, value, long_name) in scalars {
            let attributes = described(unit, &format!("{name}: {long_name}"));
            file.reals(&format!("{name}_{suffix}"), &[], &[value], &attributes)?;
        }
    }
    file.finish()
}
