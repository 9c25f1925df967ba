//! A serial chain through a tree of rows.

use super::{BASE, NamedFrame, RowTree};
use crate::description::Unweighed;
use crate::description::diagnostic::nearest;
use crate::description::{Agreement, ClosedChain, Convention, Description, MAX_ROWS, NoChain, Row, Variable};
use crate::geometry::Transform;
use denavit_symbolic::{Angle, Expr, Symbol};

/// A chain through a tree of rows.
#[derive(Clone, Debug)]
pub struct RowChain {
    /// Its table.
    pub description: Description,
    /// The frame that it begins at.
    pub from: String,
    /// The frame that it ends at.
    pub to: String,
    /// How the table was found to be the chain; rows that stand as they are need no proof.
    pub agreement: Option<Agreement>,
    /// Joints beside the chain behind which something weighs that hangs on a link of it: they count as fixed at 0.
    pub held: Vec<String>,
    /// Why its rows have no masses, if rows of the tree weigh.
    pub unweighed: Option<Unweighed>,
    /// Frames with names that do not move on those of its table, where these are known.
    pub frames: Vec<NamedFrame>,
    /// The variable of the tree that each joint variable of the chain is.
    pub variables: Vec<Symbol>,
    /// What is known of it if it was taken out of a linkage.
    pub closed: Option<Box<ClosedChain>>,
}

/// A frame of a tree: its row, and its pose there.
type Place = (Option<usize>, Transform<Expr>);

impl RowTree {
    /// The chain between two frames: from the base, and to the tip of the tree, or else the frame with the most joints on the way,
    /// where none is named.
    ///
    /// Down the tree the rows stay as they are, with their names for lengths; every other way is made of axes, with the values of
    /// the parameters.
    ///
    /// # Errors
    /// If there is no such frame, several ends, nothing that moves, or a parameter that is needed has no value.
    pub fn chain(
        &self,
        from: Option<&str>,
        to: Option<&str>,
        convention: Convention,
    ) -> Result<RowChain, NoChain> {
        let from = from.map_or_else(|| BASE.into(), |name| self.named(name));
        let start = self.place(&from)?;
        let to = self.end_from(start.0, to)?;
        let end = self.place(&to)?;
        let way = self.way(end.0);
        let below = match start.0 {
            None => Some(&way[..]),
            Some(row) => way.iter().position(|&j| j == row).map(|at| &way[at + 1..]),
        };
        let base = if from == *BASE { self.base } else { start.1.inverse() };
        let straight = below.and_then(|rows| Some((rows, self.straight(rows, base, end)?)));
        if let Some((rows, (mut d, variables))) = straight {
            let (held, unweighed) = self.weigh_branches(rows, &mut d.rows);
            let held = held.into_iter().map(|j| self.frame_name(j)).collect();
            let description = d.converted(convention).description;
            if description.variables().is_empty() {
                return Err(NoChain::Rigid { from, to });
            }
            // In other conventions frames stand elsewhere.
            let frames = match convention {
                Convention::Khalil => self.frames_on(rows, start.0.is_none()),
                _ => vec![],
            };
            let (agreement, closed) = (None, None);
            return Ok(RowChain {
                description,
                from,
                to,
                agreement,
                held,
                unweighed,
                frames,
                variables,
                closed,
            });
        }
        let mechanism = self.mechanism().map_err(|missing| NoChain::NeedsValues(missing.parameters))?;
        let chain = mechanism.chain(Some(&from), Some(&to), convention)?;
        let held = chain.held.iter().map(|&j| mechanism.joints[j].name.clone()).collect();
        let frames = mechanism.frames(&chain);
        let unweighed = chain.unweighed;
        let variable = |&j: &usize| {
            let row = (0..self.rows.len()).find(|&row| self.frame_name(row) == mechanism.joints[j].name)?;
            Some(self.variables()[self.motions(&self.rows[row]).first()?.1])
        };
        let variables: Option<Vec<Symbol>> = chain.joints.iter().map(variable).collect();
        Ok(RowChain {
            variables: variables.unwrap_or_default(),
            closed: None,
            description: chain.description,
            from,
            to,
            agreement: Some(chain.agreement),
            held,
            unweighed,
            frames,
        })
    }

