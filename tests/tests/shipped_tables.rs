//! The numbers of README and book on the shipped tables agree with the tables.

use std::path::Path;

use asperity::scene::file::parse_scene;
use tables::closed_forms::partial_slip::constant_shear;
use tables::law::AsperityLaw;
use tables::quantity::Quantity;
use tables::refinement::statistics::ErrorStatistics;
use tables::shipped;
use tables::table::Metadata;
use tests::run;

const QUANTITIES: [Quantity; 9] = [
    Quantity::MuStatic,
    Quantity::Mu,
    Quantity::MuSteady,
    Quantity::Friction,
    Quantity::Load,
    Quantity::Area,
    Quantity::EnergyRelease,
    Quantity::EnergyWeakening,
    Quantity::TemperatureMax,
];

/// In per cent, large ones without decimals.
fn percent(share: f64) -> String {
    let decimals = if share < 0.2 { 1 } else { 0 };
    if share > 1.0 { "> 100".into() } else { format!("{:.decimals$}", 100.0 * share) }
}

/// Columns of the errors of each quantity, in per cent.
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
        let errors = row(name, |of| format!("{} / {}", percent(of.median), percent(of.largest)));
        need("docs/src/shipped.md", errors);
        let between = row(name, |of| {
            let [median, largest] = of.between.unwrap().map(percent);
            format!("{median} / {largest}")
        });
        need("docs/src/shipped.md", between);
    }
    let medians = |is_meant: fn(&str) -> bool, quantities: &[Quantity]| {
        let statistics = shipped::names().filter(|name| is_meant(name)).flat_map(|name| {
            let statistics = shipped::table(name).unwrap().error_statistics();
            statistics.into_iter().filter(|of| quantities.contains(&of.quantity)).collect::<Vec<_>>()
        });
        let [low, high] = statistics
            .map(|of| of.between.unwrap()[0])
            .fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], median| [low.min(median), high.max(median)]);
        format!("{} to {} %", percent(low), percent(high))
    };
    let all = |_: &str| true;
    for errors in [
        medians(all, &[Quantity::MuStatic, Quantity::Mu, Quantity::Friction, Quantity::Area]),
        medians(all, &[Quantity::Load]),
        medians(all, &[Quantity::EnergyRelease]),
        medians(|name| !name.ends_with("-rigid"), &[Quantity::TemperatureMax]),
        medians(|name| name.ends_with("-rigid"), &[Quantity::TemperatureMax]),
    ] {
        need("README.md", errors);
    }
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}

/// Below their first row tables agree with runs within the stated errors of both. Titanium
/// has a low conductivity: its hot contacts are the most demanding case.
#[test]
fn below_their_first_row_tables_agree_with_runs() {
    use Quantity::*;
    let cold = [0.7, 0.5, 0.3].map(|share| ("steel-4340", "", share, 0.0));
    let hot = [
        ("steel-4340", "-rigid", 0.7, 10.0),
        ("steel-4340", "-rigid", 0.5, 10.0),
        ("titanium-6al4v", "-rigid", 0.5, 10.0),
        ("titanium-6al4v", "", 0.5, 10.0),
    ];
    for (metal, flat, share, slip_rate) in cold.into_iter().chain(hot) {
        let table = shipped::table(&format!("{metal}{flat}")).unwrap();
        let Metadata { asperity_radius: radius, counterface, .. } = table.metadata();
        let radius = *radius;
        let counterface = match counterface.as_str() {
            "" => String::new(),
            _ => format!("preset = \"{metal}\"\nelastic = false"),
        };
        let (first, slip_distance) = (table.axes().interference[0], table.axes().slip.last().unwrap());
        let text = format!(
            "[material]\npreset = \"{metal}\"\n[counterface]\n{counterface}\n[asperity]\nradius = {radius}\n[loading]\nslip_rate = {slip_rate}\n\
             interference = {}\nslip_distance = {slip_distance:?}\n[model]\nkinematics = \"small\"\n[numerics]\nelements_per_radius = 12\nsectors = 8\n",
            share * first
        );
        let outcome = run(&parse_scene(&text, "this test", &[]).unwrap());
        for quantity in
            [LoadPress, AreaPress, Load, Area, Friction, Mu, MuStatic, InceptionSlip, EnergyRelease]
        {
            let here = outcome.scalars[quantity];
            let there = table.estimate(quantity, radius, share * first, slip_rate).unwrap();
            let (off, allowed) = ((there.value - here.value).abs(), there.error + here.error);
            println!(
                "{metal}{flat} {share} {quantity:?}: {here:?} {there:?}, {:.2} of the errors",
                off / allowed
            );
            assert!(off < allowed, "{share} {quantity:?}: {here:?} {there:?}");
            // To the error of the first row: friction heats over ten or twenty contact radii, and expansion lifts the load.
            let at_first = table.estimate(quantity, radius, first, slip_rate).unwrap();
            let most = at_first.error / at_first.value + if slip_rate > 0.0 { 0.4 } else { 0.1 };
            assert!(there.error < most * there.value, "{share} {quantity:?}: {there:?}");
        }
    }
}

