//! Functions that are compiled to be called again and again.

use crate::arrays::{Call, Vector, count_of};
use crate::inverse::{poses, solver_of};
use crate::programs::{Named, Programs, VECTORS};
use crate::ready::Ready;
use crate::trouble::{Kind, Trouble};
use denavit::description::{Description, write_toml};
use denavit::inverse::{Goal, variables};
use denavit_program::solver::{Leaves, Solutions, SolverFunction, SolverScalar, TOLERANCE};
use denavit_program::{Composer, Value};
use denavit_symbolic::Symbol;
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::{PyEllipsis, PySlice, PyTuple};
use std::sync::{Mutex, PoisonError};

/// Functions of a robot as one compiled program; what they have in common is computed once.
///
/// Call it with the vectors that `arguments` names, ``(..., n)`` each, broadcast against each other; ``out`` takes the result where there
/// is one function, ``threads`` is how many threads compute many rows. One function gives its array, several a tuple of views, in
/// their order. One state is computed by machine code, made for this processor, many in blocks on vector instructions.
#[pyclass(frozen, module = "denavit")]
pub struct Compiled {
    /// The text of the robot's file, of which it is made again behind a pickle.
    text: String,
    ready: Ready,
    n: usize,
    /// Which of [`VECTORS`] it reads.
    reads: Vec<usize>,
    parts: Vec<Part>,
}

/// The results of a function.
struct Part {
    name: String,
    tail: Vec<usize>,
}

impl Part {
    fn count(&self) -> usize {
        self.tail.iter().product()
    }
}

impl Compiled {
    /// Puts the programs of functions together.
    ///
    /// # Errors
    /// If there is no such function, it cannot be had, or a parameter has no value.
    pub fn of(d: &Description, names: &[String]) -> Result<Self, Trouble> {
        if names.is_empty() {
            return Err(Trouble::new(Kind::Usage, "no function is named"));
        }
        let programs = Programs::new(d);
        let all: Vec<Named> = names.iter().map(|name| programs.named(name)).collect::<Result<_, _>>()?;
        let n = d.variables().len();
        let reads: Vec<usize> =
            (0..VECTORS.len()).filter(|v| all.iter().any(|f| f.reads.contains(v))).collect();
        let mut vectors: Vec<Vec<Symbol>> = vec![vec![]; VECTORS.len()];
        for one in &all {
            for (k, &vector) in one.reads.iter().enumerate() {
                vectors[vector] = one.program.variables()[k * n..(k + 1) * n].to_vec();
            }
        }
        let variables: Vec<Symbol> = reads.iter().flat_map(|&v| vectors[v].iter().copied()).collect();
        let mut parameters: Vec<Symbol> = vec![];
        for &s in all.iter().flat_map(|one| one.program.parameters()) {
            if !parameters.contains(&s) {
                parameters.push(s);
            }
        }
        let mut together = Composer::new(&variables, &parameters);
        let mut outputs: Vec<(String, Value)> = vec![];
        for one in &all {
            for value in together.copy(&one.program, |_| None) {
                outputs.push((format!("y{}", outputs.len() + 1), value));
            }
        }
        let function = match &all[..] {
            [one] => one.program.compile_with(|s| d.value(s)),
            _ => together.finish(&outputs).compile_with(|s| d.value(s)),
        };
        let part = |(name, one): (&String, Named)| Part { name: name.clone(), tail: one.tail };
        Ok(Compiled {
            text: write_toml(d),
            ready: Ready::native(function.map_err(Trouble::missing)?),
            n,
            reads,
            parts: names.iter().zip(all).map(part).collect(),
        })
    }
}

/// What a function gives, from the array of its numbers.
fn dressed<'py>(part: &Part, found: Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let py = found.py();
    match part.name.as_str() {
        "torque_derivatives" | "acceleration_derivatives" => {
            py.import(intern!(py, "denavit._slopes"))?.getattr(part.name.as_str())?.call1((found,))
        }
        _ => Ok(found),
    }
}

/// What a pickle holds: how it is made again.
fn again<'py>(py: Python<'py>, text: &str, names: Vec<&str>, goal: &str) -> PyResult<Bound<'py, PyAny>> {
    let make = py.import(intern!(py, "denavit._robot"))?.getattr(intern!(py, "_compiled"))?;
    Ok((make, (text, names, goal)).into_pyobject(py)?.into_any())
}

#[pymethods]
impl Compiled {
    /// The names of the functions.
    #[getter]
    fn functions(&self) -> Vec<&str> {
        self.parts.iter().map(|part| part.name.as_str()).collect()
    }

