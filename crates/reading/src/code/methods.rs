//! What is asked of a value with a dot: `T.T`, `A.dot(B)`.

use super::builders::{above, beside};
use super::calls::Given;
use super::machine::Machine;
use super::scalar::{Read, Scalar, refuse, refuse_hint};
use super::tree::Span;
use super::value::{Matrix, Object, Sort, inverse, object, product, side};

impl<'a> Machine<'a> {
    /// `T.T`, `T.shape`
    pub fn property(&mut self, value: &Object<'a>, name: &str, span: &Span) -> Read<Object<'a>> {
        if let Some(field) = self.field(value, name, span) {
            return Ok(field);
        }
        match (value, name) {
            (Object::Matrix(m), "T") => Ok(object(m.transposed())),
            (Object::Matrix(m), "I") if m.sort == Sort::NumpyMatrix => {
                Ok(object(inverse(m, &mut self.budget, span)?))
            }
            (Object::Matrix(m), "A") => Ok(object(Matrix { sort: Sort::Array, ..Matrix::clone(m) })),
            (Object::Matrix(m), "shape") => {
                let number = |n: usize| Object::Scalar(Scalar::whole(n, span));
                let all =
                    if m.is_flat { vec![number(m.rows)] } else { vec![number(m.rows), number(m.columns)] };
                Ok(Object::list(all))
            }
            (Object::Matrix(m), "size") => Ok(Object::Scalar(Scalar::whole(m.entries.len(), span))),
            (Object::Matrix(m), "ndim") => {
                Ok(Object::Scalar(Scalar::whole(if m.is_flat { 1 } else { 2 }, span)))
            }
            _ => {
                let hint = "only `.T` and `.shape` of a matrix are";
                refuse_hint(span, format!("`.{name}` of {} is not read", value.about()), hint)
            }
        }
    }

    /// `A.dot(B)`, `T.copy()`
    pub fn method(
        &mut self,
        value: &Object<'a>,
        name: &str,
        given: Given<'a>,
        span: &Span,
    ) -> Read<Object<'a>> {
        let sort = match value {
            Object::Matrix(m) => m.sort,
            _ => Sort::Array,
        };
        match (value, name) {
            (Object::List(_), "copy") | (Object::Matrix(_), "copy" | "as_mutable" | "as_immutable") => {
                Ok(self.copied(value.clone()))
            }
            (Object::Matrix(m), "transpose") if given.positional.is_empty() => Ok(object(m.transposed())),
            (Object::Matrix(m), "inv") if given.positional.is_empty() => {
                Ok(object(inverse(m, &mut self.budget, span)?))
            }
            (Object::Matrix(m), "dot") => {
                let [(other, place)] = self.positional(given, name, span)?;
                if let Object::Scalar(_) = other {
                    return self.binary(super::tree::Op::Mul, value.clone(), other, span);
                }
                product(m, &other.matrix(Sort::Array, &place)?, &mut self.budget, span)
            }
            (Object::Matrix(m), "cross") => {
                let [(other, place)] = self.positional(given, name, span)?;
                self.cross(m, &other.matrix(sort, &place)?, span)
            }
            (Object::Matrix(m), "flatten" | "ravel" | "squeeze") if sort != Sort::SympyMatrix => {
                let flat = Matrix::vector(m.entries.clone(), Sort::Array);
                Ok(object(if name == "flatten" { flat } else { m.view(flat) }))
            }
            (Object::Matrix(m), "reshape") => {
                let sizes = given.positional.iter();
                let sizes: Vec<i64> = sizes
                    .map(|(o, p)| Ok(o.matrix(Sort::Array, p)?.entries))
                    .collect::<Read<Vec<Vec<Scalar>>>>()?
                    .iter()
                    .flatten()
                    .filter_map(Scalar::to_integer)
                    .collect();
                let n = m.entries.len();
                let of = |x: i64, rest: i64| match usize::try_from(x) {
                    Ok(x) => x,
                    Err(_) => n.checked_div(usize::try_from(rest).unwrap_or(0)).unwrap_or(0),
                };
                let entries = m.entries.clone();
                let shaped = match sizes.as_slice() {
                    [k] if of(*k, 1) == n && sort != Sort::SympyMatrix => {
                        Matrix::vector(entries, Sort::Array)
                    }
                    [r, c] if of(*r, *c).saturating_mul(of(*c, *r)) == n => {
                        Matrix::new(side(of(*r, *c), span)?, side(of(*c, *r), span)?, entries, sort)
                    }
                    _ => return refuse(span, "the entries do not fit this shape"),
                };
                Ok(object(m.view(shaped)))
            }
            (Object::Matrix(m), "tolist") => {
                let rows = m.entries.chunks(m.columns.max(1));
                let scalars = |row: &[Scalar]| row.iter().cloned().map(Object::Scalar).collect::<Vec<_>>();
                Ok(match m.is_flat {
                    true => Object::list(scalars(&m.entries)),
                    false => Object::list(rows.map(|r| Object::list(scalars(r))).collect()),
                })
            }
            (Object::Matrix(m), "row_join" | "col_join") => {
                let [(other, place)] = self.positional(given, name, span)?;
                let blocks = [Matrix::clone(m), other.matrix(sort, &place)?];
                Ok(object(if name == "row_join" { beside(&blocks, span)? } else { above(&blocks, span)? }))
            }
            (Object::Scalar(_) | Object::Matrix(_), "subs" | "xreplace") => {
                self.substituted(value, &given, span)
            }
            (Object::Scalar(_) | Object::Matrix(_), "diff") => {
                self.differentiated(value, &given.positional, span)
            }
            (Object::Matrix(_) | Object::List(_), "jacobian") => {
                let [by] = self.positional(given, name, span)?;
                self.jacobian(value, &by, span)
            }
            (Object::Matrix(m), "det" | "berkowitz_det") => self.determinant(m, span),
            (Object::Matrix(m), "row" | "col") => {
                let [(k, place)] = self.positional(given, name, span)?;
                let k = k.scalar(&place)?.to_integer().and_then(|k| usize::try_from(k).ok());
                let (rows, columns): (Vec<usize>, Vec<usize>) =
                    ((0..m.rows).collect(), (0..m.columns).collect());
                match k {
                    Some(k) if name == "row" && k < m.rows => Ok(object(m.part(&[k], &columns))),
                    Some(k) if name == "col" && k < m.columns => Ok(object(m.part(&rows, &[k]))),
                    _ => refuse(span, "there is no such row or column"),
                }
            }
            (_, "astype") => match given.positional.first() {
                Some((Object::Path(kind), _)) if kind.contains("float") => {
                    self.each_entry(value.clone(), span, |_, s| Ok(s.wholly(false)))
                }
                _ => refuse(span, "this type of entries is not read"),
            },
            (
                Object::Scalar(_) | Object::Matrix(_),
                "simplify" | "expand" | "item" | "doit" | "evalf" | "n" | "factor" | "trigsimp" | "collect"
                | "cancel" | "round" | "together" | "as_mutable" | "as_immutable" | "applyfunc" | "rewrite"
                | "nsimplify",
            ) => self.each_entry(value.clone(), span, |_, s| Ok(s.unwritten(span))),
            _ => {
                let hint = "only arithmetic, matrices, sines and roots are";
                refuse_hint(span, format!("`.{name}` of {} is not read", value.about()), hint)
            }
        }
    }
}
