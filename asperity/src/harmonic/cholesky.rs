//! Numeric Cholesky factorisation of several harmonics together.
//!
//! They share one pattern, so that each operation is done on lanes of them. Row by row (Davis 2006, Direct
//! Methods for Sparse Linear Systems, §4.7): row k of L solves L y = A e_k with the rows above it.

use crate::lanes::{Lanes, fma};

/// Pattern of a factor L, by columns as they are stored and by rows as they are computed.
#[derive(Debug)]
pub struct FactorPattern {
    /// Of each column, diagonal first, rows rising.
    column_start: Vec<usize>,
    row: Vec<u32>,
    /// Of each row without its diagonal: column and place among the entries.
    row_start: Vec<usize>,
    entry: Vec<(u32, u32)>,
}

impl FactorPattern {
    /// From columns with the diagonal first and rows rising.
    pub fn new(column_start: &[usize], row: &[usize]) -> Self {
        let n = column_start.len() - 1;
        let mut row_start = vec![0; n + 1];
        for (j, column) in column_start.windows(2).enumerate() {
            assert!(row[column[0]] == j && row[column[0]..column[1]].is_sorted());
            row[column[0] + 1..column[1]].iter().for_each(|&i| row_start[i + 1] += 1);
        }
        for i in 0..n {
            row_start[i + 1] += row_start[i];
        }
        let mut next = row_start.clone();
        let mut entry = vec![(0, 0); row_start[n]];
        for (j, column) in column_start.windows(2).enumerate() {
            for at in column[0] + 1..column[1] {
                entry[next[row[at]]] = (j as u32, at as u32);
                next[row[at]] += 1;
            }
        }
        let row = row.iter().map(|&i| i as u32).collect();
        Self { column_start: column_start.to_vec(), row, row_start, entry }
    }

    /// Entries of L of the matrix whose upper triangle is `value(k)` at the k-th entry of a pattern by columns.
    /// Fails with the first lane that is not positive definite.
    pub fn cholesky<const M: usize>(
        &self,
        upper_start: &[usize],
        upper_row: &[usize],
        value: impl Fn(usize) -> Lanes<M>,
    ) -> Result<Vec<Lanes<M>>, usize> {
        let n = self.column_start.len() - 1;
        let mut lower = vec![[0.0; M]; self.row.len()];
        let mut inverse_diagonal = vec![[0.0; M]; n];
        let mut y = vec![[0.0; M]; n];
        for k in 0..n {
            for at in upper_start[k]..upper_start[k + 1] {
                y[upper_row[at]] = value(at);
            }
            for &(j, at) in &self.entry[self.row_start[k]..self.row_start[k + 1]] {
                let (j, at) = (j as usize, at as usize);
                let mut x = std::mem::replace(&mut y[j], [0.0; M]);
                for l in 0..M {
                    x[l] *= inverse_diagonal[j][l];
                }
                let above = self.column_start[j] + 1..at;
                for (known, &i) in lower[above.clone()].iter().zip(&self.row[above]) {
                    let y = &mut y[i as usize];
                    for l in 0..M {
                        y[l] = fma(-known[l], x[l], y[l]);
                    }
                }
                for l in 0..M {
                    y[k][l] = fma(-x[l], x[l], y[k][l]);
                }
                lower[at] = x;
            }
            let square = std::mem::replace(&mut y[k], [0.0; M]);
            // NaN is not positive either.
            if let Some(lane) = square.iter().position(|d| d.is_nan() || *d <= 0.0) {
                return Err(lane);
            }
            let diagonal = square.map(f64::sqrt);
            lower[self.column_start[k]] = diagonal;
            inverse_diagonal[k] = diagonal.map(|d| 1.0 / d);
        }
        Ok(lower)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An arrow that points down: dense in its last row, nothing filled in. Each lane is another matrix.
    #[test]
    fn factors_multiply_back() {
        let (upper_start, upper_row) = ([0, 1, 2, 5], [0, 1, 0, 1, 2]);
        let (lower_start, lower_row) = ([0, 2, 4, 5], [0, 2, 1, 2, 2]);
        let values = [[4.0, 9.0], [16.0, 1.0], [2.0, -3.0], [-4.0, 0.5], [5.0, 7.0]];
        let pattern = FactorPattern::new(&lower_start, &lower_row);
        let l = pattern.cholesky::<2>(&upper_start, &upper_row, |at| values[at]).unwrap();
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
        assert_eq!(pattern.cholesky::<2>(&upper_start, &upper_row, indefinite).unwrap_err(), 1);
    }
}
