//! Documents that were checked.

use super::read_with::{dynamic, read_with, spoken};
use super::{French, counted, printed};
use crate::words::check::{ROUNDING, percent, positive, rows_of};
use crate::words::{Check, Terms};
use denavit::description::NotSet;
use denavit::forward::Reference;
use denavit_check::inverse::{Cause, Composed, Missing, Undecided};
use denavit_check::{
    About, Change, Condition, Formula, Instead, Jacobian, Meaning, Noted, Placement, Remark, Sense, ShortRow,
    Skipped, SlipKind, TableCell, Unproved, Unreadable, ValueSlip, Zeros, decimal,
};
use denavit_reading::slip::Slip;

impl Check for French {
    fn about(&self, about: &About) -> String {
        printed(match about {
            About::Matrix(meaning) => return self.meaning(meaning),
            About::Matrices => "une équation entre matrices",
            About::Entry => "un élément",
            About::Equation => "une équation",
            About::Helper => "une grandeur auxiliaire",
            About::Singularity => "une configuration singulière",
            About::Joint => "les valeurs d’une articulation",
            About::Table => "le tableau du robot",
            About::Configuration => "une configuration du robot",
            About::TableRow => "une ligne du tableau",
            About::Angle(set) => return format!("un angle du triplet {set}"),
            About::Dynamics(what) => dynamic(*what),
        })
    }

    fn entry(&self, name: &str, place: Option<(usize, usize)>) -> String {
        place.map_or_else(|| name.into(), |(r, c)| format!("{name}, ligne {r}, colonne {c}"))
    }

    fn meaning(&self, meaning: &Meaning) -> String {
        let of = |what: &str, whose: &Meaning| say!("{what} {}", genitive(&self.meaning(whose)));
        match meaning {
            Meaning::Hand => say!("l’organe terminal"),
            Meaning::Position => say!("la position de l’organe terminal"),
            Meaning::Row => say!("la matrice de passage d’une ligne quelconque"),
            Meaning::Frame { of, seen_from } => say!("{} dans {}", frame(*of), frame(*seen_from)),
            Meaning::AnyFrame { of, seen_from } => {
                say!("le repère {of} dans le repère {seen_from}, où qu’ils soient")
            }
            Meaning::Rotation(whose) => of("la rotation", whose),
            Meaning::Axis(axis, whose) => of(&format!("l’axe {axis}"), whose),
            Meaning::Origin(whose) => of("l’origine", whose),
            Meaning::Inverse(whose) => of("l’inverse", whose),
            Meaning::Transpose(whose) => of("la transposée", whose),
            Meaning::Product(factors) => {
                factors.iter().map(|f| self.meaning(f)).collect::<Vec<_>>().join(" fois ")
            }
            Meaning::Sum { terms, is_difference } => {
                let sign = if *is_difference { "−" } else { "+" };
                format!("{} {sign} {}", self.meaning(&terms[0]), self.meaning(&terms[1]))
            }
            Meaning::RotationAbout(axis) => format!("la rotation autour de {axis}"),
            Meaning::TranslationAlong(axis) => format!("la translation suivant {axis}"),
            Meaning::Translation => "une translation".into(),
            Meaning::Torques => say!("les couples des articulations"),
            Meaning::Jacobian(jacobian) => matrix_of_velocities(jacobian),
            Meaning::Velocity { of, along, is_angular } => {
                let what = if *is_angular { "la vitesse angulaire" } else { "la vitesse" };
                match along {
                    Reference::Base | Reference::Frame(0) => say!("{what} {}", genitive(&frame(*of))),
                    _ => {
                        say!("{what} {} suivant les axes {}", genitive(&frame(*of)), genitive(&frame(*along)))
                    }
                }
            }
            Meaning::AtRest(what) => say!("{}, toutes les articulations à 0", self.meaning(what)),
            Meaning::Screw { joint, .. } => {
                say!("le torseur de l’articulation {joint}, toutes les articulations à 0")
            }
            Meaning::Column(joint, of) => say!("la colonne {joint} {}", genitive(&matrix_of_velocities(of))),
        }
    }

