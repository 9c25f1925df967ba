//! Jacobians and singularities.

use super::English;
use crate::tree::{Line, Math};
use crate::words::{Gain, Loss, Terms, Velocity};
use denavit::forward::{Proof, Reference};
use denavit::velocity::{Blocks, Obstacle, Place, Still};
use denavit_program::Count;
use denavit_symbolic::Refusal;

impl Velocity for English {
    fn jacobian_title(&self, robot: &str) -> String {
        format!("Jacobian of the {robot}")
    }

    fn viewpoint(&self, body: Reference, at: Reference, offset: Option<[Math; 3]>, axes: Reference) -> Line {
        let [body, at, axes] = [body, at, axes].map(|frame| self.of_frame(frame));
        let mut line =
            Line::new(format!("Linear rows first: the velocity of the point {body} at the origin {at}"));
        if let Some(offset) = offset {
            line = line.text(" plus (").list(offset).text(")");
        }
        line.text(format!(", then its angular velocity, along the axes {axes}."))
    }

    fn no_entries(&self, why: Refusal) -> String {
        format!("The entries are not expanded: {}.", self.unexpanded(why))
    }

    fn jacobian_cost(&self, count: &Count, proof: Proof) -> String {
        format!("{}; {}.", self.count(count), self.jacobian_proof(proof))
    }

    fn shortest(&self) -> String {
        "In this frame and at this point the matrix is shortest. The twist along other axes, and at another point of the \
         same body, follows by a rotation and a lever arm, which leave the determinant as it is."
            .into()
    }

    fn shortest_title(&self) -> String {
        "Where it is shortest".into()
    }

    fn determinant_title(&self) -> String {
        "Determinant".into()
    }

    fn several_determinants(&self, has_surplus: bool, directions: usize) -> String {
        let number = if directions == 3 { "three" } else { "six" };
        match has_surplus {
            true => format!(
                "There are more joints than directions: the arm is singular where the determinants with all choices of \
                 {number} joints are 0."
            ),
            false => "There are fewer joints than directions: the arm is singular where the determinants of all choices of \
                      rows are 0. Those that are 0 everywhere are left out."
                .into(),
        }
    }

    fn minor_of_joints(&self, joints: &[usize]) -> String {
        format!("Joints {}:", plain(joints))
    }

    fn always_singular(&self, rank: usize, is_point: bool) -> String {
        let thing = if is_point { "point" } else { "hand" };
        format!(
            "The rank is {rank} at the most: in every configuration the {thing} lacks a direction, and some joints can move while it \
             stands still. The rank is less still where the determinants with all choices of {rank} rows and {rank} joints are 0. \
             Those that are 0 everywhere are left out."
        )
    }

    fn minor_of_both(&self, rows: &[&str], joints: &[usize]) -> String {
        format!("Rows {}, joints {}:", rows.join(", "), plain(joints))
    }

    fn minor_of_rows(&self, rows: &[&str]) -> String {
        format!("Rows {}:", rows.join(", "))
    }

    fn singularities_title(&self) -> String {
        "Singularities".into()
    }

    fn no_singularity(&self, is_complete: bool, several: bool) -> String {
        match (is_complete, several) {
            (true, false) => "There are none: the determinant is never 0.",
            (true, true) => "There are none: the determinants are never all 0 at once.",
            (false, _) => "No factor that depends on the joints is shared by all of the determinants.",
        }
        .into()
    }

    fn besides(&self) -> String {
        "Besides, the arm is singular where all of the determinants above are 0 at once.".into()
    }

    fn besides_where(&self) -> String {
        "The determinants are 0 at once, too, where all that stands in one of these lines is 0, and nowhere else:".into()
    }

    fn point_title(&self) -> String {
        "The position alone".into()
    }

    fn point_alone(&self, at: Reference, axes: Reference) -> Line {
        let [at, axes] = [at, axes].map(|frame| self.of_frame(frame));
        Line::new(format!(
            "The body is looked at with its orientation above. The velocity of the origin {at} alone, along the axes {axes}, is \
             that of three rows:"
        ))
    }

    fn zeros(&self, all: Vec<Math>) -> Line {
        let mut line = Line::new("where ");
        for (k, math) in all.into_iter().enumerate() {
            line = line.text(if k > 0 { " or " } else { "" }).math(math);
        }
        line
    }

    fn no_example(&self, assumes: bool) -> String {
        match assumes {
            true => "with the lengths that are assumed here no configuration was found where this factor alone is 0",
            false => "no configuration was found where this factor alone is 0",
        }
        .into()
    }

