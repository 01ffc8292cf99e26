//! Titles of columns, and the units that they state: `x [mm], z [um]`, a comment `# x [mm] z [um]` as NumPy
//! writes it, `x/mm; z/µm`, or a second line with the units alone.

use crate::surface::units::LENGTH;

/// Lines before the first number.
#[derive(Default)]
pub(super) struct Titles {
    lines: Vec<String>,
    comments: Vec<String>,
    /// A line such as `Unit: mm`, with the unit of all columns.
    of_all: Option<String>,
}

/// What the titles say of a column.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Column {
    pub title: String,
    pub unit: Unit,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(super) enum Unit {
    #[default]
    Unstated,
    Metres(f64),
    Unknown(String),
}

impl Unit {
    pub(super) fn of(symbol: &str) -> Self {
        match (LENGTH.factor(symbol), symbol.trim()) {
            (Some(metres), _) => Self::Metres(metres),
            (None, "") => Self::Unstated,
            (None, symbol) => Self::Unknown(symbol.to_owned()),
        }
    }

    fn is_known(&self) -> bool {
        matches!(self, Self::Metres(_))
    }
}

impl Titles {
    /// A line of words, or what follows a comment sign.
    pub fn add(&mut self, line: &str, is_comment: bool) {
        match (general(line), is_comment) {
            (Some(unit), _) => self.of_all = Some(unit),
            (None, true) => self.comments.push(line.to_owned()),
            (None, false) => self.lines.push(line.to_owned()),
        }
    }

    /// Titles and units of `count` columns, by the last of the lines that have as many cells.
    pub fn columns(&self, count: usize) -> Vec<Column> {
        let mut columns = vec![Column::default(); count];
        if let Some(unit) = &self.of_all {
            columns.iter_mut().for_each(|column| column.unit = Unit::of(unit));
        }
        for cells in self.comments.iter().filter_map(|line| cells(line, count)) {
            let titled: Vec<Column> = cells.into_iter().map(|cell| Column::of(cell, false)).collect();
            // Other comments have brackets as well.
            let all_in_brackets = count > 1 && titled.iter().all(|column| column.unit != Unit::Unstated);
            if all_in_brackets || titled.iter().any(|column| column.unit.is_known()) {
                columns = titled;
            }
        }
        let mut is_titled = false;
        for cells in self.lines.iter().filter_map(|line| cells(line, count)) {
            let units: Vec<Unit> = cells.iter().map(|cell| Unit::of(without_brackets(cell))).collect();
            let known = units.iter().filter(|unit| unit.is_known()).count();
            if known == count || (is_titled && known > 0) {
                columns.iter_mut().zip(units).for_each(|(column, unit)| column.unit = unit);
                continue;
            }
            is_titled = true;
            let titled: Vec<Column> = cells.into_iter().map(|cell| Column::of(cell, true)).collect();
            match titled.iter().all(|column| column.unit == Unit::Unstated) {
                true => columns.iter_mut().zip(titled).for_each(|(column, new)| column.title = new.title),
                false => columns = titled,
            }
        }
        columns
    }

    /// The unit that all columns of a matrix have by its titles, however many these are.
    pub fn of_matrix(&self) -> Unit {
        let bracketed = self.lines.iter().flat_map(|line| line.split_inclusive([']', ')']));
        let titled = bracketed.map(|cell| Column::of(cell, true).unit);
        let of_all = self.of_all.iter().map(|unit| Unit::of(unit));
        let mut units = of_all.chain(titled).chain(self.of_heights()).filter(|u| *u != Unit::Unstated);
        let Some(first) = units.next() else { return Unit::Unstated };
        match units.find(|unit| *unit != first) {
            None => first,
            Some(_) => Unit::Unknown("different units of heights".into()),
        }
    }

    /// Known units of comments such as `# Height [nm]`; in others they may be those of points.
    fn of_heights(&self) -> impl Iterator<Item = Unit> {
        const HEIGHTS: [&str; 7] = ["height", "heights", "z", "topography", "höhe", "höhen", "hauteur"];
        let first = |line: &String| line.split_inclusive([']', ')']).next().unwrap_or_default().to_owned();
        let of_heights = |cell: &String| HEIGHTS.contains(&before_bracket(cell).to_lowercase().as_str());
        let cells = self.comments.iter().map(first).filter(of_heights);
        cells.map(|cell| Column::of(&cell, false).unit).filter(Unit::is_known)
    }
}

/// Words before the first bracket.
fn before_bracket(line: &str) -> &str {
    line.split(['[', '(']).next().unwrap_or_default().trim()
}

