//! A robot's functions over record batches.

use crate::border;
use crate::named::reference;
use crate::trouble::{Kind, Trouble};
use arrow_array::RecordBatch;
use arrow_schema::Schema;
use denavit::description::Description;
use denavit_map::{Bound as Found, Frame, Inverse, Keep, MapError, Mapping, Names, Request, Solutions};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::PyCapsule;
use std::sync::{Mutex, PoisonError};

/// What is asked for, by the names of the package.
#[derive(Clone, FromPyObject)]
#[pyo3(from_item_all)]
pub struct Wish {
    fk: bool,
    jacobian: bool,
    manipulability: bool,
    torque: bool,
    /// Nothing, `all` or `nearest`.
    ik: Option<String>,
    limits: bool,
    slots: Option<usize>,
    frames: Vec<String>,
    orientation: String,
    units: String,
    joints: Option<String>,
    velocities: Option<String>,
    accelerations: Option<String>,
    position: Option<String>,
    rotation: Option<String>,
    near: Option<String>,
    keep: Option<Vec<String>>,
    prefix: String,
}

fn trouble(why: &MapError) -> Trouble {
    Trouble::new(Kind::Usage, format!("{} ({})", why.what, why.hint))
}

impl Wish {
    fn request(self, d: &Description) -> Result<Request, Trouble> {
        let usage = |why: String| Trouble::new(Kind::Usage, why);
        let frame = |word: &String| -> Result<Frame, Trouble> {
            let on = reference(d, word)?;
            let label = if word.parse::<usize>().is_ok() { format!("f{word}") } else { word.clone() };
            Ok(Frame { label, on, offset: None })
        };
        let frames = self.frames.iter().map(frame).collect::<Result<Vec<_>, _>>()?;
        let solutions = match (self.ik.as_deref(), self.slots) {
            (None, _) => None,
            (Some("all"), None) => Some(Solutions::Lists),
            (Some("all"), Some(n)) if (1..=64).contains(&n) => Some(Solutions::Slots(n)),
            (Some("all"), Some(n)) => return Err(usage(format!("slots={n}: 1 to 64 places"))),
            (Some("nearest"), _) => Some(Solutions::Nearest),
            (Some(other), _) => return Err(usage(format!("ik={other:?}: `all` or `nearest`"))),
        };
        if self.jacobian && frames.len() > 1 {
            return Err(usage("jacobian is of one frame".into()));
        }
        Ok(Request {
            poses: if self.fk { frames.clone() } else { vec![] },
            jacobian: frames.into_iter().next().filter(|_| self.jacobian),
            manipulability: self.manipulability,
            torque: self.torque,
            inverse: solutions.map(|solutions| Inverse { solutions, limits: self.limits }),
            orientation: self.orientation.parse().map_err(|why| usage(format!("orientation: {why}")))?,
            units: self.units.parse().map_err(|why| usage(format!("units: {why}")))?,
            names: Names {
                joints: self.joints,
                velocities: self.velocities,
                accelerations: self.accelerations,
                position: self.position,
                rotation: self.rotation,
                near: self.near,
            },
            prefix: self.prefix,
            keep: self.keep.map_or(Keep::All, Keep::Some),
        })
    }
}

/// A mapping, and where its inputs are in the batches that came last.
#[pyclass(frozen, module = "denavit._denavit")]
pub struct Columns {
    mapping: Mapping,
    last: Mutex<Option<(Schema, Found)>>,
}

impl Columns {
    /// Compiles what is asked for.
    ///
    /// # Errors
    /// If it cannot be computed.
    pub fn of(d: &Description, wish: Wish) -> Result<Self, Trouble> {
        let request = wish.request(d)?;
        let mapping = Mapping::new(d, &request).map_err(|why| trouble(&why))?;
        Ok(Columns { mapping, last: Mutex::default() })
    }

    fn bound(&self, schema: &Schema) -> Result<Found, Trouble> {
        let last = || self.last.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((known, bound)) = &*last()
            && known == schema
        {
            return Ok(bound.clone());
        }
        let bound = self.mapping.bind(schema).map_err(|why| trouble(&why))?;
        *last() = Some((schema.clone(), bound.clone()));
        Ok(bound)
    }
}

#[pymethods]
impl Columns {
    /// The names of the columns that are read where nothing else is said: a column each.
    #[getter]
    fn inputs(&self) -> Vec<String> {
        self.mapping.inputs()
    }

    /// The batch that an object lends, computed; how many rows have a null, no finite number or no pose, and how many more solutions
    /// than places.
    fn run(&self, py: Python<'_>, batch: &Bound<'_, PyAny>) -> PyResult<(Lent, [u64; 5])> {
        let pair = batch.call_method0(intern!(py, "__arrow_c_array__"))?;
        let batch = border::batch(&pair.get_item(0)?, &pair.get_item(1)?)?;
        let bound = self.bound(batch.schema_ref())?;
        let found = py.detach(|| bound.run(&batch));
        let (batch, c) = found.map_err(|why| PyErr::from(trouble(&why)))?;
        Ok((Lent { batch }, [c.rows, c.nulls, c.not_finite, c.no_pose, c.more_solutions]))
    }

    /// The schema of what comes of batches of a schema.
    fn schema(&self, py: Python<'_>, schema: &Bound<'_, PyAny>) -> PyResult<Declared> {
        let lent = schema.call_method0(intern!(py, "__arrow_c_schema__"))?;
        let schema = border::schema(&lent)?;
        Ok(Declared { schema: self.bound(&schema)?.schema().as_ref().clone() })
    }
}

/// A record batch that whoever knows Arrow's C data interface can take, without a copy.
#[pyclass(frozen, name = "Batch", module = "denavit")]
pub struct Lent {
    batch: RecordBatch,
}

#[pymethods]
impl Lent {
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_array__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<(Bound<'py, PyCapsule>, Bound<'py, PyCapsule>)> {
        // What is asked for is a wish, and this is what there is.
        let _ = requested_schema;
        border::lend(py, &self.batch)
    }

    fn __arrow_c_schema__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyCapsule>> {
        border::lend_schema(py, &self.batch.schema())
    }

    fn __len__(&self) -> usize {
        self.batch.num_rows()
    }

    /// The names of its columns.
    #[getter]
    fn column_names(&self) -> Vec<String> {
        self.batch.schema_ref().fields().iter().map(|f| f.name().clone()).collect()
    }
}

/// A schema, likewise.
#[pyclass(frozen, module = "denavit._denavit")]
pub struct Declared {
    schema: Schema,
}

#[pymethods]
impl Declared {
    fn __arrow_c_schema__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyCapsule>> {
        border::lend_schema(py, &self.schema)
    }
}
