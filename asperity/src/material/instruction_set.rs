//! Kernels compiled for AVX-512 in addition to the instruction set of the program, chosen at run time.
//!
//! Both versions come from one source and do the same operations on the same lanes in the same order, so that their
//! results are equal bit for bit.

/// `dispatch! { <E> fn(argument: type = value, ...) -> type { body } }`: the body with the widest instructions of the
/// processor; E is the [`Pack`](crate::material::lanes::Pack) of eight lanes. What the body calls is compiled with these
/// instructions if it is `#[inline(always)]`. Closures cannot be: only short ones compute with packs.
macro_rules! dispatch {
    (<$eight:ident $(, const $size:ident)?> fn($($name:ident: $type:ty = $value:expr),* $(,)?) $(-> $result:ty)? $body:block) => {{
        #[inline(always)]
        fn kernel<$eight: $crate::material::lanes::Pack $(, const $size: usize)?>($($name: $type),*) $(-> $result)? $body
        #[cfg_attr(
            all(target_arch = "x86_64", target_feature = "fma"),
            target_feature(enable = "avx512f,avx512bw,avx512cd,avx512dq,avx512vl")
        )]
        unsafe fn wide$(<const $size: usize>)?($($name: $type),*) $(-> $result)? {
            kernel::<$crate::material::instruction_set::Wide $(, $size)?>($($name),*)
        }
        if $crate::material::instruction_set::is_wide() {
            // SAFETY: the processor has these instructions.
            unsafe { wide($($value),*) }
        } else {
            kernel::<wide::f64x8 $(, $size)?>($($value),*)
        }
    }};
}
pub(crate) use dispatch;

#[cfg(all(target_arch = "x86_64", target_feature = "fma"))]
mod avx512 {
    use std::arch::x86_64::*;
    use std::ops::{Add, Div, Mul, Neg, Sub};

    use crate::material::lanes::Pack;

    /// Eight lanes in one register; used in kernels compiled for AVX-512 alone.
    #[derive(Clone, Copy)]
    pub struct Wide(__m512d);

    macro_rules! operator {
        ($operator:ident, $method:ident, $instruction:ident) => {
            impl $operator for Wide {
                type Output = Self;

                #[inline(always)]
                fn $method(self, other: Self) -> Self {
                    // SAFETY: called in kernels for AVX-512 alone, as all methods of this type.
                    Self(unsafe { $instruction(self.0, other.0) })
                }
            }
        };
    }
    operator!(Add, add, _mm512_add_pd);
    operator!(Sub, sub, _mm512_sub_pd);
    operator!(Mul, mul, _mm512_mul_pd);
    operator!(Div, div, _mm512_div_pd);

    impl Neg for Wide {
        type Output = Self;

        #[inline(always)]
        fn neg(self) -> Self {
            // SAFETY: see the operators.
            Self(unsafe { _mm512_xor_pd(self.0, _mm512_set1_pd(-0.0)) })
        }
    }

    impl Pack for Wide {
        #[inline(always)]
        fn splat(x: f64) -> Self {
            // SAFETY: see the operators.
            Self(unsafe { _mm512_set1_pd(x) })
        }

        #[inline(always)]
        fn load(from: &[f64]) -> Self {
            // SAFETY: see the operators; the slice has the eight values.
            Self(unsafe { _mm512_loadu_pd(from[..8].as_ptr()) })
        }

        #[inline(always)]
        fn load_single(from: &[f32]) -> Self {
            // SAFETY: see the operators; the slice has the eight values.
            Self(unsafe { _mm512_cvtps_pd(_mm256_loadu_ps(from[..8].as_ptr())) })
        }

        #[inline(always)]
        fn store(self, to: &mut [f64]) {
            // SAFETY: see the operators; the slice has eight places.
            unsafe { _mm512_storeu_pd(to[..8].as_mut_ptr(), self.0) }
        }

        #[inline(always)]
        fn mul_add(self, a: Self, b: Self) -> Self {
            // SAFETY: see the operators.
            Self(unsafe { _mm512_fmadd_pd(self.0, a.0, b.0) })
        }

        #[inline(always)]
        fn larger(self, other: Self) -> Self {
            // SAFETY: see the operators.
            Self(unsafe { _mm512_max_pd(_mm512_abs_pd(self.0), _mm512_abs_pd(other.0)) })
        }

        #[inline(always)]
        fn largest(self) -> f64 {
            let mut lanes = [0.0; 8];
            self.store(&mut lanes);
            lanes.into_iter().fold(f64::NEG_INFINITY, f64::max)
        }
    }

    /// Whether the processor has the instructions.
    #[inline(always)]
    pub fn is_supported() -> bool {
        is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512bw")
            && is_x86_feature_detected!("avx512cd")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("avx512vl")
    }
}
#[cfg(all(target_arch = "x86_64", target_feature = "fma"))]
pub use avx512::{Wide, is_supported};

#[cfg(not(all(target_arch = "x86_64", target_feature = "fma")))]
mod none {
    pub type Wide = wide::f64x8;

    pub fn is_supported() -> bool {
        false
    }
}
#[cfg(not(all(target_arch = "x86_64", target_feature = "fma")))]
pub use none::{Wide, is_supported};

#[cfg(test)]
std::thread_local! {
    static NARROW: std::cell::Cell<bool> = const { std::cell::Cell::new(false) };
}

/// The result of a computation with the instructions of the program alone, on a thread of its own.
#[cfg(test)]
pub fn narrow<R: Send>(compute: impl FnOnce() -> R + Send) -> R {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).start_handler(|_| NARROW.set(true));
    pool.build().expect("one thread").install(compute)
}

/// Whether kernels take the widest instructions.
#[inline(always)]
pub fn is_wide() -> bool {
    #[cfg(test)]
    if NARROW.get() {
        return false;
    }
    is_supported()
}
