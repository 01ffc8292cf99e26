//! The counterface: a conducting half-space that moves past the contact.
//!
//! It takes up heat over the contact, a disc of the contact's area, and otherwise loses none. Flux and rise over the disc are
//! described by their [`Profile`]. That of the rise is the convolution of that of the flux, F, with the response G of the
//! half-space, which has moved by d = s(t) − s(t') since the heat of the time t' entered:
//!
//! ```text
//! θ(t) = ∫ G(t − t', s(t) − s(t')) F(t') dt',     G(t, d) = S(√(2κt), d)/(e√(πt)),   e = √(kρc).
//! ```
//!
//! S is the 3 × 3 matrix of [`overlap`]. Its heat expands the half-space, and raises its surface by
//!
//! ```text
//! w(t) = 2(1 + ν)α/(ρc) ∫ B(√(2κ(t − t')), s(t) − s(t')) F(t') dt'
//! ```
//!
//! with B by [`overlap`], as of the surface of a half-space without tractions (J. R. Barber, Int. J. Mech. Sci. 14, 377 (1972);
//! a wave of the wave number k by erfc(k√(κt))). The flux is constant over parts of an increment, and the integral over each part
//! is taken in √(t − t'), in which the integrand is smooth.
//!
//! Where k and c vary with temperature, θ stands for Kirchhoff's potential Θ = ∫k/k₀ dθ, in which steady conduction is linear, and
//! t for ∫κ/κ₀ dt with the diffusivity at a share ([`varying_counterface`]) of the mean potential over the contact. H. S. Carslaw &
//! J. C. Jaeger, *Conduction of Heat in Solids* (1959), §2.16, §10.3–10.7. Chapter "Heat" of the book.

mod overlap;

use gauss_quad::GaussLegendre;
use nalgebra::{Matrix3, Vector3};

use crate::heat::properties::ThermalProperties;
use crate::scene::fitted_constants::varying_counterface;
use overlap::{integral, raised, share};

/// A field over a disc of radius a: the coefficients of its least-squares fit by 1, ξ = x/a and η = 2r²/a² − 1, with x along the
/// motion of the half-space and r from the centre: mean, slope and curvature.
pub type Profile = Vector3<f64>;

/// Points per panel of the convolution, and of the overlap of discs.
const POINTS: [usize; 2] = [6, 24];
/// Points per panel of the convolution, and of the overlap of discs, for the height of the surface, which is smoother.
const POINTS_OF_HEIGHT: [usize; 2] = [4, 12];
/// Panels of the convolution per contact radius that the heat moves or spreads, at a point, at which the heat begins and ends
/// abruptly; over the contact one is enough.
const PANELS_AT_A_POINT: f64 = 4.0;
/// Radius over that of the contact of a disc that stands for a point.
const POINT: f64 = 1e-3;
/// Positions between the middle of the contact and its edge at which the highest rise is sought.
const POSITIONS: i32 = 16;
/// Relative change of contact radius and diffusivity up to which the response in an increment is that of the trial before; the
/// heat in the history differs by up to twice that of the radius from the heat of the increment.
const SAME: f64 = 1e-3;
/// Share of an increment over which the flux is that of its first stage, see [`HalfSpace::step`].
const FIRST_PART: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// A time, multiplied by κ/κ₀ where it varies, and the displacement of the half-space at it; both since the end of the
/// increments before, so that a short increment after a long one has its length.
#[derive(Clone, Copy, Debug)]
struct Moment {
    time: f64,
    slip: f64,
}

impl Moment {
    /// End of the increments before.
    const NOW: Self = Self { time: 0.0, slip: 0.0 };

    /// The moment at a share of the way from now.
    fn at(self, share: f64) -> Self {
        Self { time: share * self.time, slip: share * self.slip }
    }

    /// This moment as seen from `now`.
    fn since(self, now: Self) -> Self {
        Self { time: self.time - now.time, slip: self.slip - now.slip }
    }
}

/// Time in which a flux was constant.
#[derive(Clone, Copy, Debug)]
struct Interval {
    from: Moment,
    to: Moment,
    flux: Profile,
    /// Radius of the contact.
    radius: f64,
}

