//! Temperature at the Gauss points and its mean over an element, with the properties that follow from it.

use super::part::Part;
use crate::discretisation::element::{CORNERS, Element, POINTS};
use crate::material::lanes::Lanes;

/// Temperature and temperature-dependent properties at Gauss points side by side.
pub(super) struct PointTemperature<const N: usize> {
    pub(super) rise: Lanes<N>,
    /// No point of the element has a lower softening factor.
    pub(super) weakest: f64,
    /// E(T)/E(T₀) of the element, now and at the end of the step before, unless constant.
    pub(super) stiffness: Option<[Lanes<N>; 2]>,
}

/// Temperature and temperature-dependent properties in one element.
pub(super) struct ElementHeat<const W: usize> {
    pub(super) point_rise: [Lanes<W>; POINTS],
    pub(super) mean_rise: Lanes<W>,
    /// No point has a lower softening factor.
    pub(super) weakest: f64,
    /// E(T)/E(T₀), unless constant.
    pub(super) stiffness: Option<Lanes<W>>,
    /// E(T)/E(T₀) of the element at the end of the previous step.
    stiffness_before: Lanes<W>,
    /// Volumetric thermal strain.
    pub(super) thermal: Lanes<W>,
}

impl<const W: usize> ElementHeat<W> {
    /// Temperatures of the points from `first` on that fill N lanes.
    #[inline(always)]
    pub(super) fn at_points<const N: usize>(&self, first: usize) -> PointTemperature<N> {
        let rise = &self.point_rise.as_flattened()[first * W..];
        let of_element = |values: &Lanes<W>| std::array::from_fn(|l| values[l % W]);
        PointTemperature {
            rise: std::array::from_fn(|l| rise[l]),
            weakest: self.weakest,
            stiffness: self.stiffness.as_ref().map(|now| [now, &self.stiffness_before].map(of_element)),
        }
    }
}

impl Part<'_> {
    /// Temperature and properties in element e; `varying`: whether the moduli depend on temperature.
    #[inline(always)]
    pub(super) fn element_heat<const W: usize>(
        &self,
        e: usize,
        first: usize,
        rise: Option<&[f64]>,
        varying: bool,
    ) -> ElementHeat<W> {
        let element = &self.elements[e];
        let nodal_rise = rise.map(|field| self.mesh.gather_scalar::<W>(field, element, first));
        let (point_rise, mean_rise) = self.temperatures(element, nodal_rise);
        let weakest = nodal_rise.map_or(1.0, |nodal| {
            let hottest = nodal.iter().flatten().fold(0.0f64, |m, &t| m.max(t));
            let coldest = || nodal.iter().flatten().fold(0.0f64, |m, &t| m.min(t));
            self.solid.lowest_softening_factor(coldest, hottest)
        });
        let stiffness = varying.then(|| mean_rise.map(|rise| self.solid.stiffness_factor(rise)));
        let stiffness_before = match varying {
            true => {
                let at = e * self.mesh.sectors.columns() + first;
                std::array::from_fn(|l| self.solid.stiffness_factor(self.committed.rise[at + l]))
            }
            false => [1.0; W],
        };
        let thermal = self.solid.thermal_dilatation(&mean_rise);
        ElementHeat { point_rise, mean_rise, weakest, stiffness, stiffness_before, thermal }
    }

    /// Temperature rise at the Gauss points and its mean over the element.
    #[inline(always)]
    fn temperatures<const W: usize>(
        &self,
        element: &Element,
        nodal: Option<[Lanes<W>; CORNERS]>,
    ) -> ([Lanes<W>; POINTS], Lanes<W>) {
        let mut points = [[0.0; W]; POINTS];
        let mut mean = [0.0; W];
        if let Some(nodal) = nodal {
            for q in 0..POINTS {
                for (n, value) in nodal.iter().enumerate() {
                    for l in 0..W {
                        points[q][l] += self.shapes[q][n] * value[l];
                    }
                }
                for l in 0..W {
                    mean[l] += element.weight[q] / element.volume * points[q][l];
                }
            }
        }
        (points, mean)
    }
}
