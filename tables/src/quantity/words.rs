//! Names in input files and on the command line, those that are misspelt among them.

use toml::{Table, Value};

/// The known word nearest to a misspelt one, if near enough to suggest (Damerau and Levenshtein's distance).
///
/// ```
/// use tables::quantity::nearest;
///
/// let known = ["copper", "steel-304", "steel-4340"];
/// assert_eq!(nearest("stel4340", &known), Some("steel-4340"));
/// assert_eq!(nearest("granite", &known), None);
/// ```
pub fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    let likeness = |candidate: &str| strsim::normalized_damerau_levenshtein(word, candidate);
    let scored = known.iter().map(|candidate| (likeness(candidate), *candidate));
    let near = scored.filter(|(likeness, _)| *likeness >= 0.5);
    near.max_by(|one, other| one.0.total_cmp(&other.0)).map(|(_, candidate)| candidate)
}

/// "did you mean …?" where a known word is near, all known words in any case.
pub fn hint(word: &str, known: &[&str]) -> String {
    let all = known.join(", ");
    match nearest(word, known) {
        Some(nearest) => format!("did you mean {nearest}? (known: {all})"),
        None if known.is_empty() => "no name is allowed here".into(),
        None => format!("known: {all}"),
    }
}

/// Every value of an input file with the path of its key, `section.key`, in the order of the file; sections are no values.
pub fn values_by_path(sections: &Table) -> Vec<(String, &Value)> {
    let mut values = Vec::new();
    for (name, value) in sections {
        match value {
            Value::Table(inner) => {
                let below = values_by_path(inner).into_iter();
                values.extend(below.map(|(path, value)| (format!("{name}.{path}"), value)));
            }
            value => values.push((name.clone(), value)),
        }
    }
    values
}
