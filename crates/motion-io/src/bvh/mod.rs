//! BVH, the Biovision hierarchy: a skeleton and Euler angles as text.
//!
//! Reading takes two steps: [`read`](read()) makes a [`Bvh`] of the text, in the file's own units and
//! channels; [`Bvh::to_motion`] makes a skeleton and a motion of that. [`write`](write()) goes
//! the other way.
//!
//! How the file is understood where the format has dialects:
//!
//! * Rotations are multiplied in the order in which their channels are listed, the first
//!   outermost: `Zrotation Xrotation Yrotation` is `Rz · Rx · Ry`.
//! * Position channels replace the joint's `OFFSET`, coordinate by coordinate.
//! * A frame is a line. Blank lines are skipped anywhere.

mod frames;
mod read;
mod round_trip;
mod to_motion;
mod write;

use std::path::Path;

use glam::DVec3;
use motion_core::motion::Motion;
use motion_core::skeleton::Skeleton;
use motion_core::units::Fps;

use crate::atomic_write::atomic_write;
use crate::diagnostic::FileError;

pub use read::read;
pub use round_trip::{RoundTrip, round_trip};
pub use write::{BvhWriteOptions, EulerOrder, write};

/// A coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// The first coordinate.
    X,
    /// The second coordinate.
    Y,
    /// The third coordinate.
    Z,
}

/// What one number of a frame means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// A coordinate of the joint's position, file units.
    Position(Axis),
    /// An angle about an axis of the joint, degrees.
    Rotation(Axis),
}

/// A joint of the hierarchy.
#[derive(Clone, Debug, PartialEq)]
pub struct BvhJoint {
    /// Its name, unique in the file.
    pub name: String,
    /// The joint that carries it; smaller than its own index.
    pub parent: Option<usize>,
    /// Where it sits in its parent's space, file units.
    pub offset: DVec3,
    /// Where its bone ends, file units; `None` for joints with children or an end of no length.
    pub end_site: Option<DVec3>,
    /// Its channels in the file's order: up to three positions and three rotations, none twice.
    pub channels: Vec<Channel>,
    /// Where its channels begin in a frame.
    pub first_channel: usize,
    /// The line that names it.
    pub line: u32,
}

/// A BVH file as it stands, checked: every number is finite and within the limits.
#[derive(Clone, Debug, PartialEq)]
pub struct Bvh {
    /// Parents before children, in the file's order.
    pub joints: Vec<BvhJoint>,
    /// The rate that the frame time means.
    pub fps: Fps,
    /// Numbers of a frame, at least 1.
    pub n_channels: usize,
    /// Frame-major, `n_channels` each.
    pub values: Vec<f64>,
}

impl Bvh {
    /// How many frames there are; at least 1.
    pub fn n_frames(&self) -> usize {
        self.values.len() / self.n_channels.max(1)
    }
}

/// Writes a motion to the BVH file at `path`, whole or not at all; see [`write`](write()).
pub fn save(
    path: &Path,
    skeleton: &Skeleton,
    motion: &Motion,
    options: &BvhWriteOptions,
) -> Result<(), FileError> {
    atomic_write(path, write(skeleton, motion, options).as_bytes())
}

#[cfg(test)]
mod tests;
