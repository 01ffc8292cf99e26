//! A scene: refused in a sentence, or the same when it is written and read again.
#![no_main]

use asperity::scene::file::{parse_scene, write_scene};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    if let Ok(scene) = parse_scene(text, "input", &[]) {
        let written = write_scene(&scene);
        let again = parse_scene(&written, "written", &[]);
        assert_eq!(again.as_ref().map_err(ToString::to_string), Ok(&scene), "{written}");
    }
});
