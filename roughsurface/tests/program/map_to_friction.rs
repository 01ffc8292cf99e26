//! From a topography to friction in one command, and the query on the command line.

use crate::characterize::numbers_have_units;
use crate::folder::{data, empty_folder, surface};
use roughsurface::surface::file::SurfaceFile;

fn map(name: &str) -> String {
    data(name).display().to_string()
}

const STEEL: &str = "--set material.youngs_modulus=205e9 --set material.poisson_ratio=0.29 --set material.yield_strength=792e6";

#[test]
fn one_command_does_what_two_do() {
    let folder = empty_folder();
    let map = map("map.x3p");
    let query = "--pressure 1e6,2e6 --slip-rate 0.1..10:3 --hold separation";
    let law = format!("--table model:jackson-green {STEEL} --extrapolate");
    let output = folder.done(&format!("predict {map} --cutoff 1.2um {law} {query} -o one.nc --json"));
    folder.done(&format!("characterize {map} --cutoff 1.2um -o s.toml"));
    folder.done(&format!("predict s.toml {law} {query} -o two.nc"));
    let [one, two] = ["one.nc", "two.nc"].map(|name| folder.dataset(name));
    assert_eq!(one.reals("slip_rate", &[3]).unwrap(), [0.1, 1.0, 10.0]);
    assert_eq!(one.reals("pressure", &[2]).unwrap(), [1e6, 2e6]);
    assert_eq!(one.attribute_text("hold").unwrap(), "separation");
    assert_eq!(one.reals("mu", &[2, 3]).unwrap(), two.reals("mu", &[2, 3]).unwrap());

    // Its own cut-off lies between half of it and twice of it, which are predictions of their own.
    assert_eq!(one.reals("cutoff", &[3]).unwrap(), [0.6e-6, 1.2e-6, 2.4e-6]);
    let mu = one.reals("mu_cutoff", &[3, 2, 3]).unwrap();
    assert_eq!(mu[6..12], one.reals("mu", &[2, 3]).unwrap());
    let summary = output.json();
    for (index, cutoff) in [(0, "0.6um"), (2, "2.4um")] {
        folder.done(&format!("predict {map} --cutoff {cutoff} {law} {query} -o other.nc"));
        let other = folder.dataset("other.nc");
        let (expected, found) = (other.reals("mu", &[2, 3]).unwrap(), &mu[6 * index..6 * index + 6]);
        // The surface file has seven digits.
        assert!(
            found.iter().zip(&expected).all(|(found, mu)| (found / mu - 1.0).abs() < 1e-6),
            "{found:?} {expected:?}"
        );
        let at = &summary["cutoffs"][index];
        assert_eq!(at["mu"][0]["value"].as_f64().unwrap(), found[0]);
        assert!(at["mu"][0]["error"].as_f64().unwrap() > 0.0);
        for (name, unit) in [("cutoff", "m"), ("asperity_density", "m-2"), ("asperity_radius", "m")] {
            assert_eq!(at[name]["unit"], unit, "{name}");
        }
    }
    let warnings = one.attribute_text("warnings").unwrap();
    assert!(warnings.contains("topography: "), "{warnings}");
    assert!(two.shape("mu_cutoff").is_err());
}

#[test]
fn keys_in_place_of_those_of_the_summits_hold_at_every_cutoff() {
    let folder = empty_folder();
    let map = map("map.x3p");
    let set = "--set surface.asperity_radius=1e-4 --set surface.heights.std=2e-8";
    let rest = format!("--table model:jackson-green {STEEL} {set} --pressure 1e6 --slip-rate 1");
    folder.done(&format!("predict {map} --cutoff 1.2um {rest} -o all.nc"));
    let all = folder.dataset("all.nc");
    assert_eq!(all.reals("asperity_radius_cutoff", &[3]).unwrap(), [1e-4; 3]);
    assert_eq!(all.reals("heights_std_cutoff", &[3]).unwrap(), [2e-8; 3]);
    let density = all.reals("asperity_density_cutoff", &[3]).unwrap();
    assert!(density[0] > density[1] && density[1] > density[2], "{density:?}");
    let mu = all.reals("mu_cutoff", &[3, 1, 1]).unwrap();
    for (index, cutoff) in ["0.6um", "1.2um", "2.4um"].into_iter().enumerate() {
        folder.done(&format!("predict {map} --cutoff {cutoff} {rest} -o one.nc"));
        let one = folder.dataset("one.nc");
        assert_eq!(one.reals("mu", &[1, 1]).unwrap(), mu[index..=index]);
    }
}

