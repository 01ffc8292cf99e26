//! Limit of the shear traction τ_c by the friction laws of a scene.

use crate::scene::{FrictionLaw, ShearLimit};

/// Arguments of a friction law at a contact point; tractions in units of `unit`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactPoint {
    /// p.
    pub pressure: f64,
    /// Share of the point's area that is covered by the contact.
    pub contact_fraction: f64,
    /// f_τ σ/√3.
    pub strength: f64,
    /// K.
    pub temperature: f64,
    /// Pa.
    pub unit: f64,
}

/// τ_c per area of the point; a contact point slips where its shear traction reaches it. Without a limit it is infinite.
pub(crate) fn shear_limit(law: &FrictionLaw, at: &ContactPoint) -> f64 {
    let ShearLimit { film, capped } = law.limit();
    let of_film = film.map_or(f64::INFINITY, |film| {
        let strength = at.contact_fraction * film.strength / at.unit;
        film.softening.factor(at.temperature) * (strength + film.coefficient * at.pressure)
    });
    if capped { of_film.min(at.contact_fraction * at.strength) } else { of_film }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Softening;

    #[test]
    fn limits_follow_the_formulae() {
        let at = ContactPoint {
            pressure: 2.0,
            contact_fraction: 0.5,
            strength: 0.6,
            temperature: 400.0,
            unit: 1e9,
        };
        let limit = |law: FrictionLaw| shear_limit(&law, &at);
        assert_eq!(limit(FrictionLaw::ShearStrength), 0.3);
        assert_eq!(limit(FrictionLaw::Coulomb { friction: 0.1, cap: true }), 0.2);
        assert_eq!(limit(FrictionLaw::Coulomb { friction: 0.4, cap: true }), 0.3);
        assert_eq!(limit(FrictionLaw::Coulomb { friction: 0.4, cap: false }), 0.8);
        let film = |film_strength, pressure_coefficient, cap| {
            let film_softening = Softening::None;
            limit(FrictionLaw::BriscoeTabor { film_strength, pressure_coefficient, film_softening, cap })
        };
        // 0.5·0.1 + 0.05·2, below the strength of the metal; then above it.
        assert!((film(1e8, 0.05, true) - 0.15).abs() < 1e-15);
        assert_eq!(film(1e9, 0.05, true), 0.3);
        assert!((film(1e9, 0.05, false) - 0.6).abs() < 1e-15);
        // Half of it is left at two thirds of the way from 300 to 450 K.
        let film_softening = Softening::Table { temperature: vec![300.0, 450.0], factor: vec![1.0, 0.25] };
        let (film_strength, pressure_coefficient, cap) = (1e8, 0.05, true);
        let warm = FrictionLaw::BriscoeTabor { film_strength, pressure_coefficient, film_softening, cap };
        assert!((limit(warm) - 0.5 * 0.15).abs() < 1e-15);
        assert_eq!(limit(FrictionLaw::FullStick), f64::INFINITY);
        assert_eq!(limit(FrictionLaw::Frictionless), 0.0);
    }
}
