//! Scatter of runs about their limits: the contact edge lies between two rings of nodes, and the front between stick and slip
//! between two angles, wherever the mesh puts these. It depends on the interference: in light contacts the edge moves
//! during the slide, in deep ones the body shears beside it.

use tables::quantity::Quantity;

use crate::scene::Control;
use crate::scene::fitted_constants::error_estimates::{
    AREA_OF_PRESS, DEEP_INCEPTION, ELEMENTS, ENERGY, ENERGY_OF_WEAKENING, FRICTION, HELD_LOAD, HIGHEST_RISE,
    INCEPTION_SLIP, LOAD, LOAD_OF_PRESS, MEAN_RISE, STATIC_FRICTION, at_interference,
};

/// Relative standard uncertainty of a quantity by the mesh, at ω₀/ω_c and n_c.
pub fn scatter(quantity: Quantity, interference: f64, elements_per_radius: usize) -> f64 {
    use Quantity::*;
    let (share, of) = match quantity {
        // Friction is strength times area.
        Mu | MuMean | MuSteady | Friction | Area => (1.0, FRICTION),
        MuStatic | MuPeak | FrictionStatic => (1.0, STATIC_FRICTION),
        Load => (1.0, LOAD),
        EnergyRelease => (1.0, ENERGY),
        EnergyWeakening => (1.0, ENERGY_OF_WEAKENING),
        InceptionSlip => (1.0, INCEPTION_SLIP),
        TemperatureMax => (1.0, HIGHEST_RISE),
        TemperatureMean => (1.0, MEAN_RISE),
        AreaPress => (1.0, AREA_OF_PRESS),
        ContactRadius => (0.5, AREA_OF_PRESS),
        LoadPress => (1.0, LOAD_OF_PRESS),
        HeatPartition => return 0.0,
        _ => unreachable!("{quantity:?} is not a scalar"),
    };
    share * at_interference(&of.map(f64::ln), interference).exp() * ELEMENTS / elements_per_radius as f64
}

/// Relative standard uncertainty of `G` and the slip at inception in deep contacts, at ω₀/ω_c: what the mean errors of `correction`
/// leave. The contact grows while the slip begins, more where the load is held and the asperity sinks; a finer mesh is not known to
/// reduce it.
pub fn of_deep_inception(interference: f64, control: Control) -> f64 {
    let factor = match control {
        Control::Interference => 1.0,
        Control::Load => HELD_LOAD,
    };
    factor * at_interference(&DEEP_INCEPTION, interference)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scatter_is_linear_in_the_logarithms() {
        for (interference, exact) in [(0.01, FRICTION[0]), (1.0, FRICTION[1]), (2e4, FRICTION[4])] {
            let found = scatter(Quantity::Mu, interference, 20);
            assert!((found / (0.5 * exact) - 1.0).abs() < 1e-12, "{interference}: {found}");
        }
        let between = scatter(Quantity::ContactRadius, 10f64.sqrt(), 10);
        assert!((between / (0.5 * (AREA_OF_PRESS[1] * AREA_OF_PRESS[2]).sqrt()) - 1.0).abs() < 1e-12);
    }
}
