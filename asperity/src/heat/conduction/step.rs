//! One step of the time integration, and the matrix that its stages share.

use faer::linalg::solvers::{Llt, SolveCore};
use faer::{Mat, MatMut, Side};

use super::counterface_step::{CounterfaceStep, NetContactHeat};
use super::{Conduction, ContactHeat, GAMMA, HeatBalance, HeatError};
use crate::discretisation::collocation::Parity;
use crate::heat::counterface::Profile;
use crate::solver::harmonic::HarmonicFactors;

/// Iterations for the flux into a conducting counterface, and the tolerance of the balance of the rises, relative to the largest
/// term so far: the one that remains may be zero.
const FLUX_ITERATIONS: usize = 30;
const FLUX_TOLERANCE: f64 = 1e-7;
/// Reduction of the residual in the solution for a flux, from which that for the next flux starts.
const REDUCTION: f64 = 1e-2;

/// C_T + γΔt K_T.
pub(super) struct StepMatrix {
    pub(super) factors: HarmonicFactors,
    /// Schur complement of the contact, dense over (ring, harmonic).
    schur_complement: Mat<f64>,
}

impl StepMatrix {
    pub(super) fn new(factors: HarmonicFactors) -> Self {
        let (rings, harmonics) = (factors.contact_unknowns(), factors.harmonics());
        let mut schur_complement = Mat::zeros(rings * harmonics, rings * harmonics);
        for m in 0..harmonics {
            let complement = factors.schur_complement(m);
            for i in 0..rings {
                for j in 0..rings {
                    schur_complement[(i * harmonics + m, j * harmonics + m)] = complement[i * rings + j];
                }
            }
        }
        Self { factors, schur_complement }
    }
}

/// A step of Δt with its heat sources.
pub(super) struct Step<'a> {
    pub(super) conduction: &'a Conduction,
    pub(super) matrix: &'a StepMatrix,
    pub(super) dt: f64,
    /// Heat given to each node over the step.
    pub(super) body: &'a [f64],
    pub(super) heat: &'a dyn ContactHeat,
    /// The counterface, if it conducts.
    pub(super) counterface: Option<&'a CounterfaceStep<'a>>,
}

/// Temperatures at the nodes, as at the end of a stage.
pub struct HeatState {
    /// Θ, K.
    pub(super) potential: Vec<f64>,
    /// θ, K.
    pub rise: Vec<f64>,
    /// H, in kelvin at c₀.
    pub(super) enthalpy: Vec<f64>,
}

impl HeatState {
    /// State at constant properties, where θ = Θ = H.
    pub(super) fn linear(rise: Vec<f64>) -> Self {
        Self { potential: rise.clone(), enthalpy: rise.clone(), rise }
    }
}

/// Solution of a step.
pub(super) struct Integrated {
    /// States at the ends of both stages.
    pub(super) stages: [HeatState; 2],
    pub(super) balance: HeatBalance,
    /// Into a conducting counterface in both stages.
    pub(super) fluxes: [Profile; 2],
}

/// Solves the stages of a step: C_T H(Θ) + γΔt K_T Θ = rhs + γΔt q(θ).
pub(super) trait StageSolver {
    /// `guess`: temperatures to start from; `reduction`: of its residual that is enough, where a solution with another heat
    /// flow follows, 0 where none does.
    fn solve(
        &mut self,
        step: &Step<'_>,
        rhs: &[f64],
        guess: &HeatState,
        reduction: f64,
    ) -> Result<HeatState, HeatError>;
}

