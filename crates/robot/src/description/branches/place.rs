//! A tree of bodies and joints as rows in Khalil's notation (Khalil and Kleinfinger 1986).
//!
//! z of a row's frame is its joint's axis, x the common normal to the axis of its main child, the one with the most joints behind it;
//! so every way along main children reads as an ordinary table, and the other children begin with γ and b.

use super::{BASE, NamedFrame, RowTree};
use crate::description::lines::{NotNamed, NotPlaced, Pose, Turns, frame_on};
use crate::description::tree::rest;
use crate::description::{JointDrive, JointKind, Mass, Mechanism, Row, Screw, Variable};
use crate::geometry::Transform;
use denavit_symbolic::real::Values;
use denavit_symbolic::{Angle, Expr, Rational, Symbol};
use std::collections::{BTreeSet, HashMap, HashSet};

/// A joint that moves, at rest.
struct Placed {
    joint: usize,
    /// The moving joint that it stands on.
    after: Option<usize>,
    /// A frame on its axis.
    frame: Pose,
}

impl RowTree {
    /// The rows of a tree of bodies and joints; the bodies at its ends are frames with names.
    ///
    /// The mass of a row is that of all bodies that stand on its joint; what is fixed to the base has none.
    ///
    /// # Errors
    /// If an axis has no direction.
    pub fn of_mechanism(m: &Mechanism) -> Result<RowTree, NotNamed> {
        let (placed, on, poses) = at_rest(m)?;
        let frames = along_normals(&placed)?;
        // Variables stand in the order of the rows.
        let own = placed.iter().map(|p| p.joint).filter(|&j| m.joints[j].follows.is_none());
        let numbers: HashMap<usize, usize> = own.zip(1..).collect();
        let symbol = |joint: usize| Symbol::new(&format!("q{}", numbers.get(&joint).copied().unwrap_or(1)));
        let pose = |(name, values): &(String, Vec<Expr>)| {
            let mut ordered = vec![Expr::int(0); values.len()];
            for (joint, value) in m.variables().into_iter().zip(values) {
                if let Some(k) = numbers.get(&joint) {
                    ordered[k - 1] = *value;
                }
            }
            (name.clone(), ordered)
        };
        let mut followers: HashMap<usize, Vec<(&JointDrive, &Rational)>> = HashMap::new();
        for joint in &m.joints {
            if let Some(f) = &joint.follows {
                followers.entry(f.joint).or_default().push((&joint.drive, &f.factor));
            }
        }
        let mut tree = RowTree {
            name: m.name.clone(),
            source: None,
            parameters: vec![],
            rows: vec![],
            after: vec![],
            base: Transform::identity(),
            frames: vec![],
            tip: None,
            poses: m.poses.iter().map(pose).collect(),
            gravity: m.gravity,
        };
        let limits: HashMap<usize, [Expr; 2]> = m
            .variables()
            .into_iter()
            .zip(m.limits_of_variables())
            .filter_map(|(j, limits)| Some((j, limits?)))
            .collect();
        let mut row_of: Vec<usize> = vec![];
        for (placed, frame) in placed.iter().zip(&frames) {
            let seen = placed.after.map_or_else(|| frame.clone(), |a| frames[a].seen(frame));
            let turns = Turns::of(&seen.settled(), &[])?;
            let joint = &m.joints[placed.joint];
            let mut on = placed.after.map(|a| row_of[a]);
            let mut rows = rows_of(&turns);
            let mut last = rows.pop().unwrap_or_else(Row::still);
            for fixed in rows {
                tree.rows.push(fixed);
                tree.after.push(on);
                on = Some(tree.rows.len() - 1);
            }
            let value = match &joint.follows {
                Some(f) => Expr::from(f.factor.clone()) * Expr::from(symbol(f.joint)),
                None => symbol(placed.joint).into(),
            };
            let kind = joint.kind.unwrap_or(JointKind::Revolute);
            match kind {
                JointKind::Revolute => last.theta = Angle::of(value + last.theta).to_expr(),
                JointKind::Prismatic => last.d = Angle::of(value + last.d).to_expr(),
            }
            let own = joint.follows.is_none();
            last.variable = own.then(|| Variable { symbol: symbol(placed.joint), kind });
            last.name = Some(joint.name.clone());
            // Variables alone are in the map.
            (last.limits, last.velocity) =
                (limits.get(&placed.joint).copied(), joint.velocity.filter(|_| own));
            if own {
                let followers = followers.get(&placed.joint).into_iter().flatten().copied();
                let drive =
                    JointDrive::together([(&joint.drive, &Rational::ONE)].into_iter().chain(followers));
                (last.rotor, last.viscous, last.coulomb) = (drive.rotor, drive.viscous, drive.coulomb);
            }
            tree.rows.push(last);
            tree.after.push(on);
            row_of.push(tree.rows.len() - 1);
        }
        let mut bodies_on: Vec<Vec<usize>> = vec![vec![]; frames.len()];
        for (body, k) in on.iter().enumerate().filter_map(|(b, k)| Some((b, (*k)?))) {
            bodies_on[k].push(body);
        }
        for (k, frame) in frames.iter().enumerate() {
            let masses = bodies_on[k].iter().filter_map(|&b| {
                let mass = m.bodies[b].mass.as_ref()?;
                Some(mass.body().seen_from(&frame.seen(&poses[b]).settled()))
            });
            if let Some(mass) = masses.reduce(|a, b| a + b).as_ref().and_then(Mass::of_body) {
                let row = &mut tree.rows[row_of[k]];
                (row.mass, row.com, row.inertia) = (Some(mass.mass), Some(mass.com), Some(mass.inertia));
            }
        }
        let mut taken: HashSet<String> = (0..tree.rows.len()).map(|j| tree.frame_name(j)).collect();
        taken.insert(BASE.into());
        for body in m.leaves() {
            let pose = &poses[body];
            let (row, pose) = match on[body] {
                Some(k) => (Some(row_of[k]), frames[k].seen(pose)),
                None => (None, pose.clone()),
            };
            let mut name = m.bodies[body].name.clone();
            while !taken.insert(name.clone()) {
                name += " body";
            }
            tree.frames.push(NamedFrame { name, on: row, pose: pose.settled() });
        }
        Ok(tree)
    }
}