/// A table covers slip rates up to a limit in proportion to 1/R, and R grows with the cut-off.
#[test]
fn a_slip_rate_beyond_the_table_at_one_cutoff_leaves_the_others() {
    let folder = empty_folder();
    let map = map("map.x3p");
    let predict = |slip_rates: &str| {
        let rest = format!("--material steel-4340 --pressure 1e6 --slip-rate {slip_rates} --extrapolate");
        let output = folder.done(&format!("predict {map} --cutoff 1.6um {rest} -o f.nc"));
        (folder.dataset("f.nc"), output.stdout)
    };
    let (slow, _) = predict("1");
    let radii = slow.reals("asperity_radius_cutoff", &[3]).unwrap();
    let mu = slow.reals("mu_cutoff", &[3, 1, 1]).unwrap();
    // 10 m/s at 1 mm.
    let fast = 0.9 * 10e-3 / radii[1];
    assert!(radii[2] > 1.2 * radii[1] && mu.iter().all(|mu| mu.is_finite()), "{radii:?} {mu:?}");
    let (both, summary) = predict(&format!("1,{fast}"));
    let found = both.reals("mu_cutoff", &[3, 1, 2]).unwrap();
    assert_eq!([found[0], found[2], found[4]], mu[..]);
    assert!(found[1].is_finite() && found[3].is_finite() && found[5].is_nan(), "{found:?}");
    assert!(summary.contains("outside table"), "{summary}");
}

/// The moments of two independent faces of the same roughness are twice those of one: the summits are as many, with
/// R/√2 and √2 σ_s.
#[test]
fn two_rough_faces_slide_as_their_sum_on_a_smooth_flat() {
    let folder = empty_folder();
    let map = map("map.x3p");
    let surface = |name: &str| SurfaceFile::read(&folder.path(name)).unwrap().surface;
    folder.done(&format!("characterize {map} --cutoff 1.2um -o one.toml"));
    let both = format!("{map} --cutoff 1.2um --other-face {map}");
    let output = folder.done(&format!("characterize {both} -o two.toml --json"));
    let (one, two) = (surface("one.toml"), surface("two.toml"));
    for (ratio, expected) in [
        (two.asperity_density / one.asperity_density, 1.0),
        (two.asperity_radius.mean() / one.asperity_radius.mean(), 0.5f64.sqrt()),
        (two.heights.standard_deviation() / one.heights.standard_deviation(), 2f64.sqrt()),
    ] {
        assert!((ratio / expected - 1.0).abs() < 1e-6, "{ratio} {expected}");
    }
    assert!(folder.read("two.toml").starts_with("# Summits of map.x3p on map.x3p"));
    let result = output.json();
    let of_both = |place: &str| result.pointer(&format!("/two_faces/{place}")).unwrap().as_f64().unwrap();
    assert!((of_both("summits/radius") / two.asperity_radius.mean() - 1.0).abs() < 1e-6);
    assert_eq!(of_both("other_face/summits/radius"), result["summits"]["radius"].as_f64().unwrap());
    numbers_have_units(&result, &result["units"], "");

    let law = format!("--table model:jackson-green {STEEL} --extrapolate --pressure 1e6 --slip-rate 1");
    folder.done(&format!("predict {both} {law} -o direct.nc"));
    folder.done(&format!("predict two.toml {law} -o file.nc"));
    let [direct, file] = ["direct.nc", "file.nc"].map(|name| folder.dataset(name));
    assert_eq!(direct.reals("mu", &[1, 1]).unwrap(), file.reals("mu", &[1, 1]).unwrap());
    assert_eq!(direct.reals("cutoff", &[3]).unwrap(), [0.6e-6, 1.2e-6, 2.4e-6]);

    folder.refused(&format!("characterize {both} --summits found -o found.toml"), &["are of one face"]);
    folder.refused(
        &format!("predict two.toml --other-face {map} {law} -o f.nc"),
        &["two.toml is a surface file"],
    );
    for (other, expected) in [("missing.txt", "missing.txt"), ("two.toml", "two.toml: is a surface file")] {
        folder.refused(&format!("characterize {map} --cutoff 1.2um --other-face {other}"), &[expected]);
    }
    std::fs::copy(&map, folder.path("copy.x3p")).unwrap();
    folder.refused(&format!("characterize {map} --other-face copy.x3p -o copy.x3p"), &["--other-face"]);
}

