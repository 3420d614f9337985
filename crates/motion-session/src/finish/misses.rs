//! How far a motion misses each wish, and what the report says of that.

use motion_core::constraint::{BodyConstraint, BodyError, FollowError, JointError};
use motion_core::score::Judgement;
use motion_io::report_file::ConstraintReport;

use super::digits_of;
use crate::problem::CharacterProblem;

/// Misses of every wish, kind by kind, in the order of the wishes.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Misses {
    pub(crate) body: Vec<BodyError>,
    pub(crate) joints: Vec<JointMiss>,
    pub(crate) poses: Vec<PoseMiss>,
    /// Whether each locked stretch is shown.
    pub(crate) locks: Vec<bool>,
    /// The share of frames without the tag.
    pub(crate) styles: Vec<f32>,
    pub(crate) follows: Vec<FollowError>,
    /// How deep any joint ever is within an obstacle and its margin, metres.
    pub(crate) deepest_m: f32,
}

/// How far a joint is from where it is to be.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct JointMiss {
    pub(crate) error: JointError,
    /// Frames that it is read too early, where the motion ends before (negative).
    pub(crate) frames: i64,
}

/// How far a pose is from being taken.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PoseMiss {
    /// Whether it is shown.
    pub(crate) is_met: bool,
    /// Of its place, as far as one is asked for.
    pub(crate) place: BodyError,
    /// Mean distance of the joints, metres; of a finished motion.
    pub(crate) apart_m: Option<f32>,
    /// As of a joint.
    pub(crate) frames: i64,
}

impl Misses {
    /// Those of a path before correction.
    pub(crate) fn before_correction(judgement: &Judgement) -> Self {
        let joints = judgement.joints.iter().map(|&error| JointMiss { error, frames: 0 });
        let poses = judgement.poses.iter().map(|&(is_met, place)| PoseMiss {
            is_met,
            place,
            ..PoseMiss::default()
        });
        Self {
            body: judgement.body.clone(),
            joints: joints.collect(),
            poses: poses.collect(),
            locks: judgement.locks.clone(),
            styles: judgement.styles.clone(),
            follows: judgement.follows.clone(),
            deepest_m: judgement.deepest_m,
        }
    }
}

/// What the report says of each constraint: body, joint, pose, lock, style and path constraints, each
/// kind in the order of the wishes, then the obstacles together.
pub(crate) fn constraint_reports(
    character: &CharacterProblem,
    misses: &Misses,
) -> Vec<ConstraintReport> {
    let (wishes, ids) = (&character.problem.wishes, &character.ids);
    let report = |id: &str, kind: &str| ConstraintReport {
        constraint: id.to_owned(),
        kind: kind.to_owned(),
        ..ConstraintReport::default()
    };
    let mut reports = Vec::new();
    for ((id, wish), error) in ids.body.iter().zip(&wishes.body).zip(&misses.body) {
        let placed = placed(wish, error, report(id, "body"));
        reports.push(ConstraintReport { frame_error: Some(i64::from(error.frames)), ..placed });
    }
    for ((id, wish), miss) in ids.joints.iter().zip(&wishes.joints).zip(&misses.joints) {
        let velocity = wish.velocity_m_s.map(|_| digits_of(miss.error.velocity_m_s));
        reports.push(ConstraintReport {
            position_error_m: Some(digits_of(miss.error.position_m)),
            velocity_error_m_s: velocity,
            frame_error: early(miss.frames),
            ..report(id, "joint")
        });
    }
    for ((id, wish), miss) in ids.poses.iter().zip(&wishes.poses).zip(&misses.poses) {
        let blank = report(id, "pose");
        let placed = match wish.place() {
            Some(place) => placed(&place, &miss.place, blank),
            None => blank,
        };
        reports.push(ConstraintReport {
            met: Some(miss.is_met),
            pose_error_m: miss.apart_m.map(digits_of),
            frame_error: early(miss.frames),
            ..placed
        });
    }
    for (id, &is_met) in ids.locks.iter().zip(&misses.locks) {
        reports.push(ConstraintReport { met: Some(is_met), ..report(id, "lock") });
    }
    for (id, &without) in ids.styles.iter().zip(&misses.styles) {
        let share_without = Some(digits_of(without));
        reports.push(ConstraintReport { share_without, ..report(id, "style") });
    }
    for ((id, wish), error) in ids.follows.iter().zip(&wishes.follows).zip(&misses.follows) {
        let heading_deg = digits_of(error.heading_rad.to_degrees());
        reports.push(ConstraintReport {
            position_error_m: Some(digits_of(error.position_m)),
            heading_error_deg: wish.looks_along.then_some(heading_deg),
            ..report(id, "path")
        });
    }
    if !wishes.obstacles.is_empty() {
        let deepest_m = Some(digits_of(misses.deepest_m));
        reports.push(ConstraintReport { deepest_m, ..report("obstacles", "obstacles") });
    }
    reports
}

/// The parts of a place that are asked for.
fn placed(wish: &BodyConstraint, error: &BodyError, blank: ConstraintReport) -> ConstraintReport {
    let (asks_place, asks_heading) =
        (wish.tolerance.position_m.is_finite(), wish.tolerance.heading_rad.is_finite());
    ConstraintReport {
        position_error_m: asks_place.then(|| digits_of(error.position_m)),
        heading_error_deg: asks_heading.then(|| digits_of(error.heading_rad.to_degrees())),
        ..blank
    }
}

fn early(frames: i64) -> Option<i64> {
    Some(frames).filter(|&frames| frames != 0)
}
