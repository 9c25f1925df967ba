//! A study of slips: the correct models of twelve robots as documents, each with one slip made at random, are held
//! against the robots. Every slip is found, nearly all are mended, and nothing that is right is called wrong.

use crate::common::{Random, robot, share};
use denavit::description::JointKind;
use denavit::forward::{ForwardModel, Outputs, Reference};
use denavit::geometry::Transform;
use denavit::{Description, Robot};
use denavit_check::{CheckOptions, Checked, Entry, Finding, Standing, check};
use denavit_reading::document::Format;
use denavit_symbolic::parse::{Syntax, SyntaxKind, parse, parse_syntax};
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Equality, Expr, Node, equal};
use std::sync::Mutex;
use std::time::Instant;

const ROBOTS: [&str; 12] = [
    "staubli-rx90",
    "stanford",
    "prrrrp",
    "ur5",
    "scara",
    "puma560",
    "cylindrical-wrist",
    "kuka-iiwa-14",
    "planar-3r",
    "gantry-wrist",
    "franka-panda",
    "smart5-six-rail",
];
const KINDS: [&str; 8] = [
    "sign",
    "sine and cosine",
    "missing factor",
    "extra factor",
    "wrong index",
    "bracket moved",
    "lost term",
    "transposed entries",
];
/// Slips of each kind in each robot.
const SLIPS: usize = 200;
/// Longer formulas than this are in no document.
const LONGEST: usize = 1_500;
const COLUMNS: [&str; 4] = ["n", "o", "a", "p"];
const AXES: [&str; 3] = ["x", "y", "z"];

/// What a document states: a matrix, or one entry of it.
struct Sheet {
    style: Style,
    /// `T_{03}` or `n_x`.
    name: String,
    /// Tells what the name of an entry means where custom does not.
    claim: Option<String>,
    rows: Vec<Vec<Cell>>,
}

#[derive(Clone)]
struct Cell {
    text: String,
    right: Expr,
}

impl Sheet {
    fn is_matrix(&self) -> bool {
        self.rows.len() > 1
    }

    /// The document, with the cells given printed otherwise.
    fn document(&self, changed: &[(usize, usize, String)]) -> (String, Format) {
        let cell = |r: usize, c: usize| {
            let other = changed.iter().find(|x| (x.0, x.1) == (r, c));
            other.map_or(self.rows[r][c].text.as_str(), |x| &x.2)
        };
        let row = |r: usize, mark: &str| {
            let cells: Vec<&str> = (0..self.rows[r].len()).map(|c| cell(r, c)).collect();
            cells.join(mark)
        };
        let rows = |inner: &str, outer: &str| {
            (0..self.rows.len()).map(|r| row(r, inner)).collect::<Vec<_>>().join(outer)
        };
        let body = match (self.style, self.is_matrix()) {
            (_, false) => cell(0, 0).to_string(),
            (Style::Ascii, true) => format!("[{}]", rows(", ", ";\n  ")),
            _ => format!("\\begin{{bmatrix}} {} \\end{{bmatrix}}", rows(" & ", " \\\\\n")),
        };
        let name = &self.name;
        let claim = |open: &str, close: &str| {
            self.claim.as_ref().map_or(String::new(), |c| format!("{open} check: claim {c}{close}\n\n"))
        };
        match self.style {
            Style::Ascii => (format!("{}{name} = {body}\n", claim("#", "")), Format::Plain),
            Style::Unicode => {
                (format!("{}$$\n{name} = {body}\n$$\n", claim("<!--", " -->")), Format::Markdown)
            }
            _ => (format!("{}\\[ {name} = {body} \\]\n", claim("%", "")), Format::Latex),
        }
    }
}

/// A robot, its documents, and what it is made of.
struct Study {
    name: &'static str,
    description: Description,
    names: Vocabulary,
    sheets: Vec<Sheet>,
    atoms: Vec<Expr>,
}

