//! Emitted Python runs, and computes what it should.

use crate::support::{folder, only, run, small, write};
use denavit_emit::{Language, Precision};

/// The interpreter, which has NumPy; another than the first can be named.
fn python() -> String {
    std::env::var("DENAVIT_PYTHON").unwrap_or("python3".into())
}

#[test]
fn python_tests_itself() {
    if !crate::emitted::has(&[&python(), "-c", "import numpy"]) {
        return;
    }
    crate::emitted::run_all(Language::Python, 88, |files| {
        let test = crate::emitted::file_name(files, "test_", ".py");
        [&python(), "-B", "-W", "error", &test].map(String::from).to_vec()
    });
}

#[test]
fn few_variables_and_infinite_angles_and_other_types() {
    if !crate::emitted::has(&[&python(), "-c", "import numpy"]) {
        return;
    }
    for n in [0, 1] {
        let folder = folder(&format!("python-{n}"));
        let files = write(&small(n).library(Precision::Double), Language::Python, &folder);
        run(&folder, &[&python(), "-B", "-W", "error", &only(&files, "test_", ".py")]);
        let script = format!(
            "import numpy as np, x_test\nout = x_test.moving(np.full({n}, np.inf))\n\
             assert np.isnan(out).all() == bool({n})\n\
             try:\n    x_test.fixed(np.zeros({n}), {{'L': 1}})\nexcept TypeError as e:\n    \
             assert 'must be Parameters' in str(e)\nelse:\n    raise SystemExit('taken')\n"
        );
        run(&folder, &[&python(), "-B", "-W", "error", "-c", &script]);
    }
}
