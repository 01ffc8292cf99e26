//! Kinks of the material between the initial temperatures of a table.

use tables::interpolation::steffen::Steffen;
use tables::numbers::{digits, plain};

use crate::scene::Scene;
use crate::scene::file::Request;

/// Deviation of the interpolated constant, relative to the material's, that is worth adding a temperature.
const NOTABLE: f64 = 0.05;
/// Divisions between two temperatures, at whose ends both are compared.
const DIVISIONS: usize = 64;

/// A constant that is interpolated between the temperatures of a table, and the key of its law.
type Constant = (&'static str, &'static str, fn(&Scene) -> f64);
const CONSTANTS: [Constant; 2] = [
    ("yield strength", "material.softening", |scene| scene.material.yield_strength),
    ("contact modulus", "youngs_modulus", |scene| {
        scene.with_combined_modulus().material.elastic_plastic().contact_modulus()
    }),
];

impl Request {
    /// Between which temperatures of the table a constant is not that of the material, a sentence each: a table has a smooth
    /// curve through its temperatures.
    pub(crate) fn between_temperatures(&self) -> Vec<String> {
        let gap = |constant: &Constant, pair: &[f64]| {
            let (name, key, value) = constant;
            let at = |temperature: f64| value(&self.template.at_temperature(temperature));
            let curve = Steffen::new(self.temperatures.clone(), self.templates().iter().map(value).collect());
            let deviations = (1..DIVISIONS).map(|division| {
                let temperature = pair[0] + (pair[1] - pair[0]) * division as f64 / DIVISIONS as f64;
                (curve.value(temperature) / at(temperature) - 1.0, temperature)
            });
            let (worst, temperature) =
                deviations.max_by(|one, other| one.0.abs().total_cmp(&other.0.abs()))?;
            (worst.abs() > NOTABLE).then(|| {
                format!(
                    "between {} and {} K the {name} of the table follows a smooth curve, up to {} % {} that of {key}: \
                     add {} to table.temperature where such temperatures matter",
                    plain(pair[0]),
                    plain(pair[1]),
                    digits(100.0 * worst.abs(), 2),
                    if worst > 0.0 { "above" } else { "below" },
                    digits(temperature, 4),
                )
            })
        };
        let pairs = || self.temperatures.windows(2);
        CONSTANTS.iter().flat_map(|constant| pairs().filter_map(move |pair| gap(constant, pair))).collect()
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::file::parse_request;

    fn gaps(softening: &str, temperatures: &str) -> Vec<String> {
        let text = format!(
            "[material]\nyoungs_modulus = 9e9\npoisson_ratio = 0.33\nyield_strength = 10e6\ndensity = 917.0\n\
             specific_heat = 2072.0\nthermal_conductivity = 2.2\nthermal_expansion = 5e-5\nsoftening = {softening}\n[asperity]\nradius = 1e-3\n\
             [loading]\ntemperature = 263.0\n[table]\ninterference = [1, 10]\nslip_rate = [1]\n\
             temperature = {temperatures}\n"
        );
        parse_request(&text, "request.toml", &[]).unwrap().between_temperatures()
    }

    #[test]
    fn a_kink_between_two_temperatures_is_named() {
        let ice = "{ law = \"table\", temperature = [243, 253, 263, 270, 272.5, 273.15], factor = [1.5, 1.25, 1, 0.6, 0.2, 0.02] }";
        // σ_Y is 7.14 MPa at 268 K, 2.8 MPa at 272 K and 6 MPa at 270 K.
        let said = gaps(ice, "[243, 258, 268, 272]");
        assert!(
            said.len() == 1 && said[0].starts_with("between 268 and 272 K the yield strength"),
            "{said:?}"
        );
        assert!(said[0].contains("below that of material.softening: add 270"), "{said:?}");
        assert_eq!(gaps(ice, "[243, 248, 253, 258, 263, 266.5, 270, 271.25, 272.5]"), Vec::<String>::new());
        let metal = "{ law = \"johnson-cook\", reference = 263, melting = 1800, exponent = 1.0 }";
        assert_eq!(gaps(metal, "[263, 500, 800]"), Vec::<String>::new());
    }
}
