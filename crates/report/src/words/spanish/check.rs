//! Documents that were checked.

use super::read_with::{dynamic, read_with, spoken};
use super::{Spanish, counted, genitive};
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

impl Check for Spanish {
    fn about(&self, about: &About) -> String {
        match about {
            About::Matrix(meaning) => return self.meaning(meaning),
            About::Matrices => "una ecuación entre matrices",
            About::Entry => "un elemento",
            About::Equation => "una ecuación",
            About::Helper => "una magnitud auxiliar",
            About::Singularity => "una configuración singular",
            About::Joint => "los valores de una articulación",
            About::Table => "la tabla del robot",
            About::Configuration => "una configuración del robot",
            About::TableRow => "una fila de la tabla",
            About::Angle(set) => return format!("un ángulo de la terna {set}"),
            About::Dynamics(what) => dynamic(*what),
        }
        .into()
    }

    fn entry(&self, name: &str, place: Option<(usize, usize)>) -> String {
        place.map_or_else(|| name.into(), |(r, c)| format!("{name}, fila {r}, columna {c}"))
    }

    fn meaning(&self, meaning: &Meaning) -> String {
        let of = |what: &str, whose: &Meaning| format!("{what} {}", genitive(&self.meaning(whose)));
        match meaning {
            Meaning::Hand => "el efector final".into(),
            Meaning::Position => "la posición del efector final".into(),
            Meaning::Row => "la matriz de transformación de una fila cualquiera".into(),
            Meaning::Frame { of, seen_from } => format!("{} en {}", frame(*of), frame(*seen_from)),
            Meaning::AnyFrame { of, seen_from } => {
                format!("el sistema {of} en el sistema {seen_from}, estén donde estén")
            }
            Meaning::Rotation(whose) => of("la rotación", whose),
            Meaning::Axis(axis, whose) => of(&format!("el eje {axis}"), whose),
            Meaning::Origin(whose) => of("el origen", whose),
            Meaning::Inverse(whose) => of("la inversa", whose),
            Meaning::Transpose(whose) => of("la traspuesta", whose),
            Meaning::Product(factors) => {
                factors.iter().map(|f| self.meaning(f)).collect::<Vec<_>>().join(" por ")
            }
            Meaning::Sum { terms, is_difference } => {
                let sign = if *is_difference { "−" } else { "+" };
                format!("{} {sign} {}", self.meaning(&terms[0]), self.meaning(&terms[1]))
            }
            Meaning::RotationAbout(axis) => format!("la rotación en torno a {axis}"),
            Meaning::TranslationAlong(axis) => format!("la traslación según {axis}"),
            Meaning::Translation => "una traslación".into(),
            Meaning::Torques => "los pares articulares".into(),
            Meaning::Jacobian(jacobian) => matrix_of_velocities(jacobian),
            Meaning::Velocity { of, along, is_angular } => {
                let what = if *is_angular { "la velocidad angular" } else { "la velocidad" };
                let of = genitive(&frame(*of));
                match along {
                    Reference::Base | Reference::Frame(0) => format!("{what} {of}"),
                    _ => format!("{what} {of} según los ejes {}", genitive(&frame(*along))),
                }
            }
            Meaning::AtRest(what) => format!("{}, con todas las articulaciones en 0", self.meaning(what)),
            Meaning::Screw { joint, .. } => {
                format!("el tornillo de la articulación {joint}, con todas las articulaciones en 0")
            }
            Meaning::Column(joint, of) => {
                format!("la columna {joint} {}", genitive(&matrix_of_velocities(of)))
            }
        }
    }

    fn instead(&self, instead: Instead) -> String {
        match instead {
            Instead::Inverse => "su inversa".into(),
            Instead::Transpose => "su traspuesta".into(),
            Instead::RotationTransposed => "la misma con la rotación traspuesta".into(),
            Instead::RowsExchanged(i, j) => format!("la misma con las filas {i} y {j} intercambiadas"),
            Instead::RowSigns(i) => format!("la misma con los signos de la fila {i} cambiados"),
            Instead::ColumnsExchanged(i, j) => format!("la misma con las columnas {i} y {j} intercambiadas"),
            Instead::ColumnSigns(i) => format!("la misma con los signos de la columna {i} cambiados"),
            Instead::Frame { of, seen_from } => format!("el sistema {of} en el sistema {seen_from}"),
            Instead::Backwards { of, seen_from } => {
                format!("las matrices del sistema {seen_from} al {of} multiplicadas en orden inverso")
            }
            Instead::Without { of, seen_from, link } => {
                format!("el sistema {of} en el sistema {seen_from}, sin la matriz {link}")
            }
            Instead::ByTable { of, seen_from, line } => {
                format!("el sistema {of} en el sistema {seen_from} según la tabla de la línea {line}")
            }
        }
    }

