//! Warnings of a run.

use std::fmt::{self, Display, Formatter};

use tables::numbers::{beside, plain, rounded};
use tables::quantity::Quantity;

/// Limitations of the results.
#[derive(Clone, Debug, PartialEq)]
pub enum Warning {
    /// Relative error of a quantity above its multiple (`times`) of the accuracy of the scene.
    ErrorAboveAccuracy {
        quantity: Quantity,
        error: f64,
        times: f64,
        accuracy: f64,
    },
    /// The error of a quantity is as large as the quantity.
    ErrorAboveValue {
        quantity: Quantity,
    },
    /// A run did not finish.
    ErrorsUnknown,
    StoppedBeforeRefinement,
    /// The results are those of a run that another was to follow, which did not begin or was given up.
    NoMainRun {
        elements_per_radius: usize,
        sectors: usize,
    },
    /// Sliding inception lies beyond the end of the slide.
    NotSliding,
    /// Relative difference of static friction by the threshold of the stiffness, where it decides on sliding inception.
    InceptionByStiffness {
        spread: f64,
    },
    /// Body and interface are equally strong, and the body does not harden up to a plastic strain.
    EqualStrength {
        plateau: f64,
    },
    /// The interface is as strong as the hardened body.
    HardenedInterface,
    /// Plastic strain beyond small-strain kinematics.
    LargeStrain {
        strain: f64,
        limit: f64,
    },
    /// The layer heated by friction, in thicknesses of the elements at the surface, and the elements per
    /// radius that would resolve it.
    ThinThermalLayer {
        share: f64,
        elements: Option<f64>,
    },
    /// Share of G that is released before the shear tractions of the press turn into the motion.
    ReleasedPress {
        share: f64,
    },
    /// Time of sliding inception, over that of a shear wave across the contact radius.
    FastInception {
        time: f64,
        limit: f64,
    },
    /// The contact alternately sticks and slips before it slides.
    StickSlip,
    /// Energies or heat of the slide that are not accounted for, relative to their largest term, and the difference of the
    /// heat from that of friction and plastic flow.
    Unbalanced {
        energy: f64,
        heat: f64,
        sources: f64,
    },
    /// The contact is hotter than the melting temperature of the metal, K.
    AboveMelting {
        highest: f64,
        melting: f64,
    },
    /// Temperatures of the run outside a table of the scene.
    OutsideTable(String),
    /// Of the scene.
    Scene(String),
}

impl Warning {
    /// Of a relative error that is above `times` the accuracy.
    pub fn of_error(quantity: Quantity, error: f64, times: f64, accuracy: f64) -> Self {
        match error < 1.0 {
            true => Self::ErrorAboveAccuracy { quantity, error, times, accuracy },
            false => Self::ErrorAboveValue { quantity },
        }
    }

    /// The whole text, where it has no numbers.
    fn fixed_text(&self) -> Option<&'static str> {
        Some(match self {
            Self::ErrorsUnknown => {
                "the main run or an auxiliary run did not finish: errors of the slide are unknown"
            }
            Self::StoppedBeforeRefinement => "stopped before the run was repeated more finely",
            Self::NotSliding => {
                "sliding has not begun by the end of the slide: mu_static, Q_static, G and inception_slip are \
                 those of its end; a longer slip_distance lets it begin"
            }
            Self::StickSlip => {
                "points that slip stick again before the contact slides, as where heat softens the interface faster than the \
                 contact unloads, or where it hardens: mu_static is the largest friction up to sliding inception; G and \
                 inception_slip, those of the first slip, depend on the increments"
            }
            Self::HardenedInterface => {
                "the interface is as strong as the hardened body: the top layer of elements shears before the \
                 contact slips, and mu then follows the mesh; its error contains a bound of this, and a strength_factor below 1 lets the \
                 contact slip"
            }
            _ => return None,
        })
    }
}

