//! Where interactions may be, before anybody has been seen to come there.
//!
//! A member's own places (checkpoints, placed poses) say where it should about be at the
//! interaction's frame: on the way between them in proportion to time, and the more loosely the
//! more time there is. Each heading of the interaction that suits these guesses better than near
//! ones is a **hypothesis**.

use super::fit::{Fit, Sight};
use super::problem::CastProblem;
use crate::planar::{PlanarTransform, wrap_angle_rad};
use crate::score::Wishes;

/// So many hypotheses are tried.
const MAX_HYPOTHESES: usize = 3;

/// One that is worse than the best by more squared slacks than this is not tried: three
/// standard deviations.
const MAX_WORSE: f64 = 9.0;

/// A body at a place may be so far from it a second before or after, metres. It, the slack at the
/// place itself and those of headings are what seeds of the search allow themselves.
const SLACK_M_S: f32 = 0.6;
/// At the place itself, metres.
const SLACK_M: f32 = 0.3;
/// Headings change by so much in a second, radians.
const SLACK_RAD_S: f32 = 1.2;
/// At the place itself, radians.
const SLACK_RAD: f32 = 0.17;
/// Shorter ways have no direction, metres.
const MIN_WAY_M: f32 = 0.3;

/// Places of all interactions, one list for each hypothesis, the likeliest first. At least one.
pub(super) fn hypotheses(problem: &CastProblem, frame_secs: f32) -> Vec<Vec<PlanarTransform>> {
    let first = places(problem, frame_secs, None);
    let mut all = vec![first.iter().map(|candidates| candidates[0]).collect::<Vec<_>>()];
    for interaction in problem.in_time() {
        for nth in 1..first[interaction].len() {
            if all.len() == MAX_HYPOTHESES {
                return all;
            }
            // What comes after it is guessed anew.
            let other = places(problem, frame_secs, Some((interaction, nth)));
            all.push(other.iter().map(|candidates| candidates[0]).collect());
        }
    }
    all
}

/// For each interaction where it may be, the likeliest first; for the `chosen` one its
/// candidate of that number alone.
fn places(
    problem: &CastProblem,
    frame_secs: f32,
    chosen: Option<(usize, usize)>,
) -> Vec<Vec<PlanarTransform>> {
    let n_interactions = problem.interactions.len();
    let mut known: Vec<Vec<(u32, PlanarTransform)>> =
        problem.characters.iter().map(|problem| places_of(&problem.wishes)).collect();
    let mut found = vec![vec![PlanarTransform::IDENTITY]; n_interactions];
    for nth in problem.in_time() {
        let interaction = &problem.interactions[nth];
        let sights: Vec<Sight> = interaction
            .members
            .iter()
            .filter_map(|member| {
                let guess = guess(&known[member.character], interaction.frame, frame_secs)?;
                let (world_from_torso, slack_m, slack_rad) = guess;
                Some(Sight {
                    interaction_from_torso: member.interaction_from_torso,
                    world_from_torso,
                    per_m2: 1.0 / (slack_m * slack_m),
                    per_rad2: 1.0 / (slack_rad * slack_rad),
                })
            })
            .collect();
        if let Some(fit) = Fit::new(&sights) {
            let minima = fit.minima();
            let best = minima.first().map_or(0.0, |(_, cost)| *cost);
            let likely = minima.iter().filter(|(_, cost)| *cost <= best + MAX_WORSE);
            let mut candidates: Vec<PlanarTransform> =
                likely.take(MAX_HYPOTHESES).map(|(heading, _)| fit.place(*heading)).collect();
            if let Some((_, candidate)) = chosen.filter(|(chosen, _)| *chosen == nth) {
                candidates = candidates.get(candidate).copied().into_iter().collect();
            }
            if !candidates.is_empty() {
                found[nth] = candidates;
            }
        }
        for member in &interaction.members {
            let place = found[nth][0] * member.interaction_from_torso;
            let places = &mut known[member.character];
            let at = places.partition_point(|(frame, _)| *frame <= interaction.frame);
            places.insert(at, (interaction.frame, place));
        }
    }
    found
}

/// Places that are asked for, in the order of their frames.
fn places_of(wishes: &Wishes) -> Vec<(u32, PlanarTransform)> {
    let poses = wishes.poses.iter().filter_map(|pose| pose.place());
    let mut places: Vec<(u32, PlanarTransform)> = wishes
        .body
        .iter()
        .copied()
        .chain(poses)
        .filter(|place| place.tolerance.position_m.is_finite())
        .map(|place| (place.frame, place.world_from_torso()))
        .collect();
    places.sort_by_key(|(frame, _)| *frame);
    places
}

