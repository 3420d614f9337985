//! Floors: each clip's floor brought to height 0, and the height of what supports the body in
//! every frame (`docs/method.md`, A1).
//!
//! Capture floors differ by a few centimetres per clip, and toe joints sit at different heights
//! in the two feet. [`calibrate`] estimates one sole height per foot over the whole set and one
//! floor per clip from its plants, shifts the clip, and then follows what the planted feet stand
//! on: 0 on the floor, the height of the step on a step, passing smoothly from one to the other.

use glam::Vec3;

use crate::contacts::{self, Side, Still, percentile};
use crate::ground::{Contacts, GroundTrack};
use crate::ids::JointIdx;
use crate::motion::Motion;
use crate::skeleton::{JointRole, Skeleton};
use crate::support_level::{Plant, levels_m};

/// A plant within this of the floor stands on the floor, metres.
pub const FLOOR_SNAP_M: f32 = 0.08;

/// A foot off the floor bears the body only where the hips rise above it to this share of
/// their standing height: a foot raised for a kick does not, a foot that climbs a step does.
pub const BEARING_SHARE: f32 = 0.85;

/// A foot bears the body off the floor for at least this long, seconds; feet at the top of a
/// jump are still for less.
pub const BEARING_SECS: f64 = 0.2;

/// A sole is no higher than this share of the leg; what is more is the floor's doing.
const MAX_SOLE_SHARE: f32 = 0.12;

/// Height of each toe joint above what it stands on, metres; indexed by [`Side::idx`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Soles {
    /// Left, right.
    pub height_m: [f32; 2],
}

/// What calibration did to one clip.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ClipFloor {
    /// Height of the floor as captured, metres: the clip was lowered by it.
    pub floor_m: f32,
    /// Plants that the floor was found from; 0 where the lowest toe had to do.
    pub n_floor_plants: usize,
    /// Plants on something else that bore the body (steps, stools).
    pub n_raised_plants: usize,
    /// Highest support in the clip, metres.
    pub highest_m: f32,
}

/// What [`calibrate`] found, for a report.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Calibration {
    /// One track per motion, in order.
    pub tracks: Vec<GroundTrack>,
    /// Sole heights over the whole set.
    pub soles: Soles,
    /// One entry per motion, in order.
    pub clips: Vec<ClipFloor>,
}

/// [`calibrate_reported`] without the report.
pub fn calibrate(skeleton: &Skeleton, motions: &mut [Motion]) -> Vec<GroundTrack> {
    calibrate_reported(skeleton, motions).tracks
}

