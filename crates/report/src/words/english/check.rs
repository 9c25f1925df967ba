//! Documents that were checked.

use super::English;
use crate::words::Check;
use crate::words::check::{ROUNDING, percent, positive, rows_of};
use denavit::forward::Reference;
use denavit_check::inverse::{Cause, Composed, Undecided};
use denavit_check::{
    About, Change, Condition, Dynamic, Formula, Instead, Jacobian, Meaning, Noted, Placement, ReadWith,
    Remark, Sense, ShortRow, Skipped, SlipKind, Spoken, TableCell, Unproved, Unreadable, ValueSlip,
    Whereabouts, Zeros, decimal,
};
use denavit_reading::slip::Slip;

impl Check for English {
    fn about(&self, about: &About) -> String {
        match about {
            About::Matrix(meaning) => return self.meaning(meaning),
            About::Matrices => "an equation between matrices",
            About::Entry => "an entry",
            About::Equation => "an equation",
            About::Helper => "a helper",
            About::Singularity => "a singular configuration",
            About::Joint => "values of a joint",
            About::Table => "the table of the robot",
            About::Configuration => "a configuration of the robot",
            About::TableRow => "a row of the table",
            About::Angle(set) => return format!("an angle of the set {set}"),
            About::Dynamics(what) => dynamic(*what),
        }
        .into()
    }

    fn entry(&self, name: &str, place: Option<(usize, usize)>) -> String {
        place.map_or_else(|| name.into(), |(r, c)| format!("{name}, row {r}, column {c}"))
    }

    fn meaning(&self, meaning: &Meaning) -> String {
        let of = |what: &str, whose: &Meaning| format!("{what} of {}", self.meaning(whose));
        match meaning {
            Meaning::Hand => "the hand".into(),
            Meaning::Position => "the position of the hand".into(),
            Meaning::Row => "the transform of any row".into(),
            Meaning::Frame { of, seen_from } => format!("{} in {}", frame(*of), frame(*seen_from)),
            Meaning::AnyFrame { of, seen_from } => {
                format!("frame {of} in frame {seen_from}, wherever they are")
            }
            Meaning::Rotation(whose) => of("the rotation", whose),
            Meaning::Axis(axis, whose) => of(&format!("the axis {axis}"), whose),
            Meaning::Origin(whose) => of("the origin", whose),
            Meaning::Inverse(whose) => of("the inverse", whose),
            Meaning::Transpose(whose) => of("the transpose", whose),
            Meaning::Product(factors) => {
                factors.iter().map(|f| self.meaning(f)).collect::<Vec<_>>().join(" times ")
            }
            Meaning::Sum { terms, is_difference } => {
                let sign = if *is_difference { "−" } else { "+" };
                format!("{} {sign} {}", self.meaning(&terms[0]), self.meaning(&terms[1]))
            }
            Meaning::RotationAbout(axis) => format!("the rotation about {axis}"),
            Meaning::TranslationAlong(axis) => format!("the translation along {axis}"),
            Meaning::Translation => "a translation".into(),
            Meaning::Torques => "the torques of the joints".into(),
            Meaning::Jacobian(jacobian) => matrix_of_velocities(jacobian),
            Meaning::Velocity { of, along, is_angular } => {
                let what = if *is_angular { "angular velocity" } else { "velocity" };
                match along {
                    Reference::Base | Reference::Frame(0) => format!("the {what} of {}", frame(*of)),
                    _ => format!("the {what} of {} along the axes of {}", frame(*of), frame(*along)),
                }
            }
            Meaning::AtRest(what) => format!("{} with all joints at 0", self.meaning(what)),
            Meaning::Screw { joint, .. } => format!("the screw of joint {joint} with all joints at 0"),
            Meaning::Column(joint, of) => format!("column {joint} of {}", matrix_of_velocities(of)),
        }
    }

    fn instead(&self, instead: Instead) -> String {
        match instead {
            Instead::Inverse => "its inverse".into(),
            Instead::Transpose => "its transpose".into(),
            Instead::RotationTransposed => "it with the rotation transposed".into(),
            Instead::RowsExchanged(i, j) => format!("it with rows {i} and {j} exchanged"),
            Instead::RowSigns(i) => format!("it with the signs of row {i} changed"),
            Instead::ColumnsExchanged(i, j) => format!("it with columns {i} and {j} exchanged"),
            Instead::ColumnSigns(i) => format!("it with the signs of column {i} changed"),
            Instead::Frame { of, seen_from } => format!("frame {of} in frame {seen_from}"),
            Instead::Backwards { of, seen_from } => {
                format!("the links of frame {of} in frame {seen_from} multiplied in the opposite order")
            }
            Instead::Without { of, seen_from, link } => {
                format!("frame {of} in frame {seen_from} without link {link}")
            }
            Instead::ByTable { of, seen_from, line } => {
                format!("frame {of} in frame {seen_from} of the table in line {line}")
            }
        }
    }

