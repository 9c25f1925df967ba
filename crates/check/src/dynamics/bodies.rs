//! What the mass of a link may look like: where its centre is, and about which point its inertia is meant, in the symbols that the
//! document has for them. The first are the more usual ones.

use super::described::{At, Shape, Start};
use super::model::{Numbers, Rotor, motion, numbers};
use super::told::{Point, Told};
use super::words::Role;
use denavit::description::{Description, JointKind, Row};
use denavit::geometry::{Body, Transform, Vector};
use denavit_symbolic::{Expr, Rational, Symbol};
use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;

/// Where a body is and what it weighs, in the frame of its row.
struct Place {
    /// The centre of mass.
    centre: Vector<Expr>,
    /// How far the body reaches, and along which direction, where it is a rod.
    rod: Option<(Expr, Vector<Expr>)>,
}

/// The most bodies of a link that are tried.
const MAX_BODIES: usize = 1_000;
/// The most of them that are worked out: many are the same.
const MAX_TRIED: usize = 6_000;

fn half() -> Expr {
    Expr::from(Rational::new(1, 2))
}

fn is_zero(v: &Vector<Expr>) -> bool {
    v.0.iter().all(|e| e.is_zero())
}

/// The points that a link has: where its joint is (along the axis, and at the common normal), and where it ends.
struct Points {
    joints: Vec<Vector<Expr>>,
    ends: Vec<Vector<Expr>>,
    /// The direction of its own axis.
    axis: Vector<Expr>,
}

/// Where the link of a row ends, in the row's frame.
pub(super) fn ends(d: &Description, row: usize) -> Vec<Vector<Expr>> {
    points(d, row).ends
}

/// Where the joint of a row is, in the row's frame.
pub(super) fn joint(d: &Description, row: usize) -> Vector<Expr> {
    points(d, row).joints[0]
}

/// The direction of the axis of a row that moves, in its frame.
pub(super) fn axis(d: &Description, row: usize) -> Vector<Expr> {
    points(d, row).axis
}

fn points(d: &Description, row: usize) -> Points {
    let (o, one) = (Expr::int(0), Expr::int(1));
    let origin = Vector([o; 3]);
    let r = &d.rows[row];
    let is_slide = motion(d, r) == Some(JointKind::Prismatic);
    let is_still = |r: &Row| motion(d, r).is_none();
    let (mut joints, mut ends, axis);
    if d.convention.begins_with_joint() {
        let (s, c) = r.alpha.sin_cos();
        axis = Vector([o, s, c]);
        let normal = Vector([-r.a, o, o]);
        ends = vec![origin];
        joints = vec![normal];
        if !is_slide && !r.d.is_zero() {
            joints.insert(0, normal - axis.scale(r.d));
        }
        let mut x = Transform::identity();
        for next in d.rows[row + 1..].iter().take_while(|r| is_still(r)) {
            x = x * link(d, next);
        }
        if row + 1 == d.rows.len() || d.rows[row + 1..].iter().all(is_still) {
            x = x * d.tool;
        }
        ends.insert(0, x.translation);
    } else {
        axis = Vector([o, o, one]);
        joints = vec![origin];
        if !is_slide && !r.d.is_zero() {
            joints.insert(0, Vector([o, o, -r.d]));
        }
        ends = vec![];
        match d.rows.get(row + 1) {
            Some(next) => {
                let normal = Vector([next.a, o, o]);
                let (s, c) = next.alpha.sin_cos();
                let slides = motion(d, next) == Some(JointKind::Prismatic);
                if !slides && !next.d.is_zero() {
                    ends.push(normal + Vector([o, -s, c]).scale(next.d));
                }
                ends.push(normal);
            }
            None => ends.push(d.tool.translation),
        }
    }
    joints.dedup_by(|a, b| a == b);
    ends.dedup_by(|a, b| a == b);
    Points { joints, ends, axis }
}

/// The transform of a row that does not move.
fn link(d: &Description, row: &Row) -> Transform<Expr> {
    let screw =
        |x: Transform<Expr>, z: Transform<Expr>| if d.convention.begins_with_joint() { z * x } else { x * z };
    let turn = |axis, angle| Transform::rotation_about(axis, angle);
    let x = turn(denavit::geometry::Axis::X, row.alpha) * Transform::translation_x(row.a);
    let z = turn(denavit::geometry::Axis::Z, row.theta) * Transform::translation_z(row.d);
    screw(x, z)
}

