//! Text files of numbers, and errors in them.

use super::distribution::HeightsError;
use crate::surface::read_regular;
use std::path::Path;

/// A text file that the key `file` names.
pub(super) struct TextFile<'a> {
    path: &'a Path,
    text: String,
}

impl<'a> TextFile<'a> {
    pub fn read(path: &'a Path) -> Result<Self, HeightsError> {
        let unreadable = |reason: &dyn std::fmt::Display| error(path, format!("cannot be read: {reason}"));
        let bytes = read_regular(path).map_err(|reason| unreadable(&reason))?;
        let text = String::from_utf8(bytes).map_err(|reason| unreadable(&reason))?;
        let file = Self { path, text };
        match file.may_have_decimal_commas() {
            true => Err(file.error(
                "may have decimal commas, or pairs of numbers: write points, or spaces between numbers",
            )),
            false => Ok(file),
        }
    }

    /// Whether each line is two whole numbers around a comma.
    fn may_have_decimal_commas(&self) -> bool {
        let whole = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
        let pair = |line: &str| {
            let (whole_part, decimals) = line.split_once(',')?;
            Some(whole(whole_part.trim_start_matches(['-', '+'])) && whole(decimals))
        };
        let contents = || self.text.lines().map(|line| line.split('#').next().unwrap_or_default().trim());
        let mut lines = contents().filter(|line| !line.is_empty()).peekable();
        lines.peek().is_some() && lines.all(|line| pair(line) == Some(true))
    }

    /// Index, text and words of every line, separated by white space or commas; `#` starts a comment.
    pub fn lines(&self) -> impl Iterator<Item = (usize, &str, impl Iterator<Item = &str>)> {
        self.text.lines().enumerate().map(|(index, line)| {
            let content = line.split('#').next().unwrap_or_default();
            (index, line.trim(), content.split([' ', '\t', ',']).filter(|word| !word.is_empty()))
        })
    }

    pub fn error(&self, allowed: impl Into<String>) -> HeightsError {
        error(self.path, allowed.into())
    }

    /// An error about a `word` of the line with this index.
    pub fn error_in(&self, index: usize, word: &str, what: &str) -> HeightsError {
        self.error(format!("line {}: \"{word}\" is {what}", index + 1))
    }
}

fn error(path: &Path, allowed: String) -> HeightsError {
    HeightsError { key: "file", value: Some(format!("\"{}\"", path.display())), allowed }
}
