//! A counterface that conducts heat or is elastic.
//!
//! Half-spaces alone are in [`super::half_space`]. Steady sliding of two bodies: boundary elements, `examples/peers/sliding_heat.py`.

use std::f64::consts::PI;

use tables::closed_forms::hertz;
use tables::quantity::{Estimate, Quantity};

use super::half_space;
use super::heat_source::{START, slide_beside};
use super::setup::{
    Hertz, last, mesh, over, plain_material, pressed, run_press, scene, shear_strength, slide_at_small_strain,
};
use super::{Case, Cost, Reference, Row, Rows, Tolerance};
use crate::scene::{Counterface, FrictionLaw, Scene, Switch};
use crate::simulate::{Watch, derived, simulate};

const GAP: &str = "Carslaw & Jaeger 1959, sec. 10.5, and Volterra's equation for the flow through the gap";
const DIVIDED: &str = "rises of half-spaces of one diffusivity, in proportion to 1/k";
const SPHERE: &str = "Neumann function of the sphere, Dassios & Sten 2012, in the mean over a disc";

pub const CASES: [Case; 7] = [
    Case::new("half-space under a disc source", Cost::Quick, |_| Ok(half_space::constant())),
    Case::new("half-space with properties over temperature", Cost::Quick, |_| Ok(half_space::varying())),
    Case::new("bodies at rest", Cost::Quick, at_rest),
    Case::new("constriction of the asperity", Cost::Quick, constricted),
    Case::new("elastic counterface", Cost::Quick, elastic),
    Case::new("moving counterface", Cost::Medium, moving),
    Case::new("expanding counterface", Cost::Quick, expanding),
];

/// Bodies of one diffusivity in contact at rest divide the heat as their conductivities at any time; with a resistance between
/// them by Volterra's equation for the flow through it, with the mean rise of a disc source as its kernel.
fn at_rest(watch: &dyn Watch) -> Rows {
    const WHY: &str = "mesh, 0.5 n_c^-1.5, of the rise of one body";
    let mut rows = Vec::new();
    for (ratio, fourier) in [(1.0, 10.0), (4.0, 10.0), (4.0, 1e6)] {
        let heated = slide_beside(&|scene| conducting(scene, ratio), (1.0, fourier, false), 8, watch)?;
        let share = 1.0 / (1.0 + ratio);
        let end = last(&heated.outcome);
        let name = |what: &str| format!("{what} beside a body at rest, k2 = {ratio} k, Fo = {fourier}");
        let reference = Reference::exact(share, DIVIDED);
        let tolerance = Tolerance::relative(0.022 * (1.0 - share), WHY);
        let found = heated.outcome.scalars[Quantity::HeatPartition];
        rows.push(Row::new(name("heat partition"), found, reference, tolerance));
        // At last heat reaches the base, which a half-space does not have.
        if fourier > 10.0 {
            continue;
        }
        let rise = (end[Quantity::TemperatureMean] - START) / heated.rise;
        // The late start of the heat, as in the rows of the disc source.
        let reference = Reference::exact(share * 0.760354, half_space::AT_REST).known_to(0.0015);
        let tolerance = Tolerance::relative(0.022 * share + 0.0015, WHY);
        rows.push(Row::new(name("mean rise over qa/k"), rise, reference, tolerance));
    }
    // All of the heat is released on the asperity's side of a gap of the conductance k/a.
    let with_gap = |scene: &Scene| Counterface {
        contact_conductance: scene.material.thermal_conductivity.value / Hertz::of(scene).contact_radius,
        ..conducting(scene, 4.0)
    };
    let heated = slide_beside(&with_gap, (1.0, 10.0, false), 8, watch)?;
    let end = last(&heated.outcome);
    let name = |what: &str| format!("{what} beside a body at rest, k2 = 4 k, conductance k/a, Fo = 10");
    let reference = |value| Reference::exact(value, GAP).known_to(0.0015);
    let tolerance = Tolerance::relative(0.0235, WHY);
    let found = heated.outcome.scalars[Quantity::HeatPartition];
    rows.push(Row::new(name("heat partition"), found, reference(0.60918), tolerance));
    let rise = (end[Quantity::TemperatureMean] - START) / heated.rise;
    rows.push(Row::new(name("mean rise over qa/k"), rise, reference(0.46473), tolerance));
    Ok(rows)
}

