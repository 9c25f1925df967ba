//! Where methods and numbers come from.

use super::setting::{Setting, Topic};
use crate::document::{Block, Line, Section};
use crate::words::Heading;
use denavit::description::Convention;

/// The list.
pub fn section(s: &Setting) -> Section {
    let mut section = Section::new(s.description.vocabulary());
    section.heading(2, Line::new(s.words().heading(Heading::References)));
    let mut all = vec![];
    if let Some(source) = &s.description.source {
        all.push(Line::new(s.words().robot()).text(source.clone()));
    }
    let has = |topic: Topic| s.options.topics.contains(&topic);
    all.push(Line::new(match s.description.convention {
        Convention::Standard => {
            "J. Denavit, R. S. Hartenberg. A kinematic notation for lower-pair mechanisms based on matrices. Journal of \
             Applied Mechanics 22 (1955), 215–221."
        }
        Convention::Craig => "J. J. Craig. Introduction to Robotics: Mechanics and Control. Addison-Wesley, 1986.",
        Convention::Khalil => {
            "W. Khalil, J.-F. Kleinfinger. A new geometric notation for open and closed-loop robots. IEEE International \
             Conference on Robotics and Automation (1986), 1174–1179."
        }
    }));
    if has(Topic::Inverse) {
        all.push(Line::new(
            "W. Khalil, E. Dombre. Modeling, Identification and Control of Robots. Hermes Penton, 2002.",
        ));
        all.push(Line::new(
            "R. P. Paul. Robot Manipulators: Mathematics, Programming, and Control. MIT Press, 1981.",
        ));
        if s.inverse().is_err() {
            all.push(Line::new(
                "M. Raghavan, B. Roth. Inverse kinematics of the general 6R manipulator and related linkages. Journal of \
                 Mechanical Design 115 (1993), 502–508.",
            ));
        }
    }
    if has(Topic::Velocity) || has(Topic::Workspace) {
        all.push(Line::new(
            "T. Yoshikawa. Manipulability of robotic mechanisms. International Journal of Robotics Research 4 (1985), 3–9.",
        ));
    }
    all.push(Line::new(s.words().made_by(env!("CARGO_PKG_VERSION"))));
    section.push(Block::List(all));
    section
}
