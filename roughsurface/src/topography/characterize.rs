//! Parameters of a rough surface from a topography.

use super::moments::{Isotropic, Moments};
use super::nayak::{Nayak, SMALLEST_ALPHA};
use super::spectrum::{LONGEST_CUTOFF, Limit, NOISY, Spectrum, Window};
use super::summits::{self, Summits};
use super::warning::{UNIT_REMEDY, Warning};
use super::{Topography, detrend, plausibility};
use tables::numbers::plain;

pub use detrend::Detrend;

/// Settings of a characterisation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Options {
    /// Short-wavelength cut-off, m; the reliability limit unless given.
    pub cutoff: Option<f64>,
    /// Trend that is taken off: unless given the mean plane, of a periodic topography the mean height.
    pub detrend: Option<Detrend>,
    pub window: Window,
}

/// Result of a characterisation.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Characterization {
    /// Points across and along rows; (1, n) for a profile.
    pub points: (usize, usize),
    /// Longest step of the grid, m.
    pub pixel: f64,
    /// Extent across and along rows, m.
    pub size: (f64, f64),
    /// Whether the topography continues at its other side.
    pub periodic: bool,
    /// Trend taken off.
    pub detrend: Detrend,
    /// Cut-off used, m, and whether it was given.
    pub cutoff: f64,
    pub cutoff_asked: bool,
    /// Shortest wavelength resolved by the measurement, m, and its reason.
    pub reliability_limit: f64,
    pub limited_by: Limit,
    /// Root mean square height without trend and unfiltered (Sq, of a profile Rq), m.
    pub rms_height: f64,
    /// Root mean square slope of the area, √⟨|∇z|²⟩ = √(2 m2), 1; only of a map (ISO 25178-2).
    #[serde(rename = "Sdq")]
    pub areal_slope: Option<f64>,
    /// Root mean square slope of profiles along any direction, √m2, 1 (ISO 21920-2).
    #[serde(rename = "Rdq")]
    pub profile_slope: f64,
    /// Root mean square curvature of profiles along any direction, √m4, 1/m.
    pub rms_curvature: f64,
    pub moments: Moments,
    /// Summits of the Gaussian surface with these moments.
    pub summits: Nayak,
    /// Summits found one by one, on a profile its peaks.
    pub found: Summits,
    /// R with twice the cut-off over R, the influence of the cut-off; none where the topography does not allow that.
    pub radius_at_twice_the_cutoff: Option<f64>,
    /// Moments and summits with half and with twice the cut-off, where the topography allows it.
    pub other_cutoffs: Vec<MomentsAtCutoff>,
    /// Together with the rough face on the other side.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub two_faces: Option<Box<TwoFaces>>,
    /// (wavenumber in rad/m, mean power of a wave in m²).
    #[serde(skip)]
    pub spectrum: Vec<(f64, f64)>,
    pub warnings: Vec<Warning>,
}

/// Moments and summits with another cut-off.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct MomentsAtCutoff {
    /// m.
    pub cutoff: f64,
    pub moments: Moments,
    pub summits: Nayak,
}

/// The face on the other side, and what both have together.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct TwoFaces {
    pub other_face: Characterization,
    /// Moments and summits of the sum of the heights of both.
    pub moments: Isotropic,
    pub summits: Nayak,
    /// Summits with half and with twice the cut-off, where both topographies allow it.
    pub other_cutoffs: Vec<SummitsAtCutoff>,
}

/// Summits in contact with another cut-off.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct SummitsAtCutoff {
    /// m.
    pub cutoff: f64,
    pub summits: Nayak,
}

impl Characterization {
    /// Moments and summits against a smooth flat: of the face, or of the sum of both faces.
    pub fn in_contact(&self) -> (&Isotropic, &Nayak) {
        match &self.two_faces {
            Some(both) => (&both.moments, &both.summits),
            None => (&self.moments.isotropic, &self.summits),
        }
    }

    /// Summits with other cut-offs, of both faces together where there are two.
    pub fn summits_at_other_cutoffs(&self) -> Vec<SummitsAtCutoff> {
        let of_face = |at: &MomentsAtCutoff| SummitsAtCutoff { cutoff: at.cutoff, summits: at.summits };
        match &self.two_faces {
            Some(both) => both.other_cutoffs.clone(),
            None => self.other_cutoffs.iter().map(of_face).collect(),
        }
    }
}

/// Principal mean square slopes that differ by more than this factor make a surface with a lay.
const ISOTROPIC: f64 = 1.5;

