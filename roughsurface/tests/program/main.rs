//! The program from topography, surface file and table to results, and the numbers of the worked examples.

mod characterize;
mod demonstration;
mod export;
mod folder;
mod map_to_friction;
mod overwriting;
mod predict;
mod refusals;
mod worked_examples;
