//! SDF, ISO 25178-71, and the BCR format that it comes from: a header, the heights profile by profile and a trailer, as text
//! (`aISO-1.0`) or as binary numbers (`bISO-1.0`). Lengths are in metres.

use super::number::Number;
use crate::topography::Topography;

/// Types of the heights by their code in the header, with their smallest and largest value; floating-point numbers of BCR
/// from the last one on are undefined.
const TYPES: [(&str, f64, f64); 8] = [
    ("<u1", 0.0, u8::MAX as f64),
    ("<u2", 0.0, u16::MAX as f64),
    ("<u4", 0.0, u32::MAX as f64),
    ("<f4", f32::MIN as f64, 3.4e38),
    ("<i1", i8::MIN as f64, i8::MAX as f64),
    ("<i2", i16::MIN as f64, i16::MAX as f64),
    ("<i4", i32::MIN as f64, i32::MAX as f64),
    ("<f8", f64::MIN, 1.7e308),
];

pub(super) fn is_sdf(bytes: &[u8]) -> bool {
    let family = bytes.get(1..5);
    matches!(bytes.first(), Some(b'a' | b'b')) && (family == Some(b"ISO-") || family == Some(b"BCR-"))
}

pub(super) fn parse(bytes: &[u8]) -> Result<Topography, String> {
    let is_bcr = bytes[1..].starts_with(b"BCR");
    let (header, raw) = match bytes[0] {
        b'a' => of_text(&String::from_utf8_lossy(bytes))?,
        _ => of_binary(bytes).ok_or("ends within the header")?,
    };
    let Header { points, profiles, steps: [x, y], scale, data_type, compression, check } = header;
    if compression != 0 || check != 0 {
        return Err(format!(
            "Compression = {compression}, CheckType = {check}: only 0 is known, neither compressed nor with a check sum"
        ));
    }
    let (_, smallest, largest) =
        *TYPES.get(data_type).ok_or_else(|| format!("DataType = {data_type}: must be 0 to 7"))?;
    let count = points.checked_mul(profiles).ok_or("NumPoints x NumProfiles is too large")?;
    if raw.len() < count {
        return Err(format!("holds {} of {profiles} x {points} heights", raw.len()));
    }
    let is_undefined = |value: f64| if is_bcr { value >= largest } else { value <= smallest };
    let height = |&value: &f64| if is_undefined(value) { f64::NAN } else { scale * value };
    let heights: Vec<f64> = raw[..count].iter().map(height).collect();
    Ok(match profiles {
        1 => Topography::profile(x, heights),
        _ => Topography::map((profiles, y), (points, x), heights),
    })
}

struct Header {
    points: usize,
    profiles: usize,
    /// Spacing along a profile, and between profiles, m.
    steps: [f64; 2],
    /// Unit of the heights, m.
    scale: f64,
    data_type: usize,
    compression: usize,
    check: usize,
}

/// The header, and heights in units of the scale.
fn of_text(text: &str) -> Result<(Header, Vec<f64>), String> {
    // What follows a semicolon is a comment.
    let mut lines = text.lines().skip(1).map(|line| line.split(';').next().unwrap_or_default().trim());
    let fields: Vec<(&str, &str)> = lines
        .by_ref()
        .take_while(|line| *line != "*")
        .filter_map(|line| line.split_once('='))
        .map(|(key, value)| (key.trim(), value.trim()))
        .collect();
    let field = |key: &str| {
        let found = fields.iter().find(|(name, _)| name.eq_ignore_ascii_case(key));
        found.map(|(_, value)| *value).ok_or_else(|| format!("its header has no {key}"))
    };
    fn number<T: std::str::FromStr>(key: &str, value: &str) -> Result<T, String> {
        value.parse().map_err(|_| format!("{key} = {value}: is not a number"))
    }
    let whole = |key: &str| number::<usize>(key, field(key)?);
    let real = |key: &str| number::<f64>(key, field(key)?);
    let header = Header {
        points: whole("NumPoints")?,
        profiles: whole("NumProfiles")?,
        steps: [real("Xscale")?, real("Yscale")?],
        scale: real("Zscale")?,
        // Names are those of BCR.
        data_type: match field("DataType")? {
            name if name.eq_ignore_ascii_case("INTEGER") => 6,
            name if name.eq_ignore_ascii_case("FLOAT") => 7,
            code => number("DataType", code)?,
        },
        compression: whole("Compression").unwrap_or(0),
        check: whole("CheckType").unwrap_or(0),
    };
    let words = lines.take_while(|line| *line != "*").flat_map(str::split_whitespace);
    let values = words.map(|word| if word == "BAD" { Ok(f64::NAN) } else { number("a height", word) });
    Ok((header, values.collect::<Result<_, _>>()?))
}

