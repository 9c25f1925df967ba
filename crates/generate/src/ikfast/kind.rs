//! IKFast's types of goals.

use denavit::inverse::{Goal, InverseModel, Task};
use denavit::robot::Robot;

/// How far an entry of a rotation may be from what it is always.
const SAME: f64 = 1e-12;
/// Configurations at which that is looked at.
const CONFIGURATIONS: usize = 8;

/// What a goal is.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Kind {
    /// A position and a rotation.
    Transform,
    /// A position.
    Translation,
    /// A position and the direction of z of the tool.
    Direction,
    /// A position and the angle of an axis of the tool about an axis of the base, x, y or z as 0, 1 or 2, to which it is
    /// orthogonal: x about z, y about x, z about y. With the rotation at an angle of 0.
    Turn(usize, [[f64; 3]; 3]),
}

impl Kind {
    /// The type for what an inverse model is given.
    ///
    /// # Errors
    /// If IKFast has none, in words.
    pub fn of(model: &InverseModel, robot: &Robot<f64>) -> Result<Self, String> {
        let hint = match model.task {
            Task::PositionAndAxis => "; --goal position-axis asks for what it can (TranslationDirection5D)",
            Task::Position => "; --goal position asks for what it can (Translation3D)",
            Task::Pose | Task::PositionAndTurn | Task::Planar | Task::Orientation | Task::Other(_) => "",
        };
        let too_few = |wanted: &str| {
            let directions = model.rank;
            format!("IKFast's {wanted}, and this arm moves its hand in {directions} directions{hint}")
        };
        match (model.goal, model.rank) {
            (Goal::Pose, 6) => Ok(Kind::Transform),
            (Goal::Position, 3) => Ok(Kind::Translation),
            (Goal::PositionAndAxis, 5) => Ok(Kind::Direction),
            (Goal::Pose, _) if model.task == Task::PositionAndTurn => turn(robot).ok_or_else(|| {
                "IKFast's types with one angle are of x of the tool about z of the base, y about x, or z about y, each orthogonal to \
                 the other, and this arm turns its hand otherwise"
                    .into()
            }),
            (Goal::Pose, _) => Err(too_few("Transform6D takes six directions")),
            (Goal::Position, _) => Err(too_few("Translation3D takes three directions")),
            (Goal::PositionAndAxis, _) => Err(too_few("TranslationDirection5D takes five directions")),
        }
    }

    /// Its name and its number.
    fn names(&self) -> [&'static str; 2] {
        match self {
            Kind::Transform => ["Transform6D", "0x67000001"],
            Kind::Translation => ["Translation3D", "0x33000003"],
            Kind::Direction => ["TranslationDirection5D", "0x56000007"],
            Kind::Turn(2, _) => ["TranslationXAxisAngleZNorm4D", "0x4400000e"],
            Kind::Turn(0, _) => ["TranslationYAxisAngleXNorm4D", "0x4400000f"],
            Kind::Turn(..) => ["TranslationZAxisAngleYNorm4D", "0x44000010"],
        }
    }

    pub fn name(&self) -> &'static str {
        self.names()[0]
    }

    pub fn number(&self) -> &'static str {
        self.names()[1]
    }

    /// How many numbers the inverse function takes of the hand.
    pub fn numbers(&self) -> usize {
        match self {
            Kind::Transform | Kind::Turn(..) => 12,
            Kind::Translation => 3,
            Kind::Direction => 6,
        }
    }

    /// How many numbers stand in `eerot`.
    pub fn rotation_numbers(&self) -> usize {
        match self {
            Kind::Transform => 9,
            Kind::Translation => 0,
            Kind::Direction => 3,
            Kind::Turn(..) => 1,
        }
    }

    /// The columns of the pose that it is about.
    pub fn columns(&self) -> [bool; 4] {
        match self {
            Kind::Transform | Kind::Turn(..) => [true; 4],
            Kind::Translation => [false, false, false, true],
            Kind::Direction => [false, false, true, true],
        }
    }

    /// What stands in the arrays of the interface.
    pub fn about(&self, [to, from]: &[String; 2]) -> String {
        let position = format!("eetrans: the position of the origin of {to} in {from} (m)");
        match self {
            Kind::Transform => format!("{position}. eerot: its rotation there, row by row."),
            Kind::Translation => format!("{position}. eerot is not looked at."),
            Kind::Direction => {
                format!(
                    "{position}. eerot: the direction of its z axis there, 3 numbers, of any length but 0."
                )
            }
            Kind::Turn(u, _) => {
                let [v, u, w] = [(u + 1) % 3, *u, (u + 2) % 3].map(|k| ["x", "y", "z"][k]);
                format!(
                    "{position}. eerot: 1 number, the angle (rad) from {v} of {from} to its own {v} axis about {u} of {from}, \
                     counted towards {w}. The arm keeps the two axes orthogonal."
                )
            }
        }
    }

    /// How goals are read and written.
    pub fn code(&self) -> String {
        match self {
            Kind::Transform => include_str!("transform.cpp").into(),
            Kind::Translation => include_str!("translation.cpp").into(),
            Kind::Direction => include_str!("direction.cpp").into(),
            Kind::Turn(u, at_zero) => {
                let rows: Vec<String> = at_zero
                    .iter()
                    .map(|row| format!("    {{{:?}, {:?}, {:?}}}", row[0], row[1], row[2]))
                    .collect();
                include_str!("turn.cpp")
                    .replace("@at_zero@", &format!("\n{}\n", rows.join(",\n")))
                    .replace("@u@", &u.to_string())
                    .replace("@v@", &((u + 1) % 3).to_string())
                    .replace("@w@", &((u + 2) % 3).to_string())
            }
        }
    }

    /// How the arguments of the program become a goal.
    pub fn arguments(&self) -> &'static str {
        match self {
            Kind::Transform => {
                "    for (int k = 0; k < 12; k++) {
        const IkReal value = static_cast<IkReal>(std::atof(words[1 + k]));
        (k % 4 == 3 ? eetrans[k / 4] : eerot[3 * (k / 4) + k % 4]) = value;
    }
"
            }
            Kind::Translation | Kind::Direction | Kind::Turn(..) => {
                "    for (int k = 0; k < 3 + @rotation_count@; k++) {
        const IkReal value = static_cast<IkReal>(std::atof(words[1 + k]));
        (k < @rotation_count@ ? eerot[k] : eetrans[k - @rotation_count@]) = value;
    }
