//! Follows a program as far as its robots need it: assignments, loops over known values, conditions that are known, functions of the
//! program. What is not followed is kept as a value that says so, with its place, and is an error only where a robot needs it.

use super::code::Language;
use super::parse::{Act, Form, Function, Node, Round, Statement};
use super::value::{Formula, Lost, MAX_ITEMS, Store, Through, Value};
use crate::description::diagnostic::{Diagnostic, Severity};
use std::collections::{HashMap, HashSet};
use std::ops::Range;
use std::rc::Rc;

/// So many steps are followed.
const MAX_STEPS: usize = 200_000;
/// How deep values, blocks and calls stand in one another while they are followed.
const MAX_DEPTH: usize = 150;
/// How deep functions of the program call one another.
pub(super) const MAX_CALLS: usize = 8;

/// How a block ended.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Flow {
    Goes,
    Breaks,
    Continues,
    Returns(Value),
}

/// A run of a program.
pub(super) struct Run<'p> {
    pub text: &'p str,
    pub language: Language,
    pub store: Store,
    /// Names of the program, then those of each function under way.
    pub scopes: Vec<HashMap<String, Value>>,
    pub functions: HashMap<&'p str, &'p Function>,
    pub classes: HashMap<&'p str, &'p [Statement]>,
    pub findings: Vec<Diagnostic>,
    /// Nothing that is made from here on is known.
    pub lost: Option<Lost>,
    /// Bodies added to a `rigidBodyTree`, with the names of those they stand on.
    pub added: Vec<(usize, Value, Range<usize>)>,
    /// Joints whose rows were set, in order.
    pub set: Vec<usize>,
    pub tree_lost: Option<Lost>,
    /// Links are made where it is unsure that the program gets there.
    pub links_lost: Option<Lost>,
    /// True where the values of functions are asked for.
    pub is_asked: bool,
    /// True where the program is run, not imported.
    pub is_main: bool,
    /// Where it is unsure that the program gets there: names that are assigned.
    pub unsure: Vec<HashSet<String>>,
    /// What parameters are where nothing is given for them: that is found where a function is defined.
    pub defaults: HashMap<*const Function, Vec<Option<Value>>>,
    /// Objects of Python with attributes, and those of them that have a second name: what is changed by one is changed by the other.
    pub owners: HashSet<String>,
    pub shared: HashSet<String>,
    /// What `end` is in an index.
    pub ends: Vec<usize>,
    steps: usize,
    depth: usize,
}

impl<'p> Run<'p> {
    pub fn new(text: &'p str, language: Language, is_main: bool) -> Self {
        Run {
            text,
            language,
            store: Store::default(),
            scopes: vec![HashMap::new()],
            functions: HashMap::new(),
            classes: HashMap::new(),
            findings: vec![],
            lost: None,
            added: vec![],
            set: vec![],
            tree_lost: None,
            links_lost: None,
            is_asked: true,
            is_main,
            unsure: vec![],
            defaults: HashMap::new(),
            owners: HashSet::new(),
            shared: HashSet::new(),
            ends: vec![],
            steps: 0,
            depth: 0,
        }
    }

    pub fn is_python(&self) -> bool {
        self.language == Language::Python
    }

    /// What is not followed, shown as it is written.
    pub fn lost(&self, span: &Range<usize>, why: &str) -> Lost {
        let source = self.text.get(span.clone()).unwrap_or("");
        let line: String = source.lines().next().unwrap_or("").chars().take(40).collect();
        let dots = if line.len() < source.len() { "…" } else { "" };
        Lost { span: span.clone(), message: format!("`{}{dots}` {why}", line.trim()).into() }
    }

    pub fn unknown(&self, span: &Range<usize>) -> Value {
        Value::Unknown(self.lost(span, "is not followed"))
    }

    pub fn find(&mut self, severity: Severity, span: &Range<usize>, message: &str) {
        let finding = Diagnostic { severity, span: span.clone(), message: message.into(), hint: None };
        if self.findings.len() < 200 && !self.findings.contains(&finding) {
            self.findings.push(finding);
        }
    }

