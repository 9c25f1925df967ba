//! What the tests of a program compare: values of the robot's own functions, which the text calls and has not, with numbers.

use super::machine::Machine;
use super::report;
use super::scalar::{Read, Scalar};
use super::tree::{Argument, Kind, Node, Span, Suffix, SuffixKind};
use super::value::{Matrix, Object, Sort, object};
use super::{MAX_SIDE, Value};
use denavit_symbolic::Expr;
use std::ops::Range;

/// The entries of what a function of the robot gives, by its name, the number of its call, and whether the text has it.
pub type OwnFunction<'a> = dyn Fn(&str, usize, bool) -> Option<Vec<Vec<Expr>>> + 'a;

/// Two values that a test holds against each other.
#[derive(Clone, Debug)]
pub struct Compared {
    /// The comparison.
    pub span: Range<usize>,
    /// Both, each with the place of its formula.
    pub values: [(Range<usize>, Value); 2],
    /// How far they may be apart, if that is said.
    pub within: Option<Expr>,
    /// And which part of the expected value more.
    pub relative: Option<Expr>,
    /// The values of the joints in each call of a function of the robot so far.
    pub calls: Vec<Vec<Expr>>,
}

/// Functions that compare their first two arguments.
const COMPARE: [&str; 20] = [
    "assert_allclose",
    "assert_almost_equal",
    "assert_array_almost_equal",
    "assert_array_almost_equal_nulp",
    "assert_approx_equal",
    "assert_array_equal",
    "assert_equal",
    "assertAlmostEqual",
    "assertAlmostEquals",
    "assertEqual",
    "allclose",
    "isclose",
    "EXPECT_NEAR",
    "ASSERT_NEAR",
    "EXPECT_DOUBLE_EQ",
    "EXPECT_FLOAT_EQ",
    "ASSERT_DOUBLE_EQ",
    "REQUIRE_NEAR",
    "CHECK_CLOSE",
    "assertClose",
];
/// Functions whose first argument is such a comparison.
const AROUND: [&str; 6] = ["assertTrue", "assert_", "EXPECT_TRUE", "ASSERT_TRUE", "CHECK", "REQUIRE"];
/// The most calls of functions of the robot.
const MAX_CALLED: usize = 200;

