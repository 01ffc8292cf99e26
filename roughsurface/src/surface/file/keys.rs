//! The keys of the surface file and the rules for single keys.

use super::values::Values;
use crate::surface::heights::HeightsKeys;
use crate::surface::messages::allowed;
use crate::surface::query::{ContactLife, Interaction, LoadingControl};
use crate::surface::radii::{LARGEST_VARIATION, Radii};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use tables::closed_forms::ElasticPlastic;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileKeys {
    pub(super) surface: SurfaceKeys,
    pub(super) query: QueryKeys,
    pub(super) material: Option<ElasticPlastic>,
    pub(super) counterface: Option<BTreeMap<String, f64>>,
    pub(super) uncertainty: Option<UncertaintyKeys>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct UncertaintyKeys {
    pub(super) asperity_density: Option<f64>,
    pub(super) asperity_radius: Option<f64>,
    pub(super) heights_std: Option<f64>,
    pub(super) youngs_modulus: Option<f64>,
    pub(super) poisson_ratio: Option<f64>,
    pub(super) yield_strength: Option<f64>,
    /// Tables of a material of which one constant is raised by its standard deviation.
    #[serde(default)]
    pub(super) tables: BTreeMap<String, PathBuf>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SurfaceKeys {
    pub(super) asperity_density: f64,
    pub(super) asperity_radius: Option<f64>,
    pub(super) radii: Option<RadiiKeys>,
    pub(super) heights: HeightsKeys,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RadiiKeys {
    pub(super) distribution: RadiiDistribution,
    pub(super) std: Option<f64>,
    pub(super) radius: Option<Vec<f64>>,
    pub(super) share: Option<Vec<f64>>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum RadiiDistribution {
    LogNormal,
    Classes,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct QueryKeys {
    pub(super) pressure: Option<Values>,
    pub(super) separation: Option<Values>,
    pub(super) slip_rate: Values,
    #[serde(default)]
    pub(super) hold: LoadingControl,
    #[serde(default)]
    pub(super) contact_life: ContactLife,
    #[serde(default)]
    pub(super) interaction: Interaction,
    pub(super) nominal_size: Option<f64>,
    pub(super) rate_step: Option<RateStepKeys>,
    pub(super) temperature: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RateStepKeys {
    before: f64,
    after: f64,
}

/// The slip rates of the key `rate_step`; contacts that last have no steady state of which all ages are equally likely.
pub(super) fn rate_step_of(
    keys: Option<RateStepKeys>,
    life: ContactLife,
) -> Result<Option<[f64; 2]>, String> {
    let Some(RateStepKeys { before, after }) = keys else { return Ok(None) };
    positive("query.rate_step.before", before, "m/s")?;
    positive("query.rate_step.after", after, "m/s")?;
    match life {
        ContactLife::Diameters(_) => Ok(Some([before, after])),
        ContactLife::Steady => Err("query.rate_step: needs contacts that are replaced by others; give contact_life as a number, not \"steady\"".into()),
    }
}

/// Whether `nominal_size` is positive, and there where the interaction needs it.
pub(super) fn check_nominal_size(interaction: Interaction, size: Option<f64>) -> Result<(), String> {
    const KEY: &str = "query.nominal_size";
    match size {
        Some(size) => positive(KEY, size, "m"),
        None if interaction == Interaction::None => Ok(()),
        None => Err(format!(
            "{KEY}: is missing; interaction = \"mean-pressure\" needs the side of the square nominal area in m"
        )),
    }
}

impl FileKeys {
    /// The other tables of the section `uncertainty`, relative paths in the folder of the surface file.
    pub(super) fn uncertain_tables(&self, folder: &Path) -> Vec<(String, PathBuf)> {
        let tables = self.uncertainty.iter().flat_map(|keys| &keys.tables);
        tables.map(|(key, file)| (key.clone(), folder.join(file))).collect()
    }
}

/// One radius, or the distribution that the keys describe.
pub(super) fn radii_of(mean: Option<f64>, keys: Option<RadiiKeys>) -> Result<Radii, String> {
    let mean_radius = || {
        let mean = mean.ok_or("surface.asperity_radius: is missing")?;
        positive("surface.asperity_radius", mean, "m").map(|()| mean)
    };
    let Some(RadiiKeys { distribution, std, radius, share }) = keys else {
        return Ok(Radii::from(mean_radius()?));
    };
    let useless = |key: &str, given: bool, name: &str| match given {
        true => Err(format!("surface.radii.{key}: has no meaning for the distribution {name}")),
        false => Ok(()),
    };
    match distribution {
        RadiiDistribution::LogNormal => {
            useless("radius", radius.is_some(), "lognormal")?;
            useless("share", share.is_some(), "lognormal")?;
            let mean = mean_radius()?;
            let std = std.ok_or("surface.radii.std: is missing")?;
            positive("surface.radii.std", std, "m")?;
            if std > LARGEST_VARIATION * mean {
                return Err(allowed(
                    "surface.radii.std",
                    format!("{std:e}"),
                    &format!("must not exceed asperity_radius = {mean:e} m"),
                ));
            }
            Ok(Radii::log_normal(mean, std))
        }
        RadiiDistribution::Classes => {
            useless("std", std.is_some(), "classes")?;
            if mean.is_some() {
                return Err("surface.asperity_radius: follows from surface.radii.radius; leave it out".into());
            }
            let (radius, share) = (radius.unwrap_or_default(), share.unwrap_or_default());
            Radii::counted(&radius, &share).ok_or_else(|| {
                "surface.radii: radius (m) and share must be lists of as many positive numbers".into()
            })
        }
    }
}

pub(super) fn positive(key: &str, value: f64, unit: &str) -> Result<(), String> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(allowed(key, value, &format!("must be a positive number ({unit})")))
    }
}