    /// Counts steps; true once there are too many.
    pub fn step(&mut self, count: usize, span: &Range<usize>) -> bool {
        self.steps = self.steps.saturating_add(count);
        let is_over = self.steps > MAX_STEPS;
        if is_over && self.lost.is_none() {
            self.lost = Some(self.lost(span, "is not followed: the program takes too many steps"));
        }
        is_over
    }

    pub fn named(&self, name: &str) -> Option<&Value> {
        let local = self.scopes.last().and_then(|s| s.get(name));
        // Functions of MATLAB have names of their own alone.
        let of_all = || self.scopes.first().filter(|_| self.is_python()).and_then(|s| s.get(name));
        local.or_else(of_all)
    }

    pub fn assign(&mut self, name: &str, value: Value) {
        if let Some(names) = self.unsure.last_mut() {
            names.insert(name.to_string());
        }
        if let Some(scope) = self.scopes.last_mut() {
            if self.owners.contains(name) {
                // Attributes are those of the object that had the name.
                scope.retain(|k, _| k.strip_prefix(name).is_none_or(|rest| !rest.starts_with('.')));
            }
            scope.insert(name.to_string(), value);
        }
    }

    /// All values of names, for links that no robot is made of.
    pub fn values(&self) -> impl Iterator<Item = (&String, &Value)> {
        self.scopes.first().into_iter().flatten()
    }

    /// Notes that something is changed.
    pub fn change(&mut self, value: &Value) {
        if !self.unsure.is_empty() {
            self.store.changed.push(value.clone());
        }
    }

    /// Functions of the program are known before they stand in it.
    pub fn define(&mut self, statements: &'p [Statement]) {
        for statement in statements {
            if let Act::Function(function) = &statement.act {
                self.functions.insert(&function.name, function);
            }
        }
    }

    // Statements -----------------------------------------------------------------------------------------------------

    pub fn block(&mut self, statements: &'p [Statement]) -> Flow {
        for statement in statements {
            if self.step(1, &statement.span) {
                return Flow::Goes;
            }
            if self.depth >= MAX_DEPTH {
                self.lost = self
                    .lost
                    .take()
                    .or_else(|| Some(self.lost(&statement.span, "is not followed: too deep")));
                return Flow::Goes;
            }
            self.depth += 1;
            let flow = self.statement(statement);
            self.depth -= 1;
            if flow != Flow::Goes {
                return flow;
            }
        }
        Flow::Goes
    }

