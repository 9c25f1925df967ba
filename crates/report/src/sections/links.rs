//! The link transforms: the general one of the convention, and that of each row.

use super::setting::Setting;
use crate::document::{Factor, Line, Math, Section};
use crate::words::Heading;
use denavit::description::Convention;
use denavit::forward::link_transforms;
use denavit_symbolic::Expr;

/// The matrix of any row, and a matrix a row of the table.
pub fn section(s: &Setting) -> Section {
    let letters = [s.description.convention.length_x(), s.description.convention.length_z()];
    let [theta, alpha] = ["theta_j", "alpha_j"].map(Expr::symbol);
    let [x, z] = letters.map(|l| Expr::symbol(&format!("{l}_j")));
    let names =
        ["theta_j".to_string(), "alpha_j".into(), format!("{}_j", letters[0]), format!("{}_j", letters[1])];
    let mut section = Section::new(names.iter().fold(s.description.vocabulary(), |v, n| v.symbol(n)));
    section.heading(2, Line::new(s.words().heading(Heading::Links)));
    section.paragraph(Line::new(s.words().row_transform()));
    let ([c, sn], [ca, sa]) = ([theta.cos(), theta.sin()], [alpha.cos(), alpha.sin()]);
    let (o, l) = (Expr::int(0), Expr::int(1));
    let rows = match s.description.convention {
        Convention::Standard => {
            [[c, -(sn * ca), sn * sa, x * c], [sn, c * ca, -(c * sa), x * sn], [o, sa, ca, z], [o, o, o, l]]
        }
        Convention::Craig | Convention::Khalil => {
            [[c, -sn, o, x], [ca * sn, ca * c, -sa, -(z * sa)], [sa * sn, sa * c, ca, z * ca], [o, o, o, l]]
        }
    };
    let frame = Factor::Frame { from: "j−1".into(), to: "j".into() };
    section.formula(Math::Matrix(frame, rows.iter().map(|r| r.to_vec()).collect()));
    section.paragraph(Line::new(s.words().row_by_row()));
    section.push(crate::derivation::transforms(&link_transforms(&s.description)));
    section
}
