use super::*;
use crate::scene::fitted_constants::error_estimates::{DEEP_INCEPTION, HELD_LOAD};
use crate::scene::fitted_constants::localised_shear;

fn numerics() -> Numerics {
    Numerics { accuracy: 0.02, elements_per_radius: None, sectors: None }
}

/// Auxiliary runs whose values agree.
fn alike(values: &Values) -> AuxiliaryValues<'_> {
    AuxiliaryValues { coarse: values, other_sectors: values, longer_steps: values, looser_solver: None }
}

/// The budget of a run and of one on its coarse mesh that agree, with auxiliary runs that do, too.
fn of_agreeing(run: &Resolution, values: &Values, interference: f64, control: Control) -> ErrorBudget {
    let coarser = run.coarse();
    let pair = [run, &coarser].map(|resolution| RunValues { resolution, values });
    estimate(run, alike(values), pair, &ModellingError::default(), interference, control)
}

/// 3 + 2 n^-1.5 on n elements, and first order in the increments of the press: both bounds, and the scatter.
#[test]
fn errors_of_a_press_of_known_orders_are_found() {
    let run = Resolution::choose(&numerics());
    let coarser = run.coarse();
    let longer = coarser.longer_steps();
    let part =
        |r: &Resolution| [2.0 * (r.elements_per_radius as f64).powf(-1.5), 0.4 / r.press_increments() as f64];
    let of = |r: &Resolution| 3.0 + part(r).iter().sum::<f64>();
    let scatter = 0.003;
    let found = of_press([&run, &coarser, &longer].map(of), &run, &coarser, scatter);
    let [mesh, _] = part(&run);
    let steps = part(&longer)[1] - part(&coarser)[1];
    let exact = 4.0 * ((mesh * mesh + steps * steps) / 3.0 + (scatter * of(&run)).powi(2));
    assert!((found * found / exact - 1.0).abs() < 1e-9, "{found}");
}

/// 3 + 2 n^-1.5, 3 + 5/(nN_θ²) and 3 + 0.4 g on n elements with N_θ angles in slip increments g: the part of the source is
/// the error, of a main run and of finer ones.
#[test]
fn errors_of_runs_of_known_orders_are_found() {
    type Error = fn(&Resolution) -> f64;
    let errors: [(ErrorSource, Error); 3] = [
        (ErrorSource::Mesh, |r| 2.0 * (r.elements_per_radius as f64).powf(-1.5)),
        (ErrorSource::Collocation, |r| 5.0 / (r.elements_per_radius as f64 * (r.sectors as f64).powi(2))),
        (ErrorSource::Steps, |r| 0.4 * r.increment_growth),
    ];
    let start = Resolution::choose(&numerics());
    let mesh = start.finer_mesh(2);
    let angles = Resolution { sectors: 2 * mesh.sectors, ..mesh };
    for (source, error) in errors {
        let values = |r: &Resolution| Values::all(3.0 + error(r));
        let [coarse, other_sectors, longer_steps] = &start.auxiliary().map(|r| values(&r));
        let auxiliary = AuxiliaryValues { coarse, other_sectors, longer_steps, looser_solver: None };
        for resolution in &[start, mesh, angles] {
            let coarser = resolution.coarse();
            let pair = [
                RunValues { resolution, values: &values(resolution) },
                RunValues { resolution: &coarser, values: &values(&coarser) },
            ];
            let budget =
                estimate(&start, auxiliary, pair, &ModellingError::default(), 1.0, Control::Interference);
            // The heat partition has no scatter.
            let part = |source| budget.part(source, Quantity::HeatPartition);
            let exact = 2.0 / 3f64.sqrt() * error(resolution);
            assert!((part(source) / exact - 1.0).abs() < 1e-9, "{source:?}: {} {exact}", part(source));
            // The effect of the angles changes with the mesh.
            let total =
                if source == ErrorSource::Collocation { exact.hypot(part(ErrorSource::Mesh)) } else { exact };
            assert!((budget.total(Quantity::HeatPartition) / total - 1.0).abs() < 1e-9);
            assert_eq!(part(ErrorSource::Model), 0.0);
        }
    }
}

#[test]
fn what_is_known_of_an_unfinished_run_is_the_meshs() {
    let known = |quantity| (quantity == Quantity::LoadPress).then_some(0.3);
    let budget = ErrorBudget::unknown(known);
    let mesh = budget.part(ErrorSource::Mesh, Quantity::LoadPress);
    assert!((mesh - 0.3).abs() < 1e-15 && (budget.total(Quantity::LoadPress) - 0.3).abs() < 1e-15);
    assert!(budget.total(Quantity::Mu).is_nan());
    assert!(ErrorSource::ALL.iter().all(|source| budget.part(*source, Quantity::Mu).is_nan()));
}

/// The uncertainty of sliding inception is in the reported error, and asks for no refinement.
#[test]
fn brackets_are_reported() {
    let values = Values::all(2.0);
    let mut budget = ErrorBudget::default();
    budget.brackets[Quantity::MuStatic as usize] = 0.1;
    assert!((budget.relative(Quantity::MuStatic, &values) - 0.1).abs() < 1e-12);
    assert_eq!(budget.worst(&values).1, RelativeParts::default());
}

