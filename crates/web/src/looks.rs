//! What the bodies of a tree look like, and how they move with the joints of a chain through it.

use crate::dropped::Dropped;
use denavit::description::{Chain, JointKind, Mechanism, Shape};
use denavit_symbolic::Expr;
use denavit_wire::pose::{Matrix, matrix};
use denavit_wire::robot::kind;
use serde::Serialize;
use std::collections::BTreeMap;

/// The bodies of a tree as they are drawn: those that no joint of the chain moves stand as at rest.
#[derive(Serialize)]
pub struct Looks {
    /// The body whose frame is the base of the chain.
    base: usize,
    bodies: usize,
    /// From the root on.
    joints: Vec<Joint>,
    parts: Vec<Part>,
}

/// A joint: child = parent · origin · motion.
#[derive(Serialize)]
struct Joint {
    axis: [f64; 3],
    child: usize,
    /// Its value is factor · variable + offset.
    factor: f64,
    /// Nothing for one that is fixed.
    kind: Option<&'static str>,
    offset: f64,
    origin: Matrix,
    parent: usize,
    /// The joint variable of the chain that moves it.
    variable: Option<usize>,
}

/// A shape at a body.
#[derive(Serialize)]
struct Part {
    body: usize,
    colour: Option<[f64; 4]>,
    /// The path of its mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<String>,
    origin: Matrix,
    shape: &'static str,
    /// Edges of a box; radius and length of a cylinder, or of that of a capsule; half the axes of an ellipsoid; radius of a ball;
    /// scales of a mesh.
    size: [f64; 3],
}

/// Meshes that are not there.
pub struct Missing {
    /// The package, or nothing for files that are named by a path.
    pub package: Option<String>,
    /// How many, and the first one.
    pub count: usize,
    pub first: String,
}

/// How a tree looks, and which meshes are missing; `main` is the path of its description.
pub fn looks(mechanism: &Mechanism, chain: &Chain, files: &Dropped, main: &str) -> (Looks, Vec<Missing>) {
    let mut missing: BTreeMap<Option<String>, Missing> = BTreeMap::new();
    let mut parts = vec![];
    for (body, look) in
        mechanism.bodies.iter().enumerate().flat_map(|(k, b)| b.looks.iter().map(move |l| (k, l)))
    {
        let (shape, size, file) = match &look.shape {
            Shape::Box(size) => ("box", *size, None),
            Shape::Cylinder { radius, length } => ("cylinder", [*radius, *length, 0.0], None),
            Shape::Capsule { radius, length } => ("capsule", [*radius, *length, 0.0], None),
            Shape::Ellipsoid(half) => ("ellipsoid", *half, None),
            Shape::Sphere { radius } => ("sphere", [*radius, 0.0, 0.0], None),
            Shape::Mesh { file, scale } => match files.mesh(main, file) {
                Some(path) => ("mesh", *scale, Some(path)),
                None => {
                    let package = Dropped::package_named(file).map(str::to_string);
                    let new = || Missing { package: package.clone(), count: 0, first: file.clone() };
                    missing.entry(package.clone()).or_insert_with(new).count += 1;
                    continue;
                }
            },
        };
        parts.push(Part { body, colour: look.colour, file, origin: matrix(&look.origin), shape, size });
    }
    let joints = (0..mechanism.joints.len()).map(|j| joint(mechanism, chain, j)).collect();
    let looks = Looks { base: chain.from, bodies: mechanism.bodies.len(), joints, parts };
    (looks, missing.into_values().collect())
}

fn joint(mechanism: &Mechanism, chain: &Chain, j: usize) -> Joint {
    let joint = &mechanism.joints[j];
    let axis = joint.axis.map(number);
    let length = axis.norm();
    let (variable, factor, offset) = moves(mechanism, chain, j);
    Joint {
        axis: if length > 0.0 { axis.scale(1.0 / length).0 } else { axis.0 },
        child: joint.child,
        factor,
        kind: joint.kind.map(|k: JointKind| kind(k)),
        offset,
        origin: matrix(&joint.origin.map(number)),
        parent: joint.parent,
        variable,
    }
}

/// The variable of the chain that moves a joint, with its factor and what is added; of others at rest what is added.
fn moves(mechanism: &Mechanism, chain: &Chain, j: usize) -> (Option<usize>, f64, f64) {
    let of = |j: usize| match &mechanism.joints[j].follows {
        Some(f) => (f.joint, f.factor.to_f64(), number(f.offset)),
        None => (j, 1.0, 0.0),
    };
    let variable = |j: usize| chain.joints.iter().position(|&c| c == j);
    let (leader, factor, offset) = of(j);
    if let Some(k) = variable(j) {
        return (Some(k), 1.0, 0.0);
    }
    if let Some(k) = variable(leader) {
        return (Some(k), factor, offset);
    }
    // One on the way that follows the same leader is the variable: q = f·l + o, so l = (q − o)/f.
    let same = chain.joints.iter().enumerate().map(|(k, &c)| (k, of(c)));
    match same.into_iter().find(|(_, (l, f, _))| *l == leader && *f != 0.0) {
        Some((k, (_, f, o))) => (Some(k), factor / f, offset - factor * o / f),
        None => (None, 0.0, offset),
    }
}

fn number(e: Expr) -> f64 {
    e.eval(|_| None).unwrap_or(0.0)
}
