//! `fk` of closed loops that are no serial chain: the passive joints and the pose, in every assembly mode.

use super::{plural, value, warn_of_limits};
use crate::arguments::FkArguments;
use crate::failure::Failure;
use crate::load;
use crate::terminal::{Align, HEADING, NAME, matrix, noise, note, number, styled, table};
use denavit::closure::{Assembly, Loops, Open};
use denavit::description::linkage::spherical::type_2;
use denavit::description::linkage::{Dyad, Linkage, Mode, Plan, Step, Unsolved, Vectors};
use denavit::description::{Convention, JointKind};
use denavit::geometry::Transform;
use denavit::quantity::reading;
use denavit::space::JointSpace;
use denavit_report::document::plain;
use denavit_report::words::Tongue;
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Symbol, readable};
use denavit_wire::Schema;
use denavit_wire::linkage::{Assembled, Assemblies};
use std::io::Write;

/// Answers for a linkage.
///
/// # Errors
/// If the configuration cannot be read, a length has no value, no assembly closes, or nothing can be written.
pub fn run(arguments: &FkArguments, linkage: &Linkage) -> Result<(), Failure> {
    let given = [
        (arguments.input.is_some(), "--input"),
        (arguments.frames.is_some(), "--frames"),
        (arguments.orientation.is_some(), "--orientation"),
    ];
    if let Some((_, option)) = given.into_iter().find(|g| g.0) {
        return Err(Failure::Unsupported(format!("{option} for closed loops that are no serial chain")));
    }
    let mut out = anstream::stdout();
    if arguments.symbolic && arguments.json {
        return Err(Failure::Unsupported(
            "--symbolic --json for closed loops that are no serial chain".into(),
        ));
    }
    if arguments.symbolic {
        write!(out, "{}", formulas(linkage, arguments.robot.tip.as_deref())?)?;
        return Ok(());
    }
    let loops = load::loops(&arguments.robot, linkage)?;
    let q = configuration(linkage, arguments.q.as_deref())?;
    let (name, place) =
        loops.place(arguments.robot.tip.as_deref()).map_err(|why| Failure::Usage(why.to_string()))?;
    let found = assemblies(&loops, arguments.robot.mode.as_deref(), &q)?;
    let all = &found.all;
    warn(linkage, &q, all);
    let poses: Vec<Transform<f64>> = all.iter().map(|a| loops.pose(&place, &q, &a.passive)).collect();
    if arguments.json {
        let answer = Assemblies {
            assemblies: all.iter().zip(&poses).map(|(a, pose)| Assembled::of(a, pose)).collect(),
            frame: &name,
            joints: &q,
            modes: found.modes,
            robot: &linkage.tree.name,
            schema: Schema,
            tried: found.tried,
            undecided: found.undecided.iter().map(Mode::to_string).collect(),
        };
        writeln!(out, "{}", denavit_wire::text(&answer))?;
        return Ok(());
    }
    let mut text = format!("{} at {}: ", styled(&linkage.tree.name, HEADING), at(linkage, &q));
    text += &format!(
        "{}\n\n{}",
        plural(all.len(), "assembly").replace("assemblys", "assemblies"),
        passives(linkage, all)
    );
    for a in all.iter().filter(|a| !a.flat.is_empty()) {
        let names: Vec<String> = a.flat.iter().map(|&k| linkage.loop_name(k)).collect();
        text += &format!("  {}: another mode meets it here ({})\n", mode_of(a), names.join(", "));
    }
    let rounding = noise(&poses);
    for (a, pose) in all.iter().zip(&poses) {
        let row = |row: &[f64; 4]| {
            row.iter().enumerate().map(|(c, &e)| number(e, if c == 3 { rounding } else { 1e-14 })).collect()
        };
        let entries: Vec<Vec<String>> = pose.matrix().iter().map(row).collect();
        let label = format!("{} T(base → {name}) = ", a.mode);
        text += &format!("\n{}", matrix(label.trim_start(), &entries, Align::Right));
    }
    write!(out, "{text}")?;
    Ok(())
}

fn mode_of(a: &Assembly) -> String {
    styled(&a.mode.to_string(), NAME)
}

