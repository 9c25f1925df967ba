//! The entries of a rotation of the robot that a document gives a letter of its own.

use super::Walk;
use crate::custom::seen_through;
use crate::facts::Meaning;
use crate::habits::Places;
use crate::matrix::Matrix;
use crate::names::Name;
use crate::recognised::nearest;
use denavit::forward::Reference as Frame;
use denavit::geometry::Rotation;
use denavit_symbolic::Expr;

impl Walk<'_> {
    /// The entries of a rotation of the robot under a name of the document's own, `M = {}^0R_4^T {}^0R_7` with `m_{23}`: in inverse
    /// formulas they are those by the pose.
    pub(super) fn name_entries(&mut self, name: &Name, matrix: &Matrix) {
        let mut letters = name.base.chars();
        let (Some(letter), None) = (letters.next(), letters.next()) else { return };
        if !name.is_bare() || !letter.is_alphabetic() || matches!(letter, 'J' | 'R' | 'T') {
            return;
        }
        let rows: Option<Vec<Vec<Option<Expr>>>> = match matrix.shape() {
            Some((3, 3) | (4, 4)) => Some(matrix.0.iter().take(3).map(|r| r[..3].to_vec()).collect()),
            _ => None,
        };
        let Some(rows) = rows else { return };
        let small = letter.to_lowercase().to_string();
        let entry = |r: usize, c: usize| format!("{small}{}{}", r + 1, c + 1);
        let is_told = ["_{", "_", ""].iter().any(|mark| {
            ["ij", "i,j", "13", "33", "23"].iter().any(|k| self.text.contains(&format!("{small}{mark}{k}")))
        });
        if !is_told || self.lexis.names.lookup(&entry(0, 0)).is_some() {
            return;
        }
        let Some(((_, about), agreement)) = nearest(&self.subject, &Matrix(rows.clone())) else { return };
        let Meaning::Rotation(frame) = about else { return };
        let (Meaning::Frame { of, seen_from }, true) = (*frame, agreement.is_whole) else { return };
        // The tool's turn is no part of the last frame.
        let turns = self.subject.description.tool.rotation != Rotation::identity();
        if turns && [of, seen_from].contains(&Frame::Tool) {
            return;
        }
        let number = |r: Frame| match r {
            Frame::Base => 0,
            Frame::Frame(k) => k,
            Frame::Tool => self.subject.last(),
        };
        let places = Places(self.lexis.habits.columns);
        let (i, j) = (number(seen_from), number(of));
        let Some(posed) = seen_through(&self.subject, &places, i, j) else { return };
        let posed = posed.rotation.rows();
        for (r, row) in rows.iter().enumerate() {
            for (c, value) in row.iter().enumerate() {
                if let Some(value) = value {
                    self.lexis.define_right(&entry(r, c), *value, posed[r][c]);
                }
            }
        }
    }
}
