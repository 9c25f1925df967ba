//! Documents that were checked.

use super::read_with::{dynamic, placed, read_with, sign_lost, spoken};
use super::{German, counted};
use crate::words::check::{ROUNDING, percent, positive, rows_of};
use crate::words::{Check, Terms};
use denavit::description::NotSet;
use denavit::forward::Reference;
use denavit_check::inverse::{Composed, Missing, Undecided};
use denavit_check::{
    About, Change, Condition, Formula, Instead, Jacobian, Meaning, Noted, Remark, Sense, ShortRow, Skipped,
    SlipKind, TableCell, Unproved, Unreadable, ValueSlip, Zeros, decimal,
};
use denavit_reading::slip::Slip;

impl Check for German {
    fn about(&self, about: &About) -> String {
        match about {
            About::Matrix(meaning) => return self.meaning(meaning),
            About::Matrices => "eine Gleichung zwischen Matrizen",
            About::Entry => "ein Element",
            About::Equation => "eine Gleichung",
            About::Helper => "eine Hilfsgröße",
            About::Singularity => "eine singuläre Stellung",
            About::Joint => "Werte eines Gelenks",
            About::Table => "die Tabelle des Roboters",
            About::Configuration => "eine Stellung des Roboters",
            About::TableRow => "eine Zeile der Tabelle",
            About::Angle(set) => return format!("ein Winkel des Satzes {set}"),
            About::Dynamics(what) => dynamic(*what),
        }
        .into()
    }

    fn entry(&self, name: &str, place: Option<(usize, usize)>) -> String {
        place.map_or_else(|| name.into(), |(r, c)| format!("{name}, Zeile {r}, Spalte {c}"))
    }

    fn meaning(&self, meaning: &Meaning) -> String {
        let of = |what: &str, whose: &Meaning| format!("{what} {}", genitive(&self.meaning(whose)));
        match meaning {
            Meaning::Hand => "der Endeffektor".into(),
            Meaning::Position => "die Position des Endeffektors".into(),
            Meaning::Row => "die Transformationsmatrix einer beliebigen Zeile".into(),
            Meaning::Frame { of, seen_from } => format!("{} {}", frame(*of), in_frame(*seen_from)),
            Meaning::AnyFrame { of, seen_from } => {
                format!("System {of} in System {seen_from}, wo sie auch liegen")
            }
            Meaning::Rotation(whose) => of("die Drehung", whose),
            Meaning::Axis(axis, whose) => of(&format!("die {axis}-Achse"), whose),
            Meaning::Origin(whose) => of("der Ursprung", whose),
            Meaning::Inverse(whose) => of("die Inverse", whose),
            Meaning::Transpose(whose) => of("die Transponierte", whose),
            Meaning::Product(factors) => {
                factors.iter().map(|f| self.meaning(f)).collect::<Vec<_>>().join(" mal ")
            }
            Meaning::Sum { terms, is_difference } => {
                let sign = if *is_difference { "−" } else { "+" };
                format!("{} {sign} {}", self.meaning(&terms[0]), self.meaning(&terms[1]))
            }
            Meaning::RotationAbout(axis) => format!("die Drehung um {axis}"),
            Meaning::TranslationAlong(axis) => format!("die Verschiebung längs {axis}"),
            Meaning::Translation => "eine Verschiebung".into(),
            Meaning::Torques => "die Gelenkmomente".into(),
            Meaning::Jacobian(jacobian) => matrix_of_velocities(jacobian),
            Meaning::Velocity { of, along, is_angular } => {
                let what = if *is_angular { "die Winkelgeschwindigkeit" } else { "die Geschwindigkeit" };
                let of = genitive(&frame(*of));
                match along {
                    Reference::Base | Reference::Frame(0) => format!("{what} {of}"),
                    _ => format!("{what} {of} längs der Achsen {}", genitive(&frame(*along))),
                }
            }
            Meaning::AtRest(what) => format!("{}, alle Gelenke bei 0", self.meaning(what)),
            Meaning::Screw { joint, .. } => format!("die Schraube von Gelenk {joint}, alle Gelenke bei 0"),
            Meaning::Column(joint, of) => format!("Spalte {joint} {}", genitive(&matrix_of_velocities(of))),
        }
    }

