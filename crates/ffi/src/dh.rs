//! A table in numbers as the text of a robot file.

use crate::trouble::Trouble;
use crate::types::{Convention, JointKind, Pose, Status};
use std::fmt::Write as _;

/// The table of an arm.
pub struct Table<'a> {
    pub convention: Convention,
    /// The cells of a row, in the order of its elementary transforms.
    pub cells: &'a [[f64; 4]],
    /// How each row moves.
    pub kinds: Vec<JointKind>,
    /// The lowest and the highest value of each row; nothing where one of them is not finite.
    pub limits: Option<&'a [[f64; 2]]>,
    pub base: Option<&'a Pose>,
    pub tool: Option<&'a Pose>,
}

impl Table<'_> {
    /// The robot file. A joint's variable is added to the cell that it moves.
    pub fn text(&self) -> Result<String, Trouble> {
        let (name, letters) = match self.convention {
            Convention::Standard => ("standard", ["theta", "d", "a", "alpha"]),
            Convention::Craig => ("craig", ["alpha", "a", "theta", "d"]),
            Convention::Khalil => ("khalil", ["alpha", "d", "theta", "r"]),
            Convention::None => {
                let why = "a table has a convention: standard, craig or khalil";
                return Err(Trouble::new(Status::BadArgument, why));
            }
        };
        let slide = if self.convention == Convention::Khalil { "r" } else { "d" };
        let mut all = format!("name = \"robot\"\nconvention = \"{name}\"\n");
        let mut joint = 0;
        for (i, (row, kind)) in self.cells.iter().zip(&self.kinds).enumerate() {
            let moved = match kind {
                JointKind::Revolute => Some("theta"),
                JointKind::Prismatic => Some(slide),
                JointKind::Fixed => None,
            };
            joint += usize::from(moved.is_some());
            all.push_str("\n[[joints]]\n");
            for (&letter, &x) in letters.iter().zip(row) {
                if !x.is_finite() {
                    let why = format!("row {i} of the table: {letter} is {x}");
                    return Err(Trouble::new(Status::NotFinite, why));
                }
                let written = match x {
                    _ if moved == Some(letter) && x == 0.0 => format!("\"q{joint}\""),
                    // A decimal without exponent, as formulas have them.
                    _ if moved == Some(letter) => {
                        format!("\"q{joint} {} {}\"", if x < 0.0 { '-' } else { '+' }, x.abs())
                    }
                    _ => format!("{x:?}"),
                };
                let _ = writeln!(all, "{letter} = {written}");
            }
            let limits =
                self.limits.map(|l| l[i]).filter(|l| moved.is_some() && l.iter().all(|x| x.is_finite()));
            if let Some([low, high]) = limits {
                let _ = writeln!(all, "limits = [{low:?}, {high:?}]");
            }
        }
        for (what, pose) in [("base", self.base), ("tool", self.tool)] {
            if let Some(pose) = pose {
                if pose.matrix.iter().flatten().any(|x| !x.is_finite()) {
                    return Err(Trouble::new(Status::NotFinite, format!("{what}: a number is not finite")));
                }
                let _ = writeln!(all, "\n[{what}]\nmatrix = {:?}", pose.matrix);
            }
        }
        Ok(all)
    }
}
