//! Derivatives of coordinates by joints and by time: `∂x/∂θ_2`, `dx/dq1`, `\frac{d p_x}{dt}`.

use super::Walk;
use crate::jacobians::derivative;
use denavit_symbolic::Expr;
use std::ops::Range;

/// The longest quotient, in bytes.
const LONGEST: usize = 100;

impl Walk<'_> {
    /// The derivative that a side names, of what is known by a joint or by time.
    pub(super) fn derivative_named(&self, span: &Range<usize>) -> Option<Expr> {
        if let Some(found) = self.primed(span) {
            return Some(found);
        }
        let (of, by) = quotient(self.source(span))?;
        let value = |name: &str| {
            let own = self.lexis.names.lookup(name);
            own.or_else(|| self.conventional(&self.lexis.lone_name(name, &(0..name.len()))?)).or_else(|| {
                let axis = ["x", "y", "z"].iter().position(|a| *a == name)?;
                Some(self.subject.pose().translation.0[axis])
            })
        };
        let of = value(&of)?;
        let joints = self.subject.joints();
        // A joint may be called t.
        let is_joint = self.lexis.names.lookup(&by).is_some_and(|q| joints.contains(&q));
        if by == "t" && !is_joint {
            return self.by_time(of);
        }
        let by = self.lexis.names.lookup(&by).filter(|q| joints.contains(q))?;
        derivative(of, by)
    }

    fn by_time(&self, of: Expr) -> Option<Expr> {
        let (joints, rates) = (self.subject.joints(), self.subject.rates());
        let mut parts = joints.iter().zip(rates).map(|(&q, rate)| Some(derivative(of, q)? * rate));
        parts.try_fold(Expr::int(0), |sum, part| Some(sum + part?))
    }

    /// `x'` on a line with rates of joints, or a unit of velocity: the derivative by time.
    fn primed(&self, span: &Range<usize>) -> Option<Expr> {
        let source = self.source(span);
        let name = source.strip_suffix(['\'', '′'])?;
        let is_name = !name.is_empty() && name.len() < 12 && name.chars().all(char::is_alphanumeric);
        let line = self.text.get(span.end..)?.lines().next().filter(|l| is_name && l.len() < 4 * LONGEST)?;
        let rates = self.subject.rates();
        let mut words =
            line.split(|c: char| !c.is_alphanumeric() && c != '\u{307}').filter(|w| !w.is_empty());
        let is_rate = |w: &str| self.lexis.names.lookup(w).is_some_and(|e| rates.contains(&e));
        if !line.contains("/s") && !words.any(is_rate) {
            return None;
        }
        let axis = ["x", "y", "z"].iter().position(|a| *a == name.to_lowercase());
        let place = axis.map(|r| self.subject.pose().translation.0[r]);
        let of = self.lexis.names.lookup(name).or(place)?;
        self.by_time(of)
    }
}

/// The names above and below a quotient of differentials.
fn quotient(source: &str) -> Option<(String, String)> {
    if source.len() > LONGEST {
        return None;
    }
    let plain: String = source.chars().filter(|c| !c.is_whitespace() && !matches!(c, '$' | '~')).collect();
    let plain = ["\\,", "\\;", "\\!"].iter().fold(plain, |p, look| p.replace(look, ""));
    let plain = plain.replace("\\partial", "∂").replace("\\mathrm{d}", "d");
    let fraction = ["\\frac{", "\\dfrac{", "\\tfrac{"].iter().find_map(|f| plain.strip_prefix(f));
    let (above, below) = match fraction {
        Some(rest) => rest.strip_suffix('}')?.split_once("}{")?,
        None => plain.split_once('/')?,
    };
    let sign = above.chars().next().filter(|c| matches!(c, 'd' | '∂'))?;
    let (of, by) = (above.strip_prefix(sign)?, below.strip_prefix(sign)?);
    let is_name = |n: &str| {
        !n.is_empty()
            && n.len() < 24
            && n.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '{' | '}' | '\\'))
    };
    (is_name(of) && is_name(by)).then(|| (of.to_string(), by.to_string()))
}

#[cfg(test)]
mod tests {
    use super::quotient;

    #[test]
    fn quotients_of_differentials() {
        for (source, names) in [
            ("dx/dq1", Some(("x", "q1"))),
            ("∂x/∂θ2", Some(("x", "θ2"))),
            ("\\frac{\\partial p_x}{\\partial \\theta_2}", Some(("p_x", "\\theta_2"))),
            ("\\dfrac{d z}{dt}", Some(("z", "t"))),
            ("d1/d2", Some(("1", "2"))),
            ("a/b", None),
            ("x", None),
        ] {
            assert_eq!(quotient(source), names.map(|(a, b)| (a.into(), b.into())), "{source}");
        }
    }
}