    fn instead(&self, instead: Instead) -> String {
        match instead {
            Instead::Inverse => "ihre Inverse".into(),
            Instead::Transpose => "ihre Transponierte".into(),
            Instead::RotationTransposed => "dieselbe mit transponierter Drehung".into(),
            Instead::RowsExchanged(i, j) => format!("dieselbe mit vertauschten Zeilen {i} und {j}"),
            Instead::RowSigns(i) => format!("dieselbe mit anderen Vorzeichen in Zeile {i}"),
            Instead::ColumnsExchanged(i, j) => format!("dieselbe mit vertauschten Spalten {i} und {j}"),
            Instead::ColumnSigns(i) => format!("dieselbe mit anderen Vorzeichen in Spalte {i}"),
            Instead::Frame { of, seen_from } => format!("System {of} in System {seen_from}"),
            Instead::Backwards { of, seen_from } => {
                format!(
                    "die Matrizen von System {seen_from} bis {of} in umgekehrter Reihenfolge multipliziert"
                )
            }
            Instead::Without { of, seen_from, link } => {
                format!("System {of} in System {seen_from}, ohne die Matrix {link}")
            }
            Instead::ByTable { of, seen_from, line } => {
                format!("System {of} in System {seen_from} nach der Tabelle in Zeile {line}")
            }
        }
    }

    fn remarked(&self, remark: &Remark) -> String {
        match remark {
            Remark::ManyRows { printed, wanted } => {
                format!("{} statt {wanted}", counted(*printed, "gedruckte Zeile", "gedruckte Zeilen"))
            }
            Remark::ShortRow(row) => short_row(*row),
            Remark::Incomparable(r, c) => format!("Zeile {r}, Spalte {c} lässt sich mit nichts vergleichen"),
            Remark::OthersDiffer(places) => {
                let places: Vec<String> = places.iter().map(|(r, c)| format!("{r},{c}")).collect();
                format!("ausgerechnet weichen auch die Elemente {} ab", places.join("; "))
            }
            Remark::AngleUnit => "richtig, wenn man Grad für Radiant hält oder umgekehrt".into(),
            Remark::Millimetres => "richtig in Millimetern".into(),
            Remark::Metres => "richtig in Metern".into(),
            Remark::Sign => "richtig bis auf das Vorzeichen".into(),
            Remark::LastDigit => {
                "in der letzten Stelle falsch: unterwegs wurden Winkel oder π gerundet".into()
            }
            Remark::OffBy(x) => format!("Abweichung {}", self.written(decimal(*x))),
            Remark::Sampled => "an Stichproben gefunden, nicht bewiesen".into(),
            Remark::Compared(poses) => {
                format!("durch Vergleich mit allen Lösungen bei {}", counted(*poses, "Pose", "Posen"))
            }
            Remark::ReadAs(sense) => self.sense(sense),
            Remark::SignLost { value, by, right_where } => {
                let which = value.map(|k| format!("Wert {}: ", k + 1)).unwrap_or_default();
                let place = match &right_where[..] {
                    [] => String::new(),
                    some => format!(" (richtig für {})", positive(some, " und ")),
                };
                format!("{which}{}{place}", sign_lost(*by))
            }
            Remark::LeftOut(missing) => {
                format!("bei {} der Posen fehlen Lösungen: {}", share(missing.poses), given(*missing))
            }
            Remark::NoSolution { value, share: x } => {
                format!("{} gehört bei {} der Posen zu keiner Lösung", which(*value), share(*x))
            }
            Remark::NoNumber { value, share: x } => {
                format!("{} ist bei {} der Posen keine Zahl", which(*value), share(*x))
            }
            Remark::DivisionByZero { factor, zeros } => division_by_zero(factor, zeros),
            Remark::FailsAt(q) => {
                let q: Vec<String> = q.iter().map(|x| self.written(format!("{x:.4}"))).collect();
                format!("falsch bei q = ({}), obwohl das Gelenk dort bestimmt ist", q.join("; "))
            }
            Remark::Residual(e) => format!("linke minus rechte Seite ist {e}"),
            Remark::Placed(placement) => format!("derselbe Mechanismus: {}", placed(placement)),
            Remark::OfTrueCoordinates => {
                "für die wahren Koordinaten, nicht für die weiter oben gedruckten".into()
            }
            Remark::ByOwnTable => "nach der Tabelle des Dokuments, die derselbe Mechanismus ist".into(),
        }
    }

