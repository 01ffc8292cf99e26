//! A netCDF file being read.

use std::io::Read;
use std::path::Path;

use ::netcdf::types::NcTypeDescriptor;
use ::netcdf::{AttributeValue, Dimension};
use parking_lot::ReentrantMutexGuard;

use super::checksum::{self, Checksum};
use super::{DatasetError, FILL_VALUE, MOST_EXPANSION, classic_header, sandbox, silence_hdf5};
use crate::quantity::Estimate;

/// A netCDF file being read.
pub struct DatasetReader {
    path: String,
    file: ::netcdf::File,
    /// Values that a variable can have at most: a file cannot hold more.
    most_values: usize,
    /// HDF5 lets all that have a file open share what is read of it, and a type remembers the first of them: two threads
    /// must not have the same file open. Released after the file.
    _alone: ReentrantMutexGuard<'static, ()>,
}

/// Refuses what is not a regular file: reading a FIFO or a device might not end.
pub fn check_regular(path: &Path) -> std::io::Result<()> {
    let metadata = std::fs::metadata(path)?;
    match (metadata.is_file(), metadata.is_dir()) {
        (true, _) => Ok(()),
        (_, true) => Err(std::io::Error::other("it is a folder")),
        _ => Err(std::io::Error::other("it is a FIFO, a socket or a device, not a regular file")),
    }
}

/// What stands for no value where no attribute states it, in the type of the variable.
fn fill_value(variable: &::netcdf::Variable) -> f64 {
    fn of<T: NcTypeDescriptor + Copy + Into<f64>>(variable: &::netcdf::Variable) -> Option<f64> {
        variable.fill_value::<T>().ok().flatten().map(T::into)
    }
    let real = of::<f64>(variable).or_else(|| of::<f32>(variable));
    real.or_else(|| of::<i32>(variable)).or_else(|| of::<i16>(variable)).unwrap_or(FILL_VALUE)
}

/// Message for a file without a checksum; other programs write topographies, too.
fn foreign_damage(path: &Path) -> std::io::Result<Option<String>> {
    let mut file = std::fs::File::open(path)?;
    let mut bytes = Vec::new();
    file.by_ref().take(3).read_to_end(&mut bytes)?;
    if bytes != b"CDF" {
        return Ok(sandbox::check(path).err());
    }
    file.read_to_end(&mut bytes)?;
    Ok(classic_header::damage(&bytes).map(str::to_string))
}

impl DatasetReader {
    /// Opens a file after its bytes have been verified.
    pub fn open(path: &Path) -> Result<Self, DatasetError> {
        let shown = path.display().to_string();
        let failed = |reason: String| DatasetError::Open { path: shown.clone(), reason };
        // The library's message for a missing file does not always name the reason.
        let opened = check_regular(path).and_then(|()| std::fs::File::open(path)).and_then(|mut file| {
            let damage = match checksum::inspect(&mut file)? {
                Checksum::Agrees => None,
                Checksum::Damaged(damage) => Some(damage),
                Checksum::Absent => foreign_damage(path)?,
            };
            Ok((file.metadata()?.len(), damage))
        });
        let (size, damage) = opened.map_err(|error| failed(error.to_string()))?;
        if let Some(damage) = damage {
            return Err(failed(damage));
        }
        silence_hdf5();
        let alone = hdf5_metno_sys::LOCK.lock();
        let file = ::netcdf::open(path).map_err(|error| failed(error.to_string()))?;
        let most_values = usize::try_from(size.saturating_mul(MOST_EXPANSION) / 8).unwrap_or(usize::MAX);
        Ok(Self { path: shown, file, most_values, _alone: alone })
    }

    /// Global attribute that is a text.
    pub fn attribute_text(&self, name: &str) -> Result<String, DatasetError> {
        self.optional_text(name)?.ok_or_else(|| self.missing("global attribute", name))
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
        self.optional_real(name)?.ok_or_else(|| self.missing("global attribute", name))
    }

    /// Global attribute that is a number, if it is there.
    pub fn optional_real(&self, name: &str) -> Result<Option<f64>, DatasetError> {
        let number = self.attribute(name)?.map(f64::try_from).transpose();
        number.map_err(|_| self.content(format!("global attribute \"{name}\" is not a number")))
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
        Ok(self.variable(name)?.dimensions().iter().map(Dimension::len).collect())
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

    /// Numbers of the expected shape, row-major; NaN for the fill value. Packed numbers are those times `scale_factor` plus
    /// `add_offset` (NetCDF User's Guide, Attribute Conventions).
    pub fn reals(&self, name: &str, shape: &[usize]) -> Result<Vec<f64>, DatasetError> {
        let variable = self.shaped(name, shape)?;
        let stated = |attribute: &str| self.variable_real(name, attribute);
        let fill = stated("_FillValue").unwrap_or_else(|| fill_value(&variable));
        let missing = [fill, stated("missing_value").unwrap_or(f64::NAN)];
        let (scale, offset) = (stated("scale_factor").unwrap_or(1.0), stated("add_offset").unwrap_or(0.0));
        let values = variable.get_values::<f64, _>(..);
        let mut values = values.map_err(|error| self.unreadable("variable", name, &error))?;
        for value in &mut values {
            *value = if missing.contains(value) { f64::NAN } else { offset + scale * *value };
        }
        Ok(values)
    }

    /// Numbers with those of the variable of their errors.
    pub fn estimates(&self, name: &str, shape: &[usize]) -> Result<Vec<Estimate>, DatasetError> {
        let (values, errors) = (self.reals(name, shape)?, self.reals(&format!("{name}_error"), shape)?);
        Ok(values.into_iter().zip(errors).map(|(value, error)| Estimate { value, error }).collect())
    }

    /// Flags of the expected shape.
    pub fn flags(&self, name: &str, shape: &[usize]) -> Result<Vec<i8>, DatasetError> {
        let values = self.shaped(name, shape)?.get_values::<i8, _>(..);
        values.map_err(|error| self.unreadable("variable", name, &error))
    }

    /// One text of a variable of texts.
    pub fn text(&self, name: &str, index: &[usize]) -> Result<String, DatasetError> {
        let text = self.variable(name)?.get_string(index);
        text.map_err(|error| self.unreadable("variable", name, &error))
    }

    /// An error about this file.
    pub fn content(&self, what: String) -> DatasetError {
        DatasetError::Content { path: self.path.clone(), what }
    }

    fn attribute(&self, name: &str) -> Result<Option<AttributeValue>, DatasetError> {
        let value = self.file.attribute(name).map(|attribute| attribute.value()).transpose();
        value.map_err(|error| self.unreadable("global attribute", name, &error))
    }

    fn unreadable(&self, kind: &str, name: &str, error: &::netcdf::Error) -> DatasetError {
        self.content(format!("{kind} \"{name}\": {error}"))
    }

    fn missing(&self, kind: &str, name: &str) -> DatasetError {
        self.content(format!("{kind} \"{name}\" is missing; not a file of this kind"))
    }

    fn variable(&self, name: &str) -> Result<::netcdf::Variable<'_>, DatasetError> {
        self.file.variable(name).ok_or_else(|| self.missing("variable", name))
    }

    fn shaped(&self, name: &str, shape: &[usize]) -> Result<::netcdf::Variable<'_>, DatasetError> {
        let variable = self.variable(name)?;
        let found: Vec<usize> = variable.dimensions().iter().map(Dimension::len).collect();
        // Dimensions take no space in a file and may exceed any memory.
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