    fn instead(&self, instead: Instead) -> String {
        match instead {
            Instead::Inverse => "son inverse".into(),
            Instead::Transpose => "sa transposée".into(),
            Instead::RotationTransposed => "la même, la rotation transposée".into(),
            Instead::RowsExchanged(i, j) => format!("la même, les lignes {i} et {j} échangées"),
            Instead::RowSigns(i) => format!("la même, les signes de la ligne {i} changés"),
            Instead::ColumnsExchanged(i, j) => format!("la même, les colonnes {i} et {j} échangées"),
            Instead::ColumnSigns(i) => format!("la même, les signes de la colonne {i} changés"),
            Instead::Frame { of, seen_from } => format!("le repère {of} dans le repère {seen_from}"),
            Instead::Backwards { of, seen_from } => say!(
                "le produit, dans l’ordre inverse, des matrices de passage entre les repères {seen_from} et {of}"
            ),
            Instead::Without { of, seen_from, link } => {
                format!("le repère {of} dans le repère {seen_from}, sans la matrice de passage {link}")
            }
            Instead::ByTable { of, seen_from, line } => {
                say!("le repère {of} dans le repère {seen_from} d’après le tableau de la ligne {line}")
            }
        }
    }

    fn remarked(&self, remark: &Remark) -> String {
        match remark {
            Remark::ManyRows { printed, wanted } => {
                format!("{} au lieu de {wanted}", counted(*printed, "ligne imprimée", "lignes imprimées"))
            }
            Remark::ShortRow(row) => short_row(*row),
            Remark::Incomparable(r, c) => say!("ligne {r}, colonne {c} : rien à quoi comparer"),
            Remark::OthersDiffer(places) => {
                let places: Vec<String> = places.iter().map(|(r, c)| format!("{r},{c}")).collect();
                say!("tout calcul fait, les éléments {} diffèrent aussi", places.join(" ; "))
            }
            Remark::AngleUnit => {
                say!("juste si l’on prend des degrés pour des radians, ou des radians pour des degrés")
            }
            Remark::Millimetres => "juste en millimètres".into(),
            Remark::Metres => "juste en mètres".into(),
            Remark::Sign => "juste au signe près".into(),
            Remark::LastDigit => {
                say!("faux au dernier chiffre : des angles ou π ont été arrondis en cours de calcul")
            }
            Remark::OffBy(x) => format!("écart de {}", self.written(decimal(*x))),
            Remark::Sampled => "constaté sur des essais, non démontré".into(),
            Remark::Compared(poses) => {
                format!("par comparaison avec toutes les solutions en {}", counted(*poses, "pose", "poses"))
            }
            Remark::ReadAs(sense) => self.sense(sense),
            Remark::SignLost { value, by, right_where } => {
                let which = value.map(|k| format!("valeur {} : ", k + 1)).unwrap_or_default();
                let place = match &right_where[..] {
                    [] => String::new(),
                    some => format!(" (juste pour {})", positive(some, " et ")),
                };
                printed(&format!("{which}{}", sign_lost(*by))) + &place
            }
            Remark::LeftOut(missing) => {
                say!("il manque des solutions en {} des poses : {}", share(missing.poses), given(*missing))
            }
            Remark::NoSolution { value, share: x } => {
                say!("{} ne correspond à aucune solution en {} des poses", which(*value), share(*x))
            }
            Remark::NoNumber { value, share: x } => {
                say!("{} n’est pas un nombre en {} des poses", which(*value), share(*x))
            }
            Remark::DivisionByZero { factor, zeros } => division_by_zero(factor, zeros),
            Remark::FailsAt(q) => {
                let q: Vec<String> = q.iter().map(|x| self.written(format!("{x:.4}"))).collect();
                say!("faux en q = ({}), bien que l’articulation y soit déterminée", q.join(" ; "))
            }
            Remark::Residual(e) => say!("premier membre moins second membre : ") + &e.to_string(),
            Remark::Placed(placement) => say!("le même mécanisme : ") + &placed(placement),
            Remark::OfTrueCoordinates => {
                printed("pour les vraies coordonnées, non pour celles qui sont imprimées plus haut")
            }
            Remark::ByOwnTable => printed("d’après le tableau du document, qui est le même mécanisme"),
        }
    }

