//! Predictions as CF netCDF files.

use crate::friction::regime::regime;
use crate::friction::{Friction, Prediction};
use crate::sampling::uncertainty::{OUTPUTS, Propagated};
use crate::surface::query::{Hold, Pressing, Query};
use std::path::Path;
use tables::law::Estimate;
use tables::netcdf::{AttributeValue, DatasetError, DatasetWriter};

/// A result over (pressure or separation, slip rate).
struct Quantity {
    name: &'static str,
    units: &'static str,
    long_name: &'static str,
    value: fn(&Friction) -> Estimate,
}

const UNKNOWN: Estimate = Estimate { value: f64::NAN, error: f64::NAN };

/// Every result with an error. To add an output: a line here.
const QUANTITIES: [Quantity; 18] = [
    Quantity {
        name: "mu",
        units: "1",
        long_name: "sliding friction coefficient at the end of the slide",
        value: |f| f.sliding.mu,
    },
    Quantity {
        name: "mu_static",
        units: "1",
        long_name: "friction coefficient where the friction-slip curve of the surface starts to slide",
        value: |f| f.mu_static,
    },
    Quantity {
        name: "inception_slip",
        units: "m",
        long_name: "slip at which static friction is reached",
        value: |f| f.inception_slip,
    },
    Quantity {
        name: "Q",
        units: "Pa",
        long_name: "friction stress on the nominal area at the end of the slide",
        value: |f| f.sliding.shear,
    },
    Quantity {
        name: "G_weakening",
        units: "J m-2",
        long_name: "energy of slip weakening per nominal area, from the peak of the friction stress to the end of the slide",
        value: |f| f.weakening_energy,
    },
    Quantity {
        name: "G",
        units: "J m-2",
        long_name: "energy that the asperities release from full stick to full slip per nominal area",
        value: |f| f.energy_release.unwrap_or(UNKNOWN),
    },
    Quantity {
        name: "G_weakening_real_area",
        units: "J m-2",
        long_name: "energy of slip weakening per real contact area at the end of the slide",
        value: Friction::weakening_of_real_area,
    },
    Quantity {
        name: "G_real_area",
        units: "J m-2",
        long_name: "energy that the asperities release from full stick to full slip per real contact area before the slide",
        value: |f| f.release_of_real_area().unwrap_or(UNKNOWN),
    },
    Quantity {
        name: "weakening_distance",
        units: "m",
        long_name: "slip-weakening distance, that of linear weakening with the same peak, end and energy of the friction stress",
        value: |f| f.weakening_distance,
    },
    Quantity {
        name: "dmu_dlnV",
        units: "1",
        long_name: "derivative of the sliding friction coefficient with respect to the logarithm of the slip rate",
        value: |f| f.rate_sensitivity,
    },
    Quantity {
        name: "separation",
        units: "m",
        long_name: "distance of the flat from the reference plane of the heights before the slide",
        value: |f| f.pressed.separation,
    },
    Quantity {
        name: "separation_sliding",
        units: "m",
        long_name: "distance of the flat from the reference plane of the heights at the end of the slide",
        value: |f| f.sliding.separation,
    },
    Quantity {
        name: "pressure",
        units: "Pa",
        long_name: "nominal pressure before the slide",
        value: |f| f.pressed.pressure,
    },
    Quantity {
        name: "pressure_sliding",
        units: "Pa",
        long_name: "nominal pressure at the end of the slide",
        value: |f| f.sliding.pressure,
    },
    Quantity {
        name: "real_area_fraction",
        units: "1",
        long_name: "real over nominal contact area at the end of the slide",
        value: |f| f.sliding.area_fraction,
    },
    Quantity {
        name: "real_area_fraction_press",
        units: "1",
        long_name: "real over nominal contact area before the slide",
        value: |f| f.pressed.area_fraction,
    },
    Quantity {
        name: "contact_density",
        units: "m-2",
        long_name: "asperities in contact per nominal area at the end of the slide",
        value: |f| f.sliding.contact_density,
    },
    Quantity {
        name: "contact_density_press",
        units: "m-2",
        long_name: "asperities in contact per nominal area before the slide",
        value: |f| f.pressed.contact_density,
    },
];

/// Where a prediction comes from, as written to the global attributes.
#[derive(Clone, Debug)]
pub struct Origin<'a> {
    /// Text of the surface file.
    pub surface: &'a str,
    /// The table as asked for: file, shipped name or `model:NAME`.
    pub table: &'a str,
    /// The command that made the prediction.
    pub command: &'a str,
}

