//! xacro: properties, macros and conditions of a robot description, expanded without going through text.
//!
//! Numbers are exact: `${radians(90)}` is π/2 and `${0.1 + 0.2}` is 3/10. What is left out of Python is refused with its place.

mod expand;
mod expression;
mod macros;
mod scope;
mod sequence;
mod value;
mod yaml;

use super::diagnostic::Diagnostics;
use super::sources::{Files, Sources};
use super::xml::{Node, Tree, Value, shown};
use denavit_symbolic::Expr;
use expression::Asked;
use macros::Macro;
use scope::{Lazy, Scope, Scopes, Stored};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::ops::Range;
use std::rc::Rc;
use value::{Fault, Val};

/// How many elements are expanded, and how deep macros, files and elements may stand in each other.
const MAX_WORK: usize = 500_000;
const MAX_DEPTH: usize = 150;
/// How many files are read, each as often as it is included.
const MAX_FILES: usize = 500;

/// An expansion under way.
pub(super) struct Xacro<'s> {
    pub files: Files,
    pub out: Diagnostics,
    sources: &'s mut dyn Sources,
    arguments: BTreeMap<String, String>,
    /// The arguments that were given and that nothing has asked for yet.
    unasked: BTreeSet<String>,
    macros: Scopes<Rc<Macro>>,
    scopes: Scopes<Stored>,
    /// What files of YAML hold, by the file that names them and their name there.
    values: HashMap<(String, String), Val>,
    result: Tree,
    work: usize,
    /// The elements of the result that are being filled, the innermost last.
    inside: Vec<usize>,
    /// The files that are open, the innermost last.
    open: Vec<usize>,
    /// Where the macros under way were called.
    calls: Vec<Range<usize>>,
}

/// The elements of a file.
type Shared = Rc<Tree>;

