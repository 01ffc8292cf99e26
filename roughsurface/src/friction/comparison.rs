//! The same surface with asperities after the models of the literature, to see what heat,
//! plasticity and slip bring.

use crate::friction::{Friction, PredictionError, Settings, predict};
use crate::surface::query::{Query, Surface};
use tables::closed_forms::{ElasticPlastic, closed_form};

/// What a model says at each pressure or separation; none depends on the slip rate.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// One of [`tables::closed_forms::NAMES`].
    pub model: String,
    /// What it stands for, in words.
    pub description: &'static str,
    pub friction: Vec<Friction>,
}

/// What a closed form is, in words.
pub fn description(model: &str) -> &'static str {
    match model {
        "hertz" => "elastic (Greenwood & Williamson), constant shear strength",
        "constant-shear" => "elastic-plastic, constant shear strength",
        "chang-etsion-bogy" => "elastic-plastic, no friction after yield",
        "kogut-etsion" => "elastic-plastic, friction ends at 6 omega_c",
        "jackson-green" => "elastic-plastic with falling hardness, constant shear strength",
        "brizmer" => "full stick, friction by load",
        "cohen" => "full stick, friction by interference",
        _ => "",
    }
}

/// Predicts with each of the `models` for spheres of `material`; unknown names are passed over.
///
/// ```
/// use roughsurface::friction::comparison::compare;
/// use roughsurface::friction::Settings;
/// use roughsurface::surface::file::SurfaceFile;
///
/// let text = "surface = { asperity_density = 1e10, asperity_radius = 1e-4, \
///             heights = { distribution = \"gaussian\", std = 5e-7 } }\n\
///             query = { pressure = [1e6], slip_rate = [1.0] }\n\
///             material = { youngs_modulus = 200e9, poisson_ratio = 0.3, yield_strength = 400e6 }";
/// let file = SurfaceFile::parse("an example".as_ref(), text.into())?;
/// let models = ["hertz", "brizmer"].map(String::from);
/// let material = file.material.as_ref().unwrap();
/// let [elastic, full_stick] =
///     &compare(&models, material, &file.surface, &file.query, &Settings::default())?[..] else { panic!() };
/// assert!(full_stick.friction[0].mu_static.value > elastic.friction[0].mu_static.value);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn compare(
    models: &[String],
    material: &ElasticPlastic,
    surface: &Surface,
    query: &Query,
    settings: &Settings,
) -> Result<Vec<Comparison>, PredictionError> {
    // One slip rate says it all, and closed forms know any.
    let query = Query { slip_rates: vec![1.0], ..query.clone() };
    let mut compared = Vec::new();
    for model in models {
        let Ok(law) = closed_form(model, material) else {
            continue;
        };
        let prediction = predict(law.as_ref(), surface, &query, settings, &|_, _| ())?;
        let friction = prediction.friction.into_iter().flatten().collect();
        compared.push(Comparison { model: model.clone(), description: description(model), friction });
    }
    Ok(compared)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::heights::Exponential;
    use crate::surface::query::{Hold, Pressing};
    use tables::closed_forms::NAMES;

    #[test]
    fn every_model_has_words_and_agrees_with_amontons() {
        let steel = ElasticPlastic { youngs_modulus: 200e9, poisson_ratio: 0.3, yield_strength: 400e6 };
        let critical = closed_form("hertz", &steel).unwrap().critical_interference(1e-4);
        // ψ = 1 with exponential heights: friction does not depend on the pressure, and with
        // Kogut & Etsion's load and area it is 0.42963.
        let surface = Surface {
            asperity_density: 1e10,
            asperity_radius: 1e-4.into(),
            heights: Box::new(Exponential::new(critical)),
        };
        let query = Query {
            pressing: Pressing::Pressure(vec![1e4, 1e5]),
            slip_rates: vec![0.1, 5.0],
            hold: Hold::Load,
        };
        let models: Vec<String> = NAMES.iter().map(|name| name.to_string()).collect();
        let compared = compare(&models, &steel, &surface, &query, &Settings::default()).unwrap();
        assert_eq!(compared.len(), NAMES.len());
        for comparison in &compared {
            assert!(!comparison.description.is_empty(), "{}", comparison.model);
            let [light, heavy] = &comparison.friction[..] else { panic!("two pressures") };
            let (light, heavy) = (light.sliding.mu.value, heavy.sliding.mu.value);
            assert!((light / heavy - 1.0).abs() < 1e-5, "{}: {light} {heavy}", comparison.model);
        }
        let mu = |name: &str| {
            compared.iter().find(|c| c.model == name).map(|c| c.friction[0].sliding.mu.value).unwrap()
        };
        assert!((mu("constant-shear") - 0.42963).abs() < 2e-5, "{}", mu("constant-shear"));
        assert!((mu("hertz") - 0.4039).abs() < 1e-4, "{}", mu("hertz"));
        assert!(mu("chang-etsion-bogy") < mu("kogut-etsion") && mu("kogut-etsion") < mu("constant-shear"));
    }
}
