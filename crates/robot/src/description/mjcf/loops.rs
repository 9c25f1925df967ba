//! `<connect>` and `<weld>`: closed loops, and `<actuator>`: what drives them.

use super::super::diagnostic::nearest;
use super::super::tree::{Hold, Keeps, moved};
use super::super::urdf::plain;
use super::super::xml::{Element, Text, shown};
use super::Mjcf;
use super::bodies::Named;
use crate::geometry::{Rotation, Transform, Vector};
use denavit_symbolic::{Expr, readable};

const CONNECT: &[&str] =
    &["name", "class", "active", "body1", "body2", "anchor", "site1", "site2", "solref", "solimp"];
const WELD: &[&str] = &[
    "name",
    "class",
    "active",
    "body1",
    "body2",
    "relpose",
    "anchor",
    "site1",
    "site2",
    "torquescale",
    "solref",
    "solimp",
];

/// What names a place that is held.
struct Ends {
    bodies: [usize; 2],
    are_sites: bool,
}

impl<'a> Mjcf<'a, '_> {
    /// The bodies in the world where the file shows the model.
    pub(super) fn shown(&self) -> Vec<Transform<Expr>> {
        let count = self.links.bodies.len();
        let mut to = vec![None; count];
        self.drafts.iter().enumerate().for_each(|(k, d)| to[d.joint.child] = Some(k));
        let mut poses: Vec<Option<Transform<Expr>>> = vec![None; count];
        for body in 0..count {
            // The way up to what is placed already.
            let mut way = vec![];
            let mut at = body;
            while poses[at].is_none() {
                let Some(k) = to[at] else { break };
                way.push(k);
                at = self.drafts[k].joint.parent;
            }
            let mut pose = poses[at].unwrap_or_else(Transform::identity);
            poses[at] = Some(pose);
            for k in way.into_iter().rev() {
                let joint = &self.drafts[k].joint;
                pose = pose * joint.origin;
                if let (Some(kind), Some(value)) = (joint.kind, self.references.get(&k)) {
                    pose = pose * moved(joint, kind, *value);
                }
                pose = pose.map(readable::settled);
                poses[joint.child] = Some(pose);
            }
        }
        poses.into_iter().map(|p| p.unwrap_or_else(Transform::identity)).collect()
    }

    /// A loop that an element closes; nothing of one that is refused, which is said.
    pub(super) fn hold(
        &mut self,
        element: Element<'a>,
        full: &dyn Fn(&str) -> String,
        model: usize,
        shown: &[Transform<Expr>],
    ) -> Option<Hold> {
        let is_weld = element.name() == Some("weld");
        element.only(if is_weld { WELD } else { CONNECT }, &mut self.reader.out);
        let Ends { bodies, are_sites } = self.ends(element, full, model)?;
        let [a, b] = bodies;
        if bodies.iter().any(|body| self.mocap.contains(body)) {
            let message = "what a body for motion capture pulls is no closed loop, and is left";
            self.reader.out.note(element.span(), message);
            return None;
        }
        let seen = |place: Transform<Expr>| (shown[b].inverse() * shown[a] * place).map(readable::settled);
        let identity = Transform::identity();
        let (places, keeps) = if are_sites {
            ([identity; 2], if is_weld { Keeps::Frame } else { Keeps::Point })
        } else if is_weld {
            // Where the one stands in the other: where the file shows it, or where it is said to.
            let place = self.relative(element, model)?;
            let first = place.unwrap_or_else(|| (shown[a].inverse() * shown[b]).map(readable::settled));
            ([first, identity], Keeps::Frame)
        } else {
            let Some(anchor) = element.attribute("anchor") else {
                self.reader.out.error(element.span(), "a <connect> of bodies without `anchor`");
                return None;
            };
            let point = self.placing(model).point(&anchor, "anchor");
            let place = Transform::from_rotation_translation(Rotation::identity(), point);
            ([place, seen(place)], Keeps::Point)
        };
        if a == b {
            self.reader.out.error(element.span(), "this holds a body to itself");
            return None;
        }
        let name = element.attribute("name").map(|n| full(n.text)).filter(|n| !n.trim().is_empty());
        Some(Hold { name, bodies, places, keeps, span: element.span() })
    }

    /// `relpose`: a place and a quaternion, where the quaternion is not 0.
    #[expect(clippy::option_option, reason = "none is an error, and a place that is not said is none")]
    fn relative(&mut self, element: Element<'a>, model: usize) -> Option<Option<Transform<Expr>>> {
        let Some(text) = element.attribute("relpose") else { return Some(None) };
        let words = text.words();
        if words.len() != 7 {
            self.reader.out.error(text.span, "`relpose` is seven numbers: a place and a quaternion");
            return None;
        }
        if words[3..].iter().all(|w| w.text.parse() == Ok(0.0)) {
            return Some(None);
        }
        let mut point = self.reader.numbers(&text, "relpose", 7)?;
        let turn = point.split_off(3);
        let point: Vec<Expr> = point.into_iter().map(|(x, word)| self.reader.length(x, &word)).collect();
        let rotation = self.placing(model).of_quaternion(&text, turn)?;
        let place: [Expr; 3] = point.try_into().ok()?;
        Some(Some(Transform::from_rotation_translation(rotation, Vector(place))))
    }

    /// The bodies, or the sites, that an element holds together.
    fn ends(&mut self, element: Element<'a>, full: &dyn Fn(&str) -> String, model: usize) -> Option<Ends> {
        let sites = ["site1", "site2"].map(|name| element.attribute(name));
        if let [Some(first), Some(second)] = &sites {
            let found = [first, second].map(|name| self.site_of(name, full, model));
            let [Some(a), Some(b)] = found else { return None };
            return Some(Ends { bodies: [a, b], are_sites: true });
        }
        let Some(first) = element.attribute("body1") else {
            let message = format!("a <{}> without `body1`, or without two sites", shown(element.full_name()));
            self.reader.out.error(element.span(), message);
            return None;
        };
        let second = element.attribute("body2");
        let a = self.body_of(&first, full, model);
        let b = second.map_or(Some(0), |name| self.body_of(&name, full, model));
        Some(Ends { bodies: [a?, b?], are_sites: false })
    }

    fn body_of(&mut self, name: &Text, full: &dyn Fn(&str) -> String, model: usize) -> Option<usize> {
        let wanted = if name.text == "world" { "world".to_string() } else { full(name.text) };
        let found = self.links.by_name.get(&wanted).copied().filter(|&b| self.named[b] == Named::ByFile);
        self.missing(found, Named::ByFile, name, model)
    }

    fn site_of(&mut self, name: &Text, full: &dyn Fn(&str) -> String, model: usize) -> Option<usize> {
        let wanted = full(name.text);
        let renamed = self.renamed.iter().find(|r| r.1 == wanted).map_or(&wanted, |r| &r.2);
        let found = self.links.by_name.get(renamed).copied().filter(|&b| self.named[b] == Named::Site);
        self.missing(found, Named::Site, name, model)
    }

    /// Says what is not there, unless the model is a part of which not all is there.
    fn missing(&mut self, found: Option<usize>, kind: Named, name: &Text, model: usize) -> Option<usize> {
        if found.is_none() && model == 0 {
            let what = if kind == Named::Site { "site" } else { "body" };
            let message = format!("there is no {what} `{}`", shown(name.text));
            let all = self.links.bodies.iter().zip(&self.named).filter(|(_, k)| **k == kind);
            let near = nearest(name.text, all.map(|(b, _)| b.name.as_str()));
            let finding = self.reader.out.error(name.span.clone(), message);
            if let Some(near) = near {
                finding.hint(format!("did you mean `{near}`?"));
            }
        }
        found
    }

    /// The joints that actuators drive.
    pub(super) fn driven(&self, parts: &[(usize, String, String)]) -> Vec<String> {
        let mut all = vec![];
        for (model, prefix, suffix) in parts {
            for actuator in self.models[*model].root.all("actuator").flat_map(|a| a.children()) {
                for attribute in ["joint", "jointinparent"] {
                    let Some(text) = actuator.attribute(attribute) else { continue };
                    let name = format!("{prefix}{}{suffix}", plain(text.text));
                    if self.joints.contains_key(&name) {
                        all.push(name);
                    }
                }
            }
        }
        all
    }
}
