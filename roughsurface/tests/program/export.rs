//! Exported friction, read again.

use crate::demonstration::{Weakening, table};
use crate::folder::{MATERIAL, folder_with_table, surface};
use tests::folder::Folder;

fn steel_surface() -> String {
    let query = "pressure = [1e5, 1e6, 1e7]\nslip_rate = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0]";
    surface(1e10, 1e-4, 5e-8, query)
}

fn folder() -> Folder {
    let folder = folder_with_table(&steel_surface());
    folder.done("predict surface.toml --table table.nc -o friction.nc --quiet");
    folder
}

fn reals(folder: &Folder, name: &str, shape: &[usize]) -> Vec<f64> {
    folder.dataset("friction.nc").reals(name, shape).unwrap()
}

/// Numbers of the lines that do not begin with one of `marks`.
fn numbers(text: &str, marks: [char; 2]) -> Vec<Vec<f64>> {
    let lines = text.lines().filter(|line| !line.starts_with(marks));
    let row = |line: &str| {
        line.split([',', ' ']).filter(|word| !word.is_empty()).map(|word| word.parse().unwrap()).collect()
    };
    lines.map(row).collect()
}

/// At a pressure that is far outside the table.
#[test]
fn warnings_of_the_prediction_are_exported() {
    let folder = folder_with_table(&steel_surface());
    folder
        .run("predict surface.toml --table table.nc -o high.nc --pressure 1e8,6e8 --slip-rate 0.1,1 --quiet");
    let warnings = folder.dataset("high.nc").optional_text("warnings").unwrap().unwrap();
    let words = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>().join(" ");
    for (name, mark) in [("high.inp", "**"), ("high.txt", "%")] {
        folder.done(&format!("export high.nc -o {name}"));
        let text = folder.read(name);
        assert!(text.lines().all(|line| line.len() <= 256));
        let comments: String = text.lines().filter_map(|line| line.strip_prefix(mark)).collect();
        assert!(warnings.lines().all(|warning| words(&comments).contains(&words(warning))), "{comments}");
    }
    folder.done("export high.nc -o high.json");
    let json: serde_json::Value = serde_json::from_str(&folder.read("high.json")).unwrap();
    assert_eq!(json["warnings"].as_array().unwrap().len(), warnings.lines().count());
}

/// The temperature is that of the table, which the query does not repeat.
#[test]
fn every_format_has_the_friction_of_the_file() {
    let folder = folder();
    let mu = reals(&folder, "mu", &[3, 7]);
    let (pressures, rates) = ([1e5, 1e6, 1e7], [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0]);
    for name in ["friction.inp", "friction.txt", "friction.CSV", "law.json"] {
        folder.done(&format!("export friction.nc -o {name}"));
    }
    let close = |one: f64, other: f64| (one / other - 1.0).abs() < 1e-9;

    let abaqus = folder.read("friction.inp");
    assert_eq!(abaqus.lines().filter(|line| *line == "*FRICTION").count(), 1);
    assert!(
        abaqus.lines().all(|line| line.len() <= 256) && abaqus.contains("** Rate law at 1e5 Pa, 298 K: mu_")
    );
    let abaqus = numbers(&abaqus, ['*'; 2]);
    let comsol = numbers(&folder.read("friction.txt"), ['%'; 2]);
    let csv = numbers(&folder.read("friction.CSV"), ['t'; 2]);
    assert_eq!((abaqus.len(), comsol.len(), csv.len()), (21, 2 + 3, 21));
    assert!(comsol[0].iter().zip(rates).all(|(one, other)| close(*one, other)));
    assert!(comsol[1].iter().zip(pressures).all(|(one, other)| close(*one, other)));
    for (cell, mu) in mu.into_iter().enumerate() {
        let (pressure, rate) = (pressures[cell / 7], rates[cell % 7]);
        let [of_abaqus, rate_of_abaqus, pressure_of_abaqus, 298.0] = abaqus[cell][..] else {
            panic!("{:?}", abaqus[cell])
        };
        assert!(close(of_abaqus, mu) && close(rate_of_abaqus, rate) && close(pressure_of_abaqus, pressure));
        assert!(close(comsol[2 + cell / 7][cell % 7], mu));
        assert_eq!(csv[cell][..4], [298.0, pressure, rate, mu]);
    }
    let json: serde_json::Value = serde_json::from_str(&folder.read("law.json")).unwrap();
    let (velocity, reliable) = (reals(&folder, "rate_V_star", &[3]), reals(&folder, "rate_reliable", &[3]));
    for (row, law) in json["laws"].as_array().unwrap().iter().enumerate() {
        assert_eq!(
            (law["pressure"].as_f64(), law["V_star"]["value"].as_f64()),
            (Some(pressures[row]), Some(velocity[row]))
        );
        assert!(law["formula"].as_str().unwrap().starts_with("mu_"));
        let heating = &law["flash_heating"];
        let fitted = ["mu_0", "mu_w", "V_w"]
            .map(|name| (heating[name]["value"].as_f64(), reals(&folder, name, &[3])[row]));
        assert!(
            fitted.iter().all(|(exported, known)| *exported == Some(*known).filter(|known| !known.is_nan()))
        );
        assert!(heating["form"] == "flash-heating" || heating["limitation"].is_string(), "{heating}");
        assert_eq!(
            (law["reliable"] == true, law["limitation"].is_null()),
            (reliable[row] == 1.0, reliable[row] == 1.0)
        );
    }
    // Two parameters through three slip rates.
    let few = "predict surface.toml --table table.nc --slip-rate 0.1,1,10 -o few.nc";
    folder.done(few);
    folder.done("export few.nc -o few.json");
    let json: serde_json::Value = serde_json::from_str(&folder.read("few.json")).unwrap();
    assert!(
        json["laws"][0]["limitation"].as_str().is_some_and(|limitation| limitation.contains("slip rates")),
        "{json}"
    );
    let said = folder.run("export few.nc -o few.csv --law").stderr;
    assert!(said.contains("is not reliable: "), "{said}");
}