    fn sense(&self, sense: &Sense) -> String {
        printed(match sense {
            Sense::Rates(letters) => {
                let named = letters
                    .iter()
                    .map(|[letter, joint]| format!("{letter} est lu comme la vitesse de {joint}"));
                return named.collect::<Vec<_>>().join(", ");
            }
            Sense::LinkAlone => {
                "lu comme la matrice de passage d’un seul corps, non comme un repère dans la base"
            }
            Sense::OwnLinks => "lu comme le document les définit : seul leur produit est celui du robot",
            Sense::VelocitiesOfJacobian => {
                "vitesses lues comme celles de la jacobienne : de son point, suivant ses axes"
            }
            Sense::IndicesExchanged => "lu avec le repère à gauche et celui où il est vu à droite",
            Sense::Helper => {
                "lu comme une grandeur auxiliaire du document, non comme un élément de la situation"
            }
            Sense::CosineFirst => "lu avec le cosinus comme premier argument de atan2",
            Sense::ColumnsSnap => "lu avec s, n, a, P comme colonnes de la situation",
            Sense::HandInFrames => {
                "les positions numérotées sont lues comme celles de la main, vues depuis ce repère"
            }
            Sense::AgainstLoad => "les couples sont lus comme ceux qui s’opposent à la charge",
            Sense::Lengths { letter } => {
                return format!("{letter}1, {letter}2 … sont lus comme les longueurs des lignes du tableau");
            }
            Sense::Tool { place: [x, y, z] } => {
                return format!("la main est lue comme le point ({x}, {y}, {z}) du dernier repère");
            }
            Sense::LoadInHand => "les composantes de la charge sont lues suivant les axes de la main",
            Sense::WristEntries => "lu avec r_ij comme éléments du repère 6 dans le repère 3",
            Sense::ZeroIsBase => "lu avec la base du robot comme repère 0",
            Sense::PlaceIsO => "lu avec o comme position de l’organe terminal",
            Sense::Load { letter, axis, is_minus } => {
                let along = if *is_minus { "contre" } else { "suivant" };
                if *letter == 'N' {
                    return say!("la charge en newtons est lue sur l’organe terminal, {along} l’axe {axis}");
                }
                return say!("{letter} lu comme une charge sur l’organe terminal, {along} l’axe {axis}");
            }
            Sense::Unit { millimetres: true } => "longueurs sans unité lues en millimètres",
            Sense::Unit { millimetres: false } => "longueurs sans unité lues en mètres",
        })
    }

    fn skipped(&self, why: &Skipped) -> String {
        match why {
            Skipped::Unreadable(why) => self.unreadable(why),
            Skipped::Unused(name) => say!("définit `{name}`, dont rien de démontré ne se sert"),
            Skipped::SaysNothing => printed("ne dit rien de connu sur le robot"),
            Skipped::Given => {
                printed("pris pour une configuration donnée : rien de ce qui est vérifié n’en dépend")
            }
            Skipped::AmongWords => printed("parmi des mots : rien ne montre où la formule commence et finit"),
            Skipped::OfProgram(name) => say!("rien ne dit ce qu’est `{name}`"),
            Skipped::TooMany => printed("le document contient plus de formules qu’on n’en vérifie"),
        }
    }

    fn carried(&self, cause: &str, line: usize) -> String {
        say!("découle de `{cause}`, ligne {line}, qui est faux")
    }

