//! The motions of the flat that make up a slide: slip at a constant rate, and holds.

use crate::loading::problem::Units;
use crate::scene::LoadingStep;

/// A step of the programme of a slide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// Slip at V in m/s, `speed` = VR/κ, by `distance` (in R); `speed` and V are negative backwards, and 0 in the isothermal
    /// limit.
    Slip { slip_rate: f64, speed: f64, distance: f64 },
    /// Hold for a time, over R²/κ.
    Hold { time: f64 },
}

impl Motion {
    /// Dimensionless motion of a step of the programme, for the contact radius `radius` (over R) after the press.
    pub fn new(step: &LoadingStep, radius: f64, units: &Units) -> Self {
        match *step {
            LoadingStep::Slip { slip_rate, slip_distance } => {
                Self::Slip { slip_rate, speed: slip_rate / units.speed(), distance: slip_distance * radius }
            }
            LoadingStep::Hold { hold } => Self::Hold { time: hold / units.time },
        }
    }

    /// Distance, or time of a hold.
    pub fn length(&self) -> f64 {
        match *self {
            Self::Slip { distance, .. } => distance,
            Self::Hold { time } => time,
        }
    }

    /// Change of the displacement of the flat per length: 1, −1 backwards, 0 in a hold.
    pub fn direction(&self) -> f64 {
        match *self {
            Self::Slip { speed, .. } if speed < 0.0 => -1.0,
            Self::Slip { .. } => 1.0,
            Self::Hold { .. } => 0.0,
        }
    }

    /// Time that a part of the length takes; 0 in the isothermal limit.
    pub fn time(&self, length: f64) -> f64 {
        match *self {
            Self::Slip { speed: 0.0, .. } => 0.0,
            Self::Slip { speed, .. } => length / speed.abs(),
            Self::Hold { .. } => length,
        }
    }

    /// Slip rate in m/s, positive; 0 in a hold.
    pub fn slip_rate(&self) -> f64 {
        match *self {
            Self::Slip { slip_rate, .. } => slip_rate.abs(),
            Self::Hold { .. } => 0.0,
        }
    }

    /// Time of a part of the length, in s, for the strain rate; infinite in the isothermal limit.
    pub fn seconds(&self, length: f64, units: &Units) -> f64 {
        match self {
            Self::Slip { slip_rate, .. } => length * units.length / slip_rate.abs(),
            Self::Hold { .. } => length * units.time,
        }
    }
}
