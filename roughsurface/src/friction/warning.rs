//! Warnings: limits of validity that a result reaches.

use crate::integral::height_integral::NEGLIGIBLE_SHARE;
use crate::surface::query::{Interaction, Query};
use crate::topography::warning;
use std::fmt;
use tables::closed_forms::adhesion::CONTAMINATED_METALS;
use tables::closed_forms::partial_slip::SHORTEST_INCEPTION;
use tables::law::{AboveRange, AsperityLaw};
use tables::numbers::{beside, digits, plain};
use tables::table::sentences::{Sentence, condensed};

/// Real area fraction above which summits no longer deform independently: a few per cent.
const INTERACTION: f64 = 0.05;

/// Real area fraction f above which contacts merge: of equal contacts at random places 1 − exp(−4f), a third, overlap
/// another.
const MERGING: f64 = 0.1;

/// Pressure or separation and slip rate that a warning is about.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    pub loading: String,
    /// m/s.
    pub slip_rate: f64,
}

impl Place {
    /// Row (pressure or separation) and column (slip rate) of a query.
    pub fn of(query: &Query, row: usize, rate: usize) -> Self {
        Self { loading: query.loading.describe(row), slip_rate: query.slip_rates[rate] }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        write!(formatter, "{}, {} m/s", self.loading, plain(self.slip_rate))
    }
}

