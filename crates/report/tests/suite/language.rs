//! Documents in several languages: of the same structure, with the same formulas, each in its own words.

use denavit::catalogue;
use denavit::description::{Description, JointKind, Moved, read_toml};
use denavit::forward::{Proof, Reference};
use denavit::idealise::Measured;
use denavit::inverse::{
    Branch as Roots, Choice, Doubt, Goal, InverseModel, InverseOptions, Label, Part, Refusal, Task,
    Unsuitable,
};
use denavit::motion::follow::{Cause, Event, EventKind, Jump};
use denavit::motion::hand::Stretch;
use denavit::motion::plan::{Course, Held, Timing, TimingLaw, Verdict};
use denavit::motion::profile::Law;
use denavit::structure::{NearlySpecial, Relation, Special};
use denavit::velocity::{Blocks, JacobianModel, Obstacle, Place, Singularities, Still};
use denavit_program::Count;
use denavit_report::document::{Block, Branch, Line, Math, Piece, math, plain};
use denavit_report::explain::{
    Bound, Component, Consequence, Explanation, Kind, Remark, jacobian_document, singularities_document,
};
use denavit_report::words::{Tongue, Wording};
use denavit_symbolic::print::Style;
use denavit_symbolic::vocabulary::Vocabulary;

fn robot(name: &str) -> Description {
    let text = catalogue::text(name).expect("a robot of the catalogue");
    read_toml(text).unwrap_or_else(|errors| panic!("{name}: {errors:?}")).0
}

/// Of each kind one: spherical wrist, UR, SCARA, planar, slides, joints too many, no closed form, few joints.
const ROBOTS: [&str; 12] = [
    "staubli-rx90",
    "stanford",
    "ur5",
    "scara",
    "planar-3r",
    "cylindrical-rpp",
    "cylindrical-wrist-b",
    "smart5-six-rail",
    "kuka-iiwa-14",
    "oblique-6r",
    "rhino-xr3",
    "spherical-wrist",
];

/// Words of each language, in the order of [`Tongue::ALL`]: a text in another has none of them that is not its own, too.
const WORDS: [&str; 4] = [
    "the of and with row rows column columns joint joints value values used step steps where both axis is are it its this that no not \
     to in at by from given sought arm hand side sides lost gained frame velocity together proved body tool linear squares all so \
     then else free one two always exactly shoulder elbow wrist reach entries chain branch what which has have right here there \
     elements other pairs root roots move moves turn meet meets lies lie sine cosine cosines unknown parameters alone derivation \
     closed forms also an for as on line lines more than when only",
    "le la les des du de et est sont une un avec ou pour dans sur par ligne lignes colonne colonnes étape étapes valeur valeurs \
     articulation articulations repère au aux bras épaule coude poignet axe sert inconnue résolution deux membres si que qui ne pas \
     sinon rien aucune où d l s n en racine racines se son on",
    "der die das des dem den und ist sind ein eine einer eines einem einen mit oder für auf von zu zur zum im am an in bei nicht kein \
     keine alle aus wo wie sich so also hat haben wird werden nur noch nach gleich achse achsen gelenk gelenke gelenken zeile zeilen \
     spalte spalten wert werte schritt schritte schritten arm basis werkzeug endeffektor stellung schulter ellenbogen handgelenk \
     bewiesen lösung lösungen zwei beide seite seiten sonst gegeben gesucht formel formeln linear winkel drehung richtung es um \
     determinante",
    "el la los las de del en es son una un con para por que no se si más como cada valor valores fila filas columna columnas \
     articulación articulaciones eslabón eslabones brazo hombro codo muñeca alcance efector sistema herramienta demostrado paso pasos \
     rama ramas solución soluciones dos tres ambos ambas solo donde su sus lo al hay luego sea incógnita miembro eje ejes otra otro \
     par pares den le les ningún ninguna determinante giro",
];

/// The text of a line, its formulas as `#`.
fn words(line: &Line) -> String {
    let piece = |piece: &Piece| match piece {
        Piece::Text(text) | Piece::Strong(text) => text.clone(),
        Piece::Math(_) => "#".into(),
    };
    line.0.iter().map(piece).collect()
}

fn formulas(line: &Line) -> Vec<Math> {
    let formula = |piece: &Piece| if let Piece::Math(m) = piece { Some(m.clone()) } else { None };
    line.0.iter().filter_map(formula).collect()
}

