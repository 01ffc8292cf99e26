//! `asperity calibrate`: fits of constants, repeated.

use asperity::studies::calibration::{fits, markdown};

use super::progress::watched;
use super::{Display, Failure, print};

/// Repeat the fits and print constants and residuals.
pub fn calibrate(display: &Display) -> Result<(), Failure> {
    let fits = watched(display, |progress| fits(progress)).map_err(Failure::run)?;
    print(&markdown(&fits))
}
