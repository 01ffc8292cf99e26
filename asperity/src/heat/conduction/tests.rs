//! Conduction against closed forms, and its heat balance with steep heat flows and properties.

use super::*;
use crate::discretisation::collocation::Collocation;
use crate::discretisation::mesh::{MeridianMesh, MeshSize};
use crate::scene::curve::Curve;

mod counterface;

/// Of the contact, in units of R.
const RADIUS: f64 = 0.01;

fn mesh(elements_per_radius: usize, sectors: Collocation) -> RevolvedMesh {
    RevolvedMesh::new(MeridianMesh::new(MeshSize::new(RADIUS, elements_per_radius)), sectors)
}

/// Flux over the contact.
struct Uniform {
    areas: Vec<f64>,
    radii: Vec<f64>,
    columns: usize,
    flux: f64,
}

impl Uniform {
    fn new(mesh: &RevolvedMesh) -> Self {
        let (areas, radii) = (mesh.contact_areas(), mesh.meridian.contact_radii());
        Self { areas, radii, columns: mesh.sectors.columns(), flux: 1.0 }
    }

    /// The heated disc ends between two rings: its radius from its discrete area.
    fn disc_radius(&self) -> f64 {
        let total: f64 = (0..self.areas.len()).map(|i| self.flow(i, 0.0).0).sum();
        (2.0 * total / self.flux / std::f64::consts::PI).sqrt()
    }
}

impl ContactHeat for Uniform {
    fn flow(&self, point: usize, _rise: f64) -> (f64, f64) {
        let inside = self.radii[point / self.columns] < RADIUS;
        (if inside { self.flux * self.areas[point] } else { 0.0 }, 0.0)
    }
}

/// A step without heat given to the body.
fn step(conduction: &mut Conduction, dt: f64, heat: &dyn ContactHeat) -> HeatBalance {
    let none = vec![0.0; conduction.body_length()];
    let (_, balance) = conduction.advance(dt, &none, heat).unwrap();
    conduction.commit();
    balance
}

/// Uniform flux over a disc on a half space (Carslaw & Jaeger, 2nd ed., §10.5): centre
/// temperature T = (2q√(αt)/k)[1/√π − ierfc(a/(2√(αt)))].
const DISC: [(f64, f64); 4] = [(0.1, 0.352882), (1.0, 0.729097), (2.0, 0.804583), (10.0, 0.911164)];

/// Heats a disc with a flux q·a/k₀ of 1 K and compares its centre with `expected`, a function of the
/// linear solution; the heat balance closes to `closure`.
fn disc_source(
    sectors: Collocation,
    properties: Option<ThermalProperties>,
    expected: impl Fn(f64) -> f64,
    closure: f64,
) {
    let mesh = mesh(16, sectors);
    let mut source = Uniform::new(&mesh);
    let a = source.disc_radius();
    source.flux = 1.0 / a;
    let mut conduction = Conduction::new(&mesh, 1.0, 1).unwrap().with_properties(properties);
    let (mut t, mut dt) = (0.0, 1e-4 * a * a);
    let (mut given, mut lost) = (0.0, 0.0);
    let mut checks = DISC.into_iter();
    let mut next = checks.next();
    while let Some((fourier, linear)) = next {
        let end = fourier * a * a;
        let length = if t + 1.01 * dt > end { end - t } else { dt };
        let balance = step(&mut conduction, length, &source);
        given += balance.contact;
        lost += balance.base;
        t += length;
        dt *= 1.15;
        if t >= end * (1.0 - 1e-12) {
            let centre = conduction.committed.rise[conduction.contact_indices[0]];
            let exact = expected(linear);
            assert!((centre / exact - 1.0).abs() < 0.01, "Fo = {fourier}: {centre} {exact}");
            next = checks.next();
        }
    }
    let stored = conduction.stored();
    assert!((given - stored - lost).abs() < closure * given, "{given} {stored} {lost}");
}

#[test]
fn disc_source_follows_carslaw_and_jaeger() {
    for sectors in [Collocation::axisymmetric(), Collocation::full(4)] {
        disc_source(sectors, None, |linear| linear, 1e-9);
    }
}

