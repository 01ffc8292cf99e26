//! Equilibrium of body and contact: Newton's method with line search, and conjugate gradients
//! preconditioned by the exact elastic solver with the contact stiffness inside.

use std::sync::Arc;

use faer::linalg::solvers::{Llt, SolveCore};
use faer::{Mat, MatMut, Side};

use crate::body::Body;
use crate::contact::{Contact, Flat, Status};
use crate::harmonic::{FieldKind, HarmonicFactors};

/// Residual below which a state is good enough to ask for its temperature and contact edge.
const REFRESH: f64 = 3e-2;
const NEWTON_LIMIT: usize = 30;
const KRYLOV_LIMIT: usize = 400;
/// Times that a point may touch and lift off in one step before it goes without friction there.
const FLUTTER_LIMIT: u8 = 2;

/// Why a step was not solved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StepFailure {
    #[error("Newton's method did not converge in {NEWTON_LIMIT} iterations (residual {residual:.1e})")]
    Newton { residual: f64 },
    #[error("a number is not finite")]
    NotFinite,
    #[error("the contact stiffness is not positive definite")]
    ContactStiffness,
}

/// Counts of work done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    pub newton: usize,
    pub krylov: usize,
}

/// Dense stiffness of all contact unknowns and harmonics, index (ring, component, harmonic).
struct ContactStiffness {
    elastic: Mat<f64>,
    factor: Option<Llt<f64>>,
}

pub struct Mechanics {
    pub body: Body,
    pub contact: Contact,
    factors: Arc<HarmonicFactors>,
    dense: ContactStiffness,
    pub displacement: Vec<f64>,
    /// Residual, in the energy norm, at which a step counts as solved, relative to √(Pω).
    pub tolerance: f64,
    internal: Vec<f64>,
    modal: Vec<f64>,
    pub effort: Effort,
}

impl Mechanics {
    pub fn new(
        body: Body,
        contact: Contact,
        factors: Arc<HarmonicFactors>,
        displacement: Vec<f64>,
        tolerance: f64,
    ) -> Self {
        let n = factors.contact_unknowns() * factors.harmonics();
        let harmonics = factors.harmonics();
        let mut elastic = Mat::<f64>::zeros(n, n);
        for m in 0..harmonics {
            let stiffness = factors.contact_stiffness(m);
            let size = factors.contact_unknowns();
            for i in 0..size {
                for j in 0..size {
                    elastic[(i * harmonics + m, j * harmonics + m)] = stiffness[i * size + j];
                }
            }
        }
        Self {
            internal: vec![0.0; displacement.len()],
            modal: vec![0.0; factors.modal_length()],
            dense: ContactStiffness { elastic, factor: None },
            body,
            contact,
            factors,
            displacement,
            tolerance,
            effort: Effort::default(),
        }
    }

    /// Solves one step: on success body, contact and displacement hold the trial state.
    ///
    /// `surroundings` gives temperature and shear limits; it is asked anew in each iteration, with
    /// the trial state of the one before, and answers nothing when they shall stay as they are.
    /// The step is solved when the residual is small and they have settled. `start` is the first
    /// guess.
    pub fn solve(
        &mut self,
        flat: Flat,
        start: Vec<f64>,
        mut surroundings: impl FnMut(&mut Body, &mut Contact, usize) -> Option<Surroundings>,
    ) -> Result<(), StepFailure> {
        let mut u = start;
        let n = u.len();
        let mut residual = vec![0.0; n];
        let mut direction = vec![0.0; n];
        let mut trial = vec![0.0; n];
        let mut around =
            surroundings(&mut self.body, &mut self.contact, 0).expect("asked for the first time");
        self.body.internal_force(&u, around.rise.as_deref(), &mut self.internal);
        let mut last = f64::INFINITY;
        let mut flutter = Flutter::new(self.contact.len());
        for iteration in 0..NEWTON_LIMIT {
            self.contact.evaluate(|p| u[p], flat, &around.limit);
            if flutter.damp(&self.contact, &mut around.limit) {
                self.contact.evaluate(|p| u[p], flat, &around.limit);
            }
            residual.copy_from_slice(&self.internal);
            self.contact.subtract_force(&mut residual);
            self.factorise_contact()?;
            self.precondition(&residual, &mut direction);
            let norm = dot(&residual, &direction).max(0.0).sqrt();
            let reference = (0.5 * self.contact.load(&self.contact.trial) * flat.interference).sqrt();
            if !norm.is_finite() {
                return Err(StepFailure::NotFinite);
            }
            let scale = reference.max(f64::MIN_POSITIVE);
            if norm <= self.tolerance * scale && around.settled {
                self.displacement = u;
                return Ok(());
            }
            last = norm / scale;
            self.effort.newton += 1;
            // Forcing term: no more accuracy than the next Newton step can use.
            let forcing = (0.1 * self.tolerance * scale / norm).clamp(1e-3, 0.05);
            self.conjugate_gradients(&residual, &mut direction, forcing);
            self.line_search(&mut u, &mut trial, &direction, &residual, flat, &around);
            let near = norm <= REFRESH * scale;
            if let Some(next) =
                near.then(|| surroundings(&mut self.body, &mut self.contact, iteration + 1)).flatten()
            {
                around = next;
                if around.rise.is_some() {
                    self.body.internal_force(&u, around.rise.as_deref(), &mut self.internal);
                }
            }
        }
        Err(StepFailure::Newton { residual: last })
    }