impl Study {
    fn new(name: &'static str) -> Self {
        let description = robot(name);
        let names = description.vocabulary();
        let n = description.rows.len();
        let mut models: Vec<(String, Option<String>, [[Expr; 4]; 4])> = vec![];
        let derived = |from: Reference, to: Reference| {
            ForwardModel::derive(&description, from, to, Outputs::ALL).matrix
        };
        if let Ok(pose) = derived(Reference::Base, Reference::Tool) {
            models.push(("T".into(), None, pose));
        }
        let mut parts = vec![(0, 2), (0, 3.min(n)), (1, n.min(4)), (n.saturating_sub(3), n)];
        parts.sort_unstable();
        parts.dedup();
        let chain = Robot::symbolic(&description);
        let q: Vec<Expr> = description.variables().iter().map(|v| v.symbol.into()).collect();
        for (i, j) in parts {
            let left = format!("T_{{{i}{j}}}");
            let claim = Some(format!("T{i}{j}"));
            if let Ok(matrix) = derived(Reference::Frame(i), Reference::Frame(j)) {
                models.push((left.clone(), claim.clone(), matrix));
            }
            // As the product leaves it, worked out from the right.
            let links = chain.links[i..j].iter().rev();
            let nested = links.fold(Transform::identity(), |x, link| link.transform(&q) * x);
            models.push((left, claim, nested.matrix()));
        }
        let mut sheets = vec![];
        for style in [Style::Ascii, Style::Unicode, Style::Latex] {
            for (left, claim, matrix) in &models {
                let cell = |&right: &Expr| Cell { text: print(right, &names, style), right };
                let rows: Vec<Vec<Cell>> = matrix.iter().map(|r| r.iter().map(cell).collect()).collect();
                let is_short = |c: &Cell| c.text.len() <= LONGEST;
                for (r, row) in rows.iter().enumerate().take(3) {
                    for (c, cell) in row.iter().enumerate() {
                        let (name, claim) = match claim {
                            None => (format!("{}_{}", COLUMNS[c], AXES[r]), None),
                            Some(t) => ("w".to_string(), Some(format!("{t} {},{}", r + 1, c + 1))),
                        };
                        if is_short(cell) && !cell.right.symbols().is_empty() {
                            sheets.push(Sheet { style, name, claim, rows: vec![vec![cell.clone()]] });
                        }
                    }
                }
                if rows.iter().flatten().all(is_short) {
                    sheets.push(Sheet { style, name: left.clone(), claim: None, rows });
                }
            }
        }
        let rights: Vec<Expr> = sheets.iter().flat_map(|s| &s.rows).flatten().map(|c| c.right).collect();
        let mut atoms: Vec<Expr> = Expr::postorder(&rights)
            .into_iter()
            .filter(|e| match e.node() {
                Node::Sin(_) | Node::Cos(_) => true,
                Node::Symbol(s) => {
                    let is_angle = description
                        .variables()
                        .iter()
                        .any(|v| v.symbol == s && v.kind == JointKind::Revolute);
                    !is_angle
                }
                _ => false,
            })
            .collect();
        atoms.sort_by_key(|a| print(*a, &names, Style::Ascii));
        Study { name, description, names, sheets, atoms }
    }

    fn check(&self, text: &str, format: Format) -> Checked {
        check(text, format, Some(&self.description), &CheckOptions::default())
            .unwrap_or_else(|e| panic!("{}: {e:?}\n{text}", self.name))
    }

    fn read(&self, text: &str) -> Option<Syntax> {
        parse_syntax(text, &self.names).ok()
    }

    /// The cell at a place of a sheet with one slip of a kind that changes its value.
    fn slip(&self, kind: usize, sheet: &Sheet, cell: &Cell, draw: &mut Draw) -> Option<String> {
        let syntax = self.read(&cell.text)?;
        let text = self.made(kind, sheet.style, &cell.text, &syntax, draw)?;
        let value = self.read(&text)?.value();
        matches!(equal(value, cell.right), Equality::Different { .. }).then_some(text)
    }

