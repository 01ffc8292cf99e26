//! Maps of the contact plane: stick and slip, pressure, shear, slip and temperature.

use tables::figures::{Arrow, Axis, Colors, Field, Panel, above};
use tables::quantity::{Quantity, State};

use crate::discretisation::collocation::Collocation;
use crate::output::scale::scaled;
use crate::simulate::outcome::{ContactGrid, ContactStatus, Outcome, Snapshot};

/// Name, label, unit, values.
type Shown = (&'static str, &'static str, &'static str, fn(&Snapshot) -> &Vec<f64>);

const FIELDS: [Shown; 4] = [
    ("pressure-map", "Pressure p", "Pa", |snapshot| &snapshot.pressure),
    ("shear-map", "Shear traction τ", "Pa", |snapshot| &snapshot.shear),
    ("slip-map", "Local slip", "m", |snapshot| &snapshot.slip_distance),
    ("temperature-map", "Temperature T", "K", |snapshot| &snapshot.temperature),
];

/// The maps are drawn to this radius, in a₀, unless the contact has grown beyond it.
const SHOWN: f64 = 1.25;
/// Corners of the cells on a circle.
const ANGLES: usize = 96;

/// Rows of maps, one row for each snapshot: stick and slip, pressure, shear, slip and, with heat,
/// temperature. The scales are the same in all rows.
pub fn contact_maps(outcome: &Outcome) -> Vec<Panel> {
    let fields = if outcome.account.heat { &FIELDS[..] } else { &FIELDS[..3] };
    let plane = Plane::new(outcome);
    let rows = outcome.snapshots.iter().map(|snapshot| {
        let mut row = vec![plane.status(snapshot)];
        row.extend(fields.iter().map(|field| plane.field(snapshot, field)));
        row
    });
    rows.flatten().collect()
}

struct Plane<'a> {
    outcome: &'a Outcome,
    /// a₀.
    unit: f64,
    /// Rings that are drawn.
    rings: usize,
    /// Angle of the corners of the cells, and the weights of the values at the collocation angles.
    angles: Vec<(f64, Vec<f64>)>,
}

impl<'a> Plane<'a> {
    fn new(outcome: &'a Outcome) -> Self {
        let ContactGrid { r, theta } = &outcome.grid;
        let unit = outcome.scalars[Quantity::ContactRadius].value;
        let touched = (0..r.len()).rev().find(|&ring| {
            let points = (0..theta.len()).map(|angle| angle * r.len() + ring);
            let touches =
                |snapshot: &Snapshot| points.clone().any(|at| snapshot.status[at] != ContactStatus::Open);
            outcome.snapshots.iter().any(touches)
        });
        let shown = r.iter().filter(|&&radius| radius <= SHOWN * unit).count();
        let rings = shown.max(touched.map_or(0, |ring| ring + 2)).min(r.len());
        let collocation = Collocation::full(theta.len());
        let angles = (0..=ANGLES).map(|n| {
            let angle = std::f64::consts::TAU * n as f64 / ANGLES as f64;
            (angle, collocation.interpolation(angle))
        });
        Self { outcome, unit, rings, angles: angles.collect() }
    }

    fn status(&self, snapshot: &Snapshot) -> Panel {
        // The sign changes half-way between points that stick and points that slip, at any distance from
        // open ones.
        let sticks = |at: usize| match snapshot.status[at] {
            ContactStatus::Stick => 1.0,
            ContactStatus::Slip => -1.0,
            ContactStatus::Open => 0.0,
        };
        let class = |class: usize, share: &dyn Fn(usize) -> f64| -> Vec<Vec<[f64; 3]>> {
            let parts = self.cells(snapshot, false, share).into_iter().map(|cell| above(&cell, 2, 0.0));
            parts.map(|part| part.iter().map(|[x, y, _]| [*x, *y, class as f64]).collect()).collect()
        };
        let cells = [class(0, &|at| -sticks(at)), class(1, &sticks)].concat();
        let state = self.outcome.slide.states().find(|state| shows(snapshot, state));
        let sticks = state.map_or(String::new(), |state| {
            format!(", {:.0} % sticks", 100.0 * state[Quantity::StickFraction])
        });
        let colors = Colors::Classes(["slips", "sticks"].map(String::from).to_vec());
        Panel { new_row: true, ..self.panel("status-map", snapshot, &sticks, cells, colors) }
    }

