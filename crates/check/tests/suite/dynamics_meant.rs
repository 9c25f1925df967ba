//! How formulas of dynamics are meant: what the document says of it, one meaning for one letter, special cases, and names that are no
//! quantities of dynamics. Short documents about a planar arm with two links, in pieces.

use denavit_check::{
    CheckOptions, Checked, Finding, Noted, ReadWith, Spoken, Standing, Unproved, Whereabouts, check,
};
use denavit_reading::document::Format;

const TABLE: &str = "# Two-link arm, dynamics\n\nStandard DH\n\n| i | theta | d | a | alpha |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | l1 | 0 |\n| 2 | θ2 | 0 | l2 | 0 |\n";

const POINTS: &str = "Point masses at the link ends, gravity acts along −y.";
const M: &str = r"$$M_{11} = m_1 l_1^2 + m_2(l_1^2 + l_2^2 + 2 l_1 l_2 c_2)$$

$$M_{12} = m_2 l_2^2 + m_2 l_1 l_2 c_2$$

$$M_{22} = m_2 l_2^2$$";
const INERTIAL_1: &str = r"(m_1+m_2) l_1^2 \ddot\theta_1 + m_2 l_2^2(\ddot\theta_1+\ddot\theta_2) + m_2 l_1 l_2 c_2 (2\ddot\theta_1+\ddot\theta_2)";
const CORIOLIS_1: &str = r"- m_2 l_1 l_2 s_2 (2\dot\theta_1\dot\theta_2+\dot\theta_2^2)";
const GRAVITY_1: &str = "+ (m_1+m_2) g l_1 c_1 + m_2 g l_2 c_{12}";
const TORQUE_2: &str = r"$$\tau_2 = m_2 l_2^2(\ddot\theta_1+\ddot\theta_2) + m_2 l_1 l_2 c_2 \ddot\theta_1 + m_2 l_1 l_2 s_2 \dot\theta_1^2 + m_2 g l_2 c_{12}$$";

fn checked(parts: &[&str]) -> Checked {
    let text = format!("{TABLE}\n{}\n", parts.join("\n\n"));
    check(&text, Format::of("a.md", &text), None, &CheckOptions::default())
        .unwrap_or_else(|e| panic!("{text}\n{e:?}"))
}

fn torque_1(parts: &[&str]) -> String {
    format!(r"$$\tau_1 = {}$$", parts.join(" "))
}

/// What is said of each claim, in order.
#[track_caller]
fn says(parts: &[&str], expected: &[Standing]) -> Checked {
    let all = checked(parts);
    let found: Vec<Standing> = all.claims.iter().map(denavit_check::Claim::standing).collect();
    let names: Vec<&str> = all.claims.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(found, expected, "{parts:?}\n{names:?}\n{:?}", all.unjudged);
    all
}

const RIGHT: Standing = Standing::Equal;
const WRONG: Standing = Standing::Wrong;
const OPEN: Standing = Standing::Undecided;

#[test]
fn torques_have_gravity_where_the_document_has_it() {
    let no_gravity = torque_1(&[INERTIAL_1, CORIOLIS_1]);
    says(&[POINTS, &no_gravity, TORQUE_2], &[WRONG, RIGHT]);
    says(&[POINTS, &torque_1(&[INERTIAL_1, GRAVITY_1]), TORQUE_2], &[WRONG, RIGHT]);
    // What is lost is more than a slip, and nothing else says where the first mass is.
    says(&[POINTS, &torque_1(&[INERTIAL_1]), TORQUE_2], &[OPEN, RIGHT]);
    // In a plane that lies flat there is none.
    let flat = TORQUE_2.replace(" + m_2 g l_2 c_{12}", "");
    says(&["The arm moves in a horizontal plane.", &no_gravity, &flat], &[RIGHT, RIGHT]);
}

#[test]
fn what_contradicts_the_words_about_gravity_is_open() {
    let torques = [torque_1(&[INERTIAL_1, CORIOLIS_1, GRAVITY_1]), TORQUE_2.to_string()];
    says(&[POINTS, &torques[0], &torques[1]], &[RIGHT, RIGHT]);
    // Upside down, in a plane that lies flat, and forgotten.
    says(&[&POINTS.replace('−', "+"), &torques[0], &torques[1]], &[OPEN, OPEN]);
    says(&["The arm moves in a horizontal plane.", &torques[0], &torques[1]], &[OPEN, OPEN]);
    let forgotten = [torque_1(&[INERTIAL_1, CORIOLIS_1]), TORQUE_2.replace(" + m_2 g l_2 c_{12}", "")];
    says(&[POINTS, &forgotten[0], &forgotten[1]], &[OPEN, OPEN]);
}

