//! A robot in hand, and what was derived for it.

use crate::definitions::Definitions;
use crate::heavy::Heavy;
use crate::refusal::Refusal;
use crate::steps::Step;
use denavit::Robot;
use denavit::description::Description;
use denavit::inverse::{InverseKinematics, InverseOptions, JointSpace};
use denavit_report::figure::Arm;
use std::cell::OnceCell;

/// The most rows of a table: where symbols stand on longer arms takes seconds to find.
const MAX_ROWS: usize = 24;

/// A robot, and what was derived for it.
pub struct Subject {
    /// As it is described.
    pub description: Description,
    /// With values for all lengths, some of them chosen.
    pub valued: Description,
    /// In numbers.
    pub robot: Robot<f64>,
    /// Its joints.
    pub space: JointSpace,
    /// How it is drawn.
    pub arm: Arm,
    /// Solves poses.
    pub solver: Option<InverseKinematics>,
    /// What its formulas say, by topic.
    pub formulas: Vec<(String, Definitions)>,
    /// The texts of its cells, row by row.
    pub steps: OnceCell<Vec<Vec<Step>>>,
    /// With masses; or why they have no values.
    heavy: OnceCell<Result<Heavy, String>>,
}

impl Subject {
    /// # Errors
    /// If the robot cannot be drawn or computed with: a sentence that says why.
    pub fn new(description: Description) -> Result<Self, String> {
        let joints = description.variables().len();
        if joints == 0 {
            return Err("no joint moves: a cell with q1 makes its row a joint".into());
        }
        if joints.max(description.rows.len()) > MAX_ROWS {
            return Err(format!(
                "an arm of {joints} joints is more than a page can draw while one types: {MAX_ROWS} rows are allowed"
            ));
        }
        let valued = description.filled();
        let robot = Robot::numeric(&valued).map_err(|why| why.to_string())?;
        let space = JointSpace::new(&valued, &robot);
        let arm = Arm::new(&valued).map_err(|why| why.to_string())?;
        Ok(Subject {
            description,
            valued,
            robot,
            space,
            arm,
            solver: None,
            formulas: vec![],
            steps: OnceCell::new(),
            heavy: OnceCell::new(),
        })
    }

    /// The solver of poses, derived when it is first needed.
    ///
    /// # Errors
    /// If the robot cannot be solved as it is.
    pub fn solver(&mut self) -> Result<&mut InverseKinematics, Refusal> {
        if self.solver.is_none() {
            let made = InverseKinematics::new(&self.valued, &InverseOptions::default());
            self.solver = Some(made.map_err(|why| Refusal::new(why.to_string()))?);
        }
        self.solver.as_mut().ok_or_else(|| Refusal::new("there is no solver"))
    }

    /// The arm with its masses, those of bars where none are known.
    ///
    /// # Errors
    /// If a mass has no value.
    pub fn heavy(&self) -> Result<&Heavy, Refusal> {
        let heavy = self.heavy.get_or_init(|| Heavy::new(&self.valued, &self.arm));
        heavy.as_ref().map_err(|why| Refusal::new(why.clone()))
    }

    /// A configuration with a finite value for every joint.
    ///
    /// # Errors
    /// If it has another number of values, or one is not finite.
    pub fn configuration<'q>(&self, q: &'q [f64]) -> Result<&'q [f64], Refusal> {
        let joints = self.robot.joints;
        if q.len() != joints {
            return Err(Refusal::new(format!("{} values for {joints} joints", q.len())));
        }
        // Beyond that a double says nothing about an angle.
        if !q.iter().all(|x| x.abs() < 1e9) {
            return Err(Refusal::new("a joint's value is not a number, or too large"));
        }
        Ok(q)
    }
}
