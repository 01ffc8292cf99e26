//! Which contacts have slid as far as the histories of a table go.

use super::interpolant::Interpolant;
use super::steffen::locate;

impl Interpolant {
    /// ω/ω_c at which the slip `slip` (m), at the radius of the table, is the last of the histories.
    pub(super) fn end_of_histories(&self, slip: f64) -> Option<f64> {
        let (first, last) = self.rows?;
        let wanted = slip / self.nodes.last_slip();
        let contact_radius = |log_interference: f64| match log_interference < self.log_interference[first] {
            true => self.contact_radius_below(first, log_interference),
            false => self.contact_radius(locate(&self.log_interference, log_interference)),
        };
        // a₀ grows with ω; far below the table as its root.
        let (mut low, mut high) = (self.log_interference[first] - 40.0, self.log_interference[last]);
        if !(wanted > 0.0 && contact_radius(low) < wanted && wanted < contact_radius(high)) {
            return None;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if contact_radius(middle) < wanted {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(high.exp())
    }

    /// a₀ below the first row, m.
    pub(super) fn contact_radius_below(&self, first: usize, log_interference: f64) -> f64 {
        let descent = self.descent(first, log_interference);
        self.elastic.continued(
            self.elastic.contact_radius(descent.here()),
            self.elastic.contact_radius(descent.knot),
            self.log_contact_radius[first].exp(),
            descent.kept(),
        )
    }
}
