//! Contacts beyond the model, and signals.

use crate::demonstration::{Weakening, table};
use crate::folder::{MATERIAL, folder_with, surface};
use tests::folder::Folder;

/// Summits as sharp as the last interference asks for: the radius is 1 µm. `loading` is a line of the query.
fn sharp(loading: &str) -> Folder {
    folder_with(&(surface(1e10, 1e-6, 1e-7, &format!("{loading}\nslip_rate = 1.0")) + MATERIAL))
}

#[test]
fn no_closed_form_is_taken_to_an_indentation_of_a_thousand_radii() {
    let folder = sharp("separation = -1e-3");
    for name in tables::closed_forms::NAMES {
        let predict = format!("predict surface.toml --table model:{name} -o f.nc");
        folder.refused(&format!("{predict} -q"), &["above 0.4 of their radius"]);
        let beyond = "% of the nominal area; the model of separate asperities ends";
        folder.misused(&format!("{predict} --extrapolate"), &[beyond]);
    }
    assert!(!folder.path("f.nc").exists());
}

/// Slides at held load are no response of a summit, whose interference is that of the surface.
#[test]
fn a_table_of_slides_at_held_load_is_refused() {
    let folder = sharp("pressure = 1e5");
    let mut held = table(&Weakening::new());
    held.metadata_mut().scene = "[loading]\ncontrol = \"load\"\n".to_owned();
    held.write(&folder.path("table.nc")).unwrap();
    let predict = "predict surface.toml --table table.nc -o f.nc";
    folder.refused(predict, &["loading.control = \"load\""]);
    assert!(!folder.path("f.nc").exists());
}

/// A table has the constants that it was made with.
#[test]
fn constants_that_a_table_has_other_values_of_are_named() {
    let folder = sharp("separation = 0");
    table(&Weakening::new()).write(&folder.path("table.nc")).unwrap();
    let predict = "predict surface.toml --table table.nc -o f.nc";
    assert!(!folder.run(predict).stderr.contains("[material]"));
    let other = format!("{predict} --set material.yield_strength=1e9");
    let said = folder.run(&other).stderr;
    assert!(said.contains("yield_strength = 1e9 in [material] is not used"), "{said}");
    assert!(!said.contains("poisson_ratio"), "{said}");
}

/// Density, radius and heights of a surface go together.
#[test]
fn a_density_in_another_unit_is_noticed() {
    let folder = folder_with(&(surface(1e10, 2e-5, 2e-7, "pressure = 1e3\nslip_rate = 1") + MATERIAL));
    let predict = "predict surface.toml --table model:jackson-green --extrapolate -o f.nc";
    assert!(!folder.done(predict).stderr.contains("Nayak"));
    // 1/mm2.
    let said = folder.run(&format!("{predict} --set surface.asperity_density=1e7")).stderr;
    assert!(said.contains("heights is 4e-5") && said.contains("another unit?"), "{said}");
}

/// Files of heights have no key that states their size or their decimal sign.
#[test]
fn heights_in_other_units_or_with_decimal_commas_are_noticed() {
    let surface = "[surface]\nasperity_density = 1e10\nasperity_radius = 1e-4\n\
                   heights = { distribution = \"sample\", file = \"heights.txt\" }\n[query]\npressure = 1e5\nslip_rate = 1\n";
    let folder = folder_with(surface);
    let predict = "predict surface.toml --table model:hertz -o f.nc";
    folder.write("heights.txt", "0.3\n-0.2\n0.1\n");
    folder.write("surface.toml", format!("{surface}{MATERIAL}"));
    let said = folder.run(&format!("{predict} --extrapolate")).stderr;
    assert!(said.contains("surface.heights.std = 0.205") && said.contains("if it is in um"), "{said}");
    for text in ["0,3\n-0,2\n# end\n", "3,77191e-08\n-1,2e-07\n0\n"] {
        folder.write("heights.txt", text);
        folder.refused(predict, &["may have decimal commas"]);
    }
    folder.write("heights.txt", "3,7e-08; -1,2e-07\n");
    folder.refused(predict, &["has decimal commas: write points"]);
}

/// A signal ends prediction and sampling at once; one that is ignored, as under `nohup`, does not.
#[cfg(unix)]
#[test]
fn signals_end_a_computation_unless_they_are_ignored() {
    use std::io::Read;
    use std::os::unix::process::ExitStatusExt;
    use std::process::Stdio;
    use std::time::{Duration, Instant};
    use tests::folder::signal;

    /// A second is promised, the machine may be busy.
    const LATEST: Duration = Duration::from_secs(5);

    let folder = sharp("pressure = 1e5");
    let input = "surface.toml --table model:jackson-green --extrapolate -q -o f.nc";
    let predict = format!("predict {input} --pressure 1e4..1e6:1000 --slip-rate 0.1..10:100 --compare all");
    let sample = format!("sample {input} --asperities 1000000 --realizations 100000");
    for (line, name, number) in [(&predict, "-INT", 2), (&sample, "-INT", 2), (&sample, "-TERM", 15)] {
        let script = format!("trap '' HUP; echo; exec env --default-signal=INT \"$PROGRAM\" {line}");
        let mut child = folder.shell(&script).stdout(Stdio::piped()).spawn().unwrap();
        child.stdout.as_mut().unwrap().read_exact(&mut [0]).unwrap();
        std::thread::sleep(Duration::from_millis(500));
        signal(&child, "-HUP");
        std::thread::sleep(Duration::from_millis(300));
        assert!(child.try_wait().unwrap().is_none(), "{line}: SIGHUP was not ignored");
        signal(&child, name);
        let asked = Instant::now();
        assert_eq!(child.wait().unwrap().signal(), Some(number), "{line}");
        assert!(asked.elapsed() < LATEST, "{line}: {:?}", asked.elapsed());
    }
    assert!(!folder.path("f.nc").exists());
}