#[test]
fn a_letter_with_three_indices_has_one_meaning() {
    let right = [
        r"$$c_{121} = c_{211} = -m_2 l_1 l_2 s_2$$",
        r"$$c_{221} = -m_2 l_1 l_2 s_2$$",
        r"$$c_{112} = m_2 l_1 l_2 s_2$$",
        r"$$c_{122} = 0$$",
    ];
    says(&[M, right[0], right[1], right[2], right[3]], &[RIGHT; 7]);
    let wrong = [right[2].replace("= m", "= -m"), right[3].replace('0', "-m_2 l_1 l_2 s_2")];
    says(&[M, right[0], right[1], &wrong[0], &wrong[1]], &[RIGHT, RIGHT, RIGHT, RIGHT, RIGHT, WRONG, WRONG]);
}

#[test]
fn a_zero_is_of_the_kind_of_its_like() {
    let v1 = r"$$V_1 = -m_2 l_1 l_2 s_2(2\dot\theta_1\dot\theta_2 + \dot\theta_2^2)$$";
    says(&[POINTS, M, v1, "$$V_2 = 0$$"], &[RIGHT, RIGHT, RIGHT, RIGHT, WRONG]);
    let c = r"$$C_{11} = -m_2 l_1 l_2 s_2 \dot\theta_2, \quad C_{12} = -m_2 l_1 l_2 s_2(\dot\theta_1+\dot\theta_2), \quad C_{21} = m_2 l_1 l_2 s_2 \dot\theta_1, \quad C_{22} = 0$$";
    says(&[POINTS, M, c], &[RIGHT; 7]);
}

#[test]
fn helpers_are_what_they_are_where_they_are_used() {
    let matrix = r"$$C(q,\dot q) = \begin{bmatrix} h\dot\theta_2 & h(\dot\theta_1+\dot\theta_2) \\ -h\dot\theta_1 & 0 \end{bmatrix}$$";
    let h = "$$h = -m_2 l_1 l_2 s_2$$";
    let all = says(&[M, h, matrix, "and once more", "$$h = m_2 l_1 l_2 c_2$$"], &[RIGHT; 5]);
    assert_eq!(all.unjudged.len(), 1, "{:?}", all.unjudged);
    says(&[M, "$$h = -m_2 l_1 l_2 s_2 = -m_2 l_2 l_1 s_2$$", matrix], &[RIGHT; 5]);
    says(&[M, "$$h = -m_2 l_1 l_2 s_2 = -m_2 l_1 l_2 c_2$$", matrix], &[RIGHT, RIGHT, RIGHT, WRONG, RIGHT]);
}

#[test]
fn what_the_words_say_counts() {
    let sines = |s: &str| s.replace("c_1 ", "s_1 ").replace("c_{12}", "s_{12}");
    let torques = [torque_1(&[INERTIAL_1, CORIOLIS_1, &sines(GRAVITY_1)]), sines(TORQUE_2)];
    // Nothing says along what gravity acts.
    says(&["Point masses at the link ends.", &torques[0], &torques[1]], &[RIGHT, RIGHT]);
    says(&[POINTS, &torques[0], &torques[1]], &[OPEN, OPEN]);
    let about_joints = r"$$M_{11} = I_1 + I_2 + m_2 l_1^2 + 2 m_2 l_1 l_{c2} c_2$$

$$M_{12} = I_2 + m_2 l_1 l_{c2} c_2$$

$$M_{22} = I_2$$";
    let where_ = |about: &str| {
        format!("The inertias $I_1$, $I_2$ are those about {about}; $l_{{c1}}$, $l_{{c2}}$ from the joints.")
    };
    says(&[&where_("the joints"), about_joints], &[RIGHT; 3]);
    says(&[&where_("the centres of mass"), about_joints], &[OPEN; 3]);
}

