//! Formulae of the book: LaTeX in the Markdown, MathML in the pages.
//!
//! ```text
//! formulae                    preprocessor of mdBook: the book as JSON on stdin, with MathML on stdout
//! formulae supports RENDERER  asked by mdBook first
//! formulae check FOLDER       fails if a built page has a `$` outside of code
//! ```
//!
//! A formula that does not parse, or that code-hosting sites would show differently, ends the build.

mod markdown;
mod mathml;

use std::io::Read;
use std::path::Path;
use std::process::ExitCode;

use serde_json::Value;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let errors = match arguments[..] {
        [] => preprocess(),
        ["supports", _] => Vec::new(),
        ["check", folder] => check(Path::new(folder)),
        _ => vec!["usage: formulae [supports RENDERER | check FOLDER]".to_owned()],
    };
    for error in &errors {
        eprintln!("error: {error}");
    }
    if errors.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Reads `[context, book]` and writes the book with its formulae rendered.
fn preprocess() -> Vec<String> {
    let mut input: Value = match serde_json::from_reader(std::io::stdin().lock()) {
        Ok(input) => input,
        Err(error) => return vec![format!("no book on stdin: {error}")],
    };
    let mut errors = Vec::new();
    let mut book = input[1].take();
    render_chapters(&mut book, &mut errors);
    if errors.is_empty() {
        println!("{book}");
    }
    errors
}

/// Renders the formulae of all chapters below a value of the book.
fn render_chapters(value: &mut Value, errors: &mut Vec<String>) {
    match value {
        Value::Array(items) => items.iter_mut().for_each(|item| render_chapters(item, errors)),
        Value::Object(fields) => {
            let name = fields.get("path").and_then(Value::as_str).unwrap_or("a chapter").to_owned();
            if let Some(Value::String(content)) = fields.get_mut("content") {
                match markdown::render(content) {
                    Ok(rendered) => *content = rendered,
                    Err(error) => errors.push(format!("{name}: {error}")),
                }
            }
            fields.values_mut().for_each(|field| render_chapters(field, errors));
        }
        _ => {}
    }
}

/// The pages below a folder that show a `$` outside of code.
fn check(folder: &Path) -> Vec<String> {
    let mut errors = Vec::new();
    let entries = match std::fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) => return vec![format!("{}: {error}", folder.display())],
    };
    for path in entries.flatten().map(|entry| entry.path()) {
        if path.is_dir() {
            errors.extend(check(&path));
        } else if path.extension().is_some_and(|extension| extension == "html") {
            let mut page = String::new();
            let read = std::fs::File::open(&path).and_then(|mut file| file.read_to_string(&mut page));
            if let Err(error) = read {
                errors.push(format!("{}: {error}", path.display()));
            } else if without_code(&page).contains('$') {
                errors.push(format!("{}: a `$` outside of code", path.display()));
            }
        }
    }
    errors
}

/// A page without the content of its code and scripts.
fn without_code(page: &str) -> String {
    let mut text = page.to_owned();
    for element in ["script", "pre", "code"] {
        let (begin, end) = (format!("<{element}"), format!("</{element}>"));
        let mut kept = String::new();
        let mut rest = text.as_str();
        while let Some((before, after)) = rest.split_once(&begin) {
            kept.push_str(before);
            rest = after.split_once(&end).map_or("", |(_, after)| after);
        }
        text = kept + rest;
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chapters_of_all_levels_are_rendered() {
        let book = r#"{"items": [{"Chapter": {"path": "a.md", "content": "$a$", "sub_items":
            [{"Chapter": {"path": "b.md", "content": "$b", "sub_items": []}}]}}]}"#;
        let mut book: Value = serde_json::from_str(book).unwrap();
        let mut errors = Vec::new();
        render_chapters(&mut book, &mut errors);
        assert!(book["items"][0]["Chapter"]["content"].as_str().unwrap().starts_with("<math"));
        assert!(errors.len() == 1 && errors[0].starts_with("b.md: line 1"), "{errors:?}");
    }

    #[test]
    fn code_may_hold_dollars() {
        assert!(!without_code("<p>a</p><pre><code>$x</code></pre><code class=\"b\">$</code>").contains('$'));
        assert!(without_code("<code>a</code> $b").contains('$'));
    }
}
