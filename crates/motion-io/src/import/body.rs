//! Bringing clips of other bodies to the library's skeleton.

use std::fmt;

use glam::Quat;
use motion_core::bind_pose::BindPose;
use motion_core::motion::Motion;
use motion_core::retarget::Retarget;
use motion_core::skeleton::Skeleton;

use super::ImportedClip;
use crate::diagnostic::quoted;

/// Bones that differ by less are the same: a tenth of a millimetre, far below what a file's
/// decimals and a capture resolve.
const SAME_M: f32 = 1e-4;

/// Why a skeleton cannot be brought to another one of the same joints.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Misfit {
    /// Joints of the clip that the library does not have.
    unknown: Vec<String>,
    /// Joints of the library that the clip does not have.
    missing: Vec<String>,
    /// Joints that hang on another one.
    moved: Vec<String>,
}

impl fmt::Display for Misfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kinds = [
            ("without counterpart there", &self.unknown),
            ("missing here", &self.missing),
            ("on another parent", &self.moved),
        ];
        let mut separator = "";
        for (kind, names) in kinds {
            if names.is_empty() {
                continue;
            }
            let n_more = names.len().saturating_sub(MAX_SHOWN);
            write!(f, "{separator}{} {kind}", shown(names))?;
            if n_more > 0 {
                write!(f, " and {n_more} more")?;
            }
            separator = ", ";
        }
        Ok(())
    }
}

/// Most names of one kind in a message.
const MAX_SHOWN: usize = 5;

/// The first few names, in quotes.
fn shown(names: &[String]) -> String {
    let shown: Vec<String> =
        names.iter().take(MAX_SHOWN).map(|name| quoted(name.as_bytes())).collect();
    shown.join(", ")
}

/// The body that most frames have; of equals the first. `bodies[i]` is that of `clips[i]`.
pub(super) fn most_used(bodies: &[Skeleton], clips: &[ImportedClip]) -> Skeleton {
    let mut groups: Vec<(&Skeleton, usize)> = Vec::new();
    for (body, clip) in bodies.iter().zip(clips) {
        let n_frames = clip.motion.n_frames();
        match groups.iter_mut().find(|(known, _)| is_same_body(known, body)) {
            Some((_, sum)) => *sum += n_frames,
            None => groups.push((body, n_frames)),
        }
    }
    let mut most = (&bodies[0], 0);
    for group in groups {
        if group.1 > most.1 {
            most = group;
        }
    }
    most.0.clone()
}

/// Whether two skeletons have the same joints in the same order and bones of the same size.
fn is_same_body(a: &Skeleton, b: &Skeleton) -> bool {
    a.n_joints() == b.n_joints()
        && a.joints().iter().zip(b.joints()).all(|(a, b)| {
            a.name == b.name && a.parent == b.parent && a.offset_m.abs_diff_eq(b.offset_m, SAME_M)
        })
}

/// What was done to bring a clip to the library's skeleton.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Brought {
    /// Nothing: the body is the library's.
    Same,
    /// Rotations were kept, the root's path scaled by the ratio of leg lengths: the same joints
    /// with bones of other lengths.
    Scaled(f32),
    /// The motion was retargeted by the parts of the body.
    Retargeted {
        /// Ratio of leg lengths.
        leg_ratio: f32,
        /// Joints of the library that nothing moves.
        still: Vec<String>,
    },
}

impl fmt::Display for Brought {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Same => write!(f, "the library's body"),
            Self::Scaled(root_scale) => write!(
                f,
                "another body, brought to the library's skeleton with its root's path × \
                 {root_scale:.3}"
            ),
            Self::Retargeted { leg_ratio, still } => {
                write!(
                    f,
                    "another hierarchy, retargeted to the library's skeleton by the parts of the \
                     body, its path × {leg_ratio:.3}"
                )?;
                if !still.is_empty() {
                    let n_more = still.len().saturating_sub(MAX_SHOWN);
                    let more =
                        if n_more > 0 { format!(" and {n_more} more") } else { String::new() };
                    write!(f, "; {}{more} there move with their parents", shown(still))?;
                }
                Ok(())
            }
        }
    }
}

