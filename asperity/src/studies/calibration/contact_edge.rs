//! The place of the contact edge between two rings of nodes from the pressures and gaps near it, see
//! `interface::contact_edge`.
//!
//! Elastic presses: edges at a of Hertz, moved over more than a ring spacing by the interference on a fixed mesh; the
//! constants of bluntness 0 are fitted anew, in ring spacings t from where the last ring touches,
//! ρ = F((1 + p)t − pt²), γ = G(1 − (1 − q)t − qt²). Plastic presses: edges on meshes four times as fine; the residual
//! of the stored constants.

use super::{Fit, FittedConstant, Residual, pressed, rms, two_terms};
use crate::interface::contact::{Contact, Status};
use crate::interface::contact_edge::place;
use crate::scene::fitted_constants::contact_edge::{
    FIRST_PLACE, FULL_LOAD, GAP_CURVATURE, LOAD_CURVATURE, OPEN_GAP,
};
use crate::scene::fitted_constants::error_estimates::EDGE_OF_SPACING;
use crate::scene::{FrictionLaw, Material, Scene};
use crate::simulate::{SimulationError, Watch};
use crate::studies::verification::setup::{Hertz, mesh, plain_material, scene, steel_4340};

/// An edge whose place is known.
#[derive(Clone, Copy)]
struct Edge {
    /// In ring spacings from the last ring in contact.
    place: f64,
    /// Pressure of that ring over the one inside it.
    load: f64,
    /// Gap of the next ring over the rise from there to the one beyond.
    gap: f64,
}

impl Edge {
    /// Of an axisymmetric contact whose edge is at `radius`.
    fn of(contact: &Contact, radius: f64) -> Option<Self> {
        let (radii, state) = (&contact.radii, &contact.committed);
        let last = (0..radii.len()).rev().find(|&ring| state.status[ring] != Status::Open)?;
        if last == 0 || last + 2 >= radii.len() {
            return None;
        }
        let spacing = radii[last + 1] - radii[last];
        let (gap, beyond) = (state.gap[last + 1], state.gap[last + 2]);
        Some(Self {
            place: (radius - radii[last]) / spacing,
            load: (state.pressure[last] / state.pressure[last - 1]).min(1.0),
            gap: (gap / (beyond - gap) * (radii[last + 2] - radii[last + 1]) / spacing).clamp(0.0, 1.0),
        })
    }

    /// Place as found less place as known.
    fn error(&self) -> f64 {
        place(self.load, self.gap) - self.place
    }
}

/// Constants of bluntness 0: first place, full load, load curvature, open gap, gap curvature.
struct Elastic {
    constants: [f64; 5],
    /// Sum of the squares of the misfits of ρ and γ.
    misfit: f64,
}

impl Elastic {
    /// Linear in the other four for a given first place.
    fn with_first_place(edges: &[Edge], first: f64) -> Self {
        let inside = |edge: &&Edge| (0.0..=1.0).contains(&(edge.place - first));
        let rows = |of: fn(f64, &Edge) -> [f64; 3]| -> Vec<[f64; 3]> {
            edges.iter().filter(inside).map(|edge| of(edge.place - first, edge)).collect()
        };
        let loads = rows(|t, edge| [t, t - t * t, edge.load]);
        let gaps = rows(|t, edge| [1.0 - t, t - t * t, edge.gap]);
        let ([full, bent], [open, bent_gap]) = (two_terms(&loads), two_terms(&gaps));
        let squares = |rows: &[[f64; 3]], a: f64, b: f64| -> f64 {
            rows.iter().map(|r| (a * r[0] + b * r[1] - r[2]).powi(2)).sum()
        };
        Self {
            constants: [first, full, bent / full, open, bent_gap / open],
            misfit: squares(&loads, full, bent) + squares(&gaps, open, bent_gap),
        }
    }

    /// The best first place of a scan in steps of 0.001.
    fn fitted(edges: &[Edge]) -> Self {
        let scan = (0..=400).map(|step| Self::with_first_place(edges, -0.7 + 1e-3 * f64::from(step)));
        scan.min_by(|a, b| a.misfit.total_cmp(&b.misfit)).expect("a scan has steps")
    }

    /// Misfit of ρ and γ by the stored constants and these, rms.
    fn residual(&self, edges: &[Edge], constants: [f64; 5]) -> f64 {
        let [first, full, p, open, q] = constants;
        let misfits = edges.iter().flat_map(|edge| {
            let t = (edge.place - first).clamp(0.0, 1.0);
            let load = full * ((1.0 + p) * t - p * t * t);
            let gap = open * (1.0 - (1.0 - q) * t - q * t * t);
            [load - edge.load, gap - edge.gap]
        });
        rms(misfits.collect::<Vec<_>>().into_iter())
    }
}

