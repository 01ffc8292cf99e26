//! Return mapping and softening for all laws.

use super::*;

/// A steel: E = 200 GPa, ν = 0.3, σ_Y = 400 MPa; constant properties, linear softening.
pub(crate) fn steel(hardening: Hardening) -> Material {
    Material {
        youngs_modulus: 200e9.into(),
        poisson_ratio: 0.3,
        yield_strength: 400e6,
        hardening,
        rate: Rate::None,
        density: 7850.0,
        specific_heat: 475.0.into(),
        thermal_conductivity: 45.0.into(),
        thermal_expansion: 1.2e-5.into(),
        softening: Softening::JohnsonCook { reference: 298.0, melting: 1793.0, exponent: 1.0 },
        fracture: None,
    }
}

/// A stronger one with a softening that is not linear.
fn solid(hardening: Hardening) -> Solid {
    let softening = Softening::JohnsonCook { reference: 298.0, melting: 1793.0, exponent: 1.03 };
    let material = Material {
        youngs_modulus: 205e9.into(),
        poisson_ratio: 0.29,
        yield_strength: 792e6,
        ..steel(hardening)
    };
    Solid::new(&Material { softening, ..material }, 298.0)
}

/// nBε^(n − 1)/σ_Y at ε = 0, also without hardening.
#[test]
fn the_power_law_begins_with_the_slope_of_its_exponent() {
    for (modulus, exponent, slope) in
        [(792e6, 0.3, f64::INFINITY), (792e6, 1.0, 1.0), (792e6, 2.0, 0.0), (0.0, 0.3, 0.0)]
    {
        let law = solid(Hardening::JohnsonCook { modulus, exponent });
        assert_eq!(law.hardened(0.0), (1.0, slope), "{modulus} {exponent}");
    }
    let [none, zero] = [Hardening::None, Hardening::JohnsonCook { modulus: 0.0, exponent: 0.3 }]
        .map(|hardening| returned(&solid(hardening), 1.5, 0.0, 0.8, 0.0, 1.0));
    for (none, zero) in none.into_iter().zip(zero) {
        assert!((none - zero).abs() < 1e-12, "{none} {zero}");
    }
}

/// (increment, strength, slope) of one lane; the other lanes, of points that do not flow or flow differently, must
/// have no effect on it.
fn returned(solid: &Solid, trial: f64, strain: f64, factor: f64, guess: f64, time_step: f64) -> [f64; 3] {
    let strength = solid.yield_strength(strain, 0.0);
    let of = |value: f64, other: f64| [value, value, other, value];
    let trials = Trial {
        flowing: [true, false, true, true],
        strain: of(strain, 1e-3),
        strength: of(strength, solid.yield_strength(1e-3, 0.0)),
        softening: of(factor, 0.7),
        guess: of(guess, 0.0),
        time_step,
    };
    let end = solid.return_map(&trials, &of(trial, 1.5 * trial));
    assert_eq!((end.increment[1], end.strength[1]), (0.0, strength));
    assert_eq!((end.increment[0], end.slope[0]), (end.increment[3], end.slope[3]));
    let alone = Trial {
        flowing: [true],
        strain: [strain],
        strength: [strength],
        softening: [factor],
        guess: [guess],
        time_step,
    };
    let alone = solid.return_map(&alone, &[trial]);
    let close = |a: f64, b: f64| a == b || (a - b).abs() <= 1e-9 * a.abs() + 1e-17;
    assert!(close(alone.increment[0], end.increment[0]), "{alone:?} {end:?}");
    [end.increment[0], end.strength[0], end.slope[0]]
}

#[test]
fn return_map_ends_on_the_yield_surface() {
    let laws = [
        Hardening::None,
        Hardening::Linear { modulus: 2e9 },
        Hardening::JohnsonCook { modulus: 510e6, exponent: 0.26 },
        Hardening::Table { plastic_strain: vec![0.0, 0.01, 0.3], factor: vec![1.0, 1.2, 1.5] },
        Hardening::Table { plastic_strain: vec![0.0, 0.01, 0.3], factor: vec![1.0, 0.9, 0.1] },
    ];
    let states = [0.0, 1e-9, 1e-4, 0.2].into_iter().flat_map(|strain| {
        [0.0, 300.0, 1400.0].into_iter().flat_map(move |rise| {
            [(1e-9, 0.0), (1e-4, 1e-3), (0.1, 1e-7), (10.0, 0.02)].map(|start| (strain, rise, start))
        })
    });
    for (law, (strain, rise, (overshoot, guess))) in
        laws.iter().flat_map(|law| states.clone().map(move |s| (law, s)))
    {
        // Without time, and over steps at up to 1e8 times the reference rate.
        for time_step in [f64::INFINITY, 1e3, 1e-3, 1e-6, 1e-10] {
            let mut solid = solid(law.clone());
            solid.rate = Rate::JohnsonCook { coefficient: 0.05, reference: 2.0 };
            let trial = solid.yield_strength(strain, rise) * (1.0 + overshoot);
            let factor = solid.softening_factor(rise);
            let [increment, end, _] = returned(&solid, trial, strain, factor, guess, time_step);
            assert!(increment >= 0.0);
            let rated = solid.rate.factor(increment / time_step);
            let exact = rated * solid.yield_strength(strain + increment, 0.0);
            assert!((end / exact - 1.0).abs() < 1e-12, "{end} {exact}");
            let q = trial - 3.0 * solid.moduli.shear * increment;
            let strength = rated * solid.yield_strength(strain + increment, rise);
            assert!(
                (q - strength).abs() < 1e-12 * trial,
                "{solid:?} {strain} {rise} {overshoot} {time_step}"
            );
        }
    }
}

