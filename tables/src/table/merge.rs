//! Tables made in parts: missing points, shards, added points.

use crate::numbers::digits;
use crate::table::sentences::{Sentence, condensed};
use crate::table::{Axes, Slice, Status, TableError};

impl Slice {
    /// Grid points that have not been run, in the order of the grid.
    pub fn missing(&self) -> Vec<(usize, usize)> {
        (self.grid()).filter(|(i, j)| *self.status(*i, *j) == Status::NotRun).collect()
    }

    /// Grid points that failed, by their [`label`](Self::label), and why.
    pub fn failures(&self) -> impl Iterator<Item = (String, &str)> {
        self.grid().filter_map(|(i, j)| Some((self.label(i, j), self.status(i, j).reason()?)))
    }

    /// Takes from `other` the cells done there and not here, or failed there and not run
    /// here. Request, axes and program must be the same, and so must be what both have done,
    /// but for the wall times.
    pub fn merge(&mut self, other: &Slice) -> Result<(), TableError> {
        use Status::{Done, Failed, NotRun};
        self.check_same_origin(other)?;
        for (i, j) in self.grid() {
            if let (Some(cell), Some(there)) = (self.cell(i, j), other.cell(i, j))
                && !cell.agrees_with(there)
            {
                let (interference, slip_rate) = self.coordinates(i, j);
                return Err(TableError::Disagree { interference, slip_rate });
            }
        }
        for (i, j) in self.grid() {
            let states = (self.status(i, j), other.status(i, j));
            if let (NotRun | Failed(_), there @ Done(_)) | (NotRun, there @ Failed(_)) = states {
                self.set_status(i, j, there.clone());
            }
        }
        self.metadata_mut().comment = self.warnings().join("\n");
        Ok(())
    }

    fn check_same_origin(&self, other: &Slice) -> Result<(), TableError> {
        let (here, there) = (self.metadata(), other.metadata());
        let texts = [
            ("their program", &here.source, &there.source),
            ("the fingerprint of their program", &here.fingerprint, &there.fingerprint),
            ("their request", &here.scene, &there.scene),
        ];
        for (what, here, there) in texts {
            if here != there {
                let (here, there) = first_difference(here, there);
                return Err(TableError::Different { what, here, there });
            }
        }
        let axes = |table: &Slice| format!("{:?}", table.axes());
        let values = [
            ("asperity_radius", here.asperity_radius.to_string(), there.asperity_radius.to_string()),
            ("their axes", axes(self), axes(other)),
        ];
        for (what, here, there) in values {
            if here != there {
                return Err(TableError::Different { what, here, there });
            }
        }
        Ok(())
    }

    /// Every warning of a cell once, with the ranges of its numbers, and the cells that it concerns unless these are all.
    pub fn warnings(&self) -> Vec<String> {
        let done: Vec<_> = self.grid().filter_map(|(i, j)| Some(((i, j), self.cell(i, j)?))).collect();
        let warnings = done
            .iter()
            .flat_map(|(place, cell)| cell.warnings.iter().map(|text| Sentence::new(text, *place)));
        let labelled = |warning: Sentence| {
            let text = warning.text();
            if warning.places.len() == done.len() {
                return text;
            }
            format!("{text} [{}]", self.blocks(warning.places).join("; "))
        };
        condensed(warnings).into_iter().map(labelled).collect()
    }

    /// Points of the grid in words: consecutive interferences with the same slip rates together.
    pub fn blocks(&self, mut places: Vec<(usize, usize)>) -> Vec<String> {
        places.sort_unstable();
        places.dedup();
        // First and last interference, slip rates.
        let mut blocks: Vec<(usize, usize, Vec<usize>)> = Vec::new();
        for row in places.chunk_by(|one, next| one.0 == next.0) {
            let (i, columns) = (row[0].0, row.iter().map(|(_, j)| *j).collect());
            match blocks.last_mut() {
                Some((_, last, known)) if *last + 1 == i && *known == columns => *last = i,
                _ => blocks.push((i, i, columns)),
            }
        }
        let range = |axis: &[f64], first: usize, last: usize| {
            let [from, to] = [first, last].map(|index| digits(axis[index], LABEL_DIGITS));
            if first == last { from } else { format!("{from} to {to}") }
        };
        let Axes { interference, slip_rate, .. } = self.axes();
        let block = |(first, last, columns): (usize, usize, Vec<usize>)| -> Vec<String> {
            let rows = range(interference, first, last);
            let runs = columns.chunk_by(|one, next| one + 1 == *next);
            runs.map(|run| format!("{rows} omega_c at {} m/s", range(slip_rate, run[0], run[run.len() - 1])))
                .collect()
        };
        blocks.into_iter().flat_map(block).collect()
    }

    /// A point of the grid by its coordinates, rounded.
    pub fn label(&self, i: usize, j: usize) -> String {
        let (interference, slip_rate) = self.coordinates(i, j);
        label(interference, slip_rate)
    }

    /// (ω₀/ω_c, V in m/s) of a point of the grid.
    pub fn coordinates(&self, i: usize, j: usize) -> (f64, f64) {
        (self.axes().interference[i], self.axes().slip_rate[j])
    }

