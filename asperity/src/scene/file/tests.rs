//! Accepted and refused input, and the messages.

use tables::refinement::Goal;

use super::*;
use crate::scene::tests::{assert_written_is_read, parse, request};
use crate::scene::{Hardening, Property, Softening, TemperatureTable};

const COMPLETE: &str = r#"
[material]
youngs_modulus = 200e9
poisson_ratio = 0.3
yield_strength = 400e6
hardening = { law = "none" }
density = 7850.0
specific_heat = 475.0
thermal_conductivity = 45.0
thermal_expansion = 1.2e-5
softening = { law = "johnson-cook", reference = 298.0, melting = 1793.0, exponent = 1.0 }

[asperity]
radius = 1e-3

[interface]
law = "shear-strength"
strength_factor = 1.0
heat_partition = 0.5
gap_conductance = 0.0
taylor_quinney = 0.9
[loading]
interference = 20.0
slip_rate = 1.0
slip_distance = 2.0
control = "interference"
temperature = 298.0
[model]
heat = "auto"
kinematics = "auto"
[numerics]
accuracy = 0.02
elements_per_radius = 16
sectors = 16
"#;

const SHORT: &str = r#"
[material]
preset = "steel-4340"
[asperity]
radius = 1e-3
[loading]
interference = 20
slip_rate = 1
"#;

const REQUEST: &str = r#"
[material]
preset = "copper"
[asperity]
radius = 1e-4
[table]
interference = { from = 0.1, to = 100, points = 4, spacing = "log" }
slip_rate = [0.0, 0.1, 10]
"#;

fn scene_with(overrides: &[&str]) -> Result<Scene, String> {
    parse(COMPLETE, overrides)
}

fn request_with(overrides: &[&str]) -> Result<Request, String> {
    request(REQUEST, overrides)
}

fn assert_written_request_is_read(request: &Request) {
    assert_eq!(self::request(&write_request(request), &[]).as_ref(), Ok(request));
}

/// The message, which must be one line with all of `parts`.
fn refused(overrides: &[&str], parts: &[&str]) {
    let message = scene_with(overrides).expect_err(overrides[0]);
    assert!(!message.contains('\n'), "{message}");
    for part in parts {
        assert!(message.contains(part), "{message} lacks {part}");
    }
}

#[test]
fn defaults_are_those_of_the_documentation() {
    let short = parse(SHORT, &[]).unwrap();
    let complete = scene_with(&[]).unwrap();
    assert_eq!(short.interface, complete.interface);
    assert_eq!(short.loading, complete.loading);
    assert_eq!(short.model, complete.model);
    assert_eq!(short.numerics.accuracy, complete.numerics.accuracy);
    assert_eq!(short.numerics.elements_per_radius, None);
    assert_eq!(short.numerics.sectors, None);
}

#[test]
fn keys_override_the_preset_and_set_overrides_the_file() {
    let text = SHORT.replace("steel-4340\"", "steel-4340\"\nyield_strength = 5e8");
    let changes = ["material.hardening.exponent=0.3", "material.softening={law=\"none\"}"];
    let scene = parse(&text, &changes).unwrap();
    assert_eq!(scene.material.yield_strength, 5e8);
    assert_eq!(scene.material.youngs_modulus, 205e9.into());
    let expected = Hardening::JohnsonCook { modulus: 510e6, exponent: 0.3 };
    assert_eq!(scene.material.hardening, expected);
    assert_eq!(scene.material.softening, Softening::None);
}

