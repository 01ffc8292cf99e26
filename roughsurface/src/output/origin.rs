//! Common parts of the NetCDF files: attributes of provenance, coordinates, variables with their errors.

use crate::surface::query::{NormalLoading, Query};
use clap::ValueEnum;
use tables::law::Estimate;
use tables::netcdf::{DatasetError, DatasetWriter, described};

/// Origin of a result, as written to the global attributes.
#[derive(Clone, Debug)]
pub struct Origin<'a> {
    /// Text of the surface file.
    pub surface: &'a str,
    /// The table as given: file, shipped name or `model:NAME`.
    pub table: &'a str,
    /// Time and command that made the result, see [`tables::netcdf::history`].
    pub history: &'a str,
}

impl Origin<'_> {
    /// Writes the global attributes and warnings that every file has.
    pub(super) fn write(
        &self,
        file: &mut DatasetWriter,
        law: &str,
        query: &Query,
        warnings: &[impl ToString],
    ) -> Result<(), DatasetError> {
        for (name, value) in [
            ("source", concat!("roughsurface ", env!("CARGO_PKG_VERSION"))),
            ("history", self.history),
            ("surface", self.surface),
            ("table", self.table),
            ("law", law),
            ("hold", name(query.control).as_str()),
            ("contact_life", query.contact_life.to_string().as_str()),
            ("interaction", name(query.interaction).as_str()),
        ] {
            file.attribute(name, value)?;
        }
        if !warnings.is_empty() {
            let warnings: Vec<String> = warnings.iter().map(ToString::to_string).collect();
            file.attribute("warnings", warnings.join("\n").as_str())?;
        }
        Ok(())
    }
}

/// The value of a key of the surface file.
fn name(choice: impl ValueEnum) -> String {
    choice.to_possible_value().expect("every choice has a name").get_name().to_owned()
}

/// Writes the coordinates of pressures or separations and of slip rates; returns the name of the former.
pub(super) fn grid_coordinates(
    file: &mut DatasetWriter,
    query: &Query,
) -> Result<&'static str, DatasetError> {
    let (row, unit, long_name) = match query.loading {
        NormalLoading::Pressure(_) => ("pressure", "Pa", "nominal pressure before the slide"),
        NormalLoading::Separation(_) => (
            "separation",
            "m",
            "distance of the flat from the reference plane of the heights before the slide",
        ),
    };
    coordinate(file, row, query.loading.values(), (unit, long_name), "Z")?;
    coordinate(file, "slip_rate", &query.slip_rates, ("m s-1", "slip rate"), "Y")?;
    Ok(row)
}

/// A coordinate with its axis. By the CF conventions a coordinate in units of pressure is a vertical axis, to the right
/// of which only other axes may stand.
pub(super) fn coordinate(
    file: &mut DatasetWriter,
    name: &str,
    values: &[f64],
    (unit, long_name): (&str, &str),
    axis: &str,
) -> Result<(), DatasetError> {
    let mut attributes = described(unit, long_name);
    attributes.push(("axis", axis.into()));
    file.coordinate(name, values, &attributes)
}

/// A variable and, named in its `ancillary_variables`, the one of its errors.
pub(super) fn with_error(
    file: &mut DatasetWriter,
    name: &str,
    dimensions: &[&str],
    (unit, long_name): (&str, &str),
    estimates: &[Estimate],
) -> Result<(), DatasetError> {
    let error_name = format!("{name}_error");
    let mut attributes = described(unit, long_name);
    attributes.push(("ancillary_variables", error_name.as_str().into()));
    let (values, errors): (Vec<f64>, Vec<f64>) = estimates.iter().map(|e| (e.value, e.error)).unzip();
    file.reals(name, dimensions, &values, &attributes)?;
    let error_long_name = format!("estimated absolute error of the {long_name}");
    file.reals(&error_name, dimensions, &errors, &described(unit, &error_long_name))
}