/// A planar arm with centres of mass at `lc1` and `lc2` from the joints, inertias about them with these names, and `+ more` on the diagonal.
fn centres([lc1, lc2]: [&str; 2], inertias: Option<[&str; 2]>, more: &str) -> String {
    let [i1, i2] = inertias.map_or([String::new(), String::new()], |all| all.map(|i| format!("{i} + ")));
    format!(
        r"$$M_{{11}} = {i1}{i2}m_1 {lc1}^2 + m_2(l_1^2 + {lc2}^2 + 2 l_1 {lc2} c_2){more}$$

$$M_{{12}} = {i2}m_2 ({lc2}^2 + l_1 {lc2} c_2)$$

$$M_{{22}} = {i2}m_2 {lc2}^2{more}$$

$$g_1 = (m_1 {lc1} + m_2 l_1) g c_1 + m_2 g {lc2} c_{{12}}$$

$$g_2 = m_2 g {lc2} c_{{12}}$$"
    )
}

const OWN: [&str; 2] = ["l_{c1}", "l_{c2}"];
const INERTIAS: Option<[&str; 2]> = Some(["I_1", "I_2"]);

/// What is said to contradict formulas, of each that is open.
fn against(all: &Checked) -> Vec<Spoken> {
    let findings = all.claims.iter().flat_map(|c| &c.entries).map(|e| &e.finding);
    let spoken = |f: &Finding| match f {
        Finding::Undecided { why: Unproved::AgainstWords(of) } => Some(*of),
        _ => None,
    };
    findings.filter_map(spoken).collect()
}

fn read_with(all: &Checked) -> Vec<ReadWith> {
    let of = |what: &Noted| match what {
        Noted::ReadWith(all) => all.clone(),
        _ => vec![],
    };
    all.notes.iter().flat_map(|n| of(&n.what)).collect()
}

#[test]
fn what_contradicts_the_words_about_links_is_open() {
    let usual = centres(OWN, INERTIAS, "");
    let from = |words: &str| {
        format!("{words} $I_1$, $I_2$ are the inertias about the centres of mass. Gravity acts along −y.")
    };
    let joints = from("$l_{c1}$, $l_{c2}$ are the distances of the centres of mass from the joints.");
    let all = says(&[&joints, &usual], &[RIGHT; 5]);
    assert_eq!(read_with(&all), []);
    for ends in [
        "$l_{c1}$ is the distance of the centre of mass of link 1 from its far end (joint 2), $l_{c2}$ that of link 2 from the tip.",
        "The lengths $l_{ci}$ are measured from the distal end of each link to its centre of mass.",
        "$l_{ci}$: distance from joint $i+1$ to the centre of mass of link i.",
    ] {
        let all = says(&[&from(ends), &usual], &[OPEN; 5]);
        assert_eq!(against(&all), [Spoken::Centres; 5], "{ends}");
        // So measured they are right.
        let measured = centres(["(l_1 - l_{c1})", "(l_2 - l_{c2})"], INERTIAS, "");
        says(&[&from(ends), &measured], &[RIGHT; 5]);
    }
    // Names of the other link.
    let swapped = from(
        "$l_{c2}$ is the distance from joint 1 to the centre of mass of link 1, $l_{c1}$ from joint 2 to that of link 2.",
    );
    says(&[&swapped, &centres(["l_{c2}", "l_{c1}"], INERTIAS, "")], &[RIGHT; 5]);
    says(&[&swapped, &usual], &[OPEN; 5]);
}

#[test]
fn what_contradicts_the_words_about_points_and_inertias_is_open() {
    let [with, without] = [INERTIAS, None].map(|inertias| centres(OWN, inertias, ""));
    let points = "The links are point masses $m_1$, $m_2$ at the distances $l_{c1}$, $l_{c2}$ from the joints. Gravity acts along −y.";
    says(&[points, &without], &[RIGHT; 5]);
    let all = says(&[points, &with], &[OPEN, OPEN, OPEN, RIGHT, RIGHT]);
    assert_eq!(against(&all), [Spoken::Shape; 3]);
    for words in [
        "Link $i$ has the mass $m_i$, its centre of mass at $l_{ci}$ from joint $i$, and the inertia $I_i$ about its centre of mass. Gravity acts along −y.",
        "The links have masses $m_1$, $m_2$ and moments of inertia $I_1$, $I_2$. The centres of mass are at $l_{c1}$, $l_{c2}$ from the joints. Gravity acts along −y.",
    ] {
        says(&[words, &with], &[RIGHT; 5]);
        let all = says(&[words, &without], &[OPEN, OPEN, OPEN, RIGHT, RIGHT]);
        assert_eq!(against(&all), [Spoken::LeftOut; 3], "{words}");
    }
    let neglected = "The inertias $I_1$, $I_2$ are neglected, the centres of mass are at $l_{c1}$, $l_{c2}$ from the joints.";
    says(&[neglected, &without], &[RIGHT; 5]);
    // Rods.
    let rods = "The links are thin uniform rods. Gravity acts along −y.";
    let ends = centres(["l_1", "l_2"], None, "");
    says(&[rods, &ends], &[OPEN; 5]);
    says(&["Gravity acts along −y.", &ends], &[RIGHT; 5]);
}

