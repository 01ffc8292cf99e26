//! One contact after a step of the slip rate from V₁ to V₂.
//!
//! A law has slides at one slip rate each. Heat changes load, friction and area of a slide in proportion to the
//! temperature to first order, and temperatures of two sources add up: that of the time since the step, and that of the
//! time before, which is switched off. With r_V(s) = y_V(s)/y_0(s), a quantity after the slip s over that of the slide
//! without heat, and the slip x since the step of a contact that has slid by s,
//!
//! y = y_0(s)·[r₁(s − x + xV₁/V₂) + r₂(s_s + x) − r₂(s_s) − r₁(s_s + xV₁/V₂) + r₁(s_s)]
//!
//! A table whose strength grows with the strain rate has no slide without heat; its slowest slide takes the place of that,
//! and the share of its temperature rise in that of the slides counts as error.
//!
//! xV₁/V₂ is the slip at V₁ in the time since the step. s_s is the slip of inception: before it a slide of the law makes no
//! heat, whereas the contact slides on. For V₁ = V₂ this is the slide itself, for x = 0 that at V₁, also before inception. Contacts
//! born after the step slide at V₂ only. A strength that grows with the strain rate takes its factor at V₂ at once.

use tables::law::{AsperityLaw, Estimate, LookupError, Response, SlidingResponse};

/// Error of the superposition, relative to the smaller of what the step changes and of what heat had changed before it. It is
/// at most 0.15 of the change where the rate rises and 0.31 where it falls, in seven runs through a step (example
/// `rate_step_superposition`).
const SUPERPOSITION: f64 = 0.35;

/// The slides of spheres of one radius before and after the step.
pub struct RateStep<'a> {
    law: &'a dyn AsperityLaw,
    radius: f64,
    /// V₁ and V₂, m/s.
    rates: [f64; 2],
    sliding: [SlidingResponse<'a>; 2],
    /// Smallest slip rate of the law, 0 where it has a slide without heat.
    slowest: f64,
    isothermal: SlidingResponse<'a>,
}

impl<'a> RateStep<'a> {
    /// Spheres of `radius` (m), slip rates before and after in m/s.
    pub fn new(law: &'a dyn AsperityLaw, radius: f64, rates: [f64; 2]) -> Result<Self, LookupError> {
        let [before, after] = rates;
        let (slowest, _) = law.slip_rate_range(radius);
        Ok(Self {
            law,
            radius,
            rates,
            sliding: [law.at_slip_rate(radius, before)?, law.at_slip_rate(radius, after)?],
            slowest,
            isothermal: law.at_slip_rate(radius, slowest)?,
        })
    }

    /// A contact at `interference` (ω/ω_c).
    pub fn contact(&self, interference: f64) -> Result<SteppedContact<'_>, LookupError> {
        let Self { law, radius, rates: [before, after], .. } = *self;
        let factor = |rate: f64| -> Result<f64, LookupError> {
            let slowest = law.rate_factor(radius, interference, self.slowest)?;
            Ok(law.rate_factor(radius, interference, rate)? / slowest)
        };
        Ok(SteppedContact {
            step: self,
            interference,
            begins: law.inception_slip(radius, interference)?.value,
            factors: [factor(before)?, factor(after)?],
        })
    }
}

/// One contact in the step.
pub struct SteppedContact<'a> {
    step: &'a RateStep<'a>,
    interference: f64,
    /// s_s, m.
    begins: f64,
    /// Strength at both slip rates over that of the slide without heat.
    factors: [f64; 2],
}

/// Load, friction and area over those without heat, and the rise of the highest temperature.
struct Heated {
    ratios: [f64; 3],
    rise: f64,
    /// Temperature rise of the slide that stands for the one without heat, over that of this one.
    missing: f64,
}

impl Heated {
    fn less(&self, other: &Self) -> Self {
        let ratios = std::array::from_fn(|q| self.ratios[q] - other.ratios[q]);
        Self { ratios, rise: self.rise - other.rise, missing: self.missing }
    }
}

