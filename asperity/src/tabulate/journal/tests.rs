//! Journals that were cut off, damaged, of others, or in use.

use tables::quantity::Quantity;

use super::*;
use crate::simulate::fake;
use crate::tabulate::cell::slip_grid;

fn at(interference: f64, slip_rate: f64) -> Point {
    Point { temperature: 298.0, interference, slip_rate }
}

fn finished() -> Finished {
    let mut outcome = fake::outcome(&fake::scene(20.0, 1.0));
    outcome.scalars[Quantity::Mu].error = f64::NAN;
    outcome.account.wall_time = 0.1 + 0.2;
    Finished::new(&outcome, &slip_grid(2.0), 298.0)
}

fn journal_path() -> (tempfile::TempDir, PathBuf) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("table.nc.part");
    (directory, path)
}

fn open(path: &Path, resume: bool) -> Result<(Journal, Vec<(Point, CellResult)>), JournalError> {
    Journal::open(path, "a = 1\n", None, resume)
}

/// Three failures, at 0, 1 and 2 ω_c.
fn journal_of_three() -> (tempfile::TempDir, PathBuf) {
    let (directory, path) = journal_path();
    let (mut journal, _) = open(&path, false).unwrap();
    for k in 0..3 {
        journal.record(at(f64::from(k), 0.0), &Err(format!("reason {k}"))).unwrap();
    }
    (directory, path)
}

#[test]
fn cells_come_back_bit_for_bit() {
    let (_directory, path) = journal_path();
    let (mut journal, found) = open(&path, false).unwrap();
    assert!(found.is_empty());
    journal.record(at(0.1 + 0.2, 2e-7), &Ok(finished())).unwrap();
    journal.record(at(100.0, 0.0), &Err("did not\nconverge".into())).unwrap();
    drop(journal);
    let (_, found) = open(&path, true).unwrap();
    assert_eq!(found.len(), 2);
    assert_eq!(found[0].0, at(0.1 + 0.2, 2e-7));
    let cell = found[0].1.as_ref().unwrap();
    assert_eq!(cell, &finished());
    assert_eq!(record::hexadecimal(&cell.cell), record::hexadecimal(&finished().cell));
    assert_eq!(found[1], (at(100.0, 0.0), Err("did not\nconverge".into())));
}

#[test]
fn a_damaged_line_loses_only_its_cell() {
    let (_directory, path) = journal_of_three();
    let whole = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, whole.replace("reason 1", "reason 7")).unwrap();
    let (_, found) = open(&path, true).unwrap();
    let points: Vec<Point> = found.iter().map(|(point, _)| *point).collect();
    assert_eq!(points, [at(0.0, 0.0), at(2.0, 0.0)]);
}

#[test]
fn other_requests_and_unasked_continuations_are_refused() {
    let (_directory, path) = journal_path();
    Journal::open(&path, "a = 1\nb = 2\n", None, false).unwrap();
    let refused = |request: &str, resume: bool| {
        let error = Journal::open(&path, request, None, resume).err().unwrap();
        error.to_string()
    };
    assert!(refused("a = 1\nb = 2\n", false).contains("--resume"));
    for resume in [true, false] {
        let said = refused("a = 1\nb = 3\n", resume);
        let remedy = "of b it has 2, the request 3; delete it, or choose another name";
        assert!(said.contains(remedy), "{said}");
    }
    let shard = "2/3".parse().ok();
    let error = Journal::open(&path, "a = 1\nb = 2\n", shard, true).err().unwrap().to_string();
    assert!(error.contains("it is of the whole table, not of shard 2/3"), "{error}");
}

#[test]
fn a_journal_of_another_build_is_refused() {
    let (_directory, path) = journal_path();
    let refused = |header: &Header| {
        std::fs::write(&path, encode(header).unwrap()).unwrap();
        match open(&path, true) {
            Ok(_) => String::new(),
            Err(error) => error.to_string(),
        }
    };
    let mut header = Header {
        source: SOURCE.into(),
        fingerprint: FINGERPRINT.into(),
        shard: None,
        request: "a = 1\n".into(),
    };
    assert_eq!(refused(&header), "");
    header.fingerprint = "0123456789abcdef".into();
    let message = refused(&header);
    assert!(message.contains("another build") && message.contains(FINGERPRINT), "{message}");
    header.source = "asperity 0.0.9".into();
    assert!(refused(&header).contains("asperity 0.0.9"));
}