#[test]
fn what_is_chosen_is_said() {
    let all = says(&["An arm.", &centres(OWN, INERTIAS, "")], &[RIGHT; 5]);
    let found = read_with(&all);
    let places =
        found.iter().filter(|r| matches!(r, ReadWith::Mass { at: Whereabouts::FromJoint(_), .. })).count();
    let inertias = found.iter().filter(|r| matches!(r, ReadWith::Inertia { is_at_joint: false, .. })).count();
    let gravity = found.iter().filter(|r| matches!(r, ReadWith::Gravity(_))).count();
    assert_eq!((places, inertias, gravity, found.len()), (2, 2, 1, 5), "{found:?}");
    // A name of which nothing is said takes the place of a rotor's inertia.
    let words = "$l_{c1}$, $l_{c2}$ are the distances of the centres of mass from the joints, $I_1$, $I_2$ the inertias about the centres of mass. Gravity acts along −y.";
    let all = says(&[words, &centres(OWN, INERTIAS, " + J_m")], &[RIGHT; 5]);
    let found = read_with(&all);
    assert!(
        matches!(&found[..], [ReadWith::Rotor { joint: 0, .. }, ReadWith::Rotor { joint: 1, .. }]),
        "{found:?}"
    );
    let named = format!("{words} $J_m$ is the inertia of each rotor.");
    assert_eq!(read_with(&says(&[&named, &centres(OWN, INERTIAS, " + J_m")], &[RIGHT; 5])), []);
    let ends = says(&["An arm.", &centres(["l_1", "l_2"], None, "")], &[RIGHT; 5]);
    let found = read_with(&ends);
    let is_end = |r: &&ReadWith| matches!(r, ReadWith::Mass { at: Whereabouts::End, .. });
    let points = found.iter().filter(|r| matches!(r, ReadWith::Point { .. })).count();
    assert_eq!((found.iter().filter(is_end).count(), points), (2, 2), "{found:?}");
}

#[test]
fn rotors_turn_their_own_joint_alone() {
    let m = r"$$M_{11} = (m_1+m_2) l_1^2 + m_2 l_2^2 + 2 m_2 l_1 l_2 c_2 + J_1$$

$$M_{12} = m_2 l_2^2 + m_2 l_1 l_2 c_2$$

$$M_{22} = m_2 l_2^2 + J_2$$";
    says(&["Point masses at the ends; $J_1$, $J_2$ are the rotors' inertias.", m], &[RIGHT; 3]);
    let named = m.replace("J_1", "J_{m1}").replace("J_2", "J_{m2}");
    says(&["Point masses at the ends.", &named], &[RIGHT; 3]);
    let both = r"$$M_{11} = I_1 + I_2 + J_1 + l_{c1}^{2} m_1 + m_2(l_1^2 + 2 l_1 l_{c2} c_2 + l_{c2}^2)$$

$$M_{12} = I_2 + l_{c2} m_2(l_1 c_2 + l_{c2})$$

$$M_{22} = I_2 + J_2 + l_{c2}^2 m_2$$

$$T = \frac{1}{2}(I_1 + J_1 + m_1 l_{c1}^2)\dot\theta_1^2 + \frac{1}{2} I_2 (\dot\theta_1 + \dot\theta_2)^2 + \frac{1}{2} J_2 \dot\theta_2^2 + \frac{1}{2} m_2 (l_1^2 \dot\theta_1^2 + l_{c2}^2 (\dot\theta_1 + \dot\theta_2)^2 + 2 l_1 l_{c2} c_2 \dot\theta_1 (\dot\theta_1 + \dot\theta_2))$$";
    says(&["", both], &[RIGHT; 4]);
    // Of a link it would turn with all joints before it.
    let twice = both.replace("+ J_1 + l_{c1}", "+ J_1 + J_2 + l_{c1}");
    let all = checked(&["", &twice]);
    assert_eq!(all.claims[0].standing(), WRONG);
}

