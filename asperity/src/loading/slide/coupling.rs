//! Equilibrium of one increment, coupled with the contact edge, the shear limits and the temperature
//! until they agree with the state that they depend on.

use std::time::Instant;

use super::edge_search::EdgeSearch;
use super::friction_heat::HeatSources;
use super::increments::Predictor;
use super::shear_limits::{interface_hardening, shear_limits, shear_strength};
use super::{Advance, Slide, SlideFailure};
use crate::discretisation::body::Body;
use crate::heat::conduction::{Conduction, HeatBalance, HeatError};
use crate::interface::contact::{Contact, FlatPosition};
use crate::loading::problem::Problem;
use crate::solver::StopRequest;
use crate::solver::newton::CouplingData;
use crate::solver::timings::Kernel;

/// Change between iterations, over the tolerance of the residual, at which the coupled quantities are converged: of the
/// areas of the contact points, relative, and of the flat's height, over the interference.
const CONVERGED: f64 = 100.0;
/// The same of the limit of friction: the sum of the changes at all points times their areas, over that of their limits. The
/// largest change at a point would ask for more the finer the mesh, as the edge moves in its cell.
const CONVERGED_FRICTION: f64 = 25.0;
/// Least limit of friction, over that of the initial strength, to which the change is related.
const LEAST_FRICTION: f64 = 0.01;
/// Updates in a step at most. Most steps need 3 to 8; where a hot interface loses its strength as sliding begins, each
/// leaves up to 0.7 of the change of the one before.
const MOST_UPDATES: usize = 24;
/// Updates of the elevation of the flat in a step at most; then it is held. Each leaves about a twentieth of the change of the one
/// before; where the edge of the contact comes to another ring the area, and with it the elevation, may change in turn. What is
/// left is of this increment alone: the next one has all heat.
const ELEVATIONS: usize = 3;
/// Frictional power of the last update over that of the solution, above which the heat is that of the solution.
const EXCESS_HEAT: f64 = 1.1;
/// Updates in a row that do not reduce the smallest change so far, after which the shear limits are held: points at the
/// edge touch and lift off in turn. Converging updates leave 0.1 to 0.7 of the change before.
const STAGNANT_UPDATES: usize = 4;

/// A solved increment; the state itself is the trial state of the mechanics.
pub struct Equilibrium {
    pub flat: FlatPosition,
    pub sources: HeatSources,
    /// Temperature rise and heat balance of the increment, if there is heat.
    pub heated: Option<(Vec<f64>, HeatBalance)>,
}

/// The coupled quantities within one increment.
struct Coupling<'a> {
    problem: &'a Problem,
    /// Rate at which the contact slips, m/s.
    slip_rate: f64,
    conduction: Option<&'a mut Conduction>,
    dt: f64,
    /// Displacement of the flat in the increment.
    slip: f64,
    /// Largest slip of a point in the increment that counts as heating.
    most_slip: f64,
    /// Heat sources of the previous increment, used for the first iterate.
    sources_before: &'a HeatSources,
    edge: EdgeSearch,
    limit: Option<Vec<f64>>,
    /// Smallest change of the coupled quantities so far, and the updates since.
    smallest: (f64, usize),
    /// Tolerance of the residual.
    tolerance: f64,
    /// Updates left of the elevation.
    elevations_left: usize,
    /// Updates left until the coupled quantities are held constant.
    updates_left: usize,
    /// Whether the coupled quantities are held constant: converged, or no updates left. Newton's method then converges fast.
    held: bool,
    sources: HeatSources,
    heated: Option<(Vec<f64>, HeatBalance)>,
    failure: Option<HeatError>,
    heat_time: f64,
}

