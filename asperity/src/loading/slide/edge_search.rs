//! The contact edge that the shear limits are computed with, and the one that the state shows under them.

/// Where the shown edge answers a change of the assumed one by more than this, the other way, assuming what was
/// shown last goes back and forth: on coarse meshes by nine tenths of the change before.
const SWINGING: f64 = -0.4;
/// Beyond that the answer is taken for noise.
const MOST: f64 = -2.0;

/// Looks for the edge along each angle that the state shows if it is assumed.
#[derive(Default)]
pub struct EdgeSearch {
    last: Option<(Vec<f64>, Vec<f64>)>,
}

impl EdgeSearch {
    /// What to assume next: what was shown, or where it swings the root of the line through the last two.
    pub fn next(&mut self, assumed: Vec<f64>, shown: Vec<f64>) -> Vec<f64> {
        let step = |i: usize| {
            let off = shown[i] - assumed[i];
            let Some((assumed_last, shown_last)) = &self.last else { return off };
            let slope = (shown[i] - shown_last[i]) / (assumed[i] - assumed_last[i]);
            let back = off * (shown_last[i] - assumed_last[i]) < 0.0;
            if back && slope < SWINGING { off / (1.0 - slope.max(MOST)) } else { off }
        };
        let next = (0..assumed.len()).map(|i| assumed[i] + step(i)).collect();
        self.last = Some((assumed, shown));
        next
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Edges that answer by little are followed; one that oscillates is found at once.
    #[test]
    fn edges_that_swing_are_found() {
        let slopes = [0.3, -0.2, -1.0];
        let show =
            |x: &[f64]| -> Vec<f64> { x.iter().zip(slopes).map(|(x, slope)| 1.0 + slope * x).collect() };
        let mut search = EdgeSearch::default();
        let mut x = vec![0.0; 3];
        for _ in 0..3 {
            let shown = show(&x);
            x = search.next(x, shown);
        }
        assert!((x[2] - 0.5).abs() < 1e-14, "{x:?}");
        for i in [0, 1] {
            let exact = 1.0 / (1.0 - slopes[i]);
            assert!((x[i] - exact).abs() < 0.04 && x[i] == show(&[1.0 + slopes[i], 1.0 + slopes[i], 0.0])[i]);
        }
    }
}
