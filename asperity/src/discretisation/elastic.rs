//! Linear isotropic elasticity on the revolved mesh: element stiffness and matrix-free product.

use crate::discretisation::element::{
    CORNERS, Element, RevolvedMesh, VALUES, deviators_and_dilatation, stress_force,
};
use crate::material::elasticity::Moduli;
use crate::material::lanes::Pack;

/// Forces of an element from the values of its corners, elastic.
#[inline(always)]
pub fn element_force<V: Pack>(
    element: &Element,
    moduli: Moduli,
    values: &[[V; VALUES]; CORNERS],
) -> [[V; VALUES]; CORNERS] {
    let (mut stress, dilatation) = deviators_and_dilatation(element, values);
    for (stress, &weight) in stress.iter_mut().zip(&element.weight) {
        let (shear, mean) =
            (V::splat(2.0 * moduli.shear * weight), V::splat(moduli.bulk * weight) * dilatation);
        for (i, component) in stress.iter_mut().enumerate() {
            *component = if i < 3 { shear.mul_add(*component, mean) } else { shear * *component };
        }
    }
    stress_force(element, &stress)
}

/// Stiffness of element e for harmonic m, 12 × 12 over (corner, component): u_r and u_z with
/// cos mθ, u_θ with sin mθ.
pub fn element_stiffness(mesh: &RevolvedMesh, e: usize, moduli: Moduli, m: usize) -> Vec<f64> {
    // ∂/∂θ takes cos mθ to −m sin mθ and sin mθ to m cos mθ.
    let slope = [-(m as f64), m as f64, -(m as f64)];
    let mut matrix = vec![0.0; 12 * 12];
    for j in 0..12 {
        let mut unit = [[0.0; VALUES]; CORNERS];
        unit[j / 3][j % 3] = 1.0;
        unit[j / 3][j % 3 + 3] = slope[j % 3];
        let force = element_force::<f64>(&mesh.elements[e], moduli, &unit);
        for i in 0..12 {
            let f = &force[i / 3];
            matrix[i * 12 + j] = f[i % 3] + slope[i % 3] * f[i % 3 + 3];
        }
    }
    matrix
}
