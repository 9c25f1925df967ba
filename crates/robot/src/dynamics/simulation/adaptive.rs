//! Dormand and Prince's pair of orders 5 and 4 (1980), with steps by its error, and contacts of Coulomb's friction.

use super::problem::{Contact, Equations, Slope, Stop};
use super::{MAX_STEPS, NoMotion, Simulation};

/// Where the slopes of a step are taken, and of which slopes before; the last row is the result.
const NODES: [f64; 6] = [0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];
const SLOPES: [[f64; 6]; 6] = [
    [0.2, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];
/// The result less that of order 4.
const ERROR: [f64; 7] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339_200.0, 22.0 / 525.0, -1.0 / 40.0];

/// Halvings with which the time of a change of contact is found, by part of a step.
const HALVINGS: usize = 40;
/// The shortest step, by part of the duration.
const SHORTEST: f64 = 1e-15;

/// The integrator between two stretches.
pub(super) struct Adaptive {
    tolerance: f64,
    duration: f64,
    /// The length of the next step.
    step: f64,
    /// How the joints move; not known at the start.
    contacts: Option<Vec<Contact>>,
}

/// The end of a step.
struct End {
    y: Vec<f64>,
    slope: Slope,
    /// What friction has to hold within the step, by part of the step.
    held: Vec<(f64, Vec<f64>)>,
    /// The estimated error by the tolerance.
    error: f64,
}

impl Adaptive {
    pub fn new(tolerance: f64, duration: f64) -> Self {
        Adaptive { tolerance, duration, step: 1e-3 * duration.min(1.0), contacts: None }
    }

    /// Goes from one time to another, between which nothing has a kink.
    pub fn run(
        &mut self,
        problem: &impl Equations,
        (mut t, end): (f64, f64),
        y: &mut Vec<f64>,
        counts: &mut Simulation,
    ) -> Result<(), Stop> {
        let stop = |why, t, y: &[f64]| Stop { why, t, y: y.to_vec() };
        let mut contacts = match self.contacts.take() {
            Some(contacts) => contacts,
            None => problem.contacts(t, y).map_err(|why| stop(why, t, y))?,
        };
        let mut slope = problem.slope(t, y, &contacts).map_err(|why| stop(why, t, y))?;
        while t < end {
            if counts.steps + counts.refused >= MAX_STEPS {
                return Err(stop(NoMotion::Steps { t }, t, y));
            }
            let is_last = t + self.step >= end;
            let h = if is_last { end - t } else { self.step };
            let tried = self.step(problem, t, h, y, &slope, &contacts);
            let error = tried.as_ref().map_or(f64::INFINITY, |e| e.error);
            if error.is_nan() || error > 1.0 {
                counts.refused += 1;
                let factor = if error.is_finite() { (0.9 * error.powf(-0.2)).max(0.2) } else { 0.2 };
                self.step = h * factor;
                if self.step < SHORTEST * self.duration {
                    let why = tried.err().unwrap_or(NoMotion::Steps { t });
                    return Err(stop(why, t, y));
                }
                continue;
            }
            let Ok(mut reached) = tried else { continue };
            counts.steps += 1;
            let is_over =
                |e: &End| (0..contacts.len()).any(|j| problem.is_over(j, contacts[j], &e.y, &e.slope.held));
            let mut high = 1.0;
            let mut ends = is_over(&reached);
            if !ends {
                let places = within(problem, h, y, (&slope, &reached), &contacts);
                let part =
                    |place: f64| Some((place, self.step(problem, t, h * place, y, &slope, &contacts).ok()?));
                if let Some((place, part)) = places.into_iter().filter_map(part).find(|(_, p)| is_over(p)) {
                    (ends, high, reached) = (true, place, part);
                }
            }
            if ends {
                // The first moment at which a contact is over.
                let mut low = 0.0;
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (low + high);
                    let part = self.step(problem, t, h * middle, y, &slope, &contacts);
                    match part {
                        Ok(part) if is_over(&part) => (high, reached) = (middle, part),
                        Ok(_) => low = middle,
                        Err(why) => return Err(stop(why, t, y)),
                    }
                }
                let n = contacts.len();
                for (j, contact) in contacts.iter().enumerate() {
                    if matches!(contact, Contact::Slides(_))
                        && problem.is_over(j, *contact, &reached.y, &reached.slope.held)
                    {
                        reached.y[n + j] = 0.0;
                    }
                }
                counts.switched += 1;
                t += h * high;
                contacts = problem.contacts(t, &reached.y).map_err(|why| stop(why, t, y))?;
                slope = problem.slope(t, &reached.y, &contacts).map_err(|why| stop(why, t, y))?;
            } else {
                t = if is_last { end } else { t + h };
                slope = reached.slope;
            }
            *y = reached.y;
            if problem.settle(y) {
                slope = problem.slope(t, y, &contacts).map_err(|why| stop(why, t, y))?;
            }
            // A step cut short by the end says nothing against longer ones.
            let next = h * (0.9 * error.max(1e-10).powf(-0.2)).clamp(0.2, 5.0);
            self.step = if is_last { next.max(self.step) } else { next };
        }
        self.contacts = Some(contacts);
        Ok(())
    }

    fn step(
        &self,
        problem: &impl Equations,
        t: f64,
        h: f64,
        y: &[f64],
        first: &Slope,
        contacts: &[Contact],
    ) -> Result<End, NoMotion> {
        let mut rates: Vec<Vec<f64>> = vec![first.rate.clone()];
        let (mut here, mut slope) = (y.to_vec(), None);
        let mut held = vec![];
        for (node, parts) in NODES.iter().zip(&SLOPES) {
            for (k, x) in here.iter_mut().enumerate() {
                *x = y[k] + h * rates.iter().zip(parts).map(|(rate, part)| part * rate[k]).sum::<f64>();
            }
            let found = problem.slope(t + node * h, &here, contacts)?;
            rates.push(found.rate.clone());
            if *node < 1.0 {
                held.push((*node, found.held.clone()));
            }
            slope = Some(found);
        }
        let error = (0..y.len())
            .map(|k| {
                let off = h * rates.iter().zip(&ERROR).map(|(rate, part)| part * rate[k]).sum::<f64>();
                off.abs() / (self.tolerance * (1.0 + y[k].abs().max(here[k].abs())))
            })
            .fold(0.0, f64::max);
        // The last slope stands at the result.
        Ok(End { y: here, slope: slope.unwrap_or_else(|| first.clone()), held, error })
    }
}