impl Column {
    /// A column from a title with its unit in brackets, or `after_stroke` behind a stroke.
    fn of(title: &str, after_stroke: bool) -> Self {
        let between = |open, close| {
            let (_, rest) = title.rsplit_once(open)?;
            rest.split(close).next()
        };
        let stroke = || {
            let (_, symbol) = title.rsplit_once('/').filter(|_| after_stroke)?;
            LENGTH.factor(symbol).map(|_| symbol)
        };
        let symbol = between('[', ']').or_else(|| between('(', ')')).or_else(stroke);
        Self { title: title.trim().to_owned(), unit: symbol.map_or(Unit::Unstated, Unit::of) }
    }
}

/// The unit of a line such as `Units: mm`.
fn general(line: &str) -> Option<String> {
    let (key, unit) = line.split_once(':')?;
    let key = key.trim().to_lowercase();
    matches!(key.as_str(), "unit" | "units").then(|| unit.trim().to_owned())
}

fn without_brackets(cell: &str) -> &str {
    cell.trim().trim_start_matches(['[', '(']).trim_end_matches([']', ')'])
}

/// A line in as many cells as there are columns: by separators, of which one may end the line, behind brackets, or
/// by words.
fn cells(line: &str, count: usize) -> Option<Vec<&str>> {
    const SEPARATORS: [char; 3] = [',', ';', '\t'];
    let line = line.trim();
    let ended = line.strip_suffix(SEPARATORS).unwrap_or(line);
    let ways: [Vec<&str>; 5] = [
        ended.split(SEPARATORS).map(str::trim).collect(),
        line.split(SEPARATORS).map(str::trim).collect(),
        ended.split_inclusive([']', ')']).map(str::trim).filter(|cell| !cell.is_empty()).collect(),
        ended.split_whitespace().collect(),
        vec![ended],
    ];
    ways.into_iter().find(|cells| cells.len() == count && !line.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The unit of each column: metres, unstated as 0, unknown as NaN.
    fn units(lines: &[&str], count: usize) -> Vec<f64> {
        let mut titles = Titles::default();
        for line in lines {
            match line.strip_prefix('#') {
                Some(comment) => titles.add(comment, true),
                None => titles.add(line, false),
            }
        }
        let metres = |column: Column| match column.unit {
            Unit::Metres(metres) => metres,
            Unit::Unstated => 0.0,
            Unit::Unknown(_) => f64::NAN,
        };
        titles.columns(count).into_iter().map(metres).collect()
    }

    #[test]
    fn units_are_found_in_every_form_of_titles() {
        for lines in [
            &["x [mm],z [um]"][..],
            &["# x [mm] z [um]"],
            &["# written by numpy", "# X [mm]\tZ [um]", "# of a stylus (Mahr)"],
            &["Position (mm) Height (um)"],
            &["Höhe (Profil 1) [mm];z [µm];"],
            &["Abstand/mm;Höhe/µm"],
            &["x,z", "mm,um"],
            &["Weg;Hoehe", "[mm];[um]"],
            &["mm um"],
        ] {
            assert_eq!(units(lines, 2), [1e-3, 1e-6], "{lines:?}");
        }
        assert_eq!(units(&["# x [um] y [um] z [nm]"], 3), [1e-6, 1e-6, 1e-9]);
        assert_eq!(units(&["Unit: mm", "x,z"], 2), [1e-3, 1e-3]);
        assert_eq!(units(&["# z [um]"], 1), [1e-6]);
    }

    #[test]
    fn what_is_unknown_or_unstated_is_kept_apart() {
        let same =
            |one: Vec<f64>, other: [f64; 2]| one.iter().zip(other).all(|(a, b)| a.total_cmp(&b).is_eq());
        assert_eq!(units(&["Position (mm),Height"], 2), [1e-3, 0.0]);
        assert_eq!(units(&["x,z"], 2), [0.0, 0.0]);
        assert_eq!(units(&["x,z", "mm,"], 2), [1e-3, 0.0]);
        assert!(same(units(&["time [s],z [um]"], 2), [f64::NAN, 1e-6]));
        assert!(same(units(&["x,z", "mm,cubit"], 2), [1e-3, f64::NAN]));
        assert!(same(units(&["# x [cubit] z [cubit]"], 2), [f64::NAN, f64::NAN]));
        for remark in ["# measured (Mahr)", "# [2024] stylus", "# speed 1 mm/s", "# N/mm force"] {
            assert_eq!(units(&[remark], 2), [0.0, 0.0], "{remark}");
        }
    }
}
