//! Parallel robots: what `show`, `fk`, `ik` and `jacobian` say of them.

mod fk;
mod ik;
mod jacobian;
mod show;

pub use fk::run as fk;
pub use ik::run as ik;
pub use jacobian::run as jacobian;
pub use show::run as show;

use crate::commands::fk::{plural, value};
use crate::failure::Failure;
use crate::load;
use crate::terminal::note;
use denavit::description::parallel::{Family, Parallel, Place};
use denavit::description::{JointKind, Measure, MissingValue};
use denavit::geometry::Transform;
use denavit::quantity::reading;
use denavit_parallel::Robot;
use denavit_parallel::delta::OutOfReach;

/// A parallel robot in numbers.
struct Numbers<'a> {
    of: &'a Parallel,
    robot: Robot,
    /// One pair a drive, or none.
    limits: Vec<[f64; 2]>,
}

/// Where the drives are.
struct At {
    q: Vec<f64>,
    /// The pose that they were taken from, and what it is called.
    pose: Option<(String, Transform<f64>)>,
}

impl<'a> Numbers<'a> {
    fn new(of: &'a Parallel, name: &str) -> Result<Self, Failure> {
        let without = |missing: MissingValue| {
            let settings: Vec<String> =
                missing.parameters.iter().map(|p| format!("--set {p}=450mm")).collect();
            Failure::Input(format!(
                "error: {name}: {missing}\n  = hint: give values, as in {}",
                settings.join(" ")
            ))
        };
        let family = of.numbers().map_err(without)?;
        let number = |e| of.number(e).unwrap_or(f64::NAN);
        let mut limits: Vec<[f64; 2]> = of.limits.iter().map(|l| l.map(number)).collect();
        if let [all] = limits[..] {
            limits = vec![all; of.family.drives()];
        }
        Ok(Numbers { of, robot: Robot::from(&family), limits })
    }

    fn kind(&self) -> JointKind {
        match self.of.family.measure() {
            Measure::Angle => JointKind::Revolute,
            _ => JointKind::Prismatic,
        }
    }

    fn names(&self) -> Vec<String> {
        (0..self.of.family.drives()).map(|k| self.of.family.drive_name(k)).collect()
    }

    /// `l1 = 1 m, l2 = …`
    fn at(&self, q: &[f64]) -> String {
        let one = |(name, &x): (String, &f64)| format!("{name} = {}", reading(x, self.kind()));
        self.names().into_iter().zip(q).map(one).collect::<Vec<_>>().join(", ")
    }

    /// Whether drives are within their limits, where there are some.
    fn within(&self, q: &[f64]) -> Option<bool> {
        let is_within = |(l, x): (&[f64; 2], &f64)| (l[0]..=l[1]).contains(x);
        (!self.limits.is_empty()).then(|| self.limits.iter().zip(q).all(is_within))
    }

    /// Says which drives are beyond their limits.
    fn warn_of_limits(&self, q: &[f64]) {
        for ((name, limits), &x) in self.names().iter().zip(&self.limits).zip(q) {
            if !(limits[0]..=limits[1]).contains(&x) {
                let [x, low, high] = [x, limits[0], limits[1]].map(|x| reading(x, self.kind()));
                note(&format!("warning: {name} = {x} is outside its limits {low} … {high}"));
            }
        }
    }

    /// The drives: a pose of the file, values of all, or each by its name.
    fn configuration(&self, text: Option<&str>) -> Result<At, Failure> {
        let at = self.given(text)?;
        let negative = at.q.iter().position(|&l| l < 0.0);
        match (negative, &self.of.family) {
            (Some(k), Family::Stewart { .. }) => {
                Err(Failure::Usage(format!("-q: {}: the length of a leg is not negative", self.names()[k])))
            }
            _ => Ok(at),
        }
    }

    fn given(&self, text: Option<&str>) -> Result<At, Failure> {
        let bad = |why: String| Failure::Usage(format!("-q: {why}"));
        let (names, count) = (self.names(), self.of.family.drives());
        let Some(text) = text else {
            let poses = match &self.of.poses[..] {
                [] => String::new(),
                all => format!(
                    ", or a pose by name: {}",
                    all.iter().map(|p| p.0.as_str()).collect::<Vec<_>>().join(", ")
                ),
            };
            return Err(Failure::Usage(format!(
                "say where the drives are: -q with {} ({}){poses}",
                plural(count, "value"),
                names.join(", ")
            )));
        };
        let number = |e| self.of.number(e).unwrap_or(f64::NAN);
        if let Some((name, place)) = self.of.poses.iter().find(|p| p.0 == text.trim()) {
            return match place {
                Place::Drives(q) => Ok(At { q: q.iter().map(|&e| number(e)).collect(), pose: None }),
                Place::Platform(x) => {
                    let pose = x.map(number);
                    let all = self.robot.inverse(&pose).map_err(|why| no(&why))?;
                    Ok(At { q: all[0].q.clone(), pose: Some((name.clone(), pose)) })
                }
            };
        }
        let one = |k: usize, text: &str| {
            let measure = self.of.family.measure();
            let x = load::value_of(text, measure)
                .and_then(value)
                .map_err(|why| bad(format!("{}: {why}", names[k])))?;
            if measure == Measure::Angle {
                load::note_of_radians(text, &names[k], x);
            }
            Ok(x)
        };
        let parts = load::list(text);
        if parts.len() != count {
            let given = plural(parts.len(), "value");
            return Err(bad(format!("{given} given, the robot has {count} drives ({})", names.join(", "))));
        }
        if !text.contains('=') {
            let q: Result<Vec<f64>, Failure> =
                parts.iter().enumerate().map(|(k, text)| one(k, text)).collect();
            return Ok(At { q: q?, pose: None });
        }
        let mut q = vec![None; count];
        for part in parts {
            let (name, text) =
                part.split_once('=').ok_or_else(|| bad(format!("`{part}`: write NAME=VALUE")))?;
            let k = names.iter().position(|n| n == name.trim());
            let k =
                k.ok_or_else(|| bad(format!("no drive `{}`; there are {}", name.trim(), names.join(", "))))?;
            if q[k].replace(one(k, text.trim())?).is_some() {
                return Err(bad(format!("{} is given twice", names[k])));
            }
        }
        Ok(At { q: q.into_iter().flatten().collect(), pose: None })
    }
}

