use super::*;
use crate::surface::query::{LoadingControl, NormalLoading};
use crate::surface::radii::Radii;
use std::path::Path;
use tables::netcdf::input::Override;

const GOOD: &str = r#"
[surface]
asperity_density = 1e10
asperity_radius = 100e-6
heights = { distribution = "gaussian", std = 0.5e-6 }
[query]
pressure = [1e7, 1e5]
slip_rate = [0.1, 1.0]
hold = "separation"
[material]
youngs_modulus = 200e9
poisson_ratio = 0.3
yield_strength = 400e6
"#;

/// A line of it in place of which others are tested.
const HOLD: &str = "hold = \"separation\"";

fn parse(text: &str) -> Result<SurfaceFile, SurfaceFileError> {
    SurfaceFile::parse(Path::new("surface.toml"), text.to_string())
}

fn message(from: &str, to: &str) -> String {
    assert!(GOOD.contains(from), "{from}");
    parse(&GOOD.replace(from, to)).unwrap_err().to_string()
}

#[test]
fn a_good_file_is_understood() {
    let file = parse(GOOD).unwrap();
    assert_eq!(file.query.loading, NormalLoading::Pressure(vec![1e5, 1e7]));
    assert_eq!(file.query.control, LoadingControl::Separation);
    assert_eq!(file.surface.asperity_radius, Radii::from(1e-4));
    assert_eq!(file.material.unwrap().poisson_ratio, 0.3);
    assert_eq!(file.text, GOOD);
    let short = parse(&GOOD.replace(HOLD, "")).unwrap();
    assert_eq!(short.query.control, LoadingControl::Load);
    let hot = parse(&GOOD.replace(HOLD, "temperature = 450")).unwrap();
    assert_eq!((hot.temperature, file.temperature), (Some(450.0), None));
}

#[test]
fn scenes_are_named_as_such() {
    let scene =
        "[material]\nyoungs_modulus = { temperature = [293], value = [7e10] }\n[asperity]\nradius = 1e-4\n";
    let error = parse(scene).unwrap_err().to_string();
    assert!(error.starts_with("surface.toml: has [asperity]: it is a scene or a request"), "{error}");
}

#[test]
fn errors_are_one_line_with_file_key_value_and_rule() {
    for (from, to, expected) in [
        (
            "pressure =",
            "presure =",
            ":7: query.presure: is not a key; did you mean pressure? known here: pressure, separation, slip_rate, hold, contact_life, interaction, nominal_size, rate_step, temperature",
        ),
        (
            "std = 0.5e-6",
            "sdt = 0.5e-6",
            ":5: surface.heights.sdt: is not a key; did you mean std? known here: distribution, std, shape, lower, upper, file",
        ),
        (
            "poisson_ratio",
            "poison_ratio",
            ":12: material.poison_ratio: is not a key; did you mean poisson_ratio? known here: youngs_modulus, poisson_ratio, yield_strength",
        ),
        ("[1e7, 1e5]", "[1e7, -1e5]", ": query.pressure[1] = -1e5: must be finite and positive (Pa)"),
        (HOLD, "temperature = -3.0", ": query.temperature = -3: must be a positive number (K)"),
        ("[0.1, 1.0]", "[]", ": query.slip_rate: must hold at least one value (m/s)"),
        (
            "pressure = [1e7, 1e5]",
            "pressure = [1e7]\nseparation = [0.0]",
            ": query.separation: cannot be given together with pressure",
        ),
        (
            "asperity_radius = 100e-6",
            "asperity_radius = 0.0",
            ": surface.asperity_radius = 0: must be a positive number (m)",
        ),
        (
            HOLD,
            "interaction = \"mean-pressure\"",
            ": query.nominal_size: is missing; interaction = \"mean-pressure\" needs the side of the square nominal area in m",
        ),
        (HOLD, "nominal_size = 0.0", ": query.nominal_size = 0: must be a positive number (m)"),
        (
            HOLD,
            "rate_step = { before = 0.1, after = 0.0 }",
            ": query.rate_step.after = 0: must be a positive number (m/s)",
        ),
        (
            HOLD,
            "rate_step = { before = 0.1, after = 1.0 }\ncontact_life = \"steady\"",
            ": query.rate_step: needs contacts that are replaced by others; give contact_life as a number, not \"steady\"",
        ),
        ("= 0.3", "= 0.5", ": material.poisson_ratio = 0.5: must be at least 0 and below 0.5"),
        (
            "\"gaussian\"",
            "\"gausian\"",
            ": surface.heights.distribution = \"gausian\": must be one of gaussian, exponential, uniform, truncated-gaussian, weibull, lognormal, inverted-chi-squared, sample, histogram (did you mean \"gaussian\"?)",
        ),
    ] {
        assert_eq!(message(from, to), format!("surface.toml{expected}"));
    }
}

#[test]
fn errors_name_their_key() {
    for (from, to, expected) in [
        ("[1e7, 1e5]", "[1e7, -1e5]", Some("query.pressure")),
        ("asperity_radius = 100e-6", "asperity_radius = 0.0", Some("surface.asperity_radius")),
        ("std = 0.5e-6", "sdt = 0.5e-6", Some("surface.heights.sdt")),
        ("[surface]", "[surface", None),
    ] {
        assert_eq!(parse(&GOOD.replace(from, to)).unwrap_err().key(), expected);
    }
}

