//! Jacobians and singularities.

use super::German;
use crate::tree::{Line, Math};
use crate::words::{Gain, Loss, Terms, Velocity};
use denavit::forward::{Proof, Reference};
use denavit::velocity::{Blocks, MAX_JOINTS, Obstacle, Place, Still};
use denavit_program::Count;
use denavit_symbolic::Refusal;

impl Velocity for German {
    fn jacobian_title(&self, robot: &str) -> String {
        format!("Jacobi-Matrix: {robot}")
    }

    fn viewpoint(&self, body: Reference, at: Reference, offset: Option<[Math; 3]>, axes: Reference) -> Line {
        let is_origin = body == at && offset.is_none();
        let [body, at, axes] = [body, at, axes].map(|frame| self.of_frame(frame));
        let mut line = Line::new(match is_origin {
            true => format!("Zuerst die Zeilen der Geschwindigkeit, und zwar des Ursprungs {at}"),
            false => format!(
                "Zuerst die Zeilen der Geschwindigkeit, und zwar des Punkts {body}, der im Ursprung {at}"
            ),
        });
        if let Some(offset) = offset {
            line = line.text(" plus (").numbers(offset, self.between()).text(")");
        }
        line = line.text(if is_origin { "" } else { " liegt" });
        line.text(format!(", dann die der Winkelgeschwindigkeit, in Komponenten längs der Achsen {axes}."))
    }

    fn no_entries(&self, why: Refusal) -> String {
        format!("Die Elemente sind nicht ausmultipliziert: {}.", self.unexpanded(why))
    }

    fn jacobian_cost(&self, count: &Count, proof: Proof) -> String {
        format!("{}; {}.", self.count(count), self.jacobian_proof(proof))
    }

    fn shortest(&self) -> String {
        "In diesem Koordinatensystem und für diesen Punkt ist die Matrix am kürzesten. Auf andere Achsen und auf einen anderen Punkt \
         desselben Körpers rechnet man mit einer Drehung und einem Hebelarm um; die Determinante bleibt dabei dieselbe."
            .into()
    }

    fn shortest_title(&self) -> String {
        "Wo sie am kürzesten ist".into()
    }

    fn determinant_title(&self) -> String {
        "Determinante".into()
    }

    fn several_determinants(&self, has_surplus: bool, directions: usize) -> String {
        let number = if directions == 3 { "drei" } else { "sechs" };
        match has_surplus {
            true => format!(
                "Es gibt mehr Gelenke als Richtungen: Der Arm ist singulär, wo die Determinanten zu jeder Auswahl von {number} \
                 Gelenken 0 sind."
            ),
            false => "Es gibt weniger Gelenke als Richtungen: Der Arm ist singulär, wo die Determinanten zu jeder Auswahl von \
                      Zeilen 0 sind. Solche, die überall 0 sind, werden nicht aufgeführt."
                .into(),
        }
    }

    fn minor_of_joints(&self, joints: &[usize]) -> String {
        format!("Gelenke {}:", plain(joints))
    }

    fn always_singular(&self, rank: usize, is_point: bool) -> String {
        let thing = if is_point { "dem Punkt" } else { "dem Endeffektor" };
        format!(
            "Der Rang ist höchstens {rank}: In jeder Stellung fehlt {thing} eine Richtung, und Gelenke können sich bewegen, \
             während er ruht. Noch kleiner ist der Rang, wo die Determinanten zu jeder Auswahl von {rank} Zeilen und {rank} Gelenken \
             0 sind. Solche, die überall 0 sind, werden nicht aufgeführt."
        )
    }

    fn minor_of_both(&self, rows: &[&str], joints: &[usize]) -> String {
        format!("Zeilen {}, Gelenke {}:", rows.join(", "), plain(joints))
    }

    fn minor_of_rows(&self, rows: &[&str]) -> String {
        format!("Zeilen {}:", rows.join(", "))
    }

    fn singularities_title(&self) -> String {
        "Singularitäten".into()
    }

    fn no_singularity(&self, is_complete: bool, several: bool) -> String {
        match (is_complete, several) {
            (true, false) => "Es gibt keine: Die Determinante wird nie 0.",
            (true, true) => "Es gibt keine: Die Determinanten werden nie alle zugleich 0.",
            (false, _) => "Kein Faktor, der von den Gelenken abhängt, ist allen Determinanten gemeinsam.",
        }
        .into()
    }