/// A half-space with the heat that it has taken up. Lengths, times and fluxes in the units of the caller.
#[derive(Clone, Debug)]
pub struct HalfSpace {
    /// √(2κ).
    spreading: f64,
    /// e = √(kρc).
    effusivity: f64,
    /// 1/h_c: difference of the temperatures of both surfaces per flux.
    pub resistance: f64,
    /// Share of the frictional heat that is released on the side of the other body; of no influence without resistance.
    pub share: f64,
    /// 2(1 + ν)α/(ρc): height that the surface gains over the heat per area below it.
    expansion: f64,
    /// Properties that depend on temperature; none where specific heat and conductivity are constant.
    varying: Option<ThermalProperties>,
    /// Mean potential over the contact at the end of the increments before.
    potential: f64,
    history: Vec<Interval>,
    /// The increment tried last, and the fluxes of its stages.
    trial: Option<(StepResponse, [Profile; 2])>,
    of_rise: Rules,
    of_height: Rules,
}

/// Gauss-Legendre rules of the convolution and of the overlap of discs.
type Rules = [GaussLegendre; 2];

fn rules(points: [usize; 2]) -> Rules {
    points.map(|points| GaussLegendre::new(points).expect("there are rules of more than one point"))
}

/// The disc over which the profile of a rise is taken: its radius, and how far its centre is downstream of that of the contact, in
/// the direction of motion of the half-space.
#[derive(Clone, Copy, Debug)]
struct Disc {
    radius: f64,
    downstream: f64,
    /// Motion or spreading per panel of the convolution.
    panel: f64,
}

/// Linear response of the half-space in an increment: profile of the rise of its surface over the contact.
#[derive(Clone, Copy, Debug)]
pub struct StepResponse {
    /// Potential at the ends of the two stages, from the heat of the increments before.
    free: [Profile; 2],
    /// Potential at the end of the second stage per flux of the first.
    first: Matrix3<f64>,
    /// Potential at the end of each stage per flux of that stage.
    pub own: Matrix3<f64>,
    /// a, of the contact.
    radius: f64,
    dt: f64,
    /// Mean κ/κ₀ in the increment.
    diffusivity: f64,
    /// End of the increment.
    to: Moment,
}

impl StepResponse {
    /// Rise at the end of stage `stage` (0, 1) without the flux of that stage, given that of the first.
    pub fn free(&self, stage: usize, first: Profile) -> Profile {
        self.free[stage] + if stage == 0 { Profile::zeros() } else { self.first * first }
    }

    /// Mean potential over the contact at the end of the second stage.
    pub fn potential(&self, fluxes: &[Profile; 2]) -> f64 {
        (self.free(1, fluxes[0]) + self.own * fluxes[1]).x
    }
}

impl HalfSpace {
    /// A half-space of diffusivity κ and effusivity √(kρc) at rise zero.
    pub fn new(diffusivity: f64, effusivity: f64) -> Self {
        Self {
            spreading: (2.0 * diffusivity).sqrt(),
            effusivity,
            resistance: 0.0,
            share: 0.5,
            expansion: 0.0,
            varying: None,
            potential: 0.0,
            history: Vec::new(),
            trial: None,
            of_rise: rules(POINTS),
            of_height: rules(POINTS_OF_HEIGHT),
        }
    }

    /// Sets the thermal expansion (1 + ν)α, 1/K.
    pub fn with_expansion(self, expansion: f64) -> Self {
        let capacity = self.effusivity * std::f64::consts::SQRT_2 / self.spreading;
        Self { expansion: 2.0 * expansion / capacity, ..self }
    }

    /// Sets properties that depend on temperature, if there are any.
    pub fn with_properties(self, varying: Option<ThermalProperties>) -> Self {
        Self { varying, ..self }
    }

    /// Rise of temperature at a potential.
    pub fn rise_at(&self, potential: f64) -> f64 {
        self.varying.as_ref().map_or(potential, |varying| varying.conductivity().inverse_integral(potential))
    }

