//! Typed access to the keys of a TOML section, with errors that name place, key, value and
//! what is allowed.

use toml::{Table, Value};

use super::error::{SceneFileError, hint};

/// Where the values of a document come from.
#[derive(Clone, Debug, Default)]
pub(super) struct Origin {
    pub file: String,
    /// Path and text of every `--set`.
    pub overrides: Vec<(String, String)>,
}

impl Origin {
    /// File or override that set `key`.
    pub fn place(&self, key: &str) -> String {
        let sets = |path: &str| {
            path == key
                || path.strip_prefix(key).is_some_and(|rest| rest.starts_with('.'))
                || key.strip_prefix(path).is_some_and(|rest| rest.starts_with('.'))
        };
        match self.overrides.iter().rev().find(|(path, _)| sets(path)) {
            Some((_, text)) => format!("--set {text}"),
            None => self.file.clone(),
        }
    }

    pub fn invalid(&self, key: &str, value: impl ToString, allowed: impl Into<String>) -> SceneFileError {
        SceneFileError::Invalid {
            place: self.place(key),
            key: key.to_owned(),
            // A message is one line, whatever the value.
            value: value.to_string().replace('\n', " "),
            allowed: allowed.into(),
        }
    }
}

/// What a number may be.
#[derive(Clone, Copy)]
pub(super) struct Rule {
    /// As in "must be …", without the unit.
    pub text: &'static str,
    accepts: fn(f64) -> bool,
}

pub(super) const POSITIVE: Rule = Rule { text: "a positive number", accepts: |x| x > 0.0 };
pub(super) const FOR_LOGARITHMS: Rule =
    Rule { text: "a positive number, or any that may be if spacing = \"linear\"", accepts: |x| x > 0.0 };
pub(super) const NOT_NEGATIVE: Rule = Rule { text: "zero or a positive number", accepts: |x| x >= 0.0 };
pub(super) const SHARE: Rule = Rule { text: "a number from 0 to 1", accepts: |x| (0.0..=1.0).contains(&x) };
/// Of an isotropic solid that is neither auxetic nor incompressible.
pub(super) const POISSON: Rule =
    Rule { text: "a number from 0 to less than 0.5", accepts: |x| (0.0..0.5).contains(&x) };
pub(super) const ACCURACY: Rule =
    Rule { text: "a number above 0, at most 0.5", accepts: |x| x > 0.0 && x <= 0.5 };

impl Rule {
    pub fn accepts(&self, value: f64) -> bool {
        value.is_finite() && (self.accepts)(value)
    }

    /// With the unit, unless it is a pure number.
    pub fn with_unit(&self, unit: &str) -> String {
        match unit {
            "1" => self.text.to_owned(),
            unit => format!("{} ({unit})", self.text),
        }
    }
}

/// One section of a document; keys are removed as they are read.
pub(super) struct Section<'a> {
    path: String,
    table: Table,
    origin: &'a Origin,
}

impl<'a> Section<'a> {
    /// Fails on a key that is not in `known`.
    pub fn new(
        path: impl Into<String>,
        table: Table,
        known: &[&str],
        origin: &'a Origin,
    ) -> Result<Self, SceneFileError> {
        let section = Self { path: path.into(), table, origin };
        match section.table.keys().find(|key| !known.contains(&key.as_str())) {
            None => Ok(section),
            Some(key) => Err(SceneFileError::UnknownKey {
                place: origin.place(&section.full(key)),
                key: section.full(key),
                hint: hint(key, known),
            }),
        }
    }

