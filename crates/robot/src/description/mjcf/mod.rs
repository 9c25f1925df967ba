//! MuJoCo's format of models (MJCF): bodies in bodies, with joints between each and the one that carries it.
//!
//! What stands in the world is a tree whose root is the body `world`; sites with a name are bodies without mass. Each joint moves its
//! body from where the file has it, `ref` being its value there. Lengths are exact decimals, angles in degrees exact, those in
//! radians, and quaternions, what their digits mean ([`Decimals`]). What a model says of contacts and actuators is left.

mod bodies;
mod bounds;
mod defaults;
mod equality;
mod geoms;
mod include;
mod joints;
mod keyframes;
mod loops;
mod turns;
mod write;

pub(super) use turns::matrix as rotation_of;

pub use write::{refused_masses, write_mjcf};

use super::Decimals;
use super::diagnostic::{Diagnostics, nearest};
use super::reader::Reader;
use super::sources::{Files, Sources};
use super::tree::{Hold, Mechanism};
use super::urdf::{Draft, Links, Reading, plain};
use super::xml::{Element, shown};
use crate::geometry::Axis;
use bodies::{Context, Named};
use bounds::Bounds;
use defaults::Classes;
use denavit_symbolic::{Expr, Rational};
use geoms::{Assets, FromGeoms, Weight};
use include::{Document, Opened};
use keyframes::Slot;
use std::collections::HashMap;
use std::ops::{Range, RangeInclusive};
use turns::{Compiler, Placing, Quaternions};

/// What stands in `<mujoco>` and says nothing of kinematics.
const BESIDE: [&str; 12] = [
    "option",
    "size",
    "statistic",
    "visual",
    "contact",
    "deformable",
    "tendon",
    "actuator",
    "sensor",
    "custom",
    "extension",
    "skin",
];

/// What stands there and does.
const READ: [&str; 6] = ["asset", "compiler", "default", "worldbody", "equality", "keyframe"];

/// The attributes of `<compiler>`, few of which matter here.
const COMPILER: [&str; 23] = [
    "angle",
    "eulerseq",
    "autolimits",
    "coordinate",
    "boundmass",
    "boundinertia",
    "settotalmass",
    "balanceinertia",
    "strippath",
    "fitaabb",
    "meshdir",
    "texturedir",
    "assetdir",
    "discardvisual",
    "usethread",
    "fusestatic",
    "inertiafromgeom",
    "inertiagrouprange",
    "exactmeshinertia",
    "saveinertial",
    "alignfree",
    "convexhull",
    "conflict",
];

/// A model of its own: what is said in it counts in it alone.
struct Model<'a> {
    root: Element<'a>,
    compiler: Compiler,
    classes: Classes<'a>,
    /// Where its masses come from.
    from_geoms: FromGeoms,
    /// The groups of geoms that weigh.
    groups: RangeInclusive<i64>,
    /// What no body of it is below.
    bounds: Bounds,
    /// The mass of all of it, if it is said, and where.
    total: Option<(Rational, Range<usize>)>,
    /// The folder of its meshes.
    folder: String,
    /// The models that it may attach.
    parts: &'a HashMap<String, usize>,
}

/// A mechanism under way.
struct Mjcf<'a, 'r> {
    reader: &'r mut Reader,
    quaternions: Quaternions,
    models: &'r [Model<'a>],
    links: Links,
    /// How each body got its name.
    named: Vec<Named>,
    drafts: Vec<Draft>,
    /// The joints that move, by their names.
    joints: HashMap<String, usize>,
    /// The value that each joint of `drafts` has where the file shows the model.
    references: HashMap<usize, Expr>,
    /// What a configuration (`qpos`) has values for, in its order.
    slots: Vec<Slot>,
    /// The models that are there: which, and what stands before and behind their names.
    parts: Vec<(usize, String, String)>,
    open: Vec<(Element<'a>, Context)>,
    work: usize,
    /// How many elements were repeated.
    repeated: usize,
    /// What geoms draw on.
    assets: Assets,
    /// Whether the mass of a body is that of its geoms.
    from_geoms: HashMap<usize, bool>,
    /// What the geoms of bodies weigh.
    weights: HashMap<usize, Weight>,
    /// The model that each body is of; sites are of none.
    model_of: HashMap<usize, usize>,
    /// Sites that have other names here, by where they stand: what they are called in the file and here.
    renamed: Vec<(Range<usize>, String, String)>,
    /// Closed loops.
    holds: Vec<Hold>,
    /// The joints that actuators drive.
    driven: Vec<String>,
    /// Bodies that a tracker moves.
    mocap: Vec<usize>,
}

