//! Determinants of Jacobians: of a printed one, of rows or joints that words name, or of the one that the arm has by nature.

use super::{Assertion, Piece, Walk};
use crate::facts::{About, Meaning};
use crate::matrix::Matrix;
use crate::names::Name;
use denavit::forward::Reference;
use denavit_symbolic::Expr;
use denavit_symbolic::vocabulary::plain_name;
use std::ops::Range;

impl Walk<'_> {
    /// The determinant that a name says: `\det J_v`, `|J|`.
    pub(super) fn determinant(&self, span: &Range<usize>) -> Option<Expr> {
        let source = self.source(span);
        let bare = ["\\operatorname{det}", "\\mathrm{det}", "\\det", "\\left", "\\right", "det", "DET"]
            .iter()
            .fold(source.to_string(), |s, w| s.replace(w, " "));
        if bare == source && !(source.starts_with('|') && source.ends_with('|') && source.len() > 2) {
            return None;
        }
        if let Some(columns) = columns_of(&bare) {
            return self.minor(&columns);
        }
        let inner = bare.replace(['|', '(', ')'], " ");
        // `det(3J)`: the axes along which it is written do not matter.
        let inner = inner.trim();
        let inner = inner
            .strip_suffix('J')
            .filter(|s| s.len() == 1 && s.starts_with(|c: char| c.is_ascii_digit()))
            .map_or(inner, |_| "J");
        // `det = …`: that of the matrix that stands before, if it is a Jacobian.
        let inner = if inner.is_empty() && self.is_last_a_jacobian() { "J" } else { inner };
        // `\det J(\Theta)`
        let whole = bare.trim();
        let with_arguments =
            self.lexis.lone_name(whole, &(0..whole.len())).filter(|n| !n.arguments.is_empty());
        let by_letters = || self.lexis.lone_name(inner, &(0..inner.len()));
        let name = with_arguments.or_else(by_letters)?;
        let name = Name { arguments: vec![], ..name };
        let told = crate::jacobians::told_of_jacobian(&name)?;
        // The blocks of an arm with a wrist: of the position, and of the orientation.
        if name.base == "J" && self.lexis.defined(&name).is_none() {
            match name.sub.as_str() {
                "11" => return self.determinant_of_wrist(false),
                "22" => return self.determinant_of_wrist(true),
                "12" | "21" => return None,
                _ => {}
            }
        }
        // Rows that vanish are left out.
        let moves = |row: &&Vec<Option<Expr>>| row.iter().any(|e| e.is_none_or(|e| !e.is_zero()));
        let printed = self.lexis.defined(&name).map(|m| Matrix(m.0.iter().filter(moves).cloned().collect()));
        let is_square = |m: &Matrix| m.shape().is_some_and(|(r, c)| r == c);
        if let (Some(whole), Some(false)) = (self.lexis.defined(&name), printed.as_ref().map(is_square)) {
            // A part of the one that the arm has by nature may be printed.
            let minor = self.told_minor(whole).filter(is_square);
            return minor.map_or_else(|| self.subject.determinant(told.part), |m| m.determinant());
        }
        // Numbers are what the author makes of it, and may be wrong, unless they are the arm's.
        let is_formula = |m: &Matrix| m.0.iter().flatten().flatten().any(|e| !e.symbols().is_empty());
        let is_known = |m: &Matrix| is_formula(m) || self.is_right(&name);
        let (printed, is_numeric) = match printed {
            Some(m) if !is_known(&m) => (None, true),
            printed => (printed, false),
        };
        // Of a block in numbers: that of its columns.
        let block = self.lexis.defined(&name).and_then(Matrix::shape).filter(|_| is_numeric);
        if let Some((_, columns)) = block.filter(|s| s.0 == s.1 && s.1 < self.subject.joints().len()) {
            return self.minor(&(1..=columns).collect::<Vec<usize>>());
        }
        if is_numeric && self.subject.square_jacobian(crate::jacobians::Part::Any).is_none() {
            return None;
        }
        // That of a matrix which is printed and could not be read is not the one that the arm has by nature.
        let is_open = printed.is_none() && !is_numeric && self.is_printed(&name, span.start);
        let by_nature = || if is_open { None } else { self.subject.determinant(told.part) };
        printed.and_then(|m| m.determinant()).or_else(by_nature)
    }

    /// True if the Jacobian of this name that was printed last is the arm's, entry by entry.
    fn is_right(&self, name: &Name) -> bool {
        let is_it = |a: &&Assertion| {
            matches!(&a.about, About::Matrix(Meaning::Jacobian(_)))
                && self.lexis.lone_name(&a.name, &(0..a.name.len())).is_some_and(|n| n.key() == name.key())
        };
        let same = |a: Expr, b: Expr| denavit_symbolic::equal(a, b).is_equal();
        let holds = |p: &Piece| match p {
            Piece::Pair(pair) => same(pair.value, pair.wanted),
            Piece::Number { answer, .. } => answer.constant.is_some_and(|c| same(c, answer.wanted)),
            Piece::Unreadable { .. } => false,
        };
        let last = self.assertions.iter().rev().find(is_it);
        last.is_some_and(|a| !a.pieces.is_empty() && a.pieces.iter().all(holds))
    }

    /// True if no other matrix than a Jacobian was printed last.
    fn is_last_a_jacobian(&self) -> bool {
        let matrices = self.assertions.iter().rev().filter_map(|a| match &a.about {
            About::Matrix(meaning) => Some(meaning),
            _ => None,
        });
        matrices.into_iter().next().is_none_or(|m| matches!(m, Meaning::Jacobian(_)))
    }

    /// That of the first three joints and the point in which the last three axes meet, the upper left block `J_{11}`; or of the last
    /// three joints and the rotation of the hand, the lower right one `J_{22}`.
    fn determinant_of_wrist(&self, is_of_rotation: bool) -> Option<Expr> {
        let origin = |k: usize| Some(self.subject.transform(Some(0), Some(k))?.translation);
        let (four, five) = (origin(4)?, origin(5)?);
        let meet = four.0.iter().zip(&five.0).all(|(a, b)| denavit_symbolic::equal(*a, *b).is_equal());
        if self.subject.joints().len() != 6 || !meet {
            return None;
        }
        let (body, part) = match is_of_rotation {
            false => (Reference::Frame(4), 0..3),
            true => (Reference::Tool, 3..6),
        };
        let rows = self.subject.geometric_rows(body, Reference::Frame(0));
        let block = rows[part.clone()].iter().map(|row| row[part.clone()].iter().map(|e| Some(*e)).collect());
        let block = Matrix(block.collect());
        (block.shape() == Some((3, 3))).then(|| block.determinant())?
    }

    /// True if a line before a place begins with a name and gives it a matrix.
    pub(super) fn is_printed(&self, name: &Name, at: usize) -> bool {
        self.text.get(..at).unwrap_or_default().lines().any(|line| {
            let line = line.trim_start_matches([' ', '\t', '$', '-', '*', '&']);
            let sides = line.strip_prefix(name.base.as_str()).and_then(|rest| rest.split_once('='));
            sides.is_some_and(|(left, right)| {
                // `J_v` is another name, `J(q)` is not.
                let index = left.split('(').next().unwrap_or_default().trim_end_matches([' ', '&']);
                let goes_on = crate::custom::plain(index) != name.sub;
                !goes_on && (right.contains("matrix") || right.trim_start().starts_with(['[', '|', '(']))
            })
        })
    }

    /// The determinant of columns of the Jacobian of which the document speaks, or of the one that the arm has by nature.
    fn minor(&self, columns: &[usize]) -> Option<Expr> {
        let bare = Name { base: "J".into(), ..Name::default() };
        let printed = self.lexis.defined(&bare).cloned();
        let moves = |m: Matrix| {
            let rows: Vec<_> =
                m.0.into_iter().filter(|r| r.iter().any(|e| e.is_none_or(|e| !e.is_zero()))).collect();
            Matrix(rows)
        };
        let by_nature = || {
            let rows = self.subject.geometric_rows(Reference::Tool, Reference::Frame(0));
            let is_moved =
                |r: &&Vec<Expr>| columns.iter().any(|k| r.get(k - 1).is_some_and(|e| !e.is_zero()));
            Matrix(rows[..3].iter().filter(is_moved).map(|r| r.iter().map(|e| Some(*e)).collect()).collect())
        };
        let fits = |m: &Matrix| {
            m.shape().is_some_and(|(r, c)| r == columns.len() && columns.iter().all(|k| *k <= c))
        };
        let is_formula = |m: &Matrix| m.0.iter().flatten().flatten().any(|e| !e.symbols().is_empty());
        let printed = printed.filter(is_formula).map(moves).filter(fits);
        let whole = printed.or_else(|| Some(moves(by_nature())).filter(fits))?;
        let picked = |row: &Vec<Option<Expr>>| columns.iter().map(|k| row[k - 1]).collect();
        Matrix(whole.0.iter().map(picked).collect()).determinant()
    }

    /// The rows or columns of a full Jacobian that the words before name: `rows vx, vy, wz`, `joints 1, 2 and 3`.
    pub(super) fn told_minor(&self, whole: &Matrix) -> Option<Matrix> {
        const ROWS: [[&str; 2]; 6] =
            [["vx", "vx"], ["vy", "vy"], ["vz", "vz"], ["wx", "ωx"], ["wy", "ωy"], ["wz", "ωz"]];
        // French has a blank that does not break before a colon.
        let is_apart = |c: char| c.is_whitespace() || matches!(c, ',' | ':' | ';' | '$' | '~');
        let words: Vec<String> = self.source(&self.last_prose).split(is_apart).map(plain_name).collect();
        let (rows, columns) = whole.shape()?;
        let is_row =
            |r: &usize| ROWS.get(*r).is_some_and(|names| words.iter().any(|w| names.contains(&&**w)));
        let told: Vec<usize> = (0..rows).filter(is_row).collect();
        let numbers: Vec<usize> = words.iter().filter_map(|w| w.parse().ok()).collect();
        let is_told = |c: &usize| told.is_empty() && numbers.contains(&(c + 1));
        let joints: Vec<usize> = (0..columns).filter(is_told).collect();
        let moves = |r: &usize| whole.0[*r].iter().any(|e| e.is_none_or(|e| !e.is_zero()));
        let rows: Vec<usize> = if told.is_empty() { (0..rows).filter(moves).collect() } else { told };
        let columns = if joints.is_empty() { (0..columns).collect() } else { joints };
        Some(Matrix(rows.iter().map(|&r| columns.iter().map(|&c| whole.entry(r, c)).collect()).collect()))
    }
}

