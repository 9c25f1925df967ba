//! `denavit dynamics`: torques, inertia, accelerations in numbers; base parameters and torques as formulas.

mod linkage;
mod report;
mod simulation;
mod stream;
pub mod tree;

use crate::arguments::{DynamicsArguments, Format};
use crate::commands::document;
use crate::commands::fk::{Frame, configuration, plural, value};
use crate::commands::jacobian::{joint_rates, joints_of, numbers};
use crate::failure::{Failure, without_values};
use crate::load::{self, Around};
use crate::terminal::{note, words};
use denavit::Robot;
use denavit::description::{Description, JointKind, Measure, Row, Variable};
use denavit::dynamics::{
    DynamicModel, Dynamics, GRAVITY, Ground, NoBasis, NoNumbers, Recursion, Representatives,
    acceleration_derivatives, direct_dynamics, drive_torques, friction, gravity_torques, holding_at,
    holding_torques, inertia_matrix, kinetic_energy, momentum, potential_energy, power, torque_derivatives,
    velocity_torques,
};
use denavit::forward::Reference;
use denavit::geometry::{Body, Vector};
use denavit::quantity::torque_unit;
use denavit::space::JointSpace;
use denavit::velocity::Viewpoint;
use denavit_report::explain::{
    dynamics_document, dynamics_explanation, dynamics_vocabulary, recursion_vocabulary,
};
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::{Expr, Rational, Symbol};
use denavit_wire::Schema;
use denavit_wire::dynamics::{Answer, Energy, Model, Momentum, Recursive, Slopes};
use std::io::Write;

/// Answers what is asked about dynamics.
///
/// # Errors
/// If the robot or an option cannot be read, masses or values are missing, or nothing can be written.
pub fn run(arguments: &DynamicsArguments) -> Result<(), Failure> {
    let asks_formulas = arguments.symbolic || arguments.explain;
    if !asks_formulas && (arguments.keep.is_some() || arguments.drop.is_some()) {
        return Err(Failure::Usage("--keep and --drop are for --symbolic and --explain".into()));
    }
    if arguments.at.is_some() && arguments.wrench.is_none() && arguments.input.is_none() {
        return Err(Failure::Usage("--at says where a wrench is exerted: give --wrench, too".into()));
    }
    if arguments.whole && arguments.wrench.is_some() && arguments.at.is_none() {
        return Err(Failure::Usage(
            "--wrench: a whole tree has no tool: name the link that exerts it with --at".into(),
        ));
    }
    if let Some(closed) = load::without_chain(&arguments.robot)? {
        return linkage::run(arguments, closed);
    }
    if arguments.whole && load::linkage(&arguments.robot)?.is_none() {
        return tree::run(arguments);
    }
    if let Some(closed) = load::beside_chain(&arguments.robot)? {
        return linkage::run(arguments, closed);
    }
    let (mut description, around, mut whole) = match load::whole(&arguments.robot)? {
        Some((description, around, whole)) => (description, around, Some(whole)),
        None => {
            let (description, around) = load::robot_and_around(&arguments.robot)?;
            (description, around, None)
        }
    };
    if let Some(text) = &arguments.gravity {
        description.gravity = Some(gravity(text)?);
    }
    if let Some(whole) = &mut whole {
        whole.tree.gravity = description.gravity;
    } else if let Around::Rows(chain) = &around
        && let Some(closed) = chain.closed.as_ref().filter(|c| !c.beside.is_empty())
    {
        let beside = closed.beside.join(", ");
        note(&format!("warning: this is the chain alone: the masses of {beside} have no part in it"));
    }
    let held = around.held_joints();
    if !held.is_empty() && whole.is_none() {
        note(&format!(
            "note: what hangs on the chain behind {} counts as fixed where these joints are at 0",
            held.join(", ")
        ));
    }
    if asks_formulas {
        return match &whole {
            Some(whole) => linkage::symbolic(&whole.tree, arguments),
            None => symbolic(&description, arguments),
        };
    }
    if arguments.q.is_none() && arguments.input.is_none() {
        return Err(Failure::Usage(format!(
            "say where the joints are: -q with {}; or --symbolic or --explain for formulas",
            plural(description.variables().len(), "value"),
        )));
    }
    let arm = Arm::read(&description, &around, whole.as_ref(), arguments)?;
    match &whole {
        Some(whole) => check_bodies(&whole.tree.all_rows(), &arm.dynamics, &arguments.robot.robot),
        None => check_bodies(&description, &arm.dynamics, &arguments.robot.robot),
    }
    let given = Given::read(&description, arguments)?;
    let text = match (&arguments.input, &arguments.q) {
        (Some(path), _) => return stream::run(&arm, &given, path),
        (None, text) => text.as_deref().unwrap_or_default(),
    };
    let q = configuration(&description, text)?;
    if let Some(duration) = arguments.simulate {
        let joints =
            description.variables().into_iter().map(|v| (v.symbol.name().to_string(), v.kind)).collect();
        let limits = JointSpace::without_lengths(&description).limits;
        let moving = simulation::Moving { name: &description.name, joints, limits, is_closed: false };
        return simulation::run(&moving, &arm, arguments, duration, &q, given);
    }
    arm.say_stuck(&given.qd);
    let answer = arm.answer(given, q).map_err(|why| Failure::Input(format!("error: {why}")))?;
    let text = match arguments.json {
        true => format!("{}\n", denavit_wire::text(&answer)),
        false => {
            let joint = |v: Variable| (v.symbol.name().to_string(), v.kind);
            let joints: Vec<(String, JointKind)> = description.variables().into_iter().map(joint).collect();
            report::text(&description.name, &joints, &answer)
        }
    };
    write!(anstream::stdout(), "{text}")?;
    Ok(())
}

