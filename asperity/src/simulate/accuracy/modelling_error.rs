//! Modelling error: effects that the model of a run neglects or no mesh resolves, and bounds of their influence on its results.

use tables::functions::interpolate;
use tables::quantity::Quantity;

use crate::heat::expected::HeatEffect;
use crate::scene::fitted_constants::{
    coupling_of_press, coupling_of_slide, elastic_strain, hemisphere, localised_shear, smooth_flux,
};

/// Effects of a smooth flux into a counterface in place of temperatures that are equal at each point, see [`smooth_flux`].
#[derive(Clone, Copy)]
pub struct SharedHeat {
    /// Bound of the relative change of the mean rise.
    pub mean_rise: f64,
    /// Relative change of the strength when the mean rise changes by its bound.
    pub softening: f64,
    /// Relative change of the load when the heat in the asperity, and with it the part of the load by thermal expansion,
    /// changes as the heat partition; that in the counterface changes less, and the other way.
    pub load: f64,
}

impl SharedHeat {
    /// Bound of the relative change of the mean rise at k₂/k and Va/(2κ₂).
    pub fn bound_of_mean_rise(conductivity: f64, peclet: f64) -> f64 {
        use smooth_flux::{CONDUCTIVITIES, MEAN_RISE, PECLET};
        let at_peclet = MEAN_RISE.map(|bounds| interpolate(&PECLET.map(f64::ln), &bounds, peclet.ln()).0);
        interpolate(&CONDUCTIVITIES.map(f64::ln), &at_peclet, conductivity.ln()).0
    }
}

/// Effects neglected in a run.
#[derive(Clone, Copy, Default)]
pub struct ModellingError {
    /// Heat, where its effect is negligible.
    pub heat: Option<HeatEffect>,
    /// Relative change of the heat partition where heat is left out for any reason.
    pub heat_partition: f64,
    /// Beside a counterface that takes up heat.
    pub shared_heat: Option<SharedHeat>,
    /// Largest plastic strain of a slide at small strain.
    pub strain: f64,
    /// Elastic strain of a run at small strain.
    pub elastic_strain: Option<ElasticStrain>,
    /// β² neglected in the press, see [`crate::loading::problem::PressFriction`].
    pub press_coupling: f64,
    /// Relative change of `G` by the neglected coupling of the press.
    pub press_energy: f64,
    /// Δβ² (√3τ/σ_Y)² ω_c/ω₀ neglected in the slide, which is that on a rigid flat.
    pub slide_coupling: f64,
    /// a/R times the shares of the elastic compliance of the counterface, which is a half-space, and of elasticity in the load.
    pub finite_counterface: f64,
    /// d ln Q/d ln s of a contact in partial slip: friction at a displacement then depends on the tangential compliance.
    pub friction_exponent: f64,
    /// Bounds where shear localises in one layer of elements: values follow the mesh.
    pub localised_shear: Option<&'static localised_shear::Bounds>,
}

/// What the effect of finite strain on an elastic contact depends on.
#[derive(Clone, Copy)]
pub struct ElasticStrain {
    /// σ_Y/E, less in a light contact.
    pub strain: f64,
    /// Largest mean shear traction of the slide over the shear strength.
    pub traction: f64,
    /// ω₀/ω_c.
    pub interference: f64,
}

impl ElasticStrain {
    /// Relative change of a quantity.
    pub fn share(&self, quantity: Quantity) -> f64 {
        use Quantity::*;
        use elastic_strain::*;
        let friction = FRICTION * self.traction.min(1.0).powi(2);
        let over_strain = match quantity {
            LoadPress => LOAD_OF_PRESS,
            AreaPress => AREA_OF_PRESS,
            ContactRadius => 0.5 * AREA_OF_PRESS,
            Mu | MuPeak | MuMean | MuSteady | Friction | EnergyWeakening => friction,
            MuStatic | FrictionStatic | InceptionSlip => friction + STATIC_FRICTION,
            Load => LOAD_OF_PRESS,
            Area => friction.max(AREA_OF_PRESS),
            EnergyRelease => {
                ENERGY * self.interference.min(1.0) * self.traction.clamp(WEAKEST, 1.0).powf(ENERGY_EXPONENT)
            }
            _ => 0.0,
        };
        over_strain * self.strain
    }
}

