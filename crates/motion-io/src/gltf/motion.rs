//! A file's animation before it is made fit for a library.

use std::path::Path;

use motion_core::motion::Motion;
use motion_core::skeleton::Skeleton;

use super::animation;
use super::body::Body;
use super::document::Document;
use super::nodes::Nodes;
use crate::content_hash::ContentHash;
use crate::diagnostic::{FileError, Warnings};
use crate::roles_file::RoleOverrides;

/// A skeleton and a motion in the file's units and axes.
pub(crate) struct RawMotion {
    pub(crate) skeleton: Skeleton,
    pub(crate) motion: Motion,
    pub(crate) content_hash: ContentHash,
}

/// Reads an animation of a `.glb` or `.gltf`: the one called `wanted` (or with that number), else
/// the first.
pub(crate) fn read_raw_motion(
    bytes: &[u8],
    path: &Path,
    wanted: Option<&str>,
    overrides: &RoleOverrides,
    warnings: &mut Warnings,
) -> Result<RawMotion, FileError> {
    let document = Document::new(bytes, path)?;
    let nodes = Nodes::new(&document)?;
    let animation = animation::choose(&document, wanted)?;
    let body = Body::new(&document, &nodes, overrides, warnings)?.ok_or_else(|| {
        FileError::new(path, "its animation moves no joints", "export it with its skeleton")
    })?;
    let motion = animation::motion(&document, &nodes, &body, animation, warnings)?;
    let content_hash = document.content_hash(bytes);
    Ok(RawMotion { skeleton: body.skeleton, motion, content_hash })
}
