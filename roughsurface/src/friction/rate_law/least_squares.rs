//! Nonlinear least squares of a form, after Levenberg and Marquardt.

use super::{Form, NoFit, RateLaw};
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
        match curve.mu().max() - curve.mu().min() <= TOLERANCE * curve.mu().max().abs() {
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
    pub fn variance(&self) -> f64 {
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

/// Parameters of a form: friction at low and high slip rate, logarithm of the velocity, exponent.
#[derive(Clone, Copy)]
struct Parameters {
    mu_0: f64,
    plateau: f64,
    ln_velocity: f64,
    exponent: f64,
}

impl Parameters {
    /// Share of μ_0 − μ_∞ that remains, and its derivatives with respect to ln V* and n.
    fn share(&self, form: &Form, rate: f64) -> [f64; 3] {
        let (logarithm, m) = (rate.ln() - self.ln_velocity, form.outer_exponent);
        let power = (self.exponent * logarithm).exp();
        let slope = m * power * (1.0 + power).powf(-m - 1.0);
        [(1.0 + power).powf(-m), self.exponent * slope, -logarithm * slope]
    }

    /// Residuals and, by fitted parameter, their derivatives.
    fn residuals(&self, form: &Form, curve: &Curve) -> (DVector<f64>, DMatrix<f64>) {
        let shares: Vec<[f64; 3]> = curve.rates().map(|rate| self.share(form, rate)).collect();
        let drop = self.mu_0 - self.plateau;
        let fitted = DVector::from_iterator(shares.len(), shares.iter().map(|s| self.plateau + drop * s[0]));
        let jacobian = DMatrix::from_fn(shares.len(), form.parameters(), |row, column| {
            let [share, by_velocity, by_exponent] = shares[row];
            match column {
                0 => share,
                1 => drop * by_velocity,
                2 if form.exponent.is_none() => drop * by_exponent,
                _ => 1.0 - share,
            }
        });
        (fitted - curve.mu(), jacobian)
    }

    fn moved(&self, form: &Form, step: &DVector<f64>) -> Self {
        let free = usize::from(form.exponent.is_none());
        Self {
            mu_0: self.mu_0 + step[0],
            ln_velocity: self.ln_velocity + step[1],
            exponent: self.exponent + if free == 1 { step[2] } else { 0.0 },
            plateau: self.plateau + if form.has_plateau { step[2 + free] } else { 0.0 },
        }
    }

    /// The parameters in the order of the columns of the Jacobian; those that are not fitted do not change.
    fn fitted(&self, form: &Form) -> [f64; 4] {
        let Self { mu_0, plateau, ln_velocity, exponent } = *self;
        match form.exponent {
            None => [mu_0, ln_velocity, exponent, plateau],
            Some(_) => [mu_0, ln_velocity, plateau, exponent],
        }
    }

    /// The friction coefficients that fit best at this velocity and exponent, for which the problem is linear.
    fn with_best_friction(mut self, form: &Form, curve: &Curve) -> Self {
        let columns = if form.has_plateau { 2 } else { 1 };
        let shares: Vec<f64> = curve.rates().map(|rate| self.share(form, rate)[0]).collect();
        let matrix = DMatrix::from_fn(shares.len(), columns, |row, column| match column {
            0 => shares[row],
            _ => 1.0 - shares[row],
        });
        if let Ok(friction) = matrix.svd(true, true).solve(&curve.mu(), 1e-12) {
            self.mu_0 = friction[0];
            self.plateau = if form.has_plateau { friction[1] } else { 0.0 };
        }
        self
    }
}

/// The best point of a grid of velocities and exponents.
fn start(form: &Form, curve: &Curve) -> Parameters {
    const VELOCITIES: usize = 60;
    let (slowest, fastest) = (curve.points[0].0, curve.points[curve.len() - 1].0);
    // Without a plateau, weakening of 1 % at the exponent 1/2 has V* = 1e4 V.
    let span = if form.has_plateau { fastest } else { 1e5 * fastest } / slowest;
    let at = |i: usize| slowest.ln() + span.ln() * i as f64 / (VELOCITIES - 1) as f64;
    let exponents = form.exponent.map_or(vec![0.3, 0.5, 0.8, 1.2, 2.0], |exponent| vec![exponent]);
    let places = exponents.iter().flat_map(|n| (0..VELOCITIES).map(move |i| (at(i), *n)));
    let candidates = places.map(|(ln_velocity, exponent)| {
        let place = Parameters { mu_0: 0.0, plateau: 0.0, ln_velocity, exponent };
        let place = place.with_best_friction(form, curve);
        (place.residuals(form, curve).0.norm_squared(), place)
    });
    candidates.min_by(|one, other| one.0.total_cmp(&other.0)).expect("the grid is not empty").1
}

/// The least squares of `form`.
pub(super) fn minimise(form: &'static Form, curve: &Curve) -> Result<RateLaw, NoFit> {
    let (place, residuals, jacobian) = descend(form, curve, start(form, curve));
    // Where friction rises, the best falling law is a constant.
    let explains = residuals.norm_squared() < (1.0 - TOLERANCE) * curve.variance();
    match explains && place.mu_0 > place.plateau && place.exponent > 0.0 {
        true => law(form, curve, place, &residuals, jacobian).ok_or(NoFit::Undetermined(f64::INFINITY)),
        false => Err(NoFit::NoWeakening),
    }
}

/// From a place to the least squares, with residuals and Jacobian there.
fn descend(form: &Form, curve: &Curve, mut place: Parameters) -> (Parameters, DVector<f64>, DMatrix<f64>) {
    const MOST_STEPS: usize = 300;
    let (mut residuals, mut jacobian) = place.residuals(form, curve);
    let mut damping = 1e-3;
    for _ in 0..MOST_STEPS {
        let mut normal = jacobian.tr_mul(&jacobian);
        for i in 0..form.parameters() {
            normal[(i, i)] *= 1.0 + damping;
        }
        let Some(factor) = normal.cholesky() else { break };
        let step = -factor.solve(&jacobian.tr_mul(&residuals));
        let next = place.moved(form, &step);
        let (there, slopes) = next.residuals(form, curve);
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

/// Largest change of each parameter, in the order of the columns of the Jacobian, where a third of the slip rates is left out
/// and a plateau is still seen.
fn spread(form: &Form, curve: &Curve, whole: Parameters) -> [f64; 4] {
    let mut spread = [0.0; 4];
    let ln_velocity = whole.ln_velocity;
    let seen = |part: &Curve| {
        let above = part.rates().filter(|rate| rate.ln() > ln_velocity).count();
        part.len() >= form.parameters() && (!form.has_plateau || (above >= 2 && above < part.len()))
    };
    for part in curve.parts().iter().filter(|part| seen(part)) {
        let of_part = descend(form, part, whole).0;
        for (largest, (one, other)) in
            spread.iter_mut().zip(of_part.fitted(form).into_iter().zip(whole.fitted(form)))
        {
            *largest = f64::max(*largest, (one - other).abs());
        }
    }
    spread
}

/// The law with its errors; none where the Jacobian has no full rank.
fn law(
    form: &'static Form,
    curve: &Curve,
    place: Parameters,
    residuals: &DVector<f64>,
    mut jacobian: DMatrix<f64>,
) -> Option<RateLaw> {
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
    let variance = if count > parameters { squares / (count - parameters) as f64 } else { 0.0 };
    let errors = DVector::from_iterator(count, curve.points.iter().map(|(_, mu)| mu.error));
    let spread = spread(form, curve, place);
    let error = |i: usize| {
        let row = gain.row(i) / lengths[i];
        f64::max(row.norm() * variance.sqrt(), spread[i]) + (row * &errors)[0].abs()
    };
    let free = usize::from(form.exponent.is_none());
    let velocity = place.ln_velocity.exp();
    let fitted = |is_fitted: bool, value: f64, i: usize| Estimate {
        value,
        error: if is_fitted { error(i) } else { 0.0 },
    };
    Some(RateLaw {
        form,
        mu_0: fitted(true, place.mu_0, 0),
        velocity: Estimate { value: velocity, error: velocity * error(1) },
        exponent: fitted(free == 1, place.exponent, 2),
        plateau: fitted(form.has_plateau, place.plateau, 2 + free),
        misfit: (squares / count as f64).sqrt(),
        r_squared: 1.0 - squares / curve.variance(),
        criterion: curve.criterion(parameters, squares),
        condition,
        fastest: curve.points[count - 1].0,
    })
}
