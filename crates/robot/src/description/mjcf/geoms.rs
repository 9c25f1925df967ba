//! `<geom>`: what a body weighs where nothing else says it, and what it looks like.

use super::super::tree::{Look, Mass, Shape};
use super::super::xml::{Element, shown};
use super::Mjcf;
use super::bodies::Context;
use super::defaults::Resolved;
use crate::geometry::{Body, Transform, Vector};
use denavit_symbolic::real::Values;
use denavit_symbolic::{Expr, Rational};
use std::collections::HashMap;
use std::ops::Range;

/// The attributes of a geom.
pub(super) const ATTRIBUTES: &[&str] = &[
    "name",
    "class",
    "type",
    "contype",
    "conaffinity",
    "condim",
    "group",
    "priority",
    "size",
    "material",
    "rgba",
    "friction",
    "mass",
    "density",
    "shellinertia",
    "solmix",
    "solref",
    "solimp",
    "margin",
    "gap",
    "fromto",
    "pos",
    "quat",
    "axisangle",
    "xyaxes",
    "zaxis",
    "euler",
    "hfield",
    "mesh",
    "fitscale",
    "fluidshape",
    "fluidcoef",
    "user",
];

/// Where masses come from, if a body has both geoms and an `<inertial>`.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum FromGeoms {
    Never,
    /// Where there is no `<inertial>`.
    Missing,
    Always,
}

/// A mesh that geoms name.
pub(super) struct Mesh {
    file: String,
    scale: [f64; 3],
}

/// What geoms draw on that stands elsewhere, by model and name.
#[derive(Default)]
pub(super) struct Assets {
    meshes: HashMap<(usize, String), Mesh>,
    colours: HashMap<(usize, String), [f64; 4]>,
}

/// What the geoms of a body weigh together.
#[derive(Default)]
pub(super) struct Weight {
    sum: Option<Body<Expr>>,
    /// A geom of which the mass is not known, and why.
    unknown: Option<(Range<usize>, &'static str)>,
}

/// The solids whose volume is known, by half their edges, or by radius and half the length.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Solid {
    Sphere,
    Capsule,
    Ellipsoid,
    Cylinder,
    Box,
}

/// Groups of geoms from this one on are not shown unless asked for: as a rule what collides.
const HIDDEN: i64 = 3;

fn ratio(n: i64, d: i64) -> Expr {
    Rational::new(n, d).into()
}

impl Solid {
    /// How many sizes it has; one where its ends are given, which is its half width along x and y then.
    fn sizes(self, has_ends: bool) -> usize {
        match self {
            Solid::Sphere => 1,
            _ if has_ends => 1,
            Solid::Capsule | Solid::Cylinder => 2,
            Solid::Ellipsoid | Solid::Box => 3,
        }
    }

    fn volume(self, [a, b, c]: [Expr; 3]) -> Expr {
        let ball = |x: Expr| ratio(4, 3) * Expr::pi() * x;
        match self {
            Solid::Sphere => ball(a * a * a),
            Solid::Ellipsoid => ball(a * b * c),
            Solid::Cylinder => Expr::pi() * a * a * Expr::int(2) * b,
            Solid::Capsule => Expr::pi() * a * a * Expr::int(2) * b + ball(a * a * a),
            Solid::Box => Expr::int(8) * a * b * c,
        }
    }

    /// The inertia of a mass of 1 about the centre, along x, y and z.
    fn inertia(self, [a, b, c]: [Expr; 3]) -> [Expr; 3] {
        let round = |across: Expr, along: Expr| [across, across, along];
        let squares = |k: Expr| [b * b + c * c, a * a + c * c, a * a + b * b].map(|x| k * x);
        let length = Expr::int(2) * b;
        let ball = ratio(2, 5) * a * a;
        let cylinder = [(Expr::int(3) * a * a + length * length) * ratio(1, 12), ratio(1, 2) * a * a];
        match self {
            Solid::Sphere => [ball; 3],
            Solid::Ellipsoid => squares(ratio(1, 5)),
            Solid::Box => squares(ratio(1, 3)),
            Solid::Cylinder => round(cylinder[0], cylinder[1]),
            Solid::Capsule => {
                // Half a ball at each end, of this part of the mass.
                let ends = Expr::int(4) * a / (Expr::int(4) * a + Expr::int(3) * length);
                let off = length * (Expr::int(3) * a + Expr::int(2) * length) * ratio(1, 8);
                let tube = Expr::int(1) - ends;
                round(tube * cylinder[0] + ends * (ball + off), tube * cylinder[1] + ends * ball)
            }
        }
    }
}

