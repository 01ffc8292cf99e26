//! Notes, warnings and progress messages of a run: typed values, and the one place that puts them into
//! sentences.

mod warning;

use std::fmt::{self, Display, Formatter, Write};

use crate::heat::expected::{HeatChoice, HeatEffect};
use crate::loading::inception::InceptionCriterion;
use crate::loading::problem::{PressFriction, Problem, Units};
use crate::loading::state::SlideState;
use crate::scene::Scene;
use crate::simulate::accuracy::resolution::Resolution;
use tables::numbers::{beside, digits, plain, rounded};
use tables::quantity::Quantity;
pub use warning::Warning;

/// Choices of a run, with their reasons.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Note {
    #[error(
        "{} elements per contact radius, {} angles over the half circle, slip increments of {:.0} % of the slip",
        .0.elements_per_radius, .0.sectors, 100.0 * .0.increment_growth
    )]
    Resolution(Resolution),
    #[error("heat is {}", heat_in_words(.0, .1))]
    Heat(HeatChoice, HeatEffect),
    /// Length of a slide until friction is steady, over the contact radius after the press.
    #[error(
        "the slide ends after {} contact radii: {}",
        digits(*.slip, 2),
        match *.is_steady {
            true => format!("on a coarse mesh friction is within {} % of its steady value there", digits(100.0 * .accuracy, 2)),
            false => "on a coarse mesh friction is not steady before the contact outgrows its mesh, sticks, or does not converge, or before the longest slide that is tried".into(),
        }
    )]
    UntilSteady { slip: f64, accuracy: f64, is_steady: bool },
    /// P at the end of the press, N, and the interference that has it, ω₀/ω_c.
    #[error("the load of {} N is that of an interference of {} omega_c", plain(*.prescribed), plain(*.interference))]
    OfLoad { prescribed: f64, interference: f64 },
    /// Slip over the contact radius after the press.
    #[error("a slide on the coarse mesh went on to {} contact radii for mu_steady", digits(*.0, 2))]
    WentOn(f64),
    /// Share of the frictional heat that enters the asperity beside a conducting counterface.
    #[error(
        "the counterface conducts: {:.1} % of the frictional heat enters the asperity at the end of the slide, {:.1} % at its start{}",
        100.0 * .last,
        100.0 * .first,
        if *.expands { "" } else { "; its thermal expansion is left out" }
    )]
    HeatPartition { first: f64, last: f64, expands: bool },
    #[error("{0}")]
    Strain(StrainChoice),
    /// Beside an elastic counterface.
    #[error(
        "the press is {}, the closer of both beside this elastic counterface (Dundurs' beta squared differs by {}, which the errors include)",
        if .0.sticks { "in full stick" } else { "without friction" },
        digits(.0.neglected, 2)
    )]
    Press(PressFriction),
    /// The first resolution, chosen for the accuracy `planned`, is the last one, as the body may shear without limit.
    #[error(
        "the resolution is chosen for an accuracy of {:.0} % and not refined: the body does not harden and is no stronger than the interface, so shear localises in the elements below it; give material.hardening, or interface.strength_factor below 1, for a higher accuracy",
        100.0 * .planned
    )]
    UnlimitedShear { planned: f64 },
    /// The part of the solver in the relative error of a quantity is above the accuracy.
    #[error(
        "not refined: {} changes by {:.1} % with the tolerance of equilibrium, above the accuracy of {:.1} %, and no finer mesh reduces that; the body hardly resists more than the interface transmits: give more hardening, interface.strength_factor below 1, or no rate law",
        .quantity.descriptor().name,
        100.0 * .solver,
        100.0 * .accuracy
    )]
    AccuracyOutOfReach { quantity: Quantity, solver: f64, accuracy: f64 },
    /// A refinement would take longer than the factor of the expected time, s.
    #[error(
        "not refined further: that would take about {next:.0} s more, and {expected:.0} s were expected; numerics.elements_per_radius = {elements} and numerics.sectors = {sectors} take that mesh at once"
    )]
    RefinementTooLong { next: f64, expected: f64, elements: usize, sectors: usize },
    /// A refinement did not reduce the largest relative error.
    #[error(
        "not refined further: the last refinement changed the largest error from {before:.2} to {after:.2} times what is asked"
    )]
    RefinementStopped { before: f64, after: f64 },
    /// A finer run ended before its slide did.
    #[error(
        "not refined further: the run on {elements} elements per contact radius and {sectors} angles did not reach its end: {cause}"
    )]
    RefinementFailed { elements: usize, sectors: usize, cause: String },
    /// The run was repeated on a mesh with more room.
    #[error(
        "repeated: the contact grew to {radius_ratio:.2} times its radius after the press, past the fine mesh, which now has room for {room:.2} times"
    )]
    Remeshed {
        /// Contact radius over that after the press.
        radius_ratio: f64,
        /// Largest contact radius over that after the press for which the mesh has room.
        room: f64,
    },
    /// Optional keys of the scene with their default values.
    #[error("at their defaults: {}", .0.join(", "))]
    Defaults(Vec<String>),
}

/// Small or finite strain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrainChoice {
    pub finite: bool,
    /// Plastic strain to expect of press and slide; infinite where the body may shear without limit.
    pub expected: f64,
    /// Up to which strain is taken to be small.
    pub limit: f64,
    /// Relative change of friction by finite elastic strain, or of `G` over its allowance.
    pub elastic: f64,
    /// Up to which it joins the errors.
    pub elastic_limit: f64,
}

