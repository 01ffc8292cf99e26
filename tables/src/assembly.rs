//! Tables made in pieces: what is missing, shards, added points.

use crate::table::{Axes, Status, Table, TableError};

impl Table {
    /// Grid points that have not been run, in the order of the grid.
    pub fn missing(&self) -> Vec<(usize, usize)> {
        (self.grid()).filter(|(i, j)| *self.status(*i, *j) == Status::NotRun).collect()
    }

    /// Takes over from `other` what is done there and not here, or failed there and not run
    /// here; axes, radius and scene must be the same.
    pub fn merge(&mut self, other: &Table) -> Result<(), TableError> {
        if self.axes() != other.axes() {
            return Err(TableError::Different("their axes"));
        }
        if self.metadata().asperity_radius != other.metadata().asperity_radius {
            return Err(TableError::Different("asperity_radius"));
        }
        if self.metadata().scene != other.metadata().scene {
            return Err(TableError::Different("scene"));
        }
        for (i, j) in self.grid() {
            let better = match (self.status(i, j), other.status(i, j)) {
                (Status::Done(_), _) => false,
                (_, Status::Done(_)) => true,
                (Status::NotRun, Status::Failed(_)) => true,
                _ => false,
            };
            if better {
                self.set_status(i, j, other.status(i, j).clone());
            }
        }
        Ok(())
    }

    /// The same results on other interferences and slip rates: grid points at equal coordinates
    /// keep their state, new ones are not run. The slip axis must stay.
    pub fn regridded(&self, axes: Axes) -> Result<Table, TableError> {
        if axes.slip != self.axes().slip {
            return Err(TableError::Different("their slip axis"));
        }
        let mut table = Table::new(axes, self.metadata().clone())?;
        let find = |axis: &[f64], value: f64| axis.iter().position(|known| *known == value);
        for (i, omega) in table.axes().interference.clone().into_iter().enumerate() {
            let Some(i_here) = find(&self.axes().interference, omega) else {
                continue;
            };
            for (j, rate) in table.axes().slip_rate.clone().into_iter().enumerate() {
                if let Some(j_here) = find(&self.axes().slip_rate, rate) {
                    table.set_status(i, j, self.status(i_here, j_here).clone());
                }
            }
        }
        Ok(table)
    }

    /// Every (i, j), slip rates of the first interference first.
    pub(crate) fn grid(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let (interferences, rates) = self.shape();
        (0..interferences).flat_map(move |i| (0..rates).map(move |j| (i, j)))
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
    fn shards_merge_to_the_whole() {
        let mut whole = Table::new(axes(), Metadata::default()).unwrap();
        let (mut first, mut second) = (whole.clone(), whole.clone());
        whole.set_cell(0, 1, cell(0.3)).unwrap();
        first.set_cell(0, 1, cell(0.3)).unwrap();
        first.mark_failed(1, 1, "no memory");
        whole.set_cell(1, 1, cell(0.2)).unwrap();
        second.set_cell(1, 1, cell(0.2)).unwrap();
        first.merge(&second).unwrap();
        assert_eq!(first, whole);
    }

    #[test]
    fn regridding_keeps_what_is_known() {
        let mut table = Table::new(axes(), Metadata::default()).unwrap();
        table.set_cell(1, 1, cell(0.3)).unwrap();
        let mut finer = axes();
        finer.interference.insert(1, 1.4);
        let finer = table.regridded(finer).unwrap();
        assert_eq!(finer.shape(), (3, 3));
        assert_eq!(finer.cell(2, 1), table.cell(1, 1));
        assert_eq!(finer.missing().len(), 8);
    }
}
