//! The entries of the list.

use super::Quantity::{self, *};
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

/// Every quantity, in the order of [`Quantity`].
#[rustfmt::skip]
pub(super) const LIST: [Descriptor; HeatOut as usize + 1] = [
    scalar(Mu, "mu", "1", NUMBER, Limit::SlidingCoefficient, "sliding friction coefficient Q/P").history(Stored::RunAndTable, "last value"),
    scalar(MuStatic, "mu_static", "1", NUMBER, Limit::StaticCoefficient, "friction coefficient Q/P at sliding inception"),
    scalar(MuPeak, "mu_peak", "1", NUMBER, Limit::StaticCoefficient, "largest friction coefficient Q/P of the slide"),
    scalar(MuMean, "mu_mean", "1", NUMBER, Limit::SlidingCoefficient, "mean friction coefficient of the slide, work of friction over the integral of P along the slip").since(1),
    scalar(Friction, "Q", "N", FORCE, Limit::SlidingFriction, "friction force").history(Stored::RunAndTable, "last value"),
    scalar(FrictionStatic, "Q_static", "N", FORCE, Limit::StaticFriction, "friction force at sliding inception"),
    scalar(Load, "P", "N", FORCE, Limit::Load, "normal force").history(Stored::RunAndTable, "last value"),
    scalar(LoadPress, "P_press", "N", FORCE, Limit::Load, "normal force at the end of the press").history(Stored::Press, "last value").of_press(),
    scalar(Area, "area", "m2", AREA, Limit::Area, "real contact area").history(Stored::RunAndTable, "last value"),
    scalar(AreaPress, "area_press", "m2", AREA, Limit::Area, "real contact area at the end of the press").history(Stored::Press, "last value").of_press(),
    scalar(ContactRadius, "contact_radius", "m", LENGTH, Limit::ContactRadius, "contact radius at the end of the press").of_press(),
    scalar(EnergyRelease, "G", "J m-2", ELASTIC_SLIP_ENERGY, Limit::EnergyRelease, "energy released from full stick to full slip per contact area"),
    scalar(EnergyWeakening, "G_weakening", "J m-2", ENERGY_PER_AREA, Limit::Weakening, "energy of slip weakening per contact area"),
    scalar(TemperatureMax, "temperature_max", "K", NUMBER, Limit::TemperatureRise, "highest temperature of the contact").history(Stored::RunAndTable, "highest of the slide"),
    scalar(TemperatureMean, "temperature_mean", "K", NUMBER, Limit::TemperatureRise, "mean temperature of the contact").history(Stored::Run, "last value"),
    scalar(InceptionSlip, "inception_slip", "m", ELASTIC_SLIP, Limit::InceptionSlip, "slip at sliding inception"),
    scalar(MuSteady, "mu_steady", "1", NUMBER, Limit::SlidingCoefficient, "friction coefficient Q/P that a longer slide tends to").since(2),
    scalar(HeatPartition, "heat_partition", "1", NUMBER, Limit::FirstRow, "share of the frictional heat that enters the asperity").history(Stored::Run, "last value").since(3),
    history(InterferencePress, "interference_press", "1", NUMBER, "interference over that of first yield").history(Stored::Press, ""),
    history(Slip, "slip", "m", LENGTH, "slip: displacement of the flat since the end of the press"),
    history(Interference, "interference", "1", NUMBER, "interference over that of first yield"),
    history(Time, "time", "s", (2, (1, -1)), "time since the start of the slide"),
    history(SlipRate, "slip_rate", "m s-1", (-1, (0, 0)), "rate of the displacement of the flat in the increment"),
    history(ProgrammeStep, "programme_step", "1", NUMBER, "step of the programme of slip rates and holds, from 1"),
    history(StickFraction, "stick_fraction", "1", NUMBER, "fraction that sticks of the contact that exists since the start of the motion"),
    history(StrengthMobilised, "strength_mobilised", "1", NUMBER, "share of the shear strength that is mobilised, of the contact that exists since the start of the motion"),
    history(PlasticStrainMax, "plastic_strain_max", "1", NUMBER, "largest equivalent plastic strain"),
    history(Work, "work", "J", ENERGY, "work of the flat since the start of the slide"),
    history(EnergyElastic, "energy_elastic", "J", ENERGY, "change of the elastic energy"),
    history(DissipationPlastic, "dissipation_plastic", "J", ENERGY, "plastic dissipation"),
    history(DissipationFriction, "dissipation_friction", "J", ENERGY, "frictional dissipation"),
    history(WorkThermalExpansion, "work_thermal_expansion", "J", ENERGY, "work done through thermal expansion"),
    history(EnergyModuliSoftening, "energy_moduli_softening", "J", ENERGY, "elastic energy released as the moduli fall with temperature"),
    history(HeatIn, "heat_in", "J", ENERGY, "frictional and plastic heat that entered the body"),
    history(HeatStored, "heat_stored", "J", ENERGY, "heat stored in the body"),
    history(HeatCounterface, "heat_counterface", "J", ENERGY, "heat that entered a conducting counterface"),
    history(HeatOut, "heat_out", "J", ENERGY, "heat that left through base and gap"),
];

const fn scalar(
    quantity: Quantity,
    name: &'static str,
    units: &'static str,
    (radius_exponent, material_exponents): Scaling,
    elastic_limit: Limit,
    long_name: &'static str,
) -> Descriptor {
    Descriptor {
        quantity,
        name,
        units,
        long_name,
        radius_exponent,
        material_exponents,
        elastic_limit,
        of_press: false,
        scalar: true,
        moment: "",
        history: Stored::No,
        since: 0,
    }
}

const fn history(
    quantity: Quantity,
    name: &'static str,
    units: &'static str,
    scaling: Scaling,
    long_name: &'static str,
) -> Descriptor {
    let entry = scalar(quantity, name, units, scaling, Limit::None, long_name);
    Descriptor { scalar: false, history: Stored::Run, ..entry }
}

impl Descriptor {
    const fn history(self, history: Stored, moment: &'static str) -> Self {
        Self { history, moment, ..self }
    }

    const fn of_press(self) -> Self {
        Self { of_press: true, ..self }
    }

    const fn since(self, since: u32) -> Self {
        Self { since, ..self }
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
    let mut selected = [Mu; N];
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
