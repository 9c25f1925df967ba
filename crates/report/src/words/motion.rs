//! What is said of motions.

use denavit::description::Description;
use denavit::description::JointKind;
use denavit::motion::follow::{Event, Jump};
use denavit::motion::plan::{Course, Held, Timing, Verdict};

/// What is said of motions.
pub trait Motion {
    /// What path it is.
    fn course(&self, course: &Course) -> String;

    /// A path of the hand in so many parts.
    fn hand_path(&self, parts: usize) -> String;

    /// How a path was timed.
    fn timing(&self, timing: &Timing, description: &Description) -> String;

    /// What a motion takes of its limits.
    fn shares_of_limits(&self, held: &Held) -> String;

    /// What happens on the way; the path is the subject, or a joint.
    fn event(&self, event: &Event, description: &Description) -> String;

    /// That a configuration does not go on from the one before; of joints with these names.
    fn jump(&self, jump: &Jump, joints: &[(String, JointKind)]) -> String;

    /// Whether a path is followed to its end within the limits.
    fn verdict(&self, verdict: Verdict) -> String;
}
