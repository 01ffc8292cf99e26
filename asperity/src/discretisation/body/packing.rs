//! Several Gauss points side by side in one vector register, where the angles alone do not fill it.

use crate::discretisation::element::{CORNERS, VALUES};
use crate::material::lanes::{Lanes, Pack};

/// Lanes of a pack at most.
const MOST_LANES: usize = 8;

/// P points of W angles each, side by side.
#[inline(always)]
pub fn pack<'a, const W: usize, const P: usize, V: Pack>(of_point: impl Fn(usize) -> &'a [f64]) -> V {
    let mut lanes = [0.0; MOST_LANES];
    for p in 0..P {
        lanes[p * W..][..W].copy_from_slice(&of_point(p)[..W]);
    }
    V::load(&lanes)
}

/// P points of W angles each, side by side, of single packs.
#[inline(always)]
pub fn joined<const W: usize, A: Pack, V: Pack>(of_points: &[A]) -> V {
    let mut lanes = [0.0; MOST_LANES];
    for (p, point) in of_points.iter().enumerate() {
        point.store(&mut lanes[p * W..]);
    }
    V::load(&lanes)
}

/// The value of each point in the lanes of all its angles.
#[inline(always)]
pub fn spread<const W: usize, const P: usize, V: Pack>(of_points: [f64; P]) -> V {
    // Writing single numbers and reading them as a vector stalls the pipeline.
    if P == 1 {
        return V::splat(of_points[0]);
    }
    if W == 1 {
        return V::load(&of_points);
    }
    let mut lanes = [0.0; MOST_LANES];
    for p in 0..P {
        lanes[p * W..][..W].fill(of_points[p]);
    }
    V::load(&lanes)
}

/// Values at the corners, the same for all points.
#[inline(always)]
pub fn packed_values<const W: usize, const P: usize, A: Pack, V: Pack>(
    values: &[[A; VALUES]; CORNERS],
) -> [[V; VALUES]; CORNERS] {
    let mut packed = [[V::splat(0.0); VALUES]; CORNERS];
    for (packed, value) in packed.as_flattened_mut().iter_mut().zip(values.as_flattened()) {
        let mut lanes = [0.0; MOST_LANES];
        value.store(&mut lanes);
        if W == 1 {
            *packed = V::splat(lanes[0]);
            continue;
        }
        for p in 1..P {
            value.store(&mut lanes[p * W..]);
        }
        *packed = V::load(&lanes);
    }
    packed
}

/// Forces on the corners, of all points together.
#[inline(always)]
pub fn summed<const W: usize, const P: usize, A: Pack, V: Pack>(
    force: &[[V; VALUES]; CORNERS],
) -> [[A; VALUES]; CORNERS] {
    let mut sums = [[A::splat(0.0); VALUES]; CORNERS];
    for (sum, packed) in sums.as_flattened_mut().iter_mut().zip(force.as_flattened()) {
        let mut lanes = [0.0; MOST_LANES];
        packed.store(&mut lanes);
        for p in 0..P {
            *sum = *sum + A::load(&lanes[p * W..]);
        }
    }
    sums
}

/// The angles of point p of those side by side.
#[inline(always)]
pub fn unpack<const W: usize, V: Pack>(packed: V, p: usize) -> Lanes<W> {
    let mut lanes = [0.0; MOST_LANES];
    packed.store(&mut lanes);
    std::array::from_fn(|l| lanes[p * W + l])
}