/// An arm in numbers, with the names that are said.
#[derive(Clone)]
struct Arm {
    dynamics: Dynamics<f64>,
    name: String,
    joints: Vec<String>,
    /// Where a wrench is exerted, where that is said or there is a tool.
    exerts: Option<Exerts>,
    /// Whether links have a part in it that are beside that chain.
    is_whole: bool,
}

/// Where a wrench is exerted.
#[derive(Clone)]
enum Exerts {
    /// By a body of a chain.
    Chain(Box<Robot<f64>>, Viewpoint<f64>),
    /// At a point of a link of a tree, in its frame.
    Link(usize, Vector<f64>),
    /// By what stands still.
    Root,
}

/// An arm with masses in numbers.
///
/// # Errors
/// If the description says nothing of masses, a mass is negative, or a parameter has no value.
pub fn numeric(d: &Description, file: &str) -> Result<Dynamics<f64>, Failure> {
    numbers_or(Dynamics::numeric(d), d, file)
}

/// The numbers, or why there are none.
fn numbers_or(
    found: Result<Dynamics<f64>, NoNumbers>,
    d: &Description,
    file: &str,
) -> Result<Dynamics<f64>, Failure> {
    found.map_err(|why| match why {
        NoNumbers::NoMasses => Failure::Input(format!(
            "error: {file}: it says nothing of masses\n  = hint: a URDF may, for the links of another --tip; or mass, com and inertia in a robot file"
        )),
        NoNumbers::Missing(missing) => without_values(d, file, &missing),
        NoNumbers::NegativeMass(..) => Failure::Input(format!("error: {file}: {why}; no motion follows from it")),
    })
}

