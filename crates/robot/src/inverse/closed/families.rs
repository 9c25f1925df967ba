//! Families: solutions in which the arm can move with its hand still.
//!
//! Where an equation leaves its unknown free, the unknown is given values all round; what solves the pose then, on one
//! branch and for neighbouring values, is a family, or a single solution if its neighbours are none.

use super::solve::{InverseSolver, LOOSE, NEAR, ROUGH, SHORT, Solving, draft, variables};
use crate::geometry::Transform;
use crate::inverse::answer::{Answer, Doubt, Family, Solution};
use crate::space::{norm, wrapped};
use denavit_program::solver::Leaf;
use std::f64::consts::{PI, TAU};

/// A leaf with values for free unknowns.
struct Member {
    solution: Solution,
    signs: Vec<i8>,
    free: u64,
    number: usize,
}

/// How many values each of some free unknowns is given: multiples of 5° for one, of 15° for two, of 30° for more.
pub(super) fn round(unknowns: usize) -> usize {
    match unknowns {
        0 | 1 => 72,
        2 => 24,
        _ => 12,
    }
}

/// Stretches of a free unknown that are nearer to each other are one (radians, and lengths by the reach).
const BETWEEN: f64 = 1e-4;
/// How much smaller steps may become.
const FINEST: usize = 100;

impl InverseSolver {
    /// The members of a family with its free unknown (radians or metres) at a value; the first, if it has several.
    pub fn members(
        &self,
        pose: &Transform<f64>,
        given: &[f64],
        family: &Family,
        value: f64,
    ) -> Vec<Solution> {
        let mut at = family.at.clone();
        if let Some((i, x)) = at.first_mut() {
            *x = if self.nodes[*i].is_angle { [value.cos(), value.sin()] } else { [value, 0.0] };
        }
        let (pose, mut solving) = self.at(pose);
        let mut members = solving.with_free(&pose, given, &at, &family.signs);
        members.retain(|s| self.is_on_stretch(family, &s.q));
        members
    }

    /// The members of a family with its free unknowns as they are at a configuration: those among them show whether the
    /// configuration belongs to the family.
    pub fn members_at(
        &self,
        pose: &Transform<f64>,
        given: &[f64],
        family: &Family,
        q: &[f64],
    ) -> Vec<Solution> {
        let (pose, mut solving) = self.at(pose);
        solving.members_at(&pose, given, family, q)
    }

    /// True if a family may have members with its free unknown as it is at a configuration: the same branches may have
    /// further families on other stretches of it.
    fn is_on_stretch(&self, family: &Family, q: &[f64]) -> bool {
        let (&[(i, _)], Some([low, high])) = (&family.at[..], family.stretch) else { return true };
        let x = self.value_at(i, q);
        if self.nodes[i].is_angle {
            let from_low = (x[1].atan2(x[0]) - low).rem_euclid(TAU);
            from_low <= high - low + BETWEEN || from_low >= TAU - BETWEEN
        } else {
            // What was sampled ends there, not the family.
            let reach = self.space.reach;
            let slack = BETWEEN * reach;
            (low <= -reach || x[0] >= low - slack) && (high >= reach || x[0] <= high + slack)
        }
    }
}

