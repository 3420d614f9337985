//! Where the finished motion must be: checkpoints and places of poses as targets of the assembler.
//!
//! A checkpoint may leave its heading open, a pose its place or its heading. What is open goes along
//! with what the targets around it ask: the correction there is that of its neighbours, between them
//! in proportion to time. So nothing is bent for what nobody asked.

use glam::Vec2;
use motion_core::assemble::BodyTarget;
use motion_core::constraint::BodyConstraint;
use motion_core::planar::{PlanarTransform, wrap_angle_rad};
use motion_core::score::Wishes;
use motion_core::units::FrameIdx;

/// What is asked of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Wanted {
    frame: u32,
    ground_m: Option<Vec2>,
    heading_rad: Option<f32>,
    level_m: Option<f32>,
}

impl Wanted {
    fn of(constraint: &BodyConstraint, frame: u32) -> Self {
        let tolerance = constraint.tolerance;
        Self {
            frame,
            ground_m: tolerance.position_m.is_finite().then_some(constraint.position_m),
            heading_rad: tolerance.heading_rad.is_finite().then_some(constraint.heading_rad),
            level_m: constraint.height_m,
        }
    }

    /// With what `other` asks of the same frame in the place of what this asks.
    fn but_for(self, other: Self) -> Self {
        Self {
            frame: self.frame,
            ground_m: other.ground_m.or(self.ground_m),
            heading_rad: other.heading_rad.or(self.heading_rad),
            level_m: other.level_m.or(self.level_m),
        }
    }
}

/// The frame at which the body constraint `nth` is read in a motion of `n_frames`: its own, but
/// the last one's is the motion's last.
pub(crate) fn read_at(wishes: &Wishes, nth: usize, n_frames: u32) -> u32 {
    let body = &wishes.body;
    let is_last = nth > 0 && nth + 1 == body.len();
    if is_last { n_frames.saturating_sub(1) } else { body[nth].frame }
}

/// Targets for a motion that is at `raw` before it is corrected, frame by frame.
///
/// A motion may end just where an inner checkpoint stands; the last one then has the frame to itself.
/// The place of a pose goes before that of a checkpoint at the same frame.
pub(super) fn targets(wishes: &Wishes, raw: &[PlanarTransform]) -> Vec<BodyTarget> {
    let n_frames = raw.len() as u32;
    let mut wanted: Vec<Wanted> = Vec::with_capacity(wishes.body.len() + wishes.poses.len());
    for (nth, constraint) in wishes.body.iter().enumerate() {
        let frame = read_at(wishes, nth, n_frames);
        wanted.retain(|before| before.frame < frame);
        wanted.push(Wanted::of(constraint, frame));
    }
    for place in wishes.poses.iter().filter_map(|pose| pose.place()) {
        let asked = Wanted::of(&place, place.frame);
        match wanted.iter_mut().find(|known| known.frame == place.frame) {
            Some(known) => *known = known.but_for(asked),
            None => wanted.push(asked),
        }
    }
    wanted.retain(|asked| asked.frame < n_frames);
    wanted.sort_by_key(|asked| asked.frame);
    let moves: Vec<(u32, Vec2)> = wanted
        .iter()
        .filter_map(|asked| {
            Some((asked.frame, asked.ground_m? - raw[asked.frame as usize].ground_m()))
        })
        .collect();
    let turns: Vec<(u32, f32)> = wanted
        .iter()
        .filter_map(|asked| {
            let is_rad = raw[asked.frame as usize].heading_rad();
            Some((asked.frame, wrap_angle_rad(asked.heading_rad? - is_rad)))
        })
        .collect();
    let target = |asked: &Wanted| {
        let here = raw[asked.frame as usize];
        let ground_m = asked.ground_m.unwrap_or_else(|| {
            here.ground_m() + between(&moves, asked.frame, |a, b, t| a.lerp(b, t))
        });
        let heading_rad = asked.heading_rad.unwrap_or_else(|| {
            let turn_rad = between(&turns, asked.frame, |a, b, t| a + t * wrap_angle_rad(b - a));
            here.heading_rad() + turn_rad
        });
        let level_m = asked.level_m.unwrap_or(0.0);
        BodyTarget {
            frame: FrameIdx(asked.frame),
            world_from_torso: PlanarTransform::new(heading_rad, ground_m, level_m),
            height: asked.level_m.is_some(),
        }
    };
    wanted.iter().map(target).collect()
}

/// The value at `frame` between the known ones around it; the nearest beyond the ends, nothing where
/// none is known.
fn between<T: Copy + Default>(known: &[(u32, T)], frame: u32, mix: impl Fn(T, T, f32) -> T) -> T {
    let after = known.partition_point(|(at, _)| *at < frame);
    match (after.checked_sub(1).and_then(|before| known.get(before)), known.get(after)) {
        (Some(&(from, a)), Some(&(to, b))) => {
            mix(a, b, (frame - from) as f32 / (to - from).max(1) as f32)
        }
        (Some(&(_, only)), None) | (None, Some(&(_, only))) => only,
        (None, None) => T::default(),
    }
}

