//! A characterisation as text, as JSON, and as a surface file.

use super::characterize::Characterization;
use super::nayak::Nayak;
use serde_json::{Value, json};
use std::fmt::Write;
use tables::figures::{Axis, Curve, Figure, Panel};
use tables::netcdf::with_checksum;

/// Nominal pressures (Pa) and slip rates (m/s) of the query of a surface file.
pub const PRESSURES: [f64; 3] = [1e5, 1e6, 1e7];
pub const SLIP_RATES: [f64; 3] = [0.1, 1.0, 10.0];

/// Which summits a surface file is written with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum WhichSummits {
    /// Those of the moments, with Gaussian heights.
    Moments,
    /// Those found one by one, with their heights in a separate file.
    Found,
}

/// The characterization as lines of text.
pub fn text(found: &Characterization) -> String {
    let Some(both) = &found.two_faces else { return text_of_face(found) };
    let mut text =
        text_of_face(found) + "\nother face\n\n" + &text_of_face(&both.other_face) + "\nboth faces\n\n";
    let (moments, summits) = found.in_contact();
    for (name, value) in [
        ("m0, m2", format!("{:.4e} m2, {:.4e}", moments.m0, moments.m2)),
        ("m4", format!("{:.4e} 1/m2", moments.m4)),
        ("bandwidth alpha", format!("{:.3}", summits.alpha)),
        ("eta R sigma_s", product(summits)),
        ("density eta, 1/m2", format!("{:.4e}", summits.density)),
        ("radius R, m", format!("{:.4e}", summits.radius)),
        ("standard deviation of heights sigma_s, m", format!("{:.4e}", summits.std)),
        ("mean summit plane above mean plane, m", format!("{:.4e}", summits.mean_summit)),
    ] {
        let _ = writeln!(text, "{name:<44} {value}");
    }
    text
}

fn product(summits: &Nayak) -> String {
    format!("{:.4}", summits.density * summits.radius * summits.std)
}

/// One number where it is the same across and along rows.
fn distance_of_points(found: &Characterization) -> String {
    let ((rows, columns), (height, width)) = (found.points, found.size);
    let [across, along] = [height / rows as f64, width / columns as f64].map(|step| format!("{step:.4e}"));
    match rows == 1 || across == along {
        true => format!("{along} m"),
        false => format!("{across} x {along} m"),
    }
}

fn text_of_face(found: &Characterization) -> String {
    let mut text = String::new();
    let mut line = |name: &str, value: String| {
        let _ = writeln!(text, "{name:<44} {value}");
    };
    let (rows, columns) = found.points;
    let profile = rows == 1;
    line("points", if profile { format!("{columns}") } else { format!("{rows} x {columns}") });
    line("distance of points", distance_of_points(found));
    line("short-wavelength cut-off (Gaussian, 50 %)", format!("{:.4e} m", found.cutoff));
    line(
        "reliability limit",
        format!("{:.4e} m ({:?})", found.reliability_limit, found.limited_by).to_lowercase(),
    );
    let trend = format!("{:?}{}", found.detrend, if found.periodic { ", periodic" } else { "" });
    line("trend taken off", trend.to_lowercase());
    line(
        if profile { "rms height Rq, unfiltered" } else { "rms height Sq, unfiltered" },
        format!("{:.4e} m", found.rms_height),
    );
    if let Some(slope) = found.areal_slope {
        line("rms slope of the area Sdq", format!("{slope:.4e}"));
    }
    line("rms slope of profiles Rdq", format!("{:.4e}", found.profile_slope));
    if !profile {
        let (across, along) = found.moments.principal_slopes;
        line(
            "mean square slopes across and along the lay",
            format!("{across:.4e}, {along:.4e} at {:.0} degrees", found.moments.lay_angle),
        );
    }
    line("rms curvature of profiles", format!("{:.4e} 1/m", found.rms_curvature));
    line("m0", format!("{:.4e} m2", found.moments.m0));
    line("m2", format!("{:.4e}", found.moments.m2));
    line("m4", format!("{:.4e} 1/m2", found.moments.m4));
    let isotropic = found.moments.isotropic;
    line("m2, m4 of the isotropic surface", format!("{:.4e}, {:.4e} 1/m2", isotropic.m2, isotropic.m4));
    line("bandwidth alpha", format!("{:.3}", found.summits.alpha));
    line("eta R sigma_s", product(&found.summits));
    let what = if profile { "peaks found" } else { "summits found" };
    let _ = writeln!(text, "\n{:<44} {:>14}   {:>14}", "summits", "from moments", what);
    let per = if profile { "density eta, 1/m2 (found: 1/m)" } else { "density eta, 1/m2" };
    let (theory, search) = (&found.summits, &found.found);
    for (name, moments, search) in [
        (per, Some(theory.density), search.density),
        ("radius R, m", Some(theory.radius), search.radius),
        ("standard deviation of heights sigma_s, m", Some(theory.std), search.std),
        ("mean summit plane above mean plane, m", Some(theory.mean_summit), search.mean),
        ("skewness of heights", None, search.skewness),
        ("kurtosis of heights", None, search.kurtosis),
    ] {
        let (moments, search) = match moments {
            Some(moments) => (format!("{moments:.4e}"), format!("{search:.4e}")),
            None => ("-".to_owned(), format!("{search:.3}")),
        };
        let _ = writeln!(text, "{name:<44} {moments:>14}   {search:>14}");
    }
    text
}