/// Relative change of `G` by a neglected β² of the press, at the largest mean shear traction over the shear strength.
pub fn energy_of_press(press_coupling: f64, traction: f64) -> f64 {
    use coupling_of_press::{ENERGY, ENERGY_EXPONENT, WEAKEST};
    ENERGY * press_coupling * traction.clamp(WEAKEST, 1.0).powf(-ENERGY_EXPONENT)
}

impl ModellingError {
    /// The part of a hemisphere in place of a half-space on the side of the counterface.
    fn of_hemisphere(&self, quantity: Quantity) -> f64 {
        use Quantity::*;
        let in_partial_slip = hemisphere::SLIP * self.friction_exponent;
        self.finite_counterface
            * match quantity {
                Load | LoadPress => hemisphere::LOAD,
                EnergyRelease | InceptionSlip => hemisphere::SLIP,
                Area | AreaPress => hemisphere::AREA,
                Friction | FrictionStatic => hemisphere::AREA + in_partial_slip,
                // The excess of the area is in the friction, and makes up for a part of that of the load.
                Mu | MuStatic | MuPeak | MuMean | MuSteady => {
                    hemisphere::LOAD - hemisphere::AREA + in_partial_slip
                }
                ContactRadius => 0.5 * hemisphere::AREA,
                _ => 0.0,
            }
    }

