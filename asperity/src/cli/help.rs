//! Text that `--help` shows below the options: input files to copy, and examples.

pub(super) const PROGRAM: &str = "\
From a material to the friction of a rough surface:

  Constants of a material and their sources
    asperity materials steel-4340
  One asperity, pressed and slid; `asperity run --help` has a scene to copy
    asperity run scene.toml -o run.nc --plot run.png --vtu fields
  Another slip rate, without another file
    asperity run scene.toml -o fast.nc --set loading.slip_rate=10
  Errors of the numbers, and the computing time of smaller ones
    asperity convergence scene.toml -o report.nc --plot report.png
  All interferences and slip rates that a surface needs; --resume continues after an interruption
    asperity tabulate request.toml -o table.nc --jobs 4 --plot table.png
    asperity tabulate request.toml -o table.nc --jobs 4 --resume
  The same in parts, on separate machines
    asperity tabulate request.toml -o shard-1.nc --shard 1/2
    asperity merge shard-1.nc shard-2.nc -o table.nc
  Contents of a table
    asperity table info table.nc
  Friction of a surface of such asperities, by the other program
    roughsurface predict surface.toml --table table.nc -o friction.nc --plot friction.png

Exit status: 0 done, 1 a run failed (what could be saved is saved), 2 bad input or usage.";

pub(super) const RUN: &str = "\
A scene (SI units, kelvin), or - for standard input. Optional sections and keys are shown with their defaults:
  [material]
  preset = \"steel-4340\"          # or every constant; `asperity materials` lists the presets
  [asperity]
  radius = 1e-3                  # m
  [loading]
  interference = 20.0            # in units of the interference of first yield; or load = 10.0 (N),
                                 # which is then held during the slide
  slip_rate = 1.0                # m/s; 0 is the isothermal limit
  slip_distance = 2.0            # optional: in contact radii, or \"steady\"
  control = \"interference\"       # optional: constant during the slide; or \"load\"
  temperature = 298.0            # optional: K
  [interface]                    # optional
  law = \"shear-strength\"         # slip at strength_factor * sigma_Y(T)/sqrt(3); or \"coulomb\"
                                 # (friction, cap), \"briscoe-tabor\" (film_strength,
                                 # pressure_coefficient, film_softening, cap), \"full-stick\",
                                 # \"frictionless\"
  strength = \"initial\"           # sigma_Y of the virgin material; \"current\": hardened
  strength_factor = 1.0
  heat_partition = 0.5           # share of the frictional heat that enters the asperity
  gap_conductance = 0.0          # W/(m2 K)
  taylor_quinney = 0.9           # share of the plastic work that becomes heat
  [model]                        # optional
  heat = \"auto\"                  # or \"on\", \"off\"
  kinematics = \"auto\"            # or \"small\", \"finite\" strain; auto: finite where the plastic
                                 # strain to expect exceeds 1/20 of the accuracy
  [numerics]                     # optional
  accuracy = 0.02                # relative error asked for (of G 2.5 times this); chooses
                                 # elements_per_radius and sectors unless given

The flat is rigid and isothermal unless the scene has a body on the other side:
  [counterface]
  preset = \"steel-1045\"          # or youngs_modulus and poisson_ratio; density,
                                 # thermal_conductivity and specific_heat, with which
                                 # heat_partition is a result; thermal_expansion
  elastic = true                 # false: rigid in spite of the preset
  contact_conductance = inf      # W/(m2 K)

youngs_modulus, specific_heat, thermal_conductivity and thermal_expansion (dL/L per kelvin at the
temperature) may be tables, linear between the points and constant outside:
  thermal_conductivity = { temperature = [293.15, 1073.15], value = [53.3, 27.3] }    # K, W/(m K)