    /// The same for a value that must be a table; a missing one is an empty table.
    pub fn take_section(&mut self, key: &str, known: &[&str]) -> Result<Section<'a>, SceneFileError> {
        let path = self.full(key);
        match self.table.remove(key) {
            None => Section::new(path, Table::new(), known, self.origin),
            Some(Value::Table(table)) => Section::new(path, table, known, self.origin),
            Some(value) => Err(self.origin.invalid(&path, value, "a section")),
        }
    }

    pub fn origin(&self) -> &'a Origin {
        self.origin
    }

    /// Path from the root of the document.
    pub fn full(&self, key: &str) -> String {
        match self.path.as_str() {
            "" => key.to_owned(),
            path => format!("{path}.{key}"),
        }
    }

    pub fn has(&self, key: &str) -> bool {
        self.table.contains_key(key)
    }

    pub fn take(&mut self, key: &str) -> Option<Value> {
        self.table.remove(key)
    }

    pub fn invalid(&self, key: &str, value: impl ToString, allowed: impl Into<String>) -> SceneFileError {
        self.origin.invalid(&self.full(key), value, allowed)
    }

    pub fn missing(&self, key: &str, allowed: impl Into<String>) -> SceneFileError {
        SceneFileError::Missing {
            place: self.origin.file.clone(),
            key: self.full(key),
            allowed: allowed.into(),
        }
    }

    /// A number in `unit` that obeys `rule`.
    pub fn number(
        &mut self,
        key: &str,
        unit: &str,
        rule: Rule,
        default: Option<f64>,
    ) -> Result<f64, SceneFileError> {
        let Some(value) = self.take(key) else {
            return default.ok_or_else(|| self.missing(key, rule.with_unit(unit)));
        };
        match as_number(&value) {
            Some(number) if rule.accepts(number) => Ok(number),
            _ => Err(self.invalid(key, value, rule.with_unit(unit))),
        }
    }

    /// A list of numbers in `unit` that obey `rule`, each larger than the one before.
    pub fn rising(&mut self, key: &str, unit: &str, rule: Rule) -> Result<Vec<f64>, SceneFileError> {
        let numbers = self.numbers(key, unit, rule)?;
        match numbers.windows(2).find(|pair| pair[1] <= pair[0]) {
            None => Ok(numbers),
            Some(pair) => Err(self.invalid(
                key,
                format!("[… {:?}, {:?} …]", pair[0], pair[1]),
                "a list that rises from each number to the next",
            )),
        }
    }

    /// A list, not empty, of numbers in `unit` that obey `rule`.
    pub fn numbers(&mut self, key: &str, unit: &str, rule: Rule) -> Result<Vec<f64>, SceneFileError> {
        let allowed = format!("a list, not empty, of: {}", rule.with_unit(unit));
        let Some(value) = self.take(key) else {
            return Err(self.missing(key, allowed));
        };
        let numbers: Option<Vec<f64>> = value
            .as_array()
            .filter(|array| !array.is_empty())
            .and_then(|array| array.iter().map(as_number).collect());
        match numbers {
            Some(numbers) if numbers.iter().all(|&number| rule.accepts(number)) => Ok(numbers),
            _ => Err(self.invalid(key, value, allowed)),
        }
    }

    /// A whole number from `from` to `to` that is a multiple of `step`.
    pub fn count(
        &mut self,
        key: &str,
        (from, to, step): (usize, usize, usize),
    ) -> Result<Option<usize>, SceneFileError> {
        let Some(value) = self.take(key) else {
            return Ok(None);
        };
        let count = value.as_integer().and_then(|n| usize::try_from(n).ok());
        match count {
            Some(n) if (from..=to).contains(&n) && n % step == 0 => Ok(Some(n)),
            _ => {
                let multiple = match step {
                    1 => String::new(),
                    step => format!(", a multiple of {step}"),
                };
                let allowed = format!("a whole number from {from} to {to}{multiple}");
                Err(self.invalid(key, value, allowed))
            }
        }
    }

    /// One of the named choices.
    pub fn choice<T: Copy>(
        &mut self,
        key: &str,
        choices: &[(&str, T)],
        default: Option<T>,
    ) -> Result<T, SceneFileError> {
        let names: Vec<String> = choices.iter().map(|(name, _)| format!("{name:?}")).collect();
        let allowed = format!("one of {}", names.join(", "));
        let Some(value) = self.take(key) else {
            return default.ok_or_else(|| self.missing(key, allowed));
        };
        let chosen = choices.iter().find(|(name, _)| value.as_str() == Some(name));
        chosen.map(|&(_, choice)| choice).ok_or_else(|| self.invalid(key, value, allowed))
    }

    pub fn flag(&mut self, key: &str, default: bool) -> Result<bool, SceneFileError> {
        match self.take(key) {
            None => Ok(default),
            Some(Value::Boolean(flag)) => Ok(flag),
            Some(value) => Err(self.invalid(key, value, "true or false")),
        }
    }
}

/// Integers are taken as numbers too: `interference = 20`.
pub(super) fn as_number(value: &Value) -> Option<f64> {
    match value {
        Value::Float(number) => Some(*number),
        Value::Integer(number) => Some(*number as f64),
        _ => None,
    }
}
