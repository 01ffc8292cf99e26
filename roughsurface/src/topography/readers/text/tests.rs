//! Text of topographies.

use super::*;

fn read(text: &str) -> Result<Topography, String> {
    parse(text, &Reading::default())
}

/// Of micrometres two of which lie between points, and of metres.
const MICROMETRES: Reading = Reading { unit: Some(1e-6), pixel: Some(2e-6) };
const METRES: Reading = Reading { unit: Some(1.0), pixel: Some(1.0) };

#[test]
fn columns_of_positions_and_heights_in_any_order() {
    let map = read("0 0 1\n2 0 3\n1 0 2\n0 1 4\n2 1 6 # last\n1 1 5\n").unwrap();
    assert_eq!((map.rows, map.columns, map.column_step), (2, 3, 1.0));
    assert_eq!(map.heights, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    let hole = read("0 0 1\n2 0 3\n1 0 2\n0 1 4\n2 1 6\n").unwrap();
    assert!(hole.heights[4].is_nan());
    assert_eq!(read("0 0 1\n1 0 2\n0 1 4\n1 1 5\n0 0 1\n").unwrap().heights, [1.0, 2.0, 4.0, 5.0]);
    let twice = read("0 0 1\n1 0 2\n0 1 4\n1 1 5\n1 0 3\n").unwrap_err();
    assert!(twice.contains("x = 1 m, y = 0 m"), "{twice}");
    assert!(read("0 0 1\n1 0 2\n3 0 3\n0 1 4\n1 1 5\n3 1 6\n").unwrap_err().contains("x is not evenly"));
}

#[test]
fn titles_of_columns_may_say_the_unit() {
    let points = "0 0 1\n1 0 2\n0 1 4\n1 1 5\n";
    let named = read(&format!("X Y Z\n{points}")).unwrap();
    assert_eq!((named.heights[3], named.remarks), (5.0, vec![Warning::CountedPositions, Warning::NoUnit]));
    let micrometres = read(&format!("x [um], y [um], z [um]\n{points}")).unwrap();
    assert!((micrometres.heights[3] / 5e-6 - 1.0).abs() < 1e-15 && micrometres.remarks.is_empty());
    let mixed = format!("x [mm], y [mm], z [um]\n{points}");
    let map = read(&mixed).unwrap();
    assert!((map.heights[3] / 5e-6 - 1.0).abs() < 1e-15 && map.remarks.is_empty());
    assert!((map.row_step / 1e-3 - 1.0).abs() < 1e-12);
    let refused = parse(&mixed, &Reading { unit: Some(1e-6), pixel: None }).unwrap_err();
    assert!(refused.contains("leave out --unit"), "{refused}");
    let numpy = read(&format!("# x [mm] y [mm] z [um]\n{points}")).unwrap();
    assert_eq!((numpy.heights, numpy.remarks), (map.heights, vec![]));
    assert!(read(&format!("{points}x y z\n")).unwrap_err().contains("line 5: \"x\""));
}

#[test]
fn unknown_units_of_a_header_are_refused() {
    let header = "# Width: 8.0 um\n# Height: 3.0 um\n# Value units: mV\n";
    let error = read(&format!("{header}1 2 3 4\n5 6 7 8\n")).unwrap_err();
    assert!(error.contains("its header states no known unit of length: \"mV\""), "{error}");
}

#[test]
fn lines_may_end_with_a_carriage_return() {
    let map = parse("1 2 3 4\r5 6 7 8\r", &MICROMETRES).unwrap();
    assert_eq!((map.rows, map.columns), (2, 4));
}

#[test]
fn matrices_need_a_pixel_or_a_header() {
    let text = "1 2 3 4\n5 6 7 nan\n";
    assert!(read(text).unwrap_err().contains("--pixel"));
    let map = parse(text, &MICROMETRES).unwrap();
    assert_eq!((map.rows, map.columns, map.row_step), (2, 4, 2e-6));
    assert!((map.heights[5] - 6e-6).abs() < 1e-20 && map.heights[7].is_nan());
    let gwyddion = "# Channel: Topo\n# Width: 8.0 µm\n# Height: 3.0 µm\n# Value units: nm\n";
    let map = read(&format!("{gwyddion}{text}")).unwrap();
    assert!((map.column_step - 2e-6).abs() < 1e-18 && (map.row_step - 1.5e-6).abs() < 1e-18);
    assert!((map.heights[0] - 1e-9).abs() < 1e-22 && map.remarks.is_empty());
    for (unit, pixel, refused) in [(Some(1e-6), None, "--unit"), (None, Some(2e-6), "--pixel")] {
        let error = parse(&format!("{gwyddion}{text}"), &Reading { unit, pixel }).unwrap_err();
        assert!(error.contains(&format!("leave out {refused}")), "{error}");
    }
    let same = parse(&format!("{gwyddion}{text}"), &Reading { unit: Some(1e-9), pixel: None }).unwrap();
    assert_eq!(same.heights[..7], map.heights[..7]);
}

/// A comment states the unit of a matrix if it names heights; that of another may be the unit of points.
#[test]
fn a_comment_states_the_unit_of_a_matrix() {
    let heights = |comment: &str, unit: Option<f64>| {
        parse(&format!("# {comment}\n1 2 4 3\n3 1 2 4\n"), &Reading { unit, pixel: Some(1e-6) })
    };
    for comment in
        ["Height [nm]", "Höhe [nm]", "z (nm)", "z [nm] x [um] y [um]", "Height [nm], pixel [um]: 1"]
    {
        let map = heights(comment, None).unwrap();
        assert!(map.heights[2] == 4e-9 && map.remarks.is_empty(), "{comment}");
        assert!(heights(comment, Some(1e-6)).unwrap_err().contains("leave out --unit"));
    }
    let of_points = heights("pixel [um]: 1", None).unwrap();
    assert!(of_points.heights[2] == 4.0 && of_points.remarks.contains(&Warning::NoUnit));
}

#[test]
fn positions_beside_a_matrix_are_no_heights() {
    let spreadsheet = ",0,2,4,6\n0,1,3,2,5\n2,4,4,1,3\n4,2,2,6,1\n";
    assert!(parse(spreadsheet, &METRES).unwrap_err().contains("positions, not heights"));
    // A plane is even too, but whole; a missing corner is that of a rough surface.
    for heights in ["0,2,4,6\n2,4,6,8\n4,6,8,10\n", ",0.1,4,6\n0,1,3,2\n2,4,4,1\n"] {
        assert_eq!(parse(heights, &METRES).unwrap().columns, 4, "{heights}");
    }
}

#[test]
fn uneven_profiles_are_resampled() {
    let profile = read("0 0\n1 10\n2.7 27\n4 40\n").unwrap();
    assert_eq!(profile.column_step, 4.0 / 3.0);
    for (i, height) in profile.heights.iter().enumerate() {
        assert!((height - 10.0 * i as f64 * 4.0 / 3.0).abs() < 1e-12);
    }
    assert!(profile.remarks.contains(&Warning::Resampled));
    assert!(read("0 0\n0 1\n1 1\n").unwrap_err().contains("point 2"));
}

#[test]
fn points_left_out_of_an_even_profile_have_no_height() {
    let left_out = read("0 0\n1 10\n3 20\n4 40\n5 50\n").unwrap();
    let empty = read("0 0\n1 10\n2 nan\n3 20\n4 40\n5 50\n").unwrap();
    assert_eq!(left_out.column_step, empty.column_step);
    let same = |(a, b): (&f64, &f64)| a == b || a.is_nan() && b.is_nan();
    assert!(left_out.heights.len() == 6 && left_out.heights.iter().zip(&empty.heights).all(same));
    assert!(!left_out.remarks.contains(&Warning::Resampled));
}

#[test]
fn commas_separate_or_are_decimal() {
    let heights = |text: &str| {
        let map = parse(&format!("{text}\n").repeat(2), &METRES).unwrap();
        (map.heights[..map.columns].to_vec(), map.remarks)
    };
    let decimal = vec![Warning::DecimalCommas];
    for text in
        ["1,5;-2,25;3;4,0e-1", "1,5 -2,25 3 4,0e-1", "1,5\t-2,25\t3\t4,0e-1", "1,5; -2,25; 3; 4,0e-1;"]
    {
        assert_eq!(heights(text), (vec![1.5, -2.25, 3.0, 0.4], decimal.clone()), "{text}");
    }
    for text in ["1,5,2,3", "1, 5, 2, 3", "1,5, 2,3,", "1 ,5 ,2 ,3", "1;5;2;3"] {
        assert_eq!(heights(text), (vec![1.0, 5.0, 2.0, 3.0], vec![]), "{text}");
    }
    assert_eq!(heights("1.5,2.5 3.5,4.5").0, [1.5, 2.5, 3.5, 4.5]);
    assert!(heights("1,,2,3").0[1].is_nan());
    for text in
        ["\"1.5\",\"2.5\",\"3.5\",\"4.5\"", "\"1,5\",\"2,5\",\"3,5\",\"4,5\"", "\"1,5\";\"2,5\";3.5;\"4,5\""]
    {
        assert_eq!(heights(text), (vec![1.5, 2.5, 3.5, 4.5], vec![]), "{text}");
    }
    assert!(heights("1,***,2,3").0[1].is_nan());
    // A last cell may be empty too; a separator at the end of every line is none.
    let map = |text: &str| parse(text, &METRES).unwrap().heights;
    for text in ["1,2,3,4\n5,6,7,\n", "1,2,3,4\n,6,7,8\n"] {
        assert_eq!(map(text).iter().filter(|height| height.is_nan()).count(), 1, "{text}");
    }
    assert_eq!(map("a,b,c,d,\n1,2,3,4,\n5,6,7,8,\n").len(), 8);
    let thousands = parse("5,000.5;4,000;3,000;2,000\n", &Reading::default()).unwrap_err();
    assert!(thousands.contains("thousands"), "{thousands}");
    let titled = read("\u{feff}x [um]; z [um]\n0,0; 1,5\n0,1; 2,5\n0,2; 3,5\n").unwrap();
    assert!((titled.column_step - 1e-7).abs() < 1e-18 && (titled.heights[1] - 2.5e-6).abs() < 1e-18);
    // A single column with decimal commas is two columns by its letters.
    assert!(read("1,5\n0,3\n2,4\n").unwrap_err().contains("decimal commas"));
}

#[test]
fn what_is_no_topography_says_where() {
    let word = read("1 2 3 4\n1 2 three 4\n").unwrap_err();
    assert!(word.starts_with("line 2: \"three\" is not a number; a point without a height is nan"), "{word}");
    let header = read("Points: 4\n1 2 3 4\n").unwrap_err();
    assert!(header.ends_with("lines before the heights begin with #"), "{header}");
    let ragged = read("1 2 3 4\n1 2 3\n").unwrap_err();
    assert!(ragged.starts_with("line 2: 3 numbers, 4 in the lines before; write NaN"), "{ragged}");
    assert_eq!(read("# nothing\n").unwrap_err(), "holds no numbers");
}