/// A document taken apart: what it is built of, and its lines.
#[derive(Default)]
struct Parts {
    structure: Vec<String>,
    lines: Vec<String>,
}

impl Parts {
    fn of(blocks: &[Block], name: &str) -> Self {
        let mut parts = Parts::default();
        for block in blocks {
            match block {
                Block::Heading(level, line) => parts.line(&format!("heading {level}"), line, name),
                Block::Paragraph(line) => parts.line("paragraph", line, name),
                Block::Formula { math, number, proof } => {
                    parts.structure.push(format!("{} {number:?} {proof:?}", shown(math)));
                }
                Block::List(lines) => {
                    parts.structure.push(format!("list of {}", lines.len()));
                    lines.iter().for_each(|line| parts.line("item", line, name));
                }
                Block::Tree(branch) => parts.branch(branch, name),
            }
        }
        parts
    }

    fn line(&mut self, kind: &str, line: &Line, name: &str) {
        let formulas: Vec<String> = formulas(line).iter().map(shown).collect();
        self.structure.push(format!("{kind}: {}", formulas.join(" | ")));
        self.lines.push(words(line).replace(name, "@"));
    }

    fn branch(&mut self, branch: &Branch, name: &str) {
        self.line(&format!("branch with {}", branch.children.len()), &branch.line, name);
        branch.children.iter().for_each(|child| self.branch(child, name));
    }
}

fn shown(m: &Math) -> String {
    math(m, &Vocabulary::default(), Style::Ascii)
}

/// Words of letters, in lower case; an apostrophe ends one.
fn tokens(text: &str) -> Vec<String> {
    let all = text.split(|c: char| !c.is_alphabetic()).filter(|w| !w.is_empty());
    all.map(str::to_lowercase).collect()
}

fn words_of(language: Tongue) -> impl Iterator<Item = &'static str> {
    let place = Tongue::ALL.iter().position(|l| *l == language).expect("one of all");
    WORDS[place].split_whitespace()
}

/// Panics where a text is not in its language.
pub fn check_text(text: &str, language: Tongue, place: &str) {
    let own: Vec<&str> = words_of(language).collect();
    let others = Tongue::ALL.into_iter().filter(|l| *l != language).flat_map(words_of);
    let foreign: Vec<&str> = others.filter(|word| !own.contains(word)).collect();
    for word in tokens(text) {
        // `d` and `s` are lengths as well as what an apostrophe leaves.
        let is_name = word.chars().count() == 1;
        assert!(is_name || !foreign.contains(&word.as_str()), "{place}: {word} in: {text}");
    }
    if language != Tongue::French {
        assert!(!text.contains(['\u{a0}', '’']), "{place}: {text}");
    }
    let all: Vec<char> = text.chars().collect();
    let is_digit = |k: usize| all.get(k).is_some_and(char::is_ascii_digit);
    for (k, c) in all.iter().enumerate() {
        let is_decimal = |sign: char| *c == sign && k > 0 && is_digit(k - 1) && is_digit(k + 1);
        assert!(language == Tongue::English || !is_decimal('.'), "{place}: a point in: {text}");
        if language != Tongue::French {
            continue;
        }
        if matches!(c, ':' | ';' | '?' | '!' | '»') {
            assert_eq!(k.checked_sub(1).map(|b| all[b]), Some('\u{a0}'), "{place}: {c} in: {text}");
        }
        if *c == '«' {
            assert_eq!(all.get(k + 1), Some(&'\u{a0}'), "{place}: {text}");
        }
        assert_ne!(*c, '\'', "{place}: {text}");
    }
}

/// Panics where documents are not the same in all languages, English first.
fn check_all(all: &[Vec<Block>], name: &str, place: &str) {
    let all: Vec<Parts> = all.iter().map(|blocks| Parts::of(blocks, name)).collect();
    let english = &all[0];
    for (parts, language) in all.iter().zip(Tongue::ALL) {
        assert_eq!(english.structure, parts.structure, "{place}");
        for (e, line) in english.lines.iter().zip(&parts.lines) {
            check_text(line, language, place);
            let is_sentence = tokens(e).iter().filter(|w| w.chars().count() > 1).count() >= 4;
            assert!(language == Tongue::English || !is_sentence || e != line, "{place}: {e}");
        }
    }
}

fn in_all(document: impl Fn(Tongue) -> Vec<Block>) -> Vec<Vec<Block>> {
    Tongue::ALL.into_iter().map(document).collect()
}

