//! A robot: the text of its file, and what was compiled of it.

use crate::arrays::Call;
use crate::batches::{Columns, Wish};
use crate::compiled::{Compiled, CompiledIk};
use crate::exercises;
use crate::formulas;
use crate::inverse::{self, Solvers};
use crate::loading::{self, Facts, Joint, Request};
use crate::motion::{self, Along, Manner, Way};
use crate::named::{body, reference};
use crate::programs::{self, Programs, VECTORS};
use crate::ready::Ready;
use crate::symbols;
use crate::trouble::{Found, Kind, Trouble, apart, said};
use denavit::description::{Description, SameChain, prove_same_chain};
use denavit::forward::{frames_program, pose_program};
use denavit::velocity::{Viewpoint, jacobian_program};
use denavit_program::Program;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// A robot.
#[pyclass(frozen, module = "denavit._denavit")]
pub struct Core {
    facts: Facts,
    /// What it was read from, where there is more of it.
    request: Option<Request>,
    pose: OnceLock<Arc<Ready>>,
    /// Other functions, by what they compute.
    functions: Mutex<HashMap<String, Arc<Ready>>>,
    solvers: Solvers,
}

/// The names of the catalogue, arms first, structures behind them.
#[pyfunction]
pub fn catalogue() -> (Vec<&'static str>, Vec<&'static str>) {
    (denavit::catalogue::names(), denavit::catalogue::structures())
}

/// A program at the robot's own values.
fn compiled(d: &Description, program: &Program) -> Result<Arc<Ready>, Trouble> {
    let function = program.compile_with(|s| d.value(s)).map_err(Trouble::missing)?;
    Ok(Arc::new(Ready::new(function)))
}

impl Core {
    fn new(facts: Facts, request: Option<Request>) -> Self {
        Core {
            facts,
            request,
            pose: OnceLock::new(),
            functions: Mutex::default(),
            solvers: Solvers::default(),
        }
    }

    fn loaded(py: Python<'_>, request: Request) -> PyResult<Self> {
        let asked = request.clone();
        let facts = apart(py, move || asked.load())?;
        Ok(Core::new(facts, Some(request)))
    }

    /// What is made of the description on a thread of its own.
    ///
    /// # Errors
    /// Those of the work.
    pub fn derive<T: Send + 'static>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&Description) -> Result<T, Trouble> + Send + 'static,
    ) -> PyResult<T> {
        let unweighed = self.facts.unweighed.clone();
        let explained = move |d: &Description| work(d).map_err(|why| why.explained(unweighed.as_deref()));
        loading::derive(py, &self.facts.text, explained)
    }

    /// The function of this name, compiled when it is first needed.
    fn function(
        &self,
        py: Python<'_>,
        key: String,
        program: impl FnOnce(&Description) -> Result<Program, Trouble> + Send + 'static,
    ) -> PyResult<Arc<Ready>> {
        let known = || self.functions.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(function) = known().get(&key) {
            return Ok(function.clone());
        }
        let made = self.derive(py, move |d| compiled(d, &program(d)?))?;
        Ok(known().entry(key).or_insert(made).clone())
    }
}

#[pymethods]
impl Core {
    /// From the catalogue.
    #[staticmethod]
    #[pyo3(signature = (name, base, tip, convention))]
    fn catalogue(
        py: Python<'_>,
        name: String,
        base: Option<String>,
        tip: Option<String>,
        convention: Option<String>,
    ) -> PyResult<Self> {
        Core::loaded(py, Request { name, base, tip, convention, ..Request::default() })
    }

    /// From a file.
    #[staticmethod]
    #[allow(clippy::too_many_arguments)] // The options of a file, given by name.
    fn file(
        py: Python<'_>,
        name: String,
        base: Option<String>,
        tip: Option<String>,
        convention: Option<String>,
        arguments: Vec<(String, String)>,
        packages: Vec<(String, PathBuf)>,
        as_written: bool,
        angles: Option<String>,
        lengths: Option<String>,
        table: Option<usize>,
        columns: Option<String>,
    ) -> PyResult<Self> {
        let request = Request {
            name,
            is_file: true,
            base,
            tip,
            convention,
            arguments,
            packages,
            as_written,
            angles,
            lengths,
            table,
            columns,
        };
        Core::loaded(py, request)
    }