/// The library's skeleton, with the pose in which other bodies are compared with it.
pub(super) struct LibraryBody {
    skeleton: Skeleton,
    bind: BindPose,
}

impl LibraryBody {
    /// The standing pose comes from the longest of the clips that have this very body, where the
    /// rest pose is none.
    pub(super) fn new(skeleton: Skeleton, bodies: &[Skeleton], clips: &[ImportedClip]) -> Self {
        let own = bodies.iter().zip(clips).filter(|(body, _)| **body == skeleton);
        let longest = own.map(|(_, clip)| &clip.motion).max_by_key(|motion| motion.n_frames());
        Self::standing_as(skeleton, longest)
    }

    /// The standing pose comes from a motion on `skeleton`, where the rest pose is none.
    pub(super) fn standing_as(skeleton: Skeleton, motion: Option<&Motion>) -> Self {
        let bind = BindPose::of(&skeleton, motion);
        Self { skeleton, bind }
    }

    /// Brings a motion of the body `own` to this one.
    ///
    /// A body that is the library's is left as it is. One with the same joints on the same parents
    /// keeps its rotations. Another one is retargeted, or refused with the joints that have no
    /// counterpart where its parts are not recognised.
    pub(super) fn bring(&self, own: &Skeleton, motion: &mut Motion) -> Result<Brought, Misfit> {
        let misfit = match bring_to(&self.skeleton, own, motion) {
            Ok(None) => return Ok(Brought::Same),
            Ok(Some(root_scale)) => return Ok(Brought::Scaled(root_scale)),
            Err(misfit) => misfit,
        };
        let own_bind = BindPose::of(own, Some(motion));
        let Ok(retarget) = Retarget::new(own, &own_bind, &self.skeleton, &self.bind) else {
            return Err(misfit);
        };
        *motion = retarget.apply(motion);
        let name = |joint| self.skeleton.joint(joint).name.clone();
        let still = retarget.still_joints().map(name).collect();
        Ok(Brought::Retargeted { leg_ratio: retarget.leg_ratio(), still })
    }

    pub(super) fn into_skeleton(self) -> Skeleton {
        self.skeleton
    }
}

/// Brings a motion of the body `own` to the body `library`: rotations are kept, the root's path
/// is scaled by the ratio of leg lengths.
///
/// Returns that factor where anything was scaled; a body that is the library's is left as it is.
fn bring_to(
    library: &Skeleton,
    own: &Skeleton,
    motion: &mut Motion,
) -> Result<Option<f32>, Misfit> {
    if is_same_body(library, own) {
        return Ok(None);
    }
    let own_idx = counterparts(library, own)?;
    if own_idx.iter().enumerate().any(|(idx, &own)| idx != own) {
        let mut pose: Vec<Quat> = Vec::new();
        for frame in 0..motion.n_frames() {
            let rotations = motion.rotations_mut(frame);
            pose.clear();
            pose.extend(own_idx.iter().map(|&own| rotations[own]));
            rotations.copy_from_slice(&pose);
        }
    }
    let ratio = size_m(library) / size_m(own);
    let ratio = if ratio.is_finite() && ratio > 0.0 { ratio } else { 1.0 };
    for position in motion.root_positions_m_mut() {
        *position *= ratio;
    }
    Ok(Some(ratio))
}

/// What root paths are scaled by: the leg's length, or that of all bones without legs.
fn size_m(skeleton: &Skeleton) -> f32 {
    let all_bones = || skeleton.joints().iter().skip(1).map(|joint| joint.offset_m.length()).sum();
    skeleton.leg_length_m().filter(|&leg| leg > 0.0).unwrap_or_else(all_bones)
}

