//! Seams: the jump at every cut spread over the frames around it.
//!
//! Each joint's jump is a rotation vector in the joint's own frame, `δ = log(q_s⁻¹ q_t)` with
//! `q_s` what the old clip would have shown at the cut and `q_t` what the new one does; frames
//! around the cut become `q · exp(y δ + g Δω)` with the curves of [`super::seam_curve`]. The root's
//! position jumps in height alone, since placing laid ground points on each other;
//! its velocity jumps in all three directions. Δω, Δv are the jumps of velocity per frame, and 0
//! under [`SeamPolicy::Paper`].
//!
//! Seams are taken in order, each measured on the motion that the earlier ones left. Windows of
//! neighbouring cuts may overlap: whatever a window multiplies onto both sides of another cut
//! keeps that cut closed, so every cut ends up closed exactly.

use glam::{Quat, Vec3};

use super::place::{Ghost, Piece, Placed};
use super::seam_curve::{SeamCurve, Window};
use crate::clip::ClipSet;
use crate::rotation;

/// How cuts are smoothed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SeamPolicy {
    /// AF02: positions meet over one second on each side; velocities jump.
    Paper,
    /// Positions and velocities meet, over [`MATCHED_SECS`] on each side.
    #[default]
    VelocityMatched,
}

/// The paper's window, seconds per side.
pub const PAPER_SECS: f64 = 1.0;

/// The window of [`SeamPolicy::VelocityMatched`], seconds per side.
///
/// Closing a jump Δx of position and Δv of velocity within s adds accelerations near 1·Δx/s² and
/// 2·Δv/s: at 0.5 s a jump of 0.1 m and 0.3 m/s, large for an edge under the default τ, costs
/// 1.6 m/s², little against the 15 m/s² of a walk. On random paths over the CMU clips seams were
/// as quiet at 0.5 s as at 1 s (the largest acceleration around a seam over that of the clips
/// around their frames: median 0.9, 95th percentile 1.15; at 0.3 s 1.33, by the paper's curve
/// 3.5), and feet were dragged about less.
pub const MATCHED_SECS: f64 = 0.5;

/// What jumps at a cut.
struct Jump {
    cut: usize,
    curve: SeamCurve,
    root_m: Vec3,
    root_m_per_frame: Vec3,
    /// δ and Δω per joint.
    joints: Vec<(Vec3, Vec3)>,
}

impl Jump {
    /// Adds the displacement to a pose shown (or ghosted) at `frame`.
    fn displace(&self, frame: usize, root_m: &mut Vec3, rotations: &mut [Quat]) {
        let offset = frame as f32 - self.cut as f32;
        let (y, g) = (self.curve.position(offset), self.curve.velocity(offset));
        if y == 0.0 && g == 0.0 {
            return;
        }
        *root_m += self.root_m * y + self.root_m_per_frame * g;
        for (q, (position, velocity)) in rotations.iter_mut().zip(&self.joints) {
            *q *= exp_small(*position * y + *velocity * g);
        }
    }

    /// The first frame that is not displaced any more.
    fn end(&self) -> usize {
        self.cut + self.curve.window().after
    }
}

/// Smooths every cut of `placed` in place. `hard` frames (sorted) keep their poses.
pub fn smooth_seams(
    set: &ClipSet,
    pieces: &[Piece],
    placed: &mut Placed,
    hard: &[usize],
    policy: SeamPolicy,
) {
    let n_frames = placed.motion.n_frames();
    let side = set.fps().frames_in_secs(match policy {
        SeamPolicy::Paper => PAPER_SECS,
        SeamPolicy::VelocityMatched => MATCHED_SECS,
    });
    let mut jumps: Vec<Jump> = Vec::with_capacity(pieces.len());
    let mut ghosts = Ghosts::default();
    for next in 1..pieces.len() {
        let cut = placed.starts[next];
        let window = Window::within(cut, side.max(1), n_frames, hard);
        let curve = match policy {
            SeamPolicy::Paper => SeamCurve::halves(window),
            SeamPolicy::VelocityMatched => SeamCurve::proportional(window),
        };
        ghosts.load(set, pieces, placed, next);
        for earlier in jumps.iter().rev().filter(|jump| jump.end() >= cut) {
            ghosts.displace(earlier, cut);
        }
        let jump = ghosts.jump(placed, cut, curve, policy);
        let frames = cut - window.before..=(cut + window.after).min(n_frames - 1);
        for frame in frames {
            let mut root_m = placed.motion.root_positions_m()[frame];
            jump.displace(frame, &mut root_m, placed.motion.rotations_mut(frame));
            placed.motion.root_positions_m_mut()[frame] = root_m;
        }
        jumps.push(jump);
    }
}

