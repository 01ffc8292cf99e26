//! Expected effects of a slide, by which a run chooses its model before it slides: the plastic strain that the slide
//! adds, see `simulate::strain`, and the change of the load by thermal expansion, see `heat::expected`.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::{Fit, FittedConstant, Residual, rms, slid, through_origin};
use crate::heat::expected::HeatEffect;
use crate::loading::problem::Problem;
use crate::scene::fitted_constants::heat_effect::LOAD_OF_EXPANSION;
use crate::scene::fitted_constants::plastic_strain_of_slide::{ADDED, EXPONENT};
use crate::scene::{FrictionLaw, Scene, Softening};
use crate::simulate::{SimulationError, Watch};
use crate::studies::verification::setup::{mesh, preset, scene};

/// Material, ω₀/ω_c, f.
const SLIDES: [(&str, f64, f64); 16] = [
    ("steel-4340", 0.05, 0.8),
    ("steel-4340", 0.05, 1.0),
    ("steel-4340", 0.15, 1.0),
    ("steel-4340", 5.0, 1.0),
    ("copper", 0.4, 1.0),
    ("copper", 5.0, 1.0),
    ("titanium-6al4v", 0.05, 1.0),
    ("titanium-6al4v", 1.0, 1.0),
    ("titanium-6al4v", 5.0, 0.8),
    ("titanium-6al4v", 5.0, 1.0),
    ("aluminium-6061", 0.05, 1.0),
    ("aluminium-6061", 0.4, 0.8),
    ("aluminium-6061", 2.0, 1.0),
    ("aluminium-6061", 5.0, 1.0),
    ("steel-304", 1.0, 1.0),
    ("steel-304", 5.0, 1.0),
];

/// Constants of the smallest bound: ln ε ≤ ln ADDED + EXPONENT x for all points (x, ln ε), with the smallest mean
/// excess. EXPONENT by a scan in steps of 0.01.
fn smallest_bound(points: &[(f64, f64)]) -> [f64; 2] {
    let mean = points.iter().map(|(x, _)| x).sum::<f64>() / points.len() as f64;
    let touching =
        |exponent: f64| points.iter().map(|(x, y)| y - exponent * x).fold(f64::NEG_INFINITY, f64::max);
    let scan = (0..=300).map(|step| 0.01 * f64::from(step));
    let exponent = scan
        .min_by(|a, b| (touching(*a) + a * mean).total_cmp(&(touching(*b) + b * mean)))
        .expect("a scan has steps");
    [touching(exponent).exp(), exponent]
}

pub(super) fn plastic_strain(watch: &dyn Watch) -> Result<Fit, SimulationError> {
    let added = |&(material, interference, strength): &(&str, f64, f64)| {
        let mut scene = scene(preset(material), FrictionLaw::ShearStrength, interference, mesh(6, 4));
        scene.interface.strength_factor = strength;
        scene.loading.slip_distance = 2.0;
        let [pressed, last] = slid(&scene, 0.0, watch)?;
        let strain = last.plastic_strain_max - pressed.plastic_strain_max;
        let unit = scene.material.yield_strength / scene.material.youngs_modulus.value;
        let unit = unit * (2.0 * strength - 1.0).powi(3);
        Ok(((1.0 + interference).ln(), (strain / unit).ln()))
    };
    let points: Vec<(f64, f64)> = SLIDES.par_iter().map(added).collect::<Result<_, SimulationError>>()?;
    let fitted = smallest_bound(&points);
    let excess = |[added, exponent]: [f64; 2]| -> Vec<f64> {
        points.iter().map(|(x, y)| added.ln() + exponent * x - y).collect()
    };
    let residual = |of: &str, part: fn(f64) -> f64| {
        let [stored, fitted] =
            [[ADDED, EXPONENT], fitted].map(|constants| rms(excess(constants).into_iter().map(part)));
        Residual { of: of.to_owned(), points: points.len(), stored, fitted }
    };
    Ok(Fit {
        name: "Plastic strain of a slide",
        method: "Smallest upper bound of the plastic strain that a slide by two contact radii adds: five materials, 0.05 \
                 to 5 omega_c, f = 0.8 and 1, slip rate 0, 6 elements, small strain.",
        constants: vec![
            FittedConstant { name: "ADDED", stored: ADDED, fitted: fitted[0] },
            FittedConstant { name: "EXPONENT", stored: EXPONENT, fitted: fitted[1] },
        ],
        residuals: vec![
            residual("ln of bound over strain", |excess| excess),
            residual("ln of strain over bound, where it is larger", |excess| (-excess).max(0.0)),
        ],
    })
}

/// Properties that do not depend on the temperature: expansion alone changes the load.
fn expanding(material: &str, interference: f64) -> Scene {
    let mut material = preset(material);
    material.softening = Softening::None;
    material.properties_mut().into_iter().for_each(|property| property.table = None);
    let mut scene = scene(material, FrictionLaw::ShearStrength, interference, mesh(6, 4));
    scene.interface.heat_partition = 0.5;
    scene.loading.slip_distance = 2.0;
    scene
}

pub(super) fn heat_effect(watch: &dyn Watch) -> Result<Fit, SimulationError> {
    /// Expansion over interference at which the load is taken: where heat is near to being neglected.
    const EXPANSION: f64 = 2e-4;
    let materials = ["steel-4340", "steel-1045", "copper"];
    let scenes = [0.5, 5.0, 40.0].map(|interference| materials.map(|name| expanding(name, interference)));
    let change = |scene: &Scene| {
        let [pressed, cold] = slid(scene, 0.0, watch)?;
        let area = Problem::new(scene).units.area() * pressed.area;
        let effect = HeatEffect::expected(scene, 1.0, (area / PI).sqrt());
        let [_, hot] = slid(scene, EXPANSION * LOAD_OF_EXPANSION / effect.load, watch)?;
        Ok([EXPANSION, hot.load / cold.load - 1.0])
    };
    let rows: Vec<[f64; 2]> =
        scenes.as_flattened().par_iter().map(change).collect::<Result<_, SimulationError>>()?;
    let fitted = through_origin(&rows);
    let misfit = |rows: &[[f64; 2]], constant: f64| rms(rows.iter().map(|[x, y]| y / x - constant));
    let residuals = rows.chunks(materials.len()).zip(&scenes).map(|(rows, [scene, ..])| Residual {
        of: format!("factor at {} omega_c, mean {:.2}", scene.loading.interference, through_origin(rows)),
        points: rows.len(),
        stored: misfit(rows, LOAD_OF_EXPANSION),
        fitted: misfit(rows, fitted),
    });
    Ok(Fit {
        name: "Load of thermal expansion",
        method: "Change of the load at constant interference over (1 + nu) alpha rise a/omega = 0.0002, with the rise of a disc \
                 source: 4340 and 1045 steel and copper without softening, 6 elements.",
        residuals: residuals.collect(),
        constants: vec![FittedConstant { name: "LOAD_OF_EXPANSION", stored: LOAD_OF_EXPANSION, fitted }],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smallest_bound_touches_the_largest_points() {
        // Two points on 0.5 (1 + ω)^1.2, the others below.
        let on = |x: f64, factor: f64| (x, 0.5f64.ln() + 1.2 * x + factor.ln());
        let [added, exponent] = smallest_bound(&[on(0.1, 1.0), on(0.5, 0.3), on(1.0, 0.6), on(1.8, 1.0)]);
        assert!((added - 0.5).abs() < 1e-12 && (exponent - 1.2).abs() < 1e-12, "{added} {exponent}");
    }
}