impl Arm {
    fn read(
        d: &Description,
        around: &Around,
        whole: Option<&load::WholeLinkage>,
        arguments: &DynamicsArguments,
    ) -> Result<Self, Failure> {
        let file = &arguments.robot.robot;
        let carried = arguments.payload.as_deref().map(payload).transpose()?;
        let found = match whole {
            Some(whole) => {
                let tool = whole.tool.map(|e| e.eval(|s| d.value(s)).unwrap_or(f64::NAN));
                let carried = carried.zip(whole.tip).map(|(body, row)| (row, body.seen_from(&tool)));
                numbers_or(Dynamics::numeric_of_rows(&whole.tree, carried), &whole.tree.all_rows(), file)
            }
            None => numeric(d, file).map(|arm| carried.iter().fold(arm, Dynamics::carrying)),
        };
        let has_masses = d.has_masses() || whole.is_some_and(|w| w.tree.all_rows().has_masses());
        let dynamics = found.map_err(|why| match why {
            Failure::Input(why) if !has_masses => Failure::Input(format!("{why}; --symbolic gives formulas")),
            other => other,
        })?;
        let robot = Robot::numeric(d).map_err(|missing| without_values(d, file, &missing))?;
        let at = match &arguments.at {
            Some(text) => exerted_at(d, around, text)?,
            None => Viewpoint::tool(),
        };
        let joints = d.variables().iter().map(|v| v.symbol.name().to_string()).collect();
        let is_whole = whole.is_some();
        Ok(Arm {
            dynamics,
            name: d.name.clone(),
            joints,
            exerts: Some(Exerts::Chain(Box::new(robot), at)),
            is_whole,
        })
    }

    /// Says which joints stand still and have Coulomb's friction, which is then not known.
    fn say_stuck(&self, qd: &[f64]) {
        let all = self.joints.iter().zip(qd).zip(&self.dynamics.drives);
        let stands = all.filter(|((_, rate), drive)| **rate == 0.0 && drive.coulomb != 0.0);
        say_still(stands.map(|((name, _), _)| name.as_str()));
    }

    /// Everything about a state.
    fn answer(&self, given: Given, q: Vec<f64>) -> Result<Answer, String> {
        let (arm, n) = (&self.dynamics, self.joints.len());
        let Given { qd, qdd, tau, wrench, derivatives } = given;
        let held = match (wrench, &self.exerts) {
            (None, _) => None,
            (Some(_), None) => return Err("no link is named that exerts `wrench`: --at LINK".into()),
            (Some(_), Some(Exerts::Root)) => Some(vec![0.0; n]),
            (Some(w), Some(Exerts::Chain(robot, at))) => Some(holding_torques(robot, &q, at, &w)),
            (Some([a, b, c, k, m, o]), Some(Exerts::Link(link, point))) => {
                Some(holding_at(arm, &q, (*link, *point), [Vector([a, b, c]), Vector([k, m, o])]))
            }
        };
        let less = |all: &[f64], sign: f64| -> Vec<f64> {
            let held = held.iter().flatten().copied().chain(std::iter::repeat(0.0));
            all.iter().zip(held).map(|(t, h)| t + sign * h).collect()
        };
        let accelerations = match &tau {
            None => None,
            Some(tau) => {
                let found = direct_dynamics(arm, &q, &qd, &less(tau, -1.0), None);
                Some(found.map_err(|singular| self.moves_nothing(singular.joint))?)
            }
        };
        let derivatives =
            derivatives.then(|| self.slopes(&q, &qd, qdd.as_deref(), tau.as_deref())).transpose()?;
        let torques = tau.unwrap_or_else(|| {
            let pulled = qdd.clone().unwrap_or_else(|| vec![0.0; n]);
            less(&drive_torques(arm, &q, &qd, &pulled, None), 1.0)
        });
        let (friction, gravity) = (friction(arm, &qd), gravity_torques(arm, &q));
        let power = power(arm, &q, &qd, &torques, held.as_deref());
        let momentum = momentum(arm, &q, &qd);
        bounded(Answer {
            accelerations,
            derivatives,
            energy: Energy { kinetic: kinetic_energy(arm, &q, &qd), potential: potential_energy(arm, &q) },
            friction,
            gravity,
            inertia: inertia_matrix(arm, &q),
            mode: None,
            momentum: Momentum {
                angular: momentum.angular.0,
                centre: momentum.centre.0,
                linear: momentum.linear.0,
                mass: momentum.mass,
            },
            passive: None,
            power: power.into(),
            robot: self.name.clone(),
            schema: Schema,
            torques,
            velocity: velocity_torques(arm, &q, &qd),
            wrench: held,
            q,
            qd,
            qdd,
        })
    }

