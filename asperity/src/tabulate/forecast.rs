//! When the cells of a tabulation will be done: by the times expected of their scenes, times the geometric mean of the ratios of
//! run times to these so far.

/// State of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    Waiting,
    /// Since then, s.
    Running(f64),
    Done,
}

/// When a number of cells will be done. Times are in seconds since any common start.
#[derive(Clone, Debug)]
pub struct Forecast {
    /// Each with its expected time, s.
    cells: Vec<(f64, State)>,
    workers: usize,
    /// Sum of the logarithms of run times over those expected, and their number.
    logarithms: f64,
    runs: u32,
}

impl Forecast {
    /// Forecast for cells with these expected times, s, that wait for `workers` threads.
    pub fn new(expected: &[f64], workers: usize) -> Self {
        let cells = expected.iter().map(|seconds| (*seconds, State::Waiting)).collect();
        Self { cells, workers, logarithms: 0.0, runs: 0 }
    }

    /// A cell is being run.
    pub fn started(&mut self, cell: usize, now: f64) {
        self.cells[cell].1 = State::Running(now);
    }

    /// A cell is done.
    pub fn finished(&mut self, cell: usize, now: f64) {
        let seconds = if let State::Running(start) = self.cells[cell].1 { now - start } else { f64::NAN };
        self.took(cell, seconds);
    }

    /// A cell is done that took this time, s; NaN where that is unknown.
    pub fn took(&mut self, cell: usize, seconds: f64) {
        let (expected, state) = &mut self.cells[cell];
        *state = State::Done;
        if seconds > 0.0 && seconds.is_finite() {
            self.logarithms += (seconds / *expected).ln();
            self.runs += 1;
        }
    }

    /// Seconds until all are done.
    pub fn remaining(&self, now: f64) -> f64 {
        let ratio = (self.logarithms / f64::from(self.runs.max(1))).exp();
        let of = |(expected, state): &(f64, State)| {
            let expected = ratio * expected;
            match state {
                State::Waiting => expected,
                // A late cell is expected to need another tenth of its time.
                State::Running(start) => (expected - (now - start)).max(0.1 * expected),
                State::Done => 0.0,
            }
        };
        let left: Vec<f64> = self.cells.iter().map(of).filter(|seconds| *seconds > 0.0).collect();
        let longest = left.iter().fold(0.0, |longest: f64, seconds| longest.max(*seconds));
        let workers = self.workers.min(left.len()).max(1);
        (left.iter().sum::<f64>() / workers as f64).max(longest)
    }
}

#[cfg(test)]
mod tests {
    use super::super::layout::Layout;
    use super::*;
    use crate::scene::file::parse_request;
    use tables::shipped;

    /// Expected time and wall time of the cells of a shipped table, s, in the order in which they are run.
    fn cells(name: &str) -> Vec<(f64, f64)> {
        let table = shipped::load(name).unwrap();
        let templates = parse_request(&table.metadata().scene, name, &[]).unwrap().templates();
        let layout = Layout { templates: &templates, axes: table.axes() };
        let (expected, columns) = (layout.expected_times(), table.axes().slip_rate.len());
        let cells = layout.order().into_iter().flat_map(|i| (0..columns).map(move |j| (i, j)));
        let known = cells.filter_map(|at| Some((at, table.only().unwrap().cell(at.0, at.1)?.wall_time)));
        known.map(|(at, seconds)| (expected[layout.position(at)], seconds)).collect()
    }

    /// The forecast after a part of the cells, on one thread, over the time that the others then took.
    fn forecast_over_truth(cells: &[(f64, f64)], part: f64) -> f64 {
        let expected: Vec<f64> = cells.iter().map(|cell| cell.0).collect();
        let mut forecast = Forecast::new(&expected, 1);
        let (done, mut now) = ((part * cells.len() as f64) as usize, 0.0);
        for (k, (_, seconds)) in cells[..done].iter().enumerate() {
            forecast.started(k, now);
            now += seconds;
            forecast.finished(k, now);
        }
        forecast.remaining(now) / cells[done..].iter().map(|cell| cell.1).sum::<f64>()
    }

    /// After a third of the cells, from the largest interference on. The times of the cells of a table are up to 90 to 1. Other work
    /// on the machine that begins or ends in between moves the forecast of one table, not the median of all; so does shear that
    /// localises, as in light contacts of `steel-304-rate`.
    #[test]
    fn remaining_times_of_shipped_tables_are_forecast() {
        let ratio = |name| forecast_over_truth(&cells(name), 1.0 / 3.0);
        let mut ratios: Vec<f64> = shipped::names().map(ratio).collect();
        assert!(ratios.len() == 18 && ratios.iter().all(|ratio| (0.1..10.0).contains(ratio)), "{ratios:?}");
        ratios.sort_by(f64::total_cmp);
        assert!((1.0 / 1.25..1.25).contains(&ratios[ratios.len() / 2]), "{ratios:?}");
    }

    #[test]
    fn run_times_in_proportion_to_those_expected_are_forecast() {
        let mut forecast = Forecast::new(&[1.0, 4.0, 2.0, 1.0, 3.0], 2);
        forecast.took(0, 3.0);
        forecast.took(3, f64::NAN);
        forecast.started(1, 0.0);
        forecast.finished(1, 12.0);
        forecast.started(2, 10.0);
        // 4 s of the one that runs and 9 s, on two threads.
        assert!((forecast.remaining(12.0) - 9.0).abs() < 1e-12);
        forecast.finished(2, 16.0);
        forecast.took(4, 9.0);
        assert_eq!(forecast.remaining(16.0), 0.0);
    }
}
