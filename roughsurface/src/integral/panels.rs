//! Gauss–Kronrod panels in the root of the interference, sampled once and stored.
//!
//! With ω = u² the 3/2 power of the start of contact becomes a polynomial, and
//! because the panels divide the interference, not the height, the same samples of
//! the asperity law serve every separation: the search for a separation costs exponentials of
//! heights only.

use crate::integral::asperity_at_slip::AsperityAtSlip;
use crate::integral::kronrod::{FEW, MANY, Rule};
use crate::surface::heights::Heights;
use tables::law::LookupError;

/// Densities are computed in whole vectors.
const LANES: usize = 8;
const MOST_POINTS: usize = MANY.count().next_multiple_of(LANES);

/// Quantities summed in one pass.
pub const QUANTITIES: usize = 13;

pub const LOAD: usize = 0;
pub const FRICTION: usize = 1;
pub const AREA: usize = 2;
/// Load times contact radius, for the mean radius of the loaded asperities.
pub const LOAD_RADIUS: usize = 3;
pub const LOAD_ERROR: usize = 4;
pub const FRICTION_ERROR: usize = 5;
pub const AREA_ERROR: usize = 6;
/// Load of asperities beyond the range of the law.
pub const LOAD_OUTSIDE: usize = 7;
/// Load of asperities beyond the largest contact of the model.
pub const LOAD_BEYOND: usize = 8;
/// Friction times the relative error of Q/P of the asperity, and times that of its load.
pub const COEFFICIENT_ERROR: usize = 9;
pub const FRICTION_BY_LOAD_ERROR: usize = 10;
/// An [additional quantity](crate::integral::asperity_at_slip::Additional), last because it is often not required.
pub const ADDITIONAL: usize = 11;
pub const ADDITIONAL_ERROR: usize = 12;

/// Sums over heights, per asperity and metre of height until multiplied out.
pub type Sums = [f64; QUANTITIES];

/// Errors of quadrature of the first three quantities and, last, of the additional one.
pub type Errors = [f64; 4];

/// Place of the additional quantity among the errors.
pub const OF_ADDITIONAL: usize = 3;

/// Ratio of its ends below which a panel is narrow and few points suffice.
const NARROW: f64 = 1.5;

/// Quantities of one asperity at `interference` (ω/ω_c), in the order of [`Sums`].
pub fn quantities(asperity: &AsperityAtSlip, interference: f64) -> Result<Sums, LookupError> {
    let response = asperity.response(interference)?;
    let additional = asperity.additional(interference, &response)?;
    let load = response.load.value;
    let radius = (response.area.value.max(0.0) / std::f64::consts::PI).sqrt();
    let load_above = |limit: f64| if interference > limit { load } else { 0.0 };
    Ok([
        load,
        response.friction.value,
        response.area.value,
        load * radius,
        response.load.error,
        response.friction.error,
        response.area.error,
        load_above(asperity.limit()),
        load_above(asperity.contact_limit()),
        response.coefficient_error * response.friction.value.abs(),
        if load > 0.0 { response.load.error / load * response.friction.value } else { 0.0 },
        additional.value,
        additional.error,
    ])
}

/// The asperity law on u = √(ω/ω_c) from `from` to `to`.
#[derive(Clone, Copy, Debug)]
pub struct Panel {
    pub from: f64,
    pub to: f64,
    rule: &'static Rule,
    /// Its points among those of the tree, and their quantities.
    first_point: usize,
    first_sums: usize,
    finer: Option<(usize, Option<usize>)>,
    /// Whether its error was too large at an earlier separation: it is then skipped.
    pub too_coarse: bool,
}

/// Panels, and finer ones made of them on demand.
#[derive(Clone, Debug, Default)]
pub struct PanelTree {
    pub panels: Vec<Panel>,
    /// Interference at each point, m: of every panel a multiple of [`LANES`], the last repeated.
    interference: Vec<f64>,
    /// Quantities times the weight of the point, m.
    weighted: Vec<Sums>,
}

