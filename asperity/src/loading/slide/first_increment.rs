//! First increments of a motion, by the displacements and times in which a contact changes.

use super::Slide;
use super::increments::StepControl;
use super::motion::Motion;
use super::shear_limits::shear_limits;
use crate::material::SHEAR_RATIO;

impl Slide<'_> {
    /// Step control of the present motion.
    pub(super) fn step_control(&self) -> StepControl {
        StepControl::new(self.motion.length(), self.scale(), self.increment_growth, self.inception_width)
    }

    /// Scale of the first increments of the present motion: the elastic displacement at gross slip, what is passed in a share
    /// of the time of the motion before, or of that in which heat diffuses through the contact, and the part in which the slip
    /// rate begins to fall.
    fn scale(&self) -> f64 {
        /// Surface temperatures change in proportion to √t at first, by 3 % over a thousandth of the time.
        const FIRST_SHARE: f64 = 0.001;
        /// Least scale over the elastic displacement: in a shorter increment the rounding of displacements decides. A hot
        /// contact cools within it, at rates so low that it slips no further meanwhile.
        const LEAST: f64 = 1e-6;
        let time = FIRST_SHARE * self.time_before.min(self.last().area);
        let (elastic, fall) = (self.elastic_displacement(), self.length_of_fall());
        match self.motion {
            Motion::Hold { .. } => time.min(fall),
            // A slide starts cold.
            Motion::Slip { speed, .. } if self.heat.is_some() && time > 0.0 => {
                elastic.min(time * speed.abs()).min(fall).max(LEAST * elastic)
            }
            Motion::Slip { .. } => elastic.min(fall).max(LEAST * elastic),
        }
    }

    /// δ_s = τ₀a(2 − ν)/(2G), the elastic displacement at gross slip, with 2 − ν taken as 2.
    fn elastic_displacement(&self) -> f64 {
        /// Largest strength of the interface over that of the body: beyond it shear takes place below the interface.
        const MOST_STRENGTH: f64 = 10.0;
        let strength = self.problem.interface.strength_factor.min(MOST_STRENGTH) * SHEAR_RATIO;
        let limit = self.mean_film_limit().map_or(strength, |limit| strength.min(limit));
        limit * self.history[0].radius() / self.problem.solid.moduli.shear
    }

    /// Mean τ₀ of Coulomb's law and of films under the present pressure, which may be far below the strength of the metal.
    fn mean_film_limit(&self) -> Option<f64> {
        self.problem.interface.law.limit().film?;
        let contact = &self.mechanics.contact;
        let limits = shear_limits(self.problem, contact, &vec![1.0; contact.len()], None);
        Some(contact.mean_limit(&limits)).filter(|limit| *limit > 0.0)
    }
}