    /// Bound of the relative error of its mean rise where that is `rise`, see [`varying_counterface`].
    pub fn error_of_mean_rise(&self, rise: f64) -> f64 {
        let of = |varying: &ThermalProperties| {
            let potential = varying.conductivity().integral(rise);
            varying_counterface::MEAN_RISE * varying.diffusivity(potential).ln().abs()
        };
        self.varying.as_ref().map_or(0.0, of)
    }

    /// Whether potential and rise differ.
    pub fn varies(&self) -> bool {
        self.varying.is_some()
    }

    /// Mean κ/κ₀ in an increment that begins now, with the end of the one tried last.
    fn diffusivity(&self) -> f64 {
        let end = self.trial.as_ref().map_or(self.potential, |(step, fluxes)| step.potential(fluxes));
        let mean = 0.5 * (self.potential + end);
        self.varying.as_ref().map_or(1.0, |varying| varying.diffusivity(varying_counterface::SHARE * mean))
    }

    pub fn expands(&self) -> bool {
        self.expansion != 0.0
    }

    /// The response in an increment of length `dt` in which the half-space moves by `slip` past a contact of radius
    /// `radius`.
    ///
    /// The increment has the stages of the two-stage SDIRK scheme, which end at γ and 1 with the weights 1 − γ = 1/√2
    /// and γ: the flux of the first stage acts for the first 1/√2 of the increment, that of the second for the rest.
    /// The response at the end of a stage to its own flux is that to a flux during γ in both.
    pub fn step(&self, dt: f64, slip: f64, radius: f64) -> StepResponse {
        let diffusivity = self.diffusivity();
        let to = Moment { time: diffusivity * dt, slip };
        let is_same = |tried: &StepResponse| {
            (tried.dt, tried.to.slip) == (dt, to.slip)
                && (tried.diffusivity / diffusivity - 1.0).abs() <= SAME
                && (tried.radius / radius - 1.0).abs() <= SAME
        };
        if let Some((tried, _)) = self.trial.filter(|(tried, _)| is_same(tried)) {
            return tried;
        }
        let stage = to.at(1.0 - FIRST_PART);
        let contact = Disc { radius, downstream: 0.0, panel: radius };
        let free = [stage, to].map(|at| self.history.iter().map(|heat| self.rise(heat, at, contact)).sum());
        let response = |until: Moment, at: Moment| {
            let heat = Interval { from: Moment::NOW, to: until, flux: Profile::zeros(), radius };
            self.response(&heat, at, contact)
        };
        let first = response(to.at(FIRST_PART), to);
        let own = response(stage, stage);
        StepResponse { free, first, own, radius, dt, diffusivity, to }
    }

    /// Profile of the height of the surface over the contact at the end of the increment tried last; nothing where it does not
    /// expand.
    pub fn height_tried(&self) -> Option<Profile> {
        let trial = self.trial.as_ref().filter(|_| self.expands())?;
        let (StepResponse { radius, to, .. }, _) = *trial;
        let contact = Disc { radius, downstream: 0.0, panel: radius };
        let heats = self.history.iter().copied().chain(parts(trial));
        let height: Profile = heats.map(|heat| self.raised(&heat, to, contact) * heat.flux).sum();
        // Of the rise of temperature, not of the potential, in the ratio that they have in the contact.
        let potential = trial.0.potential(&trial.1);
        Some(if self.varies() && potential > 0.0 {
            height * (self.rise_at(potential) / potential)
        } else {
            height
        })
    }

    /// Takes note of the fluxes of the stages of an increment, which [`HalfSpace::commit`] makes final.
    pub fn try_fluxes(&mut self, step: StepResponse, fluxes: [Profile; 2]) {
        self.trial = Some((step, fluxes));
    }

    /// Adds the increment tried last to the history.
    pub fn commit(&mut self) {
        if let Some(trial) = self.trial.take() {
            self.potential = trial.0.potential(&trial.1);
            self.history.extend(parts(&trial).into_iter().filter(|part| part.flux != Profile::zeros()));
            for heat in &mut self.history {
                (heat.from, heat.to) = (heat.from.since(trial.0.to), heat.to.since(trial.0.to));
            }
        }
    }