/// Where within a step, by part of it, a contact seems to be over although it is not at its end: a joint that slides back by the cubic
/// through its velocities and accelerations at both ends, or one that sticks and is pulled too hard at a stage. The first of them first.
fn within(
    problem: &impl Equations,
    h: f64,
    y: &[f64],
    (first, last): (&Slope, &End),
    contacts: &[Contact],
) -> Vec<f64> {
    let n = contacts.len();
    let of = |(j, contact): (usize, &Contact)| match *contact {
        Contact::Slides(direction) => {
            let v = [y[n + j], last.y[n + j]].map(|v| v * direction);
            let slope = [&first.rate, &last.slope.rate].map(|rate| rate[n + j] * direction * h);
            lowest(v, slope).filter(|&(_, v)| v < 0.0).map(|(place, _)| place)
        }
        Contact::Sticks => {
            let is_over = |held: &[f64]| problem.is_over(j, *contact, &last.y, held);
            last.held.iter().find(|(_, held)| is_over(held)).map(|(place, _)| *place)
        }
    };
    let mut places: Vec<f64> = contacts.iter().enumerate().filter_map(of).collect();
    places.sort_by(f64::total_cmp);
    places
}

/// Where the cubic with these values and slopes at 0 and 1 is lowest between them, and its value there; nothing if at an end.
fn lowest([a, b]: [f64; 2], [c, d]: [f64; 2]) -> Option<(f64, f64)> {
    // a + c s + p s² + q s³
    let (p, q) = (3.0 * (b - a) - 2.0 * c - d, c + d - 2.0 * (b - a));
    let value = |s: f64| a + s * (c + s * (p + s * q));
    // c + 2 p s + 3 q s² = 0, where it grows: the root with the plus.
    let square = p * p - 3.0 * q * c;
    if square < 0.0 {
        return None;
    }
    let root = square.sqrt();
    let place = if p >= 0.0 { -c / (p + root) } else { (root - p) / (3.0 * q) };
    (place > 0.0 && place < 1.0).then(|| (place, value(place)))
}
