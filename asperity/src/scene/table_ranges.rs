//! Temperatures and strains outside the tables of properties, beyond which these are constant.

use tables::numbers::{digits, plain};

use crate::scene::{Hardening, Scene, Softening};

/// Margin by which a temperature may be outside a table, K: as that of a room, at which tables begin, is 293 to 300 K.
const MARGIN: f64 = 10.0;

/// Key, temperatures (K) and values of a table.
type Points<'a> = (&'static str, &'a [f64], &'a [f64]);

impl Scene {
    /// A sentence where the plastic strain of a run exceeds the table of hardening, whose last two factors differ.
    pub(crate) fn outside_hardening(&self, largest: f64) -> Option<String> {
        let Hardening::Table { plastic_strain, factor } = &self.material.hardening else { return None };
        let ([.., last], [.., before, end]) = (&plastic_strain[..], &factor[..]) else { return None };
        (largest > *last && before != end).then(|| {
            format!(
                "the largest plastic strain is {}, above the table of material.hardening, which ends at {}: its last factor is \
                 taken there",
                digits(largest, 3),
                plain(*last)
            )
        })
    }

    /// A sentence for each table that does not contain the temperatures from the initial one to `highest`, K; of thermal
    /// properties with heat only. A table whose last two values are equal says itself that it is constant above, and so does
    /// a law that ends without strength.
    pub(crate) fn outside_tables(&self, highest: f64, heat: bool) -> Vec<String> {
        let initial = self.loading.temperature;
        let remark = |(key, temperatures, values): Points<'_>| {
            let ([first, .., last], [.., before, end]) = (temperatures, values) else { return None };
            let range = format!("{} to {} K", plain(*first), plain(*last));
            if initial < first - MARGIN || initial > last + MARGIN {
                let initial = plain(initial);
                return Some(format!(
                    "the initial temperature of {initial} K is outside the table of {key}, {range}, and takes the value at its end"
                ));
            }
            (highest > last + MARGIN && before != end && *end != 0.0).then(|| {
                let highest = digits(highest, 4);
                format!("the contact reaches {highest} K, above the table of {key}, {range}: its last value is taken there")
            })
        };
        self.tables_over_temperature(heat).into_iter().filter_map(remark).collect()
    }

    /// Temperatures at which a property of body and flat may have a kink, K, in no order.
    pub(crate) fn kinks_over_temperature(&self) -> Vec<f64> {
        let references = self.softenings().into_iter().filter_map(|(_, law)| match law {
            Softening::JohnsonCook { reference, .. } => Some(*reference),
            _ => None,
        });
        let tables = self.tables_over_temperature(true);
        tables.iter().flat_map(|(_, kelvin, _)| kelvin.iter().copied()).chain(references).collect()
    }

    /// The tables over temperature that a run with or without heat reads.
    fn tables_over_temperature(&self, heat: bool) -> Vec<Points<'_>> {
        let (material, counterface) = (&self.material, &self.counterface);
        let mut tables: Vec<Points<'_>> = Vec::new();
        for (key, property) in [
            ("material.youngs_modulus", Some(&material.youngs_modulus)),
            ("material.specific_heat", Some(&material.specific_heat)),
            ("material.thermal_conductivity", Some(&material.thermal_conductivity)),
            ("material.thermal_expansion", Some(&material.thermal_expansion)),
            ("counterface.specific_heat", counterface.specific_heat.as_ref()),
            ("counterface.thermal_conductivity", counterface.thermal_conductivity.as_ref()),
        ] {
            let table = property
                .and_then(|property| property.table.as_ref())
                .filter(|_| heat || key == "material.youngs_modulus");
            tables.extend(table.map(|table| (key, &table.temperature[..], &table.value[..])));
        }
        for (key, law) in self.softenings() {
            if let Softening::Table { temperature, factor } = law {
                tables.push((key, temperature, factor));
            }
        }
        tables
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::tests::of_preset;

    #[test]
    fn strains_above_a_table_of_hardening_are_named() {
        let hardening = |factors: &str| {
            format!(
                "material.hardening={{law=\"table\", plastic_strain=[0, 0.01, 0.03], factor=[1, {factors}]}}"
            )
        };
        let scene = |factors| of_preset("steel-4340", &[&hardening(factors)]);
        assert_eq!(scene("1.1, 1.2").outside_hardening(0.03), None);
        let said = scene("1.1, 1.2").outside_hardening(0.0861).unwrap();
        assert!(said.contains("strain is 0.0861") && said.contains("ends at 0.03"), "{said}");
        assert_eq!(scene("1.2, 1.2").outside_hardening(0.1), None);
    }

    #[test]
    fn temperatures_outside_a_table_are_named() {
        let law = ["interface.law=briscoe-tabor", "interface.film_strength=6e7"];
        let film = "interface.film_softening={law=\"table\", temperature=[300, 600], factor=[1.0, 0.2]}";
        let table = "material.specific_heat={temperature=[293, 800], value=[460, 600]}";
        let scene = |temperature| of_preset("steel-4340", &[law[0], law[1], film, table, temperature]);
        // 298 K are within the margin of both.
        let cold = scene("loading.temperature=298");
        assert!(cold.outside_tables(605.0, true).is_empty());
        let [only] = &cold.outside_tables(700.0, true)[..] else { panic!() };
        assert!(
            only.contains("reaches 700 K") && only.contains("interface.film_softening, 300 to 600 K"),
            "{only}"
        );
        assert_eq!(cold.outside_tables(900.0, true).len(), 2);
        let hot = scene("loading.temperature=650").outside_tables(660.0, true);
        assert!(
            hot.len() == 1 && hot[0].starts_with("the initial temperature of 650 K is outside"),
            "{hot:?}"
        );
        let constant = film.replace("600], factor=[1.0, 0.2]", "600, 700], factor=[1.0, 0.2, 0.2]");
        let without_strength = film.replace("0.2]", "0]");
        for film in [constant, without_strength] {
            let scene = of_preset("steel-4340", &[law[0], law[1], &film]);
            assert!(scene.outside_tables(900.0, true).is_empty(), "{film}");
        }
        // Without heat no thermal property is read.
        let heatless = of_preset("steel-4340", &[table, "loading.temperature=900"]);
        assert_eq!([false, true].map(|heat| heatless.outside_tables(900.0, heat).len()), [0, 1]);
    }
}