/// Copper at thirty times the radius of its table and the same VR: the strain rate is 900 times smaller, static friction
/// by 13 %.
#[test]
fn a_table_with_a_rate_law_agrees_with_a_run_at_another_radius() {
    use Quantity::*;
    let table = shipped::table("copper-rate").unwrap();
    let (radius, slip_rate, interference) = (3e-3, 0.01, 20.0);
    let text = format!(
        "[material]\npreset = \"copper\"\nrate = {{ law = \"johnson-cook\" }}\n[counterface]\npreset = \"copper\"\nelastic = false\n\
         [asperity]\nradius = {radius}\n[loading]\nslip_rate = {slip_rate}\ninterference = {interference}\nslip_distance = 2.0\n"
    );
    let outcome = run(&parse_scene(&text, "this test", &[]).unwrap());
    for quantity in
        [FrictionStatic, MuStatic, Friction, Load, Area, InceptionSlip, EnergyRelease, TemperatureMean]
    {
        let here = outcome.scalars[quantity];
        let there = table.estimate(quantity, radius, interference, slip_rate).unwrap();
        let (off, allowed) = ((there.value - here.value).abs(), there.error + here.error);
        println!("{quantity:?}: {here:?} {there:?}, {:.2} of the errors", off / allowed);
        assert!(off < allowed, "{quantity:?}: {here:?} {there:?}");
    }
    let [run, read] = [
        outcome.scalars[FrictionStatic].value,
        table.estimate(FrictionStatic, radius, interference, slip_rate).unwrap().value,
    ];
    assert!((read / run - 1.0).abs() < 0.03, "{read} {run}");
}

/// Friction of an elastic contact of copper, which slips all over at a thousandth of its radius, rises along the table
/// as it does under a constant shear strength (Savkoor 1987).
#[test]
fn tables_show_partial_slip() {
    let table = shipped::table("copper").unwrap();
    let omega = table.axes().interference[0];
    let Metadata { asperity_radius: radius, contact_modulus, poisson_ratio, yield_strength, .. } =
        *table.metadata();
    let tangential = contact_modulus * (1.0 - poisson_ratio) / (2.0 * (2.0 - poisson_ratio));
    let a = table.estimate(Quantity::ContactRadius, radius, omega, 0.0).unwrap().value;
    let gross = constant_shear::gross_slip_displacement(yield_strength / 3f64.sqrt(), tangential, a);
    // Theory and table divide by the friction of the contact area after the press; the sliding one is larger.
    let area = table.estimate(Quantity::AreaPress, radius, omega, 0.0).unwrap().value;
    let full = area * yield_strength / 3f64.sqrt();
    for share in [0.1, 0.2, 0.4, 0.6] {
        let friction = table.response(radius, omega, 0.0, share * gross).unwrap().friction;
        let (here, there) = (friction.value / full, constant_shear::force_fraction(share));
        println!("{share}: {here:.3} {there:.3}, stated {:.3}", friction.error / full);
        assert!((here - there).abs() < 0.01 * there, "{share}: {here} {there}");
    }
}
