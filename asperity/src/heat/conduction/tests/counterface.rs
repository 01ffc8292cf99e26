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
        conduction.contact_places.iter().map(|&place| conduction.committed[place]).collect()
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
        let rise = |column| conduction.committed[conduction.contact_places[ring * columns + column]];
        [rise(0), rise(columns - 1)]
    };
    let ([down, up], [up_reversed, down_reversed]) = (along_motion(1.0), along_motion(-1.0));
    assert!(down > 1.1 * up, "{down} {up}");
    for (rise, reversed) in [(down, down_reversed), (up, up_reversed)] {
        assert!((rise / reversed - 1.0).abs() < 1e-6, "{rise} {reversed}");
    }
}
