//! `asperity calibrate`: fits of constants, repeated.

use asperity::studies::calibration::{fits, markdown};

use super::progress::{Progress, watch_for_interrupt};
use super::{Display, Failure, print};

/// Repeat the fits and print constants and residuals.
pub fn calibrate(display: &Display) -> Result<(), Failure> {
    watch_for_interrupt();
    let progress = Progress::new(display);
    let fits = fits(&progress).map_err(Failure::run)?;
    progress.clear();
    print(&markdown(&fits))
}