/// Arms that need more than the catalogue's: three axes before a wrist that are neither parallel nor at right angles, a
/// slide that is found from a sum of squares.
const MADE: [(&str, &str); 2] = [("wrist behind three skew axes", SKEW), ("slide at an angle", SLIDE)];

const SKEW: &str = r#"
name = "Made"
convention = "standard"

[[joints]]
theta = "q1"
a = "0.2 m"
alpha = "90 deg"

[[joints]]
theta = "q2"
d = "0.1 m"
a = "0.5 m"
alpha = "90 deg"

[[joints]]
theta = "q3"
a = "0.1 m"
alpha = "90 deg"

[[joints]]
theta = "q4"
d = "0.4 m"
alpha = "-90 deg"

[[joints]]
theta = "q5"
alpha = "90 deg"

[[joints]]
theta = "q6"
"#;

const SLIDE: &str = r#"
name = "Made"
convention = "standard"

[[joints]]
theta = "q1"
alpha = "90 deg"

[[joints]]
theta = "q2"
a = "0.3 m"
alpha = "60 deg"

[[joints]]
d = "q3"
alpha = "30 deg"

[[joints]]
theta = "q4"
d = "0.2 m"
alpha = "-90 deg"

[[joints]]
theta = "q5"
alpha = "90 deg"

[[joints]]
theta = "q6"
"#;

/// The derivation, complete or not; its refusal is checked, too.
fn explanation(description: &Description, goal: Goal, name: &str) -> Explanation {
    match InverseModel::derive(description, &InverseOptions { goal, given: None }) {
        Ok(model) => Explanation::of(&model),
        Err(Refusal::Stuck(found)) => {
            for language in Tongue::ALL {
                check_text(&language.words().stuck(&found), language, name);
            }
            Explanation::of_stuck(description, &found, goal)
        }
        Err(why) => panic!("{name}: {why}"),
    }
}

/// Both documents in all languages; the derivation in each.
fn check_inverse(description: &Description, goal: Goal, name: &str) -> (Explanation, Vec<Vec<Block>>) {
    let e = explanation(description, goal, name);
    check_all(&in_all(|language| e.summary(language)), &description.name, name);
    let whole = in_all(|language| e.document(language));
    check_all(&whole, &description.name, name);
    (e, whole)
}

#[test]
fn documents_of_inverse_kinematics() {
    let (mut stuck, mut free, mut conditions, mut trees) = (0, 0, 0, 0);
    for name in ROBOTS {
        let (e, documents) = check_inverse(&robot(name), Goal::Pose, name);
        stuck += usize::from(e.solutions.is_none());
        free += usize::from(e.given_by_choice);
        conditions += usize::from(!e.leftovers.is_empty());
        trees += usize::from(documents[0].iter().any(|b| matches!(b, Block::Tree(_))));
    }
    // Each kind of document was there.
    assert!(stuck >= 1 && free >= 2 && conditions >= 3 && trees >= 6, "{stuck} {free} {conditions} {trees}");
    check_inverse(&robot("articulated-3r"), Goal::Position, "the position of three joints");
    check_inverse(&robot("rhino-xr3"), Goal::PositionAndAxis, "position and axis of five joints");
}

#[test]
fn documents_of_made_arms() {
    let mut said = vec![String::new(); Tongue::ALL.len()];
    for (name, text) in MADE {
        let description = read_toml(text).unwrap_or_else(|errors| panic!("{name}: {errors:?}")).0;
        let (_, documents) = check_inverse(&description, Goal::Pose, name);
        for (said, document) in said.iter_mut().zip(&documents) {
            *said += &Parts::of(document, "Made").lines.join("\n");
        }
    }
    let rare = [
        ["goes out", "half turn", "quadratic"],
        ["s’élimine", "demi-tour", "du second degré"],
        ["fällt heraus", "halbe Umdrehung", "quadratisch"],
        ["se elimina", "media vuelta", "cuadrática"],
    ];
    for (said, parts) in said.iter().zip(rare) {
        for part in parts {
            assert!(said.contains(part), "{part}: {said}");
        }
    }
}

