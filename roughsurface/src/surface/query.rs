//! A rough surface and the query: loading, slip rates, loading control.

use crate::surface::heights::Heights;
use crate::surface::radii::Radii;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::str::FromStr;
use tables::law::{AsperityLaw, LookupError, covers};
use tables::numbers::rounded;

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

/// Normal loading of the surface.
#[derive(Clone, Debug, PartialEq)]
pub enum NormalLoading {
    /// Nominal pressures, Pa.
    Pressure(Vec<f64>),
    /// Separations before the slide, m.
    Separation(Vec<f64>),
}

impl NormalLoading {
    /// Heading of a column of the values.
    pub fn heading(&self) -> &'static str {
        match self {
            Self::Pressure(_) => "pressure [Pa]",
            Self::Separation(_) => "separation before sliding [m]",
        }
    }

    /// The values, Pa or m.
    pub fn values(&self) -> &[f64] {
        match self {
            Self::Pressure(values) | Self::Separation(values) => values,
        }
    }

    /// One row alone.
    pub fn only(&self, row: usize) -> Self {
        match self {
            Self::Pressure(values) => Self::Pressure(vec![values[row]]),
            Self::Separation(values) => Self::Separation(vec![values[row]]),
        }
    }

    /// The value of one row in words.
    pub fn describe(&self, row: usize) -> String {
        match self {
            Self::Pressure(values) => format!("{:e} Pa", rounded(values[row], 6)),
            Self::Separation(values) => format!("a separation of {:e} m", rounded(values[row], 6)),
        }
    }
}

/// Loading control of the slide: constant nominal load or constant separation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum LoadingControl {
    #[default]
    Load,
    Separation,
}

/// Slip over which a contact lasts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactLife {
    /// A life in diameters of the contact: between two rough faces about one.
    Diameters(f64),
    /// Against a smooth flat the summits stay in contact: until friction is steady.
    Steady,
}

impl Default for ContactLife {
    fn default() -> Self {
        Self::Diameters(1.0)
    }
}

impl FromStr for ContactLife {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match (text, text.parse::<f64>()) {
            ("steady", _) => Ok(Self::Steady),
            (_, Ok(diameters)) if diameters > 0.0 && diameters.is_finite() => Ok(Self::Diameters(diameters)),
            _ => Err(format!("{text} must be a positive number (contact diameters) or steady")),
        }
    }
}

impl fmt::Display for ContactLife {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Diameters(diameters) => write!(formatter, "{diameters}"),
            Self::Steady => formatter.write_str("steady"),
        }
    }
}

/// A number, or "steady".
impl Serialize for ContactLife {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Diameters(diameters) => serializer.serialize_f64(*diameters),
            Self::Steady => serializer.serialize_str("steady"),
        }
    }
}

impl<'de> Deserialize<'de> for ContactLife {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged, expecting = "a positive number (contact diameters) or \"steady\"")]
        enum Given {
            Number(f64),
            Name(String),
        }
        let text = match Given::deserialize(deserializer)? {
            Given::Number(number) => number.to_string(),
            Given::Name(name) => name,
        };
        text.parse().map_err(D::Error::custom)
    }
}

/// Elastic interaction of the summits: none, or the nominal pressure displaces the mean plane of a square nominal area.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, Serialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Interaction {
    #[default]
    None,
    MeanPressure,
}

/// Loading, slip rates and loading control of a prediction.
#[derive(Clone, Debug, PartialEq)]
pub struct Query {
    pub loading: NormalLoading,
    /// Slip rates, m/s.
    pub slip_rates: Vec<f64>,
    pub control: LoadingControl,
    pub contact_life: ContactLife,
    pub interaction: Interaction,
    /// Side of the square nominal area, m.
    pub nominal_size: Option<f64>,
    /// Slip rates before and after a step, m/s.
    pub rate_step: Option<[f64; 2]>,
}

impl Query {
    /// A query with the default values of the other keys.
    pub fn new(loading: NormalLoading, slip_rates: Vec<f64>) -> Self {
        Self {
            loading,
            slip_rates,
            control: LoadingControl::default(),
            contact_life: ContactLife::default(),
            interaction: Interaction::default(),
            nominal_size: None,
            rate_step: None,
        }
    }

    /// Pressure (Pa) or separation (m) and slip rate (m/s) of every cell, row by row.
    pub fn cells(&self) -> impl Iterator<Item = (f64, f64)> {
        let of_row = |&load: &f64| self.slip_rates.iter().map(move |&rate| (load, rate));
        self.loading.values().iter().flat_map(of_row)
    }

    /// Refuses slip rates outside the range of the law that all `radii` have.
    pub fn check_slip_rates(&self, law: &dyn AsperityLaw, radii: &Radii) -> Result<(), LookupError> {
        let range @ (from, to) = radii.slip_rate_range(law);
        if let [(_, smallest), .., (_, largest)] = radii.classes[..]
            && from > to
        {
            return Err(LookupError::NoSlipRateInCommon { smallest, largest });
        }
        let rates = self.slip_rates.iter().chain(self.rate_step.iter().flatten());
        // A table for the farthest covers the others on its side.
        let distance = |rate: &f64| (rate / to).max(from / rate);
        let outside = rates.filter(|rate| !covers(range, **rate));
        match outside.max_by(|a, b| distance(a).total_cmp(&distance(b))) {
            Some(&slip_rate) => Err(LookupError::SlipRateOutside { slip_rate, from, to }),
            None => Ok(()),
        }
    }
}