/// Reads a model of MuJoCo's, with the files that it includes and the models that it attaches.
///
/// Places are those of all files together ([`Files`]).
///
/// # Errors
/// All errors of the texts (with the warnings and notes).
pub fn read_mjcf(name: &str, text: &str, sources: &mut dyn Sources, decimals: Decimals) -> (Reading, Files) {
    let mut opened = Opened::new(sources);
    let documents = opened.documents(name, text);
    let Opened { files, out, .. } = opened;
    if out.has_errors() {
        return (out.finish(None), files);
    }
    let mut reader = Reader::new(out, decimals);
    let mechanism = robot(&documents, &mut reader);
    reader.say_angles();
    (reader.out.finish(mechanism), files)
}

fn robot(documents: &[Document], reader: &mut Reader) -> Option<Mechanism> {
    let mut models = vec![];
    for document in documents {
        let root = document.tree.root();
        if root.name() != Some("mujoco") {
            let message = format!("the root element is <{}>, not <mujoco>", shown(root.full_name()));
            let finding = reader.out.error(root.span(), message);
            match root.full_name() {
                "mujocoinclude" => finding.hint("this is a part of a model: read the file that includes it"),
                "robot" => finding.hint("this is a URDF"),
                "sdf" => finding.hint("this is SDF, which is not read"),
                _ => {}
            }
            return None;
        }
        root.only(&["model"], &mut reader.out);
        let compiler = compiler(root, reader);
        let classes = Classes::of(root, &mut reader.out);
        beside(root, &mut reader.out);
        let (from_geoms, groups) = inertias(root, reader);
        let folder = folder_of_meshes(root);
        let bounds = Bounds::of(root, reader);
        let total = total_mass(root, reader);
        let parts = &document.parts;
        models.push(Model { root, compiler, classes, from_geoms, groups, bounds, total, folder, parts });
    }
    let root = models.first()?.root;
    let mut mjcf = Mjcf {
        reader,
        quaternions: Quaternions::new(),
        models: &models,
        links: Links::default(),
        named: vec![],
        drafts: vec![],
        joints: HashMap::new(),
        references: HashMap::new(),
        slots: vec![],
        parts: vec![(0, String::new(), String::new())],
        open: vec![],
        work: 0,
        repeated: 0,
        assets: Assets::default(),
        from_geoms: HashMap::new(),
        weights: HashMap::new(),
        model_of: HashMap::new(),
        renamed: vec![],
        holds: vec![],
        driven: vec![],
        mocap: vec![],
    };
    mjcf.assets();
    mjcf.world(root);
    let is_known = mjcf.weigh_bodies();
    let total = mjcf.models[0].total.clone();
    mjcf.set_total(total.as_ref().map(|t| &t.0), is_known, total.as_ref().map_or(0..0, |t| t.1.clone()));
    mjcf.couplings();
    mjcf.name_fixed();
    mjcf.say_renamed();
    let gravity = gravity(root, mjcf.reader);
    let keyed = mjcf.keyframes(root);
    let Mjcf { reader, quaternions, links, drafts, holds, driven, .. } = mjcf;
    for (span, count, said) in quaternions.into_values() {
        let places = if count == 1 { String::new() } else { format!(", {count} places") };
        reader.out.note(span, format!("{said}{places}"));
    }
    if !reader.has_few_joints(&drafts) {
        return None;
    }
    let name = root.attribute("model").map_or_else(|| "robot".to_string(), |n| plain(n.text));
    let mut mechanism = reader.tree(name, links, drafts)?;
    let variables = mechanism.variables();
    for (name, values) in keyed {
        let values: HashMap<String, Expr> = values.into_iter().collect();
        let value = |&j: &usize| values.get(&mechanism.joints[j].name).copied();
        let pose = variables.iter().map(|j| value(j).unwrap_or(Expr::int(0))).collect();
        mechanism.poses.push((name, pose));
    }
    mechanism.gravity = gravity;
    mechanism.holds = holds;
    let is_driven = |j: &usize| driven.contains(&mechanism.joints[*j].name);
    mechanism.driven = (0..mechanism.joints.len()).filter(is_driven).collect();
    Some(mechanism)
}