impl Display for Warning {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::ErrorAboveAccuracy { quantity, error, times, accuracy } => {
                above_accuracy(f, *quantity, [100.0 * error, 100.0 * accuracy], *times)
            }
            Self::ErrorAboveValue { quantity } => write!(
                f,
                "{} is undetermined: its estimated error is larger than its value; where the body softens or shears below the \
                 interface no mesh converges, and a smaller strength_factor or slip_distance avoids it",
                quantity.descriptor().name
            ),
            Self::EqualStrength { plateau } => equal_strength(f, *plateau),
            Self::NoMainRun { elements_per_radius, sectors } => write!(
                f,
                "the main run on the mesh that is required did not begin or was given up: the results are those of \
                 another run, with {elements_per_radius} elements per contact radius and {sectors} sectors"
            ),
            Self::InceptionByStiffness { spread } => write!(
                f,
                "contact points stick to the end: sliding begins where the stiffness dQ/ds is 1 % of its initial \
                 value; by 10, 5 or 2 % mu_static differs by up to {:.1} %, which its error contains",
                100.0 * spread
            ),
            Self::LargeStrain { strain, limit } => write!(
                f,
                "plastic strain reaches {}: beyond about {limit} small-strain kinematics is inaccurate",
                beside(*strain, *limit, 2)
            ),
            Self::ThinThermalLayer { share, elements } => write!(
                f,
                "frictional heat stays in a layer of {share:.2} of the elements at the surface: the error of mu may \
                 exceed its estimate; {} would resolve it",
                elements.map_or("no mesh".to_owned(), |elements| format!("elements_per_radius = {elements}"))
            ),
            Self::ReleasedPress { share } => write!(
                f,
                "the interface is too weak for the shear tractions of the press, which is in full stick: they are \
                 released as the slide begins, and G contains their energy, some {:.0} % of it in the first increments; mu_static is \
                 the largest friction until all points slip, some of them not yet along the motion",
                100.0 * share
            ),
            Self::FastInception { time, limit } => write!(
                f,
                "sliding begins within {} times the time of a shear wave across the contact radius: below {limit}, \
                 inertia changes mu_static and G, which are those of a slow onset",
                beside(*time, *limit, 2)
            ),
            Self::Unbalanced { energy, heat, sources } => write!(
                f,
                "of the work of the flat {energy:.0e} is neither stored nor dissipated, of the heat {heat:.0e} neither stored nor \
                 lost, and heat and dissipation differ by {sources:.0e}: a finer mesh or a smaller accuracy closes the balances"
            ),
            Self::AboveMelting { highest, melting } => above_melting(f, *highest, *melting),
            Self::OutsideTable(text) | Self::Scene(text) => f.write_str(text),
            other => f.write_str(other.fixed_text().unwrap_or_default()),
        }
    }
}

impl serde::Serialize for Warning {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// Error and accuracy in %.
fn above_accuracy(
    f: &mut Formatter<'_>,
    quantity: Quantity,
    [error, accuracy]: [f64; 2],
    times: f64,
) -> fmt::Result {
    let limit = |accuracy: f64| times * accuracy;
    let times = if times == 1.0 { String::new() } else { format!("{times} times ") };
    let name = quantity.descriptor().name;
    let accuracy = rounded(accuracy, 3);
    write!(
        f,
        "the estimated error of {name} is {} %, above {times}the accuracy of {} %",
        beside(error, limit(accuracy), 2),
        plain(accuracy)
    )
}

fn above_melting(f: &mut Formatter<'_>, highest: f64, melting: f64) -> fmt::Result {
    let highest = beside(highest, melting, 4);
    write!(
        f,
        "the contact reaches {highest} K, above the melting temperature of {} K: friction by this law does not end there; \
         cap = true limits it to the strength of the metal",
        plain(melting)
    )
}

fn equal_strength(f: &mut Formatter<'_>, plateau: f64) -> fmt::Result {
    f.write_str("body and interface are equally strong and the body does not harden")?;
    if plateau.is_finite() {
        write!(f, " up to a plastic strain of {}", plain(plateau))?;
    }
    f.write_str(
        ": shear may localise in one layer of elements, and mu_static, inception_slip and above all G then follow the \
         mesh; their errors contain a bound of this",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_below_its_limit_is_not_shown_as_the_limit() {
        for (time, shown) in [(4.98, "within 5 times"), (4.96, "within 5 times"), (0.003, "within 0.0 times")]
        {
            let text = Warning::FastInception { time, limit: 5.0 }.to_string();
            assert!(!text.contains(shown) && text.contains("below 5,"), "{text}");
        }
    }

    #[test]
    fn a_value_whose_error_is_larger_is_undetermined() {
        let text = |error, times| Warning::of_error(Quantity::EnergyRelease, error, times, 0.02).to_string();
        assert_eq!(text(0.5, 1.0), "the estimated error of G is 50 %, above the accuracy of 2 %");
        assert_eq!(text(0.5, 5.0), "the estimated error of G is 50 %, above 5 times the accuracy of 2 %");
        let close = Warning::of_error(Quantity::EnergyRelease, 0.00515, 2.5, 0.002).to_string();
        assert!(close.contains("is 0.52 %, above 2.5 times the accuracy of 0.2 %"), "{close}");
        let closer = Warning::of_error(Quantity::Mu, 0.020004, 1.0, 0.02).to_string();
        assert!(closer.contains("is 2.0004 %, above the accuracy of 2 %"), "{closer}");
        assert!(text(1.5, 5.0).starts_with("G is undetermined: its estimated error is larger than"));
    }
}
