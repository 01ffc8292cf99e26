//! A rough surface and what is asked of it.

use crate::surface::heights::Heights;
use crate::surface::radii::Radii;
use tables::law::{AsperityLaw, LookupError};

/// A rough surface.
#[derive(Debug)]
pub struct Surface {
    /// Summits per nominal area η, 1/m².
    pub asperity_density: f64,
    /// Radius of the summits R, m, or its distribution.
    pub asperity_radius: Radii,
    /// Heights of the summits.
    pub heights: Box<dyn Heights>,
}

/// What the surface is pressed with.
#[derive(Clone, Debug, PartialEq)]
pub enum Pressing {
    /// Nominal pressures, Pa.
    Pressure(Vec<f64>),
    /// Separations before the slide, m.
    Separation(Vec<f64>),
}

impl Pressing {
    /// The values, Pa or m.
    pub fn values(&self) -> &[f64] {
        match self {
            Self::Pressure(values) | Self::Separation(values) => values,
        }
    }

    /// The value of one row in words.
    pub fn describe(&self, row: usize) -> String {
        match self {
            Self::Pressure(values) => format!("{:e} Pa", values[row]),
            Self::Separation(values) => format!("a separation of {:e} m", values[row]),
        }
    }
}

/// What is held during the slide.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Hold {
    Load,
    Separation,
}

/// What is asked of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Query {
    pub pressing: Pressing,
    /// Slip rates, m/s.
    pub slip_rates: Vec<f64>,
    pub hold: Hold,
}

impl Query {
    /// Refuses slip rates outside the range of the law for any of the `radii`.
    pub fn check_slip_rates(&self, law: &dyn AsperityLaw, radii: &Radii) -> Result<(), LookupError> {
        for class in radii.classes() {
            let (from, to) = law.slip_rate_range(class.radius);
            if let Some(&slip_rate) = self.slip_rates.iter().find(|rate| !(from..=to).contains(*rate)) {
                return Err(LookupError::SlipRateOutside { slip_rate, from, to });
            }
        }
        Ok(())
    }
}
