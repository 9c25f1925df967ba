//! Functions: the program's own, those that make links and robots, and those of numbers and lists.

use super::links::{LINKS, ROBOTS};
use super::parse::{Act, Argument, Form, Function, Statement};
use super::run::{Flow, MAX_CALLS, Run};
use super::value::{Formula, Lost, MAX_ITEMS, Value, formula, integer};
use std::collections::{HashMap, HashSet};
use std::ops::Range;
use std::rc::Rc;

/// Functions of numbers that formulas have.
const OF_NUMBERS: [&str; 13] = [
    "sin", "cos", "tan", "sqrt", "atan2", "arctan2", "asin", "acos", "atan", "arcsin", "arccos", "arctan",
    "abs",
];

/// Functions that change nothing that they are given.
pub(super) const HARMLESS: [&str; 35] = [
    "print",
    "disp",
    "display",
    "fprintf",
    "sprintf",
    "str",
    "repr",
    "format",
    "save",
    "plot",
    "show",
    "showdetails",
    "teach",
    "isinstance",
    "type",
    "class",
    "isa",
    "getTransform",
    "homeConfiguration",
    "randomConfiguration",
    "inverseKinematics",
    "generalizedInverseKinematics",
    "geometricJacobian",
    "interactiveRigidBodyTree",
    "workspaceGoalRegion",
    "super",
    "hasattr",
    "getattr",
    "id",
    "any",
    "all",
    "fkine",
    "ikine",
    "jacob0",
    "isempty",
];

impl<'p> Run<'p> {
    /// A call of the function of this name.
    pub fn called(&mut self, name: &str, arguments: &[Argument], span: &Range<usize>) -> Value {
        if let Some(function) = self.functions.get(name).copied() {
            let given = arguments.iter().map(|a| (a.key.clone(), self.value(&a.value))).collect();
            return self.call_own(function, given, span);
        }
        if let Some(body) = self.classes.get(name).copied() {
            let given = arguments.iter().map(|a| (a.key.clone(), self.value(&a.value))).collect();
            return self.instance(body, given, span);
        }
        if LINKS.iter().any(|l| l.0 == name) {
            return self.link_made(name, arguments, span);
        }
        if ROBOTS.contains(&name) {
            return self.robot_made(arguments, span, false);
        }
        if name == "isempty" || name == "exist" || name == "isfield" {
            return self.unknown(span);
        }
        let is_spread = |a: &Argument| matches!(&a.value.form, Form::Unary(s, _) if s.starts_with('*'));
        if arguments.iter().any(is_spread) {
            let lost = self.lost(span, "is not followed");
            for argument in arguments {
                let inner = match &argument.value.form {
                    Form::Unary(_, inner) => inner,
                    _ => &argument.value,
                };
                let value = self.value(inner);
                self.reached(&value, &lost);
            }
            return Value::Unknown(lost);
        }
        // What a text says is not read.
        if matches!(name, "eval" | "evalc" | "evalin" | "exec" | "execfile" | "assignin" | "run" | "load") {
            let lost = self.lost(span, "is not followed");
            self.doubt(&lost);
            return Value::Unknown(lost);
        }
        let values: Vec<Value> = arguments.iter().map(|a| self.value(&a.value)).collect();
        if matches!(name, "rigidBody" | "rigidBodyJoint" | "setFixedTransform" | "addBody" | "rigidBodyTree")
        {
            return self.tree_function(name, &values, span);
        }
        if let Some(Value::Unknown(lost)) = values.iter().find(|v| matches!(v, Value::Unknown(_)))
            && is_known(name)
        {
            return Value::Unknown(lost.clone());
        }
        let found = self.of_values(name, &values, span);
        found.unwrap_or_else(|| {
            let lost = self.lost(span, "is not followed");
            if !HARMLESS.contains(&name) {
                for value in &values {
                    self.reached(value, &lost);
                }
            }
            Value::Unknown(lost)
        })
    }

    /// What the parameters of a function of Python are where nothing is given for them.
    pub fn find_defaults(&mut self, function: &'p Function) {
        if self.is_python() {
            let values =
                function.parameters.iter().map(|p| p.1.as_ref().map(|node| self.value(node))).collect();
            self.defaults.insert(std::ptr::from_ref(function), values);
        }
    }