/// The joints, each behind that to its parent and, where that can be, behind the one that it follows; else in their order.
fn leaders_first(m: &Mechanism) -> Vec<usize> {
    let mut behind: Vec<Vec<usize>> = vec![vec![]; m.bodies.len()];
    let mut followers: HashMap<usize, Vec<usize>> = HashMap::new();
    for (j, joint) in m.joints.iter().enumerate() {
        behind[joint.parent].push(j);
        if let Some(f) = &joint.follows {
            followers.entry(f.joint).or_default().push(j);
        }
    }
    let mut is_there = vec![false; m.joints.len()];
    // Joints whose parents are placed: those whose leaders are, too, and those that wait.
    let (mut ready, mut waiting) = (BTreeSet::new(), BTreeSet::new());
    let mut all = Vec::with_capacity(m.joints.len());
    let mut body = m.root;
    loop {
        for &j in &behind[body] {
            let has_leader = m.joints[j].follows.as_ref().is_none_or(|f| is_there[f.joint]);
            if has_leader {
                ready.insert(j)
            } else {
                waiting.insert(j)
            };
        }
        let Some(next) = ready.pop_first().or_else(|| waiting.pop_first()) else { return all };
        is_there[next] = true;
        all.push(next);
        for &j in followers.get(&next).into_iter().flatten() {
            if waiting.remove(&j) {
                ready.insert(j);
            }
        }
        body = m.joints[next].child;
    }
}

/// The moving joints at rest; for each body the one that it stands on, and its pose.
#[expect(clippy::type_complexity, reason = "three lists that belong together once")]
fn at_rest(m: &Mechanism) -> Result<(Vec<Placed>, Vec<Option<usize>>, Vec<Pose>), NotNamed> {
    let mut placed: Vec<Placed> = vec![];
    let mut on: Vec<Option<usize>> = vec![None; m.bodies.len()];
    let mut poses = vec![Pose::identity(); m.bodies.len()];
    let mut values = Values::default();
    for j in leaders_first(m) {
        let joint = &m.joints[j];
        let symbols = || NotNamed::NotPlaced(NotPlaced::Symbols);
        let origin = Pose::of(&joint.origin, &mut values).ok_or_else(symbols)?;
        let before = poses[joint.parent].times(&origin);
        on[joint.child] = on[joint.parent];
        if joint.kind.is_some() && joint.follows.as_ref().is_none_or(|f| !f.factor.is_zero()) {
            let frame = frame_on(&before, joint.axis, &mut values)
                .ok_or(NotNamed::NotPlaced(NotPlaced::NoDirection(j)))?;
            placed.push(Placed { joint: j, after: on[joint.parent], frame });
            on[joint.child] = Some(placed.len() - 1);
        }
        poses[joint.child] = before.times(&rest(joint, &mut values).ok_or_else(symbols)?);
    }
    Ok((placed, on, poses))
}

/// The frames, turned and moved along their axes so that x is the normal to the main child.
fn along_normals(placed: &[Placed]) -> Result<Vec<Pose>, NotNamed> {
    let mut behind = vec![1_usize; placed.len()];
    for k in (0..placed.len()).rev() {
        if let Some(a) = placed[k].after {
            behind[a] = behind[a].max(behind[k] + 1);
        }
    }
    // The child with the most joints behind it, of several the first.
    let mut main: Vec<Option<usize>> = vec![None; placed.len()];
    for (c, child) in placed.iter().enumerate() {
        let Some(a) = child.after else { continue };
        if main[a].is_none_or(|m| behind[c] > behind[m]) {
            main[a] = Some(c);
        }
    }
    let frame = |(k, own): (usize, &Placed)| {
        let Some(child) = main[k] else { return Ok(own.frame.clone()) };
        let turns = Turns::of(&own.frame.seen(&placed[child].frame).settled(), &[])?;
        if turns.x.is_empty() {
            return Ok(own.frame.clone());
        }
        let along = Pose::of(&turns.z[0].transform(), &mut Values::default());
        Ok(along.map_or_else(|| own.frame.clone(), |z| own.frame.times(&z)))
    };
    placed.iter().enumerate().map(frame).collect()
}

/// A constant transform as rows.
pub(in crate::description) fn rows_of(turns: &Turns) -> Vec<Row> {
    let last = turns.x.len();
    if last == 0 {
        return vec![Row { theta: turns.z[0].angle, d: turns.z[0].length, ..Row::still() }];
    }
    let row = |k: usize| {
        let (x, z): (Screw, Screw) = (turns.x[k], turns.z[k + 1]);
        Row { theta: z.angle, d: z.length, alpha: x.angle, a: x.length, ..Row::still() }
    };
    let mut rows: Vec<Row> = (0..last).map(row).collect();
    (rows[0].gamma, rows[0].b) = (turns.z[0].angle, turns.z[0].length);
    rows
}