    fn made(
        &self,
        kind: usize,
        style: Style,
        text: &str,
        syntax: &Syntax,
        draw: &mut Draw,
    ) -> Option<String> {
        let all = parts(syntax);
        let shown = |e: Expr| print(e, &self.names, style);
        let products = || {
            let factors = all.iter().filter_map(|p| match &p.kind {
                SyntaxKind::Product(factors) if factors.iter().all(|f| !f.0) => Some(factors),
                _ => None,
            });
            factors.collect::<Vec<_>>()
        };
        let sums = || {
            let sums = all.iter().filter_map(|p| match &p.kind {
                SyntaxKind::Sum(terms) => Some((p.span.start, terms)),
                _ => None,
            });
            sums.collect::<Vec<_>>()
        };
        let names: Vec<&Syntax> = all
            .iter()
            .copied()
            .filter(|p| matches!(p.kind, SyntaxKind::Name(_) | SyntaxKind::Call(..)))
            .collect();
        match kind {
            0 => {
                // Of every term, and of what has no sign yet.
                let mut places: Vec<(usize, usize)> = vec![];
                for (start, terms) in sums() {
                    for (i, (_, term)) in terms.iter().enumerate() {
                        let from = if i == 0 { start } else { terms[i - 1].1.span.end };
                        places.push((from, term.span.start));
                    }
                }
                if !matches!(syntax.kind, SyntaxKind::Sum(_)) {
                    places.push((0, 0));
                }
                let &(from, to) = draw.of(&places)?;
                let sign = text[from..to].char_indices().find(|c| matches!(c.1, '+' | '-' | '−'));
                Some(match sign {
                    None => spliced(text, to, to, "-"),
                    Some((at, '+')) => spliced(text, from + at, from + at + 1, "-"),
                    Some((at, c)) => {
                        // A leading sign goes, one between terms turns.
                        let is_leading = text[..from + at].trim_end().is_empty()
                            || text[..from + at].trim_end().ends_with(['(', '{']);
                        spliced(text, from + at, from + at + c.len_utf8(), if is_leading { "" } else { "+" })
                    }
                })
            }
            1 | 4 => {
                let name = draw.of(&names)?;
                let e = name.value();
                let is_other = |a: &&Expr| match (e.node(), a.node()) {
                    (Node::Sin(x), Node::Sin(y)) | (Node::Cos(x), Node::Cos(y)) => x != y,
                    (Node::Symbol(a), Node::Symbol(b)) => a != b && a.name()[..1] == b.name()[..1],
                    _ => false,
                };
                let now = match (kind, e.node()) {
                    (1, Node::Sin(x)) => x.cos(),
                    (1, Node::Cos(x)) => x.sin(),
                    (1, _) => return None,
                    _ => {
                        let others: Vec<&Expr> = self.atoms.iter().filter(is_other).collect();
                        **draw.of(&others)?
                    }
                };
                Some(spliced(text, name.span.start, name.span.end, &shown(now)))
            }
            2 => {
                let products = products();
                let factors = draw.of(&products)?;
                let i = draw.below(factors.len());
                let span = match i {
                    0 => factors[0].1.span.start..factors.get(1)?.1.span.start,
                    _ => factors[i - 1].1.span.end..factors[i].1.span.end,
                };
                Some(spliced(text, span.start, span.end, ""))
            }
            3 => {
                let beside = all.iter().filter(|p| {
                    matches!(p.kind, SyntaxKind::Name(_) | SyntaxKind::Call(..) | SyntaxKind::Bracket(_))
                });
                let beside: Vec<_> = beside.collect();
                let at = draw.of(&beside)?.span.start;
                let gap = match style {
                    Style::Ascii => "*",
                    Style::Unicode => "·",
                    _ => " ",
                };
                Some(spliced(text, at, at, &format!("{}{gap}", shown(*draw.of(&self.atoms)?))))
            }
            5 => {
                let brackets: Vec<_> =
                    all.iter().filter(|p| matches!(p.kind, SyntaxKind::Bracket(_))).collect();
                let bracket = draw.of(&brackets)?;
                let own = &text[bracket.span.clone()];
                let is_open = draw.below(2) == 0;
                let is_sized = text[..bracket.span.start].ends_with("\\left") || own.starts_with("\\left(");
                let (open, close) = if is_sized { ("\\left(", "\\right)") } else { ("(", ")") };
                let mark = if is_open { open } else { close };
                let start = text[..=bracket.span.start + own.find('(')?].rfind(open)?;
                let at = if is_open { start } else { bracket.span.end - close.len() };
                if !text[at..].starts_with(mark) {
                    return None;
                }
                let ends = names.iter().map(|n| if is_open { n.span.start } else { n.span.end });
                let ends: Vec<usize> = ends.filter(|e| *e != at && *e != at + mark.len()).collect();
                let to = *draw.of(&ends)?;
                let without = spliced(text, at, at + mark.len(), "");
                let to = if to > at { to - mark.len() } else { to };
                Some(spliced(&without, to, to, mark))
            }
            6 => {
                let sums: Vec<_> = sums().into_iter().filter(|s| s.1.len() > 1).collect();
                let (start, terms) = draw.of(&sums)?;
                let i = draw.below(terms.len());
                Some(match i {
                    0 => {
                        let next = &text[terms[0].1.span.end..terms[1].1.span.start];
                        let minus = next.chars().find(|c| matches!(c, '-' | '−'));
                        let sign = minus.map_or(String::new(), |c| c.to_string());
                        spliced(text, *start, terms[1].1.span.start, &sign)
                    }
                    _ => spliced(text, terms[i - 1].1.span.end, terms[i].1.span.end, ""),
                })
            }
            _ => None,
        }
    }

