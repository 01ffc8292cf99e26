//! NetCDF as SurfaceTopography writes it: `heights` over (`x`, `y`) or `x`, the extent in the
//! attribute `length` of the coordinates, the unit of each in its attribute `unit` or `units`.

use super::profile::profile;
use super::reading::Reading;
use crate::surface::units::LENGTH;
use crate::topography::Topography;
use std::path::Path;
use tables::netcdf::DatasetReader;

pub(super) fn read(file: &Path) -> Result<Topography, String> {
    let reader = DatasetReader::open(file).map_err(|error| error.to_string())?;
    let shape = reader.shape("heights").map_err(|_| {
        let title = reader.optional_text("title").ok().flatten();
        let is = title.map_or(String::new(), |title| format!(" (its title is \"{title}\")"));
        format!("has no variable \"heights\"{is}; NetCDF files must be as SurfaceTopography writes them")
    })?;
    let mut remarks = Vec::new();
    let stated = |name: &str| -> Result<Option<f64>, String> {
        let attribute = |attribute: &'static str| Some((attribute, reader.variable_text(name, attribute)?));
        let Some((attribute, symbol)) = attribute("unit").or_else(|| attribute("units")) else {
            return Ok(None);
        };
        let rule = || format!("{name}:{attribute} = \"{symbol}\": must be a unit of length such as m or um");
        LENGTH.factor(&symbol).ok_or_else(rule).map(Some)
    };
    let (of_heights, of_x) = (stated("heights")?, stated("x")?);
    // Where one of them has no unit it is that of the other.
    let unit = Reading::default().unit(of_heights.or(of_x), &mut remarks);
    let unit_along = |name: &str| Ok::<f64, String>(stated(name)?.or(of_x).unwrap_or(unit));
    let heights = heights(&reader, &shape, unit)?;
    let step = |name: &str, points: usize| -> Result<f64, String> {
        let extent = reader.variable_real(name, "length");
        let extent =
            extent.ok_or_else(|| format!("{name}:length: is missing, the extent of the map along {name}"))?;
        Ok(unit_along(name)? * extent / points as f64)
    };
    let periodic = reader.variable_real("x", "periodic").is_some_and(|flag| flag != 0.0);
    let even = reader.shape("x").is_ok_and(|x| x == shape) && reader.variable_real("x", "length").is_some();
    match shape[..] {
        [rows, columns] => {
            let map = Topography::map((rows, step("x", rows)?), (columns, step("y", columns)?), heights);
            Ok(Topography { periodic, remarks, ..map })
        }
        [points] if even => {
            Ok(Topography { periodic, remarks, ..Topography::profile(step("x", points)?, heights) })
        }
        [points] => {
            let x = reader.reals("x", &[points]).map_err(|error| error.to_string())?;
            let unit = unit_along("x")?;
            profile(&x.iter().map(|x| unit * x).collect::<Vec<f64>>(), &heights, remarks)
        }
        _ => Err(format!("heights has {} dimensions; a map has two, a profile one", shape.len())),
    }
}

/// Heights in metres, NaN where they are masked.
fn heights(reader: &DatasetReader, shape: &[usize], unit: f64) -> Result<Vec<f64>, String> {
    let heights = reader.reals("heights", shape).map_err(|error| error.to_string())?;
    let mut heights: Vec<f64> = heights.iter().map(|height| unit * height).collect();
    if reader.shape("mask").is_ok_and(|mask| mask == shape) {
        let mask = reader.flags("mask", shape).map_err(|error| error.to_string())?;
        for (height, masked) in heights.iter_mut().zip(mask) {
            if masked != 0 {
                *height = f64::NAN;
            }
        }
    }
    Ok(heights)
}
