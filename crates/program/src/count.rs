//! What a program costs, counted by one stated rule.

use crate::graph::{Op, Stage};
use std::collections::BTreeSet;
use std::fmt;

/// How operations are counted.
pub const COUNTING_RULE: &str = "a multiplication or addition of two values that depend on a joint variable or a parameter; \
signs are free; angle sums are additions; a sine and cosine of one angle are one pair; \
what depends on parameters alone is computed once and counted apart";

/// Operations of a program.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Count {
    /// Multiplications.
    pub multiplications: u32,
    /// Additions and subtractions.
    pub additions: u32,
    /// Angles of which a sine or a cosine is taken.
    pub sincos: u32,
    /// Divisions.
    pub divisions: u32,
    /// Square roots.
    pub roots: u32,
    /// Arctangents.
    pub arctangents: u32,
    /// Operations on parameters alone, hoisted out of the evaluation.
    pub hoisted: u32,
}

impl Count {
    /// Counts operations, each given once.
    pub fn of<'a>(ops: impl Iterator<Item = (&'a Op, Stage)>) -> Self {
        let mut count = Count::default();
        let mut angles = BTreeSet::new();
        for (op, stage) in ops {
            if stage != Stage::Variable {
                if stage == Stage::Parameter && op.operands().next().is_some() {
                    count.hoisted += 1;
                }
                continue;
            }
            match op {
                Op::Number(_) | Op::Pi | Op::Input(_) => {}
                Op::Add(..) | Op::Sub(..) => count.additions += 1,
                Op::Mul(..) => count.multiplications += 1,
                Op::Div(..) => count.divisions += 1,
                Op::Sqrt(_) => count.roots += 1,
                Op::Sin(a) | Op::Cos(a) => {
                    angles.insert(*a);
                }
                Op::Atan2(..) => count.arctangents += 1,
            }
        }
        count.sincos = angles.len() as u32;
        count
    }

    /// One figure to minimise: a product or a sum is 1, a sine and cosine 20, other functions likewise.
    pub fn cost(&self) -> u32 {
        self.multiplications + self.additions + 20 * (self.sincos + self.arctangents) + 10 * (self.divisions + self.roots)
    }
}

impl fmt::Display for Count {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plural = |n: u32, word: &str| format!("{n} {word}{}", if n == 1 { "" } else { "s" });
        write!(
            f,
            "{}, {}, {}",
            plural(self.multiplications, "multiplication"),
            plural(self.additions, "addition"),
            plural(self.sincos, "sine/cosine pair"),
        )?;
        for (n, word) in [(self.divisions, "division"), (self.roots, "root"), (self.arctangents, "arctangent")] {
            if n > 0 {
                write!(f, ", {}", plural(n, word))?;
            }
        }
        if self.hoisted > 0 {
            write!(f, " (and {} on parameters alone, once)", plural(self.hoisted, "operation"))?;
        }
        Ok(())
    }
}
