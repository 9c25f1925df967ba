//! The same pose by other libraries.

pub mod inverse;

use anyhow::{Context, Result};
use denavit::Robot;
use denavit::geometry::Transform;
use k::nalgebra as kn;
use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

/// The chain in `k`: each joint turns about z, what follows it is constant.
pub struct KChain(k::SerialChain<f64>);

impl KChain {
    /// # Errors
    /// If a joint is not a plain rotation.
    pub fn new(robot: &Robot<f64>) -> Result<Self> {
        let mut origin = robot.base;
        let mut nodes: Vec<k::Node<f64>> = vec![];
        let mut add = |name: String, kind: k::JointType<f64>, x: Transform<f64>| {
            let rotation = kn::Matrix3::from_fn(|r, c| x.rotation.rows()[r][c]);
            let rotation = kn::UnitQuaternion::from_matrix(&rotation);
            let [px, py, pz] = x.translation.0;
            let node = k::NodeBuilder::new()
                .name(&name)
                .joint_type(kind)
                .translation(kn::Translation3::new(px, py, pz))
                .rotation(rotation)
                .into_node();
            if let Some(last) = nodes.last() {
                node.set_parent(last);
            }
            nodes.push(node);
        };
        let zero = vec![0.0; robot.joints];
        for (i, link) in robot.links.iter().enumerate() {
            anyhow::ensure!(link.theta.terms.len() == 1 && link.d.terms.is_empty(), "a revolute joint");
            let axis = kn::Vector3::z_axis();
            add(format!("q{}", i + 1), k::JointType::Rotational { axis }, origin * link.before);
            origin = link.before.inverse() * link.transform(&zero);
        }
        add("tool".into(), k::JointType::Fixed, origin * robot.tool);
        let last = nodes.last().context("a chain has a last node")?;
        Ok(KChain(k::SerialChain::from_end(last)))
    }

    /// The pose of the last node.
    pub fn pose(&self, q: &[f64]) -> kn::Isometry3<f64> {
        self.0.set_joint_positions_unchecked(q);
        self.0.end_transform()
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
