use wide::f64x4;

use super::*;
use crate::discretisation::collocation::VECTOR_PARITY;
use crate::discretisation::mesh::MeshSize;

fn mesh(sectors: Collocation) -> RevolvedMesh {
    RevolvedMesh::new(MeridianMesh::new(MeshSize::new(0.05, 4)), sectors)
}

/// With equal weights, which make the map bilinear.
fn bilinear_mesh(sectors: Collocation) -> RevolvedMesh {
    let mut meridian = MeridianMesh::new(MeshSize::new(0.05, 4));
    meridian.weights.fill(1.0);
    RevolvedMesh::new(meridian, sectors)
}

/// Cylindrical nodal values of a Cartesian displacement symmetric about y = 0.
pub(crate) fn nodal(mesh: &RevolvedMesh, u: impl Fn([f64; 3]) -> [f64; 3]) -> Vec<f64> {
    let columns = mesh.sectors.columns();
    let mut field = vec![0.0; mesh.field_length(3)];
    for (node, &[r, z]) in mesh.meridian.nodes.iter().enumerate() {
        for (j, theta) in mesh.sectors.angles().into_iter().enumerate() {
            let (sin, cos) = theta.sin_cos();
            let [ux, uy, uz] = u([r * cos, r * sin, z]);
            field[node * 3 * columns + j] = ux * cos + uy * sin;
            field[(node * 3 + 1) * columns + j] = -ux * sin + uy * cos;
            field[(node * 3 + 2) * columns + j] = uz;
        }
    }
    field
}

#[test]
fn linear_displacements_have_their_exact_strain_everywhere() {
    let mesh = bilinear_mesh(Collocation::full(8));
    // Symmetric about y = 0: u_x, u_z even and u_y odd in y.
    let u = nodal(&mesh, |[x, y, z]| [0.3 * x - 0.2 * z + 1.0, 0.7 * y, 0.5 * x + 0.1 * z]);
    let mut slope = vec![0.0; u.len()];
    mesh.sectors.differentiate(&VECTOR_PARITY, &u, &mut slope);
    for element in &mesh.elements {
        for first in [0, 4] {
            let local = mesh.gather_vector::<f64x4>(&u, &slope, element, first);
            let (deviators, dilatation) = deviators_and_dilatation(element, &local);
            let deviators = deviators.map(|of_point| of_point.map(|component| component.to_array()));
            let dilatation = dilatation.to_array();
            for l in 0..4 {
                let (sin, cos) = mesh.sectors.angles()[first + l].sin_cos();
                let (exx, eyy, ezz, exz): (f64, f64, f64, f64) = (0.3, 0.7, 0.1, 0.15);
                let third = (exx + eyy + ezz) / 3.0;
                let exact = [
                    exx * cos * cos + eyy * sin * sin - third,
                    exx * sin * sin + eyy * cos * cos - third,
                    ezz - third,
                    (eyy - exx) * sin * cos,
                    -exz * sin,
                    exz * cos,
                ];
                assert!((dilatation[l] - 3.0 * third).abs() < 1e-10);
                for q in 0..POINTS {
                    for i in 0..6 {
                        assert!((deviators[q][i][l] - exact[i]).abs() < 1e-10);
                    }
                }
            }
        }
    }
}

fn error_of_volume(mesh: &RevolvedMesh) -> f64 {
    let total: f64 = mesh.nodal_volumes().iter().sum();
    let exact = 0.5 * crate::discretisation::mesh::revolved_volume(&mesh.meridian);
    (total / exact - 1.0).abs()
}

#[test]
fn volumes_are_those_of_the_body_of_revolution() {
    for count in [1, 4, 8] {
        assert!(error_of_volume(&bilinear_mesh(Collocation::full(count))) < 1e-12);
    }
}

/// Of the rational map Gauss's rule is not exact: the error of the volume falls faster than the square of the size.
#[test]
fn volumes_of_the_rational_map_converge() {
    let [coarse, fine] = [4, 8].map(|elements| {
        let meridian = MeridianMesh::new(MeshSize::new(0.05, elements));
        error_of_volume(&RevolvedMesh::new(meridian, Collocation::axisymmetric()))
    });
    assert!(coarse < 0.01 && fine < coarse / 5.0, "{coarse} {fine}");
}

/// Largest error of the gradient of 1/ρ at the Gauss points of the fan, relative to 1/ρ².
fn error_of_far_field(mesh: &RevolvedMesh) -> f64 {
    let shapes = shape_at_points();
    let distance = |node: &u32| {
        let [r, z] = mesh.meridian.nodes[*node as usize];
        r.hypot(z)
    };
    let of_fan = |element: &&Element| element.nodes.iter().all(|node| distance(node) > 0.1);
    let mut largest: f64 = 0.0;
    for element in mesh.elements.iter().filter(of_fan) {
        let values = element.nodes.map(|node| 1.0 / distance(&node));
        for (derivatives, shape) in element.shape.iter().zip(&shapes) {
            let along = |of: fn(&ShapeAtPoint) -> f64| -> f64 {
                derivatives.iter().zip(&values).map(|(n, value)| of(n) * value).sum()
            };
            let inverse: f64 = shape.iter().zip(&values).map(|(n, value)| n * value).sum();
            let gradient = along(|n| n.dr).hypot(along(|n| n.dz));
            largest = largest.max((gradient / inverse.powi(2) - 1.0).abs());
        }
    }
    largest
}

/// The far field 1/ρ has a gradient three times as exact as by the bilinear map; what remains is the angle of elements.
#[test]
fn shells_follow_the_inverse_distance() {
    let [rational, bilinear] =
        [mesh, bilinear_mesh].map(|of| error_of_far_field(&of(Collocation::axisymmetric())));
    assert!(rational < 0.12 && bilinear > 0.3, "{rational} {bilinear}");
}

#[test]
fn forces_are_transposes_of_strains() {
    let mesh = mesh(Collocation::full(4));
    let element = &mesh.elements[3];
    let values: [[f64; VALUES]; CORNERS] =
        std::array::from_fn(|a| std::array::from_fn(|c| ((a * 31 + c * 7) as f64 * 0.7).sin()));
    // A deviatoric stress, so that the mean dilatation drops out.
    let stress: [[f64; 6]; POINTS] = std::array::from_fn(|q| {
        let mut s: [f64; 6] = std::array::from_fn(|i| ((q * 13 + i * 5) as f64 * 1.3).cos());
        s[2] = -s[0] - s[1];
        s
    });
    let (deviators, _) = deviators_and_dilatation(element, &values);
    let force = stress_force(element, &stress);
    let inner: f64 = (0..POINTS)
        .flat_map(|q| (0..6).map(move |i| (q, i)))
        .map(|(q, i)| if i < 3 { 1.0 } else { 2.0 } * stress[q][i] * deviators[q][i])
        .sum();
    let outer: f64 = (0..CORNERS)
        .flat_map(|a| (0..VALUES).map(move |c| (a, c)))
        .map(|(a, c)| force[a][c] * values[a][c])
        .sum();
    assert!((inner - outer).abs() < 1e-11 * inner.abs().max(1.0));
}