#[test]
fn documents_of_velocities() {
    let mut whole = 0;
    for name in ROBOTS {
        let description = robot(name);
        let model = JacobianModel::shortest(&description, Reference::Tool);
        let documents = in_all(|language| jacobian_document(&description, &model, language));
        check_all(&documents, &description.name, name);
        match Singularities::derive(&description, Reference::Tool) {
            Ok(found) => {
                whole += 1;
                let documents = in_all(|language| singularities_document(&description, &found, language));
                check_all(&documents, &description.name, name);
            }
            Err(why) => {
                for language in Tongue::ALL {
                    check_text(&language.words().unknown_singularities(&why), language, name);
                }
            }
        }
    }
    assert!(whole >= 8, "{whole}");
}

/// What the robots above need not meet.
#[test]
fn rare_words() {
    let program = Count {
        multiplications: 1,
        additions: 2,
        sincos: 3,
        divisions: 1,
        roots: 2,
        arctangents: 1,
        signs: 0,
        offsets: 2,
        hoisted: 4,
    };
    let french = "1 multiplication, 2 additions, 3 paires sinus-cosinus, 1 division, 2 racines, 1 arc tangente\u{a0}; à \
                  part\u{a0}: 2 décalages de variables, 4 opérations sur les seuls paramètres";
    let [in_english, in_french, in_german, in_spanish] = Tongue::ALL.map(Tongue::words);
    assert_eq!(in_french.count(&program), french);
    let german = "1 Multiplikation, 2 Additionen, 3 Sinus-Kosinus-Paare, 1 Division, 2 Wurzeln, 1 Arkustangens; dazu 2 \
                  Versätze von Variablen, 4 Operationen mit den Parametern allein";
    assert_eq!(in_german.count(&program), german);
    let spanish = "1 multiplicación, 2 sumas, 3 pares seno-coseno, 1 división, 2 raíces, 1 arcotangente; aparte, 2 desfases de \
                   variables, 4 operaciones solo con parámetros";
    assert_eq!(in_spanish.count(&program), spanish);
    assert_eq!(in_english.count(&program), program.to_string());
    assert_eq!(in_french.count(&Count::default()), "0 multiplication, 0 addition, 0 paire sinus-cosinus");

    use denavit_symbolic::Refusal::{OutsideBasis, TooLarge, Undefined};
    for why in [OutsideBasis, TooLarge, Undefined] {
        both(&|w| w.unknown_singularities(&Obstacle::TooLarge(why)));
        both(&|w| w.forward_proof(Proof::Undecided(why)));
    }
    both(&|w| w.forward_proof(Proof::Proved));
    both(&|w| w.jacobian_proof(Proof::Failed));
    both(&|w| w.unknown_singularities(&Obstacle::ManyJoints(9)));
    both(&|w| w.unknown_singularities(&Obstacle::AlwaysSingular(5)));
    for why in [Unsuitable::Helical(2), Unsuitable::Coupling, Unsuitable::NoJoint, Unsuitable::TooLong(9)] {
        both(&|w| w.unsuitable(&why));
    }
    for task in [
        Task::Pose,
        Task::PositionAndAxis,
        Task::PositionAndTurn,
        Task::Planar,
        Task::Position,
        Task::Orientation,
        Task::Other(2),
    ] {
        both(&|w| w.task(task));
    }
    for is_point in [true, false] {
        both(&|w| w.image_title(is_point));
        let coordinates = [1, 2, 3].map(|n| Math::Expr(denavit_symbolic::Expr::int(n)));
        both(&|w| plain(&w.image(is_point, coordinates.clone(), "0", "3"), &Vocabulary::new()));
    }
    for blocks in [Blocks::Point, Blocks::Wrist, Blocks::Rows] {
        both(&|w| w.rates(blocks));
    }
    both(&|w| w.always_singular(5, true));
    both(&|w| w.always_singular(5, false));
    both(&|w| w.minor_of_both(&["vx", "wz"], &[0, 3]));
    for place in [
        Place::OneLine(3, 5),
        Place::OnePlane(vec![1, 2, 3]),
        Place::Parallel(vec![0, 1, 2, 3]),
        Place::CentreOnAxis { wrist: vec![3, 4, 5], axis: 0 },
        Place::CentreInPlane { wrist: vec![3, 4, 5], axes: [1, 2], parallel: true },
        Place::Line { meets: vec![0], parallel: vec![1] },
        Place::Line { meets: vec![0, 3], parallel: vec![1, 2] },
        Place::PointOnAxis(0),
        Place::PointInPlane { axes: [1, 2], parallel: true },
        Place::SelfMotion { joints: vec![2], still: Still::Body },
        Place::SelfMotion { joints: vec![2, 4], still: Still::Point },
        Place::Differs,
        Place::Lost,
    ] {
        both(&|w| w.place(&place));
    }
    for given in [vec![9], vec![0], vec![0, 1]] {
        let options = InverseOptions { given: Some(given), ..InverseOptions::default() };
        let why = InverseModel::derive(&robot("staubli-rx90"), &options).expect_err("too many");
        both(&|w| w.refusal(&why));
    }
}

