//! The state of a slide after an increment, from the mechanics and the heat: forces, contact, and the totals of work
//! and heat.
//!
//! The work of the flat is the sum of elastic energy, plastic and frictional dissipation, energy of the
//! contact springs, work done through thermal expansion of asperity and flat, and elastic energy released as the moduli
//! soften. Heat in is the sum of heat stored and heat out.

use super::Slide;
use super::coupling::Equilibrium;
use super::friction_heat::contact_rise;
use crate::interface::contact::FlatPosition;
use crate::loading::state::SlideState;

/// Least frictional heat of an increment over the heat that enters or leaves the asperity, of which the partition is taken:
/// while the contact sticks after a reversal, both bodies exchange heat without friction.
const LEAST_FRICTIONAL: f64 = 0.5;

impl Slide<'_> {
    /// The trial state with the totals of `previous`.
    pub(super) fn present_state(&self, slip: f64, previous: SlideState) -> SlideState {
        let contact = &self.mechanics.contact;
        SlideState {
            slip,
            interference: self.interference,
            friction: contact.friction(&contact.trial),
            load: contact.load(&contact.trial),
            area: contact.area(&contact.trial),
            stick_fraction: contact.stick_fraction(&contact.trial),
            mobilised: contact.mobilised_strength(&contact.trial),
            transverse: contact.transverse_share(&contact.trial),
            plastic_strain_max: self.mechanics.body.trial.largest_plastic_strain(),
            ..previous
        }
    }

    /// The state after the solved increment of `dt`, with its work and heat added to the totals.
    pub(super) fn next_state(&self, dt: f64, solved: &Equilibrium) -> SlideState {
        let flat = solved.flat;
        let mut state = self.present_state(flat.displacement, *self.last());
        state.interference = flat.interference;
        state.time += dt;
        let old = FlatPosition { interference: self.interference, displacement: self.last().slip };
        let interface = self.mechanics.contact.step_work(old, flat);
        state.work += interface.of_flat;
        state.friction_work += interface.friction;
        state.springs += interface.springs;
        let body = &self.mechanics.body;
        let energies = body.step_energies();
        state.elastic += body.elastic_energy(&body.trial) - body.elastic_energy(&body.committed);
        state.plastic += energies.plastic;
        state.thermal_expansion += energies.thermal_expansion - interface.expansion;
        state.moduli_softening += energies.moduli_softening;
        if let (Some((rise, balance)), Some(conduction)) = (&solved.heated, &self.heat) {
            state.heat_in += balance.contact + balance.body;
            state.heat_out += balance.base + balance.gap;
            state.heat_stored = conduction.stored();
            (state.rise_max, state.rise_mean) = contact_rise(&self.mechanics.contact, rise);
            state.heat_counterface += balance.counterface;
            let generated = balance.contact + balance.counterface;
            // In a hold both bodies exchange more heat than a contact generates that relaxes.
            let slides = self.problem.counterface.is_some() && self.motion.slip_rate() > 0.0;
            if slides && generated > LEAST_FRICTIONAL * balance.contact.abs() {
                state.heat_partition = balance.contact / generated;
            }
        }
        state
    }

    /// Commits the solved increment and appends its state.
    pub(super) fn commit(&mut self, state: SlideState, solved: Equilibrium) {
        let Equilibrium { flat, sources, heated } = solved;
        if let (Some(_), Some(conduction)) = (heated, self.heat.as_mut()) {
            conduction.commit();
        }
        self.mechanics.body.commit();
        self.mechanics.contact.commit();
        self.sources = sources;
        self.interference = flat.interference;
        self.history.push(state);
    }
}
