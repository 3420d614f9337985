//! Left and right: which joint is the image of which, and motions seen in a mirror.
//!
//! The mirror is the plane x = 0: a walk along +Z stays one, a left turn becomes a right turn.

use std::collections::HashMap;

use glam::Vec3;

use super::{Skeleton, names};
use crate::clip::Clip;
use crate::contacts::Side;
use crate::ground::{Contacts, GroundTrack};
use crate::ids::JointIdx;
use crate::motion::Motion;
use crate::planar::PlanarTransform;
use crate::rotation;
use crate::tags;

/// What a mirrored clip's id ends in.
pub const MIRROR_SUFFIX: &str = "@mirror";

/// For each joint of a skeleton the joint that it becomes in the mirror.
///
/// Invariants:
/// 1. The map is its own inverse; joints of the middle are their own image.
/// 2. The image of a joint's parent is the parent of the joint's image, so that a mirrored pose
///    has the mirror image's shape.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MirrorMap {
    images: Vec<JointIdx>,
}

impl MirrorMap {
    /// The pairs of a skeleton: joints whose roles are opposite, and joints whose names differ in
    /// the side alone (`LThumb` and `RThumb`, `wing.L` and `wing.R`). Pairs that would break
    /// rule 2 are not made.
    pub fn new(skeleton: &Skeleton) -> Self {
        let n_joints = skeleton.n_joints();
        let mut images: Vec<JointIdx> = (0..n_joints).map(JointIdx::from_idx).collect();
        let parts: Vec<names::Part> =
            skeleton.joints().iter().map(|joint| names::read(&joint.name)).collect();
        let right: HashMap<&str, usize> = (0..n_joints)
            .rev()
            .filter(|&idx| parts[idx].side == Some(Side::Right))
            .map(|idx| (parts[idx].word.as_str(), idx))
            .collect();
        for idx in (0..n_joints).rev() {
            if parts[idx].side == Some(Side::Left)
                && let Some(&other) = right.get(parts[idx].word.as_str())
            {
                pair(&mut images, idx, other);
            }
        }
        for &role in super::JointRole::ALL {
            let opposite = role.opposite();
            if role < opposite
                && let (Some(a), Some(b)) = (skeleton.by_role(role), skeleton.by_role(opposite))
            {
                pair(&mut images, a.idx(), b.idx());
            }
        }
        let mut map = Self { images };
        map.drop_crossed_pairs(skeleton);
        map
    }

    /// The image of `joint`.
    #[inline]
    pub fn image(&self, joint: JointIdx) -> JointIdx {
        self.images[joint.idx()]
    }

    /// Makes rule 2 hold; parents come first, so one pass settles children too.
    fn drop_crossed_pairs(&mut self, skeleton: &Skeleton) {
        for idx in 0..self.images.len() {
            let image = self.images[idx].idx();
            let parent_of = |idx: usize| skeleton.joints()[idx].parent;
            let expected = parent_of(idx).map(|parent| self.images[parent.idx()]);
            if image != idx && expected != parent_of(image) {
                self.images[idx] = JointIdx::from_idx(idx);
                self.images[image] = JointIdx::from_idx(image);
            }
        }
    }

    /// The motion in the mirror: `q'(j) = mirrored(q(image of j))`, x of the root negated.
    ///
    /// Mirroring twice is the identity, bit for bit. On a skeleton whose sides differ in bone
    /// lengths the image keeps the skeleton's own lengths.
    ///
    /// # Panics
    /// When the motion is another skeleton's.
    #[must_use]
    pub fn motion(&self, motion: &Motion) -> Motion {
        assert_eq!(motion.n_joints(), self.images.len(), "another skeleton's motion");
        let mut image = motion.clone();
        for position in image.root_positions_m_mut() {
            *position = Vec3::new(-position.x, position.y, position.z);
        }
        for frame in 0..motion.n_frames() {
            let seen = motion.rotations(frame);
            for (q, &from) in image.rotations_mut(frame).iter_mut().zip(&self.images) {
                *q = rotation::mirrored(seen[from.idx()]);
            }
        }
        image
    }

