//! `asperity run --vtu`: what is in the files for ParaView, read back.
//!
//! Problem: a 4340 steel asperity on a coarse mesh. The files must agree with `run.nc` and with the
//! flat that the asperity was pressed against.

use std::sync::OnceLock;

use tests::folder::Folder;
use vtkio::model::{Attribute, DataSet, Piece, UnstructuredGridPiece, Vtk};

const SCENE: &str = "[loading]\ninterference = 20\nslip_rate = 1\nslip_distance = 0.2\n\
                     [numerics]\nelements_per_radius = 8\nsectors = 4\n";

/// A directory with run.nc, half/ and whole/; made once.
fn results() -> &'static Folder {
    static DIRECTORY: OnceLock<Folder> = OnceLock::new();
    DIRECTORY.get_or_init(|| {
        let directory = crate::folder_with("scene.toml", SCENE);
        for options in ["half", "whole --vtu-whole"] {
            directory.done(&format!("run scene.toml -o run.nc --fields-at 0.05,0.1 --vtu {options}"));
        }
        directory
    })
}

/// (slip in a₀, file) of a collection.
fn collection(folder: &str) -> Vec<(f64, String)> {
    let text = results().read(&format!("{folder}/body.pvd"));
    let attribute = |line: &str, name: &str| {
        line.split_once(&format!("{name}=\"")).unwrap().1.split_once('"').unwrap().0.to_owned()
    };
    let lines = text.lines().filter(|line| line.contains("<DataSet"));
    lines.map(|line| (attribute(line, "timestep").parse().unwrap(), attribute(line, "file"))).collect()
}

fn grid(folder: &str, file: &str) -> UnstructuredGridPiece {
    let vtk = Vtk::import(results().path(folder).join(file)).unwrap();
    let DataSet::UnstructuredGrid { mut pieces, .. } = vtk.data else { panic!("no grid") };
    let Piece::Inline(piece) = pieces.remove(0) else { panic!("no piece") };
    *piece
}

fn points(grid: &UnstructuredGridPiece) -> Vec<[f64; 3]> {
    let values: Vec<f64> = grid.points.cast_into().unwrap();
    values.chunks_exact(3).map(|point| [point[0], point[1], point[2]]).collect()
}

fn values(grid: &UnstructuredGridPiece, name: &str) -> Vec<f64> {
    let of = |attribute: &Attribute| match attribute {
        Attribute::DataArray(array) if array.name == name => array.data.cast_into(),
        _ => None,
    };
    grid.data.point.iter().find_map(of).unwrap_or_else(|| panic!("no {name}"))
}

fn highest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(f64::NEG_INFINITY, f64::max)
}

#[test]
fn fields_are_those_of_the_run_and_lie_on_the_flat() {
    let run = results().dataset("run.nc");
    let steps = run.shape("slip").unwrap()[0];
    let of = |name: &str| run.reals(name, &[steps]).unwrap();
    let scalar = |name: &str| run.reals(name, &[]).unwrap()[0];
    let (slips, interferences) = (of("slip"), of("interference"));
    let steps = collection("half");
    // Before, half-way to full slip, full slip, the two requested ones, the end.
    assert_eq!(steps.len(), 6);
    assert!(steps.windows(2).all(|pair| pair[0].0 < pair[1].0));
    // At the slips themselves: increments end there.
    for asked in [0.05, 0.1] {
        assert!(steps.iter().any(|(slip, _)| (slip / asked - 1.0).abs() < 1e-9), "{asked}: {steps:?}");
    }
    for (slip, file) in &steps {
        let grid = grid("half", file);
        let step = (0..slips.len())
            .min_by(|a, b| {
                let off = |n: usize| (slips[n] / scalar("contact_radius") - slip).abs();
                off(*a).total_cmp(&off(*b))
            })
            .unwrap();
        let depth = interferences[step] * scalar("critical_interference");
        let displacement = values(&grid, "displacement");
        let heights = points(&grid).into_iter().zip(displacement.chunks_exact(3)).map(|(x, u)| x[2] + u[2]);
        // Springs hold the surface on the flat, a few per mille of the interference below its plane.
        assert!((highest(heights) / -depth - 1.0).abs() < 0.02, "{file}");
        // The base is clamped.
        let base = points(&grid).into_iter().zip(displacement.chunks_exact(3));
        assert!(base.filter(|(x, _)| x[2] < -0.999e-3).all(|(_, u)| u.iter().all(|u| u.abs() < 1e-15)));
        let temperature = highest(values(&grid, "temperature"));
        // Harmonics may rise a little above the values that they go through.
        assert!((temperature / of("temperature_max")[step] - 1.0).abs() < 2e-3, "{file}: {temperature}");
        // At nodes, as means over the elements around them.
        let strain = highest(values(&grid, "plastic_strain"));
        let largest = of("plastic_strain_max")[step];
        assert!(strain <= largest && strain > 0.5 * largest, "{file}: {strain} {largest}");
        // Johnson & Cook's 4340: 792 MPa and hardening of 510 MPa ε^0.26, cold.
        let strength = 792e6 + 510e6 * largest.powf(0.26);
        let mises = highest(values(&grid, "von_mises_stress"));
        assert!(mises > 700e6 && mises < 1.05 * strength, "{file}: {mises:e} {strength:e}");
    }
}

#[test]
fn the_stress_on_the_axis_carries_the_pressure_of_the_contact_centre() {
    let run = results().dataset("run.nc");
    let pressure = run.reals("pressure", &run.shape("pressure").unwrap()).unwrap();
    let [half, grid] = ["half", "whole"].map(|folder| grid(folder, &collection(folder)[0].1));
    assert_eq!(grid.cells.num_cells(), 2 * half.cells.num_cells());
    let apex = points(&grid).iter().position(|x| x.iter().all(|x| *x == 0.0)).unwrap();
    let axial = values(&grid, "stress")[6 * apex + 2];
    // The mean over the element below the apex is not yet the value at the surface.
    assert!((axial / -pressure[0] - 1.0).abs() < 0.1, "{axial:e} {:e}", pressure[0]);
}