    fn right_where(&self, condition: &Condition) -> String {
        match condition {
            Condition::OneSign => say!("avec l’un de ses signes"),
            Condition::OwnSign => "avec le signe qui convient à la configuration".into(),
            Condition::Incomplete(missing) => {
                let gives = missing.map(|m| format!(" : {}", given(m))).unwrap_or_default();
                say!("pour les solutions données, mais il en manque{gives}")
            }
            Condition::Compared { poses, apart } if *apart <= ROUNDING => {
                say!("d’après {poses} poses ; ce n’est pas démontré")
            }
            Condition::Compared { poses, apart } => {
                say!("à {apart:.0e} près, en {poses} poses : c’est plus qu’un arrondi")
            }
            Condition::Configurations(any) if any.is_empty() => {
                "pour une partie des configurations seulement".into()
            }
            Condition::Configurations(any) => {
                let any: Vec<String> = any.iter().map(|all| positive(all, " et ")).collect();
                format!("pour {}", any.join(", ou pour "))
            }
            Condition::Orientations(all) if all.is_empty() => {
                "pour une partie des orientations seulement".into()
            }
            Condition::Orientations(all) => format!("pour {}", positive(all, " et ")),
            Condition::AsUsed => printed("dans la mesure où ce qui l’utilise est juste"),
            Condition::Locked => printed("tant que d’autres articulations sont immobiles"),
            Condition::Following => printed("là où une articulation en suit d’autres, comme le texte le dit"),
            Condition::Placed(placement) => {
                say!("comme même mécanisme, si l’énoncé laisse ceci libre : ") + &placed(placement)
            }
        }
    }

    fn either(&self, values: &[String]) -> Option<String> {
        (!values.is_empty()).then(|| values.join(" ou "))
    }

    fn unproved(&self, why: Unproved) -> String {
        printed(match why {
            Unproved::NoRate => {
                "les vitesses articulaires n’ont pas de valeur ici : les donner auparavant, `dq1 = 0.5 rad/s`"
            }
            Unproved::NoLength => "une longueur n’a pas de valeur : la donner auparavant, `a1 = 0.5 m`",
            Unproved::NotFound => "ni égalité démontrée, ni différence trouvée en aucun des essais",
            Unproved::OwnTable => {
                "juste selon le tableau du document, qui n’a pas été comparé à celui du robot"
            }
            Unproved::NotOfSet => "ce ne sont pas des angles de ce triplet",
            Unproved::NoPose => "rien ne dit pour quelle pose sont ces valeurs des articulations",
            Unproved::Unsupported => {
                "en désaccord avec le robot tel qu’il est lu ici, et rien dans le document ne confirme cette lecture"
            }
            Unproved::OtherConfiguration => {
                "juste en une autre configuration que le document donne, non en la dernière"
            }
            Unproved::OpenReading => {
                "rien ne dit comment les masses, les inerties et la pesanteur s’entendent, ce qu’il faudrait pour la réfuter"
            }
            Unproved::AgainstWords(of) => {
                return say!("elle n’est juste que contre ce que dit le texte : {}", spoken(of));
            }
            Unproved::UnknownColumn => "la colonne n’est pas connue",
            Unproved::OtherJoints => "il n’a pas les articulations du robot",
            Unproved::OtherNames => "il a des longueurs inconnues du robot",
            Unproved::OpenLoad => {
                "un couple voisin contient un nom inconnu : la charge peut avoir d’autres composantes"
            }
            Unproved::Values(why) => return self.undecided(why),
        })
    }

    fn undecided(&self, why: Undecided) -> String {
        printed(match why {
            Undecided::UnknownSymbol(s) => {
                let what = say!("n’est ni une articulation, ni une longueur, ni un élément de la pose");
                return format!("`{}` {what}", s.name());
            }
            Undecided::Shape => "les valeurs sont trop nombreuses",
            Undecided::Circular => "la formule contient l’articulation qu’elle doit donner",
            Undecided::NeverDefined => "la formule n’est un nombre en aucune pose",
            Undecided::NoSamples => "il n’y a aucune pose où l’essayer",
            Undecided::NoEnumeration => "les solutions de ce bras ne peuvent pas être énumérées",
        })
    }