    /// The clip in the mirror, called `ID@mirror`; the image of an image is the clip again. Where
    /// its tags say left, those of the image say right.
    #[must_use]
    pub fn clip(&self, clip: &Clip) -> Clip {
        let id = match clip.id.strip_suffix(MIRROR_SUFFIX) {
            Some(original) => original.to_owned(),
            None => format!("{}{MIRROR_SUFFIX}", clip.id),
        };
        Clip {
            id,
            tags: clip.tags.iter().map(|tag| tags::mirrored(tag)).collect(),
            tag_spans: tags::mirrored_spans(&clip.tag_spans),
            motion: self.motion(&clip.motion),
            track: track(&clip.track),
        }
    }
}

fn pair(images: &mut [JointIdx], a: usize, b: usize) {
    // Whoever was paired with either before is on its own now: the map stays its own inverse.
    for joint in [a, b] {
        let old = images[joint].idx();
        images[old] = JointIdx::from_idx(old);
        images[joint] = JointIdx::from_idx(joint);
    }
    images[a] = JointIdx::from_idx(b);
    images[b] = JointIdx::from_idx(a);
}

/// The track on the ground in the mirror: headings and x negated, feet exchanged.
pub fn track(track: &GroundTrack) -> GroundTrack {
    GroundTrack {
        world_from_torso: track
            .world_from_torso
            .iter()
            .copied()
            .map(PlanarTransform::mirrored)
            .collect(),
        contacts: track.contacts.iter().copied().map(contacts).collect(),
    }
}

/// The planted feet in the mirror.
pub fn contacts(contacts: Contacts) -> Contacts {
    Contacts { left: contacts.right, right: contacts.left }
}

#[cfg(test)]
mod tests {
    use glam::Quat;
    use proptest::prelude::*;

    use super::*;
    use crate::ground::yaw_series_rad;
    use crate::skeleton::Joint;
    use crate::units::Fps;

    fn skeleton(joints: &[(&str, Option<u32>, [f32; 3])]) -> Skeleton {
        let joints = joints
            .iter()
            .map(|&(name, parent, offset)| Joint {
                name: name.into(),
                parent: parent.map(JointIdx),
                offset_m: offset.into(),
                end_site_m: None,
            })
            .collect();
        Skeleton::new(joints).expect("valid by construction")
    }

    /// Hips, a head, and on each side an arm with a thumb that plays no role.
    fn body() -> Skeleton {
        skeleton(&[
            ("Hips", None, [0.0; 3]),
            ("Head", Some(0), [0.0, 0.6, 0.0]),
            ("LeftArm", Some(0), [0.2, 0.4, 0.0]),
            ("LThumb", Some(2), [0.3, 0.0, 0.1]),
            ("RightArm", Some(0), [-0.2, 0.4, 0.0]),
            ("RThumb", Some(4), [-0.3, 0.0, 0.1]),
        ])
    }

    fn motions() -> impl Strategy<Value = Motion> {
        let frame = (
            prop::array::uniform3(-2f32..2.0),
            prop::collection::vec(prop::array::uniform3(-1.5f32..1.5), 6),
        );
        prop::collection::vec(frame, 1..12).prop_map(|frames| {
            let (roots, poses): (Vec<_>, Vec<_>) = frames.into_iter().unzip();
            let rotations =
                poses.into_iter().flatten().map(|v| rotation::exp(Vec3::from(v))).collect();
            Motion::new(Fps::THIRTY, 6, roots.into_iter().map(Vec3::from).collect(), rotations)
                .expect("valid by construction")
        })
    }