    /// A sheet with one slip: what is changed, and what stands there in the end.
    fn changed(&self, kind: usize, draw: &mut Draw) -> Option<(&Sheet, Vec<Change>)> {
        for _ in 0..5_000 {
            let sheet = draw.of(&self.sheets)?;
            let (r, c) = (draw.below(sheet.rows.len()), draw.below(sheet.rows[0].len()));
            if kind == 7 {
                let is_pair = sheet.is_matrix() && c < r;
                if !is_pair {
                    continue;
                }
                let (a, b) = (&sheet.rows[r][c], &sheet.rows[c][r]);
                if matches!(equal(a.right, b.right), Equality::Different { .. }) {
                    return Some((sheet, vec![(r, c, b.text.clone()), (c, r, a.text.clone())]));
                }
                continue;
            }
            if let Some(text) = self.slip(kind, sheet, &sheet.rows[r][c], draw) {
                return Some((sheet, vec![(r, c, text)]));
            }
        }
        None
    }

    /// True if a formula in print is proved equal to the right one.
    fn is_right(&self, text: &str, right: Expr) -> bool {
        // What slides may be called as the table calls it: d3.
        let letter = self.description.convention.length_z();
        let rows = (1..).zip(&self.description.rows);
        let names = rows.fold(self.names.clone(), |names, (i, row)| match row.variable {
            Some(v) if v.kind == JointKind::Prismatic && names.lookup(&format!("{letter}{i}")).is_none() => {
                names.alias(&format!("{letter}{i}"), v.symbol.into())
            }
            _ => names,
        });
        parse(text, &names).is_ok_and(|e| equal(e, right).is_equal())
    }
}

/// What stands in an entry in the end: its row, its column, its text.
type Change = (usize, usize, String);

/// Numbers at random, the same ones every time.
struct Draw(Random);

impl Draw {
    fn below(&mut self, n: usize) -> usize {
        (self.0.unit() * n as f64) as usize
    }

    fn of<'a, T>(&mut self, from: &'a [T]) -> Option<&'a T> {
        (!from.is_empty()).then(|| &from[self.below(from.len())])
    }
}

fn parts(syntax: &Syntax) -> Vec<&Syntax> {
    let mut all = vec![syntax];
    let mut next = 0;
    while next < all.len() {
        all.extend(all[next].children());
        next += 1;
    }
    all
}