    /// Calls a function of the program; what it is not given has its default.
    pub fn call_own(
        &mut self,
        function: &'p Function,
        given: Vec<(Option<String>, Value)>,
        span: &Range<usize>,
    ) -> Value {
        if self.scopes.len() > MAX_CALLS {
            return Value::Unknown(self.lost(span, "is not followed: calls too deep"));
        }
        let mut scope = HashMap::new();
        let defaults = self.defaults.get(&std::ptr::from_ref(function)).cloned().unwrap_or_default();
        for (k, (name, default)) in function.parameters.iter().enumerate() {
            if let Some(default) = default {
                let value = defaults.get(k).cloned().flatten().unwrap_or_else(|| self.value(default));
                scope.insert(name.clone(), value);
            }
        }
        let count = given.len();
        for (k, (key, value)) in given.into_iter().enumerate() {
            let name = key.or_else(|| function.parameters.get(k).map(|p| p.0.clone()));
            match name {
                Some(name) if function.parameters.iter().any(|p| p.0 == name) => {
                    drop(scope.insert(name, value))
                }
                _ => return self.unknown(span),
            }
        }
        if !self.is_python() {
            let number = |n: usize| Value::Number(Formula::integer(i64::try_from(n).unwrap_or(0), 0..0));
            scope.insert("nargin".into(), number(count));
            scope.insert("nargout".into(), number(usize::from(self.is_asked)));
        }
        let is_asked = std::mem::replace(&mut self.is_asked, true);
        self.scopes.push(scope);
        // Names of the function are its own: only where the call is unsure is it noted which are assigned.
        let is_sure = self.unsure.is_empty();
        if !is_sure {
            self.unsure.push(HashSet::new());
        }
        let flow = self.block(&function.body);
        if !is_sure {
            self.unsure.pop();
        }
        let scope = self.scopes.pop().unwrap_or_default();
        self.is_asked = is_asked;
        match (flow, function.results.as_slice()) {
            (Flow::Returns(value), []) => value,
            (_, [one, ..]) => scope.get(one).cloned().unwrap_or(Value::None),
            _ => Value::None,
        }
    }

    /// What a function that is not followed is given may be changed by it, but for robots.
    fn reached(&mut self, value: &Value, lost: &Lost) {
        if matches!(value, Value::Joint(_) | Value::Body(_) | Value::Tree) {
            self.tree_lost.get_or_insert_with(|| lost.clone());
        }
        if !matches!(value, Value::Robot(_)) {
            if self.store.holds_link(value) {
                // They may be a robot in another order.
                self.links_lost.get_or_insert_with(|| lost.clone());
            }
            self.change(value);
            self.store.lose(value, lost);
        }
    }

    /// An object of a class of the program: the robot that its constructor makes.
    pub fn instance(
        &mut self,
        body: &'p [Statement],
        given: Vec<(Option<String>, Value)>,
        span: &Range<usize>,
    ) -> Value {
        let own = body.iter().find_map(|s| match &s.act {
            Act::Function(f) if f.name == "__init__" => Some(&**f),
            _ => None,
        });
        let Some(function) = own else { return self.unknown(span) };
        let before = self.store.robots.len();
        let mut all = vec![(None, Value::Number(Formula::new("self", None, span.clone())))];
        all.extend(given);
        let result = self.call_own(function, all, span);
        match self.store.robots.len() > before {
            true => Value::Robot(self.store.robots.len() - 1),
            false if result == Value::None => self.unknown(span),
            false => result,
        }
    }

