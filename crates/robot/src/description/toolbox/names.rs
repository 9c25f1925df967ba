//! Names, attributes, methods and entries of lists.

use super::functions::{HARMLESS, is_known};
use super::parse::{Act, Argument, Form, Node, Statement};
use super::run::{Run, position};
use super::value::{Formula, Lost, MAX_ITEMS, Value, integer};
use std::ops::Range;
use std::rc::Rc;

impl<'p> Run<'p> {
    pub fn of_name(&mut self, name: &str, span: &Range<usize>) -> Value {
        if let Some(value) = self.named(name) {
            return match value {
                Value::Number(f) => Value::Number(Formula { span: span.clone(), ..f.clone() }),
                other => other.clone(),
            };
        }
        let number = |text: &str, n: f64| Value::Number(Formula::new(text, Some(n), span.clone()));
        match name {
            "True" | "true" => Value::Bool(true),
            "False" | "false" => Value::Bool(false),
            "None" => Value::None,
            "pi" => number("pi", std::f64::consts::PI),
            "end" => match self.end() {
                Some(end) => Value::Number(Formula::integer(i64::try_from(end).unwrap_or(0), span.clone())),
                None => self.unknown(span),
            },
            "__name__" => Value::Text(if self.is_main { "__main__".into() } else { "module".into() }),
            "nargin" | "nargout" if !self.is_python() => number("0", 0.0),
            "rigidBodyTree" => Value::Tree,
            _ if is_known(name) || self.classes.contains_key(name) => Value::Known(name.into()),
            _ if self.functions.contains_key(name) => match self.is_python() {
                true => Value::Known(name.into()),
                false => self.called(name, &[], span),
            },
            _ => Value::Number(Formula::new(name, None, span.clone())),
        }
    }

    /// An object gets a second name here, in an assignment, a list or a call: its attributes are not known from here on.
    pub fn share(&mut self, name: &str, span: &Range<usize>) {
        // A constructor hands itself on to those that it is built upon.
        let is_object = self.owners.contains(name) || matches!(self.named(name), Some(Value::Unknown(_)));
        if name == "self" || !self.is_python() || !is_object || !self.shared.insert(name.into()) {
            return;
        }
        let own = |k: &&String| k.strip_prefix(name).is_some_and(|rest| rest.starts_with('.'));
        let paths: Vec<String> =
            self.scopes.last().into_iter().flat_map(|s| s.keys().filter(own).cloned()).collect();
        let message = format!("`{name}` gets a second name here, by which it may be changed");
        for path in paths {
            let lost = Lost { span: span.clone(), message: message.as_str().into() };
            self.assign(&path, Value::Unknown(lost));
        }
    }

    /// `q = p` of an object that is shared: it is by this name as well.
    pub fn share_by(&mut self, targets: &[Node], value: &Node) {
        if matches!(&value.form, Form::Name(name) if self.shared.contains(name)) {
            let names = targets.iter().filter_map(Self::path).filter(|p| !p.contains('.'));
            self.shared.extend(names);
        }
    }

    /// That of which something is an attribute: it gets no second name by that.
    pub fn object(&mut self, inner: &Node) -> Value {
        match &inner.form {
            Form::Name(name) => self.of_name(name, &inner.span),
            _ => self.value(inner),
        }
    }

    /// `object.name`, or a name of a module.
    pub fn attribute(&mut self, node: &Node, inner: &Node, name: &str) -> Value {
        let path = Self::path(node);
        if let Some(value) = path.as_ref().and_then(|p| self.named(p)).cloned() {
            return value;
        }
        let is_object = match Self::path(inner) {
            Some(p) => {
                self.named(&p).is_some()
                    || (p.contains('.') && self.named(p.split('.').next().unwrap_or("")).is_some())
            }
            None => true,
        };
        if !is_object {
            // Of a module.
            return match name {
                "pi" | "inf" | "nan" => self.of_name(name, &node.span),
                _ if is_known(name) => Value::Known(name.into()),
                _ => self.unknown(&node.span),
            };
        }
        let object = self.object(inner);
        match (&object, name) {
            (Value::Unknown(_), _) => object,
            (Value::Robot(k), "links") => {
                if let Some(lost) = self.store.robots[*k].lost.clone() {
                    return Value::Unknown(lost);
                }
                let links = self.store.robots[*k].links.iter().map(|l| Value::Link(*l)).collect();
                if self.is_python() {
                    self.store.list(links, false)
                } else {
                    Value::Matrix(Rc::new(vec![links]))
                }
            }
            (Value::Robot(k), "n") => {
                let count = i64::try_from(self.store.robots[*k].links.len()).unwrap_or(0);
                Value::Number(Formula::integer(count, node.span.clone()))
            }
            (Value::Link(k), _) => self.of_link(*k, name, &node.span),
            (Value::Body(k), "Joint") => match self.store.bodies[*k].joint {
                Some(joint) => Value::Joint(joint),
                None => self.unknown(&node.span),
            },
            (Value::Body(k), "Name") => self.store.bodies[*k].name.clone(),
            (Value::List(_) | Value::Matrix(_), "T") => self.unknown(&node.span),
            _ => self.unknown(&node.span),
        }
    }