/// A step of infinite duration is one of a solid without the rate law, to the last digit.
#[test]
fn slow_flow_is_that_without_a_rate_law() {
    let plain = solid(Hardening::JohnsonCook { modulus: 510e6, exponent: 0.26 });
    let mut rated = plain.clone();
    rated.rate = Rate::JohnsonCook { coefficient: 0.05, reference: 1.0 };
    let at = |solid: &Solid, time_step: f64| returned(solid, 1.3, 1e-3, 0.9, 0.0, time_step);
    assert_eq!(at(&plain, 1e-9), at(&plain, f64::INFINITY));
    assert_eq!(at(&rated, f64::INFINITY), at(&plain, f64::INFINITY));
    for (slow, exact) in at(&rated, 1e9).into_iter().zip(at(&plain, 1e9)) {
        assert!((slow / exact - 1.0).abs() < 1e-12, "{slow} {exact}");
    }
}

/// A table that rises and falls again: the bound holds for every temperature in between.
#[test]
fn lowest_softening_factor_is_a_lower_bound() {
    let mut solid = solid(Hardening::None);
    let laws = [
        Softening::JohnsonCook { reference: 298.0, melting: 1793.0, exponent: 0.8 },
        Softening::Table {
            temperature: vec![250.0, 298.0, 400.0, 500.0, 700.0],
            factor: vec![0.9, 1.0, 0.7, 1.1, 0.2],
        },
    ];
    for law in laws {
        solid.softening = law;
        for (coldest, hottest) in [(0.0, 50.0), (-60.0, 0.0), (0.0, 202.0), (50.0, 180.0), (0.0, 3000.0)] {
            let bound = solid.lowest_softening_factor(|| coldest, hottest);
            let lowest = (0..=1000)
                .map(|i| solid.softening_factor(coldest + (hottest - coldest) * i as f64 / 1000.0))
                .fold(f64::INFINITY, f64::min);
            assert!(bound <= lowest && bound > lowest - 0.01, "{bound} {lowest}");
        }
    }
}

/// Exponents below one fall steeply at once, and end at zero at the melting point.
#[test]
fn johnson_cook_softening_is_finite_everywhere() {
    let mut solid = solid(Hardening::JohnsonCook { modulus: 331e6, exponent: 0.34 });
    for exponent in [0.1, 0.8, 1.0, 3.0] {
        solid.softening = Softening::JohnsonCook { reference: 298.0, melting: 1878.0, exponent };
        let mut last = 1.0;
        for rise in [-200.0, 0.0, 1e-300, 1e-9, 1.0, 500.0, 1579.999, 1580.0, 1e4, 1e300] {
            let factor = solid.softening_factor(rise);
            assert!(factor <= last && (0.0..=1.0).contains(&factor), "{exponent} {rise} {factor}");
            last = factor;
            for trial in [1e-12, 0.5, 3.0, 1e6] {
                if trial > factor {
                    let [increment, _, slope] = returned(&solid, trial, 0.0, factor, 0.0, f64::INFINITY);
                    assert!(increment.is_finite() && increment >= 0.0 && slope >= 0.0, "{rise} {trial}");
                }
            }
        }
        assert_eq!(last, 0.0);
    }
}

#[test]
fn molten_material_has_no_strength() {
    let solid = solid(Hardening::JohnsonCook { modulus: 510e6, exponent: 0.26 });
    assert_eq!(solid.yield_strength(0.0, 1495.0), 0.0);
    assert_eq!(solid.yield_strength(0.3, 1e5), 0.0);
    let [increment, _, slope] =
        returned(&solid, 1.0, 0.0, solid.softening_factor(2000.0), 0.0, f64::INFINITY);
    assert!((increment * 3.0 * solid.moduli.shear - 1.0).abs() < 1e-12 && slope == 0.0);
}