impl<'a> Mjcf<'a, '_> {
    /// Reads places and turns as a model has them.
    fn placing(&mut self, model: usize) -> Placing<'_> {
        let compiler = self.models[model].compiler;
        Placing { reader: self.reader, compiler, quaternions: &mut self.quaternions }
    }

    /// What hangs on the world, and on that.
    fn world(&mut self, root: Element<'a>) {
        self.links.add("world".into(), None, root.span());
        self.named.push(Named::ByFile);
        let worlds: Vec<Element<'a>> = root.all("worldbody").collect();
        if worlds.is_empty() {
            self.reader.out.error(root.span(), "an empty model: there is no <worldbody>");
        }
        for world in &worlds {
            world.only(&[], &mut self.reader.out);
        }
        self.push(worlds.iter().flat_map(Element::children), &Context::world());
        self.walk();
    }
}

/// What the `<compiler>` elements of a model say of angles and limits.
fn compiler(root: Element, reader: &mut Reader) -> Compiler {
    let mut compiler = Compiler::default();
    for element in root.all("compiler") {
        element.only(&COMPILER, &mut reader.out);
        if let Some(angle) = element.attribute("angle") {
            match angle.text {
                "degree" => compiler.degrees = true,
                "radian" => compiler.degrees = false,
                _ => {
                    let message =
                        format!("angles are in `degree` or `radian`, not in `{}`", shown(angle.text));
                    reader.out.error(angle.span, message);
                }
            }
        }
        if let Some(sequence) = element.attribute("eulerseq") {
            let axis = |c: char| {
                let axis = Axis::ALL["xyz".find(c.to_ascii_lowercase())?];
                Some((axis, c.is_ascii_uppercase()))
            };
            let axes: Option<Vec<_>> = sequence.text.chars().map(axis).collect();
            match axes.as_deref() {
                Some(&[a, b, c]) => compiler.sequence = [a, b, c],
                _ => {
                    let message = format!("`{}` is no sequence of Euler angles", shown(sequence.text));
                    let finding = reader.out.error(sequence.span, message);
                    finding.hint("three of x, y, z, or X, Y, Z for axes that stay");
                }
            }
        }
        if let Some(limits) = element.attribute("autolimits") {
            compiler.autolimits = truth(&limits, reader).unwrap_or(true);
        }
        if let Some(global) = element.attribute("coordinate").filter(|c| c.text != "local") {
            reader
                .out
                .error(global.span, "global coordinates are not read")
                .hint("MuJoCo up to 2.3.3 reads such a model, and saves it with local ones");
        }
    }
    compiler
}

