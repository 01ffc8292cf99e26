//! CF netCDF files, written whole or not at all and read with errors that say what is missing.
//!
//! The three file kinds of the project (`run.nc`, `table.nc`, `friction.nc`) go through here.
//! Bytes are the same for the same content, and sealed (see `seal`): damage is found before the
//! netCDF library, which crashes on some, sees the file.

use std::io::Read;
use std::path::{Path, PathBuf};

pub use netcdf::AttributeValue;
use netcdf::FileMut;

use crate::seal::{self, Seal};
use crate::{classic, rehearsal};

/// CF version written to the attribute `Conventions`.
pub const CONVENTIONS: &str = "CF-1.11";

/// Stands for an unknown number in files; NaN in memory.
pub const FILL_VALUE: f64 = 9.969_209_968_386_869e36;

const DEFLATE_LEVEL: i32 = 4;

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

/// What is wrong with a file.
#[derive(Debug, thiserror::Error)]
pub enum DatasetError {
    #[error("cannot read {path}: {reason}")]
    Open { path: String, reason: String },
    #[error("cannot write {path}: {reason}")]
    Write { path: String, reason: String },
    #[error("{path}: variable \"{variable}\" is missing; not a file of this kind")]
    VariableMissing { path: String, variable: String },
    #[error("{path}: global attribute \"{attribute}\" is missing; not a file of this kind")]
    AttributeMissing { path: String, attribute: String },
    #[error("{path}: {what}")]
    Content { path: String, what: String },
}

/// The place that a file called `path` is written to: links are followed, that to nothing as well.
///
/// Files get their name by being renamed, which would put the file in place of the link, on the disk of
/// the link, and leave what it points to as it was.
///
/// ```
/// use tables::dataset::destination;
///
/// let folder = std::env::temp_dir().join(format!("destination-example-{}", std::process::id()));
/// std::fs::create_dir_all(&folder)?;
/// # #[cfg(unix)] {
/// std::os::unix::fs::symlink("large-disk.nc", folder.join("table.nc"))?;
/// assert_eq!(destination(&folder.join("table.nc")), folder.join("large-disk.nc"));
/// # }
/// assert_eq!(destination(&folder.join("other.nc")), folder.join("other.nc"));
/// # std::fs::remove_dir_all(&folder)?;
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn destination(path: &Path) -> PathBuf {
    let mut place = path.to_path_buf();
    // As many in a row as Linux follows.
    for _ in 0..40 {
        let Ok(target) = std::fs::read_link(&place) else { break };
        place = place.parent().unwrap_or(Path::new("")).join(target);
    }
    place
}

/// A netCDF-4 file being written under a temporary name in the directory of the final one.
///
/// ```
/// use tables::dataset::{DatasetReader, DatasetWriter};
///
/// let path = std::env::temp_dir().join(format!("dataset-example-{}.nc", std::process::id()));
/// let mut file = DatasetWriter::create(&path, "an example")?;
/// file.coordinate("x", &[0.0, 1.0], &[("units", "m".into())])?;
/// file.reals("y", &["x"], &[2.0, f64::NAN], &[("units", "1".into())])?;
/// file.finish()?;
///
/// let file = DatasetReader::open(&path)?;
/// let y = file.reals("y", &[2])?;
/// assert!(y[0] == 2.0 && y[1].is_nan());
/// assert_eq!(file.attribute_text("title")?, "an example");
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct DatasetWriter {
    path: PathBuf,
    temporary: PathBuf,
    file: Option<FileMut>,
}

impl DatasetWriter {
    /// Starts a file with the attributes `Conventions` and `title`.
    pub fn create(path: &Path, title: &str) -> Result<Self, DatasetError> {
        let path = destination(path);
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let temporary = path.with_file_name(format!(".{name}.{}.partial", std::process::id()));
        silence_hdf5();
        let file = netcdf::create(&temporary).map_err(|error| DatasetError::Write {
            path: path.display().to_string(),
            reason: error.to_string(),
        })?;
        let mut writer = Self { path, temporary, file: Some(file) };
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
        values: &[&str],
        attributes: &[(&str, AttributeValue)],
    ) -> Result<(), DatasetError> {
        let shape = self.shape(name, dimensions, values.len())?;
        self.change(|file| {
            let mut variable = file.add_string_variable(name, dimensions)?;
            for (attribute, value) in attributes {
                variable.put_attribute(attribute, value.clone())?;
            }
            for (position, value) in values.iter().enumerate() {
                let mut rest = position;
                let mut index = vec![0; shape.len()];
                for (index, length) in index.iter_mut().zip(&shape).rev() {
                    *index = rest % length;
                    rest /= length;
                }
                variable.put_string(value, index)?;
            }
            Ok(())
        })
    }

