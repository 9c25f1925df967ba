//! The derivation in words and formulas, every formula proved.

mod reading;

pub fn dump(m: &super::InverseModel) {
    use super::Form;
    use denavit_symbolic::print::{print, Style};
    let names = m.description.vocabulary();
    let r = reading::Reading::new(&m.chain, &m.given, &m.steps);
    let show = |e| print(e, &names, Style::Unicode);
    println!("== {} given {:?} rank {}", m.description.name, m.given, m.rank);
    for (k, e) in m.chain.elements.iter().enumerate() {
        match e {
            super::Element::Axis(k) => println!("  axis {k} {:?}", m.chain.axes[*k].motion),
            super::Element::Constant(rot, p) => println!("  {k}: const {:?} {:?}", rot.each_ref().map(|x| x.each_ref().map(|p| show(r.plain(p)))), p.each_ref().map(|p| show(r.plain(p)))),
        }
    }
    for (s, label) in m.steps.iter().zip(&m.labels) {
        println!("- {} {:?} {:?}", m.chain.describe(s.unknown), label, s.cost);
        for row in &s.rows {
            println!("   {:?}\n      ({}) C + ({}) S = {}", row.origin, show(r.plain(&row.a)), show(r.plain(&row.b)), show(r.norm(&row.c, &|_| None)));
        }
        match &s.form {
            Form::Ratio { numerator, denominator } => println!("   {:?}\n     ({}) r = {}", s.origins, show(r.plain(denominator)), show(r.plain(numerator))),
            Form::Quadratic { a, b, c } => println!("   {:?}\n     ({}) r² + 2({}) r + {}", s.origins, show(r.plain(a)), show(r.plain(b)), show(r.norm(c, &|_| None))),
            Form::Quartic(all) => println!("  {:?}\n  quartic {:?}", s.origins, all.each_ref().map(|x| show(r.norm(x, &|_| None)))),
            f => println!("   {f:?}"),
        }
    }
}