/// Files of others keep every byte, with --resume and without.
#[test]
fn a_file_that_is_not_a_journal_of_the_table_is_left_as_it_is() {
    let (_directory, path) = journal_path();
    let own = encode(&Record::new(0, at(1.0, 0.0), &Err("of another request".into()))).unwrap();
    for text in ["0123", "a thesis\nof two lines\n", "\n", &format!("damaged\n{own}")] {
        for resume in [true, false] {
            std::fs::write(&path, text).unwrap();
            let error = open(&path, resume).err().unwrap().to_string();
            assert!(error.contains("is not a journal of this table"), "{text:?}: {error}");
            assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
        }
    }
}

#[cfg(unix)]
#[test]
fn a_link_is_not_followed() {
    let (_directory, path) = journal_path();
    let target = path.with_file_name("empty");
    std::fs::write(&target, "").unwrap();
    std::os::unix::fs::symlink(&target, &path).unwrap();
    let error = open(&path, true).err().unwrap().to_string();
    assert!(error.contains("symbolic link"), "{error}");
    assert_eq!(std::fs::read(&target).unwrap(), b"");
}

/// Wherever a crash cuts the file, complete lines before the cut are found, and the next result is appended.
#[test]
fn a_journal_cut_anywhere_loses_no_whole_line() {
    let (_directory, path) = journal_of_three();
    let whole = std::fs::read(&path).unwrap();
    for length in 0..=whole.len() {
        let cut = &whole[..length];
        std::fs::write(&path, cut).unwrap();
        let (mut journal, found) = open(&path, true).unwrap();
        // A line may lack its line end alone.
        let complete = cut.iter().chain(whole.get(length)).filter(|&&byte| byte == b'\n').count();
        assert_eq!(found.len(), complete.saturating_sub(1), "cut at {length}");
        journal.record(at(9.0, 0.0), &Err("next".into())).unwrap();
        drop(journal);
        let (_, again) = open(&path, true).unwrap();
        assert_eq!(again.len(), found.len() + 1, "cut at {length}");
        assert_eq!(again.last(), Some(&(at(9.0, 0.0), Err("next".into()))));
    }
}

/// Whichever byte of the first line is damaged: every result says which request it is of.
#[test]
fn results_below_a_damaged_request_are_found() {
    let (_directory, path) = journal_path();
    let (mut journal, _) = open(&path, false).unwrap();
    for interference in [1.0, 2.0] {
        journal.record(at(interference, 0.0), &Err("reason".into())).unwrap();
    }
    drop(journal);
    let whole = std::fs::read(&path).unwrap();
    let end = whole.iter().position(|byte| *byte == b'\n').unwrap();
    for byte in 0..=end {
        let mut damaged = whole.clone();
        damaged[byte] ^= 1;
        std::fs::write(&path, &damaged).unwrap();
        let (_, found) = open(&path, true).unwrap();
        // Without its line end the first line swallows the second.
        assert_eq!(found.len(), if byte < end { 2 } else { 1 }, "byte {byte}");
        std::fs::write(&path, &damaged).unwrap();
        assert!(Journal::open(&path, "a = 2\n", None, true).is_err(), "byte {byte}");
    }
}

#[test]
fn a_journal_in_use_is_refused() {
    let (_directory, path) = journal_path();
    let (journal, _) = open(&path, true).unwrap();
    let error = open(&path, true).err().unwrap().to_string();
    assert!(error.contains("another program"), "{error}");
    // Nor is one told to delete it.
    let error = open(&path, false).err().unwrap().to_string();
    assert!(error.contains("another program"), "{error}");
    drop(journal);
    assert!(open(&path, true).is_ok());
}

#[test]
fn a_journal_that_was_removed_takes_no_results() {
    let (_directory, path) = journal_path();
    let (mut journal, _) = open(&path, true).unwrap();
    std::fs::remove_file(&path).unwrap();
    let error = journal.record(at(1.0, 0.0), &Err("reason".into())).unwrap_err().to_string();
    assert!(error.contains("removed or replaced"), "{error}");
}
