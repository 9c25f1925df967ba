//! Joint variables for poses.

use crate::arrays::{Rows, array, count_of, leading, matrix};
use crate::loading::derive;
use crate::named::options;
use crate::packed::Packed;
use crate::trouble::{Kind, Trouble};
use denavit::description::Description;
use denavit::geometry::Transform;
use denavit::inverse::{Family, Goal, InverseKinematics, InverseModel, Unprepared};
use denavit_program::solver::SolverFunction;
use denavit_report::words::Tongue;
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyString};
use std::collections::HashMap;
use std::num::NonZero;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

/// What is solved besides the pose.
pub struct Wish {
    /// The solution nearest to this is wanted, too.
    pub near: Option<Vec<f64>>,
    /// Whether solutions that the limits exclude are left out.
    pub limits: bool,
    /// Whether one will do.
    pub one: bool,
    /// Joints whose values are given.
    pub given: Vec<(String, f64)>,
}

/// The solvers of a robot, prepared when they are first needed.
#[derive(Default)]
pub struct Solvers(Mutex<HashMap<String, Arc<Prepared>>>);

/// A solver, with what stands for joints that are given.
pub struct Prepared {
    solver: InverseKinematics,
    /// Names of the joint variables.
    names: Vec<String>,
    /// Values of given joints that nobody gives.
    usual: Vec<f64>,
}

impl Solvers {
    fn get(
        &self,
        text: &str,
        py: Python<'_>,
        wish: &Wish,
        goal: &str,
    ) -> PyResult<(Arc<Prepared>, Vec<f64>)> {
        let words: Vec<String> = wish.given.iter().map(|g| g.0.clone()).collect();
        let key = format!("{goal} {words:?}");
        let known = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let found = known().get(&key).cloned();
        let prepared = match found {
            Some(prepared) => prepared,
            None => {
                let (words, goal) = (words.clone(), goal.to_string());
                let made = derive(py, text, move |d| prepare(d, &words, &goal).map(Arc::new))?;
                known().entry(key).or_insert(made).clone()
            }
        };
        // By number or name a joint is found only in the description; the solver has them sorted.
        let mut values = prepared.usual.clone();
        if !wish.given.is_empty() {
            let goal = goal.to_string();
            let order =
                derive(py, text, move |d| Ok(options(d, Some(&words), &goal)?.given.unwrap_or_default()))?;
            for (value, joint) in values.iter_mut().zip(&prepared.solver.given) {
                if let Some(k) = order.iter().position(|g| g == joint) {
                    *value = wish.given[k].1;
                }
            }
        }
        Ok((prepared, values))
    }
}

/// Why there is no solver.
pub fn unprepared(why: &Unprepared) -> Trouble {
    match why {
        Unprepared::Missing(missing) => Trouble::missing(missing),
        Unprepared::Lengths(_) => Trouble::new(Kind::Unsupported, why.to_string()),
        Unprepared::Given(why) => Trouble::new(Kind::Usage, format!("given: {why}")),
    }
}

fn prepare(d: &Description, given: &[String], goal: &str) -> Result<Prepared, Trouble> {
    let options = options(d, (!given.is_empty()).then_some(given), goal)?;
    let solver = InverseKinematics::new(d, &options).map_err(|why| unprepared(&why))?;
    let names = d.variables().iter().map(|v| v.symbol.name().to_string()).collect();
    let limits: Vec<_> = d.rows.iter().filter(|r| r.variable.is_some()).map(|r| r.limits).collect();
    let usual = solver.given.iter().map(|&j| {
        let limits = limits[j].and_then(|[a, b]| {
            let number = |e: denavit_symbolic::Expr| e.eval(|s| d.value(s)).ok();
            Some([number(a)?, number(b)?])
        });
        match limits {
            Some([low, high]) if !(low..=high).contains(&0.0) => f64::midpoint(low, high),
            _ => 0.0,
        }
    });
    let usual = usual.collect();
    Ok(Prepared { usual, names, solver })
}

