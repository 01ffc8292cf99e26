//! Standard output and standard error of a program.
//!
//! A program writes its files first and its messages second, so that none is lost to a full disk or a closed terminal
//! behind these streams. Control characters, which texts of foreign files may contain, are escaped.

use std::fmt::{Display, Write as _};
use std::io::{self, Write};
use std::process::ExitCode;

/// Writes a result to standard output. A reader that has closed the pipe, as `head` does, has seen enough.
pub fn print(text: &str) -> io::Result<()> {
    let mut output = io::stdout().lock();
    unless_closed(output.write_all(escaped(text).as_bytes()).and_then(|()| output.flush()))
}

fn unless_closed(written: io::Result<()>) -> io::Result<()> {
    match written {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        result => result,
    }
}

/// Exit status after a help text or a message on the usage has been printed: 1 where the help is lost.
pub fn usage(status: i32, printed: io::Result<()>) -> ExitCode {
    match (status, unless_closed(printed)) {
        (0, Err(_)) => ExitCode::FAILURE,
        _ => ExitCode::from(status as u8),
    }
}

/// Writes a line to standard error, if that can be written.
pub fn say(text: impl Display) {
    let _ = writeln!(io::stderr().lock(), "{}", escaped(&text.to_string()));
}

/// The text with its control characters, except line ends and tabulators, as in JSON.
pub fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '\n' | '\t' => escaped.push(character),
            // Writing to a String cannot fail.
            _ if character.is_control() => drop(write!(escaped, "\\u{:04x}", u32::from(character))),
            _ => escaped.push(character),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_escaped_and_nothing_else() {
        assert_eq!(escaped("µm\t±1\n"), "µm\t±1\n");
        assert_eq!(escaped("\u{1b}[2J\r\u{9b}1m\u{7f}"), "\\u001b[2J\\u000d\\u009b1m\\u007f");
    }
}
