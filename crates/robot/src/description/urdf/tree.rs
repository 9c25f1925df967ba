//! Links and joints as one tree.

use super::Links;
use super::joints::Draft;
use crate::description::diagnostic::nearest;
use crate::description::reader::Reader;
use crate::description::tree::{Follows, Joint, Mechanism};
use crate::description::xml::{Element, shown};
use denavit_symbolic::{Expr, Rational};
use std::collections::HashMap;

impl Reader {
    pub(in crate::description) fn tree(
        &mut self,
        robot: Element,
        name: String,
        links: Links,
        mut drafts: Vec<Draft>,
    ) -> Option<Mechanism> {
        let count = links.bodies.len();
        let label = |b: usize| shown(&links.bodies[b].name);
        let mut to: Vec<Option<usize>> = vec![None; count];
        for (k, draft) in drafts.iter().enumerate() {
            let child = draft.joint.child;
            if let Some(first) = to[child] {
                let names = [&drafts[first].joint.name, &draft.joint.name].map(|n| shown(n));
                self.out
                    .error(draft.span.clone(), format!("the link `{}` has two parents", label(child)))
                    .hint(format!(
                        "it is the child of `{}` and of `{}`: a loop is cut at a joint",
                        names[0], names[1]
                    ));
                self.out.note(drafts[first].span.clone(), format!("the first joint to `{}`", label(child)));
            } else {
                to[child] = Some(k);
            }
        }
        if self.out.has_errors() {
            return None; // what a link hangs on may be among what was not read
        }
        let roots: Vec<usize> = (0..count).filter(|&b| to[b].is_none()).collect();
        let mut root = match roots[..] {
            [root] => root,
            [] => {
                self.out.error(robot.span(), "every link is the child of a joint: the joints form a ring");
                return None;
            }
            _ => {
                let names: Vec<String> = roots.iter().take(6).map(|&b| label(b)).collect();
                let more = if roots.len() > 6 { ", …" } else { "" };
                self.out
                    .error(
                        links.spans[roots[1]].clone(),
                        format!("{} links hang on nothing: {}{more}", roots.len(), names.join(", ")),
                    )
                    .hint("a robot is one tree: all links but one are the child of a joint");
                return None;
            }
        };
        root = self.without_floating(root, &drafts, &links)?;
        // In depth, children in the order of the file.
        let mut on: Vec<Vec<usize>> = vec![vec![]; count];
        for (k, draft) in drafts.iter().enumerate() {
            on[draft.joint.parent].push(k);
        }
        let (mut order, mut open) = (vec![], on[root].iter().rev().copied().collect::<Vec<usize>>());
        while let Some(k) = open.pop() {
            order.push(k);
            open.extend(on[drafts[k].joint.child].iter().rev());
        }
        let left = count - 1 - order.len() - usize::from(roots[0] != root);
        if left > 0 {
            let mut reached = vec![false; count];
            reached[root] = true;
            order.iter().for_each(|&k| reached[drafts[k].joint.child] = true);
            let ring: Vec<usize> = (0..count).filter(|&b| !reached[b] && b != roots[0]).collect();
            let names: Vec<String> = ring.iter().take(6).map(|&b| label(b)).collect();
            let span = links.spans[ring[0]].clone();
            self.out
                .error(span, format!("joints form a ring: {}", names.join(", ")))
                .hint("a loop is cut at a joint");
            return None;
        }
        let follows = self.follows(&drafts, &order)?;
        let mut joints: Vec<Joint> = vec![];
        for (&k, follows) in order.iter().zip(follows) {
            let draft = &mut drafts[k];
            joints.push(Joint { follows, ..draft.joint.clone() });
        }
        // A floating root is left out, so that bodies are those of the tree.
        let mut mechanism = Mechanism { name, bodies: links.bodies, joints, root };
        if roots[0] != root {
            let gone = roots[0];
            mechanism.bodies.remove(gone);
            let moved = |b: &mut usize| *b -= usize::from(*b > gone);
            mechanism.joints.iter_mut().for_each(|j| {
                moved(&mut j.parent);
                moved(&mut j.child);
            });
            moved(&mut mechanism.root);
        }
        Some(mechanism)
    }

    /// The root behind a floating joint, which is left out; one elsewhere is an error.
    fn without_floating(&mut self, root: usize, drafts: &[Draft], links: &Links) -> Option<usize> {
        let on_root = drafts.iter().filter(|d| d.joint.parent == root).count();
        let mut found = root;
        for draft in drafts.iter().filter(|d| d.is_floating) {
            if draft.joint.parent == root && on_root == 1 {
                let name = shown(&links.bodies[draft.joint.child].name);
                self.out.note(draft.span.clone(), format!("the robot floats: `{name}` is taken as its base"));
                found = draft.joint.child;
            } else {
                self.out
                    .error(
                        draft.span.clone(),
                        format!(
                            "`{}` floats: six free directions inside the robot",
                            shown(&draft.joint.name)
                        ),
                    )
                    .hint("cut the file there: what floats is another robot");
            }
        }
        (!self.out.has_errors()).then_some(found)
    }

    /// What each joint follows, in the new order; those that follow one that follows another follow the last.
    fn follows(&mut self, drafts: &[Draft], order: &[usize]) -> Option<Vec<Option<Follows>>> {
        let by_name: HashMap<&str, usize> =
            drafts.iter().enumerate().map(|(k, d)| (d.joint.name.as_str(), k)).collect();
        let mut all = vec![];
        for &k in order {
            let mut at = k;
            let (mut factor, mut offset) = (Rational::ONE, Expr::int(0));
            let mut steps = 0;
            let found = loop {
                let Some((name, by, plus, span)) = &drafts[at].follows else { break (at != k).then_some(at) };
                steps += 1;
                if steps > drafts.len() {
                    let message = format!(
                        "`{}` follows itself: joints mimic each other in a ring",
                        shown(&drafts[k].joint.name)
                    );
                    self.out.error(span.clone(), message);
                    return None;
                }
                // q = factor·(by·q′ + plus) + offset
                let leader = by_name.get(name.as_str()).copied().filter(|&l| drafts[l].moves());
                let Some(leader) = leader else {
                    if at == k {
                        let message = format!(
                            "`{}` is no joint that moves; `{}` moves by itself",
                            shown(name),
                            shown(&drafts[k].joint.name)
                        );
                        let finding = self.out.warning(span.clone(), message);
                        let names = drafts.iter().filter(|d| d.moves()).map(|d| d.joint.name.as_str());
                        if let Some(near) = nearest(name, names) {
                            finding.hint(format!("did you mean `{near}`?"));
                        }
                    }
                    break (at != k).then_some(at);
                };
                offset = offset + Expr::from(factor.clone()) * *plus;
                factor = factor * by.clone();
                at = leader;
            };
            all.push(found.map(|leader| (leader, factor, offset)));
        }
        let place = |k: usize| order.iter().position(|&o| o == k);
        let follows = all.into_iter().map(|f| {
            let (leader, factor, offset) = f?;
            Some(Follows { joint: place(leader)?, factor, offset })
        });
        Some(follows.collect())
    }
}
