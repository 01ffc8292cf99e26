//! The keys of scene and request files: unit and range of every number, and the laws that take a key.
//!
//! Names, defaults and required keys are defined by the types of [`crate::scene`] through serde; this list adds what
//! serde cannot express.

use std::collections::BTreeSet;

use serde::de::DeserializeOwned;
use toml::{Table, Value};

use super::source::join;
use crate::scene::{ELEMENTS_PER_RADIUS, FrictionLaw, Hardening, Rate, Softening};

/// What a number may be.
#[derive(Clone, Copy)]
pub struct Range {
    /// Text as in "must be …", without the unit.
    text: &'static str,
    accepts: fn(f64) -> bool,
}

const fn range(text: &'static str, accepts: fn(f64) -> bool) -> Range {
    Range { text, accepts }
}

pub const POSITIVE: Range = range("a positive number", |x| x > 0.0 && x.is_finite());
const POSITIVE_OR_INFINITE: Range = range("a positive number or inf", |x| x > 0.0);
pub const POSITIVE_FOR_LOG: Range =
    range("a positive number; zero needs spacing = \"linear\"", POSITIVE.accepts);
pub const NOT_NEGATIVE: Range = range("zero or a positive number", |x| x >= 0.0 && x.is_finite());
const SHARE: Range = range("a number from 0 to 1", |x| (0.0..=1.0).contains(&x));
/// Poisson's ratio of an isotropic solid that is neither auxetic nor incompressible.
const POISSON: Range = range("a number from 0 to less than 0.5", |x| (0.0..0.5).contains(&x));
/// Below, the plastic strain at a stress just above the yield strength, (σ/B)^(1/n), is less than the smallest number.
const HARDENING_EXPONENT: Range = range("a number from 0.02 to 10", |x| (0.02..=10.0).contains(&x));
const ACCURACY: Range = range("a number from 1e-6 to 0.5", |x| (1e-6..=0.5).contains(&x));

/// Range from far below an atom to far above a planet: lengths, areas and energies are numbers of normal precision.
const RADIUS: Range = range("a positive number from 1e-15 to 1e15", |x| (1e-15..=1e15).contains(&x));
/// Up to far above the speed of sound in any solid.
const FASTEST: f64 = 1e6;
pub const SLIP_RATE: Range = range("zero or a positive number up to 1e6", |x| (0.0..=FASTEST).contains(&x));
/// Far beyond the slip at which friction is steady.
const SLIP_DISTANCE: Range = range("a number from 0 to 10000", |x| (0.0..=1e4).contains(&x));
const STEP_DISTANCE: Range = range("a positive number up to 10000", |x| x > 0.0 && x <= 1e4);
/// Negative in a reversed slide.
const STEP_SLIP_RATE: Range =
    range("a number from -1e6 to 1e6 other than 0", |x| x != 0.0 && (-FASTEST..=FASTEST).contains(&x));

impl Range {
    pub fn accepts(&self, value: f64) -> bool {
        (self.accepts)(value)
    }

    /// Text with the unit, unless it is a pure number.
    pub fn with_unit(&self, unit: &str) -> String {
        match unit {
            "1" => self.text.to_owned(),
            unit => format!("{} ({unit})", self.text),
        }
    }
}

/// Order of the numbers of a list.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Order {
    Any,
    /// Each larger than the one before.
    Rising,
    /// None smaller than the one before, no three equal: two equal abscissae make a jump.
    NotFalling,
}