/// Panics where a message is not in its language, or the same as in English.
#[track_caller]
pub fn both(message: &dyn Fn(&'static dyn Wording) -> String) {
    let said = Tongue::ALL.map(|language| message(language.words()));
    for (text, language) in said.iter().zip(Tongue::ALL) {
        assert!(!text.is_empty());
        // What stands in backquotes is of no language.
        let words: Vec<&str> = text.split('`').step_by(2).collect();
        check_text(&words.join("`"), language, "a message");
        assert!(language == Tongue::English || *text != said[0], "{language:?}: {text}");
    }
}

#[test]
fn remarks_on_steps() {
    use Bound::{Reach, Span};
    for then in [
        Consequence::NoSolution(Reach),
        Consequence::NoSolution(Span),
        Consequence::TwoValues(Reach),
        Consequence::TwoValues(Span),
        Consequence::Coincide,
        Consequence::OpenDisplacement,
        Consequence::OpenAngle,
        Consequence::OpenUnless,
        Consequence::OpenJoint,
        Consequence::Roots,
        Consequence::HalfTurn,
        Consequence::Free,
        Consequence::OneValue,
        Consequence::OneEquation,
    ] {
        both(&|w| w.consequence(then));
    }
    for kind in [
        Kind::Displacement,
        Kind::DisplacementSquared,
        Kind::Quartic,
        Kind::Homogeneous,
        Kind::Cosine,
        Kind::Sine,
        Kind::Linear,
        Kind::Pair,
        Kind::Separate,
    ] {
        both(&|w| w.kind(kind));
    }
    for remark in [Remark::MayAdd, Remark::SquaresAddNone, Remark::Whole, Remark::AddsNone] {
        both(&|w| w.remark(remark));
    }
    let component = |along: &[usize], of: &[usize], is_point, free: &[usize]| Component {
        along: along.to_vec(),
        of: of.to_vec(),
        is_point,
        free: free.to_vec(),
    };
    let point = component(&[1, 2], &[3], true, &[1, 2, 3]);
    let said = "une composante d’un point de l’axe 4 suivant les axes parallèles 2 et 3\u{a0}: indépendante des \
                articulations 2, 3 et 4";
    assert_eq!(Tongue::French.words().component(&point), said);
    let said = "a component along the parallel axes 2 and 3 of a point on axis 4: free of joints 2, 3 and 4";
    assert_eq!(Tongue::English.words().component(&point), said);
    both(&|w| w.component(&component(&[0], &[], false, &[0])));
    both(&|w| w.component(&component(&[], &[4], false, &[4])));
    both(&|w| w.component(&component(&[], &[4, 5], true, &[4, 5])));
    let doubts = [Doubt::Sampled, Doubt::DoubleRoot, Doubt::Uncounted, Doubt::Searched, Doubt::OneAsked];
    for doubt in doubts.into_iter().chain([Doubt::Copies, Doubt::Digits]) {
        both(&|w| w.doubt(doubt));
    }
}

#[test]
fn motions_and_axes() {
    let ur5 = robot("ur5");
    let s = denavit_symbolic::Expr::symbol("q5").sin();
    let (factor, place) = (Some(s), Some(Place::OneLine(3, 5)));
    let kinds = [
        EventKind::Singular { factor, place: place.clone(), crossed: true },
        EventKind::Singular { factor: None, place: None, crossed: false },
        EventKind::Limit { joint: 2, limit: 1.0 },
        EventKind::WithinLimits { joint: 2 },
        EventKind::End { reachable: true, factor, place },
        EventKind::End { reachable: false, factor: None, place: None },
    ];
    for kind in kinds {
        for at in [0.0, 0.5] {
            let event = Event { s: at, q: vec![0.0; 6], kind: kind.clone() };
            both(&|w| w.event(&event, &ur5));
        }
    }
    let joints = ["q1", "q2"].map(|name| (name.to_string(), JointKind::Revolute));
    for why in [Cause::Limit { joint: 1, limit: 6.0 }, Cause::End(0.25), Cause::Nearer] {
        for same_branch in [false, true] {
            both(&|w| w.jump(&Jump { joint: 0, by: 3.1, same_branch, why }, &joints));
        }
    }
    let laws = [
        TimingLaw::Still,
        TimingLaw::TimeOptimal,
        TimingLaw::WithinTorques { accelerations: true, fastest: true },
        TimingLaw::WithinTorques { accelerations: false, fastest: false },
        TimingLaw::JerkLimited,
        TimingLaw::WithinJerksAndTorques { accelerations: true },
        TimingLaw::WithinJerksAndTorques { accelerations: false },
        TimingLaw::Fastest,
        TimingLaw::Together(Law::Cubic),
        TimingLaw::Together(Law::DoubleS),
        TimingLaw::Quintic { duration: 1.5, fastest: Some((0, 1.0)) },
        TimingLaw::QuinticWithin { duration: 2.0 },
    ];
    for by in laws {
        for slowed_to in [None, Some(4.0)] {
            both(&|w| w.timing(&Timing { by, slowed_to, held: None }, &ur5));
        }
    }
    let held = Held { instants: 101, velocity: 0.5, acceleration: None, jerk: Some(1.0), torque: Some(0.75) };
    both(&|w| w.shares_of_limits(&held));
    for course in [
        Course::Move,
        Course::Straight(3),
        Course::Spline(4),
        Course::Hand(vec![Stretch::Line, Stretch::Line, Stretch::Arc]),
        Course::Hand(vec![Stretch::Spline(5)]),
    ] {
        both(&|w| w.course(&course));
    }
    let parts = Course::Hand(vec![Stretch::Line, Stretch::Arc, Stretch::Line]);
    assert_eq!(Tongue::English.words().course(&parts), "2 lines, 1 arc");
    for verdict in [Verdict::Whole, Verdict::Ends(0.25), Verdict::BeyondLimits] {
        both(&|w| w.verdict(verdict));
    }
    for relation in [Relation::Coincident, Relation::Parallel, Relation::Meet, Relation::Skew] {
        both(&|w| w.relation(relation));
    }
    for nearly in [Special::Coincident, Special::Parallel, Special::Perpendicular, Special::Meeting] {
        let near = NearlySpecial { joints: (2, 3), nearly, by: 1e-4, is_angle: true };
        both(&|w| w.nearly(&near));
    }
    both(&|w| w.measured(Measured::Normal));
    for moved in [Moved::BranchToBase, Moved::BranchToRow(0), Moved::FirstToBase, Moved::LastToTool] {
        both(&|w| w.moved(&[moved, moved]));
    }
    both(&|w| w.moved(&[]));
    let branch = Tongue::English.words().moved(&[Moved::BranchToRow(0)]);
    assert_eq!(branch, "γ2 and b2 are part of row 1");
}

#[test]
fn names_of_branches() {
    let label = |part, number| Label { part, number };
    let branch = Roots(vec![
        (label(Part::Shoulder, 1), Choice::Plus),
        (label(Part::Elbow, 2), Choice::Minus),
        (label(Part::Wrist, 1), Choice::Root(3)),
    ]);
    assert_eq!(branch.to_string(), "shoulder+ elbow2− wrist3");
    assert_eq!(Tongue::English.words().branch(&branch), branch.to_string());
    assert_eq!(Tongue::French.words().branch(&branch), "épaule+ coude2− poignet3");
    assert_eq!(Tongue::French.words().numbers(&[0, 3, 4]), "1, 4 et 5");
    assert_eq!(Tongue::German.words().branch(&branch), "Schulter+ Ellenbogen2− Handgelenk3");
    assert_eq!(Tongue::German.words().numbers(&[0, 3, 4]), "1, 4 und 5");
    assert_eq!(Tongue::Spanish.words().branch(&branch), "hombro+ codo2− muñeca3");
    let listed = |words: &[&str]| {
        Tongue::Spanish.words().listed(&words.iter().map(ToString::to_string).collect::<Vec<_>>())
    };
    assert_eq!(
        [listed(&["2 erróneas", "1 ilegible"]), listed(&["una", "ilegible"])],
        ["2 erróneas y 1 ilegible", "una e ilegible"]
    );
}
