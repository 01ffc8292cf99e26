//! Warnings of a run.

use tables::numbers::{beside, plain, rounded};
use tables::quantity::Quantity;

/// Limitations of the results.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Warning {
    /// Relative error of a quantity above its multiple (`times`) of the accuracy of the scene; `lasting` is the part that no finer
    /// resolution reduces.
    #[error(
        "the estimated error of {} is {} %, above {}the accuracy of {} %{}",
        .quantity.descriptor().name,
        beside(100.0 * .error, .times * rounded(100.0 * .accuracy, 3), 2),
        if *.times == 1.0 { String::new() } else { format!("{} times ", .times) },
        plain(rounded(100.0 * .accuracy, 3)),
        if *.lasting > .times * .accuracy {
            format!(": a finer resolution leaves {} %", plain(rounded(100.0 * .lasting, 2)))
        } else {
            String::new()
        }
    )]
    ErrorAboveAccuracy { quantity: Quantity, error: f64, lasting: f64, times: f64, accuracy: f64 },
    /// The error of a quantity is as large as the quantity.
    #[error(
        "{} is undetermined: its estimated error is larger than its value; where the body softens or shears below the interface no mesh converges, and a smaller strength_factor or slip_distance avoids it; beside an elastic counterface the error of G of a weak interface is that of the coupling of the press, which the model lacks, and counterface.elastic = false leaves both out",
        .quantity.descriptor().name
    )]
    ErrorAboveValue { quantity: Quantity },
    /// A run did not finish.
    #[error("the main run or an auxiliary run did not finish: errors of the slide are unknown")]
    ErrorsUnknown,
    #[error("stopped before a further run, on a finer mesh or for the steady friction")]
    StoppedBeforeFurtherRun,
    /// The results are those of a run that another was to follow, which did not begin or was given up.
    #[error(
        "the main run on the mesh that is required did not begin or was given up: the results are those of another run, with {elements_per_radius} elements per contact radius and {sectors} sectors"
    )]
    NoMainRun { elements_per_radius: usize, sectors: usize },
    /// Sliding inception lies beyond the end of the slide.
    #[error(
        "sliding has not begun by the end of the slide: mu, mu_static, Q, Q_static, G and inception_slip are those of its end, in partial slip, and mu_steady has no meaning; a longer slip_distance lets it begin"
    )]
    NotSliding,
    /// Relative error of steady friction by the length of the slide.
    #[error(
        "mu_steady is uncertain by {}: friction still changes at the end of the slide, and of the one that goes on on a coarse mesh",
        if *.error < 1.0 { format!("{:.0} %", 100.0 * .error) } else { "more than its value".into() }
    )]
    SteadyUncertain { error: f64 },
    /// Relative difference of static friction by the threshold of the stiffness, where it decides on sliding inception.
    #[error(
        "contact points stick to the end: sliding begins where the stiffness dQ/ds is 1 % of its initial value; by 10, 5 or 2 % mu_static differs by {}, which its error contains",
        if *.spread < 1.0 { format!("up to {:.1} %", 100.0 * .spread) } else { "more than its value".into() }
    )]
    InceptionByStiffness { spread: f64 },
    /// Body and interface are equally strong, and the body does not harden up to a plastic strain.
    #[error(
        "body and interface are equally strong and the body does not harden{}: shear may localise in one layer of elements, and mu_static, inception_slip and above all G then follow the mesh; their errors contain a bound of this",
        if .plateau.is_finite() { format!(" up to a plastic strain of {}", plain(*.plateau)) } else { String::new() }
    )]
    EqualStrength { plateau: f64 },
    /// The interface is as strong as the hardened body.
    #[error(
        "the interface is as strong as the hardened body: the top layer of elements shears before the contact slips, and mu then follows the mesh; its error contains a bound of this, and a strength_factor below 1 lets the contact slip"
    )]
    HardenedInterface,
    /// Plastic strain beyond small-strain kinematics.
    #[error(
        "plastic strain reaches {}: beyond about {limit} small-strain kinematics is inaccurate",
        beside(*.strain, *.limit, 2)
    )]
    LargeStrain { strain: f64, limit: f64 },
    /// The layer heated by friction, in thicknesses of the elements at the surface, and the elements per
    /// radius that would resolve it.
    #[error(
        "frictional heat stays in a layer of {share:.2} of the elements at the surface: the error of mu may exceed its estimate; {} would resolve it",
        .elements.map_or("no mesh".to_owned(), |elements| format!("elements_per_radius = {elements}"))
    )]
    ThinThermalLayer { share: f64, elements: Option<f64> },
    /// Share of G that is released before the shear tractions of the press turn into the motion.
    #[error(
        "the interface is too weak for the shear tractions of the press, which is in full stick: they are released as the slide begins, and G contains their energy, some {:.0} % of it in the first increments; mu_static is the largest friction until all points slip, some of them not yet along the motion; mu_peak contains the increase from there on",
        100.0 * .share
    )]
    ReleasedPress { share: f64 },
    /// Time of sliding inception, over that of a shear wave across the contact radius.
    #[error(
        "sliding begins within {} times the time of a shear wave across the contact radius: below {limit}, inertia changes mu_static and G, which are those of a slow onset",
        beside(*.time, *.limit, 2)
    )]
    FastInception { time: f64, limit: f64 },
    /// The contact alternately sticks and slips before it slides.
    #[error(
        "points that slip stick again before the contact slides, as where heat softens the interface faster than the contact unloads, or where it hardens: mu_static is the largest friction up to sliding inception; G and inception_slip, those of the first slip, depend on the increments"
    )]
    StickSlip,
    /// A later step of the programme, from 1, in which the contact slips as a whole.
    #[error(
        "in step {step} of the programme friction falls faster than the contact unloads elastically, and the contact slips as a whole: friction and temperatures just after depend on the increments, which their errors do not contain"
    )]
    SuddenFall { step: usize },
    /// Energies or heat of the slide that are not accounted for, relative to their largest term, and the difference of the
    /// heat from that of friction and plastic flow, 0 before sliding begins.
    #[error(
        "of the work of the flat {energy:.0e} is neither stored nor dissipated, of the heat {heat:.0e} neither stored nor lost{}: a finer mesh or a smaller accuracy closes the balances",
        if *.sources == 0.0 { String::new() } else { format!(", and heat and dissipation differ by {sources:.0e}") }
    )]
    Unbalanced { energy: f64, heat: f64, sources: f64 },
    /// The contact is hotter than the melting temperature of the metal, K.
    #[error(
        "the contact reaches {} K, above the melting temperature of {} K: friction by this law does not end there; cap = true limits it to the strength of the metal",
        beside(*.highest, *.melting, 4),
        plain(*.melting)
    )]
    AboveMelting { highest: f64, melting: f64 },
    /// Temperatures of the run outside a table of the scene.
    #[error("{0}")]
    OutsideTable(String),
    /// A remark on the scene.
    #[error("{0}")]
    Scene(String),
}

