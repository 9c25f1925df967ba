//! Inputs in the columns of a batch: found by name, read as numbers in radians and metres.

use crate::MapError;
use crate::unit::{Quantity, Scale, Units};
use arrow_array::cast::AsArray;
use arrow_array::types::{
    Float16Type, Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type, UInt8Type, UInt16Type,
    UInt32Type, UInt64Type,
};
use arrow_array::{Array, RecordBatch};
use arrow_schema::{DataType, Field, Schema};
use std::borrow::Cow;

/// Numbers of each row: a column each, or one column of lists.
#[derive(Clone, PartialEq, Debug)]
pub struct Input {
    places: Places,
    scales: Vec<Scale>,
}

#[derive(Clone, PartialEq, Debug)]
enum Places {
    Columns(Vec<usize>),
    List(usize),
}

/// What is looked for.
pub struct Wanted<'a> {
    /// What the numbers are, in words.
    pub what: &'a str,
    /// What each of them is.
    pub quantities: &'a [Quantity],
    /// The columns as they are asked for.
    pub asked: Option<&'a str>,
    /// The option that asks for them.
    pub option: &'a str,
    /// Names that are tried otherwise, all of one line; a name alone is a column of lists.
    pub usual: Vec<Vec<String>>,
}

/// What is the matter with a row.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Fault {
    /// Nothing.
    None,
    /// A null.
    Null,
    /// Not a number, or infinite.
    NotFinite,
    /// No pose.
    NoPose,
}

/// Numbers of a batch, a column each.
pub struct Read<'a> {
    /// The columns.
    pub columns: Vec<Cow<'a, [f64]>>,
}

/// The number of the column of this name: with its unit behind it, if there is none without.
fn named(schema: &Schema, name: &str) -> Option<usize> {
    let fields = schema.fields();
    let exact = fields.iter().position(|f| f.name() == name);
    exact.or_else(|| fields.iter().position(|f| unit_behind(f.name()).is_some_and(|(base, _)| base == name)))
}

/// A name and the unit behind it: in brackets, or after an underscore.
fn unit_behind(name: &str) -> Option<(&str, &str)> {
    for (open, close) in [('[', ']'), ('(', ')')] {
        if let Some((base, unit)) = name.strip_suffix(close).and_then(|n| n.rsplit_once(open))
            && unit.chars().next().is_some_and(char::is_alphabetic)
        {
            return Some((base.trim_end(), unit));
        }
    }
    ["deg", "rad", "mm", "m"].into_iter().find_map(|u| Some((name.strip_suffix(u)?.strip_suffix('_')?, u)))
}

/// The unit that a column says, in its metadata or behind its name.
fn said_unit(field: &Field) -> Option<&str> {
    let metadata = ["unit", "units"].into_iter().find_map(|key| field.metadata().get(key));
    metadata.map(String::as_str).or_else(|| unit_behind(field.name()).map(|x| x.1))
}

/// The columns that a text names: names with commas, and `first..last` among them.
fn listed(schema: &Schema, text: &str) -> Result<Vec<usize>, String> {
    let find = |name: &str| named(schema, name).ok_or_else(|| format!("there is no column `{name}`"));
    if let Some(whole) = named(schema, text.trim()) {
        return Ok(vec![whole]);
    }
    let mut all = vec![];
    for part in text.split(',').map(str::trim) {
        match part.split_once("..") {
            Some((first, last)) if named(schema, part).is_none() => {
                let (first, last) = (find(first.trim())?, find(last.trim())?);
                if last < first {
                    return Err(format!("in `{part}` the last column stands before the first"));
                }
                all.extend(first..=last);
            }
            _ => all.push(find(part)?),
        }
    }
    Ok(all)
}

/// The names of columns, the first of many.
pub fn names_of(schema: &Schema) -> String {
    let shown: Vec<&str> = schema.fields().iter().take(20).map(|f| f.name().as_str()).collect();
    let more = schema.fields().len() - shown.len();
    let more = if more > 0 { format!(", and {more} more") } else { String::new() };
    format!("{}{more}", shown.join(", "))
}

fn is_number(kind: &DataType) -> bool {
    kind.is_integer() || kind.is_floating()
}

/// The type of what a column of lists holds.
fn element(kind: &DataType) -> Option<&DataType> {
    match kind {
        DataType::List(f) | DataType::LargeList(f) | DataType::FixedSizeList(f, _) => Some(f.data_type()),
        _ => None,
    }
}

