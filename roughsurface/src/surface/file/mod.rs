//! The surface file: TOML that describes a surface and the query.
//!
//! ```toml
//! [surface]
//! asperity_density = 1e10        # summits per nominal area, 1/m²
//! asperity_radius = 100e-6       # m
//! heights = { distribution = "gaussian", std = 0.5e-6 }
//! radii = { distribution = "lognormal", std = 30e-6 }    # optional: asperity_radius is their mean;
//!                                # or { distribution = "classes", radius = [..], share = [..] }
//!
//! [query]
//! pressure = [1e5, 1e6, 1e7]     # nominal, Pa; or separation = [..] in m
//! slip_rate = { from = 0.1, to = 10 }    # m/s; a number, a list, or a range
//! hold = "load"                  # or "separation"
//! temperature = 450.0            # optional: K, of asperities and flat at the start, for a table of several
//!
//! [material]                     # for closed forms only
//! youngs_modulus = 200e9         # Pa
//! poisson_ratio = 0.3
//! yield_strength = 400e6         # Pa
//!
//! [uncertainty]                  # optional: standard deviations, in the unit of the value
//! heights_std = 0.05e-6          # also asperity_density, asperity_radius and, for closed forms,
//! yield_strength = 20e6          # youngs_modulus, poisson_ratio, yield_strength
//! tables = { conductivity = "table-conductivity.nc" }    # for tables: those of a material with one
//!                                # constant raised by its standard deviation, under any name
//! ```
//!
//! Depends on `heights`, `radii` and `query`. Chapter "Surface" of the book.

mod defaults;
mod keys;
mod overrides;
mod parameter;
mod read;
#[cfg(test)]
mod tests;
mod values;

pub use overrides::Override;
pub use parameter::{Parameter, Uncertain};
pub use read::{SurfaceFile, SurfaceFileError};
pub use values::Values;