    fn slip(&self, kind: &SlipKind) -> String {
        match kind {
            SlipKind::Formula(slip) => self.formula_slip(slip),
            SlipKind::Arguments => printed("les arguments de atan2 échangés"),
            SlipKind::ExchangedWith(r, c) => say!("échangé avec l’élément de la ligne {r}, colonne {c}"),
            SlipKind::OtherEntry => say!("l’élément d’une autre place"),
        }
    }

    fn formula_slip(&self, slip: &Slip) -> String {
        printed(match slip {
            Slip::Sign => "un signe",
            Slip::SineForCosine => "sinus et cosinus intervertis",
            Slip::Index => "un indice",
            Slip::Symbol => "un symbole pour un autre",
            Slip::LostFactor => "un facteur oublié",
            Slip::ExtraFactor => "un facteur de trop",
            Slip::LostTerm => "un terme oublié",
            Slip::ExtraTerm => "un terme de trop",
            Slip::Bracket => "une parenthèse mal placée",
            Slip::Exponent => "un exposant",
            Slip::Number => "un nombre",
            Slip::Exchanged => "deux noms échangés",
            Slip::Replaced => "une partie remplacée",
            Slip::Several(all) => {
                return match all.first() {
                    Some(first) if all.iter().all(|s| s == first) => {
                        format!("{}, {} fois", self.formula_slip(first), all.len())
                    }
                    _ => all.iter().map(|s| self.formula_slip(s)).collect::<Vec<_>>().join(" et "),
                };
            }
        })
    }

    fn value_slip(&self, slip: ValueSlip) -> String {
        match slip {
            ValueSlip::Sign => "un signe".into(),
            ValueSlip::AngleUnit => "degrés et radians intervertis".into(),
            ValueSlip::Factor => "un facteur".into(),
            ValueSlip::PowerOfTen => "une puissance de dix".into(),
            ValueSlip::Term(n) => format!("le terme de degré {n}"),
            ValueSlip::Other => "une autre valeur".into(),
        }
    }

    fn change(&self, change: &Change) -> String {
        match change {
            Change::Opposite(TableCell { letter, row }) => {
                format!("{letter}{row} de signe opposé dans le tableau")
            }
            Change::Forgotten(TableCell { letter, row }) => format!("{letter}{row} oublié"),
            Change::ExchangedWithNext(TableCell { letter, row }) => {
                format!("{letter}{row} et {letter}{} échangés dans le tableau", row + 1)
            }
            Change::Alpha { row, degrees: 0 } => format!("α{row} = 0 dans le tableau"),
            Change::Alpha { row, degrees } => format!("α{row} = {degrees}° dans le tableau"),
            Change::Offset { row, degrees } => format!("θ{row} avec un décalage de {degrees}° en plus"),
            Change::CountedBackwards(row) => say!("θ{row} compté dans l’autre sens"),
            Change::Convention(convention) => format!("le tableau lu dans la convention `{convention}`"),
            Change::NoTool => say!("l’outil omis"),
            Change::Vanishing(symbol) => self.is_zero(*symbol),
            Change::Definition { name, slip } => {
                format!("la définition de {name}{}{}", say!(" : "), self.slip(slip))
            }
        }
    }

    fn unreadable(&self, why: &Unreadable) -> String {
        match why {
            Unreadable::Syntax { message, .. } => message.clone(),
            Unreadable::Unknown(name) => format!("nom inconnu `{name}`"),
            Unreadable::ManyElements { elements, most } => {
                say!("la matrice a {elements} éléments ; on en lit au plus {most}")
            }
            Unreadable::ShortRow(row) => short_row(*row),
            Unreadable::LongProduct => "le produit est trop long pour être calculé".into(),
            Unreadable::NeitherFormulaNorProduct => "ni une formule, ni un produit de matrices".into(),
            Unreadable::NoKnownProduct => say!("ce n’est pas un produit de matrices connues"),
            Unreadable::NoConfiguration => {
                say!("un nombre, mais les articulations n’ont pas de valeurs ici")
            }
            Unreadable::Alias => say!("l’alias est illisible"),
            Unreadable::NothingTold(function) => format!("rien ne dit ce que renvoie `{function}`"),
        }
    }

