use super::*;
use crate::friction::{Settings, predict};
use crate::integral::test_laws::PowerLaw;
use crate::surface::file::SurfaceFile;
use tables::netcdf::DatasetReader;

fn prediction(query: &str) -> Prediction {
    let text = format!(
        "surface = {{ asperity_density = 1e10, asperity_radius = 1e-4, \
         heights = {{ distribution = \"exponential\", std = 1e-6 }} }}\n[query]\n{query}"
    );
    let file = SurfaceFile::parse(Path::new("surface.toml"), text).unwrap();
    let law =
        PowerLaw { relative_error: 0.01, history: |rate, _, _| 1.0 / (1.0 + rate), ..PowerLaw::hertz() };
    predict(&law, &file.surface, &file.query, &Settings::default(), &|_, _| ()).unwrap()
}

/// Writes the prediction, reads it with `read`, and returns the bytes.
fn written(name: &str, prediction: &Prediction, read: impl Fn(&DatasetReader)) -> Vec<u8> {
    let path = std::env::temp_dir().join(format!("roughsurface-{name}-{}.nc", std::process::id()));
    let origin = Origin { surface: "text", table: "model:test", command: "test" };
    write(&path, prediction, &origin).unwrap();
    read(&DatasetReader::open(&path).unwrap());
    let bytes = std::fs::read(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    bytes
}

#[test]
fn what_is_written_is_read() {
    let prediction = prediction("pressure = [1e5, 1e6]\nslip_rate = [0.1, 1.0, 10.0]");
    let bytes = written("pressure", &prediction, |file| {
        assert_eq!(file.coordinate("pressure").unwrap(), [1e5, 1e6]);
        assert_eq!(file.coordinate("slip").unwrap(), prediction.slip);
        let mu = file.reals("mu", &[2, 3]).unwrap();
        let error = file.reals("mu_error", &[2, 3]).unwrap();
        for (index, cell) in prediction.friction.iter().flatten().enumerate() {
            assert_eq!(mu[index], cell.sliding.mu.value);
            assert_eq!(error[index], cell.sliding.mu.error);
        }
        let shape = [2, 3, prediction.slip.len()];
        let history = file.reals("mu_history", &shape).unwrap();
        assert_eq!(history[0], prediction.friction[0][0].mu_history[0].value);
        for name in [
            "mu_static",
            "Q",
            "G_weakening",
            "G_weakening_real_area",
            "dmu_dlnV",
            "separation",
            "real_area_fraction",
        ] {
            let values = file.reals(name, &[2, 3]).unwrap();
            assert!(values.iter().all(|value| value.is_finite()), "{name}");
        }
        assert_eq!(file.reals("V_w", &[2]).unwrap().len(), 2);
        assert_eq!(file.attribute_text("surface").unwrap(), "text");
    });
    // The same again gives the same bytes.
    assert!(bytes == written("again", &prediction, |_| ()));
}

#[test]
fn separations_are_a_coordinate_too_and_missing_fits_are_fill_values() {
    let prediction = prediction("separation = [0.0, 2e-6]\nslip_rate = [0.1]");
    written("separation", &prediction, |file| {
        assert_eq!(file.coordinate("separation").unwrap(), [0.0, 2e-6]);
        assert_eq!(file.reals("pressure", &[2, 1]).unwrap().len(), 2);
        let fitted = file.reals("mu_0", &[2]).unwrap();
        assert!(fitted.iter().all(|value| value.is_nan()));
    });
}
