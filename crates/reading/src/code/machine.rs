//! Runs statements on formulas: names and their values, branches and loops that are known.

use super::Dialect;
use super::matlab::is_display;
use super::place::{is_aliased, shallow};
use super::python::is_main;
use super::report;
use super::scalar::{Budget, Read, Scalar, Stop, refuse, refuse_hint};
use super::tree::{Definition, Kind, Node, Op, Span, Statement, StatementKind, SuffixKind, changed, given};
use super::value::{Closure, Object};
use super::{Assigned, MAX_DEPTH, MAX_REFUSALS, MAX_STATEMENTS, MAX_TURNS, Returned, Shown};
use denavit_symbolic::Expr;
use denavit_symbolic::parse::ParseError;
use std::collections::{BTreeMap, BTreeSet};

/// A variable.
#[derive(Debug, Default)]
pub(super) struct Slot<'a> {
    /// `None` if a refused statement was to give it its value.
    pub value: Option<Object<'a>>,
    /// Where its value was put down.
    pub record: Option<usize>,
    /// Where entries of it were set since.
    pub touched: Option<Span>,
}

impl<'a> Slot<'a> {
    pub fn of(value: Object<'a>) -> Self {
        Slot { value: Some(value), ..Slot::default() }
    }
}

/// The variables of a function that runs.
#[derive(Debug, Default)]
pub(super) struct Frame<'a> {
    pub id: u64,
    pub slots: BTreeMap<&'a str, Slot<'a>>,
    /// The frame of the function around it.
    pub home: Option<(usize, u64)>,
    /// The number of arguments.
    pub given: usize,
}

/// How a statement ends.
#[derive(Debug)]
pub(super) enum Flow<'a> {
    Next,
    Return(Option<(&'a Node, Object<'a>)>),
    Break,
    Continue,
    /// What comes now is not known.
    Lost,
}

pub(super) struct Machine<'a> {
    pub language: Dialect,
    pub names: &'a dyn Fn(&str) -> Option<Expr>,
    pub joints: &'a [Expr],
    /// What names stand for that the script gives numbers.
    pub stated: &'a super::Stated<'a>,
    /// Values that stand for those that names get, by the places of these.
    pub mended: &'a BTreeMap<usize, Vec<Expr>>,
    /// How a program is read that is told of a pose.
    pub posed: Option<super::Posed<'a>>,
    /// What functions of the robot give that the text has not.
    pub own: Option<&'a super::OwnFunction<'a>>,
    /// The joints of each call of these.
    pub calls: Vec<Vec<Expr>>,
    /// What tests compared.
    pub compared: Vec<super::Compared>,
    /// What was shown.
    pub shown: Vec<Shown>,
    pub functions: BTreeMap<&'a str, &'a Definition>,
    pub imports: BTreeMap<&'a str, &'a str>,
    pub stars: Vec<&'a str>,
    pub frames: Vec<Frame<'a>>,
    pub next_id: u64,
    pub budget: Budget,
    pub depth: usize,
    /// The functions that run.
    pub running: Vec<&'a Definition>,
    /// Functions that others call with all joints.
    pub called: Vec<&'a str>,
    /// What `end` means in the indices that are read.
    pub ends: Vec<usize>,
    pub refusals: Vec<ParseError>,
    statements: usize,
    /// The names that functions without a name use.
    pub free: BTreeMap<usize, BTreeSet<&'a str>>,
    /// The frame whose assignments are put down.
    pub root: usize,
    pub records: Vec<Option<Assigned>>,
}

impl<'a> Machine<'a> {
    pub fn new(language: Dialect, asked: &super::Asked<'a>) -> Self {
        let super::Asked { names, joints, stated, mended, posed, own } = *asked;
        Machine {
            language,
            names,
            joints,
            stated,
            mended,
            posed,
            own,
            calls: vec![],
            compared: vec![],
            shown: vec![],
            functions: BTreeMap::new(),
            imports: BTreeMap::new(),
            stars: vec![],
            frames: vec![Frame::default()],
            next_id: 1,
            budget: Budget::new(),
            depth: 0,
            running: vec![],
            called: vec![],
            ends: vec![],
            refusals: vec![],
            statements: 0,
            free: BTreeMap::new(),
            root: 0,
            records: vec![],
        }
    }