    /// A call of a function, or an entry of a list.
    pub fn call(&mut self, node: &Node, inner: &Node, arguments: &[Argument]) -> Value {
        let span = &node.span;
        match &inner.form {
            Form::Name(name) => match self.named(name).cloned() {
                Some(Value::Known(name)) => self.called(&name, arguments, span),
                Some(value) => self.entry(value, arguments, span),
                None => self.called(name, arguments, span),
            },
            Form::Attribute(object, name) => {
                if let Some(value) = Self::path(inner).and_then(|p| self.named(&p).cloned()) {
                    return self.entry(value, arguments, span);
                }
                if name == "__init__" {
                    return self.robot_made(arguments, span, true);
                }
                let of_module = Self::path(object).is_some_and(|p| {
                    self.named(&p).is_none() && self.named(p.split('.').next().unwrap_or("")).is_none()
                });
                if of_module {
                    // A function of the program's own is none of a module.
                    if self.is_python()
                        && (self.functions.contains_key(name.as_str())
                            || self.classes.contains_key(name.as_str()))
                    {
                        return self.unknown(span);
                    }
                    return self.called(name, arguments, span);
                }
                const CHANGES: [&str; 9] =
                    ["append", "insert", "extend", "pop", "remove", "reverse", "sort", "clear", "addlink"];
                if CHANGES.contains(&name.as_str())
                    && let Some((k, part)) = self.robot_of_entry(object)
                {
                    let unknown = self.unknown(span);
                    self.set_of_robot(k, &part, unknown, span);
                    return Value::None;
                }
                let value = self.object(object);
                self.method(value, name, inner, arguments, span)
            }
            _ => match self.value(inner) {
                Value::Known(name) => self.called(&name, arguments, span),
                value => self.entry(value, arguments, span),
            },
        }
    }

    fn method(
        &mut self,
        object: Value,
        name: &str,
        inner: &Node,
        arguments: &[Argument],
        span: &Range<usize>,
    ) -> Value {
        match (&object, name) {
            (Value::Unknown(_), _) => object,
            (Value::List(k), _) => {
                let k = *k;
                match (name, arguments) {
                    ("append", [one]) => {
                        let value = self.value(&one.value);
                        self.change(&object);
                        if self.store.lists[k].items.len() < MAX_ITEMS {
                            self.store.lists[k].items.push(value);
                        }
                        Value::None
                    }
                    ("extend", [one]) => {
                        let more = self.value(&one.value);
                        self.extend(k, &more, span);
                        Value::None
                    }
                    ("insert", [at, one]) => {
                        let (at, value) = (integer(&self.value(&at.value)), self.value(&one.value));
                        self.change(&object);
                        let length = self.store.lists[k].items.len();
                        match at.filter(|_| length < MAX_ITEMS && !self.step(length, span)) {
                            Some(at) => {
                                let at = position(at, length).unwrap_or(if at < 0 { 0 } else { length });
                                self.store.lists[k].items.insert(at, value);
                            }
                            None => {
                                let lost = self.lost(span, "is not followed");
                                self.store.lose(&object, &lost);
                            }
                        }
                        Value::None
                    }
                    ("copy" | "tolist", []) => match self.store.items(&object) {
                        Ok(items) if !self.step(items.len(), span) => {
                            let is_array = name == "copy" && self.store.lists[k].is_array;
                            self.store.list(items, is_array)
                        }
                        _ => self.unknown(span),
                    },
                    ("index" | "count", _) => self.unknown(span),
                    _ => {
                        let lost = self.lost(span, "is not followed");
                        self.change(&object);
                        self.store.lose(&object, &lost);
                        Value::Unknown(lost)
                    }
                }
            }
            (Value::Robot(_), "links") | (Value::Body(_), _) => {
                let value = self.attribute(
                    inner,
                    match &inner.form {
                        Form::Attribute(object, _) => object,
                        _ => inner,
                    },
                    name,
                );
                self.entry(value, arguments, span)
            }
            (Value::Robot(_), "sym" | "copy") => object,
            // What the program's own classes do with it, and what changes it.
            (Value::Robot(_), _) if name == "addlink" || self.is_method(name) => {
                let lost = self.lost(span, "is not followed");
                self.change(&object);
                self.store.lose(&object, &lost);
                Value::Unknown(lost)
            }
            (Value::Number(f), _) if &*f.text == "self" && self.is_method(name) => {
                let lost = self.lost(span, "is not followed");
                self.doubt(&lost);
                Value::Unknown(lost)
            }
            (Value::Tree, "addBody") | (Value::Joint(_), "setFixedTransform") => {
                let mut values = vec![object];
                values.extend(arguments.iter().map(|a| self.value(&a.value)));
                self.tree_function(name, &values, span)
            }
            (Value::Tree, name) if !HARMLESS.contains(&name) => {
                let lost = self.lost(span, "is not followed");
                self.tree_lost.get_or_insert(lost.clone());
                Value::Unknown(lost)
            }
            (Value::Link(_), _) => {
                let lost = self.lost(span, "is not followed");
                self.change(&object);
                self.store.lose(&object, &lost);
                Value::Unknown(lost)
            }
            _ => {
                for argument in arguments {
                    self.value(&argument.value);
                }
                self.unknown(span)
            }
        }
    }