    /// The vectors that it reads: ``q``, ``qd``, ``qdd``, ``tau``.
    #[getter]
    fn arguments(&self) -> Vec<&'static str> {
        self.reads.iter().map(|&v| VECTORS[v]).collect()
    }

    /// Whether one state is computed by machine code.
    #[getter]
    fn native(&self) -> bool {
        self.ready.is_native()
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        again(py, &self.text, self.functions(), "pose")
    }

    fn __repr__(&self) -> String {
        format!("<Compiled: {}({})>", self.functions().join(", "), self.arguments().join(", "))
    }

    #[pyo3(signature = (*vectors, out=None, threads=None))]
    fn __call__<'py>(
        &self,
        py: Python<'py>,
        vectors: &Bound<'py, PyTuple>,
        out: Option<&Bound<'py, PyAny>>,
        threads: Option<i64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        if vectors.len() != self.reads.len() {
            let given = vectors.len();
            let why = format!("{given} vectors are given; {} are needed", self.arguments().join(", "));
            return Err(Trouble::new(Kind::Usage, why).into());
        }
        let given: Vec<Bound<'py, PyAny>> = vectors.iter().collect();
        let given: Vec<Vector<'_, 'py>> =
            self.reads.iter().zip(&given).map(|(&v, x)| (VECTORS[v], x)).collect();
        let call = |tail| Call { function: &self.ready, n: self.n, tail, out, threads };
        if let [part] = &self.parts[..] {
            return dressed(part, call(&part.tail).of(py, &given)?);
        }
        if out.is_some() {
            let why = "out takes the result of one function, and these are several";
            return Err(Trouble::new(Kind::Usage, why).into());
        }
        let all = call(&[self.parts.iter().map(Part::count).sum()]).of(py, &given)?;
        let shape: Vec<usize> = all.getattr(intern!(py, "shape"))?.extract()?;
        let mut first = 0;
        let parts = self.parts.iter().map(|part| {
            let end = first + part.count();
            let own =
                all.get_item((PyEllipsis::get(py), PySlice::new(py, first as isize, end as isize, 1)))?;
            first = end;
            let shape = [&shape[..shape.len() - 1], &part.tail].concat();
            dressed(part, own.call_method1(intern!(py, "reshape"), (shape,))?)
        });
        let parts = parts.collect::<PyResult<Vec<_>>>()?;
        Ok(PyTuple::new(py, parts)?.into_any())
    }
}

/// The closed form of the inverse kinematics as a compiled solver: the branches as they are computed, without what `Robot.ik` adds.
///
/// Call it with poses ``(..., 4, 4)``; it gives `Branches`. Many poses go through vector instructions, on all cores.
#[pyclass(frozen, module = "denavit")]
pub struct CompiledIk {
    text: String,
    function: SolverFunction,
    n: usize,
    goal: Goal,
    /// An evaluator that nobody uses now.
    idle: Mutex<Option<SolverScalar>>,
}

impl CompiledIk {
    /// Derives the closed form.
    ///
    /// # Errors
    /// If there is none.
    pub fn of(d: &Description, goal: &str) -> Result<Self, Trouble> {
        let (function, goal) = solver_of(d, goal)?;
        Ok(CompiledIk { text: write_toml(d), n: d.variables().len(), function, goal, idle: Mutex::default() })
    }

    /// The solutions of one pose: how many, whether they are plain, and their joints in `into`.
    fn one(&self, leaves: &Leaves, into: &mut [f64]) -> (usize, bool) {
        let kept = leaves.iter().filter(|leaf| leaf.residual <= TOLERANCE);
        let mut count = 0;
        for (place, leaf) in into.chunks_exact_mut(self.n.max(1)).zip(kept) {
            place.copy_from_slice(leaf.outputs);
            count += 1;
        }
        (count, leaves.is_regular())
    }
}

#[pymethods]
impl CompiledIk {
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let goal = if self.goal == Goal::Position { "position" } else { "pose" };
        again(py, &self.text, vec!["ik"], goal)
    }

    fn __repr__(&self) -> &'static str {
        "<CompiledIk: ik(pose)>"
    }

    /// The largest number of solutions.
    #[getter]
    fn most(&self) -> usize {
        self.function.max_solutions()
    }

    #[pyo3(signature = (pose, *, threads=None))]
    fn __call__<'py>(
        &self,
        py: Python<'py>,
        pose: &Bound<'py, PyAny>,
        threads: Option<i64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let matrices = py.import(intern!(py, "denavit._poses"))?.getattr(intern!(py, "matrix_of"))?;
        let (all, shape) = poses(&matrices.call1((pose,))?)?;
        let (most, n, width) = (self.most(), self.n, self.function.outputs());
        let mut joints = vec![f64::NAN; all.len() * most * n];
        let (mut counts, mut regular) = (vec![0_i64; all.len()], vec![true; all.len()]);
        if let [pose] = &all[..] {
            let idle = || self.idle.lock().unwrap_or_else(PoisonError::into_inner);
            let mut scalar = idle().take().unwrap_or_else(|| self.function.scalar());
            let found = self.one(scalar.solve(&variables(self.goal, pose, &[]), &[]), &mut joints);
            (counts[0], regular[0]) = (found.0 as i64, found.1);
            *idle() = Some(scalar);
        } else if !all.is_empty() {
            let threads = count_of(threads)?;
            py.detach(|| {
                let rows: Vec<f64> = all.iter().flat_map(|x| variables(self.goal, x, &[])).collect();
                let mut found = Solutions::default();
                self.function.batch().run_parallel(threads, &rows, &mut found);
                regular.copy_from_slice(found.is_regular());
                for (i, place) in joints.chunks_exact_mut((most * n).max(1)).enumerate() {
                    let kept = found.row(i).filter(|(_, residual)| *residual <= TOLERANCE);
                    for (place, (q, _)) in place.chunks_exact_mut(n.max(1)).zip(kept) {
                        place.copy_from_slice(&q[..width]);
                        counts[i] += 1;
                    }
                }
            });
        }
        let joints = joints.into_pyarray(py).reshape([&shape[..], &[most, n]].concat())?;
        let counts = counts.into_pyarray(py).reshape(&shape[..])?;
        let regular = regular.into_pyarray(py).reshape(&shape[..])?;
        let branches = py.import(intern!(py, "denavit._answers"))?.getattr(intern!(py, "Branches"))?;
        branches.call1((joints, counts, regular))
    }
}