    fn field(&self, snapshot: &Snapshot, (name, label, unit, of): &Shown) -> Panel {
        let everywhere = *unit == "K";
        let rings = self.outcome.grid.r.len();
        let drawn = |snapshot: &Snapshot, at: usize| {
            at % rings < self.rings && (everywhere || snapshot.status[at] != ContactStatus::Open)
        };
        let all = self.outcome.snapshots.iter().flat_map(|snapshot| {
            let values = of(snapshot).iter().enumerate();
            values.filter(move |(at, _)| drawn(snapshot, *at)).map(|(_, value)| *value)
        });
        let ends = |(from, to): (f64, f64), value: f64| (from.min(value), to.max(value));
        let (lowest, highest) = all.fold((f64::INFINITY, f64::NEG_INFINITY), ends);
        let (factor, label) = scaled(highest, label, unit);
        let cells = self.cells(snapshot, everywhere, &|at| match drawn(snapshot, at) {
            true => of(snapshot)[at] / factor,
            false => 0.0,
        });
        let from = if everywhere { lowest } else { lowest.min(0.0) };
        let colors = Colors::Bands { label, from: from / factor, to: highest / factor };
        self.panel(name, snapshot, "", cells, colors)
    }

    /// Cells between the rings, of the contact only unless the field is defined everywhere. The values, and
    /// which points touch, follow the cosine series of the collocation in θ.
    fn cells(
        &self,
        snapshot: &Snapshot,
        everywhere: bool,
        value: &dyn Fn(usize) -> f64,
    ) -> Vec<Vec<[f64; 3]>> {
        let r = &self.outcome.grid.r;
        let touches = |at: usize| f64::from(snapshot.status[at] != ContactStatus::Open);
        let corner = |ring: usize, (angle, weights): &(f64, Vec<f64>)| {
            let sum = |of: &dyn Fn(usize) -> f64| -> f64 {
                weights.iter().enumerate().map(|(j, weight)| weight * of(j * r.len() + ring)).sum()
            };
            let radius = r[ring] / self.unit;
            [radius * angle.cos(), radius * angle.sin(), sum(value), sum(&touches)]
        };
        let row = |ring: usize| self.angles.iter().map(|angle| corner(ring, angle)).collect();
        let rows: Vec<Vec<[f64; 4]>> = (0..self.rings).map(row).collect();
        let inside = |cell: Vec<[f64; 4]>| if everywhere { cell } else { above(&cell, 3, 0.5) };
        let cells = Field::quadrilaterals(&rows).into_iter().map(inside);
        cells.map(|cell| cell.iter().map(|[x, y, value, _]| [*x, *y, *value]).collect()).collect()
    }

    fn panel(
        &self,
        name: &str,
        snapshot: &Snapshot,
        remark: &str,
        cells: Vec<Vec<[f64; 3]>>,
        colors: Colors,
    ) -> Panel {
        let outer = self.rings.checked_sub(1).map_or(1.0, |last| self.outcome.grid.r[last] / self.unit);
        let axis = |label: &str| Axis::linear(label).between(-1.05 * outer, 1.05 * outer);
        let title = format!("s = {:.3} a_{{0}}{remark}", snapshot.slip / self.unit);
        Panel {
            equal: true,
            field: Some(Field { cells, colors, arrow: self.arrow(snapshot) }),
            ..Panel::new(name, title, axis("x/a_{0}"), axis("y/a_{0}"), Vec::new())
        }
    }

    /// Where the flat moves on the way to the state of `snapshot`, at the start on the way from it; nothing where it rests.
    fn arrow(&self, snapshot: &Snapshot) -> Option<Arrow> {
        let states: Vec<_> = self.outcome.slide.states().collect();
        let end = states.iter().position(|state| shows(snapshot, state)).unwrap_or(0).max(1);
        let pair = states.get(end - 1..=end)?;
        let motion = pair[1][Quantity::Slip] - pair[0][Quantity::Slip];
        (motion != 0.0).then(|| Arrow { text: "flat".into(), backwards: motion < 0.0 })
    }
}

