//! State of the contact points.

use crate::discretisation::collocation::Collocation;

/// State of a contact point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Open: no traction.
    Open,
    Stick,
    Slip,
}

/// State of all contact points, ring by ring, angles within.
#[derive(Clone, Debug)]
pub struct ContactState {
    pub status: Vec<Status>,
    /// Pressure p.
    pub pressure: Vec<f64>,
    /// Gap, positive when open.
    pub gap: Vec<f64>,
    /// Shear traction of the flat on the asperity.
    pub traction: Vec<[f64; 2]>,
    /// Limit of the shear traction.
    pub limit: Vec<f64>,
    /// Displacement of the flat relative to the surface.
    pub relative: Vec<[f64; 2]>,
    /// Relative displacement at which the tangential spring of a point has no force.
    pub anchor: Vec<[f64; 2]>,
    /// Path length of slip.
    pub slip: Vec<f64>,
    /// Height of the flat at the point above its plane, towards the asperity, and the derivative of this along +x.
    pub elevation: Vec<[f64; 2]>,
}

impl ContactState {
    pub(super) fn new(points: usize) -> Self {
        Self {
            status: vec![Status::Open; points],
            pressure: vec![0.0; points],
            gap: vec![0.0; points],
            traction: vec![[0.0; 2]; points],
            limit: vec![0.0; points],
            relative: vec![[0.0; 2]; points],
            anchor: vec![[0.0; 2]; points],
            slip: vec![0.0; points],
            elevation: vec![[0.0; 2]; points],
        }
    }

    /// An axisymmetric state at all angles.
    pub(super) fn spread(&self, sectors: &Collocation) -> Self {
        Self {
            status: sectors.spread(&self.status),
            pressure: sectors.spread(&self.pressure),
            gap: sectors.spread(&self.gap),
            traction: sectors.spread(&self.traction),
            limit: sectors.spread(&self.limit),
            relative: sectors.spread(&self.relative),
            anchor: sectors.spread(&self.anchor),
            slip: sectors.spread(&self.slip),
            elevation: sectors.spread(&self.elevation),
        }
    }
}
