//! The steps of a solver without branches, so that loops over lanes become vector code.

use crate::compiled::{Body, Pair, Step, formulas};
use crate::names::Names;
use crate::solver::{Branching, Kind, Plan, defined};
use crate::spelling::Spelling;
use crate::{Language, Precision};
use denavit_program::solver::CANDIDATE;
use denavit_symbolic::{Expr, Symbol};

/// What is computed in one pass, once the signs up to here are chosen.
pub(super) struct Stage<'p> {
    /// The node that opens it, if any, with its number.
    pub parts: Vec<Part<'p>>,
}

pub(super) enum Part<'p> {
    Node(usize, &'p Branching),
    Steps(&'p [Step]),
}

impl Part<'_> {
    pub fn defines(&self) -> Vec<Symbol> {
        match self {
            Part::Node(_, node) => node.results.clone(),
            Part::Steps(steps) => steps.iter().flat_map(defined).collect(),
        }
    }

    pub fn reads(&self) -> Vec<Symbol> {
        let read: Vec<Expr> = match self {
            Part::Node(_, node) => {
                node.operands().into_iter().chain(node.guard).chain([node.scale]).collect()
            }
            Part::Steps(steps) => steps.iter().flat_map(formulas).collect(),
        };
        read.iter().flat_map(|e| e.symbols()).collect()
    }
}

/// Passes of a solver: each but the first opens with a node that branches.
pub(super) fn stages<'p>(plan: &'p Plan) -> Vec<Stage<'p>> {
    let mut stages = vec![Stage { parts: vec![] }];
    for (i, level) in plan.levels.iter().enumerate() {
        stages.last_mut().expect("one").parts.push(Part::Steps(level));
        if let Some(node) = plan.nodes.get(i) {
            if node.root.branches() > 1 {
                stages.push(Stage { parts: vec![] });
            }
            stages.last_mut().expect("one").parts.push(Part::Node(i, node));
        }
    }
    stages.last_mut().expect("one").parts.push(Part::Steps(&plan.leaf));
    stages
}

/// A pass without branches.
pub(super) struct Lanes<'a> {
    pub plan: &'a Plan<'a>,
    pub out: Body,
    pub names: Names,
    /// Rows are flagged one by one, branches all together.
    pub is_row: bool,
}