impl Warning {
    /// Warning of a relative error, and its part that no finer resolution reduces, that is above `times` the accuracy.
    pub fn of_error(quantity: Quantity, [error, lasting]: [f64; 2], times: f64, accuracy: f64) -> Self {
        match error < 1.0 {
            true => Self::ErrorAboveAccuracy { quantity, error, lasting, times, accuracy },
            false => Self::ErrorAboveValue { quantity },
        }
    }
}

impl serde::Serialize for Warning {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
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
        let text =
            |error, times| Warning::of_error(Quantity::EnergyRelease, [error, 0.02], times, 0.02).to_string();
        assert_eq!(text(0.5, 1.0), "the estimated error of G is 50 %, above the accuracy of 2 %");
        assert_eq!(text(0.5, 5.0), "the estimated error of G is 50 %, above 5 times the accuracy of 2 %");
        let close = Warning::of_error(Quantity::EnergyRelease, [0.00515, 0.0], 2.5, 0.002).to_string();
        assert!(close.contains("is 0.52 %, above 2.5 times the accuracy of 0.2 %"), "{close}");
        let closer = Warning::of_error(Quantity::Mu, [0.020004, 0.0], 1.0, 0.02).to_string();
        assert!(closer.contains("is 2.0004 %, above the accuracy of 2 %"), "{closer}");
        let of_model = Warning::of_error(Quantity::EnergyRelease, [0.21, 0.206], 2.5, 0.02).to_string();
        assert!(of_model.ends_with("of 2 %: a finer resolution leaves 21 %"), "{of_model}");
        assert!(text(1.5, 5.0).starts_with("G is undetermined: its estimated error is larger than"));
    }
}
