//! Statements in the order in which a person would write them: what results have in common first, then the results
//! row by row.

use crate::listing::{Listing, Statement};
use crate::names::Names;
use denavit_symbolic::{Expr, Node, Symbol};
use rustc_hash::{FxHashMap, FxHashSet};

/// Some statements and the results that follow them.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Block {
    pub statements: Vec<Statement>,
    /// Places in row-major order, and what stands there.
    pub results: Vec<(usize, Expr)>,
}

/// The body of a listing as one block for each first index of the results, or one block for a matrix. A result that
/// nothing else reads has no name: its formula stands in its place.
///
/// `inputs` are the variables in order: sines and cosines follow them. An angle sum whose sine and cosine are both
/// taken gets a name.
pub(crate) fn blocks(listing: &Listing, shape: &[usize], inputs: &[Symbol], names: &mut Names) -> Vec<Block> {
    let mut uses: FxHashMap<Symbol, u32> = FxHashMap::default();
    let read = listing.body.iter().map(read_by).chain(listing.results.iter().copied());
    for symbol in read.flat_map(|e| e.symbols()) {
        *uses.entry(symbol).or_default() += 1;
    }
    let places: FxHashMap<Symbol, usize> = (0..).zip(&listing.body).flat_map(defined).collect();
    let in_place = |e: Expr| -> Option<(usize, Expr)> {
        let symbol = e.as_symbol().filter(|s| uses[s] == 1)?;
        let place = *places.get(&symbol)?;
        match &listing.body[place] {
            Statement::Let { value, .. } => Some((place, *value)),
            Statement::Pair { .. } => None,
        }
    };

    // Sines and cosines of inputs stand in front of everything.
    let of_inputs = |statement: &&Statement| match statement {
        Statement::Pair { angle, .. } => angle.symbols().iter().all(|s| !places.contains_key(s)),
        Statement::Let { .. } => false,
    };
    let opening = listing.body.iter().take_while(of_inputs).count();
    let mut written: FxHashSet<usize> = (0..opening).collect();
    let mut ahead: Vec<Statement> = listing.body[..opening].to_vec();
    ahead.sort_by_cached_key(|statement| {
        let symbols = read_by(statement).symbols();
        let mut places: Vec<_> = symbols.iter().map(|s| inputs.iter().position(|i| i == s)).collect();
        places.sort_unstable();
        places
    });

    let group = if shape.len() > 2 { shape[1..].iter().product() } else { listing.results.len() };
    let mut blocks = vec![];
    for (g, results) in listing.results.chunks(group.max(1)).enumerate() {
        let mut own = vec![];
        for (k, &result) in results.iter().enumerate() {
            let value = in_place(result).map_or(result, |(place, value)| {
                written.insert(place);
                value
            });
            own.push((g * group + k, value));
        }
        let mut needed: FxHashSet<usize> = FxHashSet::default();
        let mut pending: Vec<Symbol> = own.iter().flat_map(|r| r.1.symbols()).collect();
        while let Some(symbol) = pending.pop() {
            let place = places.get(&symbol).filter(|p| !written.contains(p) && needed.insert(**p));
            pending.extend(place.into_iter().flat_map(|&p| read_by(&listing.body[p]).symbols()));
        }
        let mut needed: Vec<usize> = needed.into_iter().collect();
        needed.sort_unstable();
        let mut statements = std::mem::take(&mut ahead);
        statements.extend(needed.iter().map(|&place| listing.body[place].clone()));
        written.extend(needed);
        blocks.push(Block { statements, results: own });
    }
    let mut sums = vec![];
    for block in &mut blocks {
        let statements = std::mem::take(&mut block.statements).into_iter();
        block.statements = statements.flat_map(|s| with_named_sum(s, &mut sums, names)).collect();
    }
    blocks
}

/// A sine and cosine behind the sum that both read; `sums` are those that have names.
fn with_named_sum(statement: Statement, sums: &mut Vec<(Expr, Expr)>, names: &mut Names) -> Vec<Statement> {
    let Statement::Pair { angle, sine: Some(sine), cosine } = &statement else { return vec![statement] };
    if cosine.is_none() || angle.as_symbol().is_some() {
        return vec![statement];
    }
    let index = &sine[1..];
    let first = angle.symbols().first().map(|s| s.name().to_string()).unwrap_or_default();
    let wanted = match index.strip_prefix('a') {
        Some(number) => format!("angle{number}"),
        None if index.starts_with('_') => format!("angle{index}"),
        None => format!("{}{index}", first.trim_end_matches(|c: char| c.is_ascii_digit())),
    };
    let name = names.fresh(&wanted);
    let known = |e: Expr| sums.iter().find(|sum| sum.0 == e).map_or(e, |sum| sum.1);
    let value = match angle.node() {
        Node::Add(a, b) => known(a) + known(b),
        Node::Sub(a, b) => known(a) - known(b),
        _ => *angle,
    };
    let symbol = Expr::symbol(&name);
    sums.push((*angle, symbol));
    let pair = Statement::Pair { angle: symbol, sine: Some(sine.clone()), cosine: cosine.clone() };
    vec![Statement::Let { name, value }, pair]
}

/// The inputs and names that statements and results read.
pub(crate) fn reads(listing: &Listing) -> FxHashSet<Symbol> {
    let statements = listing.hoisted.iter().chain(&listing.body);
    let read = statements.map(read_by).chain(listing.results.iter().copied());
    read.flat_map(|e| e.symbols()).collect()
}

fn read_by(statement: &Statement) -> Expr {
    match statement {
        Statement::Pair { angle, .. } => *angle,
        Statement::Let { value, .. } => *value,
    }
}

/// The names that a statement defines, with its place.
fn defined((place, statement): (usize, &Statement)) -> Vec<(Symbol, usize)> {
    let names = match statement {
        Statement::Pair { sine, cosine, .. } => [sine.as_ref(), cosine.as_ref()],
        Statement::Let { name, .. } => [Some(name), None],
    };
    names.into_iter().flatten().map(|name| (Symbol::new(name), place)).collect()
}
