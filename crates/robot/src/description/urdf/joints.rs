//! `<joint>`: what stands on what, and how it moves.

use super::Links;
use crate::description::diagnostic::nearest;
use crate::description::reader::Reader;
use crate::description::tree::{Body, Joint, JointDrive};
use crate::description::xml::{Element, shown};
use crate::description::{JointKind, MAX_ROWS};
use crate::geometry::{Transform, Vector};
use denavit_symbolic::{Expr, Rational};
use std::collections::HashMap;
use std::ops::Range;

/// The types of joints.
const TYPES: [&str; 6] = ["revolute", "continuous", "prismatic", "fixed", "planar", "floating"];

/// Limits beyond this, radians or metres, stand for none.
pub(in crate::description) const FAR: i64 = 1_000_000;

/// A joint under way.
pub(in crate::description) struct Draft {
    pub joint: Joint,
    pub span: Range<usize>,
    /// The name of the joint that it follows, its factor and offset, and where it says so.
    pub follows: Option<(String, Rational, Expr, Range<usize>)>,
    pub is_floating: bool,
}

impl Draft {
    pub fn moves(&self) -> bool {
        self.joint.kind.is_some()
    }
}

impl Reader {
    pub(super) fn joints(&mut self, robot: Element, links: &mut Links) -> Vec<Draft> {
        let mut drafts = vec![];
        let mut seen: HashMap<String, Range<usize>> = HashMap::new();
        for joint in robot.all("joint") {
            joint.only(&["name", "type"], &mut self.out);
            let given = self.name_of(joint);
            let is_given = given.is_some();
            let name = given.unwrap_or_else(|| "?".into());
            if let Some(first) = seen.get(&name).filter(|_| is_given) {
                let first = first.clone();
                self.out
                    .error(joint.span(), format!("the joint `{}` is given twice", shown(&name)))
                    .hint("names are unique");
                self.out.note(first, format!("the first joint `{}`", shown(&name)));
            } else {
                seen.insert(name.clone(), joint.span());
            }
            self.joint(joint, name, links, &mut drafts);
        }
        drafts
    }

    fn joint(&mut self, joint: Element, name: String, links: &mut Links, drafts: &mut Vec<Draft>) {
        let known = [
            "origin",
            "parent",
            "child",
            "axis",
            "limit",
            "mimic",
            "dynamics",
            "calibration",
            "safety_controller",
        ];
        self.known(joint, &known);
        // Everything is read before anything is given up, so that all findings come at once.
        let origin = joint.one("origin", &mut self.out);
        let origin = self.origin(origin);
        let ends = ["parent", "child"].map(|end| self.end(joint, end, &name, links));
        let kind = self.kind(joint, &name);
        let moves = kind.is_some_and(|k| !matches!(k, "fixed" | "floating"));
        let axis = joint.one("axis", &mut self.out);
        let axis = if moves { self.axis(axis) } else { Vector([1, 0, 0].map(Expr::int)) };
        let limit = joint.one("limit", &mut self.out);
        let (limits, velocity, effort) = match kind {
            Some(kind @ ("revolute" | "prismatic" | "continuous")) => self.limits(joint, limit, kind, &name),
            _ => (None, None, None),
        };
        let drive = if moves && kind != Some("planar") { self.drive(joint) } else { JointDrive::default() };
        let follows = joint.one("mimic", &mut self.out).filter(|_| moves).and_then(|m| self.mimic(m, kind));
        let [Some(parent), Some(child)] = ends else {
            self.is_part = true;
            return;
        };
        // One of an unknown kind, which was said, joins links as well.
        let kind = kind.unwrap_or("fixed");
        let moved = match kind {
            "revolute" | "continuous" => Some(JointKind::Revolute),
            "prismatic" => Some(JointKind::Prismatic),
            _ => None,
        };
        let is_floating = kind == "floating";
        let span = joint.span();
        let plain = Joint {
            name,
            kind: moved,
            parent,
            child,
            origin,
            axis,
            limits,
            velocity,
            effort,
            drive,
            follows: None,
        };
        if kind == "planar" {
            self.out.note(span.clone(), "a planar joint is read as two slides and a turn");
            planar(&plain, &span, links, drafts);
        } else {
            drafts.push(Draft { joint: plain, span, follows, is_floating });
        }
    }