/// The joints with their limits, the driven ones first.
pub fn limited(linkage: &Linkage) -> Vec<(String, JointKind, Option<[f64; 2]>)> {
    let rows = linkage.all_rows();
    let known: Vec<_> = rows.variables().into_iter().zip(JointSpace::without_lengths(&rows).limits).collect();
    let limits = |s: Symbol| known.iter().find(|k| k.0.symbol == s).and_then(|k| k.1);
    let all = linkage.driven().into_iter().chain(linkage.passive());
    all.map(|v| (v.symbol.name().to_string(), v.kind, limits(v.symbol))).collect()
}

/// Says which joints are beyond their limits: driven ones, and of each assembly passive ones.
pub fn warn(linkage: &Linkage, q: &[f64], all: &[Assembly]) {
    let limited = limited(linkage);
    let (driven, passive) = limited.split_at(q.len());
    for ((name, kind, limits), &x) in driven.iter().zip(q) {
        warn_of_limits(name, *kind, *limits, x);
    }
    for a in all {
        for ((name, kind, limits), &x) in passive.iter().zip(&a.passive) {
            let name = match a.mode.to_string().as_str() {
                "" => name.clone(),
                mode => format!("mode {mode}: {name}"),
            };
            warn_of_limits(&name, *kind, *limits, x);
        }
    }
}

/// Where the driven joints are.
pub fn at(linkage: &Linkage, q: &[f64]) -> String {
    let driven = linkage.driven();
    let one = driven.iter().zip(q).map(|(v, &x)| format!("{} = {}", v.symbol.name(), reading(x, v.kind)));
    one.collect::<Vec<_>>().join(", ")
}

/// The passive joints of assemblies, a line each.
pub fn passives(linkage: &Linkage, all: &[Assembly]) -> String {
    let passive = linkage.passive();
    let names: Vec<String> = passive.iter().map(|v| v.symbol.name().to_string()).collect();
    let mut header = vec!["mode"];
    header.extend(names.iter().map(String::as_str));
    header.push("residual");
    let mut align = vec![Align::Right; header.len()];
    align[0] = Align::Left;
    let row = |a: &Assembly| {
        let values = a.passive.iter().zip(&passive).map(|(&x, v)| reading(x, v.kind));
        [vec![a.mode.to_string()], values.collect(), vec![format!("{:.0e}", a.residual)]].concat()
    };
    table(&header, &align, &all.iter().map(row).collect::<Vec<_>>())
}

/// The assemblies of the modes that were asked for.
pub struct Found {
    /// In the order of their modes.
    pub all: Vec<Assembly>,
    /// How many modes there are, and how many of them were tried.
    modes: usize,
    tried: usize,
    /// Those that are neither closed nor open.
    undecided: Vec<Mode>,
}

/// The assembly of the mode that is asked for, or all that close; what may be missing is said.
///
/// # Errors
/// If there is no such mode, or nothing closes.
pub fn assemblies(loops: &Loops, mode: Option<&str>, q: &[f64]) -> Result<Found, Failure> {
    if let Some(text) = mode {
        let mode = loops.mode(Some(text)).map_err(|why| Failure::Usage(format!("--mode: {why}")))?;
        let all = vec![loops.assembly(q, &mode).map_err(|why| open(loops, &why))?];
        return Ok(Found { all, modes: 1, tried: 1, undecided: vec![] });
    }
    let outcomes = loops.tried(q);
    let (modes, tried) = (loops.plan().count(), outcomes.len());
    if modes > tried {
        note(&format!(
            "warning: {modes} assembly modes: the first {tried} were tried; --mode asks for another"
        ));
    }
    let (mut all, mut undecided) = (vec![], vec![]);
    for (mode, outcome) in outcomes {
        match outcome {
            Ok(assembly) => all.push(assembly),
            Err(why @ (Open::Indeterminate { .. } | Open::NotFound | Open::Undecided { .. })) => {
                note(&format!("note: mode {mode}: {}", open_words(loops, &why)));
                undecided.push(mode);
            }
            Err(_) => {}
        }
    }
    if all.iter().any(|a| a.is_numeric) {
        note("note: found by Newton's method: there may be other assemblies");
    }
    if all.is_empty() {
        let usual = loops.plan().usual();
        return Err(loops
            .assembly(q, &usual)
            .map_or_else(|why| open(loops, &why), |_| Failure::No("no assembly closes here".into())));
    }
    Ok(Found { all, modes, tried, undecided })
}

fn open(loops: &Loops, why: &Open) -> Failure {
    Failure::No(open_words(loops, why))
}

