//! What README and book say of the shipped tables is what the tables say of themselves.

use std::path::Path;

use tables::quantity::Quantity;
use tables::shipped;
use tables::statistics::ErrorStatistics;

const QUANTITIES: [Quantity; 7] = [
    Quantity::MuStatic,
    Quantity::Mu,
    Quantity::Friction,
    Quantity::Load,
    Quantity::Area,
    Quantity::EnergyRelease,
    Quantity::TemperatureMax,
];

/// Columns of what is said of each quantity, in per cent.
fn row(name: &str, of: impl Fn(&ErrorStatistics) -> String) -> String {
    let statistics = shipped::table(name).unwrap().error_statistics();
    let columns = QUANTITIES.map(|quantity| {
        let found = statistics.iter().find(|statistics| statistics.quantity == quantity).unwrap();
        format!(" {} |", of(found))
    });
    format!("| `{name}` |{}", columns.concat())
}

#[test]
fn stated_errors_are_those_of_the_tables() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let mut missing = Vec::new();
    let mut need = |page: &str, row: String| {
        let text = std::fs::read_to_string(root.join(page)).unwrap();
        if !text.contains(&row) {
            missing.push(format!("{page}: {row}"));
        }
    };
    for name in shipped::names() {
        let errors = row(name, |of| format!("{:.1} / {:.1}", 100.0 * of.median, 100.0 * of.largest));
        need("README.md", errors.clone());
        need("docs/src/shipped.md", errors);
        need("docs/src/shipped.md", row(name, |of| format!("{:.1}", 100.0 * of.interpolation)));
    }
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}
