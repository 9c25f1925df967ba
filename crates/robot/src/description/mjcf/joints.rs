//! `<joint>` and `<freejoint>`: how a body moves on the one that carries it.

use super::super::JointKind;
use super::super::tree::{Joint, JointDrive, moved};
use super::super::urdf::{Draft, FAR};
use super::super::xml::{Element, Text, shown};
use super::bodies::{Context, Named};
use super::defaults::Resolved;
use super::keyframes::Slot;
use super::{Mjcf, truth};
use crate::geometry::{Rotation, Transform, Vector};
use denavit_symbolic::{Expr, Rational};
use std::ops::Range;

/// The attributes of a joint.
pub(super) const ATTRIBUTES: &[&str] = &[
    "name",
    "class",
    "type",
    "group",
    "pos",
    "axis",
    "springdamper",
    "solreflimit",
    "solimplimit",
    "solreffriction",
    "solimpfriction",
    "stiffness",
    "range",
    "limited",
    "actuatorfrcrange",
    "actuatorfrclimited",
    "actuatorgravcomp",
    "margin",
    "ref",
    "springref",
    "armature",
    "damping",
    "frictionloss",
    "user",
];

const TYPES: [&str; 4] = ["hinge", "slide", "ball", "free"];

/// A joint as it is read: in the frame of its body where the file shows it.
pub(super) struct Moving {
    name: Option<String>,
    kind: JointKind,
    point: Vector<Expr>,
    axis: Vector<Expr>,
    /// Its value there.
    reference: Expr,
    limits: Option<[Expr; 2]>,
    effort: Option<Expr>,
    drive: JointDrive,
    /// What a configuration has for it; nothing for what the joint before stands for, too.
    slot: Option<Slot>,
    span: Range<usize>,
}

fn shifted(by: Vector<Expr>) -> Transform<Expr> {
    Transform::from_rotation_translation(Rotation::identity(), by)
}