    fn remarked(&self, remark: &Remark) -> String {
        match remark {
            Remark::ManyRows { printed, wanted } => format!("{printed} rows are printed for {wanted}"),
            Remark::ShortRow(row) => short_row(*row),
            Remark::Incomparable(r, c) => format!("row {r}, column {c} has nothing to compare with"),
            Remark::OthersDiffer(places) => {
                let places: Vec<String> = places.iter().map(|(r, c)| format!("{r},{c}")).collect();
                format!("worked out, entries {} differ, too", places.join("; "))
            }
            Remark::AngleUnit => "right if degrees are taken for radians, or radians for degrees".into(),
            Remark::Millimetres => "right in millimetres".into(),
            Remark::Metres => "right in metres".into(),
            Remark::Sign => "right but for its sign".into(),
            Remark::LastDigit => "off in the last digit: angles or π were rounded on the way".into(),
            Remark::OffBy(x) => format!("off by {}", decimal(*x)),
            Remark::Sampled => "found so in samples, not proved".into(),
            Remark::Compared(poses) => format!("by comparison with all solutions at {poses} poses"),
            Remark::ReadAs(sense) => self.sense(sense),
            Remark::SignLost { value, by, right_where } => {
                let place = match &right_where[..] {
                    [] => String::new(),
                    some => format!(" (right where {})", positive(some, " and ")),
                };
                format!("{}{}{place}", which(*value), sign_lost(*by))
            }
            Remark::LeftOut(m) => format!(
                "solutions are left out at {} % of the poses: {} of {} values",
                percent(m.poses),
                m.given,
                m.existing
            ),
            Remark::NoSolution { value, share } => {
                format!("{}belongs to no solution at {} % of the poses", which(*value), percent(*share))
            }
            Remark::NoNumber { value, share } => {
                format!("{}is no number at {} % of the poses", which(*value), percent(*share))
            }
            Remark::DivisionByZero { factor, zeros } => division_by_zero(factor, zeros),
            Remark::FailsAt(q) => format!("wrong at q = {q:.4?}, though the joint is determined there"),
            Remark::Residual(e) => format!("left minus right is {e}"),
            Remark::Placed(placement) => format!("the same mechanism: {}", placed(placement)),
            Remark::OfTrueCoordinates => "of the coordinates as they are, not as printed before".into(),
            Remark::ByOwnTable => "by the document's own table, which is the same mechanism".into(),
        }
    }

    fn sense(&self, sense: &Sense) -> String {
        match sense {
            Sense::Rates(letters) => {
                let named =
                    letters.iter().map(|[letter, joint]| format!("{letter} is read as the rate of {joint}"));
                return named.collect::<Vec<_>>().join(", ");
            }
            Sense::LinkAlone => "read as the transform of a link alone, not as a frame in the base",
            Sense::OwnLinks => "read as the document defines them: only their product is the robot's",
            Sense::VelocitiesOfJacobian => {
                "velocities read as those of the Jacobian: its point, along its axes"
            }
            Sense::IndicesExchanged => {
                "read with the frame on the left and the one in which it is seen on the right"
            }
            Sense::Helper => "read as a helper of the document, not as an entry of the pose",
            Sense::CosineFirst => "read with the cosine as the first argument of atan2",
            Sense::ColumnsSnap => "read with s, n, a, P as the columns of the pose",
            Sense::HandInFrames => "places with a number are read as those of the hand, seen from that frame",
            Sense::AgainstLoad => "torques are read as those that hold against the load",
            Sense::Lengths { letter } => {
                return format!("{letter}1, {letter}2 … are read as the lengths in the rows of the table");
            }
            Sense::Tool { place: [x, y, z] } => {
                return format!("the hand is read as the point ({x}, {y}, {z}) of the last frame");
            }
            Sense::LoadInHand => "the components of the load are read as those along the axes of the hand",
            Sense::WristEntries => "read with r_ij as the entries of frame 6 in frame 3",
            Sense::ZeroIsBase => "read with the robot's base as frame 0",
            Sense::PlaceIsO => "read with o as the place of the hand",
            Sense::Unit { millimetres: true } => "lengths without a unit read as millimetres",
            Sense::Unit { millimetres: false } => "lengths without a unit read as metres",
            Sense::Load { letter, axis, is_minus } => {
                let against = if *is_minus { "against" } else { "along" };
                if *letter == 'N' {
                    return format!(
                        "the load in newtons is read as one on the hand {against} the axis {axis}"
                    );
                }
                return format!("{letter} read as a load on the hand {against} the axis {axis}");
            }
        }
        .into()
    }

