//! What a measurement shows of the cells of a Denavit–Hartenberg table.
//!
//! An error of θ or d turns about and shifts along the z of a row, one of α or a about and along its x: each is a twist of the
//! link in which it stands, and so a sum of the parameters that are seen. Cells whose sums depend on each other are told apart by
//! no configuration. The table alone lacks a tilt for each pair of parallel axes.

use crate::linear::null_vectors;
use crate::model::{Parameter, Problem, adjoint, along};
use crate::table::{Cell, NoTable};
use crate::visible::Visible;
use denavit::Robot;
use denavit::description::{Convention, Description};
use denavit::geometry::{Axis, Transform};

/// Entries of unit columns below this are zero.
const TOLERANCE: f64 = 1e-8;

/// A cell of a table, or a number of a frame before or behind it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Place {
    /// Of a row, from 0.
    Row(usize, Cell),
    /// Of the base: a turn or a shift.
    Base(bool, Axis),
    /// Of the tool.
    Tool(bool, Axis),
}

/// Cells that no configuration tells apart: their sum with these factors is not seen.
#[derive(Clone, PartialEq, Debug)]
pub struct Tied {
    /// The cells.
    pub cells: Vec<(Place, f64)>,
    /// Whether they are two lengths along, or two angles about, axes that are parallel.
    pub are_parallel: bool,
}

/// What is seen of a table.
#[derive(Clone, PartialEq, Debug)]
pub struct TableSeen {
    /// How many cells there are.
    pub cells: usize,
    /// Combinations of cells alone that are not seen.
    pub tied: Vec<Tied>,
    /// Combinations of cells that are not seen where the frames of base and tool may be off as well.
    pub with_frames: Vec<Tied>,
    /// How many numbers of what is seen no cell, base or tool has: tilts of parallel axes.
    pub lacking: usize,
}

/// What a measurement shows of a description's table.
///
/// # Errors
/// If a parameter has no value.
pub fn table_seen(
    description: &Description,
    problem: &Problem,
    visible: &Visible,
) -> Result<TableSeen, NoTable> {
    let robot = Robot::numeric(description).map_err(NoTable::Missing)?;
    let zeros = vec![0.0; problem.arm.joints()];
    // Frames of links at rest, at their ends.
    let mut ends = vec![problem.constants[0]];
    for c in &problem.constants[1..] {
        ends.push(ends[ends.len() - 1] * *c);
    }
    let count = visible.parameters.len();
    let column = |link: usize, twist: &[f64; 6]| {
        let mut v = vec![0.0; count];
        v[6 * link..6 * link + 6].copy_from_slice(&adjoint(&ends[link].inverse(), twist));
        let reduced = visible.reduced(v);
        visible.kept.iter().map(|&k| reduced[k]).collect::<Vec<f64>>()
    };
    let is_x_first = description.convention != Convention::Standard;
    let number = |e: denavit_symbolic::Expr| e.eval(|s| description.value(s)).unwrap_or(0.0);
    let (mut start, mut link) = (robot.base, 0);
    let mut cells: Vec<(Place, Vec<f64>, [f64; 3])> = vec![];
    for (i, (row, of)) in description.rows.iter().zip(&robot.links).enumerate() {
        let end = start * of.transform(&zeros);
        let behind = link + usize::from(of.turns()) + usize::from(of.slides());
        let branch =
            start * Transform::rotation_z(number(row.gamma)) * Transform::translation_z(number(row.b));
        let (z, x) =
            if is_x_first { ((&end, link), (&branch, link)) } else { ((&start, link), (&end, behind)) };
        for (cell, (frame, link), axis) in [
            (Cell::Theta, z, Axis::Z),
            (Cell::D, z, Axis::Z),
            (Cell::A, x, Axis::X),
            (Cell::Alpha, x, Axis::X),
        ] {
            let twist = along(frame, axis, cell.is_angle());
            cells.push((Place::Row(i, cell), column(link, &twist), frame.rotation.column(axis).0));
        }
        (start, link) = (end, behind);
    }
    let (base, last) = (Transform::identity(), ends[ends.len() - 1]);
    let mut frames = vec![];
    for turns in [true, false] {
        for axis in Axis::ALL {
            frames.push((Place::Base(turns, axis), column(0, &along(&base, axis, turns)), [0.0; 3]));
        }
    }
    for turns in [true, false] {
        for axis in Axis::ALL {
            let twist = along(&last, axis, turns);
            frames.push((Place::Tool(turns, axis), column(problem.last(), &twist), [0.0; 3]));
        }
    }
    let tied = named(&cells);
    let all: Vec<_> = frames.into_iter().chain(cells.iter().cloned()).collect();
    let columns: Vec<Vec<f64>> = all.iter().map(|c| c.1.clone()).collect();
    let nulls = null_vectors(&columns, TOLERANCE).len();
    let has_cell = |t: &Tied| t.cells.iter().any(|c| matches!(c.0, Place::Row(..)));
    // Where a thing beside the arm stands is where the base stands to it.
    let of_frames = |p: Parameter| match p {
        Parameter::Turn(..) | Parameter::Shift(..) => true,
        Parameter::Fixture(f, k) => f == 0 && k < 3,
        Parameter::Gain(_) => false,
    };
    let geometry = visible.kept.iter().filter(|&&k| of_frames(visible.parameters[k])).count();
    Ok(TableSeen {
        cells: cells.len(),
        tied,
        with_frames: named(&all).into_iter().filter(has_cell).collect(),
        lacking: geometry.saturating_sub(all.len() - nulls),
    })
}

/// The null vectors of columns, by their names.
fn named(all: &[(Place, Vec<f64>, [f64; 3])]) -> Vec<Tied> {
    let columns: Vec<Vec<f64>> = all.iter().map(|c| c.1.clone()).collect();
    let tied = |v: Vec<f64>| {
        let members: Vec<usize> = (0..v.len()).filter(|&k| v[k].abs() > TOLERANCE).collect();
        let are_parallel = match members[..] {
            [i, j] => match (all[i].0, all[j].0) {
                (Place::Row(_, a), Place::Row(_, b)) => {
                    a == b && (0..3).map(|k| all[i].2[k] * all[j].2[k]).sum::<f64>().abs() > 1.0 - 1e-9
                }
                _ => false,
            },
            _ => false,
        };
        Tied { cells: members.iter().map(|&k| (all[k].0, v[k])).collect(), are_parallel }
    };
    null_vectors(&columns, TOLERANCE).into_iter().map(tied).collect()
}