    /// False, and said, if there are too many joints that move.
    pub(in crate::description) fn has_few_joints(&mut self, drafts: &[Draft]) -> bool {
        let moving = drafts.iter().filter(|d| d.moves()).count();
        if let Some(first) = drafts.iter().filter(|d| d.moves()).nth(MAX_ROWS) {
            let message = format!("{moving} moving joints; {MAX_ROWS} are allowed: this is one more");
            self.out.error(first.span.clone(), message);
        }
        moving <= MAX_ROWS
    }

    /// The link at an end of a joint.
    fn end(&mut self, joint: Element, end: &'static str, name: &str, links: &mut Links) -> Option<usize> {
        let element = joint.one(end, &mut self.out);
        let link = element.and_then(|e| {
            e.only(&["link"], &mut self.out);
            e.attribute("link")
        });
        let Some(link) = link else {
            self.out.error(joint.span(), format!("the joint `{}` has no <{end} link=\"…\"/>", shown(name)));
            return None;
        };
        let known = super::plain(link.text);
        if let Some(&body) = links.by_name.get(&known) {
            return Some(body);
        }
        if known == "world" && end == "parent" {
            self.out
                .warning(link.span.clone(), "the link `world` is not declared; it is taken as the ground");
            return Some(links.add(known, None, link.span));
        }
        let is_full = self.out.is_full();
        let finding = self.out.error(link.span.clone(), format!("there is no link `{}`", shown(link.text)));
        if is_full {
            return None;
        }
        if let Some(near) = nearest(&known, links.bodies.iter().map(|b| b.name.as_str())) {
            finding.hint(format!("did you mean `{near}`?"));
        }
        None
    }

