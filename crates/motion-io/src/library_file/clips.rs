//! The clips of a library file: sections `skeleton`, `clips` and `motion`.
//!
//! What is read is what was written to the last bit, so that a library from a file gives the same
//! results as one that was just built.

use glam::{Quat, Vec2, Vec3};
use motion_core::clip::{Clip, ClipSet};
use motion_core::ground::{Contacts, GroundTrack};
use motion_core::ids::JointIdx;
use motion_core::motion::Motion;
use motion_core::planar::PlanarTransform;
use motion_core::skeleton::{Joint, JointRole, RoleMap, Skeleton};
use motion_core::units::Fps;

use crate::bytes::{ByteReader, ByteWriter, Fault};
use crate::container::{Container, ContainerWriter};
use crate::content_hash::ContentHash;
use crate::diagnostic::FileError;
use crate::limits::{MAX_JOINTS, MAX_LIBRARY_FRAMES};

/// The parent of a root.
const NO_PARENT: u32 = u32::MAX;
const LEFT_PLANTED: u8 = 1;
const RIGHT_PLANTED: u8 = 2;

/// Adds the sections of `clips`; `content_hashes[i]` is that of the file of clip `i`.
pub(super) fn add_clips(
    container: &mut ContainerWriter,
    clips: &ClipSet,
    content_hashes: &[ContentHash],
) {
    debug_assert_eq!(clips.clips().len(), content_hashes.len(), "a hash per clip");
    let mut skeleton = ByteWriter::new();
    write_skeleton(&mut skeleton, clips.skeleton());
    container.add("skeleton", skeleton.into_bytes());

    let mut facts = ByteWriter::new();
    let mut samples = ByteWriter::new();
    facts.f64(clips.fps().get());
    facts.u32(clips.clips().len() as u32);
    for (clip, hash) in clips.clips().iter().zip(content_hashes) {
        facts.str(&clip.id);
        facts.strs(&clip.tags);
        facts.raw(&hash.0);
        facts.u32(clip.n_frames() as u32);
        write_samples(&mut samples, clip);
    }
    container.add("clips", facts.into_bytes());
    container.add("motion", samples.into_bytes());
}

/// Reads what [`add_clips`] wrote.
pub(super) fn read_clips(
    container: &Container<'_>,
) -> Result<(ClipSet, Vec<ContentHash>), FileError> {
    let skeleton = container.section("skeleton", read_skeleton)?;
    let (fps, facts) = container.section("clips", read_facts)?;
    let clips = container.section("motion", |reader| {
        facts.iter().map(|facts| read_clip(reader, facts, fps, &skeleton)).collect()
    })?;
    let hashes = facts.into_iter().map(|facts| facts.content_hash).collect();
    // Everything was checked but that ids are unique.
    let set = container.checked("clips", ClipSet::new(skeleton, fps, clips))?;
    Ok((set, hashes))
}

fn write_skeleton(out: &mut ByteWriter, skeleton: &Skeleton) {
    let joints = skeleton.joints();
    out.u32(joints.len() as u32);
    for joint in joints {
        out.str(&joint.name);
        out.u32(joint.parent.map_or(NO_PARENT, |parent| parent.0));
        write_vec3(out, joint.offset_m);
        out.u8(u8::from(joint.end_site_m.is_some()));
        write_vec3(out, joint.end_site_m.unwrap_or_default());
    }
    // By name, so that roles may be added to the program later.
    let roles: Vec<(JointRole, JointIdx)> = JointRole::ALL
        .iter()
        .filter_map(|&role| skeleton.by_role(role).map(|joint| (role, joint)))
        .collect();
    out.u32(roles.len() as u32);
    for (role, joint) in roles {
        out.str(role.name());
        out.u32(joint.0);
    }
}

fn read_skeleton(reader: &mut ByteReader<'_>) -> Result<Skeleton, Fault> {
    let n_joints = reader.u32()? as usize;
    if n_joints > MAX_JOINTS {
        return Err(Fault::Value("number of joints"));
    }
    let mut joints = Vec::with_capacity(n_joints);
    for _ in 0..n_joints {
        let name = reader.str()?.to_owned();
        let parent = Some(reader.u32()?).filter(|&parent| parent != NO_PARENT).map(JointIdx);
        let offset_m = read_vec3(reader)?;
        let has_end = reader.u8()? != 0;
        let end = read_vec3(reader)?;
        joints.push(Joint { name, parent, offset_m, end_site_m: has_end.then_some(end) });
    }
    let mut roles = RoleMap::default();
    for _ in 0..reader.u32()? {
        let name = reader.str()?;
        let joint = JointIdx(reader.u32()?);
        if joint.idx() >= n_joints {
            return Err(Fault::Value("joint of a role"));
        }
        if let Some(role) = JointRole::from_name(name) {
            roles.set(role, joint);
        }
    }
    let skeleton = Skeleton::new(joints).or(Err(Fault::Value("skeleton")))?;
    Ok(skeleton.with_roles(roles))
}

