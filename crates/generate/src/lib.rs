//! Source code for one robot: what to emit, the words around it, and the vectors that its tests hold.

mod controller;
mod dynamics;
mod forward;
mod general;
mod ikfast;
mod inverse;
mod ros2;
mod samples;
mod tables;
mod tree;
mod words;

pub use inverse::Inverse;
pub use ros2::{Link, Links, generate_ros2};
pub use tree::generate_tree;

use controller::Controller;
use denavit::description::Description;
use denavit::dynamics::{DynamicFunction, Loads, Masses, NoNumbers, NoProgram, Unknown};
use denavit::forward::Proof;
use denavit::inverse as ik;
use denavit::robot::MissingValue;
use denavit_emit::{Attachment, File, Language, Library, Parameter, Precision, Routine, SolverRoutine};
use denavit_program::Count;
use denavit_symbolic::Expr;
use dynamics::Dynamic;
use forward::Forward;
use general::General;
use ikfast::Interface;
use inverse::Closed;
use std::fmt;
use std::str::FromStr;

/// A function that can be generated.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Wanted {
    /// `fk`: the tool in the base.
    Pose,
    /// `frames`: frames 0 … n in the base.
    Frames,
    /// `jacobian`: the geometric Jacobian of the tool in the base.
    Jacobian,
    /// `jacobian_fk`: that and the tool in the base, in one pass.
    JacobianAndPose,
    /// `ik`: all joint variables that bring the tool to a pose.
    Inverse,
    /// Torques, inertia, accelerations, energies, and derivatives.
    Dynamic(DynamicFunction),
}

impl Wanted {
    /// All of them.
    pub const ALL: [Wanted; 15] = [
        Wanted::Pose,
        Wanted::Frames,
        Wanted::Jacobian,
        Wanted::JacobianAndPose,
        Wanted::Inverse,
        Wanted::Dynamic(DynamicFunction::Torque),
        Wanted::Dynamic(DynamicFunction::Inertia),
        Wanted::Dynamic(DynamicFunction::Bias),
        Wanted::Dynamic(DynamicFunction::Gravity),
        Wanted::Dynamic(DynamicFunction::Acceleration),
        Wanted::Dynamic(DynamicFunction::Energy),
        Wanted::Dynamic(DynamicFunction::TorqueDerivatives),
        Wanted::Dynamic(DynamicFunction::AccelerationDerivatives),
        Wanted::Dynamic(DynamicFunction::TorqueWithDerivatives),
        Wanted::Dynamic(DynamicFunction::AccelerationWithDerivatives),
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Wanted::Pose => "fk",
            Wanted::Frames => "frames",
            Wanted::Jacobian => "jacobian",
            Wanted::JacobianAndPose => "jacobian_fk",
            Wanted::Inverse => "ik",
            Wanted::Dynamic(DynamicFunction::Torque) => "torque",
            Wanted::Dynamic(DynamicFunction::Inertia) => "inertia",
            Wanted::Dynamic(DynamicFunction::Bias) => "bias",
            Wanted::Dynamic(DynamicFunction::Gravity) => "gravity",
            Wanted::Dynamic(DynamicFunction::Acceleration) => "acceleration",
            Wanted::Dynamic(DynamicFunction::Energy) => "energy",
            Wanted::Dynamic(DynamicFunction::TorqueDerivatives) => "torque_derivatives",
            Wanted::Dynamic(DynamicFunction::AccelerationDerivatives) => "acceleration_derivatives",
            Wanted::Dynamic(DynamicFunction::TorqueWithDerivatives) => "torque_with_derivatives",
            Wanted::Dynamic(DynamicFunction::AccelerationWithDerivatives) => "acceleration_with_derivatives",
        }
    }

    /// What a proof says of it, a function of the joints alone.
    fn claim(self, proof: Proof) -> String {
        match (self, proof) {
            (Wanted::Jacobian, Proof::Proved) => {
                "proved equal to the derivative of the product of the link transforms".into()
            }
            (Wanted::JacobianAndPose, Proof::Proved) => {
                "proved equal to the product of the link transforms and its derivative".into()
            }
            (_, Proof::Proved) => "proved equal to the product of the link transforms".into(),
            (_, Proof::Undecided(why)) => format!("not proved: {why}"),
            (_, Proof::Failed) => "not proved: the canonical forms differ".into(),
        }
    }
}