Without a preset the material neither hardens nor softens unless it is given how:
  hardening = { law = \"none\" }    # default; or linear (modulus), johnson-cook (modulus, exponent), table
  softening = { law = \"none\" }    # default; or johnson-cook (reference, melting, exponent), table
The strength does not depend on the strain rate unless a law is named; with a preset of a metal
rate = { law = \"johnson-cook\" } suffices:
  rate = { law = \"none\" }         # default; or johnson-cook (coefficient, reference in 1/s)
With a rate law the press is quasi-static, unless [loading] states the slip within which the contact
forms, in contact radii (about 1 between two rough faces):
  press_slip_distance = 1.0
thermal_expansion = 0 leaves expansion out. -v prints every default in effect.

With one of these in [material] the energy G is also given as a share of the shear fracture energy:
  shear_fracture_energy (J/m2), fracture_toughness_mode_ii (Pa sqrt(m)), or tensile_strength (Pa)
  and uniform_elongation, from which it is estimated for a crack as large as the contact.

Examples:
  asperity run scene.toml -o run.nc
  asperity run scene.toml -o run.nc --plot run.png --vtu fields --fields-at 0.1,1
  asperity run scene.toml -o run.nc --set interface.law=coulomb --set interface.friction=0.3
  asperity run scene.toml -o run.nc --json --quiet > summary.json

A programme of slip rates (m/s, negative: reversed), each over a distance in contact radii, and of holds (s):
  [loading]
  steps = [{ slip_rate = 0.01, slip_distance = 2 }, { slip_rate = 1, slip_distance = 2 },
           { hold = 1e-3 }, { slip_rate = -1, slip_distance = 1 }]";

pub(super) const TABULATE: &str = "\
A request is a scene with a section [table] in place of loading.interference and
loading.slip_rate:
  [material]
  preset = \"steel-4340\"
  [asperity]
  radius = 1e-3                   # m
  [table]                         # both keys are optional
  interference = [0.1, 1, 10, 100]    # default: from 0.1 to the largest that the hemisphere has
                                  # room for, about 15 values; or { from = 0.1, to = 100, points = 8 }
  slip_rate = [0.1, 1.0, 10.0]    # m/s; default: 0, 0.03, 0.25, 1.2, 4 and 10

Finished cells are kept in OUTPUT.part until the table is written; an interrupted
tabulation continues from there:
  asperity tabulate request.toml -o table.nc --jobs 4
  asperity tabulate request.toml -o table.nc --jobs 4 --resume

With table.tolerance, interferences and slip rates are added to those given until mu, mu_static
and Q interpolate with that relative error and G with 2.5 times it, or the table has
table.max_cells (default 400) cells:
  asperity tabulate request.toml -o table.nc --set table.tolerance=0.02

With table.temperature (K: a rising list, or a range) the table has these initial temperatures. The
constants of [material] hold at loading.temperature. At another temperature T yield strength and
hardening modulus are multiplied by f(T)/f(loading.temperature), f being the softening law, and
properties given as tables over temperature take their value at T; all else stays:
  asperity tabulate request.toml -o table.nc --set 'table.temperature=[298, 500, 700]'

In parts, on separate machines:
  asperity tabulate request.toml -o shard-1.nc --shard 1/2
  asperity tabulate request.toml -o shard-2.nc --shard 2/2
  asperity merge shard-1.nc shard-2.nc -o table.nc";

pub(super) const MERGE: &str = "\
The shards must have the same request and come from the same build of the program; cells that
several of them have must agree. Otherwise nothing is written.

Example:
  asperity merge shard-*.nc -o table.nc --plot table.png";

pub(super) const CONVERGENCE: &str = "\
The scene is run with 1/4, 1/3, 1/2, 2/3 and all of the elements per contact radius of --finest and the
increments that its accuracy requires, and once unchanged. Errors are relative to the limit of this
sequence (Richardson extrapolation with the observed order).

Example:
  asperity convergence scene.toml -o report.nc --plot report.png";

pub(super) const VERIFY: &str = "\
A case of the robustness suite is solved if it converged, all its numbers are finite, its balances of
energy and heat close, and no contact is above its melting point. Exit status 1 unless at least 97 %
of the cases are solved, or refused for the expected reason.

Examples:
  asperity verify --quick
  asperity verify --only 'full stick'
  asperity verify --json > verification.json
  asperity verify --robustness --only rate --save runs";

pub(super) const EFFECTIVITY: &str = "\
Each scene takes some minutes of processor time; the study can be interrupted and continued.

Examples:
  asperity effectivity -o effectivity.md
  asperity effectivity -o effectivity.md --scenes 1,2,3 -v
  asperity effectivity -o effectivity.md --judge-only";

pub(super) const TABLE: &str = "\
Examples:
  asperity table info table.nc
  asperity table diff table.nc other.nc --tolerance 0.01
  asperity table plot table.nc -o table.png
  asperity table export table.nc -o table.csv

A table of several initial temperatures is read at any temperature between them with --temperature.
Without it `info` describes all of them and `export` writes a column of temperatures; `diff`, `check`
and `plot` need it:
  asperity table plot hot.nc -o hot.png --temperature 450";

#[cfg(test)]
mod tests {
    use asperity::scene::file::{law_names, parse_request, parse_scene, write_scene};

    /// The indented lines from the first section on.
    fn file(help: &str) -> String {
        let lines = help.lines().skip_while(|line| !line.starts_with("  ["));
        lines.take_while(|line| line.starts_with("  ")).map(|line| format!("{line}\n")).collect()
    }

    #[test]
    fn input_files_to_copy_are_valid_and_show_the_defaults() {
        let text = file(super::RUN);
        let scene = parse_scene(&text, "help", &[]).unwrap();
        let needed = "[material]\npreset = \"steel-4340\"\n[asperity]\nradius = 1e-3\n\
                      [loading]\ninterference = 20\nslip_rate = 1\n";
        assert_eq!(write_scene(&scene), write_scene(&parse_scene(needed, "needed", &[]).unwrap()));
        assert_eq!(
            parse_request(&file(super::TABULATE), "help", &[]).unwrap().interferences,
            [0.1, 1.0, 10.0, 100.0]
        );
    }

    #[test]
    fn every_law_of_a_scene_is_named() {
        let missing: Vec<String> =
            law_names().into_iter().filter(|law| !super::RUN.contains(law.as_str())).collect();
        assert!(missing.is_empty(), "{missing:?}");
    }
}
