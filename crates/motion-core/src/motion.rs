//! `Motion`: what a body does, sampled at a fixed rate. Clips and results alike.

use glam::{Quat, Vec3};

use crate::ids::JointIdx;
use crate::rotation;
use crate::skeleton::Skeleton;
use crate::units::Fps;

/// The root's path and every joint's local rotation, frame by frame.
///
/// Only the root is translated; a joint's rotation is relative to its parent and to the rest
/// pose (identity). The skeleton is kept beside a motion, not in it, since a library's clips
/// share one.
///
/// Invariants, checked by [`Motion::new`]:
/// 1. At least one frame and one joint; `rotations.len() = n_frames · n_joints`.
/// 2. Everything is finite and every rotation has unit length (within 1e-3; it is renormalised
///    where it is off by more than rounding, so that a motion made of another's samples is the
///    same to the last bit).
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    fps: Fps,
    n_joints: usize,
    /// World position of the root joint per frame, metres.
    root_positions_m: Vec<Vec3>,
    /// Frame-major: joint `j` of frame `f` is at `f · n_joints + j`.
    rotations: Vec<Quat>,
}

/// Why numbers are no motion.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MotionError {
    /// Rule 1.
    #[error("{n_rotations} rotations do not make {n_frames} frames of {n_joints} joints")]
    Shape {
        /// Rotations given.
        n_rotations: usize,
        /// Root positions given.
        n_frames: usize,
        /// Joints of the skeleton.
        n_joints: usize,
    },
    /// Rule 2.
    #[error("frame {frame} holds a value that is not a finite position or a rotation")]
    Value {
        /// The first bad frame.
        frame: usize,
    },
}

impl Motion {
    /// A motion from its samples.
    pub fn new(
        fps: Fps,
        n_joints: usize,
        root_positions_m: Vec<Vec3>,
        mut rotations: Vec<Quat>,
    ) -> Result<Self, MotionError> {
        let n_frames = root_positions_m.len();
        if n_frames == 0 || n_joints == 0 || rotations.len() != n_frames * n_joints {
            return Err(MotionError::Shape { n_rotations: rotations.len(), n_frames, n_joints });
        }
        for (frame, pose) in rotations.chunks_exact_mut(n_joints).enumerate() {
            let unit = pose.iter().all(|q| (q.length_squared() - 1.0).abs() < 2e-3);
            if !unit || !root_positions_m[frame].is_finite() {
                return Err(MotionError::Value { frame });
            }
            for q in pose.iter_mut().filter(|q| (q.length_squared() - 1.0).abs() > 1e-6) {
                *q = q.normalize();
            }
        }
        Ok(Self { fps, n_joints, root_positions_m, rotations })
    }

    /// A motion from parts that keep the invariants already (pieces of checked motions).
    pub(crate) fn from_unit_parts(
        fps: Fps,
        n_joints: usize,
        root_positions_m: Vec<Vec3>,
        rotations: Vec<Quat>,
    ) -> Self {
        debug_assert!(n_joints > 0 && !root_positions_m.is_empty(), "an empty motion");
        debug_assert_eq!(rotations.len(), root_positions_m.len() * n_joints, "a ragged motion");
        Self { fps, n_joints, root_positions_m, rotations }
    }

    /// The sampling rate.
    #[inline]
    pub fn fps(&self) -> Fps {
        self.fps
    }

    /// How many frames there are; at least 1.
    #[inline]
    pub fn n_frames(&self) -> usize {
        self.root_positions_m.len()
    }

    /// How many joints a frame has.
    #[inline]
    pub fn n_joints(&self) -> usize {
        self.n_joints
    }

    /// World position of the root joint per frame, metres.
    #[inline]
    pub fn root_positions_m(&self) -> &[Vec3] {
        &self.root_positions_m
    }

    /// The local rotations of frame `frame`, a joint each.
    #[inline]
    pub fn rotations(&self, frame: usize) -> &[Quat] {
        &self.rotations[frame * self.n_joints..(frame + 1) * self.n_joints]
    }

    /// The root's world rotation (relative to the rest pose) at `frame`.
    #[inline]
    pub fn root_rotation(&self, frame: usize) -> Quat {
        self.rotations[frame * self.n_joints]
    }

    /// Mutable access for the stages of assembly, which keep the invariants.
    #[inline]
    pub fn root_positions_m_mut(&mut self) -> &mut [Vec3] {
        &mut self.root_positions_m
    }

