//! The position of the contact edge between two rings of nodes from the pressures and gaps near it, see
//! `interface::contact_edge`.
//!
//! Elastic presses: edges at a of Hertz, moved over more than a ring spacing by the interference on a fixed mesh. Plastic
//! presses and slides: edges on meshes four and three times as fine.

use super::{Fit, FittedConstant, Residual, pressed, rms, through_origin, two_terms};
use crate::interface::contact::Contact;
use crate::interface::contact_edge::{EdgeRatios, shear_number};
use crate::scene::fitted_constants::contact_edge::{EdgeConstants, FITTED};
use crate::scene::{FrictionLaw, Material, Scene};
use crate::simulate::accuracy::resolution::Resolution;
use crate::simulate::{SimulationError, Watch, contact_after_slide};
use crate::studies::verification::setup::{Hertz, mesh, plain_material, preset, scene, steel_4340};

/// Material and ω₀/ω_c.
const SLIDES: [(&str, f64); 5] = [
    ("steel-4340", 2.0),
    ("steel-4340", 10.0),
    ("copper", 5.0),
    ("aluminium-6061", 20.0),
    ("steel-1045", 50.0),
];

/// Slides of light contacts, in which the shear traction at the edge counts.
const LIGHT_SLIDES: [(&str, f64); 5] =
    [("copper", 0.35), ("titanium-6al4v", 0.5), ("steel-4340", 0.7), ("steel-304", 1.2), ("steel-4340", 2.0)];

/// An edge whose position is known, in ring spacings from the last ring in contact.
#[derive(Clone, Copy)]
struct Edge {
    position: f64,
    ratios: EdgeRatios,
}

impl Edge {
    /// Edge of a contact, which is at `radius` at an angle.
    fn at(contact: &Contact, angle: usize, radius: f64) -> Option<Self> {
        let (last, ratios) = contact.last_ring(angle).zip(contact.edge_ratios(angle))?;
        let (inner, next) = (contact.radii[last], contact.radii[last + 1]);
        Some(Self { position: (radius - inner) / (next - inner), ratios })
    }
}

/// Misfit of the ratios y_p and y_g at bluntness 0, rms.
fn misfit(constants: &EdgeConstants, edges: &[Edge]) -> f64 {
    let EdgeConstants {
        first_position, largest_pressure_ratio: [y_1, _], largest_gap_ratio: [y_2, _], ..
    } = *constants;
    let (c_p, c_g) = (constants.pressure_curvature, constants.gap_curvature);
    let misfits = edges.iter().flat_map(|edge| {
        let zeta = (edge.position - first_position).clamp(0.0, 1.0);
        let pressure = y_1 * ((1.0 + c_p) * zeta - c_p * zeta * zeta);
        let gap = y_2 * (1.0 - (1.0 - c_g) * zeta - c_g * zeta * zeta);
        [pressure - edge.ratios.pressure, gap - edge.ratios.gap]
    });
    rms(misfits.collect::<Vec<_>>().into_iter())
}

/// Constants of bluntness 0 for a given x₀: the other four are linear.
fn with_first_position(edges: &[Edge], first: f64) -> EdgeConstants {
    let rows = |of: fn(f64, &Edge) -> [f64; 3]| -> Vec<[f64; 3]> {
        edges.iter().map(|edge| of((edge.position - first).clamp(0.0, 1.0), edge)).collect()
    };
    let [y_1, pressure_term] =
        two_terms(&rows(|zeta, edge| [zeta, zeta - zeta * zeta, edge.ratios.pressure]));
    let [y_2, gap_term] = two_terms(&rows(|zeta, edge| [1.0 - zeta, zeta - zeta * zeta, edge.ratios.gap]));
    EdgeConstants {
        first_position: first,
        largest_pressure_ratio: [y_1, 0.0],
        pressure_curvature: pressure_term / y_1,
        largest_gap_ratio: [y_2, 0.0],
        gap_curvature: gap_term / y_2,
        shear_shift: FITTED.shear_shift,
    }
}