impl Note {
    /// The one that a scene has before any run.
    pub fn of_scene(scene: &Scene) -> Self {
        Self::Defaults(scene.defaults_in_effect())
    }

    /// How the asperity is pressed, if that depends on the counterface.
    pub(super) fn press(problem: &Problem) -> Option<Self> {
        let press = problem.press_friction;
        let depends = problem.interface.law.has_friction() && (!press.sticks || press.neglected > 0.0);
        depends.then_some(Self::Press(press))
    }

    /// The partition that a slide against a conducting counterface found.
    pub(super) fn heat_partition(problem: &Problem, history: &[SlideState]) -> Option<Self> {
        let (first, last) = (history.first()?.heat_partition, history.last()?.heat_partition);
        let expands = problem.counterface.as_ref()?.expands();
        let heated = history.last()?.heat_counterface != 0.0;
        heated.then_some(Self::HeatPartition { first, last, expands })
    }
}

fn heat_in_words(choice: &HeatChoice, effect: &HeatEffect) -> String {
    match choice {
        HeatChoice::Coupled => format!("included: {effect}"),
        HeatChoice::SwitchedOff => "left out: it is switched off".into(),
        HeatChoice::AtRest => "left out: the slip rate is 0, the isothermal limit".into(),
        HeatChoice::NoFriction => "left out: there is no friction".into(),
        HeatChoice::Negligible => format!("left out: {effect}, which the errors include"),
    }
}

impl Display for StrainChoice {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { finite, expected, limit, elastic, elastic_limit } = *self;
        match finite {
            true if expected.is_infinite() => {
                write!(
                    f,
                    "finite strain: the interface is at least as strong as the body, which may shear far"
                )
            }
            true if elastic > elastic_limit => write!(
                f,
                "finite strain: elastic strain of this material changes mu by about {}, or G by 2.5 times this",
                digits(elastic, 2)
            ),
            true => write!(
                f,
                "finite strain: a plastic strain of about {} is expected, above {}",
                beside(expected, rounded(limit, 3), 3),
                plain(rounded(limit, 3))
            ),
            false => write!(
                f,
                "small strain: a plastic strain of no more than {} is expected; kinematics = \"finite\" \
                 would change mu by about that share, and mu by {} or G by 2.5 times this through elastic strain, which the errors include",
                digits(expected, 3),
                digits(elastic, 2)
            ),
        }
    }
}

impl Display for HeatEffect {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if self.softening >= 1.0 {
            return write!(f, "at its full strength the contact would melt");
        }
        let softening = 100.0 * self.softening;
        write!(
            f,
            "a rise of about {:.2} K takes {softening:.2} % of the strength and changes the load ",
            self.rise
        )?;
        match self.load {
            load if load < 1.0 => write!(f, "by {:.2} %", 100.0 * load),
            _ => write!(f, "altogether"),
        }
    }
}

impl Display for InceptionCriterion {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::FullSlip => "less than 1 % of the contact area sticks",
            Self::Stiffness => "dQ/ds below 1 % of its initial value",
            Self::AtOnce => "the contact slips as a whole: friction falls faster than it unloads",
            Self::None => "not reached",
        })
    }
}

impl serde::Serialize for Note {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// A run of a slide: its part of the progress of the whole, and where it ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct RunProgress {
    /// Kind of the run, with a colon; empty for a main run.
    pub kind: &'static str,
    /// Shares of the whole at the start and at the end of the run.
    pub span: (f64, f64),
    /// Whether the slide goes on until its steady friction is known.
    pub goes_on: bool,
    /// Iterations of Newton's method and of its linear systems beyond which the slide ends.
    pub most_iterations: usize,
}

impl RunProgress {
    /// A run that ends with the slide.
    pub fn new(kind: &'static str, span: (f64, f64)) -> Self {
        Self { kind, span, goes_on: false, most_iterations: usize::MAX }
    }

    /// Share of the whole after a share `done` of the run.
    pub fn at(&self, done: f64) -> f64 {
        let (from, to) = self.span;
        from + (to - from) * done
    }

    /// Kind of the run and last state of the slide in one line.
    pub fn describe(&self, units: &Units, history: &[SlideState]) -> String {
        let mut text = self.kind.to_owned();
        let [start, .., now] = history else { return text };
        // Writing to a String cannot fail.
        let _ = write!(
            text,
            "step {}, slip {:.3} a0, contact radius {:.3} a0, mu {:.3}, {:.0} % sticks",
            history.len() - 1,
            now.slip / start.radius(),
            now.radius() / start.radius(),
            now.friction / now.load,
            100.0 * now.stick_fraction,
        );
        if now.rise_max > 0.0 {
            let _ = write!(text, ", up to {:.0} K", units.temperature + now.rise_max);
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_state_is_described_relative_to_the_first() {
        let units = Units { length: 1e-3, stress: 1e9, time: 1.0, temperature: 298.0 };
        let start = SlideState { area: 4e-4, load: 2.0, stick_fraction: 1.0, ..SlideState::default() };
        let progress = RunProgress::new("finer: ", (0.0, 1.0));
        assert_eq!(progress.describe(&units, &[start]), "finer: ");
        let slip = 0.25 * (4e-4 / std::f64::consts::PI).sqrt();
        let (area, friction, stick_fraction, rise_max) = (9e-4, 0.6, 0.125, 100.4);
        let now = SlideState { slip, area, friction, stick_fraction, rise_max, ..start };
        assert_eq!(
            progress.describe(&units, &[start, now]),
            "finer: step 1, slip 0.250 a0, contact radius 1.500 a0, mu 0.300, 12 % sticks, up to 398 K"
        );
    }
}