#[test]
fn written_scene_reads_back_the_same() {
    let cases: [&[&str]; 14] = [
        &[],
        &["material.hardening={law=\"linear\", modulus=1.234567890123e9}"],
        &["material.hardening={law=\"johnson-cook\", modulus=510e6, exponent=0.26}"],
        &["material.hardening={law=\"table\", plastic_strain=[0, 0.1, 1], factor=[1, 1.1, 1.3]}"],
        &["material.softening={law=\"table\", temperature=[293, 1473], factor=[1, 0]}"],
        &["interface.law=coulomb", "interface.friction=0.1", "interface.cap=false"],
        &[
            "interface.law=briscoe-tabor",
            "interface.film_strength=1e8",
            "interface.pressure_coefficient=0.05",
            "interface.film_softening={law=\"table\", temperature=[300, 500], factor=[1, 0.2]}",
        ],
        &["interface.law=full-stick", "loading.control=load", "model.kinematics=finite"],
        &["interface.law=frictionless", "asperity.radius=1e-8", "model.heat=off"],
        &["interface.strength=current"],
        &["material.shear_fracture_energy=500"],
        &["material.fracture_toughness_mode_ii=50e6"],
        &["material.tensile_strength=1e9", "material.uniform_elongation=0.1"],
        &[
            "material.youngs_modulus={temperature=[293, 1473], value=[210e9, 5e9]}",
            "material.thermal_conductivity={temperature=[293, 1073, 1073], value=[53.3, 27.4, 27.3]}",
        ],
    ];
    for overrides in cases {
        assert_written_is_read(&scene_with(overrides).unwrap());
    }
    assert_written_is_read(&parse(SHORT, &[]).unwrap());
}

#[test]
fn ranges_are_spaced_as_asked() {
    let request = request_with(&[]).unwrap();
    let expected = [0.1, 1.0, 10.0, 100.0];
    for (value, expected) in request.interferences.iter().zip(expected) {
        assert!((value / expected - 1.0).abs() < 1e-14);
    }
    assert_eq!(request.interferences.len(), 4);
    assert_eq!(request.slip_rates, [0.0, 0.1, 10.0]);
    assert_eq!(request.interferences[3], 100.0);
    assert_written_request_is_read(&request);
    let linear = "table.slip_rate={from=0, to=2, points=3, spacing=\"linear\"}";
    assert_eq!(request_with(&[linear]).unwrap().slip_rates, [0.0, 1.0, 2.0]);
    let request = request_with(&["table.tolerance=0.02", "table.max_cells=60"]).unwrap();
    assert_eq!(request.goal, Some(Goal { tolerance: 0.02, most_cells: 60 }));
    assert_written_request_is_read(&request);
    let few = request_with(&["table.tolerance=0.02", "table.max_cells=11"]);
    assert!(few.unwrap_err().contains("from 12 to"));
    assert_eq!(request_with(&["table.slip_rate=1"]).unwrap().slip_rates, [1.0]);
}

#[test]
fn initial_temperatures_are_read_and_written() {
    let request = request_with(&["table.temperature=[298, 500, 700.5]"]).unwrap();
    assert_eq!(request.temperatures, [298.0, 500.0, 700.5]);
    assert_written_request_is_read(&request);
    let templates = request.templates();
    assert_eq!(templates.len(), 3);
    assert_eq!(templates[0], request.template);
    assert_eq!(templates[2], request.template.at_temperature(700.5));
    let hot = request.at_temperature(500.0);
    assert_eq!((hot.template.loading.temperature, hot.temperatures.len()), (500.0, 0));
    // Written out for its temperature it is the same request.
    assert_written_request_is_read(&hot);
    let request = request_with(&["table.temperature={from=300, to=700, points=3}"]).unwrap();
    assert_eq!(request.temperatures, [300.0, 500.0, 700.0]);
    let without = request_with(&[]).unwrap();
    assert!(without.temperatures.is_empty() && !write_request(&without).contains("[table]\ntemperature"));
    assert_eq!(without.templates(), [without.template]);
}

