//! Messages in terms of the keys of a file.

/// The message of serde in terms of the file, with the known key nearest to an unknown one.
pub(crate) fn explain(path: &str, message: &str) -> String {
    let message = one_line(message);
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
        let suggestion = match nearest(unknown, known) {
            Some(near) => format!("did you mean {near}? "),
            None => String::new(),
        };
        let known = known.join(", ");
        return format!("{}: is not a key; {suggestion}known here: {known}", joined(unknown));
    }
    if message.starts_with("missing field") && !quoted.is_empty() {
        return format!("{}: is missing", joined(quoted[0]));
    }
    match path {
        "" | "." => message,
        path => format!("{path}: {message}"),
    }
}

/// The beginning of a message that would quote all of a long value.
pub(crate) fn short(message: &str) -> String {
    const MOST: usize = 600;
    match message.char_indices().nth(MOST) {
        None => message.to_owned(),
        Some((end, _)) => format!("{}… ({} bytes)", &message[..end], message.len()),
    }
}

pub(crate) fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The known word nearest to a misspelt one, if near enough to suggest.
pub(crate) fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    known
        .iter()
        .map(|candidate| {
            let likeness = strsim::normalized_damerau_levenshtein(word, candidate);
            (likeness, *candidate)
        })
        .filter(|(likeness, _)| *likeness >= 0.5)
        .max_by(|one, other| one.0.total_cmp(&other.0))
        .map(|(_, candidate)| candidate)
}