    /// The first derivatives of the accelerations under torques, or of the torques for accelerations.
    fn slopes(
        &self,
        q: &[f64],
        qd: &[f64],
        qdd: Option<&[f64]>,
        tau: Option<&[f64]>,
    ) -> Result<Slopes, String> {
        if let Some(tau) = tau {
            let of = acceleration_derivatives(&self.dynamics, q, qd, tau);
            let of = of.map_err(|singular| self.moves_nothing(singular.joint))?;
            return Ok(Slopes { by_q: of.by_q, by_qd: of.by_qd, by_qdd: None, by_tau: Some(of.by_third) });
        }
        let still = vec![0.0; q.len()];
        let of = torque_derivatives(&self.dynamics, q, qd, qdd.unwrap_or(&still));
        Ok(Slopes { by_q: of.by_q, by_qd: of.by_qd, by_qdd: Some(of.by_third), by_tau: None })
    }

    /// Why no acceleration follows from torques.
    fn moves_nothing(&self, joint: usize) -> String {
        without_mass(&self.joints[joint])
    }
}

/// An answer of numbers that doubles hold.
fn bounded(answer: Answer) -> Result<Answer, String> {
    let is_bounded = |a: &Answer| {
        let slopes =
            |d: &Slopes| [Some(d.by_q.clone()), Some(d.by_qd.clone()), d.by_qdd.clone(), d.by_tau.clone()];
        let slopes = a.derivatives.iter().flat_map(slopes).flatten().flatten().flatten();
        let rows = a.inertia.iter().chain([&a.torques, &a.velocity]).chain(&a.accelerations).flatten();
        let rows = rows.chain(&a.momentum.linear).chain(&a.momentum.angular).copied();
        let sums = [a.energy.kinetic, a.energy.potential, a.power.supplied, a.power.kinetic];
        rows.chain(slopes).chain(sums).all(f64::is_finite)
    };
    match is_bounded(&answer) {
        true => Ok(answer),
        false => Err("the state is so large that doubles do not hold what follows from it".into()),
    }
}

/// Says that joints which stand still have Coulomb's friction.
fn say_still<'n>(names: impl Iterator<Item = &'n str>) {
    let names: Vec<&str> = names.collect();
    if !names.is_empty() {
        note(&format!(
            "note: Coulomb's friction counts as 0 of joints that stand still ({}); there it is whatever holds them, up to FS",
            names.join(", ")
        ));
    }
}

/// Why no acceleration follows from torques of this joint.
fn without_mass(joint: &str) -> String {
    format!(
        "{joint} moves no mass of its own: no acceleration follows from torques\n  = hint: give its link a mass and an inertia, or \
         the joint a rotor"
    )
}

/// The frame that a word names, as the body that exerts a wrench at its origin.
fn exerted_at(d: &Description, around: &Around, word: &str) -> Result<Viewpoint<f64>, Failure> {
    let body = match word {
        "base" => return Ok(Viewpoint::of(Reference::Base, Reference::Base)),
        "tool" => return Ok(Viewpoint::tool()),
        _ => Frame::find(d, &around.frames(), word),
    };
    let body = body.map_err(|why| Failure::Usage(format!("--at {word}: {why}, or `base` or `tool`")))?;
    let (on, offset) = body.point();
    Ok(Viewpoint { offset, ..Viewpoint::of(Reference::Frame(on), Reference::Base) })
}

/// What the tool carries: a mass, its centre in the frame of the tool, and the inertia about that.
fn payload(text: &str) -> Result<Body<f64>, Failure> {
    let wrong = |why: &str| Failure::Usage(format!("--payload {text}: {why}"));
    let quantity = |k: usize| match k {
        0 => Measure::Other("kg"),
        1..=3 => Measure::Length,
        _ => Measure::Other("kg m^2"),
    };
    // `2 kg` is one value.
    let is_one = load::value_of(text, quantity(0)).is_ok();
    let parts = if is_one { vec![text] } else { load::list(text) };
    if ![1, 4, 10].contains(&parts.len()) {
        return Err(wrong(
            "a mass, or mass, x, y, z of its centre, or these and xx, xy, xz, yy, yz, zz about the centre",
        ));
    }
    let mut all = [0.0; 10];
    for (k, part) in parts.iter().enumerate() {
        all[k] = load::value_of(part, quantity(k)).and_then(value).map_err(|why| wrong(&why))?;
    }
    let [mass, x, y, z, inertia @ ..] = all;
    let body = Body::about_centre(mass, Vector([x, y, z]), inertia);
    body.check().map_err(|why| wrong(words().no_body(why)))?;
    Ok(body)
}