#[test]
fn bad_requests_are_refused() {
    let cases = [
        ("table.temperature=[500, 300]", "rises"),
        ("table.temperature=[0, 300]", "positive"),
        ("table.temperature=500", "loading.temperature"),
        (
            "table.temperature=[300, 2000]",
            "table.temperature = 2000.0: must be below material.softening.melting",
        ),
        ("table.interference=[]", "not empty"),
        ("table.interference=[1, 1]", "rises"),
        ("table.interference=[2, 1]", "rises"),
        ("table.interference=[0, 1]", "positive"),
        ("table.slip_rate=[-1]", "zero or a positive"),
        ("table.slip_rate=[nan]", "zero or a positive"),
        ("table.tolerance=0", "from 1e-6 to 0.5"),
        ("table.max_cells=100", "left out unless tolerance is given"),
        ("table.interference={from=0, to=1, points=3}", "positive"),
        ("table.interference={from=2, to=1, points=3}", "above from"),
        ("table.interference={from=1, to=2, points=1}", "from 2 to"),
        ("table.interference={from=1, to=2}", "points is missing"),
        ("table.interference={from=1, to=2, points=2, spacing=\"sqrt\"}", "\"log\""),
        ("loading.slip_rate=1", "table.slip_rate"),
        ("table.interferance=[1]", "did you mean interference?"),
        ("model.heat=on", "slip rate is 0"),
    ];
    for (text, part) in cases {
        let error = request_with(&[text]).unwrap_err();
        assert!(error.contains(part), "{error} lacks {part}");
    }
    let both = ["table.temperature=[300, 500]", "table.tolerance=0.1"];
    let error = request_with(&both).unwrap_err();
    assert!(error.contains("table.tolerance = 0.1") && error.contains("table.temperature"), "{error}");
    let soft = [
        "table.temperature=[300, 500]",
        "material.softening={law=\"table\", temperature=[300, 400], factor=[1, 0]}",
        "loading.temperature=300",
    ];
    let error = request_with(&soft).unwrap_err();
    assert!(error.contains("table.temperature = 500.0") && error.contains("factor is above 0"), "{error}");
    assert!(request(SHORT, &[]).unwrap_err().contains("table"));
    let error = parse(REQUEST, &[]).unwrap_err();
    assert!(error.contains("asperity tabulate"), "{error}");
}

#[test]
fn numbers_out_of_range_are_refused() {
    for key in [
        "material.youngs_modulus",
        "material.yield_strength",
        "material.density",
        "material.specific_heat",
        "material.thermal_conductivity",
        "asperity.radius",
        "interface.strength_factor",
        "loading.interference",
        "loading.temperature",
    ] {
        for value in ["0", "-1.0", "nan", "inf", "-inf", "text", "[1]", "true"] {
            refused(&[&format!("{key}={value}")], &[key, value, "a positive number", "--set"]);
        }
    }
    for value in ["0.5", "-0.1", "nan", "0.7"] {
        refused(&[&format!("material.poisson_ratio={value}")], &["material.poisson_ratio", "less than 0.5"]);
    }
    for value in ["0", "0.01", "11"] {
        let text = format!("material.hardening={{law=\"johnson-cook\", modulus=5e8, exponent={value}}}");
        refused(&[&text], &["material.hardening.exponent", "0.02 to 10"]);
    }
    // In few digits.
    for value in ["0.0", "0.6", "-0.1", "nan", "1e-150"] {
        let said = format!("numerics.accuracy = {value}: must be a number from 1e-6 to 0.5");
        refused(&[&format!("numerics.accuracy={value}")], &[&said]);
    }
    for value in ["0", "3", "-8", "8.5", "1000000000"] {
        refused(&[&format!("numerics.elements_per_radius={value}")], &["a whole number from 4"]);
    }
    for value in ["0", "2", "6", "-4", "16.0"] {
        refused(&[&format!("numerics.sectors={value}")], &["a multiple of 4"]);
    }
    for value in ["-1", "1e15"] {
        let allowed = "a number from 0 to 10000 (contact radii), or \"steady\"";
        refused(&[&format!("loading.slip_distance={value}")], &["loading.slip_distance", value, allowed]);
    }
    refused(&["loading.slip_rate=-1"], &["loading.slip_rate", "-1", "zero or a positive"]);
    refused(&["loading.slip_rate=1e200"], &["= 1e200: must be zero or a positive number up to 1e6 (m/s"]);
    let steps = "loading.steps=[{ slip_rate = -1e200, slip_distance = 1 }]";
    refused(&[steps], &["must be a number from -1e6 to 1e6 other than 0 (m/s)"]);
    refused(&["asperity.radius=1e-200"], &["= 1e-200: must be a positive number from 1e-15 to 1e15 (m)"]);
    refused(&["interface.heat_partition=1.1"], &["from 0 to 1"]);
    refused(&["interface.gap_conductance=-1"], &["gap_conductance"]);
    refused(&["loading.temperature=1800"], &["loading.temperature", "1793.0 K"]);
    refused(&["material.yield_strength=400e9"], &["below youngs_modulus"]);
    refused(&["material.youngs_modulus=205"], &["below youngs_modulus", "if it is in GPa, write 2.05e11"]);
    refused(&["model.heat=on", "loading.slip_rate=0"], &["model.heat", "isothermal"]);
}