impl<'a> Machine<'a> {
    /// Takes down what a test compares; false for anything else, and where nothing is known of the robot's functions.
    pub(super) fn compares(&mut self, node: &'a Node) -> bool {
        let Some((name, arguments)) = self.own.and_then(|_| call(node)) else { return false };
        let mut positional = arguments.iter().filter(|a| a.name.is_none());
        if AROUND.contains(&name) {
            return positional.next().is_some_and(|inner| self.compares(&inner.value));
        }
        // The first argument of MATLAB's is the test.
        let is_matlab = matches!(name, "verifyEqual" | "assertEqual") && arguments.len() > 2 && {
            self.language == super::Dialect::Matlab
        };
        if is_matlab {
            positional.next();
        } else if !COMPARE.contains(&name) {
            return false;
        }
        let (Some(a), Some(b)) = (positional.next(), positional.next()) else { return true };
        let (Ok(left), Ok(right)) = (self.eval(&a.value), self.eval(&b.value)) else { return true };
        let scalar = |m: &mut Self, node: &'a Node| match m.eval(node) {
            Ok(Object::Scalar(s)) => Some(s.expr),
            _ => None,
        };
        let mut relative = None;
        let mut within =
            positional.next().filter(|_| name.ends_with("NEAR")).and_then(|t| scalar(self, &t.value));
        for argument in arguments {
            let Some(told) = argument.name.as_deref() else { continue };
            let Some(value) = scalar(self, &argument.value) else { continue };
            match told {
                "atol" | "delta" => within = Some(value),
                "rtol" => relative = Some(value),
                // Half a unit of so many places.
                "places" | "decimal" => {
                    let places =
                        value.as_number().and_then(|n| n.to_integer()).filter(|n| (0..=15).contains(n));
                    within = places
                        .map(|n| Expr::from(denavit_symbolic::Rational::new(1, 2 * 10_i64.pow(n as u32))));
                }
                _ => {}
            }
        }
        let (Some(left), Some(right)) =
            (report::value(&left, &mut self.budget), report::value(&right, &mut self.budget))
        else {
            return true;
        };
        self.compared.push(Compared {
            span: node.span.clone(),
            values: [(a.value.span.clone(), left), (b.value.span.clone(), right)],
            within,
            relative,
            calls: self.calls.clone(),
        });
        true
    }

    /// What a function of the robot gives, `arm.fkine(q)` or `fk(q)`; with how many suffixes were read.
    pub(super) fn called_of_robot(
        &mut self,
        base: &'a Node,
        suffixes: &'a [Suffix],
    ) -> Read<Option<(Object<'a>, usize)>> {
        let (Some(own), Kind::Name(first)) = (self.own, &base.kind) else { return Ok(None) };
        let is_value = |m: &Self, name: &str| matches!(m.variable(name), Some(Ok(_)));
        let found = match suffixes {
            [Suffix { kind: SuffixKind::Call(arguments), .. }, ..] => (first, arguments, 1),
            [
                Suffix { kind: SuffixKind::Attribute(name), .. },
                Suffix { kind: SuffixKind::Call(arguments), .. },
                ..,
            ] if !is_value(self, first) && !self.imports.contains_key(first.as_str()) => (name, arguments, 2),
            _ => return Ok(None),
        };
        let (name, arguments, mut read) = found;
        let is_own = self.functions.contains_key(name.as_str()) || read == 1 && is_value(self, name);
        let number = self.calls.len();
        let Some(rows) = own(name, number, is_own).filter(|_| number < MAX_CALLED) else { return Ok(None) };
        let span = base.span.start..suffixes[read - 1].end;
        let Some(joints) = self.joints_given(arguments, &span)? else { return Ok(None) };
        self.calls.push(joints);
        // `fkine(q).A`
        if let Some(Suffix { kind: SuffixKind::Attribute(of), .. }) = suffixes.get(read)
            && matches!(of.as_str(), "A" | "matrix" | "as_matrix" | "data")
        {
            read += 1;
            if matches!(suffixes.get(read), Some(Suffix { kind: SuffixKind::Call(a), .. }) if a.is_empty()) {
                read += 1;
            }
        }
        let columns = rows.first().map_or(0, Vec::len);
        if columns == 0 || rows.len() > MAX_SIDE {
            return Ok(None);
        }
        let entries: Vec<Scalar> = rows.concat().into_iter().map(|e| Scalar::of(e, &span)).collect();
        if columns == 1 {
            return Ok(Some((object(Matrix::vector(entries, Sort::Array)), read)));
        }
        let sort = if self.language == super::Dialect::Matlab { Sort::Matlab } else { Sort::Array };
        Ok(Some((object(Matrix::new(entries.len() / columns, columns, entries, sort)), read)))
    }

    /// Numbers for all joints, as one array or one by one.
    fn joints_given(&mut self, arguments: &'a [Argument], span: &Span) -> Read<Option<Vec<Expr>>> {
        let mut values = vec![];
        for argument in arguments.iter().filter(|a| a.name.is_none()) {
            match self.eval(&argument.value)? {
                Object::Scalar(s) => values.push(s.expr),
                Object::Matrix(m) => values.extend(m.entries.iter().map(|e| e.expr)),
                list @ Object::List(_) => {
                    for item in list.items(self.language, span)? {
                        match item {
                            Object::Scalar(s) => values.push(s.expr),
                            _ => return Ok(None),
                        }
                    }
                }
                _ => return Ok(None),
            }
        }
        let is_whole = values.len() == self.joints.len() && values.iter().all(|v| v.symbols().is_empty());
        Ok(is_whole.then_some(values))
    }
}

/// The name of what is called, and its arguments.
fn call(node: &Node) -> Option<(&str, &[Argument])> {
    let Kind::Path(base, suffixes) = &node.kind else { return None };
    let (last, before) = suffixes.split_last()?;
    let SuffixKind::Call(arguments) = &last.kind else { return None };
    match (before.last().map(|s| &s.kind), &base.kind) {
        (Some(SuffixKind::Attribute(name)), _) | (None, Kind::Name(name)) => Some((name, arguments)),
        _ => None,
    }
}
