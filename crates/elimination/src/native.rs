//! The solver compiled for the vector instructions that processors have, each set once, and the choice among them.
//!
//! All `unsafe` code of the crate is here: the calls of functions that are compiled for instructions which an [`Isa`]
//! has found.
#![allow(unsafe_code)]

use crate::{answer::Answer, plan::Plan, rigid::Rigid};

/// A set of instructions that this processor has: a value exists only where they were found.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Isa(Set);

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Set {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Isa {
    /// The instructions that every processor of this architecture has.
    pub const PORTABLE: Isa = Isa(Set::Portable);

    /// All sets that this processor has, the fastest first.
    pub fn available() -> Vec<Isa> {
        let mut found = vec![];
        #[cfg(target_arch = "x86_64")]
        if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
            if is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512vl")
            {
                found.push(Isa(Set::Avx512));
            }
            found.push(Isa(Set::Avx2));
        }
        found.push(Isa::PORTABLE);
        found
    }

    /// The fastest set that this processor has.
    pub fn detect() -> Isa {
        static FOUND: std::sync::OnceLock<Isa> = std::sync::OnceLock::new();
        *FOUND.get_or_init(|| Isa::available()[0])
    }
}

impl Plan {
    /// All configurations at a pose; slides and translations in the arm's unit.
    pub fn solve(&self, pose: &Rigid, answer: &mut Answer) {
        self.solve_on(Isa::detect(), pose, answer);
    }

    /// The same on given instructions: other sets round otherwise.
    pub fn solve_on(&self, isa: Isa, pose: &Rigid, answer: &mut Answer) {
        // SAFETY of the calls: `Isa::available` makes `Avx2` and `Avx512` only where their instructions are found.
        match isa.0 {
            Set::Portable => self.solve_portably(pose, answer),
            #[cfg(target_arch = "x86_64")]
            Set::Avx2 => unsafe { sets::avx2(self, pose, answer) },
            #[cfg(target_arch = "x86_64")]
            Set::Avx512 => unsafe { sets::avx512(self, pose, answer) },
        }
    }
}

/// Sets of instructions that only [`Plan::solve_on`] names, where they were found: with the parts of the solver compiled
/// for them.
#[cfg(target_arch = "x86_64")]
mod sets {
    use crate::{
        arm::{Arm, Joint},
        certificate::Verdict,
        eliminate::Eliminated,
        extract::UNKNOWNS,
        fourier::Trigonometric,
        instructions::{Arcs, Instructions},
        lanes::Lanes,
        plan::Plan,
        remaining::{First, Value},
        rigid::Rigid,
        slides::Sliding,
        solve::{Task, solve},
        split::Split,
        triple::Triple,
        work::Work,
    };

    /// Functions with the names of parts, each compiled for instructions.
    macro_rules! parts {
        ($set:ident $features:literal: $(fn $module:ident::$name:ident($($argument:ident: $kind:ty),*) $(-> $result:ty)?;)*) => {$(
            fn $name($($argument: $kind),*) $(-> $result)? {
                #[inline(never)]
                #[target_feature(enable = $features)]
                fn part($($argument: $kind),*) $(-> $result)? {
                    crate::$module::$name::<$set>($($argument),*)
                }
                // SAFETY: only parts of a solution call parts, and `Plan::solve_on` begins one where the instructions
                // were found.
                unsafe { part($($argument),*) }
            }
        )*};
    }

    /// A set, and the solver for it.
    macro_rules! set {
        ($set:ident, $features:literal, $solve:ident) => {
            pub(super) enum $set {}

            impl Instructions for $set {
                const FUSED: bool = true;
                parts! { $set $features:
                    fn eliminate::eliminate(split: &Split, closing: &Rigid, out: &mut Eliminated);
                    fn determinant::determinant(rows: &[[f64; 27]; 6], multiplied: Joint, c: Lanes, s: Lanes) -> Lanes;
                    fn extract::null_vectors(
                        rows: &[[f64; 27]; 6],
                        multiplied: Joint,
                        c: Lanes,
                        s: Lanes,
                        x: &mut [Lanes; UNKNOWNS]
                    ) -> Lanes;
                    fn remaining::complete(
                        split: &Split,
                        eliminated: &Eliminated,
                        first: &First,
                        branch: f64,
                        hidden: &Value,
                        x: &[Lanes; UNKNOWNS],
                        out: &mut [Value; 6]
                    );
                    fn newton::polish(arm: &Arm, target: &Rigid, values: &mut [Value; 6]) -> Lanes;
                    fn newton::smallest_singular_values(arm: &Arm, values: &[Value; 6]) -> Lanes;
                    fn chart::crowds(
                        angles: &[f64],
                        marked: &[bool],
                        polynomial: &Trigonometric,
                        noise: f64,
                        out: &mut Arcs
                    ) -> usize;
                    fn slides::solve_sliding(arm: &Arm, sliding: &Sliding, target: &Rigid, work: &mut Work) -> Verdict;
                    fn triple::solve_triple(arm: &Arm, triple: &Triple, target: &Rigid, work: &mut Work) -> Verdict;
                }
            }

            #[inline(never)]
            #[target_feature(enable = $features)]
            pub(super) fn $solve(plan: &Plan, pose: &Rigid, answer: &mut crate::Answer) {
                solve::<$set>(&plan.constants, Task::Answer(&plan.method), &plan.target(pose), answer);
            }
        };
    }

    set!(Avx2, "avx2,fma", avx2);
    set!(Avx512, "avx512f,avx512dq,avx512vl,avx2,fma", avx512);
}
