//! The certificate as a file for Coq: a definition and a lemma a quantity, over its real numbers.
//!
//! The links stand in it as the table has them, their product is defined step by step, and each claim is a lemma. What a
//! quantity is as a polynomial is proved by `field`; a claim from that, with the cofactors and the relations as hypotheses.

use crate::arm::{View, factor};
use crate::claims::{Certificate, Claim, Quantity};
use crate::field::{Field, Obstacle};
use crate::text::{Dialect, polynomial, text};
use denavit_symbolic::poly::{Atom, Poly};
use denavit_symbolic::{Angle, Expr, Rational, Symbol};
use rustc_hash::FxHashMap;

/// Coq's syntax: no quotients but of numbers, sines and cosines worked out.
struct Coq;

impl Dialect for Coq {
    fn power(&self, base: &str, n: u32) -> String {
        vec![base; n as usize].join("*")
    }

    fn number(&self, r: &Rational) -> String {
        let (n, d) = r.digits();
        let size = if r.is_integer() { n } else { format!("({n}/{d})") };
        if r.is_negative() { format!("(-{size})") } else { size }
    }

    fn circular(&self, field: &mut Field, argument: Expr, is_sine: bool) -> String {
        match field.sine(&Angle::of(argument)) {
            Ok((s, c)) => format!("({})", polynomial(field, if is_sine { &s } else { &c }, self)),
            Err(_) => "unknown".into(),
        }
    }

    fn surd(&self, field: &mut Field, prime: i64) -> String {
        self.root(field, Expr::int(prime))
    }

    fn root(&self, field: &mut Field, of: Expr) -> String {
        let root = field.value(of.sqrt());
        root.map_or("unknown".into(), |root| format!("({})", polynomial(field, &root.num, self)))
    }
}

/// Something with a name and a value, or a constant.
#[derive(Clone, Debug)]
struct Item {
    /// Its name, if it has one.
    name: Option<String>,
    value: Poly,
}

/// A number times what some names stand for times a polynomial.
type Term = (Rational, Vec<Item>, Poly);

struct Writer<'a> {
    certificate: &'a mut Certificate,
    out: String,
    frames: FxHashMap<(usize, usize, usize), [[Item; 4]; 3]>,
    proved: FxHashMap<(View, Vec<usize>, Vec<usize>), Item>,
    entries: FxHashMap<(View, usize, usize), Item>,
    defined: FxHashMap<Symbol, Item>,
}

impl Certificate {
    /// The certificate as a file that `coqc` accepts. Claims with denominators are left out, and noted as missing.
    pub fn to_coq(&mut self) -> String {
        let (claims, definitions) = (self.claims.clone(), self.definitions.clone());
        let mut writer = Writer {
            certificate: self,
            out: String::new(),
            frames: FxHashMap::default(),
            proved: FxHashMap::default(),
            entries: FxHashMap::default(),
            defined: FxHashMap::default(),
        };
        let mut missing = vec![];
        for (name, quantity) in definitions {
            let item = match &quantity {
                Quantity::Formula(e) => writer.formula(&name.name(), *e),
                _ => writer.left(&quantity, "").map(|item| writer.renamed(name, &item)),
            };
            match item {
                Ok(item) => drop(writer.defined.insert(name, item)),
                Err(why) => missing.push((name.name().to_string(), why)),
            }
        }
        for claim in claims {
            if let Err(why) = writer.claim(&claim) {
                missing.push((claim.name, why));
            }
        }
        let body = writer.out;
        self.missing.extend(missing);
        self.coq_head() + &body + "End Certificate.\n"
    }

    /// Variables and hypotheses.
    fn coq_head(&mut self) -> String {
        let field = &mut self.field;
        let mut out = format!(
            "(* {}: claims proved from its table; written by denavit, explained in docs/certificates.md. *)\n",
            self.description.name.replace(['(', ')', '*', '"'], " ")
        );
        out += "From Coq Require Import Reals.\nOpen Scope R_scope.\n\nSection Certificate.\n";
        out += &format!("Variables {} : R.\n", field.atoms.join(" "));
        for base in field.bases.clone() {
            let [c, s] = [base.cos, base.sin].map(|a| field.atoms[usize::from(a)].clone());
            let angle = text(field, base.angle.to_expr(), &Coq);
            out += &format!("(* {c} and {s}: cosine and sine of {angle} *)\n");
        }
        for (atom, square) in field.squares() {
            let name = field.atoms[usize::from(atom)].clone();
            let square = polynomial(field, &square, &Coq);
            out += &format!("Hypothesis {name}_square : {name}*{name} - ({square}) = 0.\n");
        }
        out + "\n"
    }
}