/// A warning, with the numbers that it rests on; `Display` renders it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Warning {
    #[error(
        "{at}: {:.2} % of the load lies above the last interference of the table and is extrapolated towards the fully plastic limit",
        100.0 * .share
    )]
    Extrapolated { at: Place, share: f64 },
    #[error(
        "{at}: {:.0} % of the load lies below the first interference of the table and is extrapolated towards elastic contact; a table from a smaller interference on states it",
        100.0 * .share
    )]
    BelowTable { at: Place, share: f64 },
    #[error(
        "{at}: {} of the heights of the sample are in contact, and friction is that of these few summits; a larger sample or a distribution describes the surface",
        digits(*.count, 2)
    )]
    FewContacts { at: Place, count: f64 },
    #[error(
        "{at}: a nominal area with sides of {} m has {} contacts on average: friction is the mean over many such areas, from which that of one may be far; `roughsurface sample` draws finite surfaces",
        plain(*.size),
        digits(*.count, 2)
    )]
    SmallArea { at: Place, size: f64, count: f64 },
    #[error(
        "{at}: up to {:.2} % of the load of a surface lies above the last interference of the table and is extrapolated towards the fully plastic limit",
        100.0 * .share
    )]
    SamplesExtrapolated { at: Place, share: f64 },
    #[error(
        "{law}: its formulae end at {} omega_c; asperities above carry up to {:.1} % of the load ({count} of {of} results){}",
        digits(*.limit, 3), 100.0 * .share,
        if *.without_friction { "; where it is above 5 %, there is no friction coefficient (n/a)" } else { "" }
    )]
    BeyondFormulae { law: String, limit: f64, share: f64, count: usize, of: usize, without_friction: bool },
    #[error(
        "{at}: the hottest contacts reach {} K, above the melting temperature of {} K",
        beside(*.highest, *.melting, 4),
        plain(*.melting)
    )]
    AboveMelting { at: Place, highest: f64, melting: f64 },
    #[error(
        "{at}: friction heats a nominal contact longer than {} m along the slip by more than a fifth of {} K, the mean rise of its contacts, and one of {} m by up to {} K; this heat is left out: give the raised temperature as temperature of [query], with a table over initial temperatures",
        digits(*.length, 2),
        digits(*.rise, 2),
        plain(*.nominal),
        digits(*.nominal_rise, 2)
    )]
    NominalHeating { at: Place, length: f64, rise: f64, nominal: f64, nominal_rise: f64 },
    #[error(
        "{at}: friction heats faces that stay in contact by more than a fifth of {} K, the mean rise of their contacts, within {} s, and by up to {} K within {} s; this heat is left out: give the raised temperature as temperature of [query], with a table over initial temperatures",
        digits(*.rise, 2),
        digits(*.time, 2),
        digits(*.face_rise, 2),
        plain(*.after)
    )]
    HeatOfFaces { at: Place, time: f64, rise: f64, after: f64, face_rise: f64 },
    #[error(
        "the table is of a strength that grows with the strain rate: it holds at its own radius; at {} m values are corrected for the strength there, and mu is uncertain by up to {:.1} % more",
        digits(*.radius, 6),
        100.0 * .share
    )]
    StrainRate { radius: f64, share: f64 },
    #[error(
        "the strength of {table} is that at low strain rates; with that of the interface at the strain rates of the contacts, in {with_rate_law}{}, static friction is {:.0} % larger (at 20 omega_c, 0.1 mm and 1 m/s)",
        if table.ends_with("-rigid") { " (beside a counterface that conducts heat)" } else { "" },
        100.0 * .share
    )]
    StrengthAtLowRates { table: String, with_rate_law: String, share: f64 },
    #[error(
        "{at}: {:.1} % of the load rests on contacts whose slides in the table end before sliding begins: after a longer slip friction is that of their end; a table of a longer slip_distance goes on",
        100.0 * .share
    )]
    SamplesNotSliding { at: Place, share: f64 },
    #[error(
        "{at}: {:.1} % of the load rests on contacts whose slides in the table end before sliding begins: mu_static, inception_slip, G, G_weakening, weakening_distance and mu_history beyond these slides are n/a, mu and mu_steady rest on the steady friction of the table; a table of a longer slip_distance states them",
        100.0 * .share
    )]
    NotSliding { at: Place, share: f64 },
    #[error(
        "{at}: contacts live for a slip of {} m, of which they stick for {:.0} %: mu is that of contacts that hardly slide; a larger contact_life is nearer to sliding friction",
        digits(*.life, 2),
        100.0 * (.inception / .life).min(1.0)
    )]
    ShortLife { at: Place, life: f64, inception: f64 },
    #[error("{at}: friction still rises at the end of the slide; mu_static is the last value")]
    StillRising { at: Place },
    #[error(
        "{at}: {:.1} % of the load rests on contacts that slide farther than the slides of the table, and {}",
        100.0 * .share,
        if *.known { "their steady friction is uncertain by more than 20 %" } else { "the table does not state their steady friction: mu is n/a" }
    )]
    Unsteady { at: Place, share: f64, known: bool },
    #[error(
        "{at}: mu_steady is uncertain by {:.0} %: slides of the table end before they are steady, or the load lies beyond its interferences",
        100.0 * .error
    )]
    SteadyUncertain { at: Place, error: f64 },
    #[error(
        "{at}: sliding begins within {} times the time of a shear wave across a contact: below {SHORTEST_INCEPTION}, inertia changes mu_static and G, which are those of a slow onset",
        beside(*.time, SHORTEST_INCEPTION, 2)
    )]
    FastInception { at: Place, time: f64 },
    #[error(
        "{at}: a contact bears {} N on average, less than the pull-off force 2 pi w R = {} N with an energy of adhesion w of {} J/m2, that of contaminated metals: adhesion, which the model leaves out, presses the contacts more than the load",
        digits(*.load, 2),
        digits(*.pull_off, 2),
        plain(CONTAMINATED_METALS)
    )]
    Adhesion { at: Place, load: f64, pull_off: f64 },
    #[error(
        "{at}: mu_static is {:.2}: the shear strength of the interface exceeds the pressure of the contacts, at which adhesion, not contained in the model, is no longer negligible; check heights, radius and strength",
        .friction
    )]
    StrongInterface { at: Place, friction: f64 },
    #[error(
        "the table does not state steady friction; mu_steady is n/a. Tables made with this version state it"
    )]
    NoSteadyFriction,
    #[error(
        "{at}: {:.0} % of the nominal area is in contact; neighbouring asperities, here independent, would interact: interaction = \"mean-pressure\" of [query] displaces the mean plane, which changes separation and stiffness but not the friction at a given pressure",
        100.0 * .share
    )]
    AsperitiesInteract { at: Place, share: f64 },
    #[error(
        "{at}: {:.0} % of the nominal area is in contact; neighbouring contacts, here separate, would merge: area and friction at this pressure are uncertain beyond the stated errors",
        100.0 * .share
    )]
    ContactsMerge { at: Place, share: f64 },
    #[error("{at}: the bias is unknown, as the surface of infinite extent is refused: {reason}")]
    UnknownBias { at: Place, reason: String },
    #[error("{at}: {idle} of {count} surfaces have no asperity in contact and no friction coefficient")]
    SamplesWithoutContact { at: Place, idle: usize, count: usize },
    #[error(
        "{at}: surfaces touch on {} asperities on average, and their friction may be far from normally distributed: the intervals may hold less than 95 %, those of surfaces with one asperity in contact 30 % and less; more asperities or a higher pressure have more contacts",
        digits(*.contacts, 2)
    )]
    SamplesWithFewContacts { at: Place, contacts: f64 },
    #[error("{0}")]
    Implausible(String),
    #[error(
        "asperity density x mean radius x standard deviation of the heights is {}; of random surfaces it is 0.01 to 1 (Nayak 1971): is one of them in another unit?",
        digits(*.product, 2)
    )]
    UnlikeRandomSurfaces { product: f64 },
    #[error("topography: {0}")]
    Topography(warning::Warning),
    #[error(
        "{key} = {} in [material] is not used: the constants are those of the table, {}; [material] is that of closed forms",
        plain(*.stated),
        plain(*.of_table)
    )]
    MaterialUnused { key: &'static str, stated: f64, of_table: f64 },
    #[error(
        "uncertainty.tables.{key} differs from the table in {} constants ({}): its change is that of all of them together",
        .constants.len(),
        .constants.join(", ")
    )]
    TablesDiffer { key: String, constants: Vec<String> },
    #[error(
        "uncertainty.{key}: varied in one direction only, to first order: in the other the slip rates are outside the table"
    )]
    OneSided { key: &'static str },
    #[error(
        "cells without results, interpolated around, or left out with their interference or slip rate: {}",
        .cells.join("; ")
    )]
    CellsMissing { cells: Vec<String> },
    #[error(
        "chang-etsion-bogy: its static friction was published for a Poisson ratio of 0.3, not {poisson_ratio}"
    )]
    PoissonRatioOfChangEtsionBogy { poisson_ratio: f64 },
    /// Key and value of the interface of the table.
    #[error(
        "--compare: the interface of the table has {interface}, while those of the models are as strong as the metal or in full stick"
    )]
    ComparedInterface { interface: String },
}