/// Frames whose poses must stay as they are in their clips: those of poses, and the ends of locked
/// stretches. Within a locked stretch its own cuts are smoothed as they were; what is before and behind it does not
/// reach over its ends.
pub(super) fn hard_frames(wishes: &Wishes) -> Vec<FrameIdx> {
    let poses = wishes.poses.iter().map(|pose| pose.frame);
    let locks = wishes.locks.iter().flat_map(|lock| [lock.from, lock.to]);
    let mut frames: Vec<u32> = poses.chain(locks).collect();
    frames.sort_unstable();
    frames.dedup();
    frames.into_iter().map(FrameIdx).collect()
}

#[cfg(test)]
mod tests {
    use motion_core::constraint::{LockConstraint, PoseConstraint, Tolerance};
    use motion_core::ids::ClipId;

    use super::*;

    fn checkpoint(frame: u32, x_m: f32, heading_rad: Option<f32>) -> BodyConstraint {
        let usual = Tolerance::default();
        let open = Tolerance { heading_rad: f32::INFINITY, ..usual };
        BodyConstraint {
            frame,
            position_m: Vec2::new(x_m, 0.0),
            heading_rad: heading_rad.unwrap_or_default(),
            height_m: None,
            weight: 1.0,
            tolerance: if heading_rad.is_some() { usual } else { open },
        }
    }

    /// A body that stands at the origin for so many frames.
    fn standing(n_frames: usize) -> Vec<PlanarTransform> {
        vec![PlanarTransform::IDENTITY; n_frames]
    }

    #[test]
    fn what_is_open_goes_along_with_what_is_asked_around_it() {
        let pose = PoseConstraint {
            heading_rad: Some(0.5),
            ..PoseConstraint::new(15, ClipId(0), FrameIdx(0))
        };
        let wishes = Wishes {
            body: vec![
                checkpoint(0, 0.0, Some(0.0)),
                checkpoint(10, 1.0, None),
                checkpoint(20, 3.0, Some(1.0)),
            ],
            poses: vec![pose, PoseConstraint::new(5, ClipId(0), FrameIdx(3))],
            ..Wishes::default()
        };
        let found = targets(&wishes, &standing(21));
        let told: Vec<(u32, f32, f32)> = found
            .iter()
            .map(|t| (t.frame.0, t.world_from_torso.ground_m().x, t.world_from_torso.heading_rad()))
            .collect();
        // The pose alone at frame 5 has no place; that at 15 lies halfway between 1 m and 3 m.
        let expected =
            [(0, 0.0, 0.0), (10, 1.0, 0.5 * 10.0 / 15.0), (15, 2.0, 0.5), (20, 3.0, 1.0)];
        assert_eq!(told.len(), expected.len(), "{told:?}");
        for (is, asked) in told.iter().zip(expected) {
            let apart = (is.1 - asked.1).abs().max((is.2 - asked.2).abs());
            assert!(is.0 == asked.0 && apart < 1e-5, "{is:?} is not {asked:?}");
        }
    }

    #[test]
    fn the_last_checkpoint_has_the_last_frame_to_itself_and_a_pose_goes_before_it() {
        let mut wishes = Wishes {
            body: vec![
                checkpoint(0, 0.0, Some(0.0)),
                checkpoint(9, 1.0, Some(0.1)),
                checkpoint(20, 3.0, Some(0.2)),
            ],
            ..Wishes::default()
        };
        let found = targets(&wishes, &standing(10));
        assert_eq!(found.iter().map(|t| t.frame.0).collect::<Vec<_>>(), [0, 9]);
        assert_eq!(found[1].world_from_torso.ground_m().x, 3.0);
        let here = Some(Vec2::new(7.0, 0.0));
        let pose =
            PoseConstraint { ground_m: here, ..PoseConstraint::new(9, ClipId(0), FrameIdx(0)) };
        wishes.poses.push(pose);
        let found = targets(&wishes, &standing(10));
        let at = found[1].world_from_torso;
        assert!((at.ground_m().x, at.heading_rad()) == (7.0, 0.2), "{at:?}");
    }

    #[test]
    fn poses_and_ends_of_locks_are_hard() {
        let wishes = Wishes {
            poses: vec![PoseConstraint::new(30, ClipId(0), FrameIdx(0))],
            locks: vec![LockConstraint { from: 10, to: 30, pieces: Vec::new() }],
            ..Wishes::default()
        };
        assert_eq!(hard_frames(&wishes), [FrameIdx(10), FrameIdx(30)]);
    }
}