impl Origin<'_> {
    /// Writes the global attributes that every file of this crate has.
    pub(crate) fn write(
        &self,
        file: &mut DatasetWriter,
        law: &str,
        query: &Query,
    ) -> Result<(), DatasetError> {
        let hold = match query.hold {
            Hold::Load => "load",
            Hold::Separation => "separation",
        };
        for (name, value) in [
            ("source", concat!("roughsurface ", env!("CARGO_PKG_VERSION"))),
            ("history", self.command),
            ("surface", self.surface),
            ("table", self.table),
            ("law", law),
            ("hold", hold),
        ] {
            file.attribute(name, value)?;
        }
        Ok(())
    }
}

/// Writes the coordinates of pressures or separations and of slip rates; returns the
/// name of the former.
pub(crate) fn grid_coordinates(
    file: &mut DatasetWriter,
    query: &Query,
) -> Result<&'static str, DatasetError> {
    let (row, units, long_name) = match query.pressing {
        Pressing::Pressure(_) => ("pressure", "Pa", "nominal pressure before the slide"),
        Pressing::Separation(_) => (
            "separation",
            "m",
            "distance of the flat from the reference plane of the heights before the slide",
        ),
    };
    file.coordinate(row, query.pressing.values(), &described(units, long_name))?;
    let rates = &query.slip_rates;
    file.coordinate("slip_rate", rates, &described("m s-1", "slip rate"))?;
    Ok(row)
}

const COMMENT: &str = "Greenwood-Williamson integration of one-asperity friction over summit heights. \
NAME_error is an estimate of the absolute error of NAME: error of the table with one sign in all \
asperities, quadrature, slip grid and pressure. Independent asperities of one radius, rigid smooth flat. \
Under held load the flat sinks as asperities lose load; each asperity then follows the slide tabulated \
at its present interference.";

/// Writes `friction.nc`: under a temporary name first, so the file appears whole or not at all.
pub fn write(path: &Path, prediction: &Prediction, origin: &Origin) -> Result<(), DatasetError> {
    let mut file = DatasetWriter::create(path, "Friction of a rough surface")?;
    origin.write(&mut file, &prediction.law, &prediction.query)?;
    file.attribute("comment", COMMENT)?;
    file.attribute("plasticity_index", prediction.plasticity_index)?;
    file.attribute("regime", regime(prediction.plasticity_index))?;
    if !prediction.warnings.is_empty() {
        file.attribute("warnings", prediction.warnings.join("\n").as_str())?;
    }

    let row = grid_coordinates(&mut file, &prediction.query)?;
    file.coordinate("slip", &prediction.slip, &described("m", "slip"))?;

    let grid = [row, "slip_rate"];
    let cells: Vec<&Friction> = prediction.friction.iter().flatten().collect();
    // The coordinate takes the place of what it is.
    for quantity in QUANTITIES.iter().filter(|quantity| quantity.name != row) {
        let values: Vec<Estimate> = cells.iter().map(|cell| (quantity.value)(cell)).collect();
        let described = (quantity.units, quantity.long_name);
        with_error(&mut file, quantity.name, &grid, described, &values)?;
    }
    for (name, units, long_name, value) in [
        (
            "outside_table_fraction",
            "1",
            "largest share of the load carried beyond the range of the table during the slide",
            (|cell: &&Friction| cell.outside_table) as fn(&&Friction) -> f64,
        ),
        (
            "elastic_fraction",
            "1",
            "share of the asperities in contact pressed less than first yield needs, at the end of the slide",
            |cell| cell.shares.elastic,
        ),
        (
            "plastic_fraction",
            "1",
            "share of the asperities in contact pressed beyond first yield and not melting, at the end of the slide",
            |cell| cell.shares.plastic,
        ),
        (
            "melting_fraction",
            "1",
            "share of the asperities in contact whose hottest point has the melting temperature, at the end of the slide",
            |cell| cell.shares.melting,
        ),
    ] {
        let values: Vec<f64> = cells.iter().map(value).collect();
        file.reals(name, &grid, &values, &described(units, long_name))?;
    }
    let history: Vec<Estimate> = cells.iter().flat_map(|cell| cell.mu_history.clone()).collect();
    let described_history = ("1", "friction coefficient along the slide");
    let grid_and_slip = [row, "slip_rate", "slip"];
    with_error(&mut file, "mu_history", &grid_and_slip, described_history, &history)?;

    for (name, units, long_name, pick) in [
        (
            "mu_0",
            "1",
            "friction coefficient at low slip rate, flash-heating fit",
            (|fit| fit.mu_0) as fn(crate::friction::flash_heating::FlashHeating) -> Estimate,
        ),
        ("mu_w", "1", "friction coefficient of fully weakened contacts, flash-heating fit", |fit| fit.mu_w),
        ("V_w", "m s-1", "slip rate at which weakening starts, flash-heating fit", |fit| fit.v_w),
    ] {
        let fits = prediction.flash_heating.iter();
        let values: Vec<Estimate> = fits.map(|fit| fit.map_or(UNKNOWN, pick)).collect();
        with_error(&mut file, name, &[row], (units, long_name), &values)?;
    }
    for (name, long_name, pick) in [
        (
            "flash_heating_rms",
            "root mean square misfit of the flash-heating fit",
            (|fit| fit.misfit) as fn(crate::friction::flash_heating::FlashHeating) -> f64,
        ),
        (
            "flash_heating_r_squared",
            "share of the variance of mu over the slip rates that the flash-heating fit explains",
            |fit| fit.r_squared,
        ),
    ] {
        let fits = prediction.flash_heating.iter();
        let values: Vec<f64> = fits.map(|fit| fit.map_or(f64::NAN, pick)).collect();
        file.reals(name, &[row], &values, &described("1", long_name))?;
    }
    if !prediction.comparisons.is_empty() {
        let names: Vec<&str> = prediction.comparisons.iter().map(|c| c.model.as_str()).collect();
        file.dimension("model", names.len())?;
        let what = "closed form of the literature for one asperity, the same at any slip rate";
        file.texts("model", &["model"], &names, &[("long_name", what.into())])?;
        for (name, long_name, value) in [
            (
                "mu_model",
                "sliding friction coefficient with the asperities of the model",
                (|f| f.sliding.mu) as fn(&Friction) -> Estimate,
            ),
            ("mu_static_model", "static friction coefficient with the asperities of the model", |f| {
                f.mu_static
            }),
            (
                "real_area_fraction_model",
                "real over nominal contact area with the asperities of the model",
                |f| f.sliding.area_fraction,
            ),
        ] {
            let cells = prediction.comparisons.iter().flat_map(|c| &c.friction);
            let values: Vec<f64> = cells.map(|cell| value(cell).value).collect();
            file.reals(name, &["model", row], &values, &described("1", long_name))?;
        }
    }
    if let Some(propagated) = &prediction.propagated {
        write_propagated(&mut file, propagated, &grid)?;
    }
    file.finish()
}