    /// `a(i)`, `d[j]`, `A(i,:)`, `L(1:2)`
    fn entry(&mut self, value: Value, arguments: &[Argument], span: &Range<usize>) -> Value {
        match &value {
            Value::Unknown(_) => value,
            Value::List(k) => {
                let k = *k;
                let [one] = arguments else { return self.entry_of_rows(k, arguments, span) };
                let items = match self.store.items(&value) {
                    Ok(items) => items,
                    Err(Some(lost)) => return Value::Unknown(lost),
                    Err(None) => return self.unknown(span),
                };
                if self.step(items.len() / 8, span) {
                    return self.unknown(span);
                }
                if let Form::Range(ends) = &one.value.form {
                    return match self.slice(&items, ends) {
                        Some(part) => self.part(k, part),
                        None => self.unknown(span),
                    };
                }
                let index = self.value(&one.value);
                let at = integer(&index).and_then(|i| position(i, items.len()));
                at.map_or_else(|| self.unknown(span), |i| self.placed(items[i].clone(), span))
            }
            Value::Robot(_) if self.is_python() => {
                let links = Value::clone(&value);
                let Value::Robot(k) = links else { return self.unknown(span) };
                let [one] = arguments else { return self.unknown(span) };
                let index = integer(&self.value(&one.value));
                let links = &self.store.robots[k].links;
                let at = index.and_then(|i| position(i, links.len())).map(|i| links[i]);
                at.map_or_else(|| self.unknown(span), Value::Link)
            }
            Value::Matrix(rows) => self.entry_of_matrix(rows, arguments, span),
            Value::Number(_) | Value::Link(_) | Value::Joint(_) | Value::Body(_) if !self.is_python() => {
                let rows = Rc::new(vec![vec![value.clone()]]);
                self.entry_of_matrix(&rows, arguments, span)
            }
            _ => self.unknown(span),
        }
    }

    /// A value that is taken out of a list stands where it is taken.
    fn placed(&self, value: Value, span: &Range<usize>) -> Value {
        match value {
            Value::Number(f) => Value::Number(Formula { span: span.clone(), ..f }),
            other => other,
        }
    }

    fn slice(&mut self, items: &[Value], ends: &[Option<Node>]) -> Option<Vec<Value>> {
        if ends.len() > 2 && ends[2].is_some() {
            return None;
        }
        let place = |run: &mut Self, end: Option<&Node>, default: usize| -> Option<usize> {
            let Some(end) = end else { return Some(default) };
            let index = integer(&run.value(end))?;
            let length = i64::try_from(items.len()).ok()?;
            usize::try_from(if index < 0 { index + length } else { index }.clamp(0, length)).ok()
        };
        let first = place(self, ends.first().and_then(Option::as_ref), 0)?;
        let last = place(self, ends.get(1).and_then(Option::as_ref), items.len())?;
        Some(items.get(first..last).unwrap_or(&[]).to_vec())
    }