    fn place(&self, place: &Place) -> String {
        let numbers = |joints: &[usize]| self.numbers(joints);
        match place {
            Place::OneLine(i, j) => format!("axes {} and {} lie on one line", i + 1, j + 1),
            Place::OnePlane(axes) => {
                format!("the parallel axes {} lie in one plane: stretched or folded", numbers(axes))
            }
            Place::CentreOnAxis { wrist, axis } => {
                format!("the point where axes {} meet lies on axis {}", numbers(wrist), axis + 1)
            }
            Place::CentreInPlane { wrist, axes, parallel } => {
                let (wrist, axes) = (numbers(wrist), numbers(axes));
                let bent = if *parallel { ": stretched or folded" } else { "" };
                format!("the point where axes {wrist} meet lies in one plane with axes {axes}{bent}")
            }
            Place::Parallel(axes) => format!("axes {} are parallel", numbers(axes)),
            Place::Line { meets, parallel } => {
                let text = format!("one line meets axes {}", numbers(meets));
                match &parallel[..] {
                    [] => text,
                    axes => format!("{text} and is parallel to axes {}", numbers(axes)),
                }
            }
            Place::PointOnAxis(axis) => format!("the point lies on axis {}", axis + 1),
            Place::PointInPlane { axes, parallel } => {
                let bent = if *parallel { ": stretched or folded" } else { "" };
                format!("the point lies in one plane with axes {}{bent}", numbers(axes))
            }
            Place::SelfMotion { joints, still } => match &joints[..] {
                [j] => format!("joint {} does not move the {}", j + 1, still_thing(*still)),
                joints => {
                    let (joints, thing) = (numbers(joints), still_thing(*still));
                    format!("joints {joints} have velocities together at which the {thing} is at rest")
                }
            },
            Place::Differs => "how the axes lie differs from place to place".into(),
            Place::Lost => "the joints that there are have one direction less".into(),
        }
    }

    fn lost(&self, loss: Loss) -> String {
        match loss {
            Loss::VelocityAlong(axis, frame) => {
                format!("lost: velocity along the {axis} axis {}", self.of_frame(frame))
            }
            Loss::RotationAbout(axis, frame) => {
                format!("lost: rotation about the {axis} axis {}", self.of_frame(frame))
            }
            Loss::Velocity => "lost: a velocity of the point, in one direction".into(),
            Loss::Rotation => "lost: a rotation, about one direction".into(),
            Loss::Screw => "lost: a screw, a velocity and a rotation together".into(),
        }
    }

    fn gained(&self, gain: &Gain) -> String {
        match gain {
            Gain::Turns { joints: [i, j], is_same } => {
                let way = if *is_same { "together" } else { "against each other" };
                let (i, j) = (i + 1, j + 1);
                format!("gained: joints {i} and {j} turn {way} while the body stands still")
            }
            Gain::Moves(joints, still) => {
                let (all, several) = (plain(joints), joints.len() != 1);
                let (joints, moves) = if several { ("joints", "move") } else { ("joint", "moves") };
                format!("gained: {joints} {all} {moves} at first with the {} at rest", still_thing(*still))
            }
        }
    }

    fn rates_title(&self) -> String {
        "Joint velocities for a twist".into()
    }

    fn rates(&self, blocks: Blocks) -> String {
        match blocks {
            Blocks::Point => "The linear rows give the velocities of the three joints.",
            Blocks::Rows => {
                "Rows in which as many joints are open as there are of them give these joints, one such block after the \
                 other. ux to rz are what the joints before leave of vx to wz."
            }
            Blocks::Wrist => {
                "The last three joints do not move the point: the linear rows give the velocities of the first three \
                 joints. rx, ry and rz are what these leave of the angular velocity for the others."
            }
        }
        .into()
    }

    fn different(&self, all: Vec<Math>) -> Line {
        Line::new("where ").list(all)
    }

    fn unknown_singularities(&self, why: &Obstacle) -> String {
        why.to_string()
    }

    fn motion(&self, all: Vec<Math>) -> Line {
        Line::new("in the ratio ").list(all)
    }

    fn values_missing(&self, parameters: Vec<Math>) -> Line {
        let has = if parameters.len() == 1 { " has" } else { " have" };
        Line::default()
            .list(parameters)
            .text(has)
            .text(" no value: singular configurations were not looked for in numbers.")
    }

    fn found_singularities(&self, count: usize) -> String {
        match count {
            0 => "Descents of the smallest singular value found no singular configuration.",
            _ => {
                "In numbers, descents of the smallest singular value led to these singular configurations, one of each \
                 kind that was found. There are others beside each of them, and there may be other kinds."
            }
        }
        .into()
    }
}

/// What stands still.
fn still_thing(still: Still) -> &'static str {
    match still {
        Still::Body => "body",
        Still::Point => "point",
    }
}

/// Numbers from 0, shown from 1, with commas alone.
fn plain(joints: &[usize]) -> String {
    joints.iter().map(|j| (j + 1).to_string()).collect::<Vec<_>>().join(", ")
}
