//! What is known of a slide after each increment.

/// Stick area fraction below which the contact slips fully.
pub const NO_STICK: f64 = 0.01;
/// Part of the shear traction that is not along the motion, below which full slip is sliding: an interface that is too weak for
/// the radial shear tractions of the press slips everywhere at first, in the radial direction.
const ALONG: f64 = 0.5;

/// State of a slide after one increment, dimensionless.
///
/// Forces and areas are those of the whole asperity. Work, energies and heat are those of the half body y ≥ 0 that is computed,
/// since the start of the slide; the results of a run have twice these.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct SlideState {
    /// Step of the programme, from 0.
    pub step: usize,
    /// Displacement of the flat.
    pub slip: f64,
    /// ω/R.
    pub interference: f64,
    pub time: f64,
    pub friction: f64,
    /// Λ − 1: relative increase of the strength of the interface by the rate at which the contact slips.
    #[serde(rename = "rate_growth")]
    pub rate_strengthening: f64,
    pub load: f64,
    pub area: f64,
    pub stick_fraction: f64,
    /// Share of the shear strength of the contact that its shear traction mobilises.
    pub mobilised: f64,
    /// Part of the shear traction that is not along the motion, 1 − |Q|/∫|τ| dA.
    pub transverse: f64,
    pub rise_max: f64,
    pub rise_mean: f64,
    pub plastic_strain_max: f64,
    /// Work of the flat, half body.
    pub work: f64,
    /// Elastic energy, half body.
    pub elastic: f64,
    /// Plastic dissipation, half body.
    pub plastic: f64,
    /// Frictional dissipation, half body.
    pub friction_work: f64,
    /// Energy of the normal springs of the contact, half body.
    pub springs: f64,
    /// Work done through thermal expansion of asperity and flat, half body.
    pub thermal_expansion: f64,
    /// Elastic energy released as the moduli soften, half body.
    pub moduli_softening: f64,
    /// Heat from friction and plastic flow, half body.
    pub heat_in: f64,
    /// Heat in the asperity, half body.
    pub heat_stored: f64,
    /// Heat through base and gap, half body.
    pub heat_out: f64,
    /// Heat into a conducting counterface, half body.
    pub heat_counterface: f64,
    /// Share of the frictional heat of the increment that entered the asperity.
    pub heat_partition: f64,
}

impl SlideState {
    /// Whether the contact slips everywhere, along the motion.
    pub fn slides(&self) -> bool {
        self.stick_fraction < NO_STICK && self.is_along_motion()
    }

    /// Whether most of the shear traction resists the motion.
    pub fn is_along_motion(&self) -> bool {
        self.transverse < ALONG
    }

    /// Radius of the circle of the same area as the contact.
    pub fn radius(&self) -> f64 {
        (self.area / std::f64::consts::PI).sqrt()
    }

    /// Q/P; 0 without a load.
    pub fn mu(&self) -> f64 {
        if self.load > 0.0 { self.friction / self.load } else { 0.0 }
    }

    /// Energies that the work of the flat is spent on, half body.
    pub fn energies(&self) -> [f64; 6] {
        let Self { elastic, plastic, friction_work, springs, thermal_expansion, moduli_softening, .. } =
            *self;
        [elastic, plastic, friction_work, springs, thermal_expansion, moduli_softening]
    }

    /// Work of the flat that the energies do not account for, half body.
    pub fn energy_missing(&self) -> f64 {
        self.work - self.energies().iter().sum::<f64>()
    }

    /// Heat input that is neither stored nor lost, half body.
    pub fn heat_missing(&self) -> f64 {
        self.heat_in - self.heat_stored - self.heat_out
    }

    /// Whether forces, contact and totals are numbers; every other quantity follows from them.
    pub fn is_finite(&self) -> bool {
        let Self { interference, friction, load, area, rise_max, rise_mean, .. } = *self;
        let sums = [self.energy_missing(), self.heat_missing()];
        let all = [interference, friction, load, area, rise_max, rise_mean, self.plastic_strain_max];
        all.iter().chain(&sums).all(|x| x.is_finite())
    }
}
