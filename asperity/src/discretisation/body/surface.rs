//! Plastic strain of the elements under the contact, at the contact points.

use super::{Body, BodyState};
use crate::discretisation::element::POINTS;

impl Body {
    /// Equivalent plastic strain at each contact point (ring by ring, columns within): the mean
    /// ∫Nε_p dV/∫N dV over the elements with an edge on the contact surface, N the shape function
    /// of the point.
    pub fn surface_strain(&self, state: &BodyState) -> Vec<f64> {
        let mesh = &self.mesh;
        let columns = mesh.sectors.columns();
        let mut ring_of = vec![None; mesh.node_count()];
        for (ring, &node) in mesh.meridian.contact.iter().enumerate() {
            ring_of[node as usize] = Some(ring);
        }
        let points = mesh.meridian.contact.len() * columns;
        let (mut sum, mut volume) = (vec![0.0; points], vec![0.0; points]);
        for (e, element) in mesh.elements.iter().enumerate() {
            let rings = element.nodes.map(|node| ring_of[node as usize]);
            if rings.iter().flatten().count() < 2 {
                continue;
            }
            for (n, ring) in rings.into_iter().enumerate() {
                let Some(ring) = ring else { continue };
                for q in 0..POINTS {
                    let weight = self.shapes[q][n] * element.weight[q];
                    for j in 0..columns {
                        sum[ring * columns + j] += weight * state.accumulated[(e * POINTS + q) * columns + j];
                        volume[ring * columns + j] += weight;
                    }
                }
            }
        }
        // The apex is one point in all columns.
        for (ring, &node) in mesh.meridian.contact.iter().enumerate() {
            if mesh.meridian.on_axis(node as usize) {
                let at = ring * columns..(ring + 1) * columns;
                let whole = (sum[at.clone()].iter().sum::<f64>(), volume[at.clone()].iter().sum::<f64>());
                sum[at.clone()].fill(whole.0);
                volume[at].fill(whole.1);
            }
        }
        sum.iter().zip(&volume).map(|(strain, volume)| strain / volume).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{body, wave};
    use super::*;
    use crate::discretisation::collocation::Collocation;
    use crate::scene::Hardening;

    /// A uniform strain is reproduced; the strain of a single deep element has no effect.
    #[test]
    fn surface_strain_is_that_of_the_top_layer() {
        for sectors in [Collocation::axisymmetric(), Collocation::full(4)] {
            let mut body = body(Hardening::None, sectors);
            body.trial.accumulated.fill(0.037);
            for strain in body.surface_strain(&body.trial) {
                assert!((strain - 0.037).abs() < 1e-15);
            }
            let lanes = body.mesh.sectors.columns();
            let is_top = |nodes: &[u32; 4]| {
                nodes.iter().filter(|node| body.mesh.meridian.contact.contains(node)).count() == 2
            };
            let deep = body.mesh.elements.iter().position(|element| !is_top(&element.nodes)).unwrap();
            body.trial.accumulated.fill(0.0);
            body.trial.accumulated[deep * POINTS * lanes..(deep + 1) * POINTS * lanes].fill(1.0);
            assert!(body.surface_strain(&body.trial).iter().all(|&strain| strain == 0.0));
        }
    }

    /// Of a field that changes from point to point.
    #[test]
    fn surface_strain_of_the_apex_is_the_same_at_all_angles() {
        let mut body = body(Hardening::None, Collocation::full(4));
        body.trial.accumulated = wave(body.trial.accumulated.len(), 1.0, 0.2);
        let strain = body.surface_strain(&body.trial);
        let apex = &strain[..4];
        assert!(apex.iter().all(|&x| x == apex[0]));
        assert!(strain[4..8].windows(2).any(|pair| pair[0] != pair[1]));
    }
}
