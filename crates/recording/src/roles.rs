//! Which columns are the time, the joints and the pose, by their names; by their places where names say nothing.

use crate::arm::Arm;
use crate::recording::{Recording, Roles, Said};
use crate::spelled::{numbered, plain};
use crate::times::{column_of_episodes, column_of_time};

/// What columns are told by hand, as on a command line: names, or `first..last`, with commas.
#[derive(Clone, Default, Debug)]
pub struct Told {
    /// The time.
    pub time: Option<String>,
    /// The joints.
    pub joints: Option<String>,
    /// The position.
    pub position: Option<String>,
    /// The orientation.
    pub rotation: Option<String>,
}

/// What cannot be told.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum RolesError {
    /// There is no column of this name; these are like it.
    NoColumn(String, Vec<String>),
    /// No columns are known to be these: `time`, `joints`, `position`, `rotation` or `torques`; the names that there are.
    Unknown(&'static str, Vec<String>),
}

impl std::fmt::Display for RolesError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let list = |names: &[String]| {
            let more = if names.len() > 24 { ", …" } else { "" };
            format!("{}{more}", names.iter().take(24).cloned().collect::<Vec<_>>().join(", "))
        };
        match self {
            RolesError::NoColumn(name, near) if near.is_empty() => write!(f, "there is no column `{name}`"),
            RolesError::NoColumn(name, near) => {
                write!(f, "there is no column `{name}`; there are {}", list(near))
            }
            RolesError::Unknown(what, names) => {
                let example = match *what {
                    "time" => "--time t, or --rate 500 for rows a second",
                    "torques" => "--torques tau1..tau6",
                    "joints" => "--joints q1,q2,q3 or --joints q1..q6",
                    "position" => "--position x,y,z",
                    _ => "--rotation rx,ry,rz",
                };
                write!(
                    f,
                    "which columns are the {what} is not known by their names: {}\n  = hint: say it with {example}",
                    list(names)
                )
            }
        }
    }
}

impl std::error::Error for RolesError {}

/// Names of a joint before its number.
const JOINTS: &[&str] = &[
    "q",
    "j",
    "a",
    "th",
    "theta",
    "θ",
    "joint",
    "joints",
    "jointposition",
    "jointpositions",
    "jointangle",
    "jointangles",
    "jointpos",
    "jointstate",
    "jointstates",
    "actualq",
    "qactual",
    "measuredq",
    "qmeasured",
    "qpos",
    "robotq",
    "position",
    "positions",
    "state",
    "observationstate",
    "axis",
    "angle",
    "angles",
    "obsjoint",
    "jpos",
    "qmeas",
    "msrjointpos",
];
/// Names of a whole pose before its numbers.
const POSES: &[&str] = &[
    "pose",
    "tcppose",
    "actualtcppose",
    "tcp",
    "eepose",
    "ee",
    "toolpose",
    "ote",
    "otee",
    "handpose",
    "flangepose",
    "x",
    "cartesianpose",
    "cartesianposition",
    "observationpose",
    "observationeepose",
    "eefpose",
    "t",
    "endeffectorpose",
    "endpose",
];

/// Columns told by hand, as names with commas or `first..last`, by their numbers.
///
/// # Errors
/// If there is no such column.
pub fn columns_told(names: &[&str], text: &str) -> Result<Vec<usize>, RolesError> {
    let find = |name: &str| {
        let name = name.trim();
        let exact = names.iter().position(|n| *n == name);
        let loose = || names.iter().position(|n| plain(n) == plain(name) && !plain(name).is_empty());
        exact.or_else(loose).ok_or_else(|| {
            let near = names
                .iter()
                .filter(|n| plain(n).starts_with(&plain(&name.chars().take(1).collect::<String>())));
            let near: Vec<String> = near.map(|n| (*n).to_string()).collect();
            let all = names.iter().map(|n| (*n).to_string()).collect();
            RolesError::NoColumn(name.into(), if near.is_empty() { all } else { near })
        })
    };
    let mut all = vec![];
    for part in text.split(',').filter(|p| !p.trim().is_empty()) {
        match part.split_once("..") {
            Some((first, last)) => {
                let (from, to) = (find(first)?, find(last)?);
                if from <= to { all.extend(from..=to) } else { all.extend((to..=from).rev()) }
            }
            None => all.push(find(part)?),
        }
    }
    Ok(all)
}

impl Roles {
    /// By what is told, and by names and places for the rest.
    ///
    /// # Errors
    /// If a column is not there, or nothing says which columns are meant.
    pub fn find(recording: &Recording, arm: &Arm, by_hand: &Told) -> Result<Self, RolesError> {
        Self::find_parts(recording, arm, by_hand, [true; 2])
    }