/// Options that are for chains are refused.
fn refuse(given: &[(bool, &str)]) -> Result<(), Failure> {
    match given.iter().find(|g| g.0) {
        Some((_, option)) => Err(Failure::Unsupported(format!("{option} for parallel robots"))),
        None => Ok(()),
    }
}

fn no(why: &OutOfReach) -> Failure {
    let leg = why.leg + 1;
    Failure::No(match why.metres {
        0.0 => format!("leg {leg} reaches the pose with any angle of its drive: its ends are one point"),
        m => format!("leg {leg} does not reach the pose: it lacks {}", reading(m, JointKind::Prismatic)),
    })
}

/// The equations by which a family is solved.
fn formulas(family: &Family<f64>) -> &'static str {
    match family {
        Family::Stewart { .. } => {
            "  inverse   lᵢ = |p + R bᵢ − aᵢ|\n  \
             forward   g·g + (|aᵢ|² + |bᵢ|² − lᵢ²) e·e − 2 (aᵢ e)·(e bᵢ) + 2 g·(e bᵢ − aᵢ e) = 0, e·g = 0,\n            \
             R by the quaternion e, p = g ē/e·e: up to 40 solutions, by homotopy, each proved by Krawczyk's test\n  \
             rates     l̇ᵢ = sᵢ·v + (R bᵢ × sᵢ)·ω, sᵢ the direction of leg i\n"
        }
        Family::Delta { .. } => {
            "  ends      cᵢ = base uᵢ + s (cos α uᵢ − sin α z), uᵢ = (cos φᵢ, sin φᵢ, 0);\n            \
             turning: s = upper_arm, α = qᵢ; sliding: s = qᵢ, α = slope\n  \
             rods      |p + platform uᵢ − cᵢ| = lower_arm\n  \
             inverse   turning: x cos qᵢ + z sin qᵢ = k, h = ±√(x² + z² − k²): cos qᵢ = (xk + hz)/(x² + z²), sin qᵢ = (zk − hx)/(x² + z²),\n            \
             x along uᵢ and z down from the arm's axis to the end of its rod, k = (x² + z² + arm² − rod²)/(2 arm), rod in the plane of the arm;\n            \
             sliding: qᵢ = w·d ± √(rod² − |w − (w·d) d|²), d along the slide, w to the end of the rod: 8 modes\n  \
             forward   two points of three spheres: p = a + w ± n √((rod² − |w|²)/|n|²), n = u × v, w = (|v|² n × u + |u|² v × n)/(2|n|²),\n            \
             a, a + u, a + v the ends less platform uᵢ\n  \
             rates     rᵢ·v = (rᵢ·∂cᵢ/∂qᵢ) q̇ᵢ, rᵢ the direction of rod i\n"
        }
        Family::Planar3Rrr { .. } => {
            "  elbows    Cᵢ = Aᵢ + proximal e(qᵢ), |p + R bᵢ − Cᵢ| = distal, e(φ) = (cos φ, sin φ)\n  \
             inverse   D = p + R bᵢ − Aᵢ, k = |D|² + proximal² − distal², h = ±√(4 proximal² |D|² − k²): e(qᵢ) = D (k − ih)/(2 proximal |D|²): 8 modes\n  \
             forward   x = p + R b₁ − C₁, dᵢ = R(bᵢ − b₁) − (Cᵢ − C₁), hᵢ = rᵢ² − r₁² − |dᵢ|², δ = Im(d̄₂ d₃):\n            \
             x = i (h₃ d₂ − h₂ d₃)/(2δ), |h₃ d₂ − h₂ d₃|² = 4 r₁² δ²: of degree 6 in tan(φ/2), its real roots counted for sure\n  \
             rates     rᵢ·v + (R bᵢ × rᵢ) ω = (rᵢ·∂Cᵢ/∂qᵢ) q̇ᵢ, rᵢ the direction of the distal link i\n"
        }
    }
}
