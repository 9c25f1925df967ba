//! Inverse kinematics: all solutions of the same poses by everybody, in units of `ik-geo` timed in the same round.
//!
//! Before anything is timed, every answer is put into the forward model; how many solutions a pose has must be the
//! same for all.

use crate::measure::{Entry, measure, nanoseconds};
use crate::peers::inverse::{Family, Geo, Opw};
use crate::{compiled, read};
use anyhow::{Result, ensure};
use denavit::inverse::{InverseModel, InverseOptions, variables};
use denavit::{Description, Robot};
use denavit_jit::MachineSolver;
use denavit_program::solver::{Leaves, Solutions, TOLERANCE};
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::hint::black_box;
use std::rc::Rc;

/// Poses of each arm.
pub const POSES: usize = 1024;
/// An answer that misses the pose by more, in metres or in an entry of the rotation, is none.
pub const VALID: f64 = 1e-6;
/// Answers of a pose that differ by less are one.
const SAME: f64 = 1e-6;

/// The first three rows of a pose, row by row.
pub type Rows = [f64; 12];
/// Joint variables.
pub type Joints = [f64; 6];

/// Somebody who solves poses.
pub struct Contestant {
    pub name: String,
    pub limit: Option<f64>,
    /// All answers for all poses.
    pub answers: Vec<Vec<Joints>>,
    /// Solves all poses, for the clock.
    pub run: Box<dyn FnMut()>,
}

/// Measures both arms; prints one JSON object.
///
/// # Errors
/// If an arm cannot be read, or somebody's answers are not those of the others.
pub fn run(mut random: impl FnMut() -> f64) -> Result<()> {
    let arms = [
        arm("ur5", "UR5", compiled::inverse::ur5, &mut random)?,
        arm(
            "abb-irb2400-10",
            "ABB IRB 2400/10, a spherical wrist with offsets at shoulder and elbow",
            compiled::inverse::irb2400,
            &mut random,
        )?,
    ];
    println!("{}", json!({"arms": arms, "poses": POSES}));
    Ok(())
}

/// What generated code is there for an arm.
type Generated = fn(&Rc<Vec<Rows>>) -> Vec<Contestant>;

fn arm(name: &str, title: &str, generated: Generated, random: &mut impl FnMut() -> f64) -> Result<Value> {
    let description = read(name)?;
    let robot = Robot::numeric(&description)?;
    let drawn: Vec<Joints> = (0..POSES).map(|_| std::array::from_fn(|_| random())).collect();
    let rows = |q: &Joints| -> Rows {
        let pose = variables(denavit::inverse::Goal::Pose, &robot.pose(q), &[]);
        pose.try_into().expect("three rows of four")
    };
    let poses: Rc<Vec<Rows>> = Rc::new(drawn.iter().map(rows).collect());
    let family = if name == "ur5" { Family::ThreeParallel } else { Family::Wrist };
    let geo = Geo::new(&robot, family);
    let mut contestants = vec![geo.contestant(&poses)];
    if name == "abb-irb2400-10" {
        contestants.push(Opw::new(&robot)?.contestant(&poses));
    }
    contestants.extend(generated(&poses));
    contestants.extend(evaluators(&description, &poses)?);
    let mut counts: Option<Vec<usize>> = None;
    let mut checks = vec![];
    for c in &contestants {
        let check = Check::new(&c.answers, &poses, &drawn, rows);
        checks.push(json!({
            "name": c.name, "solutions": check.distinct.iter().sum::<usize>() as f64 / POSES as f64,
            "returned": check.returned as f64 / POSES as f64, "worst": check.worst,
            "drawn_found": check.drawn_found,
        }));
        ensure!(
            check.drawn_found == POSES,
            "{}: finds {} of {POSES} drawn configurations",
            c.name,
            check.drawn_found
        );
        let first = counts.get_or_insert_with(|| check.distinct.clone());
        let others = first.iter().zip(&check.distinct).filter(|(a, b)| a != b).count();
        ensure!(others == 0, "{title}: {} has another number of solutions for {others} poses", c.name);
    }
    let mut unit = geo.runner(&poses);
    let (ns, figures) = measure(&mut entries(contestants), || nanoseconds(&mut unit) / POSES as f64);
    let figures: Vec<Value> = figures.iter().map(|f| f.json()).collect();
    Ok(json!({"name": name, "title": title, "unit_ns": ns, "checks": checks, "figures": figures}))
}

