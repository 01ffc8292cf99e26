//! The program from surface file and table to friction.nc: results, exit status, messages.

use crate::demonstration::{Weakening, table};
use crate::folder::{MATERIAL, folder_with, folder_with_table, surface};
use std::path::Path;

use roughsurface::friction::{Settings, predict};
use roughsurface::surface::file::SurfaceFile;
use tables::closed_forms::{NAMES, STEEL, hertz};
use tables::netcdf::DatasetWriter;
use tables::table::Table;
#[cfg(target_os = "linux")]
use tests::programs::Ended;

fn steel_surface() -> String {
    let query = "pressure = [1e5, 1e6, 1e7]\nslip_rate = [0.1, 0.3, 1.0, 3.0, 10.0]";
    surface(1e10, 1e-4, 5e-8, query) + MATERIAL
}

#[test]
fn a_table_gives_the_friction_of_the_law_it_was_made_from() {
    let folder = folder_with_table(&steel_surface());
    let law = Weakening::new();
    let output = folder.done("predict surface.toml --table table.nc -o friction.nc --plot f.svg");
    let summary = output.stdout;
    let footnotes = summary.lines().filter(|line| line.starts_with('[')).count();
    assert_eq!(summary.lines().count(), 2 + 1 + 15 + 1 + 2 + 6 + footnotes, "{summary}");
    assert!(std::fs::metadata(folder.path("f.svg")).unwrap().len() > 10_000);

    let surface = SurfaceFile::read(&folder.path("surface.toml")).unwrap();
    let settings = Settings::default();
    let exact = predict(&law, &surface.surface, &surface.query, &settings, &|_, _| ()).unwrap();
    let file = folder.dataset("friction.nc");
    let read = |name: &str| file.reals(name, &[3, 5]).unwrap();
    let (mu, mu_error) = (read("mu"), read("mu_error"));
    let (mu_static, energy, area) = (read("mu_static"), read("G_weakening"), read("real_area_fraction"));
    let separation = read("separation");
    for (i, cell) in exact.friction.iter().flatten().enumerate() {
        let off = (mu[i] - cell.sliding.mu.value).abs();
        assert!(off <= mu_error[i] && off < 5e-3 * mu[i], "mu {off} ±{}", mu_error[i]);
        // Between table points the law is known to a few parts in a thousand.
        assert!((mu_static[i] / cell.mu_static.value - 1.0).abs() < 0.01);
        assert!((area[i] / cell.sliding.area_fraction.value - 1.0).abs() < 5e-3);
        assert!((separation[i] - cell.pressed.separation.value).abs() < 1e-3 * 0.05e-6);
        assert!((energy[i] / cell.weakening_energy.value - 1.0).abs() < 0.02, "G {}", energy[i]);
        assert!(mu_static[i] > mu[i] && energy[i] > 0.0);
    }
    assert_eq!(file.attribute_text("surface").unwrap(), steel_surface());
    assert_eq!(file.attribute_text("table").unwrap(), "table.nc");
}

#[test]
fn a_table_of_several_initial_temperatures_is_read_at_that_of_the_query() {
    let folder = folder_with(&steel_surface());
    let cold = table(&Weakening::new());
    let mut hot = table(&Weakening { strength: 1.1, ..Weakening::new() });
    hot.metadata_mut().temperature = 500.0;
    hot.write(&folder.path("hot.nc")).unwrap();
    Table::new(vec![cold, hot]).unwrap().write(&folder.path("both.nc")).unwrap();
    folder.refused("predict surface.toml --table both.nc -o friction.nc", &["from 298 to 500 K"]);

    let at = |temperature: f64| {
        let text = steel_surface().replace("[query]", &format!("[query]\ntemperature = {temperature:?}"));
        folder.write("at.toml", text);
    };
    let friction = |arguments: &str| {
        folder.done(&format!("{arguments} -o friction.nc"));
        folder.dataset("friction.nc").reals("mu", &[3, 5]).unwrap()
    };
    let expected = friction("predict surface.toml --table hot.nc");
    at(500.0);
    assert_eq!(friction("predict at.toml --table both.nc"), expected);
    assert_eq!(friction("predict at.toml --table hot.nc"), expected);
    folder.done("sample at.toml --table both.nc --asperities 50 --realizations 4 -o mc.nc");
    at(400.0);
    let between = friction("predict at.toml --table both.nc");
    at(298.0);
    let cold = friction("predict at.toml --table both.nc");
    for (mu, (cold, hot)) in between.iter().zip(cold.iter().zip(&expected)) {
        assert!(*mu > cold.min(*hot) && *mu < cold.max(*hot), "{mu} {cold} {hot}");
    }
    let other = "is for an initial temperature of 500 K only, not 298 K";
    folder.refused("predict at.toml --table hot.nc -o friction.nc", &[other]);
}

