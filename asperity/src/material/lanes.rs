//! Arithmetic on lanes: values at W angles, computed together in vector registers.

use std::ops::{Add, Div, Mul, Neg, Sub};

use wide::{f64x4, f64x8};

use crate::material::elementary::{exponential, fma, logarithm, power};

pub type Lanes<const W: usize> = [f64; W];

/// c += a·b for a scalar a.
#[inline(always)]
pub fn add_scaled<const W: usize>(c: &mut Lanes<W>, a: f64, b: &Lanes<W>) {
    for l in 0..W {
        c[l] = fma(a, b[l], c[l]);
    }
}

/// The values of one vector register. The compiler splits long loops over lanes and spills their values to memory; with
/// explicit registers the logarithm at finite strain takes half the time.
pub trait Pack:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// A value in all lanes.
    fn splat(x: f64) -> Self;

    /// The first values of a slice.
    fn load(from: &[f64]) -> Self;

    /// The first values of a slice in single precision.
    fn load_single(from: &[f32]) -> Self;

    /// Writes the values to the start of a slice.
    fn store(self, to: &mut [f64]);

    /// self·a + b, fused if the target has that instruction.
    fn mul_add(self, a: Self, b: Self) -> Self;

    /// Lane by lane, the larger of the two absolute values.
    fn larger(self, other: Self) -> Self;

    /// The largest value.
    fn largest(self) -> f64;
}

impl Pack for f64 {
    #[inline(always)]
    fn splat(x: f64) -> Self {
        x
    }

    #[inline(always)]
    fn load(from: &[f64]) -> Self {
        from[0]
    }

    #[inline(always)]
    fn load_single(from: &[f32]) -> Self {
        f64::from(from[0])
    }

    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        to[0] = self;
    }

    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        fma(self, a, b)
    }

    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        self.abs().max(other.abs())
    }

    #[inline(always)]
    fn largest(self) -> f64 {
        self
    }
}

macro_rules! pack {
    ($vector:ty, $width:literal) => {
        impl Pack for $vector {
            #[inline(always)]
            fn splat(x: f64) -> Self {
                Self::splat(x)
            }

            #[inline(always)]
            fn load(from: &[f64]) -> Self {
                let first: &[f64; $width] = from[..$width].try_into().expect("a full register");
                Self::new(*first)
            }

            #[inline(always)]
            fn load_single(from: &[f32]) -> Self {
                let first: &[f32; $width] = from[..$width].try_into().expect("a full register");
                Self::new(first.map(f64::from))
            }

            #[inline(always)]
            fn store(self, to: &mut [f64]) {
                to[..$width].copy_from_slice(&self.to_array());
            }

            #[inline(always)]
            fn mul_add(self, a: Self, b: Self) -> Self {
                self.mul_add(a, b)
            }

            #[inline(always)]
            fn larger(self, other: Self) -> Self {
                self.abs().fast_max(other.abs())
            }

            #[inline(always)]
            fn largest(self) -> f64 {
                self.to_array().into_iter().fold(f64::NEG_INFINITY, f64::max)
            }
        }
    };
}

pack!(f64x4, 4);
pack!(f64x8, 8);

/// The values of a pack.
#[inline(always)]
pub fn lanes_of<const W: usize, V: Pack>(pack: V) -> Lanes<W> {
    let mut lanes = [0.0; W];
    pack.store(&mut lanes);
    lanes
}

/// The value of each lane.
#[inline(always)]
pub fn lanes<const W: usize>(value: impl Fn(usize) -> f64) -> Lanes<W> {
    let mut lanes = [0.0; W];
    for l in 0..W {
        lanes[l] = value(l);
    }
    lanes
}

/// x^n of each lane, x ≥ 0; of a single one as the C library computes it.
#[inline(always)]
pub fn powers<const W: usize>(x: &Lanes<W>, n: f64) -> Lanes<W> {
    lanes(|l| if W == 1 { x[l].powf(n) } else { power(x[l], n) })
}

/// e^x of each lane, x ≤ 0.
#[inline(always)]
pub fn exponentials<const W: usize>(x: &Lanes<W>) -> Lanes<W> {
    lanes(|l| if W == 1 { x[l].exp() } else { exponential(x[l]) })
}

/// The natural logarithm of each lane.
#[inline(always)]
pub fn logarithms<const W: usize>(x: &Lanes<W>) -> Lanes<W> {
    lanes(|l| if W == 1 { x[l].ln() } else { logarithm(x[l]) })
}

/// Scalar product.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    dot_of_parts(std::iter::once((a, b)))
}

/// Scalar product of two vectors given in parts, in eight partial sums of a fixed order.
#[inline(always)]
pub fn dot_of_parts<'a>(parts: impl Iterator<Item = (&'a [f64], &'a [f64])>) -> f64 {
    let mut sums = [0.0; 8];
    let mut rest = 0.0;
    for (a, b) in parts {
        let (a8, a_rest) = a.as_chunks::<8>();
        let (b8, b_rest) = b.as_chunks::<8>();
        for (x, y) in a8.iter().zip(b8) {
            for l in 0..8 {
                sums[l] = fma(x[l], y[l], sums[l]);
            }
        }
        rest += a_rest.iter().zip(b_rest).map(|(x, y)| x * y).sum::<f64>();
    }
    sums.iter().sum::<f64>() + rest
}

/// y += scale·M·x for a small square matrix stored column by column.
#[inline(always)]
pub fn add_small_product(scale: f64, columns: &[f64], x: &[f64], y: &mut [f64]) {
    product::<true>(scale, columns, x, y);
}

/// y = scale·M·x.
#[inline(always)]
pub fn small_product(scale: f64, columns: &[f64], x: &[f64], y: &mut [f64]) {
    product::<false>(scale, columns, x, y);
}

/// y = scale·M·x, or y += scale·M·x with ADD.
#[inline(always)]
fn product<const ADD: bool>(scale: f64, columns: &[f64], x: &[f64], y: &mut [f64]) {
    match x.len() {
        1 => fixed_product::<1, ADD>(scale, columns, x, y),
        4 => fixed_product::<4, ADD>(scale, columns, x, y),
        8 => fixed_product::<8, ADD>(scale, columns, x, y),
        16 => fixed_product::<16, ADD>(scale, columns, x, y),
        n => {
            if !ADD {
                y.fill(0.0);
            }
            for (k, column) in columns.chunks_exact(n).enumerate() {
                for (y, c) in y.iter_mut().zip(column) {
                    *y = fma(scale * x[k], *c, *y);
                }
            }
        }
    }
}

/// [`small_product`] for N values.
#[inline(always)]
fn fixed_product<const N: usize, const ADD: bool>(scale: f64, columns: &[f64], x: &[f64], y: &mut [f64]) {
    let (columns, _) = columns.as_chunks::<N>();
    let y: &mut [f64; N] = y.try_into().expect("as long as x");
    let x: &[f64; N] = x.try_into().expect("N values");
    let mut sum = if ADD { *y } else { [0.0; N] };
    for k in 0..N {
        add_scaled(&mut sum, scale * x[k], &columns[k]);
    }
    *y = sum;
}
