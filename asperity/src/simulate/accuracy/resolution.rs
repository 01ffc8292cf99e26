//! Resolutions: mesh, collocation angles and increments by the accuracy of the scene, and those of the
//! auxiliary runs.

use tables::quantity::{COVERAGE_FACTOR, Quantity};

use crate::discretisation::mesh::{GROWTH_ZONE, MeshSize, SURFACE_LAYER};
use crate::heat::conduction::sublayers::thickness_ratio;
use crate::loading::NEWTON_TOLERANCE;
use crate::scene::Numerics;
use crate::simulate::accuracy::scatter::scatter;

/// Increments of the press times Γ, the growth of those of the slide. From Γ = 0.3 to 0.6 friction changes by 0.03
/// and 0.06 per cent at 2 and 20 omega_c, and by 0.15 to 0.3 at 50 and 100 (8 elements, slip rate 0).
const PRESS_INCREMENTS: f64 = 18.0;
/// Finest resolution chosen by an accuracy.
const MOST_ELEMENTS: usize = 48;
const MOST_SECTORS: usize = 16;
const LEAST_GROWTH: f64 = 0.05;
/// Share of the accuracy that the part of angles or increments of a run to be refined may have.
pub const MOST_OF_STEPS: f64 = 0.4;
/// Factor of the room for a contact that outgrows its mesh.
const WIDER: f64 = 1.5;

/// Relative parts of the reported error that a finer resolution or a smaller tolerance reduces, of the worst of the quantities
/// controlled by the accuracy.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RelativeParts {
    pub mesh: f64,
    pub sectors: f64,
    pub steps: f64,
    pub solver: f64,
}

impl RelativeParts {
    pub fn total(&self) -> f64 {
        self.mesh.hypot(self.others())
    }

    /// All but the mesh's.
    fn others(&self) -> f64 {
        self.sectors.hypot(self.steps).hypot(self.solver)
    }

    /// Whether the accuracy is out of reach of a finer resolution: the solver's part alone is above it. Such a quantity
    /// depends on the tolerance of equilibrium, as the body hardly resists more than the interface transmits.
    pub fn solver_exceeds(&self, accuracy: f64) -> bool {
        self.solver > accuracy
    }
}

/// How finely a run is divided, in each direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// n_c.
    pub elements_per_radius: usize,
    /// N_θ.
    pub sectors: usize,
    /// Room of the mesh for the contact to grow, see [`crate::discretisation::mesh::MeshSize`].
    pub growth_zone: f64,
    /// How often the layer at the surface is halved, see [`thermal_layer_refinements`].
    pub thermal_layer_refinements: u32,
    /// Γ, growth of the increments of the slide; those of the press follow from it.
    pub increment_growth: f64,
    /// Relative residual at which a step counts as solved.
    pub tolerance: f64,
}

impl Resolution {
    /// Resolution that the scene gives, and for the rest a first choice by the accuracy.
    pub fn choose(numerics: &Numerics) -> Self {
        let accuracy = numerics.accuracy;
        let from_accuracy = (10.0 * (0.02 / accuracy).powf(0.6)).round() as usize;
        let from_accuracy = from_accuracy.clamp(6, 32).next_multiple_of(2);
        let sectors = numerics.sectors.unwrap_or(if accuracy >= 0.01 { 4 } else { 8 });
        let increment_growth = 0.3 * (accuracy / 0.02).sqrt().clamp(0.3, 1.5);
        Self {
            elements_per_radius: numerics.elements_per_radius.unwrap_or(from_accuracy),
            sectors,
            growth_zone: GROWTH_ZONE,
            thermal_layer_refinements: 0,
            increment_growth,
            tolerance: NEWTON_TOLERANCE,
        }
    }

    /// This resolution on a mesh as fine as the scatter of friction alone requires, which is large in light contacts; what the
    /// scene gives stays.
    pub fn for_scatter(self, numerics: &Numerics, interference: f64) -> Self {
        /// Share of the accuracy that the scatter may take.
        const SHARE: f64 = 0.85;
        let elements = self.elements_per_radius;
        let error = COVERAGE_FACTOR * scatter(Quantity::Mu, interference, elements);
        let allowed = SHARE * numerics.accuracy;
        if error <= allowed || numerics.elements_per_radius.is_some() {
            return self;
        }
        let wanted = (elements as f64 * error / allowed).ceil() as usize;
        self.on_mesh(wanted.next_multiple_of(2).min(MOST_ELEMENTS))
    }

