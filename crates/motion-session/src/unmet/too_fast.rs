//! Constraints that are too far apart for their times.

use motion_core::constraint::BodyConstraint;

use crate::Library;
use crate::problem::CharacterProblem;

/// What cannot be, whatever is found: a sentence for each pair of checkpoints that are too far apart
/// for their times.
pub(crate) fn infeasible(character: &CharacterProblem, library: &Library) -> Vec<String> {
    let ids = character.ids.body.iter().map(String::as_str);
    let named: Vec<(&str, &BodyConstraint)> = ids.zip(&character.problem.wishes.body).collect();
    let allowed = &character.problem.allowed_clips;
    too_fast(&named, library.clips.fps().get(), top_speed_m_s(allowed, library))
}

/// Pairs of constraints that ask for more speed than any clip in use has.
fn too_fast(body: &[(&str, &BodyConstraint)], fps: f64, top_m_s: f64) -> Vec<String> {
    let mut sentences = Vec::new();
    for pair in body.windows(2) {
        let [(from_id, from), (to_id, to)] = [pair[0], pair[1]];
        let distance_m = f64::from(from.position_m.distance(to.position_m));
        let secs = f64::from(to.frame - from.frame) / fps;
        if distance_m > 1.1 * top_m_s * secs + 0.3 {
            sentences.push(format!(
                "from {from_id:?} to {to_id:?} it is {distance_m:.1} m in {secs:.1} s, \
                 {:.1} m/s; the fastest clip in use goes {top_m_s:.1} m/s",
                distance_m / secs
            ));
        }
    }
    sentences
}

/// The most ground that an allowed clip gains within a second (or its own length), per second.
pub(crate) fn top_speed_m_s(allowed: &[bool], library: &Library) -> f64 {
    let clips = library.clips.clips().iter().zip(allowed).filter(|(_, allowed)| **allowed);
    let fps = library.clips.fps();
    let speeds = clips.filter_map(|(clip, _)| {
        let torsos = &clip.track.world_from_torso;
        let span = fps.frames_in_secs(1.0).min(torsos.len() - 1);
        let secs = fps.duration_secs(span + 1);
        let gains = torsos.iter().zip(torsos.get(span..)?);
        let most = gains.map(|(a, b)| a.ground_m().distance(b.ground_m())).fold(0.0, f32::max);
        (secs > 0.0).then_some(f64::from(most) / secs)
    });
    speeds.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use glam::Vec2;
    use motion_core::constraint::Tolerance;

    use super::*;

    #[test]
    fn a_hundred_metres_in_five_seconds_is_too_fast() {
        let at = |frame, z| BodyConstraint {
            frame,
            position_m: Vec2::new(0.0, z),
            heading_rad: 0.0,
            height_m: None,
            weight: 1.0,
            tolerance: Tolerance::default(),
        };
        let (start, end, near) = (at(0, 0.0), at(150, 100.0), at(300, 110.0));
        let body = [("start", &start), ("end", &end), ("near", &near)];
        assert_eq!(
            too_fast(&body, 30.0, 4.8),
            ["from \"start\" to \"end\" it is 100.0 m in 5.0 s, 20.0 m/s; \
              the fastest clip in use goes 4.8 m/s"]
        );
    }
}
