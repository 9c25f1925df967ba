//! Bodies, frames, sites, and what repeats them.

use super::super::diagnostic::nearest;
use super::super::tree::{Joint, JointDrive, Mass};
use super::super::urdf::{Draft, plain};
use super::super::xml::{Element, shown};
use super::Mjcf;
use super::defaults::Resolved;
use super::geoms::FromGeoms;
use crate::geometry::{Transform, Vector};
use denavit_symbolic::{Expr, Rational};
use std::ops::Range;
use std::rc::Rc;

/// How many elements are gone through, repeated ones each time.
const MAX_WORK: usize = 400_000;
/// How many elements `<replicate>` makes.
const MAX_REPEATED: usize = 20_000;
/// How many bodies and sites there may be.
const MAX_BODIES: usize = 5000;
/// How often a `<replicate>` repeats what stands in it.
const MAX_COUNT: i64 = 1000;

const TURN: [&str; 6] = ["pos", "quat", "axisangle", "xyaxes", "zaxis", "euler"];
const BODY: &[&str] = &[
    "name",
    "childclass",
    "mocap",
    "gravcomp",
    "user",
    "sleep",
    "pos",
    "quat",
    "axisangle",
    "xyaxes",
    "zaxis",
    "euler",
];
const FRAME: &[&str] = &["name", "childclass", "pos", "quat", "axisangle", "xyaxes", "zaxis", "euler"];
/// The attributes of a site.
pub(super) const SITE: &[&str] = &[
    "name",
    "class",
    "pos",
    "quat",
    "axisangle",
    "xyaxes",
    "zaxis",
    "euler",
    "type",
    "group",
    "material",
    "size",
    "fromto",
    "rgba",
    "user",
];

/// How a body got its name.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Named {
    /// It is a body of the file.
    ByFile,
    /// It is a site.
    Site,
    /// It has none in the file.
    Made,
}

/// Where an element stands.
#[derive(Clone)]
pub(super) struct Context {
    pub model: usize,
    pub class: Option<usize>,
    /// The body that it hangs on, and where.
    pub body: usize,
    pub frame: Transform<Expr>,
    /// What stands before and behind the names.
    pub prefix: Rc<str>,
    pub suffix: Rc<str>,
    /// The models that are being attached.
    pub attached: Rc<[usize]>,
    /// True between a `<replicate>` and the next body.
    pub is_repeated: bool,
}

impl Context {
    pub fn world() -> Self {
        Context {
            model: 0,
            class: None,
            body: 0,
            frame: Transform::identity(),
            prefix: "".into(),
            suffix: "".into(),
            attached: Rc::new([0]),
            is_repeated: false,
        }
    }

    /// A name of the file as it is in the whole.
    pub fn name(&self, name: &str) -> String {
        format!("{}{}{}", self.prefix, plain(name), self.suffix)
    }
}

