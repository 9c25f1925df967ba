//! Inverse kinematics.

use super::{Spanish, counted};
use crate::explained::{Bound, Case, Component, Consequence, Kind, Remark, Source};
use crate::tree::{Line, Math, Proof, Sign};
use crate::words::{Coefficients, Given, Inverse, Terms};
use denavit::inverse::derivation::{Elimination, MAX_AXES, NotGiven};
use denavit::inverse::{Doubt, Goal, Label, Obstacle, Stuck, Task, Unsuitable};
use denavit_symbolic::Expr;

const ORDINALS: [&str; 5] = ["cero", "primera", "segunda", "tercera", "cuarta"];

impl Inverse for Spanish {
    fn inverse_title(&self, robot: &str) -> String {
        format!("Cinemática inversa: {robot}")
    }

    fn other_joints(&self) -> String {
        "Las demás articulaciones".into()
    }

    fn solutions_found(&self, solutions: Option<usize>) -> String {
        match solutions {
            Some(1) => "una solución".into(),
            Some(n) => format!("como mucho {n} soluciones"),
            None => "la deducción termina aquí: no se ha encontrado ninguna forma cerrada".into(),
        }
    }

    fn given(&self, given: Given) -> Line {
        let mut line = Line::new(match given.goal {
            Goal::Pose => "Se da la pose T del efector final",
            Goal::Position => "Se da la posición del efector final",
            Goal::PositionAndAxis => "Se dan la posición del efector final y la dirección de su eje z",
        });
        let beside = given.joints.len();
        if beside > 0 {
            line = line.text(", y además ").list(given.joints);
        }
        line = line.text(match (given.is_choice && beside > 0, beside) {
            (false, _) => "",
            (true, 1) => {
                " (una articulación de más: se admite cualquier valor, y con esta la deducción es la más corta)"
            }
            (true, _) => {
                " (articulaciones de más: se admiten todos los valores, y con estas la deducción es la más corta)"
            }
        });
        let line = line.text("; se busca: ").list(given.sought).text(". ");
        match given.is_whole {
            true => line.text("Con ").math(Given::whole()).text(" la cadena es"),
            false => line.text("Lo que es constante en ambos extremos pasa al lado de la pose; queda"),
        }
    }

