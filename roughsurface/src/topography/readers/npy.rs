//! NPY, the format of `numpy.save`, versions 1 to 3: a header that is a Python dictionary, then the numbers
//! (NumPy Enhancement Proposal 1).

use super::number::Number;
use super::reading::Reading;
use crate::topography::Topography;

pub(super) const MAGIC: &[u8] = b"\x93NUMPY";

/// A matrix of heights, or a profile if the array has one dimension.
pub(super) fn parse(bytes: &[u8], reading: &Reading) -> Result<Topography, String> {
    const CUT: &str = "the header of the npy file is cut off";
    let version = *bytes.get(MAGIC.len()).ok_or(CUT)?;
    // The length of the header has two bytes in version 1, four later.
    let size = if version == 1 { 2 } else { 4 };
    let start = MAGIC.len() + 2 + size;
    let length = bytes.get(start - size..start).ok_or(CUT)?;
    let length = length.iter().rev().fold(0, |length, byte| length << 8 | usize::from(*byte));
    let header = String::from_utf8_lossy(bytes.get(start..start + length).ok_or(CUT)?);
    let field = |key: &str| {
        let value = header.split_once(&format!("'{key}':")).map(|(_, rest)| rest.trim_start());
        value.ok_or_else(|| format!("{key} is missing from the npy header"))
    };
    let kind = field("descr")?.split('\'').nth(1).unwrap_or_default();
    let number = Number::of(kind).ok_or_else(|| {
        format!(
            "numbers of type \"{kind}\" in the npy file: must be real numbers of 4 or 8 bytes or integers"
        )
    })?;
    let shape = field("shape")?.trim_start_matches('(').split(')').next().unwrap_or_default();
    let points: Vec<usize> = (shape.split(',').map(str::trim).filter(|count| !count.is_empty()))
        .map(|count| {
            count.parse().map_err(|_| format!("shape of the npy file = ({shape}): must be numbers of points"))
        })
        .collect::<Result<_, _>>()?;
    let count = points.iter().fold(1usize, |count, points| count.saturating_mul(*points));
    let data = &bytes[start + length..];
    if data.len() / number.size < count {
        return Err(format!("holds {} numbers, ({shape}) are stated", data.len() / number.size));
    }
    let mut remarks = Vec::new();
    let unit = reading.unit(None, &mut remarks);
    let heights: Vec<f64> = number.read(data).take(count).map(|z| unit * z).collect();
    let step = reading.pixel()?;
    let topography = match points[..] {
        [_] => Topography::profile(step, heights),
        [rows, columns] if field("fortran_order")?.starts_with("True") => {
            let by_rows = |place: usize| heights[place % columns * rows + place / columns];
            Topography::map((rows, step), (columns, step), (0..rows * columns).map(by_rows).collect())
        }
        [rows, columns] => Topography::map((rows, step), (columns, step), heights),
        _ => return Err(format!("the array has {} dimensions; a map has two, a profile one", points.len())),
    };
    Ok(Topography { remarks, ..topography })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As `numpy.save` writes it.
    fn npy(version: u8, header: &str, data: &[u8]) -> Vec<u8> {
        let mut bytes = [MAGIC, &[version, 0]].concat();
        let length = header.len() as u32;
        match version {
            1 => bytes.extend((length as u16).to_le_bytes()),
            _ => bytes.extend(length.to_le_bytes()),
        }
        [&bytes, header.as_bytes(), data].concat()
    }

    const READING: Reading = Reading { unit: Some(1e-6), pixel: Some(2e-6) };

    #[test]
    fn arrays_of_any_order_and_type() {
        let data: Vec<u8> = [1.0f64, 2.0, 3.0, 4.0, 5.0, 6.0].iter().flat_map(|x| x.to_le_bytes()).collect();
        let header = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }\n";
        for version in [1, 2, 3] {
            let map = parse(&npy(version, header, &data), &READING).unwrap();
            assert_eq!((map.rows, map.columns, map.row_step), (2, 3, 2e-6));
            assert!((map.heights[1] - 2e-6).abs() < 1e-20);
        }
        let turned = parse(&npy(1, &header.replace("False", "True"), &data), &READING).unwrap();
        assert!((turned.heights[1] - 3e-6).abs() < 1e-20 && (turned.heights[3] - 2e-6).abs() < 1e-20);
        let integers: Vec<u8> = [-2i16, 300].iter().flat_map(|x| x.to_be_bytes()).collect();
        let profile = "{'descr': '>i2', 'fortran_order': False, 'shape': (2,), }\n";
        let metres = Reading { unit: None, ..READING };
        let profile = parse(&npy(1, profile, &integers), &metres).unwrap();
        assert_eq!((profile.rows, &profile.heights[..], profile.remarks.len()), (1, &[-2.0, 300.0][..], 1));
        let single: Vec<u8> = 1.5f32.to_le_bytes().to_vec();
        let single =
            parse(&npy(1, &header.replace("f8", "f4").replace("2, 3", "1"), &single), &metres).unwrap();
        assert_eq!(single.heights, [1.5]);
    }

    #[test]
    fn other_arrays_are_refused() {
        let header = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }\n";
        for (bytes, expected) in [
            (npy(1, header, &[0; 40]), "holds 5 numbers, (2, 3) are stated"),
            (npy(1, &header.replace("f8", "c8"), &[0; 48]), "type \"<c8\""),
            (npy(1, &header.replace("'<f8'", "[('x', '<f8')]"), &[0; 48]), "type \"x\""),
            (npy(1, &header.replace("2, 3", "1, 2, 3"), &[0; 48]), "has 3 dimensions"),
            (npy(1, &header.replace("2, 3", "9999999999, 9999999999"), &[0; 48]), "are stated"),
            (npy(1, &header.replace("shape", "form"), &[0; 48]), "shape is missing"),
            (npy(1, header, &[])[..20].to_vec(), "cut off"),
            (MAGIC.to_vec(), "cut off"),
        ] {
            let error = parse(&bytes, &READING).unwrap_err();
            assert!(error.contains(expected), "{error}");
        }
        let whole = npy(1, header, &[0; 48]);
        assert!(parse(&whole, &Reading::default()).unwrap_err().contains("--pixel"));
    }
}
