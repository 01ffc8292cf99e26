pub(crate) mod contact_maps;
pub mod figures;
pub mod numbers;
pub mod provenance;
pub mod revolved;
pub mod run_file;
pub mod vtu;
