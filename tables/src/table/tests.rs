use super::*;
use crate::quantity::Quantity;

const TEMPERATURES: [f64; 3] = [300.0, 500.0, 800.0];

fn slice(temperature: f64) -> Slice {
    let axes = Axes { interference: vec![1.0, 10.0], slip_rate: vec![0.0, 1.0], slip: vec![0.0, 2.0] };
    let metadata = Metadata { temperature, ..Metadata::default() };
    let load = |interference, slip_rate| interference * temperature + slip_rate;
    Slice::filled(axes, metadata, |omega, rate| Cell::new().with(Quantity::Load, load(omega, rate), 0.0))
        .unwrap()
}

#[test]
fn shards_merge_to_the_whole() {
    let whole = Table::new(TEMPERATURES.map(slice).to_vec()).unwrap();
    let (mut first, mut second) = (whole.clone(), whole.clone());
    for (k, (one, other)) in first.slices.iter_mut().zip(&mut second.slices).enumerate() {
        let (i, j) = (k % 2, k / 2 % 2);
        one.set_status(i, j, Status::NotRun);
        one.mark_failed(i, 1 - j, "no memory");
        other.set_status(1 - i, j, Status::NotRun);
    }
    assert_eq!(first.missing()[1], "10 omega_c at 0 m/s from 500 K");
    first.merge(&second).unwrap();
    assert_eq!(first, whole);
    let fewer = Table::new(whole.slices[..2].to_vec()).unwrap();
    assert!(first.merge(&fewer).unwrap_err().to_string().contains("their temperatures: 3 and 2"));
}

#[test]
fn warnings_of_some_temperatures_name_them() {
    let mut slices = TEMPERATURES.map(slice).to_vec();
    let warned = |slice: &Slice, warnings: &[&str]| {
        let warnings = warnings.iter().map(|text| text.to_string()).collect();
        Cell { warnings, ..slice.cell(1, 0).unwrap().clone() }
    };
    for (slice, warnings) in slices.iter_mut().zip([&["far"][..], &["far"], &["coarse", "far"]]) {
        let cell = warned(slice, warnings);
        slice.set_cell(1, 0, cell).unwrap();
    }
    let mut table = Table::new(slices).unwrap();
    table.summarise();
    let comment = "far [10 omega_c at 0 m/s]\nat 800 K: coarse [10 omega_c at 0 m/s]";
    assert_eq!(table.metadata().comment, comment);
}

#[test]
fn bad_axes_and_histories_are_named() {
    let mut good = slice(300.0);
    let bad = Axes { slip_rate: vec![0.0, 2.0, 1.0], ..good.axes().clone() };
    let error = Slice::new(bad, Metadata::default()).unwrap_err();
    assert_eq!(error.to_string(), "axis \"slip_rate\" must increase, but has 1 at position 2");
    let short = Cell::new().with_history(Quantity::Load, vec![1.0]);
    let error = good.set_cell(0, 0, short).unwrap_err();
    assert_eq!(error.to_string(), "history of P has 1 values, the slip axis 2");
}