/// A contact that is not small beside the asperity, so slow that both bodies are steady.
fn constricted(watch: &dyn Watch) -> Rows {
    let mut rows = Vec::new();
    for interference in [4.0, 64.0, 400.0] {
        let mut scene = slide_at_small_strain("aluminium-6061", interference, 1e-6, 8);
        scene.model.heat = Switch::On;
        scene.counterface = conducting(&scene, 1.0);
        let scalars = simulate(&scene, watch)?.scalars;
        let ratio = scalars[Quantity::ContactRadius].value / scene.radius;
        let rise = 1.0 + 3.0 * PI / 32.0 * ratio * ((4.0 / ratio).ln() - 0.75);
        let name = format!("heat partition beside a like body at rest, a = {ratio:.3} R");
        // A fifth of the second term.
        let flattened = 0.2 * (rise - 1.0) / (1.0 + rise);
        let reference = Reference::exact(1.0 / (1.0 + rise), SPHERE).known_to(flattened);
        let tolerance =
            Tolerance::relative(0.003 + flattened, "mesh, 0.3 %; higher orders of a/R, flattened contact");
        rows.push(Row::new(name, scalars[Quantity::HeatPartition], reference, tolerance));
    }
    Ok(rows)
}

/// Steady sliding beside a like counterface: share of the asperity, its mean rise over qa/k, and highest over mean rise.
struct Sliding {
    peclet: f64,
    /// With mean, slope and curvature of the rises of both bodies in common, as in the model.
    smooth: [f64; 3],
    /// With equal temperatures at each point.
    exact: [f64; 3],
}

/// `examples/peers/sliding_heat.py` with 128 squares along the diameter, and rises of the asperity 0.99336 and 0.96679 times those
/// of a half-space: it is not quite steady after 5000 contact diameters, Fo = 5000/Pe.
const SLIDING: [Sliding; 2] = [
    Sliding { peclet: 2.0, smooth: [0.3452, 0.2946, 1.3042], exact: [0.3435, 0.2948, 1.2724] },
    Sliding { peclet: 50.0, smooth: [0.1076, 0.0891, 1.5070], exact: [0.1075, 0.0894, 1.4778] },
];

/// A slide at a Péclet number beside a like counterface, and qa/k, K.
fn beside_like_body(peclet: f64, poisson_ratio: f64) -> (Scene, f64) {
    let mut scene = scene(plain_material(poisson_ratio), FrictionLaw::ShearStrength, 1e-4, mesh(8, 4));
    scene.interface.strength_factor = 0.005;
    scene.model.heat = Switch::On;
    scene.counterface = conducting(&scene, 1.0);
    let radius = Hertz::of(&scene).contact_radius;
    scene.loading.slip_distance = 10_000.0;
    scene.loading.slip_rate = 2.0 * peclet * scene.material.diffusivity() / radius;
    let rise =
        shear_strength(&scene) * scene.loading.slip_rate * radius / scene.material.thermal_conductivity.value;
    (scene, rise)
}