    fn remarked(&self, remark: &Remark) -> String {
        match remark {
            Remark::ManyRows { printed, wanted } => {
                format!("{} en lugar de {wanted}", counted(*printed, "fila impresa", "filas impresas"))
            }
            Remark::ShortRow(row) => short_row(*row),
            Remark::Incomparable(r, c) => format!("fila {r}, columna {c}: nada con que comparar"),
            Remark::OthersDiffer(places) => {
                let places: Vec<String> = places.iter().map(|(r, c)| format!("{r},{c}")).collect();
                format!("hechas las cuentas, también difieren los elementos {}", places.join("; "))
            }
            Remark::AngleUnit => "correcto si los grados se toman por radianes, o al revés".into(),
            Remark::Millimetres => "correcto en milímetros".into(),
            Remark::Metres => "correcto en metros".into(),
            Remark::Sign => "correcto salvo el signo".into(),
            Remark::LastDigit => {
                "erróneo en la última cifra: por el camino se redondearon ángulos o π".into()
            }
            Remark::OffBy(x) => format!("se aparta {}", self.written(decimal(*x))),
            Remark::Sampled => "hallado así en pruebas, no demostrado".into(),
            Remark::Compared(poses) => {
                format!("por comparación con todas las soluciones en {}", counted(*poses, "pose", "poses"))
            }
            Remark::ReadAs(sense) => self.sense(sense),
            Remark::SignLost { value, by, right_where } => {
                let which = value.map(|k| format!("valor {}: ", k + 1)).unwrap_or_default();
                let place = match &right_where[..] {
                    [] => String::new(),
                    some => format!(" (correcto para {})", positive(some, " y ")),
                };
                format!("{which}{}{place}", sign_lost(*by))
            }
            Remark::LeftOut(missing) => {
                format!("en el {} de las poses faltan soluciones: {}", share(missing.poses), given(*missing))
            }
            Remark::NoSolution { value, share: x } => {
                format!(
                    "{} no corresponde a ninguna solución en el {} de las poses",
                    which(*value),
                    share(*x)
                )
            }
            Remark::NoNumber { value, share: x } => {
                format!("{} no es un número en el {} de las poses", which(*value), share(*x))
            }
            Remark::DivisionByZero { factor, zeros } => division_by_zero(factor, zeros),
            Remark::FailsAt(q) => {
                let q: Vec<String> = q.iter().map(|x| self.written(format!("{x:.4}"))).collect();
                format!("erróneo en q = ({}), aunque allí la articulación está determinada", q.join("; "))
            }
            Remark::Residual(e) => format!("primer miembro menos segundo: {e}"),
            Remark::Placed(placement) => format!("el mismo mecanismo: {}", placed(placement)),
            Remark::OfTrueCoordinates => "de las coordenadas verdaderas, no de las impresas antes".into(),
            Remark::ByOwnTable => "según la tabla del documento, que es el mismo mecanismo".into(),
        }
    }

