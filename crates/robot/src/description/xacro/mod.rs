//! xacro: properties, macros and conditions of a robot description, expanded without going through text.
//!
//! Numbers are exact: `${radians(90)}` is π/2 and `${0.1 + 0.2}` is 3/10. What is left out of the language is refused with its
//! place: `$(eval)`, `$(env)`, `load_yaml`, namespaces, elements and attributes made by xacro.

mod expand;
mod expression;
mod macros;
mod scope;
mod value;

use super::diagnostic::Diagnostics;
use super::sources::{Files, Sources};
use super::xml::{Node, Tree, shown};
use macros::{Block, Macro};
use scope::{Lazy, Scopes, Stored};
use std::collections::{BTreeMap, HashMap};
use std::ops::Range;
use std::rc::Rc;
use value::{Fault, Val};

/// How many elements are expanded, and how deep macros, files and elements may stand in each other.
const MAX_WORK: usize = 500_000;
const MAX_DEPTH: usize = 150;

/// An expansion under way.
pub(super) struct Xacro<'s> {
    pub files: Files,
    pub out: Diagnostics,
    sources: &'s mut dyn Sources,
    arguments: BTreeMap<String, String>,
    macros: HashMap<String, Rc<Macro>>,
    scopes: Scopes,
    /// Blocks that stand in properties.
    raw: Blocks,
    result: Tree,
    work: usize,
    /// The files that are open, the innermost last.
    open: Vec<usize>,
    /// Where the macros under way were called.
    calls: Vec<Range<usize>>,
}

/// The elements of a file.
type Shared = Rc<Tree>;

/// Blocks by the names under which a macro inserts them.
type Blocks = HashMap<String, Block>;

/// True for a document that xacro is to expand.
pub(super) fn is_xacro(tree: &Tree) -> bool {
    let marks = |text: &str| text.contains("${") || text.contains("$(");
    let node = |n: &Node| n.name.starts_with("xacro:") || n.attributes.iter().any(|a| marks(&a.value.text));
    tree.nodes.iter().any(node)
}

/// The document with everything expanded; nothing where it cannot be, which is said.
pub(super) fn expand(xacro: &mut Xacro, tree: Tree) -> Option<Tree> {
    let tree = Rc::new(tree);
    let root = tree.nodes[0].clone();
    xacro.result.nodes.push(Node { attributes: vec![], children: vec![], ..root.clone() });
    let attributes = root.attributes.iter().filter_map(|a| xacro.attribute(a, 0)).collect();
    let children = xacro.body(&tree, &root.children, 0, &Blocks::new(), 0);
    let result = &mut xacro.result.nodes[0];
    (result.attributes, result.children) = (attributes, children);
    Some(std::mem::take(&mut xacro.result))
}

impl<'s> Xacro<'s> {
    /// With the first file, and the values of arguments.
    pub fn new(
        files: Files,
        out: Diagnostics,
        sources: &'s mut dyn Sources,
        arguments: &[(String, String)],
    ) -> Self {
        Xacro {
            files,
            out,
            sources,
            arguments: arguments.iter().cloned().collect(),
            macros: HashMap::new(),
            scopes: Scopes::new(),
            raw: Blocks::new(),
            result: Tree::default(),
            work: 0,
            open: vec![0],
            calls: vec![],
        }
    }

    /// Says what is wrong; inside a macro with the place that called it.
    fn fault(&mut self, span: Range<usize>, fault: Fault) {
        let call = self.calls.first().map(|call| format!("expanded from {}", self.files.place(call)));
        let finding = self.out.error(span, fault.message);
        match (fault.hint, call) {
            (Some(hint), Some(call)) => finding.hint(format!("{hint}; {call}")),
            (Some(hint), None) | (None, Some(hint)) => finding.hint(hint),
            (None, None) => {}
        }
    }

    /// What a name stands for in a scope.
    fn property(&mut self, name: &str, scope: usize) -> Result<Val, Fault> {
        let Some(at) = self.scopes.find(scope, name) else {
            if name == "pi" {
                return Ok(Val::Number(denavit_symbolic::Expr::pi()));
            }
            let near = super::diagnostic::nearest(name, self.scopes.names(scope)).map(str::to_string);
            let fault = Fault::new(format!("`{}` is not defined", shown(name)));
            return Err(match near {
                Some(near) => fault.hint(format!("did you mean `{near}`?")),
                None => fault,
            });
        };
        let lazy = match self.scopes.get(at, name) {
            Some(Stored::Lazy(lazy)) => lazy.clone(),
            Some(Stored::Known(value)) => return Ok(value.clone()),
            Some(Stored::Bad(fault)) => return Err(fault.clone()),
            Some(Stored::Busy) | None => {
                return Err(Fault::new(format!("`{}` refers to itself", shown(name))));
            }
        };
        if self.calls.len() + self.open.len() > MAX_DEPTH {
            return Err(Fault::new("properties refer to properties too deeply"));
        }
        self.scopes.set(at, name, Stored::Busy);
        // A place for each property under way bounds how deep they refer to each other.
        self.calls.push(lazy.span.clone());
        let value = self.text(&lazy.text, at);
        self.calls.pop();
        let stored = match &value {
            Ok(value) => Stored::Known(value.clone()),
            Err(fault) => Stored::Bad(fault.clone()),
        };
        self.scopes.set(at, name, stored);
        value
    }

