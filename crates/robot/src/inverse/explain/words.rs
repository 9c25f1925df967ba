//! What an explanation says, in each language.

use super::Explanation;
use super::explained::{Explained, Source, Statement, ordinal};
use crate::explain::{Block, Branch, Factor, Language, Line, Math, Proof};
use crate::inverse::derivation::Goal;
use denavit_symbolic::Expr;
use denavit_symbolic::readable::literals;

/// Solutions beyond which the tree is not drawn.
const DRAWN: usize = 16;

/// Literals of coefficients that stand in a line of text.
const INLINE: u64 = 40;

/// The whole derivation.
pub fn document(e: &Explanation, language: Language) -> Vec<Block> {
    let mut blocks = vec![title(e, language)];
    setting(e, language, &mut blocks);
    for (k, step) in e.steps.iter().enumerate() {
        explained(k + 1, step, language, &mut blocks);
    }
    if !e.joints.is_empty() && e.solutions.is_some() {
        blocks.push(Block::Heading(2, others(language)));
        blocks.extend(e.joints.iter().map(block));
    }
    ending(e, language, &mut blocks);
    blocks
}

fn title(e: &Explanation, language: Language) -> Block {
    let name = &e.description.name;
    Block::Heading(
        1,
        Line::new(language.pick(
            format!("Inverse kinematics of the {name}"),
            // No article: whatever the gender of the name.
            format!("Modèle géométrique inverse : {name}"),
        )),
    )
}

fn others(language: Language) -> Line {
    Line::new(language.pick("The other joints", "Les autres articulations"))
}

/// The formulas alone.
pub fn formulas(e: &Explanation, language: Language) -> Vec<Block> {
    let mut blocks = vec![title(e, language)];
    setting(e, language, &mut blocks);
    for (k, step) in e.steps.iter().enumerate() {
        let mut line = Line::new(format!("{}. ", k + 1)).math(step.unknown);
        if let Some(meaning) = step.meaning {
            line = line.text(" = ").math(meaning);
        }
        blocks.push(Block::Heading(3, line));
        blocks.extend(step.names.iter().map(block));
        if step.solution.iter().any(|s| uses_letters(s, step)) {
            blocks.extend(step.coefficients.iter().map(block));
        }
        blocks.extend(step.solution.iter().map(|s| block(&Statement { number: None, ..s.clone() })));
    }
    if !e.joints.is_empty() {
        blocks.push(Block::Heading(3, others(language)));
        blocks.extend(e.joints.iter().map(block));
    }
    let mut line = Line::default();
    for s in e.steps.iter().filter_map(|s| s.sign) {
        line = line.math(s).text(" = ±1, ");
    }
    let count = match e.solutions {
        Some(1) => language.pick("one solution", "une seule solution").to_string(),
        Some(n) => language.pick(format!("at most {n} solutions"), format!("au plus {n} solutions")),
        None => language
            .pick(
                "here the derivation ends: no closed form was found",
                "la résolution s'arrête ici : aucune forme explicite n'a été trouvée",
            )
            .into(),
    };
    blocks.push(Block::Paragraph(line.text(format!("{count}. {}", legend(e, language)))));
    blocks
}

/// True if a statement names a coefficient of its step.
fn uses_letters(s: &Statement, step: &Explained) -> bool {
    let names: Vec<Expr> = step.coefficients.iter().filter_map(|c| c.math.exprs().first().copied()).collect();
    s.math.exprs().iter().any(|e| e.symbols().into_iter().any(|x| names.contains(&Expr::from(x))))
}

fn block(s: &Statement) -> Block {
    Block::Formula { math: s.math.clone(), number: s.number, proof: s.proof }
}