    #[test]
    fn pairs_come_from_roles_and_names() {
        let map = MirrorMap::new(&body());
        assert_eq!(map.images, [0, 1, 4, 5, 2, 3].map(JointIdx));
    }

    #[test]
    fn pairs_whose_parents_are_no_pair_are_not_made() {
        let odd = skeleton(&[
            ("Hips", None, [0.0; 3]),
            ("LeftArm", Some(0), [0.2, 0.4, 0.0]),
            ("RightArm", Some(1), [-0.2, 0.4, 0.0]),
        ]);
        assert_eq!(MirrorMap::new(&odd).images, [0, 1, 2].map(JointIdx));
    }

    proptest! {
        #[test]
        fn mirroring_twice_is_the_identity(motion in motions()) {
            let map = MirrorMap::new(&body());
            prop_assert_eq!(map.motion(&map.motion(&motion)), motion);
        }

        #[test]
        fn every_joint_is_where_the_mirror_shows_its_partner(motion in motions()) {
            let (body, flip) = (body(), Vec3::new(-1.0, 1.0, 1.0));
            let map = MirrorMap::new(&body);
            let seen = map.motion(&motion).joint_positions_m(&body);
            let real = motion.joint_positions_m(&body);
            for frame in 0..motion.n_frames() {
                for joint in 0..6 {
                    let partner = map.image(JointIdx::from_idx(joint)).idx();
                    let (a, b) = (seen[frame * 6 + joint], real[frame * 6 + partner] * flip);
                    prop_assert!(a.distance(b) < 1e-5, "{a} is not {b}");
                }
            }
        }

        #[test]
        fn the_track_is_the_image_s_track(motion in motions()) {
            let map = MirrorMap::new(&body());
            let n_frames = motion.n_frames();
            let planted = vec![Contacts { left: true, right: false }; n_frames];
            let levels = vec![0.25; n_frames];
            let mirrored = track(&GroundTrack::new(&motion, &levels, planted));
            let image = map.motion(&motion);
            let expected = GroundTrack::new(&image, &levels, mirrored.contacts.clone());
            prop_assert!(mirrored.contacts.iter().all(|c| !c.left && c.right));
            for (a, b) in mirrored.world_from_torso.iter().zip(&expected.world_from_torso) {
                let turn = crate::planar::wrap_angle_rad(a.heading_rad() - b.heading_rad());
                prop_assert!(turn.abs() < 1e-3, "{turn}");
                prop_assert!(a.ground_m().distance(b.ground_m()) < 1e-5);
                prop_assert_eq!(a.level_m, b.level_m);
            }
        }
    }

    #[test]
    fn a_left_turn_becomes_a_right_turn() {
        let turn: Vec<Quat> = (0..30)
            .flat_map(|f| {
                let mut pose = [Quat::IDENTITY; 6];
                pose[0] = Quat::from_rotation_y(0.02 * f as f32);
                pose
            })
            .collect();
        let motion =
            Motion::new(Fps::THIRTY, 6, vec![Vec3::Y; 30], turn).expect("valid by construction");
        let image = MirrorMap::new(&body()).motion(&motion);
        let yaw = yaw_series_rad(&image);
        assert!((yaw[29] + 0.58).abs() < 1e-4, "{}", yaw[29]);
    }

    #[test]
    fn the_image_of_an_image_has_the_clip_s_name() {
        let motion = Motion::new(Fps::THIRTY, 6, vec![Vec3::Y; 2], vec![Quat::IDENTITY; 12])
            .expect("valid by construction");
        let track = GroundTrack::new(&motion, &[0.0; 2], vec![Contacts::default(); 2]);
        let clip = Clip {
            id: "16_15".into(),
            tags: vec!["walk".into()],
            tag_spans: vec![],
            motion,
            track,
        };
        let map = MirrorMap::new(&body());
        let image = map.clip(&clip);
        assert_eq!(image.id, "16_15@mirror");
        assert_eq!(map.clip(&image), clip);
    }
}