impl FromStr for Wanted {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let known = Wanted::ALL.into_iter().find(|w| w.name() == text.trim());
        let names = || Wanted::ALL.map(Wanted::name).join(", ");
        known.ok_or_else(|| format!("unknown function `{text}`; known are {}", names()))
    }
}

impl fmt::Display for Wanted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// How to generate.
#[derive(Clone, Debug)]
pub struct PackageOptions {
    /// The language.
    pub language: Language,
    /// The functions.
    pub functions: Vec<Wanted>,
    /// What of the hand is given to the inverse model, and which joints beside it.
    pub inverse: ik::InverseOptions,
    /// Double or single precision, where the language has a choice.
    pub precision: Precision,
    /// The name of the files and functions; by default that of the robot.
    pub name: Option<String>,
    /// Which numbers of the links dynamic functions take as parameters; by default none if the description has them, and those
    /// of each link otherwise.
    pub masses: Option<Masses>,
    /// Loads that dynamic functions take: a wrench among the variables, a payload among the parameters.
    pub loads: Loads,
    /// Write the values of parameters into the code, instead of taking them as arguments.
    pub fixed: bool,
}

impl PackageOptions {
    /// Whether `ik` is what controllers call, around `solve`, which lists the solutions.
    fn has_controller(&self) -> bool {
        match self.language {
            Language::C => self.precision == Precision::Double,
            Language::Rust | Language::Python | Language::JavaScript | Language::Matlab => true,
            Language::Cuda | Language::IkFast => false,
        }
    }

    /// The name of the function that lists solutions.
    fn solver_name(&self) -> &'static str {
        if self.has_controller() || self.language == Language::IkFast { "solve" } else { "ik" }
    }
}

/// A function that was generated, and what is known of it.
#[derive(Clone, Debug)]
pub struct Function {
    /// Which.
    pub wanted: Wanted,
    /// Its operations.
    pub count: Count,
    /// Whether it is proved equal to what it stands for.
    pub is_proved: bool,
    /// Equal to what, and on what that rests.
    pub claim: String,
    /// What it divides by that depends on parameters alone.
    pub divides_by: Vec<String>,
}

/// What finds all configurations with a pose.
#[derive(Clone, Copy)]
enum Solver<'a> {
    Closed(&'a Closed),
    General(&'a General),
}

/// Why nothing is generated.
#[derive(Clone, PartialEq, Debug)]
pub enum Unable {
    /// Values are to stand in the code, and a parameter has none.
    Fixed(MissingValue),
    /// Numbers of the links are to stand in the code, and there are none.
    Masses(NoNumbers),
    /// There is no program of a function.
    Program(NoProgram),
    /// Of a whole tree: masses or values are missing.
    Tree(Unknown),
    /// A function that only a chain has is wanted of a whole tree.
    OfChains(Wanted),
    /// A function that IKFast's interface does not have is wanted behind it.
    NotInInterface(Wanted),
    /// A payload is wanted beside base parameters, of which it would be a part.
    Payload,
    /// A wrench of the tool, or a payload, is wanted, and no function feels it.
    Loads {
        /// It is the wrench.
        is_wrench: bool,
    },
}

impl fmt::Display for Unable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unable::Fixed(missing) => missing.fmt(f),
            Unable::Masses(none) => none.fmt(f),
            Unable::Program(none) => none.fmt(f),
            Unable::Tree(why) => why.fmt(f),
            Unable::OfChains(wanted) => write!(f, "{wanted} is of a chain, not of a whole tree"),
            Unable::NotInInterface(wanted) => write!(f, "the interface has no {wanted}"),
            Unable::Payload => f.write_str("base parameters have what the tool carries in them"),
            Unable::Loads { .. } => f.write_str("no function that is asked for feels it"),
        }
    }
}

impl std::error::Error for Unable {}

