//! How the axes lie at a singular configuration.

use crate::description::JointKind;
use crate::geometry::Vector;
use crate::mechanism::walk::along;
use crate::mechanism::{Reference, Robot};
use crate::velocity::geometric::{Viewpoint, geometric};
use crate::velocity::measures::Whole;

/// What makes a configuration singular. Joints are counted from 0; shown from 1.
#[derive(Clone, PartialEq, Debug)]
pub enum Place {
    /// The axes of two joints that turn lie on one line.
    OneLine(usize, usize),
    /// Three parallel axes lie in one plane.
    OnePlane(Vec<usize>),
    /// More than three axes are parallel.
    Parallel(Vec<usize>),
    /// The point where the axes of a wrist meet lies on another axis.
    CentreOnAxis {
        /// The joints of the wrist.
        wrist: Vec<usize>,
        /// The other axis.
        axis: usize,
    },
    /// The point where the axes of a wrist meet lies in a plane with two others, parallel or meeting.
    CentreInPlane {
        /// The joints of the wrist.
        wrist: Vec<usize>,
        /// The others.
        axes: [usize; 2],
        /// Whether these are parallel: then the arm is stretched or folded.
        parallel: bool,
    },
    /// A line meets some axes and is parallel to the others, and at right angles to what slides: a force along it moves
    /// no joint.
    Line {
        /// The axes that it meets.
        meets: Vec<usize>,
        /// The axes that it is parallel to.
        parallel: Vec<usize>,
    },
    /// The point of the body, an origin, lies on the axis of a joint.
    PointOnAxis(usize),
    /// The point of the body lies in one plane with the axes of two joints.
    PointInPlane {
        /// The joints.
        axes: [usize; 2],
        /// Whether their axes are parallel: then the arm is stretched or folded.
        parallel: bool,
    },
    /// These joints can move.
    SelfMotion {
        /// The joints.
        joints: Vec<usize>,
        /// What stands still meanwhile.
        still: Still,
    },
    /// This is not the same everywhere on the singularity.
    Differs,
    /// No joint is free: directions are lost because the arm has less than six.
    Lost,
}

/// What stands still though joints move.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Still {
    /// The body.
    Body,
    /// One point of the body, which turns about it.
    Point,
}

/// Axes nearer than this, by the arm's size, meet.
const TOUCH: f64 = 1e-6;

/// The axis of a joint.
#[derive(Clone, Copy)]
struct Axis {
    z: Vector<f64>,
    o: Vector<f64>,
    turns: bool,
}

impl Place {
    /// From the motions of the joints that leave the body where it is, or its origin.
    pub fn of(robot: &Robot<f64>, (body, still): (Reference, Still), q: &[f64], free: &[Vec<f64>]) -> Self {
        let [free] = free else {
            return match free.first() {
                None => Place::Lost,
                Some(_) => {
                    let joints = moving(&free.concat(), q.len());
                    let on = match still {
                        Still::Point => on_axis(robot, body, q, &joints).map(Place::PointOnAxis),
                        Still::Body => on_one_line(robot, q),
                    };
                    on.unwrap_or(Place::SelfMotion { joints, still })
                }
            };
        };
        let support = moving(free, q.len());
        let size = robot.reach().max(1e-9);
        let found = axes(robot, q).and_then(|axes| match still {
            Still::Body => {
                Self::recognised(&axes, &support, size).or_else(|| line(robot, body, q, &axes, size))
            }
            Still::Point => Self::of_point(origin(robot, body, q)?, &axes, &support, size),
        });
        found.unwrap_or(Place::SelfMotion { joints: support, still })
    }