    fn sense(&self, sense: &Sense) -> String {
        match sense {
            Sense::Rates(letters) => {
                let named = letters
                    .iter()
                    .map(|[letter, joint]| format!("{letter} wird als Geschwindigkeit von {joint} gelesen"));
                return named.collect::<Vec<_>>().join(", ");
            }
            Sense::LinkAlone => "als Matrix eines einzelnen Glieds gelesen, nicht als Lage eines Systems in der Basis",
            Sense::OwnLinks => "gelesen, wie das Dokument sie definiert: nur ihr Produkt ist das des Roboters",
            Sense::VelocitiesOfJacobian => {
                "Geschwindigkeiten als die der Jacobi-Matrix gelesen: ihres Punkts, längs ihrer Achsen"
            }
            Sense::IndicesExchanged => {
                "gelesen mit dem System links und dem, in dem es betrachtet wird, rechts"
            }
            Sense::Helper => "als Hilfsgröße des Dokuments gelesen, nicht als Element der Pose",
            Sense::CosineFirst => "mit dem Kosinus als erstem Argument von atan2 gelesen",
            Sense::ColumnsSnap => "mit s, n, a, P als Spalten der Pose gelesen",
            Sense::HandInFrames => {
                "Positionen mit einer Nummer werden als die des Endeffektors gelesen, von diesem System aus betrachtet"
            }
            Sense::AgainstLoad => "Momente werden als die gelesen, die der Last das Gleichgewicht halten",
            Sense::Lengths { letter } => {
                return format!("{letter}1, {letter}2 … werden als die Längen in den Zeilen der Tabelle gelesen");
            }
            Sense::Tool { place: [x, y, z] } => {
                return format!("der Endeffektor wird als der Punkt ({x}, {y}, {z}) des letzten Systems gelesen");
            }
            Sense::LoadInHand => {
                "die Komponenten der Last werden als die längs der Achsen des Endeffektors gelesen"
            }
            Sense::WristEntries => "mit r_ij als Elementen von System 6 in System 3 gelesen",
            Sense::ZeroIsBase => "mit der Basis des Roboters als System 0 gelesen",
            Sense::PlaceIsO => "mit o als Position des Endeffektors gelesen",
            Sense::Unit { millimetres: true } => "Längen ohne Einheit als Millimeter gelesen",
            Sense::Unit { millimetres: false } => "Längen ohne Einheit als Meter gelesen",
            Sense::Load { letter, axis, is_minus } => {
                let along = if *is_minus { "entgegen der" } else { "längs der" };
                if *letter == 'N' {
                    return format!("die Last in Newton wird am Endeffektor gelesen, {along} {axis}-Achse");
                }
                return format!("{letter} als Last am Endeffektor gelesen, {along} {axis}-Achse");
            }
        }
        .into()
    }

    fn skipped(&self, why: &Skipped) -> String {
        match why {
            Skipped::Unreadable(why) => self.unreadable(why),
            Skipped::Unused(name) => format!("definiert `{name}`, was nichts Bewiesenes benutzt"),
            Skipped::SaysNothing => "sagt nichts Bekanntes über den Roboter".into(),
            Skipped::Given => {
                "für eine gegebene Stellung gehalten: nichts, was beurteilt wird, stützt sich darauf".into()
            }
            Skipped::AmongWords => {
                "steht zwischen Wörtern: nichts zeigt, wo die Formel beginnt und endet".into()
            }
            Skipped::OfProgram(name) => format!("nichts sagt, was `{name}` ist"),
            Skipped::TooMany => "das Dokument hat mehr Formeln, als beurteilt werden".into(),
        }
    }

    fn carried(&self, cause: &str, line: usize) -> String {
        format!("folgt aus `{cause}` in Zeile {line}, und das ist falsch")
    }

