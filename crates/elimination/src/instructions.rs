//! Sets of instructions at compile time, and the parts of the solver that are compiled on their own for each of them: what
//! calls them stays small.

/// Something to compute that can be compiled for any set of instructions. `run` must be `#[inline(always)]`, as must be
/// what it calls, for the compiler to use them; but other parts.
pub trait Compute {
    /// What comes of it.
    type Output;
    /// Does it.
    fn run<I: Instructions>(self) -> Self::Output;
}

/// A set of instructions.
pub trait Instructions: Sized {
    /// Whether products inside sums keep all their digits (`mul_add`), or are rounded on their own.
    const FUSED: bool;

    /// Does some work in a function of its own, which all that calls for it share.
    fn apart<W: Compute>(work: W) -> W::Output;
}

/// What every processor of the target has.
pub enum Portable<const FUSED: bool> {}

impl<const FUSED: bool> Instructions for Portable<FUSED> {
    const FUSED: bool = FUSED;

    #[inline(never)]
    fn apart<W: Compute>(work: W) -> W::Output {
        work.run::<Self>()
    }
}

/// Rounds products inside sums on their own.
pub type Strict = Portable<false>;

/// A function of a set of instructions that is a part: it is called like any other.
macro_rules! part {
    (
        $(#[$doc:meta])*
        $visible:vis fn $name:ident<$set:ident>($($argument:ident: $kind:ty),* $(,)?) $(-> $result:ty)? $body:block
    ) => {
        $(#[$doc])*
        #[inline(always)]
        $visible fn $name<$set: Instructions>($($argument: $kind),*) $(-> $result)? {
            struct Part<T>(T);
            impl Compute for Part<($($kind,)*)> {
                type Output = part!(@ $($result)?);
                #[inline(always)]
                fn run<$set: Instructions>(self) $(-> $result)? {
                    let ($($argument,)*) = self.0;
                    $body
                }
            }
            $set::apart(Part(($($argument,)*)))
        }
    };
    (@) => { () };
    (@ $result:ty) => { $result };
}
pub(crate) use part;