impl Writer<'_> {
    /// Defines a sum of products and proves what it is as a polynomial.
    fn define(&mut self, hint: &str, terms: Vec<Term>) -> Result<Item, Obstacle> {
        let field = &mut self.certificate.field;
        let (mut value, mut summands, mut used) = (Poly::zero(), vec![], vec![]);
        for (number, items, p) in &terms {
            let mut product = p.scaled(number);
            for item in items {
                product = field.times(&product, &item.value)?;
            }
            if product.is_zero() {
                continue;
            }
            value = value.plus(&product);
            let mut factors = vec![Coq.number(number)];
            for item in items {
                match &item.name {
                    Some(name) => {
                        factors.push(name.clone());
                        used.push(name.clone());
                    }
                    None => factors.push(format!("({})", polynomial(field, &item.value, &Coq))),
                }
            }
            factors.push(format!("({})", polynomial(field, p, &Coq)));
            factors.retain(|f| f != "1" && f != "(1)");
            summands.push(if factors.is_empty() { "1".into() } else { factors.join("*") });
        }
        if value.as_constant().is_some() {
            return Ok(Item { name: None, value });
        }
        let name = field.names.new_name(hint);
        let by = if summands.is_empty() { "0".into() } else { summands.join(" + ") };
        let polynomial = polynomial(field, &value, &Coq);
        used.sort();
        used.dedup();
        let rewritten: String = used.iter().map(|n| format!(" rewrite ?{n}_is;")).collect();
        self.out += &format!("Definition {name} : R := {by}.\n");
        self.out += &format!("Lemma {name}_is : {name} = {polynomial}.\n");
        self.out += &format!("Proof. unfold {name};{rewritten} field. Qed.\n");
        Ok(Item { name: Some(name), value })
    }

    /// Defines a formula as it stands.
    fn formula(&mut self, hint: &str, e: Expr) -> Result<Item, Obstacle> {
        let value = self.certificate.field.polynomial(e)?;
        let (by, rewritten) = self.written(e);
        let field = &mut self.certificate.field;
        let polynomial = polynomial(field, &value, &Coq);
        // A step of a program is called what it is called there.
        let symbol = Symbol::new(hint);
        let name = if field.knows(symbol) {
            field.names.of(symbol)
        } else {
            field.names.new_name(&format!("{hint}_left"))
        };
        self.out += &format!("Definition {name} : R := {by}.\n");
        self.out += &format!("Lemma {name}_is : {name} = {polynomial}.\n");
        self.out += &format!("Proof. unfold {name};{rewritten} field. Qed.\n");
        Ok(Item { name: Some(name), value })
    }

    /// Gives a quantity the name of a symbol.
    fn renamed(&mut self, symbol: Symbol, item: &Item) -> Item {
        let field = &mut self.certificate.field;
        let name = field.names.of(symbol);
        let value = polynomial(field, &item.value, &Coq);
        let (by, rewritten) = match &item.name {
            Some(of) => (of.clone(), format!(" rewrite {of}_is;")),
            None => (value.clone(), String::new()),
        };
        self.out += &format!("Definition {name} : R := {by}.\n");
        self.out += &format!("Lemma {name}_is : {name} = {value}.\n");
        self.out += &format!("Proof. unfold {name};{rewritten} field. Qed.\n");
        Item { name: Some(name), value: item.value.clone() }
    }

    /// A formula, and the rewriting of the names in it.
    fn written(&mut self, e: Expr) -> (String, String) {
        let by = text(&mut self.certificate.field, e, &Coq);
        let used = e.symbols().into_iter().filter_map(|s| self.defined.get(&s)?.name.clone());
        (by, used.map(|n| format!(" rewrite ?{n}_is;")).collect())
    }

    /// Frame `b` in frame `a`, and so many screws behind it.
    fn frame(&mut self, a: usize, b: usize, screws: usize) -> Result<[[Item; 4]; 3], Obstacle> {
        let arm = self.certificate.arm.as_ref().map_err(|why| *why)?;
        if screws == 0 && b > a {
            let last = arm.links[b - 1].len();
            return self.frame(a, b - 1, last);
        }
        if let Some(known) = self.frames.get(&(a, b, screws)) {
            return Ok(known.clone());
        }
        let mut x: [[Item; 4]; 3] = std::array::from_fn(|i| {
            std::array::from_fn(|k| {
                let value = if i == k { Poly::one() } else { Poly::zero() };
                Item { name: None, value }
            })
        });
        let name = |i: usize, k: usize| format!("f{a}_{b}_{screws}_{}{}", i + 1, k + 1);
        if screws > 0 {
            let screw = arm.links[b][screws - 1].clone();
            let before = self.frame(a, b, screws - 1)?;
            for (i, row) in before.iter().enumerate() {
                for k in 0..4 {
                    let of = |n: usize| (Rational::ONE, vec![row[n].clone()], screw[n][k].clone());
                    let mut terms: Vec<Term> = (0..3).map(of).collect();
                    if k == 3 {
                        terms.push((Rational::ONE, vec![row[3].clone()], Poly::one()));
                    }
                    let moved = screw[k.min(2)][k] == Poly::one() && k < 3;
                    let is_same = moved && (0..3).all(|n| n == k || screw[n][k].is_zero());
                    x[i][k] = if is_same { row[k].clone() } else { self.define(&name(i, k), terms)? };
                }
            }
        } else if b < a {
            let forth = self.frame(b, a, 0)?;
            for (i, row) in x.iter_mut().enumerate() {
                for (entry, turned) in row.iter_mut().zip(&forth) {
                    *entry = turned[i].clone();
                }
                let of =
                    |k: usize| (-Rational::ONE, vec![forth[k][i].clone(), forth[k][3].clone()], Poly::one());
                row[3] = self.define(&name(i, 3), (0..3).map(of).collect())?;
            }
        }
        self.frames.insert((a, b, screws), x.clone());
        Ok(x)
    }

    /// An entry of a Jacobian: the sum of θ' z × (p − o) + d' z, or of θ' z.
    fn jacobian(&mut self, view: &View, row: usize, joint: usize) -> Result<Item, Obstacle> {
        if let Some(known) = self.entries.get(&(view.clone(), row, joint)) {
            return Ok(known.clone());
        }
        let arm = self.certificate.arm.as_ref().map_err(|why| *why)?;
        let (axes, at, body) = (arm.index(view.axes), arm.index(view.at), arm.index(view.body));
        let (moved, before, q) = (arm.moved.clone(), arm.before, arm.joints[joint]);
        let frame = self.frame(axes, at, 0)?;
        let one = Rational::ONE;
        let offset = view.offset.map(|e| self.certificate.field.polynomial(e));
        let mut terms: Vec<Term> = vec![];
        for (i, cells) in moved.iter().enumerate().take(body.saturating_sub(1)) {
            let field = &mut self.certificate.field;
            let atom = field.symbol(q).num;
            let [turn, slide] =
                [field.polynomial(cells[0])?, field.polynomial(cells[1])?].map(|p| factor(&p, &atom));
            if turn.is_zero() && slide.is_zero() {
                continue;
            }
            let x = self.frame(axes, i + 1, before)?;
            let k = row % 3;
            if row >= 3 {
                terms.push((turn, vec![x[k][2].clone()], Poly::one()));
                continue;
            }
            let (n, m) = ((k + 1) % 3, (k + 2) % 3);
            for (z, arm, sign) in [(n, m, one.clone()), (m, n, -Rational::ONE)] {
                let by = &turn * &sign;
                let mut add = |by: Rational, item: &Item, p: Poly| {
                    terms.push((by, vec![x[z][2].clone(), item.clone()], p));
                };
                add(by.clone(), &frame[arm][3], Poly::one());
                add(-&by, &x[arm][3], Poly::one());
                for (c, p) in offset.iter().enumerate() {
                    add(by.clone(), &frame[arm][c], p.clone()?);
                }
            }
            terms.push((slide, vec![x[k][2].clone()], Poly::one()));
        }
        let entry = self.define(&format!("j{}_{}_defined", row + 1, joint + 1), terms)?;
        self.entries.insert((view.clone(), row, joint), entry.clone());
        Ok(entry)
    }

    fn left(&mut self, quantity: &Quantity, hint: &str) -> Result<Item, Obstacle> {
        match quantity {
            Quantity::Formula(e) => self.formula(hint, *e),
            Quantity::Terms(p) => Ok(Item { name: None, value: p.clone() }),
            Quantity::Frame { from, to, place } => {
                let arm = self.certificate.arm.as_ref().map_err(|why| *why)?;
                let (a, b) = (arm.index(*from), arm.index(*to));
                Ok(self.frame(a, b, 0)?[place.0][place.1].clone())
            }
            Quantity::Jacobian { view, row, joint } => self.jacobian(view, *row, *joint),
            Quantity::Minor { view, rows, joints, along } => {
                let rest: Vec<usize> = rows.iter().copied().filter(|r| r != along).collect();
                let at = rows.iter().position(|r| r == along).unwrap_or(0);
                let mut terms = vec![];
                for (k, &joint) in joints.iter().enumerate() {
                    let known = |rows: Vec<usize>, joints: Vec<usize>| {
                        self.proved.get(&(view.clone(), rows, joints)).cloned().ok_or(Obstacle::Undefined)
                    };
                    let entry = known(vec![*along], vec![joint])?;
                    if entry.value.is_zero() {
                        continue;
                    }
                    let others = joints.iter().copied().filter(|&j| j != joint).collect();
                    let mut items = vec![entry];
                    if !rest.is_empty() {
                        items.push(known(rest.clone(), others)?);
                    }
                    terms.push((Rational::from(if (at + k) % 2 == 0 { 1 } else { -1 }), items, Poly::one()));
                }
                self.define(&format!("{hint}_defined"), terms)
            }
        }
    }

    /// A lemma: left = right. Later minors are made of `left`, with `left = right as a polynomial` for a lemma.
    fn claim(&mut self, claim: &Claim) -> Result<(), Obstacle> {
        let hint = claim.name.replace(' ', "_");
        let left = self.left(&claim.left, &hint)?;
        let (right, rewritten) = match &claim.right {
            Quantity::Formula(e) => self.written(*e),
            Quantity::Terms(p) => (polynomial(&self.certificate.field, p, &Coq), String::new()),
            _ => return Err(Obstacle::Function),
        };
        let value = match &claim.right {
            Quantity::Formula(e) => self.certificate.field.polynomial(*e)?,
            Quantity::Terms(p) => p.clone(),
            _ => return Err(Obstacle::Function),
        };
        let field = &mut self.certificate.field;
        let name = field.names.new_name(&hint);
        let (left_text, unfolded) = match &left.name {
            Some(name) => (name.clone(), format!(" rewrite ?{name}_is;")),
            None => (polynomial(field, &left.value, &Coq), String::new()),
        };
        self.out += &format!("Lemma {name} : {left_text} = {right}.\nProof.\n");
        if claim.cofactors.is_empty() {
            self.out += &format!(" {unfolded}{rewritten} field.\nQed.\n");
        } else {
            let squares: FxHashMap<Atom, Poly> = field.squares().into_iter().collect();
            let (mut sum, mut facts) = (vec![], String::new());
            for (atom, cofactor) in &claim.cofactors {
                let x = &field.atoms[usize::from(*atom)];
                let square = squares.get(atom).cloned().unwrap_or_default();
                let square = polynomial(field, &square, &Coq);
                let cofactor = polynomial(field, cofactor, &Coq);
                sum.push(format!("({cofactor})*({x}*{x} - ({square}))"));
                facts += &format!(" rewrite {x}_square;");
            }
            let sum = sum.join(" + ");
            self.out += &format!("  apply Rminus_diag_uniq. transitivity ({sum}).\n");
            self.out += &format!("  - {unfolded}{rewritten} field.\n  -{facts} ring.\nQed.\n");
        }
        self.keep(claim, &left, value, (&name, &rewritten))
    }

    /// Minors are made of what is proved of entries and smaller minors.
    fn keep(
        &mut self,
        claim: &Claim,
        left: &Item,
        value: Poly,
        (lemma, rewritten): (&str, &str),
    ) -> Result<(), Obstacle> {
        let key = match &claim.left {
            Quantity::Jacobian { view, row, joint } => (view.clone(), vec![*row], vec![*joint]),
            Quantity::Minor { view, rows, joints, .. } if rows.len() > 1 => {
                (view.clone(), rows.clone(), joints.clone())
            }
            _ => return Ok(()),
        };
        if self.proved.contains_key(&key) {
            return Ok(());
        }
        let item = match &left.name {
            None => Item { name: None, value },
            Some(of) => {
                let field = &mut self.certificate.field;
                let name = field.names.new_name(&format!("{lemma}_value"));
                let polynomial = polynomial(field, &value, &Coq);
                self.out += &format!("Definition {name} : R := {of}.\n");
                self.out += &format!("Lemma {name}_is : {name} = {polynomial}.\n");
                self.out += &format!("Proof. unfold {name}; rewrite {lemma};{rewritten} field. Qed.\n");
                Item { name: Some(name), value }
            }
        };
        self.proved.insert(key, item);
        Ok(())
    }
}
