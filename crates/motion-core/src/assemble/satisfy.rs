//! Body targets met exactly: what is left of each error spread over the frames before it
//! (`docs/method.md`, A6).
//!
//! Let X be the planar transform of the world that carries the body from where it is at a
//! target's frame to where it should be. Frames between the previous target and this one are
//! moved by `exp(t · log X)`, t from 0 to 1, later frames by X: earlier targets stay met and what
//! follows moves rigidly. The number of frames does not change.

use super::place::{AssembleError, Placed};
use crate::ground::yaw_series_rad;
use crate::planar::{PlanarTransform, PlanarTwist, wrap_angle_rad};
use crate::units::{Fps, FrameIdx};

/// Where the body must be at a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyTarget {
    /// The frame of the motion.
    pub frame: FrameIdx,
    /// Heading and ground point asked for; the level too where `height` says so.
    pub world_from_torso: PlanarTransform,
    /// Whether the level is asked for.
    pub height: bool,
}

/// How t runs from 0 to 1 between two targets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SpreadPolicy {
    /// By the same step every frame, as the paper has it: a standing body slides along.
    Even,
    /// By the share of the way that the body has gone, with eased ends: steps become a little
    /// longer or shorter, a standing body stays.
    #[default]
    ByTravel,
}

/// How far the body is from a target.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TargetError {
    /// Distance on the ground, metres.
    pub position_m: f32,
    /// Smaller angle between the headings, radians.
    pub heading_rad: f32,
    /// Difference of the levels, metres; 0 where the target asks for none.
    pub level_m: f32,
}

/// A target counts as met within this, metres.
pub const MET_M: f32 = 3e-5;
/// A target counts as met within this, radians.
pub const MET_RAD: f32 = 2e-5;

/// Rounds of correction. One is enough where headings are well defined; a heading that is
/// interpolated through a roll depends on frames that the correction moves differently, and
/// comes nearer by a factor of two or so with every round.
const MAX_ROUNDS: usize = 40;
/// Travel below this speed counts as this, m/s: t must move even where nobody does.
const MIN_SPEED_M_S: f32 = 0.02;
/// A turn on the spot counts as travel on a circle of this radius, metres.
const TURN_RADIUS_M: f32 = 0.3;
/// Corrections ease in and out of inner targets over this time, seconds.
const EASE_SECS: f64 = 0.3;

/// Fails unless targets are in the order of their frames, all within `n_frames`.
pub fn check_targets(targets: &[BodyTarget], n_frames: usize) -> Result<(), AssembleError> {
    let mut earliest = 0;
    for (idx, target) in targets.iter().enumerate() {
        let frame = target.frame.idx();
        if frame < earliest || frame >= n_frames {
            return Err(AssembleError::Target { target: idx, frame: target.frame });
        }
        earliest = frame + 1;
    }
    Ok(())
}

/// The errors of a motion against its targets, as [`yaw_series_rad`] and the root's ground
/// projection measure them.
pub fn target_errors(placed: &Placed, targets: &[BodyTarget]) -> Vec<TargetError> {
    if targets.is_empty() {
        return Vec::new();
    }
    let yaw = yaw_series_rad(&placed.motion);
    targets
        .iter()
        .map(|target| {
            let here = torso(placed, &yaw, target.frame.idx());
            let there = target.world_from_torso;
            let turn = wrap_angle_rad(there.heading_rad() - here.heading_rad());
            TargetError {
                position_m: there.ground_m().distance(here.ground_m()),
                heading_rad: turn.abs(),
                level_m: if target.height { (there.level_m - here.level_m).abs() } else { 0.0 },
            }
        })
        .collect()
}

/// Moves the frames of `placed` so that every target is met. Targets are valid by
/// [`check_targets`].
///
/// Met within 1e-4 m and 0.01° wherever the heading of the target's frame is well defined
/// (certainty of at least ½), and in practice within rolls too.
pub fn satisfy(placed: &mut Placed, targets: &[BodyTarget], policy: SpreadPolicy) {
    let mut spreads: Option<Vec<Vec<f32>>> = None;
    let mut last_worst = f32::INFINITY;
    for _ in 0..MAX_ROUNDS {
        let worst = target_errors(placed, targets)
            .iter()
            .map(|error| {
                let ground = error.position_m.max(error.level_m) / MET_M;
                ground.max(error.heading_rad / MET_RAD)
            })
            .fold(0.0, f32::max);
        // Rounding, not geometry, is what is left once a round gains nothing.
        if worst <= 1.0 || worst > 0.95 * last_worst {
            return;
        }
        last_worst = worst;
        let spreads = spreads.get_or_insert_with(|| {
            let ends = std::iter::once(0).chain(targets.iter().map(|target| target.frame.idx()));
            ends.zip(targets)
                .enumerate()
                .map(|(idx, (from, target))| {
                    spread(placed, from, target.frame.idx(), idx > 0, policy)
                })
                .collect()
        });
        correct(placed, targets, spreads);
    }
}

