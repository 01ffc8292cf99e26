//! Friction of a rough surface from the friction of one asperity.
//!
//! A rough surface is a crowd of spherical summits of one radius, their heights
//! spread over a distribution, against a smooth rigid flat (Greenwood &
//! Williamson 1966). What one summit does, [`tables::law::AsperityLaw`], is
//! integrated over the heights at each slip; the friction of the surface is read
//! from that curve, not from the asperities' own peaks, because asperities pressed
//! more and less reach theirs at different slips.
//!
//! Not modelled: interaction of neighbouring asperities, adhesion, a deformable
//! or rough counter-face.

pub mod asperity_at_slip;
pub mod comparison;
pub mod contact_state;
pub mod flash_heating;
pub mod friction;
pub mod friction_figure;
pub mod friction_file;
pub mod heights;
pub mod integral;
mod kronrod;
pub mod law_source;
pub mod monte_carlo;
pub mod monte_carlo_file;
mod panels;
pub mod query;
pub mod radii;
pub mod rate_dependence;
pub mod regime;
pub mod report;
pub mod separation;
pub mod slip_curve;
pub mod summary;
pub mod surface_file;
pub mod surface_integral;
mod sweep;
pub mod topography;
pub mod trail;
pub mod uncertainty;

#[doc = include_str!("worked_examples.md")]
pub mod worked_examples {}

#[cfg(test)]
mod test_laws;
