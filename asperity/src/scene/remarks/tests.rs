use crate::scene::tests::{of_preset, parse, request, sphere};
use tables::numbers::{plain, rounded};

/// Brass from seven constants.
const BRASS: &str = "[material]\nyoungs_modulus = 105e9\npoisson_ratio = 0.34\nyield_strength = 300e6\n\
                     thermal_conductivity = 120\nspecific_heat = 380\ndensity = 8500\nthermal_expansion = 2e-5\n\
                     [asperity]\nradius = 50e-6\n[loading]\ninterference = 10\nslip_rate = 2\n";

fn scene_with(overrides: &[&str]) -> super::Scene {
    parse(BRASS, overrides).unwrap()
}

fn remarks(overrides: &[&str]) -> Vec<String> {
    scene_with(overrides).remarks()
}

const HARDENS: &str = "material.hardening={law=\"linear\", modulus=1e9}";

/// Remarks about a material that hardens.
fn remarks_hardened(overrides: &[&str]) -> Vec<String> {
    remarks(&[&[HARDENS], overrides].concat())
}

/// The only remark, which has these words.
fn only(mut said: Vec<String>, words: &str) -> String {
    assert!(said.len() == 1 && said[0].contains(words), "{words}: {said:?}");
    said.remove(0)
}

#[test]
fn a_material_without_hardening_draws_the_hardening_line_to_give() {
    let said = only(remarks(&[]), "does not harden");
    let (_, line) = said.split_once("hardening = ").unwrap();
    let (line, _) = line.split_once(" (Pa").unwrap();
    for cure in [
        &*format!("material.hardening={line}"),
        "interface.strength_factor=0.9",
        "interface.law=frictionless",
    ] {
        assert_eq!(remarks(&[cure]), Vec::<String>::new(), "{cure}");
    }
    assert_eq!(remarks(&["interface.law=full-stick"]).len(), 1);
}

#[test]
fn a_counterface_without_thermal_constants_is_said_to_be_isothermal() {
    let elastic = ["counterface.youngs_modulus=2e11", "counterface.poisson_ratio=0.3"];
    only(remarks_hardened(&elastic), "heat_partition = 0.5 of the frictional heat");
    let conducts =
        ["counterface.thermal_conductivity=40", "counterface.density=8e3", "counterface.specific_heat=500"];
    for cure in [&["loading.slip_rate=0"][..], &["model.heat=off"], &conducts] {
        assert_eq!(remarks_hardened(&[&elastic[..], cure].concat()), Vec::<String>::new(), "{cure:?}");
    }
}

/// R = 50 µm, ω_c = 2.2 nm: at 0.15 ω_c the load is 6.6 µN by Hertz, the pull-off force 15.7 µN.
#[test]
fn contacts_smaller_than_atoms_or_pressed_by_adhesion_are_named() {
    only(remarks_hardened(&["loading.interference=0.1"]), "below the distance between atoms");
    let said = only(remarks_hardened(&["loading.interference=0.15"]), "the load, about 6.");
    assert!(said.contains(" N, is below the pull-off force 2 pi w R = 1.6e-5 N"), "{said}");
    assert_eq!(remarks_hardened(&["loading.interference=1"]), Vec::<String>::new());
    let of_load = |load: &str| {
        let text = BRASS.replace("interference = 10", load);
        parse(&text, &[HARDENS]).unwrap().remarks()
    };
    only(of_load("load = 1.5e-5"), "the load, about 1.5e-5 N, is below the pull-off force");
    assert_eq!(of_load("load = 1.6e-5"), Vec::<String>::new());
}

#[test]
fn an_interference_in_metres_is_converted() {
    let of = |interference: &str| remarks_hardened(&[&format!("loading.interference={interference}")]);
    let scene = scene_with(&[]);
    let critical = scene.material.elastic_plastic().critical_interference(scene.radius);
    let said = of("2e-6");
    let expected = plain(rounded(2e-6 / critical, 3));
    assert!(said.len() == 2 && said[1].ends_with(&format!("is in metres, write {expected}")), "{said:?}");
    only(of("1e-3"), "below the distance between atoms");
}

#[test]
fn a_material_that_never_yields_is_named() {
    let of = |strength: &str| remarks_hardened(&[&format!("material.yield_strength={strength}")]);
    only(of("50e9"), "it stays elastic");
    assert_eq!(of("900e6"), Vec::<String>::new());
}