#[test]
fn laws_are_checked_with_their_keys() {
    refused(&["interface.law=friction"], &["\"shear-strength\"", "\"coulomb\""]);
    refused(&["interface.strength=flow"], &["interface.strength", "\"initial\"", "\"current\""]);
    refused(&["interface.friction=0.3"], &["interface.friction", "coulomb"]);
    refused(&["material.hardening={law=\"cubic\"}"], &["material.hardening.law", "\"linear\""]);
    refused(&["material.hardening=none"], &["material.hardening", "\"none\""]);
    // The law is what is wrong, not the key that it would have.
    refused(&["interface.law=columb", "interface.friction=0.2"], &["interface.law", "one of"]);
    refused(&["material.hardening={modulus=1e9}"], &["material.hardening.law is missing"]);
    refused(
        &["material.hardening.modulus=1e9"],
        &[
            "material.hardening.modulus = 1000000000.0",
            "left out unless law = \"linear\" or law = \"johnson-cook\"",
        ],
    );
    refused(&["material.hardening={law=\"linear\", modulus=-1}"], &["material.hardening.modulus", "-1"]);
    refused(&["material.hardening={law=\"linear\", module=1}"], &["did you mean modulus?"]);
    refused(
        &["material.hardening={law=\"table\", plastic_strain=[0, 0.1], factor=[1]}"],
        &["as long as plastic_strain"],
    );
    refused(
        &["material.hardening={law=\"table\", plastic_strain=[0.1, 0.2], factor=[1, 1]}"],
        &["starts at plastic strain 0"],
    );
    refused(&["material.softening={law=\"table\", temperature=[300, 200], factor=[1, 0]}"], &["rises"]);
    refused(&["material.softening={law=\"table\", temperature=[], factor=[]}"], &["not empty"]);
    refused(&["material.softening.melting=200"], &["material.softening.melting", "above reference"]);
}