fn entries(contestants: Vec<Contestant>) -> Vec<Entry<'static>> {
    let entry = |c: Contestant| Entry { group: "", name: c.name, items: POSES, limit: c.limit, run: c.run };
    contestants.into_iter().map(entry).collect()
}

/// What somebody's answers are worth.
pub struct Check {
    pub returned: usize,
    /// Distinct valid answers of each pose.
    pub distinct: Vec<usize>,
    /// How far a valid answer misses its pose at most.
    pub worst: f64,
    /// For how many poses the configuration that it was made from is among the answers.
    pub drawn_found: usize,
}

impl Check {
    pub fn new(
        answers: &[Vec<Joints>],
        poses: &[Rows],
        drawn: &[Joints],
        forward: impl Fn(&Joints) -> Rows,
    ) -> Self {
        let mut check = Check { returned: 0, distinct: vec![], worst: 0.0, drawn_found: 0 };
        for ((answers, pose), q) in answers.iter().zip(poses).zip(drawn) {
            check.returned += answers.len();
            let mut kept: Vec<Joints> = vec![];
            for answer in answers {
                let found = forward(answer);
                let miss = found.iter().zip(pose).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                if miss <= VALID {
                    check.worst = check.worst.max(miss);
                    if kept.iter().all(|k| apart(k, answer) > SAME) {
                        kept.push(*answer);
                    }
                }
            }
            check.drawn_found += usize::from(kept.iter().any(|k| apart(k, q) <= 1e-5));
            check.distinct.push(kept.len());
        }
        check
    }
}

fn apart(a: &Joints, b: &Joints) -> f64 {
    let turn = |d: f64| (d - TAU * (d / TAU).round()).abs();
    a.iter().zip(b).map(|(x, y)| turn(x - y)).fold(0.0, f64::max)
}

/// The interpreters and machine code.
fn evaluators(description: &Description, poses: &Rc<Vec<Rows>>) -> Result<Vec<Contestant>> {
    let model =
        InverseModel::derive(description, &InverseOptions::default()).map_err(|e| anyhow::anyhow!("{e}"))?;
    let solver = model.solver(description)?;
    let function = solver.function().clone();
    let good = |leaves: &Leaves| -> Vec<Joints> {
        let solutions = leaves.iter().filter(|l| l.residual <= TOLERANCE);
        solutions.map(|l| l.outputs.try_into().expect("six joints")).collect()
    };
    let mut all = vec![];
    let (mut scalar, given) = (function.scalar(), poses.clone());
    let answers = poses.iter().map(|p| good(scalar.solve(p, &[]))).collect();
    all.push(Contestant {
        name: "interpreter, one pose".into(),
        limit: Some(0.6),
        answers,
        run: Box::new(move || {
            for pose in given.iter() {
                black_box(scalar.solve(black_box(pose), &[]));
            }
        }),
    });
    let mut machine = MachineSolver::compile(&function).map_err(|e| anyhow::anyhow!("{e}"))?;
    let given = poses.clone();
    let answers = poses.iter().map(|p| good(machine.solve(p, &[]))).collect();
    all.push(Contestant {
        name: "machine code (JIT), one pose".into(),
        limit: None,
        answers,
        run: Box::new(move || {
            for pose in given.iter() {
                black_box(machine.solve(black_box(pose), &[]));
            }
        }),
    });
    let (isa, _) = function.target();
    let (mut batch, mut solutions) = (function.batch(), Solutions::default());
    let rows: Vec<f64> = poses.iter().flatten().copied().collect();
    batch.run(&rows, &mut solutions);
    let row = |i: usize| -> Vec<Joints> {
        let good = solutions.row(i).filter(|s| s.1 <= TOLERANCE);
        good.map(|s| s.0.try_into().expect("six joints")).collect()
    };
    let answers = (0..poses.len()).map(row).collect();
    all.push(Contestant {
        name: format!("interpreter, batch, {}", isa.name()),
        limit: None,
        answers,
        run: Box::new(move || {
            batch.run(black_box(&rows), black_box(&mut solutions));
        }),
    });
    Ok(all)
}