/// 1 + θ up to 10 K: doubles over the rise of 1 K in the tests.
fn growing() -> Curve {
    Curve::new(vec![0.0, 10.0], vec![1.0, 11.0])
}

/// k and c that vary alike, so that the diffusivity is constant: Kirchhoff's Θ = θ + θ²/2 obeys the
/// linear equation (Carslaw & Jaeger, 2nd ed., §2.16), hence θ = √(1 + 2Θ) − 1.
#[test]
fn constant_diffusivity_follows_kirchhoff_and_carslaw_and_jaeger() {
    for sectors in [Collocation::axisymmetric(), Collocation::full(4)] {
        let properties = ThermalProperties::new(&growing(), &growing());
        disc_source(sectors, Some(properties), |linear| (1.0 + 2.0 * linear).sqrt() - 1.0, 1e-10);
    }
}

/// Constant properties given as tables are solved by the minimisation, with the same temperatures.
#[test]
fn constant_tables_agree_with_constant_properties() {
    let (mesh, heat) = (small_mesh(), |mesh: &RevolvedMesh| Softening::new(mesh, 1.0, 3.0));
    let steady = ThermalProperties::constant();
    let [plain, tables] = [None, Some(steady)].map(|properties| {
        let mut conduction = Conduction::new(&mesh, 1.0, 1).unwrap().with_properties(properties);
        march(&mut conduction, &heat(&mesh), 1e-6, 20);
        conduction.committed.rise
    });
    let largest = plain.iter().fold(0.0f64, |m, t| m.max(*t));
    assert!(largest > 0.1);
    for (a, b) in plain.iter().zip(&tables) {
        assert!((a - b).abs() < 1e-9 * largest, "{a} {b}");
    }
}

fn small_mesh() -> RevolvedMesh {
    mesh(6, Collocation::full(4))
}

/// Frictional heat with the softening factor 1 − rise^m, over part of the contact and not uniform in the
/// angle, less the heat that the gap conducts to the flat.
struct Softening<'a> {
    areas: Vec<f64>,
    strength: Box<dyn Fn(f64) -> f64 + 'a>,
    flux: f64,
    gap: f64,
    columns: usize,
}

impl<'a> Softening<'a> {
    fn new(mesh: &RevolvedMesh, exponent: f64, flux: f64) -> Self {
        let strength = move |rise: f64| 1.0 - rise.clamp(0.0, 1.0).powf(exponent);
        Self {
            areas: mesh.contact_areas(),
            strength: Box::new(strength),
            flux: flux / RADIUS,
            gap: 0.0,
            columns: mesh.sectors.columns(),
        }
    }

    fn power(&self, point: usize) -> f64 {
        let (ring, column) = (point / self.columns, point % self.columns);
        if ring > 9 { 0.0 } else { self.flux * self.areas[point] * (1.0 + 0.3 * column as f64) }
    }
}

impl ContactHeat for Softening<'_> {
    // The slope by central differences, as in the frictional heat of the slide.
    fn flow(&self, point: usize, rise: f64) -> (f64, f64) {
        let (power, gap, h) = (self.power(point), self.gap * self.areas[point], 1e-5);
        let slope = ((self.strength)(rise + h) - (self.strength)(rise - h)) / (2.0 * h);
        (power * (self.strength)(rise) - gap * rise, power * slope.min(0.0) - gap)
    }

    fn loss(&self, point: usize, rise: f64) -> f64 {
        self.gap * self.areas[point] * rise
    }
}

/// Steps from `dt` on, each twice the one before; returns the error of the heat balance over the heat
/// input. The heat flows of the balance are evaluated at the computed temperatures, so that the balance closes
/// only if these solve the nonlinear equations.
fn march(conduction: &mut Conduction, heat: &dyn ContactHeat, mut dt: f64, steps: usize) -> f64 {
    let (mut given, mut lost) = (0.0, 0.0);
    for n in 0..steps {
        let balance = step(conduction, dt, heat);
        assert!(conduction.committed.rise.iter().all(|t| t.is_finite()), "step {n}");
        given += balance.contact;
        lost += balance.base + balance.gap;
        dt *= 2.0;
    }
    (given - lost - conduction.stored()).abs() / given
}