/// The characterization as JSON; `units` has the unit of every number at its place.
pub fn json(found: &Characterization) -> Value {
    let mut value = json!(found);
    value["units"] = units(found);
    value
}

fn units(found: &Characterization) -> Value {
    let per = if found.points.0 == 1 { "m-1" } else { "m-2" };
    let summits = json!({ "alpha": "1", "density": "m-2", "radius": "m", "std": "m", "mean_summit": "m" });
    let isotropic = json!({ "m0": "m2", "m2": "1", "m4": "m-2" });
    let moments = json!({
        "m0": "m2", "m2": "1", "m4": "m-2", "principal_slopes": "1", "lay_angle": "degree",
        "principal_curvatures": "m-2", "isotropic": isotropic
    });
    let mut units = json!({
        "points": "1",
        "pixel": "m",
        "size": "m",
        "cutoff": "m",
        "reliability_limit": "m",
        "rms_height": "m",
        "Sdq": "1",
        "Rdq": "1",
        "rms_curvature": "m-1",
        "moments": moments,
        "summits": summits,
        "found": {
            "count": "1", "density": per, "radius": "m", "mean": "m", "std": "m", "skewness": "1", "kurtosis": "1"
        },
        "radius_at_twice_the_cutoff": "1",
        "other_cutoffs": { "cutoff": "m", "moments": moments, "summits": summits },
    });
    if let Some(both) = &found.two_faces {
        units["two_faces"] = json!({
            "other_face": self::units(&both.other_face), "moments": isotropic, "summits": summits,
            "other_cutoffs": { "cutoff": "m", "summits": summits }
        });
    }
    units
}

/// The sections of a surface file of summits with that density (1/m²), radius (m) and heights.
fn sections(density: f64, radius: f64, heights: &str) -> String {
    let [low, middle, high] = PRESSURES;
    format!(
        "[surface]\n\
         asperity_density = {density:.6e}   # summits per nominal area, 1/m2\n\
         asperity_radius = {radius:.6e}     # m\n\
         heights = {heights}\n\
         \n\
         [query]\n\
         pressure = [{low:e}, {middle:e}, {high:e}]         # nominal, Pa\n\
         slip_rate = {SLIP_RATES:?}       # m/s\n\
         hold = \"load\"\n"
    )
}

fn gaussian(std: f64) -> String {
    format!("{{ distribution = \"gaussian\", std = {std:.6e} }}")
}

/// The sections of a surface file of summits with Gaussian heights.
pub fn sections_of(summits: &Nayak) -> String {
    sections(summits.density, summits.radius, &gaussian(summits.std))
}