/// What the uncertain parameters mean for the results.
fn write_propagated(
    file: &mut DatasetWriter,
    propagated: &Propagated,
    grid: &[&str; 2],
) -> Result<(), DatasetError> {
    let keys: Vec<&str> = propagated.parameters.iter().map(|moved| moved.key.as_str()).collect();
    file.dimension("parameter", keys.len())?;
    let what = "parameter of the surface file with a standard deviation";
    file.texts("parameter", &["parameter"], &keys, &[("long_name", what.into())])?;
    let cells = propagated.contributions.len();
    for (output, line) in OUTPUTS.iter().enumerate() {
        let stds: Vec<f64> = (0..cells).map(|cell| propagated.std(cell, output)).collect();
        let name = format!("{}_parameter_std", line.name);
        let words = format!("standard deviation of {} from the uncertain parameters", line.name);
        file.reals(&name, grid, &stds, &described(line.units, &words))?;
        let changes: Vec<f64> =
            propagated.contributions.iter().flat_map(|cell| cell[output].iter().copied()).collect();
        let name = format!("{}_parameter_change", line.name);
        let words = format!("change of {} when the parameter grows by its standard deviation", line.name);
        file.reals(&name, &[grid[0], grid[1], "parameter"], &changes, &described(line.units, &words))?;
    }
    Ok(())
}

pub(crate) fn described(units: &str, long_name: &str) -> Vec<(&'static str, AttributeValue)> {
    vec![("units", units.into()), ("long_name", long_name.into())]
}

/// A variable and, named in its `ancillary_variables`, the one of its errors.
fn with_error(
    file: &mut DatasetWriter,
    name: &str,
    dimensions: &[&str],
    (units, long_name): (&str, &str),
    estimates: &[Estimate],
) -> Result<(), DatasetError> {
    let error_name = format!("{name}_error");
    let mut attributes = described(units, long_name);
    attributes.push(("ancillary_variables", error_name.as_str().into()));
    let values: Vec<f64> = estimates.iter().map(|estimate| estimate.value).collect();
    let errors: Vec<f64> = estimates.iter().map(|estimate| estimate.error).collect();
    file.reals(name, dimensions, &values, &attributes)?;
    let error_long_name = format!("estimated absolute error of the {long_name}");
    file.reals(&error_name, dimensions, &errors, &described(units, &error_long_name))
}

#[cfg(test)]
mod tests;
