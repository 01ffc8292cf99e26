//! Options of a measured topography, for every command that reads one.

use super::common::*;
use clap::Args;
use roughsurface::surface::units::{LENGTH, length};
use roughsurface::topography::characterize::{Characterization, Detrend, Options, characterize};
use roughsurface::topography::readers::{Reading, is_topography, read};
use roughsurface::topography::spectrum::Window;
use roughsurface::topography::two_faces::characterize_both;
use roughsurface::topography::warning::options_of_other;
use std::path::{Path, PathBuf};

#[derive(Args)]
#[command(next_help_heading = "Topography")]
pub struct TopographyOptions {
    /// Short-wavelength cut-off (Gaussian, ISO 16610): metres or with a unit, 2e-6 or 2um; by default four
    /// points, or the length at which noise contributes 5 % of m4
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, value_parser = length)]
    cutoff: Option<f64>,
    /// Trend to take off; by default the plane, of a periodic topography the mean
    #[arg(long, value_enum)]
    detrend: Option<Detrend>,
    /// Edges of a topography that is not periodic: left out, with a tapered spectrum, or as of a periodic one; by
    /// default hann
    #[arg(long, value_enum)]
    window: Option<Window>,
    /// The topography continues at its other side; NetCDF states it
    #[arg(long)]
    periodic: bool,
    /// Unit of the lengths that a text or npy file does not state: km, m, cm, mm, um, nm, pm, A, in, mil, uin; by default m
    #[arg(long, value_name = "UNIT", value_parser = unit)]
    unit: Option<f64>,
    /// Distance between the points of a text or npy file that does not state it, or only counts them
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, value_parser = length)]
    pixel: Option<f64>,
    /// Topography of the face on the other side, where both are rough: the sum of the heights, taken to be independent,
    /// slides on a smooth flat
    #[arg(long, value_name = "FILE")]
    other_face: Option<PathBuf>,
    /// Unit of the lengths that the file of --other-face does not state
    #[arg(long, value_name = "UNIT", value_parser = unit, requires = "other_face")]
    other_unit: Option<f64>,
    /// Distance between the points of --other-face, where its file does not state it
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, value_parser = length, requires = "other_face")]
    other_pixel: Option<f64>,
}

fn unit(text: &str) -> Result<f64, String> {
    LENGTH.factor(text).ok_or_else(|| format!("must be a unit of length: {}", LENGTH.known()))
}

impl TopographyOptions {
    /// Refuses the options for a surface file, if there is one.
    pub fn refuse(&self, file: &Path) -> Result<(), Failure> {
        for (option, given) in [
            ("--cutoff", self.cutoff.is_some()),
            ("--detrend", self.detrend.is_some()),
            ("--window", self.window.is_some()),
            ("--periodic", self.periodic),
            ("--unit", self.unit.is_some()),
            ("--pixel", self.pixel.is_some()),
            ("--other-face", self.other_face.is_some()),
        ] {
            if given && file.exists() {
                let shown = file.display();
                return Err(Failure::input(format!(
                    "{option} is for a topography; {shown} is a surface file"
                )));
            }
        }
        Ok(())
    }

    /// The other face as an input of a command.
    pub fn input(&self) -> Option<(&'static str, &Path)> {
        self.other_face.as_deref().map(|file| ("--other-face", file))
    }

    /// Name of the topography `file`, and of the face on the other side, for comments and messages.
    pub fn name(&self, file: &Path) -> String {
        let name = |file: &Path| file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        match &self.other_face {
            Some(other) => format!("{} on {}", name(file), name(other)),
            None => name(file),
        }
    }

    /// Reads and characterises a topography, and the one on the other side; summits found can be asked `of_maps` only.
    pub fn characterize(&self, file: &Path, of_maps: bool) -> Result<Characterization, Failure> {
        let read = |file: &Path, unit, pixel| {
            let mut topography = read(file, &Reading { unit, pixel }).map_err(|error| error.to_string())?;
            topography.periodic |= self.periodic;
            Ok::<_, String>(topography)
        };
        let refused = |file: &Path, what: String| Failure::input(format!("{}: {what}", file.display()));
        let topography = read(file, self.unit, self.pixel).map_err(Failure::input)?;
        if of_maps && topography.is_profile() {
            let what = "peaks of a profile are no summits; --summits found needs a map";
            return Err(refused(file, what.into()));
        }
        let window = self.window.unwrap_or_default();
        let options = Options { cutoff: self.cutoff, detrend: self.detrend, window };
        match &self.other_face {
            None => characterize(topography, &options).map_err(|what| refused(file, what)),
            Some(_) if of_maps => Err(Failure::input(
                "--summits found are of one face; with --other-face they follow from the moments of both",
            )),
            Some(other) if other.is_file() && !is_topography(other) => {
                Err(refused(other, "is a surface file; --other-face takes a topography".into()))
            }
            Some(other) => {
                let of_other = read(other, self.other_unit, self.other_pixel);
                let faces = [topography, of_other.map_err(|what| Failure::input(options_of_other(&what)))?];
                characterize_both(faces, &options).map_err(|(index, what)| match index {
                    0 => refused(file, what),
                    _ => refused(other, options_of_other(&what)),
                })
            }
        }
    }
}
