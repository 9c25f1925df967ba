//! Determinants of Jacobians: of a printed one, of rows or joints that words name, or of the one that the arm has by nature.

use super::Walk;
use crate::matrix::Matrix;
use denavit_symbolic::Expr;
use denavit_symbolic::vocabulary::plain_name;
use std::ops::Range;

impl Walk<'_> {
    /// The determinant that a name says: `\det J_v`, `|J|`.
    pub(super) fn determinant(&self, span: &Range<usize>) -> Option<Expr> {
        let source = self.source(span);
        let bare = ["\\operatorname{det}", "\\mathrm{det}", "\\det", "\\left", "\\right", "det"]
            .iter()
            .fold(source.to_string(), |s, w| s.replace(w, " "));
        if bare == source && !(source.starts_with('|') && source.ends_with('|') && source.len() > 2) {
            return None;
        }
        let inner = bare.replace(['|', '(', ')'], " ");
        let inner = inner.trim();
        let name = self.lexis.lone_name(inner, &(0..inner.len()))?;
        let told = crate::jacobians::told_of_jacobian(&name)?;
        // Rows that vanish are left out.
        let moves = |row: &&Vec<Option<Expr>>| row.iter().any(|e| e.is_none_or(|e| !e.is_zero()));
        let printed = self.lexis.defined(&name).map(|m| Matrix(m.0.iter().filter(moves).cloned().collect()));
        let is_square = |m: &Matrix| m.shape().is_some_and(|(r, c)| r == c);
        if let (Some(whole), Some(false)) = (self.lexis.defined(&name), printed.as_ref().map(is_square)) {
            return self.told_minor(whole).filter(is_square)?.determinant();
        }
        // Numbers are what the author makes of it, and may be wrong.
        let is_known = |m: &Matrix| m.0.iter().flatten().flatten().any(|e| !e.symbols().is_empty());
        let (printed, is_numeric) = match printed {
            Some(m) if !is_known(&m) => (None, true),
            printed => (printed, false),
        };
        if is_numeric && self.subject.square_jacobian(crate::jacobians::Part::Any).is_none() {
            return None;
        }
        // That of a matrix which is printed and could not be read is not the one that the arm has by nature.
        let is_open = printed.is_none() && !is_numeric && self.is_printed(&name, span.start);
        let by_nature = || if is_open { None } else { self.subject.determinant(told.part) };
        printed.and_then(|m| m.determinant()).or_else(by_nature)
    }

    /// The rows or columns of a full Jacobian that the words before name: `rows vx, vy, wz`, `joints 1, 2 and 3`.
    pub(super) fn told_minor(&self, whole: &Matrix) -> Option<Matrix> {
        const ROWS: [[&str; 2]; 6] =
            [["vx", "vx"], ["vy", "vy"], ["vz", "vz"], ["wx", "ωx"], ["wy", "ωy"], ["wz", "ωz"]];
        let words: Vec<String> =
            self.source(&self.last_prose).split([' ', ',', ':', ';', '$']).map(plain_name).collect();
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