    /// The same results on other interferences and slip rates: grid points at equal coordinates
    /// keep their state, new ones are not run. The slip axis must stay.
    pub fn regridded(&self, axes: Axes) -> Result<Slice, TableError> {
        if axes.slip != self.axes().slip {
            let slips = |axes: &Axes| format!("{:?}", axes.slip);
            return Err(TableError::Different {
                what: "their slip axis",
                here: slips(self.axes()),
                there: slips(&axes),
            });
        }
        let mut table = Slice::new(axes, self.metadata().clone())?;
        let find = |axis: &[f64], value: f64| axis.iter().position(|known| *known == value);
        for (i, j) in table.grid() {
            let (omega, rate) = table.coordinates(i, j);
            let here = find(&self.axes().interference, omega).zip(find(&self.axes().slip_rate, rate));
            if let Some((i_here, j_here)) = here {
                table.set_status(i, j, self.status(i_here, j_here).clone());
            }
        }
        Ok(table)
    }

    /// Every (i, j), slip rates of the first interference first.
    pub fn grid(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let (interferences, rates) = self.shape();
        (0..interferences).flat_map(move |i| (0..rates).map(move |j| (i, j)))
    }
}

/// Digits of the coordinates of a cell in text.
pub const LABEL_DIGITS: usize = 4;

/// A cell by its interference, ω_c, and slip rate, m/s, rounded.
pub fn label(interference: f64, slip_rate: f64) -> String {
    format!("{} omega_c at {} m/s", digits(interference, LABEL_DIGITS), digits(slip_rate, LABEL_DIGITS))
}

/// The first lines in which two texts differ.
pub(crate) fn first_difference(here: &str, there: &str) -> (String, String) {
    let mut lines = (here.lines(), there.lines());
    loop {
        match (lines.0.next(), lines.1.next()) {
            (Some(here), Some(there)) if here == there => {}
            (here, there) => {
                let quoted = |line: Option<&str>| line.map_or("nothing".into(), |line| format!("\"{line}\""));
                return (quoted(here), quoted(there));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::Quantity;
    use crate::table::{Cell, Metadata};

    fn axes() -> Axes {
        Axes { interference: vec![1.0, 2.0], slip_rate: vec![0.0, 0.5, 1.0], slip: vec![0.0, 2.0] }
    }

    fn cell(mu: f64) -> Cell {
        Cell::new().with(Quantity::Mu, mu, 0.01)
    }

    #[test]
    fn a_warning_of_neighbouring_cells_names_their_ranges() {
        let axes = Axes { interference: vec![1.0, 2.0, 3.0, 4.0], ..axes() };
        let mut slice = Slice::new(axes, Metadata::default()).unwrap();
        let warned = [(0, 1), (0, 2), (1, 1), (1, 2), (3, 1), (3, 2)];
        for (i, j) in slice.grid() {
            let mut cell = Cell { warnings: vec!["everywhere".to_owned()], ..cell(0.3) };
            cell.warnings.extend(warned.contains(&(i, j)).then(|| "hot".to_owned()));
            cell.warnings.extend([(0, 0), (0, 2), (1, 1)].contains(&(i, j)).then(|| "odd".to_owned()));
            slice.set_cell(i, j, cell).unwrap();
        }
        let odd = "odd [1 omega_c at 0 m/s; 1 omega_c at 1 m/s; 2 omega_c at 0.5 m/s]";
        let hot = "hot [1 to 2 omega_c at 0.5 to 1 m/s; 4 omega_c at 0.5 to 1 m/s]";
        assert_eq!(slice.warnings(), ["everywhere", odd, hot]);
    }

    #[test]
    fn what_does_not_belong_together_is_not_merged() {
        let table = |metadata| Slice::new(axes(), metadata).unwrap();
        let refused = |metadata: Metadata| {
            let mut here = table(Metadata { scene: "a = 1\nb = 2\n".into(), ..Metadata::default() });
            here.merge(&table(metadata)).unwrap_err().to_string()
        };
        let other = refused(Metadata { scene: "a = 1\nb = 3\n".into(), ..Metadata::default() });
        assert_eq!(other, "the tables differ in their request: \"b = 2\" and \"b = 3\"");
        let other = refused(Metadata { fingerprint: "ab".into(), ..Metadata::default() });
        assert!(other.contains("the fingerprint of their program: nothing and \"ab\""), "{other}");
        let mut finer = axes();
        finer.interference[0] = 1.5;
        let finer = Slice::new(finer, Metadata::default()).unwrap();
        let error = table(Metadata::default()).merge(&finer).unwrap_err().to_string();
        assert!(error.contains("their axes"), "{error}");
    }

    #[test]
    fn overlaps_must_agree_but_for_the_wall_time() {
        let mut first = Slice::new(axes(), Metadata::default()).unwrap();
        let mut second = first.clone();
        let timed = |wall_time: f64| {
            let mut cell = cell(0.3);
            cell.wall_time = wall_time;
            cell
        };
        first.set_cell(0, 1, timed(1.0)).unwrap();
        second.set_cell(0, 1, timed(2.0)).unwrap();
        first.merge(&second).unwrap();
        assert_eq!(first.cell(0, 1).unwrap().wall_time, 1.0);
        second.set_cell(0, 1, cell(0.300001)).unwrap();
        let (before, error) = (first.clone(), first.merge(&second).unwrap_err());
        assert_eq!(first, before);
        assert_eq!(
            error.to_string(),
            "the tables have different results at interference 1 and slip rate 0.5 m/s"
        );
    }

    #[test]
    fn regridding_keeps_what_is_known() {
        let mut table = Slice::new(axes(), Metadata::default()).unwrap();
        table.set_cell(1, 1, cell(0.3)).unwrap();
        let mut finer = axes();
        finer.interference.insert(1, 1.4);
        let finer = table.regridded(finer).unwrap();
        assert_eq!(finer.shape(), (3, 3));
        assert_eq!(finer.cell(2, 1), table.cell(1, 1));
        assert_eq!(finer.missing().len(), 8);
    }
}
