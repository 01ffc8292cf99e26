//! Internal force of an element at small strain.
//!
//! Stress at a Gauss point: deviator s = 2G(e − e_p), mean stress p = K(ε̄_v − 3∫α dθ̄), where the dilatation ε̄_v and
//! the temperature rise θ̄ are means over the element (B̄).

use super::TENSOR;
use super::packing::{joined, unpack};
use super::part::Part;
use super::point_stress::Points;
use crate::discretisation::element::{CORNERS, POINTS, VALUES, deviators_and_dilatation, stress_force};
use crate::material::lanes::{Lanes, Pack, lanes_of};

impl Part<'_> {
    /// Forces on the corners; W angles at a time, which fill A, and P points of them, which fill the N lanes of V.
    /// VARYING: whether the moduli depend on temperature.
    #[inline(always)]
    pub(super) fn small_strain_force<
        const W: usize,
        const P: usize,
        const N: usize,
        A: Pack,
        V: Pack,
        const VARYING: bool,
    >(
        &mut self,
        e: usize,
        first: usize,
        displacement: &[[A; VALUES]; CORNERS],
        rise: Option<&[f64]>,
    ) -> [[A; VALUES]; CORNERS] {
        let lanes = self.mesh.sectors.columns();
        let at = e * lanes + first;
        let heat = self.element_heat::<W>(e, first, rise, VARYING);
        let (deviators, dilatation) = deviators_and_dilatation(&self.elements[e], displacement);
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
        let mean_stress = A::load(&mean_stress);
        let mut stresses = [[mean_stress; TENSOR]; POINTS];
        let mut flows = false;
        for chunk in (0..POINTS).step_by(P) {
            let mut deviator = [V::splat(0.0); TENSOR];
            for (i, component) in deviator.iter_mut().enumerate() {
                let mut of_points = [A::splat(0.0); P];
                (0..P).for_each(|p| of_points[p] = deviators[chunk + p][i]);
                *component = joined::<W, A, V>(&of_points);
            }
            let (stress, flowing) =
                self.point_stress::<W, N, V>(Points { e, chunk, first, lanes }, &deviator, &heat);
            flows |= flowing;
            for p in 0..P {
                let weight = A::splat(self.elements[e].weight[chunk + p]);
                for i in 0..TENSOR {
                    let deviatoric = A::load(&unpack::<W, V>(stress[i], p));
                    stresses[chunk + p][i] =
                        weight * if i < 3 { deviatoric + mean_stress } else { deviatoric };
                }
            }
        }
        self.tangent.flows[at] = flows;
        stress_force(&self.elements[e], &stresses)
    }
}
