//! docs/operation-counts.md: our operation counts beside those of SymPy, OpenSYMORO and the documents.

use crate::{CATALOGUE, denavit, path, robots};
use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::fmt::Write;
use std::fs;

const PAGE: &str = "docs/operation-counts.md";
const SYMPY: &str = "crates/robot/tests/peers/sympy_counts.json";
const OPENSYMORO: &str = "crates/robot/tests/peers/opensymoro.json";

/// How the program begins to say that a model is proved.
const PROVED: &str = "proved ";

/// Results that somebody asked for in part: robot, outputs, what it is, and multiplications and additions of others.
const PARTS: &[(&str, &str, &str, &str)] = &[
    ("prrrrp", "x,z,position", "columns x and z and the position, with the tool", "26, 13 (the document)"),
    ("prrrrp", "position", "the position, with the tool", ""),
    ("staubli-rx90", "position", "the position", ""),
];

/// Multiplications, additions (offsets among them), and sine/cosine pairs.
#[derive(Clone, Copy)]
struct Triple {
    multiplications: u64,
    additions: u64,
    sincos: u64,
}

impl Triple {
    fn sum(self) -> u64 {
        self.multiplications + self.additions
    }

    fn show(self) -> String {
        format!("{}, {}, {}", self.multiplications, self.additions, self.sincos)
    }
}

/// A forward model as `denavit derive` gives it.
struct Model {
    count: Triple,
    proof: String,
}

impl Model {
    fn derive(robot: &str, extra: &[&str]) -> Result<Self> {
        let printed = denavit([&["derive", robot, "--json"], extra].concat())?;
        let forward = &serde_json::from_str::<Value>(&printed)?["forward"];
        let count = &forward["count"];
        let number = |key: &str| count[key].as_u64().with_context(|| format!("{robot}: no number of {key}"));
        let count = Triple {
            multiplications: number("multiplications")?,
            additions: number("additions")? + number("offsets")?,
            sincos: number("sincos")?,
        };
        Ok(Model { count, proof: forward["proof"].as_str().context("a proof")?.into() })
    }

    /// ⁰Tₙ, without base and tool.
    fn of_table(robot: &str) -> Result<Self> {
        let text = fs::read_to_string(path(&format!("{CATALOGUE}/{robot}.toml")))?;
        let file: toml::Table = text.parse()?;
        let rows = file.get("joints").and_then(|joints| joints.as_array()).context("a list of joints")?.len();
        Model::derive(robot, &["--from", "0", "--to", &rows.to_string()])
    }
}

/// What the program says of its way to count.
fn counting_rule() -> Result<String> {
    let printed = denavit(["derive", PARTS[0].0])?;
    let rule = printed.lines().find_map(|l| l.trim().strip_prefix("counted: "));
    rule.map(String::from).context("`derive` says how it counts")
}

/// Writes the page, or with `check` compares it.
///
/// # Errors
/// With `check`: if the page is not up to date, or SymPy needs fewer operations for a robot.
pub fn run(check: bool) -> Result<()> {
    let sympy = json(SYMPY)?;
    let opensymoro = json(OPENSYMORO)?;
    let (text, above) = page(&sympy, &opensymoro)?;
    for line in &above {
        println!("{line}");
    }
    if !check {
        fs::write(path(PAGE), text)?;
        println!("wrote {PAGE}");
        return Ok(());
    }
    if fs::read_to_string(path(PAGE)).ok().as_deref() != Some(&text) {
        bail!("{PAGE} is not up to date; `cargo xtask counts` renews it");
    }
    if !above.is_empty() {
        bail!("SymPy needs fewer operations for {} robots", above.len());
    }
    println!("{PAGE} is up to date, and no robot takes more operations than with SymPy");
    Ok(())
}

fn json(file: &str) -> Result<Value> {
    let text = fs::read_to_string(path(file)).with_context(|| file.to_string())?;
    serde_json::from_str(&text).with_context(|| file.to_string())
}

