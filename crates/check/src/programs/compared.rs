//! What the tests of a program expect, `assert_allclose(arm.fkine(q), expected)`: numbers held against the robot at the joints that the
//! test has.

use super::called::given_in;
use super::{Programs, Source};
use crate::facts::About;
use crate::lexis::Lexis;
use crate::matrix::Matrix;
use crate::numbers::{Answer, Configuration, half_unit};
use crate::subject::Subject;
use crate::walk::{Assertion, Piece};
use denavit::forward::Reference;
use denavit_reading::code::{Asked, Assigned, Cell, Code, Compared, Value, read_blocks};
use denavit_symbolic::{Expr, Symbol};
use std::ops::Range;
use std::rc::Rc;

/// What is called so gives the pose of the hand.
const POSES: [&str; 14] = [
    "fkine",
    "fk",
    "forward",
    "forward_kinematics",
    "forwardKinematics",
    "fkin",
    "compute_fk",
    "direct_kinematics",
    "fwd",
    "fwd_kin",
    "fkin_all",
    "tool_pose",
    "hand_pose",
    "getPose",
];
/// What the toolboxes call the Jacobian of the hand in the base, linear rows first; other names do not say which one it is.
const JACOBIAN: &str = "jacob0";
/// Numbers are computed so exactly.
const ROUNDING: f64 = 1e-9;
/// Words without which a program tests nothing.
const TESTS: [&str; 6] = ["assert", "EXPECT_", "ASSERT_", "CHECK", "REQUIRE", "verifyEqual"];

/// Adds what the tests of a program expect.
pub(super) fn tests(
    of: &Source<'_>,
    (subject, lexis): (&Rc<Subject>, &Lexis),
    asked: &Asked<'_>,
    found: &mut Programs,
) {
    let source = |b: &Range<usize>| of.source.get(b.clone()).unwrap_or_default();
    if !of.blocks.iter().any(|b| TESTS.iter().any(|t| source(b).contains(t))) {
        return;
    }
    // A function of the text that is judged stands for what it should give.
    let plain = Asked { stated: &|_, _| None, ..*asked };
    let codes: Vec<Code> = read_blocks(of.source, of.blocks, of.language, &plain);
    let functions = || codes.iter().flat_map(|c| &c.functions);
    let judged: Vec<(&str, &Matrix)> = functions()
        .filter_map(|f| {
            let [returned] = &f.returned[..] else { return None };
            let touches = |a: &&Assertion| {
                [&returned.span, &f.span].into_iter().all(|s| a.span.start < s.end && s.start < a.span.end)
                    || f.assigned.iter().any(|b| b.span == a.span && returned.name.as_ref() == Some(&b.name))
            };
            let own = found.assertions.iter().filter(|a| a.subject == of.number).find(touches)?;
            Some((f.name.as_str(), own.whole.as_ref()?))
        })
        .filter(|(name, _)| !name.is_empty())
        .collect();
    let lengths: Vec<(Symbol, Expr)> =
        functions().filter(|f| f.name.is_empty()).flat_map(|f| given_in(f, subject, lexis)).collect();
    let own = |name: &str, call: usize, is_defined: bool| -> Option<Vec<Vec<Expr>>> {
        let rows: Matrix = match name {
            _ if is_defined => Matrix::clone(judged.iter().find(|j| j.0 == name)?.1),
            _ if POSES.contains(&name) => Matrix::of(&subject.pose()),
            JACOBIAN => {
                let rows = subject.geometric_rows(Reference::Tool, subject.ground());
                Matrix(rows.into_iter().map(|r| r.into_iter().map(Some).collect()).collect())
            }
            _ => return None,
        };
        let of_call = |e: Expr| {
            e.substitute(|s| match is_joint(s, subject) {
                true => Some(of_call(s, call).into()),
                false => lengths.iter().rev().find(|l| l.0 == s).map(|l| l.1),
            })
        };
        rows.0.into_iter().map(|r| r.into_iter().map(|e| Some(of_call(e?))).collect()).collect()
    };
    let asked = Asked { own: Some(&own), ..plain };
    let codes: Vec<Code> = read_blocks(of.source, of.blocks, of.language, &asked);
    let assigned = || codes.iter().flat_map(|c| &c.functions).flat_map(|f| &f.assigned);
    let is_called = |v: &Value| cells(v).iter().flat_map(|c| c.value.symbols()).any(|s| call_of(s).is_some());
    let all = codes.iter().flat_map(|c| &c.compared);
    let expected: Vec<(&Compared, Expected)> =
        all.filter_map(|c| Some((c, expected(of, subject, c)?))).collect();
    // Where nothing is right the functions may be others than they are taken for: in degrees, of another tool.
    let is_any_right = expected.iter().any(|(_, e)| e.is_right);
    for (compared, Expected { mut assertion, .. }) in expected.into_iter().filter(|_| is_any_right) {
        // From the maker of the array on.
        let around = |a: &&Assigned| {
            a.name == assertion.name
                && a.span.start <= assertion.span.start
                && assertion.span.end <= a.span.end
        };
        if let Some(a) = assigned().find(around) {
            assertion.span = a.span.clone();
        }
        found.tested.push(compared.span.clone());
        let own = assertion.span.clone();
        let within = |s: &Range<usize>| {
            [&compared.span, &own].into_iter().any(|o| o.start <= s.start && s.end <= o.end)
        };
        found.refused.retain(|e| !within(&e.span));
        found.assertions.retain(|a| a.span != own);
        found.assertions.push(assertion);
    }
    if !found.tested.is_empty() {
        found.tested.extend(assigned().filter(|a| is_called(&a.value)).map(|a| a.span.clone()));
    }
}