/// Smallest number of summits whose statistics are not warned about.
const FEW_SUMMITS: usize = 100;

/// Skewness and excess kurtosis of summit heights that a Gaussian distribution does not describe.
const SKEWED: f64 = 0.5;
const HEAVY_TAILED: f64 = 1.0;

/// Relative rounding error within which positions and cut-offs are equal.
const ROUNDING: f64 = 1e-6;

/// Slope above which lengths may be in different units.
const STEEP: f64 = 2.0;

/// Moments and summits of `topography`, or the error in the cut-off or the heights.
pub fn characterize(mut topography: Topography, options: &Options) -> Result<Characterization, String> {
    plausibility::none_is_marked(&topography)?;
    let mut warnings = topography.remarks.clone();
    warnings.extend(plausibility::seems_periodic(&topography));
    warnings.extend(plausibility::spikes(&topography));
    let usual = if topography.periodic { Detrend::Mean } else { Detrend::Plane };
    let detrend = options.detrend.unwrap_or(usual);
    let rms_height = detrend.level(&mut topography)?;
    warnings.extend(plausibility::edges_jump(&topography, options.window));
    if detrend == Detrend::Plane {
        warnings.extend(plausibility::form(&topography));
    }
    let spectrum = Spectrum::of(&topography, options.window);
    let (reliability_limit, limited_by) = spectrum.reliability_limit();
    let cutoff = options.cutoff.unwrap_or(reliability_limit);

    let (shortest, longest) = cutoffs(&topography);
    if cutoff < shortest || cutoff > longest {
        return Err(refused_cutoff((options.cutoff, cutoff), (shortest, longest), &warnings));
    }
    let moments_at = |cutoff: f64| Moments::of(&topography, options.window, cutoff);
    let moments = moments_at(cutoff);
    let nayak = summits_of(&moments.isotropic)?;
    let other = |cutoff: f64| {
        let is_allowed = (shortest..=longest).contains(&cutoff);
        let moments = is_allowed.then(|| moments_at(cutoff))?;
        Nayak::of(&moments.isotropic).map(|summits| MomentsAtCutoff { cutoff, moments, summits })
    };
    let other_cutoffs: Vec<MomentsAtCutoff> =
        [0.5, 2.0].into_iter().filter_map(|factor| other(factor * cutoff)).collect();
    let longer = other_cutoffs.iter().find(|other| other.cutoff > cutoff);
    let areal_slope = (!topography.is_profile()).then(|| (2.0 * moments.m2).sqrt());
    let mut characterization = Characterization {
        points: (topography.rows, topography.columns),
        pixel: topography.pixel(),
        size: topography.size(),
        periodic: topography.periodic,
        detrend,
        cutoff,
        cutoff_asked: options.cutoff.is_some(),
        reliability_limit,
        limited_by,
        rms_height,
        areal_slope,
        profile_slope: moments.m2.sqrt(),
        rms_curvature: moments.m4.sqrt(),
        moments,
        summits: nayak,
        found: summits::find(&topography, options.window, cutoff),
        radius_at_twice_the_cutoff: longer.map(|longer| longer.summits.radius / nayak.radius),
        other_cutoffs,
        two_faces: None,
        spectrum: spectrum.radial(),
        warnings,
    };
    let limits = limits(&characterization, &spectrum);
    characterization.warnings.extend(limits);
    Ok(characterization)
}

/// Shortest and longest cut-off that a topography allows, m.
fn cutoffs(topography: &Topography) -> (f64, f64) {
    (2.0 * topography.pixel(), LONGEST_CUTOFF * topography.shorter_extent())
}

/// Summits from the moments, or why there are none.
pub(super) fn summits_of(moments: &Isotropic) -> Result<Nayak, String> {
    let Isotropic { m0, m2, m4 } = *moments;
    if !m2.is_finite() {
        return Err("the heights are so large that their slopes are not finite".into());
    }
    if [m0, m2, m4].iter().any(|moment| *moment < 0.0) {
        return Err(format!(
            "no isotropic surface has the estimated moments m0 = {m0:.2e} m2, m2 = {m2:.2e}, m4 = {m4:.2e} 1/m2: the heights are \
             mostly noise at this cut-off; give another --cutoff, or measure a map in place of a profile"
        ));
    }
    Nayak::of(moments).ok_or_else(|| {
        format!(
            "bandwidth alpha = {:.3}: that of a random surface is finite and at least 0.897; a single wave, waves along \
             one direction only, noise, or too long a cut-off?",
            m0 * m4 / (m2 * m2)
        )
    })
}