    /// Mutable local rotations of `frame`; what is written must stay of unit length.
    #[inline]
    pub fn rotations_mut(&mut self, frame: usize) -> &mut [Quat] {
        &mut self.rotations[frame * self.n_joints..(frame + 1) * self.n_joints]
    }

    /// Frames `from..to` (the end not included) as a motion of their own.
    ///
    /// # Panics
    /// When the range is empty or leaves the motion.
    #[must_use]
    pub fn slice(&self, from: usize, to: usize) -> Self {
        assert!(from < to && to <= self.n_frames(), "bad range {from}..{to}");
        Self {
            fps: self.fps,
            n_joints: self.n_joints,
            root_positions_m: self.root_positions_m[from..to].to_vec(),
            rotations: self.rotations[from * self.n_joints..to * self.n_joints].to_vec(),
        }
    }

    /// The same motion at another rate: positions interpolated linearly, rotations by slerp.
    ///
    /// The first frame stays; the last new frame is the last one that lies within the old
    /// motion, so nothing is extrapolated. A rate that is equal changes nothing.
    #[must_use]
    pub fn resampled(&self, fps: Fps) -> Self {
        if fps == self.fps {
            return self.clone();
        }
        let step = self.fps.get() / fps.get();
        // The slack keeps the last frame when a file rounds its frame time (0.0083333 s).
        let last = ((self.n_frames() - 1) as f64 / step + 1e-3).floor() as usize;
        let mut root_positions_m = Vec::with_capacity(last + 1);
        let mut rotations = Vec::with_capacity((last + 1) * self.n_joints);
        for frame in 0..=last {
            let at = (frame as f64 * step).min((self.n_frames() - 1) as f64);
            let a = at.floor() as usize;
            let b = (a + 1).min(self.n_frames() - 1);
            let t = (at - a as f64) as f32;
            root_positions_m.push(self.root_positions_m[a].lerp(self.root_positions_m[b], t));
            let pairs = self.rotations(a).iter().zip(self.rotations(b));
            rotations.extend(pairs.map(|(&qa, &qb)| rotation::slerp(qa, qb, t).normalize()));
        }
        Self { fps, n_joints: self.n_joints, root_positions_m, rotations }
    }

    /// World positions of every joint at `frame`, in one pass (parents come first).
    ///
    /// `positions_m` and `world_rotations` are overwritten; they are arguments so that a loop
    /// over frames allocates once.
    pub fn forward_kinematics(
        &self,
        skeleton: &Skeleton,
        frame: usize,
        positions_m: &mut Vec<Vec3>,
        world_rotations: &mut Vec<Quat>,
    ) {
        debug_assert_eq!(skeleton.n_joints(), self.n_joints, "another skeleton's motion");
        positions_m.clear();
        world_rotations.clear();
        let local = self.rotations(frame);
        for (joint, &rotation) in skeleton.joints().iter().zip(local) {
            match joint.parent {
                None => {
                    positions_m.push(self.root_positions_m[frame]);
                    world_rotations.push(rotation);
                }
                Some(parent) => {
                    let parent_rotation = world_rotations[parent.idx()];
                    let at = positions_m[parent.idx()] + parent_rotation * joint.offset_m;
                    positions_m.push(at);
                    world_rotations.push(parent_rotation * rotation);
                }
            }
        }
    }

    /// World positions of every joint of every frame, frame-major, metres.
    pub fn joint_positions_m(&self, skeleton: &Skeleton) -> Vec<Vec3> {
        let mut all = Vec::with_capacity(self.n_frames() * self.n_joints);
        let (mut positions, mut rotations) = (Vec::new(), Vec::new());
        for frame in 0..self.n_frames() {
            self.forward_kinematics(skeleton, frame, &mut positions, &mut rotations);
            all.extend_from_slice(&positions);
        }
        all
    }

    /// The world path of one joint, metres.
    pub fn joint_path_m(&self, skeleton: &Skeleton, joint: JointIdx) -> Vec<Vec3> {
        let mut chain = vec![joint];
        while let Some(parent) = skeleton.joint(chain[chain.len() - 1]).parent {
            chain.push(parent);
        }
        (0..self.n_frames())
            .map(|frame| {
                let local = self.rotations(frame);
                let mut at = self.root_positions_m[frame];
                let mut world = local[0];
                for &link in chain.iter().rev().skip(1) {
                    at += world * skeleton.joint(link).offset_m;
                    world *= local[link.idx()];
                }
                at
            })
            .collect()
    }
}