/// The closed form of an arm as a compiled solver, and what of the hand is given to it.
///
/// # Errors
/// If there is none, or a parameter has no value.
pub fn solver_of(d: &Description, goal: &str) -> Result<(SolverFunction, Goal), Trouble> {
    let options = options(d, None, goal)?;
    let model = InverseModel::derive(d, &options).map_err(|why| {
        let why = format!("no closed form: {why}; `ik` answers in numbers all the same");
        Trouble::new(Kind::Unsupported, why)
    })?;
    let solver = model.solver(d).map_err(Trouble::missing)?;
    if !solver.given().is_empty() {
        let why = "the closed form needs values of joints beside the pose: `ik` and `ik_batch` take them as `given`";
        return Err(Trouble::new(Kind::Unsupported, why));
    }
    Ok((solver.function().clone(), options.goal))
}

/// The poses of an array `(..., 4, 4)`, with its leading shape.
///
/// # Errors
/// If it has another shape, or one of them is none.
pub fn poses(object: &Bound<'_, PyAny>) -> PyResult<(Vec<Transform<f64>>, Vec<usize>)> {
    match array(object, "pose")? {
        Rows::Double(a) => rigid(&a.ordered(), a.shape()),
        Rows::Single(a) => {
            let wide: Vec<f64> = a.ordered().iter().map(|&x| f64::from(x)).collect();
            rigid(&wide, a.shape())
        }
    }
}

fn rigid(entries: &[f64], shape: &[usize]) -> PyResult<(Vec<Transform<f64>>, Vec<usize>)> {
    let shape = leading(shape, &[4, 4], "pose")?;
    let pose = |(number, m): (usize, &[f64])| {
        let row = |r: usize| [m[4 * r], m[4 * r + 1], m[4 * r + 2], m[4 * r + 3]];
        Transform::from_matrix([row(0), row(1), row(2), row(3)]).map_err(|why| {
            let which = if shape.is_empty() { String::new() } else { format!("pose {number}: ") };
            Trouble::new(Kind::Pose, format!("{which}{why}"))
        })
    };
    let all: Result<Vec<_>, Trouble> = entries.chunks_exact(16).enumerate().map(pose).collect();
    Ok((all?, shape.to_vec()))
}

/// Everything about one pose.
///
/// # Errors
/// If it is none, or the robot cannot be solved.
pub fn solve<'py>(
    text: &str,
    solvers: &Solvers,
    py: Python<'py>,
    pose: &Bound<'py, PyAny>,
    wish: &Wish,
    goal: &str,
) -> PyResult<Bound<'py, PyDict>> {
    let (all, shape) = poses(pose)?;
    let [pose] = all[..] else {
        let why =
            format!("one pose is needed, and this is an array {shape:?} of them: `ik_batch` takes many");
        return Err(Trouble::new(Kind::Shape, why).into());
    };
    let (prepared, values) = solvers.get(text, py, wish, goal)?;
    let solver = &prepared.solver;
    let joints = solver.robot.joints;
    if let Some(near) = wish.near.as_ref().filter(|q| q.len() != joints) {
        let why = format!("near has {} values; {joints} are needed", near.len());
        return Err(Trouble::new(Kind::Shape, why).into());
    }
    let (answer, nearest, left_out) = py.detach(|| {
        let seeded = wish.near.as_ref().map(|near| {
            let mut seeded = solver.clone();
            seeded.seed = Some(near.clone());
            seeded
        });
        let solver = seeded.as_ref().unwrap_or(solver);
        let mut answer = match wish.one {
            true => solver.one(&pose, &values, wish.near.as_deref()),
            false => solver.solve(&pose, &values),
        };
        // Before anything is left out: a family may have a member within the limits, and it is the nearest.
        let nearest = wish.near.as_ref().and_then(|to| solver.nearest(&pose, &answer, to));
        let left_out = wish.limits.then(|| answer.leave_out(&solver.space));
        (answer, nearest.filter(|n| n.within_limits || !wish.limits), left_out)
    });
    let dict = PyDict::new(py);
    let mut packed = Packed::default();
    packed.add(&answer, left_out);
    packed.list(py, &dict, joints)?;
    let families = answer.families.iter().map(|f| family(py, f, joints)).collect::<PyResult<Vec<_>>>()?;
    dict.set_item("families", PyList::new(py, families)?)?;
    dict.set_item("complete", answer.is_complete())?;
    dict.set_item("doubt", denavit_wire::inverse::doubt(&answer))?;
    let status = denavit_wire::inverse::status_within(&answer, left_out);
    dict.set_item("status", status)?;
    dict.set_item("left_out", left_out.unwrap_or(0))?;
    dict.set_item("method", solver.method())?;
    let given = solver.given.iter().map(|&j| prepared.names[j].clone()).zip(values);
    dict.set_item("given", given.collect::<Vec<_>>())?;
    dict.set_item("nearest", nearest.map(|n| n.q.into_pyarray(py)))?;
    let is_excluded = left_out.is_some_and(|n| n > 0);
    let obstacle = answer.obstacle.as_ref().filter(|_| !answer.is_reachable() && !is_excluded);
    let obstacle = obstacle.map(|o| {
        let words = Tongue::English.words().obstacle(o);
        (words, o.q.clone().into_pyarray(py), o.angle, o.distance)
    });
    dict.set_item("obstacle", obstacle)?;
    Ok(dict)
}

