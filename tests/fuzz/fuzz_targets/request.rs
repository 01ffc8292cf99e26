//! A request for a table: refused in a sentence, or the same when it is written and read again.
#![no_main]

use asperity::scene::file::{parse_request, write_request};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    if let Ok(request) = parse_request(text, "input", &[]) {
        let written = write_request(&request);
        let again = parse_request(&written, "written", &[]);
        assert_eq!(again.as_ref().map_err(ToString::to_string), Ok(&request), "{written}");
    }
});