fn moving(watch: &dyn Watch) -> Rows {
    const WHY: &str = "mesh, 0.5 n_c^-1.5, of the rise of the asperity; flux not constant in time, 0.5 %";
    const SMOOTH: &str = "examples/peers/sliding_heat.py, mean, slope and curvature of the rises equal";
    const EXACT: &str = "examples/peers/sliding_heat.py, rises equal at each point";
    let mut rows = Vec::new();
    for Sliding { peclet, smooth, exact } in SLIDING {
        let (scene, scale) = beside_like_body(peclet, 0.499);
        let outcome = simulate(&scene, watch)?;
        let scalar = |quantity| outcome.scalars[quantity];
        let rise_over = |scale: f64, Estimate { value, error }: Estimate| {
            over(Estimate { value: value - START, error }, scale)
        };
        let rise = rise_over(scale, scalar(Quantity::TemperatureMean));
        let over_mean = |highest| rise_over(scale * rise.value, highest);
        let derived = derived::of_run(&scene, &outcome);
        let of_counterface = derived.iter().find(|(name, ..)| *name == "temperature_max_counterface");
        let highest = over_mean(scalar(Quantity::TemperatureMax));
        let opposite = over_mean(of_counterface.expect("it conducts").3);
        let mut row = |what: &str, found: Estimate, value: f64, source, tolerance, why| {
            let name = format!("{what} beside a like counterface, Pe = {peclet}");
            let reference = Reference::exact(value, source).known_to(0.001);
            rows.push(Row::new(name, found, reference, Tolerance::relative(tolerance, why)));
        };
        const PARTITION: &str = "heat partition";
        const MEAN: &str = "mean rise over qa/k";
        const HIGHEST: &str = "highest over mean rise";
        let partition = scalar(Quantity::HeatPartition);
        row(PARTITION, partition, smooth[0], SMOOTH, 0.027, WHY);
        row(PARTITION, partition, exact[0], EXACT, 0.042, "the same; smooth flux, 1.5 %");
        row(MEAN, rise, smooth[1], SMOOTH, 0.027, WHY);
        row(MEAN, rise, exact[1], EXACT, 0.038, "the same; smooth flux, 1.1 %");
        row(HIGHEST, highest, smooth[2], SMOOTH, 0.027, WHY);
        row(HIGHEST, highest, exact[2], EXACT, 0.068, "the same; smooth flux, 4.1 %");
        row(
            "highest rise of the counterface over mean rise",
            opposite,
            exact[2],
            EXACT,
            0.041,
            "smooth flux",
        );
    }
    Ok(rows)
}

/// Displacement of both surfaces by thermal expansion over that of the asperity alone, by the load of Hertz: of like bodies that
/// hardly move 2, later as the mean displacements of `examples/peers/counterface_expansion.py`.
fn expanding(watch: &dyn Watch) -> Rows {
    const ALIKE: &str = "like bodies at rest expand alike";
    const MOVING: &str = "examples/peers/counterface_expansion.py";
    /// Of the asperity, over the interference.
    const DISPLACEMENT: f64 = 0.005;
    let mut rows = Vec::new();
    for (peclet, slip, ratio, source, tolerance) in
        [(0.01, 2.0, 2.0, ALIKE, 0.02), (2.0, 4.0, 1.81, MOVING, 0.04)]
    {
        let (mut scene, scale) = beside_like_body(peclet, 0.3);
        scene.loading.slip_distance = slip;
        let expansion = DISPLACEMENT * Hertz::of(&scene).contact_radius / (scene.radius * scale);
        let mut load = |asperity: f64, counterface: f64| {
            scene.material.thermal_expansion = asperity.into();
            scene.counterface.thermal_expansion = Some(counterface);
            Ok(simulate(&scene, watch)?.scalars[Quantity::Load].value)
        };
        let loads = [load(0.0, 0.0)?, load(expansion, 0.0)?, load(expansion, expansion)?];
        let [alone, both] = [loads[1], loads[2]].map(|load| (load / loads[0]).powf(2.0 / 3.0) - 1.0);
        let name =
            format!("displacement of both surfaces by expansion over that of the asperity, Pe = {peclet}");
        let tolerance = Tolerance::relative(
            tolerance,
            "mesh; mean displacement in place of that weighted by the pressure",
        );
        rows.push(Row::new(name, both / alone, Reference::exact(ratio, source), tolerance));
    }
    Ok(rows)
}

/// A conducting counterface of the diffusivity of the asperity and `ratio` times its conductivity.
pub(super) fn conducting(scene: &Scene, ratio: f64) -> Counterface {
    let material = &scene.material;
    Counterface {
        thermal_conductivity: Some((ratio * material.thermal_conductivity.value).into()),
        density: Some(ratio * material.density),
        specific_heat: Some(material.specific_heat.clone()),
        ..Counterface::default()
    }
}