impl Coupling<'_> {
    /// Contact edge, temperature and shear limits for the trial state of a Newton iteration.
    fn update(&mut self, body: &Body, contact: &mut Contact, iteration: usize) -> Option<CouplingData> {
        if self.held {
            return None;
        }
        if iteration > 0 {
            let edges = self.edge.next(contact.edges(), contact.trial_edges());
            contact.set_edges(&edges);
        }
        let stretch = if self.problem.finite_strain { contact.update_areas(iteration == 0) } else { 0.0 };
        let stretched = stretch / (CONVERGED * self.tolerance);
        // A failed step may have left a meaningless trial state.
        let state = if iteration == 0 { &body.committed } else { &body.trial };
        let hardened = interface_hardening(self.problem, self.slip_rate, body, contact, state);
        let rise = self.temperature(body, contact, &hardened, iteration);
        let (elevation, raised) = self.elevation(contact, iteration).unzip();
        let limit = shear_limits(self.problem, contact, &hardened, rise.as_deref());
        let change = self.friction_change(contact, &limit).max(raised.unwrap_or(0.0)).max(stretched);
        match &mut self.smallest {
            (smallest, since) if change < *smallest => (*smallest, *since) = (change, 0),
            (_, since) => *since += 1,
        }
        let agrees = change <= 1.0 && !contact.has_just_touched();
        self.held = agrees || self.updates_left == 0 || self.smallest.1 == STAGNANT_UPDATES;
        self.updates_left = self.updates_left.saturating_sub(1);
        self.limit = Some(limit.clone());
        let rise = self.conduction.as_ref().zip(rise).map(|(conduction, rise)| conduction.of_body(&rise));
        Some(CouplingData { limit, rise, elevation, converged: self.held })
    }

    /// Temperature rise at the end of the increment with the heat sources of the trial state.
    fn temperature(
        &mut self,
        body: &Body,
        contact: &Contact,
        hardened: &[f64],
        iteration: usize,
    ) -> Option<Vec<f64>> {
        let conduction = self.conduction.as_mut()?;
        let started = Instant::now();
        // The first iterate takes the heat sources of the previous step.
        self.sources = match iteration {
            0 => self.sources_before.clone(),
            _ => HeatSources::of(self.problem, body, contact, (self.dt, self.most_slip)),
        };
        let result = self.sources.heat(self.problem, conduction, contact, hardened, (self.dt, self.slip));
        self.heat_time += started.elapsed().as_secs_f64();
        match result {
            Ok(result) => {
                let rise = result.0.clone();
                self.heated = Some(result);
                Some(rise)
            }
            Err(error) => {
                self.failure = Some(error);
                None
            }
        }
    }

    /// Elevation of the flat by the thermal expansion of the counterface, and its largest change over the tolerance; nothing
    /// where it is held.
    fn elevation(&mut self, contact: &Contact, iteration: usize) -> Option<(Vec<[f64; 2]>, f64)> {
        // The predicted displacement is that on the predicted flat.
        if iteration == 0 || self.elevations_left == 0 {
            return None;
        }
        let started = Instant::now();
        let area = |point| contact.covered_area(&contact.trial, point);
        let elevation = self.conduction.as_ref()?.elevation(area)?;
        self.heat_time += started.elapsed().as_secs_f64();
        let changes =
            elevation.iter().zip(&contact.trial).map(|(now, state)| (now[0] - state.elevation[0]).abs());
        let change = changes.fold(0.0, f64::max) / (CONVERGED * self.tolerance * self.problem.interference);
        self.elevations_left = if change > 1.0 { self.elevations_left - 1 } else { 0 };
        Some((elevation, change))
    }

    /// Heat of the solution, where the last update has more than the solution dissipates.
    fn finish(&mut self, body: &Body, contact: &Contact) {
        if self.conduction.is_none() {
            return;
        }
        let solution = HeatSources::of(self.problem, body, contact, (self.dt, self.most_slip));
        if self.sources.area_swept(contact) > EXCESS_HEAT * solution.area_swept(contact) {
            let hardened = interface_hardening(self.problem, self.slip_rate, body, contact, &body.trial);
            self.temperature(body, contact, &hardened, 1);
        }
    }

    /// Change of the limit of friction since the iteration before, over its tolerance.
    fn friction_change(&self, contact: &Contact, limit: &[f64]) -> f64 {
        let Some(last) = &self.limit else { return f64::INFINITY };
        // In full stick the limits are infinite, and equal.
        let changed = last.iter().zip(limit).zip(&contact.areas).filter(|((a, b), _)| a != b);
        let change: f64 = changed.map(|((a, b), area)| area * (a - b).abs()).sum();
        let friction: f64 = limit.iter().zip(&contact.areas).map(|(limit, area)| area * limit).sum();
        let area: f64 = (0..contact.len()).map(|point| contact.covered_area(&contact.trial, point)).sum();
        let least = LEAST_FRICTION * shear_strength(self.problem, 1.0, 0.0) * area;
        match change / (CONVERGED_FRICTION * self.tolerance * friction.max(least)) {
            _ if change == 0.0 => 0.0,
            change if change.is_nan() => f64::INFINITY,
            change => change,
        }
    }
}

impl Slide<'_> {
    /// Solves an increment from a first guess.
    pub(super) fn equilibrium(
        &mut self,
        &Advance { to, dt, slip_rate, .. }: &Advance,
        guess: Predictor,
        stop: &StopRequest,
    ) -> Result<Equilibrium, SlideFailure> {
        let Predictor { displacement: start, interference, edges, elevation } = guess;
        let flat = FlatPosition { interference, displacement: to };
        let from = self.last().slip;
        // The predictor determines the points in contact, which do not depend on the shear limits.
        let contact = &mut self.mechanics.contact;
        contact.raise(&elevation);
        contact.evaluate(|index| start[index], flat, &vec![0.0; contact.len()]);
        contact.set_edges(&edges);
        let mut coupling = Coupling {
            problem: self.problem,
            slip_rate,
            conduction: self.heat.as_mut(),
            dt,
            slip: to - from,
            // Tractions of the press above the limit are released in the first increment, whatever its length. The press
            // would have released them over its own time.
            most_slip: if self.history.len() == 1 { (to - from).abs() } else { f64::INFINITY },
            sources_before: &self.sources,
            edge: EdgeSearch::default(),
            limit: None,
            smallest: (f64::INFINITY, 0),
            tolerance: self.mechanics.tolerance,
            elevations_left: ELEVATIONS,
            updates_left: MOST_UPDATES,
            held: false,
            sources: HeatSources::default(),
            heated: None,
            failure: None,
            heat_time: 0.0,
        };
        let solved = self.mechanics.solve(flat, self.control, start, stop, |body, contact, iteration| {
            coupling.update(body, contact, iteration)
        });
        if solved.is_ok() {
            coupling.finish(&self.mechanics.body, &self.mechanics.contact);
        }
        let Coupling { sources, heated, failure, heat_time, .. } = coupling;
        self.mechanics.timings.add(Kernel::Heat, heat_time);
        let flat = solved?;
        match failure {
            Some(error) => Err(error.into()),
            None => Ok(Equilibrium { flat, sources, heated }),
        }
    }
}
