//! One formula: LaTeX to MathML that Markdown leaves as it is.

use pulldown_latex::config::DisplayMode;
use pulldown_latex::{Parser, RenderConfig, Storage, push_mathml};

/// The MathML element of a formula, on one line.
///
/// # Errors
///
/// A formula that does not parse.
pub fn render(latex: &str, display_mode: DisplayMode) -> Result<String, String> {
    let storage = Storage::new();
    let events: Result<Vec<_>, _> = Parser::new(latex, &storage).collect();
    let events = events.map_err(|error| error.to_string())?;
    let events = events.into_iter().map(Ok::<_, std::convert::Infallible>);
    let mut mathml = String::new();
    let config = RenderConfig { display_mode, ..RenderConfig::default() };
    push_mathml(&mut mathml, events, config).map_err(|error| error.to_string())?;
    Ok(escape(&mathml.replace('\n', " ")))
}

/// The same HTML with all punctuation between the tags as numbered entities, which Markdown does not read.
fn escape(html: &str) -> String {
    let mut escaped = String::new();
    let mut in_tag = false;
    for (place, character) in html.char_indices() {
        // The renderer leaves `<` of a formula as it is.
        let next = html[place + character.len_utf8()..].chars().next();
        if character == '<' && next.is_some_and(|next| next.is_alphabetic() || next == '/') {
            in_tag = true;
        }
        if character.is_ascii_punctuation() && !in_tag {
            escaped.push_str(&format!("&#{};", u32::from(character)));
        } else {
            escaped.push(character);
        }
        if character == '>' {
            in_tag = false;
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulae_become_mathml() {
        let mathml = render(r"E^\ast = \frac{E}{1 - \nu^2}", DisplayMode::Block).unwrap();
        assert!(mathml.starts_with("<math display=\"block\""), "{mathml}");
        assert!(mathml.ends_with("</math>") && mathml.contains("<mfrac>"), "{mathml}");
        assert!(mathml.contains("&#42;") && !mathml.contains('*'), "{mathml}");
    }

    #[test]
    fn relations_are_no_tags() {
        let mathml = render(r"a < 0, b > 1", DisplayMode::Inline).unwrap();
        assert!(mathml.contains("<mo>&#60;</mo>") && mathml.contains("<mo>&#62;</mo>"), "{mathml}");
    }

    #[test]
    fn wrong_formulae_are_errors() {
        for latex in [r"\frac{a}", r"\nonsense", "{a", "a^b^c"] {
            assert!(render(latex, DisplayMode::Inline).is_err(), "{latex}");
        }
    }
}
