//! Line search of Newton's method: the step at which the slope of the energy along the direction has fallen enough.

use tables::functions::bisect;

use super::{CouplingData, LoadingControl, Mechanics};
use crate::interface::contact::FlatPosition;
use crate::material::lanes::dot;

/// Share of the slope of the energy that a step may leave.
const SUFFICIENT_DECREASE: f64 = 0.7;
/// Longest step, as share of the interference, at whose end temperature and contact edge are evaluated before the
/// stress of the body: a longer one may invert elements at the surface.
const SHORT: f64 = 0.1;
const TRIES: usize = 8;

/// Direction of a Newton step, and the residual at its start.
pub(super) struct Line<'a> {
    pub(super) direction: &'a [f64],
    pub(super) residual: &'a [f64],
    pub(super) flat: FlatPosition,
    pub(super) control: LoadingControl,
}

impl Line<'_> {
    pub(super) fn is_short(&self) -> bool {
        let longest = self.direction.iter().fold(0.0f64, |longest, d| longest.max(d.abs()));
        longest <= SHORT * self.flat.interference
    }

    /// Position of the flat that far along, where `size` is the number of displacements.
    pub(super) fn flat_at(&self, size: usize, step: f64) -> FlatPosition {
        let sink = self.direction.get(size).copied().unwrap_or(0.0);
        FlatPosition { interference: self.flat.interference + step * sink, ..self.flat }
    }
}

impl Mechanics {
    /// Sets `trial` that far along a line from `u`, with the internal force of that point; its share in the slope
    /// of the energy is returned.
    fn go(&mut self, u: &[f64], trial: &mut [f64], line: &Line, step: f64, rise: Option<&[f64]>) -> f64 {
        let size = self.internal.len();
        for ((t, &x), &d) in trial.iter_mut().zip(u).zip(line.direction) {
            *t = x + step * d;
        }
        self.internal_force(&trial[..size], rise);
        dot(&self.internal, &line.direction[..size])
    }

    /// Share of contact and load in the slope of the energy that far along a line from `u`.
    fn contact_slope(&mut self, u: &[f64], line: &Line, step: f64, limit: &[f64]) -> f64 {
        let size = self.internal.len();
        let contact = &mut self.contact;
        contact.evaluate(|p| u[p] + step * line.direction[p], line.flat_at(size, step), limit);
        let work = match line.control {
            LoadingControl::Interference => 0.0,
            LoadingControl::Load(load) => 0.5 * (contact.load(&contact.trial) - load) * line.direction[size],
        };
        work - contact.work_on(line.direction)
    }

    /// Advances along a line until the slope of the energy has fallen enough; leaves `u` there, with
    /// the internal force of that point. Returns the step length.
    ///
    /// Where a full step is too long, this is mostly because contact points touch, lift off or begin to slip. So the
    /// next try is the root of the slope of the body, taken as linear, plus the exact slope of the contact.
    ///
    /// With the coupling data `next` of the end of the full step, the body has their temperature, and a full step that
    /// suffices with their shear limits is taken.
    pub(super) fn line_search(
        &mut self,
        u: &mut Vec<f64>,
        trial: &mut Vec<f64>,
        line: &Line,
        data: &CouplingData,
        next: Option<&CouplingData>,
    ) -> f64 {
        let rise = next.unwrap_or(data).rise.as_deref();
        // Of the slope of the energy at the start.
        let most = SUFFICIENT_DECREASE * dot(line.residual, line.direction).abs();
        // Steps that fall short and that go too far, each with the slope of the body alone.
        let mut low = (0.0, dot(&self.internal, &line.direction[..self.internal.len()]));
        let mut high: Option<(f64, f64)> = None;
        let mut step = 1.0;
        for attempt in 1..=TRIES {
            let of_body = self.go(u, trial, line, step, rise);
            let mut suffices = |limit: &[f64]| {
                let slope = of_body + self.contact_slope(u, line, step, limit);
                (slope.abs() <= most, slope)
            };
            if attempt == 1 && next.is_some_and(|next| suffices(&next.limit).0) {
                break;
            }
            let (enough, slope) = suffices(&data.limit);
            if enough || attempt == TRIES {
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
                Some(high) => self.slope_root(u, line, low, high, &data.limit),
            };
        }
        std::mem::swap(u, trial);
        step
    }

    /// Root of the slope between two steps with the slopes of the body, linear, and the exact slope of the contact.
    fn slope_root(
        &mut self,
        u: &[f64],
        line: &Line,
        low: (f64, f64),
        high: (f64, f64),
        limit: &[f64],
    ) -> f64 {
        let width = high.0 - low.0;
        let [root, _] = bisect([high.0, low.0], 40, |step| {
            let body = low.1 + (high.1 - low.1) * (step - low.0) / width;
            body + self.contact_slope(u, line, step, limit) > 0.0
        });
        root.clamp(low.0 + 0.01 * width, high.0 - 0.01 * width)
    }
}