#[test]
fn properties_may_be_tables_over_temperature() {
    let table = "material.specific_heat={temperature=[198, 398], value=[400, 500]}";
    let scene = scene_with(&[table]).unwrap();
    let expected = TemperatureTable { temperature: vec![198.0, 398.0], value: vec![400.0, 500.0] };
    // The value at the initial temperature of 298 K.
    assert_eq!(scene.material.specific_heat, Property { value: 450.0, table: Some(expected) });
    assert_eq!(scene.material.youngs_modulus.table, None);
    // A number replaces the table of a preset.
    let short = SHORT.replace("steel-4340\"", "carbon-steel-en1993\"\nspecific_heat = 450.0");
    let scene = parse(&short, &[]).unwrap();
    assert_eq!(scene.material.specific_heat, 450.0.into());
    assert!(scene.material.thermal_conductivity.table.is_some());

    let key = "material.specific_heat";
    let refuse = |table: &str, parts: &[&str]| refused(&[&format!("{key}={table}")], parts);
    refuse("{temperature=[300, 200], value=[1, 2]}", &["specific_heat.temperature", "300", "does not fall"]);
    refuse("{temperature=[3, 3, 3], value=[1, 2, 3]}", &["specific_heat.temperature", "a jump"]);
    refuse("{temperature=[300, 400], value=[1]}", &["specific_heat.value", "as long as temperature (2)"]);
    refuse("{temperature=[300, 400], value=[1, -2]}", &["specific_heat.value", "-2", "J/(kg K)"]);
    refuse("{temperature=[], value=[]}", &["specific_heat.temperature", "not empty"]);
    refuse("{temperature=[300]}", &["specific_heat.value is missing"]);
    refuse("{temperatures=[300], value=[1]}", &["did you mean temperature?"]);
    refuse("-5", &["-5", "a positive number (J/(kg K)), or { temperature"]);
    refused(
        &["material.softening={law=\"table\", temperature=[200, 290], factor=[1, 0]}"],
        &["loading.temperature", "material.softening.factor"],
    );
}

#[test]
fn fracture_data_are_given_in_one_way() {
    let two = ["material.shear_fracture_energy=5", "material.tensile_strength=1e9"];
    refused(&two, &["material.tensile_strength", "left out where shear_fracture_energy is given"]);
    refused(&["material.tensile_strength=1e9"], &["material.uniform_elongation is missing"]);
    refused(&["material.uniform_elongation=0.1"], &["uniform_elongation", "together with tensile_strength"]);
    refused(&["material.fracture_toughness_mode_ii=-1"], &["mode_ii", "-1", "Pa sqrt(m)"]);
    refused(&["material.shear_fracture_energy=0"], &["shear_fracture_energy", "a positive number (J/m2)"]);
}

#[test]
fn unknown_names_get_the_nearest_known_one() {
    refused(
        &["material.youngs_module=1"],
        &["unknown key material.youngs_module", "did you mean youngs_modulus?"],
    );
    refused(&["materials.density=1"], &["unknown key materials", "did you mean material?"]);
    refused(&["material.preset=steel4340"], &["did you mean steel-4340?"]);
    refused(&["material.melting=1500"], &["did you mean material.softening.melting?"]);
    refused(&["loading.friction=0.3"], &["unknown key loading.friction", "did you mean interface.friction?"]);
    // A section without laws; and one whose law is unknown, with a key of that.
    refused(&["loading.law=\"coulomb\"", "loading.steps=3"], &["unknown key loading.law"]);
    refused(&["material.softening={law=\"linear\", slope=1e-3}"], &["material.softening", "johnson-cook"]);
}

#[test]
fn errors_of_the_file_name_the_file_and_the_line() {
    let message = |text: &str| parse_scene(text, "a/scene.toml", &[]).unwrap_err().to_string();
    assert!(message("[material\n").starts_with("a/scene.toml: line 1:"));
    assert!(message("[material]\ndensity = = 3\n").starts_with("a/scene.toml: line 2:"));
    assert!(message("density = 3\n").contains("a section"));
    let missing = message("[asperity]\nradius = 1e-3\n");
    assert!(missing.contains("youngs_modulus") && missing.contains("steel-4340"), "{missing}");
    let negative = COMPLETE.replace("density = 7850.0", "density = -7850.0");
    assert!(message(&negative).starts_with("a/scene.toml: line 7: material.density = -7850.0: must be"));
    // A value of the preset has no line.
    let soft = SHORT.replace("steel-4340\"", "steel-4340\"\nyoungs_modulus = 1e8");
    assert!(message(&soft).starts_with("a/scene.toml: material.yield_strength = 792000000.0: must be below"));
    let unreadable = read_scene(Path::new("does/not/exist.toml"), &[]).unwrap_err();
    assert!(unreadable.to_string().starts_with("does/not/exist.toml: cannot be read"));
}