/// Finds each clip's floor, lowers the clip so that it is at height 0, and follows its support.
///
/// * **Soles.** Each foot's sole height is the median over clips of the height at which its
///   lowest plants stand: the floors of a set are 0 on the whole. It is kept within
///   0–12 % of the leg's length, so that a set captured on a high floor is lowered too.
/// * **Floor.** A clip's floor is the mean over feet of its lowest plants' height less the sole;
///   its lowest plants are those within [`FLOOR_SNAP_M`] of the lowest. A clip without plants is
///   lowered by its lowest toe (1st percentile). Without recognised feet nothing is moved.
/// * **Contacts.** Spells in which a foot is held still, on the floor or on something that bears
///   the body ([`BEARING_SHARE`], [`BEARING_SECS`]).
/// * **Level.** Planted feet within [`FLOOR_SNAP_M`] of the floor are at exactly 0, others at
///   their own height; where feet differ each counts less towards the ends of its plant; flights
///   go from one support to the next. A triangle of ± 0.35 s then smooths the series, so
///   that floors stay exactly 0 and a step of 0.2 m is taken at no more than 0.6 m/s.
pub fn calibrate_reported(skeleton: &Skeleton, motions: &mut [Motion]) -> Calibration {
    let toes = Side::BOTH.map(|side| contacts::toe_joint(skeleton, side));
    let mut feet: Vec<[Vec<Still>; 2]> = motions
        .iter()
        .map(|motion| {
            toes.map(|toe| match toe {
                Some(toe) => contacts::stills(&motion.joint_path_m(skeleton, toe), motion.fps()),
                None => Vec::new(),
            })
        })
        .collect();
    let lowest: Vec<[Option<f32>; 2]> = feet.iter().map(lowest_plants_m).collect();
    let soles = Soles { height_m: Side::BOTH.map(|side| sole_m(skeleton, &lowest, side)) };

    let mut clips = vec![ClipFloor::default(); motions.len()];
    for (idx, motion) in motions.iter_mut().enumerate() {
        let floor_m = floor_of_plants_m(&lowest[idx], soles)
            .unwrap_or_else(|| floor_of_lowest_toe_m(skeleton, motion, toes, soles));
        clips[idx].floor_m = floor_m;
        for position in motion.root_positions_m_mut() {
            position.y -= floor_m;
        }
        for (side, stills) in Side::BOTH.into_iter().zip(&mut feet[idx]) {
            for still in stills {
                still.height_m -= floor_m + soles.height_m[side.idx()];
            }
        }
    }

    let standing_m = standing_height_m(skeleton, motions, &feet);
    let tracks = motions
        .iter()
        .enumerate()
        .map(|(idx, motion)| {
            let plants = bearing_plants(skeleton, motion, &feet[idx], standing_m);
            let clip = &mut clips[idx];
            clip.n_floor_plants = plants.iter().filter(|plant| plant.level_m == 0.0).count();
            clip.n_raised_plants = plants.len() - clip.n_floor_plants;
            let levels = levels_m(&plants, motion.n_frames(), motion.fps());
            clip.highest_m = levels.iter().copied().fold(0.0, f32::max);
            let mut planted = vec![Contacts::default(); motion.n_frames()];
            for plant in &plants {
                for contacts in &mut planted[plant.frames.clone()] {
                    contacts.set_side(plant.side, true);
                }
            }
            GroundTrack::new(motion, &levels, planted)
        })
        .collect();
    Calibration { tracks, soles, clips }
}

/// Sole heights of motions that are calibrated already: the median height of each toe joint
/// above its frame's level over all frames in which it is planted, 0 for a foot never planted.
pub fn soles_of<'a>(
    skeleton: &Skeleton,
    clips: impl IntoIterator<Item = (&'a Motion, &'a GroundTrack)>,
) -> Soles {
    let toes = Side::BOTH.map(|side| contacts::toe_joint(skeleton, side));
    let mut heights: [Vec<f32>; 2] = [Vec::new(), Vec::new()];
    for (motion, track) in clips {
        for side in Side::BOTH {
            let Some(toe) = toes[side.idx()] else { continue };
            // On steps the level passes smoothly from plant to plant and fits neither exactly.
            let on_floor = track.world_from_torso.iter().zip(&track.contacts);
            let path = motion.joint_path_m(skeleton, toe);
            heights[side.idx()].extend(
                path.iter()
                    .zip(on_floor)
                    .filter(|(_, (torso, planted))| planted.side(side) && torso.level_m == 0.0)
                    .map(|(toe, _)| toe.y),
            );
        }
    }
    Soles { height_m: heights.map(|mut heights| percentile(&mut heights, 0.5)) }
}

/// Height at which each foot's lowest plants of a clip stand, metres.
fn lowest_plants_m(feet: &[Vec<Still>; 2]) -> [Option<f32>; 2] {
    let mut all: Vec<f32> = feet.iter().flatten().flat_map(per_frame).collect();
    if all.is_empty() {
        return [None, None];
    }
    let ceiling = percentile(&mut all, 0.02) + FLOOR_SNAP_M;
    [&feet[0], &feet[1]].map(|stills| {
        let mut low: Vec<f32> =
            stills.iter().flat_map(per_frame).filter(|&height| height <= ceiling).collect();
        (!low.is_empty()).then(|| percentile(&mut low, 0.5))
    })
}

