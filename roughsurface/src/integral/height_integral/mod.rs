//! The response of single asperities integrated over their heights: η ∫ f(z − d) φ(z) dz for load, friction,
//! area and number at once (Greenwood & Williamson 1966, doi 10.1098/rspa.1966.0242).
//!
//! Depends on `panels`, `asperity_at_slip` and the heights of `crate::surface`. Chapter "Rough surfaces" of the book.

use crate::integral::asperity_at_slip::AsperityAtSlip;
use crate::integral::contact_state::{ContactState, Integral};
use crate::integral::panels::*;
use crate::surface::heights::Heights;
use tables::law::LookupError;

/// Share of the load outside the range of a law that may be ignored.
///
/// A tenth of a per cent is far below the errors of any table. More of it on the extrapolated part of the law draws a
/// warning, more of it beyond the largest contact of the model is refused.
pub const NEGLIGIBLE_SHARE: f64 = 1e-3;

/// Largest number of halvings of a panel; its error then enters the estimate.
const MOST_ROUNDS: usize = 60;

/// Largest change of ln φ across a panel; its points resolve the exponential up to there, and beyond it the
/// panel is halved without an error estimate.
const DENSITY_RANGE: f64 = 25.0;

/// Power of ω with which the share of an octave of ω in the load grows at equal density: P ∝ ω^{3/2} of elastic spheres, the
/// fastest growth of what is integrated.
const GROWTH: f64 = 2.5;

/// Margin of ln(φ ω^{5/2}) below the tolerance, a factor of 10⁷: friction and area grow more slowly than the load, and the
/// interferences that are left out are many octaves.
const MARGIN: f64 = 16.0;

/// First panel of a law without kinks, in √(ω/ω_c). Beyond the last kink each panel is twice as long as the
/// one before.
const FIRST_PANEL: f64 = 1.0;

/// Summits of a surface at one slip rate and slip, for any separation.
pub struct HeightIntegral<'a> {
    asperity: AsperityAtSlip<'a>,
    pub(super) heights: &'a dyn Heights,
    asperity_density: f64,
    pub(super) tolerance: f64,
    /// Panels: [`KEPT`] and [`PASSING`].
    trees: [PanelTree; 2],
    /// Panels that together cover ω from zero upwards.
    roots: Vec<Root>,
}

/// The tree of the panels that every separation shares, and that of those between edges of the density.
const KEPT: usize = 0;
const PASSING: usize = 1;

/// Tree and index of a panel.
type PanelIndex = (usize, usize);

/// A panel between kinks of the law, sampled only where there are summits: a table may have missing cells
/// elsewhere.
struct Root {
    from: f64,
    to: f64,
    panel: Option<usize>,
}

/// How a panel fits the density.
enum Fit {
    /// The panel has no weight in the integral.
    Negligible,
    /// The panel is fine enough.
    Fine,
    /// The panel is to be replaced by finer ones.
    Coarse,
    /// The panel is to be cut at an edge of the density, u = √(ω/ω_c).
    CutAt(f64),
}

#[derive(Clone, Copy)]
struct Leaf {
    place: PanelIndex,
    value: Sums,
    error: Errors,
}

impl<'a> HeightIntegral<'a> {
    /// `asperity_density` in 1/m²; `tolerance` is the required relative error of
    /// load, friction and area.
    pub fn new(
        asperity: AsperityAtSlip<'a>,
        heights: &'a dyn Heights,
        asperity_density: f64,
        tolerance: f64,
    ) -> Self {
        let mut breaks = asperity.breaks();
        if breaks.is_empty() {
            breaks.push(FIRST_PANEL);
        }
        let mut from = 0.0;
        let root = |place: f64| {
            let root = Root { from, to: place.sqrt(), panel: None };
            from = root.to;
            root
        };
        Self {
            asperity,
            heights,
            asperity_density,
            tolerance,
            trees: Default::default(),
            roots: breaks.into_iter().map(root).collect(),
        }
    }

    /// Load, friction, area and number of contacts at `separation` (m).
    pub fn at(&mut self, separation: f64) -> Result<ContactState, LookupError> {
        if let Some(heights) = self.heights.finite_set() {
            return self.summed(heights, separation);
        }
        let leaves = self.refine(separation)?;
        let (total, error) = sums(&leaves);
        Ok(self.scaled(self.heights.tail(separation), &total, &error))
    }

