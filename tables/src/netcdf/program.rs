//! Common to the programs: failed commands and their exit status, warnings and results, the command as given.

use std::fmt::Display;
use std::panic::{UnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use super::streams::{self, say};

/// Reason of a failed command.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// Bad input or usage, exit status 2; no computation was started.
    #[error("{0}")]
    Input(String),
    /// The command failed, exit status 1; the results up to the failure are written.
    #[error("{0}")]
    Run(String),
}

impl Failure {
    /// Bad input.
    pub fn input(reason: impl ToString) -> Self {
        Self::Input(reason.to_string())
    }

    /// A failed command.
    pub fn run(reason: impl ToString) -> Self {
        Self::Run(reason.to_string())
    }

    /// Ok, or a failed command with the reasons of all failures: each may name the place of something that was saved.
    pub fn all(results: impl IntoIterator<Item = Result<(), Self>>) -> Result<(), Self> {
        let failures = results.into_iter().filter_map(Result::err);
        let reasons: Vec<String> = failures.map(|failure| failure.to_string()).collect();
        if reasons.is_empty() { Ok(()) } else { Err(Self::Run(reasons.join("; "))) }
    }
}

/// Exit status of a command, with the reason of its failure on standard error.
pub fn exit_status(command: impl FnOnce() -> Result<(), Failure> + UnwindSafe) -> ExitCode {
    let (status, reason) = match catch_unwind(command) {
        Ok(Ok(())) => return ExitCode::SUCCESS,
        Ok(Err(Failure::Run(reason))) => (1, reason),
        Ok(Err(Failure::Input(reason))) => (2, reason),
        Err(_) => (1, "internal error (see above); please report it".into()),
    };
    say(format!("error: {reason}"));
    ExitCode::from(status)
}

/// The name of a NetCDF file that is to be written, unless it has the extension of another format.
pub fn netcdf_name(name: PathBuf) -> Result<PathBuf, String> {
    const OF_OTHERS: [&str; 8] = ["csv", "txt", "json", "xlsx", "mat", "svg", "png", "pdf"];
    let extension = name.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    match OF_OTHERS.iter().any(|other| extension.eq_ignore_ascii_case(other)) {
        true => Err(format!("this file is NetCDF: name it .nc, not .{extension}")),
        false => Ok(name),
    }
}

/// Which texts a command prints.
#[derive(Clone, Copy, Debug)]
pub struct Printer {
    /// The result as JSON, not as text.
    pub json: bool,
    /// Neither warnings nor text.
    pub quiet: bool,
}

impl Printer {
    /// Warnings on standard error, a line each.
    pub fn warn<W: Display>(self, warnings: impl IntoIterator<Item = W>) {
        if !self.quiet {
            warnings.into_iter().for_each(|warning| say(format!("warning: {warning}")));
        }
    }

    /// The result on standard output, after all files; text that is lost there is a failure.
    pub fn print<J: Display>(
        self,
        json: impl FnOnce() -> J,
        text: impl FnOnce() -> String,
    ) -> Result<(), Failure> {
        match (self.json, self.quiet) {
            (true, _) => print(&format!("{:#}\n", json())),
            (false, false) => print(&text()),
            (false, true) => Ok(()),
        }
    }
}

/// Text on standard output, as [`Printer::print`].
pub fn print(text: &str) -> Result<(), Failure> {
    streams::print(text).map_err(|error| Failure::run(format!("standard output cannot be written: {error}")))
}

/// Writes a result that took long to compute. Where `output` cannot take it, it is saved in a new folder in the current
/// directory or in that of temporary files, which the error names.
///
/// ```
/// use tables::netcdf::{program::save, write_atomically};
///
/// let nowhere = std::path::Path::new("no-such-folder/result.txt");
/// let error = save(nowhere, |path| write_atomically(path, b"result")).unwrap_err().to_string();
/// let (_, place) = error.split_once("the results are in ").unwrap();
/// let place = std::path::Path::new(place.strip_suffix(" instead").unwrap());
/// assert_eq!(std::fs::read_to_string(place)?, "result");
/// # std::fs::remove_dir_all(place.parent().unwrap())?;
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn save<E: Display>(output: &Path, write: impl Fn(&Path) -> Result<(), E>) -> Result<(), Failure> {
    let Err(error) = write(output) else { return Ok(()) };
    let folders = [std::env::current_dir().ok(), Some(std::env::temp_dir())];
    for folder in folders.into_iter().flatten() {
        // A new folder: nothing of that name is overwritten, and no link is followed.
        let Ok(new) = tempfile::Builder::new().prefix("asperity-").tempdir_in(folder) else { continue };
        let place = new.path().join(output.file_name().unwrap_or_default());
        if write(&place).is_ok() {
            let _ = new.keep();
            return Err(Failure::Run(format!("{error}; the results are in {} instead", place.display())));
        }
    }
    Err(Failure::Run(format!(
        "{error}; nor can the current directory or {} be written: the results are lost",
        std::env::temp_dir().display()
    )))
}

/// The command as given, quoted for a shell, for the history of the files that it writes; without the folder of the program.
pub fn command_line(program: &str) -> String {
    // Not `args`, which panics where an argument is not UTF-8.
    let arguments = std::env::args_os().skip(1).map(|argument| {
        let argument = argument.to_string_lossy().into_owned();
        // An argument has no zero byte, which no shell can quote.
        shlex::try_quote(&argument).map_or(argument.clone(), |quoted| quoted.into_owned())
    });
    std::iter::once(program.to_owned()).chain(arguments).collect::<Vec<_>>().join(" ")
}