    /// From the text of a robot file.
    #[staticmethod]
    fn text(py: Python<'_>, text: String, name: String) -> PyResult<Self> {
        Ok(Core::new(apart(py, move || loading::from_text(&text, &name))?, None))
    }

    /// Another chain of what it was read from.
    fn chain(&self, py: Python<'_>, base: Option<String>, tip: Option<String>) -> PyResult<Self> {
        let Some(request) = self.request.clone() else {
            let why = format!("{} is one chain: it has no links to choose from", self.facts.name);
            return Err(Trouble::new(Kind::Chain, why).into());
        };
        Core::loaded(py, Request { base, tip, ..request })
    }

    /// The same with values for parameters.
    fn set(&self, py: Python<'_>, values: Vec<(String, String)>) -> PyResult<Self> {
        let known = (self.facts.findings.clone(), self.facts.unweighed.clone());
        let facts = self.derive(py, move |d| {
            let mut d = d.clone();
            for (name, value) in &values {
                let set = d.set(name, value);
                set.map_err(|why| Trouble::new(Kind::Usage, format!("{name} = {value}: {why}")))?;
            }
            let (findings, unweighed) = known;
            Ok(Facts { unweighed, ..Facts::of(&d, findings) })
        })?;
        Ok(Core::new(facts, None))
    }

    /// The same in another convention.
    fn converted(&self, py: Python<'_>, to: String) -> PyResult<Self> {
        let (mut findings, unweighed) = (self.facts.findings.clone(), self.facts.unweighed.clone());
        let facts = self.derive(py, move |d| {
            let made = d.converted(loading::convention(&to)?).description;
            match prove_same_chain(d, &made) {
                SameChain::Equal => {}
                SameChain::Different { .. } => {
                    let why = format!("the table in {to} convention is not the same chain");
                    return Err(Trouble::new(Kind::Unsupported, why));
                }
                SameChain::Undecided => findings.push(said(
                    "warning",
                    format!("that the table in {to} convention is the same chain is not proved"),
                    &d.name,
                )),
            }
            Ok(Facts { unweighed, ..Facts::of(&made, findings) })
        })?;
        Ok(Core::new(facts, None))
    }

    #[getter]
    fn toml(&self) -> &str {
        &self.facts.text
    }

    #[getter]
    fn name(&self) -> &str {
        &self.facts.name
    }

    #[getter]
    fn source(&self) -> Option<&str> {
        self.facts.source.as_deref()
    }

    #[getter]
    fn convention(&self) -> &str {
        self.facts.convention
    }

    #[getter]
    fn joints(&self) -> Vec<Joint> {
        self.facts.joints.clone()
    }

    #[getter]
    fn parameters(&self) -> Vec<(String, Option<f64>)> {
        self.facts.parameters.clone()
    }

    #[getter]
    fn poses(&self) -> Vec<(String, Vec<f64>)> {
        self.facts.poses.clone()
    }

    #[getter]
    fn table(&self) -> (Vec<String>, Vec<Vec<String>>) {
        self.facts.table.clone()
    }

    #[getter]
    fn has_masses(&self) -> bool {
        self.facts.has_masses
    }

    #[getter]
    fn findings(&self) -> Vec<Found> {
        self.facts.findings.clone()
    }

