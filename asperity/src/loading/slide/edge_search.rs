//! Fixed-point iteration for the contact edge: the shear limits take an assumed edge, and the state under these limits
//! has a computed edge. Both agree in equilibrium.

/// d(computed)/d(assumed) below which the fixed-point iteration oscillates so slowly decaying that a secant step is
/// taken; on coarse meshes the slope is down to −0.9.
const OSCILLATION_SLOPE: f64 = -0.4;
/// Steeper slopes are limited to this value.
const STEEPEST_SLOPE: f64 = -2.0;
/// Updates after which the steps are halved, and halved again: in light contacts rings touch and lift off with the edge,
/// and full steps alternate between the two states.
const FULL_UPDATES: i32 = 5;

/// Search for the fixed point at each angle.
#[derive(Default)]
pub struct EdgeSearch {
    last: Option<(Vec<f64>, Vec<f64>)>,
    updates: i32,
}

impl EdgeSearch {
    /// The next assumed edge: a step to the computed one, or the secant step of the last two where the iteration oscillates;
    /// after `FULL_UPDATES` a share of it.
    pub fn next(&mut self, assumed: Vec<f64>, computed: Vec<f64>) -> Vec<f64> {
        let step = |i: usize| {
            let off = computed[i] - assumed[i];
            let Some((assumed_last, computed_last)) = &self.last else { return off };
            let slope = (computed[i] - computed_last[i]) / (assumed[i] - assumed_last[i]);
            let oscillates = off * (computed_last[i] - assumed_last[i]) < 0.0;
            if oscillates && slope < OSCILLATION_SLOPE {
                off / (1.0 - slope.max(STEEPEST_SLOPE))
            } else {
                off
            }
        };
        let share = 0.5f64.powi(self.updates / FULL_UPDATES);
        let next = (0..assumed.len()).map(|i| assumed[i] + share * step(i)).collect();
        self.last = Some((assumed, computed));
        self.updates += 1;
        next
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Small slopes converge by the fixed-point iteration, an oscillating linear one in a single secant step.
    #[test]
    fn oscillating_edges_converge() {
        let slopes = [0.3, -0.2, -1.0];
        let compute =
            |x: &[f64]| -> Vec<f64> { x.iter().zip(slopes).map(|(x, slope)| 1.0 + slope * x).collect() };
        let mut search = EdgeSearch::default();
        let mut x = vec![0.0; 3];
        for _ in 0..3 {
            let computed = compute(&x);
            x = search.next(x, computed);
        }
        assert!((x[2] - 0.5).abs() < 1e-14, "{x:?}");
        for i in [0, 1] {
            let exact = 1.0 / (1.0 - slopes[i]);
            assert!(
                (x[i] - exact).abs() < 0.04 && x[i] == compute(&[1.0 + slopes[i], 1.0 + slopes[i], 0.0])[i]
            );
        }
    }

    /// The edge of a ring that touches where the edge is outside and lifts off where it is inside: full steps would alternate
    /// between the two.
    #[test]
    fn an_edge_between_two_states_is_approached() {
        let mut search = EdgeSearch::default();
        let (mut x, mut far) = (0.2, 0.0f64);
        for update in 0..24 {
            x = search.next(vec![x], vec![if x > 0.0 { -0.3 } else { 0.3 }])[0];
            far = if update < 20 { 0.0 } else { far.max(x.abs()) };
        }
        assert!(far < 0.04, "{far}");
    }
}
