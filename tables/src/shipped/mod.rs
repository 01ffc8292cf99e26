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

/// The same if the strength grows with the strain rate.
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

/// The same at an initial temperature, K, which a file of several must be given.
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
            for i in 0..axes.interference.len() {
                for j in 0..axes.slip_rate.len() {
                    let of = |quantity| table.cell(i, j).map(|cell| cell.scalars[quantity].value);
                    let (at_inception, peak) = (of(Quantity::MuStatic), of(Quantity::MuPeak));
                    assert!(peak.is_some() && at_inception <= peak, "{name}: {}", table.label(i, j));
                }
            }
            let request = std::fs::read_to_string(format!("data/{name}.toml")).unwrap();
            assert!(request.contains(&format!("preset = \"{metal}\"")), "{request}");
        }
    }

    /// Some rows of a table.
    fn cut(table: &InterpolatedTable, rows: std::ops::Range<usize>) -> InterpolatedTable {
        let axes = table.axes();
        let axes = Axes { interference: axes.interference[rows].to_vec(), ..axes.clone() };
        (**table).clone().regridded(axes).unwrap().interpolated()
    }

    /// The shipped tables cut from 1.9 ω_c on, against all cells above: of each quantity the share that lies within the
    /// error of the difference (that of two independent numbers), and for tables cut from 10 ω_c on the mean deviation over its error.
    #[test]
    fn rows_above_a_cut_table_lie_within_the_stated_errors() {
        let judged = [
            Quantity::Load,
            Quantity::LoadPress,
            Quantity::Area,
            Quantity::Friction,
            Quantity::FrictionStatic,
            Quantity::Mu,
            Quantity::MuStatic,
            Quantity::ContactRadius,
            Quantity::InceptionSlip,
            Quantity::EnergyRelease,
            Quantity::TemperatureMax,
        ];
        for quantity in judged {
            let (mut inside, mut all, mut farthest) = (0, 0, 0.0_f64);
            let mut ratios = Vec::new();
            for name in names() {
                for (cut_at, found, cell) in above_cut_tables(name, quantity) {
                    let (off, allowed) = ((found.value - cell.value).abs(), found.error.hypot(cell.error));
                    all += 1;
                    inside += usize::from(off <= allowed);
                    farthest = farthest.max(off / allowed);
                    if cut_at >= 10.0 {
                        ratios.push(off / allowed);
                    }
                }
            }
            let sharpness = ratios.iter().sum::<f64>() / ratios.len() as f64;
            println!(
                "{quantity:?}: {inside} of {all}, at most {farthest:.2}, mean {sharpness:.2} of the error"
            );
            assert!(all >= 300 && inside as f64 >= 0.95 * all as f64, "{quantity:?}: {inside} of {all}");
            assert!(farthest < 1.5 && sharpness > 0.1, "{quantity:?}: {farthest} {sharpness}");
        }
    }

    /// The shipped tables cut below 0.7 to 4 ω_c, against all cells below.
    #[test]
    fn rows_below_a_cut_table_lie_within_the_stated_errors() {
        use Quantity::*;
        for quantity in [Load, Area, Friction, Mu, MuStatic, InceptionSlip, EnergyRelease, TemperatureMax] {
            let (mut inside, mut all, mut farthest) = (0, 0, 0.0_f64);
            for name in names() {
                let whole = table(name).unwrap();
                let (rows, radius) = (whole.axes().interference.clone(), whole.metadata().asperity_radius);
                for first in (1..rows.len()).filter(|first| (0.65..=4.0).contains(&rows[*first])) {
                    let cut = cut(&whole, first..rows.len());
                    for (i, j) in whole.grid().filter(|(i, _)| *i < first) {
                        let (omega, rate) = whole.coordinates(i, j);
                        let (found, cell) =
                            (cut.estimate(quantity, radius, omega, rate).unwrap(), whole.cell(i, j).unwrap());
                        if found.value == whole.metadata().temperature {
                            continue;
                        }
                        let off = (found.value - cell[quantity].value).abs();
                        let allowed = found.error.hypot(cell[quantity].error);
                        all += 1;
                        inside += usize::from(off <= allowed);
                        farthest = farthest.max(off / allowed);
                    }
                }
            }
            println!("{quantity:?}: {inside} of {all}, at most {farthest:.2}");
            assert!(inside as f64 >= 0.95 * all as f64, "{quantity:?}: {inside} of {all}");
        }
    }

    /// Last interference of a cut table, what it gives for a cell above, and the cell.
    fn above_cut_tables(name: &str, quantity: Quantity) -> Vec<(f64, Estimate, Estimate)> {
        let whole = table(name).unwrap();
        let (rows, radius) = (whole.axes().interference.clone(), whole.metadata().asperity_radius);
        let mut compared = Vec::new();
        for last in (0..rows.len() - 1).filter(|last| rows[*last] >= 1.9) {
            let cut = cut(&whole, 0..last + 1);
            for (i, j) in whole.grid().filter(|(i, _)| *i > last && rows[*i] < cut.contact_limit()) {
                let (omega, rate) = whole.coordinates(i, j);
                let found = cut.estimate(quantity, radius, omega, rate).unwrap();
                // There is no heat, and no error of it.
                if quantity != Quantity::TemperatureMax || found.value != whole.metadata().temperature {
                    compared.push((rows[last], found, whole.cell(i, j).unwrap()[quantity]));
                }
            }
        }
        compared
    }

    /// The table without every second interference and slip rate.
    fn thinned(table: &InterpolatedTable) -> InterpolatedTable {
        let all = table.axes();
        let thin = |axis: &[f64]| -> Vec<f64> {
            let last = axis.len() - 1;
            (0..=last).filter(|i| i % 2 == 0 || *i == last).map(|i| axis[i]).collect()
        };
        let axes =
            Axes { interference: thin(&all.interference), slip_rate: thin(&all.slip_rate), ..all.clone() };
        (**table).clone().regridded(axes).unwrap().interpolated()
    }

    /// Friction and load between two slip rates a decade apart, of tables that have no others.
    #[test]
    fn two_slip_rates_have_errors_between_them() {
        use Quantity::{Friction, Load, Mu};
        let (mut inside, mut all) = (0, 0);
        for name in names() {
            let whole = table(name).unwrap();
            let radius = whole.metadata().asperity_radius;
            let rates = &whole.axes().slip_rate;
            let [.., last] = rates[..] else { unreachable!("a table has slip rates") };
            let first = rates.iter().position(|rate| *rate >= 0.09 * last).unwrap();
            let axes = Axes { slip_rate: vec![rates[first], last], ..whole.axes().clone() };
            let coarse = (*whole).clone().regridded(axes).unwrap().interpolated();
            for (i, j) in whole.grid().filter(|(_, j)| (first + 1..rates.len() - 1).contains(j)) {
                let (omega, rate) = whole.coordinates(i, j);
                let cell = whole.cell(i, j).unwrap();
                let end = whole.axes().slip.last().unwrap() * cell[Quantity::ContactRadius].value;
                let response = coarse.response(radius, omega, rate, end).unwrap();
                let scalar = coarse.estimate(Mu, radius, omega, rate).unwrap();
                for (found, truth) in
                    [(scalar, cell[Mu]), (response.friction, cell[Friction]), (response.load, cell[Load])]
                {
                    all += 1;
                    let allowed = found.error.hypot(truth.error);
                    inside += usize::from((found.value - truth.value).abs() <= allowed);
                }
            }
        }
        println!("{inside} of {all}");
        assert!(all > 100 && inside as f64 > 0.95 * f64::from(all), "{inside} of {all}");
    }

    /// Without their first two slip rates above zero the tables begin at a tenfold one.
    #[test]
    fn rises_below_the_first_slip_rate_lie_within_the_stated_errors() {
        for quantity in [Quantity::TemperatureMax, Quantity::TemperatureMean] {
            let (mut inside, mut all, mut farthest) = (0, 0, 0.0_f64);
            for name in names().filter(|name| !name.ends_with(RATE)) {
                let whole = table(name).unwrap();
                let (radius, base) = (whole.metadata().asperity_radius, whole.metadata().temperature);
                let rates = &whole.axes().slip_rate;
                let axes = Axes { slip_rate: [&rates[..1], &rates[3..]].concat(), ..whole.axes().clone() };
                let coarse = (*whole).clone().regridded(axes).unwrap().interpolated();
                for (i, j) in whole.grid().filter(|(_, j)| [1, 2].contains(j)) {
                    let (omega, rate) = whole.coordinates(i, j);
                    let cell = whole.cell(i, j).unwrap();
                    let end = whole.axes().slip.last().unwrap() * cell[Quantity::ContactRadius].value;
                    let found = match quantity {
                        Quantity::TemperatureMax => {
                            let at_rate = coarse.at_slip_rate(radius, rate).unwrap();
                            at_rate(omega, end).unwrap().temperature_max
                        }
                        _ => coarse.estimate(quantity, radius, omega, rate).unwrap(),
                    };
                    let truth = cell[quantity];
                    let off = (found.value - truth.value).abs();
                    all += 1;
                    inside += usize::from(off <= found.error.hypot(truth.error));
                    farthest = farthest.max(off / (truth.value - base));
                }
            }
            println!("{quantity:?}: {inside} of {all}, at most {:.0} %", 100.0 * farthest);
            assert!(all > 200 && inside as f64 >= 0.95 * f64::from(all), "{quantity:?}: {inside} of {all}");
            assert!(farthest < 0.13, "{quantity:?}: {farthest}");
        }
    }

    /// Values at the omitted points of thinned tables lie within the errors of the difference, of scalars and of the
    /// response at the last slip; the median of these errors is not far above that of the cells.
    #[test]
    fn omitted_points_lie_within_the_stated_errors() {
        use Quantity::*;
        for quantity in [Mu, MuStatic, EnergyRelease, Friction, Load, Area, TemperatureMax] {
            let (mut inside, mut all) = ([0, 0], 0);
            let (mut sizes, mut stated) = ([Vec::new(), Vec::new()], [Vec::new(), Vec::new()]);
            for name in names() {
                let whole = table(name).unwrap();
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
                    let end = whole.axes().slip.last().unwrap() * cell[ContactRadius].value;
                    let response = coarse.response(radius, omega, rate, end).unwrap();
                    let scalar = coarse.estimate(quantity, radius, omega, rate).unwrap();
                    let found = match quantity {
                        Friction => [scalar, response.friction],
                        Load => [scalar, response.load],
                        Area => [scalar, response.area],
                        TemperatureMax => [scalar, response.temperature_max],
                        _ => [scalar; 2],
                    };
                    all += 1;
                    for (k, found) in found.into_iter().enumerate() {
                        let allowed = found.error.hypot(truth.error);
                        inside[k] += usize::from((found.value - truth.value).abs() <= allowed);
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
            println!(
                "{quantity:?}: {inside:?} of {all}; true {off:?} %, stated {stated:?} %, cells {own:?} %"
            );
            assert!(inside.iter().all(|inside| *inside as f64 >= 0.95 * f64::from(all)), "{quantity:?}");
            assert!(stated.iter().all(|stated| stated[0] < 4.0 * own[0]), "{quantity:?}");
        }
    }
}
