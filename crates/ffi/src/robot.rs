//! A robot: the text of its file, and what was compiled of it.

use crate::functions::{self, Ready};
use crate::loading::{Facts, Request};
use crate::trouble::{Found, Trouble, apart};
use crate::types::{DENAVIT_BASE as BASE, DENAVIT_TOOL as TOOL};
use crate::types::{Function, Status};
use denavit::description::{Description, read_toml};
use denavit::forward::Reference;
use denavit::velocity::{Viewpoint, jacobian_program};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// How many functions have names.
const FUNCTIONS: usize = 13;

/// A robot.
#[derive(Debug)]
pub struct Core {
    pub facts: Facts,
    /// What it was read from, where there may be more of it.
    request: Option<Request>,
    named: [OnceLock<Ready>; FUNCTIONS],
    /// Jacobians of other bodies than the tool, along other axes than the base's.
    jacobians: Mutex<Vec<([i32; 2], Arc<Ready>)>>,
}

impl Core {
    /// Reads a robot.
    pub fn load(request: Request) -> Result<Self, Trouble> {
        let facts = apart(|| request.load())?;
        Ok(Core::new(facts, Some(request)))
    }

    fn new(facts: Facts, request: Option<Request>) -> Self {
        let named = std::array::from_fn(|_| OnceLock::new());
        Core { facts, request, named, jacobians: Mutex::default() }
    }

    /// How many joints it has.
    pub fn joints(&self) -> usize {
        self.facts.joints.len()
    }

    /// How many frames: those of its table.
    pub fn frames(&self) -> usize {
        self.facts.rows + 1
    }

    /// What is made of the description, on a thread of its own.
    pub fn derive<T: Send>(
        &self,
        work: impl FnOnce(&Description) -> Result<T, Trouble> + Send,
    ) -> Result<T, Trouble> {
        apart(|| {
            let all = self.facts.text.to_string_lossy();
            let place =
                |found: Vec<_>| found.iter().map(|d| Found::new(d, "robot", &all)).collect::<Vec<_>>();
            let (description, _) = read_toml(&all).map_err(|found| Trouble::of(place(found)))?;
            work(&description)
        })
        .map_err(|mut why| {
            if let (Status::NoMasses, Some(reason)) = (why.status, &self.facts.unweighed) {
                why.message = format!("{} ({reason})", why.message);
            }
            why
        })
    }

    /// Another chain of what it was read from.
    pub fn chain(&self, base: Option<&str>, tip: Option<&str>) -> Result<Self, Trouble> {
        let Some(request) = &self.request else {
            let name = self.facts.name.to_string_lossy();
            let why = format!("{name} is one chain: it has no links to choose from");
            return Err(Trouble::new(Status::NoChain, why));
        };
        let [base, tip] = [base, tip].map(|name| name.map(str::to_string));
        Core::load(Request { base, tip, ..request.clone() })
    }

    /// The same with a value for a parameter, metres or radians.
    pub fn set(&self, name: &str, value: f64) -> Result<Self, Trouble> {
        let facts = self.derive(|d| {
            let mut d = d.clone();
            let set = d.set(name, &format!("{value:?}"));
            set.map_err(|why| Trouble::new(Status::BadArgument, format!("{name} = {value:?}: {why}")))?;
            let (findings, unweighed) = (self.facts.findings.clone(), self.facts.unweighed.clone());
            Ok(Facts { unweighed, ..Facts::of(&d, findings) })
        })?;
        Ok(Core::new(facts, None))
    }

    /// A function, compiled when it is first needed.
    pub fn function(&self, name: Function) -> Result<&Ready, Trouble> {
        let place = &self.named[name as usize];
        if let Some(ready) = place.get() {
            return Ok(ready);
        }
        let made = self.derive(|d| Ready::new(d, &functions::program(d, name)?))?;
        Ok(place.get_or_init(|| made))
    }

    /// How many numbers a function reads, and how many it gives.
    pub fn size(&self, name: Function) -> (usize, usize) {
        let n = self.joints();
        let outputs = match name {
            Function::Fk => 16,
            Function::Frames => 16 * (self.frames() + 1),
            Function::Jacobian => 6 * n,
            Function::Inertia => n * n,
            Function::Energy => 2,
            Function::Torque | Function::Bias | Function::Gravity | Function::Acceleration => n,
            Function::TorqueDerivatives | Function::AccelerationDerivatives => n * 3 * n,
            Function::TorqueWithDerivatives | Function::AccelerationWithDerivatives => n * (3 * n + 1),
        };
        (functions::vectors(name) * n, outputs)
    }

    fn reference(&self, frame: i32) -> Result<Reference, Trouble> {
        match frame {
            TOOL => Ok(Reference::Tool),
            BASE => Ok(Reference::Base),
            _ => match usize::try_from(frame) {
                Ok(i) if i < self.frames() => Ok(Reference::Frame(i)),
                _ => {
                    let last = self.frames() - 1;
                    let why = format!("no frame {frame}: 0 to {last}, DENAVIT_TOOL or DENAVIT_BASE");
                    Err(Trouble::new(Status::BadArgument, why))
                }
            },
        }
    }

    /// The Jacobian of the origin of a frame, along the axes of a frame, done with.
    pub fn jacobian<T>(
        &self,
        of: i32,
        axes: i32,
        work: impl FnOnce(&Ready) -> Result<T, Trouble>,
    ) -> Result<T, Trouble> {
        if (of, axes) == (TOOL, BASE) {
            return work(self.function(Function::Jacobian)?);
        }
        let (body, axes_of) = (self.reference(of)?, self.reference(axes)?);
        if matches!(body, Reference::Base | Reference::Frame(0)) {
            let why = format!("the velocity of frame {of}: the base does not move");
            return Err(Trouble::new(Status::BadArgument, why));
        }
        let known = || self.jacobians.lock().unwrap_or_else(PoisonError::into_inner);
        let find = || known().iter().find(|(key, _)| *key == [of, axes]).map(|(_, ready)| ready.clone());
        let found = find();
        let ready = match found {
            Some(ready) => ready,
            None => {
                let made = self.derive(|d| {
                    Ready::new(d, &jacobian_program(d, &Viewpoint::of(body, axes_of))).map(Arc::new)
                })?;
                known().push(([of, axes], made.clone()));
                made
            }
        };
        work(&ready)
    }
}