/// One round of correction, in one pass over the frames.
fn correct(placed: &mut Placed, targets: &[BodyTarget], spreads: &[Vec<f32>]) {
    let yaw = yaw_series_rad(&placed.motion);
    let n_frames = placed.motion.n_frames();
    // What the targets so far have done to everything after them.
    let mut carried = PlanarTransform::IDENTITY;
    let mut from = 0;
    for (target, spread) in targets.iter().zip(spreads) {
        let to = target.frame.idx();
        let here = carried * torso(placed, &yaw, to);
        let mut there = target.world_from_torso;
        if !target.height {
            there.level_m = here.level_m;
        }
        let twist = (there * here.inverse()).log();
        // A target at the very first frame is met by placing: there is nothing to spread over.
        let first = if to == 0 { 0 } else { from + 1 };
        for frame in first..=to {
            let t = if to == 0 { 1.0 } else { spread[frame - from] };
            let step: PlanarTwist = twist.scaled(t);
            move_frame(placed, frame, step.exp() * carried);
        }
        carried = twist.exp() * carried;
        from = to;
    }
    let rest = if targets.is_empty() { n_frames } else { from + 1 };
    for frame in rest..n_frames {
        move_frame(placed, frame, carried);
    }
}

fn torso(placed: &Placed, yaw_rad: &[f32], frame: usize) -> PlanarTransform {
    let root = placed.motion.root_positions_m()[frame];
    PlanarTransform::new(yaw_rad[frame], glam::Vec2::new(root.x, root.z), placed.levels_m[frame])
}

/// Moves one frame in the world.
fn move_frame(placed: &mut Placed, frame: usize, world_from_world: PlanarTransform) {
    let root = &mut placed.motion.root_positions_m_mut()[frame];
    *root = world_from_world.apply(*root);
    let rotation = &mut placed.motion.rotations_mut(frame)[0];
    *rotation = (world_from_world.rotation() * *rotation).normalize();
    placed.levels_m[frame] += world_from_world.level_m;
}

/// t for the frames `from..=to`: 0 at the first, 1 at the last, never falling.
///
/// `ease_in` says that a target stands at `from`; the speed with which t rises then starts from
/// nothing, so that no target puts a kink into the path.
fn spread(
    placed: &Placed,
    from: usize,
    to: usize,
    ease_in: bool,
    policy: SpreadPolicy,
) -> Vec<f32> {
    let n_steps = to - from;
    let last = placed.motion.n_frames() - 1;
    let mut steps = vec![1.0f32; n_steps];
    if policy == SpreadPolicy::ByTravel {
        steps = smoothed_travel_m(placed, from, to);
        let fps = placed.motion.fps();
        let ease = fps.frames_in_secs(EASE_SECS).min(n_steps / 3).max(1) as f32;
        for (idx, step) in steps.iter_mut().enumerate() {
            let start = if ease_in { (idx as f32 + 0.5) / ease } else { 1.0 };
            let end = if to < last { (n_steps as f32 - idx as f32 - 0.5) / ease } else { 1.0 };
            let t = start.min(end).min(1.0);
            *step *= t * t * (3.0 - 2.0 * t);
        }
    }
    let whole: f32 = steps.iter().sum();
    let mut sum = 0.0;
    let mut shares = Vec::with_capacity(n_steps + 1);
    shares.push(0.0);
    for step in steps {
        sum += step;
        shares.push(sum / whole);
    }
    if let Some(end) = shares.last_mut().filter(|_| n_steps > 0) {
        *end = 1.0;
    }
    shares
}

