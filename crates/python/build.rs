//! Leaves the symbols of Python open, as a module for it needs on some systems.

fn main() {
    pyo3_build_config::add_extension_module_link_args();
}
