//! Help texts in addition to the options: examples, and the surface file.

use roughsurface::surface::heights::{DISTRIBUTIONS, Entry};

/// Examples of the whole way from a topography to friction.
pub const EXAMPLES: &str = "\
From a topography to the friction of its surface:

  In one command, with a table that comes with the program
    roughsurface predict map.x3p --cutoff 2um --material steel-4340 --pressure 1e6 \\
        --slip-rate 0.1..10 -o friction.nc
  Summits of a measured map, of which the instrument resolves 2 um
    roughsurface characterize map.x3p --cutoff 2um -o surface.toml
  Friction without a simulation, after a closed form; [material] in surface.toml says of what
    roughsurface predict surface.toml --table model:jackson-green -o friction.nc
  Friction with heat: a table of the material first, by the other program
    asperity tabulate request.toml -o table.nc
    roughsurface predict surface.toml --table table.nc -o friction.nc --plot friction.png
  How much specimens of 1000 summits scatter
    roughsurface sample surface.toml --table table.nc --asperities 1000 -o scatter.nc";

/// Description of the surface file, for every command that reads one.
pub fn after_help() -> String {
    let described = |entry: &Entry| format!("{} ({})", entry.name, entry.keys.join(", "));
    let entries: Vec<String> = DISTRIBUTIONS.iter().map(described).collect();
    // As wide as the lines around it.
    let mut lines = vec![String::new()];
    for entry in entries.join(", ").split_inclusive(", ") {
        match lines.last_mut() {
            Some(line) if line.len() + entry.len() < 86 => line.push_str(entry),
            _ => lines.push(entry.to_owned()),
        }
    }
    let lines: Vec<&str> = lines.iter().map(|line| line.trim_end()).collect();
    AFTER_HELP.replace("{distributions}", &lines.join("\n"))
}

const AFTER_HELP: &str = "\
A surface file, surface.toml:

    [surface]
    asperity_density = 1e10     # summits per nominal area, 1/m2
    asperity_radius = 100e-6    # m
    heights = { distribution = \"gaussian\", std = 0.1e-6 }
    [query]
    pressure = [1e5, 1e6]       # nominal, Pa; or separation in m; a number, a list, or a range
    slip_rate = { from = 0.1, to = 10, points = 9, spacing = \"log\" }    # m/s
    hold = \"load\"               # or \"separation\"
    contact_life = 1            # slip over which a contact lasts, in its diameters; or \"steady\"
    interaction = \"none\"        # or \"mean-pressure\": the nominal pressure displaces the
                                # mean plane, with nominal_size
    nominal_size = 0.01         # side of the square nominal area, m; optional without interaction
    rate_step = { before = 0.1, after = 1 }    # of predict, optional, m/s: steady sliding
                                # through a step of the slip rate

Heights, with their keys:
{distributions}
Lengths in metres; a sample is a file of heights, a histogram one of lower edges of bins and counts,
with a last line of the upper edge alone.
Radii that differ: radii = { distribution = \"lognormal\", std = 30e-6 } beside asperity_radius,
their mean, or radii = { distribution = \"classes\", radius = [..], share = [..] } without it.
A table of several initial temperatures is read at query.temperature, in K: temperature = 450.0
Uncertain parameters, by standard deviation, are propagated to the results of predict:
    [uncertainty]
    heights_std = 0.05e-6       # also asperity_density, asperity_radius and, for closed forms,
    yield_strength = 20e6       # youngs_modulus, poisson_ratio, yield_strength
    tables = { conductivity = \"up.nc\" }   # tables of a material with one constant raised

Exit status: 0 done, 1 failed, 2 bad input or usage.";