#[test]
fn other_quantities_are_not_taken_for_these() {
    let c = r"$$C(q,\dot q) = \begin{bmatrix} -m_2 l_1 l_2 s_2\dot\theta_2 & -m_2 l_1 l_2 s_2(\dot\theta_1+\dot\theta_2) \\ m_2 l_1 l_2 s_2\dot\theta_1 & 0 \end{bmatrix}$$";
    for letter in ["N", "S"] {
        let skew = format!(
            r"The matrix ${letter} = \dot M - 2C$ is skew-symmetric:

$${letter} = \begin{{bmatrix}} 0 & m_2 l_1 l_2 s_2(2\dot\theta_1+\dot\theta_2) \\ -m_2 l_1 l_2 s_2(2\dot\theta_1+\dot\theta_2) & 0\end{{bmatrix}}$$"
        );
        let all = says(&[POINTS, M, c, &skew], &[RIGHT; 4]);
        assert!(!all.unjudged.is_empty());
    }
    let task = r"$$\Lambda = \begin{bmatrix} m_2 + \frac{m_1}{s_2^2} & 0 \\ 0 & m_2\end{bmatrix}$$";
    says(&[POINTS, M, task], &[RIGHT; 3]);
    let forces = r"$$F_2 = m_2 l_1 \ddot\theta_1 c_2 + m_2 l_2 (\ddot\theta_1 + \ddot\theta_2) + m_2 l_1 s_2 \dot\theta_1^2 + m_2 g c_{12}$$

$$f_1 = m_1 l_1 \ddot\theta_1 + m_1 g c_1$$";
    let all = checked(&[POINTS, &torque_1(&[INERTIAL_1, CORIOLIS_1, GRAVITY_1]), TORQUE_2, forces]);
    assert!(all.claims.iter().all(|c| c.standing() != WRONG));
    assert!(all.claims[..2].iter().all(denavit_check::Claim::is_proved));
}

#[test]
fn special_cases_are_not_called_wrong() {
    let whole = torque_1(&[INERTIAL_1, CORIOLIS_1, GRAVITY_1]);
    for (words, special) in [
        (
            "Neglecting the Coriolis and centrifugal terms, for slow motions",
            torque_1(&[INERTIAL_1, GRAVITY_1]),
        ),
        (
            "With joint 2 locked",
            torque_1(&[r"((m_1+m_2) l_1^2 + m_2 l_2^2 + 2 m_2 l_1 l_2 c_2) \ddot\theta_1", GRAVITY_1]),
        ),
        ("A controller that ignores the coupling", torque_1(&[r"m_1 l_1^2 \ddot\theta_1 + m_1 g l_1 c_1"])),
        (
            "If the first link is massless,",
            torque_1(&[
                &INERTIAL_1.replace("(m_1+m_2)", "m_2"),
                CORIOLIS_1,
                &GRAVITY_1.replace("(m_1+m_2)", "m_2"),
            ]),
        ),
    ] {
        says(&[POINTS, &whole, TORQUE_2, words, &special], &[RIGHT, RIGHT, OPEN]);
    }
    // Where the general formula is wrong, too.
    let wrong = whole.replace("2\\dot\\theta_1\\dot\\theta_2", "\\dot\\theta_1\\dot\\theta_2");
    let locked = torque_1(&[r"((m_1+m_2) l_1^2 + m_2 l_2^2 + 2 m_2 l_1 l_2 c_2) \ddot\theta_1", GRAVITY_1]);
    says(
        &[POINTS, &wrong, TORQUE_2, r"With the brake of joint 2 closed ($\dot\theta_2 = 0$)", &locked],
        &[WRONG, RIGHT, OPEN],
    );
    let line = format!(r"- Held ($\dot\theta_2 = 0$, $\ddot\theta_2 = 0$): {}", locked.replace("$$", "$"));
    let all = checked(&[POINTS, &wrong, TORQUE_2, &line]);
    let last = all.claims.iter().rfind(|c| c.name.contains("tau_1")).expect("a torque");
    assert_eq!(last.standing(), OPEN, "{:?}", last.entries);
    // What differs by a sign is a slip, wherever it stands.
    let slip = whole.replace("- m_2 l_1 l_2 s_2", "+ m_2 l_1 l_2 s_2");
    says(&[POINTS, &whole, TORQUE_2, "Again:", &slip], &[RIGHT, RIGHT, WRONG]);
    for (words, entry) in [
        (r"For $\theta_2 = 45°$", r"$$M_{12} = m_2 l_2^2 + \frac{\sqrt 2}{2} m_2 l_1 l_2$$"),
        (r"For $\theta_2 = 60°$", r"$$M_{11} = m_1 l_1^2 + m_2(l_1^2 + l_2^2 + l_1 l_2)$$"),
    ] {
        says(&[POINTS, M, words, entry], &[RIGHT, RIGHT, RIGHT, OPEN]);
    }
}

