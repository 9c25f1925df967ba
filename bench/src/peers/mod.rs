//! The same pose by other libraries.

pub mod inverse;

use anyhow::{Context, Result};
use denavit::Robot;
use denavit::geometry::Transform;
use k::InverseKinematicsSolver;
use k::nalgebra as kn;
use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

/// The chain in `k`: each joint turns about z, what follows it is constant.
pub struct KChain {
    chain: k::SerialChain<f64>,
    solver: k::JacobianIkSolver<f64>,
}

/// An answer of its solver misses the pose by less, metres or radians.
const TOLERANCE: f64 = 1e-6;
/// The share of each step that it takes, and the most steps: those of its examples.
const STEPS: (f64, usize) = (0.5, 100);

impl KChain {
    /// With limits of its joints, or none.
    ///
    /// # Errors
    /// If a joint is not a plain rotation.
    pub fn new(robot: &Robot<f64>, limits: &[Option<[f64; 2]>]) -> Result<Self> {
        let mut origin = robot.base;
        let mut nodes: Vec<k::Node<f64>> = vec![];
        let mut add = |name: String, kind: k::JointType<f64>, x: Transform<f64>, limits: Option<[f64; 2]>| {
            let rotation = kn::Matrix3::from_fn(|r, c| x.rotation.rows()[r][c]);
            let rotation = kn::UnitQuaternion::from_matrix(&rotation);
            let [px, py, pz] = x.translation.0;
            let node = k::NodeBuilder::new()
                .name(&name)
                .joint_type(kind)
                .limits(limits.map(|[low, high]| k::joint::Range::new(low, high)))
                .translation(kn::Translation3::new(px, py, pz))
                .rotation(rotation)
                .into_node();
            if let Some(last) = nodes.last() {
                node.set_parent(last);
            }
            nodes.push(node);
        };
        let zero = vec![0.0; robot.joints];
        for link in &robot.links {
            let [(joint, factor)] = link.theta.terms[..] else {
                anyhow::ensure!(link.theta.terms.is_empty() && link.d.terms.is_empty(), "a revolute joint");
                origin = origin * link.transform(&zero);
                continue;
            };
            anyhow::ensure!(factor == 1.0 && link.d.terms.is_empty(), "a revolute joint");
            let kind = k::JointType::Rotational { axis: kn::Vector3::z_axis() };
            let limits = limits.get(joint).copied().flatten();
            add(format!("q{}", joint + 1), kind, origin * link.before, limits);
            origin = link.before.inverse() * link.transform(&zero);
        }
        add("tool".into(), k::JointType::Fixed, origin * robot.tool, None);
        let last = nodes.last().context("a chain has a last node")?;
        let solver = k::JacobianIkSolver::new(TOLERANCE, TOLERANCE, STEPS.0, STEPS.1);
        Ok(KChain { chain: k::SerialChain::from_end(last), solver })
    }

    /// The pose of the last node.
    pub fn pose(&self, q: &[f64]) -> kn::Isometry3<f64> {
        self.chain.set_joint_positions_unchecked(q);
        self.chain.end_transform()
    }

    /// A configuration for a pose, from another one on.
    pub fn solve(&self, pose: &Transform<f64>, seed: &[f64]) -> Option<Vec<f64>> {
        let rotation = kn::Matrix3::from_fn(|r, c| pose.rotation.rows()[r][c]);
        let rotation = kn::Rotation3::from_matrix_unchecked(rotation);
        let rotation = kn::UnitQuaternion::from_rotation_matrix(&rotation);
        let [px, py, pz] = pose.translation.0;
        let target = kn::Isometry3::from_parts(kn::Translation3::new(px, py, pz), rotation);
        self.chain.set_joint_positions_unchecked(seed);
        self.solver.solve(&self.chain, &target).ok().map(|()| self.chain.joint_positions())
    }
}

/// The product of the link transforms in nalgebra, as one would write it.
pub struct PlainNalgebra {
    base: Isometry3<f64>,
    links: Vec<Isometry3<f64>>,
}

impl PlainNalgebra {
    /// The constant parts of a chain of revolute joints.
    pub fn new(robot: &Robot<f64>) -> Self {
        let zero = vec![0.0; robot.joints];
        let links = robot.links.iter().map(|link| isometry(&link.transform(&zero))).collect();
        PlainNalgebra { base: isometry(&robot.base), links }
    }

    /// base · Π Rz(qᵢ)·Xᵢ, for tables in the standard convention.
    pub fn pose(&self, q: &[f64]) -> Isometry3<f64> {
        let turn = |q: f64| {
            Isometry3::from_parts(
                Translation3::identity(),
                UnitQuaternion::from_axis_angle(&Vector3::z_axis(), q),
            )
        };
        self.links.iter().zip(q).fold(self.base, |x, (link, &q)| x * turn(q) * link)
    }
}

fn isometry(x: &Transform<f64>) -> Isometry3<f64> {
    let rotation = Rotation3::from_matrix_unchecked(Matrix3::from_fn(|r, c| x.rotation.rows()[r][c]));
    let [px, py, pz] = x.translation.0;
    Isometry3::from_parts(Translation3::new(px, py, pz), UnitQuaternion::from_rotation_matrix(&rotation))
}
