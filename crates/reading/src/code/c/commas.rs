//! Eigen's way to give a matrix its entries, one behind the other: `R << c, -s, s, c;`.

use super::{MAX_LENGTH, Writer};
use crate::code::lexer::{Mark, Token};

impl Writer {
    /// `NAME << a, b, …;` as `NAME = np.array([[a, b], …])`; false for anything else.
    pub(super) fn comma_initialised(&mut self) -> bool {
        let Some(name) = self.name(self.at).map(str::to_string) else { return false };
        if self.op(self.at + 1) != "<<" || matches!(name.as_str(), "cout" | "cerr" | "std") {
            return false;
        }
        let first = self.at + 2;
        let mut cuts = vec![first];
        let mut end = first;
        while end < self.tokens.len() && !matches!(self.op(end), ";" | "<<") {
            match self.op(end) {
                "(" | "[" | "{" => {
                    end = self.behind(end);
                    continue;
                }
                "," => cuts.push(end + 1),
                _ => {}
            }
            end += 1;
        }
        let count = cuts.len();
        let shape = self.declared_shape(&name).unwrap_or(match count {
            4 => (2, 2),
            9 => (3, 3),
            16 => (4, 4),
            n => (n, 1),
        });
        if self.op(end) != ";" || count > MAX_LENGTH || shape.0 * shape.1 != count {
            return false;
        }
        let own = self.tokens[self.at].clone();
        self.out.push(own);
        for mark in ["=", "np", ".", "array", "("] {
            match mark {
                "np" | "array" => self.word(mark),
                op => self.put(Mark::Op(op)),
            }
        }
        self.put(Mark::Op("["));
        for (k, &start) in cuts.iter().enumerate() {
            let begins = shape.1 > 1 && k % shape.1 == 0;
            if k > 0 {
                if begins {
                    self.put(Mark::Op("]"));
                }
                self.put(Mark::Op(","));
            }
            if begins {
                self.put(Mark::Op("["));
            }
            let stop = cuts.get(k + 1).map_or(end, |next| next - 1);
            self.at = start;
            while self.at < stop {
                self.token();
            }
        }
        if shape.1 > 1 {
            self.put(Mark::Op("]"));
        }
        self.put(Mark::Op("]"));
        self.put(Mark::Op(")"));
        self.put(Mark::Newline);
        self.at = end + 1;
        true
    }

    /// Rows and columns by the declaration above: `Matrix3d R`, `Matrix<double, 3, 4> J`, `Vector3d& q`, `MatrixXd J(2, 3)`.
    fn declared_shape(&self, name: &str) -> Option<(usize, usize)> {
        let is_it = |i: &usize| self.name(*i) == Some(name) && *i > 0;
        (0..self.at).rev().filter(is_it).find_map(|i| {
            let before = if matches!(self.op(i - 1), "&" | "*") { i.checked_sub(2)? } else { i - 1 };
            if self.op(before) == ">" {
                let open = (0..before).rev().find(|&k| self.op(k) == "<")?;
                let sizes: Vec<usize> = (open..before).filter_map(|k| self.size_at(k)).collect();
                let is_matrix = matches!(open.checked_sub(1).and_then(|k| self.name(k)), Some("Matrix"));
                return match sizes[..] {
                    [rows, columns] if is_matrix => Some((rows, columns)),
                    _ => None,
                };
            }
            let kind = self.name(before)?.trim_end_matches(['d', 'f']);
            if matches!(kind, "MatrixX" | "VectorX") {
                // `MatrixXd J(2, 3);`: without sizes that can be read it has none.
                let sizes = [i + 2, i + 4].map(|k| self.size_at(k));
                return Some(match (self.op(i + 1), sizes, self.op(i + 3)) {
                    ("(", [Some(rows), Some(columns)], ",") => (rows, columns),
                    ("(", [Some(rows), _], ")") => (rows, 1),
                    _ => (0, 0),
                });
            }
            let is_plain = |n: &str| n.len() == 1 && n.chars().all(|c| c.is_ascii_digit());
            let side = |stem: &str| kind.strip_prefix(stem).filter(|n| is_plain(n))?.parse::<usize>().ok();
            let square = side("Matrix").map(|n| (n, n));
            square.or(side("Vector").map(|n| (n, 1))).or(side("RowVector").map(|n| (1, n)))
        })
    }

    fn size_at(&self, k: usize) -> Option<usize> {
        match self.tokens.get(k).map(|Token { mark, .. }| mark) {
            Some(Mark::Number(r, true)) => r.to_integer().and_then(|n| usize::try_from(n).ok()),
            _ => None,
        }
    }
}