    /// What is so at all of some configurations: a point on an axis lies in one plane with it and any parallel one, too.
    pub fn shared(places: &[&Self]) -> Option<Self> {
        let plane = places.iter().find(|p| matches!(p, Place::PointInPlane { .. }))?;
        let Place::PointInPlane { axes, parallel: true } = plane else { return None };
        let is_in_it = |p: &&Self| match p {
            Place::PointOnAxis(j) => axes.contains(j),
            other => *other == *plane,
        };
        places.iter().all(is_in_it).then(|| (*plane).clone())
    }

    /// Where a point that stands still lies though the joints of the support turn.
    fn of_point(p: Vector<f64>, axes: &[Axis], support: &[usize], size: f64) -> Option<Self> {
        if !support.iter().all(|&j| axes[j].turns) {
            return None;
        }
        match *support {
            [j] if distance(p, &axes[j]) < TOUCH * size => Some(Place::PointOnAxis(j)),
            [i, j] if in_plane(p, &axes[i], &axes[j], size) => {
                let parallel = axes[i].z.cross(axes[j].z).norm() < TOUCH;
                Some(Place::PointInPlane { axes: [i, j], parallel })
            }
            _ => None,
        }
    }

    fn recognised(axes: &[Axis], support: &[usize], size: f64) -> Option<Self> {
        let all_turn = support.iter().all(|&j| axes[j].turns);
        let is_parallel = |i: usize, j: usize| axes[i].z.cross(axes[j].z).norm() < TOUCH;
        if !all_turn {
            return None;
        }
        if let [i, j] = support
            && is_parallel(*i, *j)
            && distance(axes[*i].o, &axes[*j]) < TOUCH * size
        {
            return Some(Place::OneLine(*i, *j));
        }
        if support.len() >= 3 && support.iter().all(|&j| is_parallel(support[0], j)) {
            let support = support.to_vec();
            return Some(if support.len() == 3 {
                Place::OnePlane(support)
            } else {
                Place::Parallel(support)
            });
        }
        // A wrist: the most joints at the end of the arm whose axes meet.
        let n = axes.len();
        let first = (0..n.saturating_sub(2))
            .find(|&k| (k..n).all(|j| axes[j].turns) && centre(&axes[k..], size).is_some())?;
        let centre = centre(&axes[first..], size)?;
        let wrist: Vec<usize> = (first..n).collect();
        let others: Vec<usize> = support.iter().copied().filter(|&j| j < first).collect();
        match others[..] {
            [axis] if distance(centre, &axes[axis]) < TOUCH * size => {
                Some(Place::CentreOnAxis { wrist, axis })
            }
            [i, j] if in_plane(centre, &axes[i], &axes[j], size) => {
                Some(Place::CentreInPlane { wrist, axes: [i, j], parallel: is_parallel(i, j) })
            }
            _ => None,
        }
    }
}

/// The line along which no force reaches a joint, if what is lost is such a line.
fn line(robot: &Robot<f64>, body: Reference, q: &[f64], axes: &[Axis], size: f64) -> Option<Place> {
    let view = Viewpoint { axes: Reference::Base, body, at: Reference::Base, offset: Vector::zero() };
    let is_angle: Vec<bool> = axes.iter().map(|a| a.turns).collect();
    let lost = Whole::new(&geometric(robot, q, &view), &is_angle, size).lost;
    let [w] = lost[..] else { return None };
    let (f, m) = (Vector([w[0], w[1], w[2]]), Vector([w[3], w[4], w[5]]));
    if f.norm() < TOUCH || f.dot(m).abs() > TOUCH * f.norm() {
        return None;
    }
    let (mut meets, mut parallel) = (vec![], vec![]);
    for (j, _) in axes.iter().enumerate().filter(|(_, a)| a.turns) {
        let is_parallel = axes[j].z.cross(f).norm() < TOUCH * f.norm();
        if is_parallel { parallel.push(j) } else { meets.push(j) }
    }
    Some(Place::Line { meets, parallel })
}

