//! What stands behind a value: attributes, calls and indices; functions of the text are carried out where they are called.

use super::known;
use super::machine::{Flow, Frame, Machine, Slot};
use super::scalar::{Read, Scalar, Stop, refuse, refuse_hint};
use super::tree::{Argument, Kind, Node, Span, Suffix, SuffixKind};
use super::value::{Closure, Object, Sort, object};
use super::{Dialect, MAX_CALLS};
use std::collections::BTreeMap;

/// The arguments of a call.
#[derive(Debug)]
pub(super) struct Given<'a> {
    pub positional: Vec<(Object<'a>, Span)>,
    pub named: Vec<(&'a str, Object<'a>, Span)>,
}

impl<'a> Given<'a> {
    /// A named argument.
    pub fn named(&self, name: &str) -> Option<&Object<'a>> {
        self.named.iter().find(|(n, ..)| *n == name).map(|(_, o, _)| o)
    }
}

impl<'a> Machine<'a> {
    pub fn arguments(&mut self, arguments: &'a [Argument]) -> Read<Given<'a>> {
        let mut given = Given { positional: vec![], named: vec![] };
        for Argument { name, value } in arguments {
            let span = value.span.clone();
            match (&value.kind, name) {
                (Kind::Star(inner), _) => {
                    let items = self.eval(inner)?.items(self.language, &span)?;
                    given.positional.extend(items.into_iter().map(|i| (i, span.clone())));
                }
                (_, Some(name)) => {
                    let object = self.eval(value)?;
                    given.named.push((name, object, span));
                }
                _ => {
                    let object = self.eval(value)?;
                    given.positional.push((object, span));
                }
            }
        }
        let weight = given.positional.iter().map(|(o, _)| o.weight()).sum();
        let place = arguments.first().map_or(0..0, |a| a.value.span.clone());
        self.budget.charge(weight, &place)?;
        Ok(given)
    }

    pub fn path(&mut self, base: &'a Node, suffixes: &'a [Suffix]) -> Read<Object<'a>> {
        let (mut value, read) = match self.called_of_robot(base, suffixes)? {
            Some(found) => found,
            None => (self.eval(base)?, 0),
        };
        let mut rest = suffixes[read..].iter();
        while let Some(suffix) = rest.next() {
            let span = base.span.start..suffix.end;
            self.budget.charge(value.weight(), &span)?;
            value = match (&suffix.kind, value) {
                (SuffixKind::Attribute(name), Object::Path(path)) => {
                    let path = format!("{path}.{name}");
                    known::constant(&path, &span).unwrap_or_else(|| Object::Path(path.into()))
                }
                (SuffixKind::Attribute(name), value) => match rest.as_slice().first() {
                    Some(Suffix { kind: SuffixKind::Call(arguments), end }) => {
                        rest.next();
                        let given = self.arguments(arguments)?;
                        self.method(&value, name, given, &(base.span.start..*end))?
                    }
                    _ => self.property(&value, name, &span)?,
                },
                (SuffixKind::Call(arguments), Object::Function(f)) => {
                    let given = self.arguments(arguments)?;
                    let mut values = self.call(&f, given, 1, &span)?;
                    match values.is_empty() {
                        true => Object::Nothing,
                        false => named(values.swap_remove(0), &span),
                    }
                }
                (SuffixKind::Call(arguments), Object::Path(path)) => {
                    let given = self.arguments(arguments)?;
                    self.library(&path, given, &span)?
                }
                (SuffixKind::Call(arguments), value) if self.language == Dialect::Matlab => {
                    let items = arguments.iter().map(|a| &a.value).collect();
                    let step = self.step(&value, items, false, &span, false)?;
                    self.picked(&value, &step, &span)?
                }
                (SuffixKind::Call(_), value) => {
                    let e = format!("{} is called as if it were a function", value.about());
                    return refuse_hint(&span, e, "an index is written `q[0]`, a product with `*`");
                }
                (SuffixKind::Index(items), value) => {
                    let items = self.indices(items);
                    let step = self.step(&value, items, false, &span, false)?;
                    self.picked(&value, &step, &span)?
                }
                (SuffixKind::Cell(items), value) => {
                    let step = self.step(&value, items.iter().collect(), true, &span, false)?;
                    self.picked(&value, &step, &span)?
                }
                (SuffixKind::Transpose, Object::Scalar(s)) => Object::Scalar(s),
                (SuffixKind::Transpose, value) => object(value.matrix(Sort::Matlab, &span)?.transposed()),
            };
        }
        Ok(value)
    }

