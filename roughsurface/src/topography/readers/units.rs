//! The unit of each column of a text file: by its title, by `--unit`, or metres.

use super::reading::Reading;
use super::titles::{Column, Unit};
use crate::surface::units::LENGTH;
use crate::topography::warning::Warning;

/// Metres in a unit of each of one to three columns, the last of which are heights, the others positions.
pub(super) fn units_of_columns(
    titled: &[Column],
    columns: &[Vec<f64>],
    reading: &Reading,
    remarks: &mut Vec<Warning>,
) -> Result<Vec<f64>, String> {
    let positions = columns.len().saturating_sub(1);
    let counted = positions > 0
        && titled[..positions].iter().all(|column| column.unit == Unit::Unstated)
        && columns[..positions].iter().all(|column| counts(column));
    match (reading.pixel, counted) {
        (Some(pixel), true) => {
            let heights = stated_units(&titled[positions..], reading, remarks)?;
            return Ok([vec![pixel; positions], heights].concat());
        }
        (Some(_), false) if positions > 0 => {
            return Err("states the positions of its points; leave out --pixel".into());
        }
        (None, true) if reading.unit.is_none() && titled[positions].unit != Unit::Unstated => {
            return Err(
                "its positions are whole numbers without a unit, which count the points: give their distance with \
                 --pixel LENGTH"
                    .into(),
            );
        }
        (None, true) => remarks.push(Warning::CountedPositions),
        _ => {}
    }
    stated_units(titled, reading, remarks)
}

/// Units by the titles; `--unit` is that of the columns whose titles state none.
fn stated_units(
    titled: &[Column],
    reading: &Reading,
    remarks: &mut Vec<Warning>,
) -> Result<Vec<f64>, String> {
    let stated = |column: &Column| match column.unit {
        Unit::Metres(metres) => Some(metres),
        _ => None,
    };
    let units: Vec<Option<f64>> = titled.iter().map(stated).collect();
    if let Some(unit) = reading.unit {
        let all_stated = units.iter().all(Option::is_some);
        return match all_stated && units.iter().any(|stated| *stated != Some(unit)) {
            true => Err("its titles state the unit of each column; leave out --unit".into()),
            false => Ok(units.into_iter().map(|stated| stated.unwrap_or(unit)).collect()),
        };
    }
    for column in titled {
        if let Unit::Unknown(symbol) = &column.unit {
            return Err(unknown_unit(&format!("its title \"{}\"", column.title), symbol));
        }
    }
    if units.iter().all(Option::is_none) {
        return Ok(vec![reading.unit(None, remarks); titled.len()]);
    }
    let or_error = |(column, unit): (&Column, Option<f64>)| {
        let title = &column.title;
        unit.ok_or_else(|| {
            format!(
                "its titles state the unit of some columns but none of \"{title}\": write it in brackets, as in \
                 \"{title} [um]\", or give it with --unit"
            )
        })
    };
    titled.iter().zip(units).map(or_error).collect()
}

pub(super) fn unknown_unit(whose: &str, symbol: &str) -> String {
    format!("{whose} states no known unit of length: \"{symbol}\"; known are {}", LENGTH.known())
}

/// Whether values are whole numbers from one to the next, in any order: such columns count points.
fn counts(values: &[f64]) -> bool {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup();
    sorted.len() > 1 && sorted[0].fract() == 0.0 && sorted.windows(2).all(|pair| pair[1] - pair[0] == 1.0)
}

#[cfg(test)]
mod tests {
    use super::super::text::parse;
    use super::*;
    use crate::topography::Topography;

    fn read(text: &str) -> Result<Topography, String> {
        parse(text, &Reading::default())
    }

    #[test]
    fn units_that_are_unknown_or_of_some_columns_are_refused() {
        let points = "0.0,1\n0.25,2\n0.5,4\n";
        let profile = |titles: &str, unit: Option<f64>| {
            parse(&format!("{titles}\n{points}"), &Reading { unit, pixel: None })
        };
        for (titles, expected) in [
            ("Position (mm),Height", "none of \"Height\": write it in brackets"),
            (
                "x [cubit],z [um]",
                "its title \"x [cubit]\" states no known unit of length: \"cubit\"; known are km, m",
            ),
            ("time [s],z [um]", "\"s\""),
            ("x,z\nmm,cubit", "\"cubit\""),
        ] {
            let error = profile(titles, None).unwrap_err();
            assert!(error.contains(expected), "{titles}: {error}");
        }
        let mils = profile("x [mil],z [µin]", None).unwrap();
        assert!(
            (mils.column_step / 6.35e-6 - 1.0).abs() < 1e-12
                && (mils.heights[1] / 50.8e-9 - 1.0).abs() < 1e-12
        );
        // What the titles leave open, --unit states.
        let rest = profile("Position (mm),Height", Some(1e-6)).unwrap();
        assert!(
            (rest.column_step / 0.25e-3 - 1.0).abs() < 1e-12 && (rest.heights[1] / 2e-6 - 1.0).abs() < 1e-12
        );
        assert!(profile("x [mm],z [mm]", Some(1e-6)).unwrap_err().contains("leave out --unit"));
        let matrix = "z [cubit]\n1 2 3 4\n";
        let pixel = Reading { unit: None, pixel: Some(1e-6) };
        assert!(parse(matrix, &pixel).unwrap_err().contains("\"cubit\"; known are"));
        assert_eq!(parse(&matrix.replace("cubit", "um"), &pixel).unwrap().heights[0], 1e-6);
    }

    #[test]
    fn positions_that_count_the_points_need_their_distance() {
        let counted = "index,z [um]\n0,1.5\n1,2.5\n2,4.5\n";
        assert!(read(counted).unwrap_err().contains("--pixel LENGTH"));
        let reading = Reading { unit: None, pixel: Some(0.25e-6) };
        let profile = parse(counted, &reading).unwrap();
        assert!(
            (profile.column_step / 0.25e-6 - 1.0).abs() < 1e-12
                && (profile.heights[0] / 1.5e-6 - 1.0).abs() < 1e-12
        );
        assert!(profile.remarks.is_empty());
        // They may be lengths where a unit is stated for them, or one for all with a warning.
        let lengths = read(&counted.replace("index", "x [um]")).unwrap();
        assert!((lengths.column_step / 1e-6 - 1.0).abs() < 1e-12 && lengths.remarks.is_empty());
        let untitled = parse("0 1\n1 2\n", &reading).unwrap();
        assert_eq!((untitled.column_step, untitled.remarks), (0.25e-6, vec![Warning::NoUnit]));
        let given = Reading { unit: Some(1e-6), pixel: None };
        let profile = parse(&counted.replace(" [um]", ""), &given).unwrap();
        assert_eq!(profile.remarks, [Warning::CountedPositions]);
        assert!(parse("0.5,1\n1.5,2\n", &reading).unwrap_err().contains("leave out --pixel"));
    }
}
