//! La dynamique.

use super::{French, counted};
use crate::tree::{Line, Math};
use crate::words::{Dynamics, Terms};
use denavit::dynamics::{Gives, Ground, Minimality};
use denavit::geometry::NoBody;
use denavit_program::Count;

impl Dynamics for French {
    fn dynamics_title(&self, robot: &str) -> String {
        say!("Modèle dynamique : {robot}")
    }

    fn link_parameters(&self, has_other_frames: bool) -> String {
        let frames = match has_other_frames {
            true => {
                "du repère dont l’axe z est porté par l’axe du corps (ceux du tableau dans la convention de Khalil, et non \
                 ceux de celui-ci)"
            }
            false => "de son repère",
        };
        say!(
            "Le corps j a pour inertie XXj … ZZj (un tenseur : XYj est l’opposé du produit d’inertie), pour premiers moments MXj, MYj, MZj et pour \
             masse Mj, le tout par rapport à l’origine {frames}. qd et qdd sont les vitesses et les accélérations \
             articulaires."
        )
    }

    fn no_body(&self, why: NoBody) -> &'static str {
        match why {
            NoBody::NotFinite => "un nombre n’est pas fini",
            NoBody::NegativeMass => "sa masse est négative",
            NoBody::NoMass => "sa masse est nulle, et son premier moment ou son inertie ne l’est pas",
            NoBody::NotPositive => "son inertie par rapport au centre de masse n’est pas positive",
            NoBody::Triangle => "l’un de ses moments principaux dépasse la somme des deux autres",
        }
    }

    fn gravity_is(&self, components: [Math; 3]) -> Line {
        Line::new(say!("L’accélération de la pesanteur dans la base est ("))
            .numbers(components, self.between())
            .text(").")
    }

    fn base_title(&self) -> String {
        "Paramètres de base".into()
    }

    fn base_count(&self, all: usize, base: usize, minimality: Minimality) -> String {
        let of = counted(all, "paramètre", "paramètres");
        let rest = match minimality {
            Minimality::Proved => {
                "Il n’en faut pas moins : les colonnes correspondantes des couples sont démontrées indépendantes.".into()
            }
            Minimality::AtLeast(rank) => {
                format!("Il en faut peut-être moins : {rank} d’entre eux sont démontrés indépendants.")
            }
            Minimality::Unknown => "On n’a pas décidé si moins suffiraient.".to_string(),
        };
        let have = if base < 2 { "agit" } else { "agissent" };
        say!("Des {of} des corps, regroupés, {base} {have} sur les couples. {rest}")
    }

    fn kept(&self, all: Vec<Math>) -> Line {
        Line::new(say!("Comme demandé, ceux-ci représentent ce qui est regroupé avec eux : "))
            .list(all)
            .text(".")
    }

    fn dropped(&self, all: Vec<Math>) -> Line {
        Line::new(say!("Comme demandé, d’autres sont à la place de ")).list(all).text(".")
    }

    fn base_alone(&self, all: Vec<Math>) -> Line {
        Line::new(say!("tels quels : ")).list(all)
    }

    fn without_effect(&self, all: Vec<Math>) -> Line {
        Line::new(say!("sans effet sur les couples : ")).list(all)
    }

    fn torques_title(&self) -> String {
        "Couples".into()
    }

    fn torques_cost(&self, count: &Count, ground: Ground) -> String {
        let ground = match ground {
            Ground::Proved => "égalité avec les équations de Lagrange démontrée".into(),
            Ground::Modulo(states) => format!(
                "non démontré en général : exactement égal aux équations de Lagrange en {states} états aléatoires modulo un \
                 nombre premier de 61 bits"
            ),
            Ground::Numbers(states, off) => {
                format!("non démontré : égal aux équations de Lagrange à {off:.0e} près en {states} états")
            }
            Ground::Failed => "différent des équations de Lagrange : c’est un défaut du programme".into(),
        };
        say!("{} ; {ground}.", self.count(count))
    }

    fn with_friction(&self) -> String {
        "h comprend le frottement des articulations.".into()
    }

    fn divides_by(&self, all: Vec<Math>) -> Line {
        Line::new("Ce programme divise par ").list(all).text(", et vaut là où cela n’est pas nul.")
    }

    fn inertia_title(&self) -> String {
        "Matrice d’inertie".into()
    }

    fn velocity_torques_title(&self) -> String {
        "Couples centrifuges et de Coriolis".into()
    }

    fn gravity_torques_title(&self) -> String {
        "Couples de pesanteur".into()
    }

    fn bodies_title(&self) -> String {
        "Corps".into()
    }

    fn bodies(&self) -> String {
        say!(
            "Un corps est tout ce que meut un même axe. Son repère a son axe z porté par cet axe ; le repère 0 est la base. Ce qui est \
             constant entre deux axes et le mouvement du second donnent les matrices de passage :"
        )
    }

    fn grouping(&self) -> String {
        say!(
            "Une masse sur l’axe d’une liaison rotoïde est fixe dans les deux corps que la liaison réunit : les couples sont les mêmes, \
             que l’on la compte avec l’un ou avec l’autre. De l’extrémité vers la base, chaque corps cède au précédent tout ce qui peut y \
             être compté :"
        )
    }

    fn gives(&self, link: usize, gives: Gives) -> String {
        let k = link;
        let (to, taker) = match link {
            1 => ("à la base".to_string(), "la base".to_string()),
            _ => (format!("au corps {}", link - 1), format!("le corps {}", link - 1)),
        };
        match gives {
            Gives::OnAxis => say!(
                "le corps {k} tourne : il cède {to} M{k}, MZ{k} et YY{k} (comme second moment le long de son axe), et garde \
                 XX{k} − YY{k}, XY{k}, XZ{k}, YZ{k}, ZZ{k}, MX{k}, MY{k}, avec ce qu’il a reçu"
            ),
            Gives::Nothing => say!(
                "le corps {k} tourne, avec une masse par direction : il ne cède rien, et garde ce qu’il a reçu"
            ),
            Gives::Inertia => say!(
                "le corps {k} glisse : son inertie, qui tourne avec le précédent, est comptée avec lui ({taker}) ; il garde M{k}, MX{k}, \
                 MY{k}, MZ{k}, avec ce qu’il a reçu"
            ),
            Gives::Across => say!(
                "le corps {k} glisse : son inertie, qui tourne avec le précédent, est comptée avec lui ({taker}) ; il garde M{k}, MX{k}, \
                 MY{k}, MZ{k}, avec ce qu’il a reçu, sauf un premier moment le long de la direction de toutes les rotations qui le \
                 précèdent, qui n’a aucun effet"
            ),
            Gives::Plan => say!(
                "le corps {k} glisse le long de la direction de toutes les rotations qui le précèdent : {taker} prend tout, sauf sa masse \
                 le long de cette direction"
            ),
        }
    }

    fn outward_title(&self) -> String {
        "De la base vers l’outil : le mouvement des corps".into()
    }

    fn outward(&self) -> String {
        say!(
            "Dans le repère de chaque corps : w est sa vitesse angulaire, wd la dérivée de celle-ci, a l’accélération de l’origine du \
             repère moins celle de la pesanteur. R étant la rotation vers ce repère depuis celui du corps précédent, dont les valeurs ont \
             l’indice p, et r la position de son origine : w = R wp, wd = R wdp, a = R(ap + Up r) ; une liaison rotoïde ajoute z qd à \
             w, et z qdd + w × z qd (avec w d’avant) à wd ; une liaison prismatique ajoute z qdd + 2 w × z qd à a. \
             U = [wd]× + [w]×[w]× : un point du corps en r a l’accélération a + U r. Ce qui est nul, ou égal à une autre valeur, n’a pas de nom."
        )
    }

    fn link(&self, link: usize) -> String {
        format!("Corps {link}")
    }

    fn link_of_tree(&self, link: usize, joint: &str, parent: Option<usize>) -> String {
        match parent {
            Some(parent) => say!("Corps {link} : après l’articulation {joint}, sur le corps {parent}."),
            None => say!("Corps {link} : après l’articulation {joint}, sur la racine."),
        }
    }

    fn motion_ground(&self, ground: Ground) -> String {
        match ground {
            Ground::Proved => {
                say!("Démontré : w, wd et a sont ceux du produit des matrices de passage, par ses dérivées.")
            }
            Ground::Modulo(states) => say!(
                "Non démontré en général : w, wd et a sont exactement égaux aux dérivées du produit des matrices de passage en {states} \
                 états aléatoires modulo un nombre premier de 61 bits."
            ),
            Ground::Numbers(states, off) => say!(
                "Non démontré : w, wd et a sont les dérivées du produit des matrices de passage à {off:.0e} près en {states} états."
            ),
            Ground::Failed => {
                say!(
                    "Différents des dérivées du produit des matrices de passage : c’est un défaut du programme."
                )
            }
        }
    }

    fn inward_title(&self) -> String {
        "De l’outil vers la base : ce qui meut les corps".into()
    }

    fn inward(&self) -> String {
        say!(
            "De l’extrémité vers la base, par rapport à l’origine de chaque repère : f est la force et n le moment qui meuvent le corps et \
             tous ceux qui le suivent. Pour le corps seul, en paramètres de base, ce sont M a + U MS et J wd + w × J w + MS × a ; on \
             ajoute ce qui meut les corps suivants, ramené dans ce repère. Le couple d’une liaison rotoïde est le moment autour de son \
             axe z, l’effort d’une liaison prismatique la force le long de celui-ci."
        )
    }

    fn short_title(&self) -> String {
        "Programme court".into()
    }

    fn short(&self) -> String {
        say!(
            "La même récurrence a bien des formes : axes parallèles pris ensemble, mouvement et efforts d’un corps dans tel ou tel repère, \
             masse sur les axes comptée ici ou là, une longueur pour unité. La plus courte que la recherche ait trouvée, à la place de celle \
             d’avant (`--symbolic` l’écrit) :"
        )
    }
}
