//! Text: a matrix of heights, columns x y z on a grid, a profile x z, or a column of heights.
//!
//! Comments start with `#` or `%`; numbers are separated by white space, commas or semicolons, and may have
//! decimal commas where something else separates them. The header that Gwyddion writes before a matrix
//! (`# Width: 5.0 µm`) is understood, and [titles](super::titles) of columns with their unit.

use super::profile::{EVEN, profile};
use super::reading::Reading;
use super::titles::{Column, Titles, Unit};
use super::units::{units_of_columns, unknown_unit};
use crate::surface::text::Commas;
use crate::surface::units::length;
use crate::topography::Topography;
use crate::topography::warning::Warning;
use tables::numbers::plain;

pub(super) fn parse(text: &str, reading: &Reading) -> Result<Topography, String> {
    // Spreadsheets begin with a byte order mark.
    let mut text = unquoted(text.trim_start_matches('\u{feff}'));
    if !text.contains('\n') {
        // Line ends of old instruments.
        text = text.replace('\r', "\n");
    }
    let text = &text;
    let mut remarks = Vec::new();
    let commas = Commas::of(text.lines().map(|line| without_comment(line).0));
    if commas == Commas::Decimal {
        remarks.push(Warning::DecimalCommas);
    }
    let (header, lines) = numbers(text, commas == Commas::Decimal)?;
    let count = lines.first().map_or(0, Vec::len);
    if count > 3 {
        return matrix(&header, &lines, reading, remarks);
    }
    let columns: Vec<Vec<f64>> =
        (0..count).map(|index| lines.iter().map(|line| line[index]).collect()).collect();
    let units = units_of_columns(&header.columns(count), &columns, reading, &mut remarks)?;
    let scaled =
        |(column, unit): (&Vec<f64>, &f64)| column.iter().map(|value| unit * value).collect::<Vec<f64>>();
    let columns: Vec<Vec<f64>> = columns.iter().zip(&units).map(scaled).collect();
    match &columns[..] {
        [] => Err("holds no numbers".into()),
        [z] => Ok(Topography { remarks, ..Topography::profile(reading.pixel()?, z.clone()) }),
        [x, z] => profile(x, z, remarks).map_err(|error| match text.contains(',') {
            true => format!("{error}; or are these decimal commas of single heights? write points"),
            false => error,
        }),
        [x, y, z, ..] => grid(x, y, z, remarks),
    }
}

/// A matrix of heights.
fn matrix(
    header: &Header,
    lines: &[Vec<f64>],
    reading: &Reading,
    mut remarks: Vec<Warning>,
) -> Result<Topography, String> {
    let (rows, columns) = (lines.len(), lines[0].len());
    if has_axes(lines) {
        return Err(
            "its first row and first column are evenly spaced and their common cell is empty: positions, \
             not heights; leave them out and give their distance with --pixel LENGTH"
                .into(),
        );
    }
    let (row_step, column_step) = match (reading.pixel, header.width.zip(header.height)) {
        (Some(_), Some(_)) => return Err("states its width and height; leave out --pixel".into()),
        (None, Some((width, height))) => (height / rows as f64, width / columns as f64),
        _ => (reading.pixel()?, reading.pixel()?),
    };
    let (whose, unit) = match &header.unit {
        Unit::Unstated => ("its titles", header.titles.of_matrix()),
        stated => ("its header", stated.clone()),
    };
    let stated = match unit {
        Unit::Metres(unit) => Some(unit),
        Unit::Unknown(symbol) if reading.unit.is_none() => return Err(unknown_unit(whose, &symbol)),
        _ => None,
    };
    if stated.is_some_and(|stated| reading.unit.is_some_and(|given| given != stated)) {
        return Err("states another unit of its heights; leave out --unit".into());
    }
    let unit = reading.unit(stated, &mut remarks);
    let heights = lines.iter().flatten().map(|height| unit * height).collect();
    let map = Topography::map((rows, row_step), (columns, column_step), heights);
    Ok(Topography { remarks, ..map })
}