fn family<'py>(py: Python<'py>, f: &Family, joints: usize) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("q", f.representative.q.clone().into_pyarray(py))?;
    dict.set_item("branch", f.representative.branch.to_string())?;
    dict.set_item("residual", f.representative.residual)?;
    dict.set_item("within_limits", f.representative.within_limits)?;
    dict.set_item("dimension", f.dimension)?;
    dict.set_item("free", f.free.clone())?;
    dict.set_item("direction", f.direction.clone().into_pyarray(py))?;
    dict.set_item("affine", f.is_affine)?;
    dict.set_item("interval", f.interval.map(|[a, b]| (a, b)))?;
    dict.set_item("feasible", f.feasible.iter().map(|[a, b]| (*a, *b)).collect::<Vec<_>>())?;
    let curve: Vec<f64> = f.curve.iter().flatten().copied().collect();
    dict.set_item("curve", matrix(py, curve, f.curve.len(), joints)?)?;
    Ok(dict)
}

/// All solutions of many poses, one behind the other.
///
/// # Errors
/// If one is no pose, or the robot cannot be solved.
pub fn solve_all<'py>(
    text: &str,
    solvers: &Solvers,
    py: Python<'py>,
    many: &Bound<'py, PyAny>,
    wish: &Wish,
    goal: &str,
    threads: Option<i64>,
) -> PyResult<Bound<'py, PyDict>> {
    let threads = count_of(threads)?;
    let (poses, shape) = poses(many)?;
    let (prepared, values) = solvers.get(text, py, wish, goal)?;
    let solver = &prepared.solver;
    let mut packed = py.detach(|| {
        let cores = || thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN);
        let threads = threads.unwrap_or_else(cores);
        Packed::solve(solver, &poses, &values, wish.limits, threads)
    });
    let dict = PyDict::new(py);
    packed.list(py, &dict, solver.robot.joints)?;
    dict.set_item("counts", packed.counts.into_pyarray(py))?;
    dict.set_item("complete", PyArray1::from_vec(py, packed.complete))?;
    let mut words: Vec<(&str, Bound<'py, PyString>)> = vec![];
    let mut word = |status: &'static str| match words.iter().find(|(known, _)| *known == status) {
        Some((_, word)) => word.clone(),
        None => {
            words.push((status, PyString::new(py, status)));
            words[words.len() - 1].1.clone()
        }
    };
    let status: Vec<_> = packed.status.into_iter().map(&mut word).collect();
    dict.set_item("status", PyList::new(py, status)?)?;
    dict.set_item("left_out", packed.left_out)?;
    // Few poses have families: those that do, by their numbers.
    let families = PyDict::new(py);
    for (number, all) in &packed.families {
        let all = all.iter().map(|f| family(py, f, solver.robot.joints));
        families.set_item(number, PyList::new(py, all.collect::<PyResult<Vec<_>>>()?)?)?;
    }
    dict.set_item("families", families)?;
    dict.set_item("method", solver.method())?;
    dict.set_item("shape", shape)?;
    Ok(dict)
}