/// The page, and a line for each robot that SymPy does in fewer operations.
fn page(sympy: &Value, opensymoro: &Value) -> Result<(String, Vec<String>)> {
    let mut rows = String::new();
    let mut above = vec![];
    let mut unproved = vec![];
    for name in &robots()? {
        let model = Model::of_table(name)?;
        let ours = model.count;
        if !model.proof.starts_with(PROVED) {
            unproved.push(format!("`{name}` ({})", model.proof));
        }
        let peer = &sympy["robots"][name];
        let (simplified, raw) = (triple(&peer["trigsimp"]), triple(&peer["raw"]));
        if let Some(best) = [simplified, raw].into_iter().flatten().min_by_key(|t| (t.sum(), t.sincos))
            && (ours.sum() > best.sum() || ours.sincos > best.sincos)
        {
            above.push(format!("{name}: {} here, {} with SymPy", ours.show(), best.show()));
        }
        let show = |t: Option<Triple>, v: &Value| {
            t.map_or_else(|| v.as_str().unwrap_or("–").to_string(), Triple::show)
        };
        let other = triple(&opensymoro["robots"][name]["counts"]);
        let _ = writeln!(
            rows,
            "| {name} | {} | {} | {} | {} |",
            ours.show(),
            show(simplified, &peer["trigsimp"]),
            show(raw, &peer["raw"]),
            other.map_or(String::new(), |t| format!("{}, {}", t.multiplications, t.additions)),
        );
    }
    let mut parts = String::new();
    for (name, outputs, what, other) in PARTS {
        let ours = Model::derive(name, &["--only", outputs])?.count;
        let _ = writeln!(parts, "| {name} | {what} | {} | {other} |", ours.show());
    }
    let proved = match &unproved[..] {
        [] => "Every algorithm counted is proved equal to the product of its table.".to_string(),
        names => format!(
            "Every algorithm counted is proved equal to the product of its table, except {}.",
            names.join(", ")
        ),
    };
    let rule = counting_rule()?;
    let version = sympy["provenance"]["sympy"].as_str().unwrap_or("version unknown");
    let source = opensymoro["provenance"].as_str().unwrap_or_default();
    let text = format!(
        "# Operation counts\n\n\
         What the forward model costs to evaluate: multiplications, additions, sine/cosine pairs. The transform is ⁰Tₙ\n\
         with all twelve entries, without base and tool, every length of the table a symbol.\n\n\
         Rule: {rule}. In this table the offsets of joints are among the additions, as they are in SymPy's.\n\n\
         - **SymPy** {version}: `cse` of the twelve entries, simplified with `trigsimp` first or straight from the product\n\
         (the better of `cse` with and without its optimisations); figures from\n\
         [`sympy_counts.json`](../{SYMPY}), which the script beside it makes.\n\
         - **OpenSYMORO**: multiplications and additions. {source}\n\n\
         `cargo xtask counts --check` fails if multiplications and additions together, or the pairs, are more here than in\n\
         the better of SymPy's two columns (the one with the smaller sum of multiplications and additions).\n\n\
         {proved}\n\n\
         | robot | here | SymPy, trigsimp | SymPy, product | OpenSYMORO |\n|---|--:|--:|--:|--:|\n{rows}\n\
         ## Parts\n\n\
         | robot | outputs | here | others |\n|---|---|--:|---|\n{parts}\n\
         Renew with `cargo xtask counts`.\n"
    );
    Ok((text, above))
}

/// `{"mul": …, "add": …, "sincos": …}`; anything else (a timeout) is none.
fn triple(value: &Value) -> Option<Triple> {
    Some(Triple {
        multiplications: value["mul"].as_u64()?,
        additions: value["add"].as_u64()?,
        sincos: value["sincos"].as_u64().unwrap_or(0),
    })
}
