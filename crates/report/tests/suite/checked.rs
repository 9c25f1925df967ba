//! What is said of documents that were checked: every fact in words of its own in each language.

use crate::language::{both, check_text};
use denavit::description::{Convention, NotSet};
use denavit::forward::Reference;
use denavit::geometry::Axis;
use denavit::geometry::orientation::OrientationSet;
use denavit_check::inverse::{Cause, Composed, Missing, Undecided};
use denavit_check::{
    About, Change, CheckOptions, Checked, Condition, Finding, Formula, Instead, Jacobian, Meaning, Noted,
    Placement, ReadWith, Remark, Sense, ShortRow, Skipped, SlipKind, Spoken, TableCell, Unproved, Unreadable,
    Whereabouts, Zeros, check,
};
use denavit_reading::document::Format;
use denavit_reading::slip::Slip;
use denavit_report::words::{Tongue, Wording};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Symbol};
use std::rc::Rc;

fn formula(name: &str) -> Formula {
    Formula::new(Expr::symbol(name), &Rc::new(Vocabulary::new()))
}

const FRAME: fn() -> Meaning = || Meaning::Frame { of: Reference::Frame(3), seen_from: Reference::Frame(2) };

const MISSING: Missing = Missing { poses: 0.25, given: 1, existing: 2 };

const SHORT: ShortRow = ShortRow { row: 4, elements: 3, width: 4 };

