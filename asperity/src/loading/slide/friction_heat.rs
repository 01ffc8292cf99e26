//! Heat of friction and of plastic work over a step of the slide.

use super::shear_limits::shear_limit_at;
use crate::discretisation::body::Body;
use crate::heat::conduction::{Conduction, ContactHeat, HeatBalance, HeatError};
use crate::interface::contact::{Contact, Status};
use crate::loading::problem::Problem;

/// Heat of friction: flow f_h τ_c(θ) v where the contact slips, less the heat conducted through the gap.
struct FrictionHeat<'a> {
    problem: &'a Problem,
    contact: &'a Contact,
    /// Slip speed.
    speed: Vec<f64>,
    /// Factor by which the interface has hardened, at each contact point.
    hardened: &'a [f64],
    /// Displacement of the flat.
    slip: f64,
}

impl ContactHeat for FrictionHeat<'_> {
    fn flow(&self, point: usize, rise: f64) -> (f64, f64) {
        let problem = self.problem;
        if self.area(point) == 0.0 {
            return (0.0, 0.0);
        }
        let area = self.contact.areas[point];
        let gap = self.conductance(point);
        let power = problem.interface.heat_partition * area * self.speed[point];
        // A point that sticks, as all do without a limit, has no speed.
        if power == 0.0 {
            return (-gap * rise, -gap);
        }
        let limit = |t: f64| shear_limit_at(problem, self.contact, point, self.hardened[point], t);
        let h = 0.01;
        let (traction, slope) = (limit(rise), ((limit(rise + h) - limit(rise - h)) / (2.0 * h)).min(0.0));
        (power * traction - gap * rise, power * slope - gap)
    }

    fn loss(&self, point: usize, rise: f64) -> f64 {
        self.conductance(point) * rise
    }

    fn area(&self, point: usize) -> f64 {
        self.contact.covered_area(&self.contact.trial, point)
    }

    fn slip(&self) -> f64 {
        self.slip
    }
}

impl FrictionHeat<'_> {
    /// Conductance of the gap at a contact point, h_g times its area; zero where it is open.
    fn conductance(&self, point: usize) -> f64 {
        self.problem.gap_biot_number * self.problem.heat_capacity * self.area(point)
    }
}

/// Heat sources of the body over a step: slip speeds at the contact points, plastic power at the nodes.
#[derive(Clone, Debug, Default)]
pub struct HeatSources {
    speed: Vec<f64>,
    plastic: Vec<f64>,
}

impl HeatSources {
    /// Heat sources of the trial state of the mechanics over a step of length `dt`. What a point slips beyond `most_slip`
    /// does not heat it.
    pub fn of(problem: &Problem, body: &Body, contact: &Contact, (dt, most_slip): (f64, f64)) -> Self {
        let mut plastic = vec![0.0; body.mesh.field_length(1)];
        if problem.interface.taylor_quinney > 0.0 {
            body.add_plastic_work(problem.interface.taylor_quinney / dt, &mut plastic);
        }
        let speed = |i| if is_released(contact, i) { 0.0 } else { contact.point_slip(i).min(most_slip) / dt };
        Self { speed: (0..contact.len()).map(speed).collect(), plastic }
    }

    /// Slip speed of the contact times its area: the frictional power over the shear strength.
    pub fn area_swept(&self, contact: &Contact) -> f64 {
        let points = self.speed.iter().enumerate();
        points.map(|(i, speed)| speed * contact.areas[i] * contact.contact_fraction[i]).sum()
    }

    /// Temperature after a step of length `dt`, in which the flat moves by `slip`, with these sources and the factor by
    /// which the interface has hardened.
    pub fn heat(
        &self,
        problem: &Problem,
        conduction: &mut Conduction,
        contact: &Contact,
        hardened: &[f64],
        (dt, slip): (f64, f64),
    ) -> Result<(Vec<f64>, HeatBalance), HeatError> {
        let mut plastic: Vec<f64> = self.plastic.iter().map(|power| power * dt).collect();
        plastic.resize(conduction.body_length(), 0.0);
        let mut speed = self.speed.clone();
        speed.resize(contact.len(), 0.0);
        conduction.advance(dt, &plastic, &FrictionHeat { problem, contact, speed, hardened, slip })
    }
}

/// Whether a point has no friction for the rest of the step because it chatters, and so no heat of friction.
fn is_released(contact: &Contact, point: usize) -> bool {
    let state = &contact.trial;
    state[point].status != Status::Open
        && contact.contact_fraction[point] > 0.0
        && state[point].traction == [0.0; 2]
}

/// Largest and mean temperature rise over the contact.
pub fn contact_rise(contact: &Contact, rise: &[f64]) -> (f64, f64) {
    let (mut largest, mut sum, mut area) = (0.0f64, 0.0, 0.0);
    for i in 0..contact.len() {
        let share = contact.covered_area(&contact.trial, i);
        if share == 0.0 {
            continue;
        }
        let value = rise[contact.scalar_index(i)];
        largest = largest.max(value);
        sum += share * value;
        area += share;
    }
    (largest, if area > 0.0 { sum / area } else { 0.0 })
}
