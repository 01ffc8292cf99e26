//! Bodies of revolution of the fields on the meridian: hexahedra, and wedges at the axis, with
//! Cartesian components.
//!
//! Displacement, temperature and stress between the angles of the simulation follow from their
//! harmonics, plastic strain linearly, so that it stays within its values.
//!
//! Depends on `crate::loading::body_fields`. Chapter "Other files" of the book.

use std::f64::consts::PI;

use crate::discretisation::body::mises;
use crate::loading::body_fields::{BodyFields, BodySnapshot};

/// How much of the body is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// The simulated half, y ≥ 0.
    Half,
    /// The whole body: the half y ≥ 0 and its mirror image.
    Whole,
}

/// Points and cells of the body before deformation.
#[derive(Clone, Debug, PartialEq)]
pub struct RevolvedBody {
    /// (x, y, z), m; the apex is the origin, the flat moves along x.
    pub points: Vec<[f64; 3]>,
    /// Four corners, then the four opposite to them.
    pub hexahedra: Vec<[usize; 8]>,
    /// A triangle, counter-clockwise as seen from the opposite one, then that.
    pub wedges: Vec<[usize; 6]>,
    planes: Vec<Plane>,
    /// First point of each node, which has one point on the axis and one in each plane elsewhere.
    first: Vec<usize>,
    on_axis: Vec<bool>,
}

/// Values at the points of a [`RevolvedBody`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointFields {
    /// m.
    pub displacement: Vec<[f64; 3]>,
    /// (xx, yy, zz, xy, yz, xz), Pa.
    pub stress: Vec<[f64; 6]>,
    /// Von Mises stress, Pa.
    pub von_mises: Vec<f64>,
    pub plastic_strain: Vec<f64>,
    /// K.
    pub temperature: Vec<f64>,
}

/// A half plane θ = const, and the weights of the values at the angles of the simulation in it.
#[derive(Clone, Debug, PartialEq)]
struct Plane {
    sin: f64,
    cos: f64,
    even: Vec<f64>,
    odd: Vec<f64>,
    linear: Vec<f64>,
}

/// Planes of the half circle: two for each angle of the simulation, and not fewer than this.
const LEAST_PLANES: usize = 24;

impl RevolvedBody {
    pub fn new(body: &BodyFields, extent: Extent) -> Self {
        let half = (2 * body.angles.len()).max(LEAST_PLANES);
        let (count, sectors) = match extent {
            Extent::Half => (half + 1, half),
            Extent::Whole => (2 * half, 2 * half),
        };
        let planes: Vec<Plane> =
            (0..count).map(|k| Plane::new(k as f64 * PI / half as f64, body.angles.len())).collect();
        let (mut points, mut first) = (Vec::new(), Vec::new());
        let on_axis: Vec<bool> = body.nodes.iter().map(|node| node[0] == 0.0).collect();
        for (&[r, z], &on_axis) in body.nodes.iter().zip(&on_axis) {
            first.push(points.len());
            let planes = if on_axis { &planes[..1] } else { &planes };
            points.extend(planes.iter().map(|plane| [r * plane.cos, r * plane.sin, z]));
        }
        let point = |node: u32, k: usize| {
            let node = node as usize;
            first[node] + if on_axis[node] { 0 } else { k % count }
        };
        let (mut hexahedra, mut wedges) = (Vec::new(), Vec::new());
        for quad in &body.quads {
            // Of corners in counter-clockwise order those on the axis are the upper, then the lower.
            let upper = (0..4).find(|&n| [n, n + 1].iter().all(|n| on_axis[quad[n % 4] as usize]));
            for k in 0..sectors {
                match upper {
                    None => {
                        let corner = |n: usize| point(quad[n % 4], if n < 4 { k + 1 } else { k });
                        hexahedra.push(std::array::from_fn(corner));
                    }
                    Some(upper) => {
                        let at = |n: usize, k: usize| point(quad[(upper + n) % 4], k);
                        let (lower, upper) =
                            ([at(1, k), at(2, k), at(2, k + 1)], [at(0, k), at(3, k), at(3, k + 1)]);
                        wedges.push([lower, upper].concat().try_into().expect("six"));
                    }
                }
            }
        }
        Self { points, hexahedra, wedges, planes, first, on_axis }
    }

    /// Fields at the points.
    pub fn fields(&self, snapshot: &BodySnapshot) -> PointFields {
        let columns = snapshot.temperature.len() / self.first.len();
        let mut fields = PointFields::default();
        for (node, &on_axis) in self.on_axis.iter().enumerate() {
            let of = |values: &'_ [f64], components: usize, component: usize| {
                let at = (node * components + component) * columns;
                values[at..at + columns].to_vec()
            };
            let displacement: [_; 3] = std::array::from_fn(|c| of(&snapshot.displacement, 3, c));
            let stress: [_; 6] = std::array::from_fn(|c| of(&snapshot.stress, 6, c));
            let plastic_strain = of(&snapshot.plastic_strain, 1, 0);
            let temperature = of(&snapshot.temperature, 1, 0);
            let planes = if on_axis { &self.planes[..1] } else { &self.planes };
            for plane in planes {
                if on_axis {
                    fields.displacement.push(axis_vector(&displacement));
                    fields.stress.push(axis_tensor(&stress));
                    fields.plastic_strain.push(mean(&plastic_strain));
                    fields.temperature.push(mean(&temperature));
                } else {
                    fields.displacement.push(plane.vector(&displacement));
                    fields.stress.push(plane.tensor(&stress));
                    fields.plastic_strain.push(dot(&plane.linear, &plastic_strain));
                    fields.temperature.push(dot(&plane.even, &temperature));
                }
            }
        }
        fields.von_mises = fields.stress.iter().map(mises).collect();
        fields
    }
}