fn spliced(text: &str, from: usize, to: usize, now: &str) -> String {
    format!("{}{now}{}", &text[..from], &text[to..])
}

/// The text as a row of marks, without blanks.
fn marks(text: &str) -> String {
    let dropped = |c: &char| c.is_whitespace() || matches!(c, '{' | '}' | '_' | '*' | '·');
    text.replace("\\left", "")
        .replace("\\right", "")
        .replace('−', "-")
        .chars()
        .filter(|c| !dropped(c))
        .collect()
}

/// What became of the slips of one kind.
#[derive(Clone, Copy, Default)]
struct Count {
    slips: usize,
    detected: usize,
    /// The change that is proposed makes it right.
    mended: usize,
    /// It does so to the letter.
    verbatim: usize,
    /// The right formula is told, if not as a change.
    told: usize,
    /// What is right was called wrong.
    accused: usize,
    time: f64,
    slowest: f64,
}

impl Count {
    fn with(&mut self, o: &Count) {
        self.slips += o.slips;
        self.detected += o.detected;
        self.mended += o.mended;
        self.verbatim += o.verbatim;
        self.told += o.told;
        self.accused += o.accused;
        self.time += o.time;
        self.slowest = self.slowest.max(o.slowest);
    }
}

fn study(name: &'static str, count: usize) -> [Count; 8] {
    let before = Instant::now();
    let study = Study::new(name);
    let shows = std::env::var_os("SLIP_STUDY").is_some();
    let built = before.elapsed().as_secs_f64();
    let mut slowest = 0.0_f64;
    for sheet in &study.sheets {
        let (text, format) = sheet.document(&[]);
        let before = Instant::now();
        let checked = study.check(&text, format);
        slowest = slowest.max(before.elapsed().as_secs_f64());
        let expected: usize = sheet.rows.iter().map(Vec::len).sum();
        let tally = checked.tally();
        let entries: usize = checked.claims.iter().map(|c| c.entries.len()).sum();
        assert_eq!(
            (tally.equal, checked.claims.len(), entries),
            (1, 1, expected),
            "{name}: {text}\n{checked:#?}"
        );
    }
    println!("{name}: {} documents in {built:.1} s, right ones {slowest:.2} s at most", study.sheets.len());
    let mut draw =
        Draw(Random(name.bytes().fold(7, |s: u64, b| s.wrapping_mul(31).wrapping_add(u64::from(b)))));
    let mut counts = [Count::default(); 8];
    for (kind, found) in counts.iter_mut().enumerate() {
        for _ in 0..count {
            let Some((sheet, changed)) = study.changed(kind, &mut draw) else { break };
            let (text, format) = sheet.document(&changed);
            let before = Instant::now();
            let checked = study.check(&text, format);
            let took = before.elapsed().as_secs_f64();
            found.time += took;
            found.slowest = found.slowest.max(took);
            found.slips += 1;
            let place = |e: &Entry| e.place.map_or((0, 0), |(r, c)| (r - 1, c - 1));
            let entries: Vec<&Entry> = checked.claims.iter().flat_map(|c| &c.entries).collect();
            let is_changed = |e: &Entry| changed.iter().any(|x| (x.0, x.1) == place(e));
            let (wrong, others): (Vec<&Entry>, Vec<&Entry>) =
                entries.into_iter().partition(|e| is_changed(e));
            found.accused += others.iter().filter(|e| e.finding.standing() != Standing::Equal).count();
            let is_detected =
                wrong.len() == changed.len() && wrong.iter().all(|e| e.finding.standing() == Standing::Wrong);
            found.detected += usize::from(is_detected);
            let each = |test: &dyn Fn(&Cell, &str, bool) -> bool| {
                wrong.iter().all(|e| {
                    let (r, c) = place(e);
                    let cell = &sheet.rows[r][c];
                    match &e.finding {
                        Finding::Wrong(w) => {
                            w.slip.as_ref().is_some_and(|s| test(cell, &s.formula, true))
                                || w.correct.first().is_some_and(|s| test(cell, s, false))
                        }
                        _ => false,
                    }
                })
            };
            let is_mended =
                is_detected && each(&|cell, text, is_slip| is_slip && study.is_right(text, cell.right));
            let is_verbatim =
                is_mended && each(&|cell, text, is_slip| is_slip && marks(text) == marks(&cell.text));
            found.mended += usize::from(is_mended);
            found.verbatim += usize::from(is_verbatim);
            found.told += usize::from(is_detected && each(&|cell, text, _| study.is_right(text, cell.right)));
            if shows && !is_mended || took > 1.0 {
                println!(
                    "{name}, {}, {took:.2} s, detected: {is_detected}, sheet {}",
                    KINDS[kind], sheet.name
                );
                for (r, c, now) in &changed {
                    println!("  right   {}\n  printed {now}", sheet.rows[*r][*c].text);
                }
                for e in &wrong {
                    match &e.finding {
                        Finding::Wrong(w) => println!("  slip    {:?}\n  correct {:?}", w.slip, w.correct),
                        other => println!("  {other:?}"),
                    }
                }
            }
        }
    }
    counts
}

