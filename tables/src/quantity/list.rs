//! The entries of the list.

use super::{Descriptor, ElasticLimit as Limit, Stored};

/// Exponents (of R; of σ_Y, of E*) of each kind of quantity.
type Scaling = (i32, (i32, i32));

const NUMBER: Scaling = (0, (0, 0));
const LENGTH: Scaling = (1, (1, -1));
const AREA: Scaling = (2, (2, -2));
const FORCE: Scaling = (2, (3, -2));
const ENERGY_PER_AREA: Scaling = (1, (2, -1));
const ENERGY: Scaling = (3, (4, -3));
/// Elastic slip is in proportion to the contact radius and to σ_Y/E* once more.
const ELASTIC_SLIP: Scaling = (1, (2, -2));
/// A stress over an elastic slip.
const ELASTIC_SLIP_ENERGY: Scaling = (1, (3, -2));

/// The enumeration of the quantities and the list of their entries, from one line each. The meaning in words is the
/// documentation of the variant.
macro_rules! quantities {
    ($(
        $(#[$more:meta])*
        $quantity:ident: $kind:ident($name:literal, $units:literal, $long_name:literal, $($scaling:expr),*)
            $(.$change:ident($($with:expr),*))*;
    )*) => {
        /// A result of one asperity; see [`Quantity::descriptor`].
        ///
        /// The scalars come first, in the order in which they are reported.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Quantity {
            $(
                #[doc = concat!($long_name, ".")]
                ///
                $(#[$more])*
                $quantity,
            )*
        }

        /// Every quantity, in the order of [`Quantity`].
        pub(super) const LIST: [Descriptor; [$(Quantity::$quantity),*].len()] = [$(
            $kind(Quantity::$quantity, $name, $units, $long_name, $($scaling),*)$(.$change($($with),*))*,
        )*];
    };
}

quantities! {
    /// At the end of the slide.
    Mu: scalar("mu", "1", "sliding friction coefficient Q/P", NUMBER, Limit::SlidingCoefficient).history(Stored::RunAndTable, "last value");
    MuStatic: scalar("mu_static", "1", "friction coefficient Q/P at sliding inception", NUMBER, Limit::StaticCoefficient);
    MuPeak: scalar("mu_peak", "1", "largest friction coefficient Q/P of the slide", NUMBER, Limit::StaticCoefficient);
    /// ∫Q ds/∫P|ds|.
    MuMean: scalar("mu_mean", "1", "mean friction coefficient of the slide, work of friction over the integral of P along the slip", NUMBER, Limit::SlidingCoefficient).optional();
    /// Q at the end of the slide.
    Friction: scalar("Q", "N", "friction force", FORCE, Limit::SlidingFriction).history(Stored::RunAndTable, "last value");
    FrictionStatic: scalar("Q_static", "N", "friction force at sliding inception", FORCE, Limit::StaticFriction);
    /// P at the end of the slide.
    Load: scalar("P", "N", "normal force", FORCE, Limit::Load).history(Stored::RunAndTable, "last value");
    LoadPress: scalar("P_press", "N", "normal force at the end of the press", FORCE, Limit::LoadPress).history(Stored::Press, "last value");
    /// A at the end of the slide.
    Area: scalar("area", "m2", "real contact area", AREA, Limit::Area).history(Stored::RunAndTable, "last value");
    AreaPress: scalar("area_press", "m2", "real contact area at the end of the press", AREA, Limit::AreaPress).history(Stored::Press, "last value");
    /// a₀.
    ContactRadius: scalar("contact_radius", "m", "contact radius at the end of the press", LENGTH, Limit::ContactRadius);
    /// (W − ΔU)/A.
    EnergyRelease: scalar("G", "J m-2", "energy released from full stick to full slip: work of the flat less the change of the elastic energy up to sliding inception, per contact area at inception", ELASTIC_SLIP_ENERGY, Limit::EnergyRelease);
    /// ∫(τ̄ − τ̄_end) ds of τ̄ = Q/A.
    EnergyWeakening: scalar("G_weakening", "J m-2", "energy of slip weakening from the peak of Q/A to the end of the slide, per contact area", ENERGY_PER_AREA, Limit::Weakening);
    /// Of the whole slide.
    TemperatureMax: scalar("temperature_max", "K", "highest temperature of the contact", NUMBER, Limit::TemperatureRise).history(Stored::RunAndTable, "highest of the slide");
    /// At the end of the slide.
    TemperatureMean: scalar("temperature_mean", "K", "mean temperature of the contact", NUMBER, Limit::TemperatureRise).history(Stored::Run, "last value");
    InceptionSlip: scalar("inception_slip", "m", "slip at sliding inception", ELASTIC_SLIP, Limit::InceptionSlip);
    MuSteady: scalar("mu_steady", "1", "friction coefficient Q/P that a longer slide tends to", NUMBER, Limit::SlidingCoefficient).optional();
    /// Of the last increment.
    HeatPartition: scalar("heat_partition", "1", "share of the frictional heat that enters the asperity", NUMBER, Limit::FirstRow).history(Stored::Run, "last value").optional();
    /// ω/ω_c during the press.
    InterferencePress: history("interference_press", "1", "interference over that of first yield", NUMBER).history(Stored::Press, "");
    Slip: history("slip", "m", "slip: displacement of the flat since the end of the press", LENGTH);
    SlipAccumulated: history("slip_accumulated", "m", "path of the flat since the end of the press, forwards and backwards", LENGTH);
    /// ω/ω_c during the slide; it changes under load control.
    Interference: history("interference", "1", "interference over that of first yield", NUMBER);
    Time: history("time", "s", "time since the start of the slide", (2, (1, -1)));
    SlipRate: history("slip_rate", "m s-1", "rate of the displacement of the flat in the increment", (-1, (0, 0)));
    ProgrammeStep: history("programme_step", "1", "step of the programme of slip rates and holds, from 1", NUMBER);
    StickFraction: history("stick_fraction", "1", "fraction that sticks of the contact that exists since the start of the motion", NUMBER);
    StrengthMobilised: history("strength_mobilised", "1", "share of the shear strength that is mobilised, of the contact that exists since the start of the motion", NUMBER);
    PlasticStrainMax: history("plastic_strain_max", "1", "largest equivalent plastic strain", NUMBER);
    Work: history("work", "J", "work of the flat since the start of the slide", ENERGY);
    /// With that of the normal contact springs.
    EnergyElastic: history("energy_elastic", "J", "change of the elastic energy", ENERGY);
    DissipationPlastic: history("dissipation_plastic", "J", "plastic dissipation", ENERGY);
    DissipationFriction: history("dissipation_friction", "J", "frictional dissipation", ENERGY);
    /// ∫σ:dε_th.
    WorkThermalExpansion: history("work_thermal_expansion", "J", "work done through thermal expansion of asperity and counterface", ENERGY);
    EnergyModuliSoftening: history("energy_moduli_softening", "J", "elastic energy released as the moduli fall with temperature", ENERGY);
    HeatIn: history("heat_in", "J", "frictional and plastic heat that entered the body", ENERGY);
    /// ∫ρc(T − T₀) dV.
    HeatStored: history("heat_stored", "J", "heat stored in the body", ENERGY);
    HeatCounterface: history("heat_counterface", "J", "heat that entered a conducting counterface", ENERGY);
    HeatOut: history("heat_out", "J", "heat that left through base and gap", ENERGY);
}

const fn scalar(
    quantity: Quantity,
    name: &'static str,
    units: &'static str,
    long_name: &'static str,
    (radius_exponent, material_exponents): Scaling,
    elastic_limit: Limit,
) -> Descriptor {
    Descriptor {
        quantity,
        name,
        units,
        long_name,
        radius_exponent,
        material_exponents,
        elastic_limit,
        scalar: true,
        moment: "",
        history: Stored::No,
        optional: false,
    }
}

const fn history(
    quantity: Quantity,
    name: &'static str,
    units: &'static str,
    long_name: &'static str,
    scaling: Scaling,
) -> Descriptor {
    let entry = scalar(quantity, name, units, long_name, scaling, Limit::None);
    Descriptor { scalar: false, history: Stored::Run, ..entry }
}

impl Descriptor {
    const fn history(self, history: Stored, moment: &'static str) -> Self {
        Self { history, moment, ..self }
    }

    const fn optional(self) -> Self {
        Self { optional: true, ..self }
    }
}

/// A part of the list.
#[derive(Clone, Copy)]
pub(super) enum Selection {
    Scalars,
    PressHistories,
    RunHistories,
    TableHistories,
}

const fn belongs(entry: &Descriptor, selection: Selection) -> bool {
    match selection {
        Selection::Scalars => entry.scalar,
        Selection::PressHistories => matches!(entry.history, Stored::Press),
        Selection::RunHistories => matches!(entry.history, Stored::Run | Stored::RunAndTable),
        Selection::TableHistories => matches!(entry.history, Stored::RunAndTable),
    }
}

/// Number of the quantities of a part.
pub(super) const fn count(selection: Selection) -> usize {
    let (mut index, mut count) = (0, 0);
    while index < LIST.len() {
        count += belongs(&LIST[index], selection) as usize;
        index += 1;
    }
    count
}

/// The quantities of a part, in the order of the list.
pub(super) const fn select<const N: usize>(selection: Selection) -> [Quantity; N] {
    let mut selected = [Quantity::Mu; N];
    let (mut index, mut count) = (0, 0);
    while index < LIST.len() {
        if belongs(&LIST[index], selection) {
            selected[count] = LIST[index].quantity;
            count += 1;
        }
        index += 1;
    }
    selected
}
