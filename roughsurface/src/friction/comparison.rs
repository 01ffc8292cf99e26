//! The same surface with asperities after the models of the literature: the effect of heat, plasticity and
//! slip.

use crate::friction::predict::predict;
use crate::friction::result::Friction;
use crate::friction::settings::{PredictionError, Settings};
use crate::friction::warning::Warning;
use crate::integral::height_integral::NEGLIGIBLE_SHARE;
use crate::surface::query::{Query, Surface};
use tables::closed_forms::{ClosedForm, ElasticPlastic};
use tables::law::AsperityLaw;
use tables::numbers::digits;

/// Friction of a model at each pressure or separation; none depends on the slip rate.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// One of [`tables::closed_forms::NAMES`].
    pub model: String,
    /// Description of the model in words.
    pub description: &'static str,
    /// ω/ω_c at which its formulae end.
    pub limit: f64,
    pub friction: Vec<Friction>,
}

impl Comparison {
    /// Whether the contacts of a row lie in the range of the model, in words.
    pub fn validity(&self, row: usize) -> String {
        let share = self.friction[row].outside_table;
        if share <= NEGLIGIBLE_SHARE {
            return "in range".into();
        }
        format!("{:.1} % of load above {} omega_c", 100.0 * share, digits(self.limit, 3))
    }
}

/// The condition under which a closed form was published, where `material` does not meet it.
pub fn caveat(model: &str, material: &ElasticPlastic) -> Option<Warning> {
    let poisson_ratio = material.poisson_ratio;
    let off = model == "chang-etsion-bogy" && (poisson_ratio - 0.3).abs() > 0.02;
    off.then_some(Warning::PoissonRatioOfChangEtsionBogy { poisson_ratio })
}

/// Predicts with each of the `models` for spheres of `material`; unknown names are skipped.
pub fn compare(
    models: &[String],
    material: &ElasticPlastic,
    surface: &Surface,
    query: &Query,
    settings: &Settings,
) -> Result<Vec<Comparison>, PredictionError> {
    // A model is compared beyond its range as well, which `validity` says.
    let settings = &Settings { extrapolate: true, ..*settings };
    // Closed forms do not depend on the slip rate.
    let query = Query { slip_rates: vec![1.0], ..query.clone() };
    let mut compared = Vec::new();
    for model in models {
        let Ok(law) = ClosedForm::new(model, material) else {
            continue;
        };
        let prediction = predict(&law, surface, &query, settings, &|_, _| ())?;
        let friction = prediction.friction.into_iter().flatten().collect();
        let (description, limit) = (law.description(), law.interference_limit());
        compared.push(Comparison { model: model.clone(), description, limit, friction });
    }
    Ok(compared)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integral::test_laws::{STEEL, query, surface};
    use crate::surface::heights::Exponential;
    use crate::surface::query::{ContactLife, NormalLoading};
    use tables::closed_forms::{NAMES, closed_form};

    #[test]
    fn every_model_has_words_and_agrees_with_amontons() {
        // First yield of Kogut & Etsion: KH against the exact peak pressure at ν = 0.3.
        let unit = 2.8 * (0.454 + 0.41 * 0.3) / 1.61279656f64;
        let critical = unit.powi(2) * closed_form("hertz", &STEEL).unwrap().critical_interference(1e-4);
        // ψ = 1 with exponential heights: friction does not depend on the pressure, and with
        // Kogut & Etsion's load and area it is 0.42963 in units of the exact first yield.
        let surface = surface(Exponential::new(critical));
        let query = Query {
            slip_rates: vec![0.1, 5.0],
            contact_life: ContactLife::Steady,
            ..query(NormalLoading::Pressure(vec![1e4, 1e5]))
        };
        let models: Vec<String> = NAMES.iter().map(|name| name.to_string()).collect();
        let compared = compare(&models, &STEEL, &surface, &query, &Settings::default()).unwrap();
        assert_eq!(compared.len(), NAMES.len());
        for comparison in &compared {
            assert!(!comparison.description.is_empty(), "{}", comparison.model);
            // Some load is above first yield and above 6 times that, none above 150 times.
            let in_range =
                !["hertz", "chang-etsion-bogy", "kogut-etsion"].contains(&comparison.model.as_str());
            assert_eq!(comparison.validity(0) == "in range", in_range, "{}", comparison.model);
            let [light, heavy] = &comparison.friction[..] else { panic!("two pressures") };
            let (light, heavy) = (light.sliding.mu.value, heavy.sliding.mu.value);
            assert!((light / heavy - 1.0).abs() < 1e-5, "{}: {light} {heavy}", comparison.model);
        }
        let mu = |name: &str| {
            compared.iter().find(|c| c.model == name).map(|c| c.friction[0].sliding.mu.value).unwrap()
        };
        assert!((mu("constant-shear") * unit - 0.42963).abs() < 2e-5, "{}", mu("constant-shear"));
        assert!((mu("hertz") * unit - 0.4039).abs() < 1e-4, "{}", mu("hertz"));
        assert!(mu("chang-etsion-bogy") < mu("kogut-etsion") && mu("kogut-etsion") < mu("constant-shear"));
    }
}
