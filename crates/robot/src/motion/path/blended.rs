//! Straight lines through way-points, with the corners blended (Craig, *Introduction to Robotics*, §7.3; Biagiotti &
//! Melchiorri 2008, §3.2.3): the path passes each inner way-point at a distance that is given.
//!
//! The parameter is the length of the lines. Around a corner from direction u₀ to u₁ the tangent turns over
//! 2h of it, q' = u₀ + (u₁ − u₀) σ(x) with x from 0 to 1: for a parabola σ = x, and the middle is h |u₁ − u₀| / 4 from
//! the corner; with σ = 3x² − 2x³, of which q is the quintic that leaves and meets the lines without curvature, it is
//! 3 h |u₁ − u₀| / 16.

use super::piecewise::PiecewisePath;
use super::way_points::{chord_lengths, distance};
use crate::motion::error::{MotionError, joints};

/// How corners are blended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blend {
    /// Parabolas: q' is continuous (C¹), q'' jumps.
    Parabolic,
    /// Quintics (of which the fifth power vanishes by symmetry): q'' is continuous too (C²).
    Quintic,
}

impl Blend {
    /// The distance of the middle from the corner, by h |u₁ − u₀|.
    fn depth(self) -> f64 {
        match self {
            Self::Parabolic => 1.0 / 4.0,
            Self::Quintic => 3.0 / 16.0,
        }
    }
}

/// Straight lines through way-points; the path passes inner way-point `i` at the distance `deviations[i - 1]` (joint
/// space, Euclidean), or nearer, where a blend would take more than half of a line. A deviation of 0 leaves the
/// corner, and a timing stops there. The path starts and ends in the first and last way-point.
///
/// # Errors
/// As [`chord_lengths`]; if there is not one finite deviation for each inner way-point, or one is negative.
pub fn blended(
    way_points: &[Vec<f64>],
    deviations: &[f64],
    blend: Blend,
) -> Result<PiecewisePath, MotionError> {
    let lengths = chord_lengths(way_points)?;
    let n = way_points.len();
    joints("deviations", n - 2, deviations)?;
    if let Some(d) = deviations.iter().find(|d| **d < 0.0) {
        return Err(MotionError::NotPositive("deviations", *d));
    }
    let chords: Vec<f64> = lengths.windows(2).map(|s| s[1] - s[0]).collect();
    let directions: Vec<Vec<f64>> = (0..n - 1)
        .map(|i| way_points[i].iter().zip(&way_points[i + 1]).map(|(a, b)| (b - a) / chords[i]).collect())
        .collect();
    let half = |i: usize| {
        let bend = distance(&directions[i - 1], &directions[i]);
        let wished = deviations[i - 1] / (blend.depth() * bend);
        if bend < 1e-12 { 0.0 } else { wished.min(chords[i - 1] / 2.0).min(chords[i] / 2.0) }
    };
    let pieces = pieces(way_points, &lengths, &(1..n - 1).map(half).collect::<Vec<_>>());
    let coefficient = |piece: usize, joint: usize, power: usize| match &pieces[piece] {
        Piece::Line { from, offset, line, .. } => match power {
            0 => way_points[*from][joint] + offset * directions[*line][joint],
            1 => directions[*line][joint],
            _ => 0.0,
        },
        Piece::Corner { at, half, .. } => {
            let (u, w) = (directions[at - 1][joint], directions[*at][joint]);
            let width = 2.0 * half;
            match (power, blend) {
                (0, _) => way_points[*at][joint] - half * u,
                (1, _) => u,
                (2, Blend::Parabolic) => (w - u) / (2.0 * width),
                (3, Blend::Quintic) => (w - u) / (width * width),
                (4, Blend::Quintic) => -(w - u) / (2.0 * width * width * width),
                _ => 0.0,
            }
        }
    };
    let breaks = pieces.iter().map(Piece::start).chain([lengths[n - 1]]).collect();
    let order = if blend == Blend::Parabolic { 3 } else { 5 };
    Ok(PiecewisePath::new(way_points[0].len(), order, breaks, coefficient))
}

enum Piece {
    /// From way-point `from` and `offset` behind it, along line `line`.
    Line { start: f64, from: usize, offset: f64, line: usize },
    /// Around way-point `at`, from `half` before it to `half` behind it.
    Corner { start: f64, at: usize, half: f64 },
}

impl Piece {
    fn start(&self) -> f64 {
        match self {
            Self::Line { start, .. } | Self::Corner { start, .. } => *start,
        }
    }
}

fn pieces(way_points: &[Vec<f64>], lengths: &[f64], halves: &[f64]) -> Vec<Piece> {
    let half = |i: usize| if i == 0 || i == way_points.len() - 1 { 0.0 } else { halves[i - 1] };
    let mut pieces = vec![];
    for line in 0..way_points.len() - 1 {
        let (start, end) = (lengths[line] + half(line), lengths[line + 1] - half(line + 1));
        // Blends that meet in the middle of a line leave nothing of it but rounding.
        if end - start > 1e-12 * lengths[line + 1] {
            pieces.push(Piece::Line { start, from: line, offset: half(line), line });
        }
        if half(line + 1) > 0.0 {
            pieces.push(Piece::Corner { start: end, at: line + 1, half: half(line + 1) });
        }
    }
    pieces
}
