//! Where a body goes once its motion is corrected onto the places that are asked for.

use glam::Vec2;

use crate::planar::PlanarTransform;
use crate::score::Wishes;

/// A frame without travel counts as this much, metres: the correction of a standing body moves too.
const MIN_STEP_M: f32 = 0.02 / 30.0;

/// The ground track of a motion laid into the world as `torsos`, with what is left of its errors
/// spread as the assembly spreads it (`docs/method.md`, A6): by `exp(t · log X)` between two
/// places, t by the share of the way. Exact at the places, near between them: ends are not eased
/// here.
pub(super) fn corrected_track_m(torsos: &[PlanarTransform], wishes: &Wishes) -> Vec<Vec2> {
    let targets = targets(wishes, torsos.len() as u32);
    let mut track: Vec<Vec2> = Vec::with_capacity(torsos.len());
    let mut moved = PlanarTransform::IDENTITY;
    let mut from = 0usize;
    for (frame, place) in targets {
        let frame = frame as usize;
        let there = moved * torsos[frame];
        let mut place = place;
        place.level_m = there.level_m;
        let twist = (place * there.inverse()).log();
        let step = |at: usize| {
            let gone =
                at.checked_sub(1).map(|before| torsos[at].ground_m() - torsos[before].ground_m());
            gone.map_or(0.0, Vec2::length) + MIN_STEP_M
        };
        let all: f32 = (from..=frame).map(step).sum();
        let mut gone = 0.0;
        for (at, torso) in torsos.iter().enumerate().take(frame + 1).skip(from) {
            gone += step(at);
            track.push((twist.scaled(gone / all).exp() * moved * *torso).ground_m());
        }
        moved = twist.exp() * moved;
        from = frame + 1;
    }
    track.extend(torsos[from.min(torsos.len())..].iter().map(|&torso| (moved * torso).ground_m()));
    track
}

/// Whole places by the frame at which a motion of `n_frames` is brought there, ascending.
fn targets(wishes: &Wishes, n_frames: u32) -> Vec<(u32, PlanarTransform)> {
    let n_body = wishes.body.len();
    let body = wishes.body.iter().enumerate().map(|(nth, place)| {
        let is_last = nth > 0 && nth + 1 == n_body;
        (if is_last { n_frames - 1 } else { place.frame }, *place)
    });
    let poses = wishes.poses.iter().filter_map(|pose| pose.place());
    let mut targets: Vec<(u32, PlanarTransform)> = body
        .chain(poses.map(|place| (place.frame, place)))
        .filter(|(frame, place)| {
            let tolerance = &place.tolerance;
            let is_whole = tolerance.position_m.is_finite() && tolerance.heading_rad.is_finite();
            is_whole && *frame < n_frames
        })
        .map(|(frame, place)| (frame, place.world_from_torso()))
        .collect();
    // What is read at the same frame is the same place, or cannot be met.
    targets.sort_by_key(|(frame, _)| *frame);
    targets.dedup_by_key(|(frame, _)| *frame);
    targets
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cast::testing::{checkpoint, problem};

    #[test]
    fn a_corrected_track_is_at_its_places_and_goes_evenly_between() {
        let wishes = problem(vec![
            checkpoint(0, 1.0, 0.0, 0.0),
            checkpoint(30, 1.5, 3.3, 0.0),
            checkpoint(59, 1.0, 6.0, 0.0),
        ])
        .wishes;
        let torsos: Vec<PlanarTransform> = (0..60)
            .map(|frame| PlanarTransform::new(0.0, Vec2::new(1.0, 0.1 * frame as f32), 0.0))
            .collect();
        let track = corrected_track_m(&torsos, &wishes);
        assert_eq!(track.len(), 60);
        for place in &wishes.body {
            let off_m = track[place.frame as usize].distance(place.position_m);
            assert!(off_m < 1e-4, "{off_m} at {}", place.frame);
        }
        for pair in track.windows(2) {
            assert!(pair[0].distance(pair[1]) < 0.15, "{pair:?}");
        }
        let untouched = corrected_track_m(&torsos, &problem(vec![]).wishes);
        assert_eq!(untouched[40], torsos[40].ground_m());
    }
}
