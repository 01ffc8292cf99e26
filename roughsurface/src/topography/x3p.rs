//! X3P, ISO 25178-72: a ZIP archive with `main.xml` and a file of binary numbers.

use super::Topography;
use std::io::{Cursor, Read};

type Archive<'a> = zip::ZipArchive<Cursor<&'a [u8]>>;

/// Largest member that is unpacked, bytes: a map of 16 000 x 16 000 doubles.
const LARGEST_MEMBER: u64 = 1 << 31;

pub(super) fn parse(bytes: &[u8]) -> Result<Topography, String> {
    let mut archive = Archive::new(Cursor::new(bytes)).map_err(|error| format!("is no X3P file: {error}"))?;
    let xml = member(&mut archive, "main.xml")?;
    let xml = String::from_utf8(xml).map_err(|_| "main.xml is no UTF-8")?;
    let document = roxmltree::Document::parse(&xml).map_err(|error| format!("main.xml: {error}"))?;
    let text = |path: &[&str]| -> Option<&str> {
        let mut node = document.root_element();
        for name in path {
            node = node.children().find(|child| child.tag_name().name() == *name)?;
        }
        node.text().map(str::trim)
    };
    let needed = |path: &[&str]| text(path).ok_or_else(|| format!("main.xml: {} is missing", path.join("/")));
    let number = |path: &[&str], default: f64| match text(path) {
        None | Some("") => Ok(default),
        Some(text) => text
            .parse::<f64>()
            .map_err(|_| format!("main.xml: {} = {text}: must be a number", path.join("/"))),
    };
    let points = |name: &str| -> Result<usize, String> {
        let text = needed(&["Record3", "MatrixDimension", name])?;
        let rule = || format!("main.xml: {name} = {text}: must be a positive number of points");
        text.parse().ok().filter(|points| *points > 0).ok_or_else(rule)
    };
    for (axis, wanted) in [("CX", "I"), ("CY", "I"), ("CZ", "A")] {
        let kind = needed(&["Record1", "Axes", axis, "AxisType"])?;
        if kind != wanted {
            return Err(format!(
                "main.xml: AxisType of {axis} = {kind}: only {wanted} is known, a regular grid"
            ));
        }
    }
    let (columns, rows, layers) = (points("SizeX")?, points("SizeY")?, points("SizeZ")?);
    if layers != 1 {
        return Err(format!("main.xml: SizeZ = {layers}: only one layer is known"));
    }
    let step = |axis: &str| number(&["Record1", "Axes", axis, "Increment"], f64::NAN);
    let (column_step, row_step) = (step("CX")?, step("CY")?);
    let scale = number(&["Record1", "Axes", "CZ", "Increment"], 1.0)?;
    let offset = number(&["Record1", "Axes", "CZ", "Offset"], 0.0)?;

    let kind = needed(&["Record1", "Axes", "CZ", "DataType"])?;
    let size = match kind {
        "I" => 2,
        "L" | "F" => 4,
        "D" => 8,
        _ => return Err(format!("main.xml: DataType of CZ = {kind}: must be one of I, L, F, D")),
    };
    let count = rows.checked_mul(columns).ok_or("main.xml: SizeX x SizeY is too large")?;
    let data = member(&mut archive, needed(&["Record3", "DataLink", "PointDataLink"])?)?;
    if data.len() / size < count {
        return Err(format!("holds {} of {columns} x {rows} heights", data.len() / size));
    }
    // Integers count increments; the increment of floating-point heights is one by the standard.
    let mut heights: Vec<f64> =
        (data.chunks_exact(size).take(count)).map(|bytes| offset + scale * binary(kind, bytes)).collect();
    if let Some(link) = text(&["Record3", "DataLink", "ValidPointsLink"]).filter(|link| !link.is_empty()) {
        let valid = member(&mut archive, link)?;
        for (point, height) in heights.iter_mut().enumerate() {
            if valid.get(point / 8).is_some_and(|byte| byte >> (point % 8) & 1 == 0) {
                *height = f64::NAN;
            }
        }
    }
    Ok(Topography { rows, row_step, columns, column_step, heights, periodic: false, remarks: Vec::new() })
}

fn binary(kind: &str, bytes: &[u8]) -> f64 {
    match (kind, bytes) {
        ("I", &[a, b]) => f64::from(i16::from_le_bytes([a, b])),
        ("L", &[a, b, c, d]) => f64::from(i32::from_le_bytes([a, b, c, d])),
        ("F", &[a, b, c, d]) => f64::from(f32::from_le_bytes([a, b, c, d])),
        (_, &[a, b, c, d, e, f, g, h]) => f64::from_le_bytes([a, b, c, d, e, f, g, h]),
        _ => f64::NAN,
    }
}

fn member(archive: &mut Archive, name: &str) -> Result<Vec<u8>, String> {
    let mut file = archive.by_name(name).map_err(|error| format!("{name} of the X3P file: {error}"))?;
    if file.size() > LARGEST_MEMBER {
        return Err(format!("{name} of the X3P file: {} bytes are more than can be read", file.size()));
    }
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).map_err(|error| format!("{name} of the X3P file: {error}"))?;
    Ok(bytes)
}