    fn skipped(&self, why: &Skipped) -> String {
        match why {
            Skipped::Unreadable(why) => self.unreadable(why),
            Skipped::Unused(name) => format!("defines `{name}`, which nothing that is proved uses"),
            Skipped::SaysNothing => "says nothing that is known of the robot".into(),
            Skipped::Given => {
                "taken for a configuration that is given: nothing that is judged rests on it".into()
            }
            Skipped::AmongWords => {
                "stands among words: nothing shows where the formula begins and ends".into()
            }
            Skipped::OfProgram(name) => format!("nothing says what `{name}` is"),
            Skipped::TooMany => "the document has more formulas than are judged".into(),
        }
    }

    fn carried(&self, cause: &str, line: usize) -> String {
        format!("follows from `{cause}` in line {line}, which is wrong")
    }

    fn right_where(&self, condition: &Condition) -> String {
        match condition {
            Condition::OneSign => "with one of its signs".into(),
            Condition::OwnSign => "with the sign that belongs to the configuration".into(),
            Condition::Incomplete(missing) => {
                let gives = missing.map(|m| format!(": it gives {} of {} values", m.given, m.existing));
                format!("as far as it goes, but solutions are left out{}", gives.unwrap_or_default())
            }
            Condition::Compared { poses, apart } if *apart <= ROUNDING => {
                format!("as far as {poses} poses show; it is not proved")
            }
            Condition::Compared { poses, apart } => {
                format!("to about {apart:.0e} at {poses} poses, which is more than rounding")
            }
            Condition::Configurations(any) if any.is_empty() => "in a part of all configurations".into(),
            Condition::Configurations(any) => {
                let any: Vec<String> = any.iter().map(|all| positive(all, " and ")).collect();
                format!("where {}", any.join(", or where "))
            }
            Condition::Orientations(all) if all.is_empty() => "in a part of all orientations".into(),
            Condition::Orientations(all) => format!("where {}", positive(all, " and ")),
            Condition::AsUsed => "as far as what uses it is right".into(),
            Condition::Locked => "while other joints are at rest".into(),
            Condition::Following => "where a joint follows others as the text says".into(),
            Condition::Placed(placement) => {
                format!("as the same mechanism, if the task leaves this free: {}", placed(placement))
            }
        }
    }

    fn either(&self, values: &[String]) -> Option<String> {
        (!values.is_empty()).then(|| values.join(" or "))
    }

    fn unproved(&self, why: Unproved) -> String {
        match why {
            Unproved::NoRate => "the joints' rates have no values here: state them before, `dq1 = 0.5 rad/s`",
            Unproved::NoLength => "a length has no value: state it before, `a1 = 0.5 m`",
            Unproved::NotFound => "neither proved equal nor different anywhere that was tried",
            Unproved::OwnTable => {
                "right by the table of the document, which was not held against that of the robot"
            }
            Unproved::NotOfSet => "these are no angles of that set",
            Unproved::NoPose => "nothing says for which pose these values of the joints are",
            Unproved::Unsupported => {
                "it does not agree with the robot as it is read here, and nothing in the document bears that reading out"
            }
            Unproved::OtherConfiguration => "right at another configuration that the document states, not at the last one",
            Unproved::OpenReading => {
                "nothing says how masses, inertias and gravity are meant so that it could be refuted"
            }
            Unproved::AgainstWords(of) => {
                return format!("it is right only as the words of the document contradict it: {}", spoken(of));
            }
            Unproved::UnknownColumn => "what the column holds is not known",
            Unproved::OtherJoints => "it has not the joints of the robot",
            Unproved::OtherNames => "it has lengths that are not known of the robot",
            Unproved::OpenLoad => {
                "a torque beside it has a name that is not known: the load may have more components"
            }
            Unproved::Values(why) => return self.undecided(why),
        }
        .into()
    }

