//! Nonlinear least squares of a form, after Levenberg and Marquardt.

use super::{Form, NoFit, RateLaw};
use crate::friction::confidence::student_t;
use nalgebra::{DMatrix, DVector};
use tables::law::Estimate;

/// Friction coefficients over ascending positive slip rates.
pub(super) struct Curve {
    points: Vec<(f64, Estimate)>,
}

impl Curve {
    pub fn new(slip_rates: &[f64], mu: &[Estimate]) -> Result<Self, NoFit> {
        let pairs = slip_rates.iter().copied().zip(mu.iter().copied());
        let mut points: Vec<(f64, Estimate)> = pairs.filter(|(rate, _)| *rate > 0.0).collect();
        points.sort_by(|one, other| one.0.total_cmp(&other.0));
        points.dedup_by(|next, kept| next.0 == kept.0);
        let curve = Self { points };
        if curve.len() < 3 {
            return Err(NoFit::TooFewSlipRates(3));
        }
        if curve.mu().iter().any(|value| value.is_nan()) {
            return Err(NoFit::NoFriction);
        }
        // Each is a ratio of two integrals.
        match curve.mu().max() - curve.mu().min() <= 10.0 * TOLERANCE * curve.mu().max().abs() {
            true => Err(NoFit::NoRateDependence),
            false => Ok(curve),
        }
    }

    /// Without the lowest third, and without the highest third of the slip rates.
    fn parts(&self) -> [Self; 2] {
        let (count, third) = (self.len(), self.len() / 3);
        [third..count, 0..count - third].map(|part| Self { points: self.points[part].to_vec() })
    }

    pub fn len(&self) -> usize {
        self.points.len()
    }

    pub fn rates(&self) -> impl Iterator<Item = f64> {
        self.points.iter().map(|(rate, _)| *rate)
    }

    fn mu(&self) -> DVector<f64> {
        DVector::from_iterator(self.len(), self.points.iter().map(|(_, mu)| mu.value))
    }

    /// Sum of the squared distances of μ from its mean.
    pub fn total_sum_of_squares(&self) -> f64 {
        self.mu().add_scalar(-self.mu().mean()).norm_squared()
    }

    /// Information criterion of a fit with that many `parameters` and sum of `squares`.
    pub fn criterion(&self, parameters: usize, squares: f64) -> f64 {
        let (count, k) = (self.len() as f64, parameters as f64 + 1.0);
        if count <= k + 1.0 {
            return f64::NAN;
        }
        let square = (squares / count).max((TOLERANCE * self.mu().max()).powi(2));
        count * square.ln() + 2.0 * k + 2.0 * k * (k + 1.0) / (count - k - 1.0)
    }
}

/// Relative error of the integrals over the surface.
const TOLERANCE: f64 = 1e-6;

/// Parameters of a form, each at its place, of which the form fits those of [`Form::fitted`].
type Parameters = [f64; 4];
/// Friction at low slip rate.
const MU_0: usize = 0;
const LN_VELOCITY: usize = 1;
const EXPONENT: usize = 2;
/// Friction at high slip rate.
const PLATEAU: usize = 3;

impl Form {
    /// The places of the parameters that are fitted, in the order of the columns of the Jacobian.
    fn fitted(&self) -> &'static [usize] {
        match (self.exponent, self.has_plateau) {
            (None, true) => &[MU_0, LN_VELOCITY, EXPONENT, PLATEAU],
            (None, false) => &[MU_0, LN_VELOCITY, EXPONENT],
            (Some(_), true) => &[MU_0, LN_VELOCITY, PLATEAU],
            (Some(_), false) => &[MU_0, LN_VELOCITY],
        }
    }

    /// Number of fitted parameters.
    pub(super) fn parameters(&self) -> usize {
        self.fitted().len()
    }

    /// Share of μ_0 − μ_∞ that remains, and its derivatives with respect to ln V* and n.
    fn share(&self, at: &Parameters, rate: f64) -> [f64; 3] {
        let (logarithm, m) = (rate.ln() - at[LN_VELOCITY], self.outer_exponent);
        let power = (at[EXPONENT] * logarithm).exp();
        let slope = m * power * (1.0 + power).powf(-m - 1.0);
        [(1.0 + power).powf(-m), at[EXPONENT] * slope, -logarithm * slope]
    }

    /// Residuals and, by fitted parameter, their derivatives.
    fn residuals(&self, at: &Parameters, curve: &Curve) -> (DVector<f64>, DMatrix<f64>) {
        let drop = at[MU_0] - at[PLATEAU];
        let shares: Vec<[f64; 3]> = curve.rates().map(|rate| self.share(at, rate)).collect();
        let fitted = DVector::from_iterator(shares.len(), shares.iter().map(|s| at[PLATEAU] + drop * s[0]));
        let jacobian = DMatrix::from_fn(shares.len(), self.parameters(), |row, column| {
            let [share, by_velocity, by_exponent] = shares[row];
            [share, drop * by_velocity, drop * by_exponent, 1.0 - share][self.fitted()[column]]
        });
        (fitted - curve.mu(), jacobian)
    }

    /// Sets the friction coefficients that fit best at this velocity and exponent, for which the problem is linear.
    fn fit_friction(&self, at: &mut Parameters, curve: &Curve) {
        let friction = if self.has_plateau { &[MU_0, PLATEAU][..] } else { &[MU_0] };
        let shares: Vec<f64> = curve.rates().map(|rate| self.share(at, rate)[0]).collect();
        let matrix = DMatrix::from_fn(shares.len(), friction.len(), |row, column| match friction[column] {
            MU_0 => shares[row],
            _ => 1.0 - shares[row],
        });
        if let Ok(best) = matrix.svd(true, true).solve(&curve.mu(), 1e-12) {
            friction.iter().zip(&best).for_each(|(place, value)| at[*place] = *value);
        }
    }
}