    /// What the frame is called at which the chain ends that begins at one: its name, or where it is not told the tip of the tree, or else
    /// the frame with the most joints on the way.
    pub fn end(&self, from: Option<&str>, to: Option<&str>) -> Result<String, NoChain> {
        let from = from.map_or_else(|| BASE.into(), |name| self.named(name));
        let to = self.end_from(self.place(&from)?.0, to)?;
        self.place(&to)?;
        Ok(to)
    }

    fn end_from(&self, start: Option<usize>, to: Option<&str>) -> Result<String, NoChain> {
        match to.or(self.tip.as_deref()) {
            Some(name) => Ok(self.named(name)),
            None => self.farthest(start),
        }
    }

    /// The row that a frame stands on, or is.
    pub fn row_of(&self, name: &str) -> Option<usize> {
        self.place(name).ok()?.0
    }

    /// The frames with names on the rows of a way, which is a table, and, if it begins there, on frame 0.
    fn frames_on(&self, way: &[usize], from_0: bool) -> Vec<NamedFrame> {
        let place = |f: &NamedFrame| match f.on {
            None => from_0.then(|| f.clone()),
            Some(row) => {
                let on = way.iter().position(|j| row == *j)?;
                Some(NamedFrame { on: Some(on), ..f.clone() })
            }
        };
        self.frames.iter().filter_map(place).collect()
    }

    /// What the frame is called that a word names: by its name, or a row by its number; 0 is the base.
    pub(crate) fn named(&self, word: &str) -> String {
        let is_name = self.frame_names().iter().any(|n| n == word);
        match word.parse::<usize>() {
            Ok(0) if !is_name => BASE.into(),
            Ok(n) if !is_name && n <= self.rows.len() => self.frame_name(n - 1),
            _ => word.into(),
        }
    }

    fn place(&self, name: &str) -> Result<Place, NoChain> {
        if let Some(frame) = self.frames.iter().find(|f| f.name == name) {
            return Ok((frame.on, frame.pose));
        }
        let row = (0..self.rows.len()).find(|&j| self.frame_name(j) == name);
        if row.is_some() || name == BASE {
            return Ok((row, Transform::identity()));
        }
        let names = self.frame_names();
        let near = nearest(name, names.iter().map(String::as_str)).map(str::to_string);
        Err(NoChain::Unknown { name: name.into(), near })
    }

    /// The rows from frame 0 to one.
    pub(in crate::description) fn way(&self, row: Option<usize>) -> Vec<usize> {
        let mut way = vec![];
        let mut next = row;
        while let Some(j) = next {
            way.push(j);
            next = self.after[j];
        }
        way.reverse();
        way
    }

    /// The frames on which nothing stands, and the rows that they stand on.
    fn leaves(&self) -> Vec<(Option<usize>, String)> {
        let is_leaf =
            |j: &usize| !self.after.contains(&Some(*j)) && self.frames.iter().all(|f| f.on != Some(*j));
        let rows = (0..self.rows.len()).filter(is_leaf).map(|j| (Some(j), self.frame_name(j)));
        rows.chain(self.frames.iter().map(|f| (f.on, f.name.clone()))).collect()
    }

    /// The names of the frames on which nothing stands.
    pub fn tips(&self) -> Vec<String> {
        self.leaves().into_iter().map(|leaf| leaf.1).collect()
    }