    /// As [`Roles::find`] does; whether there have to be a position and an orientation is told.
    ///
    /// # Errors
    /// If a column is not there, or nothing says which columns are meant.
    pub fn find_parts(
        recording: &Recording,
        arm: &Arm,
        by_hand: &Told,
        needed: [bool; 2],
    ) -> Result<Self, RolesError> {
        let all: Vec<&str> = recording.columns.iter().map(|c| c.name.as_str()).collect();
        let by = |text: &Option<String>| text.as_deref().map(|t| columns_told(&all, t)).transpose();
        let (time, joints, position, rotation) =
            (by(&by_hand.time)?, by(&by_hand.joints)?, by(&by_hand.position)?, by(&by_hand.rotation)?);
        let search = Names::of(recording);
        let mut roles = Roles { episode: column_of_episodes(&all), ..Roles::default() };
        roles.time = match time {
            Some(columns) => columns.first().copied(),
            None => {
                let is_said = |k: usize| recording.columns[k].said.is_some_and(Said::is_time);
                column_of_time(&all, is_said)
            }
        };
        let mut taken: Vec<usize> = roles.time.into_iter().chain(roles.episode).collect();
        roles.joints = match joints {
            Some(columns) => columns,
            None => search.joints(arm, &taken).unwrap_or_default(),
        };
        taken.extend(&roles.joints);
        let (found_position, found_rotation) = search.pose(recording, &taken);
        roles.position = position.or(found_position).unwrap_or_default();
        roles.rotation = rotation.or(found_rotation).unwrap_or_default();
        roles.by_places(recording, arm);
        let names = || recording.columns.iter().map(|c| c.name.clone()).collect::<Vec<_>>();
        match () {
            () if roles.joints.is_empty() => Err(RolesError::Unknown("joints", names())),
            () if needed[0] && roles.position.is_empty() => Err(RolesError::Unknown("position", names())),
            () if needed[1] && roles.rotation.is_empty() => Err(RolesError::Unknown("rotation", names())),
            () => Ok(roles),
        }
    }

    /// What names leave open, by the places: the time, the joints, the position, the orientation.
    fn by_places(&mut self, recording: &Recording, arm: &Arm) {
        let n = arm.joints();
        let all = recording.columns.len();
        let nameless = recording
            .columns
            .iter()
            .enumerate()
            .all(|(k, c)| c.name == format!("column {}", k + 1) || c.name.starts_with("column["));
        if !nameless || !self.joints.is_empty() || !self.position.is_empty() || !self.rotation.is_empty() {
            return;
        }
        let rises = |c: usize| {
            let values = &recording.columns[c].values;
            values.windows(2).filter(|w| w[1] > w[0]).count() * 20 > values.len() * 19
        };
        let start = usize::from(all > n + 6 && rises(0));
        let rest = all.saturating_sub(start + n + 3);
        if ![3, 4, 6, 9].contains(&rest) {
            return;
        }
        self.time = (start == 1).then_some(0);
        self.joints = (start..start + n).collect();
        self.position = (start + n..start + n + 3).collect();
        self.rotation = (start + n + 3..all).collect();
    }
}

/// The names of all columns, plain, and in groups that are numbered.
struct Names {
    plain: Vec<String>,
    /// A name, and the columns with its numbers in order.
    groups: Vec<(String, Vec<usize>)>,
}

impl Names {
    fn of(recording: &Recording) -> Self {
        let mut groups: Vec<(String, Vec<(usize, usize)>)> = vec![];
        for (k, c) in recording.columns.iter().enumerate() {
            if let Some((stem, number)) = numbered(&c.name) {
                match groups.iter_mut().find(|g| g.0 == stem) {
                    Some(g) => g.1.push((number, k)),
                    None => groups.push((stem, vec![(number, k)])),
                }
            }
        }
        let sorted = |(stem, mut members): (String, Vec<(usize, usize)>)| {
            members.sort_unstable();
            (stem, members.into_iter().map(|m| m.1).collect())
        };
        Names {
            plain: recording.columns.iter().map(|c| plain(&c.name)).collect(),
            groups: groups.into_iter().map(sorted).collect(),
        }
    }

    /// The joints: by the arm's own names, or numbered.
    fn joints(&self, arm: &Arm, taken: &[usize]) -> Option<Vec<usize>> {
        let n = arm.joints();
        for names in [&arm.joint_names, &arm.names] {
            let find = |name: &String| {
                let name = plain(name);
                let ends =
                    [name.clone(), format!("{name}pos"), format!("{name}position"), format!("joint{name}")];
                let is = |p: &&String| ends.contains(*p);
                let exact = self.plain.iter().position(|p| is(&p));
                exact.or_else(|| {
                    self.plain.iter().position(|p| {
                        p.ends_with(&format!("state{name}pos")) || p.ends_with(&format!("position{name}"))
                    })
                })
            };
            let found: Option<Vec<usize>> = names.iter().map(find).collect();
            if let Some(found) = found.filter(|f| f.iter().all(|k| !taken.contains(k)) && !f.is_empty()) {
                return Some(found);
            }
        }
        let is_known = |g: &&(String, Vec<usize>)| {
            let stem = g.0.trim_start_matches("actual").trim_start_matches("robot0");
            (JOINTS.contains(&g.0.as_str()) || JOINTS.contains(&stem)) && (n..=n + 3).contains(&g.1.len())
        };
        // The one whose name comes first in the list, with as many as there are joints if one has.
        let rank = |g: &&(String, Vec<usize>)| {
            (g.1.len() != n, JOINTS.iter().position(|j| *j == g.0).unwrap_or(JOINTS.len()))
        };
        self.groups.iter().filter(is_known).min_by_key(rank).map(|g| g.1.clone())
    }

