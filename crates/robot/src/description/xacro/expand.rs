//! Elements one after the other: those of xacro do what they say, others are taken over.

use super::macros::Block;
use super::scope::Stored;
use super::value::{Fault, Val, decimal};
use super::{Blocks, MAX_DEPTH, MAX_WORK, Shared, Xacro};
use crate::description::xml::{Attribute, Node, Value, parse, shown};
use std::rc::Rc;

impl Xacro<'_> {
    /// The elements that these stand for, in the result.
    pub(super) fn body(
        &mut self,
        tree: &Shared,
        children: &[usize],
        scope: usize,
        blocks: &Blocks,
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
            match self.element((tree, child, &element), scope, blocks, depth) {
                Ok(nodes) => all.extend(nodes),
                Err(fault) => self.fault(element.span, fault),
            }
        }
        all
    }

    fn element(
        &mut self,
        (tree, index, element): (&Shared, usize, &Node),
        scope: usize,
        blocks: &Blocks,
        depth: usize,
    ) -> Result<Vec<usize>, Fault> {
        let Some(name) = element.name.strip_prefix("xacro:") else {
            let number = self.result.nodes.len();
            self.result.nodes.push(Node { attributes: vec![], children: vec![], ..element.clone() });
            let attributes = element.attributes.iter().filter_map(|a| self.attribute(a, scope)).collect();
            let children = self.body(tree, &element.children, scope, blocks, depth + 1);
            let node = &mut self.result.nodes[number];
            (node.attributes, node.children) = (attributes, children);
            return Ok(vec![number]);
        };
        let attribute = |name: &str| element.attributes.iter().find(|a| a.name == name);
        let needs = |name: &str| {
            attribute(name).ok_or_else(|| Fault::new(format!("<{}> without `{name}`", shown(&element.name))))
        };
        match name {
            "include" => self.include(&needs("filename")?.value, element, scope, blocks, depth),
            "property" => {
                let name = needs("name")?.value.text.clone();
                self.set_property(&name, (tree, element), scope)?;
                Ok(vec![])
            }
            "arg" => {
                let name = needs("name")?.value.text.clone();
                if let Some(default) = attribute("default")
                    && !self.arguments.contains_key(&name)
                {
                    let value = self.text(&default.value.text, scope)?.show();
                    self.arguments.insert(name, value);
                }
                Ok(vec![])
            }
            "macro" => {
                self.define(tree, index);
                Ok(vec![])
            }
            "if" | "unless" => {
                let value = self.text(&needs("value")?.value.text, scope)?;
                let takes = value.truth()? == (name == "if");
                Ok(if takes { self.body(tree, &element.children, scope, blocks, depth + 1) } else { vec![] })
            }
            "insert_block" => {
                let name = self.text(&needs("name")?.value.text, scope)?;
                self.insert(&name, scope, blocks, depth)
            }
            "element" | "attribute" | "call" if !self.macros.contains_key(name) => {
                Err(Fault::new(format!("<xacro:{name}> is not read"))
                    .hint("expand the file with xacro first"))
            }
            name => self.call(name, (tree, element), scope, blocks, depth),
        }
    }

    fn include(
        &mut self,
        filename: &Value,
        element: &Node,
        scope: usize,
        blocks: &Blocks,
        depth: usize,
    ) -> Result<Vec<usize>, Fault> {
        if element.attributes.iter().any(|a| a.name == "ns") {
            return Err(Fault::new("`ns` is not read").hint("expand the file with xacro first"));
        }
        let is_optional = element
            .attributes
            .iter()
            .any(|a| a.name == "optional" && matches!(a.value.text.as_str(), "true" | "True" | "1"));
        let wanted = self.text(&filename.text, scope)?.show();
        let from = self.files.name(self.open.last().copied().unwrap_or(0)).to_string();
        let (name, text) = match self.sources.open(&from, &wanted) {
            Ok(found) => found,
            Err(_) if is_optional => return Ok(vec![]),
            Err(why) => return Err(Fault::new(why)),
        };
        if self.open.iter().any(|&f| self.files.name(f) == name) {
            return Err(Fault::new(format!("`{}` includes itself", shown(&wanted))));
        }
        if self.files.count() >= MAX_FILES {
            return Err(Fault::new(format!("more than {MAX_FILES} files")));
        }
        let (file, start) = self.files.add(name, text);
        let text = self.files.text(file).to_string();
        let Some(tree) = parse(&text, start, &mut self.out) else { return Ok(vec![]) };
        self.open.push(file);
        let children = tree.nodes[0].children.clone();
        let result = self.body(&Rc::new(tree), &children, scope, blocks, depth + 1);
        self.open.pop();
        Ok(result)
    }

    fn set_property(
        &mut self,
        name: &str,
        (tree, element): (&Shared, &Node),
        scope: usize,
    ) -> Result<(), Fault> {
        let attribute = |name: &str| element.attributes.iter().find(|a| a.name == name);
        let wider = attribute("scope").map(|s| s.value.text.as_str());
        let to = match wider {
            None => scope,
            Some("parent") => self.scopes.parent(scope).unwrap_or(scope),
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
            let stored = if wider.is_some() || names_itself {
                let known = self.text(text, scope);
                if names_itself && known.is_err() {
                    self.scopes.remove(scope, name);
                }
                Stored::Known(known?)
            } else {
                Self::lazy(text, &value.value.span)
            };
            self.scopes.set(to, name, stored);
        } else {
            self.raw.insert(name.into(), Block::Raw(tree.clone(), element.children.clone()));
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

/// How many files are read, each as often as it is included.
const MAX_FILES: usize = 500;
