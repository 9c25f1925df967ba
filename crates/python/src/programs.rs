//! Programs by the names of functions.

use crate::trouble::{Kind, Trouble};
use denavit::description::Description;
use denavit::dynamics::{DynamicFunction, DynamicPrograms, Masses};
use denavit::forward::{Reference, frames_program, pose_program};
use denavit::velocity::{Viewpoint, jacobian_program};
use denavit_program::Program;
use std::cell::OnceCell;

/// What functions read, in the order in which they read it.
pub const VECTORS: [&str; 4] = ["q", "qd", "qdd", "tau"];

/// Functions of states by name.
const FUNCTIONS: &str = "fk, frames, jacobian, torque, inertia, bias, gravity, acceleration, energy, torque_derivatives, \
                         acceleration_derivatives";

/// The dynamic function of a name.
pub fn dynamic(name: &str) -> Option<DynamicFunction> {
    Some(match name {
        "torque" => DynamicFunction::Torque,
        "inertia" => DynamicFunction::Inertia,
        "bias" => DynamicFunction::Bias,
        "gravity" => DynamicFunction::Gravity,
        "acceleration" => DynamicFunction::Acceleration,
        "energy" => DynamicFunction::Energy,
        "torque_derivatives" => DynamicFunction::TorqueWithDerivatives,
        "acceleration_derivatives" => DynamicFunction::AccelerationWithDerivatives,
        _ => return None,
    })
}

/// Which of [`VECTORS`] a dynamic function reads.
pub fn reads(function: DynamicFunction) -> &'static [usize] {
    match (function.reads(), function.is_driven()) {
        (1, _) => &[0],
        (2, _) => &[0, 1],
        (_, false) => &[0, 1, 2],
        (_, true) => &[0, 1, 3],
    }
}

/// The shape of the results of a dynamic function of an arm with `n` joints.
pub fn shape(function: DynamicFunction, n: usize) -> Vec<usize> {
    match function {
        DynamicFunction::Inertia => vec![n, n],
        DynamicFunction::Energy => vec![2],
        DynamicFunction::TorqueDerivatives | DynamicFunction::AccelerationDerivatives => vec![n, 3 * n],
        DynamicFunction::TorqueWithDerivatives | DynamicFunction::AccelerationWithDerivatives => {
            vec![n, 3 * n + 1]
        }
        DynamicFunction::Torque
        | DynamicFunction::Bias
        | DynamicFunction::Gravity
        | DynamicFunction::Acceleration => vec![n],
    }
}

/// A function as a program.
pub struct Named {
    /// Its variables are the vectors that it reads, one behind the other.
    pub program: Program,
    /// Which of [`VECTORS`].
    pub reads: &'static [usize],
    /// The shape of its results.
    pub tail: Vec<usize>,
}

/// The programs of an arm.
pub struct Programs<'a> {
    d: &'a Description,
    dynamic: OnceCell<DynamicPrograms>,
}

impl<'a> Programs<'a> {
    /// None yet.
    pub fn new(d: &'a Description) -> Self {
        Programs { d, dynamic: OnceCell::new() }
    }

    /// The program of a function.
    ///
    /// # Errors
    /// If there is no such function, or it needs masses and there are none.
    pub fn named(&self, name: &str) -> Result<Named, Trouble> {
        let n = self.d.variables().len();
        let of_q = |program, tail| Named { program, reads: &[0], tail };
        Ok(match name {
            "fk" => of_q(pose_program(self.d), vec![4, 4]),
            "frames" => {
                let frames = frames(self.d);
                let count = frames.len();
                of_q(frames_program(self.d, &frames), vec![count, 4, 4])
            }
            "jacobian" => of_q(jacobian_program(self.d, &Viewpoint::tool()), vec![6, n]),
            _ => {
                let function = dynamic(name).ok_or_else(|| {
                    let why = format!("no function `{name}`: {FUNCTIONS}; or ik, alone");
                    Trouble::new(Kind::Usage, why)
                })?;
                Named { program: self.dynamic(function)?, reads: reads(function), tail: shape(function, n) }
            }
        })
    }

    /// The program of a dynamic function, with the numbers of the description.
    ///
    /// # Errors
    /// If there are no masses, or a joint moves none.
    pub fn dynamic(&self, function: DynamicFunction) -> Result<Program, Trouble> {
        let d = self.d;
        if !d.has_masses() {
            let why = format!(
                "{} says nothing of masses: a URDF does, or mass, com and inertia in a robot file or in rows",
                d.name
            );
            return Err(Trouble::new(Kind::NoMasses, why));
        }
        let programs = match self.dynamic.get() {
            Some(programs) => programs,
            None => {
                let made = DynamicPrograms::new(d, Masses::Numbers);
                let made = made.map_err(|why| Trouble::new(Kind::NoMasses, why.to_string()))?;
                self.dynamic.get_or_init(|| made)
            }
        };
        let made = programs.program(function);
        Ok(made.map_err(|why| Trouble::new(Kind::Unsupported, why.to_string()))?.program)
    }
}

/// Frames 0 … of all rows, then the tool.
pub fn frames(d: &Description) -> Vec<Reference> {
    (0..=d.rows.len()).map(Reference::Frame).chain([Reference::Tool]).collect()
}
