//! X3P, ISO 25178-72: a ZIP archive with `main.xml` and a file of binary numbers.

use super::number::Number;
use crate::topography::Topography;
use std::io::{Cursor, Read};

type Archive<'a> = zip::ZipArchive<Cursor<&'a [u8]>>;

/// Largest member that is unpacked, bytes: a map of 16 000 x 16 000 doubles.
const LARGEST_MEMBER: u64 = 1 << 31;

pub(super) fn parse(bytes: &[u8]) -> Result<Topography, String> {
    let mut archive = Archive::new(Cursor::new(bytes)).map_err(|error| format!("is no X3P file: {error}"))?;
    if archive.file_names().flatten().any(|name| name.ends_with(".npy")) {
        return Err(
            "holds arrays of NumPy (.npz); save one array by numpy.save in a file of its own (.npy)".into()
        );
    }
    let xml = member(&mut archive, "main.xml")?;
    let xml = String::from_utf8(xml).map_err(|_| "main.xml is no UTF-8")?;
    let document = roxmltree::Document::parse(&xml).map_err(|error| format!("main.xml: {error}"))?;
    let main = Main(document.root_element());
    for (axis, wanted) in [("CX", "I"), ("CY", "I"), ("CZ", "A")] {
        let kind = main.needed(&["Record1", "Axes", axis, "AxisType"])?;
        if kind != wanted {
            return Err(format!(
                "main.xml: AxisType of {axis} = {kind}: only {wanted} is known, a regular grid"
            ));
        }
    }
    let (columns, rows, layers) = (main.points("SizeX")?, main.points("SizeY")?, main.points("SizeZ")?);
    if layers != 1 {
        return Err(format!("main.xml: SizeZ = {layers}: only one layer is known"));
    }
    let count = rows.checked_mul(columns).ok_or("main.xml: SizeX x SizeY is too large")?;
    let kind = main.needed(&["Record1", "Axes", "CZ", "DataType"])?;
    let number = [("I", "<i2"), ("L", "<i4"), ("F", "<f4"), ("D", "<f8")].into_iter();
    let number = number.filter(|(name, _)| *name == kind).find_map(|(_, number)| Number::of(number));
    let number =
        number.ok_or_else(|| format!("main.xml: DataType of CZ = {kind}: must be one of I, L, F, D"))?;
    let data = member(&mut archive, main.needed(&["Record3", "DataLink", "PointDataLink"])?)?;
    if data.len() / number.size < count {
        return Err(format!("holds {} of {columns} x {rows} heights", data.len() / number.size));
    }
    // Integers count increments; the increment of floating-point heights is one by the standard.
    let scale = main.number(&["Record1", "Axes", "CZ", "Increment"], 1.0)?;
    let offset = main.number(&["Record1", "Axes", "CZ", "Offset"], 0.0)?;
    let mut heights: Vec<f64> = number.read(&data).take(count).map(|z| offset + scale * z).collect();
    let link = main.text(&["Record3", "DataLink", "ValidPointsLink"]);
    if let Some(link) = link.filter(|link| !link.is_empty()) {
        let valid = member(&mut archive, link)?;
        for (point, height) in heights.iter_mut().enumerate() {
            if valid.get(point / 8).is_some_and(|byte| byte >> (point % 8) & 1 == 0) {
                *height = f64::NAN;
            }
        }
    }
    let step = |axis: &str| main.number(&["Record1", "Axes", axis, "Increment"], f64::NAN);
    Ok(Topography::map((rows, step("CY")?), (columns, step("CX")?), heights))
}

/// The root of `main.xml`.
struct Main<'a>(roxmltree::Node<'a, 'a>);

impl<'a> Main<'a> {
    fn text(&self, path: &[&str]) -> Option<&'a str> {
        let mut node = self.0;
        for name in path {
            node = node.children().find(|child| child.tag_name().name() == *name)?;
        }
        node.text().map(str::trim)
    }

    fn needed(&self, path: &[&str]) -> Result<&'a str, String> {
        self.text(path).ok_or_else(|| format!("main.xml: {} is missing", path.join("/")))
    }

    fn number(&self, path: &[&str], default: f64) -> Result<f64, String> {
        match self.text(path) {
            None | Some("") => Ok(default),
            Some(text) => text
                .parse::<f64>()
                .map_err(|_| format!("main.xml: {} = {text}: must be a number", path.join("/"))),
        }
    }

    fn points(&self, name: &str) -> Result<usize, String> {
        let text = self.needed(&["Record3", "MatrixDimension", name])?;
        let rule = || format!("main.xml: {name} = {text}: must be a positive number of points");
        text.parse().ok().filter(|points| *points > 0).ok_or_else(rule)
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

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::*;

    #[test]
    fn arrays_of_numpy_are_no_x3p_file() {
        let mut archive = zip::ZipWriter::new(Cursor::new(Vec::new()));
        archive.start_file("z.npy", zip::write::SimpleFileOptions::default()).unwrap();
        archive.write_all(b"\x93NUMPY").unwrap();
        let bytes = archive.finish().unwrap().into_inner();
        assert!(parse(&bytes).unwrap_err().contains("numpy.save"));
    }
}
