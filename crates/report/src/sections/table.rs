//! The Denavit–Hartenberg table.

use super::setting::{Setting, quantities};
use crate::cell::cell;
use crate::document::{Part, Section, Table};
use denavit::description::{Convention, Description, JointKind};
use denavit::explain::{Block, Factor, Line, Math};
use denavit::geometry::Transform;
use denavit_symbolic::Expr;

/// The table in its own convention, and in those that were asked for beside.
pub fn sections(s: &Setting) -> Vec<Section> {
    let mut section = Section::new(s.description.vocabulary());
    section.heading(2, s.line("Denavit–Hartenberg table", "Paramètres de Denavit–Hartenberg"));
    one(s, &s.description, &mut section);
    section.push(Block::List(meanings(s)));
    let mut all = vec![section];
    for &convention in s.options.conventions.iter().filter(|c| **c != s.description.convention) {
        let other = s.description.converted(convention);
        let mut section = Section::new(other.description.vocabulary());
        section.heading(
            3,
            Line::new(match convention {
                Convention::Standard => s.say("In the standard convention", "Dans la convention standard"),
                Convention::Craig => s.say("In Craig's convention", "Dans la convention de Craig"),
                Convention::Khalil => s.say(
                    "In Khalil and Kleinfinger's convention",
                    "Dans la convention de Khalil et Kleinfinger",
                ),
            }),
        );
        one(s, &other.description, &mut section);
        section.paragraph(Line::new(match denavit::description::prove_same_chain(&s.description, &other.description).is_equal() {
            true => s.say(
                "Proved: both tables give the same pose of the tool, whatever the joint values and lengths.",
                "Démontré : les deux tableaux donnent la même pose de l'outil, quelles que soient les variables et les longueurs.",
            ),
            false => s.say(
                "That both tables give the same pose is not proved: the expansion is too large.",
                "L'égalité des poses n'est pas démontrée : le développement est trop grand.",
            ),
        }));
        all.push(section);
    }
    all
}

/// What the four parameters of a row are.
fn meanings(s: &Setting) -> Vec<Line> {
    let symbol = |name: &str| Line::default().math(Expr::symbol(name));
    let [x, z] = [s.description.convention.length_x(), s.description.convention.length_z()];
    // From which frame's x axis the twist and the length are taken.
    let (before, own) = ("j−1", "j");
    let (along_x, along_z) = match s.description.convention {
        Convention::Standard => (own, before),
        Convention::Craig | Convention::Khalil => (before, own),
    };
    let axis = |english: &str, french: &str, axis: &str, frame: &str, between: &str| {
        s.language.spaced(&s.language.pick(
            format!("{english} from the {between} axis of frame j−1 to that of frame j, {axis} axis of frame {frame}"),
            format!("{french} de l'axe {between} du repère j−1 à celui du repère j, {axis} du repère {frame}"),
        ))
    };
    let about =
        |letter: &str| s.language.pick(format!("about the {letter}"), format!("autour de l'axe {letter}"));
    let along =
        |letter: &str| s.language.pick(format!("along the {letter}"), format!("le long de l'axe {letter}"));
    let rows = [
        ("theta", axis("angle", "angle", &about("z"), along_z, "x")),
        (z, axis("distance", "distance", &along("z"), along_z, "x")),
        ("alpha", axis("angle", "angle", &about("x"), along_x, "z")),
        (x, axis("distance", "distance", &along("x"), along_x, "z")),
    ];
    rows.into_iter().map(|(name, said)| symbol(name).text(s.say(": ", " : ")).text(said)).collect()
}

fn one(s: &Setting, d: &Description, section: &mut Section) {
    let columns = d.columns();
    let has_limits = d.rows.iter().any(|r| r.limits.is_some());
    let mut head = vec![Line::default().math(Expr::symbol("j")), s.line("joint", "liaison")];
    head.extend(columns.iter().map(|c| {
        let line = Line::default().math(Expr::symbol(c.key(d.convention)));
        if c.turns() { line } else { line.text(" (m)") }
    }));
    if has_limits {
        head.push(s.line("limits", "butées"));
    }
    let rows = (1..).zip(&d.rows).map(|(i, row)| {
        let kind = match row.variable.map(|v| v.kind) {
            Some(JointKind::Revolute) => "R",
            Some(JointKind::Prismatic) => "P",
            None => "–",
        };
        let mut cells = vec![Line::new(i.to_string()), Line::new(kind)];
        cells.extend(columns.iter().map(|c| cell(c.of(row), c.turns())));
        if has_limits {
            let turns = row.variable.is_some_and(|v| v.kind == JointKind::Revolute);
            let mut line = Line::default();
            if let Some([low, high]) = row.limits {
                line.0.extend(cell(low, turns).0);
                line = line.text(" … ");
                line.0.extend(cell(high, turns).0);
                line = line.text(if turns { "" } else { " m" });
            }
            cells.push(line);
        }
        cells
    });
    let caption = match d.convention {
        Convention::Standard => s.line(
            "Parameters in the standard convention; lengths in metres.",
            "Paramètres dans la convention standard ; longueurs en mètres.",
        ),
        Convention::Craig => s.line(
            "Parameters in Craig's (modified) convention; lengths in metres.",
            "Paramètres dans la convention modifiée de Craig ; longueurs en mètres.",
        ),
        Convention::Khalil => s.line(
            "Parameters in Khalil and Kleinfinger's convention; lengths in metres.",
            "Paramètres dans la convention de Khalil et Kleinfinger ; longueurs en mètres.",
        ),
    };
    section.push(Part::Table(Table { caption, head, rows: rows.collect() }));
    values(s, d, section);
    for (x, english, french) in [
        (&d.base, "Frame 0 stands in the base at", "Le repère 0 est placé dans la base par"),
        (&d.tool, "The tool stands in the last frame at", "L'outil est placé dans le dernier repère par"),
    ] {
        if *x != Transform::identity() {
            section.paragraph(s.line(english, french));
            let (from, to) = if std::ptr::eq(x, &d.base) {
                (s.say("base", "base"), "0".to_string())
            } else {
                (d.rows.len().to_string(), s.say("tool", "outil"))
            };
            let rows = x.matrix().iter().map(|r| r.to_vec()).collect();
            section.formula(Math::Matrix(Factor::Frame { from, to }, rows));
        }
    }
}

/// The values of the parameters, where they are known.
fn values(s: &Setting, d: &Description, section: &mut Section) {
    let known: Vec<_> = d.parameters.iter().filter(|p| p.value.is_some()).collect();
    if !known.is_empty() {
        section.paragraph(quantities(s.line("Values: ", "Valeurs : "), d, &known));
    }
}
