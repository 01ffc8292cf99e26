//! Friction of a rough surface from the friction of one asperity.
//!
//! A rough surface is a population of spherical summits, their heights (and radii) spread over a
//! distribution, against a smooth rigid flat (Greenwood & Williamson 1966, doi 10.1098/rspa.1966.0242). The
//! response of a single asperity, [`tables::law::AsperityLaw`], is integrated over the heights at each slip;
//! the static friction of the surface is read from the friction–slip curve of the surface, not from the static friction of
//! its asperities, which begin to slide at different slips.
//!
//! Rooms, each depending only on those below it:
//!
//! | room | contents |
//! |---|---|
//! | [`output`] | friction.nc, mc.nc, summary, JSON, report, figures |
//! | [`sampling`] | finite surfaces, uncertain parameters |
//! | [`friction`] | friction–slip curve, static friction, rate dependence, closed forms, regimes |
//! | [`integral`] | integrals over heights and radii, separation |
//! | [`topography`] | readers, spectrum, summits of a measured map or profile |
//! | [`surface`] | heights, radii, surface file |
//!
//! ```
//! use roughsurface::friction::{Settings, predict};
//! use roughsurface::output::{Origin, Results, figure::figure, friction_file};
//! use roughsurface::surface::file::SurfaceFile;
//! use tables::closed_forms::closed_form;
//!
//! let text = r#"
//! [surface]
//! asperity_density = 1e8       # 1/m2
//! asperity_radius = 1e-3       # m
//! heights = { distribution = "gaussian", std = 0.4e-6 }
//! [query]
//! pressure = [1e6, 1e7]        # nominal, Pa
//! slip_rate = [1.0]            # m/s
//! [material]
//! youngs_modulus = 205e9
//! poisson_ratio = 0.29
//! yield_strength = 792e6
//! "#;
//! let file = SurfaceFile::parse("this example".as_ref(), text.to_owned())?;
//! let law = closed_form("jackson-green", file.material.as_ref().unwrap())?;
//! let prediction = predict(law.as_ref(), &file.surface, &file.query, &Settings::default(), &|_, _| ())?;
//! let static_friction = prediction.friction[0][0].mu_static;
//! assert!(static_friction.value > 0.2 && static_friction.value < 0.6, "{static_friction:?}");
//!
//! // The figure and the file.
//! let results = Results::from(prediction);
//! assert!(figure(&results).svg().contains("Friction coefficient"));
//! let path = std::env::temp_dir().join(format!("roughsurface-example-{}.nc", std::process::id()));
//! let origin = Origin { surface: &file.text, table: "model:jackson-green", history: "an example" };
//! friction_file::write(&path, &results, &origin)?;
//! # std::fs::remove_file(&path)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Not modelled: merging of contacts, interaction of asperities beyond their mean pressure, adhesion.

/// For tests: an iterator over the warnings that match a pattern, with the value of the expression behind it.
#[cfg(test)]
macro_rules! matching {
    ($warnings:expr, $pattern:pat => $value:expr) => {
        $warnings.iter().filter_map(|warning| if let $pattern = warning { Some($value) } else { None })
    };
}

pub mod friction;
pub mod integral;
pub mod output;
pub mod sampling;
pub mod surface;
pub mod topography;

#[doc = include_str!("worked_examples.md")]
pub mod worked_examples {}
