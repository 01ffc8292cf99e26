//! State of the contact points.

/// State of a contact point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Status {
    /// Open: no traction.
    #[default]
    Open,
    Stick,
    Slip,
}

/// State of a contact point with its fields.
#[derive(Clone, Copy, Debug, Default)]
pub struct PointState {
    pub status: Status,
    /// Pressure p.
    pub pressure: f64,
    /// Gap g, positive when open.
    pub gap: f64,
    /// Shear traction τ of the flat on the asperity.
    pub traction: [f64; 2],
    /// Limit of the shear traction per area of the point, see `interface::friction_law`.
    pub limit: f64,
    /// Displacement Δ of the flat relative to the surface.
    pub relative: [f64; 2],
    /// Irreversible part Δᵖ of the relative displacement, at which the tangential spring of a point has no force.
    pub anchor: [f64; 2],
    /// Path length of slip.
    pub slip: f64,
    /// Height of the flat at the point above its plane, towards the asperity, and the derivative of this along +x.
    pub elevation: [f64; 2],
}
