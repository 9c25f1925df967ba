//! `<equality>`: joints that follow others, and loops that are closed.

use super::super::diagnostic::nearest;
use super::super::tree::moved;
use super::super::xml::{Element, Text, shown};
use super::Mjcf;
use denavit_symbolic::{Expr, Rational};

const JOINT: &[&str] = &["name", "class", "active", "joint1", "joint2", "polycoef", "solref", "solimp"];

impl<'a> Mjcf<'a, '_> {
    /// The couplings of all models that are there.
    pub(super) fn couplings(&mut self) {
        let mut said: Vec<&str> = vec![];
        let parts = std::mem::take(&mut self.parts);
        self.driven = self.driven(&parts);
        // Couplings change where joints are at 0.
        let has_loops = |part: &(usize, String, String)| {
            let root = self.models[part.0].root;
            root.all("equality").any(|e| e.children().any(|c| matches!(c.name(), Some("connect" | "weld"))))
        };
        let shown_at = if parts.iter().any(has_loops) { self.shown() } else { vec![] };
        for (model, prefix, suffix) in parts {
            let root = self.models[model].root;
            for element in root.all("equality").flat_map(|e| e.children()) {
                if !self.works(1, &element) {
                    return;
                }
                let name = element.name().unwrap_or_default();
                if self.is_inactive(element, model) {
                    self.reader.out.note(element.span(), "this is not active at the start: it is skipped");
                } else if name == "joint" {
                    element.only(JOINT, &mut self.reader.out);
                    self.coupling(element, &|n: &str| format!("{prefix}{}{suffix}", super::plain(n)), model);
                } else if matches!(name, "connect" | "weld") {
                    let full = |n: &str| format!("{prefix}{}{suffix}", super::plain(n));
                    let hold = self.hold(element, &full, model, &shown_at);
                    self.holds.extend(hold);
                } else if !said.contains(&name) {
                    said.push(name);
                    let message = format!(
                        "<{}> is not read: joints move as if it were not there",
                        shown(element.full_name())
                    );
                    self.reader.out.warning(element.span(), message);
                }
            }
        }
    }

    fn is_inactive(&mut self, element: Element<'a>, model: usize) -> bool {
        let classes = &self.models[model].classes;
        let active = classes.resolve_as("equality", element, None, &mut self.reader.out).get("active");
        active.is_some_and(|a| a.text == "false")
    }

    /// y − y₀ = a₀ + a₁·(x − x₀), y₀ and x₀ being the values where the file shows the model.
    fn coupling(&mut self, element: Element<'a>, full: &dyn Fn(&str) -> String, model: usize) {
        let Some(first) = element.attribute("joint1") else {
            self.reader.out.error(element.span(), "a coupling without `joint1`");
            return;
        };
        let second = element.attribute("joint2");
        let found = self.known(&first, full, model);
        let leader = second.as_ref().map(|s| self.known(s, full, model));
        let Some(coefficients) = self.polynomial(element) else { return };
        let (Some(follower), Some(leader)) = (found, leader.map_or(Some(None), |l| l.map(Some))) else {
            return;
        };
        if Some(follower) == leader {
            self.reader
                .out
                .error(element.span(), format!("the joint `{}` follows itself", shown(first.text)));
            return;
        }
        if self.drafts[follower].follows.is_some() || !self.drafts[follower].moves() {
            let message =
                format!("the joint `{}` follows another already: this is skipped", shown(first.text));
            self.reader.out.warning(element.span(), message);
            return;
        }
        let [constant, factor, bent @ ..] = coefficients;
        let reference = |k: usize| self.references.get(&k).copied().unwrap_or(Expr::int(0));
        let Some(leader) = leader else {
            // It stays where it is.
            let value = reference(follower) + Expr::from(constant);
            let joint = &mut self.drafts[follower].joint;
            if let Some(kind) = joint.kind {
                joint.origin = joint.origin * moved(joint, kind, value);
            }
            joint.kind = None;
            self.reader.out.note(element.span(), format!("the joint `{}` stands still", shown(first.text)));
            return;
        };
        if bent.iter().any(|c| !c.is_zero()) {
            let message = format!("`{}` does not follow linearly: it moves by itself", shown(first.text));
            self.reader.out.warning(element.span(), message);
            return;
        }
        let offset =
            reference(follower) + Expr::from(constant) - Expr::from(factor.clone()) * reference(leader);
        let name = self.drafts[leader].joint.name.clone();
        self.drafts[follower].follows = Some((name, factor, offset, element.span()));
    }

    /// The coefficients from the constant on.
    fn polynomial(&mut self, element: Element) -> Option<[Rational; 5]> {
        let mut all = [0, 1, 0, 0, 0].map(|k| Rational::from(k as i64));
        if let Some(text) = element.attribute("polycoef") {
            let count = text.words().len().clamp(1, 5);
            let numbers = self.reader.numbers(&text, "polycoef", count)?;
            for (to, (x, _)) in all.iter_mut().zip(numbers) {
                *to = x;
            }
        }
        Some(all)
    }

    /// A joint by its name. One that is not there is reported, unless the model is a part of which not all is there.
    fn known(&mut self, name: &Text, full: &dyn Fn(&str) -> String, model: usize) -> Option<usize> {
        let found = self.joints.get(&full(name.text)).copied();
        if found.is_none() && model == 0 {
            let message = format!("there is no joint `{}` that turns or slides", shown(name.text));
            let finding = self.reader.out.error(name.span.clone(), message);
            let names = self.drafts.iter().filter(|d| d.moves()).map(|d| d.joint.name.as_str());
            if let Some(near) = nearest(name.text, names) {
                finding.hint(format!("did you mean `{near}`?"));
            }
        }
        found
    }
}
