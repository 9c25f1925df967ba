//! Functions of states, compiled when they are first needed.

use crate::trouble::Trouble;
use crate::types::{Function as Name, Status};
use denavit::description::Description;
use denavit::dynamics::{DynamicFunction, DynamicPrograms, Masses};
use denavit::forward::{Reference, frames_program, pose_program};
use denavit::velocity::{Viewpoint, jacobian_program};
use denavit_program::{Function, Program, Scalar};
use std::num::NonZero;
use std::sync::{Mutex, PoisonError};

/// The most threads of one call.
const MOST_THREADS: usize = 256;

/// A compiled function, with what computes one state of it.
#[derive(Debug)]
pub struct Ready {
    function: Function,
    /// Interpreters that nobody uses now.
    idle: Mutex<Vec<Scalar>>,
}

impl Ready {
    /// A program at the robot's own values.
    pub fn new(d: &Description, program: &Program) -> Result<Self, Trouble> {
        let function = program.compile_with(|s| d.value(s)).map_err(Trouble::missing)?;
        Ok(Ready { function, idle: Mutex::default() })
    }

    /// The results of one state, to be read.
    pub fn one<T>(&self, inputs: &[f64], read: impl FnOnce(&[f64]) -> T) -> T {
        let idle = || self.idle.lock().unwrap_or_else(PoisonError::into_inner);
        let known = idle().pop();
        let mut scalar = known.unwrap_or_else(|| self.function.scalar());
        let result = read(scalar.eval(inputs));
        idle().push(scalar);
        result
    }

    /// The results of many states.
    pub fn many(&self, inputs: &[f64], outputs: &mut [f64], threads: usize) {
        self.function.batch().run_parallel(NonZero::new(threads.min(MOST_THREADS)), inputs, outputs);
    }
}

/// By how many threads a call is done: so many, or one a core.
pub fn threads(asked: usize) -> usize {
    let cores = || std::thread::available_parallelism().map_or(1, NonZero::get);
    NonZero::new(asked).map_or_else(cores, NonZero::get).min(MOST_THREADS)
}

/// The dynamic function of a name, where it is one.
fn dynamic(name: Name) -> Option<DynamicFunction> {
    Some(match name {
        Name::Fk | Name::Frames | Name::Jacobian => return None,
        Name::Torque => DynamicFunction::Torque,
        Name::Inertia => DynamicFunction::Inertia,
        Name::Bias => DynamicFunction::Bias,
        Name::Gravity => DynamicFunction::Gravity,
        Name::Acceleration => DynamicFunction::Acceleration,
        Name::Energy => DynamicFunction::Energy,
        Name::TorqueDerivatives => DynamicFunction::TorqueDerivatives,
        Name::AccelerationDerivatives => DynamicFunction::AccelerationDerivatives,
        Name::TorqueWithDerivatives => DynamicFunction::TorqueWithDerivatives,
        Name::AccelerationWithDerivatives => DynamicFunction::AccelerationWithDerivatives,
    })
}

/// How many vectors, each with an entry a joint, a function reads.
pub fn vectors(name: Name) -> usize {
    dynamic(name).map_or(1, DynamicFunction::reads)
}

/// The program of a function.
pub fn program(d: &Description, name: Name) -> Result<Program, Trouble> {
    let Some(function) = dynamic(name) else {
        let frames = || (0..=d.rows.len()).map(Reference::Frame).chain([Reference::Tool]).collect::<Vec<_>>();
        return Ok(match name {
            Name::Frames => frames_program(d, &frames()),
            Name::Jacobian => jacobian_program(d, &Viewpoint::tool()),
            _ => pose_program(d),
        });
    };
    if !d.has_masses() {
        let hint = "a URDF does, or mass, com and inertia in a robot file";
        return Err(Trouble::new(Status::NoMasses, format!("{} says nothing of masses: {hint}", d.name)));
    }
    let programs = DynamicPrograms::new(d, Masses::Numbers);
    let programs = programs.map_err(|why| Trouble::new(Status::NoMasses, why.to_string()))?;
    let made = programs.program(function);
    Ok(made.map_err(|why| Trouble::new(Status::Unsupported, why.to_string()))?.program)
}
