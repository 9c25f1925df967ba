//! Documents that solve two problems, and call the links of both by the same names.

use super::Walk;
use crate::names::Name;
use crate::order;
use crate::product::product;
use denavit_reading::document::{Part, Statement};
use std::ops::Range;

impl Walk<'_> {
    /// In a document with links of its own: where a matrix that it names is told again under another heading, by none that it names,
    /// another problem begins, and what was made of the links before has no meaning any more. `U = T`, where `U = T Trans(x, -a_2)` before.
    pub(super) fn begin_again(&mut self, statement: &Statement) {
        let [left, right] = &statement.sides[..] else { return };
        let Some(name) = self.lone(left) else { return };
        let has_own_links = self.lexis.habits.products.iter().any(|key| !key.starts_with('T'));
        let is_elsewhere =
            || self.named_under.get(&name.key()).is_some_and(|under| *under != statement.heading);
        let is_named = |name: &Name| self.named_under.contains_key(&name.key());
        let is_told = || {
            matches!(right.parts[..], [Part::Text(_)])
                && !order::names(self.text, right).iter().any(is_named)
                && product(self.text, right, &self.lexis, &self.subject, &|_| None).is_ok()
        };
        if has_own_links && is_elsewhere() && is_told() {
            // A link begins the chain again, another name is told anew alone.
            let is_link = self.lexis.habits.products.contains(&name.key());
            let is_gone = |key: &String, under: &Option<Range<usize>>| match is_link {
                true => *under != statement.heading,
                false => *key == name.key(),
            };
            let gone =
                self.named_under.iter().filter(|(key, under)| is_gone(key, under)).map(|n| n.0.clone());
            for key in gone.collect::<Vec<_>>() {
                self.lexis.forget_frame(&key);
                self.named_under.remove(&key);
            }
        }
    }
}
