//! The parts of the solver that are compiled on their own for each set of instructions: what calls them is small.

use crate::{
    arm::{Arm, Joint},
    certificate::Verdict,
    chart, determinant, eliminate,
    eliminate::Eliminated,
    extract,
    extract::UNKNOWNS,
    fourier::Trigonometric,
    lanes::Lanes,
    newton, remaining,
    remaining::{First, Value},
    rigid::Rigid,
    slides,
    slides::Sliding,
    split::Split,
    triple,
    triple::Triple,
    work::Work,
};

/// Arcs of the circle, as `(centre, half width)`.
pub type Arcs = [(f64, f64); 8];

/// A set of instructions. Each function is the one of its name in the module that its body names.
pub trait Instructions: Sized {
    /// Whether products inside sums keep all their digits (`mul_add`), or are rounded on their own.
    const FUSED: bool;

    #[inline(never)]
    fn eliminate(split: &Split, closing: &Rigid, out: &mut Eliminated) {
        eliminate::eliminate::<Self>(split, closing, out);
    }
    #[inline(never)]
    fn determinant(rows: &[[f64; 27]; 6], multiplied: Joint, c: Lanes, s: Lanes) -> Lanes {
        determinant::determinant::<Self>(rows, multiplied, c, s)
    }
    #[inline(never)]
    fn null_vectors(
        rows: &[[f64; 27]; 6],
        multiplied: Joint,
        c: Lanes,
        s: Lanes,
        x: &mut [Lanes; UNKNOWNS],
    ) -> Lanes {
        extract::null_vectors::<Self>(rows, multiplied, c, s, x)
    }
    #[inline(never)]
    fn complete(
        split: &Split,
        eliminated: &Eliminated,
        first: &First,
        branch: f64,
        hidden: &Value,
        x: &[Lanes; UNKNOWNS],
        out: &mut [Value; 6],
    ) {
        remaining::complete::<Self>(split, eliminated, first, branch, hidden, x, out);
    }
    #[inline(never)]
    fn polish(arm: &Arm, target: &Rigid, values: &mut [Value; 6]) -> Lanes {
        newton::polish::<Self>(arm, target, values)
    }
    #[inline(never)]
    fn smallest_singular_values(arm: &Arm, values: &[Value; 6]) -> Lanes {
        newton::smallest_singular_values::<Self>(arm, values)
    }
    #[inline(never)]
    fn crowds(
        angles: &[f64],
        marked: &[bool],
        polynomial: &Trigonometric,
        noise: f64,
        out: &mut Arcs,
    ) -> usize {
        chart::crowds::<Self>(angles, marked, polynomial, noise, out)
    }
    #[inline(never)]
    fn solve_sliding(arm: &Arm, sliding: &Sliding, target: &Rigid, work: &mut Work) -> Verdict {
        slides::solve_sliding::<Self>(arm, sliding, target, work)
    }
    #[inline(never)]
    fn solve_triple(arm: &Arm, triple: &Triple, target: &Rigid, work: &mut Work) -> Verdict {
        triple::solve_triple::<Self>(arm, triple, target, work)
    }
}

/// What every processor of the target has.
pub enum Portable<const FUSED: bool> {}

impl<const FUSED: bool> Instructions for Portable<FUSED> {
    const FUSED: bool = FUSED;
}

/// Rounds products inside sums on their own.
pub type Strict = Portable<false>;
