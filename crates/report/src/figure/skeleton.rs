//! What is to be drawn of an arm, as points and directions in the base, metres: axes of joints, the links between them
//! along the common normals, the lengths of the table.

use super::drawing::Label;
use super::naming;
use denavit::Robot;
use denavit::description::{Convention, Description, JointKind, Row};
use denavit::geometry::{Transform, Vector};
use denavit::robot::MissingValue;
use denavit_symbolic::Expr;

/// Shorter than this, of the arm's size, is no length.
const NOTHING: f64 = 1e-6;

/// A robot as far as pictures need it.
#[derive(Clone, Debug)]
pub struct Chain {
    pub robot: Robot<f64>,
    pub convention: Convention,
    pub rows: Vec<Row>,
    /// Of each joint variable.
    pub limits: Vec<Option<[f64; 2]>>,
    /// Of each joint variable.
    pub kinds: Vec<JointKind>,
    /// The poses that the description names.
    pub poses: Vec<Vec<f64>>,
    /// The sum of all lengths and of some way for what slides.
    pub size: f64,
    /// How far something slides in a picture.
    pub stroke: f64,
    pub name: String,
    /// The labels of each row's lengths: b, x, z.
    lengths: Vec<[Option<Label>; 3]>,
    /// The joint that each row introduces, and its variable.
    own: Vec<Option<(usize, Label)>>,
}

/// The axis of something that moves.
#[derive(Clone, PartialEq, Debug)]
pub struct Joint {
    /// The joint (from 0), or none where the row only follows others.
    pub number: Option<usize>,
    /// What it moves.
    pub kind: JointKind,
    /// Where the link before reaches the axis.
    pub foot: Vector<f64>,
    /// Its direction.
    pub axis: Vector<f64>,
    /// How far along it the link behind leaves.
    pub travel: f64,
    /// The frame whose z axis this is.
    pub frame: usize,
    /// Its variable.
    pub label: Label,
}

impl Joint {
    /// The point of the axis at a distance from the foot.
    pub fn point(&self, s: f64) -> Vector<f64> {
        self.foot + self.axis.scale(s)
    }

    /// Where the link behind leaves.
    pub fn end(&self) -> Vector<f64> {
        self.point(self.travel)
    }
}

/// A length of the table in space.
#[derive(Clone, PartialEq, Debug)]
pub struct Length {
    /// From where.
    pub from: Vector<f64>,
    /// To where.
    pub to: Vector<f64>,
    /// Its name or its value.
    pub label: Label,
    /// Whether a joint changes it.
    pub slides: bool,
}

/// An arm in a pose.
#[derive(Clone, PartialEq, Debug)]
pub struct Skeleton {
    /// Frames 0 … n in the base.
    pub frames: Vec<Transform<f64>>,
    /// The tool in the base.
    pub tool: Transform<f64>,
    /// Everything that moves.
    pub joints: Vec<Joint>,
    /// The links, one more than the joints, each from the end of one joint's axis to the foot of the next.
    pub links: Vec<Vec<Vector<f64>>>,
    /// The lengths of the table that are not 0.
    pub lengths: Vec<Length>,
}