impl<'a> Mjcf<'a, '_> {
    /// Elements to go through next, the first one first.
    pub(super) fn push(&mut self, elements: impl Iterator<Item = Element<'a>>, cx: &Context) {
        let from = self.open.len();
        self.open.extend(elements.map(|e| (e, cx.clone())));
        self.open[from..].reverse();
    }

    pub(super) fn walk(&mut self) {
        while let Some((element, cx)) = self.open.pop() {
            if !self.works(1, &element) {
                return;
            }
            match element.name() {
                Some("body") => self.body(element, &cx),
                Some("frame") => {
                    element.only(FRAME, &mut self.reader.out);
                    let inner = self.framed(element, &cx);
                    self.push(element.children(), &inner);
                }
                Some("replicate") => self.replicate(element, &cx),
                Some("attach") => self.attach(element, &cx),
                Some("site") => self.site(element, &cx),
                Some("joint" | "freejoint") => {
                    // Those of a body and its frames are read with it.
                    if cx.body == 0 || cx.is_repeated {
                        let what =
                            if cx.is_repeated { "a joint in a <replicate>" } else { "a joint of the world" };
                        self.reader.out.error(element.span(), format!("{what} moves nothing"));
                    }
                }
                Some("geom") => self.geom(element, &cx),
                Some("camera" | "light" | "inertial" | "plugin") => {}
                Some(name @ ("composite" | "flexcomp")) => {
                    let message = format!("<{name}> is not read: the bodies that it makes are left out");
                    self.reader.out.warning(element.span(), message);
                }
                _ if self.reader.out.is_full() => {}
                _ => {
                    let name = element.full_name();
                    let message = format!("<{}> is unknown here: it is skipped", shown(name));
                    let finding = self.reader.out.warning(element.span(), message);
                    let known = [
                        "body",
                        "joint",
                        "freejoint",
                        "frame",
                        "site",
                        "geom",
                        "inertial",
                        "replicate",
                        "attach",
                    ];
                    if let Some(near) = nearest(name, known) {
                        finding.hint(format!("did you mean <{near}>?"));
                    }
                }
            }
        }
    }

    /// Counts work; false, and said once, if there is too much of it.
    pub(super) fn works(&mut self, steps: usize, element: &Element) -> bool {
        let before = self.work;
        self.work = self.work.saturating_add(steps);
        if self.work > MAX_WORK && before <= MAX_WORK {
            self.reader.out.error(
                element.span(),
                format!("more than {MAX_WORK} elements, those repeated counted each time"),
            );
        }
        if self.work > MAX_WORK {
            self.open.clear();
        }
        self.work <= MAX_WORK
    }

    /// The context inside an element that has a frame and perhaps a class for what stands in it.
    pub(super) fn framed(&mut self, element: Element<'a>, cx: &Context) -> Context {
        let bare = Resolved::bare(element);
        let pose = self.placing(cx.model).pose(&bare);
        let class = element.attribute("childclass");
        let found = class.and_then(|name| self.models[cx.model].classes.find(&name, &mut self.reader.out));
        Context { frame: cx.frame * pose, class: found.or(cx.class), ..cx.clone() }
    }

    fn body(&mut self, element: Element<'a>, cx: &Context) {
        element.only(BODY, &mut self.reader.out);
        let inner = self.framed(element, cx);
        let given = self.inertial_of(element, cx);
        let has_inertial = given.is_some();
        let mass = given.and_then(|(e, frame)| self.mass(e, frame, cx.model));
        let gravcomp = element.attribute("gravcomp").filter(|g| g.text.trim().parse() != Ok(0.0));
        if let Some(text) = gravcomp {
            self.reader.out.warning(text.span, "`gravcomp` is not read: the body has its weight here");
        }
        let from_geoms = match self.models[cx.model].from_geoms {
            FromGeoms::Never => false,
            FromGeoms::Missing => !has_inertial,
            FromGeoms::Always => true,
        };
        let is_mocap = element.attribute("mocap").is_some_and(|m| m.text == "true");
        if is_mocap {
            self.reader
                .out
                .note(element.span(), "a body for motion capture is taken as fixed where it stands");
        }
        let name = element.attribute("name").map(|n| cx.name(n.text)).filter(|n| !n.trim().is_empty());
        let kind = if name.is_some() { Named::ByFile } else { Named::Made };
        let name = name.unwrap_or_else(|| format!("body {}", self.links.bodies.len()));
        let mass = mass.filter(|_| self.models[cx.model].from_geoms != FromGeoms::Always);
        let Some(body) = self.link(name, kind, mass, element.span()) else { return };
        if is_mocap {
            self.mocap.push(body);
        }
        self.from_geoms.insert(body, from_geoms);
        self.model_of.insert(body, cx.model);
        let joints = self.joints_of(element, &inner);
        self.hang(body, joints, &inner, element.span());
        let identity = Transform::identity();
        let inner = Context { body, frame: identity, is_repeated: false, ..inner };
        self.push(element.children(), &inner);
    }

    /// A body; nothing if it cannot be added, which is said.
    pub(super) fn link(
        &mut self,
        mut name: String,
        kind: Named,
        mass: Option<Mass>,
        span: Range<usize>,
    ) -> Option<usize> {
        if self.links.bodies.len() >= MAX_BODIES {
            if self.work <= MAX_WORK {
                self.reader.out.error(span, format!("more than {MAX_BODIES} bodies and sites"));
            }
            self.work = MAX_WORK + 1;
            self.open.clear();
            return None;
        }
        if let Some(&first) = self.links.by_name.get(&name) {
            match (self.named[first], kind) {
                (Named::ByFile, Named::ByFile) | (Named::Site, Named::Site) => {
                    let what = if kind == Named::Site { "site" } else { "body" };
                    let message = format!("the {what} `{}` is given twice", shown(&name));
                    self.reader.out.error(span.clone(), message).hint("names are unique");
                    let first = self.links.spans[first].clone();
                    self.reader.out.note(first, format!("the first {what} `{}`", shown(&name)));
                    // What stands in it is read as well.
                    name = self.like(&name, kind);
                }
                (Named::Site | Named::Made, Named::ByFile) | (Named::Made, Named::Site) => {
                    let other = self.like(&name, self.named[first]);
                    if self.named[first] == Named::Site {
                        self.renamed.push((self.links.spans[first].clone(), name.clone(), other.clone()));
                    }
                    self.links.by_name.remove(&name);
                    self.links.by_name.insert(other.clone(), first);
                    self.links.bodies[first].name = other;
                }
                _ => {
                    let other = self.like(&name, kind);
                    if kind == Named::Site {
                        self.renamed.push((span.clone(), name.clone(), other.clone()));
                    }
                    name = other;
                }
            }
        }
        self.named.push(kind);
        Some(self.links.add(name, mass, span))
    }

    /// Says what sites are called otherwise here, once for all of them.
    pub(super) fn say_renamed(&mut self) {
        let renamed = std::mem::take(&mut self.renamed);
        let Some((span, name, other)) = renamed.first() else { return };
        let message = match &renamed[..] {
            [_] => {
                format!("the site `{}` is called `{}` here: a body has its name", shown(name), shown(other))
            }
            all => {
                let names = all.iter().take(4).map(|r| format!("`{}`", shown(&r.2)));
                let more = if all.len() > 4 { ", …" } else { "" };
                let names = names.collect::<Vec<_>>().join(", ");
                format!("{} sites have the names of bodies: they are called {names}{more} here", all.len())
            }
        };
        self.reader.out.note(span.clone(), message);
    }

    /// A name like one that is taken.
    fn like(&self, name: &str, kind: Named) -> String {
        let mut found = if kind == Named::Site { format!("{name}_site") } else { format!("{name}_") };
        while self.links.by_name.contains_key(&found) {
            found.push('_');
        }
        found
    }

    /// A body that hangs on another without a joint.
    pub(super) fn fixed(&mut self, parent: usize, child: usize, origin: Transform<Expr>, span: Range<usize>) {
        let joint = Joint {
            name: String::new(),
            kind: None,
            parent,
            child,
            origin,
            axis: Vector([0, 0, 1].map(Expr::int)),
            limits: None,
            velocity: None,
            effort: None,
            drive: JointDrive::default(),
            follows: None,
        };
        self.drafts.push(Draft { joint, span, follows: None, is_floating: false });
    }

    /// Gives joints that do not move names that no other has.
    pub(super) fn name_fixed(&mut self) {
        for k in 0..self.drafts.len() {
            if self.drafts[k].joint.name.is_empty() {
                let mut name = format!("{} fixed", self.links.bodies[self.drafts[k].joint.child].name);
                while self.joints.contains_key(&name) {
                    name.push('_');
                }
                self.drafts[k].joint.name = name;
            }
        }
    }

    /// A named frame.
    fn site(&mut self, element: Element<'a>, cx: &Context) {
        element.only(SITE, &mut self.reader.out);
        let Some(name) = element.attribute("name").map(|n| cx.name(n.text)).filter(|n| !n.trim().is_empty())
        else {
            return;
        };
        let models = self.models;
        let at = models[cx.model].classes.resolve(element, cx.class, &mut self.reader.out);
        let mut pose = self.placing(cx.model).pose(&at);
        if let Some(ends) = at.get("fromto") {
            if let Some(pos) = at.get("pos") {
                self.reader.out.error(pos.span, "both `pos` and `fromto` say where a site is");
            }
            let mut placing = self.placing(cx.model);
            let Some(pose_of_ends) = placing.between(&ends) else { return };
            pose = pose_of_ends;
        }
        let Some(site) = self.link(name, Named::Site, None, element.span()) else { return };
        self.fixed(cx.body, site, cx.frame * pose, element.span());
    }

    fn replicate(&mut self, element: Element<'a>, cx: &Context) {
        element.only(&["count", "offset", "euler", "sep", "childclass"], &mut self.reader.out);
        let Some(text) = element.attribute("count") else {
            self.reader.out.error(element.span(), "a <replicate> without `count`");
            return;
        };
        let count = text.text.trim().parse::<i64>().ok().filter(|n| (1..=MAX_COUNT).contains(n));
        let Some(count) = count else {
            let message = format!("`count` is a number from 1 to {MAX_COUNT}, not `{}`", shown(text.text));
            self.reader.out.error(text.span, message);
            return;
        };
        let mut placing = self.placing(cx.model);
        let offset = element.attribute("offset").map_or(Vector::zero(), |o| placing.point(&o, "offset"));
        let angles = element.attribute("euler").and_then(|e| placing.angles(&e)).unwrap_or([Expr::int(0); 3]);
        let compiler = placing.compiler;
        let class = element.attribute("childclass");
        let class = class
            .and_then(|name| self.models[cx.model].classes.find(&name, &mut self.reader.out))
            .or(cx.class);
        let children: Vec<Element<'a>> = element.children().collect();
        self.repeated += children.len().saturating_mul(count as usize);
        if self.repeated > MAX_REPEATED {
            let message = format!("more than {MAX_REPEATED} elements are repeated");
            self.reader.out.error(element.span(), message);
            self.work = MAX_WORK + 1;
            self.open.clear();
            return;
        }
        let separator = element.attribute("sep").map_or(String::new(), |s| plain(s.text));
        let digits = (count - 1).to_string().len();
        let (mut place, mut all) = (Vector::zero(), vec![]);
        for k in 0..count {
            // The angles grow; each place is by the offset in the frame before.
            let turn = compiler.turned(angles.map(|a| Expr::int(k) * a));
            let pose = Transform::from_rotation_translation(turn, place);
            let suffix: Rc<str> = format!("{separator}{k:0digits$}{}", cx.suffix).into();
            all.push(Context { frame: cx.frame * pose, class, suffix, is_repeated: true, ..cx.clone() });
            place = pose.act_on_point(offset);
        }
        for cx in all.iter().rev() {
            self.push(children.iter().copied(), cx);
        }
    }

    /// A body of another model, or all of its world.
    fn attach(&mut self, element: Element<'a>, cx: &Context) {
        element.only(&["model", "body", "prefix"], &mut self.reader.out);
        let model = element.attribute("model");
        let (Some(model), Some(prefix)) = (&model, element.attribute("prefix")) else {
            let missing = if model.is_none() { "model" } else { "prefix" };
            self.reader.out.error(element.span(), format!("an <attach> without `{missing}`"));
            return;
        };
        let parts = self.models[cx.model].parts;
        let Some(&number) = parts.get(model.text) else {
            let message = format!("there is no model `{}`", shown(model.text));
            let finding = self.reader.out.error(model.span.clone(), message);
            finding.hint("a model to attach is named by a <model> in <asset>");
            return;
        };
        if cx.attached.contains(&number) {
            let message = format!("the model `{}` attaches itself", shown(model.text));
            self.reader.out.error(model.span.clone(), message);
            return;
        }
        let attached: Vec<usize> = cx.attached.iter().copied().chain([number]).collect();
        let prefix: Rc<str> = format!("{}{}", cx.prefix, plain(prefix.text)).into();
        let inner = Context { model: number, class: None, prefix, attached: attached.into(), ..cx.clone() };
        let worlds = self.models[number].root.all("worldbody");
        if let Some(wanted) = element.attribute("body") {
            let Some((body, class)) = self.find(worlds.collect(), wanted.text, number) else {
                let message = format!("the model has no body `{}`", shown(wanted.text));
                self.reader.out.error(wanted.span, message);
                return;
            };
            self.push([body].into_iter(), &Context { class, ..inner.clone() });
        } else {
            self.push(worlds.flat_map(|w| w.children()), &inner);
        }
        self.parts.push((number, inner.prefix.to_string(), inner.suffix.to_string()));
    }

    /// The body of a name in a model, and the class in force there.
    fn find(
        &mut self,
        worlds: Vec<Element<'a>>,
        name: &str,
        model: usize,
    ) -> Option<(Element<'a>, Option<usize>)> {
        let mut open: Vec<(Element<'a>, Option<usize>)> =
            worlds.into_iter().rev().map(|w| (w, None)).collect();
        while let Some((element, class)) = open.pop() {
            if !self.works(1, &element) {
                return None;
            }
            if element.name() == Some("body") && element.attribute("name").is_some_and(|n| n.text == name) {
                return Some((element, class));
            }
            let own = element.attribute("childclass");
            let found = own.and_then(|n| self.models[model].classes.find(&n, &mut self.reader.out));
            let inside: Vec<Element<'a>> = element.children().collect();
            open.extend(inside.into_iter().rev().map(|e| (e, found.or(class))));
        }
        None
    }

    /// The `<inertial>` of a body, which may stand in a frame of it, and that frame in the body's.
    fn inertial_of(&mut self, body: Element<'a>, cx: &Context) -> Option<(Element<'a>, Transform<Expr>)> {
        let start = Context { frame: Transform::identity(), ..cx.clone() };
        let mut open = vec![(body, start)];
        let mut found: Option<(Element<'a>, Transform<Expr>)> = None;
        while let Some((element, cx)) = open.pop() {
            for inside in element.children() {
                match inside.name() {
                    Some("inertial") if found.is_some() => {
                        self.reader.out.warning(inside.span(), "a second <inertial>; the first one counts");
                    }
                    Some("inertial") => found = Some((inside, cx.frame)),
                    Some("frame")
                        if inside.children().any(|c| matches!(c.name(), Some("inertial" | "frame"))) =>
                    {
                        let inner = self.framed(inside, &cx);
                        open.push((inside, inner));
                    }
                    _ => {}
                }
            }
        }
        found
    }

    /// The mass of a body in its frame; nothing where it is not complete, which is said.
    fn mass(&mut self, inertial: Element<'a>, frame: Transform<Expr>, model: usize) -> Option<Mass> {
        inertial.only(&[&TURN[..], &["mass", "diaginertia", "fullinertia"]].concat(), &mut self.reader.out);
        let turned = super::defaults::TURNS.iter().find_map(|t| inertial.attribute(t));
        if let (Some(turned), Some(_)) = (turned, inertial.attribute("fullinertia")) {
            self.reader.out.error(turned.span, "both a turn and `fullinertia` say the axes of the inertia");
        }
        let pose = frame * self.placing(model).pose(&Resolved::bare(inertial));
        let mass = self.reader.number(&inertial, "mass");
        let mut entries = |name: &str, count: usize| -> Option<Vec<Rational>> {
            let value = inertial.attribute(name)?;
            Some(self.reader.numbers(&value, name, count)?.into_iter().map(|n| n.0).collect())
        };
        // The whole tensor is in the order xx yy zz xy xz yz.
        let tensor = match (entries("fullinertia", 6), entries("diaginertia", 3)) {
            (Some(all), _) => [0, 3, 4, 1, 5, 2].map(|k| all[k].clone()),
            (None, Some(d)) => [0, 3, 3, 1, 3, 2].map(|k| d.get(k).cloned().unwrap_or_default()),
            (None, None) => Default::default(),
        };
        let is_given = inertial.attribute("fullinertia").or(inertial.attribute("diaginertia")).is_some();
        let Some(mass) = mass.filter(|_| is_given) else {
            let missing = match inertial.attribute("mass") {
                Some(_) => "`diaginertia` and `fullinertia`",
                None => "`mass`",
            };
            self.reader.out.warning(inertial.span(), format!("<inertial> has no {missing}: it is left"));
            return None;
        };
        self.reader.say_inertia(&mass, &tensor, inertial.span());
        Some(Mass::about(mass, &pose, tensor))
    }
}
