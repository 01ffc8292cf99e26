//! Arithmetic on lanes: W sectors computed together.

pub type Lanes<const W: usize> = [f64; W];

/// a·b + c, fused where the machine does that in one instruction.
#[inline(always)]
pub fn fma(a: f64, b: f64, c: f64) -> f64 {
    if cfg!(target_feature = "fma") { a.mul_add(b, c) } else { a * b + c }
}

/// c += a·b for a scalar a.
#[inline(always)]
pub fn add_scaled<const W: usize>(c: &mut Lanes<W>, a: f64, b: &Lanes<W>) {
    for l in 0..W {
        c[l] = fma(a, b[l], c[l]);
    }
}
