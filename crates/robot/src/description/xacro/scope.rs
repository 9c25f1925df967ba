//! Names, by the scopes in which they are seen: a macro sees those of its caller, or of the namespace that it stands in.

use super::macros::Block;
use super::value::{Fault, Val};
use std::collections::HashMap;
use std::ops::Range;

/// Where names are looked up: a scope of properties and blocks, and one of macros.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Scope {
    pub names: usize,
    pub macros: usize,
}

/// A text that is evaluated when it is first asked for, in the scope in which it was written.
#[derive(Clone, Debug)]
pub(super) struct Lazy {
    pub text: String,
    pub span: Range<usize>,
}

/// A property, or a block under its name behind a [`BLOCK`].
#[derive(Clone, Debug)]
pub(super) enum Stored {
    Lazy(Lazy),
    /// One that is being evaluated.
    Busy,
    Known(Val),
    /// One that could not be evaluated, which was said.
    Bad(Fault),
    Block(Block),
}

/// What the name of a block begins with, so that no property has it.
pub(super) const BLOCK: char = '*';

/// All scopes that there were, of properties or of macros.
#[derive(Debug)]
pub(super) struct Scopes<T> {
    all: Vec<Names<T>>,
}

#[derive(Debug)]
struct Names<T> {
    own: HashMap<String, T>,
    parent: Option<usize>,
    /// True for the names of a namespace.
    is_space: bool,
}

impl<T> Scopes<T> {
    pub fn new() -> Self {
        Scopes { all: vec![Names { own: HashMap::new(), parent: None, is_space: false }] }
    }

    fn add(&mut self, parent: Option<usize>, is_space: bool) -> usize {
        self.all.push(Names { own: HashMap::new(), parent, is_space });
        self.all.len() - 1
    }

    pub fn inside(&mut self, parent: usize) -> usize {
        self.add(Some(parent), false)
    }

    /// The scope of a namespace, which sees what its parent sees, or nothing else.
    pub fn space(&mut self, parent: Option<usize>) -> usize {
        self.add(parent, true)
    }

    pub fn parent(&self, scope: usize) -> Option<usize> {
        self.all[scope].parent
    }

    pub fn is_space(&self, scope: usize) -> bool {
        self.all[scope].is_space
    }

    pub fn set(&mut self, scope: usize, name: &str, value: T) {
        self.all[scope].own.insert(name.into(), value);
    }

    pub fn get(&self, scope: usize, name: &str) -> Option<&T> {
        self.all[scope].own.get(name)
    }

    pub fn remove(&mut self, scope: usize, name: &str) {
        self.all[scope].own.remove(name);
    }

    /// The scope that holds what a name means here.
    pub fn find(&self, scope: usize, name: &str) -> Option<usize> {
        let mut at = Some(scope);
        while let Some(scope) = at.filter(|&s| !self.all[s].own.contains_key(name)) {
            at = self.parent(scope);
        }
        at
    }

    /// What a name means here.
    pub fn seen(&self, scope: usize, name: &str) -> Option<&T> {
        self.get(self.find(scope, name)?, name)
    }

    /// The names that are seen from here.
    pub fn names(&self, scope: usize) -> Vec<&str> {
        let mut found = vec![];
        let mut at = Some(scope);
        while let Some(scope) = at {
            found.extend(self.all[scope].own.keys().map(String::as_str));
            at = self.parent(scope);
        }
        found.retain(|n| !n.starts_with(BLOCK));
        found.sort_unstable();
        found
    }

    /// All that was ever named.
    pub fn values(&self) -> impl Iterator<Item = &T> {
        self.all.iter().flat_map(|names| names.own.values())
    }
}