/// The places of a link's centre of mass; a length that is measured from one of its ends is so `from` there alone.
fn places(d: &Description, row: usize, lengths: &[Expr], from: Option<Start>) -> Vec<Place> {
    let (o, one) = (Expr::int(0), Expr::int(1));
    let points = points(d, row);
    let mut directions: Vec<Vector<Expr>> = vec![];
    let add = |v: Vector<Expr>, all: &mut Vec<Vector<Expr>>| {
        if !all.contains(&v) {
            all.push(v);
        }
    };
    // From the joint to the end, where that is along an axis of the frame.
    for (from, to) in points.joints.iter().flat_map(|a| points.ends.iter().map(move |b| (*a, *b))) {
        let way = to - from;
        for (k, e) in way.0.iter().enumerate() {
            if way.0.iter().enumerate().all(|(i, e)| (i == k) != e.is_zero()) {
                let is_back = e.as_number().is_some_and(|r| r.is_negative())
                    || matches!(e.node(), denavit_symbolic::Node::Neg(_));
                let mut unit = [o; 3];
                unit[k] = if is_back { -one } else { one };
                add(Vector(unit), &mut directions);
            }
        }
    }
    for k in [0, 2, 1] {
        for sign in [one, -one] {
            let mut unit = [o; 3];
            unit[k] = sign;
            add(Vector(unit), &mut directions);
        }
    }
    add(points.axis, &mut directions);
    add(points.axis.scale(-one), &mut directions);
    let bases: Vec<Vector<Expr>> = match from {
        None => points.joints.iter().chain(&points.ends).copied().collect(),
        Some(Start::Joint) => points.joints.clone(),
        Some(Start::End) => points.ends.clone(),
    };
    let mut found: Vec<Place> = vec![];
    let mut push = |centre: Vector<Expr>, rod: Option<(Expr, Vector<Expr>)>| {
        let is_known = found.iter().any(|p| p.centre == centre && p.rod == rod);
        if !is_known && found.len() < MAX_BODIES {
            found.push(Place { centre, rod });
        }
    };
    for &length in lengths {
        for u in &directions {
            for base in &bases {
                push(*base + u.scale(length), None);
            }
        }
    }
    for &end in &points.ends {
        push(end, None);
    }
    for (&a, &b) in points.joints.iter().flat_map(|a| points.ends.iter().map(move |b| (a, b))) {
        let way = b - a;
        if !is_zero(&way) {
            let along = directions.iter().copied().find(|u| is_zero(&way.cross(*u)));
            let rod = along.map(|u| (way.dot(u), u));
            push((a + b).scale(half()), rod);
            push((a + b).scale(half()), None);
        }
    }
    for &length in lengths {
        for u in &directions {
            for base in &bases {
                push(*base + u.scale(length * half()), Some((length, *u)));
            }
        }
    }
    for &joint in &points.joints {
        push(joint, None);
    }
    found
}