#[test]
fn threads_change_nothing_and_random_surfaces_repeat() {
    let folder = folder_with(&steel_surface());
    for (command, name) in [
        ("predict surface.toml --table model:brizmer", "friction.nc"),
        ("sample surface.toml --table model:brizmer --asperities 200 --realizations 20 --seed 3", "mc.nc"),
    ] {
        let values = |threads: usize| {
            let output = folder.done(&format!("{command} -o {name} -q --threads {threads}"));
            assert!(output.stdout.is_empty() && output.stderr.is_empty());
            let file = folder.dataset(name);
            let shape: &[usize] = if name == "mc.nc" { &[3, 5, 20] } else { &[3, 5] };
            file.reals("mu", shape).unwrap()
        };
        assert_eq!(values(1), values(3));
    }
}

#[test]
fn bad_input_ends_with_status_two_and_one_line() {
    let folder = folder_with(&steel_surface());
    folder.write("typo.toml", steel_surface().replace("pressure", "presure"));
    folder.write("rigid.toml", steel_surface() + "[counterface]\n");
    folder.write("table.nc.part", "a journal");
    // 0 to 10 m/s at 1 mm, with rate law 0.01 to 10 m/s at 0.1 mm: at R the limits are in proportion to 1/R.
    let radii = |radii: &str| {
        let classes =
            format!("radii = {{ distribution = \"classes\", radius = {radii}, share = [1, 1] }}\nheights");
        let surface = steel_surface();
        let lines = surface.lines().filter(|line| !line.starts_with("asperity_radius"));
        lines.collect::<Vec<_>>().join("\n").replacen("heights", &classes, 1)
    };
    folder.write("two.toml", radii("[0.5e-3, 2e-3]"));
    folder.write("far.toml", radii("[1e-6, 1e-2]"));
    // NetCDF, but not a table.
    let mut foreign = DatasetWriter::create(&folder.path("foreign.nc"), "foreign").unwrap();
    foreign.dimension("x", 2).unwrap();
    foreign.finish().unwrap();
    for (arguments, message) in [
        ("predict typo.toml --table model:hertz -o f.nc", "did you mean pressure?"),
        ("predict none.toml --table model:hertz -o f.nc", "none.toml: cannot be read"),
        ("predict surface.toml --table model:herz -o f.nc", "kogut-etsion"),
        ("predict surface.toml --table none.nc -o f.nc", "cannot read none.nc"),
        ("predict surface.toml --table surface.toml -o f.nc", "surface.toml"),
        (
            "predict surface.toml --table table.nc.part -o f.nc",
            "is the journal of a table that is not finished",
        ),
        (
            "predict two.toml --table steel-4340 --slip-rate 7 -o f.nc -q",
            "covers 0 to 5 m/s at the radii asked",
        ),
        (
            "predict far.toml --table steel-4340-rate --slip-rate 7 -o f.nc -q",
            "no slip rate at all radii from 1e-6 to 0.01 m",
        ),
        ("predict rigid.toml --table steel-4340 -o f.nc", "[counterface] of the surface file is empty"),
        ("predict surface.toml --table foreign.nc -o f.nc", "foreign.nc"),
        ("predict surface.toml --table model:hertz -o no/f.nc", "its folder does not exist"),
        ("predict surface.toml --table model:hertz -o f.nc --plot f.gif", "must be one of svg, png, pdf"),
        ("predict surface.toml --table model:hertz -o f.nc --report no/f.html", "its folder does not exist"),
    ] {
        folder.refused(arguments, &[message]);
    }
    folder.misused("predict surface.toml", &["--output"]);
    let compared =
        folder.misused("predict surface.toml --table model:hertz -o f.nc --compare herz", &["'herz'"]);
    assert!(NAMES.iter().chain(&["all"]).all(|model| compared.contains(model)), "{compared}");
    assert!(!Path::new(&folder.path("f.nc")).exists());
}

