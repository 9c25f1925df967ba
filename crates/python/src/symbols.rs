//! Formulas as nodes, for programs that compute with formulas themselves.

use crate::named::{body, options, reference};
use crate::trouble::{Kind, Trouble, apart};
use denavit::description::Description;
use denavit::forward::Outputs;
use denavit::inverse::InverseModel;
use denavit::velocity::{JacobianModel, Singularities};
use denavit_program::Step;
use denavit_report::Derivation;
use denavit_report::document::{Math, Sign};
use denavit_report::explain::Explanation;
use denavit_symbolic::{Expr, Node, Rational, Symbol, equal};
use pyo3::prelude::*;
use std::collections::HashMap;

/// What a node does, the nodes before it that it is made of, and what else belongs to it: a number, a name, an exponent.
pub type One = (String, Vec<usize>, String);

/// Nodes, and formulas by names: matrices of nodes, row by row.
pub type Listed = (Vec<One>, Vec<(String, Vec<Vec<usize>>)>);

/// Formulas that are listed.
#[derive(Default)]
struct List {
    nodes: Vec<One>,
    at: HashMap<Expr, usize>,
    formulas: Vec<(String, Vec<Vec<usize>>)>,
}

impl List {
    fn place(&mut self, e: Expr) -> usize {
        for e in Expr::postorder_of_new(&[e], |e| self.at.contains_key(&e)) {
            let at = |e: Expr| self.at[&e];
            let node = match e.node() {
                Node::Number(r) => ("number", vec![], r.to_string()),
                Node::Pi => ("pi", vec![], String::new()),
                Node::Symbol(s) => ("symbol", vec![], s.name().to_string()),
                Node::Neg(a) => ("neg", vec![at(a)], String::new()),
                Node::Add(a, b) => ("add", vec![at(a), at(b)], String::new()),
                Node::Sub(a, b) => ("sub", vec![at(a), at(b)], String::new()),
                Node::Mul(a, b) => ("mul", vec![at(a), at(b)], String::new()),
                Node::Div(a, b) => ("div", vec![at(a), at(b)], String::new()),
                Node::Pow(a, n) => ("pow", vec![at(a)], n.to_string()),
                Node::Sqrt(a) => ("sqrt", vec![at(a)], String::new()),
                Node::Sin(a) => ("sin", vec![at(a)], String::new()),
                Node::Cos(a) => ("cos", vec![at(a)], String::new()),
                Node::Atan2(y, x) => ("atan2", vec![at(y), at(x)], String::new()),
                Node::Sign(a) => ("sign", vec![at(a)], String::new()),
            };
            self.at.insert(e, self.nodes.len());
            self.nodes.push((node.0.into(), node.1, node.2));
        }
        self.at[&e]
    }

    fn add(&mut self, name: impl Into<String>, rows: impl IntoIterator<Item = Vec<Expr>>) {
        let rows = rows.into_iter().map(|row| row.into_iter().map(|e| self.place(e)).collect());
        let rows = rows.collect();
        self.formulas.push((name.into(), rows));
    }

    fn steps(&mut self, steps: &[Step]) {
        steps.iter().for_each(|step| self.add(format!("step {}", step.name), [vec![step.value]]));
    }

    fn done(self) -> Listed {
        (self.nodes, self.formulas)
    }
}

/// The link transforms, the pose and its steps.
///
/// # Errors
/// If there is no such frame or part.
pub fn forward(d: &Description, from: &str, to: &str, only: &str) -> Result<Listed, Trouble> {
    let outputs: Outputs = only.parse().map_err(|e| Trouble::new(Kind::Usage, format!("only: {e}")))?;
    let derivation = Derivation::new(d, reference(d, from)?, reference(d, to)?, outputs);
    let mut list = List::default();
    for link in &derivation.links {
        list.add("link", link.iter().map(|row| row.to_vec()));
    }
    if let Ok(matrix) = &derivation.model.matrix {
        list.add("pose", matrix.iter().map(|row| row.to_vec()));
    }
    list.steps(&derivation.steps);
    Ok(list.done())
}

/// The Jacobian, the determinants that are 0 where it is singular, and the steps.
///
/// # Errors
/// If there is no such body.
pub fn jacobian(d: &Description, of: &str) -> Result<Listed, Trouble> {
    let body = body(d, of)?;
    let mut list = List::default();
    let found = Singularities::derive(d, body);
    let shortest;
    let model = match &found {
        Ok(found) => &found.jacobian,
        Err(_) => {
            shortest = JacobianModel::shortest(d, body);
            &shortest
        }
    };
    if let Ok(matrix) = &model.matrix {
        list.add("jacobian", (0..6).map(|r| matrix.columns.iter().map(|c| c[r]).collect()));
    }
    for minor in found.iter().flat_map(|f| &f.minors) {
        list.add("determinant", [vec![minor.determinant.to_expr()]]);
    }
    let point = found.as_ref().ok().and_then(|found| found.of_its_point(d));
    for minor in point.iter().flat_map(|f| &f.minors) {
        list.add("point", [vec![minor.determinant.to_expr()]]);
    }
    list.steps(&model.algorithm.steps());
    Ok(list.done())
}