impl<'a> Mjcf<'a, '_> {
    /// Meshes and colours of all models.
    pub(super) fn assets(&mut self) {
        let models = self.models;
        for (m, model) in models.iter().enumerate() {
            for element in model.root.all("asset").flat_map(|a| a.children().collect::<Vec<_>>()) {
                let kind = element.name().unwrap_or_default();
                if !matches!(kind, "mesh" | "material") {
                    continue;
                }
                let asset = model.classes.resolve(element, None, &mut self.reader.out);
                let name = element.attribute("name").map(|n| n.text.to_string());
                if kind == "material" {
                    let colour = asset.get("rgba").and_then(|t| self.reader.colour_of(&t));
                    self.assets.colours.extend(name.zip(colour).map(|(n, c)| ((m, n), c)));
                    continue;
                }
                // A mesh that is moved has no file as it is drawn.
                let is_moved = asset.get("refpos").is_some() || asset.get("refquat").is_some();
                let Some(file) = asset.get("file").filter(|_| !is_moved) else { continue };
                let stem = file.text.rsplit(['/', '\\']).next().unwrap_or_default();
                let stem = stem.rsplit_once('.').map_or(stem, |s| s.0);
                let scale =
                    asset.get("scale").and_then(|t| self.reader.doubles(&t, "scale")).unwrap_or([1.0; 3]);
                let folder = model.folder.trim_end_matches('/');
                let file = match folder {
                    "" => file.text.to_string(),
                    folder => format!("{folder}/{}", file.text),
                };
                let name = name.unwrap_or_else(|| stem.to_string());
                self.assets.meshes.insert((m, name), Mesh { file, scale });
            }
        }
    }

    pub(super) fn geom(&mut self, element: Element<'a>, cx: &Context) {
        element.only(ATTRIBUTES, &mut self.reader.out);
        let models = self.models;
        let geom = models[cx.model].classes.resolve(element, cx.class, &mut self.reader.out);
        let mesh = geom.get("mesh").map(|m| m.text);
        let kind = geom.get("type").map_or(if mesh.is_some() { "mesh" } else { "sphere" }, |t| t.text);
        let solid = match kind {
            "sphere" => Some(Solid::Sphere),
            "capsule" => Some(Solid::Capsule),
            "ellipsoid" => Some(Solid::Ellipsoid),
            "cylinder" => Some(Solid::Cylinder),
            "box" => Some(Solid::Box),
            "plane" | "hfield" => return,
            "mesh" | "sdf" => None,
            other => {
                let message = format!("unknown type of geom `{}`: it is left", shown(other));
                self.reader.out.warning(element.span(), message);
                return;
            }
        };
        // A solid that names a mesh is fitted about it.
        let solid = solid.filter(|_| mesh.is_none());
        let is_fitted = solid.is_none() && kind != "mesh" && kind != "sdf";
        let Some((pose, half)) = self.placed_geom(&geom, solid, cx) else { return };
        let pose = cx.frame * pose;
        let sizes = match solid {
            Some(solid) => match self.sizes(&geom, solid, half) {
                Some(sizes) => Some((solid, sizes)),
                None => return,
            },
            None => None,
        };
        let group = geom.get("group").and_then(|g| g.text.trim().parse::<i64>().ok()).unwrap_or(0);
        if cx.body != 0 {
            self.weigh(&geom, sizes, &pose, group, cx);
        }
        if group < HIDDEN && !is_fitted {
            self.draw(&geom, sizes, mesh, &pose, cx);
        }
    }

    /// Where a geom stands in the frame around it, and half its length where its ends are given.
    fn placed_geom(
        &mut self,
        geom: &Resolved,
        solid: Option<Solid>,
        cx: &Context,
    ) -> Option<(Transform<Expr>, Option<Expr>)> {
        let Some(ends) = geom.get("fromto").filter(|_| solid.is_some_and(|s| s != Solid::Sphere)) else {
            return Some((self.placing(cx.model).pose(geom), None));
        };
        if let Some(pos) = geom.get("pos") {
            self.reader
                .out
                .error(pos.span, "both `pos` and `fromto` say where a geom is")
                .hint("those that a class gives count as well: MuJoCo refuses the model, too");
        }
        let pose = self.placing(cx.model).between(&ends)?;
        let points = self.reader.numbers(&ends, "fromto", 6)?;
        let difference = |k: usize| Expr::from(points[k].0.clone() - points[k + 3].0.clone());
        Some((pose, Some(Vector([0, 1, 2].map(difference)).norm() * ratio(1, 2))))
    }

    /// The sizes of a solid; nothing where they are none, which is said.
    fn sizes(&mut self, geom: &Resolved, solid: Solid, half: Option<Expr>) -> Option<[Expr; 3]> {
        let count = solid.sizes(half.is_some());
        let Some(text) = geom.get("size") else {
            self.reader.out.warning(geom.own.span(), "a geom without `size`: it is left");
            return None;
        };
        let words = text.words();
        if words.len() < count || words.len() > 3 {
            let message = format!("`size` has {} numbers, not {count}: the geom is left", words.len());
            self.reader.out.warning(text.span, message);
            return None;
        }
        let mut sizes = [Expr::int(0); 3];
        for (size, word) in sizes.iter_mut().zip(&words).take(count) {
            let x = self.reader.decimal(word)?;
            if x.is_negative() || x.is_zero() {
                self.reader.out.warning(word.span.clone(), "a size that is not positive: the geom is left");
                return None;
            }
            *size = x.into();
        }
        if let Some(half) = half {
            sizes = match solid {
                Solid::Ellipsoid | Solid::Box => [sizes[0], sizes[0], half],
                _ => [sizes[0], half, sizes[2]],
            };
        }
        Some(sizes)
    }

    /// Adds what a geom weighs to its body.
    fn weigh(
        &mut self,
        geom: &Resolved,
        sizes: Option<(Solid, [Expr; 3])>,
        pose: &Transform<Expr>,
        group: i64,
        cx: &Context,
    ) {
        let model = &self.models[cx.model];
        let is_counted = self.from_geoms.get(&cx.body).copied().unwrap_or(false);
        if !is_counted || !model.groups.contains(&group) {
            return;
        }
        let mut number = |name: &str| {
            let text = geom.get(name)?;
            Some(self.reader.numbers(&text, name, 1)?.remove(0).0)
        };
        let (mass, density) = (number("mass"), number("density").unwrap_or(Rational::from(1000)));
        if [mass.as_ref(), Some(&density)].into_iter().flatten().any(Rational::is_negative) {
            self.reader.out.warning(geom.own.span(), "a mass or density that is negative: it is left");
            return;
        }
        let none = mass.as_ref().map_or(density.is_zero(), Rational::is_zero);
        if none {
            return;
        }
        let is_shell = geom.get("shellinertia").is_some_and(|t| t.text == "true");
        let weight = self.weights.entry(cx.body).or_default();
        let (solid, sizes) = match sizes {
            Some(known) if !is_shell => known,
            _ => {
                let what = if is_shell { "a shell" } else { "a mesh" };
                weight.unknown.get_or_insert((geom.own.span(), what));
                return;
            }
        };
        let mass = mass.map_or_else(|| Expr::from(density) * solid.volume(sizes), Expr::from);
        let [xx, yy, zz] = solid.inertia(sizes).map(|x| mass * x);
        let o = Expr::int(0);
        let body = Body::about_centre(mass, Vector::zero(), [xx, o, o, yy, o, zz]).seen_from(pose);
        weight.sum = Some(match weight.sum.take() {
            Some(sum) => sum + body,
            None => body,
        });
    }

    /// Makes all masses together that of the model, if it says one.
    pub(super) fn set_total(&mut self, total: Option<&Rational>, is_known: bool, span: Range<usize>) {
        let Some(total) = total else { return };
        let masses = || self.links.bodies.iter().filter_map(|b| b.mass.as_ref());
        let sum = masses().fold(Expr::int(0), |sum, m| sum + m.mass);
        let mut values = Values::default();
        let is_there = values.of(sum).is_some_and(|x| !x.is_zero() && !x.is_negative());
        if !is_known || !is_there {
            let message = "`settotalmass` is not followed, as not all masses are known";
            self.reader.out.warning(span, message);
            return;
        }
        let factor = Expr::from(total.clone()) / sum;
        let mut times = |e: Expr| values.of(e * factor).map_or(e * factor, |x| x.settled());
        for mass in self.links.bodies.iter_mut().filter_map(|b| b.mass.as_mut()) {
            mass.mass = times(mass.mass);
            mass.inertia = mass.inertia.map(&mut times);
        }
    }

    /// Gives bodies the masses of their geoms; whether all are known.
    pub(super) fn weigh_bodies(&mut self) -> bool {
        let mut unknown: Vec<(usize, Range<usize>, &str)> = vec![];
        for (body, Weight { sum, unknown: why }) in std::mem::take(&mut self.weights) {
            if let Some((span, what)) = why {
                self.links.bodies[body].is_unweighed = true;
                unknown.push((body, span, what));
            } else if let Some(mass) = sum.as_ref().and_then(Mass::of_body) {
                self.links.bodies[body].mass = Some(mass);
            }
        }
        unknown.sort_unstable_by_key(|u| u.0);
        if let Some((body, span, what)) = unknown.first() {
            let others = match unknown.len() {
                1 => String::new(),
                n => format!(", nor have {} others", n - 1),
            };
            let name = shown(&self.links.bodies[*body].name);
            let message =
                format!("the mass of {what} is not computed: the body `{name}` has none here{others}");
            self.reader.out.warning(span.clone(), message).hint("give it an <inertial>");
        }
        self.bound_bodies();
        unknown.is_empty()
    }

    fn draw(
        &mut self,
        geom: &Resolved,
        sizes: Option<(Solid, [Expr; 3])>,
        mesh: Option<&str>,
        pose: &Transform<Expr>,
        cx: &Context,
    ) {
        let number = |e: Expr| e.eval(|_| None).unwrap_or(0.0);
        let shape = match (sizes, mesh) {
            (Some((solid, sizes)), _) => {
                let [a, b, c] = sizes.map(number);
                match solid {
                    Solid::Sphere => Shape::Sphere { radius: a },
                    Solid::Capsule => Shape::Capsule { radius: a, length: 2.0 * b },
                    Solid::Cylinder => Shape::Cylinder { radius: a, length: 2.0 * b },
                    Solid::Ellipsoid => Shape::Ellipsoid([a, b, c]),
                    Solid::Box => Shape::Box([2.0 * a, 2.0 * b, 2.0 * c]),
                }
            }
            (None, Some(name)) => match self.assets.meshes.get(&(cx.model, name.to_string())) {
                Some(Mesh { file, scale }) => Shape::Mesh { file: file.clone(), scale: *scale },
                None => return,
            },
            (None, None) => return,
        };
        let material = geom.get("material").map(|t| (cx.model, t.text.to_string()));
        let own = geom.get("rgba").and_then(|t| self.reader.colour_of(&t));
        let colour = own.or_else(|| self.assets.colours.get(&material?).copied());
        if colour.is_some_and(|c| c[3] <= 0.0) {
            return;
        }
        self.links.bodies[cx.body].looks.push(Look { shape, origin: pose.map(number), colour });
    }
}
