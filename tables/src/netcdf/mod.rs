//! CF netCDF files: written completely or not at all, read with errors that name the missing variable or attribute.
//!
//! - [`DatasetWriter`] and [`DatasetReader`]: the files of the project (`run.nc`, `table.nc`, `friction.nc`);
//!   equal content gives equal bytes.
//! - [`Table::read`](crate::table::Table::read) and `write`: the schema of tables ([`schema`]) with a checksum of
//!   their content; the same as comma-separated values.
//! - A file is built in memory, so that no library meets a full disk (`memory`).
//! - A checksum of all bytes, verified before the netCDF library opens the file; a sandbox in which files of other
//!   programs are read first ([`enable_sandbox`]).
//! - [`write_atomically`]: every file of the project is written completely or not at all; [`check_outputs`]: no
//!   output replaces an input or another output.
//! - [`input`]: text files of users, with keys of the command line laid over them.
//! - [`streams`]: standard output and standard error; [`program`]: exit status, warnings and results;
//!   [`check_processor`]: the processor has the instructions of the program.
//!
//! Depends on `table` and `quantity`. Chapter "Table: table.nc" of the book.

mod atomic;
mod checksum;
mod classic_header;
mod csv;
mod distinct;
pub mod input;
mod memory;
mod outputs;
mod processor;
pub mod program;
mod reader;
mod sandbox;
pub mod schema;
pub mod streams;
mod superblock;
mod table_format;
mod table_reader;
mod table_writer;
mod writer;

pub use ::netcdf::AttributeValue;

pub use atomic::{destination, in_words, write_atomically};
pub use checksum::with_checksum;
pub use distinct::check_distinct;
pub use outputs::{
    JOURNAL, JOURNAL_ROLE, check_irreplaceable, check_kind, check_of_others, check_outputs, check_results,
    probe,
};
pub use processor::{REMEDY, UNSUITABLE, check_processor, missing_instruction_set};
pub use reader::{DatasetReader, check_regular};
pub use sandbox::enable as enable_sandbox;
pub use writer::{DatasetWriter, described, history};

/// CF version written to the attribute `Conventions`.
pub const CONVENTIONS: &str = "CF-1.11";

/// Fill value of an unknown number in files; NaN in memory.
pub const FILL_VALUE: f64 = 9.969_209_968_386_869e36;

/// Compressed data are at most this many times larger than the file (the limit of deflate is 1032).
const MOST_EXPANSION: u64 = 1100;

/// Error of a file.
#[derive(Debug, thiserror::Error)]
pub enum DatasetError {
    #[error("cannot read {path}: {reason}")]
    Open { path: String, reason: String },
    #[error("cannot write {path}: {reason}")]
    Write { path: String, reason: String },
    #[error("{path}: {what}")]
    Content { path: String, what: String },
}

/// Why an output is refused.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct OutputError(String);

/// Stops the HDF5 library from printing its error stack in this thread: it does so for
/// optional attributes that a good file lacks. The netCDF library silences the thread that
/// used it first only.
fn silence_hdf5() {
    thread_local! {
        static SILENT: std::cell::Cell<bool> = const { std::cell::Cell::new(false) };
    }
    if SILENT.replace(true) {
        return;
    }
    let _guard = hdf5_metno_sys::LOCK.lock();
    // SAFETY: no handler and no data for it, as HDF5 documents for switching the printing off;
    // the lock is the one that every call of the netCDF library holds.
    unsafe {
        hdf5_metno_sys::h5e::H5Eset_auto2(hdf5_metno_sys::h5e::H5E_DEFAULT, None, std::ptr::null_mut());
    }
}

/// Indices of the value of a number in row-major order.
fn indices(mut number: usize, shape: &[usize]) -> Vec<usize> {
    let mut indices = vec![0; shape.len()];
    for (index, length) in indices.iter_mut().zip(shape).rev() {
        *index = number % length;
        number /= length;
    }
    indices
}

#[cfg(test)]
mod tests;
