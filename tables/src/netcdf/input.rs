//! Text files that users write: their text, and keys given on the command line in place of theirs.

use std::io::{self, Read};
use std::path::Path;
use std::str::FromStr;

use toml::{Table, Value};

/// Path that stands for the standard input.
pub const STANDARD_INPUT: &str = "-";

/// The text of a file, or of the standard input for the path `-`.
pub fn read_text(path: &Path) -> io::Result<String> {
    /// Above the size of any such file; bounds the read from an endless device.
    const LONGEST: u64 = 16 << 20;
    let file: Box<dyn Read> = match path == Path::new(STANDARD_INPUT) {
        true => Box::new(io::stdin()),
        false => Box::new(std::fs::File::open(path)?),
    };
    let mut text = String::new();
    let read = file.take(LONGEST + 1).read_to_string(&mut text);
    read.map_err(|error| match error.kind() {
        io::ErrorKind::InvalidData => io::Error::new(error.kind(), "is no text in UTF-8"),
        _ => error,
    })?;
    match text.len() as u64 > LONGEST {
        true => Err(io::Error::other(format!("is longer than {} MB", LONGEST >> 20))),
        false => Ok(text),
    }
}

/// What a parser says of the syntax of a TOML `text`, in one line; with a hint at a decimal comma.
pub fn syntax_error(text: &str, error: &toml::de::Error) -> String {
    let message = error.message().split_whitespace().collect::<Vec<_>>().join(" ");
    let place = error.span().map_or(0, |span| span.start);
    let before = text.get(..place).map_or(0, |before| before.matches('\n').count());
    let line = text.lines().nth(before).unwrap_or_default().as_bytes();
    let is_decimal = |part: &[u8]| part[0].is_ascii_digit() && part[1] == b',' && part[2].is_ascii_digit();
    match line.windows(3).any(is_decimal) && !line.contains(&b'[') {
        true => format!("{message}; numbers have a decimal point, not a comma"),
        false => message,
    }
}

/// A key and its value in place of that of a TOML file, as `section.key=value`; without a value the key is left out.
///
/// The value is read as TOML (`1e-3`, `[1, 2]`, `{ law = "none" }`, `"on"`); what is not TOML is taken as text, so that
/// `model.heat=on` needs no quotes.
#[derive(Clone, Debug, PartialEq)]
pub struct Override {
    /// Names of the sections, then that of the key.
    pub path: Vec<String>,
    /// The value; none leaves the key out.
    pub value: Option<Value>,
}

impl FromStr for Override {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        /// Deeper than any key, and not deep enough for the recursion of the parsers.
        const DEEPEST: usize = 8;
        let form = || "must be of the form section.key=value".to_owned();
        let (path, value) = text.split_once('=').ok_or_else(form)?;
        let path: Vec<String> = path.split('.').map(|name| name.trim().to_owned()).collect();
        let value = value.trim();
        if !(2..=DEEPEST).contains(&path.len()) || path.iter().any(String::is_empty) || value.is_empty() {
            return Err(form());
        }
        let parsed: Option<Table> = format!("value = {value}").parse().ok();
        // A second key would come from a line break within the text.
        let parsed = parsed.filter(|table| table.len() == 1).and_then(|mut table| table.remove("value"));
        Ok(Self { path, value: Some(parsed.unwrap_or_else(|| Value::String(value.to_owned()))) })
    }
}

impl Override {
    /// The key, as `section.key`.
    pub fn key(&self) -> String {
        self.path.join(".")
    }

    /// Sets or removes the key, with sections on the way as needed; the error states the name on the way that is no
    /// section.
    pub fn lay_over(&self, sections: &mut Table) -> Result<(), String> {
        let Some((last, names)) = self.path.split_last() else { return Ok(()) };
        let mut table = sections;
        for name in names {
            match table.entry(name).or_insert_with(|| Value::Table(Table::new())) {
                Value::Table(inner) => table = inner,
                _ => return Err(format!("{name} is a value, not a section")),
            }
        }
        match &self.value {
            Some(value) => table.insert(last.clone(), value.clone()),
            None => table.remove(last),
        };
        Ok(())
    }
}

/// A number of the command line that is `allowed`; the error is the `rule` that it breaks.
pub fn number<T: FromStr>(text: &str, allowed: impl Fn(&T) -> bool, rule: &str) -> Result<T, String> {
    text.parse().ok().filter(allowed).ok_or_else(|| rule.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn laid_over(text: &str) -> Result<Table, String> {
        let mut sections: Table = "[loading]\nslip_rate = 1.0".parse().unwrap();
        text.parse::<Override>()?.lay_over(&mut sections)?;
        Ok(sections)
    }

    #[test]
    fn overrides_replace_add_and_descend() {
        let sections = |text: &str| laid_over(text).unwrap();
        assert_eq!(sections("loading.slip_rate=2")["loading"]["slip_rate"], Value::Integer(2));
        assert_eq!(sections("model.heat=on")["model"]["heat"].as_str(), Some("on"));
        let modulus = &sections("material.hardening.modulus=1e9")["material"]["hardening"]["modulus"];
        assert_eq!(modulus.as_float(), Some(1e9));
        let list = &sections("table.interference=[1, 2]")["table"]["interference"];
        assert_eq!(list.as_array().unwrap().len(), 2);
    }

    #[test]
    fn decimal_commas_are_recognised() {
        let hint = |text: &str| {
            let error = text.parse::<Table>().unwrap_err();
            syntax_error(text, &error).ends_with("a decimal point, not a comma")
        };
        assert!(hint("[material]\nyield_strength = 250,0e6\n") && hint("[a]\nb = 0,5"));
        assert!(!hint("[a]\nb = [1,2\n") && !hint("[a]\nb = 1 2\nc = 1\n") && !hint("[a\nb = 1"));
    }

    #[test]
    fn malformed_overrides_are_refused() {
        for text in ["loading", "loading=1", "loading.slip_rate", "a..b=1", "a.b=", ".=1"] {
            let error = laid_over(text).unwrap_err();
            assert!(error.contains("section.key=value"), "{error}");
        }
        assert_eq!(laid_over("loading.slip_rate.x=1").unwrap_err(), "slip_rate is a value, not a section");
    }
}