#[test]
fn everything_asked_for_is_in_the_files() {
    let folder = folder_with_table(
        &(steel_surface() + "[uncertainty]\nheights_std = 0.005e-6\nasperity_radius = 10e-6\n"),
    );
    let output = folder.done(
        "predict surface.toml --table table.nc -o f.nc --compare kogut-etsion,jackson-green --report f.html --json",
    );
    let summary = output.json();
    let file = folder.dataset("f.nc");
    let read = |name: &str, shape: &[usize]| file.reals(name, shape).unwrap();
    // The table is of Jackson–Green spheres with their static friction.
    let models = read("mu_static_model", &[2, 3]);
    let here = read("mu_static", &[3, 5]);
    for row in 0..3 {
        assert!((models[3 + row] / here[5 * row] - 1.0).abs() < 0.05, "{row}");
    }
    let change = read("mu_parameter_change", &[3, 5, 2]);
    let std = read("mu_parameter_std", &[3, 5]);
    for (cell, std) in std.iter().enumerate() {
        let sum = change[2 * cell].hypot(change[2 * cell + 1]);
        assert!((sum - std).abs() < 1e-12 && *std > 0.0);
    }
    // Numbers of JSON come back with the rounding of their last digit.
    let in_summary = summary["friction"][4]["mu"]["parameter_std"].as_f64().unwrap();
    assert!((in_summary / std[4] - 1.0).abs() < 1e-15);
    let [elastic, plastic, melting] =
        ["elastic_fraction", "plastic_fraction", "melting_fraction"].map(|name| read(name, &[3, 5]));
    assert!((0..15).all(|cell| (elastic[cell] + plastic[cell] - 1.0).abs() < 1e-12));
    // The table states no melting temperature.
    assert!(melting.iter().all(|share| share.is_nan()));
    // These asperities weaken with the logarithm of the slip rate where they do at all.
    assert!(read("dmu_dlnV", &[3, 5]).iter().all(|slope| *slope < 0.0));
    let psi = file.attribute_real("plasticity_index").unwrap();
    let critical = hertz::critical_interference(STEEL.contact_modulus(), 0.3, 400e6, 1e-4);
    assert!((psi - (0.05e-6 / critical).sqrt()).abs() < 1e-6 * psi);
    let page = folder.read("f.html");
    for wanted in ["Models of the literature", "Standard deviations from uncertain parameters", "heights_std"]
    {
        assert!(page.contains(wanted), "{wanted}");
    }
}

#[test]
fn another_table_stands_for_a_constant_of_the_material() {
    let folder =
        folder_with_table(&(steel_surface() + "[uncertainty]\ntables = { strength = \"stronger.nc\" }\n"));
    // A tenth more of every shear stress: friction and its energies grow by as much.
    let stronger = table(&Weakening { strength: 1.1, ..Weakening::new() });
    stronger.write(&folder.path("stronger.nc")).unwrap();
    folder.done("predict surface.toml --table table.nc -o f.nc --report f.html");
    let file = folder.dataset("f.nc");
    let read = |name: &str| file.reals(name, &[3, 5]).unwrap();
    for name in ["mu", "Q", "G_weakening"] {
        for (std, value) in read(&format!("{name}_parameter_std")).iter().zip(read(name)) {
            assert!((std / value - 0.1).abs() < 1e-3, "{name}: {std} {value}");
        }
    }
    let page = folder.read("f.html");
    assert!(page.contains("<li>strength another table</li>"));
    let closed_form = "predict surface.toml --table model:hertz -o f.nc";
    folder.refused(closed_form, &["uncertainty.tables: has no meaning for a closed form"]);
}