/// For every joint of the library, the index of the clip's joint of the same name on a parent of
/// the same name.
fn counterparts(library: &Skeleton, own: &Skeleton) -> Result<Vec<usize>, Misfit> {
    let mut misfit = Misfit { unknown: Vec::new(), missing: Vec::new(), moved: Vec::new() };
    for joint in own.joints() {
        if library.by_name(&joint.name).is_none() {
            misfit.unknown.push(joint.name.clone());
        }
    }
    let parent_name = |skeleton: &Skeleton, idx: usize| {
        skeleton.joints()[idx].parent.map(|parent| skeleton.joint(parent).name.clone())
    };
    let mut indices = Vec::with_capacity(library.n_joints());
    for (idx, joint) in library.joints().iter().enumerate() {
        match own.by_name(&joint.name) {
            None => misfit.missing.push(joint.name.clone()),
            Some(own_idx) if parent_name(library, idx) != parent_name(own, own_idx.idx()) => {
                misfit.moved.push(joint.name.clone());
            }
            Some(own_idx) => indices.push(own_idx.idx()),
        }
    }
    if misfit.unknown.is_empty() && misfit.missing.is_empty() && misfit.moved.is_empty() {
        Ok(indices)
    } else {
        Err(misfit)
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use motion_core::skeleton::Joint;

    use super::*;
    use crate::guess::test_body::{body, still};

    /// The same body with its joints listed in another order.
    fn reordered(skeleton: &Skeleton) -> Skeleton {
        use motion_core::ids::JointIdx;
        // Legs behind everything else; parents still come first.
        let order: Vec<usize> = [0].into_iter().chain(7..16).chain(1..7).collect();
        let new_idx = |old: JointIdx| order.iter().position(|&o| o == old.idx()).unwrap();
        let joints = order.iter().map(|&old| {
            let joint = &skeleton.joints()[old];
            Joint { parent: joint.parent.map(|p| JointIdx::from_idx(new_idx(p))), ..joint.clone() }
        });
        Skeleton::new(joints.collect()).unwrap()
    }

    #[test]
    fn a_larger_body_walks_shorter_steps_on_a_small_one() {
        let (library, own) = (body(1.0), body(1.25));
        let mut motion = still(&own, Quat::IDENTITY);
        motion.root_positions_m_mut()[4] = Vec3::new(5.0, 1.25, 0.0);
        let ratio = bring_to(&library, &own, &mut motion).unwrap().unwrap();
        assert!((ratio - 0.8).abs() < 1e-6);
        assert!(motion.root_positions_m()[4].distance(Vec3::new(4.0, 1.0, 0.0)) < 1e-5);
    }

    #[test]
    fn the_same_body_is_left_alone() {
        let mut motion = still(&body(1.0), Quat::from_rotation_y(1.0));
        let before = motion.clone();
        assert_eq!(bring_to(&body(1.0), &body(1.0), &mut motion), Ok(None));
        assert_eq!(motion, before);
    }

    #[test]
    fn joints_in_another_order_find_their_counterparts() {
        let library = body(1.0);
        let own = reordered(&library);
        let mut motion = still(&own, Quat::IDENTITY);
        let knee = own.by_name("LeftLeg").unwrap();
        motion.rotations_mut(2)[knee.idx()] = Quat::from_rotation_x(1.0);
        let before = motion.joint_path_m(&own, own.by_name("LeftFoot").unwrap());
        bring_to(&library, &own, &mut motion).unwrap();
        let after = motion.joint_path_m(&library, library.by_name("LeftFoot").unwrap());
        assert_eq!(before, after);
    }

    #[test]
    fn joints_without_counterpart_are_named() {
        let library = body(1.0);
        let mut joints = library.joints().to_vec();
        joints[9].name = "Kopf".to_owned();
        joints[15].parent = joints[14].parent;
        let own = Skeleton::new(joints).unwrap();
        let misfit = bring_to(&library, &own, &mut still(&own, Quat::IDENTITY)).unwrap_err();
        assert_eq!(
            misfit.to_string(),
            "\"Kopf\" without counterpart there, \"Head\" missing here, \"RightHand\" on another \
             parent"
        );
    }
}
