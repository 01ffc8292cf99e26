//! Friction that heats and so weakens the contact, τ = τ₀(1 − T/ΔT_m), L = τ₀Va/(kΔT_m).
//!
//! Steady sliding: the T of the flux τV on a disc, H. S. Carslaw & J. C. Jaeger, *Conduction of Heat in Solids* (1959),
//! §8.2, solved ring by ring with 5 digits. First moments: J. R. Rice, J. Geophys. Res. 111, B05311 (2006), doi
//! 10.1029/2005JB004006, slip on a plane: τ/τ₀ = exp(s) erfc(√s), s = u/L* = L²Fo. That holds in the middle of the
//! contact. The energy is that of the mean traction, with the mean rise of a disc, at first 2√(Fo/π) − 2Fo/π: the
//! transform of τ/τ₀ is 1/(p + √p − ε), ε = 2/(πL), hence τ/τ₀ = (g(−x₁) − g(−x₂))/(x₁ − x₂) with x₁,₂ the roots of
//! x² + x − ε and g(y) = −y exp(y²s) erfc(y√s), and G/(τ₀L*) = ∫τ/τ₀ ds − sτ/τ₀.

use tables::law::Estimate;
use tables::quantity::Quantity;

use super::heat_source::{Heated, RANGE, START, slide};
use super::setup::{last, over};
use super::{Case, Computed, Cost, Reference, Row, Rows, Tolerance, joined};
use crate::simulate::Watch;

const STEADY: &str = "Carslaw & Jaeger 1959, sec. 8.2, ring collocation";
const PLANE: &str = "Rice 2006, doi 10.1029/2005JB004006";
const DISC: &str = "Rice 2006 with the mean rise of a disc, Carslaw & Jaeger 1959, sec. 10.5";

/// At Fo = 10⁶, 1/(2√(πFo)) is left of the approach to the steady state; direction of slip, 0.1 %.
const LEFT: f64 = 0.0003 + 0.001;
const WHY_STEADY: &str = "mesh error e of the rise, 0.5 n_c^-1.5: e L'/(1 + L') of Q and e/(1 + L') of T, L' = 8L/(3 pi); \
                          approach and direction of slip, 0.13 %";

/// L, Q/Q₀, largest rise over ΔT_m; tolerances of the two with 16 elements.
struct Steady {
    softening: f64,
    friction: (f64, f64),
    rise: (f64, f64),
}

const ON_8: Steady = Steady { softening: 1.0, friction: (0.54326, 0.0115), rise: (0.52052, 0.0133) };
const ON_16: [Steady; 5] = [
    Steady { softening: 0.01, friction: (0.99158, 0.0014), rise: (0.00991, 0.0092) },
    Steady { softening: 0.1, friction: (0.92184, 0.002), rise: (0.09171, 0.0087) },
    Steady { softening: 1.0, friction: (0.54326, 0.005), rise: (0.52052, 0.0056) },
    Steady { softening: 10.0, friction: (0.10933, 0.0085), rise: (0.93195, 0.0022) },
    Steady { softening: 30.0, friction: (0.03991, 0.0091), rise: (0.97798, 0.0016) },
];

pub const CASES: [Case; 5] = [
    Case::new("steady sliding, 8 elements", Cost::Quick, |watch| steady(&ON_8, 8, watch)),
    Case::new("first moments", Cost::Quick, |watch| first_moments(0.1, 0.723578, 7.44885e-3, watch)),
    Case::new("steady sliding in the limit", Cost::Medium, |watch| {
        joined(ON_16[1..4].iter().map(|case| limit(case, watch)))
    }),
    Case::new("first moments, earlier and later", Cost::Medium, |watch| {
        joined([
            first_moments(0.01, 0.896457, 3.03545e-4, watch),
            first_moments(1.0, 0.427584, 0.120980, watch),
        ])
    }),
    Case::new("steady sliding, 16 elements", Cost::Long, |watch| {
        joined(ON_16.iter().map(|case| steady(case, 16, watch)))
    }),
];

/// Q/Q₀ with the error stated for Q: the area of Q₀ is that of the same contact.
fn friction_ratio(heated: &Heated) -> Estimate {
    let end = last(&heated.outcome);
    let error = heated.outcome.scalars[Quantity::Friction].error;
    over(Estimate { value: end[Quantity::Friction], error }, end[Quantity::Area] * heated.strength)
}

fn steady(case: &Steady, elements: usize, watch: &dyn Watch) -> Rows {
    let softening = case.softening;
    let heated = slide(softening, 1e6, true, elements, watch)?;
    // At the end: the largest of the slide is that of the first increments, which the cold strength heats.
    let rise = (last(&heated.outcome)[Quantity::TemperatureMax] - START) / RANGE;
    let row = |name: &str, computed: Computed, (reference, bound): (f64, f64)| {
        let name = format!("{name}, steady, L = {softening}, {elements} elements");
        let reference = Reference::exact(reference, STEADY).known_to(LEFT);
        Row::new(name, computed, reference, Tolerance::relative(bound, WHY_STEADY))
    };
    Ok(vec![
        row("Q/Q_0", friction_ratio(&heated).into(), case.friction),
        row("T_max/dT_m", rise.into(), case.rise),
    ])
}

/// Richardson's limit at order 1.5 from 6 and 12 elements.
fn limit(case: &Steady, watch: &dyn Watch) -> Rows {
    let softening = case.softening;
    let [coarse, fine] = [6, 12].map(|elements| slide(softening, 1e6, true, elements, watch));
    let [coarse, fine] = [friction_ratio(&coarse?).value, friction_ratio(&fine?).value];
    let limit = fine + (fine - coarse) / (2f64.powf(1.5) - 1.0);
    let reference = Reference::exact(case.friction.0, STEADY).known_to(LEFT);
    let tolerance = Tolerance::relative(0.003, "a seventh of the correction; approach and direction, 0.13 %");
    let name = format!("Q/Q_0, steady, L = {softening}, limit from 6 and 12 elements");
    Ok(vec![Row::new(name, limit, reference, tolerance)])
}

/// At Fo = 0.01 with 8 elements.
fn first_moments(s: f64, stress: f64, energy: f64, watch: &dyn Watch) -> Rows {
    const FOURIER: f64 = 0.01;
    let heated = slide((s / FOURIER).sqrt(), FOURIER, true, 8, watch)?;
    // At the centre the contact is a plane.
    let centre = heated.outcome.snapshots.last().map_or(f64::NAN, |fields| fields.shear[0]) / heated.strength;
    // L* = u/s; τ̄ peaks where sliding begins, after 1/2000 of the slip.
    let unit = heated.strength * heated.distance / s;
    let release = over(heated.outcome.scalars[Quantity::EnergyWeakening], unit);
    Ok(vec![
        Row::new(
            format!("tau/tau_0 of the first moments at s = {s}"),
            centre,
            Reference::exact(stress, PLANE),
            Tolerance::relative(0.01, "some four layers in the heated one of 0.1 a"),
        ),
        Row::new(
            format!("G/(tau_0 L*) of the first moments at s = {s}"),
            release,
            Reference::exact(energy, DISC).known_to(0.002),
            Tolerance::relative(0.01, "mesh; traction that is not uniform over the contact"),
        ),
    ])
}
