//! Speed of generated CUDA on a GPU beside the same functions in C: `bench/cuda`.

use super::MISSED;
use super::dynamics::{ARMS, output};
use crate::languages::quietly;
use crate::{command, path, program, target};
use anyhow::{Context, Result};
use serde_json::Value;
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::Command;

/// The part's name.
pub(super) const NAME: &str = "gpu";
const MOVING: &str = "torque,inertia,acceleration,torque_with_derivatives";
/// How far the kernels may be from C, in units in the last place.
const UNITS: f64 = 4.0;

const INTRODUCTION: &str = "\
A UR5 and a Panda with the numbers of their URDFs: generated kernels, one thread a configuration, in double and in single\n\
precision, compiled by nvcc for the device. Each kernel computes @count@ random configurations that lie in the device's memory;\n\
times are medians of 25 launches. Bytes are those that must be read and written for one configuration; the share is theirs a\n\
second, of what a copy within the device's memory reads and writes (@copy@ here). Beside it: how far\n\
@held@ of the results are from those of generated C (one state, gcc), and how far both are from the same statements in long double, in\n\
units in the last place of the largest value that any result takes; for `ik` how many have another number of solutions than C, another\n\
certificate or a solution that is off by more than 1e-7. Accelerations divide by the pivots of the inertia matrix, which makes rounding\n\
as many times larger as the matrix is badly conditioned, in C as in CUDA.\n";

/// Whether there is a compiler for GPUs.
pub(super) fn is_here() -> bool {
    Command::new("nvcc").arg("--version").output().is_ok_and(|o| o.status.success())
}

/// Generates, builds and measures, and gives the section of the page.
///
/// # Errors
/// If there is no `nvcc` or no GPU, or results differ.
pub fn run() -> Result<String> {
    let folder = target().join("bench/cuda");
    fs::create_dir_all(&folder)?;
    prepared(&folder)?;
    let mut nvcc = Command::new("nvcc");
    nvcc.args(["-O3", "-arch=native", "bench.cu"])
        .args(objects())
        .args(["truth.o", "-o", "bench"])
        .current_dir(&folder);
    quietly(&mut nvcc).context("this part needs CUDA's compiler")?;
    let measured: Value = serde_json::from_str(&output(&mut Command::new(folder.join("bench")))?)
        .context("the benchmark prints JSON")?;
    let table = table(&measured)?;
    println!("{table}");
    Ok(table)
}

/// Writes the program and all that it is built of, with the part in C compiled.
fn prepared(folder: &Path) -> Result<()> {
    let program = program()?;
    for (file, tip, arm) in ARMS {
        let file = path(&format!("crates/robot/tests/urdf/{file}.urdf"));
        for (precision, more) in [("double", &[][..]), ("float", &["--float"])] {
            // One closed form is enough: solvers compute in double precision.
            let ik = if arm == "ur5" && precision == "double" { ",ik" } else { "" };
            for (kind, functions) in [("", format!("fk,jacobian{ik}")), ("_moving", MOVING.into())] {
                for language in ["cuda", "c"] {
                    let name = format!("{arm}{kind}_{precision}_{language}");
                    let mut generate = command(&program);
                    generate.arg("generate").arg(&file).args(["--tip", tip, "--language", language]);
                    generate.args(["--functions", &functions, "--name", &name, "--force"]).args(more);
                    quietly(generate.arg("--output").arg(folder))?;
                }
            }
        }
    }
    for object in objects() {
        let mut gcc = Command::new("gcc");
        gcc.args(["-std=c99", "-O3", "-ffp-contract=off", "-march=x86-64-v3", "-c"]);
        quietly(gcc.arg(object.replace(".o", ".c")).current_dir(folder))?;
    }
    truth(folder)?;
    fs::copy(path("bench/cuda/bench.cu"), folder.join("bench.cu"))?;
    Ok(())
}