    /// Goes along `direction` until the slope of the energy has fallen enough; leaves `u` there,
    /// with the internal force of that point.
    ///
    /// Where a full step goes too far, that is mostly because points of the contact touch, lift off
    /// or begin to slip on the way. So the next try is the root of the body's slope, taken as
    /// linear, plus the exact slope of the contact, which is cheap.
    fn line_search(
        &mut self,
        u: &mut Vec<f64>,
        trial: &mut Vec<f64>,
        direction: &[f64],
        residual: &[f64],
        flat: Flat,
        around: &Surroundings,
    ) {
        const ENOUGH: f64 = 0.7;
        const TRIES: usize = 8;
        let initial = dot(residual, direction);
        let contact_slope = |contact: &mut Contact, step: f64| {
            contact.evaluate(|p| u[p] + step * direction[p], flat, &around.limit);
            -contact.work_on(direction)
        };
        // Steps that fall short and that go too far, each with the slope of the body alone.
        let mut low = (0.0, dot(&self.internal, direction));
        let mut high: Option<(f64, f64)> = None;
        let mut step = 1.0;
        for attempt in 1..=TRIES {
            for ((t, &x), &d) in trial.iter_mut().zip(u.iter()).zip(direction) {
                *t = x + step * d;
            }
            self.body.internal_force(trial, around.rise.as_deref(), &mut self.internal);
            let of_body = dot(&self.internal, direction);
            let slope = of_body + contact_slope(&mut self.contact, step);
            if slope.abs() <= ENOUGH * initial.abs() || attempt == TRIES {
                break;
            }
            if !slope.is_finite() {
                high = None;
                step = low.0 + 0.1 * (step - low.0);
                continue;
            }
            if slope > 0.0 {
                high = Some((step, of_body));
            } else {
                low = (step, of_body);
            }
            step = match high {
                None => 2.0 * step,
                Some(high) => {
                    let (mut left, mut right) = (low.0, high.0);
                    for _ in 0..40 {
                        let middle = 0.5 * (left + right);
                        let body = low.1 + (high.1 - low.1) * (middle - low.0) / (high.0 - low.0);
                        if body + contact_slope(&mut self.contact, middle) > 0.0 {
                            right = middle;
                        } else {
                            left = middle;
                        }
                    }
                    let width = high.0 - low.0;
                    right.clamp(low.0 + 0.01 * width, high.0 - 0.01 * width)
                }
            };
        }
        std::mem::swap(u, trial);
    }

    /// Solves tangent·direction = −residual; `direction` holds M⁻¹·residual on entry.
    fn conjugate_gradients(&mut self, residual: &[f64], direction: &mut [f64], tolerance: f64) {
        let n = residual.len();
        let mut r: Vec<f64> = residual.iter().map(|x| -x).collect();
        let mut z: Vec<f64> = direction.iter().map(|x| -x).collect();
        let mut p = z.clone();
        let mut product = vec![0.0; n];
        direction.fill(0.0);
        let mut rho = dot(&r, &z);
        let target = rho * tolerance * tolerance;
        for _ in 0..KRYLOV_LIMIT {
            self.effort.krylov += 1;
            self.body.tangent_product(&p, &mut product);
            self.contact.add_tangent_product(&p, &mut product);
            let curvature = dot(&p, &product);
            if curvature <= 0.0 {
                break;
            }
            let step = rho / curvature;
            for i in 0..n {
                direction[i] += step * p[i];
                r[i] -= step * product[i];
            }
            self.precondition(&r, &mut z);
            let next = dot(&r, &z);
            if next <= target {
                break;
            }
            let beta = next / rho;
            for i in 0..n {
                p[i] = z[i] + beta * p[i];
            }
            rho = next;
        }
    }

    /// Elastic stiffness with the contact stiffness, inverted exactly.
    fn precondition(&mut self, residual: &[f64], solution: &mut [f64]) {
        self.factors.to_modal(residual, &mut self.modal);
        self.factors.forward(&mut self.modal);
        let contact = &mut self.modal[self.factors.contact_offset()..];
        let size = contact.len();
        let factor = self.dense.factor.as_ref().expect("factorised before use");
        factor
            .solve_in_place_with_conj(faer::Conj::No, MatMut::from_column_major_slice_mut(contact, size, 1));
        self.factors.backward(&mut self.modal);
        self.factors.to_nodal(&self.modal, solution);
    }

