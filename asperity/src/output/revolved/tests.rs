use super::*;
use crate::discretisation::collocation::Collocation;
use crate::discretisation::mesh::{MeridianMesh, MeshSize, revolved_volume};

/// A uniform deformation of a body of radius 1, in the cylindrical components of the simulation.
fn body(count: usize) -> BodyFields {
    let mesh = MeridianMesh::new(MeshSize::new(0.1, 4));
    let angles = Collocation::full(count).angles();
    let (mut displacement, mut stress, mut temperature) = (Vec::new(), Vec::new(), Vec::new());
    for &[r, z] in &mesh.nodes {
        let at = |value: &dyn Fn(f64, f64) -> f64| angles.iter().map(|t| value(t.cos(), t.sin())).collect();
        let fields: [Vec<f64>; 4] = [
            at(&|c, s| DISPLACED[0](r * c, z) * c + 0.2 * r * s * s),
            at(&|c, s| -DISPLACED[0](r * c, z) * s + 0.2 * r * s * c),
            at(&|c, _| DISPLACED[1](r * c, z)),
            at(&|c, _| 300.0 + 50.0 * r * c),
        ];
        let [xx, yy, zz, _, _, xz] = STRESS;
        let tensor: [Vec<f64>; 6] = [
            at(&|c, s| xx * c * c + yy * s * s),
            at(&|c, s| xx * s * s + yy * c * c),
            at(&|_, _| zz),
            at(&|c, s| (yy - xx) * s * c),
            at(&|_, s| -xz * s),
            at(&|c, _| xz * c),
        ];
        displacement.extend(fields[..3].concat());
        temperature.extend(&fields[3]);
        stress.extend(tensor.concat());
    }
    let plastic_strain = (0..temperature.len()).map(|i| (i % count) as f64).collect();
    let snapshot = BodySnapshot { slip: 0.0, time: 0.0, displacement, stress, plastic_strain, temperature };
    BodyFields { nodes: mesh.nodes, quads: mesh.quads, angles, snapshots: vec![snapshot] }
}

/// u_x and u_z at (x, z); u_y is 0.2 y.
const DISPLACED: [fn(f64, f64) -> f64; 2] = [|x, z| 0.3 * x - 0.1 * z + 1.0, |x, z| 0.5 * x + 0.4 * z];
/// Symmetric about y = 0.
const STRESS: [f64; 6] = [1.0, -2.0, 0.5, 0.0, 0.0, 0.7];

#[test]
fn linear_fields_are_exact_in_every_plane_and_on_the_axis() {
    for extent in [Extent::Half, Extent::Whole] {
        let body = body(4);
        let revolved = RevolvedBody::new(&body, extent);
        let fields = revolved.fields(&body.snapshots[0]);
        assert_eq!(fields.temperature.len(), revolved.points.len());
        let exact_mises = (0.5 * (9.0 + 6.25 + 0.25) + 3.0 * 0.49_f64).sqrt();
        for (n, &[x, y, z]) in revolved.points.iter().enumerate() {
            let exact = [DISPLACED[0](x, z), 0.2 * y, DISPLACED[1](x, z)];
            for c in 0..3 {
                assert!((fields.displacement[n][c] - exact[c]).abs() < 1e-12, "{x} {y} {z}");
            }
            for c in 0..6 {
                assert!(
                    (fields.stress[n][c] - STRESS[c]).abs() < 1e-12,
                    "{x} {y} {z}: {:?}",
                    fields.stress[n]
                );
            }
            assert!((fields.von_mises[n] - exact_mises).abs() < 1e-12);
            assert!((fields.temperature[n] - (300.0 + 50.0 * x)).abs() < 1e-10);
            assert!((0.0..=3.0).contains(&fields.plastic_strain[n]));
        }
    }
}

/// The plane y = 0 in front has the value of the first angle, that behind that of the last.
#[test]
fn plastic_strain_is_that_of_the_nearest_angle_on_the_symmetry_plane() {
    let body = body(4);
    let revolved = RevolvedBody::new(&body, Extent::Half);
    let fields = revolved.fields(&body.snapshots[0]);
    for (&[x, y, _], strain) in revolved.points.iter().zip(&fields.plastic_strain) {
        if y.abs() < 1e-12 && x.abs() > 1e-12 {
            let expected = if x > 0.0 { 0.0 } else { 3.0 };
            assert!((strain - expected).abs() < 1e-12, "{x} {strain}");
        }
    }
}

/// Signed volumes of all cells are positive, and together the volume of the body, but for the chords.
#[test]
fn cells_are_turned_as_vtk_expects_and_fill_the_body() {
    for (extent, share) in [(Extent::Half, 0.5), (Extent::Whole, 1.0)] {
        let body = body(16);
        let mesh = MeridianMesh::new(MeshSize::new(0.1, 4));
        let revolved = RevolvedBody::new(&body, extent);
        let tetrahedron = |corners: [usize; 4]| {
            let [a, b, c, d] = corners.map(|n| revolved.points[n]);
            let [p, q, r] = [b, c, d].map(|x| [x[0] - a[0], x[1] - a[1], x[2] - a[2]]);
            let cross = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
            (cross[0] * r[0] + cross[1] * r[1] + cross[2] * r[2]) / 6.0
        };
        let mut total = 0.0;
        for h in &revolved.hexahedra {
            let parts = [[0, 1, 3, 4], [1, 2, 3, 6], [1, 4, 5, 6], [3, 4, 6, 7], [1, 3, 4, 6]];
            for part in parts {
                let volume = tetrahedron(part.map(|n| h[n]));
                assert!(volume > 0.0, "{h:?}");
                total += volume;
            }
        }
        for w in &revolved.wedges {
            for part in [[0, 1, 2, 3], [2, 3, 4, 5], [2, 1, 4, 3]] {
                let volume = tetrahedron(part.map(|n| w[n]));
                assert!(volume > 0.0, "{w:?} {part:?}");
                total += volume;
            }
        }
        let angle = PI / 32.0;
        let exact = share * revolved_volume(&mesh) * angle.sin() / angle;
        assert!((total / exact - 1.0).abs() < 1e-9, "{}", total / exact);
    }
}