/// The functions in C with another type of numbers, 64 bits in place of 53 or 24, and sines of the library: `truth.c` and its header.
fn truth(folder: &Path) -> Result<()> {
    let mut text = String::from(
        "#include <math.h>\n#include \"truth.h\"\n\
         static void eight_sines_and_cosines(const long double *x, long double *s, long double *c)\n\
         {\n    for (int i = 0; i < 8; i++) {\n        s[i] = sinl(x[i]);\n        c[i] = cosl(x[i]);\n    }\n}\n",
    );
    let mut header = String::new();
    for object in objects() {
        let source = fs::read_to_string(folder.join(object.replace(".o", ".c")))?;
        let real = if object.contains("float") { "float" } else { "double" };
        let name = object.trim_end_matches("_c.o");
        let functions = if object.contains("moving") { MOVING } else { "fk,jacobian" };
        for function in functions.split(',') {
            let head = format!("void {name}_c_{function}(");
            let from = source.find(&head).with_context(|| format!("no {function} in {name}"))?;
            let length = source[from..].find("\n}\n").context("a function ends")? + 3;
            let own = source[from..from + length]
                .replace(&format!("{name}_c_"), &format!("{name}_truth_"))
                .replace(&format!("{real} "), "long double ");
            let (signature, _) = own.split_once("\n{").context("a function has a body")?;
            header += &format!("extern {signature};\n");
            text += &own;
        }
    }
    let header =
        format!("#ifdef __cplusplus\nextern \"C\" {{\n#endif\n{header}#ifdef __cplusplus\n}}\n#endif\n");
    fs::write(folder.join("truth.h"), header)?;
    fs::write(folder.join("truth.c"), text)?;
    let mut gcc = Command::new("gcc");
    quietly(gcc.args(["-std=c99", "-O1", "-c", "truth.c"]).current_dir(folder))
}

/// What the part in C is compiled to.
fn objects() -> Vec<String> {
    let kinds = ["", "_moving"].iter().flat_map(|kind| ["double", "float"].map(|real| (*kind, real)));
    let of = |arm: &str| kinds.clone().map(|(k, real)| format!("{arm}{k}_{real}_c.o")).collect::<Vec<_>>();
    ARMS.iter().flat_map(|arm| of(arm.2)).collect()
}

/// The introduction and a table of what `bench` prints.
fn table(measured: &Value) -> Result<String> {
    let number = |v: &Value, key: &str| v[key].as_f64().with_context(|| format!("the number `{key}`"));
    let word = |v: &Value, key: &str| v[key].as_str().unwrap_or_default().to_string();
    let copy = number(measured, "copy")?;
    let mut text = format!("Device: {}.\n\n", word(measured, "device"));
    text += &INTRODUCTION
        .replace("@count@", &number(measured, "count")?.to_string())
        .replace("@held@", &number(measured, "held")?.to_string())
        .replace("@copy@", &format!("{:.2} TB/s", copy / 1e12));
    text += "\n| | precision | ns a configuration | bytes | share of the copy | from C | limit | off by | C |\n\
             |---|---|---:|---:|---:|---:|---:|---:|---:|\n";
    for figure in measured["figures"].as_array().context("a list of figures")? {
        let name = word(figure, "name");
        let apart = number(figure, "apart")?;
        let limit = if name == "ik" { 0.0 } else { UNITS };
        let held = if name == "ik" { format!("{apart:.0} of 10^6") } else { format!("{apart:.2} units") };
        let _ = writeln!(
            text,
            "| {}: {name} | {} | {:.3} | {:.0} | {:.0} % | {held} | {limit}{} | {:.2} | {:.2} |",
            word(figure, "arm"),
            word(figure, "real"),
            number(figure, "ns")?,
            number(figure, "bytes")?,
            100.0 * number(figure, "share")?,
            if apart > limit { format!(" {MISSED}") } else { String::new() },
            number(figure, "off")?,
            number(figure, "c")?,
        );
    }
    Ok(text)
}