/// Whether a snapshot is of this state of the slide.
fn shows(snapshot: &Snapshot, state: &State<'_>) -> bool {
    (state[Quantity::Slip], state[Quantity::Time]) == (snapshot.slip, snapshot.time)
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
            time: 0.5,
            status: vec![slip, slip, open, open, stick, stick, open, open],
            pressure: vec![4e9, 2e9, 0.0, 0.0, 4e9, 1e9, 0.0, 0.0],
            shear: vec![4e8, 4e8, 0.0, 0.0, 1e8, 1e8, 0.0, 0.0],
            temperature: vec![400.0, 350.0, 310.0, 298.0, 400.0, 350.0, 310.0, 298.0],
            slip_distance: vec![0.0; 8],
        }];
        outcome
    }

    fn cells(panel: &Panel) -> &Vec<Vec<[f64; 3]>> {
        &panel.field.as_ref().unwrap().cells
    }

    fn centre(cell: &[[f64; 3]]) -> [f64; 3] {
        std::array::from_fn(|k| cell.iter().map(|corner| corner[k]).sum::<f64>() / cell.len() as f64)
    }

    fn area(cell: &[[f64; 3]]) -> f64 {
        let next = |n: usize| cell[(n + 1) % cell.len()];
        0.5 * (0..cell.len()).map(|n| cell[n][0] * next(n)[1] - cell[n][1] * next(n)[0]).sum::<f64>()
    }

    #[test]
    fn what_slips_is_ahead_and_the_full_circle_is_shown() {
        let maps = contact_maps(&outcome());
        assert_eq!(
            maps.iter().map(|map| map.name.as_str()).collect::<Vec<_>>(),
            ["status-map", "pressure-map", "shear-map", "slip-map", "temperature-map"]
        );
        let status = &maps[0];
        assert!(status.title.starts_with("s = 0.500 a_{0}"));
        let drawn = || cells(status).iter().filter(|cell| cell.len() > 2 && area(cell).abs() > 1e-9);
        for cell in drawn() {
            let [x, _, class] = centre(cell);
            assert_eq!(class, if x > 0.0 { 0.0 } else { 1.0 }, "{cell:?}");
        }
        // The second of the rings touches, the third does not: the edge is between them.
        let (r, unit) = (&outcome().grid.r, outcome().scalars[Quantity::ContactRadius].value);
        let edge = 0.5 * (r[1] + r[2]) / unit;
        let inner = r[0] / unit;
        let expected = std::f64::consts::PI * (edge * edge - inner * inner);
        let whole: f64 = drawn().map(|cell| area(cell).abs()).sum();
        assert!((whole / expected - 1.0).abs() < 1e-3, "{whole} {expected}");
        for side in [1.0, -1.0] {
            let half = drawn().filter(|cell| side * centre(cell)[1] > 0.0).map(|cell| area(cell).abs());
            assert!((half.sum::<f64>() / whole - 0.5).abs() < 1e-9);
        }
    }

    /// Forwards, backwards, at rest.
    #[test]
    fn the_arrow_points_where_the_flat_moves() {
        let mut outcome = outcome();
        let slips = [0.0, 1.0, 2.0, 2.0, 1.0, 1.0, 1.0];
        let times = [0.0, 1.0, 2.0, 2.0, 3.0, 3.0, 9.0];
        outcome.slide.truncate(slips.len());
        outcome.slide.column_mut(Quantity::Slip).copy_from_slice(&slips);
        outcome.slide.column_mut(Quantity::Time).copy_from_slice(&times);
        for (state, backwards) in [(0, Some(false)), (2, Some(false)), (4, Some(true)), (6, None)] {
            (outcome.snapshots[0].slip, outcome.snapshots[0].time) = (slips[state], times[state]);
            for map in contact_maps(&outcome) {
                let arrow = map.field.unwrap().arrow;
                assert_eq!(arrow.map(|arrow| arrow.backwards), backwards, "{state}");
            }
        }
    }

    #[test]
    fn fields_are_smooth_in_the_angle_and_have_one_scale_for_all_snapshots() {
        let mut outcome = outcome();
        let mut later = outcome.snapshots[0].clone();
        later.pressure.iter_mut().for_each(|p| *p *= 0.5);
        outcome.snapshots.push(later);
        let maps = contact_maps(&outcome);
        let colors = |map: usize| &maps[map].field.as_ref().unwrap().colors;
        assert_eq!(colors(1), colors(6));
        let expected = Colors::Bands { label: "Pressure p (10^{9} Pa)".into(), from: 0.0, to: 4.0 };
        assert_eq!(*colors(1), expected);
        // The series through 2 ahead and 1 behind, at 45° and 135°.
        let radius = outcome.grid.r[1] / outcome.scalars[Quantity::ContactRadius].value;
        let on_ring = cells(&maps[1]).iter().flatten().filter(|c| (c[0].hypot(c[1]) - radius).abs() < 1e-12);
        let mut points = 0;
        for [x, y, value] in on_ring {
            let expected = 1.5 + 0.5 * y.atan2(*x).cos() / std::f64::consts::FRAC_1_SQRT_2;
            assert!((value - expected).abs() < 1e-9);
            points += 1;
        }
        assert!(points >= ANGLES);
        // Temperature is defined outside of the contact as well.
        assert_eq!(*colors(4), Colors::Bands { label: "Temperature T (K)".into(), from: 310.0, to: 400.0 });
        let extent =
            |map: usize| cells(&maps[map]).iter().flatten().map(|c| c[0].hypot(c[1])).fold(0.0, f64::max);
        assert!(extent(4) > extent(1));
        // One orientation and extent, with the direction of the flat.
        for map in &maps {
            assert_eq!((&map.x, &map.y), (&maps[0].x, &maps[0].y));
            assert!(map.field.as_ref().unwrap().arrow.is_some());
        }
    }
}
