//! What is measured of a motion frame by frame.

use glam::{Vec2, Vec3};
use motion_core::contacts::speeds_m_s;
use motion_core::motion::Motion;
use motion_session::ConstraintKind;

use crate::mark::Mark;

/// A curve at the bottom of the timeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Curve {
    /// How far off each constraint is, a stem each: between constraints nothing is asked.
    Miss,
    /// Of the root over the ground.
    Speed,
    /// Of the root about the vertical, to the left positive.
    Turn,
    /// From the root to the nearest point of the drawn path.
    Path,
}

impl Curve {
    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Miss => "Miss",
            Self::Speed => "Speed",
            Self::Turn => "Turn",
            Self::Path => "Off path",
        }
    }

    /// A value with its unit.
    pub fn text(self, value: f32) -> String {
        match self {
            Self::Miss | Self::Path => format!("{:.0} cm", value * 100.0),
            Self::Speed => format!("{value:.2} m/s"),
            Self::Turn => format!("{value:.0}°/s"),
        }
    }

    /// The value that reaches the top at least, so that small ones look small.
    pub fn least_top(self) -> f32 {
        match self {
            Self::Miss | Self::Path => 0.1,
            Self::Speed => 1.0,
            Self::Turn => 90.0,
        }
    }
}

/// Speed of the root over the ground at every frame, metres per second.
pub fn root_speeds_m_s(motion: &Motion) -> Vec<f32> {
    let speeds = speeds_m_s(motion.root_positions_m(), motion.fps());
    speeds.into_iter().map(|(along, _)| along).collect()
}

/// How fast the root turns about the vertical at every frame, degrees per second, to the left
/// positive; over as long as speeds are. What it turns about other axes does not count: of each turn
/// only its twist about the vertical is taken.
pub fn root_turns_deg_s(motion: &Motion) -> Vec<f32> {
    let fps = motion.fps();
    let half = fps.frames_in_secs(motion_core::contacts::SPEED_HALF_SPAN_SECS).max(1);
    let last = motion.n_frames().saturating_sub(1);
    let turn = |frame: usize| {
        let (a, b) = (frame.saturating_sub(half), (frame + half).min(last));
        if a == b {
            return 0.0;
        }
        let turn = motion.root_rotation(b) * motion.root_rotation(a).inverse();
        let twist_deg = (2.0 * turn.y.atan2(turn.w)).to_degrees();
        // The shorter way round.
        let twist_deg = twist_deg - 360.0 * (twist_deg / 360.0).round();
        twist_deg * (fps.get() / (b - a) as f64) as f32
    };
    (0..motion.n_frames()).map(turn).collect()
}

/// How far the root is from the drawn path that is asked of a frame, metres; no number where none
/// is asked.
pub fn path_errors_m(root_m: &[Vec3], marks: &[Mark]) -> Vec<f32> {
    let mut errors = vec![f32::NAN; root_m.len()];
    for mark in marks {
        let ConstraintKind::Path { from, to, points_m, .. } = &mark.constraint.kind else {
            continue;
        };
        let points: Vec<Vec2> =
            points_m.iter().map(|[x, z]| Vec2::new(*x as f32, *z as f32)).collect();
        let n = (*to as usize + 1).saturating_sub(*from as usize);
        let wished = errors.iter_mut().zip(root_m).skip(*from as usize).take(n);
        for (error, at) in wished {
            *error = distance(Vec2::new(at.x, at.z), &points);
        }
    }
    errors
}

/// From a point to the nearest point of a line of at least one point.
fn distance(at: Vec2, line: &[Vec2]) -> f32 {
    let to_piece = |piece: &[Vec2]| {
        let along = piece[1] - piece[0];
        let share = (at - piece[0]).dot(along) / along.length_squared().max(1e-12);
        at.distance(piece[0] + along * share.clamp(0.0, 1.0))
    };
    let pieces = line.windows(2).map(to_piece).fold(f32::INFINITY, f32::min);
    if pieces.is_finite() { pieces } else { line.first().map_or(f32::NAN, |p| at.distance(*p)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_to_a_line() {
        let line = [Vec2::ZERO, Vec2::new(2.0, 0.0), Vec2::new(2.0, 2.0)];
        for (at, expected) in
            [((1.0, 0.5), 0.5), ((-3.0, 4.0), 5.0), ((2.5, 1.0), 0.5), ((2.0, 3.0), 1.0)]
        {
            assert_eq!(distance(at.into(), &line), expected, "{at:?}");
        }
        assert_eq!(distance(Vec2::ONE, &[Vec2::X]), 1.0);
        assert!(distance(Vec2::ONE, &[]).is_nan());
        assert_eq!(distance(Vec2::ONE, &[Vec2::X, Vec2::X]), 1.0, "a path that stands still");
    }
}