    fn of_values(&mut self, name: &str, values: &[Value], span: &Range<usize>) -> Option<Value> {
        let count = |n: usize| Value::Number(Formula::integer(i64::try_from(n).unwrap_or(0), span.clone()));
        match (name, values) {
            ("deg2rad" | "radians", [one]) => Some(self.each_number(one, span, &Formula::in_radians)),
            ("rad2deg" | "degrees", [one]) => Some(self.each_number(one, span, &Formula::in_degrees)),
            ("sind" | "cosd" | "tand", [one]) => {
                Some(self.each_number(one, span, &|f| f.in_radians()?.of(name.trim_end_matches('d'))))
            }
            ("abs", [one]) => Some(self.each_number(one, span, &|f| {
                if f.number? < 0.0 { f.negated(f.span.clone()) } else { Some(f.clone()) }
            })),
            ("atan2" | "arctan2", [y, x]) => {
                let (y, x) = (formula(y)?, formula(x)?);
                Some(Value::Number(Formula::new(
                    &format!("atan2({},{})", y.text, x.text),
                    None,
                    span.clone(),
                )))
            }
            (_, [one]) if OF_NUMBERS.contains(&name) => Some(self.each_number(one, span, &|f| f.of(name))),
            ("float" | "double" | "float64", [one]) => {
                Some(self.each_number(one, span, &|f| Some(f.clone())))
            }
            ("int", [one]) => {
                let whole = integer(one)?;
                Some(Value::Number(Formula::integer(whole, span.clone())))
            }
            ("array" | "asarray" | "r_" | "list" | "tuple" | "matrix" | "reversed", _) => {
                let mut items = match (name, values) {
                    ("r_", _) => values.to_vec(),
                    (_, [one, ..]) => self.store.items(one).ok()?,
                    _ => vec![],
                };
                if name == "reversed" {
                    items.reverse();
                }
                let is_array = matches!(name, "array" | "asarray" | "r_" | "matrix");
                if self.step(items.len(), span) {
                    return None;
                }
                if name == "reversed" {
                    return Some(self.store.lazily(items, values));
                }
                if is_array {
                    // Rows are arrays of their own.
                    for item in &mut items {
                        if let Value::List(_) = item {
                            let inner = self.store.items(item).ok()?;
                            if self.step(inner.len(), span) {
                                return None;
                            }
                            *item = self.store.list(inner, true);
                        }
                    }
                }
                // What can be gone through but once is used up.
                if let (true, [one]) = (matches!(name, "list" | "tuple"), values) {
                    let mut through = self.store.through(one).ok()?;
                    while let Ok(Some(_)) = self.store.next(&mut through) {}
                    self.store.used(&through);
                }
                Some(self.store.list(items, is_array))
            }
            ("range", _) => {
                let numbers: Vec<i64> = values.iter().map(integer).collect::<Option<_>>()?;
                let (first, last, step) = match numbers[..] {
                    [last] => (0, last, 1),
                    [first, last] => (first, last, 1),
                    [first, last, step] if step != 0 => (first, last, step),
                    _ => return None,
                };
                let items = self.counted(first, step, last - step.signum(), span)?;
                Some(self.store.list(items, false))
            }
            ("enumerate", [one, rest @ ..]) => {
                let first = rest.first().map_or(Some(0), integer)?;
                let items = self.store.items(one).ok()?;
                if self.step(items.len(), span) {
                    return None;
                }
                let mut pairs = vec![];
                for (k, item) in items.into_iter().enumerate() {
                    let number = Formula::integer(first + i64::try_from(k).ok()?, span.clone());
                    pairs.push(self.store.list(vec![Value::Number(number), item], false));
                }
                Some(self.store.lazily(pairs, &values[..1]))
            }
            ("zip", [_, ..]) => {
                let all: Vec<Vec<Value>> =
                    values.iter().map(|v| self.store.items(v).ok()).collect::<Option<_>>()?;
                let shortest = all.iter().map(Vec::len).min()?;
                if self.step(shortest * all.len(), span) {
                    return None;
                }
                let tuples = (0..shortest).map(|k| all.iter().map(|a| a[k].clone()).collect::<Vec<_>>());
                let tuples: Vec<Value> =
                    tuples.collect::<Vec<_>>().into_iter().map(|t| self.store.list(t, false)).collect();
                Some(self.store.lazily(tuples, values))
            }
            ("len" | "length" | "numel", [one]) => match one {
                Value::Robot(k) => Some(count(self.store.robots[*k].links.len())),
                Value::Matrix(rows) => {
                    let (height, width) = (rows.len(), rows.first().map_or(0, Vec::len));
                    Some(count(if name == "numel" { height * width } else { height.max(width) }))
                }
                Value::Number(_) | Value::Link(_) if !self.is_python() => Some(count(1)),
                _ => self.store.items(one).ok().map(|items| count(items.len())),
            },
            ("size", [Value::Matrix(rows), side]) => match integer(side)? {
                1 => Some(count(rows.len())),
                2 => Some(count(rows.first().map_or(0, Vec::len))),
                _ => None,
            },
            ("zeros" | "ones" | "cell", [one, rest @ ..]) => self.filled_with(name, one, rest, span),
            ("num2str" | "int2str" | "str", [one]) => match one {
                Value::Text(_) => Some(one.clone()),
                other => Some(Value::Text(integer(other)?.to_string().into())),
            },
            ("sym" | "symbols" | "symbol" | "Symbol" | "var", [Value::Text(names), ..]) => {
                let names: Vec<&str> = names.split([' ', ',']).filter(|n| !n.is_empty()).collect();
                let mut all: Vec<Value> =
                    names.iter().map(|n| Value::Number(Formula::new(n, None, span.clone()))).collect();
                if all.len() == 1 { all.pop() } else { Some(self.store.list(all, false)) }
            }
            ("sym", [one]) => Some(one.clone()),
            ("zero", []) => Some(count(0)),
            ("pi", []) => Some(Value::Number(Formula::new("pi", Some(std::f64::consts::PI), span.clone()))),
            ("copy" | "deepcopy", [Value::Link(k)]) => {
                let link = self.store.links[*k].clone();
                self.store.links.push(link);
                Some(Value::Link(self.store.links.len() - 1))
            }
            ("copy", [one @ Value::List(k)]) => {
                let is_array = self.store.lists[*k].is_array;
                let items = self.store.items(one).ok()?;
                (!self.step(items.len(), span)).then(|| self.store.list(items, is_array))
            }
            _ => None,
        }
    }

