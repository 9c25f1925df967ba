//! CPU time of reading a URDF of a hundred links: to the tree with all that is to be said of the text, and on to the table of
//! its longest chain, proved; beside it the crate `urdf-rs`, which reads the same text.

use crate::measure::processor_times;
use anyhow::{Context, Result};
use denavit::description::{Alone, Convention, Decimals, Mechanism, read_bodies};
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::hint::black_box;

/// Measurements a figure.
const REPEATS: usize = 15;
const LINKS: usize = 100;
/// A chain in which every joint moves; one as those of products are, in which most links are fixed to others; a tree that
/// branches at every tenth link.
const KINDS: [&str; 3] = ["chain", "fixed", "tree"];

/// Measures; prints one JSON object.
///
/// # Errors
/// If a text cannot be read.
pub fn run() -> Result<()> {
    let files = KINDS.into_iter().map(one).collect::<Result<Vec<Value>>>()?;
    println!("{}", json!({"files": files, "repeats": REPEATS}));
    Ok(())
}

fn one(kind: &'static str) -> Result<Value> {
    let time = |work| -> Result<Value> {
        Ok(processor_times(kind, REPEATS, work)?.context("reading is never refused")?.json())
    };
    Ok(json!({
        "name": kind, "bytes": text(kind).len(), "moving": tree(kind)?.variables().len(),
        "read": time(read)?, "table": time(table)?, "urdf-rs": time(peer)?,
    }))
}

fn tree(kind: &str) -> Result<Mechanism> {
    let (outcome, _) = read_bodies("arm.urdf", &text(kind), &mut Alone, &[], Decimals::Meant);
    let (mechanism, _) = outcome.map_err(|findings| anyhow::anyhow!("{kind}: {findings:?}"))?;
    Ok(mechanism)
}

fn read(kind: &str) -> Result<bool> {
    black_box(tree(kind)?);
    Ok(true)
}

fn table(kind: &str) -> Result<bool> {
    let tree = tree(kind)?;
    let to = format!("l{LINKS}");
    black_box(tree.chain(None, Some(&to), Convention::Standard).map_err(|e| anyhow::anyhow!("{e:?}"))?);
    Ok(true)
}

fn peer(kind: &str) -> Result<bool> {
    black_box(urdf_rs::read_from_string(&text(kind))?);
    Ok(true)
}

/// A URDF as exporters write it, with all that a link and a joint have.
fn text(kind: &str) -> String {
    let mut out = String::from("<?xml version=\"1.0\"?>\n<robot name=\"arm\">\n  <link name=\"l0\"/>\n");
    for k in 1..=LINKS {
        let (motion, parent) = match kind {
            "fixed" if k % 14 != 0 => ("fixed", k - 1),
            "tree" if k % 10 == 1 => ("revolute", k / 10),
            _ => ("revolute", k - 1),
        };
        let geometry = format!(
            "<geometry><mesh filename=\"package://arm/meshes/l{k}.stl\" scale=\"0.001 0.001 0.001\"/></geometry>"
        );
        let _ = write!(
            out,
            "  <link name=\"l{k}\">\n    <inertial>\n      <origin xyz=\"0.01 0 0.0{k}\" rpy=\"0 0 0\"/>\n      <mass value=\"1.{k}\"/>\n      \
             <inertia ixx=\"0.01\" ixy=\"0.0001\" ixz=\"0\" iyy=\"0.012\" iyz=\"0\" izz=\"0.005\"/>\n    </inertial>\n    \
             <visual><origin xyz=\"0 0 0\" rpy=\"0 0 0\"/>{geometry}</visual>\n    <collision>{geometry}</collision>\n  </link>\n  \
             <joint name=\"j{k}\" type=\"{motion}\">\n    <origin xyz=\"0.0{k} 0 0.12\" rpy=\"{turn} 0 0\"/>\n    \
             <parent link=\"l{parent}\"/>\n    <child link=\"l{k}\"/>\n    <axis xyz=\"0 0 1\"/>\n    \
             <limit lower=\"-2.9\" upper=\"2.9\" effort=\"87\" velocity=\"2.2\"/>\n    <dynamics damping=\"0.1\" friction=\"0.2\"/>\n  </joint>\n",
            turn = ["0", "1.5707963267948966", "-1.5707963267948966"][k % 3],
        );
    }
    out + "</robot>\n"
}
