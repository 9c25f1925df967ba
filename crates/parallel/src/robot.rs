//! A parallel robot of any family, behind one set of questions.

use crate::delta::{Delta, Drive, NoPosition, OutOfReach};
use crate::planar::{Planar, PlanarPose};
use crate::rates::Rates;
use crate::stewart::{Bound, Stewart};
use denavit::description::parallel::{DeltaDrive, Family};
use denavit::geometry::{Rotation, Transform, Vector};

/// A robot in numbers.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Robot {
    /// A Stewart platform.
    Stewart(Stewart),
    /// A delta.
    Delta(Delta),
    /// A planar 3-RRR robot.
    Planar(Planar),
}

/// Drives for a pose.
#[derive(Clone, PartialEq, Debug)]
pub struct Solution {
    /// A sign for each leg; nothing where there is one solution alone.
    pub mode: String,
    /// Radians or metres.
    pub q: Vec<f64>,
    /// By how much a leg of its pose is open at most, metres.
    pub residual: f64,
}

/// A pose for drives.
#[derive(Clone, PartialEq, Debug)]
pub struct Assembly {
    /// A number, counted from 1, or a sign.
    pub mode: String,
    /// The pose of the platform in the base.
    pub pose: Transform<f64>,
    /// By how much a leg is open at most, metres.
    pub residual: f64,
    /// Whether it is proved that there is a solution here, and no second one near it; closed forms prove none.
    pub is_proved: bool,
}

/// All poses for drives that were found.
#[derive(Clone, PartialEq, Debug)]
pub struct Assemblies {
    /// By their modes.
    pub all: Vec<Assembly>,
    /// What is known of their number.
    pub known: Known,
}

/// What is known of the number of poses.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Known {
    /// A closed form has no others.
    ClosedForm,
    /// So many solutions over the complex numbers are proved, and so many paths ended in none.
    Paths {
        /// Proved, and different for sure.
        proved: usize,
        /// The most that there can be.
        bound: Bound,
        /// Of forty.
        lost: usize,
    },
    /// A polynomial of degree 6 has no other real roots for sure, or there may be others.
    Sextic {
        /// Whether its roots are counted for sure.
        is_counted: bool,
    },
    /// The centres of three spheres lie on a line: infinitely many positions, or none.
    OnALine,
}

impl From<&Family<f64>> for Robot {
    fn from(family: &Family<f64>) -> Self {
        match *family {
            Family::Stewart { base, platform } => Robot::Stewart(Stewart { base, platform }),
            Family::Delta { base_radius, platform_radius, lower_arm, angles, drive } => Robot::Delta(Delta {
                base: base_radius,
                platform: platform_radius,
                rod: lower_arm,
                arms: angles,
                drive: match drive {
                    DeltaDrive::Turns(arm) => Drive::Turns(arm),
                    DeltaDrive::Slides(slope) => Drive::Slides(slope),
                },
            }),
            Family::Planar3Rrr { base, platform, proximal, distal } => {
                Robot::Planar(Planar { base, platform, first: proximal, second: distal })
            }
        }
    }
}

/// The pose in the plane.
fn planar(pose: &Transform<f64>) -> PlanarPose {
    let x = pose.rotation.x();
    PlanarPose { position: [pose.translation[0], pose.translation[1]], angle: x[1].atan2(x[0]) }
}

fn three(q: &[f64]) -> [f64; 3] {
    [q[0], q[1], q[2]]
}

impl Robot {
    /// All drives for a pose, of which a delta takes the position and a planar robot what lies in the plane.
    ///
    /// # Errors
    /// The first leg that does not reach.
    pub fn inverse(&self, pose: &Transform<f64>) -> Result<Vec<Solution>, OutOfReach> {
        let modes = match self {
            Robot::Stewart(s) => {
                return Ok(vec![Solution {
                    mode: String::new(),
                    q: s.lengths(pose).to_vec(),
                    residual: 0.0,
                }]);
            }
            Robot::Delta(d) => d.inverse(pose.translation)?,
            Robot::Planar(p) => p.inverse(&planar(pose))?,
        };
        let solution = |m: &crate::delta::Mode| Solution {
            mode: m.name(),
            q: m.q.to_vec(),
            residual: self.open(pose, &m.q),
        };
        Ok(modes.iter().map(solution).collect())
    }

