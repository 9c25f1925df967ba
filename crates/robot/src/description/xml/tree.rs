//! Elements, attributes and words with their places.

use super::shown;
use crate::description::diagnostic::{Diagnostics, nearest};
use denavit_symbolic::Expr;
use roxmltree::Document;
use std::ops::Range;

/// A document: its elements, the root first.
#[derive(Clone, Debug, Default)]
pub(in crate::description) struct Tree {
    pub nodes: Vec<Node>,
}

/// An element.
#[derive(Clone, Debug)]
pub(in crate::description) struct Node {
    /// Its name, with its prefix if it has one.
    pub name: String,
    pub attributes: Vec<Attribute>,
    pub children: Vec<usize>,
    /// The beginning of its tag.
    pub span: Range<usize>,
    /// All of it.
    pub whole: Range<usize>,
}

/// An attribute without prefix.
#[derive(Clone, Debug)]
pub(in crate::description) struct Attribute {
    pub name: String,
    pub span: Range<usize>,
    pub value: Value,
}

/// The value of an attribute.
#[derive(Clone, Debug)]
pub(in crate::description) struct Value {
    pub text: String,
    pub span: Range<usize>,
    /// True if the bytes of the text stand in the file as they are.
    pub is_plain: bool,
    /// Parts of the text that stand for a number which no decimal is.
    pub exact: Vec<(Range<usize>, Expr)>,
}

/// An element of a document.
#[derive(Clone, Copy)]
pub(in crate::description) struct Element<'a> {
    pub tree: &'a Tree,
    pub node: usize,
}

/// A value, or a word of one, and its place.
#[derive(Clone, Debug)]
pub(in crate::description) struct Text<'a> {
    pub text: &'a str,
    pub span: Range<usize>,
    /// The number that it stands for, where no decimal is that number.
    pub exact: Option<Expr>,
    value: &'a Value,
}

impl Tree {
    /// The elements of a document that begins at a byte.
    pub fn of(document: &Document, start: usize) -> Self {
        let mut tree = Tree::default();
        let shift = |r: Range<usize>| start + r.start..start + r.end;
        let mut open = vec![(document.root_element(), None)];
        while let Some((node, parent)) = open.pop() {
            let tag = node.tag_name();
            let prefix = tag.namespace().and_then(|uri| node.lookup_prefix(uri));
            let name = prefix.map_or_else(|| tag.name().to_string(), |p| format!("{p}:{}", tag.name()));
            // `xacro:name` is the only attribute with a prefix that matters, and only there.
            let is_own = |a: &roxmltree::Attribute| a.namespace().is_none();
            let is_made = name == "xacro:element";
            let prefixed = |a: &roxmltree::Attribute| is_made && a.namespace() == tag.namespace();
            let attributes = node.attributes().filter(|a| is_own(a) || prefixed(a)).map(|a| {
                let span = shift(a.range_value());
                let is_plain = a.value().len() == span.len();
                let value = Value { text: a.value().into(), span, is_plain, exact: vec![] };
                let prefix = if is_own(&a) { "" } else { "xacro:" };
                Attribute { name: format!("{prefix}{}", a.name()), span: shift(a.range_qname()), value }
            });
            let whole = shift(node.range());
            let span = whole.start..(whole.start + 1 + name.len()).min(whole.end);
            let number = tree.nodes.len();
            tree.nodes.push(Node { name, attributes: attributes.collect(), children: vec![], span, whole });
            if let Some(parent) = parent {
                tree.nodes[parent as usize].children.push(number);
            }
            let children: Vec<_> = node.children().filter(roxmltree::Node::is_element).collect();
            open.extend(children.into_iter().rev().map(|c| (c, Some(number as u32))));
        }
        tree
    }

    pub fn root(&self) -> Element<'_> {
        Element { tree: self, node: 0 }
    }
}

impl<'a> Element<'a> {
    fn get(&self) -> &'a Node {
        &self.tree.nodes[self.node]
    }

    /// Its name; nothing where it has a prefix.
    pub fn name(&self) -> Option<&'a str> {
        Some(self.full_name()).filter(|n| !n.contains(':'))
    }

    /// Its name with its prefix.
    pub fn full_name(&self) -> &'a str {
        &self.get().name
    }

    /// The beginning of its tag.
    pub fn span(&self) -> Range<usize> {
        self.get().span.clone()
    }

    pub fn children(&self) -> impl Iterator<Item = Element<'a>> + use<'a> {
        let tree = self.tree;
        self.get().children.iter().map(move |&node| Element { tree, node })
    }

    /// The children of this name.
    pub fn all(&self, name: &'static str) -> impl Iterator<Item = Element<'a>> + use<'a> {
        self.children().filter(move |c| c.name() == Some(name))
    }

    /// The first child of this name; a second one is reported.
    pub fn one(&self, name: &'static str, out: &mut Diagnostics) -> Option<Element<'a>> {
        let mut all = self.all(name);
        let first = all.next();
        if let Some(second) = all.next() {
            out.warning(second.span(), format!("a second <{name}>; the first one counts"));
        }
        first
    }

    pub fn attribute(&self, name: &str) -> Option<Text<'a>> {
        let value = &self.get().attributes.iter().find(|a| a.name == name)?.value;
        let exact = value.exact_at(0..value.text.len());
        Some(Text { text: &value.text, span: value.span.clone(), exact, value })
    }

    /// The attributes in order, with their values.
    pub fn attributes(&self) -> impl Iterator<Item = (&'a str, Text<'a>)> + use<'a> {
        self.get().attributes.iter().map(|a| {
            let value = &a.value;
            let exact = value.exact_at(0..value.text.len());
            (a.name.as_str(), Text { text: &value.text, span: value.span.clone(), exact, value })
        })
    }

    /// Warns of attributes that are not among these.
    pub fn only(&self, known: &[&str], out: &mut Diagnostics) {
        for attribute in &self.get().attributes {
            let name = attribute.name.as_str();
            if known.contains(&name) || out.is_full() {
                continue;
            }
            let element = self.full_name();
            let message = format!("<{element}> has no `{}`: it is skipped", shown(name));
            let finding = out.warning(attribute.span.clone(), message);
            if let Some(near) = nearest(name, known.iter().copied()) {
                finding.hint(format!("did you mean `{near}`?"));
            }
        }
    }
}

impl Value {
    /// The number that a part of the text stands for.
    fn exact_at(&self, part: Range<usize>) -> Option<Expr> {
        self.exact.iter().find(|e| e.0 == part).map(|e| e.1)
    }
}

impl<'a> Text<'a> {
    /// The words between blanks, with their places.
    pub fn words(&self) -> Vec<Text<'a>> {
        let whole = self.value.text.as_str();
        let at = |word: &str| word.as_ptr() as usize - whole.as_ptr() as usize;
        let word = |word: &'a str| {
            let part = at(word)..at(word) + word.len();
            let start = self.value.span.start;
            let span = match self.value.is_plain {
                true => start + part.start..start + part.end,
                false => self.value.span.clone(),
            };
            Text { text: word, span, exact: self.value.exact_at(part), value: self.value }
        };
        self.text.split_whitespace().map(word).collect()
    }
}