/// Says which links are no bodies.
fn check_bodies(description: &Description, arm: &Dynamics<f64>, file: &str) {
    for (k, link) in arm.links.iter().enumerate() {
        let end = arm.links.get(k + 1).map_or(description.rows.len(), |next| next.row.max(link.row + 1));
        // Rows of a robot file that are no body by their numbers were named when they were read.
        let is_said = load::is_robot_file(file) && description.rows[link.row..end].iter().any(is_no_body);
        if let Err(why) = link.body.check()
            && !is_said
        {
            let name = description.rows[link.row].name.as_ref();
            let name = name.map_or(String::new(), |n| format!(" ({n})"));
            note(&format!("warning: link {}{name}: {}", k + 1, words().no_body(why)));
        }
        if link.body == Body::nothing() {
            note(&format!("note: link {} has no mass", k + 1));
        }
    }
}

/// Whether a row's numbers, without names among them, are those of no body.
fn is_no_body(row: &Row) -> bool {
    row.body().is_some_and(|body| {
        let numbers = body.parameters().map(|e| e.eval(|_| None).ok());
        numbers.iter().all(Option::is_some)
            && Body::of(numbers.map(Option::unwrap_or_default)).check().is_err()
    })
}

/// What is given besides the configuration.
#[derive(Clone)]
struct Given {
    qd: Vec<f64>,
    qdd: Option<Vec<f64>>,
    tau: Option<Vec<f64>>,
    /// Force and moment along the axes of the base.
    wrench: Option<[f64; 6]>,
    /// Whether first derivatives are asked for.
    derivatives: bool,
}

impl Given {
    fn read(d: &Description, arguments: &DynamicsArguments) -> Result<Self, Failure> {
        let wrench = arguments.wrench.as_deref().map(|text| numbers(text, "--wrench", 6)).transpose()?;
        let given = Given::at_rest(&joints_of(d), arguments)?;
        Ok(Given { wrench: wrench.and_then(|w| w.try_into().ok()), ..given })
    }

    /// All but a wrench.
    fn at_rest(joints: &[(String, JointKind)], arguments: &DynamicsArguments) -> Result<Self, Failure> {
        let rates = |text: &Option<String>, option: &str| -> Result<Option<Vec<f64>>, Failure> {
            text.as_deref().map(|t| joint_rates(joints, t, option)).transpose()
        };
        Ok(Given {
            qd: rates(&arguments.qd, "--qd")?.unwrap_or_else(|| vec![0.0; joints.len()]),
            qdd: rates(&arguments.qdd, "--qdd")?,
            tau: arguments.tau.as_deref().map(|text| torques(joints, text)).transpose()?,
            wrench: None,
            derivatives: arguments.derivatives,
        })
    }
}

/// Torques, newtons for slides, one a joint.
fn torques(joints: &[(String, JointKind)], text: &str) -> Result<Vec<f64>, Failure> {
    // `5 N m` is one value.
    let parts = if joints.len() == 1 { vec![text] } else { load::list(text) };
    if parts.len() != joints.len() {
        let found = plural(parts.len(), "value");
        return Err(Failure::Usage(format!("--tau: {found} given, {} needed", joints.len())));
    }
    let torque = |(part, (name, kind)): (&str, &(String, JointKind))| {
        let read = load::value_of(part, Measure::Other(torque_unit(*kind))).and_then(value);
        read.map_err(|why| Failure::Usage(format!("--tau: {name}: {why}")))
    };
    parts.into_iter().zip(joints).map(torque).collect()
}