    fn right_where(&self, condition: &Condition) -> String {
        match condition {
            Condition::OneSign => "mit einem der beiden Vorzeichen".into(),
            Condition::OwnSign => "mit dem Vorzeichen, das zur Stellung gehört".into(),
            Condition::Incomplete(missing) => {
                let gives = missing.map(|m| format!(": {}", given(m))).unwrap_or_default();
                format!("soweit sie reicht, aber es fehlen Lösungen{gives}")
            }
            Condition::Compared { poses, apart } if *apart <= ROUNDING => {
                format!("nach {}; bewiesen ist es nicht", counted(*poses, "Pose", "Posen"))
            }
            Condition::Compared { poses, apart } => format!(
                "bis auf etwa {apart:.0e} bei {}, was mehr ist als Rundung",
                counted(*poses, "Pose", "Posen")
            ),
            Condition::Configurations(any) if any.is_empty() => "in einem Teil aller Stellungen".into(),
            Condition::Configurations(any) => {
                let any: Vec<String> = any.iter().map(|all| positive(all, " und ")).collect();
                format!("für {}", any.join(", oder für "))
            }
            Condition::Orientations(all) if all.is_empty() => "in einem Teil aller Orientierungen".into(),
            Condition::Orientations(all) => format!("für {}", positive(all, " und ")),
            Condition::AsUsed => "soweit richtig ist, was sie benutzt".into(),
            Condition::Locked => "solange andere Gelenke ruhen".into(),
            Condition::Following => "wo ein Gelenk anderen folgt, wie der Text es sagt".into(),
            Condition::Placed(placement) => {
                format!("als derselbe Mechanismus, wenn die Aufgabe dies freistellt: {}", placed(placement))
            }
        }
    }

    fn either(&self, values: &[String]) -> Option<String> {
        (!values.is_empty()).then(|| values.join(" oder "))
    }

    fn unproved(&self, why: Unproved) -> String {
        match why {
            Unproved::NoRate => {
                "die Gelenkgeschwindigkeiten haben hier keine Werte: vorher angeben, `dq1 = 0.5 rad/s`"
            }
            Unproved::NoLength => "eine Länge hat keinen Wert: vorher angeben, `a1 = 0.5 m`",
            Unproved::NotFound => "weder als gleich bewiesen noch irgendwo verschieden gefunden",
            Unproved::OwnTable => {
                "richtig nach der Tabelle des Dokuments, die nicht mit der des Roboters verglichen wurde"
            }
            Unproved::NotOfSet => "das sind keine Winkel dieses Satzes",
            Unproved::NoPose => "nichts sagt, zu welcher Pose diese Gelenkwerte gehören",
            Unproved::Unsupported => {
                "stimmt nicht mit dem Roboter überein, wie er hier gelesen wird, und nichts im Dokument bestätigt diese Lesart"
            }
            Unproved::OtherConfiguration => {
                "richtig bei einer anderen Stellung, die das Dokument nennt, nicht bei der letzten"
            }
            Unproved::OpenReading => {
                "nichts sagt, wie Massen, Trägheiten und Schwerkraft gemeint sind, und ohne das ist sie nicht zu widerlegen"
            }
            Unproved::AgainstWords(of) => {
                return format!("sie ist nur richtig, wenn der Text nicht gilt: {}", spoken(of));
            }
            Unproved::UnknownColumn => "was in der Spalte steht, ist nicht bekannt",
            Unproved::OtherJoints => "sie hat nicht die Gelenke des Roboters",
            Unproved::OtherNames => "sie hat Längen, die der Roboter nicht kennt",
            Unproved::OpenLoad => {
                "ein Moment daneben enthält einen unbekannten Namen: Die Last kann weitere Komponenten haben"
            }
            Unproved::Values(why) => return self.undecided(why),
        }
        .into()
    }

    fn undecided(&self, why: Undecided) -> String {
        match why {
            Undecided::UnknownSymbol(s) => {
                return format!(
                    "`{}` ist weder ein Gelenk noch eine Länge noch ein Element der Pose",
                    s.name()
                );
            }
            Undecided::Shape => "es sind zu viele Werte",
            Undecided::Circular => "die Formel enthält das Gelenk, das sie ergeben soll",
            Undecided::NeverDefined => "die Formel ist bei keiner Pose eine Zahl",
            Undecided::NoSamples => "es gibt keine Posen, an denen sie zu prüfen wäre",
            Undecided::NoEnumeration => "die Lösungen dieses Arms lassen sich nicht aufzählen",
        }
        .into()
    }

