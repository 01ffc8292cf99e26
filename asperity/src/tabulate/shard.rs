//! Parts of a tabulation for separate machines.

use std::fmt;
use std::str::FromStr;

/// The part K of N: a share of the cells with about the same run time as the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// K − 1.
    index: usize,
    /// N.
    count: usize,
}

/// A larger number of parts is taken for a misprint.
const MOST: usize = 100_000;

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |text: &str| text.parse::<usize>().ok();
        let parsed = text.split_once('/').and_then(|(k, n)| Some((number(k)?, number(n)?)));
        match parsed {
            Some((k, n)) if 1 <= k && k <= n && n <= MOST => Ok(Self { index: k - 1, count: n }),
            _ => Err(format!("must be K/N with whole numbers, K from 1 to N and N up to {MOST}")),
        }
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}/{}", self.index + 1, self.count)
    }
}

impl Shard {
    /// Which of the cases with these expected run times belong to the part. Every case belongs to one
    /// part; the longest are assigned first, each to the part with the smallest sum.
    pub fn members(&self, costs: &[f64]) -> Vec<bool> {
        let mut order: Vec<usize> = (0..costs.len()).collect();
        order.sort_by(|a, b| costs[*b].total_cmp(&costs[*a]));
        let mut load = vec![0.0_f64; self.count];
        let mut members = vec![false; costs.len()];
        for case in order {
            let least = (0..self.count).min_by(|a, b| load[*a].total_cmp(&load[*b])).unwrap_or(0);
            load[least] += costs[case];
            members[case] = least == self.index;
        }
        members
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn written_as_read() {
        for text in ["1/1", "2/3", "16/16"] {
            assert_eq!(text.parse::<Shard>().unwrap().to_string(), text);
        }
        for text in ["", "1", "0/3", "4/3", "a/b", "1/", "-1/3", "1/3/5", "1/1000000", "1.0/2"] {
            assert!(text.parse::<Shard>().is_err(), "{text}");
        }
    }

    #[test]
    fn every_case_belongs_to_one_part_and_parts_are_even() {
        let costs: Vec<f64> = (0..40).map(|k| 1.0 + 0.05 * f64::from(k % 7)).collect();
        for count in [1, 3, 7, 50] {
            let mut owners = vec![0; costs.len()];
            let mut loads = Vec::new();
            for k in 1..=count {
                let members = format!("{k}/{count}").parse::<Shard>().unwrap().members(&costs);
                let own = members.iter().enumerate().filter(|(_, own)| **own);
                loads.push(own.clone().map(|(case, _)| costs[case]).sum::<f64>());
                own.for_each(|(case, _)| owners[case] += 1);
            }
            assert!(owners.iter().all(|owners| *owners == 1), "{count}");
            let most = loads.iter().fold(0.0, |most: f64, load| most.max(*load));
            let least = loads.iter().fold(f64::INFINITY, |least, load| load.min(least));
            assert!(most - least <= 1.3, "{count}: {loads:?}");
        }
    }
}
