//! Tables of several initial temperatures: constants of each, and the tables that they consist of.

use super::*;

#[test]
fn a_film_has_its_strength_at_each_temperature() {
    let film = "[interface]\nlaw = \"briscoe-tabor\"\nfilm_strength = 60e6\npressure_coefficient = 0.1\n\
                film_softening = { law = \"table\", temperature = [298, 698], factor = [1.0, 0.2] }\n";
    let all = table(&whole(&format!("{TEMPERATURES}{film}"), &Fake::default(), 1));
    for (slice, expected) in all.slices().iter().zip([60e6, 35.76e6, 12e6]) {
        let found = slice.metadata().film_strength.unwrap();
        assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
        let coefficient = slice.metadata().pressure_coefficient.unwrap();
        assert!((coefficient / (0.1 * expected / 60e6) - 1.0).abs() < 1e-12, "{coefficient} {expected}");
    }
}

#[test]
fn the_table_has_the_kinks_of_the_strength_between_its_temperatures() {
    let softening =
        "[material.softening]\nlaw = \"table\"\ntemperature = [298, 440, 700]\nfactor = [1.0, 0.9, 0.1]\n";
    let request = format!("{TEMPERATURES}{softening}");
    let template = self::request(&request).template;
    let law = |kelvin: f64| template.at_temperature(kelvin).material.yield_strength;
    let all = table(&whole(&request, &Fake::default(), 1));
    for kelvin in [310.0, 439.0, 440.0, 441.0, 650.0] {
        let found = all.at(kelvin).unwrap().metadata().yield_strength;
        assert!((found / law(kelvin) - 1.0).abs() < 1e-3, "{kelvin}: {found} {}", law(kelvin));
    }
}

#[test]
fn a_counterface_over_temperature_is_that_of_the_lowest_one() {
    let all = table(&whole(
        &format!("{TEMPERATURES}[counterface]\npreset = \"titanium-6al4v\"\n"),
        &Fake::default(),
        1,
    ));
    let stated = |slice: &Slice| slice.metadata().counterface_constants()["thermal_conductivity"];
    assert_eq!(all.slices().iter().map(stated).collect::<Vec<_>>(), [7.0; 3]);
}

#[test]
fn every_temperature_has_the_table_of_its_own_request() {
    let all = table(&whole(TEMPERATURES, &Fake::default(), 2));
    let request = request(TEMPERATURES);
    // But for the texts that name the other temperatures.
    let numbers = |slice: &Slice| {
        let mut slice = slice.clone();
        let metadata = slice.metadata_mut();
        (metadata.title, metadata.scene) = (String::new(), String::new());
        slice
    };
    for (slice, &temperature) in all.slices().iter().zip(&request.temperatures) {
        let alone = Bench::new(request.at_temperature(temperature));
        let alone = alone.run(&Fake::default(), (1, false, None), &Unwatched).unwrap();
        assert_eq!(numbers(&table(&alone).at(None).unwrap()), numbers(slice), "{temperature}");
    }
    assert!(all.slices()[2].metadata().yield_strength < 0.8 * all.slices()[0].metadata().yield_strength);
    assert_eq!(parse_request(&all.slices()[1].metadata().scene, "attribute", &[]).unwrap(), request);
}