impl Warning {
    /// The warning that contacts interact or merge, where that share of the nominal area is in contact.
    pub fn of_area(query: &Query, share: f64, at: impl Fn() -> Place) -> Option<Self> {
        if share > MERGING {
            return Some(Self::ContactsMerge { at: at(), share });
        }
        let independent = query.interaction == Interaction::None && share > INTERACTION;
        independent.then(|| Self::AsperitiesInteract { at: at(), share })
    }

    /// The warning that formulae of the `law` are used above their range, if these shares of the load are there.
    pub fn beyond_formulae(law: &dyn AsperityLaw, outside: impl Iterator<Item = f64>) -> Option<Self> {
        let without_friction = match law.above_range() {
            AboveRange::Extrapolated => return None,
            AboveRange::Formulae => false,
            AboveRange::NoFriction => true,
        };
        let (mut share, mut count, mut of) = (0.0, 0, 0);
        for outside in outside {
            share = f64::max(share, outside);
            count += usize::from(outside > NEGLIGIBLE_SHARE);
            of += 1;
        }
        let (law, limit) = (law.name(), law.interference_limit());
        (count > 0).then_some(Self::BeyondFormulae { law, limit, share, count, of, without_friction })
    }

    /// Sentences, one for all warnings that differ in their numbers only, with the range of each number.
    pub fn condensed(warnings: &[Warning]) -> Vec<String> {
        let sentences = warnings.iter().enumerate().map(|(place, warning)| {
            Sentence::new(&warning.to_string(), (place, 0)).standing_alone(warning.stands_alone())
        });
        let text = |sentence: Sentence| match sentence.places.len() {
            1 => sentence.text(),
            places => format!("{} ({places} points)", sentence.text()),
        };
        condensed(sentences).into_iter().map(text).collect()
    }

    /// Whether another one of its kind is about something else, not about another place.
    fn stands_alone(&self) -> bool {
        matches!(
            self,
            Self::Implausible(_)
                | Self::UnlikeRandomSurfaces { .. }
                | Self::Topography(_)
                | Self::MaterialUnused { .. }
                | Self::StrengthAtLowRates { .. }
                | Self::TablesDiffer { .. }
                | Self::OneSided { .. }
                | Self::PoissonRatioOfChangEtsionBogy { .. }
                | Self::ComparedInterface { .. }
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn warnings_of_a_kind_are_one_sentence_with_their_number() {
        let at = |slip_rate| Place { loading: "1e6 Pa".into(), slip_rate };
        let mut warnings: Vec<Warning> =
            (1..=9).map(|rate| Warning::StillRising { at: at(f64::from(rate)) }).collect();
        warnings.push(Warning::Extrapolated { at: at(1.0), share: 0.01 });
        for remark in ["x is 1 m", "x is 2 m"] {
            warnings.push(Warning::Implausible(remark.into()));
            warnings.push(Warning::AboveMelting { at: at(1.0), highest: 2000.0, melting: 1800.0 });
        }
        let said = Warning::condensed(&warnings);
        assert_eq!(said.len(), 5, "{said:?}");
        assert!(said[0].starts_with("1e6 Pa, 1 to 9 m/s") && said[0].ends_with("(9 points)"), "{said:?}");
        assert!(!said[1].contains("points"));
    }
}