struct ClipFacts {
    id: String,
    tags: Vec<String>,
    content_hash: ContentHash,
    n_frames: usize,
}

fn read_facts(reader: &mut ByteReader<'_>) -> Result<(Fps, Vec<ClipFacts>), Fault> {
    let fps = Fps::new(reader.f64()?).or(Err(Fault::Value("rate")))?;
    let n_clips = reader.u32()?;
    let mut clips = Vec::new();
    let mut n_frames_in_all = 0;
    for _ in 0..n_clips {
        let id = reader.str()?.to_owned();
        let tags = reader.strs()?;
        let hash = reader.raw(32)?.try_into().or(Err(Fault::End))?;
        let n_frames = reader.u32()? as usize;
        n_frames_in_all += n_frames;
        // Mirrored clips double what an import may have.
        if n_frames_in_all > 2 * MAX_LIBRARY_FRAMES {
            return Err(Fault::Value("number of frames"));
        }
        clips.push(ClipFacts { id, tags, content_hash: ContentHash(hash), n_frames });
    }
    Ok((fps, clips))
}

fn write_samples(out: &mut ByteWriter, clip: &Clip) {
    let track = &clip.track;
    for (frame, position) in clip.motion.root_positions_m().iter().enumerate() {
        write_vec3(out, *position);
        let torso = track.world_from_torso[frame];
        for value in [torso.cos(), torso.sin(), torso.x_m, torso.z_m, torso.level_m] {
            out.f32(value);
        }
        let contacts = track.contacts[frame];
        let left = if contacts.left { LEFT_PLANTED } else { 0 };
        out.u8(left | if contacts.right { RIGHT_PLANTED } else { 0 });
        for q in clip.motion.rotations(frame) {
            for value in q.to_array() {
                out.f32(value);
            }
        }
    }
}

fn read_clip(
    reader: &mut ByteReader<'_>,
    facts: &ClipFacts,
    fps: Fps,
    skeleton: &Skeleton,
) -> Result<Clip, Fault> {
    let (n_frames, n_joints) = (facts.n_frames, skeleton.n_joints());
    // Root, torso frame, contacts, rotations.
    let frame_bytes = 12 + 20 + 1 + 16 * n_joints;
    if n_frames.saturating_mul(frame_bytes) > reader.rest().len() {
        return Err(Fault::Length);
    }
    let mut positions = Vec::with_capacity(n_frames);
    let mut rotations = Vec::with_capacity(n_frames * n_joints);
    let mut world_from_torso = Vec::with_capacity(n_frames);
    let mut contacts = Vec::with_capacity(n_frames);
    for _ in 0..n_frames {
        positions.push(read_vec3(reader)?);
        let [cos, sin, x, z, level] = read_f32s(reader)?;
        let torso = PlanarTransform::from_cos_sin(cos, sin, Vec2::new(x, z), level);
        world_from_torso.push(torso.ok_or(Fault::Value("torso frame"))?);
        let planted = reader.u8()?;
        contacts.push(Contacts {
            left: planted & LEFT_PLANTED != 0,
            right: planted & RIGHT_PLANTED != 0,
        });
        for _ in 0..n_joints {
            rotations.push(Quat::from_array(read_f32s(reader)?));
        }
    }
    let motion =
        Motion::new(fps, n_joints, positions, rotations).or(Err(Fault::Value("motion")))?;
    let track = GroundTrack { world_from_torso, contacts };
    // Found anew, so that a better rule serves libraries that are there already.
    Ok(Clip::found(skeleton, facts.id.clone(), facts.tags.clone(), motion, track))
}

fn write_vec3(out: &mut ByteWriter, v: Vec3) {
    for value in v.to_array() {
        out.f32(value);
    }
}

fn read_vec3(reader: &mut ByteReader<'_>) -> Result<Vec3, Fault> {
    read_f32s(reader).map(Vec3::from_array)
}

fn read_f32s<const N: usize>(reader: &mut ByteReader<'_>) -> Result<[f32; N], Fault> {
    let mut values = [0.0; N];
    for value in &mut values {
        *value = reader.f32()?;
    }
    Ok(values)
}
