//! Laws of rate dependence fitted to sliding friction.
//!
//! A contact that lives for the slip D is heated by friction for the time D/V: its temperature rise grows with √(V D), and
//! with a strength that falls in proportion to it friction is μ_0/(1 + √(V/V*)). The forms are
//! μ = μ_∞ + (μ_0 − μ_∞)/(1 + (V/V*)^n), with the exponent 1/2 or a free one, with or without a plateau μ_∞. That with the
//! least information criterion is chosen among those whose parameters the data determine ([`choose`]).
//!
//! Beside it stands the form of rupture codes, μ_w + (μ_0 − μ_w)/[1 + (V/V_w)^8]^{1/8} ([`FLASH_HEATING`]; Dunham et al. 2011,
//! doi 10.1785/0120100075), a smooth one of μ_w + (μ_0 − μ_w) V_w/V above V_w (Rice 2006, doi 10.1029/2005JB004006; Beeler et
//! al. 2008, doi 10.1029/2007JB004988).

mod least_squares;
#[cfg(test)]
mod tests;

use least_squares::{Curve, minimise};
use tables::law::Estimate;

/// A form of rate dependence, μ_∞ + (μ_0 − μ_∞)/(1 + (V/V*)^n)^m.
#[derive(Debug, PartialEq)]
pub struct Form {
    /// Name in files.
    pub name: &'static str,
    /// The form as a formula.
    pub formula: &'static str,
    /// n where it is not fitted.
    exponent: Option<f64>,
    /// m.
    outer_exponent: f64,
    /// Whether μ_∞ is fitted; otherwise it is 0.
    has_plateau: bool,
}

/// The forms to choose from, in the order of their number of parameters.
pub static FORMS: [Form; 4] = [
    Form::new("square-root", "mu_0/[1 + (V/V*)^(1/2)]", Some(0.5), false),
    Form::new("power", "mu_0/[1 + (V/V*)^n]", None, false),
    Form::new("square-root-plateau", "mu_inf + (mu_0 - mu_inf)/[1 + (V/V*)^(1/2)]", Some(0.5), true),
    Form::new("power-plateau", "mu_inf + (mu_0 - mu_inf)/[1 + (V/V*)^n]", None, true),
];

/// The form of rupture codes.
pub static FLASH_HEATING: Form = Form {
    name: "flash-heating",
    formula: "mu_w + (mu_0 - mu_w)/[1 + (V/V_w)^8]^(1/8)",
    exponent: Some(8.0),
    outer_exponent: 0.125,
    has_plateau: true,
};

impl Form {
    const fn new(
        name: &'static str,
        formula: &'static str,
        exponent: Option<f64>,
        has_plateau: bool,
    ) -> Self {
        Self { name, formula, exponent, outer_exponent: 1.0, has_plateau }
    }
}

/// A fitted law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RateLaw {
    pub form: &'static Form,
    /// Friction coefficient at low slip rate, 1.
    pub mu_0: Estimate,
    /// Friction coefficient at high slip rate, μ_∞ or μ_w, 1.
    pub plateau: Estimate,
    /// Characteristic slip rate, V* (half of μ_0 − μ_∞ is left) or V_w, m/s.
    pub velocity: Estimate,
    /// n, 1.
    pub exponent: Estimate,
    /// Root mean square misfit, 1.
    pub misfit: f64,
    /// R², share of the variance of μ over the slip rates that the fit explains, 1.
    pub r_squared: f64,
    /// Information criterion of Akaike with the correction of Hurvich & Tsai (1989, doi 10.1093/biomet/76.2.297) for few
    /// data: N ln(misfit²) + 2k + 2k(k + 1)/(N − k − 1), k the number of parameters with the variance; not a number for
    /// N ≤ k + 1.
    pub criterion: f64,
    /// Condition number of the Jacobian with columns of equal length.
    pub condition: f64,
    /// Second slip rate of the fit, m/s.
    pub second: f64,
    /// Largest slip rate of the fit, m/s.
    pub fastest: f64,
}

impl RateLaw {
    /// Friction coefficient at `slip_rate` (m/s).
    pub fn friction_coefficient(&self, slip_rate: f64) -> f64 {
        let power = (slip_rate / self.velocity.value).powf(self.exponent.value);
        let share = (1.0 + power).powf(-self.form.outer_exponent);
        self.plateau.value + (self.mu_0.value - self.plateau.value) * share
    }

    /// Whether −dμ/d ln V at the fastest slip rate is below half of its largest value. With x = (V/V*)^n it is in proportion to
    /// x/(1 + x)^{1+m}, which is largest at x = 1/m.
    fn reaches_plateau(&self) -> bool {
        let m = self.form.outer_exponent;
        let slope = |x: f64| x * (1.0 + x).powf(-1.0 - m);
        let fastest = (self.fastest / self.velocity.value).powf(self.exponent.value);
        fastest > 1.0 / m && slope(fastest) < 0.5 * slope(1.0 / m)
    }

    /// Why law and data do not agree or its parameters are not determined; none of a reliable law.
    pub fn limitation(&self) -> Option<Limitation> {
        if self.criterion.is_nan() {
            let parameters = self.form.parameters();
            Some(Limitation::FewSlipRates { parameters, least: parameters + 3 })
        } else if self.r_squared < 0.99 {
            Some(Limitation::Misfit)
        } else if self.velocity.value > self.fastest {
            Some(Limitation::Extrapolated(self.fastest))
        } else if self.velocity.value < self.second {
            Some(Limitation::OnsetNotSeen(self.second))
        } else if self.form.has_plateau && !self.reaches_plateau() {
            Some(Limitation::PlateauNotSeen)
        } else if self.velocity.error > 0.5 * self.velocity.value {
            Some(Limitation::Uncertain)
        } else {
            None
        }
    }
}