/// The scene with its contact radius changed by `share`, if it goes with √ω.
fn moved(scene: &Scene, share: f64) -> Scene {
    let mut scene = scene.clone();
    scene.loading.interference *= (1.0 + share) * (1.0 + share);
    scene
}

fn frictionless(material: Material, interference: f64) -> Scene {
    scene(material, FrictionLaw::Frictionless, interference, mesh(8, 4))
}

/// Edges of Hertz on 6, 8 and 12 elements, over 1.2 ring spacings of a/(3 n_c).
fn elastic(watch: &dyn Watch) -> Result<Vec<Edge>, SimulationError> {
    const PLACES: usize = 10;
    let base = frictionless(plain_material(0.3), 0.3);
    let laid_out = Hertz::of(&base).contact_radius / base.radius;
    let mut edges = Vec::new();
    for elements in [6, 8, 12] {
        for step in 0..PLACES {
            let share = 0.4 / elements as f64 * (step as f64 / (PLACES - 1) as f64 - 0.5);
            let scene = moved(&base, share);
            let contact = pressed(&scene, laid_out, elements, watch)?;
            edges.extend(Edge::of(&contact, Hertz::of(&scene).contact_radius / scene.radius));
        }
    }
    Ok(edges)
}

/// Edges on 8 elements, known from 32, at three places.
fn plastic(material: &Material, interference: f64, watch: &dyn Watch) -> Result<Vec<Edge>, SimulationError> {
    let base = frictionless(material.clone(), interference);
    let radius = |contact: &Contact| contact.radius(&contact.committed);
    let expected = Hertz::of(&base).contact_radius / base.radius;
    // Once more on a mesh laid out for the radius that is reached.
    let laid_out = radius(&pressed(&base, 1.3 * expected, 8, watch)?);
    let mut edges = Vec::new();
    for share in [-0.012, 0.0, 0.012] {
        let scene = moved(&base, share);
        let known = radius(&pressed(&scene, laid_out, 32, watch)?);
        edges.extend(Edge::of(&pressed(&scene, laid_out, 8, watch)?, known));
    }
    Ok(edges)
}

pub(super) fn fit(watch: &dyn Watch) -> Result<Fit, SimulationError> {
    let edges = elastic(watch)?;
    let elastic = Elastic::fitted(&edges);
    let stored =
        [FIRST_PLACE, FULL_LOAD, LOAD_CURVATURE, OPEN_GAP, GAP_CURVATURE].map(|constant| constant[0]);
    let names = ["FIRST_PLACE", "FULL_LOAD", "LOAD_CURVATURE", "OPEN_GAP", "GAP_CURVATURE"];
    let mut constants: Vec<FittedConstant> = (0..names.len())
        .map(|k| FittedConstant { name: names[k], stored: stored[k], fitted: elastic.constants[k] })
        .collect();
    let of_place = |of: String, edges: &[Edge]| Residual {
        of,
        points: edges.len(),
        stored: rms(edges.iter().map(Edge::error)),
        fitted: None,
    };
    let mut residuals = vec![
        Residual {
            of: "ratios of pressures and gaps, elastic".to_owned(),
            points: 2 * edges.len(),
            stored: elastic.residual(&edges, stored),
            fitted: Some(elastic.residual(&edges, elastic.constants)),
        },
        of_place("place in ring spacings, elastic".to_owned(), &edges),
    ];
    let mut all = edges;
    for (name, material) in [("no hardening", plain_material(0.3)), ("4340 steel", steel_4340())] {
        for interference in [5.0, 50.0] {
            let edges = plastic(&material, interference, watch)?;
            residuals
                .push(of_place(format!("place in ring spacings, {name}, {interference} omega_c"), &edges));
            all.extend(edges);
        }
    }
    let fitted = rms(all.iter().map(Edge::error));
    constants.push(FittedConstant { name: "EDGE_OF_SPACING", stored: EDGE_OF_SPACING, fitted });
    Ok(Fit {
        name: "Contact edge",
        method: "Least squares of the ratios of pressures and gaps of elastic presses on 6, 8 and 12 elements, whose edges \
                 are Hertz's; places of plastic edges on 8 elements against 32. EDGE_OF_SPACING against the rms error of \
                 all places.",
        constants,
        residuals,
    })
}
