//! Numeric Cholesky factorisation of several harmonics together.
//!
//! The harmonics share one sparsity pattern, so each operation acts on all of them as lanes. Consecutive columns with
//! the same rows below form a panel, at least the components of a node. The factorisation is left-looking by panels
//! (Ng & Peyton 1993, SIAM J. Sci. Comput. 14, 1034, doi:10.1137/0914063): earlier columns are read once per panel
//! instead of once per column.

use std::ops::Range;

use super::FactorError;
use crate::material::{elementary::fma, lanes::Lanes};
use crate::solver::StopRequest;

/// Largest number of columns of a panel: the operands of an update fit into the registers.
const WIDEST: usize = 3;
/// Number of panels factorised between two evaluations of the stop request.
const PANELS_BETWEEN_STOPS: usize = 256;

/// Sparsity pattern of a factor L, stored by columns.
#[derive(Debug)]
pub struct FactorPattern {
    /// Start of each column; in a column the diagonal is first and the rows are in ascending order.
    column_start: Vec<usize>,
    row: Vec<u32>,
    /// Index in L of each entry of the upper triangle of the matrix.
    entry_in_factor: Vec<u32>,
    /// First column of each panel.
    panel_start: Vec<usize>,
    /// For each panel: the earlier panels that update it, and for each of these the offset of its first row inside
    /// the updated panel.
    update_start: Vec<usize>,
    update: Vec<(u32, u32)>,
}

impl FactorPattern {
    /// Pattern from the columns of L, diagonal first and rows in ascending order, and the columns of the upper triangle of a
    /// matrix.
    pub fn new(column_start: &[usize], row: &[usize], upper_start: &[usize], upper_row: &[usize]) -> Self {
        let n = column_start.len() - 1;
        let rows = |j: usize| &row[column_start[j]..column_start[j + 1]];
        let mut entry_in_factor = Vec::with_capacity(upper_row.len());
        let mut panel_start = vec![0];
        for j in 0..n {
            assert!(rows(j)[0] == j && rows(j).is_sorted());
            for &i in &upper_row[upper_start[j]..upper_start[j + 1]] {
                let entry = rows(i).binary_search(&j).expect("L has the entries of the matrix");
                entry_in_factor.push((column_start[i] + entry) as u32);
            }
            let first = panel_start[panel_start.len() - 1];
            if j > 0 && (j == first + WIDEST || rows(j - 1)[1..] != *rows(j)) {
                panel_start.push(j);
            }
        }
        panel_start.push(n);
        let row = row.iter().map(|&i| i as u32).collect();
        let column_start = column_start.to_vec();
        let mut pattern = Self {
            column_start,
            row,
            entry_in_factor,
            panel_start,
            update_start: vec![0],
            update: Vec::new(),
        };
        pattern.find_updates();
        pattern
    }

    fn find_updates(&mut self) {
        let panels = self.panel_start.len() - 1;
        let mut panel_of = vec![0; self.column_start.len() - 1];
        for p in 0..panels {
            panel_of[self.columns(p)].fill(p);
        }
        let mut updates = vec![Vec::new(); panels];
        for p in 0..panels {
            let mut last = p;
            for (offset, &i) in self.row[self.below(p)].iter().enumerate() {
                let target = panel_of[i as usize];
                if target != last {
                    updates[target].push((p as u32, offset as u32));
                    last = target;
                }
            }
        }
        for list in updates {
            self.update.extend(list);
            self.update_start.push(self.update.len());
        }
    }

    fn columns(&self, panel: usize) -> Range<usize> {
        self.panel_start[panel]..self.panel_start[panel + 1]
    }

    /// Entries of the last column of a panel below its diagonal; all columns of the panel have these rows.
    fn below(&self, panel: usize) -> Range<usize> {
        let last = self.panel_start[panel + 1];
        self.column_start[last - 1] + 1..self.column_start[last]
    }

    /// Entries of L of the matrices, of M harmonics from the harmonic `first` on, whose upper triangles are `value(k)` at the k-th
    /// entry of its pattern.
    pub fn cholesky<const M: usize>(
        &self,
        value: impl Fn(usize) -> Lanes<M>,
        first: usize,
        stop: &StopRequest,
    ) -> Result<Vec<Lanes<M>>, FactorError> {
        let mut lower = vec![[0.0; M]; self.row.len()];
        for (k, &entry) in self.entry_in_factor.iter().enumerate() {
            lower[entry as usize] = value(k);
        }
        // Position of each row in the panel, and the dense panel, row by row.
        let mut local = vec![0; self.column_start.len() - 1];
        let mut panel = Vec::new();
        for p in 0..self.panel_start.len() - 1 {
            if p.is_multiple_of(PANELS_BETWEEN_STOPS) && stop() {
                return Err(FactorError::Stopped);
            }
            let columns = self.columns(p);
            let below = &self.row[self.below(p)];
            for (at, row) in columns.clone().chain(below.iter().map(|&i| i as usize)).enumerate() {
                local[row] = at as u32;
            }
            let (done, own) = lower.split_at_mut(self.column_start[columns.start]);
            panel.clear();
            panel.resize(columns.len() + below.len(), [[0.0; M]; WIDEST]);
            self.copy_panel(columns.clone(), |at, q, entry| panel[at][q] = own[entry]);
            for &(source, offset) in &self.update[self.update_start[p]..self.update_start[p + 1]] {
                let update = Update {
                    lower: done,
                    columns: self.columns(source as usize),
                    rows: &self.row[self.below(source as usize)][offset as usize..],
                    column_start: &self.column_start,
                    local: &local,
                };
                match update.columns.len() {
                    1 => update.subtract::<1>(columns.clone(), &mut panel),
                    2 => update.subtract::<2>(columns.clone(), &mut panel),
                    _ => update.subtract::<WIDEST>(columns.clone(), &mut panel),
                }
            }
            factorise_panel(columns.len(), &mut panel)
                .map_err(|lane| FactorError::NotPositiveDefinite { harmonic: first + lane })?;
            self.copy_panel(columns, |at, q, entry| own[entry] = panel[at][q]);
        }
        Ok(lower)
    }