/// A spell's height once per frame, so that medians weigh plants by how long they last.
fn per_frame(still: &Still) -> impl Iterator<Item = f32> + use<> {
    std::iter::repeat_n(still.height_m, still.frames.len())
}

/// A foot's sole height over a set of clips, metres.
fn sole_m(skeleton: &Skeleton, lowest: &[[Option<f32>; 2]], side: Side) -> f32 {
    let mut heights: Vec<f32> = lowest.iter().filter_map(|feet| feet[side.idx()]).collect();
    let limit = MAX_SOLE_SHARE * skeleton.leg_length_m().unwrap_or(0.0);
    percentile(&mut heights, 0.5).clamp(0.0, limit)
}

fn floor_of_plants_m(lowest: &[Option<f32>; 2], soles: Soles) -> Option<f32> {
    let feet: Vec<f32> =
        lowest.iter().zip(soles.height_m).filter_map(|(h, sole)| h.map(|h| h - sole)).collect();
    (!feet.is_empty()).then(|| feet.iter().sum::<f32>() / feet.len() as f32)
}

/// The floor of a clip whose feet never rest: under its lowest toe; 0 without feet.
fn floor_of_lowest_toe_m(
    skeleton: &Skeleton,
    motion: &Motion,
    toes: [Option<JointIdx>; 2],
    soles: Soles,
) -> f32 {
    let lowest = Side::BOTH.into_iter().filter_map(|side| {
        let path = motion.joint_path_m(skeleton, toes[side.idx()]?);
        let mut heights: Vec<f32> = path.iter().map(|p| p.y).collect();
        Some(percentile(&mut heights, 0.01) - soles.height_m[side.idx()])
    });
    lowest.reduce(f32::min).unwrap_or(0.0)
}

/// How high the hips rise above the sole over a spell (90th percentile), metres.
fn hips_rise_m(hips_path_m: &[Vec3], still: &Still) -> f32 {
    let mut rise: Vec<f32> =
        hips_path_m[still.frames.clone()].iter().map(|p| p.y - still.height_m).collect();
    percentile(&mut rise, 0.9)
}

/// Where the hips are when the body stands on the floor, metres above it.
fn standing_height_m(skeleton: &Skeleton, motions: &[Motion], feet: &[[Vec<Still>; 2]]) -> f32 {
    let mut rises = Vec::new();
    for (motion, feet) in motions.iter().zip(feet) {
        let hips = hips_path_m(skeleton, motion);
        for still in feet.iter().flatten().filter(|s| s.height_m.abs() <= FLOOR_SNAP_M) {
            rises.push(hips_rise_m(&hips, still));
        }
    }
    percentile(&mut rises, 0.5)
}

fn hips_path_m(skeleton: &Skeleton, motion: &Motion) -> Vec<Vec3> {
    match skeleton.by_role(JointRole::Hips) {
        Some(hips) => motion.joint_path_m(skeleton, hips),
        None => motion.root_positions_m().to_vec(),
    }
}

/// The spells that bear the body, in order of their start.
fn bearing_plants(
    skeleton: &Skeleton,
    motion: &Motion,
    feet: &[Vec<Still>; 2],
    standing_m: f32,
) -> Vec<Plant> {
    let hips = hips_path_m(skeleton, motion);
    let min_frames = contacts::min_frames(BEARING_SECS, motion.fps());
    let mut plants = Vec::new();
    for (side, stills) in Side::BOTH.into_iter().zip(feet) {
        for still in stills {
            let on_floor = still.height_m.abs() <= FLOOR_SNAP_M;
            let bears = || {
                still.frames.len() >= min_frames
                    && hips_rise_m(&hips, still) >= BEARING_SHARE * standing_m
            };
            if on_floor || bears() {
                let level_m = if on_floor { 0.0 } else { still.height_m };
                plants.push(Plant { side, frames: still.frames.clone(), level_m });
            }
        }
    }
    plants.sort_by_key(|plant| (plant.frames.start, plant.side));
    plants
}

#[cfg(test)]
mod tests {
    use glam::Quat;
    use proptest::prelude::*;