/// Two axes on one line, of an arm with more joints than it needs: the only ones, and not so in every configuration.
fn on_one_line(robot: &Robot<f64>, q: &[f64]) -> Option<Place> {
    let near = TOUCH * robot.reach().max(1e-9);
    let pairs = |q: &[f64]| -> Option<Vec<(usize, usize)>> {
        let axes = axes(robot, q)?;
        let all = (0..axes.len()).flat_map(|i| (i + 1..axes.len()).map(move |j| (i, j)));
        let is_one = |&(i, j): &(usize, usize)| {
            axes[i].turns
                && axes[j].turns
                && axes[i].z.cross(axes[j].z).norm() < TOUCH
                && distance(axes[i].o, &axes[j]) < near
        };
        Some(all.filter(is_one).collect())
    };
    let elsewhere: Vec<f64> = q.iter().enumerate().map(|(j, x)| x + 0.6 + 0.2 * j as f64).collect();
    match (&pairs(q)?[..], &pairs(&elsewhere)?[..]) {
        (&[(i, j)], []) => Some(Place::OneLine(i, j)),
        _ => None,
    }
}

/// The axis, among those of some joints, on which the body's origin lies.
fn on_axis(robot: &Robot<f64>, body: Reference, q: &[f64], joints: &[usize]) -> Option<usize> {
    let (p, axes) = (origin(robot, body, q)?, axes(robot, q)?);
    let near = TOUCH * robot.reach().max(1e-9);
    joints.iter().copied().find(|&j| axes[j].turns && distance(p, &axes[j]) < near)
}

/// The origin of a body.
fn origin(robot: &Robot<f64>, body: Reference, q: &[f64]) -> Option<Vector<f64>> {
    match body {
        Reference::Tool => Some(robot.pose(q).translation),
        Reference::Base => None,
        Reference::Frame(n) => Some(robot.frames(q).get(n)?.translation),
    }
}

/// Which joints move.
fn moving(free: &[f64], joints: usize) -> Vec<usize> {
    let moves = |j: usize| free.iter().skip(j).step_by(joints.max(1)).any(|x| x.abs() > 1e-6);
    (0..joints).filter(|&j| moves(j)).collect()
}

/// The axes in the base, if each joint moves one row.
fn axes(robot: &Robot<f64>, q: &[f64]) -> Option<Vec<Axis>> {
    let mut axes: Vec<Option<Axis>> = vec![None; robot.joints];
    for (link, (line, _)) in robot.links.iter().zip(along(&robot.links, q, robot.base)) {
        for mover in link.movers() {
            let turns = mover.kind == JointKind::Revolute;
            if axes[mover.joint].replace(Axis { z: line.direction, o: line.point, turns }).is_some() {
                return None;
            }
        }
    }
    axes.into_iter().collect()
}

fn distance(p: Vector<f64>, axis: &Axis) -> f64 {
    axis.z.cross(p - axis.o).norm()
}

/// The point where at least three axes meet, if they do.
fn centre(axes: &[Axis], size: f64) -> Option<Vector<f64>> {
    let (a, b) = axes.first().zip(axes[1..].iter().find(|b| axes[0].z.cross(b.z).norm() > 1e-3))?;
    // The point of a nearest to b.
    let n = a.z.cross(b.z);
    let t = (b.o - a.o).cross(b.z).dot(n) / n.dot(n);
    let point = a.o + a.z.scale(t);
    axes.iter().all(|axis| distance(point, axis) < TOUCH * size).then_some(point)
}

/// Whether a point and two axes lie in one plane.
fn in_plane(p: Vector<f64>, a: &Axis, b: &Axis, size: f64) -> bool {
    let between = b.o - a.o;
    let normal = if a.z.cross(b.z).norm() < TOUCH { a.z.cross(between) } else { a.z.cross(b.z) };
    let length = normal.norm();
    length > TOUCH * size.min(1.0)
        && (between.dot(normal) / length).abs() < TOUCH * size
        && ((p - a.o).dot(normal) / length).abs() < TOUCH * size
}
