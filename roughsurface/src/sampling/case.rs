//! A case: a surface, the response of its asperities and the query, with all that is predicted of it.

use std::path::Path;

use super::finite_surface::{Samples, Sampling, sample};
use super::uncertainty::{Propagated, UncertaintyError, propagate};
use crate::friction::comparison::{Comparison, caveat, compare};
use crate::friction::cutoff::PredictionAtCutoff;
use crate::friction::warning::Warning;
use crate::friction::{Prediction, PredictionError, Settings, predict};
use crate::integral::law_source::{LawSource, LawSourceError};
use crate::surface::file::{SurfaceFile, SurfaceFileError};
use crate::surface::query::{NormalLoading, Query, Surface};
use crate::topography::characterize::{Characterization, SummitsAtCutoff};
use crate::topography::report;
use tables::closed_forms::ElasticPlastic;
use tables::netcdf::input::Override;
use tables::quantity::Quantity;
use tables::quantity::plausible::remarks;
use tables::shipped;

/// A prediction with comparisons and parameter uncertainties.
#[derive(Clone, Debug)]
pub struct Results {
    pub prediction: Prediction,
    /// Predictions of the same surface with asperities after models of the literature.
    pub comparisons: Vec<Comparison>,
    /// Predictions of the same topography with other cut-offs, by ascending cut-off; none for a surface file.
    pub cutoffs: Vec<PredictionAtCutoff>,
    /// Changes of the results with the uncertain parameters.
    pub propagated: Option<Propagated>,
    /// Initial temperature of asperities and flat, K: that of the query, or the only one of the table.
    pub temperature: Option<f64>,
}

impl From<Prediction> for Results {
    fn from(prediction: Prediction) -> Self {
        Self { prediction, comparisons: Vec::new(), cutoffs: Vec::new(), propagated: None, temperature: None }
    }
}

