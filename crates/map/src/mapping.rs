//! A request compiled for a robot.

use crate::MapError;
use crate::bound::Bound;
use crate::compiled::Compiled;
use crate::request::Request;
use arrow_schema::Schema;
use denavit::description::Description;
use std::sync::Arc;

/// A request compiled for a robot. It can be sent to other threads, and lives without the description.
///
/// Functions round the same on every machine, whatever its vector instructions are.
#[derive(Clone)]
pub struct Mapping(Arc<Compiled>);

impl Mapping {
    /// Compiles a request.
    ///
    /// # Errors
    /// If nothing is asked for, a parameter has no value, or the robot has no such function.
    pub fn new(d: &Description, request: &Request) -> Result<Self, MapError> {
        Ok(Mapping(Arc::new(Compiled::new(d, request)?)))
    }

    /// The names of the columns that are read where nothing else is said, a column each.
    pub fn inputs(&self) -> Vec<String> {
        self.0.inputs()
    }

    /// Finds the inputs in a schema.
    ///
    /// # Errors
    /// If they are not there or are no numbers, or a column that would be written is there already.
    pub fn bind(&self, schema: &Schema) -> Result<Bound, MapError> {
        Bound::new(self.0.clone(), schema)
    }
}
