//! Finite surfaces as CF netCDF files and as text.

use crate::output::friction_file::{Origin, described, grid_coordinates};
use crate::sampling::finite_surface::{Draw, Samples, Scatter};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::Path;
use tables::netcdf::{DatasetError, DatasetWriter};

/// Name, units, long name and value of one quantity of a drawn surface.
type Quantity = (&'static str, &'static str, &'static str, fn(&Draw) -> f64);

/// Every quantity that is written. To add one: a line here.
const QUANTITIES: [Quantity; 7] = [
    ("mu", "1", "sliding friction coefficient", |d| d.mu),
    ("pressure_sliding", "Pa", "nominal pressure", |d| d.pressure),
    ("Q", "Pa", "friction stress on the nominal area", |d| d.shear),
    ("separation_sliding", "m", "distance of the flat from the reference plane of the heights", |d| {
        d.separation
    }),
    ("real_area_fraction", "1", "real over nominal contact area", |d| d.area_fraction),
    ("contacts", "1", "number of asperities in contact", |d| d.contacts),
    ("outside_table_fraction", "1", "share of the load carried beyond the range of the table", |d| d.outside),
];

/// Name, long name and value of what is said about a scatter.
type Statistic = (&'static str, &'static str, fn(&Scatter) -> f64);

const STATISTICS: [Statistic; 5] = [
    ("mean", "mean over the surfaces of the", |s| s.mean),
    ("mean_error", "half width of the 95 % confidence interval of the mean of the", |s| s.mean_error),
    ("std", "standard deviation over the surfaces of the", |s| s.standard_deviation),
    ("lower", "2.5 % quantile over the surfaces of the", |s| s.lower),
    ("upper", "97.5 % quantile over the surfaces of the", |s| s.upper),
];

/// Writes `mc.nc`; the file appears whole or not at all.
pub fn write(path: &Path, samples: &Samples, origin: &Origin) -> Result<(), DatasetError> {
    let mut file = DatasetWriter::create(path, "Friction of finite rough surfaces")?;
    origin.write(&mut file, &samples.law, &samples.query)?;
    let sampling = &samples.sampling;
    file.attribute("asperities", sampling.asperities as f64)?;
    // A netCDF number would lose the last digits of a large seed.
    file.attribute("seed", sampling.seed.to_string().as_str())?;
    file.attribute("slip", sampling.slip)?;
    if !samples.warnings.is_empty() {
        file.attribute("warnings", samples.warnings.join("\n").as_str())?;
    }
    let row = grid_coordinates(&mut file, &samples.query)?;
    file.dimension("realization", sampling.realizations)?;
    let (grid, all) = ([row, "slip_rate"], [row, "slip_rate", "realization"]);
    let draws: Vec<&Draw> = samples.draws.iter().flatten().flatten().collect();
    for (name, units, long_name, value) in QUANTITIES {
        let values: Vec<f64> = draws.iter().map(|draw| value(draw)).collect();
        file.reals(name, &all, &values, &described(units, long_name))?;
        let scatters: Vec<Scatter> =
            samples.draws.iter().flatten().map(|surfaces| Scatter::of(surfaces.iter().map(value))).collect();
        for (statistic, words, of) in STATISTICS {
            let values: Vec<f64> = scatters.iter().map(of).collect();
            let name = format!("{name}_{statistic}");
            let long_name = format!("{words} {long_name}");
            file.reals(&name, &grid, &values, &described(units, &long_name))?;
        }
    }
    file.finish()
}

/// Each pressure or separation and slip rate with the scatter of friction and contacts.
fn rows(samples: &Samples) -> Vec<(f64, f64, Scatter, Scatter)> {
    let mut rows = Vec::new();
    for (row, &value) in samples.query.pressing.values().iter().enumerate() {
        for (rate, &slip_rate) in samples.query.slip_rates.iter().enumerate() {
            rows.push((
                value,
                slip_rate,
                samples.scatter(row, rate, |draw| draw.mu),
                samples.scatter(row, rate, |draw| draw.contacts),
            ));
        }
    }
    rows
}

/// The samples as lines of text.
pub fn text(samples: &Samples) -> String {
    let head = crate::output::summary::row_head(&samples.query.pressing);
    let mut text = format!(
        "{} surfaces of {} asperities, after a slip of {:.3e} m; intervals hold 95 %\n\
         {head:>13}   slip rate [m/s]     mean mu             mu of one surface   contacts\n",
        samples.sampling.realizations, samples.sampling.asperities, samples.sampling.slip
    );
    for (value, rate, mu, contacts) in rows(samples) {
        let _ = writeln!(
            text,
            "{value:>13.3e}   {rate:>15}   {:>7.4} ±{:.4}   {:>9.4} to {:.4}   {:.0} to {:.0}",
            mu.mean, mu.mean_error, mu.lower, mu.upper, contacts.lower, contacts.upper
        );
    }
    text
}

/// The samples as JSON.
pub fn json(samples: &Samples) -> Value {
    let cells: Vec<Value> = rows(samples)
        .into_iter()
        .map(|(value, slip_rate, mu, contacts)| {
            let row = crate::output::summary::row_key(&samples.query.pressing);
            json!({row: value, "slip_rate": slip_rate, "mu": mu, "contacts": contacts})
        })
        .collect();
    json!({
        "law": samples.law,
        "hold": samples.query.hold,
        "asperities": samples.sampling.asperities,
        "realizations": samples.sampling.realizations,
        "seed": samples.sampling.seed,
        "slip": samples.sampling.slip,
        "friction": cells,
        "warnings": samples.warnings,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::friction::{Settings, end_of_slide};
    use crate::integral::test_laws::PowerLaw;
    use crate::sampling::finite_surface::{Sampling, sample};
    use crate::surface::file::SurfaceFile;
    use tables::netcdf::DatasetReader;

    #[test]
    fn every_surface_and_its_statistics_are_written() {
        let text = "surface = { asperity_density = 1e10, asperity_radius = 1e-4, \
                    heights = { distribution = \"gaussian\", std = 1e-6 } }\n\
                    query = { pressure = [1e6, 1e7], slip_rate = [1.0] }";
        let file = SurfaceFile::parse(Path::new("surface.toml"), text.into()).unwrap();
        let (law, settings) = (PowerLaw::hertz(), Settings::default());
        let sampling = Sampling {
            asperities: 100,
            realizations: 20,
            seed: u64::MAX,
            slip: end_of_slide(&law, &file.surface, &file.query, &settings).unwrap(),
        };
        let samples = sample(&law, &file.surface, &file.query, &sampling, &settings, &|_, _| ());
        let samples = samples.unwrap();
        let path = std::env::temp_dir().join(format!("roughsurface-mc-{}.nc", std::process::id()));
        let origin = Origin { surface: text, table: "model:test", command: "test" };
        write(&path, &samples, &origin).unwrap();
        let read = DatasetReader::open(&path).unwrap();
        let mu = read.reals("mu", &[2, 1, 20]).unwrap();
        assert_eq!(mu[21], samples.draws[1][0][1].mu);
        let mean = read.reals("mu_mean", &[2, 1]).unwrap();
        assert_eq!(mean[1], samples.scatter(1, 0, |draw| draw.mu).mean);
        assert_eq!(read.attribute_text("seed").unwrap(), u64::MAX.to_string());
        drop(read);
        std::fs::remove_file(path).unwrap();
        assert_eq!(super::text(&samples).lines().count(), 4);
        assert_eq!(json(&samples)["friction"][1]["pressure"], 1e7);
    }
}