#[test]
fn slips_in_correct_models_are_found_and_mended() {
    let count = share(SLIPS, SLIPS / 10);
    let count = std::env::var("SLIPS").ok().and_then(|n| n.parse().ok()).unwrap_or(count);
    let only = std::env::var("ROBOT").ok();
    let robots: Vec<&'static str> =
        ROBOTS.into_iter().filter(|r| only.as_ref().is_none_or(|o| o == r)).collect();
    let next = Mutex::new(0);
    let results: Mutex<Vec<(&str, [Count; 8])>> = Mutex::new(vec![]);
    let workers = std::thread::available_parallelism().map_or(1, |n| n.get());
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                loop {
                    let i = {
                        let mut next = next.lock().expect("no panic");
                        *next += 1;
                        *next - 1
                    };
                    let Some(&name) = robots.get(i) else { break };
                    // Formulas live as long as their thread.
                    let counts =
                        std::thread::spawn(move || study(name, count)).join().expect("the study ends");
                    results.lock().expect("no panic").push((name, counts));
                }
            });
        }
    });
    let results = results.into_inner().expect("no panic");
    println!(
        "kind                slips detected mended   told to the letter accused  worst robot (mended)          mean   slowest"
    );
    let mut all = [Count::default(); 8];
    for (kind, total) in all.iter_mut().enumerate() {
        for (_, counts) in &results {
            total.with(&counts[kind]);
        }
        let rate = |c: &Count| c.mended as f64 / c.slips.max(1) as f64;
        let worst = results
            .iter()
            .filter(|r| r.1[kind].slips > 0)
            .min_by(|a, b| rate(&a.1[kind]).total_cmp(&rate(&b.1[kind])));
        let worst = worst.map_or(String::new(), |(n, c)| format!("{n} {}/{}", c[kind].mended, c[kind].slips));
        println!(
            "{:18} {:6} {:8} {:6} {:6} {:13} {:7}  {worst:28} {:5.0} ms {:5.0} ms",
            KINDS[kind],
            total.slips,
            total.detected,
            total.mended,
            total.told,
            total.verbatim,
            total.accused,
            1e3 * total.time / total.slips.max(1) as f64,
            1e3 * total.slowest,
        );
    }
    for (name, counts) in &results {
        let slips: Vec<usize> = counts.iter().map(|c| c.slips).collect();
        let slowest = counts.iter().map(|c| c.slowest).fold(0.0, f64::max);
        println!("{name:18} slips {slips:?}, slowest {:.0} ms", 1e3 * slowest);
    }
    for (kind, c) in KINDS.iter().zip(all) {
        assert!(c.slips > 0, "{kind}");
        assert_eq!((c.detected, c.accused), (c.slips, 0), "{kind}");
        assert!(100 * c.mended >= 95 * c.slips, "{kind}: {} of {}", c.mended, c.slips);
        assert!(c.slowest < 20.0, "{kind}: {} s", c.slowest);
    }
}