    /// Carries out a function of the text; as many values as are asked for, or one.
    pub fn call(
        &mut self,
        f: &Closure<'a>,
        given: Given<'a>,
        outputs: usize,
        span: &Span,
    ) -> Read<Vec<Object<'a>>> {
        let d = f.definition;
        if self.running.iter().any(|r| std::ptr::eq(*r, d)) {
            return refuse(span, format!("`{}` calls itself; recursion is not read", d.name));
        }
        if self.running.len() >= MAX_CALLS {
            return refuse(span, format!("more than {MAX_CALLS} calls inside one another"));
        }
        if !self.called.contains(&d.name.as_str()) && self.is_of_all_joints(&given) {
            self.called.push(&d.name);
        }
        let frame = self.entered(f, given, span)?;
        self.frames.push(frame);
        self.running.push(d);
        let result = self.deeper(span, |m| {
            m.defaults(d)?;
            for p in &d.parameters {
                if !m.frame().slots.contains_key(p.name.as_str()) && m.language == Dialect::Python {
                    return refuse(span, format!("`{}` is called without `{}`", d.name, p.name));
                }
            }
            match m.block(&d.body) {
                Flow::Lost => Err(Stop(None)),
                Flow::Return(Some((_, value))) => Ok(vec![value]),
                _ if d.outputs.is_empty() => Ok(vec![Object::Nothing]),
                _ => m.given_back(f, outputs.max(1), span),
            }
        });
        self.running.pop();
        self.frames.pop();
        result
    }

    fn is_of_all_joints(&self, given: &Given<'a>) -> bool {
        let entries: Vec<&Scalar> = match given.positional.as_slice() {
            [(Object::Matrix(m), _)] => m.entries.iter().collect(),
            several => several.iter().filter_map(|(o, p)| o.scalar(p).ok()).collect(),
        };
        entries.len() == self.joints.len() && entries.iter().zip(self.joints).all(|(e, j)| e.expr == *j)
    }

    fn given_back(&mut self, f: &Closure<'a>, outputs: usize, span: &Span) -> Read<Vec<Object<'a>>> {
        let names = &f.definition.outputs;
        if outputs > names.len() {
            let message = format!("`{}` gives back {} values", f.definition.name, names.len());
            return refuse(span, message);
        }
        let mut values = vec![];
        for (name, place) in &names[..outputs] {
            match self.frame().slots.get(name.as_str()) {
                Some(slot) => values.push(slot.value.clone().ok_or(Stop(None))?),
                None => return refuse(place, format!("`{name}` is given no value")),
            }
        }
        Ok(values)
    }

    /// The frame of a function with its arguments.
    fn entered(&mut self, f: &Closure<'a>, given: Given<'a>, span: &Span) -> Read<Frame<'a>> {
        let parameters = &f.definition.parameters;
        if given.positional.len() > parameters.len() {
            let message = format!(
                "`{}` takes {} arguments, {} are given",
                f.definition.name,
                parameters.len(),
                given.positional.len()
            );
            return refuse(span, message);
        }
        let mut slots: BTreeMap<&'a str, Slot<'a>> =
            f.captured.iter().map(|(n, o)| (*n, Slot::of(o.clone()))).collect();
        // An argument hides what the function took along.
        for p in parameters {
            slots.remove(p.name.as_str());
        }
        let count = given.positional.len();
        for (p, (value, _)) in parameters.iter().zip(given.positional) {
            slots.insert(&p.name, Slot::of(settled(value)));
        }
        for (name, value, place) in given.named {
            let Some(p) = parameters.iter().find(|p| p.name == name) else {
                return refuse(&place, format!("`{}` has no argument `{name}`", f.definition.name));
            };
            slots.insert(&p.name, Slot::of(settled(value)));
        }
        self.next_id += 1;
        Ok(Frame { id: self.next_id - 1, slots, home: f.home, given: count })
    }
}

fn settled(value: Object<'_>) -> Object<'_> {
    match value {
        Object::Scalar(s) => Object::Scalar(s.settled()),
        value => value,
    }
}

/// A scalar as it stands where a function is called.
fn named<'a>(value: Object<'a>, span: &Span) -> Object<'a> {
    match value {
        Object::Scalar(s) => Object::Scalar(s.settled().named(span)),
        value => value,
    }
}
