//! Two rough faces in contact as one: the surface whose heights are the sum of theirs, against a smooth flat, which has
//! the same gap (Greenwood & Tripp 1970, doi 10.1243/PIME_PROC_1970_185_069_02).

use super::Topography;
use super::characterize::{Characterization, Options, SummitsAtCutoff, TwoFaces, characterize, summits_of};
use super::nayak::Nayak;
use super::warning::Warning;
use tables::numbers::plain;

/// A face with an error, 0 or 1, and the error.
pub type FaceError = (usize, String);

/// Change of summit density or radius by the direction of the lays that is not warned about.
const LITTLE: f64 = 0.05;

/// Characterises two independent `faces` with one cut-off, unless given the longer of both reliability limits; their
/// lays are parallel.
pub fn characterize_both(faces: [Topography; 2], options: &Options) -> Result<Characterization, FaceError> {
    let alone = |index: usize, cutoff: Option<f64>| {
        let found = characterize(faces[index].clone(), &Options { cutoff, ..*options });
        found.map_err(|what| (index, what))
    };
    let found = [alone(0, options.cutoff)?, alone(1, options.cutoff)?];
    let longest = found[0].cutoff.max(found[1].cutoff);
    let with_longest = |(index, found): (usize, Characterization)| match found.cutoff < longest {
        true => alone(index, Some(longest)).map_err(|(index, what)| {
            (
                index,
                format!("{what}; it is the default of the other face, give one that both allow as --cutoff"),
            )
        }),
        false => Ok(found),
    };
    let [face, other_face] = found;
    let (mut face, mut other_face) = (with_longest((0, face))?, with_longest((1, other_face))?);
    (face.cutoff_asked, other_face.cutoff_asked) = (options.cutoff.is_some(), options.cutoff.is_some());
    on_each_other(face, other_face).map_err(|what| (0, what))
}

/// Two faces, both of which have been characterised with the same cut-off.
pub fn on_each_other(
    mut face: Characterization,
    other_face: Characterization,
) -> Result<Characterization, String> {
    if face.two_faces.is_some() || other_face.two_faces.is_some() {
        return Err("is of two faces already; a contact has no third one".into());
    }
    let [cutoff, other] = [face.cutoff, other_face.cutoff];
    if cutoff != other {
        let [cutoff, other] = [cutoff, other].map(plain);
        return Err(format!("cutoff = {cutoff} m: that of the other face is {other} m; give both the same"));
    }
    let moments = face.moments.of_sum(&other_face.moments, false);
    let crossed = face.moments.of_sum(&other_face.moments, true);
    let summits = summits_of(&moments)?;
    let crossed = Nayak::of(&crossed)
        .map(|crossed| [crossed.density / summits.density, crossed.radius / summits.radius])
        .filter(|ratios| ratios.iter().any(|ratio| (ratio - 1.0).abs() > LITTLE));
    let other_cutoffs = face.other_cutoffs.iter().filter_map(|at| {
        let other = other_face.other_cutoffs.iter().find(|other| other.cutoff == at.cutoff)?;
        let summits = Nayak::of(&at.moments.of_sum(&other.moments, false))?;
        Some(SummitsAtCutoff { cutoff: at.cutoff, summits })
    });
    let other_cutoffs = other_cutoffs.collect();
    face.warnings.extend(other_face.warnings.iter().cloned().map(Box::new).map(Warning::OtherFace));
    face.warnings.extend(crossed.map(|[density, radius]| Warning::ParallelLays { density, radius }));
    face.two_faces = Some(Box::new(TwoFaces { other_face, moments, summits, other_cutoffs }));
    Ok(face)
}

#[cfg(test)]
mod tests {
    use super::super::moments::Moments;
    use super::super::spectrum::Window;
    use super::super::synthetic::{SelfAffine, at, cosine};
    use super::*;

    /// A face stretched by the square root of the factor along its rows and compressed across them.
    fn stretched(map: &Topography, factor: f64) -> Topography {
        let (row_step, column_step) = (map.row_step / factor.sqrt(), map.column_step * factor.sqrt());
        Topography { row_step, column_step, ..map.clone() }
    }

    #[track_caller]
    fn near(found: &Nayak, exact: &Nayak, allowed: f64) {
        for (found, exact) in
            [(found.density, exact.density), (found.radius, exact.radius), (found.std, exact.std)]
        {
            assert!((found / exact - 1.0).abs() < allowed, "{found:e} {exact:e}");
        }
    }

