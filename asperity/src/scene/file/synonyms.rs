//! Keys that are meant by other words, or written in another section.

use super::keys::all_keys;

/// Words of the literature, and the keys for them.
const SYNONYMS: &[(&[&str], &str)] = &[
    (&["e", "young", "elastic_modulus", "modulus_of_elasticity"], "youngs_modulus"),
    (&["nu", "poisson", "poissons_ratio"], "poisson_ratio"),
    (&["yield_stress", "flow_stress", "sigma_y", "proof_strength"], "yield_strength"),
    (&["hardening_modulus", "b"], "modulus"),
    (&["hardening_exponent", "strain_exponent", "n", "m"], "exponent"),
    (&["rho", "mass_density"], "density"),
    (&["cp", "c_p", "heat_capacity"], "specific_heat"),
    (&["k", "conductivity", "heat_conductivity"], "thermal_conductivity"),
    (&["alpha", "expansion", "cte", "expansion_coefficient"], "thermal_expansion"),
    (&["melting_temperature", "melting_point", "t_melt", "solidus"], "melting"),
    (&["uts", "ultimate_strength"], "tensile_strength"),
    (&["fracture_toughness", "toughness", "k_iic"], "fracture_toughness_mode_ii"),
    (&["fracture_energy", "g_iic"], "shear_fracture_energy"),
    (&["r", "curvature_radius"], "radius"),
    (&["mu", "friction_coefficient", "coefficient_of_friction"], "friction"),
    (&["shear_strength", "interface_strength", "adhesion_factor"], "strength_factor"),
    (&["indentation", "depth", "overlap", "approach", "penetration"], "interference"),
    (&["velocity", "speed", "sliding_velocity", "sliding_speed", "sliding_rate"], "slip_rate"),
    (&["slip", "distance", "sliding_distance", "slip_length"], "slip_distance"),
    (&["programme", "program", "segments"], "steps"),
    (&["dwell", "rest", "hold_time"], "hold"),
    (&["initial_temperature", "ambient_temperature"], "temperature"),
    (&["strain", "strain_measure", "large_strain"], "kinematics"),
    (&["mesh", "resolution", "elements"], "elements_per_radius"),
    (&["angles"], "sectors"),
];

/// The full path of the key that `name` of the section at `section` probably means: the same name in another
/// section, the nearest to this one first, or a synonym.
pub fn meant(section: &str, name: &str) -> Option<String> {
    let name = name.to_lowercase();
    let synonym = SYNONYMS.iter().find(|(words, _)| words.contains(&name.as_str())).map(|(_, key)| *key);
    let all = all_keys();
    let paths_of = |wanted| all.iter().filter(move |(name, _)| *name == wanted).map(|(_, path)| path);
    let paths = [Some(name.as_str()), synonym].into_iter().flatten().flat_map(paths_of);
    paths.min_by_key(|path| !path.starts_with(section)).cloned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::file::key_names;

    #[test]
    fn a_key_is_found_by_its_meaning() {
        for (section, name, key) in [
            ("material", "melting", Some("material.softening.melting")),
            ("material", "melting_point", Some("material.softening.melting")),
            ("material", "temperature", Some("material.softening.temperature")),
            ("loading", "friction", Some("interface.friction")),
            ("interface", "mu", Some("interface.friction")),
            ("loading", "velocity", Some("loading.slip_rate")),
            ("table", "velocity", Some("table.slip_rate")),
            ("", "density", Some("material.density")),
            ("material", "E", Some("material.youngs_modulus")),
            ("material", "colour", None),
        ] {
            assert_eq!(meant(section, name).as_deref(), key, "{section}.{name}");
        }
    }

    #[test]
    fn synonyms_are_of_keys_and_are_no_keys() {
        let known = key_names();
        for (words, key) in SYNONYMS {
            assert!(known.contains(key), "{key}");
            assert!(!words.iter().any(|word| known.contains(word)), "{words:?}");
        }
    }
}
