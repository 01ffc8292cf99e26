//! The Python module `asperity._core`: conversion between Python and the libraries.
//!
//! Every function calls the one that the programs call, in a thread of its own without Python's lock, while the calling
//! thread shows progress and attends to interrupts ([`watch`]). The package around it (`python/asperity`) gives types,
//! units and documentation.

mod errors;
mod export;
mod input;
mod output;
mod run;
mod surface;
mod table;
mod tabulate;
mod watch;

use pyo3::ffi::{PyErr_Format, PyExc_ImportError, PyObject};
use pyo3::prelude::*;

unsafe extern "C" {
    /// Entry point of [`contents`], of PyO3.
    fn PyInit_contents() -> *mut PyObject;
}

/// Entry point for Python. The processor is checked first: that of PyO3 may already have instructions that it lacks.
///
/// # Safety
/// Python calls it, with its lock.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn PyInit__core() -> *mut PyObject {
    let Some(name) = tables::netcdf::missing_instruction_set() else { return unsafe { PyInit_contents() } };
    // Python joins the texts: a copy made here, as of an array, may be by the instructions that are missing.
    let (before, after) = (tables::netcdf::UNSUITABLE.as_ptr(), tables::netcdf::REMEDY.as_ptr());
    unsafe { PyErr_Format(PyExc_ImportError, c"%s%s%s".as_ptr(), before, name.as_ptr(), after) };
    std::ptr::null_mut()
}

#[pymodule]
fn contents(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("SHIPPED", tables::shipped::names().collect::<Vec<_>>())?;
    module.add("CLOSED_FORMS", tables::closed_forms::NAMES)?;
    module.add_class::<run::Run>()?;
    module.add_class::<table::Table>()?;
    module.add_class::<surface::Characterization>()?;
    module.add_class::<surface::Friction>()?;
    module.add_class::<surface::Samples>()?;
    module.add_class::<output::Figure>()?;
    module.add_function(wrap_pyfunction!(output::check_output, module)?)?;
    module.add_function(wrap_pyfunction!(output::write_bytes, module)?)?;
    module.add_class::<export::FrictionTable>()?;
    module.add_function(wrap_pyfunction!(run::simulate, module)?)?;
    module.add_function(wrap_pyfunction!(tabulate::tabulate, module)?)?;
    module.add_function(wrap_pyfunction!(table::load, module)?)?;
    module.add_function(wrap_pyfunction!(surface::characterize_file, module)?)?;
    module.add_function(wrap_pyfunction!(surface::characterize_heights, module)?)?;
    module.add_function(wrap_pyfunction!(surface::predict, module)?)?;
    module.add_function(wrap_pyfunction!(surface::sample, module)?)?;
    module.add_function(wrap_pyfunction!(export::friction_table, module)?)?;
    Ok(())
}