    use super::*;
    use crate::testing::{TOE_BELOW_HIPS_M, joint, legs};
    use crate::units::Fps;

    /// The stiff body stands for 1 s with its toe joints at each height in turn and jumps 0.5 m
    /// ahead in between (0.4 s, 0.3 m up).
    fn jumps(toe_heights_m: &[f32]) -> Motion {
        let mut hips = Vec::new();
        for (idx, &height) in toe_heights_m.iter().enumerate() {
            let at = |z: f32, y: f32| Vec3::new(0.0, y + TOE_BELOW_HIPS_M, z);
            let z = 0.5 * idx as f32;
            hips.extend((0..30).map(|_| at(z, height)));
            let Some(&next) = toe_heights_m.get(idx + 1) else { break };
            for frame in 1..12 {
                let t = frame as f32 / 12.0;
                let arc = 0.3 * (std::f32::consts::PI * t).sin();
                hips.push(at(z + 0.5 * t, height + (next - height) * t + arc));
            }
        }
        let rotations = vec![Quat::IDENTITY; hips.len() * 9];
        Motion::new(Fps::THIRTY, 9, hips, rotations).expect("valid by construction")
    }

    fn levels(track: &GroundTrack) -> Vec<f32> {
        track.world_from_torso.iter().map(|torso| torso.level_m).collect()
    }

    #[test]
    fn floors_of_all_clips_come_to_zero() {
        // Floors as captured: 0, 4 cm low, 7 cm high; soles at 3 cm.
        let mut clips = [0.03, -0.01, 0.10].map(|toe| jumps(&[toe, toe]));
        let found = calibrate_reported(&legs(), &mut clips);
        for (clip, floor) in clips.iter().zip([0.0, -0.04, 0.07]) {
            let stand = clip.root_positions_m()[0].y - TOE_BELOW_HIPS_M;
            assert!((stand - 0.03).abs() < 1e-5, "toe joint {stand} m above floor {floor}");
        }
        assert_eq!(found.soles.height_m.map(|h| (h * 1e4).round()), [300.0; 2]);
        assert!(found.tracks.iter().all(|track| levels(track).iter().all(|&l| l == 0.0)));
    }

    #[test]
    fn a_jump_between_floor_plants_stays_at_level_zero() {
        let track = &calibrate(&legs(), &mut [jumps(&[0.03; 4])])[0];
        assert!(levels(track).iter().all(|&level| level == 0.0));
        assert!(track.contacts[10].left && track.contacts[10].right);
        assert!(!track.contacts[35].any(), "in flight");
    }

    #[test]
    fn the_top_of_a_jump_on_the_spot_is_no_step() {
        let mut hips = vec![TOE_BELOW_HIPS_M + 0.03; 30];
        // 0.4 s in the air, 0.2 m up.
        hips.extend((1..12).map(|f| {
            let t = f as f32 / 30.0;
            TOE_BELOW_HIPS_M + 0.03 + 9.81 * 0.5 * t * (0.4 - t)
        }));
        hips.extend(vec![TOE_BELOW_HIPS_M + 0.03; 30]);
        let rotations = vec![Quat::IDENTITY; hips.len() * 9];
        let roots = hips.into_iter().map(|y| Vec3::Y * y).collect();
        let jump = Motion::new(Fps::THIRTY, 9, roots, rotations).expect("valid by construction");
        let track = &calibrate(&legs(), &mut [jump])[0];
        assert!(levels(track).iter().all(|&level| level == 0.0));
        assert!(!track.contacts[35].any(), "in flight");
    }

