//! The closed loops of a `.par` file.

use super::RowTree;
use super::par::{Entry, Reader};
use crate::description::Row;
use crate::description::linkage::{Closure, Linkage, Side, is_passive};
use std::ops::Range;

/// A number of the head, and its place.
type Told = Option<(i64, Range<usize>)>;

impl<'t> Reader<'t> {
    /// How many links there are, if there are closed loops: NL, of NJ joints and NF frames.
    pub(super) fn loops(
        &mut self,
        entries: &[Entry<'t>],
        [links, joints, frames]: [&Told; 3],
    ) -> Option<usize> {
        let kind = self.number(entries, "Type");
        let (Some((links, _)), Some((joints, span))) = (links, joints) else {
            if let Some((2, span)) = kind {
                self.out
                    .error(span, "a mechanism with closed loops, without NL or NJ")
                    .hint("NL links, NJ joints with those that are cut, NF = NJ + (NJ - NL) frames");
            }
            return None;
        };
        if joints <= links {
            if let Some((2, span)) = kind {
                self.out
                    .error(
                        span,
                        format!("a mechanism with closed loops, of {joints} joints for {links} links"),
                    )
                    .hint("each loop has a joint that is cut: NJ is NL and the number of loops");
            }
            return None;
        }
        let wanted = joints.saturating_add(joints.saturating_sub(*links));
        match frames {
            Some((frames, _)) if *frames == wanted => usize::try_from(*links).ok(),
            Some((frames, span)) => {
                let message = format!("{joints} joints for {links} links need {wanted} frames, not {frames}");
                self.out.error(span.clone(), message).hint(
                    "behind the links stand the frames of the cut joints, then the frames on the other side of the cuts",
                );
                None
            }
            None => {
                let message = format!("closed loops: {joints} joints for {links} links, without NF");
                self.out.error(span.clone(), message).hint(format!("NF = {wanted}"));
                None
            }
        }
    }

    /// The linkage of all frames: the first are links, then cut joints, then other sides, as many.
    pub(super) fn linkage(&mut self, all: RowTree, links: usize, spans: &[Range<usize>]) -> Option<Linkage> {
        let loops = all.rows.len().checked_sub(links)? / 2;
        let (first_left, first_right) = (links, links + loops);
        let mut is_sound = true;
        let mut say = |reader: &mut Self, j: usize, message: String, hint: &str| {
            reader.out.error(spans[j].clone(), message).hint(hint);
            is_sound = false;
        };
        for (j, on) in all.after.iter().enumerate().skip(links) {
            let stands_well = on.is_none_or(|a| a < links || (j >= first_right && a >= first_right));
            if !stands_well {
                let message = format!("frame {} stands on the frame of a cut joint", j + 1);
                say(self, j, message, "the two frames of a cut stand on links");
            }
            let variable = all.rows[j].variable;
            if j < first_right && variable.is_some_and(|v| !is_passive(v.symbol)) {
                let message = format!("frame {} is that of a cut joint, and has a motor", j + 1);
                say(self, j, message, "cut a passive joint of the loop: mu = 0");
            }
            if j >= first_right && variable.is_some() {
                let message = format!("frame {} is the other side of a cut, and moves", j + 1);
                say(self, j, message, "sigma = 2: the variable stands in the frame of the cut joint");
            }
        }
        is_sound.then_some(())?;
        let mut tree =
            RowTree { rows: all.rows[..links].to_vec(), after: all.after[..links].to_vec(), ..all.clone() };
        // Other sides that carry further ones are rows of the tree.
        let mut place: Vec<Option<usize>> = vec![];
        let mut rights: Vec<Side> = vec![];
        for j in first_right..all.rows.len() {
            let on = all.after[j];
            let on = match on.and_then(|a| a.checked_sub(first_right)) {
                Some(right) => place[right],
                None => on,
            };
            if all.after.contains(&Some(j)) {
                tree.rows.push(all.rows[j].clone());
                tree.after.push(on);
                place.push(Some(tree.rows.len() - 1));
                rights.push(Side { after: place[j - first_right], row: Row::still() });
            } else {
                place.push(None);
                rights.push(Side { after: on, row: all.rows[j].clone() });
            }
        }
        let closure = |(k, right): (usize, Side)| {
            let j = first_left + k;
            let left = Side { after: all.after[j], row: all.rows[j].clone() };
            Closure { name: None, left, right, span: spans[j].clone() }
        };
        let closures = rights.into_iter().enumerate().map(closure).collect();
        Some(Linkage { tree, closures, modes: vec![], poses: vec![] })
    }
}