/// Points of a grid of velocities and exponents that fit better than their neighbours of the same exponent. A steep form may
/// have a least square between any two slip rates.
fn starts(form: &Form, curve: &Curve) -> Vec<Parameters> {
    const VELOCITIES: usize = 60;
    let (slowest, fastest) = (curve.points[0].0, curve.points[curve.len() - 1].0);
    // Without a plateau, weakening of 1 % at the exponent 1/2 has V* = 1e4 V.
    let span = if form.has_plateau { fastest } else { 1e5 * fastest } / slowest;
    let exponents = form.exponent.map_or(vec![0.3, 0.5, 0.8, 1.2, 2.0], |exponent| vec![exponent]);
    let mut starts = Vec::new();
    for exponent in exponents {
        let candidate = |i: usize| {
            let ln_velocity = slowest.ln() + span.ln() * i as f64 / (VELOCITIES - 1) as f64;
            let mut place = [0.0, ln_velocity, exponent, 0.0];
            form.fit_friction(&mut place, curve);
            (form.residuals(&place, curve).0.norm_squared(), place)
        };
        let candidates: Vec<(f64, Parameters)> = (0..VELOCITIES).map(candidate).collect();
        for (i, (squares, place)) in candidates.iter().enumerate() {
            let neighbours = &candidates[i.saturating_sub(1)..(i + 2).min(VELOCITIES)];
            if neighbours.iter().all(|(others, _)| squares <= others) {
                starts.push(*place);
            }
        }
    }
    starts
}

/// A fit with its residuals and, by fitted parameter, their derivatives.
type Minimum = (Parameters, DVector<f64>, DMatrix<f64>);

/// The least squares of `form`.
pub(super) fn minimise(form: &'static Form, curve: &Curve) -> Result<RateLaw, NoFit> {
    let minima: Vec<Minimum> =
        starts(form, curve).into_iter().map(|start| descend(form, curve, start)).collect();
    let squares = |minimum: &Minimum| minimum.1.norm_squared();
    let least = minima.iter().min_by(|one, other| squares(one).total_cmp(&squares(other)));
    let least = least.ok_or(NoFit::NoFriction)?;
    let (place, residuals, _) = least;
    // Where friction rises, the best falling law is a constant.
    let explains = residuals.norm_squared() < (1.0 - TOLERANCE) * curve.total_sum_of_squares();
    match explains && place[MU_0] > place[PLATEAU] && place[EXPONENT] > 0.0 {
        true => law(form, curve, least, &minima).ok_or(NoFit::Undetermined(f64::INFINITY)),
        false => Err(NoFit::NoWeakening),
    }
}