impl Plane {
    fn new(theta: f64, count: usize) -> Self {
        let n = count as f64;
        let angle = |j: usize| (j as f64 + 0.5) * PI / n;
        let sum = |term: &dyn Fn(f64, f64) -> f64, last: usize, j: usize| -> f64 {
            (1..=last).map(|m| term(m as f64 * theta, m as f64 * angle(j))).sum()
        };
        // Interpolation from the orthogonality of cos mθ, m < n, and of sin mθ, m ≤ n, at the angles.
        let even = |j: usize| (1.0 + 2.0 * sum(&|at, j| at.cos() * j.cos(), count - 1, j)) / n;
        let odd = |j: usize| {
            let last = (n * theta).sin() * (n * angle(j)).sin();
            (2.0 * sum(&|at, j| at.sin() * j.sin(), count - 1, j) + last) / n
        };
        // Mirrored into 0 to π; constant beyond the first and the last angle, as the mirror image is.
        let folded = if theta > PI { 2.0 * PI - theta } else { theta };
        let position = (folded * n / PI - 0.5).clamp(0.0, n - 1.0);
        let linear = |j: usize| (1.0 - (position - j as f64).abs()).max(0.0);
        Self {
            sin: theta.sin(),
            cos: theta.cos(),
            even: (0..count).map(even).collect(),
            odd: (0..count).map(odd).collect(),
            linear: (0..count).map(linear).collect(),
        }
    }

    fn vector(&self, [radial, hoop, axial]: &[Vec<f64>; 3]) -> [f64; 3] {
        let (radial, hoop) = (dot(&self.even, radial), dot(&self.odd, hoop));
        cartesian_vector([radial, hoop, dot(&self.even, axial)], self.sin, self.cos)
    }

    fn tensor(&self, [rr, tt, zz, rt, tz, zr]: &[Vec<f64>; 6]) -> [f64; 6] {
        let [rr, tt, zz, zr] = [rr, tt, zz, zr].map(|values| dot(&self.even, values));
        let [rt, tz] = [rt, tz].map(|values| dot(&self.odd, values));
        cartesian_tensor([rr, tt, zz, rt, tz, zr], self.sin, self.cos)
    }
}

fn cartesian_vector([radial, hoop, axial]: [f64; 3], sin: f64, cos: f64) -> [f64; 3] {
    [radial * cos - hoop * sin, radial * sin + hoop * cos, axial]
}

/// (xx, yy, zz, xy, yz, xz) of (rr, θθ, zz, rθ, θz, zr).
fn cartesian_tensor([rr, tt, zz, rt, tz, zr]: [f64; 6], sin: f64, cos: f64) -> [f64; 6] {
    [
        rr * cos * cos + tt * sin * sin - 2.0 * rt * sin * cos,
        rr * sin * sin + tt * cos * cos + 2.0 * rt * sin * cos,
        zz,
        (rr - tt) * sin * cos + rt * (cos * cos - sin * sin),
        zr * sin + tz * cos,
        zr * cos - tz * sin,
    ]
}

/// Mean over both halves of the Cartesian components at the angles; those odd in y vanish.
fn axis_vector(values: &[Vec<f64>; 3]) -> [f64; 3] {
    let sum = over_angles(values, cartesian_vector);
    [sum[0], 0.0, sum[2]]
}

fn axis_tensor(values: &[Vec<f64>; 6]) -> [f64; 6] {
    let sum = over_angles(values, cartesian_tensor);
    [sum[0], sum[1], sum[2], 0.0, 0.0, sum[5]]
}

fn over_angles<const N: usize>(
    values: &[Vec<f64>; N],
    cartesian: impl Fn([f64; N], f64, f64) -> [f64; N],
) -> [f64; N] {
    let count = values[0].len();
    let mut mean = [0.0; N];
    for j in 0..count {
        let (sin, cos) = ((j as f64 + 0.5) * PI / count as f64).sin_cos();
        let at_angle = cartesian(std::array::from_fn(|c| values[c][j]), sin, cos);
        for (mean, value) in mean.iter_mut().zip(at_angle) {
            *mean += value / count as f64;
        }
    }
    mean
}

fn dot(weights: &[f64], values: &[f64]) -> f64 {
    weights.iter().zip(values).map(|(weight, value)| weight * value).sum()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

#[cfg(test)]
mod tests;
