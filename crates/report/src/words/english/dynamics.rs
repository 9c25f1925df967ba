//! Dynamics.

use super::{English, counted};
use crate::tree::{Line, Math};
use crate::words::{Dynamics, Terms};
use denavit::dynamics::{Gives, Ground, Minimality};
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

    fn kept(&self, all: Vec<Math>) -> Line {
        Line::new("As asked, these stand for what is grouped with them: ").list(all).text(".")
    }

    fn dropped(&self, all: Vec<Math>) -> Line {
        Line::new("As asked, others stand in the place of ").list(all).text(".")
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

    fn bodies_title(&self) -> String {
        "Bodies".into()
    }

    fn bodies(&self) -> String {
        "A link is all that moves with one axis. Its frame has its z along the axis; frame 0 is the base. What is constant between two \
         axes and the motion of the second make the transforms:"
            .into()
    }

    fn grouping(&self) -> String {
        "A mass on the axis of a joint that turns is at rest in both links that the joint joins, so that the torques are the same with \
         whichever it is counted. From the tip to the base, each link gives to the one before all that may be counted there:"
            .into()
    }

    fn gives(&self, link: usize, gives: Gives) -> String {
        let (k, to) = (link, if link == 1 { "the base".to_string() } else { format!("link {}", link - 1) });
        match gives {
            Gives::OnAxis => format!(
                "link {k} turns: it gives M{k}, MZ{k} and YY{k} (as a second moment along its axis) to {to}, and keeps XX{k} − YY{k}, \
                 XY{k}, XZ{k}, YZ{k}, ZZ{k}, MX{k}, MY{k}, with what it was given"
            ),
            Gives::Nothing => format!(
                "link {k} turns, and has a mass for each direction: it gives nothing, and keeps what it was given"
            ),
            Gives::Inertia => format!(
                "link {k} slides: it turns with {to}, which takes its inertia; it keeps M{k}, MX{k}, MY{k}, MZ{k}, with what it was given"
            ),
            Gives::Across => format!(
                "link {k} slides: it turns with {to}, which takes its inertia; it keeps M{k}, MX{k}, MY{k}, MZ{k}, with what it was given, \
                 but for a first moment along the direction of all turns before it, which has no effect"
            ),
            Gives::Plan => format!(
                "link {k} slides along the direction of all turns before it: {to} takes everything but its mass along that direction"
            ),
        }
    }

    fn outward_title(&self) -> String {
        "Outward: how the links move".into()
    }

    fn outward(&self) -> String {
        "In the frame of each link: w is its angular velocity, wd the rate of that, a the acceleration of the frame's origin less that \
         of gravity. With the rotation R into the frame from that of the link before, whose values have the index p, and the \
         place r of the frame there: w = R wp, wd = R wdp, a = R(ap + Up r); a joint that turns adds z qd to w, and z qdd + w × z qd \
         (with w before) to wd; one that slides adds z qdd + 2 w × z qd to a. U = [wd]× + [w]×[w]×: a point of the link at r accelerates \
         with a + U r. What is 0, or another value itself, has no name."
            .into()
    }

    fn link(&self, link: usize) -> String {
        format!("Link {link}")
    }

    fn link_of_tree(&self, link: usize, joint: &str, parent: Option<usize>) -> String {
        match parent {
            Some(parent) => format!("Link {link}: behind joint {joint}, on link {parent}."),
            None => format!("Link {link}: behind joint {joint}, on the root."),
        }
    }

    fn motion_ground(&self, ground: Ground) -> String {
        match ground {
            Ground::Proved => {
                "Proved: w, wd and a are those of the product of the transforms, by its derivatives.".into()
            }
            Ground::Modulo(states) => format!(
                "Not proved in general: w, wd and a are exactly equal to derivatives of the product of the transforms at {states} random \
                 states modulo a prime of 61 bits."
            ),
            Ground::Numbers(states, off) => format!(
                "Not proved: w, wd and a are derivatives of the product of the transforms within {off:.0e} in {states} states."
            ),
            Ground::Failed => {
                "Not the derivatives of the product of the transforms: this is a defect of the program."
                    .into()
            }
        }
    }

    fn inward_title(&self) -> String {
        "Inward: what moves them".into()
    }

    fn inward(&self) -> String {
        "From the tip to the base, about the origin of each frame: f is the force and n the moment that move the link and all behind it. \
         For the link alone, in base parameters, they are M a + U MS and J wd + w × J w + MS × a; what moves the links behind it is added, \
         carried into its frame. The torque of a joint that turns is the moment about its z, that of one that slides the force \
         along it."
            .into()
    }

    fn short_title(&self) -> String {
        "The short program".into()
    }

    fn short(&self) -> String {
        "Of the same recursion many forms are possible: axes that are parallel taken together, a link's motion and wrench in this or \
         that frame, mass on the axes counted here or there, a length as the unit. The shortest that was found by search, in place of \
         the one above (`--symbolic` prints it):"
            .into()
    }
}
