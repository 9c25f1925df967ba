//! Macros: their parameters, and how they are called.

use super::scope::{BLOCK, Scope, Stored};
use super::value::{Fault, Val};
use super::{Shared, Xacro};
use crate::description::xml::{Node, shown};
use std::cell::OnceCell;
use std::ops::Range;
use std::rc::Rc;

/// A macro.
#[derive(Debug)]
pub(super) struct Macro {
    /// The file's elements, and which of them is the macro.
    tree: Shared,
    node: usize,
    parameters: Vec<Parameter>,
    /// The file that it stands in.
    file: usize,
    /// Where it was called first.
    called: OnceCell<Range<usize>>,
}

/// A parameter of a macro.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Parameter {
    /// A value, with what it is otherwise.
    Value(String, Option<Default>),
    /// An element that the call holds.
    Block(String),
    /// What stands in an element that the call holds.
    Inside(String),
}

/// What a parameter is that is not given.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Default {
    /// The property of the same name, if there is one.
    is_inherited: bool,
    text: Option<String>,
}

/// A block that a macro inserts.
#[derive(Clone, Debug)]
pub(super) enum Block {
    /// Elements that are expanded: those of the result.
    Expanded(Vec<usize>),
    /// Elements as they stand in a property.
    Raw(Shared, Vec<usize>),
}

/// `name:=default`, `name:=^|default`, `*block`, `**block`, with blanks between; a default may be quoted.
pub(super) fn parameters(text: &str) -> Vec<Parameter> {
    let mut found = vec![];
    let mut rest = text.trim_start();
    while !rest.is_empty() {
        let mut end = rest.len();
        let (mut quote, mut braces) = (None, 0);
        for (i, c) in rest.char_indices() {
            match (quote, c) {
                (Some(q), c) if q == c => quote = None,
                (None, '\'' | '"') => quote = Some(c),
                (None, '{') => braces += 1,
                (None, '}') => braces -= 1,
                (None, c) if c.is_whitespace() && braces <= 0 => {
                    end = i;
                    break;
                }
                _ => {}
            }
        }
        let word = &rest[..end];
        rest = rest[end..].trim_start();
        let unquoted = |t: &str| {
            let inner = |q: char| t.strip_prefix(q).and_then(|t| t.strip_suffix(q));
            inner('\'').or_else(|| inner('"')).unwrap_or(t).to_string()
        };
        found.push(if let Some(name) = word.strip_prefix("**") {
            Parameter::Inside(name.into())
        } else if let Some(name) = word.strip_prefix('*') {
            Parameter::Block(name.into())
        } else if let Some((name, default)) = word.split_once(":=").or_else(|| word.split_once('=')) {
            let inherited = default.strip_prefix('^');
            let text = match inherited {
                Some(rest) => rest.strip_prefix('|').map(unquoted),
                None => Some(unquoted(default)),
            };
            Parameter::Value(name.into(), Some(Default { is_inherited: inherited.is_some(), text }))
        } else {
            Parameter::Value(word.into(), None)
        });
    }
    found
}

