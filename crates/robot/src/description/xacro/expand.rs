//! Elements one after the other: those of xacro do what they say, others are taken over.

use super::macros::Block;
use super::scope::{BLOCK, Scope, Stored};
use super::value::{Fault, Val, decimal};
use super::{MAX_DEPTH, MAX_FILES, MAX_WORK, Shared, Xacro};
use crate::description::xml::{Attribute, Node, Value, parse, shown};
use std::rc::Rc;

impl Xacro<'_> {
    /// The elements that these stand for, in the result.
    pub(super) fn body(
        &mut self,
        tree: &Shared,
        children: &[usize],
        scope: Scope,
        depth: usize,
    ) -> Vec<usize> {
        let mut all = vec![];
        for &child in children {
            self.work += 1;
            if self.work > MAX_WORK || self.out.is_full() {
                if self.work == MAX_WORK + 1 {
                    let span = tree.nodes[child].span.clone();
                    self.fault(span, Fault::new(format!("more than {MAX_WORK} elements are expanded")));
                }
                return all;
            }
            let element = tree.nodes[child].clone();
            if depth > MAX_DEPTH {
                let message = "macros, files and elements stand in each other too deeply";
                self.fault(element.span, Fault::new(message));
                // Once is enough: what is so deep is so often.
                self.work = MAX_WORK + 1;
                return all;
            }
            match self.element((tree, child, &element), scope, depth) {
                Ok(nodes) => all.extend(nodes),
                Err(fault) => self.fault(element.span, fault),
            }
        }
        all
    }

    fn element(
        &mut self,
        (tree, index, element): (&Shared, usize, &Node),
        scope: Scope,
        depth: usize,
    ) -> Result<Vec<usize>, Fault> {
        let Some(name) = element.name.strip_prefix("xacro:") else {
            return Ok(vec![self.taken_over((tree, element), scope, depth)]);
        };
        let attribute = |name: &str| element.attributes.iter().find(|a| a.name == name);
        let needs = |name: &str| {
            attribute(name).ok_or_else(|| Fault::new(format!("<{}> without `{name}`", shown(&element.name))))
        };
        match name {
            "include" => self.include(&needs("filename")?.value, element, scope, depth),
            "property" => {
                let name = self.value(&needs("name")?.value, scope.names)?.show();
                self.set_property(&name, (tree, element), scope)?;
                Ok(vec![])
            }
            "arg" => {
                let name = needs("name")?.value.text.clone();
                if let Some(default) = attribute("default")
                    && !self.arguments.contains_key(&name)
                {
                    let value = self.value(&default.value, scope.names)?.show();
                    self.arguments.insert(name, value);
                }
                Ok(vec![])
            }
            "macro" => {
                self.define(tree, index, scope);
                Ok(vec![])
            }
            "if" | "unless" => {
                let condition = &needs("value")?.value;
                let holds = self.value(condition, scope.names)?.truth();
                let takes = holds.map_err(|fault| fault.at(condition.span.clone()))? == (name == "if");
                Ok(if takes { self.body(tree, &element.children, scope, depth + 1) } else { vec![] })
            }
            "insert_block" => {
                let name = self.value(&needs("name")?.value, scope.names)?;
                self.insert(&name, scope, depth)
            }
            "call" if self.macros.seen(scope.macros, name).is_none() => {
                let name = self.value(&needs("macro")?.value, scope.names)?.show();
                let others = element.attributes.iter().filter(|a| a.name != "macro").cloned().collect();
                self.call(&name, (tree, &Node { attributes: others, ..element.clone() }), scope, depth)
            }
            "element" if self.macros.seen(scope.macros, name).is_none() => {
                let name = self.given_name(needs("xacro:name")?, scope)?;
                let others = element.attributes.iter().filter(|a| a.name != "xacro:name").cloned().collect();
                let element = Node { name, attributes: others, ..element.clone() };
                match element.name.starts_with("xacro:") && element.name != "xacro:element" {
                    true => self.element((tree, index, &element), scope, depth + 1),
                    false => Ok(vec![self.taken_over((tree, &element), scope, depth)]),
                }
            }
            "attribute" if self.macros.seen(scope.macros, name).is_none() => {
                let (name, value) = (needs("name")?, needs("value")?);
                let name = Attribute { name: self.given_name(name, scope)?, ..value.clone() };
                if let (Some(set), Some(&inside)) = (self.attribute(&name, scope.names), self.inside.last()) {
                    let attributes = &mut self.result.nodes[inside].attributes;
                    attributes.retain(|a| a.name != set.name);
                    attributes.push(set);
                }
                Ok(vec![])
            }
            name => self.call(name, (tree, element), scope, depth),
        }
    }

    /// The name that an attribute gives to an element or attribute.
    fn given_name(&mut self, attribute: &Attribute, scope: Scope) -> Result<String, Fault> {
        let name = self.value(&attribute.value, scope.names)?.show();
        let is_letter = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | ':');
        match name.starts_with(|c: char| c.is_alphabetic() || c == '_') && name.chars().all(is_letter) {
            true => Ok(name),
            false => {
                let message = format!("`{}` is no name of an element or attribute", shown(&name));
                Err(Fault::new(message).at(attribute.value.span.clone()))
            }
        }
    }

    /// An element that is not xacro's, with what stands in it expanded.
    fn taken_over(&mut self, (tree, element): (&Shared, &Node), scope: Scope, depth: usize) -> usize {
        let number = self.result.nodes.len();
        self.result.nodes.push(Node { attributes: vec![], children: vec![], ..element.clone() });
        let attributes = element.attributes.iter().filter_map(|a| self.attribute(a, scope.names)).collect();
        self.result.nodes[number].attributes = attributes;
        self.inside.push(number);
        self.result.nodes[number].children = self.body(tree, &element.children, scope, depth + 1);
        self.inside.pop();
        number
    }

    fn include(
        &mut self,
        filename: &Value,
        element: &Node,
        scope: Scope,
        depth: usize,
    ) -> Result<Vec<usize>, Fault> {
        let attribute = |name: &str| element.attributes.iter().find(|a| a.name == name);
        let inner = match attribute("ns") {
            None => scope,
            Some(space) => {
                let name = self.value(&space.value, scope.names)?.show();
                let is_word = name.starts_with(|c: char| c.is_alphabetic() || c == '_')
                    && name.chars().all(|c| c.is_alphanumeric() || c == '_');
                if !is_word {
                    let message = format!("`{}` is no name for a namespace", shown(&name));
                    return Err(Fault::new(message).at(space.value.span.clone()));
                }
                // Its macros see no others, its properties those around.
                let (names, macros) = (self.scopes.space(Some(scope.names)), self.macros.space(None));
                let inner = Scope { names, macros };
                self.scopes.set(scope.names, &name, Stored::Known(Val::Space(inner)));
                inner
            }
        };
        let is_optional =
            attribute("optional").is_some_and(|a| matches!(a.value.text.as_str(), "true" | "True" | "1"));
        let wanted = self.value(filename, scope.names)?.show();
        let (name, text) = match self.open_file(&wanted) {
            Ok(found) => found,
            Err(_) if is_optional => return Ok(vec![]),
            Err(why) => return Err(why.at(filename.span.clone())),
        };
        if self.open.iter().any(|&f| self.sources.canonical(self.files.name(f)) == name) {
            let message = format!("`{}` includes itself", shown(&wanted));
            return Err(Fault::new(message).at(filename.span.clone()));
        }
        let (file, start) = self.files.add(name, text);
        let text = self.files.text(file).to_string();
        let Some(tree) = parse(&text, start, &mut self.out) else { return Ok(vec![]) };
        self.open.push(file);
        let children = tree.nodes[0].children.clone();
        let result = self.body(&Rc::new(tree), &children, inner, depth + 1);
        self.open.pop();
        Ok(result)
    }

    /// The text of a file that the one at hand names, and its name.
    pub(super) fn open_file(&mut self, wanted: &str) -> Result<(String, String), Fault> {
        if self.files.count() >= MAX_FILES {
            return Err(Fault::new(format!("more than {MAX_FILES} files")));
        }
        let from = self.files.name(self.open.last().copied().unwrap_or(0)).to_string();
        self.sources.open(&from, wanted).map_err(Fault::new)
    }

    fn set_property(
        &mut self,
        name: &str,
        (tree, element): (&Shared, &Node),
        Scope { names: scope, .. }: Scope,
    ) -> Result<(), Fault> {
        let attribute = |name: &str| element.attributes.iter().find(|a| a.name == name);
        let mut is_so = |name: &str, otherwise: bool| match attribute(name) {
            Some(a) => self.value(&a.value, scope)?.truth(),
            None => Ok(otherwise),
        };
        let (is_removed, is_lazy) = (is_so("remove", false)?, is_so("lazy_eval", true)?);
        if is_removed {
            while let Some(at) = self.scopes.find(scope, name) {
                self.scopes.remove(at, name);
            }
            return Ok(());
        }
        let wider = attribute("scope").map(|s| s.value.text.as_str());
        let to = match wider {
            None => scope,
            Some("parent") => {
                let mut at = self.scopes.parent(scope);
                // A macro of a namespace has the scope around that as its caller's.
                while let Some(space) =
                    at.filter(|&s| !self.scopes.is_space(scope) && self.scopes.is_space(s))
                {
                    at = self.scopes.parent(space);
                }
                at.unwrap_or(scope)
            }
            Some("global") => 0,
            Some(other) => {
                return Err(Fault::new(format!("`{}` is no scope", shown(other)))
                    .hint("scopes are parent and global"));
            }
        };
        if let Some(default) = attribute("default") {
            if self.scopes.find(scope, name).is_none() {
                self.scopes.set(to, name, Self::lazy(&default.value.text, &default.value.span));
            }
        } else if let Some(value) = attribute("value") {
            // What names itself means what it was before, and what goes to another scope what it is here.
            let text = value.value.text.as_str();
            let names_itself = text.contains('$')
                && text.split(|c: char| !c.is_alphanumeric() && c != '_').any(|word| word == name);
            let stored = if wider.is_some() || names_itself || !is_lazy {
                let known = self.text(text, scope);
                if names_itself && known.is_err() {
                    self.scopes.remove(scope, name);
                }
                Stored::Known(known?.unquoted())
            } else {
                Self::lazy(text, &value.value.span)
            };
            self.scopes.set(to, name, stored);
        } else {
            let block = Block::Raw(tree.clone(), element.children.clone());
            self.scopes.set(to, &format!("{BLOCK}{name}"), Stored::Block(block));
        }
        Ok(())
    }

    /// An attribute with its expressions evaluated.
    pub(super) fn attribute(&mut self, attribute: &Attribute, scope: usize) -> Option<Attribute> {
        if !attribute.value.text.contains('$') {
            return Some(attribute.clone());
        }
        let span = attribute.value.span.clone();
        match self.parts(&attribute.value.text, scope) {
            Ok(parts) => {
                let (mut text, mut exact) = (String::new(), vec![]);
                for part in &parts {
                    let start = text.len();
                    text.push_str(&part.show());
                    if let Val::Number(e) = part
                        && decimal(*e).is_none()
                    {
                        exact.push((start..text.len(), *e));
                    }
                }
                Some(Attribute { value: Value { text, span, is_plain: false, exact }, ..attribute.clone() })
            }
            Err(fault) => {
                self.fault(span, fault);
                None
            }
        }
    }
}
