//! The chain of what was read, and what it was taken out of.

use crate::read::Content;
use denavit::description::{
    Chain, Convention, Described, Description, Mechanism, NamedFrame, NoChain, NotCoupled, RowChain, RowTree,
};

/// What a chain was taken out of.
pub enum Around {
    /// It is all that there is.
    Nothing,
    /// A tree of bodies.
    Bodies(Box<(Mechanism, Chain)>),
    /// A tree of rows.
    Rows(Box<RowChain>),
}

/// Why no chain was taken.
#[derive(Clone, PartialEq, Debug)]
pub enum NotTaken {
    /// A base or a tip is named of what is one chain already.
    OneChain,
    /// There is none in the tree.
    NoChain(NoChain),
    /// There are closed loops, and they leave none.
    NotCoupled(NotCoupled),
    /// An assembly mode is named of what has no closed loops.
    NoLoops,
}

impl From<NotCoupled> for NotTaken {
    fn from(why: NotCoupled) -> Self {
        match why {
            NotCoupled::NoChain(why) => NotTaken::NoChain(why),
            why => NotTaken::NotCoupled(why),
        }
    }
}

impl From<NoChain> for NotTaken {
    fn from(why: NoChain) -> Self {
        NotTaken::NoChain(why)
    }
}

impl Around {
    /// The joints beside the chain behind which something weighs that hangs on it.
    pub fn held_joints(&self) -> Vec<String> {
        match self {
            Around::Nothing => vec![],
            Around::Bodies(both) => both.1.held.iter().map(|&j| both.0.joints[j].name.clone()).collect(),
            Around::Rows(chain) => chain.held.clone(),
        }
    }

    /// What the drives of the chain's joints can do by the file, newton metres or newtons, one a joint variable; nothing where it is
    /// no tree of bodies.
    pub fn efforts(&self) -> Option<Vec<Option<f64>>> {
        let Around::Bodies(both) = self else { return None };
        let (mechanism, chain) = &**both;
        let value = |s| chain.description.value(s);
        let of = |&j: &usize| mechanism.joints[j].effort.and_then(|e| e.eval(value).ok());
        Some(chain.joints.iter().map(of).collect())
    }

    /// The frames that do not move on those of the chain's table, by their names.
    pub fn frames(&self) -> Vec<NamedFrame> {
        match self {
            Around::Nothing => vec![],
            Around::Bodies(both) => both.0.frames(&both.1),
            Around::Rows(chain) => chain.frames.clone(),
        }
    }
}

impl Content {
    /// The chain from `base` to `tip`, or as the tree has it where these are not named; its table is in `convention`, or else in
    /// Khalil's of rows and the standard one of bodies. `name` is that of the file, `mode` the assembly mode of a linkage.
    ///
    /// # Errors
    /// If there is no such chain.
    pub fn chain(
        self,
        name: &str,
        base: Option<&str>,
        tip: Option<&str>,
        mode: Option<&str>,
        convention: Option<Convention>,
    ) -> Result<(Description, Around), NotTaken> {
        if mode.is_some() && !matches!(self, Content::Rows(Described::Linkage(_))) {
            return Err(NotTaken::NoLoops);
        }
        let of_rows = |tree: &RowTree| {
            let chain = tree.chain(base, tip, convention.unwrap_or(Convention::Khalil))?;
            Ok((chain.description.clone(), Around::Rows(Box::new(chain))))
        };
        match self {
            Content::Rows(Described::Chain(_)) if base.is_some() || tip.is_some() => Err(NotTaken::OneChain),
            Content::Rows(Described::Chain(description)) => Ok((*description, Around::Nothing)),
            Content::Rows(Described::Tree(tree)) | Content::Par(tree) => of_rows(&tree),
            Content::Rows(Described::Linkage(linkage)) => {
                let chain = linkage.chain(base, tip, mode, convention.unwrap_or(Convention::Khalil))?;
                Ok((chain.description.clone(), Around::Rows(Box::new(chain))))
            }
            Content::Bodies(mechanism) => {
                let chain = mechanism.chain(base, tip, convention.unwrap_or(Convention::Standard))?;
                let [from, to] = [chain.from, chain.to].map(|b| mechanism.bodies[b].name.clone());
                let source = Some(format!("{name}: {from} to {to}"));
                let description = Description { source, ..chain.description.clone() };
                Ok((description, Around::Bodies(Box::new((*mechanism, chain)))))
            }
        }
    }
}
