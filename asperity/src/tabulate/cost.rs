//! Run times of cells, fitted to those of finished cells.
//!
//! ln t = level + slope·x + curvature·x² + [no heat]·saving + trend·j + share of the j-th slip rate, with
//! x = ln(ω/ω_max), by least squares with a prior on every term. The priors are means and scatters in tables
//! of six metals: small interferences take long because their contact edge needs many elements, large ones
//! because they are at finite strain; a slide without heat takes little more than half the time.

use nalgebra::{DMatrix, DVector};

/// A case as far as its run time is concerned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// ω₀/ω_c.
    pub interference: f64,
    /// Position of the slip rate.
    pub column: usize,
    /// Whether heat is expected to be computed.
    pub heated: bool,
}

/// Expected value and standard deviation of a term.
type Prior = (f64, f64);

const LEVEL: Prior = (0.0, 20.0);
const SLOPE: Prior = (0.3, 0.5);
const CURVATURE: Prior = (0.05, 0.1);
const SAVING: Prior = (-0.5, 0.4);
const TREND: Prior = (0.0, 0.15);
const COLUMN: Prior = (0.0, 0.15);
/// Scatter of ln t about the model.
const SCATTER: f64 = 0.15;

const FIRST_COLUMN: usize = 5;

/// Run times of cases.
#[derive(Clone, Debug)]
pub struct CostModel {
    largest: f64,
    /// Sums of the normal equations, of which the prior is the start.
    matrix: DMatrix<f64>,
    right: DVector<f64>,
    terms: DVector<f64>,
}

impl CostModel {
    /// The prior, for cases up to the interference `largest` at this number of slip rates.
    pub fn new(largest: f64, columns: usize) -> Self {
        let priors = [LEVEL, SLOPE, CURVATURE, SAVING, TREND].into_iter();
        let priors: Vec<Prior> = priors.chain(std::iter::repeat_n(COLUMN, columns)).collect();
        let weights = DVector::from_iterator(priors.len(), priors.iter().map(|(_, width)| width.powi(-2)));
        let terms = DVector::from_iterator(priors.len(), priors.iter().map(|(mean, _)| *mean));
        let right = weights.component_mul(&terms);
        Self { largest, matrix: DMatrix::from_diagonal(&weights), right, terms }
    }

    /// Adds the run time of a case to the fit.
    pub fn learn(&mut self, case: Case, seconds: f64) {
        if seconds <= 0.0 || !seconds.is_finite() {
            return;
        }
        let row = self.row(case);
        let weight = SCATTER.powi(-2);
        self.matrix.ger(weight, &row, &row, 1.0);
        self.right.axpy(weight * seconds.ln(), &row, 1.0);
        if let Some(factor) = self.matrix.clone().cholesky() {
            self.terms = factor.solve(&self.right);
        }
    }

    /// Run time of a case, s. Of the prior alone only ratios are meaningful.
    pub fn seconds(&self, case: Case) -> f64 {
        self.row(case).dot(&self.terms).exp()
    }

    fn row(&self, case: Case) -> DVector<f64> {
        let mut row = DVector::zeros(self.terms.len());
        let x = (case.interference / self.largest).ln();
        let saved = if case.heated { 0.0 } else { 1.0 };
        row.as_mut_slice()[..FIRST_COLUMN].copy_from_slice(&[1.0, x, x * x, saved, case.column as f64]);
        row[FIRST_COLUMN + case.column] = 1.0;
        row
    }
}

/// State of a case.
#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    Waiting,
    /// Since then, s.
    Running(f64),
    Done,
}

/// When a number of cases will be done. Times are in seconds since any common start.
#[derive(Clone, Debug)]
pub struct Forecast {
    model: CostModel,
    cases: Vec<(Case, State)>,
    workers: usize,
}

impl Forecast {
    /// For `cases` that wait for `workers` threads.
    pub fn new(model: CostModel, cases: Vec<Case>, workers: usize) -> Self {
        Self { model, cases: cases.into_iter().map(|case| (case, State::Waiting)).collect(), workers }
    }

    /// A case is being run.
    pub fn started(&mut self, case: usize, now: f64) {
        self.cases[case].1 = State::Running(now);
    }

    /// A case is done.
    pub fn finished(&mut self, case: usize, now: f64) {
        let (about, state) = self.cases[case];
        if let State::Running(start) = state {
            self.model.learn(about, now - start);
        }
        self.cases[case].1 = State::Done;
    }

