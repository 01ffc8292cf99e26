//! Extrapolation of tables towards the Hertz limit, see `tables::interpolation`: 4340 steel that slides elastically.

use rayon::prelude::*;
use tables::interpolation::{UNCERTAINTY_OF_KEPT_RATIO, UPLIFT};

use super::{Fit, FittedConstant, Residual, rms, slid, through_origin};
use crate::loading::problem::Problem;
use crate::scene::FrictionLaw;
use crate::simulate::{SimulationError, Watch};
use crate::studies::verification::setup::{Hertz, mesh, scene, steel_4340};

/// P over that of Hertz after a slide well past inception.
fn load_ratio(
    interference: f64,
    strength_factor: f64,
    slip_rate: f64,
    elements: usize,
    watch: &dyn Watch,
) -> Result<f64, SimulationError> {
    let mut scene = scene(steel_4340(), FrictionLaw::ShearStrength, interference, mesh(elements, 4));
    scene.interface.strength_factor = strength_factor;
    scene.interface.heat_partition = 0.5;
    // Heat needs longer than partial slip.
    scene.loading.slip_distance = if slip_rate > 0.0 { 2.0 } else { 0.05 };
    let [_, last] = slid(&scene, slip_rate, watch)?;
    Ok(Problem::new(&scene).units.force() * last.load / Hertz::of(&scene).load)
}

/// Friction-induced uplift without heat.
pub(super) fn uplift(watch: &dyn Watch) -> Result<Fit, SimulationError> {
    let cases = [(0.5, 1.0), (0.2, 1.0), (0.1, 1.0), (0.05, 1.0), (0.03, 1.0), (0.05, 0.5)];
    let row = |&(interference, factor): &(f64, f64)| {
        Ok([factor * factor / interference, 1.0 - load_ratio(interference, factor, 0.0, 24, watch)?])
    };
    let rows: Vec<[f64; 2]> = cases.par_iter().map(row).collect::<Result<_, SimulationError>>()?;
    let fitted = through_origin(&rows);
    let residuals = cases.iter().zip(&rows).map(|((interference, factor), [x, y])| Residual {
        of: format!("1 - P/P_Hertz = {y:.4} at {interference} omega_c, f = {factor}"),
        points: 1,
        stored: (UPLIFT * x - y).abs(),
        fitted: (fitted * x - y).abs(),
    });
    Ok(Fit {
        name: "Uplift by friction",
        method: "Least squares of 1 - P/P_Hertz over f^2 omega_c/omega; 4340 steel, slip rate 0, 24 elements.",
        residuals: residuals.collect(),
        constants: vec![FittedConstant { name: "UPLIFT", stored: UPLIFT, fitted }],
    })
}

/// Change of the ratio to the elastic sphere below a first row at 0.1 ω_c, at 10 m/s.
pub(super) fn kept_ratio(watch: &dyn Watch) -> Result<Fit, SimulationError> {
    let interferences = [0.1, 0.07, 0.05, 0.03];
    let ratio = |&interference: &f64| load_ratio(interference, 1.0, 10.0, 8, watch);
    let ratios: Vec<f64> = interferences.par_iter().map(ratio).collect::<Result<_, SimulationError>>()?;
    let (first, first_ratio) = (interferences[0], ratios[0]);
    let rows: Vec<[f64; 2]> = (interferences.iter().zip(&ratios).skip(1))
        .map(|(interference, ratio)| {
            [(first_ratio - 1.0).abs() * (1.0 - (interference / first).sqrt()), (ratio - first_ratio).abs()]
        })
        .collect();
    // An uncertainty covers every change.
    let fitted = rows.iter().map(|[x, y]| y / x).fold(0.0, f64::max);
    let uncovered = |constant: f64| rms(rows.iter().map(|[x, y]| (y - constant * x).max(0.0)));
    let stored = UNCERTAINTY_OF_KEPT_RATIO;
    Ok(Fit {
        name: "Constant ratio to the elastic sphere",
        method: "Largest change of P/P_Hertz from 0.1 to 0.07, 0.05 and 0.03 omega_c over \
                 |P/P_Hertz - 1| (1 - sqrt(omega/omega_1)) at 0.1 omega_c; 4340 steel at 10 m/s, 8 elements.",
        constants: vec![FittedConstant { name: "UNCERTAINTY_OF_KEPT_RATIO", stored, fitted }],
        residuals: vec![Residual {
            of: format!("change of P/P_Hertz from {first_ratio:.3} that is not covered"),
            points: rows.len(),
            stored: uncovered(stored),
            fitted: uncovered(fitted),
        }],
    })
}
