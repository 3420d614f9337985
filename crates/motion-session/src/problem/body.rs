//! Body constraints: checkpoints.

use glam::Vec2;
use motion_core::constraint::{BodyConstraint, PoseConstraint};
use motion_core::score::Wishes;
use motion_io::project_file::{Constraint, ConstraintKind};

use super::tolerance::tolerance;

/// Places nearer than this have no way between them, metres.
const NO_WAY_M: f32 = 0.05;

/// The wish of a body constraint. One that leaves its heading open has an infinite tolerance of it.
pub(super) fn wish(constraint: &Constraint) -> Option<BodyConstraint> {
    let ConstraintKind::Body { frame, position_m: [x, z], heading_deg, height_m } = constraint.kind
    else {
        return None;
    };
    let mut tolerance = tolerance(constraint.tolerance.as_ref());
    if heading_deg.is_none() {
        tolerance.heading_rad = f32::INFINITY;
    }
    Some(BodyConstraint {
        frame,
        position_m: Vec2::new(x as f32, z as f32),
        heading_rad: heading_deg.unwrap_or_default().to_radians() as f32,
        height_m: height_m.map(|height| height as f32),
        weight: constraint.weight.unwrap_or(1.0) as f32,
        tolerance,
    })
}

/// Brings wishes and their ids into the order of their frames.
pub(super) fn sort(body: &mut Vec<BodyConstraint>, ids: &mut Vec<String>) {
    let mut both: Vec<(BodyConstraint, String)> =
        std::mem::take(body).into_iter().zip(std::mem::take(ids)).collect();
    both.sort_by_key(|(wish, _)| wish.frame);
    (*body, *ids) = both.into_iter().unzip();
}

/// The first checkpoint places the motion, so it needs a heading: where it leaves it open, that of the
/// way to the next. It is said.
pub(super) fn close_first_heading(wishes: &mut Wishes, ids: &[String], remarks: &mut Vec<String>) {
    let Some(first) = wishes.body.first() else { return };
    if first.tolerance.heading_rad.is_finite() {
        return;
    }
    let frame = first.frame;
    let places = wishes.poses.iter().filter_map(PoseConstraint::place);
    let is_whole = |place: &BodyConstraint| {
        place.tolerance.position_m.is_finite() && place.tolerance.heading_rad.is_finite()
    };
    if places.filter(is_whole).any(|place| place.frame < frame) {
        // A pose before it places the motion.
        return;
    }
    let way = wishes.body.get(1).map(|next| next.position_m - first.position_m);
    let heading_rad =
        way.filter(|way| way.length() > NO_WAY_M).map_or(0.0, |way| way.x.atan2(way.y));
    if let Some(first) = wishes.body.first_mut() {
        first.heading_rad = heading_rad;
        first.tolerance.heading_rad = motion_core::constraint::TOLERANCE_RAD;
    }
    if let Some(id) = ids.first() {
        remarks.push(format!(
            "body constraint {id:?} leaves its heading open; the direction of the way was taken, \
             {:.0}°",
            heading_rad.to_degrees()
        ));
    }
}