fn setting(e: &Explanation, language: Language, blocks: &mut Vec<Block>) {
    let [base, tool] = &e.moved;
    let names: Vec<Factor> = e
        .matrices
        .iter()
        .map(|(f, _)| match f {
            Factor::Named { letter, number, .. } => {
                Factor::Named { letter, number: *number, of: None, inverse: false }
            }
            other => other.clone(),
        })
        .collect();
    let and = language.pick(" and ", " et ");
    let mut line = Line::new(match e.goal {
        Goal::Pose => {
            language.pick("Given the pose T of the hand", "On donne la pose T de l'organe terminal")
        }
        Goal::Position => {
            language.pick("Given the position of the hand", "On donne la position de l'organe terminal")
        }
        Goal::PositionAndAxis => language.pick(
            "Given the position of the hand and the direction of its z axis",
            "On donne la position de l'organe terminal et la direction de son axe z",
        ),
    });
    if !e.given.is_empty() {
        line = line.text(and).list(e.given.iter().map(|&q| q.into()));
        if e.given_by_choice {
            line = line.text(match e.given.len() {
                1 => language.pick(
                    " (a joint too many: any value is allowed, and the derivation is shortest with this one)",
                    " (une articulation en trop : toute valeur est permise, et la résolution est la plus courte avec celle-ci)",
                ),
                _ => language.pick(
                    " (joints too many: any values are allowed, and the derivation is shortest with these)",
                    " (articulations en trop : toutes les valeurs sont permises, et la résolution est la plus courte avec celles-ci)",
                ),
            });
        }
    }
    let sought: Vec<Math> = e
        .description
        .variables()
        .iter()
        .map(|v| Expr::from(v.symbol))
        .filter(|q| !e.given.contains(q))
        .map(Math::from)
        .collect();
    line = line.text(language.pick("; sought ", " ; on cherche ")).list(sought).text(". ");
    let trivial = base.is_none() && tool.is_none();
    line = line.text(match (trivial, e.matrices.len()) {
        (true, _) => language.pick("With U = T the chain is", "Avec U = T, la chaîne s'écrit"),
        _ => language.pick(
            "What is constant at both ends is taken to the side of the pose; what is left is",
            "Ce qui est constant aux deux extrémités passe du côté de la pose ; il reste",
        ),
    });
    blocks.push(Block::Paragraph(line));
    blocks.push(formula(Math::Products(vec![Factor::named("U")], names)));
    let mut left: Vec<Factor> = vec![];
    let inverse = |f: &Vec<Factor>| f.iter().rev().map(|x| x.clone().inverse()).collect::<Vec<_>>();
    left.extend(base.iter().flat_map(inverse));
    left.push(Factor::named("T"));
    left.extend(tool.iter().flat_map(inverse));
    if !trivial {
        blocks.push(formula(Math::Products(vec![Factor::named("U")], left)));
    }
    for (name, factors) in &e.matrices {
        blocks.push(formula(Math::Products(vec![name.clone()], factors.clone())));
    }
    let column = |k: usize| e.pose[k];
    let rows = |k: usize| [column(k), column(4 + k), column(8 + k)];
    let mut line = Line::new(language.pick("U has the columns ", "U a pour colonnes "));
    for (k, last) in [(0, ""), (1, ""), (2, ""), (3, language.pick(" (the position)", " (la position)"))] {
        line = line.text("(").list(rows(k).map(Math::from)).text(format!("){last}"));
        line = line.text(if k < 2 {
            ", "
        } else if k == 2 {
            and
        } else {
            ". "
        });
    }
    let turning = |q: &&denavit_symbolic::Symbol| e.names().number_of(**q).is_some();
    let variables: Vec<denavit_symbolic::Symbol> =
        e.description.variables().iter().map(|v| v.symbol).collect();
    if let Some(&q) = variables.iter().find(turning) {
        let q = Expr::from(q);
        line = line.math(q.cos()).text(and).math(q.sin());
        line =
            line.text(language.pick(" are cosine and sine of ", " sont le cosinus et le sinus de ")).math(q);
        if let Some(sum) = e.steps.iter().find_map(|s| s.meaning).or_else(|| e.sum()) {
            line = line.text(", ").math(sum.cos());
            line = line.text(language.pick(" is the cosine of ", " est le cosinus de ")).math(sum);
        }
        line = line.text(".");
    }
    blocks.push(Block::Paragraph(line));
}

fn formula(math: Math) -> Block {
    Block::Formula { math, number: None, proof: None }
}