    fn slip(&self, kind: &SlipKind) -> String {
        match kind {
            SlipKind::Formula(slip) => self.formula_slip(slip),
            SlipKind::Arguments => "die Argumente von atan2 vertauscht".into(),
            SlipKind::ExchangedWith(r, c) => format!("mit Zeile {r}, Spalte {c} vertauscht"),
            SlipKind::OtherEntry => "ein anderes Element".into(),
        }
    }

    fn formula_slip(&self, slip: &Slip) -> String {
        match slip {
            Slip::Sign => "ein Vorzeichen",
            Slip::SineForCosine => "Sinus und Kosinus verwechselt",
            Slip::Index => "ein Index",
            Slip::Symbol => "ein anderes Symbol",
            Slip::LostFactor => "ein Faktor fehlt",
            Slip::ExtraFactor => "ein Faktor zu viel",
            Slip::LostTerm => "ein Summand fehlt",
            Slip::ExtraTerm => "ein Summand zu viel",
            Slip::Bracket => "eine Klammer",
            Slip::Exponent => "ein Exponent",
            Slip::Number => "eine Zahl",
            Slip::Exchanged => "zwei Namen vertauscht",
            Slip::Replaced => "ein anderer Ausdruck",
            Slip::Several(all) => {
                return match all.first() {
                    Some(first) if all.iter().all(|s| s == first) => {
                        format!("{}, {}-mal", self.formula_slip(first), all.len())
                    }
                    _ => all.iter().map(|s| self.formula_slip(s)).collect::<Vec<_>>().join(" und "),
                };
            }
        }
        .into()
    }

    fn value_slip(&self, slip: ValueSlip) -> String {
        match slip {
            ValueSlip::Sign => "ein Vorzeichen".into(),
            ValueSlip::AngleUnit => "Grad und Radiant verwechselt".into(),
            ValueSlip::Factor => "ein Faktor".into(),
            ValueSlip::PowerOfTen => "eine Zehnerpotenz".into(),
            ValueSlip::Term(n) => format!("der Summand vom Grad {n}"),
            ValueSlip::Other => "ein anderer Wert".into(),
        }
    }

    fn change(&self, change: &Change) -> String {
        match change {
            Change::Opposite(TableCell { letter, row }) => {
                format!("{letter}{row} in der Tabelle mit umgekehrtem Vorzeichen")
            }
            Change::Forgotten(TableCell { letter, row }) => format!("{letter}{row} vergessen"),
            Change::ExchangedWithNext(TableCell { letter, row }) => {
                format!("{letter}{row} und {letter}{} in der Tabelle vertauscht", row + 1)
            }
            Change::Alpha { row, degrees: 0 } => format!("α{row} = 0 in der Tabelle"),
            Change::Alpha { row, degrees } => format!("α{row} = {degrees}° in der Tabelle"),
            Change::Offset { row, degrees } => format!("θ{row} um {degrees}° versetzt"),
            Change::CountedBackwards(row) => format!("θ{row} andersherum gezählt"),
            Change::Convention(convention) => format!("die Tabelle in der Konvention `{convention}` gelesen"),
            Change::NoTool => "das Werkzeug weggelassen".into(),
            Change::Vanishing(symbol) => self.is_zero(*symbol),
            Change::Definition { name, slip } => format!("die Definition von {name}: {}", self.slip(slip)),
        }
    }

    fn unreadable(&self, why: &Unreadable) -> String {
        match why {
            Unreadable::Syntax { message, .. } => message.clone(),
            Unreadable::Unknown(name) => format!("unbekannter Name `{name}`"),
            Unreadable::ManyElements { elements, most } => {
                format!("die Matrix hat {elements} Elemente; gelesen werden höchstens {most}")
            }
            Unreadable::ShortRow(row) => short_row(*row),
            Unreadable::LongProduct => "das Produkt ist zu lang, um ausgerechnet zu werden".into(),
            Unreadable::NeitherFormulaNorProduct => "weder eine Formel noch ein Produkt von Matrizen".into(),
            Unreadable::NoKnownProduct => "kein Produkt bekannter Matrizen".into(),
            Unreadable::NoConfiguration => "eine Zahl, aber die Gelenke haben hier keine Werte".into(),
            Unreadable::Alias => "der Alias ist unlesbar".into(),
            Unreadable::NothingTold(function) => format!("nichts sagt, was `{function}` zurückgibt"),
        }
    }

