//! The scalars of a run under the names that tables give them.

use tables::law::Estimate;
use tables::quantity::Quantity;

use crate::simulate::outcome::{InceptionCriterion, Summary};

/// Those by which a run is judged: the others follow from them, or are of the press alone.
pub const MAIN: [Quantity; 7] = [
    Quantity::Mu,
    Quantity::MuStatic,
    Quantity::Friction,
    Quantity::Load,
    Quantity::Area,
    Quantity::EnergyRelease,
    Quantity::TemperatureMax,
];

/// The estimate of `quantity` in a summary.
pub fn estimate(summary: &Summary, quantity: Quantity) -> Estimate {
    match quantity {
        Quantity::Mu => summary.mu,
        Quantity::MuStatic => summary.mu_static,
        Quantity::MuPeak => summary.mu_peak,
        Quantity::MuMean => summary.mu_mean,
        Quantity::Friction => summary.friction,
        Quantity::FrictionStatic => summary.friction_static,
        Quantity::Load => summary.load,
        Quantity::LoadPress => summary.load_press,
        Quantity::Area => summary.area,
        Quantity::AreaPress => summary.area_press,
        Quantity::ContactRadius => summary.contact_radius,
        Quantity::EnergyRelease => summary.energy_release,
        Quantity::EnergyWeakening => summary.energy_weakening,
        Quantity::TemperatureMax => summary.temperature_max,
        Quantity::TemperatureMean => summary.temperature_mean,
        Quantity::InceptionSlip => summary.inception_slip,
        _ => unreachable!("{quantity:?} is not a scalar"),
    }
}

/// The criterion of sliding inception in words.
pub fn inception_in_words(criterion: InceptionCriterion) -> &'static str {
    match criterion {
        InceptionCriterion::FullSlip => "no contact point sticks",
        InceptionCriterion::Stiffness => "dQ/ds below 1 % of its initial value",
        InceptionCriterion::None => "not reached",
    }
}