    /// The value of a text with `${…}` and `$(…)` in it; one expression alone keeps its value, and so does a number.
    fn text(&mut self, text: &str, scope: usize) -> Result<Val, Fault> {
        let mut parts = self.parts(text, scope)?;
        Ok(match (parts.len(), parts.pop()) {
            (1, Some(Val::Text(only))) => match denavit_symbolic::Rational::from_decimal(only.trim()) {
                Some(x) => Val::Number(x.into()),
                None => Val::Text(only),
            },
            (1, Some(only)) => only,
            (_, last) => {
                let all: String = parts.iter().chain(&last).map(Val::show).collect();
                Val::Text(all)
            }
        })
    }

    /// The parts of a text, evaluated.
    fn parts(&mut self, text: &str, scope: usize) -> Result<Vec<Val>, Fault> {
        let mut parts = vec![];
        let mut rest = text;
        while !rest.is_empty() {
            if let Some(escaped) = rest.strip_prefix("$$").filter(|e| e.starts_with(['{', '('])) {
                parts.push(Val::Text(format!("${}", &escaped[..1])));
                rest = &escaped[1..];
            } else if let Some(inner) = rest.strip_prefix("${") {
                let end = inner.find('}').ok_or_else(|| Fault::new("`}` is missing"))?;
                let expression = self.flat(&inner[..end])?;
                parts.push(expression::evaluate(&expression, &mut |name| self.property(name, scope))?);
                rest = &inner[end + 1..];
            } else if let Some(inner) = rest.strip_prefix("$(") {
                let end = inner.find(')').ok_or_else(|| Fault::new("`)` is missing"))?;
                parts.push(Val::Text(self.command(&inner[..end])?));
                rest = &inner[end + 1..];
            } else {
                let next = rest.char_indices().skip(1).find(|c| c.1 == '$');
                let end = next.map_or(rest.len(), |c| c.0);
                parts.push(Val::Text(rest[..end].into()));
                rest = &rest[end..];
            }
        }
        Ok(parts)
    }

    /// An expression with its `$(arg …)` replaced.
    fn flat(&mut self, expression: &str) -> Result<String, Fault> {
        let mut flat = String::new();
        let mut rest = expression;
        while let Some(at) = rest.find("$(") {
            flat.push_str(&rest[..at]);
            let inner = &rest[at + 2..];
            let end = inner.find(')').ok_or_else(|| Fault::new("`)` is missing"))?;
            flat.push_str(&self.command(&inner[..end])?);
            rest = &inner[end + 1..];
        }
        flat.push_str(rest);
        Ok(flat)
    }

    /// `$(arg name)`, `$(find package)`, `$(dirname)`
    fn command(&mut self, text: &str) -> Result<String, Fault> {
        let (command, name) = text.trim().split_once(char::is_whitespace).unwrap_or((text.trim(), ""));
        let name = name.trim();
        match command {
            "arg" => self.arguments.get(name).cloned().ok_or_else(|| {
                let hint = format!("give it: --arg {0}=VALUE", shown(name));
                Fault::new(format!("the argument `{}` is not given", shown(name))).hint(hint)
            }),
            "find" => self.sources.package(name).ok_or_else(|| {
                let hint = format!("say where it is: --package {0}=FOLDER", shown(name));
                Fault::new(format!("the package `{}` is not found", shown(name))).hint(hint)
            }),
            "dirname" => {
                let file = self.files.name(self.open.last().copied().unwrap_or(0));
                Ok(file.rsplit_once(['/', '\\']).map_or(".", |f| f.0).into())
            }
            other => Err(Fault::new(format!("`$({} …)` is not read", shown(other)))
                .hint("expand the file with xacro first")),
        }
    }

    /// A property of which the text stands in an attribute.
    fn lazy(text: &str, span: &Range<usize>) -> Stored {
        Stored::Lazy(Lazy { text: text.into(), span: span.clone() })
    }
}
