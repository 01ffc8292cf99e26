//! Fits of constants, repeated: each runs its data again, fits the constants anew, and compares them with those stored
//! in `scene::fitted_constants` and `tables::interpolation` (book, "Errors of a run"). Called by `asperity calibrate`.
//! Depends on every room below it.

mod contact_edge;
mod expected_effects;
mod hertz_limit;
mod order;

use crate::interface::contact::Contact;
use crate::loading::press::press_on;
use crate::loading::problem::Problem;
use crate::loading::state::SlideState;
use crate::scene::{Numerics, Scene};
use crate::simulate::accuracy::resolution::Resolution;
use crate::simulate::{SimulationError, Watch, press_error, run_history};

/// A constant, as stored and as fitted anew.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedConstant {
    pub name: &'static str,
    pub stored: f64,
    pub fitted: f64,
}

/// A residual of the stored constants, and of those fitted anew.
#[derive(Clone, Debug, PartialEq)]
pub struct Residual {
    /// Data that the residual is of, and its unit.
    pub of: String,
    pub points: usize,
    /// Root mean square.
    pub stored: f64,
    pub fitted: f64,
}

/// One fit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fit {
    pub name: &'static str,
    /// Method: fitted quantity and data.
    pub method: &'static str,
    pub constants: Vec<FittedConstant>,
    pub residuals: Vec<Residual>,
}

/// Repeats every fit; some minutes.
pub fn fits(watch: &dyn Watch) -> Result<Vec<Fit>, SimulationError> {
    let fits = [
        contact_edge::fit,
        order::elastic_load,
        expected_effects::plastic_strain,
        expected_effects::heat_effect,
        hertz_limit::uplift,
        hertz_limit::kept_ratio,
    ];
    fits.iter().map(|fit| fit(watch)).collect()
}

/// The fits as Markdown.
pub fn markdown(fits: &[Fit]) -> String {
    let mut text = String::new();
    for Fit { name, method, constants, residuals } in fits {
        text += &format!("## {name}\n\n{method}\n\n| constant | stored | fitted |\n|---|---|---|\n");
        for FittedConstant { name, stored, fitted } in constants {
            text += &format!("| {name} | {stored:.4} | {fitted:.4} |\n");
        }
        text.push_str("\n| residual (rms) | points | stored | fitted |\n|---|---|---|---|\n");
        for Residual { of, points, stored, fitted } in residuals {
            text += &format!("| {of} | {points} | {stored:.4} | {fitted:.4} |\n");
        }
        text.push('\n');
    }
    text
}

/// Increments of a press.
const INCREMENTS: usize = 40;

/// The contact after a press on a mesh laid out for `contact_radius`, over R, whatever the radius that is reached.
fn pressed(
    scene: &Scene,
    contact_radius: f64,
    elements: usize,
    watch: &dyn Watch,
) -> Result<Contact, SimulationError> {
    let problem = Problem::new(scene);
    let numerics = Numerics { elements_per_radius: Some(elements), ..scene.numerics.clone() };
    let size = Resolution::choose(&numerics).mesh_size(contact_radius);
    let (mechanics, _) = press_on(&problem, size, INCREMENTS, &|| watch.cancelled()).map_err(press_error)?;
    Ok(mechanics.into_parts().1)
}

/// First and last state of one slide at the resolution of the scene.
fn slid(scene: &Scene, slip_rate: f64, watch: &dyn Watch) -> Result<[SlideState; 2], SimulationError> {
    let history = run_history(scene, slip_rate, &Resolution::choose(&scene.numerics), watch)?.slide;
    Ok([history[0], history[history.len() - 1]])
}

/// Root mean square.
fn rms(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len().max(1) as f64;
    (values.map(|x| x * x).sum::<f64>() / count).sqrt()
}

/// Least squares of y = a x over rows (x, y).
fn through_origin(rows: &[[f64; 2]]) -> f64 {
    let sum = |of: fn(&[f64; 2]) -> f64| rows.iter().map(of).sum::<f64>();
    sum(|[x, y]| x * y) / sum(|[x, _]| x * x)
}

/// Least squares of y = a f + b g over rows (f, g, y): (a, b).
fn two_terms(rows: &[[f64; 3]]) -> [f64; 2] {
    let sum = |of: fn(&[f64; 3]) -> f64| rows.iter().map(of).sum::<f64>();
    let (ff, fg, gg) = (sum(|r| r[0] * r[0]), sum(|r| r[0] * r[1]), sum(|r| r[1] * r[1]));
    let (fy, gy) = (sum(|r| r[0] * r[2]), sum(|r| r[1] * r[2]));
    let determinant = ff * gg - fg * fg;
    [(gg * fy - fg * gy) / determinant, (ff * gy - fg * fy) / determinant]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_terms_are_found() {
        let rows: Vec<[f64; 3]> =
            [0.1f64, 0.4, 0.8].iter().map(|t| [*t, t * t, 0.7 * t - 0.3 * t * t]).collect();
        let [a, b] = two_terms(&rows);
        assert!((a - 0.7).abs() < 1e-12 && (b + 0.3).abs() < 1e-12);
        assert!((through_origin(&[[1.0, 2.5], [2.0, 3.5]]) - 1.9).abs() < 1e-12);
        assert_eq!(rms([3.0, -4.0].into_iter()), 12.5f64.sqrt());
    }
}
