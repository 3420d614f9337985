//! Sentences for a person on what could not be met, and why.

use motion_core::constraint::{BodyConstraint, LengthMode};

use crate::Library;
use crate::problem::CharacterProblem;
use crate::solve_job::Found;

/// What the best motion found misses by more than a tolerance, then what was left out.
pub fn unmet(character: &CharacterProblem, library: &Library, found: &Found) -> Vec<String> {
    let mut sentences = Vec::new();
    let wishes = &character.problem.wishes;
    if let Some(best) = found.alternatives.first() {
        for (id, error) in character.body_ids.iter().zip(&best.judgement.body) {
            if error.is_within(&motion_core::constraint::Tolerance::default()) {
                continue;
            }
            let mut parts = Vec::new();
            if error.position_m > 0.30 {
                parts.push(format!("{:.2} m away", error.position_m));
            }
            if error.heading_rad.to_degrees() > 10.0 {
                parts.push(format!("turned by {:.0}°", error.heading_rad.to_degrees()));
            }
            if error.height_m.abs() > 0.30 {
                parts.push(format!("{:.2} m too high or low", error.height_m.abs()));
            }
            match error.frames {
                late if late > 10 => parts.push(format!("{late} frames late")),
                early if early < -10 => parts.push(format!("{} frames early", -early)),
                _ => {}
            }
            sentences.push(format!(
                "body constraint {id:?}: the best motion found ends up {} before it is corrected",
                parts.join(", ")
            ));
        }
        let length = wishes.length.filter(|length| length.mode != LengthMode::Free);
        if let Some(length) = length
            && best.judgement.n_frames.abs_diff(length.frames) > 10
        {
            sentences.push(format!(
                "the best motion found has {} frames instead of {}",
                best.judgement.n_frames, length.frames
            ));
        }
    } else {
        sentences.push(
            "no motion was found: search longer, allow more clips, or ask for another length"
                .to_owned(),
        );
    }
    if !sentences.is_empty() {
        sentences.extend(infeasible(character, library));
    }
    sentences.extend(character.left_out.iter().cloned());
    sentences
}

/// What cannot be, whatever is found: a sentence for each pair of constraints that are too far apart
/// for their times.
pub(crate) fn infeasible(character: &CharacterProblem, library: &Library) -> Vec<String> {
    let ids = character.body_ids.iter().map(String::as_str);
    let named: Vec<(&str, &BodyConstraint)> = ids.zip(&character.problem.wishes.body).collect();
    too_fast(&named, library.clips.fps().get(), top_speed_m_s(character, library))
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

/// The most ground that a clip in use gains within a second (or its own length), per second.
fn top_speed_m_s(character: &CharacterProblem, library: &Library) -> f64 {
    let fps = library.clips.fps();
    let allowed = &character.problem.allowed_clips;
    let clips = library.clips.clips().iter().zip(allowed).filter(|(_, allowed)| **allowed);
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

    use super::*;

    #[test]
    fn a_hundred_metres_in_five_seconds_is_too_fast() {
        let at = |frame, z| BodyConstraint {
            frame,
            position_m: Vec2::new(0.0, z),
            heading_rad: 0.0,
            height_m: None,
            weight: 1.0,
            tolerance: motion_core::constraint::Tolerance::default(),
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