    fn besides(&self) -> String {
        "Außerdem ist der Arm singulär, wo alle obigen Determinanten zugleich 0 sind.".into()
    }

    fn besides_where(&self) -> String {
        "Zugleich 0 sind die Determinanten auch dort, wo alles 0 ist, was in einer dieser Zeilen steht, und sonst nirgends:".into()
    }

    fn point_title(&self) -> String {
        "Die Position allein".into()
    }

    fn point_alone(&self, at: Reference, axes: Reference) -> Line {
        let [at, axes] = [at, axes].map(|frame| self.of_frame(frame));
        Line::new(format!(
            "Oben wird der Körper mit seiner Orientierung betrachtet. Für die Geschwindigkeit des Ursprungs {at} allein, längs der \
             Achsen {axes}, bleiben drei Zeilen:"
        ))
    }

    fn zeros(&self, all: Vec<Math>) -> Line {
        let mut line = Line::new("wo ");
        for (k, math) in all.into_iter().enumerate() {
            line = line.text(if k > 0 { " oder " } else { "" }).math(math);
        }
        line
    }

    fn no_example(&self, assumes: bool) -> String {
        match assumes {
            true => "mit den hier angenommenen Längen wurde keine Stellung gefunden, in der nur dieser Faktor 0 ist",
            false => "es wurde keine Stellung gefunden, in der nur dieser Faktor 0 ist",
        }
        .into()
    }

    fn place(&self, place: &Place) -> String {
        let numbers = |joints: &[usize]| self.numbers(joints);
        match place {
            Place::OneLine(i, j) => format!("die Achsen {} und {} liegen auf einer Geraden", i + 1, j + 1),
            Place::OnePlane(axes) => {
                format!(
                    "die parallelen Achsen {} liegen in einer Ebene: gestreckt oder gefaltet",
                    numbers(axes)
                )
            }
            Place::CentreOnAxis { wrist, axis } => {
                format!("der Schnittpunkt der Achsen {} liegt auf Achse {}", numbers(wrist), axis + 1)
            }
            Place::CentreInPlane { wrist, axes, parallel } => {
                let (wrist, axes) = (numbers(wrist), numbers(axes));
                let bent = if *parallel { ": gestreckt oder gefaltet" } else { "" };
                format!("der Schnittpunkt der Achsen {wrist} liegt in der Ebene der Achsen {axes}{bent}")
            }
            Place::Parallel(axes) => format!("die Achsen {} sind parallel", numbers(axes)),
            Place::Line { meets, parallel } => {
                let met = match &meets[..] {
                    [axis] => format!("Achse {}", axis + 1),
                    axes => format!("die Achsen {}", numbers(axes)),
                };
                let along = match &parallel[..] {
                    [] => String::new(),
                    [axis] => format!(" und ist parallel zu Achse {}", axis + 1),
                    axes => format!(" und ist parallel zu den Achsen {}", numbers(axes)),
                };
                format!("eine Gerade schneidet {met}{along}")
            }
            Place::PointOnAxis(axis) => format!("der Punkt liegt auf Achse {}", axis + 1),
            Place::PointInPlane { axes, parallel } => {
                let bent = if *parallel { ": gestreckt oder gefaltet" } else { "" };
                format!("der Punkt liegt in der Ebene der Achsen {}{bent}", numbers(axes))
            }
            Place::SelfMotion { joints, still } => match &joints[..] {
                [j] => format!("Gelenk {} bewegt {} nicht", j + 1, still_thing(*still, true)),
                joints => format!(
                    "die Gelenke {} haben gemeinsam Geschwindigkeiten, bei denen {} ruht",
                    numbers(joints),
                    still_thing(*still, false)
                ),
            },
            Place::Differs => "wie die Achsen liegen, ist von Stelle zu Stelle verschieden".into(),
            Place::Lost => "die vorhandenen Gelenke haben eine Richtung weniger".into(),
        }
    }

