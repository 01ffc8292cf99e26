//! The commands of the program.

pub mod characterize;
pub mod common;
pub mod predict;
pub mod sample;

/// What every command that reads a surface file says about it.
pub const AFTER_HELP: &str = "\
A surface file, surface.toml:

    [surface]
    asperity_density = 1e10     # summits per nominal area, 1/m2
    asperity_radius = 100e-6    # m
    heights = { distribution = \"gaussian\", std = 0.5e-6 }
    [query]
    pressure = [1e5, 1e6]       # nominal, Pa; or separation = [..] in m
    slip_rate = [0.1, 1, 10]    # m/s
    hold = \"load\"               # or \"separation\"

Heights: gaussian, exponential, uniform (std); truncated-gaussian (std, lower, upper);
weibull, lognormal (std, shape); sample (file of heights in metres); histogram (file of lower
edges of bins in metres and counts, a last line with the upper edge alone).
Radii that differ: radii = { distribution = \"lognormal\", std = 30e-6 } beside asperity_radius,
their mean, or radii = { distribution = \"classes\", radius = [..], share = [..] } without it.
Uncertain parameters, by standard deviation, are propagated to the results:
    [uncertainty]
    heights_std = 0.05e-6       # also asperity_density, asperity_radius and, for closed forms,
    yield_strength = 20e6       # youngs_modulus, poisson_ratio, yield_strength
    tables = { conductivity = \"up.nc\" }   # tables of a material with one constant raised

Exit status: 0 done, 1 failed, 2 bad input or usage.";
