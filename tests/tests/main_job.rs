//! The main job from outside: request -> table.nc -> friction.nc.
//!
//! Problem: a 4340 steel asperity on a very coarse mesh, tabulated by `asperity tabulate` and
//! spread over rough surfaces by `roughsurface predict`, both as programs.
//!
//! Sources: an exponential height distribution gives a friction coefficient that does not depend
//! on load for any single-asperity response (J. A. Greenwood & J. B. P. Williamson, Proc. R. Soc. A 295,
//! 300 (1966), doi 10.1098/rspa.1966.0242: the integrals over exp(−z/σ) all scale with
//! exp(−d/σ)); otherwise the contract of the command line.

use std::path::Path;
use std::sync::OnceLock;
use tables::netcdf::DatasetReader;
use tests::programs::{done, execute};

const REQUEST: &str = r#"
[material]
preset = "steel-4340"
[asperity]
radius = 1e-3
[loading]
slip_distance = 0.3
[table]
interference = [0.3, 2.0, 12.0]
slip_rate = [0.1, 10.0]
[numerics]
elements_per_radius = 4
sectors = 4
"#;

/// Heights as long as a tenth of the deepest tabulated interference: e⁻¹⁰ of the asperities
/// would lie beyond it.
fn surface(pressures: &str, std: f64) -> String {
    format!(
        "[surface]\nasperity_density = 1e6\nasperity_radius = 1e-3\n\
         heights = {{ distribution = \"exponential\", std = {std:e} }}\n\
         [query]\npressure = {pressures}\nslip_rate = [0.1, 10.0]\n"
    )
}

/// A folder with request.toml and the table made from it; made once.
fn tabulated() -> &'static Path {
    static FOLDER: OnceLock<tempfile::TempDir> = OnceLock::new();
    FOLDER
        .get_or_init(|| {
            let folder = tempfile::tempdir().unwrap();
            std::fs::write(folder.path().join("request.toml"), REQUEST).unwrap();
            done("asperity", folder.path(), "tabulate request.toml -o table.nc --jobs 2");
            folder
        })
        .path()
}

/// ω_c of the table, m.
fn critical_interference() -> f64 {
    let table = tables::table::Table::read(&tabulated().join("table.nc")).unwrap();
    table.metadata().critical_interference
}

#[test]
fn exponential_heights_make_friction_independent_of_load() {
    let folder = tabulated();
    let std = 0.6 * critical_interference();
    std::fs::write(folder.join("exponential.toml"), surface("[1e2, 1e3, 1e4]", std)).unwrap();
    done(
        "roughsurface",
        folder,
        "predict exponential.toml --table table.nc -o friction.nc --plot friction.svg",
    );
    assert!(folder.join("friction.svg").exists());
    let file = DatasetReader::open(&folder.join("friction.nc")).unwrap();
    let mu = file.reals("mu", &[3, 2]).unwrap();
    let mu_static = file.reals("mu_static", &[3, 2]).unwrap();
    println!("{mu:?} {mu_static:?}");
    for value in [&mu, &mu_static] {
        for cell in value[2..].iter().zip(value) {
            // The integrals are exact to 1e-3 (their tolerance and the e⁻²⁰ beyond the table).
            assert!((cell.0 / cell.1 - 1.0).abs() < 1e-3, "{value:?}");
        }
    }
    // At each pressure friction falls with the slip rate, and sliding friction is below static.
    for (pair, still) in mu.chunks(2).zip(mu_static.chunks(2)) {
        assert!(pair[1] < pair[0] && pair[1] < still[1] && pair[0] > 0.05 && pair[0] < 1.0);
    }
}

/// Above the table it is extrapolated with an error that grows; contacts too large for their asperities are refused.
#[test]
fn load_above_the_table_is_extrapolated_until_the_sphere_ends() {
    let folder = tabulated();
    let error = |widths: f64| {
        std::fs::write(folder.join("rough.toml"), surface("[1e2]", widths * critical_interference()))
            .unwrap();
        let output = done("roughsurface", folder, "predict rough.toml --table table.nc -o rough.nc");
        let said = output.stderr.contains("extrapolated towards the fully plastic limit");
        let file = DatasetReader::open(&folder.join("rough.nc")).unwrap();
        let first = |name| file.reals(name, &[1, 2]).unwrap()[0];
        let outside = first("outside_table_fraction");
        assert_eq!(said, outside > 1e-3, "{}", output.stderr);
        (outside, first("mu_error") / first("mu"))
    };
    assert!(error(1.0).0 < 0.01);
    let beyond = [5.0, 20.0, 60.0].map(error);
    let grows = |pair: &[(f64, f64)]| pair[0].0 < pair[1].0 && pair[0].1 < pair[1].1;
    assert!(beyond[0].0 > 0.1 && beyond.windows(2).all(grows), "{beyond:?}");
    std::fs::write(folder.join("rough.toml"), surface("[1e2]", 1e4 * critical_interference())).unwrap();
    let strict = "predict rough.toml --table table.nc -o none.nc";
    // Without the warning that 100 Pa is little.
    let output = execute("roughsurface", folder, &format!("{strict} -q"));
    let message = output.stderr;
    assert_eq!((output.status.code(), message.lines().count()), (Some(2), 1), "{message}");
    assert!(message.contains("above 0.4 of their radius") && message.contains("--extrapolate"), "{message}");
    assert!(!folder.join("none.nc").exists());
    done("roughsurface", folder, &format!("{strict} --extrapolate"));
}