    fn statement(&mut self, statement: &'p Statement) -> Flow {
        match &statement.act {
            Act::Value(node) => {
                self.value(node);
            }
            Act::Assign(targets, sign, value) => {
                let mut found = self.value(value);
                if !sign.is_empty() {
                    let Some(target) = targets.first() else { return Flow::Goes };
                    let before = self.value(target);
                    if let (Value::List(k), "+") = (&before, sign.as_str())
                        && !self.store.lists[*k].is_array
                    {
                        self.extend(*k, &found, &statement.span);
                        return Flow::Goes;
                    }
                    let array = match before {
                        Value::List(k) if self.store.lists[k].is_array => Some(k),
                        _ => None,
                    };
                    found = self.binary(sign, before, found, &statement.span);
                    if let Some(k) = array {
                        self.put_in_place(k, &found, &statement.span);
                        return Flow::Goes;
                    }
                }
                for target in targets {
                    self.set(target, found.clone());
                }
                self.share_by(targets, value);
            }
            Act::For(round, body) => return self.repeat(round, body, &statement.span),
            Act::If(blocks) => return self.choose(blocks, &statement.span),
            Act::Unsure(blocks) => {
                let blocks: Vec<&'p [Statement]> = blocks.iter().map(Vec::as_slice).collect();
                self.perhaps(&blocks, &statement.span, true);
            }
            Act::Try(blocks) => {
                let Some((first, others)) = blocks.split_first() else { return Flow::Goes };
                let flow = self.block(first);
                let others: Vec<&'p [Statement]> = others.iter().map(Vec::as_slice).collect();
                self.perhaps(&others, &statement.span, true);
                return flow;
            }
            Act::Block(body) => return self.block(body),
            Act::Function(function) => {
                // In functions and under conditions it depends on where the program is.
                if self.scopes.len() > 1 || !self.unsure.is_empty() {
                    let unknown = self.unknown(&(statement.span.start..statement.span.start + 3));
                    self.assign(&function.name, unknown);
                } else {
                    self.functions.insert(&function.name, function);
                    self.find_defaults(function);
                }
            }
            Act::Class(name, body) => {
                self.classes.insert(name, body);
                for one in body {
                    if let Act::Function(function) = &one.act {
                        self.find_defaults(function);
                    }
                }
            }
            Act::Import(names) => {
                for (name, original) in names {
                    // Of a number it makes one that is not followed.
                    if name != original || name == "tau" {
                        self.assign(name, Value::Known(original.as_str().into()));
                    }
                }
            }
            Act::Free(names) => {
                for name in names {
                    self.forget(name);
                }
            }
            Act::Return(node) => {
                let value = node.as_ref().map_or(Value::None, |n| self.value(n));
                return Flow::Returns(value);
            }
            Act::Break => return Flow::Breaks,
            Act::Continue => return Flow::Continues,
            Act::Nothing => {}
            Act::Other(names) => {
                let lost = self.lost(&statement.span, "is not followed");
                // What it may say of a name that has no value yet.
                let first = names.first().filter(|_| self.text[statement.span.clone()].contains('='));
                if let Some(name) = first.filter(|name| self.named(name).is_none()) {
                    self.assign(name, Value::Unknown(lost.clone()));
                }
                for name in names {
                    if let Some(known) = self.named(name).cloned() {
                        self.store.lose(&known, &lost);
                        self.assign(name, Value::Unknown(lost.clone()));
                    }
                }
            }
            Act::Unread => {
                self.lost = self.lost.take().or_else(|| Some(self.lost(&statement.span, "is not followed")));
            }
        }
        Flow::Goes
    }

    fn forget(&mut self, name: &str) {
        let unsure = self.unsure.last_mut();
        if let Some(names) = unsure {
            names.insert(name.to_string());
        }
        if let Some(scope) = self.scopes.last_mut() {
            if name == "all" {
                scope.clear();
            } else {
                scope.remove(name);
            }
        }
    }

    fn repeat(&mut self, round: &'p Round, body: &'p [Statement], span: &Range<usize>) -> Flow {
        let values = self.value(&round.values);
        let Ok(mut through) = self.rounds(&values) else {
            return self.perhaps_often(round, &values, body, span);
        };
        let flow = loop {
            let item = match self.store.next(&mut through) {
                Ok(Some(item)) => item,
                Ok(None) => break Flow::Goes,
                Err(_) => break self.perhaps_often(round, &values, body, span),
            };
            if self.step(1, span) {
                break Flow::Goes;
            }
            self.set(&round.target, item);
            match self.block(body) {
                Flow::Breaks => break Flow::Goes,
                Flow::Returns(value) => break Flow::Returns(value),
                Flow::Goes | Flow::Continues => {}
            }
        };
        self.store.used(&through);
        flow
    }

    /// A loop of which it is not known what it goes through: what it may go through is not known behind it.
    fn perhaps_often(
        &mut self,
        round: &'p Round,
        values: &Value,
        body: &'p [Statement],
        span: &Range<usize>,
    ) -> Flow {
        let lost = self.lost(span, "is not followed: it changes what it goes through");
        for list in self.store.read_by(values) {
            self.store.lose(&list, &lost);
        }
        let unknown = self.unknown(&round.values.span);
        self.set(&round.target, unknown);
        self.perhaps(&[body], &(span.start..round.values.span.end), true);
        Flow::Goes
    }

    /// What a loop goes through: MATLAB's goes through columns.
    fn rounds(&self, values: &Value) -> Result<Through, Option<Lost>> {
        match values {
            Value::Matrix(rows) if rows.len() > 1 => Err(None),
            Value::Number(_) if !self.is_python() => {
                self.store.through(&Value::Matrix(vec![vec![values.clone()]].into()))
            }
            _ => self.store.through(values),
        }
    }