#[test]
fn documents_that_mention_dynamics_keep_their_kinematics() {
    let words = "For a later lecture on dynamics.\n\nsigma = θ1 + θ2\n\nx = l1 cos θ1 + l2 cos(sigma)\n\ny = l1 sin θ1 + l2 sin(sigma)\n";
    let all = checked(&[words]);
    let proved = all.claims.iter().filter(|c| c.is_proved()).count();
    assert!(proved >= 2, "{:?} {:?}", all.claims, all.unjudged);
    let matrices = r"$$M_1 = \begin{bmatrix} c_1 & -s_1 & 0 & l_1 c_1 \\ s_1 & c_1 & 0 & l_1 s_1 \\ 0&0&1&0\\0&0&0&1\end{bmatrix}$$

$$M_1 M_2 = \begin{bmatrix} c_{12} & -s_{12} & 0 & l_1 c_1 + l_2 c_{12} \\ s_{12} & c_{12} & 0 & l_1 s_1 + l_2 s_{12} \\ 0&0&1&0\\0&0&0&1\end{bmatrix}$$";
    let all = checked(&[matrices]);
    assert!(
        !all.claims.is_empty() && all.claims.iter().all(denavit_check::Claim::is_proved),
        "{:?}",
        all.unjudged
    );
}

/// A document with very many names for one thing has an answer soon, which says what was not tried.
#[test]
fn many_names_are_bounded() {
    let mut sum = String::new();
    for k in 1..=2 {
        for base in [
            "m", "M", "m_{G", "l_{", "l_{c", "l_{g", "L_{", "L_{c", "r_{", "r_{c", "I_{", "I_{c", "I_{G",
            "I_{o", "J_{", "J_{c", "J_{G",
        ] {
            let close = if base.contains('{') { "}" } else { "" };
            let bar = if close.is_empty() { "_" } else { "" };
            sum += &format!(r" + {base}{bar}{k}{close}\ddot\theta_1");
        }
    }
    let entries: String = (1..=2)
        .flat_map(|i| (1..=2).flat_map(move |j| (1..=2).map(move |k| (i, j, k))))
        .map(|(i, j, k)| format!("$$c_{{{i}{j}{k}}} = m_1 l_1^2 s_{j} c_{k} + I_2$$\n\n"))
        .collect();
    let all = checked(&[&format!(r"$$\tau_1 = a_1{sum}$$"), &entries]);
    assert!(all.claims.iter().all(|c| !c.is_proved()));
}