    /// Runs the statements outside of functions.
    pub fn script(&mut self, statements: &'a [Statement]) -> Vec<Assigned> {
        self.root = 0;
        self.block(statements);
        self.assigned()
    }

    /// Runs a function by itself.
    pub fn function(
        &mut self,
        d: &'a Definition,
        slots: BTreeMap<&'a str, Object<'a>>,
    ) -> (Vec<Assigned>, Vec<Returned>) {
        let given = slots.len();
        let slots: BTreeMap<&'a str, Slot<'a>> =
            slots.into_iter().map(|(name, value)| (name, Slot::of(value))).collect();
        self.frames.push(Frame { id: self.next_id, slots, home: None, given });
        self.next_id += 1;
        self.root = self.frames.len() - 1;
        self.running.push(d);
        let flow = match self.defaults(d) {
            Ok(()) => self.block(&d.body),
            Err(stop) => {
                self.refuse(stop);
                Flow::Lost
            }
        };
        let returned = match flow {
            Flow::Return(Some((node, value))) => report::returned(node, &value, &mut self.budget),
            Flow::Lost => vec![],
            _ => self.outputs(d),
        };
        let assigned = self.assigned();
        self.running.pop();
        self.frames.pop();
        self.root = 0;
        (assigned, returned)
    }

    /// Gives arguments that are missing what they are by default.
    pub fn defaults(&mut self, d: &'a Definition) -> Read<()> {
        for p in &d.parameters {
            if self.frame().slots.contains_key(p.name.as_str()) {
                continue;
            }
            if let Some(default) = &p.default {
                let value = self.eval(default)?;
                self.frame().slots.insert(&p.name, Slot::of(value));
            }
        }
        Ok(())
    }

