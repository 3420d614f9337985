//! From channels to local rotations and a root path.

use std::path::Path;

use glam::{DQuat, DVec3, Quat, Vec3};
use motion_core::ids::JointIdx;
use motion_core::motion::Motion;
use motion_core::skeleton::{Joint, Skeleton};

use super::{Axis, Bvh, Channel};
use crate::diagnostic::{FileError, Warnings, quoted};

/// A joint other than the root whose position varies by more than this share of the body's size
/// is warned about: its bone would stretch, which a motion cannot say.
const STRETCH_SHARE: f64 = 2e-3;

impl Bvh {
    /// The file's skeleton and motion, lengths in metres at `metres_per_unit`, axes as in the
    /// file.
    ///
    /// The root's offset becomes zero, since its position is in the motion. Position channels of
    /// other joints become their offset: the mean where they vary, with a warning where they vary
    /// visibly. Channels that are zero throughout on a joint with an `OFFSET` are taken for
    /// unused.
    pub fn to_motion(
        &self,
        metres_per_unit: f64,
        path: &Path,
        warnings: &mut Warnings,
    ) -> Result<(Skeleton, Motion), FileError> {
        let mut offsets: Vec<DVec3> = self.joints.iter().map(|joint| joint.offset).collect();
        let size = offsets.iter().map(|offset| offset.length()).sum::<f64>();
        for (idx, joint) in self.joints.iter().enumerate().skip(1) {
            let (offset, spread) = self.constant_offset(idx);
            offsets[idx] = offset;
            if spread > STRETCH_SHARE * size {
                let name = quoted(joint.name.as_bytes());
                let what = format!(
                    "the position of joint {name} varies by {spread:.3} units; its bone is kept at \
                     its mean"
                );
                warnings.warn(path, Some(joint.line), what);
            }
        }
        let root_offset = std::mem::take(&mut offsets[0]);
        let joints = self.joints.iter().zip(&offsets).map(|(joint, offset)| Joint {
            name: joint.name.clone(),
            parent: joint.parent.map(JointIdx::from_idx),
            offset_m: (*offset * metres_per_unit).as_vec3(),
            end_site_m: joint.end_site.map(|end| (end * metres_per_unit).as_vec3()),
        });
        let bad = |error: &dyn std::fmt::Display| {
            FileError::new(path, error.to_string(), "check the file's skeleton and channels")
        };
        let skeleton = Skeleton::new(joints.collect()).map_err(|error| bad(&error))?;
        let (positions, rotations) = self.samples(root_offset, metres_per_unit);
        let motion = Motion::new(self.fps, self.joints.len(), positions, rotations)
            .map_err(|error| bad(&error))?;
        Ok((skeleton, motion))
    }

    /// Root positions and all local rotations.
    fn samples(&self, root_offset: DVec3, metres_per_unit: f64) -> (Vec<Vec3>, Vec<Quat>) {
        let n_frames = self.n_frames();
        let mut positions = Vec::with_capacity(n_frames);
        let mut rotations = Vec::with_capacity(n_frames * self.joints.len());
        for frame in self.values.chunks_exact(self.n_channels) {
            for (idx, joint) in self.joints.iter().enumerate() {
                let mut rotation = DQuat::IDENTITY;
                let mut position = root_offset;
                for (&channel, &value) in joint.channels.iter().zip(&frame[joint.first_channel..]) {
                    match channel {
                        Channel::Position(axis) => position[axis as usize] = value,
                        Channel::Rotation(axis) => rotation *= about(axis, value.to_radians()),
                    }
                }
                if idx == 0 {
                    positions.push((position * metres_per_unit).as_vec3());
                }
                rotations.push(rotation.as_quat());
            }
        }
        (positions, rotations)
    }

    /// The offset that the position channels of joint `idx` mean, and by how much they vary.
    fn constant_offset(&self, idx: usize) -> (DVec3, f64) {
        let joint = &self.joints[idx];
        let mut offset = joint.offset;
        let mut spread: f64 = 0.0;
        let mut all_zero = true;
        for (at, &channel) in joint.channels.iter().enumerate() {
            let Channel::Position(axis) = channel else { continue };
            let column = self.values.iter().skip(joint.first_channel + at).step_by(self.n_channels);
            let (mut low, mut high, mut sum) = (f64::INFINITY, f64::NEG_INFINITY, 0.0);
            for &value in column {
                low = low.min(value);
                high = high.max(value);
                sum += value;
            }
            all_zero &= low == 0.0 && high == 0.0;
            spread = spread.max(high - low);
            offset[axis as usize] = if low == high { low } else { sum / self.n_frames() as f64 };
        }
        if all_zero { (joint.offset, 0.0) } else { (offset, spread) }
    }
}

fn about(axis: Axis, angle_rad: f64) -> DQuat {
    match axis {
        Axis::X => DQuat::from_rotation_x(angle_rad),
        Axis::Y => DQuat::from_rotation_y(angle_rad),
        Axis::Z => DQuat::from_rotation_z(angle_rad),
    }
}