/// Reason why a case has no results.
#[derive(Debug, thiserror::Error)]
pub enum CaseError {
    #[error(transparent)]
    Prediction(#[from] PredictionError),
    #[error(transparent)]
    Uncertainty(#[from] UncertaintyError),
}

/// A surface, the response of its asperities, and the query.
pub struct Case {
    pub file: SurfaceFile,
    pub source: LawSource,
    /// Whether cells of tables without results are interpolated around.
    pub interpolate_missing: bool,
    /// The table as given: file, shipped name or `model:NAME`.
    pub table: String,
    /// The topography that the surface is of, if it is not a surface file.
    pub measured: Option<Characterization>,
}

impl Case {
    /// The case of a surface, with the law of [`LawSource::open`].
    pub fn open(
        file: SurfaceFile,
        measured: Option<Characterization>,
        table: &str,
        interpolate_missing: bool,
    ) -> Result<Self, LawSourceError> {
        let source = LawSource::open(table, file.material.as_ref(), file.temperature, interpolate_missing)?;
        file.counterface.as_ref().map_or(Ok(()), |asked| source.check_counterface(table, asked))?;
        Ok(Self { file, source, interpolate_missing, table: table.to_owned(), measured })
    }

    /// Warnings of the input, the first of all results: of the topography, of implausible values, and of cells of the
    /// table without results.
    pub fn warnings(&self) -> Vec<Warning> {
        let of_topography = self.measured.iter().flat_map(|found| found.warnings.iter().cloned());
        let mut warnings: Vec<Warning> = of_topography.map(Warning::Topography).collect();
        let mut sections: toml::Table = self.file.text.parse().unwrap_or_default();
        if self.file.heights_file.is_some() {
            // The file of heights has no key for it.
            let std = toml::Value::from(self.file.surface.heights.standard_deviation());
            let heights = sections.get_mut("surface").and_then(|surface| surface.get_mut("heights"));
            heights.and_then(toml::Value::as_table_mut).map(|heights| heights.insert("std".into(), std));
        }
        warnings.extend(remarks(&sections).into_iter().map(Warning::Implausible));
        warnings.extend(self.unlike_random_surfaces());
        warnings.extend(self.unused_material());
        warnings.extend(self.strain_rate());
        warnings.extend(self.strength_at_low_rates());
        let cells = &self.source.missing_cells;
        if !cells.is_empty() {
            warnings.push(Warning::CellsMissing { cells: cells.clone() });
        }
        warnings
    }

    /// Optional inputs that have their default value: of the query, of the characterisation and of `settings`, as in
    /// `query.contact_life = 1.0`.
    pub fn defaults_in_effect(&self, settings: &Settings) -> Vec<String> {
        let mut defaults = self.file.defaults_in_effect();
        if self.file.temperature.is_none() && !self.table.starts_with("model:") {
            defaults.push("query.temperature = that of the table".into());
        }
        if let Some(measured) = &self.measured {
            let Query { loading, slip_rates, .. } = &self.file.query;
            let list =
                |values: &[f64]| values.iter().map(|x| format!("{x:e}")).collect::<Vec<_>>().join(", ");
            if *loading == NormalLoading::Pressure(report::PRESSURES.to_vec()) {
                defaults.push(format!("query.pressure = [{}]", list(&report::PRESSURES)));
            }
            if slip_rates[..] == report::SLIP_RATES {
                defaults.push(format!("query.slip_rate = [{}]", list(&report::SLIP_RATES)));
            }
            if !measured.cutoff_asked {
                defaults.push(format!("cutoff = {:.4e} m", measured.cutoff));
            }
        }
        if settings.tolerance == Settings::default().tolerance {
            defaults.push(format!("tolerance = {:e}", settings.tolerance));
        }
        defaults
    }

    /// Density, radius and heights that are far from ηRσ_s = 0.0204 √(α − 0.8968) of isotropic Gaussian surfaces (Nayak
    /// 1971, doi 10.1115/1.3451608; see [`Nayak`](crate::topography::nayak::Nayak)), α = 1.5 to 2000; textured and worn
    /// ones have room.
    fn unlike_random_surfaces(&self) -> Option<Warning> {
        const ANY: std::ops::RangeInclusive<f64> = 1e-4..=10.0;
        let Surface { asperity_density, asperity_radius, heights } = &self.file.surface;
        let product = asperity_density * asperity_radius.mean() * heights.standard_deviation();
        (!ANY.contains(&product)).then_some(Warning::UnlikeRandomSurfaces { product })
    }

    /// Constants of the surface file that a table has other values of.
    fn unused_material(&self) -> Vec<Warning> {
        const ROUNDING: f64 = 0.01;
        let constants = |of: &ElasticPlastic| {
            [
                ("youngs_modulus", of.youngs_modulus),
                ("poisson_ratio", of.poisson_ratio),
                ("yield_strength", of.yield_strength),
            ]
        };
        let Some(stated) = &self.file.material else { return Vec::new() };
        let own = ElasticPlastic { youngs_modulus: self.source.youngs_modulus, ..self.source.material };
        let pairs = constants(stated).into_iter().zip(constants(&own));
        pairs
            .filter(|((_, stated), (_, of_table))| (stated - of_table).abs() > ROUNDING * of_table)
            .map(|((key, stated), (_, of_table))| Warning::MaterialUnused { key, stated, of_table })
            .collect()
    }

    /// Keys of the surface file that [`sample`](Self::sample) does not use.
    pub fn unused_by_samples(&self) -> Vec<String> {
        let SurfaceFile { uncertain, uncertain_tables, query, .. } = &self.file;
        [
            ("query.rate_step", query.rate_step.is_some()),
            ("[uncertainty]", !(uncertain.is_empty() && uncertain_tables.is_empty())),
        ]
        .into_iter()
        .filter(|(_, is_given)| *is_given)
        .map(|(key, _)| format!("{key} is not used: `roughsurface predict` computes it"))
        .collect()
    }

    /// Warning of the strain rate at the radius at which the law is most uncertain, where that counts.
    fn strain_rate(&self) -> Option<Warning> {
        const COUNTS: f64 = 0.01;
        let classes = self.file.surface.asperity_radius.classes.iter();
        let of_classes = classes.map(|&(_, radius)| (radius, self.source.law.radius_uncertainty(radius)));
        let (radius, share) = of_classes.max_by(|(_, one), (_, other)| one.total_cmp(other))?;
        (share > COUNTS).then_some(Warning::StrainRate { radius, share })
    }

    /// Warning of a shipped table without rate law, where the rate law of its metal changes static friction.
    fn strength_at_low_rates(&self) -> Option<Warning> {
        const COUNTS: f64 = 0.02;
        let names = shipped::without_and_with_rate_law(&self.table)?;
        let static_friction = |name: &String| {
            let table = shipped::table(name).ok()?;
            Some(table.estimate(Quantity::MuStatic, 1e-4, 20.0, 1.0).ok()?.value)
        };
        let share = static_friction(&names[1])? / static_friction(&names[0])? - 1.0;
        let [_, with_rate_law] = names;
        let table = self.table.clone();
        (share > COUNTS).then_some(Warning::StrengthAtLowRates { table, with_rate_law, share })
    }

    /// Friction with the uncertain parameters, beside the closed forms `compared`, and of a topography at other cut-offs;
    /// `show` is told slips done and in all. Constants of the scene are those of the table.
    pub fn predict(
        &self,
        compared: &[String],
        settings: &Settings,
        show: &(dyn Fn(usize, usize) + Sync),
    ) -> Result<Results, CaseError> {
        let Self { file, source, .. } = self;
        let settings = Settings { scene: source.scene, ..*settings };
        let (law, surface, query) = (source.law.as_ref(), &file.surface, &file.query);
        let mut results = Results::from(predict(law, surface, query, &settings, show)?);
        results.temperature = file.temperature.or(source.initial_temperature);
        if !(file.uncertain.is_empty() && file.uncertain_tables.is_empty()) {
            let tables = (self.table.as_str(), self.interpolate_missing);
            let mut propagated = propagate(file, tables, &results.prediction, &settings, show)?;
            results.prediction.warnings.append(&mut propagated.warnings);
            results.propagated = Some(propagated);
        }
        if let Some(measured) = &self.measured {
            let (here, others) = ((measured.cutoff, surface), self.at_other_cutoffs(measured));
            results.cutoffs = PredictionAtCutoff::around(here, others, law, &results.prediction, &settings);
        }
        results.comparisons = compare(compared, &source.material, surface, query, &settings)?;
        let models = compared.iter().map(String::as_str).chain(self.table.strip_prefix("model:"));
        let warnings = &mut results.prediction.warnings;
        warnings.splice(..0, self.warnings());
        warnings.extend(models.filter_map(|model| caveat(model, &source.material)));
        let interface = source.other_interface.clone().filter(|_| !compared.is_empty());
        warnings.extend(interface.map(|interface| Warning::ComparedInterface { interface }));
        Ok(results)
    }

    /// The surface with other cut-offs of the topography (m), and the same keys in place of those of the summits.
    fn at_other_cutoffs(&self, measured: &Characterization) -> Vec<(f64, Surface)> {
        let surface = |SummitsAtCutoff { cutoff, summits }| {
            let file = self.file.with_text(report::sections_of(&summits)).ok()?;
            Some((cutoff, file.surface))
        };
        measured.summits_at_other_cutoffs().into_iter().filter_map(surface).collect()
    }

    /// Finite surfaces; `show` is told surfaces done and in all.
    pub fn sample(
        &self,
        sampling: &Sampling,
        settings: &Settings,
        show: &(dyn Fn(usize, usize) + Sync),
    ) -> Result<Samples, PredictionError> {
        let (law, surface, query) = (self.source.law.as_ref(), &self.file.surface, &self.file.query);
        let settings = Settings { scene: self.source.scene, ..*settings };
        let mut samples = sample(law, surface, query, sampling, &settings, show)?;
        samples.warnings.splice(..0, self.warnings());
        Ok(samples)
    }
}

/// The surface file of a characterised topography, with `overrides`; `place` is the topography, named in messages, and
/// `name` that of one or both faces.
pub fn surface_of(
    found: &Characterization,
    (place, name): (&Path, &str),
    overrides: &[Override],
) -> Result<SurfaceFile, SurfaceFileError> {
    SurfaceFile::parse_with(place, report::surface_file(found, name, None), overrides)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SURFACE: &str = "[surface]\nasperity_density = 1e10\nasperity_radius = 50e-6\n\
        heights = { distribution = \"gaussian\", std = 0.5e-6 }\n[query]\npressure = 1e6\nslip_rate = 1.0\n";

    /// V/a is here the geometric mean of those of the two columns in the block `rate-law` of the chapter "Shipped tables",
    /// and the change their mean: it is linear in ln(V/a).
    #[test]
    fn a_shipped_table_of_strength_at_low_rates_says_what_that_leaves_out() {
        let left_out = |table: &str| {
            let file = SurfaceFile::parse(Path::new("s.toml"), SURFACE.to_owned()).unwrap();
            let warnings = Case::open(file, None, table, false).unwrap().warnings();
            warnings.into_iter().find_map(|warning| match warning {
                Warning::StrengthAtLowRates { with_rate_law, share, .. } => Some((with_rate_law, share)),
                _ => None,
            })
        };
        for (table, share) in [("steel-4340", 0.0965), ("steel-4340-rigid", 0.0965), ("copper", 0.2635)] {
            let (with_rate_law, found) = left_out(table).unwrap();
            let metal = table.trim_end_matches("-rigid");
            assert_eq!(with_rate_law, format!("{metal}-rate"));
            assert!((found - share).abs() < 0.01, "{table}: {found}");
        }
        assert_eq!(left_out("steel-4340-rate"), None);
        // 1 %.
        assert_eq!(left_out("aluminium-6061"), None);
    }
}