/// The way from each frame to the next, turns counted on a circle of [`TURN_RADIUS_M`], averaged
/// over a fifth of a second so that it is the gait that counts and not its sway.
fn smoothed_travel_m(placed: &Placed, from: usize, to: usize) -> Vec<f32> {
    let motion = &placed.motion;
    let fps: Fps = motion.fps();
    let floor_m = MIN_SPEED_M_S * fps.frame_secs() as f32;
    let roots = motion.root_positions_m();
    let step_m = |frame: usize| {
        let way = roots[frame + 1] - roots[frame];
        let (a, b) = (motion.root_rotation(frame), motion.root_rotation(frame + 1));
        // |y| of the relative rotation is near half the turn about the vertical.
        let turn_rad = 2.0 * (b * a.inverse()).y.abs();
        way.x.hypot(way.z) + TURN_RADIUS_M * turn_rad
    };
    let mut sums = Vec::with_capacity(to - from + 1);
    sums.push(0.0f32);
    for frame in from..to {
        sums.push(sums[frame - from] + step_m(frame));
    }
    let half = fps.frames_in_secs(0.1).max(1);
    (0..to - from)
        .map(|idx| {
            let (a, b) = (idx.saturating_sub(half), (idx + half + 1).min(to - from));
            (sums[b] - sums[a]) / (b - a) as f32 + floor_m
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use glam::Vec2;
    use proptest::prelude::*;

    use super::*;
    use crate::assemble::place::place;
    use crate::motion::Motion;
    use crate::testing::{piece, walks};

    fn target(frame: u32, heading_rad: f32, x: f32, z: f32) -> BodyTarget {
        let world_from_torso = PlanarTransform::new(heading_rad, Vec2::new(x, z), 0.0);
        BodyTarget { frame: FrameIdx(frame), world_from_torso, height: false }
    }

    fn walk_of(n_pieces: u32) -> Placed {
        let pieces: Vec<_> = (0..n_pieces).map(|idx| piece(idx % 3, 0, 58)).collect();
        place(&walks(), &pieces, PlanarTransform::IDENTITY).expect("valid")
    }

    #[track_caller]
    fn assert_met(placed: &Placed, targets: &[BodyTarget]) {
        for (error, target) in target_errors(placed, targets).iter().zip(targets) {
            assert!(error.position_m < 1e-4, "{error:?} at {target:?}");
            assert!(error.heading_rad.to_degrees() < 0.01, "{error:?} at {target:?}");
            assert!(error.level_m < 1e-4, "{error:?} at {target:?}");
        }
    }

    fn targets() -> impl Strategy<Value = Vec<BodyTarget>> {
        let one = (0u32..30, -3.1f32..3.1, -8f32..8.0, -8f32..8.0, any::<bool>(), -0.3f32..0.3);
        prop::collection::vec(one, 1..5).prop_map(|list| {
            let mut frame = 0;
            list.into_iter()
                .map(|(gap, heading_rad, x, z, height, level_m)| {
                    frame += gap + 5;
                    let mut target = target(frame, heading_rad, x, z);
                    target.height = height;
                    target.world_from_torso.level_m = level_m;
                    target
                })
                .collect()
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn every_target_is_met(targets in targets(), even in any::<bool>()) {
            let policy = if even { SpreadPolicy::Even } else { SpreadPolicy::ByTravel };
            let mut placed = walk_of(3);
            let before = placed.clone();
            satisfy(&mut placed, &targets, policy);
            assert_met(&placed, &targets);
            prop_assert_eq!(placed.motion.n_frames(), before.motion.n_frames());
            prop_assert_eq!(
                placed.motion.root_positions_m()[0], before.motion.root_positions_m()[0]
            );
        }

        #[test]
        fn shares_run_from_nothing_to_all_and_never_fall(
            from in 0usize..50, length in 1usize..100, ease in any::<bool>(),
        ) {
            let shares = spread(&walk_of(3), from, from + length, ease, SpreadPolicy::ByTravel);
            prop_assert_eq!((shares[0], shares[length]), (0.0, 1.0));
            prop_assert!(shares.windows(2).all(|w| w[0] <= w[1]));
        }
    }

    #[test]
    fn what_follows_a_target_moves_rigidly() {
        let (before, mut after) = (walk_of(3), walk_of(3));
        satisfy(&mut after, &[target(60, 1.0, 2.0, 2.0)], SpreadPolicy::ByTravel);
        let way = |placed: &Placed, a: usize, b: usize| {
            let at: &Motion = &placed.motion;
            at.root_positions_m()[a].distance(at.root_positions_m()[b])
        };
        for frame in 61..170 {
            let (a, b) = (way(&before, 60, frame), way(&after, 60, frame));
            assert!((a - b).abs() < 1e-4, "frame {frame}: {a} became {b}");
        }
    }

    #[test]
    fn a_target_that_is_met_moves_nothing() {
        let before = walk_of(2);
        let yaw = yaw_series_rad(&before.motion);
        let here = torso(&before, &yaw, 70);
        let mut after = before.clone();
        let met = BodyTarget { frame: FrameIdx(70), world_from_torso: here, height: true };
        satisfy(&mut after, &[met], SpreadPolicy::ByTravel);
        assert_eq!(before, after);
    }

    #[test]
    fn a_target_at_the_first_frame_moves_all() {
        let mut placed = walk_of(2);
        let targets = [target(0, 0.5, 3.0, -1.0), target(100, -1.0, 4.0, 2.0)];
        satisfy(&mut placed, &targets, SpreadPolicy::ByTravel);
        assert_met(&placed, &targets);
    }

    #[test]
    fn targets_within_a_roll_are_met() {
        // Upside down from frame 40 to 80: headings there are interpolated.
        let mut placed = walk_of(3);
        for frame in 40..80 {
            let q = &mut placed.motion.rotations_mut(frame)[0];
            *q *= glam::Quat::from_rotation_x(3.0);
        }
        let targets =
            [target(20, 0.2, 0.1, 0.5), target(60, 1.2, 0.5, 1.0), target(120, 2.0, 2.0, 2.0)];
        satisfy(&mut placed, &targets, SpreadPolicy::ByTravel);
        assert_met(&placed, &targets);
    }

    #[test]
    fn targets_out_of_order_are_refused() {
        let check = |frames: &[u32]| {
            let targets: Vec<_> = frames.iter().map(|&f| target(f, 0.0, 0.0, 0.0)).collect();
            check_targets(&targets, 100).map_err(|error| error.to_string())
        };
        assert_eq!(check(&[0, 5, 99]), Ok(()));
        assert_eq!(
            check(&[0, 100]),
            Err("body target 1 at frame 100 is out of order or beyond the last frame".to_owned())
        );
        assert!(check(&[5, 5]).is_err() && check(&[6, 5]).is_err());
    }
}
