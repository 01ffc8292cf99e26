//! Triangular sweeps with the factors of all harmonics at once.

use super::HarmonicFactors;
use crate::material::lanes::fma;

impl HarmonicFactors {
    /// Eliminates the interior: on return the contact part of `modal` is the reduced force.
    pub fn forward(&self, modal: &mut [f64]) {
        match self.harmonics() {
            1 => self.forward_lanes::<1>(modal),
            4 => self.forward_lanes::<4>(modal),
            8 => self.forward_lanes::<8>(modal),
            12 => self.forward_lanes::<12>(modal),
            16 => self.forward_lanes::<16>(modal),
            24 => self.forward_lanes::<24>(modal),
            32 => self.forward_lanes::<32>(modal),
            _ => self.forward_any(modal),
        }
    }

    /// Substitutes back, given the contact part of `modal` as displacement.
    pub fn backward(&self, modal: &mut [f64]) {
        match self.harmonics() {
            1 => self.backward_lanes::<1>(modal),
            4 => self.backward_lanes::<4>(modal),
            8 => self.backward_lanes::<8>(modal),
            12 => self.backward_lanes::<12>(modal),
            16 => self.backward_lanes::<16>(modal),
            24 => self.backward_lanes::<24>(modal),
            32 => self.backward_lanes::<32>(modal),
            _ => self.backward_any(modal),
        }
    }

    fn forward_lanes<const M: usize>(&self, modal: &mut [f64]) {
        let (x, _) = modal.as_chunks_mut::<M>();
        let (value, _) = self.value.as_chunks::<M>();
        let (diagonal, _) = self.inverse_diagonal.as_chunks::<M>();
        for j in 0..self.interior {
            let mut xj = x[j];
            for l in 0..M {
                xj[l] *= diagonal[j][l];
            }
            x[j] = xj;
            let entries = self.column_start[j] as usize..self.column_start[j + 1] as usize;
            for (v, &i) in value[entries.clone()].iter().zip(&self.row[entries]) {
                let xi = &mut x[i as usize];
                for l in 0..M {
                    xi[l] = fma(-v[l], xj[l], xi[l]);
                }
            }
        }
    }

    fn backward_lanes<const M: usize>(&self, modal: &mut [f64]) {
        let (x, _) = modal.as_chunks_mut::<M>();
        let (value, _) = self.value.as_chunks::<M>();
        let (diagonal, _) = self.inverse_diagonal.as_chunks::<M>();
        for j in (0..self.interior).rev() {
            // Sums that need not wait for each other; from the end, so that memory is fetched ahead.
            let mut sums = [[0.0; M]; 4];
            let entries = self.column_start[j] as usize..self.column_start[j + 1] as usize;
            let (values, rows) = (&value[entries.clone()], &self.row[entries]);
            for (values, rows) in values.rchunks(sums.len()).zip(rows.rchunks(sums.len())) {
                for ((sum, v), &i) in sums.iter_mut().zip(values).zip(rows) {
                    let xi = &x[i as usize];
                    for l in 0..M {
                        sum[l] = fma(v[l], xi[l], sum[l]);
                    }
                }
            }
            let xj = &mut x[j];
            for l in 0..M {
                let sum = (sums[0][l] + sums[1][l]) + (sums[2][l] + sums[3][l]);
                xj[l] = (xj[l] - sum) * diagonal[j][l];
            }
        }
    }

    /// The same for numbers of sectors without a version of their own.
    fn forward_any(&self, x: &mut [f64]) {
        let lanes = self.harmonics();
        for j in 0..self.interior {
            for l in 0..lanes {
                x[j * lanes + l] *= self.inverse_diagonal[j * lanes + l];
                for e in self.column_start[j] as usize..self.column_start[j + 1] as usize {
                    x[self.row[e] as usize * lanes + l] -= self.value[e * lanes + l] * x[j * lanes + l];
                }
            }
        }
    }

    fn backward_any(&self, x: &mut [f64]) {
        let lanes = self.harmonics();
        for j in (0..self.interior).rev() {
            for l in 0..lanes {
                for e in self.column_start[j] as usize..self.column_start[j + 1] as usize {
                    x[j * lanes + l] -= self.value[e * lanes + l] * x[self.row[e] as usize * lanes + l];
                }
                x[j * lanes + l] *= self.inverse_diagonal[j * lanes + l];
            }
        }
    }
}