    /// Poses of the tool.
    fn fk<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
        threads: Option<i64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let function = match self.pose.get() {
            Some(function) => function,
            None => {
                let made = self.derive(q.py(), move |d| compiled(d, &pose_program(d)))?;
                self.pose.get_or_init(|| made)
            }
        };
        let call = Call { function, n: self.facts.joints.len(), tail: &[4, 4], out, threads };
        call.of(q.py(), &[("q", q)])
    }

    /// Poses of frames.
    fn frames<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        of: Option<Vec<String>>,
        out: Option<&Bound<'py, PyAny>>,
        threads: Option<i64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let count = of.as_ref().map_or(self.facts.table.1.len() + 2, Vec::len);
        let function = self.function(q.py(), format!("frames {of:?}"), move |d| {
            let frames = match of {
                Some(words) => words.iter().map(|w| reference(d, w)).collect::<Result<Vec<_>, _>>()?,
                None => programs::frames(d),
            };
            Ok(frames_program(d, &frames))
        })?;
        let n = self.facts.joints.len();
        let call = Call { function: &function, n, tail: &[count, 4, 4], out, threads };
        call.of(q.py(), &[("q", q)])
    }

    /// Geometric Jacobians.
    fn jacobian<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        of: String,
        frame: String,
        at: Option<String>,
        out: Option<&Bound<'py, PyAny>>,
        threads: Option<i64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let function = self.function(q.py(), format!("jacobian {of:?} {frame:?} {at:?}"), move |d| {
            let mut view = Viewpoint::of(body(d, &of)?, reference(d, &frame)?);
            if let Some(at) = &at {
                view.at = reference(d, at)?;
            }
            Ok(jacobian_program(d, &view))
        })?;
        let n = self.facts.joints.len();
        let call = Call { function: &function, n, tail: &[6, n], out, threads };
        call.of(q.py(), &[("q", q)])
    }

    /// A dynamic function of the vectors that it reads.
    fn dynamics<'py>(
        &self,
        py: Python<'py>,
        name: &str,
        vectors: Vec<Bound<'py, PyAny>>,
        threads: Option<i64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let wanted = programs::dynamic(name)
            .ok_or_else(|| Trouble::new(Kind::Usage, format!("no function `{name}`")))?;
        let function =
            self.function(py, format!("dynamics {name}"), move |d| Programs::new(d).dynamic(wanted))?;
        let n = self.facts.joints.len();
        let tail = programs::shape(wanted, n);
        let call = Call { function: &function, n, tail: &tail, out: None, threads };
        let named = programs::reads(wanted).iter().map(|&v| VECTORS[v]);
        call.of(py, &named.zip(&vectors).collect::<Vec<_>>())
    }

    /// Functions over record batches.
    fn columns(&self, py: Python<'_>, wish: Wish) -> PyResult<Columns> {
        self.derive(py, move |d| Columns::of(d, wish))
    }

    /// Functions as one compiled program.
    fn compile(&self, py: Python<'_>, functions: Vec<String>) -> PyResult<Compiled> {
        self.derive(py, move |d| Compiled::of(d, &functions))
    }

    /// The closed form of the inverse kinematics as a compiled solver.
    fn compile_ik(&self, py: Python<'_>, goal: String) -> PyResult<CompiledIk> {
        self.derive(py, move |d| CompiledIk::of(d, &goal))
    }

    /// All configurations for a pose.
    #[allow(clippy::too_many_arguments)] // What `Robot.ik` takes by name.
    fn ik<'py>(
        &self,
        py: Python<'py>,
        pose: &Bound<'py, PyAny>,
        near: Option<Vec<f64>>,
        limits: bool,
        one: bool,
        given: Vec<(String, f64)>,
        goal: &str,
    ) -> PyResult<Bound<'py, PyDict>> {
        let wish = inverse::Wish { near, limits, one, given };
        inverse::solve(&self.facts.text, &self.solvers, py, pose, &wish, goal)
    }

    /// All configurations for many poses, with the values of given joints.
    #[allow(clippy::too_many_arguments)] // What `Robot.ik_batch` takes by name.
    fn ik_batch<'py>(
        &self,
        py: Python<'py>,
        poses: &Bound<'py, PyAny>,
        limits: bool,
        given: Vec<(String, f64)>,
        goal: &str,
        threads: Option<i64>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let wish = inverse::Wish { near: None, limits, one: false, given };
        inverse::solve_all(&self.facts.text, &self.solvers, py, poses, &wish, goal, threads)
    }

    /// A path through configurations.
    fn path<'py>(
        &self,
        py: Python<'py>,
        points: Vec<Vec<f64>>,
        manner: Manner,
    ) -> PyResult<Bound<'py, PyDict>> {
        let plan = self.derive(py, move |d| motion::plan(d, Way::Joints(points), &manner))?;
        plan.into_dict(py, self.facts.joints.len())
    }

    /// A path of the hand through poses.
    fn follow<'py>(
        &self,
        py: Python<'py>,
        poses: &Bound<'py, PyAny>,
        along: Option<Vec<Along>>,
        start: Option<Vec<f64>>,
        manner: Manner,
    ) -> PyResult<Bound<'py, PyDict>> {
        let way = motion::way_of_poses(poses, along, start)?;
        let plan = self.derive(py, move |d| motion::plan(d, way, &manner))?;
        plan.into_dict(py, self.facts.joints.len())
    }

    /// The forward model in formulas.
    fn derive_text(
        &self,
        py: Python<'_>,
        format: String,
        from: String,
        to: String,
        only: String,
    ) -> PyResult<String> {
        self.derive(py, move |d| formulas::forward(d, &format, &from, &to, &only))
    }

    /// How the closed form is derived.
    fn ik_explain(
        &self,
        py: Python<'_>,
        format: String,
        given: Option<Vec<String>>,
        goal: String,
    ) -> PyResult<String> {
        self.derive(py, move |d| formulas::inverse(d, &format, given.as_deref(), &goal))
    }

    /// The Jacobian in formulas, and where it is singular.
    fn jacobian_explain(&self, py: Python<'_>, format: String, of: String) -> PyResult<String> {
        self.derive(py, move |d| formulas::jacobian(d, &format, &of))
    }

    /// Torques in formulas.
    fn dynamics_explain(
        &self,
        py: Python<'_>,
        format: String,
        kept: Vec<String>,
        dropped: Vec<String>,
    ) -> PyResult<String> {
        self.derive(py, move |d| formulas::dynamics(d, &format, &kept, &dropped))
    }

    /// What `derive_text`, `ik_explain`, `jacobian_explain` and `dynamics_explain` write, as nodes.
    fn derive_nodes(
        &self,
        py: Python<'_>,
        from: String,
        to: String,
        only: String,
    ) -> PyResult<symbols::Listed> {
        self.derive(py, move |d| symbols::forward(d, &from, &to, &only))
    }

    fn ik_nodes(
        &self,
        py: Python<'_>,
        given: Option<Vec<String>>,
        goal: String,
    ) -> PyResult<symbols::Listed> {
        self.derive(py, move |d| symbols::inverse(d, given.as_deref(), &goal))
    }

    fn jacobian_nodes(&self, py: Python<'_>, of: String) -> PyResult<symbols::Listed> {
        self.derive(py, move |d| symbols::jacobian(d, &of))
    }

    fn dynamics_nodes(
        &self,
        py: Python<'_>,
        kept: Vec<String>,
        dropped: Vec<String>,
    ) -> PyResult<symbols::Listed> {
        self.derive(py, move |d| symbols::dynamics(d, &kept, &dropped))
    }

    /// The whole report.
    fn report(&self, py: Python<'_>, format: String, language: String) -> PyResult<String> {
        self.derive(py, move |d| formulas::report(d, &format, &language))
    }

    /// The arm, or its line diagram, as SVG.
    fn figure(&self, py: Python<'_>, q: Option<Vec<f64>>, scheme: bool) -> PyResult<String> {
        self.derive(py, move |d| formulas::figure(d, q.as_deref(), scheme))
    }

    /// A sheet of tasks, as JSON.
    fn exercise(&self, py: Python<'_>, request: exercises::Request) -> PyResult<String> {
        self.derive(py, move |d| exercises::data(d, &request))
    }

    fn exercise_sheet(
        &self,
        py: Python<'_>,
        request: exercises::Request,
        format: String,
        solution: bool,
    ) -> PyResult<String> {
        self.derive(py, move |d| exercises::sheet(d, &request, &format, solution))
    }

    fn exercise_marked(
        &self,
        py: Python<'_>,
        request: exercises::Request,
        text: String,
        name: String,
    ) -> PyResult<(String, String)> {
        self.derive(py, move |d| exercises::marked(d, &request, &text, &name))
    }

    /// The claims of a document about this robot, as JSON.
    fn check(&self, py: Python<'_>, text: String, name: String) -> PyResult<String> {
        self.derive(py, move |d| formulas::checked(&text, &name, Some(d)))
    }

    /// Source code: files, what is said of each function, and the command that tests it.
    fn generate(
        &self,
        py: Python<'_>,
        language: String,
        functions: Vec<String>,
        name: Option<String>,
        goal: String,
    ) -> PyResult<formulas::Code> {
        self.derive(py, move |d| formulas::code(d, &language, &functions, name, &goal))
    }
}
