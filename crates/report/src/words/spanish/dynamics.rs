//! Dynamics.

use super::Spanish;
use crate::tree::{Line, Math};
use crate::words::{Dynamics, Terms};
use denavit::dynamics::{Gives, Ground, Minimality};
use denavit::geometry::NoBody;
use denavit_program::Count;

impl Dynamics for Spanish {
    fn dynamics_title(&self, robot: &str) -> String {
        format!("Dinámica: {robot}")
    }

    fn link_parameters(&self, has_other_frames: bool) -> String {
        let frames = match has_other_frames {
            true => {
                "del sistema cuyo eje z está sobre el propio eje del eslabón (los de la tabla en la convención de Khalil, no los de \
                 esta)"
            }
            false => "de su sistema",
        };
        format!(
            "El eslabón j tiene la inercia XXj … ZZj (un tensor: XYj es el producto de inercia cambiado de signo), los momentos \
             estáticos MXj, MYj, MZj y la masa Mj, todo respecto al origen {frames}. qd y qdd son las velocidades y las aceleraciones \
             articulares."
        )
    }

    fn no_body(&self, why: NoBody) -> &'static str {
        match why {
            NoBody::NotFinite => "un número no es finito",
            NoBody::NegativeMass => "su masa es negativa",
            NoBody::NoMass => "su masa es nula, y su momento estático o su inercia no lo es",
            NoBody::NotPositive => "su inercia respecto al centro de masas no es positiva",
            NoBody::Triangle => "uno de sus momentos principales supera la suma de los otros dos",
        }
    }

    fn gravity_is(&self, components: [Math; 3]) -> Line {
        Line::new("La aceleración de la gravedad en la base es (")
            .numbers(components, self.between())
            .text(").")
    }

    fn base_title(&self) -> String {
        "Parámetros base".into()
    }

    fn base_count(&self, all: usize, base: usize, minimality: Minimality) -> String {
        let rest = match minimality {
            Minimality::Proved => {
                "Menos no bastan: está demostrado que las columnas que les corresponden son independientes."
                    .into()
            }
            Minimality::AtLeast(rank) => {
                format!("Quizá basten menos: está demostrado que {rank} de ellos son independientes.")
            }
            Minimality::Unknown => "No se ha decidido si bastarían menos.".to_string(),
        };
        let of = match all {
            1 => "Del único parámetro de los eslabones, agrupado".into(),
            n => format!("De los {n} parámetros de los eslabones, agrupados"),
        };
        let have = if base == 1 { "influye" } else { "influyen" };
        format!("{of}, {base} {have} en los pares. {rest}")
    }

    fn kept(&self, all: Vec<Math>) -> Line {
        Line::new("Como se ha pedido, estos representan lo que se agrupa con ellos: ").list(all).text(".")
    }

    fn dropped(&self, all: Vec<Math>) -> Line {
        Line::new("Como se ha pedido, otros ocupan el lugar de ").list(all).text(".")
    }

    fn base_alone(&self, all: Vec<Math>) -> Line {
        Line::new("tal cual: ").list(all)
    }

    fn without_effect(&self, all: Vec<Math>) -> Line {
        Line::new("sin efecto en los pares: ").list(all)
    }

    fn torques_title(&self) -> String {
        "Pares articulares".into()
    }

    fn torques_cost(&self, count: &Count, ground: Ground) -> String {
        let ground = match ground {
            Ground::Proved => "igualdad demostrada con las ecuaciones de Lagrange".into(),
            Ground::Modulo(states) => format!(
                "no demostrado en general: exactamente igual a las ecuaciones de Lagrange en {states} estados aleatorios módulo un \
                 primo de 61 bits"
            ),
            Ground::Numbers(states, off) => format!(
                "no demostrado: igual a las ecuaciones de Lagrange salvo {off:.0e} en {states} estados"
            ),
            Ground::Failed => "distinto de las ecuaciones de Lagrange: es un defecto del programa".into(),
        };
        format!("{}; {ground}.", self.count(count))
    }

    fn with_friction(&self) -> String {
        "h incluye el rozamiento de las articulaciones.".into()
    }

    fn divides_by(&self, all: Vec<Math>) -> Line {
        Line::new("Este programa divide entre ").list(all).text(" y vale donde eso no es 0.")
    }

    fn inertia_title(&self) -> String {
        "Matriz de inercia".into()
    }

    fn velocity_torques_title(&self) -> String {
        "Pares centrífugos y de Coriolis".into()
    }

    fn gravity_torques_title(&self) -> String {
        "Pares de la gravedad".into()
    }

    fn bodies_title(&self) -> String {
        "Los eslabones".into()
    }

    fn bodies(&self) -> String {
        "Un eslabón es todo lo que se mueve con un mismo eje. El eje z de su sistema está sobre ese eje; el sistema 0 es la base. Lo que \
         es constante entre dos ejes y el movimiento del segundo forman las matrices de transformación:"
            .into()
    }

    fn grouping(&self) -> String {
        "Una masa sobre el eje de una articulación de rotación está en reposo en los dos eslabones que la articulación enlaza, de modo que \
         los pares son los mismos se cuente con uno o con otro. De la punta a la base, cada eslabón cede al anterior todo lo que puede \
         contarse allí:"
            .into()
    }

    fn gives(&self, link: usize, gives: Gives) -> String {
        let k = link;
        let (to, before) = match link {
            1 => ("a la base".to_string(), "la base".to_string()),
            _ => (format!("al eslabón {}", link - 1), format!("el eslabón {}", link - 1)),
        };
        match gives {
            Gives::OnAxis => format!(
                "el eslabón {k} gira: cede {to} M{k}, MZ{k} e YY{k} (como segundo momento a lo largo de su eje), y conserva \
                 XX{k} − YY{k}, XY{k}, XZ{k}, YZ{k}, ZZ{k}, MX{k}, MY{k}, con lo que ha recibido"
            ),
            Gives::Nothing => format!(
                "el eslabón {k} gira y tiene una masa para cada dirección: no cede nada, y conserva lo que ha recibido"
            ),
            Gives::Inertia => format!(
                "el eslabón {k} se desliza: gira con {before}, y su inercia se cuenta allí; conserva M{k}, MX{k}, MY{k}, MZ{k}, con lo \
                 que ha recibido"
            ),
            Gives::Across => format!(
                "el eslabón {k} se desliza: gira con {before}, y su inercia se cuenta allí; conserva M{k}, MX{k}, MY{k}, MZ{k}, con lo \
                 que ha recibido, salvo un primer momento en la dirección de todos los ejes de giro anteriores, que no influye"
            ),
            Gives::Plan => format!(
                "el eslabón {k} se desliza en la dirección de todos los ejes de giro anteriores: {before} toma todo salvo su masa en esa \
                 dirección"
            ),
        }
    }

    fn outward_title(&self) -> String {
        "De la base a la herramienta: cómo se mueven los eslabones".into()
    }

    fn outward(&self) -> String {
        "En el sistema de cada eslabón: w es su velocidad angular, wd la derivada de esta, a la aceleración del origen del sistema menos la \
         de la gravedad. Sean R el giro a este sistema desde el del eslabón anterior, cuyos valores llevan el índice p, y r la posición \
         de su origen allí: w = R wp, wd = R wdp, a = R(ap + Up r). Con una articulación de rotación se añade z qd a w, y \
         z qdd + w × z qd (con la w de antes) a wd; con una prismática se añade z qdd + 2 w × z qd a la aceleración. \
         U = [wd]× + [w]×[w]×: un punto del eslabón en r tiene la aceleración a + U r. Lo que es 0, o igual a otro valor, no tiene nombre."
            .into()
    }

    fn link(&self, link: usize) -> String {
        format!("Eslabón {link}")
    }

    fn link_of_tree(&self, link: usize, joint: &str, parent: Option<usize>) -> String {
        match parent {
            Some(parent) => {
                format!("Eslabón {link}: tras la articulación {joint}, sobre el eslabón {parent}.")
            }
            None => format!("Eslabón {link}: tras la articulación {joint}, sobre la raíz."),
        }
    }

    fn motion_ground(&self, ground: Ground) -> String {
        match ground {
            Ground::Proved => {
                "Demostrado: w, wd y a son los del producto de las matrices de transformación, por sus derivadas.".into()
            }
            Ground::Modulo(states) => format!(
                "No demostrado en general: w, wd y a son exactamente iguales a las derivadas del producto de las matrices de \
                 transformación en {states} estados aleatorios módulo un primo de 61 bits."
            ),
            Ground::Numbers(states, off) => format!(
                "No demostrado: w, wd y a son las derivadas del producto de las matrices de transformación salvo {off:.0e} en {states} \
                 estados."
            ),
            Ground::Failed => {
                "Distintos de las derivadas del producto de las matrices de transformación: es un defecto del programa."
                    .into()
            }
        }
    }

    fn inward_title(&self) -> String {
        "De la herramienta a la base: lo que mueve los eslabones".into()
    }

    fn inward(&self) -> String {
        "De la punta a la base, respecto al origen de cada sistema: f es la fuerza y n el momento que mueven el eslabón y todos los que le \
         siguen. Para el eslabón por sí solo son, en parámetros base, M a + U MS y J wd + w × J w + MS × a; se suma, llevado a este sistema, lo \
         que mueve los eslabones siguientes. El par de una articulación de rotación es el momento en torno a su eje z; el esfuerzo de una \
         prismática, la fuerza a lo largo de él."
            .into()
    }

    fn short_title(&self) -> String {
        "El programa corto".into()
    }

    fn short(&self) -> String {
        "La misma recursión admite muchas formas: ejes paralelos tomados juntos, el movimiento y los esfuerzos de un eslabón en este o aquel \
         sistema, la masa sobre los ejes contada aquí o allá, una longitud como unidad. La más corta que halló la búsqueda, en lugar de \
         la anterior (`--symbolic` la escribe):"
            .into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::words::spanish::counted;

    #[test]
    fn one_and_many_parameters() {
        let said = |all, base| Spanish.base_count(all, base, Minimality::Unknown);
        assert!(said(1, 1).starts_with("Del único parámetro de los eslabones, agrupado, 1 influye en"));
        assert!(said(20, 3).starts_with("De los 20 parámetros de los eslabones, agrupados, 3 influyen en"));
        assert_eq!(counted(1, "articulación", "articulaciones"), "1 articulación");
    }
}
