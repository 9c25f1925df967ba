//! A tree of bodies with closed loops as a linkage.
//!
//! Each loop is cut at the place where it is held: the joint that is cut stands on the one body, and the place on the other is a frame
//! there. Where all that moves between both moves in one plane, a point that is held turns in that plane alone; elsewhere it turns in any
//! way, which is three joints.

use super::{Closure, Linkage, Side};
use crate::description::branches::{RowTree, rows_of};
use crate::description::lines::{NotNamed, Turns, settled};
use crate::description::tree::{Hold, Joint, JointDrive, Keeps};
use crate::description::{Body, JointKind, Mechanism, Row, Variable};
use crate::geometry::{Transform, Vector};
use denavit_symbolic::{Expr, Symbol, readable};
use std::collections::HashMap;

/// How a loop is cut: the name of the joint, if one is, and those of the frames on both sides.
struct Cut {
    joint: Option<String>,
    frames: [String; 2],
}

impl Linkage {
    /// A tree of bodies with its closed loops. Its joints are [driven](Mechanism::driven) or passive.
    ///
    /// # Errors
    /// If an axis has no direction.
    pub fn of_mechanism(m: &Mechanism) -> Result<Linkage, NotNamed> {
        let drives = m.drives();
        let driven: Vec<String> = drives.iter().map(|&j| m.joints[j].name.clone()).collect();
        let mut whole = Mechanism { holds: vec![], ..m.clone() };
        let cuts: Vec<Cut> = {
            let poses = m.placed(|_| None);
            let mut names = Names::of(m);
            keep_leaves(&mut whole, m, &mut names);
            (0..m.holds.len()).map(|k| cut(&mut whole, m, k, &poses, &mut names)).collect()
        };
        let mut tree = RowTree::of_mechanism(&whole)?;
        let symbols = renamed(&mut tree, &driven, &cuts);
        let poses = std::mem::take(&mut tree.poses);
        let poses = poses.into_iter().map(|(name, values)| {
            let own = values.into_iter().zip(&symbols).filter(|(_, s)| !super::is_passive(**s));
            (name, own.map(|x| x.0).collect())
        });
        let poses = poses.collect();
        // What is added to cut a loop is no tip.
        let tip = m.tip(m.root).ok().map(|tip| m.bodies[tip].name.clone());
        tree.tip = tip.filter(|name| tree.frames.iter().any(|f| f.name == *name));
        let mut closures = vec![];
        for (cut, hold) in cuts.iter().zip(&m.holds) {
            closures.push(closure(&mut tree, cut, hold)?);
        }
        Ok(Linkage { tree, closures, modes: vec![], poses })
    }
}

/// Names that nothing has yet.
struct Names(Vec<String>);

impl Names {
    fn of(m: &Mechanism) -> Self {
        let bodies = m.bodies.iter().map(|b| b.name.clone());
        Names(bodies.chain(m.joints.iter().map(|j| j.name.clone())).collect())
    }

    fn free(&mut self, like: &str) -> String {
        let mut name = like.to_string();
        while self.0.contains(&name) {
            name.push('_');
        }
        self.0.push(name.clone());
        name
    }
}

/// What hangs on a body by a joint, or is fixed to it.
fn hang(m: &mut Mechanism, names: &mut Names, name: &str, on: usize, joint: Joint) -> usize {
    let name = names.free(name);
    m.bodies.push(Body { name, mass: None, is_unweighed: false, looks: vec![] });
    let child = m.bodies.len() - 1;
    m.joints.push(Joint { parent: on, child, ..joint });
    child
}

fn joint(name: String, kind: Option<JointKind>, origin: Transform<Expr>, axis: Vector<Expr>) -> Joint {
    Joint {
        name,
        kind,
        parent: 0,
        child: 0,
        origin,
        axis,
        limits: None,
        velocity: None,
        effort: None,
        drive: JointDrive::default(),
        follows: None,
    }
}

fn z() -> Vector<Expr> {
    Vector([0, 0, 1].map(Expr::int))
}

/// Bodies on which nothing but a loop stands keep their names as frames.
fn keep_leaves(whole: &mut Mechanism, m: &Mechanism, names: &mut Names) {
    let leaves = m.leaves();
    let held = m.holds.iter().flat_map(|h| h.bodies);
    let mut held: Vec<usize> = held.filter(|b| leaves.contains(b)).collect();
    held.sort_unstable();
    held.dedup();
    for body in held {
        let name = std::mem::take(&mut whole.bodies[body].name);
        whole.bodies[body].name = names.free(&format!("{name} itself"));
        let fixed = names.free(&format!("{name} frame"));
        whole.bodies.push(Body { name, mass: None, is_unweighed: false, looks: vec![] });
        let child = whole.bodies.len() - 1;
        whole.joints.push(Joint { parent: body, child, ..joint(fixed, None, Transform::identity(), z()) });
    }
}