/// Whether a matrix has positions in its first row and column, and nothing in the cell of both, as spreadsheets
/// export it.
fn has_axes(lines: &[Vec<f64>]) -> bool {
    let even = |positions: &[f64]| {
        let step = positions[1] - positions[0];
        step != 0.0 && positions.windows(2).all(|pair| (pair[1] - pair[0] - step).abs() <= EVEN * step.abs())
    };
    let column: Vec<f64> = lines.iter().skip(1).map(|line| line[0]).collect();
    lines[0][0].is_nan() && column.len() > 1 && even(&lines[0][1..]) && even(&column)
}

/// What of a line is not a comment, and the comment.
fn without_comment(line: &str) -> (&str, &str) {
    line.split_at(line.find(['#', '%']).unwrap_or(line.len()))
}

/// Cells without their quotation marks: a comma within these is decimal.
fn unquoted(text: &str) -> String {
    let mut within = false;
    let letter = |letter: char| {
        within ^= letter == '"';
        within &= letter != '\n';
        match letter {
            '"' => None,
            ',' if within => Some('.'),
            other => Some(other),
        }
    };
    text.chars().filter_map(letter).collect()
}

/// Header and lines of as many numbers each.
fn numbers(text: &str, decimal_commas: bool) -> Result<(Header, Vec<Vec<f64>>), String> {
    let mut header = Header::default();
    let mut lines: Vec<Vec<f64>> = Vec::new();
    let mut places = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let (content, comment) = without_comment(line);
        // Titles and their units are before the first number.
        header.take(comment.trim_start_matches(['#', '%', ' ']), lines.is_empty());
        let with_points = if decimal_commas { content.replace(',', ".") } else { content.to_owned() };
        if with_points.contains(';') && with_points.contains(',') {
            return Err(format!(
                "line {}: has commas and semicolons: where commas separate thousands, write numbers without them",
                index + 1
            ));
        }
        let words = words(&with_points);
        // Titles of the columns, before the first number.
        let mut said = words.iter().filter(|word| !word.is_empty()).peekable();
        if lines.is_empty() && said.peek().is_some() && said.all(|word| number(word).is_none()) {
            header.titles.add(content, false);
            continue;
        }
        let remedy = match lines.is_empty() {
            true => "lines before the heights begin with #",
            false => "a point without a height is nan, --- or an empty cell",
        };
        let or_where = |word: &&str| {
            number(word).ok_or_else(|| format!("line {}: \"{word}\" is not a number; {remedy}", index + 1))
        };
        let numbers: Vec<f64> = words.iter().map(or_where).collect::<Result<_, _>>()?;
        if !numbers.is_empty() {
            lines.push(numbers);
            places.push((index + 1, content.trim().ends_with([',', ';'])));
        }
    }
    // A separator that ends every line is no empty cell.
    if places.iter().all(|(_, separated)| *separated) {
        lines.iter_mut().for_each(|line| line.truncate(line.len() - 1));
    }
    let before = lines.first().map_or(0, Vec::len);
    if let Some((line, (place, _))) = lines.iter().zip(&places).find(|(line, _)| line.len() != before) {
        return Err(format!(
            "line {place}: {} numbers, {before} in the lines before; write NaN for a point without a height",
            line.len()
        ));
    }
    Ok((header, lines))
}

/// The words of a line, separated by commas, semicolons or white space; an empty cell beside a separator is a word without
/// characters.
fn words(content: &str) -> Vec<&str> {
    let content = content.trim();
    if content.is_empty() {
        return Vec::new();
    }
    let cells = content.split([',', ';']).map(str::trim);
    cells
        .flat_map(|cell| if cell.is_empty() { vec![cell] } else { cell.split_whitespace().collect() })
        .collect()
}

