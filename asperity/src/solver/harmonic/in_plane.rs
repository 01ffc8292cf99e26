//! Sweeps of a vector field that does not depend on θ.
//!
//! It has no u_θ: blocks are 2 × 2 over (u_r, u_z), and u_θ stays as it is. There is one harmonic, so the four entries
//! of a block fill the vector register instead of the lanes.

use wide::f32x4;

use super::sweeps::BlockTriangle;

/// Values of a node.
const NODE: usize = 3;
/// Row and column of the entries of a block.
pub const ENTRIES: [(usize, usize); 4] = [(0, 0), (0, 2), (2, 0), (2, 2)];

impl BlockTriangle<f32> {
    /// Eliminates block columns, which rise.
    #[inline(always)]
    pub fn forward_in_plane(&self, x: &mut [f32], columns: impl Iterator<Item = usize>) {
        let (x, _) = x.as_chunks_mut::<NODE>();
        let (diagonal, _) = self.diagonal.as_chunks::<6>();
        let (block, _) = self.block.as_chunks::<{ ENTRIES.len() }>();
        for j in columns {
            let [over_r, _, over_z, _, z_r, _] = diagonal[j];
            let r = x[j][0] * over_r;
            let z = (x[j][2] - z_r * r) * over_z;
            (x[j][0], x[j][2]) = (r, z);
            let entries = self.column(j);
            for ([rr, rz, zr, zz], &i) in block[entries.clone()].iter().zip(&self.row[entries]) {
                let y = &mut x[i as usize];
                y[0] -= rr * r + rz * z;
                y[2] -= zr * r + zz * z;
            }
        }
    }

    /// Substitutes block columns back, which fall.
    #[inline(always)]
    pub fn backward_in_plane(&self, x: &mut [f32], columns: impl Iterator<Item = usize>) {
        let (x, _) = x.as_chunks_mut::<NODE>();
        let (diagonal, _) = self.diagonal.as_chunks::<6>();
        let (block, _) = self.block.as_chunks::<{ ENTRIES.len() }>();
        for j in columns {
            // Independent partial sums over the entries of blocks.
            let mut sums = [f32x4::ZERO; 4];
            let entries = self.column(j);
            let (blocks, rows) = (&block[entries.clone()], &self.row[entries]);
            for (blocks, rows) in blocks.rchunks(sums.len()).zip(rows.rchunks(sums.len())) {
                for ((sum, &block), &i) in sums.iter_mut().zip(blocks).zip(rows) {
                    let [r, _, z] = x[i as usize];
                    *sum = f32x4::new(block).mul_add(f32x4::new([r, r, z, z]), *sum);
                }
            }
            let [rr, rz, zr, zz] = ((sums[0] + sums[1]) + (sums[2] + sums[3])).to_array();
            let [over_r, _, over_z, _, z_r, _] = diagonal[j];
            let z = (x[j][2] - (rz + zz)) * over_z;
            (x[j][0], x[j][2]) = ((x[j][0] - (rr + zr) - z_r * z) * over_r, z);
        }
    }
}
