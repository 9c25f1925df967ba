//! Dynamics.

use super::{English, counted};
use crate::tree::{Line, Math};
use crate::words::{Dynamics, Terms};
use denavit::dynamics::{Ground, Minimality};
use denavit::geometry::NoBody;
use denavit_program::Count;

impl Dynamics for English {
    fn dynamics_title(&self, robot: &str) -> String {
        format!("Dynamics of the {robot}")
    }

    fn link_parameters(&self, has_other_frames: bool) -> String {
        let frames = match has_other_frames {
            true => {
                "the frame that has its z along the link's own axis (those of the table in Khalil's convention, not \
                 those of this one)"
            }
            false => "its frame",
        };
        format!(
            "Link j has the inertia XXj … ZZj (a tensor: XYj is minus the product of inertia), the first moments MXj, MYj, MZj and \
             the mass Mj, all about the origin of {frames}. qd and qdd are the rates and the accelerations of the joints."
        )
    }

    fn no_body(&self, why: NoBody) -> &'static str {
        match why {
            NoBody::NotFinite => "a number is not finite",
            NoBody::NegativeMass => "its mass is negative",
            NoBody::NoMass => "its mass is 0, and its first moment or inertia is not",
            NoBody::NotPositive => "its inertia about the centre of mass is not positive",
            NoBody::Triangle => "one of its principal moments is larger than the sum of the others",
        }
    }

    fn gravity_is(&self, components: [Math; 3]) -> Line {
        Line::new("The acceleration of gravity in the base is (").list(components).text(").")
    }

    fn base_title(&self) -> String {
        "Base parameters".into()
    }

    fn base_count(&self, all: usize, base: usize, minimality: Minimality) -> String {
        let of = counted(all, "parameter", "parameters");
        let rest = match minimality {
            Minimality::Proved => {
                "Fewer do not do: the torques' columns by them are proved to be independent.".into()
            }
            Minimality::AtLeast(rank) => {
                format!("There may be fewer: {rank} of them are proved to be independent.")
            }
            Minimality::Unknown => "Whether fewer would do was not decided.".to_string(),
        };
        format!("Of {of} of the links, grouped, {base} have an effect on the torques. {rest}")
    }

    fn base_alone(&self, all: Vec<Math>) -> Line {
        Line::new("as they are: ").list(all)
    }

    fn without_effect(&self, all: Vec<Math>) -> Line {
        Line::new("without any effect on the torques: ").list(all)
    }

    fn torques_title(&self) -> String {
        "Torques".into()
    }

    fn torques_cost(&self, count: &Count, ground: Ground) -> String {
        let ground = match ground {
            Ground::Proved => "proved equal to Lagrange's equations".into(),
            Ground::Modulo(states) => format!(
                "not proved in general: exactly equal to Lagrange's equations at {states} random states modulo a prime of 61 bits"
            ),
            Ground::Numbers(states, off) => {
                format!("not proved: equal to Lagrange's equations within {off:.0e} in {states} states")
            }
            Ground::Failed => "not equal to Lagrange's equations: this is a defect of the program".into(),
        };
        format!("{}; {ground}.", self.count(count))
    }

    fn with_friction(&self) -> String {
        "h has the friction of the joints in it.".into()
    }

    fn divides_by(&self, all: Vec<Math>) -> Line {
        Line::new("This program divides by ").list(all).text(", and holds where that is not 0.")
    }

    fn inertia_title(&self) -> String {
        "Inertia matrix".into()
    }

    fn velocity_torques_title(&self) -> String {
        "Centrifugal and Coriolis torques".into()
    }

    fn gravity_torques_title(&self) -> String {
        "Torques of gravity".into()
    }
}