    fn filled_with(&mut self, name: &str, one: &Value, rest: &[Value], span: &Range<usize>) -> Option<Value> {
        let zero = match name {
            "cell" => Value::None,
            "ones" => Value::Number(Formula::integer(1, span.clone())),
            _ => Value::Number(Formula::integer(0, span.clone())),
        };
        let sides: Vec<i64> = match (one, rest) {
            (Value::List(_), []) => self.store.items(one).ok()?.iter().map(integer).collect::<Option<_>>()?,
            (_, [other]) => vec![integer(one)?, integer(other)?],
            (_, []) if self.is_python() => vec![integer(one)?],
            (_, []) => vec![integer(one)?, integer(one)?],
            _ => return None,
        };
        let sides: Vec<usize> = sides.into_iter().map(|s| usize::try_from(s).ok()).collect::<Option<_>>()?;
        let (height, width) = match sides[..] {
            [width] => (None, width),
            [height, width] => (Some(height), width),
            _ => return None,
        };
        let size = height.unwrap_or(1).saturating_mul(width);
        if size > MAX_ITEMS || height.unwrap_or(1) > MAX_ITEMS || self.step(size, span) {
            return None;
        }
        let row = vec![zero; width];
        match height {
            None => Some(self.store.list(row, true)),
            Some(height) if self.is_python() => {
                let rows = (0..height).map(|_| self.store.list(row.clone(), true)).collect();
                Some(self.store.list(rows, true))
            }
            Some(height) => Some(Value::Matrix(Rc::new(vec![row; height]))),
        }
    }
}

/// True for names of functions that are known by themselves.
pub(super) fn is_known(name: &str) -> bool {
    let others = [
        "deg2rad",
        "radians",
        "rad2deg",
        "degrees",
        "array",
        "asarray",
        "range",
        "enumerate",
        "zip",
        "len",
        "length",
        "numel",
        "zeros",
        "ones",
        "float",
        "int",
        "rigidBody",
        "rigidBodyJoint",
        "list",
        "tuple",
        "deepcopy",
        "copy",
        "symbols",
    ];
    LINKS.iter().any(|l| l.0 == name)
        || ROBOTS.contains(&name)
        || OF_NUMBERS.contains(&name)
        || others.contains(&name)
}
