//! Links and joints as one tree.

use super::Links;
use super::joints::Draft;
use crate::description::diagnostic::nearest;
use crate::description::reader::Reader;
use crate::description::tree::{Follows, Joint, Mechanism};
use crate::description::xml::shown;
use denavit_symbolic::{Expr, Rational};
use std::collections::HashMap;

impl Reader {
    pub(in crate::description) fn tree(
        &mut self,
        name: String,
        links: Links,
        mut drafts: Vec<Draft>,
    ) -> Option<Mechanism> {
        let count = links.bodies.len();
        let to = self.parents(&links, &drafts);
        self.say_rings(&links, &drafts, &to);
        let roots: Vec<usize> = (0..count).filter(|&b| to[b].is_none()).collect();
        // What a link hangs on may be among what was not read.
        if roots.len() > 1 && !self.is_part {
            self.say_roots(&roots, &links);
        }
        let first = roots.first().copied().filter(|_| roots.len() == 1 && !self.is_part);
        let root = first.and_then(|first| self.without_floating(first, &drafts, &links));
        // In depth, children in the order of the file.
        let mut on: Vec<Vec<usize>> = vec![vec![]; count];
        for (k, draft) in drafts.iter().enumerate().filter(|(k, d)| to[d.joint.child] == Some(*k)) {
            on[draft.joint.parent].push(k);
        }
        let mut order = vec![];
        let mut open: Vec<usize> = root.iter().flat_map(|&r| on[r].iter().rev()).copied().collect();
        while let Some(k) = open.pop() {
            order.push(k);
            open.extend(on[drafts[k].joint.child].iter().rev());
        }
        if self.out.has_errors() {
            order = (0..drafts.len()).collect();
        }
        let follows = self.follows(&drafts, &order);
        let (Some(root), Some(follows), Some(first), false) = (root, follows, first, self.out.has_errors())
        else {
            return None;
        };
        let mut joints: Vec<Joint> = vec![];
        for (&k, follows) in order.iter().zip(follows) {
            let draft = &mut drafts[k];
            joints.push(Joint { follows, ..draft.joint.clone() });
        }
        // A floating root is left out, so that bodies are those of the tree.
        let mut mechanism = Mechanism {
            name,
            bodies: links.bodies,
            joints,
            root,
            poses: vec![],
            gravity: None,
            holds: vec![],
            driven: vec![],
        };
        if first != root {
            let gone = first;
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

    /// The joint to each link; a second one is reported.
    fn parents(&mut self, links: &Links, drafts: &[Draft]) -> Vec<Option<usize>> {
        let mut to: Vec<Option<usize>> = vec![None; links.bodies.len()];
        for (k, draft) in drafts.iter().enumerate() {
            let child = draft.joint.child;
            let Some(first) = to[child] else {
                to[child] = Some(k);
                continue;
            };
            // Which of them it hangs on decides what else hangs on nothing.
            self.is_part = true;
            let is_double = drafts[first].joint.name == draft.joint.name;
            if is_double || links.doubled.contains(&child) {
                continue; // what is doubled was said
            }
            let name = shown(&links.bodies[child].name);
            let names = [&drafts[first].joint.name, &draft.joint.name].map(|n| shown(n));
            self.out.error(draft.span.clone(), format!("the link `{name}` has two parents")).hint(format!(
                "it is the child of `{}` and of `{}`: a loop is cut at a joint",
                names[0], names[1]
            ));
            self.out.note(drafts[first].span.clone(), format!("the first joint to `{name}`"));
        }
        to
    }

    /// Links that hang on each other.
    fn say_rings(&mut self, links: &Links, drafts: &[Draft], to: &[Option<usize>]) {
        // By the link from which the way up was begun.
        let mut seen: Vec<Option<usize>> = vec![None; to.len()];
        for start in 0..to.len() {
            let mut at = start;
            while seen[at].is_none() {
                seen[at] = Some(start);
                let Some(joint) = to[at] else { break };
                at = drafts[joint].joint.parent;
            }
            let (Some(joint), true) = (to[at], seen[at] == Some(start)) else { continue };
            let mut ring = vec![at];
            let mut above = drafts[joint].joint.parent;
            while above != at {
                ring.push(above);
                let Some(joint) = to[above] else { break };
                above = drafts[joint].joint.parent;
            }
            ring.sort_unstable();
            let names: Vec<String> = ring.iter().take(6).map(|&b| shown(&links.bodies[b].name)).collect();
            let more = if ring.len() > 6 { ", …" } else { "" };
            self.out
                .error(
                    links.spans[ring[0]].clone(),
                    format!("joints form a ring: {}{more}", names.join(", ")),
                )
                .hint("a loop is cut at a joint");
        }
    }

    /// More links than one that hang on nothing.
    fn say_roots(&mut self, roots: &[usize], links: &Links) {
        let names: Vec<String> = roots.iter().take(6).map(|&b| shown(&links.bodies[b].name)).collect();
        let more = if roots.len() > 6 { ", …" } else { "" };
        self.out
            .error(
                links.spans[roots[1]].clone(),
                format!("{} links hang on nothing: {}{more}", roots.len(), names.join(", ")),
            )
            .hint("a robot is one tree: all links but one are the child of a joint");
    }

    /// The root behind a floating joint, which is left out; one elsewhere is an error.
    fn without_floating(&mut self, root: usize, drafts: &[Draft], links: &Links) -> Option<usize> {
        let mut is_one = true;
        let on_root = drafts.iter().filter(|d| d.joint.parent == root).count();
        let mut found = root;
        for draft in drafts.iter().filter(|d| d.is_floating) {
            if draft.joint.parent == root && on_root == 1 {
                let name = shown(&links.bodies[draft.joint.child].name);
                self.out.note(draft.span.clone(), format!("the robot floats: `{name}` is taken as its base"));
                found = draft.joint.child;
            } else {
                is_one = false;
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
        is_one.then_some(found)
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
                        let (leader, own) = (shown(name), shown(&drafts[k].joint.name));
                        let is_fixed = by_name.contains_key(name.as_str());
                        let what = if is_fixed { "does not move" } else { "is no joint" };
                        let message = format!("`{leader}` {what}; `{own}` moves by itself");
                        let finding = self.out.warning(span.clone(), message);
                        let others =
                            drafts.iter().filter(|d| d.moves() && d.joint.name != drafts[k].joint.name);
                        let near = nearest(name, others.map(|d| d.joint.name.as_str()));
                        // A name that is that of a joint was meant.
                        if let Some(near) = near.filter(|_| !is_fixed) {
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