/// Why a cut-off is refused; and where metres were assumed, how to change that.
fn refused_cutoff(
    (asked, cutoff): (Option<f64>, f64),
    (shortest, longest): (f64, f64),
    warnings: &[Warning],
) -> String {
    let [cutoff, shortest, longest] = [cutoff, shortest, longest].map(plain);
    if asked.is_none() {
        return format!(
            "the default cut-off, the reliability limit of {cutoff} m, is longer than a quarter of the extent, {longest} m: measure \
             more points, or give a --cutoff"
        );
    }
    let is_unit_assumed =
        |warning: &Warning| matches!(warning, Warning::NoUnit | Warning::Micrometres { .. });
    let assumed = match warnings.iter().any(is_unit_assumed) {
        true => format!("; the file states no unit, metres are assumed: {UNIT_REMEDY}"),
        false => String::new(),
    };
    format!(
        "cutoff = {cutoff} m: must lie between two points, {shortest} m, and a quarter of the extent, {longest} m{assumed}"
    )
}

/// Limits of validity that a result reaches.
fn limits(found: &Characterization, spectrum: &Spectrum) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let (limit, reason, cutoff) = (found.reliability_limit, found.limited_by, found.cutoff);
    if !found.cutoff_asked {
        let radius_at_twice = found.radius_at_twice_the_cutoff;
        warnings.push(Warning::NoCutoff { limit, reason, radius_at_twice });
    } else if cutoff < limit * (1.0 - ROUNDING) {
        warnings.push(Warning::CutoffTooShort { cutoff, limit, reason });
    }
    if let Some(share) = spectrum.noise_share(cutoff).filter(|share| *share > NOISY) {
        warnings.push(Warning::Noise { share: share.min(0.99) });
    }
    let (across, along) = found.moments.principal_slopes;
    if across > ISOTROPIC * along {
        warnings.push(Warning::Lay { ratio: across / along, angle: found.moments.lay_angle });
    }
    let slope = found.areal_slope.unwrap_or(found.profile_slope);
    let uncertain_units = found
        .warnings
        .iter()
        .any(|warning| matches!(warning, Warning::Micrometres { .. } | Warning::Long { .. }));
    if slope > STEEP && !uncertain_units {
        warnings.push(Warning::Steep { slope });
    }
    if found.summits.alpha < SMALLEST_ALPHA {
        warnings.push(Warning::NarrowBand { alpha: found.summits.alpha });
    }
    if found.areal_slope.is_none() {
        warnings.push(Warning::Profile);
    }
    let Summits { count, skewness, kurtosis, .. } = found.found;
    if count < FEW_SUMMITS {
        warnings.push(Warning::FewSummits { count });
    } else if skewness.abs() > SKEWED || (kurtosis - 3.0).abs() > HEAVY_TAILED {
        warnings.push(Warning::NotGaussian { skewness, kurtosis });
    }
    warnings
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::{SelfAffine, at};
    use super::*;

    #[test]
    fn the_cutoff_is_never_the_pixel_without_a_warning() {
        let map = SelfAffine { shortest_pixels: 2.0, ..SelfAffine::default() }.map(1);
        let found = characterize(map.clone(), &Options::default()).unwrap();
        assert_eq!(found.cutoff, 4.0 * map.pixel());
        assert!(matches!(found.warnings[0], Warning::NoCutoff { .. }), "{:?}", found.warnings);
        assert!(found.radius_at_twice_the_cutoff.unwrap() > 1.0);
        let asked = |cutoff: f64| characterize(map.clone(), &at(cutoff));
        assert!(asked(8.0 * map.pixel()).unwrap().warnings.is_empty());
        let fine = asked(3.0 * map.pixel()).unwrap();
        assert!(matches!(fine.warnings[0], Warning::CutoffTooShort { .. }));
        assert!(asked(map.pixel()).unwrap_err().starts_with("cutoff = 1e-7 m: must lie between"));
        assert!(!asked(1.0).unwrap_err().contains("--unit"));
        let assumed = Topography { remarks: vec![Warning::NoUnit], ..map.clone() };
        let error = characterize(assumed, &at(1.0)).unwrap_err();
        assert!(error.contains("states no unit") && error.contains("--unit"), "{error}");
    }

    #[test]
    fn a_periodic_map_is_neither_detrended_by_a_plane_nor_windowed() {
        // Waves as long as the map have slopes that a plane would take off, leaving jumps at the edges.
        let surface = SelfAffine { points: 512, roll_off_pixels: 512.0, ..SelfAffine::default() };
        let map = surface.map(1);
        let cutoff = 8.0 * map.pixel();
        let found = |map: Topography| characterize(map, &at(cutoff)).unwrap();
        let periodic = found(map.clone());
        assert_eq!(periodic.detrend, Detrend::Mean);
        let Moments { m0, m2, m4, .. } = periodic.moments;
        for (n, value) in [(0, m0), (2, m2), (4, m4)] {
            let exact = surface.sum(n, cutoff);
            assert!((value / exact - 1.0).abs() < 1e-9, "m{n}: {value:e} {exact:e}");
        }
        let radius = 0.375 * (std::f64::consts::PI / surface.sum(4, cutoff)).sqrt();
        assert!((periodic.summits.radius / radius - 1.0).abs() < 1e-9);
        let periodic_or_form =
            |warning: &Warning| matches!(warning, Warning::SeemsPeriodic | Warning::Form { .. });
        assert!(!periodic.warnings.iter().any(periodic_or_form), "{:?}", periodic.warnings);
        // Read as a map that ends at its edges, the same heights are recognised.
        let ending = found(Topography { periodic: false, ..map });
        assert_eq!(ending.detrend, Detrend::Plane);
        assert!(ending.warnings.contains(&Warning::SeemsPeriodic), "{:?}", ending.warnings);
    }

    #[test]
    fn a_lay_in_any_direction_is_found() {
        // Waves along one direction only, on top of isotropic roughness: its tensor adds q qᵀ a²/2.
        let map = SelfAffine::default().map(1);
        let cutoff = 8.0 * map.pixel();
        let plain = characterize(map.clone(), &at(cutoff)).unwrap();
        assert!(!plain.warnings.iter().any(|warning| matches!(warning, Warning::Lay { .. })));
        for (waves, angle) in
            [((0, 8), 90.0), ((8, 0), 0.0), ((8, 8), -45.0), ((8, -8), 45.0), ((12, 5), -22.6)]
        {
            let (rows, columns) = (map.rows as f64, map.columns as f64);
            let mut ground = map.clone();
            let q = 2.0 * std::f64::consts::PI * f64::from(waves.0).hypot(f64::from(waves.1)) / map.size().0;
            let passed = crate::topography::filter::transmission(q, cutoff).powi(2);
            // Nine times the slopes of the rest.
            let amplitude = (18.0 * plain.moments.m2 / passed).sqrt() / q;
            for (place, height) in ground.heights.iter_mut().enumerate() {
                let (row, column) = ((place / map.columns) as f64, (place % map.columns) as f64);
                let phase = f64::from(waves.0) * row / rows + f64::from(waves.1) * column / columns;
                *height += amplitude * (2.0 * std::f64::consts::PI * phase).cos();
            }
            let found = characterize(ground, &at(cutoff)).unwrap();
            let (ratio, lay) =
                matching!(found.warnings, Warning::Lay { ratio, angle } => (*ratio, *angle)).next().unwrap();
            assert!((ratio - 10.0).abs() < 1.5, "{waves:?}: {ratio}");
            let off = (lay - angle + 90.0).rem_euclid(180.0) - 90.0;
            assert!(off.abs() < 2.0, "{waves:?}: {lay}");
        }
    }

    #[test]
    fn noise_that_remains_after_the_cutoff_is_stated() {
        let surface = SelfAffine { points: 512, shortest_pixels: 2.0, ..SelfAffine::default() };
        let noise = surface.power(2.0 * std::f64::consts::PI / (12.0 * surface.map(1).pixel()));
        let noisy = surface.with_noise(3, noise);
        let options = at(8.0 * noisy.pixel());
        let found = characterize(noisy, &options).unwrap();
        let clean = surface.sum(4, 8.0 * found.pixel);
        let exact = 1.0 - clean / found.moments.m4;
        let share = matching!(found.warnings, Warning::Noise { share } => *share).next().unwrap();
        assert!((share - exact).abs() < 0.1, "{share} {exact}");
    }

    #[test]
    fn slopes_have_the_names_of_the_standards() {
        let map = SelfAffine::default().map(1);
        let options = at(8.0 * map.pixel());
        let found = characterize(map, &options).unwrap();
        let json = serde_json::json!(found);
        let [sdq, rdq] = ["Sdq", "Rdq"].map(|name| json[name].as_f64().unwrap());
        assert!((sdq / rdq - 2f64.sqrt()).abs() < 1e-12);
        assert!((rdq * rdq / found.moments.m2 - 1.0).abs() < 1e-12);
    }
}