/// Where somebody with these places should about be at `frame`, and the slacks in metres and
/// radians.
fn guess(
    places: &[(u32, PlanarTransform)],
    frame: u32,
    frame_secs: f32,
) -> Option<(PlanarTransform, f32, f32)> {
    let after = places.partition_point(|(at, _)| *at < frame);
    let (before, after) = (after.checked_sub(1).map(|nth| places[nth]), places.get(after));
    let secs_to = |at: u32| frame.abs_diff(at) as f32 * frame_secs;
    let (place, secs) = match (before, after) {
        (Some((start, from)), Some(&(end, to))) => {
            let t = (frame - start) as f32 / (end - start).max(1) as f32;
            let ground_m = from.ground_m().lerp(to.ground_m(), t);
            let way = to.ground_m() - from.ground_m();
            let turn = wrap_angle_rad(to.heading_rad() - from.heading_rad());
            let heading_rad = if way.length() >= MIN_WAY_M && frame < end {
                way.x.atan2(way.y)
            } else {
                from.heading_rad() + t * turn
            };
            let place = PlanarTransform::new(heading_rad, ground_m, 0.0);
            (place, secs_to(start).min(secs_to(end)))
        }
        (Some((at, place)), None) | (None, Some(&(at, place))) => (place, secs_to(at)),
        (None, None) => return None,
    };
    Some((place, SLACK_M + SLACK_M_S * secs, SLACK_RAD + SLACK_RAD_S * secs))
}

#[cfg(test)]
mod tests {
    use glam::Vec2;

    use super::*;
    use crate::cast::testing::{checkpoint, meeting, problem};

    const FRAME_SECS: f32 = 1.0 / 30.0;

    #[test]
    fn two_who_come_towards_each_other_meet_in_the_middle() {
        let cast = CastProblem {
            characters: vec![
                problem(vec![checkpoint(0, -3.0, 0.0, 90.0)]),
                problem(vec![checkpoint(0, 3.0, 0.0, 270.0)]),
            ],
            interactions: vec![meeting(90, 1.0)],
        };
        let place = hypotheses(&cast, FRAME_SECS)[0][0];
        let at = |nth: usize| {
            (place * cast.interactions[0].members[nth].interaction_from_torso).ground_m()
        };
        assert!(at(0).distance(Vec2::new(-0.5, 0.0)) < 0.01, "{:?}", at(0));
        assert!(at(1).distance(Vec2::new(0.5, 0.0)) < 0.01, "{:?}", at(1));
        assert!((place.heading_rad().to_degrees() - 90.0).abs() < 1.0, "they face each other");
    }

    #[test]
    fn who_is_said_to_be_somewhere_at_that_time_has_the_others_come() {
        let cast = CastProblem {
            characters: vec![
                problem(vec![checkpoint(0, 0.0, 0.0, 0.0), checkpoint(90, 0.0, 3.0, 0.0)]),
                problem(vec![checkpoint(0, 2.0, 0.0, 0.0)]),
            ],
            interactions: vec![meeting(90, 1.0)],
        };
        let place = hypotheses(&cast, FRAME_SECS)[0][0];
        assert!(place.ground_m().distance(Vec2::new(0.0, 3.0)) < 0.5, "{place:?}");
    }

    #[test]
    fn nobody_who_is_anywhere_leaves_it_where_the_world_begins() {
        let cast = CastProblem {
            characters: vec![problem(vec![]), problem(vec![])],
            interactions: vec![meeting(30, 1.0)],
        };
        assert_eq!(hypotheses(&cast, FRAME_SECS), [[PlanarTransform::IDENTITY]]);
    }

    #[test]
    fn the_next_interaction_is_sought_from_where_the_one_before_was() {
        let cast = CastProblem {
            characters: vec![problem(vec![checkpoint(0, 5.0, 5.0, 0.0)]), problem(vec![])],
            interactions: vec![meeting(120, 1.0), meeting(60, 1.0)],
        };
        let places = &hypotheses(&cast, FRAME_SECS)[0];
        assert!(places[0].ground_m().distance(places[1].ground_m()) < 1e-3, "{places:?}");
        assert!(places[0].ground_m().distance(Vec2::new(5.0, 5.0)) < 1e-3, "{places:?}");
    }
}