/// A surface file with the summits, ready for `roughsurface predict`, which a comment tells from an edited one; `heights` is the name
/// of the file of the heights of the summits found, where these are chosen.
pub fn surface_file(found: &Characterization, source: &str, heights: Option<&str>) -> String {
    let (moments, summits) = found.in_contact();
    let (density, radius, distribution, mean) = match heights {
        Some(file) => (
            found.found.density,
            found.found.radius,
            format!("{{ distribution = \"sample\", file = {} }}", json!(file)),
            found.found.mean,
        ),
        None => (summits.density, summits.radius, gaussian(summits.std), summits.mean_summit),
    };
    let limit_of_other = found.two_faces.as_ref().map_or(0.0, |both| both.other_face.reliability_limit);
    let limit = found.reliability_limit.max(limit_of_other);
    let plane = if heights.is_some() { "mean plane of the surface" } else { "mean plane of the summits" };
    // A control character could end the comment.
    let source: String = source.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    with_checksum(&format!(
        "# Summits of {source}, written by roughsurface {}\n\
         # Cut-off {:.4e} m, reliability limit {:.4e} m; m0 = {:.4e} m2, m2 = {:.4e}, m4 = {:.4e} 1/m2,\n\
         # bandwidth {:.3}. Mean summit plane {mean:.4e} m above the mean plane of the surface.\n\
         # Separations are counted from the {plane}.\n\
         \n\
         {}\
         \n\
         # For --table model:NAME give the material of the summits:\n\
         # [material]\n\
         # youngs_modulus = 205e9           # Pa\n\
         # poisson_ratio = 0.29\n\
         # yield_strength = 792e6           # Pa\n",
        env!("CARGO_PKG_VERSION"),
        found.cutoff,
        limit,
        moments.m0,
        moments.m2,
        moments.m4,
        summits.alpha,
        sections(density, radius, &distribution),
    ))
}

/// The heights of the summits found, one a line.
pub fn heights_file(found: &Characterization) -> String {
    let mut text = String::from("# Heights of summits above the mean plane of the surface, m\n");
    for height in &found.found.heights {
        let _ = writeln!(text, "{height:.6e}");
    }
    with_checksum(&text)
}

/// Names of the panels of [`figure`].
pub const PANELS: [&str; 2] = ["spectrum", "summits"];

/// Spectrum, and the distribution of the summit heights in comparison with the Gaussian one of the moments.
pub fn figure(found: &Characterization) -> Figure {
    let (q, power): (Vec<f64>, Vec<f64>) = found.spectrum.iter().copied().unzip();
    let wavelength: Vec<f64> = q.iter().map(|q| 2.0 * std::f64::consts::PI / q).collect();
    let filtered = (q.iter().zip(&power))
        .map(|(q, power)| power * super::filter::transmission(*q, found.cutoff).powi(2))
        .collect();
    let (z, measured, gaussian) = distributions(found);
    let spectrum = Panel::new(
        PANELS[0],
        "Spectrum",
        Axis::logarithmic("Wavelength (m)"),
        Axis::logarithmic("Mean power of a wave (m²)"),
        vec![
            Curve::new("measured", wavelength.clone(), power),
            Curve::new("after the cut-off", wavelength, filtered),
        ],
    );
    let summits = Panel::new(
        PANELS[1],
        "Summit heights",
        Axis::linear("Height above the mean plane (µm)"),
        Axis::linear("Share of summits below"),
        vec![Curve::new("found", z.clone(), measured), Curve::new("from moments", z, gaussian)],
    );
    let title = if found.two_faces.is_some() { "First of two faces" } else { "" };
    Figure::new(title, vec![spectrum, summits])
}

/// Heights (µm), share of the summits found below them, and that of the moments.
fn distributions(found: &Characterization) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    const POINTS: usize = 101;
    let heights = &found.found.heights;
    let theory = &found.summits;
    let (Some(highest), Some(lowest)) = (heights.first(), heights.last()) else {
        return Default::default();
    };
    let at = |i: usize| lowest + (highest - lowest) * i as f64 / (POINTS - 1) as f64;
    let z: Vec<f64> = (0..POINTS).map(at).collect();
    let below = |z: &f64| 1.0 - heights.partition_point(|height| height > z) as f64 / heights.len() as f64;
    let gaussian = |z: &f64| 0.5 * libm::erfc(-(z - theory.mean_summit) / (theory.std * 2f64.sqrt()));
    (z.iter().map(|z| 1e6 * z).collect(), z.iter().map(below).collect(), z.iter().map(gaussian).collect())
}
