//! Gauss–Legendre panels in the root of the interference, sampled once and kept.
//!
//! With ω = u² the 3/2 power of the start of contact becomes a polynomial, and
//! because the panels stand in interference, not in height, the same samples of
//! the asperity law serve every separation: a root solve costs exponentials of
//! heights only.

use crate::asperity_at_slip::AsperityAtSlip;
use crate::heights::Heights;
use gauss_quad::GaussLegendre;
use std::sync::LazyLock;
use tables::law::LookupError;

/// Points of a panel: exact for polynomials up to degree 19.
const POINTS: usize = 10;
/// Quantities summed in one pass.
pub const QUANTITIES: usize = 10;

pub const LOAD: usize = 0;
pub const LOAD_ERROR: usize = 1;
pub const FRICTION: usize = 2;
pub const FRICTION_ERROR: usize = 3;
pub const AREA: usize = 4;
pub const AREA_ERROR: usize = 5;
/// Load times contact radius, for the mean radius of the loaded asperities.
pub const LOAD_RADIUS: usize = 6;
/// Load of asperities beyond the limit of the law.
pub const LOAD_OUTSIDE: usize = 7;

/// Energy released from full stick to full slip.
pub const ENERGY: usize = 8;
pub const ENERGY_ERROR: usize = 9;

/// Sums over heights, per asperity and metre of height until multiplied out.
pub type Sums = [f64; QUANTITIES];

static RULE: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| {
    let rule = GaussLegendre::new(POINTS).expect("ten points are enough for a rule");
    let mut pairs = rule.into_node_weight_pairs();
    pairs.sort_by(|one, other| one.0.total_cmp(&other.0));
    pairs
});

/// Quantities of one asperity at `interference` (ω/ω_c), in the order of [`Sums`].
pub fn quantities(asperity: &AsperityAtSlip, interference: f64) -> Result<Sums, LookupError> {
    let response = asperity.response(interference)?;
    let energy = asperity.energy_release(interference)?;
    let load = response.load.value;
    let radius = (response.area.value.max(0.0) / std::f64::consts::PI).sqrt();
    let outside = interference > asperity.limit();
    Ok([
        load,
        response.load.error,
        response.friction.value,
        response.friction.error,
        response.area.value,
        response.area.error,
        load * radius,
        if outside { load } else { 0.0 },
        energy.value,
        energy.error,
    ])
}

/// The asperity law on u = √(ω/ω_c) from `from` to `to`.
#[derive(Clone, Debug)]
pub struct Panel {
    pub from: f64,
    pub to: f64,
    /// Interference at each point, m.
    interference: [f64; POINTS],
    /// Quantities times the weight of the point, m.
    weighted: [Sums; POINTS],
    children: Option<[usize; 2]>,
}

impl Panel {
    fn new(asperity: &AsperityAtSlip, from: f64, to: f64) -> Result<Self, LookupError> {
        let critical = asperity.critical_interference();
        let half = 0.5 * (to - from);
        let mut panel = Self {
            from,
            to,
            interference: [0.0; POINTS],
            weighted: [[0.0; QUANTITIES]; POINTS],
            children: None,
        };
        for (point, &(node, weight)) in RULE.iter().enumerate() {
            let root = from + half * (1.0 + node);
            panel.interference[point] = critical * root * root;
            // dω = 2u du
            let metres = critical * 2.0 * root * half * weight;
            panel.weighted[point] = quantities(asperity, root * root)?.map(|value| value * metres);
        }
        Ok(panel)
    }

    /// Integral over the panel with summits of density `heights` above a flat at `separation`.
    pub fn integral(&self, heights: &dyn Heights, separation: f64) -> Sums {
        let mut sums = [0.0; QUANTITIES];
        for (interference, weighted) in self.interference.iter().zip(&self.weighted) {
            let density = heights.ln_density(separation + interference).exp();
            for (sum, value) in sums.iter_mut().zip(weighted) {
                *sum += density * value;
            }
        }
        sums
    }
}

/// Panels and their halves, halved on demand.
#[derive(Clone, Debug, Default)]
pub struct PanelTree {
    panels: Vec<Panel>,
}

impl PanelTree {
    /// The panel of that index.
    pub fn panel(&self, index: usize) -> &Panel {
        &self.panels[index]
    }

    /// Forgets every panel.
    pub fn clear(&mut self) {
        self.panels.clear();
    }

    /// Adds a panel over u = `from` to `to` and returns its index.
    pub fn add(&mut self, asperity: &AsperityAtSlip, from: f64, to: f64) -> Result<usize, LookupError> {
        self.panels.push(Panel::new(asperity, from, to)?);
        Ok(self.panels.len() - 1)
    }

    /// The two halves of a panel, sampled at the first call.
    pub fn halves(&mut self, asperity: &AsperityAtSlip, index: usize) -> Result<[usize; 2], LookupError> {
        if let Some(children) = self.panels[index].children {
            return Ok(children);
        }
        let (from, to) = (self.panels[index].from, self.panels[index].to);
        let middle = 0.5 * (from + to);
        let children = [self.add(asperity, from, middle)?, self.add(asperity, middle, to)?];
        self.panels[index].children = Some(children);
        Ok(children)
    }
}