/// The old clip at the cut and one frame on; the new clip one frame before and after the cut.
#[derive(Default)]
struct Ghosts {
    old: Ghost,
    old_next: Ghost,
    new_before: Ghost,
    new_next: Ghost,
}

impl Ghosts {
    fn load(&mut self, set: &ClipSet, pieces: &[Piece], placed: &Placed, next: usize) {
        let (old, new) = (pieces[next - 1], pieces[next]);
        let (old_clip, new_clip) = (set.clip(old.clip), set.clip(new.clip));
        let (old_place, new_place) =
            (placed.world_from_clip[next - 1], placed.world_from_clip[next]);
        let (to, from) = (old.to.idx() as isize, new.from.idx() as isize);
        self.old.load(old_clip, old_place, to + 1);
        self.old_next.load(old_clip, old_place, to + 2);
        self.new_before.load(new_clip, new_place, from - 1);
        self.new_next.load(new_clip, new_place, from + 1);
    }

    /// What an earlier seam's window does to the frames around the cut at `cut`.
    fn displace(&mut self, earlier: &Jump, cut: usize) {
        for (ghost, frame) in [
            (&mut self.old, cut),
            (&mut self.old_next, cut + 1),
            (&mut self.new_before, cut - 1),
            (&mut self.new_next, cut + 1),
        ] {
            earlier.displace(frame, &mut ghost.root_m, &mut ghost.rotations);
        }
    }

    fn jump(&self, placed: &Placed, cut: usize, curve: SeamCurve, policy: SeamPolicy) -> Jump {
        let motion = &placed.motion;
        let shown_m = motion.root_positions_m();
        let (last_old, first_new) = (motion.rotations(cut - 1), motion.rotations(cut));
        let matched = policy == SeamPolicy::VelocityMatched;

        let root_m = shown_m[cut] - self.old.root_m;
        let root_m_per_frame = if matched {
            let old = self.old_next.root_m - shown_m[cut - 1];
            let new = self.new_next.root_m - self.new_before.root_m;
            (new - old) * 0.5
        } else {
            Vec3::ZERO
        };
        let joints = (0..motion.n_joints())
            .map(|joint| {
                let (q_old, q_new) = (self.old.rotations[joint], first_new[joint]);
                let jump = rotation::log(q_old.inverse() * q_new);
                if !matched {
                    return (jump, Vec3::ZERO);
                }
                // Velocities per frame in each side's own frame, carried to where the sides meet.
                let old = velocity(last_old[joint], self.old_next.rotations[joint]);
                let new =
                    velocity(self.new_before.rotations[joint], self.new_next.rotations[joint]);
                let old = rotation::exp(-jump * curve.share_before()) * old;
                let new = rotation::exp(jump * curve.share_after()) * new;
                (jump, new - old)
            })
            .collect();
        Jump { cut, curve, root_m, root_m_per_frame, joints }
    }
}

/// The central difference of rotations two frames apart: a rotation vector per frame.
fn velocity(before: Quat, after: Quat) -> Vec3 {
    0.5 * rotation::log(before.inverse() * after)
}