    /// Panels fine enough for the tolerance, by ascending interference.
    fn refine(&mut self, separation: f64) -> Result<Vec<Leaf>, LookupError> {
        self.trees[PASSING].clear();
        let mut leaves = self.cover(separation)?;
        for _ in 0..MOST_ROUNDS {
            let (total, error) = sums(&leaves);
            if !excessive(&error, 1.0, self.tolerance, &total) {
                break;
            }
            let share = 0.5 / leaves.len() as f64;
            let tolerance = self.tolerance;
            let poor = |error: &Errors| excessive(error, share, tolerance, &total);
            let mut finer = Vec::with_capacity(2 * leaves.len());
            for leaf in leaves {
                let (tree, index) = leaf.place;
                let Panel { from, to, .. } = self.trees[tree].panels[index];
                // The spacing of numbers ends the halving.
                if !poor(&leaf.error) || to - from < 1e-14 * to {
                    finer.push(leaf);
                    continue;
                }
                for panel in self.trees[tree].finer(&self.asperity, index)? {
                    finer.push(self.leaf((tree, panel), separation));
                }
                // A panel that is too coarse here mostly is at the next separation as well.
                self.trees[tree].panels[index].too_coarse = true;
            }
            leaves = finer;
        }
        Ok(leaves)
    }

    /// Covers all interferences of weight with panels in which the density is smooth and resolved by the
    /// points.
    fn cover(&mut self, separation: f64) -> Result<Vec<Leaf>, LookupError> {
        let (negligible, reach) = self.weight(separation);
        let mut pending = self.roots_of_weight(separation, (negligible, reach))?;
        let mut leaves = Vec::new();
        // Panels leave the stack by ascending interference.
        pending.reverse();
        while let Some(place @ (tree, index)) = pending.pop() {
            match self.fit(place, separation, negligible) {
                Fit::Negligible => {}
                Fit::Fine => leaves.push(self.leaf(place, separation)),
                Fit::Coarse => {
                    let finer = self.trees[tree].finer(&self.asperity, index)?;
                    pending.extend(finer.rev().map(|panel| (tree, panel)));
                }
                Fit::CutAt(edge) => {
                    let Panel { from, to, .. } = self.trees[tree].panels[index];
                    let first = self.trees[PASSING].add(&self.asperity, from, edge)?;
                    let second = self.trees[PASSING].add(&self.asperity, edge, to)?;
                    pending.extend([(PASSING, second), (PASSING, first)]);
                }
            }
        }
        Ok(leaves)
    }

    /// ln(φ ω^{5/2}), ω in metres, below which interferences are negligible at `separation` (m), and the interference (m) from
    /// which on all are. The heights of a wide distribution that carry the load are far above those that are most frequent:
    /// by 3/2 of the variance of ln z where ln z is Gaussian.
    fn weight(&self, separation: f64) -> (f64, f64) {
        /// Octaves below the standard deviation, in which the densities of light contacts fall.
        const SMALL: i32 = 12;
        let (lowest, highest) = self.heights.support();
        let mut end = (highest - separation).min(self.heights.standard_deviation()) * 0.5f64.powi(SMALL);
        let (mut negligible, mut reach, mut before) = (f64::NEG_INFINITY, 0.0, f64::NEG_INFINITY);
        let mut start = 0.0;
        while separation + start < highest {
            let (from, to) = ((separation + start).max(lowest), (separation + end).min(highest));
            let weight = match from < to {
                true => self.heights.ln_peak(from, to) + GROWTH * end.ln(),
                false => f64::NEG_INFINITY,
            };
            negligible = negligible.max(weight + self.tolerance.ln() - MARGIN);
            if weight >= negligible {
                reach = end;
            } else if weight < before && highest == f64::INFINITY && from > self.heights.mode() {
                // Heights of several peaks have a highest one.
                break;
            }
            (start, end, before) = (end, 2.0 * end, weight);
        }
        (negligible, reach)
    }

    /// The kept panels between kinks of the law in which the density is not negligible, by ascending interference.
    fn roots_of_weight(
        &mut self,
        separation: f64,
        (negligible, reach): (f64, f64),
    ) -> Result<Vec<PanelIndex>, LookupError> {
        let mut panels = Vec::new();
        let critical = self.asperity.critical_interference();
        let (lowest, highest) = self.heights.support();
        for position in 0.. {
            if position == self.roots.len() {
                let from = self.roots[position - 1].to;
                self.roots.push(Root { from, to: 2.0 * from, panel: None });
            }
            let root = &mut self.roots[position];
            let [start, end] = [root.from, root.to].map(|root| critical * root * root);
            if start >= reach {
                break;
            }
            let highest = (separation + end).min(highest);
            if highest <= lowest || self.heights.ln_peak(lowest, highest) + GROWTH * end.ln() < negligible {
                continue;
            }
            let panel = match root.panel {
                Some(panel) => panel,
                None => self.trees[KEPT].add(&self.asperity, root.from, root.to)?,
            };
            root.panel = Some(panel);
            panels.push((KEPT, panel));
        }
        Ok(panels)
    }