    fn undecided(&self, why: Undecided) -> String {
        match why {
            Undecided::UnknownSymbol(s) => {
                return format!("`{}` is neither a joint, a length nor an entry of the pose", s.name());
            }
            Undecided::Shape => "there are too many values",
            Undecided::Circular => "the formula uses the joint that it is for",
            Undecided::NeverDefined => "the formula is no number at any pose",
            Undecided::NoSamples => "there are no poses to try it at",
            Undecided::NoEnumeration => "the solutions of this arm cannot be listed",
        }
        .into()
    }

    fn slip(&self, kind: &SlipKind) -> String {
        match kind {
            SlipKind::Formula(slip) => self.formula_slip(slip),
            SlipKind::Arguments => "the arguments of atan2 exchanged".into(),
            SlipKind::ExchangedWith(r, c) => format!("exchanged with row {r}, column {c}"),
            SlipKind::OtherEntry => "another entry".into(),
        }
    }

    fn formula_slip(&self, slip: &Slip) -> String {
        match slip {
            Slip::Sign => "a sign",
            Slip::SineForCosine => "sine and cosine swapped",
            Slip::Index => "an index",
            Slip::Symbol => "another symbol",
            Slip::LostFactor => "a lost factor",
            Slip::ExtraFactor => "a factor too many",
            Slip::LostTerm => "a lost term",
            Slip::ExtraTerm => "a term too many",
            Slip::Bracket => "a bracket",
            Slip::Exponent => "an exponent",
            Slip::Number => "a number",
            Slip::Exchanged => "two names exchanged",
            Slip::Replaced => "another expression",
            Slip::Several(all) => {
                return match all.first() {
                    Some(first) if all.iter().all(|s| s == first) => {
                        format!("{}, {} times", self.formula_slip(first), all.len())
                    }
                    _ => all.iter().map(|s| self.formula_slip(s)).collect::<Vec<_>>().join(" and "),
                };
            }
        }
        .into()
    }

    fn value_slip(&self, slip: ValueSlip) -> String {
        match slip {
            ValueSlip::Sign => "a sign".into(),
            ValueSlip::AngleUnit => "degrees and radians exchanged".into(),
            ValueSlip::Factor => "a factor".into(),
            ValueSlip::PowerOfTen => "a power of ten".into(),
            ValueSlip::Term(n) => format!("the term in the power {n}"),
            ValueSlip::Other => "another value".into(),
        }
    }

    fn change(&self, change: &Change) -> String {
        match change {
            Change::Opposite(TableCell { letter, row }) => {
                format!("{letter}{row} with the opposite sign in the table")
            }
            Change::Forgotten(TableCell { letter, row }) => format!("{letter}{row} forgotten"),
            Change::ExchangedWithNext(TableCell { letter, row }) => {
                format!("{letter}{row} and {letter}{} exchanged in the table", row + 1)
            }
            Change::Alpha { row, degrees: 0 } => format!("α{row} = 0 in the table"),
            Change::Alpha { row, degrees } => format!("α{row} = {degrees}° in the table"),
            Change::Offset { row, degrees } => format!("θ{row} with an offset of {degrees}° more"),
            Change::CountedBackwards(row) => format!("θ{row} counted the other way"),
            Change::Convention(convention) => format!("the table read in the convention `{convention}`"),
            Change::NoTool => "the tool left out".into(),
            Change::Vanishing(symbol) => self.is_zero(*symbol),
            Change::Definition { name, slip } => format!("the definition of {name}: {}", self.slip(slip)),
        }
    }

    fn unreadable(&self, why: &Unreadable) -> String {
        match why {
            Unreadable::Syntax { message, .. } => message.clone(),
            Unreadable::Unknown(name) => format!("unknown `{name}`"),
            Unreadable::ManyElements { elements, most } => {
                format!("the matrix has {elements} elements; at most {most} are read")
            }
            Unreadable::ShortRow(row) => short_row(*row),
            Unreadable::LongProduct => "the product is too long to be worked out".into(),
            Unreadable::NeitherFormulaNorProduct => "neither a formula nor a product of matrices".into(),
            Unreadable::NoKnownProduct => "no product of matrices that are known".into(),
            Unreadable::NoConfiguration => "a number, but the joints have no values here".into(),
            Unreadable::Alias => "the alias cannot be read".into(),
            Unreadable::NothingTold(function) => format!("nothing says what `{function}` returns"),
        }
    }

