//! A long thick-walled tube, expanded to twice its bore.
//!
//! Incompressible and without hardening it flows throughout, σ_θ − σ_r = 2σ_Y/√3, and equilibrium in the deformed tube
//! gives the pressure (2σ_Y/√3) ln(b/a), with b² − a² = B² − A² (Hill, The Mathematical Theory of Plasticity, 1950, ch.
//! V; de Souza Neto, Perić & Owen, Computational Methods for Plasticity, 2008, §14.9.1).

use super::*;
use crate::discretisation::element::RevolvedMesh;
use crate::discretisation::mesh::MeridianMesh;

const INNER: f64 = 1.0;
const OUTER: f64 = 2.0;
const HEIGHT: f64 = 0.3;

/// A ring of elements; unknowns are the radial displacements of their edges, without axial strain.
struct Tube {
    body: Body,
    elements: usize,
}

impl Tube {
    fn new(elements: usize) -> Self {
        let rings = 0..=elements;
        let nodes: Vec<[f64; 2]> =
            rings.flat_map(|i| [[radius(i, elements), 0.0], [radius(i, elements), HEIGHT]]).collect();
        let quads = (0..elements as u32).map(|i| [2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1]).collect();
        let is_base = vec![false; nodes.len()];
        let weights = vec![1.0; nodes.len()];
        let meridian = MeridianMesh { nodes, weights, quads, contact: Vec::new(), is_base };
        let mut solid = body(Hardening::None, Collocation::axisymmetric()).solid;
        solid.moduli.bulk = 1e3 * solid.moduli.shear;
        let mesh = RevolvedMesh::new(meridian, Collocation::axisymmetric());
        Self { body: Body::new(mesh, solid).at_finite_strain(), elements }
    }

    /// Radial forces of the rings at radial displacements.
    fn force(&mut self, radial: &[f64]) -> Vec<f64> {
        summed(&force(&mut self.body, &nodal_field(radial)))
    }

    /// Derivative of the forces but the first with the displacements but the first.
    fn tangent(&mut self) -> nalgebra::DMatrix<f64> {
        let n = self.elements;
        let mut tangent = nalgebra::DMatrix::<f64>::zeros(n, n);
        for j in 0..n {
            let mut unit = vec![0.0; n + 1];
            unit[j + 1] = 1.0;
            let mut product = vec![0.0; 6 * (n + 1)];
            self.body.tangent_product(&nodal_field(&unit), &mut product);
            for (i, f) in summed(&product)[1..].iter().enumerate() {
                tangent[(i, j)] = *f;
            }
        }
        tangent
    }

    /// Expands the bore to `a` and returns the pressure in it.
    fn expand(&mut self, a: f64) -> f64 {
        let grown = a * a - INNER * INNER;
        let mut radial: Vec<f64> = (0..=self.elements)
            .map(|i| radius(i, self.elements))
            .map(|r| (r * r + grown).sqrt() - r)
            .collect();
        for _ in 0..20 {
            let forces = self.force(&radial);
            let residual = nalgebra::DVector::from_column_slice(&forces[1..]);
            if residual.norm() < 1e-8 * forces[0].abs() {
                self.body.commit();
                // Of the half tube.
                return forces[0] / (PI * a * HEIGHT);
            }
            let change = self.tangent().lu().solve(&residual).expect("regular");
            for (u, d) in radial[1..].iter_mut().zip(change.iter()) {
                *u -= d;
            }
        }
        panic!("no equilibrium at a = {a}");
    }
}

fn radius(ring: usize, elements: usize) -> f64 {
    INNER + (OUTER - INNER) * ring as f64 / elements as f64
}

/// The displacement of each ring at its lower and upper node, and back.
fn nodal_field(radial: &[f64]) -> Vec<f64> {
    radial.iter().flat_map(|&u| [u, 0.0, 0.0, u, 0.0, 0.0]).collect()
}

fn summed(field: &[f64]) -> Vec<f64> {
    field.chunks(6).map(|f| f[0] + f[3]).collect()
}

#[test]
fn expanding_tube_has_the_pressure_of_the_rigid_plastic_one() {
    let worst = |elements: usize| {
        let mut tube = Tube::new(elements);
        let errors = (1..=40).map(|step| {
            let a = INNER * (1.0 + step as f64 / 40.0);
            let b = (OUTER * OUTER - INNER * INNER + a * a).sqrt();
            let exact = 2.0 / 3f64.sqrt() * (b / a).ln();
            (tube.expand(a) / exact - 1.0).abs()
        });
        // From where all of the tube flows.
        errors.skip(4).fold(0.0f64, f64::max)
    };
    let (coarse, fine) = (worst(8), worst(16));
    assert!(fine < 1e-3 && coarse / fine > 3.5, "{coarse} {fine}");
}