fn explained(number: usize, s: &Explained, language: Language, blocks: &mut Vec<Block>) {
    let and = language.pick(" and ", " et ");
    let label = s.label.as_ref().map(|label| label.of(language));
    let mut title =
        Line::new(language.pick(format!("Step {number}. "), format!("Étape {number}. "))).math(s.unknown);
    if let Some(meaning) = s.meaning {
        title = title.text(" = ").math(meaning);
    }
    title = title.text(match s.values {
        1 => language.pick(": one value", " : une valeur").into(),
        n => language.pick(format!(": {n} values"), format!(" : {n} valeurs")),
    });
    if let Some(label) = &label {
        title = title.text(format!(" ({label})"));
    }
    blocks.push(Block::Heading(2, title));
    for source in &s.sources {
        from(source, language, blocks);
    }
    if let Some((unknown, how)) = &s.elimination {
        blocks.push(Block::Paragraph(Line::default().math(*unknown).text(how.of(language))));
    }
    if !s.names.is_empty() {
        let word = match s.sources.is_empty() {
            true => language.pick("Let", "Posons"),
            false => language.pick("with", "avec"),
        };
        blocks.push(Block::Paragraph(Line::new(word)));
        blocks.extend(s.names.iter().map(block));
    }
    let squared = s.sources.iter().any(|o| o.squared);
    let mut line = Line::new(match (s.number, squared) {
        ("none", _) => language.pick("An equation ", "Une équation ").to_string(),
        (n, true) => language.pick(
            format!("The squares of both sides, added: type {n}, "),
            format!("Les carrés des deux membres, additionnés : type {n}, "),
        ),
        // The same word in both.
        (n, false) => format!("Type {n}, "),
    });
    line = line.text(s.kind.of(language));
    let colon = language.pick(": ", " : ");
    for (k, f) in s.form.iter().enumerate() {
        line = line.text(if k == 0 { colon } else { and }).math(f.clone());
    }
    let literals = |c: &Statement| c.math.exprs().into_iter().map(literals).sum::<u64>();
    let is_long = s.coefficients.iter().map(literals).sum::<u64>() > INLINE;
    for (k, c) in s.coefficients.iter().enumerate().filter(|_| !is_long) {
        line = line.text(if k == 0 { language.pick(" with ", " avec ") } else { ", " }).math(c.math.clone());
    }
    if is_long {
        blocks.push(Block::Paragraph(line.text(language.pick(" with", " avec"))));
        blocks.extend(s.coefficients.iter().map(block));
        line = Line::default();
    } else {
        line = line.text(language.pick("; ", " ; "));
    }
    blocks.push(Block::Paragraph(line.text(language.pick("so", "d'où"))));
    blocks.extend(s.solution.iter().map(block));
    let mut remarks = vec![];
    for c in &s.conditions {
        let mut line = Line::default();
        for (k, m) in c.when.iter().enumerate() {
            line = line
                .text(if k == 0 {
                    ""
                } else if is_zeros(&c.when) {
                    and
                } else {
                    language.pick(" or ", " ou ")
                })
                .math(m.clone());
        }
        if !c.when.is_empty() {
            line = line.text(colon);
        }
        remarks.push(line.text(c.then.of(language)));
    }
    let mut last = Line::default();
    if let Some(sign) = s.sign.filter(|_| s.values == 2) {
        last = last.math(sign).text(" = ±1");
        if let Some(label) = &label {
            last = last.text(format!("{colon}{label}+{and}{label}−"));
        }
        last = last.text(". ");
    }
    last = last.text(s.remark.of(language));
    last = last.text(match &s.used_by[..] {
        [] => language.pick(" No later step needs it.", " Ne sert à aucune étape suivante.").to_string(),
        [one] => language.pick(format!(" Used by step {one}."), format!(" Sert à l'étape {one}.")),
        many => {
            let many = language.listed(&many.iter().map(ToString::to_string).collect::<Vec<_>>());
            language.pick(format!(" Used by steps {many}."), format!(" Sert aux étapes {many}."))
        }
    });
    remarks.push(last);
    blocks.push(Block::List(remarks));
}

/// True for a list of expressions that all vanish.
fn is_zeros(all: &[Math]) -> bool {
    all.iter().all(|m| m.exprs().last().is_some_and(|e| e.is_zero()))
}

