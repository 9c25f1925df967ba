//! Inverse kinematics by other libraries.

use crate::inverse::{Contestant, Joints, POSES, Rows};
use anyhow::{Result, ensure};
use denavit::Robot;
use denavit::geometry::Transform;
use ik_geo::robot::{self, IKSolver};
use nalgebra_32::{Matrix3, Matrix3x6, SMatrix, Vector3};
use rs_opw_kinematics::glam::{DMat3, DQuat, DVec3};
use rs_opw_kinematics::kinematic_traits::{Kinematics, Pose};
use rs_opw_kinematics::kinematics_impl::OPWKinematics;
use rs_opw_kinematics::parameters::opw_kinematics::Parameters;
use std::hint::black_box;
use std::rc::Rc;

/// What is special about an arm, as `ik-geo` has it.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// Three parallel axes, and two that meet.
    ThreeParallel,
    /// A spherical wrist, and two parallel axes.
    Wrist,
    /// Axes 5 and 6 meet where frame 5 is.
    TwoMeet,
    /// Nothing that is made use of.
    General,
}

/// `ik-geo`: axes and the ways between them at zero.
pub struct Geo {
    solver: Rc<robot::Robot>,
    /// The last frame at zero.
    last: Matrix3<f64>,
}

impl Geo {
    /// For an arm with six revolute joints.
    pub fn new(robot: &Robot<f64>, family: Family) -> Self {
        let zero = vec![0.0; robot.joints];
        let mut x = robot.base;
        let (mut axes, mut points) = (vec![], vec![]);
        for link in &robot.links {
            let before = x * link.before;
            axes.push(before.rotation.z().0);
            points.push(before.translation.0);
            x = x * link.transform(&zero);
        }
        x = x * robot.tool;
        match family {
            Family::ThreeParallel => {}
            // A point of axis 4 where it meets the others.
            Family::Wrist => points[3] = points[4],
            Family::TwoMeet => points[4] = points[5],
            // Points away from those where axes meet, which the search would take for special cases.
            Family::General => {
                for k in [3, 5] {
                    points[k] = std::array::from_fn(|r| points[k][r] + 0.1 * axes[k][r]);
                }
            }
        }
        points.push(x.translation.0);
        let h = Matrix3x6::from_fn(|r, c| axes[c][r]);
        let before = |r: usize, c: usize| if c == 0 { 0.0 } else { points[c - 1][r] };
        let p = SMatrix::<f64, 3, 7>::from_fn(|r, c| points[c][r] - before(r, c));
        let make = match family {
            Family::ThreeParallel => robot::three_parallel_two_intersecting,
            Family::Wrist => robot::spherical_two_parallel,
            Family::TwoMeet => robot::two_intersecting,
            Family::General => robot::gen_six_dof,
        };
        let last = Matrix3::from_fn(|r, c| x.rotation.rows()[r][c]);
        Geo { solver: Rc::new(make(h, p)), last }
    }

    /// Where its hand is, metres.
    pub fn position(&self, q: &Joints) -> [f64; 3] {
        self.solver.fk(q).1.into()
    }

    /// What it takes: the rotation relative to that at zero, and the position.
    fn given(&self, poses: &[Rows]) -> Vec<(Matrix3<f64>, Vector3<f64>)> {
        let given = |v: &Rows| {
            let r = Matrix3::from_fn(|r, c| v[4 * r + c]);
            (r * self.last.transpose(), Vector3::new(v[3], v[7], v[11]))
        };
        poses.iter().map(given).collect()
    }

    /// Solves all poses.
    pub fn runner(&self, poses: &[Rows]) -> impl FnMut() + 'static {
        let (given, solver) = (self.given(poses), self.solver.clone());
        move || {
            for (r, p) in &given {
                black_box(solver.ik(*black_box(r), *black_box(p)));
            }
        }
    }

    /// All answers for one of the poses, by its number.
    pub fn solver(&self, poses: &[Rows]) -> impl FnMut(usize) -> Vec<Joints> + 'static {
        let (given, solver) = (self.given(poses), self.solver.clone());
        move |k| {
            let (r, p) = given[k];
            solver.ik(r, p).iter().map(|(q, _)| std::array::from_fn(|j| q[j])).collect()
        }
    }

    pub fn contestant(&self, poses: &[Rows]) -> Contestant {
        let answers = (0..poses.len()).map(self.solver(poses)).collect();
        let run = Box::new(self.runner(poses));
        Contestant { name: "ik-geo 0.1.2".into(), limit: None, answers, run }
    }
}

/// `rs-opw-kinematics` with its own numbers of the arm.
pub struct Opw {
    solver: OPWKinematics,
    /// Its last frame in ours.
    last: Transform<f64>,
}

impl Opw {
    /// # Errors
    /// If it is another arm.
    pub fn new(robot: &Robot<f64>) -> Result<Self> {
        let solver = OPWKinematics::new(Parameters::irb2400_10());
        let zero = [0.0; 6];
        let last = robot.pose(&zero).inverse() * transform(&solver.forward(&zero));
        let q = [0.3, -0.5, 0.7, 1.1, -1.3, 1.7];
        let (ours, theirs) = ((robot.pose(&q) * last).matrix(), transform(&solver.forward(&q)).matrix());
        let apart = ours.iter().flatten().zip(theirs.iter().flatten()).map(|(a, b)| (a - b).abs());
        ensure!(apart.fold(0.0, f64::max) < 1e-9, "the peer's arm is another one");
        Ok(Opw { solver, last })
    }

    pub fn contestant(&self, poses: &[Rows]) -> Contestant {
        let last = self.last;
        let given: Vec<Pose> = poses.iter().map(|v| pose(&(rows(v) * last))).collect();
        let answers = given.iter().map(|p| self.solver.inverse(p)).collect();
        let solver = OPWKinematics::new(Parameters::irb2400_10());
        debug_assert_eq!(poses.len(), POSES);
        let run = Box::new(move || {
            for pose in &given {
                black_box(solver.inverse(black_box(pose)));
            }
        });
        Contestant { name: "rs-opw-kinematics 3.0".into(), limit: None, answers, run }
    }
}

fn rows(v: &Rows) -> Transform<f64> {
    let r = std::array::from_fn(|i| std::array::from_fn(|j| v[4 * i + j]));
    let p = denavit::geometry::Vector([v[3], v[7], v[11]]);
    Transform::from_rotation_translation(denavit::geometry::Rotation::from_rows(r), p)
}

fn pose(x: &Transform<f64>) -> Pose {
    let (r, p) = (x.rotation.rows(), x.translation.0);
    let columns = [0, 1, 2].map(|j| DVec3::new(r[0][j], r[1][j], r[2][j]));
    let rotation = DQuat::from_mat3(&DMat3::from_cols(columns[0], columns[1], columns[2]));
    Pose::from_parts(DVec3::new(p[0], p[1], p[2]), rotation)
}

fn transform(pose: &Pose) -> Transform<f64> {
    let m = DMat3::from_quat(pose.rotation);
    let r = std::array::from_fn(|i| std::array::from_fn(|j| m.col(j)[i]));
    let p = denavit::geometry::Vector(pose.translation.to_array());
    Transform::from_rotation_translation(denavit::geometry::Rotation::from_rows(r), p)
}