#[test]
fn values_of_the_law_lie_within_its_misfit() {
    let folder = folder();
    folder.done("export friction.nc -o law.inp --law");
    let rows = numbers(&folder.read("law.inp"), ['*'; 2]);
    assert_eq!(rows.len(), 3 * 21);
    let (mu, misfit) = (reals(&folder, "mu", &[3, 7]), reals(&folder, "rate_rms", &[3]));
    let error = reals(&folder, "mu_error", &[3, 7]);
    folder.done("export friction.nc -o law.csv --law");
    let csv = numbers(&folder.read("law.csv"), ['t'; 2]);
    for row in 0..3 {
        // Both ends of the range are slip rates of the query.
        for (exported, cell) in [(21 * row, 7 * row), (21 * row + 20, 7 * row + 6)] {
            let off = (rows[exported][0] - mu[cell]).abs();
            assert!(off < 3.0 * misfit[row], "{off} {}", misfit[row]);
            // The law is no surer than what it is fitted to.
            let exact = error[cell].hypot(2.0 * misfit[row]);
            assert!((csv[exported][4] / exact - 1.0).abs() < 1e-9, "{} {exact}", csv[exported][4]);
        }
    }
}

#[test]
fn several_files_are_a_dependence_on_temperature() {
    let folder = folder();
    let hot = Weakening { strength: 1.1, ..Weakening::new() };
    for (kelvin, law) in [(298.0, Weakening::new()), (500.0, hot)] {
        let mut slice = table(&law);
        slice.metadata_mut().temperature = kelvin;
        slice.write(&folder.path("at.nc")).unwrap();
        folder.write(
            "at.toml",
            steel_surface().replace("[query]", &format!("[query]\ntemperature = {kelvin:?}")),
        );
        folder.done(&format!("predict at.toml --table at.nc -o {kelvin}.nc --quiet"));
    }
    for name in ["both.inp", "both.txt"] {
        folder.done(&format!("export 500.nc 298.nc -o {name}"));
    }
    let abaqus = numbers(&folder.read("both.inp"), ['*'; 2]);
    let comsol = numbers(&folder.read("both.txt"), ['%'; 2]);
    assert_eq!((abaqus.len(), comsol.len(), &comsol[2][..]), (42, 3 + 6, &[298.0, 500.0][..]));
    for cell in 0..21 {
        let (cold, hot) = (&abaqus[cell], &abaqus[21 + cell]);
        assert!(cold[1..3] == hot[1..3] && (cold[3], hot[3]) == (298.0, 500.0));
        assert!((hot[0] / cold[0] - 1.1).abs() < 1e-6, "{cold:?} {hot:?}");
        assert!(comsol[3 + cell / 7][cell % 7] == cold[0] && comsol[6 + cell / 7][cell % 7] == hot[0]);
    }
    // A closed form has none.
    folder.write("closed.toml", steel_surface() + MATERIAL);
    folder.done("predict closed.toml --table model:jackson-green -o closed.nc --quiet");
    folder.refused("export closed.nc closed.nc -o f.inp", &["must have an initial temperature each"]);
    folder.refused("export 298.nc 298.nc -o f.inp", &["298 K, as another one"]);
}

#[test]
fn what_cannot_be_exported_is_refused() {
    let folder = folder();
    folder.refused("export friction.nc -o friction.mat", &["ends in .inp for Abaqus"]);
    folder.refused("export friction.nc -o friction.nc", &["ends in .inp"]);
    folder.refused("export table.nc -o friction.csv", &["not a result of `roughsurface predict`"]);
    folder.done("predict surface.toml --table table.nc --separation 1e-7 -o separations.nc --quiet");
    folder.refused("export separations.nc -o friction.csv", &["query.pressure"]);
    folder.done("sample surface.toml --table table.nc --asperities 1000 --realizations 2 -o mc.nc --quiet");
    folder.refused("export mc.nc -o friction.csv", &["a result of `sample`"]);
    folder.done("predict surface.toml --table table.nc --slip-rate 1 -o one.nc --quiet");
    folder.refused(
        "export one.nc -o friction.csv --law",
        &["no rate law is fitted at 1e5 Pa: at least 3 slip rates"],
    );
}