    /// Closes the file and gives it its name, replacing a file that has it.
    pub fn finish(mut self) -> Result<(), DatasetError> {
        if let Some(file) = self.file.take() {
            file.close().map_err(|error| self.failed(error))?;
        }
        // On the disk before it has its name: a name without content would be a damaged file.
        seal::seal(&self.temporary)
            .and_then(|()| std::fs::rename(&self.temporary, &self.path))
            .map_err(|error| self.failed(error))
    }

    fn variable<T: netcdf::NcTypeDescriptor + Copy>(
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
        let file = self.file.as_ref().expect("the file is open until finish");
        let length = |name: &&str| file.dimension_len(name).unwrap_or(0);
        let shape: Vec<usize> = dimensions.iter().map(length).collect();
        let expected: usize = shape.iter().product();
        if found == expected {
            return Ok(shape);
        }
        let reason = format!("variable \"{variable}\" has {found} values instead of {expected}");
        Err(self.failed(reason))
    }

    fn change(
        &mut self,
        action: impl FnOnce(&mut FileMut) -> netcdf::Result<()>,
    ) -> Result<(), DatasetError> {
        let file = self.file.as_mut().expect("the file is open until finish");
        action(file).map_err(|error| self.failed(error))
    }

    fn failed(&self, reason: impl std::fmt::Display) -> DatasetError {
        DatasetError::Write { path: self.path.display().to_string(), reason: reason.to_string() }
    }
}

impl Drop for DatasetWriter {
    fn drop(&mut self) {
        // Closed before it is removed; after `finish` there is nothing left to remove.
        self.file = None;
        let _ = std::fs::remove_file(&self.temporary);
    }
}

/// A netCDF file being read.
pub struct DatasetReader {
    path: String,
    file: netcdf::File,
    /// Values that a variable can have at most: a file cannot hold more.
    most_values: usize,
}

/// Compressed data are at most this many times larger than the file (the limit of deflate is 1032).
pub(crate) const MOST_EXPANSION: u64 = 1100;

/// What is wrong with a file that was never sealed: other programs write topographies, too.
fn foreign_damage(path: &Path) -> std::io::Result<Option<String>> {
    let mut file = std::fs::File::open(path)?;
    let mut bytes = Vec::new();
    file.by_ref().take(3).read_to_end(&mut bytes)?;
    if bytes != b"CDF" {
        return Ok(rehearsal::rehearse(path).err());
    }
    file.read_to_end(&mut bytes)?;
    Ok(classic::damage(&bytes).map(str::to_string))
}

impl DatasetReader {
    pub fn open(path: &Path) -> Result<Self, DatasetError> {
        let shown = path.display().to_string();
        let failed = |reason: String| DatasetError::Open { path: shown.clone(), reason };
        // The library's own message for a missing file does not always say so.
        let opened = std::fs::File::open(path).and_then(|mut file| {
            let damage = match seal::inspect(&mut file)? {
                Seal::Whole => None,
                Seal::Broken(damage) => Some(damage),
                Seal::None => foreign_damage(path)?,
            };
            Ok((file.metadata()?.len(), damage))
        });
        let (size, damage) = opened.map_err(|error| failed(error.to_string()))?;
        if let Some(damage) = damage {
            return Err(failed(damage));
        }
        silence_hdf5();
        let file = netcdf::open(path).map_err(|error| failed(error.to_string()))?;
        let most_values = usize::try_from(size.saturating_mul(MOST_EXPANSION) / 8).unwrap_or(usize::MAX);
        Ok(Self { path: shown, file, most_values })
    }

    /// Global attribute that is a text.
    pub fn attribute_text(&self, name: &str) -> Result<String, DatasetError> {
        self.optional_text(name)?.ok_or_else(|| self.attribute_missing(name))
    }

    /// Global attribute that is a text, if it is there.
    pub fn optional_text(&self, name: &str) -> Result<Option<String>, DatasetError> {
        match self.attribute(name)? {
            Some(AttributeValue::Str(text)) => Ok(Some(text)),
            Some(_) => Err(self.content(format!("global attribute \"{name}\" is not a text"))),
            None => Ok(None),
        }
    }

    /// Global attribute that is a number.
    pub fn attribute_real(&self, name: &str) -> Result<f64, DatasetError> {
        self.optional_real(name)?.ok_or_else(|| self.attribute_missing(name))
    }

