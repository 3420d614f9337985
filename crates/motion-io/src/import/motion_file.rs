//! One motion file, read and recognised.

use std::path::Path;

use glam::Quat;
use motion_core::motion::Motion;
use motion_core::skeleton::Skeleton;
use motion_core::units::Fps;

use super::Report;
use crate::bvh;
use crate::content_hash::ContentHash;
use crate::diagnostic::{FileError, Warnings};
use crate::gltf;
use crate::guess::{self, Conform, Guess, LengthUnit, UpAxis};
use crate::limits::MAX_MOTION_FILE_BYTES;
use crate::read_file::read_file;
use crate::roles_file::RoleOverrides;

/// What overrides the guesses.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// Metres of one file unit; recognised where left out.
    pub metres_per_unit: Option<f64>,
    /// Which axis is up; recognised where left out.
    pub up: Option<UpAxis>,
    /// Which joints play which roles; recognised from names where left out.
    pub roles: RoleOverrides,
    /// Keeps a T-pose before the motion.
    pub keep_tpose: bool,
    /// Which animation of a glTF file, by its name or its number from 0; the first one where left
    /// out.
    pub animation: Option<String>,
}

/// A motion on its own skeleton at its own rate: metres, Y up, rest pose facing +Z.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionFile {
    /// The body.
    pub skeleton: Skeleton,
    /// What it does.
    pub motion: Motion,
    /// Hash of the file's bytes.
    pub content_hash: ContentHash,
    /// What was recognised.
    pub facts: Facts,
}

/// What was recognised about a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facts {
    /// Metres of one file unit.
    pub metres_per_unit: f64,
    /// The unit that was recognised; `None` where it was given or is none that people use.
    pub unit: Option<Guess<LengthUnit>>,
    /// How high the hips of the standing body are, metres.
    pub hip_height_m: f32,
    /// The axis that was recognised; `None` where it was given, or by the format's rule.
    pub up: Option<Guess<UpAxis>>,
    /// Whether the rest pose was turned to face +Z; unsure where its parts are not recognised.
    pub rest_turned: Guess<bool>,
    /// Frames of a T-pose that were left out at the start.
    pub n_tpose_frames: usize,
    /// The file's rate.
    pub fps: Fps,
    /// The file's frames, T-pose and all.
    pub n_frames: usize,
}

/// Reads a motion file.
pub fn read_motion_file(
    path: &Path,
    options: &ReadOptions,
    warnings: &mut Warnings,
) -> Result<MotionFile, FileError> {
    let bytes = read_file(path, MAX_MOTION_FILE_BYTES)?;
    read_motion(&bytes, path, options, warnings)
}

/// Reads the bytes of a motion file.
pub(super) fn read_motion(
    bytes: &[u8],
    path: &Path,
    options: &ReadOptions,
    warnings: &mut Warnings,
) -> Result<MotionFile, FileError> {
    let is_gltf = gltf::is_gltf(path);
    let (skeleton, motion, content_hash) = if is_gltf {
        let wanted = options.animation.as_deref();
        let raw = gltf::read_raw_motion(bytes, path, wanted, &options.roles, warnings)?;
        (raw.skeleton, raw.motion, raw.content_hash)
    } else {
        let file = bvh::read(bytes, path, warnings)?;
        let (skeleton, motion) = file.to_motion(1.0, path, warnings)?;
        (options.roles.apply(skeleton, path, warnings), motion, ContentHash::of(bytes))
    };

    let (n_frames, fps) = (motion.n_frames(), motion.fps());
    let n_tpose_frames =
        if options.keep_tpose { 0 } else { guess::n_leading_tpose_frames(&skeleton, &motion) };
    let motion = if n_tpose_frames > 0 { motion.slice(n_tpose_frames, n_frames) } else { motion };

    let (metres_per_unit, unit) = match options.metres_per_unit {
        Some(metres) => (metres, None),
        None if is_gltf => gltf::guess_metres(&skeleton, path, warnings),
        None => {
            let unit = guess::guess_unit(&skeleton);
            (unit.value.metres(), Some(unit))
        }
    };
    // In glTF Y is up by the format's rule.
    let is_up_open = options.up.is_none() && !is_gltf;
    let up = is_up_open.then(|| guess::guess_up_axis(&skeleton, &motion));
    let up_axis = options.up.or(up.map(|up| up.value)).unwrap_or(UpAxis::Y);
    let world_from_file = up_axis.y_up_from_file();
    let rest = guess::canonical_from_rest(&skeleton);
    // Where the body tells nothing, its rest pose is as upright as its world.
    let canonical_from_rest = if rest.sure { rest.value } else { world_from_file };
    let how = Conform { scale: metres_per_unit as f32, world_from_file, canonical_from_rest };
    let (skeleton, motion) = guess::conform(skeleton, motion, &how);
    let facts = Facts {
        metres_per_unit,
        unit,
        hip_height_m: guess::hip_height_units(&skeleton),
        up,
        rest_turned: Guess { value: canonical_from_rest != Quat::IDENTITY, sure: rest.sure },
        n_tpose_frames,
        fps,
        n_frames,
    };
    Ok(MotionFile { skeleton, motion, content_hash, facts })
}

impl Facts {
    /// Adds a line for everything that was recognised or done, for a library at `fps`.
    pub fn report(&self, path: &Path, fps: Fps, report: &mut Report) {
        if let Some(unit) = self.unit {
            let (name, height_m) = (unit.value.name(), self.hip_height_m);
            report.add(
                path,
                if unit.sure {
                    format!("lengths are in {name}, by the body's size")
                } else {
                    format!(
                        "the unit of length is not clear; in {name} the hips are {height_m:.2} m \
                         high (--scale says otherwise)"
                    )
                },
            );
        }
        match self.up {
            Some(Guess { sure: false, .. }) => {
                report.add(path, "which axis is up is not clear; Y is taken (--up says otherwise)");
            }
            Some(Guess { value: UpAxis::Z, .. }) => report.add(path, "Z was up, turned to Y up"),
            _ => {}
        }
        match self.rest_turned {
            Guess { sure: false, .. } => report.add(
                path,
                "hips and back are not recognised, so the rest pose is taken to face +Z",
            ),
            Guess { value: true, .. } => report.add(path, "the rest pose was turned to face +Z"),
            _ => {}
        }
        if self.n_tpose_frames > 0 {
            let (n, plural) =
                (self.n_tpose_frames, if self.n_tpose_frames == 1 { "" } else { "s" });
            report
                .add(path, format!("a T-pose before the motion was left out ({n} frame{plural})"));
        }
        if self.fps != fps {
            let (from, to) = (self.fps.get(), fps.get());
            report.add(path, format!("resampled from {from} to {to} frames per second"));
        }
    }
}
