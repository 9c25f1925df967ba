//! Prints `src/stewart/forty.txt`: the solutions from which those of all platforms are followed.

use denavit_parallel::stewart::start::{monodromy, norm};

fn main() {
    for x in monodromy() {
        let n = norm(&x);
        let parts: Vec<String> =
            x.iter().flat_map(|z| [z.re / n, z.im / n]).map(|v| format!("{v:?}")).collect();
        println!("{}", parts.join(" "));
    }
}
