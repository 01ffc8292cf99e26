//! Reads a topography of any known format, recognised by content.
//!
//! Chapter "Rough surfaces" of the book, "From topography".

mod fill;
mod gsf;
mod netcdf;
mod npy;
mod number;
mod profile;
mod reading;
mod sdf;
mod text;
mod titles;
mod units;
mod x3p;

pub use reading::Reading;

use crate::surface::read_regular;
use crate::surface::text::decode;
use crate::surface::units::LENGTH;
use crate::topography::warning::Warning;
use crate::topography::{Topography, TopographyError, plausibility};
use std::io::Read;
use std::path::Path;
use tables::netcdf::input::STANDARD_INPUT;
use tables::numbers::plain;

/// Fewest points in each direction from which curvatures can be computed.
const FEWEST_POINTS: usize = 8;

/// Largest share of undefined points that are filled in rather than refused.
const MOST_UNDEFINED: f64 = 0.1;

/// Message for a binary file of an instrument, such as .sur.
const BINARY: &str = "is a binary file of unknown format; known are X3P, SDF, GSF, NetCDF, NPY and text. Gwyddion and the programs of \
    most instruments convert to X3P";

/// Whether `file` is a topography and not a surface file, which is called `.toml` or begins with a section.
pub fn is_topography(file: &Path) -> bool {
    /// Comments are shorter.
    const BEGINNING: u64 = 1 << 16;
    let standard_input = file == Path::new(STANDARD_INPUT);
    if standard_input || file.extension().is_some_and(|extension| extension == "toml") || !file.is_file() {
        return false;
    }
    let mut start = Vec::new();
    let read = std::fs::File::open(file).and_then(|opened| opened.take(BEGINNING).read_to_end(&mut start));
    let text = decode(&start);
    // Titles may be units in brackets.
    let section = |line: &str| {
        let name = line.split('#').next().unwrap_or(line).trim().strip_prefix('[');
        let name = name.and_then(|name| name.strip_suffix(']'));
        name.is_some_and(|name| !name.contains('[') && LENGTH.factor(name).is_none())
    };
    let mut lines = text
        .trim_start_matches('\u{feff}')
        .lines()
        .map(str::trim)
        .filter(|line| !line.is_empty() && !line.starts_with('#'));
    read.is_ok() && lines.next().is_some_and(|line| !section(line))
}

/// Reads `file`: GSF (Gwyddion), NetCDF as SurfaceTopography writes it, ISO 25178-72 X3P, ISO 25178-71 SDF, NPY, or text:
/// a matrix of heights, columns x y z, x z, or z.
pub fn read(file: &Path, reading: &Reading) -> Result<Topography, TopographyError> {
    let error = |what: String| TopographyError { file: file.to_path_buf(), what };
    let bytes = read_regular(file).map_err(|reason| error(format!("cannot be read: {reason}")))?;
    let parsed = if bytes.starts_with(npy::MAGIC) {
        npy::parse(&bytes, reading)
    } else if bytes.starts_with(b"PK\x03\x04") {
        without_lengths(reading).and_then(|()| x3p::parse(&bytes))
    } else if sdf::is_sdf(&bytes) {
        without_lengths(reading).and_then(|()| sdf::parse(&bytes))
    } else if bytes.starts_with(gsf::MAGIC) {
        without_lengths(reading).and_then(|()| gsf::parse(&bytes))
    } else if bytes.starts_with(b"CDF") || bytes.starts_with(b"\x89HDF") {
        without_lengths(reading).and_then(|()| netcdf::read(file))
    } else {
        match decode(&bytes) {
            text if text.contains('\0') => Err(BINARY.into()),
            text => text::parse(&text, reading),
        }
    };
    parsed.and_then(checked).map_err(error)
}

fn without_lengths(reading: &Reading) -> Result<(), String> {
    match reading.unit.is_some() || reading.pixel.is_some() {
        true => Err("states its own lengths; --unit and --pixel are for text and npy".into()),
        false => Ok(()),
    }
}

/// Heights that do not come from a file, checked like those of a file: undefined points are filled in.
pub fn checked(mut topography: Topography) -> Result<Topography, String> {
    if topography.columns == 1 {
        (topography.rows, topography.columns) = (1, topography.rows);
        topography.column_step = topography.row_step;
    }
    if topography.rows == 1 {
        // Files may have none, as it has no meaning.
        topography.row_step = topography.column_step;
    }
    let Topography { rows, columns, row_step, column_step, .. } = topography;
    if columns < FEWEST_POINTS || (rows != 1 && rows < FEWEST_POINTS) {
        return Err(format!(
            "holds {rows} x {columns} points; at least {FEWEST_POINTS} in each direction are needed"
        ));
    }
    for (name, step) in [("row", row_step), ("column", column_step)] {
        if !(step > 0.0 && step.is_finite()) {
            return Err(format!("distance between {name}s = {} m: must be positive", plain(step)));
        }
    }
    for height in topography.heights.iter_mut().filter(|height| !height.is_finite()) {
        *height = f64::NAN;
    }
    let heights = &topography.heights;
    let undefined = heights.iter().filter(|height| height.is_nan()).count() as f64 / heights.len() as f64;
    if undefined > MOST_UNDEFINED {
        return Err(format!(
            "{:.1} % of the points have no height; at most {:.0} % can be filled in",
            100.0 * undefined,
            100.0 * MOST_UNDEFINED
        ));
    }
    let lowest = heights.iter().copied().fold(f64::INFINITY, f64::min);
    let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if lowest == highest {
        return Err(format!("all heights are {} m", plain(lowest)));
    }
    if undefined > 0.0 {
        fill::fill(&mut topography);
        topography.remarks.push(Warning::Filled { share: undefined });
    }
    if let Some(warning) = plausibility::units(&topography) {
        topography.remarks.retain(|remark| *remark != Warning::NoUnit);
        topography.remarks.push(warning);
    }
    Ok(topography)
}