/// [`rotation::exp`] without its square root and sines for turns below half a radian, where the
/// series is as accurate as f32; the displacements of seams nearly always are.
#[inline]
fn exp_small(v: Vec3) -> Quat {
    let x = 0.25 * v.length_squared();
    if x > 0.0625 {
        return rotation::exp(v);
    }
    let v = v * (0.5 - x * (1.0 / 12.0 - x * (1.0 / 240.0 - x / 10080.0)));
    Quat::from_xyzw(v.x, v.y, v.z, 1.0 - x * (0.5 - x * (1.0 / 24.0 - x / 720.0)))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::assemble::place::place;
    use crate::planar::PlanarTransform;
    use crate::testing::{legs, piece, walks};

    fn smoothed(pieces: &[Piece], hard: &[usize], policy: SeamPolicy) -> (Placed, Placed) {
        let set = walks();
        let placed = place(&set, pieces, PlanarTransform::IDENTITY).expect("valid");
        let mut smooth = placed.clone();
        smooth_seams(&set, pieces, &mut smooth, hard, policy);
        (placed, smooth)
    }

    /// The largest acceleration of any joint in the frames around `cut`, m/s².
    fn acceleration_at(placed: &Placed, cut: usize) -> f32 {
        let n_joints = placed.motion.n_joints();
        let at = placed.motion.joint_positions_m(&legs());
        let mut largest = 0f32;
        for frame in cut - 1..=cut + 1 {
            for joint in 0..n_joints {
                let p = |frame: usize| at[frame * n_joints + joint];
                let second = p(frame + 1) - 2.0 * p(frame) + p(frame - 1);
                largest = largest.max(second.length() * 900.0);
            }
        }
        largest
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn a_cut_to_the_same_frame_changes_nothing(cut in 2u32..57) {
            let pieces = [piece(1, 0, cut - 1), piece(1, cut, 59)];
            for policy in [SeamPolicy::Paper, SeamPolicy::VelocityMatched] {
                let (placed, smooth) = smoothed(&pieces, &[], policy);
                for frame in 0..60 {
                    for (a, b) in
                        placed.motion.rotations(frame).iter().zip(smooth.motion.rotations(frame))
                    {
                        prop_assert!(rotation::angle_between_rad(*a, *b) < 1e-3);
                    }
                }
            }
        }

        #[test]
        fn ends_and_hard_frames_keep_their_poses(
            a in 5u32..40, b in 0u32..30, hard in 0usize..60, matched in any::<bool>(),
        ) {
            let pieces = [piece(0, 0, a), piece(1, b, 50), piece(2, 5, 40)];
            let policy = if matched { SeamPolicy::VelocityMatched } else { SeamPolicy::Paper };
            let (placed, smooth) = smoothed(&pieces, &[hard], policy);
            for frame in [0, hard, placed.motion.n_frames() - 1] {
                prop_assert_eq!(placed.motion.rotations(frame), smooth.motion.rotations(frame));
                prop_assert_eq!(
                    placed.motion.root_positions_m()[frame],
                    smooth.motion.root_positions_m()[frame]
                );
            }
        }

        #[test]
        fn matched_velocities_bring_accelerations_down(a in 12u32..45, b in 12u32..45) {
            // Any frame to any frame: far worse cuts than an edge of a graph.
            let pieces = [piece(0, 0, a), piece(1, b, 59)];
            let (hard, smooth) = smoothed(&pieces, &[], SeamPolicy::VelocityMatched);
            let (_, paper) = smoothed(&pieces, &[], SeamPolicy::Paper);
            let cut = hard.starts[1];
            let (none, matched, paper) =
                (acceleration_at(&hard, cut), acceleration_at(&smooth, cut), acceleration_at(&paper, cut));
            prop_assert!(matched < 35.0, "{matched} m/s² (cut hard {none}, paper {paper})");
            prop_assert!(matched <= none + 5.0 && matched <= paper + 5.0, "{matched} {none} {paper}");
        }

        #[test]
        fn overlapping_windows_leave_every_cut_closed(
            lengths in prop::collection::vec(1u32..12, 2..6), starts in prop::collection::vec(4u32..40, 6),
        ) {
            let mut pieces = vec![piece(0, 0, 30)];
            for (&length, &start) in lengths.iter().zip(&starts) {
                pieces.push(piece(start % 3, start, start + length - 1));
            }
            pieces.push(piece(1, 10, 45));
            let (_, smooth) = smoothed(&pieces, &[], SeamPolicy::VelocityMatched);
            for &cut in &smooth.starts[1..] {
                let (a, b) = (smooth.motion.rotations(cut - 1), smooth.motion.rotations(cut));
                for (joint, (a, b)) in a.iter().zip(b).enumerate() {
                    // No joint of these walks turns faster than 0.45 rad a frame.
                    let step = rotation::angle_between_rad(*a, *b);
                    prop_assert!(step < 0.6, "joint {joint} steps {step} rad at {cut}");
                }
            }
        }

        #[test]
        fn the_fast_exponential_is_the_exponential(
            x in -1f32..1.0, y in -1f32..1.0, z in -1f32..1.0,
        ) {
            let v = Vec3::new(x, y, z);
            let (fast, exact) = (exp_small(v), rotation::exp(v));
            prop_assert!((fast - exact).length() < 5e-7, "{fast} is not {exact}");
        }
    }

    #[test]
    fn the_paper_leaves_velocities_to_jump() {
        let pieces = [piece(0, 0, 29), piece(2, 8, 59)];
        let (_, matched) = smoothed(&pieces, &[], SeamPolicy::VelocityMatched);
        let (_, paper) = smoothed(&pieces, &[], SeamPolicy::Paper);
        let (matched, paper) = (acceleration_at(&matched, 30), acceleration_at(&paper, 30));
        assert!(matched < paper, "{matched} against {paper} m/s²");
    }

    #[test]
    fn pieces_of_one_frame_are_smoothed_too() {
        let pieces = [piece(0, 5, 5), piece(1, 7, 7), piece(2, 9, 9)];
        let (_, smooth) = smoothed(&pieces, &[], SeamPolicy::VelocityMatched);
        for frame in 0..3 {
            assert!(smooth.motion.rotations(frame).iter().all(|q| q.is_normalized()), "{frame}");
        }
    }
}
