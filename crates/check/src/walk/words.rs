//! Words by which documents give joints and lengths their values.

/// Words between a value and the next name.
pub(super) const JOINTS: [&str; 8] = [" and ", " und ", " et ", " y ", " e ", " en ", " with ", " mit "];
/// Words before a list of lengths, of joint values, of joint rates.
pub(super) const LENGTHS: [&str; 8] = [
    "lengths",
    "längen",
    "longueurs",
    "longitudes",
    "lunghezze",
    "link length",
    "gliedlängen",
    "comprimentos",
];
pub(super) const VALUES: [&str; 6] = [
    "joint angles",
    "joint values",
    "gelenkwinkel",
    "angles articulaires",
    "ángulos articulares",
    "configuration",
];
pub(super) const RATES: [&str; 8] = [
    "joint rates",
    "joint velocities",
    "joint speeds",
    "gelenkgeschwindigkeiten",
    "vitesses articulaires",
    "velocidades articulares",
    "velocità di giunto",
    "rates of the joints",
];

/// Words that put all joints to zero.
const ZERO: [&str; 44] = [
    "alle gelenke auf 0",
    "alle gelenke 0",
    "alle winkel auf 0",
    "alle winkel null",
    "alle gelenkwinkel null",
    "all joints 0",
    "all joints equal to zero",
    "all joints equal to 0",
    "all angles at 0",
    "all joint values zero",
    "tutti i giunti a zero",
    "tutti i giunti a 0",
    "tutti gli angoli nulli",
    "todas as juntas em zero",
    "todas as juntas em 0",
    "todas las articulaciones en 0",
    "todas las articulaciones a 0",
    "toutes les articulations à 0",
    "toutes les variables nulles",
    "toutes les variables articulaires nulles",
    "in der nullstellung",
    "in nullstellung",
    "in the zero position",
    "in the zero configuration",
    "at the zero configuration",
    "at the zero position",
    "in its zero position",
    "all joints at 0",
    "dans la configuration zéro",
    "en la posición cero",
    "nella posizione zero",
    "na posição zero",
    "all joints zero",
    "all joints at zero",
    "all joints are zero",
    "all joint variables zero",
    "all joint angles zero",
    "all angles zero",
    "alle gelenke null",
    "alle gelenke auf null",
    "tous les joints à zéro",
    "toutes les articulations à zéro",
    "todas las articulaciones en cero",
    "todas las articulaciones a cero",
];

/// Words that put the joints to zero to which a sentence gives no value.
const REST: [&str; 22] = [
    "sonst 0",
    "sonst null",
    "übrigen 0",
    "übrigen null",
    "übrigen gelenke 0",
    "übrigen gelenke null",
    "others 0",
    "others zero",
    "others at 0",
    "others at zero",
    "others being 0",
    "rest 0",
    "rest zero",
    "rest at zero",
    "autres à 0",
    "autres à zéro",
    "autres nuls",
    "autres nulles",
    "gli altri a zero",
    "gli altri nulli",
    "los demás a cero",
    "los demás nulos",
];

/// Words for the configuration that stands further up.
pub(super) const SAME: [&str; 26] = [
    "zahlenwerten aus a",
    "zahlenwerten aus teil",
    "zahlenwerte aus a",
    "zahlenwerte aus teil",
    "values of part",
    "values from part",
    "numbers of part",
    "numbers from part",
    "valeurs de la question",
    "same configuration",
    "same posture",
    "configuration of part",
    "configuration of (",
    "configuration above",
    "posture of part",
    "posture of (",
    "posture above",
    "derselben stellung",
    "derselben konfiguration",
    "gleichen stellung",
    "gleichen konfiguration",
    "même configuration",
    "configuration du ",
    "misma configuración",
    "misma postura",
    "stessa configurazione",
];

/// Words for a configuration of their own, which is not the one that stands further up.
pub(super) const WORST: [&str; 10] = [
    "worst case",
    "worst position",
    "worst posture",
    "ungünstigst",
    "schlimmst",
    "plus défavorable",
    "peor caso",
    "caso peggiore",
    "pior caso",
    "najgorsz",
];

/// Words for nothing, those for all of the joints, and those for the ones that have no value yet.
const NOTHING: [&str; 11] =
    ["zero", "0", "0°", "null", "zéro", "cero", "nulle", "nuls", "nulles", "nulli", "nul"];
const ALL: [&str; 9] = ["all", "alle", "tous", "toutes", "todos", "todas", "tutti", "tutte", "every"];
const OTHERS: [&str; 14] = [
    "others",
    "other",
    "rest",
    "remaining",
    "übrigen",
    "anderen",
    "restlichen",
    "autres",
    "altri",
    "demás",
    "demais",
    "outros",
    "outras",
    "overige",
];
/// How the words for joints begin.
const JOINT_WORDS: [&str; 13] = [
    "joint",
    "gelenk",
    "angle",
    "winkel",
    "articul",
    "giunt",
    "junta",
    "servo",
    "ax",
    "achse",
    "motor",
    "variab",
    "scharnier",
];
/// So many words stand between them at most.
const BETWEEN: usize = 5;

/// True if words, in small letters, put all joints to zero, or those to which their sentence gives no value.
pub(super) fn puts_to_zero(lower: &str) -> bool {
    if ZERO.iter().chain(&REST).any(|words| lower.contains(words)) {
        return true;
    }
    let words: Vec<&str> = lower.split_whitespace().collect();
    let begins = |at: usize, all: &[&str]| all.contains(&words[at].trim_matches(['(', ',', ';', '*']));
    (0..words.len()).filter(|&at| begins(at, &ALL) || begins(at, &OTHERS)).any(|at| {
        let rest = &words[at + 1..words.len().min(at + 2 + BETWEEN)];
        let bare = |w: &&str| w.trim_end_matches([',', ';', ':', '.', ')']).to_string();
        let Some(end) = rest.iter().position(|w| NOTHING.contains(&bare(w).as_str())) else { return false };
        let between = &rest[..end];
        let is_word = |w: &&str| w.chars().all(|c| c.is_alphabetic() || c == '\'');
        let is_joint = between.iter().any(|w| JOINT_WORDS.iter().any(|j| w.starts_with(j)));
        between.iter().all(is_word) && (is_joint || begins(at, &OTHERS))
    })
}
