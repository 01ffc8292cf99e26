//! Markdown with LaTeX to Markdown with MathML.
//!
//! These spellings are read, all of which code-hosting sites show as formulae:
//!
//! - `$…$` within a line, and `` $`…`$ ``, in which nothing is read as Markdown;
//! - `$$…$$` as a paragraph of its own, for formulae without `\\`;
//! - a code block of the language `math`, for formulae of several lines.

use std::iter::Peekable;
use std::str::Lines;

use pulldown_latex::config::DisplayMode;

use crate::mathml;

/// The text with every formula outside of code as MathML.
///
/// # Errors
///
/// The first formula that does not parse, has no end, or would be shown differently by a code-hosting site, with its
/// line.
pub fn render(text: &str) -> Result<String, String> {
    let mut lines = Numbered { lines: text.lines().peekable(), number: 0 };
    let mut rendered = String::new();
    while let Some(line) = lines.next() {
        let number = lines.number;
        let at_line = |error: String| format!("line {number}: {error}");
        let stripped = line.trim_start();
        if let Some(fence) = ["```", "~~~"].into_iter().find(|fence| stripped.starts_with(fence)) {
            let is_math = stripped.trim_end() == "```math";
            let block =
                lines.until(|line| line.trim() == fence).ok_or_else(|| at_line("no end of code".into()))?;
            if is_math {
                rendered.push_str(&display(&block).map_err(at_line)?);
            } else {
                rendered.push_str(&format!("{line}\n{block}{fence}\n"));
            }
        } else if let Some(begin) = stripped.strip_prefix("$$") {
            let formula = match begin.trim_end().strip_suffix("$$") {
                Some(formula) => formula.to_owned(),
                None => {
                    let rest = lines.until(|line| line.trim() == "$$");
                    format!("{begin}\n{}", rest.ok_or_else(|| at_line("`$$` without end".into()))?)
                }
            };
            shown_alike(&formula).map_err(at_line)?;
            if lines.lines.peek().is_some_and(|next| !next.trim().is_empty()) {
                return Err(at_line("a formula between `$$` is a paragraph of its own".into()));
            }
            rendered.push_str(&display(&formula).map_err(at_line)?);
        } else {
            rendered.push_str(&prose(line, &mut lines)?);
        }
    }
    Ok(rendered)
}

/// Lines of a text and the number of the last one that was read.
struct Numbered<'a> {
    lines: Peekable<Lines<'a>>,
    number: usize,
}

impl<'a> Numbered<'a> {
    fn next(&mut self) -> Option<&'a str> {
        self.number += 1;
        self.lines.next()
    }

    /// The lines before the one that ends a block; none if there is no such line.
    fn until(&mut self, is_end: impl Fn(&str) -> bool) -> Option<String> {
        let mut block = String::new();
        while let Some(line) = self.next() {
            if is_end(line) {
                return Some(block);
            }
            block.push_str(line);
            block.push('\n');
        }
        None
    }
}

fn display(formula: &str) -> Result<String, String> {
    let mathml =
        mathml::render(formula.trim(), DisplayMode::Block).map_err(|error| in_formula(formula, &error))?;
    Ok(format!("\n<div class=\"formula\">{mathml}</div>\n\n"))
}

/// A line of prose with what belongs to it: a code span may go on in the next line.
fn prose(line: &str, lines: &mut Numbered) -> Result<String, String> {
    let mut text = format!("{line}\n");
    let mut rendered = String::new();
    let mut position = 0;
    while let Some(offset) = text[position..].find(['`', '$', '\\']) {
        let number = lines.number;
        let (begin, rest) = (position + offset, &text[position + offset..]);
        rendered.push_str(&text[position..begin]);
        if let Some(escaped) = rest.strip_prefix('\\') {
            let length = 1 + escaped.chars().next().map_or(0, char::len_utf8);
            rendered.push_str(&rest[..length]);
            position = begin + length;
        } else if rest.starts_with('`') {
            let ticks = &rest[..rest.len() - rest.trim_start_matches('`').len()];
            match rest[ticks.len()..].find(ticks) {
                Some(length) => {
                    let end = begin + 2 * ticks.len() + length;
                    rendered.push_str(&text[begin..end]);
                    position = end;
                }
                None if lines.lines.peek().is_some_and(|next| !next.trim().is_empty()) => {
                    position = begin;
                    text.push_str(lines.next().unwrap_or_default());
                    text.push('\n');
                }
                None => return Err(format!("line {number}: a code span without end")),
            }
        } else {
            let formula =
                inline(&text[..begin], &rest[1..]).map_err(|error| format!("line {number}: {error}"))?;
            let mathml = mathml::render(formula.trim_matches('`'), DisplayMode::Inline);
            rendered.push_str(
                &mathml.map_err(|error| format!("line {number}: {}", in_formula(formula, &error)))?,
            );
            position = begin + formula.len() + 2;
        }
    }
    rendered.push_str(&text[position..]);
    Ok(rendered)
}

