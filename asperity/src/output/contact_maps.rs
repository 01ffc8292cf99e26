//! Maps of the contact plane: stick and slip, pressure, shear and temperature.

use tables::figures::{Axis, Cell, Cells, Scale};
use tables::quantity::Quantity;

use crate::output::scale::scaled;
use crate::simulate::outcome::{ContactGrid, ContactStatus, Outcome, Snapshot};

type Field = (&'static str, &'static str, fn(&Snapshot) -> &Vec<f64>);

const PRESSURE: Field = ("pressure", "Pa", |snapshot| &snapshot.pressure);
const SHEAR: Field = ("shear traction", "Pa", |snapshot| &snapshot.shear);
const TEMPERATURE: Field = ("temperature", "K", |snapshot| &snapshot.temperature);

/// The maps are drawn to this radius, in a₀, unless the contact has grown beyond it.
const SHOWN: f64 = 1.25;
/// Fields are interpolated linearly to this many angles of the half circle at least.
const ANGLES: usize = 16;
/// Chords of a cell's arcs are not longer than this, in radians.
const CHORD: f64 = 0.1;

/// Rows of maps, one row for each snapshot: stick and slip, pressure, shear and, with heat, temperature.
/// The scales are the same in all rows.
pub fn contact_maps(outcome: &Outcome) -> Vec<Cells> {
    let fields: &[Field] = match outcome.account.heat {
        true => &[PRESSURE, SHEAR, TEMPERATURE],
        false => &[PRESSURE, SHEAR],
    };
    let plane = Plane::new(outcome);
    let mut maps = Vec::new();
    for snapshot in &outcome.snapshots {
        maps.push(plane.status(snapshot));
        for field in fields {
            maps.push(plane.field(snapshot, field));
        }
    }
    maps
}

struct Plane<'a> {
    outcome: &'a Outcome,
    /// a₀.
    unit: f64,
    /// Rings that are drawn.
    rings: usize,
    /// Outer radius of each, in a₀.
    outer: Vec<f64>,
}

impl<'a> Plane<'a> {
    fn new(outcome: &'a Outcome) -> Self {
        let ContactGrid { r, theta } = &outcome.grid;
        let unit = outcome.scalars[Quantity::ContactRadius].value;
        let touched = (0..r.len()).rev().find(|&ring| {
            let places = (0..theta.len()).map(|angle| angle * r.len() + ring);
            let touches =
                |snapshot: &Snapshot| places.clone().any(|at| snapshot.status[at] != ContactStatus::Open);
            outcome.snapshots.iter().any(touches)
        });
        let shown = r.iter().filter(|&&radius| radius <= SHOWN * unit).count();
        let rings = shown.max(touched.map_or(0, |ring| ring + 2)).min(r.len());
        let outer = (0..rings)
            .map(|ring| match r.get(ring + 1) {
                Some(next) => 0.5 * (r[ring] + next) / unit,
                None => r[ring] / unit,
            })
            .collect();
        Self { outcome, unit, rings, outer }
    }

    fn status(&self, snapshot: &Snapshot) -> Cells {
        let values = snapshot.status.iter().map(|status| match status {
            ContactStatus::Open => f64::NAN,
            ContactStatus::Slip => 0.0,
            ContactStatus::Stick => 1.0,
        });
        let values: Vec<f64> = values.collect();
        let names = ["slips", "sticks"].map(String::from).to_vec();
        let slip = snapshot.slip / self.unit;
        let state = self.outcome.slide.states().find(|state| state[Quantity::Slip] == snapshot.slip);
        let sticks = state.map_or(String::new(), |state| {
            format!(", {:.0} % sticks", 100.0 * state[Quantity::StickFraction])
        });
        self.cells(
            format!("s = {slip:.3} a₀{sticks}"),
            self.outcome.grid.theta.len(),
            &values,
            Scale::Classes(names),
        )
    }

