//! Frames, joints and goals by their names.

use crate::trouble::{Kind, Trouble};
use denavit::description::Description;
use denavit::forward::Reference;
use denavit::inverse::{Goal, InverseOptions};

/// The frame that a word names.
///
/// # Errors
/// If there is none.
pub fn reference(d: &Description, word: &str) -> Result<Reference, Trouble> {
    match word {
        "base" => Ok(Reference::Base),
        "tool" => Ok(Reference::Tool),
        _ => denavit_load::frame(d, word)
            .map(Reference::Frame)
            .map_err(|why| Trouble::new(Kind::Usage, format!("{why}; or `base` or `tool`"))),
    }
}

/// A body that moves.
///
/// # Errors
/// If it does not, or there is none.
pub fn body(d: &Description, of: &str) -> Result<Reference, Trouble> {
    match reference(d, of)? {
        Reference::Base | Reference::Frame(0) => {
            Err(Trouble::new(Kind::Usage, format!("the velocity of `{of}`: the base does not move")))
        }
        body => Ok(body),
    }
}

fn goal_of(name: &str) -> Result<Goal, Trouble> {
    match name {
        "pose" => Ok(Goal::Pose),
        "position" => Ok(Goal::Position),
        _ => Err(Trouble::new(Kind::Usage, format!("no goal `{name}`: pose or position"))),
    }
}

/// What a solver is asked to be.
///
/// # Errors
/// If there is no such joint or goal.
pub fn options(d: &Description, given: Option<&[String]>, goal: &str) -> Result<InverseOptions, Trouble> {
    let joint = |word: &String| {
        denavit_load::joint(d, word).map_err(|why| Trouble::new(Kind::Usage, format!("given: {why}")))
    };
    let given = given.map(|words| words.iter().map(joint).collect::<Result<Vec<usize>, _>>());
    Ok(InverseOptions { goal: goal_of(goal)?, given: given.transpose()? })
}
