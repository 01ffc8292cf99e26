//! What follows from the equations alone: independence of slip rate, size and number of angles, the limit of small
//! strain, and continuity in mesh and interference.

use std::f64::consts::PI;

use tables::quantity::Quantity;

use super::setup::{
    Hertz, largest, mesh, plain_material, pressed, run_press, scene, shear_strength, steel_4340,
};
use super::{Case, Cost, Reference, Row, Rows, Tolerance};
use crate::scene::{FrictionLaw, Kinematics, Scene, Softening};
use crate::simulate::outcome::Outcome;
use crate::simulate::{SimulationError, Watch, press, simulate, slide};

pub const CASES: [Case; 6] = [
    Case::new("static friction at two slip rates", Cost::Quick, rate),
    Case::new("radii from 10 nm to 10 mm", Cost::Quick, scale),
    Case::new("angles of an axisymmetric press", Cost::Quick, angles),
    Case::new("finite strain at small strains", Cost::Medium, small_strains),
    Case::new("mesh twice as fine", Cost::Medium, finer_mesh),
    Case::new("interference step by step", Cost::Long, no_jumps),
];

fn steel(interference: f64, elements: usize) -> Scene {
    let mut scene = scene(steel_4340(), FrictionLaw::ShearStrength, interference, mesh(elements, 4));
    scene.interface.heat_partition = 0.5;
    scene.interface.taylor_quinney = 0.9;
    scene
}

/// At sliding inception the flat has moved by δ_s = τ₀a/(2G*) only: the rise is at most 2τ₀V√(κδ_s/(πV))/k (Carslaw &
/// Jaeger 1959, §2.9), and static friction lower by what that takes off the strength.
fn rate(watch: &dyn Watch) -> Rows {
    const SOURCE: &str = "the rise at inception is small, Carslaw & Jaeger 1959, sec. 2.9";
    const VON_MISES: &str = "no traction above the initial shear strength, von Mises";
    let mut scene = steel(20.0, 8);
    scene.loading.slip_distance = 0.2;
    let pressed = press(&scene, watch)?;
    let [slow, fast] = [0.1, 10.0].map(|rate| slide(&pressed, rate, watch));
    let (slow, fast) = (slow?, fast?);
    let [at_slow, at_fast] = [&slow, &fast].map(|outcome| outcome.scalars[Quantity::MuStatic].value);
    let material = &scene.material;
    let strength = shear_strength(&scene);
    let radius = slow.scalars[Quantity::ContactRadius].value;
    let slip = strength * radius / (2.0 * Hertz::of(&scene).tangential_modulus);
    let flux = scene.interface.heat_partition * strength * 10.0;
    let rise = 2.0 * flux / material.thermal_conductivity.value
        * (material.diffusivity() * slip / (PI * 10.0)).sqrt();
    let Softening::JohnsonCook { reference, melting, exponent } = material.softening else {
        unreachable!("the preset has this law")
    };
    let loss = (rise / (melting - reference)).powf(exponent);
    let stress =
        |outcome| largest(outcome, |step| step[Quantity::Friction] / step[Quantity::Area]) / strength;
    let excess = (stress(&slow).max(stress(&fast)) - 1.0).max(0.0);
    Ok(vec![
        Row::new(
            "mu_static of 4340 steel at 10 m/s over that at 0.1 m/s",
            at_fast / at_slow,
            Reference::exact(1.0, SOURCE).known_to(loss),
            Tolerance::relative(0.01, "half of the strength lost at the largest possible rise, 1.8 %"),
        ),
        Row::new(
            "excess of Q/A over the initial shear strength",
            excess,
            Reference::exact(0.0, VON_MISES),
            Tolerance::absolute(1e-9, "rounding"),
        ),
    ])
}

/// Quasi-static, rate-independent plasticity with conduction has no length of its own: VR/κ and h_gR/k are kept.
fn scale(watch: &dyn Watch) -> Rows {
    const SOURCE: &str = "dimensional analysis: the same at equal VR/kappa";
    const WHY: &str = "rounding differs with the unit, and with it the last iterate";
    let at = |radius: f64| -> Result<Outcome, SimulationError> {
        let mut scene = steel(5.0, 4);
        scene.radius = radius;
        scene.interface.gap_conductance = 10.0 / radius;
        scene.loading.slip_rate = 5e-3 / radius;
        scene.loading.slip_distance = 0.3;
        simulate(&scene, watch)
    };
    let reference = at(1e-3)?;
    let quantities = [
        (Quantity::Mu, 0),
        (Quantity::MuStatic, 0),
        (Quantity::MuPeak, 0),
        (Quantity::Friction, 2),
        (Quantity::Load, 2),
        (Quantity::Area, 2),
        (Quantity::EnergyRelease, 1),
        (Quantity::TemperatureMax, 0),
    ];
    let mut rows = Vec::new();
    for radius in [10e-9, 10e-3] {
        let outcome = at(radius)?;
        for (quantity, power) in quantities {
            let of = |outcome: &Outcome| outcome.scalars[quantity].value;
            let scaled = of(&outcome) / (radius / 1e-3f64).powi(power);
            let name = format!("{} at R = {radius:e} m over that at 1 mm", quantity.descriptor().name);
            let exact = Reference::exact(1.0, SOURCE);
            rows.push(Row::new(name, scaled / of(&reference), exact, Tolerance::relative(1e-6, WHY)));
        }
    }
    Ok(rows)
}