    fn lost(&self, loss: Loss) -> String {
        match loss {
            Loss::VelocityAlong(axis, frame) => {
                format!("verloren: die Geschwindigkeit längs der {axis}-Achse {}", self.of_frame(frame))
            }
            Loss::RotationAbout(axis, frame) => {
                format!("verloren: die Drehung um die {axis}-Achse {}", self.of_frame(frame))
            }
            Loss::Velocity => "verloren: eine Geschwindigkeit des Punkts, in einer Richtung".into(),
            Loss::Rotation => "verloren: eine Drehung, um eine Richtung".into(),
            Loss::Screw => "verloren: eine Schraubung (Geschwindigkeit und Drehung zusammen)".into(),
        }
    }

    fn gained(&self, gain: &Gain) -> String {
        match gain {
            Gain::Turns { joints: [i, j], is_same } => {
                let way = if *is_same { "gleichsinnig" } else { "gegeneinander" };
                let (i, j) = (i + 1, j + 1);
                format!("gewonnen: die Gelenke {i} und {j} drehen sich {way}, während der Körper ruht")
            }
            Gain::Moves(joints, still) => {
                let all = plain(joints);
                let who = match joints.len() {
                    1 => format!("Gelenk {all} bewegt sich"),
                    _ => format!("die Gelenke {all} bewegen sich"),
                };
                format!("gewonnen: {who} im ersten Augenblick, während {} ruht", still_thing(*still, false))
            }
        }
    }

    fn rates_title(&self) -> String {
        "Gelenkgeschwindigkeiten zu einer Geschwindigkeit des Endeffektors".into()
    }

    fn rates(&self, blocks: Blocks) -> String {
        match blocks {
            Blocks::Point => "Die Zeilen der Geschwindigkeit ergeben die Geschwindigkeiten der drei Gelenke.",
            Blocks::Rows => {
                "Zeilen, in denen so viele Gelenke unbekannt sind, wie es Zeilen sind, ergeben diese Gelenke, ein Block nach dem \
                 anderen. ux bis rz sind, was die Gelenke davor von vx bis wz übrig lassen."
            }
            Blocks::Wrist => {
                "Die letzten drei Gelenke bewegen den Punkt nicht: Die Zeilen der Geschwindigkeit ergeben die ersten drei \
                 Gelenkgeschwindigkeiten. rx, ry und rz sind, was diese von der Winkelgeschwindigkeit für die anderen übrig lassen."
            }
        }
        .into()
    }

    fn different(&self, all: Vec<Math>) -> Line {
        Line::new("für ").list(all)
    }

    fn unknown_singularities(&self, why: &Obstacle) -> String {
        match why {
            Obstacle::TooLarge(why) => {
                format!("die Determinante ist nicht ausmultipliziert: {}", self.unexpanded(*why))
            }
            Obstacle::ManyJoints(n) => {
                format!("{n} Gelenke sind zu viele: Minoren werden bis {MAX_JOINTS} Gelenke ausmultipliziert")
            }
            Obstacle::AlwaysSingular(rank) => {
                format!("jede Stellung ist singulär: der Rang ist höchstens {rank}")
            }
        }
    }

    fn motion(&self, all: Vec<Math>) -> Line {
        Line::new("im Verhältnis ").numbers(all, self.between())
    }

    fn values_missing(&self, parameters: Vec<Math>) -> Line {
        let has = if parameters.len() == 1 { " hat" } else { " haben" };
        Line::default()
            .list(parameters)
            .text(has)
            .text(" keinen Wert: Nach singulären Stellungen wurde nicht numerisch gesucht.")
    }

    fn found_singularities(&self, count: usize) -> String {
        match count {
            0 => "Ein Abstieg des kleinsten Singulärwerts hat von keinem Start aus eine singuläre Stellung gefunden.",
            _ => {
                "Numerisch führte der Abstieg des kleinsten Singulärwerts zu diesen singulären Stellungen, je einer von jeder Art, die \
                 gefunden wurde. Neben jeder gibt es weitere, und es kann weitere Arten geben."
            }
        }
        .into()
    }
}

/// What stands still.
fn still_thing(still: Still, is_object: bool) -> &'static str {
    match (still, is_object) {
        (Still::Body, false) => "der Körper",
        (Still::Body, true) => "den Körper",
        (Still::Point, false) => "der Punkt",
        (Still::Point, true) => "den Punkt",
    }
}

/// Numbers from 0, shown from 1, with commas alone.
fn plain(joints: &[usize]) -> String {
    joints.iter().map(|j| (j + 1).to_string()).collect::<Vec<_>>().join(", ")
}
