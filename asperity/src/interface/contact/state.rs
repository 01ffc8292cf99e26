//! State of the contact points.

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
    pub(super) fn spread(&self, columns: usize) -> Self {
        fn spread<T: Copy>(v: &[T], columns: usize) -> Vec<T> {
            v.iter().flat_map(|&x| std::iter::repeat_n(x, columns)).collect()
        }
        Self {
            status: spread(&self.status, columns),
            pressure: spread(&self.pressure, columns),
            gap: spread(&self.gap, columns),
            traction: spread(&self.traction, columns),
            limit: spread(&self.limit, columns),
            relative: spread(&self.relative, columns),
            anchor: spread(&self.anchor, columns),
            slip: spread(&self.slip, columns),
            elevation: spread(&self.elevation, columns),
        }
    }
}