impl Step<'_> {
    /// γΔt.
    pub(super) fn scale(&self) -> f64 {
        GAMMA * self.dt
    }

    /// H₁ = H₀ + γΔt Ḣ₁, H₂ = H₀ + (1 − γ)Δt Ḣ₁ + γΔt Ḣ₂, from those of both stages in `expected` or, without them, from
    /// the state before each.
    pub(super) fn integrate(
        &self,
        solver: &mut impl StageSolver,
        expected: Option<&[HeatState; 2]>,
    ) -> Result<Integrated, HeatError> {
        let (conduction, n) = (self.conduction, self.body.len());
        let start = &conduction.committed.enthalpy;
        let right = |content: &dyn Fn(usize) -> f64| -> Vec<f64> {
            (0..n).map(|i| conduction.heat_capacities[i] * content(i) + GAMMA * self.body[i]).collect()
        };
        let mut fluxes = [Profile::zeros(); 2];
        let guess = expected.map_or(&conduction.committed, |[first, _]| first);
        let first = self.solve(solver, (&right(&|i| start[i]), guess), 0, &mut fluxes)?;
        let reached = &first.enthalpy;
        let ratio = (1.0 - GAMMA) / GAMMA;
        let right = right(&|i| start[i] + ratio * (reached[i] - start[i]));
        let guess = expected.map_or(&first, |[_, last]| last);
        let last = self.solve(solver, (&right, guess), 1, &mut fluxes)?;

        let weighted = |a: f64, b: f64| self.dt * ((1.0 - GAMMA) * a + GAMMA * b);
        let [(net_first, lost_first), (net_last, lost_last)] = [&first, &last].map(|stage| self.flows(stage));
        let counterface = self
            .counterface
            .map_or(0.0, |counterface| counterface.disc.total * weighted(fluxes[0].x, fluxes[1].x));
        let balance = HeatBalance {
            contact: weighted(net_first + lost_first, net_last + lost_last) - counterface,
            counterface,
            gap: weighted(lost_first, lost_last),
            body: (0..n).filter(|&i| !conduction.on_base(i)).map(|i| self.body[i]).sum(),
            base: weighted(conduction.base_flow(&first.potential), conduction.base_flow(&last.potential)),
        };
        Ok(Integrated { stages: [first, last], balance, fluxes })
    }

    /// Solves the stage `stage` (0, 1) with the flux into the counterface, which is entered into `fluxes`.
    fn solve(
        &self,
        solver: &mut impl StageSolver,
        (rhs, guess): (&[f64], &HeatState),
        stage: usize,
        fluxes: &mut [Profile; 2],
    ) -> Result<HeatState, HeatError> {
        let Some(counterface) = self.counterface.filter(|counterface| counterface.disc.total > 0.0) else {
            return solver.solve(self, rhs, guess, 0.0);
        };
        let (disc, resistance) = (&counterface.disc, counterface.resistance);
        let rise_of = |rise: &[f64], point: usize| rise[self.conduction.contact_indices[point]];
        let frictional = |rise: &[f64]| disc.profile(|point| self.heat.flow(point, rise_of(rise, point)).0);
        let at_start = frictional(&guess.rise);
        // Into the counterface if friction generated what it does at the start of the stage.
        let mut flux = counterface.expected[stage];
        let mut before: Option<(Profile, Profile, HeatState)> = None;
        let (mut residual, mut largest) = (f64::INFINITY, f64::MIN_POSITIVE);
        for _ in 0..FLUX_ITERATIONS {
            let heat = NetContactHeat::new(self.heat, disc, flux, at_start);
            let start = before.as_ref().map_or(guess, |(.., stage)| stage);
            let step = Step { heat: &heat, ..*self };
            let solved = solver.solve(&step, rhs, start, REDUCTION)?;
            let rise = disc.profile_of_values(|point| rise_of(&solved.rise, point));
            let generated = frictional(&solved.rise);
            let taken = heat.flux(generated);
            fluxes[stage] = taken;
            let opposite = counterface
                .rise(counterface.response.free(stage, fluxes[0]) + counterface.response.own * taken);
            let released = counterface.released * generated;
            let difference = rise - opposite - resistance * (taken - released);
            let terms = [rise, opposite, resistance * taken, resistance * released];
            largest = terms.iter().map(Profile::amax).fold(largest, f64::max);
            residual = difference.amax() / largest;
            if residual <= FLUX_TOLERANCE {
                // After a small change of the flux little of its residual is left; after the first flux it may be more.
                return match before {
                    Some(_) => Ok(solved),
                    None => solver.solve(&step, rhs, &solved, 0.0),
                };
            }
            if let Some((other, its_difference, _)) = before {
                counterface.update_jacobian(flux - other, difference - its_difference);
            }
            before = Some((flux, difference, solved));
            let change = counterface.jacobian.get().try_inverse().map(|inverse| inverse * difference);
            flux -= change.ok_or(HeatError::NotConverged { residual })?;
        }
        Err(HeatError::NotConverged { residual })
    }

    /// Heat per time through the contact, net, and the part lost to the flat.
    fn flows(&self, stage: &HeatState) -> (f64, f64) {
        let indices = self.conduction.contact_indices.iter().enumerate();
        indices.fold((0.0, 0.0), |(net, lost), (i, &index)| {
            let rise = stage.rise[index];
            (net + self.heat.flow(i, rise).0, lost + self.heat.loss(i, rise))
        })
    }

    /// Cholesky factor of the Schur complement of the contact less γΔt times the `slope` of the heat flow at each
    /// point. It is positive definite, as heat flows fall with temperature, unless too long a step has inverted
    /// elements of the contact.
    pub(super) fn contact_factor(&self, slope: impl Fn(usize) -> f64) -> Result<Llt<f64>, HeatError> {
        let columns = self.matrix.factors.harmonics();
        let table = self.matrix.factors.transform.of(Parity::Even);
        let mut jacobian = self.matrix.schur_complement.clone();
        for ring in 0..self.conduction.mesh.meridian.contact.len() {
            let slopes: Vec<f64> = (0..columns).map(|j| slope(ring * columns + j)).collect();
            for m in 0..self.harmonics_of(ring) {
                for k in 0..self.harmonics_of(ring) {
                    let slope: f64 = (0..columns)
                        .map(|j| table[m * columns + j] * slopes[j] * table[k * columns + j])
                        .sum();
                    jacobian[(ring * columns + m, ring * columns + k)] -= self.scale() * slope;
                }
            }
        }
        jacobian.llt(Side::Lower).map_err(|_| HeatError::NotConverged { residual: f64::NAN })
    }

    /// Harmonics of a contact ring: the apex has the mean alone.
    pub(super) fn harmonics_of(&self, ring: usize) -> usize {
        let meridian = &self.conduction.mesh.meridian;
        let is_apex = meridian.on_axis(meridian.contact[ring] as usize);
        if is_apex { 1 } else { self.matrix.factors.harmonics() }
    }
}

/// Solves the dense system of the contact in place.
pub(super) fn solve_contact(factor: &Llt<f64>, contact: &mut [f64]) {
    let size = contact.len();
    factor.solve_in_place_with_conj(faer::Conj::No, MatMut::from_column_major_slice_mut(contact, size, 1));
}
