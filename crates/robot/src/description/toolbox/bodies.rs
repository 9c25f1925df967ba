//! Bodies and joints of a `rigidBodyTree` of MATLAB.

use super::links::{Joint, Link, Made, Moves, TREE};
use super::run::Run;
use super::value::{Body, Formula, Lost, Value, formula};
use crate::description::{Convention, MAX_ROWS};
use std::ops::Range;

impl Run<'_> {
    /// The functions that make a `rigidBodyTree`.
    pub fn tree_function(&mut self, name: &str, values: &[Value], span: &Range<usize>) -> Value {
        match (name, values) {
            ("rigidBodyTree", _) => Value::Tree,
            ("rigidBody", [name, ..]) => {
                self.store.bodies.push(Body { name: name.clone(), joint: None, lost: None });
                Value::Body(self.store.bodies.len() - 1)
            }
            ("rigidBodyJoint", _) => {
                let mut lost = None;
                let moves = match values.get(1) {
                    None => Moves::Nothing,
                    Some(Value::Text(t)) if matches!(&**t, "revolute" | "continuous") => Moves::Turns,
                    Some(Value::Text(t)) if &**t == "prismatic" => Moves::Slides,
                    Some(Value::Text(t)) if &**t == "fixed" => Moves::Nothing,
                    Some(Value::Unknown(why)) => {
                        lost = Some(why.clone());
                        Moves::Nothing
                    }
                    Some(_) => {
                        lost = Some(self.lost(span, "says no kind of joint that is known"));
                        Moves::Nothing
                    }
                };
                self.store.joints.push(Joint { moves, row: None, limits: None, span: span.clone(), lost });
                Value::Joint(self.store.joints.len() - 1)
            }
            ("setFixedTransform", [Value::Joint(k), row, words @ ..]) => {
                self.change(&Value::Joint(*k));
                let convention = match words.first() {
                    Some(Value::Text(t)) if &**t == "dh" => Some(Convention::Standard),
                    Some(Value::Text(t)) if &**t == "mdh" => Some(Convention::Craig),
                    _ => None,
                };
                let cells: Option<Vec<Formula>> = match row {
                    Value::Unknown(_) => None,
                    _ => self.store.items(row).ok().and_then(|r| r.iter().map(formula).collect()),
                };
                let lost = match (convention, cells, row) {
                    (Some(convention), Some(cells), _) if cells.len() == 4 => {
                        self.store.joints[*k].row = Some((cells, convention));
                        self.store.joints[*k].span = span.clone();
                        None
                    }
                    (_, _, Value::Unknown(lost)) => Some(lost.clone()),
                    (Some(_), Some(cells), _) => {
                        let message = format!("a row of {} values: a alpha d theta", cells.len());
                        Some(Lost { span: span.clone(), message: message.into() })
                    }
                    _ => Some(self.lost(span, "is not followed")),
                };
                if let Some(lost) = lost {
                    self.store.lose(&Value::Joint(*k), &lost);
                }
                self.set.push(*k);
                Value::None
            }
            ("addBody", [Value::Tree, Value::Body(k), parent, ..]) => {
                self.added.push((*k, parent.clone(), span.clone()));
                Value::None
            }
            _ => {
                let lost = self.lost(span, "is not followed");
                self.tree_lost.get_or_insert_with(|| lost.clone());
                Value::Unknown(lost)
            }
        }
    }

    /// `joint.PositionLimits = value`
    pub fn set_of_joint(&mut self, k: usize, name: &str, value: Value, span: &Range<usize>) {
        self.change(&Value::Joint(k));
        let found = match name {
            "PositionLimits" => self.ends(&value, span).map(|ends| self.store.joints[k].limits = ends),
            "HomePosition" | "Name" => Ok(()),
            _ => Err(self.lost(span, "is not followed")),
        };
        if let Err(lost) = found {
            self.store.lose(&Value::Joint(k), &lost);
        }
    }

    /// The robot of the joints of a `rigidBodyTree`, if rows were set: in the order of its bodies, each on the one before.
    pub fn tree(&mut self) -> Option<Made> {
        let first = *self.set.first()?;
        if !self.set.iter().any(|k| self.store.joints[*k].row.is_some()) {
            return None;
        }
        let span = self.store.joints[first].span.clone();
        let mut lost = self.tree_lost.clone();
        let mut joints: Vec<usize> = vec![];
        if self.added.is_empty() {
            for k in self.set.clone() {
                if joints.len() < MAX_ROWS + 1 && !joints.contains(&k) {
                    joints.push(k);
                }
            }
        }
        let mut before: Option<Value> = None;
        for (body, parent, place) in self.added.clone() {
            let follows =
                before.as_ref().is_none_or(|name| matches!(name, Value::Text(_)) && *name == parent);
            if !follows && lost.is_none() {
                let message = "a body that does not stand on the one before: trees of a program are not read";
                lost = Some(Lost { span: place, message: message.into() });
            }
            let body = &self.store.bodies[body];
            lost = lost.or_else(|| body.lost.clone());
            joints.extend(body.joint);
            before = Some(body.name.clone());
        }
        let known = joints.iter().find_map(|k| self.store.joints[*k].row.as_ref().map(|r| r.1));
        let mut links = vec![];
        for k in joints {
            let joint = self.store.joints[k].clone();
            let (cells, convention) = joint.row.unwrap_or((vec![], known.unwrap_or(Convention::Standard)));
            let (moves, limits, span) = (joint.moves, joint.limits, joint.span);
            let cells = TREE.into_iter().zip(cells).collect();
            let link = Link { cells, moves, convention, is_flipped: false, limits, span, lost: joint.lost };
            self.store.links.push(link);
            links.push(self.store.links.len() - 1);
        }
        Some(Made { name: None, links, span, lost, is_part: false })
    }
}
