//! What is slid: a surface or a topography, the response of its asperities, and the query.

use super::common::*;
use super::topography::TopographyOptions;
use clap::Args;
use roughsurface::sampling::case::{Case, surface_of};
use roughsurface::surface::file::{SurfaceFile, Values, query_key, query_values};
use roughsurface::surface::query::{ContactLife, Interaction, LoadingControl};
use roughsurface::surface::units::{self, length};
use roughsurface::topography::readers::is_topography;
use std::path::{Path, PathBuf};
use tables::netcdf::input::Override;
use tables::quantity::hint;
use tables::shipped;

#[derive(Args)]
pub struct InputOptions {
    /// Surface file (TOML; - for standard input): summits, heights, pressures, slip rates; or a topography, which is characterised first
    surface: PathBuf,
    /// Table of one asperity: a file, the name of a shipped table (steel-4340, steel-1045, steel-304,
    /// aluminium-6061, copper, titanium-6al4v on a rigid flat that conducts heat like the metal; NAME-rate likewise with a rate law;
    /// NAME-rigid on an isothermal one), or model:NAME for a closed form
    #[arg(long, value_name = "TABLE", required_unless_present = "material", conflicts_with = "material")]
    table: Option<String>,
    /// Material of a shipped table, in place of --table: the flat is rigid and conducts heat like it
    #[arg(long, value_name = "NAME", value_parser = shipped_material)]
    material: Option<String>,
    /// Keep mean pressure and friction of contacts too large for their asperities, instead of refusing
    #[arg(long)]
    pub extrapolate: bool,
    /// Interpolate around cells of the table that failed or were not run, and leave out interferences and slip rates
    /// without any result, with a warning
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
    /// Nominal pressures, Pa or with a unit: 1e6, 1MPa, 1e5,1e6, 1e5..1e7 (logarithmic, four a decade), or 1e5..1e7:9 (points);
    /// of a topography 1e5,1e6,1e7 by default
    #[arg(long, value_name = "VALUES", allow_hyphen_values = true, conflicts_with = "separation", value_parser = pressures)]
    pressure: Option<Values>,
    /// Separations in place of pressures, m or with a unit: 1e-7, 0.1um
    #[arg(long, value_name = "VALUES", allow_hyphen_values = true, value_parser = separations)]
    separation: Option<Values>,
    /// Slip rates, m/s or with a unit: 0.1, 5mm/s; of a topography 0.1,1,10 by default
    #[arg(long, value_name = "VALUES", allow_hyphen_values = true, value_parser = slip_rates)]
    slip_rate: Option<Values>,
    /// Quantity held during the slide, load by default
    #[arg(long, value_name = "QUANTITY", value_enum)]
    hold: Option<LoadingControl>,
    /// Slip over which a contact lasts, in contact diameters, or steady; 1 by default, as between two rough faces
    #[arg(long, value_name = "DIAMETERS|steady", allow_negative_numbers = true)]
    contact_life: Option<ContactLife>,
    /// Elastic interaction of the summits, none by default; mean-pressure displaces the mean plane
    #[arg(long, value_name = "KIND", value_enum)]
    interaction: Option<Interaction>,
    /// Side of the square nominal area, m or with a unit; needed by --interaction mean-pressure; the warning of nominal heating is for this length
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, value_parser = length)]
    nominal_size: Option<f64>,
    /// Any key: section.key=value, such as surface.heights.std=1e-7; may be repeated
    #[arg(long, value_name = "SECTION.KEY=VALUE")]
    set: Vec<Override>,
}

fn pressures(text: &str) -> Result<Values, String> {
    Values::parse(text, &units::PRESSURE)
}

fn separations(text: &str) -> Result<Values, String> {
    Values::parse(text, &units::LENGTH)
}

fn slip_rates(text: &str) -> Result<Values, String> {
    Values::parse(text, &units::SLIP_RATE)
}

fn shipped_material(text: &str) -> Result<String, String> {
    let known: Vec<&str> = shipped::metals().collect();
    match known.contains(&text) {
        true => Ok(text.to_owned()),
        false => Err(format!(
            "no table of it is shipped: {}; for another material --table FILE",
            hint(text, &known)
        )),
    }
}

impl QueryOptions {
    /// Overrides of the options, after those of `--set`; `others` are of options that one command alone has.
    fn overrides(&self, others: Vec<Override>) -> Result<Vec<Override>, Failure> {
        let Self { pressure, separation, slip_rate, .. } = self;
        let mut overrides = query_values(pressure.as_ref(), separation.as_ref(), slip_rate.as_ref());
        overrides.extend(self.hold.map(|control| query_key("hold", control)));
        overrides.extend(self.contact_life.map(|life| query_key("contact_life", life)));
        overrides.extend(self.interaction.map(|kind| query_key("interaction", kind)));
        overrides.extend(self.nominal_size.map(|size| query_key("nominal_size", size)));
        overrides.extend(others);
        match self.set.iter().find(|set| overrides.iter().any(|option| set.path.starts_with(&option.path))) {
            Some(twice) => Err(Failure::input(format!(
                "--set {}: an option of the command replaces this key; leave out one of the two",
                twice.key()
            ))),
            None => Ok([&self.set[..], &overrides].concat()),
        }
    }
}

impl InputOptions {
    /// Checks the outputs, and reads all inputs; `others` are keys that one command alone gives.
    pub fn read(&self, outputs: &Roles, others: Vec<Override>) -> Result<Case, Failure> {
        let overrides = self.query.overrides(others)?;
        let topography = is_topography(&self.surface);
        let role = if topography { "the topography" } else { "the surface file" };
        let mut inputs: Vec<(&str, &Path)> = vec![(role, &self.surface)];
        let table = self.table.as_deref().map(Path::new).filter(|table| table.exists());
        inputs.extend(self.topography.input());
        inputs.extend(table.map(|table| ("--table", table)));
        check_files(check_results, &inputs, outputs)?;
        let measured = match topography {
            true => Some(self.topography.characterize(&self.surface, false)?),
            false => self.topography.refuse(&self.surface).map(|()| None)?,
        };
        let file = match &measured {
            Some(found) => {
                let name = self.topography.name(&self.surface);
                surface_of(found, (&self.surface, &name), &overrides)
            }
            None => SurfaceFile::read_with(&self.surface, &overrides),
        };
        let file = file.map_err(Failure::input)?;
        let heights = file.heights_file.iter().map(|heights| ("the heights of the surface file", &**heights));
        check_files(check_results, &heights.collect::<Vec<_>>(), outputs)?;
        let table = self.table.as_deref().or(self.material.as_deref()).unwrap_or_default();
        Case::open(file, measured, table, self.allow_missing).map_err(Failure::input)
    }
}
