//! A netCDF file being written.

use std::path::{Path, PathBuf};

use ::netcdf::{AttributeValue, FileMut};

use super::memory::MemoryFile;
use super::{CONVENTIONS, DatasetError, FILL_VALUE, checksum, indices, write_atomically};

const DEFLATE_LEVEL: i32 = 4;

/// A line for the attribute `history`: time (UTC) and command.
pub fn history(command: &str) -> String {
    let now = chrono::Utc::now().format("%Y-%m-%dT%H:%M:%SZ");
    format!("{now}: {command}")
}

/// Attributes of a variable: its unit and what it is.
pub fn described(unit: &str, long_name: &str) -> Vec<(&'static str, AttributeValue)> {
    vec![("units", unit.into()), ("long_name", long_name.into())]
}

/// A netCDF-4 file being built in memory; [`finish`](Self::finish) writes it.
pub struct DatasetWriter {
    /// Path as given.
    path: PathBuf,
    memory: MemoryFile,
}

impl DatasetWriter {
    /// Starts a file with the attributes `Conventions` and `title`.
    pub fn create(path: &Path, title: &str) -> Result<Self, DatasetError> {
        let memory = MemoryFile::create().map_err(|error| failed(path, error))?;
        let mut writer = Self { path: path.to_owned(), memory };
        writer.attribute("Conventions", CONVENTIONS)?;
        writer.attribute("title", title)?;
        Ok(writer)
    }

    /// Global attribute.
    pub fn attribute(&mut self, name: &str, value: impl Into<AttributeValue>) -> Result<(), DatasetError> {
        let value = value.into();
        self.change(|file| file.add_attribute(name, value).map(|_| ()))
    }

    /// Dimension without a coordinate.
    pub fn dimension(&mut self, name: &str, length: usize) -> Result<(), DatasetError> {
        self.change(|file| file.add_dimension(name, length).map(|_| ()))
    }

    /// Dimension with its coordinate variable.
    pub fn coordinate(
        &mut self,
        name: &str,
        values: &[f64],
        attributes: &[(&str, AttributeValue)],
    ) -> Result<(), DatasetError> {
        self.dimension(name, values.len())?;
        self.variable(name, &[name], values, None, attributes)
    }

    /// Numbers over `dimensions` (none: a scalar), row-major; NaN is written as the fill value.
    pub fn reals(
        &mut self,
        name: &str,
        dimensions: &[&str],
        values: &[f64],
        attributes: &[(&str, AttributeValue)],
    ) -> Result<(), DatasetError> {
        let known = |value: &f64| if value.is_nan() { FILL_VALUE } else { *value };
        let filled: Vec<f64> = values.iter().map(known).collect();
        self.variable(name, dimensions, &filled, Some(FILL_VALUE), attributes)
    }

    /// Flags over `dimensions` with the meaning of 0, 1, 2, …, each a word without spaces.
    pub fn flags(
        &mut self,
        name: &str,
        dimensions: &[&str],
        values: &[i8],
        meanings: &[&str],
        attributes: &[(&str, AttributeValue)],
    ) -> Result<(), DatasetError> {
        let numbers: Vec<i8> = (0..meanings.len() as i8).collect();
        let mut attributes = attributes.to_vec();
        attributes.push(("flag_values", numbers.into()));
        attributes.push(("flag_meanings", meanings.join(" ").into()));
        self.variable(name, dimensions, values, None, &attributes)
    }

    /// Texts over `dimensions`.
    pub fn texts(
        &mut self,
        name: &str,
        dimensions: &[&str],
        values: &[impl AsRef<str>],
        attributes: &[(&str, AttributeValue)],
    ) -> Result<(), DatasetError> {
        let shape = self.shape(name, dimensions, values.len())?;
        self.change(|file| {
            let mut variable = file.add_string_variable(name, dimensions)?;
            for (attribute, value) in attributes {
                variable.put_attribute(attribute, value.clone())?;
            }
            for (position, value) in values.iter().enumerate() {
                variable.put_string(value.as_ref(), indices(position, &shape))?;
            }
            Ok(())
        })
    }

    /// Writes the file, which appears whole or not at all, and replaces one of its name.
    pub fn finish(self) -> Result<(), DatasetError> {
        let Self { path, memory } = self;
        let mut bytes = memory.into_bytes().map_err(|error| failed(&path, error))?;
        checksum::append(&mut bytes)
            .and_then(|()| write_atomically(&path, &bytes))
            .map_err(|error| failed(&path, error))
    }

    fn variable<T: ::netcdf::NcTypeDescriptor + Copy>(
        &mut self,
        name: &str,
        dimensions: &[&str],
        values: &[T],
        fill: Option<T>,
        attributes: &[(&str, AttributeValue)],
    ) -> Result<(), DatasetError> {
        self.shape(name, dimensions, values.len())?;
        self.change(|file| {
            let mut variable = file.add_variable::<T>(name, dimensions)?;
            if !dimensions.is_empty() {
                variable.set_compression(DEFLATE_LEVEL, true)?;
            }
            if let Some(fill) = fill {
                variable.set_fill_value(fill)?;
            }
            for (attribute, value) in attributes {
                variable.put_attribute(attribute, value.clone())?;
            }
            if dimensions.is_empty() {
                variable.put_value(values[0], ())
            } else {
                variable.put_values(values, ..)
            }
        })
    }

    /// Lengths of the dimensions. The library writes a short record without complaint, so the
    /// number of values is checked here.
    fn shape(&self, variable: &str, dimensions: &[&str], found: usize) -> Result<Vec<usize>, DatasetError> {
        let length = |name: &&str| self.memory.file.dimension_len(name).unwrap_or(0);
        let shape: Vec<usize> = dimensions.iter().map(length).collect();
        let expected: usize = shape.iter().product();
        if found == expected {
            return Ok(shape);
        }
        let reason = format!("variable \"{variable}\" has {found} values instead of {expected}");
        Err(failed(&self.path, reason))
    }

    fn change(
        &mut self,
        action: impl FnOnce(&mut FileMut) -> ::netcdf::Result<()>,
    ) -> Result<(), DatasetError> {
        action(&mut self.memory.file).map_err(|error| failed(&self.path, error))
    }
}

fn failed(path: &Path, reason: impl std::fmt::Display) -> DatasetError {
    DatasetError::Write { path: path.display().to_string(), reason: reason.to_string() }
}