    fn unreadable_hint(&self, why: &Unreadable) -> Option<String> {
        match why {
            Unreadable::Syntax { hint, .. } => hint.clone(),
            Unreadable::NoConfiguration => {
                Some("state them before: `θ1 = 30°, θ2 = 45°`, or `q = [0.5, 0.8]`".into())
            }
            Unreadable::NothingTold(_) => Some(
                "return a pose, a position or a Jacobian as an array, or give what is returned a name such as T06, px, J"
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
                format!("the document has {bytes} bytes; at most {most} are read")
            }
            Noted::NoRobot => {
                "there is no robot: no table of Denavit-Hartenberg parameters stands in the document".into()
            }
            Noted::ReadAs(convention) => format!("tables are read as {convention}: the text says so"),
            Noted::InMillimetres => "lengths of tables without a unit are in mm: the text says so".into(),
            Noted::Supported { convention, right, rival } => format!(
                "tables are read as {convention}: of the statements of the text {right} hold so, {rival} in another convention"
            ),
            Noted::NotSet(name, why) => format!("value of `{name}`: {why}"),
            Noted::Reading(sense) => self.sense(sense),
            Noted::UnknownRobot(name) => format!("no robot `{name}` in the catalogue"),
            Noted::NoSuchTable => "there is no such table".into(),
            Noted::UnknownConvention(name) => format!("unknown convention `{name}`"),
            Noted::NoTool => "a tool is three lengths".into(),
            Noted::PassedOver(why) => format!("passed over: {}", self.unreadable(why)),
            Noted::NotRead(why) => format!("not read: {}", self.unreadable(why)),
            Noted::Together(composed) => together(composed),
            Noted::ReadWith(all) => {
                let all: Vec<String> = all.iter().map(read_with).collect();
                format!("read with {}: most is right so, and the text does not say it", all.join("; "))
            }
        }
    }

