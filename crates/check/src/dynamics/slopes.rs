//! Derivatives of energies on a side of a statement.

use super::quantity::Quantity;
use super::statements::Reader;
use crate::lexis::read;
use denavit_symbolic::Symbol;
use std::ops::Range;

impl Reader<'_> {
    /// The derivative of an energy that a side names: `\frac{d}{dt}\frac{\partial L}{\partial \dot\theta_1}`.
    pub(super) fn derivative(&self, span: &Range<usize>) -> Option<Quantity> {
        let source = self.text.get(span.clone())?;
        if source.len() > 200 {
            return None;
        }
        let mut plain: String = source.chars().filter(|c| !c.is_whitespace()).collect();
        for (look, now) in [
            ("\\partial", "∂"),
            ("\\mathrm{d}", "d"),
            ("\\dfrac", "\\frac"),
            ("\\tfrac", "\\frac"),
            ("\\left", ""),
            ("\\right", ""),
            ("\\bigl", ""),
            ("\\bigr", ""),
            ("\\Bigl", ""),
            ("\\Bigr", ""),
            ("\\mathcal{L}", "L"),
            ("\\mathcal{T}", "T"),
            ("\\mathcal{K}", "K"),
            ("\\mathcal{U}", "U"),
            ("\\mathcal{P}", "P"),
            ("\\,", ""),
            ("\\;", ""),
            ("\\!", ""),
        ] {
            plain = plain.replace(look, now);
        }
        let rate = ["\\frac{d}{dt}", "d/dt"].iter().find_map(|r| plain.strip_prefix(r));
        let (is_rate, rest) = match rate {
            Some(rest) => (true, rest),
            None => (false, plain.as_str()),
        };
        let rest = rest.strip_prefix(['(', '[']).and_then(|r| r.strip_suffix([')', ']'])).unwrap_or(rest);
        let (above, below) = match rest.strip_prefix("\\frac{∂") {
            Some(rest) => rest.strip_suffix('}')?.split_once("}{∂")?,
            None => rest.strip_prefix('∂')?.split_once("/∂")?,
        };
        let by = read(below, &(0..below.len()), &self.read.vocabulary).ok()?.value().as_symbol()?;
        let place = |all: &[Symbol]| all.iter().position(|s| *s == by);
        let is_kinetic = matches!(above, "T" | "K" | "E_c" | "E_k" | "E_{c}" | "E_{k}" | "k");
        let is_potential = matches!(above, "U" | "V" | "P" | "E_p" | "E_{p}" | "u");
        Some(match (above, place(&self.state.qd), place(&self.state.q)) {
            ("L", Some(i), _) if is_rate => Quantity::MomentumRate(i),
            (_, Some(i), _) if is_rate && is_kinetic => Quantity::MomentumRate(i),
            ("L", Some(i), _) => Quantity::Momentum(i),
            (_, Some(i), _) if is_kinetic => Quantity::Momentum(i),
            ("L", None, Some(i)) if !is_rate => Quantity::LagrangianSlope(i),
            (_, None, Some(i)) if is_kinetic && !is_rate => Quantity::KineticSlope(i),
            (_, None, Some(i)) if is_potential && !is_rate => Quantity::Gravity(i),
            _ => return None,
        })
    }
}