"
            }
        }
    }

    /// The arguments of the program in words.
    pub fn usage(&self, given: usize) -> String {
        let mut words = match self {
            Kind::Transform => "r00 r01 r02 t0 r10 r11 r12 t1 r20 r21 r22 t2".to_string(),
            Kind::Translation => "t0 t1 t2".into(),
            Kind::Direction => "d0 d1 d2 t0 t1 t2".into(),
            Kind::Turn(..) => "angle t0 t1 t2".into(),
        };
        (0..given).for_each(|k| words += &format!(" free{k}"));
        words
    }

    /// A pose, rows 1 to 3, as `eetrans` and `eerot`.
    pub fn goal(&self, rows: &[[f64; 4]; 3]) -> Vec<f64> {
        let mut goal = rows.map(|row| row[3]).to_vec();
        match self {
            Kind::Transform => goal.extend(rows.iter().flat_map(|row| &row[..3])),
            Kind::Translation => {}
            Kind::Direction => goal.extend(rows.map(|row| row[2])),
            Kind::Turn(u, _) => {
                let (v, w) = ((u + 1) % 3, (u + 2) % 3);
                goal.push(rows[w][v].atan2(rows[v][v]));
            }
        }
        goal
    }

    /// Whether a pose is what its goal stands for: no rotation that the arm does not have.
    pub fn stands_for(&self, rows: &[[f64; 4]; 3]) -> bool {
        let Kind::Turn(u, at_zero) = self else { return true };
        let (v, w) = ((u + 1) % 3, (u + 2) % 3);
        let (s, c) = self.goal(rows)[3].sin_cos();
        let meant = |i: usize, k: usize| match i {
            i if i == v => c * at_zero[v][k] - s * at_zero[w][k],
            i if i == w => s * at_zero[v][k] + c * at_zero[w][k],
            _ => at_zero[i][k],
        };
        (0..3).all(|i| (0..3).all(|k| (rows[i][k] - meant(i, k)).abs() <= 1e-15))
    }
}

/// The axis of the base about which the hand turns, if the arm turns about one, with an axis of the tool orthogonal to it.
fn turn(robot: &Robot<f64>) -> Option<Kind> {
    let rotation = |k: usize| {
        let q: Vec<f64> = (0..robot.joints)
            .map(|j| if k == 0 { 0.0 } else { ((7 * k + 3 * j) % 19) as f64 * 0.31 - 2.5 })
            .collect();
        robot.pose(&q).rotation.rows()
    };
    let first = rotation(0);
    let keeps = |u: usize, r: &[[f64; 3]; 3]| (0..3).all(|k| (r[u][k] - first[u][k]).abs() <= SAME);
    let u = (0..3).find(|&u| {
        first[u][(u + 1) % 3].abs() <= SAME && (1..CONFIGURATIONS).all(|k| keeps(u, &rotation(k)))
    })?;
    // R = turn(u, angle) R₀: back by the angle of the first configuration.
    let (v, w) = ((u + 1) % 3, (u + 2) % 3);
    let (s, c) = first[w][v].atan2(first[v][v]).sin_cos();
    let mut at_zero = first;
    for k in 0..3 {
        at_zero[v][k] = c * first[v][k] + s * first[w][k];
        at_zero[w][k] = c * first[w][k] - s * first[v][k];
    }
    Some(Kind::Turn(u, at_zero))
}