fn from(source: &Source, language: Language, blocks: &mut Vec<Block>) {
    let (left, right) = source.product.clone();
    let mut line = Line::default();
    if source.inverse {
        line = line.text(language.pick("The inverse of both sides of ", "L'inverse des deux membres de "));
    }
    line = line.math(Math::Products(left, right)).text(", ");
    let mut rows: Vec<usize> = source.elements.iter().map(|e| e.0).collect();
    let mut columns: Vec<usize> = source.elements.iter().map(|e| e.1).collect();
    rows.dedup();
    columns.dedup();
    let several = |all: &[usize], word: &str| {
        let names: Vec<String> = all.iter().map(|&n| ordinal(n, language).to_string()).collect();
        format!("{} {word}{}", language.listed(&names), if all.len() == 1 { "" } else { "s" })
    };
    line = line.text(match (rows.len(), columns.len()) {
        (1, _) | (_, 1) => format!(
            "{}, {}",
            several(&rows, language.pick("row", "ligne")),
            several(&columns, language.pick("column", "colonne"))
        ),
        _ => {
            let places: Vec<String> = source.elements.iter().map(|(r, c)| format!("({r}, {c})")).collect();
            format!("{} {}", language.pick("elements", "éléments"), language.listed(&places))
        }
    });
    if let Some(why) = &source.why {
        line = line.text(format!(" ({})", why.of(language)));
    }
    blocks.push(Block::Paragraph(line.text(language.pick(":", " :"))));
    blocks.extend(source.equations.iter().map(block));
}

fn ending(e: &Explanation, language: Language, blocks: &mut Vec<Block>) {
    let said = |english: &str, french: &str| Line::new(language.pick(english, french));
    if !e.leftovers.is_empty() {
        blocks.push(Block::Heading(2, said("What the pose must meet", "Ce que la pose doit vérifier")));
        let count = e.rank.unwrap_or(6);
        let task = e.task.map(|task| task.words(language));
        let freedoms = language.counted(
            count,
            // Of these there is always the plural.
            ["independent directions"; 2],
            ["degré de liberté", "degrés de liberté"],
        );
        blocks.push(Block::Paragraph(Line::new(language.pick(
            format!(
                "The hand can move in {freedoms}{}. A pose that is reached meets",
                task.iter().map(|t| format!(": it can be told {t}")).collect::<String>()
            ),
            format!(
                "L'organe terminal a {freedoms}{}. Une pose accessible vérifie",
                task.iter().map(|t| format!(" : on peut lui imposer {t}")).collect::<String>()
            ),
        ))));
        blocks.extend(e.leftovers.iter().map(block));
    }
    match e.solutions {
        Some(count) => solved(e, count, language, blocks),
        None => unsolved(e, language, blocks),
    }
    blocks.push(Block::Paragraph(Line::new(legend(e, language))));
}

fn solved(e: &Explanation, count: usize, language: Language, blocks: &mut Vec<Block>) {
    blocks.push(Block::Heading(
        2,
        Line::new(match count {
            1 => language.pick("One solution", "Une seule solution").to_string(),
            n => language.pick(format!("At most {n} solutions"), format!("Au plus {n} solutions")),
        }),
    ));
    let factors: Vec<String> =
        e.steps.iter().filter(|s| s.values > 1).map(|s| s.values.to_string()).collect();
    if factors.len() > 1 {
        let product = factors.join(" · ");
        blocks.push(Block::Paragraph(Line::new(
            language.pick(format!("{product} = {count}:"), format!("{product} = {count} :")),
        )));
    }
    if let Some(tree) = e.branches(language).filter(|_| count > 1 && count <= DRAWN) {
        blocks.push(Block::Tree(tree));
    }
    blocks.push(Block::Paragraph(Line::new(language.pick(
        "Each step follows from the equations before it and has all their roots, so no solution is lost. \
         Each solution is put into the whole chain again; what does not give the pose is dropped. \
         The types are numbered as by Khalil and Dombre; 1, 2 and 3 are Paul's.",
        "Chaque étape découle des équations qui la précèdent et en a toutes les racines : aucune solution n'est perdue. \
         Chaque solution est reportée dans la chaîne entière ; celles qui ne redonnent pas la pose sont écartées. \
         Les types sont numérotés d'après Khalil et Dombre ; les types 1, 2 et 3 sont ceux de Paul.",
    ))));
}

