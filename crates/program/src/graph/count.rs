//! What a program costs, counted by one stated rule.

use super::op::{Op, Stage};
use std::fmt;

/// How operations are counted.
pub const COUNTING_RULE: &str = "each multiplication and addition whose result depends on a variable; signs are free; \
a sine and cosine of one angle are one pair; a constant added to a variable as it comes in (its offset) \
and what depends on parameters alone stand apart";

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
    /// Signs of values, as in Coulomb's friction.
    pub signs: u32,
    /// Additions of a constant to a variable as it comes in, such as the offset of a slide.
    pub offsets: u32,
    /// Operations on parameters alone, hoisted out of the evaluation.
    pub hoisted: u32,
}

impl Count {
    /// Adds operation `n`, which `look` finds along with its operands; `angles` holds those whose sine or cosine
    /// is counted already.
    pub(crate) fn include<'a>(
        &mut self,
        n: u32,
        look: impl Fn(u32) -> (&'a Op, Stage),
        angles: &mut Vec<u32>,
    ) {
        let (op, stage) = look(n);
        if stage != Stage::Variable {
            self.hoisted += u32::from(stage == Stage::Parameter && op.nodes().next().is_some());
            return;
        }
        let is_offset = |a: u32, b: u32| {
            matches!(look(a), (Op::Input(_), Stage::Variable)) && look(b).1 != Stage::Variable
        };
        match op {
            Op::Number(_) | Op::Pi | Op::Input(_) => {}
            Op::Add(a, b) | Op::Sub(a, b) if is_offset(*a, *b) || is_offset(*b, *a) => self.offsets += 1,
            Op::Add(..) | Op::Sub(..) => self.additions += 1,
            Op::Mul(..) => self.multiplications += 1,
            Op::Div(..) => self.divisions += 1,
            Op::Sqrt(_) => self.roots += 1,
            Op::Sin(a) | Op::Cos(a) if angles.contains(a) => {}
            Op::Sin(a) | Op::Cos(a) => {
                angles.push(*a);
                self.sincos += 1;
            }
            Op::Atan2(..) => self.arctangents += 1,
            Op::Sign(_) => self.signs += 1,
        }
    }

    /// One figure to minimise: a product or a sum is 1, a sine and cosine 20, other functions likewise.
    pub fn cost(&self) -> u32 {
        self.multiplications
            + self.additions
            + self.offsets
            + self.signs
            + 20 * (self.sincos + self.arctangents)
            + 10 * (self.divisions + self.roots)
    }
}

impl std::iter::Sum for Count {
    fn sum<I: Iterator<Item = Count>>(all: I) -> Count {
        all.fold(Count::default(), |a, b| Count {
            multiplications: a.multiplications + b.multiplications,
            additions: a.additions + b.additions,
            sincos: a.sincos + b.sincos,
            divisions: a.divisions + b.divisions,
            roots: a.roots + b.roots,
            arctangents: a.arctangents + b.arctangents,
            signs: a.signs + b.signs,
            offsets: a.offsets + b.offsets,
            hoisted: a.hoisted + b.hoisted,
        })
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
        for (n, word) in [
            (self.divisions, "division"),
            (self.roots, "root"),
            (self.arctangents, "arctangent"),
            (self.signs, "sign function"),
        ] {
            if n > 0 {
                write!(f, ", {}", plural(n, word))?;
            }
        }
        let apart = match (self.offsets, self.hoisted) {
            (0, 0) => return Ok(()),
            (n, 0) => plural(n, "variable offset"),
            (0, n) => format!("{} on parameters alone", plural(n, "operation")),
            (n, m) => {
                format!("{}, {} on parameters alone", plural(n, "variable offset"), plural(m, "operation"))
            }
        };
        write!(f, "; apart: {apart}")
    }
}