    fn unreadable_hint(&self, why: &Unreadable) -> Option<String> {
        match why {
            Unreadable::Syntax { hint, .. } => hint.clone(),
            Unreadable::NoConfiguration => {
                Some("vorher angeben: `θ1 = 30°, θ2 = 45°` oder `q = [0.5, 0.8]`".into())
            }
            Unreadable::NothingTold(_) => Some(
                "eine Pose, eine Position oder eine Jacobi-Matrix als Array zurückgeben, oder dem Ergebnis einen Namen wie T06, px, J \
                 geben"
                    .into(),
            ),
            Unreadable::Unknown(_)
            | Unreadable::ManyElements { .. }
            | Unreadable::ShortRow(_)
            | Unreadable::LongProduct
            | Unreadable::NeitherFormulaNorProduct
            | Unreadable::NoKnownProduct
            | Unreadable::Alias => None,
        }
    }

    fn noted(&self, what: &Noted) -> String {
        match what {
            Noted::Table { message, .. } | Noted::Document(message) => message.clone(),
            Noted::TooLong { bytes, most } => {
                format!("das Dokument hat {bytes} Bytes; gelesen werden höchstens {most}")
            }
            Noted::NoRobot => {
                "es gibt keinen Roboter: im Dokument steht keine Tabelle von Denavit-Hartenberg-Parametern"
                    .into()
            }
            Noted::ReadAs(convention) => {
                format!("Tabellen werden in der Konvention {convention} gelesen: so sagt es der Text")
            }
            Noted::InMillimetres => {
                "Längen ohne Einheit in Tabellen sind Millimeter: so sagt es der Text".into()
            }
            Noted::Supported { convention, right, rival } => format!(
                "Tabellen werden in der Konvention {convention} gelesen: {right} Aussagen des Textes sind so richtig, {rival} in einer anderen"
            ),
            Noted::NotSet(_, NotSet::Unknown { name, known }) => match &known[..] {
                [] => format!("`{name}` bekommt einen Wert: es gibt keine Parameter"),
                known => {
                    format!("`{name}` bekommt einen Wert, ist aber unbekannt; es gibt {}", known.join(", "))
                }
            },
            Noted::NotSet(name, NotSet::Value(_)) => format!("`{name}` bekommt einen unlesbaren Wert"),
            Noted::Reading(sense) => self.sense(sense),
            Noted::UnknownRobot(name) => format!("im Katalog ist kein Roboter `{name}`"),
            Noted::NoSuchTable => "diese Tabelle gibt es nicht".into(),
            Noted::UnknownConvention(name) => format!("unbekannte Konvention `{name}`"),
            Noted::NoTool => "ein Werkzeug hat drei Längen".into(),
            Noted::PassedOver(why) => format!("übergangen: {}", self.unreadable(why)),
            Noted::NotRead(why) => format!("nicht gelesen: {}", self.unreadable(why)),
            Noted::Together(composed) => together(composed),
            Noted::ReadWith(all) => {
                let all: Vec<String> = all.iter().map(read_with).collect();
                format!(
                    "gelesen mit: {}; so ist das meiste richtig, und der Text sagt es nicht",
                    all.join("; ")
                )
            }
        }
    }

    fn noted_hint(&self, what: &Noted) -> Option<String> {
        let hint = match what {
            Noted::Table { hint, .. } => return hint.clone(),
            Noted::PassedOver(why) | Noted::NotRead(why) => return self.unreadable_hint(why),
            Noted::NoRobot => {
                "den Roboter vor der Datei nennen, oder seine Tabelle ins Dokument setzen, mit mindestens dreien von theta, d, a, alpha, \
                 r im Kopf"
            }
            Noted::UnknownConvention(_) => "die Konventionen sind standard, craig und khalil",
            Noted::NoTool => "`tool 0, 0, r_7` schreiben",
            Noted::Document(_)
            | Noted::TooLong { .. }
            | Noted::ReadAs(_)
            | Noted::InMillimetres
            | Noted::Supported { .. }
            | Noted::Reading(_)
            | Noted::NotSet(..)
            | Noted::UnknownRobot(_)
            | Noted::NoSuchTable
            | Noted::Together(_)
            | Noted::ReadWith(_) => return None,
        };
        Some(hint.into())
    }
}