impl Input {
    /// Finds the columns.
    ///
    /// # Errors
    /// If they are not there, are not as many as are needed, hold no numbers, or have units that do not fit.
    pub fn find(schema: &Schema, wanted: &Wanted<'_>, units: Units) -> Result<Self, MapError> {
        let count = wanted.quantities.len();
        let there = || format!("the columns are {}", names_of(schema));
        let found = match wanted.asked {
            Some(text) => listed(schema, text)
                .map_err(|why| MapError::new(format!("{} {text}: {why}", wanted.option), there()))?,
            None => {
                let all = |names: &Vec<String>| {
                    names.iter().map(|n| named(schema, n)).collect::<Option<Vec<usize>>>()
                };
                let fits = |found: &Vec<usize>| {
                    let kind = |k: usize| schema.field(k).data_type();
                    found.len() == count && !(count == 1 && element(kind(found[0])).is_some())
                        || found.len() == 1 && element(kind(found[0])).is_some()
                };
                wanted.usual.iter().find_map(|names| all(names).filter(fits)).ok_or_else(|| {
                    let tried: Vec<String> = wanted.usual.iter().map(|n| n.join(" ")).collect();
                    MapError::new(
                        format!("{} are in no columns that are known: {}", wanted.what, tried.join("; or ")),
                        format!("name them with {}; {}", wanted.option, there()),
                    )
                })?
            }
        };
        let refuse =
            |what: String| MapError::new(what, format!("name columns with {}; {}", wanted.option, there()));
        let kind = |k: usize| schema.field(k).data_type();
        let (places, scales) = match found[..] {
            [one] if element(kind(one)).is_some() => {
                let field = schema.field(one);
                if let DataType::FixedSizeList(_, length) = field.data_type()
                    && usize::try_from(*length) != Ok(count)
                {
                    return Err(refuse(format!(
                        "`{}` holds {length} numbers a row; {count} are needed",
                        field.name()
                    )));
                }
                if !element(kind(one)).is_some_and(is_number) {
                    let what = format!("`{}` holds {}, no numbers", field.name(), field.data_type());
                    return Err(refuse(what));
                }
                let all: Vec<_> = wanted.quantities.iter().map(|&q| (q, scale(field, q, units))).collect();
                // Joints that turn and joints that slide in one list: its unit is that of some of them, the others have the usual one.
                let is_of_some = all.iter().any(|(q, found)| *q != Quantity::Plain && found.is_ok());
                let one_of = |(q, found): (Quantity, Result<Scale, MapError>)| {
                    found.or_else(|why| if is_of_some { Ok(q.scale(units)) } else { Err(why) })
                };
                let scales = all.into_iter().map(one_of).collect::<Result<_, _>>()?;
                (Places::List(one), scales)
            }
            _ => {
                if found.len() != count {
                    let what = format!("{}: {} columns, and {count} are needed", wanted.what, found.len());
                    return Err(refuse(what));
                }
                if let Some(&k) = found.iter().find(|&&k| !is_number(kind(k))) {
                    let what = format!("column `{}` holds {}, no numbers", schema.field(k).name(), kind(k));
                    return Err(refuse(what));
                }
                let each = found.iter().zip(wanted.quantities);
                let scales =
                    each.map(|(&k, &q)| scale(schema.field(k), q, units)).collect::<Result<_, _>>()?;
                (Places::Columns(found), scales)
            }
        };
        Ok(Input { places, scales })
    }

    /// The numbers of the columns that are read.
    pub fn columns(&self) -> &[usize] {
        match &self.places {
            Places::Columns(all) => all,
            Places::List(one) => std::slice::from_ref(one),
        }
    }

    /// The same where columns have other numbers.
    pub fn moved(&self, to: impl Fn(usize) -> usize) -> Self {
        let places = match &self.places {
            Places::Columns(all) => Places::Columns(all.iter().map(|&k| to(k)).collect()),
            Places::List(one) => Places::List(to(*one)),
        };
        Input { places, scales: self.scales.clone() }
    }

    /// Reads a batch; what is the matter with a row goes to `faults`, unless something is already.
    ///
    /// # Errors
    /// If a list has another length.
    pub fn read<'a>(&self, batch: &'a RecordBatch, faults: &mut [Fault]) -> Result<Read<'a>, MapError> {
        let columns = match &self.places {
            Places::Columns(all) => all
                .iter()
                .map(|&k| {
                    let column = batch.column(k).as_ref();
                    mark_nulls(column, faults);
                    numbers(column)
                })
                .collect(),
            Places::List(one) => {
                let name = batch.schema_ref().field(*one).name().clone();
                lists(batch.column(*one).as_ref(), self.scales.len(), &name, faults)?
            }
        };
        let mut read = Read { columns };
        for (column, scale) in read.columns.iter_mut().zip(&self.scales) {
            if !all_finite(column) {
                for (fault, x) in faults.iter_mut().zip(column.iter()) {
                    if *fault == Fault::None && !x.is_finite() {
                        *fault = Fault::NotFinite;
                    }
                }
            }
            if *scale != Scale::One {
                column.to_mut().iter_mut().for_each(|x| *x = scale.apply(*x));
            }
        }
        Ok(read)
    }
}

