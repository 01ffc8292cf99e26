//! A height map or profile of any format. It is read from memory.
#![no_main]

use libfuzzer_sys::fuzz_target;
use roughsurface::topography::readers::{Reading, read};

fuzz_target!(|bytes: &[u8]| {
    let path = std::path::PathBuf::from(format!("/dev/shm/asperity-fuzz-topography-{}", std::process::id()));
    // A new file each time: the HDF5 library may still have the last one open after an error.
    let _ = std::fs::remove_file(&path);
    std::fs::write(&path, bytes).unwrap();
    for reading in [Reading::default(), Reading { unit: Some(1e-6), pixel: Some(1e-6) }] {
        let _ = read(&path, &reading);
    }
    let _ = std::fs::remove_file(&path);
});