/// A fact in English, and in French with ordinary blanks and apostrophes.
#[track_caller]
fn expect(message: &dyn Fn(&'static dyn Wording) -> String, english: &str, french: &str) {
    both(message);
    assert_eq!(message(Tongue::English.words()), english);
    let said = message(Tongue::French.words()).replace('\u{a0}', " ").replace('’', "'");
    assert_eq!(said, french);
}

#[test]
fn what_claims_are_about() {
    let frame = || Box::new(FRAME());
    let jacobian = |body, axes, is_angular_first, rows| {
        let order = if is_angular_first { [3, 4, 5, 0, 1, 2] } else { [0, 1, 2, 3, 4, 5] };
        Meaning::Jacobian(Jacobian { body, at: None, axes, is_angular_first, rows, order })
    };
    let last = Reference::Frame(6);
    for meaning in [
        Meaning::Hand,
        Meaning::Position,
        Meaning::Row,
        Meaning::Frame { of: Reference::Tool, seen_from: Reference::Base },
        Meaning::AnyFrame { of: 'j', seen_from: 'i' },
        Meaning::Inverse(frame()),
        Meaning::Transpose(frame()),
        Meaning::Product(vec![FRAME(), FRAME()]),
        Meaning::Sum { terms: [FRAME(), FRAME()].into(), is_difference: false },
        Meaning::Sum { terms: [FRAME(), FRAME()].into(), is_difference: true },
        Meaning::RotationAbout(Axis::Z),
        Meaning::TranslationAlong(Axis::X),
        Meaning::Translation,
        Meaning::Torques,
        jacobian(Reference::Tool, Reference::Frame(0), false, 6),
        jacobian(last, Reference::Tool, false, 4),
    ] {
        both(&|w| w.meaning(&meaning));
    }
    let scara = Jacobian {
        at: None,
        body: Reference::Tool,
        axes: Reference::Frame(0),
        is_angular_first: false,
        rows: 4,
        order: [0, 1, 2, 5, 3, 4],
    };
    expect(
        &|w| w.meaning(&Meaning::Jacobian(scara)),
        "the Jacobian of the hand, rows vx, vy, vz, ωz",
        "la jacobienne de l'organe terminal, lignes vx, vy, vz, ωz",
    );
    for about in [
        About::Helper,
        About::Table,
        About::TableRow,
        About::Configuration,
        About::Singularity,
        About::Matrices,
        About::Entry,
        About::Equation,
        About::Joint,
        About::Angle(OrientationSet::Rpy),
        About::Matrix(FRAME()),
    ] {
        both(&|w| w.about(&about));
    }
    let rotation = Meaning::Rotation(frame());
    expect(
        &|w| w.meaning(&rotation),
        "the rotation of frame 3 in frame 2",
        "la rotation du repère 3 dans le repère 2",
    );
    let axis = Meaning::Axis(Axis::Z, Meaning::Row.into());
    let french = "l'axe z de la matrice de passage d'une ligne quelconque";
    expect(&|w| w.meaning(&axis), "the axis z of the transform of any row", french);
    let origin = Meaning::Origin(Meaning::Translation.into());
    expect(&|w| w.meaning(&origin), "the origin of a translation", "l'origine d'une translation");
    let part = jacobian(last, Reference::Frame(3), true, 6);
    expect(
        &|w| w.meaning(&part),
        "the Jacobian of the origin of the last frame along the axes of frame 3, angular rows first",
        "la jacobienne de l'origine du dernier repère suivant les axes du repère 3, lignes de la vitesse angulaire d'abord",
    );
}

#[test]
fn what_matrices_are_instead() {
    for instead in [
        Instead::Inverse,
        Instead::Transpose,
        Instead::RotationTransposed,
        Instead::RowsExchanged(1, 2),
        Instead::RowSigns(3),
        Instead::ColumnsExchanged(1, 2),
        Instead::ColumnSigns(3),
        Instead::Frame { of: 2, seen_from: 1 },
        Instead::Backwards { of: 3, seen_from: 0 },
        Instead::Without { of: 3, seen_from: 0, link: 2 },
        Instead::ByTable { of: 2, seen_from: 1, line: 12 },
    ] {
        both(&|w| w.instead(instead));
    }
}

/// All that an author may choose.
fn placed() -> Placement {
    Placement {
        zeros: vec![(2, formula("pi/2"))],
        reversed: vec![3],
        base: true,
        hand: true,
        is_turned: true,
        names: vec![("l2".into(), "a2".into())],
        convention: Some(Convention::Craig),
        millimetres: true,
    }
}

#[test]
fn remarks() {
    for remark in [
        Remark::ManyRows { printed: 4, wanted: 3 },
        Remark::ShortRow(SHORT),
        Remark::Incomparable(3, 5),
        Remark::OthersDiffer(vec![(1, 3), (2, 4)]),
        Remark::AngleUnit,
        Remark::Millimetres,
        Remark::Metres,
        Remark::Sign,
        Remark::LastDigit,
        Remark::OffBy(0.25),
        Remark::Sampled,
        Remark::Compared(140),
        Remark::LeftOut(MISSING),
        Remark::NoSolution { value: Some(1), share: 0.5 },
        Remark::NoNumber { value: None, share: 0.5 },
        Remark::FailsAt(vec![0.0, 1.5]),
        Remark::Residual(formula("D1")),
        Remark::ByOwnTable,
        Remark::OfTrueCoordinates,
        Remark::Placed(Box::new(placed())),
    ] {
        both(&|w| w.remarked(&remark));
    }
    for by in [Cause::Arctan, Cause::Arcsin, Cause::Arccos, Cause::Atan2, Cause::Root, Cause::Other] {
        both(&|w| w.remarked(&Remark::SignLost { value: None, by, right_where: vec![] }));
    }
    let lost =
        Remark::SignLost { value: Some(1), by: Cause::Root, right_where: vec![formula("px"), formula("py")] };
    expect(
        &|w| w.remarked(&lost),
        "value 2 the sign of the root is not that of the configuration (right where px > 0 and py > 0)",
        "valeur 2 : le signe de la racine n'est pas celui de la configuration (juste pour px > 0 et py > 0)",
    );
    let zeros = Zeros { angle: Some(formula("q2")), values: vec![formula("a1"), formula("a2")] };
    let divided = Remark::DivisionByZero { factor: formula("D1"), zeros: vec![zeros] };
    expect(
        &|w| w.remarked(&divided),
        "division by zero where D1 = 0 (q2 = a1 or a2)",
        "division par zéro pour D1 = 0 (q2 = a1 ou a2)",
    );
    expect(&|w| w.remarked(&Remark::OffBy(2e9)), "off by 2000000000", "écart de 2000000000");
    expect(&|w| w.remarked(&Remark::OffBy(0.25)), "off by 0.25", "écart de 0,25");
}

#[test]
fn conditions_and_doubts() {
    for condition in [
        Condition::OneSign,
        Condition::OwnSign,
        Condition::AsUsed,
        Condition::Locked,
        Condition::Following,
        Condition::Placed(Box::new(placed())),
        Condition::Incomplete(None),
        Condition::Incomplete(Some(MISSING)),
        Condition::Compared { poses: 198, apart: 1e-16 },
        Condition::Compared { poses: 198, apart: 1e-7 },
        Condition::Configurations(vec![]),
        Condition::Orientations(vec![]),
        Condition::Orientations(vec![formula("nx")]),
    ] {
        both(&|w| w.right_where(&condition));
    }
    let [a, b, c] = ["px", "py", "pz"].map(formula);
    expect(
        &|w| w.right_where(&Condition::Configurations(vec![vec![a.clone(), b.clone()], vec![c.clone()]])),
        "where px > 0 and py > 0, or where pz > 0",
        "pour px > 0 et py > 0, ou pour pz > 0",
    );
    for why in [
        Unproved::NoLength,
        Unproved::NoRate,
        Unproved::NotFound,
        Unproved::NotOfSet,
        Unproved::NoPose,
        Unproved::Unsupported,
        Unproved::OtherConfiguration,
        Unproved::AgainstWords(Spoken::Gravity),
        Unproved::AgainstWords(Spoken::Shape),
        Unproved::AgainstWords(Spoken::Centres),
        Unproved::AgainstWords(Spoken::Inertias),
        Unproved::AgainstWords(Spoken::LeftOut),
        Unproved::AgainstWords(Spoken::Links),
        Unproved::UnknownColumn,
        Unproved::OtherJoints,
        Unproved::OtherNames,
        Unproved::OpenLoad,
        Unproved::Values(Undecided::UnknownSymbol(Symbol::new("zeta"))),
        Unproved::Values(Undecided::Shape),
        Unproved::Values(Undecided::Circular),
        Unproved::Values(Undecided::NeverDefined),
        Unproved::Values(Undecided::NoSamples),
        Unproved::Values(Undecided::NoEnumeration),
    ] {
        both(&|w| w.unproved(why));
    }
    expect(
        &|w| w.unproved(Unproved::OwnTable),
        "right by the table of the document, which was not held against that of the robot",
        "juste selon le tableau du document, qui n'a pas été comparé à celui du robot",
    );
    let values = ["px", "py"].map(String::from);
    expect(&|w| w.either(&values).unwrap_or_default(), "px or py", "px ou py");
    assert!(Tongue::ALL.iter().all(|l| l.words().either(&[]).is_none()));
}

#[test]
fn slips_and_changes() {
    let all = [
        Slip::Sign,
        Slip::SineForCosine,
        Slip::Index,
        Slip::Symbol,
        Slip::LostFactor,
        Slip::ExtraFactor,
        Slip::LostTerm,
        Slip::ExtraTerm,
        Slip::Bracket,
        Slip::Exponent,
        Slip::Number,
        Slip::Exchanged,
        Slip::Replaced,
    ];
    for slip in all {
        both(&|w| w.formula_slip(&slip));
    }
    both(&|w| w.slip(&SlipKind::ExchangedWith(2, 1)));
    expect(
        &|w| w.slip(&SlipKind::Arguments),
        "the arguments of atan2 exchanged",
        "les arguments de atan2 échangés",
    );
    both(&|w| w.slip(&SlipKind::OtherEntry));
    let several = |all: &[Slip]| SlipKind::Formula(Slip::Several(all.to_vec()));
    expect(&|w| w.slip(&several(&[Slip::Sign, Slip::Sign])), "a sign, 2 times", "un signe, 2 fois");
    expect(&|w| w.slip(&several(&[Slip::Sign, Slip::Index])), "a sign and an index", "un signe et un indice");

    let cell = || TableCell { letter: "d".into(), row: 2 };
    for change in [
        Change::Opposite(cell()),
        Change::Forgotten(cell()),
        Change::ExchangedWithNext(cell()),
        Change::Alpha { row: 3, degrees: 0 },
        Change::Alpha { row: 3, degrees: -90 },
        Change::Offset { row: 3, degrees: 180 },
        Change::CountedBackwards(5),
        Change::Convention(Convention::Craig),
        Change::NoTool,
        Change::Definition { name: "D1".into(), slip: SlipKind::Formula(Slip::Sign) },
    ] {
        both(&|w| w.change(&change));
    }
    let zero = Change::Vanishing(Symbol::new("D1"));
    assert!(Tongue::ALL.iter().all(|l| l.words().change(&zero) == "D1 = 0"));
}

#[test]
fn what_is_not_read() {
    let own = [
        Unreadable::Unknown("zeta".into()),
        Unreadable::ManyElements { elements: 10_000, most: 4_096 },
        Unreadable::ShortRow(SHORT),
        Unreadable::LongProduct,
        Unreadable::NeitherFormulaNorProduct,
        Unreadable::NoKnownProduct,
        Unreadable::NoConfiguration,
        Unreadable::Alias,
        Unreadable::NothingTold("fk".into()),
    ];
    for why in own {
        both(&|w| w.unreadable(&why));
        both(&|w| w.noted(&Noted::PassedOver(why.clone())));
        both(&|w| w.noted(&Noted::NotRead(why.clone())));
        if Tongue::English.words().unreadable_hint(&why).is_some() {
            both(&|w| w.unreadable_hint(&why).unwrap_or_default());
        }
    }
    for why in [
        Skipped::Unused("K".into()),
        Skipped::SaysNothing,
        Skipped::Given,
        Skipped::AmongWords,
        Skipped::OfProgram("fk".into()),
        Skipped::TooMany,
    ] {
        both(&|w| w.skipped(&why));
    }
    for sense in [
        Sense::Rates(vec![["A".into(), "q1".into()]]),
        Sense::LinkAlone,
        Sense::IndicesExchanged,
        Sense::Helper,
        Sense::CosineFirst,
        Sense::ColumnsSnap,
        Sense::PlaceIsO,
        Sense::ZeroIsBase,
        Sense::AgainstLoad,
        Sense::HandInFrames,
        Sense::Lengths { letter: 'l' },
        Sense::LoadInHand,
        Sense::WristEntries,
        Sense::Unit { millimetres: true },
        Sense::Unit { millimetres: false },
        Sense::Load { letter: 'W', axis: Axis::Z, is_minus: false },
    ] {
        both(&|w| w.sense(&sense));
    }
    expect(
        &|w| w.carried("A_2", 7),
        "follows from `A_2` in line 7, which is wrong",
        "découle de `A_2`, ligne 7, qui est faux",
    );
    let places = [
        Whereabouts::Joint,
        Whereabouts::End,
        Whereabouts::Middle,
        Whereabouts::FromJoint(formula("lc1")),
        Whereabouts::FromEnd(formula("lc1")),
        Whereabouts::At([formula("a"), formula("b"), formula("c")]),
    ];
    for at in places {
        both(&|w| {
            w.noted(&Noted::ReadWith(vec![ReadWith::Mass { mass: formula("m1"), link: 0, at: at.clone() }]))
        });
    }
    for read in [
        ReadWith::Point { link: 1 },
        ReadWith::Rod { link: 1 },
        ReadWith::Inertia { inertia: formula("I2"), link: 1, is_at_joint: true },
        ReadWith::Inertia { inertia: formula("I2"), link: 1, is_at_joint: false },
        ReadWith::Rotor { inertia: formula("Jm"), joint: 0 },
        ReadWith::Gravity([formula("a"), formula("b"), formula("c")]),
    ] {
        both(&|w| w.noted(&Noted::ReadWith(vec![read.clone()])));
    }
    let together = |spurious| Composed { poses: 120, existing: 480, yielded: 240, spurious, open: vec![] };
    for note in [
        Noted::TooLong { bytes: 9_000_000, most: 8_000_000 },
        Noted::NoRobot,
        Noted::ReadAs(Convention::Khalil),
        Noted::InMillimetres,
        Noted::Supported { convention: Convention::Craig, right: 12, rival: 3 },
        Noted::NotSet("a9".into(), NotSet::Unknown { name: "a9".into(), known: vec![] }),
        Noted::NotSet(
            "a9".into(),
            NotSet::Unknown { name: "a9".into(), known: vec!["a1".into(), "a2".into()] },
        ),
        Noted::UnknownRobot("nobody".into()),
        Noted::NoSuchTable,
        Noted::UnknownConvention("foo".into()),
        Noted::NoTool,
        Noted::Together(together(0)),
        Noted::Together(together(1)),
        Noted::Together(together(3)),
    ] {
        both(&|w| w.noted(&note));
        if Tongue::English.words().noted_hint(&note).is_some() {
            both(&|w| w.noted_hint(&note).unwrap_or_default());
        }
    }
}

/// The facts of a document in words, without what readers say in English.
fn all_said(checked: &Checked, words: &dyn Wording) -> Vec<String> {
    let mut said: Vec<String> = checked.causes.iter().map(|c| words.change(&c.change)).collect();
    for claim in &checked.claims {
        said.push(words.about(&claim.about));
        said.extend(claim.instead.map(|i| words.instead(i)));
        said.extend(claim.remarks.iter().map(|r| words.remarked(r)));
        for entry in &claim.entries {
            match &entry.finding {
                Finding::Equal { .. } | Finding::Unreadable(_) => {}
                Finding::Undecided { why } => said.push(words.unproved(*why)),
                Finding::Carried { by, .. } => said.push(words.carried(&checked.claims[*by].name, 1)),
                Finding::Conditional { condition, remarks, .. } => {
                    said.push(words.right_where(condition));
                    said.extend(remarks.iter().map(|r| words.remarked(r)));
                }
                Finding::Wrong(wrong) => {
                    let slips = wrong.slip.iter().chain(&wrong.rivals);
                    said.extend(slips.map(|s| words.slip(&s.kind)));
                    said.extend(wrong.remarks.iter().map(|r| words.remarked(r)));
                }
            }
        }
    }
    said
}

#[test]
fn documents_in_all_languages() {
    for name in ["cylindrical", "stanford", "rx90"] {
        let path = format!("{}/../../examples/documents/{name}.md", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
        let checked = check(&text, Format::Markdown, None, &CheckOptions::default()).expect("a table");
        for language in Tongue::ALL {
            let said = all_said(&checked, language.words());
            assert!(said.len() >= checked.claims.len() && !said.is_empty());
            said.iter().for_each(|text| check_text(text, language, name));
        }
    }
}
