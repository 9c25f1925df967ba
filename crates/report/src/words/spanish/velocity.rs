//! Jacobians and singularities.

use super::Spanish;
use crate::tree::{Line, Math};
use crate::words::{Gain, Loss, Terms, Velocity};
use denavit::forward::{Proof, Reference};
use denavit::velocity::{Blocks, MAX_JOINTS, Obstacle, Place, Still};
use denavit_program::Count;
use denavit_symbolic::Refusal;

impl Velocity for Spanish {
    fn jacobian_title(&self, robot: &str) -> String {
        format!("Jacobiano: {robot}")
    }

    fn viewpoint(&self, body: Reference, at: Reference, offset: Option<[Math; 3]>, axes: Reference) -> Line {
        let is_origin = body == at && offset.is_none();
        let [body, at, axes] = [body, at, axes].map(|frame| self.of_frame(frame));
        let mut line = Line::new(match is_origin {
            true => format!("Primero las filas de la velocidad lineal, la del origen {at}"),
            false => format!(
                "Primero las filas de la velocidad lineal, la del punto {body} situado en el origen {at}"
            ),
        });
        if let Some(offset) = offset {
            line = line.text(" más (").numbers(offset, self.between()).text(")");
        }
        line.text(format!(", después las de la velocidad angular, según los ejes {axes}."))
    }

    fn no_entries(&self, why: Refusal) -> String {
        format!("Los elementos no están desarrollados: {}.", self.unexpanded(why))
    }

    fn jacobian_cost(&self, count: &Count, proof: Proof) -> String {
        format!("{}; {}.", self.count(count), self.jacobian_proof(proof))
    }

    fn shortest(&self) -> String {
        "En este sistema y para este punto la matriz es la más corta. Para otros ejes, o para otro punto del mismo cuerpo, se obtiene con un \
         giro y un brazo de palanca, que no cambian el determinante."
            .into()
    }

    fn shortest_title(&self) -> String {
        "Donde es más corta".into()
    }

    fn determinant_title(&self) -> String {
        "Determinante".into()
    }

    fn several_determinants(&self, has_surplus: bool, directions: usize) -> String {
        let number = if directions == 3 { "tres" } else { "seis" };
        match has_surplus {
            true => format!(
                "Hay más articulaciones que direcciones: el brazo es singular donde son nulos los determinantes de todas las elecciones \
                 de {number} articulaciones."
            ),
            false => "Hay menos articulaciones que direcciones: el brazo es singular donde son nulos los determinantes de todas las \
                      elecciones de filas. Se omiten los que son nulos en todas partes."
                .into(),
        }
    }

    fn minor_of_joints(&self, joints: &[usize]) -> String {
        format!("Articulaciones {}:", plain(joints))
    }

    fn always_singular(&self, rank: usize, is_point: bool) -> String {
        let thing = if is_point { "al punto" } else { "al efector final" };
        format!(
            "El rango es como mucho {rank}: en todas las configuraciones le falta una dirección {thing}, y hay articulaciones que \
             pueden moverse mientras él está quieto. El rango es aún menor donde son nulos los determinantes de todas las elecciones de \
             {rank} filas y {rank} articulaciones. Se omiten los que son nulos en todas partes."
        )
    }

    fn minor_of_both(&self, rows: &[&str], joints: &[usize]) -> String {
        format!("Filas {}, articulaciones {}:", rows.join(", "), plain(joints))
    }

    fn minor_of_rows(&self, rows: &[&str]) -> String {
        format!("Filas {}:", rows.join(", "))
    }

    fn singularities_title(&self) -> String {
        "Singularidades".into()
    }

    fn no_singularity(&self, is_complete: bool, several: bool) -> String {
        match (is_complete, several) {
            (true, false) => "No hay: el determinante no se anula nunca.",
            (true, true) => "No hay: los determinantes no se anulan nunca todos a la vez.",
            (false, _) => {
                "Ningún factor que dependa de las articulaciones es común a todos los determinantes."
            }
        }
        .into()
    }

