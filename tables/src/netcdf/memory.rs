//! netCDF files built in memory.
//!
//! The HDF5 library may crash, or leave damaged files, where a disk is full. So it never writes to a disk here:
//! a file is built in memory and taken as bytes, which are written by [`super::write_atomically`].

use std::ffi::CString;
use std::sync::atomic::{AtomicU64, Ordering};

use ::netcdf::{FileMut, Options};
use hdf5_metno_sys::h5f::{H5F_OBJ_ALL, H5F_OBJ_FILE, H5Fget_file_image, H5Fget_name, H5Fget_obj_ids};
use hdf5_metno_sys::h5i::hid_t;

use super::{silence_hdf5, superblock};

/// A file in memory, being written.
pub(super) struct MemoryFile {
    /// Name of the file in the HDF5 library; no file of that name exists on a disk.
    name: String,
    pub(super) file: FileMut,
}

impl MemoryFile {
    pub(super) fn create() -> ::netcdf::Result<Self> {
        static CREATED: AtomicU64 = AtomicU64::new(0);
        let name = format!("asperity-in-memory-{}", CREATED.fetch_add(1, Ordering::Relaxed));
        silence_hdf5();
        let file = ::netcdf::create_with(&name, Options::NETCDF4 | Options::DISKLESS)?;
        Ok(Self { name, file })
    }

    /// Bytes of the complete file.
    pub(super) fn into_bytes(self) -> Result<Vec<u8>, String> {
        self.file.sync().map_err(|error| error.to_string())?;
        let mut bytes = image(&self.name).ok_or("the HDF5 library does not yield the file")?;
        superblock::write_checksum(&mut bytes).ok_or("the HDF5 library yields a part of the file")?;
        self.file.close().map_err(|error| error.to_string())?;
        Ok(bytes)
    }
}

/// Content of the open file of that name; the netCDF library has no call for it that its Rust interface reaches.
fn image(name: &str) -> Option<Vec<u8>> {
    let _guard = hdf5_metno_sys::LOCK.lock();
    let file = open_files()?.into_iter().find(|&file| has_name(file, name))?;
    // SAFETY: the file stays open while its lock is held. Without a buffer the call yields the length that it needs.
    unsafe {
        let length = usize::try_from(H5Fget_file_image(file, std::ptr::null_mut(), 0)).ok()?;
        let mut bytes = vec![0; length];
        let written = H5Fget_file_image(file, bytes.as_mut_ptr().cast(), length);
        (usize::try_from(written) == Ok(length)).then_some(bytes)
    }
}

/// Identifiers of the files that are open; the lock must be held.
fn open_files() -> Option<Vec<hid_t>> {
    /// More than are ever open at a time.
    const MOST: usize = 1024;
    let mut files = vec![0; MOST];
    // SAFETY: the buffer has room for the number of identifiers that is passed with it.
    let found = unsafe { H5Fget_obj_ids(H5F_OBJ_ALL as hid_t, H5F_OBJ_FILE, MOST, files.as_mut_ptr()) };
    files.truncate(usize::try_from(found).ok()?);
    Some(files)
}

fn has_name(file: hid_t, name: &str) -> bool {
    let Ok(name) = CString::new(name) else { return false };
    // One byte more, so that a longer name differs.
    let mut found = vec![0u8; name.as_bytes_with_nul().len() + 1];
    // SAFETY: the name is cut off at the length of the buffer.
    let length = unsafe { H5Fget_name(file, found.as_mut_ptr().cast(), found.len()) };
    usize::try_from(length) == Ok(name.as_bytes().len()) && found.starts_with(name.as_bytes())
}
