//! Files of numbers as text: their characters, and what their commas are.

use std::borrow::Cow;

/// The text of a file: UTF-16 with its mark, as spreadsheets write "Unicode", UTF-8, or else Latin-1, in which instruments
/// write µ, Å and ö.
pub(crate) fn decode(bytes: &[u8]) -> Cow<'_, str> {
    let utf16 = |unit: fn([u8; 2]) -> u16| {
        let units: Vec<u16> = bytes.as_chunks().0.iter().map(|pair| unit(*pair)).collect();
        String::from_utf16_lossy(&units).into()
    };
    match bytes {
        [0xff, 0xfe, ..] => return utf16(u16::from_le_bytes),
        [0xfe, 0xff, ..] => return utf16(u16::from_be_bytes),
        _ => {}
    }
    match std::str::from_utf8(bytes) {
        Ok(text) => text.into(),
        Err(_) => bytes.iter().copied().map(char::from).collect::<String>().into(),
    }
}

/// What the commas between numbers are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Commas {
    Separators,
    Decimal,
    /// Each line with commas is one word such as `1,5`: a number with a decimal comma, or two numbers.
    Either,
}

impl Commas {
    /// Meaning of the commas in lines without their comments. Commas are decimal if no number has a point, each comma stands between two
    /// digits, and something else separates the numbers of a line.
    pub fn of<'a>(contents: impl Iterator<Item = &'a str>) -> Self {
        let mut commas = Self::Separators;
        for content in contents.map(str::trim) {
            let words =
                || content.split(|c: char| c.is_whitespace() || c == ';').filter(|word| !word.is_empty());
            // Titles.
            if !words().all(|word| word.starts_with(|c: char| c.is_ascii_digit() || "+-,.".contains(c))) {
                continue;
            }
            if content.contains('.') || !words().all(may_be_decimal) {
                return Self::Separators;
            }
            commas = match (content.contains(','), words().count()) {
                (true, 1) if commas != Self::Decimal => Self::Either,
                (true, _) => Self::Decimal,
                (false, _) => commas,
            };
        }
        commas
    }
}

/// Whether the commas in a word, if there are any, are one between the digits of a number.
fn may_be_decimal(word: &str) -> bool {
    let Some((before, after)) = word.split_once(',') else { return true };
    let digits = before.strip_prefix(['-', '+']).unwrap_or(before);
    // The digits before the comma have no exponent, which two numbers may have.
    !digits.is_empty()
        && digits.bytes().all(|byte| byte.is_ascii_digit())
        && after.starts_with(|c: char| c.is_ascii_digit())
        && after.parse::<f64>().is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn latin_1_is_read_where_the_text_is_no_utf_8() {
        assert_eq!(decode("Höhe [µm]".as_bytes()), "Höhe [µm]");
        assert_eq!(decode(b"H\xf6he [\xb5m]"), "Höhe [µm]");
    }

    #[test]
    fn commas_are_told_apart_by_what_else_separates() {
        for (text, commas) in [
            ("1,5;2,5", Commas::Decimal),
            ("x;z\n-1,5e-7 2,5", Commas::Decimal),
            ("1,5\n2,5;3", Commas::Decimal),
            ("3,77191e-08\n-1,2e-07", Commas::Either),
            ("1,5\n2,4", Commas::Either),
            ("1e-7,2e-7", Commas::Separators),
            ("1e-7,2e-7 3e-7,4e-7", Commas::Separators),
            ("1.5,2.5\n3,4", Commas::Separators),
            ("1, 5, 2, 3", Commas::Separators),
            ("1,5,2", Commas::Separators),
            ("15", Commas::Separators),
            ("", Commas::Separators),
        ] {
            assert_eq!(Commas::of(text.lines()), commas, "{text}");
        }
    }
}