    fn on_mesh(&self, elements_per_radius: usize) -> Self {
        Self { elements_per_radius, ..*self }
    }

    pub fn press_increments(&self) -> usize {
        (PRESS_INCREMENTS / self.increment_growth).round() as usize
    }

    /// Size of a mesh that is laid out for a contact radius, over R.
    pub fn mesh_size(&self, contact_radius: f64) -> MeshSize {
        let Self { elements_per_radius, growth_zone, thermal_layer_refinements, .. } = *self;
        MeshSize { contact_radius, elements_per_radius, growth_zone, thermal_layer_refinements }
    }

    /// Whether slides at both resolutions start from one press, which depends on the meridian mesh and its increments.
    pub fn shares_press(&self, other: &Self) -> bool {
        self.elements_per_radius == other.elements_per_radius
            && self.growth_zone == other.growth_zone
            && self.thermal_layer_refinements == other.thermal_layer_refinements
            && self.press_increments() == other.press_increments()
    }

    /// This resolution on a mesh half as fine; for the coarsest meshes, which have no coarser ones, on one and a half
    /// times as fine a mesh.
    pub fn coarse(&self) -> Self {
        self.on_mesh(match self.elements_per_radius {
            n @ ..6 => n + n / 2,
            n => (n / 2).max(4),
        })
    }

    /// Resolutions of the auxiliary runs: on the coarse mesh unchanged, with another N_θ, with longer increments and a looser
    /// solver.
    pub fn auxiliary(&self) -> [Self; 3] {
        let coarse = self.coarse();
        [coarse, coarse.other_sectors(), coarse.longer_steps().looser_solver()]
    }

    /// This resolution with more room for the contact to grow.
    pub fn wider(&self) -> Self {
        Self { growth_zone: WIDER * self.growth_zone, ..*self }
    }

    /// This resolution with another N_θ: the next finer where this is the coarsest.
    pub fn other_sectors(&self) -> Self {
        Self { sectors: if self.sectors < 8 { 8 } else { (self.sectors / 2).next_multiple_of(4) }, ..*self }
    }

    /// This resolution with increments twice as large.
    pub fn longer_steps(&self) -> Self {
        Self { increment_growth: 2.0 * self.increment_growth, ..*self }
    }

    /// This resolution with a looser tolerance of the solver.
    pub fn looser_solver(&self) -> Self {
        Self { tolerance: 10.0 * self.tolerance, ..*self }
    }

    /// This resolution on a mesh `factor` times as fine.
    pub fn finer_mesh(&self, factor: usize) -> Self {
        self.on_mesh(factor * self.elements_per_radius)
    }

    /// This resolution with increments of press and slide `factor` times shorter.
    pub fn shorter_steps(&self, factor: usize) -> Self {
        Self { increment_growth: self.increment_growth / factor as f64, ..*self }
    }

    /// Whether `next` is finer than it in a direction in which it is finer than `before`: what a refinement of the angles gained
    /// says nothing of one of the mesh.
    pub fn is_refined_likewise(&self, before: &Self, next: &Self) -> bool {
        std::iter::zip(self.is_finer(before), next.is_finer(self)).any(|(once, again)| once && again)
    }

    /// Whether it is finer than another in the mesh, the angles and the increments.
    fn is_finer(&self, than: &Self) -> [bool; 3] {
        [
            self.elements_per_radius > than.elements_per_radius,
            self.sectors > than.sectors,
            self.increment_growth < than.increment_growth,
        ]
    }

    /// This resolution with more sectors and shorter increments where those alone would make too large a part
    /// (relative) of the error.
    pub fn refine_other_than_mesh(&self, numerics: &Numerics, parts: &RelativeParts) -> Self {
        const SHARE: f64 = 0.6;
        if parts.solver_exceeds(numerics.accuracy) {
            return *self;
        }
        self.refine_above(SHARE * numerics.accuracy, numerics, parts)
    }