impl Lanes<'_> {
    pub fn formula(&self, e: Expr) -> String {
        Spelling { language: Language::Rust, precision: Precision::Double, names: &self.names }.formula(e)
    }

    pub fn stage(&mut self, stage: &Stage, is_near: bool) {
        for part in &stage.parts {
            match part {
                Part::Steps(steps) => self.steps(steps, is_near),
                Part::Node(i, node) => self.node(*i, node),
            }
        }
    }

    fn rare(&mut self, condition: &str) {
        if self.is_row {
            let flag = format!("if {condition} {{ 1.0 }} else {{ 0.0 }}");
            self.out.statement("rare[i] +=", &flag);
        } else {
            self.out.statement("rare |=", condition);
        }
    }

    fn node(&mut self, i: usize, node: &Branching) {
        let kind = node.kind();
        let mut arguments: Vec<String> = node.operands().into_iter().map(|e| self.formula(e)).collect();
        if matches!(kind, Kind::Sincos | Kind::Quadratic) {
            let rest = arguments.split_off(3);
            arguments = vec![format!("[{}]", arguments.join(", "))];
            arguments.extend(rest);
        }
        arguments.extend(node.guard.map(|e| self.formula(e)));
        arguments.push(self.formula(node.scale));
        if node.root.branches() > 1 {
            arguments.push(format!("sign_{}", i + 1));
        }
        let name = |s: &Self, x: Symbol| {
            if s.plan.reads(x) { s.names.of(x).to_string() } else { "_".into() }
        };
        let values = 1 + usize::from(node.root.is_angle());
        let mut results: Vec<String> = node.results[..values].iter().map(|x| name(self, *x)).collect();
        let is_there = matches!(kind, Kind::Sincos | Kind::Quadratic);
        if is_there {
            results.push("is_there".into());
        }
        results.push("is_rare".into());
        self.out.blank();
        self.out.line(&format!("// {}", node.label));
        let call = format!("roots::{}_lane({})", kind.name(), arguments.join(", "));
        self.out.statement(&format!("let ({}) =", results.join(", ")), &call);
        let sign = node.results.get(values).filter(|sign| self.plan.reads(**sign));
        if let Some(sign) = sign {
            self.out.line(&format!("let {} = sign_{};", self.names.of(*sign), i + 1));
        }
        if let Some(near) = &node.near {
            let [value, size] = [near.value, near.size].map(|e| self.formula(e));
            let value = if near.is_square { format!("({value})") } else { format!("f64::abs({value})") };
            let least = match near.least() {
                Some(least) => format!("{least:e}"),
                None => format!("{:e} * ({size})", near.share),
            };
            self.out.statement("let is_rare =", &format!("is_rare | ({value} <= {least})"));
        }
        self.rare("is_rare & (missing == 0.0)");
        if is_there {
            self.out.line("let missing = missing + roots::missing(is_there);");
        }
    }

    /// Leaves variables that are not numbers, or not a pose as precise as numbers are, to the careful function.
    pub fn unusual(&mut self) {
        // A residual of 1e-9 is what is asked of a pose that is off by a quarter of that.
        let size = self.formula(self.plan.size);
        let size = format!("({size} <= f64::MAX)");
        let usual = match self.plan.defect.map(|e| self.formula(e)) {
            Some(defect) => format!("!(({defect} <= 2.5e-10) & {size})"),
            None => format!("!{size}"),
        };
        self.rare(&usual);
    }

    /// Leaves what comes near a solution, and is none, to the careful function.
    pub fn candidate(&mut self, residual: &str) {
        let between = format!("({residual} > roots::TOLERANCE) & ({residual} <= {CANDIDATE:e})");
        self.out.statement("let is_candidate =", &between);
        self.rare("is_candidate");
    }

    pub fn steps(&mut self, steps: &[Step], is_near: bool) {
        for step in steps {
            match step {
                Step::Pairs(pairs) => pairs.iter().for_each(|p| self.pair(p, is_near)),
                Step::Atan2 { name, y, x } => {
                    let name = self.names.of(Symbol::new(name)).to_string();
                    if is_near {
                        let [y, x] = [*y, *x].map(|e| self.named(e));
                        self.out.line(&format!("let {name} = near_atan2({y}, {x});"));
                        self.rare(&format!("!atan2_in_range({y}, {x}) & (missing == 0.0)"));
                    } else {
                        let call = format!("atan2({}, {})", self.formula(*y), self.formula(*x));
                        self.out.statement(&format!("let {name} ="), &call);
                    }
                }
                Step::Let { name, value } => {
                    let head = format!("let {} =", self.names.of(Symbol::new(name)));
                    let formula = self.formula(*value);
                    self.out.statement(&head, &formula);
                }
                Step::Break | Step::Result { .. } => {}
            }
        }
    }

    /// A name, or a formula that gets one.
    fn named(&mut self, e: Expr) -> String {
        let formula = self.formula(e);
        if e.as_symbol().is_some() || e.symbols().is_empty() {
            return formula;
        }
        let name = self.names.free("angle");
        self.out.statement(&format!("let {name} ="), &formula);
        name
    }

    fn pair(&mut self, p: &Pair, is_near: bool) {
        let name = |n: &Option<String>| match n {
            Some(name) => self.names.of(Symbol::new(name)).to_string(),
            None => "_".into(),
        };
        let head = format!("let ({}, {}) =", name(&p.sine), name(&p.cosine));
        if is_near {
            let angle = self.named(p.angle);
            self.out.line(&format!("{head} near_sin_cos({angle});"));
            self.rare(&format!("!sin_cos_in_range({angle})"));
        } else {
            let angle = self.formula(p.angle);
            self.out.statement(&head, &format!("sin_cos({angle})"));
        }
    }
}