    fn sense(&self, sense: &Sense) -> String {
        match sense {
            Sense::Rates(letters) => {
                let named = letters
                    .iter()
                    .map(|[letter, joint]| format!("{letter} se lee como la velocidad de {joint}"));
                return named.collect::<Vec<_>>().join(", ");
            }
            Sense::LinkAlone => "leído como la matriz de un solo eslabón, no como un sistema en la base",
            Sense::OwnLinks => "leídas como las define el documento: solo su producto es el del robot",
            Sense::VelocitiesOfJacobian => {
                "velocidades leídas como las del jacobiano: de su punto, según sus ejes"
            }
            Sense::IndicesExchanged => {
                "leído con el sistema a la izquierda y aquel desde el que se ve a la derecha"
            }
            Sense::Helper => "leído como magnitud auxiliar del documento, no como elemento de la pose",
            Sense::CosineFirst => "leído con el coseno como primer argumento de atan2",
            Sense::ColumnsSnap => "leído con s, n, a, P como columnas de la pose",
            Sense::HandInFrames => {
                "las posiciones con número se leen como las del efector final, vistas desde ese sistema"
            }
            Sense::AgainstLoad => "los pares se leen como los que equilibran la carga",
            Sense::Lengths { letter } => {
                return format!(
                    "{letter}1, {letter}2 … se leen como las longitudes de las filas de la tabla"
                );
            }
            Sense::Tool { place: [x, y, z] } => {
                return format!("el efector final se lee como el punto ({x}, {y}, {z}) del último sistema");
            }
            Sense::LoadInHand => "las componentes de la carga se leen según los ejes del efector final",
            Sense::WristEntries => "leído con r_ij como elementos del sistema 6 en el sistema 3",
            Sense::ZeroIsBase => "leído con la base del robot como sistema 0",
            Sense::PlaceIsO => "leído con o como posición del efector final",
            Sense::Unit { millimetres: true } => "longitudes sin unidad leídas en milímetros",
            Sense::Unit { millimetres: false } => "longitudes sin unidad leídas en metros",
            Sense::Load { letter, axis, is_minus } => {
                let along = if *is_minus { "contra el" } else { "según el" };
                if *letter == 'N' {
                    return format!("la carga en newtons se lee en el efector final, {along} eje {axis}");
                }
                return format!("{letter} leído como carga en el efector final, {along} eje {axis}");
            }
        }
        .into()
    }

    fn skipped(&self, why: &Skipped) -> String {
        match why {
            Skipped::Unreadable(why) => self.unreadable(why),
            Skipped::Unused(name) => format!("define `{name}`, que nada demostrado utiliza"),
            Skipped::SaysNothing => "no dice nada conocido del robot".into(),
            Skipped::Given => {
                "tomado por una configuración dada: nada de lo que se juzga se apoya en él".into()
            }
            Skipped::AmongWords => "entre palabras: nada muestra dónde empieza y termina la fórmula".into(),
            Skipped::OfProgram(name) => format!("nada dice qué es `{name}`"),
            Skipped::TooMany => "el documento tiene más fórmulas de las que se juzgan".into(),
        }
    }

    fn carried(&self, cause: &str, line: usize) -> String {
        format!("se sigue de `{cause}`, línea {line}, que es erróneo")
    }

    fn right_where(&self, condition: &Condition) -> String {
        match condition {
            Condition::OneSign => "con uno de sus signos".into(),
            Condition::OwnSign => "con el signo que corresponde a la configuración".into(),
            Condition::Incomplete(missing) => {
                let gives = missing.map(|m| format!(": {}", given(m))).unwrap_or_default();
                format!("hasta donde llega, pero faltan soluciones{gives}")
            }
            Condition::Compared { poses, apart } if *apart <= ROUNDING => {
                format!("según {}; no está demostrado", counted(*poses, "pose", "poses"))
            }
            Condition::Compared { poses, apart } => format!(
                "salvo unos {apart:.0e} en {}, que es más que redondeo",
                counted(*poses, "pose", "poses")
            ),
            Condition::Configurations(any) if any.is_empty() => "en una parte de las configuraciones".into(),
            Condition::Configurations(any) => {
                let any: Vec<String> = any.iter().map(|all| positive(all, " y ")).collect();
                format!("para {}", any.join(", o para "))
            }
            Condition::Orientations(all) if all.is_empty() => "en una parte de las orientaciones".into(),
            Condition::Orientations(all) => format!("para {}", positive(all, " y ")),
            Condition::AsUsed => "en la medida en que sea correcto lo que la utiliza".into(),
            Condition::Locked => "mientras otras articulaciones estén quietas".into(),
            Condition::Following => "donde una articulación sigue a otras, como dice el texto".into(),
            Condition::Placed(placement) => {
                format!("como el mismo mecanismo, si el enunciado deja libre esto: {}", placed(placement))
            }
        }
    }

    fn either(&self, values: &[String]) -> Option<String> {
        (!values.is_empty()).then(|| values.join(" o "))
    }

