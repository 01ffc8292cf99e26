//! The Python module `asperity._core`: conversion between Python and the libraries.
//!
//! Every function calls the one that the programs call, in a thread of its own without Python's lock, while the calling
//! thread shows progress and attends to interrupts ([`watch`]). The package around it (`python/asperity`) gives types,
//! units and documentation.

mod errors;
mod input;
mod run;
mod surface;
mod table;
mod tabulate;
mod watch;

use pyo3::exceptions::PyImportError;
use pyo3::prelude::*;

#[pymodule]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    match tables::netcdf::missing_instruction_set() {
        Some(name) => Err(PyImportError::new_err(tables::netcdf::unsuitable_processor(name))),
        None => fill(module),
    }
}

/// Not a part of `_core`, whose first instructions might already be ones that the processor lacks.
#[inline(never)]
fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("SHIPPED", tables::shipped::names().collect::<Vec<_>>())?;
    module.add("CLOSED_FORMS", tables::closed_forms::NAMES)?;
    module.add_class::<run::Run>()?;
    module.add_class::<table::Table>()?;
    module.add_class::<surface::Characterization>()?;
    module.add_class::<surface::Friction>()?;
    module.add_class::<surface::Samples>()?;
    module.add_function(wrap_pyfunction!(run::simulate, module)?)?;
    module.add_function(wrap_pyfunction!(tabulate::tabulate, module)?)?;
    module.add_function(wrap_pyfunction!(table::load, module)?)?;
    module.add_function(wrap_pyfunction!(surface::characterize_file, module)?)?;
    module.add_function(wrap_pyfunction!(surface::characterize_heights, module)?)?;
    module.add_function(wrap_pyfunction!(surface::predict, module)?)?;
    module.add_function(wrap_pyfunction!(surface::sample, module)?)?;
    Ok(())
}
