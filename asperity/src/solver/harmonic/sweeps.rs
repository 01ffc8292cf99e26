//! Triangular sweeps x ← L⁻¹x and x ← L⁻ᵀx with the factors of all harmonics at once.
//!
//! L is stored by block columns, blocks of C × C over the components of a node, harmonics as lanes. The sweeps are
//! generic in the scalar: conduction solves in double precision, the preconditioner of the mechanics in single.
//! They are bound by memory: a vector is passed through once per block.

use std::ops::{Add, Mul, Neg, Range, Sub};

/// Scalar of a sweep.
pub trait Real:
    Copy + Default + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// self·a + b in one rounding.
    fn fused(self, a: Self, b: Self) -> Self;
}

impl Real for f32 {
    #[inline(always)]
    fn fused(self, a: Self, b: Self) -> Self {
        self.mul_add(a, b)
    }
}

impl Real for f64 {
    #[inline(always)]
    fn fused(self, a: Self, b: Self) -> Self {
        self.mul_add(a, b)
    }
}

/// c − a·b, fused if the target has that instruction.
#[inline(always)]
fn subtract_product<T: Real>(c: T, a: T, b: T) -> T {
    if cfg!(target_feature = "fma") { (-a).fused(b, c) } else { c - a * b }
}

/// A lower triangular factor in blocks.
#[derive(Debug)]
pub struct BlockTriangle<T> {
    /// Harmonics.
    pub lanes: usize,
    /// Start of the blocks below the diagonal, per block column.
    pub start: Vec<u32>,
    pub row: Vec<u32>,
    /// Blocks, row by row: `[((block*C + r)*C + c)*lanes + m]`.
    pub block: Vec<T>,
    /// Per block column: 1/L_cc (C values), then L_rc for r > c, row by row.
    pub diagonal: Vec<T>,
}

/// Numbers of a diagonal block.
const fn triangle_size(components: usize) -> usize {
    components * (components + 1) / 2
}

/// Index of L_rc, r > c, in a diagonal block.
const fn below_diagonal(components: usize, r: usize, c: usize) -> usize {
    components + r * (r - 1) / 2 + c
}

/// The lanes of harmonics from `at` on.
#[inline(always)]
fn lanes_at<T: Copy, const M: usize>(values: &[T], at: usize) -> [T; M] {
    values[at..at + M].try_into().expect("M values")
}

impl<T: Real> BlockTriangle<T> {
    /// Blocks below the diagonal of a block column.
    pub fn column(&self, j: usize) -> Range<usize> {
        self.start[j] as usize..self.start[j + 1] as usize
    }

    /// Eliminates block columns, which rise.
    #[inline(always)]
    pub fn forward<const C: usize>(&self, x: &mut [T], columns: impl Iterator<Item = usize> + Clone) {
        // N_θ is one or a multiple of four.
        match self.lanes {
            1 => self.forward_lanes::<C, 1>(x, columns, 1, 0),
            4 => self.forward_lanes::<C, 4>(x, columns, 4, 0),
            8 => self.forward_lanes::<C, 8>(x, columns, 8, 0),
            16 => self.forward_lanes::<C, 16>(x, columns, 16, 0),
            n if n.is_multiple_of(8) => {
                (0..n).step_by(8).for_each(|m| self.forward_lanes::<C, 8>(x, columns.clone(), n, m));
            }
            n => (0..n).step_by(4).for_each(|m| self.forward_lanes::<C, 4>(x, columns.clone(), n, m)),
        }
    }

    /// Substitutes block columns back, which fall, given the values that they are eliminated into; G blocks at a time.
    #[inline(always)]
    pub fn backward<const C: usize, const G: usize>(
        &self,
        x: &mut [T],
        columns: impl Iterator<Item = usize> + Clone,
    ) {
        match self.lanes {
            1 => self.backward_lanes::<C, G, 1>(x, columns, 1, 0),
            4 => self.backward_lanes::<C, G, 4>(x, columns, 4, 0),
            8 => self.backward_lanes::<C, G, 8>(x, columns, 8, 0),
            16 => self.backward_lanes::<C, G, 16>(x, columns, 16, 0),
            n if n.is_multiple_of(8) => {
                (0..n).step_by(8).for_each(|m| self.backward_lanes::<C, G, 8>(x, columns.clone(), n, m));
            }
            n => (0..n).step_by(4).for_each(|m| self.backward_lanes::<C, G, 4>(x, columns.clone(), n, m)),
        }
    }

