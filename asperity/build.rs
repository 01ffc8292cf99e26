//! Lists the material presets, and computes the fingerprint of what the numbers depend on: sources, versions of the
//! dependencies, compiler, and instructions of the processor. It distinguishes builds of one version that give
//! different results.

use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

/// Sources that do not influence results, relative to `src`.
const NOT_HASHED: [&str; 8] = [
    "cli",
    "output/contact_maps.rs",
    "output/figures.rs",
    "output/revolved",
    "output/scale.rs",
    "output/vtu.rs",
    "simulate/messages",
    "studies",
];

/// Sources of the crate `tables` that influence results of runs. The crate is next to this one in the
/// repository; a published one has the same version number.
const OF_TABLES: [&str; 2] = ["../tables/src/interpolation/steffen.rs", "../tables/src/closed_forms"];

/// Settings of the compiler, as cargo passes them.
const SETTINGS: [&str; 4] = ["TARGET", "OPT_LEVEL", "CARGO_CFG_TARGET_FEATURE", "CARGO_ENCODED_RUSTFLAGS"];

fn main() {
    let root = PathBuf::from(std::env::var_os("CARGO_MANIFEST_DIR").expect("set by cargo"));
    let mut files = Vec::new();
    collect(&root.join("src"), &mut files);
    let shown = |file: &PathBuf| !NOT_HASHED.iter().any(|name| file.starts_with(root.join("src").join(name)));
    files.retain(shown);
    if root.join("../tables").exists() {
        for path in OF_TABLES.map(|path| root.join(path)) {
            collect(&path, &mut files);
            println!("cargo::rerun-if-changed={}", path.display());
        }
    }
    // Of the workspace, or of a published crate.
    let locks = ["../Cargo.lock", "Cargo.lock"].map(|name| root.join(name));
    if let Some(lock) = locks.into_iter().find(|file| file.exists()) {
        println!("cargo::rerun-if-changed={}", lock.display());
        files.push(lock);
    }
    // Directories are not read in the order of names.
    files.sort();
    let mut hash = Sha256::new();
    hash.update(compiler());
    for setting in SETTINGS {
        hash.update(std::env::var(setting).unwrap_or_default() + "\n");
    }
    for file in files {
        let content = std::fs::read(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        let name = file.strip_prefix(&root).unwrap_or(&file).to_string_lossy().into_owned();
        hash.update(name);
        hash.update((content.len() as u64).to_le_bytes());
        hash.update(content);
    }
    let digits: String = hash.finalize().iter().take(8).map(|byte| format!("{byte:02x}")).collect();
    println!("cargo::rustc-env=ASPERITY_FINGERPRINT={digits}");
    println!("cargo::rerun-if-changed=src");
    list_presets(&root.join("src/scene/presets"));
}

/// What the compiler says of its version.
fn compiler() -> Vec<u8> {
    let rustc = std::env::var_os("RUSTC").expect("set by cargo");
    let said = std::process::Command::new(&rustc).arg("-vV").output();
    said.unwrap_or_else(|error| panic!("{}: {error}", rustc.display())).stdout
}

/// Writes `const FILES: &[(name, content)]` of the files `NAME.toml` in a folder, by name.
fn list_presets(folder: &Path) {
    let mut files = Vec::new();
    collect(folder, &mut files);
    files.retain(|file| file.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    let entry = |file: &PathBuf| {
        let name = file.file_stem().unwrap_or_default();
        format!("    ({name:?}, include_str!({file:?})),\n")
    };
    let entries: String = files.iter().map(entry).collect();
    let target = PathBuf::from(std::env::var_os("OUT_DIR").expect("set by cargo")).join("presets.rs");
    let text = format!("const FILES: &[(&str, &str)] = &[\n{entries}];\n");
    std::fs::write(&target, text).unwrap_or_else(|error| panic!("{}: {error}", target.display()));
}

/// All files below `path`, or `path` itself.
fn collect(path: &Path, files: &mut Vec<PathBuf>) {
    if path.is_file() {
        files.push(path.to_owned());
        return;
    }
    let entries = std::fs::read_dir(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    for entry in entries.flatten() {
        collect(&entry.path(), files);
    }
}