/// A press does not depend on θ.
fn angles(watch: &dyn Watch) -> Rows {
    const SOURCE: &str = "axial symmetry";
    let hertz = |sectors: usize| scene(plain_material(0.3), FrictionLaw::Frictionless, 0.3, mesh(8, sectors));
    let [four, eight] = [4, 8].map(|sectors| run_press(&hertz(sectors), watch));
    let (four, eight) = (four?, eight?);
    let pressure = &eight.snapshots[0].pressure;
    let rings = eight.grid.r.len();
    let apart = pressure.iter().enumerate().map(|(i, p)| (p - pressure[i % rings]).abs());
    let peak = Hertz::of(&hertz(8)).peak_pressure;
    let exact = |value: f64| Reference::exact(value, SOURCE);
    Ok(vec![
        Row::new(
            "P on 8 over P on 4 angles",
            pressed(&eight)[Quantity::Load] / pressed(&four)[Quantity::Load],
            exact(1.0),
            Tolerance::relative(1e-12, "rounding"),
        ),
        Row::new(
            "largest difference of p between angles over p0",
            apart.fold(0.0, f64::max) / peak,
            exact(0.0),
            Tolerance::absolute(1e-5, "tolerance of the solver"),
        ),
    ])
}

/// At a yield strain of 2e-4 and 3 ω_c strains and slopes are at most of the order of 1 %.
fn small_strains(watch: &dyn Watch) -> Rows {
    let run = |kinematics| {
        let mut scene = scene(plain_material(0.3), FrictionLaw::ShearStrength, 3.0, mesh(6, 8));
        scene.interface.strength_factor = 0.9;
        scene.loading.slip_distance = 0.2;
        scene.model.kinematics = kinematics;
        simulate(&scene, watch)
    };
    let (small, finite) = (run(Kinematics::Small)?, run(Kinematics::Finite)?);
    let quantities = [Quantity::LoadPress, Quantity::Mu, Quantity::Area];
    Ok(quantities
        .map(|quantity| {
            let ratio = finite.scalars[quantity].value / small.scalars[quantity].value;
            let name = format!("{} at finite over small strain, 3 omega_c", quantity.descriptor().name);
            let reference = Reference::exact(1.0, "limit of small strain");
            Row::new(name, ratio, reference, Tolerance::relative(0.005, "half of the largest strain"))
        })
        .into())
}

/// Loads, area and friction of 4340 steel at `interference`, isothermal, slid past sliding inception.
fn at(interference: f64, elements: usize, watch: &dyn Watch) -> Result<[f64; 4], SimulationError> {
    let mut scene = scene(steel_4340(), FrictionLaw::ShearStrength, interference, mesh(elements, 8));
    scene.loading.slip_distance = 0.1;
    let outcome = simulate(&scene, watch)?;
    Ok(SMOOTH.map(|quantity| outcome.scalars[quantity].value))
}

const SMOOTH: [Quantity; 4] =
    [Quantity::AreaPress, Quantity::LoadPress, Quantity::Friction, Quantity::MuStatic];

fn finer_mesh(watch: &dyn Watch) -> Rows {
    const WHY: &str = "mesh errors of 2.2 and 0.8 % (forces) and of the edge, 0.6 and 0.3 % rms";
    let (coarse, fine) = (at(20.0, 8, watch)?, at(20.0, 16, watch)?);
    Ok((0..SMOOTH.len())
        .map(|k| {
            let name = format!("{} on 16 over 8 elements, 20 omega_c", SMOOTH[k].descriptor().name);
            let reference = Reference::exact(1.0, "convergence of order 1.5");
            Row::new(name, fine[k] / coarse[k], reference, Tolerance::relative(0.02, WHY))
        })
        .collect())
}

/// 2 % of interference move the edge by a fifth of the ring spacing at 8 elements. Contact node by node would make the
/// area jump by a ring, 12 %.
fn no_jumps(watch: &dyn Watch) -> Rows {
    let steps: Vec<[f64; 4]> =
        (0..9).map(|k| at(20.0 + 0.4 * k as f64, 8, watch)).collect::<Result<_, _>>()?;
    Ok((0..SMOOTH.len())
        .map(|k| {
            let kink =
                |three: &[[f64; 4]]| (three[0][k] - 2.0 * three[1][k] + three[2][k]).abs() / three[1][k];
            let name = format!("largest kink of {} from 20 to 23.2 omega_c", SMOOTH[k].descriptor().name);
            let tolerance = Tolerance::absolute(0.005, "0.04 ring spacings; the curve bends by 0.01 %");
            let worst = steps.windows(3).map(kink).fold(0.0, f64::max);
            Row::new(name, worst, Reference::exact(0.0, "continuity"), tolerance)
        })
        .collect())
}