impl<'a> Mjcf<'a, '_> {
    /// The joints of a body in order, those in its frames among them.
    pub(super) fn joints_of(&mut self, body: Element<'a>, cx: &Context) -> Vec<Moving> {
        let mut all = vec![];
        let (mut free, mut turns) = (None, 0);
        let inside = |e: Element<'a>| e.children().collect::<Vec<_>>().into_iter().rev();
        let start = Context { frame: Transform::identity(), ..cx.clone() };
        let mut open: Vec<(Element<'a>, Context)> = inside(body).map(|e| (e, start.clone())).collect();
        while let Some((element, cx)) = open.pop() {
            match element.name() {
                Some("frame")
                    if element
                        .children()
                        .any(|c| matches!(c.name(), Some("joint" | "freejoint" | "frame"))) =>
                {
                    let inner = self.framed(element, &cx);
                    open.extend(inside(element).map(|e| (e, inner.clone())));
                }
                Some("freejoint") => {
                    element.only(&["name", "group", "align"], &mut self.reader.out);
                    free = free.or(Some(element.span()));
                }
                Some("joint") => {
                    element.only(ATTRIBUTES, &mut self.reader.out);
                    let models = self.models;
                    let joint = models[cx.model].classes.resolve(element, cx.class, &mut self.reader.out);
                    match joint
                        .get("type")
                        .map_or("hinge", |t| TYPES.into_iter().find(|n| *n == t.text).unwrap_or(""))
                    {
                        "free" => free = free.or(Some(element.span())),
                        "ball" => {
                            turns += 3;
                            all.extend(self.ball(&joint, &cx));
                        }
                        "" => self.unknown(&joint),
                        kind => {
                            turns += 1;
                            let kind =
                                if kind == "slide" { JointKind::Prismatic } else { JointKind::Revolute };
                            all.extend(self.joint(&joint, kind, &cx));
                        }
                    }
                }
                _ => {}
            }
        }
        if turns > 6 {
            self.reader
                .out
                .error(body.span(), format!("the joints of one body move it in {turns} ways; 6 there are"));
        }
        if let Some(span) = free {
            self.free(span, cx, all.is_empty());
        }
        all
    }

    fn unknown(&mut self, joint: &Resolved) {
        let Some(kind) = joint.get("type") else { return };
        let finding =
            self.reader.out.error(kind.span, format!("unknown type of joint `{}`", shown(kind.text)));
        match super::nearest(kind.text, TYPES) {
            Some(near) => finding.hint(format!("did you mean `{near}`?")),
            None => finding.hint(format!("types are {}", TYPES.join(", "))),
        }
    }

    /// A body that floats stays where it is.
    fn free(&mut self, span: Range<usize>, cx: &Context, is_alone: bool) {
        if cx.body != 0 {
            self.reader
                .out
                .error(span, "a body inside the robot floats: six free directions")
                .hint("a free joint stands in a body of the world");
        } else if !is_alone {
            self.reader.out.error(span, "a body with a free joint has no other joints");
        } else {
            self.reader.out.note(span, "a body that floats is taken as fixed where it stands");
            self.slots.push(Slot::Free);
        }
    }

    /// A hinge or a slide.
    fn joint(&mut self, joint: &Resolved, kind: JointKind, cx: &Context) -> Option<Moving> {
        let mut placing = self.placing(cx.model);
        let point = joint.get("pos").map_or(Vector::zero(), |p| placing.point(&p, "pos"));
        let z = Vector([0, 0, 1].map(Expr::int));
        let axis = joint.get("axis").map_or(Some(z), |a| placing.reader.direction(&a, "axis"));
        let reference = joint.get("ref").and_then(|text| {
            let (x, word) = placing.reader.numbers(&text, "ref", 1)?.remove(0);
            Some(match kind {
                JointKind::Revolute => placing.angle(x, &word),
                JointKind::Prismatic => placing.reader.length(x, &word),
            })
        });
        let reference = reference.unwrap_or(Expr::int(0));
        let limits = self.limits(joint, kind, cx);
        let effort =
            joint.get("actuatorfrcrange").and_then(|r| self.reader.numbers(&r, "actuatorfrcrange", 2));
        let drive = self.drive(joint);
        let effort = effort.map(|e| e[1].0.clone()).filter(|e| !e.is_negative() && !e.is_zero());
        Some(Moving {
            name: joint.own.attribute("name").map(|n| cx.name(n.text)),
            kind,
            point: cx.frame.act_on_point(point),
            axis: cx.frame.act_on_vector(axis?),
            reference,
            limits,
            effort: effort.map(Expr::from),
            drive,
            slot: Some(Slot::Joint(0)),
            span: joint.own.span(),
        })
    }

    /// Rotor and friction of a joint.
    fn drive(&mut self, joint: &Resolved) -> JointDrive {
        let is_spring = |t: &Text| t.words().iter().any(|w| w.text.parse() != Ok(0.0));
        if let Some(text) = joint.get("stiffness").filter(is_spring) {
            self.reader.out.warning(text.span, "springs of joints are not read");
        }
        let [rotor, viscous, coulomb] = ["armature", "damping", "frictionloss"].map(|name| {
            let text = joint.get(name)?;
            if text.words().len() > 1 {
                let message = format!("of `{name}` only one number is read: it is left");
                self.reader.out.warning(text.span, message);
                return None;
            }
            let x = self.reader.numbers(&text, name, 1)?.remove(0).0;
            if x.is_negative() {
                self.reader.out.warning(text.span, format!("`{name}` is negative: it is left"));
                return None;
            }
            Some(Expr::from(x)).filter(|e| !e.is_zero())
        });
        JointDrive { rotor, viscous, coulomb }
    }

    /// A ball as three turns.
    fn ball(&mut self, joint: &Resolved, cx: &Context) -> Vec<Moving> {
        let name = joint.own.attribute("name").map(|n| cx.name(n.text));
        let mut placing = self.placing(cx.model);
        let point = joint.get("pos").map_or(Vector::zero(), |p| placing.point(&p, "pos"));
        self.reader.out.note(joint.own.span(), "a ball is read as turns about x, y and z, without limits");
        let turn = |k: usize| Moving {
            name: name.as_ref().map(|n| format!("{n} {}", ["x", "y", "z"][k])),
            kind: JointKind::Revolute,
            point: cx.frame.act_on_point(point),
            axis: cx.frame.act_on_vector(Vector([0, 1, 2].map(|i| Expr::int(i64::from(i == k))))),
            reference: Expr::int(0),
            limits: None,
            effort: None,
            drive: JointDrive::default(),
            slot: (k == 0).then_some(Slot::Ball),
            span: joint.own.span(),
        };
        [0, 1, 2].map(turn).into()
    }

    fn limits(&mut self, joint: &Resolved, kind: JointKind, cx: &Context) -> Option<[Expr; 2]> {
        let automatic = self.models[cx.model].compiler.autolimits;
        let limited = joint.get("limited").filter(|l| l.text != "auto");
        let limited = limited.map(|l| truth(&l, self.reader).unwrap_or(false));
        let Some(range) = joint.get("range") else {
            if limited == Some(true) {
                self.reader.out.error(joint.own.span(), "a joint with limits that has no `range`");
            }
            return None;
        };
        let numbers = self.reader.numbers(&range, "range", 2)?;
        let is_range = numbers[0].0 < numbers[1].0;
        match limited {
            Some(false) => return None,
            Some(true) if !is_range => {
                self.reader.out.error(range.span, "the lower limit is not below the upper one");
                return None;
            }
            None if !automatic => {
                self.reader
                    .out
                    .error(range.span, "a `range` without `limited`")
                    .hint("write limited=\"true\": this model has autolimits=\"false\"");
                return None;
            }
            None if !is_range => {
                let is_none = numbers[0].0.is_zero() && numbers[1].0.is_zero();
                if !is_none {
                    self.reader
                        .out
                        .warning(range.span, "a `range` that ends where it begins or before is none");
                }
                return None;
            }
            _ => {}
        }
        let far = Rational::from(FAR);
        if numbers[0].0 < -far.clone() || numbers[1].0 > far {
            self.reader.out.note(range.span, format!("limits beyond {FAR} are read as none"));
            return None;
        }
        let degrees = self.models[cx.model].compiler.degrees;
        let mut ends = numbers.into_iter().map(|(x, _)| match kind {
            JointKind::Revolute if degrees => Expr::from(x * Rational::new(1, 180)) * Expr::pi(),
            _ => Expr::from(x),
        });
        Some([ends.next()?, ends.next()?])
    }

    /// Hangs a body on what carries it, by its joints.
    pub(super) fn hang(&mut self, body: usize, joints: Vec<Moving>, cx: &Context, span: Range<usize>) {
        let (mut parent, mut origin) = (cx.body, cx.frame);
        let last = joints.len().wrapping_sub(1);
        let mut is_there = false;
        for (k, joint) in joints.into_iter().enumerate() {
            let Moving { name, kind, point, axis, reference, limits, effort, drive, slot, span } = joint;
            let name = self.joint_name(name, &span);
            // The joint stands at its point; the body, seen from there, is back by it.
            is_there = k == last && point == Vector::zero();
            let between = format!("{} by {name}", self.links.bodies[body].name);
            let child =
                if is_there { Some(body) } else { self.link(between, Named::Made, None, span.clone()) };
            let (Some(child), Some(name)) = (child, Some(name)) else { return };
            let mut plain = Joint {
                name: name.clone(),
                kind: Some(kind),
                parent,
                child,
                origin: origin * shifted(point),
                axis,
                limits,
                velocity: None,
                effort,
                drive,
                follows: None,
            };
            plain.origin = plain.origin * moved(&plain, kind, -reference);
            self.joints.insert(name, self.drafts.len());
            self.references.insert(self.drafts.len(), reference);
            self.slots.extend(slot.map(|s| if s == Slot::Ball { s } else { Slot::Joint(self.drafts.len()) }));
            self.drafts.push(Draft { joint: plain, span, follows: None, is_floating: false });
            (parent, origin) = (child, shifted(-point));
        }
        if !is_there {
            self.fixed(parent, body, origin, span);
        }
    }

    /// The name of a joint; one that is given twice is reported.
    fn joint_name(&mut self, name: Option<String>, span: &Range<usize>) -> String {
        let given = name.filter(|n| !n.trim().is_empty());
        let is_given = given.is_some();
        let mut name = given.unwrap_or_else(|| format!("joint {}", self.joints.len() + 1));
        if is_given && let Some(&first) = self.joints.get(&name) {
            let message = format!("the joint `{}` is given twice", shown(&name));
            self.reader.out.error(span.clone(), message).hint("names are unique");
            let first = self.drafts[first].span.clone();
            self.reader.out.note(first, format!("the first joint `{}`", shown(&name)));
        }
        while self.joints.contains_key(&name) {
            name.push('_');
        }
        name
    }
}