    fn field(&self, snapshot: &Snapshot, (name, unit, of): &Field) -> Cells {
        let in_contact = |snapshot: &Snapshot, at: usize| snapshot.status[at] != ContactStatus::Open;
        let everywhere = *unit == "K";
        let drawn = |snapshot: &Snapshot| -> Vec<f64> {
            let values = of(snapshot).iter().enumerate();
            let rings = self.outcome.grid.r.len();
            let shown = |at: usize| at % rings < self.rings && (everywhere || in_contact(snapshot, at));
            values.map(|(at, &value)| if shown(at) { value } else { f64::NAN }).collect()
        };
        let all: Vec<f64> = self.outcome.snapshots.iter().flat_map(drawn).filter(|v| v.is_finite()).collect();
        let highest = all.iter().fold(f64::NEG_INFINITY, |m, &x| m.max(x));
        let lowest = all.iter().fold(f64::INFINITY, |m, &x| m.min(x));
        let (factor, label) = scaled(highest, name, unit);
        let from = if everywhere { lowest } else { 0.0 };
        let scale = Scale::Shades { label, from: from / factor, to: highest / factor };
        let values: Vec<f64> = drawn(snapshot).iter().map(|value| value / factor).collect();
        let (count, values) = self.finer(&values);
        let slip = snapshot.slip / self.unit;
        self.cells(format!("{name}, s = {slip:.3} a₀"), count, &values, scale)
    }

    /// Values at enough angles for a picture, and their number. Open points have the value zero, unless
    /// all are open.
    fn finer(&self, values: &[f64]) -> (usize, Vec<f64>) {
        let ContactGrid { r, theta } = &self.outcome.grid;
        let (rings, coarse) = (r.len(), theta.len());
        let count = coarse * ANGLES.div_ceil(coarse);
        let value = |angle: usize, ring: usize| {
            let place = (angle as f64 + 0.5) * coarse as f64 / count as f64 - 0.5;
            let place = place.clamp(0.0, (coarse - 1) as f64);
            let (before, share) = (place.floor() as usize, place.fract());
            let at = |angle: usize| values[angle.min(coarse - 1) * rings + ring];
            let ends = [(at(before), 1.0 - share), (at(before + 1), share)];
            let known = ends.iter().filter(|(value, weight)| value.is_finite() && *weight > 0.0);
            known.map(|(value, weight)| value * weight).reduce(|a, b| a + b).unwrap_or(f64::NAN)
        };
        let all = (0..count).flat_map(|angle| (0..rings).map(move |ring| (angle, ring)));
        (count, all.map(|(angle, ring)| value(angle, ring)).collect())
    }

    /// The half that is simulated, and its mirror image.
    fn cells(&self, title: String, angles: usize, values: &[f64], scale: Scale) -> Cells {
        let sector_angle = std::f64::consts::PI / angles as f64;
        let mut cells = Vec::new();
        for angle in 0..angles {
            for ring in 0..self.rings {
                let value = values[angle * self.outcome.grid.r.len() + ring];
                if !value.is_finite() {
                    continue;
                }
                let inner = if ring == 0 { 0.0 } else { self.outer[ring - 1] };
                for side in [1.0, -1.0] {
                    let span = (side * sector_angle * angle as f64, side * sector_angle * (angle + 1) as f64);
                    cells.push(Cell { corners: sector(inner, self.outer[ring], span), value });
                }
            }
        }
        let extent = 1.05 * self.outer.last().copied().unwrap_or(1.0);
        Cells {
            title,
            x: Axis::linear("x/a₀   (the flat moves to the right)"),
            y: Axis::linear("y/a₀"),
            x_range: (-extent, extent),
            y_range: (-extent, extent),
            cells,
            scale,
        }
    }
}

