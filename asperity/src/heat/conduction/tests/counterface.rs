//! Conduction beside a counterface that takes up heat.

use super::*;

/// Friction in the outer part of a contact, and the counterface of the whole.
struct Rim {
    contact: Uniform,
    /// Radius inside which nothing is heated.
    inner: f64,
    /// Of the counterface in a step.
    slip: f64,
}

impl ContactHeat for Rim {
    fn flow(&self, point: usize, rise: f64) -> (f64, f64) {
        let slips = self.contact.radii[point / self.contact.columns] > self.inner;
        if slips { self.contact.flow(point, rise) } else { (0.0, 0.0) }
    }

    fn area(&self, point: usize) -> f64 {
        self.contact.flow(point, 0.0).0 / self.contact.flux
    }

    fn slip(&self) -> f64 {
        self.slip
    }
}

/// Before heat spreads along the surface a counterface takes up the share e₂/(e + e₂) of it where it is generated; the middle
/// of the contact stays cold.
#[test]
fn a_counterface_takes_up_heat_where_it_is_generated() {
    let mesh = mesh(8, Collocation::full(4));
    let rises = |counterface: Option<HalfSpace>, flux: f64| -> Vec<f64> {
        let contact = Uniform { flux, ..Uniform::new(&mesh) };
        let heat = Rim { contact, inner: 0.6 * RADIUS, slip: 0.0 };
        let mut conduction = Conduction::new(&mesh, 1.0, 8).unwrap().with_counterface(counterface);
        heat_for(&mut conduction, &heat, (0.01 * RADIUS).powi(2));
        conduction.contact_indices.iter().map(|&index| conduction.committed.rise[index]).collect()
    };
    for effusivity in [1.0, 9.0, 200.0] {
        let left = 1.0 / (1.0 + effusivity);
        let (beside, alone) = (rises(Some(HalfSpace::new(1.0, effusivity)), 1.0), rises(None, left));
        let most = alone.iter().fold(0.0, |most: f64, rise| most.max(*rise));
        for (beside, alone) in beside.iter().zip(&alone) {
            assert!((beside - alone).abs() < 0.05 * most, "{effusivity}: {beside:e} {alone:e}");
        }
    }
}

/// A like counterface carries the heat along: both bodies are hotter downstream, in either direction of motion.
#[test]
fn a_moving_counterface_makes_the_asperity_hotter_downstream() {
    let mesh = mesh(8, Collocation::full(8));
    // Pe = 5 to Fo = 1.
    let along_motion = |direction: f64| -> [f64; 2] {
        let slip = direction * 10.0 * RADIUS / 20.0;
        let heat = Rim { contact: Uniform::new(&mesh), inner: 0.0, slip };
        let half_space = HalfSpace::new(1.0, 1.0);
        let mut conduction = Conduction::new(&mesh, 1.0, 1).unwrap().with_counterface(Some(half_space));
        heat_for(&mut conduction, &heat, RADIUS * RADIUS);
        let ring = mesh.meridian.contact_radii().iter().rposition(|&radius| radius < 0.8 * RADIUS).unwrap();
        let columns = mesh.sectors.columns();
        let rise = |column| conduction.committed.rise[conduction.contact_indices[ring * columns + column]];
        [rise(0), rise(columns - 1)]
    };
    let ([down, up], [up_reversed, down_reversed]) = (along_motion(1.0), along_motion(-1.0));
    assert!(down > 1.1 * up, "{down} {up}");
    for (rise, reversed) in [(down, down_reversed), (up, up_reversed)] {
        assert!((rise / reversed - 1.0).abs() < 1e-6, "{rise} {reversed}");
    }
}

/// Like bodies at rest share the heat equally, whatever their properties. With k or c 1.9 times as large in the contact, the rise
/// beside a counterface that varies in the same way is closer to that under half of the flux than beside one of constant
/// properties: by ten times for k, twice for c.
#[test]
fn like_bodies_with_varying_properties_share_the_heat() {
    let mesh = mesh(8, Collocation::full(4));
    let time = (0.05 * RADIUS).powi(2);
    // A rise of 1 K at constant properties.
    let flux = 0.5 * std::f64::consts::PI.sqrt() / (0.05 * RADIUS);
    let rises = |properties: &ThermalProperties, counterface: Option<HalfSpace>, flux: f64| -> f64 {
        let contact = Uniform { flux, ..Uniform::new(&mesh) };
        let heat = Rim { contact, inner: -1.0, slip: 0.0 };
        let mut conduction = Conduction::new(&mesh, 1.0, 8)
            .unwrap()
            .with_properties(Some(properties.clone()))
            .with_counterface(counterface);
        heat_for(&mut conduction, &heat, time);
        conduction.committed.rise[conduction.contact_indices[0]]
    };
    let constant = || Curve::constant(1.0);
    for (specific_heat, conductivity, closer) in
        [(constant(), growing(), 10.0), (growing(), constant(), 2.0), (growing(), growing(), 10.0)]
    {
        let properties = ThermalProperties::new(&specific_heat, &conductivity);
        let alone = rises(&properties, None, flux);
        let [like, unlike] = [Some(properties.clone()), None].map(|varying| {
            let half_space = HalfSpace::new(1.0, 1.0).with_properties(varying);
            (rises(&properties, Some(half_space), 2.0 * flux) / alone - 1.0).abs()
        });
        assert!(closer * like < unlike, "{alone}: {like} {unlike}");
    }
}