/// Generated source code.
#[derive(Clone, Debug)]
pub struct Generated {
    /// The files of a folder that builds and tests itself; none if there is no function.
    pub files: Vec<File>,
    /// The functions but for the inverse one.
    pub functions: Vec<Function>,
    /// The inverse function, if it was asked for and there is a closed form, or elimination in the language.
    pub inverse: Option<Inverse>,
    /// Why there is none although it was asked for.
    pub refused: Option<String>,
}

impl Generated {
    /// The command that tests the folder, to be run in it.
    pub fn test_command(&self, language: Language) -> String {
        let file = |start: &str, end: &str| {
            let mut names = self.files.iter().map(|f| f.path.as_str());
            names.find(|p| p.starts_with(start) && p.ends_with(end)).unwrap_or_default().to_string()
        };
        match language {
            Language::Rust => "cargo test".into(),
            Language::C | Language::IkFast => "make test".into(),
            Language::Python => format!("python -W error {}", file("test_", ".py")),
            Language::Matlab => format!("octave --no-gui --quiet {}", file("test_", ".m")),
            Language::JavaScript => "node --test".into(),
            Language::Cuda => format!("python {}", file("test_", ".py")),
        }
    }
}

/// Generates source code for a robot. An inverse function that has no closed form is by elimination, in every language but CUDA, where
/// it is left out. Where `fk` and `jacobian` are both asked for, `jacobian_fk` comes with
/// them. IKFast's interface has `fk` and `ik`, both of them, with the values of parameters in them.
///
/// # Errors
/// With `fixed`: if a parameter has no value. With IKFast's interface: the same; if other functions are wanted. With
/// [`Masses::Numbers`]: if the description says nothing of masses; with [`Masses::Base`]: if energies are wanted, or a payload. If accelerations are wanted and a joint moves no mass; if a load is
/// wanted that no function feels.
pub fn generate(description: &Description, options: &PackageOptions) -> Result<Generated, Unable> {
    let options = &ikfast::completed(options)?;
    let is_interface = options.language == Language::IkFast;
    let fixed;
    let (rigid, moved) = description.made_rigid();
    let d = if options.fixed {
        fixed = with_values(&rigid).map_err(Unable::Fixed)?;
        &fixed
    } else {
        &rigid
    };
    let dynamic = Dynamic::new(d, &options.functions, options.masses, options.loads)?;
    let asked = options.functions.contains(&Wanted::Inverse);
    let (mut closed, mut general, mut refused) = (None, None, None);
    match asked.then(|| Closed::new(d, options)) {
        None => {}
        Some(Ok(found)) => closed = Some(found),
        Some(Err(why)) => match General::new(d, options) {
            Ok(found) => general = Some(found),
            Err(Some(also)) => refused = Some(format!("{why}; {also}")),
            Err(None) => refused = Some(why.to_string()),
        },
    }
    let is_inverse = closed.is_some() || general.is_some();
    let wanted = with_one_pass(&options.functions, is_inverse && options.has_controller());
    let programs: Vec<Forward> = wanted.into_iter().filter_map(|w| Forward::new(d, w)).collect();
    let of_joints = programs.iter().map(|f| Function {
        wanted: f.wanted,
        count: f.program.count(),
        is_proved: f.proof == Proof::Proved,
        claim: f.wanted.claim(f.proof),
        divides_by: vec![],
    });
    let moving = dynamic.iter().flat_map(Dynamic::functions);
    let functions: Vec<Function> = of_joints.chain(moving).collect();
    if !is_inverse && (functions.is_empty() || is_interface) {
        return Ok(Generated { files: vec![], functions, inverse: None, refused });
    }
    let samples = samples::samples(d);
    let variables = d.variables();
    let parameters: Vec<Parameter> = d
        .parameters
        .iter()
        .map(|p| words::parameter(d, p.symbol, p.value))
        .chain(dynamic.iter().flat_map(Dynamic::parameters))
        .collect();
    let rounded = moved.iter().map(|(what, off)| {
        format!("The rotation of the {what} is rounded: the nearest one is meant ({off:.0e} away).")
    });
    let mut about: Vec<String> = rounded
        .chain(closed.iter().flat_map(Closed::header))
        .chain(general.iter().flat_map(General::header))
        .collect();
    let mut attachments: Vec<Attachment> = general.iter().map(General::attachment).collect();
    let mut routines: Vec<Routine> = programs.iter().map(|f| f.routine(d, &samples)).collect();
    let mut solvers: Vec<SolverRoutine> = closed.iter().map(Closed::routine).collect();
    let solver = closed.as_ref().map(Solver::Closed).or(general.as_ref().map(Solver::General));
    if let (true, Some(solver), Some(pose)) = (is_interface, solver, routines.first()) {
        match Interface::new(d, solver, pose, samples::size(&samples)) {
            Ok(interface) => {
                about.extend(interface.header(&forward::ends(d)));
                attachments.push(interface.attachment());
            }
            Err(why) => return Ok(Generated { files: vec![], functions, inverse: None, refused: Some(why) }),
        }
    }
    if let (true, Some(solver)) = (options.has_controller(), solver) {
        let (more, values) = dynamic.as_ref().map_or((0, vec![]), |x| (x.variables.len(), x.values()));
        let has_defaults = parameters.iter().all(|p| p.default.is_some());
        let controller = Controller::new(d, solver, variables.len() + more, &values, has_defaults);
        about.extend(controller.header());
        attachments.push(controller.attachment(options.language));
    }
    if let Some(dynamic) = &dynamic {
        // Every function takes all variables and parameters of the library.
        let values = dynamic.values();
        for vector in routines.iter_mut().flat_map(|r| &mut r.vectors) {
            vector.variables.extend(dynamic.variables.iter().map(|_| 0.0));
            vector.parameters.extend(&values);
        }
        solvers.iter_mut().flat_map(|s| &mut s.vectors).for_each(|v| v.parameters.extend(&values));
        let configurations: Vec<Vec<f64>> = samples.iter().map(|s| s.variables.clone()).collect();
        routines.extend(dynamic.routines(&configurations));
    }
    let library = Library {
        title: d.name.clone(),
        name: options.name.clone().unwrap_or_else(|| d.name.clone()),
        header: words::header(description, d, &functions, &about),
        // Those of the functions of the joints.
        variables: variables
            .iter()
            .filter(|_| !functions.is_empty())
            .map(|v| (v.symbol, words::about_variable(d, v.symbol, v.kind)))
            .chain(dynamic.iter().flat_map(|x| x.variables.iter().cloned()))
            .collect(),
        parameters,
        routines,
        solvers,
        attachments,
        precision: options.precision,
    };
    let files = denavit_emit::emit(&library, options.language);
    let inverse = closed.as_ref().map(Closed::facts).or(general.as_ref().map(General::facts));
    Ok(Generated { files, functions, inverse, refused })
}

