//! The files of a model: what `<include>` stands for, and the models that others attach.
//!
//! An included file stands in the place of the element, whatever its root is called; none is included twice, as MuJoCo has it.

use super::super::diagnostic::Diagnostics;
use super::super::sources::{Files, Sources};
use super::super::xml::{MAX_XML_BYTES, Tree, parse_to, shown};
use std::collections::{HashMap, HashSet};
use std::ops::Range;

/// How deep elements may stand in elements: a body stands in the one that carries it.
const MAX_DEPTH: usize = 600;
/// How many files are read.
const MAX_FILES: usize = 500;
/// How many elements they may have together.
const MAX_NODES: usize = 400_000;

/// The files that have been read, and what was found in them.
pub(super) struct Opened<'s> {
    pub files: Files,
    pub out: Diagnostics,
    pub sources: &'s mut dyn Sources,
    bytes: usize,
    nodes: usize,
}

/// A file with what it includes, and the models that it may attach: their numbers by the names it has for them.
pub(super) struct Document {
    pub tree: Tree,
    pub parts: HashMap<String, usize>,
}

impl<'s> Opened<'s> {
    pub fn new(sources: &'s mut dyn Sources) -> Self {
        Opened { files: Files::default(), out: Diagnostics::default(), sources, bytes: 0, nodes: 0 }
    }

    /// The model of a text, the first one, and all that it attaches.
    pub fn documents(&mut self, name: &str, text: &str) -> Vec<Document> {
        let mut names = vec![self.sources.canonical(name)];
        let mut trees: Vec<Option<Tree>> = vec![self.document(name, text.to_string(), None)];
        let mut all = vec![];
        while all.len() < trees.len() {
            let at = all.len();
            let Some(tree) = trees[at].take() else {
                all.push(Document { tree: Tree::default(), parts: HashMap::new() });
                continue;
            };
            let mut parts = HashMap::new();
            let models = tree.root().all("asset").flat_map(|asset| asset.all("model"));
            for model in models {
                let Some(file) = model.attribute("file") else {
                    self.out.error(model.span(), "a <model> without `file`");
                    continue;
                };
                let Some((opened, text)) = self.open(&[&names[at]], file.text, &file.span) else { continue };
                let known = names.iter().position(|n| *n == opened);
                let number = known.unwrap_or(trees.len());
                if known.is_none() {
                    trees.push(self.document(&opened, text, Some(&file.span)));
                    names.push(opened);
                }
                // Without a name of its own it has the one that it gives itself.
                let own = trees.get(number).and_then(Option::as_ref);
                let own = own.and_then(|t| Some(t.root().attribute("model")?.text.to_string()));
                let name = model.attribute("name").map(|n| n.text.to_string()).or(own);
                parts.insert(name.unwrap_or_default(), number);
            }
            all.push(Document { tree, parts });
        }
        all
    }

    /// The text of a file that one of others names, with its own name.
    fn open(&mut self, from: &[&str], wanted: &str, span: &Range<usize>) -> Option<(String, String)> {
        if self.files.count() >= MAX_FILES {
            self.out.error(span.clone(), format!("more than {MAX_FILES} files"));
            return None;
        }
        let mut why = String::new();
        for from in from {
            match self.sources.open(from, wanted) {
                Ok(opened) => return Some(opened),
                Err(reason) if why.is_empty() => why = reason,
                Err(_) => {}
            }
        }
        self.out.error(span.clone(), format!("the file cannot be read: {}", shown(&why)));
        None
    }

    /// A text with what it includes; `from` is where it is named.
    fn document(&mut self, name: &str, text: String, from: Option<&Range<usize>>) -> Option<Tree> {
        let mut tree = self.parsed(name, text, from)?;
        let mut included = HashSet::from([self.sources.canonical(name)]);
        // Which file the nodes from a number on are of.
        let mut from = vec![(0, name.to_string())];
        let mut at = 0;
        while at < tree.nodes.len() {
            let children = std::mem::take(&mut tree.nodes[at].children);
            let (mut all, mut open) = (vec![], children);
            open.reverse();
            while let Some(child) = open.pop() {
                if tree.nodes[child].name != "include" {
                    all.push(child);
                } else if let Some(root) = self.included(&mut tree, child, &mut from, &mut included) {
                    open.extend(std::mem::take(&mut tree.nodes[root].children).into_iter().rev());
                }
            }
            tree.nodes[at].children = all;
            at += 1;
        }
        self.is_shallow(&tree).then_some(tree)
    }

    /// The root of an included file, its nodes behind those of the tree.
    fn included(
        &mut self,
        tree: &mut Tree,
        node: usize,
        from: &mut Vec<(usize, String)>,
        included: &mut HashSet<String>,
    ) -> Option<usize> {
        let element = &tree.nodes[node];
        let span = element.span.clone();
        if !element.children.is_empty() {
            self.out.error(span, "an <include> has no elements in it");
            return None;
        }
        let Some(file) = element.attributes.iter().find(|a| a.name == "file") else {
            self.out.error(span, "an <include> without `file`");
            return None;
        };
        let (wanted, span) = (file.value.text.clone(), file.value.span.clone());
        // A path begins at the folder of the model's file, else at that of the file where it stands.
        let own = from.iter().rev().find(|f| f.0 <= node).map_or("", |f| f.1.as_str());
        let (main, own) = (from[0].1.clone(), own.to_string());
        let (name, text) = self.open(&[&main, &own], &wanted, &span)?;
        if !included.insert(name.clone()) {
            self.out
                .error(span, format!("`{}` is included already", shown(&wanted)))
                .hint("a file is included once; <replicate> and <attach> repeat what stands in one");
            return None;
        }
        let other = self.parsed(&name, text, Some(&span))?;
        let first = tree.nodes.len();
        from.push((first, name));
        let shifted = other.nodes.into_iter().map(|mut n| {
            n.children.iter_mut().for_each(|c| *c += first);
            n
        });
        tree.nodes.extend(shifted);
        Some(first)
    }

    fn parsed(&mut self, name: &str, text: String, from: Option<&Range<usize>>) -> Option<Tree> {
        let length = text.len();
        let (file, start) = self.files.add(name.into(), text);
        let from = from.cloned().unwrap_or(start..start);
        self.bytes += length;
        if self.bytes > 4 * MAX_XML_BYTES {
            self.out.error(from, format!("the files have more than {} bytes together", 4 * MAX_XML_BYTES));
            return None;
        }
        let tree = parse_to(MAX_DEPTH, self.files.text(file), start, &mut self.out)?;
        self.nodes += tree.nodes.len();
        if self.nodes > MAX_NODES {
            self.out.error(from, format!("the files have more than {MAX_NODES} elements together"));
            return None;
        }
        Some(tree)
    }

    /// True if elements stand in elements not too deeply, once all files are in their places.
    fn is_shallow(&mut self, tree: &Tree) -> bool {
        let mut open = vec![(0, 1)];
        while let Some((node, depth)) = open.pop() {
            if depth > MAX_DEPTH {
                let message = format!("elements stand in elements more than {MAX_DEPTH} deep");
                self.out.error(tree.nodes[node].span.clone(), message);
                return false;
            }
            open.extend(tree.nodes[node].children.iter().map(|&c| (c, depth + 1)));
        }
        true
    }
}