    #[test]
    fn steps_raise_the_level_smoothly() {
        let mut clips = [jumps(&[0.03, 0.03, 0.23, 0.43, 0.03])];
        let found = calibrate_reported(&legs(), &mut clips);
        let levels = levels(&found.tracks[0]);
        for (stand, expected) in [(15, 0.0), (56, 0.0), (97, 0.2), (138, 0.4), (185, 0.0)] {
            assert!((levels[stand] - expected).abs() < 5e-3, "frame {stand}: {}", levels[stand]);
        }
        let fastest = levels.windows(2).map(|w| (w[1] - w[0]).abs() * 30.0).fold(0.0, f32::max);
        assert!(fastest < 1.2, "{fastest} m/s");
        assert_eq!((found.clips[0].n_floor_plants, found.clips[0].n_raised_plants), (6, 4));
    }

    #[test]
    fn a_few_centimetres_are_still_the_floor() {
        let track = &calibrate(&legs(), &mut [jumps(&[0.03, 0.08, 0.03, 0.03])])[0];
        assert!(levels(track).iter().all(|&level| level == 0.0));
    }

    #[test]
    fn a_raised_foot_does_not_bear_the_body() {
        let skeleton = legs();
        let mut motion = jumps(&[0.03, 0.03]);
        let n_frames = motion.n_frames();
        for frame in n_frames - 25..n_frames {
            // The right thigh forward and up: its toe is held still 0.8 m above the floor.
            motion.rotations_mut(frame)[5] = Quat::from_rotation_x(-1.5);
        }
        let track = &calibrate(&skeleton, &mut [motion])[0];
        let last = track.contacts[n_frames - 3];
        assert!(last.left && !last.right, "{last:?}");
        assert_eq!(levels(track)[n_frames - 3], 0.0);
    }

    #[test]
    fn without_feet_nothing_moves() {
        let skeleton =
            Skeleton::new(vec![joint("root", None, [0.0; 3])]).expect("valid by construction");
        let at = vec![Vec3::new(0.0, 0.7, 0.0); 20];
        let rotations = vec![Quat::IDENTITY; 20];
        let motion = Motion::new(Fps::THIRTY, 1, at, rotations).expect("valid by construction");
        let mut moved = [motion.clone()];
        let track = &calibrate(&skeleton, &mut moved)[0];
        assert_eq!(moved[0], motion);
        assert!(levels(track).iter().all(|&level| level == 0.0));
        assert_eq!(calibrate(&skeleton, &mut []), []);
    }

    #[test]
    fn calibrating_again_changes_nothing() {
        let mut clips = [0.03, -0.01, 0.10, 0.04].map(|toe| jumps(&[toe, toe + 0.2, toe]));
        let first = calibrate(&legs(), &mut clips);
        let once = clips.clone();
        let second = calibrate(&legs(), &mut clips);
        for (a, b) in once.iter().zip(&clips) {
            let moved = (a.root_positions_m()[0] - b.root_positions_m()[0]).length();
            assert!(moved < 1e-5, "{moved} m");
        }
        assert_eq!(first[0].contacts, second[0].contacts);
    }

    #[test]
    fn soles_are_read_back() {
        let mut clips = [jumps(&[0.03, 0.03])];
        let found = calibrate_reported(&legs(), &mut clips);
        let soles = soles_of(&legs(), clips.iter().zip(&found.tracks));
        for (read, known) in soles.height_m.into_iter().zip(found.soles.height_m) {
            assert!((read - known).abs() < 1e-4, "{read} against {known}");
        }
    }

    proptest! {
        #[test]
        fn any_path_is_answered(
            steps in prop::collection::vec((-0.1f32..0.1, -0.1f32..0.1, -0.05f32..0.05), 1..150),
        ) {
            let mut at = Vec3::new(0.0, 0.9, 0.0);
            let path: Vec<Vec3> = steps
                .iter()
                .map(|&(x, y, z)| { at += Vec3::new(x, y, z); at })
                .collect();
            let n_frames = path.len();
            let rotations = vec![Quat::IDENTITY; n_frames * 9];
            let motion = Motion::new(Fps::THIRTY, 9, path, rotations).expect("finite");
            let track = &calibrate(&legs(), &mut [motion])[0];
            prop_assert_eq!(track.contacts.len(), n_frames);
            prop_assert!(levels(track).iter().all(|level| level.is_finite()));
        }
    }
}