/// The functions asked for, and where pose and Jacobian are among them, or something calls it, both in one pass.
fn with_one_pass(functions: &[Wanted], is_called: bool) -> Vec<Wanted> {
    let has = |w| functions.contains(&w);
    let is_one_more =
        (has(Wanted::Pose) && has(Wanted::Jacobian) || is_called) && !has(Wanted::JacobianAndPose);
    functions.iter().copied().chain(is_one_more.then_some(Wanted::JacobianAndPose)).collect()
}

/// The description with values in place of its parameters.
///
/// # Errors
/// If a parameter has no value.
pub fn with_values(d: &Description) -> Result<Description, MissingValue> {
    let missing = d.parameters.iter().filter(|p| p.value.is_none());
    let parameters: Vec<String> = missing.map(|p| p.symbol.name().to_string()).collect();
    if !parameters.is_empty() {
        return Err(MissingValue { parameters });
    }
    let fixed = |e: Expr| e.substitute(|s| d.exact_value(s));
    let mut new = d.clone();
    for row in &mut new.rows {
        for cell in [&mut row.theta, &mut row.d, &mut row.a, &mut row.alpha, &mut row.gamma, &mut row.b] {
            *cell = fixed(*cell);
        }
    }
    new.substitute_masses(fixed);
    (new.base, new.tool) = (d.base.map(fixed), d.tool.map(fixed));
    new.parameters.clear();
    Ok(new)
}
