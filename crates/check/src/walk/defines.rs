//! Which statements define a name of the document's own.

use super::{Defined, Pair, Piece, Scalar, Walk};
use crate::directions::{parallel_sum, sum_in_pose};
use crate::facts::{About, Meaning};
use crate::habits::Places;
use crate::lexis::read;
use denavit::random::Random;
use denavit_reading::document::Statement;
use denavit_reading::slip::Points;
use denavit_symbolic::parse::{Function, Syntax, SyntaxKind};
use denavit_symbolic::vocabulary::{Vocabulary, plain_name};
use denavit_symbolic::{Expr, Node, Symbol};
use std::ops::Range;

/// True for the name of a length of a table: `d2`, `a3`, `r1`.
fn is_cell(name: &str) -> bool {
    let number = name.strip_prefix(['a', 'd', 'r', 'b']).unwrap_or_default();
    !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit())
}

impl Walk<'_> {
    /// True if a side defines a name: one without meaning, or a second spelling of a joint whose own formula it would stand in.
    pub(super) fn defines(&self, span: &Range<usize>, side: &Scalar, formula: &Syntax) -> bool {
        match side {
            Scalar::Lone(_) => true,
            Scalar::Formula(_, left) => {
                let joint = left.value().as_symbol().filter(|s| self.subject.joints().contains(&(*s).into()));
                // A helper may be defined anew: what it was before is not what it should be.
                if matches!(left.kind, SyntaxKind::Name(_)) && self.lexis.is_helper(self.source(span)) {
                    // A number for it at a known configuration is its value.
                    let is_value = formula.value().symbols().is_empty() && !left.value().symbols().is_empty();
                    if is_value
                        && self.is_plain_helper(left.value())
                        && self.at.knows(left.value(), &self.subject)
                    {
                        return false;
                    }
                    return !denavit_symbolic::equal(left.value(), formula.value()).is_equal()
                        && !self.agree_on_a_branch(left.value(), formula.value());
                }
                // `d2 = a² + b²` where the table has 0 for d2: the name is the author's own.
                let is_empty_cell = is_cell(&plain_name(self.source(span)))
                    && matches!(left.kind, SyntaxKind::Name(_))
                    && left.value().is_zero()
                    && !formula.value().is_zero()
                    && formula.value().symbols().iter().any(|s| self.subject.joints().contains(&(*s).into()));
                if is_empty_cell {
                    return true;
                }
                let is_letter = self.source(span).starts_with('t') && !self.source(span).starts_with("th");
                joint.is_some_and(|j| {
                    is_letter && formula.value() != left.value() && formula.value().symbols().contains(&j)
                })
            }
            Scalar::Broken(..) => false,
        }
    }

    /// True for a value with a root and one without that are the same where the root has its sign: `r = √(x² + y²) - a_1` is
    /// `a_2 c_2 + a_3 c_23`.
    fn agree_on_a_branch(&self, rooted: Expr, other: Expr) -> bool {
        const TRIES: usize = 12;
        let has_root = |e: Expr| Expr::postorder(&[e]).iter().any(|e| matches!(e.node(), Node::Sqrt(_)));
        if !has_root(rooted) || has_root(other) {
            return false;
        }
        let mut random = Random(31);
        let mut count = 0;
        for _ in 0..TRIES {
            let mut values: Vec<(Symbol, f64)> = vec![];
            for s in rooted.symbols().into_iter().chain(other.symbols()) {
                if values.iter().all(|v| v.0 != s) {
                    let known = self.subject.description.value(s);
                    let x = 2.0 * random.unit() - 0.9;
                    values.push((s, known.unwrap_or(x)));
                }
            }
            let at = |e: Expr| e.eval(|s| values.iter().find(|v| v.0 == s).map(|v| v.1)).ok();
            let (Some(a), Some(b)) = (at(rooted), at(other)) else { continue };
            count += usize::from((a - b).abs() < 1e-9 * (1.0 + a.abs()));
        }
        count > 1
    }

    /// True for `Z = P_z - L`: by custom Z is that entry of the pose, which it cannot be here.
    pub(super) fn is_told_of_itself(&self, name: &Range<usize>, formula: &Range<usize>) -> bool {
        let entry = |span: &Range<usize>| self.lexis.inverse_formula(self.text, span).ok().map(|s| s.value());
        // By custom, or beside the same in another spelling: `Px = px - d6*ax`.
        let is_own = |name: &Range<usize>| {
            let plain = |span: &Range<usize>| plain_name(self.source(span));
            self.lexis.is_by_custom(self.source(name)) || !plain(formula).contains(&plain(name))
        };
        let (Some(name), Some(formula)) = (entry(name).filter(|_| is_own(name)), entry(formula)) else {
            return false;
        };
        let is_entry = |s| (0..3).any(|r| (0..4).any(|c| self.lexis.pose_symbol(r, c) == s));
        name.as_symbol().is_some_and(|s| is_entry(s) && formula != name && formula.symbols().contains(&s))
    }

    /// True for `Y = d_1 - z = a_2 s_2 + a_3 s_{23}`, which holds of the arm but for the name: that is the document's own.
    pub(super) fn is_own_of_two(&self, name: &Range<usize>, read: &[Scalar]) -> bool {
        let [Scalar::Formula(_, left), Scalar::Formula(a, posed), Scalar::Formula(b, moved)] = read else {
            return false;
        };
        let known = |e: Expr| e.substitute(|s| self.subject.description.exact_value(s));
        let is_same = |x: Expr, y: Expr| denavit_symbolic::equal(known(x), known(y)).is_equal();
        let source = self.source(name).trim();
        source.chars().count() <= 2
            && self.speaks_of_pose(a)
            && !self.speaks_of_pose(b)
            && is_same(posed.value(), moved.value())
            && !is_same(left.value(), moved.value())
    }

    /// The entry of the pose that a formula of the joints is: `x_E = l_1 c_1 + l_2 c_12` is a place that inverse formulas know.
    fn place_of(&self, value: Expr) -> Option<Expr> {
        let joints = self.subject.joints();
        if !value.symbols().iter().any(|s| joints.contains(&(*s).into())) {
            return None;
        }
        let mut points = Points::new(59);
        let at = points.value(value)?;
        let place = self.subject.pose().translation.0;
        let r = (0..3).find(|&r| {
            points.value(place[r]).as_ref() == Some(&at)
                && denavit_symbolic::equal(place[r], value).is_equal()
        })?;
        Some(self.lexis.pose_symbol(r, 3).into())
    }

    /// What `G_y` is where `G_x` was given as the hand's: the entry of the place, and its symbol. Only of a formula of the joints.
    fn place_by_sibling(&self, name: &str, value: Expr) -> Option<(Expr, Expr)> {
        const AXES: [char; 3] = ['x', 'y', 'z'];
        let joints = self.subject.joints();
        let axis = AXES.iter().position(|a| name.ends_with(*a) || name.starts_with(*a) && name.len() > 1)?;
        let with = |other: char| match name.ends_with(AXES[axis]) {
            true => format!("{}{other}", &name[..name.len() - 1]),
            false => format!("{other}{}", &name[1..]),
        };
        // What the document itself has given as a formula of the joints, not what a name is by custom.
        let is_place = |k: usize| {
            let sibling = with(AXES[k]);
            let given = self.defined.iter().filter(|d| d.subject == self.number && d.name == sibling);
            let symbol = Some(Expr::from(self.lexis.pose_symbol(k, 3)));
            given.into_iter().any(|d| self.place_of(d.value) == symbol)
        };
        let moves = value.symbols().iter().any(|s| joints.contains(&(*s).into()));
        let is_own = name.len() > 1 && moves && (0..3).any(|k| k != axis && is_place(k));
        is_own.then(|| (self.subject.pose().translation.0[axis], self.lexis.pose_symbol(axis, 3).into()))
    }

    /// A name that means an entry of the pose by custom where it stands alone, `x_P = …`, means it in formulas behind as well.
    pub(super) fn know_entry(&mut self, span: &Range<usize>, wanted: Expr) {
        if self.lexis.formula(self.text, span).is_ok() {
            return;
        }
        let Some(name) = self.lexis.lone_name(self.text, span) else { return };
        let pose = self.subject.pose().matrix();
        let place = (0..12).map(|k| (k / 4, k % 4)).find(|&(r, c)| pose[r][c] == wanted);
        if let Some((r, c)) = place.filter(|_| !wanted.symbols().is_empty()) {
            let entry = self.lexis.pose_symbol(r, c).into();
            self.lexis.define_right(&plain_name(&format!("{}{}", name.base, name.sub)), wanted, entry);
        }
    }

    /// The components of a place that a statement gives a letter, `Q = (…)`: `Q_x`, `Q_y`, `Q_z`.
    pub(super) fn know_components(&mut self, statement: &Statement) {
        let last = self.assertions.last().filter(|a| a.span.end == statement.span.end);
        if !last.is_some_and(|a| a.about == About::Matrix(Meaning::Position)) {
            return;
        }
        let Some(name) = statement.sides.first().and_then(|s| self.lone(s)) else { return };
        let letter = format!("{}{}", name.base, name.sub);
        let place = self.subject.pose().translation.0;
        for (r, axis) in ["x", "y", "z"].into_iter().enumerate() {
            let component = plain_name(&format!("{letter}{axis}"));
            if letter.chars().count() <= 2 && self.lexis.names.lookup(&component).is_none() {
                let entry = self.lexis.pose_symbol(r, 3).into();
                self.lexis.define_right(&component, place[r], entry);
            }
        }
    }

    /// Keeps a name that a statement defines, with its value, and that with the entries of the pose as symbols.
    pub(super) fn defined_here(
        &mut self,
        statement: &Statement,
        name: String,
        [value, inverse]: [Expr; 2],
        span: &Range<usize>,
        syntax: &Syntax,
    ) {
        if self.is_held_there(statement, &name, span, syntax) {
            return;
        }
        let by_custom = self.lexis.is_by_custom(&name);
        // φ = θ2 + θ3 + θ4 is told with the pose.
        let is_angle = name.ends_with(|c: char| c.is_alphabetic());
        let places = Places(self.lexis.habits.columns);
        let shown = is_angle.then(|| sum_in_pose(&self.subject, &places, inverse)).flatten();
        let is_sum = |sum: &Expr| shown.is_some() && denavit_symbolic::equal(value, *sum).is_equal();
        let of_hand = parallel_sum(&self.subject).filter(is_sum);
        let place = self.place_of(value);
        let sibling = self.place_by_sibling(&name, value).filter(|_| place.is_none());
        let inverse = shown.or(place).or(sibling.map(|s| s.1)).unwrap_or(inverse);
        let meant = sibling.map_or(value, |s| s.0);
        if let Some(wanted) = of_hand {
            // What the name means is seen: the angle of the hand.
            let mut assertion = self.assertion(statement, About::Equation);
            assertion.pieces = vec![Piece::Pair(Pair {
                place: None,
                span: span.clone(),
                printed: Some(syntax.clone()),
                value,
                wanted,
                also: vec![],
            })];
            self.assertions.push(assertion);
        }
        self.lexis.define(&name, meant);
        self.lexis.define_inverse(&name, inverse);
        self.defined.push(Defined {
            name,
            by_custom,
            statement: statement.span.clone(),
            shown: self.claim_name(statement),
            span: span.clone(),
            printed: syntax.clone(),
            value: syntax.value(),
            subject: self.number,
            from: self.reader.unwrap_or(statement.span.start),
        });
    }

    /// A helper of the joints, or its square, that a statement makes a formula of the pose, `w_x = p_x - d_6 r_13`: in inverse formulas
    /// it is that from here on, if both are the same.
    pub(super) fn know_in_pose(&mut self, statement: &Statement) {
        let spans: Vec<&Range<usize>> = statement.sides.iter().map(|s| &s.span).collect();
        let (Some(first), true) = (spans.first(), spans.len() > 1) else { return };
        let source = self.source(first);
        let bare = ["^2", "^{2}", "²", "**2"].iter().find_map(|p| source.strip_suffix(p));
        let (name, power) = bare.map_or((source, 1), |b| (b.trim(), 2));
        let joints = self.subject.joints();
        let moves = |e: Expr| e.symbols().iter().any(|s| joints.contains(&(*s).into()));
        let inverse = |span: &Range<usize>| Some(self.lexis.inverse_formula(self.text, span).ok()?.value());
        let value = |span: &Range<usize>| Some(self.lexis.formula(self.text, span).ok()?.value());
        let known = self.lexis.is_helper(name).then(|| self.lexis.names.lookup(name)).flatten();
        let in_joints = self.lexis.inverse.lookup(name).is_some_and(moves);
        let Some(known) = known.filter(|_| in_joints) else { return };
        // Joints that were found before may stand in it.
        let own = known.symbols();
        let is_apart =
            |e: Expr| !e.symbols().iter().any(|s| joints.contains(&(*s).into()) && own.contains(s));
        let posed = spans.iter().skip(1).find_map(|span| {
            let pose = inverse(span).filter(|e| self.speaks_of_pose(span) && is_apart(*e))?;
            denavit_symbolic::equal(known.powi(power), value(span)?).is_equal().then_some(pose)
        });
        if let Some(pose) = posed {
            let name = plain_name(name);
            self.lexis.define_inverse(&name, if power == 2 { pose.sqrt() } else { pose });
        }
    }

    /// What a name is whose function a side is: `cos ε = …`, `r² = …`; with the value that the name has then.
    pub(super) fn implied(&self, span: &Range<usize>, value: Expr) -> Option<(String, Expr)> {
        let open = Vocabulary::new().open(true);
        let syntax = read(self.text, span, &open).ok()?;
        let mut inner = &syntax;
        while let SyntaxKind::Bracket(next) = &inner.kind {
            inner = next;
        }
        let whole = inner.value();
        let [symbol] = whole.symbols()[..] else { return None };
        let name = symbol.name().to_string();
        if self.lexis.names.lookup(&name).is_some() {
            return None;
        }
        let e = Expr::from(symbol);
        let value = match () {
            () if whole == e.cos() => Function::Arccos.of(&[value]),
            () if whole == e.sin() => Function::Arcsin.of(&[value]),
            () if whole == e.powi(2) => value.sqrt(),
            () => return None,
        };
        Some((name, value))
    }

    /// A name with a letter as its argument, `f_{11}(p)`: as a whole it is a name.
    pub(super) fn name_with_argument(&self, span: &Range<usize>) -> Option<String> {
        let plain = plain_name(&self.source(span).replace("\\left", "").replace("\\right", ""));
        let (name, rest) = plain.split_once('(')?;
        let argument = rest.strip_suffix(')')?;
        let is_name = name.chars().next().is_some_and(char::is_alphabetic) && name.chars().count() <= 4;
        let is_letter = argument.chars().count() == 1 && argument.chars().all(char::is_alphabetic);
        let is_function = matches!(name, "cos" | "sin" | "tan" | "atan" | "sqrt" | "det" | "c" | "s");
        (is_name && is_letter && !is_function && self.lexis.names.lookup(name).is_none()).then_some(plain)
    }
}
