//! Two tables side by side.

use crate::quantity::{Quantity, values_by_path};
use crate::table::{Slice, Status};
use std::mem::discriminant;

/// Coordinates closer than this, relatively, are the same.
const SAME: f64 = 1e-9;

/// Values below this share of the largest value of a quantity, and differences below this share of a value, are rounding
/// errors.
const NEGLIGIBLE: f64 = 1e-9;

/// The indices of a point in both tables.
type Pair = ((usize, usize), (usize, usize));

/// What two requests, or the programs that made two tables, have under a key.
#[derive(Clone, Debug, PartialEq)]
pub struct OfKey {
    /// Name, of a key with its sections.
    pub key: String,
    /// Value in the first, "nothing" where it has none.
    pub here: String,
    /// Value in the second, "nothing" where it has none.
    pub there: String,
}

/// Keys in which two requests (TOML) differ, in the order of the first, then those that only the second has.
pub fn request_differences(here: &str, there: &str) -> Vec<OfKey> {
    let [here, there] = [here, there].map(|text| text.parse().unwrap_or_default());
    let [here, there] = [&here, &there].map(values_by_path);
    let value = |values: &[(String, &toml::Value)], key: &str| {
        let found = values.iter().find(|(name, _)| name == key);
        found.map_or_else(|| "nothing".to_owned(), |(_, value)| value.to_string())
    };
    let only_there = there.iter().filter(|(key, _)| here.iter().all(|(name, _)| name != key));
    let keys = here.iter().chain(only_there).map(|(key, _)| key);
    let pairs =
        keys.map(|key| OfKey { key: key.clone(), here: value(&here, key), there: value(&there, key) });
    pairs.filter(|OfKey { here, there, .. }| here != there).collect()
}

/// How two tables differ; "here" is the first of them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Comparison {
    /// Differences of the tables as a whole, and of the keys of their requests.
    pub metadata: Vec<OfKey>,
    /// Grid points that both have.
    pub common: usize,
    /// Grid points of the first table only.
    pub only_here: usize,
    /// Grid points of the second table only.
    pub only_there: usize,
    /// Common points that are in different states, by their place; and quantities of which one table alone has values at points that are
    /// done in both, by their name.
    pub states: Vec<OfKey>,
    /// Quantities with differences, in their order.
    pub quantities: Vec<Difference>,
}

/// How a quantity differs over the points that are done in both tables.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The quantity.
    pub quantity: Quantity,
    /// Points compared.
    pub compared: usize,
    /// Points that differ by more than both errors together.
    pub beyond_errors: usize,
    /// Largest difference relative to the larger value; rounding errors are left out.
    pub largest: f64,
    /// Where the largest difference is.
    pub at: String,
    /// The two values there.
    pub values: (f64, f64),
}

impl Comparison {
    /// The quantity that differs most.
    pub fn largest(&self) -> Option<&Difference> {
        self.quantities.iter().max_by(|one, other| one.largest.total_cmp(&other.largest))
    }
}

impl Slice {
    /// Compares scalars where both tables have results at the same coordinates.
    pub fn compare(&self, other: &Slice) -> Comparison {
        let mut comparison = Comparison { metadata: self.metadata_differences(other), ..Default::default() };
        let mut pairs: Vec<Pair> = Vec::new();
        for (i, j) in self.grid() {
            let (interference, slip_rate) = self.coordinates(i, j);
            let there =
                find(&other.axes().interference, interference).zip(find(&other.axes().slip_rate, slip_rate));
            let Some((k, l)) = there else {
                comparison.only_here += 1;
                continue;
            };
            pairs.push(((i, j), (k, l)));
            let (here, there) = (self.status(i, j), other.status(k, l));
            if discriminant(here) != discriminant(there) {
                let [here, there] = [here, there].map(in_words);
                comparison.states.push(OfKey { key: self.label(i, j), here, there });
            }
        }
        comparison.common = pairs.len();
        comparison.only_there = other.grid().count() - pairs.len();
        comparison
            .states
            .extend(Quantity::SCALARS.into_iter().filter_map(|q| self.one_sided(other, &pairs, q)));
        let differences = Quantity::SCALARS.into_iter().filter_map(|q| self.difference(other, &pairs, q));
        comparison.quantities = differences.filter(|difference| difference.largest > 0.0).collect();
        comparison
    }

    /// How many of the points that are done in both tables have a quantity in one table alone.
    fn one_sided(&self, other: &Slice, pairs: &[Pair], quantity: Quantity) -> Option<OfKey> {
        let mut alone = [0, 0];
        for &((i, j), (k, l)) in pairs {
            let (Some(here), Some(there)) = (self.cell(i, j), other.cell(k, l)) else { continue };
            let unknown = [there, here].map(|cell| cell[quantity].value.is_nan());
            if unknown[0] != unknown[1] {
                alone[usize::from(unknown[1])] += 1;
            }
        }
        let [here, there] = alone.map(|count| format!("{count} cells that the other lacks"));
        (alone != [0, 0]).then(|| OfKey { key: quantity.descriptor().name.to_owned(), here, there })
    }