#[test]
fn a_counterface_that_yields_first_is_named() {
    let hard = "material.yield_strength=900e6";
    // 792 MPa; 862 MPa and a conductivity over temperature.
    for preset in ["steel-4340", "titanium-6al4v"] {
        let counterface = format!("counterface.preset={preset}");
        let said =
            only(remarks_hardened(&[hard, &counterface, "counterface.elastic=false"]), "before the asperity");
        assert!(said.contains(preset), "{said}");
        assert_eq!(remarks_hardened(&[&counterface]), Vec::<String>::new());
        assert_eq!(remarks_hardened(&[hard, &counterface, "counterface.density=5e3"]), Vec::<String>::new());
    }
}

#[test]
fn values_without_effect_are_named() {
    for law in ["full-stick", "frictionless"] {
        let said = remarks_hardened(&[&format!("interface.law={law}"), "interface.strength_factor=0.9"]);
        only(said, "strength_factor = 0.9 has no effect");
    }
    let capped = remarks_hardened(&["interface.law=coulomb", "interface.strength_factor=0.9"]);
    assert_eq!(capped, Vec::<String>::new());
    let beside = ["counterface.preset=steel-4340", "interface.heat_partition=0.3"];
    only(remarks_hardened(&beside), "heat_partition = 0.3 has no effect");
    let resistance = [&beside[..], &["counterface.contact_conductance=1e6"]].concat();
    assert_eq!(remarks_hardened(&resistance), Vec::<String>::new());
    let defaults = |more: &[&str]| scene_with(more).defaults_in_effect().join("\n");
    assert!(defaults(&[]).contains("interface.heat_partition"));
    assert!(!defaults(&beside[..1]).contains("interface.heat_partition"));
}

/// Those of a preset are of its reference temperature; own ones may be of any, which is asked.
#[test]
fn constants_of_a_preset_at_another_temperature_are_noticed() {
    let own = [
        "material.softening={law=\"johnson-cook\", reference=298, melting=1200, exponent=1}",
        "loading.temperature=700",
        "interface.strength_factor=0.9",
    ];
    let found = only(remarks(&own), "= 700 K, where the softening");
    // (1200 - 700)/(1200 - 298) of the yield strength.
    let strength = scene_with(&own).material.yield_strength * 500.0 / 902.0;
    let strength = format!("write yield_strength = {}", plain(rounded(strength, 3)));
    assert!(found.ends_with(&strength), "{found}");
    // Hardening softens alike.
    let hardening = "material.hardening={law=\"linear\", modulus=902e6}";
    let found = remarks(&[&own[..], &[hardening]].concat());
    assert!(found[0].ends_with(&format!("{strength} and hardening.modulus = 5e8")), "{found:?}");
    let said = |set: &[&str]| of_preset("copper", set).remarks();
    assert!(
        said(&["loading.temperature=700"])[0].contains("that of the preset \"copper\", holds where it is 1")
    );
    assert_eq!(said(&["loading.temperature=298"]), Vec::<String>::new());
    assert!(
        said(&["loading.temperature=700", "material.yield_strength=70e6"])[0]
            .contains("if 7e7 Pa is the strength where the factor is 1, write")
    );
    only(said(&["loading.temperature=200"]), "if it is in degrees Celsius, write 473.15");
    let table = sphere("copper") + "[table]\ntemperature = [200, 298]\n";
    let cold = request(&table, &[]).unwrap().remarks();
    assert!(cold.iter().any(|said| said.starts_with("table.temperature = 200 K is far below")), "{cold:?}");
    let held = request(&table, &["loading.control=load"]).unwrap().remarks();
    assert!(held.iter().any(|said| said.contains("`roughsurface` refuses such a table")), "{held:?}");
    // What the remark says, done, is enough.
    let mut copper = of_preset("copper", &["loading.temperature=700"]).material;
    let factor = copper.softening.factor(700.0);
    let here = |constant: f64| rounded(factor * constant, 3);
    let strength = format!("material.yield_strength={:e}", here(copper.yield_strength));
    let modulus = format!("material.hardening.modulus={:e}", here(*copper.hardening.modulus_mut().unwrap()));
    assert_eq!(said(&["loading.temperature=700", &strength, &modulus]), Vec::<String>::new());
    assert_eq!(said(&["loading.temperature=700", &strength]).len(), 1);
}