/// A number, or what stands for a missing value.
fn number(word: &str) -> Option<f64> {
    const MISSING: [&str; 9] = ["", "---", "nan", "NaN", "NAN", "bad", "BAD", "***", "*****"];
    match word.parse::<f64>() {
        Ok(number) => Some(number),
        Err(_) => MISSING.contains(&word).then_some(f64::NAN),
    }
}

/// Lengths in the header of a matrix, m.
#[derive(Default)]
struct Header {
    width: Option<f64>,
    height: Option<f64>,
    unit: Unit,
    titles: Titles,
}

impl Header {
    fn take(&mut self, comment: &str, before_numbers: bool) {
        if before_numbers && !comment.is_empty() {
            self.titles.add(comment, true);
        }
        let Some((key, value)) = comment.split_once(':') else {
            return;
        };
        let value = value.trim();
        match key.trim() {
            "Width" => self.width = length(value).ok(),
            "Height" => self.height = length(value).ok(),
            "Value units" => self.unit = Unit::of(value),
            _ => {}
        }
    }

    /// Titles and units of the columns; the last one holds the heights.
    fn columns(&self, count: usize) -> Vec<Column> {
        let mut columns = self.titles.columns(count);
        if let Some(heights) = columns.last_mut().filter(|_| self.unit != Unit::Unstated) {
            heights.unit = self.unit.clone();
        }
        columns
    }
}

/// Points of the grid per point given, above which it is no map; maps of which a tenth is missing are refused later.
const MOST_POINTS_OVER_GIVEN: usize = 2;

/// A map of points (x, y, z), m, in any order, which must be those of a regular grid; points that
/// are left out are undefined.
fn grid(x: &[f64], y: &[f64], z: &[f64], remarks: Vec<Warning>) -> Result<Topography, String> {
    let (x_from, x_step, columns) = axis("x", x)?;
    let (y_from, y_step, rows) = axis("y", y)?;
    if rows.saturating_mul(columns) > MOST_POINTS_OVER_GIVEN * z.len() {
        let given = z.len() as f64 / rows as f64 / columns as f64;
        return Err(format!(
            "three columns must be x y z on a regular grid; of {rows} x {columns} points {:.2} % are given: a profile has the two \
             columns of position and height",
            100.0 * given
        ));
    }
    let mut heights = vec![f64::NAN; rows * columns];
    for ((x, y), z) in x.iter().zip(y).zip(z) {
        let place = |value: f64, from: f64, step: f64| ((value - from) / step).round() as usize;
        let height = &mut heights[place(*y, y_from, y_step) * columns + place(*x, x_from, x_step)];
        if !height.is_nan() && !z.is_nan() && *height != *z {
            return Err(format!(
                "two points at x = {} m, y = {} m have different heights: each position may appear once",
                plain(*x),
                plain(*y)
            ));
        }
        if !z.is_nan() {
            *height = *z;
        }
    }
    Ok(Topography { remarks, ..Topography::map((rows, y_step), (columns, x_step), heights) })
}

/// Start, step and number of the even positions that `values` take.
fn axis(name: &str, values: &[f64]) -> Result<(f64, f64, usize), String> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let (from, to) = (sorted[0], sorted[sorted.len() - 1]);
    if !(from.is_finite() && to.is_finite()) {
        return Err(format!("a position {name} is no number"));
    }
    // Positions written with few digits repeat up to rounding.
    let rounding = 1e-6 * (to - from);
    sorted.dedup_by(|next, kept| *next - *kept <= rounding);
    let count = sorted.len();
    if count < 2 {
        return Err(format!("all points have the same {name}"));
    }
    let step = (to - from) / (count - 1) as f64;
    if (0..count).any(|i| (sorted[i] - from - step * i as f64).abs() > EVEN * step) {
        return Err(format!("three columns must be x y z on a regular grid; {name} is not evenly spaced"));
    }
    Ok((from, step, count))
}

#[cfg(test)]
mod tests;
