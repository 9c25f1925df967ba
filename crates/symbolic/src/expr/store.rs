//! Where the nodes of expressions live: in a store of the thread, or in one that a piece of work has to itself.

use super::Node;
use rustc_hash::FxHashMap;
use std::cell::RefCell;
use std::rc::Rc;

/// Nodes and names, each once.
#[derive(Default)]
struct Store {
    nodes: Vec<Node>,
    ids: FxHashMap<Node, u32>,
    names: Vec<Rc<str>>,
    symbols: FxHashMap<Rc<str>, u32>,
}

thread_local! {
    static STORE: RefCell<Store> = RefCell::default();
}

/// The number of a node.
pub(super) fn intern(node: Node) -> u32 {
    STORE.with_borrow_mut(|s| {
        if let Some(&id) = s.ids.get(&node) {
            return id;
        }
        let id = u32::try_from(s.nodes.len()).expect("fewer than 2^32 expressions in a store");
        s.nodes.push(node.clone());
        s.ids.insert(node, id);
        id
    })
}

/// The node with a number.
pub(super) fn node(id: u32) -> Node {
    STORE.with_borrow(|s| s.nodes[id as usize].clone())
}

/// The number of a name.
pub(super) fn intern_name(name: &str) -> u32 {
    STORE.with_borrow_mut(|s| {
        if let Some(&id) = s.symbols.get(name) {
            return id;
        }
        let id = u32::try_from(s.names.len()).expect("fewer than 2^32 symbols in a store");
        let name: Rc<str> = name.into();
        s.names.push(name.clone());
        s.symbols.insert(name, id);
        id
    })
}

/// The name with a number.
pub(super) fn name(id: u32) -> Rc<str> {
    STORE.with_borrow(|s| s.names[id as usize].clone())
}

/// Does a piece of work in a store of its own, which is dropped behind it. A process that lives long wraps its
/// derivations in it; otherwise every expression stays until the thread ends.
///
/// As if the work were done on another thread, no [`Expr`](super::Expr) and no [`Symbol`](super::Symbol) goes in or
/// comes out: neither is `Send`. Texts and numbers go in; texts, numbers and what was compiled come out.
///
/// ```
/// use denavit_symbolic::{Expr, scoped, store_size};
/// let before = store_size();
/// let text = scoped(|| {
///     let x = Expr::symbol("x");
///     (x.sin() * x.cos()).to_string()
/// });
/// assert_eq!(text, "sin(x)*cos(x)");
/// assert_eq!(store_size(), before);
/// ```
///
/// A handle that leaves is refused by the compiler, and so is one that enters:
///
/// ```compile_fail,E0277
/// # use denavit_symbolic::{Expr, scoped};
/// let x = scoped(|| Expr::symbol("x"));
/// ```
///
/// ```compile_fail,E0277
/// # use denavit_symbolic::{Expr, scoped};
/// let x = Expr::symbol("x");
/// let text = scoped(|| x.to_string());
/// ```
///
/// (A `thread_local` that keeps handles of its own is beyond the compiler; such handles mean nothing inside.)
pub fn scoped<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    let _outer = Outer(STORE.take());
    work()
}

/// How many expressions the store in use holds.
pub fn store_size() -> usize {
    STORE.with_borrow(|s| s.nodes.len())
}

/// The store that was in use before; it comes back however the work ends.
struct Outer(Store);

impl Drop for Outer {
    fn drop(&mut self) {
        STORE.set(std::mem::take(&mut self.0));
    }
}

#[cfg(test)]
mod tests {
    use super::{scoped, store_size};
    use crate::expr::{Expr, Symbol};

    #[test]
    fn the_outer_store_comes_back() {
        let [x, y] = ["x", "y"].map(Expr::symbol);
        let (sum, size) = (x + y, store_size());
        let inside = scoped(|| {
            let text = (Expr::symbol("z") + Expr::symbol("y")).to_string();
            (text, scoped(store_size), store_size())
        });
        assert_eq!(inside, ("z + y".to_string(), 0, 3));
        assert_eq!((sum.to_string(), x + y, store_size()), ("x + y".to_string(), sum, size));
        assert_eq!(&*Symbol::new("x").name(), "x");
    }

    #[test]
    fn the_outer_store_comes_back_after_a_panic() {
        let sum = Expr::symbol("a") + Expr::symbol("b");
        let result = std::panic::catch_unwind(|| scoped(|| -> u8 { panic!("{}", Expr::symbol("c")) }));
        assert!(result.is_err());
        assert_eq!(sum.to_string(), "a + b");
    }
}