/// Why no assembly closes.
fn open_words(loops: &Loops, why: &Open) -> String {
    let name = |closure: usize| loops.linkage().loop_name(closure);
    match why {
        Open::Gap { closure, metres } => {
            let far = metres
                .map_or(String::new(), |m| format!(": it is open by {}", reading(m, JointKind::Prismatic)));
            format!("`{}` does not close here{far}", name(*closure))
        }
        Open::Indeterminate { closure } => format!(
            "`{}` is closed here by infinitely many configurations, or by none: the two places between which its rods stand coincide",
            name(*closure)
        ),
        Open::Undecided { closure } => format!(
            "modes of another loop meet here, where it is not known well enough whether `{}` closes",
            name(*closure)
        ),
        Open::NotFound => "Newton's method found no configuration in which all loops close".into(),
        Open::Contradicts { closure, gap } => {
            format!(
                "`{}` does not close here with what the other loops say: it is open by {gap:.3e}",
                name(*closure)
            )
        }
    }
}

/// The driven joints: a pose of the file, values of all, or some by name, the others at 0.
///
/// # Errors
/// If they cannot be read.
pub fn configuration(linkage: &Linkage, text: Option<&str>) -> Result<Vec<f64>, Failure> {
    let driven = linkage.driven();
    let bad = |why: String| Failure::Usage(format!("-q: {why}"));
    let names = || driven.iter().map(|v| v.symbol.name().to_string()).collect::<Vec<_>>().join(", ");
    let Some(text) = text else {
        return Err(Failure::Usage(format!(
            "say where the driven joints are: -q with {} ({}); or --symbolic for formulas",
            plural(driven.len(), "value"),
            names()
        )));
    };
    if let Some((_, q)) = linkage.poses.iter().find(|p| p.0 == text.trim()) {
        return q.iter().map(|e| value(*e).map_err(bad)).collect();
    }
    let parts = load::list(text);
    let one = |k: usize, text: &str| {
        let read = load::value_of(text, driven[k].kind.into()).and_then(value);
        read.map_err(|why| bad(format!("{}: {why}", driven[k].symbol.name())))
    };
    if text.contains('=') {
        let mut q = vec![None; driven.len()];
        for part in parts {
            let (name, text) =
                part.split_once('=').ok_or_else(|| bad(format!("`{part}`: write NAME=VALUE")))?;
            let row = linkage.tree.rows.iter().find(|r| r.name.as_deref() == Some(name.trim()));
            let symbol = row.and_then(|r| r.variable).map_or(Symbol::new(name.trim()), |v| v.symbol);
            let k = driven.iter().position(|v| v.symbol == symbol);
            let k =
                k.ok_or_else(|| bad(format!("no driven joint `{}`; there are {}", name.trim(), names())))?;
            if q[k].replace(one(k, text.trim())?).is_some() {
                return Err(bad(format!("{} is given twice", driven[k].symbol.name())));
            }
        }
        return Ok(q.into_iter().map(Option::unwrap_or_default).collect());
    }
    if parts.len() != driven.len() {
        let (given, wanted) = (plural(parts.len(), "value"), plural(driven.len(), "driven joint"));
        return Err(bad(format!("{given} given, the robot has {wanted} ({})", names())));
    }
    parts.iter().enumerate().map(|(k, text)| one(k, text)).collect()
}

fn shown(e: Expr, is_angle: bool) -> String {
    plain(&denavit_report::cell(readable::settled(e), is_angle, Tongue::English.words()), &Vocabulary::new())
}

fn vector(v: &Vectors) -> String {
    let sum = v.formula();
    format!("({}, {})", shown(sum.re, false), shown(sum.im, false))
}