/// A direction, or three components.
///
/// # Errors
/// If it is none.
pub fn gravity(text: &str) -> Result<[Expr; 3], Failure> {
    let size = Rational::new(GRAVITY.0, GRAVITY.1);
    let o = Rational::ZERO;
    let along = |axis: usize, size: Rational| -> [Rational; 3] {
        std::array::from_fn(|i| if i == axis { size.clone() } else { o.clone() })
    };
    let components = match text.trim().trim_start_matches('+') {
        "none" | "0" => [o.clone(), o.clone(), o.clone()],
        "x" => along(0, size),
        "-x" => along(0, -&size),
        "y" => along(1, size),
        "-y" => along(1, -&size),
        "z" => along(2, size),
        "-z" => along(2, -&size),
        _ => {
            let wrong = |why: String| {
                Failure::Usage(format!(
                    "--gravity {text}: {why}x, -x, y, -y, z, -z, none, or three components, as in \"0, -9.81, 0\" or \
                     \"0, 0, -1.62 m/s^2\""
                ))
            };
            let acceleration = |part: &str| load::value_of(part, Measure::Other("m/s^2"));
            let read: Result<Vec<Expr>, String> = load::list(text).into_iter().map(acceleration).collect();
            let read = read.map_err(|why| wrong(format!("{why}; ")))?;
            return <[Expr; 3]>::try_from(read).map_err(|_| wrong(String::new()));
        }
    };
    Ok(components.map(Expr::from))
}

/// The representatives that are asked for, if any.
fn representatives(arguments: &DynamicsArguments) -> Result<Option<Representatives>, Failure> {
    if arguments.keep.is_none() && arguments.drop.is_none() {
        return Ok(None);
    }
    let named = |text: &Option<String>| {
        let all = text.iter().flat_map(|t| t.split([',', ' ', ';'])).filter(|name| !name.is_empty());
        all.map(Symbol::new).collect()
    };
    let wanted = Representatives { kept: named(&arguments.keep), dropped: named(&arguments.drop) };
    if wanted == Representatives::default() {
        return Err(Failure::Usage(
            "--keep and --drop take names of parameters, as in --keep \"YY2, M4\"".into(),
        ));
    }
    Ok(Some(wanted))
}

fn no_basis(why: &NoBasis) -> Failure {
    Failure::Input(format!("error: {why}"))
}

fn symbolic(description: &Description, arguments: &DynamicsArguments) -> Result<(), Failure> {
    let model = match representatives(arguments)? {
        Some(wanted) => DynamicModel::derive_for(description, &wanted).map_err(|why| no_basis(&why))?,
        None => DynamicModel::derive(description),
    };
    let recursion = arguments.explain.then(|| Recursion::derive(description, &model.formulas, &model.base));
    let names = match &recursion {
        Some(recursion) => recursion_vocabulary(description, &model, recursion),
        None => dynamics_vocabulary(description, &model),
    };
    let tongue = arguments.language.tongue();
    let text = if arguments.json || arguments.format == Format::Json {
        let text = |e: Expr| print(e, &names, Style::Ascii);
        let mut wire = Model::of(&description.name, &model, text);
        wire.recursion = recursion.as_ref().map(|r| Recursive::of(r, text));
        format!("{}\n", denavit_wire::text(&wire))
    } else {
        let blocks = match &recursion {
            Some(recursion) => dynamics_explanation(description, &model, recursion, tongue),
            None => dynamics_document(description, &model, tongue),
        };
        let title = tongue.words().dynamics_title(&description.name);
        document::document_in(tongue, &title, &names, &blocks, arguments.format)
    };
    write!(anstream::stdout(), "{text}")?;
    let is_failed =
        |r: &Recursion| r.outward.iter().any(|o| o.ground == Ground::Failed) || r.ground == Ground::Failed;
    match model.ground == Ground::Failed || recursion.as_ref().is_some_and(is_failed) {
        true => Err(Failure::GaveUp("the torques are not Lagrange's".into())),
        false => Ok(()),
    }
}
