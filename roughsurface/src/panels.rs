//! Gauss–Kronrod panels in the root of the interference, sampled once and kept.
//!
//! With ω = u² the 3/2 power of the start of contact becomes a polynomial, and
//! because the panels stand in interference, not in height, the same samples of
//! the asperity law serve every separation: a root solve costs exponentials of
//! heights only.

use crate::asperity_at_slip::AsperityAtSlip;
use crate::heights::Heights;
use tables::law::LookupError;

/// Points of a panel: exact for polynomials up to degree 31.
const POINTS: usize = 21;
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

/// Energy released from full stick to full slip, last because often nobody asks.
pub const ENERGY: usize = 8;
pub const ENERGY_ERROR: usize = 9;

/// Sums over heights, per asperity and metre of height until multiplied out.
pub type Sums = [f64; QUANTITIES];

/// Abscissa, weight, and weight less that of the ten-point Gauss rule, of the 21-point Kronrod
/// rule, half of it: Piessens et al., QUADPACK (Springer 1983), routine QK21.
#[rustfmt::skip]
const HALF_RULE: [(f64, f64, f64); 11] = [
    (0.9956571630258081, 0.011694638867371874, 0.011694638867371874),
    (0.9739065285171717, 0.032558162307964725, -0.03411318200072341),
    (0.9301574913557082, 0.054755896574351995, 0.054755896574351995),
    (0.8650633666889845, 0.07503967481091996, -0.07441167433966063),
    (0.7808177265864169, 0.0931254545836976, 0.0931254545836976),
    (0.6794095682990244, 0.10938715880229764, -0.1096992037136844),
    (0.5627571346686047, 0.12349197626206584, 0.12349197626206584),
    (0.4333953941292472, 0.13470921731147334, -0.134557501998523),
    (0.2943928627014602, 0.14277593857706009, 0.14277593857706009),
    (0.14887433898163122, 0.14773910490133849, -0.14778511981341438),
    (0.0, 0.1494455540029169, 0.1494455540029169),
];

/// Point `index` of the rule on (−1, 1), ascending.
const fn rule(index: usize) -> (f64, f64, f64) {
    if index <= 10 {
        let (abscissa, weight, excess) = HALF_RULE[index];
        (-abscissa, weight, excess)
    } else {
        HALF_RULE[20 - index]
    }
}

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

/// Share of a point's weight by which the ten-point Gauss rule differs from the panel's.
const EXCESS: [f64; POINTS] = {
    let mut shares = [0.0; POINTS];
    let mut point = 0;
    while point < POINTS {
        let (_, weight, excess) = rule(point);
        shares[point] = excess / weight;
        point += 1;
    }
    shares
};

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
        for point in 0..POINTS {
            let (abscissa, weight, _) = rule(point);
            let root = from + half * (1.0 + abscissa);
            panel.interference[point] = critical * root * root;
            // dω = 2u du
            let metres = critical * 2.0 * root * half * weight;
            panel.weighted[point] = quantities(asperity, root * root)?.map(|value| value * metres);
        }
        Ok(panel)
    }

    /// Integral over the panel with summits of density `heights` above a flat at `separation`,
    /// and its error: what the ten-point Gauss rule would differ, a generous one.
    /// Energies stay zero unless asked for `with_energy`.
    pub fn integral(&self, heights: &dyn Heights, separation: f64, with_energy: bool) -> (Sums, Sums) {
        // Whole vectors of eight: what is left over would go through the exponential one by one.
        let mut density = [separation; POINTS.next_multiple_of(8)];
        for (height, interference) in density.iter_mut().zip(&self.interference) {
            *height += interference;
        }
        heights.densities(&mut density);
        let mut sums = [0.0; QUANTITIES];
        let mut difference = [0.0; QUANTITIES];
        self.add::<0, ENERGY>(&density, &mut sums, &mut difference);
        if with_energy {
            self.add::<ENERGY, QUANTITIES>(&density, &mut sums, &mut difference);
        }
        (sums, difference.map(f64::abs))
    }

    /// The quantities from one to the next: a number of them that the compiler knows.
    #[inline(always)]
    fn add<const FROM: usize, const TO: usize>(
        &self,
        density: &[f64],
        sums: &mut Sums,
        difference: &mut Sums,
    ) {
        for point in 0..POINTS {
            let excess = density[point] * EXCESS[point];
            for quantity in FROM..TO {
                sums[quantity] += density[point] * self.weighted[point][quantity];
                difference[quantity] += excess * self.weighted[point][quantity];
            }
        }
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
