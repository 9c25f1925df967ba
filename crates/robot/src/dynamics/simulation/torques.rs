//! Torques over time.

/// Torques of the drives over time: between the times that are given they are linear, before and after they stay.
#[derive(Clone, PartialEq, Debug)]
pub struct Torques {
    times: Vec<f64>,
    rows: Vec<Vec<f64>>,
}

impl Torques {
    /// The same at all times.
    pub fn constant(torques: Vec<f64>) -> Self {
        Torques { times: vec![0.0], rows: vec![torques] }
    }

    /// Torques at these times, seconds; `None` if they are none, or the times do not increase, or the rows are not as many or of
    /// different length, or a number is not finite.
    pub fn over(times: Vec<f64>, rows: Vec<Vec<f64>>) -> Option<Self> {
        let increase = times.windows(2).all(|t| t[0] < t[1]);
        let are_as_many = times.len() == rows.len() && !times.is_empty();
        let are_alike = rows.windows(2).all(|r| r[0].len() == r[1].len());
        let are_finite = times.iter().chain(rows.iter().flatten()).all(|x| x.is_finite());
        (increase && are_as_many && are_alike && are_finite).then_some(Torques { times, rows })
    }

    /// How many joints have torques.
    pub fn joints(&self) -> usize {
        self.rows[0].len()
    }

    /// The torques at a time.
    pub fn at(&self, t: f64) -> Vec<f64> {
        let behind = self.times.partition_point(|&s| s <= t);
        let (Some(first), Some(next)) = (behind.checked_sub(1), self.times.get(behind)) else {
            return self.rows[behind.saturating_sub(1)].clone();
        };
        let part = (t - self.times[first]) / (next - self.times[first]);
        let pairs = self.rows[first].iter().zip(&self.rows[behind]);
        pairs.map(|(a, b)| a * (1.0 - part) + b * part).collect()
    }

    /// The times at which they have a kink, strictly between two.
    pub(super) fn between(&self, from: f64, to: f64) -> impl Iterator<Item = f64> {
        let (start, end) =
            (self.times.partition_point(|&t| t <= from), self.times.partition_point(|&t| t < to));
        self.times[start.min(end)..end].iter().copied()
    }
}
