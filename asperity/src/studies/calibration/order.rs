//! Order of convergence in the elements that the error estimates take, see `simulate::accuracy::error_budget`.

use super::{Fit, FittedConstant, Residual, pressed, rms};
use crate::loading::problem::Problem;
use crate::scene::FrictionLaw;
use crate::scene::fitted_constants::error_estimates::ORDER;
use crate::simulate::{SimulationError, Watch};
use crate::studies::verification::setup::{Hertz, mesh, plain_material, scene};

/// Slope of the regression line of y over x, with the rms of the misfits, and that of the best line of slope `stored`.
fn slope(points: &[(f64, f64)], stored: f64) -> (f64, [f64; 2]) {
    let count = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / count;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let products = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>();
    let fitted = products / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>();
    let misfit = |slope: f64| rms(points.iter().map(|p| p.1 - y - slope * (p.0 - x)));
    (fitted, [misfit(stored), misfit(fitted)])
}

/// Load of an elastic frictionless press against Hertz.
pub(super) fn elastic_load(watch: &dyn Watch) -> Result<Fit, SimulationError> {
    let scene = scene(plain_material(0.3), FrictionLaw::Frictionless, 0.3, mesh(8, 4));
    let hertz = Hertz::of(&scene);
    let mut points = Vec::new();
    for elements in [6, 8, 12, 16, 24] {
        let contact = pressed(&scene, hertz.contact_radius / scene.radius, elements, watch)?;
        let load = Problem::new(&scene).units.force() * contact.load(&contact.committed);
        points.push(((elements as f64).ln(), (load / hertz.load - 1.0).abs().ln()));
    }
    let (fitted, [of_stored, of_fitted]) = slope(&points, -ORDER);
    Ok(Fit {
        name: "Order of convergence",
        method: "Regression of ln |P/P_Hertz - 1| over ln n_c on 6, 8, 12, 16 and 24 elements, 0.3 omega_c.",
        constants: vec![FittedConstant { name: "ORDER", stored: ORDER, fitted: -fitted }],
        residuals: vec![Residual {
            of: "ln of the relative error of P".to_owned(),
            points: points.len(),
            stored: of_stored,
            fitted: of_fitted,
        }],
    })
}