    fn difference(&self, other: &Slice, pairs: &[Pair], quantity: Quantity) -> Option<Difference> {
        let (mut compared, mut beyond_errors) = (0, 0);
        let values = self.grid().filter_map(|(i, j)| Some(self.cell(i, j)?[quantity].value.abs()));
        let negligible = NEGLIGIBLE * values.fold(0.0, f64::max);
        let mut worst: Option<Difference> = None;
        for &((i, j), (k, l)) in pairs {
            let (Some(here), Some(there)) = (self.cell(i, j), other.cell(k, l)) else { continue };
            let (here, there) = (here[quantity], there[quantity]);
            if here.value.is_nan() || there.value.is_nan() {
                continue;
            }
            let distance = (here.value - there.value).abs();
            compared += 1;
            let size = here.value.abs().max(there.value.abs()).max(negligible);
            beyond_errors += usize::from(distance > here.error + there.error + NEGLIGIBLE * size);
            let largest = if distance == 0.0 { 0.0 } else { distance / size };
            if worst.as_ref().is_none_or(|worst| largest > worst.largest) {
                let values = (here.value, there.value);
                let at = self.label(i, j);
                worst = Some(Difference { quantity, compared: 0, beyond_errors: 0, largest, at, values });
            }
        }
        worst.map(|worst| Difference { compared, beyond_errors, ..worst })
    }

    fn metadata_differences(&self, other: &Slice) -> Vec<OfKey> {
        let (here, there) = (self.metadata(), other.metadata());
        let texts = [
            ("source", &here.source, &there.source),
            ("fingerprint", &here.fingerprint, &there.fingerprint),
            ("shard", &here.shard, &there.shard),
        ];
        let differing = texts.into_iter().filter(|(_, here, there)| here != there);
        let of_tables = differing.map(|(name, here, there)| OfKey {
            key: name.to_owned(),
            here: format!("{here:?}"),
            there: format!("{there:?}"),
        });
        of_tables.chain(request_differences(&here.scene, &there.scene)).collect()
    }
}

fn find(axis: &[f64], value: f64) -> Option<usize> {
    axis.iter().position(|known| (known - value).abs() <= SAME * value)
}

fn in_words(status: &Status) -> String {
    let reason = status.reason().map_or(String::new(), |reason| format!(": {reason}"));
    status.name().to_string() + &reason
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::{Axes, Cell, Metadata};

    fn table(slip_rate: Vec<f64>, scene: &str) -> Slice {
        let axes = Axes { interference: vec![1.0, 10.0], slip_rate, slip: vec![0.0, 1.0] };
        let metadata = Metadata { scene: scene.into(), ..Metadata::default() };
        let cell =
            |omega, rate| Cell::new().with(Quantity::Mu, 0.3 / omega, 0.01).with(Quantity::Load, rate, 0.0);
        Slice::filled(axes, metadata, cell).unwrap()
    }

    #[test]
    fn equal_tables_have_no_differences() {
        let comparison = table(vec![1.0, 2.0], "a = 1").compare(&table(vec![1.0, 2.0], "a = 1"));
        assert_eq!(comparison, Comparison { common: 4, ..Comparison::default() });
    }

    /// A key that one request has does not shift those below it.
    #[test]
    fn requests_are_compared_by_key() {
        let here = "a = 1\n[m]\nlaw = \"none\"\n[n]\nx = [1.0, 2.0]\n";
        let there = "[m]\nlaw = \"linear\"\nmodulus = 3.0\n[n]\nx = [1.0, 2.0]\n";
        let differences = request_differences(here, there);
        let found: Vec<[&str; 3]> =
            differences.iter().map(|OfKey { key, here, there }| [&key[..], here, there]).collect();
        let law = ["m.law", "\"none\"", "\"linear\""];
        assert_eq!(found, [["a", "1", "nothing"], law, ["m.modulus", "nothing", "3.0"]]);
    }

    #[test]
    fn differences_are_named_with_their_place() {
        let here = table(vec![1.0, 2.0], "a = 1\nb = 2");
        let mut there = table(vec![1.0, 2.0 * (1.0 + 1e-12), 3.0], "a = 1\nb = 3");
        there.mark_failed(0, 0, "no memory");
        let mut cell = there.cell(1, 1).unwrap().clone();
        cell = cell.with(Quantity::Mu, 0.06, 0.01);
        there.set_cell(1, 1, cell).unwrap();
        let comparison = here.compare(&there);
        assert_eq!((comparison.common, comparison.only_here, comparison.only_there), (4, 0, 2));
        let [key, here, there] = ["b", "2", "3"].map(String::from);
        assert_eq!(comparison.metadata, [OfKey { key, here, there }]);
        assert_eq!(comparison.states.len(), 1);
        assert_eq!(comparison.states[0].there, "failed: no memory");
        let mu = &comparison.quantities[0];
        assert_eq!((mu.quantity, mu.compared, mu.beyond_errors), (Quantity::Mu, 3, 1));
        assert!((mu.largest - 0.5).abs() < 1e-12);
        assert_eq!(mu.at, "10 omega_c at 2 m/s");
        assert_eq!(mu.values, (0.03, 0.06));
    }

    #[test]
    fn values_of_one_table_alone_are_a_difference() {
        let here = table(vec![1.0], "");
        let mut there = here.clone();
        there.set_cell(1, 0, Cell::new().with(Quantity::Load, 1.0, 0.0)).unwrap();
        let [key, only_here, only_there] =
            ["mu", "1 cells that the other lacks", "0 cells that the other lacks"].map(String::from);
        let states = here.compare(&there).states;
        assert_eq!(states, [OfKey { key, here: only_here, there: only_there }]);
    }
}
