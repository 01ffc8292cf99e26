//! Ranges of the input quantities of solids and rough surfaces, wide enough for any of them: a value outside is legal,
//! and probably in another unit.

use toml::{Table, Value};

use super::numbers::plain;
use super::values_by_path;

/// An input quantity by its key in the input files, or the end of the path of the key.
struct Plausible {
    keys: &'static [&'static str],
    unit: &'static str,
    /// Smallest and largest plausible value, in `unit`.
    range: (f64, f64),
    /// Units that are mistaken for `unit`: name, factor and offset of the conversion into `unit`.
    mistaken: &'static [(&'static str, f64, f64)],
}

const LENGTH: &[(&str, f64, f64)] = &[("um", 1e-6, 0.0), ("mm", 1e-3, 0.0), ("nm", 1e-9, 0.0)];
const STRESS: &[(&str, f64, f64)] = &[("GPa", 1e9, 0.0), ("MPa", 1e6, 0.0)];

const fn of(
    keys: &'static [&'static str],
    unit: &'static str,
    range: (f64, f64),
    mistaken: &'static [(&'static str, f64, f64)],
) -> Plausible {
    Plausible { keys, unit, range, mistaken }
}

/// Where a key has no range, any legal value is plausible. Zero, where it is legal, switches an effect off.
const PLAUSIBLE: &[Plausible] = &[
    // Lithium 534 kg/m3, osmium 22 590 kg/m3.
    of(&["density"], "kg/m3", (500.0, 25e3), &[("g/cm3", 1e3, 0.0), ("t/mm3", 1e12, 0.0)]),
    // Heavy metals above room temperature 130 J/(kg K), lithium 3600 J/(kg K).
    of(&["specific_heat"], "J/(kg K)", (50.0, 5e3), &[("kJ/(kg K)", 1e3, 0.0), ("mJ/(t K)", 1e-6, 0.0)]),
    // Polymers 0.1 W/(m K), diamond 2500 W/(m K).
    of(&["thermal_conductivity"], "W/(m K)", (0.1, 3e3), &[("W/(mm K)", 1e3, 0.0), ("mW/(m K)", 1e-3, 0.0)]),
    // Fused silica 5e-7/K, polymers 2e-4/K.
    of(&["thermal_expansion"], "1/K", (1e-7, 1e-3), &[("1e-6/K", 1e-6, 0.0), ("mm/(m K)", 1e-3, 0.0)]),
    // Polyethylene 2e8 Pa, diamond 1.2e12 Pa.
    of(&["youngs_modulus"], "Pa", (1e8, 1.5e12), STRESS),
    // Indium 2 MPa, hardest ceramics some 30 GPa.
    of(&["yield_strength", "tensile_strength", "film_strength"], "Pa", (1e5, 5e10), STRESS),
    // C of Johnson & Cook: metals 0.001 to 0.1, polymers more.
    of(&["rate.coefficient"], "1", (1e-4, 0.3), &[("%", 1e-2, 0.0)]),
    // Over the strength at the initial temperature, or at any other.
    of(&["factor"], "1", (1e-4, 1e3), &[("%", 1e-2, 0.0)]),
    // Of a compression test, logarithmic.
    of(&["plastic_strain"], "1", (1e-7, 2.0), &[("%", 1e-2, 0.0)]),
    of(&["hardening.modulus"], "Pa", (1e5, 1e11), STRESS),
    // Polymers and ceramics 1e6 Pa m^0.5, tough steels 3e8 Pa m^0.5.
    of(&["fracture_toughness_mode_ii"], "Pa m^0.5", (1e5, 2e9), &[("MPa m^0.5", 1e6, 0.0)]),
    of(&["shear_fracture_energy"], "J/m2", (0.1, 1e7), &[("kJ/m2", 1e3, 0.0)]),
    of(&["uniform_elongation"], "1", (1e-4, 1.0), &[("%", 1e-2, 0.0)]),
    // Liquid nitrogen 77 K.
    of(
        &["temperature", "softening.reference", "softening.melting"],
        "K",
        (77.0, 5e3),
        &[("degrees Celsius", 1.0, 273.15)],
    ),
    // A multiple of the interference of first yield, which itself is 1e-12 to 1e-5 m; a large one is refused by the model.
    of(&["interference"], "omega_c", (1e-4, f64::INFINITY), &[]),
    of(&["slip_rate"], "m/s", (1e-13, 1e3), &[("mm/s", 1e-3, 0.0)]),
    // Of one asperity, or of a ball in a test.
    of(&["radius"], "m", (1e-9, 0.05), LENGTH),
    // Summits and heights of a rough surface.
    of(&["asperity_radius"], "m", (1e-9, 5e-3), LENGTH),
    of(&["std", "separation"], "m", (1e-12, 1e-3), LENGTH),
    of(&["asperity_density"], "1/m2", (1e5, 1e17), &[("1/mm2", 1e6, 0.0), ("1/um2", 1e12, 0.0)]),
    of(&["pressure"], "Pa", (1e3, 1e11), &[("MPa", 1e6, 0.0), ("GPa", 1e9, 0.0)]),
];