#[test]
fn radii_may_be_distributed() {
    let radii = |line: &str, radius: &str| {
        let line = format!("{radius}\nradii = {{ {line} }}");
        parse(&GOOD.replace("asperity_radius = 100e-6", &line)).map(|file| file.surface.asperity_radius)
    };
    let mean = "asperity_radius = 100e-6";
    let found = radii("distribution = \"lognormal\", std = 30e-6", mean).unwrap();
    assert_eq!(found, Radii::log_normal(1e-4, 3e-5));
    let classes = "distribution = \"classes\", radius = [1e-5, 2e-5], share = [1.0, 1.0]";
    assert!((radii(classes, "").unwrap().mean() - 1.5e-5).abs() < 1e-18);
    for (line, radius, expected) in [
        (classes, mean, "surface.asperity_radius: follows from"),
        ("distribution = \"lognormal\", std = 3e-4", mean, "surface.radii.std = 3e-4: must not exceed"),
        ("distribution = \"lognormal\"", mean, "surface.radii.std: is missing"),
        ("distribution = \"lognormal\", std = 3e-5", "", "surface.asperity_radius: is missing"),
        ("distribution = \"classes\", radius = [1e-5]", "", "as many positive numbers"),
        ("distribution = \"gamma\"", mean, "unknown variant"),
    ] {
        let message = radii(line, radius).unwrap_err().to_string();
        assert!(message.contains(expected) && message.lines().count() == 1, "{message}");
    }
}

#[test]
fn types_syntax_and_missing_keys_are_explained() {
    let wrong_type = message("[1e7, 1e5]", "[\"many\"]");
    assert_eq!(wrong_type, "surface.toml:7: query.pressure[0]: is string \"many\", must be a number");
    let hold = message(HOLD, "hold = \"distance\"");
    assert!(hold.starts_with("surface.toml:9: query.hold: unknown variant"), "{hold}");
    let missing = message("asperity_radius = 100e-6", "");
    assert!(missing.ends_with("surface.asperity_radius: is missing"), "{missing}");
    let syntax = message("[query]", "[query");
    assert!(syntax.starts_with("surface.toml:6: "), "{syntax}");
    assert_eq!(syntax.lines().count(), 1);
}

#[test]
fn numbers_may_be_single_or_a_range() {
    let rates = |text: &str| {
        parse(&GOOD.replace("slip_rate = [0.1, 1.0]", &format!("slip_rate = {text}")))
            .map(|file| file.query.slip_rates)
    };
    assert_eq!(rates("2").unwrap(), [2.0]);
    assert_eq!(rates("0.5").unwrap(), [0.5]);
    assert_eq!(rates("{ from = 1, to = 100, points = 3 }").unwrap(), [1.0, 10.0, 100.0]);
    let linear = "{ from = 0, to = 1, points = 3, spacing = \"linear\" }";
    assert_eq!(rates(linear).unwrap(), [0.0, 0.5, 1.0]);
    for (text, expected) in [
        ("{ from = 10, to = 1 }", "query.slip_rate: to = 1.0 must be above from = 10.0"),
        ("{ from = 0, to = 1, spacing = \"log\" }", "from = 0.0 must be positive"),
        ("{ from = 1, to = 9, points = 1 }", "points = 1 must be"),
        (
            "{ from = 1, until = 9 }",
            "query.slip_rate.until: is not a key; known here: from, to, points, spacing",
        ),
        ("\"fast\"", "a number, a list such as [1, 10] or a range"),
    ] {
        let error = rates(text).unwrap_err().to_string();
        assert!(error.contains(expected) && error.contains(":8: query.slip_rate"), "{error}");
    }
}

#[test]
fn the_command_line_overrides_the_file() {
    let with = |overrides: &[&str]| {
        let overrides: Vec<Override> = overrides.iter().map(|text| text.parse().unwrap()).collect();
        SurfaceFile::parse_with(Path::new("surface.toml"), GOOD.to_owned(), &overrides)
    };
    let file = with(&["query.hold=load", "query.pressure=1e6", "surface.heights.std=1e-7"]).unwrap();
    assert_eq!(file.query.loading, NormalLoading::Pressure(vec![1e6]));
    assert_eq!(file.query.control, LoadingControl::Load);
    assert_eq!(file.surface.heights.standard_deviation(), 1e-7);
    // The text that is stored with the results is that of the surface computed.
    let again = parse(&file.text).unwrap();
    assert_eq!((again.query, again.text), (file.query, file.text));
    let separations = query_values(None, Some(&Values(vec![-1e-7])), None);
    let file = SurfaceFile::parse_with(Path::new("s.toml"), GOOD.to_owned(), &separations).unwrap();
    assert_eq!(file.query.loading, NormalLoading::Separation(vec![-1e-7]));
    for (text, expected) in [
        ("query.presure=1", "the command line: query.presure: is not a key; did you mean pressure?"),
        ("query.pressure.x=1", "surface.toml: query.pressure.x: pressure is a value, not a section"),
        ("query.pressure=-1", "the command line: query.pressure[0] = -1e0: must be finite and positive"),
    ] {
        let error = with(&[text]).unwrap_err().to_string();
        assert!(error.contains(expected), "{error}");
    }
}