    fn given_columns(&self, has_axis: bool) -> &'static str {
        match has_axis {
            true => {
                "De U solo están dadas la tercera y la cuarta columnas; las demás se siguen de la solución."
            }
            false => "De U solo está dada la cuarta columna; las demás se siguen de la solución.",
        }
    }

    fn short_names(&self, q: Expr, sum: Option<Expr>) -> Line {
        let line = Line::default().math(q.cos()).text(" y ").math(q.sin());
        let line = line.text(" son el coseno y el seno de ").math(q);
        match sum {
            Some(sum) => line.text(", ").math(sum.cos()).text(" es el coseno de ").math(sum).text("."),
            None => line.text("."),
        }
    }

    fn step_title(&self, number: usize, unknown: Line, values: usize, label: Option<Label>) -> Line {
        let mut line = Line::new(format!("Paso {number}. "));
        line.0.extend(unknown.0);
        let line = line.text(match values {
            1 => ": un valor".into(),
            n => format!(": {n} valores"),
        });
        line.text(label.map(|l| format!(" ({})", self.label(l))).unwrap_or_default())
    }

    fn source(&self, source: &Source) -> Line {
        let (left, right) = source.product.clone();
        let mut line = Line::new(if source.inverse { "Ambos miembros invertidos: " } else { "" });
        line = line.math(Math::Products(left, right)).text(", ");
        let [rows, columns] = source.rows_and_columns();
        let several = |all: &[usize], word: &str| {
            let names: Vec<String> = all.iter().map(|&n| ORDINALS[n.min(4)].to_string()).collect();
            format!("{} {word}{}", self.listed(&names), if all.len() == 1 { "" } else { "s" })
        };
        line = line.text(match (rows.len(), columns.len()) {
            (1, _) | (_, 1) => format!("{}, {}", several(&rows, "fila"), several(&columns, "columna")),
            _ => {
                let places: Vec<String> =
                    source.elements.iter().map(|(r, c)| format!("({r}, {c})")).collect();
                format!("elementos {}", self.listed(&places))
            }
        });
        let why = source.why.as_ref().map(|why| format!(" ({})", self.component(why)));
        line.text(why.unwrap_or_default()).text(":")
    }

    fn component(&self, component: &Component) -> String {
        let numbers = |all: &[usize]| self.numbers(all);
        let of = match (&component.of[..], component.is_point) {
            ([], _) => String::new(),
            ([axis], false) => format!(" de la dirección del eje {}", axis + 1),
            (axes, false) => format!(" de la dirección de los ejes {}", numbers(axes)),
            ([axis], true) => format!(" de un punto del eje {}", axis + 1),
            (axes, true) => format!(" de un punto común a los ejes {}", numbers(axes)),
        };
        let along = match &component.along[..] {
            [] => String::new(),
            [axis] => format!(" según el eje {}", axis + 1),
            axes => format!(" según los ejes paralelos {}", numbers(axes)),
        };
        let free = match &component.free[..] {
            [joint] => format!(": no depende de la articulación {}", joint + 1),
            joints => format!(": no depende de las articulaciones {}", numbers(joints)),
        };
        format!("una componente{of}{along}{free}")
    }

    fn elimination(&self, unknown: Expr, how: Elimination) -> Line {
        Line::default().math(unknown).text(match how {
            Elimination::Rotation => {
                " se elimina al despejar sus términos en las dos ecuaciones, elevarlas al cuadrado y sumarlas: los factores de su coseno y \
                 de su seno son los de un giro."
            }
            Elimination::Cramer => {
                " se elimina al calcular su coseno y su seno por la regla de Cramer; la suma de sus cuadrados es 1."
            }
            Elimination::Displacement => " se elimina al despejarla de una ecuación y sustituirla en la otra.",
        })
    }

    fn names_follow(&self, is_beside: bool) -> String {
        if is_beside { "con" } else { "Sea" }.into()
    }

    fn kind(&self, kind: Kind) -> String {
        match kind {
            Kind::Displacement => "lineal en el desplazamiento",
            Kind::DisplacementSquared => "cuadrática en el desplazamiento",
            Kind::Quartic => "de grado 2 en coseno y seno: de grado 4 en tan(θ/2)",
            Kind::Homogeneous => "lineal en coseno y seno, sin término independiente",
            Kind::Cosine => "solo un coseno",
            Kind::Sine => "solo un seno",
            Kind::Linear => "lineal en coseno y seno",
            Kind::Pair => "dos ecuaciones lineales en coseno y seno",
            Kind::Separate => "coseno y seno, cada uno de su propia ecuación",
        }
        .into()
    }

    fn equation(&self, kind: Kind, is_squared: bool, form: &[Math], coefficients: &Coefficients) -> Line {
        let mut line = Line::new(match (kind.number(), is_squared) {
            ("none", _) => "Una ecuación ".to_string(),
            (n, true) => format!("Los cuadrados de ambos miembros, sumados: tipo {n}, "),
            (n, false) => format!("Tipo {n}, "),
        });
        line = line.text(self.kind(kind));
        for (k, f) in form.iter().enumerate() {
            line = line.text(if k == 0 { ": " } else { " y " }).math(f.clone());
        }
        match coefficients {
            Coefficients::Below => line.text(" con"),
            Coefficients::Here([]) => line.text("; de donde"),
            Coefficients::Here(all) => {
                line.text(" con ").numbers(all.iter().cloned(), self.between()).text("; de donde")
            }
        }
    }

    fn so(&self) -> String {
        "de donde".into()
    }

    fn case(&self, case: &Case) -> Line {
        let mut line = Line::default();
        let between = if case.is_zeros() { " y " } else { " o " };
        for (k, m) in case.when.iter().enumerate() {
            line = line.text(if k == 0 { "" } else { between }).math(m.clone());
        }
        line.text(if case.when.is_empty() { "" } else { ": " }).text(self.consequence(case.then))
    }

    fn consequence(&self, consequence: Consequence) -> String {
        match consequence {
            Consequence::NoSolution(bound) => nothing(bound),
            Consequence::Coincide => "ambos valores coinciden (multiplicidad 2)",
            Consequence::TwoValues(bound) => {
                return format!(
                    "dos valores; coinciden donde se da la igualdad (multiplicidad 2, configuración singular); si no se cumple, {}",
                    nothing(bound)
                );
            }
            Consequence::OpenDisplacement => {
                "la ecuación no determina el desplazamiento: si también se anula el segundo miembro, es libre o lo da otra ecuación; si no, \
                 no hay solución"
            }
            Consequence::OpenAngle => {
                "la ecuación deja indeterminado el ángulo: es libre (el brazo puede moverse sin dejar el objetivo) o lo da otra \
                 ecuación"
            }
            Consequence::OpenUnless => {
                "no hay solución, salvo que también se anule el segundo miembro: entonces la ecuación deja indeterminada la articulación"
            }
            Consequence::OpenJoint => {
                "si también se anulan los segundos miembros, la articulación es libre o la da otra ecuación; si no, no hay solución"
            }
            Consequence::Roots => {
                "tantos valores como raíces reales t = tan(θ/2) tenga el polinomio: 0, 2 o 4; una raíz doble cuenta dos veces"
            }
            Consequence::HalfTurn => "una de las raíces es la media vuelta",
            Consequence::Free => "la articulación es libre",
            Consequence::OneValue => "siempre exactamente un valor",
            Consequence::OneEquation => {
                "las dos ecuaciones son una sola: dos valores, una articulación libre o ninguna solución; el cálculo toma la fila de mayor \
                 norma"
            }
        }
        .into()
    }

    fn remark(&self, remark: Remark) -> String {
        match remark {
            Remark::MayAdd => {
                "La eliminación puede añadir raíces que solo cumplen esta ecuación; el residuo de la pose las descarta."
            }
            Remark::SquaresAddNone => {
                "Elevar al cuadrado no añade raíces: para cada valor de la incógnita, las componentes dan la dirección que el cuadrado \
                 había borrado."
            }
            Remark::Whole => "No se descarta ninguna ecuación ni se eleva nada al cuadrado.",
            Remark::AddsNone => "No se añade ninguna raíz.",
        }
        .into()
    }

    fn step_remark(&self, sign: Option<(Expr, Option<Label>)>, remark: Remark, used_by: &[usize]) -> Line {
        let mut line = Line::default();
        if let Some((sign, label)) = sign {
            line = line.math(Math::relation(sign, Sign::EitherSign, Expr::int(1)));
            if let Some(label) = label.map(|l| self.label(l)) {
                line = line.text(format!(": {label}+ y {label}−"));
            }
            line = line.text(". ");
        }
        line.text(self.remark(remark)).text(match used_by {
            [] => " Ningún paso posterior lo necesita.".to_string(),
            [one] => format!(" Se usa en el paso {one}."),
            many => {
                let many: Vec<String> = many.iter().map(ToString::to_string).collect();
                format!(" Se usa en los pasos {}.", self.listed(&many))
            }
        })
    }

    fn conditions_title(&self) -> String {
        "Lo que debe cumplir la pose".into()
    }

    fn conditions(&self, rank: usize, task: Option<Task>) -> String {
        let freedoms = counted(rank, "grado de libertad", "grados de libertad");
        let told = task.map(|t| format!(": se le puede imponer {}", self.task(t))).unwrap_or_default();
        format!("El efector final tiene {freedoms}{told}. Una pose alcanzable cumple")
    }

    fn task(&self, task: Task) -> String {
        match task {
            Task::Pose => "cualquier posición y orientación".into(),
            Task::PositionAndAxis => "una posición y la dirección del eje de la herramienta".into(),
            Task::PositionAndTurn => "una posición y un giro en torno a una dirección (x, y, z, φ)".into(),
            Task::Planar => "una posición y un giro en un plano (x, y, φ)".into(),
            Task::Position => "una posición (x, y, z)".into(),
            Task::Orientation => "una orientación".into(),
            Task::Other(n) => format!("una pose de un conjunto de dimensión {n}"),
        }
    }

    fn solutions_title(&self, solutions: usize) -> String {
        match solutions {
            1 => "Una solución".into(),
            n => format!("Como mucho {n} soluciones"),
        }
    }

    fn solutions_product(&self, product: &str) -> String {
        format!("{product} ramas:")
    }

    fn solutions_remark(&self) -> String {
        "Cada paso se sigue de las ecuaciones anteriores y tiene todas sus raíces, de modo que no se pierde ninguna solución. Cada solución se \
         sustituye en la cadena completa; la que no da la pose se descarta. Los tipos están numerados como en Khalil y Dombre; 1, 2 y 3 \
         son los de Paul."
            .into()
    }

    fn ended_title(&self) -> String {
        "Aquí termina la deducción".into()
    }

    fn ended(&self, has_found: bool, missing: Vec<Math>) -> Line {
        let line = Line::new(if has_found { "" } else { "No se ha encontrado nada. " });
        let line = line.text(
            "Ninguna ecuación de la cadena, ni ninguna de las combinaciones de dos que se probaron, tiene como única incógnita ",
        );
        line.list(missing).text(", con grado 4 como mucho en tan(θ/2).")
    }

    fn ended_remark(&self, surplus: usize) -> String {
        if surplus == 0 {
            return "Hay formas cerradas cuando tres ejes consecutivos se cortan en un punto o son paralelos; si no, el brazo general tiene \
                    hasta 16 soluciones, raíces de un polinomio de grado 16."
                .into();
        }
        format!(
            "El brazo tiene {} más de lo que el efector final puede aprovechar: si se dan otras articulaciones, la deducción puede llegar al \
             final.",
            counted(surplus, "articulación", "articulaciones")
        )
    }

    fn solution(&self, number: usize) -> String {
        format!("solución {number}")
    }

    fn legend(&self, proof: Proof) -> String {
        match proof {
            Proof::Proved => {
                "✓: demostrado. Con A1·A2·… en lugar de U, ambos miembros son idénticos, sean cuales sean los valores articulares y las \
                 longitudes."
            }
            Proof::Sampled => {
                "✓: demostrado. ≈: comprobado solo en poses de prueba; el desarrollo es demasiado grande para decidir."
            }
            Proof::Wrong => "Una de las fórmulas anteriores es FALSA: es un error del programa.",
        }
        .into()
    }

    fn unsuitable(&self, why: &Unsuitable) -> String {
        match why {
            Unsuitable::Helical(row) => {
                format!("la fila {row} gira y se desliza a la vez (articulación helicoidal)")
            }
            Unsuitable::Coupling => {
                "los ángulos de las filas no son sumas de múltiplos enteros de tantos de ellos como variables \
                 articulares hay"
                    .into()
            }
            Unsuitable::NoJoint => "el robot no tiene ninguna articulación".into(),
            Unsuitable::TooLong(n) => {
                format!("el robot tiene {n} articulaciones; se buscan formas cerradas hasta {MAX_AXES}")
            }
        }
    }

    fn not_given(&self, why: NotGiven) -> String {
        match why {
            NotGiven::NoSuchJoint { joint, joints } => {
                format!("se da la articulación {}, pero solo hay {joints}", joint + 1)
            }
            NotGiven::NoSurplus => {
                "no se puede dar ninguna articulación: el brazo no tiene más de las que su efector final puede aprovechar".into()
            }
            NotGiven::TooMany { given, surplus } => format!(
                "se {} {}, pero al brazo solo le {} {surplus}",
                if given == 1 { "da" } else { "dan" },
                counted(given, "articulación", "articulaciones"),
                if surplus == 1 { "sobra" } else { "sobran" }
            ),
        }
    }

    fn stuck(&self, stuck: &Stuck) -> String {
        let [found, missing] = [stuck.found(), stuck.open()].map(|all| all.join(", "));
        let found = if found.is_empty() { "nada".into() } else { found };
        if stuck.is_spent {
            format!(
                "sin forma cerrada dentro del límite de cálculo: hasta ahí se halló {found}; queda {missing}"
            )
        } else {
            format!(
                "sin forma cerrada: se halló {found}; para {missing} no queda ninguna ecuación de grado 4 como mucho con una sola incógnita"
            )
        }
    }

    fn doubt(&self, doubt: Doubt) -> String {
        match doubt {
            Doubt::Sampled => "algunas soluciones se encontraron probando valores",
            Doubt::DoubleRoot => "sin decidir cerca de una raíz doble",
            Doubt::Uncounted => "no se pudieron contar las raíces",
            Doubt::Searched => "buscadas desde varias configuraciones iniciales",
            Doubt::OneAsked => "solo se pedía una",
            Doubt::Copies => {
                "por los engranajes, cada configuración se repite en una vuelta más veces de las que aparecen"
            }
            Doubt::Digits => "el robot está tan lejos del origen que la pose tiene demasiado pocas cifras",
        }
        .into()
    }

    fn obstacle(&self, obstacle: &Obstacle) -> String {
        match &obstacle.unknown {
            Some(x) => format!("ninguna rama da un valor de {x}"),
            None => "el efector final no puede tomar esta pose".into(),
        }
    }

    fn violated(&self, conditions: &[&str]) -> String {
        format!("una pose de este brazo cumple {}", conditions.join(", "))
    }
}

fn nothing(bound: Bound) -> &'static str {
    match bound {
        Bound::Reach => "fuera de alcance: ninguna solución en esta rama",
        Bound::Span => "el brazo es demasiado corto o no puede plegarse tanto: ninguna solución en esta rama",
    }
}
