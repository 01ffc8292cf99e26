//! Conservation laws and bounds that every admissible state of a slide meets: a step to one that violates them is cut back.

use crate::loading::problem::Problem;
use crate::loading::state::SlideState;
use crate::scene::Interface;

/// Energy and heat that a step may leave unaccounted for, relative to the largest term so far and the elastic energy
/// of the press: at finite strain the trapezoidal work of a step is accurate to second order.
const MISSING: f64 = 1e-3;
/// Heat of a step over that of its dissipation, by the mean traction of the step; heat is by the traction at its end. It may
/// be any less: an interface at once as hot as its slip rate makes it has lost its strength by the end of the first step.
const HEAT_OF_DISSIPATION: f64 = 1.5;
/// Rise above the melting temperature, relative to that from the initial one, that a step may overshoot by.
pub const MELTING_OVERSHOOT: f64 = 0.01;

/// A conservation law or bound that a state violates.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Violation {
    #[error("a quantity of it is not a finite number")]
    NotFinite,
    #[error("energy stored and dissipated differ from the work of the flat by {:.1} %", 100.0 * .0)]
    Energy(f64),
    #[error("heat stored and lost differ from the heat input by {:.1} %", 100.0 * .0)]
    Heat(f64),
    #[error("it takes up more heat than plastic flow and friction dissipate")]
    HeatOfNothing,
    #[error("plastic flow or friction release energy")]
    NegativeDissipation,
    #[error(
        "the body is at {temperature:.2} K, above {highest:.2} K, where neither body nor interface has strength"
    )]
    AboveMelting { temperature: f64, highest: f64 },
}

/// Checks the step to the state `now`, in which the largest temperature rise of the body is `rise`; `elastic` is the
/// elastic energy after the press.
pub fn check(
    problem: &Problem,
    elastic: f64,
    before: &SlideState,
    now: &SlideState,
    rise: f64,
) -> Result<(), Violation> {
    if !now.is_finite() || !rise.is_finite() {
        return Err(Violation::NotFinite);
    }
    if let Some(limit) = problem.melting_rise
        && rise > (1.0 + MELTING_OVERSHOOT) * limit
    {
        let kelvin = |rise: f64| problem.units.temperature + rise;
        return Err(Violation::AboveMelting { temperature: kelvin(rise), highest: kelvin(limit) });
    }
    let of_step = |total: fn(&SlideState) -> f64| total(now) - total(before);
    let largest =
        now.energies().into_iter().fold(elastic.max(now.work.abs()), |most, term| most.max(term.abs()));
    let missing = of_step(SlideState::energy_missing).abs();
    if missing > MISSING * largest {
        return Err(Violation::Energy(missing / largest));
    }
    let (plastic, friction) = (of_step(|state| state.plastic), of_step(|state| state.friction_work));
    if plastic.min(friction) < -MISSING * largest {
        return Err(Violation::NegativeDissipation);
    }
    let missing = of_step(SlideState::heat_missing).abs();
    let exchanged = now.heat_in.abs().max(now.heat_stored.abs()).max(now.heat_out.abs());
    if missing > MISSING * exchanged {
        return Err(Violation::Heat(missing / exchanged));
    }
    let Interface { heat_partition, taylor_quinney, .. } = problem.interface;
    let generated = heat_partition * friction + taylor_quinney * plastic;
    if of_step(|state| state.heat_in + state.heat_counterface)
        > HEAT_OF_DISSIPATION * generated + MISSING * largest
    {
        return Err(Violation::HeatOfNothing);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::tests::of_preset;

    /// A step of 1 of friction work at a partition of 0.5, after a press with elastic energy 1.
    #[test]
    fn each_broken_law_is_found() {
        let problem = Problem::new(&of_preset("steel-4340", &["loading.interference=5"]));
        let before = SlideState { plastic: 1.0, work: 1.0, ..SlideState::default() };
        let good = SlideState {
            work: 3.0,
            plastic: 2.0,
            friction_work: 1.0,
            heat_in: 1.4,
            heat_stored: 1.0,
            heat_out: 0.4,
            ..before
        };
        let of = |now: SlideState, rise| check(&problem, 1.0, &before, &now, rise).err();
        assert_eq!(of(good, 100.0), None);
        assert_eq!(of(SlideState { elastic: f64::NAN, ..good }, 100.0), Some(Violation::NotFinite));
        assert!(matches!(of(SlideState { work: 3.01, ..good }, 100.0), Some(Violation::Energy(_))));
        assert!(matches!(of(SlideState { heat_out: 0.39, ..good }, 100.0), Some(Violation::Heat(_))));
        let hot = SlideState { heat_in: 2.4, heat_stored: 2.0, ..good };
        assert_eq!(of(hot, 100.0), Some(Violation::HeatOfNothing));
        let released = SlideState { plastic: 0.9, friction_work: 2.1, ..good };
        assert_eq!(of(released, 100.0), Some(Violation::NegativeDissipation));
        let melting = 1793.0 - 298.0;
        assert_eq!(of(good, melting), None);
        assert!(matches!(of(good, 1.02 * melting), Some(Violation::AboveMelting { highest: 1793.0, .. })));
    }
}
