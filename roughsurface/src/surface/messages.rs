//! Messages in terms of the keys of a file.

use std::fmt::Display;
use tables::quantity::nearest;

/// The message of serde in terms of the file, with the known key nearest to an unknown one.
pub(crate) fn explain(path: &str, message: &str) -> String {
    // In one line.
    let message = message.split_whitespace().collect::<Vec<_>>().join(" ");
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let parent = |key: &str| {
        let path = path.strip_suffix(key).unwrap_or(path);
        path.trim_end_matches('.').to_string()
    };
    let joined = |key: &str| match parent(key).as_str() {
        "" | "." => key.to_string(),
        section => format!("{section}.{key}"),
    };
    if message.starts_with("unknown field") && !quoted.is_empty() {
        let (unknown, known) = (quoted[0], &quoted[1..]);
        let suggestion = match meant(unknown).or_else(|| nearest(unknown, known)) {
            Some(near) => format!("did you mean {near}? "),
            None => String::new(),
        };
        let known = known.join(", ");
        return format!("{}: is not a key; {suggestion}known here: {known}", joined(unknown));
    }
    if message.starts_with("missing field") && !quoted.is_empty() {
        return format!("{}: is missing", joined(quoted[0]));
    }
    let message =
        match message.strip_prefix("invalid type: ").and_then(|types| types.split_once(", expected ")) {
            Some((found, expected)) => format!("is {}, must be {}", in_words(found), in_words(expected)),
            None => message,
        };
    match path {
        "" | "." => message,
        path => format!("{path}: {message}"),
    }
}

/// A type of serde.
fn in_words(kind: &str) -> &str {
    match kind {
        "sequence" | "a sequence" => "a list",
        "map" => "a table of keys",
        "f64" => "a number",
        "u32" | "usize" | "u64" => "a whole number",
        kind => kind,
    }
}

/// A value of a key that breaks a rule.
pub(crate) fn allowed(key: &str, value: impl Display, rule: &str) -> String {
    format!("{key} = {value}: {rule}")
}

/// The beginning of a message that would quote all of a long value.
pub(crate) fn short(message: &str) -> String {
    const MOST: usize = 600;
    match message.char_indices().nth(MOST) {
        None => message.to_owned(),
        Some((end, _)) => format!("{}… ({} bytes)", &message[..end], message.len()),
    }
}

/// The full path of the key that an unknown one of a section probably means: the same name in another section, or a
/// word of the literature.
fn meant(name: &str) -> Option<&'static str> {
    const WORDS: &[(&[&str], &str)] = &[
        (&["eta", "density", "summit_density"], "surface.asperity_density"),
        (&["radius", "summit_radius", "curvature_radius"], "surface.asperity_radius"),
        (&["height", "distribution"], "surface.heights"),
        (
            &["std", "sigma", "sigma_s", "rms", "sq", "rq", "roughness", "standard_deviation"],
            "surface.heights.std",
        ),
        (&["pressure", "p", "nominal_pressure", "load"], "query.pressure"),
        (&["separation", "gap", "distance"], "query.separation"),
        (&["slip_rate", "rate", "speed", "velocity", "sliding_speed", "sliding_velocity"], "query.slip_rate"),
        (&["hold", "control"], "query.hold"),
        (&["contact_life", "life"], "query.contact_life"),
        (&["interaction", "neighbours", "neighbors"], "query.interaction"),
        (&["nominal_size", "size", "specimen_size"], "query.nominal_size"),
        (&["temperature", "initial_temperature"], "query.temperature"),
        (&["youngs_modulus", "young", "e", "elastic_modulus"], "material.youngs_modulus"),
        (&["poisson_ratio", "poisson", "nu"], "material.poisson_ratio"),
        (&["yield_strength", "hardness", "yield_stress", "sigma_y"], "material.yield_strength"),
    ];
    let name = name.to_lowercase();
    WORDS.iter().find(|(words, _)| words.contains(&name.as_str())).map(|(_, path)| *path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_suggested_by_spelling_and_by_meaning() {
        let unknown =
            |name: &str| format!("unknown field `{name}`, expected one of `pressure`, `slip_rate`, `hold`");
        for (name, suggestion) in [
            ("presure", "did you mean pressure?"),
            ("velocity", "did you mean query.slip_rate?"),
            ("load", "did you mean query.pressure?"),
            ("roughness", "did you mean surface.heights.std?"),
            ("colour", "is not a key; known here"),
        ] {
            let said = explain(&format!("query.{name}"), &unknown(name));
            assert!(said.contains(suggestion), "{said}");
        }
    }
}