    fn besides(&self) -> String {
        "Además, el brazo es singular donde se anulan a la vez todos los determinantes anteriores.".into()
    }

    fn besides_where(&self) -> String {
        "Los determinantes se anulan también a la vez donde es nulo todo lo que figura en una de estas líneas, y en ningún otro sitio:".into()
    }

    fn point_title(&self) -> String {
        "Solo la posición".into()
    }

    fn point_alone(&self, at: Reference, axes: Reference) -> Line {
        let [at, axes] = [at, axes].map(|frame| self.of_frame(frame));
        Line::new(format!(
            "Arriba se considera el cuerpo con su orientación. La velocidad del origen {at} sola, según los ejes {axes}, ocupa tres filas:"
        ))
    }

    fn zeros(&self, all: Vec<Math>) -> Line {
        let mut line = Line::new("donde ");
        for (k, math) in all.into_iter().enumerate() {
            line = line.text(if k > 0 { " o " } else { "" }).math(math);
        }
        line
    }

    fn no_example(&self, assumes: bool) -> String {
        match assumes {
            true => "con las longitudes supuestas aquí no se ha encontrado ninguna configuración en la que se anule solo este factor",
            false => "no se ha encontrado ninguna configuración en la que se anule solo este factor",
        }
        .into()
    }

    fn place(&self, place: &Place) -> String {
        let numbers = |joints: &[usize]| self.numbers(joints);
        match place {
            Place::OneLine(i, j) => format!("los ejes {} y {} están sobre una misma recta", i + 1, j + 1),
            Place::OnePlane(axes) => {
                format!(
                    "los ejes paralelos {} están en un mismo plano: brazo extendido o plegado",
                    numbers(axes)
                )
            }
            Place::CentreOnAxis { wrist, axis } => {
                format!("el punto de corte de los ejes {} está sobre el eje {}", numbers(wrist), axis + 1)
            }
            Place::CentreInPlane { wrist, axes, parallel } => {
                let (wrist, axes) = (numbers(wrist), numbers(axes));
                let bent = if *parallel { ": brazo extendido o plegado" } else { "" };
                format!("el punto de corte de los ejes {wrist} está en el plano de los ejes {axes}{bent}")
            }
            Place::Parallel(axes) => format!("los ejes {} son paralelos", numbers(axes)),
            Place::Line { meets, parallel } => {
                let met = match &meets[..] {
                    [axis] => format!("al eje {}", axis + 1),
                    axes => format!("a los ejes {}", numbers(axes)),
                };
                let along = match &parallel[..] {
                    [] => String::new(),
                    [axis] => format!(" y es paralela al eje {}", axis + 1),
                    axes => format!(" y es paralela a los ejes {}", numbers(axes)),
                };
                format!("una recta corta {met}{along}")
            }
            Place::PointOnAxis(axis) => format!("el punto está sobre el eje {}", axis + 1),
            Place::PointInPlane { axes, parallel } => {
                let bent = if *parallel { ": brazo extendido o plegado" } else { "" };
                format!("el punto está en el plano de los ejes {}{bent}", numbers(axes))
            }
            Place::SelfMotion { joints, still } => match &joints[..] {
                [j] => format!("la articulación {} no mueve {}", j + 1, still_thing(*still)),
                joints => format!(
                    "las articulaciones {} tienen juntas velocidades con las que {} está en reposo",
                    numbers(joints),
                    still_thing(*still)
                ),
            },
            Place::Differs => "la disposición de los ejes varía de un lugar a otro".into(),
            Place::Lost => "las articulaciones que hay tienen una dirección menos".into(),
        }
    }