/// Twice the uncertainty of a difference of 0.7 % is 0.81 %, of 0.4 times the accuracy at most 0.8 %.
#[test]
fn increments_matter_above_a_share_of_the_accuracy() {
    let start = Resolution::choose(&numerics());
    let coarse = &Values::all(2.0);
    for (change, matters) in [(0.007, true), (0.0068, false)] {
        let longer_steps = &Values::all(2.0 * (1.0 + change));
        let auxiliary = AuxiliaryValues { longer_steps, ..alike(coarse) };
        let budget = ErrorBudget::other_than_mesh(auxiliary, &start);
        assert_eq!(budget.steps_matter(coarse, &numerics()), matters, "{change}");
    }
}

/// Equal values on all runs: what is left is the scatter of the quantity at its interference.
#[test]
fn meshes_that_agree_leave_the_scatter() {
    let start = Resolution::choose(&numerics());
    let values = Values::all(2.0);
    for interference in [0.2, 20.0] {
        let budget = of_agreeing(&start, &values, interference, Control::Interference);
        for quantity in [Quantity::Mu, Quantity::EnergyRelease] {
            let exact = 2.0 * scatter(quantity, interference, start.elements_per_radius);
            assert!((budget.relative(quantity, &values) / exact - 1.0).abs() < 1e-12);
            assert!((budget.total(quantity) / (2.0 * exact) - 1.0).abs() < 1e-12);
        }
        // Of G a multiple is allowed.
        let (worst, parts) = budget.worst(&values);
        let of = |quantity| budget.relative(quantity, &values) / quantity.allowance();
        assert!(CONTROLLED.iter().all(|&quantity| of(quantity) <= of(worst)));
        assert!((parts.total() / of(worst) - 1.0).abs() < 1e-12);
    }
}

/// Sliding inception of a deep contact is uncertain on any mesh, and that asks for no refinement.
#[test]
fn deep_inception_is_no_reason_for_a_finer_mesh() {
    let start = Resolution::choose(&numerics());
    let values = Values::all(2.0);
    let exact = COVERAGE_FACTOR * 0.5 * DEEP_INCEPTION[4] * 2.0;
    for (elements_per_radius, control, exact) in [
        (10, Control::Interference, exact),
        (40, Control::Interference, exact),
        (10, Control::Load, HELD_LOAD * exact),
    ] {
        let budget = of_agreeing(&Resolution { elements_per_radius, ..start }, &values, 1000.0, control);
        for found in [
            budget.part(ErrorSource::Steps, Quantity::EnergyRelease),
            budget.lasting(Quantity::EnergyRelease),
        ] {
            assert!((found / exact - 1.0).abs() < 1e-12, "{found}");
        }
        assert_eq!(budget.lasting(Quantity::Mu), 0.0);
        assert_eq!(budget.worst(&values).1.steps, 0.0);
    }
}

/// The error of a corrected value is as large relative to it.
#[test]
fn errors_are_scaled_as_values_are() {
    let mut budget = ErrorBudget::default();
    budget.parts[ErrorSource::Mesh as usize] = [0.3; QUANTITIES];
    budget.brackets = [0.4; QUANTITIES];
    let factor = |quantity| if quantity == Quantity::Load { 2.0 } else { 1.0 };
    let scaled = budget.clone().scaled(factor);
    for quantity in [Quantity::Load, Quantity::Mu] {
        assert!((scaled.total(quantity) / budget.total(quantity) - factor(quantity)).abs() < 1e-12);
        let steps = scaled.part(ErrorSource::Steps, quantity);
        assert!((steps - COVERAGE_FACTOR * 0.4 * factor(quantity)).abs() < 1e-12);
    }
}

/// What no finer mesh removes is in the error, and asks for no refinement.
#[test]
fn localised_shear_is_no_reason_for_a_finer_mesh() {
    let values = Values::all(2.0);
    let mut budget = ErrorBudget::default();
    let bounds = Some(&localised_shear::ON_PLATEAU);
    budget.set_model(&ModellingError { localised_shear: bounds, ..Default::default() }, &values);
    let exact = 2.0 / 3f64.sqrt() * localised_shear::ON_PLATEAU.energy;
    assert!((budget.relative(Quantity::EnergyRelease, &values) / exact - 1.0).abs() < 1e-12);
    assert_eq!(budget.worst(&values).1, RelativeParts::default());
}

/// 3 + 2 n^-1.5 on every mesh in the range of n_c: the estimate is exact whichever of the two meshes is the finer.
#[test]
fn every_mesh_has_an_auxiliary_one() {
    let value = |elements: usize| 3.0 + 2.0 * (elements as f64).powf(-1.5);
    for elements in [4, 5, 6, 7, 8, 12, 48] {
        let run = Resolution::choose(&Numerics { elements_per_radius: Some(elements), ..numerics() });
        let other = run.coarse();
        let refinement = elements as f64 / other.elements_per_radius as f64;
        let change = (value(elements) - value(other.elements_per_radius)).abs();
        let ratio = mesh_share(refinement) * change / (value(elements) - 3.0);
        assert!((ratio - 1.0).abs() < 1e-9, "{elements}: {ratio}");
    }
}