/// The scope of what stands in no macro and no namespace.
const TOP: Scope = Scope { names: 0, macros: 0 };

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
    xacro.result.nodes[0].attributes = attributes;
    xacro.result.nodes[0].children = xacro.body(&tree, &root.children, TOP, 0);
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
            unasked: arguments.iter().map(|a| a.0.clone()).collect(),
            macros: Scopes::new(),
            scopes: Scopes::new(),
            values: HashMap::new(),
            result: Tree::default(),
            work: 0,
            inside: vec![0],
            open: vec![0],
            calls: vec![],
        }
    }

    /// Says what is wrong; inside a macro with the place that called it.
    fn fault(&mut self, span: Range<usize>, fault: Fault) {
        let call = self.calls.first().map(|call| format!("expanded from {}", self.files.place(call)));
        let finding = self.out.error(fault.at.unwrap_or(span), fault.message);
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
                return Ok(Val::Number(Expr::pi()));
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
            Some(Stored::Busy | Stored::Block(_)) | None => {
                return Err(Fault::new(format!("`{}` refers to itself", shown(name))));
            }
        };
        if self.calls.len() + self.open.len() > MAX_DEPTH {
            return Err(Fault::new("properties refer to properties too deeply"));
        }
        self.scopes.set(at, name, Stored::Busy);
        // A place for each property under way bounds how deep they refer to each other.
        self.calls.push(lazy.span.clone());
        let value = self.text(&lazy.text, at).map(Val::unquoted);
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

    /// The value of an attribute, as [`text`](Self::text) has it; what is wrong with it has its place.
    fn value(&mut self, value: &Value, scope: usize) -> Result<Val, Fault> {
        self.text(&value.text, scope).map_err(|fault| fault.at(value.span.clone()))
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
                parts.push(expression::evaluate(&expression, &mut |asked| self.answer(asked, scope))?);
                rest = &inner[end + 1..];
            } else if let Some(inner) = rest.strip_prefix("$(") {
                let end = closing(inner)?;
                parts.push(self.command(&inner[..end])?);
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
            let end = closing(inner)?;
            flat.push_str(&self.command(&inner[..end])?.show());
            rest = &inner[end + 1..];
        }
        flat.push_str(rest);
        Ok(flat)
    }

    /// `$(arg name)`, `$(find package)`, `$(dirname)`, `$(env name)`, `$(optenv name otherwise)`, `$(eval expression)`
    fn command(&mut self, text: &str) -> Result<Val, Fault> {
        let (command, name) = text.trim().split_once(char::is_whitespace).unwrap_or((text.trim(), ""));
        let name = name.trim();
        match command {
            "arg" => self.argument(name).map(Val::Text),
            "find" => self.package(name).map(Val::Text),
            "dirname" => Ok(Val::Text(self.folder())),
            "env" => self
                .sources
                .variable(name)
                .map(Val::Text)
                .ok_or_else(|| Fault::new(format!("the environment has no variable `{}`", shown(name)))),
            "optenv" => {
                let (name, otherwise) = name.split_once(' ').unwrap_or((name, ""));
                let words: Vec<&str> = otherwise.split(' ').filter(|w| !w.is_empty()).collect();
                Ok(Val::Text(self.sources.variable(name).unwrap_or_else(|| words.join(" "))))
            }
            // Its names are those of arguments.
            "eval" => expression::evaluate(name, &mut |asked| match asked {
                Asked::Name("pi") => Ok(Val::Number(Expr::pi())),
                Asked::Name(name) | Asked::Argument(name) => self.argument(name).map(Val::converted),
                Asked::Package(name) => self.package(name).map(Val::Text),
                Asked::Folder => Ok(Val::Text(self.folder())),
                Asked::Member(..) | Asked::Values(_) | Asked::File(_) => {
                    Err(Fault::new("this is not read in `$(eval …)`"))
                }
            }),
            other => Err(Fault::new(format!("`$({} …)` is not read", shown(other)))
                .hint("expand the file with xacro first")),
        }
    }

    /// The value of an argument.
    fn argument(&mut self, name: &str) -> Result<String, Fault> {
        self.unasked.remove(name);
        self.arguments.get(name).cloned().ok_or_else(|| {
            let hint = format!("give it: --arg {0}=VALUE", shown(name));
            Fault::new(format!("the argument `{}` is not given", shown(name))).hint(hint)
        })
    }

    /// Warns of arguments that the files know nothing of.
    pub fn say_unasked(&mut self) {
        for name in std::mem::take(&mut self.unasked) {
            let near = super::diagnostic::nearest(
                &name,
                self.arguments.keys().map(String::as_str).filter(|n| **n != name),
            );
            let hint = near.map(|n| format!("did you mean `{n}`?"));
            let finding = self
                .out
                .warning(0..0, format!("no argument `{}` is asked for: its value is not used", shown(&name)));
            if let Some(hint) = hint {
                finding.hint(hint);
            }
        }
    }

    /// The folder of a package.
    fn package(&mut self, name: &str) -> Result<String, Fault> {
        self.sources.package(name).ok_or_else(|| {
            let hint = format!("say where it is: --package {0}=FOLDER", shown(name));
            Fault::new(format!("the package `{}` is not found", shown(name))).hint(hint)
        })
    }

    /// The folder of the file at hand.
    fn folder(&self) -> String {
        let file = self.files.name(self.open.last().copied().unwrap_or(0));
        file.rsplit_once(['/', '\\']).map_or(".", |f| f.0).into()
    }

    /// What an expression asks for.
    fn answer(&mut self, asked: Asked, scope: usize) -> Result<Val, Fault> {
        match asked {
            Asked::Name(name) => self.property(name, scope),
            Asked::Member(space, name) => self.property(name, space.names),
            Asked::Argument(name) => self.argument(name).map(Val::Text),
            Asked::Package(name) => self.package(name).map(Val::Text),
            Asked::Folder => Ok(Val::Text(self.folder())),
            Asked::File(name) if name.starts_with('/') => Ok(Val::Text(name.into())),
            Asked::File(name) => Ok(Val::Text(format!("{}/{name}", self.folder()))),
            Asked::Values(file) => self.load_yaml(file),
        }
    }

    /// What a file of YAML holds.
    fn load_yaml(&mut self, wanted: &str) -> Result<Val, Fault> {
        let from = self.files.name(self.open.last().copied().unwrap_or(0)).to_string();
        let key = (from, wanted.to_string());
        if let Some(known) = self.values.get(&key) {
            return Ok(known.clone());
        }
        let (name, text) = self.open_file(wanted)?;
        let (file, start) = self.files.add(name, text);
        let value = yaml::read(self.files.text(file), start)?;
        self.values.insert(key, value.clone());
        Ok(value)
    }

    /// A property of which the text stands in an attribute.
    fn lazy(text: &str, span: &Range<usize>) -> Stored {
        Stored::Lazy(Lazy { text: text.into(), span: span.clone() })
    }
}

/// Where the bracket closes that a command stands in; brackets and quotes of an expression belong to it.
fn closing(inner: &str) -> Result<usize, Fault> {
    let is_expression = inner.starts_with("eval ");
    let (mut depth, mut quote) = (0, None);
    for (at, c) in inner.char_indices() {
        match (quote, c) {
            (Some(q), c) if q == c => quote = None,
            (Some(_), _) => {}
            (None, '\'' | '"') if is_expression => quote = Some(c),
            (None, '(') if is_expression => depth += 1,
            (None, ')') if depth > 0 => depth -= 1,
            (None, ')') => return Ok(at),
            _ => {}
        }
    }
    Err(Fault::new("`)` is missing"))
}
