//! The list of quantities of runs and of tables.
//!
//! An entry of `LIST` (file `list.rs`) gives name, unit and meaning of a quantity, how it scales with the
//! radius of the asperity and with the material, and how it is stored: as a scalar of a run and of a table, as a history
//! of the press, of the slide or of a table. Run file, summary, table and CSV loop
//! over this list. To add an output, add an entry here and the formula that computes it in
//! `asperity`; CONTRIBUTING.md lists the files. A scalar that is added to a released version is `optional`.
//!
//! Results are [`Scalars`] and [`History`], keyed by [`Quantity`]; [`numbers`] writes them as text. [`plausible`] has the
//! ranges of input quantities, [`functions`] has bisection, roots and linear interpolation. Depends on no other room. Chapter "What
//! is reported" of the book.

pub mod functions;
mod history;
mod list;
pub mod numbers;
pub mod plausible;
mod scalars;
mod words;

pub use history::{History, State};
pub use list::Quantity;
pub(crate) use scalars::same;
pub use scalars::{COVERAGE_FACTOR, Estimate, OF_BOUND, Scalars, WithUnit};
pub use words::{hint, nearest, values_by_path};

/// Where the history of a quantity is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stored {
    /// There is no history.
    No,
    /// The history is in `run.nc`, over the increments of the press.
    Press,
    /// The history is in `run.nc`, over the increments of the slide.
    Run,
    /// The history is in `run.nc` as well as in `table.nc`, there over the slip axis.
    RunAndTable,
}

/// Quantity of the elastic sphere that a scalar tends to as the interference falls; static friction does not depend on
/// heat, sliding friction does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ElasticLimit {
    /// None: the quantity is no scalar of a table.
    None,
    /// Hertz's load, while the sphere slides.
    Load,
    /// Hertz's load at the end of the press.
    LoadPress,
    /// πRω, while the sphere slides.
    Area,
    /// πRω at the end of the press.
    AreaPress,
    /// √(Rω) at the end of the press.
    ContactRadius,
    /// τ_c·A, with the softening by heat.
    SlidingFriction,
    /// τ_c·A/P, with the softening by heat.
    SlidingCoefficient,
    /// τ_c·A.
    StaticFriction,
    /// τ_c·A/P.
    StaticCoefficient,
    /// Slip of gross slip under the constant strength τ_c.
    InceptionSlip,
    /// Dissipation of partial slip per area.
    EnergyRelease,
    /// An energy in proportion to the area.
    Weakening,
    /// The value of the first row.
    FirstRow,
    /// A temperature rise, in proportion to the contact radius.
    TemperatureRise,
}

impl ElasticLimit {
    /// Whether the quantity belongs to the press and does not depend on sliding.
    pub fn is_of_press(self) -> bool {
        matches!(self, Self::LoadPress | Self::AreaPress | Self::ContactRadius)
    }
}

/// Name, unit, meaning and scaling of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Descriptor {
    /// The quantity described.
    pub quantity: Quantity,
    /// Name of the variable in files; `NAME_error` and `NAME_history` derive from it.
    pub name: &'static str,
    /// UDUNITS notation.
    pub units: &'static str,
    /// Meaning, in words.
    pub long_name: &'static str,
    /// n in x(R) = x(R_t)·(R/R_t)ⁿ at fixed ω/ω_c, VR and s/a₀.
    pub radius_exponent: i32,
    /// Exponents (m, n) of the unit σ_Yᵐ·E*ⁿ in which the quantity hardly changes with the initial
    /// temperature: at equal ω/ω_c a contact radius is in proportion to σ_Y/E*, a stress to σ_Y.
    pub material_exponents: (i32, i32),
    /// How the scalar is extrapolated below the first interference of a table.
    pub elastic_limit: ElasticLimit,
    /// Whether it is a scalar of a run and of a table.
    pub scalar: bool,
    /// What the scalar is of the history of the same name, where there is one.
    pub moment: &'static str,
    /// Where its history is stored.
    pub history: Stored,
    /// Whether a table may lack it.
    pub optional: bool,
}

/// Temperatures closer than this, relatively, are equal.
const ROUNDING: f64 = 1e-14;

impl Quantity {
    /// Every scalar, in the order of the list.
    pub const SCALARS: [Quantity; list::count(list::Selection::Scalars)] =
        list::select(list::Selection::Scalars);

    /// Every history of the press, in `run.nc`.
    pub const PRESS_HISTORIES: [Quantity; list::count(list::Selection::PressHistories)] =
        list::select(list::Selection::PressHistories);

    /// Every history of the slide, in `run.nc`.
    pub const RUN_HISTORIES: [Quantity; list::count(list::Selection::RunHistories)] =
        list::select(list::Selection::RunHistories);

    /// Every history of the slide that a table holds.
    pub const TABLE_HISTORIES: [Quantity; list::count(list::Selection::TableHistories)] =
        list::select(list::Selection::TableHistories);

    /// Entry of the quantity in the list.
    pub const fn descriptor(self) -> &'static Descriptor {
        &list::LIST[self as usize]
    }

    /// The quantity of that name.
    pub fn named(name: &str) -> Option<Self> {
        list::LIST.iter().find(|entry| entry.name == name).map(|entry| entry.quantity)
    }

    /// Multiple of an accuracy or tolerance that is asked of it: G changes by up to 6.6 times as much as the slip at
    /// sliding inception.
    pub fn allowance(self) -> f64 {
        if self == Quantity::EnergyRelease { 2.5 } else { 1.0 }
    }

    /// Whether it is an absolute temperature, whose error is a temperature difference.
    pub fn is_temperature(self) -> bool {
        self.descriptor().units == "K"
    }

    /// Origin from which its relative error and its logarithm are taken: the initial `temperature` (K) for
    /// temperatures, 0 for other quantities.
    pub fn origin(self, temperature: f64) -> f64 {
        if self.is_temperature() { temperature } else { 0.0 }
    }

    /// A value above that origin. A temperature that differs from the initial one by rounding is equal to it: its logarithm
    /// would be that of a rise.
    pub fn above_origin(self, value: f64, temperature: f64) -> f64 {
        let above = value - self.origin(temperature);
        if self.is_temperature() && above.abs() <= ROUNDING * temperature { 0.0 } else { above }
    }
}

#[cfg(test)]
mod tests;
