//! Tables that come with the crate, used by name.
//!
//! There are three of each metal: `METAL` slides on a rigid flat that conducts heat like the metal, `METAL-rate` likewise
//! with a rate law, at a radius of 0.1 mm, and `METAL-rigid` on one that stays at the initial temperature. Each
//! was made by `asperity tabulate tables/data/NAME.toml -o tables/data/NAME.nc`; the file itself records request,
//! version, cost and errors (`asperity table info NAME -v`), and `asperity table check NAME` computes some of its cells
//! again. Depends on `netcdf` and `interpolation`. Chapter "Shipped tables" of the book.

use std::io::Write;
use std::path::Path;

use crate::interpolation::InterpolatedTable;
use crate::netcdf::{DatasetError, JOURNAL};
use crate::quantity::hint;
use crate::table::{Table, TemperatureError};

macro_rules! shipped {
    ($($metal:literal),*) => {
        [$(
            ($metal, include_bytes!(concat!("../../data/", $metal, ".nc")) as &[u8]),
            (concat!($metal, "-rigid"), include_bytes!(concat!("../../data/", $metal, "-rigid.nc")) as &[u8]),
            (concat!($metal, "-rate"), include_bytes!(concat!("../../data/", $metal, "-rate.nc")) as &[u8]),
        )*]
    };
}

const SHIPPED: [(&str, &[u8]); 18] =
    shipped!["steel-4340", "steel-1045", "steel-304", "aluminium-6061", "copper", "titanium-6al4v"];

/// What the name of a table adds to that of its metal if the counterface is rigid and isothermal.
const RIGID: &str = "-rigid";

/// What the name of a table adds to that of its metal if the strength grows with the strain rate.
const RATE: &str = "-rate";

/// Names of the shipped tables.
pub fn names() -> impl Iterator<Item = &'static str> {
    SHIPPED.iter().map(|(name, _)| *name)
}

/// Metals of the shipped tables, which are the names of those with a like counterface and no rate law.
pub fn metals() -> impl Iterator<Item = &'static str> {
    names().filter(|name| !name.ends_with(RIGID) && !name.ends_with(RATE))
}

/// Name of the table of a metal on a rigid flat at the initial temperature.
pub fn on_rigid_flat(metal: &str) -> String {
    format!("{metal}{RIGID}")
}

/// The shipped tables of a metal without and with a rate law, if `asked` is one without.
pub fn without_and_with_rate_law(asked: &str) -> Option<[String; 2]> {
    let metal = asked.strip_suffix(RIGID).unwrap_or(asked);
    let is_shipped = metals().any(|known| known == metal) && !Path::new(asked).is_file();
    is_shipped.then(|| [metal.to_owned(), format!("{metal}{RATE}")])
}

/// Why a table is unavailable.
#[derive(Debug, thiserror::Error)]
pub enum TableSourceError {
    #[error("{asked}: there is no such file, nor is a table of that name shipped; {hint}")]
    Unknown { asked: String, hint: String },
    #[error(transparent)]
    File(#[from] DatasetError),
    #[error("{asked}: {error}")]
    Temperature { asked: String, error: TemperatureError },
    #[error(
        "{asked}: is the journal of a table that is not finished; its command with --resume completes the table"
    )]
    Unfinished { asked: String },
    #[error("{name}: cannot be unpacked into a temporary file: {reason}")]
    Unpacked { name: &'static str, reason: std::io::Error },
}

/// The table in the file `asked`, or the shipped one of that name, of one initial temperature.
///
/// ```
/// use tables::shipped::table;
///
/// let steel = table("steel-4340")?;
/// assert_eq!(steel.metadata().asperity_radius, 1e-3);
/// assert!(table("unobtainium").unwrap_err().to_string().contains("steel-4340"));
/// # Ok::<(), tables::shipped::TableSourceError>(())
/// ```
pub fn table(asked: &str) -> Result<InterpolatedTable, TableSourceError> {
    open(asked, None)
}

/// The table in the file `asked`, or the shipped one of that name, at an initial temperature, K, which a file of several
/// must be given.
pub fn open(asked: &str, temperature: Option<f64>) -> Result<InterpolatedTable, TableSourceError> {
    let of_asked = |error| TableSourceError::Temperature { asked: asked.to_owned(), error };
    load(asked)?.at(temperature).map_err(of_asked)
}

