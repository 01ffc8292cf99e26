//! Time of a run by kernel.
//!
//! Wall-clock time of the thread that computes a run; a loop that it shares with others counts once, with the time
//! of another run that the thread may compute while it waits for the end of the loop. On one thread the sum is processor
//! time. It has no influence on results.

use std::time::Instant;

macro_rules! kernels {
    ($($(#[$meaning:meta])* $kernel:ident $name:literal,)*) => {
        /// Part of a run that is timed by itself.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Kernel {
            $($(#[$meaning])* $kernel,)*
        }

        impl Kernel {
            pub const ALL: [Self; [$($name),*].len()] = [$(Self::$kernel),*];

            pub fn name(self) -> &'static str {
                [$($name),*][self as usize]
            }
        }
    };
}

kernels! {
    /// Pressing the mesh of the main run, with its factors.
    Press "press",
    /// Mesh, ordering and elastic factors of the slide.
    Setup "setup",
    /// Stresses and nodal forces of the body, with the return mapping.
    InternalForce "internal_force",
    /// Products of the consistent tangent with a vector.
    TangentProduct "tangent_product",
    /// Transforms and triangular sweeps of the preconditioner.
    Preconditioner "preconditioner",
    /// Factorising the dense contact stiffness.
    ContactFactorisation "contact_factorisation",
    /// Conduction, with its sources.
    Heat "heat",
    /// The rest of the slide: vector sums, contact laws, energies.
    Rest "rest",
    /// Auxiliary runs: those on other resolutions, from which the errors follow.
    AuxiliaryRuns "auxiliary_runs",
    /// Writing the file.
    Output "output",
}

/// Seconds by kernel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Timings {
    seconds: [f64; Kernel::ALL.len()],
}

impl Timings {
    pub fn of(&self, kernel: Kernel) -> f64 {
        self.seconds[kernel as usize]
    }

    pub fn add(&mut self, kernel: Kernel, seconds: f64) {
        self.seconds[kernel as usize] += seconds;
    }

    /// Adds the time since `start`.
    pub fn since(&mut self, kernel: Kernel, start: Instant) {
        self.add(kernel, start.elapsed().as_secs_f64());
    }

    pub fn include(&mut self, other: &Self) {
        for kernel in Kernel::ALL {
            self.add(kernel, other.of(kernel));
        }
    }

    pub fn total(&self) -> f64 {
        self.seconds.iter().sum()
    }

    /// The main run alone: without auxiliary runs and output.
    pub fn main_run(&self) -> f64 {
        self.total() - self.of(Kernel::AuxiliaryRuns) - self.of(Kernel::Output)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kernel_has_a_place_of_its_own() {
        let mut timings = Timings::default();
        for (i, kernel) in Kernel::ALL.into_iter().enumerate() {
            timings.add(kernel, f64::from(1 << i));
        }
        for (i, kernel) in Kernel::ALL.into_iter().enumerate() {
            assert_eq!(timings.of(kernel), f64::from(1 << i));
        }
        assert_eq!(timings.total(), 1023.0);
        assert_eq!(timings.main_run(), 255.0);
        let names = Kernel::ALL.map(Kernel::name);
        assert!((1..names.len()).all(|i| !names[..i].contains(&names[i])));
        let mut twice = timings;
        twice.include(&timings);
        assert_eq!(twice.total(), 2046.0);
    }
}
