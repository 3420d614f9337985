//! A motion that was found, with everything the window shows of it.

use std::ops::Range;
use std::sync::Arc;

use motion_core::contacts::{self, Side};
use motion_core::motion::Motion;
use motion_scene::color::Theme;
use motion_session::ConstraintReport;
use motion_session::document::TakeId;
use motion_session::stage::Stage;
use motion_session::stage::cast::look_of;

/// A motion of every character, and how it came about.
#[derive(Clone, Debug)]
pub struct Take {
    /// Stable under edits.
    pub id: TakeId,
    /// From 1, the best.
    pub number: usize,
    /// The characters in it, with what they must meet.
    pub stage: Stage,
    /// Frames per second.
    pub fps: f64,
    /// How the first character's motion is made and judged.
    pub lane: Lane,
    /// The motion as it was made.
    pub motion: Arc<Motion>,
    /// Whether it was made for other constraints than the present ones.
    pub is_stale: bool,
}

/// What the timeline says of one character's motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lane {
    /// The sum of the terms, in units of one tolerance squared.
    pub score: f64,
    /// Its parts, in the order of [`TERMS`].
    pub terms: [f64; 4],
    /// What is shown, in order.
    pub pieces: Vec<Piece>,
    /// Where one piece goes over into the next.
    pub cuts: Vec<Cut>,
    /// How far off each constraint is.
    pub misses: Vec<ConstraintReport>,
    /// When the left foot is planted, and when the right one is.
    pub plants: [Vec<Range<usize>>; 2],
    /// Mean speed of planted feet, cm/s.
    pub foot_slide_cm_per_s: Option<f64>,
}

/// What a score is made of.
pub const TERMS: [&str; 4] = ["Cuts", "Length", "Body", "Surroundings"];

/// Frames of a clip in a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// The clip's id.
    pub clip: String,
    /// Frames of the motion.
    pub frames: Range<usize>,
    /// The clip's first and last frame that are shown.
    pub of_clip: (u32, u32),
}

/// A cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// The first frame of the new piece.
    pub frame: usize,
    /// What it costs.
    pub cost: f64,
    /// Whether it joins what the threshold alone leaves apart.
    pub is_bridge: bool,
}

/// A body constraint on the timeline.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// Which of the character's constraints.
    pub constraint: usize,
    /// When.
    pub frame: usize,
    /// Where, metres along X and Z.
    pub at_m: [f64; 2],
    /// Which way, degrees; `None` for any.
    pub heading_deg: Option<f64>,
    /// How far off the body is; `None` while nobody knows.
    pub miss: Option<ConstraintReport>,
}

impl Take {
    /// Frames of the longest motion, at least 1.
    pub fn n_frames(&self) -> usize {
        self.stage.n_frames().max(1)
    }

    /// Brings its colours to a theme.
    pub fn set_theme(&mut self, theme: Theme) {
        self.stage.theme = theme;
        for (nth, actor) in self.stage.actors.iter_mut().enumerate() {
            actor.look = look_of(nth, theme);
        }
    }
}

impl Mark {
    /// Whether the body is off by what somebody could see.
    pub fn is_off(&self) -> bool {
        !self.misses().is_empty()
    }

    /// `miss 4 cm, 2°`, or that it is met.
    pub fn miss_text(&self) -> String {
        match (&self.miss, self.misses()) {
            (None, _) => "searching".to_owned(),
            (Some(_), misses) if misses.is_empty() => "met".to_owned(),
            (Some(_), misses) => format!("miss {}", misses.join(", ")),
        }
    }

    /// The misses that somebody could see, with their units.
    fn misses(&self) -> Vec<String> {
        let Some(miss) = &self.miss else { return Vec::new() };
        let cm = miss.position_error_m.map(|m| m * 100.0).filter(|cm| *cm >= 0.5);
        let deg = miss.heading_error_deg.filter(|deg| deg.abs() >= 0.5);
        let frames = miss.frame_error.filter(|frames| *frames != 0);
        let when = |frames: i64| if frames > 0 { "late" } else { "early" };
        let all = [
            cm.map(|cm| format!("{cm:.0} cm")),
            deg.map(|deg| format!("{:.0}°", deg.abs())),
            frames.map(|frames| format!("{} f {}", frames.abs(), when(frames))),
        ];
        all.into_iter().flatten().collect()
    }
}

/// When each foot of the first actor is planted.
pub fn plants_of(stage: &Stage) -> [Vec<Range<usize>>; 2] {
    let Some(actor) = stage.actors.first() else { return Default::default() };
    Side::BOTH.map(|side| {
        let Some(toe) = contacts::toe_joint(&actor.skeleton, side) else { return Vec::new() };
        let path_m = actor.motion.joint_path_m(&actor.skeleton, toe);
        let planted = contacts::planted_on_lowest(&path_m, actor.motion.fps());
        contacts::runs(planted.len(), |frame| planted[frame])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn misses_nobody_can_see_are_none() {
        let check = |miss: Option<(f64, f64, i64)>, expected: &str, is_off: bool| {
            let miss = miss.map(|(metres, degrees, frames)| ConstraintReport {
                position_error_m: Some(metres),
                heading_error_deg: Some(degrees),
                frame_error: Some(frames),
                ..ConstraintReport::default()
            });
            let mark = Mark { constraint: 0, frame: 0, at_m: [0.0; 2], heading_deg: None, miss };
            assert_eq!((mark.miss_text().as_str(), mark.is_off()), (expected, is_off));
        };
        check(None, "searching", false);
        check(Some((0.0, 0.0, 0)), "met", false);
        check(Some((0.004, 0.2, 0)), "met", false);
        check(Some((0.042, 0.0, 0)), "miss 4 cm", true);
        check(Some((0.042, -3.4, 11)), "miss 4 cm, 3°, 11 f late", true);
        check(Some((0.0, 0.0, -2)), "miss 2 f early", true);
    }
}