/// How a column becomes a quantity.
fn scale(field: &Field, quantity: Quantity, units: Units) -> Result<Scale, MapError> {
    let usual = quantity.scale(units);
    if quantity == Quantity::Plain {
        return Ok(usual);
    }
    let Some(unit) = said_unit(field) else { return Ok(usual) };
    quantity.said(unit).map_err(|why| {
        MapError::new(
            format!("column `{}` is {why}", field.name()),
            "rad, deg, m and mm are read, their rates with /s and /s^2: mend the column's unit",
        )
    })
}

fn all_finite(column: &[f64]) -> bool {
    // A sum of zeros, where all are finite: vectors, and no branch.
    column.chunks(1024).all(|part| part.iter().fold(0.0, |sum, x| sum + x * 0.0) == 0.0)
}

fn mark_nulls(column: &dyn Array, faults: &mut [Fault]) {
    if let Some(nulls) = column.nulls().filter(|n| n.null_count() > 0) {
        for (fault, is_there) in faults.iter_mut().zip(nulls.iter()) {
            if !is_there {
                *fault = Fault::Null;
            }
        }
    }
}

/// The numbers of a column; what stands where there is a null means nothing.
fn numbers(column: &dyn Array) -> Cow<'_, [f64]> {
    macro_rules! wide {
        ($kind:ty, $as:expr) => {
            Cow::Owned(column.as_primitive::<$kind>().values().iter().map($as).collect())
        };
    }
    match column.data_type() {
        DataType::Float64 => Cow::Borrowed(&column.as_primitive::<Float64Type>().values()[..]),
        DataType::Float32 => wide!(Float32Type, |&x| f64::from(x)),
        DataType::Float16 => wide!(Float16Type, |&x| x.to_f64()),
        DataType::Int8 => wide!(Int8Type, |&x| f64::from(x)),
        DataType::Int16 => wide!(Int16Type, |&x| f64::from(x)),
        DataType::Int32 => wide!(Int32Type, |&x| f64::from(x)),
        DataType::Int64 => wide!(Int64Type, |&x| x as f64),
        DataType::UInt8 => wide!(UInt8Type, |&x| f64::from(x)),
        DataType::UInt16 => wide!(UInt16Type, |&x| f64::from(x)),
        DataType::UInt32 => wide!(UInt32Type, |&x| f64::from(x)),
        DataType::UInt64 => wide!(UInt64Type, |&x| x as f64),
        // `find` lets no other type pass.
        _ => Cow::Owned(vec![f64::NAN; column.len()]),
    }
}

/// The members of lists, a column each.
fn lists<'a>(
    column: &'a dyn Array,
    count: usize,
    name: &str,
    faults: &mut [Fault],
) -> Result<Vec<Cow<'a, [f64]>>, MapError> {
    mark_nulls(column, faults);
    let rows = column.len();
    let (starts, members): (Vec<(usize, usize)>, &dyn Array) = match column.data_type() {
        DataType::FixedSizeList(_, length) => {
            let own = column.as_fixed_size_list();
            let length = usize::try_from(*length).unwrap_or(0);
            ((0..rows).map(|r| (own.value_offset_at(r), length)).collect(), own.values().as_ref())
        }
        DataType::LargeList(_) => {
            let own = column.as_list::<i64>();
            let at = own.value_offsets();
            let range = |r: usize| (at[r] as usize, (at[r + 1] - at[r]) as usize);
            ((0..rows).map(range).collect(), own.values().as_ref())
        }
        _ => {
            let own = column.as_list::<i32>();
            let at = own.value_offsets();
            let range = |r: usize| (at[r] as usize, (at[r + 1] - at[r]) as usize);
            ((0..rows).map(range).collect(), own.values().as_ref())
        }
    };
    let values = numbers(members);
    let nulls = members.nulls().filter(|n| n.null_count() > 0);
    let mut columns = vec![vec![0.0; rows]; count];
    for (r, (&(start, length), fault)) in starts.iter().zip(faults.iter_mut()).enumerate() {
        if *fault == Fault::Null {
            continue;
        }
        if length != count {
            return Err(MapError::new(
                format!("row {}: `{name}` holds {length} numbers; {count} are needed", r + 1),
                "a row without them has a null",
            ));
        }
        if nulls.is_some_and(|n| (start..start + count).any(|k| n.is_null(k))) {
            *fault = Fault::Null;
            continue;
        }
        for (k, own) in columns.iter_mut().enumerate() {
            own[r] = values[start + k];
        }
    }
    Ok(columns.into_iter().map(Cow::Owned).collect())
}