    /// Adds the present contact stiffness to the elastic one and factorises.
    fn factorise_contact(&mut self) -> Result<(), StepFailure> {
        let mut matrix = self.dense.elastic.clone();
        add_contact_stiffness(&self.factors, &self.contact, &mut matrix);
        self.dense.factor = Some(matrix.llt(Side::Lower).map_err(|_| StepFailure::ContactStiffness)?);
        Ok(())
    }

    /// Back to the state before a step that failed, with the displacement and the cover of that
    /// state: nothing of the attempt may guide the next one.
    pub fn restore(&mut self, displacement: Vec<f64>, cover: Vec<f64>) {
        self.body.restore();
        self.contact.trial.clone_from(&self.contact.committed);
        self.contact.cover = cover;
        self.displacement = displacement;
    }

    /// Body, contact and displacement.
    pub fn into_parts(self) -> (Body, Contact, Vec<f64>) {
        (self.body, self.contact, self.displacement)
    }
}

/// What the mechanics of a step depends on from outside: temperature and the shear limits.
pub struct Surroundings {
    /// Limit of the shear traction at each contact point.
    pub limit: Vec<f64>,
    /// Temperature rise, if there is any.
    pub rise: Option<Vec<f64>>,
    /// Whether they agree with the state that they depend on.
    pub settled: bool,
}

/// Points that touch and lift off in turn.
///
/// The shear traction at the limit does not fall to nothing with the pressure, so it jumps when a
/// point lifts off, and Newton's method can go to and fro over the jump for ever. Such a point
/// bears next to no pressure, at the very edge.
struct Flutter {
    open: Vec<bool>,
    changes: Vec<u8>,
}

impl Flutter {
    fn new(points: usize) -> Self {
        Self { open: Vec::new(), changes: vec![0; points] }
    }

    /// Notes the present state, and takes the friction from points that have changed too often.
    fn damp(&mut self, contact: &Contact, limit: &mut [f64]) -> bool {
        let open: Vec<bool> = contact.trial.status.iter().map(|&s| s == Status::Open).collect();
        let mut damped = false;
        for i in 0..self.open.len() {
            if open[i] != self.open[i] {
                self.changes[i] = self.changes[i].saturating_add(1);
            }
            if self.changes[i] > FLUTTER_LIMIT && limit[i].is_finite() && limit[i] > 0.0 {
                limit[i] = 0.0;
                damped = true;
            }
        }
        self.open = open;
        damped
    }
}

/// Adds the contact stiffness, transformed to harmonics ring by ring.
fn add_contact_stiffness(factors: &HarmonicFactors, contact: &Contact, matrix: &mut Mat<f64>) {
    assert_eq!(factors.kind, FieldKind::Vector);
    let columns = contact.columns;
    let transform = &factors.transform;
    let table = |c: usize| transform.of(factors.kind.parity(c));
    let size = 3 * columns;
    for ring in 0..contact.radii.len() {
        let nodes = &contact.stiffness[ring * columns..(ring + 1) * columns];
        if nodes.iter().all(|d| d[2][2] == 0.0) {
            continue;
        }
        // Over (component, harmonic).
        let mut local = vec![0.0; size * size];
        for (c, d) in (0..9).map(|i| (i / 3, i % 3)) {
            if nodes.iter().all(|node| node[c][d] == 0.0) {
                continue;
            }
            for m in 0..columns {
                for k in 0..columns {
                    let sum: f64 = (0..columns)
                        .map(|j| table(c)[m * columns + j] * nodes[j][c][d] * table(d)[k * columns + j])
                        .sum();
                    local[(c * columns + m) * size + d * columns + k] += sum;
                }
            }
        }
        if contact.radii[ring] == 0.0 {
            local = axis_block(&local, columns);
        }
        for i in 0..size {
            for j in 0..size {
                matrix[(ring * size + i, ring * size + j)] += local[i * size + j];
            }
        }
    }
}

/// The apex has u_z of m = 0 and the translation u_r = −u_θ of m = 1 only.
fn axis_block(local: &[f64], columns: usize) -> Vec<f64> {
    let size = 3 * columns;
    let mut block = vec![0.0; size * size];
    let axial = 2 * columns;
    block[axial * size + axial] = local[axial * size + axial];
    if columns > 1 {
        let (r, t) = (1, columns + 1);
        let at = |i: usize, j: usize| local[i * size + j];
        block[r * size + r] = at(r, r) - at(r, t) - at(t, r) + at(t, t);
        block[r * size + axial] = at(r, axial) - at(t, axial);
        block[axial * size + r] = block[r * size + axial];
    }
    block
}

pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    // Four sums, in a fixed order, for the machine's vector units.
    let mut sums = [0.0; 8];
    let (a8, a_rest) = a.as_chunks::<8>();
    let (b8, b_rest) = b.as_chunks::<8>();
    for (x, y) in a8.iter().zip(b8) {
        for l in 0..8 {
            sums[l] = crate::lanes::fma(x[l], y[l], sums[l]);
        }
    }
    sums.iter().sum::<f64>() + a_rest.iter().zip(b_rest).map(|(x, y)| x * y).sum::<f64>()
}