    fn noted_hint(&self, what: &Noted) -> Option<String> {
        let hint = match what {
            Noted::Table { hint, .. } => return hint.clone(),
            Noted::PassedOver(why) | Noted::NotRead(why) => return self.unreadable_hint(why),
            Noted::NoRobot => {
                "name the robot before the file, or put its table into the document, its header with at least three of \
                 theta, d, a, alpha, r"
            }
            Noted::UnknownConvention(_) => "the conventions are standard, craig and khalil",
            Noted::NoTool => "write `tool 0, 0, r_7`",
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

/// How something of a link, or gravity, is read.
fn read_with(what: &ReadWith) -> String {
    match what {
        ReadWith::Mass { mass, link, at } => {
            let link = link + 1;
            let at = match at {
                Whereabouts::Joint => format!("on joint {link}"),
                Whereabouts::End => format!("at the end of link {link}"),
                Whereabouts::Middle => format!("in the middle of link {link}"),
                Whereabouts::FromJoint(length) => {
                    format!("{length} from joint {link} towards the end of the link")
                }
                Whereabouts::FromEnd(length) => {
                    format!("{length} from the end of link {link} towards its joint")
                }
                Whereabouts::At([x, y, z]) => format!("at ({x}, {y}, {z}) in the frame of link {link}"),
            };
            format!("the mass {mass} {at}")
        }
        ReadWith::Point { link } => format!("link {} without an inertia about its centre of mass", link + 1),
        ReadWith::Rod { link } => format!("link {} as a thin rod", link + 1),
        ReadWith::Inertia { inertia, link, is_at_joint: true } => {
            format!("{inertia} about joint {}", link + 1)
        }
        ReadWith::Inertia { inertia, link, is_at_joint: false } => {
            format!("{inertia} about the centre of mass of link {}", link + 1)
        }
        ReadWith::Rotor { inertia, joint } => {
            format!("{inertia} as the inertia of the rotor of joint {}", joint + 1)
        }
        ReadWith::Gravity([x, y, z]) => format!("the acceleration of gravity ({x}, {y}, {z}) in the base"),
    }
}

/// What words say of masses and gravity.
fn spoken(of: Spoken) -> &'static str {
    match of {
        Spoken::Gravity => "they say where gravity pulls",
        Spoken::Shape => "they say what the links are, and where their masses are",
        Spoken::Centres => "they say from where the centres of mass are measured",
        Spoken::Inertias => "they say about which points the inertias are",
        Spoken::LeftOut => "they say that the links have inertias, which the formulas leave out",
        Spoken::Links => "they say of which link each name is",
    }
}

fn frame(which: Reference) -> String {
    match which {
        Reference::Base => "the base".into(),
        Reference::Frame(k) => format!("frame {k}"),
        Reference::Tool => "the hand".into(),
    }
}

fn matrix_of_velocities(jacobian: &Jacobian) -> String {
    let body = match jacobian.body {
        Reference::Tool => "the hand",
        Reference::Base | Reference::Frame(_) => "the origin of the last frame",
    };
    let axes = match jacobian.axes {
        Reference::Base | Reference::Frame(0) => String::new(),
        Reference::Frame(k) => format!(" along the axes of frame {k}"),
        Reference::Tool => " along its own axes".into(),
    };
    let at = jacobian.at.map_or(String::new(), |k| format!(" at the origin of frame {k}"));
    let first = if jacobian.is_angular_first { ", angular rows first" } else { "" };
    let part = rows_of(jacobian).map_or(String::new(), |rows| format!(", rows {rows}"));
    format!("the Jacobian of {body}{at}{axes}{first}{part}")
}

fn short_row(ShortRow { row, elements, width }: ShortRow) -> String {
    format!("row {row} has {elements} elements for {width}")
}

/// Which of several values, before what is said of it.
fn which(value: Option<usize>) -> String {
    value.map_or(String::new(), |k| format!("value {} ", k + 1))
}

fn sign_lost(by: Cause) -> &'static str {
    match by {
        Cause::Arctan => "an arctangent of a quotient loses the quadrant: atan2 keeps it",
        Cause::Arcsin => "an arcsine gives one of two angles",
        Cause::Arccos => "an arccosine gives one of two angles",
        Cause::Atan2 => "both arguments of atan2 have the wrong sign elsewhere",
        Cause::Root => "the sign of the root is not that of the configuration",
        Cause::Other => "the sign is lost",
    }
}

fn division_by_zero(factor: &Formula, zeros: &[Zeros]) -> String {
    let zero = |zeros: &Zeros| {
        let angle = zeros.angle.as_ref().map(ToString::to_string).unwrap_or_default();
        let values: Vec<String> = zeros.values.iter().map(ToString::to_string).collect();
        format!("{angle} = {}", values.join(" or "))
    };
    let zeros: Vec<String> = zeros.iter().map(zero).collect();
    let place = if zeros.is_empty() { String::new() } else { format!(" ({})", zeros.join("; ")) };
    format!("division by zero where {factor} = 0{place}")
}

fn together(c: &Composed) -> String {
    let spurious = match c.spurious {
        0 => String::new(),
        n => format!(", and {n} configurations that do not reach the pose"),
    };
    format!(
        "one after another the formulas yield {} of {} solutions at {} poses{spurious}",
        c.yielded, c.existing, c.poses
    )
}

/// What the author of a table chose.
fn placed(placement: &Placement) -> String {
    let mut said = vec![];
    said.extend(placement.convention.map(|c| format!("it is read in the convention {c}")));
    if placement.millimetres {
        said.push("lengths are in millimetres".into());
    }
    said.extend(placement.names.iter().map(|(own, robot)| format!("{own} stands for {robot}")));
    said.extend(placement.zeros.iter().map(|(k, by)| format!("joint {k} is {by} more than the robot's")));
    said.extend(placement.reversed.iter().map(|k| format!("joint {k} counts the other way")));
    if placement.base {
        said.push("frame 0 stands elsewhere".into());
    }
    if placement.hand {
        said.push("the last frame stands elsewhere".into());
    }
    if placement.is_turned && !placement.base && !placement.hand {
        said.push("frame 0 or the last frame is turned".into());
    }
    said.join("; ")
}

fn dynamic(what: Dynamic) -> &'static str {
    match what {
        Dynamic::Torque => "a torque",
        Dynamic::Bias => "a torque at constant rates",
        Dynamic::Inertia => "the inertia matrix",
        Dynamic::Velocity => "the centrifugal and Coriolis torques",
        Dynamic::Coriolis => "the matrix of the centrifugal and Coriolis torques",
        Dynamic::Gravity => "the torques of gravity",
        Dynamic::Kinetic => "the kinetic energy",
        Dynamic::Potential => "the potential energy",
        Dynamic::Lagrangian => "the Lagrangian",
        Dynamic::Energy => "the energy",
        Dynamic::Derivative => "a derivative of an energy",
        Dynamic::Place => "a point of a link",
        Dynamic::Motion => "the motion of a point of a link",
    }
}