/// What the value of a key is.
#[derive(Clone, Copy)]
pub enum Kind {
    /// Unit and range.
    Number(&'static str, Range),
    /// Unit and range, or this name.
    NumberOr(&'static str, Range, &'static str),
    /// A number, or its table over temperature.
    Property(&'static str, Range),
    /// A list of numbers, not empty.
    List(&'static str, Range, Order),
    /// A whole number between these limits that is a multiple of the third.
    Count(usize, usize, usize),
    /// One of the names that the type of the key lists.
    Name,
    /// One of the laws of the section.
    Law(fn() -> Vec<String>),
    Flag,
    Section(&'static [Key]),
    /// A list of sections, not empty.
    Sections(&'static [Key]),
}

/// A key of a section.
#[derive(Clone, Copy)]
pub struct Key {
    pub name: &'static str,
    pub kind: Kind,
    /// Laws of the section that take the key; none where all do.
    pub laws: &'static [&'static str],
}

pub const fn key(name: &'static str, kind: Kind) -> Key {
    Key { name, kind, laws: &[] }
}

/// A parameter of some laws of the section.
const fn parameter(laws: &'static [&'static str], name: &'static str, kind: Kind) -> Key {
    Key { name, kind, laws }
}

/// Names of the laws of a type.
fn laws<T: DeserializeOwned>() -> Vec<String> {
    let unknown = Table::from_iter([("law".to_owned(), Value::from("?"))]);
    let error = unknown.try_into::<T>().err().expect("no law has this name");
    choices(error.message()).expect("serde lists the laws")
}

/// The known names in serde's message on an unknown one.
pub fn choices(message: &str) -> Option<Vec<String>> {
    let quoted = || message.split('`').skip(1).step_by(2);
    message.starts_with("unknown variant").then(|| quoted().skip(1).map(String::from).collect())
}

pub fn one_of(names: &[String]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("{name:?}")).collect();
    format!("one of {}", names.join(", "))
}

use Kind::{Count, Flag, Law, List, Name, Number, NumberOr, Property, Section, Sections};

/// All sections of a scene.
pub const SCENE: &[Key] = &[
    key("material", Section(MATERIAL)),
    key("asperity", Section(&[key("radius", Number("m", RADIUS))])),
    key("interface", Section(INTERFACE)),
    key("counterface", Section(COUNTERFACE)),
    key("loading", Section(LOADING)),
    key("model", Section(&[key("heat", Name), key("kinematics", Name)])),
    key("numerics", Section(NUMERICS)),
];

const MATERIAL: &[Key] = &[
    key("preset", Name),
    key("youngs_modulus", Property("Pa", POSITIVE)),
    key("poisson_ratio", Number("1", POISSON)),
    key("yield_strength", Number("Pa", POSITIVE)),
    key("hardening", Section(HARDENING)),
    key("rate", Section(RATE)),
    key("density", Number("kg/m3", POSITIVE)),
    key("specific_heat", Property("J/(kg K)", POSITIVE)),
    key("thermal_conductivity", Property("W/(m K)", POSITIVE)),
    // Zero switches expansion off.
    key("thermal_expansion", Property("1/K", NOT_NEGATIVE)),
    key("softening", Section(SOFTENING)),
    key("shear_fracture_energy", Number("J/m2", POSITIVE)),
    key("fracture_toughness_mode_ii", Number("Pa sqrt(m)", POSITIVE)),
    key("tensile_strength", Number("Pa", POSITIVE)),
    key("uniform_elongation", Number("1", NOT_NEGATIVE)),
];

const HARDENING: &[Key] = &[
    key("law", Law(laws::<Hardening>)),
    parameter(&["linear", "johnson-cook"], "modulus", Number("Pa", NOT_NEGATIVE)),
    parameter(&["johnson-cook"], "exponent", Number("1", HARDENING_EXPONENT)),
    parameter(&["table"], "plastic_strain", List("1", NOT_NEGATIVE, Order::Rising)),
    parameter(&["table"], "factor", List("1", POSITIVE, Order::Any)),
];

const RATE: &[Key] = &[
    key("law", Law(laws::<Rate>)),
    parameter(&["johnson-cook"], "coefficient", Number("1", NOT_NEGATIVE)),
    parameter(&["johnson-cook"], "reference", Number("1/s", POSITIVE)),
];

const SOFTENING: &[Key] = &[
    key("law", Law(laws::<Softening>)),
    parameter(&["johnson-cook"], "reference", Number("K", POSITIVE)),
    parameter(&["johnson-cook"], "melting", Number("K", POSITIVE)),
    parameter(&["johnson-cook"], "exponent", Number("1", POSITIVE)),
    parameter(&["table"], "temperature", List("K", NOT_NEGATIVE, Order::Rising)),
    parameter(&["table"], "factor", List("1", NOT_NEGATIVE, Order::Any)),
];

const INTERFACE: &[Key] = &[
    key("law", Law(laws::<FrictionLaw>)),
    parameter(&["coulomb"], "friction", Number("1", NOT_NEGATIVE)),
    parameter(&["coulomb", "briscoe-tabor"], "cap", Flag),
    parameter(&["briscoe-tabor"], "film_strength", Number("Pa", NOT_NEGATIVE)),
    parameter(&["briscoe-tabor"], "pressure_coefficient", Number("1", NOT_NEGATIVE)),
    parameter(&["briscoe-tabor"], "film_softening", Section(SOFTENING)),
    key("strength", Name),
    key("strength_factor", Number("1", POSITIVE)),
    key("heat_partition", Number("1", SHARE)),
    key("gap_conductance", Number("W/(m2 K)", NOT_NEGATIVE)),
    key("taylor_quinney", Number("1", SHARE)),
];

const COUNTERFACE: &[Key] = &[
    key("preset", Name),
    key("elastic", Flag),
    key("youngs_modulus", Number("Pa", POSITIVE)),
    key("poisson_ratio", Number("1", POISSON)),
    key("thermal_conductivity", Property("W/(m K)", POSITIVE)),
    key("density", Number("kg/m3", POSITIVE)),
    key("specific_heat", Property("J/(kg K)", POSITIVE)),
    key("thermal_expansion", Number("1/K", NOT_NEGATIVE)),
    key("contact_conductance", Number("W/(m2 K)", POSITIVE_OR_INFINITE)),
];

pub const LOADING: &[Key] = &[
    key("interference", Number("omega_0/omega_c", POSITIVE)),
    key("load", Number("N", POSITIVE)),
    key("slip_rate", Number("m/s, 0 is the isothermal limit", SLIP_RATE)),
    key("slip_distance", NumberOr("contact radii", SLIP_DISTANCE, "steady")),
    key("press_slip_distance", Number("contact radii", STEP_DISTANCE)),
    key("control", Name),
    key("temperature", Number("K", POSITIVE)),
    key("steps", Sections(STEP)),
];

/// A step of a programme.
pub const STEP: &[Key] = &[
    key("slip_rate", Number("m/s", STEP_SLIP_RATE)),
    key("slip_distance", Number("contact radii", STEP_DISTANCE)),
    key("hold", Number("s", POSITIVE)),
];

const NUMERICS: &[Key] = &[
    key("accuracy", Number("1", ACCURACY)),
    key("elements_per_radius", Count(*ELEMENTS_PER_RADIUS.start(), *ELEMENTS_PER_RADIUS.end(), 1)),
    key("sectors", Count(4, 256, 4)),
];

/// A range of a request has at most this many points.
const MOST_POINTS: usize = 1000;

/// Section `[table]` of a request, its ranges written out as lists.
pub const TABLE: &[Key] = &[
    key("interference", List("omega_0/omega_c", POSITIVE, Order::Rising)),
    key("slip_rate", List("m/s", SLIP_RATE, Order::Rising)),
    key("temperature", List("K", POSITIVE, Order::Rising)),
    key("tolerance", Number("1", ACCURACY)),
    key("max_cells", Count(1, MOST_POINTS * MOST_POINTS, 1)),
];

/// A range of the section `[table]`.
pub const fn range_keys(unit: &'static str, range: Range) -> [Key; 4] {
    [
        key("from", Number(unit, range)),
        key("to", Number(unit, range)),
        key("points", Count(2, MOST_POINTS, 1)),
        key("spacing", Name),
    ]
}

impl Kind {
    /// Text as in "must be …"; the names of a choice are listed by the type of the key.
    pub fn allowed(&self) -> String {
        match self {
            Number(unit, range) => range.with_unit(unit),
            NumberOr(unit, range, name) => format!("{}, or {name:?}", range.with_unit(unit)),
            Property(unit, range) => {
                format!("{}, or {{ temperature = [… K], value = […] }}", range.with_unit(unit))
            }
            List(unit, range, _) => format!("a list, not empty, of: {}", range.with_unit(unit)),
            Count(from, to, 1) => format!("a whole number from {from} to {to}"),
            Count(from, to, step) => format!("a whole number from {from} to {to}, a multiple of {step}"),
            Name => "a name in quotes".into(),
            Law(laws) => one_of(&laws()),
            Flag => "true or false".into(),
            Section(keys) if keys[0].name == "law" => "{ law = … }".into(),
            Section(_) => "a section".into(),
            Sections(_) => "a list, not empty, of sections".into(),
        }
    }
}

/// All keys of scenes and requests: name and path.
pub fn all_keys() -> Vec<(&'static str, String)> {
    fn collect(section: &str, keys: &[Key], all: &mut Vec<(&'static str, String)>) {
        for key in keys {
            let path = join(section, key.name);
            all.push((key.name, path.clone()));
            if let Section(keys) | Sections(keys) = key.kind {
                collect(&path, keys, all);
            }
        }
    }
    let mut all = Vec::new();
    collect("", SCENE, &mut all);
    collect("table", TABLE, &mut all);
    all
}

/// Names of all keys of scenes and requests, sorted.
pub fn key_names() -> BTreeSet<&'static str> {
    all_keys().into_iter().map(|(name, _)| name).collect()
}

/// Names of all laws of scenes, sorted.
pub fn law_names() -> BTreeSet<String> {
    let laws = |(_, path): (&str, String)| match find(SCENE, &path) {
        Some(Law(laws)) => laws(),
        _ => Vec::new(),
    };
    all_keys().into_iter().flat_map(laws).collect()
}

/// The kind of a key by its path from `keys` on.
pub fn find(keys: &[Key], path: &str) -> Option<Kind> {
    let (first, rest) = path.split_once('.').map_or((path, None), |(first, rest)| (first, Some(rest)));
    let kind = keys.iter().find(|key| key.name == first)?.kind;
    match (rest, kind) {
        (None, kind) => Some(kind),
        (Some(rest), Section(keys)) => find(keys, rest),
        _ => None,
    }
}
