//! Stress and plastic strain at the nodes of the meridian.

use super::state::value_index;
use super::{Body, BodyState, TENSOR};
use crate::discretisation::element::POINTS;

/// Components at a node: the stress (rr, θθ, zz, rθ, θz, zr) and the equivalent plastic strain.
pub const NODAL: usize = TENSOR + 1;

impl Body {
    /// Means ∫Nf dV/∫N dV over the elements around each node, N its shape function, f the value at
    /// the Gauss points: `[(node*NODAL + component)*columns + j]`.
    pub fn nodal_means(&self, state: &BodyState) -> Vec<f64> {
        let columns = self.mesh.sectors.columns();
        let mut sum = vec![0.0; self.mesh.field_length(NODAL)];
        let mut volume = vec![0.0; self.mesh.node_count()];
        for (e, element) in self.mesh.elements.iter().enumerate() {
            for (n, &node) in element.nodes.iter().enumerate() {
                let node = node as usize;
                for q in 0..POINTS {
                    let weight = self.shapes[q][n] * element.weight[q];
                    volume[node] += weight;
                    for component in 0..NODAL {
                        let target = &mut sum[(node * NODAL + component) * columns..][..columns];
                        let values = match component {
                            TENSOR => &state.accumulated[(e * POINTS + q) * columns..],
                            i => &state.deviator[value_index(TENSOR, [e, i, q], columns)..],
                        };
                        for (target, value) in target.iter_mut().zip(values) {
                            *target += weight * value;
                        }
                        if component < 3 {
                            let mean_stress = &state.mean_stress[e * columns..];
                            for (target, mean) in target.iter_mut().zip(mean_stress) {
                                *target += weight * mean;
                            }
                        }
                    }
                }
            }
        }
        for (values, volume) in sum.chunks_exact_mut(NODAL * columns).zip(volume) {
            values.iter_mut().for_each(|value| *value /= volume);
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::body;
    use super::*;
    use crate::discretisation::collocation::Collocation;
    use crate::discretisation::element::tests::nodal;
    use crate::scene::Hardening;

    /// Of a linear elastic displacement the stress is uniform, and so found at every node.
    #[test]
    fn uniform_stress_is_found_at_every_node() {
        let mut body = body(Hardening::None, Collocation::full(4));
        let columns = 4;
        let (radial, axial) = (2e-5, -3e-5);
        let u = nodal(&body.mesh, |[x, y, z]| [radial * x, radial * y, axial * z]);
        let mut force = vec![0.0; u.len()];
        body.internal_force(&u, None, &mut force);
        body.trial.accumulated.fill(0.25);
        let moduli = body.solid.moduli;
        let dilatation = 2.0 * radial + axial;
        let normal =
            |strain: f64| moduli.bulk * dilatation + 2.0 * moduli.shear * (strain - dilatation / 3.0);
        let exact = [normal(radial), normal(radial), normal(axial), 0.0, 0.0, 0.0, 0.25];
        for node in body.nodal_means(&body.trial).chunks_exact(NODAL * columns) {
            for (component, exact) in node.chunks_exact(columns).zip(exact) {
                assert!(component.iter().all(|value| (value - exact).abs() < 1e-9), "{component:?} {exact}");
            }
        }
    }
}