/// The columns that `[J_1 J_2]` or `J_{123}` names, from 1 on.
fn columns_of(source: &str) -> Option<Vec<usize>> {
    let plain: String = plain_name(&source.replace(['[', ']', '|', '(', ')', ',', ';', '&', '~'], " "))
        .chars()
        .filter(|c| !c.is_whitespace() && *c != '\\')
        .collect();
    let digits =
        |s: &str| -> Vec<usize> { s.chars().filter_map(|c| c.to_digit(10)).map(|d| d as usize).collect() };
    let parts: Vec<&str> = plain.strip_prefix('J')?.split('J').collect();
    let is_number = |p: &&str| !p.is_empty() && p.chars().all(|c| c.is_ascii_digit());
    if !parts.iter().all(is_number) {
        return None;
    }
    let columns = match &parts[..] {
        [one] if one.len() >= 2 => digits(one),
        [_] => return None,
        several => several.iter().map(|p| p.parse().ok()).collect::<Option<Vec<usize>>>()?,
    };
    let is_ascending = columns.is_sorted_by(|a, b| a < b) && columns[0] > 0;
    is_ascending.then_some(columns)
}

#[cfg(test)]
mod tests {
    use super::columns_of;

    #[test]
    fn columns_by_their_numbers() {
        for (source, columns) in [
            (" [J_1\\;J_2]", Some(vec![1, 2])),
            (" J_{123}", Some(vec![1, 2, 3])),
            ("J123", Some(vec![1, 2, 3])),
            ("J_1", None),
            ("J_v", None),
            ("J_{21}", None),
        ] {
            assert_eq!(columns_of(source), columns, "{source}");
        }
    }
}
