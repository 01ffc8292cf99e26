//! Text files of numbers, and errors in them.

use crate::surface::messages::allowed;
use crate::surface::read_regular;
use crate::surface::text::{Commas, decode};
use std::path::Path;

/// A text file that the key `file` names.
pub(super) struct TextFile<'a> {
    path: &'a Path,
    text: String,
}

impl<'a> TextFile<'a> {
    pub fn read(path: &'a Path) -> Result<Self, String> {
        let bytes = read_regular(path).map_err(|reason| error(path, &format!("cannot be read: {reason}")))?;
        let file = Self { path, text: decode(&bytes).into_owned() };
        match Commas::of(file.text.lines().map(without_comment)) {
            Commas::Separators => Ok(file),
            Commas::Decimal => Err(file.error("has decimal commas: write points")),
            Commas::Either => Err(file.error(
                "may have decimal commas, or pairs of numbers: write points, or spaces between numbers",
            )),
        }
    }

    /// Index, text and words of every line, separated by white space or commas; `#` starts a comment.
    pub fn lines(&self) -> impl Iterator<Item = (usize, &str, impl Iterator<Item = &str>)> {
        self.text.lines().enumerate().map(|(index, line)| {
            (
                index,
                line.trim(),
                without_comment(line).split([' ', '\t', ',']).filter(|word| !word.is_empty()),
            )
        })
    }

    pub fn error(&self, rule: &str) -> String {
        error(self.path, rule)
    }

    /// An error about a `word` of the line with this index.
    pub fn error_in(&self, index: usize, word: &str, what: &str) -> String {
        self.error(&format!("line {}: \"{word}\" is {what}", index + 1))
    }
}

fn without_comment(line: &str) -> &str {
    line.split('#').next().unwrap_or_default()
}

fn error(path: &Path, rule: &str) -> String {
    allowed("file", format!("\"{}\"", path.display()), rule)
}