/// The steps by which the passive joints are found, and the pose of the tip in driven and passive joints.
fn formulas(linkage: &Linkage, tip: Option<&str>) -> Result<String, Failure> {
    let plan = Plan::of(linkage);
    let mut text = format!("{}\n", styled(&linkage.tree.name, HEADING));
    for (k, step) in plan.steps.iter().enumerate() {
        text += &format!("\n{}. {}\n", k + 1, styled(&linkage.loop_name(step.closure), NAME));
        text += &step_text(step);
    }
    for (closure, why) in &plan.unsolved {
        let why = unsolved(why);
        text += &format!("\n{}: no closed form here ({why}); Newton's method\n", linkage.loop_name(*closure));
    }
    let (name, rows, end) = linkage.way(tip).map_err(|why| Failure::Usage(why.to_string()))?;
    let screws = rows.iter().flat_map(|&j| linkage.tree.rows[j].screws(Convention::Khalil));
    let pose = screws.fold(linkage.tree.base, |x, screw| x * screw.transform()) * end;
    let symbols: Vec<Symbol> = linkage.driven().iter().chain(&linkage.passive()).map(|v| v.symbol).collect();
    text += &format!("\nT(base → {name})\n\n");
    for (i, row) in pose.matrix()[..3].iter().enumerate() {
        for (j, &e) in row.iter().enumerate() {
            let e = readable::simplify(e, &symbols).map_or(e, |s| s.expr);
            text += &format!("  t{}{} = {}\n", i + 1, j + 1, shown(e, false));
        }
    }
    if plan.steps.iter().any(|s| !matches!(s.dyad, Dyad::Spherical(_))) {
        text += "\n  the forms of planar dyads are proved for all lengths and angles; e(φ) = (cos φ, sin φ), vectors multiply as complex numbers\n";
    }
    Ok(text)
}

/// Why a loop has no closed form here.
pub fn unsolved(why: &Unsolved) -> String {
    match why {
        Unsolved::NotPlanar(_) => "not planar".into(),
        Unsolved::Determined => "nothing of it is unknown".into(),
        Unsolved::Unknowns(all) => {
            let names: Vec<String> = all.iter().map(|s| s.name().to_string()).collect();
            format!("{} unknown at once", names.join(", "))
        }
    }
}

/// What a dyad is called: its three joints.
pub fn dyad_name(step: &Step) -> &'static str {
    match step.dyad {
        Dyad::Turns { .. } => "R R R",
        Dyad::Slide { .. } => "R R P",
        Dyad::Cylinder { .. } => "R P R",
        Dyad::Slides { .. } => "R P P",
        Dyad::Spherical(_) => "R R R",
    }
}

fn step_text(step: &Step) -> String {
    let mut text = String::new();
    let mut line = |what: &str| text += &format!("  {what}\n");
    let turn = shown(step.turn.to_expr(), true);
    match &step.dyad {
        Dyad::Spherical(between) => {
            line("Rz(α)·K1·Rz(β)·K2·Rz(γ)·K3 = 1: A·cos β + B·sin β = D, h = ±√(A² + B² − D²)");
            let [a, b, d] = type_2(&between.0).map(|e| shown(e, false));
            line(&format!("A = {a}, B = {b}, D = {d}"));
            line(
                "cos β = (AD − Bh)/(A² + B²), sin β = (BD + Ah)/(A² + B²); γ and α from the third row and column",
            );
            let names = ["α", "β", "γ"];
            for sum in &step.angles {
                let (k, sign) =
                    (0..3).find_map(|k| Some((k, sum.of[k])).filter(|f| f.1 != 0)).unwrap_or((0, 1));
                line(&format!("{} = {}{}", sum.symbol.name(), if sign < 0 { "−" } else { "" }, names[k]));
            }
            return text;
        }
        Dyad::Turns { a, b, p, affine } => {
            line(&format!(
                "A·e(ψ1) + B·e(ψ2) = P with A = {}, B = {}, P = {}",
                vector(a),
                vector(b),
                vector(p)
            ));
            for (sign, [one, two]) in ["=", "x"].iter().zip(affine) {
                let (one, two) = (shown(one.to_expr(), true), shown(two.to_expr(), true));
                line(&format!("mode {sign}: ψ1 = {one}, ψ2 = {two}   (proved)"));
            }
            if affine.len() == 1 {
                line(
                    "mode x: the mirror image of this at P: A·e(ψ1) = P·P·conj(A·e(ψ1) of =)/|P|², e(ψ2) = (P − A·e(ψ1))/B",
                );
            }
            if affine.is_empty() {
                line("k = (|P|² + |A|² − |B|²)/2, h = ±√(|P|²|A|² − k²)");
                line("e(ψ1) = P·(k + ih)/(A·|P|²), e(ψ2) = (P − A·e(ψ1))/B");
            }
        }
        Dyad::Slide { a, u, p, slide } => {
            let r = slide.name();
            line(&format!(
                "A·e(ψ1) + u·{r} = P with A = {}, u = {}, P = {}",
                vector(a),
                vector(u),
                vector(p)
            ));
            line("s = Im(P·conj(u)), h = ±√(|A|²|u|² − s²)");
            line(&format!("e(ψ1) = (h + is)·u/(A·|u|²), {r} = (Re(P·conj(u)) − h)/|u|²"));
        }
        Dyad::Cylinder { a, u, p, slide } => {
            let r = slide.name();
            line(&format!(
                "(A + u·{r})·e(ψ1) = P with A = {}, u = {}, P = {}",
                vector(a),
                vector(u),
                vector(p)
            ));
            line("m + io = A·conj(u), h = ±√(|P|²|u|² − o²)");
            line(&format!("{r} = (h − m)/|u|², e(ψ1) = P·conj(u)/(h + io)"));
        }
        Dyad::Slides { along: [u, v], p, slides: [r, s] } => {
            let (r, s) = (r.name(), s.name());
            line(&format!("u·{r} + v·{s} = P with u = {}, v = {}, P = {}", vector(u), vector(v), vector(p)));
            line(&format!("{r} = Im(conj(P)·v)/Im(conj(u)·v), {s} = Im(conj(u)·P)/Im(conj(u)·v)"));
        }
    }
    for sum in &step.angles {
        let parts = [(sum.of[0], format!("({turn})")), (sum.of[1], "ψ1".into()), (sum.of[2], "ψ2".into())];
        let mut form = String::new();
        for (times, name) in parts.iter().filter(|p| p.0 != 0 && p.1 != "(0)") {
            let sign = match (times < &0, form.is_empty()) {
                (true, true) => "−",
                (true, false) => " − ",
                (false, true) => "",
                (false, false) => " + ",
            };
            let times = if times.abs() == 1 { String::new() } else { format!("{}·", times.abs()) };
            form += &format!("{sign}{times}{name}");
        }
        line(&format!("{} = {}", sum.symbol.name(), if form.is_empty() { "0" } else { &form }));
    }
    text
}