/// Hertz's load of a sphere on an elastic body at an interference in metres.
fn elastic(watch: &dyn Watch) -> Rows {
    let mut scene = scene(plain_material(0.3), FrictionLaw::Frictionless, 0.3, mesh(8, 4));
    let (youngs, poisson) = (100e9, 0.2);
    scene.counterface.youngs_modulus = Some(youngs);
    scene.counterface.poisson_ratio = Some(poisson);
    let outcome = run_press(&scene, watch)?;
    let material = &scene.material;
    let compliance = (1.0 - material.poisson_ratio.powi(2)) / material.youngs_modulus.value;
    let modulus = 1.0 / (compliance + (1.0 - poisson * poisson) / youngs);
    let interference = 0.3 * outcome.critical_interference;
    let load = 4.0 / 3.0 * modulus * scene.radius.sqrt() * interference.powf(1.5);
    let critical =
        hertz::critical_interference(modulus, material.poisson_ratio, material.yield_strength, scene.radius);
    const SOURCE: &str = "Johnson 1985, Contact Mechanics, sec. 4.2";
    let tolerance = Tolerance::relative(0.004, "mesh; half space, 0.03 %");
    let reference = Reference::exact(load, SOURCE).known_to(0.0003);
    let found = outcome.scalars[Quantity::LoadPress];
    let yields = Reference::exact(critical, SOURCE);
    let exact = Tolerance::relative(1e-9, "closed form");
    let mut rows = vec![
        Row::new("P at 0.3 omega_c, elastic counterface of half the modulus", found, reference, tolerance)
            .unit("N"),
        Row::new("omega_c, elastic counterface", outcome.critical_interference, yields, exact).unit("m"),
    ];
    rows.extend(like_bodies(watch)?);
    rows.extend(soft_counterface(watch)?);
    Ok(rows)
}

/// The compliance of a soft counterface, a half-space, is that of the hemisphere in the model, whose base does not move: load and
/// area are too large by some 0.8 and 0.5 a/R, which the errors state.
fn soft_counterface(watch: &dyn Watch) -> Rows {
    let mut scene = scene(plain_material(0.3), FrictionLaw::Frictionless, 0.9, mesh(8, 4));
    scene.counterface.youngs_modulus = Some(0.05 * scene.material.youngs_modulus.value);
    scene.counterface.poisson_ratio = Some(0.3);
    let outcome = run_press(&scene, watch)?;
    let hertz = Hertz::of(&scene);
    let ratio = hertz.contact_radius / scene.radius;
    let row = |name: &str, quantity, value, share: f64, unit| {
        let name = format!("{name} at 0.9 omega_c, counterface of a twentieth of the modulus");
        let reference = Reference::exact(value, "Johnson 1985, Contact Mechanics, sec. 4.2").known_to(0.001);
        let tolerance = Tolerance::relative(share * ratio, "hemisphere in place of a half-space");
        Row::new(name, outcome.scalars[quantity], reference, tolerance).unit(unit)
    };
    Ok(vec![
        row("P", Quantity::LoadPress, hertz.load, 1.0, "N"),
        row("A", Quantity::AreaPress, hertz.area(), 0.6, "m2"),
    ])
}

/// Like bodies are displaced alike by the pressure: Hertz's contact whatever their friction (K. L. Johnson, *Contact
/// Mechanics*, 1985, §5.1).
fn like_bodies(watch: &dyn Watch) -> Rows {
    let mut scene = scene(plain_material(0.3), FrictionLaw::ShearStrength, 0.3, mesh(8, 4));
    scene.counterface.youngs_modulus = Some(scene.material.youngs_modulus.value);
    scene.counterface.poisson_ratio = Some(scene.material.poisson_ratio);
    let outcome = run_press(&scene, watch)?;
    let (state, hertz) = (pressed(&outcome), Hertz::of(&scene));
    let row = |name: &str, found, reference| {
        let name = format!("{name} with friction over Hertz, like bodies, 0.3 omega_c");
        let reference = Reference::exact(reference, "Johnson 1985, Contact Mechanics, sec. 5.1");
        Row::new(
            name,
            found,
            reference.known_to(0.0003),
            Tolerance::relative(0.004, "mesh; half space, 0.03 %"),
        )
    };
    Ok(vec![
        row("P", state[Quantity::Load] / hertz.load, 1.0),
        row("A", state[Quantity::Area] / hertz.area(), 1.0),
    ])
}