/// The formula that a `$` begins, between what is before and after that, with its backticks if it has some.
fn inline<'a>(before: &str, after: &'a str) -> Result<&'a str, String> {
    let line = after.lines().next().unwrap_or_default();
    if let Some(rest) = line.strip_prefix('`') {
        let length = rest.find("`$").ok_or("`` $` `` without end in its line")?;
        return Ok(&line[..length + 2]);
    }
    let (formula, following) =
        line.split_once('$').ok_or("`$` without end in its line; a plain one is `\\$`")?;
    if formula.is_empty() || formula.trim() != formula {
        return Err(in_formula(formula, "no space stands inside of `$…$`, next to the `$`"));
    }
    if before.ends_with(char::is_alphanumeric) || following.starts_with(char::is_alphanumeric) {
        return Err(in_formula(formula, "no letter or digit stands next to `$…$`"));
    }
    shown_alike(formula)?;
    Ok(formula)
}

/// An error where Markdown as code-hosting sites read it would alter a formula before it is rendered.
fn shown_alike(formula: &str) -> Result<(), String> {
    let fail = |reason: &str| Err(in_formula(formula, reason));
    for (wrong, instead) in
        [("*", r"\ast"), ("|", r"\lvert … \rvert or \mid"), ("<", r"\lt"), ("`", "'"), ("](", "] (")]
    {
        if formula.contains(wrong) {
            return fail(&format!("`{wrong}` is read as Markdown: write {instead}"));
        }
    }
    let characters: Vec<char> = formula.chars().collect();
    for pair in characters.windows(2) {
        if pair[0] == '\\' && pair[1].is_ascii_punctuation() {
            return fail(&format!(
                "`\\{}` is read as Markdown: use a word (\\lbrace, \\quad) or a block `math`",
                pair[1]
            ));
        }
        if pair[1] == '_' && !pair[0].is_alphanumeric() {
            return fail(&format!(
                "`{}_` may be read as emphasis: a letter or digit stands before `_`",
                pair[0]
            ));
        }
    }
    let marks = ['+', '-', '=', '#', '>', ':'];
    if formula.lines().skip(1).any(|line| line.trim().starts_with(marks) || line.trim().is_empty()) {
        return fail("a line that is empty or begins with one of `+ - = # > :` is read as Markdown");
    }
    Ok(())
}

fn in_formula(formula: &str, error: &str) -> String {
    format!("formula `{}`: {}", formula.trim(), error.trim())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_spellings_are_rendered() {
        let text = "Load $P = 1$, in $\\tau_c$\n\n$$\na = b\n$$\n\n$$c$$\n\n$`a\\,b`$\n\n```math\n\\begin{aligned} d \\\\ e \\end{aligned}\n```\n";
        let rendered = render(text).unwrap();
        assert_eq!(rendered.matches("<math").count(), 6, "{rendered}");
        assert_eq!(rendered.matches("<div class=\"formula\">").count(), 3, "{rendered}");
        assert!(!rendered.contains('$'), "{rendered}");
    }

    #[test]
    fn code_stays() {
        for text in
            ["`$a` and ``$`b``\n", "```sh\necho $HOME\n```\n", "a span `of\ntwo $ lines`\n", "5 \\$\n"]
        {
            assert_eq!(render(text).unwrap(), text);
        }
    }

    #[test]
    fn errors_tell_the_line() {
        for (text, part) in [
            ("a\n\n$b", "line 3: `$` without end"),
            ("$ a$", "no space"),
            ("a$b$", "no letter or digit"),
            ("$a*b$", "\\ast"),
            ("$a|b$", "\\lvert"),
            ("$a\\,b$", "\\quad"),
            ("$\\frac{a}{b}_c$", "emphasis"),
            ("$$\na\n= b\n$$", "begins with"),
            ("$$a$$\nb", "of its own"),
            ("$$\na", "without end"),
            ("$\\frac{a}$", "formula `\\frac{a}`"),
        ] {
            let error = render(text).unwrap_err();
            assert!(error.contains(part) && error.starts_with("line "), "{text}: {error}");
        }
    }
}