    /// Position and orientation.
    fn pose(&self, recording: &Recording, taken: &[usize]) -> (Option<Vec<usize>>, Option<Vec<usize>>) {
        let of_pose = |g: &&(String, Vec<usize>)| {
            POSES.contains(&g.0.as_str())
                && [6, 7, 9, 12, 16].contains(&g.1.len())
                && g.1.iter().all(|k| !taken.contains(k))
        };
        if let Some((_, c)) = self.groups.iter().find(of_pose) {
            let pick = |places: &[usize]| places.iter().map(|&k| c[k]).collect::<Vec<_>>();
            // The last row of a matrix is 0, 0, 0, 1.
            let is_last = |places: [usize; 4]| {
                let values = places.map(|k| recording.columns[c[k]].values.first().copied().unwrap_or(0.0));
                values == [0.0, 0.0, 0.0, 1.0]
            };
            let (position, rotation) = match c.len() {
                12 => (pick(&[3, 7, 11]), pick(&[0, 1, 2, 4, 5, 6, 8, 9, 10])),
                16 if is_last([3, 7, 11, 15]) => (pick(&[12, 13, 14]), pick(&[0, 4, 8, 1, 5, 9, 2, 6, 10])),
                16 => (pick(&[3, 7, 11]), pick(&[0, 1, 2, 4, 5, 6, 8, 9, 10])),
                _ => (c[..3].to_vec(), c[3..].to_vec()),
            };
            return (Some(position), Some(rotation));
        }
        let position = self.family(
            taken,
            &["x", "y", "z"],
            &["", "p", "t", "pos", "tcp", "position", "translation", "tool", "ee", "hand"],
        );
        let rotation = [
            &["qx", "qy", "qz", "qw"][..],
            &["qw", "qx", "qy", "qz"],
            &["quatx", "quaty", "quatz", "quatw"],
            &["orientationx", "orientationy", "orientationz", "orientationw"],
            &["rotationx", "rotationy", "rotationz", "rotationw"],
            &["rx", "ry", "rz"],
            &["roll", "pitch", "yaw"],
            &["rotvecx", "rotvecy", "rotvecz"],
            &["rotx", "roty", "rotz"],
            &["wx", "wy", "wz"],
            &["w", "p", "r"],
            &["phi", "theta", "psi"],
            &["alpha", "beta", "gamma"],
            &["ax", "ay", "az"],
            &["a", "b", "c"],
            &["r11", "r12", "r13", "r21", "r22", "r23", "r31", "r32", "r33"],
        ]
        .into_iter()
        .find_map(|names| self.family(taken, names, &[""]));
        let numbered = || {
            let stems = [
                "r",
                "rot",
                "rotation",
                "quat",
                "quaternion",
                "orientation",
                "o",
                "rotvec",
                "rpy",
                "rot6d",
                "euler",
                "rotmat",
            ];
            let is = |g: &&(String, Vec<usize>)| {
                stems.iter().any(|s| g.0.ends_with(s) && g.0.len() <= s.len() + 12)
                    && [3, 4, 6, 9].contains(&g.1.len())
                    && g.1.iter().all(|k| !taken.contains(k))
            };
            self.groups.iter().find(is).map(|g| g.1.clone())
        };
        let placed = || {
            let stems =
                ["p", "pos", "position", "translation", "tcppos", "eepos", "xyz", "eefpos", "robot0eefpos"];
            let is = |g: &&(String, Vec<usize>)| {
                stems.contains(&g.0.as_str()) && g.1.len() == 3 && g.1.iter().all(|k| !taken.contains(k))
            };
            self.groups.iter().find(is).map(|g| g.1.clone())
        };
        (position.or_else(placed), rotation.or_else(numbered))
    }

    /// Columns whose names end so, all with the same beginning: one of these, or any other.
    fn family(&self, taken: &[usize], ends: &[&str], beginnings: &[&str]) -> Option<Vec<usize>> {
        let of = |stem: &str| -> Option<Vec<usize>> {
            let find = |end: &&str| {
                let name = format!("{stem}{end}");
                self.plain.iter().enumerate().position(|(k, p)| *p == name && !taken.contains(&k))
            };
            ends.iter().map(find).collect::<Option<Vec<_>>>().map(|mut found| {
                // Of four as they stand: which is w is for the search to say.
                if found.len() == 4 {
                    found.sort_unstable();
                }
                found
            })
        };
        let first = beginnings.iter().find_map(|b| of(b));
        first.or_else(|| {
            let stems = self.plain.iter().filter_map(|p| p.strip_suffix(ends[0])).filter(|s| s.len() > 1);
            stems.filter(|s| !s.ends_with("velocity") && !s.ends_with("force")).find_map(of)
        })
    }
}