#[test]
fn entries_may_be_called_by_places_in_parentheses() {
    let text = r"M(q)q̈ + C(q,q̇)q̇ + g(q) = τ

M(1,1) = m1 l1^2 + m2 (l1^2 + l2^2 + 2 l1 l2 cos(θ2))
M(1,2) = M(2,1) = m2 l2^2 + m2 l1 l2 cos(θ2)
M(2,2) = m2 l2^2

C(1,1) = -m2 l1 l2 sin(θ2) θ̇2
C(1,2) = -m2 l1 l2 sin(θ2) (θ̇1 + θ̇2)
C(2,1) = m2 l1 l2 sin(θ2) θ̇1
C(2,2) = 0

g(1) = (m1 + m2) g l1 cos(θ1) + m2 g l2 cos(θ1 + θ2)
g(2) = m2 g l2 cos(θ1 + θ2)";
    let all = says(&[POINTS, text], &[RIGHT; 9]);
    assert!(all.unjudged.is_empty(), "{:?}", all.unjudged);
    let wrong = text.replace("g(2) = m2 g l2 cos", "g(2) = m2 g l2 sin");
    says(&[POINTS, &wrong], &[RIGHT, RIGHT, RIGHT, RIGHT, RIGHT, RIGHT, RIGHT, RIGHT, WRONG]);
    let matrices = r"$$M(q)\ddot q + C(q,\dot q)\dot q + g(q) = \tau$$

with $M(q) = \begin{bmatrix} M_{11} & M_{12} \\ M_{21} & M_{22} \end{bmatrix}$ and

- $M_{11} = m_1 l_1^2 + m_2(l_1^2 + l_2^2 + 2 l_1 l_2 c_2)$
- $M_{12} = M_{21} = m_2 l_2^2 + m_2 l_1 l_2 c_2$
- $M_{22} = m_2 l_2^2$";
    let all = checked(&[POINTS, matrices]);
    let is_proved = all.claims.len() > 3 && all.claims.iter().all(denavit_check::Claim::is_proved);
    assert!(is_proved && all.unjudged.is_empty(), "{:?} {:?}", all.claims, all.unjudged);
}

#[test]
fn torques_in_numbers_are_judged() {
    let formulas = r"$$g_1 = (m_1 + m_2) g l_1 c_1 + m_2 g l_2 c_{12}$$

$$g_2 = m_2 g l_2 c_{12}$$";
    let values = "l1 = 0.5 m, l2 = 0.4 m, m1 = 2 kg, m2 = 1 kg, g = 9.81 m/s^2.";
    // 9.81 (3 · 0.5 + 0.4) = 18.639, 9.81 · 0.4 = 3.924, 9.81 · 1.5 = 14.715
    let right = [
        "At q = (0, 0), at rest, the torques are 18.639 N m and 3.924 N m.",
        "For θ1 = 0, θ2 = 90° the torques that hold the arm are τ1 = 14.715 N m and τ2 = 0 N m.",
        "At θ1 = 0°, θ2 = 90° the torques are τ = (14.7, 0.0) N m.",
        r"Let q = (0, pi/2). Then the torques are $\tau_1 = 14.7\,\mathrm{N\,m}$ and $\tau_2 = 0\,\mathrm{N\,m}$.",
    ];
    let all = checked(&[POINTS, values, formulas, &right.join("\n\n")]);
    let standing: Vec<Standing> = all.claims.iter().map(denavit_check::Claim::standing).collect();
    assert_eq!(standing, [RIGHT; 8], "{:?}", all.claims);
    assert!(all.unjudged.is_empty(), "{:?}", all.unjudged);
    // A number that is another, in a state that is said with it; where it is said before it may be one of another state.
    says(&[POINTS, values, formulas, &right[0].replace("3.924", "4.924")], &[RIGHT, RIGHT, WRONG]);
    let other = "Let q = (0, pi/2). Then the torques are 18.639 N m and 3.924 N m.";
    says(&[POINTS, values, formulas, other], &[RIGHT, RIGHT, OPEN]);
    // What drives can do is none of these.
    for words in [
        "The torque limits are 20 N m and 10 N m.",
        "At q = (0, 0) torques of at most 30 N m and 20 N m are possible.",
    ] {
        says(&[POINTS, values, formulas, right[0], words], &[RIGHT, RIGHT, RIGHT]);
    }
}

/// Beside a torque of gravity for all angles another may be meant for one of them, where words say so.
#[test]
fn gravity_in_a_case_that_words_tell() {
    let of = |words: &str| {
        format!(
            "{TABLE}\nGravity acts along −y. Point masses m1, m2 at the ends of the links.\n\nG1 = (m1 + m2) g l1 cos θ1 + m2 g l2 cos(θ1 + θ2)\n\n\
             {words}\n\nG2 = m2 g l2 cos θ2\n"
        )
    };
    let standing = |words: &str| {
        let found = check(&of(words), Format::Markdown, None, &CheckOptions::default()).expect("a robot");
        found.claims.iter().find(|c| c.name == "G2").map(denavit_check::Claim::standing)
    };
    assert_eq!(standing("and below it"), Some(Standing::Wrong));
    for case in ["For θ1 = 0 only the second link counts:", "With the first link held level:"] {
        assert_ne!(standing(case), Some(Standing::Wrong), "{case}");
    }
}