/// Descends from the parameters `place` to the least squares; with residuals and Jacobian there.
fn descend(form: &Form, curve: &Curve, mut place: Parameters) -> Minimum {
    const MOST_STEPS: usize = 300;
    let (mut residuals, mut jacobian) = form.residuals(&place, curve);
    let mut damping = 1e-3;
    for _ in 0..MOST_STEPS {
        let mut normal = jacobian.tr_mul(&jacobian);
        for i in 0..form.parameters() {
            normal[(i, i)] *= 1.0 + damping;
        }
        let Some(factor) = normal.cholesky() else { break };
        let step = -factor.solve(&jacobian.tr_mul(&residuals));
        let mut next = place;
        form.fitted().iter().zip(&step).for_each(|(parameter, step)| next[*parameter] += step);
        let (there, slopes) = form.residuals(&next, curve);
        if there.norm_squared() <= residuals.norm_squared() {
            (place, residuals, jacobian) = (next, there, slopes);
            damping *= 0.2;
            if step.norm() < 1e-11 {
                break;
            }
        } else if damping > 1e12 {
            break;
        } else {
            damping *= 5.0;
        }
    }
    (place, residuals, jacobian)
}

/// Largest change of each parameter to `others`, minima that the scatter does not exclude, and where a third of the slip rates
/// is left out and a plateau is still seen.
fn spread(form: &Form, curve: &Curve, whole: Parameters, others: &[Parameters]) -> Parameters {
    let mut spread = [0.0; 4];
    let seen = |part: &Curve| {
        let above = part.rates().filter(|rate| rate.ln() > whole[LN_VELOCITY]).count();
        part.len() >= form.parameters() && (!form.has_plateau || (above >= 2 && above < part.len()))
    };
    let parts = curve.parts();
    let of_parts = parts.iter().filter(|part| seen(part)).map(|part| descend(form, part, whole).0);
    for other in of_parts.chain(others.iter().copied()) {
        for (largest, (one, other)) in spread.iter_mut().zip(other.into_iter().zip(whole)) {
            *largest = f64::max(*largest, (one - other).abs());
        }
    }
    spread
}

/// The law of the least of the `minima` with its errors; none where its Jacobian has no full rank.
fn law(form: &'static Form, curve: &Curve, least: &Minimum, minima: &[Minimum]) -> Option<RateLaw> {
    let (place, residuals, mut jacobian) = least.clone();
    let (count, parameters) = (curve.len(), form.parameters());
    let lengths: Vec<f64> = jacobian.column_iter().map(|column| column.norm()).collect();
    if !lengths.iter().all(|length| length.is_normal()) {
        return None;
    }
    for (mut column, length) in jacobian.column_iter_mut().zip(&lengths) {
        column /= *length;
    }
    let singular = jacobian.singular_values();
    let condition = singular.max() / singular.min();
    // Change of each parameter with each friction coefficient.
    let gain = jacobian.pseudo_inverse(1e-12).ok().filter(|_| condition < 1e10)?;
    let squares = residuals.norm_squared();
    let variance = squares / count.saturating_sub(parameters) as f64;
    let errors = DVector::from_iterator(count, curve.points.iter().map(|(_, mu)| mu.error));
    let student_t = student_t(count as f64 - parameters as f64);
    // Within the 95 % interval of a parameter by its profile of S, S <= S_min [1 + t²/(N − k)] (Bates & Watts 1988, Nonlinear
    // Regression Analysis and Its Applications, doi 10.1002/9780470316757, section 6.1).
    let most = squares + student_t.powi(2) * variance;
    let others = minima.iter().filter(|minimum| minimum.1.norm_squared() <= most);
    let others: Vec<Parameters> = others.map(|minimum| minimum.0).collect();
    let spread = spread(form, curve, place, &others);
    let estimate = |parameter: usize| {
        let column = form.fitted().iter().position(|fitted| *fitted == parameter);
        // A curve through as many points as it has parameters has no scatter, and unknown errors.
        let error = column.map_or(0.0, |column| match count > parameters {
            true => {
                let row = gain.row(column) / lengths[column];
                f64::max(student_t * row.norm() * variance.sqrt(), spread[parameter])
                    + (row * &errors)[0].abs()
            }
            false => f64::NAN,
        });
        Estimate { value: place[parameter], error }
    };
    let (ln_velocity, velocity) = (estimate(LN_VELOCITY), place[LN_VELOCITY].exp());
    let to_other = |other: &Parameters| (other[LN_VELOCITY].exp() - velocity).abs();
    let velocity_error = others.iter().map(to_other).fold(velocity * ln_velocity.error, f64::max);
    Some(RateLaw {
        form,
        mu_0: estimate(MU_0),
        velocity: Estimate { value: velocity, error: velocity_error },
        exponent: estimate(EXPONENT),
        plateau: estimate(PLATEAU),
        misfit: (squares / count as f64).sqrt(),
        r_squared: 1.0 - squares / curve.total_sum_of_squares(),
        criterion: curve.criterion(parameters, squares),
        condition,
        second: curve.points[1].0,
        fastest: curve.points[count - 1].0,
    })
}
