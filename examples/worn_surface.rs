//! A full study: has a surface that has lost its peaks less friction than a fresh one of the same roughness?
//!
//! Simulates a table of one 4340 steel asperity over interference and slip rate, puts such asperities
//! on a Gaussian surface and on one whose heights are skewed by wear, both with the same summits per
//! area and the same standard deviation, and compares their friction, its fall with the slip rate and
//! the real area of contact. Writes table.nc, fresh.nc, worn.nc and figure.svg into the directory given
//! as argument (default: worn-surface). Started again after an interrupt, it continues.
//!
//!     cargo run --release -p examples --example worn_surface [DIRECTORY]

use std::path::{Path, PathBuf};

use asperity::output::provenance;
use asperity::scene::file::parse_request;
use asperity::simulate::Unwatched;
use asperity::tabulate::{Options, tabulate};
use roughsurface::friction::{Prediction, Settings, predict};
use roughsurface::output::{Origin, Results, friction_file};
use roughsurface::surface::file::SurfaceFile;
use tables::figures::{Axis, Curve, Figure, Panel};
use tables::interpolation::InterpolatedTable;
use tables::table::Table;

/// A coarse table: a look at the method, not a result to quote.
const REQUEST: &str = r#"
[material]
preset = "steel-4340"
[asperity]
radius = 1e-3                        # m
[loading]
slip_distance = 0.5                  # in contact radii
[model]
heat = "on"
[table]
interference = [0.5, 5.0, 50.0]      # in units of that of first yield
slip_rate = [0.1, 1.0, 10.0]         # m/s
[numerics]
elements_per_radius = 4
sectors = 4
"#;

const SURFACE: &str = r#"
[surface]
asperity_density = 1e8               # 1/m2
asperity_radius = 1e-3               # m
heights = { HEIGHTS, std = 0.4e-6 }  # m
[query]
pressure = [1e6, 1e7, 1e8]           # nominal, Pa
slip_rate = [0.1, 0.3, 1.0, 3.0, 10.0]
"#;

fn main() -> anyhow::Result<()> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "worn-surface".into()));
    std::fs::create_dir_all(&folder)?;

    // 1. What one asperity does: nine slides, three presses.
    let table = table(&folder)?;

    // 2. Two surfaces that differ in the shape of their heights alone.
    let fresh = surface(&folder.join("fresh.nc"), &table, "distribution = \"gaussian\"")?;
    let worn =
        surface(&folder.join("worn.nc"), &table, "distribution = \"inverted-chi-squared\", shape = 8.0")?;

    // 3. Side by side.
    println!("pressure [MPa]   slip rate [m/s]   mu fresh   mu worn   area fresh   area worn");
    for (i, pressure) in fresh.query.loading.values().iter().enumerate() {
        for (j, rate) in fresh.query.slip_rates.iter().enumerate() {
            let [(mu, area), (worn_mu, worn_area)] = [&fresh, &worn].map(|surface| {
                let sliding = &surface.friction[i][j].sliding;
                (sliding.mu.value, 100.0 * sliding.area_fraction.value)
            });
            println!(
                "{:>14}   {rate:>15}   {mu:>8.4}   {worn_mu:>7.4}   {area:>8.3} %   {worn_area:>7.3} %",
                1e-6 * pressure
            );
        }
    }
    figure(&fresh, &worn).save(&folder.join("figure.svg"))?;
    println!("written to {}", folder.display());
    Ok(())
}

/// The table, from its file if that is there.
fn table(folder: &Path) -> anyhow::Result<InterpolatedTable> {
    let path = folder.join("table.nc");
    if path.exists() {
        return Ok(Table::read(&path)?.at(None)?);
    }
    let request = parse_request(REQUEST, "the request of this example", &[])?;
    let journal = folder.join("table.nc.part");
    let jobs = std::thread::available_parallelism()?.get();
    let options = Options { jobs, journal: &journal, resume: true, shard: None };
    let (tabulation, journal) = tabulate(&request, &options, &Unwatched)?;
    let table = tabulation.table(provenance::history("worn_surface"))?;
    table.write(&path)?;
    journal.remove()?;
    Ok(table.at(None)?)
}

fn surface(path: &Path, table: &InterpolatedTable, heights: &str) -> anyhow::Result<Prediction> {
    let text = SURFACE.replace("HEIGHTS", heights);
    let file = SurfaceFile::parse("the surface of this example".as_ref(), text.clone())?;
    let prediction = predict(table, &file.surface, &file.query, &Settings::default(), &|_, _| ())?;
    let results = Results::from(prediction);
    let origin = Origin { surface: &text, table: "table.nc", history: "worn_surface" };
    friction_file::write(path, &results, &origin)?;
    Ok(results.prediction)
}

fn figure(fresh: &Prediction, worn: &Prediction) -> Figure {
    let curve = |name: &str, prediction: &Prediction, row: usize| {
        let label = format!("{name}, {} MPa", 1e-6 * prediction.query.loading.values()[row]);
        let mu = prediction.friction[row].iter().map(|friction| friction.sliding.mu);
        Curve::with_errors(label, prediction.query.slip_rates.clone(), mu)
    };
    let curves = [0, 2].into_iter().flat_map(|row| [curve("fresh", fresh, row), curve("worn", worn, row)]);
    let panel = Panel::new(
        "",
        "4340 steel, same density, radius and standard deviation of the summits",
        Axis::logarithmic("Slip rate V (m/s)"),
        Axis::linear("Friction coefficient μ"),
        curves.collect(),
    );
    Figure::new("Friction of a fresh and of a worn surface", vec![panel])
}
