//! The certificate as JSON, a line a claim; `docs/certificates.md` describes it.

use crate::arm::{Frame, View, key};
use crate::claims::{Certificate, Quantity};
use crate::field::Field;
use crate::text::{Python, text};
use denavit::geometry::Transform;
use denavit_symbolic::poly::Poly;
use denavit_symbolic::{Expr, Rational};
use serde_json::{Map, Value, json};

impl Certificate {
    /// The certificate as text, for the checker.
    pub fn to_json(&mut self) -> String {
        let claims: Vec<String> = (0..self.claims.len()).map(|i| self.claim_json(i)).collect();
        let definitions: Vec<Value> = (0..self.definitions.len())
            .map(|i| {
                let (name, quantity) = self.definitions[i].clone();
                json!([self.field.names.of(name), quantity_json(&mut self.field, &quantity)])
            })
            .collect();
        let rows: Vec<Value> = (0..self.description.rows.len()).map(|i| self.row_json(i)).collect();
        let (base, tool) = (self.description.base, self.description.tool);
        let [base, tool] = [base, tool].map(|x| transform_json(&mut self.field, &x));
        let field = &mut self.field;
        let variables: Vec<String> = self.variables.iter().map(|v| field.names.of(*v)).collect();
        let parameters = field.parameters.clone();
        let parameters: Vec<String> = parameters.into_iter().map(|p| field.names.of(p)).collect();
        let bases = field.bases.clone();
        let angle = |b: &crate::field::Base, field: &mut Field| {
            let [c, s] = [b.cos, b.sin].map(|a| field.atoms[usize::from(a)].clone());
            json!([c, s, text(field, b.angle.to_expr(), &Python)])
        };
        let angles: Vec<Value> = bases.iter().map(|b| angle(b, field)).collect();
        let roots = field.roots.clone();
        let root = |r: &crate::field::Root, field: &mut Field| {
            json!([field.atoms[usize::from(r.atom)], text(field, r.of, &Python)])
        };
        let roots: Vec<Value> = roots.iter().map(|r| root(r, field)).collect();
        let missing = self.missing.iter().map(|(name, why)| format!("{name} ({why})"));
        let summary: Vec<&str> = self.claims.iter().map(|c| c.name.as_str()).collect();
        let names: Map<String, Value> =
            field.names.changed.iter().map(|(new, printed)| (new.clone(), json!(printed))).collect();
        let head = [
            ("format", json!("denavit certificate 1")),
            ("names", json!(names)),
            ("variables", json!(variables)),
            ("parameters", json!(parameters)),
            ("angles", json!(angles)),
            ("roots", json!(roots)),
            ("summary", json!(summary)),
            ("missing", json!(missing.collect::<Vec<String>>())),
        ];
        let mut out = String::from("{\n");
        for (key, value) in head {
            out += &format!("\"{key}\": {value},\n");
        }
        let name = json!(self.description.name);
        let convention = self.description.convention.name();
        out += &format!("\"robot\": {{\"name\": {name}, \"convention\": \"{convention}\", \"rows\": ");
        out += &lines(&rows);
        out += &format!(", \"base\": {base}, \"tool\": {tool}}},\n");
        out += &format!("\"definitions\": {},\n\"claims\": {}\n}}\n", lines(&definitions), lines(&claims));
        out
    }

    fn row_json(&mut self, row: usize) -> Value {
        let cells = self.cells(row).into_iter();
        Value::Object(cells.map(|(c, e)| (key(c).into(), json!(text(&mut self.field, e, &Python)))).collect())
    }

    fn claim_json(&mut self, i: usize) -> String {
        let claim = self.claims[i].clone();
        let field = &mut self.field;
        let cofactors: Map<String, Value> = claim
            .cofactors
            .iter()
            .map(|(atom, p)| (field.atoms[usize::from(*atom)].clone(), terms(field, p)))
            .collect();
        let [left, right] = [&claim.left, &claim.right].map(|side| quantity_json(field, side));
        let (name, cofactors) = (json!(claim.name), json!(cofactors));
        format!(r#"{{"name": {name}, "left": {left}, "right": {right}, "cofactors": {cofactors}}}"#)
    }
}

fn lines(values: &[impl ToString]) -> String {
    let lines: Vec<String> = values.iter().map(ToString::to_string).collect();
    if lines.is_empty() { "[]".into() } else { format!("[\n  {}]", lines.join(",\n  ")) }
}

fn transform_json(field: &mut Field, x: &Transform<Expr>) -> Value {
    let rows = x.matrix().into_iter().take(3);
    json!(rows.map(|row| row.map(|e| text(field, e, &Python))).collect::<Vec<_>>())
}

fn quantity_json(field: &mut Field, quantity: &Quantity) -> Value {
    let one = |all: &[usize]| all.iter().map(|k| k + 1).collect::<Vec<usize>>();
    match quantity {
        Quantity::Formula(e) => json!(text(field, *e, &Python)),
        Quantity::Terms(p) => json!({ "terms": terms(field, p) }),
        Quantity::Frame { from, to, place } => {
            json!({ "frame": [frame(*from), frame(*to), place.0 + 1, place.1 + 1] })
        }
        Quantity::Jacobian { view, row, joint } => {
            json!({ "jacobian": [view_json(field, view), row + 1, joint + 1] })
        }
        Quantity::Minor { view, rows, joints, along } => {
            json!({ "minor": [view_json(field, view), one(rows), one(joints), along + 1] })
        }
    }
}

fn view_json(field: &mut Field, view: &View) -> Value {
    let offset = view.offset.map(|e| text(field, e, &Python));
    json!([frame(view.body), frame(view.axes), frame(view.at), offset])
}

fn frame(frame: Frame) -> Value {
    match frame {
        Frame::Base => json!("base"),
        Frame::Behind(i) => json!(i),
        Frame::Tool => json!("tool"),
    }
}

/// Terms: a coefficient, then names and exponents.
fn terms(field: &Field, p: &Poly) -> Value {
    let term = |(m, r): &(denavit_symbolic::poly::Monomial, Rational)| {
        let mut parts = vec![match r.to_integer() {
            Some(n) => json!(n),
            None => {
                let (n, d) = r.digits();
                json!(format!("{}{n}/{d}", if r.is_negative() { "-" } else { "" }))
            }
        }];
        for &(atom, n) in m.factors() {
            parts.push(json!(field.atoms[usize::from(atom)]));
            parts.push(json!(n));
        }
        Value::Array(parts)
    };
    Value::Array(p.terms().iter().map(term).collect())
}