impl PanelTree {
    /// Removes every panel.
    pub fn clear(&mut self) {
        self.panels.clear();
        self.interference.clear();
        self.weighted.clear();
    }

    /// Adds a panel over u = `from` to `to` and returns its index.
    pub fn add(&mut self, asperity: &AsperityAtSlip, from: f64, to: f64) -> Result<usize, LookupError> {
        self.add_with(asperity, from, to, if to < NARROW * from { &FEW } else { &MANY })
    }

    fn add_with(
        &mut self,
        asperity: &AsperityAtSlip,
        from: f64,
        to: f64,
        rule: &'static Rule,
    ) -> Result<usize, LookupError> {
        let critical = asperity.critical_interference();
        let half = 0.5 * (to - from);
        let (first_point, first_sums) = (self.interference.len(), self.weighted.len());
        for (abscissa, weight) in rule.points() {
            let root = from + half * (1.0 + abscissa);
            // dω = 2u du
            let metres = critical * 2.0 * root * half * weight;
            let sums = quantities(asperity, root * root)?;
            self.interference.push(critical * root * root);
            self.weighted.push(sums.map(|value| value * metres));
        }
        let last = critical * to * to;
        self.interference.resize(first_point + rule.count().next_multiple_of(LANES), last);
        let panel = Panel { from, to, rule, first_point, first_sums, finer: None, too_coarse: false };
        self.panels.push(panel);
        Ok(self.panels.len() - 1)
    }

    /// Replaces a panel that is too coarse: the same with more points and, of one
    /// that has them, its halves. Sampled at the first call.
    pub fn finer(
        &mut self,
        asperity: &AsperityAtSlip,
        index: usize,
    ) -> Result<impl DoubleEndedIterator<Item = usize> + use<>, LookupError> {
        let Panel { from, to, rule, finer, .. } = self.panels[index];
        let (first, second) = match finer {
            Some(known) => known,
            None => {
                let made = if std::ptr::eq(rule, &FEW) {
                    (self.add_with(asperity, from, to, &MANY)?, None)
                } else {
                    let middle = 0.5 * (from + to);
                    (self.add(asperity, from, middle)?, Some(self.add(asperity, middle, to)?))
                };
                self.panels[index].finer = Some(made);
                made
            }
        };
        Ok(std::iter::once(first).chain(second))
    }

    /// Integral over a panel with summits of density `heights` above a flat at `separation`,
    /// and its error, an upper bound: the difference from the Gauss rule within.
    /// Additional quantities are zero unless `with_additional` is set.
    pub fn integral(
        &self,
        index: usize,
        heights: &dyn Heights,
        separation: f64,
        with_additional: bool,
    ) -> (Sums, Errors) {
        let Panel { rule, first_point, first_sums, .. } = self.panels[index];
        let count = rule.count();
        let mut buffer = [0.0; MOST_POINTS];
        let density = &mut buffer[..count.next_multiple_of(LANES)];
        for (height, interference) in density.iter_mut().zip(&self.interference[first_point..]) {
            *height = separation + interference;
        }
        heights.densities(density);
        let terms = || density.iter().zip(rule.excess).zip(&self.weighted[first_sums..][..count]);
        let (mut sums, mut difference) = ([0.0; QUANTITIES], Errors::default());
        for ((density, excess), weighted) in terms() {
            let excess = density * excess;
            for quantity in 0..ADDITIONAL {
                sums[quantity] += density * weighted[quantity];
            }
            for quantity in 0..OF_ADDITIONAL {
                difference[quantity] += excess * weighted[quantity];
            }
        }
        if with_additional {
            for ((density, excess), weighted) in terms() {
                sums[ADDITIONAL] += density * weighted[ADDITIONAL];
                sums[ADDITIONAL_ERROR] += density * weighted[ADDITIONAL_ERROR];
                difference[OF_ADDITIONAL] += density * excess * weighted[ADDITIONAL];
            }
        }
        (sums, difference.map(f64::abs))
    }
}