fn unsolved(e: &Explanation, language: Language, blocks: &mut Vec<Block>) {
    let said = |english: &str, french: &str| Line::new(language.pick(english, french));
    blocks.push(Block::Heading(2, said("Here the derivation ends", "La résolution s'arrête ici")));
    let mut line = Line::default();
    if e.steps.is_empty() {
        line = said("Nothing was found. ", "Rien n'a été trouvé. ");
    }
    line = line
        .text(language.pick(
            "No equation of the chain, and no combination of two of them that was tried, holds ",
            "Aucune équation de la chaîne, ni aucune des combinaisons de deux équations essayées, ne fournit, pour ",
        ))
        .list(e.missing.iter().map(|&q| q.into()))
        .text(language.pick(
            " in one unknown with degree up to 4 in tan(θ/2).",
            ", d'équation à une seule inconnue de degré au plus 4 en tan(θ/2).",
        ));
    blocks.push(Block::Paragraph(line));
    let more = language.counted(e.surplus, ["joint", "joints"], ["articulation", "articulations"]);
    blocks.push(Block::Paragraph(Line::new(match e.surplus {
        0 => language
            .pick(
                "Closed forms exist where three axes in a row meet in one point or are parallel; \
                 where neither is so, the general arm has up to 16 solutions, roots of one polynomial of degree 16.",
                "Il existe des formes explicites lorsque trois axes consécutifs sont concourants ou parallèles ; \
                 à défaut, le bras général a jusqu'à 16 solutions, racines d'un même polynôme de degré 16.",
            )
            .to_string(),
        _ => language.pick(
            format!(
                "The arm has {more} more than the hand can use: with other joints given the derivation may end."
            ),
            format!(
                "Le bras a {more} de plus que l'organe terminal ne peut en utiliser : avec d'autres articulations données, la résolution peut aboutir."
            ),
        ),
    })));
}

/// The tree of branches: a node for each choice, what follows without choice on its line.
pub fn branches(steps: &[Explained], solutions: &mut usize, language: Language) -> Branch {
    let first = steps.iter().position(|s| s.values > 1).unwrap_or(steps.len());
    let mut line = Line::default();
    for (k, s) in steps[..first].iter().enumerate() {
        line = line.text(if k == 0 { "" } else { ", " }).math(s.unknown);
    }
    let mut children = vec![];
    if let Some(step) = steps.get(first) {
        for k in 0..step.values {
            let mut child = branches(&steps[first + 1..], solutions, language);
            let which = match step.values {
                2 => if k == 0 { "+" } else { "−" }.to_string(),
                _ => (k + 1).to_string(),
            };
            let label = step.label.as_ref().map(|label| label.of(language)).unwrap_or_default();
            let mut front = Line::default().math(step.unknown).text(" ").strong(format!("{label}{which}"));
            if !child.line.0.is_empty() {
                front = front.text(", ");
            }
            front.0.append(&mut child.line.0);
            children.push(Branch { line: front, children: child.children });
        }
    } else {
        *solutions += 1;
        // The same word in both languages.
        let text = format!("{}solution {solutions}", if line.0.is_empty() { "→ " } else { " → " });
        line = line.text(text);
    }
    Branch { line, children }
}

/// What the marks behind formulas mean.
fn legend(e: &Explanation, language: Language) -> &'static str {
    match e.proof() {
        Proof::Proved => language.pick(
            "✓: proved. With A1·A2·… put in for U, both sides are identical, whatever the joint values and lengths.",
            "✓ : démontré. Si l'on remplace U par A1·A2·…, les deux membres sont identiques, quelles que soient les valeurs articulaires et les longueurs.",
        ),
        Proof::Sampled => language.pick(
            "✓: proved. ≈: checked at sample poses only; the expansion is too large to decide.",
            "✓ : démontré. ≈ : vérifié seulement en des poses d'essai ; le développement est trop grand pour conclure.",
        ),
        Proof::Wrong => language.pick(
            "A formula above is NOT TRUE: this is an error of the program.",
            "Une formule ci-dessus est FAUSSE : c'est une erreur du programme.",
        ),
    }
}