/// The mark of a joint in a call of one of the robot's functions.
const OF_CALL: &str = " of call ";

fn is_joint(s: Symbol, subject: &Subject) -> bool {
    subject.joints().contains(&s.into())
}

/// A joint as it is in one call.
fn of_call(joint: Symbol, call: usize) -> Symbol {
    Symbol::new(&format!("{}{OF_CALL}{call}", joint.name()))
}

/// The number of the call that a symbol is of.
fn call_of(s: Symbol) -> Option<usize> {
    s.name().split_once(OF_CALL)?.1.parse().ok()
}

/// What a test holds against the robot, and whether it is so.
struct Expected {
    assertion: Assertion,
    is_right: bool,
}

/// What a test holds against the robot; nothing where it compares something else.
fn expected(of: &Source<'_>, subject: &Rc<Subject>, compared: &Compared) -> Option<Expected> {
    let symbols = |v: &Value| -> Vec<Symbol> { cells(v).iter().flat_map(|c| c.value.symbols()).collect() };
    let is_number = |v: &Value| symbols(v).is_empty();
    let [a, b] = &compared.values;
    let ((place, robot), (own, printed)) = match (is_number(&a.1), is_number(&b.1)) {
        (false, true) => (a, b),
        (true, false) => (b, a),
        _ => return None,
    };
    let all = symbols(robot);
    let call = all.iter().find_map(|s| call_of(*s))?;
    if all.iter().filter_map(|s| call_of(*s)).any(|c| c != call) {
        return None;
    }
    let joints = compared.calls.get(call)?;
    let values: Vec<f64> = joints.iter().map(|e| e.eval(|_| None).ok()).collect::<Option<_>>()?;
    let at = Configuration::in_radians(&values);
    let variables = subject.description.variables();
    let joint = |s: Symbol| {
        let name = s.name();
        let name = name.split_once(OF_CALL)?.0;
        variables.iter().position(|v| *v.symbol.name() == *name)
    };
    let value_of = |s: Symbol| match joint(s) {
        Some(k) => values.get(k).copied(),
        None => subject.description.exact_value(s)?.eval(|_| None).ok(),
    };
    let (wanted, printed_cells) = (cells(robot), cells(printed));
    let shape = |v: &Value| match v {
        Value::Scalar(_) => (1, 1),
        Value::Matrix(rows) => (rows.len(), rows.first().map_or(0, Vec::len)),
    };
    let (rows, columns) = shape(printed);
    // A vector as a row or a column.
    let is_same =
        shape(robot) == (rows, columns) || shape(robot) == (columns, rows) && rows.min(columns) == 1;
    if !is_same {
        return None;
    }
    let number = |e: Option<Expr>| e.and_then(|e| e.eval(|_| None).ok()).unwrap_or(0.0);
    let (within, share) = (number(compared.within), number(compared.relative));
    let mut is_right = true;
    let text = |span: &Range<usize>| of.text.get(span.clone()).unwrap_or_default();
    let pieces: Vec<Piece> = printed_cells
        .iter()
        .zip(wanted)
        .enumerate()
        .map(|(k, (cell, wanted))| {
            let value = cell.value.eval(|_| None).ok()?;
            let half = half_unit(text(&cell.span)).max(within + share * value.abs());
            is_right &=
                wanted.value.eval(value_of).is_ok_and(|right| (value - right).abs() <= half + ROUNDING);
            let answer = Answer {
                printed: value,
                half,
                wanted: wanted.value.substitute(|s| joint(s).map(|k| variables[k].symbol.into())),
                at: at.clone(),
                constant: Some(cell.value),
            };
            let place = (rows * columns > 1).then_some((k / columns + 1, k % columns + 1));
            Some(Piece::Number { place, span: cell.span.clone(), answer })
        })
        .collect::<Option<_>>()?;
    // Where the numbers stand: in the comparison, or under a name of their own.
    let name = text(own);
    let is_name =
        name.chars().all(|c| c.is_alphanumeric() || c == '_') && name.starts_with(char::is_alphabetic);
    let first = printed_cells.iter().map(|c| c.span.start).min()?;
    let last = printed_cells.iter().map(|c| c.span.end).max()?;
    let (span, name) = match is_name && (last <= own.start || own.end <= first) {
        true => (first..last, name),
        false => (compared.span.clone(), text(place)),
    };
    let assertion = Assertion {
        span,
        name: name.to_string(),
        about: About::Equation,
        pieces,
        remarks: vec![],
        subject: of.number,
        whole: None,
        names: None,
        reference: None,
        spoken: None,
    };
    Some(Expected { assertion, is_right })
}

/// The entries of a value, by rows.
fn cells(value: &Value) -> Vec<&Cell> {
    match value {
        Value::Scalar(cell) => vec![cell],
        Value::Matrix(rows) => rows.iter().flatten().collect(),
    }
}