    /// The frame with the most joints on the way to it, of those on which nothing stands.
    fn farthest(&self, from: Option<usize>) -> Result<String, NoChain> {
        let count = |row: Option<usize>| {
            let way = self.way(row);
            let shared = from.map_or(vec![], |j| self.way(Some(j)));
            let common = way.iter().zip(&shared).take_while(|(a, b)| a == b).count();
            let rows = way[common..].iter().chain(&shared[common..]);
            rows.filter(|&&j| self.rows[j].variable.is_some()).count()
        };
        let leaves: Vec<(usize, String)> =
            self.leaves().into_iter().map(|(row, name)| (count(row), name)).collect();
        let most = leaves.iter().map(|l| l.0).max().unwrap_or(0);
        let tips: Vec<String> = leaves.into_iter().filter(|l| l.0 == most).map(|l| l.1).collect();
        match &tips[..] {
            [] => Err(NoChain::Rigid { from: BASE.into(), to: BASE.into() }),
            [tip] => Ok(tip.clone()),
            _ => Err(NoChain::Several(tips)),
        }
    }

    /// The rows of a way down the tree as a table, and the variables of the tree that its own are; nothing where a row would bring two variables with it.
    fn straight(
        &self,
        way: &[usize],
        base: Transform<Expr>,
        end: Place,
    ) -> Option<(Description, Vec<Symbol>)> {
        if way.len() > MAX_ROWS {
            return None;
        }
        let all = self.variables();
        // The variables that move the rows before, in the order in which they come.
        let mut known: Vec<Symbol> = vec![];
        let mut rows: Vec<Row> = vec![];
        for &j in way {
            let row = &self.rows[j];
            let symbols = [row.theta.symbols(), row.d.symbols()].concat();
            let new: Vec<Symbol> =
                symbols.into_iter().filter(|s| all.contains(s) && !known.contains(s)).collect();
            if new.len() > 1 {
                return None;
            }
            known.extend(&new);
            let renamed = |e: Expr| {
                let number = |s: Symbol| known.iter().position(|k| *k == s);
                let e = e.substitute(|s| number(s).map(|n| Expr::symbol(&format!("q{}", n + 1))));
                Angle::of(e).to_expr()
            };
            let mut row = Row { theta: renamed(row.theta), d: renamed(row.d), variable: None, ..row.clone() };
            if let Some(&symbol) = new.first() {
                let leader = self.rows.iter().find(|r| r.variable.is_some_and(|v| v.symbol == symbol))?;
                let kind = self.motions(&self.rows[j]).iter().find(|m| all[m.1] == symbol)?.0;
                row.variable = Some(Variable { symbol: Symbol::new(&format!("q{}", known.len())), kind });
                if leader.variable.is_some_and(|v| v.kind == kind) {
                    (row.limits, row.velocity) = (leader.limits, leader.velocity);
                }
            }
            rows.push(row);
        }
        let occurring: Vec<Symbol> = rows
            .iter()
            .flat_map(|r| [r.theta, r.d, r.a, r.alpha, r.gamma, r.b])
            .chain(base.matrix().concat())
            .chain(end.1.matrix().concat())
            .chain(self.gravity.into_iter().flatten())
            .chain(self.frames.iter().flat_map(|f| f.pose.matrix().concat()))
            // What hangs beside the way weighs as well.
            .chain(self.rows.iter().flat_map(|r| r.mass_cells().map(|cell| cell.1)))
            .flat_map(Expr::symbols)
            .collect();
        let number = |s: &Symbol| all.iter().position(|x| x == s);
        let pose = |(name, values): &(String, Vec<Expr>)| {
            let values = known.iter().map(|s| values.get(number(s)?).copied());
            Some((name.clone(), values.collect::<Option<Vec<Expr>>>()?))
        };
        let poses = self.poses.iter().filter_map(pose).collect();
        let description = Description {
            name: self.name.clone(),
            source: self.source.clone(),
            convention: Convention::Khalil,
            parameters: self.parameters.iter().filter(|p| occurring.contains(&p.symbol)).cloned().collect(),
            rows,
            base,
            tool: end.1,
            poses,
            gravity: self.gravity,
        };
        Some((description, known))
    }
}