/// A noun with its article, or a numbered one without, in the genitive: `des Endeffektors`, `von System 3 in System 2`.
fn genitive(noun: &str) -> String {
    let (noun, rest) = match noun.find(" in ") {
        Some(at) if noun.starts_with("der ") || noun.starts_with("die ") => noun.split_at(at),
        _ => (noun, ""),
    };
    let declined = match noun.split_once(' ') {
        Some(("der", "Endeffektor")) => "des Endeffektors".into(),
        Some(("der", rest)) => {
            let (head, tail) =
                rest.split_once(' ').map_or((rest, String::new()), |(h, t)| (h, format!(" {t}")));
            format!("des {head}s{tail}")
        }
        Some(("die", rest)) => format!("der {rest}"),
        Some(("eine", rest)) => format!("einer {rest}"),
        _ => format!("von {noun}"),
    };
    declined + rest
}

fn frame(which: Reference) -> String {
    match which {
        Reference::Base => "die Basis".into(),
        Reference::Frame(k) => format!("System {k}"),
        Reference::Tool => "der Endeffektor".into(),
    }
}

fn in_frame(which: Reference) -> String {
    match which {
        Reference::Base => "in der Basis".into(),
        Reference::Frame(k) => format!("in System {k}"),
        Reference::Tool => "im Endeffektor".into(),
    }
}

fn matrix_of_velocities(jacobian: &Jacobian) -> String {
    let body = match jacobian.body {
        Reference::Tool => "des Endeffektors",
        Reference::Base | Reference::Frame(_) => "des Ursprungs des letzten Systems",
    };
    let axes = match jacobian.axes {
        Reference::Base | Reference::Frame(0) => String::new(),
        Reference::Frame(k) => format!(" längs der Achsen von System {k}"),
        Reference::Tool => " längs seiner eigenen Achsen".into(),
    };
    let at = jacobian.at.map_or(String::new(), |k| format!(" im Ursprung von System {k}"));
    let first = if jacobian.is_angular_first { ", Winkelgeschwindigkeit zuerst" } else { "" };
    let part = rows_of(jacobian).map_or(String::new(), |rows| format!(", Zeilen {rows}"));
    format!("die Jacobi-Matrix {body}{at}{axes}{first}{part}")
}

fn short_row(ShortRow { row, elements, width }: ShortRow) -> String {
    format!("Zeile {row} hat {} statt {width}", counted(elements, "Element", "Elemente"))
}

/// A value among several, or the formula that has one only.
fn which(value: Option<usize>) -> String {
    value.map_or("die Formel".into(), |k| format!("Wert {}", k + 1))
}

fn share(share: f64) -> String {
    format!("{} %", percent(share))
}

/// How many values there are of those that exist.
fn given(missing: Missing) -> String {
    format!("{} von {}", counted(missing.given, "Wert", "Werte"), missing.existing)
}

fn division_by_zero(factor: &Formula, zeros: &[Zeros]) -> String {
    let zero = |zeros: &Zeros| {
        let angle = zeros.angle.as_ref().map(ToString::to_string).unwrap_or_default();
        let values: Vec<String> = zeros.values.iter().map(ToString::to_string).collect();
        format!("{angle} = {}", values.join(" oder "))
    };
    let zeros: Vec<String> = zeros.iter().map(zero).collect();
    let place = if zeros.is_empty() { String::new() } else { format!(" ({})", zeros.join("; ")) };
    format!("Division durch null für {factor} = 0{place}")
}

fn together(c: &Composed) -> String {
    let spurious = match c.spurious {
        0 => String::new(),
        1 => ", dazu 1 Stellung, die die Pose nicht erreicht".into(),
        n => format!(", dazu {n} Stellungen, die die Pose nicht erreichen"),
    };
    format!(
        "der Reihe nach ergeben die Formeln {} von {} Lösungen bei {}{spurious}",
        c.yielded,
        c.existing,
        counted(c.poses, "Pose", "Posen")
    )
}