/// Johnson–Cook exponents below one (infinite slope where softening begins), near a step, and so
/// much power that the contact is at the melting point.
#[test]
fn steep_softening_is_solved() {
    for exponent in [0.2, 0.5, 0.8, 1.0, 4.0, 40.0] {
        for flux in [1e-6, 0.1, 10.0, 1e4] {
            let mesh = small_mesh();
            let mut conduction = Conduction::new(&mesh, 1.0, 1).unwrap();
            let off = march(&mut conduction, &Softening::new(&mesh, exponent, flux), 1e-7, 24);
            // The temperatures have a tolerance of 1e-11, which the slope of the heat flow multiplies.
            assert!(off < 1e-10 * (exponent * flux).max(1.0), "exponent {exponent}, flux {flux}: {off:e}");
            let hottest = conduction.committed.rise.iter().fold(0.0f64, |m, t| m.max(*t));
            // Friction alone does not heat beyond the melting point.
            assert!(hottest > 0.0 && hottest <= 1.0 + 1e-9, "exponent {exponent}, flux {flux}: {hottest}");
        }
    }
}

/// Tabulated strength with kinks and a plateau.
#[test]
fn kinks_of_tabulated_softening_are_solved() {
    let (knots, factors) = ([0.0, 0.1, 0.1001, 0.5, 0.7], [1.0, 1.0, 0.6, 0.55, 0.0]);
    for flux in [0.05, 0.3, 1.0, 10.0, 1e4] {
        let mesh = small_mesh();
        let mut heat = Softening::new(&mesh, 1.0, flux);
        heat.strength = Box::new(move |rise| tables::functions::interpolate(&knots, &factors, rise).0);
        let mut conduction = Conduction::new(&mesh, 1.0, 1).unwrap();
        let off = march(&mut conduction, &heat, 1e-7, 24);
        assert!(off < 1e-10 * flux.max(1.0), "flux {flux}: {off:e}");
    }
}

/// Carbon steel of EN 1993-1-2 (peak of c at 735 °C, jumps of c and k) and a jump of c by ten, the
/// latter as a latent heat: the balance closes to 1e-10.
#[test]
fn heat_balance_closes_across_peaks_and_jumps() {
    let steel = crate::scene::presets::tests::carbon_steel();
    let (c, k) = (steel.specific_heat.table.unwrap(), steel.thermal_conductivity.table.unwrap());
    let en = ThermalProperties::new(&c.relative(293.15), &k.relative(293.15));
    let jump = ThermalProperties::new(
        &Curve::new(vec![0.0, 400.0, 400.0, 410.0, 410.0], vec![1.0, 1.0, 50.0, 50.0, 2.0]),
        &Curve::new(vec![0.0, 400.0, 400.0], vec![1.0, 0.4, 2.0]),
    );
    for properties in [en, jump] {
        for (gap, flux) in [(0.0, 3000.0), (30.0, 3000.0), (0.0, 1e7)] {
            let mesh = small_mesh();
            // Softens over 1500 K.
            let mut heat = Softening::new(&mesh, 1.0, flux);
            heat.strength = Box::new(|rise: f64| 1.0 - (rise / 1500.0).clamp(0.0, 1.0).powf(0.8));
            heat.gap = gap;
            let mut conduction =
                Conduction::new(&mesh, 2.0, 1).unwrap().with_properties(Some(properties.clone()));
            let off = march(&mut conduction, &heat, 1e-7, 24);
            assert!(off < 1e-10, "gap {gap}, flux {flux}: {off:e}");
            let hottest = conduction.committed.rise.iter().fold(0.0f64, |m, t| m.max(*t));
            assert!(hottest > 500.0, "{hottest}");
        }
    }
}