/// Header and heights of a binary file, without heights of an unknown type; none where the bytes end within the header.
fn of_binary(bytes: &[u8]) -> Option<(Header, Vec<f64>)> {
    // Version, manufacturer and two dates.
    let mut rest = bytes.get(8 + 10 + 12 + 12..)?;
    let mut next = |kind: &str| {
        let number = Number::of(kind)?;
        let (own, after) = rest.split_at_checked(number.size)?;
        rest = after;
        number.read(own).next()
    };
    let count = if bytes.get(5..8)? == b"2.0" { "<u4" } else { "<u2" };
    let [points, profiles] = [next(count)?, next(count)?].map(|value| value as usize);
    let [x, y, scale, _resolution] = [next("<f8")?, next("<f8")?, next("<f8")?, next("<f8")?];
    let [compression, data_type, check] =
        [next("<u1")?, next("<u1")?, next("<u1")?].map(|value| value as usize);
    let header = Header { points, profiles, steps: [x, y], scale, data_type, compression, check };
    let number = TYPES.get(data_type).and_then(|(kind, ..)| Number::of(kind));
    Some((header, number.map_or(Vec::new(), |number| number.read(rest).collect())))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(version: &str, data_type: &str, heights: &str) -> String {
        format!(
            "{version}\r\nManufacID = someone\r\nNumPoints = 3\r\nNumProfiles = 2\r\nXscale = 1e-6\r\nYscale = 2e-6\r\n\
             Zscale = 1e-9 ; nm\r\nZresolution = -1\r\nCompression = 0\r\nDataType = {data_type}\r\nCheckType = 0\r\n*\r\n{heights}\r\n*\r\n"
        )
    }

    #[test]
    fn texts_have_points_without_height() {
        let map = parse(text("aISO-2.0", "7", "1 2 BAD\n4 5.5 -6").as_bytes()).unwrap();
        assert_eq!((map.rows, map.columns, map.row_step, map.column_step), (2, 3, 2e-6, 1e-6));
        assert!(map.heights[2].is_nan() && (map.heights[4] - 5.5e-9).abs() < 1e-24, "{map:?}");
        // The largest number of BCR is no height, the smallest of ISO is none.
        let bcr = parse(text("aBCR-1.0", "5", "1 2 32767\n4 5 -32768").as_bytes()).unwrap();
        assert!(bcr.heights[2].is_nan() && (bcr.heights[5] + 32768e-9).abs() < 1e-20);
        let iso = parse(text("aISO-1.0", "5", "1 2 32767\n4 5 -32768").as_bytes()).unwrap();
        assert!(iso.heights[5].is_nan() && (iso.heights[2] - 32767e-9).abs() < 1e-20);
    }

    #[test]
    fn what_is_missing_is_named() {
        let refused = |text: &str| parse(text.as_bytes()).unwrap_err();
        let whole = text("aISO-1.0", "7", "1 2 3 4");
        assert_eq!(refused(&whole), "holds 4 of 2 x 3 heights");
        assert_eq!(refused(&whole.replace("Zscale", "Scale")), "its header has no Zscale");
        assert!(refused(&whole.replace("Compression = 0", "Compression = 1")).starts_with("Compression = 1"));
        assert!(refused(&whole.replace("1 2 3", "1 two 3")).contains("two: is not a number"));
        assert_eq!(refused("bISO-1.0 someone"), "ends within the header");
    }
}
