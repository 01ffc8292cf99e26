//! Subtracts the form of a topography by least squares.

use super::Topography;
use nalgebra::{DMatrix, DVector};

/// Trend that is subtracted before anything is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Detrend {
    /// The mean height.
    Mean,
    /// The mean plane, of a profile the mean line.
    Plane,
    /// The mean paraboloid, for curved specimens.
    Quadratic,
}

/// Rms height over that with the trend below which it is rounding.
const NO_ROUGHNESS: f64 = 1e-11;

impl Detrend {
    /// Takes the trend off; rms height of what is left, m.
    pub(super) fn level(self, topography: &mut Topography) -> Result<f64, String> {
        let with_trend = topography.mean_square().sqrt();
        self.subtract(topography);
        let rms_height = topography.mean_square().sqrt();
        if with_trend.is_finite() && rms_height <= NO_ROUGHNESS * with_trend {
            let trend = format!("{self:?}").to_lowercase();
            return Err(format!(
                "no roughness is left without the trend ({trend}): the heights are those of the trend, within rounding"
            ));
        }
        Ok(rms_height)
    }

    fn powers(self, profile: bool) -> &'static [(i32, i32)] {
        match (self, profile) {
            (Self::Mean, _) => &[(0, 0)],
            (Self::Plane, true) => &[(0, 0), (0, 1)],
            (Self::Plane, false) => &[(0, 0), (0, 1), (1, 0)],
            (Self::Quadratic, true) => &[(0, 0), (0, 1), (0, 2)],
            (Self::Quadratic, false) => &[(0, 0), (0, 1), (1, 0), (0, 2), (1, 1), (2, 0)],
        }
    }

    /// Subtracts the trend.
    pub(super) fn subtract(self, topography: &mut Topography) {
        let (rows, columns) = (topography.rows, topography.columns);
        let powers = self.powers(topography.is_profile());
        // Coordinates from −1 to 1 keep the normal equations well scaled.
        let coordinate = |index: usize, count: usize| match count {
            1 => 0.0,
            _ => 2.0 * index as f64 / (count - 1) as f64 - 1.0,
        };
        let terms = |place: usize| {
            let (y, x) = (coordinate(place / columns, rows), coordinate(place % columns, columns));
            powers.iter().map(move |&(of_y, of_x)| y.powi(of_y) * x.powi(of_x))
        };
        let count = powers.len();
        let (mut normal, mut right) = (DMatrix::zeros(count, count), DVector::zeros(count));
        for (place, height) in topography.heights.iter().enumerate() {
            let row = DVector::from_iterator(count, terms(place));
            normal.ger(1.0, &row, &row, 1.0);
            right.axpy(*height, &row, 1.0);
        }
        let coefficients = normal.cholesky().expect("powers on a grid are independent").solve(&right);
        for (place, height) in topography.heights.iter_mut().enumerate() {
            *height -= terms(place).zip(&coefficients).map(|(term, factor)| term * factor).sum::<f64>();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn form_comes_off_and_roughness_stays() {
        let (rows, columns) = (9, 12);
        let form = |r: f64, c: f64| 3.0 + 0.2 * c - 0.7 * r + 0.03 * r * c + 0.05 * c * c - 0.01 * r * r;
        let heights: Vec<f64> =
            (0..rows * columns).map(|p| form((p / columns) as f64, (p % columns) as f64)).collect();
        let map = |heights| Topography::map((rows, 1.0), (columns, 1.0), heights);
        let mut curved = map(heights);
        Detrend::Quadratic.subtract(&mut curved);
        assert!(curved.heights.iter().all(|z| z.abs() < 1e-12));
        let mut rough = map((0..rows * columns).map(|p| f64::from(p % 2 == 0)).collect());
        Detrend::Plane.subtract(&mut rough);
        assert!((rough.mean_square() - 0.25).abs() < 0.01, "{}", rough.mean_square());
    }

    #[test]
    fn a_plane_has_no_roughness() {
        let slope = |place: usize| 1e-8 * (place % 64) as f64;
        let mut plane = Topography::map((32, 1e-6), (64, 1e-6), (0..32 * 64).map(slope).collect());
        assert!(Detrend::Plane.level(&mut plane.clone()).unwrap_err().contains("(plane)"));
        plane.heights[70] += 1e-13;
        assert!(Detrend::Plane.level(&mut plane).is_ok());
    }
}