    fn unreadable_hint(&self, why: &Unreadable) -> Option<String> {
        match why {
            Unreadable::Syntax { hint, .. } => hint.clone(),
            Unreadable::NoConfiguration => {
                Some(say!("les donner auparavant : `θ1 = 30°, θ2 = 45°`, ou `q = [0.5, 0.8]`"))
            }
            Unreadable::NothingTold(_) => Some(
                "renvoyer une pose, une position ou une jacobienne sous forme de tableau, ou donner à ce qui est renvoyé un \
                 nom tel que T06, px, J"
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
                say!("le document a {bytes} octets ; on en lit au plus {most}")
            }
            Noted::NoRobot => say!(
                "il n’y a pas de robot : aucun tableau de paramètres de Denavit-Hartenberg ne figure dans le document"
            ),
            Noted::ReadAs(convention) => {
                say!("les tableaux sont lus dans la convention {convention} : le texte le dit")
            }
            Noted::InMillimetres => {
                say!("les longueurs sans unité des tableaux sont en mm : le texte le dit")
            }
            Noted::Supported { convention, right, rival } => say!(
                "les tableaux sont lus dans la convention {convention} : {right} énoncés du texte sont justes ainsi, {rival} dans une autre"
            ),
            Noted::NotSet(_, NotSet::Unknown { name, known }) => match &known[..] {
                [] => say!("`{name}` reçoit une valeur : il n’y a aucun paramètre"),
                known => {
                    say!("`{name}` reçoit une valeur : paramètre inconnu, il y a {}", known.join(", "))
                }
            },
            Noted::NotSet(name, NotSet::Value(_)) => say!("`{name}` reçoit une valeur illisible"),
            Noted::Reading(sense) => self.sense(sense),
            Noted::UnknownRobot(name) => format!("aucun robot `{name}` dans le catalogue"),
            Noted::NoSuchTable => say!("ce tableau n’existe pas"),
            Noted::UnknownConvention(name) => format!("convention inconnue `{name}`"),
            Noted::NoTool => "un outil se donne par trois longueurs".into(),
            Noted::PassedOver(why) => say!("laissé de côté : ") + &self.unreadable(why),
            Noted::NotRead(why) => say!("non lu : ") + &self.unreadable(why),
            Noted::Together(composed) => together(composed),
            Noted::ReadWith(all) => {
                let all: Vec<String> = all.iter().map(read_with).collect();
                say!("lu avec {} ; ainsi l’essentiel est juste, et le texte ne le dit pas", all.join(" ; "))
            }
        }
    }