/// The table in the file `asked`, or the shipped one of that name, with all its initial temperatures.
pub fn load(asked: &str) -> Result<Table, TableSourceError> {
    let shipped = SHIPPED.iter().find(|(name, _)| *name == asked);
    // A folder of its name does not hide a shipped table.
    if Path::new(asked).is_file() || (shipped.is_none() && Path::new(asked).exists()) {
        if asked.ends_with(JOURNAL) {
            return Err(TableSourceError::Unfinished { asked: asked.to_owned() });
        }
        return Ok(Table::read(Path::new(asked))?);
    }
    match shipped {
        Some((name, bytes)) => unpacked(name, bytes),
        // The library has the better message for a path.
        None if asked.contains(['/', '.']) => Ok(Table::read(Path::new(asked))?),
        None => Err(TableSourceError::Unknown {
            asked: asked.to_owned(),
            hint: hint(asked, &names().collect::<Vec<_>>()),
        }),
    }
}

/// The libraries read files only.
fn unpacked(name: &'static str, bytes: &[u8]) -> Result<Table, TableSourceError> {
    let unpack = || {
        let mut file = tempfile::Builder::new().prefix(name).suffix(".nc").tempfile()?;
        file.write_all(bytes)?;
        file.flush()?;
        Ok(file)
    };
    let file = unpack().map_err(|reason| TableSourceError::Unpacked { name, reason })?;
    Ok(Table::read(file.path())?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::AsperityLaw;
    use crate::quantity::{Estimate, Quantity};
    use crate::table::Axes;

    /// Each is complete, of default accuracy, and of the material of its name.
    #[test]
    fn shipped_tables_are_whole() {
        for name in names() {
            let table = table(name).unwrap();
            let (axes, metadata) = (table.axes(), table.metadata());
            let has_rate_law = name.ends_with(RATE);
            assert_eq!(metadata.rate_coefficient.is_some(), has_rate_law, "{name}");
            let (slowest, radius) = if has_rate_law { (0.01, 1e-4) } else { (0.0, 1e-3) };
            // In lighter contacts its interface is stronger than the body.
            let lightest = if name == "steel-304-rate" { 0.7 } else { 0.1 };
            assert_eq!((axes.interference[0], axes.slip_rate[0]), (lightest, slowest), "{name}");
            assert_eq!(metadata.asperity_radius, radius, "{name}");
            // To a contact radius of 0.23 of that of the asperity; copper does not stick that far.
            let last = axes.interference[axes.interference.len() - 1];
            let reach = last / table.contact_limit();
            let metal = name.trim_end_matches(RIGID).trim_end_matches(RATE);
            assert!(reach > 0.33 || (metal == "copper" && last == 3000.0), "{name}: {last}, {reach}");
            assert_eq!(metadata.counterface.is_empty(), name.ends_with(RIGID), "{name}");
            for (i, j) in table.grid() {
                let of = |quantity| table.cell(i, j).map(|cell| cell.scalars[quantity].value);
                let (at_inception, peak) = (of(Quantity::MuStatic), of(Quantity::MuPeak));
                assert!(peak.is_some() && at_inception <= peak, "{name}: {}", table.label(i, j));
            }
            let request = std::fs::read_to_string(format!("data/{name}.toml")).unwrap();
            assert!(request.contains(&format!("preset = \"{metal}\"")), "{request}");
        }
    }

    /// The table on a part of its interferences and slip rates.
    fn reduced(table: &InterpolatedTable, axes: Axes) -> InterpolatedTable {
        (**table).clone().regridded(axes).unwrap().interpolated()
    }

    /// Values of reduced tables against cells of the whole ones.
    #[derive(Debug, Default)]
    struct Tally {
        /// Values within the error of the difference, that of two independent numbers.
        inside: usize,
        all: usize,
        /// Largest deviation over that error.
        farthest: f64,
    }

    impl Tally {
        /// The deviation over the error of the difference.
        fn add(&mut self, found: Estimate, cell: Estimate) -> f64 {
            let (off, allowed) = ((found.value - cell.value).abs(), found.error.hypot(cell.error));
            self.all += 1;
            self.inside += usize::from(off <= allowed);
            self.farthest = self.farthest.max(off / allowed);
            off / allowed
        }

        fn is_covered(&self) -> bool {
            self.inside as f64 >= 0.95 * self.all as f64
        }
    }

    /// What a table cut to some rows gives for the cells outside of them, and these.
    fn outside(
        whole: &InterpolatedTable,
        rows: std::ops::Range<usize>,
        quantity: Quantity,
    ) -> Vec<(Estimate, Estimate)> {
        let interference = whole.axes().interference[rows.clone()].to_vec();
        let cut = reduced(whole, Axes { interference, ..whole.axes().clone() });
        let compared = |(i, j)| {
            let (omega, rate) = whole.coordinates(i, j);
            if rows.contains(&i) || omega >= cut.contact_limit() {
                return None;
            }
            let found = cut.estimate(quantity, whole.metadata().asperity_radius, omega, rate).unwrap();
            // There is no heat, and no error of it.
            let is_cold = quantity == Quantity::TemperatureMax && found.value == whole.metadata().temperature;
            (!is_cold).then(|| (found, whole.cell(i, j).unwrap()[quantity]))
        };
        whole.grid().filter_map(compared).collect()
    }

    /// The shipped tables cut from 1.9 ω_c on, against all cells above: of each quantity the share that lies within the
    /// error of the difference, and for tables cut from 10 ω_c on the mean deviation over its error.
    #[test]
    fn rows_above_a_cut_table_lie_within_the_stated_errors() {
        use Quantity::*;
        let judged = [
            Load,
            LoadPress,
            Area,
            Friction,
            FrictionStatic,
            Mu,
            MuStatic,
            ContactRadius,
            InceptionSlip,
            EnergyRelease,
            TemperatureMax,
        ];
        for quantity in judged {
            let (mut tally, mut ratios) = (Tally::default(), Vec::new());
            for whole in names().map(|name| table(name).unwrap()) {
                let rows = &whole.axes().interference;
                for last in (0..rows.len() - 1).filter(|last| rows[*last] >= 1.9) {
                    for (found, cell) in outside(&whole, 0..last + 1, quantity) {
                        let ratio = tally.add(found, cell);
                        ratios.extend((rows[last] >= 10.0).then_some(ratio));
                    }
                }
            }
            let sharpness = ratios.iter().sum::<f64>() / ratios.len() as f64;
            println!("{quantity:?}: {tally:?}, mean {sharpness:.2} of the error");
            assert!(tally.all >= 300 && tally.is_covered(), "{quantity:?}: {tally:?}");
            assert!(tally.farthest < 1.5 && sharpness > 0.1, "{quantity:?}: {tally:?} {sharpness}");
        }
    }

    /// The shipped tables cut below 0.7 to 4 ω_c, against all cells below.
    #[test]
    fn rows_below_a_cut_table_lie_within_the_stated_errors() {
        use Quantity::*;
        for quantity in [Load, Area, Friction, Mu, MuStatic, InceptionSlip, EnergyRelease, TemperatureMax] {
            let mut tally = Tally::default();
            for whole in names().map(|name| table(name).unwrap()) {
                let rows = &whole.axes().interference;
                for first in (1..rows.len()).filter(|first| (0.65..=4.0).contains(&rows[*first])) {
                    for (found, cell) in outside(&whole, first..rows.len(), quantity) {
                        tally.add(found, cell);
                    }
                }
            }
            println!("{quantity:?}: {tally:?}");
            assert!(tally.is_covered(), "{quantity:?}: {tally:?}");
        }
    }

    /// Friction and load between two slip rates a decade apart, of tables that have no others.
    #[test]
    fn two_slip_rates_have_errors_between_them() {
        use Quantity::{Friction, Load, Mu};
        let mut tally = Tally::default();
        for whole in names().map(|name| table(name).unwrap()) {
            let radius = whole.metadata().asperity_radius;
            let rates = &whole.axes().slip_rate;
            let [.., last] = rates[..] else { unreachable!("a table has slip rates") };
            let first = rates.iter().position(|rate| *rate >= 0.09 * last).unwrap();
            let coarse =
                reduced(&whole, Axes { slip_rate: vec![rates[first], last], ..whole.axes().clone() });
            for (i, j) in whole.grid().filter(|(_, j)| (first + 1..rates.len() - 1).contains(j)) {
                let (omega, rate) = whole.coordinates(i, j);
                let cell = whole.cell(i, j).unwrap();
                let end = whole.last_slip() * cell[Quantity::ContactRadius].value;
                let response = coarse.response(radius, omega, rate, end).unwrap();
                tally.add(coarse.estimate(Mu, radius, omega, rate).unwrap(), cell[Mu]);
                tally.add(response.friction, cell[Friction]);
                tally.add(response.load, cell[Load]);
            }
        }
        println!("{tally:?}");
        assert!(tally.all > 100 && tally.is_covered(), "{tally:?}");
    }

    /// Without their first two slip rates above zero the tables begin at a tenfold one.
    #[test]
    fn rises_below_the_first_slip_rate_lie_within_the_stated_errors() {
        for quantity in [Quantity::TemperatureMax, Quantity::TemperatureMean] {
            let (mut tally, mut farthest) = (Tally::default(), 0.0_f64);
            for name in names().filter(|name| !name.ends_with(RATE)) {
                let whole = table(name).unwrap();
                let (radius, base) = (whole.metadata().asperity_radius, whole.metadata().temperature);
                let rates = &whole.axes().slip_rate;
                let slip_rate = [&rates[..1], &rates[3..]].concat();
                let coarse = reduced(&whole, Axes { slip_rate, ..whole.axes().clone() });
                for (i, j) in whole.grid().filter(|(_, j)| [1, 2].contains(j)) {
                    let (omega, rate) = whole.coordinates(i, j);
                    let cell = whole.cell(i, j).unwrap();
                    let end = whole.last_slip() * cell[Quantity::ContactRadius].value;
                    let found = match quantity {
                        Quantity::TemperatureMax => {
                            let at_rate = coarse.at_slip_rate(radius, rate).unwrap();
                            at_rate(omega, end).unwrap().temperature_max
                        }
                        _ => coarse.estimate(quantity, radius, omega, rate).unwrap(),
                    };
                    let truth = cell[quantity];
                    tally.add(found, truth);
                    farthest = farthest.max((found.value - truth.value).abs() / (truth.value - base));
                }
            }
            println!("{quantity:?}: {tally:?}, at most {:.0} %", 100.0 * farthest);
            assert!(tally.all > 200 && tally.is_covered(), "{quantity:?}: {tally:?}");
            assert!(farthest < 0.13, "{quantity:?}: {farthest}");
        }
    }

    /// The table without every second interference and slip rate.
    fn thinned(table: &InterpolatedTable) -> InterpolatedTable {
        let all = table.axes();
        let thin = |axis: &[f64]| -> Vec<f64> {
            let last = axis.len() - 1;
            (0..=last).filter(|i| i % 2 == 0 || *i == last).map(|i| axis[i]).collect()
        };
        let [interference, slip_rate] = [&all.interference, &all.slip_rate].map(|axis| thin(axis));
        reduced(table, Axes { interference, slip_rate, ..all.clone() })
    }

    /// Values at the omitted points of thinned tables lie within the errors of the difference, of scalars and of the
    /// response at the last slip; the median of these errors is not far above that of the cells.
    #[test]
    fn omitted_points_lie_within_the_stated_errors() {
        use Quantity::*;
        for quantity in [Mu, MuStatic, EnergyRelease, Friction, Load, Area, TemperatureMax] {
            let mut tallies = [Tally::default(), Tally::default()];
            let (mut sizes, mut stated) = ([Vec::new(), Vec::new()], [Vec::new(), Vec::new()]);
            for whole in names().map(|name| table(name).unwrap()) {
                let (coarse, radius) = (thinned(&whole), whole.metadata().asperity_radius);
                for (i, j) in whole.grid() {
                    let (omega, rate) = whole.coordinates(i, j);
                    let cell = whole.cell(i, j).unwrap();
                    let truth = cell[quantity];
                    let scale = truth.value - quantity.origin(whole.metadata().temperature);
                    let axes = coarse.axes();
                    let is_known = axes.interference.contains(&omega) && axes.slip_rate.contains(&rate);
                    if is_known || scale == 0.0 {
                        continue;
                    }
                    let end = whole.last_slip() * cell[ContactRadius].value;
                    let response = coarse.response(radius, omega, rate, end).unwrap();
                    let scalar = coarse.estimate(quantity, radius, omega, rate).unwrap();
                    let of_response = match quantity {
                        Friction => response.friction,
                        Load => response.load,
                        Area => response.area,
                        TemperatureMax => response.temperature_max,
                        _ => scalar,
                    };
                    for (k, found) in [scalar, of_response].into_iter().enumerate() {
                        tallies[k].add(found, truth);
                        stated[k].push(100.0 * found.error / scale);
                    }
                    sizes[0].push(100.0 * (scalar.value - truth.value).abs() / scale);
                    sizes[1].push(100.0 * truth.error / scale);
                }
            }
            let shown = |values: &mut Vec<f64>| {
                values.sort_by(f64::total_cmp);
                [0.5, 0.9]
                    .map(|share| (values[(share * values.len() as f64) as usize] * 100.0).round() / 100.0)
            };
            let ([off, own], stated) = (sizes.each_mut().map(shown), stated.each_mut().map(shown));
            println!("{quantity:?}: {tallies:?}; true {off:?} %, stated {stated:?} %, cells {own:?} %");
            assert!(tallies.iter().all(Tally::is_covered), "{quantity:?}");
            assert!(stated.iter().all(|stated| stated[0] < 4.0 * own[0]), "{quantity:?}");
        }
    }
}
