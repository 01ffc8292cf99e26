//! Internal force of an element at small strain.
//!
//! Stress at a Gauss point: deviator s = 2G(e − e_p), mean stress p = K(ε̄_v − 3∫α dθ̄), where the dilatation ε̄_v and
//! the temperature rise θ̄ are means over the element (B̄).

use super::{Body, TENSOR};
use crate::discretisation::element::{CORNERS, POINTS, VALUES, deviators_and_dilatation, stress_force};
use crate::material::lanes::{Lanes, Pack, lanes_of};

impl Body {
    /// Forces on the corners; VARYING: whether the moduli depend on temperature.
    #[inline(always)]
    pub(super) fn small_strain_force<const W: usize, V: Pack, const VARYING: bool>(
        &mut self,
        e: usize,
        first: usize,
        displacement: &[[V; VALUES]; CORNERS],
        rise: Option<&[f64]>,
    ) -> [[V; VALUES]; CORNERS] {
        let at = e * self.mesh.sectors.columns() + first;
        let heat = self.element_heat::<W>(e, first, rise, VARYING);
        let (deviators, dilatation) = deviators_and_dilatation(&self.mesh.elements[e], displacement);
        let dilatation: Lanes<W> = lanes_of(dilatation);
        let mut mean_stress = [0.0; W];
        for l in 0..W {
            mean_stress[l] = self.solid.moduli.bulk * (dilatation[l] - heat.thermal[l]);
        }
        if let Some(stiffness) = &heat.stiffness {
            (0..W).for_each(|l| mean_stress[l] *= stiffness[l]);
            self.tangent.stiffness[at..at + W].copy_from_slice(stiffness);
        }
        self.trial.mean_stress[at..at + W].copy_from_slice(&mean_stress);
        self.trial.rise[at..at + W].copy_from_slice(&heat.mean_rise);
        let mean_stress = V::load(&mean_stress);
        let mut stresses = [[mean_stress; TENSOR]; POINTS];
        let (stale, mut flows) = (self.tangent.flows[at], false);
        for q in 0..POINTS {
            let (stress, flowing) =
                self.point_stress::<W, V>(e, q, first, &deviators[q], heat.at_point(q), stale);
            flows |= flowing;
            let weight = V::splat(self.mesh.elements[e].weight[q]);
            for (i, (joined, &deviatoric)) in stresses[q].iter_mut().zip(&stress).enumerate() {
                *joined = weight * if i < 3 { deviatoric + mean_stress } else { deviatoric };
            }
        }
        self.tangent.flows[at] = flows;
        stress_force(&self.mesh.elements[e], &stresses)
    }
}
