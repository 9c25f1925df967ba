//! Properties, by the scopes in which they are seen: a macro sees those of its caller.

use super::value::{Fault, Val};
use std::collections::HashMap;
use std::ops::Range;

/// A text that is evaluated when it is first asked for, in the scope in which it was written.
#[derive(Clone, Debug)]
pub(super) struct Lazy {
    pub text: String,
    pub span: Range<usize>,
}

/// A property.
#[derive(Clone, Debug)]
pub(super) enum Stored {
    Lazy(Lazy),
    /// One that is being evaluated.
    Busy,
    Known(Val),
    /// One that could not be evaluated, which was said.
    Bad(Fault),
}

/// All scopes that there were.
#[derive(Debug)]
pub(super) struct Scopes {
    all: Vec<(HashMap<String, Stored>, Option<usize>)>,
}

impl Scopes {
    pub fn new() -> Self {
        Scopes { all: vec![(HashMap::new(), None)] }
    }

    pub fn inside(&mut self, parent: usize) -> usize {
        self.all.push((HashMap::new(), Some(parent)));
        self.all.len() - 1
    }

    pub fn parent(&self, scope: usize) -> Option<usize> {
        self.all[scope].1
    }

    pub fn set(&mut self, scope: usize, name: &str, value: Stored) {
        self.all[scope].0.insert(name.into(), value);
    }

    pub fn get(&self, scope: usize, name: &str) -> Option<&Stored> {
        self.all[scope].0.get(name)
    }

    pub fn remove(&mut self, scope: usize, name: &str) {
        self.all[scope].0.remove(name);
    }

    /// The scope that holds what a name means here.
    pub fn find(&self, scope: usize, name: &str) -> Option<usize> {
        let mut at = Some(scope);
        while let Some(scope) = at.filter(|&s| !self.all[s].0.contains_key(name)) {
            at = self.parent(scope);
        }
        at
    }

    /// The names that are seen from here.
    pub fn names(&self, scope: usize) -> Vec<&str> {
        let mut found = vec![];
        let mut at = Some(scope);
        while let Some(scope) = at {
            found.extend(self.all[scope].0.keys().map(String::as_str));
            at = self.parent(scope);
        }
        found.sort_unstable();
        found
    }
}