/// Faces of two instruments: each file states its lengths or has its own options.
#[test]
fn each_face_has_its_own_unit_and_pixel() {
    let folder = empty_folder();
    let [stated, matrix] = ["map.x3p", "map-um.npy"].map(map);
    let radius = |arguments: &str| {
        let output = folder.done(&format!("characterize {arguments} --cutoff 1.6um --json"));
        let found = output.json();
        found["two_faces"]["summits"]["radius"].as_f64().unwrap()
    };
    let one = radius(&format!("{stated} --other-face {matrix} --other-unit um --other-pixel 0.2um"));
    let two = radius(&format!("{matrix} --unit um --pixel 0.2um --other-face {stated}"));
    assert!((one / two - 1.0).abs() < 1e-12, "{one} {two}");
    let lacks = format!("characterize {stated} --cutoff 1.6um --other-face {matrix}");
    folder.refused(&lacks, &["give it with --other-pixel"]);
}

#[test]
fn a_material_names_a_shipped_table() {
    let folder = empty_folder();
    let map = map("map.x3p");
    let command = format!(
        "predict {map} --cutoff 1.6um --pressure 1e6 --slip-rate 1 --extrapolate -o f.nc --plot f.svg"
    );
    let output = folder.done(&format!("{command} --material titanium-6al4v"));
    let summary = output.stdout;
    assert!(summary.contains("Influence of the cut-off of the topography:"), "{summary}");
    let file = folder.dataset("f.nc");
    assert_eq!(file.attribute_text("table").unwrap(), "titanium-6al4v");
    assert!(folder.path("f.svg").is_file());
    for (arguments, expected) in [
        ("--material brass-c26000", "known: steel-4340"),
        ("--material steel4340", "did you mean steel-4340?"),
        ("--material copper --table copper", "cannot be used with"),
        ("", "--table"),
    ] {
        folder.misused(&format!("{command} {arguments}"), &[expected]);
    }
}

#[test]
fn keys_on_the_command_line_replace_those_of_the_file() {
    let folder = empty_folder();
    let query = "pressure = [1e6, 1e7]\nslip_rate = { from = 0.1, to = 10, points = 3 }";
    folder.write("s.toml", surface(1e8, 1e-3, 4e-7, query));
    let law = format!("--table model:hertz {STEEL} --extrapolate");
    let said = folder.done(&format!("predict {} {law} --cutoff 1.6um -v -o f.nc", map("map.x3p"))).stderr;
    let expected = "note: at their defaults: query.hold = \"load\", query.contact_life = 1.0, query.interaction = \"none\", \
                    query.pressure = [1e5, 1e6, 1e7], query.slip_rate = [1e-1, 1e0, 1e1], tolerance = 1e-6\n";
    assert!(said.contains(expected), "{said}");
    let given = "--contact-life steady --slip-rate 1 --tolerance 1e-5";
    let said = folder.done(&format!("predict s.toml {law} --pressure 1e5 {given} -v -o f.nc")).stderr;
    let expected = "at their defaults: query.hold = \"load\", query.interaction = \"none\"\n";
    assert!(said.contains(expected), "{said}");
    let law = format!("{law} -q");
    folder.done(&format!(
        "predict s.toml {law} --separation -1e-7,1e-7 --set surface.heights.std=1e-7 -o f.nc"
    ));
    let file = folder.dataset("f.nc");
    assert_eq!(file.reals("separation", &[2]).unwrap(), [-1e-7, 1e-7]);
    assert_eq!(file.reals("slip_rate", &[3]).unwrap(), [0.1, 1.0, 10.0]);
    let text = file.attribute_text("surface").unwrap();
    let stored: toml::Table = text.parse().unwrap();
    assert_eq!(stored["surface"]["heights"]["std"].as_float(), Some(1e-7));
    assert_eq!(stored["material"]["youngs_modulus"].as_float(), Some(205e9));
    for (arguments, expected) in [
        ("--pressure 1e6 --separation 1e-7", "cannot be used with"),
        ("--pressure 1e7..1e5", "must be above"),
        ("--set query.presure=1", "did you mean pressure?"),
        ("--set pressure", "section.key=value"),
        (
            "--set query.pressure=1e5 --separation 0",
            "--set query.pressure: an option of the command replaces",
        ),
        ("--set query.hold=load --hold load", "leave out one of the two"),
        ("--set query.rate_step.before=0.1 --rate-step 0.1..1", "leave out one of the two"),
        ("--hold still", "[possible values: load, separation]"),
        ("--cutoff 1um", "--cutoff is for a topography; s.toml is a surface file"),
    ] {
        folder.misused(&format!("predict s.toml {law} {arguments} -o f.nc"), &[expected]);
    }
}
