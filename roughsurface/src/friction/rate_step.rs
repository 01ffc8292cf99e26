//! The response of the surface to a step of the slip rate: direct effect, evolution, and the slip that it takes.

use tables::law::Estimate;

/// Slips per decade at which the response is computed: powers of ten, whatever the other pressures are.
const PER_DECADE: f64 = 12.0;

/// First slip since the step after zero, over the smallest contact radius.
const FIRST: f64 = 1e-3;
/// Last slip since the step, over the largest contact radius and the life: all contacts are born after the step by then.
const LAST: f64 = 4.0;

/// A surface in steady sliding whose slip rate steps from one to another.
#[derive(Clone, Debug)]
pub struct RateStepResponse {
    /// Slip rates before and after, m/s.
    pub rates: [f64; 2],
    /// Slips since the step, from 0, m.
    pub slip: Vec<f64>,
    /// One per pressure or separation.
    pub rows: Vec<Stepped>,
}

/// Friction of one pressure or separation.
#[derive(Clone, Debug, PartialEq)]
pub struct Stepped {
    /// Friction coefficient in steady sliding before the step.
    pub before: Estimate,
    /// Friction coefficient in steady sliding after the step.
    pub after: Estimate,
    /// Friction coefficient at each slip since the step.
    pub mu: Vec<Estimate>,
}

impl Stepped {
    /// Change of friction at the step itself.
    pub fn direct_effect(&self) -> Estimate {
        let value = self.mu[0].value - self.before.value;
        // Errors that both have in common cancel.
        Estimate { value, error: (self.mu[0].error - self.before.error).abs() }
    }

    /// Slip (m) in which half of the change from just after the step to steady sliding is done; NaN where there is none
    /// above the errors.
    pub fn evolution_distance(&self, slip: &[f64]) -> Estimate {
        let [value, less, more] = [0.5, 0.4, 0.6].map(|share| self.slip_of(share, slip));
        let change = (self.after.value - self.mu[0].value).abs();
        let uncertain = self.mu.iter().map(|mu| (mu.error - self.after.error).abs()).fold(0.0, f64::max);
        if uncertain > 0.5 * change {
            return Estimate::UNKNOWN;
        }
        // Relative to the change: what moves the half by as much.
        let slope = 0.5 * (more - less) / 0.1;
        Estimate { value, error: slope * uncertain / change }
    }

    /// Slip in which a share of the change is done.
    fn slip_of(&self, share: f64, slip: &[f64]) -> f64 {
        let start = self.mu[0].value;
        let done = |i: usize| (self.mu[i].value - start) / (self.after.value - start);
        let Some(i) = (1..slip.len()).find(|&i| done(i) >= share) else { return f64::NAN };
        let (before, after) = (done(i - 1), done(i));
        slip[i - 1] + (slip[i] - slip[i - 1]) * (share - before) / (after - before)
    }
}

/// Slips since the step (m), for contacts with the radii (m) of the smallest and of the largest load and a life in diameters.
pub(crate) fn slip_grid([smallest, largest]: [f64; 2], diameters: f64) -> Vec<f64> {
    let place = |slip: f64| PER_DECADE * slip.log10();
    let first = place(FIRST * smallest).floor() as i32;
    let last = place(LAST * largest * diameters).ceil() as i32;
    let points = (first..=last).map(|k| 10f64.powf(f64::from(k) / PER_DECADE));
    std::iter::once(0.0).chain(points).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::friction::{Settings, predict};
    use crate::integral::test_laws::{PowerLaw, query, surface};
    use crate::surface::heights::Exponential;
    use crate::surface::query::{ContactLife, NormalLoading, Query};
    use tables::law::AsperityLaw;

    fn stepped(law: &dyn AsperityLaw, rates: [f64; 2], life: f64) -> Result<RateStepResponse, String> {
        let surface = surface(Exponential::new(2e-7));
        let query = Query {
            contact_life: ContactLife::Diameters(life),
            rate_step: Some(rates),
            ..query(NormalLoading::Pressure(vec![1e5, 1e6]))
        };
        let found = predict(law, &surface, &query, &Settings::default(), &|_, _| ());
        Ok(found.map_err(|error| error.to_string())?.rate_step.unwrap())
    }

    /// Friction falls in proportion to V√t: heat of a source at rest.
    #[test]
    fn a_step_leads_from_one_steady_sliding_to_the_other() {
        let history = |rate: f64, slip: f64, _: f64| 1.0 - 0.03 * (rate * slip / 1e-6).sqrt();
        let steady = Some(Estimate::default());
        let law = PowerLaw { history, last_slip: 20.0, steady, ..PowerLaw::hertz() };
        for rates in [[1.0, 10.0], [10.0, 1.0]] {
            let found = stepped(&law, rates, 1.0).unwrap();
            for row in &found.rows {
                assert!(row.direct_effect().value.abs() < 1e-6, "{row:?}");
                let fall = row.before.value - row.after.value;
                assert!(
                    (row.mu[row.mu.len() - 1].value - row.after.value).abs() < 0.01 * fall.abs(),
                    "{row:?}"
                );
                assert!(
                    row.mu.windows(2).all(|pair| (pair[0].value - pair[1].value) * fall > -1e-9 * fall.abs())
                );
                let distance = row.evolution_distance(&found.slip).value;
                assert!(
                    distance > found.slip[1] && distance < found.slip[found.slip.len() - 1],
                    "{distance}"
                );
            }
        }
        let found = stepped(&law, [2.0, 2.0], 1.0).unwrap();
        for row in &found.rows {
            assert!(row.mu.iter().all(|mu| (mu.value / row.after.value - 1.0).abs() < 1e-5), "{row:?}");
        }
        let short = PowerLaw { last_slip: 1.0, ..law };
        let refused = stepped(&short, [1.0, 2.0], 1.0).unwrap_err();
        assert!(refused.contains("contact_life must be at most 0.5 diameters"), "{refused}");
        let refused = stepped(&short, [1.0, 1e3], 0.5).unwrap_err();
        assert!(refused.contains("outside the table"), "{refused}");
    }

    /// μ = 0.5 + 0.02 − 0.12 (1 − e^{−x/l}).
    #[test]
    fn direct_effect_and_half_of_an_exponential_evolution() {
        const L: f64 = 3e-6;
        let exact = |value: f64| Estimate { value, error: 1e-3 };
        let slip = slip_grid([1e-5, 1e-4], 1.0);
        let mu = |x: &f64| exact(0.52 - 0.12 * (1.0 - (-x / L).exp()));
        let stepped = Stepped { before: exact(0.5), after: exact(0.4), mu: slip.iter().map(mu).collect() };
        assert!((stepped.direct_effect().value - 0.02).abs() < 1e-12);
        let found = stepped.evolution_distance(&slip);
        assert!((found.value / (L * 2f64.ln()) - 1.0).abs() < 0.02, "{found:?}");
        assert_eq!(found.error, 0.0);
        // Without a change there is no distance.
        let flat = Stepped { after: exact(0.52), mu: vec![exact(0.52); slip.len()], ..stepped };
        assert!(flat.evolution_distance(&slip).value.is_nan());
    }
}
