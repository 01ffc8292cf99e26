//! Section `[loading]`: interference, and the slide that follows, at one slip rate or through a programme.

use serde::{Deserialize, Serialize};

/// What stays constant while the flat slides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Control {
    #[default]
    Interference,
    Load,
}

/// Section `[loading]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Loading {
    /// ω₀/ω_c; where `load` is given, that of a closed form, which the simulation begins its search with.
    pub interference: f64,
    /// P at the end of the press, N, in place of an interference.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub load: Option<f64>,
    /// V, m/s; 0 is the isothermal limit. Of a programme the largest magnitude.
    pub slip_rate: f64,
    /// Slip distance in contact radii a₀ at the end of the press; infinite for `"steady"`. Of a programme the sum of its steps.
    #[serde(default = "default_slip_distance", with = "until_steady")]
    pub slip_distance: f64,
    /// Slip in contact radii a₀ at the slip rate of the first step, in whose time the contact forms; none where the press is
    /// quasi-static.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub press_slip_distance: Option<f64>,
    #[serde(default)]
    pub control: Control,
    /// Initial temperature T₀ of body and flat, K.
    #[serde(default = "default_temperature")]
    pub temperature: f64,
    /// A programme in place of one slip rate; see [`Loading::with_steps`].
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub steps: Vec<LoadingStep>,
}

/// A step of a programme.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum LoadingStep {
    /// V, m/s, negative against the direction of the first step, over a distance in contact radii a₀.
    Slip { slip_rate: f64, slip_distance: f64 },
    /// The flat rests for a time, s.
    Hold { hold: f64 },
}

impl Loading {
    /// This loading with the programme `steps`, whose first step slides.
    pub fn with_steps(self, steps: Vec<LoadingStep>) -> Self {
        let (slip_rate, slip_distance) = extent(&steps);
        Self { slip_rate, slip_distance, steps, ..self }
    }

    /// The programme; without one a single step at the slip rate `slip_rate`, m/s.
    pub fn programme(&self, slip_rate: f64) -> Vec<LoadingStep> {
        match self.steps.is_empty() {
            true => vec![LoadingStep::Slip { slip_rate, slip_distance: self.slip_distance }],
            false => self.steps.clone(),
        }
    }

    /// Input that is given so that a simulation has to find a number first, as one of several slides from one press cannot.
    pub fn to_be_found(&self) -> Option<&'static str> {
        match self.load {
            Some(_) => Some("loading.load"),
            None => self.is_until_steady().then_some("loading.slip_distance = \"steady\""),
        }
    }

    /// Time of the press, s, of a contact of radius a₀ (m): infinite where it is quasi-static.
    pub fn press_time(&self, contact_radius: f64) -> f64 {
        self.press_slip_distance
            .map_or(f64::INFINITY, |distance| distance * contact_radius / self.first_slip_rate())
    }

    /// Whether the slide goes on until friction is steady.
    pub fn is_until_steady(&self) -> bool {
        self.slip_distance == f64::INFINITY
    }

    /// Slip rate of the first step, m/s.
    pub fn first_slip_rate(&self) -> f64 {
        self.steps.first().map_or(self.slip_rate, |step| step.slip_rate())
    }
}

/// A slip distance in files: a number or `"steady"`.
mod until_steady {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    #[derive(Serialize, Deserialize)]
    #[serde(untagged)]
    enum Distance {
        Radii(f64),
        Until(Steady),
    }

    #[derive(Serialize, Deserialize)]
    #[serde(rename_all = "lowercase")]
    enum Steady {
        Steady,
    }

    pub fn serialize<S: Serializer>(distance: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        match *distance {
            f64::INFINITY => Distance::Until(Steady::Steady),
            radii => Distance::Radii(radii),
        }
        .serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Distance::deserialize(deserializer).map(|distance| match distance {
            Distance::Radii(radii) => radii,
            Distance::Until(Steady::Steady) => f64::INFINITY,
        })
    }
}

impl LoadingStep {
    /// V, m/s; 0 in a hold.
    pub fn slip_rate(&self) -> f64 {
        match *self {
            Self::Slip { slip_rate, .. } => slip_rate,
            Self::Hold { .. } => 0.0,
        }
    }
}

/// Largest slip rate (magnitude) and total slip of a programme.
pub(crate) fn extent(steps: &[LoadingStep]) -> (f64, f64) {
    let distance = |step: &LoadingStep| match *step {
        LoadingStep::Slip { slip_distance, .. } => slip_distance,
        LoadingStep::Hold { .. } => 0.0,
    };
    let fastest = steps.iter().map(|step| step.slip_rate().abs()).fold(0.0, f64::max);
    (fastest, steps.iter().map(distance).sum())
}

impl std::fmt::Display for LoadingStep {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        use tables::numbers::plain;
        match *self {
            Self::Slip { slip_rate, slip_distance } => {
                write!(f, "{} m/s over {} a0", plain(slip_rate), plain(slip_distance))
            }
            Self::Hold { hold } => write!(f, "hold {} s", plain(hold)),
        }
    }
}

pub(crate) fn default_slip_distance() -> f64 {
    2.0
}

pub(crate) fn default_temperature() -> f64 {
    298.0
}