/// Cuts a loop: bodies and joints for what is cut are added.
fn cut(whole: &mut Mechanism, m: &Mechanism, k: usize, poses: &[Transform<Expr>], names: &mut Names) -> Cut {
    let hold = &m.holds[k];
    let called = hold.name.clone().unwrap_or_else(|| format!("loop {}", k + 1));
    let [a, b] = hold.bodies;
    let [left, mut right] = hold.places;
    let mut on = a;
    let mut origin = left;
    let mut cut_joint = None;
    // The frames of both sides as they stand with all joints at 0, so that the joint that is cut is at 0 there.
    let aligned = || (poses[b].rotation.inverse() * poses[a].rotation * left.rotation).map(readable::settled);
    let turns = |axis: Vector<Expr>, origin: Transform<Expr>, names: &mut Names| {
        joint(names.free(&called), Some(JointKind::Revolute), origin, axis)
    };
    match hold.keeps {
        Keeps::Frame => {}
        Keeps::Axis => cut_joint = Some(turns(z(), origin, names)),
        Keeps::Point => {
            right.rotation = aligned();
            match m.plane_between(hold.bodies, poses) {
                Some(normal) => {
                    let own = (poses[a].rotation * left.rotation).inverse() * normal;
                    cut_joint = Some(turns(own.map(readable::settled), origin, names));
                }
                None => {
                    for direction in [[1, 0, 0], [0, 1, 0]] {
                        let own = turns(Vector(direction.map(Expr::int)), origin, names);
                        on = hang(whole, names, &format!("{called} between"), on, own);
                        origin = Transform::identity();
                    }
                    cut_joint = Some(turns(z(), origin, names));
                }
            }
        }
    }
    let joint_name = cut_joint.as_ref().map(|j| j.name.clone());
    let own = match cut_joint {
        Some(joint) => joint,
        None => joint(names.free(&format!("{called} left")), None, origin, z()),
    };
    let first = hang(whole, names, &format!("{called} left side"), on, own);
    let fixed = joint(names.free(&format!("{called} right")), None, right, z());
    let second = hang(whole, names, &format!("{called} right side"), b, fixed);
    let frames = [first, second].map(|body| whole.bodies[body].name.clone());
    Cut { joint: joint_name, frames }
}

/// Gives driven variables the names q1, q2, … and passive ones p1, p2, …, those of joints that are cut last; what each variable of the
/// tree is called then.
fn renamed(tree: &mut RowTree, driven: &[String], cuts: &[Cut]) -> Vec<Symbol> {
    let is_cut = |row: &Row| cuts.iter().any(|c| c.joint.is_some() && c.joint == row.name);
    let is_driven = |row: &Row| row.name.as_ref().is_some_and(|n| driven.contains(n));
    let (mut q, mut p) = (0, 0);
    let mut names: HashMap<Symbol, Symbol> = HashMap::new();
    let mut order: Vec<Symbol> = vec![];
    for cut in [false, true] {
        for row in tree.rows.iter().filter(|r| is_cut(r) == cut) {
            let Some(variable) = row.variable else { continue };
            let (letter, number) = if is_driven(row) { ("q", &mut q) } else { ("p", &mut p) };
            *number += 1;
            names.insert(variable.symbol, Symbol::new(&format!("{letter}{number}")));
        }
    }
    for row in &mut tree.rows {
        let named = |e: Expr| e.substitute(|s| names.get(&s).map(|s| Expr::from(*s)));
        (row.theta, row.d) = (named(row.theta), named(row.d));
        if let Some(v) = &mut row.variable {
            let symbol = names.get(&v.symbol).copied().unwrap_or(v.symbol);
            *v = Variable { symbol, kind: v.kind };
            order.push(symbol);
        }
    }
    order
}

/// The closure of a loop that is cut; its frames and its row leave the tree.
fn closure(tree: &mut RowTree, cut: &Cut, hold: &Hold) -> Result<Closure, NotNamed> {
    let mut frame = |name: &String| {
        let at = tree.frames.iter().position(|f| f.name == *name);
        at.map(|at| tree.frames.remove(at)).map_or((None, Transform::identity()), |f| (f.on, f.pose))
    };
    let [(on, left), (beside, right)] = [frame(&cut.frames[0]), frame(&cut.frames[1])];
    let cut_row = on.filter(|_| cut.joint.is_some());
    let (left, right) = match cut_row {
        Some(row) => {
            let own = tree.rows.remove(row);
            let after = tree.after.remove(row);
            let moved = |k: Option<usize>| k.map(|k| k - usize::from(k > row));
            tree.after.iter_mut().for_each(|k| *k = moved(*k));
            tree.frames.iter_mut().for_each(|f| f.on = moved(f.on));
            let right = settled(&(right * left.inverse()));
            (Side { after, row: own }, side(tree, moved(beside), &right)?)
        }
        None => {
            let left = side(tree, on, &left)?;
            (left, side(tree, beside, &right)?)
        }
    };
    Ok(Closure { name: hold.name.clone(), left, right, span: hold.span.clone() })
}

/// A frame as a row on the tree, with rows that do not move where one is not enough.
fn side(tree: &mut RowTree, on: Option<usize>, pose: &Transform<Expr>) -> Result<Side, NotNamed> {
    let mut rows = rows_of(&Turns::of(&settled(pose), &[])?);
    let row = rows.pop().unwrap_or_else(Row::still);
    let mut after = on;
    for fixed in rows {
        tree.rows.push(fixed);
        tree.after.push(after);
        after = Some(tree.rows.len() - 1);
    }
    Ok(Side { after, row })
}
