//! A surface; the samples that it may name are looked for in an empty directory.
#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use roughsurface::surface::file::SurfaceFile;

fuzz_target!(|text: &str| {
    let _ = SurfaceFile::parse(Path::new("/nonexistent/input"), text.to_string());
});