    fn choose(&mut self, blocks: &'p [(Option<Node>, Vec<Statement>)], span: &Range<usize>) -> Flow {
        for (k, (condition, block)) in blocks.iter().enumerate() {
            let is_true = condition.as_ref().map_or(Some(true), |c| {
                let value = self.value(c);
                self.store.truth(&value)
            });
            match is_true {
                Some(true) => return self.block(block),
                Some(false) => {}
                None => {
                    let rest: Vec<&'p [Statement]> = blocks[k..].iter().map(|b| b.1.as_slice()).collect();
                    let head = condition.as_ref().map_or(span.end, |c| c.span.end);
                    self.perhaps(&rest, &(span.start..head), false);
                    return Flow::Goes;
                }
            }
        }
        Flow::Goes
    }

    /// Follows blocks of which it is unsure that they run: what they say is not known behind them. What is made in blocks that may run
    /// often is not known either.
    fn perhaps(&mut self, blocks: &[&'p [Statement]], span: &Range<usize>, is_vague: bool) {
        let lost = self.lost(span, "is not followed: what it does depends on what is not known");
        let changed = std::mem::take(&mut self.store.changed);
        let (robots, sets, added) = (self.store.robots.len(), self.set.len(), self.added.len());
        let links = self.store.links.len();
        let mut names = HashSet::new();
        for block in blocks {
            let before = self.scopes.last().cloned().unwrap_or_default();
            if self.step(before.len(), span) {
                return;
            }
            self.unsure.push(HashSet::new());
            let flow = self.block(block);
            names.extend(self.unsure.pop().unwrap_or_default());
            if let Some(scope) = self.scopes.last_mut() {
                *scope = before;
            }
            if matches!(flow, Flow::Returns(_)) || (flow != Flow::Goes && !is_vague) {
                self.lost.get_or_insert_with(|| lost.clone());
            }
        }
        let mut all = std::mem::replace(&mut self.store.changed, changed);
        if is_vague {
            all.extend((robots..self.store.robots.len()).map(Value::Robot));
        }
        if self.store.links.len() > links {
            self.links_lost.get_or_insert_with(|| lost.clone());
        }
        if self.set.len() > sets || self.added.len() > added {
            self.tree_lost.get_or_insert_with(|| lost.clone());
        }
        for value in all {
            self.store.lose(&value, &lost);
            self.change(&value);
        }
        for name in names {
            self.assign(&name, Value::Unknown(lost.clone()));
        }
    }

    // Values ---------------------------------------------------------------------------------------------------------

    pub fn value(&mut self, node: &Node) -> Value {
        if self.depth >= MAX_DEPTH || self.step(1, &node.span) {
            return self.unknown(&node.span);
        }
        self.depth += 1;
        let value = self.evaluated(node);
        self.depth -= 1;
        value
    }

    fn evaluated(&mut self, node: &Node) -> Value {
        let span = &node.span;
        match &node.form {
            Form::Number => {
                let text: String =
                    self.text[span.clone()].chars().filter(|c| *c != '_' && !c.is_whitespace()).collect();
                let text = text.trim_matches(['(', ')']);
                match text.parse::<f64>() {
                    Ok(number) => Value::Number(Formula::new(text, Some(number), span.clone())),
                    Err(_) => self.unknown(span),
                }
            }
            Form::Text(text) => Value::Text(text.as_str().into()),
            Form::Name(name) => {
                self.share(name, span);
                self.of_name(name, span)
            }
            Form::Attribute(inner, name) => self.attribute(node, inner, name),
            Form::Call(inner, arguments) => self.call(node, inner, arguments),
            Form::Unary(sign, inner) => {
                let value = self.value(inner);
                match (sign.as_str(), &value) {
                    (_, Value::Unknown(_)) | ("+", _) => value,
                    ("-", _) => self.each_number(&value, span, &|f| f.negated(f.span.clone())),
                    ("not" | "~" | "!", value) => match self.store.truth(value) {
                        Some(b) => Value::Bool(!b),
                        None => self.unknown(span),
                    },
                    _ => self.unknown(span),
                }
            }
            Form::Binary(sign, left, right) => {
                let left = self.value(left);
                match (sign.as_str(), self.store.truth(&left)) {
                    ("and" | "&&", Some(false)) | ("or" | "||", Some(true)) => left,
                    ("and" | "&&" | "or" | "||", Some(_)) => self.value(right),
                    _ => {
                        let right = self.value(right);
                        self.binary(sign, left, right, span)
                    }
                }
            }
            Form::Matrix(rows, is_cell) => self.matrix(rows, *is_cell, span),
            Form::List(all) => {
                let mut items = vec![];
                for one in all {
                    if let Form::Unary(sign, inner) = &one.form
                        && sign == "*"
                    {
                        let value = self.value(inner);
                        match self.store.items(&value) {
                            Ok(more) => items.extend(more),
                            Err(_) => return self.unknown(&one.span),
                        }
                    } else {
                        items.push(self.value(one));
                    }
                }
                if items.len() > MAX_ITEMS { self.unknown(span) } else { self.store.list(items, false) }
            }
            Form::Each(body, rounds) => {
                let mut items = vec![];
                match self.each(body, rounds, &mut items) {
                    Some(()) => self.store.list(items, false),
                    None => self.unknown(span),
                }
            }
            Form::Range(ends) => self.range(ends, span),
            Form::Choice(three) => {
                let [yes, condition, no] = three.as_ref();
                let value = self.value(condition);
                match self.store.truth(&value) {
                    Some(true) => self.value(yes),
                    Some(false) => self.value(no),
                    None => self.unknown(span),
                }
            }
            Form::Transposed(inner) => match self.value(inner) {
                Value::Matrix(rows) => {
                    let width = rows.first().map_or(0, Vec::len);
                    let turned = (0..width).map(|k| rows.iter().map(|r| r[k].clone()).collect()).collect();
                    Value::Matrix(Rc::new(turned))
                }
                other @ (Value::Number(_) | Value::Unknown(_) | Value::Link(_)) => other,
                _ => self.unknown(span),
            },
            Form::Other => self.unknown(span),
        }
    }

    /// `[value for names in values if all]`
    fn each(&mut self, body: &Node, rounds: &[Round], items: &mut Vec<Value>) -> Option<()> {
        let Some((first, rest)) = rounds.split_first() else {
            if items.len() >= MAX_ITEMS {
                return None;
            }
            items.push(self.value(body));
            return Some(());
        };
        let values = self.value(&first.values);
        let mut through = self.store.through(&values).ok()?;
        let kept = self.scopes.last().cloned()?;
        if self.step(kept.len(), &body.span) {
            return None;
        }
        let mut found = Some(());
        loop {
            let one = match self.store.next(&mut through) {
                Ok(Some(one)) => one,
                Ok(None) => break,
                Err(_) => {
                    found = None;
                    break;
                }
            };
            if self.step(1, &body.span) {
                return None;
            }
            self.set(&first.target, one);
            let mut holds = true;
            for condition in &first.conditions {
                let value = self.value(condition);
                match self.store.truth(&value) {
                    Some(b) => holds &= b,
                    None => found = None,
                }
            }
            if holds && found.is_some() {
                found = self.each(body, rest, items);
            }
            if found.is_none() {
                break;
            }
        }
        self.store.used(&through);
        *self.scopes.last_mut()? = kept;
        found
    }

    /// What `end` is in an index under way.
    pub fn with_end(&mut self, end: usize, node: &Node) -> Value {
        self.ends.push(end);
        let value = self.value(node);
        self.ends.pop();
        value
    }

    pub fn end(&self) -> Option<usize> {
        self.ends.last().copied()
    }
}

/// The place of an index of Python, which counts from the end where it is negative.
pub(super) fn position(index: i64, length: usize) -> Option<usize> {
    let length_signed = i64::try_from(length).ok()?;
    let index = if index < 0 { index + length_signed } else { index };
    usize::try_from(index).ok().filter(|i| *i < length)
}
