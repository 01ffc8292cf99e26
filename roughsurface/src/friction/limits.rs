//! Limits of the model that every state of a surface keeps.

use crate::friction::settings::{PredictionError, Settings};
use crate::friction::slip_curve::SlipState;
use crate::friction::warning::Place;
use crate::integral::height_integral::NEGLIGIBLE_SHARE;
use tables::law::{AboveRange, AsperityLaw, Estimate};

/// Share of the load on asperities whose friction a law does not state, above which the surface has no friction
/// coefficient; below it they count as without friction, as in Kogut & Etsion 2004 (doi 10.1115/1.1609488).
pub const WITHOUT_FRICTION: f64 = 0.05;

impl SlipState {
    /// The state as far as the `law` knows it, or why it is beyond the model.
    pub(crate) fn within(
        self,
        law: &dyn AsperityLaw,
        settings: &Settings,
        at: &dyn Fn() -> Place,
    ) -> Result<Self, PredictionError> {
        if self.beyond > NEGLIGIBLE_SHARE && !settings.extrapolate {
            let Place { loading, slip_rate } = at();
            let (limit, share) = (law.contact_limit(), self.beyond);
            return Err(PredictionError::ContactsTooLarge { loading, slip_rate, limit, share });
        }
        let area = self.area_fraction.value;
        if area > 1.0 {
            return Err(PredictionError::AreaAboveNominal { at: at(), share: area });
        }
        let quantities =
            [("pressure", self.pressure), ("friction stress", self.shear), ("area", self.area_fraction)];
        let broken = |(_, value): &(&str, Estimate)| !(value.value.is_finite() && value.error.is_finite());
        if let Some((quantity, _)) = quantities.into_iter().find(broken) {
            return Err(PredictionError::NotFinite { at: at(), quantity });
        }
        if law.above_range() == AboveRange::NoFriction && self.outside > WITHOUT_FRICTION {
            return Ok(self.without_friction());
        }
        Ok(self)
    }
}