/// Constants of bluntness 0; x₀ by a scan in steps of 0.001.
fn fit_elastic(edges: &[Edge]) -> EdgeConstants {
    let scan = (0..=400).map(|step| with_first_position(edges, -0.5 + 1e-3 * f64::from(step)));
    scan.min_by(|a, b| misfit(a, edges).total_cmp(&misfit(b, edges))).expect("a scan has steps")
}

/// Error of the positions by the constants, rms.
fn error_of_positions(constants: &EdgeConstants, edges: &[Edge]) -> f64 {
    rms(edges.iter().map(|edge| constants.position(&edge.ratios) - edge.position))
}

/// Changes of y_1 and y_2 to bluntness 1 by the smallest error of the positions, in a scan in steps of 0.01.
fn fit_blunt(elastic: &EdgeConstants, edges: &[Edge]) -> EdgeConstants {
    let changes = |k: i32| 0.01 * f64::from(k);
    let scan = (0..=60).flat_map(|pressure| (0..=40).map(move |gap| (changes(pressure), changes(gap))));
    let changed = scan.map(|(pressure, gap)| EdgeConstants {
        largest_pressure_ratio: [elastic.largest_pressure_ratio[0], pressure],
        largest_gap_ratio: [elastic.largest_gap_ratio[0], gap],
        ..*elastic
    });
    let error = |constants: &EdgeConstants| error_of_positions(constants, edges);
    changed.min_by(|a, b| error(a).total_cmp(&error(b))).expect("a scan has steps")
}

/// The shift c_τ by shear, by least squares of the positions.
fn fit_shear(constants: &EdgeConstants, edges: &[Edge]) -> f64 {
    let row = |edge: &Edge| {
        let position = constants.position_without_shear(&edge.ratios);
        [shear_number(&edge.ratios, position), edge.position - position]
    };
    through_origin(&edges.iter().map(row).collect::<Vec<_>>())
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
    const POSITIONS: usize = 10;
    let base = frictionless(plain_material(0.3), 0.3);
    let laid_out = Hertz::of(&base).contact_radius / base.radius;
    let mut edges = Vec::new();
    for elements in [6, 8, 12] {
        for step in 0..POSITIONS {
            let share = 0.4 / elements as f64 * (step as f64 / (POSITIONS - 1) as f64 - 0.5);
            let scene = moved(&base, share);
            let contact = pressed(&scene, laid_out, elements, watch)?;
            edges.extend(Edge::at(&contact, 0, Hertz::of(&scene).contact_radius / scene.radius));
        }
    }
    Ok(edges)
}

/// Edges on 8 elements, known from 32, at three positions.
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
        edges.extend(Edge::at(&pressed(&scene, laid_out, 8, watch)?, 0, known));
    }
    Ok(edges)
}

/// Radius of the edge at each angle, over R.
fn radii_of_edge(contact: &Contact) -> Vec<f64> {
    let radius = |cells: f64| {
        let ring = (cells - 0.5).max(0.0);
        let inner = (ring as usize).min(contact.radii.len() - 2);
        let [near, far] = [contact.radii[inner], contact.radii[inner + 1]];
        near + (ring - inner as f64) * (far - near)
    };
    contact.edges().into_iter().map(radius).collect()
}

/// Edges at all angles after a slide by `slip` contact radii on 8 elements, from those on a finer mesh: the position of an
/// edge is uncertain by a share of the ring spacing, so that its error is of first order.
fn slid(
    (material, interference): (&str, f64),
    slip: f64,
    finer: usize,
    watch: &dyn Watch,
) -> Result<Vec<Edge>, SimulationError> {
    const COARSE: usize = 8;
    let contact = |elements: usize| {
        let mut scene = scene(preset(material), FrictionLaw::ShearStrength, interference, mesh(elements, 4));
        scene.loading.slip_distance = slip;
        contact_after_slide(&scene, 0.0, &Resolution::choose(&scene.numerics), watch)
    };
    let coarse = contact(COARSE)?;
    let share = 1.0 / (finer as f64 / COARSE as f64 - 1.0);
    let pairs = radii_of_edge(&contact(finer)?).into_iter().zip(radii_of_edge(&coarse)).enumerate();
    Ok(pairs
        .filter_map(|(angle, (fine, own))| Edge::at(&coarse, angle, fine + share * (fine - own)))
        .collect())
}