    /// Highest rise within a contact of this radius: on its diameter along the motion. Positions are denser towards the edge,
    /// near which it is at large Péclet numbers.
    pub fn highest_rise(&self, radius: f64) -> f64 {
        let rise = |position: i32| {
            let from_edge = 1.0 - f64::from(position.abs()) / f64::from(POSITIONS);
            let downstream = f64::from(position.signum()) * (1.0 - from_edge * from_edge) * radius;
            let point = Disc { radius: POINT * radius, downstream, panel: radius / PANELS_AT_A_POINT };
            self.rise_at(self.history.iter().map(|heat| self.rise(heat, Moment::NOW, point).x).sum())
        };
        // On both sides: after a reversal the hotter one may be upstream.
        (-POSITIONS..=POSITIONS).map(rise).fold(0.0, f64::max)
    }

    /// Fluxes of the stages to start from: those of the increment tried last or, without one, the last flux.
    pub fn expected_fluxes(&self) -> [Profile; 2] {
        let last = self.history.last().map_or(Profile::zeros(), |interval| interval.flux);
        self.trial.map_or([last; 2], |(_, fluxes)| fluxes)
    }

    /// Rise over a disc at `at` from the heat of an interval before.
    fn rise(&self, heat: &Interval, at: Moment, disc: Disc) -> Profile {
        self.response(heat, at, disc) * heat.flux
    }

    /// Rise over a disc at `at` per flux of an earlier interval.
    fn response(&self, heat: &Interval, at: Moment, disc: Disc) -> Matrix3<f64> {
        let [rule, of_overlap] = &self.of_rise;
        let share = |spread, moved, _| share(of_overlap, [disc.radius, heat.radius], spread, moved);
        let per_flux = 2.0 / (self.effusivity * std::f64::consts::PI.sqrt());
        self.convolution(rule, (heat, at, disc), share) * per_flux
    }

    /// Height of the surface over a disc at `at` per flux of an interval before.
    fn raised(&self, heat: &Interval, at: Moment, disc: Disc) -> Matrix3<f64> {
        let [rule, of_overlap] = &self.of_height;
        let radii = [disc.radius, heat.radius];
        let raised = |spread, moved, root| raised(of_overlap, radii, spread, moved) * (2.0 * root);
        self.convolution(rule, (heat, at, disc), raised) * self.expansion
    }

    /// ∫ `kernel` d√(t − t') over an interval, of √(2κ(t − t')), the distance downstream of the disc and √(t − t').
    fn convolution(
        &self,
        rule: &GaussLegendre,
        (heat, at, Disc { radius, downstream, panel }): (&Interval, Moment, Disc),
        kernel: impl Fn(f64, f64, f64) -> Matrix3<f64>,
    ) -> Matrix3<f64> {
        let [near, far] = [heat.to, heat.from].map(|then| at.time - then.time);
        let [here, there] = [heat.to, heat.from].map(|then| at.slip - then.slip);
        if far <= near.max(0.0) || radius <= 0.0 {
            return Matrix3::zeros();
        }
        let speed = (there - here) / (far - near);
        let kernel = |root: f64| {
            let moved = here + speed * (root * root - near);
            kernel(self.spreading * root, moved - downstream, root)
        };
        let (mut from, end) = (near.max(0.0).sqrt(), far.sqrt());
        let mut sum = Matrix3::zeros();
        while from < end {
            // Heat that has spread further than over the contact varies over the distance that it has spread.
            let length = panel * (self.spreading * from / heat.radius).max(1.0);
            let moved = (from * from + length / speed.abs()).sqrt();
            let to = end.min(moved).min(from + length / self.spreading);
            sum += integral(rule, from, to, kernel);
            from = to;
        }
        sum
    }
}

/// The two parts of an increment with their fluxes, see [`HalfSpace::step`].
fn parts(
    &(StepResponse { to, radius, .. }, [first, second]): &(StepResponse, [Profile; 2]),
) -> [Interval; 2] {
    let middle = to.at(FIRST_PART);
    [
        Interval { from: Moment::NOW, to: middle, flux: first, radius },
        Interval { from: middle, to, flux: second, radius },
    ]
}

#[cfg(test)]
mod tests;
