//! Joint positions of a clip in columns, so that a frame's joints are looked at several at a time.

use glam::Vec3;

use crate::ids::JointIdx;

/// Numbers that are reckoned with together.
pub(crate) const LANES: usize = 8;

/// Joint positions in the torso frame of each frame, metres.
#[derive(Clone, Debug)]
pub(crate) struct Bodies {
    /// Joints, filled up with the last one to a multiple of [`LANES`].
    width: usize,
    /// For each frame all x, then all y, then all z.
    values: Vec<f32>,
}

/// One frame's joints: as many of each coordinate, a multiple of [`LANES`], the last joint repeated.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Columns<'a> {
    pub(crate) x: &'a [f32],
    pub(crate) y: &'a [f32],
    pub(crate) z: &'a [f32],
}

impl Bodies {
    /// Of positions frame by frame, at least one joint each.
    pub(crate) fn new(joints_m: &[Vec3], n_joints: usize) -> Self {
        let width = n_joints.next_multiple_of(LANES);
        let n_frames = joints_m.len() / n_joints;
        let mut values = Vec::with_capacity(3 * width * n_frames);
        for joints in joints_m.chunks_exact(n_joints) {
            let filled = |nth: usize| joints[nth.min(n_joints - 1)];
            values.extend((0..width).map(|nth| filled(nth).x));
            values.extend((0..width).map(|nth| filled(nth).y));
            values.extend((0..width).map(|nth| filled(nth).z));
        }
        Self { width, values }
    }

    /// A joint's position, metres.
    #[inline]
    pub(crate) fn joint_m(&self, frame: u32, joint: JointIdx) -> Vec3 {
        let Columns { x, y, z } = self.columns(frame);
        Vec3::new(x[joint.idx()], y[joint.idx()], z[joint.idx()])
    }

    /// The joints of a frame.
    #[inline]
    pub(crate) fn columns(&self, frame: u32) -> Columns<'_> {
        let first = frame as usize * 3 * self.width;
        let frame = &self.values[first..first + 3 * self.width];
        let (x, rest) = frame.split_at(self.width);
        let (y, z) = rest.split_at(self.width);
        Columns { x, y, z }
    }
}
