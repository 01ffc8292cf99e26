//! Tables as comma-separated values, for programs that do not read netCDF.

use std::io::Write;

use crate::numbers::exact;
use crate::quantity::{Estimate, Quantity, Scalars};
use crate::table::{Cell, Slice, Table};

impl Table {
    /// A line for each grid point: coordinates, state, every scalar with its error, G/G_IIc if G_IIc is known. Names
    /// carry units, as in `Q [N]`; unknown values are empty. Of several initial temperatures the first column is
    /// `temperature [K]`.
    pub fn write_csv(&self, to: impl Write) -> std::io::Result<()> {
        let mut file = csv::Writer::from_writer(to);
        let mut header = self.coordinates(&["status"]);
        for quantity in Quantity::SCALARS {
            let descriptor = quantity.descriptor();
            header.push(format!("{} [{}]", descriptor.name, descriptor.units));
            header.push(format!("{}_error [{}]", descriptor.name, descriptor.units));
        }
        header.extend(["levelled", "wall_time [s]", "failure_reason", "warnings"].map(String::from));
        let fracture = self.slices().iter().any(|table| table.metadata().fracture_energy.is_some());
        if fracture {
            header.extend(["G_ratio [1]", "G_ratio_error [1]"].map(String::from));
        }
        file.write_record(&header)?;
        for (table, (i, j), mut line) in self.points() {
            let status = table.status(i, j);
            line.push(status.name().to_string());
            let cell = table.cell(i, j);
            for (_, estimate) in cell.map_or_else(Scalars::default, |cell| cell.scalars).iter() {
                line.extend([number(estimate.value), number(estimate.error)]);
            }
            line.push(cell.map_or(String::new(), |cell| cell.steady.to_string()));
            line.push(cell.map_or(String::new(), |cell| number(cell.wall_time)));
            line.push(status.reason().unwrap_or_default().to_string());
            line.push(cell.map_or(String::new(), |cell| cell.warnings.join("; ")));
            if fracture {
                let ratio = cell.and_then(|cell| table.energy_ratio(cell)).unwrap_or(Estimate::UNKNOWN);
                line.extend([number(ratio.value), number(ratio.error)]);
            }
            file.write_record(&line)?;
        }
        file.flush()
    }

    /// A line for each grid point with results and each slip, in a₀: the histories.
    pub fn write_histories_csv(&self, to: impl Write) -> std::io::Result<()> {
        let mut file = csv::Writer::from_writer(to);
        let mut header = self.coordinates(&["slip [1]"]);
        for quantity in Quantity::TABLE_HISTORIES {
            let descriptor = quantity.descriptor();
            header.push(format!("{} [{}]", descriptor.name, descriptor.units));
        }
        file.write_record(&header)?;
        for (table, (i, j), line) in self.points() {
            let Some(cell) = table.cell(i, j) else { continue };
            for (k, slip) in table.axes().slip.iter().enumerate() {
                let at = |quantity: Quantity| number(Cell::history(cell, quantity)[k]);
                let coordinates = line.iter().cloned().chain([number(*slip)]);
                file.write_record(coordinates.chain(Quantity::TABLE_HISTORIES.map(at)))?;
            }
        }
        file.flush()
    }

    /// The first columns.
    fn coordinates(&self, others: &[&str]) -> Vec<String> {
        let all = [&["temperature [K]", "interference [1]", "slip_rate [m s-1]"], others].concat();
        all.into_iter().skip(usize::from(self.slices().len() < 2)).map(String::from).collect()
    }

    /// Each grid point of each table, with its first columns.
    fn points(&self) -> impl Iterator<Item = (&Slice, (usize, usize), Vec<String>)> {
        self.slices().iter().flat_map(move |table| {
            table.grid().map(move |(i, j)| {
                let (interference, slip_rate) = table.coordinates(i, j);
                let all = [table.metadata().temperature, interference, slip_rate];
                let line = all.into_iter().skip(usize::from(self.slices().len() < 2)).map(number).collect();
                (table, (i, j), line)
            })
        })
    }
}

/// Exactly; empty for unknown values.
fn number(value: f64) -> String {
    if value.is_nan() { String::new() } else { exact(value) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::{Axes, FractureEnergy, Metadata};

    #[test]
    fn lines_have_names_units_and_exact_numbers() {
        let axes = Axes { interference: vec![0.5], slip_rate: vec![0.0, 1.0], slip: vec![0.0, 2.0] };
        let fracture_energy = Some(FractureEnergy { coefficient: 2e9, radius_exponent: 1 });
        let mut slice = Slice::new(axes, Metadata { fracture_energy, ..Metadata::default() }).unwrap();
        let mut cell = Cell::new()
            .with(Quantity::EnergyRelease, 500.0, 0.0)
            .with(Quantity::Friction, 0.1 + 0.2, f64::NAN)
            .with(Quantity::ContactRadius, 1.25e-7, 1e-9)
            .with_history(Quantity::Mu, vec![0.0, 0.25]);
        cell.warnings = vec!["coarse, very".into()];
        slice.set_cell(0, 0, cell).unwrap();
        slice.mark_failed(0, 1, "no \"memory\"");
        let table = Table::from(slice);
        let mut bytes = Vec::new();
        table.write_csv(&mut bytes).unwrap();
        let text = String::from_utf8(bytes).unwrap();
        let mut lines = text.lines();
        let header: Vec<&str> = lines.next().unwrap().split(',').collect();
        let first: Vec<&str> = lines.next().unwrap().split(',').collect();
        let of = |name: &str| first[header.iter().position(|known| *known == name).unwrap()];
        assert_eq!(of("interference [1]"), "0.5");
        assert_eq!(of("Q [N]").parse::<f64>().unwrap().to_bits(), (0.1_f64 + 0.2).to_bits());
        assert_eq!(of("Q_error [N]"), "");
        assert_eq!(of("contact_radius [m]"), "1.25e-7");
        // A comma in the warnings: from the end.
        assert_eq!(header[header.len() - 2..], ["G_ratio [1]", "G_ratio_error [1]"]);
        let [ratio, error] = [2, 1].map(|end| first[first.len() - end].parse::<f64>().unwrap());
        assert!((ratio - 2.0).abs() < 1e-12 && (error - 0.016).abs() < 1e-12, "{ratio} {error}");
        assert!(text.contains("\"coarse, very\""));
        assert!(lines.next().unwrap().contains("failed") && text.contains("\"no \"\"memory\"\"\""));

        let mut bytes = Vec::new();
        table.write_histories_csv(&mut bytes).unwrap();
        let text = String::from_utf8(bytes).unwrap();
        assert_eq!(text.lines().count(), 3);
        assert_eq!(text.lines().last().unwrap(), "0.5,0,2,0.25,,,,");
    }
}