    /// Change of a quantity relative to its value (to its rise, for temperatures).
    ///
    /// Heat changes quantities of the slide only: at inception the temperature has hardly risen. Finite strain changes
    /// friction and area by about the largest plastic strain: mu by 0.3, 1.1, 0.3, 0.3 and 0.2 of it at strains of
    /// 0.004 to 0.014 (between 0.5 and 3 omega_c), by 0.79, 0.75 and 0.72 of it at 0.028, 0.051 and 0.083 (4340 steel
    /// at 20, 50 and 100 omega_c).
    pub fn share(&self, quantity: Quantity) -> f64 {
        use Quantity::*;
        let (softening, load) = self.heat.map_or((0.0, 0.0), |effect| (effect.softening, effect.load));
        let localised = self.localised_shear.map_or(0.0, |bounds| match quantity {
            Mu | MuStatic | MuPeak | MuMean | MuSteady | Friction | FrictionStatic => bounds.friction,
            Load | Area => bounds.load,
            InceptionSlip => bounds.inception_slip,
            EnergyRelease | EnergyWeakening => bounds.energy,
            _ => 0.0,
        });
        let press = self.press_coupling
            * match quantity {
                Load | LoadPress => coupling_of_press::LOAD,
                Area | AreaPress | Friction | FrictionStatic => coupling_of_press::AREA,
                Mu | MuStatic | MuPeak | MuMean | MuSteady => {
                    coupling_of_press::LOAD + coupling_of_press::AREA
                }
                ContactRadius => 0.5 * coupling_of_press::AREA,
                InceptionSlip => coupling_of_press::INCEPTION_SLIP,
                _ => 0.0,
            };
        let slide = self.slide_coupling
            * match quantity {
                Load | Mu | MuStatic | MuPeak | MuMean | MuSteady => coupling_of_slide::LOAD,
                Area | Friction | FrictionStatic => coupling_of_slide::AREA,
                _ => 0.0,
            };
        let shared =
            self.shared_heat.map_or(0.0, |SharedHeat { mean_rise, softening, load }| match quantity {
                Mu | MuMean | MuSteady | Friction => softening + load,
                Load | Area => load,
                EnergyWeakening | TemperatureMean => mean_rise,
                TemperatureMax => smooth_flux::HIGHEST_RISE,
                HeatPartition => smooth_flux::PARTITION,
                _ => 0.0,
            });
        localised
            + press
            + slide
            + self.of_hemisphere(quantity)
            + self.elastic_strain.map_or(0.0, |elastic| elastic.share(quantity))
            + shared
            + match quantity {
                Mu | MuPeak | MuMean | MuSteady => softening + load + self.strain,
                MuStatic | FrictionStatic => self.strain,
                EnergyRelease => self.press_energy + self.strain,
                Friction | EnergyWeakening => softening + self.strain,
                Area => load + self.strain,
                Load => load,
                // The whole rise is an expected one.
                TemperatureMax | TemperatureMean if self.heat.is_some() => 1.0,
                TemperatureMax | TemperatureMean => self.strain,
                HeatPartition => self.heat_partition,
                _ => 0.0,
            }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tables::quantity::{COVERAGE_FACTOR, OF_BOUND};

    /// Magnitude of small less finite strain, in %, of contacts without plastic flow in the press: σ_Y/E, f, ω₀/ω_c, and friction, static
    /// friction, area of the press, and G.
    const ELASTIC: [(f64, f64, f64, [f64; 4]); 7] = [
        (0.02345, 0.5, 0.3, [0.38, 0.49, 0.22, 1.94]),
        (0.00680, 0.5, 0.3, [0.12, 0.17, 0.07, 0.61]),
        (0.02345, 0.5, 0.8, [0.46, 0.75, 0.33, 8.18]),
        (0.00680, 0.5, 0.8, [0.14, 0.28, 0.11, 2.07]),
        (0.00170, 0.5, 0.8, [0.04, 0.06, 0.03, 0.50]),
        (0.00680, 0.9, 0.3, [0.43, 0.43, 0.07, 0.05]),
        (0.02345, 0.9, 0.8, [1.38, 1.55, 0.33, 0.71]),
    ];

    const ROUNDING: f64 = 0.005;

    #[test]
    fn changes_by_elastic_strain_are_of_the_size_of_the_measured_ones() {
        use Quantity::*;
        for (strain, traction, interference, measured) in ELASTIC {
            let elastic = ElasticStrain { strain, traction, interference };
            for (quantity, measured) in [Mu, MuStatic, AreaPress, EnergyRelease].into_iter().zip(measured) {
                let share = 100.0 * elastic.share(quantity);
                assert!(
                    share > 0.75 * (measured - ROUNDING),
                    "{quantity:?} {strain} {traction}: {share} {measured}"
                );
                let is_energy = quantity == EnergyRelease;
                assert!(
                    is_energy || share < 2.0 * (measured + ROUNDING),
                    "{quantity:?} {strain} {traction}: {share} {measured}"
                );
            }
        }
    }

    /// β, load and area in full stick over those without friction: the ratios of `studies::verification::full_stick`, ν = 0 to
    /// 0.45 on a rigid flat. They depend on β alone. A press by one of them in place of another, or without friction, is off
    /// by no more than the error that is stated for it.
    #[test]
    fn the_neglected_coupling_is_covered() {
        let ratios: [(f64, f64, f64); 5] = [
            (0.0, 1.0, 1.0),
            (0.5, 1.05289, 0.91850),
            (0.375, 1.02819, 0.95700),
            (0.4 / 1.4, 1.01621, 0.97601),
            (0.1 / 1.1, 1.00160, 0.99767),
        ];
        for used in ratios {
            for both in ratios {
                let press_coupling = (used.0 * used.0 - both.0 * both.0).abs();
                let error = ModellingError { press_coupling, ..Default::default() };
                let changes = [(Quantity::Load, used.1 / both.1), (Quantity::Area, used.2 / both.2)];
                for (quantity, ratio) in changes {
                    let stated = COVERAGE_FACTOR * OF_BOUND * error.share(quantity);
                    let change = (ratio - 1.0).abs();
                    let is_covered = change <= stated && stated <= 1.6 * change;
                    assert!(is_covered, "{used:?} {both:?} {quantity:?}: {change} {stated}");
                }
            }
        }
    }

    /// β on a rigid flat, f_τ, and the changes of the slip at inception and of `G` from full stick to no friction over β²: the largest
    /// of either sign among those of [`coupling_of_press`]. Half of that coupling changes results without friction by no more than is
    /// stated.
    #[test]
    fn the_neglected_energy_of_the_press_is_covered() {
        let (stiff, soft, none): (f64, f64, f64) = (0.44 / 1.44, 0.2 / 1.2, 0.5);
        for (beta, strength, slip, energy) in [
            (none, 1.0, -0.254, -1.006),
            (stiff, 1.0, 1.123, -1.754),
            (soft, 1.0, 1.336, -3.181),
            (none, 0.5, -0.751, -2.755),
            (stiff, 0.6, -1.367, -5.784),
            (stiff, 0.3, -2.125, -7.953),
        ] {
            let press_coupling = 0.5 * beta * beta;
            let press_energy = energy_of_press(press_coupling, strength);
            let error = ModellingError { press_coupling, press_energy, ..Default::default() };
            for (quantity, of_full_stick) in
                [(Quantity::InceptionSlip, slip), (Quantity::EnergyRelease, energy)]
            {
                let whole = 1.0 / (1.0 + of_full_stick * beta * beta) - 1.0;
                let stated = COVERAGE_FACTOR * OF_BOUND * error.share(quantity);
                assert!(0.5 * whole.abs() <= stated, "{beta} {strength} {quantity:?}: {whole} {stated}");
            }
        }
        assert_eq!(energy_of_press(0.0, 0.0), 0.0);
    }

    /// Ti-6Al-4V on itself, Coulomb friction of 0.5, 0.5 ω_c (a/R = 0.02488), 33.0 N, slip of 0.004 a: Q = 5.53 N; Cattaneo and
    /// Mindlin have 5.91 N at 0.256 of the displacement of gross slip x, and d ln Q/d ln s = 1.5 x √(1 − x)/(1 − (1 − x)^1.5).
    #[test]
    fn the_compliance_of_the_hemisphere_is_covered_in_partial_slip() {
        let x: f64 = 0.256;
        let friction_exponent = 1.5 * x * (1.0 - x).sqrt() / (1.0 - (1.0 - x).powf(1.5));
        let error =
            ModellingError { finite_counterface: 0.5 * 0.02488, friction_exponent, ..Default::default() };
        let stated = COVERAGE_FACTOR * OF_BOUND * error.share(Quantity::Friction);
        let change = 5.91 / 5.53 - 1.0;
        assert!(change <= stated && stated <= 1.6 * change, "{change} {stated}");
    }

    /// Changes of the mean rise by `examples/peers/sliding_heat.py --cells 48` (64 for the first), in %, at k₂/k and Va/(2κ₂): the
    /// largest ones, steady or at κt/a² = 0.2 to 1.
    #[test]
    fn the_smooth_flux_is_covered() {
        let changes = [
            (0.05, 1000.0, 1.012),
            (0.1, 10.0, 0.277),
            (0.1, 300.0, 0.938),
            (0.2, 50.0, 0.743),
            (0.3, 100.0, 0.727),
            (1.0, 10.0, 0.296),
            (1.0, 50.0, 0.407),
            (1.0, 1000.0, 0.188),
            (2.0, 20.0, 0.266),
            (3.0, 20.0, 0.203),
            (10.0, 20.0, 0.076),
        ];
        for (conductivity, peclet, change) in changes {
            let bound = 100.0 * SharedHeat::bound_of_mean_rise(conductivity, peclet);
            assert!(
                change <= 0.97 * bound && bound <= 2.0 * change,
                "{conductivity} {peclet}: {change} {bound}"
            );
        }
    }
}
