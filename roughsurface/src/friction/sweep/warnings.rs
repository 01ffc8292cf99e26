//! Warnings of one cell of a prediction.

use std::f64::consts::PI;

use super::{PressedSurface, SurfaceSlide, Sweep};
use crate::friction::contacts::Contacts;
use crate::friction::slip_curve::{SlipState, SurfaceInception};
use crate::friction::warning::{Place, Warning};
use crate::integral::height_integral::NEGLIGIBLE_SHARE;
use crate::surface::query::ContactLife;
use tables::closed_forms::adhesion::{CONTAMINATED_METALS, pull_off_force};
use tables::closed_forms::partial_slip::SHORTEST_INCEPTION;
use tables::law::{AboveRange, UNKNOWN_STEADY_FRICTION};

/// Share of the load below the first interference of a table above which a warning says that the result rests on the elastic
/// limit rather than on the table.
const MOSTLY_BELOW: f64 = 0.5;

/// Static friction coefficient above which a warning says that the interface is stronger than the pressure.
const LARGEST_FRICTION: f64 = 1.0;

/// Share of the life of a contact in which it may stick; friction is then about a tenth below that of sliding.
const LARGEST_STICK: f64 = 0.2;

/// Mean rise of the nominal contact over that of its contacts above which its heat counts.
const LARGEST_NOMINAL_RISE: f64 = 0.2;

/// Mean rise (K) of the nominal contact below which its heat does not count: it takes about a hundredth of the strength of metals.
const LEAST_NOMINAL_RISE: f64 = 10.0;

/// Time (s) for which faces stay in contact at least.
const IN_CONTACT: f64 = 10.0;
/// Length (m) of a nominal contact that is small, where the query states none.
const SMALL_NOMINAL_CONTACT: f64 = 0.01;

/// Number of contacts below which the result is that of a few summits and not of a surface.
const FEW_CONTACTS: f64 = 10.0;