/// What is said of the loops of a linkage: how each is solved, its modes, its mobility.
pub fn about(linkage: &Linkage, loops: Option<&Loops>) -> String {
    let plan = Plan::of(linkage);
    let mut text = format!("\n{}\n", styled("Closed loops", HEADING));
    for step in &plan.steps {
        let names: Vec<String> = step.unknowns().iter().map(|s| s.name().to_string()).collect();
        let special = match &step.dyad {
            Dyad::Turns { affine, .. } if affine.len() > 1 => ", a rhombus",
            Dyad::Turns { affine, .. } if affine.len() == 1 => ", a parallelogram or a kite",
            _ => "",
        };
        text += &format!(
            "  {}: {}, {}{special}: {} in closed form\n",
            styled(&linkage.loop_name(step.closure), NAME),
            if matches!(step.dyad, Dyad::Spherical(_)) { "spherical" } else { "planar" },
            dyad_name(step),
            names.join(", ")
        );
    }
    for (closure, why) in &plan.unsolved {
        let name = styled(&linkage.loop_name(*closure), NAME);
        text += &format!("  {name}: {}; by Newton's method\n", unsolved(why));
    }
    let modes: Vec<String> =
        plan.modes().iter().map(|m| named(linkage, &plan, m)).filter(|m| !m.is_empty()).collect();
    if !modes.is_empty() {
        text += &format!("  assembly modes: {}\n", modes.join(", "));
    }
    let affine = plan.affine(&linkage.mode(&plan, None).unwrap_or_else(|_| plan.usual()));
    let relations: Vec<String> = affine
        .iter()
        .filter_map(|(s, e)| {
            let is_angle = linkage.kind(*s) == Some(JointKind::Revolute);
            Some(format!("{} = {}", s.name(), shown((*e)?, is_angle)))
        })
        .collect();
    if !relations.is_empty() {
        text += &format!("  in the first: {}\n", relations.join(", "));
    }
    if let Some(m) = loops.and_then(denavit::closure::mobility) {
        text += &format!(
            "  mobility {} by rank ({} joints, constraints of rank {} at {} closed configurations); {} driven\n",
            m.count(),
            m.joints,
            m.rank,
            m.configurations,
            plural(linkage.driven().len(), "joint")
        );
    }
    text
}

fn named(linkage: &Linkage, plan: &Plan, mode: &Mode) -> String {
    match linkage.mode_name(plan, mode) {
        Some(name) => format!("{mode} ({name})"),
        None => mode.to_string(),
    }
}