    /// How a panel fits the density at `separation` (m), with the bound of [`weight`](Self::weight).
    fn fit(&self, (tree, index): PanelIndex, separation: f64, negligible: f64) -> Fit {
        let critical = self.asperity.critical_interference();
        let (lowest, highest) = self.heights.support();
        let Panel { from, to, too_coarse, .. } = self.trees[tree].panels[index];
        let bottom = (separation + critical * from * from).max(lowest);
        let top = (separation + critical * to * to).min(highest);
        if bottom >= top {
            return Fit::Negligible;
        }
        let largest = self.heights.ln_peak(bottom, top);
        let negligible = negligible - GROWTH * (top - separation).ln();
        if largest < negligible {
            return Fit::Negligible;
        }
        if too_coarse {
            return Fit::Coarse;
        }
        // Between its steps a density may vanish or jump: they come before its range.
        let root = |height: f64| ((height - separation) / critical).max(0.0).sqrt();
        let inside = |edge: &f64| *edge > from + 1e-12 * to && *edge < to - 1e-12 * to;
        // A step at an end of the panel would hide others within.
        let margin = 4e-12 * (top - separation);
        let step = self.heights.step_between(bottom + margin, top - margin);
        if let Some(edge) = step.map(root).filter(inside) {
            return Fit::CutAt(edge);
        }
        // Densities that vanish at their edge are left to the error control.
        let seen = |height: f64| match self.heights.ln_density(height) {
            f64::NEG_INFINITY => self.heights.ln_density(0.5 * (bottom + top)),
            density => density,
        };
        let range = largest - seen(bottom).min(seen(top)).max(negligible);
        if range > DENSITY_RANGE && to - from > 1e-12 * to {
            return Fit::Coarse;
        }
        [lowest, highest].map(root).into_iter().find(inside).map_or(Fit::Fine, Fit::CutAt)
    }

    fn leaf(&self, place @ (tree, index): PanelIndex, separation: f64) -> Leaf {
        let with_additional = self.asperity.has_additional();
        let (value, error) = self.trees[tree].integral(index, self.heights, separation, with_additional);
        Leaf { place, value, error }
    }

    /// Values per nominal area from sums per asperity.
    fn scaled(&self, tail: f64, total: &Sums, error: &Errors) -> ContactState {
        let density = self.asperity_density;
        let integral = |value: usize, law_error: usize, error_of: usize| Integral {
            value: density * total[value],
            law_error: density * total[law_error],
            // Rounding of the sums themselves.
            quadrature_error: density * (error[error_of] + 4.0 * f64::EPSILON * total[value].abs()),
        };
        let share = |part: usize| {
            if total[LOAD] > 0.0 { total[part] / total[LOAD] } else { 0.0 }
        };
        ContactState {
            pressure: integral(LOAD, LOAD_ERROR, LOAD),
            shear: integral(FRICTION, FRICTION_ERROR, FRICTION),
            area_fraction: integral(AREA, AREA_ERROR, AREA),
            additional: self
                .asperity
                .has_additional()
                .then(|| integral(ADDITIONAL, ADDITIONAL_ERROR, OF_ADDITIONAL)),
            contact_density: density * tail,
            loaded_radius: share(LOAD_RADIUS),
            outside: share(LOAD_OUTSIDE),
            beyond: share(LOAD_BEYOND),
            coefficient_error: density * total[COEFFICIENT_ERROR],
            shear_by_load_error: density * total[FRICTION_BY_LOAD_ERROR],
        }
    }

    /// Sum over a finite set of heights, highest first.
    fn summed(&self, heights: &[f64], separation: f64) -> Result<ContactState, LookupError> {
        let critical = self.asperity.critical_interference();
        let weight = 1.0 / heights.len() as f64;
        let mut total = [0.0; QUANTITIES];
        let touching = heights.iter().take_while(|&&height| height > separation);
        for &height in touching {
            let values = quantities(&self.asperity, (height - separation) / critical)?;
            for (sum, value) in total.iter_mut().zip(values) {
                *sum += weight * value;
            }
        }
        Ok(self.scaled(self.heights.tail(separation), &total, &Errors::default()))
    }
}

/// Whether the error of load, friction or area exceeds a `share` of the tolerance.
fn excessive(error: &Errors, share: f64, tolerance: f64, total: &Sums) -> bool {
    [LOAD, FRICTION, AREA].iter().any(|&k| error[k] > tolerance * total[k].abs() * share)
}

/// The integrals of all panels together, and their errors.
fn sums(leaves: &[Leaf]) -> (Sums, Errors) {
    let (mut total, mut error) = (Sums::default(), Errors::default());
    for leaf in leaves {
        total.iter_mut().zip(leaf.value).for_each(|(sum, value)| *sum += value);
        error.iter_mut().zip(leaf.error).for_each(|(sum, value)| *sum += value);
    }
    (total, error)
}

#[cfg(test)]
mod tests;