    /// Global attribute that is a number, if it is there.
    pub fn optional_real(&self, name: &str) -> Result<Option<f64>, DatasetError> {
        let Some(value) = self.attribute(name)? else {
            return Ok(None);
        };
        let not_a_number = |_| self.content(format!("global attribute \"{name}\" is not a number"));
        f64::try_from(value).map(Some).map_err(not_a_number)
    }

    /// Values of a coordinate or any other variable with one dimension.
    pub fn coordinate(&self, name: &str) -> Result<Vec<f64>, DatasetError> {
        let length = self.variable(name)?.len();
        self.reals(name, &[length])
    }

    /// Whether there is a variable of that name.
    pub fn has(&self, name: &str) -> bool {
        self.file.variable(name).is_some()
    }

    /// Lengths of the dimensions of a variable.
    pub fn shape(&self, name: &str) -> Result<Vec<usize>, DatasetError> {
        Ok(self.variable(name)?.dimensions().iter().map(|dimension| dimension.len()).collect())
    }

    /// Attribute of a variable that is a text, if there is one.
    pub fn variable_text(&self, name: &str, attribute: &str) -> Option<String> {
        match self.file.variable(name)?.attribute_value(attribute)?.ok()? {
            AttributeValue::Str(text) => Some(text),
            _ => None,
        }
    }

    /// Attribute of a variable that is a number, if there is one.
    pub fn variable_real(&self, name: &str, attribute: &str) -> Option<f64> {
        f64::try_from(self.file.variable(name)?.attribute_value(attribute)?.ok()?).ok()
    }

    /// Numbers of the expected shape, row-major; NaN for the fill value.
    pub fn reals(&self, name: &str, shape: &[usize]) -> Result<Vec<f64>, DatasetError> {
        let variable = self.shaped(name, shape)?;
        let fill = match variable.fill_value::<f64>() {
            Ok(Some(fill)) => fill,
            _ => FILL_VALUE,
        };
        let mut values = (variable.get_values::<f64, _>(..))
            .map_err(|error| self.content(format!("variable \"{name}\": {error}")))?;
        for value in &mut values {
            if *value == fill {
                *value = f64::NAN;
            }
        }
        Ok(values)
    }

    /// Flags of the expected shape.
    pub fn flags(&self, name: &str, shape: &[usize]) -> Result<Vec<i8>, DatasetError> {
        let variable = self.shaped(name, shape)?;
        (variable.get_values::<i8, _>(..))
            .map_err(|error| self.content(format!("variable \"{name}\": {error}")))
    }

    /// One text of a variable of texts.
    pub fn text(&self, name: &str, index: &[usize]) -> Result<String, DatasetError> {
        (self.variable(name)?.get_string(index))
            .map_err(|error| self.content(format!("variable \"{name}\": {error}")))
    }

    /// An error about this file.
    pub fn content(&self, what: String) -> DatasetError {
        DatasetError::Content { path: self.path.clone(), what }
    }

    fn attribute(&self, name: &str) -> Result<Option<AttributeValue>, DatasetError> {
        let Some(attribute) = self.file.attribute(name) else {
            return Ok(None);
        };
        let unreadable = |error| self.content(format!("global attribute \"{name}\": {error}"));
        attribute.value().map(Some).map_err(unreadable)
    }

    fn attribute_missing(&self, name: &str) -> DatasetError {
        DatasetError::AttributeMissing { path: self.path.clone(), attribute: name.to_string() }
    }

    fn variable(&self, name: &str) -> Result<netcdf::Variable<'_>, DatasetError> {
        let missing =
            || DatasetError::VariableMissing { path: self.path.clone(), variable: name.to_string() };
        self.file.variable(name).ok_or_else(missing)
    }

    fn shaped(&self, name: &str, shape: &[usize]) -> Result<netcdf::Variable<'_>, DatasetError> {
        let variable = self.variable(name)?;
        let lengths = variable.dimensions().iter().map(|dimension| dimension.len());
        let found: Vec<usize> = lengths.collect();
        // Dimensions cost nothing in a file: they may promise more than any memory holds.
        let values = found.iter().try_fold(1usize, |product, length| product.checked_mul(*length));
        if values.is_none_or(|values| values > self.most_values) {
            let what = format!("variable \"{name}\" has shape {found:?}, more than the file can hold");
            return Err(self.content(what));
        }
        if found == shape {
            return Ok(variable);
        }
        let what = format!("variable \"{name}\" has shape {found:?} instead of {shape:?}");
        Err(self.content(what))
    }
}