    fn unproved(&self, why: Unproved) -> String {
        match why {
            Unproved::NoRate => {
                "las velocidades articulares no tienen valor aquí: indíquelas antes, `dq1 = 0.5 rad/s`"
            }
            Unproved::NoLength => "una longitud no tiene valor: indíquela antes, `a1 = 0.5 m`",
            Unproved::NotFound => "ni demostrado igual ni hallado distinto en ninguna prueba",
            Unproved::OwnTable => {
                "correcto según la tabla del documento, que no se ha comparado con la del robot"
            }
            Unproved::NotOfSet => "no son ángulos de esa terna",
            Unproved::NoPose => "nada dice de qué pose son estos valores articulares",
            Unproved::Unsupported => {
                "no concuerda con el robot tal como aquí se lee, y nada en el documento confirma esa lectura"
            }
            Unproved::OtherConfiguration => {
                "correcto en otra configuración que da el documento, no en la última"
            }
            Unproved::OpenReading => {
                "nada dice cómo se entienden masas, inercias y gravedad, y sin eso no se puede refutar"
            }
            Unproved::AgainstWords(of) => {
                return format!("solo es correcto si se contradice el texto, que {}", spoken(of));
            }
            Unproved::UnknownColumn => "no se sabe qué contiene la columna",
            Unproved::OtherJoints => "no tiene las articulaciones del robot",
            Unproved::OtherNames => "tiene longitudes que no se conocen del robot",
            Unproved::OpenLoad => {
                "un par contiguo tiene un nombre que no se conoce: la carga puede tener más componentes"
            }
            Unproved::Values(why) => return self.undecided(why),
        }
        .into()
    }

    fn undecided(&self, why: Undecided) -> String {
        match why {
            Undecided::UnknownSymbol(s) => {
                return format!(
                    "`{}` no es ni una articulación, ni una longitud, ni un elemento de la pose",
                    s.name()
                );
            }
            Undecided::Shape => "hay demasiados valores",
            Undecided::Circular => "la fórmula contiene la articulación que debe dar",
            Undecided::NeverDefined => "la fórmula no es un número en ninguna pose",
            Undecided::NoSamples => "no hay poses en las que probarla",
            Undecided::NoEnumeration => "las soluciones de este brazo no se pueden enumerar",
        }
        .into()
    }

    fn slip(&self, kind: &SlipKind) -> String {
        match kind {
            SlipKind::Formula(slip) => self.formula_slip(slip),
            SlipKind::Arguments => "los argumentos de atan2 intercambiados".into(),
            SlipKind::ExchangedWith(r, c) => format!("intercambiado con la fila {r}, columna {c}"),
            SlipKind::OtherEntry => "otro elemento".into(),
        }
    }

    fn formula_slip(&self, slip: &Slip) -> String {
        match slip {
            Slip::Sign => "un signo",
            Slip::SineForCosine => "seno y coseno cambiados",
            Slip::Index => "un índice",
            Slip::Symbol => "otro símbolo",
            Slip::LostFactor => "falta un factor",
            Slip::ExtraFactor => "sobra un factor",
            Slip::LostTerm => "falta un sumando",
            Slip::ExtraTerm => "sobra un sumando",
            Slip::Bracket => "un paréntesis",
            Slip::Exponent => "un exponente",
            Slip::Number => "un número",
            Slip::Exchanged => "dos nombres intercambiados",
            Slip::Replaced => "otra expresión",
            Slip::Several(all) => {
                return match all.first() {
                    Some(first) if all.iter().all(|s| s == first) => {
                        format!("{}, {} veces", self.formula_slip(first), all.len())
                    }
                    _ => all.iter().map(|s| self.formula_slip(s)).collect::<Vec<_>>().join(" y "),
                };
            }
        }
        .into()
    }

    fn value_slip(&self, slip: ValueSlip) -> String {
        match slip {
            ValueSlip::Sign => "un signo".into(),
            ValueSlip::AngleUnit => "grados y radianes cambiados".into(),
            ValueSlip::Factor => "un factor".into(),
            ValueSlip::PowerOfTen => "una potencia de diez".into(),
            ValueSlip::Term(n) => format!("el término de grado {n}"),
            ValueSlip::Other => "otro valor".into(),
        }
    }

    fn change(&self, change: &Change) -> String {
        match change {
            Change::Opposite(TableCell { letter, row }) => {
                format!("{letter}{row} con el signo contrario en la tabla")
            }
            Change::Forgotten(TableCell { letter, row }) => format!("{letter}{row} olvidado"),
            Change::ExchangedWithNext(TableCell { letter, row }) => {
                format!("{letter}{row} y {letter}{} intercambiados en la tabla", row + 1)
            }
            Change::Alpha { row, degrees: 0 } => format!("α{row} = 0 en la tabla"),
            Change::Alpha { row, degrees } => format!("α{row} = {degrees}° en la tabla"),
            Change::Offset { row, degrees } => format!("θ{row} con un desfase de {degrees}° más"),
            Change::CountedBackwards(row) => format!("θ{row} contado en el otro sentido"),
            Change::Convention(convention) => format!("la tabla leída en la convención `{convention}`"),
            Change::NoTool => "la herramienta omitida".into(),
            Change::Vanishing(symbol) => self.is_zero(*symbol),
            Change::Definition { name, slip } => format!("la definición de {name}: {}", self.slip(slip)),
        }
    }

