//! What is claimed of a document: the equalities on which its verdicts "equal" rest.
//!
//! Where the right side is an entry of a frame or of a Jacobian, the claim is about the table's own product; other right
//! sides stand as formulas. A value of a joint is right up to branches: the claim is that sine and cosine agree in direction.

use crate::arm::{Frame, View};
use crate::claims::{Certificate, Quantity};
use crate::field::Obstacle;
use denavit::Robot;
use denavit::description::Description;
use denavit::forward::Reference;
use denavit::geometry::Transform;
use denavit::velocity::{Viewpoint, geometric};
use denavit_check::{About, Checked, Claim, Meaning, Standing};
use denavit_symbolic::readable::literals;
use denavit_symbolic::{Expr, Node, Symbol};
use rustc_hash::FxHashMap;

/// Rows of a table all of whose frames in all others are looked for.
const MOST_ROWS: usize = 12;
/// Literals of an entry of the pose that gets a name where it stands in a formula.
const LONG: u64 = 4;

/// Claims about one of the robots of a document (from 0); `line` tells the line of a place.
pub fn document(checked: &Checked, robot: usize, line: &dyn Fn(usize) -> usize) -> Option<Certificate> {
    let description = checked.robots.get(robot)?;
    let equal = |c: &Claim| c.entries.iter().any(|e| e.finding.standing() == Standing::Equal);
    let claims: Vec<&Claim> = checked.claims.iter().filter(|c| c.robot == robot && equal(c)).collect();
    if claims.is_empty() {
        return None;
    }
    let entries = || claims.iter().flat_map(|c| &c.entries);
    let formulas: Vec<Expr> = entries().flat_map(|e| &e.identities).flatten().copied().collect();
    let mut certificate = Certificate::new(description, &formulas);
    let table = Table::new(description);
    let mut names: FxHashMap<String, usize> = FxHashMap::default();
    for claim in claims {
        for entry in claim.entries.iter().filter(|e| e.finding.standing() == Standing::Equal) {
            let place = entry.place.map_or(String::new(), |(r, c)| format!(" {r} {c}"));
            let name = format!("line {}: {}{place}", line(entry.span.start), claim.name);
            if entry.identities.is_empty() {
                certificate.missing.push((name.clone(), Obstacle::Compared));
            }
            for &[printed, wanted] in &entry.identities {
                let count = names.entry(name.clone()).or_insert(0);
                *count += 1;
                let name = if *count > 1 { format!("{name} ({count})") } else { name.clone() };
                let known = table.jacobian(claim, entry.place, wanted).or_else(|| table.known(wanted));
                let [printed, wanted] = match known {
                    Some(quantity) => [Quantity::Formula(printed), quantity],
                    None => [printed, wanted].map(|e| Quantity::Formula(table.named(&mut certificate, e))),
                };
                certificate.claim(name, wanted, printed);
            }
        }
    }
    Some(certificate)
}

/// The entries of the frames in each other, as formulas of the program.
struct Table {
    robot: Robot<Expr>,
    q: Vec<Expr>,
    entries: FxHashMap<Expr, (Frame, Frame, (usize, usize))>,
    /// Those of the pose that are long.
    pose: FxHashMap<Expr, (Frame, Frame, (usize, usize))>,
}

impl Table {
    fn new(description: &Description) -> Self {
        let robot = Robot::symbolic(description);
        let q: Vec<Expr> = description.variables().iter().map(|v| v.symbol.into()).collect();
        let mut table = Table { robot, q, entries: FxHashMap::default(), pose: FxHashMap::default() };
        let n = table.robot.links.len();
        let ends = if n <= MOST_ROWS { (0..=n).collect() } else { vec![0, n] };
        for &from in &ends {
            for &to in &ends {
                let x = table.between(from.min(to), from.max(to));
                let x = if from <= to { x } else { x.inverse() };
                table.add(Frame::Behind(from), Frame::Behind(to), &x);
            }
            let x = table.between(from, n) * table.robot.tool;
            table.add(Frame::Behind(from), Frame::Tool, &x);
            table.add(Frame::Tool, Frame::Behind(from), &x.inverse());
        }
        let pose = table.robot.pose(&table.q);
        table.add(Frame::Base, Frame::Tool, &pose);
        table
    }

    fn between(&self, from: usize, to: usize) -> Transform<Expr> {
        let links = self.robot.links[from..to].iter();
        links.fold(Transform::identity(), |x, link| x * link.transform(&self.q))
    }

    fn add(&mut self, from: Frame, to: Frame, x: &Transform<Expr>) {
        let is_pose = to == Frame::Tool && matches!(from, Frame::Base | Frame::Behind(0));
        for (r, row) in x.matrix().into_iter().enumerate().take(3) {
            for (c, e) in row.into_iter().enumerate() {
                self.entries.entry(e).or_insert((from, to, (r, c)));
                if is_pose && literals(e) > LONG {
                    self.pose.entry(e).or_insert((from, to, (r, c)));
                }
            }
        }
    }

    /// The entry that a formula is.
    fn known(&self, e: Expr) -> Option<Quantity> {
        let &(from, to, place) = self.entries.get(&e)?;
        Some(Quantity::Frame { from, to, place })
    }

    /// The entry of a Jacobian that a formula is, for a claim about one.
    fn jacobian(&self, claim: &Claim, place: Option<(usize, usize)>, e: Expr) -> Option<Quantity> {
        let (About::Matrix(Meaning::Jacobian(j)), (r, c)) = (&claim.about, place?) else { return None };
        let row = usize::from(*j.order.get(r - 1)?);
        let view = Viewpoint::of(j.body, j.axes);
        let entry = *geometric(&self.robot, &self.q, &view).columns.get(c - 1)?.get(row)?;
        let frame = |f: Reference| Frame::from(f);
        let view =
            View { body: frame(j.body), axes: frame(j.axes), at: frame(j.body), offset: [Expr::int(0); 3] };
        (entry == e).then_some(Quantity::Jacobian { view, row, joint: c - 1 })
    }

    /// A formula in which long entries of the pose are named.
    fn named(&self, certificate: &mut Certificate, e: Expr) -> Expr {
        let mut new: FxHashMap<Expr, Expr> = FxHashMap::default();
        for part in Expr::postorder(&[e]) {
            let of = |a: Expr| new[&a];
            let built = match part.node() {
                _ if self.pose.contains_key(&part) => self.name(certificate, part),
                Node::Number(_) | Node::Pi | Node::Symbol(_) | Node::Sin(_) | Node::Cos(_) => part,
                Node::Neg(a) => -of(a),
                Node::Add(a, b) => of(a) + of(b),
                Node::Sub(a, b) => of(a) - of(b),
                Node::Mul(a, b) => of(a) * of(b),
                Node::Div(a, b) => of(a) / of(b),
                Node::Pow(a, n) => of(a).powi(n),
                Node::Sqrt(a) => of(a).sqrt(),
                Node::Atan2(a, b) => of(a).atan2(of(b)),
                Node::Sign(a) => of(a).sign(),
            };
            new.insert(part, built);
        }
        new[&e]
    }

    fn name(&self, certificate: &mut Certificate, e: Expr) -> Expr {
        let (from, to, (r, c)) = self.pose[&e];
        let stem = if from == Frame::Base { "base" } else { "frame0" };
        let name = Symbol::new(&format!("hand_in_{stem}_{}{}", r + 1, c + 1));
        let is_known = certificate.definitions.iter().any(|d| d.0 == name)
            || certificate.define(name, Quantity::Frame { from, to, place: (r, c) }).is_ok();
        if is_known { name.into() } else { e }
    }
}
