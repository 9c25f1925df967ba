//! `<keyframe>`: configurations with names.

use super::super::xml::{Element, shown};
use super::Mjcf;
use denavit_symbolic::Expr;

const KEY: &[&str] = &["name", "time", "qpos", "qvel", "act", "ctrl", "mpos", "mquat"];

/// What a configuration has values for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Slot {
    /// A body that floats: seven.
    Free,
    /// A ball: four.
    Ball,
    /// The joint of this number that turns or slides: one.
    Joint(usize),
}

impl Slot {
    fn count(self) -> usize {
        match self {
            Slot::Free => 7,
            Slot::Ball => 4,
            Slot::Joint(_) => 1,
        }
    }
}

impl Mjcf<'_, '_> {
    /// The configurations of a model by their names: values by the names of joints, radians and metres.
    pub(super) fn keyframes(&mut self, root: Element) -> Vec<(String, Vec<(String, Expr)>)> {
        let mut all: Vec<(String, Vec<(String, Expr)>)> = vec![];
        let wanted: usize = self.slots.iter().map(|s| s.count()).sum();
        for key in root.all("keyframe").flat_map(|k| k.all("key")) {
            if !self.works(1 + wanted, &key) {
                break;
            }
            key.only(KEY, &mut self.reader.out);
            let (Some(name), Some(text)) = (key.attribute("name"), key.attribute("qpos")) else { continue };
            let name_text = super::plain(name.text);
            let count = text.words().len();
            if count != wanted {
                let message = format!("`qpos` has {count} numbers, the model {wanted}: this is skipped");
                self.reader.out.warning(text.span, message);
                continue;
            }
            if all.iter().any(|k| k.0 == name_text) {
                let message = format!("the key `{}` is given twice", shown(name.text));
                self.reader.out.error(name.span, message).hint("names are unique");
                continue;
            }
            if self.slots.contains(&Slot::Ball) {
                let message = "the values of a ball are no values of turns: this is skipped";
                self.reader.out.warning(text.span, message);
                continue;
            }
            let Some(numbers) = self.reader.numbers(&text, "qpos", count) else { continue };
            let (mut at, mut values) = (0, vec![]);
            for slot in &self.slots {
                if let Slot::Joint(draft) = slot {
                    let name = self.drafts[*draft].joint.name.clone();
                    values.push((name, Expr::from(numbers[at].0.clone())));
                }
                at += slot.count();
            }
            all.push((name_text, values));
        }
        all
    }
}
