//! What the names in formulas stand for: the joints that they are about, and their numbers now.

use denavit::Robot;
use denavit::description::Description;
use denavit_report::document::{Math, Sign};
use denavit_report::{Document, render};
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Node, Symbol};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// The names that a document defines, in its order, and what they are about.
pub struct Definitions {
    defined: Vec<(Symbol, Expr)>,
    /// Sines and cosines with a short name: `C23`.
    short: BTreeMap<String, Expr>,
    joints: BTreeMap<String, BTreeSet<usize>>,
}

impl Definitions {
    /// Those of a document about a robot.
    pub fn of(description: &Description, document: &Document) -> Self {
        let variables: Vec<Symbol> = description.variables().iter().map(|v| v.symbol).collect();
        let mut this = Definitions { defined: vec![], short: BTreeMap::new(), joints: BTreeMap::new() };
        // A length belongs to the joint whose row holds it, or the last one before.
        let mut last = 0;
        for row in &description.rows {
            if let Some(k) = row.variable.and_then(|v| variables.iter().position(|s| *s == v.symbol)) {
                last = k;
            }
            let cells = [row.theta, row.d, row.a, row.alpha, row.gamma, row.b];
            for s in cells.into_iter().flat_map(Expr::symbols) {
                if !variables.contains(&s) {
                    this.joints.entry(s.name().to_string()).or_default().insert(last);
                }
            }
        }
        for (k, s) in variables.iter().enumerate() {
            this.joints.insert(s.name().to_string(), BTreeSet::from([k]));
        }
        for (m, names) in render::formulas(document) {
            this.learn(&m, &names);
        }
        this
    }

    fn learn(&mut self, m: &Math, names: &Vocabulary) {
        for e in Expr::postorder(&m.exprs()) {
            if let Node::Sin(angle) | Node::Cos(angle) = e.node() {
                let name = short(e, names);
                let about = self.about(angle);
                self.joints.entry(name.clone()).or_insert(about);
                self.short.insert(name, e);
            }
        }
        if let Math::Chain(left, rest) = m
            && let (Some(name), [(Sign::Equal, value)]) = (left.as_symbol(), &rest[..])
        {
            let about = self.about(*value);
            let known = self.joints.entry(name.name().to_string()).or_default();
            if known.is_empty() {
                known.extend(about);
            }
            self.defined.push((name, *value));
        }
    }

    /// The joints that an expression depends on.
    fn about(&self, e: Expr) -> BTreeSet<usize> {
        e.symbols().into_iter().filter_map(|s| self.joints.get(&*s.name())).flatten().copied().collect()
    }

    /// For each name the joints, from 0.
    pub fn joints(&self) -> BTreeMap<String, BTreeSet<usize>> {
        let known = self.joints.iter().filter(|(_, joints)| !joints.is_empty());
        known.map(|(name, joints)| (name.clone(), joints.clone())).collect()
    }

    /// The number of each name at a configuration; names whose sign a branch decides are left out unless one sign gives the
    /// joint's own value.
    pub fn values(&self, valued: &Description, robot: &Robot<f64>, q: &[f64]) -> BTreeMap<String, f64> {
        let mut known: HashMap<Symbol, f64> = HashMap::new();
        for (v, x) in valued.variables().iter().zip(q) {
            known.insert(v.symbol, *x);
        }
        known.extend(valued.known_values());
        let pose = robot.pose(q).matrix();
        for (column, letter) in ["n", "o", "a", "p"].iter().enumerate() {
            for (row, axis) in ["x", "y", "z"].iter().enumerate() {
                known.entry(Symbol::new(&format!("{letter}{axis}"))).or_insert(pose[row][column]);
            }
        }
        let mut values = BTreeMap::new();
        for (name, e) in &self.short {
            if let Ok(x) = e.eval(|s| known.get(&s).copied()) {
                values.insert(name.clone(), x);
            }
        }
        for (name, e) in &self.defined {
            let Ok(x) = e.eval(|s| known.get(&s).copied()) else { continue };
            known.entry(*name).or_insert(x);
            values.insert(name.name().to_string(), x);
        }
        values
    }
}

/// `C23`, as the name stands in formulas without signs of an index.
fn short(e: Expr, names: &Vocabulary) -> String {
    print(e, names, Style::Ascii).replace(['_', '{', '}'], "")
}