    fn unreadable(&self, why: &Unreadable) -> String {
        match why {
            Unreadable::Syntax { message, .. } => message.clone(),
            Unreadable::Unknown(name) => format!("nombre desconocido `{name}`"),
            Unreadable::ManyElements { elements, most } => {
                format!("la matriz tiene {elements} elementos; se leen {most} como mucho")
            }
            Unreadable::ShortRow(row) => short_row(*row),
            Unreadable::LongProduct => "el producto es demasiado largo para calcularlo".into(),
            Unreadable::NeitherFormulaNorProduct => "ni una fórmula ni un producto de matrices".into(),
            Unreadable::NoKnownProduct => "no es un producto de matrices conocidas".into(),
            Unreadable::NoConfiguration => "un número, pero las articulaciones no tienen valores aquí".into(),
            Unreadable::Alias => "el alias es ilegible".into(),
            Unreadable::NothingTold(function) => format!("nada dice qué devuelve `{function}`"),
        }
    }

    fn unreadable_hint(&self, why: &Unreadable) -> Option<String> {
        match why {
            Unreadable::Syntax { hint, .. } => hint.clone(),
            Unreadable::NoConfiguration => {
                Some("indíquelos antes: `θ1 = 30°, θ2 = 45°`, o `q = [0.5, 0.8]`".into())
            }
            Unreadable::NothingTold(_) => Some(
                "devuelva una pose, una posición o un jacobiano como matriz, o dé a lo devuelto un nombre como T06, px, J"
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
                format!("el documento tiene {bytes} bytes; se leen {most} como mucho")
            }
            Noted::NoRobot => {
                "no hay robot: en el documento no aparece ninguna tabla de parámetros de Denavit-Hartenberg"
                    .into()
            }
            Noted::ReadAs(convention) => {
                format!("las tablas se leen en la convención {convention}: lo dice el texto")
            }
            Noted::InMillimetres => {
                "las longitudes sin unidad de las tablas están en mm: lo dice el texto".into()
            }
            Noted::Supported { convention, right, rival } => format!(
                "las tablas se leen en la convención {convention}: así son correctas {right} afirmaciones del texto, {rival} en otra"
            ),
            Noted::NotSet(_, NotSet::Unknown { name, known }) => match &known[..] {
                [] => format!("`{name}` recibe un valor: no hay parámetros"),
                known => format!("`{name}` recibe un valor y es desconocido; hay {}", known.join(", ")),
            },
            Noted::NotSet(name, NotSet::Value(_)) => format!("`{name}` recibe un valor ilegible"),
            Noted::Reading(sense) => self.sense(sense),
            Noted::UnknownRobot(name) => format!("en el catálogo no hay ningún robot `{name}`"),
            Noted::NoSuchTable => "esa tabla no existe".into(),
            Noted::UnknownConvention(name) => format!("convención desconocida `{name}`"),
            Noted::NoTool => "una herramienta son tres longitudes".into(),
            Noted::PassedOver(why) => format!("pasado por alto: {}", self.unreadable(why)),
            Noted::NotRead(why) => format!("no leído: {}", self.unreadable(why)),
            Noted::Together(composed) => together(composed),
            Noted::ReadWith(all) => {
                let all: Vec<String> = all.iter().map(read_with).collect();
                format!("leído con {}: así es correcta la mayoría, y el texto no lo dice", all.join("; "))
            }
        }
    }