    fn lost(&self, loss: Loss) -> String {
        match loss {
            Loss::VelocityAlong(axis, frame) => {
                format!("se pierde: la velocidad según el eje {axis} {}", self.of_frame(frame))
            }
            Loss::RotationAbout(axis, frame) => {
                format!("se pierde: el giro en torno al eje {axis} {}", self.of_frame(frame))
            }
            Loss::Velocity => "se pierde: una velocidad del punto, en una dirección".into(),
            Loss::Rotation => "se pierde: un giro, en torno a una dirección".into(),
            Loss::Screw => "se pierde: un movimiento helicoidal (velocidad y giro juntos)".into(),
        }
    }

    fn gained(&self, gain: &Gain) -> String {
        match gain {
            Gain::Turns { joints: [i, j], is_same } => {
                let way = if *is_same { "en el mismo sentido" } else { "en sentidos opuestos" };
                let (i, j) = (i + 1, j + 1);
                format!("se gana: las articulaciones {i} y {j} giran {way} mientras el cuerpo está quieto")
            }
            Gain::Moves(joints, still) => {
                let all = plain(joints);
                let who = match joints.len() {
                    1 => format!("la articulación {all} se mueve"),
                    _ => format!("las articulaciones {all} se mueven"),
                };
                format!("se gana: en un primer instante, {who} mientras {} está quieto", still_thing(*still))
            }
        }
    }

    fn rates_title(&self) -> String {
        "Velocidades articulares para una velocidad del efector final".into()
    }

    fn rates(&self, blocks: Blocks) -> String {
        match blocks {
            Blocks::Point => "Las filas de la velocidad lineal dan las velocidades de las tres articulaciones.",
            Blocks::Rows => {
                "Las filas en las que quedan tantas articulaciones por hallar como filas hay dan esas articulaciones, un bloque tras otro. \
                 ux a rz son lo que las articulaciones anteriores dejan de vx a wz."
            }
            Blocks::Wrist => {
                "Las tres últimas articulaciones no mueven el punto: las filas de la velocidad lineal dan las velocidades de las tres \
                 primeras. rx, ry y rz son lo que estas dejan de la velocidad angular para las demás."
            }
        }
        .into()
    }

    fn different(&self, all: Vec<Math>) -> Line {
        Line::new("para ").list(all)
    }

    fn unknown_singularities(&self, why: &Obstacle) -> String {
        match why {
            Obstacle::TooLarge(why) => {
                format!("el determinante no está desarrollado: {}", self.unexpanded(*why))
            }
            Obstacle::ManyJoints(n) => {
                format!("{n} articulaciones son demasiadas: los menores se desarrollan hasta {MAX_JOINTS}")
            }
            Obstacle::AlwaysSingular(rank) => {
                format!("todas las configuraciones son singulares: el rango es como mucho {rank}")
            }
        }
    }

    fn motion(&self, all: Vec<Math>) -> Line {
        Line::new("en la proporción ").numbers(all, self.between())
    }

    fn values_missing(&self, parameters: Vec<Math>) -> Line {
        let has = if parameters.len() == 1 { " no tiene" } else { " no tienen" };
        Line::default()
            .list(parameters)
            .text(has)
            .text(" valor: no se han buscado configuraciones singulares numéricamente.")
    }

    fn found_singularities(&self, count: usize) -> String {
        match count {
            0 => "Ningún descenso del menor valor singular ha encontrado una configuración singular.",
            _ => {
                "Numéricamente, los descensos del menor valor singular llevan a estas configuraciones singulares, una de cada clase \
                 encontrada. Junto a cada una hay otras, y puede haber otras clases."
            }
        }
        .into()
    }
}

/// What stands still.
fn still_thing(still: Still) -> &'static str {
    match still {
        Still::Body => "el cuerpo",
        Still::Point => "el punto",
    }
}

/// Numbers from 0, shown from 1, with commas alone.
fn plain(joints: &[usize]) -> String {
    joints.iter().map(|j| (j + 1).to_string()).collect::<Vec<_>>().join(", ")
}