/// Edges with the name of what they are of.
type Group = (String, Vec<Edge>);

fn edges(group: &[Group]) -> Vec<Edge> {
    group.iter().flat_map(|(_, edges)| edges).copied().collect()
}

/// Edges of plastic presses and slides.
fn blunt_edges(watch: &dyn Watch) -> Result<Vec<Group>, SimulationError> {
    let mut groups = Vec::new();
    for (name, material) in [("without hardening", plain_material(0.3)), ("of 4340 steel", steel_4340())] {
        for interference in [5.0, 50.0] {
            let edges = plastic(&material, interference, watch)?;
            groups.push((format!("press {name}, {interference} omega_c"), edges));
        }
    }
    groups.extend(slides(&SLIDES, 1.0, 24, watch)?);
    Ok(groups)
}

fn slides(
    list: &[(&str, f64)],
    slip: f64,
    finer: usize,
    watch: &dyn Watch,
) -> Result<Vec<Group>, SimulationError> {
    let name = |(name, interference): (&str, f64)| format!("slide of {name}, {interference} omega_c");
    list.iter().map(|&slide| Ok((name(slide), slid(slide, slip, finer, watch)?))).collect()
}

pub(super) fn fit(watch: &dyn Watch) -> Result<Fit, SimulationError> {
    let elastic = elastic(watch)?;
    let mut groups = blunt_edges(watch)?;
    let light = slides(&LIGHT_SLIDES, 0.15, 32, watch)?;
    let (blunt, sheared) = (edges(&groups), edges(&light));
    let of_elastic = fit_elastic(&elastic);
    let mut fitted = fit_blunt(&of_elastic, &blunt);
    fitted.shear_shift = fit_shear(&fitted, &sheared);
    let constant = |name, of: fn(&EdgeConstants) -> f64| FittedConstant {
        name,
        stored: of(&FITTED),
        fitted: of(&fitted),
    };
    let constants = vec![
        constant("FIRST_POSITION", |c| c.first_position),
        constant("LARGEST_PRESSURE_RATIO", |c| c.largest_pressure_ratio[0]),
        constant("LARGEST_PRESSURE_RATIO, change", |c| c.largest_pressure_ratio[1]),
        constant("LARGEST_GAP_RATIO", |c| c.largest_gap_ratio[0]),
        constant("LARGEST_GAP_RATIO, change", |c| c.largest_gap_ratio[1]),
        constant("PRESSURE_CURVATURE", |c| c.pressure_curvature),
        constant("GAP_CURVATURE", |c| c.gap_curvature),
        constant("SHEAR_SHIFT", |c| c.shear_shift),
    ];
    let mut residuals = vec![Residual {
        of: "ratios of pressures and gaps, elastic".to_owned(),
        points: 2 * elastic.len(),
        stored: misfit(&FITTED, &elastic),
        fitted: misfit(&fitted, &elastic),
    }];
    groups.insert(0, ("elastic press".to_owned(), elastic));
    groups.extend(light);
    residuals.extend(groups.into_iter().map(|(name, edges)| Residual {
        of: format!("position in ring spacings, {name}"),
        points: edges.len(),
        stored: error_of_positions(&FITTED, &edges),
        fitted: error_of_positions(&fitted, &edges),
    }));
    Ok(Fit {
        name: "Contact edge",
        method: "Bluntness 0: least squares of the ratios of pressures and gaps of elastic presses on 6, 8 and 12 elements, \
                 whose edges are Hertz's. Changes to bluntness 1: least squares of the positions of edges of plastic presses \
                 on 8 elements against 32 and of slides on 8 against 24. SHEAR_SHIFT: least squares of the positions of edges \
                 of slides of light contacts on 8 elements against 32.",
        constants,
        residuals,
    })
}