    /// Calls `copy` for each entry of a panel: row and column in the panel, and position relative to its first column.
    fn copy_panel(&self, columns: Range<usize>, mut copy: impl FnMut(usize, usize, usize)) {
        let first = self.column_start[columns.start];
        for (q, j) in columns.enumerate() {
            let begin = self.column_start[j] - first;
            (0..self.column_start[j + 1] - self.column_start[j]).for_each(|k| copy(q + k, q, begin + k));
        }
    }
}

/// Update of a panel by an earlier one.
struct Update<'a, const M: usize> {
    lower: &'a [Lanes<M>],
    columns: Range<usize>,
    /// Rows of the earlier panel from the first one inside the updated panel on.
    rows: &'a [u32],
    column_start: &'a [usize],
    local: &'a [u32],
}

impl<const M: usize> Update<'_, M> {
    /// Subtracts the contribution of S columns from the columns `target`. Rows of `target` that the pattern of the
    /// earlier panel lacks contribute zero.
    #[inline(always)]
    fn subtract<const S: usize>(&self, target: Range<usize>, panel: &mut [[Lanes<M>; WIDEST]]) {
        let columns: [&[Lanes<M>]; S] = std::array::from_fn(|s| {
            let end = self.column_start[self.columns.start + s + 1];
            &self.lower[end - self.rows.len()..end]
        });
        let mut factors = [[[0.0; M]; S]; WIDEST];
        for (t, &row) in self.rows.iter().enumerate().take_while(|(_, row)| (**row as usize) < target.end) {
            factors[row as usize - target.start] = columns.map(|column| column[t]);
        }
        for (t, &row) in self.rows.iter().enumerate() {
            let entries = &mut panel[self.local[row as usize] as usize];
            for q in 0..WIDEST {
                let mut sum = entries[q];
                for s in 0..S {
                    for l in 0..M {
                        sum[l] = fma(-columns[s][t][l], factors[q][s][l], sum[l]);
                    }
                }
                entries[q] = sum;
            }
        }
    }
}

/// Cholesky factor of the square at the top of a panel, and the rows below divided by its transpose. The error is the first lane
/// that is not positive definite.
fn factorise_panel<const M: usize>(width: usize, panel: &mut [[Lanes<M>; WIDEST]]) -> Result<(), usize> {
    let mut inverse = [[0.0; M]; WIDEST];
    for at in 0..panel.len() {
        for q in 0..width.min(at + 1) {
            let mut sum = panel[at][q];
            for s in 0..q {
                let other = if at == q { panel[at][s] } else { panel[q][s] };
                for l in 0..M {
                    sum[l] = fma(-panel[at][s][l], other[l], sum[l]);
                }
            }
            if at == q {
                // NaN counts as not positive.
                if let Some(lane) = sum.iter().position(|d| d.is_nan() || *d <= 0.0) {
                    return Err(lane);
                }
                sum = sum.map(f64::sqrt);
                inverse[q] = sum.map(|d| 1.0 / d);
            } else {
                (0..M).for_each(|l| sum[l] *= inverse[q][l]);
            }
            panel[at][q] = sum;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An arrow matrix, dense in its last row, without fill-in; each lane is another matrix.
    #[test]
    fn factors_multiply_back() {
        let (upper_start, upper_row) = ([0, 1, 2, 5], [0, 1, 0, 1, 2]);
        let (lower_start, lower_row) = ([0, 2, 4, 5], [0, 2, 1, 2, 2]);
        let values = [[4.0, 9.0], [16.0, 1.0], [2.0, -3.0], [-4.0, 0.5], [5.0, 7.0]];
        let pattern = FactorPattern::new(&lower_start, &lower_row, &upper_start, &upper_row);
        let l = pattern.cholesky::<2>(|at| values[at], 4, &|| false).unwrap();
        for lane in 0..2 {
            let at = |k: usize| l[k][lane];
            let back = [
                at(0) * at(0),
                at(2) * at(2),
                at(0) * at(1),
                at(2) * at(3),
                at(1) * at(1) + at(3) * at(3) + at(4) * at(4),
            ];
            for (back, value) in back.iter().zip(values) {
                assert!((back - value[lane]).abs() < 1e-14, "{back} {}", value[lane]);
            }
        }
        let indefinite = |at: usize| if at == 4 { [5.0, 0.1] } else { values[at] };
        let failure = pattern.cholesky::<2>(indefinite, 4, &|| false).unwrap_err();
        assert_eq!(failure, FactorError::NotPositiveDefinite { harmonic: 5 });
        let stopped = pattern.cholesky::<2>(|at| values[at], 4, &|| true).unwrap_err();
        assert_eq!(stopped, FactorError::Stopped);
    }
}