impl Solving<'_> {
    fn members_at(
        &mut self,
        pose: &Transform<f64>,
        given: &[f64],
        family: &Family,
        q: &[f64],
    ) -> Vec<Solution> {
        if !self.is_on_stretch(family, q) {
            return vec![];
        }
        // Within the family further unknowns may be free at single places.
        let at: Vec<(usize, [f64; 2])> = (0..self.nodes.len()).map(|i| (i, self.value_at(i, q))).collect();
        self.with_free(pose, given, &at, &family.signs)
    }

    fn with_free(
        &mut self,
        pose: &Transform<f64>,
        given: &[f64],
        at: &[(usize, [f64; 2])],
        signs: &[i8],
    ) -> Vec<Solution> {
        let solver = self.solver;
        let variables = variables(self.goal, pose, given);
        let mut free = vec![None; self.nodes.len()];
        for &(i, x) in at {
            free[i] = Some(x);
        }
        let leaves = self.memory.scalar.solve_loosely(&variables, &free, LOOSE);
        // Where two roots coincide there is one sign for both.
        let branch: Vec<Leaf> = leaves.iter().filter(|l| l.signs == signs).collect();
        let all = || leaves.iter().filter(|l| l.free != 0 || l.guard < NEAR).collect();
        let kept: Vec<Leaf> = if branch.is_empty() { all() } else { branch };
        let found: Vec<Solution> = kept.iter().map(|l| draft(&solver.nodes, l)).collect();
        found.into_iter().filter_map(|s| self.member(pose, s)).collect()
    }

    /// A leaf as a member of a family, if it is one.
    fn member(&self, pose: &Transform<f64>, mut s: Solution) -> Option<Solution> {
        let start = s.q.clone();
        let holds = self.improve_within(pose, &mut s, SHORT);
        let far = self.space.distance(&start, &s.q);
        (holds && far <= SHORT).then_some(s)
    }

    /// Drops isolated solutions that are members of a family.
    pub(super) fn absorb(&mut self, pose: &Transform<f64>, given: &[f64], answer: &mut Answer) {
        let solutions = std::mem::take(&mut answer.solutions);
        let families = answer.families.clone();
        for s in solutions {
            let is_member = s.guard < NEAR && self.is_in_a_family(pose, given, &families, &s.q);
            if !is_member {
                answer.solutions.push(s);
            }
        }
    }

    /// Gives free unknowns values all round, and gathers what solves the pose.
    pub(super) fn families(&mut self, pose: &Transform<f64>, given: &[f64], met: u64, answer: &mut Answer) {
        let solver = self.solver;
        let variables = variables(self.goal, pose, given);
        let mut free: Vec<usize> = (0..self.nodes.len()).filter(|i| met >> i & 1 == 1).collect();
        let mut members: Vec<Member> = vec![];
        // Other unknowns may turn out to be free on the way; then all are varied. Where none of one unknown's values
        // leads anywhere, the right ones may be few: it is varied in smaller steps.
        let mut finer = 1;
        for _ in 0..5 {
            let steps = round(free.len()) * finer;
            members.clear();
            let mut more = met;
            let count = steps.pow(free.len().min(3) as u32);
            for number in 0..count {
                let at = self.values(&free, steps, number);
                let leaves = self.memory.scalar.solve_loosely(&variables, &at, LOOSE);
                more |= leaves.met_free();
                for leaf in leaves.iter().filter(|l| l.free != 0) {
                    members.push(Member {
                        solution: draft(&solver.nodes, &leaf),
                        signs: leaf.signs.to_vec(),
                        free: leaf.free,
                        number,
                    });
                }
            }
            let known = free.len();
            free = (0..self.nodes.len()).filter(|i| more >> i & 1 == 1).collect();
            if free.len() == known {
                if known == 1 && members.is_empty() && finer < FINEST {
                    finer *= 10;
                    continue;
                }
                self.group(pose, given, &free, steps, members, answer);
                return;
            }
        }
        answer.doubt = Some(Doubt::Sampled);
    }

    /// The values of free unknowns in sample `number`.
    pub(super) fn values(&self, free: &[usize], steps: usize, number: usize) -> Vec<Option<[f64; 2]>> {
        let mut at = vec![None; self.nodes.len()];
        let mut rest = number;
        for &i in free.iter().take(3) {
            let k = rest % steps;
            rest /= steps;
            let turn = k as f64 / steps as f64;
            at[i] = Some(if self.nodes[i].is_angle {
                quarter_exact(k, steps)
            } else {
                [(2.0 * turn - 1.0) * self.space.reach, 0.0]
            });
        }
        at
    }

    /// Members that belong together: the same branches, neighbouring values.
    fn group(
        &mut self,
        pose: &Transform<f64>,
        given: &[f64],
        free: &[usize],
        steps: usize,
        members: Vec<Member>,
        answer: &mut Answer,
    ) {
        let mut groups: Vec<Vec<Member>> = vec![];
        for m in members {
            let same = |g: &&mut Vec<Member>| {
                let last = &g[g.len() - 1];
                last.signs == m.signs
                    && last.free == m.free
                    && (free.len() > 1 || m.number - last.number <= 1)
            };
            match groups.iter_mut().find(same) {
                Some(g) => g.push(m),
                None => groups.push(vec![m]),
            }
        }
        // All round, the last values are next to the first ones.
        if free.len() == 1 && self.nodes[free[0]].is_angle {
            let mut k = 0;
            while k < groups.len() {
                let starts = groups[k][0].number == 0;
                let end = (0..groups.len()).find(|&j| {
                    j != k
                        && groups[j][0].signs == groups[k][0].signs
                        && groups[j][0].free == groups[k][0].free
                        && groups[j].last().is_some_and(|m| m.number + 1 == steps)
                });
                if let (true, Some(j)) = (starts, end) {
                    let mut joined = std::mem::take(&mut groups[j]);
                    joined.append(&mut groups[k]);
                    groups[k] = joined;
                    groups.remove(j);
                    k = 0;
                    continue;
                }
                k += 1;
            }
        }
        // The largest first: a group of one is often a place where two branches of a larger one meet.
        groups.sort_by_key(|g| std::cmp::Reverse(g.len()));
        for group in groups {
            // The representative: a proper solution, of the value nearest to 0.
            let slides = !self.nodes[free[0]].is_angle;
            let away = |m: &Member| {
                let k = m.number % steps;
                if slides { k.abs_diff(steps / 2) } else { k.min(steps - k) }
            };
            let mut sorted: Vec<usize> = (0..group.len()).collect();
            sorted.sort_by_key(|&k| (away(&group[k]), group[k].number));
            let best =
                sorted.iter().find_map(|&k| self.member(pose, group[k].solution.clone()).map(|s| (k, s)));
            let Some((k, representative)) = best else { continue };
            let (mask, signs) = (group[k].free, group[k].signs.clone());
            let values = self.values(free, steps, group[k].number);
            let at: Vec<(usize, [f64; 2])> = (0..self.nodes.len())
                .filter(|i| mask >> i & 1 == 1)
                .filter_map(|i| Some((i, values[i]?)))
                .collect();
            let q = representative.q.clone();
            // Two branches may meet at single places: the whole group must be known already to be dropped.
            let places = [k, 0, group.len() / 3, group.len() / 2, group.len() - 1];
            if places.iter().all(|&p| {
                let Some(s) = self.member(pose, group[p].solution.clone()) else { return true };
                self.is_in_a_family(pose, given, &answer.families, &s.q)
            }) {
                continue;
            }
            // Of the unknowns that are free, those that can move while the others stay.
            let moving: Vec<(usize, Vec<f64>)> = at
                .iter()
                .filter_map(|&(i, _)| Some((i, self.tangent(pose, given, i, (&at, &signs), &q)?)))
                .collect();
            let Some((first, direction)) = moving.first().cloned() else {
                // Near a singularity a wrong value passes too, by the tolerance; the branch itself gave the right one.
                if representative.residual <= ROUGH {
                    self.add(&mut answer.solutions, representative);
                }
                continue;
            };
            let at: Vec<(usize, [f64; 2])> =
                at.into_iter().filter(|a| moving.iter().any(|m| m.0 == a.0)).collect();
            let far = group[(k + group.len().min(steps / 2) / 3) % group.len()].solution.q.clone();
            let mut direction = direction;
            let is_affine = at.len() == 1
                && self
                    .tangent(pose, given, first, (&at, &signs), &far)
                    .is_some_and(|d| parallel(&d, &direction));
            if is_affine {
                // Far along, rounding weighs less.
                let by = norm(&self.space.way(&q, &far));
                if by > 0.1 {
                    let by = norm(&self.space.moved(&q, &far));
                    let sign = if along(&self.space.moved(&q, &far), &direction) < 0.0 { -1.0 } else { 1.0 };
                    direction = self.space.moved(&q, &far).iter().map(|d| sign * d / by).collect();
                }
                let parts = direction.iter_mut().enumerate();
                parts.filter(|(j, d)| d.abs() < 1e-6 * self.space.unit(*j)).for_each(|(_, d)| *d = 0.0);
                let length = norm(&direction);
                direction.iter_mut().for_each(|d| *d /= length);
            }
            let unknowns = at.iter().map(|&(i, _)| self.nodes[i].unknown.clone()).collect();
            let interval = (free.len() == 1).then(|| self.interval(pose, given, (free[0], steps), &group));
            let family = Family::new(representative, unknowns, direction);
            answer.families.push(Family { is_affine, interval, at, signs, stretch: interval, ..family });
        }
    }

    /// How the joints move with one of the free unknowns at a solution, a unit vector; nothing if they cannot.
    fn tangent(
        &mut self,
        pose: &Transform<f64>,
        given: &[f64],
        node: usize,
        (at, signs): (&[(usize, [f64; 2])], &[i8]),
        q: &[f64],
    ) -> Option<Vec<f64>> {
        const STEP: f64 = 1e-3;
        let at: Vec<(usize, [f64; 2])> = at.iter().map(|&(i, _)| (i, self.value_at(i, q))).collect();
        let number = at.iter().position(|a| a.0 == node)?;
        for step in [STEP, -STEP] {
            let mut moved = at.clone();
            let [x, y] = moved[number].1;
            moved[number].1 = if self.nodes[node].is_angle {
                let (s, c) = step.sin_cos();
                [x * c - y * s, y * c + x * s]
            } else {
                [x + step * self.space.reach, 0.0]
            };
            // The neighbour on the same branch is the nearest one.
            let members = self.with_free(pose, given, &moved, signs);
            let distance = |s: &Solution| norm(&self.space.way(q, &s.q));
            let nearest = members.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
            if let Some(n) = nearest
                && distance(n) < 100.0 * STEP
            {
                let moved = self.space.moved(q, &n.q);
                let length = norm(&moved) * step.signum();
                return Some(moved.iter().map(|d| d / length).collect());
            }
        }
        None
    }

    pub(super) fn is_in_a_family(
        &mut self,
        pose: &Transform<f64>,
        given: &[f64],
        families: &[Family],
        q: &[f64],
    ) -> bool {
        families.iter().any(|f| {
            let members = self.members_at(pose, given, f, q);
            members.iter().any(|m| self.space.distance(q, &m.q) <= SHORT)
        })
    }

    /// Between which values the free unknown of a group may move, the ends found by bisection: a length, or an angle from
    /// (−π, π] to at most a turn further.
    fn interval(
        &mut self,
        pose: &Transform<f64>,
        given: &[f64],
        (node, steps): (usize, usize),
        group: &[Member],
    ) -> [f64; 2] {
        let is_angle = self.nodes[node].is_angle;
        if group.len() == steps && is_angle {
            return [-PI, PI];
        }
        let width = if is_angle { TAU } else { 2.0 * self.space.reach };
        let step = width / steps as f64;
        let first = group[0].number as f64 * step - if is_angle { 0.0 } else { self.space.reach };
        let last = first + (group.len() - 1) as f64 * step;
        let solver = self.solver;
        let variables = variables(self.goal, pose, given);
        let mut holds = |x: f64| {
            let mut at = vec![None; self.nodes.len()];
            at[node] = Some(if is_angle { [x.cos(), x.sin()] } else { [x, 0.0] });
            let leaves = self.memory.scalar.solve_loosely(&variables, &at, LOOSE);
            let branch = leaves.iter().find(|l| l.signs == group[0].signs);
            let found = branch.map(|l| draft(&solver.nodes, &l));
            found.is_some_and(|s| self.member(pose, s).is_some())
        };
        let mut end = |inside: f64, outside: f64| {
            let (mut inside, mut outside) = (inside, outside);
            for _ in 0..40 {
                let middle = (inside + outside) / 2.0;
                if holds(middle) { inside = middle } else { outside = middle }
            }
            inside
        };
        let (low, high) = (end(first, first - step), end(last, last + step));
        if is_angle { [wrapped(low), wrapped(low) + (high - low).min(TAU)] } else { [low, high] }
    }
}

/// Cosine and sine of k/steps of a turn, exact at quarter turns.
fn quarter_exact(k: usize, steps: usize) -> [f64; 2] {
    if (4 * k).is_multiple_of(steps) {
        return [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]][4 * k / steps % 4];
    }
    let (s, c) = (k as f64 / steps as f64 * TAU).sin_cos();
    [c, s]
}

fn along(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// True if two unit vectors are parallel, but for the error of a difference over a short step.
fn parallel(a: &[f64], b: &[f64]) -> bool {
    (along(a, b).abs() - 1.0).abs() <= 1e-6
}
