//! What a motion stands on, and soles against it.

use glam::Vec3;

use crate::assemble::Assembled;
use crate::contacts::Side;
use crate::floor::{self, Soles};
use crate::ground::{Contacts, GroundTrack};
use crate::motion::Motion;
use crate::skeleton::Skeleton;

/// The definition of `ground_penetration_max_cm`.
pub const PENETRATION_DEFINITION: &str = "deepest that a sole (toe joint less the sole's height) \
     is below the support of its frame; frames in which the support rises or falls by more than \
     1 cm in 0.3 s do not count, since feet there stand on two levels";

/// The definition of `float_max_cm`.
pub const FLOAT_DEFINITION: &str = "highest that the sole of a planted foot is above the support \
     of its frame; frames in which the support rises or falls by more than 1 cm in 0.3 s do not \
     count";

/// What a motion stands on, frame by frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Support {
    /// Height of the support, metres.
    pub levels_m: Vec<f32>,
    /// Planted feet.
    pub contacts: Vec<Contacts>,
    /// Height of the toe joints above what they stand on.
    pub soles: Soles,
}

impl Support {
    /// The support that an assembled motion carries.
    pub fn of_assembled(made: &Assembled, soles: Soles) -> Self {
        Self { levels_m: made.levels_m.clone(), contacts: made.contacts.clone(), soles }
    }

    /// The support of a clip, from its track.
    pub fn of_track(track: &GroundTrack, soles: Soles) -> Self {
        let levels_m = track.world_from_torso.iter().map(|torso| torso.level_m).collect();
        Self { levels_m, contacts: track.contacts.clone(), soles }
    }

    /// The support found from a motion's own plants, its floor being wherever they stand.
    pub fn found_in(skeleton: &Skeleton, motion: &Motion) -> Self {
        let mut lowered = [motion.clone()];
        let found = floor::calibrate_reported(skeleton, &mut lowered);
        let floor_m = found.clips[0].floor_m;
        let mut support = Self::of_track(&found.tracks[0], found.soles);
        for level in &mut support.levels_m {
            *level += floor_m;
        }
        support
    }

    /// Whether the support stays within 1 cm for 0.15 s either way, at `fps` frames a second.
    fn is_even(&self, frame: usize, reach: usize) -> bool {
        let last = self.levels_m.len() - 1;
        [frame.saturating_sub(reach), (frame + reach).min(last)]
            .into_iter()
            .all(|other| (self.levels_m[other] - self.levels_m[frame]).abs() < 0.01)
    }
}

/// Deepest that a sole is below its support, metres; at least 0. `None` without feet.
pub fn penetration_max_m(toes: &Toes, support: &Support) -> Option<f32> {
    let reach = toes.fps.frames_in_secs(0.15);
    let deepest = heights_m(toes, support)
        .filter(|&(frame, _, _)| support.is_even(frame, reach))
        .map(|(_, _, height_m)| -height_m)
        .reduce(f32::max)?;
    Some(deepest.max(0.0))
}

/// Highest that a planted sole is above its support, metres; at least 0. `None` without plants.
pub fn float_max_m(toes: &Toes, support: &Support) -> Option<f32> {
    let reach = toes.fps.frames_in_secs(0.15);
    let highest = heights_m(toes, support)
        .filter(|&(frame, side, _)| support.contacts[frame].side(side))
        .filter(|&(frame, _, _)| support.is_even(frame, reach))
        .map(|(_, _, height_m)| height_m)
        .reduce(f32::max)?;
    Some(highest.max(0.0))
}

/// Height of each foot's sole above its frame's support.
fn heights_m<'a>(
    toes: &'a Toes,
    support: &'a Support,
) -> impl Iterator<Item = (usize, Side, f32)> + 'a {
    Side::BOTH.into_iter().flat_map(move |side| {
        let sole_m = support.soles.height_m[side.idx()];
        toes.path_m(side)
            .iter()
            .zip(&support.levels_m)
            .enumerate()
            .map(move |(frame, (toe, level_m))| (frame, side, toe.y - sole_m - level_m))
    })
}

/// The paths of both toe joints; empty for a foot that the body does not have.
#[derive(Clone, Debug, PartialEq)]
pub struct Toes {
    /// World positions per frame, metres, by [`Side::idx`].
    pub paths_m: [Vec<Vec3>; 2],
    /// The rate of the motion.
    pub fps: crate::units::Fps,
}

impl Toes {
    /// One foot's path.
    pub fn path_m(&self, side: Side) -> &[Vec3] {
        &self.paths_m[side.idx()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Fps;

    fn toes(heights: &[f32]) -> Toes {
        let path = heights.iter().map(|&y| Vec3::new(0.0, y, 0.0)).collect();
        Toes { paths_m: [path, Vec::new()], fps: Fps::THIRTY }
    }

    fn support(levels_m: Vec<f32>) -> Support {
        let contacts = vec![Contacts { left: true, right: false }; levels_m.len()];
        Support { levels_m, contacts, soles: Soles { height_m: [0.03, 0.02] } }
    }

    #[test]
    fn soles_are_measured_against_their_support() {
        let toes = toes(&[0.03, 0.05, 0.00, 0.03]);
        let floor = support(vec![0.0; 4]);
        assert!(penetration_max_m(&toes, &floor).is_some_and(|m| (m - 0.03).abs() < 1e-6));
        assert!(float_max_m(&toes, &floor).is_some_and(|m| (m - 0.02).abs() < 1e-6));
        let low = support(vec![-0.1; 4]);
        assert_eq!(penetration_max_m(&toes, &low), Some(0.0));
    }

    #[test]
    fn frames_between_levels_do_not_count() {
        let steps = support(vec![0.0, 0.1, 0.2, 0.3]);
        assert_eq!(penetration_max_m(&toes(&[0.0; 4]), &steps), None);
    }

    #[test]
    fn a_foot_in_the_air_does_not_float() {
        let mut flying = support(vec![0.0; 4]);
        flying.contacts.fill(Contacts::default());
        assert_eq!(float_max_m(&toes(&[0.5; 4]), &flying), None);
    }
}
