//! A path drawn on the floor by hand.

use motion_session::command::Command;
use motion_session::document::CharacterIdx;

use super::snap::{GRID_M, snapped};
use crate::state::EditorState;
use crate::state::moving::rounded;

/// Points nearer to the last one than this are left out while somebody draws, metres.
const STEP_M: f64 = 0.03;
/// What is drawn is followed as near as this, metres: less is a hand's tremble.
const NEAR_M: f64 = 0.06;
/// What is shorter is no path, metres.
const LEAST_M: f64 = 0.3;
/// The slowest and the fastest that the wheel makes it, metres per second.
const SPEEDS_M_S: (f64, f64) = (0.2, 6.0);
/// A notch of the wheel, metres per second.
const NOTCH_M_S: f64 = 0.1;

/// A path on its way.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    character: CharacterIdx,
    from: u32,
    points_m: Vec<[f64; 2]>,
}

impl Stroke {
    /// Begins at a place, at the playhead.
    pub fn begin(at_m: [f64; 2], state: &mut EditorState) -> Self {
        state.begin_gesture("Draw path");
        let character = state.session.active();
        Self { character, from: state.frame_number() as u32, points_m: vec![at_m] }
    }

    /// Goes on to a place.
    pub fn go_to(&mut self, at_m: [f64; 2]) {
        if self.points_m.last().is_none_or(|last| distance_m(*last, at_m) >= STEP_M) {
            self.points_m.push(at_m);
        }
    }

    /// Has it gone faster or slower by so many notches.
    pub fn wheel(notches: f32, state: &mut EditorState) {
        let speed = state.path_speed_m_s + NOTCH_M_S * f64::from(notches);
        state.path_speed_m_s = (speed * 10.0).round() / 10.0;
        state.path_speed_m_s = state.path_speed_m_s.clamp(SPEEDS_M_S.0, SPEEDS_M_S.1);
    }

    /// What asks for it, and for a motion that is long enough; nothing while it is too short.
    pub fn commands(&self, is_snapping: bool, state: &EditorState) -> Vec<Command> {
        let points_m = simplified(&self.points_m, NEAR_M);
        let on_grid = |p: &[f64; 2]| p.map(|axis| rounded(snapped(axis, GRID_M, is_snapping)));
        let mut points_m: Vec<[f64; 2]> = points_m.iter().map(on_grid).collect();
        points_m.dedup();
        if length_m(&points_m) < LEAST_M {
            return Vec::new();
        }
        let (from, to) = (self.from, self.to(&points_m, state));
        let character = self.character;
        let mut commands = vec![Command::AddPath { character, from, to, points_m }];
        commands.extend(state.length_for(to));
        commands
    }

    /// The frame at which its end is reached.
    fn to(&self, points_m: &[[f64; 2]], state: &EditorState) -> u32 {
        self.from + frames_for(length_m(points_m), state.path_speed_m_s, state.fps())
    }

    /// What it is so far, in words.
    pub fn words(&self, state: &EditorState) -> String {
        let points_m = simplified(&self.points_m, NEAR_M);
        let (metres, from) = (length_m(&points_m), self.from);
        let (to, speed) = (self.to(&points_m, state), state.path_speed_m_s);
        format!("{metres:.1} m · f {from}–{to} · {speed:.1} m/s   Wheel: speed   Shift: grid")
    }
}

/// Frames that a way takes at a speed, at least 1.
pub fn frames_for(metres: f64, speed_m_s: f64, fps: f64) -> u32 {
    (metres / speed_m_s.max(1e-3) * fps).round().clamp(1.0, 900_000.0) as u32
}

/// How long a way is, metres.
pub fn length_m(points_m: &[[f64; 2]]) -> f64 {
    points_m.windows(2).map(|pair| distance_m(pair[0], pair[1])).sum()
}

fn distance_m(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// The way without the points that change nothing: all that was drawn is within `near_m` of it
/// (Ramer 1972, Douglas and Peucker 1973).
pub fn simplified(points_m: &[[f64; 2]], near_m: f64) -> Vec<[f64; 2]> {
    let mut kept = vec![false; points_m.len()];
    let mut open = vec![(0, points_m.len().saturating_sub(1))];
    while let Some((first, last)) = open.pop() {
        for end in [first, last] {
            kept.iter_mut().skip(end).take(1).for_each(|kept| *kept = true);
        }
        let off = |nth: usize| off_m(points_m[nth], points_m[first], points_m[last]);
        let farthest = (first + 1..last).max_by(|a, b| off(*a).total_cmp(&off(*b)));
        if let Some(nth) = farthest.filter(|nth| off(*nth) > near_m) {
            open.extend([(first, nth), (nth, last)]);
        }
    }
    points_m.iter().zip(kept).filter(|(_, kept)| *kept).map(|(p, _)| *p).collect()
}

/// How far a place is from the straight way between two others, metres.
fn off_m(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let [way, to] = [[b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]];
    let square = way[0] * way[0] + way[1] * way[1];
    let share = if square > 0.0 { (to[0] * way[0] + to[1] * way[1]) / square } else { 0.0 };
    let share = share.clamp(0.0, 1.0);
    distance_m(p, [a[0] + share * way[0], a[1] + share * way[1]])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn straight_ways_have_two_points_and_bends_stay() {
        let straight: Vec<[f64; 2]> = (0..50).map(|i| [0.02 * f64::from(i), 0.01]).collect();
        assert_eq!(simplified(&straight, NEAR_M).len(), 2);
        let corner: Vec<[f64; 2]> = (0..=20)
            .map(|i| [f64::from(i.min(10)) * 0.1, f64::from((i - 10).max(0)) * 0.1])
            .collect();
        assert_eq!(simplified(&corner, NEAR_M), [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]);
        let circle: Vec<[f64; 2]> = (0..200)
            .map(|i| f64::from(i) * 0.03)
            .map(|rad| [2.0 * rad.cos(), 2.0 * rad.sin()])
            .collect();
        let few = simplified(&circle, NEAR_M);
        assert!((8..24).contains(&few.len()), "{} points", few.len());
        let is_near = |p: &[f64; 2]| {
            few.windows(2).map(|w| off_m(*p, w[0], w[1])).fold(f64::MAX, f64::min) <= NEAR_M
        };
        assert!(circle.iter().all(is_near), "nothing is left out that shows");
        assert_eq!(simplified(&[], NEAR_M), [[0.0; 2]; 0]);
        assert_eq!(simplified(&[[1.0, 2.0]], NEAR_M), [[1.0, 2.0]]);
    }

    #[test]
    fn a_way_takes_its_time() {
        assert_eq!(frames_for(3.0, 1.2, 30.0), 75);
        assert_eq!(frames_for(0.0, 1.2, 30.0), 1);
        assert_eq!(length_m(&[[0.0, 0.0], [3.0, 4.0], [3.0, 5.0]]), 6.0);
    }
}