    fn noted_hint(&self, what: &Noted) -> Option<String> {
        let hint = match what {
            Noted::Table { hint, .. } => return hint.clone(),
            Noted::PassedOver(why) | Noted::NotRead(why) => return self.unreadable_hint(why),
            Noted::NoRobot => {
                "nombre el robot antes del archivo, o ponga su tabla en el documento, con al menos tres de theta, d, a, alpha, r en la \
                 cabecera"
            }
            Noted::UnknownConvention(_) => "las convenciones son standard, craig y khalil",
            Noted::NoTool => "escriba `tool 0, 0, r_7`",
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

fn frame(which: Reference) -> String {
    match which {
        Reference::Base => "la base".into(),
        Reference::Frame(k) => format!("el sistema {k}"),
        Reference::Tool => "el efector final".into(),
    }
}

fn matrix_of_velocities(jacobian: &Jacobian) -> String {
    let body = match jacobian.body {
        Reference::Tool => "del efector final",
        Reference::Base | Reference::Frame(_) => "del origen del último sistema",
    };
    let axes = match jacobian.axes {
        Reference::Base | Reference::Frame(0) => String::new(),
        Reference::Frame(k) => format!(" según los ejes del sistema {k}"),
        Reference::Tool => " según sus propios ejes".into(),
    };
    let at = jacobian.at.map_or(String::new(), |k| format!(" en el origen del sistema {k}"));
    let first = if jacobian.is_angular_first { ", primero las filas angulares" } else { "" };
    let part = rows_of(jacobian).map_or(String::new(), |rows| format!(", filas {rows}"));
    format!("el jacobiano {body}{at}{axes}{first}{part}")
}

fn short_row(ShortRow { row, elements, width }: ShortRow) -> String {
    format!("la fila {row} tiene {} en lugar de {width}", counted(elements, "elemento", "elementos"))
}

/// A value among several, or the formula that has one only.
fn which(value: Option<usize>) -> String {
    value.map_or("la fórmula".into(), |k| format!("el valor {}", k + 1))
}

fn share(share: f64) -> String {
    format!("{} %", percent(share))
}

/// How many values there are of those that exist.
fn given(missing: Missing) -> String {
    format!("{} de {}", counted(missing.given, "valor", "valores"), missing.existing)
}

fn sign_lost(by: Cause) -> &'static str {
    match by {
        Cause::Arctan => "la arcotangente de un cociente pierde el cuadrante; atan2 lo conserva",
        Cause::Arcsin => "un arcoseno da uno solo de dos ángulos",
        Cause::Arccos => "un arcocoseno da uno solo de dos ángulos",
        Cause::Atan2 => "los dos argumentos de atan2 tienen en otras partes el signo equivocado",
        Cause::Root => "el signo de la raíz no es el de la configuración",
        Cause::Other => "se pierde el signo",
    }
}

fn division_by_zero(factor: &Formula, zeros: &[Zeros]) -> String {
    let zero = |zeros: &Zeros| {
        let angle = zeros.angle.as_ref().map(ToString::to_string).unwrap_or_default();
        let values: Vec<String> = zeros.values.iter().map(ToString::to_string).collect();
        format!("{angle} = {}", values.join(" o "))
    };
    let zeros: Vec<String> = zeros.iter().map(zero).collect();
    let place = if zeros.is_empty() { String::new() } else { format!(" ({})", zeros.join("; ")) };
    format!("división entre cero para {factor} = 0{place}")
}

fn together(c: &Composed) -> String {
    let spurious = match c.spurious {
        0 => String::new(),
        1 => ", y 1 configuración que no alcanza la pose".into(),
        n => format!(", y {n} configuraciones que no alcanzan la pose"),
    };
    format!(
        "una tras otra, las fórmulas dan {} de {} soluciones en {}{spurious}",
        c.yielded,
        c.existing,
        counted(c.poses, "pose", "poses")
    )
}

/// What the author of a table chose.
fn placed(placement: &Placement) -> String {
    let mut said = vec![];
    said.extend(placement.convention.map(|c| format!("se lee en la convención {c}")));
    if placement.millimetres {
        said.push("las longitudes están en milímetros".into());
    }
    said.extend(placement.names.iter().map(|(own, robot)| format!("{own} representa {robot}")));
    said.extend(
        placement.zeros.iter().map(|(k, by)| format!("la articulación {k} es {by} mayor que la del robot")),
    );
    said.extend(placement.reversed.iter().map(|k| format!("la articulación {k} cuenta en el otro sentido")));
    if placement.base {
        said.push("el sistema 0 está en otro sitio".into());
    }
    if placement.hand {
        said.push("el último sistema está en otro sitio".into());
    }
    if placement.is_turned && !placement.base && !placement.hand {
        said.push("el sistema 0 o el último sistema está girado".into());
    }
    said.join("; ")
}