    #[test]
    fn two_faces_have_the_summits_of_the_sum_of_their_heights() {
        let rough = SelfAffine { points: 512, shortest_pixels: 2.0, ..SelfAffine::default() };
        let [one, mut two] = [rough.map(1), SelfAffine { hurst: 0.5, ..rough }.map(2)];
        // The other face is half as rough.
        let factor = 0.5 * (one.mean_square() / two.mean_square()).sqrt();
        two.heights.iter_mut().for_each(|height| *height *= factor);
        for stretch in [1.0, 3.0] {
            let [one, two] = [&one, &two].map(|map| stretched(map, stretch));
            let heights = one.heights.iter().zip(&two.heights).map(|(one, two)| one + two).collect();
            let sum = Topography { heights, ..one.clone() };
            let options = at(8.0 * one.pixel());
            let both = characterize_both([one, two], &options).unwrap();
            let exact = characterize(sum, &options).unwrap();
            near(both.in_contact().1, &exact.summits, 0.03);
            let others = both.summits_at_other_cutoffs();
            assert_eq!(others.len(), 2);
            for (found, exact) in others.iter().zip(&exact.other_cutoffs) {
                assert_eq!(found.cutoff, exact.cutoff);
                near(&found.summits, &exact.summits, 0.04);
            }
            // Crossed lays make a surface with more curvature, which is said.
            let lays = matching!(both.warnings, Warning::ParallelLays { radius, .. } => *radius).next();
            match stretch {
                1.0 => assert_eq!(lays, None),
                _ => assert!(lays.is_some_and(|radius| radius < 0.9), "{lays:?}"),
            }
        }
    }

    /// Waves of other lengths or directions have no mean product: moments of their sum are exact.
    #[test]
    fn lays_add_by_their_directions() {
        let sum = |waves: &[(usize, usize)]| {
            let maps: Vec<Topography> = waves.iter().map(|waves| cosine(64, 80, *waves).0).collect();
            let heights = |place: usize| maps.iter().map(|map| map.heights[place]).sum();
            Topography { heights: (0..64 * 80).map(heights).collect(), ..maps[0].clone() }
        };
        let moments = |waves: &[(usize, usize)]| Moments::of(&sum(waves), Window::Hann, 1e-6);
        // Two are steeper along their rows, the third along its columns.
        let [one, two, turned] = [[(0, 9), (2, 0)], [(0, 7), (1, 0)], [(0, 4), (6, 0)]];
        for (other, crossed) in [(two, false), (turned, true)] {
            let added = moments(&one).of_sum(&moments(&other), crossed);
            let exact = moments(&[one, other].concat()).isotropic;
            for (added, exact) in [(added.m0, exact.m0), (added.m2, exact.m2), (added.m4, exact.m4)] {
                assert!((added / exact - 1.0).abs() < 1e-9, "{added:e} {exact:e}");
            }
        }
    }

    #[test]
    fn faces_that_do_not_go_together_are_refused() {
        let map = SelfAffine { points: 512, shortest_pixels: 2.0, ..SelfAffine::default() }.map(1);
        let step = 200.0 * map.row_step;
        let far = Topography { row_step: step, column_step: step, ..map.clone() };
        let (index, what) = characterize_both([map.clone(), far], &Options::default()).unwrap_err();
        assert!(index == 0 && what.contains("it is the default of the other face"), "{what}");
        let one = characterize(map.clone(), &at(8.0 * map.pixel())).unwrap();
        let both = on_each_other(one.clone(), one.clone()).unwrap();
        for (face, other) in [(both.clone(), one.clone()), (one.clone(), both)] {
            assert!(on_each_other(face, other).unwrap_err().contains("two faces already"));
        }
        let other = characterize(map.clone(), &at(9.0 * map.pixel())).unwrap();
        assert!(on_each_other(one, other).unwrap_err().contains("that of the other face is 9e-7 m"));
    }

    #[test]
    fn both_faces_have_the_cutoff_of_the_coarser_measurement() {
        let map = SelfAffine { points: 512, shortest_pixels: 2.0, ..SelfAffine::default() }.map(1);
        let coarse =
            Topography { row_step: 3.0 * map.row_step, column_step: 3.0 * map.column_step, ..map.clone() };
        for faces in [[map.clone(), coarse.clone()], [coarse.clone(), map.clone()]] {
            let both = characterize_both(faces, &Options::default()).unwrap();
            let of_other = both.two_faces.as_ref().unwrap().other_face.cutoff;
            assert_eq!(
                (both.cutoff, of_other, both.cutoff_asked),
                (4.0 * coarse.pixel(), 4.0 * coarse.pixel(), false)
            );
            let no_cutoff = |warning: &Warning| match warning {
                Warning::OtherFace(warning) => matches!(**warning, Warning::NoCutoff { .. }),
                warning => matches!(warning, Warning::NoCutoff { .. }),
            };
            assert_eq!(both.warnings.iter().filter(|warning| no_cutoff(warning)).count(), 1);
        }
        let (index, what) = characterize_both([coarse, map.clone()], &at(4.0 * map.pixel())).unwrap_err();
        assert!(index == 0 && what.starts_with("cutoff = 4e-7 m"), "{index}: {what}");
    }
}
