//! Places that are assigned: names, entries of lists and matrices, what belongs to links and robots.

use super::parse::{Argument, Form, Node};
use super::run::{Run, position};
use super::value::{Lost, MAX_ITEMS, Value, integer};
use std::ops::Range;
use std::rc::Rc;

impl Run<'_> {
    /// `self.a` of a name or names of names.
    pub fn path(node: &Node) -> Option<String> {
        match &node.form {
            Form::Name(name) => Some(name.clone()),
            Form::Attribute(inner, name) => Some(format!("{}.{name}", Self::path(inner)?)),
            _ => None,
        }
    }

    fn root(node: &Node) -> Option<&str> {
        match &node.form {
            Form::Name(name) => Some(name),
            Form::Attribute(inner, _) | Form::Call(inner, _) | Form::Unary(_, inner) => Self::root(inner),
            _ => None,
        }
    }

    /// What is assigned to a place that is not followed makes all of it unknown.
    fn lose_root(&mut self, target: &Node) {
        let lost = self.lost(&target.span, "is not followed");
        if let Some(root) = Self::root(target)
            && let Some(known) = self.named(root).cloned()
        {
            self.store.lose(&known, &lost);
            if root == "self" {
                self.doubt(&lost);
            }
            if !matches!(known, Value::Robot(_)) {
                self.assign(root, Value::Unknown(lost));
            }
        }
    }

    /// Makes all robots unknown, those that were made and those to come.
    pub fn doubt(&mut self, lost: &Lost) {
        self.lost.get_or_insert_with(|| lost.clone());
        for k in 0..self.store.robots.len() {
            self.change(&Value::Robot(k));
            self.store.lose(&Value::Robot(k), lost);
        }
    }

    pub fn set(&mut self, target: &Node, value: Value) {
        match &target.form {
            Form::Name(name) => self.assign(name, value),
            Form::List(all) => {
                let items = self.store.items(&value).ok().filter(|items| items.len() == all.len());
                for (k, one) in all.iter().enumerate() {
                    let item = items.as_ref().map(|items| items[k].clone());
                    let item = item.unwrap_or_else(|| self.unknown(&target.span));
                    self.set(one, item);
                }
            }
            Form::Matrix(rows, _) => {
                for one in rows.iter().flatten() {
                    let unknown = self.unknown(&target.span);
                    self.set(one, unknown);
                }
            }
            Form::Attribute(inner, name) => {
                let path = Self::path(target);
                let is_known = Self::path(inner).is_none_or(|p| self.named(&p).is_some());
                let object = if is_known { self.object(inner) } else { Value::None };
                match object {
                    Value::Link(k) => self.set_of_link(k, name, value, &target.span),
                    Value::Robot(k) => self.set_of_robot(k, name, value, &target.span),
                    Value::Joint(k) => self.set_of_joint(k, name, value, &target.span),
                    Value::Body(k) => {
                        self.change(&object);
                        match (name.as_str(), value) {
                            ("Joint", Value::Joint(joint)) => self.store.bodies[k].joint = Some(joint),
                            ("Joint", _) => {
                                let lost = self.lost(&target.span, "is not followed");
                                self.store.lose(&object, &lost);
                            }
                            ("Mass" | "Inertia" | "CenterOfMass", value) => {
                                self.not_read(name, &value, &target.span);
                            }
                            _ => {}
                        }
                    }
                    Value::Tree if name == "Gravity" => self.not_read(name, &value, &target.span),
                    Value::Tree if name == "DataFormat" => {}
                    Value::None | Value::Unknown(_) | Value::Number(_) if path.is_some() => {
                        self.set_attribute(&path.unwrap_or_default(), value, &target.span);
                    }
                    _ => self.lose_root(target),
                }
            }
            Form::Call(inner, arguments) => self.set_entry(target, inner, arguments, value),
            _ => self.lose_root(target),
        }
    }

    /// `object.name = value`
    fn set_attribute(&mut self, path: &str, value: Value, span: &Range<usize>) {
        let root = path.split('.').next().unwrap_or("");
        if self.shared.contains(root) {
            let unknown = self.unknown(span);
            return self.assign(path, unknown);
        }
        if self.is_python() {
            self.owners.insert(root.into());
        }
        self.assign(path, value);
    }

    /// `L(k) = value`, `links[k] = value`, `dh(k,:) = values`
    fn set_entry(&mut self, target: &Node, inner: &Node, arguments: &[Argument], value: Value) {
        if let Some((k, name)) = self.robot_of_entry(inner) {
            let unknown = self.unknown(&target.span);
            return self.set_of_robot(k, &name, unknown, &target.span);
        }
        let path = Self::path(inner);
        let container = match &path {
            Some(path) => self.named(path).cloned(),
            None => Some(self.value(inner)),
        };
        match container {
            Some(Value::List(k)) => {
                let index = match arguments {
                    [one] => integer(&self.value(&one.value)),
                    _ => None,
                };
                self.change(&Value::List(k));
                // A part of an array changes with the whole, and the whole with it.
                let source = self.store.lists[k].part_of;
                let parts: Vec<usize> = match self.store.lists[k].is_array {
                    true => (0..self.store.lists.len())
                        .filter(|p| self.store.lists[*p].part_of == Some(k))
                        .collect(),
                    false => vec![],
                };
                for other in source.into_iter().chain(parts) {
                    let lost = self.lost(&target.span, "is not followed: a part of an array changes with it");
                    self.store.lose(&Value::List(other), &lost);
                }
                let items = &mut self.store.lists[k].items;
                let index = index.and_then(|i| position(i, items.len()));
                match index {
                    Some(i) => items[i] = value,
                    None => {
                        let lost = self.lost(&target.span, "is not followed");
                        self.store.lose(&Value::List(k), &lost);
                    }
                }
            }
            Some(Value::Matrix(_)) | None if !self.is_python() && path.is_some() => {
                let path = path.unwrap_or_default();
                let mut rows = match container {
                    Some(Value::Matrix(rows)) => Rc::unwrap_or_clone(rows),
                    _ => vec![],
                };
                let size: usize = rows.iter().map(Vec::len).sum();
                if self.step(size / 8, &target.span) {
                    return;
                }
                match self.filled(&mut rows, arguments, value) {
                    Some(()) => self.assign(&path, Value::Matrix(Rc::new(rows))),
                    None => {
                        let unknown = self.unknown(&target.span);
                        self.assign(&path, unknown);
                    }
                }
            }
            _ => self.lose_root(target),
        }
    }

    /// `robot.links` of a robot: which, and what of it.
    pub fn robot_of_entry(&mut self, node: &Node) -> Option<(usize, String)> {
        let Form::Attribute(object, name) = &node.form else { return None };
        match self.object(object) {
            Value::Robot(k) => Some((k, name.clone())),
            _ => None,
        }
    }

    /// Puts a value into a matrix of MATLAB, which grows.
    fn filled(&mut self, rows: &mut Vec<Vec<Value>>, arguments: &[Argument], value: Value) -> Option<()> {
        // `L(2) = []` takes an entry out.
        if matches!(&value, Value::Matrix(m) if m.iter().all(Vec::is_empty)) {
            return None;
        }
        let width = rows.first().map_or(0, Vec::len);
        let index = |run: &mut Self, node: &Node, end: usize| -> Option<usize> {
            run.ends.push(end);
            let found = integer(&run.value(node));
            run.ends.pop();
            found.and_then(|i| usize::try_from(i - 1).ok()).filter(|i| *i < MAX_ITEMS)
        };
        match arguments {
            [one] if rows.len() > 1 && width == 1 => {
                let k = index(self, &one.value, rows.len())?;
                rows.resize(rows.len().max(k + 1), vec![Value::None]);
                rows[k][0] = value;
            }
            [one] if rows.len() <= 1 => {
                let k = index(self, &one.value, width)?;
                rows.resize(1, vec![]);
                rows[0].resize(width.max(k + 1), Value::None);
                rows[0][k] = value;
            }
            [row, column] if matches!(&column.value.form, Form::Range(e) if e.iter().all(Option::is_none)) => {
                let k = index(self, &row.value, rows.len())?;
                let values = self.store.items(&value).ok()?;
                let size = rows.len().max(k + 1).saturating_mul(values.len());
                if !(rows.is_empty() || width == values.len()) || size > MAX_ITEMS {
                    return None;
                }
                rows.resize(rows.len().max(k + 1), vec![Value::None; values.len()]);
                rows[k] = values;
            }
            [row, column] => {
                let k = index(self, &row.value, rows.len())?;
                let i = index(self, &column.value, width)?;
                let (height, width) = (rows.len().max(k + 1), width.max(i + 1));
                if height.saturating_mul(width) > MAX_ITEMS {
                    return None;
                }
                rows.resize(height, vec![]);
                rows.iter_mut().for_each(|r| r.resize(width, Value::None));
                rows[k][i] = value;
            }
            _ => return None,
        }
        Some(())
    }

    pub fn extend(&mut self, list: usize, more: &Value, span: &Range<usize>) {
        self.change(&Value::List(list));
        match self.store.items(more) {
            Ok(items) if self.store.lists[list].items.len() + items.len() <= MAX_ITEMS => {
                if !self.step(items.len(), span) {
                    self.store.lists[list].items.extend(items);
                }
            }
            Ok(_) | Err(None) => {
                let lost = self.lost(span, "is not followed");
                self.store.lose(&Value::List(list), &lost);
            }
            Err(Some(lost)) => self.store.lose(&Value::List(list), &lost),
        }
    }
}
