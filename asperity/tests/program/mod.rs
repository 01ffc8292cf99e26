//! What tests that start programs share.

use std::sync::{Mutex, MutexGuard};

pub fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// One test at a time: a program started by one would inherit the files that another has open in
/// the HDF5 library, and with them their locks.
pub fn alone() -> MutexGuard<'static, ()> {
    static ALONE: Mutex<()> = Mutex::new(());
    ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
}
