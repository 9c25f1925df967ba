//! Sets of angles: arcs of a circle.

use super::wrapped;
use std::f64::consts::{PI, TAU};

/// Disjoint closed arcs `[low, high]`, `low` in (−π, π] and `high` at most a turn further; the whole circle is
/// `[−π, π]`.
#[derive(Clone, PartialEq, Debug, Default)]
pub(super) struct Arcs(pub Vec<[f64; 2]>);

/// The whole circle.
pub(super) const CIRCLE: [f64; 2] = [-PI, PI];

impl Arcs {
    /// The arcs between neighbours of `cuts` (angles, in any order) whose middles are in the set; those that touch are
    /// joined. Without cuts, the circle or nothing.
    pub fn between(cuts: &mut Vec<f64>, mut contains: impl FnMut(f64) -> bool) -> Self {
        cuts.retain(|x| x.is_finite());
        for x in cuts.iter_mut() {
            *x = wrapped(*x);
        }
        cuts.sort_by(f64::total_cmp);
        cuts.dedup();
        let Some((&first, &last)) = cuts.first().zip(cuts.last()) else {
            return Arcs(if contains(0.0) { vec![CIRCLE] } else { vec![] });
        };
        let mut arcs: Vec<[f64; 2]> = vec![];
        let mut add = |low: f64, high: f64| {
            if !contains(wrapped((low + high) / 2.0)) {
                return;
            }
            match arcs.last_mut() {
                Some(arc) if arc[1] == low => arc[1] = high,
                _ => arcs.push([low, high]),
            }
        };
        for pair in cuts.windows(2) {
            add(pair[0], pair[1]);
        }
        add(last, first + TAU);
        // The last one goes round to the first cut.
        if arcs.len() == 1 && arcs[0] == [first, first + TAU] {
            return Arcs(vec![CIRCLE]);
        }
        if arcs.len() > 1
            && arcs[0][0] == first
            && let Some([low, high]) = arcs.pop()
        {
            if high == first + TAU {
                arcs[0] = [low, arcs[0][1] + TAU];
            } else {
                arcs.push([low, high]);
            }
        }
        for arc in &mut arcs {
            let turn = wrapped(arc[0]) - arc[0];
            *arc = [arc[0] + turn, arc[1] + turn];
        }
        arcs.sort_by(|a, b| a[0].total_cmp(&b[0]));
        Arcs(arcs)
    }

    /// What lies in an arc, with values as they count there.
    pub fn inside(&self, arc: [f64; 2]) -> Arcs {
        let mut found = self.intersection(&Arcs(vec![arc]));
        if arc != CIRCLE {
            for part in found.0.iter_mut().filter(|part| part[0] < arc[0]) {
                *part = [part[0] + TAU, part[1] + TAU];
            }
            found.0.sort_by(|a, b| a[0].total_cmp(&b[0]));
        }
        found
    }

    /// What is in both.
    pub(crate) fn intersection(&self, other: &Arcs) -> Arcs {
        if self.0.first() == Some(&CIRCLE) {
            return other.clone();
        }
        if other.0.first() == Some(&CIRCLE) {
            return self.clone();
        }
        let mut found = vec![];
        for a in &self.0 {
            for b in &other.0 {
                for turn in [-TAU, 0.0, TAU] {
                    let (low, high) = (a[0].max(b[0] + turn), a[1].min(b[1] + turn));
                    if low <= high {
                        let back = wrapped(low) - low;
                        found.push([low + back, high + back]);
                    }
                }
            }
        }
        found.sort_by(|a, b| a[0].total_cmp(&b[0]));
        Arcs(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_arc_across_the_seam_stays_one() {
        let set = |x: f64| x.abs() > 3.0;
        assert_eq!(Arcs::between(&mut vec![3.0, -3.0], set).0, [[3.0, TAU - 3.0]]);
        assert_eq!(Arcs::between(&mut vec![], |_| true).0, [CIRCLE]);
        assert_eq!(Arcs::between(&mut vec![1.0, 2.0], |_| true).0, [CIRCLE]);
        assert_eq!(Arcs::between(&mut vec![1.0, 2.0], |_| false).0, [[0.0; 2]; 0]);
    }

    #[test]
    fn two_long_arcs_meet_twice() {
        let (a, b) = (Arcs(vec![[0.0, 4.0]]), Arcs(vec![[3.0, 3.0 + 4.0]]));
        let both = a.intersection(&b).0;
        let wanted = [[0.0, 7.0 - TAU], [3.0, 4.0]];
        assert_eq!(both.len(), 2);
        for (x, y) in both.iter().zip(wanted) {
            assert!((x[0] - y[0]).abs() < 1e-15 && (x[1] - y[1]).abs() < 1e-15, "{both:?}");
        }
        assert_eq!(Arcs(vec![CIRCLE]).intersection(&a), a);
    }
}