/// The shipped tables state their constants.
#[test]
fn another_table_differs_in_one_constant() {
    let folder =
        folder_with(&steel_surface().replace("[query]", "[query]\nrate_step = { before = 0.1, after = 1 }"));
    let line = "predict surface.toml --table copper -o f.nc --set uncertainty.tables={other=\"NAME\"}";
    folder.refused(
        &format!("{} -q", line.replace("NAME", "copper")),
        &["uncertainty.tables.other: \"copper\" has the constants of the table"],
    );
    let said = folder.done(&line.replace("NAME", "steel-1045")).stderr;
    assert!(said.contains("uncertainty.tables.other differs from the table in "), "{said}");

    // Neither the other table nor the step is of a sample.
    let line = "sample surface.toml --table copper --asperities 1000 --realizations 2 -o s.nc";
    let said = folder.done(&format!("{line} --set uncertainty.heights_std=1e-9")).stderr;
    for key in ["query.rate_step", "[uncertainty]"] {
        assert!(said.contains(&format!("{key} is not used: `roughsurface predict` computes it")), "{said}");
    }
    folder.misused(&format!("{line} --rate-step 0.1..1"), &["--rate-step"]);
}

/// Names that are not UTF-8, and outputs that are links: the files appear at the targets of the links.
#[cfg(target_os = "linux")]
#[test]
fn names_may_be_anything_and_links_are_followed() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;

    let folder = folder_with(&steel_surface());
    let odd = folder.path(OsStr::from_bytes(b"a folder \xff"));
    std::fs::create_dir_all(&odd).unwrap();
    let [surface, output] =
        [&b"surface \xff.toml"[..], b"friction \xfe.nc"].map(|name| odd.join(OsStr::from_bytes(name)));
    std::fs::rename(folder.path("surface.toml"), &surface).unwrap();
    std::os::unix::fs::symlink("elsewhere.nc", &output).unwrap();
    std::os::unix::fs::symlink("elsewhere.html", odd.join("report.html")).unwrap();
    let run = |output: &Path| {
        let mut command = folder.command("predict --table model:hertz --extrapolate");
        command.arg(&surface).arg("-o").arg(output).arg("--report").arg(odd.join("report.html"));
        Ended::of(&mut command)
    };
    run(&output).with_status(0);
    for (link, target) in [(output, "elsewhere.nc"), (odd.join("report.html"), "elsewhere.html")] {
        assert!(link.is_symlink() && odd.join(target).is_file(), "{}", target);
    }
    let _socket = std::os::unix::net::UnixListener::bind(odd.join("socket.nc")).unwrap();
    let refused = run(&odd.join("socket.nc")).with_status(2);
    assert!(refused.stderr.contains("it is not a regular file"));
}

/// Of the panels that the option names, those that this figure will not have are refused at once.
#[test]
fn a_panel_is_refused_before_the_computation_or_drawn() {
    let folder = folder_with_table(&steel_surface());
    let predict = "predict surface.toml -o friction.nc --plot f.svg";
    let panels = "rate, friction, static, slide, area, separation, load, regimes";
    for (arguments, found) in [
        ("--table copper --panel step", format!("no panel step: it has {panels}, temperature")),
        ("--table table.nc --panel temperature", format!("no panel temperature: it has {panels}")),
        ("--table model:hertz --compare all --panel temperature", format!("it has {panels}, models")),
    ] {
        folder.refused(&format!("{predict} {arguments}"), &[&found]);
        assert!(!folder.path("friction.nc").exists());
    }
    let asked = "--panel load --panel temperature --pressure 1e5,1e6 -q";
    folder.done(&format!("{predict} --table copper {asked}"));
    let figure = folder.read("f.svg");
    assert!(figure.contains("panel load") && figure.contains("panel temperature"));
    folder.done(&format!("{predict} --table table.nc --panel rate --pressure 1e5,1e6 -q"));
    let figure = folder.read("f.svg");
    assert!(figure.contains("1e5 Pa"));
    assert!(!figure.contains("100000 Pa"));
}