impl SteppedContact<'_> {
    /// Response after the slips `before` and `after` the step, m.
    pub fn response(&self, before: f64, after: f64) -> Result<Response, LookupError> {
        let Self { step, interference, begins, .. } = *self;
        let slip = before + after;
        let elapsed = after * step.rates[0] / step.rates[1];
        let now = (step.isothermal)(interference, slip)?;
        let given = (step.sliding[1])(interference, slip)?;
        // A contact that begins to slide after the step has the strength at V₂, and not in addition what the one at V₁ was
        // of that without heat before inception.
        let past = (before + elapsed).max(if slip >= begins { begins } else { 0.0 });
        let past = self.heated(0, past)?;
        let then = self.heated(0, before)?;
        // Since the step: heat at V₂, and cooling of that at V₁; each from the inception of sliding, which is later at a
        // higher strength, in proportion.
        let [slides, first] = [1, 0].map(|rate| begins * self.factors[rate].max(1.0));
        let warmer = self.heated(1, slides + after)?.less(&self.heated(1, slides)?);
        let cooler = self.heated(0, first + elapsed)?.less(&self.heated(0, first)?);
        let change = warmer.less(&cooler);
        let ratio = |q: usize| past.ratios[q] + change.ratios[q];
        let missing = past.missing.max(warmer.missing);
        let uncertain = |q: usize| {
            SUPERPOSITION * change.ratios[q].abs().min((then.ratios[q] - 1.0).abs())
                + missing * (ratio(q) - 1.0).abs()
        };
        let strength = self.factor(1, slip);
        let estimate = |q: usize, now: Estimate, factor: f64, given: Estimate| {
            let value = factor * ratio(q) * now.value;
            let relative = if given.value == 0.0 { 0.0 } else { (given.error / given.value).abs() };
            Estimate { value, error: value.abs() * (relative + uncertain(q)) }
        };
        Ok(Response {
            load: estimate(0, now.load, 1.0, given.load),
            friction: estimate(1, now.friction, strength, given.friction),
            area: estimate(2, now.area, 1.0, given.area),
            temperature_max: Estimate {
                value: now.temperature_max.value + past.rise + change.rise,
                error: given.temperature_max.error + SUPERPOSITION * change.rise.abs().min(then.rise),
            },
            coefficient_error: given.coefficient_error + uncertain(0).max(uncertain(1)),
        })
    }

    /// Strength at V₁ (0) or V₂ (1) over that of the slide without heat; a contact that has not begun to slide does not have it.
    fn factor(&self, rate: usize, slip: f64) -> f64 {
        if slip >= self.begins { self.factors[rate] } else { 1.0 }
    }

    /// The slide at V₁ (0) or V₂ (1) after `slip` (m), beside that without heat.
    fn heated(&self, rate: usize, slip: f64) -> Result<Heated, LookupError> {
        let (hot, cold) = (
            (self.step.sliding[rate])(self.interference, slip)?,
            (self.step.isothermal)(self.interference, slip)?,
        );
        let ratio =
            |hot: Estimate, cold: Estimate| if cold.value == 0.0 { 1.0 } else { hot.value / cold.value };
        let start = (self.step.isothermal)(self.interference, 0.0)?.temperature_max.value;
        let rise_of = |state: &Response| state.temperature_max.value - start;
        let missing =
            if rise_of(&hot) > 0.0 { (rise_of(&cold) / rise_of(&hot)).clamp(0.0, 1.0) } else { 0.0 };
        Ok(Heated {
            missing,
            ratios: [
                ratio(hot.load, cold.load),
                ratio(hot.friction, cold.friction) / self.factor(rate, slip),
                ratio(hot.area, cold.area),
            ],
            rise: hot.temperature_max.value - cold.temperature_max.value,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integral::test_laws::{PowerLaw, asperity};
    use crate::surface::query::ContactLife;

    const LENGTH: f64 = 1e-6;

    /// Friction falls in proportion to the temperature of a source at rest that works since the beginning of sliding at
    /// constant power, in proportion to V√t with t = s/V.
    fn softened(rate: f64, slip: f64, _radius: f64) -> f64 {
        1.0 - 0.1 * (rate * slip / LENGTH).sqrt()
    }

    #[test]
    fn temperatures_of_two_sources_add_up() {
        let law = PowerLaw { history: softened, relative_error: 0.0, ..PowerLaw::hertz() };
        for [slow, fast] in [[0.5, 2.0], [2.0, 0.5], [1.0, 1.0]] {
            let step = RateStep::new(&law, 1e-4, [slow, fast]).unwrap();
            let contact = step.contact(1.0).unwrap();
            for (before, after) in [(1e-6, 0.0), (1e-6, 1e-8), (1e-6, 1e-6), (0.0, 1e-6), (3e-6, 1e-5)] {
                // V√t of the source since the step, and of the one before, less what went on without it.
                let (age, since) = (before / slow + after / fast, after / fast);
                let rise = fast * since.sqrt() + slow * (age.sqrt() - since.sqrt());
                let exact = 1e-4 * (1.0 - 0.1 * rise / LENGTH.sqrt());
                let found = contact.response(before, after).unwrap();
                assert!(
                    (found.friction.value / exact - 1.0).abs() < 1e-12,
                    "{slow} {before} {after}: {found:?}"
                );
                assert!((found.load.value - 1e-3).abs() < 1e-15);
                if slow == fast {
                    let slide = law.response(1e-4, 1.0, fast, before + after).unwrap();
                    assert!((found.friction.value / slide.friction.value - 1.0).abs() < 1e-12);
                    assert_eq!(found.friction.error, 0.0);
                }
            }
        }
    }

    /// Friction and strength of a contact that does not slide yet depend on the slip rate as well.
    #[test]
    fn without_a_step_contacts_of_all_ages_are_those_of_the_slide() {
        let rate_factor = |rate: f64| 1.0 + 0.02 * (rate / 1e-3).ln();
        for (slowest, rate_factor) in [(0.0, (|_| 1.0) as fn(f64) -> f64), (0.01, rate_factor)] {
            let law = PowerLaw {
                history: softened,
                rate_factor,
                slowest,
                inception: 2e-6,
                area: (1e-11, 1.0),
                ..PowerLaw::hertz()
            };
            let asperity = asperity(&law);
            let steady = asperity.of_all_ages(ContactLife::Diameters(1.0)).response(1.0).unwrap();
            let stepping = asperity.stepping_from(1.0, 1.0).unwrap();
            for since in [0.0, 1e-6, 3e-6] {
                let found = stepping.since_step(since).response(1.0).unwrap();
                let off = found.friction.value / steady.friction.value - 1.0;
                assert!(off.abs() < if since == 0.0 { 1e-14 } else { 1e-4 }, "{slowest} {since}: {off:e}");
            }
        }
    }

    /// ln 1e3 and ln 1e4 over 1e-3 m/s: factors of 1.13816 and 1.18421 at 1 and 10 m/s.
    #[test]
    fn the_direct_effect_is_that_of_the_rate_law() {
        // A strength that grows with the strain rate, and slides from 0.01 m/s on.
        let rate_factor = |rate: f64| 1.0 + 0.02 * (rate / 1e-3).ln();
        let law = PowerLaw { history: softened, rate_factor, slowest: 0.01, ..PowerLaw::hertz() };
        // In the step, over that of a slide.
        let ratio = |law: &PowerLaw, [before, after]: [f64; 2], (rate, slip): (f64, f64)| {
            let step = RateStep::new(law, 1e-4, [1.0, 10.0]).unwrap();
            let stepped = step.contact(1.0).unwrap().response(before, after).unwrap();
            stepped.friction.value / law.response(1e-4, 1.0, rate, slip).unwrap().friction.value
        };
        let direct = ratio(&law, [1e-6, 0.0], (1.0, 1e-6));
        assert!((direct / (1.184207 / 1.138155) - 1.0).abs() < 1e-6, "{direct}");
        // One that begins to slide after the step has the strength at the second rate too.
        let cold = PowerLaw { history: |_, _, _| 1.0, inception: 2e-6, ..law.clone() };
        let begun = ratio(&cold, [1e-6, 2e-6], (10.0, 3e-6));
        assert!((begun - 1.0).abs() < 1e-6, "{begun}");
        // Elastic up to the strength, which is reached later where it is larger: no heat.
        let history = |rate: f64, slip: f64, _: f64| {
            let factor = |rate: f64| 1.0 + 0.02 * (rate / 1e-3).ln();
            (slip / (2e-6 * factor(rate) / factor(0.01))).min(1.0)
        };
        let elastic = PowerLaw { history, ..cold };
        let old = ratio(&elastic, [4e-6, 1e-6], (10.0, 5e-6));
        assert!((old - 1.0).abs() < 1e-6, "{old}");
        // A contact born at the step slides at the second rate only.
        assert!((ratio(&law, [0.0, 1e-6], (10.0, 1e-6)) - 1.0).abs() < 1e-12);
    }
}
