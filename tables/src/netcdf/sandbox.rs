//! netCDF-4 files of other programs are read in a separate process first.
//!
//! The HDF5 library does not validate the files that it reads and may crash on damaged ones. The files of this project
//! have a checksum (see `checksum`), so that damage is found before the library opens the file. Other files have none.
//! A program that has called [`enable`] reads each of them in a copy of itself, with limited memory and time: where
//! the copy crashes or panics, the file is refused with a message, even if the damaged part is one that the program
//! would not have read. That takes some hundredths of a second a file.

use std::ffi::OsString;
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use ::netcdf::types::NcVariableType;
use rustix::process::{Resource, Rlimit, setrlimit};

use super::{MOST_EXPANSION, indices};

/// Name under which a copy of the program is started, with the file that it is to read as its only argument.
const NAME: &str = "asperity: reading in a sandbox";
/// Address space in bytes, in addition to that of the expanded file.
const MEMORY: u64 = 1 << 30;
const TIME: Duration = Duration::from_secs(60);
/// Status of a copy that could not open the file; the reason is on its standard output.
const NOT_OPENED: i32 = 3;

static ENABLED: OnceLock<()> = OnceLock::new();

/// To be called first in `main`: from then on netCDF-4 files without a checksum are read in the sandbox first. In a
/// copy of the program that was started for that, reads the file and ends the process.
///
/// Without it they are read at once; damaged ones may then crash the process.
pub fn enable() {
    let mut words = std::env::args_os();
    if words.next().is_some_and(|name| name == NAME) {
        let file = words.next().map(PathBuf::from).unwrap_or_default();
        std::process::exit(read_all(&file));
    }
    ENABLED.get_or_init(|| ());
}

/// Reads the file in a copy of this program, if that is enabled; an error if the copy fails.
pub(super) fn check(file: &Path) -> Result<(), String> {
    if ENABLED.get().is_none() {
        return Ok(());
    }
    let failed = |error: std::io::Error| format!("cannot be read in a process of its own first: {error}");
    let mut copy = Command::new(program().map_err(failed)?)
        .arg0(NAME)
        .arg(file)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .map_err(failed)?;
    let Some(status) = wait(&mut copy).map_err(failed)? else {
        return Err(format!("damaged: it cannot be read in {} s", TIME.as_secs()));
    };
    match status.code() {
        Some(0) => Ok(()),
        Some(NOT_OPENED) => Err(copy.stdout.take().map_or_else(String::new, |said| {
            std::io::read_to_string(said).unwrap_or_default().trim().to_string()
        })),
        _ => Err(format!("damaged: a process that read it on trial ended with {status}")),
    }
}

/// This program, also if its file has been replaced since.
fn program() -> std::io::Result<OsString> {
    let own = Path::new("/proc/self/exe");
    if own.exists() { Ok(own.into()) } else { std::env::current_exe().map(Into::into) }
}

/// Exit status of the copy; none if it took too long.
fn wait(copy: &mut Child) -> std::io::Result<Option<std::process::ExitStatus>> {
    let start = Instant::now();
    while start.elapsed() < TIME {
        if let Some(status) = copy.try_wait()? {
            return Ok(Some(status));
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    copy.kill()?;
    copy.wait()?;
    Ok(None)
}

/// Reads every attribute and variable of the kinds that readers of this project use.
fn read_all(file: &Path) -> i32 {
    let size = std::fs::metadata(file).map_or(0, |metadata| metadata.len());
    let memory = MEMORY.saturating_add(size.saturating_mul(MOST_EXPANSION));
    // No core files of crashes that are expected.
    for (resource, limit) in [(Resource::As, memory), (Resource::Core, 0)] {
        let _ = setrlimit(resource, Rlimit { current: Some(limit), maximum: Some(limit) });
    }
    let dataset = match ::netcdf::open(file) {
        Ok(dataset) => dataset,
        Err(error) => {
            println!("{error}");
            return NOT_OPENED;
        }
    };
    for attribute in dataset.attributes() {
        let _ = attribute.value();
    }
    for variable in dataset.variables() {
        for attribute in variable.attributes() {
            let _ = attribute.value();
        }
        let _ = variable.fill_value::<f64>();
        let shape: Vec<usize> = variable.dimensions().iter().map(|axis| axis.len()).collect();
        let values = shape.iter().try_fold(1usize, |values, length| values.checked_mul(*length));
        let Some(values) = values.filter(|values| *values as u64 <= memory / 8) else { continue };
        match variable.vartype() {
            NcVariableType::String => {
                for number in 0..values {
                    let _ = variable.get_string(&indices(number, &shape)[..]);
                }
            }
            NcVariableType::Int(_) | NcVariableType::Float(_) | NcVariableType::Char => {
                drop(variable.get_values::<f64, _>(..));
                drop(variable.get_values::<i8, _>(..));
            }
            _ => {}
        }
    }
    0
}
