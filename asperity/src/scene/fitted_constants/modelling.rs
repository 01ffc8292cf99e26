//! Constants of the modelling errors, see `simulate::accuracy::modelling_error`.

/// Effect of finite strain on an elastic contact in a slide, see `simulate::strain` and `simulate::accuracy::modelling_error`.
///
/// - Chosen: changes relative to the value, over σ_Y/E, for an interface of the share f of the strength of the body: of friction and
///   area f², of `G` f to the power ENERGY_EXPONENT and in proportion to ω₀/ω_c; of the press as bounds. Below LIGHT ω_c
///   they fall with the root of the interference, as strains do.
/// - Data: σ_Y/E = 0.0017, 0.0068 and 0.023, V = 0, 14 elements, 8 angles. Friction and area 0.51 to 0.65 (f = 0.9, 0.3 and 0.8 ω_c), 0.18
///   to 0.20 (f = 0.5), at 0.1 ω_c 0.9 to 1.4; static friction 0.25 to 0.41 (f = 0.5), 0.63 to 0.66 (f = 0.9); `G` 3.0 to 3.5 (f = 0.5, 0.8 ω_c), 0.8 to 1.4 (0.3 ω_c),
///   at most 0.4 (f = 0.9); area of the press 0.06 to 0.14, its load 0 to 0.06; slip at inception 0.8 (f = 0.9), 0.3 (f = 0.5).
/// - Repeated by: `asperity run --set model.kinematics=…`.
pub(crate) mod elastic_strain {
    pub const FRICTION: f64 = 0.65;
    /// In addition.
    pub const STATIC_FRICTION: f64 = 0.2;
    pub const ENERGY: f64 = 0.75;
    pub const ENERGY_EXPONENT: f64 = -2.5;
    pub const AREA_OF_PRESS: f64 = 0.14;
    pub const LOAD_OF_PRESS: f64 = 0.06;
    pub const LIGHT: f64 = 0.1;
    pub const WEAKEST: f64 = 0.3;
}

/// Modelling error where shear localises in the layer of elements under the interface, see
/// `simulate::accuracy::modelling_error`: the body does not harden and is no stronger than the interface.
///
/// - Chosen: bounds, relative to the value, of the change from 10 elements to 30.
/// - Data: carbon steel of EN 1993 on its yield plateau, 0.1 to 1 ω_c: `G` +20 to +49 %, slip at inception +6 to +11 %, `mu_static`
///   +0.1 to +1.6 %, load at most +0.6 %. 4340 steel without hardening at 0.3, 1, 5 and 20 ω_c and 0.3 m/s: `G` +45, +52, +47 and
///   +18 % (20 elements), slip +9, +18, +36 and +19 %, `mu_static` −0.7 to +4.2 %, `mu` −0.7 to +5.0 %, load −3.9 to +0.4 %.
///   Copper with `strength = "current"` at 1 m/s, from 10 elements to 24 (1, 100 ω_c) and 30 (10 ω_c): `mu_static` +21, +14 and
///   +27 %; at 100 and 10 ω_c `mu` +35 and +38 %, load −10 and −7 %, area +7 and +12 %.
/// - Repeated by: `asperity run`.
pub(crate) mod localised_shear {
    pub struct Bounds {
        pub friction: f64,
        pub load: f64,
        pub inception_slip: f64,
        pub energy: f64,
    }
    /// Bounds on a yield plateau.
    pub const ON_PLATEAU: Bounds = Bounds { friction: 0.03, load: 0.02, inception_slip: 0.4, energy: 0.6 };
    /// Bounds of a body that does not harden.
    pub const PERFECTLY_PLASTIC: Bounds = Bounds { friction: 0.1, load: 0.1, ..ON_PLATEAU };
    /// Bounds of an interface that hardens with the body.
    pub const HARDENING_INTERFACE: Bounds = Bounds { friction: 0.4, load: 0.12, ..ON_PLATEAU };
}