    /// Seconds until all are done.
    pub fn remaining(&self, now: f64) -> f64 {
        let of = |(case, state): &(Case, State)| {
            let expected = self.model.seconds(*case);
            match state {
                State::Waiting => expected,
                // A late case is expected to need another tenth of its time.
                State::Running(start) => (expected - (now - start)).max(0.1 * expected),
                State::Done => 0.0,
            }
        };
        let left: Vec<f64> = self.cases.iter().map(of).filter(|seconds| *seconds > 0.0).collect();
        let longest = left.iter().fold(0.0, |longest: f64, seconds| longest.max(*seconds));
        let workers = self.workers.min(left.len()).max(1);
        (left.iter().sum::<f64>() / workers as f64).max(longest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tables::numbers::Spacing::Log;

    /// Cases of a grid in the order in which they are run: one of the middle, smallest and largest first, then
    /// from the largest on.
    fn order(interferences: &[f64], rates: usize) -> Vec<Case> {
        let case =
            |i: usize, column: usize| Case { interference: interferences[i], column, heated: column > 0 };
        let probes = super::super::layout::probes(interferences.len()).map(|i| (i, rates / 2));
        let rows = (0..interferences.len()).rev();
        let all = rows.flat_map(|i| (0..rates).map(move |j| (i, j)));
        probes.into_iter().chain(all.filter(|at| !probes.contains(at))).map(|(i, j)| case(i, j)).collect()
    }

    /// Ratio of forecast to truth once a tenth of the work is done, for cases of known duration
    /// run by `workers` threads.
    fn forecast_over_truth(
        cases: &[Case],
        columns: usize,
        workers: usize,
        cost: impl Fn(Case) -> f64,
    ) -> f64 {
        let largest = cases.iter().map(|case| case.interference).fold(0.0, f64::max);
        let mut forecast = Forecast::new(CostModel::new(largest, columns), cases.to_vec(), workers);
        let total: f64 = cases.iter().map(|case| cost(*case)).sum();
        let mut free = vec![0.0_f64; workers];
        let mut ends = Vec::new();
        for (k, case) in cases.iter().enumerate() {
            let worker = (0..workers).min_by(|a, b| free[*a].total_cmp(&free[*b])).unwrap();
            let start = free[worker];
            free[worker] = start + cost(*case);
            ends.push((start, free[worker], k));
        }
        let last = free.into_iter().fold(0.0, f64::max);
        let mut finished = ends.clone();
        finished.sort_by(|a, b| a.1.total_cmp(&b.1));
        let (mut done, mut begun) = (0.0, 0);
        for (_, end, k) in finished {
            while begun < ends.len() && ends[begun].0 < end {
                forecast.started(ends[begun].2, ends[begun].0);
                begun += 1;
            }
            forecast.finished(k, end);
            done += cost(cases[k]);
            if done >= 0.1 * total {
                return forecast.remaining(end) / (last - end);
            }
        }
        panic!("the cases end before a tenth of the work is done");
    }

    /// Scatter of the run times: the same for a case in every run of the test.
    fn scatter(case: Case) -> f64 {
        let phase = 12.9898 * case.interference.ln() + 78.233 * case.column as f64;
        1.0 + 0.2 * (43758.5453 * phase.sin()).sin()
    }

    #[test]
    fn right_within_30_percent_after_a_tenth_of_the_work() {
        for (rows, columns) in [(8, 5), (10, 4), (10, 10), (20, 8), (40, 10)] {
            let interferences = Log.range(0.1, 100.0, rows);
            let cases = order(&interferences, columns);
            // A tenth of the work is four cases for each thread, or there is little to learn from.
            for workers in [1, 2, 8].into_iter().filter(|workers| 40 * workers <= rows * columns) {
                for (slope, curvature) in
                    [(-0.1, 0.0), (0.0, 0.0), (0.1, 0.0), (0.3, 0.0), (0.5, 0.0), (0.3, 0.05), (0.6, 0.1)]
                {
                    for rate_slope in [-0.1, 0.0, 0.15] {
                        for saving in [0.3, 0.5, 0.8] {
                            let cost = |case: Case| {
                                let heat = if case.heated { 1.0 } else { saving };
                                let rate = (rate_slope * case.column as f64).exp();
                                let x = (case.interference / 100.0).ln();
                                40.0 * (slope * x + curvature * x * x).exp() * heat * rate * scatter(case)
                            };
                            let ratio = forecast_over_truth(&cases, columns, workers, cost);
                            assert!(
                                (ratio - 1.0).abs() < 0.3,
                                "{rows} x {columns}, {workers} workers, {slope} {curvature} {rate_slope} {saving}: {ratio}"
                            );
                        }
                    }
                }
            }
        }
    }

    /// Wall times of a table of 4340 steel, s: 0.1 to 100 ω_c at 0 to 10 m/s on two threads, one cell with ten times the
    /// time of its neighbours.
    #[test]
    fn right_for_a_table_that_was_measured() {
        let measured = [
            [23.97, 24.30, 22.99, 40.80, 41.85, 48.50, 19.00],
            [6.76, 7.80, 6.11, 8.05, 82.44, 13.07, 7.74],
            [2.56, 2.30, 5.10, 4.24, 4.62, 3.56, 4.50],
            [0.95, 0.98, 1.81, 1.80, 1.85, 2.26, 2.09],
            [1.14, 1.98, 2.01, 3.21, 1.96, 2.01, 2.09],
            [1.75, 5.03, 4.62, 5.95, 5.12, 5.29, 5.09],
            [3.90, 5.56, 6.88, 5.67, 6.60, 6.83, 7.07],
            [14.31, 20.84, 20.35, 22.42, 21.09, 17.95, 16.61],
        ];
        let interferences = Log.range(0.1, 100.0, 8);
        let row = |case: Case| interferences.iter().position(|x| *x == case.interference).unwrap();
        let cases = order(&interferences, 7);
        for workers in [1, 2] {
            let ratio = forecast_over_truth(&cases, 7, workers, |case| measured[row(case)][case.column]);
            assert!((ratio - 1.0).abs() < 0.3, "{workers}: {ratio}");
        }
    }

    #[test]
    fn terms_are_learnt() {
        let mut model = CostModel::new(100.0, 3);
        for interference in Log.range(0.1, 100.0, 9) {
            for column in 0..3 {
                let case = Case { interference, column, heated: true };
                model.learn(case, 7.0 * interference.powf(0.4) * (1.0 + column as f64));
            }
        }
        let asked = model.seconds(Case { interference: 3.3, column: 1, heated: true });
        assert!((asked / (14.0 * 3.3_f64.powf(0.4)) - 1.0).abs() < 0.02, "{asked}");
    }
}