    /// This resolution with more sectors and shorter increments where the part of either (relative) is above `most`.
    fn refine_above(&self, most: f64, numerics: &Numerics, parts: &RelativeParts) -> Self {
        let mut finer = *self;
        if parts.sectors > most && numerics.sectors.is_none() && self.sectors < MOST_SECTORS {
            finer.sectors *= 2;
        }
        if parts.steps > most && self.increment_growth > LEAST_GROWTH {
            finer.increment_growth *= 0.5;
        }
        finer
    }

    /// A resolution at which the error should be `accuracy`, given its parts (relative) at this one;
    /// none if that is met, or fixed by the scene or the limits.
    pub fn refine(&self, numerics: &Numerics, parts: &RelativeParts) -> Option<Self> {
        let accuracy = numerics.accuracy;
        if parts.total() <= accuracy || parts.solver_exceeds(accuracy) {
            return None;
        }
        let finer = self.refine_above(MOST_OF_STEPS * accuracy, numerics, parts);
        let after = RelativeParts {
            sectors: parts.sectors * (self.sectors as f64 / finer.sectors as f64).powi(2),
            steps: parts.steps * (finer.increment_growth / self.increment_growth),
            ..*parts
        };
        let mut elements = self.elements_per_radius;
        let allowed = (accuracy.powi(2) - after.others().powi(2)).max(0.0).sqrt().max(0.6 * accuracy);
        if parts.mesh > allowed && numerics.elements_per_radius.is_none() {
            // Slightly finer than order 1, that of the scatter, requires.
            let wanted = 1.1 * elements as f64 * parts.mesh / allowed;
            elements = (wanted.ceil() as usize).clamp(elements + 2, 2 * elements).next_multiple_of(2);
            elements = elements.min(MOST_ELEMENTS).max(self.elements_per_radius);
        }
        let finer = finer.on_mesh(elements);
        (finer != *self).then_some(finer)
    }
}

/// How often the layer of elements at the surface is halved, whatever n_c: until it is no thicker than 4/n_c
/// of the layer that frictional heat reaches while the flat passes over the contact, √(κa/V) = a/√Pe. Under the
/// interface the body softens in that layer, and yields there.
pub fn thermal_layer_refinements(peclet: f64) -> u32 {
    const MOST: f64 = 6.0;
    (peclet.sqrt() / 8.0).log2().ceil().clamp(0.0, MOST) as u32
}