impl Chain {
    /// Of a description; lengths without values get some.
    pub fn new(description: &Description) -> Result<Self, MissingValue> {
        let filled = description.filled();
        let robot = Robot::numeric(&filled)?;
        let number = |e: &Expr| {
            e.eval(|s| {
                filled.parameters.iter().find(|p| p.symbol == s).and_then(|p| p.value?.eval(|_| None).ok())
            })
        };
        let own: Vec<&Row> = filled.rows.iter().filter(|r| r.variable.is_some()).collect();
        let limits = own.iter().map(|r| {
            let [low, high] = r.limits.as_ref()?;
            let range = [number(low).ok()?, number(high).ok()?];
            (range[0].is_finite() && range[1].is_finite() && range[0] <= range[1]).then_some(range)
        });
        let limits = limits.collect();
        let kinds: Vec<JointKind> = filled.variables().iter().map(|v| v.kind).collect();
        let poses = filled.poses.iter().filter_map(|(_, q)| q.iter().map(|e| number(e).ok()).collect());
        let poses: Vec<Vec<f64>> =
            poses.filter(|q: &Vec<f64>| q.len() == kinds.len() && q.iter().all(|x| x.is_finite())).collect();

        let mut lengths: Vec<f64> = vec![robot.tool.translation.norm()];
        for link in &robot.links {
            lengths.extend([
                link.before.translation.norm(),
                link.after.translation.norm(),
                link.d.offset.abs(),
            ]);
        }
        let total: f64 = lengths.iter().sum();
        let sliding = kinds.iter().filter(|&&k| k == JointKind::Prismatic).count() as f64;
        // What slides goes about as far as the arm is long, but no axis is a multiple of the rest.
        let longest = lengths.iter().copied().fold(0.0, f64::max);
        let stroke = if longest > 0.0 { longest.max(total / 3.0) } else { 0.5 };
        let size = total + 0.8 * stroke * sliding;
        let size = if size.is_finite() && size > NOTHING { size } else { 1.0 };
        let label = |cell: Expr| (!cell.is_zero()).then(|| naming::length(cell));
        let mut numbers = 0..;
        let own = filled.rows.iter().map(|row| {
            let name = naming::symbol(&row.variable?.symbol.name());
            Some((numbers.next()?, name))
        });
        Ok(Chain {
            own: own.collect(),
            lengths: filled.rows.iter().map(|r| [label(r.b), label(r.a), label(r.d)]).collect(),
            robot,
            convention: filled.convention,
            rows: filled.rows,
            limits,
            kinds,
            poses,
            size,
            stroke,
            name: filled.name,
        })
    }

    /// The arm in a pose.
    pub fn skeleton(&self, q: &[f64]) -> Skeleton {
        let mut frame = self.robot.base;
        let mut frames = vec![frame];
        let mut joints = vec![];
        let mut lengths = vec![];
        let mut links = vec![];
        let mut link = vec![frame.translation];
        if self.is_apart(frame.translation, Vector::zero()) {
            link.insert(0, Vector::zero());
        }
        for (i, (row, part)) in self.rows.iter().zip(&self.robot.links).enumerate() {
            let before = frame * part.before;
            let [b_label, x_label, z_label] = &self.lengths[i];
            if !self.convention.begins_with_joint() {
                // Tz(b) stands before Tx.
                let b = part.before.translation.dot(Vector([0.0, 0.0, 1.0]));
                let corner = match row.b.is_zero() || row.alpha.is_zero() && row.a.is_zero() {
                    true => frame.translation,
                    false => frame.translation + frame.rotation.z().scale(b),
                };
                self.measure(&mut lengths, frame.translation, corner, b_label, false);
                self.measure(&mut lengths, corner, before.translation, x_label, false);
                link.extend([corner, before.translation]);
            }
            let behind = frame * part.transform(q);
            let axis = before.rotation.z();
            let mut travel = part.d.offset;
            travel += part.d.terms.iter().map(|&(j, k)| k * q[j]).sum::<f64>();
            let end = before.translation + axis.scale(travel);
            let slides = !part.d.terms.is_empty();
            self.measure(&mut lengths, before.translation, end, z_label, slides);
            if slides || !part.theta.terms.is_empty() {
                let own = self.own[i].clone();
                links.push(std::mem::replace(&mut link, vec![end]));
                joints.push(Joint {
                    number: own.as_ref().map(|o| o.0),
                    kind: if slides { JointKind::Prismatic } else { JointKind::Revolute },
                    foot: before.translation,
                    axis,
                    travel,
                    frame: if self.convention.begins_with_joint() { i } else { i + 1 },
                    label: own.map(|o| o.1).unwrap_or_default(),
                });
            } else {
                link.push(end);
            }
            if self.convention.begins_with_joint() {
                self.measure(&mut lengths, end, behind.translation, x_label, false);
                link.push(behind.translation);
            }
            frame = behind;
            frames.push(frame);
        }
        let tool = frame * self.robot.tool;
        link.push(tool.translation);
        links.push(link);
        for link in &mut links {
            link.dedup_by(|b, a| !self.is_apart(*a, *b));
        }
        Skeleton { frames, tool, joints, links, lengths }
    }

    fn is_apart(&self, a: Vector<f64>, b: Vector<f64>) -> bool {
        (a - b).norm() > NOTHING * self.size
    }

    fn measure(
        &self,
        to: &mut Vec<Length>,
        a: Vector<f64>,
        b: Vector<f64>,
        label: &Option<Label>,
        slides: bool,
    ) {
        if let Some(label) = label.as_ref().filter(|_| self.is_apart(a, b)) {
            to.push(Length { from: a, to: b, label: label.clone(), slides });
        }
    }
}