/// Modelling error of the coupling of pressure and shear displacements in the press: the press is in full stick on a rigid flat
/// or without friction, whichever is closer to the two bodies, see `simulate::accuracy::modelling_error`.
///
/// - Chosen: change relative to the value, over that of Dundurs' β².
/// - Data: load 0.20 to 0.22 and area 0.29 to 0.34 between full stick at any two of ν = 0 to 0.45, or no friction. Changes of the slip
///   at inception and of `G`, which contains the energy of the shear tractions of the press, from full stick to no friction, relative
///   to full stick, over β², at 0.1, 1 and 10 ω_c (steel of 792 MPa on a rigid flat, 16 elements, 8 angles):
///
///   | f_τ | ν | slip at inception | `G` |
///   |---|---|---|---|
///   | 1 | 0, 0.28, 0.4 | −0.5 to +1.3 | −3.2 to +1.8 |
///   | 0.5, 0.6 | 0, 0.28 | −1.4 to 0.0 | −5.8 to +1.6 |
///   | 0.3 | 0.28 | −2.1 to −0.5 | −8.0 to +3.0 |
///
/// - Residual: the stated errors are 1 to 1.6 times the changes of load and area; those of slip and `G` hold half of the changes.
/// - Repeated by: the ratios of load and area by `asperity verify` (full stick), all by the tests beside the formula; the runs of
///   slip and `G` by `asperity run` with `PressFriction::of` changed.
pub(crate) mod coupling_of_press {
    pub const LOAD: f64 = 0.21;
    pub const AREA: f64 = 0.34;
    pub const INCEPTION_SLIP: f64 = 2.3;
    /// Of an interface as strong as the body; of others over this power of their share of its strength, at least [`WEAKEST`].
    pub const ENERGY: f64 = 3.2;
    pub const ENERGY_EXPONENT: f64 = 2.5;
    pub const WEAKEST: f64 = 0.3;
}

/// Modelling error of the coupling of pressure and shear displacements in the slide, which is that on a rigid flat.
///
/// - Chosen: relative fall of the load during a slide at held interference, over Δβ² (√3τ/σ_Y)² ω_c/ω₀ with the largest mean
///   shear traction τ; of the area a quarter of that at most.
/// - Data: 0.024 at ν = 0.34 and 0.040 at ν = 0.2 (0.1 ω_c), 0.041 (ν = 0.2, 0.3 ω_c), 0.031 (ν = 0.34, 0.01 ω_c).
/// - Repeated by: `asperity run`, whose history has load and area.
pub(crate) mod coupling_of_slide {
    pub const LOAD: f64 = 0.045;
    pub const AREA: f64 = 0.012;
}

/// Modelling error of the counterface, whose compliance is computed as that of a hemisphere and not of a half-space.
///
/// - Chosen: excess over a/R of load and area of an elastic contact, and of the tangential displacement of a contact in full
///   stick, where all compliance is that of the hemisphere.
/// - Data: load 0.62, 0.69, 0.79 and 0.91, area 0.46, 0.49, 0.51 and 0.50, at a/R = 0.041, 0.071, 0.136 and 0.265. Displacement
///   4.8, 3.4 and 2.7 at a/R = 0.005, 0.021 and 0.087 (ν = 0.34).
/// - Residual: in the test beside the formula the friction of a half-space in partial slip is 7 % above that of the run; the
///   stated error is 1 to 1.6 times that.
/// - Repeated by: `asperity run` on a rigid flat, against Hertz and Mindlin.
pub(crate) mod hemisphere {
    pub const LOAD: f64 = 0.9;
    pub const AREA: f64 = 0.5;
    pub const SLIP: f64 = 5.0;
}

/// Modelling error beside a counterface that conducts, see `heat::conduction`: the temperatures of both bodies have mean, slope
/// and curvature in common.
///
/// - Chosen: bounds of the relative change of rises and heat partition to those of temperatures equal at each point; of the mean
///   rise at [`smooth_flux::CONDUCTIVITIES`] and [`smooth_flux::PECLET`], linear in their logarithms.
/// - Data: half-spaces by boundary elements, a disc of uniform frictional heat, k₂/k 0.05 to 20, Va/(2κ₂) 0.5 to 3000, steady and
///   at κt/a² from 0.003, after a slip of a or more, 64 squares along the diameter: highest rise −5.8 to +2.6 %, mean rise 0 to +1.0 %
///   and at most 0.91 of its bound, partition −1.3 to +1.4 %. With the mean in common alone: up to 35, 7 and 6 %.
/// - Repeated by: `examples/peers/sliding_heat.py`.
pub(crate) mod smooth_flux {
    /// k₂/k.
    pub const CONDUCTIVITIES: [f64; 5] = [0.1, 0.3, 1.0, 3.0, 10.0];
    /// Va/(2κ₂).
    pub const PECLET: [f64; 3] = [10.0, 100.0, 1e3];
    /// Bound of the mean rise at each conductivity and each Péclet number.
    pub const MEAN_RISE: [[f64; PECLET.len()]; CONDUCTIVITIES.len()] = [
        [0.0035, 0.0105, 0.012],
        [0.0055, 0.0095, 0.0065],
        [0.004, 0.005, 0.003],
        [0.0025, 0.0025, 0.0015],
        [0.001, 0.001, 0.0005],
    ];
    pub const HIGHEST_RISE: f64 = 0.06;
    pub const PARTITION: f64 = 0.015;
}