/// What the `<compiler>` elements of a model say of masses.
fn inertias(root: Element, reader: &mut Reader) -> (FromGeoms, RangeInclusive<i64>) {
    let (mut from, mut groups) = (FromGeoms::Missing, 0..=5);
    for element in root.all("compiler") {
        if let Some(text) = element.attribute("inertiafromgeom") {
            match text.text {
                "true" => from = FromGeoms::Always,
                "false" => from = FromGeoms::Never,
                "auto" => from = FromGeoms::Missing,
                other => {
                    let message = format!("`{}` is none of `true`, `false` and `auto`", shown(other));
                    reader.out.error(text.span, message);
                }
            }
        }
        if let Some(text) = element.attribute("inertiagrouprange") {
            let ends: Option<Vec<i64>> = text.words().iter().map(|w| w.text.parse().ok()).collect();
            match ends.as_deref() {
                Some(&[low, high]) => groups = low..=high,
                _ => {
                    reader.out.error(text.span, "`inertiagrouprange` is two whole numbers");
                }
            }
        }
    }
    (from, groups)
}

/// The mass of all of a model, if its `<compiler>` says one.
fn total_mass(root: Element, reader: &mut Reader) -> Option<(Rational, Range<usize>)> {
    let said: Vec<_> = root.all("compiler").filter_map(|c| c.attribute("settotalmass")).collect();
    let text = said.into_iter().next_back()?;
    let total = reader.numbers(&text, "settotalmass", 1)?.remove(0).0;
    (!total.is_zero() && !total.is_negative()).then_some((total, text.span))
}

/// The folder in which a model has its meshes.
fn folder_of_meshes(root: Element) -> String {
    let named = |name: &str| root.all("compiler").filter_map(|c| c.attribute(name)).last();
    named("meshdir").or(named("assetdir")).map_or(String::new(), |t| plain(t.text))
}

/// The acceleration of gravity in the world, if it is given: the last one that is.
fn gravity(root: Element, reader: &mut Reader) -> Option<[Expr; 3]> {
    let mut found = None;
    for option in root.all("option") {
        if let Some(text) = option.attribute("gravity") {
            let numbers = reader.numbers(&text, "gravity", 3);
            found = numbers
                .and_then(|n| n.into_iter().map(|x| Expr::from(x.0)).collect::<Vec<_>>().try_into().ok());
        }
        let is_off = |f: Element| f.attribute("gravity").is_some_and(|g| g.text == "disable");
        if option.all("flag").any(is_off) {
            return Some([0; 3].map(Expr::int));
        }
    }
    found
}

/// `true` or `false`; anything else is reported.
fn truth(text: &super::xml::Text, reader: &mut Reader) -> Option<bool> {
    match text.text {
        "true" => Some(true),
        "false" => Some(false),
        other => {
            let message = format!("`{}` is neither `true` nor `false`", shown(other));
            reader.out.error(text.span.clone(), message);
            None
        }
    }
}

/// Says what in `<mujoco>` is left: once, but for what is unknown.
fn beside(root: Element, out: &mut Diagnostics) {
    let mut left: Vec<&str> = vec![];
    let mut first = None;
    let closes = |e: Element| e.children().any(|c| matches!(c.name(), Some("connect" | "weld")));
    let has_loops = root.all("equality").any(closes);
    for child in root.children() {
        match child.name() {
            Some(name) if READ.contains(&name) => {}
            // Of closed loops they say which joints are driven.
            Some("actuator") if has_loops => {}
            Some("option") if child.attribute("gravity").is_some() => {}
            Some("option") if child.all("flag").any(|f| f.attribute("gravity").is_some()) => {}
            Some(name) if BESIDE.contains(&name) => {
                if !left.contains(&name) {
                    left.push(name);
                }
                first.get_or_insert(child.span());
            }
            _ if out.is_full() => {}
            _ => {
                let name = child.full_name();
                let finding =
                    out.warning(child.span(), format!("<{}> is unknown: it is skipped", shown(name)));
                if let Some(near) = nearest(name, READ.into_iter().chain(BESIDE)) {
                    finding.hint(format!("did you mean <{near}>?"));
                }
            }
        }
    }
    if let Some(first) = first {
        let names: Vec<String> = left.iter().map(|n| format!("<{n}>")).collect();
        let verb = if names.len() == 1 {
            "says nothing of kinematics: it is"
        } else {
            "say nothing of kinematics: they are"
        };
        out.note(first, format!("{} {verb} skipped", names.join(", ")));
    }
}