    /// By how much a leg is open at most, metres.
    pub fn open(&self, pose: &Transform<f64>, q: &[f64]) -> f64 {
        let larger = |most: f64, x: f64| if x.is_nan() { f64::INFINITY } else { most.max(x.abs()) };
        let most = |off: &mut dyn Iterator<Item = f64>| off.fold(0.0, larger);
        match self {
            Robot::Stewart(s) => most(&mut s.lengths(pose).iter().zip(q).map(|(a, b)| a - b)),
            Robot::Delta(d) => most(&mut (0..3).map(|i| d.rod_at(i, pose.translation, q[i]).norm() - d.rod)),
            Robot::Planar(p) => most(&mut (0..3).map(|i| {
                let [x, y] = p.link_at(i, &planar(pose), q[i]);
                x.hypot(y) - p.second[i]
            })),
        }
    }

    /// All poses for drives.
    ///
    /// # Panics
    /// If there is not one value for each drive.
    pub fn forward(&self, q: &[f64]) -> Assemblies {
        let numbered = |k: usize| (k + 1).to_string();
        match self {
            Robot::Stewart(s) => {
                let found = s.forward(&[q[0], q[1], q[2], q[3], q[4], q[5]]);
                let known = Known::Paths { proved: found.proved, bound: found.bound, lost: found.lost };
                let one = |(k, a): (usize, &crate::stewart::Assembly)| Assembly {
                    mode: numbered(k),
                    pose: a.pose,
                    residual: a.residual,
                    is_proved: a.radius.is_some(),
                };
                Assemblies { all: found.assemblies.iter().enumerate().map(one).collect(), known }
            }
            Robot::Delta(d) => match d.forward(&three(q)) {
                Ok(both) => {
                    let one = |(sign, p): &(crate::delta::Sign, Vector<f64>)| {
                        let pose = Transform::from_rotation_translation(Rotation::identity(), *p);
                        let mode = if both.len() == 1 { "=".into() } else { sign.letter().to_string() };
                        Assembly { mode, pose, residual: self.open(&pose, q), is_proved: false }
                    };
                    Assemblies { all: both.iter().map(one).collect(), known: Known::ClosedForm }
                }
                Err(NoPosition::Apart) => Assemblies { all: vec![], known: Known::ClosedForm },
                Err(NoPosition::OnALine) => Assemblies { all: vec![], known: Known::OnALine },
            },
            Robot::Planar(p) => {
                let found = p.forward(&three(q));
                let one = |(k, a): (usize, &crate::planar::PlanarAssembly)| Assembly {
                    mode: numbered(k),
                    pose: a.pose.transform(),
                    residual: a.residual,
                    is_proved: a.is_proved,
                };
                Assemblies {
                    all: found.assemblies.iter().enumerate().map(one).collect(),
                    known: Known::Sextic { is_counted: found.is_complete },
                }
            }
        }
    }

    /// J_x ẋ = J_q q̇; nothing where a leg of a Stewart platform has the length 0.
    ///
    /// # Panics
    /// If there is not one value for each drive.
    pub fn rates(&self, pose: &Transform<f64>, q: &[f64]) -> Option<Rates> {
        match self {
            Robot::Stewart(s) => s.rates(pose),
            Robot::Delta(d) => Some(d.rates(pose.translation, &three(q))),
            Robot::Planar(p) => Some(p.rates(&planar(pose), &three(q))),
        }
    }
}

impl Assemblies {
    /// True if there are no other poses, but for motions with drives at rest where legs meet in three points.
    pub fn is_complete(&self) -> bool {
        match self.known {
            Known::ClosedForm => true,
            Known::Paths { proved, bound, .. } => {
                proved == bound.count() && self.all.iter().all(|a| a.is_proved)
            }
            Known::Sextic { is_counted } => is_counted,
            Known::OnALine => false,
        }
    }

    /// The most poses that such a robot can have.
    pub fn most(&self) -> usize {
        match self.known {
            Known::ClosedForm | Known::OnALine => 2,
            Known::Paths { bound, .. } => bound.count(),
            Known::Sextic { .. } => 6,
        }
    }
}
