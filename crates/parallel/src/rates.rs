//! How a platform moves with its drives, J_x ẋ = J_q q̇, and where either side fails.
//!
//! Gosselin and Angeles ("Singularity analysis of closed-loop kinematic chains", IEEE Trans. Robotics and Automation 6, 1990) call
//! singularities of the first type those where a drive moves and the platform does not (J_q loses rank: *serial* here), of the second type
//! those where the platform moves and no drive does (J_x loses rank: *parallel*).

use denavit::geometry::Vector;
use denavit::velocity::{RANK, svd};

/// Both sides of J_x ẋ = J_q q̇ at a pose.
#[derive(Clone, PartialEq, Debug)]
pub struct Rates {
    /// What ẋ is.
    pub motion: Motion,
    /// J_x, a row a leg: directions of rods, with their moments where the platform turns, metres.
    pub platform: Vec<Vec<f64>>,
    /// The diagonal of J_q.
    pub drives: Vec<f64>,
    /// The size of each entry of the diagonal where the leg is as far from being singular as it can be.
    most: Vec<f64>,
    /// By which the moments are divided where numbers of both kinds are compared, metres.
    pub length: f64,
    /// The origin of the platform.
    origin: Vector<f64>,
}

/// What the velocity of the platform is made of.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Motion {
    /// vx, vy, vz, ωx, ωy, ωz.
    Space,
    /// vx, vy, vz.
    Translation,
    /// vx, vy, ωz.
    Plane,
}

/// A motion of the platform with all drives at rest.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Gained {
    /// Along a unit vector.
    Translation(Vector<f64>),
    /// A turn about an axis, and a shift along it, metres a radian.
    Screw {
        /// Its direction, a unit vector.
        axis: Vector<f64>,
        /// The point of the axis that is nearest to the platform's origin.
        point: Vector<f64>,
        /// 0 of a pure rotation.
        pitch: f64,
    },
}

/// What is said of a pose.
#[derive(Clone, PartialEq, Debug)]
pub struct Singular {
    /// Singular values of J_x, lengths by [`Rates::length`], descending: below 1e-9 of the first they count as 0.
    pub values: Vec<f64>,
    /// The motions that belong to those that count as 0.
    pub gained: Vec<Gained>,
    /// The motion that belongs to the smallest: what the legs hold least.
    pub weakest: Gained,
    /// Legs, counted from 0, whose drives move with the platform at rest.
    pub serial: Vec<usize>,
}

impl Singular {
    /// The largest singular value of J_x by the smallest; infinite where that counts as 0.
    pub fn condition(&self) -> f64 {
        match (&self.gained[..], self.values.first(), self.values.last()) {
            ([], Some(first), Some(last)) => first / last,
            _ => f64::INFINITY,
        }
    }
}

impl Rates {
    /// Of a platform that moves freely.
    pub(crate) fn in_space(
        rows: Vec<[f64; 6]>,
        drives: Vec<f64>,
        most: Vec<f64>,
        length: f64,
        origin: Vector<f64>,
    ) -> Self {
        let platform = rows.iter().map(|r| r.to_vec()).collect();
        Rates { motion: Motion::Space, platform, drives, most, length, origin }
    }

    /// Of a platform that keeps its orientation.
    pub(crate) fn of_translation(
        rows: Vec<[f64; 3]>,
        drives: Vec<f64>,
        most: Vec<f64>,
        origin: Vector<f64>,
    ) -> Self {
        let platform = rows.iter().map(|r| r.to_vec()).collect();
        Rates { motion: Motion::Translation, platform, drives, most, length: 1.0, origin }
    }

    /// Of a platform in the plane.
    pub(crate) fn in_plane(
        rows: Vec<[f64; 3]>,
        drives: Vec<f64>,
        most: Vec<f64>,
        length: f64,
        origin: Vector<f64>,
    ) -> Self {
        let platform = rows.iter().map(|r| r.to_vec()).collect();
        Rates { motion: Motion::Plane, platform, drives, most, length, origin }
    }

    /// The entry of ẋ from which on it turns.
    fn first_turn(&self) -> usize {
        match self.motion {
            Motion::Space | Motion::Translation => 3,
            Motion::Plane => 2,
        }
    }

    /// What is singular here, and by how much it is not.
    pub fn singular(&self) -> Singular {
        let n = self.platform.len();
        // A platform that is one point turns by no length of its own.
        let length = if self.length > 0.0 { self.length } else { 1.0 };
        let unit = |k: usize| if k < self.first_turn() { 1.0 } else { length };
        let column = |k: usize| {
            let mut column = [0.0; 6];
            self.platform.iter().enumerate().for_each(|(i, row)| column[i] = row[k] / unit(k));
            column
        };
        let found = svd((0..n).map(column).collect());
        let gained = |v: &Vec<f64>| {
            let x: Vec<f64> = v.iter().enumerate().map(|(k, x)| x / unit(k)).collect();
            self.motion_of(&x, length)
        };
        let least = RANK * found.values[0];
        let rank = found.values.iter().filter(|&&v| v > least).count();
        let serial = |&i: &usize| self.drives[i].abs() <= RANK * self.most[i];
        Singular {
            gained: found.vectors[rank..].iter().map(gained).collect(),
            weakest: gained(&found.vectors[n - 1]),
            serial: (0..n).filter(serial).collect(),
            values: found.values,
        }
    }

    /// A velocity of the platform as a motion.
    fn motion_of(&self, x: &[f64], length: f64) -> Gained {
        let (v, w) = match self.motion {
            Motion::Space => (Vector([x[0], x[1], x[2]]), Vector([x[3], x[4], x[5]])),
            Motion::Translation => (Vector([x[0], x[1], x[2]]), Vector::zero()),
            Motion::Plane => (Vector([x[0], x[1], 0.0]), Vector([0.0, 0.0, x[2]])),
        };
        let turn = w.norm();
        if turn * length <= 1e-9 * v.norm() {
            return Gained::Translation(v.scale(1.0 / v.norm()));
        }
        let point = self.origin + w.cross(v).scale(1.0 / (turn * turn));
        Gained::Screw { axis: w.scale(1.0 / turn), point, pitch: w.dot(v) / (turn * turn) }
    }

    /// J = J_x⁻¹ J_q by rows, so that ẋ = J q̇; nothing where a motion is gained.
    pub fn forward(&self) -> Option<Vec<Vec<f64>>> {
        if !self.singular().gained.is_empty() {
            return None;
        }
        let n = self.platform.len();
        let columns: Vec<[f64; 6]> = (0..n)
            .map(|k| {
                let mut column = [0.0; 6];
                self.platform.iter().enumerate().for_each(|(i, row)| column[i] = row[k]);
                column
            })
            .collect();
        let found = svd(columns);
        let solved: Vec<Vec<f64>> = (0..n)
            .map(|j| {
                let mut e = [0.0; 6];
                e[j] = self.drives[j];
                found.solve(&e, n)
            })
            .collect();
        Some((0..n).map(|k| solved.iter().map(|column| column[k]).collect()).collect())
    }
}