impl Xacro<'_> {
    pub(super) fn define(&mut self, tree: &Shared, node: usize, scope: Scope) {
        let element = &tree.nodes[node];
        let text =
            |name: &str| element.attributes.iter().find(|a| a.name == name).map(|a| a.value.text.clone());
        let Some(name) = text("name") else {
            self.fault(element.span.clone(), Fault::new("a macro without a name"));
            return;
        };
        let parameters = parameters(&text("params").unwrap_or_default());
        let file = self.open.last().copied().unwrap_or(0);
        let name = name.strip_prefix("xacro:").unwrap_or(&name).to_string();
        let definition = Macro { tree: tree.clone(), node, parameters, file, called: OnceCell::new() };
        self.macros.set(scope.macros, &name, Rc::new(definition));
    }

    /// The macro of a name, and the scope that its body sees: `space.name` is one of a namespace.
    fn named(&self, name: &str, scope: Scope) -> Option<(Rc<Macro>, Scope)> {
        if let Some(found) = self.macros.seen(scope.macros, name) {
            return Some((found.clone(), scope));
        }
        let mut at = scope;
        let (spaces, name) = name.rsplit_once('.')?;
        for space in spaces.split('.') {
            let Some(Stored::Known(Val::Space(inner))) = self.scopes.seen(at.names, space) else {
                return None;
            };
            at = *inner;
        }
        Some((self.macros.seen(at.macros, name)?.clone(), at))
    }

    /// The elements that a call of a macro stands for.
    pub(super) fn call(
        &mut self,
        name: &str,
        (tree, element): (&Shared, &Node),
        scope: Scope,
        depth: usize,
    ) -> Result<Vec<usize>, Fault> {
        let Some((called, seen)) = self.named(name, scope) else {
            let names = self.macros.names(scope.macros);
            let near = super::super::diagnostic::nearest(name, names);
            let fault = Fault::new(format!("the macro `{}` is not defined", shown(name)));
            return Err(match near {
                Some(near) => fault.hint(format!("did you mean `{near}`?")),
                None => fault,
            });
        };
        let inner = Scope { names: self.scopes.inside(seen.names), macros: self.macros.inside(seen.macros) };
        let mut held = element.children.iter();
        for parameter in &called.parameters {
            match parameter {
                Parameter::Block(block) | Parameter::Inside(block) => {
                    let Some(&child) = held.next() else {
                        return Err(Fault::new(format!(
                            "the macro `{}` wants a block `{}`",
                            shown(name),
                            shown(block)
                        )));
                    };
                    let is_inside = matches!(parameter, Parameter::Inside(_));
                    let children = if is_inside { tree.nodes[child].children.clone() } else { vec![child] };
                    let expanded = self.body(tree, &children, scope, depth + 1);
                    let block = format!("{BLOCK}{block}");
                    self.scopes.set(inner.names, &block, Stored::Block(Block::Expanded(expanded)));
                }
                Parameter::Value(parameter, default) => {
                    let given = element.attributes.iter().find(|a| a.name == *parameter);
                    let inherited = default.as_ref().is_some_and(|d| d.is_inherited);
                    let value = match (given, default) {
                        (Some(given), _) => self.value(&given.value, scope.names)?,
                        (None, Some(_))
                            if inherited && self.scopes.find(scope.names, parameter).is_some() =>
                        {
                            self.property(parameter, scope.names)?
                        }
                        // A default sees what the call sees.
                        (None, Some(Default { text: Some(text), .. })) => self.text(text, scope.names)?,
                        _ => {
                            let message = format!("the macro `{}` wants `{}`", shown(name), shown(parameter));
                            return Err(Fault::new(message));
                        }
                    };
                    self.scopes.set(inner.names, parameter, Stored::Known(value.unquoted()));
                }
            }
        }
        let is_parameter =
            |n: &str| called.parameters.iter().any(|p| matches!(p, Parameter::Value(v, _) if v == n));
        if let Some(unknown) = element.attributes.iter().find(|a| !is_parameter(&a.name)) {
            let message = format!("the macro `{}` has no parameter `{}`", shown(name), shown(&unknown.name));
            return Err(Fault::new(message).at(unknown.span.clone()));
        }
        if let Some(&unused) = held.next() {
            let message = format!("the macro `{}` takes no further block", shown(name));
            return Err(Fault::new(message).at(tree.nodes[unused].span.clone()));
        }
        let first = self.calls.first().unwrap_or(&element.span).clone();
        called.called.get_or_init(|| first);
        self.calls.push(element.span.clone());
        self.open.push(called.file);
        let children = called.tree.nodes[called.node].children.clone();
        let result = self.body(&called.tree, &children, inner, depth + 1);
        self.open.pop();
        self.calls.pop();
        Ok(result)
    }

    /// The bodies of macros, and where each was called first, by the outermost call.
    pub(in crate::description) fn first_calls(&self) -> Vec<(Range<usize>, Range<usize>)> {
        let body = |m: &Rc<Macro>| Some((m.tree.nodes[m.node].whole.clone(), m.called.get()?.clone()));
        let mut all: Vec<_> = self.macros.values().filter_map(body).collect();
        all.sort_by_key(|(body, _)| (body.start, body.end));
        all
    }

    /// The elements that a block stands for.
    pub(super) fn insert(&mut self, name: &Val, scope: Scope, depth: usize) -> Result<Vec<usize>, Fault> {
        let name = name.show();
        match self.scopes.seen(scope.names, &format!("{BLOCK}{name}")).cloned() {
            Some(Stored::Block(Block::Expanded(nodes))) => Ok(nodes),
            Some(Stored::Block(Block::Raw(tree, nodes))) => Ok(self.body(&tree, &nodes, scope, depth + 1)),
            _ => Err(Fault::new(format!("there is no block `{}`", shown(&name)))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_have_defaults_and_blocks() {
        let value = |name: &str, default: Option<(bool, Option<&str>)>| {
            let default =
                default.map(|(is_inherited, text)| Default { is_inherited, text: text.map(Into::into) });
            Parameter::Value(name.into(), default)
        };
        let found = parameters(" prefix xyz:='0 0 0' a:=${x + 1} *origin **rest b:=^|2 c:=^ d=1 ");
        let expected = vec![
            value("prefix", None),
            value("xyz", Some((false, Some("0 0 0")))),
            value("a", Some((false, Some("${x + 1}")))),
            Parameter::Block("origin".into()),
            Parameter::Inside("rest".into()),
            value("b", Some((true, Some("2")))),
            value("c", Some((true, None))),
            value("d", Some((false, Some("1")))),
        ];
        assert_eq!(found, expected);
    }
}