/// An engineering tensile strength is that at the largest load.
#[test]
fn a_tensile_strength_below_yield_is_noticed() {
    let of = |strength: &str| {
        let tensile = format!("material.tensile_strength={strength}");
        remarks_hardened(&[&tensile, "material.uniform_elongation=0.2"])
    };
    assert_eq!(of("400e6"), Vec::<String>::new());
    only(of("200e6"), "below yield_strength = 3e8 Pa");
}

/// Plateau of the hardening, and plastic strains up to which shear localises.
#[test]
fn shear_localises_where_the_body_does_not_harden() {
    let table = "material.hardening={ law = \"table\", plastic_strain = [0, 0.01, 0.02, 0.1], factor = [1, 1, 1, 1.2] }";
    for (set, plateau) in [
        (vec![], f64::INFINITY),
        (vec![table], 0.02),
        // It falls and recovers; 1 % is no hardening.
        (
            vec![
                "material.hardening={ law = \"table\", plastic_strain = [0, 0.01, 0.03, 0.1], factor = [1, 0.9, 1.01, 1.2] }",
            ],
            0.03,
        ),
        (vec![HARDENS], 0.0),
        (vec![HARDENS, "interface.strength=current"], 0.0),
    ] {
        let scene = scene_with(&set);
        assert_eq!(scene.material.hardening.plateau(), plateau, "{set:?}");
        let localises = |strain| scene.localised_shear(strain).is_some();
        let grows = set.len() == 2;
        assert_eq!(
            [0.0, 0.015, 0.5].map(localises),
            [false, plateau > 0.015 || grows, plateau > 0.5 || grows]
        );
    }
    assert!(scene_with(&["interface.strength_factor=0.9"]).localised_shear(0.01).is_none());
    let friction = |set: &[&str]| scene_with(set).localised_shear(0.001).map(|bounds| bounds.friction);
    assert!(friction(&[]) < friction(&[HARDENS, "interface.strength=current"]));
}

/// A film of 10 GPa with the strength of the metal as its limit is that strength; Coulomb's law reaches it where the
/// pressure is high enough.
#[test]
fn other_laws_are_as_strong_as_the_body_where_their_limit_is() {
    let strong = |law: &[String], interference: f64| {
        let law = law.iter().map(String::as_str);
        let at = format!("loading.interference={interference}");
        scene_with(&law.chain([&*at]).collect::<Vec<_>>()).interface_as_strong()
    };
    let film = |strength: &str| {
        ["interface.law=briscoe-tabor".into(), format!("interface.film_strength={strength}")]
    };
    let coulomb =
        |friction: f64| ["interface.law=coulomb".to_owned(), format!("interface.friction={friction}")];
    assert!(strong(&film("1e10"), 1.0) && !strong(&film("1e7"), 1.0));
    // At first yield p0 is 1.6 and in a deep contact 3 times the yield strength: 1/sqrt(3) of it at 0.36 and 0.19.
    for (friction, interference, expected) in
        [(0.33, 1.0, false), (0.37, 1.0, true), (0.3, 0.5, false), (0.3, 100.0, true), (0.18, 100.0, false)]
    {
        assert_eq!(strong(&coulomb(friction), interference), expected, "{friction} at {interference}");
    }
}

#[test]
fn values_in_another_unit_are_named() {
    let said = remarks(&["material.density=8.5", "loading.temperature=25", "interface.strength_factor=0.9"]);
    assert_eq!(said.len(), 2, "{said:?}");
    assert!(said[0].contains("g/cm3") && said[1].contains("degrees Celsius"), "{said:?}");
}

#[test]
fn presets_are_plausible_and_their_hardening_spans_the_suggested_one() {
    let mut ratios = Vec::new();
    for name in crate::scene::presets::names() {
        let scene = of_preset(name, &[]);
        let said = scene.remarks();
        assert!(!said.iter().any(|said| said.contains("implausible")), "{name}: {said:?}");
        if let crate::scene::Hardening::JohnsonCook { modulus, .. } = scene.material.hardening {
            ratios.push(modulus / scene.material.yield_strength);
        }
    }
    assert!(ratios.iter().any(|ratio| *ratio < super::MODULUS_SUGGESTED));
    assert!(ratios.iter().any(|ratio| *ratio > super::MODULUS_SUGGESTED));
}
