//! A tree of bodies and joints as rows in Khalil's notation (Khalil and Kleinfinger 1986).
//!
//! z of a row's frame is its joint's axis, x the common normal to the axis of its main child, the one with the most joints behind it;
//! so every way along main children reads as an ordinary table, and the other children begin with γ and b.

use super::{BASE, NamedFrame, RowTree};
use crate::description::lines::{NotNamed, Turns, frame_on, settled};
use crate::description::tree::moved;
use crate::description::{JointDrive, JointKind, Mass, Mechanism, Row, Screw, Variable};
use crate::geometry::Transform;
use denavit_symbolic::{Angle, Expr, Rational, Symbol};

/// A joint that moves, at rest.
struct Placed {
    joint: usize,
    /// The moving joint that it stands on.
    after: Option<usize>,
    /// A frame on its axis.
    frame: Transform<Expr>,
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
        let numbers: Vec<usize> = m.variables();
        let symbol = |joint: usize| {
            let at = numbers.iter().position(|&v| v == joint);
            Symbol::new(&format!("q{}", at.unwrap_or_default() + 1))
        };
        let mut tree = RowTree {
            name: m.name.clone(),
            source: None,
            parameters: vec![],
            rows: vec![],
            after: vec![],
            base: Transform::identity(),
            frames: vec![],
            tip: None,
            gravity: m.gravity,
        };
        let mut row_of: Vec<usize> = vec![];
        for (placed, frame) in placed.iter().zip(&frames) {
            let before = placed.after.map_or(Transform::identity(), |a| frames[a]);
            let turns = Turns::of(&settled(&(before.inverse() * *frame)), &[])?;
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
            (last.limits, last.velocity) = (joint.limits.filter(|_| own), joint.velocity.filter(|_| own));
            if own {
                let followers = m.joints.iter().filter_map(|j| {
                    let follows = j.follows.as_ref().filter(|f| f.joint == placed.joint)?;
                    Some((&j.drive, &follows.factor))
                });
                let drive =
                    JointDrive::together([(&joint.drive, &Rational::ONE)].into_iter().chain(followers));
                (last.rotor, last.viscous, last.coulomb) = (drive.rotor, drive.viscous, drive.coulomb);
            }
            tree.rows.push(last);
            tree.after.push(on);
            row_of.push(tree.rows.len() - 1);
        }
        for (k, frame) in frames.iter().enumerate() {
            let bodies = (0..m.bodies.len()).filter(|&b| on[b] == Some(k));
            let masses = bodies.filter_map(|b| {
                let mass = m.bodies[b].mass.as_ref()?;
                Some(mass.body().seen_from(&settled(&(frame.inverse() * poses[b]))))
            });
            if let Some(mass) = masses.reduce(|a, b| a + b).as_ref().and_then(Mass::of_body) {
                let row = &mut tree.rows[row_of[k]];
                (row.mass, row.com, row.inertia) = (Some(mass.mass), Some(mass.com), Some(mass.inertia));
            }
        }
        for body in m.leaves() {
            let (row, before) = match on[body] {
                Some(k) => (Some(row_of[k]), frames[k]),
                None => (None, Transform::identity()),
            };
            let name = m.bodies[body].name.clone();
            let is_taken = name == BASE || (0..tree.rows.len()).any(|j| tree.frame_name(j) == name);
            let name = if is_taken { format!("{name} body") } else { name };
            tree.frames.push(NamedFrame { name, on: row, pose: settled(&(before.inverse() * poses[body])) });
        }
        Ok(tree)
    }
}

/// The moving joints at rest; for each body the one that it stands on, and its pose.
#[expect(clippy::type_complexity, reason = "three lists that belong together once")]
fn at_rest(m: &Mechanism) -> Result<(Vec<Placed>, Vec<Option<usize>>, Vec<Transform<Expr>>), NotNamed> {
    let mut placed: Vec<Placed> = vec![];
    let mut on: Vec<Option<usize>> = vec![None; m.bodies.len()];
    let mut poses = vec![Transform::<Expr>::identity(); m.bodies.len()];
    for (j, joint) in m.joints.iter().enumerate() {
        let before = settled(&(poses[joint.parent] * joint.origin));
        let follows = joint.follows.as_ref();
        let rest = follows.map_or(Expr::int(0), |f| f.offset);
        let motion = joint.kind.map_or(Transform::identity(), |kind| moved(joint, kind, rest));
        poses[joint.child] = settled(&(before * motion));
        on[joint.child] = on[joint.parent];
        if joint.kind.is_some() && follows.is_none_or(|f| !f.factor.is_zero()) {
            let frame = frame_on(&before, joint.axis)
                .ok_or(NotNamed::NotPlaced(crate::description::NotPlaced::NoDirection(j)))?;
            placed.push(Placed { joint: j, after: on[joint.parent], frame });
            on[joint.child] = Some(placed.len() - 1);
        }
    }
    Ok((placed, on, poses))
}

/// The frames, turned and moved along their axes so that x is the normal to the main child.
fn along_normals(placed: &[Placed]) -> Result<Vec<Transform<Expr>>, NotNamed> {
    let mut behind = vec![1_usize; placed.len()];
    for k in (0..placed.len()).rev() {
        if let Some(a) = placed[k].after {
            behind[a] = behind[a].max(behind[k] + 1);
        }
    }
    let main = |k: usize| {
        let children = (0..placed.len()).filter(|&c| placed[c].after == Some(k));
        children.max_by_key(|&c| (behind[c], std::cmp::Reverse(c)))
    };
    let frame = |k: usize| {
        let own = placed[k].frame;
        let Some(child) = main(k) else { return Ok(own) };
        let turns = Turns::of(&settled(&(own.inverse() * placed[child].frame)), &[])?;
        Ok(if turns.x.is_empty() { own } else { settled(&(own * turns.z[0].transform())) })
    };
    (0..placed.len()).map(frame).collect()
}

/// A constant transform as rows.
pub(super) fn rows_of(turns: &Turns) -> Vec<Row> {
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