/// Why a law is not reliable.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Limitation {
    #[error("a law of {parameters} parameters is judged from {least} slip rates on")]
    FewSlipRates { parameters: usize, least: usize },
    #[error("R2 is below 0.99")]
    Misfit,
    /// Where V ≪ V*, μ is μ_0 [1 − (V/V*)^n].
    #[error("V* is above the slip rates, which end at {0} m/s and determine mu_0 and mu_0 V*^-n only")]
    Extrapolated(f64),
    #[error("V* or V_w is below the second slip rate, {0} m/s: the onset of weakening is not resolved")]
    OnsetNotSeen(f64),
    #[error(
        "the slip rates do not reach the plateau: at the fastest, friction still falls with ln V at more than half of its largest rate"
    )]
    PlateauNotSeen,
    #[error("the velocity is not known to half of itself")]
    Uncertain,
}

/// Reason of a failed fit.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NoFit {
    #[error("at least {0} slip rates above zero are needed")]
    TooFewSlipRates(usize),
    #[error("the friction coefficient is not known")]
    NoFriction,
    #[error("friction does not depend on the slip rate")]
    NoRateDependence,
    #[error(
        "{0} slip rates are too few to tell a law from a constant by their information criterion; more may decide"
    )]
    AsConstant(usize),
    #[error("friction does not fall with the slip rate")]
    NoWeakening,
    #[error("the slip rates do not bracket the onset of weakening")]
    OnsetOutside,
    #[error(
        "the slip rates do not reach the plateau: at the fastest, friction still falls with ln V at more than half of its largest \
         rate (V* = {0:.3e} m/s)"
    )]
    NoPlateau(f64),
    #[error("the plateau that fits best is negative, {0:.2}")]
    NegativePlateau(f64),
    #[error(
        "the slip rates do not determine the parameters, condition number {0:.0} of at most {LARGEST_CONDITION:.0}"
    )]
    Undetermined(f64),
}

/// Largest condition number of a fit. Parameters depend on each other moderately to strongly from 30 to 100 (Belsley, Kuh
/// & Welsch 1980, Regression Diagnostics, doi 10.1002/0471725153, section 3.2).
const LARGEST_CONDITION: f64 = 100.0;

/// The laws of one pressure or separation.
#[derive(Clone, Debug)]
pub struct RateLaws {
    /// The law that is chosen.
    pub chosen: Result<RateLaw, NoFit>,
    /// Every form of [`FORMS`], or why it is refused.
    pub candidates: Vec<Result<RateLaw, NoFit>>,
    /// [`FLASH_HEATING`].
    pub flash_heating: Result<RateLaw, NoFit>,
}

/// Fits friction coefficients `mu` at `slip_rates` (m/s) by every form, and chooses the one with the least information
/// criterion. Below six slip rates, which forms of three parameters need, it is the form of two.
///
/// The isothermal limit V = 0 is left out. Errors of the parameters are the largest of (i) the 95 % interval from the scatter
/// about the fit (Student's t), (ii) the change without the lowest or the highest third of the slip rates, as a form that is not
/// that of the data leaves residuals that are no scatter, and (iii) the distance to other minima that the scatter does not
/// exclude at 95 %, plus the effect of the errors of `mu`, which have one sign at all slip rates. Unknown where there are as
/// many slip rates as parameters.
pub fn choose(slip_rates: &[f64], mu: &[Estimate]) -> RateLaws {
    let curve = match Curve::new(slip_rates, mu) {
        Ok(curve) => curve,
        Err(reason) => {
            let refused = Err(reason);
            return RateLaws {
                chosen: refused,
                candidates: vec![refused; FORMS.len()],
                flash_heating: refused,
            };
        }
    };
    let candidates: Vec<_> = FORMS.iter().map(|form| fit(form, &curve)).collect();
    let best = |one: &&RateLaw, other: &&RateLaw| one.criterion.total_cmp(&other.criterion);
    let chosen = match candidates.iter().flatten().filter(|law| law.criterion.is_finite()).min_by(best) {
        // A constant describes the data as well.
        Some(law) if curve.criterion(1, curve.total_sum_of_squares()) <= law.criterion => {
            Err(NoFit::AsConstant(curve.len()))
        }
        Some(law) => Ok(*law),
        None => candidates[0],
    };
    RateLaws { chosen, candidates, flash_heating: fit(&FLASH_HEATING, &curve) }
}

fn fit(form: &'static Form, curve: &Curve) -> Result<RateLaw, NoFit> {
    let least = if form.parameters() == 2 || *form == FLASH_HEATING { 3 } else { form.parameters() + 3 };
    if curve.len() < least {
        return Err(NoFit::TooFewSlipRates(least));
    }
    let law = minimise(form, curve)?;
    let above = curve.rates().filter(|rate| *rate > law.velocity.value).count();
    let below = curve.rates().filter(|rate| *rate < law.velocity.value).count();
    match form.has_plateau {
        true if *form == FLASH_HEATING && (above < 2 || below < 1) => Err(NoFit::OnsetOutside),
        true if *form != FLASH_HEATING && !law.reaches_plateau() => Err(NoFit::NoPlateau(law.velocity.value)),
        true if *form != FLASH_HEATING && law.plateau.value < 0.0 => {
            Err(NoFit::NegativePlateau(law.plateau.value))
        }
        _ if law.condition > LARGEST_CONDITION => Err(NoFit::Undetermined(law.condition)),
        _ => Ok(law),
    }
}