/// The bodies that link `k` may have, in the frame of its row, each with the inertia of the rotor that turns it: `meaning` is what a
/// symbol of the document stands for there, `told` what its words say. And whether there are more.
pub(super) fn bodies(
    d: &Description,
    row: usize,
    k: usize,
    is_last: bool,
    roles: &BTreeMap<Symbol, Role>,
    meaning: &dyn Fn(Symbol) -> Expr,
    told: &Told,
) -> (Vec<Numbers>, bool) {
    let o = Expr::int(0);
    let none = Rotor::felt(o);
    if let Some(body) = d.rows[row].body() {
        return (vec![numbers(body.parameters(), none, d.rows[row].com.unwrap_or([o; 3]))], false);
    }
    let of = |wanted: &dyn Fn(Role) -> bool| -> Vec<Expr> {
        roles.iter().filter(|(_, r)| wanted(**r)).map(|(s, _)| meaning(*s)).collect()
    };
    if roles.values().any(|r| matches!(r, Role::Ten(..))) {
        // Khalil's numbers, those that the document does not mention with names of their own.
        let first = |wanted: &dyn Fn(Role) -> bool| of(wanted).first().copied().unwrap_or(o);
        let ten = std::array::from_fn(|at| match at {
            9 => first(&|r| r == Role::Mass(Some(k))),
            _ => first(&|r| r == Role::Ten(k, at)),
        });
        let rotor = Rotor::felt(first(&|r| r == Role::Rotor(Some(k))));
        let mut found = vec![numbers(ten, rotor, [o; 3])];
        if d.convention.begins_with_joint() {
            // In the frame that has its z along the link's own axis, or in the row's.
            let r = &d.rows[row];
            let back = Transform::rotation_about(denavit::geometry::Axis::X, r.alpha)
                * Transform::translation_x(r.a);
            let own = Body::of(ten).seen_from(&back.inverse());
            let simple = own
                .parameters()
                .map(|e| denavit_symbolic::readable::simplify(e, &e.symbols()).map_or(e, |s| s.expr));
            found.insert(0, numbers(simple, rotor, [o; 3]));
            found.dedup();
        }
        return (found, false);
    }
    let prefer = |own: Vec<Expr>, shared: Vec<Expr>| if own.is_empty() { shared } else { own };
    let mut masses = prefer(of(&|r| r == Role::Mass(Some(k))), of(&|r| r == Role::Mass(None)));
    let inertias = prefer(of(&|r| r == Role::Inertia(Some(k))), of(&|r| r == Role::Inertia(None)));
    // `I = m l²/12` beside m_1, m_2 says what is so of each.
    let is_general = |e: &Expr| {
        e.symbols().iter().any(|s| matches!(roles.get(s), Some(Role::Mass(None) | Role::Length(None))))
    };
    let has_own = roles.values().any(|r| matches!(r, Role::Mass(Some(_))));
    // Points have none.
    let is_point = told.links.shape == Some(Shape::Point);
    let is_meant = |e: &Expr| !(is_point || has_own && is_general(e));
    let inertias: Vec<Expr> = inertias.into_iter().filter(is_meant).collect();
    let rotors = prefer(of(&|r| r == Role::Rotor(Some(k))), of(&|r| r == Role::Rotor(None)));
    // A rotor behind a gear, whose ratio may be Spong's `r_1` beside other lengths.
    let gears = prefer(of(&|r| r == Role::Gear(Some(k))), of(&|r| r == Role::Gear(None)));
    let own_lengths: Vec<Symbol> =
        roles.iter().filter(|(_, r)| **r == Role::Length(Some(k))).map(|(s, _)| *s).collect();
    let is_ratio = |s: &Symbol| {
        let is_alone = own_lengths.iter().all(|l| l.name().starts_with('r'));
        s.name().starts_with('r') && gears.is_empty() && !rotors.is_empty() && !is_alone
    };
    let (ratios, own_lengths): (Vec<Symbol>, Vec<Symbol>) = own_lengths.iter().partition(|s| is_ratio(s));
    let meant = |all: Vec<Symbol>| -> Vec<Expr> { all.into_iter().map(meaning).collect() };
    let (gears, own_lengths) = (prefer(gears.clone(), meant(ratios)), meant(own_lengths));
    let lengths = prefer(own_lengths, of(&|r| r == Role::Length(None)));
    let axes: [Option<Expr>; 3] = [0, 1, 2].map(|axis| of(&|r| r == Role::About(k, axis)).first().copied());
    let has_axes = axes.iter().any(Option::is_some) && !is_point;
    if masses.is_empty() {
        masses.push(o);
    }
    let points = points(d, row);
    let loads: Vec<Expr> = if is_last { of(&|r| r == Role::Payload) } else { vec![] };
    let is_turning = motion(d, &d.rows[row]) == Some(JointKind::Revolute);
    let is_driven = d.rows[row].variable.is_some();
    let mut turned: Vec<Rotor> = vec![];
    for (&rotor, &n) in rotors.iter().flat_map(|r| gears.iter().map(move |n| (r, n))) {
        turned.push(Rotor::felt(n.powi(2) * rotor));
        if is_turning {
            // It turns with the link before, too: ½ J (ω + N q̇)² = ½ J (ω + q̇)² + (N − 1) J ω q̇ + ½ (N² − 1) J q̇².
            let one = Expr::int(1);
            turned.push(Rotor {
                inertia: (n.powi(2) - one) * rotor,
                coupled: (n - one) * rotor,
                along: rotor,
                mass: o,
            });
        }
    }
    if gears.is_empty() {
        turned.extend(rotors.iter().map(|r| Rotor::felt(*r)));
    }
    // The mass of a motor on the axis of a joint that turns moves with either link.
    let motors = if is_turning { of(&|r| r == Role::Motor(k)) } else { vec![] };
    // Where none is named so, `J` beside `I`, or the only inertia that there is, may be that of a rotor.
    let mut ways: Vec<(Rotor, Vec<Expr>)> = turned.iter().map(|r| (*r, inertias.clone())).collect();
    ways.push((none, inertias.clone()));
    // What words call the inertias of links are no rotors'.
    if is_driven && rotors.is_empty() && told.links.inertias.is_empty() && told.inertia != Some(Point::Centre)
    {
        for (at, &rotor) in inertias.iter().enumerate() {
            let others = inertias.iter().enumerate().filter(|(i, _)| *i != at).map(|(_, e)| *e);
            ways.push((Rotor::felt(rotor), others.collect()));
        }
    }
    let found: RefCell<Vec<Numbers>> = RefCell::default();
    let tried = Cell::new(0);
    let is_full = || found.borrow().len() >= MAX_BODIES || tried.get() >= MAX_TRIED;
    let rotor_now = Cell::new(none);
    let add =
        |body: Body<Expr>, centre: Vector<Expr>, mass_at_end: &dyn Fn(Body<Expr>) -> Vec<Body<Expr>>| {
            if is_full() {
                return;
            }
            tried.set(tried.get() + 1);
            // Of nothing no place is the centre.
            let centre = if body.mass.is_zero() { [o; 3] } else { centre.0 };
            for mut body in mass_at_end(body) {
                for &motor in &motors {
                    body = body + Body::about_centre(motor, points.joints[0], [o; 6]);
                }
                let mass = motors.iter().fold(o, |sum, &motor| sum + motor);
                let numbers = numbers(body.parameters(), Rotor { mass, ..rotor_now.get() }, centre);
                let mut found = found.borrow_mut();
                if found.len() < MAX_BODIES && !found.contains(&numbers) {
                    found.push(numbers);
                }
            }
        };
    let loaded = |body: Body<Expr>| -> Vec<Body<Expr>> {
        match loads[..] {
            [load] => {
                let ends = points.ends.iter().copied();
                let ends = ends.chain(
                    lengths.iter().flat_map(|l| points.joints.iter().map(|p| *p + Vector([*l, o, o]))),
                );
                ends.map(|end| body + Body::about_centre(load, end, [o; 6])).collect()
            }
            _ => vec![body],
        }
    };
    let [is_centre, is_joint] = [Point::Centre, Point::Joint].map(|p| told.inertia.is_none_or(|t| t == p));
    // About the joint.
    let about_joint = |mass: Expr, c: Vector<Expr>, joint: Vector<Expr>, tensor: [Expr; 6]| {
        let mut body = Body::about_centre(mass, c - joint, [o; 6]);
        body.inertia = tensor;
        body.seen_from(&Transform::translation(joint[0], joint[1], joint[2]))
    };
    let mut places = places(d, row, &lengths, told.links.from(k));
    let is_rod = told.links.shape == Some(Shape::Rod);
    let is_told = |p: &Place| match told.links.place {
        Some(At::End) => points.ends.contains(&p.centre),
        // Unless a name for half of it is what lengths have.
        Some(At::Middle) => p.rod.is_some() || !lengths.is_empty(),
        None => true,
    };
    if places.iter().any(is_told) {
        places.retain(is_told);
    }
    for (rotor, inertias) in &ways {
        rotor_now.set(*rotor);
        for (&mass, place) in masses.iter().flat_map(|m| places.iter().map(move |p| (m, p))) {
            if is_full() {
                break;
            }
            let c = place.centre;
            let with = |tensor: [Expr; 6]| Body::about_centre(mass, c, tensor);
            if has_axes {
                let [x, y, z] = axes.map(|e| e.unwrap_or(o));
                let tensor = [x, o, o, y, o, z];
                if is_centre {
                    add(with(tensor), c, &loaded);
                }
                for &joint in points.joints.iter().filter(|_| is_joint) {
                    add(about_joint(mass, c, joint, tensor), c, &loaded);
                }
                continue;
            }
            for &inertia in inertias.iter().filter(|_| is_centre) {
                add(with([inertia, o, o, inertia, o, inertia]), c, &loaded);
            }
            for &inertia in inertias {
                for &joint in points.joints.iter().filter(|_| is_joint) {
                    add(about_joint(mass, c, joint, [inertia, o, o, inertia, o, inertia]), c, &loaded);
                }
                if let (Some((_, u)), true) = (place.rod, is_centre) {
                    add(with(slender(inertia, &u)), c, &loaded);
                }
                if is_centre {
                    add(with(slender(inertia, &Vector([Expr::int(1), o, o]))), c, &loaded);
                }
            }
            if inertias.is_empty() {
                if !is_rod || place.rod.is_none() {
                    add(with([o; 6]), c, &loaded);
                }
                if let (Some((length, u)), false) = (place.rod, is_point) {
                    let twelfth = Expr::from(Rational::new(1, 12));
                    add(with(slender(twelfth * mass * length.powi(2), &u)), c, &loaded);
                }
            }
        }
    }
    let is_cut = is_full();
    (found.into_inner(), is_cut)
}

/// The inertia of a thin rod along a direction.
pub(super) fn slender(inertia: Expr, u: &Vector<Expr>) -> [Expr; 6] {
    let one = Expr::int(1);
    let at = |i: usize, j: usize| {
        let own = if i == j { one } else { Expr::int(0) };
        inertia * (own - u[i] * u[j])
    };
    [at(0, 0), at(0, 1), at(0, 2), at(1, 1), at(1, 2), at(2, 2)]
}
