//! The one list of what a table holds: names, units and scaling of every quantity.

/// A scalar result of one asperity; see [`Quantity::descriptor`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Quantity {
    /// Q/P at the end of the slide.
    Mu,
    /// Q/P at sliding inception.
    MuStatic,
    /// Largest Q/P of the slide.
    MuPeak,
    /// Q at the end of the slide.
    Friction,
    /// Q at sliding inception.
    FrictionStatic,
    /// P at the end of the slide.
    Load,
    /// P at the end of the press.
    LoadPress,
    /// A at the end of the slide.
    Area,
    /// A at the end of the press.
    AreaPress,
    /// a₀.
    ContactRadius,
    /// G: from full stick to full slip.
    EnergyRelease,
    /// G_weakening: from the peak of Q/A to its end value.
    EnergyWeakening,
    /// Hottest point of the contact at the end of the slide.
    TemperatureMax,
    /// Mean over the contact at the end of the slide.
    TemperatureMean,
    /// s at sliding inception.
    InceptionSlip,
}

/// How a quantity is written in a file and how it changes with the radius of the asperity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Descriptor {
    pub quantity: Quantity,
    /// Name of the variable in `table.nc`; `NAME_error` and `NAME_history` derive from it.
    pub name: &'static str,
    /// UDUNITS notation.
    pub units: &'static str,
    pub long_name: &'static str,
    /// CF standard name, where one exists.
    pub standard_name: Option<&'static str>,
    /// n in x(R) = x(R_t)·(R/R_t)ⁿ at fixed ω/ω_c, VR and s/a₀.
    pub radius_exponent: i32,
    /// Whether it is stored along the slide as well.
    pub has_history: bool,
}

impl Quantity {
    /// Every quantity, in the order of the enumeration.
    pub const ALL: [Quantity; 15] = {
        let mut all = [Quantity::Mu; 15];
        let mut index = 0;
        while index < all.len() {
            all[index] = QUANTITIES[index].quantity;
            index += 1;
        }
        all
    };

    /// Those stored along the slide, in the order of their histories in a cell.
    pub const HISTORIES: [Quantity; 5] =
        [Quantity::Mu, Quantity::Friction, Quantity::Load, Quantity::Area, Quantity::TemperatureMax];

    /// Its line of [`QUANTITIES`].
    pub fn descriptor(self) -> &'static Descriptor {
        &QUANTITIES[self as usize]
    }

    /// Whether it is an absolute temperature, whose error is a temperature difference.
    pub fn is_temperature(self) -> bool {
        self.descriptor().units == "K"
    }

    /// Position in [`Quantity::HISTORIES`].
    pub(crate) fn history_index(self) -> Option<usize> {
        Self::HISTORIES.iter().position(|known| *known == self)
    }
}

const fn line(
    quantity: Quantity,
    name: &'static str,
    units: &'static str,
    radius_exponent: i32,
    long_name: &'static str,
) -> Descriptor {
    Descriptor {
        quantity,
        name,
        units,
        long_name,
        // The CF table (version 86) has no name for contact forces, areas or friction.
        standard_name: None,
        radius_exponent,
        has_history: false,
    }
}

const fn with_history(descriptor: Descriptor) -> Descriptor {
    Descriptor { has_history: true, ..descriptor }
}

/// Every quantity over (interference, slip_rate), in the order of [`Quantity`]. To add one:
/// a line here, a variant there.
#[rustfmt::skip]
pub const QUANTITIES: [Descriptor; 15] = {
    use Quantity::*;
    [
        with_history(line(Mu, "mu", "1", 0, "sliding friction coefficient Q/P")),
        line(MuStatic, "mu_static", "1", 0, "friction coefficient Q/P at sliding inception"),
        line(MuPeak, "mu_peak", "1", 0, "largest friction coefficient Q/P of the slide"),
        with_history(line(Friction, "Q", "N", 2, "friction force")),
        line(FrictionStatic, "Q_static", "N", 2, "friction force at sliding inception"),
        with_history(line(Load, "P", "N", 2, "normal force")),
        line(LoadPress, "P_press", "N", 2, "normal force at the end of the press"),
        with_history(line(Area, "area", "m2", 2, "real contact area")),
        line(AreaPress, "area_press", "m2", 2, "real contact area at the end of the press"),
        line(ContactRadius, "contact_radius", "m", 1, "contact radius at the end of the press"),
        line(EnergyRelease, "G", "J m-2", 1, "energy released from full stick to full slip per contact area"),
        line(EnergyWeakening, "G_weakening", "J m-2", 1, "energy of slip weakening per contact area"),
        with_history(line(TemperatureMax, "temperature_max", "K", 0, "highest temperature of the contact")),
        line(TemperatureMean, "temperature_mean", "K", 0, "mean temperature of the contact"),
        line(InceptionSlip, "inception_slip", "m", 1, "slip at sliding inception"),
    ]
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_quantity_stands_at_its_own_line() {
        for (index, line) in QUANTITIES.iter().enumerate() {
            assert_eq!(line.quantity as usize, index, "{}", line.name);
            assert_eq!(line.quantity.descriptor(), line);
            let listed = line.quantity.history_index().is_some();
            assert_eq!(listed, line.has_history, "{}", line.name);
        }
    }

    #[test]
    fn scaling_follows_from_the_unit() {
        for line in &QUANTITIES {
            let exponent = match line.units {
                "N" | "m2" => 2,
                "m" | "J m-2" => 1,
                _ => 0,
            };
            assert_eq!(line.radius_exponent, exponent, "{}", line.name);
        }
    }
}