impl Sweep<'_> {
    /// Adds the warnings of a cell with its sliding inception and the largest share of its load outside the table.
    pub(super) fn warn(
        &self,
        (row, rate): (usize, usize),
        pressed: &PressedSurface,
        SurfaceSlide { curve, contacts, sliding, lasting }: &SurfaceSlide,
        start: &SurfaceInception,
        outside_table: f64,
        warnings: &mut Vec<Warning>,
    ) {
        let at = || Place::of(self.query, row, rate);
        warnings.extend(self.short_life((row, rate), pressed, start.slip.value));
        if outside_table > NEGLIGIBLE_SHARE && self.law.above_range() == AboveRange::Extrapolated {
            warnings.push(Warning::Extrapolated { at: at(), share: outside_table });
        }
        let measured = self.surface.heights.finite_set().map(|heights| heights.len() as f64);
        let density = sliding.contact_density.value / self.surface.asperity_density;
        if let Some(count) = measured.map(|heights| heights * density).filter(|count| *count < FEW_CONTACTS) {
            warnings.push(Warning::FewContacts { at: at(), count });
        }
        if let Some(size) = self.query.nominal_size {
            let count = sliding.contact_density.value * size.powi(2);
            warnings.extend((count < FEW_CONTACTS).then(|| Warning::SmallArea { at: at(), size, count }));
        }
        if contacts.below_law_load > MOSTLY_BELOW {
            warnings.push(Warning::BelowTable { at: at(), share: contacts.below_law_load });
        }
        if contacts.stuck_load > NEGLIGIBLE_SHARE {
            warnings.push(Warning::NotSliding { at: at(), share: contacts.stuck_load });
        } else if !start.reached && !start.mu.value.is_nan() {
            warnings.push(Warning::StillRising { at: at() });
        }
        if sliding.unknown_load > NEGLIGIBLE_SHARE {
            warnings.push(Warning::Unsteady {
                at: at(),
                share: sliding.unknown_load,
                known: !sliding.mu.value.is_nan(),
            });
        }
        let uncertain = (lasting.mu.error / lasting.mu.value).abs();
        if self.query.contact_life != ContactLife::Steady && uncertain > UNKNOWN_STEADY_FRICTION {
            warnings.push(Warning::SteadyUncertain { at: at(), error: uncertain });
        }
        if let Some(time) = self.inception_time(rate, curve).filter(|time| *time < SHORTEST_INCEPTION) {
            warnings.push(Warning::FastInception { at: at(), time });
        }
        let load = sliding.pressure.value / sliding.contact_density.value;
        let pull_off = pull_off_force(CONTAMINATED_METALS, self.surface.asperity_radius.mean());
        warnings.extend((load < pull_off).then(|| Warning::Adhesion { at: at(), load, pull_off }));
        let share = sliding.area_fraction.value;
        warnings.extend(Warning::of_area(self.query, share, at));
        let molten = self.settings.scene.melting_temperature.zip(contacts.temperature_max);
        if let Some((melting, highest)) = molten.filter(|(melting, highest)| highest.value > *melting) {
            warnings.push(Warning::AboveMelting { at: at(), highest: highest.value, melting });
        }
        warnings.extend(self.nominal_heating((row, rate), contacts, sliding));
        if contacts.stuck_load <= NEGLIGIBLE_SHARE && start.mu.value > LARGEST_FRICTION {
            warnings.push(Warning::StrongInterface { at: at(), friction: start.mu.value });
        }
    }

    /// A warning where the nominal contact, whose heat is left out, warms by much of the rise of its contacts. The mean rise of
    /// a half-space that passes a length L under the flux q is (4/3) q √(L/(πV))/e, and the rise of two that stay in contact at
    /// most q √(t/π)/e with the smaller effusivity (Carslaw & Jaeger 1959, §2.9).
    fn nominal_heating(
        &self,
        (row, rate): (usize, usize),
        contacts: &Contacts,
        sliding: &SlipState,
    ) -> Option<Warning> {
        let slip_rate = self.query.slip_rates[rate];
        let initial = self.asperities[rate].classes[0].1.initial_temperature().ok()?;
        let rise = contacts.temperature_mean?.value - initial;
        let flux = sliding.shear.value * slip_rate;
        let at = || Place::of(self.query, row, rate);
        if self.query.contact_life == ContactLife::Steady {
            let after_a_second = flux / (PI.sqrt() * self.settings.scene.effusivity?);
            let time = (LARGEST_NOMINAL_RISE * rise / after_a_second).powi(2);
            let face_rise = after_a_second * IN_CONTACT.sqrt();
            let counts = rise > 0.0 && time < IN_CONTACT && face_rise > LEAST_NOMINAL_RISE;
            return counts.then(|| Warning::HeatOfFaces {
                at: at(),
                time,
                rise,
                after: IN_CONTACT,
                face_rise,
            });
        }
        let of_unit_length = 4.0 / 3.0 * flux / ((PI * slip_rate).sqrt() * self.settings.scene.effusivity?);
        let length = (LARGEST_NOMINAL_RISE * rise / of_unit_length).powi(2);
        let nominal = self.query.nominal_size.unwrap_or(SMALL_NOMINAL_CONTACT);
        let nominal_rise = of_unit_length * nominal.sqrt();
        let counts = rise > 0.0 && length < nominal && nominal_rise > LEAST_NOMINAL_RISE;
        counts.then(|| Warning::NominalHeating { at: at(), length, rise, nominal, nominal_rise })
    }

    /// A warning where contacts stick for much of the slip that they live for.
    fn short_life(
        &self,
        (row, rate): (usize, usize),
        pressed: &PressedSurface,
        inception: f64,
    ) -> Option<Warning> {
        let ContactLife::Diameters(life) = self.query.contact_life else { return None };
        let life = 2.0 * life * pressed.equilibrium.state.loaded_radius;
        let at = || Place::of(self.query, row, rate);
        // A closed form that ends with sliding inception states no mean friction of a life.
        let has_mean = self.law.above_range() != AboveRange::NoFriction;
        (has_mean && inception > LARGEST_STICK * life).then(|| Warning::ShortLife {
            at: at(),
            life,
            inception,
        })
    }

    /// Time of sliding inception over that of a shear wave across a contact, at the largest mean shear stress of the slide.
    fn inception_time(&self, rate: usize, curve: &[SlipState]) -> Option<f64> {
        let stress = |state: &SlipState| state.shear.value / state.area_fraction.value;
        let largest = curve.iter().map(stress).fold(0.0, f64::max);
        let slip_rate = self.query.slip_rates[rate];
        (largest > 0.0 && slip_rate > 0.0)
            .then_some(self.settings.scene.inception_time? * largest / slip_rate)
    }
}
