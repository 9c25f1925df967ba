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
        match isa.0 {
            Set::Portable => self.solve_portably(pose, answer),
            #[cfg(target_arch = "x86_64")]
            Set::Avx2 => self.solve_as::<sets::Avx2>(pose, answer),
            #[cfg(target_arch = "x86_64")]
            Set::Avx512 => self.solve_as::<sets::Avx512>(pose, answer),
        }
    }
}

/// Sets of instructions that only [`Plan::solve_on`] names, where they were found.
#[cfg(target_arch = "x86_64")]
mod sets {
    use crate::instructions::{Compute, Instructions};

    macro_rules! set {
        ($set:ident, $features:literal) => {
            pub(super) enum $set {}

            impl Instructions for $set {
                const FUSED: bool = true;

                #[inline]
                fn apart<W: Compute>(work: W) -> W::Output {
                    #[inline(never)]
                    #[target_feature(enable = $features)]
                    fn compiled<W: Compute>(work: W) -> W::Output {
                        work.run::<$set>()
                    }
                    // SAFETY: only `Plan::solve_on` begins with this set, where it was found; parts go on with theirs.
                    unsafe { compiled(work) }
                }
            }
        };
    }

    set!(Avx2, "avx2,fma");
    set!(Avx512, "avx512f,avx512dq,avx512vl,avx2,fma");
}