/// Outline of a part of a ring between two angles.
fn sector(inner: f64, outer: f64, (from, to): (f64, f64)) -> Vec<(f64, f64)> {
    let chords = ((to - from).abs() / CHORD).ceil().max(1.0) as usize;
    let arc = |radius: f64| {
        (0..=chords).map(move |n| {
            let angle = from + (to - from) * n as f64 / chords as f64;
            (radius * angle.cos(), radius * angle.sin())
        })
    };
    if inner == 0.0 {
        return std::iter::once((0.0, 0.0)).chain(arc(outer)).collect();
    }
    arc(inner).chain(arc(outer).collect::<Vec<_>>().into_iter().rev()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulate::fake;

    /// Contact to the second of four rings, slipping at the first angle, sticking at the second.
    fn outcome() -> Outcome {
        let mut outcome = fake::outcome(&fake::scene(1.0, 1.0));
        let unit = outcome.scalars[Quantity::ContactRadius].value;
        outcome.account.heat = true;
        outcome.grid = ContactGrid {
            theta: vec![0.25 * std::f64::consts::PI, 0.75 * std::f64::consts::PI],
            r: [0.0, 0.5, 1.0, 1.5].map(|r| r * unit).to_vec(),
        };
        let [open, stick, slip] = [ContactStatus::Open, ContactStatus::Stick, ContactStatus::Slip];
        outcome.snapshots = vec![Snapshot {
            slip: 0.5 * unit,
            status: vec![slip, slip, open, open, stick, stick, open, open],
            pressure: vec![4e9, 2e9, 0.0, 0.0, 4e9, 1e9, 0.0, 0.0],
            shear: vec![4e8, 4e8, 0.0, 0.0, 1e8, 1e8, 0.0, 0.0],
            temperature: vec![400.0, 350.0, 310.0, 298.0, 400.0, 350.0, 310.0, 298.0],
            slip_distance: vec![0.0; 8],
        }];
        outcome
    }

    fn centre(cell: &Cell) -> (f64, f64) {
        let n = cell.corners.len() as f64;
        let sum = cell.corners.iter().fold((0.0, 0.0), |sum, corner| (sum.0 + corner.0, sum.1 + corner.1));
        (sum.0 / n, sum.1 / n)
    }

    #[test]
    fn what_slips_is_ahead_and_both_halves_are_shown() {
        let maps = contact_maps(&outcome());
        assert_eq!(maps.len(), 4);
        let status = &maps[0];
        assert!(status.title.starts_with("s = 0.500 a₀"));
        assert_eq!(status.scale, Scale::Classes(vec!["slips".into(), "sticks".into()]));
        // Two rings at two angles and their mirror images; no open points.
        assert_eq!(status.cells.len(), 8);
        for cell in &status.cells {
            let ahead = if centre(cell).0 > 0.0 { 0.0 } else { 1.0 };
            assert_eq!(cell.value, ahead, "{cell:?}");
            assert!(cell.corners.iter().all(|(x, y)| x.hypot(*y) < 0.75 + 1e-12));
        }
        let above = status.cells.iter().filter(|cell| centre(cell).1 > 0.0).count();
        assert_eq!(above, 4);
    }

    #[test]
    fn fields_are_interpolated_in_the_angle_and_have_one_scale_for_all_instants() {
        let mut outcome = outcome();
        let mut later = outcome.snapshots[0].clone();
        later.pressure.iter_mut().for_each(|p| *p *= 0.5);
        outcome.snapshots.push(later);
        let maps = contact_maps(&outcome);
        let (first, second) = (&maps[1], &maps[5]);
        assert_eq!(first.scale, second.scale);
        assert_eq!(first.scale, Scale::Shades { label: "pressure (10⁹ Pa)".into(), from: 0.0, to: 4.0 });
        // The second ring extends from 2 ahead to 1 behind.
        let ring: Vec<f64> = (first.cells.iter().filter(|cell| centre(cell).1 > 0.0))
            .filter(|cell| cell.corners.iter().all(|(x, y)| x.hypot(*y) > 0.2))
            .map(|cell| cell.value)
            .collect();
        assert_eq!((ring.len(), ring[0], ring[15]), (16, 2.0, 1.0));
        assert!(ring.windows(2).all(|pair| pair[0] >= pair[1]));
        // Temperature is defined outside of the contact as well.
        let Scale::Shades { from, to, .. } = maps[3].scale else { panic!() };
        assert_eq!((from, to), (310.0, 400.0));
        assert!(maps[3].cells.len() > first.cells.len());
    }

    #[test]
    fn a_sector_is_a_closed_ring_segment() {
        let corners = sector(1.0, 2.0, (0.0, 0.5));
        let area = 0.5
            * (0..corners.len())
                .map(|n| (corners[n], corners[(n + 1) % corners.len()]))
                .map(|(a, b)| a.0 * b.1 - a.1 * b.0)
                .sum::<f64>();
        // Chords of 0.1 radians.
        assert!((area.abs() / (0.25 * 3.0) - 0.1_f64.sin() / 0.1).abs() < 1e-12, "{area}");
    }
}