    fn noted_hint(&self, what: &Noted) -> Option<String> {
        let hint = match what {
            Noted::Table { hint, .. } => return hint.clone(),
            Noted::PassedOver(why) | Noted::NotRead(why) => return self.unreadable_hint(why),
            Noted::NoRobot => {
                "nommer le robot avant le fichier, ou mettre son tableau dans le document, avec en tête au moins trois des \
                 noms theta, d, a, alpha, r"
            }
            Noted::UnknownConvention(_) => "les conventions sont standard, craig et khalil",
            Noted::NoTool => "écrire `tool 0, 0, r_7`",
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

/// With *de*, which joins the article: `du repère 3 dans le repère 2`.
fn genitive(noun: &str) -> String {
    match noun.strip_prefix("le ") {
        Some(rest) => format!("du {rest}"),
        None if noun.starts_with("une ") => format!("d’{noun}"),
        None => format!("de {noun}"),
    }
}

fn frame(which: Reference) -> String {
    match which {
        Reference::Base => "la base".into(),
        Reference::Frame(k) => format!("le repère {k}"),
        Reference::Tool => "l’organe terminal".into(),
    }
}

fn matrix_of_velocities(jacobian: &Jacobian) -> String {
    let body = match jacobian.body {
        Reference::Tool => "l’organe terminal",
        Reference::Base | Reference::Frame(_) => "l’origine du dernier repère",
    };
    let axes = match jacobian.axes {
        Reference::Base | Reference::Frame(0) => String::new(),
        Reference::Frame(k) => format!(" suivant les axes du repère {k}"),
        Reference::Tool => " suivant ses propres axes".into(),
    };
    let at = jacobian.at.map_or(String::new(), |k| format!(" à l’origine du repère {k}"));
    let first = if jacobian.is_angular_first { ", lignes de la vitesse angulaire d’abord" } else { "" };
    let part = rows_of(jacobian).map_or(String::new(), |rows| format!(", lignes {rows}"));
    say!("la jacobienne de {body}{at}{axes}{first}{part}")
}

fn short_row(ShortRow { row, elements, width }: ShortRow) -> String {
    format!("la ligne {row} a {} au lieu de {width}", counted(elements, "élément", "éléments"))
}

/// A value among several, or the formula that has one only.
fn which(value: Option<usize>) -> String {
    value.map_or("la formule".into(), |k| format!("la valeur {}", k + 1))
}

fn share(share: f64) -> String {
    format!("{}\u{a0}%", percent(share))
}

/// How many values there are of those that exist.
fn given(missing: Missing) -> String {
    format!("{} sur {}", counted(missing.given, "valeur", "valeurs"), missing.existing)
}

fn sign_lost(by: Cause) -> &'static str {
    match by {
        Cause::Arctan => "l’arc tangente d’un quotient perd le quadrant ; atan2 le conserve",
        Cause::Arcsin => "un arc sinus ne donne qu’un angle sur deux",
        Cause::Arccos => "un arc cosinus ne donne qu’un angle sur deux",
        Cause::Atan2 => "les deux arguments de atan2 ont ailleurs le mauvais signe",
        Cause::Root => "le signe de la racine n’est pas celui de la configuration",
        Cause::Other => "le signe est perdu",
    }
}

fn division_by_zero(factor: &Formula, zeros: &[Zeros]) -> String {
    let zero = |zeros: &Zeros| {
        let angle = zeros.angle.as_ref().map(ToString::to_string).unwrap_or_default();
        let values: Vec<String> = zeros.values.iter().map(ToString::to_string).collect();
        format!("{angle} = {}", values.join(" ou "))
    };
    let zeros: Vec<String> = zeros.iter().map(zero).collect();
    let place = if zeros.is_empty() { String::new() } else { format!(" ({})", zeros.join("\u{a0}; ")) };
    format!("division par zéro pour {factor} = 0{place}")
}

fn together(c: &Composed) -> String {
    let spurious = match c.spurious {
        0 => String::new(),
        n => {
            let all = counted(n, "configuration", "configurations");
            format!(", et {all} qui {} pas la pose", if n < 2 { "n’atteint" } else { "n’atteignent" })
        }
    };
    say!(
        "l’une après l’autre, les formules donnent {} des {} solutions en {} poses{spurious}",
        c.yielded,
        c.existing,
        c.poses
    )
}

/// Ce que l'auteur d'un tableau a choisi.
fn placed(placement: &Placement) -> String {
    let mut said = vec![];
    said.extend(placement.convention.map(|c| format!("il est lu dans la convention {c}")));
    if placement.millimetres {
        said.push("les longueurs sont en millimètres".into());
    }
    said.extend(placement.names.iter().map(|(own, robot)| format!("{own} désigne {robot}")));
    said.extend(
        placement
            .zeros
            .iter()
            .map(|(k, by)| format!("l’articulation {k} vaut {by} de plus que celle du robot")),
    );
    said.extend(placement.reversed.iter().map(|k| format!("l’articulation {k} compte dans l’autre sens")));
    if placement.base {
        said.push("le repère 0 est ailleurs".into());
    }
    if placement.hand {
        said.push("le dernier repère est ailleurs".into());
    }
    if placement.is_turned && !placement.base && !placement.hand {
        said.push("le repère 0 ou le dernier repère est tourné".into());
    }
    printed(&said.join(" ; "))
}