/// The parts of the torques, base parameters, and the steps.
///
/// # Errors
/// If parameters cannot be chosen.
pub fn dynamics(d: &Description, kept: &[String], dropped: &[String]) -> Result<Listed, Trouble> {
    let model = crate::formulas::torques(d, kept, dropped)?;
    let mut list = List::default();
    if let Some(parts) = &model.parts {
        list.add("inertia", parts.inertia.clone());
        list.add("velocity", parts.velocity.iter().map(|&e| vec![e]));
        list.add("gravity", parts.gravity.iter().map(|&e| vec![e]));
    }
    for base in &model.base.parameters {
        list.add(format!("base {}", base.symbol.name()), [vec![base.value]]);
    }
    list.steps(&model.torques.steps());
    Ok(list.done())
}

/// The equations of the closed form, step by step.
///
/// # Errors
/// If there is none.
pub fn inverse(d: &Description, given: Option<&[String]>, goal: &str) -> Result<Listed, Trouble> {
    let options = options(d, given, goal)?;
    let model = InverseModel::derive(d, &options)
        .map_err(|why| Trouble::new(Kind::Unsupported, format!("no closed form: {why}")))?;
    let explanation = Explanation::of(&model);
    let mut list = List::default();
    let mut equations = |name: String, statements: &mut dyn Iterator<Item = &Math>| {
        for math in statements {
            if let Math::Chain(left, rest) = math
                && let [(Sign::Equal, right)] = rest[..]
            {
                list.add(name.clone(), [vec![*left, right]]);
            }
        }
    };
    for step in &explanation.steps {
        let name = step.unknown.as_symbol().map_or("?".into(), |s| s.name().to_string());
        let all = step.names.iter().chain(&step.coefficients).chain(&step.solution);
        equations(format!("equation {name}"), &mut all.map(|s| &s.math));
    }
    equations("equation joints".into(), &mut explanation.joints.iter().map(|s| &s.math));
    equations("equation pose".into(), &mut explanation.leftovers.iter().map(|s| &s.math));
    Ok(list.done())
}

/// `7`, `-3/4`
fn rational(text: &str) -> Option<Expr> {
    let (above, below) = text.split_once('/').unwrap_or((text, "1"));
    let below = Rational::from_decimal(below)?.recip()?;
    Some(Expr::from(Rational::from_decimal(above)? * below))
}

/// Formulas out of nodes, one a node.
fn rebuilt(nodes: &[One]) -> Result<Vec<Expr>, Trouble> {
    let wrong = |what: &str| Trouble::new(Kind::Usage, format!("no formula: {what}"));
    let mut made: Vec<Expr> = Vec::with_capacity(nodes.len());
    for (op, of, text) in nodes {
        let parts: Option<Vec<Expr>> = of.iter().map(|&k| made.get(k).copied()).collect();
        let parts = parts.ok_or_else(|| wrong("a node of what comes behind it"))?;
        let e = match (op.as_str(), &parts[..]) {
            ("number", []) => rational(text).ok_or_else(|| wrong(text))?,
            ("pi", []) => Expr::pi(),
            ("symbol", []) => Symbol::new(text).into(),
            ("neg", [a]) => -*a,
            ("add", [a, b]) => *a + *b,
            ("sub", [a, b]) => *a - *b,
            ("mul", [a, b]) => *a * *b,
            ("div", [a, b]) => *a / *b,
            ("pow", [a]) => a.powi(text.parse().map_err(|_| wrong(text))?),
            ("sqrt", [a]) => a.sqrt(),
            ("sin", [a]) => a.sin(),
            ("cos", [a]) => a.cos(),
            ("atan2", [y, x]) => y.atan2(*x),
            ("sign", [a]) => a.sign(),
            _ => return Err(wrong(op)),
        };
        made.push(e);
    }
    Ok(made)
}

/// Which of pairs of formulas, nodes of two lists, are not proved to be equal.
#[pyfunction]
pub fn not_proved(
    py: Python<'_>,
    these: Vec<One>,
    those: Vec<One>,
    pairs: Vec<(usize, usize)>,
) -> PyResult<Vec<usize>> {
    apart(py, move || {
        let (these, those) = (rebuilt(&these)?, rebuilt(&those)?);
        let is_open = |&(a, b): &(usize, usize)| match (these.get(a), those.get(b)) {
            (Some(&a), Some(&b)) => a != b && !equal(a, b).is_equal(),
            _ => true,
        };
        Ok(pairs.iter().enumerate().filter(|(_, pair)| is_open(pair)).map(|(k, _)| k).collect())
    })
}