/// Number of parts that the layer of elements at the surface is divided into for conduction, whatever n_c: the smallest
/// for which the thinnest is no thicker than 2/n_c of the depth `depth` (over a) that frictional heat reaches before
/// sliding begins; at most 24.
pub fn thermal_sublayers(depth: f64, refinements: u32) -> u32 {
    const MOST: u32 = 24;
    let layer = SURFACE_LAYER * 0.5f64.powi(refinements as i32);
    (1..MOST).find(|&count| layer <= 2.0 * depth * thickness_ratio(count)).unwrap_or(MOST)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discretisation::mesh::MeridianMesh;

    const NUMERICS: Numerics = Numerics { accuracy: 0.02, elements_per_radius: None, sectors: None };

    /// The first layer under the surface is thinner than the heated one, and no thinner than needed.
    #[test]
    fn layers_at_the_surface_follow_the_heat() {
        let contact_radius = 0.01;
        for elements_per_radius in [4, 8, 16] {
            for peclet in [0.0, 1.0, 64.0, 65.0, 400.0, 5e3] {
                let thermal_layer_refinements = thermal_layer_refinements(peclet);
                let size = MeshSize {
                    thermal_layer_refinements,
                    ..MeshSize::new(contact_radius, elements_per_radius)
                };
                let mesh = MeridianMesh::new(size);
                // Below the apex, which is the first ring of the block.
                let below = mesh.nodes.iter().filter(|node| node[0] == 0.0 && node[1] < 0.0);
                let thickness = below.map(|node| -node[1]).fold(f64::INFINITY, f64::min);
                let heated = contact_radius / peclet.sqrt();
                let most = 4.0 / elements_per_radius as f64 * heated;
                assert!(thickness <= most * (1.0 + 1e-9), "{elements_per_radius} {peclet}");
                assert!(
                    thermal_layer_refinements == 0 || thickness > 0.49 * most,
                    "{elements_per_radius} {peclet}"
                );
            }
        }
    }

    #[test]
    fn light_contacts_begin_on_a_finer_mesh() {
        let numerics = Numerics { accuracy: 0.01, ..NUMERICS };
        let start = Resolution::choose(&numerics);
        let elements = |interference| start.for_scatter(&numerics, interference).elements_per_radius;
        assert_eq!(elements(10.0), start.elements_per_radius);
        let [fine, coarse] = [elements(0.1), elements(0.2)];
        assert!(fine > coarse && coarse > start.elements_per_radius, "{fine} {coarse}");
        assert!(COVERAGE_FACTOR * scatter(Quantity::Mu, 0.1, fine) < 0.85 * numerics.accuracy);
        let fixed = Numerics { elements_per_radius: Some(8), ..numerics };
        assert_eq!(Resolution::choose(&fixed).for_scatter(&fixed, 0.1).elements_per_radius, 8);
    }

    #[test]
    fn nothing_is_refined_where_the_solver_decides() {
        let start = Resolution::choose(&NUMERICS);
        let parts = |solver| RelativeParts { mesh: 0.05, sectors: 0.02, steps: 0.02, solver };
        assert!(start.refine(&NUMERICS, &parts(0.01)).is_some());
        assert_ne!(start.refine_other_than_mesh(&NUMERICS, &parts(0.01)), start);
        assert_eq!(start.refine(&NUMERICS, &parts(0.03)), None);
        assert_eq!(start.refine_other_than_mesh(&NUMERICS, &parts(0.03)), start);
    }

    /// The thinnest layer is 2/n_c of the heated depth, and no thinner than needed.
    #[test]
    fn sublayers_follow_the_heat_of_inception() {
        assert_eq!(thermal_sublayers(0.25, 0), 1);
        for (depth, refinements) in [(0.1, 0), (0.02, 0), (0.02, 2), (1e-3, 3)] {
            let count = thermal_sublayers(depth, refinements);
            let thinnest = |count: u32| 0.5f64.powi(refinements as i32 + 1) / thickness_ratio(count);
            assert!(thinnest(count) <= 2.0 * depth && thinnest(count - 1) > 2.0 * depth, "{depth} {count}");
        }
    }

    #[test]
    fn refinements_are_compared_in_their_own_direction() {
        let start = Resolution::choose(&NUMERICS);
        let ways: [fn(&Resolution) -> Resolution; 3] = [
            |now| now.finer_mesh(2),
            |now| Resolution { sectors: 2 * now.sectors, ..*now },
            |now| now.shorter_steps(2),
        ];
        for (i, first) in ways.iter().enumerate() {
            let once = first(&start);
            for (j, second) in ways.iter().enumerate() {
                assert_eq!(once.is_refined_likewise(&start, &second(&once)), i == j, "{i} {j}");
            }
            // Both ways at once repeat the first.
            assert!(once.is_refined_likewise(&start, &ways.iter().fold(once, |now, finer| finer(&now))));
        }
    }

    #[test]
    fn a_run_is_refined_in_what_it_lacks() {
        let run = Resolution::choose(&NUMERICS);
        let with = |mesh: f64, sectors: f64, steps: f64| {
            run.refine(&NUMERICS, &RelativeParts { mesh, sectors, steps, ..Default::default() })
        };
        assert!(with(0.01, 0.005, 0.004).is_none());
        let finer = with(0.04, 0.0, 0.0).unwrap();
        assert!(finer.elements_per_radius as f64 >= run.elements_per_radius as f64 * 2.0);
        assert_eq!((finer.sectors, finer.increment_growth), (run.sectors, run.increment_growth));
        let finer = with(0.0, 0.03, 0.0).unwrap();
        assert_eq!((finer.sectors, finer.elements_per_radius), (2 * run.sectors, run.elements_per_radius));
        let finer = with(0.0, 0.0, 0.03).unwrap();
        assert_eq!((finer.increment_growth, finer.sectors), (0.5 * run.increment_growth, run.sectors));
        // What the scene fixes stays.
        let fixed = Numerics { elements_per_radius: Some(8), ..NUMERICS };
        let run = Resolution::choose(&fixed);
        let parts = RelativeParts { mesh: 0.04, ..Default::default() };
        assert!(run.refine(&fixed, &parts).is_none());
    }
}