    /// M of `lanes` harmonics from `first` on.
    #[inline(always)]
    fn forward_lanes<const C: usize, const M: usize>(
        &self,
        x: &mut [T],
        columns: impl Iterator<Item = usize>,
        lanes: usize,
        first: usize,
    ) {
        let (width, size) = (C * lanes, C * C * lanes);
        for j in columns {
            let diagonal = &self.diagonal[j * triangle_size(C) * lanes..][..triangle_size(C) * lanes];
            let own = &mut x[j * width..][..width];
            let mut v: [[T; M]; C] = std::array::from_fn(|c| lanes_at(own, c * lanes + first));
            for r in 0..C {
                for c in 0..r {
                    let factor: [T; M] = lanes_at(diagonal, below_diagonal(C, r, c) * lanes + first);
                    for l in 0..M {
                        v[r][l] = v[r][l] - factor[l] * v[c][l];
                    }
                }
                let inverse: [T; M] = lanes_at(diagonal, r * lanes + first);
                for l in 0..M {
                    v[r][l] = v[r][l] * inverse[l];
                }
                own[r * lanes + first..][..M].copy_from_slice(&v[r]);
            }
            let entries = self.column(j);
            let blocks = self.block[entries.start * size..entries.end * size].chunks_exact(size);
            for (block, &i) in blocks.zip(&self.row[entries]) {
                let y = &mut x[i as usize * width..][..width];
                for r in 0..C {
                    let mut sum: [T; M] = lanes_at(y, r * lanes + first);
                    for c in 0..C {
                        let factor: [T; M] = lanes_at(block, (C * r + c) * lanes + first);
                        for l in 0..M {
                            sum[l] = subtract_product(sum[l], factor[l], v[c][l]);
                        }
                    }
                    y[r * lanes + first..][..M].copy_from_slice(&sum);
                }
            }
        }
    }

    /// M of `lanes` harmonics from `first` on. Independent partial sums, one for each row of G blocks, hide the latency
    /// of the additions; falling addresses let the memory be fetched ahead.
    #[inline(always)]
    fn backward_lanes<const C: usize, const G: usize, const M: usize>(
        &self,
        x: &mut [T],
        columns: impl Iterator<Item = usize>,
        lanes: usize,
        first: usize,
    ) {
        let (width, size) = (C * lanes, C * C * lanes);
        for j in columns {
            let entries = self.column(j);
            let (blocks, rows) = (&self.block[entries.start * size..entries.end * size], &self.row[entries]);
            let rest = rows.len() % G;
            let (rest_blocks, blocks) = blocks.split_at(rest * size);
            let (rest_rows, rows) = rows.split_at(rest);
            let mut sums = [[[[T::default(); M]; C]; C]; G];
            sums[0][0] = std::array::from_fn(|c| lanes_at(x, j * width + c * lanes + first));
            for (blocks, rows) in blocks.chunks_exact(G * size).zip(rows.chunks_exact(G)).rev() {
                for k in 0..G {
                    let y = &x[rows[k] as usize * width..][..width];
                    subtract_transposed(&mut sums[k], &blocks[k * size..][..size], y, lanes, first);
                }
            }
            for k in 0..G {
                if k < rest {
                    let y = &x[rest_rows[k] as usize * width..][..width];
                    subtract_transposed(&mut sums[k], &rest_blocks[k * size..][..size], y, lanes, first);
                }
            }
            let diagonal = &self.diagonal[j * triangle_size(C) * lanes..][..triangle_size(C) * lanes];
            let v = solve_transposed(added(&sums), diagonal, lanes, first);
            let own = &mut x[j * width..][..width];
            (0..C).for_each(|c| own[c * lanes + first..][..M].copy_from_slice(&v[c]));
        }
    }
}

/// sums[r] −= row r of a block times y_r.
#[inline(always)]
fn subtract_transposed<T: Real, const C: usize, const M: usize>(
    sums: &mut [[[T; M]; C]; C],
    block: &[T],
    y: &[T],
    lanes: usize,
    first: usize,
) {
    for r in 0..C {
        let y: [T; M] = lanes_at(y, r * lanes + first);
        for c in 0..C {
            let factor: [T; M] = lanes_at(block, (C * r + c) * lanes + first);
            for l in 0..M {
                sums[r][c][l] = subtract_product(sums[r][c][l], factor[l], y[l]);
            }
        }
    }
}

/// Sum of the partial sums, from the last on.
#[inline(always)]
fn added<T: Real, const C: usize, const G: usize, const M: usize>(
    sums: &[[[[T; M]; C]; C]; G],
) -> [[T; M]; C] {
    let mut total = sums[G - 1][C - 1];
    for index in (0..G * C - 1).rev() {
        let sum = &sums[index / C][index % C];
        for c in 0..C {
            for l in 0..M {
                total[c][l] = sum[c][l] + total[c][l];
            }
        }
    }
    total
}

/// L⁻ᵀv of a diagonal block.
#[inline(always)]
fn solve_transposed<T: Real, const C: usize, const M: usize>(
    mut v: [[T; M]; C],
    diagonal: &[T],
    lanes: usize,
    first: usize,
) -> [[T; M]; C] {
    for c in (0..C).rev() {
        for r in c + 1..C {
            let factor: [T; M] = lanes_at(diagonal, below_diagonal(C, r, c) * lanes + first);
            for l in 0..M {
                v[c][l] = v[c][l] - factor[l] * v[r][l];
            }
        }
        let inverse: [T; M] = lanes_at(diagonal, c * lanes + first);
        for l in 0..M {
            v[c][l] = v[c][l] * inverse[l];
        }
    }
    v
}