    fn kind(&mut self, joint: Element, name: &str) -> Option<&'static str> {
        let Some(kind) = joint.attribute("type") else {
            self.out
                .error(joint.span(), format!("the joint `{}` has no type", shown(name)))
                .hint(format!("types are {}", TYPES.join(", ")));
            return None;
        };
        let known = TYPES.into_iter().find(|t| *t == kind.text);
        if known.is_none() {
            let finding = self.out.error(kind.span, format!("unknown type of joint `{}`", shown(kind.text)));
            match nearest(kind.text, TYPES) {
                _ if matches!(kind.text, "ball" | "spherical") => {
                    finding.hint("write three revolute joints whose axes meet");
                }
                Some(near) => finding.hint(format!("did you mean `{near}`?")),
                None => finding.hint(format!("types are {}", TYPES.join(", "))),
            }
        }
        known
    }

    /// Limits, speed and effort.
    fn limits(
        &mut self,
        joint: Element,
        limit: Option<Element>,
        kind: &str,
        name: &str,
    ) -> (Option<[Expr; 2]>, Option<Expr>, Option<Expr>) {
        let Some(limit) = limit else {
            if kind != "continuous" {
                let message = format!("the {kind} joint `{}` has no <limit>", shown(name));
                self.out.warning(joint.span(), message).hint("it is read as without limits");
            }
            return (None, None, None);
        };
        limit.only(
            &["lower", "upper", "velocity", "effort", "acceleration", "deceleration", "jerk"],
            &mut self.out,
        );
        let ends = ["lower", "upper"].map(|n| self.end_of_range(&limit, n));
        let [velocity, effort] = ["velocity", "effort"].map(|n| self.end_of_range(&limit, n).flatten());
        let positive = |x: Option<Rational>| x.filter(|x| !x.is_negative() && !x.is_zero()).map(Expr::from);
        let (velocity, effort) = (positive(velocity), positive(effort));
        if kind == "continuous" {
            if ends.iter().flatten().flatten().next().is_some() {
                self.out
                    .note(limit.span(), "a continuous joint has no limits: `lower` and `upper` are skipped");
            }
            return (None, velocity, effort);
        }
        let is_open = ends.each_ref().map(|end| *end == Some(None));
        if is_open.contains(&true) {
            if is_open != [true; 2] {
                let message = format!("`{}` has a limit on one side, which is left out", shown(name));
                self.out.warning(limit.span(), message).hint("a large number is an end, too");
            }
            return (None, velocity, effort);
        }
        let given = ["lower", "upper"].map(|n| limit.attribute(n).is_some());
        let is_wrong = [0, 1].iter().any(|&i| given[i] != ends[i].is_some());
        let [lower, upper] = ends.map(|end| end.flatten().unwrap_or_default());
        if lower > upper {
            let message = format!("the lower limit of `{}` is above the upper one", shown(name));
            self.out.warning(limit.span(), message).hint("it is read as without limits, as Bullet takes it");
            return (None, velocity, effort);
        }
        let far = Rational::from(FAR);
        if lower < -far.clone() || upper > far {
            self.out.note(limit.span(), format!("limits beyond {FAR} are read as none"));
            return (None, velocity, effort);
        }
        if lower == upper && !is_wrong {
            self.out
                .warning(limit.span(), format!("the limits of `{}` leave it no way to move", shown(name)));
        }
        self.safety(joint, &lower, &upper);
        (Some([lower.into(), upper.into()]), velocity, effort)
    }

    /// A number that may be missing, or that is infinite (`inf`, `-INF`, as programs print it): no end then.
    fn end_of_range(&mut self, limit: &Element, name: &str) -> Option<Option<Rational>> {
        let value = limit.attribute(name)?;
        let word = value.text.trim().trim_start_matches(['+', '-']).to_ascii_lowercase();
        if matches!(word.as_str(), "inf" | "infinity" | ".inf") {
            return Some(None);
        }
        self.any_number(limit, name).map(Some)
    }

    /// Friction: `damping` is viscous, `friction` is Coulomb's.
    fn drive(&mut self, joint: Element) -> JointDrive {
        let Some(dynamics) = joint.one("dynamics", &mut self.out) else { return JointDrive::default() };
        let [viscous, coulomb] = ["damping", "friction"].map(|name| {
            let x = self.any_number(&dynamics, name).filter(|x| !x.is_zero())?;
            if x.is_negative() {
                self.out.warning(dynamics.span(), format!("`{name}` is negative: it is left"));
                return None;
            }
            Some(Expr::from(x))
        });
        JointDrive { rotor: None, viscous, coulomb }
    }

    /// Says so where soft limits are narrower than the limits.
    fn safety(&mut self, joint: Element, lower: &Rational, upper: &Rational) {
        let Some(safety) = joint.one("safety_controller", &mut self.out) else { return };
        let [low, high] = ["soft_lower_limit", "soft_upper_limit"].map(|n| self.any_number(&safety, n));
        if low.is_some_and(|x| x > *lower) || high.is_some_and(|x| x < *upper) {
            self.out.note(safety.span(), "the soft limits are narrower than the limits, which count");
        }
    }

    fn mimic(
        &mut self,
        mimic: Element,
        kind: Option<&str>,
    ) -> Option<(String, Rational, Expr, Range<usize>)> {
        mimic.only(&["joint", "multiplier", "offset"], &mut self.out);
        let factor = self.number(&mimic, "multiplier").unwrap_or(Rational::ONE);
        let offset = mimic.attribute("offset").and_then(|value| {
            let (x, word) = self.numbers(&value, "offset", 1)?.remove(0);
            Some(if kind == Some("prismatic") { self.length(x, &word) } else { self.angle(x, &word) })
        });
        let Some(joint) = mimic.attribute("joint") else {
            self.out.error(mimic.span(), "a <mimic> without `joint`");
            return None;
        };
        Some((super::plain(joint.text), factor, offset.unwrap_or(Expr::int(0)), joint.span))
    }
}

/// Two slides across the axis and a turn about it, with bodies of their own between.
fn planar(joint: &Joint, span: &Range<usize>, links: &mut Links, drafts: &mut Vec<Draft>) {
    let size = |i: usize| joint.axis[i].eval(|_| None).unwrap_or(0.0).abs();
    let least = (0..3).min_by(|&i, &j| size(i).total_cmp(&size(j))).unwrap_or(0);
    let beside = Vector([0, 1, 2].map(|i| Expr::int(i64::from(i == least))));
    // About z these are x and y.
    let second = joint.axis.cross(beside);
    let first = second.cross(joint.axis);
    let mut parent = joint.parent;
    for (suffix, axis, kind) in [
        ("x", first, JointKind::Prismatic),
        ("y", second, JointKind::Prismatic),
        ("turn", joint.axis, JointKind::Revolute),
    ] {
        let name = format!("{} {suffix}", joint.name);
        let child = if suffix == "turn" { joint.child } else { links.bodies.len() };
        if suffix != "turn" {
            links.bodies.push(Body { name: name.clone(), mass: None, is_unweighed: false, looks: vec![] });
            links.spans.push(span.clone());
        }
        let origin = if suffix == "x" { joint.origin } else { Transform::identity() };
        let part = Joint { name, kind: Some(kind), parent, child, origin, axis, ..joint.clone() };
        drafts.push(Draft { joint: part, span: span.clone(), follows: None, is_floating: false });
        parent = child;
    }
}
