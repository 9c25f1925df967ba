//! What is claimed of an inverse model: that each equation of each step holds at every configuration of the robot, the entries
//! of the pose being those of its own product, and that the formulas of each type solve equations of that type.
//!
//! Which branch belongs to which configuration, and that there are no other solutions, is not claimed.

use crate::arm::Frame;
use crate::claims::{Certificate, Quantity};
use denavit::geometry::{Rotation, Transform, Vector};
use denavit::inverse::InverseModel;
use denavit::inverse::derivation::{Form, Norm, NormalChain, Step};
use denavit_symbolic::poly::Poly;
use denavit_symbolic::{Expr, Symbol};

/// Claims about the steps of an inverse model.
pub fn inverse(model: &InverseModel) -> Certificate {
    let chain = &model.chain;
    let all = std::iter::once(&model.steps).chain(model.variants.iter().map(|v| &v.steps));
    let mut equations: Vec<(String, [Expr; 2])> = vec![];
    let mut forms: Vec<&Form> = vec![];
    for (k, steps) in all.enumerate() {
        for (number, step) in (1..).zip(steps) {
            let of = if k == 0 { format!("step {number}") } else { format!("variant {k} step {number}") };
            for (row, sides) in (1..).zip(of_step(chain, step)) {
                if !equations.iter().any(|e| e.1 == sides) {
                    equations.push((format!("{of} equation {row}"), sides));
                }
            }
            if !forms.iter().any(|f| std::mem::discriminant(*f) == std::mem::discriminant(&step.form)) {
                forms.push(&step.form);
            }
        }
    }
    let pose = pose(chain);
    let formulas = equations.iter().flat_map(|e| e.1).chain(pose.iter().map(|p| p.1));
    let mut certificate = Certificate::new(&model.description, &formulas.collect::<Vec<Expr>>());
    for (r, row) in hand().matrix().iter().enumerate().take(3) {
        for (c, e) in row.iter().enumerate() {
            let entry = Quantity::Frame { from: Frame::Base, to: Frame::Tool, place: (r, c) };
            if let Some(name) = e.as_symbol() {
                define(&mut certificate, name, entry);
            }
        }
    }
    for (name, e) in pose {
        define(&mut certificate, name, Quantity::Formula(e));
    }
    for (name, [left, right]) in equations {
        certificate.claim(name, Quantity::Formula(left), Quantity::Formula(right));
    }
    for form in forms {
        for (name, [left, right]) in solution(form) {
            certificate.claim(name, Quantity::Formula(left), Quantity::Formula(right));
        }
    }
    certificate
}

fn define(certificate: &mut Certificate, name: Symbol, quantity: Quantity) {
    if let Err(why) = certificate.define(name, quantity) {
        certificate.missing.push((name.name().to_string(), why));
    }
}

/// The tool in the base, by names.
fn hand() -> Transform<Expr> {
    let name = |r: usize, c: usize| Expr::symbol(&format!("hand{}{}", r + 1, c + 1));
    let rows = std::array::from_fn(|r| std::array::from_fn(|c| name(r, c)));
    Transform::from_rotation_translation(Rotation::from_rows(rows), Vector([0, 1, 2].map(|r| name(r, 3))))
}

/// The entries of the pose that the equations speak of: U = base⁻¹ · T · tool⁻¹.
fn pose(chain: &NormalChain) -> Vec<(Symbol, Expr)> {
    let moved = chain.base.inverse() * hand() * chain.tool.inverse();
    chain.pose.iter().copied().zip(moved.matrix().into_iter().flatten()).collect()
}

/// The equations of a step, both sides.
fn of_step(chain: &NormalChain, step: &Step) -> Vec<[Expr; 2]> {
    let of = |p: &Poly| chain.algebra.formula(p);
    let norm = |n: &Norm| n.squares.iter().fold(of(&n.plus), |sum, p| sum + of(p).powi(2));
    let x = chain.unknown_expr(step.unknown);
    let (s, c) = x.sin_cos();
    let row = |r: &denavit::inverse::derivation::Row| [of(&r.a) * c + of(&r.b) * s, norm(&r.c)];
    match &step.form {
        Form::Ratio { numerator, denominator } => vec![[of(denominator) * x, of(numerator)]],
        Form::Pair { .. } | Form::Line | Form::Sincos => step.rows.iter().map(row).collect(),
        Form::Quadratic { a, b, c } => {
            let sum = of(a) * x.powi(2) + Expr::int(2) * of(b) * x + norm(c);
            vec![[sum, Expr::int(0)]]
        }
        Form::Quartic(parts) => {
            let of_parts = [c * c, c * s, c, s, Expr::int(1)];
            let terms = parts.iter().zip(of_parts).map(|(p, x)| norm(p) * x);
            vec![[terms.fold(Expr::int(0), |sum, x| sum + x), Expr::int(0)]]
        }
    }
}

/// That the formulas of a type solve every equation of that type, whatever its factors are; multiplied by denominators.
fn solution(form: &Form) -> Vec<(String, [Expr; 2])> {
    let [a, b, c] = ["a", "b", "c"].map(|letter| Expr::symbol(&format!("any_{letter}")));
    let [d, e, f] = ["d", "e", "f"].map(|letter| Expr::symbol(&format!("any_{letter}")));
    let zero = Expr::int(0);
    let squares = a.powi(2) + b.powi(2);
    let claims = match form {
        Form::Ratio { .. } => vec![],
        // a·C + b·S = c,   d·C + e·S = f
        Form::Pair { .. } => {
            let determinant = a * e - b * d;
            let (cos, sin) = (c * e - b * f, a * f - c * d);
            vec![
                ("pair 1", a * cos + b * sin, c * determinant),
                ("pair 2", d * cos + e * sin, f * determinant),
            ]
        }
        // tan = −a/b
        Form::Line => {
            let length = squares.sqrt();
            let (cos, sin) = (b, -a);
            vec![
                ("line", a * cos + b * sin, zero),
                ("line, of length 1", cos.powi(2) + sin.powi(2), length.powi(2)),
            ]
        }
        Form::Sincos => {
            let root = (squares - c.powi(2)).sqrt();
            let (cos, sin) = (a * c - b * root, b * c + a * root);
            vec![
                ("sine and cosine", a * cos + b * sin, c * squares),
                ("sine and cosine, of length 1", cos.powi(2) + sin.powi(2), squares.powi(2)),
            ]
        }
        Form::Quadratic { .. } => {
            let r = (b.powi(2) - a * c).sqrt() - b;
            vec![("quadratic", r.powi(2) + Expr::int(2) * b * r + a * c, zero)]
        }
        Form::Quartic(_) => vec![],
    };
    claims.into_iter().map(|(name, left, right)| (format!("solution: {name}"), [left, right])).collect()
}
