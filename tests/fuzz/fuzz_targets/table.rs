//! A table. Damage must be found before the HDF5 library sees it, or by the library without harm.
#![no_main]

use libfuzzer_sys::fuzz_target;
use tables::table::Table;

fuzz_target!(|bytes: &[u8]| {
    let path = std::path::PathBuf::from(format!("/dev/shm/asperity-fuzz-table-{}", std::process::id()));
    let _ = std::fs::remove_file(&path);
    std::fs::write(&path, bytes).unwrap();
    let _ = Table::read(&path);
    let _ = std::fs::remove_file(&path);
});
