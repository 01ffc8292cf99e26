//! What is slid: a surface or a topography, the response of its asperities, and the query.

use super::common::*;
use super::topography::TopographyOptions;
use clap::Args;
use roughsurface::friction::warning::Warning;
use roughsurface::integral::law_source::LawSource;
use roughsurface::surface::file::{Override, SurfaceFile, SurfaceFileError, Values};
use roughsurface::surface::query::{ContactLife, LoadingControl};
use roughsurface::topography::characterize::Characterization;
use roughsurface::topography::readers::is_topography;
use roughsurface::topography::report;
use std::path::{Path, PathBuf};
use tables::quantity::plausible::remarks;
use tables::shipped;

#[derive(Args)]
pub struct InputOptions {
    /// Surface file (TOML; - for standard input): summits, heights, pressures, slip rates; or a topography, which is characterised first
    surface: PathBuf,
    /// Table of one asperity: a file, the name of a shipped table (steel-4340, steel-1045, steel-304,
    /// aluminium-6061, copper, titanium-6al4v), or model:NAME for a closed form
    #[arg(long, value_name = "TABLE", required_unless_present = "material", conflicts_with = "material")]
    table: Option<String>,
    /// Material of a shipped table, in place of --table
    #[arg(long, value_name = "NAME", value_parser = shipped_material)]
    material: Option<String>,
    /// Keep mean pressure and friction of contacts too large for their asperities, instead of refusing
    #[arg(long)]
    pub extrapolate: bool,
    /// Interpolate around cells of the table that failed or were not run, with a warning
    #[arg(long)]
    allow_missing: bool,
    #[command(flatten)]
    query: QueryOptions,
    #[command(flatten)]
    topography: TopographyOptions,
}

/// Keys of the surface file that are given on the command line.
#[derive(Args)]
#[command(next_help_heading = "Query, in place of the keys of the surface file")]
struct QueryOptions {
    /// Nominal pressures, Pa: 1e6, 1e5,1e6, 1e5..1e7 (logarithmic, four a decade), or 1e5..1e7:9 (points);
    /// of a topography 1e5,1e6,1e7 by default
    #[arg(long, value_name = "VALUES", conflicts_with = "separation")]
    pressure: Option<Values>,
    /// Separations in place of pressures, m
    #[arg(long, value_name = "VALUES", allow_hyphen_values = true)]
    separation: Option<Values>,
    /// Slip rates, m/s; of a topography 0.1,1,10 by default
    #[arg(long, value_name = "VALUES")]
    slip_rate: Option<Values>,
    /// Quantity held during the slide, load by default
    #[arg(long, value_name = "load|separation", value_parser = control)]
    hold: Option<LoadingControl>,
    /// Slip over which a contact lasts, in contact diameters, or steady; 1 by default, as between two rough faces
    #[arg(long, value_name = "DIAMETERS|steady")]
    contact_life: Option<ContactLife>,
    /// Any key: section.key=value, such as surface.heights.std=1e-7; may be repeated
    #[arg(long, value_name = "SECTION.KEY=VALUE")]
    set: Vec<Override>,
}

fn shipped_material(text: &str) -> Result<String, String> {
    let known: Vec<&str> = shipped::names().collect();
    match known.contains(&text) {
        true => Ok(text.to_owned()),
        false => {
            Err(format!("tables are shipped of {}; for another material --table FILE", known.join(", ")))
        }
    }
}

fn control(text: &str) -> Result<LoadingControl, String> {
    match text {
        "load" => Ok(LoadingControl::Load),
        "separation" => Ok(LoadingControl::Separation),
        _ => Err("must be load or separation".into()),
    }
}

impl QueryOptions {
    fn overrides(&self) -> Vec<Override> {
        // One loading replaces the other.
        let loadings =
            [("pressure", &self.pressure, "separation"), ("separation", &self.separation, "pressure")];
        let mut overrides = self.set.clone();
        for (key, values, other) in loadings {
            if let Some(values) = values {
                overrides.extend([Override::query(key, values), Override::no_query(other)]);
            }
        }
        overrides.extend(self.slip_rate.as_ref().map(|rates| Override::query("slip_rate", rates)));
        overrides.extend(self.hold.map(Override::hold));
        overrides.extend(self.contact_life.map(Override::contact_life));
        overrides
    }
}

/// What the options name.
pub struct Input {
    pub file: SurfaceFile,
    pub source: LawSource,
    /// The topography that the surface is of, if it is not a surface file.
    pub measured: Option<Characterization>,
    pub warnings: Vec<Warning>,
}

impl InputOptions {
    /// The table as given.
    pub fn table(&self) -> &str {
        self.table.as_deref().or(self.material.as_deref()).unwrap_or_default()
    }

    /// Checks the outputs, and reads all inputs.
    pub fn read(&self, outputs: &Roles) -> Result<Input, Failure> {
        let topography = is_topography(&self.surface);
        let role = if topography { "the topography" } else { "the surface file" };
        let mut inputs: Vec<(&str, &Path)> = vec![(role, &self.surface)];
        let table = self.table.as_deref().map(Path::new).filter(|table| table.exists());
        inputs.extend(table.map(|table| ("--table", table)));
        check_outputs(&inputs, outputs)?;
        let measured = match topography {
            true => Some(self.topography.characterize(&self.surface, false)?),
            false => self.topography.refuse(&self.surface).map(|()| None)?,
        };
        let file = self.surface_file(measured.as_ref()).map_err(input)?;
        let tables = file.uncertain_tables.iter().map(|(_, table)| ("a table of the surface file", &**table));
        let heights = file.heights_file.iter().map(|heights| ("the heights of the surface file", &**heights));
        check_outputs(&tables.chain(heights).collect::<Vec<_>>(), outputs)?;

        let material = file.material.as_ref();
        let source = LawSource::open(self.table(), material, file.temperature, self.allow_missing);
        let source = source.map_err(input)?;
        let of_topography = measured.iter().flat_map(|found| found.warnings.iter().cloned());
        let mut warnings: Vec<Warning> = of_topography.map(Warning::Topography).collect();
        let implausible = file.text.parse().as_ref().map(remarks).unwrap_or_default();
        warnings.extend(implausible.into_iter().map(Warning::Implausible));
        if !source.interpolated_cells.is_empty() {
            warnings.push(Warning::CellsInterpolated { cells: source.interpolated_cells.clone() });
        }
        Ok(Input { file, source, measured, warnings })
    }

    fn surface_file(&self, measured: Option<&Characterization>) -> Result<SurfaceFile, SurfaceFileError> {
        let overrides = self.query.overrides();
        let Some(found) = measured else {
            return SurfaceFile::read_with(&self.surface, &overrides);
        };
        let name = self.surface.file_name().unwrap_or_default().to_string_lossy();
        let text = report::surface_file(found, &name, None);
        SurfaceFile::parse_with(&self.surface, text, &overrides)
    }
}
