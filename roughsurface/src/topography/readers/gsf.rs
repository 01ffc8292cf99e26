//! Gwyddion Simple Field: a text header, zeros up to a multiple of four bytes, and
//! single-precision numbers row by row (Gwyddion user guide, Gwyddion Simple Field).

use super::number::Number;
use crate::surface::units::LENGTH;
use crate::topography::Topography;

pub(super) const MAGIC: &[u8] = b"Gwyddion Simple Field 1.0\n";

pub(super) fn parse(bytes: &[u8]) -> Result<Topography, String> {
    let end = bytes.iter().position(|byte| *byte == 0).ok_or("the header of the GSF file has no end")?;
    let header = std::str::from_utf8(&bytes[..end]).map_err(|_| "the header of the GSF file is no UTF-8")?;
    let field = |key: &str| {
        let mut fields = header.lines().skip(1).filter_map(|line| line.split_once('='));
        let field = fields.find(|(name, _)| name.trim() == key).map(|(_, value)| value.trim());
        field.ok_or_else(|| format!("{key}: is missing from the GSF header"))
    };
    let points = |key: &str| -> Result<usize, String> {
        let text = field(key)?;
        let rule = || format!("{key} = {text}: must be a positive number of points");
        text.parse().ok().filter(|points| *points > 0).ok_or_else(rule)
    };
    let (columns, rows) = (points("XRes")?, points("YRes")?);
    let unit = |key: &str| -> Result<f64, String> {
        let symbol = field(key).unwrap_or_default();
        let rule = || format!("{key} = \"{symbol}\": must be a unit of length such as m or um");
        LENGTH.factor(symbol).ok_or_else(rule)
    };
    let (lateral, vertical) = (unit("XYUnits")?, unit("ZUnits")?);
    let extent = |key: &str| -> Result<f64, String> {
        let text = field(key)?;
        text.parse::<f64>().map_err(|_| format!("{key} = {text}: must be a length"))
    };
    let (width, height) = (extent("XReal")? * lateral, extent("YReal")? * lateral);
    // One to four zeros: the data start at a multiple of four.
    let start = end + 4 - end % 4;
    let count = rows.checked_mul(columns).ok_or("XRes x YRes is too large")?;
    let data = bytes.get(start..).unwrap_or_default();
    if data.len() / 4 < count {
        return Err(format!("holds {} of {columns} x {rows} heights", data.len() / 4));
    }
    let number = Number::of("<f4").expect("a known type");
    let heights = number.read(data).take(count).map(|z| vertical * z).collect();
    Ok(Topography::map((rows, height / rows as f64), (columns, width / columns as f64), heights))
}