    pub fn frame(&mut self) -> &mut Frame<'a> {
        if self.frames.is_empty() {
            self.frames.push(Frame::default());
        }
        let last = self.frames.len() - 1;
        &mut self.frames[last]
    }

    /// Reports an error, once.
    pub fn refuse(&mut self, stop: Stop) {
        if let Some(e) = stop.0
            && self.refusals.len() < MAX_REFUSALS
            && !self.refusals.contains(&e)
        {
            self.refusals.push(*e);
        }
    }

    /// Marks names as not known. An array that was only set aside for what is not read is none of the program's results.
    pub fn forget(&mut self, names: &[&'a str]) {
        self.lose(names, Assigned::is_set_aside);
    }

    /// Marks names as not known; what they were before is none of the program's results if it is so.
    fn lose(&mut self, names: &[&'a str], is_none: impl Fn(&Assigned) -> bool) {
        for name in names {
            let before = self.frame().slots.insert(name, Slot::default());
            if let Some(record) = before.and_then(|slot| self.records.get_mut(slot.record?))
                && record.as_ref().is_some_and(&is_none)
            {
                *record = None;
            }
        }
    }

    pub fn block(&mut self, statements: &'a [Statement]) -> Flow<'a> {
        for statement in statements {
            match self.statement(statement) {
                Ok(Flow::Next) => {}
                Ok(flow) => return flow,
                Err(stop) => {
                    self.refuse(stop);
                    let walked = statement.span.len() as u64 / 8;
                    if let Err(stop) = self.budget.charge(walked, &statement.span) {
                        self.refuse(stop);
                    }
                    let statement = std::slice::from_ref(statement);
                    // What was to get another value has not the one of before.
                    self.lose(&given(statement), |_| true);
                    let mut names = vec![];
                    let leaves = changed(statement, &mut names);
                    self.forget(&names);
                    if leaves || self.budget.is_spent() {
                        return Flow::Lost;
                    }
                }
            }
        }
        Flow::Next
    }

    /// One level deeper.
    pub fn deeper<T>(&mut self, span: &Span, run: impl FnOnce(&mut Self) -> Read<T>) -> Read<T> {
        if self.depth >= MAX_DEPTH {
            return refuse(span, "calls and brackets are nested too deep");
        }
        self.depth += 1;
        let result = run(self);
        self.depth -= 1;
        result
    }

    fn statement(&mut self, statement: &'a Statement) -> Read<Flow<'a>> {
        let span = &statement.span;
        self.statements += 1;
        if self.statements > MAX_STATEMENTS {
            self.budget.charge(u64::MAX, span)?;
        }
        self.budget.charge(1, span)?;
        self.deeper(span, |m| m.run(statement))
    }

    fn run(&mut self, statement: &'a Statement) -> Read<Flow<'a>> {
        let span = &statement.span;
        match &statement.kind {
            StatementKind::Assign(targets, value) => {
                let count = match targets.as_slice() {
                    [Node { kind: Kind::Tuple(parts), .. }] => parts.len(),
                    _ => 1,
                };
                let object = self.several(value, count)?;
                for target in targets {
                    self.assign(target, object.clone(), &value.span, span)?;
                }
            }
            StatementKind::Augment(target, op, value) => self.augment(target, *op, value, span)?,
            StatementKind::Show(node) => self.show(node)?,
            StatementKind::Return(None) => return Ok(Flow::Return(None)),
            StatementKind::Return(Some(node)) => {
                return Ok(Flow::Return(Some((node, self.eval(node)?))));
            }
            StatementKind::For(target, source, body) => return self.turns(target, source, body),
            StatementKind::If(arms, other) => {
                if let [(test, body)] = arms.as_slice()
                    && is_main(test)
                {
                    // What a program does for show is followed as far as it goes.
                    let refusals = self.refusals.len();
                    self.block(body);
                    self.refusals.truncate(refusals);
                    return Ok(Flow::Next);
                }
                for (k, (test, body)) in arms.iter().enumerate() {
                    let holds = self.eval(test).and_then(|v| self.truth(&v, &test.span));
                    if holds.is_err() && self.posed.is_some() {
                        let rest = arms[k..].iter().map(|a| a.1.as_slice());
                        let ways: Vec<&'a [Statement]> = rest.chain([other.as_slice()]).collect();
                        return self.either(&ways, span);
                    }
                    if holds? {
                        return Ok(self.block(body));
                    }
                }
                return Ok(self.block(other));
            }
            StatementKind::Define(d) => {
                if self.frames.len() > 1 {
                    let home = Some((self.frames.len() - 1, self.frame().id));
                    let closure = Closure { definition: d, home, captured: BTreeMap::new() };
                    self.frame().slots.insert(&d.name, Slot::of(Object::Function(closure.into())));
                }
            }
            StatementKind::Import(names) => {
                self.imports.extend(names.iter().map(|(name, path)| (name.as_str(), path.as_str())));
            }
            StatementKind::ImportAll(path) => self.stars.push(path),
            StatementKind::Declare(names) => {
                for (name, span) in names {
                    let value = Object::Scalar(self.declared(name, span));
                    self.bind(name, value, None);
                }
            }
            StatementKind::Break => return Ok(Flow::Break),
            StatementKind::Continue => return Ok(Flow::Continue),
            StatementKind::Pass => {}
            StatementKind::Assert(node) => {
                self.compares(node);
            }
            StatementKind::Raise => {
                self.refuse(ParseError::new(span.clone(), "the code ends with an error here").into());
                return Ok(Flow::Lost);
            }
            StatementKind::Refused(error, body) => {
                if body.is_empty() {
                    self.refuse(error.clone().into());
                } else {
                    return Err(error.clone().into());
                }
            }
        }
        Ok(Flow::Next)
    }

    /// A symbol that the program declares.
    pub fn declared(&self, name: &str, span: &Span) -> Scalar {
        if let Some(entry) = self.entry_of_pose(name, span) {
            return entry;
        }
        Scalar::of((self.names)(name).unwrap_or_else(|| Expr::symbol(name)), span)
    }

    fn turns(&mut self, target: &'a Node, source: &'a Node, body: &'a [Statement]) -> Read<Flow<'a>> {
        let items = self.eval(source)?.items(self.language, &source.span)?;
        if items.len() > MAX_TURNS {
            return refuse(&source.span, format!("a loop of more than {MAX_TURNS} turns is not read"));
        }
        for item in items {
            self.assign(target, item, &target.span, &target.span)?;
            match self.block(body) {
                Flow::Next | Flow::Continue => {}
                Flow::Break => break,
                flow => return Ok(flow),
            }
        }
        Ok(Flow::Next)
    }

    /// Whether a condition holds.
    pub fn truth(&self, value: &Object<'a>, span: &Span) -> Read<bool> {
        match value {
            Object::Bool(b) => Ok(*b),
            Object::Nothing => Ok(false),
            Object::List(items) => Ok(!items.is_empty()),
            Object::Scalar(s) if s.expr.as_number().is_some() => Ok(!s.expr.is_zero()),
            _ => {
                let hint = "write each branch as a function of its own";
                refuse_hint(span, "a condition on values is not read", hint)
            }
        }
    }

    /// An expression by itself: it may change a list, or only show something.
    fn show(&mut self, node: &'a Node) -> Read<()> {
        if matches!(node.kind, Kind::Text(_)) || self.compares(node) {
            return Ok(());
        }
        if is_display(node) {
            self.displayed(node);
            return Ok(());
        }
        if matches!(node.kind, Kind::Name(_)) {
            // A command, or a value that is asked for.
            if let Ok(value) = self.eval(node) {
                self.shows(&[(node, value)], &node.span, false);
            }
            return Ok(());
        }
        if let Kind::Path(base, suffixes) = &node.kind
            && let Kind::Name(name) = &base.kind
            && let [list, call] = suffixes.as_slice()
            && let (SuffixKind::Attribute(method), SuffixKind::Call(arguments)) = (&list.kind, &call.kind)
            && self.frame().slots.contains_key(name.as_str())
        {
            let [argument] = arguments.as_slice() else {
                return refuse(&node.span, format!("`.{method}` is not read"));
            };
            let value = self.eval(&argument.value)?;
            let Some(slot) = self.frame().slots.get_mut(name.as_str()) else { return Err(Stop(None)) };
            let Some(mut place) = slot.value.take() else { return Err(Stop(None)) };
            let is_alias = is_aliased(&place);
            if let (Object::List(items), "append" | "extend", false) = (&mut place, method.as_str(), is_alias)
            {
                let items = std::rc::Rc::make_mut(items);
                match method.as_str() {
                    "append" => items.push(value),
                    _ => value.items(self.language, &node.span)?.into_iter().for_each(|i| items.push(i)),
                }
                super::value::side(items.len(), &node.span)?;
                shallow(&place, &node.span)?;
                self.restore(name, place);
                return Ok(());
            }
            return refuse(&node.span, format!("`.{method}` of {} is not read", place.about()));
        }
        let value = self.eval(node)?;
        self.shows(&[(node, value)], &node.span, false);
        Ok(())
    }

    /// `print(x, y)`: what is no value says nothing here.
    fn displayed(&mut self, node: &'a Node) {
        let Kind::Path(_, suffixes) = &node.kind else { return };
        let Some(SuffixKind::Call(arguments)) = suffixes.last().map(|s| &s.kind) else { return };
        let mut values = vec![];
        for argument in arguments.iter().filter(|a| a.name.is_none()) {
            if let Ok(value) = self.eval(&argument.value) {
                values.push((&argument.value, value));
            }
        }
        self.shows(&values, &node.span, true);
    }

    fn shows(&mut self, values: &[(&'a Node, Object<'a>)], span: &Span, is_call: bool) {
        if !self.is_recorded() {
            return;
        }
        let mut found = vec![];
        for (node, value) in values {
            if let Some(value) = report::value(value, &mut self.budget) {
                found.push((node.span.clone(), value));
            }
        }
        if !found.is_empty() {
            self.shown.push(Shown { span: span.clone(), values: found, is_call });
        }
    }

    fn restore(&mut self, name: &'a str, value: Object<'a>) {
        if let Some(slot) = self.frame().slots.get_mut(name) {
            slot.value = Some(value);
        }
    }

    fn augment(&mut self, target: &'a Node, op: Op, value: &'a Node, span: &Span) -> Read<()> {
        let old = self.eval(target)?;
        let by = self.eval(value)?;
        // In place in Python: other names of the same array would change as well.
        let is_matrix = matches!(old, Object::Matrix(_) | Object::List(_));
        let new = self.binary(op, old, by, span)?;
        if let (true, Kind::Name(name), Dialect::Python) = (is_matrix, &target.kind, self.language)
            && self.frame().slots.get(name.as_str()).and_then(|s| s.value.as_ref()).is_some_and(is_aliased)
        {
            let hint = format!("write `{name} = {name} …`, which makes a new one");
            return refuse_hint(span, "other names may stand for the same array, and change with it", hint);
        }
        let new = match new {
            Object::Scalar(s) => Object::Scalar(s.unwritten(&value.span)),
            new => new,
        };
        self.assign(target, new, &value.span, span)
    }

    /// Gives a target its value; `right` is where the value is written.
    pub fn assign(&mut self, target: &'a Node, value: Object<'a>, right: &Span, span: &Span) -> Read<()> {
        match &target.kind {
            Kind::Name(name) => {
                shallow(&value, span)?;
                self.bind(name, value, Some(right));
                Ok(())
            }
            Kind::Bracket(inner) => self.assign(inner, value, right, span),
            Kind::Tuple(parts) | Kind::List(parts) => {
                self.budget.charge(value.weight(), span)?;
                let items = match (&value, self.language) {
                    (Object::List(items), _) => items.to_vec(),
                    (_, Dialect::Matlab) => vec![value],
                    _ => value.items(self.language, right)?,
                };
                if items.len() < parts.len()
                    || (items.len() > parts.len() && self.language == Dialect::Python)
                {
                    let message = format!("{} values for {} names", items.len(), parts.len());
                    return refuse(right, message);
                }
                for (part, item) in parts.iter().zip(items) {
                    let own = match &item {
                        Object::Scalar(s) if right.start <= s.span.start && s.span.end <= right.end => {
                            &s.span.clone()
                        }
                        _ => right,
                    };
                    self.assign(part, item, own, span)?;
                }
                Ok(())
            }
            Kind::Path(base, suffixes) => {
                let Kind::Name(name) = &base.kind else {
                    return refuse(&target.span, "what is assigned to is not a name or its entries");
                };
                if let Some(SuffixKind::Attribute(_)) = suffixes.first().map(|s| &s.kind) {
                    let hint = "give the value a name of its own";
                    return refuse_hint(&target.span, "a field of an object is not set", hint);
                }
                let is_matlab = self.language == Dialect::Matlab;
                let old = match self.frame().slots.get(name.as_str()) {
                    Some(slot) => slot.value.clone().ok_or(Stop(None))?,
                    None if is_matlab => Object::Nothing,
                    None => return refuse(&base.span, format!("`{name}` has no value here")),
                };
                let steps = self.steps(&old, suffixes, &target.span)?;
                drop(old);
                let value = match &steps[..] {
                    [step] => self.posed_entry(name, step, value, right, &target.span),
                    _ => value,
                };
                let value = match value {
                    Object::Matrix(m) => Object::Matrix(m.fresh().into()),
                    Object::Scalar(s) => Object::Scalar(s.settled()),
                    value => value,
                };
                let mut place =
                    self.frame().slots.entry(name).or_default().value.take().unwrap_or(Object::Nothing);
                self.set(&mut place, &steps, value, span)?;
                self.restore(name, place);
                self.touch(name, span);
                Ok(())
            }
            _ => refuse(&target.span, "what is assigned to is not a name or its entries"),
        }
    }
}
