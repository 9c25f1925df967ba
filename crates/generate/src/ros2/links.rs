//! The links of a chain by name: on which frame of its table each stands.

use denavit::description::{Chain, Description, Mechanism, MissingValue};
use denavit::geometry::Transform;
use denavit::random::Random;
use denavit::robot::Robot;

/// Names of joints and links, and where the links stand.
#[derive(Clone, PartialEq, Debug)]
pub struct Links {
    /// The link that poses are given in.
    pub base: String,
    /// The link whose pose is to be met.
    pub tip: String,
    /// Names of the joint variables, in order.
    pub joints: Vec<String>,
    /// The links that the joints move, and those fixed to them and to the base.
    pub links: Vec<Link>,
    /// The planning group, if it has a name.
    pub group: Option<String>,
}

/// A link that stands still on a frame of the table.
#[derive(Clone, PartialEq, Debug)]
pub struct Link {
    /// Its name.
    pub name: String,
    /// The frame, 0 for that before the first row.
    pub frame: usize,
    /// Where it stands on the frame, the first three rows of the matrix.
    pub on_frame: [[f64; 4]; 3],
    /// Values of the joint variables, and its pose in the base there as the tree of bodies has it.
    pub known: Vec<(Vec<f64>, [[f64; 4]; 3])>,
}

/// A configuration: the joint variables, and in the base the frames of the table and the bodies.
struct Tried {
    q: Vec<f64>,
    frames: Vec<Transform<f64>>,
    bodies: Vec<Transform<f64>>,
}

/// How many configurations tell whether a link stands still on a frame, and how many of them are kept.
const TRIED: usize = 5;
const KEPT: usize = 2;
/// By how much a link may move on its frame for rounding: entries of rotations, and lengths by the size of the robot.
const STILL: f64 = 1e-10;

impl Links {
    /// The links of a chain through a tree of bodies, those off the chain among them that are fixed to links of it. `description` is the
    /// table of the chain, with values for its parameters.
    ///
    /// # Errors
    /// If a parameter has no value.
    pub fn new(m: &Mechanism, chain: &Chain, description: &Description) -> Result<Self, MissingValue> {
        // As the functions in C have it.
        let robot = Robot::numeric(&description.made_rigid().0)?;
        let mut random = Random(7);
        let variables = m.variables();
        let placing = m.placing();
        let tried: Vec<Tried> = (0..TRIED)
            .map(|_| {
                let q: Vec<f64> = (0..robot.joints).map(|_| 2.0 * random.unit() - 1.0).collect();
                let mut all: Vec<f64> = variables.iter().map(|_| 2.0 * random.unit() - 1.0).collect();
                for (&j, &x) in chain.joints.iter().zip(&q) {
                    let (own, value) = leader(m, j, x);
                    if let Some(k) = variables.iter().position(|&v| v == own) {
                        all[k] = value;
                    }
                }
                let poses = placing.poses(&all);
                let back = poses[chain.from].inverse();
                let bodies = poses.iter().map(|x| back * *x).collect();
                let frames = robot.frames(&q);
                Tried { q, frames, bodies }
            })
            .collect();
        let lengths = tried.iter().flat_map(|t| t.frames.iter().chain(&t.bodies));
        let size = lengths.map(|x| x.translation.norm()).fold(1e-3, f64::max);
        let links = (0..m.bodies.len()).filter_map(|b| {
            let on = |k: usize, t: usize| tried[t].frames[k].inverse() * tried[t].bodies[b];
            let is_still = |&k: &usize| (1..TRIED).all(|t| apart(&on(k, 0), &on(k, t), size) <= STILL);
            let frame = (0..=robot.links.len()).find(is_still)?;
            let known = tried.iter().take(KEPT).map(|t| (t.q.clone(), rows(&t.bodies[b])));
            Some(Link {
                name: m.bodies[b].name.clone(),
                frame,
                on_frame: rows(&on(frame, 0)),
                known: known.collect(),
            })
        });
        Ok(Links {
            base: m.bodies[chain.from].name.clone(),
            tip: m.bodies[chain.to].name.clone(),
            joints: chain.joints.iter().map(|&j| m.joints[j].name.clone()).collect(),
            links: links.collect(),
            group: None,
        })
    }
}

/// The joint that moves by itself where a joint has a value, and its own value there.
fn leader(m: &Mechanism, joint: usize, value: f64) -> (usize, f64) {
    match &m.joints[joint].follows {
        Some(follows) => {
            let offset = follows.offset.eval(|_| None).unwrap_or(0.0);
            (follows.joint, (value - offset) / follows.factor.to_f64())
        }
        None => (joint, value),
    }
}

/// The largest difference of an entry, lengths by a size.
fn apart(a: &Transform<f64>, b: &Transform<f64>, size: f64) -> f64 {
    let entries = |x: &Transform<f64>| {
        let unit = |k: usize| if k == 3 { 1.0 / size } else { 1.0 };
        rows(x).map(|row| std::array::from_fn::<f64, 4, _>(|k| row[k] * unit(k)))
    };
    let pairs = entries(a).into_iter().flatten().zip(entries(b).into_iter().flatten());
    pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

/// The first three rows of the matrix.
fn rows(x: &Transform<f64>) -> [[f64; 4]; 3] {
    let [a, b, c, _] = x.matrix();
    [a, b, c]
}