/// Volume heating over a time too short for conduction: each point stores the heat supplied to it,
/// θ = H⁻¹(heat), across the peak of c in EN 1993-1-2 in steps of hundreds of kelvin.
#[test]
fn volume_heating_follows_the_enthalpy() {
    let steel = crate::scene::presets::tests::carbon_steel().specific_heat.table.unwrap();
    let specific_heat = steel.relative(293.15);
    let properties = ThermalProperties::new(&specific_heat, &Curve::constant(1.0));
    let mesh = small_mesh();
    let mut conduction = Conduction::new(&mesh, 1.0, 1).unwrap().with_properties(Some(properties));
    let none = Softening::new(&mesh, 1.0, 0.0);
    for step in 1..=5 {
        let body: Vec<f64> = conduction.heat_capacities.iter().map(|capacity| 400.0 * capacity).collect();
        let (_, balance) = conduction.advance(1e-9, &body, &none).unwrap();
        conduction.commit();
        assert_eq!(balance.contact, 0.0);
        let apex = conduction.committed.rise[conduction.contact_indices[0]];
        let exact = specific_heat.inverse_integral(400.0 * step as f64);
        assert!((apex - exact).abs() < 1e-6 * exact, "{apex} {exact}");
    }
}

/// Steady state of an isothermal disc on a half space, Q = 4kaθ (Carslaw & Jaeger, 2nd ed., §8.2),
/// with θ replaced by Θ where the conductivity varies, whatever the specific heat: the disc is held
/// at 1 K by a large conductance to a flat at 1 K.
#[test]
fn isothermal_disc_conducts_four_k_a() {
    struct Held(Uniform);
    impl ContactHeat for Held {
        fn flow(&self, point: usize, rise: f64) -> (f64, f64) {
            let conductance = 1e5 * self.0.flow(point, 0.0).0;
            (conductance * (1.0 - rise), -conductance)
        }
    }
    let varying = ThermalProperties::new(&Curve::constant(3.0), &growing());
    for (properties, potential) in [(None, 1.0), (Some(varying), 1.5)] {
        let mesh = mesh(16, Collocation::axisymmetric());
        let held = Held(Uniform::new(&mesh));
        let mut conduction = Conduction::new(&mesh, 1.0, 1).unwrap().with_properties(properties);
        let mut flow = 0.0;
        for _ in 0..12 {
            // L-stable: steps far longer than the diffusion time of the body end in its steady state.
            flow = step(&mut conduction, 1e4, &held).base / 1e4;
        }
        // Half a disc; the body is a hemisphere 100 times as large, which conducts 1 % better.
        let exact = 0.5 * 4.0 * held.0.disc_radius() * potential;
        assert!((flow / exact - 1.0).abs() < 0.03, "{flow} {exact}");
    }
}

/// Over a time, in twenty increments.
fn heat_for(conduction: &mut Conduction, heat: &dyn ContactHeat, time: f64) {
    for _ in 0..20 {
        step(conduction, time / 20.0, heat);
    }
}

/// Over layers much thinner than the rings, the first heat of a disc leaves no point outside it colder than before, and the
/// rise inside is that of a plane under a constant flux, 2q√(κt/π)/k, without a peak at the rim.
#[test]
fn thin_layers_have_no_temperatures_outside_those_around() {
    let mesh = mesh(8, Collocation::full(4));
    let source = Uniform::new(&mesh);
    let mut conduction = Conduction::new(&mesh, 1.0, 8).unwrap();
    let depth = 0.01 * RADIUS;
    heat_for(&mut conduction, &source, depth * depth);
    let exact = 2.0 * depth / std::f64::consts::PI.sqrt();
    let least = conduction.committed.rise.iter().fold(0.0, |least: f64, rise| least.min(*rise));
    assert!(least > -1e-6 * exact, "{least} of {exact}");
    for (ring, &radius) in source.radii.iter().enumerate() {
        let rise = conduction.committed.rise[conduction.contact_indices[ring * source.columns]] / exact;
        if radius < RADIUS {
            assert!((rise - 1.0).abs() < 0.05, "{radius}: {rise}");
        } else {
            assert!(rise < 0.1, "{radius}: {rise}");
        }
    }
}
