//! Friction of one asperity against slip rate.
//!
//! Problem: 4340 steel, R = 1 mm, ω₀ = 20 ω_c, V = 0.1, 1, 10 m/s.
//! Source: at sliding inception the flat has moved by δ_s = τ₀a/(2G*) only, so that the rise of
//! temperature is at most 2τ₀V√(κδ_s/(πV))/k (Carslaw & Jaeger 1959, §2.9: constant flux into a
//! half space): static friction cannot depend on the rate, sliding friction must fall with it.
//! No point of the interface carries more than σ_Y(T₀)/√3 (von Mises).

use asperity::scene::FrictionLaw;
use asperity::simulate::{Unwatched, press, slide};
use tables::quantity::Quantity;
use tests::{mesh, relative, scene, steel_4340};

#[test]
fn static_friction_ignores_the_slip_rate_and_sliding_friction_falls_with_it() {
    let mut scene = scene(steel_4340(), FrictionLaw::ShearStrength, 20.0, mesh(8, 8));
    scene.interface.heat_partition = 0.5;
    scene.interface.taylor_quinney = 0.9;
    scene.loading.slip_distance = 1.0;
    let strength = scene.material.yield_strength / 3f64.sqrt();
    let pressed = press(&scene, &Unwatched).unwrap();
    let runs = [0.1, 1.0, 10.0].map(|rate| slide(&pressed, rate, &Unwatched).unwrap());
    for run in &runs {
        let s = &run.scalars;
        println!(
            "mu_s {:.5} ± {:.5} ({:?} at {:.3e}) mu {:.5} ± {:.5} T {:.0}, {:.1} s, {} steps",
            s[Quantity::MuStatic].value,
            s[Quantity::MuStatic].error,
            run.inception,
            s[Quantity::InceptionSlip].value,
            s[Quantity::Mu].value,
            s[Quantity::Mu].error,
            s[Quantity::TemperatureMax].value,
            run.account.wall_time,
            run.account.steps
        );
        for step in run.slide.states() {
            assert!(step[Quantity::Friction] / step[Quantity::Area] <= strength * (1.0 + 1e-9), "{step:?}");
        }
    }
    let [slow, middle, fast] = runs.map(|run| run.scalars);
    for other in [&middle, &slow] {
        let off = relative(other[Quantity::MuStatic].value, fast[Quantity::MuStatic].value);
        assert!(off.abs() < 0.01, "{off}");
    }
    assert!(
        slow[Quantity::Mu].value > middle[Quantity::Mu].value
            && middle[Quantity::Mu].value > fast[Quantity::Mu].value
    );
}