/// Keys, unit, and smallest and largest plausible value of every input quantity with a range.
pub fn ranges() -> impl Iterator<Item = (&'static [&'static str], &'static str, f64, f64)> {
    PLAUSIBLE.iter().map(|known| (known.keys, known.unit, known.range.0, known.range.1))
}

/// A sentence for every key of the sections of an input file with a value that is implausible, of a list the first.
///
/// ```
/// use tables::quantity::plausible::remarks;
///
/// let sections = "material.density = 7.85\nmaterial.specific_heat = 475\n[loading]\ntemperature = 25".parse()?;
/// assert_eq!(
///     remarks(&sections),
///     [
///         "material.density = 7.85 kg/m3 is implausible (500 to 25000 kg/m3); if it is in g/cm3, write 7850",
///         "loading.temperature = 25 K is implausible (77 to 5000 K); if it is in degrees Celsius, write 298.15",
///     ]
/// );
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn remarks(sections: &Table) -> Vec<String> {
    let first = |(path, value): (String, &Value)| {
        let values = value.as_array().map_or(std::slice::from_ref(value), Vec::as_slice);
        values.iter().filter_map(number).find_map(|number| remark(&path, number))
    };
    values_by_path(sections).into_iter().filter_map(first).collect()
}

fn number(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|number| number as f64))
}

/// The sentence for one key, if its value is implausible.
pub fn remark(path: &str, value: f64) -> Option<String> {
    // The values of a property over temperature and the ends of a range have the meaning of their section.
    let meaning =
        [".value", ".from", ".to"].into_iter().find_map(|end| path.strip_suffix(end)).unwrap_or(path);
    let means = |key: &&str| {
        let before = meaning.strip_suffix(*key);
        before.is_some_and(|before| before.is_empty() || before.ends_with('.'))
    };
    let known = PLAUSIBLE.iter().find(|known| known.keys.iter().any(means))?;
    let (least, most) = known.range;
    let plausible = |value: f64| (least..=most).contains(&value);
    if value == 0.0 || plausible(value.abs()) {
        return None;
    }
    // A number has no unit to write.
    let unit = if known.unit == "1" { String::new() } else { format!(" {}", known.unit) };
    let range = format!("{} to {}{unit}", plain(least), plain(most));
    let mut text = format!("{path} = {}{unit} is implausible ({range})", plain(value));
    let converted = known.mistaken.iter().map(|(name, factor, offset)| (name, value * factor + offset));
    let meant = converted.filter(|(_, converted)| plausible(*converted));
    let meant: Vec<String> =
        meant.map(|(name, converted)| format!("if it is in {name}, write {}", plain(converted))).collect();
    if !meant.is_empty() {
        text += &format!("; {}", meant.join(", "));
    }
    Some(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_unit_that_was_probably_meant_is_named() {
        for (key, value, unit) in [
            ("density", "7.85", "g/cm3, write 7850"),
            ("density", "7.85e-9", "t/mm3, write 7850"),
            ("youngs_modulus", "200", "GPa, write 2e11"),
            ("youngs_modulus", "210000", "MPa, write 2.1e11"),
            ("yield_strength", "400", "MPa, write 4e8"),
            ("film_strength", "20", "GPa, write 2e10, if it is in MPa, write 2e7"),
            ("softening.factor", "[2e9, 1e9]", "factor = 2e9 is implausible"),
            ("thermal_conductivity", "0.045", "W/(mm K), write 45"),
            ("thermal_expansion", "12", "1e-6/K, write 1.2e-5"),
            ("thermal_expansion", "0.012", "mm/(m K), write 1.2e-5"),
            ("hardening.modulus", "500", "MPa, write 5e8"),
            ("fracture_toughness_mode_ii", "30", "MPa m^0.5, write 3e7"),
            ("uniform_elongation", "15", "%, write 0.15"),
            ("specific_heat", "0.475", "kJ/(kg K), write 475"),
            ("temperature", "25", "degrees Celsius, write 298.15"),
            ("temperature", "60", "degrees Celsius, write 333.15"),
            ("radius", "50", "um, write 5e-5"),
            ("asperity_radius", "0.02", "mm, write 2e-5"),
            ("pressure", "[1, 10]", "MPa, write 1e6"),
            ("pressure", "400", "MPa, write 4e8"),
            ("interference", "2e-8", "2e-8 omega_c is implausible (1e-4 to inf omega_c)"),
            ("asperity_density", "1e4", "1/mm2, write 1e10"),
        ] {
            let sections: Table = format!("[section]\n{key} = {value}").parse().unwrap();
            let found = remarks(&sections);
            assert!(found.len() == 1 && found[0].contains(unit), "{key} = {value}: {found:?}");
        }
    }

    #[test]
    fn ordinary_values_zeros_and_other_keys_draw_no_remark() {
        let text = "[a]\ndensity = 7850\nthermal_expansion = 0\nslip_rate = [0, 1e-9]\nexponent = 1e-30\nmodulus = 1\n\
                    specific_heat = { temperature = [293, 1000], value = [440, 800] }\npressure = [1e5]";
        assert_eq!(remarks(&text.parse().unwrap()), Vec::<String>::new());
        let range = "[table]\ntemperature = { from = 20, to = 500, points = 3 }";
        assert!(remarks(&range.parse().unwrap())[0].contains("table.temperature.from = 20 K"));
    }
}