    /// A part of a list: of an array it is one.
    fn part(&mut self, of: usize, items: Vec<Value>) -> Value {
        let is_array = self.store.lists[of].is_array;
        let part = self.store.list(items, is_array);
        if let Value::List(k) = part {
            self.store.lists[k].part_of = is_array.then_some(of);
        }
        part
    }

    /// Whether a class of the program has a method of this name.
    fn is_method(&self, name: &str) -> bool {
        let is_it = |s: &Statement| matches!(&s.act, Act::Function(f) if f.name == name);
        self.classes.values().any(|body| body.iter().any(is_it))
    }

    /// `d[i, j]`, `d[i, :]`, `d[:, j]`
    fn entry_of_rows(&mut self, list: usize, arguments: &[Argument], span: &Range<usize>) -> Value {
        let is_all = |a: &Argument| matches!(&a.value.form, Form::Range(e) if e.iter().all(Option::is_none));
        let [row, column] = arguments else { return self.unknown(span) };
        let is_several = matches!(&row.value.form, Form::Range(_));
        let rows = match is_several {
            true => {
                let part = match is_all(row) {
                    true => Value::List(list),
                    false => self.entry(Value::List(list), std::slice::from_ref(row), span),
                };
                match self.store.items(&part) {
                    Ok(rows) => rows,
                    Err(_) => return self.unknown(span),
                }
            }
            false => vec![self.entry(Value::List(list), std::slice::from_ref(row), span)],
        };
        if is_all(column) {
            if is_several && !is_all(row) {
                return self.part(list, rows);
            }
            return match <[Value; 1]>::try_from(rows) {
                Ok([one]) => one,
                Err(_) => Value::List(list),
            };
        }
        if self.step(rows.len(), span) {
            return self.unknown(span);
        }
        let column = std::slice::from_ref(column);
        let mut found: Vec<Value> = rows.into_iter().map(|r| self.entry(r, column, span)).collect();
        if is_several { self.part(list, found) } else { found.pop().unwrap_or(Value::None) }
    }

    /// The places that an index of MATLAB means.
    fn places(&mut self, index: &Node, length: usize) -> Option<Vec<usize>> {
        if matches!(&index.form, Form::Range(e) if e.iter().all(Option::is_none)) {
            return (!self.step(length, &index.span)).then(|| (0..length).collect());
        }
        let value = self.with_end(length, index);
        let values = match &value {
            Value::Matrix(_) => self.store.items(&value).ok()?,
            other => vec![other.clone()],
        };
        let place = |v: &Value| integer(v).and_then(|i| usize::try_from(i - 1).ok()).filter(|i| *i < length);
        values.iter().map(place).collect()
    }

    fn entry_of_matrix(
        &mut self,
        rows: &Rc<Vec<Vec<Value>>>,
        arguments: &[Argument],
        span: &Range<usize>,
    ) -> Value {
        let width = rows.first().map_or(0, Vec::len);
        let found: Option<Vec<Vec<Value>>> = match arguments {
            [one] => {
                let length = rows.len() * width;
                // Through columns.
                let at = |k: usize| rows[k % rows.len()][k / rows.len()].clone();
                self.places(&one.value, length).map(|places| {
                    let values: Vec<Value> = places.into_iter().map(at).collect();
                    if width == 1 && rows.len() > 1 {
                        values.into_iter().map(|v| vec![v]).collect()
                    } else {
                        vec![values]
                    }
                })
            }
            [row, column] => {
                let places = self.places(&row.value, rows.len()).zip(self.places(&column.value, width));
                places.map(|(r, c)| {
                    r.iter().map(|&r| c.iter().map(|&c| rows[r][c].clone()).collect()).collect()
                })
            }
            _ => None,
        };
        let Some(found) = found else { return self.unknown(span) };
        match found.as_slice() {
            [row] if row.len() == 1 => self.placed(row[0].clone(), span),
            _ => {
                let count: usize = found.iter().map(Vec::len).sum();
                if count > MAX_ITEMS || self.step(count / 8, span) {
                    return self.unknown(span);
                }
                Value::Matrix(Rc::new(found))
            }
        }
    }
}
